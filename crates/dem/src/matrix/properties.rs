//! The properties of the matrix: its determinant, condition number and singular values.

use cannonpile_accuracy::{condition_bound, condition_number, singular_values};
use num_rational::BigRational;
use num_traits::ToPrimitive;
use serde_json::{Value as Json, json};

use super::Equations;
use crate::Error;

/// The maximal number of layers of a pile whose singular values are listed.
const MOST_LAYERS: i128 = 400;

impl Equations<'_, '_> {
    /// Returns the properties as JSON.
    pub(in super::super) fn properties(self, scene: Option<&str>) -> Result<Json, Error> {
        let (packing, pile) = (self.pile.packing(), self.pile.pile());
        let (shape, lines, scale) = (pile.shape(), self.lines(), self.scale());
        let (n, unit) = (self.unknowns(), packing.unit_force());
        // The directions below a sphere are orthogonal at a = √2 R.
        let right = BigRational::from_integer((lines - 1).into());
        let is_known = !self.in_si || pile.is_regular() && packing.inclination().tan2() == right;
        let condition = is_known.then(|| condition_number(shape)).flatten();
        let odd = 2 * shape.layers() - 1;
        let listed = (is_known && shape.layers() <= MOST_LAYERS).then_some(shape);
        let listed = listed.into_iter().flat_map(singular_values);
        let listed = listed.map(|value| json!({
            "formula": format!("{}*cos({}*pi/{})", 2 * scale, value.index(), 2 * value.chain_length() + 1),
            "float": f64::from(scale) * value.value(),
            "multiplicity": value.multiplicity().to_u64(),
        }));
        Ok(json!({
            "unknowns": n.to_u64(),
            "entries": self.entries()?.to_u64(),
            "equations": "equilibrium.mtx * forces = loads.mtx / denominator",
            "denominator": self.denominator().to_string(),
            "scale": scale,
            "unit": self.unit(),
            "f0_in_newtons": { "exact": unit.to_string(), "float": unit.nearest::<f64>() },
            "determinant": (!self.in_si).then(|| format!("{scale}^{n}")),
            "condition_number": condition.map(|float| json!({
                "formula": format!("cos(pi/{odd})/sin(pi/{})", 2 * odd), "float": float })),
            "condition_number_at_most": condition.or_else(|| condition_bound(packing)),
            "singular_values": {
                "formula": is_known.then(|| format!(
                    "{} cos(j pi/(2 m + 1)), j = 1 to m, {lines} (N_k - N_(k-1)) times for each layer k with supports and N_k spheres, \
                     m = {} - k", 2 * scale, shape.layers() - 1
                )),
                "list": listed.collect::<Vec<_>>(),
            },
            "scene": scene,
        }))
    }
}
