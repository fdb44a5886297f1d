//! Round trips of values through JSON and through a format that does not describe itself.

use core::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;

/// Writes and reads a value as text and as bytes. Returns the text.
pub fn back<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) -> String {
    let text = serde_json::to_string(value).expect("json");
    assert_eq!(&serde_json::from_str::<T>(&text).expect(&text), value);
    let tree = serde_json::to_value(value).expect("json");
    assert_eq!(&serde_json::from_value::<T>(tree).expect(&text), value);
    let bytes = postcard::to_allocvec(value).expect("bytes");
    assert_eq!(&postcard::from_bytes::<T>(&bytes).expect(&text), value);
    text
}

/// The error message for an invalid text.
pub fn refusal<T: DeserializeOwned + Debug>(text: &str) -> String {
    let error = serde_json::from_str::<T>(text).expect_err(text);
    error.to_string()
}
