//! The chart of the measurements: a panel for each pile, a shape for each method, a colour for each scalar.
//!
//! Besides the table of this bench it shows that of other programs, which `side_by_side` writes.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use serde::Deserialize;

/// A row of the table.
#[derive(Deserialize)]
struct Row {
    pile: String,
    contacts: u64,
    method: String,
    scalar: String,
    seconds: Option<f64>,
    relative_error: Option<f64>,
}

/// A row with numbers.
struct Mark<'a> {
    row: &'a Row,
    /// Decades of time.
    time: f64,
    /// Decades of error; `None` if every force is exact.
    error: Option<f64>,
}

/// The shapes of methods. Those of the library have filled shapes, other solvers open ones.
const METHODS: [(&str, bool, Shape); 14] = [
    (
        "closed form, table",
        true,
        Shape::Corners(&[(-4, -4), (4, -4), (4, 4), (-4, 4)]),
    ),
    ("closed form", true, Shape::Round),
    (
        "transfer",
        true,
        Shape::Corners(&[(0, -5), (5, 4), (-5, 4)]),
    ),
    (
        "exact engine",
        true,
        Shape::Corners(&[(0, -6), (6, 0), (0, 6), (-6, 0)]),
    ),
    (
        "sparse LU",
        false,
        Shape::Corners(&[(-4, -4), (4, -4), (4, 4), (-4, 4)]),
    ),
    ("CGLS", false, Shape::Round),
    (
        "springs",
        false,
        Shape::Corners(&[(-5, -4), (5, -4), (0, 5)]),
    ),
    (
        "python-flint",
        false,
        Shape::Corners(&[(0, -6), (6, 0), (0, 6), (-6, 0)]),
    ),
    (
        "SciPy LU",
        false,
        Shape::Corners(&[(-6, -3), (6, -3), (6, 3), (-6, 3)]),
    ),
    ("LAMMPS", false, Shape::Corners(&[(0, -5), (5, 4), (-5, 4)])),
    ("bounds", true, Shape::Corners(&[(-5, -4), (5, -4), (0, 5)])),
    (
        "QSopt_ex",
        false,
        Shape::Corners(&[(-5, 0), (4, -5), (4, 5)]),
    ),
    ("SCIP", false, Shape::Corners(&[(5, 0), (-4, 5), (-4, -5)])),
    (
        "HiGHS",
        false,
        Shape::Corners(&[(-3, -5), (3, -5), (6, 0), (3, 5), (-3, 5), (-6, 0)]),
    ),
];

/// The number of methods in a row of the legend.
const ACROSS: usize = 7;

/// The colours of scalars, by Okabe and Ito, which are safe for colour-blind readers.
const SCALARS: [(&str, RGBColor); 6] = [
    ("f32", RGBColor(230, 159, 0)),
    ("f64", RGBColor(0, 114, 178)),
    ("DoubleDouble", RGBColor(86, 180, 233)),
    ("Interval", RGBColor(0, 158, 115)),
    ("BigRational", RGBColor(213, 94, 0)),
    ("integers", RGBColor(204, 121, 167)),
];

const NOTES: [&str; 4] = [
    "Joined glyphs are one method at several settings.",
    "Results without an error are in the grey column, side by side. In this column only the height has a meaning.",
    "The floats of the table are forces in mg, rounded from irrational numbers. All other forces are in mg/(3 cosθ);",
    "in this unit those of straight piles are small integers, which floats represent exactly.",
];

