//! The network of contact forces.

use std::collections::BTreeMap;

use cannonpile::lattice::{ContactKind, Site};
use cannonpile::shape::Selection;
use num_rational::BigRational;
use num_traits::Signed;

use super::caption::{LIMIT, caption, counted, readable};
use super::colour::{BLACK, GREY, PALE, Scale};
use super::glyph::{Glyph, Point, circle, line, ring};
use super::layer::Layer;
use super::page::{Axes, Bar, Figure};
use super::panel::{BAR, Panel};
use super::response::middle;
use super::subject::{Subject, below};
use crate::Error;

/// The largest number of spheres of a pile for a section, which needs all forces of the pile.
const LIMIT_OF_ALL: u32 = 200_000;

/// A contact of the figure.
struct Link {
    site: Site,
    direction: ContactKind,
    /// The force, rounded once; tension is negative.
    force: f64,
    /// The centres of both spheres, to the right and upwards, in R.
    ends: [Point; 2],
}

/// Spheres, and the contacts between them.
struct Network {
    /// The centres, to the right and upwards, in R.
    spheres: BTreeMap<Site, Point>,
    links: Vec<Link>,
    /// The number of tensile contacts, in the whole selected part of the pile.
    tensile: usize,
    axes: Axes,
}

/// Draws the contact forces in a vertical section through the middle of the pile, with y to the right.
///
/// The section contains one row of spheres of each layer: the row nearest to the plane perpendicular to x through the
/// middle row of the top. The directions α and β lead to the same row of the layer below, and γ leads to the next row.
/// A pile of discs is drawn as a whole.
///
/// Contacts are `<line class="contact" data-direction="…" data-force="…">` with the indices of the upper sphere. Blue is
/// tension, red is compression.
///
/// # Errors
/// [`Error::TooManyGlyphs`] for a pile of more than 200 000 spheres or a section of more than 20 000;
/// [`Overflow`](cannonpile::Error::Overflow) for forces outside the range of `f64`; the errors of the force
/// computation.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_figure::Subject;
/// use cannonpile::geometry::Spacing;
/// use num_rational::BigRational;
///
/// // The figure contains all 10 discs. Six of them have two contacts below.
/// let pile = Pile::discs(4)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let svg = cannonpile_figure::section(&Subject::of_pile(&pile, &spacing)?)?.to_string();
/// assert_eq!(["sphere", "contact"].map(|class| svg.matches(&format!("class=\"{class}\"")).count()), [10, 12]);
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn section(subject: &Subject<'_>) -> Result<Figure, Error> {
    let pile = subject.pile();
    let remedy = "use fewer layers, or show one of them";
    readable(&pile.sphere_count(), LIMIT_OF_ALL, "spheres", remedy)?;
    let discs = subject.is_of_discs();
    let across = usize::from(!discs);
    let plane = subject.rows(middle(pile, 0)?)?;
    let half = BigRational::new(1.into(), 2.into());
    let mut spheres = BTreeMap::new();
    let mut first = None;
    for row in pile.rows(Selection::All)? {
        let Some(site) = row.clone().into_iter().next() else {
            continue;
        };
        let off = &plane - subject.rows(site)?;
        if !discs && !(-&half..half.clone()).contains(&off) {
            continue;
        }
        for site in row {
            let place = subject.from(*first.get_or_insert(site), site)?;
            spheres.insert(site, [place[across], place[2]]);
        }
    }
    readable(&spheres.len().into(), LIMIT, "spheres of a section", remedy)?;
    let place = |site: Site| Ok(spheres.get(&site).copied());
    let (links, tensile) = links(subject, Selection::All, place)?;
    let origin = first.map_or(Ok([0.0; 3]), |first| subject.position(first))?;
    let unit = subject.length_unit();
    let name = if discs { "x" } else { "y" };
    let axes = Axes {
        names: [format!("{name} in {unit}"), format!("z in {unit}")],
        origin: [origin[across], origin[2]],
        unit: [subject.radius()?; 2],
    };
    let (title, sight) = if discs {
        ("Force network", "")
    } else {
        (
            "Force network in a vertical section",
            "; one row of each layer",
        )
    };
    let network = Network {
        spheres,
        links,
        tensile,
        axes,
    };
    network.figure(subject, title.into(), sight, true)
}

/// Draws the contact forces between layer `k` and the layer below, seen from above. Discs lie on a line along x.
///
/// # Errors
/// [`LayerOutside`](cannonpile::Error::LayerOutside) if there is no layer `k`; [`OnFloor`](cannonpile::Error::OnFloor)
/// for the bottom layer; [`Error::TooManyGlyphs`] for more than 20 000 spheres;
/// [`Overflow`](cannonpile::Error::Overflow) for forces outside the range of `f64`; the errors of the force
/// computation.
///
/// # Examples
/// ```
/// use cannonpile_figure::Subject;
/// use cannonpile::geometry::Spacing;
/// use cannonpile_figure::Error;
/// use cannonpile::Pile;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let subject = Subject::of_pile(&pile, &spacing)?;
/// // Three spheres support every sphere of a layer.
/// assert_eq!(cannonpile_figure::layer(&subject, 2)?.to_string().matches("class=\"contact\"").count(), 18);
/// // The bottom layer has no contacts below.
/// assert!(matches!(cannonpile_figure::layer(&subject, 9), Err(Error::Core(cannonpile::Error::OnFloor { .. }))));
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn layer(subject: &Subject<'_>, k: i128) -> Result<Figure, Error> {
    let pile = subject.pile();
    let layer = Layer::new(subject, k, LIMIT, "choose a higher layer")?;
    if k == pile.layers() - 1 {
        let site = middle(pile, k)?;
        return Err(cannonpile::Error::OnFloor { site }.into());
    }
    let place = |site: Site| layer.place(subject, site).map(Some);
    let (links, tensile) = links(subject, Selection::Layer(k), place)?;
    let network = Network {
        links,
        tensile,
        axes: layer.axes(subject)?,
        spheres: layer.spheres.into_iter().collect(),
    };
    let title = format!("Forces of layer {k} on the next");
    network.figure(subject, title, "; seen from above", false)
}

