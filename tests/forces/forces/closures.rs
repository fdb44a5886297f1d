//! The closures of the stress (theorems `primary-closure`, `secondary-closure` and `mean-closure`), in all stackings of up
//! to seven layers and on 10⁵ spheres of random piles, in fractions.

use std::collections::BTreeMap;

use cannonpile::geometry::Load;
use cannonpile::lattice::{Region, Sign, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile, ratio};
use num_rational::BigRational;
use num_traits::Zero;

type Stress = [BigRational; 6];

/// Returns whether σ_xx + σ_yy = tan²θ σ_zz, in the units of `Forces::stress`.
fn is_primary([xx, yy, zz, ..]: &Stress) -> bool {
    xx + yy == *zz
}

/// Returns whether 2(σ_xx − σ_yy) = −n tanθ σ_xz and 4σ_xy = n tanθ σ_yz, for the sum n of two signs.
fn is_secondary([xx, yy, _, xy, xz, yz]: &Stress, n: i32) -> bool {
    let n = BigRational::from_integer(n.into());
    ratio!(2) * (xx - yy) == -&n * xz && ratio!(4) * xy == n * yz
}

/// Returns the sum of the signs of the steps above and below each layer, by layer. At the ends it is twice the one sign.
fn sums_of_signs(signs: &[Sign]) -> Vec<i32> {
    let factor = |k: usize| signs.get(k).map(|sign| sign.factor());
    let sums = (0..=signs.len()).map(|k| {
        let (above, below) = (k.checked_sub(1).and_then(factor), factor(k));
        above.or(below).unwrap_or(0) + below.or(above).unwrap_or(0)
    });
    sums.collect()
}

/// Calls a function with the sum of the signs and the stress of each sphere. Returns the number of spheres.
fn each_sphere(pile: &Pile, signs: &[Sign], check: impl Fn(i32, &Stress)) -> Result<usize, Error> {
    let sums = sums_of_signs(signs);
    let stresses = pile.forces::<BigRational>().stresses(Selection::All)?;
    let mut spheres = 0;
    for (site, stress) in pile.sites(Selection::All)?.zip(stresses) {
        check(sums[usize::try_from(site.k).expect("a layer")], &stress?);
        spheres += 1;
    }
    Ok(spheres)
}

/// All sequences of `steps` signs.
fn sequences(steps: u32) -> impl Iterator<Item = Vec<Sign>> {
    let sign = |bits: u32, n: u32| [Sign::Plus, Sign::Minus][(bits >> n & 1) as usize];
    (0..1 << steps).map(move |bits| (0..steps).map(|n| sign(bits, n)).collect())
}

fn under(top: Region, signs: &[Sign]) -> Result<Pile, Error> {
    Pile::under(top, Stacking::from_signs(signs.iter().copied())?)
}

/// Weights, loads and a tilt change neither closure; a horizontal load breaks the second one at a sign change alone.
#[test]
fn all_stackings_obey_both_closures() -> Result<(), Error> {
    for steps in 1..=6 {
        for signs in sequences(steps) {
            for top in [Region::SITE, Region::hexagon(1, 1)?] {
                let pile = under(top, &signs)?;
                let loaded = pile.clone().with_load(Site::APEX, ratio!(7 / 2))?;
                for pile in [&pile, &loaded] {
                    each_sphere(pile, &signs, |sum, stress| {
                        assert!(is_primary(stress), "{signs:?}: {stress:?}");
                        assert!(is_secondary(stress, sum), "{signs:?}: {stress:?}");
                    })?;
                }
                let leaning = loaded.with_tilt([ratio!(1 / 5), ratio!(-1 / 7)])?;
                each_sphere(&leaning, &signs, |sum, stress| {
                    assert!(is_primary(stress), "{signs:?}: {stress:?}");
                    assert_eq!(is_secondary(stress, sum), sum != 0, "{signs:?}: {stress:?}");
                })?;
            }
        }
    }
    Ok(())
}

/// The closures hold with their signs only: each sphere with a shear refutes the opposite one.
#[test]
fn wrong_signs_are_refused() -> Result<(), Error> {
    let signs = [Sign::Minus; 5];
    each_sphere(&under(Region::SITE, &signs)?, &signs, |sum, stress| {
        let [xx, yy, zz, xy, xz, yz] = stress.clone();
        let has_shear = !(xz.is_zero() && yz.is_zero());
        assert_eq!(is_secondary(stress, -sum), !has_shear, "{stress:?}");
        let difference = [
            xx.clone(),
            -yy.clone(),
            zz.clone(),
            xy.clone(),
            xz.clone(),
            yz.clone(),
        ];
        assert_eq!(is_primary(&difference), yy.is_zero(), "{stress:?}");
        assert_eq!(
            is_secondary(&[xx, yy, zz, -xy.clone(), xz, yz], sum),
            xy.is_zero()
        );
    })?;
    Ok(())
}

