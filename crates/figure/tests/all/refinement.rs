//! The figure of a refinement study: positions of glyphs, lines and triangle.

use cannonpile_dem::verify::{Level, Norm, Refinement, RefinementStudy};
use cannonpile_figure as figure;
use roxmltree::{Document, Node};

use crate::svg::{number, of_class};

/// Returns errors of 4/k down to a floor. The coarsest level has lost contacts.
fn stiffnesses() -> RefinementStudy {
    let levels = [1e3, 1e4, 1e5, 1e6, 1e7, 1e8].map(|k| {
        let error = 4.0 / k + 2e-15 * k;
        let missing = u64::from(k < 2e3);
        Level {
            missing,
            matched: 30 - missing,
            ..Level::of_errors(k, 30, error, error / 2.0)
        }
    });
    let study = RefinementStudy::new(Refinement::Stiffness, levels).unwrap();
    study.predicted(|k| 4.4 / k).unwrap()
}

/// Returns the middle of a disc or a square.
fn middle(mark: &Node<'_, '_>) -> [f64; 2] {
    if mark.has_tag_name("circle") {
        return ["cx", "cy"].map(|name| number(mark, name));
    }
    let corners = points(mark);
    [0, 1].map(|n| corners.iter().map(|at| at[n]).sum::<f64>() / 4.0)
}

fn points(mark: &Node<'_, '_>) -> Vec<[f64; 2]> {
    let points = mark.attribute("points").unwrap().split(' ');
    let points = points.map(|point| {
        let (x, y) = point.split_once(',').unwrap();
        [x, y].map(|n| n.parse().unwrap())
    });
    points.collect()
}

/// Returns, for each axis, the length of a factor of ten on the page and the position of h = e = 1.
fn decades(document: &Document<'_>, h: impl Fn(f64) -> f64) -> [[f64; 2]; 2] {
    let levels = of_class(document, "level");
    let log = |mark: &Node<'_, '_>| {
        let [parameter, error] = ["data-parameter", "data-error"].map(|name| number(mark, name));
        [h(parameter).log10(), error.log10()]
    };
    let (one, other) = (&levels[1], levels.last().unwrap());
    let ([a, b], [at, to]) = ([one, other].map(middle), [one, other].map(log));
    [0, 1].map(|n| {
        let decade = (b[n] - a[n]) / (to[n] - at[n]);
        [decade, a[n] - at[n] * decade]
    })
}

fn check(study: &RefinementStudy) {
    let svg = figure::refinement(study).to_string();
    let document = Document::parse(&svg).unwrap();
    let h = |parameter| study.refinement().h(parameter);
    let axes = decades(&document, h);
    let at = |h: f64, error: f64| [h, error].map(f64::log10);
    let near = |[x, y]: [f64; 2], log: [f64; 2]| {
        let place = [0, 1].map(|n| axes[n][1] + log[n] * axes[n][0]);
        assert!(
            (x - place[0]).abs() < 1e-2 && (y - place[1]).abs() < 1e-2,
            "{log:?}"
        );
    };
    // h increases to the right, and the error upwards.
    assert!(axes[0][0] > 0.0 && axes[1][0] < 0.0);
    let levels = of_class(&document, "level");
    for norm in Norm::ALL {
        let marks = levels
            .iter()
            .filter(|mark| mark.attribute("data-norm") == Some(norm.name()));
        let marks: Vec<_> = marks.collect();
        assert_eq!(marks.len(), study.levels().len());
        for ((mark, level), place) in marks.iter().zip(study.levels()).zip(study.places(norm)) {
            assert_eq!(
                number(mark, "data-parameter").to_bits(),
                level.parameter.to_bits()
            );
            assert_eq!(
                number(mark, "data-error").to_bits(),
                level.error(norm).to_bits()
            );
            assert_eq!(mark.attribute("data-place"), Some(place.name()));
            assert_eq!(
                mark.attribute("fill") == Some("#ffffff"),
                place.name() != "above"
            );
            near(middle(mark), at(h(level.parameter), level.error(norm)));
        }
        let fit = study.fit(norm).unwrap();
        let lines = of_class(&document, "fit");
        let line = lines
            .iter()
            .find(|line| line.attribute("data-norm") == Some(norm.name()));
        let line = line.unwrap();
        assert_eq!(number(line, "data-order").to_bits(), fit.order.to_bits());
        let ends = points(line);
        let places = study.places(norm);
        let above = study
            .levels()
            .iter()
            .zip(places)
            .filter(|(_, place)| place.name() == "above");
        let above: Vec<f64> = above.map(|(level, _)| h(level.parameter)).collect();
        for (end, h) in [(ends[0], above[0]), (ends[1], *above.last().unwrap())] {
            near(end, at(h, fit.at(h)));
        }
    }
    let predicted = of_class(&document, "predicted");
    let known = study
        .levels()
        .iter()
        .filter(|level| level.predicted_error.is_some())
        .count();
    assert_eq!(predicted.len(), usize::from(known > 0));
    for line in predicted {
        for (point, level) in points(&line).into_iter().zip(study.levels()) {
            near(
                point,
                at(h(level.parameter), level.predicted_error.unwrap()),
            );
        }
    }
    let [left, corner, top] = points(&of_class(&document, "slope")[0])[..] else {
        panic!("a triangle")
    };
    let [across, upwards] = [
        (corner[0] - left[0]) / axes[0][0],
        (top[1] - corner[1]) / axes[1][0],
    ];
    assert!((across / upwards - 1.0).abs() < 1e-3 && across > 0.0);
}

