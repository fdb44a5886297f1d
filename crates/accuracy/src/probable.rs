//! A bound of the rounding errors of a sweep that holds with a given probability.
//!
//! # Elementary roundings
//! Let g be the forces from above on a sphere, and f = G g + w the forces below it. A float computes
//! `x₁ = g_α + g_β`, `x₂ = x₁ + g_γ`, `x₃ = 2 x₂/3`, three differences `x₃ − g_l`, and three sums with w. Let ρ = 2u. With
//! ‖g‖ ≤ Γ the exact results of these operations are at most √2 Γ, √3 Γ, 2/√3 Γ, Γ and |f_l|, times powers of 1 + ρ. The
//! roundings η₁, η₂ and η₃ change all three forces below, by 2/3, 2/3 and 1 times η.
//!
//! The error of a contact below layer k is a sum Σ r·δ over all spheres above it, where δ are the three changes of the forces
//! below a sphere. The coefficients r are a row of a power of S. S is an isometry, so their squares sum to at most 1 in each
//! layer. In terms of the elementary roundings, |r·(1, 1, 1)| ≤ √3 ‖r‖ gives for the squares c² of their coefficients
//!
//! Σ c² x² ≤ Σ_j F_j², F_j² = 3 (4/9·2 + 4/9·3 + 4/3) Γ² + Γ² + Φ² = 35/3 Γ² + Φ²,
//!
//! where Φ is the largest |f_l| of layer j. Without a sign change only the sum with w is left: F_j² = Φ². If all x were
//! equal, the factor would be 3 (4/9 + 4/9 + 1) + 1 + 1 = 23/3.
//!
//! # Martingale
//! The result of an operation is rounded by η with the mean 0, given all roundings before it, and η lies between two bounds
//! whose distance is at most 2u|x|: −u|x| and u|x| for rounding to nearest, and the distances to two neighbouring floats for
//! stochastic rounding. So the partial sums of Σ c η are a martingale. By Hoeffding's lemma, which needs the distance of the
//! two bounds only, E exp(t c η) ≤ exp(t² c² u² x²/2), and
//!
//! P(|e| ≥ λ u √(Σ F_j²)) ≤ 2 exp(−λ²/2).
//!
//! The inequality of Azuma with |η| < 2u|x| would give twice the bound for stochastic rounding.
//!
//! # Fixed bounds of the intermediate results
//! F_j must not depend on the roundings, but Γ and Φ are bounds of computed forces. They are the exact maxima, plus √3 E_(j−1),
//! where E_(j−1) is a bound of all errors of the layer above. It fails with a probability of at most half of the
//! requested one, for all layers together: layer j with m contacts has the share 1/((j+1)(j+2)), so that
//! λ = √(2 ln(4 m (j+1)(j+2)/P)). A martingale that stops as soon as E_j is exceeded has increments within F_j, and differs from
//! the true one with this probability. The other half of P is left for the bound itself.

use cannonpile::lattice::Dimension;
use cannonpile::scalar::{Algebra, Ring};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use num_rational::BigRational;

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
    /// The largest contact force below the layer.
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
/// |e| ≤ λ u √(Σ F_j²), where u = 2^−`bits` and F_j² = 35/3 Γ² + Φ² for each layer with a sign change, else Φ². Γ bounds the norm of
/// the three forces on a sphere, and Φ the forces below it. With the probability P, λ = √(2 ln(4/P)) for one contact, and
/// λ = √(2 ln(4m/P)) for all m contacts below a layer. The bound grows like √L times the forces;
/// [`Layer::error_bound`](cannonpile::Layer::error_bound) grows like L.
///
/// It is a theorem for stochastic rounding, in which each rounding has its own random number. For rounding to nearest it is a model: it
/// assumes that each error has the mean 0, given those before it. In a symmetric pile equal spheres round alike. Their errors
/// can then be larger by √g, where g ≤ 6 is the number of symmetries.
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
/// // In u times the largest force: the worst case is 170 times as large or more.
/// let units = last.of_all() / last.greatest / 2.0_f64.powi(-24);
/// assert!(units < 140.0, "{units}");
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn probable_bounds(
    pile: &Pile,
    bits: u32,
    probability: f64,
) -> Result<Vec<ProbableBound>, Error> {
    let shape = pile.shape();
    let lines: u32 = match pile.dimension() {
        Dimension::Two => 2,
        Dimension::Three => 3,
    };
    // The increments of an ordinary sphere, by `formula::load_increments`.
    let [x, y] = pile
        .tilt()
        .each_ref()
        .map(|part| f64::from_rational(part).abs());
    let own = 2.0 + 2.0 * x + 4.0 * y;
    let has_extras = pile.loads().len() > 0
        || pile.weights().next().is_some()
        || pile.horizontal_forces().len() > 0;
    let is_bound = (4..=1000).contains(&bits) && probability > 0.0 && probability < 1.0;
    let u = (-f64::from(bits)).exp2();
    let rho = 2.0 * u;
    let grown = (1.0 + rho).powi(4);
    let lambda = |contacts: f64| {
        if is_bound {
            (2.0 * (4.0 * contacts / probability).ln()).sqrt()
        } else {
            f64::INFINITY
        }
    };
    let mut layers = pile.forces::<f64>().layers(Selection::All)?;
    let mut bounds = Vec::new();
    // The largest forces from above by line, the bound of their errors, and Σ F_j².
    let (mut received, mut margin, mut sum) = ([0.0; 3], 0.0, 0.0);
    let mut slices = [(); 3].map(|()| Vec::new());
    while let Some(layer) = layers.next_layer()? {
        if layer.is_floor() {
            break;
        }
        let k = layer.k();
        for slice in &mut slices {
            slice.resize(layer.sphere_count(), 0.0);
        }
        layer.fill(slices.each_mut().map(|slice| &mut slice[..]))?;
        let off = match layer.error_bound() {
            Some(bound) => f64::from_rational(&bound),
            None => f64::INFINITY,
        };
        let largest = |line: &Vec<f64>| line.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let below = slices.each_ref().map(|line| largest(line) + off);
        let greatest = below.into_iter().fold(0.0, f64::max);
        let on_sphere = received.iter().map(|x| x * x).sum::<f64>().sqrt() + margin;
        let turns = k > 0 && shape.sign_below(k - 1) != shape.sign_below(k);
        let mut most = greatest + margin;
        if turns {
            sum += 35.0 / 3.0 * (grown * grown * on_sphere * on_sphere);
            most += 13.0 / 3.0 * rho * grown * on_sphere;
        }
        sum += most * most;
        if has_extras {
            let partial = most.max(on_sphere) + own;
            sum += partial * partial;
        }
        let spheres = f64::from_rational(&BigRational::from_integer(layer.sphere_count().into()));
        let contacts = spheres * f64::from(lines);
        let depth = f64::from_integer(k);
        // A few hundred roundings of f64.
        let scale = if is_bound {
            u * sum.sqrt() * (1.0 + 1e-12)
        } else {
            f64::INFINITY
        };
        margin = 3.0_f64.sqrt() * lambda(contacts * (depth + 1.0) * (depth + 2.0)) * scale;
        received = below;
        bounds.push(ProbableBound {
            layer: k,
            scale,
            lambda_of_one: lambda(1.0),
            lambda_of_all: lambda(contacts),
            greatest,
        });
    }
    Ok(bounds)
}
