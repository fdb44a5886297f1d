(** Sums over rows, layers and piles, by recursion; closed forms of sums of polynomials, for every length. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa.
From Cannonpile Require Import Directions.

Open Scope Q_scope.

(** f 0 + f 1 + ... + f (n-1). *)
Fixpoint total (n : nat) (f : nat -> Q) : Q :=
  match n with
  | O => 0
  | S m => total m f + f m
  end.

(** The sites 0 <= j <= k, 0 <= i <= k-j of layer k: a row for each j. *)
Definition total_over_layer (k : nat) (f : Q -> Q -> Q) : Q :=
  total (S k) (fun j => total (S k - j) (fun i => f (n_of i) (n_of j))).

(** The sum over all spheres of L layers. *)
Definition total_over_pile (L : nat) (f : Q -> Q -> Q -> Q) : Q :=
  total L (fun k => total_over_layer k (fun i j => f i j (n_of k))).

Lemma total_of_same : forall n f g,
  (forall m, (m < n)%nat -> f m == g m) -> total n f == total n g.
Proof.
  induction n as [|n IH]; intros f g H; simpl.
  - reflexivity.
  - rewrite (IH f g) by (intros; apply H; lia). rewrite (H n) by lia. reflexivity.
Qed.

Lemma total_of_sum : forall n f g, total n (fun m => f m + g m) == total n f + total n g.
Proof.
  induction n as [|n IH]; intros; simpl; [ring|]. rewrite IH. ring.
Qed.

Lemma total_of_multiple : forall n c f, total n (fun m => c * f m) == c * total n f.
Proof.
  induction n as [|n IH]; intros; simpl; [ring|]. rewrite IH. ring.
Qed.

(** ** Closed forms

    A sum over 0 <= x < n is P n, if P 0 = 0 and P (x+1) - P x is its term. So sums of polynomials are polynomials,
    for every n (Faulhaber). *)

Definition respects (P : Q -> Q) : Prop := forall x y, x == y -> P x == P y.

Theorem total_is : forall (f P : Q -> Q),
  respects P -> P 0 == 0 -> (forall x, P (x + 1) == P x + f x) ->
  forall n, total n (fun m => f (n_of m)) == P (n_of n).
Proof.
  intros f P HP H0 H n. induction n as [|n IH]; simpl.
  - symmetry. exact H0.
  - transitivity (P (n_of n) + f (n_of n)).
    + apply Qplus_comp; [exact IH | reflexivity].
    + rewrite <- H. apply HP. symmetry. apply n_of_S.
Qed.

(** The sum over layer k, if row j has the sum R j (k+1-j) and the rows before y have the sum S y. *)
Theorem total_over_layer_is : forall (f : Q -> Q -> Q) (R : Q -> Q -> Q) (S : Q -> Q) (k : nat),
  (forall j, respects (R j)) -> (forall j, R j 0 == 0) -> (forall j x, R j (x + 1) == R j x + f x j) ->
  respects S -> S 0 == 0 -> (forall y, S (y + 1) == S y + R y (n_of k + 1 - y)) ->
  total_over_layer k f == S (n_of k + 1).
Proof.
  intros f R S k HR HR0 HR1 HS HS0 HS1. unfold total_over_layer.
  transitivity (total (Datatypes.S k) (fun j => R (n_of j) (n_of k + 1 - n_of j))).
  - apply total_of_same. intros j Hj.
    transitivity (R (n_of j) (n_of (Datatypes.S k - j))).
    + exact (total_is (fun x => f x (n_of j)) (R (n_of j)) (HR (n_of j)) (HR0 (n_of j)) (HR1 (n_of j)) _).
    + apply HR. rewrite n_of_sub by lia. rewrite n_of_S. reflexivity.
  - transitivity (S (n_of (Datatypes.S k))).
    + exact (total_is (fun y => R y (n_of k + 1 - y)) S HS HS0 HS1 _).
    + apply HS. apply n_of_S.
Qed.

(** The sum over L layers, if layer k has the sum U k. *)
Theorem total_over_pile_is : forall (f : Q -> Q -> Q -> Q) (U T : Q -> Q),
  (forall k : nat, total_over_layer k (fun i j => f i j (n_of k)) == U (n_of k)) ->
  respects T -> T 0 == 0 -> (forall x, T (x + 1) == T x + U x) ->
  forall L, total_over_pile L f == T (n_of L).
Proof.
  intros f U T HU HT HT0 HT1 L. unfold total_over_pile.
  transitivity (total L (fun k => U (n_of k))).
  - apply total_of_same. intros k _. apply HU.
  - exact (total_is U T HT HT0 HT1 L).
Qed.

(** Sums of equal terms are equal. *)
Ltac congruent :=
  repeat first [assumption
               | match goal with |- ?a == ?a => reflexivity end
               | apply Qplus_comp | apply Qminus_comp | apply Qmult_comp | apply Qopp_comp].
