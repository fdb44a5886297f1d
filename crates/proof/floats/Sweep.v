(** The rounding errors of a sweep, and the bound of `Layer::error_bound`.

    An operation of a scalar has a relative error of at most u, and below the normal range an error of at most eta. The
    scalar is `f32`, `f64` or `DoubleDouble`, with u = 2^-24, 2^-53 or 2^-100. The state of a sweep is one force for each
    line of a layer. Its norm is the root of the sum of the squares of all forces of the layer. *)

From Coq Require Import Reals Lra Lia List Permutation ZArith.
From Flocq Require Import Raux.
Import ListNotations.

Open Scope R_scope.

(** Bounds an absolute value by the bounds of others. *)
Ltac bound := apply Rabs_le;
  repeat match goal with H : Rabs _ <= _ |- _ => apply Rabs_le_inv in H end; lra.

(** ** The norm of a list of numbers *)

Definition hypot (x p : R) : R := sqrt (x * x + p * p).

Fixpoint norm (l : list R) : R :=
  match l with
  | [] => 0
  | x :: l => hypot x (norm l)
  end.

Lemma squares_positive : forall x p, 0 <= x * x + p * p.
Proof. intros. generalize (Rle_0_sqr x) (Rle_0_sqr p). unfold Rsqr. lra. Qed.

Lemma hypot_square : forall x p, hypot x p * hypot x p = x * x + p * p.
Proof. intros. apply sqrt_sqrt, squares_positive. Qed.

Lemma hypot_positive : forall x p, 0 <= hypot x p.
Proof. intros. apply sqrt_pos. Qed.

Lemma hypot_monotone : forall x y p q, Rabs x <= Rabs y -> 0 <= p <= q -> hypot x p <= hypot y q.
Proof.
  intros x y p q H [Hp Hq]. apply sqrt_le_1_alt. apply Rplus_le_compat.
  - apply Rsqr_le_abs_1 in H. exact H.
  - apply Rmult_le_compat; trivial.
Qed.

Lemma hypot_triangle : forall x y p q, 0 <= p -> 0 <= q -> hypot (x + y) (p + q) <= hypot x p + hypot y q.
Proof.
  intros x y p q Hp Hq.
  assert (D : x * y + p * q <= hypot x p * hypot y q).
  { unfold hypot. rewrite <- sqrt_mult by apply squares_positive.
    apply Rle_trans with (1 := Rle_abs _). rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt. unfold Rsqr.
    generalize (Rle_0_sqr (x * q - y * p)). unfold Rsqr. lra. }
  apply Rsqr_incr_0_var; [| generalize (hypot_positive x p) (hypot_positive y q); lra].
  unfold Rsqr. rewrite hypot_square. generalize (hypot_square x p) (hypot_square y q). lra.
Qed.

Lemma norm_positive : forall l, 0 <= norm l.
Proof. destruct l; [apply Rle_refl | apply hypot_positive]. Qed.

(** The order of the lines does not matter. *)
Lemma norm_of_permutation : forall l k, Permutation l k -> norm l = norm k.
Proof.
  induction 1; simpl; try congruence.
  unfold hypot at 1 3. rewrite !hypot_square. f_equal. ring.
Qed.

(** The norm of a quantity [f] over the lines of a layer. *)
Definition over {A} (f : A -> R) (l : list A) : R := norm (map f l).

Lemma over_positive : forall A (f : A -> R) l, 0 <= over f l.
Proof. intros. apply norm_positive. Qed.

Lemma over_triangle : forall A (f g : A -> R) l, over (fun t => f t + g t) l <= over f l + over g l.
Proof.
  unfold over. induction l as [|t l IH]; simpl; [lra |].
  apply Rle_trans with (2 := hypot_triangle _ _ _ _ (norm_positive _) (norm_positive _)).
  apply hypot_monotone; [apply Rle_refl |]. split; [apply norm_positive | exact IH].
Qed.

Lemma over_monotone : forall A (f g : A -> R) l,
  (forall t, In t l -> Rabs (f t) <= Rabs (g t)) -> over f l <= over g l.
Proof.
  unfold over. induction l as [|t l IH]; simpl; intros H; [lra |].
  apply hypot_monotone; [apply H; auto |]. split; [apply norm_positive |]. apply IH. auto.
Qed.

Lemma over_multiple : forall A (f : A -> R) k l, 0 <= k -> over (fun t => k * f t) l = k * over f l.
Proof.
  unfold over. intros A f k l Hk. induction l as [|t l IH]; simpl; [lra |].
  rewrite IH. unfold hypot.
  replace (k * f t * (k * f t) + k * norm (map f l) * (k * norm (map f l)))
    with ((k * k) * (f t * f t + norm (map f l) * norm (map f l))) by ring.
  rewrite sqrt_mult by (try apply squares_positive; apply Rmult_le_pos; trivial).
  rewrite sqrt_square by trivial. reflexivity.
Qed.

