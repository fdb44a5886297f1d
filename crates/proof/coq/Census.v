(** The stable stackings under one sphere: a finite search by computation. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool List.
From Cannonpile Require Import Directions Sums Formulas Balance Stackings.

Import ListNotations.
Open Scope Q_scope.

Definition site_eq_dec : forall p p' : Z * Z, {p = p'} + {p <> p'}.
Proof. decide equality; apply Z.eq_dec. Defined.

(** A layer as a table: each of its sites once, with the forces that its sphere transmits. *)
Definition table := list ((Z * Z) * three Q).

Fixpoint found (t : table) (i j : Z) : option (three Q) :=
  match t with
  | [] => None
  | ((a, b), f) :: t => if (a =? i)%Z && (b =? j)%Z then Some f else found t i j
  end.

Definition reduced_three (t : three Q) : three Q := map Qred t.

(** The forces that a sphere of the next layer, below a step [from] and above a step [to], receives and transmits. *)
Definition from_table (from : sign) (t : table) (p : Z * Z) (d : direction) : Q :=
  let (a, b) := above_in from d (fst p) (snd p) in
  match found t a b with Some f => on d f | None => 0 end.

Definition transmits (from to : sign) (t : table) (p : Z * Z) : three Q :=
  reduced_three (by_line transmitted
    (transferred from to (Three (from_table from t p Alpha) (from_table from t p Beta) (from_table from t p Gamma)))
    (each 1)).

Definition sites_below (from : sign) (t : table) : list (Z * Z) :=
  nodup site_eq_dec (flat_map (fun e =>
    [support from (fst e) Alpha; support from (fst e) Beta; support from (fst e) Gamma]) t).

Definition next_table (from to : sign) (t : table) : table :=
  List.map (fun p => (p, transmits from to t p)) (sites_below from t).

Section Tables.
Variable step : nat -> sign.
Notation layer := (layer [(0, 0)%Z] step).
Notation forces_of := (forces_of [(0, 0)%Z] step).

Fixpoint tables (k : nat) : table :=
  match k with
  | O => [((0, 0)%Z, each 1)]
  | S m => next_table (step m) (step (S m)) (tables m)
  end.

Definition right_table (k : nat) (t : table) : Prop :=
  forall i j, match found t i j with
              | Some f => In (i, j) (layer k) /\ f =3= forces_of k i j
              | None => ~ In (i, j) (layer k)
              end.

Lemma found_of_map : forall (g : Z * Z -> three Q) l i j,
  (In (i, j) l -> found (List.map (fun p => (p, g p)) l) i j = Some (g (i, j))) /\
  (~ In (i, j) l -> found (List.map (fun p => (p, g p)) l) i j = None).
Proof.
  intros g l i j. induction l as [|[a b] l [IH1 IH2]]; [split; [intros [] | reflexivity]|]. cbn [List.map found].
  destruct ((a =? i)%Z && (b =? j)%Z) eqn:E.
  - apply andb_true_iff in E. rewrite !Z.eqb_eq in E. destruct E; subst. split; [reflexivity|].
    intros N. destruct N. left. reflexivity.
  - split.
    + intros [H | H]; [|auto]. injection H; intros; subst. rewrite !Z.eqb_refl in E. discriminate E.
    + intros N. apply IH2. intros H. apply N. right. exact H.
Qed.

Lemma found_in : forall t i j f, found t i j = Some f -> In ((i, j), f) t.
Proof.
  intros t i j f. induction t as [|[[a b] g] t IH]; simpl; [discriminate|].
  destruct (a =? i)%Z eqn:A, (b =? j)%Z eqn:B; simpl; intros H; auto.
  rewrite Z.eqb_eq in *. left. congruence.
Qed.

Lemma in_found : forall t i j f, In ((i, j), f) t -> found t i j <> None.
Proof.
  intros t i j f. induction t as [|[[a b] g] t IH]; simpl; [tauto|]. intros [E | H].
  - injection E; intros; subst. rewrite !Z.eqb_refl. discriminate.
  - destruct ((a =? i)%Z && (b =? j)%Z); [discriminate | auto].
Qed.

Lemma reduced_is : forall t, reduced_three t =3= t.
Proof. intros []. repeat split; apply Qred_correct. Qed.

Theorem tables_are_right : forall k, right_table k (tables k).
Proof.
  induction k as [|k IH]; intros i j.
  - cbn [tables found]. destruct ((0 =? i)%Z && (0 =? j)%Z) eqn:E.
    + apply andb_true_iff in E. rewrite !Z.eqb_eq in E. destruct E; subst. split; [left; reflexivity | reflexivity].
    + intros [H | []]. injection H; intros; subst. discriminate E.
  - cbn [tables]. unfold next_table.
    assert (S : forall p, In p (sites_below (step k) (tables k)) <-> In p (layer (Datatypes.S k))).
    { intros p. unfold sites_below. rewrite nodup_In. cbn [Stackings.layer]. rewrite !in_flat_map. split.
      - intros ([[a b] f] & H & E). exists (a, b). split; [|exact E].
        specialize (IH a b). assert (N := in_found _ _ _ _ H). destruct (found (tables k) a b); [tauto | congruence].
      - intros ([a b] & H & E). specialize (IH a b). destruct (found (tables k) a b) as [f|] eqn:F; [|tauto].
        exists ((a, b), f). split; [apply found_in; exact F | exact E]. }
    destruct (found_of_map (transmits (step k) (step (Datatypes.S k)) (tables k)) (sites_below (step k) (tables k)) i j)
      as [F1 F2].
    destruct (in_dec site_eq_dec (i, j) (sites_below (step k) (tables k))) as [H | H];
      [rewrite (F1 H) | rewrite (F2 H)]; rewrite S in H; [|exact H].
    split; [exact H|]. unfold transmits. rewrite reduced_is. cbn [Stackings.forces_of].
    apply passed_of_same. apply transferred_of_same.
    assert (D : forall d, from_table (step k) (tables k) (i, j) d
      == (let (a, b) := above_in (step k) d i j in if member (layer k) a b then on d (forces_of k a b) else 0)).
    { intros d. unfold from_table. cbn [fst snd]. destruct (above_in (step k) d i j) as [a b]. specialize (IH a b).
      destruct (found (tables k) a b) as [f|], (member (layer k) a b) eqn:M.
      - destruct IH as [_ (x & y & z)]. destruct d; cbn [on]; assumption.
      - destruct IH as [I _]. apply member_iff in I. congruence.
      - apply member_iff in M. tauto.
      - reflexivity. }
    exact (conj (D Alpha) (conj (D Beta) (D Gamma))).
Qed.

Definition pushes (t : table) : bool :=
  forallb (fun e => Qle_bool 0 (snd e).(alpha) && Qle_bool 0 (snd e).(beta) && Qle_bool 0 (snd e).(gamma)) t.

(** A pile is stable if and only if no table has a tensile force. *)
Theorem stands_if_tables_push : forall L,
  stands [(0, 0)%Z] step L <-> forall k, (S k < L)%nat -> forall i j f, found (tables k) i j = Some f -> forall d, 0 <= on d f.
Proof.
  intros L. rewrite stands_if_the_recursion_pushes. split.
  - intros H k HL i j f F d. assert (R := tables_are_right k i j). rewrite F in R. destruct R as [I (x & y & z)].
    specialize (H k i j d HL I). destruct d; cbn [on] in *; lra.
  - intros H k i j d HL I. assert (R := tables_are_right k i j).
    destruct (found (tables k) i j) as [f|] eqn:F; [|tauto]. destruct R as [_ (x & y & z)].
    specialize (H k HL i j f F d). destruct d; cbn [on] in *; lra.
Qed.

Lemma pushes_iff : forall t, pushes t = true <-> forall i j f, In ((i, j), f) t -> forall d, 0 <= on d f.
Proof.
  intros t. unfold pushes. rewrite forallb_forall. split.
  - intros H i j f I d. specialize (H _ I). cbn [snd] in H. rewrite !andb_true_iff, !Qle_bool_iff in H.
    destruct H as [[A B] C]. destruct d; cbn [on]; assumption.
  - intros H [[i j] f] I. cbn [snd]. rewrite !andb_true_iff, !Qle_bool_iff.
    exact (conj (conj (H i j f I Alpha) (H i j f I Beta)) (H i j f I Gamma)).
Qed.

(** The signs of the first n steps, the last one first. *)
Fixpoint prefix (n : nat) : list sign := match n with O => [] | S m => step m :: prefix m end.

End Tables.

(** ** The search

    The prefixes of n+1 steps that begin with + and whose n+1 upper layers are free of tension, each with the table
    of the last layer. *)
Fixpoint survivors (n : nat) : list (list sign * table) :=
  match n with
  | O => [([Plus], [((0, 0)%Z, each 1)])]
  | S m =>
    filter (fun e => pushes (snd e))
      (flat_map (fun e => List.map (fun to => (to :: fst e, next_table (hd Plus (fst e)) to (snd e))) [Plus; Minus])
         (survivors m))
  end.

Lemma survivors_are : forall step n, step O = Plus ->
  (In (prefix step (S n), tables step n) (survivors n) <-> forall k, (k <= n)%nat -> pushes (tables step k) = true) /\
  (forall t, In (prefix step (S n), t) (survivors n) -> t = tables step n).
Proof.
  intros step n H0. induction n as [|n [IH1 IH2]].
  - split; [split|].
    + intros _ k Hk. assert (k = O) by lia. subst. reflexivity.
    + intros _. cbn. rewrite H0. left. reflexivity.
    + intros t [E | []]. injection E. intros. subst. reflexivity.
  - assert (F : forall t, In (prefix step (S (S n)), t) (survivors (S n)) <->
      exists u, In (prefix step (S n), u) (survivors n) /\ t = next_table (step n) (step (S n)) u /\ pushes t = true).
    { intros t. cbn [survivors]. rewrite filter_In, in_flat_map. cbn [snd]. split.
      - intros [([s u] & I & E) P]. exists u. apply in_map_iff in E. destruct E as (to & E & _).
        cbn [fst snd] in E. cbn [prefix] in E. injection E. intros Et Es Eto. subst.
        cbn [prefix hd] in *. split; [exact I | split; [reflexivity | exact P]].
      - intros (u & I & E & P). split; [|exact P]. exists (prefix step (S n), u). split; [exact I|].
        apply in_map_iff. exists (step (S n)). cbn [fst snd prefix hd]. subst. split; [reflexivity|].
        destruct (step (S n)); [left | right; left]; reflexivity. }
    split; [split|].
    + intros I k Hk. apply F in I. destruct I as (u & I & E & P).
      assert (U := IH2 u I). subst u. apply IH1 in I || (rewrite IH1 in I).
      destruct (Nat.eq_dec k (S n)); [subst; cbn [tables] in *; exact P | apply I; lia].
    + intros P. apply F. exists (tables step n). split; [apply IH1; intros; apply P; lia|].
      split; [reflexivity|]. apply P. lia.
    + intros t I. apply F in I. destruct I as (u & I & E & _). rewrite (IH2 u I) in E. exact E.
Qed.

Lemma table_pushes_iff : forall step k,
  pushes (tables step k) = true <-> forall i j d, In (i, j) (layer [(0, 0)%Z] step k) -> 0 <= on d (forces_of [(0, 0)%Z] step k i j).
Proof.
  intros step k. rewrite pushes_iff. split.
  - intros H i j d I. assert (R := tables_are_right step k i j).
    destruct (found (tables step k) i j) as [f|] eqn:F; [|tauto].
    destruct R as [_ (x & y & z)]. apply found_in in F. specialize (H i j f F d). destruct d; cbn [on] in *; lra.
  - intros H i j f I d.
    (* Each site occurs once in a table. *)
    assert (U : found (tables step k) i j = Some f).
    { assert (ND : NoDup (List.map fst (tables step k))).
      { destruct k as [|m]; [constructor; [intros [] | constructor]|]. cbn [tables]. unfold next_table.
        rewrite map_map. cbn [fst]. rewrite map_id. apply NoDup_nodup. }
      clear H. induction (tables step k) as [|[[a b] g] t IH]; [destruct I|]. cbn [found].
      cbn [List.map fst] in ND. inversion ND as [|? ? N ND']; subst. destruct I as [E | I].
      - injection E; intros; subst. rewrite !Z.eqb_refl. reflexivity.
      - destruct ((a =? i)%Z && (b =? j)%Z) eqn:E; [|auto].
        apply andb_true_iff in E. rewrite !Z.eqb_eq in E. destruct E; subst. destruct N.
        apply in_map_iff. exists ((i, j), f). split; [reflexivity | exact I]. }
    assert (R := tables_are_right step k i j). rewrite U in R. destruct R as [In' (x & y & z)].
    specialize (H i j d In'). destruct d; cbn [on] in *; lra.
Qed.

Lemma stands_iff : forall step L,
  stands [(0, 0)%Z] step L <-> forall k, (S k < L)%nat -> pushes (tables step k) = true.
Proof.
  intros step L. rewrite stands_if_the_recursion_pushes. split.
  - intros H k HL. apply table_pushes_iff. intros i j d I. apply H; assumption.
  - intros H k i j d HL I. specialize (H k HL). rewrite table_pushes_iff in H. apply H. exact I.
Qed.

(** A straight continuation is stable: a sphere transmits the forces received plus its own weight. *)
Lemma straight_continuation : forall step k, step (S k) = step k ->
  pushes (tables step k) = true -> pushes (tables step (S k)) = true.
Proof.
  intros step k E H. rewrite table_pushes_iff in *. intros i j d I.
  cbn [forces_of]. rewrite E.
  assert (T : forall g, transferred (step k) (step k) g = g) by (intros; destruct (step k); reflexivity). rewrite T.
  assert (P : forall d, 0 <= (let (a, b) := above_in (step k) d i j in
    if member (layer [(0, 0)%Z] step k) a b then on d (forces_of [(0, 0)%Z] step k a b) else 0)).
  { intros e. destruct (above_in (step k) e i j) as [a b]. destruct (member (layer [(0, 0)%Z] step k) a b) eqn:M; [|lra].
    apply member_iff in M. apply H. exact M. }
  specialize (P d). destruct d; cbn [on by_line alpha beta gamma] in *; unfold transmitted, each; cbn [alpha beta gamma]; lra.
Qed.

(** By computation: eleven prefixes of ten steps are free of tension. In each of them the last five steps have one
    sign. *)
Definition five_equal (s : list sign) : bool :=
  match s with
  | a :: b :: c :: d :: e :: _ =>
    match a, b, c, d, e with
    | Plus, Plus, Plus, Plus, Plus | Minus, Minus, Minus, Minus, Minus => true
    | _, _, _, _, _ => false
    end
  | _ => false
  end.

Definition eleven : list (list sign) :=
  let p := Plus in
  let m := Minus in
  [[p; p; p; p; p; p; p; p; p; p];
   [p; p; p; p; p; p; m; p; p; p];
   [m; m; m; m; m; m; m; p; p; p];
   [p; p; p; p; p; p; p; m; p; p];
   [m; m; m; m; m; m; p; m; p; p];
   [m; m; m; m; m; m; m; m; p; p];
   [p; p; p; p; p; p; p; p; m; p];
   [m; m; m; m; m; m; m; p; m; p];
   [p; p; p; p; p; p; p; m; m; p];
   [m; m; m; m; m; m; p; m; m; p];
   [m; m; m; m; m; m; m; m; m; p]].

Theorem the_search : List.map fst (survivors 9) = eleven.
Proof. vm_compute. reflexivity. Qed.

Lemma all_end_in_five : forall s, In s eleven -> five_equal s = true.
Proof. apply forallb_forall. reflexivity. Qed.

Definition same_sign : forall s t : sign, {s = t} + {s <> t}.
Proof. decide equality. Defined.

Definition same_signs : forall s t : list sign, {s = t} + {s <> t} := list_eq_dec same_sign.

(** The sign of step k of one of the eleven prefixes with a straight continuation. *)
Definition continued (s : list sign) (k : nat) : sign := nth k (rev s) (hd Plus s).

(** By computation: every tension-free prefix of at most ten steps is a prefix of one of the eleven. *)
Definition within (l m : list (list sign)) : bool := forallb (fun s => if in_dec same_signs s m then true else false) l.

Definition beginnings (n : nat) : list (list sign) := List.map (fun s => prefix (continued s) n) eleven.

Lemma within_iff : forall l m, within l m = true <-> incl l m.
Proof.
  intros l m. unfold within, incl. rewrite forallb_forall. split; intros H s I; specialize (H s I);
    destruct (in_dec same_signs s m); congruence.
Qed.

Lemma the_searches : forall n, (n <= 9)%nat ->
  within (List.map fst (survivors n)) (beginnings (S n)) && within (beginnings (S n)) (List.map fst (survivors n)) = true.
Proof.
  intros n H. apply (proj1 (forallb_forall (fun n => within (List.map fst (survivors n)) (beginnings (S n))
    && within (beginnings (S n)) (List.map fst (survivors n))) (seq 0 10))); [vm_compute; reflexivity|].
  apply in_seq. lia.
Qed.

#[local] Opaque survivors tables.

(** Under one sphere eleven stackings that begin with + are stable, at any height of 11 layers or more. They begin with
    these ten steps (the last one first), and continue straight. *)
Theorem census : forall step L, step O = Plus -> (11 <= L)%nat ->
  (stands [(0, 0)%Z] step L <->
   In (prefix step 10) eleven /\ forall k, (10 <= k)%nat -> (S k < L)%nat -> step k = step 9%nat).
Proof.
  intros step L H0 HL. destruct (survivors_are step 9 H0) as [S1 S2]. rewrite stands_iff.
  assert (P : (forall k, (k <= 9)%nat -> pushes (tables step k) = true) <-> In (prefix step 10) eleven).
  { rewrite <- S1, <- the_search, in_map_iff. split.
    - intros I. exists (prefix step 10, tables step 9). split; [reflexivity | exact I].
    - intros ([s t] & E & I). cbn [fst] in E. rewrite E in I. assert (T := S2 t I). rewrite T in I at 1. exact I. }
  split.
  - intros H. assert (E : In (prefix step 10) eleven) by (apply P; intros; apply H; lia).
    split; [exact E|]. assert (F := all_end_in_five _ E). cbn [prefix five_equal] in F.
    intros k. induction k as [k IH] using lt_wf_ind. intros Hk HkL.
    assert (Five : forall r, (5 <= r <= 9)%nat -> step r = step 9%nat).
    { intros r Hr. assert (r = 5 \/ r = 6 \/ r = 7 \/ r = 8 \/ r = 9)%nat as [-> | [-> | [-> | [-> | ->]]]] by lia;
        destruct (step 9%nat), (step 8%nat), (step 7%nat), (step 6%nat), (step 5%nat); congruence. }
    destruct (step k) eqn:E1, (step 9%nat) eqn:E2; try reflexivity; exfalso;
      (apply (no_run_of_five_can_end [(0, 0)%Z] step (step 9%nat) 5 (k - 5) L);
       [discriminate
       | intros r Hr; destruct (le_lt_dec (5 + r) 9) as [A | A];
         [rewrite ?E2; apply Five; lia | rewrite ?E2; apply IH; lia]
       | replace (5 + (k - 5))%nat with k by lia; rewrite E1, ?E2; reflexivity
       | left; lia
       | lia
       | apply stands_iff; exact H]).
  - intros [E H] k. destruct (le_lt_dec k 9) as [A | A]; [intros _; apply P; assumption|].
    induction k as [|k IH]; [lia|]. intros HkL.
    apply straight_continuation.
    + destruct (Nat.eq_dec k 9) as [-> | N]; [apply H; lia|]. rewrite (H (S k)), (H k) by lia. reflexivity.
    + destruct (Nat.eq_dec k 9) as [-> | N]; [apply P; [exact E | lia] | apply IH; lia].
Qed.

(** ** At any height

    A stacking is stable if and only if its mirror image is stable. The mirror image has each sign reversed. *)
Section Mirror.
Variable step : nat -> sign.
Notation image := (fun k => opposite (step k)).

Definition across (p : Z * Z) : Z * Z := ((- fst p)%Z, (- snd p)%Z).

Lemma layers_of_the_image : forall k, layer [(0, 0)%Z] image k = List.map across (layer [(0, 0)%Z] step k).
Proof.
  induction k as [|k IH]; [reflexivity|]. cbn [layer]. rewrite IH. clear IH.
  assert (S : forall p d, support (opposite (step k)) (across p) d = across (support (step k) p d)).
  { intros [i j] d. unfold support, across. destruct (step k), d; cbn [opposite descent fst snd]; f_equal; lia. }
  induction (layer [(0, 0)%Z] step k) as [|p l IH]; [reflexivity|].
  cbn [List.map flat_map app]. rewrite IH, !S. reflexivity.
Qed.

Lemma member_across : forall l i j, member (List.map across l) i j = member l (- i) (- j).
Proof.
  intros l i j. apply eq_true_iff_eq. rewrite !member_iff, in_map_iff. split.
  - intros ([a b] & E & I). unfold across in E. cbn [fst snd] in E. injection E. intros. subst. rewrite !Z.opp_involutive. exact I.
  - intros I. exists (- i, - j)%Z. unfold across. cbn [fst snd]. rewrite !Z.opp_involutive. split; [reflexivity | exact I].
Qed.

Lemma forces_of_the_image : forall k i j, forces_of [(0, 0)%Z] image k i j = forces_of [(0, 0)%Z] step k (- i) (- j).
Proof.
  induction k as [|k IH]; intros i j; [reflexivity|]. cbn [forces_of].
  assert (T : forall a b g, transferred (opposite a) (opposite b) g = transferred a b g) by (intros [] [] g; reflexivity).
  assert (A : forall d, above_in (opposite (step k)) d i j = across (above_in (step k) d (- i) (- j))).
  { intros d. unfold above_in, across. destruct (step k), d; cbn [opposite descent fst snd]; f_equal; lia. }
  assert (M : forall d, (let (a, b) := above_in (opposite (step k)) d i j in
      if member (layer [(0, 0)%Z] image k) a b then on d (forces_of [(0, 0)%Z] image k a b) else 0)
    = (let (a, b) := above_in (step k) d (- i) (- j) in
      if member (layer [(0, 0)%Z] step k) a b then on d (forces_of [(0, 0)%Z] step k a b) else 0)).
  { intros d. rewrite A. destruct (above_in (step k) d (- i) (- j)) as [a b]. unfold across. cbn [fst snd].
    rewrite layers_of_the_image, member_across, IH, !Z.opp_involutive. reflexivity. }
  cbv zeta. rewrite !M, T. reflexivity.
Qed.

Theorem mirror_image : forall L, stands [(0, 0)%Z] image L <-> stands [(0, 0)%Z] step L.
Proof.
  intros L. rewrite !stands_if_the_recursion_pushes.
  split; intros H k i j d HL I.
  - rewrite <- (Z.opp_involutive i), <- (Z.opp_involutive j), <- forces_of_the_image. apply H; [exact HL|].
    rewrite layers_of_the_image. apply in_map_iff. exists (i, j). split; [reflexivity | exact I].
  - rewrite forces_of_the_image. apply H; [exact HL|].
    apply member_iff in I. rewrite layers_of_the_image, member_across in I. apply member_iff. exact I.
Qed.

End Mirror.

Lemma same_prefix : forall s t n, prefix s n = prefix t n <-> forall k, (k < n)%nat -> s k = t k.
Proof.
  intros s t n. induction n as [|n IH]; [split; [lia | reflexivity]|]. cbn [prefix]. split.
  - intros E k Hk. injection E. intros E1 E2. destruct (Nat.eq_dec k n); [subst; exact E2 | apply IH; [exact E1 | lia]].
  - intros H. f_equal; [apply H; lia | apply IH; intros; apply H; lia].
Qed.

(** The census of stackings that begin with +. *)
Lemma census_of_plus : forall step L, step O = Plus ->
  (stands [(0, 0)%Z] step L <-> exists s, In s eleven /\ forall k, (S k < L)%nat -> step k = continued s k).
Proof.
  intros step L H0. destruct (le_lt_dec L 11) as [HL | HL].
  - destruct L as [|[|n]].
    + split; [intros _; exists (hd [] eleven); split; [left; reflexivity | lia] | intros _; apply stands_iff; lia].
    + split; [intros _; exists (hd [] eleven); split; [left; reflexivity | lia] | intros _; apply stands_iff; lia].
    + assert (W := the_searches n ltac:(lia)). rewrite andb_true_iff, !within_iff in W. destruct W as [W1 W2].
      destruct (survivors_are step n H0) as [S1 S2]. rewrite stands_iff.
      transitivity (In (prefix step (S n)) (beginnings (S n))).
      * transitivity (In (prefix step (S n)) (List.map fst (survivors n))); [|split; [apply W1 | apply W2]].
        transitivity (forall k, (k <= n)%nat -> pushes (tables step k) = true); [split; intros H k Hk; apply H; lia|].
        rewrite <- S1, in_map_iff. split.
        -- intros I. exists (prefix step (S n), tables step n). split; [reflexivity | exact I].
        -- intros ([s t] & E & I). cbn [fst] in E. subst s. rewrite (S2 t I) in I. exact I.
      * unfold beginnings. rewrite in_map_iff. split; intros (s & A & B); exists s.
        -- split; [exact B|]. intros k Hk. symmetry. apply (proj1 (same_prefix _ _ _) A). lia.
        -- split; [|exact A]. apply same_prefix. intros k Hk. symmetry. apply B. lia.
  - rewrite (census step L H0) by lia. split.
    + intros [I H]. exists (prefix step 10). split; [exact I|]. intros k Hk.
      destruct (le_lt_dec 10 k) as [A | A].
      * rewrite (H k A Hk). unfold continued. rewrite nth_overflow by (rewrite rev_length; exact A). reflexivity.
      * do 10 (destruct k as [|k]; [reflexivity|]). lia.
    + intros (s & I & H). assert (E : prefix step 10 = prefix (continued s) 10)
        by (apply same_prefix; intros k Hk; apply H; lia).
      assert (F : length s = 10%nat /\ prefix (continued s) 10 = s /\ continued s 9 = hd Plus s).
      { clear - I. revert s I. apply Forall_forall. unfold eleven. repeat constructor. }
      destruct F as (F1 & F2 & F3). split; [rewrite E, F2; exact I|]. intros k Hk HkL.
      rewrite (H k HkL), (H 9%nat), F3 by lia. unfold continued. apply nth_overflow. rewrite rev_length. lia.
Qed.

(** The census: under one sphere, at any height, the stable stackings are the eleven, their prefixes and their mirror
    images. *)
Theorem census_at_any_height : forall step L,
  stands [(0, 0)%Z] step L <->
  exists s, In s eleven /\
    ((forall k, (S k < L)%nat -> step k = continued s k) \/
     (forall k, (S k < L)%nat -> step k = opposite (continued s k))).
Proof.
  intros step L. assert (O2 : forall s, opposite (opposite s) = s) by (intros []; reflexivity).
  assert (P : forall s, In s eleven -> continued s 0 = Plus)
    by (apply Forall_forall; unfold eleven; repeat constructor).
  destruct (step O) eqn:H0.
  - rewrite census_of_plus by exact H0. split.
    + intros (s & I & H). exists s. split; [exact I | left; exact H].
    + intros (s & I & [H | H]); [exists s; split; assumption|].
      (* With two layers or more the first sign is that of the image, -. *)
      destruct (le_lt_dec L 1) as [A | A]; [exists s; split; [exact I | lia]|].
      specialize (H O A). rewrite (P s I), H0 in H. discriminate H.
  - rewrite <- mirror_image, census_of_plus by (rewrite H0; reflexivity). split.
    + intros (s & I & H). exists s. split; [exact I | right]. intros k Hk. rewrite <- (H k Hk), O2. reflexivity.
    + intros (s & I & [H | H]).
      * destruct (le_lt_dec L 1) as [A | A]; [exists s; split; [exact I | lia]|].
        specialize (H O A). rewrite (P s I), H0 in H. discriminate H.
      * exists s. split; [exact I|]. intros k Hk. rewrite (H k Hk), O2. reflexivity.
Qed.

(** The sign lists of the stable stackings that begin with +, the last sign first, without repetition. *)
Definition standing (L : nat) : list (list sign) := nodup same_signs (beginnings (L - 1)).

Lemma different : forall A B C (f : A -> B) (g : A -> C) l,
  (forall x y, f x = f y -> g x = g y) -> NoDup (List.map g l) -> NoDup (List.map f l).
Proof.
  intros A B C f g l H. induction l as [|x l IH]; cbn [List.map]; intros N; [constructor|].
  inversion N as [|y m N1 N2]; subst. constructor; [|auto].
  rewrite in_map_iff in *. intros (y & E & I). apply N1. exists y. split; [apply H; exact E | exact I].
Qed.

Theorem how_many_stand : forall L,
  NoDup (standing L) /\
  (forall s, In s (standing L) <->
     exists step, step O = Plus /\ stands [(0, 0)%Z] step L /\ prefix step (L - 1) = s) /\
  length (standing L) = match L with 0 | 1 | 2 => 1 | 3 => 2 | 4 => 4 | 5 => 8 | _ => 11 end%nat.
Proof.
  intros L. split; [apply NoDup_nodup|]. split.
  - intros s. unfold standing. rewrite nodup_In. unfold beginnings. rewrite in_map_iff. split.
    + intros (t & E & I). exists (continued t).
      assert (P : continued t 0 = Plus) by (clear - I; revert t I; apply Forall_forall; unfold eleven; repeat constructor).
      split; [exact P|]. split; [|exact E]. apply census_of_plus; [exact P|]. exists t. split; [exact I | reflexivity].
    + intros (step & H0 & H & E). apply census_of_plus in H; [|exact H0]. destruct H as (t & I & H).
      exists t. split; [|exact I]. rewrite <- E. apply same_prefix. intros k Hk. symmetry. apply H. lia.
  - do 6 (destruct L as [|L]; [vm_compute; reflexivity|]).
    unfold standing. rewrite nodup_fixed_point; [unfold beginnings; rewrite map_length; reflexivity|].
    apply (different _ _ _ _ (fun s => prefix (continued s) 5)).
    + intros s t E. apply same_prefix. intros k Hk. apply (proj1 (same_prefix _ _ _) E). lia.
    + assert (N : nodup same_signs (beginnings 5) = beginnings 5) by (vm_compute; reflexivity).
      change (NoDup (beginnings 5)). rewrite <- N. apply NoDup_nodup.
Qed.
