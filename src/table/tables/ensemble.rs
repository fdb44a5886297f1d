//! What was counted of random stackings.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use crate::Error;
use crate::disorder::{By, Extreme, Histogram, Tally, WithFaults};
use crate::table::cell::Cell;
use crate::table::rows::{Column, Row, Table};

/// What was counted of random stackings, a row for each number of faults: `faults, stackings, stand, held, min_contact,
/// max_contact, normal_min, normal_max` of all of them, and the four of those that stand with `standing_` before; at last
/// `stacking`, the first that has the least contact force. `held` is how many stand with horizontal contacts, and is left out where
/// that was not asked.
///
/// # Examples
/// ```
/// use cannonpile::disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
/// use cannonpile::table::{self, FileFormat, NumberFormat};
///
/// let stackings = RandomStackings::new(6, FirstSign::Plus)?;
/// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
/// let mut csv = Vec::new();
/// table::ensemble(&tally).write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// let csv = String::from_utf8(csv)?;
/// assert_eq!(csv.lines().nth(5), Some("4,1,0,-22/81,341/81,454/243,247/81,,,,,+-+-+"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn ensemble(tally: &Tally) -> Table<'_> {
    let has_held = tally.ensemble.has_horizontal_contacts();
    let held = has_held.then_some("held");
    let counts = ["stackings", "stand"].into_iter().chain(held);
    let counts = counts.map(Column::plain);
    let mut columns = vec![Column::plain("faults")];
    columns.extend(counts);
    for [contacts, normals] in [
        [["min_contact", "max_contact"], ["normal_min", "normal_max"]],
        [
            ["standing_min_contact", "standing_max_contact"],
            ["standing_normal_min", "standing_normal_max"],
        ],
    ] {
        columns.extend(contacts.map(|name| Column::measured(name, "mg/(3cosθ)")));
        columns.extend(normals.map(|name| Column::measured(name, "mg")));
    }
    columns.push(Column::plain("stacking"));
    let row = move |with: &WithFaults| -> Row {
        let mut cells = vec![Cell::Index(with.faults.into())];
        let counts = [Some(&with.all.stackings), Some(&with.standing.stackings)];
        let counts = counts.into_iter().chain([with.held.as_ref()]).flatten();
        cells.extend(counts.map(|count| Cell::Integer(count.clone().into())));
        for of in [&with.all, &with.standing] {
            let extremes = [
                &of.least,
                &of.greatest,
                &of.least_normal,
                &of.greatest_normal,
            ];
            cells.extend(extremes.map(|extreme| force(extreme.as_ref())));
        }
        let least = with.all.least.as_ref();
        cells.push(least.map_or(Cell::Missing, |least| {
            Cell::Word(least.stacking.to_string().into())
        }));
        Ok(cells)
    };
    Table::of_rows(columns, "rows", tally.faults.iter().map(row))
}

fn force(extreme: Option<&Extreme>) -> Cell {
    extreme.map_or(Cell::Missing, |extreme| extreme.force.clone().into())
}

/// What random stackings are, and how many stand, in one row: `layers, first, top, stackings, stand,
/// standing_probability` at the fault probability q, or `standing_lo, standing_hi` of samples (Wilson's interval), and the same
/// with `held`, where it was asked how many stand with horizontal contacts.
///
/// # Errors
/// [`Error::FaultProbability`] unless 0 ≤ q ≤ 1.
///
/// # Examples
/// ```
/// use cannonpile::disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
/// use cannonpile::table::{self, FileFormat, NumberFormat};
/// use num_rational::BigRational;
///
/// let stackings = RandomStackings::new(6, FirstSign::Plus)?;
/// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
/// let mut csv = Vec::new();
/// let half = BigRational::new(1.into(), 2.into());
/// table::ensemble_summary(&tally, &half)?.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert_eq!(
///     String::from_utf8(csv)?,
///     "layers,first,top,part,fault_probability,stackings,stand,standing_probability\n\
///      6,+,hexagon:1,1/1,1/2,16,11,11/16\n",
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn ensemble_summary(tally: &Tally, q: &BigRational) -> Result<Table<'static>, Error> {
    let stackings = tally.ensemble.stackings();
    let top = tally.ensemble.top().shape().base();
    let word = |text: String| Cell::Word(text.into());
    let mut entries = vec![
        (Column::plain("layers"), stackings.layers().into()),
        (Column::plain("first"), stackings.first().name().into()),
        (Column::plain("top"), word(format!("{top:#}"))),
        (Column::plain("part"), word(tally.shard.to_string())),
        (Column::plain("fault_probability"), word(q.to_string())),
        (
            Column::plain("stackings"),
            Cell::Integer(tally.stackings().into()),
        ),
    ];
    for (by, [count, probability, lower, upper]) in [
        (
            By::Sloping,
            [
                "stand",
                "standing_probability",
                "standing_lo",
                "standing_hi",
            ],
        ),
        (
            By::Horizontal,
            ["held", "held_probability", "held_lo", "held_hi"],
        ),
    ] {
        let Some(standing) = tally.standing(by) else {
            continue;
        };
        entries.push((Column::plain(count), Cell::Integer(standing.into())));
        if let Some(exact) = tally.standing_probability(by, q)? {
            entries.push((Column::measured(probability, ""), exact.into()));
        }
        if let Some([from, to]) = tally.standing_interval(by) {
            entries.push((Column::plain(lower), from.into()));
            entries.push((Column::plain(upper), to.into()));
        }
    }
    Ok(Table::record(entries))
}

