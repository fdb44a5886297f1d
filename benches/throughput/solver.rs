//! Compares the time of the closed form with that of a sparse solver of the equations of equilibrium.

use std::hint::black_box;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::Direction;
use cannonpile::shape::Selection;
use cannonpile::{Packing, Pile};
use num_rational::BigRational;

use crate::peers::equations::Equations;
use crate::peers::lu;
use crate::peers::network::Network;
use crate::time::{ratio, seconds};
use crate::{Extent, Results};

/// Compares sparse LU (analysis, factorisation and solution, without the assembly of the equations) with the closed
/// form. The time of the closed form includes its table and the writing of all forces into slices.
pub(crate) fn measure(extent: Extent, results: &mut Results) {
    let pile = Pile::triangular(extent.size(60, 8)).expect("a pile");
    let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).expect("a spacing");
    let packing = Packing::new(&pile, &spacing).expect("room");
    let equations = Equations::<f64>::new(&Network::new(&pile));
    let spheres = equations.loads.len() / 3;
    let mut slices = [(); 3].map(|()| vec![1.5; spheres]);
    let mut solved = Vec::new();
    let ratio = ratio(
        extent.pairs,
        || seconds(|| solved = black_box(lu::forces(&equations))),
        || {
            let time = seconds(|| {
                let [a, b, c] = slices.each_mut().map(Vec::as_mut_slice);
                let layers = packing.layers::<f64>(Selection::All).expect("floats");
                layers.fill([a, b, c]).expect("lengths");
            });
            black_box(&slices);
            time
        },
    );
    let sites = pile.rows(Selection::All).expect("rows").off_the_floor();
    for (place, _) in sites.flatten().enumerate() {
        for direction in Direction::ALL {
            let (closed, solved) = (
                slices[direction.index()][place],
                solved[3 * place + direction.index()],
            );
            assert!(
                (closed - solved).abs() < 1e-9 * closed,
                "{closed} is not {solved}"
            );
        }
    }
    results.push(("sparse_lu_over_closed_form".into(), ratio));
}
