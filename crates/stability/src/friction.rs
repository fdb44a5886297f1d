//! Friction: two layers on a rough floor, without glue.

use cannonpile::each::Each;
use cannonpile::engine::{equality, product};
use cannonpile::geometry::LayerGap;
use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::{Algebra, ByValue, Surd, SurdSum};
use cannonpile::shape::Selection;
use cannonpile::{ContactForce, Error, FloorForce, Packing, Pile, formula};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// Two layers on a rough floor.
///
/// All other queries are about spheres without friction on a floor with glue. Here the lower of two layers lies on a
/// plane, and its spheres may slide and roll. Each contact transmits a force with friction, and no moment. Neighbours
/// in a layer do not touch: a > R. All loads are vertical. Then the forces are unique: they depend neither on the law
/// of the springs nor on the history.
///
/// # Forces
/// A contact transmits N along its line, and T across it, in its vertical plane. With T = N·tan(θ/2):
///
/// * The vertical part of both is N cosθ + T sinθ = N.
/// * The horizontal part of both is N sinθ − T cosθ = T. On the lower sphere it points away from the upper one.
/// * The line of action of both leads from the contact to the point where the lower sphere touches the floor. So the lower
///   sphere does not roll, and contacts superpose.
///
/// The upper sphere needs Σ N = w for its weight and loads w, and Σ N h = 0 for the horizontal directions h of its contacts.
/// These are the equations of the frictionless pile, (5) of the paper, with other units: mg/W for N instead of f₀ =
/// mg/(W cosθ), and mg·tan(θ/2) for horizontal forces instead of mg·tanθ. The numbers are the same.
///
/// | force | frictionless | on a rough floor |
/// |---|---|---|
/// | contact, along its line | f·mg/(W cosθ) | f·mg/W |
/// | contact, across its line | 0 | f·mg/W·tan(θ/2) |
/// | floor, vertical | n·mg | n·mg |
/// | floor, horizontal | h·mg·tanθ | h·mg·tan(θ/2) |
///
/// The contacts need a coefficient of friction of at least tan(θ/2) = (1 − cosθ)/sinθ, and the floor that of
/// [`floor_friction`](Self::floor_friction). With less, no forces are in equilibrium.
///
/// # Uniqueness
/// The difference of two sets of forces balances no loads.
///
/// 1. *Upper sphere.* Forces at three points balance each other only if F_l = Σ_m λ_lm (c_m − c_l), with the points c and
///    symmetric λ. All contacts of an upper sphere are at one height, so these forces are horizontal, and c_m − c_l is half
///    the vector between two neighbours of the lower layer. There is one λ for each two neighbours. It is 0 without a common
///    upper sphere.
/// 2. *Lower sphere.* Its contacts have one height too, so moments about its point on the floor give Σ F = 0, and the
///    moment of F about the vertical axis is 0. Let λ₁, …, λ₆ belong to its six neighbours in order. The first equation gives
///    λ₁ − λ₄ = λ₃ − λ₆ = λ₅ − λ₂ = κ. The second is κ·(sin 2A + sin 2B + sin 2C) = 0, with the angles A, B and C of the
///    triangle of three neighbours. The sum is 4 sin A sin B sin C > 0, so κ = 0.
/// 3. So λ is the same on opposite sides of every lower sphere: each force runs straight on. A finite layer has an end, where
///    it is 0. ∎
///
/// For discs, F is horizontal too, with one λ for each upper disc, and Σ F = 0 makes neighbouring λ equal.
///
/// The identities are the theorems `rough-contact`, `rough-floor` and `rough-unique` of the crate `cannonpile-proof`. Its
/// file `Friction.v` has the whole proof in Coq, for spheres and discs.
///
/// Three layers already have a state of self-stress. There the forces depend on the history, and no exact answer exists.
#[derive(Clone, Copy, Debug)]
pub struct RoughFloor<'p> {
    pile: &'p Pile,
}

