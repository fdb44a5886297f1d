//! The errors of a refinement study (a [`RefinementStudy`]), and their order of accuracy.

use cannonpile_dem::verify::{Fit, Level, LevelPlace, Norm, Refinement, RefinementStudy};

use super::chart::Chart;
use super::colour::{BLUE, DIM, ORANGE, WHITE};
use super::glyph::{Glyph, Point, circle, line, polygon, text};
use super::page::Figure;
use super::ticks::digits;

/// Draws the errors of a refinement study over its parameter, on logarithmic axes.
///
/// A disc shows the largest error of a level, and a square shows its rms error. A line shows the fitted power law, over
/// the levels above the round-off floor. Glyphs are hollow for levels on the round-off floor, and for levels with
/// missing or extra contacts. A dashed line shows the largest errors that spring theory predicts. The triangle has
/// slope 1. Errors that are 0 or infinite are left out.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{RefinementStudy, Refinement, Level};
///
/// let levels = [1e4, 1e5, 1e6].map(|k| Level::of_errors(k, 495, 4.2 / k, 1.9 / k));
/// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
/// let svg = cannonpile_figure::refinement(&study).to_string();
/// assert_eq!(svg.matches("class=\"level\"").count(), 6);
/// assert!(svg.contains("largest error, order 1.000"));
/// # Ok::<(), cannonpile_dem::verify::NoRefinement>(())
/// ```
#[must_use]
pub fn refinement(study: &RefinementStudy) -> Figure {
    let refinement = study.refinement();
    let across = |level: &Level| log_h(refinement, level.parameter);
    let drawn = Norm::ALL.map(|norm| {
        let levels = study.levels().iter().zip(study.places(norm));
        let seen = levels.filter(|(level, _)| has_log(level.error(norm)));
        seen.collect::<Vec<(&Level, LevelPlace)>>()
    });
    let predicted = study.levels().iter().filter_map(|level| {
        let error = level.predicted_error.filter(|error| has_log(*error))?;
        Some([across(level), error.log10()])
    });
    let predicted: Vec<Point> = predicted.collect();
    let logs = Norm::ALL
        .into_iter()
        .zip(&drawn)
        .flat_map(|(norm, levels)| {
            let point = move |level: &Level| [across(level), level.error(norm).log10()];
            levels.iter().map(move |(level, _)| point(level))
        });
    let points = || logs.clone().chain(predicted.iter().copied());
    let mut ends = [0, 1].map(|axis| ends(points().map(|point| point[axis])));
    if points().any(|point| is_under_legend(point, ends)) {
        ends[1][1] += (ends[1][1] - ends[1][0]) * HEADROOM;
    }
    let chart = Chart::new(ends[0], ends[1]);
    let mut glyphs = triangle(&chart, ends);
    let mut legend = Vec::new();
    let fits = Norm::ALL.map(|norm| study.fit(norm).ok());
    for ((norm, fit), colour) in Norm::ALL.into_iter().zip(&fits).zip(COLOURS) {
        let fit = fit.as_ref();
        glyphs.extend(fit.and_then(|fit| fitted(&chart, study, norm, fit, colour)));
        legend.push((named(norm, fit), colour, Sample::Of(norm)));
    }
    if !predicted.is_empty() {
        let dashed = chart.curve(predicted, ORANGE).class("predicted");
        glyphs.push(dashed.set("stroke-dasharray", "7 5"));
        let name = "spring theory, largest error".to_owned();
        legend.push((name, ORANGE, Sample::Dashed));
    }
    for ((norm, levels), colour) in Norm::ALL.into_iter().zip(&drawn).zip(COLOURS) {
        for (level, place) in levels {
            let at = chart.at([across(level), level.error(norm).log10()]);
            let shape = shape(norm, at).class("level").set("data-norm", norm.name());
            let shape = shape.with_value("data-parameter", level.parameter);
            let shape = shape.with_value("data-error", level.error(norm));
            let shape = shape.set("data-place", place.name());
            let fill = if *place == LevelPlace::Above {
                colour
            } else {
                WHITE
            };
            glyphs.push(shape.fill(fill).stroke(colour, 1.5));
        }
    }
    let hollow = |(_, place): &(&Level, LevelPlace)| *place != LevelPlace::Above;
    if drawn.iter().flatten().any(hollow) {
        let name = "on the round-off floor, or contacts missing".to_owned();
        legend.push((name, COLOURS[0], Sample::Hollow));
    }
    glyphs.extend(legend_of(&chart, legend));
    let levels = study.levels().len();
    let above = study.places(Norm::Largest);
    let above = above.iter().filter(|place| **place == LevelPlace::Above);
    let (title, name) = match refinement {
        Refinement::Stiffness => ("Errors over the softness of springs", "log₁₀ 1/k"),
        Refinement::TimeStep => ("Errors over the time step", "log₁₀ Δt"),
    };
    let caption = format!(
        "{levels} levels, {} of them above the round-off floor",
        above.count()
    );
    let names = [name.into(), "log₁₀ relative error".into()];
    Figure {
        axes: Some(chart.axes(names)),
        ..Figure::new(title.into(), caption, chart.panel, glyphs)
    }
}

