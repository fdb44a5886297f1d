//! The input that causes an error, for the errors of all crates.

use core::fmt;

use cannonpile_dem::Key;
use cannonpile_stability::Error as Stability;

use crate::Error;

/// The input to change after an [`Error`], given by the user or left to its default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Culprit {
    /// A key of a scene, which is also an option.
    Key(Key),
    /// The selected sphere.
    Site,
    /// The selected layer.
    Layer,
    /// The method that computes the forces.
    Method,
    /// The number format of the output.
    Number,
    /// The text of a file.
    File,
    /// The probability of a sign change.
    FaultProbability,
}

impl Culprit {
    /// Returns the name of the input: `layers`, `sin-phi`, `site`.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Key(key) => key.name(),
            Self::Site => "site",
            Self::Layer => "layer",
            Self::Method => "method",
            Self::Number => "number",
            Self::File => "file",
            Self::FaultProbability => "fault-probability",
        }
    }

    /// Returns the option that gives the input, if there is one.
    pub(crate) const fn option(self) -> Option<&'static str> {
        match self {
            Self::Site => Some("at"),
            Self::File => None,
            culprit => Some(culprit.name()),
        }
    }
}

impl From<Key> for Culprit {
    fn from(key: Key) -> Self {
        Self::Key(key)
    }
}

impl fmt::Display for Culprit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl Error {
    /// Returns the input to change, if the error determines it.
    ///
    /// The result is `None` for a bug, and for a text or region whose option only the caller knows. An overflow gives the
    /// number format. A figure with too many glyphs gives the number of layers, even if it shows a single layer.
    pub(crate) fn culprit(&self) -> Option<Culprit> {
        match self {
            Self::Core(error) => of_core(error),
            Self::Stability(Stability::NoWeight) => Some(Key::Weightless.into()),
            Self::Stability(_) => Some(Key::Floor.into()),
            Self::Horizontal(error) => of_horizontal(error),
            Self::Disorder(error) => of_disorder(error),
            Self::Dem(error) => of_dem(error),
            Self::Figure(cannonpile_figure::Error::TooManyGlyphs { .. }) => {
                Some(Key::Layers.into())
            }
            Self::Figure(_) | Self::Proof(_) => None,
        }
    }

    /// Returns the second of two inputs that exclude each other. Leaving out either one is a remedy.
    pub(crate) const fn conflicts_with(&self) -> Option<Key> {
        use cannonpile::Error as Core;
        use cannonpile_dem::Error as Dem;
        use cannonpile_disorder::Error as Disorder;

        match self {
            Self::Dem(Dem::Excluded { beside, .. }) => Some(*beside),
            Self::Core(Core::LayersOfStacking { .. }) => Some(Key::Stacking),
            Self::Dem(Dem::SinPhiOfDiscs) => Some(Key::Dimension),
            Self::Core(Core::TooHigh { .. }) | Self::Disorder(Disorder::NoStacking { .. }) => {
                Some(Key::Base)
            }
            _ => None,
        }
    }
}

fn of_core(error: &cannonpile::Error) -> Option<Culprit> {
    use cannonpile::Error;

    Some(match error {
        Error::Layers { .. }
        | Error::LayersOfStacking { .. }
        | Error::TooHigh { .. }
        | Error::RegionTooLarge { .. }
        | Error::TooLarge { .. }
        | Error::TooManyRows { .. } => Key::Layers.into(),
        Error::RunLength { .. } | Error::TooManyRuns { .. } | Error::Misspelled { .. } => {
            Key::Stacking.into()
        }
        Error::SinPhi { .. } | Error::NoSpacing { .. } | Error::NoHorizontalContacts { .. } => {
            Key::SinPhi.into()
        }
        Error::OutOfPlane { quantity, .. } if *quantity == Key::Tilt.name() => Key::Tilt.into(),
        Error::NegativeLoad { .. } | Error::OutOfPlane { .. } => Key::Load.into(),
        Error::Overlap { .. } | Error::TooFlat { .. } | Error::NotTouching { .. } => {
            Key::Spacing.into()
        }
        Error::NotPositive { quantity, .. } => {
            let key = Key::ALL.into_iter().find(|key| key.name() == *quantity);
            return key.map(Culprit::Key);
        }
        Error::SiteOutside { .. } | Error::OnFloor { .. } | Error::NotOnFloor { .. } => {
            Culprit::Site
        }
        Error::LayerOutside { .. } | Error::OtherLayer { .. } => Culprit::Layer,
        Error::NoSuchMethod { .. } => Culprit::Method,
        Error::Overflow { .. } => Culprit::Number,
        _ => return None,
    })
}

const fn of_horizontal(error: &cannonpile_horizontal::Error) -> Option<Culprit> {
    use cannonpile_horizontal::Error;

    match error {
        Error::Weightless => Some(Culprit::Key(Key::Weightless)),
        _ => None,
    }
}

