//! Answers in SI units are the roots that follow from the geometry, and they are rounded correctly.
//!
//! The oracle uses the squares of the angles, sin²θ = q/3 or q/4 and sin²φ = s², equation (1) of the paper as signed
//! squares, and counts. It takes no root: it compares an answer by sign and square. It compares a float with the squares of
//! the midpoints to its neighbours.

use arbitrary::Unstructured;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Dimension, Direction, Row, Site};
use cannonpile::scalar::Surd;
use cannonpile::{Error, Packing, Pile};
use num_rational::BigRational;
use num_traits::Zero;

use super::nearest::nearest;
use super::{Checked, demand, same};
use crate::generators::number::ratio;
use crate::generators::pile;
use crate::judge::Value;

/// Checks the position and the forces of one sphere of any packing.
pub fn one_sphere(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::packable_pile(u)?;
    let spacing = pile::allowed_spacing(u, &pile)?;
    let packing = pile::sizes(u)?.packing(&pile, &spacing)?;
    let site = pile::site(u, &pile)?;
    let direction = pile::direction(u, &pile)?;
    let oracle = Oracle::new(&packing, &spacing);
    agree(&packing.position(site)?, &oracle.position(site))?;
    if site.k == pile.layers() - 1 {
        let force = packing.on_floor(site)?;
        let got = [force.shear_x, force.shear_y, force.normal];
        return agree(&got, &oracle.on_floor(site));
    }
    let force = packing.contact(site, direction)?;
    nearest(&force, &oracle.contact(site, direction))?;
    let vector = packing.contact_vector(site, direction)?;
    agree(&vector, &oracle.contact_vector(site, direction))?;
    same("|f|²", &squared_length(&vector), &force.square())?;
    touches(&packing, site, direction)
}

/// Whole rows of positions and contact points are rounded correctly. Rows outside the pile are rejected.
pub fn one_row(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::packable_pile(u)?;
    let spacing = pile::allowed_spacing(u, &pile)?;
    let packing = pile::sizes(u)?.packing(&pile, &spacing)?;
    let Site { i, j, k } = pile::site(u, &pile)?;
    let direction = pile::direction(u, &pile)?;
    let (length, spheres) = (u.int_in_range(1..=6)?, k - j + 1);
    let row = Row {
        k,
        j,
        i: i..i + length,
    };
    let is_inside = row.i.end <= spheres;
    let places = packing.places::<f64>();
    let filled = fill(length, |slices| places.fill_row(&row, slices));
    are_nearest(&row, filled, is_inside, |site| packing.position(site))?;
    let filled = fill(length, |slices| {
        places.fill_row_of_contacts(&row, direction, slices)
    });
    let has_contacts = is_inside && k < pile.layers() - 1;
    are_nearest(&row, filled, has_contacts, |site| {
        packing.contact_point(site, direction)
    })?;
    let others = fill(length + 1, |slices| places.fill_row(&row, slices));
    let is_refused = matches!(others, Err(Error::Length { .. }));
    demand(is_refused, || {
        format!("{row:?} in slices that are too long")
    })
}

/// The contents of three slices of `length` floats after `fill`.
fn fill(
    length: i128,
    fill: impl FnOnce([&mut [f64]; 3]) -> Result<(), Error>,
) -> Result<[Vec<f64>; 3], Error> {
    let mut slices = [(); 3].map(|()| vec![0.0; usize::try_from(length).unwrap_or(0)]);
    fill(slices.each_mut().map(Vec::as_mut_slice))?;
    Ok(slices)
}

/// An existing row has correctly rounded floats, or one of them overflows. Any other row is rejected.
fn are_nearest(
    row: &Row,
    filled: Result<[Vec<f64>; 3], Error>,
    is_there: bool,
    place: impl Fn(Site) -> Result<[Surd; 3], Error>,
) -> Checked {
    if !is_there {
        return demand(filled.is_err(), || format!("{row:?} is filled"));
    }
    let mut wanted = [(); 3].map(|()| Vec::new());
    for site in row.clone() {
        for (slice, x) in wanted.iter_mut().zip(place(site)?) {
            slice.push(x.nearest::<f64>());
        }
    }
    if wanted.iter().flatten().any(Option::is_none) {
        let refused = matches!(filled, Err(Error::Overflow { .. }));
        return demand(refused, || {
            format!("{row:?}: {filled:?}, but a value overflows")
        });
    }
    let filled = filled?.map(|slice| slice.into_iter().map(Some).collect());
    same("a row of places", &filled, &wanted)
}

