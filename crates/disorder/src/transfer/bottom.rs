//! What the floor feels of the last layer.

use super::{FREE, Layer, Spot, Transfer};
use crate::Error;
use crate::error::bug;
use crate::floor::FloorFactors;
use crate::number::{Number, Share, add};
use crate::place::Place;
use crate::walk::{SIGNS, Walk};

impl<T: Number, S: Share<T>> Transfer<'_, T, S> {
    /// The last step, and what the floor feels.
    pub(super) fn bottom(&self, layer: &Layer<T>, walk: &Walk<T>) -> Result<Vec<Spot<T>>, Error> {
        let frame = self.frame;
        let floor = FloorFactors::new()?;
        let counts: Vec<_> = (0..self.classes).map(|class| walk.of_both(class)).collect();
        let mut spots = Vec::new();
        for cell in frame.bottom()? {
            let mut classes = Vec::with_capacity(self.classes);
            for (class, counts) in counts.iter().enumerate() {
                let spheres = frame.spheres(cell, counts)?;
                let own = spheres.clone() * &self.weight;
                let mut force = floor.own(own);
                for (at, sign) in SIGNS.into_iter().enumerate() {
                    let net = self.left_before(0, sign);
                    let planes = net.and_then(|net| layer.get(net)?.get(class)?.get(at)?.as_ref());
                    if let Some(planes) = planes {
                        let [a, b, c] = self.above(planes, &(cell..cell + 1), sign)?;
                        let ([a], [b], [c]) = (a, b, c) else {
                            return Err(bug(FREE));
                        };
                        floor.add([a, b, c], sign, &mut force);
                    }
                }
                classes.push((spheres, force));
            }
            let place = frame.place(cell)?;
            spots.push(Spot { place, classes });
        }
        if frame.steps == 0 {
            self.load_floor(&mut spots, &floor)?;
        }
        Ok(spots)
    }

    /// Of a single layer the floor feels the loads at once.
    fn load_floor(&self, spots: &mut [Spot<T>], floor: &FloorFactors<T>) -> Result<(), Error> {
        for (site, load) in &self.loads {
            let place = Place::of(*site, 0);
            let spot = spots.iter_mut().find(|spot| Some(spot.place) == place);
            let classes = spot.map(|spot| &mut spot.classes);
            let (_, force) = classes
                .and_then(|classes| classes.first_mut())
                .ok_or_else(|| bug("loads are on the top layer"))?;
            let own = floor.own(load.clone());
            add(&mut force.normal, &own.normal);
        }
        Ok(())
    }
}
