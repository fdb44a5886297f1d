(** Bounds of the load on a bottom sphere of the straight pile, for all horizontal forces: at a corner, inside, and
    on an edge. Each bound is the virtual work of the weights on a field whose signs are proved. For a load G in f0
    the normal force is 1 + G/3 mg. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool List.
From Cannonpile Require Import Directions Sums Formulas Balance Straight Floor Stackings Regions Horizontal Virtual.

Import ListNotations.
Open Scope Q_scope.
Set Default Proof Using "Type".

(** ** Corners *)

(** The sphere of layer k on the edge where only one line continues. *)
Definition corner (edge : direction) (k : nat) : site :=
  match edge with Alpha => (0, 0)%Z | Beta => (Z.of_nat k, 0%Z) | Gamma => (0%Z, Z.of_nat k) end.

(** A field that is zero outside an edge. *)
Definition along_the_edge (edge : direction) (phi : nat -> three Q) (k : nat) (i j : Z) : three Q :=
  if is_at (corner edge k) (i, j) then phi k else each 0.

(** The field of the lower bound is 1 along the edge. The field of the upper bound is 1 along all lines, except at the
    apex. *)
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

(** Decides equality of numbers case by case, and discards impossible cases. *)
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

(** The load on a corner below K layers is at least K f0, for all horizontal forces. *)
Theorem least_on_a_corner : forall edge f X K, balanced_beside f X K ->
  least_on_corner (n_of K) <= load_on f K (corner edge K).
Proof.
  intros edge f X K H. assert (B := at_least f X K _ _ H (corners_are_there edge K) (least_certificate edge K)).
  unfold least_field in B. rewrite sum_along_the_edge in B.
  assert (E : total K (fun _ => sum (corner_field edge false)) == least_on_corner (n_of K)).
  { clear. unfold least_on_corner. induction K as [|K IH]; cbn [total]; [reflexivity|].
    rewrite IH, n_of_S. destruct edge; formulas; ring. }
  rewrite E in B. exact B.
Qed.

(** The closed form of the paper attains this bound. *)
Theorem least_is_reached : forall edge K,
  load_on paper_forces K (corner edge K) == least_on_corner (n_of K).
Proof.
  intros edge K. unfold load_on, load_below. rewrite arriving_is_received.
  destruct (paper_forces_arrive K (fst (corner edge K)) (snd (corner edge K)) (corners_are_there edge K)) as (a & b & c).
  unfold sum. rewrite a, b, c. clear a b c. unfold brought.
  destruct edge; cbn [corner fst snd]; fold (n_of K); change (q 0) with 0; formulas; ring.
Qed.

(** The load on a corner below K layers is at most 3K - 2 f0, for all horizontal forces. *)
Theorem greatest_on_a_corner : forall edge f X K, (1 <= K)%nat -> balanced_beside f X K ->
  load_on f K (corner edge K) <= greatest_on_corner (n_of K).
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

Definition same_line (a b : direction) : bool :=
  match a, b with Alpha, Alpha | Beta, Beta | Gamma, Gamma => true | _, _ => false end.

(** The upper bound is attained too: the spheres of an edge press on their neighbours with force 1. In integers, a
    sphere transmits 3n + 1 along the edge. Its neighbours transmit nothing along the edge, and no sphere of the edge
    below the apex transmits along other lines. *)
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
    ask; cbn [andb orb truth map alpha beta gamma]; repeat split; formulas;
    first [reflexivity
          | match goal with
            | |- _ == q ?e => first [replace e with 1%Z by lia | replace e with (-1)%Z by lia | replace e with 0%Z by lia]
            end; reflexivity].
Qed.

Lemma beside_of_whole : forall a b c, a = (b + 1 - c)%Z -> q a == beside (q b) 1 (q c) Plus.
Proof.
  intros a b c H. subst. unfold beside, transmitted, Z.sub. rewrite !inject_Z_plus, inject_Z_opp. reflexivity.
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
  load_on (edge_forces edge) K (corner edge K) == greatest_on_corner (n_of K).
Proof.
  intros edge [|m] H; [lia|]. unfold load_on, load_below. rewrite arriving_is_received.
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

    A bottom sphere with a, b, c spheres above it on its lines. *)
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

(** Sums over a layer are computed row by row. *)
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

