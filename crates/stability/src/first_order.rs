//! The change of all forces if contacts become longer or shorter, to first order.

use core::num::NonZeroI64;

use cannonpile::each::Each;
use cannonpile::engine::{bug, check_interrupt, copies, equality};
use cannonpile::formula::{disc_load_increments, load_increments};
use cannonpile::geometry::{Load, Vector, square_across};
use cannonpile::lattice::{Direction, Sign, Site};
use cannonpile::scalar::{Field, Ring};
use cannonpile::shape::Selection;
use cannonpile::{Error, Packing};
use num_rational::BigRational;

// The compiler evaluates the `unwrap`, and rejects zero.
const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();

/// A contact force, and its change to first order.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ForceChange<T = BigRational> {
    /// The upper sphere of the contact.
    pub site: Site,
    /// The direction of the contact.
    pub direction: Direction,
    /// The numbers of the upper and of the lower sphere, counted from 0 in the order of tables.
    pub spheres: [usize; 2],
    /// The force among equal spheres, in f₀.
    pub force: T,
    /// The change of the force, in f₀.
    pub change: T,
    /// The change of the direction of the contact, which points from the lower sphere to the upper one.
    pub turn: Vector<T>,
}

equality!(ForceChange<T>, T: Ring; |Self { site, direction, spheres, turn, force, change }| (site, direction, spheres, turn,
    [force, change].map(Ring::comparison_key)));

/// A pile of which all contacts may become longer or shorter.
///
/// The centres of the bottom layer stay where they are, and so do all weights. The forces of horizontal contacts act like
/// loads, and do not change. Lengths are in units of 2R, the distance of two centres. Let e be the elongation of a contact.
///
/// 1. *Places.* The displacements u satisfy ê·(u_upper − u_lower) = e. From the bottom up, each sphere has as many of these
///    equations as there are dimensions.
/// 2. *Directions.* A contact turns by dê = (u_upper − u_lower) − ê·e.
/// 3. *Forces.* The old forces along the turned contacts leave a force Σ f dê on each sphere. The change of the forces is
///    the response to these forces as loads, from the top down.
///
/// All changes are rational if (a/R)², the forces and the elongations are.
#[derive(Clone, Debug)]
pub struct FirstOrder<T> {
    directions: &'static [Direction],
    /// The rows of spheres above the floor, from the top.
    rows: Vec<Row>,
    spheres: usize,
    /// The forces of the contacts along each direction, by the number of the upper sphere.
    forces: [Vec<T>; 3],
    rays: [Vector<T>; 3],
    /// sin²θ, 4cos²φ·sin²θ and cos²θ: the squares of the units of the symbolic basis.
    squares: [T; 3],
    s: T,
    /// W.
    increment_sum: T,
}

/// A row of spheres. Their numbers are consecutive, and so are those of the spheres below along each direction.
#[derive(Clone, Debug)]
struct Row {
    first: Site,
    sign: Sign,
    length: usize,
    /// The number of the first sphere.
    upper: usize,
    /// The numbers of the spheres below the first sphere.
    below: [usize; 3],
}

