(** Virtual work of a whole pile with horizontal contacts, and the bounds that follow from it, with their signs. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool List.
From Cannonpile Require Import Directions Sums Formulas Balance Straight Floor Stackings Regions Horizontal.

Import ListNotations.
Open Scope Q_scope.

(** ** Sums over spheres *)

(** The sum over what a list holds. *)
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

(** One term alone. *)
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

(** What pairs of sites add, one [there] of the other, is summed over either. *)
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

    Any stacking below any finite top layer (Stackings.v), with forces f of the sloping contacts and X of the horizontal
    ones: X k x i j is the force with which (i, j) of layer k and the next sphere along the axis x press each other. *)
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

(** Two spheres of a layer touch if both are there. *)
Definition touches (k : nat) (x : axis) (i j : Z) : bool := holds (layer top step k) (next x (i, j)).

(** With what the next sphere along an axis pushes, and the last. *)
Definition by_next (k : nat) (i j : Z) (x : axis) : Q := if touches k x i j then X k x i j else 0.
Definition by_last (k : nat) (i j : Z) (x : axis) : Q :=
  let p := last x (i, j) in if holds (layer top step k) p then X k x (fst p) (snd p) else 0.

Definition six (by_axis : axis -> Q) : pushes := {| ab := by_axis AB; ag := by_axis AG; gb := by_axis GB |}.

(** Newton's law for a sphere of weight w mg: what its supports, the spheres above, its weight and its neighbours push it
    with is nothing, in all components. *)