/// Returns the contacts of a part of the pile whose spheres are both in the figure, and the number of tensile contacts of
/// the whole part.
fn links(
    subject: &Subject<'_>,
    part: Selection,
    place: impl Fn(Site) -> Result<Option<Point>, Error>,
) -> Result<(Vec<Link>, usize), Error> {
    let (mut links, mut tensile) = (Vec::new(), 0);
    for contact in subject.forces().contacts(part)? {
        let contact = contact?;
        tensile += usize::from(contact.force.is_negative());
        let lower = below(subject.pile(), contact.site, contact.direction)?;
        if let (Some(upper), Some(lower)) = (place(contact.site)?, place(lower)?) {
            links.push(Link {
                force: subject.force(&contact.force)?,
                site: contact.site,
                direction: contact.direction.into(),
                ends: [upper, lower],
            });
        }
    }
    for (contact, force) in subject.horizontal(part)? {
        let neighbour = subject.pile().shape().neighbour(contact)?;
        if let (Some(one), Some(other)) = (place(contact.site)?, place(neighbour)?) {
            links.push(Link {
                force: subject.force(&force)?,
                site: contact.site,
                direction: contact.axis.into(),
                ends: [one, other],
            });
        }
    }
    Ok((links, tensile))
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
        let points = self.spheres.values().copied().chain(ends);
        let panel = Panel::around(points, 1.3, [10.0, 5.0], BAR).with_page_end(262.0);
        let radius = panel.length(1.0);
        let mut glyphs = Vec::new();
        if floor {
            let heights = self.spheres.values().map(|[_, v]| *v);
            let [_, y] = panel.at([0.0, heights.fold(0.0, f64::min) - 1.0]);
            glyphs.push(line([panel.left, y], [panel.right(), y], BLACK, 1.5).class("floor"));
        }
        for (site, at) in &self.spheres {
            let sphere = ring(panel.at(*at), radius, PALE, 0.8).class("sphere");
            glyphs.push(sphere.of(*site));
        }
        // Strong contacts are drawn over weak ones, and tensile over compressive ones.
        self.links.sort_by(|a, b| {
            let sides = (a.force < 0.0).cmp(&(b.force < 0.0));
            sides.then(a.force.abs().total_cmp(&b.force.abs()))
        });
        let scale = Scale::of_lines(self.links.iter().map(|link| link.force));
        let widest = (radius * 0.62).min(18.0);
        let links = self.links.iter();
        glyphs.extend(links.map(|link| link.glyph(&panel, &scale, widest)));
        let dot = (radius * 0.13).clamp(0.6, 4.0);
        let dots = self.spheres.values();
        glyphs.extend(dots.map(|at| circle(panel.at(*at), dot).fill(BLACK)));
        let bar = Bar {
            scale,
            name: "contact force",
            unit: subject.force_unit(),
            remarks: self.remarks(),
        };
        let caption = format!("{}{sight}{}", caption(subject)?, subject.sight());
        let note = if floor {
            subject.note()
        } else {
            subject.note_of_part(self.tensile > 0)
        };
        Ok(Figure {
            note,
            axes: Some(self.axes),
            bar: Some(bar),
            ..Figure::new(title, caption, panel, glyphs)
        })
    }

    /// Returns the lines below the colour bar: the number of tensile contacts, and how many of them the figure shows.
    fn remarks(&self) -> Vec<String> {
        let contacts = counted(&self.tensile.into(), "contact");
        let shown = self.links.iter().filter(|link| link.force < 0.0).count();
        match (self.tensile, shown) {
            (0, _) => Vec::new(),
            (_, 0) => vec![
                format!("{contacts} in tension,"),
                "none of them here".into(),
            ],
            (all, _) if all == shown => vec![format!("{contacts} in tension")],
            (..) => vec![
                format!("{contacts} in tension,"),
                format!("{shown} of them here"),
            ],
        }
    }
}

impl Link {
    /// Returns the contact as a line. An open contact is dashed, and a tensile one is wide enough to show its colour.
    fn glyph(&self, panel: &Panel, scale: &Scale, widest: f64) -> Glyph {
        let [upper, lower] = self.ends.map(|at| panel.at(at));
        let width = widest * scale.part(self.force).abs();
        let glyph = if self.force == 0.0 {
            line(upper, lower, GREY, 1.0).set("stroke-dasharray", "2 3")
        } else {
            let least = if self.force < 0.0 { 2.0 } else { 1.0 };
            let glyph = line(upper, lower, scale.colour(self.force), width.max(least));
            glyph.set("stroke-linecap", "round")
        };
        let glyph = glyph.class("contact").of(self.site);
        let glyph = glyph.set("data-direction", self.direction.name());
        glyph.with_value("data-force", self.force)
    }
}
