//! The errors of computed contact forces, exactly: the residual of every sphere, and the distance from the exact forces.
//!
//! Computed forces f̂ solve the equations (I − S) f̂ = w + δ exactly, with the residuals δ. So they are the exact forces of a
//! pile with slightly other loads, and δ is the backward error. The forward error obeys e = S e + δ from layer to layer.

use std::collections::HashMap;

use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;
use cannonpile::{Error, Forces, Pile, formula};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

/// The errors of the computed contact forces below a layer, from [`layer_errors`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LayerErrors {
    /// The layer, counted from the top.
    pub layer: i128,
    /// The backward error: the largest residual of a sphere, relative to the largest force on this sphere.
    pub backward: f64,
    /// The forward error: the largest error of a contact force, relative to the largest of these forces.
    pub forward: f64,
    /// The proved bound of the forward error, from [`Layer::error_bound`](cannonpile::Layer::error_bound).
    pub worst_case: Option<f64>,
}

/// Returns the residuals f − G g − w of all spheres of layer `k`, in f₀ and by direction: what the balance of a sphere lacks,
/// resolved along its contacts below. They are zero for the exact forces.
///
/// `above` and `below` are the contact forces below the spheres of layers `k` − 1 and `k`, as
/// [`Layer::fill`](cannonpile::Layer::fill) writes them. `above` is not read for the top layer.
///
/// # Errors
/// [`Error::Length`] for slices of other lengths, [`Error::OnFloor`] for the bottom layer, and [`Error::SiteOutside`] for other
/// layers.
///
/// # Examples
/// ```
/// use cannonpile::{Pile, ratio};
/// use cannonpile_accuracy::residuals;
///
/// // The apex of three layers: its weight is 3 f₀ along its three contacts. The second of them bears too much.
/// let [one, more] = [[ratio!(1)], [ratio!(9/8)]];
/// let pile = Pile::triangular(3)?;
/// let found = residuals(&pile, 0, [&[]; 3], [&one, &more, &one])?;
/// assert_eq!(found, [[ratio!(0), ratio!(1/8), ratio!(0)]]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn residuals<T: Algebra>(
    pile: &Pile,
    k: i128,
    above: [&[T]; 3],
    below: [&[T]; 3],
) -> Result<Vec<[T; 3]>, Error> {
    let balances = balances(pile, k, above, below)?;
    Ok(balances
        .into_iter()
        .map(|balance| balance.residual)
        .collect())
}

/// The balance of a sphere.
struct Balance<T> {
    residual: [T; 3],
    received: [T; 3],
}

fn balances<T: Algebra>(
    pile: &Pile,
    k: i128,
    above: [&[T]; 3],
    below: [&[T]; 3],
) -> Result<Vec<Balance<T>>, Error> {
    let shape = pile.shape();
    let sites: Vec<Site> = pile.sites(Selection::Layer(k))?.collect();
    let places: HashMap<Site, usize> = sites.iter().copied().zip(0..).collect();
    let mut received = vec![[(); 3].map(|()| T::zero()); sites.len()];
    let check = |needed: usize, slices: [&[T]; 3]| match slices
        .into_iter()
        .map(<[T]>::len)
        .find(|given| *given != needed)
    {
        Some(given) => Err(Error::Length { needed, given }),
        None => Ok(()),
    };
    check(sites.len(), below)?;
    let Some(sign) = shape.sign_below(k) else {
        // Every layer has a sphere.
        return Err(Error::OnFloor { site: sites[0] });
    };
    if k > 0 {
        let upper: Vec<Site> = pile.sites(Selection::Layer(k - 1))?.collect();
        check(upper.len(), above)?;
        for (n, site) in upper.into_iter().enumerate() {
            for direction in Direction::ALL {
                let lower = shape.below(site, direction);
                if let Some(place) = lower.and_then(|lower| places.get(&lower)) {
                    let line = direction.index();
                    received[*place][line] = above[line][n].clone();
                }
            }
        }
    }
    let turns = k > 0 && shape.sign_below(k - 1) != Some(sign);
    let own = increments(pile, k)?;
    let mut balances = Vec::with_capacity(sites.len());
    for (n, (own, received)) in own.iter().zip(received).enumerate() {
        let carried = if turns {
            T::half_turn(&received)
        } else {
            received.clone()
        };
        let own = own.each_ref().map(T::from_rational);
        let residual = [0, 1, 2].map(|line| below[line][n].clone() - &carried[line] - &own[line]);
        balances.push(Balance { residual, received });
    }
    Ok(balances)
}