Lemma over_each : forall A (f : A -> R) l t, In t l -> Rabs (f t) <= over f l.
Proof.
  unfold over. induction l as [|s l IH]; simpl; [contradiction |]. intros t [-> | H].
  - unfold hypot. rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt. unfold Rsqr.
    generalize (Rle_0_sqr (norm (map f l))). unfold Rsqr. lra.
  - apply Rle_trans with (1 := IH t H).
    unfold hypot. rewrite <- (sqrt_square (norm (map f l))) at 1 by apply norm_positive.
    apply sqrt_le_1_alt. generalize (Rle_0_sqr (f s)). unfold Rsqr. lra.
Qed.

(** The lines of the spheres of a layer: three for each sphere. *)
Inductive direction := alpha | beta | gamma.

Definition lines {A} (l : list A) : list (A * direction) := flat_map (fun s => [(s, alpha); (s, beta); (s, gamma)]) l.

(** The norm of the three values of one sphere. *)
Definition size {A} (f : A * direction -> R) (s : A) : R := norm [f (s, alpha); f (s, beta); f (s, gamma)].

Lemma over_of_lines : forall A (f : A * direction -> R) s l,
  over f (lines (s :: l)) = hypot (size f s) (over f (lines l)).
Proof.
  intros. unfold over, size. simpl. unfold hypot at 1.
  rewrite !hypot_square. unfold hypot at 1. rewrite !hypot_square. f_equal. ring.
Qed.

Lemma over_by_spheres : forall A (f g : A * direction -> R) l,
  (forall s, In s l -> size f s <= size g s) -> over f (lines l) <= over g (lines l).
Proof.
  induction l as [|s l IH]; intros H; [apply Rle_refl |].
  rewrite !over_of_lines. apply hypot_monotone.
  - rewrite !Rabs_pos_eq by apply norm_positive. apply H. left. reflexivity.
  - split; [apply norm_positive |]. apply IH. intros. apply H. right. assumption.
Qed.

(** ** Rounded operations *)

Section Rounding.

(** The largest relative error, the largest error by underflow, and the rounded operations. *)
Variables u eta : R.
Hypothesis u_is_small : 0 <= u <= 1 / 1300.
Hypothesis eta_positive : 0 <= eta.

Definition near (exact computed : R) : Prop := Rabs (computed - exact) <= u * Rabs exact + eta.

Variables add sub mul : R -> R -> R.
Variable third : R -> R.
Hypothesis add_near : forall x y, near (x + y) (add x y).
Hypothesis sub_near : forall x y, near (x - y) (sub x y).
Hypothesis mul_near : forall x y, near (x * y) (mul x y).
Hypothesis third_near : forall x, near (x / 3) (third x).

Declare Scope scalar_scope.
Delimit Scope scalar_scope with T.
Arguments add _%T _%T.
Arguments sub _%T _%T.
Arguments mul _%T _%T.
Infix "+" := add : scalar_scope.
Infix "-" := sub : scalar_scope.
Infix "*" := mul : scalar_scope.
Local Open Scope scalar_scope.

(* begin src/scalar/turn.rs twice_sum *)
Definition twice_sum '((a, b, c) : prod (prod R R) R) :=
  let sum := a + b + c in
  sum + sum.
(* end *)

(* begin src/formula.rs force *)
Definition force '((n, increment) : prod R R) :=
  n * increment.
(* end *)

(* begin src/formula.rs transmitted *)
Definition transmitted '((received, own) : prod R R) :=
  received + own.
(* end *)

(* quote src/scalar.rs half_turn:
    let twice_mean = turn::twice_sum(g).div_int(THREE);
    g.each_ref().each(|x| twice_mean.clone() - x) *)
Definition half_turn (a b c x : R) :=
  let twice_mean := third(twice_sum(a, b, c)) in
  twice_mean - x.

Local Close Scope scalar_scope.

(** The exact half-turn: G g = (2/3)(g_alpha + g_beta + g_gamma)(1, 1, 1) - g. *)
Definition exact_half_turn (a b c x : R) : R := 2 / 3 * (a + b + c) - x.

Lemma root_3 : sqrt 3 <= 17321 / 10000.
Proof. rewrite <- (sqrt_square (17321 / 10000)) by lra. apply sqrt_le_1_alt. lra. Qed.

(** The sum of two, and of three, forces of a sphere. *)
Lemma two_forces : forall a b c, Rabs (a + b) <= 14143 / 10000 * norm [a; b; c].
Proof.
  intros. apply Rsqr_incr_0_var; [| apply Rmult_le_pos; [lra | apply norm_positive]].
  rewrite <- Rsqr_abs. unfold Rsqr.
  replace (14143 / 10000 * norm [a; b; c] * (14143 / 10000 * norm [a; b; c]))
    with (14143 / 10000 * (14143 / 10000) * (norm [a; b; c] * norm [a; b; c])) by ring.
  simpl. rewrite !hypot_square.
  generalize (Rle_0_sqr (a - b)) (Rle_0_sqr a) (Rle_0_sqr b) (Rle_0_sqr c). unfold Rsqr. lra.
Qed.

