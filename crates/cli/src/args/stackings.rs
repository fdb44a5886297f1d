//! Scenes of `mean`, without a stacking, because the mean is over all stackings.

use cannonpile::lattice::{Dimension, Region};
use cannonpile_dem::Key;
use cannonpile_dem::scene::{Anchor, Floor, Scene, State};
use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
use num_traits::Zero;

use super::scene::{SceneOptions, Top, UPRIGHT_GRAVITY, VERTICAL_LOADS};
use crate::output::{Failure, InputError};

/// Returns the reason why `mean` does not support an option, and the remedy.
const fn reason(key: Key) -> &'static str {
    match key {
        Key::Stacking => "the mean is over all stackings: leave it out, or use the command base",
        Key::Tilt => UPRIGHT_GRAVITY,
        Key::Load => VERTICAL_LOADS,
        Key::Floor | Key::Friction | Key::FloorFriction => {
            "random stackings stand on a floor with glue: leave it out"
        }
        Key::Dimension | Key::SinPhi => {
            "random stackings consist of spheres on an equilateral lattice: leave it out"
        }
        Key::Spacing | Key::State | Key::StiffnessRatio => {
            "mean does not include horizontal contacts, and its forces do not depend on the spacing: leave it out"
        }
        _ => "the mean is in multiples of mg: leave it out",
    }
}

impl SceneOptions {
    /// Returns the random piles that the options of `mean` describe.
    pub(crate) fn read_random(&self, first: FirstSign) -> Result<RandomPiles, Failure> {
        let scene = self.scene()?;
        self.refuse_unsupported(&scene)?;
        let stackings = RandomStackings::new(self.layers_of_all_stackings(&scene)?, first)?;
        let piles = match (self.top, scene.anchor) {
            (Some(Top::Plane), _) => RandomPiles::plane(stackings),
            (_, Some(Anchor::Base(base))) => RandomPiles::on(base, stackings),
            (_, Some(Anchor::Top(top))) => RandomPiles::under(top, stackings),
            (_, None) => RandomPiles::under(Region::SITE, stackings),
        };
        let layers = piles.stackings().layers();
        let piles = scene
            .loads
            .into_iter()
            .try_fold(piles, |piles, (at, load)| {
                let loaded = piles.with_load(at.site(layers), load.down);
                loaded.map_err(|error| InputError::of(Key::Load, error))
            })?;
        Ok(if scene.weightless {
            piles.weightless()
        } else {
            piles
        })
    }

    /// Returns an error if the scene has what `mean` does not support. Sizes in a file are ignored.
    fn refuse_unsupported(&self, scene: &Scene) -> Result<(), Failure> {
        let of_scene = [
            (Key::Stacking, scene.stacking.is_some()),
            (Key::Tilt, !scene.tilt.iter().all(Zero::is_zero)),
            (Key::Dimension, scene.dimension != Dimension::Three),
            (Key::SinPhi, scene.sin_phi.is_some()),
            (Key::Spacing, scene.spacing.is_some()),
            (Key::State, scene.state != State::Isostatic),
            (Key::Floor, scene.floor != Floor::Glued),
            (
                Key::Load,
                scene.loads.iter().any(|(_, load)| !load.is_vertical()),
            ),
        ];
        let on_line = [
            Key::StiffnessRatio,
            Key::Friction,
            Key::FloorFriction,
            Key::Radius,
            Key::Mass,
            Key::Gravity,
        ];
        let on_line = on_line.map(|key| (key, self.gives(key.name())));
        let mut keys = of_scene.into_iter().chain(on_line);
        match keys.find(|(_, is_given)| *is_given) {
            None => Ok(()),
            Some((key, _)) => Err(self.refuse(key, reason(key))),
        }
    }
}
