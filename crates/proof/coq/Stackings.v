(** Any stacking below any finite top layer: its forces, and the proof that no run of five steps can end. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool List.
From Cannonpile Require Import Directions Sums Formulas Balance.

Import ListNotations.
Open Scope Q_scope.

(** The pile is built downwards: every sphere of a layer has its three supports in the next layer. [step k] is the
    sign of the step below layer k. *)
Section Pile.
Variable top : list (Z * Z).
Variable step : nat -> sign.

Definition support (sigma : sign) (p : Z * Z) (d : direction) : Z * Z :=
  let (di, dj) := descent sigma d in ((fst p + di)%Z, (snd p + dj)%Z).

Fixpoint layer (k : nat) : list (Z * Z) :=
  match k with
  | O => top
  | S m => flat_map (fun p => [support (step m) p Alpha; support (step m) p Beta; support (step m) p Gamma]) (layer m)
  end.

Definition member (l : list (Z * Z)) (i j : Z) : bool :=
  existsb (fun p => (fst p =? i)%Z && (snd p =? j)%Z) l.

(** The site of the layer above whose contact in a direction leads to (i, j). *)
Definition above_in (sigma : sign) (d : direction) (i j : Z) : Z * Z :=
  let (di, dj) := descent sigma d in ((i - di)%Z, (j - dj)%Z).

(** Action and reaction: a sphere receives the forces that the spheres above transmit to it. *)
Definition arriving (f : nat -> Z -> Z -> three Q) (k : nat) (i j : Z) : three Q :=
  match k with
  | O => each 0
  | S m =>
    let from d := let (a, b) := above_in (step m) d i j in if member (layer m) a b then on d (f m a b) else 0 in
    Three (from Alpha) (from Beta) (from Gamma)
  end.

(** The sign of the step above a layer. The top layer has none, and receives no force. *)
Definition step_above (k : nat) : sign := match k with O => step O | S m => step m end.

(** Newton's law for a sphere of weight mg, on an equilateral base. *)
Definition in_balance (f : nat -> Z -> Z -> three Q) (k : nat) (i j : Z) : Prop :=
  unbalanced (f k i j) (directions_under (1 # 2) (step k)) (arriving f k i j)
    (directions_under (1 # 2) (step_above k)) (force 1 (weight (increments (1 # 2)))) =v= nothing.

(** The forces that a sphere transmits: T g + 1. *)
Definition passing (f : nat -> Z -> Z -> three Q) (k : nat) (i j : Z) : three Q :=
  by_line transmitted (transferred (step_above k) (step k) (arriving f k i j)) (each 1).

Theorem balance_is_transfer : forall f k i j,
  in_balance f k i j <-> f k i j =3= passing f k i j.
Proof. intros. apply newton_in_any_stacking. Qed.

Lemma member_iff : forall l i j, member l i j = true <-> In (i, j) l.
Proof.
  intros l i j. unfold member. rewrite existsb_exists. split.
  - intros ([a b] & H & E). apply andb_true_iff in E. rewrite !Z.eqb_eq in E. simpl in E.
    destruct E; subst. exact H.
  - intros H. exists (i, j). split; [exact H|]. simpl. rewrite !Z.eqb_refl. reflexivity.
Qed.

(** The forces, from the top down. *)
Fixpoint forces_of (k : nat) : Z -> Z -> three Q :=
  match k with
  | O => fun _ _ => each 1
  | S m => fun i j =>
    let from d := let (a, b) := above_in (step m) d i j in if member (layer m) a b then on d (forces_of m a b) else 0 in
    by_line transmitted (transferred (step m) (step (S m)) (Three (from Alpha) (from Beta) (from Gamma))) (each 1)
  end.

Lemma transferred_of_same : forall from to g h, g =3= h -> transferred from to g =3= transferred from to h.
Proof.
  intros from to g h (a & b & c). destruct from, to; unfold transferred; repeat split; formulas; congruent.
Qed.

Lemma passed_of_same : forall g h n, g =3= h -> by_line transmitted g n =3= by_line transmitted h n.
Proof. intros g h n (a & b & c). repeat split; formulas; congruent. Qed.

Lemma arriving_of_same : forall f g k i j,
  (forall m a b, (m < k)%nat -> In (a, b) (layer m) -> f m a b =3= g m a b) ->
  arriving f k i j =3= arriving g k i j.
Proof.
  intros f g [|m] i j H; [reflexivity|].
  assert (A : forall d, on d (arriving f (S m) i j) == on d (arriving g (S m) i j)).
  { intros d.
    assert (R : forall h, on d (arriving h (S m) i j) =
      let (a, b) := above_in (step m) d i j in if member (layer m) a b then on d (h m a b) else 0)
      by (intros; destruct d; reflexivity).
    rewrite !R. destruct (above_in (step m) d i j) as [a b].
    destruct (member (layer m) a b) eqn:E; [|reflexivity].
    apply member_iff in E. destruct (H m a b (Nat.lt_succ_diag_r m) E) as (x & y & z).
    destruct d; cbn [on]; assumption. }
  exact (conj (A Alpha) (conj (A Beta) (A Gamma))).
Qed.

Lemma passing_of_forces : forall k i j, forces_of k i j =3= passing forces_of k i j.
Proof.
  intros [|m] i j.
  - unfold passing, transferred, step_above. destruct (step 0); by_components.
  - reflexivity.
Qed.

(** All spheres of L layers are in balance if and only if their forces are those of the recursion. *)
Theorem recursion_is_the_only_solution : forall f L,
  (forall k i j, (k < L)%nat -> In (i, j) (layer k) -> in_balance f k i j)
  <->
  (forall k i j, (k < L)%nat -> In (i, j) (layer k) -> f k i j =3= forces_of k i j).
Proof.
  intros f L. split.
  - intros H k. induction k as [k IH] using lt_wf_ind. intros i j HL Hi.
    specialize (H k i j HL Hi). apply balance_is_transfer in H. rewrite H, passing_of_forces.
    apply passed_of_same. apply transferred_of_same. apply arriving_of_same.
    intros m a b Hm Hin. apply IH; [assumption | lia | assumption].
  - intros H k i j HL Hi. apply balance_is_transfer. rewrite (H k i j HL Hi), passing_of_forces.
    apply passed_of_same. apply transferred_of_same. apply arriving_of_same.
    intros m a b Hm Hin. symmetry. apply H; [lia | assumption].
Qed.

(** A pile of L layers is stable, without horizontal contacts, if the forces that balance all its free spheres are
    compressive. *)
Definition stands (L : nat) : Prop :=
  exists f, forall k i j, (S k < L)%nat -> In (i, j) (layer k) ->
    in_balance f k i j /\ forall d, 0 <= on d (f k i j).

Theorem stands_if_the_recursion_pushes : forall L,
  stands L <-> forall k i j d, (S k < L)%nat -> In (i, j) (layer k) -> 0 <= on d (forces_of k i j).
Proof.
  intros L. split.
  - intros (f & H) k i j d HL Hi.
    assert (E : f k i j =3= forces_of k i j).
    { apply (recursion_is_the_only_solution f (L - 1)); [|lia|assumption]. intros. apply H; [lia|assumption]. }
    destruct E as (a & b & c). destruct (H k i j HL Hi) as [_ P]. specialize (P d).
    destruct d; cbn [on] in *; lra.
  - intros H. exists forces_of. intros k i j HL Hi. split; [|intros d; apply H; assumption].
    apply balance_is_transfer. apply passing_of_forces.
Qed.

(** ** Runs *)

(** The distance of a site towards the side to which the beta contacts of a step lead. *)
Definition far (sigma : sign) (p : Z * Z) : Z := match sigma with Plus => fst p | Minus => (- fst p)%Z end.

(** A layer that is not empty has a farthest sphere. *)
Lemma farthest : forall sigma l, l <> [] ->
  exists p, In p l /\ forall p', In p' l -> (far sigma p' <= far sigma p)%Z.
Proof.
  intros sigma l. induction l as [|p l IH]; [congruence|]. intros _.
  destruct l as [|p' l].
  - exists p. split; [left; reflexivity|]. intros p' [E | []]. subst. lia.
  - destruct IH as (r & Hr & Hm); [discriminate|].
    destruct (Z_le_gt_dec (far sigma p) (far sigma r)).
    + exists r. split; [right; exact Hr|]. intros s [E | Hs]; [subst; assumption | apply Hm; exact Hs].
    + exists p. split; [left; reflexivity|]. intros s [E | Hs]; [subst; lia|]. specialize (Hm s Hs). lia.
Qed.

Lemma layers_are_not_empty : top <> [] -> forall k, layer k <> [].
Proof.
  intros H k. induction k as [|m IH]; [exact H|]. simpl. destruct (layer m); [congruence | discriminate].
Qed.

(** The sphere r steps of sign sigma down its beta line. *)
Definition down (sigma : sign) (p : Z * Z) (r : nat) : Z * Z :=
  match sigma with
  | Plus => ((fst p + Z.of_nat r)%Z, snd p)
  | Minus => ((fst p - Z.of_nat r)%Z, snd p)
  end.

Section Run.
Variables (sigma : sign) (a m : nat) (p : Z * Z).
Hypothesis same_sign : forall r, (r < m)%nat -> step (a + r) = sigma.
Hypothesis is_in : In p (layer a).
Hypothesis is_farthest : forall p', In p' (layer a) -> (far sigma p' <= far sigma p)%Z.

(** The sphere r steps down its line is the farthest one of its layer. *)
Lemma still_farthest : forall r, (r <= m)%nat ->
  In (down sigma p r) (layer (a + r)) /\
  forall p', In p' (layer (a + r)) -> (far sigma p' <= far sigma p + Z.of_nat r)%Z.
Proof.
  induction r as [|r IH]; intros Hr.
  - rewrite Nat.add_0_r. split.
    + destruct p as [i j], sigma; simpl; rewrite ?Z.add_0_r, ?Z.sub_0_r; exact is_in.
    + intros p' H. specialize (is_farthest p' H). lia.
  - destruct IH as [I F]; [lia|]. rewrite Nat.add_succ_r. cbn [layer].
    rewrite same_sign by lia. split.
    + apply in_flat_map. exists (down sigma p r). split; [exact I|].
      right. left. unfold support, down, descent. destruct sigma; cbn [fst snd]; f_equal; lia.
    + intros p' H. apply in_flat_map in H. destruct H as (s & Hs & E). specialize (F s Hs).
      unfold support, descent in E.
      destruct sigma; cbn [far fst snd In] in *;
        destruct E as [E | [E | [E | []]]]; subst; cbn [fst snd]; lia.
Qed.

(** The sphere r steps down its line receives a force only along beta. *)
Lemma arrives_along_beta : forall f r, (r < m)%nat ->
  arriving f (a + S r) (fst (down sigma p (S r))) (snd (down sigma p (S r)))
  = Three 0 (on Beta (f (a + r)%nat (fst (down sigma p r)) (snd (down sigma p r)))) 0.
Proof.
  intros f r Hr. rewrite Nat.add_succ_r. cbn [arriving]. rewrite same_sign by assumption.
  destruct (still_farthest r) as [I F]; [lia|].
  assert (N : forall i j, far sigma (i, j) = (far sigma p + Z.of_nat r + 1)%Z -> member (layer (a + r)) i j = false).
  { intros i j E. apply not_true_iff_false. rewrite member_iff. intros H. specialize (F _ H). lia. }
  assert (M : member (layer (a + r)) (fst (down sigma p r)) (snd (down sigma p r)) = true).
  { apply member_iff. rewrite <- surjective_pairing. exact I. }
  clear F I. unfold above_in, descent, down in *. destruct sigma; cbn [fst snd far on] in *.
  - rewrite (N (fst p + Z.of_nat (S r) - 0)%Z (snd p - 0)%Z) by lia.
    rewrite (N (fst p + Z.of_nat (S r) - 0)%Z (snd p - 1)%Z) by lia.
    replace (fst p + Z.of_nat (S r) - 1)%Z with (fst p + Z.of_nat r)%Z by lia.
    replace (snd p - 0)%Z with (snd p) by lia. rewrite M. reflexivity.
  - rewrite (N (fst p - Z.of_nat (S r) - 0)%Z (snd p - 0)%Z) by lia.
    rewrite (N (fst p - Z.of_nat (S r) - 0)%Z (snd p - -1)%Z) by lia.
    replace (fst p - Z.of_nat (S r) - -1)%Z with (fst p - Z.of_nat r)%Z by lia.
    replace (snd p - 0)%Z with (snd p) by lia. rewrite M. reflexivity.
Qed.

Variable f : nat -> Z -> Z -> three Q.
Hypothesis balance : forall k i j, (k <= a + m)%nat -> In (i, j) (layer k) -> in_balance f k i j.

(** The force that the sphere r steps down transmits along beta. *)
Definition along (r : nat) : Q := on Beta (f (a + r)%nat (fst (down sigma p r)) (snd (down sigma p r))).

Lemma in_balance_down : forall r, (r <= m)%nat ->
  f (a + r)%nat (fst (down sigma p r)) (snd (down sigma p r))
  =3= passing f (a + r) (fst (down sigma p r)) (snd (down sigma p r)).
Proof.
  intros r Hr. apply balance_is_transfer. apply balance; [lia|].
  destruct (still_farthest r Hr) as [I _]. rewrite <- surjective_pairing. exact I.
Qed.

(** Within the run the force along the line grows by one in each step. *)
Lemma counts_up : forall r, (r < m)%nat -> along r == along 0 + n_of r.
Proof.
  induction r as [|r IH]; intros Hr; [rewrite n_of_0; ring|].
  rewrite n_of_S. unfold along at 1.
  destruct (in_balance_down (S r)) as (_ & B & _); [lia|]. cbn [on]. rewrite B.
  unfold passing. rewrite arrives_along_beta by lia.
  replace (step_above (a + S r)) with sigma
    by (rewrite Nat.add_succ_r; cbn [step_above]; symmetry; apply same_sign; lia).
  rewrite same_sign by assumption.
  assert (T : transferred sigma sigma (Three 0 (along r) 0) = Three 0 (along r) 0) by (destruct sigma; reflexivity).
  fold (along r). rewrite T. formulas. rewrite IH by lia. ring.
Qed.

(** At the end, where the sign changes, a third of the force is subtracted. *)
Lemma at_the_end : (0 < m)%nat -> step (a + m) = opposite sigma ->
  along m == 1 - (along 0 + n_of m - 1) * (1 # 3).
Proof.
  intros Hm Hc. assert (E : exists r, S r = m) by (exists (m - 1)%nat; lia). destruct E as [r E].
  rewrite <- E in Hc |- *.
  unfold along at 1. destruct (in_balance_down (S r)) as (_ & B & _); [lia|]. cbn [on]. rewrite B.
  unfold passing. rewrite arrives_along_beta by lia. rewrite Hc.
  replace (step_above (a + S r)) with sigma
    by (rewrite Nat.add_succ_r; cbn [step_above]; symmetry; apply same_sign; lia).
  fold (along r).
  assert (T : transferred sigma (opposite sigma) (Three 0 (along r) 0) = half_turn (Three 0 (along r) 0))
    by (destruct sigma; reflexivity).
  rewrite T. formulas. rewrite (counts_up r) by lia. rewrite n_of_S. ring.
Qed.

End Run.

(** ** No run of five can end

    Steps a to a+m-1 have one sign, and step a+m the other. If no contact below layer a is tensile, then a contact below
    layer a+m is tensile. This holds for m at least 5, and for m at least 4 if the run begins at the top. *)
Theorem the_end_of_a_run_pulls : forall sigma a m f,
  top <> [] ->
  (forall r, (r < m)%nat -> step (a + r) = sigma) -> step (a + m) = opposite sigma ->
  (5 <= m)%nat \/ (a = 0 /\ 4 <= m)%nat ->
  (forall k i j, (k <= a + m)%nat -> In (i, j) (layer k) -> in_balance f k i j) ->
  (forall i j, In (i, j) (layer a) -> 0 <= on Beta (f a i j)) ->
  exists i j, In (i, j) (layer (a + m)) /\ on Beta (f (a + m)%nat i j) < 0.
Proof.
  intros sigma a m f Ht Hs Hc Hm Hb Hf.
  destruct (farthest sigma (layer a) (layers_are_not_empty Ht a)) as (p & I & F).
  exists (fst (down sigma p m)), (snd (down sigma p m)). split.
  - rewrite <- surjective_pairing. apply (still_farthest sigma a m p Hs I F); lia.
  - assert (E : along sigma a p f m == 1 - (along sigma a p f 0 + n_of m - 1) * (1 # 3))
      by (apply at_the_end; auto; lia).
    unfold along in E at 1. rewrite E. clear E.
    assert (P : down sigma p 0 = p) by (destruct p, sigma; unfold down; simpl; f_equal; lia).
    destruct Hm as [Hm | [Ha Hm]].
    + assert (A : 0 <= along sigma a p f 0).
      { unfold along. rewrite P, Nat.add_0_r. apply Hf. rewrite <- surjective_pairing. exact I. }
      assert (N : 5 <= n_of m) by (unfold n_of; change 5 with (q 5); rewrite <- Zle_Qle; lia). lra.
    + assert (A : along sigma a p f 0 == 1).
      { unfold along. rewrite P, Nat.add_0_r. subst a.
        assert (B : in_balance f 0 (fst p) (snd p)).
        { apply Hb; [lia|]. rewrite <- surjective_pairing. exact I. }
        apply balance_is_transfer in B. destruct B as (_ & B & _). cbn [on]. rewrite B.
        unfold passing, arriving, step_above, transferred. destruct (step 0); formulas; ring. }
      assert (N : 4 <= n_of m) by (unfold n_of; change 4 with (q 4); rewrite <- Zle_Qle; lia). lra.
Qed.

Theorem no_run_of_five_can_end : forall sigma a m L,
  top <> [] ->
  (forall r, (r < m)%nat -> step (a + r) = sigma) -> step (a + m) = opposite sigma ->
  (5 <= m)%nat \/ (a = 0 /\ 4 <= m)%nat ->
  (a + m + 1 < L)%nat -> ~ stands L.
Proof.
  intros sigma a m L Ht Hs Hc Hm HL (f & H).
  destruct (the_end_of_a_run_pulls sigma a m f) as (i & j & I & N); auto.
  - intros. apply H; [lia | assumption].
  - intros. apply H; [lia | assumption].
  - destruct (H (a + m)%nat i j) as [_ P]; [lia | assumption|]. specialize (P Beta). lra.
Qed.

End Pile.
