//! A layer as a map: one coloured cell a sphere.

use super::canvas::{Canvas, Drawing, Label, line, polygon};
use super::colour::{BLACK, GREY, Scale, WHITE};
use super::layer::Layer;
use super::of;
use super::panel::{Margins, Panel};
use super::ticks::exact_or_short;
use crate::lattice::Site;
use crate::scalar::Surd;

/// A sphere and a force.
#[derive(Clone, Debug, PartialEq)]
pub struct MapCell {
    /// The sphere.
    pub site: Site,
    /// The force, rounded once.
    pub value: f64,
    /// The force.
    pub exact: Surd,
}

/// What a map says around its cells.
pub(super) struct Words<'a> {
    pub(super) title: &'a str,
    pub(super) caption: &'a str,
    /// Of the colours.
    pub(super) name: &'a str,
    pub(super) unit: &'a str,
}

/// A map: cells are `<polygon class="cell" data-value="…">`.
pub(super) fn draw(layer: &Layer, cells: &[MapCell], scale: &Scale, words: &Words<'_>) -> Drawing {
    let panel = Panel::fitting(layer.bounds(), Margins::BAR);
    let mut canvas = Canvas::new(panel.page_height().max(340.0), words.title, words.caption);
    layer.axes(&panel, &mut canvas);
    let across = panel.length(layer.apart());
    // A rim that does not hide small cells.
    let rim = (across * 0.04).min(1.2);
    for (place, cell) in layer.places.iter().zip(cells) {
        let colour = scale.colour(cell.value);
        let mark = polygon(&layer.cell(&panel, place.at))
            .set("class", "cell")
            .set("data-value", format!("{:?}", cell.value))
            .set("fill", colour.to_string())
            .set(
                "stroke",
                if scale.is_around_zero() { GREY } else { WHITE }.to_string(),
            )
            .set("stroke-width", rim)
            .set("stroke-linejoin", "round");
        canvas.add(of(cell.site, mark));
    }
    // Over all cells, where there is room.
    for (place, cell) in layer.places.iter().zip(cells) {
        let text = exact_or_short(&cell.exact.to_string(), cell.value);
        let label = Label::new(text).size((across * 0.3).min(14.0));
        if across > 26.0 && label.width() < across * 0.92 {
            let ink = scale.colour(cell.value).ink();
            canvas.add(label.colour(ink).at(panel.at(place.at)));
        }
    }
    panel.bar(&mut canvas, scale, words.name, words.unit);
    canvas.finish()
}

/// The floor as a line below what stands on it.
pub(super) fn floor(canvas: &mut Canvas, panel: &Panel, v: f64) {
    let [left, right] = panel.sides();
    let [_, y] = panel.at([0.0, v]);
    canvas.add(line([left, y], [right, y], BLACK, 1.5).set("class", "floor"));
}
