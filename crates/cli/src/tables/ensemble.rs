//! The tables of an ensemble of random stackings.

use cannonpile::shape::Anchor;
use cannonpile_dem::table::{Cell, Column, Row, Table};
use cannonpile_disorder::{ContactSet, Error, Extreme, ForceKind, Tally, WithFaults};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

/// Returns the statistics of random stackings, a row for each number of faults.
///
/// The columns are `faults, stackings, stand, held, min_contact, max_contact, normal_min, normal_max` over all stackings, the
/// last four again over the stable ones, with the prefix `standing_`, and `stacking`, the first one with the smallest
/// contact force. The column `held` counts the stackings that are stable with horizontal contacts. It exists only if the
/// ensemble includes horizontal contacts.
///
/// With a base the column `left_out` after `stackings` counts those that the base does not support, and `stacking` is read
/// from the base up.
#[must_use]
pub(crate) fn ensemble(tally: &Tally) -> Table<'_> {
    let has_held = tally.ensemble.has_horizontal_contacts();
    let on_base = matches!(tally.ensemble.anchor(), Anchor::Base(_));
    let counts = [
        Some("stackings"),
        on_base.then_some("left_out"),
        Some("stand"),
        has_held.then_some("held"),
    ];
    let mut columns = vec![Column::plain("faults")];
    columns.extend(counts.into_iter().flatten().map(Column::plain));
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
        let counts = [
            Some(&with.all.stackings),
            with.left_out.as_ref(),
            Some(&with.standing.stackings),
            with.held.as_ref(),
        ];
        let counts = counts.into_iter().flatten();
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
            let stacking = &least.stacking;
            let read = if on_base {
                stacking.reversed().to_string()
            } else {
                stacking.to_string()
            };
            Cell::Word(read.into())
        }));
        Ok(cells)
    };
    Table::of_rows(columns, "rows", tally.faults.iter().map(row))
}

fn force(extreme: Option<&Extreme>) -> Cell {
    extreme.map_or(Cell::Missing, |extreme| extreme.force.clone().into())
}

