//! The table of a plan and of the counters of its run.

use cannonpile::engine::bug;
use cannonpile::shape::Selection;
use cannonpile::{Counters, Forces, Plan, Quantity, Question};
use cannonpile_dem::Error;
use cannonpile_dem::table::{Cell, Column, Table, Units, refuse_beyond};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

/// A query about a pile in some units, with its plan.
#[derive(Clone, Debug)]
pub(crate) struct Explanation<'p> {
    units: Units<'p>,
    question: Question,
    plan: Plan,
}

impl<'p> Explanation<'p> {
    /// Plans the computation of a quantity of a part of the pile.
    ///
    /// # Errors
    /// As for [`Pile::plan`](cannonpile::Pile::plan).
    pub(crate) fn new(
        units: &Units<'p>,
        quantity: Quantity,
        part: Selection,
    ) -> Result<Self, Error> {
        let mut question = Question::new(part, quantity);
        question.method = units.method();
        Ok(Self {
            units: units.clone(),
            plan: units.pile().plan(question)?,
            question,
        })
    }

    /// Checks that [`run`](Self::run) does not compute too many rows.
    ///
    /// # Errors
    /// [`TooManyRows`](cannonpile::Error::TooManyRows), with the limit of a table.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let remedy = "ask for one layer, one sphere, or the plan only";
        refuse_beyond(&self.plan.rows, remedy)
    }

    /// Computes all values of the query, and counts the work.
    ///
    /// # Errors
    /// As for [`check`](Self::check), and the errors of the computation.
    pub(crate) fn run(&self) -> Result<Counters, Error> {
        self.check()?;
        let counters = Counters::default();
        let part = self.question.part;
        let quantity = self.question.quantity;
        match &self.units {
            Units::Pile(forces) => {
                multiples(
                    &forces.as_ref().clone().with_counters(&counters),
                    quantity,
                    part,
                )?;
            }
            Units::Si(packing) => {
                let packing = packing.as_ref().clone().with_counters(&counters);
                match quantity {
                    Quantity::ContactForces => all(packing.contact_forces(part)?)?,
                    Quantity::ContactVectors => all(packing.contacts(part)?)?,
                    Quantity::FloorForces => all(packing.base(part)?)?,
                    Quantity::Positions => all(packing.positions(part)?)?,
                    _ => multiples(packing.forces(), quantity, part)?,
                }
            }
            _ => return Err(bug("units are pile units or SI").into()),
        }
        Ok(counters)
    }

    /// Returns one row with the plan, and with the counters if they are given.
    ///
    /// The columns of the plan are upper bounds: `quantity, method, runs, visited, turned, passes, numbers, bits, planes, roots,
    /// rows, bytes`. Those of the counters are `counted_visited, counted_turned, counted_passes, counted_rows`.
    #[must_use]
    pub(crate) fn table(&self, counters: Option<&Counters>) -> Table<'static> {
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

    /// Returns one row with the counters alone.
    #[must_use]
    pub(crate) fn counted(counters: &Counters) -> Table<'static> {
        record(counted(counters).into())
    }
}

/// Computes the values of a query in pile units.
fn multiples(
    forces: &Forces<'_, BigRational>,
    quantity: Quantity,
    part: Selection,
) -> Result<(), cannonpile::Error> {
    match quantity {
        Quantity::ContactMultiples => all(forces.contacts(part)?),
        Quantity::FloorMultiples => all(forces.base(part)?),
        _ => Err(bug("a quantity in SI has units in SI")),
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
    use cannonpile::geometry::Spacing;
    use cannonpile::lattice::Region;
    use cannonpile::{Packing, Pile};

    use super::super::test::csv;
    use super::*;

    fn explained(layers: i128, quantity: Quantity, part: Selection) -> Vec<String> {
        let pile = Pile::triangular(layers).unwrap();
        let units = Units::of_pile(&pile);
        let explanation = Explanation::new(&units, quantity, part).unwrap();
        let counted = explanation.run().unwrap();
        let csv = csv(explanation.table(Some(&counted)));
        csv.lines().map(str::to_owned).collect()
    }

    #[test]
    fn counters_follow_the_plan() {
        let rows = explained(10, Quantity::FloorMultiples, Selection::Base);
        assert!(rows[0].starts_with("quantity,method,runs,visited,"));
        assert!(
            rows[0].ends_with(",bytes,counted_visited,counted_turned,counted_passes,counted_rows")
        );
        assert!(rows[1].starts_with("floor multiples,closed,1,55,"));
        // Three contacts of each of ten spheres.
        let rows = explained(10, Quantity::ContactMultiples, Selection::Layer(3));
        assert!(rows[1].ends_with(",10,0,0,30"), "{rows:?}");
    }

    #[test]
    fn counters_and_plan_alone() {
        let counted = csv(Explanation::counted(&Counters::default()));
        assert!(counted.ends_with("\n0,0,0,0\n"));
        let pile = Pile::triangular(10).unwrap();
        let units = Units::of_pile(&pile);
        let explanation = Explanation::new(&units, Quantity::FloorMultiples, Selection::Base);
        let table = explanation.unwrap().table(None);
        assert_eq!(
            table.columns().last().map(|column| column.name),
            Some("bytes")
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
        let contacts = Quantity::ContactMultiples;
        assert!(!refused(10_000, contacts, Selection::Layer(9)));
        assert!(refused(10_000, contacts, Selection::All));
        assert!(refused(
            10_i128.pow(30),
            Quantity::FloorMultiples,
            Selection::Base
        ));
    }

    /// A packing computes multiples of the unit force without a square root.
    #[test]
    fn multiples_of_a_packing_are_counted() {
        let pile = Pile::under(Region::SITE, "+-++-".parse().unwrap()).unwrap();
        let ratio = BigRational::new(6.into(), 5.into());
        let packing = Packing::new(&pile, &Spacing::new(ratio).unwrap()).unwrap();
        let units = Units::of_packing(packing);
        for (quantity, part) in [
            (Quantity::ContactMultiples, Selection::All),
            (Quantity::FloorMultiples, Selection::Base),
        ] {
            let explanation = Explanation::new(&units, quantity, part).unwrap();
            let counters = explanation.run().unwrap();
            assert_eq!(explanation.plan.rows, counters.rows().into(), "{quantity}");
        }
    }
}
