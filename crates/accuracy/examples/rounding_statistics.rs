//! Prints how far the probable bound is above the errors of stochastic rounding.
//!
//! `cargo run --release -p cannonpile-accuracy --example rounding_statistics 1000 10 40 160` takes 1000 seeds, and piles of 10, 40
//! and 160 layers. Each line has the bound at 1 %, divided by the 99 % quantile of the errors: for the contact with the largest
//! force, and for the largest error of all contacts above the floor. The exit status is 1 if a bound is below its quantile, or,
//! for all contacts in 11 and 24 bits, more than 10 times as large. With 8 bits the bound of the errors from above is a large
//! part of each result, and rounding to a power of two makes it larger.

use std::process::ExitCode;

use cannonpile::lattice::Region;
use cannonpile::num_rational::BigRational;
use cannonpile::scalar::{Algebra, DoubleDouble};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use cannonpile_accuracy::{ProbableBound, Stochastic, probable_bounds, stochastic_forces};

/// The period of each stacking.
const PERIODS: [&str; 3] = ["+-", "++--", "+--+-++-"];

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let numbers = std::env::args().skip(1).map(|text| text.parse::<u64>());
    let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
    // `cargo test` gives no numbers.
    let (seeds, heights) = match numbers.split_first() {
        Some((seeds, heights)) => (*seeds, heights.to_vec()),
        None => (100, vec![10]),
    };
    let mut are_near = true;
    println!("layers  stacking    bits  one contact  all contacts");
    for layers in heights {
        for period in PERIODS {
            let steps = period.chars().cycle().take(usize::try_from(layers - 1)?);
            let pile = Pile::under(Region::hexagon(2, 2)?, steps.collect::<String>().parse()?)?;
            let exact = forces::<BigRational>(&pile.forces(), pile.layers() - 2)?;
            let exact: Vec<_> = exact.iter().map(DoubleDouble::from_rational).collect();
            for (bits, ratios) in [
                (8, ratios::<8> as fn(&_, &[_], _) -> _),
                (11, ratios::<11>),
                (24, ratios::<24>),
            ] {
                let [one, all]: [f64; 2] = ratios(&pile, &exact, seeds)?;
                println!("{layers:6}  {period:10}  {bits:4}  {one:11.2}  {all:12.2}");
                are_near &= one >= 1.0 && all >= 1.0 && (bits < 11 || all <= 10.0);
            }
        }
    }
    Ok(ExitCode::from(u8::from(!are_near)))
}

/// Returns the bounds over the quantiles, for one contact and for all of the layer above the floor.
fn ratios<const P: u32>(
    pile: &Pile,
    exact: &[DoubleDouble],
    seeds: u64,
) -> Result<[f64; 2], Error> {
    // The contact with the largest force.
    let by_force = |(_, a): &(usize, &DoubleDouble), (_, b): &(usize, &DoubleDouble)| {
        a.high().total_cmp(&b.high())
    };
    let one = exact
        .iter()
        .enumerate()
        .max_by(by_force)
        .map_or(0, |(n, _)| n);
    let mut errors = [Vec::new(), Vec::new()];
    for seed in 1..=seeds {
        let computed = forces(&stochastic_forces::<P>(pile, seed)?, pile.layers() - 2)?;
        let pairs = computed.iter().zip(exact);
        let error = |(got, want): (&Stochastic<P>, &DoubleDouble)| {
            (DoubleDouble::from(got.value()) - want).high().abs()
        };
        let of_all: Vec<f64> = pairs.map(error).collect();
        errors[0].push(of_all[one]);
        errors[1].push(of_all.into_iter().fold(0.0, f64::max));
    }
    let quantiles = errors.map(|mut errors| {
        errors.sort_by(f64::total_cmp);
        errors[errors.len() * 99 / 100]
    });
    let bounds = probable_bounds(pile, P, 0.01)?;
    let bound = bounds
        .last()
        .map(|bound| [ProbableBound::of_one, ProbableBound::of_all].map(|of| of(bound)));
    let bound = bound.unwrap_or([0.0; 2]);
    Ok([bound[0] / quantiles[0], bound[1] / quantiles[1]])
}

/// Returns the contact forces below a layer, α first.
fn forces<T: Algebra>(forces: &cannonpile::Forces<'_, T>, k: i128) -> Result<Vec<T>, Error> {
    let layers = forces.layers(Selection::Layer(k))?;
    let mut slices = [(); 3].map(|()| Vec::new());
    let spheres = layers.slice_len()?;
    for slice in &mut slices {
        slice.resize(spheres, T::zero());
    }
    layers.fill(slices.each_mut().map(|slice| &mut slice[..]))?;
    Ok(slices.concat())
}
