(** Forces as linear forms in the loads. A table has the forces under unit loads, one sphere and one axis at a time. The
    function [places] accepts it only if it gives the forces under all loads. `scripts/placement.py` applies it to the forces
    that `contacts` and `base` print. *)

From Coq Require Import ZArith QArith Setoid Morphisms Lia Lqa Bool List.
From Cannonpile Require Import Directions Sums Formulas Balance Stackings Regions Horizontal Loads Virtual Pile Checker.

Import ListNotations.
Open Scope Q_scope.

Set Default Proof Using "Type".

(** ** Sums and multiples *)

Definition times_three (a : Q) (t : three Q) : three Q := map (Qmult a) t.
Definition times_vector (a : Q) (v : vector) : vector := Vector (a * v.(along_x)) (a * v.(along_y)) (a * v.(along_z)).

#[export] Instance plus_three_of_same : Proper (same ==> same ==> same) plus_three.
Proof. intros s t (A & B & C) u v (D & E & F). unfold plus_three. repeat split; formulas; congruent. Qed.

#[export] Instance plus_vector_of_same : Proper (same_vector ==> same_vector ==> same_vector) plus_vector.
Proof. intros s t (A & B & C) u v (D & E & F). unfold plus_vector. repeat split; formulas; congruent. Qed.

#[export] Instance times_three_of_same a : Proper (same ==> same) (times_three a).
Proof. intros s t (A & B & C). unfold times_three. repeat split; formulas; congruent. Qed.

#[export] Instance times_vector_of_same a : Proper (same_vector ==> same_vector) (times_vector a).
Proof. intros s t (A & B & C). unfold times_vector. repeat split; formulas; congruent. Qed.

(** The load v on the sphere s, and none on others. *)
Definition only (s : sphere) (v : vector) (p : sphere) : vector := if same_sphere s p then v else nothing.

Definition unit_x : vector := Vector 1 0 0.
Definition unit_y : vector := Vector 0 1 0.
Definition unit_z : vector := Vector 0 0 1.

(** ** The transfer of forces is linear *)

(** No horizontal contacts: the spheres of a layer do not touch. *)
Definition apart (x : axis) (p : sphere) : Q := 0.

Section Linear.
Variable step : Z -> sign.
Variable has : sphere -> bool.

Definition received (f : sphere -> three Q) : sphere -> three Q := arriving_at Equilateral step has f.
Definition sends (load : sphere -> vector) (f : sphere -> three Q) (p : sphere) : three Q :=
  transmits_at Equilateral step load has f apart p.

Lemma received_of_same : forall f g p, (forall r, f r =3= g r) -> received f p =3= received g p.
Proof.
  intros f g p H. unfold received, arriving_at. cbv zeta. cbn [has_line andb].
  repeat split; cbn [alpha beta gamma]; match goal with |- (if ?b then _ else _) == _ => destruct b end; try reflexivity;
    apply H.
Qed.

Lemma received_of_sum : forall f g p,
  received (fun r => plus_three (f r) (g r)) p =3= plus_three (received f p) (received g p).
Proof.
  intros f g p. unfold received, arriving_at, plus_three. cbv zeta. cbn [has_line andb].
  repeat split; formulas; match goal with |- (if ?b then _ else _) == _ => destruct b end; ring.
Qed.

Lemma received_of_multiple : forall a f p, received (fun r => times_three a (f r)) p =3= times_three a (received f p).
Proof.
  intros a f p. unfold received, arriving_at, times_three. cbv zeta. cbn [has_line andb].
  repeat split; formulas; match goal with |- (if ?b then _ else _) == _ => destruct b end; ring.
Qed.

Definition zero : pushes := {| ab := 0; ag := 0; gb := 0 |}.

Lemma sends_are : forall load f p,
  sends load f p = transmits Equilateral (step_over step p) (step_under step p) (load p) (received f p) zero zero.
