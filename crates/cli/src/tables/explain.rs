//! The table of a plan and of the counters of its run.

use cannonpile::engine::bug;
use cannonpile::shape::Selection;
use cannonpile::{Counters, Plan, Quantity, Question};
use cannonpile_dem::Error;
use cannonpile_dem::table::{Cell, Column, Table, Units, refuse_beyond};
use clap::ValueEnum;
use num_bigint::{BigInt, BigUint};

/// A quantity of each sphere or contact.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum Wanted {
    /// Contact forces, as of the command contacts
    Contacts,
    /// Magnitudes of the contact forces, in SI
    Magnitudes,
    /// Base forces, as of the command base
    Base,
    /// Positions, as of the command spheres, in SI
    Spheres,
}

impl Wanted {
    /// Returns the quantity of the forces, if any are computed.
    const fn forces(self) -> Option<Quantity> {
        match self {
            Self::Contacts | Self::Magnitudes => Some(Quantity::Contacts),
            Self::Base => Some(Quantity::Floor),
            Self::Spheres => None,
        }
    }

    /// Returns the number of square roots. The radicands are 1/cos²θ, tan²θ, sin²θ and cos²θ. Components along y add
    /// 4cos²φ.
    const fn roots(self, units: &Units<'_>) -> u32 {
        match (units, self) {
            (Units::Si(_), Self::Contacts) => 5,
            (Units::Si(_), Self::Magnitudes) => 1,
            (Units::Si(_), Self::Base) => 2,
            (Units::Si(_), Self::Spheres) => 3,
            _ => 0,
        }
    }
}

/// A query about a pile in some units, with its plan.
#[derive(Clone, Debug)]
pub(crate) struct Explanation<'p> {
    units: Units<'p>,
    wanted: Wanted,
    part: Selection,
    rows: BigUint,
    /// The plan of the forces, if any are computed.
    plan: Option<Plan>,
}

impl<'p> Explanation<'p> {
    /// Plans the computation of a quantity of a part of the pile.
    ///
    /// # Errors
    /// As for [`Pile::plan`](cannonpile::Pile::plan).
    pub(crate) fn new(units: &Units<'p>, wanted: Wanted, part: Selection) -> Result<Self, Error> {
        let pile = units.pile();
        let plan = wanted.forces().map(|quantity| {
            let mut question = Question::new(part, quantity);
            question.method = units.method();
            pile.plan(question)
        });
        let plan = plan.transpose()?;
        let rows = match &plan {
            Some(plan) => plan.rows.clone(),
            None => pile.rows(part)?.site_count(),
        };
        Ok(Self {
            units: units.clone(),
            wanted,
            part,
            rows,
            plan,
        })
    }

