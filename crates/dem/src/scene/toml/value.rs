//! One value of a file, and the error if it is rejected.

use std::borrow::Cow;

use ::toml::Spanned;
use ::toml::de::{DeInteger, DeTable, DeValue};
use num_bigint::BigInt;

use crate::Error;
use crate::error::quoted;
use cannonpile::scalar::parse::MAX_DIGITS;

/// A value with its key.
pub(super) struct Value<'a> {
    /// The text of the whole file.
    pub(super) file: &'a str,
    /// The byte offset of the key, or of the value in an array.
    start: usize,
    pub(super) key: &'static str,
    content: &'a DeValue<'a>,
}

impl<'a> Value<'a> {
    pub(super) fn new(
        file: &'a str,
        start: usize,
        key: &'static str,
        value: &'a Spanned<DeValue<'a>>,
    ) -> Self {
        Self {
            file,
            start,
            key,
            content: value.get_ref(),
        }
    }

    /// Returns the line of the value, counted from 1.
    pub(super) fn line(&self) -> usize {
        line_of(self.file, self.start)
    }

    /// Adds the line and the key of the value to an error.
    pub(super) fn refused(&self, error: Error) -> Error {
        Error::InFile {
            line: self.line(),
            key: self.key,
            error: Box::new(error),
        }
    }

    /// Returns the error for a value of another kind than `expected`.
    pub(super) fn is_not(&self, expected: &'static str) -> Error {
        self.refused(Error::syntax(&self.text(), expected))
    }

    /// Parses the text of the value.
    pub(super) fn read<T, E: Into<Error>>(
        &self,
        parser: impl FnOnce(&str) -> Result<T, E>,
    ) -> Result<T, Error> {
        parser(&self.text()).map_err(|error| self.refused(error.into()))
    }

    pub(super) fn flag(&self) -> Result<bool, Error> {
        match self.content {
            DeValue::Boolean(flag) => Ok(*flag),
            _ => Err(self.is_not("true or false")),
        }
    }

    pub(super) fn table(&self) -> Option<&'a DeTable<'a>> {
        match self.content {
            DeValue::Table(table) => Some(table),
            _ => None,
        }
    }

    /// Returns the values of an array.
    pub(super) fn items(
        &self,
        expected: &'static str,
    ) -> Result<impl Iterator<Item = Value<'a>> + use<'a>, Error> {
        let DeValue::Array(array) = self.content else {
            return Err(self.is_not(expected));
        };
        let (file, key) = (self.file, self.key);
        Ok(array
            .iter()
            .map(move |item| Value::new(file, item.span().start, key, item)))
    }

    /// Returns the integers of an array, separated by commas; `None` for any other value.
    pub(super) fn integers(&self) -> Option<String> {
        let DeValue::Array(array) = self.content else {
            return None;
        };
        let integers = array.iter().map(|item| item.get_ref().as_integer());
        let integers: Option<Vec<_>> = integers.map(|integer| integer.map(digits)).collect();
        integers.map(|integers| integers.join(","))
    }

    /// Returns the strings and numbers of an array, separated by commas; `None` for any other value.
    pub(super) fn numbers(&self) -> Option<String> {
        let DeValue::Array(array) = self.content else {
            return None;
        };
        let numbers = array.iter().map(|item| text_of(item.get_ref()));
        let numbers: Vec<_> = numbers.collect();
        Some(numbers.join(","))
    }

    /// Returns the text for the parsers: the string, or the number as written.
    ///
    /// Values of other kinds have texts that no parser accepts.
    fn text(&self) -> Cow<'a, str> {
        text_of(self.content)
    }
}

fn text_of<'a>(value: &'a DeValue<'a>) -> Cow<'a, str> {
    match value {
        DeValue::String(text) => Cow::Borrowed(text.as_ref()),
        DeValue::Integer(integer) => digits(integer),
        DeValue::Float(float) => Cow::Borrowed(float.as_str()),
        DeValue::Boolean(flag) => Cow::Owned(flag.to_string()),
        DeValue::Datetime(date) => Cow::Owned(date.to_string()),
        DeValue::Array(_) => Cow::Borrowed("[…]"),
        DeValue::Table(_) => Cow::Borrowed("{…}"),
    }
}

/// Returns the integer in decimal digits.
fn digits<'a>(integer: &'a DeInteger<'_>) -> Cow<'a, str> {
    let digits = integer.as_str();
    if integer.radix() == 10 || digits.len() > MAX_DIGITS {
        return Cow::Borrowed(digits);
    }
    let value = BigInt::parse_bytes(digits.as_bytes(), integer.radix());
    value.map_or(Cow::Borrowed(digits), |value| Cow::Owned(value.to_string()))
}

/// Returns the line of a byte offset, counted from 1.
pub(super) fn line_of(file: &str, start: usize) -> usize {
    let before = file.bytes().take(start);
    1 + before.filter(|byte| *byte == b'\n').count()
}

/// Returns the error for a text that is not TOML, with the message of its parser and the text at the error.
pub(super) fn not_toml(file: &str, error: &::toml::de::Error) -> Error {
    // An error without an offset is shown without a text, in the first line.
    let span = error.span().unwrap_or_default();
    let line = line_of(file, span.start);
    let printable = |c: char| {
        if c.is_control() {
            c.escape_debug().to_string()
        } else {
            c.into()
        }
    };
    let mut reason: String = error.message().chars().map(printable).collect();
    let at = file.get(span).unwrap_or_default().trim();
    if !at.is_empty() {
        reason = format!("{reason}, at '{}'", quoted(at));
    }
    Error::NotToml { line, reason }
}
