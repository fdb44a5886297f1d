//! An array of a VTK file. It is decoded only if its numbers are needed.

use std::borrow::Cow;

use super::coding::Coding;
use super::values::Values;
use crate::error::{Error, Syntax, quoted};

/// An array: its name, the number of components, and its numbers as the file has them.
pub(super) struct Array<'f> {
    pub(super) name: String,
    /// The number of components of each point or cell.
    pub(super) components: usize,
    /// The number type, by its name in XML.
    pub(super) kind: String,
    pub(super) source: Source<'f>,
}

/// The numbers of an array as the file has them.
pub(super) enum Source<'f> {
    Text(Cow<'f, [u8]>),
    Base64(Cow<'f, [u8]>),
    /// An offset in the appended data.
    Appended(Option<usize>),
    /// The numbers and nothing else.
    Bytes(&'f [u8]),
}

impl Array<'_> {
    pub(super) fn decode(&self, coding: &Coding<'_>) -> Result<Values, Error> {
        let of_bytes = |bytes: &[u8]| Values::of_bytes(&self.kind, coding.order, bytes);
        let values = match &self.source {
            Source::Text(text) => Values::of_text(&self.kind, text),
            Source::Base64(text) => coding.inline(text).and_then(|bytes| of_bytes(&bytes)),
            Source::Appended(offset) => coding.at(*offset).and_then(|bytes| of_bytes(&bytes)),
            Source::Bytes(bytes) => of_bytes(bytes),
        };
        values.map_err(|reason| self.refused(&reason))
    }

    /// Returns the numbers of `count` points or cells. `things` names them in errors.
    pub(super) fn decode_for(
        &self,
        coding: &Coding<'_>,
        count: usize,
        things: &str,
    ) -> Result<Values, Error> {
        let values = self.decode(coding)?;
        let Self { components, .. } = self;
        match count.checked_mul(*components) {
            Some(wanted) if wanted == values.len() => Ok(values),
            _ => Err(self.refused(&format!(
                "{} values for {count} {things} of {components} component{}",
                values.len(),
                if *components == 1 { "" } else { "s" }
            ))),
        }
    }

    /// Decodes an array of integers.
    pub(super) fn integers(&self, coding: &Coding<'_>) -> Result<Vec<i64>, Error> {
        self.whole(self.decode(coding)?)
    }

    /// Returns the numbers of an array of integers.
    pub(super) fn whole(&self, values: Values) -> Result<Vec<i64>, Error> {
        let Values::Integers(values) = values else {
            let refused = Syntax::new(&self.kind, "an integer type such as UInt8 or Int64");
            return Err(self.refused(&refused.to_string()));
        };
        Ok(values)
    }

    fn refused(&self, reason: &str) -> Error {
        Error::Vtk(format!("array {}: {reason}", quoted(&self.name)))
    }
}
