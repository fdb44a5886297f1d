//! Ladders whose order is planted: it is found, and what is no order is refused.

use cannonpile::{Packing, Pile};
use cannonpile_dem::table::FileFormat;
use cannonpile_dem::verify::{
    Comparison, Fit, Ladder, LadderFile, LadderFiles, LadderReport, Measured, NoLadder, NoOrder,
    Norm, Refinement, Rung, RungPlace,
};

use super::{packing, perfect, ratio};

const BOTH: [Refinement; 2] = [Refinement::Stiffness, Refinement::TimeStep];

/// The stiffness or the time step of a refinement parameter.
fn parameter(refinement: Refinement, h: f64) -> f64 {
    match refinement {
        Refinement::Stiffness => 1.0 / h,
        Refinement::TimeStep => h,
    }
}

/// A ladder with these errors, the finest first.
fn planted(refinement: Refinement, errors: &[(f64, f64)]) -> Ladder {
    let rungs = errors
        .iter()
        .rev()
        .map(|(h, error)| Rung::of_errors(parameter(refinement, *h), 30, *error, error / 3.0));
    Ladder::new(refinement, rungs).unwrap()
}

fn fit(ladder: &Ladder) -> Fit {
    ladder.fit(Norm::Largest).unwrap()
}

fn halvings(count: i32) -> impl Iterator<Item = f64> {
    (0..count).map(|n| 0.01 * 0.5_f64.powi(n))
}

/// Deviations of some size that are the same in every run: by turns up and down, none like the other.
fn noise(n: usize, size: f64) -> f64 {
    let turn = [0.9, -0.7, 0.3, -1.0, 0.6, -0.2, 1.0, -0.8][n % 8];
    1.0 + size * turn
}

#[test]
fn a_planted_order_is_found() {
    for refinement in BOTH {
        for order in [0.6, 1.0, 1.5, 2.0, 4.0] {
            let errors: Vec<_> = halvings(6).map(|h| (h, 7.0 * h.powf(order))).collect();
            let ladder = planted(refinement, &errors);
            for norm in Norm::ALL {
                let fit = ladder.fit(norm).unwrap();
                assert!((fit.order - order).abs() < 1e-12, "{fit:?}");
                let constant = if norm == Norm::Largest {
                    7.0
                } else {
                    7.0 / 3.0
                };
                assert!((fit.constant / constant - 1.0).abs() < 1e-10, "{fit:?}");
                assert!(fit.standard_error.unwrap() < 1e-12 && fit.residual < 1e-12);
                assert_eq!(fit.rungs, 6);
                let orders = ladder.orders(norm);
                assert_eq!(orders[0], None);
                assert!(
                    orders[1..]
                        .iter()
                        .all(|p| (p.unwrap() - order).abs() < 1e-12)
                );
                assert!(
                    ladder
                        .places(norm)
                        .iter()
                        .all(|place| *place == RungPlace::Above)
                );
                let limit = ladder.limit(norm, order).unwrap();
                assert!(limit.error.abs() < 1e-12 * errors[5].1, "{limit:?}");
                assert!((fit.at(0.01) / ladder.rungs()[0].error(norm) - 1.0).abs() < 1e-10);
            }
        }
    }
}

/// What the order would be by faults in its formula: each is far from the one planted, so the test above sees it.
#[test]
fn other_formulas_have_other_orders() {
    let errors: Vec<(f64, f64)> = halvings(4).map(|h| (h, 7.0 * h * h)).collect();
    let stiff = planted(Refinement::Stiffness, &errors);
    // A stiffness taken for h itself: the order has the other sign, and nothing falls.
    let rungs = stiff.rungs().iter().copied();
    let other_way = Ladder::new(Refinement::TimeStep, rungs).unwrap();
    assert!((other_way.orders(Norm::Largest)[1].unwrap() + 2.0).abs() < 1e-12);
    let few = NoOrder::Few { rungs: 1, least: 2 };
    assert_eq!(other_way.fit(Norm::Largest), Err(few));
    // Another base of one logarithm.
    let [(h1, e1), (h2, e2), ..] = errors[..] else {
        unreachable!("four rungs")
    };
    let mixed = (e1 / e2).ln() / (h1 / h2).log10();
    assert!((mixed - 2.0).abs() > 1.0);
    // The floor counted in.
    let errors: Vec<_> = halvings(8).map(|h| (h, h.max(1e-3))).collect();
    let ladder = planted(Refinement::TimeStep, &errors);
    let logs = errors.iter().map(|(h, e)| (h.ln(), e.ln()));
    let mean = |of: fn((f64, f64)) -> f64| logs.clone().map(of).sum::<f64>() / 8.0;
    let (h, e) = (mean(|(h, _)| h), mean(|(_, e)| e));
    let slope = logs.clone().map(|(x, y)| (x - h) * (y - e)).sum::<f64>()
        / logs.map(|(x, _)| (x - h) * (x - h)).sum::<f64>();
    assert!(slope < 0.6, "{slope}");
    assert!(
        (fit(&ladder).order - 1.0).abs() < 0.05,
        "{:?}",
        fit(&ladder)
    );
}

