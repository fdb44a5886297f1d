//! The stress of each sphere, compared with the contacts in SI units, with the virial theorem and with symmetries.

use std::collections::BTreeMap;

use cannonpile::lattice::{Axis, Dimension, HorizontalContact, Region, Site};
use cannonpile::scalar::{FixedRational, Interval, Surd};
use cannonpile::shape::Selection;
use cannonpile::{Load, Method, Packing, Pile};
use cannonpile_testkit::real::Bounded;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use cannonpile_testkit::oracles::balance::ratio;

fn at(k: i128, i: i128, j: i128) -> Site {
    Site { i, j, k }
}

/// Piles with their spacing. Together they cover tilts, loads, weights, angles, discs, sign changes and horizontal contacts.
fn scenes() -> Vec<(Pile, &'static str)> {
    let under = |top: &str, stacking: &str| {
        Pile::under(top.parse().unwrap(), stacking.parse().unwrap()).unwrap()
    };
    let push = |down, x, y| Load {
        down: ratio(down, 3),
        x: ratio(x, 7),
        y: ratio(y, 5),
    };
    let horizontal = |pile: Pile, axis, site, force| {
        let contact = HorizontalContact { site, axis };
        pile.with_horizontal_force(contact, ratio(force, 6))
            .unwrap()
    };
    let pushed = horizontal(under("hexagon:2", "+-+"), Axis::AlphaBeta, at(1, 0, 0), 5);
    let pushed = horizontal(pushed, Axis::AlphaGamma, at(1, 0, 0), 1);
    let pushed = horizontal(pushed, Axis::GammaBeta, at(2, 0, 1), 2);
    let discs = horizontal(Pile::discs(4).unwrap(), Axis::AlphaBeta, at(2, 0, 0), 1);
    let tilt = [ratio(1, 9), ratio(-2, 7)];
    vec![
        (Pile::triangular(1).unwrap(), "6/5"),
        (Pile::triangular(5).unwrap(), "6/5"),
        (
            Pile::triangular(4)
                .unwrap()
                .with_tilt(tilt.clone())
                .unwrap(),
            "5/4",
        ),
        (Pile::isosceles(5, ratio(2, 5)).unwrap(), "6/5"),
        (
            Pile::isosceles(4, ratio(3, 5))
                .unwrap()
                .with_tilt(tilt.clone())
                .unwrap()
                .with_load(at(1, 0, 1), push(4, -3, 2))
                .unwrap(),
            "6/5",
        ),
        (Pile::discs(5).unwrap(), "6/5"),
        (
            Pile::discs(4)
                .unwrap()
                .with_load(at(1, 1, 0), push(2, 5, 0))
                .unwrap(),
            "sqrt(2)",
        ),
        (discs, "1"),
        (under("hexagon:3", "+-+"), "6/5"),
        (
            under("triangle:2", "+-+-")
                .with_tilt(tilt)
                .unwrap()
                .with_weight(at(2, 0, 0), ratio(7, 2))
                .unwrap()
                .with_load(at(2, 1, 0), push(1, 1, -1))
                .unwrap(),
            "6/5",
        ),
        (
            under("triangle:3", "++-")
                .weightless()
                .with_load(at(0, 0, 0), push(9, 1, 1))
                .unwrap(),
            "1",
        ),
        (pushed, "1"),
        (
            Pile::on(Region::hexagon(4, 4).unwrap(), "-+".parse().unwrap()).unwrap(),
            "4/3",
        ),
    ]
}

fn packing<'p>(pile: &'p Pile, spacing: &str) -> Packing<'p> {
    let packing = Packing::new(pile, &spacing.parse().unwrap()).unwrap();
    let packing = packing.with_radius(ratio(3, 200)).unwrap();
    let packing = packing.with_mass(ratio(1, 30)).unwrap();
    packing.with_gravity(ratio(981, 100)).unwrap()
}

type Tensor = [f64; 6];

fn floats(stress: [Surd; 6]) -> Tensor {
    stress.map(|part| part.to_f64())
}

/// The symmetric part of a dyad in the order of the library.
fn dyad(u: [f64; 3], v: [f64; 3]) -> Tensor {
    [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]]
        .map(|[a, b]| f64::midpoint(u[a] * v[b], u[b] * v[a]))
}

fn add(sum: &mut Tensor, more: Tensor) {
    sum.iter_mut()
        .zip(more)
        .for_each(|(sum, more)| *sum += more);
}

#[track_caller]
fn assert_close(one: Tensor, other: Tensor, what: &dyn std::fmt::Debug) {
    let greatest = one
        .iter()
        .chain(&other)
        .fold(1e-3, |most: f64, x| most.max(x.abs()));
    for (x, y) in one.iter().zip(other) {
        assert!(
            (x - y).abs() < 1e-13 * greatest,
            "{one:?} {other:?} {what:?}"
        );
    }
}

