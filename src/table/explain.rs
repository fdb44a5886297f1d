//! What a question takes: planned, and counted.

use num_bigint::{BigInt, BigUint};

use super::cell::Cell;
use super::rows::{Column, Table};
use super::tables::refuse_beyond;
use super::units::Units;
use crate::shape::Selection;
use crate::{Counters, Error, Plan, Quantity, Question};

/// A question about a pile in some units, as a table of it would put it.
///
/// # Examples
/// ```
/// use cannonpile::table::{Explanation, FileFormat, NumberFormat, Units};
/// use cannonpile::shape::Selection;
/// use cannonpile::{Pile, Quantity};
///
/// let pile = Pile::triangular(10)?;
/// let explanation = Explanation::new(&Units::of_pile(&pile), Quantity::FloorMultiples, Selection::Base)?;
/// let counted = explanation.run()?;
/// let mut csv = Vec::new();
/// explanation.table(Some(&counted)).write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// let csv = String::from_utf8(csv)?;
/// assert!(csv.starts_with("quantity,method,runs,visited,"));
/// assert!(csv.lines().nth(1).unwrap().starts_with("floor multiples,closed,1,55,"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Explanation<'p> {
    units: Units<'p>,
    question: Question,
    plan: Plan,
}

impl<'p> Explanation<'p> {
    /// The plan for a quantity of a part of the pile.
    ///
    /// # Errors
    /// As for [`Pile::plan`](crate::Pile::plan); [`Error::NeedsUnits`] if the quantity is in SI, and the units are those of the
    /// pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::table::{Explanation, Units};
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Error, Pile, Quantity};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let explained = |quantity| Explanation::new(&Units::of_pile(&pile), quantity, Selection::All);
    /// assert!(explained(Quantity::ContactMultiples).is_ok());
    /// // Positions are in metres.
    /// assert!(matches!(explained(Quantity::Positions), Err(Error::NeedsUnits { .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(units: &Units<'p>, quantity: Quantity, part: Selection) -> Result<Self, Error> {
        if let (Units::Pile(_), true) = (units, quantity.roots() > 0) {
            return Err(Error::NeedsUnits { quantity });
        }
        let question = Question {
            part,
            quantity,
            method: units.method(),
        };
        Ok(Self {
            units: units.clone(),
            plan: units.pile().plan(question)?,
            question,
        })
    }

    /// The plan.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::table::{Explanation, Units};
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Pile, Quantity};
    ///
    /// let pile = Pile::triangular(10_i128.pow(30))?;
    /// let units = Units::of_pile(&pile);
    /// let explanation = Explanation::new(&units, Quantity::FloorMultiples, Selection::Base)?;
    /// assert_eq!(explanation.plan().roots, 0);
    /// // More bottom spheres than anybody will wait for.
    /// assert!(explanation.check().is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// That there are not too many answers to [`run`](Self::run).
    ///
    /// # Errors
    /// [`Error::TooManyRows`], as tables refuse them.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::table::{Explanation, Units};
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Error, Pile, Quantity};
    ///
    /// // A layer has few answers, the whole pile 5·10¹¹.
    /// let pile = Pile::triangular(10_000)?;
    /// let explained = |part| Explanation::new(&Units::of_pile(&pile), Quantity::ContactMultiples, part);
    /// assert!(explained(Selection::Layer(9))?.check().is_ok());
    /// assert!(matches!(explained(Selection::All)?.check(), Err(Error::TooManyRows { .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn check(&self) -> Result<(), Error> {
        refuse_beyond(
            &self.plan.rows,
            "ask for one layer, one sphere, or the plan only",
        )
    }

    /// Answers the question, all of it, and counts what that takes.
    ///
    /// # Errors
    /// As for [`check`](Self::check); those of the answers are handed on.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::table::{Explanation, Units};
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Pile, Quantity};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let units = Units::of_pile(&pile);
    /// let explanation = Explanation::new(&units, Quantity::ContactMultiples, Selection::Layer(3))?;
    /// // Three contacts of each of ten spheres.
    /// let counted = explanation.run()?;
    /// assert_eq!((counted.visited(), counted.rows()), (10, 30));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn run(&self) -> Result<Counters, Error> {
        self.check()?;
        let counters = Counters::default();
        let part = self.question.part;
        let quantity = self.question.quantity;
        let forces = match &self.units {
            Units::Pile(forces) => forces.as_ref().clone().metered(&counters),
            Units::Si(packing) => {
                let packing = packing.as_ref().clone().metered(&counters);
                match quantity {
                    Quantity::ContactMagnitudes => all(packing.magnitudes(part)?)?,
                    Quantity::ContactVectors => all(packing.contacts(part)?)?,
                    Quantity::FloorForces => all(packing.base(part)?)?,
                    Quantity::Positions => all(packing.positions(part)?)?,
                    Quantity::ContactMultiples | Quantity::FloorMultiples => {}
                }
                packing.forces().clone()
            }
        };
        match quantity {
            Quantity::ContactMultiples => all(forces.contacts(part)?)?,
            Quantity::FloorMultiples => all(forces.base(part)?)?,
            _ => {}
        }
        Ok(counters)
    }

    /// One row: `quantity, method, runs, visited, turned, passes, numbers, bits, planes, roots, rows, bytes`, all at most,
    /// and what was counted, if it was: `counted_visited, counted_turned, counted_passes, counted_rows`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::table::{Explanation, Units};
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Counters, Pile, Quantity};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let explanation = Explanation::new(&Units::of_pile(&pile), Quantity::FloorMultiples, Selection::Base)?;
    /// let last = |counters| explanation.table(counters).columns().last().map(|column| column.name);
    /// assert_eq!(last(None), Some("bytes"));
    /// assert_eq!(last(Some(&Counters::default())), Some("counted_rows"));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn table(&self, counters: Option<&Counters>) -> Table<'static> {
        let plan = &self.plan;
        let mut entries: Vec<(&'static str, Cell)> = vec![
            (
                "quantity",
                Cell::Word(self.question.quantity.to_string().into()),
            ),
            ("method", Cell::Word(plan.method.to_string().into())),
            ("runs", count(plan.runs)),
            ("visited", big(&plan.visited)),
            ("turned", big(&plan.turned)),
            ("passes", big(&plan.passes)),
            ("numbers", big(&plan.numbers)),
            ("bits", count(plan.bits)),
            ("planes", count(plan.planes)),
            ("roots", count(plan.roots)),
            ("rows", big(&plan.rows)),
            ("bytes", big(&plan.bytes)),
        ];
        entries.extend(counters.map(counted).into_iter().flatten());
        record(entries)
    }

    /// What was counted, alone.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::table::{Explanation, FileFormat, NumberFormat};
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile::{Counters, Pile};
    ///
    /// let counters = Counters::default();
    /// let pile = Pile::triangular(10)?;
    /// pile.forces::<f64>().metered(&counters).contact(Site::APEX, Direction::Alpha)?;
    /// let mut csv = Vec::new();
    /// Explanation::counted(&counters).write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
    /// // One sphere visited, and nothing else.
    /// assert!(csv.ends_with(b"\n1,0,0,0\n"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn counted(counters: &Counters) -> Table<'static> {
        record(counted(counters).into())
    }
}

fn counted(counters: &Counters) -> [(&'static str, Cell); 4] {
    [
        ("counted_visited", count(counters.visited())),
        ("counted_turned", count(counters.turned())),
        ("counted_passes", count(counters.passes())),
        ("counted_rows", count(counters.rows())),
    ]
}

fn record(entries: Vec<(&'static str, Cell)>) -> Table<'static> {
    let plain = |(name, cell)| (Column::plain(name), cell);
    Table::record(entries.into_iter().map(plain).collect())
}

fn count(n: impl Into<BigInt>) -> Cell {
    Cell::Integer(n.into())
}

fn big(n: &BigUint) -> Cell {
    Cell::Integer(n.clone().into())
}

fn all<A>(answers: impl Iterator<Item = Result<A, Error>>) -> Result<(), Error> {
    for answer in answers {
        answer?;
    }
    Ok(())
}
