//! Measured forces are compared with exact ones: exact forces are accepted, and every planted fault is reported.

#![expect(clippy::float_cmp, reason = "errors are exact where they are compared")]

mod contacts;
mod files;
mod findings;
mod friction;
mod lammps;
mod places;
mod refinement;
mod runs;
mod tables;
mod vtk;
mod written;

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

/// Returns the forces that a perfect simulation would measure: each force correctly rounded, on the upper sphere.
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
        // Three lines of contacts carry the load. All other forces are exactly 0.
        apex.with_load(Site::APEX, ratio(1, 1)).unwrap(),
    ]
}

#[test]
fn exact_forces_are_accepted_with_zero_error() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let perfect = perfect(&packing);
        for measured in [&perfect, &magnitudes(&perfect)] {
            let comparison = compare(&packing, measured);
            let contacts = u64::try_from(pile.contact_count()).unwrap();
            assert_eq!(comparison.contacts(), contacts);
            assert_eq!(comparison.matched(), contacts);
            assert!(comparison.accepted(0.0), "{comparison}");
            let want = (contacts > 0).then_some(0);
            let errors = [comparison.largest_error(), comparison.rms_error()];
            assert_eq!(errors.map(|error| error.map(f64::to_bits)), [want; 2]);
            assert_eq!(comparison.worst().is_some(), contacts > 0);
        }
    }
}

#[test]
fn the_order_of_entries_and_of_spheres_is_irrelevant() {
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

/// Changes the last bit of each force in turn.
#[test]
fn any_single_wrong_force_is_reported() {
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
                // Relative to a force of 0, the error is the smallest positive float.
                assert_eq!(
                    comparison.largest_error().unwrap(),
                    error.max(f64::from_bits(1))
                );
                assert!(comparison.accepted(1e-15));
            }
        }
    }
}

#[test]
fn any_single_missing_contact_is_reported() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let perfect = perfect(&packing);
        for place in 0..perfect.len() {
            let mut left_out = perfect.clone();
            let gone = left_out.remove(place);
            let comparison = compare(&packing, &left_out);
            let carries = gone.force != 0.0;
            assert_eq!(comparison.missing(), u64::from(carries));
            assert_eq!(comparison.accepted(1.0), !carries);
            let first = comparison.missing_contacts().first();
            assert_eq!(first.map(|first| first.ids), carries.then_some(gone.ids));
        }
    }
}

#[test]
fn a_rotated_force_of_correct_magnitude_is_reported() {
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
        // The change of the vector is a chord of the circle that its horizontal part describes.
        let chord = 2.0 * (0.5e-3_f64).sin() * x.hypot(y) / force;
        assert!((comparison.largest_error().unwrap() - chord).abs() < 1e-15);
        assert!(compare(&packing, &magnitudes(&measured)).accepted(0.0));
        let words = comparison.worst().unwrap().to_string();
        assert!(words.contains("N on the upper one, exact ("), "{words}");
    }
}

#[test]
fn a_vector_on_the_wrong_sphere_has_an_error_of_two() {
    let pile = Pile::triangular(2).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut measured = perfect(&packing);
    let [upper, lower] = measured[1].ids;
    measured[1].ids = [lower, upper];
    let comparison = compare(&packing, &measured);
    assert!((comparison.largest_error().unwrap() - 2.0).abs() < 1e-15);
    measured[1] = measured[1].reversed();
    assert!(!compare(&packing, &measured).accepted(1.0));
}

#[test]
fn a_magnitude_that_disagrees_with_its_vector_is_reported() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut measured = perfect(&packing);
    measured[4].force *= 1.5;
    let error = compare(&packing, &measured).largest_error().unwrap();
    assert!((error - 0.5).abs() < 1e-15, "{error}");
    // With friction, a vector is longer than the normal force.
    let mut measured = perfect(&packing);
    measured[4].vector = measured[4].vector.map(|[x, y, z]| [x, y, z + 0.1]);
    assert!(!compare(&packing, &measured).accepted(1e-2));
}

#[test]
fn tensile_forces_are_compared_not_rejected() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut measured = magnitudes(&perfect(&packing));
    measured[0].force *= -1.0;
    let comparison = compare(&packing, &measured);
    assert_eq!(comparison.largest_error().unwrap(), 2.0);
    let words = comparison.worst().unwrap().to_string();
    assert!(words.contains("measured -0.46225016352102427 N, exact 0.46225016352102427 N"));
}

#[test]
fn wrong_sphere_numbers_are_reported() {
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
fn extra_pairs_with_small_forces_are_noise() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let perfect = perfect(&packing);
    let largest = perfect
        .iter()
        .fold(0.0, |most: f64, one| most.max(one.force));
    // Neighbours in a layer, spheres two layers apart, and a floor sphere with one that it does not support.
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
        // Tensile forces count too, and so does the smallest force.
        assert!(!with(-0.25 * largest).accepted(over));
        assert!(!with(f64::from_bits(1)).accepted(0.0));
        // A listed pair that does not touch.
        let comparison = with(-0.0);
        assert!(comparison.accepted(0.0));
        assert_eq!((comparison.extra(0.0), comparison.noise(0.0)), (0, 0));
        // A vector counts even if the magnitude is 0.
        let mut measured = perfect.clone();
        measured.push(Measured::new(ids, 0.0).with_vector([0.0, 0.1, 0.0]));
        assert!(!compare(&packing, &measured).accepted(1e-3));
    }
}

