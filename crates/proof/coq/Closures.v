(** The closures of the stress of a sphere: relations among its components that follow from the slope of its contacts and
    from its balance. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lqa.
From Cannonpile Require Import Directions Sums Formulas Balance Horizontal Response.

Open Scope Q_scope.

(** The sum of f times a product of components over three contacts. *)
Definition stress (f : three Q) (e : three vector) (of : vector -> Q) : Q := sum (by_line Qmult f (map of e)).

(** Components in the units of [Forces::stress]: z points up, and on an isosceles base yy has the factor 4 cos^2 phi. *)
Definition xx (v : vector) : Q := v.(along_x) * v.(along_x).
Definition yy (s : Q) (v : vector) : Q := 4 * (1 - s * s) * (v.(along_y) * v.(along_y)).
Definition zz (v : vector) : Q := v.(along_z) * v.(along_z).
Definition xy (v : vector) : Q := v.(along_x) * v.(along_y).
Definition xz (v : vector) : Q := - (v.(along_x) * v.(along_z)).
Definition yz (v : vector) : Q := - (v.(along_y) * v.(along_z)).

(** The sign as a number. *)
Definition value (sigma : sign) : Q := match sigma with Plus => 1 | Minus => -1 end.

Ltac stresses := unfold stress, xx, yy, zz, xy, xz, yz, value, directions_under, opposite, transferred; formulas.

(** The primary closure: the slope of a contact does not depend on its direction. *)
Theorem primary_closure : forall s sigma f,
  let e := directions_under s sigma in
  stress f e xx + stress f e (yy s) == stress f e zz.
Proof. intros s [] []; cbv zeta; stresses; ring. Qed.

Theorem primary_closure_of_discs : forall a b,
  stress (Three a b 0) disc_directions xx == stress (Three a b 0) disc_directions zz /\
  stress (Three a b 0) disc_directions (yy 0) == 0.
Proof. intros a b; stresses; split; ring. Qed.

(** The secondary closure of steps of one sign. *)
Theorem secondary_closure : forall s sigma f,
  let e := directions_under s sigma in
  stress f e xy == value sigma * s * stress f e yz /\
  stress f e xx == s * stress f e zz - value sigma * (1 - s) * stress f e xz.
Proof. intros s [] []; cbv zeta; stresses; split; ring. Qed.

(** The secondary closure of any stacking: a sphere in balance without a horizontal load, below a step of one sign and
    above a step of the same or the other sign, whatever its forces. *)
Theorem secondary_closure_of_stackings : forall from to w down up,
  let over := directions_under (1 # 2) from in
  let below := directions_under (1 # 2) to in
  let all of := stress down over of + stress up below of in
  unbalanced up below down over w =v= nothing ->
  2 * (all xx - all (yy (1 # 2))) == - (value from + value to) * all xz /\
  4 * all xy == (value from + value to) * all yz.
Proof.
  intros from to w [a b c] [x y z]. cbv zeta. intros H.
  destruct from, to; unfold directions_under in H; formulas_in H; destruct H as (Hx & Hy & _).
  1, 4: stresses; split; ring.
  all: assert (Y : y == x + a - b) by lra; assert (Z : z == x + a - c) by lra; stresses; split; rewrite Z, Y; ring.
Qed.

(** At a sign change the stress has no preferred horizontal direction. *)
Theorem isotropic_at_a_sign_change : forall from w down up,
  let over := directions_under (1 # 2) from in
  let below := directions_under (1 # 2) (opposite from) in
  let all of := stress down over of + stress up below of in
  unbalanced up below down over w =v= nothing -> all xx == all (yy (1 # 2)) /\ all xy == 0.
Proof.
  intros from w down up. cbv zeta. intros H.
  destruct (secondary_closure_of_stackings from (opposite from) w down up H) as [A B].
  assert (E : value from + value (opposite from) == 0) by (destruct from; reflexivity). rewrite E in A, B.
  ring_simplify in A. ring_simplify in B. split; lra.
Qed.

(** The mean over the next sign: f under +, Gf under -. *)
Theorem mean_closure_below : forall f,
  let mean of := (stress f (directions_under (1 # 2) Plus) of
    + stress (half_turn f) (directions_under (1 # 2) Minus) of) / 2 in
  mean xx == mean (yy (1 # 2)) /\ mean xy == 0 /\ 2 * mean xx == mean zz.
Proof. intros []; cbv zeta; stresses; repeat split; field. Qed.

Theorem load_under_the_other_sign : forall load,
  load_increments load (1 # 2) Minus =3= half_turn (load_increments load (1 # 2) Plus).
Proof. intros []. by_components. Qed.

(** The mean force along a line from above: g is received at -u, and k, in the form of a + step, at +u. *)
Theorem mean_closure_above : forall l g k,
  let h axis f := stress f (Three (down_by Plus Alpha) (down_by Plus Beta) (down_by Plus Gamma)) axis in
  let u := down_by Plus l in
  (on l g + on l (half_turn k)) / 2 == (sum g + sum k) / 6
    + (u.(along_x) * (h along_x g - h along_x k) + 3 * u.(along_y) * (h along_y g - h along_y k)) / 3.
Proof. intros [] [] []; cbv zeta; unfold stress, down_by, one_on, directions_under; formulas; field. Qed.
