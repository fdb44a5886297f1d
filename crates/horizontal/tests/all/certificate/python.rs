//! The independent checker in Python gives the same verdicts.
//!
//! It needs `python3`. Without it, the checker of the library alone gives the verdicts, and the test reports that.

use std::fs;
use std::process::Stdio;

use cannonpile::lattice::{Axis, Dimension, HorizontalContact, Region, Sign, Site};
use cannonpile::stacking::Stacking;
use cannonpile::{Load, Pile};
use cannonpile_horizontal::certificate::{
    Certificate, Claim, Condition, Refusal, write_certificate,
};
use num_rational::BigRational;
use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};

use super::{all, bare, extreme};
use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::processes::Process;
use cannonpile_testkit::python_checker::{self, python, script};

fn file(certificate: &Certificate) -> Vec<u8> {
    let mut file = Vec::new();
    write_certificate(certificate, &mut file).expect("a text");
    file
}

/// Asserts that both checkers agree about a certificate, and returns whether they accept it.
pub(super) fn agreed(certificate: &Certificate) -> bool {
    let file = file(certificate);
    let Some((status, said)) = python_checker::verdict(&file) else {
        return certificate.check().is_ok();
    };
    let context = || format!("{said}\n{}", String::from_utf8_lossy(&file));
    let refusal = match certificate.check() {
        Ok(()) => {
            assert_eq!((status, said.as_str()), (0, "accepted"), "{}", context());
            return true;
        }
        Err(refusal) => refusal,
    };
    assert_eq!(status, 1, "{refusal}: {}", context());
    // Both checkers proceed from the top, row by row, so they stop at the same number if only forces are wrong.
    let Refusal::Violated(condition, text) = &refusal else {
        return false;
    };
    let numbers = match condition {
        Condition::HorizontalTension if certificate.horizontal.len() > 1 => return false,
        Condition::Tension | Condition::HorizontalTension | Condition::Work => text,
        // The claimed number follows.
        Condition::Bound | Condition::Attained => text.split_once(',').expect("two numbers").0,
        _ => return false,
    };
    let number = numbers.rsplit(' ').next().expect("a number");
    assert!(
        said.contains(&format!("= {number} ")) || said.contains(&format!("= {number},")),
        "{refusal}: {}",
        context()
    );
    false
}

struct RandomCases {
    chance: TestRng,
    /// Whether loads and gravity may lean.
    leaning: bool,
}

impl RandomCases {
    fn new(leaning: bool) -> Self {
        Self {
            chance: TestRng::deterministic_rng(RngAlgorithm::ChaCha),
            leaning,
        }
    }

    fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.chance.next_u32()).unwrap() % end
    }

    fn number(&mut self, least: i64) -> BigRational {
        let denom = [1, 1, 2, 3, 7][self.below(5)];
        ratio(i64::try_from(self.below(9)).unwrap() + least, denom)
    }

    fn one_of<T: Clone>(&mut self, all: &[T]) -> Option<T> {
        (!all.is_empty()).then(|| all[self.below(all.len())].clone())
    }

    /// Returns a random stacking on a random small region, or discs, with random weights, loads and tilt, or
    /// without weight.
    fn pile(&mut self) -> Pile {
        let layers = 1 + self.below(5);
        let signs = (1..layers).map(|_| [Sign::Plus, Sign::Minus][self.below(2)]);
        let stacking = Stacking::from_signs(signs.collect::<Vec<_>>()).unwrap();
        let sides = [self.below(3), self.below(3)].map(|n| i128::try_from(n + 1).unwrap());
        let mut pile = match self.below(6) {
            0 => Pile::discs(layers.try_into().unwrap()).unwrap(),
            1 => {
                let base = Region::hexagon(sides[0] + 3, sides[1] + 2).unwrap();
                let on = Pile::on(base, stacking.clone());
                on.unwrap_or_else(|_| Pile::under(Region::SITE, stacking).unwrap())
            }
            2 => Pile::under(Region::new(-1..=1, 0..=3, 0..=2).unwrap(), stacking).unwrap(),
            _ => Pile::under(Region::hexagon(sides[0], sides[1]).unwrap(), stacking).unwrap(),
        };
        let sites: Vec<Site> = pile.shape().sites().collect();
        for _ in 0..self.below(3) {
            let site = sites[self.below(sites.len())];
            let [x, y] = self.lean(&pile);
            let down = self.number(0);
            pile = pile.with_load(site, Load { down, x, y }).unwrap();
            let site = sites[self.below(sites.len())];
            pile = pile.with_weight(site, self.number(0)).unwrap();
        }
        let tilt = self.lean(&pile);
        pile = pile.with_tilt(tilt).unwrap();
        if self.below(8) == 0 {
            pile = pile.weightless();
        }
        pile
    }

    /// Returns the horizontal part (x, y) of a load.
    fn lean(&mut self, pile: &Pile) -> [BigRational; 2] {
        let in_plane = pile.dimension() == Dimension::Two;
        [false, in_plane].map(|upright| {
            if upright || !self.leaning {
                return ratio(0, 1);
            }
            self.number(-4) / ratio(40, 1)
        })
    }

    /// Returns a random claim about a random pile: its forces may be valid, its field rarely is.
    fn certificate(&mut self) -> Certificate {
        let pile = self.pile();
        let sites: Vec<Site> = pile.shape().sites().collect();
        let on_floor = *sites.last().unwrap();
        let extreme = extreme(on_floor, self.number(0), self.below(2) == 0);
        let stiffness_ratio = self.number(1);
        let claim = match self.below(9) {
            8 => Certificate::of_forces(&pile).expect("a small pile").claim,
            0 => Claim::CannotStand,
            1 => Claim::Least(extreme),
            2 => Claim::Greatest(extreme),
            3 => Claim::Elastic { stiffness_ratio },
            _ => Claim::Stands,
        };
        let mut certificate = bare(pile, claim);
        let contacts = super::changed::contacts(&certificate);
        for _ in 0..self.below(6) {
            if let Some(contact) = self.one_of(&contacts) {
                certificate.horizontal.insert(contact, self.number(0));
            }
        }
        for _ in 0..self.below(3) {
            let site = sites[self.below(sites.len())];
            let field = [(); 3].map(|()| self.number(-4));
            certificate.field.insert(site, field);
        }
        certificate
    }

    /// Changes one random part of a certificate.
    fn change(&mut self, certificate: &mut Certificate) {
        let sites: Vec<Site> = certificate.pile.shape().sites().collect();
        let site = sites[self.below(sites.len())];
        match self.below(7) {
            0 => {
                let axis = Axis::ALL[self.below(3)];
                let contact = HorizontalContact { site, axis };
                *certificate.horizontal.entry(contact).or_default() += self.number(-4);
            }
            1 => {
                let contacts: Vec<_> = certificate.horizontal.keys().copied().collect();
                if let Some(contact) = self.one_of(&contacts) {
                    *certificate.horizontal.entry(contact).or_default() += self.number(-4);
                }
            }
            2 => {
                certificate.field.entry(site).or_default()[self.below(3)] += self.number(-4);
            }
            3 => {
                let sites: Vec<_> = certificate.field.keys().copied().collect();
                if let Some(site) = self.one_of(&sites) {
                    certificate.field.entry(site).or_default()[self.below(3)] += self.number(-4);
                }
            }
            4 => match &mut certificate.claim {
                Claim::Least(extreme) | Claim::Greatest(extreme) => match self.below(3) {
                    0 => extreme.site = site,
                    1 => extreme.normal += self.number(-4),
                    _ => extreme.attained ^= true,
                },
                Claim::Elastic { stiffness_ratio } => *stiffness_ratio += self.number(-4),
                Claim::Forces(forces) => match self.below(4) {
                    0 => forces.within += self.number(-1),
                    1 => forces.compressive ^= true,
                    2 => forces.contacts.entry(site).or_default()[self.below(3)] += self.number(-4),
                    _ => {
                        let last = forces.floor.len() - 1;
                        forces.floor[last].normal += self.number(-4);
                    }
                },
                claim => *claim = Claim::Stands,
            },
            5 => {
                let pile = certificate.pile.clone();
                let [x, y] = self.lean(&pile);
                let down = self.number(0);
                certificate.pile = pile.with_load(site, Load { down, x, y }).unwrap();
            }
            _ => {
                certificate.claim = match certificate.claim.clone() {
                    Claim::Least(extreme) => Claim::Greatest(extreme),
                    Claim::Greatest(extreme) => Claim::Least(extreme),
                    Claim::Stands => Claim::CannotStand,
                    _ => Claim::Stands,
                };
            }
        }
    }
}

