//! Every public function that takes or returns exact numbers runs with long ones in a small stack.
//!
//! `crates/cli/tests/all/long_numbers.rs` is the list of these operations, and `api` that of the public functions.

use std::fs;
use std::path::Path;

use super::is_of_word;

/// Functions that the list calls under another name: by an operator, a trait, or another function.
const INDIRECT: [&str; 13] = [
    "add",
    "cmp",
    "deserialize",
    "eq",
    "fmt",
    "from_str",
    "hash",
    "mul",
    "neg",
    "partial_cmp",
    "quotient",
    "serialize",
    "sub",
];

#[test]
fn operations_on_exact_numbers_are_listed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let words = |text: &str| -> Vec<String> {
        let words = text.split(|c| !is_of_word(c)).map(String::from);
        words.filter(|word| !word.is_empty()).collect()
    };
    let list = fs::read_to_string(root.join("crates/cli/tests/all/long_numbers.rs"));
    let list = words(&list.expect("the list of operations"));
    let mut functions = 0;
    for entry in fs::read_dir(root.join("api")).expect("the lists of public names") {
        let path = entry.expect("a list").path();
        if path.extension().is_none_or(|extension| extension != "txt") {
            continue;
        }
        for line in fs::read_to_string(&path).expect("a list").lines() {
            let exact = ["BigRational", "Surd", "SurdSum"];
            if !line.contains("fn ") || !words(line).iter().any(|word| exact.contains(&&**word)) {
                continue;
            }
            // The name is the last word before the arguments, outside of generic parameters.
            let (head, mut depth) = (line.split_once('(').expect("arguments").0, 0);
            let head: String = head
                .chars()
                .filter(|c| {
                    depth += i32::from(*c == '<') - i32::from(*c == '>');
                    depth == 0
                })
                .collect();
            let head = words(&head);
            let name = head.last().expect("a name");
            functions += 1;
            assert!(
                list.contains(name) || INDIRECT.contains(&&**name),
                "{line}: run {name} in crates/cli/tests/all/long_numbers.rs"
            );
        }
    }
    assert!(functions > 100, "functions are missing: {functions}");
}
