(** Numbers of contacts, in total and by force; discs; piles in other dimensions. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa.
From Cannonpile Require Import Directions Sums Formulas Balance Straight Floor.

Open Scope Q_scope.

Ltac opened ::=
  unfold spheres_4, spheres_5, spheres_6, spheres_in_layer_4, spheres_in_layer_5, spheres_in_layer_6,
    contacts_2, contacts_4, contacts_5, contacts_6, contacts_of_strength_2, contacts_of_strength_4,
    contacts_of_strength_5, contacts_of_strength_6, weight_3, weight_4, weight_5, weight_6,
    from_axis_squared, on_floor, closed_form, brought, normal, place; formulas.

(** ** Contacts

    Each sphere above the floor has one contact below it in each of three directions; L = k+1. *)
Theorem contacts : forall k, total_over_pile k (fun _ _ _ => 3) == contacts_3 (n_of k + 1).
Proof.
  intros k.
  over_pile
    (fun k j x : Q => 3 * x)
    (fun k y : Q => (6 * k * y - 3 * y * y + 9 * y) * (1 # 2))
    (fun k : Q => (3 * k * k + 9 * k + 6) * (1 # 2))
    (fun x : Q => (x * x * x + 3 * x * x + 2 * x) * (1 # 2)).
  closed.
Qed.

Theorem contacts_are : forall L, 2 * contacts_3 L == L * (L - 1) * (L + 1).
Proof. intros. opened. ring. Qed.

(** 1 if a number is at least 1, or equals n; otherwise 0. *)
Definition some (x : Q) : Q := if Qle_bool 1 x then 1 else 0.
Definition exactly (n x : Q) : Q := if Qeq_bool x n then 1 else 0.

Lemma some_of_0 : forall x, x == 0 -> some x = 0.
Proof.
  intros x H. unfold some. destruct (Qle_bool 1 x) eqn:E; [|reflexivity].
  apply Qle_bool_iff in E. lra.
Qed.

Lemma some_of_more : forall x, 1 <= x -> some x = 1.
Proof. intros x H. unfold some. apply Qle_bool_iff in H. rewrite H. reflexivity. Qed.

Lemma n_of_positive : forall n, 1 <= n_of (S n).
Proof. intros. unfold n_of. change 1 with (q 1). rewrite <- Zle_Qle. lia. Qed.

Lemma n_of_not_negative : forall n, 0 <= n_of n.
Proof. intros. unfold n_of. change 0 with (q 0). rewrite <- Zle_Qle. lia. Qed.

(** The numbers from 0 to n contain n numbers that are at least 1, and so do those from n down to 0. *)
Lemma total_of_some : forall n, total (S n) (fun m => some (n_of m)) == n_of n.
Proof.
  induction n as [|n IH].
  - simpl. rewrite some_of_0 by reflexivity. reflexivity.
  - change (total (S (S n)) (fun m => some (n_of m))) with (total (S n) (fun m => some (n_of m)) + some (n_of (S n))).
    rewrite IH, some_of_more by apply n_of_positive. rewrite n_of_S. reflexivity.
Qed.

Lemma total_of_some_left : forall n x, x == n_of n -> total (S n) (fun m => some (x - n_of m)) == n_of n.
Proof.
  intros n x Hx. simpl. rewrite some_of_0 by (rewrite Hx; ring).
  rewrite (total_of_same n _ (fun _ => 1)).
  - rewrite (total_is (fun _ => 1) (fun x => x)); [ring | intros ? ? ?; assumption | reflexivity | intros; ring].
  - intros m Hm. rewrite some_of_more; [reflexivity|].
    assert (A : n_of (n - m) == n_of n - n_of m) by (apply n_of_sub; lia).
    destruct (n - m)%nat eqn:E; [lia|]. assert (B := n_of_positive n0). lra.
Qed.

(** Contacts counted from below: a sphere has one contact above it on each line with N >= 1. *)
Definition lines_above (i j k : Q) : Q :=
  let n := above i j k in some n.(alpha) + some n.(beta) + some n.(gamma).

Lemma lines_above_of_layer : forall k,
  total_over_layer k (fun i j => lines_above i j (n_of k)) == 3 * (n_of k * (n_of k + 1) * (1 # 2)).
Proof.
  intros k. unfold total_over_layer, lines_above, above. cbn [alpha beta gamma].
  transitivity (total (S k) (fun j => 2 * (n_of k - n_of j) + some (n_of j) * (n_of k - n_of j + 1))).
  - apply total_of_same. intros j Hj.
    replace (S k - j)%nat with (S (k - j)) by lia.
    rewrite total_of_sum, total_of_sum, total_of_some.
    rewrite (total_of_same _ _ (fun i => some ((n_of k - n_of j) - n_of i))).
    + rewrite total_of_some_left by (rewrite n_of_sub by lia; reflexivity).
      rewrite (total_of_same _ _ (fun _ => some (n_of j) * 1)) by (intros; ring).
      rewrite total_of_multiple.
      rewrite (total_is (fun _ => 1) (fun x => x)); [|intros ? ? ?; assumption | reflexivity | intros; ring].
      rewrite n_of_S, n_of_sub by lia. ring.
    + intros i _. unfold some. assert (E : n_of k - n_of i - n_of j == n_of k - n_of j - n_of i) by ring.
      rewrite E. reflexivity.
  - (* Row j = 0 has no line along gamma. *)
    assert (A : forall n, total (S n) (fun j => 2 * (n_of k - n_of j) + some (n_of j) * (n_of k - n_of j + 1))
      == 2 * n_of k + n_of n * (3 * n_of k + 1) - 3 * (n_of n * (n_of n + 1) * (1 # 2))).
    { induction n as [|n IH].
      - simpl. rewrite some_of_0 by reflexivity. rewrite n_of_0. ring.
      - change (total (S (S n)) ?f) with (total (S n) f + f (S n)). cbv beta. rewrite IH.
        rewrite some_of_more by apply n_of_positive. rewrite n_of_S. ring. }
    rewrite A. ring.
Qed.

Theorem contacts_from_below : forall L, total_over_pile L (fun i j k => lines_above i j k) == contacts_3 (n_of L).
Proof.
  intros L.
  apply (total_over_pile_is _ (fun k => 3 * (k * (k + 1) * (1 # 2))) contacts_3 lines_above_of_layer); closed.
Qed.

(** ** Contacts by force, on an equilateral base

    In layer k one contact along gamma of each sphere with j = n-1 has force n. There are k-n+2 of them. *)
Lemma exactly_is : forall n x, exactly n x = 1 /\ x == n \/ exactly n x = 0 /\ ~ x == n.
Proof.
  intros n x. unfold exactly. destruct (Qeq_bool x n) eqn:E.
  - left. split; [reflexivity | apply Qeq_bool_iff; exact E].
  - right. split; [reflexivity | apply Qeq_bool_neq; exact E].
Qed.

Lemma n_of_injective : forall m n, n_of m == n_of n -> m = n.
Proof. intros m n H. unfold n_of, Qeq in H. simpl in H. lia. Qed.

Lemma total_of_exactly : forall N m (g : nat -> Q),
  total N (fun j => exactly (n_of (S m)) (n_of j + 1) * g j) == if (m <? N)%nat then g m else 0.
Proof.
  induction N as [|N IH]; intros m g; [reflexivity|].
  change (total (S N) ?f) with (total N f + f N). cbv beta. rewrite IH.
  destruct (exactly_is (n_of (S m)) (n_of N + 1)) as [[E H] | [E H]]; rewrite E.
  - rewrite <- n_of_S in H. apply n_of_injective in H. assert (N = m) by lia. subst N.
    destruct (m <? m)%nat eqn:A; [apply Nat.ltb_lt in A; lia|].
    destruct (m <? S m)%nat eqn:B; [ring | apply Nat.ltb_nlt in B; lia].
  - assert (D : N <> m) by (intros ->; apply H; rewrite n_of_S; reflexivity).
    destruct (m <? N)%nat eqn:A, (m <? S N)%nat eqn:B; try ring;
      [apply Nat.ltb_lt in A; apply Nat.ltb_nlt in B | apply Nat.ltb_nlt in A; apply Nat.ltb_lt in B]; lia.
Qed.

(** The force that sphere (i, j, k) transmits along gamma. *)
Definition along_gamma (i j k : Q) : Q := (closed_form (1 # 2) i j k).(gamma).

Lemma strengths_of_layer : forall m k,
  total_over_layer k (fun i j => exactly (n_of (S m)) (along_gamma i j (n_of k)))
  == if (m <? S k)%nat then n_of k - n_of m + 1 else 0.
Proof.
  intros m k. unfold total_over_layer.
  transitivity (total (S k) (fun j => exactly (n_of (S m)) (n_of j + 1) * (n_of k - n_of j + 1))).
  - apply total_of_same. intros j Hj. replace (S k - j)%nat with (S (k - j)) by lia.
    rewrite (total_of_same _ _ (fun _ => exactly (n_of (S m)) (n_of j + 1) * 1)).
    + rewrite total_of_multiple.
      rewrite (total_is (fun _ => 1) (fun x => x)); [|intros ? ? ?; assumption | reflexivity | intros; ring].
      rewrite (n_of_S (k - j)), n_of_sub by lia. ring.
    + intros i _. unfold exactly, along_gamma, closed_form, brought.
      assert (E : (by_line transmitted (by_line force (above (n_of i) (n_of j) (n_of k)) (increments (1 # 2)))
                    (increments (1 # 2))).(gamma) == n_of j + 1) by (formulas; ring).
      rewrite E. ring.
  - apply (total_of_exactly (S k) m (fun j => n_of k - n_of j + 1)).
Qed.

(** (L-n)(L-n+1)/2 contacts of one direction have force n, n = 1 ... L-1. Here n = m+1, L = m+1+t. *)
Theorem strengths : forall m t,
  total_over_pile (m + t) (fun i j k => exactly (n_of (S m)) (along_gamma i j k))
  == contacts_of_strength_3 (n_of m + 1 + n_of t) (n_of (S m)).
Proof.
  intros m t. unfold total_over_pile.
  rewrite (total_of_same _ _ (fun k => if (m <? S k)%nat then n_of k - n_of m + 1 else 0))
    by (intros; apply strengths_of_layer).
  induction t as [|t IH].
  - rewrite Nat.add_0_r. transitivity 0; [|opened; rewrite n_of_0, n_of_S; ring].
    rewrite (total_of_same _ _ (fun _ => 0 * 1)).
    + rewrite total_of_multiple. ring.
    + intros k Hk. destruct (m <? S k)%nat eqn:A; [apply Nat.ltb_lt in A; lia | ring].
  - rewrite Nat.add_succ_r. change (total (S (m + t)) ?f) with (total (m + t) f + f (m + t)%nat). cbv beta.
    rewrite IH. destruct (m <? S (m + t))%nat eqn:A; [|apply Nat.ltb_nlt in A; lia].
    assert (E : n_of (m + t) == n_of m + n_of t)
      by (unfold n_of; rewrite Nat2Z.inj_add, inject_Z_plus; reflexivity).
    rewrite E. opened. rewrite !n_of_S. ring.
Qed.

(** The contacts with forces 1 ... L-1 are all contacts of one direction. Their forces sum to C(L+2, 4), with mean
    (L+2)/4, and the sum of squares is C(L+2, 4)(2L+1)/5; L = k+1. *)
Definition by_strength (k : nat) (g : Q -> Q) : Q :=
  total k (fun m => contacts_of_strength_3 (n_of k + 1) (n_of m + 1) * g (n_of m + 1)).

Theorem strengths_in_all : forall k,
  let L := n_of k + 1 in
  3 * by_strength k (fun _ => 1) == contacts_3 L /\
  24 * by_strength k (fun n => n) == (L + 2) * (L + 1) * L * (L - 1) /\
  4 * by_strength k (fun n => n) == (L + 2) * by_strength k (fun _ => 1) /\
  5 * by_strength k (fun n => n * n) == (2 * L + 1) * by_strength k (fun n => n).
Proof.
  intros k. cbv zeta. unfold by_strength.
  assert (A : forall L, total k (fun m => contacts_of_strength_3 L (n_of m + 1) * 1) ==
    (fun x => (3 * L * L * x - 3 * L * x * x + x * x * x - x) * (1 # 6)) (n_of k)).
  { intros L. apply (total_is (fun m => contacts_of_strength_3 L (m + 1) * 1) (fun x => (3 * L * L * x - 3 * L * x * x + x * x * x - x) * (1 # 6))); closed. }
  assert (B : forall L, total k (fun m => contacts_of_strength_3 L (n_of m + 1) * (n_of m + 1)) ==
    (fun x => (6 * L * L * x * x + 6 * L * L * x - 8 * L * x * x * x - 6 * L * x * x + 2 * L * x + 3 * x * x * x * x + 2
      * x * x * x - 3 * x * x - 2 * x) * (1 # 24)) (n_of k)).
  { intros L. apply (total_is (fun m => contacts_of_strength_3 L (m + 1) * (m + 1)) (fun x => (6 * L * L * x * x + 6 * L * L * x - 8 * L * x * x * x - 6 * L * x * x + 2 * L * x + 3 * x * x * x * x + 2
      * x * x * x - 3 * x * x - 2 * x) * (1 # 24))); closed. }
  assert (C : forall L, total k (fun m => contacts_of_strength_3 L (n_of m + 1) * ((n_of m + 1) * (n_of m + 1))) ==
    (fun x => (20 * L * L * x * x * x + 30 * L * L * x * x + 10 * L * L * x - 30 * L * x * x * x * x - 40 * L * x * x *
      x + 10 * L * x + 12 * x * x * x * x * x + 15 * x * x * x * x - 10 * x * x * x - 15 * x * x - 2 * x) * (1 #
      120)) (n_of k)).
  { intros L. apply (total_is (fun m => contacts_of_strength_3 L (m + 1) * ((m + 1) * (m + 1))) (fun x => (20 * L * L * x * x * x + 30 * L * L * x * x + 10 * L * L * x - 30 * L * x * x * x * x - 40 * L * x * x *
      x + 10 * L * x + 12 * x * x * x * x * x + 15 * x * x * x * x - 10 * x * x * x - 15 * x * x - 2 * x) * (1 #
      120))); closed. }
  rewrite A, B, C. clear A B C. opened. repeat split; ring.
Qed.

(** The sum by force equals the sum over the contacts. *)
Theorem sum_of_strengths : forall k,
  24 * total_over_pile k along_gamma == (n_of k + 3) * (n_of k + 2) * (n_of k + 1) * n_of k.
Proof.
  intros k. transitivity (24 * ((n_of k + 3) * (n_of k + 2) * (n_of k + 1) * n_of k * (1 # 24))); [|ring].
  apply Qmult_comp; [reflexivity|]. unfold along_gamma.
  over_pile
    (fun k j x : Q => j * x + x)
    (fun k y : Q => (3 * k * y * y + 3 * k * y - 2 * y * y * y + 3 * y * y + 5 * y) * (1 # 6))
    (fun k : Q => (k * k * k + 6 * k * k + 11 * k + 6) * (1 # 6))
    (fun x : Q => (x * x * x * x + 6 * x * x * x + 11 * x * x + 6 * x) * (1 # 24)).
  closed.
Qed.

(** ** Discs *)

(** A disc that receives a and b is in balance if and only if it transmits a + 1 and b + 1. *)
Theorem newton_of_discs : forall a b x y,
  let e := disc_directions in
  unbalanced (Three x y 0) e (Three a b 0) e (weight (increments 0)) =v= nothing <-> x == a + 1 /\ y == b + 1.
Proof.
  intros a b x y. cbv zeta. split.
  - intros H. cbv beta iota zeta delta [disc_directions] in H. formulas_in H. destruct H as (Hx & Hy & Hz). split; lra.
  - intros [Hx Hy]. formulas. repeat split; lra.
Qed.

Definition discs_brought (i k : Q) : three Q := by_line force (above i 0 k) (increments 0).

(** The closed form balances discs, as it balances spheres. *)
Theorem discs_are_in_balance : forall i k,
  let g := discs_brought i k in
  unbalanced (by_line transmitted g (increments 0)) disc_directions g disc_directions (weight (increments 0)) =v= nothing.
Proof. intros. unfold g, discs_brought. by_components. Qed.

Definition disc_on_floor (L i : Q) : vector :=
  support_load (discs_brought i (L - 1)) disc_directions (weight (increments 0)).

Theorem disc_base : forall L i,
  disc_on_floor L i =v= Vector (2 * i - (L - 1)) 0 (L + 1).
Proof. intros. unfold disc_on_floor, discs_brought. by_components. Qed.

Theorem discs_weigh : forall L,
  total L (fun i => (disc_on_floor (n_of L) (n_of i)).(along_z)) == 2 * spheres_2 (n_of L) /\
  total L (fun i => (disc_on_floor (n_of L) (n_of i)).(along_x)) == 0.
Proof.
  intros L. split.
  - rewrite (total_is (fun i => (disc_on_floor (n_of L) i).(along_z)) (fun x => (n_of L + 1) * x));
      unfold disc_on_floor, discs_brought; closed.
  - rewrite (total_is (fun i => (disc_on_floor (n_of L) i).(along_x)) (fun x => x * x - x * n_of L));
      unfold disc_on_floor, discs_brought; closed.
Qed.

(** ** Other dimensions

    In d dimensions a sphere has d supports, in the directions of the corners of a regular simplex. d times the
    horizontal part of direction m is d-1 along its own coordinate and -1 along each other one. *)
Definition horizontal_part (d c m : nat) : Q := if (m =? c)%nat then n_of d - 1 else - (1).

Lemma total_of_corners : forall d c n,
  total n (horizontal_part d c) == (if (c <? n)%nat then n_of d else 0) - n_of n.
Proof.
  intros d c. induction n as [|n IH]; [simpl; rewrite n_of_0; destruct (c <? 0)%nat eqn:A; [discriminate A | ring]|].
  change (total (S n) ?f) with (total n f + f n). rewrite IH, n_of_S. unfold horizontal_part.
  destruct (n =? c)%nat eqn:E, (c <? n)%nat eqn:A, (c <? S n)%nat eqn:B;
    rewrite ?Nat.eqb_eq, ?Nat.eqb_neq, ?Nat.ltb_lt, ?Nat.ltb_ge in *; try lia; ring.
Qed.

(** The reaction of the supports exceeds the forces from above by the weight d, and has no horizontal part, for all
    loads. *)
Theorem balance_in_any_dimension : forall d (g : nat -> Q),
  total d (fun m => transmitted (g m) 1 - g m) == n_of d /\
  forall c, (c < d)%nat -> total d (fun m => horizontal_part d c m * (transmitted (g m) 1 - g m)) == 0.
Proof.
  intros d g. split.
  - rewrite (total_of_same _ _ (fun _ => 1)) by (intros; opened; ring).
    rewrite (total_is (fun _ => 1) (fun x => x)); [reflexivity | intros ? ? ?; assumption | reflexivity | intros; ring].
  - intros c Hc. rewrite (total_of_same _ _ (horizontal_part d c)) by (intros; opened; ring).
    rewrite total_of_corners. apply Nat.ltb_lt in Hc. rewrite Hc. ring.
Qed.

(** The weight of a sphere is d. The force transmitted after n spheres is the force received after n+1. *)
Theorem weight_in_dimensions :
  weight_2 1 1 == 2 /\ weight_3 1 1 1 == 3 /\ weight_4 1 1 1 1 == 4 /\ weight_5 1 1 1 1 1 == 5 /\
  weight_6 1 1 1 1 1 1 == 6 /\ forall n w, transmitted (force n w) w == force (n + 1) w.
Proof. repeat split; intros; opened; ring. Qed.

(** For n_1 + ... + n_d = L-1 the normal force on the floor is L+d-1, in mg/d, under every sphere. *)
Theorem normal_in_any_dimension : forall d L (n : nat -> Q),
  total d n == L - 1 -> total d (fun m => force (n m) 1) + n_of d == L + n_of d - 1.
Proof.
  intros d L n H. rewrite (total_of_same _ _ n) by (intros; opened; ring). rewrite H. ring.
Qed.

Theorem increments_are_summed : forall a b c d e f,
  weight_2 a b == a + b /\ weight_3 a b c == a + b + c /\ weight_4 a b c d == a + b + c + d /\
  weight_5 a b c d e == a + b + c + d + e /\ weight_6 a b c d e f == a + b + c + d + e + f.
Proof. intros. repeat split; opened; ring. Qed.

(** A layer in d dimensions is a pile in d-1 dimensions, and the layers form the pile. *)
Theorem layers_are_piles : forall k,
  spheres_in_layer_2 k == k + 1 /\ spheres_in_layer_3 k == spheres_2 (k + 1) /\
  spheres_in_layer_4 k == spheres_3 (k + 1) /\ spheres_in_layer_5 k == spheres_4 (k + 1) /\
  spheres_in_layer_6 k == spheres_5 (k + 1).
Proof. intros. repeat split; opened; ring. Qed.

Theorem spheres_in_dimension_2 : forall L, total L (fun k => spheres_in_layer_2 (n_of k)) == spheres_2 (n_of L).
Proof. intros L. apply (total_is spheres_in_layer_2 spheres_2); closed. Qed.

Theorem spheres_in_dimension_3 : forall L, total L (fun k => spheres_in_layer_3 (n_of k)) == spheres_3 (n_of L).
Proof. intros L. apply (total_is spheres_in_layer_3 spheres_3); closed. Qed.

Theorem spheres_in_dimension_4 : forall L, total L (fun k => spheres_in_layer_4 (n_of k)) == spheres_4 (n_of L).
Proof. intros L. apply (total_is spheres_in_layer_4 spheres_4); closed. Qed.

Theorem spheres_in_dimension_5 : forall L, total L (fun k => spheres_in_layer_5 (n_of k)) == spheres_5 (n_of L).
Proof. intros L. apply (total_is spheres_in_layer_5 spheres_5); closed. Qed.

Theorem spheres_in_dimension_6 : forall L, total L (fun k => spheres_in_layer_6 (n_of k)) == spheres_6 (n_of L).
Proof. intros L. apply (total_is spheres_in_layer_6 spheres_6); closed. Qed.

(** C(L+d-1, d): the product of L, L+1, ..., L+d-1 divided by d!. *)
Fixpoint choose (d : nat) (L : Q) : Q :=
  match d with
  | O => 1
  | S m => choose m L * (L + n_of m) / (n_of m + 1)
  end.

Lemma n_of_S_is_not_0 : forall n, ~ n_of n + 1 == 0.
Proof. intros n. assert (N := n_of_not_negative n). lra. Qed.

(** L layers have C(L+d-1, d) spheres, for d from 2 to 6. *)
Theorem spheres_in_dimensions : forall L,
  spheres_2 L == choose 2 L /\ spheres_3 L == choose 3 L /\ spheres_4 L == choose 4 L /\
  spheres_5 L == choose 5 L /\ spheres_6 L == choose 6 L.
Proof.
  intros. cbn [choose]. rewrite ?n_of_S, ?n_of_0. repeat split; opened; field; repeat split; intro H; discriminate H.
Qed.

Lemma choose_of_next : forall d x, choose d (x + 1) * x == choose d x * (x + n_of d).
Proof.
  induction d as [|d IH]; intros x; cbn [choose]; [rewrite n_of_0; ring|].
  assert (N := n_of_S_is_not_0 d). transitivity (choose d (x + 1) * x * (x + 1 + n_of d) / (n_of d + 1)); [field; assumption|].
  rewrite IH, n_of_S. field. assumption.
Qed.

Lemma choose_respects : forall d, respects (choose d).
Proof.
  induction d as [|d IH]; intros x y H; cbn [choose]; [reflexivity|]. rewrite (IH x y H), H. reflexivity.
Qed.

(** In every dimension the layers form the pile: the sum of C(k+d, d) over k < L is C(L+d, d+1). *)
Theorem spheres_in_any_dimension : forall d L, total L (fun k => choose d (n_of k + 1)) == choose (S d) (n_of L).
Proof.
  intros d L. apply (total_is (fun k => choose d (k + 1)) (choose (S d))).
  - apply choose_respects.
  - induction d as [|d IH]; [cbn [choose]; rewrite n_of_0; reflexivity|].
    change (choose (S d) 0 * (0 + n_of (S d)) / (n_of (S d) + 1) == 0). rewrite IH. field. apply n_of_S_is_not_0.
  - intros x. cbn [choose]. assert (N := n_of_S_is_not_0 d).
    transitivity (choose d x * (x + n_of d) / (n_of d + 1) + choose d (x + 1)); [|reflexivity].
    rewrite <- (choose_of_next d x). field. assumption.
Qed.

(** The normal forces sum to the weight. *)
Theorem weight_arrives_in_dimensions : forall L,
  (L + 1) * spheres_in_layer_2 (L - 1) == 2 * spheres_2 L /\
  (L + 2) * spheres_in_layer_3 (L - 1) == 3 * spheres_3 L /\
  (L + 3) * spheres_in_layer_4 (L - 1) == 4 * spheres_4 L /\
  (L + 4) * spheres_in_layer_5 (L - 1) == 5 * spheres_5 L /\
  (L + 5) * spheres_in_layer_6 (L - 1) == 6 * spheres_6 L.
Proof. intros. repeat split; opened; ring. Qed.

(** Contacts: d below each sphere above the floor. The number of contacts of one direction with force n is the number
    of spheres of a layer. *)
Theorem contacts_in_dimensions : forall L,
  contacts_2 L == 2 * spheres_2 (L - 1) /\ contacts_3 L == 3 * spheres_3 (L - 1) /\
  contacts_4 L == 4 * spheres_4 (L - 1) /\ contacts_5 L == 5 * spheres_5 (L - 1) /\
  contacts_6 L == 6 * spheres_6 (L - 1).
Proof. intros. repeat split; opened; ring. Qed.

Theorem strengths_in_dimensions : forall L n,
  contacts_of_strength_2 L n == spheres_in_layer_2 (L - 1 - n) /\
  contacts_of_strength_3 L n == spheres_in_layer_3 (L - 1 - n) /\
  contacts_of_strength_4 L n == spheres_in_layer_4 (L - 1 - n) /\
  contacts_of_strength_5 L n == spheres_in_layer_5 (L - 1 - n) /\
  contacts_of_strength_6 L n == spheres_in_layer_6 (L - 1 - n).
Proof. intros. repeat split; opened; ring. Qed.
