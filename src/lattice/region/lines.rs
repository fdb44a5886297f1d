//! How many spheres lie on the lines above a site, within a run.

use super::Region;
use crate::lattice::count;
use crate::stacking::Sign;

impl Region {
    /// How many of the `steps` layers above (i, j), stacked with one sign, have a sphere on each of its lines.
    ///
    /// THEORY §3, "Lines". For + steps N_α = min(m, x₁−i, y₁−j, s₁−i−j), N_β = min(m, i−x₀, y₁−j, i+j−s₀),
    /// N_γ = min(m, j−y₀, x₁−i, i+j−s₀), with the bounds of the layer of (i, j); for − steps the same under
    /// (i, j) → (−i, −j). Each argument grows by one per step down and vanishes at its surface. None outside the region.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::stacking::Sign;
    ///
    /// // Layer 5 of the paper's pile: (k−i−j, i, j).
    /// let layer = Region::triangle(6)?;
    /// assert_eq!(layer.spheres_above(1, 2, Sign::Plus, 5), [2, 1, 2]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    #[inline]
    pub fn spheres_above(&self, i: i128, j: i128, sign: Sign, steps: i128) -> [i128; 3] {
        if !self.contains(i, j) {
            return [0; 3];
        }
        let (lower, upper) = (&self.lower, &self.upper);
        let bounds = match sign {
            Sign::Plus => count::bounds_above(&i, &j, lower, upper, &steps),
            Sign::Minus => {
                let [lower, upper] = [upper, lower].map(|bounds| bounds.map(|bound| -bound));
                count::bounds_above(&-i, &-j, &lower, &upper, &steps)
            }
        };
        bounds.map(|[m, a, b, c]| m.min(a).min(b).min(c))
    }

    /// The counts of [`spheres_above`](Self::spheres_above) along row j, by direction: the same bounds, one row's
    /// taken together.
    pub(crate) fn row_counts(&self, j: i128, sign: Sign, steps: i128) -> [Trapezoid; 3] {
        let ([x0, y0, s0], [x1, y1, s1]) = (self.lower, self.upper);
        let (rises, falls) = (x0.max(s0 - j), x1.min(s1 - j));
        let (up, down) = (steps.min(y1 - j), steps.min(j - y0));
        match sign {
            Sign::Plus => [
                Trapezoid::falling(up, falls),
                Trapezoid::rising(up, rises),
                Trapezoid {
                    cap: down,
                    rises: Some(s0 - j),
                    falls: Some(x1),
                },
            ],
            Sign::Minus => [
                Trapezoid::rising(down, rises),
                Trapezoid::falling(down, falls),
                Trapezoid {
                    cap: up,
                    rises: Some(x0),
                    falls: Some(s1 - j),
                },
            ],
        }
    }
}

/// min(cap, i − rises, falls − i): how a count runs along a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Trapezoid {
    pub(crate) cap: i128,
    pub(crate) rises: Option<i128>,
    pub(crate) falls: Option<i128>,
}

impl Trapezoid {
    const fn rising(cap: i128, rises: i128) -> Self {
        Self {
            cap,
            rises: Some(rises),
            falls: None,
        }
    }

    const fn falling(cap: i128, falls: i128) -> Self {
        Self {
            cap,
            rises: None,
            falls: Some(falls),
        }
    }

    #[cfg(test)]
    fn at(&self, i: i128) -> i128 {
        let rise = self.rises.map_or(self.cap, |from| i - from);
        let fall = self.falls.map_or(self.cap, |until| until - i);
        self.cap.min(rise).min(fall)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row at a time or a site at a time, it is the same count.
    #[test]
    fn rows_count_as_sites_do() {
        let shapes = [
            Region::triangle(5),
            Region::hexagon(3, 4),
            Region::new(-2..=3, 0..=2, -1..=4),
        ];
        let mut compared = 0;
        for region in shapes.map(|region| region.unwrap()) {
            for (sign, steps) in [Sign::Plus, Sign::Minus]
                .into_iter()
                .flat_map(|sign| (0..6).map(move |m| (sign, m)))
            {
                for row in region.rows(0) {
                    let counts = region.row_counts(row.j, sign, steps);
                    for i in row.i {
                        let of_site = region.spheres_above(i, row.j, sign, steps);
                        assert_eq!(
                            counts.map(|count| count.at(i)),
                            of_site,
                            "{region} {i} {}",
                            row.j
                        );
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 500);
    }
}
