//! The forces of the whole pile on the floor.

use cannonpile::geometry::Vector;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{Verdict, same};
use cannonpile_testkit::answers::{Answers, Shape, ratio};

/// The base supports the weight of the pile and no horizontal force.
pub(crate) fn base_supports_the_weight(pile: &Answers) -> Verdict {
    let sum = pile.floor.values().fold(Vector::zero(), |sum, f| sum + f);
    let weight = whole(pile.spheres.len());
    let total = Vector {
        x: BigRational::zero(),
        y: BigRational::zero(),
        z: weight,
    };
    same("total force on the floor", &sum, &total)
}

/// The forces on the floor have the moment of the weights about every axis through the apex.
///
/// Both are sums of r × F, with r from the apex. The common factor 2R·mg·sinθ is left out, and so are 2cosφ or 2cosφ·tanθ of
/// two components. The weights have no moment about the vertical axis.
pub(crate) fn base_has_the_moment_of_the_weights(pile: &Answers) -> Verdict {
    let weight = Vector {
        x: BigRational::zero(),
        y: BigRational::zero(),
        z: BigRational::one(),
    };
    let of_weights = pile
        .spheres
        .values()
        .map(|sphere| moment(&sphere.position, &weight));
    let of_floor = pile
        .floor
        .iter()
        .map(|(site, f)| moment(&pile.spheres[site].position, f));
    let of_floor = of_floor.fold(Vector::zero(), |sum, m| sum + &m);
    let of_weights = of_weights.fold(Vector::zero(), |sum, m| sum + &m);
    same("moment of the base", &of_floor, &of_weights)?;
    same("moment about the axis", &of_floor.z, &BigRational::zero())
}

fn moment(r: &Vector<BigRational>, f: &Vector<BigRational>) -> Vector<BigRational> {
    Vector {
        x: &r.y * &f.z - &r.z * &f.y,
        y: &r.z * &f.x - &r.x * &f.z,
        z: &r.x * &f.y - &r.y * &f.x,
    }
}

/// The published forces on the floor: the paper's (13) and (14) for the equilateral base. For discs and for the normal force
/// on an isosceles base see `paper`, "Closed form".
pub(crate) fn base_is_as_published(pile: &Answers) -> Verdict {
    let integer = |n: i128| BigRational::from_integer(n.into());
    let last = pile.layers - 1;
    for (site, force) in &pile.floor {
        let (i, j) = (site.i, site.j);
        match &pile.shape {
            Shape::Discs => {
                let normal = integer(pile.layers + 1) / integer(2);
                same(site, &force.z, &normal)?;
            }
            Shape::Spheres(s) => {
                let two_s = s + s;
                let above = integer(last - j) + &two_s * integer(j);
                let normal = BigRational::one() + above / (two_s + integer(2));
                same(site, &force.z, &normal)?;
            }
        }
        if pile.shape == Shape::equilateral() {
            // y is in units of √3·mg·tanθ.
            let published = Vector {
                x: integer(last - 3 * j) / integer(-6),
                y: integer(last - 2 * i - j) / integer(-6),
                z: integer(pile.layers + 2) / integer(3),
            };
            same(site, force, &published)?;
        }
    }
    Ok(())
}

/// `greatest` is the greatest ratio of shear to normal force over the base, in tanθ.
pub(crate) fn base_shear_is_at_most(pile: &Answers, greatest: &BigRational) -> Verdict {
    // The squared length of ŷ·2cosφ.
    let y2 = match &pile.shape {
        Shape::Discs => BigRational::zero(),
        Shape::Spheres(s) => (BigRational::one() - s * s) * ratio(4, 1),
    };
    let squares = pile
        .floor
        .values()
        .map(|f| (&f.x * &f.x + &f.y * &f.y * &y2) / (&f.z * &f.z));
    same(
        "greatest squared shear ratio",
        &squares.max(),
        &Some(greatest * greatest),
    )
}

fn whole(n: usize) -> BigRational {
    BigRational::from_integer(n.into())
}
