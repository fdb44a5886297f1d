//! The summary of a pile in one row.

use num_bigint::BigUint;
use num_rational::BigRational;

use super::cell::Cell;
use super::rows::{Column, Table};
use super::units::Units;
use crate::Error;
use cannonpile::geometry::LayerGap;
use cannonpile::lattice::Dimension;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{BaseExtremes, Method, Pile, Standing, Verdict};
use cannonpile_horizontal::certificate::{Certificate, Claim};

/// The quantities of a pile in one row, and its stability.
///
/// # Examples
/// ```
/// use cannonpile_dem::table::{FileFormat, NumberFormat, Summary, Units};
/// use cannonpile::{Pile, Verdict};
///
/// let pile = Pile::triangular(10)?;
/// let summary = Summary::new(&Units::of_pile(&pile), None)?;
/// assert_eq!(summary.verdict(), Some(Verdict::Yes));
/// let mut text = Vec::new();
/// summary.table().write(FileFormat::Text, NumberFormat::Exact, &mut text)?;
/// let text = String::from_utf8(text)?;
/// assert!(text.starts_with("layers           10\nstacking         fcc\nspheres          220\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Summary<'p> {
    units: Units<'p>,
    touching: Option<Vec<LayerGap>>,
    standing: Standing,
    /// The verdict on a pile that needs tensile forces without its horizontal contacts, or the error of its
    /// computation. `None` for all other piles, and unless exactly the horizontal neighbours touch.
    held: Option<Result<Certificate, cannonpile_horizontal::Error>>,
    /// The extreme forces on the floor, or the error of their computation.
    base: Result<BaseExtremes, cannonpile::Error>,
    /// The least tilt at which a contact opens, as t_c², or the error of its computation. `None` if the pile is unstable
    /// without further contacts, or has no weight above the floor.
    margin: Result<Option<BigRational>, cannonpile::Error>,
    /// The method that computes the base forces, or the reason why the whole base is too large.
    method: Result<Method, cannonpile::Error>,
}

