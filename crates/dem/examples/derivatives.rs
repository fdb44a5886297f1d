//! Exact derivatives of all contact forces of a benchmark case, for tests of differentiable simulators.
//!
//! The table has a row for each contact and parameter: the relative growth of one radius, the components of a load on one
//! sphere in mg, mg·tanθ and mg·√3·tanθ, and the tilt in tanθ and √3·tanθ. Forces are in f₀ = mg/(3 cosθ), z points down.
//! `radius K I J` is the derivative by δ of the radius R(1 + δ). All masses, the centres of the bottom spheres and f₀ stay.
//! Run it with `cargo run -p cannonpile-dem --example derivatives -- C22 >C22.csv`.

use std::env;
use std::iter::zip;

use cannonpile::geometry::Load;
use cannonpile::num_rational::BigRational;
use cannonpile::shape::Selection;
use cannonpile_dem::scene::Case;
use cannonpile_stability::{force_by_tilt, sensitivity};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = env::args().skip(1).find(|text| !text.starts_with('-'));
    let scene = Case::named(name.as_deref().unwrap_or("C21"))?.scene()?;
    let pile = scene.pile()?;
    let packing = scene.packing(&pile)?;
    let forces = pile.forces::<BigRational>().contacts(Selection::All)?;
    let forces = forces.collect::<Result<Vec<_>, _>>()?;
    println!("k,i,j,direction,force,parameter,derivative");
    let print = |n: usize, parameter: &str, derivative: &BigRational| {
        let (contact, site) = (&forces[n], forces[n].site);
        let line = contact.direction.name();
        println!(
            "{},{},{},{line},{},{parameter},{derivative}",
            site.k, site.i, site.j, contact.force
        );
    };
    for sphere in pile.sites(Selection::All)? {
        let at = format!("{} {} {}", sphere.k, sphere.i, sphere.j);
        for (n, by) in sensitivity::<BigRational>(&packing, sphere)?
            .iter()
            .enumerate()
        {
            print(n, &format!("radius {at}"), &by.change);
        }
        for (axis, load) in zip(["z", "x", "y"], Load::units()) {
            let response = pile.bare().with_load(sphere, load)?;
            let response = response.forces::<BigRational>().contacts(Selection::All)?;
            for (n, by) in response.enumerate() {
                print(n, &format!("load {axis} {at}"), &by?.force);
            }
        }
    }
    for (n, contact) in forces.iter().enumerate() {
        let by = force_by_tilt(&pile, contact.site, contact.direction)?;
        print(n, "tilt x", &by.a);
        print(n, "tilt y", &by.b);
    }
    Ok(())
}