Proof.
  intros load f p. unfold sends, transmits_at, received.
  replace (six (push_next Equilateral has apart p)) with zero.
  2: { unfold six, push_next, apart, zero. f_equal; match goal with |- _ = (if ?b then _ else _) => destruct b end; reflexivity. }
  replace (six (push_last Equilateral has apart p)) with zero; [reflexivity|].
  unfold six, push_last, apart, zero. f_equal; match goal with |- _ = (if ?b then _ else _) => destruct b end; reflexivity.
Qed.

Ltac one_sphere from to :=
  unfold transmits, turned, own_increments, pushed_by, plus_three, plus_vector, times_three, times_vector, sine, transferred, zero;
  destruct from, to; repeat split; formulas; ring.

Lemma transmits_of_same : forall from to v w g h, v =v= w -> g =3= h ->
  transmits Equilateral from to v g zero zero =3= transmits Equilateral from to w h zero zero.
Proof.
  intros from to [v1 v2 v3] [w1 w2 w3] [g1 g2 g3] [h1 h2 h3] (A & B & C) (D & E & F). formulas.
  unfold transmits, turned, own_increments, pushed_by, plus_three, sine, transferred, zero.
  formulas_in A. formulas_in B. formulas_in C. formulas_in D. formulas_in E. formulas_in F.
  destruct from, to; repeat split; formulas; rewrite ?A, ?B, ?C, ?D, ?E, ?F; reflexivity.
Qed.

Lemma transmits_sum : forall from to v w g h,
  transmits Equilateral from to (plus_vector v w) (plus_three g h) zero zero
  =3= plus_three (transmits Equilateral from to v g zero zero) (transmits Equilateral from to w h zero zero).
Proof. intros from to [v1 v2 v3] [w1 w2 w3] [g1 g2 g3] [h1 h2 h3]. one_sphere from to. Qed.

Lemma transmits_multiple : forall a from to v g,
  transmits Equilateral from to (times_vector a v) (times_three a g) zero zero
  =3= times_three a (transmits Equilateral from to v g zero zero).
Proof. intros a from to [v1 v2 v3] [g1 g2 g3]. one_sphere from to. Qed.

Lemma sends_of_same : forall l m f g p, l p =v= m p -> (forall r, f r =3= g r) -> sends l f p =3= sends m g p.
Proof. intros. rewrite !sends_are. apply transmits_of_same; [assumption | apply received_of_same; assumption]. Qed.

Lemma sends_nothing : forall p, each 0 =3= sends (fun _ => nothing) (fun _ => each 0) p.
Proof.
  intros p. rewrite sends_are.
  assert (Z : received (fun _ => each 0) p =3= each 0).
  { unfold received, arriving_at. cbv zeta. cbn [has_line andb].
    repeat split; cbn [alpha beta gamma each]; match goal with |- (if ?b then _ else _) == _ => destruct b end; reflexivity. }
  rewrite (transmits_of_same _ _ _ nothing _ (each 0) (reflexivity _) Z).
  one_sphere (step_over step p) (step_under step p).
Qed.

Lemma sends_sum : forall l m f g p,
  sends (fun r => plus_vector (l r) (m r)) (fun r => plus_three (f r) (g r)) p =3= plus_three (sends l f p) (sends m g p).
Proof.
  intros l m f g p. rewrite !sends_are. rewrite <- transmits_sum. apply transmits_of_same; [reflexivity | apply received_of_sum].
Qed.

Lemma sends_multiple : forall a l f p,
  sends (fun r => times_vector a (l r)) (fun r => times_three a (f r)) p =3= times_three a (sends l f p).
Proof.
  intros a l f p. rewrite !sends_are. rewrite <- transmits_multiple.
  apply transmits_of_same; [reflexivity | apply received_of_multiple].
Qed.

(** What the forces of the pile do to a bottom sphere, its own load apart. *)
Definition lands (f : sphere -> three Q) (b : sphere) : vector := floor_force Equilateral step has (fun _ => nothing) f b.

