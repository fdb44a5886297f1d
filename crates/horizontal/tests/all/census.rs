//! The census at a = R. Every certificate is checked. Every stacking is an entry or extends an unstable entry.

use std::collections::BTreeSet;

use cannonpile::Error as Core;
use cannonpile::Pile;
use cannonpile::lattice::{Region, Site};
use cannonpile::stacking::Notation;
use cannonpile_horizontal::census::{DecidedBy, Entry};
use cannonpile_horizontal::certificate::Claim;
use cannonpile_horizontal::{Error, census, elastic, equilibrium};
use num_rational::BigRational;
use num_traits::One;

use crate::stackings;
use cannonpile_testkit::cases::Random;
use cannonpile_testkit::oracles::balance::ratio;

fn entries(layers: i128, failing: bool) -> Vec<Entry> {
    let entries = census::under_one_sphere(layers, failing).unwrap();
    entries.map(Result::unwrap).collect()
}

fn signs(pile: &Pile) -> String {
    let stacking = pile.shape().stacking();
    if pile.layers() == 1 {
        return String::new();
    }
    stacking.in_notation(Notation::Hagg).to_string()
}

/// Asserts that the certificate is about the pile and accepted, and that `decided_by` describes it.
fn is_proved(entry: &Entry) {
    let Entry {
        pile, certificate, ..
    } = entry;
    assert_eq!(certificate.check(), Ok(()), "{}", signs(pile));
    assert_eq!(certificate.pile, *pile);
    let of_line = |(_, field): (&Site, &[BigRational; 3])| field.iter().any(One::is_one);
    match entry.decided_by {
        DecidedBy::Sloping => assert!(certificate.horizontal.is_empty() && entry.stands()),
        DecidedBy::Horizontal => assert!(!certificate.horizontal.is_empty() && entry.stands()),
        DecidedBy::Run => {
            assert!(!entry.stands());
            assert_eq!(certificate.field.len(), 5);
            assert_eq!(
                certificate.field.iter().filter(|of| of_line(*of)).count(),
                4
            );
        }
        DecidedBy::Work => assert!(!entry.stands() && !certificate.field.is_empty()),
        other => panic!("{other}"),
    }
    let alone = pile.first_failure().unwrap().is_none();
    assert_eq!(alone, entry.decided_by == DecidedBy::Sloping);
}

/// A run of four steps can be stable. A Farkas certificate of the linear program refutes this one.
#[test]
fn run_of_four_is_decided_by_program() {
    let entries = entries(7, true);
    let found = entries.iter().find(|entry| signs(&entry.pile) == "+----+");
    assert_eq!(found.map(|entry| entry.decided_by), Some(DecidedBy::Work));
}

#[test]
fn counts_up_to_nine_layers() {
    let mut counts = Vec::new();
    for layers in 1..=9 {
        let both = entries(layers, true);
        both.iter().for_each(is_proved);
        let (standing, failing): (Vec<_>, Vec<_>) = both.iter().partition(|entry| entry.stands());
        assert!(entries(layers, false).iter().eq(standing.iter().copied()));
        assert!(standing.iter().all(|entry| entry.pile.layers() == layers));
        if layers >= 6 {
            assert_eq!(both.len(), usize::try_from(12 * layers - 56).unwrap());
        }
        counts.push(standing.len());
        // Each unstable entry fails at its last sign change: without its last step it is stable.
        let beginnings: Vec<String> = standing.iter().map(|entry| signs(&entry.pile)).collect();
        for entry in failing {
            let signs = signs(&entry.pile);
            let before = &signs[..signs.len() - 1];
            assert!(
                beginnings
                    .iter()
                    .any(|standing| standing.starts_with(before)),
                "{signs}"
            );
        }
    }
    assert_eq!(counts, [1, 1, 2, 4, 8, 12, 12, 12, 12]);
}

/// The comparison computes the elastic state, by another method.
#[test]
fn census_matches_brute_force_up_to_seven_layers() {
    let both = entries(7, true);
    let [standing, failing] = [true, false].map(|stands| -> BTreeSet<String> {
        let of_verdict = both.iter().filter(|entry| entry.stands() == stands);
        of_verdict.map(|entry| signs(&entry.pile)).collect()
    });
    let mut seen = [0, 0];
    for steps in 1..=6 {
        for stacking in stackings(steps) {
            let pile = Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap();
            let stands = match elastic(&pile, &ratio(1, 1)) {
                Ok(_) => true,
                Err(error) => {
                    assert_eq!(error, Error::CannotStand);
                    false
                }
            };
            let begins = failing
                .iter()
                .filter(|failing| stacking.starts_with(*failing));
            assert_eq!(begins.count(), usize::from(!stands), "{stacking}");
            let goes_on = standing
                .iter()
                .any(|standing| standing.starts_with(&stacking));
            assert_eq!(goes_on, stands, "{stacking}");
            seen[usize::from(stands)] += 1;
        }
    }
    assert_eq!(seen, [24, 39]);
}

#[test]
fn census_has_no_layer_limit() {
    for layers in [1_000_000, 10_i128.pow(36)] {
        let standing = entries(layers, false);
        assert_eq!(standing.len(), 12);
        for entry in standing {
            assert_eq!(entry.certificate.check(), Ok(()));
            assert_eq!(entry.pile.layers(), layers);
            // Certificates of large piles cover the first layers, to the layer below the last sign change.
            let certified = signs(&entry.certificate.pile);
            let last_run = entry.pile.shape().stacking().runs().last().unwrap();
            assert_eq!(
                i128::try_from(certified.len()).unwrap(),
                layers - last_run.steps
            );
        }
    }
    let refused = census::under_one_sphere(10_i128.pow(36), true).err();
    assert!(matches!(
        refused,
        Some(Error::Core(Core::TooManyRows { .. }))
    ));
    let all = census::under_one_sphere(1_000_000, true).unwrap();
    for entry in all.take(200).map(Result::unwrap) {
        assert_eq!(entry.certificate.check(), Ok(()));
    }
}