impl<T: Field> FirstOrder<T> {
    /// Returns the pile of a packing, with its forces in f₀ as [`Layers::fill`](cannonpile::Layers::fill) writes them.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if the spheres do not fit in memory. [`Error::Length`] unless each direction has one force
    /// for each sphere above the floor. For discs the third list is not read.
    ///
    /// # Examples
    /// If the whole pile shrinks, no force changes but by the floor, which does not.
    /// ```
    /// use cannonpile::{Error, Packing, Pile};
    /// use cannonpile_stability::FirstOrder;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let pile = FirstOrder::new(&packing, [vec![1.0], vec![1.0], vec![1.0]])?;
    /// // The apex sinks, so its contacts are flatter, and press more.
    /// pile.changes(|_, _| -0.01, |contact| {
    ///     assert!(contact.change > 0.0);
    ///     Ok::<(), Error>(())
    /// })?;
    /// # Ok::<(), Error>(())
    /// ```
    pub fn new(packing: &Packing<'_>, forces: [Vec<T>; 3]) -> Result<Self, Error> {
        let (pile, inclination) = (packing.pile(), packing.inclination());
        let numbering = pile.numbering()?;
        let spheres = few(numbering.sphere_count())?;
        let directions = pile.dimension().directions();
        let (mut rows, mut upper) = (Vec::new(), 0);
        for row in pile.rows(Selection::All)?.off_the_floor() {
            let (k, j, i) = (row.k, row.j, row.i.start);
            let first = Site { i, j, k };
            let mut below = [upper; 3];
            for (below, direction) in below.iter_mut().zip(directions) {
                let lower = pile.shape().below(first, *direction);
                *below = few(numbering.id(lower.ok_or_else(|| bug(SUPPORTED))?)? - 1)?;
            }
            let sign = pile.shape().sign_below(k);
            let sign = sign.ok_or_else(|| bug(SUPPORTED))?;
            let length = usize::try_from(row.i.end - i)
                .map_err(|_| bug("a row has at most as many spheres as the pile"))?;
            rows.push(Row {
                first,
                sign,
                length,
                upper,
                below,
            });
            upper += length;
        }
        for line in &forces[..directions.len()] {
            if line.len() != upper {
                return Err(Error::Length {
                    needed: upper,
                    given: line.len(),
                });
            }
        }
        let (sin2, cos2) = (inclination.sin2(), inclination.cos2());
        let across = square_across(pile.sin_phi()) * sin2;
        Ok(Self {
            directions,
            rows,
            spheres,
            forces,
            rays: pile.directions(),
            squares: [sin2.clone(), across, cos2].each(|square| T::from_rational(&square)),
            s: T::from_rational(pile.sin_phi()),
            increment_sum: pile.forces::<T>().increment_sum()?,
        })
    }

    /// Calls `look` with each contact, in the order of tables. `elongation` returns the elongation of a contact, in units
    /// of 2R, from its force and the numbers of its spheres.
    ///
    /// # Errors
    /// [`Error::Overflow`]; those of `look`.
    ///
    /// # Examples
    /// See [`new`](Self::new).
    pub fn changes<E: From<Error>>(
        &self,
        elongation: impl Fn(&T, [usize; 2]) -> T,
        mut look: impl FnMut(ForceChange<T>) -> Result<(), E>,
    ) -> Result<(), E> {
        let moved = self.displacements(&elongation)?;
        // The sum of the changed forces on each sphere, from the contacts above.
        let mut above = copies(Vector::zero(), self.spheres, QUANTITY)?;
        for row in &self.rows {
            check_interrupt()?;
            let rays = self.rays(row.sign);
            for n in 0..row.length {
                let (upper, below) = (row.upper + n, row.below.each(|first| first + n));
                let mut on_upper = core::mem::replace(&mut above[upper], Vector::zero());
                let mut turns = [(); 3].each(|()| Vector::zero());
                for line in 0..self.directions.len() {
                    let force = &self.forces[line][upper];
                    let longer = elongation(force, [upper, below[line]]);
                    turns[line] = moved[upper].clone()
                        - &moved[below[line]]
                        - &rays[line].clone().scaled(&longer);
                    on_upper = on_upper + &turns[line].clone().scaled(force);
                }
                let changes = self.response(on_upper, row.sign)?;
                for (line, (change, turn)) in changes.into_iter().zip(turns).enumerate() {
                    let Some(direction) = self.directions.get(line) else {
                        break;
                    };
                    let force = self.forces[line][upper].clone();
                    let lower = &mut above[below[line]];
                    let on_lower = core::mem::replace(lower, Vector::zero());
                    *lower = on_lower
                        - &rays[line].clone().scaled(&change)
                        - &turn.clone().scaled(&force);
                    look(ForceChange {
                        site: Site {
                            i: row.first.i + n as i128,
                            ..row.first
                        },
                        direction: *direction,
                        spheres: [upper, below[line]],
                        force,
                        change,
                        turn,
                    })?;
                }
            }
        }
        Ok(())
    }

