//! Refinement studies with a known order: the fit recovers the order, and invalid studies are rejected.

use cannonpile::{Packing, Pile};
use cannonpile_dem::table::FileFormat;
use cannonpile_dem::verify::{
    Comparison, Fit, Level, LevelPlace, Measured, NoRefinement, Norm, Refinement, RefinementReport,
    RefinementStudy,
};

use super::{packing, perfect, ratio};

const BOTH: [Refinement; 2] = [Refinement::Stiffness, Refinement::TimeStep];

/// Returns the stiffness or the time step for a refinement parameter.
fn parameter(refinement: Refinement, h: f64) -> f64 {
    match refinement {
        Refinement::Stiffness => 1.0 / h,
        Refinement::TimeStep => h,
    }
}

/// Returns a refinement study with these errors, listed from the coarsest level but passed in reverse order.
/// A level of 30 contacts, all of them measured.
fn level(parameter: f64, largest_error: f64, rms_error: f64) -> Level {
    Level {
        parameter,
        contacts: 30,
        matched: 30,
        largest_error,
        rms_error,
        ..Level::default()
    }
}

fn planted(refinement: Refinement, errors: &[(f64, f64)]) -> RefinementStudy {
    let levels = errors
        .iter()
        .rev()
        .map(|(h, error)| level(parameter(refinement, *h), *error, error / 3.0));
    RefinementStudy::new(refinement, levels).unwrap()
}

fn fit(study: &RefinementStudy) -> Fit {
    study.fit(Norm::Largest).unwrap()
}

fn halvings(count: i32) -> impl Iterator<Item = f64> {
    (0..count).map(|n| 0.01 * 0.5_f64.powi(n))
}

/// Returns a factor that deviates from 1 by up to `size`, up and down in turn. It is the same in every run.
fn noise(n: usize, size: f64) -> f64 {
    let turn = [0.9, -0.7, 0.3, -1.0, 0.6, -0.2, 1.0, -0.8][n % 8];
    1.0 + size * turn
}

#[test]
fn the_fit_recovers_a_known_order() {
    for refinement in BOTH {
        for order in [0.6, 1.0, 1.5, 2.0, 4.0] {
            let errors: Vec<_> = halvings(6).map(|h| (h, 7.0 * h.powf(order))).collect();
            let study = planted(refinement, &errors);
            for norm in Norm::ALL {
                let fit = study.fit(norm).unwrap();
                assert!((fit.order - order).abs() < 1e-12, "{fit:?}");
                let constant = if norm == Norm::Largest {
                    7.0
                } else {
                    7.0 / 3.0
                };
                assert!((fit.constant / constant - 1.0).abs() < 1e-10, "{fit:?}");
                assert!(fit.standard_error.unwrap() < 1e-12);
                assert_eq!(fit.levels, 6);
                let orders = study.orders(norm);
                assert_eq!(orders[0], None);
                assert!(
                    orders[1..]
                        .iter()
                        .all(|p| (p.unwrap() - order).abs() < 1e-12)
                );
                assert!(
                    study
                        .places(norm)
                        .iter()
                        .all(|place| *place == LevelPlace::Above)
                );
            }
        }
    }
}

/// The orders that wrong formulas would yield. Each is far from the known order, so the test above detects the fault.
#[test]
fn wrong_formulas_yield_wrong_orders() {
    let errors: Vec<(f64, f64)> = halvings(4).map(|h| (h, 7.0 * h * h)).collect();
    let stiff = planted(Refinement::Stiffness, &errors);
    // A stiffness taken for h itself reverses the sign of the order, so no error falls.
    let levels = stiff.levels().iter().copied();
    let other_way = RefinementStudy::new(Refinement::TimeStep, levels).unwrap();
    assert!((other_way.orders(Norm::Largest)[1].unwrap() + 2.0).abs() < 1e-12);
    let few = NoRefinement::Few { levels: 1 };
    assert_eq!(other_way.fit(Norm::Largest), Err(few));
    // One of the two logarithms has another base.
    let [(h1, e1), (h2, e2), ..] = errors[..] else {
        unreachable!("four levels")
    };
    let mixed = (e1 / e2).ln() / (h1 / h2).log10();
    assert!((mixed - 2.0).abs() > 1.0);
    // The fit includes the levels on the floor.
    let errors: Vec<_> = halvings(8).map(|h| (h, h.max(1e-3))).collect();
    let study = planted(Refinement::TimeStep, &errors);
    let logs = errors.iter().map(|(h, e)| (h.ln(), e.ln()));
    let mean = |of: fn((f64, f64)) -> f64| logs.clone().map(of).sum::<f64>() / 8.0;
    let (h, e) = (mean(|(h, _)| h), mean(|(_, e)| e));
    let slope = logs.clone().map(|(x, y)| (x - h) * (y - e)).sum::<f64>()
        / logs.map(|(x, _)| (x - h) * (x - h)).sum::<f64>();
    assert!(slope < 0.6, "{slope}");
    assert!((fit(&study).order - 1.0).abs() < 0.05, "{:?}", fit(&study));
}

