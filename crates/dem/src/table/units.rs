//! The units of a table: multiples of mg and f₀, or newtons and metres.

use num_rational::BigRational;
use num_traits::Signed;

use super::rows::Column;
use crate::Error;
use cannonpile::lattice::Dimension;
use cannonpile::scalar::{CorrectlyRounded, Surd};
use cannonpile::shape::Selection;
use cannonpile::{FloorForce, Forces, Layers, Method, Nearest, Packing, Pile, Places};

/// The units of a table.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Units<'p> {
    /// Multiples of f₀, mg and mg·tanθ, which are rational for every spacing.
    Pile(Box<Forces<'p, BigRational>>),
    /// Newtons and metres, for radius, mass and gravity in SI units.
    Si(Box<Packing<'p>>),
}

impl<'p> Units<'p> {
    /// Returns the units in which all forces are rational: f₀, mg and mg·tanθ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::table;
    /// use cannonpile_dem::table::Units;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let table = table::contacts(&Units::of_pile(&pile), Selection::All)?;
    /// assert_eq!(table.columns()[4].unit, "mg/(3cosθ)");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn of_pile(pile: &'p Pile) -> Self {
        Self::Pile(Box::new(pile.forces()))
    }

    /// Returns newtons and metres, for radius, mass and gravity in SI units.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table;
    /// use cannonpile_dem::table::Units;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let units = Units::of_packing(Packing::new(&pile, &spacing)?);
    /// assert_eq!(table::base(&units, Selection::Base)?.columns()[2].unit, "N");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn of_packing(packing: Packing<'p>) -> Self {
        Self::Si(Box::new(packing))
    }

    /// Returns the pile.
    #[doc(hidden)]
    #[must_use]
    pub fn pile(&self) -> &'p Pile {
        self.forces().pile()
    }

    /// Returns the forces in pile units. Forces in SI units are computed from them.
    pub(super) fn forces(&self) -> &Forces<'p, BigRational> {
        match self {
            Self::Pile(forces) => forces,
            Self::Si(packing) => packing.forces(),
        }
    }

    /// Returns the layers of a selection, with correctly rounded floats.
    pub(super) fn layers<F: CorrectlyRounded>(
        &self,
        part: Selection,
    ) -> Result<Layers<'p, Nearest<F>>, Error> {
        match self {
            Self::Pile(forces) => Ok(forces.layers(part)?.nearest()?),
            Self::Si(packing) => Ok(packing.layers(part)?),
        }
    }

    /// Returns the positions of centres and contacts; `None` in pile units.
    pub(super) fn places<F: CorrectlyRounded>(&self) -> Option<Places<'p, F>> {
        match self {
            Self::Pile(_) => None,
            Self::Si(packing) => Some(packing.places()),
        }
    }

    /// Returns the magnitude of a contact force, from its multiple of f₀.
    pub(super) fn contact(&self, multiple: BigRational) -> Surd {
        match self {
            Self::Pile(_) => Surd::from_reduced(multiple),
            Self::Si(packing) => packing.unit_force().scaled(&multiple),
        }
    }

    /// Returns the force of a bottom sphere on the floor, from its multiples.
    pub(super) fn on_floor(&self, force: FloorForce<BigRational>) -> FloorForce<Surd> {
        match self {
            Self::Pile(_) => force.map(Surd::from_reduced),
            Self::Si(packing) => packing.floor_force_in_si(force),
        }
    }

    /// Returns the stress of a sphere times its volume, from its multiples.
    pub(super) fn stress(&self, multiples: [BigRational; 6]) -> [Surd; 6] {
        match self {
            Self::Pile(_) => multiples.map(Surd::from_reduced),
            Self::Si(packing) => packing.stress_in_si(&multiples),
        }
    }

    pub(super) fn stress_columns(&self) -> [Column; 6] {
        let [xx, zz, xy, xz, yz] = match self {
            Self::Si(_) => ["N·m"; 5],
            Self::Pile(_) if self.pile().is_regular() => [
                "mgR·sinθ·tanθ",
                "mgR·cosθ",
                "√3·mgR·sinθ·tanθ",
                "mgR·sinθ",
                "√3·mgR·sinθ",
            ],
            Self::Pile(_) => [
                "mgR·sinθ·tanθ",
                "mgR·cosθ",
                "2cosφ·mgR·sinθ·tanθ",
                "mgR·sinθ",
                "2cosφ·mgR·sinθ",
            ],
        };
        [
            Column::measured("stress_xx", xx),
            Column::measured("stress_yy", xx),
            Column::measured("stress_zz", zz),
            Column::measured("stress_xy", xy),
            Column::measured("stress_xz", xz),
            Column::measured("stress_yz", yz),
        ]
    }

    /// Returns an upper bound of the stress times volume. A sphere has at most twelve contacts, and each
    /// adds at most its force to a multiple. A disc has at most six, and each adds at most twice its force. In SI units each
    /// contact adds at most R times its force.
    pub(super) fn greatest_stress(&self) -> Surd {
        let contacts = BigRational::from_integer(12.into());
        let force = self.greatest_force().scaled(&contacts);
        match self {
            Self::Pile(_) => force,
            Self::Si(packing) => force.scaled(packing.radius()),
        }
    }

    /// Returns an upper bound of all forces.
    ///
    /// Let S be the sum of |w| + 2|x| + 4|y| over all weights and loads (w, x, y), and H the sum of all forces of horizontal
    /// contacts. In mg or f₀, the root of the sum of the squared forces of a layer is at most 3S + 2√2·H.
    pub(super) fn greatest_force(&self) -> Surd {
        let horizontal = self.pile().horizontal_forces();
        let horizontal: BigRational = horizontal.map(|(_, force)| force).sum();
        let sources = sources(self.pile()) + horizontal * BigRational::from_integer(2.into());
        let bound = sources * BigRational::from_integer(3.into());
        match self {
            Self::Pile(_) => bound.into(),
            // f₀ is mg times at most 1/cosθ, and shear has the factor tanθ.
            Self::Si(packing) => {
                let unit = packing.sphere_weight() * bound;
                let cos2 = packing.inclination().cos2();
                // 1/cosθ and tanθ are at most 1/cos²θ, which is rational.
                (unit / cos2).into()
            }
        }
    }

    #[doc(hidden)]
    #[must_use]
    pub fn force(&self) -> &'static str {
        match self {
            Self::Si(_) => "N",
            Self::Pile(_) if self.pile().dimension() == Dimension::Two => "mg/(2cosθ)",
            Self::Pile(_) if self.pile().is_regular() => "mg/(3cosθ)",
            Self::Pile(_) => "mg/(2(1+sinφ)cosθ)",
        }
    }

    #[doc(hidden)]
    #[must_use]
    pub fn normal(&self) -> &'static str {
        if let Self::Si(_) = self { "N" } else { "mg" }
    }

    #[doc(hidden)]
    #[must_use]
    pub fn shear_x(&self) -> &'static str {
        if let Self::Si(_) = self {
            "N"
        } else {
            "mg·tanθ"
        }
    }

    #[doc(hidden)]
    #[must_use]
    pub fn shear_y(&self) -> &'static str {
        match self {
            Self::Si(_) => "N",
            Self::Pile(_) if self.pile().is_regular() => "√3·mg·tanθ",
            Self::Pile(_) => "2cosφ·mg·tanθ",
        }
    }
}

