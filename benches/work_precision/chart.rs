//! The measurements as a chart: time against error, both logarithmic, a panel for each pile.
//!
//! No error is clamped. A logarithm has no place for 0, so exact answers stand in a column of their own, marked so, side
//! by side: there only the height means anything.

use std::error::Error;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::axis::Axis;
use crate::marks::{SIZE, colour, strokes};
use crate::run::{Measured, Method, Run};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Panel<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;

/// A method in a scalar, which has one mark in all panels.
type Key = (Method, &'static str);

/// Draws all runs that have numbers.
pub(crate) fn draw(file: &Path, runs: &[Run]) -> Result<(), Box<dyn Error>> {
    let mut piles: Vec<&str> = runs.iter().map(|run| run.pile.as_str()).collect();
    piles.dedup();
    let measured: Vec<(&Run, Measured)> = runs
        .iter()
        .filter_map(|run| Some((run, *run.outcome.as_ref().ok()?)))
        .collect();
    let mut keys: Vec<Key> = Vec::new();
    for method in Method::ALL {
        for (run, _) in measured.iter().filter(|(run, _)| run.method == method) {
            let key = (method, run.scalar);
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
    }
    let frame = Frame::around(&measured);

    let page = SVGBackend::new(file, (1560, 960)).into_drawing_area();
    page.fill(&WHITE)?;
    let (panels, legend) = page.split_horizontally(1330);
    let rows = piles.len().div_ceil(3);
    for (panel, pile) in panels.split_evenly((rows, 3)).iter().zip(piles) {
        let of_pile: Vec<_> = measured
            .iter()
            .filter(|(run, _)| run.pile == pile)
            .collect();
        let contacts = of_pile.first().map_or(0.0, |(run, _)| run.contacts);
        let title = format!("{pile} ({contacts} contacts)");
        let mut panel = frame.panel(panel, &title)?;
        for (lane, &key) in keys.iter().enumerate() {
            let of_key = of_pile
                .iter()
                .filter(|(run, _)| (run.method, run.scalar) == key);
            let points: Vec<_> = of_key
                .map(|(_, m)| frame.place(*m, lane, keys.len()))
                .collect();
            mark(&mut panel, &points, key)?;
        }
    }
    draw_legend(&legend, &keys)?;
    page.present()?;
    Ok(())
}

/// Decades of error and of time in which all points lie.
struct Frame {
    errors: [f64; 2],
    times: [f64; 2],
}

/// The width of the column of exact answers, in decades.
const COLUMN: f64 = 8.0;

impl Frame {
    fn around(measured: &[(&Run, Measured)]) -> Self {
        let decades = |values: &mut dyn Iterator<Item = f64>| {
            let logarithms: Vec<f64> = values.filter(|x| *x > 0.0).map(f64::log10).collect();
            let least = logarithms.iter().copied().fold(f64::INFINITY, f64::min);
            let most = logarithms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            [least.floor(), most.ceil()]
        };
        let [least, most] = decades(&mut measured.iter().map(|(_, m)| m.error));
        Self {
            errors: [least - 1.0, most + 1.0],
            times: decades(&mut measured.iter().map(|(_, m)| m.seconds)),
        }
    }

    /// Where a measurement is drawn, in decades; exact ones in their lane of the column.
    fn place(&self, measured: Measured, lane: usize, lanes: usize) -> (f64, f64) {
        let Measured { seconds, error } = measured;
        let x = if error > 0.0 {
            error.log10()
        } else {
            #[expect(clippy::cast_precision_loss, reason = "some twenty")]
            let part = (lane as f64 + 0.5) / lanes as f64;
            self.errors[0] - COLUMN * (1.0 - part)
        };
        (x, seconds.log10())
    }

    /// An empty panel: axes, and the column of exact answers.
    fn panel<'a, 'b>(
        &self,
        area: &'a Area<'b>,
        title: &str,
    ) -> Result<Panel<'a, 'b>, Box<dyn Error>> {
        let ([left, right], [bottom, top]) = (self.errors, self.times);
        let zero = left - COLUMN / 2.0;
        let ticks = decades(left, right, 4.0);
        let ticks = ticks
            .into_iter()
            .filter(|x| *x > left)
            .chain([zero])
            .collect();
        let mut chart = ChartBuilder::on(area)
            .caption(title, ("sans-serif", 17))
            .margin(12)
            .x_label_area_size(46)
            .y_label_area_size(62)
            .build_cartesian_2d(
                Axis {
                    ends: [left - COLUMN, right],
                    ticks,
                },
                Axis {
                    ends: [bottom, top],
                    ticks: decades(bottom, top, 1.0),
                },
            )?;
        let column = [(left - COLUMN, bottom), (left, top)];
        chart.draw_series([Rectangle::new(column, RGBColor(232, 232, 232).filled())])?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12))
            .label_style(("sans-serif", 14))
            .axis_desc_style(("sans-serif", 15))
            .x_desc("relative error of the worst force (1)")
            .y_desc("time for all forces (s)")
            .x_label_formatter(&|&x| {
                if x < left {
                    "0 (exact)".into()
                } else {
                    power_of_ten(x)
                }
            })
            .y_label_formatter(&|&y| power_of_ten(y))
            .draw()?;
        Ok(chart)
    }
}

