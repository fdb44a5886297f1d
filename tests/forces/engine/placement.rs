//! Every engine puts each force in its place: it has the coefficient of every load, at the right contact.
//!
//! A force is a linear form in the loads. So each load is a power of B = 2^20, and a force has one digit for each load: its
//! coefficient. Gravity is the load 1, and the components of its tilt are B and B². One run of an exact engine then shows
//! all coefficients. In scalars of a fixed width, one load at a time is applied, and the results are whole numbers.
//!
//! `crates/proof/scripts/placement.py` applies the same loads on the command line, which calls [`Forces::contacts`] and
//! [`Forces::base`]. Coq checks these digits, for all loads. Here the other engines are compared with these calls.

use cannonpile::lattice::{Direction, Sign, Site};
use cannonpile::scalar::{Algebra, DoubleDouble, FixedRational, Polynomial, Ring, Symbol};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{ContactForce, Error, FloorForce, Forces, Layers, Load, Method, Pile};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// `Ok`, or the name of the call with a wrong force.
type Placed = Result<(), String>;

/// The bits of a digit.
const BITS: usize = 20;

fn power(n: usize) -> BigRational {
    (BigInt::one() << (BITS * n)).into()
}

/// The load down, along x or along y.
fn along(axis: usize, value: BigRational) -> Load {
    let mut parts = [(); 3].map(|()| BigRational::zero());
    parts[axis] = value;
    let [down, x, y] = parts;
    Load { down, x, y }
}

/// All stackings of up to `layers` layers, in Hägg notation.
fn stackings(layers: usize) -> impl Iterator<Item = String> {
    (0..layers).flat_map(|steps| {
        (0..1_u32 << steps).map(move |bits| {
            let sign = |step| if bits >> step & 1 == 0 { '+' } else { '-' };
            (0..steps).map(sign).collect()
        })
    })
}

fn under(top: &str, signs: &str) -> Pile {
    let sign = |sign| if sign == '+' { Sign::Plus } else { Sign::Minus };
    let stacking = Stacking::from_signs(signs.chars().map(sign)).unwrap();
    Pile::under(top.parse().unwrap(), stacking).unwrap()
}

/// The pile under all loads, each a power of B.
fn loaded(pile: &Pile) -> Pile {
    let tilted = pile.clone().with_tilt([power(1), power(2)]).unwrap();
    let sites = pile.shape().sites().enumerate();
    sites.fold(tilted, |pile, (n, site)| {
        let [down, x, y] = [3, 4, 5].map(|axis| power(axis + 3 * n));
        pile.with_load(site, Load { down, x, y }).unwrap()
    })
}

/// The forces of a pile, in the order of [`Forces::contacts`] and [`Forces::base`].
#[derive(Clone, Debug, PartialEq)]
struct Known<T: Ring> {
    contacts: Vec<ContactForce<T>>,
    floor: Vec<FloorForce<T>>,
}

fn all<A>(answers: Result<impl Iterator<Item = Result<A, Error>>, Error>) -> Vec<A> {
    answers.unwrap().collect::<Result<_, _>>().unwrap()
}

impl<T: Algebra + PartialEq> Known<T> {
    fn of(forces: &Forces<'_, T>) -> Self {
        Self {
            contacts: all(forces.contacts(Selection::All)),
            floor: all(forces.base(Selection::Base)),
        }
    }

    fn map<U: Ring>(&self, mut f: impl FnMut(&T) -> U) -> Known<U> {
        let contacts = self.contacts.iter().map(|contact| ContactForce {
            site: contact.site,
            direction: contact.direction,
            force: f(&contact.force),
        });
        Known {
            contacts: contacts.collect(),
            floor: self
                .floor
                .iter()
                .map(|on| on.clone().map(|part| f(&part)))
                .collect(),
        }
    }

    fn at(&self, site: Site, direction: Direction) -> Option<&T> {
        let mut contacts = self.contacts.iter();
        let found = contacts.find(|of| (of.site, of.direction) == (site, direction));
        found.map(|contact| &contact.force)
    }

