//! Sums of forces over layers, without a loop over spheres.
//!
//! Every line continues into the next layer. So the forces below a layer sum to the forces that the next layer
//! receives. The increments and the half-turn act on these sums as on the forces of one sphere.

use core::ops::Range;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use super::Forces;
use super::terms::horizontal;
use crate::Error;
use crate::each::Each;
use crate::engine::{LineForces, to_scalar, to_scalars};
use crate::error::refuse_beyond;
use crate::formula;
use crate::formula::{force, half_turn, transmitted};
use crate::shape::{RunLayers, Selection};
use crate::sorted::Sorted;

/// The largest number of layers that are summed one by one.
const MAX_SUMMED_LAYERS: u64 = 10_000_000;

impl Forces<'_, BigRational> {
    /// Returns the sum of all contact forces of a part, in f₀: the sum of the items of [`contacts`](Self::contacts).
    /// The cost is linear in the layers of the part, and in the sign changes, loads and special weights of the pile.
    ///
    /// # Errors
    /// [`Error::LayerOutside`], [`Error::SiteOutside`]; [`Error::TooLarge`] for more than ten million layers, or if the
    /// forces of one sphere need too much memory.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "++-".parse()?)?;
    /// let sum = pile.forces::<BigRational>().sum_of_contacts(Selection::All)?;
    /// // The forces below a layer sum to 3 f₀ for each sphere in or above the layer: 1, 1 + 3 and 1 + 3 + 6 spheres.
    /// assert_eq!(sum, BigRational::from_integer(45.into()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn sum_of_contacts(&self, part: Selection) -> Result<BigRational, Error> {
        let (lines, floor) = (&self.lines, self.bottom());
        let layers = match part {
            Selection::All => 0..floor,
            Selection::Layer(k) => {
                lines.shape.layer(k)?;
                k..(k + 1).min(floor)
            }
            Selection::Base => floor..floor,
            Selection::One(site) if site.k == floor => {
                lines.shape.check(site)?;
                floor..floor
            }
            Selection::One(site) => return Ok(self.to_below(site)?.iter().sum()),
        };
        refuse_beyond(
            "the sum over these layers",
            (layers.end - layers.start).unsigned_abs(),
            MAX_SUMMED_LAYERS,
            "ask for single layers",
        )?;
        // The sums by the number of sign changes above them. Sums with the same number share a denominator.
        let mut sums: Sorted<usize, BigInt> = Sorted::new();
        let add = |[a, b, c]: &[BigInt; 3], changes| {
            *sums.entry(changes, BigInt::ZERO) += a + b + c;
        };
        lines.sum_layers(layers, add);
        let quantity = "a sum of forces";
        let mut total = BigRational::zero();
        for (changes, sum) in sums.into_vec() {
            total += to_scalar::<BigRational>(quantity, sum, &lines.scale(changes))?;
        }
        Ok(total)
    }

    /// Returns the sums of the forces of a part on the floor: normal in mg, shear_x in mg·tanθ, shear_y in
    /// 2cosφ·mg·tanθ. The terms are the items of [`base`](Self::base). Over the whole base, the sum is that of all loads
    /// and weights, so the shears are zero unless gravity leans or a load does.
    ///
    /// # Errors
    /// [`Error::SiteOutside`], [`Error::LayerOutside`]; [`Error::NotOnFloor`] for a part outside the base;
    /// [`Error::TooLarge`] if the forces of one sphere need too much memory.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// let [normal, shear_x, shear_y] = pile.forces::<BigRational>().sum_on_floor(Selection::Base)?;
    /// let zero = BigRational::from_integer(0.into());
    /// assert_eq!([normal, shear_x, shear_y], [pile.weight(), zero.clone(), zero]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn sum_on_floor(&self, part: Selection) -> Result<[BigRational; 3], Error> {
        let (lines, floor) = (&self.lines, self.bottom());
        if let Selection::One(site) = part {
            let force = self.on_floor(site)?;
            return Ok([force.normal, force.shear_x, force.shear_y]);
        }
        self.pile.check_on_floor(&self.pile.rows(part)?)?;
        let (received, changes) = lines.sum_layers(floor..floor, |_, _| ());
        let ordinary = lines.ordinary_load(changes);
        let spheres = BigInt::from(lines.shape.layer(floor)?.site_count());
        let extras = lines.extras_in(floor..floor + 1);
        let load = extras.fold(ordinary.clone().scaled(&spheres), |sum, site| {
            sum + &(lines.load(site, changes) - &ordinary)
        });
        let load = load.scaled(&lines.direction_scale);
        let directions = lines.directions_above(floor);
        let force = formula::support_load(&received, &directions, &load.z) + &horizontal(&load);
        let force = force.scaled(&lines.sum_scale);
        let unit = lines.floor_unit(changes);
        to_scalars("a sum of forces", [force.z, force.x, force.y], &unit)
    }
}

impl LineForces<'_, BigRational> {
    /// Calls `visit` for each of `layers` with the sums of the forces that the layer transmits, by direction, and with
    /// the number of sign changes above these forces. The sums are integers over the scale of this number. Returns the
    /// sums for the last layer above the end of `layers`.
    fn sum_layers(
        &self,
        layers: Range<i128>,
        mut visit: impl FnMut(&[BigInt; 3], usize),
    ) -> ([BigInt; 3], usize) {
        let mut sums = [(); 3].each(|()| BigInt::zero());
        let mut changes = 0;
        let runs = (0..).map_while(|run| self.shape.run(run));
        for run in runs.take_while(|run| run.from < layers.end) {
            if run.index > changes {
                sums = half_turn::<BigRational>(&sums);
                changes = run.index;
            }
            let visited = layers.start.max(run.from).min(run.to)..run.to.min(layers.end);
            sums = self.with_layers(sums, &run, run.from..visited.start);
            for k in visited {
                sums = self.with_layers(sums, &run, k..k + 1);
                visit(&sums, changes);
            }
        }
        (sums, changes)
    }

    /// Adds the increments of some layers of a run to the sums, by direction.
    fn with_layers(&self, sums: [BigInt; 3], run: &RunLayers, layers: Range<i128>) -> [BigInt; 3] {
        let spheres = BigInt::from(self.shape.spheres_in(layers.clone()));
        let ordinary = self.increments_after(run.index);
        let mut own = ordinary.each(|w| force(spheres.clone(), &w));
        for site in self.extras_in(layers) {
            let extra = self.extra(site);
            own.iter_mut()
                .zip(extra)
                .for_each(|(own, extra)| *own += extra);
        }
        let [a, b, c] = sums;
        let [own_a, own_b, own_c] = &own;
        [
            transmitted(a, own_a),
            transmitted(b, own_b),
            transmitted(c, own_c),
        ]
    }
}