const fn of_disorder(error: &cannonpile_disorder::Error) -> Option<Culprit> {
    use cannonpile_disorder::Error;

    Some(match error {
        Error::TooManyStackings { .. } | Error::NoStacking { .. } => Culprit::Key(Key::Layers),
        Error::FaultProbability { .. } => Culprit::FaultProbability,
        Error::PlaceOfLoad { .. }
        | Error::NotAResponse {
            weightless: true, ..
        } => Culprit::Key(Key::Load),
        Error::Weightless | Error::NotAResponse { .. } => Culprit::Key(Key::Weightless),
        _ => return None,
    })
}

fn of_dem(error: &cannonpile_dem::Error) -> Option<Culprit> {
    use cannonpile_dem::Error;

    match error {
        Error::SinPhiOfDiscs => Some(Key::SinPhi.into()),
        Error::Excluded { given, .. } | Error::NoEquations { given } => Some(Culprit::Key(*given)),
        Error::InFile { error, .. } => {
            let inner = crate::Error::from((**error).clone());
            Some(inner.culprit().unwrap_or(Culprit::File))
        }
        Error::NotToml { .. } | Error::UnknownKey { .. } => Some(Culprit::File),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use cannonpile::geometry::Spacing;
    use cannonpile::lattice::{Dimension, Direction, MAX_LAYERS, Region, Site};
    use cannonpile::stacking::Pattern;
    use cannonpile::{Load, Packing, Pile};
    use cannonpile_dem::scene::{Case, Scene, parse};
    use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings, check_fault_probability};
    use num_rational::BigRational;

    use super::*;

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    #[track_caller]
    fn blames(culprit: impl Into<Option<Culprit>>, error: impl Into<Error>) {
        let error = error.into();
        assert_eq!(error.culprit(), culprit.into(), "{error:?}");
    }

    #[test]
    fn errors_of_sizes() {
        let pile = Pile::triangular(3).unwrap();
        let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
        for given in [ratio(0, 1), ratio(-6, 5)] {
            let packing = || packing.clone();
            let blamed = |key: Key, error: cannonpile::Error| {
                assert!(error.to_string().starts_with(key.name()), "{error}");
                blames(Culprit::Key(key), error);
            };
            blamed(
                Key::Radius,
                packing().with_radius(given.clone()).unwrap_err(),
            );
            blamed(Key::Mass, packing().with_mass(given.clone()).unwrap_err());
            blamed(
                Key::Gravity,
                packing().with_gravity(given.clone()).unwrap_err(),
            );
            let spacing = Spacing::new(given.clone());
            blamed(Key::Spacing, spacing.unwrap_err());
            blamed(Key::Spacing, Spacing::from_square(given).unwrap_err());
        }
    }

    #[test]
    fn errors_of_the_core() {
        let pile = Pile::triangular(3).unwrap();
        let forces = pile.forces::<f64>();
        blames(Culprit::Key(Key::Layers), Pile::triangular(0).unwrap_err());
        let floor = Site { i: 0, j: 0, k: 2 };
        let refused = forces.contact(floor, Direction::Alpha).unwrap_err();
        blames(Culprit::Site, refused);
        blames(Culprit::Layer, pile.shape().layer(9).unwrap_err());
        let isosceles = Pile::isosceles(5, ratio(3, 2)).unwrap_err();
        assert_eq!(Error::from(isosceles.clone()).conflicts_with(), None);
        blames(Culprit::Key(Key::SinPhi), isosceles);
        let out_of_plane = |scene: Scene| scene.pile().unwrap_err();
        let discs = || Scene {
            dimension: Dimension::Two,
            ..Scene::default()
        };
        let tilt = [ratio(0, 1), ratio(1, 2)];
        let [x, y] = tilt.clone();
        let tilted = Scene { tilt, ..discs() };
        blames(Culprit::Key(Key::Tilt), out_of_plane(tilted));
        let (at, down) = (parse::at("0,0", Dimension::Two).unwrap(), x.clone());
        let loads = vec![(at, Load { down, x, y })];
        blames(
            Culprit::Key(Key::Load),
            out_of_plane(Scene { loads, ..discs() }),
        );
        let weightless = cannonpile_stability::tilts(&pile.clone().weightless()).unwrap_err();
        blames(Culprit::Key(Key::Weightless), weightless);
        let misspelled = "++x".parse::<Pattern>();
        assert!(misspelled.is_err());
        blames(None, parse::rational("one").unwrap_err());
    }

    #[test]
    fn errors_of_scenes() {
        let scene = Scene {
            layers: Some(4),
            stacking: Some("++-+-".parse().unwrap()),
            ..Scene::default()
        };
        let error = Error::from(scene.pile().unwrap_err());
        assert_eq!(error.conflicts_with(), Some(Key::Stacking));
        blames(Culprit::Key(Key::Layers), error);
        let scene = Scene {
            sin_phi: Some(ratio(1, 3)),
            stacking: Some(Pattern::Hcp),
            ..Scene::default()
        };
        let error = Error::from(scene.pile().unwrap_err());
        assert_eq!(error.conflicts_with(), Some(Key::Stacking));
        blames(Culprit::Key(Key::SinPhi), error);
        let discs = Scene {
            dimension: Dimension::Two,
            sin_phi: Some(ratio(1, 2)),
            ..Scene::default()
        };
        let error = Error::from(discs.pile().unwrap_err());
        assert_eq!(error.conflicts_with(), Some(Key::Dimension));
        blames(Culprit::Key(Key::SinPhi), error);
        let spacing = Spacing::new(ratio(164, 100)).ok();
        let scene = Scene {
            spacing,
            ..Scene::default()
        };
        blames(
            Culprit::Key(Key::Spacing),
            scene
                .check_sizes()
                .and_then(|()| scene.pile().map(drop))
                .unwrap_err(),
        );
        // An error in a file gives the input of its value, or the file itself.
        let layers = Scene::from_toml("layers = 0").unwrap_err();
        blames(Culprit::Key(Key::Layers), layers);
        for text in ["layers = ", "leyers = 3", "top = \"site\""] {
            blames(Culprit::File, Scene::from_toml(text).unwrap_err());
        }
    }

    #[test]
    fn errors_of_cases() {
        for name in ["C23", "d3", "hcp", ""] {
            blames(None, Case::named(name).unwrap_err());
        }
    }

    #[test]
    fn errors_of_random_stackings() {
        let one = || ratio(1, 1);
        let stackings = |layers| RandomStackings::new(layers, FirstSign::Plus);
        let four = || stackings(4).unwrap();
        for layers in [0, -1, MAX_LAYERS + 1] {
            blames(Culprit::Key(Key::Layers), stackings(layers).unwrap_err());
        }
        let many = stackings(10_001).unwrap();
        blames(Culprit::Key(Key::Layers), many.registry(&0.5).unwrap_err());

        // A load at a position where some stackings have no sphere, a negative load, and a load on a base.
        let heavy = RandomPiles::under(Region::SITE, four());
        let on = RandomPiles::on(Region::triangle(4).unwrap(), four());
        let below = Site { i: 0, j: 0, k: 1 };
        for refused in [
            heavy.clone().with_load(below, one()),
            heavy.clone().with_load(Site::APEX, ratio(-1, 2)),
            on.with_load(Site::APEX, one()),
        ] {
            blames(Culprit::Key(Key::Load), refused.unwrap_err());
        }

        // A plane and a response need weightless spheres with loads.
        let plane = RandomPiles::plane(four());
        let loaded = plane.clone().with_load(Site::APEX, one()).unwrap();
        let weightless = plane.clone().weightless();
        blames(Culprit::Key(Key::Load), weightless.by_faults().unwrap_err());
        let half = ratio(1, 2);
        blames(
            Culprit::Key(Key::Load),
            weightless.exact(&half).unwrap_err(),
        );
        for error in [
            plane.exact(&half).unwrap_err(),
            loaded.mean(&0.5).unwrap_err(),
            heavy.mean_square(&0.5).unwrap_err(),
        ] {
            blames(Culprit::Key(Key::Weightless), error);
        }

        for q in [ratio(-1, 9), ratio(10, 9)] {
            let refused = check_fault_probability(&q).unwrap_err();
            blames(Culprit::FaultProbability, refused);
            blames(Culprit::FaultProbability, heavy.exact(&q).unwrap_err());
        }
        blames(Culprit::Number, heavy.mean(&f64::NAN).unwrap_err());
    }

    #[test]
    fn errors_of_too_many_random_stackings() {
        let stackings = |layers| RandomStackings::new(layers, FirstSign::Plus).unwrap();
        let high = RandomPiles::under(Region::SITE, stackings(5000));
        let plane = |layers| {
            let plane = RandomPiles::plane(stackings(layers)).weightless();
            plane.with_load(Site::APEX, ratio(1, 1)).unwrap()
        };
        for error in [
            high.mean(&0.5).unwrap_err(),
            high.exact(&ratio(1, 3)).unwrap_err(),
            high.by_faults().unwrap_err(),
            plane(5000).mean_square(&0.5).unwrap_err(),
        ] {
            blames(Culprit::Key(Key::Layers), error);
        }

        // The base supports no stacking of this height, or none with this first sign.
        let base = Region::triangle(4).unwrap();
        let minus = RandomStackings::new(4, FirstSign::Minus).unwrap();
        for piles in [
            RandomPiles::on(base, stackings(5)),
            RandomPiles::on(base, stackings(MAX_LAYERS)),
            RandomPiles::on(base, minus),
            RandomPiles::on(Region::hexagon(1, 4).unwrap(), stackings(4)),
        ] {
            let error = Error::from(piles.mean(&0.5).unwrap_err());
            assert_eq!(error.conflicts_with(), Some(Key::Base));
            blames(Culprit::Key(Key::Layers), error);
        }
    }

    #[test]
    fn errors_of_figures() {
        let pile = Pile::triangular(1000).unwrap();
        let subject = cannonpile_figure::Subject::of_pile(&pile, &"6/5".parse().unwrap());
        let error = cannonpile_figure::pile(&subject.unwrap()).unwrap_err();
        blames(Culprit::Key(Key::Layers), error);
    }
}
