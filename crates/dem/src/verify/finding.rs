//! Explanations of many differences at once.

use core::fmt;

/// An explanation of the differences between measured and exact forces, with a remedy.
///
/// It is a guess at the cause, and is reported only if it explains most of the error.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Finding {
    /// The kind of the fault.
    pub kind: FindingKind,
    /// The explanation, as [`Display`](fmt::Display) writes it.
    pub text: String,
}

/// The kind of a fault that a [`Finding`] explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FindingKind {
    /// Contacts with a force were measured as 0.
    Zero,
    /// All measured contacts with a force were measured as 0.
    AllZero,
    /// Forces differ from the lengths of their vectors.
    Disagreement,
    /// Two rows of one pair have different forces.
    Contradiction,
    /// The measured normal forces of the floor differ from the exact ones.
    Floor,
    /// All measured forces equal the exact ones times one factor. Forces of 0 are left out.
    Factor,
    /// The vectors are the exact normal forces only less the tangential forces.
    Whole,
    /// Numbers have so few digits that rounding explains all errors.
    Digits,
    /// Springs of one stiffness explain the errors.
    Springs,
    /// Gravity leans.
    Lean,
    /// The vertical parts of all forces have one factor, and the horizontal ones another: the spacing, or all diameters.
    Spacing,
    /// The contacts of one sphere carry another weight.
    Weight,
    /// Forces balance, but have other directions: a diameter, or a position.
    Size,
    /// Normal forces do not carry the weights, in all layers, and no tangential force is listed.
    Rubbing,
    /// The forces on most spheres do not balance.
    Motion,
    /// The exact forces need tension, and such contacts are open.
    Unstable,
    /// All vectors are the forces on the second sphere of the pair instead of the first.
    SecondSphere,
    /// All vectors agree with the exact ones after a permutation of the axes, possibly with reversed axes.
    Axes,
    /// All contacts between a layer and the next one below are missing.
    Layer,
    /// Forces have a tangential part.
    Tangential,
    /// Tangential forces between spheres are wrong, on a rough floor.
    Friction,
    /// The friction of a rough floor is wrong.
    FloorFriction,
    /// The horizontal forces on a sphere balance, but the moments about its centre do not.
    Moment,
    /// Rows lack the tangential force, so they are not judged.
    Unknown,
    /// Bottom spheres have no row with the force of the floor.
    OffFloor,
    /// Spheres above the bottom layer touch the floor.
    Fallen,
}

impl Finding {
    pub(super) fn new(kind: FindingKind, text: impl Into<String>) -> Self {
        let text = text.into();
        Self { kind, text }
    }

    /// Returns the explanation of a common factor, with the error that is left.
    pub(super) fn factor((factor, left): (f64, f64)) -> Self {
        let near = |value: f64| (factor / value - 1.0).abs() < 2e-3;
        let power = factor.abs().log10();
        let cause = if near(-1.0) {
            "are tensile forces positive in the table?"
        } else if near(9.81) || near(1.0 / 9.81) {
            "is gravity 9.81 m/s² in one and 1 m/s² in the other?"
        } else if near(2.0) || near(0.5) {
            "does the mass differ by a factor of 2?"
        } else if (power - power.round()).abs() < 1e-6 {
            "are the units those of the scene (N, kg, m)?"
        } else {
            "do mass, gravity or spacing differ from the scene?"
        };
        let left = rounded(left, 0);
        let text = format!("all forces are {factor:?} times the exact ones, to {left:?}: {cause}");
        Self::new(FindingKind::Factor, text)
    }

    /// Returns whether this is a fault of the table or of the pile that says nothing about the simulation.
    pub(super) fn hides_others(&self) -> bool {
        use FindingKind::{AllZero, Axes, Digits, Disagreement, SecondSphere, Unstable, Whole};
        [
            AllZero,
            Axes,
            Digits,
            Disagreement,
            SecondSphere,
            Unstable,
            Whole,
        ]
        .contains(&self.kind)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// Returns a number with four digits.
pub(super) fn short(number: f64) -> f64 {
    rounded(number, 3)
}

fn rounded(number: f64, decimals: usize) -> f64 {
    let text = format!("{number:.decimals$e}");
    // Every float that is written can be read.
    text.parse().unwrap_or(number)
}

/// Returns a count with its noun.
pub(super) fn counted(count: u64, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}
