//! The mean sum of squared loads of one layer.
//!
//! Let C_σ(δ) = E Σ_x f(x) f(x+δ)ᵀ be the autocorrelation of the contact forces f of a layer. The mean is over all
//! stackings whose next sign is σ, and δ is the difference of two sites of the layer. One step moves the first force
//! along its contact l and the second along its contact m, so δ changes by σ(d_m − d_l). Then the next sign is chosen.
//! It is the same for both forces:
//!
//! C_σ ← (1 − q) C'_σ + q G C'_(−σ) G, with C'_σ(δ)_lm = C_σ(δ + σd_l − σd_m)_lm,
//!
//! where d_α = (0,0), d_β = (1,0), d_γ = (0,1). This recursion is closed: it needs no forces at single sites. The sum of
//! squares is C(0) in the last layer, so a layer n steps above it needs |δ| ≤ n only.

use cannonpile::formula;
use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::Algebra;
use num_bigint::BigUint;

use super::grid::{Grid, Size};
use super::nets::SIGNS;
use super::number::add;
use super::piles::RandomPiles;
use crate::THREE;
use crate::error::bug;
use crate::{Each, Error};

/// Returns the shifts of a difference (i, j), stored in the cell (i, −j). With this choice the cells around a cell are
/// exactly the ones that a step reaches.
fn difference_shifts(sign: Sign) -> [[isize; 2]; 3] {
    let step = if sign == Sign::Plus { 1 } else { -1 };
    [[0, 0], [step, 0], [0, -step]]
}

/// The products of two forces, by the directions of their contacts.
type Matrix<T> = [[T; 3]; 3];

/// The correlations before a step, by the sign of the step and the cell. `None` stands for zero everywhere.
type Layer<T> = [Option<Vec<Matrix<T>>>; 2];

impl RandomPiles {
    /// Returns the mean over all stackings of Σ N², in mg², for the response to loads. N are the normal forces on the
    /// floor of one layer.
    ///
    /// The ratio of the sum of squares of the [mean](Self::mean) to this value shows how close one stacking is to the
    /// mean. The ratio is small, so no single stacking is close to the mean, sphere by sphere. The cost is about 100 n³
    /// operations for a single load, with n the number of steps.
    ///
    /// # Errors
    /// * [`Error::NotAResponse`] unless the spheres are weightless and there is a load.
    /// * [`TooLarge`](cannonpile::Error::TooLarge) if the correlations do not fit in memory.
    /// * [`Overflow`](cannonpile::Error::Overflow) if the scalar overflows.
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
            let squares = self.loads().iter();
            let squares = squares.map(|(_, load)| T::from_rational(&(load * load)));
            return super::mean::defined(squares.fold(T::zero(), |sum, square| sum + &square));
        }
        // The first window is the cell of δ = 0, and each further window adds one step around it.
        let size = Size::new([0, 0], [0, 0], 1, steps);
        size.check(QUANTITY, &BigUint::from(36_u32), 1)?;
        let grid = Grid::new(&size, &vec![(0, 0..1)], difference_shifts)?;
        let correlation = Correlation {
            grid,
            same: T::one() - q,
            change: q.clone().div_int(THREE).div_int(THREE),
        };
        let steps = usize::try_from(steps).map_err(|_| bug("the size was checked"))?;
        let mut layer = correlation.start(self);
        for k in 1..=steps {
            layer = correlation.step(&layer, k == steps, steps - k)?;
        }
        let origin = correlation.grid.cell([0, 0]);
        let mut sum = T::zero();
        for cells in layer.iter().flatten() {
            let matrix = origin.and_then(|origin| cells.get(origin));
            let matrix = matrix.ok_or_else(|| bug("the origin is a cell"))?;
            matrix
                .iter()
                .flatten()
                .for_each(|product| add(&mut sum, product));
        }
        // A normal force is a third of the sum of three contact forces.
        super::mean::defined(sum.div_int(THREE).div_int(THREE).div_int(self.firsts()))
    }
}

