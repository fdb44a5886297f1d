//! The forces in slices equal those of single queries.

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::{CorrectlyRounded, FixedRational};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Packing, Pile};
use num_bigint::BigInt;
use num_rational::BigRational;

use cannonpile_testkit::answers::ratio;

pub(super) fn packing_of(pile: &Pile) -> Packing<'_> {
    let spacing = Spacing::new(ratio(6, 5)).expect("a spacing");
    let packing = Packing::new(pile, &spacing).expect("a sweep within its limit");
    packing.with_mass(ratio(1, 7)).expect("a mass")
}

fn slices<V: Clone>(zero: &V, n: usize) -> [Vec<V>; 3] {
    [(); 3].map(|()| vec![zero.clone(); n])
}

pub(super) fn piles() -> Vec<Pile> {
    let region = |text: &str| text.parse::<Region>().expect("a region");
    let signs = |text: &str| text.parse().expect("signs");
    let load = |pile: Pile, site| pile.with_load(site, ratio(7, 3)).expect("a load");
    let mut piles: Vec<Pile> = [
        Pile::triangular(9),
        Pile::isosceles(7, ratio(2, 5)),
        Pile::triangular(1),
        Pile::discs(5),
        Ok(Pile::triangular(4).expect("a pile").weightless()),
    ]
    .map(|pile| pile.expect("a pile"))
    .into();
    piles.push(load(
        Pile::triangular(6).expect("a pile"),
        Site { i: 1, j: 1, k: 3 },
    ));
    // Under tops and on bases of every kind, with both signs first.
    for (top, signs_of) in [
        ("hexagon:1", "----"),
        ("hexagon:3,2", "+++"),
        ("hexagon:4", "------"),
        ("triangle:3", "+++++"),
        ("triangle:3", "-----"),
        ("region:-3..2,0..1,-2..3", "++++"),
        ("region:0..9,0..0,0..9", "---"),
        ("hexagon:2", "+-+--+"),
    ] {
        piles.push(Pile::under(region(top), signs(signs_of)).expect("a pile"));
    }
    let swept = Pile::under(Region::SITE, signs("++-+-")).expect("a pile");
    piles.push(load(swept, Site { i: 0, j: 0, k: 2 }));
    for (base, signs_of) in [
        ("hexagon:5,4", "+++"),
        ("triangle:6", "+++++"),
        ("hexagon:5", "+-+"),
    ] {
        piles.push(Pile::on(region(base), signs(signs_of)).expect("a pile"));
    }
    piles
}

/// The contact forces of every sphere by direction. Discs have 0 along γ.
fn one_by_one<V>(
    pile: &Pile,
    force: impl Fn(Site, Direction) -> V,
    none: impl Fn() -> V,
) -> Vec<[V; 3]> {
    let directions = pile.dimension().directions();
    let sites = pile.rows(Selection::All).expect("rows").off_the_floor();
    let forces = sites.flatten().map(|site| {
        Direction::ALL.map(|direction| {
            if directions.contains(&direction) {
                force(site, direction)
            } else {
                none()
            }
        })
    });
    forces.collect()
}

fn transposed<V: Clone>([a, b, c]: &[Vec<V>; 3]) -> Vec<[V; 3]> {
    let forces = a.iter().zip(b).zip(c);
    forces
        .map(|((a, b), c)| [a.clone(), b.clone(), c.clone()])
        .collect()
}

fn rounded_layers_equal_the_packing<F: CorrectlyRounded + PartialEq + core::fmt::Debug>(zero: F) {
    for pile in piles() {
        let packing = packing_of(&pile);
        let single = one_by_one(
            &pile,
            |site, direction| {
                let exact = packing.contact(site, direction).expect("a contact");
                exact.nearest::<F>().expect("a float")
            },
            || zero,
        );
        let layers = packing.layers::<F>(Selection::All).expect("layers");
        let mut whole = slices(&zero, layers.slice_len().expect("few"));
        layers
            .fill(whole.each_mut().map(Vec::as_mut_slice))
            .expect("lengths");
        assert_eq!(transposed(&whole), single, "{pile:?}");

        let mut layers = packing.layers::<F>(Selection::All).expect("layers");
        let mut by_layer = Vec::new();
        while let Some(layer) = layers.next_layer().expect("a sweep within its limit") {
            let mut forces = slices(&zero, layer.sphere_count());
            let filled = forces.each_mut().map(Vec::as_mut_slice);
            if !layer.is_floor() {
                layer.fill(filled).expect("lengths");
                by_layer.extend(transposed(&forces));
                continue;
            }
            layer.fill_base(filled).expect("lengths");
            let base = packing.base(Selection::Base).expect("a base");
            for (force, [normal, x, y]) in base.zip(transposed(&forces)) {
                let force = force.expect("a force");
                let exact = [force.normal, force.shear_x, force.shear_y];
                let nearest = exact.map(|exact| exact.nearest::<F>().expect("a float"));
                assert_eq!(nearest, [normal, x, y], "{pile:?}");
            }
        }
        assert_eq!(by_layer, single, "{pile:?}");
    }
}

