//! Measured forces are compared as they should be: what is exact is accepted, and every planted fault is found.

#![expect(clippy::float_cmp, reason = "errors are exact where they are compared")]

mod files;
mod findings;
mod lammps;
mod places;
mod refinement;
mod tables;
mod vtk;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Packing, Pile};
use cannonpile_dem::Error;
use cannonpile_dem::verify::{Comparison, Fault, Measured, Refusal};
use num_rational::BigRational;

fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

fn packing(pile: &Pile, spacing: BigRational) -> Packing<'_> {
    Packing::new(pile, &Spacing::new(spacing).unwrap()).unwrap()
}

fn id(pile: &Pile, site: Site) -> u64 {
    u64::try_from(pile.shape().before(site).unwrap()).unwrap() + 1
}

fn site(pile: &Pile, measured: &Measured) -> Site {
    let [first, _] = measured.ids;
    pile.numbering().unwrap().site(first).unwrap()
}

/// What a perfect simulation would measure: each force alone, the nearest float, told of the upper sphere.
fn perfect(packing: &Packing<'_>) -> Vec<Measured> {
    let pile = packing.pile();
    let contacts = packing.contacts(Selection::All).unwrap();
    let measured = contacts.map(|contact| {
        let contact = contact.unwrap();
        let below = pile
            .shape()
            .below(contact.site, contact.direction.direction().unwrap())
            .unwrap();
        let ids = [id(pile, contact.site), id(pile, below)];
        let vector = contact.vector.map(|x| x.nearest::<f64>().unwrap());
        Measured::new(ids, contact.force.nearest::<f64>().unwrap()).with_vector(vector)
    });
    measured.collect()
}

fn magnitudes(measured: &[Measured]) -> Vec<Measured> {
    let alone = |measured: &Measured| Measured::new(measured.ids, measured.force);
    measured.iter().map(alone).collect()
}

fn compare(packing: &Packing<'_>, measured: &[Measured]) -> Comparison {
    Comparison::new(packing, measured.iter().copied()).unwrap()
}

fn piles() -> Vec<Pile> {
    let apex = Pile::triangular(5).unwrap().weightless();
    vec![
        Pile::triangular(1).unwrap(),
        Pile::triangular(5).unwrap(),
        Pile::discs(6).unwrap(),
        Pile::isosceles(4, ratio(2, 5)).unwrap(),
        Pile::under(Region::SITE, Stacking::hcp(6).unwrap()).unwrap(),
        Pile::on(Region::hexagon(4, 3).unwrap(), "+-".parse().unwrap()).unwrap(),
        // Three lines carry, all other contacts are exactly 0.
        apex.with_load(Site::APEX, ratio(1, 1)).unwrap(),
    ]
}

#[test]
fn the_exact_forces_are_accepted_with_an_error_of_zero() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let perfect = perfect(&packing);
        for measured in [&perfect, &magnitudes(&perfect)] {
            let comparison = compare(&packing, measured);
            let contacts = u64::try_from(pile.contact_count()).unwrap();
            assert_eq!(comparison.contacts(), contacts);
            assert_eq!(comparison.matched(), contacts);
            assert!(comparison.accepted(0.0), "{comparison}");
            assert_eq!(comparison.largest_error().to_bits(), 0);
            assert_eq!(comparison.rms_error().to_bits(), 0);
            assert_eq!(comparison.worst().is_some(), contacts > 0);
        }
    }
}

#[test]
fn the_order_does_not_matter_nor_which_sphere_comes_first() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let mut measured = perfect(&packing);
        for (place, one) in measured.iter_mut().enumerate() {
            one.force *= 1.0 + 1e-7 * f64::from(u8::try_from(place % 7).unwrap());
        }
        let straight = compare(&packing, &measured);
        let mut shuffled: Vec<Measured> = measured.iter().rev().map(|one| one.reversed()).collect();
        let middle = shuffled.len() / 3;
        shuffled.rotate_left(middle);
        assert_eq!(compare(&packing, &shuffled), straight);
    }
}

