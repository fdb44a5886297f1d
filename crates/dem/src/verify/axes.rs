//! The axes of a table in terms of the axes of the scene.

use core::fmt;

use crate::Each;

/// One of the three coordinates of a position or a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Coordinate {
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
    /// The third coordinate.
    Z,
}

impl Coordinate {
    const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// Returns this coordinate of a vector.
    const fn of(self, [x, y, z]: [f64; 3]) -> f64 {
        match self {
            Self::X => x,
            Self::Y => y,
            Self::Z => z,
        }
    }
}

/// An axis of a table, possibly reversed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TableAxis {
    /// The coordinate along the axis.
    pub coordinate: Coordinate,
    /// True if the axis points in the negative direction of this coordinate.
    pub is_reversed: bool,
}

impl TableAxis {
    /// Returns the component of a vector along this axis.
    fn of(self, vector: [f64; 3]) -> f64 {
        let component = self.coordinate.of(vector);
        if self.is_reversed {
            // The subtraction keeps 0 from becoming −0.
            0.0 - component
        } else {
            component
        }
    }
}

impl From<Coordinate> for TableAxis {
    fn from(coordinate: Coordinate) -> Self {
        Self {
            coordinate,
            is_reversed: false,
        }
    }
}

/// A signed permutation of the axes of a table: the three axes that are x, y and z of the scene. There are 48, mirror
/// images included.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::Axes;
/// use cannonpile_dem::verify::Coordinate::{X, Y, Z};
///
/// // The vertical of the table is y.
/// let axes = Axes::new([Z.into(), X.into(), Y.into()]).unwrap();
/// assert_eq!(axes.turned([1.0, 9.81, 0.0]), [0.0, 1.0, 9.81]);
/// assert_eq!(axes.to_string(), "x, y, z of the scene are z, x, y of the table");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axes([TableAxis; 3]);

impl Axes {
    /// The identity: x, y and z of the table are those of the scene.
    pub const OWN: Self = Self::ordered([Coordinate::X, Coordinate::Y, Coordinate::Z], 0);

    /// Returns the permutation with these axes as x, y and z of the scene, or `None` if the same axis occurs twice.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Axes;
    /// use cannonpile_dem::verify::Coordinate::{X, Y, Z};
    ///
    /// assert!(Axes::new([Y.into(), X.into(), Z.into()]).is_some());
    /// assert!(Axes::new([X.into(), X.into(), Z.into()]).is_none());
    /// ```
    #[must_use]
    pub fn new(axes: [TableAxis; 3]) -> Option<Self> {
        let named = |coordinate| axes.iter().any(|axis| axis.coordinate == coordinate);
        Coordinate::ALL.into_iter().all(named).then_some(Self(axes))
    }

    /// Returns the axes of the table that are x, y and z of the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Axes;
    /// use cannonpile_dem::verify::Coordinate::{X, Y, Z};
    ///
    /// let axes = Axes::new([X.into(), Z.into(), Y.into()]).unwrap();
    /// assert_eq!(axes.get().map(|axis| axis.coordinate), [X, Z, Y]);
    /// ```
    #[must_use]
    pub const fn get(self) -> [TableAxis; 3] {
        self.0
    }

    /// Returns a vector of the table in the axes of the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Axes, TableAxis};
    /// use cannonpile_dem::verify::Coordinate::{X, Y, Z};
    ///
    /// let down = TableAxis { is_reversed: true, ..Z.into() };
    /// let axes = Axes::new([Y.into(), X.into(), down]).unwrap();
    /// assert_eq!(axes.turned([1.0, 2.0, 3.0]), [2.0, 1.0, -3.0]);
    /// ```
    #[must_use]
    pub fn turned(self, vector: [f64; 3]) -> [f64; 3] {
        self.0.each(|axis| axis.of(vector))
    }

    /// Returns whether the table is a mirror image of the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Axes;
    /// use cannonpile_dem::verify::Coordinate::{X, Y, Z};
    ///
    /// assert!(Axes::new([Y.into(), X.into(), Z.into()]).unwrap().is_mirrored());
    /// assert!(!Axes::new([Y.into(), Z.into(), X.into()]).unwrap().is_mirrored());
    /// ```
    #[must_use]
    pub fn is_mirrored(self) -> bool {
        let [x, y, z] = self.0.each(|axis| axis.coordinate);
        let swapped = [x > y, x > z, y > z].into_iter().filter(|is| *is).count();
        let reversed = self.0.iter().filter(|axis| axis.is_reversed).count();
        (swapped + reversed) % 2 == 1
    }

    /// Returns one permutation for each vertical axis, and then their mirror images. Turns about z yield all others.
    pub(super) fn upright() -> impl Iterator<Item = Self> {
        use Coordinate::{X, Y, Z};
        let orders = [[X, Y, Z], [Z, X, Y], [Y, Z, X]];
        // Two reversed axes are a turn, and one is a mirror image.
        [[0b000, 0b110], [0b010, 0b100]]
            .into_iter()
            .flat_map(move |signs| {
                let all = orders.into_iter();
                all.flat_map(move |order| signs.map(|signs| Self::ordered(order, signs)))
            })
    }

    /// Returns these axes, each reversed.
    pub(super) fn reversed(self) -> Self {
        Self(self.0.each(|axis| TableAxis {
            is_reversed: !axis.is_reversed,
            ..axis
        }))
    }

    /// Returns all 48 permutations with signs.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        use Coordinate::{X, Y, Z};
        let orders = [
            [X, Y, Z],
            [X, Z, Y],
            [Y, X, Z],
            [Y, Z, X],
            [Z, X, Y],
            [Z, Y, X],
        ];
        let signs = 0..8_u8;
        orders
            .into_iter()
            .flat_map(move |order| signs.clone().map(move |signs| Self::ordered(order, signs)))
    }

    /// Returns the axes in this order. Each bit of `signs` reverses one axis.
    const fn ordered([x, y, z]: [Coordinate; 3], signs: u8) -> Self {
        const fn axis(coordinate: Coordinate, bit: u8) -> TableAxis {
            TableAxis {
                coordinate,
                is_reversed: bit != 0,
            }
        }
        Self([axis(x, signs & 1), axis(y, signs & 2), axis(z, signs & 4)])
    }
}

impl fmt::Display for Coordinate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        })
    }
}

impl fmt::Display for TableAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.is_reversed { "-" } else { "" };
        write!(f, "{sign}{}", self.coordinate)
    }
}

impl fmt::Display for Axes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0;
        write!(f, "x, y, z of the scene are {x}, {y}, {z} of the table")?;
        if self.is_mirrored() {
            f.write_str(", a mirror image")?;
        }
        Ok(())
    }
}
