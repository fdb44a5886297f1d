//! The sentence and the table of a plan, and the counters of its run.

use std::fmt;

use cannonpile::engine::bug;
use cannonpile::shape::Selection;
use cannonpile::{Counters, Method, Pile, Plan, Quantity, Question};
use cannonpile_dem::Error;
use cannonpile_dem::table::{Cell, Column, Table, Units, refuse_beyond};
use cannonpile_horizontal::exact_pivots;
use clap::ValueEnum;
use num_bigint::{BigInt, BigUint};
use num_traits::ToPrimitive;

use crate::progress::grouped;

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

    /// Returns the sentence and the fields of the plan, as a record: `method, visited, of, reason, rows, bits, bytes, roots,
    /// pivots`. All are upper bounds. A run adds `counted_visited, counted_turned, counted_passes, counted_rows`.
    pub(crate) fn table(&self, counters: Option<&Counters>) -> Table<'static> {
        let plan = self.plan.as_ref();
        let method = plan.map_or("closed".into(), |plan| plan.method.to_string());
        let bytes = plan.map(|plan| plan.bytes.clone()).unwrap_or_default();
        let work = self.work(counters);
        let mut entries: Vec<(&'static str, Cell)> = vec![
            ("method", Cell::Word(method.into())),
            ("visited", count(work.visited)),
            ("of", count(work.of)),
            ("reason", Cell::Word(work.reason.into())),
            ("rows", count(self.rows.clone())),
            ("bits", count(work.bits)),
            ("bytes", count(bytes)),
            ("roots", count(work.roots)),
            ("pivots", count(work.pivots)),
        ];
        entries.extend(counters.map(counted).into_iter().flatten());
        let plain = |(name, cell)| (Column::plain(name), cell);
        Table::record(entries.into_iter().map(plain).collect())
    }

    /// Returns the work of the query: planned, or counted.
    pub(crate) fn work(&self, counters: Option<&Counters>) -> Work {
        let asked = match (self.part, self.wanted) {
            (Selection::One(_), Wanted::Base) => "one bottom sphere was asked for".to_owned(),
            (Selection::One(_), _) => "one sphere was asked for".to_owned(),
            (Selection::Layer(k), _) => format!("layer {k} was asked for"),
            (Selection::Base, _) => "the base was asked for".to_owned(),
            (Selection::All, Wanted::Spheres) => "all spheres were asked for".to_owned(),
            (Selection::All, _) => "all contacts were asked for".to_owned(),
        };
        let how = match self.plan.as_ref().map(|plan| plan.method) {
            None => "positions need no forces",
            Some(Method::Closed) => "a count gives each force of a straight stacking",
            Some(Method::Tree) => "a tree follows the lines above up to the sign changes",
            Some(_) => "a sweep computes only this part and the spheres at sign changes",
        };
        let plan = self.plan.as_ref();
        let visited = plan.map_or(BigUint::ZERO, |plan| plan.visited.clone());
        let bits = plan.map_or(0, |plan| plan.bits);
        // A sweep may visit spheres at sign changes twice, to turn and to return their forces.
        let counted = |counters: &Counters| {
            let turned = if bits == 0 { 0 } else { counters.turned() };
            let counted = counters.visited().saturating_add(turned);
            visited.clone().min(counted.into())
        };
        Work {
            is_bound: counters.is_none() && self.plan.is_some(),
            visited: counters.map_or_else(|| visited.clone(), counted),
            of: self.units.pile().sphere_count(),
            reason: format!("{asked}: {how}"),
            bits,
            roots: self.wanted.roots(&self.units),
            pivots: exact_pivots(),
        }
    }
}

/// The work of a command.
pub(crate) struct Work {
    /// Whether `visited` is an upper bound.
    is_bound: bool,
    visited: BigUint,
    of: BigUint,
    reason: String,
    bits: u64,
    roots: u32,
    pivots: u64,
}

impl Work {
    /// Returns the work of an answer that formulas give without a visit.
    pub(crate) fn of_formulas(pile: &Pile, reason: &str) -> Self {
        Self {
            is_bound: false,
            visited: BigUint::ZERO,
            ..Self::of_whole(pile, reason)
        }
    }

