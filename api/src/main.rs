//! Lists the public items of a crate from rustdoc's JSON output, and counts their names.
//!
//! `cannonpile-api JSON LIST` writes the list to the file LIST, and prints the number of names that a user can type:
//! functions, methods, types, traits, modules, macros and re-exports. Constants, fields, variants, `impl` headers and
//! the items of trait implementations are listed, but not counted.

use std::collections::HashSet;
use std::env;
use std::error::Error;
use std::fs;

use public_api::tokens::Token;
use public_api::{Builder, PublicItem};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args_os().skip(1);
    let (Some(json), Some(list)) = (arguments.next(), arguments.next()) else {
        return Err("usage: cannonpile-api JSON LIST".into());
    };
    // Blanket and auto trait implementations are the same for every type, so the list omits them.
    let all = Builder::from_rustdoc_json(json)
        .omit_blanket_impls(true)
        .omit_auto_trait_impls(true);
    let written = all.clone().omit_auto_derived_impls(true).build()?;
    let written: HashSet<String> = written.items().map(ToString::to_string).collect();
    let all = all.build()?;
    let trait_impls: HashSet<_> = all
        .items()
        .filter(|item| is_trait_impl(item))
        .map(PublicItem::id)
        .collect();

    let (mut lines, mut names) = (String::new(), 0);
    for item in all.items() {
        let line = item.to_string();
        // Only the header of a derived implementation is listed. It names the trait.
        if written.contains(&line) || line.starts_with("impl") {
            let is_of_trait = item.parent_id().is_some_and(|id| trait_impls.contains(&id));
            names += u32::from(is_name(item) && !is_of_trait);
            lines.push_str(&line);
            lines.push('\n');
        }
    }
    fs::write(list, lines)?;
    println!("{names}");
    Ok(())
}

/// Returns whether an item is a function, a type, a trait, a module, a macro or a re-export.
fn is_name(item: &PublicItem) -> bool {
    let kinds = [
        "fn", "struct", "enum", "union", "type", "trait", "mod", "macro", "use",
    ];
    // Attributes, `pub` and `const` come before the kind. Fields, variants and `impl` headers have no kind.
    let before = |token: &&Token| {
        matches!(
            token,
            Token::Annotation(_) | Token::Qualifier(_) | Token::Whitespace
        )
    };
    let first = item.tokens().find(|token| !before(token));
    matches!(first, Some(Token::Kind(kind)) if kinds.contains(&kind.as_str()))
}

/// Returns whether an item is the header of a trait implementation.
fn is_trait_impl(item: &PublicItem) -> bool {
    let mut words = item.tokens().filter_map(|token| match token {
        Token::Keyword(word) => Some(word.as_str()),
        _ => None,
    });
    words.next() == Some("impl") && words.any(|word| word == "for")
}