#[test]
fn the_floor_is_left_out() {
    for refinement in BOTH {
        for order in [1.0, 2.0] {
            for ratio in [2.0_f64, 10.0] {
                let h = (0..12).map(|n| 0.1 * ratio.powi(-n));
                let line = |h: f64| 3.0 * h.powf(order);
                let middle = line(0.1 * ratio.powi(-6));
                // One that stays, and one that rises as rounding does with the stiffness.
                for floor in [
                    |_: f64, level: f64| level,
                    |h: f64, level: f64| level * 1e-3 / h,
                ] {
                    let level = floor(0.1 * ratio.powi(-6), 1.0);
                    let errors = h.clone().map(|h| (h, line(h) + floor(h, middle / level)));
                    let errors: Vec<_> = errors.collect();
                    let ladder = planted(refinement, &errors);
                    let fit = fit(&ladder);
                    let off = (fit.order - order).abs();
                    assert!(off < 0.06 && (4..=6).contains(&fit.rungs), "{fit:?}");
                    let places = ladder.places(Norm::Largest);
                    let above = places
                        .iter()
                        .take_while(|place| **place == RungPlace::Above);
                    assert_eq!(above.count(), fit.rungs);
                    let below = &places[fit.rungs..];
                    assert!(below.iter().all(|place| *place == RungPlace::Floor));
                }
            }
        }
    }
}

#[test]
fn noise_is_told_by_the_standard_error() {
    for refinement in BOTH {
        for size in [0.01, 0.1, 0.2] {
            let errors = halvings(8).enumerate();
            let errors: Vec<_> = errors.map(|(n, h)| (h, h * noise(n, size))).collect();
            let ladder = planted(refinement, &errors);
            let fit = fit(&ladder);
            assert_eq!(fit.rungs, 8, "{size}");
            let error = fit.standard_error.unwrap();
            assert!((fit.order - 1.0).abs() < 2.5 * error, "{fit:?}");
            assert!(error < 0.3 * size && (0.5 * size..size).contains(&fit.residual));
        }
    }
}

/// Three rungs, the middle one off by a factor of 2: residuals of (−1, 2, −1) thirds of ln 2.
#[test]
fn the_standard_error_is_that_of_the_slope() {
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
fn what_remains_is_found() {
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
                    assert_eq!(limit.rungs, errors.len());
                    assert!(limit.standard_error < 1e-9 * rest);
                    // With another order it is another, by more than a percent.
                    let wrong = planted(refinement, &errors).limit(Norm::Largest, 3.0 - order);
                    assert!((wrong.unwrap().error / rest - 1.0).abs() > 0.01);
                }
            }
        }
    }
    // With noise, the rest is there within its standard error.
    let errors = (0..9).map(|n| {
        (
            0.1 * 4_f64.powi(-n),
            noise(usize::try_from(n).unwrap(), 0.02),
        )
    });
    let errors: Vec<_> = errors
        .map(|(h, noise)| (h, (1e-3 + 2.0 * h) * noise))
        .collect();
    let ladder = planted(Refinement::TimeStep, &errors);
    let limit = ladder.limit(Norm::Largest, 1.0).unwrap();
    assert!(
        (limit.error - 1e-3).abs() < 2.5 * limit.standard_error,
        "{limit:?}"
    );
}

