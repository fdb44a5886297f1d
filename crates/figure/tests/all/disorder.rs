//! Figures of random stackings: means by position and by distance, and force distributions.

use cannonpile::lattice::{Region, Site};
use cannonpile_disorder::ForceKind;
use cannonpile_disorder::{
    Choice, Ensemble, FirstSign, Place, RandomPiles, RandomStackings, Samples, Shard,
};
use cannonpile_figure::{self as figure, Error};
use num_rational::BigRational;
use roxmltree::Document;

use crate::svg::{corners, number, of_class};
use cannonpile_testkit::answers::ratio;

/// Returns the exact mean response to a unit load on a plane.
fn mean(layers: i128, q: &BigRational) -> Vec<(Place, BigRational, BigRational)> {
    let stackings = RandomStackings::new(layers, FirstSign::Plus).unwrap();
    let plane = RandomPiles::plane(stackings).weightless();
    let plane = plane.with_load(Site::APEX, ratio(1, 1)).unwrap();
    let rows = plane.exact(q).unwrap().into_rows();
    let rows = rows.into_iter();
    rows.map(|row| (row.place, row.probability, row.normal))
        .collect()
}

fn float(x: &BigRational) -> f64 {
    num_traits::ToPrimitive::to_f64(x).unwrap()
}

#[test]
fn cells_show_the_mean_loads() {
    let probabilities = [ratio(0, 1), ratio(1, 3), ratio(1, 1)];
    let svg = figure::mean_response(6, &probabilities)
        .unwrap()
        .to_string();
    let document = Document::parse(&svg).unwrap();
    let (cells, fronts) = (of_class(&document, "cell"), of_class(&document, "front"));
    assert_eq!(fronts.len(), 3);
    let mut cells = cells.into_iter();
    for (q, front) in probabilities.iter().zip(fronts) {
        let [x, y, r] = ["cx", "cy", "r"].map(|name| number(&front, name));
        // The circle has the radius r = nρ/√2.
        let rho = r * 2.0_f64.sqrt() / 5.0;
        let rows = mean(6, q);
        for (place, probability, normal) in rows {
            if probability == ratio(0, 1) {
                continue;
            }
            let cell = cells.next().unwrap();
            let index = |name| cell.attribute(name).unwrap().parse::<i128>().unwrap();
            assert_eq!((index("data-a"), index("data-b")), (place.a, place.b));
            let load = float(&(normal / probability));
            assert!((number(&cell, "data-value") - load).abs() < 1e-13);
            // The middle of a cell is at a u_β + b u_γ, relative to that of the circle.
            let corners = corners(&cell);
            let middle = [0, 1].map(|n| corners.iter().map(|at| at[n]).sum::<f64>() / 6.0);
            let distance = (middle[0] - x).hypot(middle[1] - y) / rho;
            #[expect(clippy::cast_precision_loss, reason = "a few steps")]
            let expected = (place.distance_squared().unwrap() as f64).sqrt();
            assert!((distance - expected).abs() < 1e-3, "{place}");
        }
    }
    assert!(cells.next().is_none());
}

#[test]
fn curves_show_the_sums_over_rings() {
    let q = ratio(1, 2);
    let svg = figure::mean_profile(6, core::slice::from_ref(&q))
        .unwrap()
        .to_string();
    let document = Document::parse(&svg).unwrap();
    let curve = of_class(&document, "curve")[0];
    let points = curve.attribute("points").unwrap().split(' ');
    let points = points.map(|point| {
        let (x, y) = point.split_once(',').unwrap();
        [x, y].map(|n| n.parse::<f64>().unwrap())
    });
    let points: Vec<[f64; 2]> = points.collect();
    // A curve has eight points in each interval of length ρ, from 0 to n + 1.
    assert_eq!(points.len(), 49);
    let ring = |r: f64| -> f64 {
        let rows = mean(6, &q).into_iter();
        let within = rows.filter(|(place, ..)| {
            #[expect(clippy::cast_precision_loss, reason = "a few steps")]
            let at = (place.distance_squared().unwrap() as f64).sqrt();
            (at - r).abs() <= 0.5
        });
        within.map(|(.., normal)| float(&normal)).sum()
    };
    let rings: Vec<f64> = (0..49).map(|n| ring(f64::from(n) / 8.0)).collect();
    // The height on the page is a linear function of the sum.
    let scale = (points[30][1] - points[0][1]) / (rings[30] - rings[0]);
    for (point, ring) in points.iter().zip(&rings) {
        let expected = points[0][1] + (ring - rings[0]) * scale;
        assert!((point[1] - expected).abs() < 1e-2, "{point:?}");
    }
}

