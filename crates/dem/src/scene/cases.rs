//! Benchmark cases with names that others can quote.

use super::Scene;
use super::toml::{SceneFile, nearest};
use crate::Error;
use crate::error::quoted;
use cannonpile::Verdict;

/// A benchmark case: a scene with a name that others can quote.
///
/// A case that was published is never altered, and none is taken away: new ones are added under new names. So a number
/// quoted with the name of a case stays what it is.
///
/// # Examples
/// ```
/// use cannonpile_dem::scene::Case;
///
/// let case = Case::named("C2")?;
/// assert_eq!((case.name(), case.title()), ("C2", "Straight pile, ten layers"));
/// assert_eq!(case.scene()?.pile()?.sphere_count(), 220_u32.into());
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Case {
    name: &'static str,
    title: &'static str,
    purpose: &'static str,
    stands: Option<Verdict>,
    toml: &'static str,
}

macro_rules! case {
    ($name:literal, $file:literal, $stands:expr, $title:literal, $purpose:literal) => {
        Case {
            name: $name,
            title: $title,
            purpose: $purpose,
            stands: $stands,
            toml: include_str!(concat!("cases/", $file, ".toml")),
        }
    };
}

/// The names are in order: a new case comes last.
const CASES: &[Case] = &[
    case!(
        "C1",
        "c1",
        Some(Verdict::Yes),
        "Straight pile, four layers",
        "Small enough to read every force: signs, numbering, gravity, radii, and which way a force on a sphere points. A \
         code that fails here has no need of the other cases."
    ),
    case!(
        "C2",
        "c2",
        Some(Verdict::Yes),
        "Straight pile, ten layers",
        "The paper's pile of cannonballs, with a = 1.2 R: forces add up along lines of contacts, and the pressure on the \
         floor is the same under all 55 bottom spheres. Errors of a layer that add up show in the layers below."
    ),
    case!(
        "C3",
        "c3",
        Some(Verdict::Yes),
        "Straight pile of millimetre beads, wider spaced",
        "Another inclination, a/R = 4/3, and sizes as in a laboratory: R = 1 mm, m = 10 mg, g = 9.81 m/s². Finds constants \
         with units built in, and tolerances that are absolute."
    ),
    case!(
        "C4",
        "c4",
        Some(Verdict::Yes),
        "Straight pile with a load on one sphere",
        "A force of 3 mg besides the weight, on a sphere inside the pile: it runs down three lines of contacts, and \
         nowhere else."
    ),
    case!(
        "C5",
        "c5",
        None,
        "Response of a straight pile to a load on top",
        "Spheres without weight, and 1 mg on the uppermost: three lines of contacts bear all, every other contact bears \
         nothing. Finds forces where there should be none, and contacts that are lost or kept at random where there is no \
         force."
    ),
    case!(
        "C6",
        "c6",
        Some(Verdict::Yes),
        "Straight pile under a hexagon of nineteen spheres",
        "A wide top: spheres inside rest on three and bear three, and the pressure on the floor falls off towards the \
         edges. Finds faults of neighbour lists that a pile under one sphere is too narrow for."
    ),
    case!(
        "C7",
        "c7",
        Some(Verdict::Yes),
        "Hexagonal close packing that stands, four layers under a hexagon",
        "The lines of contacts are broken at every layer, and forces are no longer multiples of one; the least is 2/9 of \
         the unit, so that a code must not lose weak contacts."
    ),
    case!(
        "C8",
        "c8",
        Some(Verdict::No),
        "Hexagonal close packing that must fall, seven layers",
        "Some contacts would have to pull. A code without cohesion and friction must lose them and come to no rest here; \
         one that keeps the pile has a hidden cohesion, friction or damping that holds it up."
    ),
    case!(
        "C9",
        "c9",
        Some(Verdict::Yes),
        "Mixed stacking, seven layers that begin as hexagonal close packing",
        "Changes of sign near the top, and straight below: what one layer gets wrong is carried through four layers that \
         pass it on unchanged."
    ),
    case!(
        "C10",
        "c10",
        Some(Verdict::Yes),
        "Elastic state at a = R, straight",
        "Neighbours of a layer touch, and there are more contacts than equations. Springs that only push leave all \
         horizontal contacts open: the forces are those of the pile without them. Finds contacts that press because of \
         rounding, or because of how the pile was prepared."
    ),
    case!(
        "C11",
        "c11",
        Some(Verdict::Yes),
        "Elastic state at a = R, hexagonal close packing of six layers",
        "It stands only because three horizontal contacts push, and these forces follow from the springs: all alike. Tests \
         the contact law beside the balance of forces."
    ),
    case!(
        "C12",
        "c12",
        Some(Verdict::Yes),
        "Straight pile on a hexagon with sides of five and four",
        "A frustum that has neither the symmetry of the triangle nor that of the hexagon. Finds axes that were exchanged, \
         and images in a mirror."
    ),
    case!(
        "C13",
        "c13",
        Some(Verdict::Yes),
        "Discs in a plane, eight layers",
        "The same question in two dimensions, for codes of discs, and for codes of spheres that are kept in a plane."
    ),
    case!(
        "C14",
        "c14",
        Some(Verdict::Yes),
        "Straight pile, forty layers",
        "11,480 spheres and 31,980 contacts with forces from 1 to 39 units: time, memory, domains that are cut up among \
         processes, and an error that grows with the height of the pile."
    ),
];

