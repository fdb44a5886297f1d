//! Sign changes at every one of 1,000 layers, under a hexagon with 40 spheres a side: 300 million spheres. For slow scalars,
//! 250 layers with 9 million spheres.

use core::fmt;

use cannonpile::Pile;
use cannonpile::scalar::{Algebra, DoubleDouble, Exactness, Interval};
use cannonpile::shape::Selection;
use cannonpile_testkit::real::Bounded;
use num_rational::BigRational;
use num_traits::Signed;

use super::cases::{self, Case};
use super::errors::{Worst, distance, unit};

/// The worst errors of sweeps at the lowest contacts, in units of the greatest force there.
pub(crate) struct Deep {
    case: Case,
    sample: Sample,
    greatest: BigRational,
    lines: Vec<String>,
}

/// Positions in a layer, and the exact forces on the spheres below.
type Sample = Vec<(usize, [BigRational; 3])>;

impl Deep {
    /// The numbers of layers that the tests measure: in floats only, and in every scalar.
    pub(crate) const LAYERS: [i128; 2] = [1000, 250];

    /// The exact forces, without measurements.
    fn new(layers: i128) -> Self {
        let case = cases::alternating(40, layers);
        let k = case.pile.layers() - 2;
        let mut layers = case
            .pile
            .forces::<BigRational>()
            .layers(Selection::Layer(k))
            .expect("a sweep within its limit");
        let layer = layers
            .next_layer()
            .expect("a sweep within its limit")
            .expect("a layer");
        let sites = case.pile.rows(Selection::Layer(k)).expect("a layer");
        let sample: Sample = sites
            .flatten()
            .enumerate()
            .step_by(997)
            .map(|(place, site)| (place, layer.to_below(site).expect("forces")))
            .collect();
        let forces = sample.iter().flat_map(|(_, forces)| forces);
        let greatest = forces.map(Signed::abs).max().expect("a force");
        Self {
            case,
            sample,
            greatest,
            lines: Vec::new(),
        }
    }

    /// Measures in every scalar.
    pub(crate) fn measured(layers: i128) -> Self {
        let mut deep = Self::in_floats(layers);
        let ulp = unit::<f64>(&deep.greatest);
        let twice = deep.swept::<DoubleDouble>(&ulp).as_power();
        let widths = deep.swept::<Interval>(&ulp).as_power();
        deep.lines.push(format!("| double-double | {twice} |"));
        deep.lines.push(format!("| interval | {widths} |"));
        deep
    }

    /// Measures in floats, which is fast.
    pub(crate) fn in_floats(layers: i128) -> Self {
        let mut deep = Self::new(layers);
        let double = deep.swept::<f64>(&unit::<f64>(&deep.greatest));
        let single = deep.swept::<f32>(&unit::<f32>(&deep.greatest));
        deep.lines.push(format!("| `f64` | {double} |"));
        deep.lines.push(format!("| `f32` | {single} |"));
        deep
    }

    /// The worst error of a sweep. Intervals must contain the exact forces, and their error is that of the ends.
    fn swept<T: Algebra + Bounded>(&self, ulp: &BigRational) -> Worst {
        let forces = lowest_contacts::<T>(&self.case.pile);
        let mut worst = Worst::none();
        for (place, exact) in &self.sample {
            for (forces, exact) in forces.iter().zip(exact) {
                let force = &forces[*place];
                if T::EXACTNESS == Exactness::Enclosure {
                    let bounds = force.enclosure();
                    let holds = bounds.is_none_or(|bounds| bounds.contains(exact));
                    assert!(holds, "{exact}");
                }
                worst.add(distance(force, exact).map(|error| error / ulp));
            }
        }
        worst
    }
}

/// The forces of the layer above the bottom layer, by direction.
fn lowest_contacts<T: Algebra>(pile: &Pile) -> [Vec<T>; 3] {
    let k = pile.layers() - 2;
    let layers = pile
        .forces::<T>()
        .layers(Selection::Layer(k))
        .expect("a sweep within its limit");
    let nothing = T::from_rational(&BigRational::default());
    let mut forces = [(); 3].map(|()| vec![nothing.clone(); layers.slice_len().expect("few")]);
    layers
        .fill(forces.each_mut().map(Vec::as_mut_slice))
        .expect("forces");
    forces
}

impl fmt::Display for Deep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let contacts = 3 * self.sample.len();
        writeln!(
            f,
            "{}: the worst errors of {contacts} contacts above the floor,\n\
             in units in the last place of the greatest; of double-double and of the ends of intervals, in those of `f64`.\n\
             Each interval holds the exact force.\n\n\
             | scalar | error |\n|---|--:|",
            self.case.name
        )?;
        self.lines.iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}