/// Which forces a histogram is of.
///
/// # Examples
/// See [`histogram`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binned {
    /// Contact forces, in f₀.
    Forces,
    /// Normal forces of bottom spheres, in mg.
    Normals,
}

impl Binned {
    /// Returns the histograms of these forces: of all stackings with some number of faults, and of those that stand.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    /// use cannonpile::table::Binned;
    ///
    /// let stackings = RandomStackings::new(2, FirstSign::Plus)?;
    /// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
    /// let [all, standing] = Binned::Normals.histograms(&tally.faults[0]);
    /// // Three bottom spheres bear 4/3, the fifth bin of a third.
    /// assert_eq!((all.count(4), standing.count(4)), (3_u32.into(), 3_u32.into()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn histograms(self, with: &WithFaults) -> [&Histogram; 2] {
        let of = [&with.all, &with.standing];
        match self {
            Self::Forces => of.map(|of| &of.forces),
            Self::Normals => of.map(|of| &of.normals),
        }
    }
}

/// How forces are distributed at the fault probability q, a bin a row: `from, to, all, standing`. Of all piles it is the mean
/// number of forces f in one with from ≤ f < to, stackings included that cannot stand; of those that stand it is that in
/// one of them. Of samples it is the mean over them, whatever q. `None` of a part.
///
/// # Errors
/// [`Error::FaultProbability`] unless 0 ≤ q ≤ 1.
///
/// # Examples
/// ```
/// use cannonpile::disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
/// use cannonpile::table::{self, Binned, FileFormat, NumberFormat};
/// use num_rational::BigRational;
///
/// let stackings = RandomStackings::new(3, FirstSign::Plus)?;
/// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
/// let half = BigRational::new(1.into(), 2.into());
/// let table = table::histogram(&tally, Binned::Forces, &half)?.unwrap();
/// let mut csv = Vec::new();
/// table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// // FCC has 9 of f₀ and 3 of 2 f₀; HCP 3 of 2/3, 3 of 1, 6 of 5/3.
/// assert_eq!(
///     String::from_utf8(csv)?,
///     "from,to,all,standing\n2/3,1,3/2,3/2\n1,4/3,6,6\n4/3,5/3,0,0\n5/3,2,3,3\n2,7/3,3/2,3/2\n",
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn histogram<'t>(
    tally: &'t Tally,
    binned: Binned,
    q: &BigRational,
) -> Result<Option<Table<'t>>, Error> {
    let Some(weights) = tally.weights(q)? else {
        return Ok(None);
    };
    let unit = match binned {
        Binned::Forces => "mg/(3cosθ)",
        Binned::Normals => "mg",
    };
    let mut columns = ["from", "to"]
        .map(|name| Column::measured(name, unit))
        .to_vec();
    columns.extend(["all", "standing"].map(|name| Column::measured(name, "")));
    let all = tally.faults.iter().map(|with| binned.histograms(with)[0]);
    // The last bin may end beyond i64.
    let bins = all.flat_map(|all| {
        let first = i128::from(all.first);
        first..first + all.counts.len() as i128
    });
    let ends = bins.clone().min().zip(bins.max());
    let mean = move |count: &dyn Fn(&WithFaults) -> BigInt| {
        let faults = tally.faults.iter().zip(&weights);
        faults.fold(BigRational::zero(), |sum, (with, weight)| {
            sum + weight * count(with)
        })
    };
    let standing = mean(&|with| with.standing.stackings.clone().into());
    let width = tally.ensemble.bins();
    let row = move |bin: i128| -> Row {
        let end = |bin: i128| Cell::from(width * BigInt::from(bin));
        let [all, stand] =
            [0, 1].map(|of| mean(&|with| binned.histograms(with)[of].count_of(bin).into()));
        let stand = if standing.is_zero() {
            Cell::Missing
        } else {
            (stand / &standing).into()
        };
        Ok(vec![end(bin), end(bin + 1), all.into(), stand])
    };
    let bins = ends.into_iter().flat_map(|(first, last)| first..=last);
    Ok(Some(Table::of_rows(columns, "bins", bins.map(row))))
}
