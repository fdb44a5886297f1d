//! The linear and quadratic programs over all contacts of a pile at a = R, solved by an interior point method in floats only.

use std::collections::HashMap;

use cannonpile::Pile;
use cannonpile::lattice::{Direction, Site};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT,
};

/// The equilibrium of every sphere above the floor, for unknown sloping and horizontal forces.
pub(crate) struct Floats {
    /// Triplets of equation, unknown and coefficient.
    entries: Vec<(usize, usize, f64)>,
    /// The number of unknowns; the horizontal ones come last.
    unknowns: usize,
    equations: usize,
    /// The unknowns of the contacts above each bottom sphere.
    onto: HashMap<Site, Vec<usize>>,
}

impl Floats {
    /// Returns the program of a pile of equal spheres.
    pub(crate) fn of(pile: &Pile) -> Self {
        let (shape, floor) = (pile.shape(), pile.layers() - 1);
        let spheres: Vec<Site> = shape.sites().take_while(|site| site.k < floor).collect();
        let numbers: HashMap<Site, usize> = spheres.iter().copied().zip(0..).collect();
        let mut this = Self {
            entries: Vec::new(),
            unknowns: 0,
            equations: 3 * spheres.len(),
            onto: HashMap::new(),
        };
        for (number, site) in spheres.iter().enumerate() {
            for direction in Direction::ALL {
                let (unknown, l) = (this.unknowns, direction.index());
                this.unknowns += 1;
                this.entries.push((3 * number + l, unknown, 1.0));
                let below = shape.below(*site, direction).expect("a support");
                let Some(support) = numbers.get(&below) else {
                    this.onto.entry(below).or_default().push(unknown);
                    continue;
                };
                // At a sign change the half-turn transforms the forces.
                let is_kept = shape.sign_below(site.k) == shape.sign_below(below.k);
                for m in 0..3 {
                    let share = match (is_kept, m == l) {
                        (true, true) => 1.0,
                        (true, false) => continue,
                        (false, true) => -1.0 / 3.0,
                        (false, false) => 2.0 / 3.0,
                    };
                    this.entries.push((3 * support + m, unknown, -share));
                }
            }
        }
        for (number, site) in spheres.iter().enumerate() {
            let sign = shape.sign_below(site.k).expect("a step");
            let sigma = f64::from(sign.factor());
            for contact in shape.horizontal_contacts(*site) {
                let neighbour = numbers[&contact.neighbour().expect("a neighbour")];
                let [a, b] = contact.axis.ends().map(Direction::index);
                for (sphere, sigma) in [(number, sigma), (neighbour, -sigma)] {
                    this.entries.push((3 * sphere + a, this.unknowns, -sigma));
                    this.entries.push((3 * sphere + b, this.unknowns, sigma));
                }
                this.unknowns += 1;
            }
        }
        this
    }

    /// Returns the largest normal force of a bottom sphere, in mg.
    pub(crate) fn greatest(&self, site: Site) -> f64 {
        let mut cost = vec![0.0; self.unknowns];
        for unknown in &self.onto[&site] {
            cost[*unknown] = -1.0;
        }
        let onto = -self.minimum(&vec![0.0; self.unknowns], &cost);
        1.0 + onto / 3.0
    }

    /// Returns the minimum of ½ (Σ f² + Σ X²).
    pub(crate) fn energy(&self) -> f64 {
        self.minimum(&vec![1.0; self.unknowns], &vec![0.0; self.unknowns])
    }

    /// Minimises ½ Σ curvature x² + Σ cost x.
    fn minimum(&self, curvature: &[f64], cost: &[f64]) -> f64 {
        let (equations, unknowns) = (self.equations, self.unknowns);
        let signs = (0..unknowns).map(|unknown| (equations + unknown, unknown, -1.0));
        let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for (row, column, value) in self.entries.iter().copied().chain(signs) {
            rows.push(row);
            columns.push(column);
            values.push(value);
        }
        let matrix =
            CscMatrix::new_from_triplets(equations + unknowns, unknowns, rows, columns, values);
        let places: Vec<usize> = (0..unknowns).collect();
        let curvature = CscMatrix::new_from_triplets(
            unknowns,
            unknowns,
            places.clone(),
            places,
            curvature.to_vec(),
        );
        let mut sums = vec![1.0; equations];
        sums.resize(equations + unknowns, 0.0);
        let cones = [ZeroConeT(equations), NonnegativeConeT(unknowns)];
        let settings = DefaultSettings {
            verbose: false,
            ..DefaultSettings::default()
        };
        let solver = DefaultSolver::new(&curvature, cost, &matrix, &sums, &cones, settings);
        let mut solver = solver.expect("a program");
        solver.solve();
        assert_eq!(solver.solution.status, SolverStatus::Solved);
        solver.solution.obj_val
    }
}
