//! Stable stackings. Frictionless contacts carry compression only, so a pile that needs tension is unstable.
//!
//! This program lists the stable stackings of eight layers under one sphere, the first unstable height of HCP, and the
//! effect of a wider top. Run it with `cargo run -p cannonpile-stability --example which_stand`.

use cannonpile::lattice::Region;
use cannonpile::stacking::{Notation, Stacking};
use cannonpile::{Error, Pile, Verdict};
use cannonpile_stability::census;

fn main() -> Result<(), Error> {
    let standing: Vec<_> = census::under_one_sphere(8, false)?.collect::<Result<_, _>>()?;
    println!(
        "Of 64 stackings of eight layers, up to mirror images, {} are stable:\n",
        standing.len()
    );
    println!("  {:10}{:12}least contact force", "Hägg", "Zhdanov");
    for entry in &standing {
        let stacking = entry.pile.shape().stacking();
        let (hagg, zhdanov) = (
            stacking.in_notation(Notation::Hagg).to_string(),
            stacking.in_notation(Notation::Zhdanov).to_string(),
        );
        let least = entry
            .standing
            .least
            .as_ref()
            .map(|contact| contact.force.to_string());
        println!(
            "  {hagg:10}{zhdanov:12}{} mg/(3 cosθ)",
            least.unwrap_or_default()
        );
        assert!(entry.stands());
    }
    assert_eq!(standing.len(), 11);

    // At any height: a tall stable pile has at most three sign changes, and is straight below them.
    let layers = 10_i128.pow(30);
    let tall: Vec<_> = census::under_one_sphere(layers, false)?.collect::<Result<_, _>>()?;
    println!("\nOf 10^30 layers also {} are stable.", tall.len());
    assert_eq!(tall.len(), 11);
    assert!(
        tall.iter()
            .all(|entry| entry.pile.shape().stacking().changes() <= 3)
    );

    // Hexagonal close packing is stable up to five layers. With six layers a contact needs tension.
    let hcp = |layers| Pile::under(Region::SITE, Stacking::hcp(layers)?);
    assert_eq!(hcp(5)?.stands()?, Verdict::Yes);
    assert_eq!(hcp(6)?.stands()?, Verdict::No);
    if let Some(pull) = hcp(6)?.standing()?.least {
        println!(
            "\nSix layers of hcp are unstable: below sphere {} the contact along {} needs a tension of {} mg/(3 cosθ).",
            pull.site, pull.direction, -pull.force
        );
    }

    // Under a wider top the stable height is one layer less.
    println!("\nLargest stable number of layers of hcp under a hexagon of n spheres a side:");
    for (side, most) in [(1, 5), (2, 4), (3, 4), (4, 4)] {
        let top = Region::hexagon(side, side)?;
        let stands = |layers: &i128| {
            let pile = Stacking::hcp(*layers).and_then(|stacking| Pile::under(top, stacking));
            pile.and_then(|pile| pile.first_failure())
                .is_ok_and(|failure| failure.is_none())
        };
        let height = (1..=12).take_while(stands).last();
        println!("  n = {side}: {}", height.unwrap_or_default());
        assert_eq!(height, Some(most), "side {side}");
    }
    Ok(())
}
