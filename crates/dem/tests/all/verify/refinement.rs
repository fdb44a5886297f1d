//! Refinement studies with a known order: the fit recovers the order, and invalid studies are rejected.

use cannonpile::{Packing, Pile};
use cannonpile_dem::table::FileFormat;
use cannonpile_dem::verify::{
    Comparison, Fit, Level, LevelPlace, Measured, NoOrder, NoRefinement, Norm, Refinement,
    RefinementFile, RefinementFiles, RefinementReport, RefinementStudy,
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
fn planted(refinement: Refinement, errors: &[(f64, f64)]) -> RefinementStudy {
    let levels = errors
        .iter()
        .rev()
        .map(|(h, error)| Level::of_errors(parameter(refinement, *h), 30, *error, error / 3.0));
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
                assert!(fit.standard_error.unwrap() < 1e-12 && fit.residual < 1e-12);
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
                let limit = study.limit(norm, order).unwrap();
                assert!(limit.error.abs() < 1e-12 * errors[5].1, "{limit:?}");
                assert!((fit.at(0.01) / study.levels()[0].error(norm) - 1.0).abs() < 1e-10);
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
    let few = NoOrder::Few {
        levels: 1,
        least: 2,
    };
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
            assert!(error < 0.3 * size && (0.5 * size..size).contains(&fit.residual));
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
    assert!((fit.residual / (squares / 3.0).sqrt() - 1.0).abs() < 1e-12);
    assert!((fit.order - 1.0).abs() < 1e-12);
}

#[test]
fn the_limit_recovers_a_known_constant_error() {
    for refinement in BOTH {
        for order in [1.0, 2.0] {
            for rest in [1e-2, 1e-5] {
                for count in [3, 9] {
                    let errors = (0..count).map(|n| 0.1 * 4_f64.powi(-n));
                    let errors: Vec<_> = errors.map(|h| (h, rest + 2.0 * h.powf(order))).collect();
                    let limit = planted(refinement, &errors)
                        .limit(Norm::Largest, order)
                        .unwrap();
                    assert!((limit.error / rest - 1.0).abs() < 1e-9, "{limit:?}");
                    assert_eq!(limit.levels, errors.len());
                    assert!(limit.standard_error < 1e-9 * rest);
                    // A wrong order changes the limit by more than one percent.
                    let wrong = planted(refinement, &errors).limit(Norm::Largest, 3.0 - order);
                    assert!((wrong.unwrap().error / rest - 1.0).abs() > 0.01);
                }
            }
        }
    }
    // With noise, the known limit lies within a few standard errors.
    let errors = (0..9).map(|n| {
        (
            0.1 * 4_f64.powi(-n),
            noise(usize::try_from(n).unwrap(), 0.02),
        )
    });
    let errors: Vec<_> = errors
        .map(|(h, noise)| (h, (1e-3 + 2.0 * h) * noise))
        .collect();
    let study = planted(Refinement::TimeStep, &errors);
    let limit = study.limit(Norm::Largest, 1.0).unwrap();
    assert!(
        (limit.error - 1e-3).abs() < 2.5 * limit.standard_error,
        "{limit:?}"
    );
}

#[test]
fn a_missing_limit_has_a_reason() {
    let study = |errors: &[(f64, f64)]| planted(Refinement::TimeStep, errors);
    let limit = |errors: &[(f64, f64)]| study(errors).limit(Norm::Largest, 1.0);
    let few = |levels| Err(NoOrder::Few { levels, least: 3 });
    assert_eq!(limit(&[(0.1, 0.1), (0.01, 0.01)]), few(2));
    // The fit ends at the smallest error, so a later rise is irrelevant.
    assert_eq!(limit(&[(0.1, 0.1), (0.01, 0.01), (0.001, 0.02)]), few(2));
    let rising = Err(NoOrder::Rising { parameter: 0.01 });
    assert_eq!(limit(&[(0.1, 0.1), (0.01, 0.2), (0.001, 0.02)]), rising);
    let same = [(0.1, 0.1), (0.01, 0.1), (0.001, 0.02)];
    assert_eq!(limit(&same), rising);
    let zero = Err(NoOrder::Zero { parameter: 0.001 });
    assert_eq!(limit(&[(0.1, 0.1), (0.01, 0.01), (0.001, 0.0)]), zero);
    for order in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = study(&same).limit(Norm::Largest, order);
        assert!(matches!(refused, Err(NoOrder::Order { .. })));
    }
    // An infinite error is left out.
    let infinite = [(0.1, f64::INFINITY), (0.01, 0.01), (0.001, 0.001)];
    assert_eq!(limit(&infinite), few(2));
    assert_eq!(
        study(&infinite).places(Norm::Largest)[0],
        LevelPlace::NoLogarithm
    );
    assert_eq!(study(&infinite).orders(Norm::Largest)[..2], [None, None]);
}

#[test]
fn invalid_studies_are_rejected() {
    let level = |parameter| Level::of_errors(parameter, 30, 0.1, 0.1);
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
        let refused = of(&[Level::of_errors(1.0, 30, error, 0.1)]);
        assert!(matches!(refused, Err(NoRefinement::Error { .. })));
        let refused = of(&[level(1.0)]).unwrap().predicted(|_| error);
        assert!(matches!(refused, Err(NoRefinement::Error { .. })));
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
                let h = refinement.h(x);
                Level::of_errors(x * scale, 30, 0.1 * h * h, h)
            });
            let study = RefinementStudy::new(refinement, levels).unwrap();
            assert!((fit(&study).order - 2.0).abs() < 1e-10, "{scale}");
            let limit = study.limit(Norm::Largest, 2.0).unwrap();
            assert!(
                limit.error.abs() < 1e-10 * levels[2].largest_error.min(levels[0].largest_error)
            );
        }
    }
}

