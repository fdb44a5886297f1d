//! Colours for numbers that the colour-blind can tell apart, in print too.

use core::fmt;

use super::ticks;

/// A colour of the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colour {
    /// Red, green and blue, 0 to 255 each.
    pub rgb: [u8; 3],
}

impl Colour {
    pub(super) const fn new(red: u8, green: u8, blue: u8) -> Self {
        Self {
            rgb: [red, green, blue],
        }
    }

    /// How bright it looks, between 0 for black and 1 for white: 0.2126 R + 0.7152 G + 0.0722 B of the linear parts.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::Scale;
    ///
    /// // Greater numbers are brighter.
    /// let scale = Scale::of([1.0, 2.0, 4.0]);
    /// let [low, middle, high] = [1.0, 2.0, 4.0].map(|x| scale.colour(x).luminance());
    /// assert!(low < middle && middle < high);
    /// ```
    #[must_use]
    pub fn luminance(self) -> f64 {
        let linear = |part: u8| {
            let part = f64::from(part) / 255.0;
            if part <= 0.04045 {
                part / 12.92
            } else {
                ((part + 0.055) / 1.055).powf(2.4)
            }
        };
        let [red, green, blue] = self.rgb.map(linear);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    }

    /// Black or white, whichever is read better on this colour.
    pub(super) fn ink(self) -> Self {
        if self.luminance() > 0.18 {
            BLACK
        } else {
            WHITE
        }
    }

    /// A part `t` of the way to another colour.
    pub(super) fn towards(self, other: Self, t: f64) -> Self {
        let mut rgb = self.rgb;
        for (part, end) in rgb.iter_mut().zip(other.rgb) {
            let value = f64::from(*part) * (1.0 - t) + f64::from(end) * t;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "between two bytes"
            )]
            let byte = value.round().clamp(0.0, 255.0) as u8;
            *part = byte;
        }
        Self { rgb }
    }
}

impl fmt::Display for Colour {
    /// `#rrggbb`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [red, green, blue] = self.rgb;
        write!(f, "#{red:02x}{green:02x}{blue:02x}")
    }
}

pub(super) const BLACK: Colour = Colour::new(0x1a, 0x1a, 0x1a);
pub(super) const WHITE: Colour = Colour::new(0xff, 0xff, 0xff);
/// For what is there for orientation only.
pub(super) const GREY: Colour = Colour::new(0x8a, 0x8a, 0x8a);
/// Of words that are less than others, still read on white.
pub(super) const DIM: Colour = Colour::new(0x55, 0x55, 0x55);
/// Of the forces between spheres.
pub(super) const BLUE: Colour = Colour::new(0x0b, 0x57, 0x9f);
/// Of weights and loads.
pub(super) const ORANGE: Colour = Colour::new(0xb8, 0x4a, 0x00);

/// Dark blue, green, yellow: brighter all the way, and not by hue alone.
const SEQUENTIAL: [Colour; 9] = [
    Colour::new(0x44, 0x01, 0x54),
    Colour::new(0x47, 0x2d, 0x7b),
    Colour::new(0x3b, 0x52, 0x8b),
    Colour::new(0x2c, 0x72, 0x8e),
    Colour::new(0x21, 0x91, 0x8c),
    Colour::new(0x28, 0xae, 0x80),
    Colour::new(0x5e, 0xc9, 0x62),
    Colour::new(0xad, 0xdc, 0x30),
    Colour::new(0xfd, 0xe7, 0x25),
];

/// From blue over near-white to orange and brown: darker on both sides.
const DIVERGING: [Colour; 9] = [
    Colour::new(0x08, 0x2f, 0x6b),
    Colour::new(0x1f, 0x5f, 0xa8),
    Colour::new(0x5a, 0x9b, 0xd4),
    Colour::new(0xa9, 0xcc, 0xe8),
    Colour::new(0xf2, 0xf2, 0xf2),
    Colour::new(0xfd, 0xc0, 0x86),
    Colour::new(0xee, 0x8a, 0x2c),
    Colour::new(0xb8, 0x55, 0x08),
    Colour::new(0x6e, 0x2c, 0x00),
];

/// The colour `t` of the way through a palette.
fn mixed(palette: [Colour; 9], t: f64) -> Colour {
    let steps = 8.0;
    let at = if t.is_finite() {
        t.clamp(0.0, 1.0) * steps
    } else {
        steps / 2.0
    };
    let mut colours = palette.into_iter();
    let mut before = colours.next().unwrap_or(WHITE);
    let mut left = at;
    for colour in colours {
        if left <= 1.0 {
            return before.towards(colour, left);
        }
        (before, left) = (colour, left - 1.0);
    }
    before
}

/// How numbers become colours.
///
/// # Examples
/// ```
/// use cannonpile::figure::Scale;
///
/// // Around zero, if there are numbers on both sides: equally dark at equal distances.
/// let scale = Scale::of([-1.0, 0.0, 3.0]);
/// assert!(scale.is_around_zero());
/// assert_eq!(scale.colour(0.0).to_string(), "#f2f2f2");
/// assert_eq!((scale.least(), scale.most()), (-1.0, 3.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    least: f64,
    most: f64,
    palette: Palette,
}

