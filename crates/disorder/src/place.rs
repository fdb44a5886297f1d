//! Places: what is the same in every stacking.

use cannonpile::lattice::Sign;

/// A horizontal place a·u_β + b·u_γ, the same in every stacking.
///
/// u_α, u_β, u_γ are the horizontal parts of the contacts α, β, γ below a sphere under a + step: of length ρ = 2R sinθ, at
/// 120° to each other, with the sum 0. A + step leads a contact from a place x to x + u, a − step to x − u: so places
/// need no stacking. The sphere (i, j) of a layer that lies s net steps (+ steps less − steps) below the top layer is at
///
/// a = 2i + j − s, b = i + 2j − s,
///
/// and so a place holds a sphere only in layers with s ≡ a + b (mod 3), of one registry. Of a pile on a base the same
/// holds with −s the net steps from the layer down to the base, so that in the base itself a = 2i + j, b = i + 2j.
///
/// Places are ordered as tables print them: by b, then a.
///
/// # Examples
/// ```
/// use cannonpile_disorder::Place;
///
/// // Three steps straight down along β, two along γ.
/// let place = Place::of([3, 2], 5).unwrap();
/// assert_eq!(place, Place { a: 3, b: 2 });
/// assert_eq!(place.site(5), Some([3, 2]));
/// // After four net steps no sphere is there.
/// assert_eq!(place.site(4), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// The steps along u_β.
    pub a: i128,
    /// The steps along u_γ.
    pub b: i128,
}

impl Place {
    /// Returns the place of the sphere (i, j) of a layer `net` steps below the top, − steps counted as −1; `None` past
    /// `i128`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Place;
    ///
    /// assert_eq!(Place::of([1, 0], 0), Some(Place { a: 2, b: 1 }));
    /// ```
    #[must_use]
    pub fn of([i, j]: [i128; 2], net: i128) -> Option<Self> {
        let along = |twice: i128, once: i128| {
            let sum = twice.checked_mul(2)?.checked_add(once)?;
            sum.checked_sub(net)
        };
        Some(Self {
            a: along(i, j)?,
            b: along(j, i)?,
        })
    }

    /// Returns the site (i, j) of this place in a layer `net` steps below the top; `None` if that layer has none here, and
    /// past `i128`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Place;
    ///
    /// assert_eq!(Place { a: -1, b: -1 }.site(1), Some([0, 0]));
    /// ```
    #[must_use]
    pub fn site(self, net: i128) -> Option<[i128; 2]> {
        let of = |twice: i128, once: i128| {
            let tripled = twice.checked_mul(2)?.checked_sub(once)?.checked_add(net)?;
            (tripled.rem_euclid(3) == 0).then_some(tripled / 3)
        };
        Some([of(self.a, self.b)?, of(self.b, self.a)?])
    }

    /// Returns the registry, a + b modulo 3: a sphere is here only in layers whose net number of steps has it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Place;
    ///
    /// assert_eq!(Place { a: -1, b: -1 }.registry(), 1);
    /// ```
    #[must_use]
    pub const fn registry(self) -> usize {
        // Remainders first: their sum is small.
        match (self.a.rem_euclid(3) + self.b.rem_euclid(3)) % 3 {
            0 => 0,
            1 => 1,
            _ => 2,
        }
    }

    /// Returns r²/ρ² = a² − ab + b², with r the distance from the place (0, 0); `None` past `i128`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Place;
    ///
    /// assert_eq!(Place { a: 2, b: 1 }.distance_squared(), Some(3));
    /// ```
    #[must_use]
    pub fn distance_squared(self) -> Option<i128> {
        let Self { a, b } = self;
        let [aa, ab, bb] = [a.checked_mul(a)?, a.checked_mul(b)?, b.checked_mul(b)?];
        aa.checked_sub(ab)?.checked_add(bb)
    }

    /// How a contact of each direction leads from place to place: ±u_α, ±u_β, ±u_γ.
    pub(super) const fn descents(sign: Sign) -> [[isize; 2]; 3] {
        match sign {
            Sign::Plus => [[-1, -1], [1, 0], [0, 1]],
            Sign::Minus => [[1, 1], [-1, 0], [0, -1]],
        }
    }
}

impl Ord for Place {
    fn cmp(&self, other: &Self) -> core::cmp::Ordering {
        (self.b, self.a).cmp(&(other.b, other.a))
    }
}

impl PartialOrd for Place {
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl core::fmt::Display for Place {
    /// Prints `(a,b)`.
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "({},{})", self.a, self.b)
    }
}
