//! Stiff unilateral springs with damping, relaxed to rest, as in a discrete-element method.
//!
//! The units are R = m = g = 1. The springs deform, so that the forces have an error of about 0.48·L/k. The positions are
//! rounded, which gives an error of about 10⁻¹⁵·k. So the best stiffness is in between. Below k ≈ 0.06·L³ the pile collapses.

use std::fmt;

use super::network::Network;

/// The result of a relaxation.
pub(crate) enum Relaxed {
    /// At rest, with these contact forces in mg.
    Rest { forces: Vec<f64>, steps: usize },
    /// A sphere moved by more than half a radius.
    Collapse { steps: usize },
    /// The residual force is still too large.
    Unrest { steps: usize, out_of_balance: f64 },
}

impl fmt::Display for Relaxed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rest { steps, .. } => write!(f, "{steps} steps"),
            Self::Collapse { steps } => write!(
                f,
                "the pile collapses: a sphere is R/2 off after {steps} steps"
            ),
            Self::Unrest {
                steps,
                out_of_balance,
            } => write!(
                f,
                "not at rest after {steps} steps: {out_of_balance:.0e} mg out of balance"
            ),
        }
    }
}

/// The time step in √(m/k). The fastest mode of a sphere between six others has ω² < 6.3·k/m, and ω·Δt must be below 2.
const TIME_STEP: f64 = 0.6;

/// The number of steps between two checks of the residual force.
const LOOK: usize = 16;

/// The largest residual force at rest, in mg.
const ENOUGH: f64 = 1e-10;

/// Relaxes a pile of `layers` layers from its exact positions, with a fixed base.
///
/// The relaxation ends when the residual force is small, or when it is of the size of the rounding of positions and no
/// longer decreases.
pub(crate) fn relax(network: &Network, layers: u16, stiffness: f64) -> Relaxed {
    let mut positions = network.positions.clone();
    let moving = network.below.len();
    let mut velocities = vec![[0.0; 3]; moving];
    let mut loads = vec![[0.0; 3]; positions.len()];
    let mut forces = vec![0.0; network.contacts()];

    let step = TIME_STEP / stiffness.sqrt();
    // Critical damping of the slowest mode.
    let damping = SLOWEST * 2.0 * stiffness.sqrt() / f64::from(layers);
    let kept = (1.0 - damping * step / 2.0) / (1.0 + damping * step / 2.0);
    let gained = step / (1.0 + damping * step / 2.0);
    let extent = positions
        .as_flattened()
        .iter()
        .copied()
        .map(f64::abs)
        .fold(0.0, f64::max);
    // The effect of rounded positions on the residual force: six contacts with two rounded ends each, and a margin.
    let roundings = 16.0 * f64::EPSILON * extent * stiffness;
    let (patience, most) = (10 * usize::from(layers), 400 * usize::from(layers));
    let (mut least, mut fallen) = (f64::INFINITY, 0);
    for steps in 0..most {
        push(network, &positions, stiffness, &mut forces, &mut loads);
        if steps % LOOK == 0 {
            let out_of_balance = greatest(&loads[..moving]);
            if out_of_balance < 0.9 * least {
                (least, fallen) = (out_of_balance, steps);
            }
            let falls_no_more = steps - fallen > patience;
            if out_of_balance < ENOUGH || out_of_balance < roundings && falls_no_more {
                return Relaxed::Rest { forces, steps };
            }
            if apart(&positions, &network.positions) > 0.5 {
                return Relaxed::Collapse { steps };
            }
        }
        for ((position, velocity), load) in positions.iter_mut().zip(&mut velocities).zip(&loads) {
            for axis in 0..3 {
                velocity[axis] = kept * velocity[axis] + gained * load[axis];
                position[axis] += step * velocity[axis];
            }
        }
    }
    Relaxed::Unrest {
        steps: most,
        out_of_balance: greatest(&loads[..moving]),
    }
}

/// The approximate ω of the slowest mode, in √(k/m)/L. Piles of 10 to 40 layers relax in 30 to 50 steps for each layer.
const SLOWEST: f64 = 1.0;

/// Writes the force of every contact into `forces`, and the residual force on every sphere into `loads`.
fn push(
    network: &Network,
    positions: &[[f64; 3]],
    stiffness: f64,
    forces: &mut [f64],
    loads: &mut [[f64; 3]],
) {
    for (load, &weight) in loads.iter_mut().zip(&network.weights) {
        *load = [0.0, 0.0, weight];
    }
    for (upper, (below, forces)) in network
        .below
        .iter()
        .zip(forces.as_chunks_mut::<3>().0)
        .enumerate()
    {
        let from = positions[upper];
        for (&lower, force) in below.iter().zip(forces) {
            let to = positions[lower];
            let apart: [f64; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
            let distance = length(apart);
            *force = stiffness * (2.0 - distance).max(0.0);
            for axis in 0..3 {
                let pushed = *force * apart[axis] / distance;
                loads[upper][axis] -= pushed;
                loads[lower][axis] += pushed;
            }
        }
    }
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

fn greatest(vectors: &[[f64; 3]]) -> f64 {
    vectors.iter().copied().map(length).fold(0.0, f64::max)
}

/// Returns the largest displacement of a sphere.
fn apart(now: &[[f64; 3]], then: &[[f64; 3]]) -> f64 {
    let moved = now.iter().zip(then);
    let moved = moved.map(|(now, then)| length(std::array::from_fn(|axis| now[axis] - then[axis])));
    moved.fold(0.0, f64::max)
}