/// The whole multiples of `step` from `least` to `most`.
fn decades(least: f64, most: f64, step: f64) -> Vec<f64> {
    let first = (least / step).ceil() * step;
    let following = |x: &f64| Some(x + step).filter(|x| *x <= most);
    std::iter::successors(Some(first), following).collect()
}

/// 10 to a whole power.
fn power_of_ten(exponent: f64) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        digit => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹']
            [digit.to_digit(10).unwrap_or(0) as usize],
    };
    let exponent = format!("{exponent:.0}");
    format!("10{}", exponent.chars().map(raised).collect::<String>())
}

/// The marks of a method in a scalar, joined by a thin line where it has several settings.
fn mark(
    panel: &mut Panel<'_, '_>,
    points: &[(f64, f64)],
    (method, scalar): Key,
) -> Result<(), Box<dyn Error>> {
    let colour = colour(scalar);
    panel.draw_series([PathElement::new(points, colour.mix(0.6))])?;
    for &point in points {
        let (filled, strokes) = strokes(method);
        for stroke in strokes {
            let at = EmptyElement::at(point);
            if filled {
                panel.draw_series([at + Polygon::new(stroke, colour.filled())])?;
            } else {
                panel.draw_series([at + PathElement::new(stroke, colour.stroke_width(2))])?;
            }
        }
    }
    Ok(())
}

/// A line for each mark, beside the panels, where no point can be.
fn draw_legend(area: &Area<'_>, keys: &[Key]) -> Result<(), Box<dyn Error>> {
    let (width, height) = area.dim_in_pixel();
    // In pixels from the upper left corner.
    let pixels = |ends| Axis {
        ends,
        ticks: Vec::new(),
    };
    let (across, up) = (pixels([0.0, width.into()]), pixels([height.into(), 0.0]));
    let mut legend = ChartBuilder::on(area).build_cartesian_2d(across, up)?;
    let mut y = 60.0;
    for &(method, scalar) in keys {
        mark(&mut legend, &[(12.0, y)], (method, scalar))?;
        let text = format!("{}, {scalar}", method.name());
        let place = (26.0, y - f64::from(SIZE));
        legend.draw_series([Text::new(text, place, ("sans-serif", 15))])?;
        y += 26.0;
    }
    let notes = [
        "CGLS: the smaller the residual",
        "asked for, the further left.",
        "springs: k = 10⁴ to 10¹⁰ mg/R.",
        "What has no mark here is",
        "accounted for in the table.",
    ];
    for note in notes {
        y += 20.0;
        legend.draw_series([Text::new(note, (4.0, y), ("sans-serif", 14))])?;
    }
    Ok(())
}
