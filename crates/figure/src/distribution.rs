//! The force distribution over random stackings.

use cannonpile::shape::Anchor;
use cannonpile_disorder::ForceKind;
use cannonpile_disorder::{Choice, Tally};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use super::caption::{LIMIT, counted, readable};
use super::chart::{Chart, around_zero, colours};
use super::glyph::Point;
use super::page::Figure;
use crate::Error;

/// Draws the probability density P(f) of the contact forces, or of the base normal forces, over random stackings.
///
/// One curve is for all stackings, the other for the stable ones. The vertical axis is log₁₀ P; empty bins are left
/// out. Enumerated stackings are weighted by their probability at the fault probability `q`. For samples `q` has no
/// effect. The result is `None` if the stackings have no [weights](Tally::weights): the tally covers only a part of an
/// ensemble, or the base supports no stacking that occurs at `q`.
///
/// # Errors
/// [`FaultProbability`](cannonpile_disorder::Error::FaultProbability) unless 0 ≤ q ≤ 1; [`Error::TooManyGlyphs`] for more than 20 000 bins.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
/// use cannonpile_disorder::ForceKind;
/// use num_rational::BigRational;
///
/// let stackings = RandomStackings::new(6, FirstSign::Plus)?;
/// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
/// let half = BigRational::new(1.into(), 2.into());
/// let figure = cannonpile_figure::distribution(&tally, ForceKind::Contact, &half)?.unwrap();
/// assert!(figure.to_string().contains("stable stackings"));
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn distribution(
    tally: &Tally,
    binned: ForceKind,
    q: &BigRational,
) -> Result<Option<Figure>, Error> {
    let Some(weights) = tally.weights(q)? else {
        return Ok(None);
    };
    let width = tally.ensemble.bin_width();
    let mut curves = Vec::new();
    for (n, name) in ["all stackings", "stable stackings"]
        .into_iter()
        .enumerate()
    {
        let faults = || {
            tally
                .faults
                .iter()
                .map(|with| binned.histograms(with)[n])
                .zip(&weights)
        };
        let bins = faults().flat_map(|(of, _)| (of.first..).zip(&of.counts).map(|(bin, _)| bin));
        let Some((first, last)) = bins.clone().min().zip(bins.max()) else {
            continue;
        };
        let count = (i128::from(last) - i128::from(first) + 1).unsigned_abs();
        readable(&count.into(), LIMIT, "bins", "use wider bins")?;
        let share = |bin: i64| {
            faults().fold(BigRational::zero(), |sum, (of, weight)| {
                sum + weight * BigInt::from(of.count(bin))
            })
        };
        let shares: Vec<BigRational> = (first..=last).map(share).collect();
        let all: BigRational = shares.iter().sum();
        if all.is_zero() {
            continue;
        }
        let density = |share: &BigRational| (share / &all / width).to_f64();
        let end = |bin: i64| (width * BigInt::from(bin)).to_f64();
        let steps = (first..).zip(&shares).filter_map(|(bin, share)| {
            let density = density(share)?;
            Some([end(bin)?, end(bin + 1)?, density])
        });
        curves.push((name, steps.collect::<Vec<_>>()));
    }
    let met = || {
        let steps = curves.iter().flat_map(|(_, steps)| steps);
        steps.filter(|[.., density]| *density > 0.0)
    };
    let across = around_zero(met().flat_map(|[from, to, _]| [*from, *to]));
    let upwards = around_zero(met().map(|[.., density]| density.log10()));
    let margin = ((upwards[1] - upwards[0]) * 0.05).max(0.1);
    // The axis has a positive length even if there are no forces.
    let across = [across[0], across[1].max(across[0] + 1.0)];
    let chart = Chart::new(across, [upwards[0] - margin, upwards[1] + margin]);
    let colours = colours(2);
    let mut glyphs = Vec::new();
    for ((_, steps), colour) in curves.iter().zip(&colours) {
        for run in steps.split(|[.., density]| *density <= 0.0) {
            let ends = run.iter().flat_map(|[from, to, density]| -> [Point; 2] {
                [[*from, density.log10()], [*to, density.log10()]]
            });
            if !run.is_empty() {
                glyphs.push(chart.curve(ends, colour));
            }
        }
    }
    let names = curves.iter().map(|(name, _)| (*name).to_owned());
    glyphs.extend(chart.legend(names.zip(colours.iter().cloned())));
    let (title, name, unit) = match binned {
        ForceKind::Contact => ("Contact forces of random stackings", "f", "mg/(3cosθ)"),
        ForceKind::Normal => ("Normal forces of random stackings on the floor", "N", "mg"),
    };
    let stackings = counted(&tally.stackings().into(), "stacking");
    let layers = counted(&tally.ensemble.stackings().layers().into(), "layer");
    let anchor = tally.ensemble.anchor();
    let (Anchor::Top(layer) | Anchor::Base(layer)) = anchor;
    let drawn = match &tally.choice {
        Choice::All => format!("q = {q}"),
        Choice::Drawn(_) => "drawn at random".into(),
    };
    Ok(Some(Figure {
        axes: Some(chart.axes([format!("{name} in {unit}"), format!("log₁₀ P({name})")])),
        ..Figure::new(
            title.into(),
            format!(
                "{layers}, {} {layer:#}, {stackings}, {drawn}",
                anchor.name()
            ),
            chart.panel,
            glyphs,
        )
    }))
}
