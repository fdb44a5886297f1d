//! A simulation with DIRT, of which all parameters are in a file: `dirt-pile dirt.toml`.

use dirt_core::prelude::*;

fn main() {
    let mut app = App::new();
    app.add_plugins(CorePlugins)
        .add_plugins(GranularDefaultPlugins)
        .add_plugins(GravityPlugin)
        .add_plugins(FixesPlugin)
        .add_plugins(ContactAnalysisPlugin);
    app.start();
}