/// The last bit of any force alone.
#[test]
fn a_wrong_force_is_found_wherever_it_is() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let perfect = perfect(&packing);
        for place in 0..perfect.len() {
            let mut measured = perfect.clone();
            let exact = measured[place].force;
            measured[place].force = exact.next_up();
            for measured in [&measured, &magnitudes(&measured)] {
                let comparison = compare(&packing, measured);
                assert!(!comparison.accepted(0.0));
                let worst = comparison.worst().unwrap();
                assert_eq!(worst.ids, perfect[place].ids);
                let unit = if exact == 0.0 {
                    comparison.largest_force()
                } else {
                    exact.abs()
                };
                let error = (exact.next_up() - exact) / unit;
                // One over a force of 0 is the least float there is.
                assert_eq!(comparison.largest_error(), error.max(f64::from_bits(1)));
                assert!(comparison.accepted(1e-15));
            }
        }
    }
}

#[test]
fn a_missing_contact_is_found_wherever_it_is() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let perfect = perfect(&packing);
        for place in 0..perfect.len() {
            let mut left_out = perfect.clone();
            let gone = left_out.remove(place);
            let mut nothing = perfect.clone();
            nothing[place] = Measured::new(gone.ids, 0.0).with_vector([0.0, -0.0, 0.0]);
            for measured in [left_out, nothing] {
                let comparison = compare(&packing, &measured);
                let carries = gone.force != 0.0;
                assert_eq!(comparison.missing(), u64::from(carries));
                assert_eq!(comparison.accepted(0.9), !carries);
                let first = comparison.missing_contacts().first();
                assert_eq!(first.map(|first| first.ids), carries.then_some(gone.ids));
            }
        }
    }
}

#[test]
fn a_turned_force_is_found_though_its_magnitude_is_right() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let (sin, cos) = 1e-3_f64.sin_cos();
    for place in 0..30 {
        let mut measured = perfect(&packing);
        let Measured { force, vector, .. } = measured[place];
        let [x, y, z] = vector.unwrap();
        measured[place].vector = Some([cos * x - sin * y, sin * x + cos * y, z]);
        let comparison = compare(&packing, &measured);
        assert!(!comparison.accepted(1e-4));
        // A chord of the circle that the horizontal part goes round.
        let chord = 2.0 * (0.5e-3_f64).sin() * x.hypot(y) / force;
        assert!((comparison.largest_error() - chord).abs() < 1e-15);
        assert!(compare(&packing, &magnitudes(&measured)).accepted(0.0));
        let words = comparison.worst().unwrap().to_string();
        assert!(words.contains("N on the upper one, exact ("), "{words}");
    }
}

#[test]
fn a_vector_of_the_other_sphere_is_twice_too_much() {
    let pile = Pile::triangular(2).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut measured = perfect(&packing);
    let [upper, lower] = measured[1].ids;
    measured[1].ids = [lower, upper];
    let comparison = compare(&packing, &measured);
    assert!((comparison.largest_error() - 2.0).abs() < 1e-15);
    measured[1] = measured[1].reversed();
    assert!(!compare(&packing, &measured).accepted(1.0));
}

#[test]
fn a_magnitude_that_is_not_that_of_its_vector_is_found() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut measured = perfect(&packing);
    measured[4].force *= 1.5;
    let error = compare(&packing, &measured).largest_error();
    assert!((error - 0.5).abs() < 1e-15, "{error}");
    // As in a simulation with friction: the vector has more than the normal force.
    let mut measured = perfect(&packing);
    measured[4].vector = measured[4].vector.map(|[x, y, z]| [x, y, z + 0.1]);
    assert!(!compare(&packing, &measured).accepted(1e-2));
}

#[test]
fn pull_is_a_difference_and_no_refusal() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut measured = magnitudes(&perfect(&packing));
    measured[0].force *= -1.0;
    let comparison = compare(&packing, &measured);
    assert_eq!(comparison.largest_error(), 2.0);
    let words = comparison.worst().unwrap().to_string();
    assert!(words.contains("measured -0.46225016352102427 N, exact 0.46225016352102427 N"));
}

#[test]
fn spheres_numbered_otherwise_are_found() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let perfect = perfect(&packing);
    for first in 1..=20 {
        for second in first + 1..=20 {
            let swap = |id| match id {
                id if id == first => second,
                id if id == second => first,
                id => id,
            };
            let swapped = perfect.iter().map(|one| Measured {
                ids: one.ids.map(swap),
                ..*one
            });
            let comparison = Comparison::new(&packing, swapped).unwrap();
            assert!(!comparison.accepted(0.1), "{first} and {second}");
        }
    }
}