#[test]
fn levels_on_the_floor_are_left_out() {
    for refinement in BOTH {
        for order in [1.0, 2.0] {
            for ratio in [2.0_f64, 10.0] {
                let h = (0..12).map(|n| 0.1 * ratio.powi(-n));
                let line = |h: f64| 3.0 * h.powf(order);
                let middle = line(0.1 * ratio.powi(-6));
                // One floor is constant, and the other rises with the stiffness, as rounding does.
                for floor in [
                    |_: f64, bound: f64| bound,
                    |h: f64, bound: f64| bound * 1e-3 / h,
                ] {
                    let bound = floor(0.1 * ratio.powi(-6), 1.0);
                    let errors = h.clone().map(|h| (h, line(h) + floor(h, middle / bound)));
                    let errors: Vec<_> = errors.collect();
                    let study = planted(refinement, &errors);
                    let fit = fit(&study);
                    let off = (fit.order - order).abs();
                    assert!(off < 0.06 && (4..=6).contains(&fit.levels), "{fit:?}");
                    let places = study.places(Norm::Largest);
                    let above = places
                        .iter()
                        .take_while(|place| **place == LevelPlace::Above);
                    assert_eq!(above.count(), fit.levels);
                    let below = &places[fit.levels..];
                    assert!(below.iter().all(|place| *place == LevelPlace::Floor));
                }
            }
        }
    }
}

#[test]
fn the_standard_error_reflects_the_noise() {
    for refinement in BOTH {
        for size in [0.01, 0.1, 0.2] {
            let errors = halvings(8).enumerate();
            let errors: Vec<_> = errors.map(|(n, h)| (h, h * noise(n, size))).collect();
            let study = planted(refinement, &errors);
            let fit = fit(&study);
            assert_eq!(fit.levels, 8, "{size}");
            let error = fit.standard_error.unwrap();
            assert!((fit.order - 1.0).abs() < 2.5 * error, "{fit:?}");
            assert!(error < 0.3 * size);
        }
    }
}

/// Three levels, of which the middle one has twice the error of the line. The residuals are (−1, 2, −1)·ln(2)/3.
#[test]
fn the_standard_error_matches_the_formula_for_a_slope() {
    let errors = [(0.1, 0.1), (0.01, 0.02), (0.001, 0.001)];
    let fit = fit(&planted(Refinement::TimeStep, &errors));
    let squares = 2.0 / 3.0 * 2.0_f64.ln().powi(2);
    let expected = (squares / (2.0 * 10.0_f64.ln().powi(2))).sqrt();
    assert!(
        (fit.standard_error.unwrap() / expected - 1.0).abs() < 1e-12,
        "{fit:?}"
    );
    assert!((fit.order - 1.0).abs() < 1e-12);
}

#[test]
fn invalid_studies_are_rejected() {
    let level = |parameter| level(parameter, 0.1, 0.1);
    let of = |levels: &[Level]| RefinementStudy::new(Refinement::Stiffness, levels.iter().copied());
    assert_eq!(of(&[]), Err(NoRefinement::Empty));
    assert_eq!(
        of(&vec![level(1.0); 1001]),
        Err(NoRefinement::TooMany { limit: 1000 })
    );
    assert_eq!(
        of(&[level(2.0), level(1.0), level(2.0)]),
        Err(NoRefinement::Twice { parameter: 2.0 })
    );
    for parameter in [0.0, -1.0, f64::INFINITY, 5e-324] {
        assert_eq!(
            of(&[level(parameter)]),
            Err(NoRefinement::Parameter { parameter })
        );
    }
    assert!(matches!(
        of(&[level(f64::NAN)]),
        Err(NoRefinement::Parameter { .. })
    ));
    for error in [-1e-9, f64::NAN] {
        let largest_error = error;
        let predicted_error = Some(error);
        for wrong in [
            Level {
                largest_error,
                ..level(1.0)
            },
            Level {
                predicted_error,
                ..level(1.0)
            },
        ] {
            assert!(matches!(of(&[wrong]), Err(NoRefinement::Error { .. })));
        }
    }
    // Neighbouring floats are distinct parameters, but too close to show a slope.
    let near = of(&[level(1e300), level(1e300_f64.next_up())]).unwrap();
    assert!(near.fit(Norm::Largest).is_err());
    assert_eq!(near.orders(Norm::Largest)[1], None);
    // Their logarithms are equal, but the repeated parameter is still detected.
    for refinement in BOTH {
        let three = [1e300, 1e300_f64.next_up(), 1e300].map(level);
        let twice = Err(NoRefinement::Twice { parameter: 1e300 });
        assert_eq!(RefinementStudy::new(refinement, three), twice);
    }
}