(** The same from the forces that it receives along the directions e. *)
Definition landing (g : three Q) (e : three vector) : vector :=
  let r := resultant g e in let w := weight (increments (sine Equilateral)) in
  Vector (r.(along_x) / w + 0) (r.(along_y) / w + 0) (r.(along_z) / w + 0).

Lemma lands_are : forall f b, lands f b = landing (received f b) (contact_directions Equilateral (step (fst b - 1)%Z)).
Proof. reflexivity. Qed.

Lemma landing_of_same : forall e g h, g =3= h -> landing g e =v= landing h e.
Proof.
  intros [[] [] []] [g1 g2 g3] [h1 h2 h3] (A & B & C). formulas_in A. formulas_in B. formulas_in C.
  unfold landing, sine. repeat split; formulas; rewrite A, B, C; reflexivity.
Qed.

Lemma lands_of_same : forall f g b, (forall r, f r =3= g r) -> lands f b =v= lands g b.
Proof. intros f g b H. rewrite !lands_are. apply landing_of_same. apply received_of_same. exact H. Qed.

Lemma lands_sum : forall f g b, lands (fun r => plus_three (f r) (g r)) b =v= plus_vector (lands f b) (lands g b).
Proof.
  intros f g b. rewrite !lands_are, (landing_of_same _ _ _ (received_of_sum f g b)).
  generalize (received f b) (received g b) (contact_directions Equilateral (step (fst b - 1)%Z)).
  intros [f1 f2 f3] [g1 g2 g3] [[] [] []]. unfold landing, sine, plus_three, plus_vector. repeat split; formulas; field.
Qed.

Lemma lands_multiple : forall a f b, lands (fun r => times_three a (f r)) b =v= times_vector a (lands f b).
Proof.
  intros a f b. rewrite !lands_are, (landing_of_same _ _ _ (received_of_multiple a f b)).
  generalize (received f b) (contact_directions Equilateral (step (fst b - 1)%Z)).
  intros [f1 f2 f3] [[] [] []]. unfold landing, sine, times_three, times_vector. repeat split; formulas; field.
Qed.

Lemma lands_nothing : forall b, lands (fun _ => each 0) b =v= nothing.
Proof.
  intros b. transitivity (times_vector 0 (lands (fun _ => each 0) b)).
  - rewrite <- lands_multiple. apply lands_of_same. intros r. unfold times_three. repeat split; formulas; ring.
  - unfold times_vector. repeat split; formulas; ring.
Qed.

Lemma floor_force_is : forall load f b,
  floor_force Equilateral step has load f b =v= plus_vector (lands f b) (load b).
Proof. intros. unfold lands, floor_force, plus_vector. repeat split; formulas; ring. Qed.
End Linear.

(** ** Tables *)

(** The forces below all spheres above the floor, and on the floor. Missing entries are zero. *)
Record effect := Effect { below : M.t (three Q); floor : M.t vector }.

(** The effects of unit loads on one sphere. *)
Record column := Column { loaded : sphere; of_x : effect; of_y : effect; of_z : effect }.

Definition combined_three (v : vector) (x y z : three Q) : three Q :=
  plus_three (times_three v.(along_x) x) (plus_three (times_three v.(along_y) y) (times_three v.(along_z) z)).
Definition combined_vector (v x y z : vector) : vector :=
  plus_vector (times_vector v.(along_x) x) (plus_vector (times_vector v.(along_y) y) (times_vector v.(along_z) z)).

Definition look_floor (m : M.t vector) (b : sphere) : vector := match M.find b m with Some v => v | None => nothing end.

Definition share (load : sphere -> vector) (c : column) (p : sphere) : three Q :=
  combined_three (load c.(loaded)) (look c.(of_x).(below) p) (look c.(of_y).(below) p) (look c.(of_z).(below) p).