/// The units of forces with friction, on a rough floor.
impl Units<'_> {
    pub(super) fn tangential(&self) -> &'static str {
        match self {
            Self::Si(_) => "N",
            Self::Pile(_) => "mg·tan(θ/2)",
        }
    }

    pub(super) fn friction_y(&self) -> &'static str {
        match self {
            Self::Si(_) => "N",
            Self::Pile(_) if self.pile().is_regular() => "√3·mg·tan(θ/2)",
            Self::Pile(_) => "2cosφ·mg·tan(θ/2)",
        }
    }

    /// The unit of a coefficient of friction.
    pub(super) fn half_angle(&self) -> &'static str {
        match self {
            Self::Si(_) => "",
            Self::Pile(_) => "tan(θ/2)",
        }
    }
}

impl Units<'_> {
    /// Returns these units with a fixed method for all answers.
    ///
    /// # Errors
    /// As for [`Forces::with_method`](cannonpile::Forces::with_method).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::Units;
    /// use cannonpile::{Method, Pile};
    ///
    /// let pile = Pile::discs(5)?;
    /// assert!(Units::of_pile(&pile).with_method(Method::Sweep).is_err());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn with_method(self, method: Method) -> Result<Self, Error> {
        Ok(match self {
            Self::Pile(forces) => Self::Pile(Box::new(forces.with_method(method)?)),
            Self::Si(packing) => Self::Si(Box::new(packing.with_method(method)?)),
        })
    }

    #[doc(hidden)]
    /// Returns the method of all answers, if one was chosen.
    #[must_use]
    pub fn method(&self) -> Option<Method> {
        self.forces().method()
    }
}