/// The contact point is one radius away from the centres of both spheres.
fn touches(packing: &Packing<'_>, site: Site, direction: Direction) -> Checked {
    let point = packing.contact_point(site, direction)?;
    let below = packing.pile().shape().below(site, direction);
    for sphere in [Some(site), below].into_iter().flatten() {
        let centre = packing.position(sphere)?;
        let apart = squared_distance(&centre, &point);
        let radius = packing.radius();
        same("the contact's distance²", &apart, &Some(radius * radius))?;
    }
    Ok(())
}

/// |a − b|². It is rational because along each axis both are multiples of one root. `None` if they are not.
pub fn squared_distance(a: &[Surd; 3], b: &[Surd; 3]) -> Option<BigRational> {
    let mut sum = BigRational::zero();
    for (a, b) in a.iter().zip(b) {
        let common = match (a.coefficient().is_zero(), b.coefficient().is_zero()) {
            (true, _) => b.radicand(),
            (_, true) => a.radicand(),
            _ => (a.radicand() == b.radicand()).then(|| a.radicand())?,
        };
        let difference = a.coefficient() - b.coefficient();
        sum += &difference * &difference * BigRational::from_integer(common.clone().into());
    }
    Some(sum)
}

fn squared_length(v: &[Surd; 3]) -> BigRational {
    v.iter()
        .fold(BigRational::zero(), |sum, c| sum + c.square())
}

/// The formulas in squares. Here z points up, so the ê of (1) have z = +cosθ.
struct Oracle<'a> {
    pile: &'a Pile,
    /// ê_a, ê_b, ê_c in the basis (sinθ, cosφ sinθ, cosθ): (s, 1, 1), (s, −1, 1), (−1, 0, 1).
    directions: [[BigRational; 3]; 3],
    /// The increments of a sphere, in mg/(W cosθ): 1, 1, 2s.
    increments: [BigRational; 3],
    /// The squares of the basis.
    lengths: [BigRational; 3],
    /// The squares of the basis over cosθ.
    forces: [BigRational; 3],
    /// 2R.
    diameter: BigRational,
    /// mg.
    weight: BigRational,
}

impl<'a> Oracle<'a> {
    fn new(packing: &Packing<'a>, spacing: &Spacing) -> Self {
        let pile = packing.pile();
        let [zero, one, two] = [0, 1, 2].map(|n| ratio(n, 1));
        let s = pile.sin_phi();
        let (directions, sin2) = match pile.dimension() {
            Dimension::Two => (
                // Discs lie in the plane x–z.
                [[1, 0, 1], [-1, 0, 1], [0, 0, 0]].map(|e| e.map(|c| ratio(c, 1))),
                spacing.square() / ratio(4, 1),
            ),
            Dimension::Three => (
                [
                    [s.clone(), one.clone(), one.clone()],
                    [s.clone(), -&one, one.clone()],
                    [-&one, zero, one.clone()],
                ],
                spacing.square() / ratio(3, 1),
            ),
        };
        let cos2 = &one - &sin2;
        let across = (&one - s * s) * &sin2;
        let lengths = [sin2, across, cos2.clone()];
        Self {
            pile,
            directions,
            increments: [one.clone(), one, &two * s],
            forces: lengths.clone().map(|square| square / &cos2),
            lengths,
            diameter: packing.radius() * two,
            weight: packing.mass() * packing.gravity(),
        }
    }

    /// The numbers of spheres above on the three lines (paper, (9)).
    fn counts(site: Site) -> [BigRational; 3] {
        [site.k - site.i - site.j, site.i, site.j].map(integer)
    }

    /// 2R·(−Σ N ê) along x and y, and the number of layers below along z.
    fn position(&self, site: Site) -> [Value; 3] {
        let [x, y, _] = self.combination(&Self::counts(site));
        let height = integer(self.pile.layers() - 1 - site.k);
        roots(&[-x, -y, height], &self.diameter, &self.lengths)
    }

    /// (N + 1) w · mg/W, which is the magnitude times cosθ.
    fn vertical(&self, site: Site, direction: Direction) -> BigRational {
        let m = direction.index();
        let multiple = (&Self::counts(site)[m] + integer(1)) * &self.increments[m];
        multiple * &self.weight / self.sum()
    }

    fn contact(&self, site: Site, direction: Direction) -> Value {
        let [.., cos2] = &self.lengths;
        Value::root(&self.vertical(site, direction), &cos2.recip())
    }