#[test]
fn isosceles_piles_and_discs_obey_them() -> Result<(), Error> {
    let tilt = || [ratio!(1 / 8), ratio!(1 / 9)];
    for s in [ratio!(1 / 10), ratio!(1 / 3), ratio!(1 / 2), ratio!(4 / 5)] {
        let pile = Pile::isosceles(8, s.clone())?;
        let load = Load {
            down: ratio!(2),
            x: ratio!(1 / 3),
            y: ratio!(-1 / 4),
        };
        for pile in [
            pile.clone(),
            pile.with_tilt(tilt())?
                .with_load(Site::new(1, 1, 3), load)?,
        ] {
            each_sphere(&pile, &[Sign::Plus; 7], |_, stress| {
                let [xx, _, zz, xy, xz, yz] = stress;
                assert!(is_primary(stress), "{s}: {stress:?}");
                assert_eq!(*xx, &s * zz - (ratio!(1) - &s) * xz, "{s}: {stress:?}");
                assert_eq!(*xy, &s * yz, "{s}: {stress:?}");
            })?;
        }
    }
    each_sphere(
        &Pile::discs(9)?.with_load(Site::new(1, 0, 2), ratio!(3))?,
        &[Sign::Plus; 8],
        |_, stress| {
            let [xx, yy, zz, xy, _, yz] = stress;
            assert_eq!(
                [xx, yy, xy, yz],
                [
                    zz,
                    &BigRational::zero(),
                    &BigRational::zero(),
                    &BigRational::zero()
                ]
            );
        },
    )?;
    Ok(())
}

#[test]
fn random_piles_obey_the_primary_closure() -> Result<(), Error> {
    let (mut spheres, mut seed) = (0, 1_u64);
    let mut next = |n: u64| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % n
    };
    while spheres < 100_000 {
        let signs: Vec<_> = (0..12)
            .map(|_| [Sign::Plus, Sign::Minus][usize::from(next(2) == 1)])
            .collect();
        let mut pile = under(Region::hexagon(3, 1 + i128::from(next(4)))?, &signs)?;
        for _ in 0..3 {
            let [down, x, y] =
                [(); 3].map(|()| BigRational::new((i128::from(next(19))).into(), 7.into()));
            let [x, y] = [x - ratio!(1), y - ratio!(2)];
            pile = pile.with_load(Site::new(0, 0, i128::from(next(12))), Load { down, x, y })?;
        }
        spheres += each_sphere(&pile, &signs, |_, stress| {
            assert!(is_primary(stress), "{stress:?}");
        })?;
    }
    Ok(())
}

/// The contacts below each place, in the mean over all stackings: the sums of f ê_x², f ê_y² and f ê_x ê_y.
#[test]
fn mean_below_each_place_is_isotropic() -> Result<(), Error> {
    for steps in 1..=6 {
        let mut sums: BTreeMap<[i128; 3], [BigRational; 3]> = BTreeMap::new();
        for signs in sequences(steps) {
            let pile = under(Region::SITE, &signs)?.with_load(
                Site::APEX,
                Load {
                    down: ratio!(3),
                    x: ratio!(1),
                    y: ratio!(1 / 2),
                },
            )?;
            let along = pile.directions::<BigRational>();
            for contact in pile.forces::<BigRational>().contacts(Selection::All)? {
                let contact = contact?;
                // Three times the place of a sphere: each step shifts site (0, 0) by a third of (1, 1) against its sign.
                let k = usize::try_from(contact.site.k).expect("a layer");
                let shift: i128 = signs[..k]
                    .iter()
                    .map(|sign| i128::from(sign.factor()))
                    .sum();
                let place = [
                    contact.site.k,
                    3 * contact.site.i - shift,
                    3 * contact.site.j - shift,
                ];
                // − turns the directions by 180°, which keeps these products.
                let e = &along[contact.direction.index()];
                let products = [&e.x * &e.x, ratio!(3) * &e.y * &e.y, &e.x * &e.y];
                let sums = sums
                    .entry(place)
                    .or_insert_with(|| [(); 3].map(|()| BigRational::zero()));
                for (sum, product) in sums.iter_mut().zip(products) {
                    *sum += product * &contact.force;
                }
            }
        }
        for (place, [xx, yy, xy]) in sums {
            assert_eq!(
                (&xx - &yy, xy),
                (BigRational::zero(), BigRational::zero()),
                "{steps} {place:?}"
            );
        }
    }
    Ok(())
}
