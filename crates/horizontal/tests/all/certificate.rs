//! Certificates: made by hand for each claim, with single numbers changed, and compared with a second checker.
//!
//! | file | contents |
//! |---|---|
//! | `claims` | certificates with short proofs are accepted and agree with other results of the library |
//! | `changed` | certificates with one changed number are refused, by the condition that contains it |
//! | `size` | checks that need too much memory are refused |
//! | `python` | `check_certificate.py` gives the same verdicts |

mod changed;
mod claims;
mod forces;
mod python;
mod size;

use cannonpile::Pile;
use cannonpile::lattice::{Axis, HorizontalContact, Region, Site};
use cannonpile_horizontal::certificate::{
    Certificate, Claim, Condition, Extreme, Refusal, read_certificate,
};
use num_rational::BigRational;

use cannonpile_testkit::answers::ratio;

fn at(i: i128, j: i128, k: i128) -> Site {
    Site { i, j, k }
}

fn along(axis: Axis, site: Site) -> HorizontalContact {
    HorizontalContact { site, axis }
}

fn whole(numbers: [i128; 3]) -> [BigRational; 3] {
    numbers.map(|n| BigRational::from_integer(n.into()))
}

/// Returns the condition that a certificate violates, with the text of the refusal.
fn violated(certificate: &Certificate) -> (Condition, String) {
    match certificate.check().unwrap_err() {
        Refusal::Violated(condition, text) => (condition, text),
        Refusal::Pile(error) => panic!("{error}"),
    }
}

/// Returns a certificate without horizontal forces and without a field.
fn bare(pile: Pile, claim: Claim) -> Certificate {
    Certificate {
        pile,
        claim,
        horizontal: [].into(),
        field: [].into(),
    }
}

fn extreme(site: Site, normal: BigRational, attained: bool) -> Extreme {
    Extreme {
        site,
        normal,
        attained,
    }
}

/// Returns one sphere on three, followed by a − step; `load` is on the top sphere.
fn twin(load: BigRational) -> Pile {
    let pile = Pile::under(Region::SITE, "+-".parse().unwrap());
    pile.and_then(|pile| pile.with_load(Site::APEX, load))
        .unwrap()
}

/// Returns a certificate that the straight pile is stable.
fn straight(layers: i128) -> Certificate {
    bare(Pile::triangular(layers).unwrap(), Claim::Stands)
}

/// Returns a Farkas certificate for [`twin`].
///
/// The load pushes the three middle spheres apart, and horizontal forces can only increase this. With φ_l = 1/3 on
/// the top sphere and −1 on the sphere below it in direction l, Σ w φ = w − 3, where w is the weight and load of
/// the top sphere.
fn apart(load: i64) -> Certificate {
    let mut certificate = bare(twin(ratio(load, 1)), Claim::CannotStand);
    certificate.field = [
        (Site::APEX, [ratio(1, 3), ratio(1, 3), ratio(1, 3)]),
        (at(0, 0, 1), whole([-1, 0, 0])),
        (at(1, 0, 1), whole([0, -1, 0])),
        (at(0, 1, 1), whole([0, 0, -1])),
    ]
    .into();
    certificate
}

/// Returns seven spheres above a sign change, with `load` on the central one.
///
/// Without horizontal forces each of three middle spheres would have the tensile force (load + 1)/3 − 7/3 on its
/// outer contact. Its two outer neighbours press it inwards with `push` each.
fn held_together(load: i64, push: (i64, i64)) -> Certificate {
    let pile = Pile::under(Region::hexagon(2, 2).unwrap(), "+-".parse().unwrap());
    let pile = pile.and_then(|pile| pile.with_load(Site::APEX, ratio(load, 1)));
    let mut certificate = bare(pile.unwrap(), Claim::Stands);
    let contacts = [
        along(Axis::AlphaBeta, at(-1, 0, 1)),
        along(Axis::AlphaGamma, at(0, -1, 1)),
        along(Axis::AlphaBeta, at(1, 0, 1)),
        along(Axis::GammaBeta, at(1, 0, 1)),
        along(Axis::AlphaGamma, at(0, 1, 1)),
        along(Axis::GammaBeta, at(-1, 2, 1)),
    ];
    certificate.horizontal = contacts
        .map(|contact| (contact, ratio(push.0, push.1)))
        .into();
    certificate
}

