//! Exact derivatives of all contact forces of a benchmark case, for tests of differentiable simulators.
//!
//! The table has a row for each parameter and contact: the relative growth of one radius, the components of a load on one
//! sphere in mg, mg·tanθ and mg·√3·tanθ, and the tilt in tanθ and √3·tanθ. Forces are in f₀ = mg/(3 cosθ), z points down.
//! `radius K I J` is the derivative by δ of the radius R(1 + δ). All masses, the centres of the bottom spheres and f₀ stay.
//! Run it with `cargo run -p cannonpile-dem --example derivatives -- C22 >C22.csv`.

use std::env;

use cannonpile::num_rational::BigRational;
use cannonpile::shape::Selection;
use cannonpile_dem::derivatives;
use cannonpile_dem::scene::Case;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = env::args().skip(1).find(|text| !text.starts_with('-'));
    let scene = Case::named(name.as_deref().unwrap_or("C21"))?.scene()?;
    let pile = scene.pile()?;
    let forces = pile.forces::<BigRational>().contacts(Selection::All)?;
    let forces = forces.collect::<Result<Vec<_>, _>>()?;
    println!("k,i,j,direction,force,parameter,derivative");
    for record in derivatives(&scene.packing(&pile)?)? {
        let (parameter, derivatives) = record?;
        for (contact, derivative) in forces.iter().zip(derivatives) {
            let (site, line) = (contact.site, contact.direction.name());
            println!(
                "{},{},{},{line},{},{parameter},{derivative}",
                site.k, site.i, site.j, contact.force
            );
        }
    }
    Ok(())
}
