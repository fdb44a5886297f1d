//! Forces filled into slices are those that are asked for one by one.

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::shape::Selection;
use cannonpile::{Error, Packing, Pile, Strengths};
use num_rational::BigRational;

use crate::support::answers::ratio;

fn size(n: i128) -> usize {
    usize::try_from(n).expect("small")
}

/// The layers of one slice, row by row.
fn rows(layers: i128) -> impl Iterator<Item = (i128, i128)> {
    (0..layers - 1).flat_map(|k| (0..=k).map(move |j| (k, j)))
}

#[test]
fn nearest_floats_are_those_of_the_packing() {
    for (s, layers) in [(ratio(1, 2), 9), (ratio(2, 5), 7), (ratio(1, 2), 1)] {
        let pile = Pile::isosceles(layers, s).expect("a pile");
        let spacing = Spacing::new(ratio(6, 5)).expect("a spacing");
        let packing = Packing::new(&pile, &spacing).expect("room");
        let packing = packing.with_mass(ratio(1, 7)).expect("a mass");
        let doubles = Strengths::<f64>::nearest(&packing).expect("doubles");
        let singles = Strengths::<f32>::nearest(&packing).expect("singles");
        let spheres = doubles.spheres().expect("few");
        let mut slices = [(); 3].map(|()| vec![0.0_f64; spheres]);
        let [a, b, c] = slices.each_mut().map(Vec::as_mut_slice);
        doubles.fill([a, b, c]).expect("lengths");
        let mut three = vec![[0.0_f32; 3]; spheres];
        singles.fill_interleaved(&mut three).expect("lengths");
        let upper = pile.rows(Selection::All).expect("rows").off_the_floor();
        let mut met = 0;
        for (n, site) in upper.flatten().enumerate() {
            for direction in Direction::ALL {
                let exact = packing.contact(site, direction).expect("a contact");
                let line = direction.index();
                assert_eq!(Some(slices[line][n]), exact.nearest(), "{site} {direction}");
                assert_eq!(Some(three[n][line]), exact.nearest(), "{site} {direction}");
                met += 1;
            }
        }
        assert_eq!(met, 3 * spheres);
    }
}

#[test]
fn multiples_row_by_row_and_layer_by_layer() {
    let pile = Pile::triangular(12).expect("a pile");
    let statics = pile.statics::<BigRational>();
    let strengths = Strengths::<i32>::multiples(&pile).expect("small integers");
    for k in 0..11_i128 {
        let n = size((k + 1) * (k + 2) / 2);
        let mut layer = [(); 3].map(|()| vec![0; n]);
        let [a, b, c] = layer.each_mut().map(Vec::as_mut_slice);
        strengths.fill_layer(k, [a, b, c]).expect("lengths");
        let mut begun = 0;
        for (k, j) in rows(12).filter(|(layer, _)| *layer == k) {
            let length = size(k - j + 1);
            let mut row = [(); 3].map(|()| vec![0; length]);
            let [a, b, c] = row.each_mut().map(Vec::as_mut_slice);
            strengths.fill_row(k, j, [a, b, c]).expect("lengths");
            for (direction, row) in Direction::ALL.into_iter().zip(&row) {
                assert_eq!(row[..], layer[direction.index()][begun..begun + length]);
                for (i, force) in (0..).zip(row) {
                    let asked = statics
                        .contact(Site { i, j, k }, direction)
                        .expect("a contact");
                    assert_eq!(asked, BigRational::from_integer((*force).into()));
                }
            }
            begun += length;
        }
    }
}

