//! The panels of the chart, and its legend.

use super::marks::{colour, mark};
use super::{MeasuredRun, WorkPrecision};
use crate::figure::canvas::{Canvas, Drawing, HEAD, Point, line, polyline, rectangle};
use crate::figure::colour::{Colour, GREY, WHITE};
use crate::figure::label::{Hold, Label};
use crate::figure::ticks::raised;

/// Panels side by side.
const ACROSS: usize = 2;

/// The size of a panel with its title and axes.
const CELL: Point = [392.0, 330.0];

/// Within it, the corner and the size of the frame.
const CORNER: Point = [62.0, 30.0];
const FRAME: Point = [316.0, 240.0];

/// The width of the column of exact answers.
const COLUMN: f64 = 62.0;

/// The entries of the legend side by side, and the height of one.
const ENTRIES: usize = 3;
const ENTRY: f64 = 24.0;

pub(super) fn draw(measured: &WorkPrecision) -> Drawing {
    let (piles, keys) = (measured.piles(), measured.keys());
    let rows = piles.len().div_ceil(ACROSS);
    let legend = HEAD + float(rows) * CELL[1] + 10.0;
    let height = legend + float(keys.len().div_ceil(ENTRIES)) * ENTRY + 64.0;
    let mut canvas = Canvas::new(
        height,
        "Run time against error",
        "All contact forces of a pile; the error is that of the worst force over the greatest",
    );
    let scales = Scales::around(&measured.runs);
    for (n, pile) in piles.iter().enumerate() {
        let corner = [
            4.0 + float(n % ACROSS) * CELL[0] + CORNER[0],
            HEAD + float(n / ACROSS) * CELL[1] + CORNER[1],
        ];
        let runs: Vec<&MeasuredRun> = measured
            .runs
            .iter()
            .filter(|run| run.pile == *pile)
            .collect();
        let contacts = runs.first().map_or("", |run| &run.contacts);
        let panel = Panel { corner, scales };
        panel.axes(&mut canvas, &format!("{pile} ({contacts} contacts)"));
        for (lane, key) in keys.iter().enumerate() {
            let runs = runs
                .iter()
                .filter(|run| (run.method.as_str(), run.scalar.as_str()) == *key);
            let lane = (float(lane) + 0.5) / float(keys.len());
            panel.marks(&mut canvas, runs.copied(), lane);
        }
    }
    for (n, (method, scalar)) in keys.iter().enumerate() {
        let x = 40.0 + float(n % ENTRIES) * 256.0;
        let y = legend + float(n / ENTRIES) * ENTRY;
        canvas.add(mark(method, [x, y], colour(scalar)).set("class", "key"));
        let label = Label::new(format!("{method}, {scalar}")).hold(Hold::Start);
        canvas.add(label.at([x + 14.0, y]));
    }
    let notes = [
        "Joined marks are one method at several settings.",
        "Exact answers stand in the column marked 0, side by side: there only the height means anything.",
    ];
    for (n, note) in notes.into_iter().enumerate() {
        let y = height - 46.0 + float(n) * 20.0;
        canvas.add(Label::new(note).size(13.0).hold(Hold::Start).at([32.0, y]));
    }
    canvas.finish()
}

/// A count of things on a page.
fn float(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::MAX, f64::from)
}

/// The decades of error and of time in which all runs lie, the same in all panels.
#[derive(Clone, Copy)]
struct Scales {
    errors: [f64; 2],
    times: [f64; 2],
}

impl Scales {
    fn around(runs: &[MeasuredRun]) -> Self {
        let decades = |values: &mut dyn Iterator<Item = f64>, none: [f64; 2]| {
            let logarithms: Vec<f64> = values.filter(|x| *x > 0.0).map(f64::log10).collect();
            let least = logarithms.iter().copied().fold(f64::INFINITY, f64::min);
            let most = logarithms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            if logarithms.is_empty() {
                return none;
            }
            let [least, most] = [least.floor(), most.ceil()];
            [least, most.max(least + 1.0)]
        };
        let [least, most] = decades(&mut runs.iter().map(|run| run.error), [-16.0, 0.0]);
        Self {
            errors: [least - 1.0, most + 1.0],
            times: decades(&mut runs.iter().map(|run| run.seconds), [-3.0, 0.0]),
        }
    }
}

