//! The contact forces as a network: the force chains of a pile.

use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use super::caption::{LIMIT, caption, counted, readable};
use super::colour::{BLACK, GREY, PALE, Scale};
use super::layer::Layer;
use super::mark::{Mark, Point, circle, line, ring};
use super::page::{Axes, Bar, Figure, Layout};
use super::panel::{Bounds, Margins, Panel};
use super::response::middle;
use super::subject::{Subject, below};
use crate::lattice::{Dimension, Site};
use crate::scalar::Ring;
use crate::shape::Selection;
use crate::{ContactForce, Error};

/// The most spheres of a pile whose forces are found all, for a section.
const LIMIT_OF_ALL: u32 = 200_000;

/// A contact as it is seen.
struct Link {
    contact: ContactForce<BigRational>,
    /// Rounded once; negative is pull.
    force: f64,
    /// The centres of the upper and the lower sphere, to the right and upwards, in R.
    ends: [Point; 2],
}

/// Spheres, and the contacts between them.
struct Network {
    spheres: Vec<(Site, Point)>,
    links: Vec<Link>,
    /// The lines below the bar.
    remarks: Vec<String>,
    axes: Axes,
}

/// Returns the contact forces in a vertical section through the middle of the pile, one row of spheres a layer thick, with y
/// to the right; of discs the whole pile.
///
/// The rows are those nearest to the vertical plane across x through the middle row of the top. Below a row is either the
/// same row, under α and β, or the next, under γ. Contacts are `<line class="contact" data-direction="…" data-force="…">`
/// with the indices of the upper sphere; blue is pull, red is push.
///
/// # Errors
/// [`Error::TooManyMarks`] for a pile of more than 200 000 spheres or a section of more than 20 000; [`Error::Overflow`] for
/// forces beyond floats; those of the forces of the pile.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::figure::{self, Subject};
/// use cannonpile::geometry::Spacing;
/// use num_rational::BigRational;
///
/// // Of discs all are in it: 10, of which 6 have two below.
/// let pile = Pile::discs(4)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let svg = figure::section(&Subject::of_pile(&pile, &spacing)?)?.to_string();
/// assert_eq!(["sphere", "contact"].map(|class| svg.matches(&format!("class=\"{class}\"")).count()), [10, 12]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn section(subject: &Subject<'_>) -> Result<Figure, Error> {
    let pile = subject.pile();
    let remedy = "use fewer layers, or show one of them";
    readable(&pile.spheres(), LIMIT_OF_ALL, "spheres", remedy)?;
    let discs = subject.is_of_discs();
    let across = usize::from(!discs);
    let rows = rows(subject)?;
    let mut spheres = Vec::new();
    let mut first = None;
    for row in pile.rows(Selection::All)? {
        if !rows.contains(&(row.k, row.j)) {
            continue;
        }
        for site in row {
            let place = subject.from(*first.get_or_insert(site), site)?;
            spheres.push((site, [place[across], place[2]]));
        }
    }
    readable(&spheres.len().into(), LIMIT, "spheres of a section", remedy)?;
    let (mut links, mut pulling) = (Vec::new(), 0);
    for contact in subject.contacts(Selection::All)? {
        let contact = contact?;
        pulling += usize::from(contact.force.is_negative());
        let lower = below(pile, contact.site, contact.direction)?;
        let ends = [contact.site, lower].map(|site| place(&spheres, site));
        if let [Some(upper), Some(lower)] = ends {
            links.push(link(subject, contact, [upper, lower])?);
        }
    }
    let shown = links.iter().filter(|link| link.force < 0.0).count();
    let mut remarks = Vec::new();
    if pulling > 0 {
        remarks.push(format!("{} pull,", counted(&pulling.into(), "contact")));
        remarks.push(if shown == 0 {
            "none of them here".into()
        } else {
            format!("{shown} of them here")
        });
    }
    let origin = first.map_or(Ok([0.0; 3]), |first| subject.position(first))?;
    let unit = subject.length_unit();
    let name = if discs { "x" } else { "y" };
    let network = Network {
        remarks,
        axes: Axes {
            names: [format!("{name} in {unit}"), format!("z in {unit}")],
            origin: [origin[across], origin[2]],
            unit: subject.radius()?,
        },
        spheres,
        links,
    };
    let (title, sight) = if discs {
        ("Force network", "")
    } else {
        ("Force network in a vertical section", "; one row a layer")
    };
    network.figure(subject, title.into(), sight, true)
}

/// Returns the contact forces of layer `k` with the one below, seen from above; of discs from the side.
///
/// # Errors
/// [`Error::LayerOutside`]; [`Error::OnFloor`] for the bottom layer; [`Error::TooManyMarks`] for more than 20 000 spheres;
/// [`Error::Overflow`] for forces beyond floats; those of the forces of the pile.
///
/// # Examples
/// ```
/// use cannonpile::figure::{self, Subject};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::{Error, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let subject = Subject::of_pile(&pile, &spacing)?;
/// // Every sphere of a layer stands on three others.
/// assert_eq!(figure::layer(&subject, 2)?.to_string().matches("class=\"contact\"").count(), 18);
/// // Nothing is below the bottom layer.
/// assert!(matches!(figure::layer(&subject, 9), Err(Error::OnFloor { .. })));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn layer(subject: &Subject<'_>, k: i128) -> Result<Figure, Error> {
    let pile = subject.pile();
    let layer = Layer::new(subject, k, LIMIT, "choose a higher layer")?;
    if k == pile.layers() - 1 {
        let site = middle(pile, k)?;
        return Err(Error::OnFloor { site });
    }
    let mut links = Vec::new();
    for contact in subject.contacts(Selection::Layer(k))? {
        let contact = contact?;
        let lower = below(pile, contact.site, contact.direction)?;
        let ends = [
            layer.place(subject, contact.site)?,
            layer.place(subject, lower)?,
        ];
        links.push(link(subject, contact, ends)?);
    }
    let pulling = links.iter().filter(|link| link.force < 0.0).count();
    let remark = format!("{} pull", counted(&pulling.into(), "contact"));
    let network = Network {
        links,
        remarks: if pulling > 0 {
            vec![remark]
        } else {
            Vec::new()
        },
        axes: layer.axes(subject)?,
        spheres: layer.spheres,
    };
    let title = format!("Forces of layer {k} on the next");
    network.figure(subject, title, "; seen from above", false)
}