#[test]
fn an_extra_contact_is_noise_up_to_the_accepted_part_of_the_largest_force() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let perfect = perfect(&packing);
    let largest = perfect
        .iter()
        .fold(0.0, |most: f64, one| most.max(one.force));
    // Neighbours in a layer, two layers apart, and one on the floor with one that is not over it.
    for ids in [[2, 3], [1, 8], [3, 12], [12, 3]] {
        let with = |force| {
            let mut measured = perfect.clone();
            measured.push(Measured::new(ids, force));
            compare(&packing, &measured)
        };
        let comparison = with(0.25 * largest);
        assert_eq!((comparison.extra(0.25), comparison.noise(0.25)), (0, 1));
        assert!(comparison.accepted(0.25));
        let over = 0.25_f64.next_down();
        assert_eq!((comparison.extra(over), comparison.noise(over)), (1, 0));
        assert!(!comparison.accepted(over));
        let extra = &comparison.extra_pairs()[0];
        assert_eq!(
            (extra.ids[0].min(extra.ids[1]), extra.error),
            (ids[0].min(ids[1]), 0.25)
        );
        // Pull too, and the least there is.
        assert!(!with(-0.25 * largest).accepted(over));
        assert!(!with(f64::from_bits(1)).accepted(0.0));
        // A pair that was listed and does not touch.
        let comparison = with(-0.0);
        assert!(comparison.accepted(0.0));
        assert_eq!((comparison.extra(0.0), comparison.noise(0.0)), (0, 0));
        // A vector counts though the magnitude says nothing.
        let mut measured = perfect.clone();
        measured.push(Measured::new(ids, 0.0).with_vector([0.0, 0.1, 0.0]));
        assert!(!compare(&packing, &measured).accepted(1e-3));
    }
}

#[test]
fn extra_pairs_are_named_from_the_greatest_down() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut measured = perfect(&packing);
    for (ids, force) in [([2, 3], 0.1), ([4, 3], 0.2), ([2, 4], 0.2), ([10, 1], -0.3)] {
        measured.push(Measured::new(ids, force));
    }
    let comparison = compare(&packing, &measured);
    let ids: Vec<[u64; 2]> = comparison
        .extra_pairs()
        .iter()
        .map(|extra| extra.ids)
        .collect();
    assert_eq!(ids, [[1, 10], [2, 4], [3, 4], [2, 3]]);
}

#[test]
fn horizontal_neighbours_that_touch_are_extra() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(1, 1));
    assert!(!packing.touching().is_empty());
    let mut measured = perfect(&packing);
    measured.push(Measured::new([2, 3], 1e-9));
    let comparison = compare(&packing, &measured);
    assert!(comparison.accepted(1e-6));
    assert_eq!(comparison.noise(1e-6), 1);
    measured.push(Measured::new([4, 3], 0.2));
    let comparison = compare(&packing, &measured);
    assert_eq!((comparison.extra(1e-6), comparison.noise(1e-6)), (1, 1));
    assert_eq!(
        comparison.extra_pairs()[0].to_string(),
        "spheres 3 (k=1, i=1, j=0) and 4 (k=1, i=0, j=1) have no contact: measured 0.2 N"
    );
}

#[test]
fn a_contact_without_force_is_measured_against_the_largest() {
    let pile = Pile::triangular(4).unwrap().weightless();
    let pile = pile.with_load(Site::APEX, ratio(7, 1)).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let carrying: Vec<Measured> = perfect(&packing)
        .into_iter()
        .filter(|one| one.force != 0.0)
        .collect();
    // Three lines of three.
    assert_eq!(carrying.len(), 9);
    let comparison = compare(&packing, &carrying);
    assert_eq!((comparison.matched(), comparison.missing()), (9, 0));
    assert!(comparison.accepted(0.0));
    let idle = perfect(&packing).into_iter().find(|one| one.force == 0.0);
    let mut measured = carrying.clone();
    let idle = idle.unwrap().ids;
    measured.push(Measured::new(idle, 0.5 * comparison.largest_force()));
    let comparison = compare(&packing, &measured);
    assert_eq!((comparison.matched(), comparison.extra(0.0)), (10, 0));
    assert_eq!(comparison.largest_error(), 0.5);
    assert_eq!(comparison.worst().unwrap().ids, idle);
    assert!((comparison.rms_error() - 0.025_f64.sqrt()).abs() < 1e-15);
}