/// The recursion of the correlations.
struct Correlation<T> {
    grid: Grid,
    /// 1 − q, the factor of C'.
    same: T,
    /// q/9, the factor of 9 G C' G.
    change: T,
}

impl<T: Algebra> Correlation<T> {
    fn zeros(&self) -> Vec<Matrix<T>> {
        vec![zero(); self.grid.cells()]
    }

    /// Returns the correlations of the loads. A load adds the same force to all three contacts of its sphere.
    fn start(&self, piles: &RandomPiles) -> Layer<T> {
        let mut cells = self.zeros();
        for ([i, j], first) in piles.loads() {
            for ([x, y], second) in piles.loads() {
                // Loads whose difference is outside of the grid never reach the same sphere.
                let cell = self.grid.cell([x - i, j - y]);
                let matrix = cell.and_then(|cell| cells.get_mut(cell));
                let product = T::from_rational(&(first * second));
                for sum in matrix.into_iter().flatten().flatten() {
                    add(sum, &product);
                }
            }
        }
        let first = piles.stackings.first().signs();
        SIGNS.each(|sign| first.contains(&sign).then(|| cells.clone()))
    }

    /// Returns the correlations one step further down, for the differences within `reach`. The last step has no next sign.
    fn step(&self, from: &Layer<T>, is_last: bool, reach: usize) -> Result<Layer<T>, Error> {
        let mut to = [None, None];
        for (at, to) in to.iter_mut().enumerate() {
            let straight = from[at].as_ref();
            let turned = from[1 - at].as_ref().filter(|_| !is_last);
            if straight.is_none() && turned.is_none() {
                continue;
            }
            let mut cells = self.zeros();
            for cell in self.grid.window(reach)?.flatten() {
                let mut sum = zero();
                if let Some(from) = straight {
                    sum = self.moved(cell, SIGNS[at], from)?;
                    if !is_last {
                        sum = sum.each(|row| row.each(|product| product * &self.same));
                    }
                }
                if let Some(from) = turned {
                    let turned = tripled_both(&self.moved(cell, SIGNS[1 - at], from)?);
                    for (sum, turned) in sum.iter_mut().flatten().zip(turned.into_iter().flatten())
                    {
                        add(sum, &(turned * &self.change));
                    }
                }
                *cells.get_mut(cell).ok_or_else(|| bug(CELL))? = sum;
            }
            *to = Some(cells);
        }
        Ok(to)
    }

    /// Returns C'(δ) for the difference δ of a cell.
    fn moved(&self, cell: usize, sign: Sign, from: &[Matrix<T>]) -> Result<Matrix<T>, Error> {
        let mut moved: Matrix<T> = zero();
        for l in Direction::ALL {
            for m in Direction::ALL {
                // Back along the contact m, and forward along the contact l.
                let cells = self.grid.above(&(cell..cell + 1), sign, m)?;
                let cells = self.grid.above(&cells, -sign, l)?;
                let matrix = from.get(cells.start).ok_or_else(|| bug(CELL))?;
                moved[l.index()][m.index()].clone_from(&matrix[l.index()][m.index()]);
            }
        }
        Ok(moved)
    }
}

const CELL: &str = "a cell is within its plane";

fn zero<T: Algebra>() -> Matrix<T> {
    [(); 3].each(|()| [(); 3].each(|()| T::zero()))
}

/// Returns 9 G C G.
fn tripled_both<T: Algebra>(c: &Matrix<T>) -> Matrix<T> {
    let rows = c.each_ref().each(formula::tripled_half_turn);
    let columns =
        [0, 1, 2].each(|m| formula::tripled_half_turn(&rows.each_ref().each(|row| row[m].clone())));
    [0, 1, 2].each(|l| columns.each_ref().each(|column| column[l].clone()))
}
