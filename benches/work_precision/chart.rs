//! The chart of run times and errors: `cargo bench --manifest-path benches/Cargo.toml --bench chart --features chart` draws
//! `chart.svg` from the CSV files beside it. Nothing is measured. With `-- --smoke` it checks that `chart.svg` is up to date.

use std::env;
use std::fmt::Write;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;

/// A row of `results.csv` or `peers.csv`.
#[derive(Deserialize)]
struct Run {
    pile: String,
    contacts: f64,
    method: String,
    scalar: String,
    setting: String,
    seconds: Option<f64>,
    relative_error: Option<f64>,
}

/// A row of `errors.csv`.
#[derive(Deserialize)]
struct Growth {
    stacking: String,
    layers: f64,
    format: String,
    error: f64,
    probable: Option<f64>,
    proved: Option<f64>,
}

const STRAIGHT: [&str; 4] = [
    "straight, 10 layers",
    "straight, 20 layers",
    "straight, 40 layers",
    "straight, 80 layers",
];
const HCP: [&str; 2] = [
    "HCP, 4 layers, 12 a side on top",
    "HCP, 40 layers, 8 a side on top",
];

// Colours by Okabe and Ito, some of them darker, which colour-blind readers can tell apart.
const BLUE: &str = "#0072b2";
const RED: &str = "#d55e00";
const AMBER: &str = "#c28a00";
const GREEN: &str = "#007a5a";
const PURPLE: &str = "#a8508a";
const GREY: &str = "#555";

