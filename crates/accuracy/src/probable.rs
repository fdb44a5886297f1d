//! A bound of the rounding errors of a sweep that holds with a given probability.
//!
//! # Elementary roundings
//! Let g be the forces from above on a sphere, and f = G g + w the forces below it. At a sign change a float computes
//! `x₁ = g_α + g_β`, `x₂ = x₁ + g_γ`, `x₃ = 2 x₂/3`, three differences `y_l = x₃ − g_l`, and three sums `f_l = y_l + w_l`; else
//! only the three sums `g_l + w_l`. A rounding of x changes it by at most u⌊x⌋, where ⌊x⌋ is the largest power of two that is at
//! most |x|.
//!
//! The error of a contact below layer k is a sum Σ r·δ over all spheres above it, where δ are the three changes of the forces
//! below a sphere. The coefficients r are a row of a power of S. S is an isometry, so their squares sum to at most 1 in each
//! layer. The roundings of x₁, x₂ and x₃ change all three forces, by 2/3, 2/3 and 1 times their size, and
//! |r·(1, 1, 1)| ≤ √3 ‖r‖. So the squares c² of the coefficients of elementary roundings obey Σ c² ⌊x⌋² ≤ Σ_j F_j², where F_j² is
//! the largest of all spheres of layer j of
//!
//! 4/3 ⌊x₁⌋² + 4/3 ⌊x₂⌋² + 3 ⌊x₃⌋² + max_l (⌊y_l⌋² + ⌊f_l⌋²),
//!
//! or of max_l ⌊f_l⌋² without a sign change. A sphere with a load of its own has one more sum for each line. Without powers of
//! two, and for equal x, the factor would be 4/3 + 4/3 + 3 + 1 + 1 = 23/3.
//!
//! # Martingale
//! The result of an operation is rounded by η with the mean 0, given all roundings before it. It lies between two bounds: −u⌊x⌋ and
//! u⌊x⌋ for rounding to nearest, and the distances to two neighbouring floats for stochastic rounding. They are at most 2u⌊x⌋
//! apart. So the partial sums of Σ c η are a martingale. By Hoeffding's lemma, which needs the distance of the
//! two bounds only, E exp(t c η) ≤ exp(t² c² u² ⌊x⌋²/2), and
//!
//! P(|e| ≥ λ u √(Σ F_j²)) ≤ 2 exp(−λ²/2).
//!
//! The inequality of Azuma with |η| < 2u|x| would give twice the bound for stochastic rounding.
//!
//! # Fixed bounds of the intermediate results
//! F_j must not depend on the roundings, but x, y and f are results of the float. Each is at most the exact value, plus the
//! errors of the forces from above, each at most E_(j−1), plus the roundings before it. E_(j−1) is the bound of all errors of the
//! layer above. It fails with a probability of at most half of the requested one, for all layers together. Layer j with m
//! contacts has the share 1/((j+1)(j+2)) of it, so that λ = √(2 ln(4 m (j+1)(j+2)/P)). A martingale that stops as soon as E_j is
//! exceeded has increments within F_j, and differs from the true one with this probability. The other half of P is left for
//! the bound itself.

use cannonpile::scalar::{Algebra, Ring};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use num_rational::BigRational;

use crate::errors::increments;

/// A bound on the rounding errors of the contact forces below a layer, from [`probable_bounds`]. Forces and bounds are in f₀.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProbableBound {
    /// The layer, counted from the top.
    pub layer: i128,
    /// u √(Σ F_j²), the bound for λ = 1.
    pub scale: f64,
    /// λ for the error of one contact that was chosen beforehand.
    pub lambda_of_one: f64,
    /// λ for the largest error of all contacts below the layer.
    pub lambda_of_all: f64,
    /// A bound on the largest contact force below the layer.
    pub greatest: f64,
}

impl ProbableBound {
    /// Returns the bound on the error of one contact that was chosen beforehand.
    #[must_use]
    pub fn of_one(&self) -> f64 {
        self.lambda_of_one * self.scale
    }

