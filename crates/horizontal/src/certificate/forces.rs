//! All forces of a pile, as a certificate contains them.

use std::collections::BTreeMap;

use cannonpile::FloorForce;
use cannonpile::data::{listed, number};
use cannonpile::lattice::Site;
use num_rational::BigRational;
use serde::{Deserialize, Deserializer, Serialize};

/// All forces of a pile, as they were computed.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_horizontal::certificate::{Certificate, Claim};
///
/// let exact = Certificate::of_forces(&Pile::triangular(4)?)?;
/// let Claim::Forces(forces) = &exact.claim else { unreachable!() };
/// assert!(forces.compressive && forces.contacts.len() == 10 && forces.floor.len() == 10);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AllForces {
    /// The largest difference of a number from the exact one, in its unit; 0 if all are exact.
    #[serde(with = "number")]
    pub within: BigRational,
    /// `true` if no exact force is tensile.
    pub compressive: bool,
    /// The forces below each sphere above the floor, in f₀.
    #[serde(with = "listed")]
    pub contacts: BTreeMap<Site, [BigRational; 3]>,
    /// The force of each bottom sphere on the floor.
    #[serde(deserialize_with = "once")]
    pub floor: Vec<FloorForce<BigRational>>,
}

cannonpile::engine::equality!(AllForces);

/// Reads forces on the floor, at most one for each sphere.
fn once<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<FloorForce<BigRational>>, D::Error> {
    use serde::de::Error as _;

    let forces = Vec::<FloorForce<BigRational>>::deserialize(deserializer)?;
    let mut sites: Vec<Site> = forces.iter().map(|force| force.site).collect();
    sites.sort_unstable();
    match sites.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(D::Error::custom(format!(
            "two forces of the sphere {} on the floor: leave one of them out",
            pair[0]
        ))),
        None => Ok(forces),
    }
}

impl AllForces {
    pub(super) fn each(&mut self, mut f: impl FnMut(&mut BigRational)) {
        self.contacts.values_mut().flatten().for_each(&mut f);
        for force in &mut self.floor {
            let FloorForce {
                normal,
                shear_x,
                shear_y,
                ..
            } = force;
            [normal, shear_x, shear_y].into_iter().for_each(&mut f);
        }
    }
}
