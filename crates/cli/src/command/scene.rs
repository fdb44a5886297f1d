//! `scene`: writes the scene options as a file.

use std::path::PathBuf;

use clap::Args;

use crate::args::SceneOptions;
use crate::output::{Failure, write_to};

const HELP: &str = "\
Examples:
  cannonpile scene --layers 4 --stacking hcp --output pile.toml
  cannonpile base --scene pile.toml --layers 6";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct WriteScene {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// File for the scene, written atomically [default: stdout]
    #[arg(long = "output", value_name = "FILE", help_heading = "Output")]
    file: Option<PathBuf>,
}

impl WriteScene {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, _) = self.scene.read_any()?;
        let text = scene.to_toml();
        write_to("output", self.file.as_deref(), |out| {
            Ok(out.write_all(text.as_bytes())?)
        })?;
        Ok(true)
    }
}
