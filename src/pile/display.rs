//! A pile in one line.

use alloc::format;
use alloc::string::{String, ToString};
use core::fmt;

use exact_surd::layout::padded;
use exact_surd::short::quoted;
use num_traits::Zero;

use crate::Pile;
use crate::lattice::{Dimension, Region};
use crate::shape::Anchor;

impl fmt::Display for Pile {
    /// Prints the pile in one line for people: `10 layers of fcc under one sphere`. A long stacking is shortened.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Region, Site};
    /// use cannonpile::{Pile, ratio};
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.to_string(), "10 layers of fcc under one sphere");
    /// let pile = Pile::on(Region::hexagon(3, 3)?, "+--".parse()?)?;
    /// assert_eq!(pile.to_string(), "4 layers of +-- on hexagon:3");
    /// let pile = Pile::discs(4)?.with_load(Site::APEX, ratio!(2))?.weightless();
    /// assert_eq!(pile.to_string(), "4 layers of discs, weightless, 1 load");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let layers = match self.layers() {
            1 => "1 layer of ".to_string(),
            layers => format!("{layers} layers of "),
        };
        let stacking = self.shape().stacking();
        let stacking = match stacking.name() {
            Some(name) => name.to_string(),
            None => quoted(&stacking.to_string()),
        };
        let (from, region) = match self.shape().anchor() {
            Anchor::Top(top) => ("under", top),
            Anchor::Base(base) => ("on", base),
        };
        let region = match region {
            Region::SITE => "one sphere".to_string(),
            region => format!("{region:#}"),
        };
        let spheres = match (self.dimension(), self.layers()) {
            (Dimension::Two, 1) => "one disc".to_string(),
            (Dimension::Two, _) => "discs".to_string(),
            (Dimension::Three, 1) => region,
            (Dimension::Three, _) => format!("{stacking} {from} {region}"),
        };
        let angle = if self.is_regular() {
            String::new()
        } else {
            format!(", sin φ = {}", quoted(&self.sin_phi().to_string()))
        };
        let weightless = if self.is_weightless() {
            ", weightless"
        } else {
            ""
        };
        let [x, y] = self.tilt();
        let tilt = if x.is_zero() && y.is_zero() {
            String::new()
        } else {
            format!(
                ", tilt {},{}",
                quoted(&x.to_string()),
                quoted(&y.to_string())
            )
        };
        let counted = |count: usize, one: &str| match count {
            0 => String::new(),
            1 => format!(", 1 {one}"),
            more => format!(", {more} {one}s"),
        };
        let weights = counted(self.weights().count(), "weight");
        let loads = counted(self.loads().len(), "load");
        let pushes = counted(self.horizontal_forces().len(), "horizontal force");
        padded(
            f,
            format_args!("{layers}{spheres}{angle}{tilt}{weightless}{weights}{loads}{pushes}"),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::{Axis, HorizontalContact, Site};
    use crate::ratio;

    #[test]
    fn every_pile_is_one_line() {
        let under = |top: &str, stacking: &str| {
            Pile::under(top.parse().unwrap(), stacking.parse().unwrap()).unwrap()
        };
        let leaning = |tilt| Pile::triangular(2).unwrap().with_tilt(tilt).unwrap();
        let contact = HorizontalContact {
            site: Site::new(0, 0, 1),
            axis: Axis::AlphaBeta,
        };
        let pushed = Pile::triangular(3).unwrap();
        let pushed = pushed.with_horizontal_force(contact, ratio!(1)).unwrap();
        let loaded = under("hexagon:1", "+-+").with_load(Site::APEX, ratio!(1));
        let loaded = loaded.unwrap().with_weight(Site::APEX, ratio!(3)).unwrap();
        let loaded = loaded.with_weight(Site::new(0, 0, 1), ratio!(0)).unwrap();
        for (pile, line) in [
            (Pile::triangular(1).unwrap(), "1 layer of one sphere"),
            (Pile::discs(1).unwrap(), "1 layer of one disc"),
            (Pile::discs(3).unwrap(), "3 layers of discs"),
            (under("hexagon:3", "A"), "1 layer of hexagon:3"),
            (
                under("0..3,0..1,0..4", "+-"),
                "3 layers of hcp under region:0..3,0..1,0..4",
            ),
            (under("hexagon:1", "--"), "3 layers of -- under one sphere"),
            (
                Pile::isosceles(5, ratio!(2 / 5)).unwrap(),
                "5 layers of fcc under one sphere, sin φ = 2/5",
            ),
            (
                pushed,
                "3 layers of fcc under one sphere, 1 horizontal force",
            ),
            (
                loaded,
                "4 layers of hcp under one sphere, 2 weights, 1 load",
            ),
            (
                leaning([ratio!(1 / 4), ratio!(0)]),
                "2 layers of fcc under one sphere, tilt 1/4,0",
            ),
            (
                leaning([ratio!(0), ratio!(-1)]),
                "2 layers of fcc under one sphere, tilt 0,-1",
            ),
        ] {
            assert_eq!(pile.to_string(), line);
        }
        let long = under("hexagon:1", &format!("({})", ["3"; 1000].join(",")));
        let line = long.to_string();
        assert!(
            line.starts_with("3001 layers of (3,3,") && line.len() < 120,
            "{line}"
        );
        assert_eq!(
            format!("{:>20}", Pile::discs(3).unwrap()),
            "   3 layers of discs"
        );
    }

    #[cfg(feature = "std")]
    #[test]
    fn equal_piles_are_one_key() {
        use std::collections::HashSet;
        let load = |n| {
            Pile::triangular(4)
                .unwrap()
                .with_load(Site::APEX, n)
                .unwrap()
        };
        let straight = Pile::under(Region::SITE, "+++".parse().unwrap()).unwrap();
        let piles = [
            load(ratio!(2 / 4)),
            load(ratio!(1 / 2)),
            load(ratio!(1)),
            Pile::triangular(4).unwrap(),
            straight,
        ];
        assert_eq!(piles.into_iter().collect::<HashSet<_>>().len(), 3);
    }
}
