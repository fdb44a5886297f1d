(** Directions, signs and vectors: the types of the recorded formulas. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Qreduction.

(** The three contacts below a sphere. *)
Inductive direction := Alpha | Beta | Gamma.

(** The sign of a step from a layer to the one below. Under [Plus] sphere (i, j) is supported by (i, j), (i+1, j),
    (i, j+1), under [Minus] by (i, j), (i-1, j), (i, j-1). *)
Inductive sign := Plus | Minus.

(** One value for each direction. *)
Record three (A : Type) := Three { alpha : A; beta : A; gamma : A }.
Arguments Three {A} _ _ _.
Arguments alpha {A} _.
Arguments beta {A} _.
Arguments gamma {A} _.

(** A vector by its components along x sin theta, y 2 cos phi sin theta, z cos theta, z down. *)
Record vector := Vector { along_x : Q; along_y : Q; along_z : Q }.

Definition on {A} (d : direction) (t : three A) : A :=
  match d with Alpha => t.(alpha) | Beta => t.(beta) | Gamma => t.(gamma) end.

Definition each {A} (x : A) : three A := Three x x x.

Definition map {A B} (f : A -> B) (t : three A) : three B :=
  Three (f t.(alpha)) (f t.(beta)) (f t.(gamma)).

Definition by_line {A B C} (f : A -> B -> C) (s : three A) (t : three B) : three C :=
  Three (f s.(alpha) t.(alpha)) (f s.(beta) t.(beta)) (f s.(gamma) t.(gamma)).

Definition opposite (s : sign) : sign :=
  match s with Plus => Minus | Minus => Plus end.

Open Scope Q_scope.

Definition sum (t : three Q) : Q := t.(alpha) + t.(beta) + t.(gamma).

Definition nothing : vector := Vector 0 0 0.

(** Rationals as a ring whose numbers are reduced during [ring]; otherwise they would grow without limit. *)
Lemma reduced :
  ring_morph 0 1 Qplus Qmult Qminus Qopp Qeq 0 1
    (fun a b => Qred (a + b)) (fun a b => Qred (a * b)) (fun a b => Qred (a - b)) (fun a => Qred (- a))
    Qeq_bool (fun x => x).
Proof.
  constructor; intros; try apply Qred_correct; try reflexivity.
  apply Qeq_bool_eq; assumption.
Qed.
Add Ring reduced_rationals :
  Qsrt (morphism reduced, constants [Qcst], power_tac Qpower_theory [Qpow_tac]).

(** Equality as rationals, componentwise: 1/2 equals 2/4. *)
Definition same (s t : three Q) : Prop :=
  s.(alpha) == t.(alpha) /\ s.(beta) == t.(beta) /\ s.(gamma) == t.(gamma).

Definition same_vector (v w : vector) : Prop :=
  v.(along_x) == w.(along_x) /\ v.(along_y) == w.(along_y) /\ v.(along_z) == w.(along_z).

Infix "=3=" := same (at level 70) : Q_scope.
Infix "=v=" := same_vector (at level 70) : Q_scope.

#[export] Instance same_equivalence : Equivalence same.
Proof.
  split.
  - intros t; repeat split; reflexivity.
  - intros s t (a & b & c); repeat split; symmetry; assumption.
  - intros s t u (a & b & c) (a' & b' & c'); repeat split; etransitivity; eassumption.
Qed.

#[export] Instance same_vector_equivalence : Equivalence same_vector.
Proof.
  split.
  - intros t; repeat split; reflexivity.
  - intros s t (a & b & c); repeat split; symmetry; assumption.
  - intros s t u (a & b & c) (a' & b' & c'); repeat split; etransitivity; eassumption.
Qed.

(** An integer as a rational. *)
Notation q := inject_Z.

(** A number of layers or spheres as a rational. *)
Definition n_of (n : nat) : Q := inject_Z (Z.of_nat n).

Lemma n_of_0 : n_of 0 == 0.
Proof. reflexivity. Qed.

Lemma n_of_S : forall n, n_of (S n) == n_of n + 1.
Proof.
  intros n. unfold n_of. rewrite Nat2Z.inj_succ. unfold Z.succ. rewrite inject_Z_plus. reflexivity.
Qed.

Lemma n_of_sub : forall n m, (m <= n)%nat -> n_of (n - m) == n_of n - n_of m.
Proof.
  intros n m H. unfold n_of. rewrite Nat2Z.inj_sub by assumption. unfold Z.sub, Qminus.
  rewrite inject_Z_plus, inject_Z_opp. reflexivity.
Qed.