Lemma three_forces : forall a b c, Rabs (a + b + c) <= 17321 / 10000 * norm [a; b; c].
Proof.
  intros. apply Rsqr_incr_0_var; [| apply Rmult_le_pos; [lra | apply norm_positive]].
  rewrite <- Rsqr_abs. unfold Rsqr.
  replace (17321 / 10000 * norm [a; b; c] * (17321 / 10000 * norm [a; b; c]))
    with (17321 / 10000 * (17321 / 10000) * (norm [a; b; c] * norm [a; b; c])) by ring.
  simpl. rewrite !hypot_square.
  generalize (Rle_0_sqr (a - b)) (Rle_0_sqr (a - c)) (Rle_0_sqr (b - c)) (Rle_0_sqr a) (Rle_0_sqr b) (Rle_0_sqr c).
  unfold Rsqr. lra.
Qed.

(** The half-turn keeps the norm. *)
Lemma half_turn_keeps_norm : forall a b c,
  norm [exact_half_turn a b c a; exact_half_turn a b c b; exact_half_turn a b c c] = norm [a; b; c].
Proof.
  intros. simpl. unfold hypot at 1 4. f_equal. rewrite !hypot_square. unfold exact_half_turn. field.
Qed.

(** Small factors. *)
Lemma times_u : forall x k, 0 <= x <= k -> 0 <= u * x <= 1 / 1300 * k.
Proof.
  intros x k [H0 H]. split; [apply Rmult_le_pos; lra |]. apply Rmult_le_compat; lra.
Qed.

(** The error of twice the mean: 4.42 u of the norm. *)
Lemma twice_mean_error : forall a b c,
  Rabs (third (twice_sum (a, b, c)) - 2 / 3 * (a + b + c)) <= 442 / 100 * (u * norm [a; b; c]) + 27 / 10 * eta.
Proof.
  intros a b c. unfold twice_sum. set (n := norm [a; b; c]).
  assert (Hn : 0 <= n) by apply norm_positive.
  generalize (two_forces a b c) (three_forces a b c). fold n. intros F2 F3.
  set (s1 := add a b). set (s2 := add s1 c). set (s3 := add s2 s2). set (m := third s3).
  assert (E1 : Rabs (s1 - (a + b)) <= u * Rabs (a + b) + eta) by apply add_near.
  assert (E2 : Rabs (s2 - (s1 + c)) <= u * Rabs (s1 + c) + eta) by apply add_near.
  assert (E3 : Rabs (s3 - (s2 + s2)) <= u * Rabs (s2 + s2) + eta) by apply add_near.
  assert (E4 : Rabs (m - s3 / 3) <= u * Rabs (s3 / 3) + eta) by apply third_near.
  set (x := u * n). assert (Hx : 0 <= x <= 1 / 1300 * n) by (apply times_u; lra).
  (* After each operation: the error so far. *)
  assert (U1 : u * Rabs (a + b) <= 14143 / 10000 * x).
  { unfold x. replace (14143 / 10000 * (u * n)) with (u * (14143 / 10000 * n)) by ring. apply Rmult_le_compat_l; lra. }
  assert (D1 : Rabs (s1 - (a + b)) <= 14143 / 10000 * x + eta) by lra.
  assert (U2 : u * Rabs (s1 + c) <= 17332 / 10000 * x + 1 / 1300 * eta).
  { apply Rle_trans with (u * (17332 / 10000 * n + eta)).
    - apply Rmult_le_compat_l; [lra | bound].
    - rewrite Rmult_plus_distr_l. assert (u * eta <= 1 / 1300 * eta) by (apply Rmult_le_compat_r; lra).
      unfold x. lra. }
  assert (D2 : Rabs (s2 - (a + b + c)) <= 31475 / 10000 * x + 2001 / 1000 * eta) by (bound).
  assert (U3 : u * Rabs (s2 + s2) <= 34692 / 10000 * x + 1 / 300 * eta).
  { apply Rle_trans with (u * (34692 / 10000 * n + 41 / 10 * eta)).
    - apply Rmult_le_compat_l; [lra | bound].
    - rewrite Rmult_plus_distr_l. assert (u * (41 / 10 * eta) <= 1 / 1300 * (41 / 10 * eta)) by (apply Rmult_le_compat_r; lra).
      unfold x. lra. }
  assert (D3 : Rabs (s3 - 2 * (a + b + c)) <= 97642 / 10000 * x + 501 / 100 * eta) by (bound).
  assert (U4 : u * Rabs (s3 / 3) <= 11573 / 10000 * x + 1 / 700 * eta).
  { apply Rle_trans with (u * (11573 / 10000 * n + 17 / 10 * eta)).
    - apply Rmult_le_compat_l; [lra | bound].
    - rewrite Rmult_plus_distr_l. assert (u * (17 / 10 * eta) <= 1 / 1300 * (17 / 10 * eta)) by (apply Rmult_le_compat_r; lra).
      unfold x. lra. }
  bound.
Qed.

(** Three equal values. *)
Lemma constant_size : forall k, norm [k; k; k] <= 17321 / 10000 * Rabs k.
Proof.
  intros k. apply Rsqr_incr_0_var; [| apply Rmult_le_pos; [lra | apply Rabs_pos]].
  unfold Rsqr. replace (17321 / 10000 * Rabs k * (17321 / 10000 * Rabs k))
    with (17321 / 10000 * (17321 / 10000) * (Rabs k * Rabs k)) by ring.
  simpl. rewrite hypot_square. rewrite hypot_square. rewrite hypot_square.
  rewrite <- Rabs_mult, (Rabs_pos_eq (k * k)) by apply Rle_0_sqr.
  generalize (Rle_0_sqr k). unfold Rsqr. lra.
