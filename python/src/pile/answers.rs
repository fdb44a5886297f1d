//! Single exact forces.

use cannonpile::Load;
use cannonpile::geometry::LayerGap;
use cannonpile::lattice::{ContactKind, Direction, HorizontalContact, Site};
use cannonpile::shape::Selection;
use cannonpile_dem::table::refuse_beyond;
use cannonpile_stability::Spread;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::ToPrimitive;
use pyo3::prelude::*;

use super::Pile;
use crate::error::Error;
use crate::exception::Raised;
use crate::input::{self, coordinate, read};
use crate::work::{quickly, work, work_of_long_steps};

/// A contact and its force: k, i, j, direction, force.
type Weakest = (BigInt, BigInt, BigInt, &'static str, BigRational);

/// The force of one contact, in f₀.
#[pyfunction]
pub(crate) fn force(
    pile: &Pile,
    py: Python<'_>,
    k: BigInt,
    i: BigInt,
    j: BigInt,
    direction: &str,
) -> PyResult<BigRational> {
    let site = input::site(&k, &i, &j)?;
    let link = read("direction", direction, str::parse)?;
    pile.ask(py, || match link {
        ContactKind::Sloping(direction) => pile.exact.forces().contact(site, direction),
        ContactKind::Horizontal(axis) => {
            let contact = HorizontalContact { site, axis };
            pile.exact.shape().neighbour(contact)?;
            Ok(pile.exact.horizontal_force(contact))
        }
    })
}

/// The force of a bottom sphere on the floor: normal, shear along x and along y.
#[pyfunction]
pub(crate) fn on_floor(
    pile: &Pile,
    py: Python<'_>,
    i: BigInt,
    j: BigInt,
) -> PyResult<[BigRational; 3]> {
    let site = pile.bottom(&i, &j)?;
    let force = pile.ask(py, || pile.exact.forces::<BigRational>().on_floor(site))?;
    Ok([force.normal, force.shear_x, force.shear_y])
}

/// The id of a sphere.
#[pyfunction]
pub(crate) fn sphere_id(pile: &Pile, k: BigInt, i: BigInt, j: BigInt) -> PyResult<BigUint> {
    let before = pile.exact.shape().before(input::site(&k, &i, &j)?);
    let before = before.map_err(|error| Raised::from(error).into_exception())?;
    Ok(before + 1_u32)
}

/// The site of the sphere with a given id: k, i, j.
#[pyfunction]
pub(crate) fn site(
    pile: &Pile,
    py: Python<'_>,
    sphere_id: BigInt,
) -> PyResult<Option<[BigInt; 3]>> {
    let numbering = quickly(py, || pile.exact.numbering())?;
    let site = sphere_id.to_u64().and_then(|id| numbering.site(id));
    Ok(site.map(|Site { i, j, k }| [k.into(), i.into(), j.into()]))
}

/// The tilts that a pile bears: the square of the margin unless the pile is unstable, the contact that opens there, and the
/// corners of the polygon.
type Stability = (Option<BigRational>, Option<Weakest>, Vec<[BigRational; 2]>);

/// The tilts of gravity that the pile bears, with horizontal contacts at a = R.
#[pyfunction]
pub(crate) fn stability(pile: &Pile, py: Python<'_>) -> PyResult<Stability> {
    let touching = pile
        .exact
        .clearance()
        .check(&pile.scene.spacing().map_err(raised)?);
    if pile.exact.is_regular() && touching.as_deref() == Ok(&[LayerGap { layers: 0 }]) {
        let exact = pile.exact.clone();
        let tilts = work_of_long_steps(py, move || cannonpile_horizontal::tilts(&exact))?;
        let squared = tilts.margin.map(|margin| margin.squared);
        return Ok((squared, None, tilts.corners));
    }
    let tilts = work(py, || cannonpile_stability::tilts(&pile.exact))?;
    let Some(margin) = tilts.margin else {
        return Ok((None, None, tilts.corners));
    };
    let (site, direction) = margin.opens;
    let force = pile.exact.forces().contact(site, direction);
    let contact = contact(site, direction, force.map_err(raised)?);
    Ok((Some(margin.squared), Some(contact), tilts.corners))
}

fn raised(error: impl Into<Raised>) -> PyErr {
    error.into().into_exception()
}

fn contact(Site { i, j, k }: Site, direction: Direction, force: BigRational) -> Weakest {
    (k.into(), i.into(), j.into(), direction.name(), force)
}

/// The forces of the sloping contacts, and the normal forces and shears of the bottom spheres.
type Unit = (Vec<BigRational>, Vec<[BigRational; 3]>);

/// The forces per unit of a load on one sphere: downwards, along x and along y.
#[pyfunction]
pub(crate) fn response(
    pile: &Pile,
    py: Python<'_>,
    k: BigInt,
    i: BigInt,
    j: BigInt,
) -> PyResult<Vec<Unit>> {
    let site = input::site(&k, &i, &j)?;
    work(py, || {
        let bare = pile.exact.bare();
        refuse_beyond(
            &bare.contact_count(),
            "use fewer layers, or a smaller top or base",
        )?;
        let axes = bare.dimension().directions().len();
        let loads = Load::units().into_iter().take(axes);
        let units = loads.map(|load| {
            let forces = bare.forces::<BigRational>().with_load(site, load)?;
            let contacts = forces.contacts(Selection::All)?;
            let base = forces.base(Selection::Base)?;
            let base =
                base.map(|force| force.map(|force| [force.normal, force.shear_x, force.shear_y]));
            let contacts = contacts.map(|contact| contact.map(|contact| contact.force));
            Ok((
                contacts.collect::<Result<_, _>>()?,
                base.collect::<Result<_, _>>()?,
            ))
        });
        let units = units.collect::<Result<_, cannonpile::Error>>();
        units.map_err(Error::from)
    })
}

/// The change of every contact force per relative growth of one sphere, in f₀.
#[pyfunction]
pub(crate) fn sensitivity(
    pile: &Pile,
    py: Python<'_>,
    k: BigInt,
    i: BigInt,
    j: BigInt,
) -> PyResult<Vec<BigRational>> {
    let site = input::site(&k, &i, &j)?;
    work(py, || {
        let changes = cannonpile_stability::sensitivity(&pile.packing()?, site)?;
        Ok::<_, Error>(changes.into_iter().map(|contact| contact.change).collect())
    })
}

/// The contact that opens first under deviations of all radii, the variance of its force, and the square of the deviation
/// at which it does.
#[pyfunction]
pub(crate) fn spread(
    pile: &Pile,
    py: Python<'_>,
) -> PyResult<Option<(Weakest, BigRational, BigRational)>> {
    let spread: Option<Spread> = work(py, || {
        Ok::<_, Error>(cannonpile_stability::spread(&pile.packing()?)?)
    })?;
    Ok(spread.and_then(|spread| {
        // The variance is not zero.
        let bearable = spread.bearable_squared()?;
        let contact = contact(spread.site, spread.direction, spread.force);
        Some((contact, spread.variance, bearable))
    }))
}

/// The contact with the smallest force.
#[pyfunction]
pub(crate) fn weakest(pile: &Pile, py: Python<'_>) -> PyResult<Option<Weakest>> {
    let standing = work(py, || pile.exact.standing())?;
    let least = standing.least;
    Ok(least.map(|least| contact(least.site, least.direction, least.force)))
}

/// Bounds of the normal force of a bottom sphere at a = R, and whether both are attained.
#[pyfunction]
pub(crate) fn bounds(
    pile: &Pile,
    py: Python<'_>,
    i: BigInt,
    j: BigInt,
) -> PyResult<(BigRational, BigRational, bool)> {
    let site = pile.bottom(&i, &j)?;
    let (scene, exact) = (pile.scene.clone(), pile.exact.clone());
    let bounds = work_of_long_steps(py, move || {
        scene.check_touching()?;
        Ok::<_, Error>(cannonpile_horizontal::bounds(&exact, site)?)
    })?;
    let (least, greatest) = (bounds.least, bounds.greatest);
    Ok((
        least.normal,
        greatest.normal,
        least.attained && greatest.attained,
    ))
}

impl Pile {
    /// Computes one force: directly in a straight pile, otherwise with cancellation by Ctrl-C.
    fn ask<T: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce() -> Result<T, cannonpile::Error> + Send,
    ) -> PyResult<T> {
        if self.exact.shape().stacking().is_straight() {
            quickly(py, question)
        } else {
            work(py, question)
        }
    }

    /// Returns a site of the bottom layer.
    fn bottom(&self, i: &BigInt, j: &BigInt) -> PyResult<Site> {
        let (i, j) = (coordinate("i", i)?, coordinate("j", j)?);
        let k = self.exact.layers() - 1;
        let checked = self.exact.shape().check(Site { i, j, k });
        checked.map_err(|error| Raised::from(error).into_exception())
    }
}