    /// Returns the square of the length of a vector.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Vector;
    /// use cannonpile::{Error, Packing, Pile};
    /// use cannonpile_stability::FirstOrder;
    ///
    /// let pile = Pile::discs(1)?;
    /// let pile = FirstOrder::new(&Packing::new(&pile, &"6/5".parse()?)?, [const { Vec::<f64>::new() }; 3])?;
    /// // cosθ is 4/5.
    /// assert!((pile.square(&Vector { x: 0.0, y: 0.0, z: 1.0 }) - 0.64).abs() < 1e-15);
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn square(&self, vector: &Vector<T>) -> T {
        self.product(vector, vector)
    }

    /// Returns the displacements of all spheres, from the bottom up.
    fn displacements(
        &self,
        elongation: &impl Fn(&T, [usize; 2]) -> T,
    ) -> Result<Vec<Vector<T>>, Error> {
        let mut moved = copies(Vector::zero(), self.spheres, QUANTITY)?;
        for row in self.rows.iter().rev() {
            check_interrupt()?;
            let rays = self.rays(row.sign);
            for n in 0..row.length {
                let upper = row.upper + n;
                let mut along = [(); 3].each(|()| T::zero());
                for line in 0..self.directions.len() {
                    let lower = row.below[line] + n;
                    let longer = elongation(&self.forces[line][upper], [upper, lower]);
                    along[line] = self.product(&rays[line], &moved[lower]) + &longer;
                }
                moved[upper] = self.solve(along, row.sign)?;
            }
        }
        Ok(moved)
    }

    /// Returns the vector u with the given values of ê·u along the contacts above a step.
    fn solve(&self, [a, b, c]: [T; 3], sign: Sign) -> Result<Vector<T>, Error> {
        let sum = (a.clone() + &b).div_int(TWO);
        let difference = a - &b;
        // The components times the squares of their units, under a + step.
        let (x, y, up) = if self.directions.len() == 2 {
            (difference.div_int(TWO), T::zero(), sum)
        } else {
            let x = over(&(sum - &c), &(T::one() + &self.s))?;
            let up = c + &x;
            (x, difference, up)
        };
        let [sin2, across, cos2] = &self.squares;
        let vector = Vector {
            x: over(&x, sin2)?,
            y: if y.is_zero() { y } else { over(&y, across)? },
            z: over(&-up, cos2)?,
        };
        Ok(turned(vector, sign))
    }

    /// Returns the forces along the contacts below a sphere on which a force acts.
    fn response(&self, force: Vector<T>, sign: Sign) -> Result<[T; 3], Error> {
        let in_mg = |part: T| over(&part, &self.increment_sum);
        let load = Load {
            down: in_mg(force.z)?,
            x: in_mg(force.x)?,
            y: in_mg(force.y)?,
        };
        let changes = if self.directions.len() == 2 {
            disc_load_increments(&load, sign)
        } else {
            load_increments(&load, &self.s, sign)
        };
        if changes.iter().all(T::is_defined) {
            Ok(changes)
        } else {
            Err(overflow::<T>())
        }
    }

    /// Returns the scalar product in real units.
    fn product(&self, one: &Vector<T>, other: &Vector<T>) -> T {
        let [x, y, z] = &self.squares;
        one.x.clone() * &other.x * x
            + &(one.y.clone() * &other.y * y)
            + &(one.z.clone() * &other.z * z)
    }

    /// Returns the contact directions above a step.
    fn rays(&self, sign: Sign) -> [Vector<T>; 3] {
        self.rays.clone().each(|ray| turned(ray, sign))
    }
}

const QUANTITY: &str = "the displacements of all spheres";

const SUPPORTED: &str = "a sphere above the floor has its supports";

fn few(spheres: u64) -> Result<usize, Error> {
    usize::try_from(spheres).map_err(|_| Error::TooLarge {
        quantity: QUANTITY,
        needed: spheres.into(),
        limit: usize::MAX as u64,
        remedy: "use fewer layers, or a smaller top or base",
    })
}

/// Returns a vector under a + step as it is under a step of the given sign.
fn turned<T: Ring>(vector: Vector<T>, sign: Sign) -> Vector<T> {
    match sign {
        Sign::Plus => vector,
        Sign::Minus => vector.turned_about_z(),
    }
}

fn over<T: Field>(n: &T, d: &T) -> Result<T, Error> {
    n.checked_div(d).ok_or_else(overflow::<T>)
}

fn overflow<T: Field>() -> Error {
    Error::overflow("the change of a force", T::NAME)
}
