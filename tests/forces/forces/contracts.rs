//! Documented special cases: a single layer, and straight piles of − steps.

use cannonpile::Pile;
use cannonpile::lattice::Region;
use cannonpile::stacking::Stacking;
use num_rational::BigRational;

use cannonpile_testkit::cases::{repeated, stacking};
use cannonpile_testkit::oracles::balance::ratio;

fn under_one_sphere(signs: &str) -> Pile {
    Pile::under(Region::SITE, stacking(signs)).unwrap()
}

#[test]
fn a_single_layer_is_its_own_mirror_image() {
    let single = Stacking::single_layer();
    assert_eq!(single.mirrored(), single);
    let [pile, image] = [single.clone(), single.mirrored()].map(|s| Pile::under(Region::SITE, s));
    assert_eq!(pile, image);
}

#[test]
fn a_straight_minus_pile_matches_its_mirror_image() {
    let (plus, minus) = (repeated("+", 5), repeated("-", 5));
    let [plus, minus] = [plus, minus].map(|signs| under_one_sphere(&signs));
    for n in 0..7 {
        assert_eq!(
            minus.contact_count_of_strength(n),
            plus.contact_count_of_strength(n)
        );
    }
    assert_eq!(minus.base_extremes(), plus.base_extremes());
    let high = Stacking::fcc(10_i128.pow(30)).unwrap().mirrored();
    let high = Pile::under(Region::SITE, high).unwrap();
    let extremes = high.base_extremes().unwrap();
    let normal = BigRational::from_integer((high.layers() + 2).into()) * ratio(1, 3);
    assert_eq!(extremes.normal_min, normal);
    assert_eq!(extremes.normal_max, normal);
}