#[test]
fn glyphs_are_at_the_errors() {
    check(&stiffnesses());
    let steps =
        [0.1, 0.05, 0.025].map(|step: f64| Level::of_errors(step, 30, step.powi(2), step.powi(3)));
    check(&RefinementStudy::new(Refinement::TimeStep, steps).unwrap());
    // Constant errors would be under the legend, so the chart becomes higher.
    let staying =
        [1.0, 0.1, 0.01, 0.001].map(|step: f64| Level::of_errors(step, 30, step.max(0.1), step));
    check(&RefinementStudy::new(Refinement::TimeStep, staying).unwrap());
}

#[test]
fn legend_has_orders_and_floor() {
    let svg = figure::refinement(&stiffnesses()).to_string();
    for says in [
        "largest error, order 1.000",
        "rms error, order 1.000",
        "spring theory",
        "on the round-off floor",
        "6 levels, 3 of them above the round-off floor",
        "log₁₀ 1/k",
    ] {
        assert!(svg.contains(says), "{says}");
    }
    let bent = [(0.1, 0.1), (0.01, 0.02), (0.001, 0.001)]
        .map(|(step, error)| Level::of_errors(step, 30, error, step));
    let svg =
        figure::refinement(&RefinementStudy::new(Refinement::TimeStep, bent).unwrap()).to_string();
    assert!(
        svg.contains("largest error, order 1.000 ± 0.2") && svg.contains("log₁₀ Δt"),
        "{svg}"
    );
    assert!(!svg.contains("theory") && !svg.contains("on the round-off floor"));
}

#[test]
fn zero_and_infinite_errors_are_left_out() {
    let levels =
        [(1e3, 0.0), (1e4, f64::INFINITY)].map(|(k, error)| Level::of_errors(k, 30, error, error));
    let none = RefinementStudy::new(Refinement::Stiffness, levels).unwrap();
    let none = none.predicted(|_| f64::INFINITY).unwrap();
    let svg = figure::refinement(&none).to_string();
    assert!(Document::parse(&svg).is_ok() && !svg.contains("NaN") && !svg.contains("inf\""));
    assert_eq!(svg.matches("class=\"level\"").count(), 0);
    assert!(svg.contains("largest error, no order"));
    for k in [1e-300, 1e300] {
        let levels = [k, 2.0 * k].map(|k| Level::of_errors(k, 30, 5e-324, 1e308));
        let svg = figure::refinement(&RefinementStudy::new(Refinement::Stiffness, levels).unwrap())
            .to_string();
        assert!(Document::parse(&svg).is_ok() && !svg.contains("NaN"));
        assert_eq!(svg.matches("class=\"level\"").count(), 4);
    }
}