#[test]
fn no_limit_is_named() {
    let ladder = |errors: &[(f64, f64)]| planted(Refinement::TimeStep, errors);
    let limit = |errors: &[(f64, f64)]| ladder(errors).limit(Norm::Largest, 1.0);
    let few = |rungs| Err(NoOrder::Few { rungs, least: 3 });
    assert_eq!(limit(&[(0.1, 0.1), (0.01, 0.01)]), few(2));
    // Down to the least error only: what rises after it does not count.
    assert_eq!(limit(&[(0.1, 0.1), (0.01, 0.01), (0.001, 0.02)]), few(2));
    let rising = Err(NoOrder::Rising { parameter: 0.01 });
    assert_eq!(limit(&[(0.1, 0.1), (0.01, 0.2), (0.001, 0.02)]), rising);
    let same = [(0.1, 0.1), (0.01, 0.1), (0.001, 0.02)];
    assert_eq!(limit(&same), rising);
    let zero = Err(NoOrder::Zero { parameter: 0.001 });
    assert_eq!(limit(&[(0.1, 0.1), (0.01, 0.01), (0.001, 0.0)]), zero);
    for order in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = ladder(&same).limit(Norm::Largest, order);
        assert!(matches!(refused, Err(NoOrder::Order { .. })));
    }
    // An infinite error is none.
    let infinite = [(0.1, f64::INFINITY), (0.01, 0.01), (0.001, 0.001)];
    assert_eq!(limit(&infinite), few(2));
    assert_eq!(
        ladder(&infinite).places(Norm::Largest)[0],
        RungPlace::NoLogarithm
    );
    assert_eq!(ladder(&infinite).orders(Norm::Largest)[..2], [None, None]);
}

#[test]
fn no_ladder_is_named() {
    let rung = |parameter| Rung::of_errors(parameter, 30, 0.1, 0.1);
    let of = |rungs: &[Rung]| Ladder::new(Refinement::Stiffness, rungs.iter().copied());
    assert_eq!(of(&[]), Err(NoLadder::Empty));
    assert_eq!(
        of(&vec![rung(1.0); 1001]),
        Err(NoLadder::TooMany { limit: 1000 })
    );
    assert_eq!(
        of(&[rung(2.0), rung(1.0), rung(2.0)]),
        Err(NoLadder::Twice { parameter: 2.0 })
    );
    for parameter in [0.0, -1.0, f64::INFINITY, 5e-324] {
        assert_eq!(
            of(&[rung(parameter)]),
            Err(NoLadder::Parameter { parameter })
        );
    }
    assert!(matches!(
        of(&[rung(f64::NAN)]),
        Err(NoLadder::Parameter { .. })
    ));
    for error in [-1e-9, f64::NAN] {
        let refused = of(&[Rung::of_errors(1.0, 30, error, 0.1)]);
        assert!(matches!(refused, Err(NoLadder::Error { .. })));
        let refused = of(&[rung(1.0)]).unwrap().predicted(|_| error);
        assert!(matches!(refused, Err(NoLadder::Error { .. })));
    }
    // Neighbouring floats are two parameters, and no slope is seen between them.
    let near = of(&[rung(1e300), rung(1e300_f64.next_up())]).unwrap();
    assert!(near.fit(Norm::Largest).is_err());
    assert_eq!(near.orders(Norm::Largest)[1], None);
    // Their logarithms are one, and what is between them is seen all the same.
    for refinement in BOTH {
        let three = [1e300, 1e300_f64.next_up(), 1e300].map(rung);
        let twice = Err(NoLadder::Twice { parameter: 1e300 });
        assert_eq!(Ladder::new(refinement, three), twice);
    }
}

#[test]
fn parameters_of_any_size_have_orders() {
    for refinement in BOTH {
        for scale in [1e-300, 1e-100, 1e100, 1e300] {
            let rungs = [1.0, 10.0, 100.0].map(|x| {
                let h = refinement.h(x);
                Rung::of_errors(x * scale, 30, 0.1 * h * h, h)
            });
            let ladder = Ladder::new(refinement, rungs).unwrap();
            assert!((fit(&ladder).order - 2.0).abs() < 1e-10, "{scale}");
            let limit = ladder.limit(Norm::Largest, 2.0).unwrap();
            assert!(limit.error.abs() < 1e-10 * rungs[2].largest_error.min(rungs[0].largest_error));
        }
    }
}

/// Forces of the pile that are all too great by 1/k, and more so by a percent: through comparisons.
fn simulated(packing: &Packing<'_>, k: f64, rest: f64) -> Rung {
    let measured = perfect(packing).into_iter().map(|exact| {
        let [x, y, z] = exact.vector.unwrap();
        let too_great = 1.0 + rest + 1.0 / k;
        let vector = [x, y, z].map(|x| x * too_great);
        Measured::new(exact.ids, exact.force * too_great).with_vector(vector)
    });
    Rung::new(k, &Comparison::new(packing, measured).unwrap(), 1e-6)
}