impl<'p> Summary<'p> {
    /// Computes the summary of the pile of `units`. `touching` lists the further contacts at the given spacing; `None`
    /// without a spacing.
    ///
    /// # Errors
    /// The errors of [`Pile::standing`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::{Summary, Units};
    /// use cannonpile::geometry::LayerGap;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::{Pile, Verdict};
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// let units = Units::of_pile(&pile);
    /// assert_eq!(Summary::new(&units, Some(Vec::new()))?.verdict(), Some(Verdict::No));
    /// // Touching spheres two layers apart may make a tensile force unnecessary.
    /// let touching = vec![LayerGap { layers: 2 }];
    /// assert_eq!(Summary::new(&units, Some(touching))?.verdict(), Some(Verdict::Undetermined));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn new(units: &Units<'p>, touching: Option<Vec<LayerGap>>) -> Result<Self, Error> {
        let pile = units.pile();
        let plan = pile.plan(Selection::Base);
        let standing = pile.standing()?;
        let held = {
            let in_layers_only = touching.as_deref() == Some(&[LayerGap { layers: 0 }]);
            let pulls = standing.first_failure.is_some() && !pile.is_weightless();
            (in_layers_only && pulls).then(|| cannonpile_horizontal::equilibrium(pile))
        };
        let margin = match standing.first_failure {
            None => unless_too_large(margin(pile))?,
            Some(_) => Ok(None),
        };
        Ok(Self {
            held,
            margin,
            units: units.clone(),
            touching,
            base: unless_too_large(pile.base_extremes())?,
            standing,
            method: unless_too_large(plan.map(|plan| plan.method))?,
        })
    }

    /// Returns the empty columns, each with the reason and a remedy. The caller explains an empty `touching`, because
    /// only the caller knows the reason.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::table::{Summary, Units};
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert!(Summary::new(&Units::of_pile(&pile), None)?.left_out().is_empty());
    /// let one = Pile::triangular(1)?;
    /// let left_out = Summary::new(&Units::of_pile(&one), None)?.left_out();
    /// assert_eq!(left_out, [("min_contact", "a single layer has no contacts".to_owned())]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn left_out(&self) -> Vec<(&'static str, String)> {
        let stands = self.verdict().is_none();
        let stands = stands.then(|| {
            "a weightless pile is neither stable nor unstable: give the spheres their weight"
                .to_owned()
        });
        let open = self.held.as_ref().and_then(|held| held.as_ref().err());
        let open = open.map(|error| {
            format!("it is unknown whether horizontal contacts support the pile: {error}")
        });
        let Standing {
            least,
            first_failure,
            ..
        } = &self.standing;
        let least = least.is_none().then(|| match first_failure {
            None => "a single layer has no contacts".to_owned(),
            Some(k) => format!(
                "the pile fails below layer k = {k} already, and in the layers further down more than 10^9 numbers would \
                 have to be compared: use fewer layers"
            ),
        });
        let slides = self
            .base
            .as_ref()
            .is_ok_and(|base| base.shear_without_normal);
        let slides = slides.then(|| "a bottom sphere has a shear, but no normal force".to_owned());
        let base = self.base.as_ref().err().map(ToString::to_string);
        let method = self.method.as_ref().err().map(ToString::to_string);
        let reasons = [
            ("stands", stands.or(open)),
            ("min_contact", least),
            (
                "margin_squared",
                self.margin.as_ref().err().map(ToString::to_string),
            ),
            ("normal_min, normal_max, max_shear_ratio", base),
            ("max_shear_ratio", slides),
            ("plan", method),
        ];
        let left_out = reasons
            .into_iter()
            .filter_map(|(columns, reason)| Some((columns, reason?)));
        left_out.collect()
    }

    /// Returns whether the pile is stable; `None` for weightless spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::table::{Summary, Units};
    ///
    /// let pile = Pile::triangular(10)?.weightless();
    /// assert_eq!(Summary::new(&Units::of_pile(&pile), None)?.verdict(), None);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn verdict(&self) -> Option<Verdict> {
        let asked = !self.units.pile().is_weightless();
        let touching = self.touching.as_deref().unwrap_or_default();
        asked.then(|| match self.certificate() {
            Some(certificate) if certificate.claim == Claim::Stands => Verdict::Yes,
            Some(_) => Verdict::No,
            None => self.standing.verdict(touching),
        })
    }

    /// Returns the certificate of the verdict, if horizontal contacts decide it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::table::{Summary, Units};
    ///
    /// let pile = Pile::triangular(10)?;
    /// // The forces without horizontal contacts are compressive.
    /// assert!(Summary::new(&Units::of_pile(&pile), None)?.certificate().is_none());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn certificate(&self) -> Option<&Certificate> {
        self.held.as_ref()?.as_ref().ok()
    }

    /// Returns a table of one row: `layers, stacking, spheres, contacts, weight, stands, min_contact, base_spheres,
    /// normal_min, normal_max, max_shear_ratio, touching, plan, margin_squared`.
    ///
    /// The weight includes all loads. [`left_out`](Self::left_out) explains empty columns. `margin_squared` is also empty
    /// for an unstable pile, and for one without weight above the floor.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::table::{FileFormat, NumberFormat, Summary, Units};
    /// use cannonpile::lattice::Region;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// let mut csv = Vec::new();
    /// let table = Summary::new(&Units::of_pile(&pile), None)?.table();
    /// table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
    /// // The pile is unstable: some contact needs a tensile force.
    /// assert!(String::from_utf8(csv)?.lines().nth(1).unwrap().contains(",no,-22/81,"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn table(&self) -> Table<'static> {
        let (units, pile) = (&self.units, self.units.pile());
        let (mass, tan) = match units {
            Units::Pile(_) => (None, None),
            Units::Si(packing) => (
                Some(packing.sphere_weight()),
                Some(packing.inclination().tan()),
            ),
        };
        let in_units = |force: &BigRational| -> Cell {
            mass.as_ref()
                .map_or_else(|| force.clone(), |mass| force * mass)
                .into()
        };
        let of_base = |value: fn(&BaseExtremes) -> &BigRational| {
            let base = self.base.as_ref();
            base.map_or(Cell::Missing, |base| in_units(value(base)))
        };
        let base = self.base.as_ref().ok();
        let ratio = base
            .filter(|base| !base.shear_without_normal)
            .map(|base| match &tan {
                None => base.max_shear_ratio.clone(),
                Some(tan) => tan.clone() * &base.max_shear_ratio,
            });
        let [ratio_unit, margin_unit] = match tan {
            None => ["tanθ", "tan²θ"],
            Some(_) => ["", ""],
        };
        let least = self.standing.least.as_ref();
        let least = least.map(|contact| units.contact(contact.force.clone()));
        let method = self.method.as_ref().map(Method::to_string);
        let plan = method.map_or(Cell::Missing, |method| Cell::Word(method.into()));
        let margin = self.margin.as_ref().ok().cloned().flatten();
        let margin = margin.map(|margin| match &tan {
            None => margin,
            Some(tan) => margin * tan.square(),
        });
        let plain = |name, cell: Cell| (Column::plain(name), cell);
        let count = |name, count: BigUint| plain(name, Cell::Integer(count.into()));
        let measured = |name, unit, cell: Cell| (Column::measured(name, unit), cell);
        let word = |word: String| Cell::Word(word.into());
        let stands = self.verdict().map(|verdict| verdict.name().into());
        let touching = self.touching.as_deref().map(describe);
        let entries = [
            plain("layers", pile.layers().into()),
            plain("stacking", word(stacking(pile))),
            count("spheres", pile.sphere_count()),
            count("contacts", pile.contact_count()),
            measured("weight", units.normal(), in_units(&pile.weight())),
            plain("stands", stands.unwrap_or(Cell::Missing)),
            measured(
                "min_contact",
                units.force(),
                least.map_or(Cell::Missing, Cell::from),
            ),
            count("base_spheres", pile.base_sphere_count()),
            measured(
                "normal_min",
                units.normal(),
                of_base(|base| &base.normal_min),
            ),
            measured(
                "normal_max",
                units.normal(),
                of_base(|base| &base.normal_max),
            ),
            measured(
                "max_shear_ratio",
                ratio_unit,
                ratio.map_or(Cell::Missing, Cell::from),
            ),
            plain("touching", touching.unwrap_or(Cell::Missing)),
            plain("plan", plan),
            measured(
                "margin_squared",
                margin_unit,
                margin.map_or(Cell::Missing, Cell::from),
            ),
        ];
        Table::record(entries.into())
    }
}