/// Returns the sum of |w| + 2|x| + 4|y| over all weights and loads (w, x, y).
fn sources(pile: &Pile) -> BigRational {
    let two = || BigRational::from_integer(2.into());
    let horizontal = |[x, y]: [&BigRational; 2]| (x.abs() + y.abs() * two()) * two();
    let loads = pile.loads();
    let aside: BigRational = loads.map(|(_, load)| horizontal([&load.x, &load.y])).sum();
    // The loads have no tilt, so this bound is not sharp.
    let tilt = BigRational::from_integer(1.into()) + horizontal(pile.tilt().each_ref());
    pile.weight() * tilt + aside
}

#[cfg(test)]
mod tests {
    use super::*;
    use cannonpile::Load;
    use cannonpile::lattice::{Region, Site};

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    /// Straight piles, piles with sign changes, discs, piles with heavy or loaded spheres, and tilted ones.
    fn piles() -> [Pile; 9] {
        let swept = || Pile::under(Region::SITE, "+-+-".parse().unwrap()).unwrap();
        let site = Site { i: 0, j: 0, k: 2 };
        let push = Load {
            down: ratio(0, 1),
            x: ratio(-1000, 1),
            y: ratio(900, 1),
        };
        [
            Pile::triangular(4).unwrap(),
            Pile::isosceles(4, ratio(2, 5)).unwrap(),
            Pile::discs(5).unwrap(),
            swept(),
            swept().with_load(site, ratio(1000, 1)).unwrap(),
            swept().with_weight(site, ratio(1000, 1)).unwrap(),
            swept().with_tilt([ratio(-7, 1), ratio(9, 2)]).unwrap(),
            Pile::isosceles(4, ratio(3, 5))
                .unwrap()
                .with_tilt([ratio(1, 8), ratio(40, 1)])
                .unwrap(),
            swept().with_load(site, push).unwrap(),
        ]
    }

    #[test]
    fn bounds_exceed_all_forces_of_a_selection() {
        for pile in piles() {
            let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
            let [in_pile, in_si] = [Units::of_pile(&pile), Units::of_packing(packing.clone())];
            let layers = (0..pile.layers()).map(Selection::Layer);
            for part in layers.chain([Selection::All, Selection::Base]) {
                let [of_pile, of_si] = [&in_pile, &in_si].map(Units::greatest_force);
                for contact in pile.forces::<BigRational>().contacts(part).unwrap() {
                    let contact = contact.unwrap();
                    assert!(
                        of_pile >= Surd::from(contact.force.abs()),
                        "{pile:?} {part:?}"
                    );
                    let packed = packing.contact_in_si(contact).unwrap();
                    let [x, y, z] = packed.vector;
                    for force in [packed.force, x, y, z] {
                        assert!(of_si >= force && of_si >= -force, "{pile:?} {part:?}");
                    }
                }
                for stress in pile.forces::<BigRational>().stresses(part).unwrap() {
                    let stress = stress.unwrap();
                    for units in [&in_pile, &in_si] {
                        let bound = units.greatest_stress();
                        for part in units.stress(stress.clone()) {
                            assert!(bound >= part && bound >= -part, "{pile:?}");
                        }
                    }
                }
                let Ok(base) = pile.forces::<BigRational>().base(part) else {
                    continue;
                };
                for force in base {
                    for (units, bound) in [(&in_pile, &of_pile), (&in_si, &of_si)] {
                        let force = units.on_floor(force.clone().unwrap());
                        for force in [force.normal, force.shear_x, force.shear_y] {
                            assert!(*bound >= force && *bound >= -force, "{pile:?} {part:?}");
                        }
                    }
                }
            }
        }
    }
}
