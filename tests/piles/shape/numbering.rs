//! The numbers of spheres, compared with a plain count.

use cannonpile::lattice::{Region, Site};
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile};
use num_bigint::BigUint;
use num_rational::BigRational;

/// Straight piles, isosceles piles and discs, and any stacking on and under points, rows, triangles and hexagons.
fn piles() -> Vec<Pile> {
    let shape = |sides: [[i128; 2]; 3]| {
        let [x, y, s] = sides.map(|[from, to]| from..=to);
        Region::new(x, y, s).expect("a region")
    };
    let tops = [
        Region::SITE,
        Region::triangle(4).expect("a triangle"),
        Region::hexagon(3, 2).expect("a hexagon"),
        // A row, and a parallelogram away from the origin.
        shape([[-3, 2], [5, 5], [2, 7]]),
        shape([[4, 6], [-9, -7], [-5, -1]]),
    ];
    let mut piles = vec![Pile::isosceles(5, BigRational::new(2.into(), 5.into())).expect("a pile")];
    for layers in [1, 2, 7] {
        piles.push(Pile::triangular(layers).expect("a pile"));
        piles.push(Pile::discs(layers).expect("a pile"));
        for top in tops {
            for stacking in [
                Stacking::fcc(layers),
                Stacking::hcp(layers),
                Stacking::dhcp(layers),
            ] {
                let stacking = stacking.expect("a stacking");
                // Some bases do not support this many layers.
                piles.extend(Pile::on(top, stacking.clone()));
                piles.push(Pile::under(top, stacking).expect("a pile"));
            }
        }
    }
    piles
}

#[test]
fn numbers_count_the_spheres_in_order() {
    for pile in piles() {
        let numbering = pile.numbering().expect("numbers");
        let floor = pile.layers() - 1;
        let mut count = 0;
        for site in pile.shape().sites() {
            count += 1;
            assert_eq!(numbering.id(site), Ok(count), "{site}");
            assert_eq!(numbering.site(count), Some(site), "{count}");
            assert_eq!(count >= numbering.first_on_floor(), site.k == floor);
            let before = pile.shape().before(site).expect("a number");
            assert_eq!(before + 1_u32, BigUint::from(count));
        }
        assert_eq!(numbering.sphere_count(), count);
        for outside in [0, count + 1, u64::MAX] {
            assert_eq!(numbering.site(outside), None);
        }
    }
}

#[test]
fn the_limit_of_numbered_spheres() {
    // 8433 is the greatest number of layers with at most 10¹¹ spheres.
    let pile = Pile::triangular(8433).expect("a pile");
    let numbering = pile.numbering().expect("numbers");
    let last = Site {
        i: 0,
        j: 8432,
        k: 8432,
    };
    assert_eq!(numbering.id(last), Ok(numbering.sphere_count()));
    assert_eq!(numbering.site(numbering.sphere_count()), Some(last));
    let refused = Pile::triangular(8434).expect("a pile");
    assert!(matches!(refused.numbering(), Err(Error::TooLarge { .. })));
    let far = Pile::discs(10_i128.pow(36)).expect("a pile");
    assert!(far.numbering().is_err());
}

#[test]
fn a_site_of_another_pile_has_no_number() {
    let pile = Pile::triangular(4).expect("a pile");
    let outside = Site { i: 3, j: 3, k: 3 };
    assert!(matches!(
        pile.numbering().expect("numbers").id(outside),
        Err(Error::SiteOutside { .. })
    ));
}
