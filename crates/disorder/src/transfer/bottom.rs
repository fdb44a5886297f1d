//! The last step, and the forces on the floor.

use super::{FREE, Layer, Spot, Transfer};
use crate::Error;
use crate::error::bug;
use crate::floor::FloorFactors;
use crate::nets::{NetCounts, SIGNS};
use crate::number::{Number, add};

impl<T: Number> Transfer<'_, T> {
    /// Takes the last step, and returns the forces on the floor.
    pub(super) fn bottom(
        &self,
        layer: &Layer<T>,
        counts: &NetCounts<T>,
    ) -> Result<Vec<Spot<T>>, Error> {
        let domain = self.domain;
        let factors = FloorFactors::new()?;
        let counts: Vec<_> = (0..self.classes)
            .map(|class| counts.of_both(class))
            .collect();
        let mut spots = Vec::new();
        for cell in domain.bottom()? {
            let mut classes = Vec::with_capacity(self.classes);
            for (class, counts) in counts.iter().enumerate() {
                let spheres = domain.spheres(cell, counts)?;
                let weight = factors.weight(spheres.clone() * &self.weight);
                let mut floor = [weight, T::zero(), T::zero()];
                for (at, sign) in SIGNS.into_iter().enumerate() {
                    let net = self.left_before(0, sign);
                    let planes = net.and_then(|net| layer.get(net)?.get(class)?.get(at)?.as_ref());
                    if let Some(planes) = planes {
                        let [a, b, c] = self.above(planes, &(cell..cell + 1), sign)?;
                        let ([a], [b], [c]) = (a, b, c) else {
                            return Err(bug(FREE));
                        };
                        factors.add([a, b, c], sign, &mut floor);
                    }
                }
                // The loads of a single layer act on the floor directly.
                let loads = self.loads.iter().filter(|_| domain.steps == 0);
                for (_, load) in loads.filter(|(site, _)| domain.top_cell(*site) == Some(cell)) {
                    add(&mut floor[0], &factors.weight(load.clone()));
                }
                let [normal, shear_x, shear_y] = floor;
                classes.push([spheres, normal, shear_x, shear_y]);
            }
            let place = domain.place(cell)?;
            spots.push(Spot { place, classes });
        }
        Ok(spots)
    }
}
