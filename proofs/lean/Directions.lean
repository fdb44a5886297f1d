/-!
# The formulas of cannonpile as they run, and identities about them

Each function of the library was run on symbols, and what it did to them is written down here, in its order and
unsimplified. Written by `cannonpile prove --to lean`: not to be changed by hand.

NOT CHECKED. No Lean was at hand where this was written; Coq checks the same definitions, and far more about them
(`cannonpile prove --to coq`). It is meant for Lean 4.22 or later, whose `grind` knows the rationals; without Mathlib.
-/

namespace Cannonpile

/-- The three contacts below a sphere. -/
inductive Direction where
  | alpha
  | beta
  | gamma

/-- The sign of a step from a layer to the one below. -/
inductive Sign where
  | plus
  | minus

/-- One thing for each direction. -/
structure Three (A : Type) where
  alpha : A
  beta : A
  gamma : A

/-- A vector by its components along x sin θ, y 2 cos φ sin θ, z cos θ, z down. -/
structure Vector3 where
  along_x : Rat
  along_y : Rat
  along_z : Rat
