//! Expressions as a scalar: they obey the laws, and closed forms are recorded as the library computes them.

use cannonpile::Pile;
use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::{Algebra, Ring, Symbol};
use cannonpile_proof::Expression;
use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::laws::{keeps_numerators, obeys_algebra, obeys_integers, wide};
use num_traits::Zero;

#[test]
fn expressions() {
    let [x, y] = ["x", "y"].map(|name| Expression::from(Symbol(name)));
    let seventh = 7.try_into().expect("7");
    obeys_algebra(&[
        Expression::zero(),
        Expression::from_integer(-1),
        Expression::from_rational(&ratio(i64::MIN, i64::MAX)),
        x.clone(),
        -y.clone(),
        x.clone() - &y,
        (x.clone() * &x * &y).div_int(seventh) - &Expression::from_integer(5),
        x.clone() + &y.div_int(i64::MIN.try_into().expect("not zero")),
    ]);
    obeys_integers::<Expression>();
    keeps_numerators::<Expression>(&wide());
    // Division by an expression with symbols is undefined.
    assert!((x.clone() * &x).checked_div(&x).is_none());
}

/// Closed forms are evaluated directly, not as sums over lines.
#[test]
fn closed_forms_are_recorded_directly() {
    let site = Site { i: 1, j: 2, k: 5 };
    let contact = |pile: &Pile, site| {
        let forces = pile.forces::<Expression>();
        forces.contact(site, Direction::Alpha).unwrap().to_string()
    };
    let pile = Pile::triangular(10).unwrap();
    assert_eq!(contact(&pile, Site::APEX), "1 * 1");
    assert_eq!(contact(&pile, site), "3 * 1");
    let [above, ..] = pile.forces::<Expression>().from_above(site).unwrap();
    assert_eq!(above.to_string(), "2 * 1");
    // A load elsewhere adds no term, not even zero.
    let loaded = pile
        .with_load(Site { i: 0, j: 0, k: 7 }, ratio(1, 1))
        .unwrap();
    let [below, ..] = loaded.forces::<Expression>().to_below(site).unwrap();
    assert_eq!(below.to_string(), "2 * 1 + 1");
}