    /// Checks that [`run`](Self::run) does not compute too many rows.
    ///
    /// # Errors
    /// [`TooManyRows`](cannonpile::Error::TooManyRows), with the limit of a table.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let remedy = "ask for one layer, one sphere, or the plan only";
        refuse_beyond(&self.rows, remedy)
    }

    /// Computes all values of the query, and counts the work.
    ///
    /// # Errors
    /// As for [`check`](Self::check), and the errors of the computation.
    pub(crate) fn run(&self) -> Result<Counters, Error> {
        self.check()?;
        let (counters, part) = (Counters::default(), self.part);
        match &self.units {
            Units::Pile(forces) => {
                let forces = forces.as_ref().clone().with_counters(&counters);
                match self.wanted {
                    Wanted::Contacts => all(forces.contacts(part)?)?,
                    Wanted::Base => all(forces.base(part)?)?,
                    Wanted::Magnitudes | Wanted::Spheres => {
                        return Err(bug("a quantity in SI has units in SI").into());
                    }
                }
            }
            Units::Si(packing) => {
                let packing = packing.as_ref().clone().with_counters(&counters);
                match self.wanted {
                    Wanted::Contacts => all(packing.contacts(part)?)?,
                    Wanted::Magnitudes => all(packing.contact_forces(part)?)?,
                    Wanted::Base => all(packing.base(part)?)?,
                    Wanted::Spheres => all(packing.positions(part)?)?,
                }
            }
            _ => return Err(bug("units are pile units or SI").into()),
        }
        Ok(counters)
    }

    /// Returns one row with the plan, and with the counters if they are given.
    ///
    /// The columns of the plan are upper bounds: `method, visited, rows, bits, bytes, roots`. Those of the counters are
    /// `counted_visited, counted_turned, counted_passes, counted_rows`.
    #[must_use]
    pub(crate) fn table(&self, counters: Option<&Counters>) -> Table<'static> {
        let plan = self.plan.as_ref();
        let method = plan.map_or("closed".into(), |plan| plan.method.to_string());
        let big = |n: Option<&BigUint>| count(n.cloned().unwrap_or_default());
        let mut entries: Vec<(&'static str, Cell)> = vec![
            ("method", Cell::Word(method.into())),
            ("visited", big(plan.map(|plan| &plan.visited))),
            ("rows", count(self.rows.clone())),
            ("bits", count(plan.map_or(0, |plan| plan.bits))),
            ("bytes", big(plan.map(|plan| &plan.bytes))),
            ("roots", count(self.wanted.roots(&self.units))),
        ];
        entries.extend(counters.map(counted).into_iter().flatten());
        record(entries)
    }

    /// Returns one row with the counters alone.
    #[must_use]
    pub(crate) fn counted(counters: &Counters) -> Table<'static> {
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

fn all<A>(
    answers: impl Iterator<Item = Result<A, cannonpile::Error>>,
) -> Result<(), cannonpile::Error> {
    for answer in answers {
        answer?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use cannonpile::Pile;

    use super::super::test::csv;
    use super::*;

    fn explained(layers: i128, wanted: Wanted, part: Selection) -> Vec<String> {
        let pile = Pile::triangular(layers).unwrap();
        let units = Units::of_pile(&pile);
        let explanation = Explanation::new(&units, wanted, part).unwrap();
        let counted = explanation.run().unwrap();
        let csv = csv(explanation.table(Some(&counted)));
        csv.lines().map(str::to_owned).collect()
    }

    #[test]
    fn counters_follow_the_plan() {
        let rows = explained(10, Wanted::Base, Selection::Base);
        assert!(rows[0].starts_with("method,visited,rows,bits,"));
        assert!(
            rows[0].ends_with(",roots,counted_visited,counted_turned,counted_passes,counted_rows")
        );
        assert!(rows[1].starts_with("closed,55,55,"));
        // Three contacts of each of ten spheres.
        let rows = explained(10, Wanted::Contacts, Selection::Layer(3));
        assert!(rows[1].ends_with(",10,0,0,30"), "{rows:?}");
    }

    #[test]
    fn counters_and_plan_alone() {
        let counted = csv(Explanation::counted(&Counters::default()));
        assert!(counted.ends_with("\n0,0,0,0\n"));
        let pile = Pile::triangular(10).unwrap();
        let units = Units::of_pile(&pile);
        let explanation = Explanation::new(&units, Wanted::Base, Selection::Base);
        let table = explanation.unwrap().table(None);
        assert_eq!(
            table.columns().last().map(|column| column.name),
            Some("roots")
        );
    }

    /// A layer has few rows. The whole pile has 5·10¹¹, and the base of the largest pile about 10⁶⁰.
    #[test]
    fn too_many_rows_are_not_run() {
        let refused = |layers: i128, quantity, part| {
            let pile = Pile::triangular(layers).unwrap();
            let explanation = Explanation::new(&Units::of_pile(&pile), quantity, part).unwrap();
            matches!(
                explanation.check(),
                Err(Error::Core(cannonpile::Error::TooManyRows { .. }))
            )
        };
        let contacts = Wanted::Contacts;
        assert!(!refused(10_000, contacts, Selection::Layer(9)));
        assert!(refused(10_000, contacts, Selection::All));
        assert!(refused(10_i128.pow(30), Wanted::Base, Selection::Base));
    }
}
