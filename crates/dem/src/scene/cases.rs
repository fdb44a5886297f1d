//! Named benchmark cases, for citation.

use std::sync::LazyLock;

use super::Scene;
use super::toml::{SceneFile, nearest};
use crate::Error;
use crate::error::quoted;
use cannonpile::Verdict;

/// A benchmark case: a scene with a permanent name.
///
/// Published cases are never altered or removed, and new cases have new names. So a number quoted for a case remains
/// valid.
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

/// One case per line: name, stability, title, purpose. New cases are appended.
const CASES: &str = include_str!("cases/cases.txt");

/// The scenes, in the same order.
const SCENES: [&str; 22] = [
    include_str!("cases/c1.toml"),
    include_str!("cases/c2.toml"),
    include_str!("cases/c3.toml"),
    include_str!("cases/c4.toml"),
    include_str!("cases/c5.toml"),
    include_str!("cases/c6.toml"),
    include_str!("cases/c7.toml"),
    include_str!("cases/c8.toml"),
    include_str!("cases/c9.toml"),
    include_str!("cases/c10.toml"),
    include_str!("cases/c11.toml"),
    include_str!("cases/c12.toml"),
    include_str!("cases/c13.toml"),
    include_str!("cases/c14.toml"),
    include_str!("cases/c15.toml"),
    include_str!("cases/c16.toml"),
    include_str!("cases/c17.toml"),
    include_str!("cases/c18.toml"),
    include_str!("cases/c19.toml"),
    include_str!("cases/c20.toml"),
    include_str!("cases/c21.toml"),
    include_str!("cases/c22.toml"),
];

static ALL: LazyLock<Vec<Case>> = LazyLock::new(|| {
    let cases = CASES.lines().zip(SCENES).filter_map(|(line, toml)| {
        let mut parts = line.splitn(4, '|');
        let (name, stands) = (parts.next()?, parts.next()?);
        let mut verdicts = [Verdict::Yes, Verdict::No, Verdict::Undetermined].into_iter();
        Some(Case {
            name,
            stands: verdicts.find(|verdict| verdict.name() == stands),
            title: parts.next()?,
            purpose: parts.next()?,
            toml,
        })
    });
    cases.collect()
});

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
pub fn cases() -> &'static [Case] {
    &ALL
}

impl Case {
    /// Returns the case with this name, in upper or lower case.
    ///
    /// # Errors
    /// [`Error::UnknownCase`], with the most similar name, if any.
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
        let mut all = cases().iter();
        let found = all.find(|case| case.name.eq_ignore_ascii_case(name));
        found.ok_or_else(|| {
            let known: Vec<&str> = cases().iter().map(|case| case.name).collect();
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

    /// Returns a short description of the pile.
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

    /// Returns the purpose of the case as a test of a code.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Case;
    ///
    /// assert!(Case::named("C12")?.purpose().contains("exchanged axes"));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub const fn purpose(&self) -> &'static str {
        self.purpose
    }

    /// Returns whether the pile is stable in the state of the scene; `None` for weightless spheres.
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

    /// Returns the scene of the pile.
    ///
    /// # Errors
    /// Never for a case of [`cases`]; otherwise the errors of [`Scene::from_toml`].
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

    /// Returns the scene as a scene file.
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
