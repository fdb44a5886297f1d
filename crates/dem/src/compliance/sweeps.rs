//! The sweep up through a pile for displacements, and the sweep down for the changes of forces.

use super::{NoCompliance, SoftContact};
use crate::error::bug;
use crate::numbered::nearest;
use crate::{Each, Error};
use cannonpile::Packing;
use cannonpile::engine::copies;
use cannonpile::lattice::{Direction, Sign, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;

/// The components x, y and z (up).
type Arrow = [f64; 3];

/// A pile on springs. Forces are in f₀, displacements in f₀/κ, changes of forces in f₀²/(κR).
pub(super) struct Sweeps {
    directions: &'static [Direction],
    /// The rows of spheres above the floor, from the top.
    strips: Vec<Strip>,
    /// The number of spheres.
    spheres: usize,
    /// F₀ of the contacts along each direction, by the number of the upper sphere, counted from 0.
    forces: [Vec<f64>; 3],
}

/// The spheres of a row. Their numbers are consecutive, and so are those of the spheres below along each direction.
struct Strip {
    first: Site,
    /// The number of the first sphere, from 0.
    upper: usize,
    /// The numbers of the spheres below the first sphere.
    below: [usize; 3],
    length: usize,
    frame: Frame,
}

/// The contact directions from a sphere to the spheres below.
#[derive(Clone, Copy)]
struct Frame {
    /// ê, from the lower sphere to the upper one. Discs have a third vector, normal to their plane, without a force.
    rays: [Arrow; 3],
    /// The dual basis of the rays: ê_m·d_n = δ_mn.
    duals: [Arrow; 3],
}

impl Sweeps {
    pub(super) fn new(packing: &Packing<'_>) -> Result<Self, NoCompliance> {
        let (pile, shape) = (packing.pile(), packing.pile().shape());
        let numbering = pile.numbering()?;
        let few = |spheres: u64| {
            let beyond =
                |_| Error::beyond_addresses("the displacements of all spheres", spheres.into());
            usize::try_from(spheres).map_err(beyond)
        };
        let spheres = few(numbering.sphere_count())?;
        let resting = few(numbering.first_on_floor() - 1)?;
        let mut forces = [zeros(resting)?, zeros(resting)?, zeros(resting)?];
        let layers = packing.forces().layers(Selection::All)?.nearest()?;
        layers.fill(forces.each_mut().each(Vec::as_mut_slice))?;
        let plus = Frame::new(packing)?;
        let minus = plus.turned();
        let directions = pile.dimension().directions();
        let mut strips = Vec::new();
        for row in pile.rows(Selection::All)?.off_the_floor() {
            let (j, k) = (row.j, row.k);
            let first = Site {
                i: row.i.start,
                j,
                k,
            };
            let number = |site: Site| few(numbering.id(site)? - 1);
            let upper = number(first)?;
            let mut below = [upper; 3];
            for (below, direction) in below.iter_mut().zip(directions) {
                let lower = shape.below(first, *direction);
                *below = number(lower.ok_or_else(|| Error::on_floor(first))?)?;
            }
            let length = usize::try_from(row.i.end - row.i.start);
            let length =
                length.map_err(|_| bug("a row has at most as many spheres as the pile"))?;
            let sign = shape.sign_below(k);
            let frame = match sign.ok_or_else(|| Error::on_floor(first))? {
                Sign::Plus => plus,
                Sign::Minus => minus,
            };
            for (forces, direction) in forces.iter().zip(directions) {
                // The columns `forces` already contain the spheres of this row.
                let slack = forces[upper..upper + length].iter().zip(row.i.clone());
                if let Some((_, i)) = slack.into_iter().find(|(force, _)| **force <= 0.0) {
                    let (site, direction) = (Site { i, j, k }, *direction);
                    return Err(NoCompliance::Slack { site, direction });
                }
            }
            strips.push(Strip {
                first,
                upper,
                below,
                length,
                frame,
            });
        }
        Ok(Self {
            directions,
            strips,
            spheres,
            forces,
        })
    }

    /// Returns u of all spheres, from the floor upwards: ê·u_upper = ê·u_lower − F₀.
    fn displacements(&self) -> Result<Vec<Arrow>, Error> {
        let mut moved = zeros(self.spheres)?;
        for strip in self.strips.iter().rev() {
            for n in 0..strip.length {
                let mut displaced = [0.0; 3];
                for line in 0..self.directions.len() {
                    // Strips are of spheres, and of three lines.
                    let (ray, force) = (strip.frame.rays[line], self.forces[line][strip.upper + n]);
                    let along = dot(&ray, &moved[strip.below[line] + n]) - force;
                    add(&mut displaced, along, &strip.frame.duals[line]);
                }
                moved[strip.upper + n] = displaced;
            }
        }
        Ok(moved)
    }

    /// Calls `look` with each contact from the top, with its coefficients in f₀. The sums of F₁ê + F₀τ over the
    /// contacts below and above a sphere are equal.
    pub(super) fn down(&self, look: &mut impl FnMut(SoftContact)) -> Result<(), Error> {
        let moved = self.displacements()?;
        // The sum of F₁ê + F₀τ above each sphere.
        let mut above: Vec<Arrow> = zeros(self.spheres)?;
        for strip in &self.strips {
            let Frame { rays, duals } = strip.frame;
            for n in 0..strip.length {
                let upper = strip.upper + n;
                // Strips are of spheres, and of three lines.
                let mut rest = above[upper];
                let mut turns = [[0.0; 3]; 3];
                for line in 0..self.directions.len() {
                    let mut apart = moved[upper];
                    add(&mut apart, -1.0, &moved[strip.below[line] + n]);
                    let along = dot(&rays[line], &apart);
                    add(&mut apart, -along, &rays[line]);
                    // F₀τ; the distance of the centres is 2R.
                    add(&mut turns[line], self.forces[line][upper] / 2.0, &apart);
                    add(&mut rest, -1.0, &turns[line]);
                }
                for (line, direction) in self.directions.iter().enumerate() {
                    let change = dot(&duals[line], &rest);
                    let mut vector = turns[line];
                    add(&mut vector, change, &rays[line]);
                    let lower = strip.below[line] + n;
                    add(&mut above[lower], 1.0, &vector);
                    let force = self.forces[line][upper];
                    look(SoftContact {
                        ids: [upper, lower].each(|number| number as u64 + 1),
                        site: Site {
                            i: strip.first.i + n as i128,
                            ..strip.first
                        },
                        direction: *direction,
                        coefficient: change / force,
                        vector_coefficient: dot(&vector, &vector).sqrt() / force,
                    });
                }
            }
        }
        Ok(())
    }
}

impl Frame {
    /// Returns the frame of a + step.
    fn new(packing: &Packing<'_>) -> Result<Self, Error> {
        let (pile, inclination) = (packing.pile(), packing.inclination());
        let root = |surd: &Surd| nearest(surd, "an angle of a contact");
        let (sin, cos) = (root(&inclination.sin())?, root(&inclination.cos())?);
        let sin_phi = nearest(&pile.sin_phi().clone().into(), "sin φ")?;
        let cos_phi = ((1.0 - sin_phi) * (1.0 + sin_phi)).sqrt();
        let rays = pile.directions::<f64>().each(|ray| {
            let [x, y, z] = ray.on(&[sin, 2.0 * cos_phi * sin, cos]);
            [x, y, -z]
        });
        let mut rays = rays;
        // Discs lie in a plane.
        for ray in rays.iter_mut().skip(pile.dimension().directions().len()) {
            *ray = [0.0, 1.0, 0.0];
        }
        Ok(Self::of(rays))
    }

    fn of(rays: [Arrow; 3]) -> Self {
        let [a, b, c] = rays;
        let volume = dot(&a, &cross(&b, &c));
        let duals = [cross(&b, &c), cross(&c, &a), cross(&a, &b)];
        Self {
            rays,
            duals: duals.each(|dual| dual.each(|x| x / volume)),
        }
    }

    /// Returns the frame of a − step, rotated by half a turn about the vertical.
    fn turned(self) -> Self {
        Self::of(self.rays.each(|[x, y, z]| [-x, -y, z]))
    }
}

/// Returns `count` zeros, or an error if memory is short.
fn zeros<T: Clone + Default>(count: usize) -> Result<Vec<T>, Error> {
    Ok(copies(
        T::default(),
        count,
        "the displacements of all spheres",
    )?)
}

fn dot(a: &Arrow, b: &Arrow) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross([a, b, c]: &Arrow, [x, y, z]: &Arrow) -> Arrow {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

fn add(to: &mut Arrow, factor: f64, what: &Arrow) {
    for (to, what) in to.iter_mut().zip(what) {
        *to += factor * what;
    }
}