Definition in_balance_beside (k : nat) (i j : Z) : Prop :=
  plus_vector
    (unbalanced (f k i j) (directions_under (1 # 2) (step k)) (arriving top step f k i j)
       (directions_under (1 # 2) (step_above step k)) (force (w k i j) (weight (increments (1 # 2)))))
    (push (six (by_next k i j)) (six (by_last k i j))) =v= nothing.

(** Forces that balance all spheres of L layers; the next layer is the floor. *)
Definition equilibrium (L : nat) : Prop :=
  forall k i j, (k < L)%nat -> In (i, j) (layer top step k) -> in_balance_beside k i j.

(** No contact pulls. *)
Definition no_pull (L : nat) : Prop :=
  forall k i j, (k < L)%nat -> In (i, j) (layer top step k) ->
    (forall d, 0 <= on d (f k i j)) /\ (forall x, touches k x i j = true -> 0 <= X k x i j).

(** What a sphere passes on, from its balance. *)
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

(** ** The sum of all works

    For any numbers phi: D of a sphere's contacts, Tphi being taken off of their supports, and c of its contacts with the
    next ones. *)
Variable phi : nat -> Z -> Z -> three Q.

(** T phi: what phi is for the contacts above a sphere. *)
Definition felt (k : nat) (p : site) : three Q :=
  transferred (step_above step k) (step k) (phi k (fst p) (snd p)).

Definition drop (k : nat) (i j : Z) (d : direction) : Q :=
  lowered (on d (phi k i j)) (on d (felt (S k) (support (step k) (i, j) d))).

Definition squeeze (k : nat) (x : axis) (i j : Z) : Q :=
  let p := next x (i, j) in compression (phi k i j) (phi k (fst p) (snd p)) (from x) (to x) (step k).

Definition sloping_work (k : nat) (i j : Z) : Q := dot (f k i j) (Three (drop k i j Alpha) (drop k i j Beta) (drop k i j Gamma)).

Definition of_axis (k : nat) (x : axis) (i j : Z) : Q :=
  if touches k x i j then X k x i j * squeeze k x i j else 0.
Definition horizontal_work (k : nat) (i j : Z) : Q := of_axis k AB i j + of_axis k AG i j + of_axis k GB i j.

Definition work_of_weight (k : nat) (i j : Z) : Q := w k i j * sum (phi k i j).

(** What the forces that arrive on a layer do there. *)
Definition arriving_work (k : nat) : Q :=
  over (spheres k) (fun p => dot (arriving top step f k (fst p) (snd p)) (felt k p)).

(** The horizontal contacts of a layer along an axis: what they do at their two spheres is X c. *)
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

(** Of one sphere. *)
Lemma work_of_six : forall sigma psi x y,
  times sigma (dot psi (pushed_by (six x) (six y))) ==
  times sigma (dot psi (pushed (x AB) Alpha Beta true) + dot psi (pushed (y AB) Alpha Beta false))
  + times sigma (dot psi (pushed (x AG) Alpha Gamma true) + dot psi (pushed (y AG) Alpha Gamma false))
  + times sigma (dot psi (pushed (x GB) Gamma Beta true) + dot psi (pushed (y GB) Gamma Beta false)).
Proof. intros [] [] x y; unfold times, dot, pushed_by, six, plus_three; cbn [ab ag gb]; formulas; ring. Qed.

Lemma dot_of_same : forall psi g h, g =3= h -> dot psi g == dot psi h.
Proof. intros psi g h (A & B & C). unfold dot. formulas. rewrite A, B, C. reflexivity. Qed.

(** A layer: its balances times phi. *)
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

(** What arrives from a layer along a line. *)
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
  intros k p d H. cbn [layer]. apply in_flat_map. exists p. split; [exact H|]. destruct d; simpl; tauto.
Qed.

(** It is what the contacts above give. *)
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

(** The sloping contacts of a layer: what is given above less what arrives below. *)
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

(** Virtual work, for any phi and any forces in equilibrium under any weights: the work of all sloping contacts, of all
    horizontal ones, and of what arrives on the floor, is the work of the weights. *)
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

(** Where no contact pulls, and no D and no c is negative, what arrives works no more than the weights; and no less, where
    none is positive. *)
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

(** With phi = 1 everywhere nothing is lowered or squeezed: whatever the horizontal contacts push, in any stacking, the floor
    bears the weight, 3 f0 for a sphere of mg. *)
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

(** ** Bounds of what rests on a sphere of the floor *)

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

(** What rests on it: what the spheres of the last free layer pass on to it. *)
Definition rests : Q := sum (arriving top step f K (fst p) (snd p)).

Definition truth (b : bool) : Q := if b then 1 else 0.
Definition is_at (p r : site) : bool := if same_site r p then true else false.

(** A field on the free spheres, K layers of them, is a certificate if D of its contacts is at least (at most) 1 where they
    lead to p, 0 elsewhere, and no c is negative (positive). *)
Variable psi : nat -> Z -> Z -> three Q.

Definition excess (k : nat) (i j : Z) (d : direction) : Q :=
  if (S k =? K)%nat then lowered (on d (psi k i j)) (truth (is_at p (support (step k) (i, j) d))) else drop step psi k i j d.

Definition certifies (sigma : sign) : Prop :=
  (forall k i j d, (k < K)%nat -> In (i, j) (layer top step k) -> 0 <= times sigma (excess k i j d)) /\
  (forall k i j x, (k < K)%nat -> In (i, j) (layer top step k) -> touches top step k x i j = true ->
    0 <= times sigma (squeeze step psi k x i j)).

(** That p sinks by 1 with the field is the same. *)
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
    unfold lowered. apply Qplus_comp; [reflexivity|]. apply Qopp_comp. destruct d; cbn [on]; assumption.
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

Lemma what_rests : arriving_work top step f with_floor K == rests.
Proof.
  unfold arriving_work, rests.
  transitivity (over (spheres top step K) (fun r =>
    if same_site r p then sum (arriving top step f K (fst r) (snd r)) else 0)).
  - apply over_of_same. intros r _. rewrite (dot_of_same _ _ _ (felt_of_floor r)). unfold is_at, truth, dot.
    destruct (same_site r p); formulas; ring.
  - rewrite (over_one (spheres top step K) p (fun r => sum (arriving top step f K (fst r) (snd r)))) by apply spheres_once.
    replace (holds (spheres top step K) p) with true; [reflexivity|].
    symmetry. rewrite holds_spheres. apply holds_iff. exact on_the_floor.
Qed.

(** Weak duality: no more than the work of the weights rests on p. *)
Theorem at_most_the_weights : certifies Plus -> rests <= over_spheres top step K (work_of_weight w psi).
Proof.
  intros [D C]. rewrite <- weights_with_floor, <- what_rests.
  apply (no_more_than_the_weights top step f X w with_floor K); try assumption.
  - intros. rewrite drop_with_floor by assumption. apply (D k i j d); assumption.
  - intros. rewrite squeeze_with_floor by assumption. apply (C k i j x); assumption.
Qed.

(** And no less. *)
Theorem at_least_the_weights : certifies Minus -> over_spheres top step K (work_of_weight w psi) <= rests.
Proof.
  intros [D C]. rewrite <- weights_with_floor, <- what_rests.
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

(** Its layers are those of Straight.v. *)
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

(** Forces that balance K layers of it above a floor, of which none pulls. *)
Definition balanced_beside (f : nat -> Z -> Z -> three Q) (X : nat -> axis -> Z -> Z -> Q) (K : nat) : Prop :=
  equilibrium apex straight f X mg K /\ no_pull apex straight f X K.

(** What rests on a sphere of its floor, in f0. *)
Definition rests_on (f : nat -> Z -> Z -> three Q) (K : nat) (p : site) : Q := rests apex straight f K p.

Definition sum_of (K : nat) (psi : nat -> Z -> Z -> three Q) : Q :=
  over_spheres apex straight K (fun k i j => sum (psi k i j)).

Lemma truth_is_not_negative : forall a, 0 <= truth a.
Proof. intros []; cbn [truth]; lra. Qed.

(** A certificate of a straight pile, and what it bounds. *)
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
    unfold excess, drop, lowers, felt, lowered in *. destruct (S k =? K)%nat; exact D.
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
  certificate Plus K p psi -> rests_on f K p <= sum_of K psi.
Proof.
  intros f X K [i j] psi [E P] H C. rewrite <- works_of_mg.
  apply (at_most_the_weights apex straight f X mg K (i, j)); try assumption.
  - apply layers_of_straight. exact H.
  - apply certificates_certify. exact C.
Qed.

Theorem at_least : forall f X K p psi, balanced_beside f X K -> occupied K (fst p) (snd p) = true ->
  certificate Minus K p psi -> sum_of K psi <= rests_on f K p.
Proof.
  intros f X K [i j] psi [E P] H C. rewrite <- works_of_mg.
  apply (at_least_the_weights apex straight f X mg K (i, j)); try assumption.
  - apply layers_of_straight. exact H.
  - apply certificates_certify. exact C.
Qed.

(** ** There are such forces

    What balances the spheres of the straight pile beside their neighbours. *)
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

(** Nobody pushes: the paper's closed form is one such state, so that no bound is about nothing. *)
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

(** ** Corners *)

(** The sphere of layer k on the edge along which only one line goes on. *)
Definition corner (edge : direction) (k : nat) : site :=
  match edge with Alpha => (0, 0)%Z | Beta => (Z.of_nat k, 0%Z) | Gamma => (0%Z, Z.of_nat k) end.

(** A field that is not 0 on an edge only. *)
Definition along_the_edge (edge : direction) (phi : nat -> three Q) (k : nat) (i j : Z) : three Q :=
  if is_at (corner edge k) (i, j) then phi k else each 0.

(** 1 along the edge; and along all lines, but at the apex. *)
Definition least_field (edge : direction) : nat -> Z -> Z -> three Q :=
  along_the_edge edge (fun _ => corner_field edge false).
Definition greatest_field (edge : direction) : nat -> Z -> Z -> three Q :=
  along_the_edge edge (fun k => corner_field edge (0 <? k)%nat).

Lemma is_pair : forall a b i j, is_at (a, b) (i, j) = ((i =? a) && (j =? b))%Z.
Proof.
  intros. apply eq_true_iff_eq. rewrite is_iff, andb_true_iff, !Z.eqb_eq.
  split; [intros E; injection E; auto | intros [E F]; congruence].
Qed.

Lemma corners_are_there : forall edge k, occupied k (fst (corner edge k)) (snd (corner edge k)) = true.
Proof. intros [] k; apply occupied_iff; cbn [corner fst snd]; lia. Qed.

Lemma sum_along_the_edge : forall edge phi K, sum_of K (along_the_edge edge phi) == total K (fun k => sum (phi k)).
Proof.
  intros edge phi K. apply total_of_same. intros k _.
  transitivity (over (spheres apex straight k) (fun p => if same_site p (corner edge k) then sum (phi k) else 0)).
  - apply over_of_same. intros [i j] _. unfold along_the_edge, is_at. cbn [fst snd].
    destruct (same_site (i, j) (corner edge k)); [reflexivity | formulas; ring].
  - rewrite (over_one (spheres apex straight k) (corner edge k) (fun _ => sum (phi k))) by apply spheres_once.
    rewrite holds_spheres, holds_straight, corners_are_there. reflexivity.
Qed.

(** Whether numbers are equal, one question after the other, and what cannot be. *)
Ltac ask :=
  repeat match goal with
         | |- context [(?a =? ?b)%Z] => destruct (Z.eqb_spec a b); try (exfalso; lia)
         | |- context [(?a <=? ?b)%Z] => destruct (Z.leb_spec a b); try (exfalso; lia)
         | |- context [(?a =? ?b)%nat] => destruct (Nat.eqb_spec a b); try (exfalso; lia)
         | |- context [(?a <? ?b)%nat] => destruct (Nat.ltb_spec a b); try (exfalso; lia)
         end.

Ltac on_corners :=
  unfold lowers, presses, along_the_edge, support, next, above_in;
  cbn [from to descent fst snd corner]; unfold support; cbn [from to descent fst snd];
  rewrite ?is_pair; ask; cbn [andb truth corner_field on times each alpha beta gamma]; lra.

Lemma least_certificate : forall edge K, certificate Minus K (corner edge K) (least_field edge).
Proof.
  intros edge K. unfold least_field. split.
  - intros k i j d Hk H. apply occupied_iff in H. destruct edge, d; on_corners.
  - intros k i j x Hk H N. apply occupied_iff in H, N. unfold next, support, above_in in N.
    destruct edge, x; cbn [from to descent fst snd] in N; on_corners.
Qed.

Lemma greatest_certificate : forall edge K, certificate Plus K (corner edge K) (greatest_field edge).
Proof.
  intros edge K. unfold greatest_field. split.
  - intros k i j d Hk H. apply occupied_iff in H. destruct edge, d; on_corners.
  - intros k i j x Hk H N. apply occupied_iff in H, N. unfold next, support, above_in in N.
    destruct edge, x; cbn [from to descent fst snd] in N; on_corners.
Qed.

(** At least K f0 rest on a corner below K layers, however the spheres press each other. *)
Theorem least_on_a_corner : forall edge f X K, balanced_beside f X K ->
  least_on_corner (n_of K) <= rests_on f K (corner edge K).
Proof.
  intros edge f X K H. assert (B := at_least f X K _ _ H (corners_are_there edge K) (least_certificate edge K)).
  unfold least_field in B. rewrite sum_along_the_edge in B.
  assert (E : total K (fun _ => sum (corner_field edge false)) == least_on_corner (n_of K)).
  { clear. unfold least_on_corner. induction K as [|K IH]; cbn [total]; [reflexivity|].
    rewrite IH, n_of_S. destruct edge; formulas; ring. }
  rewrite E in B. exact B.
Qed.

(** The paper's closed form reaches it. *)
Theorem least_is_reached : forall edge K,
  rests_on paper_forces K (corner edge K) == least_on_corner (n_of K).
Proof.
  intros edge K. unfold rests_on, rests. rewrite arriving_is_received.
  destruct (paper_forces_arrive K (fst (corner edge K)) (snd (corner edge K)) (corners_are_there edge K)) as (a & b & c).
  unfold sum. rewrite a, b, c. clear a b c. unfold brought.
  destruct edge; cbn [corner fst snd]; fold (n_of K); change (q 0) with 0; formulas; ring.
Qed.

(** And at most 3K - 2. *)
Theorem greatest_on_a_corner : forall edge f X K, (1 <= K)%nat -> balanced_beside f X K ->
  rests_on f K (corner edge K) <= greatest_on_corner (n_of K).
Proof.
  intros edge f X K H1 H. assert (B := at_most f X K _ _ H (corners_are_there edge K) (greatest_certificate edge K)).
  unfold greatest_field in B. rewrite sum_along_the_edge in B.
  assert (E : total K (fun k => sum (corner_field edge (0 <? k)%nat)) == greatest_on_corner (n_of K)).
  { clear - H1. induction K as [|K IH]; [lia|]. cbn [total]. destruct K as [|K].
    - cbn [total Nat.ltb Nat.leb]. unfold n_of. cbn [Z.of_nat]. destruct edge; formulas; reflexivity.
    - rewrite IH by lia. cbn [Nat.ltb Nat.leb]. unfold greatest_on_corner. rewrite (n_of_S (S K)).
      destruct edge; formulas; ring. }
  rewrite E in B. exact B.
Qed.

(** It is reached, too: the spheres of an edge push their neighbours with 1. What all pass on then, in whole numbers: 3n + 1
    along the edge, nothing from its neighbours along it, and nothing along other lines from the edge below the apex. *)
Definition same_line (a b : direction) : bool :=
  match a, b with Alpha, Alpha | Beta, Beta | Gamma, Gamma => true | _, _ => false end.

Definition edge_push (edge : direction) (k : nat) (x : axis) (i j : Z) : Q :=
  truth (same_line edge (from x) && is_at (corner edge k) (i, j)
         || same_line edge (to x) && is_at (corner edge k) (next x (i, j))).

Definition whole_forces (edge : direction) (k : nat) (i j : Z) : three Z :=
  let n := Integers.above i j (Z.of_nat k) in
  let e := on edge n in
  let off := (Z.of_nat k - e)%Z in
  let line d := (if same_line edge d then if off =? 0 then 3 * e + 1 else if off =? 1 then 0 else e + 1
                 else if off =? 0 then if e =? 0 then 1 else 0
                 else if (off =? on d n) && (e =? 0) then on d n + 2 else on d n + 1)%Z in
  Three (line Alpha) (line Beta) (line Gamma).

Definition edge_forces (edge : direction) (k : nat) (i j : Z) : three Q := map inject_Z (whole_forces edge k i j).

Definition whole_received (edge : direction) (k : nat) (i j : Z) : three Z :=
  match k with
  | O => each 0%Z
  | S m =>
    let along d := let (a, b) := above_on d i j in if occupied m a b then on d (whole_forces edge m a b) else 0%Z in
    Three (along Alpha) (along Beta) (along Gamma)
  end.

Definition whole_pushed (edge : direction) (k : nat) (i j : Z) : three Z :=
  let n := Integers.above i j (Z.of_nat k) in
  let off := (Z.of_nat k - on edge n)%Z in
  let line d := (if off =? 0 then if Z.of_nat k =? 0 then 0 else if same_line edge d then -2 else 1
                 else if off =? 1 then if same_line edge d then 1 else - on d n else 0)%Z in
  Three (line Alpha) (line Beta) (line Gamma).

Lemma whole_balance : forall edge k i j d, occupied k i j = true ->
  on d (whole_forces edge k i j) = (on d (whole_received edge k i j) + 1 - on d (whole_pushed edge k i j))%Z.
Proof.
  intros edge [|m] i j d H; apply occupied_iff in H.
  - assert (i = 0%Z) by lia. assert (j = 0%Z) by lia. subst. destruct edge, d; reflexivity.
  - unfold whole_forces, whole_received, whole_pushed, above_on, occupied, whole_forces. rewrite Nat2Z.inj_succ in *.
    destruct edge, d; cbn [descent on same_line Integers.above alpha beta gamma]; ask; cbn [andb]; lia.
Qed.

Lemma edge_forces_arrive : forall edge k i j,
  received (edge_forces edge) k i j =3= map inject_Z (whole_received edge k i j).
Proof.
  intros edge [|m] i j; [repeat split; reflexivity|].
  unfold received, whole_received, edge_forces, above_on. cbn [descent].
  repeat split; cbn [map alpha beta gamma on];
    match goal with |- (if ?b then _ else _) == _ => destruct b; reflexivity end.
Qed.

Lemma edge_pushes : forall edge k i j, occupied k i j = true ->
  pushed_by (six (by_next apex straight (edge_push edge) k i j)) (six (by_last apex straight (edge_push edge) k i j))
  =3= map inject_Z (whole_pushed edge k i j).
Proof.
  intros edge k i j H. apply occupied_iff in H.
  unfold pushed_by, six, plus_three, by_next, by_last, touches, edge_push, next, last, support, above_in, whole_pushed.
  destruct edge; cbn [ab ag gb from to descent fst snd corner same_line on Integers.above alpha beta gamma andb orb];
    rewrite !holds_straight, !is_pair; unfold occupied; cbn [fst snd];
    ask; cbn [andb orb truth map alpha beta gamma]; repeat split; formulas; try reflexivity.
  all: try (match goal with |- _ == q ?e => replace e with 1%Z by lia; reflexivity
                          | |- _ == q ?e => replace e with (-1)%Z by lia; reflexivity
                          | |- _ == q ?e => replace e with 0%Z by lia; reflexivity end).
Qed.

Lemma beside_of_whole : forall a b c, a = (b + 1 - c)%Z -> q a == beside (q b) 1 (q c) Plus.
Proof.
  intros a b c H. subst. unfold beside, passed_on, Z.sub. rewrite !inject_Z_plus, inject_Z_opp. reflexivity.
Qed.

Theorem edge_pushes_balance : forall edge K, balanced_beside (edge_forces edge) (edge_push edge) K.
Proof.
  intros edge K. split.
  - intros k i j _ H. apply layers_of_straight in H. apply balanced_if. cbv zeta.
    rewrite (beside_of_same _ _ _ _ (edge_forces_arrive edge k i j) (edge_pushes edge k i j H)).
    unfold edge_forces. repeat split; cbn [map alpha beta gamma]; apply beside_of_whole;
      [exact (whole_balance edge k i j Alpha H) | exact (whole_balance edge k i j Beta H)
      | exact (whole_balance edge k i j Gamma H)].
  - intros k i j _ H. apply layers_of_straight, occupied_iff in H. split.
    + intros d. change 0 with (q 0). unfold edge_forces.
      assert (N : (0 <= on d (whole_forces edge k i j))%Z).
      { unfold whole_forces. destruct edge, d; cbn [on same_line Integers.above alpha beta gamma];
          ask; cbn [andb]; lia. }
      destruct d; cbn [map on alpha beta gamma] in *; rewrite <- Zle_Qle; exact N.
    + intros x _. apply truth_is_not_negative.
Qed.

Theorem greatest_is_reached : forall edge K, (1 <= K)%nat ->
  rests_on (edge_forces edge) K (corner edge K) == greatest_on_corner (n_of K).
Proof.
  intros edge [|m] H; [lia|]. unfold rests_on, rests. rewrite arriving_is_received.
  destruct (edge_forces_arrive edge (S m) (fst (corner edge (S m))) (snd (corner edge (S m)))) as (a & b & c).
  unfold sum. rewrite a, b, c. clear. cbn [map alpha beta gamma]. rewrite <- !inject_Z_plus.
  transitivity (q (3 * Z.of_nat m + 1)).
  - apply inject_Z_injective. unfold whole_received, above_on, occupied, whole_forces.
    destruct edge; cbn [corner fst snd descent alpha beta gamma on same_line Integers.above];
      rewrite ?Nat2Z.inj_succ; ask; cbn [andb]; lia.
  - unfold greatest_on_corner. rewrite n_of_S. unfold n_of. rewrite inject_Z_plus, inject_Z_mult.
    change (q 3) with 3. change (q 1) with 1. ring.
Qed.

(** ** Inside

    A sphere of the floor with a, b, c spheres above it on its lines. *)
Definition with_at_least (m n : Z) (x y : Z) : bool := ((m <=? x) && (n <=? y))%Z.

Definition inner_field (a b c : nat) (k : nat) (i j : Z) : three Q :=
  let least := Three (Z.of_nat a) (Z.of_nat b) (Z.of_nat c) in
  let n := Integers.above i j (Z.of_nat k) in
  Three (truth (with_at_least least.(beta) least.(gamma) n.(beta) n.(gamma)))
        (truth (with_at_least least.(gamma) least.(alpha) n.(gamma) n.(alpha)))
        (truth (with_at_least least.(alpha) least.(beta) n.(alpha) n.(beta))).

Lemma truth_grows : forall a b, (a = true -> b = true) -> 0 <= truth b - truth a.
Proof. intros [] [] H; cbn [truth]; try lra; specialize (H eq_refl); discriminate. Qed.

Lemma with_at_least_iff : forall m n x y, with_at_least m n x y = true <-> (m <= x /\ n <= y)%Z.
Proof. intros. unfold with_at_least. rewrite andb_true_iff, !Z.leb_le. tauto. Qed.

Definition inner_site (b c : nat) : site := (Z.of_nat b, Z.of_nat c).

Lemma inner_certificate : forall a b c, certificate Plus (a + b + c) (inner_site b c) (inner_field a b c).
Proof.
  intros a b c. split.
  - intros k i j d Hk H. apply occupied_iff in H. unfold lowers, inner_field, inner_site, support.
    cbn [times]. destruct (Nat.eqb_spec (S k) (a + b + c)) as [E | E]; destruct d;
      cbn [on descent fst snd Integers.above alpha beta gamma];
      apply truth_grows; rewrite ?is_pair, ?andb_true_iff, ?Z.eqb_eq, !with_at_least_iff; lia.
  - intros k i j x Hk H N. apply occupied_iff in H, N. unfold next, support, above_in in N.
    assert (P : forall u v, 0 <= u -> 0 <= v -> 0 <= u + v) by (intros; lra).
    unfold presses, inner_field, next, support, above_in. cbn [times].
    destruct x; cbn [from to descent fst snd] in N; cbn [from to on descent fst snd Integers.above alpha beta gamma];
      (apply P; apply truth_grows; rewrite !with_at_least_iff; lia).
Qed.

(** A layer, row by row. *)
Lemma total_of_one : forall n (z : Z) x, (0 <= z < Z.of_nat n)%Z ->
  total n (fun m => if (Z.of_nat m =? z)%Z then x else 0) == x.
Proof.
  intros n z x. induction n as [|n IH]; intros H; [lia|]. cbn [total].
  destruct (Z.eqb_spec (Z.of_nat n) z) as [E | E].
  - transitivity (total n (fun _ => 0) + x); [|rewrite total_of_nothing; ring].
    apply Qplus_comp; [|reflexivity]. apply total_of_same. intros m Hm.
    destruct (Z.eqb_spec (Z.of_nat m) z); [lia | reflexivity].
  - rewrite IH by lia. ring.
Qed.

Lemma over_total : forall A (l : list A) n (f : A -> nat -> Q),
  over l (fun p => total n (f p)) == total n (fun m => over l (fun p => f p m)).
Proof.
  intros A l n f. induction n as [|n IH]; cbn [total]; [apply over_of_nothing|].
  rewrite over_of_sum, IH. reflexivity.
Qed.

Lemma by_rows : forall k F, over (spheres apex straight k) F
  == total (S k) (fun j => total (S k - j) (fun i => F (Z.of_nat i, Z.of_nat j))).
Proof.
  intros k F.
  transitivity (over (spheres apex straight k) (fun p => total (S k) (fun j => total (S k - j) (fun i =>
    if same_site p (Z.of_nat i, Z.of_nat j) then F (Z.of_nat i, Z.of_nat j) else 0)))).
  - apply over_of_same. intros [x y] H. apply spheres_are, layers_of_straight, occupied_iff in H. symmetry.
    transitivity (total (S k) (fun j => if (Z.of_nat j =? y)%Z then F (x, y) else 0)); [|apply total_of_one; lia].
    apply total_of_same. intros j Hj. destruct (Z.eqb_spec (Z.of_nat j) y) as [E | E].
    + transitivity (total (S k - j) (fun i => if (Z.of_nat i =? x)%Z then F (x, y) else 0)); [|apply total_of_one; lia].
      apply total_of_same. intros i _. destruct (same_site (x, y) (Z.of_nat i, Z.of_nat j)) as [S | S].
      * rewrite <- S. injection S. intros. destruct (Z.eqb_spec (Z.of_nat i) x); [reflexivity | lia].
      * destruct (Z.eqb_spec (Z.of_nat i) x); [exfalso; apply S; congruence | reflexivity].
    + rewrite <- (total_of_nothing (S k - j)). apply total_of_same. intros i _.
      destruct (same_site (x, y) (Z.of_nat i, Z.of_nat j)) as [S | S]; [exfalso; congruence | reflexivity].
  - rewrite over_total. apply total_of_same. intros j Hj. rewrite over_total. apply total_of_same. intros i Hi.
    rewrite (over_one (spheres apex straight k) (Z.of_nat i, Z.of_nat j) (fun _ => F (Z.of_nat i, Z.of_nat j)))
      by apply spheres_once.
    rewrite holds_spheres, holds_straight. cbn [fst snd].
    replace (occupied k (Z.of_nat i) (Z.of_nat j)) with true by (symmetry; apply occupied_iff; lia). reflexivity.
Qed.

(** A part of a layer that is a layer k' further up, moved by (u, v). *)
Lemma moved_layer : forall k k' u v here,
  (forall i j, occupied k i j = true -> here i j = occupied k' (i - u) (j - v)) ->
  (forall i j, occupied k' i j = true -> occupied k (i + u) (j + v) = true) ->
  over (spheres apex straight k) (fun p => truth (here (fst p) (snd p)))
  == over (spheres apex straight k') (fun _ => 1).
Proof.
  intros k k' u v here H T.
  pose (there := fun p : site => ((fst p + u)%Z, (snd p + v)%Z)).
  pose (back := fun p : site => ((fst p - u)%Z, (snd p - v)%Z)).
  transitivity (over (spheres apex straight k) (fun p => if holds (spheres apex straight k') (back p) then 1 else 0)).
  - apply over_of_same. intros [i j] P. apply spheres_are, layers_of_straight in P.
    rewrite holds_spheres, holds_straight. cbn [fst snd]. rewrite H by exact P. reflexivity.
  - rewrite (over_moved _ _ there back (fun _ _ => 1)); [|apply spheres_once..|].
    + apply over_of_same. intros [i j] P. apply spheres_are, layers_of_straight in P.
      rewrite holds_spheres, holds_straight. unfold there. cbn [fst snd]. rewrite T by exact P. reflexivity.
    + intros [x y] [i j]. unfold there, back. cbn [fst snd].
      split; intros E; injection E; intros; f_equal; lia.
Qed.

Lemma no_part : forall k here, (forall i j, occupied k i j = true -> here i j = false) ->
  over (spheres apex straight k) (fun p => truth (here (fst p) (snd p))) == 0.
Proof.
  intros k here H. rewrite <- (over_of_nothing _ (spheres apex straight k)). apply over_of_same. intros [i j] P.
  apply spheres_are, layers_of_straight in P. cbn [fst snd]. rewrite H by exact P. reflexivity.
Qed.

(** So below s layers without any, l layers have the spheres of a pile. *)
Lemma moved_pile : forall l s u v (here : nat -> Z -> Z -> bool),
  (forall k i j, (s <= k)%nat -> occupied k i j = true -> here k i j = occupied (k - s) (i - u) (j - v)) ->
  (forall k i j, (s <= k)%nat -> occupied (k - s) i j = true -> occupied k (i + u) (j + v) = true) ->
  (forall k i j, (k < s)%nat -> occupied k i j = true -> here k i j = false) ->
  over_spheres apex straight (l + s) (fun k i j => truth (here k i j)) == spheres_3 (n_of l).
Proof.
  intros l s u v here H T N. rewrite <- spheres_of_a_pile. unfold over_spheres, total_over_pile.
  induction l as [|l IH].
  - cbn [Nat.add total]. rewrite <- (total_of_nothing s). apply total_of_same. intros k Hk.
    apply no_part. intros. apply N; assumption.
  - cbn [Nat.add total]. rewrite IH. apply Qplus_comp; [reflexivity|].
    rewrite (moved_layer (l + s) l u v).
    + apply by_rows.
    + intros i j P. rewrite H by (try exact P; lia). rewrite Nat.add_sub. reflexivity.
    + intros i j P. apply T; [lia|]. rewrite Nat.add_sub. exact P.
Qed.

Lemma sum_of_inner : forall a b c,
  sum_of (a + b + c) (inner_field a b c) == greatest_inside (Three (n_of a) (n_of b) (n_of c)).
Proof.
  intros a b c.
  rewrite <- inner_greatest. cbv zeta. rewrite !spheres_of_a_pile.
  rewrite <- (moved_pile a (b + c) (Z.of_nat b) (Z.of_nat c) (fun k i j =>
    with_at_least (Z.of_nat b) (Z.of_nat c) i j)).
  rewrite <- (moved_pile b (a + c) 0 (Z.of_nat c) (fun k i j =>
    with_at_least (Z.of_nat c) (Z.of_nat a) j (Z.of_nat k - i - j))).
  rewrite <- (moved_pile c (a + b) (Z.of_nat b) 0 (fun k i j =>
    with_at_least (Z.of_nat a) (Z.of_nat b) (Z.of_nat k - i - j) i)).
  1: replace (b + (a + c))%nat with (a + b + c)%nat by lia;
    replace (c + (a + b))%nat with (a + b + c)%nat by lia; rewrite Nat.add_assoc;
    unfold sum_of, over_spheres; rewrite <- !total_of_sum; apply total_of_same; intros k _;
    rewrite <- !over_of_sum; apply over_of_same; intros p _; reflexivity.
  all: intros k i j Hk P; rewrite occupied_iff in *;
    try (apply eq_true_iff_eq; rewrite occupied_iff, with_at_least_iff); 
    try (apply not_true_iff_false; rewrite with_at_least_iff); lia.
Qed.

(** At most the sum of C(n_l + 2, 3) rests on a sphere of the floor with n_l spheres above it on its lines. *)
Theorem greatest_on_any_sphere : forall a b c f X, balanced_beside f X (a + b + c) ->
  rests_on f (a + b + c) (inner_site b c) <= greatest_inside (Three (n_of a) (n_of b) (n_of c)).
Proof.
  intros a b c f X H. rewrite <- sum_of_inner. apply (at_most f X); [exact H | | apply inner_certificate].
  apply occupied_iff. cbn [inner_site fst snd]. lia.
Qed.

(** ** Edges

    A sphere of the floor with k spheres above it along a, j along b and none along the third line. *)
Definition placed (a b : direction) (x y : Z) : site :=
  let on_line d := if same_line a d then x else if same_line b d then y else 0%Z in
  (on_line Beta, on_line Gamma).

(** The spheres on which the field is 1: along a, along b, along the third line. *)
Definition along_first (k j c x y : Z) : bool := ((y =? j) && (x <? k) || (j <? y) && (x + y <? j + c))%Z.
Definition along_second (j c x y : Z) : bool := ((c <=? x) && (y <=? j))%Z.
Definition along_third (k j c x y : Z) : bool :=
  along_first k j c x y && (1 <=? x)%Z || along_second j c x y && (1 <=? y)%Z.

Definition along_line (a b : direction) (k j c : nat) (d : direction) (x y : Z) : bool :=
  let '(k, j, c) := (Z.of_nat k, Z.of_nat j, Z.of_nat c) in
  if same_line a d then along_first k j c x y
  else if same_line b d then along_second j c x y else along_third k j c x y.

Definition edge_part (a b : direction) (k j c : nat) (d : direction) (m : nat) (p : site) : bool :=
  let n := Integers.above (fst p) (snd p) (Z.of_nat m) in
  (on a n + on b n =? Z.of_nat m)%Z && along_line a b k j c d (on a n) (on b n).

Definition edge_field (a b : direction) (k j c m : nat) (i l : Z) : three Q :=
  let part d := truth (edge_part a b k j c d m (i, l)) in Three (part Alpha) (part Beta) (part Gamma).

Lemma on_edge_field : forall a b k j c m i l d,
  on d (edge_field a b k j c m i l) = truth (edge_part a b k j c d m (i, l)).
Proof. intros. destruct d; reflexivity. Qed.

Lemma truth_grows_together : forall a b c d,
  (b = true -> a = true \/ c = true) -> (d = true -> a = true \/ c = true) ->
  (b = true -> d = true -> a = true /\ c = true) -> 0 <= truth a - truth b + (truth c - truth d).
Proof. intros [] [] [] []; cbn [truth]; intros A B C; try lra; intuition discriminate. Qed.

Ltac parts :=
  unfold along_third, along_first, along_second;
  rewrite ?andb_true_iff, ?orb_true_iff, ?andb_true_iff, ?orb_true_iff, ?andb_true_iff, ?Z.eqb_eq, ?Z.ltb_lt, ?Z.leb_le.

(** D and c by lines, whichever two of the three the first two are: x and y are the counts along these. *)
Section Signs.
Variables k j c m below x y x' y' : Z.
Hypothesis Hc : (1 <= c <= k)%Z.
Hypothesis Hx : (0 <= x)%Z.
Hypothesis Hy : (0 <= y)%Z.
Hypothesis Hm : (x + y <= m)%Z.

Definition of_edge (part : Z -> Z -> bool) (m x y : Z) : Q := truth ((x + y =? m)%Z && part x y).

Lemma first_lowers : below = (m + 1)%Z -> x' = (x + 1)%Z -> y' = y ->
  0 <= of_edge (along_first k j c) m x y - of_edge (along_first k j c) below x' y'.
Proof. intros. apply truth_grows. parts. lia. Qed.

Lemma second_lowers : below = (m + 1)%Z -> x' = x -> y' = (y + 1)%Z ->
  0 <= of_edge (along_second j c) m x y - of_edge (along_second j c) below x' y'.
Proof. intros. apply truth_grows. parts. lia. Qed.

Lemma third_lowers : below = (m + 1)%Z -> x' = x -> y' = y ->
  0 <= of_edge (along_third k j c) m x y - of_edge (along_third k j c) below x' y'.
Proof. intros. apply truth_grows. rewrite !andb_true_iff, !Z.eqb_eq. lia. Qed.

Lemma first_to_second_presses : x' = (x - 1)%Z -> y' = (y + 1)%Z -> (1 <= x)%Z ->
  0 <= (of_edge (along_second j c) m x y - of_edge (along_second j c) m x' y')
       + (of_edge (along_first k j c) m x' y' - of_edge (along_first k j c) m x y).
Proof. intros. apply truth_grows_together; parts; lia. Qed.

Lemma first_to_third_presses : x' = (x - 1)%Z -> y' = y -> (1 <= x)%Z ->
  0 <= (of_edge (along_third k j c) m x y - of_edge (along_third k j c) m x' y')
       + (of_edge (along_first k j c) m x' y' - of_edge (along_first k j c) m x y).
Proof. intros. apply truth_grows_together; parts; lia. Qed.

Lemma second_to_third_presses : x' = x -> y' = (y - 1)%Z -> (1 <= y)%Z ->
  0 <= (of_edge (along_third k j c) m x y - of_edge (along_third k j c) m x' y')
       + (of_edge (along_second j c) m x' y' - of_edge (along_second j c) m x y).
Proof. intros. apply truth_grows_together; parts; lia. Qed.

End Signs.

(** The same contact from its other end. *)
Lemma from_the_other_end : forall a b c d, 0 <= a - b + (c - d) -> 0 <= c - d + (a - b).
Proof. intros. lra. Qed.

Ltac by_counts :=
  unfold edge_part, along_line; cbn [same_line fst snd on Integers.above alpha beta gamma].

Ltac lowering :=
  lazymatch goal with
  | |- 0 <= truth (_ && along_first _ _ _ _ _) - _ => apply first_lowers
  | |- 0 <= truth (_ && along_second _ _ _ _) - _ => apply second_lowers
  | |- 0 <= truth (_ && along_third _ _ _ _ _) - _ => apply third_lowers
  end.

Ltac pressing :=
  lazymatch goal with
  | |- 0 <= truth (_ && along_first _ _ _ _ _) - _ + _ => apply from_the_other_end; pressing
  | |- 0 <= truth (_ && along_second _ _ _ _) - _ + (truth (_ && along_third _ _ _ _ _) - _) =>
      apply from_the_other_end; pressing
  | |- 0 <= _ + (truth (_ && along_second _ _ _ _) - _) => apply second_to_third_presses
  | |- 0 <= truth (_ && along_second _ _ _ _) - _ + _ => apply first_to_second_presses
  | |- 0 <= truth (_ && along_third _ _ _ _ _) - _ + _ => apply first_to_third_presses
  end.

Lemma edge_certificate : forall a b k j c, a <> b -> (1 <= c <= k)%nat ->
  certificate Plus (k + j) (placed a b (Z.of_nat k) (Z.of_nat j)) (edge_field a b k j c).
Proof.
  intros a b k j c D Hc. split.
  - intros m i l d Hm H. apply occupied_iff in H. unfold lowers, support. rewrite on_edge_field. cbn [times].
    destruct (Nat.eqb_spec (S m) (k + j)) as [E | E].
    + apply truth_grows. unfold placed.
      destruct a, b; try congruence; destruct d; cbn [descent fst snd]; by_counts; rewrite is_pair; parts; lia.
    + rewrite on_edge_field.
      destruct a, b; try congruence; destruct d; cbn [descent fst snd]; by_counts;
        lowering; lia.
  - intros m i l x Hm H N. apply occupied_iff in H, N.
    unfold presses. rewrite !on_edge_field. cbn [times].
    unfold next, support, above_in in *.
    destruct a, b; try congruence; destruct x; cbn [from to descent fst snd] in N |- *; by_counts;
      pressing; lia.
Qed.

(** The row of a layer that is on the edge, as a sum. *)
Lemma over_edge : forall a b m (F : Z -> Z -> bool), a <> b ->
  over (spheres apex straight m) (fun p =>
    let n := Integers.above (fst p) (snd p) (Z.of_nat m) in
    truth ((on a n + on b n =? Z.of_nat m)%Z && F (on a n) (on b n)))
  == total (S m) (fun y => truth (F (Z.of_nat m - Z.of_nat y)%Z (Z.of_nat y))).
Proof.
  intros a b m F D.
  pose (at_row := fun y : nat => placed a b (Z.of_nat m - Z.of_nat y) (Z.of_nat y)).
  transitivity (over (spheres apex straight m) (fun p => total (S m) (fun y =>
    if same_site p (at_row y) then truth (F (Z.of_nat m - Z.of_nat y)%Z (Z.of_nat y)) else 0))).
  - apply over_of_same. intros [i l] H. apply spheres_are, layers_of_straight, occupied_iff in H. cbv zeta. cbn [fst snd].
    set (n := Integers.above i l (Z.of_nat m)).
    assert (I : forall y : nat, (i, l) = at_row y <-> (on a n + on b n = Z.of_nat m /\ Z.of_nat y = on b n)%Z).
    { intros y. unfold n, at_row, placed.
      destruct a, b; try congruence; cbn [same_line on Integers.above alpha beta gamma];
        (split; [intros E; injection E; intros; lia | intros; f_equal; lia]). }
    destruct (Z.eqb_spec (on a n + on b n) (Z.of_nat m)) as [E | E].
    + symmetry. cbn [andb].
      transitivity (total (S m) (fun y => if (Z.of_nat y =? on b n)%Z then truth (F (on a n) (on b n)) else 0)).
      * apply total_of_same. intros y _.
        destruct (same_site (i, l) (at_row y)) as [S | S]; [apply I in S | rewrite I in S];
          destruct (Z.eqb_spec (Z.of_nat y) (on b n)) as [R | R]; try reflexivity; try (exfalso; tauto).
        rewrite R. replace (Z.of_nat m - on b n)%Z with (on a n) by lia. reflexivity.
      * apply total_of_one. unfold n in *. destruct a, b; try congruence; cbn [on Integers.above alpha beta gamma] in *; lia.
    + cbn [andb truth]. symmetry. rewrite <- (total_of_nothing (S m)). apply total_of_same. intros y _.
      destruct (same_site (i, l) (at_row y)) as [S | S]; [apply I in S; exfalso; tauto | reflexivity].
  - rewrite over_total. apply total_of_same. intros y Hy.
    rewrite (over_one (spheres apex straight m) (at_row y) (fun _ => truth (F (Z.of_nat m - Z.of_nat y)%Z (Z.of_nat y))))
      by apply spheres_once.
    rewrite holds_spheres, holds_straight.
    replace (occupied m (fst (at_row y)) (snd (at_row y))) with true; [reflexivity|].
    symmetry. unfold at_row, placed. cbn [fst snd]. apply occupied_iff.
    destruct a, b; try congruence; cbn [same_line]; lia.
Qed.

(** All rows of an edge, by rows along a. *)
Lemma rows_along : forall K (F : Z -> Z -> Q),
  total K (fun m => total (S m) (fun y => F (Z.of_nat m - Z.of_nat y)%Z (Z.of_nat y)))
  == total K (fun y => total (K - y) (fun x => F (Z.of_nat x) (Z.of_nat y))).
Proof.
  intros K F. induction K as [|K IH]; [reflexivity|].
  cbn [total] in IH |- *. rewrite IH.
  transitivity (total K (fun y => total (K - y) (fun x => F (Z.of_nat x) (Z.of_nat y))
      + F (Z.of_nat K - Z.of_nat y)%Z (Z.of_nat y))
    + F (Z.of_nat K - Z.of_nat K)%Z (Z.of_nat K)).
  - rewrite total_of_sum. ring.
  - apply Qplus_comp.
    + apply total_of_same. intros y Hy. replace (S K - y)%nat with (S (K - y)) by lia. cbn [total].
      rewrite Nat2Z.inj_sub by lia. reflexivity.
    + replace (S K - K)%nat with 1%nat by lia. cbn [total]. change (Z.of_nat 0) with 0%Z. rewrite Z.sub_diag. ring.
Qed.

(** How many of a row are from one place on up to another. *)
Lemma count_from_to : forall n lo hi (F : nat -> bool), (lo <= hi <= n)%nat ->
  (forall x, (x < n)%nat -> (F x = true <-> (lo <= x < hi)%nat)) ->
  total n (fun x => truth (F x)) == n_of hi - n_of lo.
Proof.
  intros n lo hi F. revert lo hi. induction n as [|n IH]; intros lo hi H E.
  - assert (lo = 0%nat) by lia. assert (hi = 0%nat) by lia. subst. reflexivity.
  - cbn [total]. specialize (E n (Nat.lt_succ_diag_r n)) as En.
    destruct (F n) eqn:Fn; cbn [truth].
    + assert (lo <= n < hi)%nat by (apply En; reflexivity). assert (hi = S n) by lia. subst hi.
      rewrite (IH lo n) by (try lia; intros; rewrite E by lia; lia). rewrite n_of_S. ring.
    + assert (N : ~ (lo <= n < hi)%nat) by (intros N; apply En in N; discriminate).
      destruct (Nat.eq_dec lo (S n)) as [L | L].
      * assert (hi = S n) by lia. subst.
        rewrite (IH n n) by (try lia; intros; rewrite E by lia; lia). ring.
      * destruct (Nat.eq_dec hi (S n)) as [M | M].
        -- assert (lo = hi) by lia. lia.
        -- rewrite (IH lo hi) by (try lia; intros; rewrite E by lia; lia). ring.
Qed.

Lemma total_in_two : forall a b f, total (a + b) f == total a f + total b (fun m => f (a + m)%nat).
Proof.
  intros a b f. induction b as [|b IH]; [rewrite Nat.add_0_r; cbn [total]; ring|].
  rewrite Nat.add_succ_r. cbn [total]. rewrite IH. ring.
Qed.

Lemma total_counting_down : forall n A, total n (fun y => A - n_of y) == A * n_of n - n_of n * (n_of n - 1) * (1 # 2).
Proof.
  intros n A. apply (total_is (fun y => A - y) (fun x => A * x - x * (x - 1) * (1 # 2)));
    [intros ? ? ?; congruent | ring | intros; ring].
Qed.

(** The three sums over a row y: below j, at j, and above it. *)
Section Rows.
Variables k j c : nat.
Hypothesis Hj : (1 <= j)%nat.
Hypothesis Hc : (1 <= c <= k)%nat.

Definition row (part : Z -> Z -> bool) (y : nat) : Q :=
  total (k + j - y) (fun x => truth (part (Z.of_nat x) (Z.of_nat y))).

Let first := along_first (Z.of_nat k) (Z.of_nat j) (Z.of_nat c).
Let second := along_second (Z.of_nat j) (Z.of_nat c).
Let third := along_third (Z.of_nat k) (Z.of_nat j) (Z.of_nat c).

Ltac counted lo hi :=
  unfold row; rewrite (count_from_to _ lo hi);
  [| lia |
   intros; unfold first, second, third, along_third, along_first, along_second;
   rewrite ?andb_true_iff, ?orb_true_iff, ?andb_true_iff, ?orb_true_iff, ?andb_true_iff, ?Z.eqb_eq, ?Z.ltb_lt, ?Z.leb_le; lia].

Lemma rows_of_first : total (k + j) (row first) == n_of k + (n_of c - 1) * n_of c * (1 # 2).
Proof.
  replace (k + j)%nat with (j + (1 + ((c - 1) + (k - c))))%nat by lia. rewrite !total_in_two.
  assert (A : total j (row first) == 0).
  { rewrite <- (total_of_nothing j). apply total_of_same. intros y Hy. counted 0%nat 0%nat. ring. }
  assert (B : total 1 (fun m => row first (j + m)) == n_of k).
  { cbn [total]. counted 0%nat k. rewrite n_of_0. ring. }
  assert (C : total (c - 1) (fun m => row first (j + (1 + m))) == total (c - 1) (fun m => n_of c - 1 - n_of m)).
  { apply total_of_same. intros y Hy. counted 0%nat (c - 1 - y)%nat. rewrite !n_of_sub by lia. rewrite n_of_0.
    change (n_of 1) with 1. ring. }
  assert (D : total (k - c) (fun m => row first (j + (1 + (c - 1 + m)))) == 0).
  { rewrite <- (total_of_nothing (k - c)). apply total_of_same. intros y Hy. counted 0%nat 0%nat. ring. }
  rewrite A, B, C, D, total_counting_down, n_of_sub by lia. change (n_of 1) with 1. ring.
Qed.

Lemma rows_of_second : total (k + j) (row second)
  == (n_of k + n_of j - n_of c) * (n_of j + 1) - (n_of j + 1) * n_of j * (1 # 2).
Proof.
  replace (k + j)%nat with (S j + (k - 1))%nat by lia. rewrite !total_in_two.
  assert (A : total (S j) (row second) == total (S j) (fun y => n_of k + n_of j - n_of c - n_of y)).
  { apply total_of_same. intros y Hy. counted c (k + j - y)%nat. rewrite n_of_sub by lia.
    unfold n_of at 1. rewrite Nat2Z.inj_add, inject_Z_plus. fold (n_of k) (n_of j). ring. }
  assert (B : total (k - 1) (fun m => row second (S j + m)) == 0).
  { rewrite <- (total_of_nothing (k - 1)). apply total_of_same. intros y Hy. counted 0%nat 0%nat. ring. }
  rewrite A, B, total_counting_down, n_of_S. ring.
Qed.

Lemma rows_of_third : total (k + j) (row third)
  == (n_of k + n_of j - n_of c) * (n_of j - 1) - n_of j * (n_of j - 1) * (1 # 2)
     + (n_of k - 1) + (n_of c - 1) * (n_of c - 2) * (1 # 2).
Proof.
  replace (k + j)%nat with (1 + ((j - 1) + (1 + ((c - 1) + (k - c)))))%nat by lia. rewrite !total_in_two.
  assert (Z : total 1 (row third) == 0).
  { cbn [total]. counted 0%nat 0%nat. ring. }
  assert (A : total (j - 1) (fun m => row third (1 + m)) == total (j - 1) (fun y => n_of k + n_of j - n_of c - 1 - n_of y)).
  { apply total_of_same. intros y Hy. counted c (k + j - (1 + y))%nat. rewrite n_of_sub by lia.
    unfold n_of at 1. rewrite Nat2Z.inj_add, inject_Z_plus. fold (n_of k) (n_of j).
    change (1 + y)%nat with (S y). rewrite n_of_S. ring. }
  assert (B : total 1 (fun m => row third (1 + (j - 1 + m))) == n_of k - 1).
  { cbn [total]. counted 1%nat k. change (n_of 1) with 1. ring. }
  assert (C : total (c - 1) (fun m => row third (1 + (j - 1 + (1 + m)))) == total (c - 1) (fun m => n_of c - 2 - n_of m)).
  { apply total_of_same. intros y Hy. counted 1%nat (c - 1 - y)%nat. rewrite !n_of_sub by lia.
    change (n_of 1) with 1. ring. }
  assert (D : total (k - c) (fun m => row third (1 + (j - 1 + (1 + (c - 1 + m))))) == 0).
  { rewrite <- (total_of_nothing (k - c)). apply total_of_same. intros y Hy. counted 0%nat 0%nat. ring. }
  rewrite Z, A, B, C, D, !total_counting_down, !n_of_sub by lia. change (n_of 1) with 1. ring.
Qed.

End Rows.

Lemma sum_of_edge : forall a b k j c, a <> b -> (1 <= j)%nat -> (1 <= c <= k)%nat ->
  sum_of (k + j) (edge_field a b k j c) == greatest_on_edge (n_of k) (n_of j) (n_of c).
Proof.
  intros a b k j c D Hj Hc.
  assert (R : forall d, over_spheres apex straight (k + j) (fun m i l => truth (edge_part a b k j c d m (i, l)))
    == total (k + j) (row k j (along_line a b k j c d))).
  { intros d. unfold row. rewrite <- (rows_along (k + j) (fun x y => truth (along_line a b k j c d x y))).
    apply total_of_same. intros m _. rewrite <- (over_edge a b m (along_line a b k j c d) D).
    apply over_of_same. intros [i l] _. reflexivity. }
  transitivity (total (k + j) (row k j (along_line a b k j c Alpha)) + total (k + j) (row k j (along_line a b k j c Beta))
    + total (k + j) (row k j (along_line a b k j c Gamma))).
  - rewrite <- !R. unfold sum_of, over_spheres. rewrite <- !total_of_sum. apply total_of_same. intros m _.
    rewrite <- !over_of_sum. apply over_of_same. intros p _. reflexivity.
  - assert (A := rows_of_first k j c Hj Hc). assert (B := rows_of_second k j c Hj Hc).
    assert (C := rows_of_third k j c Hj Hc).
    destruct a, b; try congruence; unfold along_line; cbn [same_line];
      match goal with |- ?s == _ => ring_simplify s end; rewrite A, B, C; formulas; ring.
Qed.

(** For every c. *)
Theorem greatest_on_an_edge_for : forall a b k j c f X, a <> b -> (1 <= j)%nat -> (1 <= c <= k)%nat ->
  balanced_beside f X (k + j) ->
  rests_on f (k + j) (placed a b (Z.of_nat k) (Z.of_nat j)) <= greatest_on_edge (n_of k) (n_of j) (n_of c).
Proof.
  intros a b k j c f X D Hj Hc H. rewrite <- (sum_of_edge a b k j c D Hj Hc).
  apply (at_most f X); [exact H | | apply edge_certificate; assumption].
  apply occupied_iff. unfold placed. destruct a, b; try congruence; cbn [same_line fst snd]; lia.
Qed.

(** The bound is that for c = min(j+1, k): 2(j+1)(k-1) + 1 rest on it at most, and 2k^2 for k = j. *)
Theorem greatest_on_an_edge : forall a b k j f X, a <> b -> (1 <= j <= k)%nat -> balanced_beside f X (k + j) ->
  let rests := rests_on f (k + j) (placed a b (Z.of_nat k) (Z.of_nat j)) in
  rests <= greatest_on_edge (n_of k) (n_of j) (n_of (Nat.min (j + 1) k)) /\
  ((j < k)%nat -> rests <= 2 * (n_of j + 1) * (n_of k - 1) + 1) /\
  (j = k -> rests <= 2 * n_of k * n_of k).
Proof.
  intros a b k j f X D Hj H. cbv zeta.
  assert (B := greatest_on_an_edge_for a b k j (Nat.min (j + 1) k) f X D (proj1 Hj)). specialize (B ltac:(lia) H).
  destruct (edge_greatest_is (n_of k) (n_of j)) as [E F].
  split; [exact B|]. split; intros C.
  - rewrite Nat.min_l in B by lia. rewrite <- E.
    assert (R : greatest_on_edge (n_of k) (n_of j) (n_of (j + 1)) == greatest_on_edge (n_of k) (n_of j) (n_of j + 1)).
    { rewrite Nat.add_1_r. formulas. rewrite n_of_S. reflexivity. }
    rewrite <- R. exact B.
  - subst j. rewrite Nat.min_r in B by lia. rewrite <- F. exact B.
Qed.