#[test]
fn nearest_doubles_equal_the_packing() {
    rounded_layers_equal_the_packing(0.0_f64);
}

#[test]
fn nearest_singles_equal_the_packing() {
    rounded_layers_equal_the_packing(0.0_f32);
}

#[test]
fn numerators_are_exact() {
    let mut compared = 0;
    for pile in piles() {
        let forces = pile.forces::<BigRational>();
        let contact = |site, direction| forces.contact(site, direction).expect("a contact");
        let single = one_by_one(&pile, contact, || ratio(0, 1));
        let over = |numerators: &[Vec<i64>; 3], denominator: &BigInt| -> Vec<[BigRational; 3]> {
            let of = |n: i64| BigRational::new(n.into(), denominator.clone());
            let forces = transposed(numerators).into_iter();
            forces.map(|forces| forces.map(of)).collect()
        };
        let layers = || {
            forces
                .layers(Selection::All)
                .expect("layers")
                .numerators::<i64>()
        };
        let whole = layers().expect("integers");
        let mut integers = slices(&0, whole.slice_len().expect("few"));
        let filled = whole.fill(integers.each_mut().map(Vec::as_mut_slice));
        assert_eq!(over(&integers, &filled.expect("lengths")), single);

        let mut layers = layers().expect("integers");
        let mut by_layer = Vec::new();
        while let Some(layer) = layers.next_layer().expect("a sweep within its limit") {
            if layer.is_floor() {
                break;
            }
            let mut integers = slices(&0, layer.sphere_count());
            layer
                .fill(integers.each_mut().map(Vec::as_mut_slice))
                .expect("lengths");
            by_layer.extend(over(&integers, &layer.denominator()));
        }
        assert_eq!(by_layer, single);
        compared += single.len();
    }
    assert!(compared > 600, "{compared}");
}

#[test]
fn slices_of_a_wrong_length_are_rejected() {
    let layers = |pile: &Pile| {
        let layers = pile.forces::<BigRational>().layers(Selection::All);
        layers.expect("layers").numerators::<i8>().err()
    };
    let pile = |layers| Pile::triangular(layers).expect("a pile");
    assert_eq!(layers(&pile(128)), None);
    assert!(matches!(layers(&pile(129)), Some(Error::Overflow { .. })));

    let pile = Pile::triangular(5).expect("a pile");
    let forces = pile.forces::<f64>();
    let mut layers = forces.layers(Selection::Layer(1)).expect("a layer");
    let layer = layers
        .next_layer()
        .expect("a sweep within its limit")
        .expect("a layer");
    let [mut a, mut b, mut c] = [[0.0; 3]; 3];
    assert_eq!(layer.fill([&mut a, &mut b, &mut c]), Ok(()));
    let wrong = layer.fill([&mut a, &mut b, &mut [0.0; 2]]);
    assert_eq!(
        wrong,
        Err(Error::Length {
            needed: 3,
            given: 2
        })
    );
    let whole = forces.layers(Selection::All).expect("layers");
    let needed = whole.slice_len().expect("few");
    let wrong = whole.fill([&mut a, &mut b, &mut c]);
    assert_eq!(wrong, Err(Error::Length { needed, given: 3 }));
    let floor = forces.layers(Selection::Base).expect("a base").slice_len();
    assert_eq!(floor, Ok(0));
}

/// The forces are small but their denominators are not. 32-bit fractions cannot represent 3²¹, so layers below that many
/// sign changes are rejected. The layers above are filled.
#[test]
fn small_forces_with_long_denominators_are_rejected() {
    type Fraction = FixedRational<i32>;
    let pile = Pile::under(Region::SITE, Stacking::hcp(24).expect("layers")).expect("a pile");
    let (fractions, exact) = (pile.forces::<Fraction>(), pile.forces::<BigRational>());
    let mut layers = fractions.layers(Selection::All).expect("layers");
    let (mut filled, mut refused) = (0, 0);
    while let Some(layer) = layers.next_layer().expect("a sweep within its limit") {
        if layer.is_floor() {
            break;
        }
        let mut forces = slices(&Fraction::FAULT, layer.sphere_count());
        match layer.fill(forces.each_mut().map(Vec::as_mut_slice)) {
            Ok(()) => {
                let contacts = exact
                    .contacts(Selection::Layer(layer.k()))
                    .expect("a layer");
                let contacts = contacts.map(|contact| contact.expect("a contact").force);
                let forces = transposed(&forces).into_iter().flatten();
                let forces = forces.map(|force| force.to_rational().expect("no fault"));
                assert!(contacts.eq(forces), "{}", layer.k());
                filled += 1;
            }
            Err(error) => {
                assert!(matches!(error, Error::Overflow { .. }), "{error:?}");
                refused += 1;
            }
        }
    }
    assert!(filled > 9 && refused > 2, "{filled} {refused}");
}