/// Which colours there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Palette {
    /// From dark to bright.
    Rising,
    /// From near-white to dark on both sides of zero.
    Diverging,
    /// The same without the palest: for thin lines on white, of which also the weakest tell their sign.
    Signed,
}

/// The part of the palette on each side of zero that lines leave out.
const PALEST: f64 = 0.3;

impl Scale {
    /// The scale of these numbers: from the least to the greatest, or around zero if one of them is negative.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::Scale;
    ///
    /// // Without a negative number zero has no place of its own.
    /// let scale = Scale::of([5.0, 2.0]);
    /// assert!(!scale.is_around_zero());
    /// assert_eq!((scale.least(), scale.most()), (2.0, 5.0));
    /// ```
    #[must_use]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let (least, most) = ends(values);
        Self {
            least,
            most,
            palette: if least < 0.0 {
                Palette::Diverging
            } else {
                Palette::Rising
            },
        }
    }

    /// The scale around zero, of which only the side of positive numbers is used if none is negative.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::Scale;
    ///
    /// let scale = Scale::around_zero([2.0, 5.0]);
    /// assert_eq!((scale.least(), scale.most()), (0.0, 5.0));
    /// ```
    #[must_use]
    pub fn around_zero(values: impl IntoIterator<Item = f64>) -> Self {
        let (least, most) = ends(values);
        Self {
            least: least.min(0.0),
            most: most.max(0.0),
            palette: Palette::Diverging,
        }
    }

    /// The same for thin lines on white: the weakest push and pull are told from nothing, and from each other.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::Scale;
    ///
    /// let lines = Scale::of_lines([-1.0, 2.0]);
    /// let areas = Scale::around_zero([-1.0, 2.0]);
    /// assert!(lines.colour(0.1).luminance() < areas.colour(0.1).luminance());
    /// assert_eq!(lines.colour(2.0), areas.colour(2.0));
    /// ```
    #[must_use]
    pub fn of_lines(values: impl IntoIterator<Item = f64>) -> Self {
        Self {
            palette: Palette::Signed,
            ..Self::around_zero(values)
        }
    }

    /// The least number on it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::Scale;
    ///
    /// assert_eq!(Scale::of([3.0, -1.0, 2.0]).least(), -1.0);
    /// // Of no numbers it is 0.
    /// assert_eq!(Scale::of([]).least(), 0.0);
    /// ```
    #[must_use]
    pub fn least(&self) -> f64 {
        self.least
    }

    /// The greatest number on it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::Scale;
    ///
    /// assert_eq!(Scale::of([-3.0, -1.0]).most(), -1.0);
    /// // Zero is on every scale around it.
    /// assert_eq!(Scale::around_zero([-3.0, -1.0]).most(), 0.0);
    /// ```
    #[must_use]
    pub fn most(&self) -> f64 {
        self.most
    }

    /// Whether it tells negative from positive numbers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::Scale;
    ///
    /// assert!(!Scale::of([1.0, 2.0]).is_around_zero());
    /// assert!(Scale::of([-1.0, 2.0]).is_around_zero());
    /// assert!(Scale::of_lines([1.0, 2.0]).is_around_zero());
    /// ```
    #[must_use]
    pub fn is_around_zero(&self) -> bool {
        self.palette != Palette::Rising
    }

    /// Whether all its numbers are the same.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::Scale;
    ///
    /// assert!(!Scale::of([0.3, 0.31]).is_uniform());
    /// // What differs by roundings alone is the same.
    /// assert!(Scale::of([0.3, 0.1 + 0.2]).is_uniform());
    /// ```
    #[must_use]
    pub fn is_uniform(&self) -> bool {
        // A range too small for floats is none.
        !ticks::is_range(self.least, self.most)
    }

    /// The greatest magnitude on it.
    pub(super) fn greatest(&self) -> f64 {
        self.most.abs().max(self.least.abs())
    }

    /// The colour of a number.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::Scale;
    ///
    /// let scale = Scale::of([0.0, 1.0]);
    /// assert_eq!([0.0, 1.0].map(|x| scale.colour(x).to_string()), ["#440154", "#fde725"]);
    /// // Of one number only there is no least and no greatest.
    /// assert_eq!(Scale::of([4.0, 4.0]).colour(4.0).to_string(), "#21918c");
    /// ```
    #[must_use]
    pub fn colour(&self, value: f64) -> Colour {
        if self.is_around_zero() {
            let part = value / self.greatest();
            let mut part = if part.is_finite() { part } else { 0.0 };
            if self.palette == Palette::Signed && part != 0.0 {
                part = (PALEST + (1.0 - PALEST) * part.abs()).copysign(part);
            }
            return mixed(DIVERGING, part / 2.0 + 0.5);
        }
        if self.is_uniform() {
            return mixed(SEQUENTIAL, 0.5);
        }
        // Halved, the greatest floats have a difference too.
        mixed(
            SEQUENTIAL,
            (value / 2.0 - self.least / 2.0) / (self.most / 2.0 - self.least / 2.0),
        )
    }
}

/// The least and the greatest, or 0 and 0 of none.
fn ends(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let ends = values.into_iter().fold(None, |ends, value| {
        let (least, most): (f64, f64) = ends.unwrap_or((value, value));
        Some((least.min(value), most.max(value)))
    });
    ends.unwrap_or((0.0, 0.0))
}