Definition share_on_floor (load : sphere -> vector) (c : column) (b : sphere) : vector :=
  combined_vector (load c.(loaded)) (look_floor c.(of_x).(floor) b) (look_floor c.(of_y).(floor) b) (look_floor c.(of_z).(floor) b).

(** The forces of a table under any loads: linear forms in the loads. *)
Fixpoint forces_by (table : list column) (load : sphere -> vector) (p : sphere) : three Q :=
  match table with [] => each 0 | c :: rest => plus_three (share load c p) (forces_by rest load p) end.
Fixpoint floor_by (table : list column) (load : sphere -> vector) (b : sphere) : vector :=
  match table with [] => nothing | c :: rest => plus_vector (share_on_floor load c b) (floor_by rest load b) end.

Fixpoint loads_by (table : list column) (load : sphere -> vector) (p : sphere) : vector :=
  match table with [] => nothing | c :: rest => plus_vector (only c.(loaded) (load c.(loaded)) p) (loads_by rest load p) end.

Definition equal_vector (v w : vector) : bool :=
  Qeq_bool v.(along_x) w.(along_x) && Qeq_bool v.(along_y) w.(along_y) && Qeq_bool v.(along_z) w.(along_z).

Lemma equal_vector_is : forall v w, equal_vector v w = true -> v =v= w.
Proof. intros v w. unfold equal_vector, same_vector. rewrite !andb_true_iff, !Qeq_bool_iff. tauto. Qed.

Definition same_list (l m : list sphere) : bool := if list_eq_dec same_sphere l m then true else false.

(** ** Checks

    Most forces under a load on one sphere are zero. Where nothing arrives, zero needs no arithmetic. *)

Definition is_zero (x : Q) : bool := (Qnum x =? 0)%Z.

Lemma is_zero_is : forall x, is_zero x = true -> x == 0.
Proof. intros [n d] H. apply Z.eqb_eq in H. cbn in H. subst. reflexivity. Qed.

Section Checks.
Variable step : Z -> sign.
Variable has : sphere -> bool.

Definition nothing_arrives (f : sphere -> three Q) (p : sphere) : bool :=
  forallb (fun d => is_zero (on d (f (above_of (step_over step p) p d)))) [Alpha; Beta; Gamma].

Lemma nothing_is_received : forall f p, nothing_arrives f p = true -> received step has f p =3= each 0.
Proof.
  intros f p H. unfold nothing_arrives in H. cbn [forallb] in H. rewrite !andb_true_iff in H. destruct H as (A & B & C & _).
  apply is_zero_is in A. apply is_zero_is in B. apply is_zero_is in C. unfold received, arriving_at. cbv zeta.
  cbn [has_line andb]. repeat split; cbn [alpha beta gamma each];
    match goal with |- (if ?b then _ else _) == _ => destruct b end; (assumption || reflexivity).
Qed.

(** The load v on the sphere s sends the forces f. *)
Definition is_sent (s : sphere) (v : vector) (f : sphere -> three Q) (p : sphere) : bool :=
  let t := f p in
  is_zero t.(alpha) && is_zero t.(beta) && is_zero t.(gamma) && nothing_arrives f p && (if same_sphere s p then false else true)
  || equal_three t (sends step has (only s v) f p).

Lemma is_sent_is : forall s v f p, is_sent s v f p = true -> f p =3= sends step has (only s v) f p.
Proof.
  intros s v f p. unfold is_sent. cbv zeta. rewrite orb_true_iff, !andb_true_iff. intros [((((A & B) & C) & N) & S) | H].
  - destruct (same_sphere s p) eqn:E; [discriminate S|]. apply is_zero_is in A. apply is_zero_is in B. apply is_zero_is in C.
    assert (T : f p =3= each 0) by (repeat split; assumption). rewrite T.
    transitivity (sends step has (fun _ => nothing) (fun _ => each 0) p); [apply sends_nothing|]. rewrite !sends_are.
    apply transmits_of_same; [unfold only; rewrite E; reflexivity|].
    transitivity (each 0); [apply nothing_is_received; reflexivity | symmetry; apply nothing_is_received; exact N].
  - apply equal_three_iff. exact H.
