//! Prints errors of sweeps and their bounds, for a comparison with other programs: `peers/run gappa` and `peers/run pychop`.
//!
//! `cargo run --release -p cannonpile-accuracy --example sweep_errors 1000 4 6` takes 1000 seeds, and HCP of 4 and of 6 layers under a
//! hexagon of 4 spheres a side. Each line has the layers, the largest force F above the floor, and two bounds on the errors in `f32`: the
//! proved one, and the probable one of one contact at 1 %. Two figures of stochastic rounding to 11 bits follow, over the contacts
//! above the floor: the sum of the mean squares of their errors, and the sum of the squares of their mean errors. Errors are
//! in units of u F.

use cannonpile::lattice::Region;
use cannonpile::num_traits::ToPrimitive;
use cannonpile::scalar::{Algebra, DoubleDouble};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Forces, Pile};
use cannonpile_accuracy::{ProbableBound, Stochastic, probable_bounds, stochastic_forces};

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let numbers = std::env::args().skip(1).map(|text| text.parse::<u64>());
    let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
    let (seeds, heights) = match numbers.split_first() {
        Some((seeds, heights)) => (*seeds, heights.to_vec()),
        None => (100, vec![4]),
    };
    for layers in heights {
        let stacking = Stacking::hcp(layers.into())?;
        let pile = Pile::under(Region::hexagon(4, 4)?, stacking)?;
        let (exact, _) = lowest::<DoubleDouble>(&pile.forces())?;
        let greatest = exact.iter().map(DoubleDouble::high).fold(0.0, f64::max);
        let (_, proved) = lowest::<f32>(&pile.forces())?;
        let bounds = probable_bounds(&pile, 24, 0.01)?;
        let probable = bounds.last().map_or(f64::NAN, ProbableBound::of_one);
        let single = 2.0_f64.powi(-24) * greatest;
        let mut sums = vec![[0.0; 2]; exact.len()];
        for seed in 1..=seeds {
            let (computed, _) = lowest::<Stochastic<11>>(&stochastic_forces(&pile, seed)?)?;
            for ((got, want), sum) in computed.iter().zip(&exact).zip(&mut sums) {
                let error = (DoubleDouble::from(got.value()) - want).high();
                let error = error * 2.0_f64.powi(11) / greatest;
                sum[0] += error;
                sum[1] += error * error;
            }
        }
        let count = seeds.to_f64().unwrap_or(f64::NAN);
        let squares: f64 = sums.iter().map(|sum| sum[1] / count).sum();
        let means: f64 = sums.iter().map(|sum| (sum[0] / count).powi(2)).sum();
        println!(
            "{layers} {greatest} {} {} {squares} {means}",
            proved / single,
            probable / single
        );
    }
    Ok(())
}

/// Returns the forces of the contacts above the floor, and the proved bound on their errors.
fn lowest<T: Algebra>(forces: &Forces<'_, T>) -> Result<(Vec<T>, f64), Failure> {
    let last = forces.pile().layers() - 2;
    let mut layers = forces.layers(Selection::Layer(last))?;
    let layer = layers.next_layer()?.ok_or("a layer is missing")?;
    let mut slices = [(); 3].map(|()| vec![T::zero(); layer.sphere_count()]);
    layer.fill(slices.each_mut().map(Vec::as_mut_slice))?;
    let bound = layer.error_bound().and_then(|bound| bound.to_f64());
    Ok((slices.concat(), bound.unwrap_or(f64::NAN)))
}