/// Returns log₁₀ h, where h is 1/k or Δt. The logarithm of k never overflows, although 1/k may.
fn log_h(refinement: Refinement, parameter: f64) -> f64 {
    match refinement {
        Refinement::Stiffness => -parameter.log10(),
        Refinement::TimeStep => parameter.log10(),
    }
}

fn has_log(error: f64) -> bool {
    error > 0.0 && error.is_finite()
}

/// Returns the ends of an axis with a margin around the values.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let ends = values.map(|value| [value; 2]);
    let ends = ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    // An empty chart may have any ends.
    let [least, most] = ends.unwrap_or([0.0; 2]);
    let margin = ((most - least) / 25.0).max(0.5);
    [least - margin, most + margin]
}

/// The colours of the largest errors and of the rms errors.
const COLOURS: [&str; 2] = [BLUE, DIM];

/// The height added above the data to make room for the legend, relative to the height of the chart.
const HEADROOM: f64 = 0.3;

/// Returns whether a point lies under the legend.
fn is_under_legend(point: Point, ends: [[f64; 2]; 2]) -> bool {
    let [x, y] = [0, 1].map(|n| (point[n] - ends[n][0]) / (ends[n][1] - ends[n][0]));
    x < 0.55 && y > 0.75
}

/// Returns the fitted line, from the coarsest level above the floor to the finest.
fn fitted(
    chart: &Chart,
    study: &RefinementStudy,
    norm: Norm,
    fit: &Fit,
    colour: &str,
) -> Option<Glyph> {
    let places = study.places(norm);
    let above = study.levels().iter().zip(places);
    let above = above.filter(|(_, place)| *place == LevelPlace::Above);
    let mut ends = above.map(|(level, _)| level.parameter);
    let first = ends.next()?;
    let ends = [first, ends.next_back()?].map(|parameter| {
        let error = fit.at(study.refinement().h(parameter));
        has_log(error).then(|| [log_h(study.refinement(), parameter), error.log10()])
    });
    let [Some(from), Some(to)] = ends else {
        return None;
    };
    let curve = chart.curve([from, to], colour).class("fit");
    let curve = curve.set("data-norm", norm.name());
    Some(curve.with_value("data-order", fit.order))
}

/// Returns a triangle of slope 1, in the lower right corner.
fn triangle(chart: &Chart, [across, upwards]: [[f64; 2]; 2]) -> Vec<Glyph> {
    // The side is a fifth of the shorter axis.
    let side = (across[1] - across[0]).min(upwards[1] - upwards[0]) / 5.0;
    let right = across[1] - (across[1] - across[0]) / 12.0;
    let low = upwards[0] + (upwards[1] - upwards[0]) / 10.0;
    let corners = [[right - side, low], [right, low], [right, low + side]];
    let [left, corner, top] = corners.map(|corner| chart.at(corner));
    let triangle = polygon(&[left, corner, top]).class("slope");
    let below = [left[0].midpoint(corner[0]), corner[1] + 11.0];
    let beside = [corner[0] + 10.0, corner[1].midpoint(top[1])];
    vec![
        triangle.fill("none").stroke(DIM, 1.0),
        text(below, 13.0, "1").fill(DIM),
        text(beside, 13.0, "1").fill(DIM),
    ]
}

fn shape(norm: Norm, [x, y]: Point) -> Glyph {
    const HALF: f64 = 4.5;
    if norm == Norm::Largest {
        return circle([x, y], HALF + 0.5);
    }
    polygon(&[
        [x - HALF, y - HALF],
        [x + HALF, y - HALF],
        [x + HALF, y + HALF],
        [x - HALF, y + HALF],
    ])
}

fn named(norm: Norm, fit: Option<&Fit>) -> String {
    let error = format!("{} error", norm.name());
    let Some(fit) = fit else {
        return format!("{error}, no order");
    };
    let order = format!("{error}, order {:.3}", fit.order).replace('-', "−");
    match fit.standard_error {
        // A standard error below this only reflects rounding of the last digits, so it is not shown.
        Some(error) if error >= 5e-4 => format!("{order} ± {}", digits(error, 1)),
        _ => order,
    }
}

/// The sample before a name of the legend.
enum Sample {
    Of(Norm),
    Dashed,
    Hollow,
}

/// Returns the legend, in the upper left corner. Errors that decrease with h leave this corner free.
fn legend_of(chart: &Chart, names: Vec<(String, &'static str, Sample)>) -> Vec<Glyph> {
    let left = chart.panel.left + 14.0;
    let mut y = 20.0;
    let mut glyphs = Vec::new();
    for (name, colour, sample) in names {
        let stroke = line([left, y], [left + 30.0, y], colour, 2.0);
        match sample {
            Sample::Of(norm) => {
                let glyph = shape(norm, [left + 15.0, y]).fill(colour);
                glyphs.extend([stroke, glyph]);
            }
            Sample::Dashed => glyphs.push(stroke.set("stroke-dasharray", "7 5")),
            Sample::Hollow => {
                let glyph = shape(Norm::Largest, [left + 15.0, y]).fill(WHITE);
                glyphs.push(glyph.stroke(colour, 1.5));
            }
        }
        glyphs.push(text([left + 38.0, y], 14.0, name).start());
        y += 20.0;
    }
    glyphs
}