    fn contact_vector(&self, site: Site, direction: Direction) -> [Value; 3] {
        let e = &self.directions[direction.index()];
        roots(e, &self.vertical(site, direction), &self.forces)
    }

    /// −Σ N w ê along x and y. Along z, the weight of the sphere and its load.
    fn on_floor(&self, site: Site) -> [Value; 3] {
        let mut above = Self::counts(site);
        for (force, increment) in above.iter_mut().zip(&self.increments) {
            *force *= increment;
        }
        let [x, y, _] = self.combination(&above);
        let carried = above.iter().fold(self.sum(), |sum, force| sum + force);
        let unit = &self.weight / self.sum();
        roots(&[-x, -y, carried], &unit, &self.forces)
    }

    /// W.
    fn sum(&self) -> BigRational {
        let [alpha, beta, gamma] = &self.increments;
        alpha + beta + gamma
    }

    fn combination(&self, coefficients: &[BigRational; 3]) -> [BigRational; 3] {
        core::array::from_fn(|axis| {
            let terms = coefficients.iter().zip(&self.directions);
            terms.fold(BigRational::zero(), |sum, (c, e)| sum + c * &e[axis])
        })
    }
}

/// Coefficients in a unit, times the roots of the basis.
fn roots(
    coefficients: &[BigRational; 3],
    unit: &BigRational,
    squares: &[BigRational; 3],
) -> [Value; 3] {
    core::array::from_fn(|axis| Value::root(&(&coefficients[axis] * unit), &squares[axis]))
}

/// Every component has the expected value and is rounded correctly.
fn agree(got: &[Surd; 3], want: &[Value; 3]) -> Checked {
    got.iter().zip(want).try_for_each(|(x, v)| nearest(x, v))
}

fn integer(n: i128) -> BigRational {
    BigRational::from_integer(n.into())
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::power;

    /// An oracle with a tiny error of an angle, a size, a weight or an increment.
    #[test]
    fn a_tiny_error_of_the_geometry_is_caught() {
        let pile = Pile::isosceles(10_i128.pow(30), ratio(2, 5)).unwrap();
        let spacing = Spacing::new(ratio(6, 5)).unwrap();
        let packing = Packing::new(&pile, &spacing).unwrap();
        let site = Site {
            i: 5,
            j: 7,
            k: 1 << 90,
        };
        let force = packing.contact_vector(site, Direction::Gamma).unwrap();
        let centre = packing.position(site).unwrap();
        let judge = |oracle: &Oracle<'_>| {
            agree(&force, &oracle.contact_vector(site, Direction::Gamma)).is_ok()
                && agree(&centre, &oracle.position(site)).is_ok()
        };
        let right = || Oracle::new(&packing, &spacing);
        assert!(judge(&right()));
        let trace = power(10, -40);
        let faults: [fn(&mut Oracle<'_>, &BigRational); 6] = [
            |oracle, trace| oracle.lengths[0] += trace,
            |oracle, trace| oracle.forces[0] += trace,
            |oracle, trace| oracle.directions[2][0] += trace,
            |oracle, trace| oracle.increments[2] += trace,
            |oracle, trace| oracle.diameter += trace,
            |oracle, trace| oracle.weight += trace,
        ];
        for fault in faults {
            let mut wrong = right();
            fault(&mut wrong, &trace);
            assert!(!judge(&wrong));
        }
    }

    #[test]
    fn a_mirrored_vector_is_caught() {
        let pile = Pile::triangular(9).unwrap();
        let spacing = Spacing::new(ratio(1, 1)).unwrap();
        let packing = Packing::new(&pile, &spacing).unwrap();
        let oracle = Oracle::new(&packing, &spacing);
        let [x, y, z] = packing
            .contact_vector(Site::APEX, Direction::Alpha)
            .unwrap();
        let want = oracle.contact_vector(Site::APEX, Direction::Alpha);
        assert!(agree(&[x.clone(), y.clone(), z.clone()], &want).is_ok());
        assert!(agree(&[x, -y, z], &want).is_err());
    }

    #[test]
    fn a_misplaced_contact_point_is_caught() {
        let [a, b] = [ratio(1, 1), ratio(1, 1) + power(10, -40)].map(Surd::from);
        let at = |x: &Surd| [x.clone(), Surd::zero(), Surd::zero()];
        let origin = at(&Surd::zero());
        assert_eq!(squared_distance(&origin, &at(&a)), Some(ratio(1, 1)));
        assert_ne!(squared_distance(&origin, &at(&b)), Some(ratio(1, 1)));
    }
}
