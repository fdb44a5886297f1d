(** Two layers on a rough floor, without glue: exactly one set of forces is in equilibrium.

    The upper layer is any finite set of spheres. An upper sphere has a contact with each of its three supports. A
    contact transmits any force and no moment. The floor acts on a lower sphere with any force and no moment, at the
    point where the sphere touches it. No law of friction or of springs is assumed, and no direction of a force.
    Neighbours in a layer do not touch. All loads are vertical, and act at the centres.

    The geometry that is assumed, with z down, as seen from the centre of a sphere:
    - the contacts of an upper sphere are at (-x, -y, k), where (x, y) depends only on the direction of the contact;
    - those of a lower sphere are at (x, y, -k), and its point on the floor is at (0, 0, r);
    - the three points (x, y) are not on a line, and k + r, the height of the contacts above the floor, is not 0.

    For spheres, (x, y) is R sin theta times a horizontal unit vector, k = R cos theta and r = R. The proofs of balance
    and uniqueness do not use this: they hold for any three points and heights. They also hold for any numbers, a
    commutative ring in which the area of the triangle and k + r have inverses. The real numbers are an example, with
    any angles theta and phi.

    The last part is about the recorded formulas, over rationals, in the units of the other files: R sin theta, 2 cos
    phi R sin theta and R cos theta for lengths, and the same multiples of mg/(W cos theta) for forces. There k = 1 and
    r = 1/cos theta. In such units each axis has one factor in all terms of a moment, so the equations do not change. *)

From Coq Require Import ZArith QArith Setoid Morphisms Lia List Ring Ring_theory.
From Cannonpile Require Import Directions Sums Formulas Balance Stackings.

Import ListNotations.

(** A force, or the position of its point, by components. *)
Record triple (F : Type) := Triple { px : F; py : F; pz : F }.
Arguments Triple {F} _ _ _.
Arguments px {F} _.
Arguments py {F} _.
Arguments pz {F} _.

Declare Scope number_scope.

Section Numbers.
Variable F : Type.
Variables (zero one : F) (add mul sub : F -> F -> F) (opp : F -> F) (eq : F -> F -> Prop).
Hypothesis equivalence : Equivalence eq.
Hypothesis congruence : ring_eq_ext add mul opp eq.
Hypothesis laws : ring_theory zero one add mul sub opp eq.

Add Ring numbers : laws (setoid equivalence congruence).

Existing Instance equivalence.

#[local] Instance add_proper : Proper (eq ==> eq ==> eq) add := Radd_ext congruence.
#[local] Instance mul_proper : Proper (eq ==> eq ==> eq) mul := Rmul_ext congruence.
#[local] Instance opp_proper : Proper (eq ==> eq) opp := Ropp_ext congruence.

Infix "==" := eq : number_scope.
Infix "+" := add : number_scope.
Infix "*" := mul : number_scope.
Infix "-" := sub : number_scope.
Notation "- x" := (opp x) : number_scope.
Notation "0" := zero : number_scope.
Notation "1" := one : number_scope.
Open Scope number_scope.

#[local] Instance sub_proper : Proper (eq ==> eq ==> eq) sub.
Proof.
  intros a b H c d K. rewrite (Rsub_def laws a c), (Rsub_def laws b d), H, K. reflexivity.
Qed.

Notation vec := (triple F).

Definition same_triple (v w : vec) : Prop := v.(px) == w.(px) /\ v.(py) == w.(py) /\ v.(pz) == w.(pz).
Infix "=t=" := same_triple (at level 70).

Definition minus_triple (v w : vec) : vec := Triple (v.(px) - w.(px)) (v.(py) - w.(py)) (v.(pz) - w.(pz)).

Lemma same_triple_symmetric : forall v w, v =t= w -> w =t= v.
Proof. intros v w (X & Y & Z). repeat split; symmetry; assumption. Qed.

(** ** Balance of one sphere *)

(** The law of Newton and Euler for a sphere at rest: the forces and the load down sum to 0, and so do the moments
    about the centre. Each force is given with its point. *)
Fixpoint total_of (part : vec * vec -> F) (forces : list (vec * vec)) : F :=
  match forces with [] => 0 | f :: rest => part f + total_of part rest end.

Definition balanced (forces : list (vec * vec)) (load : F) : Prop :=
  total_of (fun f => (snd f).(px)) forces == 0 /\
  total_of (fun f => (snd f).(py)) forces == 0 /\
  total_of (fun f => (snd f).(pz)) forces + load == 0 /\
  total_of (fun f => (fst f).(py) * (snd f).(pz) - (fst f).(pz) * (snd f).(py)) forces == 0 /\
  total_of (fun f => (fst f).(pz) * (snd f).(px) - (fst f).(px) * (snd f).(pz)) forces == 0 /\
  total_of (fun f => (fst f).(px) * (snd f).(py) - (fst f).(py) * (snd f).(px)) forces == 0.

(** ** The geometry *)

Variables x y : direction -> F.
Variables k r : F.

(** The cross product of horizontal vectors, and the vector from one of the three points to another. *)
Definition cross (a b : F * F) : F := fst a * snd b - snd a * fst b.
Definition side (l m : direction) : F * F := (x m - x l, y m - y l).

(** Twice the area of the triangle of the three points (x, y). *)
Definition area : F := cross (side Alpha Beta) (side Alpha Gamma).

(** On an isosceles base with sin phi = s, cos phi = c and R sin theta = a, the area is not 0. *)
Theorem area_of_isosceles : forall a s c,
  x Alpha == a * s -> y Alpha == a * c -> x Beta == a * s -> y Beta == - (a * c) -> x Gamma == - a -> y Gamma == 0 ->
  area == - ((1 + 1) * (a * a) * c * (1 + s)).
Proof.
  intros a s c xa ya xb yb xc yc. unfold area, cross, side. cbn [fst snd]. rewrite xa, ya, xb, yb, xc, yc. ring.
Qed.

Definition of_upper (d : direction) : vec := Triple (- x d) (- y d) k.
Definition of_lower (d : direction) : vec := Triple (x d) (y d) (- k).
Definition on_floor : vec := Triple 0 0 r.

(** The forces on an upper sphere: f d at its contact in direction d. *)
Definition on_upper (f : direction -> vec) : list (vec * vec) :=
  [(of_upper Alpha, f Alpha); (of_upper Beta, f Beta); (of_upper Gamma, f Gamma)].

(** The forces on a lower sphere: the reactions to f d on the upper spheres, and g from the floor. *)
Definition reaction (f : vec) : vec := Triple (- f.(px)) (- f.(py)) (- f.(pz)).

Definition on_lower (f : direction -> vec) (g : vec) : list (vec * vec) :=
  [(of_lower Alpha, reaction (f Alpha)); (of_lower Beta, reaction (f Beta)); (of_lower Gamma, reaction (f Gamma));
   (on_floor, g)].

