//! The mean response to a load over random stackings: as maps, and as a function of the distance from the load axis.

use cannonpile::engine::bug;
use cannonpile::geometry::{directions, position};
use cannonpile::lattice::Site;
use cannonpile_disorder::{
    FirstSign, MeanForce, Place, RandomPiles, RandomStackings, check_fault_probability,
};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

use super::caption::{LIMIT, counted, readable};
use super::chart::{Chart, around_zero, colours};
use super::colour::{DIM, Scale};
use super::glyph::{Point, line, polygon, ring, text};
use super::page::{Bar, Figure};
use super::panel::{BAR, Panel};
use super::ticks::short;
use crate::Error;

/// Draws the mean response of the base to a load of 1 mg on a wide flat top, as a map from above for each fault probability.
///
/// The colour of a cell shows the mean load on a sphere at this position. The mean is over the stackings that begin with +
/// and have a sphere there. Red is compression, blue is tension. Each map has its own scale, whose largest magnitude is
/// printed above it.
///
/// The base is n steps below the load. The dashed circle has the radius nρ/√2, where ρ is the horizontal length of a
/// contact. This is the wave front for every fault probability above 0 ([`Wave`](cannonpile_disorder::Wave)).
///
/// # Errors
/// [`FaultProbability`](cannonpile_disorder::Error::FaultProbability) unless 0 ≤ q ≤ 1; [`Layers`](cannonpile::Error::Layers); [`Error::TooManyGlyphs`] for more than 20 000 cells.
///
/// # Examples
/// ```
/// use num_rational::BigRational;
///
/// let q = [0, 1].map(|q| BigRational::from_integer(q.into()));
/// let svg = cannonpile_figure::mean_response(4, &q)?.to_string();
/// // FCC transmits the load to three spheres, 1/3 mg each.
/// assert_eq!(svg.matches("data-value=\"0.3333333333333333\"").count(), 3);
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn mean_response(layers: i128, probabilities: &[BigRational]) -> Result<Figure, Error> {
    let stackings = RandomStackings::new(layers, FirstSign::Plus)?;
    let n = BigUint::from((layers - 1).unsigned_abs());
    let cells = (&n * &n + &n) * 3_u32 + 1_u32;
    let remedy = "use fewer layers, or fewer fault probabilities";
    readable(&(cells * probabilities.len()), LIMIT, "cells", remedy)?;
    let n = n.to_f64().ok_or_else(finite)?;
    let [alpha, beta, gamma] = steps();
    let of_place = |place: Place| -> Point {
        #[expect(clippy::cast_precision_loss, reason = "within a figure")]
        let [a, b] = [place.a, place.b].map(|n| n as f64);
        [0, 1].map(|axis| a * beta[axis] + b * gamma[axis])
    };
    // The corners of a cell are at a third of the distance to the neighbours of the same registry.
    let corners = [
        [&alpha, &beta],
        [&alpha, &gamma],
        [&beta, &gamma],
        [&beta, &alpha],
        [&gamma, &alpha],
        [&gamma, &beta],
    ]
    .map(|[from, to]| [0, 1].map(|axis| (from[axis] - to[axis]) / 3.0));
    let in_a_row = match probabilities.len() {
        1 => 1,
        2..=4 => 2,
        _ => 3,
    };
    #[expect(clippy::cast_precision_loss, reason = "a few maps")]
    let middle = |map: usize| -> Point {
        let [column, row] = [map % in_a_row, map / in_a_row].map(|n| n as f64);
        [column * (2.0 * n + 2.0), -row * (2.0 * n + 4.0)]
    };
    let reach = n + 1.0;
    let ends = (0..probabilities.len()).flat_map(|map| {
        let [u, v] = middle(map);
        [[u - reach, v - reach], [u + reach, v + reach + 2.0]]
    });
    let panel = Panel::around(ends, 0.0, [1.0; 2], BAR).with_page_end(262.0);
    let mut glyphs = Vec::new();
    for (map, q) in probabilities.iter().enumerate() {
        let [u, v] = middle(map);
        let rows = means(stackings, q)?;
        let loads = rows.iter().filter_map(|row| {
            let given = row.normal / row.probability;
            given.is_finite().then_some((row.place, given))
        });
        let loads: Vec<(Place, f64)> = loads.collect();
        let scale = Scale::around_zero(loads.iter().flat_map(|(_, load)| [*load, -load]));
        for (place, load) in loads {
            let [x, y] = of_place(place);
            let corners = corners.map(|[a, b]| panel.at([u + x + a, v + y + b]));
            let colour = scale.colour(load);
            let cell = polygon(&corners).class("cell");
            let cell = cell.set("data-a", place.a.to_string());
            let cell = cell.set("data-b", place.b.to_string());
            // A rim of the same colour closes the gaps between cells.
            glyphs.push(
                cell.with_value("data-value", load)
                    .fill(colour.clone())
                    .stroke(colour, 0.3),
            );
        }
        let front = panel.length(n / 2.0_f64.sqrt());
        let front = ring(panel.at([u, v]), front, DIM, 1.0).class("front");
        glyphs.push(front.set("stroke-dasharray", "4 3"));
        let words = format!("q = {q}, greatest {}", short(scale.most));
        glyphs.push(text(panel.at([u, v + reach + 1.0]), 14.0, words));
    }
    let bar = Bar {
        scale: Scale::around_zero([-1.0, 1.0]),
        name: "mean load",
        unit: "the greatest",
        remarks: vec!["dashed: r = nρ/√2".into()],
    };
    Ok(Figure {
        bar: Some(bar),
        note: Some(PRESTRESSED.into()),
        ..Figure::new(
            "Mean response over random stackings".into(),
            caption(layers),
            panel,
            glyphs,
        )
    })
}