#[derive(Clone, Copy)]
enum Shape {
    Round,
    Corners(&'static [(i32, i32)]),
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The height of the title, of a row of panels, and of the legend.
const HEAD: u32 = 60;
const PANEL: u32 = 330;
const FOOT: u32 = 188;

/// The width of the column of exact results, relative to that of the decades.
const COLUMN: f64 = 0.24;

/// The fewest decades of error in a panel.
const FEWEST_DECADES: f64 = 6.0;

/// Draws the tables as one chart at `svg`.
pub(crate) fn draw(tables: &[&Path], svg: &Path) -> Result<(), Box<dyn Error>> {
    let mut rows: Vec<Row> = Vec::new();
    for table in tables {
        for row in csv::Reader::from_path(table)?.deserialize() {
            rows.push(row?);
        }
    }
    let marks: Vec<Mark<'_>> = rows.iter().filter_map(Mark::of).collect();
    let mut piles: Vec<&str> = Vec::new();
    for mark in &marks {
        if !piles.contains(&mark.row.pile.as_str()) {
            piles.push(&mark.row.pile);
        }
    }
    let times = decades(marks.iter().map(|mark| mark.time));

    let height = HEAD + PANEL * u32::try_from(piles.len().div_ceil(2))? + FOOT;
    let page = SVGBackend::new(svg, (880, height)).into_drawing_area();
    page.fill(&WHITE)?;
    let centred = |size| {
        style(size).pos(plotters::style::text_anchor::Pos::new(
            plotters::style::text_anchor::HPos::Center,
            plotters::style::text_anchor::VPos::Top,
        ))
    };
    page.draw(&Text::new("Run time against error", (440, 12), centred(22)))?;
    let words = "All contact forces of a pile, or bounds; the error is that of the worst one over the greatest";
    page.draw(&Text::new(words, (440, 38), centred(15)))?;
    let (_, page) = page.split_vertically(HEAD);
    let (panels, foot) = page.split_vertically(height - HEAD - FOOT);
    let mut drawn = 0;
    for (pile, area) in piles
        .iter()
        .zip(panels.split_evenly((piles.len().div_ceil(2), 2)))
    {
        let marks = marks.iter().filter(|mark| mark.row.pile == **pile);
        let marks: Vec<&Mark<'_>> = marks.collect();
        drawn += panel(&area, &marks, times.clone())?;
    }
    assert_eq!(drawn, marks.len(), "a mark for each run that has numbers");
    legend(&foot)?;
    foot.present()?;
    Ok(())
}

impl<'a> Mark<'a> {
    fn of(row: &'a Row) -> Option<Self> {
        let (seconds, error) = (row.seconds?, row.relative_error?);
        Some(Self {
            row,
            time: seconds.log10(),
            error: (error > 0.0).then(|| error.log10()),
        })
    }
}

/// Draws the runs of one pile, and returns their number.
fn panel(area: &Area<'_>, marks: &[&Mark<'_>], times: Range<f64>) -> Result<usize, Box<dyn Error>> {
    let errors = decades(marks.iter().filter_map(|mark| mark.error));
    let errors = errors.start..errors.end.max(errors.start + FEWEST_DECADES);
    let column = COLUMN * (errors.end - errors.start);
    let exact = errors.start - column..errors.start;
    let first = marks[0].row;
    let title = format!("{} ({} contacts)", first.pile, first.contacts);
    let mut chart = ChartBuilder::on(area)
        .caption(title, style(15))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(54)
        .build_cartesian_2d(exact.start..errors.end, times.clone())?;
    let ends = [(exact.start, times.start), (exact.end, times.end)];
    chart.draw_series([Rectangle::new(ends, RGBColor(236, 236, 236).filled())])?;
    let power = |decade: &f64| format!("1e{decade:.0}");
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .axis_desc_style(style(14))
        .label_style(style(13))
        .x_desc("relative error")
        .y_desc("time in s")
        .x_label_formatter(&|decade| {
            if *decade < exact.end {
                String::new()
            } else {
                power(decade)
            }
        })
        .y_label_formatter(&power)
        .draw()?;
    let (x, y) = chart.backend_coord(&(exact.start, times.end));
    let (left, top) = area.get_base_pixel();
    area.draw(&Text::new(
        "0 (exact)",
        (x - left + 6, y - top + 6),
        style(12),
    ))?;
    let lanes: Vec<&Row> = {
        let rows = marks.iter().filter(|mark| mark.error.is_none());
        rows.map(|mark| mark.row).collect()
    };
    let place = |mark: &Mark<'_>| {
        let lane = lanes.iter().position(|row| std::ptr::eq(*row, mark.row));
        let part = (float(lane.unwrap_or(0)) + 1.0) / float(lanes.len() + 1);
        let x = mark.error.unwrap_or(exact.start + column * part);
        (x, mark.time)
    };
    // Runs of one method in one scalar are consecutive.
    for settings in marks.chunk_by(|a, b| key(a) == key(b)) {
        let colour = colour(&settings[0].row.scalar);
        let line = settings.iter().map(|mark| place(mark));
        if settings.iter().all(|mark| mark.error.is_some()) {
            let line: Vec<(f64, f64)> = line.collect();
            chart.draw_series([PathElement::new(line, colour.mix(0.5))])?;
        }
    }
    for mark in marks {
        let at = chart.backend_coord(&place(mark));
        shape(area, &mark.row.method, at, colour(&mark.row.scalar))?;
    }
    Ok(marks.len())
}