impl<'p> RoughFloor<'p> {
    /// Returns a pile on a rough floor instead of a floor with glue, for any spacing at which neighbours of a layer do not
    /// touch, a > R.
    ///
    /// # Errors
    /// [`RoughFloor`](crate::Error::RoughFloor) unless there are two layers, gravity and all loads are vertical, and no
    /// horizontal contact has a force.
    ///
    /// # Examples
    /// Four balls: each of the three lower ones carries 1/3 mg of the upper one.
    /// ```
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Pile, ratio};
    /// use cannonpile_stability::RoughFloor;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let four = RoughFloor::new(&pile)?;
    /// // 1/3 mg along the contact, and 1/3 mg·tan(θ/2) across it.
    /// assert_eq!(four.contact::<BigRational>(Site::APEX, Direction::Alpha)?, ratio!(1/3));
    /// let floor = four.base::<BigRational>(Selection::Base)?.next().unwrap()?;
    /// assert_eq!(floor.normal, ratio!(4/3));
    /// // A floor of friction tan(θ/2)/4 is enough.
    /// assert_eq!(four.floor_friction()?.to_string(), "1/4");
    /// assert!(RoughFloor::new(&Pile::triangular(3)?).is_err());
    /// # Ok::<(), cannonpile_stability::Error>(())
    /// ```
    pub fn new(pile: &'p Pile) -> Result<Self, crate::Error> {
        let refuse = |needed, given: Box<str>| Err(crate::Error::RoughFloor { needed, given });
        let layers = pile.layers();
        if layers != 2 {
            let plural = if layers == 1 { "" } else { "s" };
            return refuse(
                "two layers (with three, the forces are not unique)",
                format!("{layers} layer{plural}").into(),
            );
        }
        if !pile.tilt().iter().all(Zero::is_zero) {
            return refuse("vertical gravity", "a tilt".into());
        }
        if let Some((site, load)) = pile.loads().find(|(_, load)| !load.is_vertical()) {
            return refuse(
                "vertical loads",
                format!("the load {load} at (i,j,k) = {site}").into(),
            );
        }
        if pile.horizontal_forces().len() > 0 {
            return refuse("no horizontal contacts", "forces of such contacts".into());
        }
        Ok(Self { pile })
    }

    /// Returns the normal force N of a contact, in mg. The tangential force is the same number, in mg·tan(θ/2).
    ///
    /// # Errors
    /// As for [`Forces::contact`](cannonpile::Forces::contact).
    ///
    /// # Examples
    /// See [`new`](Self::new).
    pub fn contact<T: Algebra>(self, site: Site, direction: Direction) -> Result<T, Error> {
        let force = self.pile.forces::<T>().contact(site, direction)?;
        Ok(force * &self.share())
    }

    /// Returns the contacts of a part of the pile. `force` is N in mg, and T in mg·tan(θ/2).
    ///
    /// # Errors
    /// As for [`Forces::contacts`](cannonpile::Forces::contacts).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use cannonpile_stability::RoughFloor;
    ///
    /// let pile = Pile::under(Region::hexagon(2, 2)?, "+".parse()?)?;
    /// let forces = RoughFloor::new(&pile)?.contacts::<f64>(Selection::All)?;
    /// assert!(forces.map(Result::unwrap).all(|contact| contact.force == 1.0 / 3.0));
    /// # Ok::<(), cannonpile_stability::Error>(())
    /// ```
    pub fn contacts<T: Algebra>(
        self,
        part: Selection,
    ) -> Result<impl Iterator<Item = Result<ContactForce<T>, Error>> + use<'p, T>, Error> {
        let share: T = self.share();
        let contacts = self.pile.forces::<T>().contacts(part)?;
        Ok(contacts.map(move |contact| {
            let contact = contact?;
            Ok(ContactForce {
                force: contact.force * &share,
                ..contact
            })
        }))
    }

    /// Returns the forces of the lower spheres on the floor: the normal force in mg, and the friction in mg·tan(θ/2) along x
    /// and 2cosφ·mg·tan(θ/2) along y.
    ///
    /// # Errors
    /// As for [`Forces::base`](cannonpile::Forces::base).
    ///
    /// # Examples
    /// See [`new`](Self::new).
    pub fn base<T: Algebra>(
        self,
        part: Selection,
    ) -> Result<impl Iterator<Item = Result<FloorForce<T>, Error>> + use<'p, T>, Error> {
        self.pile.forces::<T>().base(part)
    }

    /// Returns the coefficient of friction that the floor needs, over tan(θ/2): the largest ratio of friction to normal
    /// force.
    ///
    /// # Errors
    /// As for [`Pile::base_extremes`].
    ///
    /// # Examples
    /// See [`new`](Self::new).
    pub fn floor_friction(self) -> Result<Surd, Error> {
        Ok(self.pile.base_extremes()?.max_shear_ratio)
    }

    /// Returns 1/W, which converts a number f to N in mg.
    fn share<T: Algebra>(self) -> T {
        let increments = formula::increments(self.pile.sin_phi());
        T::from_rational(&formula::weight(&increments).recip())
    }
}

/// Two layers on a rough floor, in SI units.
#[derive(Clone, Debug)]
pub struct RoughPacking<'p> {
    packing: Packing<'p>,
    on_rough_floor: RoughFloor<'p>,
}

