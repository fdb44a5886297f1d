//! The forces that loads and weights add to a layer.

use super::{Layer, Transfer, rows_mut};
use crate::Error;
use crate::error::bug;
use crate::nets::NetCounts;
use crate::number::{Number, add};

impl<T: Number> Transfer<'_, T> {
    /// Adds the loads to the top layer.
    pub(super) fn add_loads(
        &self,
        layer: &mut Layer<T>,
        counts: &NetCounts<T>,
    ) -> Result<(), Error> {
        for start in self.domain.starts() {
            let at = self.net_index(start);
            let signs = at.and_then(|at| layer.get_mut(at)?.first_mut());
            let signs = signs.ok_or_else(|| bug("a stacking begins with no fault"))?;
            for (sign, planes) in signs.iter_mut().enumerate() {
                if counts.of(0, sign).is_none() {
                    continue;
                }
                let planes = planes.get_or_insert_with(|| self.planes());
                for (site, load) in &self.loads {
                    let cell = self.domain.top_cell(*site);
                    for plane in planes.iter_mut() {
                        let force = cell.and_then(|cell| plane.get_mut(cell));
                        let force = force.ok_or_else(|| bug("loads are on the top layer"))?;
                        add(force, load);
                    }
                }
            }
        }
        Ok(())
    }

    /// Adds the weights of the spheres of layer `k`.
    pub(super) fn add_weights(
        &self,
        layer: &mut Layer<T>,
        counts: &NetCounts<T>,
        k: usize,
    ) -> Result<(), Error> {
        if self.weight.is_zero() {
            return Ok(());
        }
        let steps = self.domain.steps;
        for (net, classes) in self.domain.nets().zip(layer) {
            for (cells, nets) in self.domain.possible_spheres(k, net)? {
                for (class, signs) in classes.iter_mut().enumerate() {
                    for (sign, planes) in signs.iter_mut().enumerate() {
                        let Some(counts) = counts.of(class, sign) else {
                            continue;
                        };
                        let weights = nets
                            .iter()
                            .map(|nets| Ok(nets.sum(counts, steps)? * &self.weight));
                        let weights = weights.collect::<Result<Vec<T>, Error>>()?;
                        // Planes of zeros would cost time in every further layer.
                        if weights.iter().all(T::is_zero) {
                            continue;
                        }
                        let planes = planes.get_or_insert_with(|| self.planes());
                        for row in rows_mut(planes, &cells)? {
                            for (force, weight) in row.iter_mut().zip(&weights) {
                                add(force, weight);
                            }
                        }
                    }
                }
            }
        }
        Ok(())
    }
}