(** ** The layers *)

Variable top : list (Z * Z).
Variable sigma : sign.

Definition up (d : direction) (p : Z * Z) : Z * Z := above_in sigma d (fst p) (snd p).

(** The force on the upper sphere at the contact that leads to the lower sphere p in direction d, if there is one. *)
Definition force_above (f : Z * Z -> direction -> vec) (p : Z * Z) (d : direction) : vec :=
  if member top (fst (up d p)) (snd (up d p)) then f (up d p) d else Triple 0 0 0.

(** A lower sphere supports some upper sphere. *)
Definition in_base (p : Z * Z) : Prop := exists u d, In u top /\ p = support sigma u d.

(** All spheres are in balance, under the loads w of the upper and v of the lower layer. *)
Definition equilibrium (w v : Z * Z -> F) (f : Z * Z -> direction -> vec) (g : Z * Z -> vec) : Prop :=
  (forall u, In u top -> balanced (on_upper (f u)) (w u)) /\
  (forall p, in_base p -> balanced (on_lower (force_above f p) (g p)) (v p)).

Ltac open :=
  unfold area, balanced, on_upper, on_lower, of_upper, of_lower, on_floor, reaction, cross, side, minus_triple,
    same_triple in *;
  cbn [total_of fst snd px py pz] in *.

(** ** Existence: N along the contacts and T = N tan(theta/2) across them *)

(** tau is 1/(k + r), the horizontal force of a contact for N = 1 and a horizontal lever of 1. *)
Variable tau : F.
Hypothesis tau_is : tau * (k + r) == 1.

(** The sum of N and T, as a force on the upper sphere: its vertical part is N, and its line of action leads to the
    point of the lower sphere on the floor. *)
Definition with_friction (n : F) (d : direction) : vec := Triple (tau * (n * x d)) (tau * (n * y d)) (- n).

(** tau |h| is the tangent t of theta/2, for k = r cos theta, |h| = r sin theta, cos theta = (1-t^2)/(1+t^2) and
    sin theta = 2t/(1+t^2). *)
Theorem tangent_of_half_the_angle : forall t u h, u * (1 + t * t) == 1 ->
  (1 + t * t) * k == (1 - t * t) * r -> (1 + t * t) * h == (1 + 1) * t * r -> tau * h == t.
Proof.
  intros t u h U K H.
  assert (E : (1 + t * t) * (tau * h) == (1 + t * t) * t).
  { transitivity (tau * ((1 + t * t) * h)); [ring|]. rewrite H.
    transitivity (tau * ((1 - t * t) * r + (1 + t * t) * r) * t); [ring|]. rewrite <- K.
    transitivity ((1 + t * t) * (tau * (k + r)) * t); [ring | rewrite tau_is; ring]. }
  transitivity (u * ((1 + t * t) * (tau * h))); [transitivity (u * (1 + t * t) * (tau * h)); [rewrite U|]; ring|].
  rewrite E. transitivity (u * (1 + t * t) * t); [ring | rewrite U; ring].
Qed.

(** Its part along the contact is N, and T^2 = (tau |h|)^2 N^2, if the sphere has radius r and m is the square of the
    unit along y. tau |h| = R sin theta/(R + R cos theta) = tan(theta/2). *)
Theorem along_and_across : forall m n d,
  let inner a b := a.(px) * b.(px) + m * (a.(py) * b.(py)) + a.(pz) * b.(pz) in
  let h2 := x d * x d + m * (y d * y d) in
  h2 + k * k == r * r ->
  inner (with_friction n d) (of_lower d) == n * r /\
  inner (with_friction n d) (with_friction n d) - n * n == tau * tau * h2 * (n * n).
Proof.
  intros m n d inner h2 H. unfold inner, h2, with_friction, of_lower in *. cbn [px py pz]. split; [|ring].
  transitivity (tau * n * (x d * x d + m * (y d * y d) + k * k) + n * k * (1 - tau * k)); [ring|].
  rewrite H. transitivity (tau * (k + r) * (n * (r - k)) + n * k); [ring | rewrite tau_is; ring].
Qed.

(** The moment of the force about the point of the lower sphere on the floor is 0. *)
Theorem no_moment_about_the_floor : forall n d,
  let l := minus_triple (of_lower d) on_floor in
  let f := reaction (with_friction n d) in
  l.(py) * f.(pz) - l.(pz) * f.(py) == 0 /\
  l.(pz) * f.(px) - l.(px) * f.(pz) == 0 /\
  l.(px) * f.(py) - l.(py) * f.(px) == 0.
Proof.
  intros n d l f. unfold l, f, with_friction. open. repeat split.
  - transitivity (n * y d * (1 - tau * (k + r))); [ring | rewrite tau_is; ring].
  - transitivity (n * x d * (tau * (k + r) - 1)); [ring | rewrite tau_is; ring].
  - ring.
Qed.

(** The floor balances the forces of a lower sphere. *)
Definition from_floor (v : Z * Z -> F) (f : Z * Z -> direction -> vec) (p : Z * Z) : vec :=
  let sum part := part (force_above f p Alpha) + part (force_above f p Beta) + part (force_above f p Gamma) in
  Triple (sum px) (sum py) (sum pz - v p).

Lemma upper_balanced : forall (n : direction -> F) w,
  n Alpha + n Beta + n Gamma == w ->
  n Alpha * x Alpha + n Beta * x Beta + n Gamma * x Gamma == 0 ->
  n Alpha * y Alpha + n Beta * y Beta + n Gamma * y Gamma == 0 ->
  balanced (on_upper (fun d => with_friction (n d) d)) w.
Proof.
  intros n w W X Y. unfold with_friction. open. repeat split.
  - transitivity (tau * (n Alpha * x Alpha + n Beta * x Beta + n Gamma * x Gamma)); [ring | rewrite X; ring].
  - transitivity (tau * (n Alpha * y Alpha + n Beta * y Beta + n Gamma * y Gamma)); [ring | rewrite Y; ring].
  - rewrite <- W. ring.
  - transitivity ((1 - k * tau) * (n Alpha * y Alpha + n Beta * y Beta + n Gamma * y Gamma)); [ring | rewrite Y; ring].
  - transitivity ((k * tau - 1) * (n Alpha * x Alpha + n Beta * x Beta + n Gamma * x Gamma)); [ring | rewrite X; ring].
  - ring.
Qed.

Lemma lower_balanced : forall (n : direction -> F) v,
  let f d := with_friction (n d) d in
  balanced (on_lower f
    (Triple ((f Alpha).(px) + (f Beta).(px) + (f Gamma).(px)) ((f Alpha).(py) + (f Beta).(py) + (f Gamma).(py))
      ((f Alpha).(pz) + (f Beta).(pz) + (f Gamma).(pz) - v))) v.
