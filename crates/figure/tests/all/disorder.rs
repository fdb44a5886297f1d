//! Random stackings in figures: means by place and by distance, and how forces are distributed.

use cannonpile::lattice::{Region, Site};
use cannonpile_disorder::Binned;
use cannonpile_disorder::{
    Choice, Ensemble, FirstSign, Place, RandomPiles, RandomStackings, Samples, Shard,
};
use cannonpile_figure::{self as figure, Error};
use num_rational::BigRational;
use roxmltree::Document;

use crate::svg::{corners, number, of_class};
use cannonpile_testkit::answers::ratio;

/// The exact mean of a unit load on a plane.
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
fn cells_are_the_loads_of_spheres_at_their_places() {
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
        // r = nρ/√2.
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
            // Its middle is a u_β + b u_γ from that of the circle.
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
fn a_curve_is_the_sum_over_a_ring() {
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
    // Eight points a ρ, from 0 to n + 1.
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
    // Heights on the page are linear in the sums.
    let scale = (points[30][1] - points[0][1]) / (rings[30] - rings[0]);
    for (point, ring) in points.iter().zip(&rings) {
        let expected = points[0][1] + (ring - rings[0]) * scale;
        assert!((point[1] - expected).abs() < 1e-2, "{point:?}");
    }
}

#[test]
fn a_distribution_is_that_of_all_stackings_and_of_those_that_stand() {
    let stackings = RandomStackings::new(5, FirstSign::Plus).unwrap();
    let ensemble = Ensemble::under(Region::SITE, stackings).unwrap();
    let tally = ensemble.run(&Choice::All, Shard::WHOLE).unwrap();
    let of = |binned, q: &BigRational| {
        let figure = figure::distribution(&tally, binned, q).unwrap();
        figure.unwrap().to_string()
    };
    // FCC has all of its 21 bottom normals in one bin: one stroke of a bin.
    let svg = of(Binned::Normals, &ratio(0, 1));
    let document = Document::parse(&svg).unwrap();
    let curves = of_class(&document, "curve");
    assert_eq!(curves.len(), 2);
    for curve in &curves {
        assert_eq!(curve.attribute("points").unwrap().split(' ').count(), 2);
    }
    let svg = of(Binned::Forces, &ratio(1, 2));
    assert!(svg.contains("all stackings") && svg.contains("those that stand"));
    // Some pull, and those that stand do not: the first curve begins further left.
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
        tally_pulls(&tally)
    );
}

/// Whether a contact of some stacking pulls by a bin or more.
fn tally_pulls(tally: &cannonpile_disorder::Tally) -> bool {
    let mut all = tally.faults.iter().map(|with| with.all.forces.first);
    all.any(|first| first < 0)
}

#[test]
fn parts_have_no_distribution_and_too_much_is_refused() {
    let stackings = RandomStackings::new(5, FirstSign::Plus).unwrap();
    let ensemble = Ensemble::under(Region::SITE, stackings).unwrap();
    let part = ensemble
        .run(&Choice::All, Shard::new(1, 2).unwrap())
        .unwrap();
    let half = ratio(1, 2);
    assert!(
        figure::distribution(&part, Binned::Forces, &half)
            .unwrap()
            .is_none()
    );
    let drawn = Choice::Drawn(Samples::new(10, 1, half.clone()).unwrap());
    let drawn = ensemble.run(&drawn, Shard::WHOLE).unwrap();
    let figure = figure::distribution(&drawn, Binned::Forces, &half).unwrap();
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
