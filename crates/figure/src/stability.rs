//! The tilts of gravity that a pile bears, as a polygon.

use cannonpile::geometry::square_across;
use cannonpile::lattice::{Dimension, Site};
use cannonpile_stability::{Margin, Tilt, tilts};
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::caption::caption;
use super::colour::{BLUE, DIM, ORANGE, PALE};
use super::glyph::{Glyph, Point, circle, cross, line, polygon, ring, text};
use super::page::{Axes, Figure};
use super::panel::{AXES, Panel};
use super::subject::Subject;
use super::ticks::{digits, short, ticks};
use crate::Error;

/// Draws the tilts of gravity that a pile bears, and the least one at which a contact opens.
///
/// The axes are the horizontal parts of gravity over its vertical part, in units of tanθ. Circles show angles of the tilt in
/// degrees, at the spacing of the subject. A dashed circle shows the margin.
///
/// # Errors
/// The errors of [`tilts`]. [`Error::Core`] for tilts beyond the range of `f64`.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_figure::Subject;
///
/// let pile = Pile::triangular(10)?;
/// let svg = cannonpile_figure::stability(&Subject::of_pile(&pile, &"1".parse()?)?)?.to_string();
/// // Three corners, and the margin: tan(tilt) = ½ tanθ.
/// assert_eq!(svg.matches("class=\"corner\"").count(), 3);
/// assert!(svg.contains("19.47°"));
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn stability(subject: &Subject<'_>) -> Result<Figure, Error> {
    let pile = subject.pile();
    let tilts = tilts(pile)?;
    let plane = Plane::of(subject)?;
    let corners = tilts.corners.iter().map(|tilt| plane.point(tilt));
    let corners: Vec<Point> = corners.collect::<Result<_, _>>()?;
    let farthest = corners.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    let reach = if farthest > 0.0 { 1.3 * farthest } else { 1.0 };
    let panel = Panel::around([[-reach, -reach], [reach, reach]], 0.0, [0.0; 2], AXES);
    let mut glyphs = plane.circles(&panel, reach);
    let on_page: Vec<Point> = corners.iter().map(|corner| panel.at(*corner)).collect();
    glyphs.push(if pile.dimension() == Dimension::Two {
        let [from, to] = [on_page.first(), on_page.last()];
        let centre = panel.at([0.0; 2]);
        line(*from.unwrap_or(&centre), *to.unwrap_or(&centre), BLUE, 6.0).class("tilts")
    } else {
        let area = polygon(&on_page).class("tilts").fill(BLUE);
        area.set("fill-opacity", 0.18).stroke(BLUE, 2.0)
    });
    for (tilt, at) in tilts.corners.iter().zip(&on_page) {
        let corner = circle(*at, 3.0).class("corner").fill(BLUE);
        let exact = tilt.each_ref().map(ToString::to_string).join(",");
        glyphs.push(corner.set("data-exact", exact));
        let angle = degrees(subject.angle(&plane.square(tilt))?);
        glyphs.extend(beside(&panel, *at, angle, BLUE));
    }
    let mut summary = caption(subject)?;
    if let Some(margin) = &tilts.margin {
        glyphs.extend(of_margin(subject, &plane, &panel, margin)?);
        summary = format!("{summary}; {}", in_words(subject, margin)?);
    }
    glyphs.extend(cross(panel.at([0.0; 2]), 5.0));
    let y = match (pile.dimension(), pile.is_regular()) {
        (Dimension::Two, _) => "",
        (Dimension::Three, true) => "√3·y: tilt along y in tanθ",
        (Dimension::Three, false) => "2cosφ·y: tilt along y in tanθ",
    };
    Ok(Figure {
        note: subject.note(),
        axes: Some(Axes {
            names: ["x: tilt along x in tanθ".into(), y.into()],
            origin: [0.0; 2],
            unit: [1.0; 2],
        }),
        ..Figure::new(
            "Tilts of gravity that the pile bears".into(),
            summary,
            panel,
            glyphs,
        )
    })
}

/// The plane of tilts, with the horizontal parts of gravity as coordinates, in tanθ.
struct Plane {
    tan: f64,
    /// 4cos²φ.
    square: BigRational,
    /// 2cosφ.
    across: f64,
}

impl Plane {
    fn of(subject: &Subject<'_>) -> Result<Self, Error> {
        let pile = subject.pile();
        let square = square_across(pile.sin_phi());
        Ok(Self {
            tan: subject.tan()?,
            across: float(&square)?.sqrt(),
            square,
        })
    }

    fn point(&self, [x, y]: &Tilt) -> Result<Point, Error> {
        Ok([float(x)?, self.across * float(y)?])
    }

    /// Returns |t|².
    fn square(&self, [x, y]: &Tilt) -> BigRational {
        x * x + &self.square * y * y
    }

