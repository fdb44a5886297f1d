//! A pile as numbered spheres and contacts.

use std::collections::HashMap;

use cannonpile::Pile;
use cannonpile::lattice::{Dimension, Direction, Site};
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;

use super::basis;

/// The spheres of a pile, numbered from the top. The bottom spheres come last.
pub(crate) struct Network {
    pub(crate) sites: Vec<Site>,
    /// The three spheres below each sphere above the floor. Contact c belongs to sphere c/3, in direction c mod 3.
    pub(crate) below: Vec<[usize; 3]>,
    /// The weight of each sphere, in mg.
    pub(crate) weights: Vec<f64>,
    /// The positions of the centres in R, z down.
    pub(crate) positions: Vec<[f64; 3]>,
    /// The unit vectors from each sphere above the floor to the three below it.
    pub(crate) directions: Vec<[[f64; 3]; 3]>,
}

impl Network {
    /// Returns the spheres of a pile in three dimensions without loads.
    pub(crate) fn new(pile: &Pile) -> Self {
        assert_eq!(pile.dimension(), Dimension::Three, "discs touch two below");
        let sites: Vec<Site> = pile.shape().sites().collect();
        let numbered = sites.iter().copied().enumerate();
        let numbers: HashMap<Site, usize> = numbered.map(|(number, site)| (site, number)).collect();
        let forces = pile.forces::<f64>();
        let basis = basis(pile);

        let positions = sites.iter().map(|&site| {
            let position = forces.position(site).expect("a site of the pile");
            position.on(&basis).map(|x| 2.0 * x)
        });
        let weights = sites.iter().map(|&site| {
            let weight = pile.sphere_weight(site).expect("a site of the pile");
            f64::from_rational(&weight)
        });
        let above_floor = sites.iter().filter(|site| site.k < pile.layers() - 1);
        let below = above_floor.map(|&site| {
            Direction::ALL
                .map(|direction| numbers[&pile.shape().below(site, direction).expect("a support")])
        });

        // All spheres of a layer have the same vectors. Differences of positions would lose digits in high piles.
        let mut directions = Vec::new();
        for k in 0..pile.layers() - 1 {
            let layer = || pile.rows(Selection::Layer(k)).expect("a layer").flatten();
            let site = layer().next().expect("a sphere");
            let here = Direction::ALL.map(|direction| {
                let upwards = forces
                    .contact_direction(site, direction)
                    .expect("a contact");
                upwards.on(&basis).map(|x| -x)
            });
            directions.extend(layer().map(|_| here));
        }

        Self {
            positions: positions.collect(),
            weights: weights.collect(),
            below: below.collect(),
            sites,
            directions,
        }
    }

    /// Returns the number of contacts between spheres.
    pub(crate) fn contacts(&self) -> usize {
        3 * self.below.len()
    }
}
