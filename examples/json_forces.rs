//! Writes contact forces as JSON, and reads them back without loss.
//!
//! Indices are JSON numbers and exact forces are strings such as "2/3". Both read back as the same values. Run it with
//! `cargo run --features serde --example json_forces`.

use cannonpile::num_rational::BigRational;
use cannonpile::shape::Selection;
use cannonpile::{ContactForce, Pile};
use serde_json::{Value, from_str, to_string};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pile = Pile::under("hexagon:2".parse()?, "+-".parse()?)?;
    let contacts = pile.forces().contacts(Selection::Layer(1))?;
    let forces: Vec<ContactForce<BigRational>> = contacts.collect::<Result<_, _>>()?;

    let text = to_string(&forces)?;
    let rows: Value = from_str(&text)?;
    println!("{}", rows[0]);
    assert_eq!(rows[0]["site"]["k"].as_i64(), Some(1));
    assert_eq!(rows[0]["force"], "2/3");
    assert_eq!(from_str::<Vec<ContactForce<BigRational>>>(&text)?, forces);
    Ok(())
}