/// Over the largest force it is less than any float, and not 0 all the same.
#[test]
fn the_faintest_force_where_none_should_be_is_an_error() {
    let pile = Pile::triangular(3).unwrap();
    let mass = cannonpile_dem::scene::parse::rational("1e200").unwrap();
    let packing = packing(&pile, ratio(6, 5)).with_mass(mass).unwrap();
    let mut measured = perfect(&packing);
    measured.push(Measured::new([2, 3], 1e-200));
    let comparison = compare(&packing, &measured);
    assert!(!comparison.accepted(0.0));
    assert!(comparison.accepted(1e-300));
}

/// Nothing carries: any force is infinitely wrong.
#[test]
fn a_pile_without_any_force_accepts_none() {
    let pile = Pile::triangular(3).unwrap().weightless();
    let packing = packing(&pile, ratio(6, 5));
    assert!(compare(&packing, &[]).accepted(0.0));
    for ids in [[1, 2], [2, 3]] {
        let comparison = compare(&packing, &[Measured::new(ids, 1e-300)]);
        assert!(!comparison.accepted(f64::MAX), "{comparison}");
    }
}

#[test]
fn pairs_of_fixed_spheres_are_counted_and_not_judged() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(1, 1));
    let mut measured = perfect(&packing);
    measured.push(Measured::new([5, 6], 100.0));
    measured.push(Measured::new([10, 6], 0.0));
    let comparison = compare(&packing, &measured);
    assert_eq!(comparison.fixed(), 2);
    assert!(comparison.accepted(0.0));
    // One layer is all fixed.
    let pile = Pile::under(Region::triangle(3).unwrap(), Stacking::fcc(1).unwrap()).unwrap();
    let packing = self::packing(&pile, ratio(1, 1));
    let comparison = compare(&packing, &[Measured::new([1, 2], 3.0)]);
    assert_eq!((comparison.fixed(), comparison.contacts()), (1, 0));
    assert!(comparison.accepted(0.0));
}

#[test]
fn the_rms_is_that_of_the_errors() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut measured = magnitudes(&perfect(&packing));
    let errors: Vec<f64> = (0..30).map(|n: u8| f64::from(n) * 1e-5).collect();
    for (one, error) in measured.iter_mut().zip(&errors) {
        one.force *= 1.0 + error;
    }
    let want = (errors.iter().map(|e| e * e).sum::<f64>() / 30.0).sqrt();
    let got = compare(&packing, &measured).rms_error();
    assert!((got - want).abs() < 1e-12 * want.max(1e-3), "{got} {want}");
}

/// Squares of these would leave the floats.
#[test]
fn forces_near_the_ends_of_the_floats_are_compared() {
    let pile = Pile::triangular(3).unwrap();
    for mass in ["1e305", "1e-305"] {
        let mass = cannonpile_dem::scene::parse::rational(mass).unwrap();
        let packing = packing(&pile, ratio(6, 5)).with_mass(mass).unwrap();
        let mut measured = perfect(&packing);
        assert!(compare(&packing, &measured).accepted(0.0));
        for one in &mut measured {
            one.force *= 1.25;
            one.vector = one.vector.map(|vector| vector.map(|x| x * 1.25));
        }
        let comparison = compare(&packing, &measured);
        assert!((comparison.largest_error() - 0.25).abs() < 1e-15);
        assert!((comparison.rms_error() - 0.25).abs() < 1e-15);
    }
    for mass in ["1e308", "1e309", "1e-320", "1e-400"] {
        let mass = cannonpile_dem::scene::parse::rational(mass).unwrap();
        let packing = packing(&Pile::triangular(9).unwrap(), ratio(6, 5))
            .with_mass(mass)
            .map(|packing| Comparison::new(&packing, []).unwrap_err().to_string());
        assert_eq!(
            packing.unwrap(),
            "a contact force of this scene does not fit in f64: measure mass or gravity in another unit"
        );
    }
}

#[test]
fn entries_that_cannot_be_are_refused() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let one = Measured::new([1, 2], 0.5);
    let refused = |second: Measured| match Comparison::new(&packing, [one, second]) {
        Err(Refusal::Entry { entry: 2, fault }) => fault,
        other => panic!("{other:?}"),
    };
    for twice in [one, one.reversed(), Measured::new([2, 1], 0.0)] {
        let ids = [1, 2];
        assert_eq!(
            refused(twice),
            Fault::Twice {
                ids,
                first: Some(1)
            }
        );
    }
    for ids in [[0, 1], [1, 11], [u64::MAX, 1]] {
        assert!(matches!(
            refused(Measured::new(ids, 1.0)),
            Fault::NoSuchSphere { spheres: 10, id } if ids.contains(&id)
        ));
    }
    assert_eq!(
        refused(Measured::new([3, 3], 1.0)),
        Fault::OneSphere { id: 3 }
    );
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (column, place) in [("fx", 0), ("fy", 1), ("fz", 2)] {
            let mut vector = [0.0; 3];
            vector[place] = wrong;
            let fault = refused(Measured::new([1, 3], 1.0).with_vector(vector));
            assert!(matches!(fault, Fault::NotFinite { column: named, .. } if named == column));
        }
        let fault = refused(Measured::new([1, 3], wrong));
        assert!(matches!(
            fault,
            Fault::NotFinite {
                column: "force",
                ..
            }
        ));
    }
    // Fixed spheres are no excuse.
    let fixed = Measured::new([5, 6], 1.0);
    assert!(Comparison::new(&packing, [fixed, fixed.reversed()]).is_err());
}