/// Returns a level from a comparison. All forces exceed the exact ones by a fraction 1/k, and by a further error.
fn simulated(packing: &Packing<'_>, k: f64, rest: f64) -> Level {
    let measured = perfect(packing).into_iter().map(|exact| {
        let [x, y, z] = exact.vector.unwrap();
        let too_great = 1.0 + rest + 1.0 / k;
        let vector = [x, y, z].map(|x| x * too_great);
        Measured::new(exact.ids, exact.force * too_great).with_vector(vector)
    });
    Level::new(k, &Comparison::new(packing, measured).unwrap(), 1e-6)
}

#[test]
fn levels_can_be_built_from_comparisons() {
    let pile = Pile::triangular(5).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let study = |rest| {
        let levels = [1e2, 1e3, 1e4, 1e5].map(|k| simulated(&packing, k, rest));
        RefinementStudy::new(Refinement::Stiffness, levels).unwrap()
    };
    let right = study(0.0);
    assert!((fit(&right).order - 1.0).abs() < 1e-9);
    assert!((fit(&right).constant - 1.0).abs() < 1e-8);
    assert!(right.limit(Norm::Rms, 1.0).unwrap().error.abs() < 1e-12);
    let wrong = study(0.01);
    assert!((wrong.limit(Norm::Rms, 1.0).unwrap().error - 0.01).abs() < 1e-9);
    assert_eq!(right.levels()[0].contacts, 60);
    // One contact is missing: the level is shown, but not counted.
    let measured = perfect(&packing).into_iter().skip(1);
    let torn = Level::new(1e6, &Comparison::new(&packing, measured).unwrap(), 1e-6);
    let levels = right.levels().iter().copied().chain([torn]);
    let torn = RefinementStudy::new(Refinement::Stiffness, levels).unwrap();
    assert_eq!(torn.places(Norm::Largest)[4], LevelPlace::Incomplete);
    assert_eq!(torn.fit(Norm::Largest), right.fit(Norm::Largest));
}

#[test]
fn files_are_parsed_with_their_parameters() {
    let RefinementFiles(files) = "1e5=a.csv, 2.5e6=dir/b=c.csv,1=-".parse().unwrap();
    let expected = [(1e5, "a.csv"), (2.5e6, "dir/b=c.csv"), (1.0, "-")];
    let expected = expected.map(|(parameter, path)| RefinementFile {
        parameter,
        path: path.into(),
    });
    assert_eq!(files, expected);
    for (text, says) in [
        ("", "'' has no =: "),
        ("1e5", "'1e5' has no =: "),
        ("1e5=a,", "'' has no =: "),
        ("1e5=", "'1e5=' names no file: "),
        ("soft=a", "'soft' is not a number: "),
        ("=a", "'' is not a number: "),
        ("0=a", "0e0 is not a stiffness or a time step: "),
        ("-1=a", "-1e0 is not a stiffness "),
        ("nan=a", "NaN is not a stiffness "),
        ("inf=a", "inf is not a stiffness "),
        ("1e-310=a", "1e-310 is not a stiffness "),
        ("1e3=a,1e4=b,1000=c", "two levels at 1e3: "),
    ] {
        let refused = text.parse::<RefinementFiles>().unwrap_err().to_string();
        assert!(refused.starts_with(says), "{text}: {refused}");
        assert!(!refused.contains('\n'));
    }
    let long = format!("{}\n=a", "1".repeat(5000) + "x");
    let refused = long.parse::<RefinementFiles>().unwrap_err().to_string();
    assert!(refused.len() < 250 && !refused.contains('\n'), "{refused}");
    let many: Vec<String> = (1..=1001).map(|n| format!("{n}=a")).collect();
    assert!(many[..1000].join(",").parse::<RefinementFiles>().is_ok());
    let refused = many.join(",").parse::<RefinementFiles>().unwrap_err();
    assert_eq!(refused.to_string(), "more than 1000 levels: leave some out");
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
    let study = planted(Refinement::Stiffness, &errors)
        .predicted(|k| 4.8 / k)
        .unwrap();
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
        assert_eq!(
            (&fit["levels_used"], &fit["extrapolated_levels"]),
            (&3.into(), &4.into())
        );
        let times = if norm == "largest" { 1.0 } else { 3.0 };
        let left = fit["extrapolated_error"].as_f64().unwrap() * times;
        assert!((6e-7..8e-7).contains(&left), "{left}");
        assert!(fit["no_order"].is_null() && fit["no_limit"].is_null());
    }

    let one = planted(Refinement::TimeStep, &errors[..1]);
    let text = written(&one, FileFormat::Text);
    for says in [
        "timestep",
        "no order of the largest errors: only 1 of the 2 levels needed",
    ] {
        assert!(text.contains(says), "{text}");
    }
    // Without an order, the report does not mention the limit.
    assert!(!text.contains("extrapolated error of"), "{text}");
    let json: serde_json::Value = serde_json::from_str(&written(&one, FileFormat::Json)).unwrap();
    assert!(json[0]["largest"]["no_order"].is_string());
}
