//! The equilibrium equations of a pile, as a sparse linear system.

use num_traits::Float;

use super::network::Network;

/// The system A f = b, with as many equations as unknowns. Forces are in mg.
///
/// The unknowns are the magnitudes of the contact forces, three for each sphere above the floor. Equations 3n, 3n+1
/// and 3n+2 state that the contact forces on sphere n and its weight sum to zero along x, y and z.
pub(crate) struct Equations<F> {
    pub(crate) matrix: Columns<F>,
    pub(crate) loads: Vec<F>,
}

/// A square sparse matrix in compressed columns, with ascending rows in each column.
pub(crate) struct Columns<F> {
    /// The start of each column, and the end of the last one.
    pub(crate) starts: Vec<usize>,
    pub(crate) rows: Vec<usize>,
    pub(crate) values: Vec<F>,
}

impl<F: Float> Equations<F> {
    /// Returns the equations of all spheres above the floor.
    pub(crate) fn new(network: &Network) -> Self {
        let spheres = network.below.len();
        let float = |x: f64| F::from(x).expect("every float rounds to another");
        let mut matrix = Columns {
            starts: vec![0],
            rows: Vec::with_capacity(6 * 3 * spheres),
            values: Vec::with_capacity(6 * 3 * spheres),
        };
        let contacts = network.below.iter().zip(&network.directions).enumerate();
        for (upper, (below, directions)) in contacts {
            for (&lower, direction) in below.iter().zip(directions) {
                // The direction is that from the upper sphere to the lower one. The contact force acts along the
                // direction on the lower sphere, and against it on the upper one.
                matrix.entries(upper, direction.map(|x| float(-x)));
                if lower < spheres {
                    matrix.entries(lower, direction.map(float));
                }
                matrix.starts.push(matrix.rows.len());
            }
        }
        let weights = &network.weights[..spheres];
        // A f plus the weights is zero. z points down, so a weight is positive.
        let loads = weights.iter().flat_map(|&w| [0.0, 0.0, -w].map(float));
        Self {
            loads: loads.collect(),
            matrix,
        }
    }

    /// Returns the residual b − A f.
    pub(crate) fn residual(&self, forces: &[F]) -> Vec<F> {
        let product = self.matrix.times(forces);
        self.loads
            .iter()
            .zip(product)
            .map(|(&b, y)| b - y)
            .collect()
    }
}

impl<F: Float> Columns<F> {
    /// Appends the components of a contact force on a sphere to the last column, without zeros.
    fn entries(&mut self, sphere: usize, force: [F; 3]) {
        for (axis, value) in force.into_iter().enumerate() {
            if !value.is_zero() {
                self.rows.push(3 * sphere + axis);
                self.values.push(value);
            }
        }
    }

    /// Returns the number of rows, which equals the number of columns.
    pub(crate) fn size(&self) -> usize {
        self.starts.len() - 1
    }

    fn columns(&self) -> impl Iterator<Item = impl Iterator<Item = (usize, F)>> {
        self.starts.windows(2).map(|ends| {
            let column = ends[0]..ends[1];
            let rows = self.rows[column.clone()].iter().copied();
            rows.zip(self.values[column].iter().copied())
        })
    }

    /// Returns A x.
    pub(crate) fn times(&self, x: &[F]) -> Vec<F> {
        let mut product = vec![F::zero(); self.size()];
        for (column, &x) in self.columns().zip(x) {
            for (row, value) in column {
                product[row] = product[row] + value * x;
            }
        }
        product
    }

    /// Returns Aᵀ y.
    pub(crate) fn transposed_times(&self, y: &[F]) -> Vec<F> {
        let dot = |sum, (row, value): (usize, F)| sum + value * y[row];
        self.columns()
            .map(|column| column.fold(F::zero(), dot))
            .collect()
    }
}