#[test]
fn a_pile_too_large_to_compare_is_refused_before_anything_is_done() {
    for layers in [1000, 10_i128.pow(30)] {
        let pile = Pile::triangular(layers).unwrap();
        let packing = packing(&pile, ratio(6, 5));
        let endless = std::iter::repeat(Measured::new([1, 2], 1.0));
        let refused = Comparison::new(&packing, endless).unwrap_err();
        assert!(matches!(
            refused,
            Refusal::Scene(Error::Core(cannonpile::Error::TooLarge { .. }))
        ));
    }
}

#[test]
fn horizontal_contacts_are_compared_too() {
    let bare = Pile::under(Region::SITE, "+-+-+".parse().unwrap()).unwrap();
    let elastic = cannonpile_horizontal::elastic(&bare, &ratio(1, 1)).unwrap();
    let pile = elastic.pile();
    let packing = packing(pile, ratio(1, 1));
    let horizontal = pile.horizontal_forces().map(|(contact, force)| {
        let packed = packing.horizontal_contact_in_si(contact, force).unwrap();
        let neighbour = pile.shape().neighbour(contact).unwrap();
        let vector = packed.vector.map(|x| x.nearest::<f64>().unwrap());
        let ids = [id(pile, contact.site), id(pile, neighbour)];
        Measured::new(ids, packed.force.nearest::<f64>().unwrap()).with_vector(vector)
    });
    let horizontal: Vec<Measured> = horizontal.collect();
    let all: Vec<Measured> = perfect(&packing)
        .into_iter()
        .chain(horizontal.clone())
        .collect();
    let comparison = compare(&packing, &all);
    assert_eq!(comparison.matched(), 129);
    assert!(comparison.accepted(0.0), "{comparison}");
    // Those of a layer with the one below are missing, and its horizontal ones are there.
    for lost in horizontal.iter().map(|one| site(pile, one).k) {
        let mut some = all.clone();
        some.retain(|one| {
            let [_, _, z] = one.vector.unwrap();
            z == 0.0 || site(pile, one).k != lost
        });
        let findings = compare(&packing, &some).findings(1e-6);
        let [finding] = &findings[..] else {
            panic!("{lost}: {findings:?}");
        };
        let said = format!(
            "contacts of layer {lost} with layer {} are missing",
            lost + 1
        );
        assert!(finding.to_string().contains(&said), "{finding}");
    }
    // Told by the other sphere.
    let reversed: Vec<Measured> = all.iter().map(|measured| measured.reversed()).collect();
    assert!(compare(&packing, &reversed).accepted(0.0));
    // One left out, one too strong, one that pushes the wrong way, and one that is open.
    let missing = compare(&packing, &all[..128]);
    assert_eq!(missing.missing(), 1);
    assert!(missing.to_string().contains("gamma-beta"), "{missing}");
    let mut wrong = all.clone();
    wrong[127].force *= 1.5;
    assert!(!compare(&packing, &wrong).accepted(0.1));
    let mut wrong = all.clone();
    wrong[128].vector = wrong[128].vector.map(|vector| vector.map(|x| -x));
    assert!(!compare(&packing, &wrong).accepted(0.1));
    let open = Measured::new([2, 3], 0.1).with_vector([0.0, 0.1, 0.0]);
    let with_open: Vec<Measured> = all.iter().copied().chain([open]).collect();
    assert_eq!(compare(&packing, &with_open).extra(0.01), 1);
    // The isostatic forces of the pile are others.
    let isostatic = Packing::new(&bare, &Spacing::new(ratio(1, 1)).unwrap()).unwrap();
    assert!(!compare(&isostatic, &all).accepted(0.1));
}
