(** The straight pile, layer by layer from the top: the balance of every sphere has one solution, the paper's closed
    form. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool.
From Cannonpile Require Import Directions Sums Formulas Balance.

Open Scope Q_scope.

(** Layer k from the top holds the sites 0 <= i, 0 <= j, i + j <= k. *)
Definition occupied (k : nat) (i j : Z) : bool :=
  ((0 <=? i) && (0 <=? j) && (i + j <=? Z.of_nat k))%Z.

Lemma occupied_iff : forall k i j,
  occupied k i j = true <-> (0 <= i /\ 0 <= j /\ i + j <= Z.of_nat k)%Z.
Proof. intros. unfold occupied. rewrite !andb_true_iff, !Z.leb_le. tauto. Qed.

(** The forces of a pile: of sphere (i, j) of layer k on its three supports, in multiples of f0. *)
Definition forces := nat -> Z -> Z -> three Q.

(** The site of the layer above whose contact in a direction leads to (i, j). *)
Definition above_on (d : direction) (i j : Z) : Z * Z :=
  let (di, dj) := descent Plus d in ((i - di)%Z, (j - dj)%Z).

(** Action and reaction: a sphere receives the forces that the spheres above transmit to it; without such a sphere,
    zero. *)
Definition received (f : forces) (k : nat) (i j : Z) : three Q :=
  match k with
  | O => each 0
  | S m =>
    let from d := let (a, b) := above_on d i j in if occupied m a b then on d (f m a b) else 0 in
    Three (from Alpha) (from Beta) (from Gamma)
  end.

(** Newton's law for the sphere (i, j) of layer k, of weight mg. *)
Definition balanced (s : Q) (f : forces) (k : nat) (i j : Z) : Prop :=
  let e := directions s in
  unbalanced (f k i j) e (received f k i j) e (weight (increments s)) =v= nothing.

(** ** Counts *)

(** The number of spheres above (i, j) of layer k on its line, counted one by one until the line ends. *)
Fixpoint spheres_above (d : direction) (k : nat) (i j : Z) : Z :=
  match k with
  | O => 0
  | S m => let (a, b) := above_on d i j in
           if occupied m a b then (1 + spheres_above d m a b)%Z else 0
  end.

(** The counts of the appendix, as integers. *)
Theorem counts : forall d k i j, occupied k i j = true ->
  spheres_above d k i j = on d (Integers.above i j (Z.of_nat k)).
Proof.
  intros d k. induction k as [|m IH]; intros i j H; apply occupied_iff in H.
  - destruct d; simpl; lia.
  - destruct d; cbn [spheres_above above_on descent];
      match goal with |- context [occupied m ?a ?b] => destruct (occupied m a b) eqn:E end;
      try (rewrite IH by assumption);
      try (apply not_true_iff_false in E; rewrite occupied_iff in E);
      cbn [on Integers.above alpha beta gamma]; lia.
Qed.

(** The rotation (i, j) -> (j, k-i-j) about the axis maps alpha to beta to gamma to alpha. *)
Theorem rotation : forall i j k,
  above j (k - i - j) k =3= Three (above i j k).(beta) (above i j k).(gamma) (above i j k).(alpha).
Proof. intros. by_components. Qed.

(** The forces on (i, j) of layer k from above, in closed form, (8) and (9). *)
Definition brought (s i j k : Q) : three Q := by_line force (above i j k) (increments s).

(** The forces that (i, j) of layer k transmits, (10). *)
Definition closed_form (s i j k : Q) : three Q := by_line transmitted (brought s i j k) (increments s).

(** The force transmitted above is the force received below, for all i, j, k. *)
Theorem action_reaction : forall s i j k d,
  let (di, dj) := descent Plus d in
  on d (closed_form s i j k) == on d (brought s (i + q di) (j + q dj) (k + 1)).
Proof. intros s i j k []; unfold closed_form, brought; formulas; cbn [descent q]; formulas; ring. Qed.

(** At the surface no force is received: along alpha on i + j = k, along beta on i = 0, along gamma on j = 0. *)
Theorem surface : forall s i j k,
  (brought s i j (i + j)).(alpha) == 0 /\ (brought s 0 j k).(beta) == 0 /\ (brought s i 0 k).(gamma) == 0.
Proof. intros. unfold brought. formulas. repeat split; ring. Qed.

(** ** The solution *)

Lemma newton_of_mg : forall s g up, ~ 1 + s == 0 ->
  (unbalanced up (directions s) g (directions s) (weight (increments s)) =v= nothing
   <-> up =3= by_line transmitted g (increments s)).
Proof.
  intros s g up H. assert (N := newton s g 1 up H).
  destruct g, up. unfold to_below, own in N. formulas_in N. formulas.
  split; [intros (a & b & c); destruct N as [N _]; destruct N as (x & y & z) |
          intros (a & b & c); destruct N as [_ N]; destruct N as (x & y & z)]; repeat split; lra.
Qed.

(** If each sphere above transmits w for each sphere on its lines and for itself, then by the recursion a sphere
    receives w for each sphere above. *)
Lemma received_of_counts : forall w f k i j, occupied k i j = true ->
  (forall m a b, (m < k)%nat -> occupied m a b = true ->
    f m a b =3= by_line transmitted (by_line force (above (q a) (q b) (n_of m)) w) w) ->
  received f k i j =3= by_line force (above (q i) (q j) (n_of k)) w.
Proof.
  intros w f [|m] i j H Hf.
  - apply occupied_iff in H. simpl in H. assert (i = 0)%Z by lia. assert (j = 0)%Z by lia. subst.
    cbn [received]. by_components.
  - apply occupied_iff in H. rewrite Nat2Z.inj_succ in H.
    assert (A : forall d, on d (received f (S m) i j) == on d (by_line force (above (q i) (q j) (n_of (S m))) w)).
    { intros d.
      assert (R : on d (received f (S m) i j) =
                  let (a, b) := above_on d i j in if occupied m a b then on d (f m a b) else 0)
        by (destruct d; reflexivity).
      rewrite R. clear R.
      destruct d; cbn [above_on descent];
        match goal with |- context [occupied m ?a ?b] => destruct (occupied m a b) eqn:E end.
      1, 3, 5: specialize (Hf m _ _ (Nat.lt_succ_diag_r m) E); destruct Hf as (Ha & Hb & Hc);
        cbn [on]; (rewrite Ha || rewrite Hb || rewrite Hc);
        unfold Z.sub; formulas; rewrite ?n_of_S;
        rewrite ?inject_Z_plus, ?inject_Z_opp; cbn [q]; unfold n_of; cbn [Z.opp]; ring.
      all: apply not_true_iff_false in E; rewrite occupied_iff in E; formulas.
      - assert (Z.of_nat m = i + j - 1)%Z by lia. rewrite n_of_S. unfold n_of. rewrite H0.
        unfold Z.sub. rewrite !inject_Z_plus, inject_Z_opp. ring.
      - assert (i = 0)%Z by lia. subst. ring.
      - assert (j = 0)%Z by lia. subst. ring. }
    exact (conj (A Alpha) (conj (A Beta) (A Gamma))).
Qed.

(** The closed form is the force received by the recursion, if the spheres above transmit the closed form. *)
Lemma received_of_closed_form : forall s f k i j, occupied k i j = true ->
  (forall m a b, (m < k)%nat -> occupied m a b = true -> f m a b =3= closed_form s (q a) (q b) (n_of m)) ->
  received f k i j =3= brought s (q i) (q j) (n_of k).
Proof. intros s. exact (received_of_counts (increments s)). Qed.

(** Every sphere of L layers is in balance if and only if all forces are those of the closed form: it is the only
    solution of the recursion. *)
Theorem closed_form_is_the_only_solution : forall s f L, ~ 1 + s == 0 ->
  ((forall k i j, (k < L)%nat -> occupied k i j = true -> balanced s f k i j)
   <->
   (forall k i j, (k < L)%nat -> occupied k i j = true -> f k i j =3= closed_form s (q i) (q j) (n_of k))).
Proof.
  intros s f L Hs. split.
  - intros H k. induction k as [k IH] using lt_wf_ind. intros i j HL Ho.
    specialize (H k i j HL Ho). unfold balanced in H. apply newton_of_mg in H; [|assumption].
    rewrite H. assert (R : received f k i j =3= brought s (q i) (q j) (n_of k)).
    { apply received_of_closed_form; [assumption|]. intros. apply IH; [assumption | lia | assumption]. }
    destruct R as (a & b & c). unfold closed_form, by_line, transmitted, same. cbn [alpha beta gamma].
    rewrite a, b, c. repeat split; reflexivity.
  - intros H k i j HL Ho. unfold balanced. apply newton_of_mg; [assumption|].
    rewrite (H k i j HL Ho). assert (R : received f k i j =3= brought s (q i) (q j) (n_of k)).
    { apply received_of_closed_form; [assumption|]. intros. apply H; [lia | assumption]. }
    destruct R as (a & b & c). unfold closed_form, by_line, transmitted, same. cbn [alpha beta gamma].
    rewrite a, b, c. repeat split; reflexivity.
Qed.

(** For 0 < s < 1 the forces are positive: the straight pile is stable. *)
Theorem straight_piles_stand : forall s k i j d, 0 < s -> occupied k i j = true ->
  0 < on d (closed_form s (q i) (q j) (n_of k)).
Proof.
  intros s k i j d Hs H. apply occupied_iff in H. destruct H as (Hi & Hj & Hk).
  rewrite Zle_Qle in Hi, Hj, Hk. rewrite inject_Z_plus in Hk.
  fold (n_of k) in Hk. change (q 0) with 0 in *. destruct d; unfold closed_form, brought; formulas; nra.
Qed.