#[test]
fn the_bottom_layer_fills_the_forces_on_the_floor() {
    for pile in piles() {
        let forces = pile.forces::<BigRational>();
        let mut layers = forces.layers(Selection::Base).expect("a base");
        let layer = layers
            .next_layer()
            .expect("a sweep within its limit")
            .expect("a floor");
        let zero = ratio(0, 1);
        let mut filled = slices(&zero, layer.sphere_count());
        let done = layer.fill_base(filled.each_mut().map(Vec::as_mut_slice));
        assert_eq!(done, Ok(()));
        let base = forces.base(Selection::Base).expect("a base");
        let single: Vec<_> = base
            .map(|force| force.expect("a force"))
            .map(|force| [force.normal, force.shear_x, force.shear_y])
            .collect();
        assert_eq!(transposed(&filled), single, "{pile:?}");
    }
}

#[test]
fn layers_reject_sites_of_other_layers() {
    let pile = Pile::triangular(5).expect("a pile");
    let (site, floor) = (Site { i: 1, j: 0, k: 2 }, 4);
    let forces = pile.forces::<BigRational>();
    let refused = Err(Error::NotOnFloor { site, floor });
    let mut layers = forces.layers(Selection::Layer(2)).expect("a layer");
    let layer = layers
        .next_layer()
        .expect("a sweep within its limit")
        .expect("a layer");
    assert_eq!(layer.on_floor(site).map(drop), refused);
    let bottom = Site { i: 1, j: 0, k: 4 };
    assert!(matches!(
        layer.to_below(bottom),
        Err(Error::OtherLayer {
            layer: 4,
            at: 2,
            ..
        })
    ));

    let first = Site { i: 0, j: 0, k: 2 };
    let refused = Err(Error::NotOnFloor { site: first, floor });
    let layers = forces.layers(Selection::Layer(2)).expect("a layer");
    let mut layers = layers.nearest::<f64>().expect("floats");
    let layer = layers
        .next_layer()
        .expect("a sweep within its limit")
        .expect("a layer");
    let [mut a, mut b, mut c] = [[0.0; 6]; 3];
    assert_eq!(layer.fill_base([&mut a, &mut b, &mut c]), refused);
}

/// This includes a layer whose next index would overflow.
#[test]
fn nonexistent_layers_are_rejected() {
    let pile = Pile::triangular(3).expect("a pile");
    let packing = packing_of(&pile);
    let (floats, exact) = (pile.forces::<f64>(), pile.forces::<BigRational>());
    for k in [-1, 3, i128::MIN, i128::MAX] {
        let part = Selection::Layer(k);
        for refused in [
            floats.layers(part).err(),
            packing.layers::<f64>(part).err(),
            exact.sum_of_contacts(part).err(),
        ] {
            assert!(
                matches!(refused, Some(Error::LayerOutside { .. })),
                "{k}: {refused:?}"
            );
        }
        let one = Selection::One(Site { i: 0, j: 0, k });
        let refused = floats.layers(one).err();
        assert!(matches!(refused, Some(Error::SiteOutside { .. })), "{k}");
    }
}

/// The debug output of an iterator and of a layer states the current position.
#[test]
fn debug_output_states_the_position() {
    let pile = Pile::triangular(5).expect("a pile");
    let forces = pile.forces::<BigRational>();
    let layers = || forces.layers(Selection::All).expect("layers");
    let mut of_all = layers();
    assert_eq!(format!("{of_all:?}"), "Layers { ahead: 0..5, .. }");
    let layer = of_all.next_layer().expect("a sweep within its limit");
    assert_eq!(format!("{layer:?}"), "Some(Layer { k: 0, .. })");
    assert_eq!(format!("{of_all:?}"), "Layers { ahead: 1..5, .. }");
    let mut nearest = layers().nearest::<f32>().expect("floats");
    assert_eq!(format!("{nearest:?}"), "Layers { ahead: 0..5, .. }");
    let layer = nearest.next_layer().expect("a sweep within its limit");
    assert_eq!(format!("{layer:?}"), "Some(Layer { k: 0, .. })");
    let mut integers = layers().numerators::<i64>().expect("integers");
    assert_eq!(format!("{integers:?}"), "Layers { ahead: 0..5, .. }");
    let layer = integers.next_layer().expect("a sweep within its limit");
    assert_eq!(format!("{layer:?}"), "Some(Layer { k: 0, .. })");
}
