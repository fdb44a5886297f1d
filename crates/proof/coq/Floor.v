(** The reaction at the base of the straight pile: pressure, weight, shear and their moments, for every L. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa.
From Cannonpile Require Import Directions Sums Formulas Balance Straight.

Open Scope Q_scope.

(** The force of bottom sphere (i, j) of L layers on the floor, (11) to (14), in f0. *)
Definition on_floor (s L i j : Q) : vector :=
  support_load (brought s i j (L - 1)) (directions s) (weight (increments s)).

(** The normal force, in mg. *)
Definition normal (s L i j : Q) : Q := (on_floor s L i j).(along_z) / weight (increments s).

(** Any forces that balance all spheres have this force on the floor. *)
Theorem on_floor_is_what_arrives : forall s f L i j, ~ 1 + s == 0 ->
  (forall k a b, (k < L)%nat -> occupied k a b = true -> balanced s f k a b) ->
  occupied L i j = true ->
  support_load (received f L i j) (directions s) (weight (increments s)) =v= on_floor s (n_of (S L)) (q i) (q j).
Proof.
  intros s f L i j Hs Hf Ho.
  assert (R : received f L i j =3= brought s (q i) (q j) (n_of L)).
  { apply received_of_closed_form; [assumption|].
    rewrite closed_form_is_the_only_solution in Hf by assumption. intros. apply Hf; assumption. }
  destruct R as (a & b & c).
  unfold on_floor. unfold brought in *. formulas_in a. formulas_in b. formulas_in c.
  destruct (received f L i j) as [x y z]. formulas. cbn in a, b, c. rewrite n_of_S.
  repeat split; (rewrite a, b, c || idtac); ring.
Qed.

(** The normal force is mg[1 + ((L-1-j) + 2sj) / (2(1+s))], which is linear in j. *)
Theorem base_normal : forall s L i j,
  (on_floor s L i j).(along_z) == 2 * (1 + s) + (L - 1 - j) + 2 * s * j.
Proof. intros. unfold on_floor, brought. formulas. ring. Qed.

(** The normal force is mg(L+2)/3 under every sphere of an equilateral base. *)
Theorem base_normal_equilateral : forall L i j, normal (1 # 2) L i j == (L + 2) / 3.
Proof. intros. unfold normal. rewrite base_normal. formulas. field. Qed.

(** The difference of two normal forces is (2s-1)(j-j') increments. *)
Theorem difference_of_normals : forall s L i j a b,
  (on_floor s L i j).(along_z) - (on_floor s L a b).(along_z) == (2 * s - 1) * (j - b).
Proof. intros. unfold on_floor, brought. formulas. ring. Qed.

Lemma same_quotient : forall a b w, ~ w == 0 -> (a / w == b / w <-> a == b).
Proof.
  intros a b w W. split; intros H.
  - transitivity (a / w * w); [field; assumption|].
    transitivity (b / w * w); [apply Qmult_comp; [exact H | reflexivity] | field; assumption].
  - apply Qmult_comp; [exact H | reflexivity].
Qed.

(** The pressure on the floor is uniform if and only if sin phi = 1/2. *)
Theorem uniform_if_and_only_if : forall s L, 0 < s -> (2 <= L)%nat ->
  ((forall i j a b, occupied (L - 1) i j = true -> occupied (L - 1) a b = true ->
      normal s (n_of L) (q i) (q j) == normal s (n_of L) (q a) (q b))
   <-> s == 1 # 2).
Proof.
  intros s L Hs HL. assert (W : ~ weight (increments s) == 0) by (formulas; intro; lra).
  split.
  - intros H. specialize (H 0%Z 0%Z 0%Z 1%Z).
    assert (A : occupied (L - 1) 0 0 = true) by (apply occupied_iff; lia).
    assert (B : occupied (L - 1) 0 1 = true) by (apply occupied_iff; lia).
    specialize (H A B). apply same_quotient in H; [|assumption].
    assert (D := difference_of_normals s (n_of L) (q 0) (q 0) (q 0) (q 1)).
    change (q 0) with 0 in *. change (q 1) with 1 in *. lra.
  - intros E i j a b _ _. apply same_quotient; [assumption|].
    assert (D := difference_of_normals s (n_of L) (q i) (q j) (q a) (q b)).
    assert (Z : (2 * s - 1) * (q j - q b) == 0).
    { transitivity (0 * (q j - q b)); [apply Qmult_comp; [lra | reflexivity] | ring]. }
    lra.
Qed.

(** ** Sums over the base and the pile *)

Ltac opened := unfold on_floor, brought, normal; formulas.

(** Conditions of a closed form: it respects equality, is 0 at 0, and its differences are the terms. *)
Ltac closed :=
  intros; match goal with
          | |- respects _ => intros ? ? ?; cbv beta; congruent
          | _ => opened; ring
          end.

(** A sum over a layer, from the sums of its rows and of the preceding rows. *)
Ltac over_layer R S := etransitivity; [apply (total_over_layer_is _ R S); closed|].

(** A sum over layers, from the sum of each layer. *)
Ltac over_pile R S U T :=
  etransitivity;
  [apply (total_over_pile_is _ U T); [let m := fresh "m" in intros m; over_layer (R (n_of m)) (S (n_of m)); closed | closed | closed | closed]|].

(** The number of spheres: the sum of 1. *)
Theorem spheres_in_a_layer : forall k, total_over_layer k (fun _ _ => 1) == spheres_in_layer_3 (n_of k).
Proof.
  intros k.
  over_layer (fun j x : Q => x) (fun y => (2 * n_of k * y - y * y + 3 * y) * (1 # 2)). closed.
Qed.

Theorem spheres_of_a_pile : forall L, total_over_pile L (fun _ _ _ => 1) == spheres_3 (n_of L).
Proof.
  intros L.
  over_pile (fun k j x : Q => x) (fun k y => (2 * k * y - y * y + 3 * y) * (1 # 2))
    spheres_in_layer_3 (fun x => (x * x * x + 3 * x * x + 2 * x) * (1 # 6)). closed.
Qed.

(** There are (k+1)(k+2)/2 spheres in layer k, and L(L+1)(L+2)/6 in all. *)
Theorem spheres_of_a_layer_are : forall k, total_over_layer k (fun _ _ => 1) == (n_of k + 1) * (n_of k + 2) / 2.
Proof. intros k. rewrite spheres_in_a_layer. formulas. field. Qed.

Theorem spheres_are : forall L, total_over_pile L (fun _ _ _ => 1) == n_of L * (n_of L + 1) * (n_of L + 2) / 6.
Proof. intros L. rewrite spheres_of_a_pile. formulas. field. Qed.

(** ** The base carries the weight

    The base is layer k = L-1, so L = k + 1. *)

(** The weight of all spheres, each of weight W, in f0 cos theta. *)
Definition weight_of_pile (s : Q) (L : nat) : Q := total_over_pile L (fun _ _ _ => weight (increments s)).

Lemma weight_of_pile_is : forall s L, weight_of_pile s L == spheres_3 (n_of L) * weight (increments s).
Proof.
  intros s L. unfold weight_of_pile.
  over_pile (fun k j x : Q => 2 * (1 + s) * x) (fun k y => 2 * (1 + s) * ((2 * k * y - y * y + 3 * y) * (1 # 2)))
    (fun k => 2 * (1 + s) * spheres_in_layer_3 k) (fun x => 2 * (1 + s) * (x * x * x + 3 * x * x + 2 * x) * (1 # 6)).
  closed.
Qed.

(** The normal forces on the floor sum to the weight of all spheres, for every s and every L. *)
Theorem the_weight_arrives : forall s k,
  total_over_layer k (fun i j => (on_floor s (n_of k + 1) i j).(along_z)) == weight_of_pile s (S k).
Proof.
  intros s k. rewrite weight_of_pile_is.
  over_layer
    (fun j x => 2 * j * s * x - j * x + n_of k * x + 2 * s * x + 2 * x)
    (fun y => (3 * n_of k * n_of k * y + 3 * n_of k * s * y * y + 3 * n_of k * s * y - 3 * n_of k * y * y
       + 12 * n_of k * y - 2 * s * y * y * y + 3 * s * y * y + 5 * s * y + y * y * y - 6 * y * y + 11 * y) * (1 # 3)).
  transitivity (spheres_3 (n_of k + 1) * weight (increments s)); [closed|].
  apply Qmult_comp; [|reflexivity]. unfold spheres_3. rewrite n_of_S. reflexivity.
Qed.

(** ** Shear *)

(** The shear is -(L-1-3j)/2 along x and -sqrt(3)/2 (L-1-2i-j) along y, in f0 sin theta, on an equilateral base. *)
Theorem shear : forall L i j,
  (on_floor (1 # 2) L i j).(along_x) == (3 * j - (L - 1)) * (1 # 2) /\
  (on_floor (1 # 2) L i j).(along_y) == (2 * i + j - (L - 1)) * (1 # 2).
Proof. intros. opened. split; ring. Qed.

(** The horizontal forces on the floor sum to zero, for every s and every L = k+1. *)
Theorem total_shear : forall s k,
  total_over_layer k (fun i j => (on_floor s (n_of k + 1) i j).(along_x)) == 0 /\
  total_over_layer k (fun i j => (on_floor s (n_of k + 1) i j).(along_y)) == 0.
Proof.
  intros s k. split.
  - over_layer
      ((fun K j x : Q => - K * s * x + 3 * j * s * x) (n_of k))
      ((fun K y : Q => - K * K * s * y + 2 * K * s * y * y - 3 * K * s * y - s * y * y * y + 3 * s * y * y - 2 * s * y) (n_of k)). closed.
  - over_layer
      ((fun K j x : Q => (- K * x + j * x + x * x - x) * (1 # 2)) (n_of k))
      ((fun K y : Q => 0) (n_of k)). closed.
Qed.

(** ** Moments

    The position of a sphere of layer k relative to the apex, in 2R. r is its horizontal part. *)
Definition place (s i j k : Q) : vector := position (above i j k) (directions s).

Ltac opened ::= unfold on_floor, brought, closed_form, normal, place; formulas.

(** The shear on the floor has no moment about the axis. *)
Theorem no_moment_about_the_axis : forall s k,
  total_over_layer k (fun i j =>
    (place s i j (n_of k)).(along_x) * (on_floor s (n_of k + 1) i j).(along_y)
    - (place s i j (n_of k)).(along_y) * (on_floor s (n_of k + 1) i j).(along_x)) == 0.
Proof.
  intros s k.
  over_layer
    ((fun K j x : Q => (2 * K * j * s * x - K * j * x - 2 * j * j * s * x + j * j * x - 2 * j * s * x * x + 2 * j * s * x + j * x
      * x - j * x) * (1 # 2)) (n_of k))
    ((fun K y : Q => 0) (n_of k)). closed.
Qed.

(** The normal forces have the same moments as the weights, about both horizontal axes. *)
Theorem total_moment : forall s k,
  let W := weight (increments s) in
  total_over_layer k (fun i j => (on_floor s (n_of k + 1) i j).(along_z) * (place s i j (n_of k)).(along_x))
  == total_over_pile (S k) (fun i j m => W * (place s i j m).(along_x)) /\
  total_over_layer k (fun i j => (on_floor s (n_of k + 1) i j).(along_z) * (place s i j (n_of k)).(along_y))
  == total_over_pile (S k) (fun i j m => W * (place s i j m).(along_y)).
Proof.
  intros s k. cbv zeta. split.
  - symmetry.
    over_pile
      (fun k j x : Q => 2 * j * s * s * x + 4 * j * s * x + 2 * j * x - 2 * k * s * s * x - 2 * k * s * x)
      (fun k y : Q => (- 6 * k * k * s * s * y - 6 * k * k * s * y + 6 * k * s * s * y * y - 12 * k * s * s * y + 9 * k * s *
        y * y - 15 * k * s * y + 3 * k * y * y - 3 * k * y - 2 * s * s * y * y * y + 6 * s * s * y * y - 4 * s *
        s * y - 4 * s * y * y * y + 12 * s * y * y - 8 * s * y - 2 * y * y * y + 6 * y * y - 4 * y) * (1 # 3))
      (fun k : Q => (- 2 * k * k * k * s * s - k * k * k * s + k * k * k - 6 * k * k * s * s - 3 * k * k * s + 3 * k * k - 4
        * k * s * s - 2 * k * s + 2 * k) * (1 # 3))
      (fun x : Q => (- 2 * s * s * x * x * x * x - 4 * s * s * x * x * x + 2 * s * s * x * x + 4 * s * s * x - s * x * x * x
        * x - 2 * s * x * x * x + s * x * x + 2 * s * x + x * x * x * x + 2 * x * x * x - x * x - 2 * x) * (1 #
        12)).
    symmetry.
    over_layer
      ((fun K j x : Q => - K * K * s * x - 2 * K * j * s * s * x + 2 * K * j * s * x + K * j * x - 2 * K * s * s * x - 2 * K * s
        * x + 2 * j * j * s * s * x + j * j * s * x - j * j * x + 2 * j * s * s * x + 4 * j * s * x + 2 * j * x) (n_of k))
      ((fun K y : Q => (- 12 * K * K * K * s * y - 12 * K * K * s * s * y * y - 12 * K * K * s * s * y + 18 * K * K * s * y * y
        - 54 * K * K * s * y + 6 * K * K * y * y - 6 * K * K * y + 16 * K * s * s * y * y * y - 12 * K * s * s *
        y * y - 28 * K * s * s * y - 4 * K * s * y * y * y + 54 * K * s * y * y - 74 * K * s * y - 8 * K * y * y
        * y + 30 * K * y * y - 22 * K * y - 6 * s * s * y * y * y * y + 12 * s * s * y * y * y + 6 * s * s * y *
        y - 12 * s * s * y - 3 * s * y * y * y * y - 6 * s * y * y * y + 39 * s * y * y - 30 * s * y + 3 * y * y
        * y * y - 18 * y * y * y + 33 * y * y - 18 * y) * (1 # 12)) (n_of k)).
    rewrite ?n_of_S. closed.
  - symmetry.
    over_pile
      (fun k j x : Q => j * s * x + j * x - k * s * x - k * x + s * x * x - s * x + x * x - x)
      (fun k y : Q => 0)
      (fun k : Q => 0)
      (fun x : Q => 0).
    symmetry.
    over_layer
      ((fun K j x : Q => (- K * K * x - 2 * K * j * s * x + 2 * K * j * x - 2 * K * s * x + K * x * x - 3 * K * x + 2 * j * j * s
        * x - j * j * x + 2 * j * s * x * x - j * x * x + 3 * j * x + 2 * s * x * x - 2 * s * x + 2 * x * x - 2
        * x) * (1 # 2)) (n_of k))
      ((fun K y : Q => 0) (n_of k)).
    rewrite ?n_of_S. closed.
Qed.

(** The squared distance of a sphere from the axis, in (2R sin theta)^2. *)
Definition from_axis_squared (s : Q) (v : vector) : Q :=
  v.(along_x) * v.(along_x) + 4 * (1 - s * s) * v.(along_y) * v.(along_y).

Ltac opened ::= unfold from_axis_squared, on_floor, closed_form, brought, normal, place; formulas.

(** Second moment: the sum of F_z r_b^2 equals that of mg (r_s^2 + H_s^2 tan^2 theta), H_s the height above the base. *)
Theorem second_moment : forall s k,
  let W := weight (increments s) in
  total_over_layer k (fun i j =>
    (on_floor s (n_of k + 1) i j).(along_z) * from_axis_squared s (place s i j (n_of k)))
  == total_over_pile (S k) (fun i j m => W * (from_axis_squared s (place s i j m) + (n_of k - m) * (n_of k - m))).
Proof.
  intros s k. cbv zeta.
  assert (P : forall H L, total_over_pile L (fun i j m =>
    weight (increments s) * (from_axis_squared s (place s i j m) + (H - m) * (H - m))) == (10 * H * H * s * n_of L * n_of L * n_of L + 30 * H * H * s * n_of L * n_of L + 20 * H * H * s * n_of L +
      10 * H * H * n_of L * n_of L * n_of L + 30 * H * H * n_of L * n_of L + 20 * H * H * n_of L - 15 * H * s *
      n_of L * n_of L * n_of L * n_of L - 30 * H * s * n_of L * n_of L * n_of L + 15 * H * s * n_of L * n_of L +
      30 * H * s * n_of L - 15 * H * n_of L * n_of L * n_of L * n_of L - 30 * H * n_of L * n_of L * n_of L + 15
      * H * n_of L * n_of L + 30 * H * n_of L + 2 * s * s * s * n_of L * n_of L * n_of L * n_of L * n_of L - 10
      * s * s * s * n_of L * n_of L * n_of L + 8 * s * s * s * n_of L + 6 * s * n_of L * n_of L * n_of L * n_of
      L * n_of L + 15 * s * n_of L * n_of L * n_of L * n_of L - 15 * s * n_of L * n_of L - 6 * s * n_of L + 8 *
      n_of L * n_of L * n_of L * n_of L * n_of L + 15 * n_of L * n_of L * n_of L * n_of L - 10 * n_of L * n_of L
      * n_of L - 15 * n_of L * n_of L + 2 * n_of L) * (1 # 30)).
  { intros H L.
  over_pile
    (fun k j x : Q => (6 * H * H * s * x + 6 * H * H * x - 12 * H * k * s * x - 12 * H * k * x + 12 * j * j * s * s * x + 24 * j
      * j * s * x + 12 * j * j * x - 12 * j * k * s * s * x - 24 * j * k * s * x - 12 * j * k * x - 12 * j * s *
      s * s * x * x + 12 * j * s * s * s * x - 12 * j * s * s * x * x + 12 * j * s * s * x + 12 * j * s * x * x
      - 12 * j * s * x + 12 * j * x * x - 12 * j * x + 12 * k * k * s * x + 12 * k * k * x + 12 * k * s * s * s
      * x * x - 12 * k * s * s * s * x + 12 * k * s * s * x * x - 12 * k * s * s * x - 12 * k * s * x * x + 12 *
      k * s * x - 12 * k * x * x + 12 * k * x - 8 * s * s * s * x * x * x + 12 * s * s * s * x * x - 4 * s * s *
      s * x - 8 * s * s * x * x * x + 12 * s * s * x * x - 4 * s * s * x + 8 * s * x * x * x - 12 * s * x * x +
      4 * s * x + 8 * x * x * x - 12 * x * x + 4 * x) * (1 # 3))
    (fun k y : Q => (6 * H * H * k * s * y + 6 * H * H * k * y - 3 * H * H * s * y * y + 9 * H * H * s * y - 3 * H * H * y * y
      + 9 * H * H * y - 12 * H * k * k * s * y - 12 * H * k * k * y + 6 * H * k * s * y * y - 18 * H * k * s * y
      + 6 * H * k * y * y - 18 * H * k * y + 4 * k * k * k * s * s * s * y + 4 * k * k * k * s * s * y + 8 * k *
      k * k * s * y + 8 * k * k * k * y - 6 * k * k * s * s * s * y * y + 6 * k * k * s * s * s * y - 12 * k * k
      * s * s * y * y + 12 * k * k * s * s * y - 12 * k * k * s * y * y + 24 * k * k * s * y - 6 * k * k * y * y
      + 18 * k * k * y + 4 * k * s * s * s * y * y * y - 6 * k * s * s * s * y * y - 2 * k * s * s * s * y + 12
      * k * s * s * y * y * y - 24 * k * s * s * y * y + 8 * k * s * s * y + 12 * k * s * y * y * y - 30 * k * s
      * y * y + 22 * k * s * y + 4 * k * y * y * y - 12 * k * y * y + 12 * k * y - s * s * s * y * y * y * y + 2
      * s * s * s * y * y * y + s * s * s * y * y - 2 * s * s * s * y - 4 * s * s * y * y * y * y + 12 * s * s *
      y * y * y - 8 * s * s * y * y - 5 * s * y * y * y * y + 18 * s * y * y * y - 19 * s * y * y + 6 * s * y -
      2 * y * y * y * y + 8 * y * y * y - 10 * y * y + 4 * y) * (1 # 3))
    (fun k : Q => (3 * H * H * k * k * s + 3 * H * H * k * k + 9 * H * H * k * s + 9 * H * H * k + 6 * H * H * s + 6 * H * H
      - 6 * H * k * k * k * s - 6 * H * k * k * k - 18 * H * k * k * s - 18 * H * k * k - 12 * H * k * s - 12 *
      H * k + k * k * k * k * s * s * s + 3 * k * k * k * k * s + 4 * k * k * k * k + 2 * k * k * k * s * s * s
      + 12 * k * k * k * s + 14 * k * k * k - k * k * s * s * s + 15 * k * k * s + 14 * k * k - 2 * k * s * s *
      s + 6 * k * s + 4 * k) * (1 # 3))
    (fun x : Q => (10 * H * H * s * x * x * x + 30 * H * H * s * x * x + 20 * H * H * s * x + 10 * H * H * x * x * x + 30 *
      H * H * x * x + 20 * H * H * x - 15 * H * s * x * x * x * x - 30 * H * s * x * x * x + 15 * H * s * x * x
      + 30 * H * s * x - 15 * H * x * x * x * x - 30 * H * x * x * x + 15 * H * x * x + 30 * H * x + 2 * s * s *
      s * x * x * x * x * x - 10 * s * s * s * x * x * x + 8 * s * s * s * x + 6 * s * x * x * x * x * x + 15 *
      s * x * x * x * x - 15 * s * x * x - 6 * s * x + 8 * x * x * x * x * x + 15 * x * x * x * x - 10 * x * x *
      x - 15 * x * x + 2 * x) * (1 # 30)).
    reflexivity. }
  rewrite P. rewrite n_of_S.
  over_layer
    ((fun K j x : Q => (3 * K * K * K * x - 9 * K * K * j * x + 6 * K * K * s * s * x * x - 6 * K * K * s * s * x + 6 * K * K * s
      * x - 6 * K * K * x * x + 12 * K * K * x - 12 * K * j * j * s * s * x + 12 * K * j * j * x + 12 * K * j *
      s * s * s * x * x - 12 * K * j * s * s * s * x - 12 * K * j * s * s * x * x - 12 * K * j * s * x * x - 12
      * K * j * s * x + 12 * K * j * x * x - 24 * K * j * x + 12 * K * s * s * s * x * x - 12 * K * s * s * s *
      x - 4 * K * s * s * x * x * x + 18 * K * s * s * x * x - 14 * K * s * s * x - 12 * K * s * x * x + 12 * K
      * s * x + 4 * K * x * x * x - 18 * K * x * x + 14 * K * x + 12 * j * j * j * s * s * x + 6 * j * j * j * s
      * x - 6 * j * j * j * x - 12 * j * j * s * s * s * x * x + 12 * j * j * s * s * s * x + 6 * j * j * s * s
      * x * x + 6 * j * j * s * s * x + 12 * j * j * s * x * x + 12 * j * j * s * x - 6 * j * j * x * x + 18 * j
      * j * x - 8 * j * s * s * s * x * x * x + 8 * j * s * s * s * x + 4 * j * s * s * x * x * x - 18 * j * s *
      s * x * x + 14 * j * s * s * x + 8 * j * s * x * x * x - 8 * j * s * x - 4 * j * x * x * x + 18 * j * x *
      x - 14 * j * x - 8 * s * s * s * x * x * x + 12 * s * s * s * x * x - 4 * s * s * s * x - 8 * s * s * x *
      x * x + 12 * s * s * x * x - 4 * s * s * x + 8 * s * x * x * x - 12 * s * x * x + 4 * s * x + 8 * x * x *
      x - 12 * x * x + 4 * x) * (1 # 3)) (n_of k))
    ((fun K y : Q => (20 * K * K * K * K * s * s * y + 10 * K * K * K * K * y + 20 * K * K * K * s * s * s * y * y + 20 * K * K
      * K * s * s * s * y - 40 * K * K * K * s * s * y * y + 80 * K * K * K * s * s * y - 20 * K * K * K * s * y
      * y + 40 * K * K * K * s * y - 20 * K * K * K * y * y + 70 * K * K * K * y - 40 * K * K * s * s * s * y *
      y * y + 40 * K * K * s * s * s * y - 120 * K * K * s * s * y * y + 100 * K * K * s * s * y + 40 * K * K *
      s * y * y * y - 150 * K * K * s * y * y + 170 * K * K * s * y + 30 * K * K * y * y * y - 120 * K * K * y *
      y + 170 * K * K * y + 30 * K * s * s * s * y * y * y * y - 20 * K * s * s * s * y * y * y - 50 * K * s * s
      * s * y * y + 40 * K * s * s * y * y * y * y - 120 * K * s * s * y * y + 40 * K * s * s * y - 15 * K * s *
      y * y * y * y + 150 * K * s * y * y * y - 295 * K * s * y * y + 200 * K * s * y - 25 * K * y * y * y * y +
      130 * K * y * y * y - 225 * K * y * y + 160 * K * y - 8 * s * s * s * y * y * y * y * y + 10 * s * s * s *
      y * y * y * y + 20 * s * s * s * y * y * y - 10 * s * s * s * y * y - 12 * s * s * s * y - 20 * s * s * y
      * y * y * y * y + 40 * s * s * y * y * y * y + 20 * s * s * y * y * y - 40 * s * s * y * y - 4 * s * y * y
      * y * y * y - 25 * s * y * y * y * y + 130 * s * y * y * y - 155 * s * y * y + 54 * s * y + 8 * y * y * y
      * y * y - 55 * y * y * y * y + 130 * y * y * y - 125 * y * y + 42 * y) * (1 # 30)) (n_of k)).
  closed.
Qed.

(** ** The axis and the corners *)

(** On an equilateral base the shear of a bottom sphere is its position relative to the axis. *)
Theorem shear_is_the_place : forall L i j,
  (on_floor (1 # 2) L i j).(along_x) == (place (1 # 2) i j (L - 1)).(along_x) /\
  (on_floor (1 # 2) L i j).(along_y) == (place (1 # 2) i j (L - 1)).(along_y).
Proof. intros. opened. split; ring. Qed.

Lemma q_zero : forall z : Z, q z == 0 -> z = 0%Z.
Proof. intros z H. unfold Qeq in H. simpl in H. lia. Qed.

(** The shear vanishes only on the axis. A bottom sphere is on the axis only if L-1 = 3n, and then i = j = n. *)
Theorem shear_vanishes_on_the_axis : forall L i j : Z,
  let F := on_floor (1 # 2) (q L) (q i) (q j) in
  (F.(along_x) == 0 /\ F.(along_y) == 0) <-> (i = j /\ L - 1 = 3 * j)%Z.
Proof.
  intros L i j. cbv zeta. destruct (shear (q L) (q i) (q j)) as [Sx Sy]. rewrite Sx, Sy.
  assert (X : (3 * q j - (q L - 1)) * (1 # 2) == q (3 * j - (L - 1)) * (1 # 2)).
  { unfold Z.sub. repeat (rewrite inject_Z_plus || rewrite inject_Z_mult || rewrite inject_Z_opp). cbn [q]. ring. }
  assert (Y : (2 * q i + q j - (q L - 1)) * (1 # 2) == q (2 * i + j - (L - 1)) * (1 # 2)).
  { unfold Z.sub. repeat (rewrite inject_Z_plus || rewrite inject_Z_mult || rewrite inject_Z_opp). cbn [q]. ring. }
  rewrite X, Y.
  assert (Z : forall z : Z, q z * (1 # 2) == 0 <-> z = 0%Z).
  { intros z. split; intros H; [|subst; reflexivity].
    destruct (Qmult_integral _ _ H) as [A | A]; [|discriminate A].
    apply q_zero. exact A. }
  rewrite !Z. lia.
Qed.

(** (L-1)^2 - |shear|^2 = 3 (N_a N_b + N_b N_c + N_c N_a), with normal force L+2. So the largest ratio of shear to
    normal force is tan theta (L-1)/(L+2). *)
Theorem shear_ratio : forall L i j,
  (L - 1) * (L - 1) - from_axis_squared (1 # 2) (on_floor (1 # 2) L i j)
  == 3 * (let (a, b, c) := above i j (L - 1) in a * b + b * c + c * a) /\
  (on_floor (1 # 2) L i j).(along_z) == L + 2.
Proof. intros. opened. split; ring. Qed.

(** This ratio is the maximum over the base, and is attained only at the corners. *)
Theorem shear_is_greatest_in_the_corners : forall k i j, occupied k i j = true ->
  let shear_squared := from_axis_squared (1 # 2) (on_floor (1 # 2) (n_of k + 1) (q i) (q j)) in
  shear_squared <= n_of k * n_of k /\
  (shear_squared == n_of k * n_of k <->
   (i = 0 /\ j = 0 \/ i = Z.of_nat k /\ j = 0 \/ i = 0 /\ j = Z.of_nat k)%Z).
Proof.
  intros k i j H. cbv zeta. apply occupied_iff in H.
  destruct (shear_ratio (n_of k + 1) (q i) (q j)) as [R _].
  assert (P : 3 * (let (a, b, c) := above (q i) (q j) (n_of k + 1 - 1) in a * b + b * c + c * a)
              == q (3 * ((Z.of_nat k - i - j) * i + i * j + j * (Z.of_nat k - i - j)))).
  { unfold above, n_of, Z.sub. repeat (rewrite inject_Z_plus || rewrite inject_Z_mult || rewrite inject_Z_opp).
    cbn [q]. ring. }
  rewrite P in R.
  set (z := (3 * ((Z.of_nat k - i - j) * i + i * j + j * (Z.of_nat k - i - j)))%Z) in *.
  assert (Z0 : (0 <= z)%Z) by (unfold z; nia).
  assert (Q0 : 0 <= q z) by (change 0 with (q 0); rewrite <- Zle_Qle; exact Z0).
  assert (E : (n_of k + 1 - 1) * (n_of k + 1 - 1) == n_of k * n_of k) by ring.
  rewrite E in R. split; [lra|]. split.
  - intros G. assert (A : z = 0%Z) by (apply q_zero; lra).
    unfold z in A. clear - A H. assert (I : (i = 0 \/ j = 0)%Z) by nia.
    destruct I; subst; nia.
  - intros G. assert (A : z = 0%Z) by (unfold z; nia). rewrite A in R. change (q 0) with 0 in R. lra.
Qed.

(** The forces from above on any sphere sum to the central force mg/(6R cos theta) r, on an equilateral base. *)
Theorem central_force : forall i j k,
  resultant (brought (1 # 2) i j k) (directions (1 # 2)) =v= place (1 # 2) i j k /\
  place (1 # 2) i j k =v= Vector ((3 * j - k) * (1 # 2)) ((2 * i + j - k) * (1 # 2)) k.
Proof. intros. unfold place, brought. split; by_components. Qed.