    /// Returns the work of an answer that may depend on every sphere.
    pub(crate) fn of_whole(pile: &Pile, reason: &str) -> Self {
        Self {
            is_bound: true,
            visited: pile.sphere_count(),
            of: pile.sphere_count(),
            reason: reason.to_owned(),
            bits: 0,
            roots: 0,
            pivots: exact_pivots(),
        }
    }
}

impl fmt::Display for Work {
    /// `visits 14,189 of 55,365 spheres (26%), because …; exact numbers of 55 bits; no root`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (visited, of, reason) = (&self.visited, &self.of, &self.reason);
        let bound = if self.is_bound { "at most " } else { "" };
        // A pile has at least one sphere.
        let percent = match ((visited * 200_u32 + of) / (of * 2_u32)).to_u8() {
            Some(0) if *visited > BigUint::ZERO => "below 1".to_owned(),
            percent => percent.unwrap_or(100).min(100).to_string(),
        };
        let (visited, of) = (grouped(&visited.min(of)), grouped(of));
        write!(
            f,
            "visits {bound}{visited} of {of} spheres ({percent}%), because {reason}"
        )?;
        match self.bits {
            0 => f.write_str("; exact numbers")?,
            bits => write!(f, "; exact numbers of {bits} bits")?,
        }
        match self.roots {
            0 => f.write_str("; no root")?,
            1 => f.write_str("; 1 root")?,
            roots => write!(f, "; {roots} roots")?,
        }
        match self.pivots {
            0 => Ok(()),
            1 => f.write_str("; 1 exact pivot"),
            pivots => write!(f, "; {pivots} exact pivots"),
        }
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
    use cannonpile::lattice::{Region, Site};

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
        assert!(rows[0].starts_with("method,visited,of,reason,rows,bits,"));
        assert!(
            rows[0].ends_with(",pivots,counted_visited,counted_turned,counted_passes,counted_rows")
        );
        assert!(
            rows[1].starts_with("closed,55,220,the base was"),
            "{rows:?}"
        );
        // Three contacts of each of ten spheres.
        let rows = explained(10, Wanted::Contacts, Selection::Layer(3));
        assert!(rows[1].ends_with(",10,0,0,30"), "{rows:?}");
    }

    fn sentence(signs: &str, wanted: Wanted, part: Selection, is_run: bool) -> String {
        let pile = Pile::under(Region::SITE, signs.parse().unwrap()).unwrap();
        let units = Units::of_pile(&pile);
        let explanation = Explanation::new(&units, wanted, part).unwrap();
        let counters = is_run.then(|| explanation.run().unwrap());
        explanation.work(counters.as_ref()).to_string()
    }

    /// Layers of 1, 3, 6, 12 and 18 spheres, with sign changes in those of 6 and 12.
    #[test]
    fn a_sentence_says_what_is_visited_and_why() {
        let base = sentence("++-+", Wanted::Base, Selection::Base, false);
        let start = "visits at most 36 of 40 spheres (90%), because the base was asked for: a sweep computes";
        assert!(base.starts_with(start), "{base}");
        assert!(base.ends_with(" bits; no root"), "{base}");
        let one = Selection::One(Site { i: 0, j: 0, k: 4 });
        let one = sentence("++-+", Wanted::Base, one, true);
        let start = "visits 7 of 40 spheres (18%), because one bottom sphere was asked for: a tree";
        assert!(one.starts_with(start), "{one}");
        let all = sentence("++++", Wanted::Contacts, Selection::Layer(0), true);
        assert!(
            all.starts_with("visits 1 of 35 spheres (3%), because layer 0 was asked for: a count"),
            "{all}"
        );
        let positions = sentence("+", Wanted::Spheres, Selection::All, false);
        assert!(
            positions.starts_with("visits 0 of 4 spheres (0%), because all spheres"),
            "{positions}"
        );
        let pile = Pile::triangular(1000).unwrap();
        let work = Work::of_whole(&pile, "a bound needs every balance");
        assert_eq!(
            work.to_string().split(';').next(),
            Some(
                "visits at most 167,167,000 of 167,167,000 spheres (100%), because a bound needs every balance"
            )
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
