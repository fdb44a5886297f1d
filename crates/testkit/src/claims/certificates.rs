//! An accepted certificate states the truth, even after random changes. Both checkers agree on it.
//!
//! The claims change certificates of a tiny pile in a few places. If
//! [`check`](cannonpile_horizontal::certificate::Certificate::check) still accepts one, the exact linear programs of
//! `States` must confirm it. The second checker, in Python, runs in [`python_checker`](crate::python_checker).

use arbitrary::Unstructured;
use cannonpile::Pile;
use cannonpile::lattice::{Axis, HorizontalContact, Site};
use cannonpile_horizontal::certificate::{Certificate, Claim, Extreme};
use num_rational::BigRational;
use num_traits::Zero;

use super::horizontal::{Drawn, contact, drawn, negative};
use super::{Checked, Failure, demand};
use crate::generators::number::ratio;
use crate::generators::rarely;
use crate::generators::region::light;
use crate::oracles::admissible::at;
use crate::oracles::balance::place;

/// An accepted certificate is true.
pub fn changed(u: &mut Unstructured<'_>) -> Checked {
    let mut drawn = drawn(u)?;
    let certificate = any(u, &mut drawn)?;
    let accepted = certificate.check().is_ok();
    demand(!accepted || is_true(&drawn, &certificate), || {
        format!("accepted but false: {certificate:?}")
    })
}

/// Both checkers accept the certificate, or both reject it. The certificate also survives a round trip through its file.
pub fn checkers_agree(u: &mut Unstructured<'_>) -> Checked {
    use cannonpile_horizontal::certificate::{read_certificate, write_certificate};

    use super::same;
    use crate::python_checker;

    let mut drawn = drawn(u)?;
    let certificate = any(u, &mut drawn)?;
    let refuted = |error: std::io::Error| Failure::Refuted(format!("{error}: {certificate:?}"));
    let mut file = Vec::new();
    write_certificate(&certificate, &mut file).map_err(refuted)?;
    let read = read_certificate(file.as_slice()).map_err(refuted)?;
    same("the value read back", &read, &certificate)?;
    let Some(status) = python_checker::status(&file) else {
        return Ok(());
    };
    let checked = certificate.check();
    // Status 2 means that the file is not a certificate.
    let agree = status == u8::from(checked.is_err());
    demand(agree, || {
        format!("{checked:?}, but {status} in Python: {certificate:?}")
    })
}

/// A file with some replaced letters is rejected, or its certificate survives a round trip and is true if accepted.
pub fn damaged(u: &mut Unstructured<'_>) -> Checked {
    use cannonpile_horizontal::certificate::{
        read_certificate, read_certificates, write_certificate,
    };

    use super::same;

    let mut drawn = drawn(u)?;
    let certificate = any(u, &mut drawn)?;
    let refuted = |error: std::io::Error| Failure::Refuted(error.to_string());
    let mut file = Vec::new();
    write_certificate(&certificate, &mut file).map_err(refuted)?;
    for _ in 0..u.int_in_range(1..=3)? {
        let place = u.choose_index(file.len())?;
        match (u.int_in_range(0..=5)?, file.get_mut(place)) {
            (0, _) => file.truncate(place),
            (1, _) => drop(file.drain(place..=place)),
            (_, Some(byte)) => *byte = *u.choose(b"0129-+/.,:\"{}[]ahtf\n\xff")?,
            (_, None) => {}
        }
    }
    let several = read_certificates(&*file);
    let Ok(read) = read_certificate(&*file) else {
        return Ok(());
    };
    same("the only one", &several.ok(), &Some(vec![read.clone()]))?;
    let mut again = Vec::new();
    write_certificate(&read, &mut again).map_err(refuted)?;
    same(
        "the value read back",
        &read_certificate(&*again).ok(),
        &Some(read.clone()),
    )?;
    // The oracle `drawn` does not apply to a certificate whose pile has changed.
    let holds = read.check().is_err() || read.pile != drawn.pile || is_true(&drawn, &read);
    demand(holds, || format!("accepted but false: {read:?}"))
}

/// Returns one of the certificates of the pile with a few changes. Sometimes the pile changes too.
fn any(u: &mut Unstructured<'_>, drawn: &mut Drawn) -> Result<Certificate, Failure> {
    let mut certificate = given(u, drawn)?;
    for _ in 0..u.int_in_range(0..=3)? {
        change(u, drawn, &mut certificate)?;
    }
    if rarely(u, 4)? {
        *drawn = another(u, drawn)?;
        certificate.pile = drawn.pile.clone();
    }
    Ok(certificate)
}