Proof.
  intros n v f. unfold f, with_friction. open. repeat split; try ring.
  - transitivity ((n Alpha * y Alpha + n Beta * y Beta + n Gamma * y Gamma) * (1 - tau * (k + r)));
      [ring | rewrite tau_is; ring].
  - transitivity ((n Alpha * x Alpha + n Beta * x Beta + n Gamma * x Gamma) * (tau * (k + r) - 1));
      [ring | rewrite tau_is; ring].
Qed.

(** Equal forces have equal sums. *)
Lemma lower_balanced_of_same : forall f f' g g' v,
  (forall d, f d =t= f' d) -> g =t= g' -> balanced (on_lower f g) v -> balanced (on_lower f' g') v.
Proof.
  intros f f' g g' v H (gx & gy & gz) B.
  destruct (H Alpha) as (ax & ay & az), (H Beta) as (bx & by_ & bz), (H Gamma) as (cx & cy & cz).
  open. rewrite ax, ay, az, bx, by_, bz, cx, cy, cz, gx, gy, gz in B. exact B.
Qed.

(** If N balances the loads w and has no horizontal sum, as in the pile without friction, then N and T are in
    equilibrium, with any vertical loads v on the lower layer. *)
Theorem friction_balances : forall w v n,
  (forall u, In u top ->
    n u Alpha + n u Beta + n u Gamma == w u /\
    n u Alpha * x Alpha + n u Beta * x Beta + n u Gamma * x Gamma == 0 /\
    n u Alpha * y Alpha + n u Beta * y Beta + n u Gamma * y Gamma == 0) ->
  let f u d := with_friction (n u d) d in
  equilibrium w v f (from_floor v f).
Proof.
  intros w v n H f. split.
  - intros u U. destruct (H u U) as (W & X & Y). exact (upper_balanced (n u) (w u) W X Y).
  - intros p _.
    set (above d := if member top (fst (up d p)) (snd (up d p)) then n (up d p) d else 0).
    assert (E : forall d, with_friction (above d) d =t= force_above f p d).
    { intros d. unfold above, force_above, f, with_friction.
      destruct (member top (fst (up d p)) (snd (up d p))); open; repeat split; ring. }
    apply (lower_balanced_of_same (fun d => with_friction (above d) d) _ _ _ (v p) E) with
      (2 := lower_balanced above (v p)).
    destruct (E Alpha) as (ax & ay & az), (E Beta) as (bx & by_ & bz), (E Gamma) as (cx & cy & cz).
    unfold from_floor. unfold same_triple. cbn [px py pz].
    cbn [px py pz with_friction] in ax, ay, az, bx, by_, bz, cx, cy, cz.
    rewrite <- ax, <- ay, <- az, <- bx, <- by_, <- bz, <- cx, <- cy, <- cz. repeat split; reflexivity.
Qed.

(** ** Uniqueness *)

Variable per_area : F.
Hypothesis per_area_is : per_area * area == 1.

Lemma cancel : forall c a b, c * a == 1 -> a * b == 0 -> b == 0.
Proof.
  intros c a b C H. transitivity (c * a * b); [rewrite C; ring|].
  transitivity (c * (a * b)); [ring | rewrite H; ring].
Qed.

(** The three sides of the triangle, in order: their sum is 0. *)
Definition a_side : F * F := side Alpha Beta.
Definition b_side : F * F := side Beta Gamma.
Definition c_side : F * F := side Gamma Alpha.

Definition horizontal (f : vec) : F * F := (f.(px), f.(py)).

(** Three horizontal forces at the three points, without sum and moment, are combinations of sides,

      F_alpha = lambda_1 a - lambda_2 c,  F_beta = lambda_3 b - lambda_1 a,  F_gamma = lambda_2 c - lambda_3 b.

    There is one lambda for each two points. Its product with the area is the cross product of one side with the force
    at either point. *)
Definition one_lambda_each (f : direction -> vec) : Prop :=
  cross c_side (horizontal (f Alpha)) == cross b_side (horizontal (f Beta)) /\
  cross b_side (horizontal (f Gamma)) == cross a_side (horizontal (f Alpha)) /\
  cross a_side (horizontal (f Beta)) == cross c_side (horizontal (f Gamma)).

Ltac open_sides := unfold one_lambda_each, a_side, b_side, c_side, horizontal in *; open.

Lemma by_difference : forall a b c, a - b == c -> c == 0 -> a == b.
Proof. intros a b c H K. transitivity (a - b + b); [ring|]. rewrite H, K. ring. Qed.

Lemma one_lambda : forall f : direction -> vec,
  (f Alpha).(px) + (f Beta).(px) + (f Gamma).(px) == 0 ->
  (f Alpha).(py) + (f Beta).(py) + (f Gamma).(py) == 0 ->
  cross (x Alpha, y Alpha) (horizontal (f Alpha)) + cross (x Beta, y Beta) (horizontal (f Beta)) +
    cross (x Gamma, y Gamma) (horizontal (f Gamma)) == 0 ->
  one_lambda_each f.
Proof.
  intros f X Y M.
  assert (V : forall a b, cross (x Alpha, y Alpha) (horizontal (f Alpha)) +
    cross (x Beta, y Beta) (horizontal (f Beta)) + cross (x Gamma, y Gamma) (horizontal (f Gamma))
    - a * ((f Alpha).(py) + (f Beta).(py) + (f Gamma).(py))
    + b * ((f Alpha).(px) + (f Beta).(px) + (f Gamma).(px)) == 0).
  { intros a b. rewrite X, Y, M. ring. }
  repeat split.
  - apply (by_difference _ _ _) with (2 := V (x Gamma) (y Gamma)). open_sides. ring.
  - apply (by_difference _ _ _) with (2 := V (x Beta) (y Beta)). open_sides. ring.
  - apply (by_difference _ _ _) with (2 := V (x Alpha) (y Alpha)). open_sides. ring.
Qed.

(** The combinations of sides, for lambdas of one force each. *)
Theorem lambdas_give_the_forces : forall f, one_lambda_each f ->
  let l1 := per_area * cross c_side (horizontal (f Alpha)) in
  let l2 := per_area * cross a_side (horizontal (f Alpha)) in
  let l3 := per_area * cross a_side (horizontal (f Beta)) in
  let by_sides d c v c' v' := (f d).(px) == c * fst v - c' * fst v' /\ (f d).(py) == c * snd v - c' * snd v' in
  by_sides Alpha l1 a_side l2 c_side /\ by_sides Beta l3 b_side l1 a_side /\ by_sides Gamma l2 c_side l3 b_side.
Proof.
  intros f (H1 & H2 & H3) l1 l2 l3 by_sides. unfold by_sides, l1, l2, l3.
  assert (E : forall p q, per_area * area * p == q -> p == q) by (intros p q <-; rewrite per_area_is; ring).
  repeat split; apply E.
  1-2: open_sides; ring.
  1-2: rewrite H1; open_sides; ring.
  1-2: rewrite <- H2, H3; open_sides; ring.
Qed.

(** Forces in balance at the contacts of an upper sphere are horizontal, with one lambda for each two contacts. *)
Lemma forces_of_upper : forall f, balanced (on_upper f) 0 -> (forall d, (f d).(pz) == 0) /\ one_lambda_each f.
Proof.
  intros f (X & Y & Z & MX & MY & MZ). open.
  assert (X' : (f Alpha).(px) + (f Beta).(px) + (f Gamma).(px) == 0) by (rewrite <- X; ring).
  assert (Y' : (f Alpha).(py) + (f Beta).(py) + (f Gamma).(py) == 0) by (rewrite <- Y; ring).
  assert (Z' : (f Alpha).(pz) + (f Beta).(pz) + (f Gamma).(pz) == 0) by (rewrite <- Z; ring).
  assert (HX : x Alpha * (f Alpha).(pz) + x Beta * (f Beta).(pz) + x Gamma * (f Gamma).(pz) == 0).
  { rewrite <- MY. apply by_difference with (c := - k * ((f Alpha).(px) + (f Beta).(px) + (f Gamma).(px))); [ring|].
    rewrite X'. ring. }
  assert (HY : y Alpha * (f Alpha).(pz) + y Beta * (f Beta).(pz) + y Gamma * (f Gamma).(pz) == 0).
  { apply by_difference with (c := - (- y Alpha * pz (f Alpha) - k * py (f Alpha) +
      (- y Beta * pz (f Beta) - k * py (f Beta) + (- y Gamma * pz (f Gamma) - k * py (f Gamma) + 0)))
      - k * ((f Alpha).(py) + (f Beta).(py) + (f Gamma).(py))); [ring|].
    rewrite Y', MX. ring. }
  split.
  - assert (V : forall a b c,
      a * ((f Alpha).(pz) + (f Beta).(pz) + (f Gamma).(pz))
      + b * (x Alpha * (f Alpha).(pz) + x Beta * (f Beta).(pz) + x Gamma * (f Gamma).(pz))
      + c * (y Alpha * (f Alpha).(pz) + y Beta * (f Beta).(pz) + y Gamma * (f Gamma).(pz)) == 0)
      by (intros; rewrite Z', HX, HY; ring).
    assert (W : area * (f Alpha).(pz) == 0 /\ area * (f Beta).(pz) == 0 /\ area * (f Gamma).(pz) == 0).
    { repeat split.
      - rewrite <- (V (cross (x Beta, y Beta) (x Gamma, y Gamma)) (y Beta - y Gamma) (x Gamma - x Beta)).
        open. ring.
      - rewrite <- (V (cross (x Gamma, y Gamma) (x Alpha, y Alpha)) (y Gamma - y Alpha) (x Alpha - x Gamma)).
        open. ring.
      - rewrite <- (V (cross (x Alpha, y Alpha) (x Beta, y Beta)) (y Alpha - y Beta) (x Beta - x Alpha)).
        open. ring. }
    destruct W as (A & B & C).
    intros []; apply (cancel per_area area _ per_area_is); assumption.
  - apply one_lambda; [exact X' | exact Y' |]. open_sides.
    transitivity (- (- x Alpha * py (f Alpha) - - y Alpha * px (f Alpha) +
      (- x Beta * py (f Beta) - - y Beta * px (f Beta) + (- x Gamma * py (f Gamma) - - y Gamma * px (f Gamma) + 0))));
      [ring | rewrite MZ; ring].
Qed.

(** Horizontal forces in balance at the contacts of a lower sphere have no sum, so the floor needs none. *)
Lemma forces_of_lower : forall f g, balanced (on_lower f g) 0 -> (forall d, (f d).(pz) == 0) ->
  one_lambda_each f /\ g =t= Triple 0 0 0.
Proof.
  intros f g (X & Y & Z & MX & MY & MZ) H. open. rewrite !H in Z, MX, MY.
  assert (X' : (f Alpha).(px) + (f Beta).(px) + (f Gamma).(px) == g.(px))
    by (symmetry; apply (by_difference _ _ _) with (2 := X); ring).
  assert (Y' : (f Alpha).(py) + (f Beta).(py) + (f Gamma).(py) == g.(py))
    by (symmetry; apply (by_difference _ _ _) with (2 := Y); ring).
  assert (GX : g.(px) == 0).
  { apply (cancel tau (k + r) _ tau_is).
    transitivity (k * ((f Alpha).(px) + (f Beta).(px) + (f Gamma).(px)) + r * g.(px)); [rewrite X'; ring|].
    rewrite <- MY. ring. }
  assert (GY : g.(py) == 0).
  { apply (cancel tau (k + r) _ tau_is).
    transitivity (k * ((f Alpha).(py) + (f Beta).(py) + (f Gamma).(py)) + r * g.(py)); [rewrite Y'; ring|].
    match type of MX with ?e == _ => transitivity (- e) end; [ring | rewrite MX; ring]. }
  split; [|repeat split].
  - apply one_lambda; [rewrite X'; exact GX | rewrite Y'; exact GY |]. open_sides.
    match type of MZ with ?e == _ => transitivity (- e) end; [ring | rewrite MZ; ring].
  - exact GX.
  - exact GY.
  - rewrite <- Z. ring.
Qed.

Lemma member_in : forall u, member top (fst u) (snd u) = true <-> In u top.
Proof. intros [i j]. apply member_iff. Qed.

Lemma support_up : forall d p, support sigma (up d p) d = p.
Proof.
  intros d [i j]. unfold up, above_in, support. cbn [fst snd]. destruct (descent sigma d) as [a b]. cbn [fst snd].
  f_equal; ring.
Qed.

Lemma up_support : forall d u, up d (support sigma u d) = u.
Proof.
  intros d [i j]. unfold up, above_in, support. cbn [fst snd]. destruct (descent sigma d) as [a b]. cbn [fst snd].
  f_equal; ring.
Qed.

(** A value that is the same at all spheres of a line of the upper layer is 0, because a finite layer has an end. *)
Lemma lines_end : forall (e : Z * Z -> F) dx dy a b, (a * dx + b * dy = 1)%Z ->
  (forall u, ~ In u top -> e u == 0) -> (forall i j, e (i, j) == e (i + dx, j + dy)%Z) -> forall u, e u == 0.
Proof.
  intros e dx dy a b One Out Step.
  set (height u := (a * fst u + b * snd u)%Z).
  assert (Bound : exists m, forall u, In u top -> (height u <= m)%Z).
  { clear. induction top as [|v rest [m H]].
    - exists 0%Z. intros u [].
    - exists (Z.max (height v) m). intros u [<-|U]; [lia|]. specialize (H u U). lia. }
  destruct Bound as [m Bound].
  assert (Down : forall n u, (m - Z.of_nat n < height u)%Z -> e u == 0).
  { induction n as [|n IH]; intros [i j] H.
    - apply Out. intros U. specialize (Bound _ U). lia.
    - rewrite Step. apply IH. unfold height in *. cbn [fst snd] in *. lia. }
  intros u. apply (Down (Z.to_nat (m - height u + 1))). lia.
Qed.

(** No forces without loads: two layers on a rough floor have no state of self-stress. *)
Theorem no_self_stress : forall f g, equilibrium (fun _ => 0) (fun _ => 0) f g ->
  (forall u d, In u top -> f u d =t= Triple 0 0 0) /\ (forall p, in_base p -> g p =t= Triple 0 0 0).
Proof.
  intros f g [Upper Lower].
  set (f' u d := if member top (fst u) (snd u) then f u d else Triple 0 0 0).
  assert (In' : forall u d, In u top -> f' u d = f u d).
  { intros u d U. unfold f'. apply member_in in U. rewrite U. reflexivity. }
  assert (Out' : forall u d, ~ In u top -> f' u d = Triple 0 0 0).
  { intros u d U. unfold f'. destruct (member top (fst u) (snd u)) eqn:E; [|reflexivity].
    apply member_in in E. contradiction. }
  assert (Above : forall p d, force_above f p d = f' (up d p) d) by reflexivity.
  assert (U : forall u, (forall d, (f' u d).(pz) == 0) /\ one_lambda_each (f' u)).
  { intros u. destruct (member top (fst u) (snd u)) eqn:E.
    - apply member_in in E. specialize (Upper u E). apply forces_of_upper.
      unfold on_upper in *. rewrite !In' by exact E. exact Upper.
    - assert (E' : ~ In u top) by (intros K; apply member_in in K; congruence).
      unfold one_lambda_each. rewrite !Out' by exact E'. split; [|open_sides; repeat split; ring].
      intros d. rewrite Out' by exact E'. reflexivity. }
  assert (L : forall p, one_lambda_each (fun d => f' (up d p) d)).
  { intros p.
    destruct (member top (fst (up Alpha p)) (snd (up Alpha p))) eqn:EA;
      [|destruct (member top (fst (up Beta p)) (snd (up Beta p))) eqn:EB;
        [|destruct (member top (fst (up Gamma p)) (snd (up Gamma p))) eqn:EC]].
    4: { unfold f'. unfold one_lambda_each. rewrite EA, EB, EC. open_sides. repeat split; ring. }
    all: assert (B : in_base p) by
      (first [exists (up Alpha p), Alpha; split; [apply member_in; assumption | symmetry; apply support_up]
             |exists (up Beta p), Beta; split; [apply member_in; assumption | symmetry; apply support_up]
             |exists (up Gamma p), Gamma; split; [apply member_in; assumption | symmetry; apply support_up]]);
      apply (forces_of_lower _ (g p)); [exact (Lower p B) | intros d; apply (U (up d p))]. }
  assert (Run : forall (e : Z * Z -> F) d d', d <> d' -> (forall u, ~ In u top -> e u == 0) ->
    (forall p, e (up d p) == e (up d' p)) -> forall u, e u == 0).
  { intros e d d' D Out Step.
    destruct (descent sigma d) as [di dj] eqn:Ed, (descent sigma d') as [di' dj'] eqn:Ed'.
    assert (St : forall i j, e (i, j) == e (i + (di - di'), j + (dj - dj'))%Z).
    { intros i j. specialize (Step (support sigma (i, j) d)). rewrite up_support in Step. rewrite Step.
      unfold up, above_in, support. cbn [fst snd]. rewrite Ed, Ed'. cbn [fst snd].
      replace (i + di - di')%Z with (i + (di - di'))%Z by ring.
      replace (j + dj - dj')%Z with (j + (dj - dj'))%Z by ring.
      reflexivity. }
    assert (C : exists a b, (a * (di - di') + b * (dj - dj') = 1)%Z).
    { destruct sigma, d, d'; try congruence; cbv in Ed, Ed'; injection Ed as <- <-; injection Ed' as <- <-;
        first [exists 1%Z, 0%Z; reflexivity | exists (-1)%Z, 0%Z; reflexivity
              |exists 0%Z, 1%Z; reflexivity | exists 0%Z, (-1)%Z; reflexivity]. }
    destruct C as (a & b & C). exact (lines_end e _ _ a b C Out St). }
  assert (Zero : forall v u d, ~ In u top -> cross v (horizontal (f' u d)) == 0).
  { intros v u d K. rewrite Out' by exact K. open_sides. ring. }
  assert (L1 : forall u, cross c_side (horizontal (f' u Alpha)) == 0).
  { apply (Run _ Alpha Beta); [discriminate | intros; apply Zero; assumption |].
    intros p. destruct (L p) as (H & _ & _). rewrite H. symmetry. apply (U (up Beta p)). }
  assert (L2 : forall u, cross a_side (horizontal (f' u Alpha)) == 0).
  { apply (Run _ Alpha Gamma); [discriminate | intros; apply Zero; assumption |].
    intros p. destruct (L p) as (_ & H & _). rewrite <- H. apply (U (up Gamma p)). }
  assert (L3 : forall u, cross a_side (horizontal (f' u Beta)) == 0).
  { apply (Run _ Beta Gamma); [discriminate | intros; apply Zero; assumption |].
    intros p. destruct (L p) as (_ & _ & H). rewrite H. symmetry. apply (U (up Gamma p)). }
  assert (All : forall u d, f' u d =t= Triple 0 0 0).
  { intros u. destruct (U u) as [V H].
    destruct (lambdas_give_the_forces _ H) as ((ax & ay) & (bx & by_) & (cx & cy)).
    rewrite !L1, !L2 in ax, ay. rewrite !L1, !L3 in bx, by_. rewrite !L2, !L3 in cx, cy.
    intros []; repeat split; try apply V; cbn [px py];
      (rewrite ax || rewrite ay || rewrite bx || rewrite by_ || rewrite cx || rewrite cy); ring. }
  split.
  - intros u d K. rewrite <- In' by exact K. apply All.
  - intros p B. apply (forces_of_lower (force_above f p) (g p)); [exact (Lower p B) | intros d; apply (All (up d p))].
Qed.

Ltac by_two H H' :=
  match type of H with ?e == _ => match type of H' with ?e' == _ =>
    transitivity (e - e'); [ring | rewrite H, H'; ring] end end.

(** The difference of forces in balance with the same load balances no load. *)
Lemma upper_difference : forall f f' w, balanced (on_upper f) w -> balanced (on_upper f') w ->
  balanced (on_upper (fun d => minus_triple (f d) (f' d))) 0.
Proof.
  intros f f' w (a & b & c & d & e & h) (a' & b' & c' & d' & e' & h'). open.
  split; [by_two a a'|]. split; [by_two b b'|]. split; [by_two c c'|].
  split; [by_two d d'|]. split; [by_two e e' | by_two h h'].
Qed.

Lemma lower_difference : forall f f' g g' v, balanced (on_lower f g) v -> balanced (on_lower f' g') v ->
  balanced (on_lower (fun d => minus_triple (f d) (f' d)) (minus_triple g g')) 0.
Proof.
  intros f f' g g' v (a & b & c & d & e & h) (a' & b' & c' & d' & e' & h'). open.
  split; [by_two a a'|]. split; [by_two b b'|]. split; [by_two c c'|].
  split; [by_two d d'|]. split; [by_two e e' | by_two h h'].
Qed.

Lemma minus_is_0 : forall v v', minus_triple v v' =t= Triple 0 0 0 -> v =t= v'.
Proof.
  intros v v' (X & Y & Z). open. repeat split.
  - apply (by_difference _ _ _) with (2 := X). reflexivity.
  - apply (by_difference _ _ _) with (2 := Y). reflexivity.
  - apply (by_difference _ _ _) with (2 := Z). reflexivity.
Qed.

(** So the forces of two layers are unique, under any vertical loads. *)
Theorem forces_are_unique : forall w v f g f' g',
  equilibrium w v f g -> equilibrium w v f' g' ->
  (forall u d, In u top -> f u d =t= f' u d) /\ (forall p, in_base p -> g p =t= g' p).
Proof.
  intros w v f g f' g' [U L] [U' L'].
  destruct (no_self_stress (fun u d => minus_triple (f u d) (f' u d)) (fun p => minus_triple (g p) (g' p))) as [A C].
  - split.
    + intros u I. exact (upper_difference _ _ _ (U u I) (U' u I)).
    + intros p I. refine (lower_balanced_of_same _ _ _ _ _ _ _ (lower_difference _ _ _ _ _ (L p I) (L' p I))).
      * intros d. unfold force_above. destruct (member top (fst (up d p)) (snd (up d p))); open; repeat split; ring.
      * repeat split; reflexivity.
  - split; intros; apply minus_is_0; [apply A | apply C]; assumption.
Qed.

(** Equal forces stay in balance. *)
Lemma equilibrium_of_same : forall w v f g f' g',
  (forall u d, In u top -> f u d =t= f' u d) -> (forall p, in_base p -> g p =t= g' p) ->
  equilibrium w v f g -> equilibrium w v f' g'.
Proof.
  intros w v f g f' g' H K [U L]. split.
  - intros u I. specialize (U u I).
    destruct (H u Alpha I) as (ax & ay & az), (H u Beta I) as (bx & by_ & bz), (H u Gamma I) as (cx & cy & cz).
    open. rewrite ax, ay, az, bx, by_, bz, cx, cy, cz in U. exact U.
  - intros p I. apply (lower_balanced_of_same _ _ _ _ (v p)) with (3 := L p I); [|exact (K p I)].
    intros d. unfold force_above. destruct (member top (fst (up d p)) (snd (up d p))) eqn:E.
    + apply H. apply member_in. exact E.
    + repeat split; reflexivity.
Qed.

(** Exactly the forces with N along the contacts and N tan(theta/2) across them are in equilibrium. *)
Theorem equilibrium_is_friction : forall w v n,
  (forall u, In u top ->
    n u Alpha + n u Beta + n u Gamma == w u /\
    n u Alpha * x Alpha + n u Beta * x Beta + n u Gamma * x Gamma == 0 /\
    n u Alpha * y Alpha + n u Beta * y Beta + n u Gamma * y Gamma == 0) ->
  forall f g,
  let found u d := with_friction (n u d) d in
  equilibrium w v f g <->
  (forall u d, In u top -> f u d =t= found u d) /\ (forall p, in_base p -> g p =t= from_floor v found p).
Proof.
  intros w v n H f g found. assert (E := friction_balances w v n H). split.
  - intros B. exact (forces_are_unique w v f g _ _ B E).
  - intros [A B]. refine (equilibrium_of_same w v _ _ f g _ _ E); intros;
      apply same_triple_symmetric; [apply A | apply B]; assumption.
Qed.

(** ** Discs

    A row of discs: the contacts of an upper disc are at (-x, 0, k) in direction [Alpha] and at (x, 0, k) in direction
    [Beta], and all forces are in the vertical plane y = 0. Each row j of the sites (i, j) is a pile of its own. *)
Variable half_width per_width : F.
Hypothesis per_width_is : per_width * (half_width + half_width) == 1.

Definition on_upper_disc (f : direction -> vec) : list (vec * vec) :=
  [(Triple (- half_width) 0 k, f Alpha); (Triple half_width 0 k, f Beta)].

Definition on_lower_disc (f : direction -> vec) (g : vec) : list (vec * vec) :=
  [(Triple half_width 0 (- k), reaction (f Alpha)); (Triple (- half_width) 0 (- k), reaction (f Beta)); (on_floor, g)].

Definition in_disc_base (p : Z * Z) : Prop := exists u d, In u top /\ d <> Gamma /\ p = support sigma u d.

Definition in_plane (v : vec) : Prop := v.(py) == 0.

Definition disc_equilibrium (w v : Z * Z -> F) (f : Z * Z -> direction -> vec) (g : Z * Z -> vec) : Prop :=
  (forall u, In u top -> in_plane (f u Alpha) /\ in_plane (f u Beta) /\ balanced (on_upper_disc (f u)) (w u)) /\
  (forall p, in_disc_base p -> in_plane (g p) /\ balanced (on_lower_disc (force_above f p) (g p)) (v p)).

Ltac open_discs := unfold on_upper_disc, on_lower_disc, in_plane in *; open.

Theorem discs_have_no_self_stress : forall f g, disc_equilibrium (fun _ => 0) (fun _ => 0) f g ->
  (forall u d, In u top -> d <> Gamma -> f u d =t= Triple 0 0 0) /\
  (forall p, in_disc_base p -> g p =t= Triple 0 0 0).
Proof.
  intros f g [Upper Lower].
  assert (U : forall u, In u top ->
    (f u Alpha).(pz) == 0 /\ (f u Beta).(pz) == 0 /\ (f u Beta).(px) == - (f u Alpha).(px)).
  { intros u I. destruct (Upper u I) as (_ & _ & X & _ & Z & _ & MY & _). open_discs.
    assert (A : (half_width + half_width) * (f u Alpha).(pz) == 0).
    { match type of X with ?x == _ => match type of Z with ?z == _ => match type of MY with ?m == _ =>
        transitivity (m - k * x + half_width * z) end end end; [ring | rewrite X, Z, MY; ring]. }
    apply (cancel per_width _ _ per_width_is) in A. rewrite A in Z.
    split; [exact A|]. split.
    - rewrite <- Z. ring.
    - match type of X with ?x == _ => transitivity (x - (f u Alpha).(px)) end; [ring | rewrite X; ring]. }
  assert (L : forall p, in_disc_base p ->
    (force_above f p Alpha).(px) + (force_above f p Beta).(px) == 0 /\ g p =t= Triple 0 0 0).
  { intros p I. destruct (Lower p I) as (P & X & _ & Z & _ & MY & _). open_discs.
    assert (V : forall d, d <> Gamma -> (force_above f p d).(pz) == 0).
    { intros d D. unfold force_above. destruct (member top (fst (up d p)) (snd (up d p))) eqn:E; [|reflexivity].
      apply member_in in E. destruct (U _ E) as (A & B & _). destruct d; [exact A | exact B | congruence]. }
    assert (VA := V Alpha ltac:(discriminate)). assert (VB := V Beta ltac:(discriminate)).
    rewrite VA, VB in Z, MY.
    assert (S : (force_above f p Alpha).(px) + (force_above f p Beta).(px) == (g p).(px)).
    { symmetry. match type of X with ?x == _ => apply (by_difference _ _ x); [ring | exact X] end. }
    assert (G : (g p).(px) == 0).
    { apply (cancel tau (k + r) _ tau_is).
      transitivity (k * ((force_above f p Alpha).(px) + (force_above f p Beta).(px)) + r * (g p).(px));
        [rewrite S; ring|].
      rewrite <- MY. ring. }
    split; [rewrite S; exact G|]. split; [exact G|]. split; [exact P|]. rewrite <- Z. cbn [pz]. ring. }
  set (e u := if member top (fst u) (snd u) then (f u Alpha).(px) else 0).
  assert (One : exists a b, let '(di, dj) := descent sigma Beta in (a * - di + b * - dj = 1)%Z).
  { destruct sigma; [exists (-1)%Z, 0%Z | exists 1%Z, 0%Z]; reflexivity. }
  assert (X : forall u, e u == 0).
  { destruct One as (a & b & One). destruct (descent sigma Beta) as [di dj] eqn:D.
    assert (D' : descent sigma Alpha = (0, 0)%Z) by (destruct sigma; reflexivity).
    apply (lines_end e _ _ _ _ One).
    - intros u N. unfold e. destruct (member top (fst u) (snd u)) eqn:E; [|reflexivity].
      apply member_in in E. contradiction.
    - intros i j.
      assert (Ua : up Alpha (i, j) = (i, j)).
      { unfold up, above_in. rewrite D'. cbn [fst snd]. f_equal; ring. }
      assert (Ub : up Beta (i, j) = (i + - di, j + - dj)%Z).
      { unfold up, above_in. rewrite D. cbn [fst snd]. f_equal; ring. }
      assert (Sum : (force_above f (i, j) Alpha).(px) == e (i, j)).
      { unfold force_above, e. rewrite Ua. cbn [fst snd]. destruct (member top i j); reflexivity. }
      assert (Sum' : (force_above f (i, j) Beta).(px) == - e (i + - di, j + - dj)%Z).
      { unfold force_above, e. rewrite Ub. cbn [fst snd]. destruct (member top (i + - di) (j + - dj)) eqn:E.
        - apply (U (_, _)). apply member_in. exact E.
        - cbn [px]. ring. }
      destruct (member top i j) eqn:A; [|destruct (member top (i + - di) (j + - dj)) eqn:B].
      3: { unfold e. cbn [fst snd]. rewrite A, B. reflexivity. }
      all: assert (I : in_disc_base (i, j)) by
        (first [exists (up Alpha (i, j)), Alpha;
                  split; [apply member_in; rewrite Ua; exact A | split; [discriminate | symmetry; apply support_up]]
               |exists (up Beta (i, j)), Beta;
                  split; [apply member_in; rewrite Ub; exact B | split; [discriminate | symmetry; apply support_up]]]);
        destruct (L _ I) as [H _]; rewrite Sum, Sum' in H; apply (by_difference _ _ _) with (2 := H); ring. }
  split; [|intros p I; apply (L p I)].
  intros u d I D. destruct (U u I) as (A & B & C). destruct (Upper u I) as (PA & PB & _).
  assert (E := X u). unfold e in E. assert (M := I). apply member_in in M. rewrite M in E.
  destruct d; [| |congruence]; (split; [|split; [assumption | assumption]]).
  - exact E.
  - rewrite C, E. cbn [px]. ring.
Qed.

Theorem forces_of_discs_are_unique : forall w v f g f' g',
  disc_equilibrium w v f g -> disc_equilibrium w v f' g' ->
  (forall u d, In u top -> d <> Gamma -> f u d =t= f' u d) /\ (forall p, in_disc_base p -> g p =t= g' p).
Proof.
  intros w v f g f' g' [U L] [U' L'].
  destruct (discs_have_no_self_stress (fun u d => minus_triple (f u d) (f' u d)) (fun p => minus_triple (g p) (g' p)))
    as [A C].
  - split.
    + intros u I. destruct (U u I) as (p & q & a & b & c & d & e & h).
      destruct (U' u I) as (p' & q' & a' & b' & c' & d' & e' & h').
      open_discs. split; [by_two p p'|]. split; [by_two q q'|].
      split; [by_two a a'|]. split; [by_two b b'|]. split; [by_two c c'|].
      split; [by_two d d'|]. split; [by_two e e' | by_two h h'].
    + intros p I. destruct (L p I) as (q & a & b & c & d & e & h), (L' p I) as (q' & a' & b' & c' & d' & e' & h').
      assert (E : forall d, force_above (fun u d => minus_triple (f u d) (f' u d)) p d =t=
        minus_triple (force_above f p d) (force_above f' p d)).
      { intros d0. unfold force_above.
        destruct (member top (fst (up d0 p)) (snd (up d0 p))); open; repeat split; ring. }
      destruct (E Alpha) as (ax & ay & az), (E Beta) as (bx & by_ & bz).
      open_discs. rewrite ax, ay, az, bx, by_, bz. clear ax ay az bx by_ bz E.
      split; [by_two q q'|].
      split; [by_two a a'|]. split; [by_two b b'|]. split; [by_two c c'|].
      split; [by_two d d'|]. split; [by_two e e' | by_two h h'].
  - split; intros; apply minus_is_0; [apply A | apply C]; assumption.
Qed.

(** Half of the load along each contact, and the same across it times tan(theta/2). *)
Theorem friction_balances_discs : forall w v n,
  (forall u, In u top -> n u Alpha + n u Beta == w u /\ n u Alpha == n u Beta) ->
  let f u d := match d with
    | Alpha => Triple (tau * (n u Alpha * half_width)) 0 (- n u Alpha)
    | Beta => Triple (- (tau * (n u Beta * half_width))) 0 (- n u Beta)
    | Gamma => Triple 0 0 0 end in
  disc_equilibrium w v f (from_floor v f).
Proof.
  intros w v n H f. split.
  - intros u U. destruct (H u U) as [W E]. unfold f. open_discs. rewrite <- W, E. repeat split; ring.
  - intros p _.
    set (above d := if member top (fst (up d p)) (snd (up d p)) then n (up d p) d else 0).
    assert (A : force_above f p Alpha =t= Triple (tau * (above Alpha * half_width)) 0 (- above Alpha)).
    { unfold above, force_above, f.
      destruct (member top (fst (up Alpha p)) (snd (up Alpha p))); open; repeat split; ring. }
    assert (B : force_above f p Beta =t= Triple (- (tau * (above Beta * half_width))) 0 (- above Beta)).
    { unfold above, force_above, f.
      destruct (member top (fst (up Beta p)) (snd (up Beta p))); open; repeat split; ring. }
    assert (C : force_above f p Gamma =t= Triple 0 0 0).
    { unfold force_above, f. destruct (member top (fst (up Gamma p)) (snd (up Gamma p))); repeat split; reflexivity. }
    destruct A as (ax & ay & az), B as (bx & by_ & bz), C as (cx & cy & cz). unfold from_floor. open_discs.
    rewrite ax, ay, az, bx, by_, bz, cx, cy, cz. repeat split; try ring.
    transitivity ((above Alpha - above Beta) * half_width * (tau * (k + r) - 1)); [ring | rewrite tau_is; ring].
Qed.

End Numbers.

(** ** The recorded formulas, over rationals *)

Open Scope Q_scope.

Definition rational (v : triple Q) (a b c : Q) : Prop := px v == a /\ py v == b /\ pz v == c.

(** The contact directions of the library, from a support to the sphere above it, under steps of either sign. *)
Definition e_x (s : Q) (sigma : sign) (d : direction) : Q := along_x (on d (directions_under s sigma)).
Definition e_y (s : Q) (sigma : sign) (d : direction) : Q := along_y (on d (directions_under s sigma)).

(** rho = 1/cos theta is the radius in the unit R cos theta, so tau = 1/(1 + rho) = cos theta/(1 + cos theta). *)
Definition rough_equilibrium (s rho : Q) (top : list (Z * Z)) (sigma : sign) :=
  equilibrium Q 0 Qplus Qmult Qminus Qopp Qeq (e_x s sigma) (e_y s sigma) 1 rho top sigma.

Lemma rational_congruence : ring_eq_ext Qplus Qmult Qopp Qeq.
Proof. split; [exact Qplus_comp | exact Qmult_comp | exact Qopp_comp]. Qed.

(** The numbers f of the contacts above a lower sphere, from the loads n of the upper layer. *)
Definition numbers_above (s : Q) (top : list (Z * Z)) (sigma : sign) (n : Z * Z -> Q) (p : Z * Z) : three Q :=
  let from d := let (a, b) := above_in sigma d (fst p) (snd p) in
    if member top a b then force (n (a, b)) (on d (increments s)) else 0 in
  Three (from Alpha) (from Beta) (from Gamma).

(** Two layers of weights n and m, in mg, under steps of either sign on an isosceles base. With the numbers f of the
    pile without friction, n times the increments, the only forces in equilibrium have the vertical parts f and the
    horizontal parts tau f. The floor carries the vertical part of the recorded load on the supports, and tau times its
    horizontal part. *)
Theorem rough_floor : forall s rho top sigma n m f g, ~ 1 + s == 0 -> ~ 1 + rho == 0 ->
  let tau := / (1 + rho) in
  let mg := weight (increments s) in
  let number u d := force (n u) (on d (increments s)) in
  rough_equilibrium s rho top sigma (fun u => force (n u) mg) (fun p => force (m p) mg) f g
  <->
  (forall u d, In u top ->
    rational (f u d) (tau * (number u d * e_x s sigma d)) (tau * (number u d * e_y s sigma d)) (- number u d)) /\
  (forall p, in_base top sigma p ->
    let load := support_load (numbers_above s top sigma n p) (directions_under s sigma) (force (m p) mg) in
    rational (g p) (- (tau * along_x load)) (- (tau * along_y load)) (- along_z load)).
Proof.
  intros s rho top sigma n m f g Hs Hr tau mg number.
  assert (T : tau * (1 + rho) == 1) by (unfold tau; field; exact Hr).
  assert (A : (- / (1 + s)) * area Q Qmult Qminus (e_x s sigma) (e_y s sigma) == 1).
  { unfold area, cross, side, e_x, e_y, directions_under. destruct sigma; cbn; field; exact Hs. }
  assert (H : forall u, In u top ->
    number u Alpha + number u Beta + number u Gamma == force (n u) mg /\
    number u Alpha * e_x s sigma Alpha + number u Beta * e_x s sigma Beta + number u Gamma * e_x s sigma Gamma == 0 /\
    number u Alpha * e_y s sigma Alpha + number u Beta * e_y s sigma Beta + number u Gamma * e_y s sigma Gamma == 0).
  { intros u _. unfold number, mg, e_x, e_y, directions_under. destruct sigma; repeat split; formulas; ring. }
  assert (E := equilibrium_is_friction Q 0 1 Qplus Qmult Qminus Qopp Qeq Q_Setoid rational_congruence Qsrt
    (e_x s sigma) (e_y s sigma) 1 rho top sigma tau T _ A _ (fun p => force (m p) mg) number H f g).
  cbv zeta in E. unfold rough_equilibrium. rewrite E. clear E.
  assert (Floor : forall p,
    let load := support_load (numbers_above s top sigma n p) (directions_under s sigma) (force (m p) mg) in
    let g' := from_floor Q 0 Qplus Qminus top sigma (fun p => force (m p) mg)
      (fun u d => with_friction Q Qmult Qopp (e_x s sigma) (e_y s sigma) tau (number u d) d) p in
    rational g' (- (tau * along_x load)) (- (tau * along_y load)) (- along_z load)).
  { intros p. cbv zeta. unfold from_floor, force_above, numbers_above, up.
    destruct (above_in sigma Alpha (fst p) (snd p)) as [a1 a2], (above_in sigma Beta (fst p) (snd p)) as [b1 b2],
      (above_in sigma Gamma (fst p) (snd p)) as [c1 c2]. cbn [fst snd].
    unfold rational, with_friction, number, e_x, e_y, directions_under. cbn [px py pz].
    destruct sigma, (member top a1 a2), (member top b1 b2), (member top c1 c2); cbn [px py pz];
      repeat split; formulas; ring. }
  split; intros [U P]; (split; [exact U | intros p B; specialize (P p B); specialize (Floor p)]);
    cbv zeta in Floor |- *; destruct P as (X & Y & Z), Floor as (X' & Y' & Z').
  - repeat split; etransitivity; eassumption.
  - repeat split; (etransitivity; [eassumption | symmetry; assumption]).
Qed.
