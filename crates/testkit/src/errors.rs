//! Checks of error messages.

use core::fmt::Display;

/// Panics unless the message is a single printable line that contains all of `parts`.
pub fn says(error: &impl Display, parts: &[&str]) {
    let message = error.to_string();
    assert!(
        !message.chars().any(char::is_control),
        "{message:?} is not a single line"
    );
    for part in parts {
        assert!(
            message.contains(part),
            "{message:?} does not contain {part:?}"
        );
    }
}
