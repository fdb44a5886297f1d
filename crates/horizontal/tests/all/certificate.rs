//! Certificates: made by hand for each claim, changed in one number, and before a second checker.
//!
//! | file | what is checked |
//! |---|---|
//! | `claims` | certificates that anybody can derive are accepted, and what they say is what the library says elsewhere |
//! | `changed` | with another number they are refused, in the equation that has it |
//! | `size` | what would not fit into memory is refused |
//! | `python` | `check_certificate.py` comes to the same verdicts |

mod changed;
mod claims;
mod python;
mod size;

use cannonpile::Pile;
use cannonpile::lattice::{Axis, HorizontalContact, Region, Site};
use cannonpile_horizontal::certificate::{Certificate, Claim, Extreme, read_certificate};
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

/// Without forces of horizontal contacts, and without a field.
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

/// One sphere on three, which rest on the three directions of −; `load` is on the uppermost.
fn twin(load: BigRational) -> Pile {
    let pile = Pile::under(Region::SITE, "+-".parse().unwrap());
    pile.and_then(|pile| pile.with_load(Site::APEX, load))
        .unwrap()
}

/// The straight pile stands.
fn straight(layers: i128) -> Certificate {
    bare(Pile::triangular(layers).unwrap(), Claim::Stands)
}

/// The three spheres of [`twin`] under the uppermost are pushed apart, and horizontal contacts push them further. With
/// φ_l = 1/3 on top and −1 on the sphere that l leads to, Σ w φ = w − 3, w the weight and load on top.
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

/// A load of `load` on the middle of seven spheres, over a change of sign: each of the three below it would pull on its
/// outer support by (load + 1)/3 − 7/3, but its two outer neighbours push it back by `push` each.
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

/// No sphere bears less than its weight.
fn own_weight(site: Site) -> Certificate {
    let pile = Pile::triangular(site.k + 1).unwrap();
    bare(pile, Claim::Least(extreme(site, ratio(1, 1), false)))
}

/// The sphere in a corner of the straight pile bears at most L − 2/3, K = L − 1: the field is 1 on the edge that leads
/// there, on the uppermost along the edge only, and Σ w φ = 1 + 3(K − 1). Neighbours push all weight of the edge into it.
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

/// In straight piles of springs horizontal contacts bear nothing: the forces are n_l + 1, n_l spheres above on the line,
/// and φ_l = d n_l + d(d + 1)/2 at height d over the floor; then c = −2d.
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

/// All of these, of several sizes: each holds.
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
    // Of two layers there is nothing to choose: least is greatest.
    let mut only = corner(2);
    only.claim = Claim::Least(extreme(at(0, 0, 1), ratio(4, 3), true));
    all.push(only);
    all.extend(pressed());
    all
}

/// Springs whose horizontal contacts bear something: discs under two loads, and a hexagon under one with a change of sign.
///
/// Found by another program; what makes them right is what is checked.
fn pressed() -> [Certificate; 2] {
    let texts = [
        include_str!("certificate/discs.json"),
        include_str!("certificate/hexagon.json"),
    ];
    texts.map(|text| read_certificate(text.as_bytes()).unwrap())
}
