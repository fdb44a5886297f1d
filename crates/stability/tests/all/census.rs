//! The census compared with all stackings: under one sphere by brute force over 2^12 of them, on bases by the oracle.

use std::collections::BTreeSet;

use cannonpile::Error;
use cannonpile::lattice::Region;
use cannonpile::stacking::Notation;
use cannonpile_stability::census::{self, Entry};
use cannonpile_testkit::cases::{Bounds, Case, Random, all_on};
use cannonpile_testkit::compare;
use cannonpile_testkit::oracles::balance::{Balance, Sites};
use cannonpile_testkit::oracles::brute::Front;

const MAX_STEPS: usize = 13;

/// All stable stackings and the shortest unstable ones that begin with +, by number of steps.
struct Found {
    standing: Vec<BTreeSet<String>>,
    failing: Vec<BTreeSet<String>>,
}

/// Examines every stacking layer by layer. The forces of a common beginning are computed once.
fn brute_force() -> Found {
    let none = || vec![BTreeSet::new(); MAX_STEPS + 1];
    let mut found = Found {
        standing: none(),
        failing: none(),
    };
    found.standing[0].insert(String::new());
    let top = Front::<i128>::top(&Bounds::SITE.sites());
    let mut pending = vec![(String::new(), top)];
    while let Some((signs, front)) = pending.pop() {
        for sign in ['+', '-'] {
            if signs.is_empty() && sign == '-' {
                continue;
            }
            let signs = format!("{signs}{sign}");
            let passed = front.step(sign, |_| 1);
            if passed.pulls() {
                found.failing[signs.len()].insert(signs);
                continue;
            }
            found.standing[signs.len()].insert(signs.clone());
            if signs.len() < MAX_STEPS {
                pending.push((signs, passed.below));
            }
        }
    }
    found
}

fn signs(entry: &Entry) -> String {
    entry
        .pile
        .shape()
        .stacking()
        .in_notation(Notation::Hagg)
        .to_string()
}

fn entries(layers: usize, failing: bool) -> Vec<Entry> {
    let layers = i128::try_from(layers).unwrap();
    let entries = census::under_one_sphere(layers, failing).unwrap();
    entries.map(Result::unwrap).collect()
}

#[test]
fn under_one_sphere_up_to_14_layers() {
    let found = brute_force();
    let mut counts = Vec::new();
    for steps in 0..=MAX_STEPS {
        let standing: Vec<String> = entries(steps + 1, false).iter().map(signs).collect();
        counts.push(standing.len());
        assert_eq!(
            standing.iter().cloned().collect::<BTreeSet<_>>(),
            found.standing[steps]
        );
        assert_eq!(standing.len(), found.standing[steps].len());
        let both = entries(steps + 1, true);
        let (stand, fail): (Vec<_>, Vec<_>) = both.iter().partition(|entry| entry.stands());
        assert_eq!(stand.into_iter().map(signs).collect::<Vec<_>>(), standing);
        let failing: BTreeSet<String> = found.failing[..=steps].iter().flatten().cloned().collect();
        assert_eq!(fail.len(), failing.len());
        for entry in &fail {
            // It fails at its last step and not before.
            assert_eq!(entry.standing.first_failure, Some(entry.pile.layers() - 2));
        }
        assert_eq!(
            fail.into_iter().map(signs).collect::<BTreeSet<_>>(),
            failing
        );
    }
    assert_eq!(counts, [1, 1, 2, 4, 8, 11, 11, 11, 11, 11, 11, 11, 11, 11]);
}

#[test]
fn brute_force_is_complete() {
    // The stable stackings and the continuations of unstable ones are all stackings.
    let found = brute_force();
    for steps in 1..=MAX_STEPS {
        let failed = (1..=steps).map(|n| found.failing[n].len() << (steps - n));
        let all = found.standing[steps].len() + failed.sum::<usize>();
        assert_eq!(all, 1 << (steps - 1));
    }
}

#[test]
fn entries_are_ordered_by_their_runs() {
    for failing in [false, true] {
        for layers in 1..=14 {
            let runs = entries(layers, failing).into_iter().map(|entry| {
                let runs = entry.pile.shape().stacking().runs();
                let mut runs: Vec<i128> = runs.map(|run| run.steps).collect();
                // The last run is as long as the number of layers permits.
                runs.pop();
                runs
            });
            assert!(runs.is_sorted());
        }
    }
}

#[test]
fn entries_have_the_oracles_least_force() {
    for layers in 1..=10 {
        for entry in entries(layers, true) {
            let balance = Balance::under(&Bounds::SITE.sites(), &signs(&entry));
            compare::standing(&entry.pile, &balance.forces()).unwrap();
            assert_eq!(entry.pile.standing().as_ref(), Ok(&entry.standing));
        }
    }
}