/// Returns a certificate that no sphere carries less than its weight.
fn own_weight(site: Site) -> Certificate {
    let pile = Pile::triangular(site.k + 1).unwrap();
    bare(pile, Claim::Least(extreme(site, ratio(1, 1), false)))
}

/// Returns a certificate that a corner of the straight pile carries at most L − 2/3.
///
/// The field is 1 on the edge that leads to the corner; on the top sphere it is 1 along the edge only. With
/// K = L − 1, Σ w φ = 1 + 3(K − 1). Horizontal forces lead the full weight of the edge and its neighbours to the
/// corner.
fn corner(layers: i128) -> Certificate {
    let bottom = layers - 1;
    let normal = BigRational::from_integer(layers.into()) - ratio(2, 3);
    let claim = Claim::Greatest(extreme(at(0, 0, bottom), normal, true));
    let mut certificate = bare(Pile::triangular(layers).unwrap(), claim);
    certificate.field.insert(Site::APEX, whole([1, 0, 0]));
    for k in 1..bottom {
        certificate.field.insert(at(0, 0, k), whole([1, 1, 1]));
        for axis in [Axis::AlphaBeta, Axis::AlphaGamma] {
            let contact = along(axis, at(0, 0, k));
            certificate.horizontal.insert(contact, ratio(1, 1));
        }
    }
    certificate
}

/// Returns a certificate of the elastic state of a straight pile. Its horizontal contacts carry no force.
///
/// The forces are n_l + 1, with n_l spheres above on the line, and φ_l = d n_l + d(d + 1)/2 at height d above the
/// floor. Then c = −2d.
fn springs(pile: Pile, stiffness_ratio: BigRational) -> Certificate {
    let mut certificate = bare(pile, Claim::Elastic { stiffness_ratio });
    let pile = &certificate.pile;
    for site in pile.shape().sites() {
        let Site { i, j, k } = site;
        let d = pile.layers() - 1 - k;
        if d > 0 {
            let field = whole([k - i - j, i, j].map(|n| d * n + d * (d + 1) / 2));
            certificate.field.insert(site, field);
        }
    }
    certificate
}

/// Returns certificates of all these kinds in several sizes. All are valid.
fn all() -> Vec<Certificate> {
    let mut all = vec![
        apart(3),
        apart(1000),
        held_together(8, (1, 2)),
        held_together(6, (0, 1)),
        bare(Pile::discs(5).unwrap(), Claim::Stands),
        springs(Pile::discs(5).unwrap(), ratio(2, 7)),
        own_weight(at(1, 1, 3)),
        own_weight(at(0, 2, 4)),
    ];
    all.extend((1..=5).map(straight));
    all.extend((2..=6).map(corner));
    all.extend((1..=5).map(|layers| springs(Pile::triangular(layers).unwrap(), ratio(1, 2))));
    // For two layers the forces are unique, so the lower bound equals the upper bound.
    let mut only = corner(2);
    only.claim = Claim::Least(extreme(at(0, 0, 1), ratio(4, 3), true));
    all.push(only);
    all.extend(pressed());
    all
}

/// Returns elastic states with horizontal forces: discs under two loads, and a hexagon under a load with a sign
/// change.
///
/// Another program computed them, and only the check shows that they are valid.
fn pressed() -> [Certificate; 2] {
    let texts = [
        include_str!("certificate/discs.json"),
        include_str!("certificate/hexagon.json"),
    ];
    texts.map(|text| read_certificate(text.as_bytes()).unwrap())
}
