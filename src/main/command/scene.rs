//! `scene`: what the options describe, as a file.

use std::path::PathBuf;

use clap::Args;

use super::Command;
use crate::args::{SceneOptions, target};
use crate::output::{Failure, write_to};

const HELP: &str = "\
Examples:
  cannonpile scene --layers 4 --stacking hcp --output pile.toml
  cannonpile base --scene pile.toml --layers 6";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct WriteScene {
    #[command(flatten)]
    scene: SceneOptions,
    /// Write to a file, which is replaced only when all is written
    #[arg(long = "output", value_name = "FILE", help_heading = "Output")]
    file: Option<PathBuf>,
}

impl Command for WriteScene {
    fn run(&self) -> Result<bool, Failure> {
        let (scene, _) = self.scene.read()?;
        let text = scene.to_toml();
        write_to(self.file.as_deref(), |out| {
            Ok(out.write_all(text.as_bytes())?)
        })?;
        Ok(true)
    }

    fn scene(&self) -> Option<&SceneOptions> {
        Some(&self.scene)
    }

    fn target(&self) -> String {
        target("output", self.file.as_deref())
    }
}