/// Returns whether a set of sites is a translation of its mirror image.
fn is_its_own_mirror_image(sites: &Sites) -> bool {
    let moved = |sites: Vec<(i128, i128)>| -> Sites {
        let first = |pick: fn(&(i128, i128)) -> i128| sites.iter().map(pick).min().expect("a site");
        let (j0, i0) = (first(|site| site.0), first(|site| site.1));
        sites.iter().map(|(j, i)| (j - j0, i - i0)).collect()
    };
    let mirrored = sites.iter().map(|(j, i)| (-j, -i)).collect();
    moved(sites.iter().copied().collect()) == moved(mirrored)
}

fn agrees_with_the_oracle(base: &Bounds) {
    let sites = base.sites();
    let one_of_two = is_its_own_mirror_image(&sites);
    assert_eq!(one_of_two, base.region().is_its_own_mirror_image());
    let all: BTreeSet<String> = all_on(base).into_iter().collect();
    let highest = |signs: &&String| {
        let higher = ["+", "-"].map(|sign| format!("{sign}{signs}"));
        !higher.iter().any(|higher| all.contains(higher))
    };
    let kept = |signs: &&String| !(one_of_two && signs.ends_with('-'));
    let expected: BTreeSet<&String> = all.iter().filter(highest).filter(kept).collect();
    let entries: Vec<Entry> = census::on_base(base.region())
        .unwrap()
        .map(Result::unwrap)
        .collect();
    let found: BTreeSet<String> = entries.iter().map(signs).collect();
    assert_eq!(found.len(), entries.len(), "each once");
    assert!(found.iter().eq(expected), "{base:?}");
    for entry in entries {
        let case = Case::on(base, &signs(&entry)).expect("it fits");
        assert_eq!(entry.pile, case.pile);
        let forces = case.balance.forces();
        compare::standing(&entry.pile, &forces).unwrap();
        assert_eq!(entry.pile.standing().as_ref(), Ok(&entry.standing));
        assert_eq!(entry.stands(), forces.first_failure().is_none());
    }
}

#[test]
fn on_triangles_and_hexagons() {
    for (p, q) in (1..=4).flat_map(|p| (1..=4).map(move |q| (p, q))) {
        agrees_with_the_oracle(&Bounds::hexagon(p, q));
    }
    for n in 5..=8 {
        agrees_with_the_oracle(&Bounds::triangle(n));
    }
}

#[test]
fn on_parallelograms_and_random_bases() {
    for (width, height) in [(1, 5), (2, 2), (3, 4), (5, 5)] {
        let base = Bounds {
            x: (0, width - 1),
            y: (3, 3 + height - 1),
            s: (-20, 20),
        };
        assert!(base.region().is_its_own_mirror_image());
        agrees_with_the_oracle(&base);
    }
    let mut random = Random(91);
    for _ in 0..40 {
        agrees_with_the_oracle(&random.bounds(6));
    }
}

/// The census does not store future prefixes or the stackings of a base.
#[test]
fn a_census_of_any_size_starts_quickly() {
    let refused = census::under_one_sphere(10_i128.pow(36), true).err();
    assert!(matches!(refused, Some(Error::TooManyRows { .. })));
    let all = census::under_one_sphere(1_000_000, true).unwrap();
    let first: Vec<Entry> = all.take(20).map(Result::unwrap).collect();
    assert!(first[0].stands() && first[1].stands() && !first[19].stands());
    let mut wide = census::on_base(Region::new(0..=30_000, 0..=20, 0..=30_020).unwrap()).unwrap();
    assert_eq!(wide.next().unwrap().unwrap().pile.layers(), 21);
    for side in [40, 1_000_000] {
        let refused = census::on_base(Region::hexagon(side, side).unwrap());
        assert!(
            matches!(refused.err(), Some(Error::TooManyRows { .. })),
            "{side}"
        );
    }
}

/// 11L − 50 entries of L layers. The limit is 10¹¹.
#[test]
fn the_error_of_a_large_census_states_its_size() {
    let most = 9_090_909_095;
    assert!(census::under_one_sphere(most, true).is_ok());
    let refused = |layers, rows: u64| {
        let refusal = Error::TooManyRows {
            rows: rows.into(),
            limit: census::MAX_ENTRIES,
            remedy: "ask for fewer layers, or only for stable stackings",
        };
        assert_eq!(census::under_one_sphere(layers, true).err(), Some(refusal));
    };
    refused(most + 1, 100_000_000_006);
    refused(10_i128.pow(11), 1_099_999_999_950);
}
