//! Long computations end after a request, in every crate, and without a request they complete.

use std::thread;
use std::time::Duration;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Interrupt, Packing, Pile};
use cannonpile_dem::Error;
use cannonpile_dem::NumberedPile;
use cannonpile_dem::verify::Refusal;
use cannonpile_dem::verify::{Comparison, Measured};
use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
use cannonpile_stability::census;
use num_bigint::BigInt;
use num_rational::BigRational;

const INTERRUPTED: Error = Error::Core(cannonpile::Error::Interrupted);

fn half() -> BigRational {
    BigRational::new(1.into(), 2.into())
}

fn one() -> BigRational {
    BigRational::from_integer(1.into())
}

fn hcp(layers: i128) -> Pile {
    let stacking = Stacking::hcp(layers).expect("a stacking");
    Pile::under(Region::SITE, stacking).expect("a pile")
}

/// Extracts the error of the crate `cannonpile` from an error of random stackings.
fn of_core(error: cannonpile_disorder::Error) -> Error {
    match error {
        cannonpile_disorder::Error::Core(error) => error.into(),
        error => panic!("{error}"),
    }
}

/// Returns a column of zeros for each direction.
fn zeros<T: Clone + Default>(spheres: usize) -> [Vec<T>; 3] {
    [(); 3].map(|()| vec![T::default(); spheres])
}

/// Runs each long computation on a small pile.
fn work(pile: &Pile, name: &str) -> Result<(), Error> {
    let part = Selection::All;
    let packing = Packing::new(pile, &Spacing::new(one())?)?;
    let exact = pile.forces::<BigRational>();
    let last = pile.layers() - 1;
    let base = pile.shape().base();
    let bottom = Site {
        i: *base.x().start(),
        j: *base.y().end(),
        k: last,
    };
    let above = pile.rows(Selection::Layer(last - 1))?.flatten().last();
    let above = above.expect("a sphere");
    match name {
        "a force" => drop(exact.to_below(above)?),
        "floats" => {
            let layers = pile.forces::<f64>().layers(part)?;
            let mut columns = zeros(layers.slice_len()?);
            layers.fill(columns.each_mut().map(Vec::as_mut_slice))?;
        }
        "forces" => {
            let layers = packing.layers::<f64>(part)?;
            let mut columns = zeros(layers.slice_len()?);
            layers.fill(columns.each_mut().map(Vec::as_mut_slice))?;
        }
        "multiples" => {
            let layers = exact.layers(part)?.numerators::<BigInt>()?;
            let mut columns = zeros(layers.slice_len()?);
            layers.fill(columns.each_mut().map(Vec::as_mut_slice))?;
        }
        "contacts" => NumberedPile::new(&packing)?
            .contacts()?
            .try_for_each(|c| c.map(|_| ()))?,
        "standing" => drop(pile.standing()?),
        "extremes" => drop(pile.base_extremes()?),
        "elastic" => drop(cannonpile_horizontal::elastic(pile, &half())?),
        "bounds" => drop(cannonpile_horizontal::bounds(pile, bottom)?),
        "census" => census::under_one_sphere(6, true)?.try_for_each(|entry| entry.map(|_| ()))?,
        "horizontal census" => cannonpile_horizontal::census::under_one_sphere(6, true)?
            .try_for_each(|entry| entry.map(|_| ()))?,
        "mean" => {
            let stackings = RandomStackings::new(6, FirstSign::Plus).map_err(of_core)?;
            let mean = RandomPiles::under(Region::SITE, stackings).exact(&half());
            drop(mean.map_err(of_core)?);
        }
        "comparison" => {
            let measured = [Measured::new([1, 2], 0.4)];
            match Comparison::new(&packing, measured) {
                Ok(_) => {}
                Err(Refusal::Scene(error)) => return Err(error),
                Err(refusal) => panic!("{refusal}"),
            }
        }
        _ => panic!("{name}"),
    }
    Ok(())
}

const NAMES: [&str; 13] = [
    "a force",
    "floats",
    "forces",
    "multiples",
    "contacts",
    "standing",
    "extremes",
    "elastic",
    "bounds",
    "census",
    "horizontal census",
    "mean",
    "comparison",
];