    /// The forces below the spheres of layers, by direction.
    fn slices(&self, of: impl Fn(i128) -> bool) -> [Vec<T>; 3] {
        Direction::ALL.map(|direction| {
            let contacts = self.contacts.iter();
            let here = contacts.filter(|at| at.direction == direction && of(at.site.k));
            here.map(|contact| contact.force.clone()).collect()
        })
    }

    fn floor_slices(&self) -> [Vec<T>; 3] {
        let of = |part: fn(&FloorForce<T>) -> &T| self.floor.iter().map(part).cloned().collect();
        [
            of(|on| &on.normal),
            of(|on| &on.shear_x),
            of(|on| &on.shear_y),
        ]
    }
}

impl Known<BigRational> {
    /// The coefficients of load `n` of [`loaded`], times `scale`.
    fn digits(&self, n: usize, pile: &Pile, scale: &BigInt) -> Self {
        let loads = 3 * (1 + pile.shape().sites().count());
        let half = BigInt::one() << (BITS - 1);
        let halves: BigInt = (0..loads).map(|n| &half << (BITS * n)).sum();
        self.map(|force| {
            let scaled = force * scale;
            assert!(scaled.is_integer(), "another denominator");
            let digit: BigInt = ((scaled.to_integer() + &halves) >> (BITS * n)) & (&half * 2 - 1);
            BigRational::from(digit - &half)
        })
    }
}

/// A common denominator: each sign change divides by 3, and so do the forces on the floor. Their shears are halves.
fn scale(pile: &Pile) -> BigInt {
    BigInt::from(2) * BigInt::from(3).pow(u32::try_from(pile.layers()).unwrap())
}

/// The sum of forces of one pile.
fn plus<T: Ring + Algebra + PartialEq>(one: &Known<T>, other: &Known<T>) -> Known<T> {
    let mut values = other.contacts.iter().map(|contact| contact.force.clone());
    let on_floor = other.floor.iter();
    let mut floor =
        on_floor.flat_map(|on| [on.normal.clone(), on.shear_x.clone(), on.shear_y.clone()]);
    one.map(|value| {
        let next = values.next().or_else(|| floor.next()).unwrap();
        value.clone() + &next
    })
}

fn sum(parts: &[Known<BigRational>; 3], factors: &[BigRational; 3]) -> Known<BigRational> {
    let [a, b, c] = [0, 1, 2].map(|n| parts[n].map(|part| part * &factors[n]));
    plus(&plus(&a, &b), &c)
}

/// The place of the sphere above in a direction: `paper`, "Notation". A pile may have no sphere there.
fn above(pile: &Pile, Site { i, j, k }: Site, direction: Direction) -> Option<Site> {
    let sign = pile
        .shape()
        .stacking()
        .signs()
        .nth(usize::try_from(k - 1).ok()?)?;
    let step = if sign == Sign::Plus { 1 } else { -1 };
    Some(match direction {
        Direction::Alpha => Site::new(i, j, k - 1),
        Direction::Beta => Site::new(i - step, j, k - 1),
        Direction::Gamma => Site::new(i, j - step, k - 1),
    })
}

fn same<A: PartialEq>(call: &str, got: &A, want: &A) -> Placed {
    if got == want {
        Ok(())
    } else {
        Err(call.to_owned())
    }
}

fn filled<T: Zero + Clone, R>(
    spheres: usize,
    fill: impl FnOnce([&mut [T]; 3]) -> Result<R, Error>,
) -> ([Vec<T>; 3], R) {
    let mut slices = [(); 3].map(|()| vec![T::zero(); spheres]);
    let done = fill(slices.each_mut().map(Vec::as_mut_slice)).unwrap();
    (slices, done)
}

/// The methods that apply to a pile, and the choice of the plan.
fn methods<T: Algebra>(pile: &Pile) -> impl Iterator<Item = Forces<'_, T>> {
    let chosen = [Method::Closed, Method::Tree, Method::Sweep]
        .map(|method| pile.forces().with_method(method));
    chosen.into_iter().flatten().chain([pile.forces()])
}

