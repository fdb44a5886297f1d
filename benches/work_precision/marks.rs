//! How methods and scalars look: a shape for a method, a colour for a scalar.

use plotters::style::RGBColor;

use crate::run::Method;

/// Half the size of a mark, in pixels.
pub(crate) const SIZE: i32 = 5;

/// The palette of Okabe and Ito, which the colour-blind can tell apart.
pub(crate) fn colour(scalar: &str) -> RGBColor {
    match scalar {
        "f32" => RGBColor(230, 159, 0),
        "f64" => RGBColor(0, 114, 178),
        "DoubleDouble" => RGBColor(86, 180, 233),
        "Interval" => RGBColor(0, 158, 115),
        "BigRational" => RGBColor(213, 94, 0),
        "i64" | "integers" => RGBColor(204, 121, 167),
        _ => RGBColor(0, 0, 0),
    }
}

/// The outlines of a method's mark around (0, 0), and whether they are filled: what is computed from formulas is, what
/// solves equations is not.
pub(crate) fn strokes(method: Method) -> (bool, Vec<Vec<(i32, i32)>>) {
    let s = SIZE;
    let plus = [vec![(-s, 0), (s, 0)], vec![(0, -s), (0, s)]];
    let cross = [vec![(-s, -s), (s, s)], vec![(-s, s), (s, -s)]];
    match method {
        Method::Table => (true, vec![vec![(-s, -s), (s, -s), (s, s), (-s, s)]]),
        // Close to round.
        Method::Closed => (
            true,
            vec![vec![
                (-s, -2),
                (-2, -s),
                (2, -s),
                (s, -2),
                (s, 2),
                (2, s),
                (-2, s),
                (-s, 2),
            ]],
        ),
        Method::Transfer => (true, vec![vec![(0, -s - 1), (s, s - 1), (-s, s - 1)]]),
        Method::Engine => (
            true,
            vec![vec![(0, -s - 2), (s + 2, 0), (0, s + 2), (-s - 2, 0)]],
        ),
        Method::Lu => (false, plus.into()),
        Method::Gradients => (false, cross.into()),
        Method::Springs => (false, vec![vec![(-s, -s), (s, -s), (0, s), (-s, -s)]]),
    }
}