/// A panel on the page.
struct Panel {
    corner: Point,
    scales: Scales,
}

impl Panel {
    /// Where an error is, in decades.
    fn x(&self, decade: f64) -> f64 {
        let [least, most] = self.scales.errors;
        let part = (decade - least) / (most - least);
        self.corner[0] + COLUMN + part * (FRAME[0] - COLUMN)
    }

    /// Where a time is, in decades.
    fn y(&self, decade: f64) -> f64 {
        let [least, most] = self.scales.times;
        let part = (decade - least) / (most - least);
        self.corner[1] + FRAME[1] * (1.0 - part)
    }

    /// Where a run is; exact ones in their lane of the column, between 0 and 1.
    fn place(&self, run: &MeasuredRun, lane: f64) -> Point {
        let x = if run.error > 0.0 {
            self.x(run.error.log10())
        } else {
            self.corner[0] + 4.0 + (COLUMN - 8.0) * lane
        };
        [x, self.y(run.seconds.log10())]
    }

    fn marks<'a>(
        &self,
        canvas: &mut Canvas,
        runs: impl Iterator<Item = &'a MeasuredRun>,
        lane: f64,
    ) {
        let runs: Vec<(&MeasuredRun, Point)> =
            runs.map(|run| (run, self.place(run, lane))).collect();
        let Some((first, _)) = runs.first() else {
            return;
        };
        let colour = colour(&first.scalar);
        if runs.len() > 1 {
            let places: Vec<Point> = runs.iter().map(|(_, place)| *place).collect();
            canvas.add(polyline(&places, colour.towards(WHITE, 0.4), 1.2));
        }
        for (run, place) in runs {
            let mark = mark(&run.method, place, colour)
                .set("data-seconds", format!("{:e}", run.seconds))
                .set("data-error", format!("{:e}", run.error));
            canvas.add(mark);
        }
    }

    fn axes(&self, canvas: &mut Canvas, title: &str) {
        let [left, top] = self.corner;
        let [right, bottom] = [left + FRAME[0], top + FRAME[1]];
        let middle = left.midpoint(right);
        let title = Label::new(title).bold().within(CELL[0] - 12.0);
        canvas.add(title.at([middle - 12.0, top - 14.0]));
        let column = rectangle(self.corner, [COLUMN, FRAME[1]]).set("class", "exact");
        canvas.add(column.set("fill", "#ececec"));
        let thin = Colour::new(0xdd, 0xdd, 0xdd);
        for decade in decades(self.scales.errors) {
            let x = self.x(decade);
            canvas.add(line([x, top], [x, bottom], thin, 1.0));
            canvas.add(power_of_ten(decade).at([x, bottom + 14.0]));
        }
        let zero = Label::new("0 (exact)").size(12.0);
        canvas.add(zero.at([left + COLUMN / 2.0 - 4.0, bottom + 14.0]));
        for decade in decades(self.scales.times) {
            let y = self.y(decade);
            canvas.add(line([left, y], [right, y], thin, 1.0));
            let label = power_of_ten(decade).hold(Hold::End);
            canvas.add(label.at([left - 6.0, y]));
        }
        let frame = rectangle(self.corner, FRAME).set("class", "frame");
        canvas.add(frame.set("fill", "none").set("stroke", GREY.to_string()));
        let names = Label::new("relative error (1)").size(13.0);
        canvas.add(names.at([middle, bottom + 34.0]));
        let names = Label::new("time in s").size(13.0).turned();
        canvas.add(names.at([left - 46.0, top.midpoint(bottom)]));
    }
}

/// Whole decades with room for their labels, none at the lower end, where the column of exact answers is.
fn decades([least, most]: [f64; 2]) -> Vec<f64> {
    let step = ((most - least) / 8.0).ceil().max(1.0);
    let first = (least / step).floor() * step + step;
    let following = |x: &f64| Some(x + step).filter(|x| *x <= most);
    std::iter::successors(Some(first).filter(|x| *x <= most), following).collect()
}

/// 10 to a whole power.
fn power_of_ten(exponent: f64) -> Label {
    let exponent = raised(&format!("{exponent:.0}"));
    Label::new(format!("10{exponent}")).size(12.0)
}
