//! The measured piles.

use cannonpile::Pile;
use cannonpile::lattice::Region;
use cannonpile::stacking::Stacking;

/// A pile and its name.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) pile: Pile,
    pub(crate) layers: u16,
}

impl Case {
    /// Returns the pile of the paper.
    fn straight(layers: u16) -> Self {
        Self {
            name: format!("straight, {layers} layers"),
            pile: Pile::triangular(layers.into()).expect("a pile"),
            layers,
        }
    }

    /// Returns hexagonal close packing, with a sign change at every layer, under a hexagon with `side` spheres on each
    /// side.
    fn alternating(side: u16, layers: u16) -> Self {
        let top = Region::hexagon(side.into(), side.into()).expect("a hexagon");
        let stacking = Stacking::hcp(layers.into()).expect("a stacking");
        Self {
            name: format!("HCP, {layers} layers, {side} a side on top"),
            pile: Pile::under(top, stacking).expect("a pile"),
            layers,
        }
    }

    /// Returns the number of contacts between spheres.
    pub(crate) fn contacts(&self) -> f64 {
        let contacts: u32 = self
            .pile
            .contact_count()
            .try_into()
            .expect("some thousands");
        contacts.into()
    }
}

/// Returns straight piles, a low wide pile with sign changes that is stable, and a pile with many sign changes and tensile
/// contacts.
pub(crate) fn cases(smoke: bool) -> Vec<Case> {
    if smoke {
        return vec![
            Case::straight(4),
            Case::alternating(2, 4),
            Case::alternating(3, 7),
        ];
    }
    vec![
        Case::straight(10),
        Case::straight(20),
        Case::straight(40),
        Case::straight(80),
        Case::alternating(12, 4),
        Case::alternating(8, 40),
    ]
}