    /// Returns the bound on the largest error of all contacts below the layer.
    #[must_use]
    pub fn of_all(&self) -> f64 {
        self.lambda_of_all * self.scale
    }
}

/// Returns bounds on the rounding errors of [`Forces::layers`](cannonpile::Forces::layers) in a float of `bits` bits, for each
/// layer with supports. Each bound fails with at most the given probability.
///
/// |e| ≤ λ u √(Σ F_j²) with u = 2^−`bits`. F_j is the norm of the roundings on a sphere of layer j, in u, each times the largest
/// factor with which it adds to e. Without loads, and while errors are small, F_j is at most √(23/3) ≈ 2.8 times the largest
/// result of an operation on a sphere of the layer. With the probability P, λ = √(2 ln(4/P)) for one contact, and
/// λ = √(2 ln(4m/P)) for all m contacts below a layer. The bound grows like √L times the forces;
/// [`Layer::error_bound`](cannonpile::Layer::error_bound) grows about like L² times the forces.
///
/// It is a theorem for stochastic rounding, in which each rounding has its own random number. For rounding to nearest it is a model: it
/// assumes that each error has the mean 0, given those before it. Equal spheres round alike. Their errors can then be larger: by
/// √g if only the g ≤ 6 images of a sphere under the symmetries of the pile are equal.
///
/// It holds for a sweep that visits every layer. A straight pile with loads or weights of single spheres needs
/// [`Method::Sweep`](cannonpile::Method::Sweep), because the closed form adds in another order. If layers are left out, multiples
/// of the increments must be numbers of the format.
///
/// It assumes that increments and loads are numbers of the format, that a third enters by a division, and that nothing over- or
/// underflows. The forces are computed in `f64`, with [`Layer::error_bound`](cannonpile::Layer::error_bound) added. The bound is
/// infinite where the latter is `None`, for fewer than 4 bits or more than 1000, and for a probability outside 0 < P < 1.
///
/// # Errors
/// [`Error::TooLarge`] for a layer that does not fit in memory, and [`Error::Overflow`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use cannonpile::stacking::Stacking;
/// use cannonpile_accuracy::probable_bounds;
///
/// let pile = Pile::under(Region::hexagon(4, 4)?, Stacking::hcp(40)?)?;
/// let bounds = probable_bounds(&pile, 24, 0.01)?;
/// let last = bounds.last().unwrap();
/// // √(2 ln 400).
/// assert!((last.lambda_of_one - 3.46).abs() < 0.01);
/// // In u times the largest force: the worst case is 470 times as large or more.
/// let units = last.of_all() / last.greatest / 2.0_f64.powi(-24);
/// assert!(units < 50.0, "{units}");
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn probable_bounds(
    pile: &Pile,
    bits: u32,
    probability: f64,
) -> Result<Vec<ProbableBound>, Error> {
    let shape = pile.shape();
    let has_extras = pile.loads().len() > 0
        || pile.weights().next().is_some()
        || pile.horizontal_forces().len() > 0;
    // No increment of an ordinary sphere is larger, on any base, by `formula::load_increments`.
    let [x, y] = pile
        .tilt()
        .each_ref()
        .map(|part| f64::from_rational(part).abs());
    let weight = if pile.is_weightless() { 0.0 } else { 1.0 };
    let ordinary = weight * (2.0 + 2.0 * x + 4.0 * y);
    let is_bound = (4..=1000).contains(&bits) && probability > 0.0 && probability < 1.0;
    let u = (-f64::from(bits)).exp2();
    let lambda = |contacts: f64| {
        if is_bound {
            (2.0 * (4.0 * contacts / probability).ln()).sqrt()
        } else {
            f64::INFINITY
        }
    };
    let mut layers = pile.forces::<f64>().layers(Selection::All)?;
    let mut bounds = Vec::new();
    // A bound of the errors of the layer above, and Σ F_j².
    let (mut margin, mut sum) = (0.0, 0.0);
    let mut slices = [(); 3].map(|()| Vec::new());
    while let Some(layer) = layers.next_layer()? {
        let k = layer.k();
        if layer.is_floor() {
            break;
        }
        for slice in &mut slices {
            slice.resize(layer.sphere_count(), 0.0);
        }
        layer.fill(slices.each_mut().map(|slice| &mut slice[..]))?;
        let off = match layer.error_bound() {
            Some(bound) => f64::from_rational(&bound),
            None => f64::INFINITY,
        };
        let own = if has_extras {
            increments(pile, k)?
        } else {
            // All spheres are ordinary.
            let site = pile.sites(Selection::Layer(k))?.take(1);
            site.map(|site| pile.own_increments(site)).collect()
        };
        let own: Vec<[f64; 3]> = own
            .iter()
            .map(|own| own.each_ref().map(f64::from_rational))
            .collect();
        let turns = k > 0 && shape.sign_below(k - 1) != shape.sign_below(k);
        let (mut most, mut greatest) = (0.0_f64, 0.0_f64);
        for n in 0..layer.sphere_count() {
            let below = slices.each_ref().map(|line| line[n]);
            let sphere = Sphere {
                below,
                own: own[if has_extras { n } else { 0 }],
                ordinary: has_extras.then_some(ordinary),
            };
            most = most.max(sphere.squares(turns, margin + off, 2.0 * u));
            greatest = below.iter().fold(greatest, |most, x| most.max(x.abs()));
        }
        sum += most;
        let spheres = f64::from_rational(&BigRational::from_integer(layer.sphere_count().into()));
        let contacts = spheres * f64::from(pile.dimension().number());
        let depth = f64::from_integer(k);
        // A few hundred roundings of f64.
        let scale = if is_bound {
            u * sum.sqrt() * (1.0 + 1e-12)
        } else {
            f64::INFINITY
        };
        margin = lambda(contacts * (depth + 1.0) * (depth + 2.0)) * scale;
        bounds.push(ProbableBound {
            layer: k,
            scale,
            lambda_of_one: lambda(1.0),
            lambda_of_all: lambda(contacts),
            greatest: greatest + off,
        });
    }
    Ok(bounds)
}