Qed.

(** The forces of a sphere after a turn, exact and computed, from a quantity on its three lines. *)
Definition exact_turn {A} (f : A * direction -> R) '((s, d) : A * direction) : R :=
  exact_half_turn (f (s, alpha)) (f (s, beta)) (f (s, gamma)) (f (s, d)).
Definition computed_turn {A} (f : A * direction -> R) '((s, d) : A * direction) : R :=
  half_turn (f (s, alpha)) (f (s, beta)) (f (s, gamma)) (f (s, d)).

(** The rounding errors of the turn of one sphere: 8.67 u of the norm. *)
Lemma turn_error_of_sphere : forall A (c : A * direction -> R) s,
  size (fun t => computed_turn c t - exact_turn c t) s <= 867 / 100 * (u * size c s) + 65 / 10 * eta.
Proof.
  intros A c s.
  set (a := c (s, alpha)). set (b := c (s, beta)). set (g := c (s, gamma)).
  assert (N : size c s = norm [a; b; g]) by reflexivity.
  generalize (twice_mean_error a b g). rewrite <- N.
  set (m := third (twice_sum (a, b, g))). set (em := m - 2 / 3 * (a + b + g)). intros Em.
  set (n := size c s) in *. assert (Hn : 0 <= n) by apply norm_positive.
  assert (Hx : 0 <= u * n <= 1 / 1300 * n) by (apply times_u; lra).
  set (k := u * Rabs em + eta).
  assert (Hk : 0 <= k <= 1 / 1300 * Rabs em + eta).
  { unfold k. generalize (times_u (Rabs em) (Rabs em)). generalize (Rabs_pos em). intros. lra. }
  apply Rle_trans with (over (fun _ : A * direction => em) [(s, alpha); (s, beta); (s, gamma)]
    + over (fun t => sub m (c t) - (m - c t)) [(s, alpha); (s, beta); (s, gamma)]).
  { apply Rle_trans with (2 := over_triangle _ _ _ _).
    match goal with |- size ?f s <= _ => change (size f s) with (over f [(s, alpha); (s, beta); (s, gamma)]) end.
    apply over_monotone. intros t Ht. apply Req_le. f_equal.
    destruct Ht as [<- | [<- | [<- | []]]]; 
      unfold computed_turn, exact_turn, half_turn, exact_half_turn; cbv beta iota zeta; fold a b g; fold m; unfold em; ring. }
  assert (P1 : over (fun _ : A * direction => em) [(s, alpha); (s, beta); (s, gamma)] <= 17321 / 10000 * Rabs em)
    by apply constant_size.
  assert (P2 : over (fun t => sub m (c t) - (m - c t)) [(s, alpha); (s, beta); (s, gamma)]
    <= u * n + 17321 / 10000 * k).
  { apply Rle_trans with (over (fun t => u * Rabs (exact_turn c t) + k) [(s, alpha); (s, beta); (s, gamma)]).
    - apply over_monotone. intros t Ht.
      assert (H : exact_turn c t = 2 / 3 * (a + b + g) - c t).
      { destruct Ht as [<- | [<- | [<- | []]]]; reflexivity. }
      rewrite H. apply Rle_trans with (1 := sub_near m (c t)).
      rewrite (Rabs_pos_eq (_ + k)) by (apply Rplus_le_le_0_compat; [apply Rmult_le_pos; [lra | apply Rabs_pos] | lra]).
      unfold k. rewrite <- Rplus_assoc. apply Rplus_le_compat_r. rewrite <- Rmult_plus_distr_l.
      apply Rmult_le_compat_l; [lra |].
      replace (m - c t) with (2 / 3 * (a + b + g) - c t + em) by (unfold em; ring). apply Rabs_triang.
    - apply Rle_trans with (1 := over_triangle _ _ _ _). apply Rplus_le_compat.
      + rewrite over_multiple by lra. apply Rmult_le_compat_l; [lra |].
        apply Rle_trans with (over (exact_turn c) [(s, alpha); (s, beta); (s, gamma)]).
        * apply over_monotone. intros. rewrite Rabs_Rabsolu. apply Rle_refl.
        * apply Req_le. transitivity (norm [a; b; g]); [exact (half_turn_keeps_norm a b g) | symmetry; exact N].
      + apply Rle_trans with (1 := constant_size k). rewrite Rabs_pos_eq by lra. apply Rle_refl. }
  generalize (Rabs_pos em). lra.
Qed.

(** The rounding errors of the turn of a layer. [lost] is the norm of the errors by underflow. *)
Lemma turn_error : forall A (e c : A * direction -> R) (l : list A) lost,
  over (fun _ => eta) (lines l) <= lost ->
  over (fun t => computed_turn c t - exact_turn e t) (lines l) <=
    over (fun t => c t - e t) (lines l) + 867 / 100 * (u * over c (lines l)) + 65 / 10 * lost.
