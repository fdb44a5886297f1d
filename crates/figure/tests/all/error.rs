//! Error messages of this crate: one line with the given value and the remedy.

use cannonpile::Pile;
use cannonpile::lattice::MAX_LAYERS;
use cannonpile_figure::{Error, Subject, shear};
use cannonpile_testkit::errors::says;

#[test]
fn too_many_glyphs() {
    let pile = Pile::triangular(MAX_LAYERS).unwrap();
    let subject = Subject::of_pile(&pile, &"6/5".parse().unwrap()).unwrap();
    let error = shear(&subject).unwrap_err();
    assert!(matches!(
        &error,
        Error::TooManyGlyphs { glyphs, kind: "bottom spheres", limit: 20_000, remedy: "use fewer layers", .. }
            if *glyphs == pile.base_sphere_count()
    ));
    says(
        &error,
        &["5000000", "bottom spheres", "20000", "use fewer layers"],
    );
}