/// A method, scalar and setting; its colour; its label, with the place relative to the last pile.
struct Method([&'static str; 3], &'static str, &'static str, [f64; 2]);

const METHODS: [Method; 9] = [
    Method(
        ["closed form, table", "i64", ""],
        BLUE,
        "integers",
        [-14.0, 18.0],
    ),
    Method(
        ["exact engine", "integers", ""],
        BLUE,
        "rationals",
        [-33.0, -14.0],
    ),
    Method(
        ["python-flint", "rationals", ""],
        GREEN,
        "python-flint",
        [-50.0, -10.0],
    ),
    Method(["closed form, table", "f64", ""], BLUE, "f64", [-28.0, 4.0]),
    Method(["closed form, table", "f32", ""], BLUE, "f32", [8.0, 4.0]),
    Method(["SciPy LU", "f64", ""], RED, "SciPy, LU", [-30.0, -9.0]),
    Method(["sparse LU", "f64", ""], AMBER, "faer, LU", [32.0, 10.0]),
    Method(
        ["CGLS", "f64", "residual 1e-9"],
        GREY,
        "conjugate gradients",
        [-54.0, -10.0],
    ),
    Method(
        ["LAMMPS", "f64", "stiffness 1"],
        PURPLE,
        "LAMMPS",
        [-24.0, -10.0],
    ),
];

/// The pixels and the decades of both ends of an axis.
type Axis = [[f64; 2]; 2];

fn main() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("work_precision");
    let mut runs: Vec<Run> = rows(&folder.join("results.csv"));
    runs.extend(rows(&folder.join("peers.csv")));
    let mut page = Page(HEAD.into());
    page.times(&runs);
    page.growth(&rows(&folder.join("errors.csv")));
    page.0 += "</svg>\n";
    let file = folder.join("chart.svg");
    if env::args().any(|argument| argument == "--smoke") {
        let drawn = std::fs::read_to_string(file).expect("the chart");
        assert!(drawn == page.0, "chart.svg is not that of the tables");
    } else {
        std::fs::write(file, page.0).expect("a place for the chart");
    }
}

fn rows<T: DeserializeOwned>(file: &Path) -> Vec<T> {
    let mut table = csv::Reader::from_path(file).expect("a table");
    table.deserialize().map(|row| row.expect("a row")).collect()
}

const HEAD: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 440" font-family="Helvetica, Arial, sans-serif" font-size="13" fill="#222">
<rect width="800" height="440" fill="#fff"/>
"##;

/// The picture so far.
struct Page(String);

impl Page {
    /// Draws run times against errors, with a band for exact answers.
    fn times(&mut self, runs: &[Run]) {
        const X: Axis = [[150.0, 400.0], [-16.6, -5.2]];
        const Y: Axis = [[380.0, 72.0], [-9.4, -1.5]];
        self.put(r##"<rect x="56" y="72" width="88" height="308" fill="#eee"/>"##);
        self.title(
            56.0,
            "Time and error by method",
            "larger dots: more layers (straight, 10 to 80); rings: HCP, 4 and 40",
        );
        for (decade, name) in [(-9.0, "1 ns"), (-6.0, "1 µs"), (-3.0, "1 ms")] {
            let y = pixel(Y, decade);
            self.line(&[[56.0, y], [400.0, y]], "#ddd", "1");
            self.text([52.0, y + 4.0], "end", "#222", name);
        }
        self.text(
            [14.0, 226.0],
            "middle\" transform=\"rotate(-90 14 226)",
            "#222",
            "time for each force",
        );
        for (decade, name) in [(-16.0, "10⁻¹⁶"), (-12.0, "10⁻¹²"), (-8.0, "10⁻⁸")] {
            let x = pixel(X, decade);
            self.line(&[[x, 72.0], [x, 380.0]], "#ddd", "1");
            self.text([x, 396.0], "middle", "#222", name);
        }
        self.text([100.0, 396.0], "middle", "#222", "0 (exact)");
        self.text(
            [275.0, 422.0],
            "middle",
            "#222",
            "relative error of the worst force",
        );
        for (n, method) in METHODS.iter().enumerate() {
            let Method(_, colour, label, [dx, dy]) = method;
            let lane = 74.0 + 26.0 * [0.0, 1.0, 2.0].get(n).unwrap_or(&0.0);
            let place = |(seconds, error): (f64, f64)| {
                let x = if error > 0.0 {
                    pixel(X, error.log10())
                } else {
                    lane
                };
                [x, pixel(Y, seconds.log10())]
            };
            let dots: Vec<[f64; 2]> = method.runs(runs, &STRAIGHT).map(place).collect();
            self.line(&dots, colour, "1.5");
            for (n, dot) in dots.iter().enumerate() {
                self.dot(*dot, [2.0, 2.8, 3.6, 4.4][n], colour, colour);
            }
            let [x, y] = *dots.last().expect("a run");
            self.text([x + dx, y + dy], "start", colour, label);
        }
        for method in METHODS
            .iter()
            .filter(|method| method.0[0].contains("LU"))
            .chain([&Method(["transfer", "f64", ""], BLUE, "", [0.0; 2])])
        {
            let place =
                |(seconds, error): (f64, f64)| [pixel(X, error.log10()), pixel(Y, seconds.log10())];
            let dots: Vec<[f64; 2]> = method.runs(runs, &HCP).map(place).collect();
            self.line(&dots, method.1, "1.5\" stroke-dasharray=\"4 3");
            for (n, dot) in dots.iter().enumerate() {
                self.dot(*dot, [2.6, 4.0][n], "#fff", method.1);
            }
        }
        self.text([194.0, 352.0], "start", BLUE, "HCP");
        let library = r#"<tspan font-weight="bold">this library</tspan>"#;
        self.text([240.0, 360.0], "start", BLUE, library);
    }

    /// Draws the errors of four formats against the number of layers, with their bounds.
    fn growth(&mut self, rows: &[Growth]) {
        const X: Axis = [[470.0, 724.0], [0.9, 3.08]];
        const Y: Axis = [[380.0, 72.0], [0.0, 7.6]];
        self.title(
            470.0,
            "Rounding errors by layers",
            "worst contact of HCP, in u = 2⁻ᵖ of the greatest force",
        );
        for (decade, name) in [(0.0, "1"), (2.0, "100"), (4.0, "10⁴"), (6.0, "10⁶")] {
            let y = pixel(Y, decade);
            self.line(&[[470.0, y], [724.0, y]], "#ddd", "1");
            self.text([465.0, y + 4.0], "end", "#222", name);
        }
        for layers in [10.0_f64, 100.0, 1000.0] {
            let x = pixel(X, layers.log10());
            self.text([x, 396.0], "middle", "#222", &layers.to_string());
        }
        self.text([597.0, 422.0], "middle", "#222", "layers");
        let at = |layers: f64, error: f64| [pixel(X, layers.log10()), pixel(Y, error.log10())];
        let of = |format: &str, value: fn(&Growth) -> Option<f64>| {
            let rows = rows
                .iter()
                .filter(|row| row.stacking == "HCP" && row.format == format);
            let dots = rows.filter_map(|row| Some(at(row.layers, value(row)?)));
            dots.collect::<Vec<_>>()
        };
        self.line(
            &[at(10.0, 10.0_f64.sqrt()), at(1000.0, 1000.0_f64.sqrt())],
            GREY,
            "1.5\" stroke-dasharray=\"2 3",
        );
        self.line(&of("f64", |row| row.proved), GREY, "2");
        self.line(&of("f64", |row| row.probable), GREY, "2");
        for ([x, y], words) in [
            ([580.0, 176.0], "proved bound"),
            ([600.0, 290.0], "99 % probable"),
            ([745.0, 330.0], "√L"),
        ] {
            self.text([x, y], "end", GREY, words);
        }
        // The two half precisions end beside one another.
        let halves = format!(r#"f16, <tspan fill="{PURPLE}">bf16</tspan>"#);
        for (format, colour, label, dy) in [
            ("bf16", PURPLE, "", 0.0),
            ("f16", GREEN, halves.as_str(), -11.0),
            ("f32", RED, "f32", 5.0),
            ("f64", BLUE, "f64", 11.0),
        ] {
            let dots = of(format, |row| Some(row.error));
            self.line(&dots, colour, "1.5");
            for dot in &dots {
                self.dot(*dot, 3.0, colour, colour);
            }
            let [x, y] = *dots.last().expect("a row");
            self.text([x + 8.0, y + dy], "start", colour, label);
        }
    }

    fn title(&mut self, x: f64, title: &str, words: &str) {
        self.text(
            [x, 24.0],
            "start\" font-size=\"16\" font-weight=\"bold",
            "#222",
            title,
        );
        self.text([x, 46.0], "start\" font-size=\"12", "#222", words);
    }

    fn line(&mut self, dots: &[[f64; 2]], colour: &str, width: &str) {
        let dots: Vec<String> = dots.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let dots = dots.join(" ");
        self.put(&format!(
            r#"<polyline points="{dots}" fill="none" stroke="{colour}" stroke-width="{width}"/>"#
        ));
    }

    fn dot(&mut self, [x, y]: [f64; 2], radius: f64, inside: &str, colour: &str) {
        self.put(&format!(
            r#"<circle cx="{x:.1}" cy="{y:.1}" r="{radius}" fill="{inside}" stroke="{colour}"/>"#
        ));
    }

    fn text(&mut self, [x, y]: [f64; 2], anchor: &str, colour: &str, words: &str) {
        self.put(&format!(
            r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}" fill="{colour}">{words}</text>"#
        ));
    }

    fn put(&mut self, element: &str) {
        writeln!(self.0, "{element}").expect("memory");
    }
}

impl Method {
    /// Returns the time of each force and the error, pile by pile.
    fn runs<'r>(
        &'r self,
        runs: &'r [Run],
        piles: &'r [&str],
    ) -> impl Iterator<Item = (f64, f64)> + 'r {
        let of = |pile: &str| {
            let mut runs = runs.iter().filter(move |run| run.pile == pile);
            runs.find(|run| self.0 == [&run.method, &run.scalar, &run.setting].map(String::as_str))
        };
        piles.iter().filter_map(move |pile| {
            let run = of(pile)?;
            Some((run.seconds? / run.contacts, run.relative_error?))
        })
    }
}

fn pixel([[from, to], [first, last]]: Axis, decade: f64) -> f64 {
    from + (to - from) * (decade - first) / (last - first)
}