/// The checker as a program, on a file: it prints the same line and exits with the corresponding status.
#[test]
fn program_agrees_on_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let name = "certificate.json";
    let accepted = all().remove(0);
    let mut refused = accepted.clone();
    refused.claim = match accepted.claim {
        Claim::Stands => Claim::CannotStand,
        _ => Claim::Stands,
    };
    for (text, status) in [
        (file(&accepted), 0),
        (file(&refused), 1),
        (b"{}".to_vec(), 2),
    ] {
        fs::write(folder.path().join(name), &text).expect("a file");
        let Some(mut python) = python() else { return };
        let program = python.arg(script()).arg(name).current_dir(&folder);
        let program = program.stdout(Stdio::piped()).stderr(Stdio::piped());
        let output = Process::start(program).expect("python3 runs").output();
        let said = String::from_utf8([output.stdout, output.stderr].concat()).expect("text");
        let said = said.replace(name, "-");
        let one_line = said.split_whitespace().collect::<Vec<_>>().join(" ");
        let verdict = python_checker::verdict(&text).expect("python3");
        assert_eq!((status, one_line), verdict);
        assert_eq!(output.status.code(), Some(status.into()));
    }
}

#[test]
fn valid_certificates_are_accepted_by_both() {
    for certificate in all() {
        assert!(agreed(&certificate), "{certificate:?}");
    }
}

#[test]
fn certificates_of_tilted_piles_are_accepted_by_both() {
    for (x, claim) in [(300, Claim::Stands), (50, Claim::CannotStand)] {
        let pile = Pile::under(Region::SITE, Stacking::hcp(6).unwrap()).unwrap();
        let pile = pile.with_tilt([ratio(1, x), ratio(0, 1)]).unwrap();
        let certificate = cannonpile_horizontal::equilibrium(&pile).unwrap();
        assert_eq!(certificate.claim, claim);
        assert!(agreed(&certificate));
    }
}

#[test]
fn changed_certificates_have_one_verdict() {
    for leaning in [false, true] {
        let (mut chance, all) = (RandomCases::new(leaning), all());
        let mut accepted = 0;
        for turn in 0..80 {
            let mut certificate = all[turn % all.len()].clone();
            chance.change(&mut certificate);
            accepted += i32::from(agreed(&certificate));
        }
        assert!((5..75).contains(&accepted), "{accepted}");
    }
}

#[test]
fn random_certificates_have_one_verdict() {
    let mut chance = RandomCases::new(false);
    let mut accepted = 0;
    for _ in 0..80 {
        accepted += i32::from(agreed(&chance.certificate()));
    }
    assert!((5..75).contains(&accepted), "{accepted}");
    // Few random forces balance loads that lean.
    let mut chance = RandomCases::new(true);
    for _ in 0..80 {
        agreed(&chance.certificate());
    }
}

#[test]
fn census_is_accepted_by_both() {
    let census = cannonpile_horizontal::census::under_one_sphere(7, true).unwrap();
    for entry in census.map(Result::unwrap) {
        assert!(agreed(&entry.certificate), "{entry:?}");
    }
    let long = Pile::under(Region::SITE, "(1,40,3)".parse().unwrap()).unwrap();
    assert!(agreed(&cannonpile_horizontal::equilibrium(&long).unwrap()));
}
