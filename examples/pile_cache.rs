//! Caches the verdicts on the stability of piles.
//!
//! Two piles are equal if they have the same spheres and loads, in whatever notation they were given. Equal piles have
//! equal hashes, so a pile can be the key of a map. Run it with `cargo run --example pile_cache`.

use std::collections::HashMap;

use cannonpile::lattice::Region;
use cannonpile::{Error, Pile, Verdict};

fn main() -> Result<(), Error> {
    let mut verdicts = HashMap::new();
    // One stacking in three notations, and a stacking with one more layer.
    for stacking in ["ABABA", "+-+-", "(1,1,1,1)", "ABABAB"] {
        let pile = Pile::under(Region::SITE, stacking.parse()?)?;
        let verdict = match verdicts.get(&pile) {
            Some(known) => *known,
            None => pile.standing()?.verdict(&[]),
        };
        println!("{stacking:10} {pile}: {verdict}");
        assert_eq!(verdict == Verdict::Yes, stacking != "ABABAB");
        verdicts.insert(pile, verdict);
    }
    assert_eq!(verdicts.len(), 2);
    Ok(())
}