/// A contact with friction: forces in N, positions in m. The vectors are forces on the upper sphere, with z up.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct RoughContact {
    /// The upper sphere.
    pub site: Site,
    /// The direction from the upper to the lower sphere.
    pub direction: Direction,
    /// The normal force N.
    pub normal: BigRational,
    /// The tangential force T = N·tan(θ/2).
    pub tangential: SurdSum,
    /// The normal force as a vector, along the contact.
    pub normal_vector: [Surd; 3],
    /// The tangential force as a vector, in the vertical plane of the contact.
    pub tangential_vector: [SurdSum; 3],
    /// The point of contact.
    pub point: [Surd; 3],
}

equality!(RoughContact; |Self { site, direction, point, normal, normal_vector, tangential, tangential_vector }|
    (site, direction,
    point, ByValue(normal), normal_vector, tangential, tangential_vector));

impl<'p> RoughPacking<'p> {
    /// Returns a packing on a rough floor, for forces in SI units.
    ///
    /// # Errors
    /// [`RoughFloor`](crate::Error::RoughFloor) as for [`RoughFloor::new`], and if neighbours of a layer touch, a = R.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_stability::RoughPacking;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let friction = RoughPacking::new(&packing)?.contact_friction();
    /// assert_eq!(friction.to_string(), "5/6*sqrt(3)-1/6*sqrt(39)");
    /// assert!(RoughPacking::new(&Packing::new(&pile, &"1".parse()?)?).is_err());
    /// # Ok::<(), cannonpile_stability::Error>(())
    /// ```
    pub fn new(packing: &Packing<'p>) -> Result<Self, crate::Error> {
        let on_rough_floor = RoughFloor::new(packing.pile())?;
        if packing.touching().contains(&LayerGap { layers: 0 }) {
            return Err(crate::Error::RoughFloor {
                needed: "gaps between neighbours of a layer, a > R",
                given: "the spacing a = R".into(),
            });
        }
        Ok(Self {
            packing: packing.clone(),
            on_rough_floor,
        })
    }

