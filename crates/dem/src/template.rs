//! Texts with placeholders.

use std::collections::BTreeMap;

/// Replaces each `{name}` in the template by its text. Placeholders within a text are not replaced.
#[must_use]
pub fn fill(template: &str, texts: &[(&str, String)]) -> String {
    filled(template, |name| {
        let mut texts = texts.iter();
        let (_, text) = texts.find(|(known, _)| *known == name)?;
        Some(text)
    })
}

/// Fills in the lines of a template whose names all have texts, and omits the other lines. Of consecutive empty lines
/// only one remains.
pub(crate) fn fill_lines(template: &str, texts: &BTreeMap<String, String>) -> String {
    let names = |line: &str| {
        let mut parts = line.split('{').skip(1);
        parts.all(|part| {
            let name = part.split_once('}').map(|(name, _)| name);
            name.is_some_and(|name| texts.contains_key(name))
        })
    };
    let mut lines: Vec<&str> = template.lines().filter(|line| names(line)).collect();
    lines.dedup_by(|line, before| line.is_empty() && before.is_empty());
    let lines = lines.into_iter().map(|line| {
        let line = filled(line, |name| texts.get(name));
        line + "\n"
    });
    lines.collect()
}

fn filled<'t>(template: &str, text: impl Fn(&str) -> Option<&'t String>) -> String {
    let mut parts = template.split('{');
    // A split always has a first part, so this default never applies.
    let mut whole = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let name = part.split_once('}');
        match name.and_then(|(name, rest)| Some((text(name)?, rest))) {
            Some((text, rest)) => whole.extend([text.as_str(), rest]),
            None => whole.extend(["{", part]),
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fills_every_placeholder() {
        let texts = [("a", "1".to_owned()), ("b", "x{a}".to_owned())];
        assert_eq!(
            fill("{a}, {b} and {a}; {} {{a}}", &texts),
            "1, x{a} and 1; {} {1}"
        );
    }

    #[test]
    fn omits_lines_without_texts() {
        let texts = [("a", "1"), ("flag", "")].map(|(name, text)| (name.into(), text.into()));
        let template = "{a}\n\n{b}\n\n{flag}x {a}\n{flag}{none}\n";
        assert_eq!(fill_lines(template, &texts.into()), "1\n\nx 1\n");
    }
}