/// Compares the answers about single contacts and spheres, by each method.
fn one_by_one(pile: &Pile, known: &Known<BigRational>) -> Placed {
    for forces in methods::<BigRational>(pile) {
        let named = |call: &str| format!("{call} by {:?}", forces.method());
        for ContactForce {
            site,
            direction,
            force,
        } in &known.contacts
        {
            same(
                &named("contact"),
                &forces.contact(*site, *direction).unwrap(),
                force,
            )?;
        }
        for site in pile.shape().sites() {
            let above = Direction::ALL.map(|direction| {
                let force =
                    above(pile, site, direction).and_then(|above| known.at(above, direction));
                force.cloned().unwrap_or_else(BigRational::zero)
            });
            same(
                &named("from_above"),
                &forces.from_above(site).unwrap(),
                &above,
            )?;
            if site.k < pile.layers() - 1 {
                let below =
                    Direction::ALL.map(|direction| known.at(site, direction).unwrap().clone());
                same(&named("to_below"), &forces.to_below(site).unwrap(), &below)?;
            }
        }
        for on in &known.floor {
            same(&named("on_floor"), &forces.on_floor(on.site).unwrap(), on)?;
        }
    }
    Ok(())
}

/// Compares rows and slices in a scalar, by each method.
fn rows<T: Algebra + PartialEq + Zero>(pile: &Pile, known: &Known<BigRational>) -> Placed {
    let known = &known.map(T::from_rational);
    for forces in methods::<T>(pile) {
        let named = |call: &str| format!("{call} by {:?}", forces.method());
        same(&named("contacts, base"), &Known::of(&forces), known)?;
        let spheres = known.contacts.len() / 3;
        let whole = forces.layers(Selection::All).unwrap();
        same(
            &named("fill"),
            &filled(spheres, |out| whole.fill(out)).0,
            &known.slices(|_| true),
        )?;
        let mut layers = forces.layers(Selection::All).unwrap();
        while let Some(layer) = layers.next_layer().unwrap() {
            if layer.is_floor() {
                let base = filled(layer.sphere_count(), |out| layer.fill_base(out)).0;
                same(&named("fill_base"), &base, &known.floor_slices())?;
            } else {
                let below = filled(layer.sphere_count(), |out| layer.fill(out)).0;
                same(
                    &named("fill of a layer"),
                    &below,
                    &known.slices(|k| k == layer.k()),
                )?;
            }
        }
    }
    Ok(())
}

/// Compares the calls for exact forces only: integers, sums and extremes.
fn exact_calls(pile: &Pile, known: &Known<BigRational>) -> Placed {
    rows::<BigRational>(pile, known)?;
    one_by_one(pile, known)?;
    for forces in methods::<BigRational>(pile) {
        let layers = || -> Layers<'_, BigRational> { forces.layers(Selection::All).unwrap() };
        let spheres = known.contacts.len() / 3;
        let (numerators, denominator) =
            filled(spheres, |out| layers().numerators::<BigInt>()?.fill(out));
        let over = |n: BigInt| BigRational::new(n, denominator.clone());
        let got = numerators.map(|slice| slice.into_iter().map(over).collect());
        same("numerators", &got, &known.slices(|_| true))?;
    }
    let forces = pile.forces::<BigRational>();
    for k in 0..pile.layers() - 1 {
        let sum: BigRational = known.slices(|of| of == k).concat().iter().sum();
        same(
            "sum_of_contacts",
            &forces.sum_of_contacts(Selection::Layer(k)).unwrap(),
            &sum,
        )?;
    }
    let sums = known.floor_slices().map(|parts| parts.iter().sum());
    same(
        "sum_on_floor",
        &forces.sum_on_floor(Selection::Base).unwrap(),
        &sums,
    )?;
    let least = known.contacts.iter().map(|contact| &contact.force).min();
    same(
        "standing",
        &pile.standing().unwrap().least.map(|of| of.force).as_ref(),
        &least,
    )?;
    let extremes = pile.base_extremes().unwrap();
    let [normal, ..] = known.floor_slices();
    let ends = [normal.iter().min(), normal.iter().max()];
    same(
        "base_extremes",
        &[Some(&extremes.normal_min), Some(&extremes.normal_max)],
        &ends,
    )
}

