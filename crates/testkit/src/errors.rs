//! What an error says.

use core::fmt::Display;

/// Panics unless the message is one plain line that holds all of `parts`.
pub fn says(error: &impl Display, parts: &[&str]) {
    let message = error.to_string();
    assert!(
        !message.chars().any(char::is_control),
        "{message:?} is more than a line"
    );
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}
