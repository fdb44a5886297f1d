//! How much the loads of a layer scatter: the mean of the sum of their squares.
//!
//! Let C_σ(δ) = E Σ_x f(x) f(x+δ)ᵀ, over all beginnings whose next sign is σ, with δ the difference of two sites of a layer.
//! A step leads the first force along one contact and the second along another, so that δ changes by the difference of the
//! two, and across the layer both go on alike:
//!
//! C_σ ← (1 − q) C'_σ + q G C'_(−σ) G, with C'_σ(δ)_lm = C_σ(δ + σd_l − σd_m)_lm,
//!
//! where d_α = (0,0), d_β = (1,0), d_γ = (0,1). It is closed in itself: nothing is asked of single places. For the sum of squares
//! in the end only C(0) is needed, so that n steps before it |δ| ≤ n is enough.

use cannonpile::formula;
use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::Algebra;
use num_bigint::BigUint;

use super::grid::{Grid, Size};
use super::number::{Number, add};
use super::piles::RandomPiles;
use super::walk::SIGNS;
use crate::Error;
use crate::THREE;
use crate::error::bug;

/// How the difference of two sites (i, j) moves with the second of them: by (i, −j), of which the cells next to one are those
/// that a step leads to.
fn of_differences(sign: Sign) -> [[isize; 2]; 3] {
    let step = match sign {
        Sign::Plus => 1,
        Sign::Minus => -1,
    };
    [[0, 0], [step, 0], [0, -step]]
}

/// The correlations of one next sign: a plane of cells for each pair of directions.
type Planes<T> = [[Vec<T>; 3]; 3];

impl RandomPiles {
    /// Returns the mean over all stackings of Σ N², with N the normal forces on the floor of one layer, in mg²: of the
    /// response to loads.
    ///
    /// Takes about 100 n³ operations for a single load. With the squares of the [mean](Self::mean) it says how much of one
    /// stacking is in the mean: sphere by sphere, little.
    ///
    /// # Errors
    /// [`Error::OnlyOfLoads`] unless the spheres weigh nothing and there is a load; [`TooLarge`](cannonpile::Error::TooLarge); [`Overflow`](cannonpile::Error::Overflow) of a
    /// scalar.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Site;
    /// use cannonpile::scalar::{Polynomial, Symbol};
    /// use num_rational::BigRational;
    ///
    /// let plane = RandomPiles::plane(RandomStackings::new(3, FirstSign::Plus)?).weightless();
    /// let plane = plane.with_load(Site::APEX, BigRational::from_integer(1.into()))?;
    /// // 1/3 in FCC, 11/27 in HCP.
    /// let squares = plane.mean_square(&Polynomial::from(Symbol("q")))?;
    /// assert_eq!(squares.to_string(), "(2 q + 9)/27");
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn mean_square<T: Algebra>(&self, q: &T) -> Result<T, Error> {
        const QUANTITY: &str = "the mean square of random stackings";
        self.check_response(QUANTITY)?;
        let steps = self.stackings.steps();
        if steps == 0 {
            let squares = self
                .loads()
                .values()
                .map(|load| T::from_rational(&(load * load)));
            return super::mean::defined(squares.fold(T::zero(), |sum, square| sum + &square));
        }
        // A single cell at first, and as far around it as a step leads.
        let size = Size::new([0, 0], [0, 0], 1, steps);
        size.check(QUANTITY, &BigUint::from(36_u32), 1)?;
        let grid = Grid::new(&size, &vec![(0, 0..1)], of_differences)?;
        let correlation = Correlation {
            grid,
            same: T::one() - q,
            change: q.clone().div_int(THREE).div_int(THREE),
        };
        let steps = usize::try_from(steps).map_err(|_| bug("the size was checked"))?;
        let mut layer = correlation.start(self)?;
        for k in 1..=steps {
            layer = correlation.step(&layer, k < steps, steps - k)?;
        }
        let origin = correlation.grid.cell([0, 0]);
        let mut sum = T::zero();
        for plane in layer.iter().flatten().flatten().flatten() {
            let at = origin.and_then(|at| plane.get(at));
            add(&mut sum, at.ok_or_else(|| bug("the origin is a cell"))?);
        }
        // Normals are a third of the sum of three lines.
        super::mean::defined(sum.div_int(THREE).div_int(THREE).div_int(self.firsts()))
    }
}

/// Correlations over differences of sites.
struct Correlation<T> {
    grid: Grid,
    same: T,
    /// Of 9 G C G.
    change: T,
}

impl<T: Algebra> Correlation<T> {
    fn planes(&self) -> Planes<T> {
        let plane = || vec![T::zero(); self.grid.cells()];
        [(); 3].map(|()| [(); 3].map(|()| plane()))
    }

