//! A layer as a map, with a coloured cell for each sphere.

use cannonpile::lattice::Site;
use cannonpile::scalar::Surd;

use super::caption::caption;
use super::colour::{PALE, Scale, WHITE};
use super::glyph::{Glyph, cross, fitting, polygon, text, width};
use super::layer::Layer;
use super::page::{Bar, Figure};
use super::panel::{BAR, Panel, WIDTH};
use super::subject::{Subject, nearest};
use super::ticks::digits;
use crate::Error;

/// The vertical forces of the spheres of a layer, in row order.
pub(super) struct Map<'a> {
    pub(super) layer: Layer,
    pub(super) title: String,
    pub(super) name: &'static str,
    pub(super) forces: Vec<Surd>,
    pub(super) scale: fn(&[f64]) -> Scale,
    pub(super) note: Option<String>,
    /// The spheres with a cross.
    pub(super) crossed: Vec<Site>,
    /// The meaning of the crosses.
    pub(super) cross_label: &'a str,
}

/// The largest number of characters of the attribute `data-exact`. Longer exact numbers are left out.
const LONGEST: usize = 60;

impl Map<'_> {
    /// Returns the figure: cells are `<polygon class="cell" data-value="…" data-exact="…">`.
    pub(super) fn figure(self, subject: &Subject<'_>) -> Result<Figure, Error> {
        let layer = &self.layer;
        let panel = layer.panel(1.5, BAR).with_page_end(262.0);
        let mut values = Vec::new();
        for force in &self.forces {
            values.push(nearest(force, "a force")?);
        }
        let scale = (self.scale)(&values);
        let across = panel.length(layer.apart());
        let rim_colour = if scale.is_around_zero() { PALE } else { WHITE };
        // The rim of a small cell is thin, so that it does not hide the cell.
        let rim = (across * 0.04).min(1.2);
        let mut glyphs = Vec::new();
        let cells = layer.spheres.iter().zip(self.forces.iter().zip(&values));
        for ((site, at), (exact, value)) in cells {
            let mut cell = polygon(&layer.cell(&panel, *at)).class("cell").of(*site);
            let text = exact.to_string();
            if text.len() <= LONGEST {
                cell = cell.set("data-exact", text);
            }
            let cell = cell
                .with_value("data-value", *value)
                .fill(scale.colour(*value));
            glyphs.push(cell.stroke(rim_colour, rim).set("stroke-linejoin", "round"));
        }
        glyphs.extend(self.numbers(&panel, &values, &scale));
        for site in &self.crossed {
            let at = layer.place(subject, *site)?;
            glyphs.extend(cross(panel.at(at), across * 0.12));
        }
        if !self.crossed.is_empty() {
            let [x, y] = [WIDTH - 116.0, panel.bottom() + 38.0];
            glyphs.extend(cross([x, y], 6.0));
            glyphs.push(text([x + 13.0, y], 14.0, self.cross_label).start());
        }
        let bar = Bar {
            scale,
            name: self.name,
            unit: subject.force_unit(),
            remarks: Vec::new(),
        };
        Ok(Figure {
            note: self.note,
            axes: Some(layer.axes(subject)?),
            bar: Some(bar),
            ..Figure::new(self.title, caption(subject)?, panel, glyphs)
        })
    }

    /// Returns the numbers in the cells. Zeros have no label, and small cells have no numbers.
    fn numbers(&self, panel: &Panel, values: &[f64], scale: &Scale) -> Vec<Glyph> {
        const LEAST: f64 = 26.0;
        let across = panel.length(self.layer.apart());
        if across < LEAST {
            return Vec::new();
        }
        let size = (across * 0.27).min(14.0);
        let Some(texts) = texts(&self.forces, values, across * 0.86 / size) else {
            return Vec::new();
        };
        let cells = self.layer.spheres.iter().zip(values).zip(texts);
        let shown = cells.filter(|(_, text)| !text.is_empty());
        let label = |(((_, at), value), words): ((&(Site, [f64; 2]), &f64), String)| {
            let size = fitting(&words, size, across * 0.86);
            text(panel.at(*at), size, words).fill(scale.text_colour(*value))
        };
        shown.map(label).collect()
    }
}

/// Returns the numbers as texts of at most the width `room`, in units of the font size.
///
/// All numbers are exact if they fit. Otherwise all have the same number of decimals, as many as fit, with at most four
/// digits. A number other than 0 shows at least one nonzero digit. The result is `None` if no such texts fit.
pub(super) fn texts(exact: &[Surd], values: &[f64], room: f64) -> Option<Vec<String>> {
    let fits = |text: &String| width(text, 1.0) < room;
    let shown = |show: &dyn Fn(&Surd, f64) -> String| -> Vec<String> {
        let numbers = exact.iter().zip(values);
        let text = |(exact, value): (&Surd, &f64)| match *value {
            0.0 => String::new(),
            value => show(exact, value).replace('-', "−"),
        };
        numbers.map(text).collect()
    };
    let whole = shown(&|exact, _| exact.to_string());
    if whole.iter().all(fits) {
        return Some(whole);
    }
    let greatest = values
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    let decimals = (0..=9_u8)
        .rev()
        // The largest number shows at least two significant digits.
        .filter(|places| (10.0..10_000.0).contains(&(greatest * 10_f64.powi((*places).into()))))
        .map(|places| {
            let least = 0.5 * 10_f64.powi(-i32::from(places));
            shown(&|exact, value| {
                if value.abs() >= least {
                    return format!("{value:.*}", usize::from(places));
                }
                let exact = exact.to_string();
                if fits(&exact) {
                    exact
                } else {
                    digits(value, 1)
                }
            })
        });
    let is_plain = |value: &f64| value.abs() >= 1e-3;
    // A number below 1e-3 has a power of ten. It may exceed `room`, because it is then set in a smaller font.
    let all_fit = |texts: &Vec<String>| {
        let mut texts = texts.iter().zip(values);
        texts.all(|(text, value)| fits(text) || !is_plain(value))
    };
    decimals.into_iter().find(all_fit)
}
