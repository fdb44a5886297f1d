//! Places: horizontal positions that do not depend on the stacking.

use cannonpile::lattice::Sign;

/// A horizontal position a·u_β + b·u_γ, which is the same in every stacking.
///
/// u_α, u_β, u_γ are the horizontal parts of the contacts α, β, γ below a sphere under a + step. Their length is ρ = 2R
/// sinθ, they form angles of 120°, and their sum is 0. A contact leads from a place x to x + u under a + step, and to x
/// − u under a − step. The net number s of steps from the top layer to a layer is the number of + steps minus the
/// number of − steps. The sphere (i, j) of that layer is at
///
/// a = 2i + j − s, b = i + 2j − s.
///
/// So a layer can have a sphere at a place only if s ≡ a + b (mod 3). For a pile on a base the same holds with −s, the
/// net number of steps from the layer down to the base. In the base itself a = 2i + j and b = i + 2j.
///
/// Places are sorted by b, then a, as in tables.
///
/// # Examples
/// ```
/// use cannonpile_disorder::Place;
///
/// // Three contacts along β, then two along γ.
/// let place = Place::of([3, 2], 5).unwrap();
/// assert_eq!(place, Place { a: 3, b: 2 });
/// assert_eq!(place.site(5), Some([3, 2]));
/// // A layer of net number 4 has no sphere there.
/// assert_eq!(place.site(4), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// The coefficient of u_β.
    pub a: i128,
    /// The coefficient of u_γ.
    pub b: i128,
}

impl Place {
    /// Returns the place of the sphere (i, j) of a layer `net` steps below the top. A − step counts as −1. `None` if a
    /// coordinate exceeds `i128`.
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

    /// Returns the site (i, j) at this place in a layer `net` steps below the top. `None` if the layer has no site
    /// there, or if a coordinate exceeds `i128`.
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

    /// Returns the registry of the place, a + b modulo 3. Only layers with this net number of steps modulo 3 can have a
    /// sphere there.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Place;
    ///
    /// assert_eq!(Place { a: -1, b: -1 }.registry(), 1);
    /// ```
    #[must_use]
    pub const fn registry(self) -> usize {
        // Reducing both terms first keeps the sum small.
        match (self.a.rem_euclid(3) + self.b.rem_euclid(3)) % 3 {
            0 => 0,
            1 => 1,
            _ => 2,
        }
    }

    /// Returns r²/ρ² = a² − ab + b², with r the distance from the place (0, 0). `None` if it exceeds `i128`.
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

    /// Returns the shifts of a place by the contacts of each direction: ±u_α, ±u_β, ±u_γ.
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