#[test]
fn distribution_has_curves_of_all_and_of_stable_stackings() {
    let stackings = RandomStackings::new(5, FirstSign::Plus).unwrap();
    let ensemble = Ensemble::under(Region::SITE, stackings).unwrap();
    let tally = ensemble.run(&Choice::All, Shard::WHOLE).unwrap();
    let of = |binned, q: &BigRational| {
        let figure = figure::distribution(&tally, binned, q).unwrap();
        figure.unwrap().to_string()
    };
    // The 21 bottom normal forces of FCC lie in one bin, so the curve is a single stroke.
    let svg = of(ForceKind::Normal, &ratio(0, 1));
    let document = Document::parse(&svg).unwrap();
    let curves = of_class(&document, "curve");
    assert_eq!(curves.len(), 2);
    for curve in &curves {
        assert_eq!(curve.attribute("points").unwrap().split(' ').count(), 2);
    }
    let svg = of(ForceKind::Contact, &ratio(1, 2));
    assert!(svg.contains("all stackings") && svg.contains("stable stackings"));
    // Only unstable stackings have tensile forces, so the first curve begins further left.
    let document = Document::parse(&svg).unwrap();
    let begins = |curve: &roxmltree::Node<'_, '_>| -> f64 {
        let (x, _) = curve.attribute("points").unwrap().split_once(',').unwrap();
        x.parse().unwrap()
    };
    let curves = of_class(&document, "curve");
    let colours: Vec<_> = curves
        .iter()
        .map(|curve| curve.attribute("stroke"))
        .collect();
    let standing = curves
        .iter()
        .find(|curve| curve.attribute("stroke") != colours[0]);
    assert_eq!(
        begins(&curves[0]) < begins(standing.unwrap()),
        has_tension(&tally)
    );
}

/// Returns whether some stacking has a tensile force in a bin below 0.
fn has_tension(tally: &cannonpile_disorder::Tally) -> bool {
    let mut all = tally.faults.iter().map(|with| with.all.forces.first);
    all.any(|first| first < 0)
}

#[test]
fn rejects_parts_and_figures_that_are_too_large() {
    let stackings = RandomStackings::new(5, FirstSign::Plus).unwrap();
    let ensemble = Ensemble::under(Region::SITE, stackings).unwrap();
    let part = ensemble
        .run(&Choice::All, Shard::new(1, 2).unwrap())
        .unwrap();
    let half = ratio(1, 2);
    assert!(
        figure::distribution(&part, ForceKind::Contact, &half)
            .unwrap()
            .is_none()
    );
    let drawn = Choice::Drawn(Samples::new(10, 1, half.clone()).unwrap());
    let drawn = ensemble.run(&drawn, Shard::WHOLE).unwrap();
    let figure = figure::distribution(&drawn, ForceKind::Contact, &half).unwrap();
    assert!(figure.unwrap().to_string().contains("drawn at random"));
    assert!(matches!(
        figure::mean_response(200, core::slice::from_ref(&half)),
        Err(Error::TooManyGlyphs { .. })
    ));
    assert!(matches!(
        figure::mean_profile(5, &[ratio(3, 2)]),
        Err(Error::Disorder(
            cannonpile_disorder::Error::FaultProbability { .. }
        ))
    ));
}