#[test]
fn what_has_no_table_is_refused() {
    let three = || ratio(3, 1);
    let refused =
        |pile: Result<Pile, Error>| Strengths::<i64>::multiples(&pile.expect("a pile")).err();
    let straight = Pile::triangular(5).expect("a pile");
    let others = [
        Pile::discs(5),
        Pile::under(Region::SITE, "+-".parse().expect("signs")),
        straight.clone().with_load(Site::APEX, three()),
        Ok(straight.clone().weightless()),
    ];
    for pile in others {
        assert_eq!(refused(pile), Some(Error::NotStraight));
    }
    assert!(matches!(
        refused(Pile::isosceles(5, ratio(1, 3))),
        Some(Error::Overflow { .. })
    ));
    assert!(matches!(
        refused(Pile::triangular(10_i128.pow(20))),
        Some(Error::TooLarge { .. })
    ));
    assert!(Strengths::<i8>::multiples(&Pile::triangular(128).expect("a pile")).is_ok());
    assert!(Strengths::<i8>::multiples(&Pile::triangular(129).expect("a pile")).is_err());

    let strengths = Strengths::<i64>::multiples(&straight).expect("integers");
    let [mut a, mut b, mut c] = [[0; 3]; 3];
    let wrong = strengths.fill_row(2, 1, [&mut a, &mut b, &mut c]);
    assert_eq!(
        wrong,
        Err(Error::Length {
            needed: 2,
            given: 3
        })
    );
    let below = strengths.fill_row(4, 0, [&mut a, &mut b, &mut c]);
    assert_eq!(below, Err(Error::NoSuchRow { k: 4, j: 0 }));
    let beside = strengths.fill_row(2, 3, [&mut a, &mut b, &mut c]);
    assert_eq!(beside, Err(Error::NoSuchRow { k: 2, j: 3 }));
    assert!(strengths.fill_interleaved(&mut [[0; 3]; 19]).is_err());
    assert!(strengths.fill([&mut a, &mut b, &mut c]).is_err());
    assert!(strengths.fill_layer(1, [&mut a, &mut b, &mut c]).is_ok());
}

/// Under any top, up from any base, whichever way the layers lean.
#[test]
fn straight_piles_of_any_shape() {
    let region = |text: &str| text.parse::<Region>().expect("a region");
    let signs = |text: &str| text.parse().expect("signs");
    let mut met = 0;
    for (top, leaning) in [
        ("hexagon:1", "----"),
        ("hexagon:1", "+++++"),
        ("hexagon:3,2", "+++"),
        ("hexagon:4", "------"),
        ("triangle:3", "+++++"),
        ("triangle:3", "-----"),
        ("region:-3..2,0..1,-2..3", "++++"),
        ("region:0..9,0..0,0..9", "---"),
    ] {
        let pile = Pile::under(region(top), signs(leaning)).expect("a pile");
        met += check_shape(&pile);
    }
    for (base, leaning) in [("hexagon:5,4", "+++"), ("triangle:6", "+++++")] {
        let pile = Pile::on(region(base), signs(leaning)).expect("a pile");
        met += check_shape(&pile);
    }
    assert!(met > 400, "{met}");
}

/// Rows, layers and the whole against single questions; how many spheres there are.
fn check_shape(pile: &Pile) -> usize {
    let statics = pile.statics::<BigRational>();
    let strengths = Strengths::<i64>::multiples(pile).expect("integers");
    let spheres = strengths.spheres().expect("few");
    let mut whole = [(); 3].map(|()| vec![0; spheres]);
    let slices = whole.each_mut().map(Vec::as_mut_slice);
    strengths.fill(slices).expect("lengths");
    let mut three = vec![[0; 3]; spheres];
    strengths.fill_interleaved(&mut three).expect("lengths");
    let mut place = 0;
    for row in pile.rows(Selection::All).expect("rows").off_the_floor() {
        let (k, j) = (row.k, row.j);
        let mut alone = [(); 3].map(|()| vec![0; size(row.i.end - row.i.start)]);
        let slices = alone.each_mut().map(Vec::as_mut_slice);
        strengths.fill_row(k, j, slices).expect("lengths");
        for (n, i) in row.i.enumerate() {
            for direction in Direction::ALL {
                let site = Site { i, j, k };
                let asked = statics.contact(site, direction).expect("a contact");
                let line = direction.index();
                let found = [alone[line][n], whole[line][place], three[place][line]];
                assert_eq!(
                    found.map(|force| BigRational::from_integer(force.into())),
                    [(); 3].map(|()| asked.clone()),
                    "{site} {direction}"
                );
            }
            place += 1;
        }
        let beside = strengths.fill_row(k, j + 100, [&mut [], &mut [], &mut []]);
        assert_eq!(beside, Err(Error::NoSuchRow { k, j: j + 100 }));
    }
    assert_eq!(place, spheres);
    spheres
}