/// Returns the benchmark cases, in the order of their names.
///
/// # Examples
/// ```
/// use cannonpile::Verdict;
/// use cannonpile_dem::scene::cases;
///
/// let falls = cases().iter().find(|case| case.stands() == Some(Verdict::No));
/// assert_eq!(falls.map(|case| case.name()), Some("C8"));
/// ```
#[must_use]
pub const fn cases() -> &'static [Case] {
    CASES
}

impl Case {
    /// Returns the case with this name; small letters will do.
    ///
    /// # Errors
    /// [`Error::UnknownCase`], with the name that may have been meant.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Case;
    ///
    /// assert_eq!(Case::named("c13")?.name(), "C13");
    /// assert_eq!(Case::named("C1.").unwrap_err().to_string(), "there is no case 'C1.'; did you mean 'C1'?");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn named(name: &str) -> Result<&'static Self, Error> {
        let found = CASES
            .iter()
            .find(|case| case.name.eq_ignore_ascii_case(name));
        found.ok_or_else(|| {
            let known: Vec<&str> = CASES.iter().map(|case| case.name).collect();
            Error::UnknownCase {
                name: quoted(name),
                nearest: nearest(name, &known),
            }
        })
    }

    /// Returns the name, C1, C2, ….
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::cases;
    ///
    /// assert!(cases().iter().map(|case| case.name()).eq((1..=cases().len()).map(|n| format!("C{n}"))));
    /// ```
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Returns what the pile is, in a few words.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Case;
    ///
    /// assert_eq!(Case::named("C13")?.title(), "Discs in a plane, eight layers");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub const fn title(&self) -> &'static str {
        self.title
    }

    /// Returns what the case tests in a code of contact forces.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Case;
    ///
    /// assert!(Case::named("C12")?.purpose().contains("axes that were exchanged"));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub const fn purpose(&self) -> &'static str {
        self.purpose
    }

    /// Returns whether the pile stands, in the state that is meant; `None` where the spheres weigh nothing, and it is not
    /// asked.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Verdict;
    /// use cannonpile_dem::scene::Case;
    ///
    /// assert_eq!(Case::named("C8")?.stands(), Some(Verdict::No));
    /// assert_eq!(Case::named("C5")?.stands(), None);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub const fn stands(&self) -> Option<Verdict> {
        self.stands
    }

    /// Returns the text of the scene, as [`Scene::to_toml`] writes it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Case;
    ///
    /// let case = Case::named("C1")?;
    /// assert_eq!(case.toml(), case.scene()?.to_toml());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub const fn toml(&self) -> &'static str {
        self.toml
    }

    /// Returns the scene, of which the pile is made.
    ///
    /// # Errors
    /// None for a case of [`cases`]; those of [`Scene::from_toml`] are passed on.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::{Case, State};
    ///
    /// assert_eq!(Case::named("C10")?.scene()?.state, State::Elastic);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn scene(&self) -> Result<Scene, Error> {
        Scene::from_toml(self.toml)
    }

    /// Returns the scene as a file that was read.
    ///
    /// # Errors
    /// As for [`scene`](Self::scene).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Case;
    ///
    /// assert!(Case::named("C3")?.file()?.line("gravity").is_some());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn file(&self) -> Result<SceneFile, Error> {
        self.toml.parse()
    }
}