#[test]
fn extra_pairs_are_sorted_by_decreasing_force() {
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
fn touching_horizontal_neighbours_are_extra() {
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
fn errors_at_contacts_without_force_are_relative_to_the_largest_force() {
    let pile = Pile::triangular(4).unwrap().weightless();
    let pile = pile.with_load(Site::APEX, ratio(7, 1)).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let carrying: Vec<Measured> = perfect(&packing)
        .into_iter()
        .filter(|one| one.force != 0.0)
        .collect();
    // Three lines of three contacts.
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
    assert_eq!(comparison.largest_error().unwrap(), 0.5);
    assert_eq!(comparison.worst().unwrap().ids, idle);
    assert!((comparison.rms_error().unwrap() - 0.025_f64.sqrt()).abs() < 1e-15);
}

/// The ratio to the largest force is smaller than any positive float, but the error must not be 0.
#[test]
fn the_smallest_spurious_force_has_a_positive_error() {
    let pile = Pile::triangular(3).unwrap();
    let mass = cannonpile_dem::scene::parse::rational("1e200").unwrap();
    let packing = packing(&pile, ratio(6, 5)).with_mass(mass).unwrap();
    let mut measured = perfect(&packing);
    measured.push(Measured::new([2, 3], 1e-200));
    let comparison = compare(&packing, &measured);
    assert!(!comparison.accepted(0.0));
    assert!(comparison.accepted(1e-300));
}

/// All exact forces are 0, so any measured force has an infinite error.
#[test]
fn any_force_in_a_pile_without_forces_has_an_infinite_error() {
    let pile = Pile::triangular(3).unwrap().weightless();
    let packing = packing(&pile, ratio(6, 5));
    assert!(compare(&packing, &[]).accepted(0.0));
    for ids in [[1, 2], [2, 3]] {
        let comparison = compare(&packing, &[Measured::new(ids, 1e-300)]);
        assert!(!comparison.accepted(f64::MAX), "{comparison}");
    }
}

#[test]
fn pairs_of_fixed_spheres_are_counted_but_not_judged() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(1, 1));
    let mut measured = perfect(&packing);
    measured.push(Measured::new([5, 6], 100.0));
    measured.push(Measured::new([10, 6], 0.0));
    let comparison = compare(&packing, &measured);
    assert_eq!(comparison.fixed(), 2);
    assert!(comparison.accepted(0.0));
    // A pile of one layer consists of fixed spheres.
    let pile = Pile::under(Region::triangle(3).unwrap(), Stacking::fcc(1).unwrap()).unwrap();
    let packing = self::packing(&pile, ratio(1, 1));
    let comparison = compare(&packing, &[Measured::new([1, 2], 3.0)]);
    assert_eq!((comparison.fixed(), comparison.contacts()), (1, 0));
    assert!(comparison.accepted(0.0));
}

#[test]
fn the_rms_error_matches_the_errors_of_all_contacts() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut measured = magnitudes(&perfect(&packing));
    let errors: Vec<f64> = (0..30).map(|n: u8| f64::from(n) * 1e-5).collect();
    for (one, error) in measured.iter_mut().zip(&errors) {
        one.force *= 1.0 + error;
    }
    let want = (errors.iter().map(|e| e * e).sum::<f64>() / 30.0).sqrt();
    let got = compare(&packing, &measured).rms_error().unwrap();
    assert!((got - want).abs() < 1e-12 * want.max(1e-3), "{got} {want}");
}

/// The squares of these forces overflow or underflow.
#[test]
fn forces_near_the_limits_of_f64_are_compared() {
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
        assert!((comparison.largest_error().unwrap() - 0.25).abs() < 1e-15);
        assert!((comparison.rms_error().unwrap() - 0.25).abs() < 1e-15);
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
fn invalid_entries_are_rejected() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let one = Measured::new([1, 2], 0.5);
    let refused = |second: Measured| match Comparison::new(&packing, [one, second]) {
        Err(Refusal::Entry { entry: 2, fault }) => fault,
        other => panic!("{other:?}"),
    };
    assert_eq!(
        refused(Measured::new([1, 2], 0.0)),
        Fault::Twice {
            ids: [1, 2],
            first: 1
        }
    );
    // Sphere 4 is above the bottom layer, so that it touches no wall.
    for ids in [[0, 1], [1, 11], [u64::MAX, 4], [0, 11], [0, 0]] {
        assert!(matches!(
            refused(Measured::new(ids, 1.0)),
            Fault::NoSuchSphere { spheres: 10, first: 1, id } if ids.map(i128::from).contains(&id)
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
    // A third entry is rejected even if both spheres are fixed.
    let fixed = Measured::new([5, 6], 1.0);
    assert!(Comparison::new(&packing, [fixed, fixed.reversed(), fixed]).is_err());
}

#[test]
fn a_pile_too_large_to_compare_is_rejected_at_once() {
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
fn horizontal_contacts_are_compared() {
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
    // The contacts of one layer with the next are missing, but its horizontal contacts are present.
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
    // Each force is given for the other sphere.
    let reversed: Vec<Measured> = all.iter().map(|measured| measured.reversed()).collect();
    assert!(compare(&packing, &reversed).accepted(0.0));
    // One contact is missing, one force is too strong, one vector points the wrong way, and one contact is open.
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
    // The isostatic forces of this pile differ from its elastic ones.
    let isostatic = Packing::new(&bare, &Spacing::new(ratio(1, 1)).unwrap()).unwrap();
    assert!(!compare(&isostatic, &all).accepted(0.1));
}
