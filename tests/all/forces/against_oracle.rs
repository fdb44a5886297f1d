//! Every contact and every base sphere of every pile up to 12 layers, against the naive oracle.

use crate::support::answers::{Answers, Shape};

fn agrees(shape: &Shape) {
    for layers in 1..=12 {
        let library = Answers::of(shape, layers);
        let verdict = crate::support::theorems::agree(
            &library,
            &crate::support::oracles::elimination::solve(shape, layers),
        );
        assert_eq!(verdict, Ok(()), "{shape:?}, {layers} layers");
    }
}

#[test]
fn equilateral() {
    agrees(&Shape::equilateral());
}

#[test]
fn isosceles() {
    for shape in Shape::isosceles() {
        agrees(&shape);
    }
}

#[test]
fn discs() {
    agrees(&Shape::Discs);
}
