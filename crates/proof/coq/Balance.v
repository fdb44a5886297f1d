(** Newton's law for one sphere: a sphere is in balance if and only if it transmits the forces received plus its own
    increments. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa.
From Cannonpile Require Import Directions Sums Formulas.

Open Scope Q_scope.

(** Unfolds the formulas and destructs vectors and triples. *)
Ltac formulas :=
  cbv beta iota zeta delta
    [above spheres_3 spheres_in_layer_3 contacts_3 contacts_of_strength_3 directions disc_directions
     turned_about_z position squared_distance increments force transmitted resultant support_load unbalanced weight
     half_turn tripled_half_turn tripled_apart load_increments disc_load_increments pushed beside contact_drop compression elastic_field corner_field
     least_on_corner greatest_on_corner greatest_inside greatest_on_edge arch
     spheres_2 spheres_in_layer_2 weight_2 third_moment fourth_moment fourth_moment_of_pair mean_third_moment
     mean_fourth_moment_of_pairs wave registry_excess
     alpha beta gamma along_x along_y along_z on each map by_line sum nothing same same_vector].

Ltac by_components := cbv zeta; repeat split; formulas; ring.

(** Unfolds and destructs in a hypothesis, like [formulas] in the goal. *)
Ltac formulas_in H :=
  cbv beta iota zeta delta
    [above directions turned_about_z position increments force transmitted resultant support_load unbalanced weight
     half_turn load_increments disc_load_increments beside pushed alpha beta gamma along_x along_y along_z on each map by_line sum nothing same same_vector]
    in H.

(** The sum of c_m v_m. *)
Definition combination (c : three Q) (v : three vector) : vector :=
  let part axis := sum (by_line (fun c v => c * axis v) c v) in
  Vector (part along_x) (part along_y) (part along_z).

Definition turned_over (v : vector) : vector := Vector (- v.(along_x)) (- v.(along_y)) (- v.(along_z)).

(** The contact directions under a step of either sign. *)
Definition directions_under (s : Q) (sigma : sign) : three vector :=
  match sigma with
  | Plus => directions s
  | Minus => map turned_about_z (directions s)
  end.

(** The increments of a sphere of weight n mg along its lines. *)
Definition own (s n : Q) : three Q := map (force n) (increments s).

(** The forces transmitted by a sphere of weight n mg that receives g. *)
Definition to_below (s : Q) (g : three Q) (n : Q) : three Q := by_line transmitted g (own s n).

(** ** (3), (4), (5), (6) of the paper *)

(** Equilibrium in components is system (4) of the paper. *)
Theorem paper_system : forall s up down w,
  let left := unbalanced up (directions s) down (directions s) w in
  let more := by_line Qminus up down in
  left.(along_x) == s * (more.(alpha) + more.(beta)) - more.(gamma) /\
  2 * left.(along_y) == more.(alpha) - more.(beta) /\
  left.(along_z) == w - more.(alpha) - more.(beta) - more.(gamma).
Proof. intros s [] [] w. by_components. Qed.

(** The increments solve (5), and their sum is the weight, 2(1+s). *)
Theorem increments_solve : forall s,
  let w := increments s in
  s * (w.(alpha) + w.(beta)) - w.(gamma) == 0 /\ w.(alpha) - w.(beta) == 0 /\
  w.(alpha) + w.(beta) + w.(gamma) == weight w /\ weight w == 2 * (1 + s).
Proof. intros s. by_components. Qed.

(** e_a . (e_b x e_c) = 1 + s: the three directions are linearly independent. *)
Definition triple_product (v : three vector) : Q :=
  let (a, b, c) := v in
  a.(along_x) * (b.(along_y) * c.(along_z) - b.(along_z) * c.(along_y))
  + a.(along_y) * (b.(along_z) * c.(along_x) - b.(along_x) * c.(along_z))
  + a.(along_z) * (b.(along_x) * c.(along_y) - b.(along_y) * c.(along_x)).

Theorem determinant : forall s, triple_product (directions s) == 1 + s.
Proof. intros. unfold triple_product. formulas. ring. Qed.

(** If a product is zero and a is not zero, then b is zero. *)
Lemma factor : forall a b, ~ a == 0 -> a * b == 0 -> b == 0.
Proof.
  intros a b Ha H. destruct (Qmult_integral _ _ H); [contradiction | assumption].
Qed.

(** Equal forces have equal residuals. *)
Lemma unbalanced_of_same : forall f f' e g g' e' w w',
  f =3= f' -> g =3= g' -> w == w' -> unbalanced f e g e' w =v= unbalanced f' e g' e' w'.
Proof.
  intros f f' e g g' e' w w' (a & b & c) (x & y & z) H. repeat split; formulas; congruent.
Qed.

(** A sphere that transmits the forces received plus its increments is in balance: in all components, for every
    angle. *)
Theorem every_sphere_is_in_balance : forall s g n,
  let e := directions s in
  unbalanced (to_below s g n) e g e (force n (weight (increments s))) =v= nothing.
Proof. intros s [] n. unfold to_below, own. by_components. Qed.

(** A sphere of weight n mg that receives g is in balance if and only if it transmits g + n increments. *)
Theorem newton : forall s g n up, ~ 1 + s == 0 ->
  (unbalanced up (directions s) g (directions s) (force n (weight (increments s))) =v= nothing
   <-> up =3= to_below s g n).
Proof.
  intros s [a b c] n [x y z] Hs. split.
  - unfold to_below, own. intros H. formulas_in H. destruct H as (Hx & Hy & Hz). formulas.
    assert (E1 : x - a - n == y - b - n) by lra.
    assert (E2 : (1 + s) * (2 * (x - a - n)) == 0).
    { assert (F : z - c == s * (x - a) + s * (y - b)) by lra.
      assert (G : z - c == n * (2 * (1 + s)) - (x - a) - (y - b)) by lra.
      rewrite F in G. assert (K : y - b == x - a) by lra. rewrite K in G.
      transitivity (s * (x - a) + s * (x - a) - (n * (2 * (1 + s)) - (x - a) - (x - a))); [ring|].
      rewrite G. ring. }
    apply factor in E2; [|assumption].
    assert (X : x == a + n) by lra. assert (Y : y == b + n) by lra.
    repeat split; lra.
  - intros H. etransitivity; [|exact (every_sphere_is_in_balance s (Three a b c) n)].
    apply unbalanced_of_same; [exact H | reflexivity | reflexivity].
Qed.

(** This also holds under - steps. *)
Theorem every_sphere_is_in_balance_under : forall s sigma g n,
  let e := directions_under s sigma in
  unbalanced (to_below s g n) e g e (force n (weight (increments s))) =v= nothing.
Proof. intros s [] [] n; unfold to_below, own, directions_under; by_components. Qed.

(** The reaction of the three supports is opposite to the sum of the forces from above and the weight. *)
Theorem supports_push_back : forall s g n,
  let e := directions s in
  combination (to_below s g n) e =v= turned_over (support_load g e (force n (weight (increments s)))).
Proof.
  intros s [] n. unfold to_below, own, combination, turned_over. by_components.
Qed.

(** ** Directions *)

(** The squared length of a vector. The arguments are the squares of the units of its components: sin^2 theta, 4
    cos^2 phi sin^2 theta, cos^2 theta. *)
Definition length_squared (s sin2 : Q) (v : vector) : Q :=
  sin2 * (v.(along_x) * v.(along_x) + 4 * (1 - s * s) * v.(along_y) * v.(along_y))
  + (1 - sin2) * v.(along_z) * v.(along_z).

Theorem unit_directions : forall s sin2 d, length_squared s sin2 (on d (directions s)) == 1.
Proof. intros s sin2 []; unfold length_squared; formulas; ring. Qed.

(** Squared distances are squared lengths of difference vectors of centres. *)
Theorem gram_form : forall n s sin2,
  squared_distance n s sin2 == length_squared s sin2 (combination n (directions s)).
Proof. intros [] s sin2. unfold length_squared, combination. formulas. ring. Qed.

(** ** Sign changes *)

(** G g = (2/3)(g_1 + g_2 + g_3)(1, 1, 1) - g. *)
Theorem half_turn_is : forall g, half_turn g =3= map (fun x => (2 # 3) * sum g - x) g.
Proof. intros []. by_components. Qed.

Definition dot (g h : three Q) : Q := sum (by_line Qmult g h).

Theorem half_turn_keeps_lengths : forall g, dot (half_turn g) (half_turn g) == dot g g.
Proof. intros []. unfold dot. formulas. ring. Qed.

Theorem half_turn_is_symmetric : forall g h, dot h (half_turn g) == dot g (half_turn h).
Proof. intros [] []. unfold dot. formulas. ring. Qed.

Theorem half_turn_twice : forall g, half_turn (half_turn g) =3= g.
Proof. intros []. by_components. Qed.

Theorem half_turn_of_ones : forall x, half_turn (each x) =3= each x.
Proof. intros. by_components. Qed.

Theorem half_turn_is_linear : forall g h,
  half_turn (by_line transmitted g h) =3= by_line transmitted (half_turn g) (half_turn h).
Proof. intros [] []. by_components. Qed.

Theorem tripled : forall g,
  tripled_half_turn g =3= map (Qmult 3) (half_turn g) /\ tripled_apart g =3= map (Qmult 3) (half_turn g).
Proof. intros []. split; by_components. Qed.

(** The integer formulas agree with the rational ones: the half-turn of the engines is the half-turn of the theory. *)
Theorem tripled_integers : forall g,
  map q (Integers.tripled_half_turn g) =3= map (Qmult 3) (half_turn (map q g)) /\
  map q (Integers.tripled_apart g) =3= map (Qmult 3) (half_turn (map q g)).
Proof.
  intros [a b c]. unfold Integers.tripled_half_turn, Integers.tripled_apart. cbv [alpha beta gamma].
  unfold Z.sub. repeat split; formulas; repeat (rewrite inject_Z_plus || rewrite inject_Z_opp); ring.
Qed.

(** The forces received along the directions of one step, resolved along the directions of the next step. *)
Definition transferred (from to : sign) (g : three Q) : three Q :=
  match from, to with
  | Plus, Plus | Minus, Minus => g
  | _, _ => half_turn g
  end.

(** On an equilateral base: a sphere of weight n mg lies below a step of one sign and above a step of the same or the
    other sign, and receives any g. It is in balance if and only if it transmits T g + n. *)
Theorem newton_in_any_stacking : forall from to g n up,
  (unbalanced up (directions_under (1 # 2) to) g (directions_under (1 # 2) from)
     (force n (weight (increments (1 # 2)))) =v= nothing
   <-> up =3= by_line transmitted (transferred from to g) (each n)).
Proof.
  intros from to [a b c] n [x y z].
  destruct from, to; unfold directions_under, transferred;
    (split; [intros H; formulas_in H; destruct H as (Hx & Hy & Hz); formulas; repeat split; lra
            | intros (Hx & Hy & Hz); formulas_in Hx; formulas_in Hy; formulas_in Hz;
              formulas; repeat split; lra]).
Qed.

Theorem change_of_sign : forall from g n,
  unbalanced (by_line transmitted (half_turn g) (each n)) (directions_under (1 # 2) (opposite from)) g
    (directions_under (1 # 2) from) (force n (weight (increments (1 # 2)))) =v= nothing.
Proof. intros [] [] n; unfold directions_under, opposite; by_components. Qed.