(** A part of layer k that is a copy of layer k', moved by (u, v). *)
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

(** Below s empty layers, l layers have the spheres of a pile. *)
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

(** The load on a bottom sphere with n_l spheres above it on its lines is at most the sum of C(n_l + 2, 3). *)
Theorem greatest_on_any_sphere : forall a b c f X, balanced_beside f X (a + b + c) ->
  load_on f (a + b + c) (inner_site b c) <= greatest_inside (Three (n_of a) (n_of b) (n_of c)).
Proof.
  intros a b c f X H. rewrite <- sum_of_inner. apply (at_most f X); [exact H | | apply inner_certificate].
  apply occupied_iff. cbn [inner_site fst snd]. lia.
Qed.

(** ** Edges

    A bottom sphere with k spheres above it along a, j along b and none along the third line. *)
Definition placed (a b : direction) (x y : Z) : site :=
  let on_line d := if same_line a d then x else if same_line b d then y else 0%Z in
  (on_line Beta, on_line Gamma).

(** The spheres on which the field is 1 along the lines a and b and along the third line. *)
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

(** The signs of D and c by lines, for any choice of the first two lines. x and y are their counts. *)
Section Signs.
Variables k j c m below x y x' y' : Z.
Hypothesis Hc : (1 <= c <= k)%Z.
Hypothesis Hx : (0 <= x)%Z.
Hypothesis Hy : (0 <= y)%Z.
Hypothesis Hm : (x + y <= m)%Z.

Definition of_edge (part : Z -> Z -> bool) (m x y : Z) : Q := truth ((x + y =? m)%Z && part x y).

Lemma first_lowers : below = (m + 1)%Z -> x' = (x + 1)%Z -> y' = y ->
  0 <= of_edge (along_first k j c) m x y - of_edge (along_first k j c) below x' y'.
Proof using Hc Hx Hy Hm. intros. apply truth_grows. parts. lia. Qed.

Lemma second_lowers : below = (m + 1)%Z -> x' = x -> y' = (y + 1)%Z ->
  0 <= of_edge (along_second j c) m x y - of_edge (along_second j c) below x' y'.
Proof using Hx Hy Hm. intros. apply truth_grows. parts. lia. Qed.

Lemma third_lowers : below = (m + 1)%Z -> x' = x -> y' = y ->
  0 <= of_edge (along_third k j c) m x y - of_edge (along_third k j c) below x' y'.
Proof using Hc Hx Hy Hm. intros. apply truth_grows. rewrite !andb_true_iff, !Z.eqb_eq. lia. Qed.

Lemma first_to_second_presses : x' = (x - 1)%Z -> y' = (y + 1)%Z -> (1 <= x)%Z ->
  0 <= (of_edge (along_second j c) m x y - of_edge (along_second j c) m x' y')
       + (of_edge (along_first k j c) m x' y' - of_edge (along_first k j c) m x y).
Proof using Hc Hx Hy Hm. intros. apply truth_grows_together; parts; lia. Qed.

Lemma first_to_third_presses : x' = (x - 1)%Z -> y' = y -> (1 <= x)%Z ->
  0 <= (of_edge (along_third k j c) m x y - of_edge (along_third k j c) m x' y')
       + (of_edge (along_first k j c) m x' y' - of_edge (along_first k j c) m x y).
Proof using Hc Hx Hy Hm. intros. apply truth_grows_together; parts; lia. Qed.

Lemma second_to_third_presses : x' = x -> y' = (y - 1)%Z -> (1 <= y)%Z ->
  0 <= (of_edge (along_third k j c) m x y - of_edge (along_third k j c) m x' y')
       + (of_edge (along_second j c) m x' y' - of_edge (along_second j c) m x y).
Proof using Hc Hx Hy Hm. intros. apply truth_grows_together; parts; lia. Qed.

End Signs.

(** The condition on c is the same from both ends of a contact. *)
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

(** A sum along the edge of a layer. *)
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

(** A sum over the layers in rows along a. *)
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

(** The number of spheres of a row between two positions. *)
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
Proof using Hj Hc.
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
Proof using Hj Hc.
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
Proof using Hj Hc.
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

(** The upper bound on an edge, for every c. *)
Theorem greatest_on_an_edge_for : forall a b k j c f X, a <> b -> (1 <= j)%nat -> (1 <= c <= k)%nat ->
  balanced_beside f X (k + j) ->
  load_on f (k + j) (placed a b (Z.of_nat k) (Z.of_nat j)) <= greatest_on_edge (n_of k) (n_of j) (n_of c).
Proof.
  intros a b k j c f X D Hj Hc H. rewrite <- (sum_of_edge a b k j c D Hj Hc).
  apply (at_most f X); [exact H | | apply edge_certificate; assumption].
  apply occupied_iff. unfold placed. destruct a, b; try congruence; cbn [same_line fst snd]; lia.
Qed.

(** The bound for c = min(j+1, k): the load is at most 2(j+1)(k-1) + 1, and 2k^2 for k = j. *)
Theorem greatest_on_an_edge : forall a b k j f X, a <> b -> (1 <= j <= k)%nat -> balanced_beside f X (k + j) ->
  let load := load_on f (k + j) (placed a b (Z.of_nat k) (Z.of_nat j)) in
  load <= greatest_on_edge (n_of k) (n_of j) (n_of (Nat.min (j + 1) k)) /\
  ((j < k)%nat -> load <= 2 * (n_of j + 1) * (n_of k - 1) + 1) /\
  (j = k -> load <= 2 * n_of k * n_of k).
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