fn stresses(packing: &Packing<'_>) -> Vec<(Site, [Surd; 6])> {
    let sites = packing.pile().sites(Selection::All).unwrap();
    let stresses = packing.forces().stresses(Selection::All).unwrap();
    assert_eq!(stresses.size_hint().1, Some(sites.clone().count()));
    let in_si = stresses.map(|stress| packing.stress_in_si(&stress.unwrap()));
    sites.zip(in_si).collect()
}

/// R Σ f ê⊗ê from force vectors and contact points, in floats. The trace is R Σ f.
#[test]
fn a_stress_is_the_sum_over_the_contacts_in_si_units() {
    for (pile, spacing) in scenes() {
        let packing = packing(&pile, spacing);
        let sloping = packing
            .contacts(Selection::All)
            .unwrap()
            .map(Result::unwrap);
        let horizontal = pile
            .horizontal_forces()
            .map(|(contact, force)| packing.horizontal_contact_in_si(contact, force).unwrap());
        let mut sums: BTreeMap<Site, (Tensor, f64)> = BTreeMap::new();
        let centres: BTreeMap<_, _> = pile
            .sites(Selection::All)
            .unwrap()
            .map(|site| (site, packing.position(site).unwrap().map(|x| x.to_f64())))
            .collect();
        for contact in sloping.chain(horizontal) {
            let (point, force) = (
                contact.point.map(|x| x.to_f64()),
                contact.vector.map(|x| x.to_f64()),
            );
            let centre = centres[&contact.site];
            let arm = [0, 1, 2].map(|n| centre[n] - point[n]);
            let opposite = [0, 1, 2].map(|n| point[n] - arm[n]);
            let far = |at: &[f64; 3]| (0..3).map(|n| (at[n] - opposite[n]).abs()).sum::<f64>();
            let (other, _) = centres
                .iter()
                .min_by(|a, b| far(a.1).total_cmp(&far(b.1)))
                .unwrap();
            for site in [contact.site, *other] {
                let (sum, trace) = sums.entry(site).or_default();
                add(sum, dyad(force, arm));
                *trace += contact.force.to_f64() * packing.radius().to_f64().unwrap();
            }
        }
        for (site, stress) in stresses(&packing) {
            assert_eq!(stress, packing.stress(site).unwrap());
            let stress = floats(stress);
            let (sum, trace) = sums.get(&site).copied().unwrap_or_default();
            assert_close(stress, sum, &(&pile, site));
            let of_stress: f64 = stress[..3].iter().sum();
            assert!((of_stress - trace).abs() <= 1e-13 * trace.abs(), "{site}");
        }
    }
}

/// The sum of all stresses is −Σ x⊗F over the external forces: weights, loads and the forces of the floor.
#[test]
fn the_stresses_of_all_spheres_satisfy_the_virial_theorem() {
    for (pile, spacing) in scenes() {
        let packing = packing(&pile, spacing);
        let (mut sum, mut virial) = (Tensor::default(), Tensor::default());
        for (_, stress) in stresses(&packing) {
            add(&mut sum, floats(stress));
        }
        let float = |x: &BigRational| x.to_f64().unwrap();
        let (mg, tan) = (
            float(&packing.sphere_weight()),
            packing.inclination().tan().to_f64(),
        );
        let s = float(pile.sin_phi());
        let across = 2.0 * (1.0 - s * s).sqrt() * tan;
        for site in pile.sites(Selection::All).unwrap() {
            let centre = packing.position(site).unwrap().map(|x| x.to_f64());
            let (weight, load) = (pile.sphere_weight(site).unwrap(), pile.load(site).unwrap());
            let [x, y] = pile.tilt().each_ref().map(|tilt| &weight * tilt);
            let horizontal = [(x + load.x, tan), (y + load.y, across)];
            let [x, y] = horizontal.map(|(part, unit)| float(&part) * unit * mg);
            let force = [x, y, -float(&(weight + load.down)) * mg];
            add(&mut virial, dyad(centre, force));
            if site.k + 1 == pile.layers() {
                let floor = packing.on_floor(site).unwrap();
                let shear = [floor.shear_x, floor.shear_y].map(|x| -x.to_f64());
                add(
                    &mut virial,
                    dyad(centre, [shear[0], shear[1], floor.normal.to_f64()]),
                );
            }
        }
        assert_close(sum, virial.map(|part| -part), &pile);
    }
}

