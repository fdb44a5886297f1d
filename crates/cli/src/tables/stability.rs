//! The tables of the stability under a tilt of gravity.

use cannonpile::lattice::{Dimension, Direction, Site};
use cannonpile::{Pile, Verdict};
use cannonpile_dem::table::{Cell, Column, Table, indices, places};
use cannonpile_stability::Tilt;
use num_rational::BigRational;

/// Returns one row: the squared margin, its angle in degrees, and the contact that opens there.
///
/// The columns are `margin_squared, angle, k, i, j, direction, stands`; discs have no `j`. Without a spacing the angle is
/// empty.
pub(crate) fn margin(
    pile: &Pile,
    squared: Option<BigRational>,
    angle: Option<f64>,
    opens: Option<(Site, Direction)>,
    verdict: Verdict,
) -> Table<'static> {
    let angle_column = Column {
        unit: "°",
        ..Column::plain("angle")
    };
    let mut entries = vec![
        (
            Column::measured("margin_squared", "tan²θ"),
            squared.map_or(Cell::Missing, Cell::from),
        ),
        (angle_column, angle.map_or(Cell::Missing, Cell::from)),
    ];
    let columns = indices(pile, &["k"]);
    let cells = match opens {
        Some((site, _)) => std::iter::once(site.k.into())
            .chain(places(pile, site))
            .collect(),
        None => vec![Cell::Missing; columns.len()],
    };
    entries.extend(columns.into_iter().zip(cells));
    let direction = opens.map_or(Cell::Missing, |(_, direction)| direction.name().into());
    entries.push((Column::plain("direction"), direction));
    entries.push((Column::plain("stands"), verdict.name().into()));
    Table::record(entries)
}

/// Returns a row `x, y` for each corner of the polygon of tilts that a pile bears; discs have no `y`.
pub(crate) fn polygon(pile: &Pile, corners: Vec<Tilt>) -> Table<'static> {
    let flat = pile.dimension() == Dimension::Two;
    let mut columns = vec![Column::measured("x", "tanθ")];
    if !flat {
        let unit = if pile.is_regular() {
            "√3·tanθ"
        } else {
            "2cosφ·tanθ"
        };
        columns.push(Column::measured("y", unit));
    }
    let parts = columns.len();
    let row = move |tilt: Tilt| Ok(tilt.into_iter().take(parts).map(Cell::from).collect());
    let rows = corners.into_iter().map(row);
    Table::of_rows(columns, "corners", rows)
}

#[cfg(test)]
mod tests {
    use super::super::test::csv;
    use super::*;

    #[test]
    fn the_margin_of_a_straight_pile() {
        let pile = Pile::triangular(4).unwrap();
        let least = cannonpile_stability::margin(&pile).unwrap().unwrap();
        let head = "margin_squared_over_tan2_theta,angle,k,i,j,direction,stands\n1/4,19.5,";
        for (opens, contact) in [
            (Some(least.opens), "0,0,0,alpha,yes\n"),
            (None, ",,,,yes\n"),
        ] {
            let csv = csv(margin(
                &pile,
                Some(least.squared.clone()),
                Some(19.5),
                opens,
                Verdict::Yes,
            ));
            assert_eq!(csv, format!("{head}{contact}"));
        }
    }

    #[test]
    fn corners_of_spheres_and_discs() {
        let corners = |pile: &Pile| {
            let tilts = cannonpile_stability::tilts(pile).unwrap();
            csv(polygon(pile, tilts.corners))
        };
        let spheres = corners(&Pile::triangular(4).unwrap());
        assert!(
            spheres.starts_with("x_over_tan_theta,y_over_sqrt3_tan_theta\n")
                && spheres.lines().count() == 4
        );
        for corner in ["1,0", "-1/2,1/2", "-1/2,-1/2"] {
            assert!(spheres.lines().any(|line| line == corner), "{spheres}");
        }
        assert_eq!(
            corners(&Pile::discs(4).unwrap()),
            "x_over_tan_theta\n-1\n1\n"
        );
    }
}
