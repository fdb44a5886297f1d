//! Scripts with places to fill in.

/// The template with each `{name}` replaced by its text.
#[must_use]
pub fn fill(template: &str, texts: &[(&str, String)]) -> String {
    texts
        .iter()
        .fold(template.to_owned(), |script, (name, text)| {
            script.replace(&format!("{{{name}}}"), text)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_filled() {
        let texts = [("a", "1".to_owned()), ("b", "x".to_owned())];
        assert_eq!(fill("{a}, {b} and {a}; {}", &texts), "1, x and 1; {}");
    }
}
