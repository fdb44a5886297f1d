(** A pile as a finite list of spheres, with loads of any direction and horizontal contacts: its forces, bounds, and the
    elastic state. These are the statements of certificates. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool List.
From Cannonpile Require Import Directions Sums Formulas Balance Stackings Horizontal Loads Virtual.

Import ListNotations.
Open Scope Q_scope.

Set Default Proof Using "Type".

(** ** One sphere *)

(** The three kinds of piles: spheres on an equilateral base, a straight pile on an isosceles base without horizontal
    contacts, and discs. *)
Inductive kind := Equilateral | Isosceles (s : Q) | Discs.

Definition sine (kind : kind) : Q :=
  match kind with Equilateral => 1 # 2 | Isosceles s => s | Discs => 0 end.

Definition contact_directions (kind : kind) (sigma : sign) : three vector :=
  match kind with Discs => disc_directions_under sigma | _ => directions_under (sine kind) sigma end.

Definition own_increments (kind : kind) (load : vector) (sigma : sign) : three Q :=
  match kind with Discs => disc_load_increments load sigma | _ => load_increments load (sine kind) sigma end.

Definition turned (kind : kind) (from to : sign) (g : three Q) : three Q :=
  match kind with Equilateral => transferred from to g | _ => g end.

(** Discs have no contact gamma, and horizontal contacts along one axis. *)
Definition has_line (kind : kind) (d : direction) : bool :=
  match kind, d with Discs, Gamma => false | _, _ => true end.

Definition has_axis (kind : kind) (x : axis) : bool :=
  match kind, x with Equilateral, _ | Discs, AB => true | _, _ => false end.

(** No force acts along what is missing. *)
Definition on_lines (kind : kind) (g : three Q) : Prop := forall d, has_line kind d = false -> on d g == 0.
Definition push_along (x : pushes) (a : axis) : Q := match a with AB => x.(ab) | AG => x.(ag) | GB => x.(gb) end.
Definition on_axes (kind : kind) (x : pushes) : Prop := forall a, has_axis kind a = false -> push_along x a == 0.

(** Only spheres on an equilateral base change the sign of their steps, and discs have no load across their plane. *)
Definition fits (kind : kind) (from to : sign) (load : vector) : Prop :=
  match kind with
  | Equilateral => True
  | Isosceles s => ~ 1 + s == 0 /\ from = Plus /\ to = Plus
  | Discs => from = Plus /\ to = Plus /\ load.(along_y) == 0
  end.

(** The force of the neighbours: x along e_b - e_a, y along the reverse. *)
Definition push_of (kind : kind) (x y : pushes) : vector :=
  let along a b f := Horizontal.minus_three (map (Qmult f) (one_on b)) (map (Qmult f) (one_on a)) in
  combination (plus_three (plus_three (along Alpha Beta (x.(ab) - y.(ab))) (along Alpha Gamma (x.(ag) - y.(ag))))
                          (along Gamma Beta (x.(gb) - y.(gb)))) (contact_directions kind Plus).

(** The sum of all forces on a sphere: of its supports, the spheres above, its load, and its neighbours. *)
Definition forces_on (kind : kind) (from to : sign) (load : vector) (up g : three Q) (x y : pushes) : vector :=
  plus_vector (left_over (sine kind) load up (contact_directions kind to) g (contact_directions kind from)) (push_of kind x y).

(** What a sphere transmits: T g + w - sigma H. *)
Definition transmits (kind : kind) (from to : sign) (load : vector) (g : three Q) (x y : pushes) : three Q :=
  let t := turned kind from to g in
  let w := own_increments kind load to in
  let h := pushed_by x y in
  Three (beside t.(alpha) w.(alpha) h.(alpha) to) (beside t.(beta) w.(beta) h.(beta) to)
        (beside t.(gamma) w.(gamma) h.(gamma) to).

(** Newton's law: a sphere is in balance if and only if it transmits this. *)
Theorem law : forall kind from to load up g x y,
  fits kind from to load -> on_lines kind g -> on_axes kind x -> on_axes kind y ->
  (forces_on kind from to load up g x y =v= nothing /\ on_lines kind up
   <-> up =3= transmits kind from to load g x y).
Proof.
  intros kind from to [X Y w] [u v z] [a b c] [x1 x2 x3] [y1 y2 y3] F G Hx Hy.
  destruct kind as [|s|]; unfold fits in F.
  - clear G Hx Hy.
    unfold forces_on, transmits, left_over, under_load, push_of, contact_directions, turned, own_increments, pushed_by,
      transferred, directions_under, sine, plus_three, Horizontal.minus_three, one_on, plus_vector, combination.
    cbn [ab ag gb].
    destruct from, to; (split; [intros [H _]; formulas_in H; destruct H as (Hx & Hy & Hz); formulas; repeat split; lra
      | intros (Hx & Hy & Hz); split; [|intros d D; destruct d; discriminate D];
        formulas_in Hx; formulas_in Hy; formulas_in Hz; formulas; repeat split; lra]).
  - destruct F as (S & -> & ->).
    assert (X1 := Hx AB eq_refl). assert (X2 := Hx AG eq_refl). assert (X3 := Hx GB eq_refl).
    assert (Y1 := Hy AB eq_refl). assert (Y2 := Hy AG eq_refl). assert (Y3 := Hy GB eq_refl).
    cbn [push_along ab ag gb] in *. clear Hx Hy G.
    assert (L := loaded_sphere s Plus (Vector X Y w) (Three a b c) (Three u v z) S). cbv zeta in L.
    assert (P : forces_on (Isosceles s) Plus Plus (Vector X Y w) (Three u v z) (Three a b c)
        {| ab := x1; ag := x2; gb := x3 |} {| ab := y1; ag := y2; gb := y3 |}
      =v= left_over s (Vector X Y w) (Three u v z) (directions_under s Plus) (Three a b c) (directions_under s Plus)).
    { unfold forces_on, push_of, contact_directions, directions_under, sine, plus_vector, combination, plus_three,
        Horizontal.minus_three, one_on, same_vector. cbn [ab ag gb along_x along_y along_z].
      repeat split; formulas; rewrite X1, X2, X3, Y1, Y2, Y3; ring. }
    assert (T : transmits (Isosceles s) Plus Plus (Vector X Y w) (Three a b c)
        {| ab := x1; ag := x2; gb := x3 |} {| ab := y1; ag := y2; gb := y3 |}
      =3= by_line transmitted (Three a b c) (load_increments (Vector X Y w) s Plus)).
    { unfold transmits, turned, own_increments, pushed_by, plus_three, sine. cbn [ab ag gb].
      repeat split; formulas; rewrite ?X1, ?X2, ?X3, ?Y1, ?Y2, ?Y3; ring. }
    rewrite P, T, L. split; [tauto | intros H; split; [exact H | intros d D; destruct d; discriminate D]].
  - destruct F as (-> & -> & Y0). cbn [along_y] in Y0.
    assert (C := G Gamma eq_refl). assert (X2 := Hx AG eq_refl). assert (X3 := Hx GB eq_refl).
    assert (Y2 := Hy AG eq_refl). assert (Y3 := Hy GB eq_refl).
    cbn [push_along ab ag gb on alpha beta gamma] in *. clear Hx Hy G.
    unfold forces_on, transmits, left_over, under_load, push_of, contact_directions, turned, own_increments, pushed_by,
      disc_directions_under, sine, plus_three, Horizontal.minus_three, one_on, plus_vector, combination.
    cbn [ab ag gb]. cbv beta iota zeta delta [disc_directions].
    split.
    + intros [H Z]. specialize (Z Gamma eq_refl). cbn [on gamma] in Z.
      formulas_in H. destruct H as (Hx & Hy & Hz). formulas. repeat split; lra.
    + intros (Hx & Hy & Hz). formulas_in Hx. formulas_in Hy. formulas_in Hz.
      split; [formulas; repeat split; lra|].
      intros d D. destruct d; try discriminate D. cbn [on gamma]. lra.
Qed.

(** The balance of a sphere times phi. *)
Lemma work_on_one : forall kind from to load g x y phi,
  let h := pushed_by x y in
  dot phi (transmits kind from to load g x y) + times to (dot phi h)
  == dot g (turned kind from to phi) + dot phi (own_increments kind load to).
Proof.
  intros kind from to load [a b c] x y [u v z]. cbv zeta. unfold transmits.
  generalize (own_increments kind load to) as w. intros [w1 w2 w3]. generalize (pushed_by x y) as h. intros [h1 h2 h3].
  destruct kind, from, to; unfold turned, transferred, times, dot; formulas; ring.
Qed.

(** ** Sums *)

#[export] Instance times_of_same sigma : Proper (Qeq ==> Qeq) (times sigma).
Proof. intros x y H. destruct sigma; cbn [times]; rewrite H; reflexivity. Qed.

Section Sums.
Variable A : Type.
Variable same : forall p r : A, {p = r} + {p <> r}.

Definition is_in (l : list A) (p : A) : bool := if in_dec same p l then true else false.

Lemma is_in_iff : forall l p, is_in l p = true <-> In p l.
Proof. intros l p. unfold is_in. destruct (in_dec same p l); split; intros; try tauto; discriminate. Qed.

Lemma over_single : forall l p f, NoDup l -> over l (fun r => if same r p then f r else 0) == if is_in l p then f p else 0.
Proof.
  intros l p f N. induction N as [|r l H N IH]; cbn [over]; [reflexivity|]. rewrite IH.
  destruct (same r p) as [E | E].
  - subst r. replace (is_in (p :: l) p) with true by (symmetry; apply is_in_iff; left; reflexivity).
    replace (is_in l p) with false by (symmetry; apply not_true_iff_false; rewrite is_in_iff; exact H). ring.
  - replace (is_in (r :: l) p) with (is_in l p); [ring|].
    apply eq_true_iff_eq. rewrite !is_in_iff. simpl. tauto.
Qed.

Lemma over_of_difference : forall (l : list A) f g, over l (fun p => f p - g p) == over l f - over l g.
Proof.
  intros l f g. transitivity (over l f + - (1) * over l g); [|ring].
  rewrite <- over_of_multiple, <- over_of_sum. apply over_of_same. intros. ring.
Qed.

Lemma over_of_times : forall sigma (l : list A) f, over l (fun p => times sigma (f p)) == times sigma (over l f).
Proof.
  intros [] l f; cbn [times]; [reflexivity|]. transitivity (- (1) * over l f); [|ring].
  rewrite <- over_of_multiple. apply over_of_same. intros. ring.
Qed.

(** A sum over pairs of an element and its image can run over either. *)
Lemma over_either : forall (l : list A) there back f, NoDup l -> (forall p r, there r = p <-> r = back p) ->
  over l (fun p => if is_in l (back p) then f (back p) p else 0)
  == over l (fun r => if is_in l (there r) then f r (there r) else 0).
Proof.
  intros l there back f N H.
  transitivity (over l (fun p => over l (fun r => if same r (back p) then f r p else 0))).
  - apply over_of_same. intros p _. rewrite (over_single l (back p) (fun r => f r p) N). reflexivity.
  - rewrite over_in_any_order. apply over_of_same. intros r _.
    rewrite <- (over_single l (there r) (fun p => f r p) N). apply over_of_same. intros p _.
    destruct (same r (back p)) as [E | E], (same p (there r)) as [F | F]; try reflexivity.
    + apply H in E. congruence.
    + symmetry in F. apply H in F. contradiction.
Qed.
End Sums.

(** ** The pile

    A sphere is (k, (i, j)), with layer k counted from the top. *)
Definition sphere : Type := Z * site.

Definition same_sphere : forall p r : sphere, {p = r} + {p <> r}.
Proof. decide equality; [apply same_site | apply Z.eq_dec]. Defined.

Definition support_of (sigma : sign) (p : sphere) (d : direction) : sphere := ((fst p + 1)%Z, support sigma (snd p) d).
Definition above_of (sigma : sign) (p : sphere) (d : direction) : sphere :=
  ((fst p - 1)%Z, above_in sigma d (fst (snd p)) (snd (snd p))).
Definition next_of (x : axis) (p : sphere) : sphere := (fst p, next x (snd p)).
Definition last_of (x : axis) (p : sphere) : sphere := (fst p, last x (snd p)).

Lemma next_or_last : forall x p r, next_of x r = p <-> r = last_of x p.
Proof.
  intros x [k p] [m r]. unfold next_of, last_of. cbn [fst snd].
  split; intros E; injection E; intros E' K; rewrite K; f_equal; apply next_and_last; exact E'.
Qed.

Section Pile.
Variable of_kind : kind.
(** The sign of the step below a layer. *)
Variable step : Z -> sign.
(** The spheres above the floor, each once. *)
Variable spheres : list sphere.
Variable load : sphere -> vector.

(** Membership in this list. A checker looks it up in a tree. *)
Variable has : sphere -> bool.

Definition step_over (p : sphere) : sign := step (fst p - 1).
Definition step_under (p : sphere) : sign := step (fst p).

(** Action and reaction: the forces that a sphere receives from those above it. *)
Definition arriving_at (f : sphere -> three Q) (p : sphere) : three Q :=
  let along d := let r := above_of (step_over p) p d in if has_line of_kind d && has r then on d (f r) else 0 in
  Three (along Alpha) (along Beta) (along Gamma).

(** Two spheres of a layer touch if both exist. X x p is the force of p and its next sphere along the axis x. *)
Definition touching (x : axis) (p : sphere) : bool := has_axis of_kind x && has (next_of x p).
Definition push_next (X : axis -> sphere -> Q) (p : sphere) (x : axis) : Q := if touching x p then X x p else 0.
Definition push_last (X : axis -> sphere -> Q) (p : sphere) (x : axis) : Q :=
  if has_axis of_kind x && has (last_of x p) then X x (last_of x p) else 0.

Definition balanced (f : sphere -> three Q) (X : axis -> sphere -> Q) (p : sphere) : Prop :=
  forces_on of_kind (step_over p) (step_under p) (load p) (f p) (arriving_at f p) (six (push_next X p)) (six (push_last X p))
    =v= nothing
  /\ on_lines of_kind (f p).

Definition equilibrium_of (f : sphere -> three Q) (X : axis -> sphere -> Q) : Prop :=
  forall p, In p spheres -> balanced f X p.

(** No contact is tensile. *)
Definition compressive (f : sphere -> three Q) (X : axis -> sphere -> Q) : Prop :=
  forall p, In p spheres -> (forall d, 0 <= on d (f p)) /\ (forall x, touching x p = true -> 0 <= X x p).

Definition transmits_at (f : sphere -> three Q) (X : axis -> sphere -> Q) (p : sphere) : three Q :=
  transmits of_kind (step_over p) (step_under p) (load p) (arriving_at f p) (six (push_next X p)) (six (push_last X p)).

Hypothesis has_iff : forall p, has p = true <-> In p spheres.
Hypothesis once : NoDup spheres.
Hypothesis from_the_top : forall p, In p spheres -> (0 <= fst p)%Z.
Hypothesis all_fit : forall p, In p spheres -> fits of_kind (step_over p) (step_under p) (load p).

Lemma has_is : forall p, has p = is_in sphere same_sphere spheres p.
Proof using has_iff. intros p. apply eq_true_iff_eq. rewrite has_iff, is_in_iff. reflexivity. Qed.

(** A sum over pairs of neighbours can run over either of the two. *)
Lemma over_pairs : forall there back f, (forall p r, there r = p <-> r = back p) ->
  over spheres (fun p => if has (back p) then f (back p) p else 0)
  == over spheres (fun r => if has (there r) then f r (there r) else 0).
Proof using has_iff once.
  intros there back f H.
  transitivity (over spheres (fun p => if is_in sphere same_sphere spheres (back p) then f (back p) p else 0)).
  - apply over_of_same. intros p _. rewrite has_is. reflexivity.
  - rewrite (over_either sphere same_sphere spheres there back f once H). apply over_of_same. intros r _.
    rewrite has_is. reflexivity.
Qed.

Lemma arriving_on_lines : forall f p, on_lines of_kind (arriving_at f p).
Proof. intros f p d D. destruct d; cbn [arriving_at on alpha beta gamma]; rewrite D; reflexivity. Qed.

Lemma pushes_on_axes : forall X p,
  on_axes of_kind (six (push_next X p)) /\ on_axes of_kind (six (push_last X p)).
Proof.
  intros X p. split; intros a A; destruct a; cbn [push_along six ab ag gb]; unfold push_next, push_last, touching;
    rewrite A; reflexivity.
Qed.

Theorem balance_is_transmission : forall f X p, In p spheres -> (balanced f X p <-> f p =3= transmits_at f X p).
Proof using all_fit.
  intros f X p H. destruct (pushes_on_axes X p). apply law; try assumption; [apply all_fit; exact H | apply arriving_on_lines].
Qed.

(** The horizontal forces determine all others. *)
Theorem forces_are_unique : forall f g X, equilibrium_of f X -> equilibrium_of g X ->
  forall p, In p spheres -> f p =3= g p.
Proof using has_iff all_fit from_the_top.
  intros f g X F G.
  assert (N : forall n p, In p spheres -> fst p = Z.of_nat n -> f p =3= g p).
  { induction n as [n IH] using lt_wf_ind. intros p H K.
    rewrite (proj1 (balance_is_transmission f X p H) (F p H)), (proj1 (balance_is_transmission g X p H) (G p H)).
    unfold transmits_at.
    assert (A : arriving_at f p =3= arriving_at g p).
    { assert (D : forall d, on d (arriving_at f p) == on d (arriving_at g p)).
      { intros d. assert (E : forall h, on d (arriving_at h p) =
          if has_line of_kind d && has (above_of (step_over p) p d) then on d (h (above_of (step_over p) p d)) else 0)
          by (intros; destruct d; reflexivity).
        rewrite !E. destruct (has_line of_kind d && has (above_of (step_over p) p d)) eqn:B; [|reflexivity].
        apply andb_true_iff in B. destruct B as [_ B]. apply has_iff in B.
        assert (R := from_the_top _ B). unfold above_of in R. cbn [fst] in R.
        destruct (IH (Z.to_nat (fst p - 1)) ltac:(lia) _ B ltac:(unfold above_of; cbn [fst]; lia)) as (a & b & c).
        destruct d; cbn [on]; assumption. }
      exact (conj (D Alpha) (conj (D Beta) (D Gamma))). }
    destruct A as (a & b & c). unfold transmits, turned.
    destruct of_kind, (step_over p), (step_under p); unfold transferred; repeat split; formulas; congruent. }
  intros p H. apply (N (Z.to_nat (fst p)) p H). specialize (from_the_top p H). lia.
Qed.

(** ** Virtual work, for any numbers phi *)

Section Work.
Variable phi : sphere -> three Q.

(** T phi, which is zero on the floor. *)
Definition felt_at (p : sphere) : three Q :=
  if has p then turned of_kind (step_over p) (step_under p) (phi p) else each 0.

Definition drop_of (p : sphere) (d : direction) : Q :=
  contact_drop (on d (phi p)) (on d (felt_at (support_of (step_under p) p d))).

Definition squeeze_of (x : axis) (p : sphere) : Q :=
  compression (phi p) (phi (next_of x p)) (from x) (to x) (step_under p).

Definition work_of_loads : Q := over spheres (fun p => dot (phi p) (own_increments of_kind (load p) (step_under p))).

Definition drops_of (p : sphere) : three Q := Three (drop_of p Alpha) (drop_of p Beta) (drop_of p Gamma).

Definition along_axis (X : axis -> sphere -> Q) (p : sphere) (x : axis) : Q := if touching x p then X x p * squeeze_of x p else 0.
Definition work_beside (X : axis -> sphere -> Q) (p : sphere) : Q := along_axis X p AB + along_axis X p AG + along_axis X p GB.

Lemma work_along : forall X x,
  over spheres (fun p => times (step_under p) (dot (phi p) (pushed (push_next X p x) (from x) (to x) true)
    + dot (phi p) (pushed (push_last X p x) (from x) (to x) false)))
  == over spheres (fun p => along_axis X p x).
Proof using has_iff once.
  intros X x. destruct (has_axis of_kind x) eqn:A.
  2: { apply over_of_same. intros p _. unfold push_next, push_last, along_axis, touching. rewrite A. cbn [andb].
       destruct (step_under p), x; unfold times, dot; cbn [from to]; formulas; ring. }
  pose (there := fun r p : sphere => times (step_under p) (dot (phi p) (pushed (X x r) (from x) (to x) false))).
  transitivity (over spheres (fun p => times (step_under p) (dot (phi p) (pushed (push_next X p x) (from x) (to x) true)))
    + over spheres (fun p => if has (last_of x p) then there (last_of x p) p else 0)).
  - rewrite <- over_of_sum. apply over_of_same. intros p _. unfold push_last, there. rewrite A. cbn [andb].
    destruct (has (last_of x p)), (step_under p), x; unfold times, dot; cbn [from to]; formulas; ring.
  - rewrite (over_pairs (next_of x) (last_of x) there (next_or_last x)), <- over_of_sum. apply over_of_same. intros p _.
    unfold push_next, along_axis, touching, there. rewrite A. cbn [andb].
    destruct (has (next_of x p)).
    + assert (W := work_of_a_horizontal_contact (from x) (to x) (step_under p) (phi p) (phi (next_of x p)) (X x p)).
      unfold squeeze_of. rewrite (Qmult_comm (X x p)). rewrite <- W by (destruct x; discriminate).
      replace (step_under (next_of x p)) with (step_under p) by reflexivity.
      destruct (step_under p); unfold times; ring.
    + destruct (step_under p), x; unfold times, dot; cbn [from to]; formulas; ring.
Qed.

Lemma support_or_above : forall d p r, support_of (step_under r) r d = p <-> r = above_of (step_over p) p d.
Proof.
  intros d [k p] [m r]. unfold support_of, above_of, step_under, step_over. cbn [fst snd].
  split; intros E; injection E; intros E' K.
  - assert (M : (k - 1)%Z = m) by lia. rewrite M. apply (f_equal2 pair); [reflexivity|].
    apply support_and_above. exact E'.
  - rewrite <- K in E'. apply (f_equal2 pair); [lia|]. rewrite K. apply support_and_above. rewrite <- K. exact E'.
Qed.

(** The forces received along a line are those transmitted along it. *)
Lemma received_along : forall f d, (forall p, In p spheres -> on_lines of_kind (f p)) ->
  over spheres (fun p => on d (arriving_at f p) * on d (turned of_kind (step_over p) (step_under p) (phi p)))
  == over spheres (fun r => on d (f r) * on d (felt_at (support_of (step_under r) r d))).
Proof using has_iff once.
  intros f d F.
  transitivity (over spheres (fun p => if has (above_of (step_over p) p d)
    then (fun r p => (if has_line of_kind d then on d (f r) else 0) * on d (felt_at p)) (above_of (step_over p) p d) p else 0)).
  - apply over_of_same. intros p H.
    assert (E : on d (arriving_at f p) =
      if has_line of_kind d && has (above_of (step_over p) p d) then on d (f (above_of (step_over p) p d)) else 0)
      by (destruct d; reflexivity).
    rewrite E. unfold felt_at. replace (has p) with true by (symmetry; apply has_iff; exact H).
    destruct (has_line of_kind d), (has (above_of (step_over p) p d)); cbn [andb]; ring.
  - rewrite (over_pairs (fun r => support_of (step_under r) r d) (fun p => above_of (step_over p) p d)
      (fun r p => (if has_line of_kind d then on d (f r) else 0) * on d (felt_at p)) (support_or_above d)).
    apply over_of_same. intros r H.
    assert (L : (if has_line of_kind d then on d (f r) else 0) == on d (f r)).
    { destruct (has_line of_kind d) eqn:D; [reflexivity | symmetry; exact (F r H d D)]. }
    unfold felt_at. destruct (has (support_of (step_under r) r d)).
    + rewrite L. reflexivity.
    + destruct d; cbn [each on alpha beta gamma]; ring.
Qed.

(** Virtual work: the work of all contacts equals that of the loads. *)
Theorem works_are_equal : forall f X, equilibrium_of f X ->
  over spheres (fun p => dot (f p) (drops_of p)) + over spheres (work_beside X) == work_of_loads.
Proof using has_iff once all_fit.
  intros f X E.
  assert (F : forall p, In p spheres -> on_lines of_kind (f p)) by (intros p H; apply (E p H)).
  assert (S : over spheres (fun p => dot (phi p) (f p)) + over spheres (work_beside X)
    == over spheres (fun p => dot (arriving_at f p) (turned of_kind (step_over p) (step_under p) (phi p))) + work_of_loads).
  { unfold work_beside. rewrite !over_of_sum. rewrite <- !work_along. unfold work_of_loads. rewrite <- !over_of_sum.
    apply over_of_same. intros p H. assert (B := proj1 (balance_is_transmission f X p H) (E p H)).
    rewrite (dot_of_same _ _ _ B). unfold transmits_at.
    rewrite <- (work_on_one of_kind (step_over p) (step_under p) (load p) (arriving_at f p)
      (six (push_next X p)) (six (push_last X p)) (phi p)).
    rewrite work_of_six. reflexivity. }
  assert (R : over spheres (fun p => dot (arriving_at f p) (turned of_kind (step_over p) (step_under p) (phi p)))
    == over spheres (fun r => on Alpha (f r) * on Alpha (felt_at (support_of (step_under r) r Alpha)))
     + over spheres (fun r => on Beta (f r) * on Beta (felt_at (support_of (step_under r) r Beta)))
     + over spheres (fun r => on Gamma (f r) * on Gamma (felt_at (support_of (step_under r) r Gamma)))).
  { rewrite <- !received_along by exact F. rewrite <- !over_of_sum. apply over_of_same. intros p _. reflexivity. }
  assert (D : over spheres (fun p => dot (phi p) (f p)) == over spheres (fun p => dot (f p) (drops_of p))
     + over spheres (fun r => on Alpha (f r) * on Alpha (felt_at (support_of (step_under r) r Alpha)))
     + over spheres (fun r => on Beta (f r) * on Beta (felt_at (support_of (step_under r) r Beta)))
     + over spheres (fun r => on Gamma (f r) * on Gamma (felt_at (support_of (step_under r) r Gamma)))).
  { rewrite <- !over_of_sum. apply over_of_same. intros p _. unfold drops_of, drop_of, dot, on. formulas. ring. }
  rewrite D, R in S. clear D R. lra.
Qed.

(** The sum of f D + X c over all contacts has the sign of its terms. *)
Lemma works_are_not_negative : forall (sigma : sign) f X (wanted : sphere -> direction -> Q), compressive f X ->
  (forall p d, In p spheres -> 0 <= times sigma (drop_of p d - wanted p d) \/ on d (f p) == 0) ->
  (forall p x, In p spheres -> touching x p = true -> 0 <= times sigma (squeeze_of x p)) ->
  0 <= times sigma (over spheres (fun p => dot (f p) (drops_of p)) + over spheres (work_beside X)
    - over spheres (fun p => dot (f p) (Three (wanted p Alpha) (wanted p Beta) (wanted p Gamma)))).
Proof.
  intros sigma f X wanted P D C.
  assert (S : 0 <= over spheres (fun p => times sigma (dot (f p) (drops_of p)
    - dot (f p) (Three (wanted p Alpha) (wanted p Beta) (wanted p Gamma))))).
  { apply over_is_not_negative. intros p H. destruct (P p H) as [N _].
    assert (T : forall d, 0 <= on d (f p) * times sigma (drop_of p d - wanted p d)).
    { intros d. destruct (D p d H) as [G | Z]; [apply Qmult_le_0_compat; [apply N | exact G] | rewrite Z; lra]. }
    assert (Ta := T Alpha). assert (Tb := T Beta). assert (Tg := T Gamma).
    unfold drops_of, dot, sum, by_line, on, times in *. cbn [alpha beta gamma] in *. destruct sigma; lra. }
  assert (B : 0 <= over spheres (fun p => times sigma (work_beside X p))).
  { apply over_is_not_negative. intros p H. destruct (P p H) as [_ N].
    assert (T : forall x, 0 <= times sigma (along_axis X p x)).
    { intros x. unfold along_axis. destruct (touching x p) eqn:Q; [|destruct sigma; unfold times; lra].
      assert (Y := Qmult_le_0_compat _ _ (N x Q) (C p x H Q)). destruct sigma; unfold times in *; lra. }
    assert (Ta := T AB). assert (Tb := T AG). assert (Tg := T GB). unfold work_beside, times in *. destruct sigma; lra. }
  rewrite over_of_times in S, B. rewrite over_of_difference in S. destruct sigma; cbn [times] in *; lra.
Qed.

(** ** Bounds of the load on a bottom sphere *)

Definition bears_on (b : sphere) (p : sphere) (d : direction) : Q :=
  if has_line of_kind d && (if same_sphere (support_of (step_under p) p d) b then true else false) then 1 else 0.

(** What the spheres above transmit to it. *)
Definition load_on_floor (f : sphere -> three Q) (b : sphere) : Q := sum (arriving_at f b).

Lemma load_is_a_sum : forall f b,
  load_on_floor f b == over spheres (fun p => dot (f p) (Three (bears_on b p Alpha) (bears_on b p Beta) (bears_on b p Gamma))).
Proof using has_iff once.
  intros f b.
  assert (L : forall d, on d (arriving_at f b) == over spheres (fun p => on d (f p) * bears_on b p d)).
  { intros d.
    assert (E : on d (arriving_at f b) =
      if has_line of_kind d && has (above_of (step_over b) b d) then on d (f (above_of (step_over b) b d)) else 0)
      by (destruct d; reflexivity).
    rewrite E. destruct (has_line of_kind d) eqn:D; cbn [andb].
    - rewrite has_is.
      rewrite <- (over_single sphere same_sphere spheres (above_of (step_over b) b d) (fun r => on d (f r)) once).
      apply over_of_same. intros p _. unfold bears_on. rewrite D. cbn [andb].
      destruct (same_sphere p (above_of (step_over b) b d)) as [A | A],
        (same_sphere (support_of (step_under p) p d) b) as [B | B]; try ring.
      + destruct B. apply support_or_above. exact A.
      + destruct A. apply support_or_above. exact B.
    - rewrite <- (over_of_nothing _ spheres). apply over_of_same. intros p _. unfold bears_on. rewrite D. cbn [andb]. ring. }
  unfold load_on_floor. transitivity (on Alpha (arriving_at f b) + on Beta (arriving_at f b) + on Gamma (arriving_at f b)).
  - reflexivity.
  - rewrite !L, <- !over_of_sum. apply over_of_same. intros p _. unfold dot, on. formulas. ring.
Qed.

(** No compressive forces in equilibrium press on b with more (less) than the work of the loads. *)
Theorem bound_on_floor : forall sigma b f X, equilibrium_of f X -> compressive f X ->
  (forall p d, In p spheres -> has_line of_kind d = true -> 0 <= times sigma (drop_of p d - bears_on b p d)) ->
  (forall p x, In p spheres -> touching x p = true -> 0 <= times sigma (squeeze_of x p)) ->
  0 <= times sigma (work_of_loads - load_on_floor f b).
Proof using has_iff once all_fit.
  intros sigma b f X E P D C. rewrite <- (works_are_equal f X E), load_is_a_sum.
  apply works_are_not_negative; [exact P | | exact C].
  intros p d H. destruct (has_line of_kind d) eqn:L; [left; exact (D p d H L) | right; apply (proj2 (E p H) d L)].
Qed.

(** A certificate that no compressive forces are in equilibrium. *)
Theorem never_stands : 0 < work_of_loads ->
  (forall p d, In p spheres -> has_line of_kind d = true -> drop_of p d <= 0) ->
  (forall p x, In p spheres -> touching x p = true -> squeeze_of x p <= 0) ->
  forall f X, equilibrium_of f X -> ~ compressive f X.
Proof using has_iff once all_fit.
  intros W D C f X E P.
  assert (N := works_are_not_negative Minus f X (fun _ _ => 0) P).
  rewrite (works_are_equal f X E) in N. cbn [times] in N.
  assert (O : over spheres (fun p => dot (f p) (Three 0 0 0)) == 0).
  { rewrite <- (over_of_nothing _ spheres). apply over_of_same. intros p _. unfold dot. formulas. ring. }
  rewrite O in N.
  assert (0 <= - (work_of_loads - 0)); [|lra]. apply N.
  - intros p d H. destruct (has_line of_kind d) eqn:L; [left; specialize (D p d H L); lra | right; apply (proj2 (E p H) d L)].
  - intros p x H T. specialize (C p x H T). lra.
Qed.

(** ** The elastic state

    The energy is the sum of f^2 and of X^2 / c, for contacts whose stiffnesses have the ratio c = horizontal over
    sloping. *)
Definition square_beside (X : axis -> sphere -> Q) (p : sphere) : Q :=
  let along x := if touching x p then X x p * X x p else 0 in along AB + along AG + along GB.

Definition energy_of (ratio : Q) (f : sphere -> three Q) (X : axis -> sphere -> Q) : Q :=
  ratio * over spheres (fun p => dot (f p) (f p)) + over spheres (square_beside X).

(** The conditions: D is f, and at most 0 at open contacts; ratio c is X, and at most 0 at open contacts. *)
Definition optimal (ratio : Q) (f : sphere -> three Q) (X : axis -> sphere -> Q) : Prop :=
  (forall p d, In p spheres -> has_line of_kind d = true ->
    drop_of p d <= on d (f p) /\ (on d (f p) == 0 \/ drop_of p d == on d (f p))) /\
  (forall p x, In p spheres -> touching x p = true ->
    ratio * squeeze_of x p <= X x p /\ (X x p == 0 \/ ratio * squeeze_of x p == X x p)).

Lemma half_square : forall a b d, 0 <= b -> d <= a -> a == 0 \/ d == a ->
  a * a + 2 * (d * b - d * a) <= b * b.
Proof.
  intros a b d Hb Hd O.
  assert (Q : forall x : Q, 0 <= x * x) by (intros; nra). assert (S := Q (b - a)).
  assert (P : 0 <= (a - d) * b) by (apply Qmult_le_0_compat; lra).
  assert (Z : (a - d) * a == 0) by (destruct O as [O | O]; rewrite O; ring).
  assert (E : b * b == a * a + 2 * (d * b - d * a) + (b - a) * (b - a) + 2 * ((a - d) * b) - 2 * ((a - d) * a)) by ring.
  rewrite E, Z. lra.
Qed.

Theorem least_energy : forall ratio f X g Y, 0 < ratio ->
  equilibrium_of f X -> compressive f X -> optimal ratio f X -> equilibrium_of g Y -> compressive g Y ->
  energy_of ratio f X <= energy_of ratio g Y.
Proof using has_iff once all_fit.
  intros ratio f X g Y R Ef Pf [Of OX] Eg Pg.
  assert (Wf := works_are_equal f X Ef). assert (Wg := works_are_equal g Y Eg).
  assert (S : 0 <= over spheres (fun p => (dot (g p) (g p) - dot (f p) (f p))
    - 2 * (dot (g p) (drops_of p) - dot (f p) (drops_of p)))).
  { apply over_is_not_negative. intros p H.
    assert (T : forall d, on d (f p) * on d (f p) + 2 * (drop_of p d * on d (g p) - drop_of p d * on d (f p)) <= on d (g p) * on d (g p)).
    { intros d. destruct (has_line of_kind d) eqn:L.
      - destruct (Of p d H L) as [A B]. apply half_square; [apply (proj1 (Pg p H)) | exact A | exact B].
      - assert (A := proj2 (Ef p H) d L). assert (B := proj2 (Eg p H) d L). rewrite A, B. lra. }
    assert (Ta := T Alpha). assert (Tb := T Beta). assert (Tg := T Gamma).
    unfold drops_of, dot, by_line, sum. cbn [on alpha beta gamma] in *. lra. }
  assert (B : 0 <= over spheres (fun p => (square_beside Y p - square_beside X p)
    - 2 * ratio * (work_beside Y p - work_beside X p))).
  { apply over_is_not_negative. intros p H.
    assert (T : forall x, 0 <= (if touching x p then Y x p * Y x p else 0) - (if touching x p then X x p * X x p else 0)
      - 2 * ratio * (along_axis Y p x - along_axis X p x)).
    { intros x. unfold along_axis. destruct (touching x p) eqn:Q; [|lra].
      destruct (OX p x H Q) as [A C]. assert (P := proj2 (Pg p H) x Q).
      assert (G := half_square (X x p) (Y x p) (ratio * squeeze_of x p) P A C).
      assert (F : 2 * ratio * (Y x p * squeeze_of x p - X x p * squeeze_of x p)
        == 2 * (ratio * squeeze_of x p * Y x p - ratio * squeeze_of x p * X x p)) by ring.
      rewrite F. lra. }
    assert (Ta := T AB). assert (Tb := T AG). assert (Tg := T GB). unfold square_beside, work_beside. cbv zeta. lra. }
  assert (SS : over spheres (fun p => (dot (g p) (g p) - dot (f p) (f p)) - 2 * (dot (g p) (drops_of p) - dot (f p) (drops_of p)))
    == over spheres (fun p => dot (g p) (g p)) + - (1) * over spheres (fun p => dot (f p) (f p))
       + - (2) * over spheres (fun p => dot (g p) (drops_of p)) + 2 * over spheres (fun p => dot (f p) (drops_of p))).
  { rewrite <- !over_of_multiple, <- !over_of_sum. apply over_of_same. intros. ring. }
  assert (BB : over spheres (fun p => (square_beside Y p - square_beside X p) - 2 * ratio * (work_beside Y p - work_beside X p))
    == over spheres (square_beside Y) + - (1) * over spheres (square_beside X)
       + (- (2) * ratio) * over spheres (work_beside Y) + 2 * ratio * over spheres (work_beside X)).
  { rewrite <- !over_of_multiple, <- !over_of_sum. apply over_of_same. intros. ring. }
  rewrite SS in S. rewrite BB in B. clear SS BB. unfold energy_of.
  set (gg := over spheres (fun p => dot (g p) (g p))) in *. set (ff := over spheres (fun p => dot (f p) (f p))) in *.
  set (gd := over spheres (fun p => dot (g p) (drops_of p))) in *. set (fd := over spheres (fun p => dot (f p) (drops_of p))) in *.
  set (yy := over spheres (square_beside Y)) in *. set (xx := over spheres (square_beside X)) in *.
  set (yc := over spheres (work_beside Y)) in *. set (xc := over spheres (work_beside X)) in *.
  assert (M : 0 <= ratio * (gg + - (1) * ff + - (2) * gd + 2 * fd)) by (apply Qmult_le_0_compat; lra).
  assert (V : ratio * (gd + yc) == ratio * (fd + xc)) by (rewrite Wf, Wg; reflexivity).
  lra.
Qed.

End Work.
End Pile.