    /// Returns the contacts of a part of the pile: N and T = N·tan(θ/2), in N.
    ///
    /// # Errors
    /// As for [`Packing::contacts`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile, ratio};
    /// use cannonpile_stability::RoughPacking;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// for contact in RoughPacking::new(&packing)?.contacts(Selection::All)? {
    ///     let contact = contact?;
    ///     assert_eq!(contact.normal, ratio!(1/3));
    ///     assert_eq!(contact.tangential.nearest::<f64>(), Some(0.13418089108033268));
    /// }
    /// # Ok::<(), cannonpile_stability::Error>(())
    /// ```
    pub fn contacts(
        &self,
        part: Selection,
    ) -> Result<impl Iterator<Item = Result<RoughContact, Error>> + use<'p>, Error> {
        let (packing, tan_half) = (self.packing.clone(), self.contact_friction());
        let (ratio, cos) = (self.ratio(), packing.inclination().cos());
        let unit = self.on_rough_floor.share::<BigRational>() * packing.sphere_weight();
        let contacts = packing.forces().contacts(part)?;
        Ok(contacts.map(move |contact| {
            let contact = contact?;
            let normal = product(&contact.force, &unit);
            let (direction, packed) = (contact.direction, packing.contact_in_si(contact)?);
            let normal_vector = packed.vector.each(|part| part * &cos);
            let [x, y, z] = normal_vector.clone();
            let aside = |part: Surd| ratio.clone() * &-part;
            Ok(RoughContact {
                site: packed.site,
                direction,
                tangential: tan_half.clone() * &normal.clone().into(),
                tangential_vector: [aside(x), aside(y), SurdSum::new(normal.clone().into(), -z)],
                normal,
                normal_vector,
                point: packed.point,
            })
        }))
    }

    /// Returns the forces of the lower spheres on the floor, in N: the normal force downwards, and friction along x and y.
    ///
    /// # Errors
    /// As for [`Packing::base`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_stability::RoughPacking;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let floor = RoughPacking::new(&packing)?.base(Selection::Base)?.last().unwrap()?;
    /// assert_eq!(floor.normal.to_string(), "4/3");
    /// // tan(θ/2)/3, along x.
    /// assert_eq!(floor.shear_x.to_string(), "5/18*sqrt(3)-1/18*sqrt(39)");
    /// # Ok::<(), cannonpile_stability::Error>(())
    /// ```
    pub fn base(
        &self,
        part: Selection,
    ) -> Result<impl Iterator<Item = Result<FloorForce<SurdSum>, Error>> + use<'p>, Error> {
        let (packing, ratio) = (self.packing.clone(), self.ratio());
        let forces = packing.forces().base(part)?;
        Ok(forces.map(move |force| {
            let force = packing.floor_force_in_si(force?);
            Ok(FloorForce {
                site: force.site,
                normal: force.normal.into(),
                shear_x: ratio.clone() * &force.shear_x,
                shear_y: ratio.clone() * &force.shear_y,
            })
        }))
    }

    /// Returns the least coefficient of friction of a contact with a force, tan(θ/2).
    ///
    /// # Examples
    /// See [`new`](Self::new).
    #[must_use]
    pub fn contact_friction(&self) -> SurdSum {
        // (1 − cosθ)/sinθ = (1 − cosθ)·sinθ/sin²θ
        let inclination = self.packing.inclination();
        let sin = inclination.sin().scaled(&inclination.sin2().recip());
        SurdSum::new(BigRational::one().into(), -inclination.cos()) * &sin
    }

    /// Returns the coefficient of friction that the floor needs: the largest ratio of friction to normal force.
    ///
    /// # Errors
    /// As for [`Pile::base_extremes`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile};
    /// use cannonpile_stability::RoughPacking;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let friction = RoughPacking::new(&packing)?.floor_friction()?;
    /// assert_eq!(friction.nearest::<f64>(), Some(0.1006356683102495));
    /// # Ok::<(), cannonpile_stability::Error>(())
    /// ```
    pub fn floor_friction(&self) -> Result<SurdSum, Error> {
        Ok(self.contact_friction() * &self.on_rough_floor.floor_friction()?)
    }

    /// Returns whether contacts hold at a coefficient of friction μ ≥ 0: tan(θ/2) ≤ μ, unless no contact has a force. The
    /// comparison is exact.
    ///
    /// # Errors
    /// As for [`Pile::base_extremes`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile, ratio};
    /// use cannonpile_stability::RoughPacking;
    ///
    /// let pile = Pile::discs(2)?;
    /// // tanθ = 3/4, so tan(θ/2) is 1/3.
    /// let rough = RoughPacking::new(&Packing::new(&pile, &"6/5".parse()?)?)?;
    /// assert!(rough.contacts_hold_at(&ratio!(1/3))? && !rough.contacts_hold_at(&ratio!(333/1000))?);
    /// assert!(!rough.contacts_hold_at(&ratio!(-1))?);
    /// # Ok::<(), cannonpile_stability::Error>(())
    /// ```
    pub fn contacts_hold_at(&self, friction: &BigRational) -> Result<bool, Error> {
        // The forces on an outermost lower sphere come from one side, so they do not cancel.
        let needed = self.on_rough_floor.floor_friction()?.square();
        Ok(needed.is_zero()
            || !friction.is_negative() && self.half_angle_is_within(&(friction * friction)))
    }

    /// Returns whether no bottom sphere slides at a coefficient of friction μ ≥ 0 of the floor. The comparison is exact.
    ///
    /// # Errors
    /// As for [`Pile::base_extremes`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Packing, Pile, ratio};
    /// use cannonpile_stability::RoughPacking;
    ///
    /// let pile = Pile::discs(2)?;
    /// // A disc bears 3/2 mg, and the friction is 1/2 mg·tan(θ/2).
    /// let rough = RoughPacking::new(&Packing::new(&pile, &"6/5".parse()?)?)?;
    /// assert!(rough.floor_holds_at(&ratio!(1/9))? && !rough.floor_holds_at(&ratio!(11/100))?);
    /// # Ok::<(), cannonpile_stability::Error>(())
    /// ```
    pub fn floor_holds_at(&self, friction: &BigRational) -> Result<bool, Error> {
        let needed = self.on_rough_floor.floor_friction()?.square();
        Ok(needed.is_zero()
            || !friction.is_negative()
                && self.half_angle_is_within(&(friction * friction / needed)))
    }

    /// Returns whether tan²(θ/2) is at most this number t, from cosθ ≥ (1 − t)/(1 + t).
    fn half_angle_is_within(&self, square: &BigRational) -> bool {
        let one = BigRational::one();
        let least = (&one - square) / (&one + square);
        self.packing.inclination().cos() >= Surd::from(least)
    }

    /// Returns tan(θ/2)/tanθ = (cosθ − cos²θ)/sin²θ, which converts horizontal forces.
    fn ratio(&self) -> SurdSum {
        let inclination = self.packing.inclination();
        let cos = inclination.cos().scaled(&inclination.sin2().recip());
        SurdSum::new(BigRational::one().into(), -inclination.cos()) * &cos
    }
}