/// Returns the squared margin of a pile, or `None` for a pile without weight above the floor.
fn margin(pile: &Pile) -> Result<Option<BigRational>, cannonpile::Error> {
    match cannonpile_stability::margin(pile) {
        Ok(margin) => Ok(margin.map(|margin| margin.squared)),
        Err(cannonpile_stability::Error::Core(error)) => Err(error),
        // The pile has no weight.
        Err(_) => Ok(None),
    }
}

/// Returns the error of a query that is too large as a value, and any other error as an error.
fn unless_too_large<T>(
    answer: Result<T, cannonpile::Error>,
) -> Result<Result<T, cannonpile::Error>, cannonpile::Error> {
    match answer {
        Err(error @ cannonpile::Error::TooLarge { .. }) => Ok(Err(error)),
        answer => answer.map(Ok),
    }
}

/// Returns the name of a pile's stacking, or its Hägg signs.
#[must_use]
pub fn stacking(pile: &Pile) -> String {
    if pile.dimension() == Dimension::Two {
        return "discs".into();
    }
    let read = as_read(pile);
    read.name().map_or_else(|| read.to_string(), Into::into)
}

/// Returns the Hägg signs of a pile.
#[must_use]
pub fn steps(pile: &Pile) -> String {
    as_read(pile).to_string()
}

/// Returns the stacking in reading order: from the base up if the pile grows from its base.
fn as_read(pile: &Pile) -> Stacking {
    let stacking = pile.shape().stacking();
    if pile.shape().is_grown_from_base() {
        stacking.reversed()
    } else {
        stacking.clone()
    }
}

/// Describes gaps as text: `none`, or `in one layer and 3 layers apart`.
fn describe(touching: &[LayerGap]) -> Cell {
    let words: Vec<String> = touching.iter().map(ToString::to_string).collect();
    if words.is_empty() {
        "none".into()
    } else {
        Cell::Word(words.join(" and ").into())
    }
}
