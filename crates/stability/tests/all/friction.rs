//! Two layers on a rough floor, against all equations of equilibrium.

use std::collections::BTreeMap;

use cannonpile::geometry::{Vector, directions};
use cannonpile::lattice::{Axis, Direction, HorizontalContact, Region, Sign, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{Load, Packing, Pile, ratio};
use cannonpile_stability::{Error, RoughFloor, RoughPacking};
use num_rational::BigRational;
use num_traits::{One, Zero};

type Row = BTreeMap<usize, BigRational>;

fn cross(a: &Vector<BigRational>, b: &Vector<BigRational>) -> Vector<BigRational> {
    Vector {
        x: &a.y * &b.z - &a.z * &b.y,
        y: &a.z * &b.x - &a.x * &b.z,
        z: &a.x * &b.y - &a.y * &b.x,
    }
}

/// The equations of forces and moments of all spheres. The unknowns are three components of force for each contact and
/// each lower sphere. Column `unknowns` is the constant term.
struct Equations {
    unknowns: usize,
    rows: Vec<Row>,
}

impl Equations {
    /// Adds the six equations of one sphere: a force at each point, with its unknowns and sign, and its weight.
    fn balance(&mut self, forces: &[(Vector<BigRational>, usize, i64)], weight: BigRational) {
        let axes = [(1, 0, 0), (0, 1, 0), (0, 0, 1)].map(|(x, y, z): (i64, i64, i64)| {
            let part = |n: i64| BigRational::from_integer(n.into());
            Vector {
                x: part(x),
                y: part(y),
                z: part(z),
            }
        });
        let mut rows: [Row; 6] = Default::default();
        for (point, first, sign) in forces {
            for (n, axis) in axes.iter().enumerate() {
                let factors = [axis.clone(), cross(point, axis)].map(Vector::into_array);
                for (row, factor) in rows.iter_mut().zip(factors.into_iter().flatten()) {
                    let entry = row.entry(first + n).or_default();
                    *entry += factor * BigRational::from_integer((*sign).into());
                }
            }
        }
        // The z axis points down.
        rows[2].insert(self.unknowns, weight);
        self.rows.extend(rows);
    }

    /// Returns the only solution, by exact elimination.
    fn solve(self) -> Vec<BigRational> {
        let mut solved: Vec<(usize, Row)> = Vec::new();
        for mut row in self.rows {
            for (pivot, known) in &solved {
                subtract(&mut row, *pivot, known);
            }
            row.retain(|_, factor| !factor.is_zero());
            let Some((pivot, lead)) = row.iter().next().map(|(n, lead)| (*n, lead.clone())) else {
                continue;
            };
            assert_ne!(pivot, self.unknowns, "the equations contradict each other");
            for factor in row.values_mut() {
                *factor /= &lead;
            }
            for (_, known) in &mut solved {
                subtract(known, pivot, &row);
            }
            solved.push((pivot, row));
        }
        assert_eq!(solved.len(), self.unknowns, "the forces are not unique");
        solved.sort_by_key(|(pivot, _)| *pivot);
        let constant =
            |(_, row): (usize, Row)| -row.get(&self.unknowns).cloned().unwrap_or_default();
        solved.into_iter().map(constant).collect()
    }
}

/// Subtracts a multiple of `known`, whose factor at `pivot` is 1.
fn subtract(row: &mut Row, pivot: usize, known: &Row) {
    let Some(times) = row.remove(&pivot).filter(|times| !times.is_zero()) else {
        return;
    };
    for (n, factor) in known.iter().filter(|(n, _)| **n != pivot) {
        *row.entry(*n).or_default() -= factor * &times;
    }
}

/// Solves all equations, and compares every force, at sinθ = 3/5 and cosθ = 4/5. There tan(θ/2) = 1/3.
///
/// Lengths and forces along y are in the unit 2cosφ, which is a factor of whole equations.
fn check(pile: &Pile) {
    let (sin, cos, half) = (ratio!(3 / 5), ratio!(4 / 5), ratio!(1 / 3));
    // From a support to the sphere above it.
    let along = directions(pile.sin_phi()).map(|e| Vector {
        x: e.x * &sin,
        y: e.y * &sin,
        z: e.z * &cos,
    });
    let along = match pile.shape().sign_below(0) {
        Some(Sign::Minus) => along.map(Vector::turned_about_z),
        _ => along,
    };
    let sites = pile.sites(Selection::All).unwrap();
    let (upper, lower): (Vec<Site>, Vec<Site>) = sites.partition(|site| site.k == 0);
    let contacts: Vec<(Site, Direction, Site)> = upper
        .iter()
        .flat_map(|site| Direction::ALL.map(|m| (*site, m, pile.shape().below(*site, m).unwrap())))
        .collect();
    let table = 3 * contacts.len();
    let mut equations = Equations {
        unknowns: table + 3 * lower.len(),
        rows: Vec::new(),
    };
    let weight = |site: Site| pile.total_load(site).down;
    for site in &upper {
        let points = contacts.iter().enumerate().filter(|(_, c)| c.0 == *site);
        let forces: Vec<_> = points
            .map(|(n, (_, m, _))| (-along[m.index()].clone(), 3 * n, 1))
            .collect();
        equations.balance(&forces, weight(*site));
    }
    for (place, site) in lower.iter().enumerate() {
        let points = contacts.iter().enumerate().filter(|(_, c)| c.2 == *site);
        let mut forces: Vec<_> = points
            .map(|(n, (_, m, _))| (along[m.index()].clone(), 3 * n, -1))
            .collect();
        let down = Vector {
            x: ratio!(0),
            y: ratio!(0),
            z: ratio!(1),
        };
        forces.push((down, table + 3 * place, 1));
        equations.balance(&forces, weight(*site));
    }
    let solution = equations.solve();
    let rough = RoughFloor::new(pile).unwrap();
    let found: Vec<_> = rough
        .contacts::<BigRational>(Selection::All)
        .unwrap()
        .collect();
    assert_eq!(found.len(), contacts.len());
    for (n, (contact, known)) in found.into_iter().zip(&contacts).enumerate() {
        let contact = contact.unwrap();
        assert_eq!((contact.site, contact.direction), (known.0, known.1));
        let e = &along[known.1.index()];
        // N along the contact and T across it, away from the support and up.
        let horizontal = &contact.force * &half / &sin;
        let expected = [&e.x * &horizontal, &e.y * &horizontal, -contact.force];
        assert_eq!(solution[3 * n..3 * n + 3], expected, "{pile}");
    }
    let mut needed = BigRational::zero();
    let s = pile.sin_phi();
    let across = ratio!(4) * (BigRational::one() - s * s);
    for (place, force) in rough
        .base::<BigRational>(Selection::Base)
        .unwrap()
        .enumerate()
    {
        let force = force.unwrap();
        assert_eq!(force.site, lower[place]);
        let [x, y, z] = [0, 1, 2].map(|axis| &solution[table + 3 * place + axis]);
        assert_eq!(-z, force.normal);
        assert_eq!([-x, -y], [&force.shear_x * &half, &force.shear_y * &half]);
        if !force.normal.is_zero() {
            needed = needed.max((x * x + y * y * &across) / (z * z * &half * &half));
        }
    }
    assert_eq!(rough.floor_friction(), Ok(Surd::sqrt(needed).unwrap()));
}

#[test]
fn forces_are_unique_under_every_top_of_eight_spheres_or_fewer() {
    let mut tops = 0;
    for (x, y, sum) in
        (1..=8).flat_map(|x| (1..=8).flat_map(move |y| (1..16).map(move |s| (x, y, s))))
    {
        for from in 0..sum {
            let Ok(top) = Region::new(0..=x - 1, 0..=y - 1, from..=sum - 1) else {
                continue;
            };
            let spheres = top.site_count();
            if spheres > 8_u32.into() || !is_tight(&top, [x, y], [from, sum]) {
                continue;
            }
            tops += 1;
            check(&Pile::under(top, "+".parse().unwrap()).unwrap());
        }
    }
    assert!(tops > 30, "{tops}");
}

/// Returns whether no bound of a region can be tightened, so that each region occurs once.
fn is_tight(top: &Region, [x, y]: [i128; 2], [from, end]: [i128; 2]) -> bool {
    let pile = Pile::under(*top, "+".parse().unwrap()).unwrap();
    let sites: Vec<Site> = pile.sites(Selection::Layer(0)).unwrap().collect();
    let has = |is: &dyn Fn(&Site) -> bool| sites.iter().any(is);
    has(&|s| s.i == 0)
        && has(&|s| s.i == x - 1)
        && has(&|s| s.j == 0)
        && has(&|s| s.j == y - 1)
        && has(&|s| s.i + s.j == from)
        && has(&|s| s.i + s.j == end - 1)
}

#[test]
fn bases_loads_weights_and_isosceles_triangles() {
    let ten = Pile::under(Region::hexagon(3, 3).unwrap(), "-".parse().unwrap()).unwrap();
    check(&ten);
    let loaded = ten
        .with_load(Site::new(0, 0, 0), ratio!(5 / 2))
        .and_then(|pile| pile.with_weight(Site::new(1, 0, 0), ratio!(0)))
        .and_then(|pile| pile.with_load(Site::new(0, 0, 1), ratio!(1 / 7)))
        .unwrap();
    check(&loaded);
    check(&Pile::on(Region::hexagon(3, 2).unwrap(), "+".parse().unwrap()).unwrap());
    for s in [ratio!(1 / 3), ratio!(3 / 4)] {
        check(&Pile::isosceles(2, s).unwrap());
    }
}

/// A disc has half its weight on each support, so the friction at the floor is tan(θ/2)·(1/2)/(3/2).
#[test]
fn discs() {
    let pile = Pile::discs(2).unwrap();
    let rough = RoughFloor::new(&pile).unwrap();
    let contact = rough.contact(Site::APEX, Direction::Alpha);
    assert_eq!(contact, Ok(ratio!(1 / 2)));
    let base: Vec<_> = rough
        .base::<BigRational>(Selection::Base)
        .unwrap()
        .map(Result::unwrap)
        .collect();
    let forces = base.into_iter().map(|force| [force.normal, force.shear_x]);
    let expected = [
        [ratio!(3 / 2), ratio!(-1 / 2)],
        [ratio!(3 / 2), ratio!(1 / 2)],
    ];
    assert!(forces.eq(expected));
    assert_eq!(rough.floor_friction(), Ok(ratio!(1 / 3).into()));
    let weightless = pile.weightless();
    let rough = RoughFloor::new(&weightless).unwrap();
    assert_eq!(rough.floor_friction(), Ok(ratio!(0).into()));
}

/// Three layers have a state of self-stress, so their forces depend on the history.
#[test]
fn other_piles_are_refused() {
    let refused = |pile: Pile| match RoughFloor::new(&pile) {
        Err(Error::RoughFloor { given, .. }) => given.to_string(),
        other => panic!("{other:?}"),
    };
    let two = || Pile::triangular(2).unwrap();
    assert_eq!(refused(Pile::triangular(3).unwrap()), "3 layers");
    assert_eq!(refused(Pile::triangular(1).unwrap()), "1 layer");
    let tilted = two().with_tilt([ratio!(1 / 9), ratio!(0)]).unwrap();
    assert_eq!(refused(tilted), "a tilt");
    let push = Load {
        down: ratio!(0),
        x: ratio!(1),
        y: ratio!(0),
    };
    let pushed = two().with_load(Site::APEX, push).unwrap();
    assert_eq!(refused(pushed), "the load (0, 1, 0) at (i,j,k) = (0,0,0)");
    let wide = Pile::under(Region::hexagon(2, 2).unwrap(), "+".parse().unwrap()).unwrap();
    let contact = HorizontalContact {
        site: wide.sites(Selection::Layer(0)).unwrap().next().unwrap(),
        axis: Axis::ALL[0],
    };
    let held = wide.with_horizontal_force(contact, ratio!(1)).unwrap();
    assert_eq!(refused(held), "forces of such contacts");
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Forces and moments of every sphere about its centre, from the vectors and points in SI units alone.
#[test]
fn forces_in_si_units_are_in_equilibrium() {
    let wide = Pile::under(Region::hexagon(3, 2).unwrap(), "+".parse().unwrap())
        .and_then(|pile| pile.with_load(Site::new(0, 0, 0), ratio!(7 / 2)))
        .unwrap();
    let piles = [
        Pile::triangular(2).unwrap(),
        Pile::isosceles(2, ratio!(2 / 5)).unwrap(),
        Pile::discs(2).unwrap(),
        wide,
    ];
    for (pile, spacing) in piles
        .iter()
        .flat_map(|pile| [(pile, "6/5"), (pile, "11/10")])
    {
        let packing = Packing::new(pile, &spacing.parse().unwrap())
            .and_then(|packing| packing.with_radius(ratio!(1 / 3)))
            .and_then(|packing| packing.with_mass(ratio!(2)))
            .and_then(|packing| packing.with_gravity(ratio!(981 / 100)))
            .unwrap();
        let rough = RoughPacking::new(&packing).unwrap();
        let friction = rough.contact_friction().nearest::<f64>().unwrap();
        let mut sums: BTreeMap<Site, [f64; 6]> = BTreeMap::new();
        let mut add = |site: Site, point: [f64; 3], force: [f64; 3]| {
            let centre = packing.position(site).unwrap().map(|x| x.to_f64());
            let arm = [0, 1, 2].map(|axis| point[axis] - centre[axis]);
            let moment =
                [(1, 2), (2, 0), (0, 1)].map(|(a, b)| arm[a] * force[b] - arm[b] * force[a]);
            let sum = sums.entry(site).or_default();
            for (n, part) in force.into_iter().chain(moment).enumerate() {
                sum[n] += part;
            }
        };
        for contact in rough.contacts(Selection::All).unwrap() {
            let contact = contact.unwrap();
            let normal = contact.normal_vector.map(|x| x.to_f64());
            let tangential = contact
                .tangential_vector
                .map(|x| x.nearest::<f64>().unwrap());
            let [n, t] = [&normal, &tangential].map(|force| dot(force, force).sqrt());
            let magnitude = contact.tangential.nearest::<f64>().unwrap();
            assert!((n - Surd::from(contact.normal).to_f64()).abs() < 1e-13 * n);
            assert!((t - magnitude).abs() < 1e-12 * n && (t - friction * n).abs() < 1e-12 * n);
            assert!(dot(&normal, &tangential).abs() < 1e-13 * n * n);
            let point = contact.point.map(|x| x.to_f64());
            let force = [0, 1, 2].map(|axis| normal[axis] + tangential[axis]);
            let lower = pile.shape().below(contact.site, contact.direction).unwrap();
            add(contact.site, point, force);
            add(lower, point, force.map(|part| -part));
        }
        let radius = Surd::from(packing.radius().clone()).to_f64();
        let mut needed = 0.0_f64;
        for force in rough.base(Selection::Base).unwrap() {
            let force = force.unwrap();
            let [x, y, z] = [&force.shear_x, &force.shear_y, &force.normal];
            let [x, y, z] = [x, y, z].map(|part| part.nearest::<f64>().unwrap());
            needed = needed.max(x.hypot(y) / z);
            let mut point = packing.position(force.site).unwrap().map(|x| x.to_f64());
            point[2] -= radius;
            add(force.site, point, [-x, -y, z]);
        }
        assert!((needed - rough.floor_friction().unwrap().nearest::<f64>().unwrap()).abs() < 1e-14);
        let unit = Surd::from(packing.sphere_weight()).to_f64();
        for (site, [x, y, z, moment @ ..]) in sums {
            let load = Surd::from(pile.load(site).unwrap().down + ratio!(1)).to_f64();
            assert!((z / unit - load).abs() < 1e-13, "{pile} {site}");
            assert!(x.hypot(y) < 1e-13 * unit, "{pile} {site}");
            assert!(dot(&moment, &moment).sqrt() < 1e-13 * unit, "{pile} {site}");
        }
    }
}

#[test]
fn spheres_that_touch_in_a_layer_are_refused() {
    let pile = Pile::triangular(2).unwrap();
    let packing = Packing::new(&pile, &"1".parse().unwrap()).unwrap();
    match RoughPacking::new(&packing) {
        Err(Error::RoughFloor { given, .. }) => assert_eq!(&*given, "the spacing a = R"),
        other => panic!("{other:?}"),
    }
}
