//! A layer as a map: one coloured cell a sphere.

use super::canvas::{Canvas, Drawing, WIDTH, line, polygon};
use super::colour::{BLACK, GREY, Scale, WHITE};
use super::label::{Hold, Label};
use super::layer::Layer;
use super::of;
use super::panel::{Margins, Panel};
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
    /// Places that are marked with a cross, as seen from above.
    pub(super) marked: &'a [[f64; 2]],
    /// What is there.
    pub(super) mark: &'a str,
}

/// A map: cells are `<polygon class="cell" data-value="…">`.
pub(super) fn draw(layer: &Layer, cells: &[MapCell], scale: &Scale, words: &Words<'_>) -> Drawing {
    let panel = Panel::fitting(layer.bounds(1.5), Margins::BAR);
    let mut canvas = Canvas::new(panel.page_height().max(340.0), words.title, words.caption);
    layer.axes(&panel, &mut canvas);
    let across = panel.length(layer.apart());
    let rim_colour = if scale.is_around_zero() {
        GREY.towards(WHITE, 0.5)
    } else {
        WHITE
    };
    // A rim that does not hide small cells.
    let rim = (across * 0.04).min(1.2);
    for (place, cell) in layer.places.iter().zip(cells) {
        let colour = scale.colour(cell.value);
        let mark = polygon(&layer.cell(&panel, place.at))
            .set("class", "cell")
            .set("data-value", format!("{:?}", cell.value))
            .set("fill", colour.to_string())
            .set("stroke", rim_colour.to_string())
            .set("stroke-width", rim)
            .set("stroke-linejoin", "round");
        canvas.add(of(cell.site, mark));
    }
    let size = (across * 0.27).min(14.0);
    for (place, (cell, text)) in layer
        .places
        .iter()
        .zip(cells.iter().zip(texts(cells, across, size)))
    {
        if text.is_empty() {
            continue;
        }
        let ink = scale.colour(cell.value).ink();
        let label = Label::new(text).size(size).colour(ink);
        canvas.add(label.at(panel.at(place.at)));
    }
    for &at in words.marked {
        cross(&mut canvas, panel.at(at), across * 0.16);
    }
    if !words.marked.is_empty() {
        let y = panel.bottom() + 38.0;
        cross(&mut canvas, [WIDTH - 116.0, y], 6.0);
        let label = Label::new(words.mark).hold(Hold::Start);
        canvas.add(label.at([WIDTH - 103.0, y]));
    }
    panel.bar(&mut canvas, scale, words.name, words.unit);
    canvas.finish()
}

/// A number for each cell: all exact, or all with as many decimals as there is room for, four digits at most; none at all in
/// small cells. Zeros are left to their colour.
fn texts(cells: &[MapCell], across: f64, size: f64) -> Vec<String> {
    const LEAST: f64 = 26.0;
    if across < LEAST {
        return Vec::new();
    }
    let fit = |texts: &Vec<String>| {
        let mut labels = texts
            .iter()
            .map(|text| Label::new(text.as_str()).size(size));
        labels.all(|label| label.width() < across * 0.86)
    };
    let shown = |show: &dyn Fn(&MapCell) -> String| -> Vec<String> {
        let text = |cell: &MapCell| {
            let text = if cell.value == 0.0 {
                String::new()
            } else {
                show(cell)
            };
            text.replace('-', "−")
        };
        cells.iter().map(text).collect()
    };
    let magnitudes = cells.iter().map(|cell| cell.value.abs());
    let greatest = magnitudes.fold(0.0, f64::max);
    let decimals = (0..=9)
        .rev()
        // Two digits of the greatest are the least that says something.
        .filter(|places| (10.0..10_000.0).contains(&(greatest * 10_f64.powi(*places))))
        .filter_map(|places| usize::try_from(places).ok())
        .map(|places| shown(&|cell| format!("{:.places$}", cell.value)));
    [shown(&|cell| cell.exact.to_string())]
        .into_iter()
        .chain(decimals)
        .find(fit)
        .unwrap_or_default()
}

/// A cross.
fn cross(canvas: &mut Canvas, [x, y]: [f64; 2], half: f64) {
    for (colour, width) in [(WHITE, 3.5), (BLACK, 1.5)] {
        for side in [-half, half] {
            let stroke = line([x - half, y - side], [x + half, y + side], colour, width);
            canvas.add(stroke.set("class", "cross"));
        }
    }
}

/// The floor as a line below what stands on it.
pub(super) fn floor(canvas: &mut Canvas, panel: &Panel, v: f64) {
    let [left, right] = panel.sides();
    let [_, y] = panel.at([0.0, v]);
    canvas.add(line([left, y], [right, y], BLACK, 1.5).set("class", "floor"));
}
