//! The contact forces as a network: the force chains of a pile.

mod section;

use num_bigint::BigUint;
use num_rational::BigRational;

use super::canvas::{Canvas, Drawing, circle, line, ring};
use super::cells::floor;
use super::colour::{BLACK, GREY, Scale, WHITE};
use super::layer::Layer;
use super::panel::{Bounds, Margins, Panel};
use super::response::middle;
use super::subject::{nearest, readable};
use super::{Subject, of};
use crate::lattice::{Direction, Site};
use crate::shape::Selection;
use crate::{ContactForce, Error};

/// Contacts, and where they are in the figure.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::figure::{Network, Subject};
/// use cannonpile::geometry::Spacing;
/// use num_rational::BigRational;
///
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let pile = Pile::triangular(10)?;
/// let subject = Subject::of_pile(&pile, &spacing)?;
/// // Every sphere of a layer stands on three others.
/// assert_eq!(Network::layer(&subject, 2)?.links.len(), 18);
/// // In a section there are those whose supports are in it too.
/// let section = Network::section(&subject)?;
/// assert!(section.links.iter().all(|link| link.force > 0.0));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Network {
    /// The contacts.
    pub links: Vec<Link>,
    /// The spheres they are between: where they are, to the right and upwards, in R.
    pub spheres: Vec<(Site, [f64; 2])>,
    /// The unit of the forces.
    pub unit: &'static str,
    /// Their colours: blue pulls, orange pushes.
    pub scale: Scale,
    sight: Sight,
    caption: String,
}

/// A contact as it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The upper sphere.
    pub site: Site,
    /// Where the lower one lies.
    pub direction: Direction,
    /// The force, rounded once; negative is pull.
    pub force: f64,
    /// The centres of both, to the right and upwards, in R.
    pub ends: [[f64; 2]; 2],
}

/// From where the contacts are seen.
#[derive(Clone, Debug)]
enum Sight {
    /// From the side; spheres of discs are all in one plane.
    Section { discs: bool },
    /// From above.
    Layer(Layer, i128),
}

/// The most spheres of a section or a layer.
const LIMIT: u32 = 20_000;

/// The most spheres of a pile whose forces are found all, for a section.
const LIMIT_OF_ALL: u32 = 200_000;