    /// The loads of the top layer: the same on each line.
    fn start(&self, piles: &RandomPiles) -> Result<[Option<Planes<T>>; 2], Error> {
        let loads = piles.loads();
        let mut differences = Vec::new();
        for ([i, j], first) in loads {
            for ([x, y], second) in loads {
                if let Some(cell) = self.grid.cell([x - i, j - y]) {
                    differences.push((cell, T::from_rational(&(first * second))));
                }
            }
        }
        let first = piles.stackings.first().signs();
        let mut begun = [None, None];
        for (sign, planes) in SIGNS.iter().zip(&mut begun) {
            if !first.contains(sign) {
                continue;
            }
            let mut made = self.planes();
            for plane in made.iter_mut().flatten() {
                for (cell, product) in &differences {
                    let at = plane.get_mut(*cell);
                    add(
                        at.ok_or_else(|| bug("a cell is within its plane"))?,
                        product,
                    );
                }
            }
            *planes = Some(made);
        }
        Ok(begun)
    }

    /// One step, and the choice of the next sign if there is one, of what is within `reach`.
    fn step(
        &self,
        from: &[Option<Planes<T>>; 2],
        goes_on: bool,
        reach: usize,
    ) -> Result<[Option<Planes<T>>; 2], Error> {
        let [plus, minus] = from;
        let moved = [
            plus.as_ref().map(|planes| (Sign::Plus, planes)),
            minus.as_ref().map(|planes| (Sign::Minus, planes)),
        ];
        let mut to = [None, None];
        for (at, to) in to.iter_mut().enumerate() {
            let (straight, turned) = (moved[at], moved[1 - at].filter(|_| goes_on));
            if straight.is_none() && turned.is_none() {
                continue;
            }
            let mut planes = self.planes();
            for cells in self.grid.window(reach)? {
                for cell in cells {
                    let sum = self.combined(cell, straight, turned, goes_on)?;
                    for (plane, sum) in planes.iter_mut().flatten().zip(sum.into_iter().flatten()) {
                        let at = plane.get_mut(cell);
                        *at.ok_or_else(|| bug("a cell is within its plane"))? = sum;
                    }
                }
            }
            *to = Some(planes);
        }
        Ok(to)
    }

    fn combined(
        &self,
        cell: usize,
        straight: Option<(Sign, &Planes<T>)>,
        turned: Option<(Sign, &Planes<T>)>,
        goes_on: bool,
    ) -> Result<[[T; 3]; 3], Error> {
        let mut sum = [(); 3].map(|()| [(); 3].map(|()| T::zero()));
        if let Some((sign, planes)) = straight {
            let moved = self.moved(cell, sign, planes)?;
            for (sum, moved) in sum.iter_mut().flatten().zip(moved.into_iter().flatten()) {
                *sum = if goes_on { moved * &self.same } else { moved };
            }
        }
        if let Some((sign, planes)) = turned {
            let turned = tripled_both(&self.moved(cell, sign, planes)?);
            for (sum, turned) in sum.iter_mut().flatten().zip(turned.into_iter().flatten()) {
                add(sum, &(turned * &self.change));
            }
        }
        Ok(sum)
    }

    /// What comes to a difference of sites: C(δ + σd_l − σd_m)_lm.
    fn moved(&self, cell: usize, sign: Sign, planes: &Planes<T>) -> Result<[[T; 3]; 3], Error> {
        let mut moved = [(); 3].map(|()| [(); 3].map(|()| T::zero()));
        for (l, (rows, to)) in Direction::ALL
            .into_iter()
            .zip(planes.iter().zip(&mut moved))
        {
            for (m, (plane, to)) in Direction::ALL.into_iter().zip(rows.iter().zip(to)) {
                // Back along the second contact, and on along the first.
                let cells = self.grid.above(&(cell..cell + 1), sign, m)?;
                let cells = self.grid.above(&cells, -sign, l)?;
                let from = plane.get(cells.start);
                to.clone_from(from.ok_or_else(|| bug("a cell is within its plane"))?);
            }
        }
        Ok(moved)
    }
}

/// Returns 9 G C G.
pub(super) fn tripled_both<T: Number>(c: &[[T; 3]; 3]) -> [[T; 3]; 3] {
    transposed(
        transposed(c.each_ref().map(formula::tripled_half_turn))
            .each_ref()
            .map(formula::tripled_half_turn),
    )
}

fn transposed<T>(rows: [[T; 3]; 3]) -> [[T; 3]; 3] {
    let [[aa, ab, ac], [ba, bb, bc], [ca, cb, cc]] = rows;
    [[aa, ba, ca], [ab, bb, cb], [ac, bc, cc]]
}
