/-! ## Identities -/

/-- What a sphere of weight n mg passes on of g. -/
def to_below (s : Rat) (g : Three Rat) (n : Rat) : Three Rat :=
  let w := increments s
  ⟨passed_on g.alpha (force n w.alpha), passed_on g.beta (force n w.beta), passed_on g.gamma (force n w.gamma)⟩

/-- The increments solve (5), and their sum is the weight. -/
theorem increments_solve (s : Rat) :
    s * ((increments s).alpha + (increments s).beta) - (increments s).gamma = 0 ∧
    (increments s).alpha - (increments s).beta = 0 ∧ weight (increments s) = 2 * (1 + s) := by
  simp only [increments, weight]; grind

/-- Every sphere that passes on what it receives and adds is in balance, for every angle. -/
theorem every_sphere_is_in_balance (s : Rat) (g : Three Rat) (n : Rat) :
    let left := unbalanced (to_below s g n) (directions s) g (directions s) (force n (weight (increments s)))
    left.along_x = 0 ∧ left.along_y = 0 ∧ left.along_z = 0 := by
  simp only [unbalanced, to_below, directions, increments, weight, force, passed_on]; grind

/-- The half-turn is its own inverse. -/
theorem half_turn_twice (g : Three Rat) : half_turn (half_turn g) = g := by
  cases g; simp only [half_turn, Three.mk.injEq]; grind

/-- It keeps lengths. -/
theorem half_turn_keeps_lengths (g : Three Rat) :
    let h := half_turn g
    h.alpha * h.alpha + h.beta * h.beta + h.gamma * h.gamma
      = g.alpha * g.alpha + g.beta * g.beta + g.gamma * g.gamma := by
  simp only [half_turn]; grind

/-- A sphere at a change of sign is in balance, from + to −, on an equilateral base. -/
theorem change_of_sign (g : Three Rat) (n : Rat) :
    let e := directions (1 / 2)
    let turned : Three Vector3 := ⟨turned_about_z e.alpha, turned_about_z e.beta, turned_about_z e.gamma⟩
    let h := half_turn g
    let left := unbalanced ⟨passed_on h.alpha n, passed_on h.beta n, passed_on h.gamma n⟩ turned g e (n * 3)
    left.along_x = 0 ∧ left.along_y = 0 ∧ left.along_z = 0 := by
  simp only [unbalanced, half_turn, directions, turned_about_z, passed_on]; grind

/-- The normal force on the floor, linear in j; so for s = 1/2 it is L + 2 everywhere. -/
theorem base_normal (s L i j : Rat) :
    let n := above i j (L - 1)
    let w := increments s
    (handed_on ⟨force n.alpha w.alpha, force n.beta w.beta, force n.gamma w.gamma⟩ (directions s) (weight w)).along_z
      = 2 * (1 + s) + (L - 1 - j) + 2 * s * j := by
  simp only [handed_on, above, increments, directions, weight, force]; grind

end Cannonpile
