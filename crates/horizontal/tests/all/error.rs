//! Every error message of this crate is one line that states the given value and the remedy.

use std::error::Error as _;

use cannonpile::Pile;
use cannonpile::lattice::{Region, Site};
use cannonpile_horizontal::{Error, bounds, elastic};
use cannonpile_testkit::errors::says;
use num_rational::BigRational;

const BOTTOM: Site = Site { i: 0, j: 0, k: 5 };

fn under_one_sphere(stacking: &str) -> Pile {
    Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap()
}

#[test]
fn weightless() {
    let pile = Pile::triangular(6).unwrap().weightless();
    let error = bounds(&pile, BOTTOM).unwrap_err();
    assert_eq!(error, Error::Weightless);
    says(
        &error,
        &["this pile is weightless", "give the spheres their weight"],
    );
}

#[test]
fn cannot_stand() {
    let error = elastic(
        &under_one_sphere("++++-"),
        &BigRational::from_integer(1.into()),
    );
    let error = error.unwrap_err();
    assert_eq!(error, Error::CannotStand);
    says(
        &error,
        &["is unstable", "change the stacking, or the loads"],
    );
}

/// The message of a wrapped error is that of the inner error, and the chain of sources does not repeat it.
#[test]
fn errors_of_the_core() {
    let error = bounds(&Pile::triangular(6).unwrap(), Site::APEX).unwrap_err();
    let inner = cannonpile::Error::NotOnFloor {
        site: Site::APEX,
        floor: 5,
    };
    assert_eq!(error, Error::Core(inner.clone()));
    assert_eq!(error.to_string(), inner.to_string());
    assert!(error.source().is_none());
}
