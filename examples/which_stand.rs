//! Which stackings are stable? Frictionless spheres cannot pull, so a pile with a tensile contact force is unstable.
//!
//! The census lists the stable stackings of eight layers under one sphere, and of 10³⁰ layers. A wider top layer makes
//! hexagonal close packing unstable one layer earlier. Run it with `cargo run --example which_stand`.

use cannonpile::lattice::Region;
use cannonpile::stacking::{Notation, Stacking};
use cannonpile::{Error, Pile, Verdict, census};

fn main() -> Result<(), Error> {
    let standing: Vec<_> = census::under_one_sphere(8, false)?.collect::<Result<_, _>>()?;
    println!(
        "Of 64 stackings of eight layers, but for mirror images, {} stand:\n",
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

    // However high: after three changes of sign at most, the pile goes straight down for ever.
    let layers = 10_i128.pow(30);
    let tall: Vec<_> = census::under_one_sphere(layers, false)?.collect::<Result<_, _>>()?;
    println!("\nOf 10^30 layers there stand {}, too.", tall.len());
    assert_eq!(tall.len(), 11);
    assert!(
        tall.iter()
            .all(|entry| entry.pile.shape().stacking().changes() <= 3)
    );

    // Hexagonal close packing stands up to five layers; in the sixth a contact would have to pull.
    let hcp = |layers| Pile::under(Region::SITE, Stacking::hcp(layers)?);
    assert_eq!(hcp(5)?.standing()?.verdict(&[]), Verdict::Yes);
    let fallen = hcp(6)?.standing()?;
    assert_eq!(fallen.verdict(&[]), Verdict::No);
    if let Some(pull) = fallen.least {
        println!(
            "\nSix layers of hcp fall: sphere {} would have to pull along {} with {} mg/(3 cosθ).",
            pull.site, pull.direction, -pull.force
        );
    }

    // Under a wider top one layer sooner.
    println!("\nLayers of hcp that stand under a hexagon of n spheres a side:");
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