/// Draws the mean response of the base to a load of 1 mg on a wide flat top, as curves over the distance r from its axis.
///
/// There is a curve for each fault probability.
/// The value at r is the total mean load of a ring: the sum over the positions within ρ/2 of this distance, where a position
/// without a sphere counts as 0. Stackings begin with +. The dashed line is at r = nρ/√2.
///
/// # Errors
/// As for [`mean_response`], but [`Error::TooManyGlyphs`] is for more than 20 000 points of a curve.
///
/// # Examples
/// ```
/// use num_rational::BigRational;
///
/// let q = [1, 2].map(|d| BigRational::new(1.into(), d.into()));
/// let svg = cannonpile_figure::mean_profile(12, &q)?.to_string();
/// assert_eq!(svg.matches("class=\"curve\"").count(), 2);
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn mean_profile(layers: i128, probabilities: &[BigRational]) -> Result<Figure, Error> {
    // The number of points of a curve in each interval of length ρ.
    const POINTS: u32 = 8;
    let stackings = RandomStackings::new(layers, FirstSign::Plus)?;
    let points = BigUint::from(layers.unsigned_abs()) * POINTS;
    readable(&points, LIMIT, "points of a curve", "use fewer layers")?;
    let (n, last) = ((layers - 1).to_f64(), points.to_u32());
    let (n, last) = n.zip(last).ok_or_else(finite)?;
    let mut curves = Vec::new();
    for q in probabilities {
        let rows = means(stackings, q)?;
        let loads: Vec<(f64, f64)> = rows.iter().filter_map(at_distance).collect();
        let points = (0..=last).map(|point| {
            let r = f64::from(point) / f64::from(POINTS);
            let within = loads.iter().filter(|(at, _)| (at - r).abs() <= 0.5);
            [r, within.map(|(_, load)| load).sum()]
        });
        curves.push(points.collect::<Vec<Point>>());
    }
    let ends = around_zero(curves.iter().flatten().map(|[_, load]| *load));
    let margin = ((ends[1] - ends[0]) * 0.05).max(f64::MIN_POSITIVE);
    let chart = Chart::new([0.0, n + 1.0], [ends[0] - margin, ends[1] + margin]);
    let [front, zero] = [
        [
            [n / 2.0_f64.sqrt(), ends[0] - margin],
            [n / 2.0_f64.sqrt(), ends[1] + margin],
        ],
        [[0.0, 0.0], [n + 1.0, 0.0]],
    ]
    .map(|ends| {
        let [from, to] = ends.map(|end| chart.at(end));
        line(from, to, DIM, 1.0)
    });
    let mut glyphs = vec![zero, front.class("front").set("stroke-dasharray", "4 3")];
    let colours = colours(curves.len());
    for (curve, colour) in curves.into_iter().zip(&colours) {
        glyphs.push(chart.curve(curve, colour));
    }
    let names = probabilities.iter().map(|q| format!("q = {q}"));
    let names = names.zip(colours).chain([("r = nρ/√2".into(), DIM.into())]);
    glyphs.extend(chart.legend(names));
    Ok(Figure {
        axes: Some(chart.axes(["r in ρ".into(), "load of a ring in mg".into()])),
        note: Some(PRESTRESSED.into()),
        ..Figure::new(
            "Mean response over random stackings, by distance".into(),
            caption(layers),
            chart.panel,
            glyphs,
        )
    })
}

const PRESTRESSED: &str = "the mean is over all stackings, unstable ones included: negative loads need a prestressed or glued pile";

fn caption(layers: i128) -> String {
    let layers = counted(&layers.into(), "layer");
    format!("{layers}, wide top, spheres without weight, 1 mg on one of them, first step +")
}

/// Returns the horizontal parts of the directions α, β and γ at a + step, in ρ.
fn steps() -> [Point; 3] {
    let down = directions(&0.5);
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|line| {
        let at = position(&line, &down);
        [at.x, at.y * 3.0_f64.sqrt()]
    })
}

/// Returns the distance and the mean load of a position.
fn at_distance(row: &MeanForce<f64>) -> Option<(f64, f64)> {
    let square = row.place.distance_squared()?;
    Some((square.to_f64()?.sqrt(), row.normal))
}

/// Returns the error for a number of layers outside the range of `f64`, which the limit on glyphs excludes.
fn finite() -> Error {
    bug("the number of layers of a figure is small").into()
}

/// Returns the mean load at each position that the load can reach, and the probability of a sphere there.
fn means(stackings: RandomStackings, q: &BigRational) -> Result<Vec<MeanForce<f64>>, Error> {
    check_fault_probability(q)?;
    let piles = RandomPiles::plane(stackings).weightless();
    let piles = piles.with_load(Site::APEX, BigRational::one())?;
    let q = q
        .to_f64()
        .ok_or_else(|| bug("a fault probability is a float"))?;
    Ok(piles.mean(&q)?.into_rows())
}