/// Returns the same pile with one more load, or an unrelated pile.
fn another(u: &mut Unstructured<'_>, drawn: &Drawn) -> Result<Drawn, Failure> {
    if rarely(u, 3)? {
        return super::horizontal::drawn(u);
    }
    let sites: Vec<_> = drawn.pile.shape().sites().collect();
    let (site, load) = (*u.choose(&sites)?, light(u)?);
    Ok(drawn.loaded(site, load)?)
}

/// Returns a certificate that the library gives for the pile.
fn given(u: &mut Unstructured<'_>, drawn: &Drawn) -> Result<Certificate, Failure> {
    let Drawn { pile, bottom, .. } = drawn;
    let bounds = || cannonpile_horizontal::bounds(pile, *bottom).ok();
    let given = match u.int_in_range(0..=3)? {
        0 => None,
        1 => {
            let elastic = cannonpile_horizontal::elastic(pile, &drawn.stiffness_ratio).ok();
            elastic.and_then(|state| state.certificate().cloned())
        }
        2 => bounds().and_then(|bounds| bounds.least.certificate),
        _ => bounds().and_then(|bounds| bounds.greatest.certificate),
    };
    Ok(match given {
        Some(certificate) => certificate,
        // An unstable pile has only this certificate.
        None => cannonpile_horizontal::equilibrium(pile)?,
    })
}

/// Changes a number, the claim or the site (which may lie outside the pile), or doubles the proof.
fn change(
    u: &mut Unstructured<'_>,
    drawn: &Drawn,
    certificate: &mut Certificate,
) -> Result<(), Failure> {
    let more = ratio(
        u.int_in_range(-3..=3)?,
        *u.choose(&[1, 2, 3, 7, 1_000_000])?,
    );
    let Certificate {
        pile,
        claim,
        horizontal,
        field,
    } = certificate;
    match u.int_in_range(0..=6)? {
        0 => {
            let directions = pile.dimension().directions();
            let direction = *u.choose(directions)?;
            field.entry(sphere(u, pile)?).or_default()[direction.index()] += more;
        }
        4 => {
            // The pile has no such contacts outside it or on the floor.
            let axis = *u.choose(&[Axis::AlphaBeta, Axis::AlphaGamma, Axis::GammaBeta])?;
            let site = sphere(u, pile)?;
            *horizontal
                .entry(HorizontalContact { site, axis })
                .or_default() += more;
        }
        5 => {
            if let Claim::Least(extreme) | Claim::Greatest(extreme) = claim {
                extreme.site = sphere(u, pile)?;
            }
        }
        1 => {
            if let Ok(pair) = u.choose(&drawn.states.contacts) {
                *horizontal.entry(contact(*pair)).or_default() += more;
            }
        }
        2 => match claim {
            Claim::Least(Extreme {
                normal, attained, ..
            })
            | Claim::Greatest(Extreme {
                normal, attained, ..
            }) => {
                if more.is_zero() {
                    *attained ^= true;
                }
                *normal += more;
            }
            Claim::Elastic { stiffness_ratio } => *stiffness_ratio += more,
            other => *other = Claim::Stands,
        },
        3 => {
            let extreme = Extreme {
                site: drawn.bottom,
                normal: more,
                attained: u.arbitrary()?,
            };
            *claim = match claim.clone() {
                Claim::Least(extreme) => Claim::Greatest(extreme),
                Claim::Greatest(_) => Claim::Stands,
                Claim::Stands => Claim::Least(extreme),
                _ => Claim::CannotStand,
            };
        }
        _ => {
            for number in field.values_mut().flatten() {
                *number *= ratio(2, 1);
            }
        }
    }
    Ok(())
}

/// A site of the pile, or one up to a step outside it.
fn sphere(u: &mut Unstructured<'_>, pile: &Pile) -> arbitrary::Result<Site> {
    let sites: Vec<_> = pile.shape().sites().collect();
    let mut site = *u.choose(&sites)?;
    if rarely(u, 3)? {
        for place in [&mut site.i, &mut site.j, &mut site.k] {
            *place += u.int_in_range(-1..=1)?;
        }
    }
    Ok(site)
}

/// Tells whether a claim holds, by exact linear programs over all compressive states.
fn is_true(drawn: &Drawn, certificate: &Certificate) -> bool {
    let Drawn { states, corner, .. } = drawn;
    match &certificate.claim {
        Claim::Stands => corner.is_some(),
        Claim::CannotStand => corner.is_none(),
        Claim::Least(extreme) => is_bound(drawn, extreme, false),
        Claim::Greatest(extreme) => is_bound(drawn, extreme, true),
        Claim::Elastic { stiffness_ratio } => {
            let x = states.contacts.iter().map(|pair| {
                let force = certificate.horizontal.get(&contact(*pair));
                force.cloned().unwrap_or_default()
            });
            let x: Vec<_> = x.collect();
            let of_contacts = x.iter().filter(|force| !force.is_zero()).count();
            let given = certificate.horizontal.values();
            // A horizontal force between spheres that do not touch belongs to no state of the pile.
            let has_others = given.filter(|force| !force.is_zero()).count() > of_contacts;
            !has_others && has_least_energy(drawn, stiffness_ratio, &x)
        }
        _ => false,
    }
}

