(** Virtual work of a whole pile with horizontal contacts, and its consequences: bounds by fields, and the elastic
    state. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool List.
From Cannonpile Require Import Directions Sums Formulas Balance Straight Stackings Horizontal.

Import ListNotations.
Open Scope Q_scope.

(* Statements in sections depend only on the variables of their types, not on those of their proofs. *)
Set Default Proof Using "Type".

(** ** Sums over spheres *)

(** The sum over the elements of a list. *)
Fixpoint over {A} (l : list A) (f : A -> Q) : Q :=
  match l with
  | [] => 0
  | x :: rest => f x + over rest f
  end.

Lemma over_of_same : forall A (l : list A) f g, (forall x, In x l -> f x == g x) -> over l f == over l g.
Proof.
  intros A l f g. induction l as [|x l IH]; intros H; cbn [over]; [reflexivity|].
  rewrite (H x) by (left; reflexivity). rewrite IH by (intros; apply H; right; assumption). reflexivity.
Qed.

Lemma over_of_sum : forall A (l : list A) f g, over l (fun x => f x + g x) == over l f + over l g.
Proof. intros A l f g. induction l as [|x l IH]; cbn [over]; [ring|]. rewrite IH. ring. Qed.

Lemma over_of_multiple : forall A (l : list A) c f, over l (fun x => c * f x) == c * over l f.
Proof. intros A l c f. induction l as [|x l IH]; cbn [over]; [ring|]. rewrite IH. ring. Qed.

Lemma over_of_nothing : forall A (l : list A), over l (fun _ => 0) == 0.
Proof. intros A l. induction l as [|x l IH]; cbn [over]; [ring|]. rewrite IH. ring. Qed.

Lemma total_of_nothing : forall n, total n (fun _ => 0) == 0.
Proof. induction n as [|n IH]; cbn [total]; [reflexivity|]. rewrite IH. ring. Qed.

Lemma over_is_not_negative : forall A (l : list A) f, (forall x, In x l -> 0 <= f x) -> 0 <= over l f.
Proof.
  intros A l f. induction l as [|x l IH]; intros H; cbn [over]; [lra|].
  assert (0 <= f x) by (apply H; left; reflexivity).
  assert (0 <= over l f) by (apply IH; intros; apply H; right; assumption). lra.
Qed.

Lemma over_in_any_order : forall A B (l : list A) (m : list B) f,
  over l (fun x => over m (fun y => f x y)) == over m (fun y => over l (fun x => f x y)).
Proof.
  intros A B l m f. induction l as [|x l IH]; cbn [over]; [symmetry; apply over_of_nothing|].
  rewrite IH, over_of_sum. reflexivity.
Qed.

(** A site (i, j) of a layer. *)
Definition site : Type := Z * Z.

Definition same_site : forall p r : site, {p = r} + {p <> r}.
Proof. decide equality; apply Z.eq_dec. Defined.

Definition holds (l : list site) (p : site) : bool := member l (fst p) (snd p).

Lemma holds_iff : forall l p, holds l p = true <-> In p l.
Proof. intros l [i j]. apply member_iff. Qed.

(** A sum with a single nonzero term. *)
Lemma over_one : forall (l : list site) p f, NoDup l ->
  over l (fun r => if same_site r p then f r else 0) == if holds l p then f p else 0.
Proof.
  intros l p f. induction l as [|r l IH]; intros N; cbn [over].
  - destruct p. reflexivity.
  - inversion N as [|r' l' H N']; subst. rewrite IH by assumption.
    destruct (same_site r p) as [E | E].
    + subst r. replace (holds (p :: l) p) with true by (symmetry; apply holds_iff; left; reflexivity).
      replace (holds l p) with false by (symmetry; apply not_true_iff_false; rewrite holds_iff; exact H). ring.
    + replace (holds (r :: l) p) with (holds l p); [ring|].
      apply eq_true_iff_eq. rewrite !holds_iff. simpl. tauto.
Qed.

(** Let [there] map a site to its neighbour. A sum over such pairs of sites can run over either site of a pair. *)
Lemma over_moved : forall (l m : list site) there back f, NoDup l -> NoDup m ->
  (forall p r : site, there r = p <-> r = back p) ->
  over l (fun p => if holds m (back p) then f (back p) p else 0)
  == over m (fun r => if holds l (there r) then f r (there r) else 0).
Proof.
  intros l m there back f Hl Hm H.
  transitivity (over l (fun p => over m (fun r => if same_site r (back p) then f r p else 0))).
  - apply over_of_same. intros p _. rewrite (over_one m (back p) (fun r => f r p)) by assumption. reflexivity.
  - rewrite over_in_any_order. apply over_of_same. intros r _.
    rewrite <- (over_one l (there r) (fun p => f r p)) by assumption. apply over_of_same. intros p _.
    destruct (same_site r (back p)) as [E | E], (same_site p (there r)) as [F | F]; try reflexivity.
    + apply H in E. congruence.
    + symmetry in F. apply H in F. contradiction.
Qed.

(** ** The pile

    Any stacking below any finite top layer (Stackings.v), with forces f of the sloping contacts and X of the
    horizontal ones: X k x i j is the force between (i, j) of layer k and its next sphere along the axis x. *)
Inductive axis := AB | AG | GB.

Definition from (x : axis) : direction := match x with AB | AG => Alpha | GB => Gamma end.
Definition to (x : axis) : direction := match x with AB | GB => Beta | AG => Gamma end.

(** p + d_b - d_a, and p - d_b + d_a. *)
Definition next (x : axis) (p : site) : site :=
  support Plus (above_in Plus (from x) (fst p) (snd p)) (to x).
Definition last (x : axis) (p : site) : site :=
  support Plus (above_in Plus (to x) (fst p) (snd p)) (from x).

Lemma next_and_last : forall x p r, next x r = p <-> r = last x p.
Proof.
  intros x [i j] [a b]. unfold next, last, support, above_in.
  destruct x; cbn [from to descent fst snd]; (split; intros E; injection E; intros; f_equal; lia).
Qed.

Section Pile.
Variable top : list site.
Variable step : nat -> sign.

(** The spheres of a layer, each once. *)
Definition spheres (k : nat) : list site := nodup same_site (layer top step k).

Lemma spheres_are : forall k p, In p (spheres k) <-> In p (layer top step k).
Proof. intros. apply nodup_In. Qed.

Lemma spheres_once : forall k, NoDup (spheres k).
Proof. intros. apply NoDup_nodup. Qed.

Lemma holds_spheres : forall k p, holds (spheres k) p = holds (layer top step k) p.
Proof. intros. apply eq_true_iff_eq. rewrite !holds_iff. apply spheres_are. Qed.

(** The sum over all spheres of L layers. *)
Definition over_spheres (L : nat) (f : nat -> Z -> Z -> Q) : Q :=
  total L (fun k => over (spheres k) (fun p => f k (fst p) (snd p))).

Variable f : nat -> Z -> Z -> three Q.
Variable X : nat -> axis -> Z -> Z -> Q.
Variable w : nat -> Z -> Z -> Q.

(** Two spheres of a layer touch if both exist. *)
Definition touches (k : nat) (x : axis) (i j : Z) : bool := holds (layer top step k) (next x (i, j)).

(** The forces of the next sphere and of the previous sphere along an axis. *)
Definition by_next (k : nat) (i j : Z) (x : axis) : Q := if touches k x i j then X k x i j else 0.
Definition by_last (k : nat) (i j : Z) (x : axis) : Q :=
  let p := last x (i, j) in if holds (layer top step k) p then X k x (fst p) (snd p) else 0.

Definition six (by_axis : axis -> Q) : pushes := {| ab := by_axis AB; ag := by_axis AG; gb := by_axis GB |}.

(** Newton's law for a sphere of weight w mg: the forces of its supports, of the spheres above, of its neighbours and
    its weight sum to zero in all components. *)
Definition in_balance_beside (k : nat) (i j : Z) : Prop :=
  plus_vector
    (unbalanced (f k i j) (directions_under (1 # 2) (step k)) (arriving top step f k i j)
       (directions_under (1 # 2) (step_above step k)) (force (w k i j) (weight (increments (1 # 2)))))
    (push (six (by_next k i j)) (six (by_last k i j))) =v= nothing.

(** Forces that balance all spheres of L layers; the next layer is the floor. *)
Definition equilibrium (L : nat) : Prop :=
  forall k i j, (k < L)%nat -> In (i, j) (layer top step k) -> in_balance_beside k i j.

(** No contact is tensile. *)
Definition no_pull (L : nat) : Prop :=
  forall k i j, (k < L)%nat -> In (i, j) (layer top step k) ->
    (forall d, 0 <= on d (f k i j)) /\ (forall x, touches k x i j = true -> 0 <= X k x i j).

(** The forces that a sphere transmits, from its balance. *)
Lemma newton_beside : forall sigma tau g n up x y,
  plus_vector
    (unbalanced up (directions_under (1 # 2) tau) g (directions_under (1 # 2) sigma)
       (force n (weight (increments (1 # 2)))))
    (push x y) =v= nothing ->
  let turned := transferred sigma tau g in
  let h := pushed_by x y in
  up =3= Three (beside turned.(alpha) n h.(alpha) tau) (beside turned.(beta) n h.(beta) tau)
               (beside turned.(gamma) n h.(gamma) tau).
Proof.
  intros sigma tau [a b c] n [u v z] [x1 x2 x3] [y1 y2 y3] H.
  destruct sigma, tau; unfold directions_under, transferred, pushed_by, push, plus_three, minus_three,
    combination, plus_vector, one_on in *; cbn [ab ag gb] in *;
    formulas_in H; destruct H as (Hx & Hy & Hz); formulas; repeat split; lra.
Qed.

(** ** The sum of all virtual works

    For any numbers phi: D of the contacts of a sphere, with Tphi of its supports subtracted, and c of its contacts
    with the next spheres. *)
Variable phi : nat -> Z -> Z -> three Q.

(** T phi: the field phi resolved along the contacts above a sphere. *)
Definition felt (k : nat) (p : site) : three Q :=
  transferred (step_above step k) (step k) (phi k (fst p) (snd p)).

Definition drop (k : nat) (i j : Z) (d : direction) : Q :=
  contact_drop (on d (phi k i j)) (on d (felt (S k) (support (step k) (i, j) d))).

Definition squeeze (k : nat) (x : axis) (i j : Z) : Q :=
  let p := next x (i, j) in compression (phi k i j) (phi k (fst p) (snd p)) (from x) (to x) (step k).

Definition sloping_work (k : nat) (i j : Z) : Q := dot (f k i j) (Three (drop k i j Alpha) (drop k i j Beta) (drop k i j Gamma)).

Definition of_axis (k : nat) (x : axis) (i j : Z) : Q :=
  if touches k x i j then X k x i j * squeeze k x i j else 0.
Definition horizontal_work (k : nat) (i j : Z) : Q := of_axis k AB i j + of_axis k AG i j + of_axis k GB i j.

Definition work_of_weight (k : nat) (i j : Z) : Q := w k i j * sum (phi k i j).

(** The virtual work of the forces that a layer receives. *)
Definition arriving_work (k : nat) : Q :=
  over (spheres k) (fun p => dot (arriving top step f k (fst p) (snd p)) (felt k p)).

(** The horizontal contacts of a layer along an axis: their virtual work at both spheres is X c. *)
Lemma work_along_an_axis : forall k x,
  over (spheres k) (fun p => times (step k)
    (dot (phi k (fst p) (snd p)) (pushed (by_next k (fst p) (snd p) x) (from x) (to x) true)
     + dot (phi k (fst p) (snd p)) (pushed (by_last k (fst p) (snd p) x) (from x) (to x) false)))
  == over (spheres k) (fun p => of_axis k x (fst p) (snd p)).
Proof.
  intros k x.
  pose (there := fun r p : site => times (step k)
    (dot (phi k (fst p) (snd p)) (pushed (X k x (fst r) (snd r)) (from x) (to x) false))).
  transitivity (over (spheres k) (fun p => times (step k)
      (dot (phi k (fst p) (snd p)) (pushed (by_next k (fst p) (snd p) x) (from x) (to x) true)))
    + over (spheres k) (fun p => if holds (spheres k) (last x p) then there (last x p) p else 0)).
  - rewrite <- over_of_sum. apply over_of_same. intros [i j] _. cbn [fst snd]. unfold by_last.
    rewrite holds_spheres. unfold there. cbn [fst snd].
    destruct (holds (layer top step k) (last x (i, j))), (step k), x; unfold times, dot; cbn [from to]; formulas; ring.
  - rewrite (over_moved (spheres k) (spheres k) (next x) (last x)); [|apply spheres_once..|apply next_and_last].
    rewrite <- over_of_sum. apply over_of_same. intros [i j] _. cbn [fst snd].
    unfold of_axis, by_next, touches. rewrite holds_spheres. unfold there. cbn [fst snd].
    destruct (holds (layer top step k) (next x (i, j))).
    + assert (W := work_of_a_horizontal_contact (from x) (to x) (step k) (phi k i j)
        (phi k (fst (next x (i, j))) (snd (next x (i, j)))) (X k x i j)).
      unfold squeeze. rewrite (Qmult_comm (X k x i j)). rewrite <- W by (destruct x; discriminate).
      destruct (step k); unfold times; ring.
    + destruct (step k), x; unfold times, dot; cbn [from to]; formulas; ring.
Qed.

(** The virtual work of the six neighbours on one sphere. *)
Lemma work_of_six : forall sigma psi x y,
  times sigma (dot psi (pushed_by (six x) (six y))) ==
  times sigma (dot psi (pushed (x AB) Alpha Beta true) + dot psi (pushed (y AB) Alpha Beta false))
  + times sigma (dot psi (pushed (x AG) Alpha Gamma true) + dot psi (pushed (y AG) Alpha Gamma false))
  + times sigma (dot psi (pushed (x GB) Gamma Beta true) + dot psi (pushed (y GB) Gamma Beta false)).
Proof. intros [] [] x y; unfold times, dot, pushed_by, six, plus_three; cbn [ab ag gb]; formulas; ring. Qed.

Lemma dot_of_same : forall psi g h, g =3= h -> dot psi g == dot psi h.
Proof. intros psi g h (A & B & C). unfold dot. formulas. rewrite A, B, C. reflexivity. Qed.

(** The balance equations of a layer, multiplied by phi. *)
Lemma work_of_a_layer : forall k,
  (forall i j, In (i, j) (layer top step k) -> in_balance_beside k i j) ->
  over (spheres k) (fun p => dot (phi k (fst p) (snd p)) (f k (fst p) (snd p)))
  + over (spheres k) (fun p => horizontal_work k (fst p) (snd p))
  == arriving_work k + over (spheres k) (fun p => work_of_weight k (fst p) (snd p)).
Proof.
  intros k H. unfold horizontal_work. rewrite !over_of_sum. rewrite <- !work_along_an_axis.
  unfold arriving_work. rewrite <- !over_of_sum. apply over_of_same. intros [i j] Hp. cbn [fst snd].
  apply spheres_are in Hp. specialize (H i j Hp). apply newton_beside in H. cbv zeta in H.
  assert (W := work_of_a_sphere (step_above step k) (step k) (phi k i j) (arriving top step f k i j) (w k i j)
    (pushed_by (six (by_next k i j)) (six (by_last k i j)))).
  cbv zeta in W. unfold felt, work_of_weight. cbn [fst snd]. rewrite <- W. clear W.
  rewrite (dot_of_same _ _ _ H). rewrite work_of_six. reflexivity.
Qed.

(** The forces received from a layer along a line. *)
Definition arriving_along (k : nat) (d : direction) : Q :=
  over (spheres (S k)) (fun p => on d (arriving top step f (S k) (fst p) (snd p)) * on d (felt (S k) p)).

Lemma arriving_by_lines : forall k,
  arriving_work (S k) == arriving_along k Alpha + arriving_along k Beta + arriving_along k Gamma.
Proof.
  intros k. unfold arriving_work, arriving_along. rewrite <- !over_of_sum. apply over_of_same. intros p _. reflexivity.
Qed.

Lemma support_and_above : forall sigma d p r,
  support sigma r d = p <-> r = above_in sigma d (fst p) (snd p).
Proof.
  intros sigma d [i j] [a b]. unfold support, above_in.
  destruct sigma, d; cbn [descent fst snd]; (split; intros E; injection E; intros; f_equal; lia).
Qed.

Lemma supports_are_there : forall k p d, In p (layer top step k) -> In (support (step k) p d) (layer top step (S k)).
Proof.
  intros k p d H. cbn [layer]. apply in_flat_map. exists p. split; [exact H|].
  destruct d; [left | right; left | right; right; left]; reflexivity.
Qed.

(** These forces equal the forces of the contacts above. *)
Lemma arriving_is_given : forall k d, arriving_along k d ==
  over (spheres k) (fun r => on d (f k (fst r) (snd r)) * on d (felt (S k) (support (step k) r d))).
Proof.
  intros k d. unfold arriving_along.
  transitivity (over (spheres (S k)) (fun p => if holds (spheres k) (above_in (step k) d (fst p) (snd p))
    then (let r := above_in (step k) d (fst p) (snd p) in on d (f k (fst r) (snd r)) * on d (felt (S k) p)) else 0)).
  - apply over_of_same. intros [i j] _. rewrite holds_spheres. unfold holds. cbn [fst snd].
    assert (R : on d (arriving top step f (S k) i j) =
      let (a, b) := above_in (step k) d i j in if member (layer top step k) a b then on d (f k a b) else 0)
      by (destruct d; reflexivity).
    rewrite R. destruct (above_in (step k) d i j) as [a b]. cbn [fst snd].
    destruct (member (layer top step k) a b); [reflexivity | ring].
  - rewrite (over_moved (spheres (S k)) (spheres k) (fun r => support (step k) r d)
      (fun p => above_in (step k) d (fst p) (snd p)) (fun r p => on d (f k (fst r) (snd r)) * on d (felt (S k) p)));
      [|apply spheres_once..|intros; apply support_and_above].
    apply over_of_same. intros r H. rewrite holds_spheres.
    replace (holds (layer top step (S k)) (support (step k) r d)) with true; [reflexivity|].
    symmetry. apply holds_iff. apply supports_are_there. apply spheres_are. exact H.
Qed.

(** The sloping contacts of a layer: the work transmitted above minus the work received below. *)
Lemma work_of_slopes : forall k,
  over (spheres k) (fun p => sloping_work k (fst p) (snd p)) + arriving_work (S k)
  == over (spheres k) (fun p => dot (phi k (fst p) (snd p)) (f k (fst p) (snd p))).
Proof.
  intros k. rewrite arriving_by_lines, !arriving_is_given. rewrite <- !over_of_sum. apply over_of_same.
  intros [i j] _. cbn [fst snd]. unfold sloping_work, drop, dot. formulas. ring.
Qed.

Lemma nothing_arrives_on_top : arriving_work 0 == 0.
Proof.
  unfold arriving_work. rewrite <- (over_of_nothing _ (spheres 0)). apply over_of_same. intros p _.
  unfold dot. cbn [arriving]. formulas. ring.
Qed.

(** Virtual work, for any phi and any forces in equilibrium under any weights: the work of all sloping contacts, of
    all horizontal ones, and of the forces on the floor equals the work of the weights. *)
Theorem work_on_the_floor : forall L, equilibrium L ->
  over_spheres L sloping_work + over_spheres L horizontal_work + arriving_work L == over_spheres L work_of_weight.
Proof.
  intros L. induction L as [|L IH]; intros E.
  - unfold over_spheres. cbn [total]. rewrite nothing_arrives_on_top. ring.
  - assert (B := work_of_a_layer L (fun i j => E L i j (Nat.lt_succ_diag_r L))).
    specialize (IH (fun k i j H => E k i j (Nat.lt_lt_succ_r _ _ H))).
    assert (S := work_of_slopes L). unfold over_spheres in *. cbn [total]. lra.
Qed.

(** With phi = 0 on the floor: sum of f D + sum of X c = sum of w phi. *)
Theorem virtual_work : forall L, equilibrium L ->
  (forall i j, In (i, j) (layer top step L) -> phi L i j =3= each 0) ->
  over_spheres L sloping_work + over_spheres L horizontal_work == over_spheres L work_of_weight.
Proof.
  intros L E Z. rewrite <- (work_on_the_floor L E).
  assert (A : arriving_work L == 0).
  { unfold arriving_work. rewrite <- (over_of_nothing _ (spheres L)). apply over_of_same. intros [i j] H.
    apply spheres_are in H. destruct (Z i j H) as (a & b & c). cbn [fst snd]. unfold felt, dot. cbn [fst snd].
    destruct (step_above step L), (step L); unfold transferred; formulas;
      cbn [each alpha beta gamma] in a, b, c; rewrite a, b, c; ring. }
  rewrite A. ring.
Qed.

Lemma over_spheres_is_not_negative : forall L F,
  (forall k i j, (k < L)%nat -> In (i, j) (layer top step k) -> 0 <= F k i j) -> 0 <= over_spheres L F.
Proof.
  intros L F H. unfold over_spheres. induction L as [|L IH]; cbn [total]; [lra|].
  assert (0 <= over (spheres L) (fun p => F L (fst p) (snd p))).
  { apply over_is_not_negative. intros [i j] Hp. apply spheres_are in Hp. apply H; [lia | exact Hp]. }
  assert (0 <= total L (fun k => over (spheres k) (fun p => F k (fst p) (snd p))))
    by (apply IH; intros; apply H; [lia | assumption]).
  lra.
Qed.

Lemma over_spheres_of_opposite : forall L F, over_spheres L (fun k i j => - F k i j) == - over_spheres L F.
Proof.
  intros L F. unfold over_spheres. induction L as [|L IH]; cbn [total]; [ring|]. rewrite IH.
  assert (E : over (spheres L) (fun p => - F L (fst p) (snd p)) == - (1) * over (spheres L) (fun p => F L (fst p) (snd p))).
  { rewrite <- over_of_multiple. apply over_of_same. intros. ring. }
  rewrite E. ring.
Qed.

(** If no contact is tensile, and no D and no c is negative, the work of the forces on the floor is at most that of
    the weights; it is at least that if none is positive. *)
Theorem no_more_than_the_weights : forall L, equilibrium L -> no_pull L ->
  (forall k i j d, (k < L)%nat -> In (i, j) (layer top step k) -> 0 <= drop k i j d) ->
  (forall k i j x, (k < L)%nat -> In (i, j) (layer top step k) -> touches k x i j = true -> 0 <= squeeze k x i j) ->
  arriving_work L <= over_spheres L work_of_weight.
Proof.
  intros L E P D C. rewrite <- (work_on_the_floor L E).
  assert (0 <= over_spheres L sloping_work).
  { apply over_spheres_is_not_negative. intros k i j Hk Hi. destruct (P k i j Hk Hi) as [F _].
    unfold sloping_work, dot, by_line, sum. cbn [alpha beta gamma].
    assert (A := Qmult_le_0_compat _ _ (F Alpha) (D k i j Alpha Hk Hi)).
    assert (B := Qmult_le_0_compat _ _ (F Beta) (D k i j Beta Hk Hi)).
    assert (G := Qmult_le_0_compat _ _ (F Gamma) (D k i j Gamma Hk Hi)). cbn [on] in A, B, G. lra. }
  assert (0 <= over_spheres L horizontal_work).
  { apply over_spheres_is_not_negative. intros k i j Hk Hi. destruct (P k i j Hk Hi) as [_ F].
    assert (A : forall x, 0 <= of_axis k x i j).
    { intros x. unfold of_axis. destruct (touches k x i j) eqn:T; [|lra].
      apply Qmult_le_0_compat; [apply F | apply C]; assumption. }
    unfold horizontal_work. assert (A1 := A AB). assert (A2 := A AG). assert (A3 := A GB). lra. }
  lra.
Qed.

Theorem no_less_than_the_weights : forall L, equilibrium L -> no_pull L ->
  (forall k i j d, (k < L)%nat -> In (i, j) (layer top step k) -> drop k i j d <= 0) ->
  (forall k i j x, (k < L)%nat -> In (i, j) (layer top step k) -> touches k x i j = true -> squeeze k x i j <= 0) ->
  over_spheres L work_of_weight <= arriving_work L.
Proof.
  intros L E P D C. rewrite <- (work_on_the_floor L E).
  assert (S : 0 <= over_spheres L (fun k i j => - sloping_work k i j)).
  { apply over_spheres_is_not_negative. intros k i j Hk Hi. destruct (P k i j Hk Hi) as [F _].
    assert (N : forall d, 0 <= on d (f k i j) * - drop k i j d).
    { intros d. apply Qmult_le_0_compat; [apply F|]. specialize (D k i j d Hk Hi). lra. }
    assert (A := N Alpha). assert (B := N Beta). assert (G := N Gamma).
    unfold sloping_work, dot, by_line, sum. cbn [alpha beta gamma on] in *. lra. }
  assert (H : 0 <= over_spheres L (fun k i j => - horizontal_work k i j)).
  { apply over_spheres_is_not_negative. intros k i j Hk Hi. destruct (P k i j Hk Hi) as [_ F].
    assert (A : forall x, 0 <= - of_axis k x i j).
    { intros x. unfold of_axis. destruct (touches k x i j) eqn:T; [|lra].
      assert (0 <= X k x i j * - squeeze k x i j).
      { apply Qmult_le_0_compat; [apply F; assumption|]. specialize (C k i j x Hk Hi T). lra. }
      lra. }
    unfold horizontal_work. assert (A1 := A AB). assert (A2 := A AG). assert (A3 := A GB). lra. }
  rewrite over_spheres_of_opposite in S, H. lra.
Qed.

End Pile.

(** With phi = 1 everywhere D and c are zero. For all horizontal forces, in any stacking, the floor carries the
    weight, 3 f0 for a sphere of mg. *)
Theorem the_weight_arrives_beside : forall top step f X w L, equilibrium top step f X w L ->
  over (spheres top step L) (fun p => sum (arriving top step f L (fst p) (snd p)))
  == over_spheres top step L (fun k i j => 3 * w k i j).
Proof.
  intros top step f X w L E.
  assert (W := work_on_the_floor top step f X w (fun _ _ _ => each 1) L E).
  assert (T : forall k p, felt step (fun _ _ _ => each 1) k p =3= each 1).
  { intros k p. unfold felt. destruct (step_above step k), (step k); unfold transferred; by_components. }
  assert (S : over_spheres top step L (sloping_work step f (fun _ _ _ => each 1)) == 0).
  { rewrite <- (total_of_nothing L). apply total_of_same. intros k _. rewrite <- (over_of_nothing _ (spheres top step k)).
    apply over_of_same. intros [i j] _. cbn [fst snd]. unfold sloping_work, drop, dot.
    destruct (T (S k) (support (step k) (i, j) Alpha)) as (a & _ & _).
    destruct (T (S k) (support (step k) (i, j) Beta)) as (_ & b & _).
    destruct (T (S k) (support (step k) (i, j) Gamma)) as (_ & _ & c).
    formulas. rewrite a, b, c. formulas. ring. }
  assert (H : over_spheres top step L (horizontal_work top step X (fun _ _ _ => each 1)) == 0).
  { rewrite <- (total_of_nothing L). apply total_of_same. intros k _. rewrite <- (over_of_nothing _ (spheres top step k)).
    apply over_of_same. intros [i j] _. cbn [fst snd].
    assert (A : forall x, of_axis top step X (fun _ _ _ => each 1) k x i j == 0).
    { intros x. unfold of_axis, squeeze. destruct (touches top step k x i j); [|reflexivity].
      destruct x, (step k); cbn [from to]; formulas; ring. }
    unfold horizontal_work. rewrite !A. ring. }
  rewrite S, H in W.
  transitivity (arriving_work top step f (fun _ _ _ => each 1) L).
  - apply over_of_same. intros p _. rewrite (dot_of_same _ _ _ (T L p)). unfold dot. formulas. ring.
  - transitivity (over_spheres top step L (work_of_weight w (fun _ _ _ => each 1))); [rewrite <- W; ring|].
    apply total_of_same. intros k _. apply over_of_same. intros p _. unfold work_of_weight. formulas. ring.
Qed.

(** ** Bounds of the load on a bottom sphere *)

Section Bound.
Variable top : list site.
Variable step : nat -> sign.
Variable f : nat -> Z -> Z -> three Q.
Variable X : nat -> axis -> Z -> Z -> Q.
Variable w : nat -> Z -> Z -> Q.
Variable K : nat.
Variable p : site.
Hypothesis on_the_floor : In p (layer top step K).
Hypothesis in_equilibrium : equilibrium top step f X w K.
Hypothesis nothing_pulls : no_pull top step f X K.

(** The load: the forces that the spheres of the last free layer transmit to it. *)
Definition load_below : Q := sum (arriving top step f K (fst p) (snd p)).

Definition truth (b : bool) : Q := if b then 1 else 0.
Definition is_at (p r : site) : bool := if same_site r p then true else false.

(** A field on the free spheres of K layers is a certificate if D is at least (at most) 1 at the contacts with p and
    0 at others, and no c is negative (positive). *)
Variable psi : nat -> Z -> Z -> three Q.

Definition excess (k : nat) (i j : Z) (d : direction) : Q :=
  if (S k =? K)%nat then contact_drop (on d (psi k i j)) (truth (is_at p (support (step k) (i, j) d))) else drop step psi k i j d.

Definition certifies (sigma : sign) : Prop :=
  (forall k i j d, (k < K)%nat -> In (i, j) (layer top step k) -> 0 <= times sigma (excess k i j d)) /\
  (forall k i j x, (k < K)%nat -> In (i, j) (layer top step k) -> touches top step k x i j = true ->
    0 <= times sigma (squeeze step psi k x i j)).

(** Equivalently, p sinks by 1 with the field. *)
Definition with_floor (k : nat) (i j : Z) : three Q :=
  if (k =? K)%nat then each (truth (is_at p (i, j))) else psi k i j.

Lemma is_iff : forall r, is_at p r = true <-> r = p.
Proof. intros r. unfold is_at. destruct (same_site r p); split; congruence. Qed.

Lemma felt_of_floor : forall r, felt step with_floor K r =3= each (truth (is_at p r)).
Proof.
  intros [i j]. unfold felt, with_floor. rewrite Nat.eqb_refl. cbn [fst snd].
  destruct (step_above step K), (step K); unfold transferred; by_components.
Qed.

Lemma drop_with_floor : forall k i j d, (k < K)%nat -> drop step with_floor k i j d == excess k i j d.
Proof.
  intros k i j d H. unfold excess, drop.
  assert (E : with_floor k i j = psi k i j)
    by (unfold with_floor; destruct (Nat.eqb_spec k K); [lia | reflexivity]).
  rewrite E. destruct (Nat.eqb_spec (S k) K) as [F | F].
  - rewrite F. destruct (felt_of_floor (support (step k) (i, j) d)) as (a & b & c).
    unfold contact_drop. apply Qplus_comp; [reflexivity|]. apply Qopp_comp. destruct d; cbn [on]; assumption.
  - unfold felt, with_floor. destruct (Nat.eqb_spec (S k) K); [contradiction | reflexivity].
Qed.

Lemma squeeze_with_floor : forall k x i j, (k < K)%nat -> squeeze step with_floor k x i j = squeeze step psi k x i j.
Proof. intros. unfold squeeze, with_floor. destruct (Nat.eqb_spec k K); [lia | reflexivity]. Qed.

Lemma weights_with_floor :
  over_spheres top step K (work_of_weight w with_floor) == over_spheres top step K (work_of_weight w psi).
Proof.
  apply total_of_same. intros k H. apply over_of_same. intros r _. unfold work_of_weight, with_floor.
  destruct (Nat.eqb_spec k K); [lia | reflexivity].
Qed.

Lemma work_is_load_below : arriving_work top step f with_floor K == load_below.
Proof using on_the_floor.
  unfold arriving_work, load_below.
  transitivity (over (spheres top step K) (fun r =>
    if same_site r p then sum (arriving top step f K (fst r) (snd r)) else 0)).
  - apply over_of_same. intros r _. rewrite (dot_of_same _ _ _ (felt_of_floor r)). unfold is_at, truth, dot.
    destruct (same_site r p); formulas; ring.
  - rewrite (over_one (spheres top step K) p (fun r => sum (arriving top step f K (fst r) (snd r)))) by apply spheres_once.
    replace (holds (spheres top step K) p) with true; [reflexivity|].
    symmetry. rewrite holds_spheres. apply holds_iff. exact on_the_floor.
Qed.

(** Weak duality: the load on p is at most the work of the weights. *)
Theorem at_most_the_weights : certifies Plus -> load_below <= over_spheres top step K (work_of_weight w psi).
Proof using on_the_floor in_equilibrium nothing_pulls.
  intros [D C]. rewrite <- weights_with_floor, <- work_is_load_below.
  apply (no_more_than_the_weights top step f X w with_floor K); try assumption.
  - intros. rewrite drop_with_floor by assumption. apply (D k i j d); assumption.
  - intros. rewrite squeeze_with_floor by assumption. apply (C k i j x); assumption.
Qed.

(** Weak duality for a lower bound. *)
Theorem at_least_the_weights : certifies Minus -> over_spheres top step K (work_of_weight w psi) <= load_below.
Proof using on_the_floor in_equilibrium nothing_pulls.
  intros [D C]. rewrite <- weights_with_floor, <- work_is_load_below.
  apply (no_less_than_the_weights top step f X w with_floor K); try assumption.
  - intros. rewrite drop_with_floor by assumption.
    assert (A : 0 <= times Minus (excess k i j d)) by (apply D; assumption). cbn [times] in A. lra.
  - intros. rewrite squeeze_with_floor by assumption.
    assert (A : 0 <= times Minus (squeeze step psi k x i j)) by (apply C; assumption). cbn [times] in A. lra.
Qed.

End Bound.

(** ** The straight pile under one sphere, of spheres of mg *)

Definition apex : list site := [(0, 0)%Z].
Definition straight (k : nat) : sign := Plus.
Definition mg (k : nat) (i j : Z) : Q := 1.

(** The layers of this pile are those of Straight.v. *)
Lemma layers_of_straight : forall k i j, In (i, j) (layer apex straight k) <-> occupied k i j = true.
Proof.
  intros k. induction k as [|k IH]; intros i j; rewrite occupied_iff.
  - cbn [layer]. simpl. split.
    + intros [E | []]. injection E. intros. subst. lia.
    + intros H. left. f_equal; lia.
  - cbn [layer]. rewrite in_flat_map, Nat2Z.inj_succ. split.
    + intros ([a b] & H & E). apply IH, occupied_iff in H. unfold support, straight in E. cbn [descent fst snd In] in E.
      destruct E as [E | [E | [E | []]]]; injection E; intros; subst; lia.
    + intros H.
      assert (C : (i + j <= Z.of_nat k \/ (0 < i /\ i + j = Z.succ (Z.of_nat k)) \/ (i = 0 /\ 0 < j))%Z) by lia.
      destruct C as [C | [C | C]].
      * exists (i, j). split; [apply IH, occupied_iff; lia|]. left. unfold support. cbn. f_equal; lia.
      * exists (i - 1, j)%Z. split; [apply IH, occupied_iff; lia|]. right. left. unfold support. cbn. f_equal; lia.
      * exists (i, j - 1)%Z. split; [apply IH, occupied_iff; lia|]. right. right. left. unfold support. cbn. f_equal; lia.
Qed.

Lemma holds_straight : forall k p, holds (layer apex straight k) p = occupied k (fst p) (snd p).
Proof. intros k [i j]. apply eq_true_iff_eq. rewrite holds_iff. apply layers_of_straight. Qed.

(** Forces without tension that balance K layers of the straight pile above a floor. *)
Definition balanced_beside (f : nat -> Z -> Z -> three Q) (X : nat -> axis -> Z -> Z -> Q) (K : nat) : Prop :=
  equilibrium apex straight f X mg K /\ no_pull apex straight f X K.

(** The load on a bottom sphere, in f0. *)
Definition load_on (f : nat -> Z -> Z -> three Q) (K : nat) (p : site) : Q := load_below apex straight f K p.

Definition sum_of (K : nat) (psi : nat -> Z -> Z -> three Q) : Q :=
  over_spheres apex straight K (fun k i j => sum (psi k i j)).

Lemma truth_is_not_negative : forall a, 0 <= truth a.
Proof. intros []; cbn [truth]; lra. Qed.

(** A certificate of a straight pile, and its bound. *)
Definition lowers (K : nat) (p : site) (psi : nat -> Z -> Z -> three Q) (k : nat) (i j : Z) (d : direction) : Q :=
  let r := support Plus (i, j) d in
  on d (psi k i j) - if (S k =? K)%nat then truth (is_at p r) else on d (psi (S k) (fst r) (snd r)).

Definition presses (psi : nat -> Z -> Z -> three Q) (k : nat) (i j : Z) (x : axis) : Q :=
  let r := psi k (fst (next x (i, j))) (snd (next x (i, j))) in
  (on (to x) (psi k i j) - on (to x) r) + (on (from x) r - on (from x) (psi k i j)).

Definition certificate (sigma : sign) (K : nat) (p : site) (psi : nat -> Z -> Z -> three Q) : Prop :=
  (forall k i j d, (k < K)%nat -> occupied k i j = true -> 0 <= times sigma (lowers K p psi k i j d)) /\
  (forall k i j x, (k < K)%nat -> occupied k i j = true ->
    occupied k (fst (next x (i, j))) (snd (next x (i, j))) = true -> 0 <= times sigma (presses psi k i j x)).

Lemma certificates_certify : forall sigma K p psi,
  certificate sigma K p psi -> certifies apex straight K p psi sigma.
Proof.
  intros sigma K p psi [D C]. split.
  - intros k i j d Hk H. apply layers_of_straight in H. specialize (D k i j d Hk H).
    unfold excess, drop, lowers, felt, contact_drop in *. destruct (S k =? K)%nat; exact D.
  - intros k i j x Hk H T. apply layers_of_straight in H. specialize (C k i j x Hk H).
    unfold touches in T. rewrite holds_straight in T.
    specialize (C T). clear T. unfold squeeze, presses, straight in *.
    destruct sigma, x; unfold times in *; cbn [from to on] in *; formulas; formulas_in C; lra.
Qed.

Lemma works_of_mg : forall K psi, over_spheres apex straight K (work_of_weight mg psi) == sum_of K psi.
Proof.
  intros K psi. apply total_of_same. intros k _. apply over_of_same. intros p _. unfold work_of_weight, mg. ring.
Qed.

Theorem at_most : forall f X K p psi, balanced_beside f X K -> occupied K (fst p) (snd p) = true ->
  certificate Plus K p psi -> load_on f K p <= sum_of K psi.
Proof.
  intros f X K [i j] psi [E P] H C. rewrite <- works_of_mg.
  apply (at_most_the_weights apex straight f X mg K (i, j)); try assumption.
  - apply layers_of_straight. exact H.
  - apply certificates_certify. exact C.
Qed.

Theorem at_least : forall f X K p psi, balanced_beside f X K -> occupied K (fst p) (snd p) = true ->
  certificate Minus K p psi -> sum_of K psi <= load_on f K p.
Proof.
  intros f X K [i j] psi [E P] H C. rewrite <- works_of_mg.
  apply (at_least_the_weights apex straight f X mg K (i, j)); try assumption.
  - apply layers_of_straight. exact H.
  - apply certificates_certify. exact C.
Qed.

(** ** Such forces exist

    Forces that balance the spheres of the straight pile with their neighbours. *)
Lemma arriving_is_received : forall f k i j, arriving apex straight f k i j = received f k i j.
Proof.
  intros f [|m] i j; [reflexivity|].
  assert (E : forall a b, member (layer apex straight m) a b = occupied m a b)
    by (intros a b; exact (holds_straight m (a, b))).
  unfold arriving, received, above_in, above_on, straight. cbn [descent]. rewrite !E. reflexivity.
Qed.

Lemma plus_vector_of_same : forall u v w, u =v= v -> plus_vector u w =v= plus_vector v w.
Proof.
  intros u v w (a & b & c). unfold plus_vector. repeat split; cbn [along_x along_y along_z]; apply Qplus_comp;
    try assumption; reflexivity.
Qed.

Lemma all_steps_are_plus : forall k, step_above straight k = Plus.
Proof. intros []; reflexivity. Qed.

Lemma balanced_if : forall f X k i j,
  let g := received f k i j in
  let h := pushed_by (six (by_next apex straight X k i j)) (six (by_last apex straight X k i j)) in
  f k i j =3= Three (beside g.(alpha) 1 h.(alpha) Plus) (beside g.(beta) 1 h.(beta) Plus)
                    (beside g.(gamma) 1 h.(gamma) Plus) ->
  in_balance_beside apex straight f X mg k i j.
Proof.
  intros f X k i j g h H. unfold in_balance_beside. rewrite arriving_is_received.
  assert (B := horizontal_balance Plus Plus g 1 (six (by_next apex straight X k i j)) (six (by_last apex straight X k i j))).
  cbv zeta in B. rewrite <- B. apply plus_vector_of_same.
  rewrite (all_steps_are_plus k). change (straight k) with Plus. change (mg k i j) with 1.
  apply unbalanced_of_same; [exact H | reflexivity | reflexivity].
Qed.

(** Without horizontal forces the paper's closed form is one such state, so the bounds are not vacuous. *)
Definition paper_forces (k : nat) (i j : Z) : three Q := closed_form (1 # 2) (q i) (q j) (n_of k).
Definition no_push (k : nat) (x : axis) (i j : Z) : Q := 0.

Lemma no_push_adds_nothing : forall k i j,
  pushed_by (six (by_next apex straight no_push k i j)) (six (by_last apex straight no_push k i j)) =3= each 0.
Proof.
  intros k i j.
  assert (E : forall x, by_next apex straight no_push k i j x = 0)
    by (intros x; unfold by_next, no_push; destruct (touches apex straight k x i j); reflexivity).
  assert (F : forall x, by_last apex straight no_push k i j x = 0)
    by (intros x; unfold by_last, no_push; destruct (holds (layer apex straight k) (last x (i, j))); reflexivity).
  unfold pushed_by, six, plus_three. cbn [ab ag gb]. rewrite !E, !F. by_components.
Qed.

Lemma paper_forces_arrive : forall k i j, occupied k i j = true ->
  received paper_forces k i j =3= brought (1 # 2) (q i) (q j) (n_of k).
Proof.
  intros k i j H. apply (received_of_closed_form (1 # 2) paper_forces k i j H).
  intros m a b _ _. unfold paper_forces. reflexivity.
Qed.

Lemma beside_of_same : forall u v h h', u =3= v -> h =3= h' ->
  Three (beside u.(alpha) 1 h.(alpha) Plus) (beside u.(beta) 1 h.(beta) Plus) (beside u.(gamma) 1 h.(gamma) Plus)
  =3= Three (beside v.(alpha) 1 h'.(alpha) Plus) (beside v.(beta) 1 h'.(beta) Plus) (beside v.(gamma) 1 h'.(gamma) Plus).
Proof. intros u v h h' (a & b & c) (x & y & z). repeat split; formulas; congruent. Qed.

Theorem closed_form_is_balanced_beside : forall K, balanced_beside paper_forces no_push K.
Proof.
  intros K. split.
  - intros k i j _ H. apply layers_of_straight in H. apply balanced_if. cbv zeta.
    rewrite (beside_of_same _ _ _ _ (paper_forces_arrive k i j H) (no_push_adds_nothing k i j)).
    unfold paper_forces, closed_form. by_components.
  - intros k i j _ H. apply layers_of_straight in H. split.
    + intros d. apply Qlt_le_weak. apply straight_piles_stand; [reflexivity | exact H].
    + intros. unfold no_push. lra.
Qed.

(** ** The elastic state

    The energy of a state, in f0^2 over twice the stiffness of sloping contacts: the sum of f^2 plus r times the sum
    of X^2. *)
Definition pressed_along (X : nat -> axis -> Z -> Z -> Q) (by_force : nat -> Q -> Q) (k : nat) (i j : Z) : Q :=
  let part x := if touches apex straight k x i j then by_force k (X k x i j) else 0 in part AB + part AG + part GB.

Definition energy (r : Q) (f : nat -> Z -> Z -> three Q) (X : nat -> axis -> Z -> Z -> Q) (K : nat) : Q :=
  over_spheres apex straight K (fun k i j => dot (f k i j) (f k i j))
  + r * over_spheres apex straight K (pressed_along X (fun _ x => x * x)).

(** The field of the elastic state, K layers above the floor. *)
Definition elastic_phi (K k : nat) (i j : Z) : three Q := field (above (q i) (q j) (n_of k)) (n_of K - n_of k).

Lemma elastic_drop : forall K k i j d, drop straight (elastic_phi K) k i j d == on d (paper_forces k i j).
Proof.
  intros K k i j d. unfold drop, felt, transferred, elastic_phi, paper_forces, closed_form, brought, field, support.
  rewrite all_steps_are_plus. unfold straight.
  destruct d; cbn [descent fst snd]; formulas; rewrite n_of_S, !inject_Z_plus; cbn [q]; ring.
Qed.

Lemma elastic_squeeze : forall K k x i j, squeeze straight (elastic_phi K) k x i j == - 2 * (n_of K - n_of k).
Proof.
  intros K k x i j. unfold squeeze, elastic_phi, field, next, support, above_in, straight, Z.sub.
  destruct x; cbn [from to descent fst snd]; formulas; rewrite !inject_Z_plus; cbn [q Z.opp]; ring.
Qed.

Lemma elastic_work : forall f X K, equilibrium apex straight f X mg K ->
  over_spheres apex straight K (fun k i j => dot (f k i j) (paper_forces k i j))
  + over_spheres apex straight K (pressed_along X (fun k x => - 2 * ((n_of K - n_of k) * x)))
  == over_spheres apex straight K (work_of_weight mg (elastic_phi K)).
Proof.
  intros f X K E. rewrite <- (virtual_work apex straight f X mg (elastic_phi K) K E).
  - apply Qplus_comp; apply total_of_same; intros k _; apply over_of_same; intros [i j] _; cbn [fst snd].
    + unfold sloping_work. apply dot_of_same. repeat split; cbn [alpha beta gamma]; symmetry; apply elastic_drop.
    + unfold horizontal_work, pressed_along, of_axis.
      destruct (touches apex straight k AB i j), (touches apex straight k AG i j), (touches apex straight k GB i j);
        rewrite ?elastic_squeeze; ring.
  - intros i j _. unfold elastic_phi, field. repeat split; formulas; ring.
Qed.

Lemma over_spheres_of_sum : forall K F G,
  over_spheres apex straight K (fun k i j => F k i j + G k i j)
  == over_spheres apex straight K F + over_spheres apex straight K G.
Proof.
  intros. unfold over_spheres. rewrite <- total_of_sum. apply total_of_same. intros k _. rewrite <- over_of_sum. reflexivity.
Qed.

Lemma over_spheres_of_multiple : forall K c F,
  over_spheres apex straight K (fun k i j => c * F k i j) == c * over_spheres apex straight K F.
Proof.
  intros. unfold over_spheres. rewrite <- total_of_multiple. apply total_of_same. intros k _.
  rewrite <- over_of_multiple. reflexivity.
Qed.

Definition difference (f : nat -> Z -> Z -> three Q) (k : nat) (i j : Z) : three Q :=
  minus_three (f k i j) (paper_forces k i j).

(** The energy of any state, tensile or not, is the sum of: the energy of the closed form, that of the difference of
    its forces, that of its horizontal contacts, and 4d X for each of these, d layers above the floor. *)
Theorem energy_of_a_state : forall r f X K, equilibrium apex straight f X mg K ->
  energy r f X K == energy r paper_forces no_push K
    + over_spheres apex straight K (fun k i j => dot (difference f k i j) (difference f k i j))
    + over_spheres apex straight K (pressed_along X (fun k x => 4 * ((n_of K - n_of k) * x) + r * (x * x))).
Proof.
  intros r f X K E. assert (A := elastic_work f X K E).
  assert (B := elastic_work paper_forces no_push K (proj1 (closed_form_is_balanced_beside K))).
  rewrite <- B in A. clear B.
  assert (N : forall by_force, (forall k, by_force k 0 == 0) ->
    over_spheres apex straight K (pressed_along no_push by_force) == 0).
  { intros by_force H. rewrite <- (total_of_nothing K). apply total_of_same. intros k _.
    rewrite <- (over_of_nothing _ (spheres apex straight k)). apply over_of_same. intros [i j] _.
    unfold pressed_along, no_push.
    assert (T : forall b : bool, (if b then by_force k 0 else 0) == 0) by (intros []; [apply H | reflexivity]).
    rewrite !T. ring. }
  rewrite (N (fun k x => - 2 * ((n_of K - n_of k) * x))) in A by (intros; ring).
  unfold energy. rewrite (N (fun _ x => x * x)) by reflexivity. clear N.
  assert (D : over_spheres apex straight K (fun k i j => dot (f k i j) (f k i j))
    == over_spheres apex straight K (fun k i j => dot (difference f k i j) (difference f k i j))
       + 2 * over_spheres apex straight K (fun k i j => dot (f k i j) (paper_forces k i j))
       + - (1) * over_spheres apex straight K (fun k i j => dot (paper_forces k i j) (paper_forces k i j))).
  { rewrite <- !over_spheres_of_multiple, <- !over_spheres_of_sum. apply total_of_same. intros k _. apply over_of_same.
    intros [i j] _. cbn [fst snd]. unfold difference, minus_three, dot.
    destruct (f k i j), (paper_forces k i j). formulas. ring. }
  assert (P : over_spheres apex straight K (pressed_along X (fun k x => 4 * ((n_of K - n_of k) * x) + r * (x * x)))
    == - 2 * over_spheres apex straight K (pressed_along X (fun k x => - 2 * ((n_of K - n_of k) * x)))
       + r * over_spheres apex straight K (pressed_along X (fun _ x => x * x))).
  { rewrite <- !over_spheres_of_multiple, <- !over_spheres_of_sum. apply total_of_same. intros k _. apply over_of_same.
    intros [i j] _. cbn [fst snd]. unfold pressed_along.
    destruct (touches apex straight k AB i j), (touches apex straight k AG i j), (touches apex straight k GB i j); ring. }
  rewrite D, P. clear D P E. lra.
Qed.

Lemma distance_is_not_negative : forall g, 0 <= dot g g.
Proof. intros [a b c]. unfold dot. formulas. nra. Qed.

Lemma more_is_not_negative : forall r K k x, 0 <= r -> (k < K)%nat -> 0 <= x ->
  let more := 4 * ((n_of K - n_of k) * x) + r * (x * x) in 0 <= more /\ (more == 0 -> x == 0).
Proof.
  intros r K k x R Hk P.
  assert (D : 1 <= n_of K - n_of k).
  { rewrite <- n_of_sub by lia. change 1 with (q 1). unfold n_of. rewrite <- Zle_Qle. lia. }
  assert (A : 0 <= (n_of K - n_of k - 1) * x) by (apply Qmult_le_0_compat; [lra | assumption]).
  assert (B : 0 <= r * (x * x)) by (repeat apply Qmult_le_0_compat; assumption).
  assert (C : (n_of K - n_of k) * x == (n_of K - n_of k - 1) * x + x) by ring.
  cbv zeta. rewrite C. split; [lra | intros E; lra].
Qed.

Lemma pressed_is_not_negative : forall r f X K, 0 <= r -> no_pull apex straight f X K ->
  forall k i j, (k < K)%nat -> In (i, j) (layer apex straight k) ->
  0 <= pressed_along X (fun k x => 4 * ((n_of K - n_of k) * x) + r * (x * x)) k i j.
Proof.
  intros r f X K R P k i j Hk Hi. destruct (P k i j Hk Hi) as [_ N].
  assert (T : forall x, 0 <= if touches apex straight k x i j
    then 4 * ((n_of K - n_of k) * X k x i j) + r * (X k x i j * X k x i j) else 0).
  { intros x. destruct (touches apex straight k x i j) eqn:H; [|lra].
    apply more_is_not_negative; [exact R | exact Hk | exact (N x H)]. }
  unfold pressed_along. assert (A := T AB). assert (B := T AG). assert (C := T GB). lra.
Qed.

(** So the closed form is the elastic state: of all states without tensile horizontal contacts it has the least
    energy, for every stiffness of horizontal contacts. *)
Theorem closed_form_is_the_elastic_state : forall r f X K, 0 <= r -> balanced_beside f X K ->
  energy r paper_forces no_push K <= energy r f X K.
Proof.
  intros r f X K R [E P]. rewrite (energy_of_a_state r f X K E).
  assert (0 <= over_spheres apex straight K (fun k i j => dot (difference f k i j) (difference f k i j)))
    by (apply over_spheres_is_not_negative; intros; apply distance_is_not_negative).
  assert (0 <= over_spheres apex straight K (pressed_along X (fun k x => 4 * ((n_of K - n_of k) * x) + r * (x * x))))
    by (apply over_spheres_is_not_negative; apply (pressed_is_not_negative r f X K R P)).
  lra.
Qed.

(** The closed form is the only state with this energy. *)
Lemma over_nothing_negative : forall A (l : list A) F, (forall x, In x l -> 0 <= F x) -> over l F <= 0 ->
  forall x, In x l -> F x == 0.
Proof.
  intros A l F. induction l as [|y l IH]; intros P S x H; [destruct H|]. cbn [over] in S.
  assert (0 <= F y) by (apply P; left; reflexivity).
  assert (0 <= over l F) by (apply over_is_not_negative; intros; apply P; right; assumption).
  destruct H as [H | H]; [subst; lra|].
  apply IH; [intros; apply P; right; assumption | lra | exact H].
Qed.

Lemma over_spheres_nothing_negative : forall K F,
  (forall k i j, (k < K)%nat -> In (i, j) (layer apex straight k) -> 0 <= F k i j) ->
  over_spheres apex straight K F <= 0 ->
  forall k i j, (k < K)%nat -> In (i, j) (layer apex straight k) -> F k i j == 0.
Proof.
  intros K F. induction K as [|K IH]; intros P S k i j Hk Hi; [lia|].
  assert (A : 0 <= over_spheres apex straight K F)
    by (apply over_spheres_is_not_negative; intros; apply P; [lia | assumption]).
  assert (B : forall p, In p (spheres apex straight K) -> 0 <= F K (fst p) (snd p)).
  { intros [a b] H. apply spheres_are in H. apply P; [lia | exact H]. }
  assert (C := over_is_not_negative _ _ _ B).
  unfold over_spheres in S. cbn [total] in S. fold (over_spheres apex straight K F) in S.
  destruct (Nat.eq_dec k K) as [H | H].
  - subst k. apply (over_nothing_negative _ _ _ B) with (x := (i, j)); [lra|]. apply spheres_are. exact Hi.
  - apply IH; [intros; apply P; [lia | assumption] | lra | lia | exact Hi].
Qed.

Theorem elastic_state_is_unique : forall r f X K, 0 <= r -> balanced_beside f X K ->
  energy r f X K <= energy r paper_forces no_push K ->
  forall k i j, (k < K)%nat -> occupied k i j = true ->
  f k i j =3= paper_forces k i j /\ (forall x, touches apex straight k x i j = true -> X k x i j == 0).
Proof.
  intros r f X K R [E P] M k i j Hk H. rewrite (energy_of_a_state r f X K E) in M.
  assert (D : forall k i j, (k < K)%nat -> In (i, j) (layer apex straight k) ->
    0 <= dot (difference f k i j) (difference f k i j)) by (intros; apply distance_is_not_negative).
  assert (N := pressed_is_not_negative r f X K R P).
  assert (A := over_spheres_is_not_negative apex straight K _ D).
  assert (B := over_spheres_is_not_negative apex straight K _ N).
  apply layers_of_straight in H. split.
  - assert (Z := over_spheres_nothing_negative K _ D ltac:(lra) k i j Hk H).
    revert Z. unfold difference, minus_three, dot. clear.
    destruct (f k i j) as [a b c], (paper_forces k i j) as [x y z]. formulas. intros Z.
    assert (U : forall s, s * s == 0 -> s == 0) by (intros s Q; destruct (Qmult_integral _ _ Q); assumption).
    assert (V : forall s : Q, 0 <= s * s) by (intros; nra).
    assert (Sa := V (a - x)). assert (Sb := V (b - y)). assert (Sc := V (c - z)).
    assert (Ua := U (a - x) ltac:(lra)). assert (Ub := U (b - y) ltac:(lra)). assert (Uc := U (c - z) ltac:(lra)).
    repeat split; lra.
  - intros x T. assert (Z := over_spheres_nothing_negative K _ N ltac:(lra) k i j Hk H).
    destruct (P k i j Hk H) as [_ Q].
    assert (G : forall x, 0 <= (if touches apex straight k x i j
      then 4 * ((n_of K - n_of k) * X k x i j) + r * (X k x i j * X k x i j) else 0)).
    { intros y. destruct (touches apex straight k y i j) eqn:Ty; [|lra].
      apply more_is_not_negative; [exact R | exact Hk | exact (Q y Ty)]. }
    assert (Ga := G AB). assert (Gb := G AG). assert (Gc := G GB). unfold pressed_along in Z.
    assert (F : (if touches apex straight k x i j
      then 4 * ((n_of K - n_of k) * X k x i j) + r * (X k x i j * X k x i j) else 0) == 0) by (destruct x; lra).
    rewrite T in F. exact (proj2 (more_is_not_negative r K k _ R Hk (Q x T)) F).
Qed.