    /// Returns circles of equal angle around upright gravity, with their labels.
    fn circles(&self, panel: &Panel, reach: f64) -> Vec<Glyph> {
        let greatest = (reach * self.tan).atan().to_degrees();
        let mut glyphs = Vec::new();
        for angle in ticks(0.0, greatest, 4) {
            let radius = angle.to_radians().tan() / self.tan;
            if radius <= 0.0 || radius > reach {
                continue;
            }
            let circle = ring(panel.at([0.0; 2]), panel.length(radius), PALE, 1.0);
            glyphs.push(circle.class("angle").with_value("data-angle", angle));
            let aside = radius / 2.0_f64.sqrt();
            let label = text(panel.at([aside, aside]), 12.0, format!("{}°", short(angle)));
            glyphs.extend(label.fill(DIM).with_rim());
        }
        glyphs
    }
}

/// Returns a dashed circle and the point on it where a contact opens.
fn of_margin(
    subject: &Subject<'_>,
    plane: &Plane,
    panel: &Panel,
    margin: &Margin,
) -> Result<Vec<Glyph>, Error> {
    let centre = panel.at([0.0; 2]);
    let radius = panel.length(float(&margin.squared)?.sqrt());
    let at = panel.at(plane.point(&margin.tilt)?);
    let circle_of = ring(centre, radius, ORANGE, 1.5).class("margin");
    let circle_of = circle_of.set("stroke-dasharray", "6 4");
    let mut glyphs = vec![
        circle_of.set("data-exact", margin.squared.to_string()),
        line(centre, at, ORANGE, 1.5),
        circle(at, 4.0).class("opens").fill(ORANGE),
    ];
    let angle = degrees(subject.angle(&margin.squared)?);
    // The label is beside the line, where no corner is.
    let [dx, dy] = [0, 1].map(|n| at[n] - centre[n]);
    let length = dx.hypot(dy).max(1.0);
    let middle = [0, 1].map(|n| centre[n].midpoint(at[n]));
    let beside = [
        middle[0] - 26.0 * dy / length,
        middle[1] + 26.0 * dx / length + if dx == 0.0 { 16.0 } else { 0.0 },
    ];
    glyphs.extend(text(beside, 14.0, angle).fill(ORANGE).with_rim());
    Ok(glyphs)
}

/// Returns the margin and its contact as text.
fn in_words(subject: &Subject<'_>, margin: &Margin) -> Result<String, Error> {
    let (site, direction) = margin.opens;
    let Site { k, .. } = site;
    let place = format!("{k},{} {}", subject.indices(site), direction.name());
    let angle = degrees(subject.angle(&margin.squared)?);
    Ok(format!("{place} opens at {angle}, t² = {}", margin.squared))
}

/// Returns a label at a point, on the side away from the centre.
fn beside(panel: &Panel, at: Point, words: String, colour: &str) -> [Glyph; 2] {
    const APART: f64 = 17.0;
    let centre = panel.at([0.0; 2]);
    let away = [at[0] - centre[0], at[1] - centre[1]];
    let length = away[0].hypot(away[1]);
    let [dx, dy] = if length > 0.0 {
        away.map(|part| part / length)
    } else {
        [0.0, -1.0]
    };
    // Texts are wider than high.
    let label = text([at[0] + 1.7 * APART * dx, at[1] + APART * dy], 14.0, words);
    label.fill(colour).with_rim()
}

fn degrees(angle: f64) -> String {
    format!("{}°", digits(angle, 4))
}

/// Returns a rational as a float for a position on the page.
fn float(number: &BigRational) -> Result<f64, Error> {
    let float = number.to_f64().filter(|float| float.is_finite());
    float.ok_or_else(|| cannonpile::Error::overflow("a tilt of gravity", "f64").into())
}

#[cfg(test)]
mod tests {
    use cannonpile::Pile;

    use super::*;

    #[test]
    fn tilts_beyond_the_floats_are_refused() {
        let pile = Pile::discs(2).unwrap();
        let far = BigRational::from_integer(num_bigint::BigInt::from(10).pow(400));
        let load = cannonpile::Load {
            down: far,
            ..cannonpile::Load::zero()
        };
        let pile = pile.with_load(Site::APEX, load).unwrap();
        let subject = Subject::of_pile(&pile, &"6/5".parse().unwrap()).unwrap();
        let refused = stability(&subject).unwrap_err().to_string();
        assert!(refused.contains("a tilt of gravity"), "{refused}");
    }

    #[test]
    fn unstable_piles_and_discs_have_figures() {
        let draw = |pile: &Pile| {
            let subject = Subject::of_pile(pile, &"6/5".parse().unwrap()).unwrap();
            stability(&subject).unwrap().to_string()
        };
        let discs = draw(&Pile::discs(4).unwrap());
        assert_eq!(discs.matches("class=\"corner\"").count(), 2);
        let hcp = "+-+-+-".parse().unwrap();
        let hcp = draw(&Pile::under(cannonpile::lattice::Region::SITE, hcp).unwrap());
        assert!(!hcp.contains("class=\"margin\"") && hcp.contains("unstable"));
        let edge = "+++-+".parse().unwrap();
        let edge = draw(&Pile::under(cannonpile::lattice::Region::SITE, edge).unwrap());
        assert!(
            edge.contains("class=\"margin\"") && edge.contains("opens at 0°"),
            "{edge}"
        );
        let isosceles = Pile::isosceles(4, BigRational::new(2.into(), 5.into())).unwrap();
        assert!(draw(&isosceles).contains("2cosφ·y"));
    }
}