/// Tells whether no compressive state has less energy. The energy is convex, so this holds exactly if the energy does
/// not decrease towards any of them. The derivative towards a state is linear, so a linear program decides this.
fn has_least_energy(drawn: &Drawn, stiffness_ratio: &BigRational, x: &[BigRational]) -> bool {
    let Drawn { states, corner, .. } = drawn;
    let Some(corner) = corner.clone().filter(|_| states.is_compressive(x)) else {
        return false;
    };
    let slope = states.slope(x, stiffness_ratio);
    at(&slope, &corner.lowest(&slope).x()) == at(&slope, x)
}

/// Tells whether every state respects the bound. If the bound is claimed as attained, some state must attain it.
fn is_bound(drawn: &Drawn, extreme: &Extreme, above: bool) -> bool {
    let Some(normal) = drawn.states.normals.get(&place(extreme.site)) else {
        return false;
    };
    let Some(corner) = &drawn.corner else {
        return !extreme.attained;
    };
    let aim = if above {
        negative(normal)
    } else {
        normal.clone()
    };
    let exact = at(normal, &corner.clone().lowest(&aim).x());
    let within = if above {
        exact <= extreme.normal
    } else {
        exact >= extreme.normal
    };
    within && (!extreme.attained || exact == extreme.normal)
}

#[cfg(test)]
mod injected_faults {
    use super::super::horizontal::horizontal;
    use super::*;

    /// Bounds of a random pile, some bounds that are slightly too tight, and one for a site above the bottom layer.
    #[test]
    fn bounds_that_are_too_tight_are_caught() {
        let trace = ratio(1, 1_000_000);
        let mut caught = 0;
        for seed in 0..40_u8 {
            let bytes: Vec<u8> = (0..64)
                .map(|n: u8| n.wrapping_mul(37).wrapping_add(seed))
                .collect();
            let drawn = drawn(&mut Unstructured::new(&bytes)).unwrap();
            let Ok(bounds) = cannonpile_horizontal::bounds(&drawn.pile, drawn.bottom) else {
                continue;
            };
            for (bound, above) in [(bounds.least, false), (bounds.greatest, true)] {
                assert!(bound.attained);
                let extreme = |normal, attained| Extreme {
                    site: drawn.bottom,
                    normal,
                    attained,
                };
                let better = if above { -trace.clone() } else { trace.clone() };
                assert!(is_bound(
                    &drawn,
                    &extreme(bound.normal.clone(), true),
                    above
                ));
                assert!(is_bound(
                    &drawn,
                    &extreme(&bound.normal - &better, false),
                    above
                ));
                assert!(!is_bound(
                    &drawn,
                    &extreme(&bound.normal - &better, true),
                    above
                ));
                assert!(!is_bound(
                    &drawn,
                    &extreme(&bound.normal + &better, false),
                    above
                ));
                caught += 1;
            }
        }
        assert!(caught > 20, "{caught}");
    }

    #[test]
    fn the_opposite_verdict_is_caught() {
        let bytes = [0; 64];
        let drawn = drawn(&mut Unstructured::new(&bytes)).unwrap();
        let mut certificate = cannonpile_horizontal::equilibrium(&drawn.pile).unwrap();
        assert!(is_true(&drawn, &certificate));
        certificate.claim = match certificate.claim {
            Claim::Stands => Claim::CannotStand,
            _ => Claim::Stands,
        };
        assert!(!is_true(&drawn, &certificate));
    }

    /// The elastic states of some piles, and states next to them.
    #[test]
    fn forces_of_higher_energy_are_caught() {
        let mut caught = 0;
        for seed in 0..40_u8 {
            let bytes: Vec<u8> = (0..64)
                .map(|n: u8| n.wrapping_mul(91).wrapping_add(seed))
                .collect();
            let drawn = drawn(&mut Unstructured::new(&bytes)).unwrap();
            let Ok(elastic) = cannonpile_horizontal::elastic(&drawn.pile, &drawn.stiffness_ratio)
            else {
                continue;
            };
            let least = horizontal(elastic.pile(), &drawn.states);
            let holds = |x: &[_]| has_least_energy(&drawn, &drawn.stiffness_ratio, x);
            assert!(holds(&least));
            for n in 0..least.len() {
                let mut other = least.clone();
                other[n] += ratio(1, 1_000_000);
                assert!(!holds(&other));
                caught += 1;
            }
        }
        assert!(caught > 20, "{caught}");
    }
}
