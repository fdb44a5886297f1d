//! What spheres and loads add to the forces of a layer.

use super::{Layer, Transfer, rows_mut};
use crate::Error;
use crate::error::bug;
use crate::number::{Number, Share, add};
use crate::walk::Walk;

impl<T: Number, S: Share<T>> Transfer<'_, T, S> {
    /// The first layer, with its loads alone.
    pub(super) fn load(&self, layer: &mut Layer<T>, walk: &Walk<T>) -> Result<(), Error> {
        for start in self.frame.starts() {
            let begun = self
                .of_net(start)
                .and_then(|at| layer.get_mut(at)?.first_mut())
                .ok_or_else(|| bug("a stacking begins with no fault"))?;
            for (sign, planes) in begun.iter_mut().enumerate() {
                if walk.of(0, sign).is_none() {
                    continue;
                }
                let planes = planes.get_or_insert_with(|| self.planes());
                for (site, load) in &self.loads {
                    let cell = self.frame.top_cell(*site);
                    for plane in planes.iter_mut() {
                        let at = cell.and_then(|cell| plane.get_mut(cell));
                        add(at.ok_or_else(|| bug("loads are on the top layer"))?, load);
                    }
                }
            }
        }
        Ok(())
    }

    /// Adds what the spheres of layer `k` weigh.
    pub(super) fn add_weights(
        &self,
        layer: &mut Layer<T>,
        walk: &Walk<T>,
        k: usize,
    ) -> Result<(), Error> {
        if self.weight.is_zero() {
            return Ok(());
        }
        if self.frame.base().is_some() {
            self.add_weights_on_base(layer, walk, k)
        } else {
            self.add_weights_below(layer, walk, k)
        }
    }

    fn add_weights_below(
        &self,
        layer: &mut Layer<T>,
        walk: &Walk<T>,
        k: usize,
    ) -> Result<(), Error> {
        let frame = self.frame;
        let within = -(k as i128)..=k as i128;
        let classes = layer
            .first_mut()
            .ok_or_else(|| bug("there is one number of net steps"))?;
        for cells in frame.grid.window(k)? {
            let nets = cells
                .clone()
                .map(|cell| frame.nets(k, cell, within.clone()));
            let nets: Vec<_> = nets.collect();
            for (class, signs) in classes.iter_mut().enumerate() {
                for (sign, planes) in signs.iter_mut().enumerate() {
                    let Some(counts) = walk.of(class, sign) else {
                        continue;
                    };
                    let planes = planes.get_or_insert_with(|| self.planes());
                    let [a, b, c] = rows_mut(planes, &cells)?;
                    let lines = a.iter_mut().zip(b).zip(c);
                    for (((a, b), c), nets) in lines.zip(&nets) {
                        if nets.is_empty() {
                            continue;
                        }
                        let own = nets.sum(counts, frame.steps)? * &self.weight;
                        add(a, &own);
                        add(b, &own);
                        add(c, &own);
                    }
                }
            }
        }
        Ok(())
    }

    fn add_weights_on_base(
        &self,
        layer: &mut Layer<T>,
        walk: &Walk<T>,
        k: usize,
    ) -> Result<(), Error> {
        for (net, classes) in self.nets().zip(layer) {
            let Some(region) = self.frame.region(k, net) else {
                continue;
            };
            let rows = self.frame.rows_of(&region)?;
            for (class, signs) in classes.iter_mut().enumerate() {
                for (sign, planes) in signs.iter_mut().enumerate() {
                    let counts = walk.of(class, sign);
                    let place = walk.place_of(net);
                    let Some(count) = counts.and_then(|counts| counts.get(place?)) else {
                        continue;
                    };
                    if count.is_zero() {
                        continue;
                    }
                    let own = count.clone() * &self.weight;
                    let planes = planes.get_or_insert_with(|| self.planes());
                    for cells in &rows {
                        for row in rows_mut(planes, cells)? {
                            for force in row {
                                add(force, &own);
                            }
                        }
                    }
                }
            }
        }
        Ok(())
    }
}