Qed.

Definition is_landed (f : sphere -> three Q) (floor : sphere -> vector) (b : sphere) : bool :=
  let v := floor b in
  is_zero v.(along_x) && is_zero v.(along_y) && is_zero v.(along_z) && nothing_arrives f b || equal_vector v (lands step has f b).

Lemma is_landed_is : forall f floor b, is_landed f floor b = true -> floor b =v= lands step has f b.
Proof.
  intros f floor b. unfold is_landed. cbv zeta. rewrite orb_true_iff, !andb_true_iff. intros [(((A & B) & C) & N) | H].
  - apply is_zero_is in A. apply is_zero_is in B. apply is_zero_is in C.
    assert (T : floor b =v= nothing) by (repeat split; assumption). rewrite T.
    transitivity (lands step has (fun _ => each 0) b); [symmetry; apply lands_nothing|]. rewrite !lands_are.
    apply landing_of_same.
    transitivity (each 0); [apply nothing_is_received; reflexivity | symmetry; apply nothing_is_received; exact N].
  - apply equal_vector_is. exact H.
Qed.

Definition is_effect (spheres base : list sphere) (s : sphere) (v : vector) (e : effect) : bool :=
  forallb (is_sent s v (look e.(below))) spheres && forallb (is_landed (look e.(below)) (look_floor e.(floor))) base.
End Checks.

(** A pile on an equilateral base, as [Checker] describes it. Its own loads are not used. *)
Definition bare (signs : list sign) (is_under_top : bool) (lower upper : three Z) : pile :=
  Pile Equilateral signs is_under_top lower upper 0 0 0 (M.empty Q) (M.empty vector).

Section Table.
Variable pile : pile.
Variable table : list column.

Definition spheres_in : list sphere := free pile.
Definition in_pile (p : sphere) : bool := M.mem p (set_of spheres_in).
Definition step_below : Z -> sign := step_in (indexed 0 pile.(signs)).

Definition places : bool :=
  let all := layers pile in
  let spheres := above_floor all in
  let base := List.last all [] in
  let tree := set_of spheres in
  let has p := M.mem p tree in
  let signs := indexed 0 pile.(signs) in
  let step := step_in signs in
  match pile.(of_kind) with Equilateral => true | _ => false end
  && forallb (fun p => (0 <=? fst p)%Z) spheres
  && same_list (List.map loaded table) spheres
  && forallb (fun c =>
       is_effect step has spheres base c.(loaded) unit_x c.(of_x)
       && is_effect step has spheres base c.(loaded) unit_y c.(of_y)
       && is_effect step has spheres base c.(loaded) unit_z c.(of_z)) table.

Definition solves (load : sphere -> vector) (f : sphere -> three Q) : Prop :=
  equilibrium_of pile.(of_kind) step_below spheres_in load in_pile f apart.

(** The forces under one distribution of loads, checked directly. *)
Definition answers (load : sphere -> vector) (e : effect) : bool :=
  let all := layers pile in
  let spheres := above_floor all in
  let tree := set_of spheres in
  let has p := M.mem p tree in
  let signs := indexed 0 pile.(signs) in
  let step := step_in signs in
  all_fit_b pile.(of_kind) step spheres load
  && solved pile.(of_kind) step spheres load has apart e.(below)
  && forallb (fun b => equal_vector (look_floor e.(floor) b) (floor_force pile.(of_kind) step has load (look e.(below)) b))
       (List.last all []).

Theorem answered : forall load e, answers load e = true ->
  solves load (look e.(below)) /\
  (forall b, In b (bottom pile) ->
    look_floor e.(floor) b =v= floor_force pile.(of_kind) step_below in_pile load (look e.(below)) b).
