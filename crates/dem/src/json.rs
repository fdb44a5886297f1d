//! Records in JSON: whole numbers, and places in a pile.

use cannonpile::lattice::{Dimension, Site};
use serde_json::{Value as Json, json};

/// Returns an integer within 2^53 as a number, and a larger one as a string. Many JSON readers store numbers as floats.
pub(crate) fn integer(number: &impl ToString) -> Json {
    let text = number.to_string();
    match text.parse::<i64>() {
        Ok(small) if small.unsigned_abs() >> 53 == 0 => small.into(),
        _ => text.into(),
    }
}

/// Returns the entries of `before`, of a site (`k, i, j`, or `k, i` for a disc) and of `after` as one record.
pub(crate) fn placed(
    dimension: Dimension,
    before: Json,
    Site { i, j, k }: Site,
    after: Json,
) -> Json {
    let (k, i) = (integer(&k), integer(&i));
    let place = match dimension {
        Dimension::Two => json!({"k": k, "i": i}),
        Dimension::Three => json!({"k": k, "i": i, "j": integer(&j)}),
    };
    joined([before, place, after])
}

/// Returns the entries of all records as one record.
pub(crate) fn joined(records: [Json; 3]) -> Json {
    let entries = |record| match record {
        Json::Object(entries) => entries,
        _ => serde_json::Map::new(),
    };
    Json::Object(records.into_iter().flat_map(entries).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pile with few contacts may have one very wide layer.
    #[test]
    fn indices_that_no_float_holds_are_strings() {
        let (i, j, k) = (1 << 53, 1 - (1 << 53), 1 << 100);
        let site = Site { i, j, k };
        let said = placed(Dimension::Three, json!({}), site, json!({})).to_string();
        let want = r#"{"k":"1267650600228229401496703205376","i":"9007199254740992","j":-9007199254740991}"#;
        assert_eq!(said, want);
    }
}