#[test]
fn long_computations_end_only_after_a_request() {
    let pile = hcp(6);
    for name in NAMES {
        assert_eq!(work(&pile, name), Ok(()), "{name}");
        let interrupt = Interrupt::new();
        assert_eq!(interrupt.during(|| work(&pile, name)), Ok(()), "{name}");
        interrupt.request();
        let ended = interrupt.during(|| work(&pile, name));
        assert_eq!(ended, Err(INTERRUPTED), "{name}");
        // Afterwards the thread has no request, so the computation completes.
        assert_eq!(work(&pile, name), Ok(()), "{name}");
    }
}

#[test]
fn computations_on_straight_piles_end() {
    let pile = Pile::triangular(6).expect("a pile");
    for name in ["floats", "forces", "multiples"] {
        let interrupt = Interrupt::new();
        interrupt.request();
        let ended = interrupt.during(|| work(&pile, name));
        assert_eq!(ended, Err(INTERRUPTED), "{name}");
    }
}

#[test]
fn long_computations_in_several_threads_end() {
    // Each of these takes seconds in release and longer in debug, a hundred times the accepted delay.
    let wide = Region::hexagon(40, 40).expect("a region");
    let tall = Pile::under(wide, Stacking::hcp(1000).expect("a stacking")).expect("a pile");
    let straight = Pile::triangular(26).expect("a pile");
    let stackings = RandomStackings::new(200, FirstSign::Plus).expect("stackings");
    let mean = RandomPiles::under(Region::SITE, stackings);
    let works: [&(dyn Fn() -> Result<(), Error> + Sync); 3] = [
        &|| Ok(tall.base_extremes().map(|_| ())?),
        &|| {
            cannonpile_horizontal::base_bounds(&straight, Selection::Base)?
                .try_for_each(|bounds| Ok(bounds.map(|_| ())?))
        },
        &|| mean.exact(&half()).map(|_| ()).map_err(of_core),
    ];
    // If this thread sleeps too long, as on a loaded machine, the work ends before the request. Then it is repeated.
    let interrupted = |work: &(dyn Fn() -> Result<(), Error> + Sync), delay| {
        let interrupt = Interrupt::new();
        let ended = thread::scope(|scope| {
            let working = scope.spawn(|| interrupt.during(work));
            thread::sleep(Duration::from_millis(delay));
            interrupt.request();
            working.join().expect("no panic")
        });
        assert!([Ok(()), Err(INTERRUPTED)].contains(&ended), "{ended:?}");
        ended.is_err()
    };
    for (number, work) in works.into_iter().enumerate() {
        let is_interrupted = [30, 30, 10, 1]
            .iter()
            .any(|delay| interrupted(work, *delay));
        assert!(is_interrupted, "{number}");
    }
}

#[test]
fn a_request_ends_only_its_own_thread() {
    let (one, other) = (Interrupt::new(), Interrupt::new());
    one.request();
    // Only the inner request ends the inner computation.
    let answer = one.during(|| other.during(|| work(&hcp(6), "forces")));
    assert_eq!(answer, Ok(()));
    let answer = thread::scope(|scope| {
        let other = scope.spawn(|| work(&hcp(6), "forces"));
        let ended = one.during(|| work(&hcp(6), "forces"));
        (other.join().expect("no panic"), ended)
    });
    assert_eq!(answer, (Ok(()), Err(INTERRUPTED)));
}

#[test]
fn without_a_request_errors_are_unchanged() {
    let interrupt = Interrupt::new();
    assert!(!interrupt.is_requested());
    let refused = interrupt.during(|| Pile::triangular(0)).err();
    assert_eq!(refused, Some(cannonpile::Error::Layers { given: 0.into() }));
    interrupt.clone().request();
    assert!(interrupt.is_requested());
    let ended = interrupt.during(Interrupt::check);
    assert_eq!(ended, Err(cannonpile::Error::Interrupted));
    assert_eq!(Interrupt::check(), Ok(()));
}

/// With so many spheres several threads share the work, and each detects the request.
#[test]
fn a_fill_shared_by_threads_ends() {
    let pile = Pile::triangular(80).unwrap();
    let layers = pile.forces::<f64>().layers(Selection::All).unwrap();
    let n = layers.slice_len().unwrap();
    assert!(n > 1 << 16);
    let mut columns = [(); 3].map(|()| vec![0.0; n]);
    let interrupt = Interrupt::new();
    interrupt.request();
    let slices = columns.each_mut().map(Vec::as_mut_slice);
    assert_eq!(
        interrupt.during(|| layers.fill(slices)),
        Err(cannonpile::Error::Interrupted)
    );
}