#[test]
fn a_ladder_of_comparisons() {
    let pile = Pile::triangular(5).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let ladder = |rest| {
        let rungs = [1e2, 1e3, 1e4, 1e5].map(|k| simulated(&packing, k, rest));
        Ladder::new(Refinement::Stiffness, rungs).unwrap()
    };
    let right = ladder(0.0);
    assert!((fit(&right).order - 1.0).abs() < 1e-9);
    assert!((fit(&right).constant - 1.0).abs() < 1e-8);
    assert!(right.limit(Norm::Rms, 1.0).unwrap().error.abs() < 1e-12);
    let wrong = ladder(0.01);
    assert!((wrong.limit(Norm::Rms, 1.0).unwrap().error - 0.01).abs() < 1e-9);
    assert_eq!(right.rungs()[0].contacts, 60);
    // One contact not measured: the rung is shown, and not counted.
    let measured = perfect(&packing).into_iter().skip(1);
    let torn = Rung::new(1e6, &Comparison::new(&packing, measured).unwrap(), 1e-6);
    let rungs = right.rungs().iter().copied().chain([torn]);
    let torn = Ladder::new(Refinement::Stiffness, rungs).unwrap();
    assert_eq!(torn.places(Norm::Largest)[4], RungPlace::Incomplete);
    assert_eq!(torn.fit(Norm::Largest), right.fit(Norm::Largest));
}

#[test]
fn files_are_named_with_their_parameters() {
    let LadderFiles(files) = "1e5=a.csv, 2.5e6=dir/b=c.csv,1=-".parse().unwrap();
    let expected = [(1e5, "a.csv"), (2.5e6, "dir/b=c.csv"), (1.0, "-")];
    let expected = expected.map(|(parameter, path)| LadderFile {
        parameter,
        path: path.into(),
    });
    assert_eq!(files, expected);
    for (text, says) in [
        ("", "'' has no =: "),
        ("1e5", "'1e5' has no =: "),
        ("1e5=a,", "'' has no =: "),
        ("1e5=", "'1e5=' names no file: "),
        ("soft=a", "'soft' is no number: "),
        ("=a", "'' is no number: "),
        ("0=a", "0e0 is no stiffness and no time step: "),
        ("-1=a", "-1e0 is no stiffness "),
        ("nan=a", "NaN is no stiffness "),
        ("inf=a", "inf is no stiffness "),
        ("1e-310=a", "1e-310 is no stiffness "),
        ("1e3=a,1e4=b,1000=c", "two rungs at 1e3: "),
    ] {
        let refused = text.parse::<LadderFiles>().unwrap_err().to_string();
        assert!(refused.starts_with(says), "{text}: {refused}");
        assert!(!refused.contains('\n'));
    }
    let long = format!("{}\n=a", "1".repeat(5000) + "x");
    let refused = long.parse::<LadderFiles>().unwrap_err().to_string();
    assert!(refused.len() < 250 && !refused.contains('\n'), "{refused}");
    let many: Vec<String> = (1..=1001).map(|n| format!("{n}=a")).collect();
    assert!(many[..1000].join(",").parse::<LadderFiles>().is_ok());
    let refused = many.join(",").parse::<LadderFiles>().unwrap_err();
    assert_eq!(refused.to_string(), "more than 1000 rungs: leave some out");
}

fn written(ladder: &Ladder, format: FileFormat) -> String {
    let mut out = Vec::new();
    LadderReport::new(ladder).write(format, &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn the_report_says_all_of_it_in_three_formats() {
    let errors = [(1e-4, 5e-4), (1e-5, 5e-5), (1e-6, 5e-6), (1e-7, 1.2e-6)];
    let ladder = planted(Refinement::Stiffness, &errors)
        .predicted(|k| 4.8 / k)
        .unwrap();
    let csv = written(&ladder, FileFormat::Csv);
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
    let text = written(&ladder, FileFormat::Text);
    assert!(
        text.contains("\n4 rungs\n") || text.contains("4 rungs"),
        "{text}"
    );
    assert!(text.contains("largest") && text.contains("rms") && !text.contains("no order"));
    let json: serde_json::Value =
        serde_json::from_str(&written(&ladder, FileFormat::Json)).unwrap();
    assert_eq!(json[0]["refinement"], "stiffness");
    assert_eq!(json[0]["rungs"].as_array().unwrap().len(), 4);
    assert_eq!(json[0]["rungs"][3]["place"], "floor");
    for norm in ["largest", "rms"] {
        let fit = &json[0][norm];
        assert!((fit["order"].as_f64().unwrap() - 1.0).abs() < 1e-9);
        assert_eq!(
            (&fit["rungs_used"], &fit["extrapolated_rungs"]),
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
        "no order of the largest errors: 1 of the 2 rungs it takes",
    ] {
        assert!(text.contains(says), "{text}");
    }
    // Without an order there is no word on the limit either.
    assert!(!text.contains("extrapolated error of"), "{text}");
    let json: serde_json::Value = serde_json::from_str(&written(&one, FileFormat::Json)).unwrap();
    assert!(json[0]["largest"]["no_order"].is_string());
}