/// Compares floats with rounding errors: multiplied by `scale`, they are nearest to the digits.
fn near(pile: &Pile, digits: &Known<BigRational>, scale: &BigInt) -> Placed {
    let (digits, scale) = (
        digits.map(f64::from_rational),
        f64::from_rational(&scale.clone().into()),
    );
    for forces in methods::<f64>(pile) {
        same(
            "floats",
            &Known::of(&forces).map(|force| (force * scale).round()),
            &digits,
        )?;
    }
    Ok(())
}

/// Compares correctly rounded floats, from rows and from whole piles.
fn rounded(pile: &Pile, known: &Known<BigRational>) -> Placed {
    let known = &known.map(f64::from_rational);
    for forces in methods::<BigRational>(pile) {
        let layers = || {
            forces
                .layers(Selection::All)
                .unwrap()
                .nearest::<f64>()
                .unwrap()
        };
        let spheres = known.contacts.len() / 3;
        same(
            "nearest",
            &filled(spheres, |out| layers().fill(out)).0,
            &known.slices(|_| true),
        )?;
        let mut by_rows = layers();
        for row in pile.rows(Selection::All).unwrap() {
            let spheres = row.length().unwrap();
            let sites: Vec<Site> = row.clone().into_iter().collect();
            if row.k < pile.layers() - 1 {
                let below = |direction| {
                    sites
                        .iter()
                        .map(|site| *known.at(*site, direction).unwrap())
                        .collect()
                };
                let got = filled(spheres, |out| by_rows.fill_row(&row, out)).0;
                same("nearest row", &got, &Direction::ALL.map(below))?;
            } else {
                let on = |part: fn(&FloorForce<f64>) -> f64| {
                    known
                        .floor
                        .iter()
                        .filter(|on| sites.contains(&on.site))
                        .map(part)
                        .collect()
                };
                let got = filled(spheres, |out| by_rows.fill_row_of_base(&row, out)).0;
                same(
                    "nearest base",
                    &got,
                    &[on(|on| on.normal), on(|on| on.shear_x), on(|on| on.shear_y)],
                )?;
            }
        }
    }
    Ok(())
}

/// The number of layers: 5, 4 in debug builds, which are slow, and 6 with `PLACEMENT=all`.
fn layers() -> usize {
    if std::env::var("PLACEMENT").as_deref() == Ok("all") {
        6
    } else if cfg!(debug_assertions) {
        4
    } else {
        5
    }
}

fn check(call: Placed, top: &str, signs: &str) {
    call.unwrap_or_else(|call| panic!("{call}: {top} {signs}"));
}

#[test]
fn exact_engines_place_all_forces() {
    for top in ["hexagon:1", "triangle:2"] {
        for signs in stackings(layers()) {
            let bare = under(top, &signs);
            let pile = loaded(&bare);
            let known = Known::of(&pile.forces());
            let scale = scale(&bare);
            check(exact_calls(&pile, &known), top, &signs);
            // Without loads the engines use symmetry, and tables of the straight pile.
            let gravity = known.digits(0, &bare, &scale).map(|digit| digit / &scale);
            check(exact_calls(&bare, &gravity), top, &signs);
            check(
                near(&bare, &known.digits(0, &bare, &scale), &scale),
                top,
                &signs,
            );
            check(rounded(&bare, &gravity), top, &signs);
        }
    }
}

