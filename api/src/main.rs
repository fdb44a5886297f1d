//! Prints what is public in a crate, item by item, from the JSON that rustdoc writes of it.

use std::collections::HashSet;
use std::env;
use std::error::Error;

use public_api::Builder;

fn main() -> Result<(), Box<dyn Error>> {
    let json = env::args_os().nth(1).ok_or("name the JSON of rustdoc")?;
    // What every type has says nothing of this one.
    let listed = Builder::from_rustdoc_json(json)
        .omit_blanket_impls(true)
        .omit_auto_trait_impls(true);
    let written = listed.clone().omit_auto_derived_impls(true).build()?;
    let written: HashSet<String> = written.items().map(ToString::to_string).collect();
    for item in listed.build()?.items() {
        let item = item.to_string();
        // Of what is derived the names of the traits.
        if written.contains(&item) || item.starts_with("impl") {
            println!("{item}");
        }
    }
    Ok(())
}
