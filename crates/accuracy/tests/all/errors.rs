//! Residuals and errors of computed forces: none for exact forces, and a changed force is found at its sphere.

use cannonpile::lattice::{Axis, HorizontalContact, Region, Site};
use cannonpile::num_rational::BigRational;
use cannonpile::num_traits::Zero;
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;
use cannonpile::{Error, Load, Pile, ratio};
use cannonpile_accuracy::{Stochastic, layer_errors, residuals, stochastic_forces};

type Forces = [Vec<BigRational>; 3];

fn piles() -> Vec<Pile> {
    let under = |top, stacking: &str| Pile::under(top, stacking.parse().unwrap()).unwrap();
    let load = Load {
        down: ratio!(3 / 7),
        x: ratio!(-1 / 5),
        y: ratio!(2),
    };
    let contact = HorizontalContact {
        site: Site::new(0, 0, 2),
        axis: Axis::AlphaBeta,
    };
    vec![
        Pile::triangular(5).unwrap(),
        Pile::triangular(4).unwrap().weightless(),
        Pile::discs(5).unwrap(),
        Pile::isosceles(4, ratio!(2 / 5)).unwrap(),
        under(Region::hexagon(2, 2).unwrap(), "+-+--"),
        under(Region::triangle(2).unwrap(), "-+--+")
            .with_load(Site::new(0, 0, 1), load)
            .unwrap()
            .with_tilt([ratio!(1 / 11), ratio!(-1 / 3)])
            .unwrap()
            .with_weight(Site::new(1, 0, 1), ratio!(5 / 2))
            .unwrap(),
        under(Region::SITE, "+-+-")
            .with_horizontal_force(contact, ratio!(1 / 3))
            .unwrap(),
        under(Region::SITE, "++--")
            .with_horizontal_force(contact, ratio!(2))
            .unwrap(),
    ]
}

/// Returns the contact forces below all layers with supports, as rationals.
fn forces<T: Algebra>(pile: &Pile, exactly: impl Fn(&T) -> BigRational) -> Vec<Forces> {
    let forces = pile.forces::<T>();
    let mut layers = forces.layers(Selection::All).unwrap();
    let mut all = Vec::new();
    while let Some(layer) = layers
        .next_layer()
        .unwrap()
        .filter(|layer| !layer.is_floor())
    {
        let mut slices = [(); 3].map(|()| vec![T::zero(); layer.sphere_count()]);
        layer
            .fill(slices.each_mut().map(|slice| &mut slice[..]))
            .unwrap();
        all.push(slices.map(|line| line.iter().map(&exactly).collect()));
    }
    all
}

fn slices(forces: &Forces) -> [&[BigRational]; 3] {
    forces.each_ref().map(|line| &line[..])
}

/// Returns the residuals of all layers.
fn all_residuals(pile: &Pile, all: &[Forces]) -> Vec<Vec<[BigRational; 3]>> {
    let layers = (0..).zip(all);
    let of = |(k, below)| {
        let above = usize::try_from(k - 1).map_or([&[][..]; 3], |upper| slices(&all[upper]));
        residuals(pile, k, above, slices(below)).unwrap()
    };
    layers.map(of).collect()
}

#[test]
fn exact_forces_have_no_residual() {
    for pile in piles() {
        let mut all = forces(&pile, BigRational::clone);
        let found = all_residuals(&pile, &all);
        assert!(
            found.iter().flatten().flatten().all(Zero::is_zero),
            "{pile}"
        );
        // A planted fault: one force that is larger by 2⁻⁵⁰ disturbs its sphere and the one below.
        let little = BigRational::new(1.into(), (1_i64 << 50).into());
        all[1][1][0] += &little;
        let found = all_residuals(&pile, &all);
        assert_eq!(found[1][0][1], little);
        let spheres = |k: usize| {
            found[k]
                .iter()
                .filter(|sphere| !sphere.iter().all(Zero::is_zero))
                .count()
        };
        assert_eq!((spheres(0), spheres(1), spheres(2)), (0, 1, 1), "{pile}");
    }
}

/// e = S e + δ, where the errors e are the forces of a pile without weight under the loads δ.
#[test]
fn errors_are_the_sum_of_residuals_carried_down() {
    let pile = Pile::under(Region::hexagon(2, 2).unwrap(), "+-+--+-".parse().unwrap()).unwrap();
    let computed = forces(&pile, |x: &f32| BigRational::from_float(*x).unwrap());
    let errors: Vec<Forces> = computed
        .iter()
        .zip(forces(&pile, BigRational::clone))
        .map(|(got, want)| {
            [0, 1, 2].map(|line| {
                got[line]
                    .iter()
                    .zip(&want[line])
                    .map(|(a, b)| a - b)
                    .collect()
            })
        })
        .collect();
    let weightless = pile.clone().weightless();
    assert_eq!(
        all_residuals(&weightless, &errors),
        all_residuals(&pile, &computed)
    );
}

#[test]
fn floats_are_backward_stable() {
    for pile in piles().into_iter().filter(|pile| !pile.is_weightless()) {
        let found = layer_errors(&pile.forces::<f32>(), |x| BigRational::from_float(*x)).unwrap();
        let unit = 2.0_f64.powi(-24);
        assert_eq!(found.len(), usize::try_from(pile.layers() - 1).unwrap());
        for layer in found {
            assert!(layer.backward < 5.0 * unit, "{pile}: {layer:?}");
            assert!(
                layer.worst_case.is_none_or(|bound| layer.forward <= bound),
                "{pile}: {layer:?}"
            );
        }
        let exact = layer_errors(&pile.forces::<BigRational>(), |x| Some(x.clone())).unwrap();
        assert!(
            exact
                .iter()
                .all(|layer| layer.backward == 0.0 && layer.forward == 0.0)
        );
    }
}

#[test]
fn stochastic_rounding_is_backward_stable() {
    let pile = Pile::under(Region::hexagon(2, 2).unwrap(), "+-+--+-".parse().unwrap()).unwrap();
    let forces = stochastic_forces::<11>(&pile, 1).unwrap();
    let found = layer_errors(&forces, |x: &Stochastic<11>| {
        BigRational::from_float(x.value())
    })
    .unwrap();
    let largest = found
        .iter()
        .fold(0.0, |most: f64, layer| most.max(layer.backward));
    let unit = 2.0_f64.powi(-11);
    assert!((unit..8.0 * unit).contains(&largest), "{largest}");
}

#[test]
fn wrong_questions_are_refused() {
    let pile = Pile::triangular(3).unwrap();
    let one = [ratio!(1)];
    let refused = residuals(&pile, 0, [&[]; 3], [&one, &one, &[]]);
    assert_eq!(
        refused,
        Err(Error::Length {
            needed: 1,
            given: 0
        })
    );
    let empty: [&[f64]; 3] = [&[]; 3];
    assert!(residuals(&pile, 1, empty, [&[1.0; 3]; 3]).is_err());
    assert!(matches!(
        residuals(&pile, 2, empty, [&[1.0; 6]; 3]),
        Err(Error::OnFloor { .. })
    ));
    assert!(residuals(&pile, 3, empty, empty).is_err());
    assert!(residuals(&pile, -1, empty, empty).is_err());
    let overflow = layer_errors(&pile.forces::<f64>(), |_| None);
    assert!(matches!(overflow, Err(Error::Overflow { .. })));
}