#[test]
fn scalars_methods_and_parts_agree() {
    for (pile, _) in scenes() {
        let exact: Vec<[BigRational; 6]> = pile
            .forces()
            .stresses(Selection::All)
            .unwrap()
            .map(Result::unwrap)
            .collect();
        let sites = || pile.sites(Selection::All).unwrap();
        for (site, exact) in sites().zip(&exact) {
            assert_eq!(&pile.forces::<BigRational>().stress(site).unwrap(), exact);
            let fixed = pile.forces::<FixedRational<i128>>().stress(site).unwrap();
            for (fixed, exact) in fixed.into_iter().zip(exact) {
                let (n, d) = fixed.parts().unwrap();
                assert_eq!(&BigRational::new(n.into(), d.into()), exact);
            }
        }
        let floats = pile
            .forces::<f64>()
            .stresses(Selection::All)
            .unwrap()
            .map(Result::unwrap);
        for (float, exact) in floats.zip(&exact) {
            let exact = exact.clone().map(|part| part.to_f64().unwrap());
            assert_close(float, exact, &pile);
        }
        let intervals = pile.forces::<Interval>().stresses(Selection::All).unwrap();
        for (interval, exact) in intervals.zip(&exact) {
            for (interval, exact) in interval.unwrap().into_iter().zip(exact) {
                assert!(interval.enclosure().unwrap().contains(exact));
            }
        }
        for method in [Method::Closed, Method::Tree, Method::Sweep] {
            let Ok(by) = pile.forces::<BigRational>().with_method(method) else {
                continue;
            };
            let all = by.stresses(Selection::All).unwrap().map(Result::unwrap);
            assert!(all.eq(exact.iter().cloned()), "{pile:?} {method:?}");
            for (site, exact) in sites().zip(&exact) {
                assert_eq!(
                    &by.stress(site).unwrap(),
                    exact,
                    "{pile:?} {method:?} {site}"
                );
            }
        }
        let layers = (0..pile.layers()).flat_map(|k| {
            let layer = pile
                .forces::<BigRational>()
                .stresses(Selection::Layer(k))
                .unwrap();
            layer.map(Result::unwrap).collect::<Vec<_>>()
        });
        assert!(layers.eq(exact.iter().cloned()), "{pile:?}");
    }
}

/// The mirror y → −y swaps α and β. A straight pile under one sphere has it, and xy and yz change their signs.
#[test]
fn mirrored_spheres_have_mirrored_stresses() {
    for pile in [
        Pile::triangular(6).unwrap(),
        Pile::isosceles(6, ratio(1, 3)).unwrap(),
    ] {
        let forces = pile.forces::<BigRational>();
        for site in pile.sites(Selection::All).unwrap() {
            let mirrored = Site {
                i: site.k - site.i - site.j,
                ..site
            };
            let [xx, yy, zz, xy, xz, yz] = forces.stress(site).unwrap();
            assert_eq!(
                forces.stress(mirrored).unwrap(),
                [xx, yy, zz, -xy, xz, -yz],
                "{site}"
            );
        }
    }
}

/// On the axis of threefold symmetry, the stress is isotropic in the plane.
#[test]
fn the_stress_on_a_threefold_axis_is_isotropic_in_the_plane() {
    let pile = Pile::under(Region::SITE, "+-+-".parse().unwrap()).unwrap();
    for k in [0, 2, 4] {
        let [xx, yy, zz, xy, xz, yz] = pile.forces::<BigRational>().stress(at(k, 0, 0)).unwrap();
        assert!(zz > BigRational::zero() && xx == yy, "{k}");
        assert!([xy, xz, yz].iter().all(Zero::is_zero), "{k}");
    }
}

/// zz in mgR·cosθ sums to twice the weight above each gap between two layers.
#[test]
fn the_vertical_stresses_sum_to_twice_the_transmitted_weight() {
    for (pile, _) in scenes() {
        let upright = pile.tilt().iter().all(Zero::is_zero) && pile.loads().len() == 0;
        if !upright || pile.weights().count() > 0 {
            continue;
        }
        let stresses = pile
            .forces::<BigRational>()
            .stresses(Selection::All)
            .unwrap();
        let sum: BigRational = stresses.map(|stress| stress.unwrap()[2].clone()).sum();
        let weight = pile.sites(Selection::All).unwrap().map(|site| {
            let gaps_below = BigRational::from_integer((pile.layers() - 1 - site.k).into());
            gaps_below * (BigRational::one() + BigRational::one())
        });
        assert_eq!(sum, weight.sum(), "{pile:?}");
    }
}

#[test]
fn discs_have_no_stress_along_y() {
    let pile = Pile::discs(4).unwrap();
    assert_eq!(pile.dimension(), Dimension::Two);
    for stress in pile
        .forces::<BigRational>()
        .stresses(Selection::All)
        .unwrap()
    {
        let [_, yy, _, xy, _, yz] = stress.unwrap();
        assert!([yy, xy, yz].iter().all(Zero::is_zero));
    }
}

#[test]
fn a_value_beyond_the_scalar_is_refused() {
    let pile = Pile::triangular(10_i128.pow(30)).unwrap();
    let site = at(10_i128.pow(29), 5, 7);
    assert!(pile.forces::<FixedRational<i64>>().stress(site).is_err());
    assert!(pile.forces::<BigRational>().stress(site).is_ok());
    assert!(pile.forces::<f64>().stress(at(0, 1, 0)).is_err());
}
