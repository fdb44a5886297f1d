//! The data of a viewer.

use cannonpile::lattice::{Axis, Dimension, Site};
use cannonpile_dem::scene::State;
use cannonpile_dem::weights::{nearest_rational, ordinary_weight};
use cannonpile_dem::{CardTitle, Error, NumberedPile, anchor, stacking};
use colorous::{Gradient, RED_BLUE, VIRIDIS};
use serde_json::{Value, json};

use super::places::rows;
use super::states::{Quantities, states};
use crate::caption::tilt;
use crate::subject::spacing;

/// The number of intervals between the colours of a map. The program interpolates within them.
const COLOURS: u32 = 64;

/// Returns the data of a pile as JSON.
pub(super) fn of(
    pile: &NumberedPile<'_>,
    title: &CardTitle,
    heading: &str,
    scene: Option<&str>,
) -> Result<Value, Error> {
    let (packing, of_pile) = (pile.packing(), pile.pile());
    let directions = of_pile.dimension().directions().iter();
    let mut quantities = Quantities::of(pile);
    let states = states(pile, title, &mut quantities)?;
    let anchor = (of_pile.dimension() == Dimension::Three).then(|| anchor(of_pile.shape()));
    let ratio = title.stiffness_ratio.as_ref().map(ToString::to_string);
    Ok(json!({
        "program": concat!("cannonpile ", env!("CARGO_PKG_VERSION")),
        "title": heading,
        "purpose": title.purpose,
        "scene": scene,
        "dimension": of_pile.dimension().number(),
        "layers": of_pile.layers().to_string(),
        "stacking": stacking(of_pile),
        "anchor": anchor.flatten(),
        "spheres": pile.numbering().sphere_count(),
        "contacts": pile.contact_count().to_string(),
        "weightless": of_pile.is_weightless(),
        "tilt": tilt(of_pile),
        "spacing": spacing(packing)?.ratio().to_string(),
        "stiffness_ratio": ratio,
        "touching": neighbours_touch(pile, title),
        "radius": nearest_rational(packing.radius(), "the radius")?,
        "directions": directions.map(|direction| direction.name()).collect::<Vec<_>>(),
        "axes": Axis::ALL.map(Axis::name),
        "rows": rows(pile)?,
        "weight": ordinary_weight(of_pile).to_string(),
        "special": special(pile)?,
        "quantities": quantities.to_json()?,
        "states": states,
        "colours": { "rising": map(VIRIDIS), "diverging": map(RED_BLUE) },
    }))
}

/// Returns whether all neighbours in a layer touch. If they do, a horizontal contact without a force is open.
fn neighbours_touch(pile: &NumberedPile<'_>, title: &CardTitle) -> bool {
    let touches = pile
        .packing()
        .touching()
        .iter()
        .any(|apart| apart.layers == 0);
    let of_pile = pile.pile();
    let all = of_pile.dimension() == Dimension::Two || of_pile.is_regular();
    title.state == State::Elastic || of_pile.horizontal_forces().len() > 0 || touches && all
}

/// Returns the spheres with a weight of their own or a load, as `[id, weight, load]`. Weights and vertical loads are in mg.
fn special(pile: &NumberedPile<'_>) -> Result<Vec<Value>, Error> {
    let of_pile = pile.pile();
    let loads = of_pile.loads().map(|(site, _)| site);
    let mut sites: Vec<Site> = loads
        .chain(of_pile.weights().map(|(site, _)| site))
        .collect();
    sites.sort_unstable();
    sites.dedup();
    let sites = sites.into_iter().map(|site| {
        let weight = of_pile.sphere_weight(site)?.to_string();
        let load = of_pile.load(site)?;
        let unit = if load.is_zero() || !load.is_vertical() {
            ""
        } else {
            " mg"
        };
        Ok(json!([
            pile.numbering().id(site)?,
            weight,
            format!("{load}{unit}")
        ]))
    });
    sites.collect()
}

/// Returns the colours of a map, from the smallest to the largest value, with six hexadecimal digits each.
fn map(gradient: Gradient) -> String {
    let colours = 0..=COLOURS;
    let colours = colours.map(|n| gradient.eval_continuous(f64::from(n) / f64::from(COLOURS)));
    colours.fold(String::new(), |map, colour| map + &format!("{colour:x}"))
}
