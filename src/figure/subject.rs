//! What a figure is of: a pile with a spacing, and the units of its forces and lengths.

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::One;

use crate::geometry::{Spacing, Vector, square_per_sin2};
use crate::lattice::{Dimension, Direction, Site};
use crate::scalar::{Ring, Surd};
use crate::{Error, Packing, Pile};

/// A pile as figures measure it.
///
/// # Examples
/// ```
/// use cannonpile::figure::{BaseMap, Subject};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let (pile, spacing) = (Pile::triangular(10)?, Spacing::new(BigRational::new(6.into(), 5.into()))?);
/// let in_mg = Subject::of_pile(&pile, &spacing)?;
/// assert_eq!(BaseMap::new(&in_mg)?.cells[0].value, 4.0);
///
/// let packing = Packing::new(&pile, &spacing)?;
/// let in_newtons = Subject::of_packing(packing.with_gravity(BigRational::new(981.into(), 100.into()))?);
/// assert_eq!(BaseMap::new(&in_newtons)?.cells[0].value, 39.24);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Subject<'p> {
    packing: Packing<'p>,
    si: bool,
}

impl<'p> Subject<'p> {
    /// In multiples of R, of mg, and for shear of mg·tanθ.
    ///
    /// # Errors
    /// Those of [`Packing::new`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{BaseMap, Shear, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let subject = Subject::of_pile(&pile, &spacing)?;
    /// assert_eq!((BaseMap::new(&subject)?.unit, Shear::new(&subject)?.unit), ("mg", "mg·tanθ"));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn of_pile(pile: &'p Pile, spacing: &Spacing) -> Result<Self, Error> {
        Ok(Self {
            packing: Packing::new(pile, spacing)?,
            si: false,
        })
    }

    /// In metres and newtons.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::{BaseMap, Shear, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let subject = Subject::of_packing(packing);
    /// assert_eq!((BaseMap::new(&subject)?.unit, Shear::new(&subject)?.unit), ("N", "N"));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn of_packing(packing: Packing<'p>) -> Self {
        Self { packing, si: true }
    }

    /// The spheres with their sizes and weights; 1 each, if they are the units.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::Subject;
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let subject = Subject::of_pile(&pile, &spacing)?;
    /// assert_eq!(subject.packing().radius().to_string(), "1");
    /// assert_eq!(subject.packing().sphere_weight().to_string(), "1");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn packing(&self) -> &Packing<'p> {
        &self.packing
    }

    /// The pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::Subject;
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// assert_eq!(Subject::of_pile(&pile, &spacing)?.pile().layers(), 10);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn pile(&self) -> &'p Pile {
        self.packing.pile()
    }

    pub(super) fn is_of_discs(&self) -> bool {
        self.pile().dimension() == Dimension::Two
    }

    /// The unit of forces.
    pub(super) fn force_unit(&self) -> &'static str {
        if self.si { "N" } else { "mg" }
    }

    /// f₀.
    pub(super) fn unit_force(&self) -> &'static str {
        match (self.pile().dimension(), self.pile().is_regular()) {
            (Dimension::Two, _) => "mg/(2 cosθ)",
            (Dimension::Three, true) => "mg/(3 cosθ)",
            (Dimension::Three, false) => "mg/(2(1+sinφ) cosθ)",
        }
    }

    /// The unit of shears.
    pub(super) fn shear_unit(&self) -> &'static str {
        if self.si { "N" } else { "mg·tanθ" }
    }

    /// The unit of lengths.
    pub(super) fn length_unit(&self) -> &'static str {
        if self.si { "m" } else { "R" }
    }

    /// The radius in the unit of lengths.
    pub(super) fn radius(&self) -> Result<f64, Error> {
        nearest(&self.packing.radius().clone().into(), "the radius")
    }

    /// A shear from newtons into its unit, exactly.
    pub(super) fn shear(&self, newtons: Surd) -> Surd {
        if self.si {
            return newtons;
        }
        match self.packing.inclination().tan().checked_recip() {
            Some(cot) => newtons * &cot,
            // θ is positive.
            None => newtons,
        }
    }

    /// Where a sphere is from another, in R: x and y the paper's, z up. As exact for sites 10³⁰ from the apex.
    pub(super) fn from(&self, origin: Site, site: Site) -> Result<[f64; 3], Error> {
        let statics = self.packing.forces();
        let apart = statics.position(site)? - &statics.position(origin)?;
        self.in_radii(Vector {
            z: -apart.z,
            ..apart
        })
    }

    /// The unit vector from the sphere below `site` in a direction to `site`, z up.
    pub(super) fn contact(&self, site: Site, direction: Direction) -> Result<[f64; 3], Error> {
        let along = self.packing.forces().contact_direction(site, direction)?;
        // Centres are 2R apart.
        let half = BigRational::new(1.into(), 2.into());
        self.in_radii(
            Vector {
                z: -along.z,
                ..along
            }
            .scaled(&half),
        )
    }

    /// The steps i → i+1 and j → j+1 in a layer, in R; of discs the second is as long, across their plane.
    pub(super) fn steps(&self) -> Result<[[f64; 3]; 2], Error> {
        let [a, b, c] = self.pile().directions::<BigRational>();
        let i = self.in_radii(a.clone() - &b)?;
        if self.is_of_discs() {
            return Ok([i, [0.0, i[0], 0.0]]);
        }
        Ok([i, self.in_radii(a - &c)?])
    }

    /// A vector in 2R and the symbolic basis, in R.
    pub(super) fn in_radii(&self, vector: Vector<BigRational>) -> Result<[f64; 3], Error> {
        let two = BigRational::from_i128(2);
        let [x, y, z] = self.packing.displacement(vector, &two);
        Ok([
            nearest(&x, "a position")?,
            nearest(&y, "a position")?,
            nearest(&z, "a position")?,
        ])
    }

    /// The pile in a line: its layers, how they are stacked, what is on it, how far apart the spheres are.
    pub(super) fn caption(&self) -> String {
        const LONGEST: usize = 24;
        let pile = self.pile();
        let layers = pile.layers();
        let mut parts = vec![counted(&layers.into(), "layer")];
        let shape = pile.shape();
        if self.is_of_discs() {
            parts.push("discs".into());
        } else {
            let stacking = shape.stacking();
            let name = stacking.name().map_or_else(
                || {
                    let spelled = stacking.to_string();
                    let mut short: String = spelled.chars().take(LONGEST).collect();
                    if short.len() < spelled.len() {
                        short.push('…');
                    }
                    short
                },
                str::to_uppercase,
            );
            if layers > 1 {
                parts.push(name);
            }
        }
        if !pile.is_regular() && !self.is_of_discs() {
            parts.push(format!("sin φ = {}", brief(&pile.sin_phi().to_string())));
        }
        if pile.is_weightless() {
            parts.push("spheres without weight".into());
        }
        let mut loads = pile.loading().loads();
        match (loads.len(), loads.next()) {
            (1, Some((Site { i, j, k }, load))) => {
                let place = if self.is_of_discs() {
                    format!("{k},{i}")
                } else {
                    format!("{k},{i},{j}")
                };
                parts.push(brief(&format!("{load} mg on {place}")));
            }
            (0, _) => {}
            (count, _) => parts.push(counted(&count.into(), "load")),
        }
        let square = self.packing.inclination().sin2() * square_per_sin2(pile.dimension());
        if let Ok(spacing) = Spacing::from_square(square) {
            parts.push(format!("a/R = {}", brief(&spacing.ratio().to_string())));
        }
        parts.join(", ")
    }
}

/// A text that is not too long.
pub(super) fn brief(text: &str) -> String {
    const LONGEST: usize = 20;
    if text.chars().count() <= LONGEST {
        return text.into();
    }
    let mut short: String = text.chars().take(LONGEST - 1).collect();
    short.push('…');
    short
}

/// `1 layer`, `10 layers`.
pub(super) fn counted(count: &num_bigint::BigInt, noun: &str) -> String {
    let plural = if count.is_one() { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// The nearest float.
pub(super) fn nearest(number: &Surd, quantity: &'static str) -> Result<f64, Error> {
    number.nearest::<f64>().ok_or(Error::Overflow {
        quantity,
        scalar: "f64",
    })
}

/// Refuses what nobody could tell apart on a page.
pub(super) fn readable(
    marks: &BigUint,
    limit: u32,
    what: &'static str,
    remedy: &'static str,
) -> Result<(), Error> {
    if marks > &limit.into() {
        return Err(Error::TooManyMarks {
            marks: marks.clone(),
            what,
            limit,
            remedy,
        });
    }
    Ok(())
}