/// The forces under a load on one sphere are whole numbers if the load is a multiple of [`scale`]. The three axes share a number:
/// down is 1, x is 2^17, and y is 2^34.
#[test]
fn engines_in_other_scalars_place_all_forces() {
    for signs in stackings(layers()) {
        let bare = under("hexagon:1", &signs);
        let known = Known::of(&loaded(&bare).forces());
        let scale = scale(&bare);
        for (n, site) in bare.shape().sites().enumerate() {
            let digits = [0, 1, 2].map(|axis| known.digits(3 + 3 * n + axis, &bare, &scale));
            let factors = [0, 17, 34].map(|bits| BigRational::from(BigInt::one() << bits));
            let [down, x, y] = factors.each_ref().map(|factor| factor * &scale);
            let pile = bare.bare().with_load(site, Load { down, x, y }).unwrap();
            let known = sum(&digits, &factors);
            check(rows::<f64>(&pile, &known), "a load", &signs);
            check(rows::<DoubleDouble>(&pile, &known), "a load", &signs);
            check(rows::<FixedRational<i64>>(&pile, &known), "a load", &signs);
            check(rounded(&pile, &known), "a load", &signs);
            // An `f32` holds one axis.
            let axis = n % 3;
            let pile = bare
                .bare()
                .with_load(site, along(axis, scale.clone().into()))
                .unwrap();
            check(rows::<f32>(&pile, &digits[axis]), "a load", &signs);
        }
    }
}

/// In polynomials every load is a symbol, and a force is its linear form.
#[test]
fn polynomials_are_the_linear_forms() {
    for signs in stackings(4) {
        let bare = under("hexagon:1", &signs).bare();
        let known = Known::of(&loaded(&bare).forces());
        let scale = scale(&bare);
        let sites = || bare.shape().sites().enumerate();
        // A symbol has a static name.
        let name = |n| Symbol(String::leak(format!("p{n}")));
        let symbols: Vec<[Polynomial; 3]> = sites()
            .map(|(n, _)| [0, 1, 2].map(|axis| Polynomial::from(name(3 * n + axis))))
            .collect();
        let loads = sites().map(|(n, site)| {
            let [down, x, y] = symbols[n].clone();
            (site, Load { down, x, y })
        });
        let forces = bare.forces::<Polynomial>().with_loads(loads).unwrap();
        let zero = || known.map(|_| Polynomial::zero());
        let form = symbols
            .iter()
            .flatten()
            .enumerate()
            .fold(zero(), |form, (n, symbol)| {
                let digits = known.digits(3 + n, &bare, &scale);
                let term =
                    |digit: &BigRational| Polynomial::from_rational(&(digit / &scale)) * symbol;
                plus(&form, &digits.map(term))
            });
        check(
            same("polynomials", &Known::of(&forces), &form),
            "symbols",
            &signs,
        );
        for method in [Method::Tree, Method::Sweep] {
            let forces = forces.clone().with_method(method).unwrap();
            check(
                same("polynomials", &Known::of(&forces), &form),
                "symbols",
                &signs,
            );
        }
    }
}

/// A wrong coefficient, contact or sphere is noticed.
#[test]
fn a_misplaced_force_is_noticed() {
    let pile = loaded(&under("triangle:2", "+-+"));
    let known = Known::of(&pile.forces());
    assert_eq!(exact_calls(&pile, &known), Ok(()));
    let faults: [fn(&mut Known<BigRational>); 4] = [
        |known| known.contacts[20].force += power(30) / BigInt::from(27),
        |known| {
            let force = known.contacts[20].force.clone();
            known.contacts[20].force = core::mem::replace(&mut known.contacts[21].force, force);
        },
        |known| known.contacts[9].site.i += 1,
        |known| known.floor.swap(2, 3),
    ];
    for fault in faults {
        let mut wrong = known.clone();
        fault(&mut wrong);
        assert!(exact_calls(&pile, &wrong).is_err());
    }
    let elsewhere = loaded(&under("triangle:2", "+-+"));
    let elsewhere = elsewhere
        .with_load(Site::new(1, 0, 1), along(1, power(5)))
        .unwrap();
    assert!(exact_calls(&elsewhere, &known).is_err());
}