impl Network {
    /// A vertical section through the middle of the pile, one row of spheres a layer thick, seen along x; of discs the
    /// whole pile.
    ///
    /// The rows are those nearest to the vertical plane across x through the middle row of the top. Below a row is
    /// either the same row, under α and β, or the next, under γ.
    ///
    /// # Errors
    /// [`Error::TooManyMarks`] for a pile of more than 200 000 spheres or a section of more than 20 000;
    /// [`Error::Overflow`] for forces beyond floats; those of [`Forces::contacts`](crate::Forces::contacts).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{Network, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// // Of discs all are in it: 10, of which 6 have two below.
    /// let pile = Pile::discs(4)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let section = Network::section(&Subject::of_pile(&pile, &spacing)?)?;
    /// assert_eq!((section.spheres.len(), section.links.len()), (10, 12));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn section(subject: &Subject<'_>) -> Result<Self, Error> {
        let pile = subject.pile();
        let remedy = "use fewer layers, or --layer for one of them";
        readable(&pile.spheres(), LIMIT_OF_ALL, "spheres", remedy)?;
        let rows = section::rows(subject)?;
        let discs = subject.is_of_discs();
        let mut spheres = Vec::new();
        let mut first = None;
        for row in pile.rows(Selection::All)? {
            if !rows.contains(&(row.k, row.j)) {
                continue;
            }
            for site in row {
                let origin = *first.get_or_insert(site);
                let [x, y, z] = subject.from(origin, site)?;
                spheres.push((site, [if discs { x } else { y }, z]));
            }
        }
        readable(
            &BigUint::from(spheres.len()),
            LIMIT,
            "spheres of a section",
            remedy,
        )?;
        let forces = subject.packing().forces().contacts(Selection::All)?;
        let mut links = Vec::new();
        for contact in forces {
            let contact = contact?;
            let ends = [Some(contact.site), below(subject, &contact)];
            let ends = ends.map(|site| site.and_then(|site| place(&spheres, site)));
            if let [Some(upper), Some(lower)] = ends {
                links.push(link(subject, &contact, [upper, lower])?);
            }
        }
        Ok(Self::new(subject, links, spheres, Sight::Section { discs }))
    }

    /// The contacts of layer `k` with the one below, seen from above; of discs from the side.
    ///
    /// # Errors
    /// [`Error::LayerOutside`]; [`Error::OnFloor`] for the bottom layer; [`Error::TooManyMarks`] for more than 20 000
    /// spheres; [`Error::Overflow`] for forces beyond floats; those of [`Forces::contacts`](crate::Forces::contacts).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::{Network, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Error, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let subject = Subject::of_pile(&pile, &spacing)?;
    /// // Nothing is below the bottom layer.
    /// assert_eq!(Network::layer(&subject, 8)?.links.len(), 135);
    /// assert!(matches!(Network::layer(&subject, 9), Err(Error::OnFloor { .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn layer(subject: &Subject<'_>, k: i128) -> Result<Self, Error> {
        let pile = subject.pile();
        let region = pile.shape().layer(k)?;
        readable(
            &region.sites(),
            LIMIT,
            "spheres of a layer",
            "choose a higher layer",
        )?;
        if k == pile.layers() - 1 {
            let site = middle(pile, k)?;
            return Err(Error::OnFloor { site });
        }
        let layer = Layer::new(subject, k)?;
        let spheres: Vec<(Site, [f64; 2])> = layer
            .places
            .iter()
            .map(|place| (place.site, place.at))
            .collect();
        let mut links = Vec::new();
        for contact in subject.packing().forces().contacts(Selection::Layer(k))? {
            let contact = contact?;
            let Some(upper) = place(&spheres, contact.site) else {
                continue;
            };
            let [x, y, _] = subject.contact(contact.site, contact.direction)?;
            let [u, v] = layer.seen([-2.0 * x, -2.0 * y]);
            let lower = [upper[0] + u, upper[1] + v];
            links.push(link(subject, &contact, [upper, lower])?);
        }
        Ok(Self::new(subject, links, spheres, Sight::Layer(layer, k)))
    }

    fn new(
        subject: &Subject<'_>,
        links: Vec<Link>,
        spheres: Vec<(Site, [f64; 2])>,
        sight: Sight,
    ) -> Self {
        Self {
            scale: Scale::of_lines(links.iter().map(|link| link.force)),
            links,
            spheres,
            unit: subject.force_unit(),
            sight,
            caption: subject.caption(),
        }
    }

    /// The figure: lines as wide as the forces are great; what carries nothing is dotted.
    ///
    /// Contacts are `<line class="contact" data-direction="…" data-force="…">`, from the upper sphere to the lower.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{Network, Response, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Response::of_unit_load(Pile::triangular(4)?)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let svg = Network::layer(&Subject::of_pile(&pile, &spacing)?, 2)?.drawing().to_string();
    /// // Of 18 contacts those on three lines carry the load.
    /// assert_eq!(svg.matches("class=\"contact\"").count(), 18);
    /// assert_eq!(svg.matches("stroke-dasharray").count(), 15);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        let ends = self.links.iter().flat_map(|link| link.ends);
        let points = self.spheres.iter().map(|(_, at)| *at).chain(ends);
        let bounds = Bounds::around(points, 1.3).at_least(10.0, 5.0);
        let margins = match &self.sight {
            Sight::Section { .. } => Margins {
                left: 40.0,
                ..Margins::BAR
            },
            Sight::Layer(..) => Margins::BAR,
        };
        let panel = Panel::fitting(bounds, margins);
        let (title, told) = match &self.sight {
            Sight::Section { discs: true } => ("Force network".into(), String::new()),
            Sight::Section { discs: false } => (
                "Force network in a vertical section".into(),
                "; one row a layer, seen along x".into(),
            ),
            Sight::Layer(_, k) => (
                format!("Forces of layer {k} on the next"),
                "; seen from above".into(),
            ),
        };
        let caption = format!("{}{told}", self.caption);
        let mut canvas = Canvas::new(panel.page_height().max(340.0), &title, &caption);
        match &self.sight {
            Sight::Section { .. } => {
                let heights = self.spheres.iter().map(|(_, [_, v])| *v);
                floor(&mut canvas, &panel, heights.fold(0.0, f64::min) - 1.0);
            }
            Sight::Layer(layer, _) => layer.axes(&panel, &mut canvas),
        }
        let radius = panel.length(1.0);
        for (site, at) in &self.spheres {
            let outline = ring(panel.at(*at), radius, GREY.towards(WHITE, 0.55), 0.8);
            canvas.add(of(*site, outline.set("class", "sphere")));
        }
        // The strongest on top, and pulls over pushes.
        let mut links: Vec<&Link> = self.links.iter().collect();
        let order = |link: &Link| (link.force < 0.0, link.force.abs());
        links.sort_by(|a, b| {
            let ((a_pulls, a), (b_pulls, b)) = (order(a), order(b));
            a_pulls.cmp(&b_pulls).then(a.total_cmp(&b))
        });
        let widest = (radius * 0.62).min(18.0);
        for link in links {
            canvas.add(self.line(link, &panel, widest));
        }
        let dot = (radius * 0.13).clamp(0.6, 4.0);
        for (_, at) in &self.spheres {
            canvas.add(circle(panel.at(*at), dot).set("fill", BLACK.to_string()));
        }
        panel.bar(&mut canvas, &self.scale, "contact force", self.unit);
        canvas.finish()
    }

    fn line(&self, link: &Link, panel: &Panel, widest: f64) -> svg::node::element::Line {
        let [upper, lower] = link.ends.map(|at| panel.at(at));
        let part = link.force.abs() / self.scale.greatest();
        let part = if part.is_finite() { part } else { 0.0 };
        let mark = if link.force == 0.0 {
            line(upper, lower, GREY, 1.0).set("stroke-dasharray", "2 3")
        } else {
            let colour = self.scale.colour(link.force);
            line(upper, lower, colour, (widest * part).max(1.0)).set("stroke-linecap", "round")
        };
        let mark = mark
            .set("class", "contact")
            .set("data-direction", link.direction.name())
            .set("data-force", format!("{:?}", link.force));
        of(link.site, mark)
    }
}

/// The contact as a link.
fn link(
    subject: &Subject<'_>,
    contact: &ContactForce<BigRational>,
    ends: [[f64; 2]; 2],
) -> Result<Link, Error> {
    let force = subject.packing().unit_force().scaled(&contact.force);
    Ok(Link {
        site: contact.site,
        direction: contact.direction,
        force: nearest(&force, "a contact force")?,
        ends,
    })
}

/// The sphere below.
fn below(subject: &Subject<'_>, contact: &ContactForce<BigRational>) -> Option<Site> {
    subject
        .pile()
        .shape()
        .below(contact.site, contact.direction)
}

/// Where a sphere is, of a list in row order.
fn place(spheres: &[(Site, [f64; 2])], site: Site) -> Option<[f64; 2]> {
    let found = spheres
        .binary_search_by_key(&site, |(site, _)| *site)
        .ok()?;
    spheres.get(found).map(|(_, at)| *at)
}