/// The forces below a sphere, and what it adds to its lines.
struct Sphere {
    below: [f64; 3],
    own: [f64; 3],
    /// A bound of what an ordinary sphere adds, if the sweep adds the rest apart.
    ordinary: Option<f64>,
}

impl Sphere {
    /// Returns the share of this sphere in F_j². The forces from above have errors of at most `off`, and ρ bounds the relative
    /// error of an operation.
    fn squares(&self, turns: bool, off: f64, rho: f64) -> f64 {
        // G is its own inverse, so that G h are the forces from above.
        let h = [0, 1, 2].map(|line| self.below[line] - self.own[line]);
        let total = h[0] + h[1] + h[2];
        let (mut shared, mut off) = (0.0, off);
        if turns {
            let first = (4.0 / 3.0 * total - h[0] - h[1]).abs() + 2.0 * off;
            let second = total.abs() + 3.0 * off + rho * first;
            let third = 2.0 / 3.0 * (1.0 + rho) * second;
            off = 5.0 / 3.0 * off + rho * (2.0 / 3.0 * (first + second) + third);
            shared = 4.0 / 3.0 * (square(first) + square(second)) + 3.0 * square(third);
        }
        let of_line = |line: usize| {
            let difference = h[line].abs() + off;
            let mut off = off;
            let mut squares = 0.0;
            if turns {
                squares += square(difference);
                off += rho * difference;
            }
            if let Some(ordinary) = self.ordinary {
                let partial = h[line].abs() + self.own[line].abs() + ordinary + off;
                squares += square(partial);
                off += rho * partial;
            }
            squares + square(self.below[line].abs() + off)
        };
        shared + [0, 1, 2].map(of_line).into_iter().fold(0.0, f64::max)
    }
}

/// Returns the square of the largest power of two that is at most `x`, which has a few roundings of `f64`.
fn square(x: f64) -> f64 {
    let power = f64::from_bits((x * (1.0 + 1e-12)).to_bits() & f64::INFINITY.to_bits());
    power * power
}