Proof.
  intros A e c l lost Hlost.
  apply Rle_trans with (over (fun t => exact_turn (fun t => c t - e t) t + (computed_turn c t - exact_turn c t)) (lines l)).
  { apply over_monotone. intros [s d] _. apply Req_le. f_equal. simpl. unfold exact_half_turn. ring. }
  apply Rle_trans with (1 := over_triangle _ _ _ _).
  rewrite Rplus_assoc. apply Rplus_le_compat.
  - apply over_by_spheres. intros s _. apply Req_le. apply half_turn_keeps_norm.
  - (* One value for each sphere, on its first line. *)
    set (first := fun (f : A -> R) (t : A * direction) => match t with (s, alpha) => f s | _ => 0 end).
    assert (S : forall f s, 0 <= f s -> size (first f) s = f s).
    { intros f s H. unfold size, first. simpl. unfold hypot.
      replace (0 * 0 + 0 * 0) with 0 by ring. rewrite sqrt_0. replace (0 * 0 + 0 * 0) with 0 by ring.
      rewrite sqrt_0. replace (f s * f s + 0 * 0) with (f s * f s) by ring. apply sqrt_square. exact H. }
    apply Rle_trans with (over (fun t => 867 / 100 * u * first (size c) t + 65 / 10 * first (fun _ => eta) t) (lines l)).
    + apply over_by_spheres. intros s _. apply Rle_trans with (1 := turn_error_of_sphere A c s).
      apply Req_le. symmetry.
      transitivity (size (first (fun s => 867 / 100 * (u * size c s) + 65 / 10 * eta)) s).
      * unfold size. apply (f_equal norm). unfold first. f_equal; [| f_equal; [| f_equal]]; cbv beta iota; ring.
      * apply S. apply Rplus_le_le_0_compat; repeat apply Rmult_le_pos; try lra. apply norm_positive.
    + apply Rle_trans with (1 := over_triangle _ _ _ _). apply Rplus_le_compat.
      * rewrite over_multiple by lra. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra |].
        apply Rmult_le_compat_l; [lra |]. apply over_by_spheres. intros s _. rewrite S by apply norm_positive.
        apply Rle_refl.
      * rewrite over_multiple by lra. apply Rmult_le_compat_l; [lra |]. apply Rle_trans with (2 := Hlost).
        apply over_monotone. intros [s d] _. unfold first. destruct d; try apply Rle_refl;
          rewrite Rabs_R0; apply Rabs_pos.
Qed.

