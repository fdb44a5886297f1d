//! Mappings of a pile onto itself that preserve its forces.

use cannonpile::geometry::Vector;
use cannonpile::lattice::{Direction, Site};
use num_rational::BigRational;

use super::{Verdict, same};
use cannonpile_testkit::answers::{Answers, ratio};

/// A symmetry of the pile. The count of the image along α is the old count along the first listed direction, and so on.
///
/// Every permutation maps the sites of a triangular pile onto themselves. On an equilateral base all six are symmetries of
/// the forces. On an isosceles base, and for discs, only the identity and the mirror α ↔ β are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Symmetry([Direction; 3]);

impl Symmetry {
    /// The paper's rotation about the axis, {j → k−i−j, i → j}: (i, j, k) goes to (j, k−i−j, k).
    pub(crate) const ROTATION: Self = Self([Direction::Beta, Direction::Gamma, Direction::Alpha]);

    /// The mirror that exchanges α and β: (i, j, k) goes to (k−i−j, j, k).
    pub(crate) const MIRROR: Self = Self([Direction::Beta, Direction::Alpha, Direction::Gamma]);

    /// All six permutations of the directions, the identity first, then the rotations.
    pub(crate) const ALL: [Self; 6] = {
        use Direction::{Alpha, Beta, Gamma};
        [
            Self([Alpha, Beta, Gamma]),
            Self::ROTATION,
            Self([Gamma, Alpha, Beta]),
            Self::MIRROR,
            Self([Alpha, Gamma, Beta]),
            Self([Gamma, Beta, Alpha]),
        ]
    };

    /// Returns the image of a site, or `None` if it leaves `i128`. Images of sites of a pile never do.
    pub(crate) fn apply(self, site: Site) -> Option<Site> {
        let Site { i, j, k } = site;
        let [_, i, j] = self.permute(&[k.checked_sub(i)?.checked_sub(j)?, i, j]);
        Some(Site { i, j, k })
    }

    /// Returns the counts of spheres above the image of a site, from the counts above the site, in any scalar.
    fn permute<T: Clone>(self, above: &[T; 3]) -> [T; 3] {
        self.0.map(|direction| above[direction.index()].clone())
    }

    /// Returns the direction whose line maps to the line of `direction`. The count along `direction` at an image is the
    /// count along the returned direction at the original site.
    pub(crate) fn source(self, direction: Direction) -> Direction {
        self.0[direction.index()]
    }
}

/// A linear map of the horizontal plane in halves, by rows: ((xx, xy), (yx, yy)) acts on components (x, y) of the symbolic
/// basis.
pub(crate) type Turn = [[i64; 2]; 2];

/// The map of the plane for each of `Symmetry::ALL`, on an equilateral base.
///
/// Derived by hand from the directions, which lie at 60°, −60° and 180° from the x axis. A mapping of γ to α rotates by
/// +120°. In the true components (x, √3·y) these are the identity, two rotations, and the reflections in the x axis and in
/// the lines of α and β.
pub(crate) const TURNS: [Turn; 6] = [
    [[2, 0], [0, 2]],
    [[-1, -3], [1, -1]],
    [[-1, 3], [-1, -1]],
    [[2, 0], [0, -2]],
    [[-1, 3], [1, 1]],
    [[-1, -3], [-1, 1]],
];

/// The mirror α ↔ β of an isosceles base: y changes sign, x stays.
pub(crate) const MIRRORED: Turn = TURNS[3];

/// The mirror α ↔ β of discs, which lie along x.
pub(crate) const MIRRORED_DISCS: Turn = [[-2, 0], [0, 2]];

/// `symmetry` maps every sphere, contact and force on the floor to an equal one, up to the rotation.
pub(crate) fn invariant(pile: &Answers, symmetry: Symmetry, turn: &Turn) -> Verdict {
    for (site, sphere) in &pile.spheres {
        let leaves = || format!("{site} leaves the pile");
        let image = symmetry.apply(*site).ok_or_else(leaves)?;
        let there = pile.spheres.get(&image).ok_or_else(leaves)?;
        same(site, &there.position, &turned(turn, &sphere.position))?;
        same(
            site,
            &there.resultant_above,
            &turned(turn, &sphere.resultant_above),
        )?;
        for direction in pile.shape.directions() {
            let source = symmetry.source(*direction);
            let from_above = &there.from_above[direction.index()];
            same(site, from_above, &sphere.from_above[source.index()])?;
            let Some(contact) = pile.contacts.get(&(*site, source)) else {
                continue;
            };
            let there = pile.contacts.get(&(image, *direction));
            let there = there.ok_or(format!("{image} has no contact"))?;
            same((site, source), &there.force, &contact.force)?;
            same(
                (site, source),
                &there.vector,
                &turned(turn, &contact.vector),
            )?;
        }
        let force = pile.floor.get(site).map(|force| turned(turn, force));
        same(site, &pile.floor.get(&image), &force.as_ref())?;
    }
    Ok(())
}

/// A vector turned about the vertical.
fn turned(turn: &Turn, v: &Vector<BigRational>) -> Vector<BigRational> {
    let row = |[x, y]: [i64; 2]| &v.x * ratio(x, 2) + &v.y * ratio(y, 2);
    Vector {
        x: row(turn[0]),
        y: row(turn[1]),
        z: v.z.clone(),
    }
}