impl Network {
    fn figure(
        mut self,
        subject: &Subject<'_>,
        title: String,
        sight: &str,
        floor: bool,
    ) -> Result<Figure, Error> {
        let ends = self.links.iter().flat_map(|link| link.ends);
        let points = self.spheres.iter().map(|(_, at)| *at).chain(ends);
        let bounds = Bounds::around(points, 1.3).at_least(10.0, 5.0);
        let panel = Panel::new(bounds, Margins::BAR, 262.0);
        let radius = panel.length(1.0);
        let mut marks = Vec::new();
        if floor {
            let heights = self.spheres.iter().map(|(_, [_, v])| *v);
            let [_, y] = panel.at([0.0, heights.fold(0.0, f64::min) - 1.0]);
            marks.push(line([panel.left, y], [panel.right(), y], BLACK, 1.5).class("floor"));
        }
        for (site, at) in &self.spheres {
            marks.push(
                ring(panel.at(*at), radius, PALE, 0.8)
                    .class("sphere")
                    .of(*site),
            );
        }
        // The strongest on top, and pulls over pushes.
        self.links.sort_by(|a, b| {
            let sides = (a.force < 0.0).cmp(&(b.force < 0.0));
            sides.then(a.force.abs().total_cmp(&b.force.abs()))
        });
        let scale = Scale::of_lines(self.links.iter().map(|link| link.force));
        let widest = (radius * 0.62).min(18.0);
        marks.extend(
            self.links
                .iter()
                .map(|link| link.mark(&panel, &scale, widest)),
        );
        let dot = (radius * 0.13).clamp(0.6, 4.0);
        let dots = self.spheres.iter();
        marks.extend(dots.map(|(_, at)| circle(panel.at(*at), dot).fill(BLACK)));
        let bar = Bar {
            scale,
            name: "contact force",
            unit: subject.force_unit(),
            remarks: self.remarks,
        };
        Ok(Figure {
            title,
            caption: format!("{}{sight}", caption(subject)?),
            note: subject.note(),
            panel,
            axes: Some(self.axes),
            bar: Some(bar),
            marks,
            layout: Layout::default(),
        })
    }
}

impl Link {
    /// Returns the contact as a line: dashed if it bears nothing, and never too thin for its colour if it pulls.
    fn mark(&self, panel: &Panel, scale: &Scale, widest: f64) -> Mark {
        let [upper, lower] = self.ends.map(|at| panel.at(at));
        let width = widest * scale.part(self.force).abs();
        let mark = if self.force == 0.0 {
            line(upper, lower, GREY, 1.0).set("stroke-dasharray", "2 3")
        } else {
            let least = if self.force < 0.0 { 2.0 } else { 1.0 };
            let mark = line(upper, lower, scale.colour(self.force), width.max(least));
            mark.set("stroke-linecap", "round")
        };
        let mark = mark.class("contact").of(self.contact.site);
        let mark = mark.set("data-direction", self.contact.direction.name());
        mark.valued("data-force", self.force)
    }
}

fn link(
    subject: &Subject<'_>,
    contact: ContactForce<BigRational>,
    ends: [Point; 2],
) -> Result<Link, Error> {
    let force = subject.force(&contact.force)?;
    Ok(Link {
        contact,
        force,
        ends,
    })
}

/// Returns where a sphere is, of a list in row order.
fn place(spheres: &[(Site, Point)], site: Site) -> Option<Point> {
    let found = spheres.binary_search_by_key(&site, |(site, _)| *site);
    found
        .ok()
        .and_then(|found| spheres.get(found))
        .map(|(_, at)| *at)
}

/// Returns (k, j) of the row of each layer that is nearest to the plane of the section, where one is at most half a row away.
fn rows(subject: &Subject<'_>) -> Result<Vec<(i128, i128)>, Error> {
    let pile = subject.pile();
    if pile.dimension() == Dimension::Two {
        return Ok((0..pile.layers()).map(|k| (k, 0)).collect());
    }
    let plane = subject.rows(middle(pile, 0)?)?;
    let half = BigRational::new(1.into(), 2.into());
    let mut rows = Vec::new();
    for k in 0..pile.layers() {
        let region = pile.shape().layer(k)?;
        let Some((first, i)) = region.rows(k).next().map(|row| (row.j, row.i.start)) else {
            continue;
        };
        let apart = &plane - subject.rows(Site { i, j: first, k })?;
        let nearest = apart.round().to_integer().to_i128();
        let Some(j) = nearest.and_then(|steps| first.checked_add(steps)) else {
            continue;
        };
        let j = j.clamp(first, *region.y().end());
        let off = apart - BigRational::from_i128(j - first);
        if off.abs() <= half {
            rows.push((k, j));
        }
    }
    Ok(rows)
}
