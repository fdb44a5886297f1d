//! The errors of some piles, format by format.

use std::fmt::Write;

use cannonpile::Pile;
use cannonpile::lattice::Region;
use cannonpile::num_rational::BigRational;
use cannonpile::scalar::{Algebra, DoubleDouble, Exactness};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile_accuracy::probable_bounds;
use num_traits::{Signed, ToPrimitive};

use crate::format::{Bits, Brain, Format, Half};
use crate::random::Random;

/// The probability with which a probable bound may fail for some contact above the floor.
const RISK: f64 = 0.01;

/// Exact forces, or forces so close to them that the difference is invisible.
pub(crate) trait Reference: Algebra {
    fn minus(&self, value: DoubleDouble) -> f64;
    fn size(&self) -> f64;
}

impl Reference for BigRational {
    fn minus(&self, value: DoubleDouble) -> f64 {
        f64::from_rational(&(self - value.to_rational().expect("a finite number")))
    }

    fn size(&self) -> f64 {
        f64::from_rational(&self.abs())
    }
}

impl Reference for DoubleDouble {
    fn minus(&self, value: DoubleDouble) -> f64 {
        (*self - value).high()
    }

    fn size(&self) -> f64 {
        self.high().abs()
    }
}

/// Returns the table as CSV.
pub(crate) fn table(is_smoke: bool) -> String {
    let mut text = String::from("stacking,layers,format,reference,error,mean,probable,proved\n");
    let exact = if is_smoke {
        &[10, 20][..]
    } else {
        &[10, 20, 40, 80, 160]
    };
    for layers in exact {
        let case = Case::<BigRational>::hcp(*layers);
        case.in_halves(&mut text);
        case.in_floats(&mut text);
        case.row::<DoubleDouble>(&mut text);
        case.row::<Bits<11, false>>(&mut text);
    }
    if is_smoke {
        return text;
    }
    for layers in [320, 640] {
        let case = Case::<DoubleDouble>::hcp(layers);
        case.in_halves(&mut text);
        case.in_floats(&mut text);
    }
    Case::<DoubleDouble>::hcp(1000).in_floats(&mut text);
    for layers in [160, 320] {
        Case::<DoubleDouble>::random(layers).in_halves(&mut text);
    }
    text
}

/// A pile and its exact forces above the floor.
struct Case<R> {
    stacking: &'static str,
    pile: Pile,
    exact: Vec<R>,
}

impl<R: Reference> Case<R> {
    /// Hexagonal close packing, with a sign change at every layer.
    fn hcp(layers: i128) -> Self {
        Self::new("HCP", Stacking::hcp(layers).expect("a stacking"))
    }

    fn random(layers: i128) -> Self {
        let mut random = Random(1);
        let signs = (1..layers).map(|_| if random.below(2) == 0 { '+' } else { '-' });
        let signs: String = signs.collect();
        Self::new("random", signs.parse().expect("signs"))
    }

    fn new(stacking: &'static str, signs: Stacking) -> Self {
        let pile = under_a_hexagon(signs);
        let exact = lowest(&pile).0;
        Self {
            stacking,
            pile,
            exact,
        }
    }

    fn in_halves(&self, text: &mut String) {
        self.row::<Half>(text);
        self.row::<Brain>(text);
        self.row::<Bits<11, true>>(text);
        self.row::<Bits<8, true>>(text);
    }

    fn in_floats(&self, text: &mut String) {
        self.row::<f32>(text);
        self.row::<f64>(text);
        self.row::<Bits<24, true>>(text);
    }

    /// Prints a row, and adds it to the table.
    fn row<T: Format>(&self, text: &mut String) {
        let (forces, bound) = lowest::<T>(&self.pile);
        let ([worst, mean], unit) = errors(&forces, &self.exact);
        let (stacking, layers, label) = (self.stacking, self.pile.layers(), T::LABEL);
        let bounds = probable_bounds(&self.pile, T::BITS, RISK).expect("forces");
        let probable = match bounds.last() {
            // A double-double rounds in other ways.
            Some(bound) if label != DoubleDouble::LABEL => format!("{:.0}", bound.of_all() / unit),
            _ => String::new(),
        };
        let proved = bound.map_or_else(String::new, |bound| {
            assert!(worst * unit <= bound, "{label}: the bound is proved");
            format!("{:.0}", bound / unit)
        });
        let reference = if R::EXACTNESS == Exactness::Exact {
            "exact"
        } else {
            "double-double"
        };
        let row = format!(
            "{stacking},{layers},\"{label}\",{reference},{worst:.2},{mean:.2},{probable},{proved}"
        );
        println!("{row}");
        writeln!(text, "{row}").expect("memory");
    }
}

/// Returns a pile under a hexagon with four spheres a side.
pub(crate) fn under_a_hexagon(stacking: Stacking) -> Pile {
    let top = Region::hexagon(4, 4).expect("a hexagon");
    Pile::under(top, stacking).expect("a pile")
}

/// Returns the forces of the contacts above the floor, by direction, and the proved bound of their errors.
pub(crate) fn lowest<T: Algebra>(pile: &Pile) -> (Vec<T>, Option<f64>) {
    let last = Selection::Layer(pile.layers() - 2);
    let mut layers = pile.forces::<T>().layers(last).expect("a sweep");
    let layer = layers.next_layer().expect("a sweep").expect("a layer");
    let mut slices = [(); 3].map(|()| vec![T::from_integer(0); layer.sphere_count()]);
    layer
        .fill(slices.each_mut().map(Vec::as_mut_slice))
        .expect("forces within the range of the format");
    let bound = layer.error_bound().and_then(|bound| bound.to_f64());
    (slices.concat(), bound)
}

/// Returns the greatest error, and the mean of all, in u of the greatest force; and this unit.
pub(crate) fn errors<T: Format, R: Reference>(forces: &[T], exact: &[R]) -> ([f64; 2], f64) {
    let unit = exact.iter().map(R::size).fold(0.0, f64::max) * (-f64::from(T::BITS)).exp2();
    let (mut worst, mut sum, mut count) = (0.0_f64, 0.0, 0.0);
    for (force, exact) in forces.iter().zip(exact) {
        let error = -exact.minus(force.wide()) / unit;
        worst = worst.max(error.abs());
        sum += error;
        count += 1.0;
    }
    ([worst, sum / count], unit)
}
