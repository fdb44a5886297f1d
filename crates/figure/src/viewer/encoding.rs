//! Lists of numbers, as base64 of their bytes.

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use cannonpile_dem::Error;
use serde_json::{Value, json};

/// Encodes floats as base64 of their little-endian bytes.
pub(super) fn floats(
    floats: impl IntoIterator<Item = Result<f64, Error>>,
) -> Result<String, Error> {
    let mut bytes = Vec::new();
    for float in floats {
        bytes.extend(float?.to_le_bytes());
    }
    Ok(BASE64.encode(bytes))
}

/// Encodes indices as base64 of their little-endian bytes. Each index has 1, 2 or 4 bytes, as few as the largest one
/// needs.
pub(super) fn indices(indices: &[u32]) -> Value {
    let greatest = indices.iter().max();
    let width = match greatest {
        None | Some(0..=0xff) => 1,
        Some(0x100..=0xffff) => 2,
        Some(_) => 4,
    };
    let bytes = indices
        .iter()
        .flat_map(|index| index.to_le_bytes().into_iter().take(width));
    json!({ "bytes": width, "base64": BASE64.encode(bytes.collect::<Vec<u8>>()) })
}