Proof.
  unfold answers. cbv zeta. fold (free pile) (bottom pile). fold spheres_in step_below.
  change (fun p => M.mem p (set_of spheres_in)) with in_pile.
  intros load e. rewrite !andb_true_iff, forallb_forall. intros [[A S] G]. split.
  - assert (I : forall p, in_pile p = true <-> In p spheres_in) by (intros; apply set_of_iff).
    exact (solved_is pile.(of_kind) step_below spheres_in load in_pile apart I A e.(below) S).
  - intros b i. apply equal_vector_is. exact (G b i).
Qed.

Lemma parts_of : forall s v p,
  only s v p =v= plus_vector (times_vector v.(along_x) (only s unit_x p))
    (plus_vector (times_vector v.(along_y) (only s unit_y p)) (times_vector v.(along_z) (only s unit_z p))).
Proof.
  intros s v p. unfold only, plus_vector, times_vector, unit_x, unit_y, unit_z.
  destruct (same_sphere s p); repeat split; formulas; ring.
Qed.

(** An accepted table has the forces under all loads: they are in equilibrium, no others are, and these are the forces on
    the floor. *)
Theorem placed : places = true -> forall load,
  solves load (forces_by table load) /\
  (forall f, solves load f -> forall p, In p spheres_in -> f p =3= forces_by table load p) /\
  (forall b, In b (bottom pile) ->
    floor_force pile.(of_kind) step_below in_pile load (forces_by table load) b =v= plus_vector (floor_by table load b) (load b)).
