//! The symmetries of a pile preserve its forces. Other mappings do not.

use cannonpile::lattice::{Direction, Site, count};
use cannonpile_testkit::answers::{Answers, Shape, ratio};

use crate::theorems::symmetry::{MIRRORED, MIRRORED_DISCS, Symmetry, TURNS, invariant};

#[test]
fn equilateral_piles_have_all_six() {
    for layers in 1..=20 {
        let pile = Answers::of(&Shape::equilateral(), layers);
        for (symmetry, turn) in Symmetry::ALL.into_iter().zip(&TURNS) {
            let verdict = invariant(&pile, symmetry, turn);
            assert_eq!(verdict, Ok(()), "{symmetry:?}, {layers} layers");
        }
    }
}

#[test]
fn isosceles_piles_have_only_the_mirror() {
    for shape in Shape::isosceles() {
        for layers in 1..=10 {
            let pile = Answers::of(&shape, layers);
            let mirror = invariant(&pile, Symmetry::MIRROR, &MIRRORED);
            assert_eq!(mirror, Ok(()), "{shape:?}, {layers} layers");
            // One sphere has every symmetry.
            if layers == 1 || shape == Shape::equilateral() {
                continue;
            }
            for (symmetry, turn) in Symmetry::ALL.into_iter().zip(&TURNS) {
                let kept = [Symmetry::ALL[0], Symmetry::MIRROR].contains(&symmetry);
                let holds = invariant(&pile, symmetry, turn).is_ok();
                assert_eq!(holds, kept, "{symmetry:?}: {shape:?}, {layers} layers");
            }
        }
    }
}

/// Compares only the magnitudes of contact forces, without vectors. The rotation fails for them too.
#[test]
fn an_isosceles_base_breaks_the_symmetry_of_magnitudes() {
    let forces = |shape: &Shape| {
        let pile = shape.pile(2);
        Direction::ALL.map(|direction| pile.forces().contact(Site::APEX, direction))
    };
    let [alpha, beta, gamma] = forces(&Shape::Spheres(ratio(2, 5)));
    assert_eq!(alpha, beta);
    assert_ne!(alpha, gamma);
    assert_eq!(gamma, Ok(ratio(4, 5)));
}

#[test]
fn discs_have_the_mirror() {
    for layers in 1..=40 {
        let pile = Answers::of(&Shape::Discs, layers);
        let mirror = invariant(&pile, Symmetry::MIRROR, &MIRRORED_DISCS);
        assert_eq!(mirror, Ok(()), "{layers} layers");
    }
    let pile = Answers::of(&Shape::Discs, 3);
    assert!(invariant(&pile, Symmetry::ROTATION, &TURNS[1]).is_err());
}

#[test]
fn three_rotations_and_two_mirrors_are_the_identity() {
    let chain = |site, symmetries: &[Symmetry]| {
        let mut symmetries = symmetries.iter();
        symmetries.try_fold(site, |site, symmetry| symmetry.apply(site))
    };
    let (turn, mirror) = (Symmetry::ROTATION, Symmetry::MIRROR);
    for site in Shape::equilateral().sites(20) {
        assert_eq!(chain(site, &[turn, turn, turn]), Some(site));
        assert_eq!(chain(site, &[mirror, mirror]), Some(site));
        assert_eq!(chain(site, &[Symmetry::ALL[0]]), Some(site));
        assert_eq!(chain(site, &[turn, Symmetry::ALL[2]]), Some(site));
    }
    let outside = Site {
        i: i128::MIN,
        j: 0,
        k: 0,
    };
    assert_eq!(mirror.apply(outside), None);
}

/// The appendix: {j → k−i−j, i → j} turns N_γ = j into N_α, and a second application turns it into N_β.
#[test]
fn the_papers_rotation_permutes_the_counts() {
    let counts = |Site { i, j, k }| count::above(&i, &j, &k);
    for site in Shape::equilateral().sites(20) {
        let Site { i, j, k } = site;
        let turned = Symmetry::ROTATION.apply(site).unwrap();
        assert_eq!(
            turned,
            Site {
                i: j,
                j: k - i - j,
                k
            }
        );
        let [n_alpha, n_beta, n_gamma] = counts(site);
        assert_eq!(counts(turned), [n_beta, n_gamma, n_alpha]);
        for direction in Direction::ALL {
            let source = Symmetry::ROTATION.source(direction);
            assert_eq!(
                counts(turned)[direction.index()],
                counts(site)[source.index()]
            );
        }
    }
}