/// Draws the legend of shapes and colours.
fn legend(area: &Area<'_>) -> Result<(), Box<dyn Error>> {
    let (left, top) = area.get_base_pixel();
    let entry = |n: usize, y: i32, words: &str, method: &str, colour| {
        let x = 34 + 120 * i32::try_from(n).unwrap_or(0) + if n > 0 { 16 } else { 0 };
        area.draw(&Text::new(words.to_owned(), (x + 12, y - 7), style(14)))?;
        shape(area, method, (left + x, top + y), colour)
    };
    for (row, y) in METHODS.chunks(ACROSS).zip([16, 44]) {
        for (n, (method, ..)) in row.iter().enumerate() {
            entry(n, y, method, method, BLACK)?;
        }
    }
    for (n, (scalar, colour)) in SCALARS.iter().enumerate() {
        entry(n, 72, scalar, "closed form", *colour)?;
    }
    for (n, note) in NOTES.iter().enumerate() {
        let y = 96 + 20 * i32::try_from(n)?;
        area.draw(&Text::new(*note, (28, y), style(13)))?;
    }
    Ok(())
}

/// Draws a glyph at a position of the page.
fn shape(
    area: &Area<'_>,
    method: &str,
    (x, y): (i32, i32),
    colour: RGBColor,
) -> Result<(), Box<dyn Error>> {
    let (left, top) = area.get_base_pixel();
    let at = (x - left, y - top);
    let found = METHODS.iter().find(|(name, ..)| *name == method);
    let (_, filled, shape) = found.ok_or("a method without a shape")?;
    let inside = if *filled { colour } else { WHITE };
    match shape {
        Shape::Round => {
            area.draw(&Circle::new(at, 4, inside.filled()))?;
            area.draw(&Circle::new(at, 4, colour.stroke_width(2)))?;
        }
        Shape::Corners(corners) => {
            let corner = |(dx, dy): &(i32, i32)| (at.0 + dx, at.1 + dy);
            let mut corners: Vec<(i32, i32)> = corners.iter().map(corner).collect();
            area.draw(&Polygon::new(corners.clone(), inside.filled()))?;
            corners.extend_from_within(..2);
            area.draw(&PathElement::new(corners, colour.stroke_width(2)))?;
        }
    }
    Ok(())
}

fn key<'a>(mark: &Mark<'a>) -> (&'a str, &'a str) {
    (&mark.row.method, &mark.row.scalar)
}

fn colour(scalar: &str) -> RGBColor {
    let scalar = match scalar {
        "i64" => "integers",
        // The fractions of other programs.
        "rationals" => "BigRational",
        other => other,
    };
    let found = SCALARS.iter().find(|(name, _)| *name == scalar);
    found.map_or(BLACK, |(_, colour)| *colour)
}

fn style<'a>(size: i32) -> TextStyle<'a> {
    ("sans-serif", size).into_font().into()
}

fn float(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::MAX, f64::from)
}

/// Returns the decades that contain some logarithms, with a margin for glyphs at both ends.
fn decades(logarithms: impl Iterator<Item = f64>) -> Range<f64> {
    let ends = logarithms
        .map(|x| (x, x))
        .reduce(|(a, b), (x, _)| (a.min(x), b.max(x)));
    let (least, most) = ends.unwrap_or((-16.0, 0.0));
    (least - 0.5).floor()..(most + 0.5).ceil()
}