#[test]
fn parameters_of_any_magnitude_have_orders() {
    for refinement in BOTH {
        for scale in [1e-300, 1e-100, 1e100, 1e300] {
            let levels = [1.0, 10.0, 100.0].map(|x| {
                let h = parameter(refinement, x);
                level(x * scale, 0.1 * h * h, h)
            });
            let study = RefinementStudy::new(refinement, levels).unwrap();
            assert!((fit(&study).order - 2.0).abs() < 1e-10, "{scale}");
        }
    }
}

/// Returns a level from a comparison. All forces exceed the exact ones by a fraction 1/k, and by a further error.
fn simulated(packing: &Packing<'_>, k: f64) -> Level {
    let measured = perfect(packing).into_iter().map(|exact| {
        let [x, y, z] = exact.vector.unwrap();
        let too_great = 1.0 + 1.0 / k;
        let vector = [x, y, z].map(|x| x * too_great);
        Measured::new(exact.ids, exact.force * too_great).with_vector(vector)
    });
    Level::new(k, &Comparison::new(packing, measured).unwrap(), 1e-6)
}

#[test]
fn levels_can_be_built_from_comparisons() {
    let pile = Pile::triangular(5).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let levels = [1e2, 1e3, 1e4, 1e5].map(|k| simulated(&packing, k));
    let right = RefinementStudy::new(Refinement::Stiffness, levels).unwrap();
    assert!((fit(&right).order - 1.0).abs() < 1e-9);
    assert!((fit(&right).constant - 1.0).abs() < 1e-8);
    assert_eq!(right.levels()[0].contacts, 60);
    // One contact is missing: the level is shown, but not counted.
    let measured = perfect(&packing).into_iter().skip(1);
    let torn = Level::new(1e6, &Comparison::new(&packing, measured).unwrap(), 1e-6);
    let levels = right.levels().iter().copied().chain([torn]);
    let torn = RefinementStudy::new(Refinement::Stiffness, levels).unwrap();
    assert_eq!(torn.places(Norm::Largest)[4], LevelPlace::Incomplete);
    assert_eq!(torn.fit(Norm::Largest), right.fit(Norm::Largest));
}

fn written(study: &RefinementStudy, format: FileFormat) -> String {
    let mut out = Vec::new();
    RefinementReport::new(study)
        .write(format, &mut out)
        .unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn the_report_is_complete_in_three_formats() {
    let errors = [(1e-4, 5e-4), (1e-5, 5e-5), (1e-6, 5e-6), (1e-7, 1.2e-6)];
    let study = planted(Refinement::Stiffness, &errors);
    let levels = study.levels().iter().map(|level| Level {
        predicted_error: Some(4.8 / level.parameter),
        ..*level
    });
    let study = RefinementStudy::new(Refinement::Stiffness, levels).unwrap();
    let csv = written(&study, FileFormat::Csv);
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(
        lines[0],
        "stiffness,contacts,matched,missing,extra,largest_error,rms_error,order,predicted_error,place"
    );
    assert_eq!(lines.len(), 5);
    assert!(
        lines[1].ends_with(",,0.00047999999999999996,above"),
        "{csv}"
    );
    assert!(lines[4].ends_with(",floor"), "{csv}");
    let text = written(&study, FileFormat::Text);
    assert!(
        text.contains("\n4 levels\n") || text.contains("4 levels"),
        "{text}"
    );
    assert!(text.contains("largest") && text.contains("rms") && !text.contains("no order"));
    let json: serde_json::Value = serde_json::from_str(&written(&study, FileFormat::Json)).unwrap();
    assert_eq!(json[0]["refinement"], "stiffness");
    assert_eq!(json[0]["levels"].as_array().unwrap().len(), 4);
    assert_eq!(json[0]["levels"][3]["place"], "floor");
    for norm in ["largest", "rms"] {
        let fit = &json[0][norm];
        assert!((fit["order"].as_f64().unwrap() - 1.0).abs() < 1e-9);
        assert_eq!(fit["levels_used"], 3);
        assert!(fit["no_order"].is_null());
    }

    let one = planted(Refinement::TimeStep, &errors[..1]);
    let text = written(&one, FileFormat::Text);
    for says in [
        "timestep",
        "no order of the largest errors: only 1 of the 2 levels needed",
    ] {
        assert!(text.contains(says), "{text}");
    }
    let json: serde_json::Value = serde_json::from_str(&written(&one, FileFormat::Json)).unwrap();
    assert!(json[0]["largest"]["no_order"].is_string());
}