/// Returns one row with the options of the ensemble and the number of stable stackings.
///
/// The columns are `layers, first, top, part, fault_probability, stackings, stand`, and `standing_probability` at the fault
/// probability q. With a base they are `base` instead of `top`, and `left_out` after `stackings`. For samples, Wilson's interval `standing_lo, standing_hi` replaces the probability. With horizontal
/// contacts the same columns follow with `held`.
///
/// # Errors
/// [`Error::FaultProbability`] unless 0 ≤ q ≤ 1.
pub(crate) fn ensemble_summary(tally: &Tally, q: &BigRational) -> Result<Table<'static>, Error> {
    let stackings = tally.ensemble.stackings();
    let anchor = tally.ensemble.anchor();
    let (Anchor::Top(layer) | Anchor::Base(layer)) = anchor;
    let word = |text: String| Cell::Word(text.into());
    let mut entries = vec![
        (Column::plain("layers"), stackings.layers().into()),
        (Column::plain("first"), stackings.first().name().into()),
        (Column::plain(anchor.name()), word(format!("{layer:#}"))),
        (Column::plain("part"), word(tally.shard.to_string())),
        (Column::plain("fault_probability"), word(q.to_string())),
        (
            Column::plain("stackings"),
            Cell::Integer(tally.stackings().into()),
        ),
    ];
    if let Some(left_out) = tally.left_out() {
        entries.push((Column::plain("left_out"), Cell::Integer(left_out.into())));
    }
    for (by, [count, probability, lower, upper]) in [
        (
            ContactSet::Sloping,
            [
                "stand",
                "standing_probability",
                "standing_lo",
                "standing_hi",
            ],
        ),
        (
            ContactSet::WithHorizontal,
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

/// Returns the histogram of forces at the fault probability q, a row for each bin: `from, to, all, standing`.
///
/// `all` is the mean number of forces f of a pile with from ≤ f < to, over all stackings. `standing` is the mean over the
/// stable ones. For samples both are means over the samples and do not depend on q. The result is `None` for a part of an
/// ensemble, and if the base supports no stacking that occurs at q.
///
/// # Errors
/// [`Error::FaultProbability`] unless 0 ≤ q ≤ 1.
pub(crate) fn histogram<'t>(
    tally: &'t Tally,
    binned: ForceKind,
    q: &BigRational,
) -> Result<Option<Table<'t>>, Error> {
    let Some(weights) = tally.weights(q)? else {
        return Ok(None);
    };
    let unit = match binned {
        ForceKind::Contact => "mg/(3cosθ)",
        ForceKind::Normal => "mg",
    };
    let mut columns = ["from", "to"]
        .map(|name| Column::measured(name, unit))
        .to_vec();
    columns.extend(["all", "standing"].map(|name| Column::measured(name, "")));
    let all = tally.faults.iter().map(|with| binned.histograms(with)[0]);
    // The end of the last bin may exceed the range of i64.
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
    let width = tally.ensemble.bin_width();
    let row = move |bin: i128| -> Row {
        let end = |bin: i128| Cell::from(width * BigInt::from(bin));
        let [all, stand] =
            [0, 1].map(|of| mean(&|with| binned.histograms(with)[of].count(bin).into()));
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

#[cfg(test)]
mod tests {
    use cannonpile::lattice::Region;
    use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};

    use super::super::test::{csv, ratio};
    use super::*;

    fn tally(layers: i128) -> Tally {
        let stackings = RandomStackings::new(layers, FirstSign::Plus).unwrap();
        let ensemble = Ensemble::under(Region::SITE, stackings).unwrap();
        ensemble.run(&Choice::All, Shard::WHOLE).unwrap()
    }

    #[test]
    fn row_for_each_number_of_faults() {
        let csv = csv(ensemble(&tally(6)));
        let row = "4,1,0,-22/81,341/81,454/243,247/81,,,,,+-+-+";
        assert_eq!(csv.lines().nth(5), Some(row));
    }

    #[test]
    fn summary_counts_stable_stackings() {
        let summary = ensemble_summary(&tally(6), &ratio(1, 2)).unwrap();
        assert_eq!(
            csv(summary),
            "layers,first,top,part,fault_probability,stackings,stand,standing_probability\n\
             6,+,hexagon:1,1/1,1/2,16,11,11/16\n",
        );
    }

    /// FCC has 9 contact forces of 1 f₀ and 3 of 2 f₀. HCP has 3 of 2/3, 3 of 1 and 6 of 5/3.
    #[test]
    fn histogram_of_three_layers() {
        let tally = tally(3);
        let table = histogram(&tally, ForceKind::Contact, &ratio(1, 2)).unwrap();
        assert_eq!(
            csv(table.expect("a whole ensemble")),
            "from,to,all,standing\n2/3,1,3/2,3/2\n1,4/3,6,6\n4/3,5/3,0,0\n5/3,2,3,3\n2,7/3,3/2,3/2\n",
        );
    }

    /// The last bin of this artificial tally ends beyond the range of i64.
    #[test]
    fn histogram_of_bins_at_the_end_of_i64() {
        let stackings = RandomStackings::new(2, FirstSign::Random).unwrap();
        let ensemble = Ensemble::under(Region::SITE, stackings).unwrap();
        let mut tally = ensemble.run(&Choice::All, Shard::WHOLE).unwrap();
        for with in &mut tally.faults {
            let bins = &mut with.all.forces;
            bins.first = i64::MAX;
            bins.counts = vec![4_u32.into(); 2];
        }
        let table = histogram(&tally, ForceKind::Contact, &ratio(1, 3)).unwrap();
        let csv = csv(table.expect("a whole ensemble"));
        let width = tally.ensemble.bin_width();
        let ends = [0, 1, 2].map(|n| width * BigInt::from(i128::from(i64::MAX) + n));
        let [first, middle, last] = ends.map(|end| end.to_string());
        let rows: Vec<&str> = csv.lines().skip(1).collect();
        // Each of the two stackings has weight 1/2, and neither has a sign change.
        let expected = [(&first, &middle), (&middle, &last)];
        let expected = expected.map(|(from, to)| format!("{from},{to},2,0"));
        assert_eq!(rows, expected);
    }
}