(** The increments of n spheres: the number, the increment and the product are rounded. *)
Lemma increments_error : forall n w n' w', Rabs (n' - n) <= u * Rabs n -> near w w' ->
  Rabs (force (n', w') - n * w) <= 301 / 100 * (u * Rabs (n * w)) + (1002 / 1000 * Rabs n + 1) * eta.
Proof.
  intros n w n' w' Hn Hw. unfold near in Hw. unfold force.
  generalize (mul_near n' w'). unfold near. set (q := mul n' w'). intros Hq.
  assert (H1 : Rabs (n' * w' - n * w) <= Rabs n * (u * Rabs w + eta) + u * Rabs n * (Rabs w + (u * Rabs w + eta))).
  { replace (n' * w' - n * w) with (n * (w' - w) + (n' - n) * (w + (w' - w))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult. apply Rplus_le_compat.
    - apply Rmult_le_compat_l; [apply Rabs_pos | exact Hw].
    - apply Rmult_le_compat; try apply Rabs_pos; trivial. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  rewrite Rabs_mult. set (p := Rabs n) in *. set (r := Rabs w) in *.
  assert (Hp : 0 <= p) by apply Rabs_pos. assert (Hr : 0 <= r) by apply Rabs_pos.
  assert (Hpr : 0 <= p * r) by (apply Rmult_le_pos; trivial).
  assert (Hpe : 0 <= p * eta) by (apply Rmult_le_pos; trivial).
  assert (Hx : 0 <= u * (p * r) <= 1 / 1300 * (p * r)) by (apply times_u; lra).
  assert (Hxx : 0 <= u * (u * (p * r)) <= 1 / 1300 * (u * (p * r))) by (apply times_u; lra).
  assert (Hy : 0 <= u * (p * eta) <= 1 / 1300 * (p * eta)) by (apply times_u; lra).
  assert (H2 : Rabs (n' * w' - n * w) <= 2001 / 1000 * (u * (p * r)) + 1001 / 1000 * (p * eta)).
  { apply Rle_trans with (1 := H1).
    replace (p * (u * r + eta) + u * p * (r + (u * r + eta)))
      with (2 * (u * (p * r)) + u * (u * (p * r)) + p * eta + u * (p * eta)) by ring. lra. }
  assert (H3 : Rabs (n' * w') <= 1002 / 1000 * (p * r) + 1001 / 1000 * (p * eta)).
  { replace (n' * w') with (n * w + (n' * w' - n * w)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite Rabs_mult. fold p r. lra. }
  assert (H4 : u * Rabs (n' * w') <= 1002 / 1000 * (u * (p * r)) + 1 / 1200 * (p * eta)).
  { apply Rle_trans with (u * (1002 / 1000 * (p * r) + 1001 / 1000 * (p * eta))).
    - apply Rmult_le_compat_l; lra.
    - lra. }
  replace (q - n * w) with ((q - n' * w') + (n' * w' - n * w)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

(** The errors after the increments of a pass are added. Each line has an exact force [e], a computed one [c], the exact
    sum of its increments [r], and the computed one [q]. *)
Lemma sum_error : forall A (e c r q : A -> R) l B lost,
  over r l <= B -> over (fun t => e t + r t) l <= B ->
  over (fun t => q t - r t) l <= 301 / 100 * (u * over r l) + lost -> over (fun _ => eta) l <= lost ->
  over (fun t => transmitted (c t, q t) - (e t + r t)) l <=
    (1 + u) * over (fun t => c t - e t) l + 402 / 100 * (u * B) + 201 / 100 * lost.
Proof.
  intros A e c r q l B lost Hr Hs Hq Hl.
  set (E := over (fun t => c t - e t) l). assert (HE : 0 <= E) by apply norm_positive.
  assert (Hlost : 0 <= lost) by (apply Rle_trans with (2 := Hl); apply norm_positive).
  assert (HB : 0 <= B) by (apply Rle_trans with (2 := Hr); apply norm_positive).
  set (D := E + over (fun t => q t - r t) l).
  assert (D0 : 0 <= D) by (apply Rplus_le_le_0_compat; [exact HE | apply norm_positive]).
  assert (HD : over (fun t => (c t - e t) + (q t - r t)) l <= D) by apply over_triangle.
  assert (Hur : u * over r l <= u * B) by (apply Rmult_le_compat_l; lra).
  assert (Hx : 0 <= u * B <= 1 / 1300 * B) by (apply times_u; lra).
  assert (DD : D <= E + 301 / 100 * (u * B) + lost) by (unfold D; lra).
  assert (HuD : u * D <= u * E + 1 / 1300 * (301 / 100 * (u * B) + lost)).
  { apply Rle_trans with (u * (E + (301 / 100 * (u * B) + lost))); [apply Rmult_le_compat_l; lra |].
    rewrite Rmult_plus_distr_l. apply Rplus_le_compat_l. apply Rmult_le_compat_r; lra. }
  apply Rle_trans with (D + (u * (B + D) + lost)); [| lra].
  apply Rle_trans with (over (fun t => ((c t - e t) + (q t - r t)) + (transmitted (c t, q t) - (c t + q t))) l).
  { apply over_monotone. intros t _. apply Req_le. f_equal. ring. }
  apply Rle_trans with (1 := over_triangle _ _ _ _). apply Rplus_le_compat; [exact HD |].
  apply Rle_trans with (over (fun t => u * Rabs (c t + q t) + eta) l).
  { apply over_monotone. intros t _. unfold transmitted. apply Rle_trans with (1 := add_near (c t) (q t)). apply Rle_abs. }
  apply Rle_trans with (1 := over_triangle _ _ _ _). apply Rplus_le_compat; [| exact Hl].
  rewrite over_multiple by lra. apply Rmult_le_compat_l; [lra |].
  apply Rle_trans with (over (fun t => (e t + r t) + ((c t - e t) + (q t - r t))) l).
  { apply over_monotone. intros t _. rewrite Rabs_Rabsolu. apply Req_le. f_equal. ring. }
  apply Rle_trans with (1 := over_triangle _ _ _ _). lra.
Qed.

(** ** A whole sweep *)

(** A line with its exact and its computed force. *)
Definition error (t : R * R) : R := snd t - fst t.

Section Sweep.

(** [B] bounds the norm of all exact forces of a layer, and [lost] the errors by underflow in one step of a pass. *)
Variables B lost : R.
Hypothesis B_positive : 0 <= B.

(** The state after n passes and sums. A pass adds increments, and may turn the forces. The lines then continue to other
    spheres. *)
Inductive swept : nat -> list (R * R) -> Prop :=
| begins : forall l, (forall t, In t l -> t = (0, 0)) -> swept 0 l
| moves : forall n l k, swept n l -> Permutation l k -> swept n k
| passes : forall n (l : list nat) (e c r q : nat -> R),
    swept n (map (fun t => (e t, c t)) l) ->
    over r l <= B -> over (fun t => e t + r t) l <= B ->
    over (fun t => q t - r t) l <= 301 / 100 * (u * over r l) + lost -> over (fun _ => eta) l <= lost ->
    swept (S n) (map (fun t => (e t + r t, transmitted (c t, q t))) l)
| passes_and_turns : forall n (l : list nat) (e c r q : nat * direction -> R),
    swept n (map (fun t => (e t, c t)) (lines l)) ->
    over r (lines l) <= B -> over (fun t => e t + r t) (lines l) <= B ->
    over (fun t => q t - r t) (lines l) <= 301 / 100 * (u * over r (lines l)) + lost ->
    over (fun _ => eta) (lines l) <= lost ->
    swept (S n) (map (fun t => (exact_turn (fun t => e t + r t) t, computed_turn (fun t => transmitted (c t, q t)) t))
      (lines l)).

Lemma over_of_map : forall A (f g : A -> R) l, over error (map (fun t => (f t, g t)) l) = over (fun t => g t - f t) l.
Proof. intros. unfold over. rewrite map_map. reflexivity. Qed.

(** One pass: the error grows by the factor 1 + 10 u, and by 12.75 u B. *)
Lemma errors_of_passes : forall n l, swept n l -> 0 <= lost ->
  over error l <= INR n * (1275 / 100 * (u * B) + 86 / 10 * lost) * (1 + 10 * u) ^ n.
Proof.
  intros n l H Hlost. set (K := 1275 / 100 * (u * B) + 86 / 10 * lost).
  assert (HuB : 0 <= u * B) by (apply Rmult_le_pos; lra).
  assert (HK : 0 <= K) by (unfold K; lra).
  assert (Step : forall n E E1, E <= INR n * K * (1 + 10 * u) ^ n -> E1 <= (1 + 10 * u) * E + K ->
    E1 <= INR (S n) * K * (1 + 10 * u) ^ (S n)).
  { intros m E E1 HE H1. rewrite S_INR. simpl.
    assert (P : 1 <= (1 + 10 * u) * (1 + 10 * u) ^ m).
    { apply (pow_R1_Rle (1 + 10 * u) (S m)). lra. }
    assert (P1 : K * 1 <= K * ((1 + 10 * u) * (1 + 10 * u) ^ m)) by (apply Rmult_le_compat_l; trivial).
    assert (P2 : (1 + 10 * u) * E <= (1 + 10 * u) * (INR m * K * (1 + 10 * u) ^ m)) by (apply Rmult_le_compat_l; lra).
    apply Rle_trans with ((1 + 10 * u) * (INR m * K * (1 + 10 * u) ^ m) + K * ((1 + 10 * u) * (1 + 10 * u) ^ m)); [lra |].
    apply Req_le. ring. }
  induction H as [l H | n l k H IH P | n l e c r q H IH Hr Hs Hq Hl | n l e c r q H IH Hr Hs Hq Hl].
  - simpl. rewrite !Rmult_0_l. apply Req_le. induction l as [|t l IH]; [reflexivity |].
    unfold over. simpl. fold (over error l). rewrite IH by (intros; apply H; right; assumption).
    rewrite (H t) by (left; reflexivity). unfold error, hypot. simpl.
    replace ((0 - 0) * (0 - 0) + 0 * 0) with 0 by ring. apply sqrt_0.
  - replace (over error k) with (over error l); [exact IH |].
    apply norm_of_permutation. apply Permutation_map. exact P.
  - apply Step with (1 := IH). rewrite !over_of_map.
    apply Rle_trans with (1 := sum_error _ e c r q l B lost Hr Hs Hq Hl).
    assert (0 <= over (fun t => c t - e t) l) by apply norm_positive.
    assert (0 <= u * over (fun t => c t - e t) l) by (apply Rmult_le_pos; lra). unfold K. lra.
  - apply Step with (1 := IH). rewrite !over_of_map.
    set (e1 := fun t => e t + r t). set (c1 := fun t => transmitted (c t, q t)).
    apply Rle_trans with (1 := turn_error nat e1 c1 l lost Hl).
    assert (H1 := sum_error _ e c r q (lines l) B lost Hr Hs Hq Hl).
    fold (over (fun t => c1 t - e1 t) (lines l)) in H1.
    set (E := over (fun t => c t - e t) (lines l)) in *.
    set (E1 := over (fun t => c1 t - e1 t) (lines l)) in *.
    assert (HE : 0 <= E) by apply norm_positive. assert (HE1 : 0 <= E1) by apply norm_positive.
    assert (HE1' : E1 <= (1 + u) * E + 402 / 100 * (u * B) + 201 / 100 * lost) by exact H1.
    assert (Hc : over c1 (lines l) <= B + E1).
    { apply Rle_trans with (over (fun t => e1 t + (c1 t - e1 t)) (lines l)).
      - apply over_monotone. intros t _. apply Req_le. f_equal. ring.
      - apply Rle_trans with (1 := over_triangle _ _ _ _). apply Rplus_le_compat_r. exact Hs. }
    assert (Huc : u * over c1 (lines l) <= u * (B + E1)) by (apply Rmult_le_compat_l; lra).
    assert (HuE : 0 <= u * E <= 1 / 1300 * E) by (apply times_u; lra).
    assert (HuE1 : u * E1 <= u * E + 1 / 1300 * (u * E) + 1 / 1300 * (402 / 100 * (u * B) + 201 / 100 * lost)).
    { apply Rle_trans with (u * ((1 + u) * E + (402 / 100 * (u * B) + 201 / 100 * lost))); [apply Rmult_le_compat_l; lra |].
      rewrite Rmult_plus_distr_l. apply Rplus_le_compat; [| apply Rmult_le_compat_r; lra].
      replace (u * ((1 + u) * E)) with (u * E + u * (u * E)) by ring. apply Rplus_le_compat_l.
      apply Rmult_le_compat_r; lra. }
    unfold K. lra.
Qed.

(** (1 + x)^n <= 1 + n x (1 + n x), if n x <= 1. *)
Lemma power_bound : forall n x, 0 <= x -> INR n * x <= 1 -> (1 + x) ^ n <= 1 + INR n * x * (1 + INR n * x).
Proof.
  induction n as [|n IH]; intros x Hx H; [simpl; lra |].
  rewrite S_INR in *. set (m := INR n) in *. assert (Hm : 0 <= m) by apply pos_INR.
  assert (Hmx : 0 <= m * x <= 1) by (split; [apply Rmult_le_pos; trivial | lra]).
  specialize (IH x Hx (proj2 Hmx)). simpl.
  apply Rle_trans with ((1 + x) * (1 + m * x * (1 + m * x))); [apply Rmult_le_compat_l; lra |].
  assert (Q : m * x * (m * x) <= 1 * (m * x)) by (apply Rmult_le_compat_r; lra).
  assert (Q1 : x * (m * x * (m * x)) <= x * (m * x)) by (apply Rmult_le_compat_l; lra).
  assert (Q2 : 0 <= x * x) by (apply Rmult_le_pos; lra).
  assert (Q3 : 0 <= x * (m * x)) by (apply Rmult_le_pos; lra).
  replace ((m + 1) * x * (1 + (m + 1) * x)) with (m * x + x + m * x * (m * x) + 2 * (x * (m * x)) + x * x) by ring.
  replace ((1 + x) * (1 + m * x * (1 + m * x)))
    with (1 + x + m * x + m * x * (m * x) + x * (m * x) + x * (m * x * (m * x))) by ring.
  lra.
Qed.

(* quote src/forces/layers/layer.rs error_bound: BigRational::new(steps * 13, BigInt::one() << bits) *)
(* quote src/forces/layers/layer.rs error_bound: unit < BigRational::new(1.into(), 100.into()) *)
(* quote src/forces/layers/layer.rs error_bound: unit * greatest * BigRational::new(65.into(), 64.into()) *)
(* quote src/forces/layers/layer.rs error_bound: BigRational::new(pile.bound_of_sweep(self.k), pile.denominator() * 3) *)
Definition unit (steps : nat) : R := INR steps * 13 * u.
Definition error_bound (steps : nat) (greatest : R) : R := unit steps * greatest * (65 / 64).

(** The documented bound. [bound_of_sweep]/D is at least 2 sqrt(3) B, and [greatest] is a third of it. Each force of the
    layer is within the bound, if the underflow of one step loses at most a quarter of u B. *)
Theorem error_bound_holds : forall steps n l bound_of_sweep t,
  swept n l -> (n <= steps)%nat -> 2 * sqrt 3 * B <= bound_of_sweep -> unit steps < 1 / 100 ->
  0 <= lost <= / 4 * (u * B) -> In t l ->
  Rabs (error t) <= error_bound steps (bound_of_sweep / 3).
Proof.
  intros steps n l G t H Hn HG Hu Hl Ht.
  apply Rle_trans with (1 := over_each _ error l t Ht).
  apply Rle_trans with (1 := errors_of_passes n l H (proj1 Hl)).
  assert (HuB : 0 <= u * B) by (apply Rmult_le_pos; lra).
  apply le_INR in Hn. unfold unit in Hu. set (s := INR steps) in *. set (m := INR n) in *.
  assert (Hm : 0 <= m) by apply pos_INR.
  assert (Hmu : 0 <= m * u <= 1 / 1300).
  { split; [apply Rmult_le_pos; lra |]. apply Rle_trans with (s * u); [apply Rmult_le_compat_r; lra | lra]. }
  assert (P : (1 + 10 * u) ^ n <= 10078 / 10000).
  { apply Rle_trans with (1 := power_bound n (10 * u) ltac:(lra) ltac:(fold m; lra)). fold m.
    assert (m * (10 * u) * (m * (10 * u)) <= 1 / 130 * (1 / 130)) by (apply Rmult_le_compat; lra). lra. }
  assert (R3 : 1732 / 1000 <= sqrt 3).
  { rewrite <- (sqrt_square (1732 / 1000)) by lra. apply sqrt_le_1_alt. lra. }
  assert (HG' : 11546 / 10000 * B <= G / 3).
  { assert (1732 / 1000 * B <= sqrt 3 * B) by (apply Rmult_le_compat_r; lra). lra. }
  assert (HuG : 11546 / 10000 * (u * B) <= u * (G / 3)).
  { replace (11546 / 10000 * (u * B)) with (u * (11546 / 10000 * B)) by ring. apply Rmult_le_compat_l; lra. }
  assert (Q : m * (1275 / 100 * (u * B) + 86 / 10 * lost) * (1 + 10 * u) ^ n <=
    m * (149 / 10 * (u * B)) * (10078 / 10000)).
  { apply Rmult_le_compat; trivial.
    - apply Rmult_le_pos; lra.
    - apply pow_le. lra.
    - apply Rmult_le_compat_l; lra. }
  apply Rle_trans with (1 := Q). unfold error_bound, unit. fold s.
  assert (W : m * (13 * (65 / 64) * (u * (G / 3))) <= s * (13 * (65 / 64) * (u * (G / 3)))).
  { apply Rmult_le_compat_r; [| exact Hn]. lra. }
  assert (W1 : m * (149 / 10 * (10078 / 10000) * (u * B)) <= m * (13 * (65 / 64) * (u * (G / 3)))).
  { apply Rmult_le_compat_l; lra. }
  replace (s * 13 * u * (G / 3) * (65 / 64)) with (s * (13 * (65 / 64) * (u * (G / 3)))) by ring.
  lra.
Qed.

End Sweep.

End Rounding.