Proof.
  unfold places. cbv zeta. fold (free pile) (bottom pile). fold spheres_in step_below.
  change (fun p => M.mem p (set_of spheres_in)) with in_pile.
  rewrite !andb_true_iff. intros [[[K T] S] E] load. unfold solves.
  destruct (of_kind pile); try discriminate K. clear K.
  assert (I : forall p, in_pile p = true <-> In p spheres_in) by (intros; apply set_of_iff).
  assert (N : NoDup spheres_in) by apply distinct_once.
  assert (Top : forall p, In p spheres_in -> (0 <= fst p)%Z).
  { intros p i. rewrite forallb_forall in T. apply Z.leb_le. exact (T p i). }
  assert (fit : forall l p, In p spheres_in -> fits Equilateral (step_over step_below p) (step_under step_below p) (l p))
    by (intros; exact Logic.I).
  assert (L : List.map loaded table = spheres_in).
  { unfold same_list in S. destruct (list_eq_dec same_sphere (List.map loaded table) spheres_in); [assumption | discriminate S]. }
  clear S. rewrite forallb_forall in E.
  assert (U : forall s v e, is_effect step_below in_pile spheres_in (bottom pile) s v e = true ->
      (forall p, In p spheres_in -> look e.(below) p =3= sends step_below in_pile (only s v) (look e.(below)) p) /\
      (forall b, In b (bottom pile) -> look_floor e.(floor) b =v= lands step_below in_pile (look e.(below)) b)).
  { intros s v e H. unfold is_effect in H. rewrite andb_true_iff, !forallb_forall in H. destruct H as [H G]. split.
    - intros p i. apply is_sent_is. exact (H p i).
    - intros b i. apply is_landed_is. exact (G b i). }
  assert (P : forall l, incl l table ->
      (forall p, In p spheres_in ->
        forces_by l load p =3= sends step_below in_pile (loads_by l load) (forces_by l load) p) /\
      (forall b, In b (bottom pile) -> floor_by l load b =v= lands step_below in_pile (forces_by l load) b)).
  { induction l as [|c l IH]; intros J.
    - split; [intros p _; apply sends_nothing | intros b _; symmetry; apply lands_nothing].
    - destruct (IH (fun x i => J x (or_intror i))) as [A B]. clear IH.
      assert (C := E c (J c (or_introl eq_refl))). rewrite !andb_true_iff in C. destruct C as [[X Y] Z].
      destruct (U _ _ _ X) as [Xp Xb], (U _ _ _ Y) as [Yp Yb], (U _ _ _ Z) as [Zp Zb]. clear X Y Z. split.
      + intros p i. cbn [forces_by]. rewrite (A p i) at 1.
        change (loads_by (c :: l) load)
          with (fun r => plus_vector (only c.(loaded) (load c.(loaded)) r) (loads_by l load r)).
        change (forces_by (c :: l) load) with (fun r => plus_three (share load c r) (forces_by l load r)).
        rewrite (sends_sum _ _ (only c.(loaded) (load c.(loaded))) (loads_by l load) (share load c) (forces_by l load)).
        apply plus_three_of_same; [|reflexivity].
        unfold share at 1. unfold combined_three. rewrite (Xp p i), (Yp p i), (Zp p i).
        rewrite <- !sends_multiple, <- !sends_sum.
        apply sends_of_same; [symmetry; apply parts_of | intros r; reflexivity].
      + intros b i. cbn [floor_by]. rewrite (B b i).
        change (forces_by (c :: l) load) with (fun r => plus_three (share load c r) (forces_by l load r)).
        rewrite lands_sum. apply plus_vector_of_same; [|reflexivity].
        unfold share_on_floor, combined_vector. rewrite (Xb b i), (Yb b i), (Zb b i).
        rewrite <- !lands_multiple, <- !lands_sum. apply lands_of_same. intros r. reflexivity. }
  destruct (P table (incl_refl table)) as [A B]. clear P U E.
  assert (W : forall p, In p spheres_in -> loads_by table load p =v= load p).
  { intros p i. rewrite <- L in i. assert (M := N). rewrite <- L in M. clear - i M.
    assert (G : forall l, ~ In p (List.map loaded l) -> loads_by l load p =v= nothing).
    { induction l as [|c l IH]; intros H; cbn [loads_by List.map] in *; [reflexivity|]. rewrite IH by (simpl in H; tauto).
      unfold only. destruct (same_sphere c.(loaded) p) as [Eq | _]; [simpl in H; tauto|].
      unfold plus_vector. repeat split; formulas; ring. }
    induction table as [|c l IH]; [destruct i|]. cbn [loads_by List.map] in *. inversion M as [|? ? H M']; subst.
    destruct (same_sphere c.(loaded) p) as [Eq | Ne].
    - rewrite G by (rewrite <- Eq; exact H). unfold only. rewrite Eq. destruct (same_sphere p p); [|congruence].
      unfold plus_vector. repeat split; formulas; ring.
    - rewrite IH by (destruct i; [congruence | assumption] || assumption). unfold only.
      destruct (same_sphere c.(loaded) p); [contradiction|]. unfold plus_vector. repeat split; formulas; ring. }
  assert (Q : equilibrium_of Equilateral step_below spheres_in load in_pile (forces_by table load) apart).
  { intros p i. apply (balance_is_transmission _ _ _ load in_pile (fit load) _ _ p i).
    rewrite (A p i) at 1. apply sends_of_same; [exact (W p i) | intros r; reflexivity]. }
  split; [exact Q|]. split.
  - intros f F p i. exact (forces_are_unique _ _ _ _ _ I Top (fit load) f _ _ F Q p i).
  - intros b i. rewrite floor_force_is, (B b i). reflexivity.
Qed.
End Table.

(** ** Tables as they are written *)

(** A sphere, and the numerators of three numbers. *)
Inductive entry := At (k i j a b c : Z).

Definition effect_of (denominator : positive) (below floor : list entry) : effect :=
  Effect
    (fold_left (fun m e => match e with At k i j a b c =>
       M.add (k, (i, j)) (Three (a # denominator) (b # denominator) (c # denominator)) m end) below (M.empty (three Q)))
    (fold_left (fun m e => match e with At k i j x y z =>
       M.add (k, (i, j)) (Vector (x # denominator) (y # denominator) (z # denominator)) m end) floor (M.empty vector)).
