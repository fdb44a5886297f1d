//! Scenes written as TOML.

use core::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use crate::scene::parse::At;
use crate::scene::{Anchor, Floor, Scene, State};
use cannonpile::Load;
use cannonpile::lattice::Dimension;

impl Scene {
    /// Returns the scene as a TOML file with a comment for each key. [`from_toml`](Self::from_toml) reads back the same
    /// scene.
    ///
    /// Options with default values are omitted; sizes and weights are always written. Every scene that was read from
    /// texts or files reads back. Other scenes read back if [`parse`](crate::scene::parse) accepts the lengths of their
    /// numbers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::{parse, Scene};
    ///
    /// let scene = Scene { layers: Some(4), spacing: Some("1.2".parse()?), ..Scene::default() };
    /// let text = scene.to_toml();
    /// assert!(text.contains("\nlayers = 4\n") && text.contains("\nspacing = \"6/5\"\n"));
    /// assert_eq!(Scene::from_toml(&text)?, scene);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut file = File(String::from(
            "# A pile of spheres, for cannonpile: any command with --scene and the name of this file.\n",
        ));
        if self.state == State::Elastic {
            file.0 += "# Those that know no elastic state take it with --state isostatic.\n";
        }
        if let Some(layers) = self.layers {
            file.key("Number of layers.", "layers", &integer(&layers.into()));
        }
        if let Some(stacking) = &self.stacking {
            let comment = match self.anchor {
                Some(Anchor::Base(_)) => "How layers follow one another, from the base up.",
                _ => "How layers follow one another, from the top.",
            };
            file.key(comment, "stacking", &quoted(stacking));
        }
        if let Some(anchor) = &self.anchor {
            let (key, end, way, region) = match anchor {
                Anchor::Top(top) => ("top", "top", "down", top),
                Anchor::Base(base) => ("base", "bottom", "up", base),
            };
            let comment = format!("The {end} layer, from which the pile grows {way}.");
            file.key(&comment, key, &quoted(format_args!("{region:#}")));
        }
        let dimension = self.dimension.number().to_string();
        file.key("2 for discs, 3 for spheres.", "dimension", &dimension);
        if let Some(s) = &self.sin_phi {
            let comment = "Sine of the azimuth phi of the base triangle.";
            file.key(comment, "sin-phi", &number(s));
        }
        if !self.loads.is_empty() {
            file.key(self.loads_comment(), "load", &self.loads_array());
        }
        if !self.tilt.iter().all(Zero::is_zero) {
            let comment = match self.dimension {
                Dimension::Two => {
                    "Tilt X of gravity: its horizontal over its vertical part, in tanθ."
                }
                Dimension::Three => {
                    "Tilt X,Y of gravity: its horizontal over its vertical part, in tanθ and 2cosφ·tanθ."
                }
            };
            file.key(
                comment,
                "tilt",
                &quoted(horizontal(&self.tilt, self.dimension)),
            );
        }
        if self.weightless {
            let comment = "The spheres weigh nothing: only the loads act.";
            file.key(comment, "weightless", "true");
        }
        if let Some(spacing) = &self.spacing {
            let comment = "Half the distance of horizontal neighbours over the radius, a/R.";
            let written = match spacing.ratio().to_rational() {
                Some(ratio) => number(&ratio),
                None => quoted(spacing),
            };
            file.key(comment, "spacing", &written);
        }
        let radius = number(&self.radius);
        file.key("Radius R of a sphere, in m.", "radius", &radius);
        file.key("Mass m of a sphere, in kg.", "mass", &number(&self.mass));
        file.key("Gravity g, in m/s².", "gravity", &number(&self.gravity));
        if self.state != State::default() {
            let comment = "The forces of springs that only push, horizontal contacts included.";
            file.key(comment, "state", &quoted(self.state));
        }
        if self.state == State::Elastic || !self.stiffness_ratio.is_one() {
            let comment = "Stiffness of horizontal contacts over that of sloping ones.";
            file.key(comment, "stiffness-ratio", &number(&self.stiffness_ratio));
        }
        if self.floor != Floor::default() {
            let comment = "The bottom spheres lie on a plane, and all contacts have friction.";
            file.key(comment, "floor", &quoted(self.floor));
        }
        if let Some(friction) = &self.friction {
            let comment = "Coefficient of friction between spheres.";
            file.key(comment, "friction", &number(friction));
        }
        if let Some(friction) = &self.floor_friction {
            let comment = "Coefficient of friction between spheres and floor.";
            file.key(comment, "floor-friction", &number(friction));
        }
        file.0
    }

    fn loads_comment(&self) -> &'static str {
        let vertical = self.loads.iter().all(|(_, load)| load.is_vertical());
        match (self.dimension, vertical) {
            (Dimension::Two, true) => {
                "Vertical loads on discs, in mg, as K,I=W, or I=W on the base."
            }
            (Dimension::Two, false) => {
                "Loads on discs as K,I=W,X, or I=W,X on the base: W mg down, X mg·tanθ along x."
            }
            (Dimension::Three, true) => {
                "Vertical loads on spheres, in mg, as K,I,J=W, or I,J=W on the base."
            }
            (Dimension::Three, false) => {
                "Loads on spheres as K,I,J=W,X,Y: W mg down, X mg·tanθ along x, Y 2cosφ·mg·tanθ along y."
            }
        }
    }

    fn loads_array(&self) -> String {
        let mut array = String::from("[\n");
        for (at, load) in &self.loads {
            let place = place(at, self.dimension);
            let load = if load.is_vertical() {
                quoted(format!("{place}={}", load.down))
            } else {
                let Load { down, x, y } = load.clone();
                let horizontal = horizontal(&[x, y], self.dimension);
                quoted(format!("{place}={down},{horizontal}"))
            };
            array.extend(["    ", &load, ",\n"]);
        }
        array.push(']');
        array
    }
}

/// The lines of the file.
struct File(String);

impl File {
    fn key(&mut self, comment: &str, key: &str, value: &str) {
        self.0
            .extend(["\n# ", comment, "\n", key, " = ", value, "\n"]);
    }
}

/// Returns a TOML string. These texts contain no characters that need an escape.
fn quoted(text: impl fmt::Display) -> String {
    format!("\"{text}\"")
}

/// Returns a TOML integer if every TOML reader can represent it, otherwise a string.
fn integer(n: &BigInt) -> String {
    match n.to_i64() {
        Some(n) => n.to_string(),
        None => quoted(n),
    }
}

fn number(r: &BigRational) -> String {
    if r.is_integer() {
        integer(r.numer())
    } else {
        quoted(r)
    }
}

/// Returns the components of a horizontal vector, separated by a comma. A disc has a component along y only if the scene
/// is invalid.
fn horizontal([x, y]: &[BigRational; 2], dimension: Dimension) -> String {
    match dimension {
        Dimension::Two if y.is_zero() => x.to_string(),
        _ => format!("{x},{y}"),
    }
}

/// Returns a position in the format of [`at`](crate::scene::parse::at).
fn place(At { layer, i, j }: &At, dimension: Dimension) -> String {
    let layer = layer.map_or_else(String::new, |k| format!("{k},"));
    match dimension {
        Dimension::Two => format!("{layer}{i}"),
        Dimension::Three => format!("{layer}{i},{j}"),
    }
}
