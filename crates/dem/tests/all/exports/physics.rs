//! The exported files describe a pile in equilibrium.

use std::collections::BTreeMap;

use cannonpile_dem::PileFile;
use cannonpile_dem::scene::Scene;
use cannonpile_testkit::scenes::{columns, for_each_pile, text};

type Columns = BTreeMap<String, Vec<f64>>;

/// Checks that every sphere is in equilibrium, touches its contact partners, and is above its supports.
fn judge(
    scene: &Scene,
    spheres: &Columns,
    contacts: &Columns,
    base: &Columns,
) -> Result<(), String> {
    let float = |number: &num_rational::BigRational| -> f64 {
        cannonpile::scalar::Surd::from(number.clone())
            .nearest()
            .expect("a float")
    };
    let gravity = float(&scene.gravity);
    let row = |id: f64| {
        let found = spheres["id"]
            .iter()
            .position(|other| other.to_bits() == id.to_bits());
        found.ok_or_else(|| format!("no sphere {id}"))
    };
    let centre = |row: usize| ["x", "y", "z"].map(|axis| spheres[axis][row]);
    let mut forces = vec![[0.0; 3]; spheres["id"].len()];
    let mut greatest = 0.0_f64;
    for (contact, force) in contacts["force"].iter().enumerate() {
        let (upper, lower) = (
            row(contacts["id1"][contact])?,
            row(contacts["id2"][contact])?,
        );
        let vector = ["fx", "fy", "fz"].map(|axis| contacts[axis][contact]);
        let [from, to] = [centre(lower), centre(upper)];
        let apart = [0, 1, 2].map(|axis| to[axis] - from[axis]);
        let distance = apart.map(|x| x * x).iter().sum::<f64>().sqrt();
        let touching = spheres["radius"][upper] + spheres["radius"][lower];
        if (distance / touching - 1.0).abs() > 1e-13 || apart[2] < 0.0 {
            return Err(format!(
                "the spheres of contact {contact} have the distance {distance}"
            ));
        }
        for axis in 0..3 {
            if (vector[axis] - force * apart[axis] / distance).abs() > 1e-13 * force.abs() {
                return Err(format!(
                    "the force of contact {contact} has another direction"
                ));
            }
            forces[upper][axis] += vector[axis];
            forces[lower][axis] -= vector[axis];
        }
        greatest = greatest.max(force.abs());
    }
    let pile = scene.pile().expect("a pile");
    let packing = scene.packing(&pile).expect("a packing");
    let tan: f64 = packing.inclination().tan().nearest().expect("a float");
    let sin_phi = float(pile.sin_phi());
    let units = [tan, 2.0 * (1.0 - sin_phi * sin_phi).sqrt() * tan, -1.0];
    let [x, y] = scene.tilt.each_ref().map(float);
    for (sphere, force) in forces.iter_mut().enumerate() {
        let weight = spheres["mass"][sphere] * gravity;
        for ((force, unit), part) in force.iter_mut().zip(units).zip([x, y, 1.0]) {
            *force += weight * unit * part;
        }
        greatest = greatest.max(weight);
    }
    for (at, load) in &scene.loads {
        let id = pile
            .numbering()
            .expect("numbers")
            .id(at.site(pile.layers()))
            .expect("a sphere");
        let load = load
            .clone()
            .map(|part| float(&part) * float(&scene.mass) * gravity);
        let force = &mut forces[usize::try_from(id).expect("a place") - 1];
        for ((force, unit), part) in force.iter_mut().zip(units).zip([load.x, load.y, load.down]) {
            *force += unit * part;
        }
        greatest = greatest.max(load.down);
    }
    let fixed = spheres["fixed"]
        .iter()
        .enumerate()
        .filter(|(_, fixed)| **fixed > 0.5);
    let fixed: Vec<usize> = fixed.map(|(row, _)| row).collect();
    if fixed.len() != base["normal"].len() {
        return Err("rows of the base".into());
    }
    for (place, row) in fixed.into_iter().enumerate() {
        let shear = |name| base.get(name).map_or(0.0, |shear: &Vec<f64>| shear[place]);
        for (force, felt) in
            forces[row]
                .iter_mut()
                .zip([shear("shear_x"), shear("shear_y"), -base["normal"][place]])
        {
            *force -= felt;
        }
    }
    match forces
        .iter()
        .flatten()
        .find(|force| force.abs() > 1e-12 * greatest)
    {
        Some(force) => Err(format!("{force} N are not balanced")),
        None => Ok(()),
    }
}

#[test]
fn every_sphere_is_in_equilibrium() {
    for_each_pile(|scene, export| {
        let read = |file| columns(&text(export, file));
        let spheres = read(PileFile::SpheresCsv);
        let contacts = read(PileFile::ContactsCsv);
        let base = read(PileFile::BaseCsv);
        assert_eq!(
            judge(scene, &spheres, &contacts, &base),
            Ok(()),
            "{scene:?}"
        );
        // The check detects exchanged numbers, signs and rows.
        if contacts["force"].len() < 2 {
            return;
        }
        let mut swapped = contacts.clone();
        let (id1, id2) = (swapped["id1"].clone(), swapped["id2"].clone());
        swapped.insert("id1".into(), id2);
        swapped.insert("id2".into(), id1);
        assert!(judge(scene, &spheres, &swapped, &base).is_err());
        let mut shifted = contacts.clone();
        shifted.get_mut("id2").expect("a column").rotate_left(1);
        assert!(judge(scene, &spheres, &shifted, &base).is_err());
        if !scene.weightless {
            let mut stronger = contacts.clone();
            for name in ["force", "fx", "fy", "fz"] {
                stronger.get_mut(name).expect("a column")[1] *= 1.0 + 1e-9;
            }
            assert!(judge(scene, &spheres, &stronger, &base).is_err());
        }
        let mut turned = base.clone();
        turned.get_mut("normal").expect("a column")[0] += 1e-3;
        assert!(judge(scene, &spheres, &contacts, &turned).is_err());
    });
}
