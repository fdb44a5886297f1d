//! No type that contains rationals derives its comparisons or its hash, because the ones of `Ratio` call themselves once
//! for each common term of two continued fractions. Such types use `exact_surd::equality`.

use super::{Source, block, code, is_of_word, sources};

const DERIVED: [&str; 4] = ["PartialEq", "PartialOrd", "Ord", "Hash"];

/// The names of the types that contain rationals and derive a comparison or a hash.
fn derived_comparisons(text: &str) -> Vec<String> {
    let code = code(text);
    let words = |text: &str| -> Vec<String> {
        let words = text.split(|c| !is_of_word(c)).map(String::from);
        words.filter(|word| !word.is_empty()).collect()
    };
    let mut found = Vec::new();
    for (at, _) in code.match_indices("#[derive(") {
        let item = &code[at..];
        let list = &item[..item.find(")]").expect("the end of a list")];
        if !words(list)
            .iter()
            .any(|word| DERIVED.contains(&word.as_str()))
        {
            continue;
        }
        let opening = item.find(['{', ';']).expect("the fields of a type");
        let end = opening + block(&item[opening..]).max(1);
        let words = words(&item[list.len()..end]);
        let name = words
            .iter()
            .position(|word| ["struct", "enum"].contains(&word.as_str()));
        if words.iter().any(|word| word == "BigRational") {
            found.push(words[name.expect("a type") + 1].clone());
        }
    }
    found
}

#[test]
fn types_with_rationals_derive_no_comparison() {
    for Source {
        package,
        path,
        text,
    } in sources()
    {
        if package != "testkit" {
            let found = derived_comparisons(&text);
            assert!(
                found.is_empty(),
                "{package}/{path}: use equality! for {found:?}"
            );
        }
    }
}

#[test]
fn derived_comparisons_are_found() {
    let derived = "#[derive(Clone, PartialEq)] pub struct A<T = BigRational> { a: T }
        #[derive(Debug)] #[derive(Clone, Hash)]\nstruct B(Option<num_rational::BigRational>);
        /// text\n#[derive(PartialEq, Eq)] #[serde(with = \"x::y\")] enum C { D { e: [BigRational; 2] } }";
    assert_eq!(derived_comparisons(derived), ["A", "B", "C"]);
    let other = "#[derive(Clone, Debug)] struct A { a: BigRational }
        #[derive(PartialEq)] struct B(u8); fn f() -> BigRational {}
        #[derive(PartialEq)] struct C { /* BigRational */ a: Ratio }";
    assert!(derived_comparisons(other).is_empty());
}