/// Returns `true` if the field on an edge proves that the pile is unstable.
fn by_an_edge(pile: &Pile) -> bool {
    let certificate = equilibrium(pile).unwrap();
    assert_eq!(certificate.check(), Ok(()), "{:?}", pile.shape());
    certificate.claim == Claim::CannotStand && certificate.field.len() == 5
}

#[test]
fn long_run_is_unstable_under_any_top() {
    let mut random = Random(7);
    for _ in 0..30 {
        let top = random.bounds(4).region();
        for stacking in [
            "++++-",
            "----+",
            "++++-++",
            "+-----+",
            "--+++++-",
            "(400,2)",
            "(1,60,1,30)",
        ] {
            let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
            assert!(by_an_edge(&pile), "{stacking} under {top}");
        }
    }
    // Also for very large piles.
    let pile = Pile::under(
        Region::SITE,
        format!("({},3)", 10_i128.pow(30)).parse().unwrap(),
    );
    assert!(by_an_edge(&pile.unwrap()));
    let wide = Pile::on(
        Region::hexagon(1_000_000, 900_000).unwrap(),
        "(9,80)".parse().unwrap(),
    );
    assert!(by_an_edge(&wide.unwrap()));
    // A run one step shorter is not too long.
    let pile = Pile::under(Region::SITE, "+++-".parse().unwrap()).unwrap();
    assert_eq!(equilibrium(&pile).unwrap().claim, Claim::Stands);
}

#[test]
fn loads_on_edge_change_certificate() {
    let pile = Pile::under(Region::SITE, "++++-".parse().unwrap()).unwrap();
    let corners = [[0, 0], [4, 0], [0, 4]].map(|[i, j]| Site { i, j, k: 4 });
    // The three corners carry loads, so they press on their neighbours.
    let heavy = corners.into_iter().fold(pile.clone(), |pile, site| {
        pile.with_load(site, ratio(1, 3)).unwrap()
    });
    let certificate = equilibrium(&heavy).unwrap();
    assert_eq!(
        (certificate.check(), certificate.field.len() == 5),
        (Ok(()), false)
    );
    let one_free = corners[1..].iter().fold(pile, |pile, site| {
        pile.with_load(*site, ratio(1, 3)).unwrap()
    });
    assert!(by_an_edge(&one_free));
    // A longer run outweighs a load at its end.
    let pile = Pile::under(Region::SITE, "(40,1)".parse().unwrap()).unwrap();
    let loaded = [[0, 0], [40, 0], [0, 40]]
        .iter()
        .fold(pile, |pile, [i, j]| {
            let site = Site {
                i: *i,
                j: *j,
                k: 40,
            };
            pile.with_load(site, ratio(25, 3)).unwrap()
        });
    let certificate = equilibrium(&loaded).unwrap();
    assert_eq!(
        (certificate.claim.clone(), certificate.check()),
        (Claim::CannotStand, Ok(()))
    );
    assert_eq!(certificate.field.len(), 30);
}

#[test]
fn every_kind_of_proof_occurs_on_bases() {
    let mut decided = Vec::new();
    for base in [
        Region::hexagon(3, 4),
        Region::hexagon(2, 3),
        Region::triangle(7),
        Region::triangle(5),
    ] {
        let base = base.unwrap();
        let all: Vec<Entry> = census::on_base(base).unwrap().map(Result::unwrap).collect();
        all.iter().for_each(is_proved_and_matches_elastic_state);
        let alone = cannonpile_stability::census::on_base(base)
            .unwrap()
            .map(Result::unwrap);
        let piles: Vec<Pile> = alone.map(|entry| entry.pile).collect();
        assert!(all.iter().map(|entry| &entry.pile).eq(&piles));
        decided.extend(all.iter().map(|entry| entry.decided_by));
    }
    for reason in [
        DecidedBy::Sloping,
        DecidedBy::Horizontal,
        DecidedBy::Run,
        DecidedBy::Work,
    ] {
        assert!(decided.contains(&reason), "{reason}");
    }
    let refused = census::on_base(Region::hexagon(50, 50).unwrap()).err();
    assert!(matches!(
        refused,
        Some(Error::Core(Core::TooManyRows { .. }))
    ));
}

fn is_proved_and_matches_elastic_state(entry: &Entry) {
    is_proved(entry);
    if entry.pile.layers() <= 6 {
        let cannot = Err(Error::CannotStand);
        let elastic = elastic(&entry.pile, &ratio(1, 1)).map(drop);
        assert_eq!(elastic, if entry.stands() { Ok(()) } else { cannot });
    }
}

#[test]
fn proof_kinds_are_printed_by_name() {
    for (by, name) in [
        (DecidedBy::Sloping, "sloping"),
        (DecidedBy::Horizontal, "horizontal"),
        (DecidedBy::Run, "run"),
        (DecidedBy::Work, "work"),
    ] {
        assert_eq!((by.to_string(), by.name()), (name.to_owned(), name));
        assert_eq!(format!("{by:>11}"), format!("{name:>11}"));
    }
}

/// There are 12L − 56 entries for L layers, and the limit is 10¹¹.
#[test]
fn entry_count_is_limited() {
    let most = 8_333_333_338;
    assert!(census::under_one_sphere(most, true).is_ok());
    let refused = census::under_one_sphere(most + 1, true).err();
    assert!(matches!(
        refused,
        Some(Error::Core(Core::TooManyRows { rows, .. })) if rows == 100_000_000_012_u64.into()
    ));
}