/// Returns what the spheres of a layer add to their lines, in f₀.
pub(crate) fn increments(pile: &Pile, k: i128) -> Result<Vec<[BigRational; 3]>, Error> {
    let sites: Vec<Site> = pile.sites(Selection::Layer(k))?.collect();
    let places: HashMap<&Site, usize> = sites.iter().zip(0..).collect();
    let own = sites.iter().map(|site| pile.own_increments(*site));
    let mut own: Vec<_> = own.collect();
    let Some(sign) = pile.shape().sign_below(k) else {
        return Ok(own);
    };
    for (contact, force) in pile.horizontal_forces() {
        if contact.site.k == k {
            let ends = [
                (contact.site, true),
                (pile.shape().neighbour(contact)?, false),
            ];
            for (site, leads_away) in ends {
                let pushes = formula::pushed(force, contact.axis.ends(), leads_away);
                for (own, push) in own[places[&site]].iter_mut().zip(&pushes) {
                    *own = formula::beside(BigRational::zero(), own, push, sign);
                }
            }
        }
    }
    Ok(own)
}

/// Computes all contact forces and returns their errors, layer by layer.
///
/// `exactly` returns the value of a number, such as `|x| BigRational::from_float(*x)`. The residuals are exact, and so are the
/// forces with which the others are compared; only the results are rounded. Loads and tilts of the forces themselves,
/// beyond those of the pile, count as errors. Divide by u = 2^−p for errors in units of it.
///
/// # Errors
/// [`Error::Overflow`] if `exactly` returns `None`; otherwise as for [`Layer::fill`](cannonpile::Layer::fill).
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use cannonpile::num_rational::BigRational;
/// use cannonpile::stacking::Stacking;
/// use cannonpile_accuracy::layer_errors;
///
/// let pile = Pile::under(Region::hexagon(2, 2)?, Stacking::hcp(12)?)?;
/// let errors = layer_errors(&pile.forces::<f64>(), |x| BigRational::from_float(*x))?;
/// let u = 2.0_f64.powi(-53);
/// let last = errors.last().unwrap();
/// // Backward stable: a few u, whatever the number of layers.
/// assert!(errors.iter().all(|layer| layer.backward < 4.0 * u));
/// // The forward error grows like √L, and the bound about like L².
/// assert!(last.forward < 10.0 * u && last.worst_case.unwrap() > 100.0 * last.forward);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn layer_errors<T: Algebra>(
    forces: &Forces<'_, T>,
    exactly: impl Fn(&T) -> Option<BigRational>,
) -> Result<Vec<LayerErrors>, Error> {
    let pile = forces.pile();
    let exact = pile.forces::<BigRational>();
    let (mut layers, mut exact) = (
        forces.layers(Selection::All)?,
        exact.layers(Selection::All)?,
    );
    let mut above: [Vec<BigRational>; 3] = Default::default();
    let mut errors = Vec::new();
    while let (Some(layer), Some(exact)) = (layers.next_layer()?, exact.next_layer()?) {
        if layer.is_floor() {
            break;
        }
        let spheres = layer.sphere_count();
        let mut computed = [(); 3].map(|()| vec![T::zero(); spheres]);
        let mut wanted = [(); 3].map(|()| vec![BigRational::zero(); spheres]);
        layer.fill(computed.each_mut().map(|slice| &mut slice[..]))?;
        exact.fill(wanted.each_mut().map(|slice| &mut slice[..]))?;
        let mut below: [Vec<BigRational>; 3] = Default::default();
        for (into, line) in below.iter_mut().zip(&computed) {
            for x in line {
                into.push(exactly(x).ok_or(Error::Overflow {
                    quantity: "a contact force",
                    scalar: T::NAME,
                })?);
            }
        }
        let k = layer.k();
        let [upper, lower] = [&above, &below].map(|forces| forces.each_ref().map(|line| &line[..]));
        let balances = balances(pile, k, upper, lower)?;
        let mut backward = 0.0_f64;
        for (n, Balance { residual, received }) in balances.iter().enumerate() {
            let own = below.iter().map(|line| &line[n]);
            let on_sphere = largest(own.chain(received));
            backward = backward.max(relative(&largest(residual.iter()), &on_sphere));
        }
        let greatest = largest(wanted.iter().flatten());
        let pairs = below.iter().flatten().zip(wanted.iter().flatten());
        let differences: Vec<_> = pairs.map(|(got, want)| got - want).collect();
        errors.push(LayerErrors {
            layer: k,
            backward,
            forward: relative(&largest(differences.iter()), &greatest),
            worst_case: layer.error_bound().map(|bound| relative(&bound, &greatest)),
        });
        above = below;
    }
    Ok(errors)
}

/// Returns the largest magnitude.
fn largest<'r>(values: impl Iterator<Item = &'r BigRational>) -> BigRational {
    let mut most = BigRational::zero();
    for value in values {
        let magnitude = value.abs();
        if (&magnitude - &most).is_positive() {
            most = magnitude;
        }
    }
    most
}

/// Returns error/scale, 0 without an error, and infinity for an error of nothing.
fn relative(error: &BigRational, scale: &BigRational) -> f64 {
    if error.is_zero() {
        0.0
    } else if scale.is_zero() {
        f64::INFINITY
    } else {
        f64::from_rational(&(error / scale))
    }
}
