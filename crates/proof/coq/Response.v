(** The response to a unit load in any stacking: conserved quantities and moments. *)

From Coq Require Import ZArith QArith Qabs Qfield Setoid Morphisms Lia Lqa List.
From Cannonpile Require Import Directions Sums Formulas Balance Stackings Horizontal Virtual.

Import ListNotations.
Open Scope Q_scope.

(** ** One sphere *)

(** A sign-free form: for g under - steps, Gg has the same resultant along the directions of +. *)
Theorem resultant_form : forall g,
  resultant g (directions_under (1 # 2) Minus) =v= resultant (half_turn g) (directions_under (1 # 2) Plus).
Proof. intros []. unfold directions_under. by_components. Qed.

(** Sums and squares: f = T g + n adds 3n to the sum of g, and 2n times the sum plus 3n^2 to the sum of squares. *)
Theorem sums_and_squares : forall from to g n,
  let f := by_line transmitted (transferred from to g) (each n) in
  sum f == sum g + 3 * n /\ dot f f == dot g g + 2 * n * sum g + 3 * n * n /\
  force n (weight (increments (1 # 2))) == 3 * n.
Proof. intros [] [] [] n; unfold transferred, dot; repeat split; formulas; ring. Qed.

(** HCP is a wave: three spheres transmit to the sphere between them 2/3 of their loads minus the force that a sphere
    two layers above transmitted. *)
Theorem wave_of_hcp : forall g h k,
  (half_turn g).(alpha) + (half_turn h).(beta) + (half_turn k).(gamma)
  == (2 # 3) * (sum g + sum h + sum k) - (g.(alpha) + h.(beta) + k.(gamma)).
Proof. intros [] [] []. formulas. ring. Qed.

(** Few faults: a sign change turns 3v along a line into -v along it and 2v along the others. *)
Theorem fault : forall l v,
  let t := map (Qmult 3) (half_turn (map (Qmult v) (one_on l))) in
  t =3= map (fun one => (2 - 3 * one) * v) (one_on l) /\ sum t == 3 * v /\ dot t t == 9 * v * v.
Proof. intros [] v; unfold one_on, dot; repeat split; formulas; ring. Qed.

(** ** Positions

    A contact leads down by the position of one sphere on its line. Positions are (x, y), in units with
    r^2 = x^2 + 3y^2. *)
Definition down_by (sigma : sign) (d : direction) : vector := position (one_on d) (directions_under (1 # 2) sigma).

(** One fault, m steps above and n below: six loads 2/9 and three -1/9, at these distances. *)
Theorem one_fault : forall a b m n,
  let x := m * (down_by Plus a).(along_x) + n * (down_by Minus b).(along_x) in
  let y := m * (down_by Plus a).(along_y) + n * (down_by Minus b).(along_y) in
  let v := on b (half_turn (map (Qmult (1 # 3)) (one_on a))) in
  (a = b -> v == - (1 # 9) /\ x * x + 3 * y * y == (m - n) * (m - n)) /\
  (a <> b -> v == (2 # 9) /\ x * x + 3 * y * y == m * m + m * n + n * n).
Proof.
  intros [] [] m n; cbv zeta; unfold down_by, directions_under, one_on; split; intros H; try congruence;
    split; formulas; ring.
Qed.

(** The components of a step, which [numbers] evaluates. *)
Definition ahead_x (sigma : sign) (d : direction) : Q := (down_by sigma d).(along_x).
Definition ahead_y (sigma : sign) (d : direction) : Q := (down_by sigma d).(along_y).

Ltac numbers :=
  repeat match goal with
         | |- context [ahead_x ?s ?d] => let v := eval vm_compute in (ahead_x s d) in change (ahead_x s d) with v
         | |- context [ahead_y ?s ?d] => let v := eval vm_compute in (ahead_y s d) in change (ahead_y s d) with v
         end.

(** ** Whole piles

    Any stacking below any top layer, under any weights w in mg. The floor is the layer below L layers (Virtual.v).
    Forces are in f0 = mg/3. *)
Section Pile.
Variable top : list site.
Variable step : nat -> sign.

(** The position of a sphere, relative to site (0, 0) of the top layer. *)
Definition place (ahead : sign -> direction -> Q) (k : nat) (p : site) : Q :=
  q (fst p) * (ahead Plus Beta - ahead Plus Alpha)
  + q (snd p) * (ahead Plus Gamma - ahead Plus Alpha)
  + total k (fun m => ahead (step m) Alpha).

Notation x := (place ahead_x).
Notation y := (place ahead_y).
Definition from_axis (k : nat) (p : site) : Q := x k p * x k p + 3 * y k p * y k p.

Ltac places :=
  unfold Z.sub; rewrite ?inject_Z_plus, ?inject_Z_opp;
  repeat match goal with |- context [q ?n] => change (q n) with (n # 1) end.

(** Contacts lead from position to position. *)
Lemma place_of_support : forall k p d,
  x (S k) (support (step k) p d) == x k p + ahead_x (step k) d /\
  y (S k) (support (step k) p d) == y k p + ahead_y (step k) d.
Proof.
  intros k [i j] d. unfold place, support. cbn [total].
  destruct (step k), d; cbn [descent fst snd]; rewrite ?inject_Z_plus; numbers; places; split; ring.
Qed.

Lemma place_of_next : forall k a p,
  x k (next a p) == x k p + (ahead_x Plus (to a) - ahead_x Plus (from a)) /\
  y k (next a p) == y k p + (ahead_y Plus (to a) - ahead_y Plus (from a)).
Proof.
  intros k a [i j]. unfold place, next, support, above_in.
  destruct a; cbn [descent from to fst snd]; places; rewrite ?inject_Z_plus, ?inject_Z_opp; numbers; places; split; ring.
Qed.

Variable f : nat -> Z -> Z -> three Q.
Variable X : nat -> axis -> Z -> Z -> Q.
Variable w : nat -> Z -> Z -> Q.
Variable L : nat.
Hypothesis in_equilibrium : equilibrium top step f X w L.

(** The load on a bottom sphere. *)
Definition borne (p : site) : Q := sum (arriving top step f L (fst p) (snd p)).

(** A field with zero drop at all contacts, equal to F on the floor. *)
Lemma field_arrives : forall phi F,
  (forall k i j d, drop step phi k i j d == 0) ->
  (forall p, phi L (fst p) (snd p) =3= each (F p)) ->
  over (spheres top step L) (fun p => borne p * F p) + over_spheres top step L (horizontal_work top step X phi)
  == over_spheres top step L (work_of_weight w phi).
Proof.
  intros phi F D P. rewrite <- (work_on_the_floor top step f X w phi L in_equilibrium).
  assert (S : over_spheres top step L (sloping_work step f phi) == 0).
  { rewrite <- (total_of_nothing L). apply total_of_same. intros k _. rewrite <- (over_of_nothing _ (spheres top step k)).
    apply over_of_same. intros [i j] _. cbn [fst snd]. unfold sloping_work, dot. formulas. rewrite !D. ring. }
  assert (A : arriving_work top step f phi L == over (spheres top step L) (fun p => borne p * F p)).
  { apply over_of_same. intros p _. unfold felt, borne, dot. destruct (P p) as (a & b & c).
    destruct (step_above step L), (step L); unfold transferred; formulas;
      cbn [each alpha beta gamma] in a, b, c; rewrite a, b, c; ring. }
  rewrite S, A. ring.
Qed.

(** The height of a layer above the floor. *)
Notation height k := (n_of L - n_of k).

(** The field of the first moment: the position where the line of the contact meets the floor. *)
Definition straight_down (ahead : sign -> direction -> Q) (k : nat) (i j : Z) : three Q :=
  map (fun d => place ahead k (i, j) + height k * ahead (step k) d) (Three Alpha Beta Gamma).

Lemma nothing_lowers_places : forall k i j d,
  drop step (straight_down ahead_x) k i j d == 0 /\ drop step (straight_down ahead_y) k i j d == 0.
Proof.
  intros k i j d. unfold drop, felt, straight_down. rewrite <- surjective_pairing. cbn [step_above].
  destruct (place_of_support k (i, j) d) as [PX PY].
  set (x' := x (S k) _) in *. set (y' := y (S k) _) in *. assert (N := n_of_S k).
  destruct (step k), (step (S k)), d; unfold transferred; formulas; split; rewrite N, ?PX, ?PY; numbers; ring.
Qed.

(** First moment: the sum of F_z r over the floor equals that of mg r over all spheres, for all horizontal forces. *)
Theorem first_moment_arrives :
  over (spheres top step L) (fun p => borne p * x L p) == over_spheres top step L (fun k i j => 3 * w k i j * x k (i, j)) /\
  over (spheres top step L) (fun p => borne p * y L p) == over_spheres top step L (fun k i j => 3 * w k i j * y k (i, j)).
Proof.
  assert (H : forall ahead, ahead = ahead_x \/ ahead = ahead_y ->
    over_spheres top step L (horizontal_work top step X (straight_down ahead)) == 0).
  { intros ahead C. rewrite <- (total_of_nothing L). apply total_of_same. intros k _.
    rewrite <- (over_of_nothing _ (spheres top step k)). apply over_of_same. intros [i j] _. cbn [fst snd].
    assert (A : forall a, of_axis top step X (straight_down ahead) k a i j == 0).
    { intros a. unfold of_axis, squeeze, straight_down. destruct (touches top step k a i j); [|reflexivity].
      destruct a, (step k); cbn [from to]; formulas; ring. }
    unfold horizontal_work. rewrite !A. ring. }
  assert (W : forall ahead, ahead = ahead_x \/ ahead = ahead_y ->
    over_spheres top step L (work_of_weight w (straight_down ahead))
    == over_spheres top step L (fun k i j => 3 * w k i j * place ahead k (i, j))).
  { intros ahead C. apply total_of_same. intros k _. apply over_of_same. intros [i j] _. cbn [fst snd].
    unfold work_of_weight, straight_down. destruct C; subst ahead; destruct (step k); formulas; numbers; ring. }
  assert (A : forall ahead, ahead = ahead_x \/ ahead = ahead_y ->
    over (spheres top step L) (fun p => borne p * place ahead L p)
    == over_spheres top step L (fun k i j => 3 * w k i j * place ahead k (i, j))).
  { intros ahead C.
    assert (N : forall k i j d, drop step (straight_down ahead) k i j d == 0).
    { intros k i j d. destruct (nothing_lowers_places k i j d) as [NX NY]. destruct C; subst ahead; [exact NX | exact NY]. }
    assert (F : forall p, straight_down ahead L (fst p) (snd p) =3= each (place ahead L p))
      by (intros [i j]; unfold straight_down; cbn [fst snd]; repeat split; formulas; ring).
    assert (B := field_arrives _ _ N F). rewrite (H ahead C), (W ahead C) in B. rewrite <- B. ring. }
  split; apply A; [left | right]; reflexivity.
Qed.

(** The field of the second moment. *)
Definition spreading_down (k : nat) (i j : Z) : three Q :=
  map (fun d => from_axis k (i, j)
      + 2 * height k * (x k (i, j) * ahead_x (step k) d + 3 * y k (i, j) * ahead_y (step k) d)
      + height k * height k) (Three Alpha Beta Gamma).

Lemma nothing_lowers_squares : forall k i j d, drop step spreading_down k i j d == 0.
Proof.
  intros k i j d. unfold drop, felt, spreading_down, from_axis. rewrite <- surjective_pairing. cbn [step_above].
  destruct (place_of_support k (i, j) d) as [PX PY].
  set (x' := x (S k) _) in *. set (y' := y (S k) _) in *. assert (N := n_of_S k).
  destruct (step k), (step (S k)), d; unfold transferred; formulas; rewrite N, PX, PY; numbers; ring.
Qed.

(** Second moment, in units of (2R sin theta)^2: the sum of F_z r^2 over the floor equals that of mg (r^2 + H^2) over
    all spheres plus 6 H times the horizontal forces, with H the height above the floor in layers. Horizontal forces
    spread the load. *)
Theorem second_moment_arrives :
  over (spheres top step L) (fun p => borne p * from_axis L p)
  == over_spheres top step L (fun k i j => 3 * w k i j * (from_axis k (i, j) + height k * height k))
     + over_spheres top step L (fun k i j => 6 * height k
         * (by_next top step X k i j AB + by_next top step X k i j AG + by_next top step X k i j GB)).
Proof.
  assert (H : over_spheres top step L (fun k i j => 6 * height k
      * (by_next top step X k i j AB + by_next top step X k i j AG + by_next top step X k i j GB))
    == - over_spheres top step L (horizontal_work top step X spreading_down)).
  { rewrite <- over_spheres_of_opposite. apply total_of_same. intros k _. apply over_of_same. intros [i j] _. cbn [fst snd].
    assert (A : forall a, of_axis top step X spreading_down k a i j == - (6 * height k * by_next top step X k i j a)).
    { intros a. unfold of_axis, by_next, squeeze, spreading_down, from_axis.
      destruct (touches top step k a i j); [|ring]. rewrite <- surjective_pairing.
      destruct (place_of_next k a (i, j)) as [PX PY].
      set (x' := x k (next a (i, j))) in *. set (y' := y k (next a (i, j))) in *.
      destruct a, (step k); cbn [from to] in *; formulas; rewrite PX, PY; numbers; ring. }
    unfold horizontal_work. rewrite !A. ring. }
  assert (W : over_spheres top step L (work_of_weight w spreading_down)
    == over_spheres top step L (fun k i j => 3 * w k i j * (from_axis k (i, j) + height k * height k))).
  { apply total_of_same. intros k _. apply over_of_same. intros [i j] _. cbn [fst snd].
    unfold work_of_weight, spreading_down. destruct (step k); formulas; numbers; ring. }
  assert (F : forall p, spreading_down L (fst p) (snd p) =3= each (from_axis L p))
    by (intros [i j]; unfold spreading_down; cbn [fst snd]; repeat split; formulas; ring).
  assert (B := field_arrives _ _ nothing_lowers_squares F). rewrite H, <- W, <- B. ring.
Qed.

End Pile.

(** ** Squares, without horizontal contacts *)

Definition none (k : nat) (a : axis) (i j : Z) : Q := 0.

(** For any weights, forces that balance the pile exist. *)
Fixpoint forces_under (top : list site) (step : nat -> sign) (w : nat -> Z -> Z -> Q) (k : nat) : Z -> Z -> three Q :=
  match k with
  | O => fun i j => by_line transmitted (transferred (step O) (step O) (each 0)) (each (w O i j))
  | S m => fun i j =>
    let from d := let (a, b) := above_in (step m) d i j in
      if member (layer top step m) a b then on d (forces_under top step w m a b) else 0 in
    by_line transmitted (transferred (step m) (step (S m)) (Three (from Alpha) (from Beta) (from Gamma))) (each (w (S m) i j))
  end.

Theorem forces_under_weights : forall top step w L, equilibrium top step (forces_under top step w) none w L.
Proof.
  intros top step w L k i j _ _. unfold in_balance_beside.
  assert (B : unbalanced (forces_under top step w k i j) (directions_under (1 # 2) (step k))
    (arriving top step (forces_under top step w) k i j) (directions_under (1 # 2) (step_above step k))
    (force (w k i j) (weight (increments (1 # 2)))) =v= nothing)
    by (apply newton_in_any_stacking; destruct k; reflexivity).
  assert (N : forall a, by_next top step none k i j a = 0)
    by (intros a; unfold by_next, none; destruct (touches top step k a i j); reflexivity).
  assert (P : forall a, by_last top step none k i j a = 0)
    by (intros a; unfold by_last, none; destruct (holds (layer top step k) (last a (i, j))); reflexivity).
  unfold six, push. cbn [ab ag gb]. rewrite !N, !P. clear N P.
  set (u := unbalanced _ _ _ _ _) in *. destruct B as (A & B & C). clearbody u.
  unfold combination, plus_vector, plus_three, minus_three, one_on.
  repeat split; formulas; cbn [along_x along_y along_z nothing] in A, B, C; rewrite ?A, ?B, ?C; ring.
Qed.

Section Squares.
Variable top : list site.
Variable step : nat -> sign.
Variable f : nat -> Z -> Z -> three Q.
Variable w : nat -> Z -> Z -> Q.
Variable L : nat.
Hypothesis in_equilibrium : equilibrium top step f none w L.

Notation received := (arriving top step f).

Lemma transmits_beside_none : forall k i j, (k < L)%nat -> In (i, j) (layer top step k) ->
  f k i j =3= by_line transmitted (transferred (step_above step k) (step k) (received k i j)) (each (w k i j)).
Proof.
  intros k i j Hk Hi. assert (B := in_equilibrium k i j Hk Hi). apply newton_beside in B. cbv zeta in B. rewrite B.
  assert (N : forall a, by_next top step none k i j a = 0)
    by (intros a; unfold by_next, none; destruct (touches top step k a i j); reflexivity).
  assert (P : forall a, by_last top step none k i j a = 0)
    by (intros a; unfold by_last, none; destruct (holds (layer top step k) (last a (i, j))); reflexivity).
  unfold six, pushed_by, plus_three. cbn [ab ag gb]. rewrite !N, !P.
  destruct (step k); formulas; repeat split; ring.
Qed.

(** The force received equals the force transmitted from above. *)
Lemma squares_are_given : forall k,
  over (spheres top step (S k)) (fun p => dot (received (S k) (fst p) (snd p)) (received (S k) (fst p) (snd p)))
  == over (spheres top step k) (fun p => dot (f k (fst p) (snd p)) (f k (fst p) (snd p))).
Proof.
  intros k.
  (* Virtual works in a field that weights the forces received. *)
  pose (phi := fun n i j => transferred (step_above step n) (step n) (received n i j)).
  assert (T : forall n p, felt step phi n p =3= received n (fst p) (snd p)).
  { intros n p. unfold felt, phi. destruct (received n (fst p) (snd p)) as [a b c].
    destruct (step_above step n), (step n); unfold transferred; by_components. }
  assert (A : over (spheres top step (S k)) (fun p => dot (received (S k) (fst p) (snd p)) (received (S k) (fst p) (snd p)))
    == arriving_work top step f phi (S k)).
  { apply over_of_same. intros p _. apply dot_of_same. symmetry. apply T. }
  rewrite A, arriving_by_lines, !arriving_is_given, <- !over_of_sum. apply over_of_same. intros [i j] I. cbn [fst snd].
  apply spheres_are in I. unfold dot.
  assert (R : forall d, on d (felt step phi (S k) (support (step k) (i, j) d)) == on d (f k i j)).
  { intros d. destruct (T (S k) (support (step k) (i, j) d)) as (a & b & c).
    transitivity (on d (received (S k) (fst (support (step k) (i, j) d)) (snd (support (step k) (i, j) d))));
      [destruct d; cbn [on]; assumption|]. clear a b c.
    assert (U : above_in (step k) d (fst (support (step k) (i, j) d)) (snd (support (step k) (i, j) d)) = (i, j))
      by (symmetry; apply support_and_above; reflexivity).
    destruct d; cbn [on received arriving alpha beta gamma]; rewrite U;
      (destruct (member (layer top step k) i j) eqn:M; [reflexivity | apply member_iff in I; congruence]). }
  rewrite !R. formulas. ring.
Qed.

(** In any stacking under any weights: the squares of all forces below k layers sum, over spheres, to twice the
    weight times the received force plus three times the weight squared. *)
Theorem squares_in_any_stacking : forall k, (k <= L)%nat ->
  over (spheres top step k) (fun p => dot (received k (fst p) (snd p)) (received k (fst p) (snd p)))
  == over_spheres top step k (fun n i j => 2 * w n i j * sum (received n i j) + 3 * w n i j * w n i j).
Proof.
  induction k as [|k IH]; intros Hk.
  - unfold over_spheres. cbn [total]. rewrite <- (over_of_nothing _ (spheres top step 0)). apply over_of_same. intros p _.
    unfold dot. cbn [arriving]. formulas. ring.
  - rewrite squares_are_given. unfold over_spheres in *. cbn [total]. rewrite <- IH, <- over_of_sum by lia.
    apply over_of_same. intros [i j] I. cbn [fst snd]. apply spheres_are in I.
    assert (P := transmits_beside_none k i j Hk I).
    destruct (sums_and_squares (step_above step k) (step k) (received k i j) (w k i j)) as (_ & S & _).
    rewrite Qplus_assoc, <- S. destruct P as (a & b & c). unfold dot. formulas. formulas_in a. formulas_in b. formulas_in c.
    rewrite a, b, c. reflexivity.
Qed.

End Squares.

Lemma over_of_ones : forall A (l : list A), over l (fun _ => 1) == n_of (length l).
Proof. intros A l. induction l as [|a l IH]; cbn [over length]; [reflexivity|]. rewrite IH, n_of_S. ring. Qed.

(** Spheres of weight mg: below k layers the forces sum to 3 W. Their squares sum to the sum of 3 n_j + 6 W_(j-1), for n_j
    spheres in layer j and W_(j-1) spheres above it. *)
Theorem sums_and_squares_of_piles : forall top step f L,
  equilibrium top step f none (fun _ _ _ => 1) L ->
  let received p := arriving top step f L (fst p) (snd p) in
  let n j := n_of (length (spheres top step j)) in
  over (spheres top step L) (fun p => sum (received p)) == 3 * total L n /\
  over (spheres top step L) (fun p => dot (received p) (received p)) == total L (fun j => 3 * n j + 6 * total j n).
Proof.
  intros top step f L E. cbv zeta.
  assert (W : forall k, (k <= L)%nat -> over (spheres top step k) (fun p => sum (arriving top step f k (fst p) (snd p)))
    == 3 * total k (fun j => n_of (length (spheres top step j)))).
  { intros k Hk. rewrite (the_weight_arrives_beside top step f none (fun _ _ _ => 1) k)
      by (intros m i j Hm; apply E; lia).
    unfold over_spheres. rewrite <- total_of_multiple. apply total_of_same. intros j _.
    rewrite <- over_of_ones, <- over_of_multiple. apply over_of_same. intros; ring. }
  split; [apply W; lia|]. rewrite (squares_in_any_stacking top step f (fun _ _ _ => 1) L E) by lia.
  apply total_of_same. intros j Hj.
  transitivity (2 * over (spheres top step j) (fun p => sum (arriving top step f j (fst p) (snd p)))
    + 3 * over (spheres top step j) (fun _ => 1)).
  - rewrite <- !over_of_multiple, <- over_of_sum. apply over_of_same. intros; ring.
  - rewrite W, over_of_ones by lia. ring.
Qed.

(** A unit load on one sphere, without weights. *)
Definition unit_load (k : nat) (i j : Z) : Q := match k with O => 1 # 3 | S _ => 0 end.

(** v is the force received on a line of a sphere. In any stacking its sum is 1, its squares sum to 1/3, v r to zero,
    and v r^2 to n^2 rho^2. *)
Theorem point_load : forall step f n,
  let top := [(0, 0)%Z] in
  equilibrium top step f none unit_load (S n) ->
  let v p := arriving top step f (S n) (fst p) (snd p) in
  let below F := over (spheres top step (S n)) F in
  below (fun p => sum (v p)) == 1 /\ below (fun p => dot (v p) (v p)) == 1 # 3 /\
  below (fun p => sum (v p) * place step ahead_x (S n) p) == 0 /\
  below (fun p => sum (v p) * place step ahead_y (S n) p) == 0 /\
  below (fun p => sum (v p) * from_axis step (S n) p) == n_of (S n) * n_of (S n).
Proof.
  intros step f n top E v below.
  (* In sums over all spheres only the loaded one remains. *)
  assert (O : forall G, (forall k i j, G (S k) i j == 0) -> over_spheres top step (S n) G == G 0%nat 0%Z 0%Z).
  { intros G HG. unfold over_spheres. induction n as [|m IH].
    - cbn [total]. change (spheres top step 0) with [(0, 0)%Z]. cbn [over fst snd]. ring.
    - change (total (S (S m)) ?F) with (total (S m) F + F (S m)). cbv beta. rewrite IH.
      + rewrite (over_of_same _ _ _ (fun _ => 0)) by (intros; apply HG). rewrite over_of_nothing. ring.
      + intros k i j Hk. apply E. lia. }
  destruct (first_moment_arrives top step f none unit_load (S n) E) as [X Y].
  assert (R := second_moment_arrives top step f none unit_load (S n) E).
  assert (P : over_spheres top step (S n) (fun k i j => 6 * (n_of (S n) - n_of k)
      * (by_next top step none k i j AB + by_next top step none k i j AG + by_next top step none k i j GB)) == 0).
  { rewrite <- (total_of_nothing (S n)). apply total_of_same. intros k _.
    rewrite <- (over_of_nothing _ (spheres top step k)). apply over_of_same. intros [i j] _. cbn [fst snd].
    unfold by_next, none.
    destruct (touches top step k AB i j), (touches top step k AG i j), (touches top step k GB i j); ring. }
  rewrite P in R. unfold below, v. repeat split.
  - etransitivity; [exact (the_weight_arrives_beside top step f none unit_load (S n) E)|].
    rewrite O; [reflexivity | intros; unfold unit_load; ring].
  - etransitivity; [exact (squares_in_any_stacking top step f unit_load (S n) E (S n) (le_n _))|].
    rewrite O; [vm_compute; reflexivity | intros; unfold unit_load; ring].
  - etransitivity; [exact X|]. rewrite O; [vm_compute; reflexivity | intros; unfold unit_load; ring].
  - etransitivity; [exact Y|]. rewrite O; [vm_compute; reflexivity | intros; unfold unit_load; ring].
  - etransitivity; [exact R|]. rewrite O; [|intros; unfold unit_load; ring].
    unfold unit_load, from_axis, place. cbn [total fst snd]. rewrite n_of_0. numbers. ring.
Qed.

(** ** By contact *)

(** A contact of the response: the position of its lower sphere, its line, and its force. *)
Record contact := Contact { at_x : Q; at_y : Q; line : direction; bears : Q }.

(** The contribution of one contact to those below its sphere: T, distributed to three contacts. *)
Definition spread (from to : sign) (c : contact) : list contact :=
  let f := transferred from to (map (Qmult c.(bears)) (one_on c.(line))) in
  List.map (fun d => Contact (c.(at_x) + (down_by to d).(along_x)) (c.(at_y) + (down_by to d).(along_y)) d (on d f))
    [Alpha; Beta; Gamma].

(** Three contacts carry the load, one third each. *)
Definition first (sigma : sign) : list contact :=
  List.map (fun d => Contact (down_by sigma d).(along_x) (down_by sigma d).(along_y) d
      (on d (increments (1 # 2)) / weight (increments (1 # 2))))
    [Alpha; Beta; Gamma].

Fixpoint power (x : Q) (n : nat) : Q := match n with O => 1 | S m => power x m * x end.

Section Stacking.
Variable step : nat -> sign.

(** The contacts n+1 steps below the load. Contacts that reach the same line of the same sphere are listed
    separately. This is valid because transfers and all sums below are linear. *)
Fixpoint response (n : nat) : list contact :=
  match n with
  | O => first (step 0)
  | S m => flat_map (spread (step m) (step (S m))) (response m)
  end.

Fixpoint over (F : contact -> Q) (l : list contact) : Q :=
  match l with
  | [] => 0
  | c :: l => F c + over F l
  end.

Lemma over_app : forall F l m, over F (l ++ m) == over F l + over F m.
Proof. intros F l m. induction l as [|c l IH]; simpl; [ring|]. rewrite IH. ring. Qed.

Lemma over_spread : forall F G from to l,
  (forall c, over F (spread from to c) == G c) -> over F (flat_map (spread from to) l) == over G l.
Proof.
  intros F G from to l H. induction l as [|c l IH]; simpl; [reflexivity|].
  change (over F (spread from to c ++ flat_map (spread from to) l) == G c + over G l).
  rewrite over_app, H, IH. reflexivity.
Qed.

Lemma over_sum : forall F G l, over (fun c => F c + G c) l == over F l + over G l.
Proof. intros F G l. induction l as [|c l IH]; simpl; [ring|]. rewrite IH. ring. Qed.

Lemma over_multiple : forall x F l, over (fun c => x * F c) l == x * over F l.
Proof. intros x F l. induction l as [|c l IH]; simpl; [ring|]. rewrite IH. ring. Qed.

(** The step of a contact of the layer under sign sigma. *)
Definition dx (sigma : sign) (c : contact) : Q := (down_by sigma c.(line)).(along_x).
Definition dy (sigma : sign) (c : contact) : Q := (down_by sigma c.(line)).(along_y).

(** Products of positions in the complex plane, x + iy sqrt(3): the real part of z times the conjugate of d, and r^2. *)
Definition along (sigma : sign) (c : contact) : Q := c.(at_x) * dx sigma c + 3 * c.(at_y) * dy sigma c.
Definition square (c : contact) : Q := c.(at_x) * c.(at_x) + 3 * c.(at_y) * c.(at_y).

(** The real part of z^3 E', with E the cube of the step along alpha under + and E' its conjugate: it equals r^3 cos
    3phi. And the real part of z'^2 d' E. *)
Definition cube_x (x y : Q) : Q := x * x * x - 9 * x * y * y.
Definition cube_y (x y : Q) : Q := 3 * x * x * y - 3 * y * y * y.
Definition e_x : Q := cube_x (down_by Plus Alpha).(along_x) (down_by Plus Alpha).(along_y).
Definition e_y : Q := cube_y (down_by Plus Alpha).(along_x) (down_by Plus Alpha).(along_y).

Definition third (c : contact) : Q :=
  cube_x c.(at_x) c.(at_y) * e_x + 3 * cube_y c.(at_x) c.(at_y) * e_y.

Definition across (sigma : sign) (c : contact) : Q :=
  let u := c.(at_x) * c.(at_x) - 3 * c.(at_y) * c.(at_y) in
  let v := 2 * c.(at_x) * c.(at_y) in
  (u * dx sigma c - 3 * v * dy sigma c) * e_x + 3 * (u * dy sigma c + v * dx sigma c) * e_y.

Definition load (F : contact -> Q) (c : contact) : Q := c.(bears) * F c.

(** Extends [numbers] to moments with E. *)
Ltac numbers ::=
  repeat match goal with
         | |- context [along_x (down_by ?s ?d)] =>
           let v := eval vm_compute in (along_x (down_by s d)) in change (along_x (down_by s d)) with v
         | |- context [along_y (down_by ?s ?d)] =>
           let v := eval vm_compute in (along_y (down_by s d)) in change (along_y (down_by s d)) with v
         | |- context [e_x] => let v := eval vm_compute in e_x in change e_x with v
         | |- context [e_y] => let v := eval vm_compute in e_y in change e_y with v
         end.

Ltac opened :=
  unfold load, third, across, along, square, cube_x, cube_y, dx, dy, spread, transferred, one_on;
  cbn [List.map over at_x at_y line bears]; numbers; formulas.

Ltac by_signs := intros [] [] [x y [] v]; unfold times; opened; ring.

(** The contribution to each moment of the contacts below one contact, for all pairs of signs. *)
Lemma load_step : forall from to c, over (load (fun _ => 1)) (spread from to c) == load (fun _ => 1) c.
Proof. by_signs. Qed.

Lemma dx_step : forall from to c, over (load (dx to)) (spread from to c) == load (dx from) c.
Proof. by_signs. Qed.

Lemma dy_step : forall from to c, over (load (dy to)) (spread from to c) == load (dy from) c.
Proof. by_signs. Qed.

Lemma x_step : forall from to c,
  over (load at_x) (spread from to c) == load at_x c + load (dx from) c.
Proof. by_signs. Qed.

Lemma y_step : forall from to c,
  over (load at_y) (spread from to c) == load at_y c + load (dy from) c.
Proof. by_signs. Qed.

Lemma along_step : forall from to c,
  over (load (along to)) (spread from to c) == load (along from) c + load (fun _ => 1) c.
Proof. by_signs. Qed.

Lemma square_step : forall from to c,
  over (load square) (spread from to c) == load square c + (2 * load (along from) c + load (fun _ => 1) c).
Proof. by_signs. Qed.

Lemma across_step : forall from to c,
  over (load (across to)) (spread from to c)
  == load (across from) c + times to 1 * (2 * load (along from) c + load (fun _ => 1) c).
Proof. by_signs. Qed.

Lemma third_step : forall from to c,
  over (load third) (spread from to c)
  == load third c + (3 * load (across from) c + times to 1 * (3 * load (along from) c + load (fun _ => 1) c)).
Proof. by_signs. Qed.

(** ** A load at depth n+1, in any stacking *)

Ltac at_first :=
  cbn [total]; unfold response, first, times, dx, dy, along, across; destruct (step 0); vm_compute; reflexivity.

Ltac next lemma := cbn [response]; rewrite (over_spread _ _ _ _ _ (lemma _ _));
  rewrite ?over_sum, ?over_multiple, ?over_sum, ?over_multiple.

(** The load is conserved: the sum of v is 1. *)
Theorem load_is_kept : forall n, over (load (fun _ => 1)) (response n) == 1.
Proof.
  induction n as [|n IH]; [at_first|]. next load_step. exact IH.
Qed.

(** Few faults: the number of sign changes above these contacts. *)
Definition changed (from to : sign) : nat :=
  match from, to with
  | Plus, Plus | Minus, Minus => 0
  | _, _ => 1
  end.

Fixpoint changes (n : nat) : nat :=
  match n with
  | O => 0
  | S m => changed (step m) (step (S m)) + changes m
  end.

Definition not_nothing (c : contact) : Q := if Qeq_dec c.(bears) 0 then 0 else 1.

Lemma parts_of : forall from to v l d,
  on d (transferred from to (map (Qmult v) (one_on l))) == v * on d (transferred from to (one_on l)).
Proof. intros [] [] v [] []; unfold transferred, one_on; formulas; ring. Qed.

Lemma not_nothing_step : forall from to c,
  over not_nothing (spread from to c) == power 3 (changed from to) * not_nothing c.
Proof.
  intros from to [x y l v]. unfold spread, not_nothing. cbn [List.map over at_x at_y line bears].
  assert (A := parts_of from to v l Alpha). assert (B := parts_of from to v l Beta). assert (G := parts_of from to v l Gamma).
  set (a := on Alpha (transferred _ _ _)) in A |- *. set (b := on Beta (transferred _ _ _)) in B |- *.
  set (g := on Gamma (transferred _ _ _)) in G |- *. clearbody a b g.
  destruct from, to, l; cbn [changed power];
    repeat match goal with
           | H : _ == v * on ?d ?t |- _ => let n := eval vm_compute in (on d t) in change (on d t) with n in H
           end;
    destruct (Qeq_dec v 0), (Qeq_dec a 0), (Qeq_dec b 0), (Qeq_dec g 0); first [reflexivity | exfalso; lra].
Qed.

Lemma absolute_step : forall from to c,
  over (fun c => Qabs c.(bears)) (spread from to c) == power (5 # 3) (changed from to) * Qabs c.(bears).
Proof.
  intros from to [x y l v]. unfold spread. cbn [List.map over at_x at_y line bears]. rewrite !parts_of, !Qabs_Qmult.
  destruct from, to, l; cbn [changed power];
    repeat match goal with
           | |- context [Qabs (on ?d ?t)] => let n := eval vm_compute in (Qabs (on d t)) in change (Qabs (on d t)) with n
           end; ring.
Qed.

Lemma squares_step : forall from to c,
  over (fun c => c.(bears) * c.(bears)) (spread from to c) == c.(bears) * c.(bears).
Proof. intros [] [] [x y [] v]; unfold spread, transferred, one_on; cbn [List.map over bears line]; formulas; ring. Qed.

(** d sign changes turn the load into 3^(d+1) forces. Their sum is 1 ([load_is_kept]), their squares sum to 1/3, and
    their absolute values to (5/3)^d. *)
Theorem few_faults : forall n,
  over not_nothing (response n) == power 3 (S (changes n)) /\
  over (fun c => c.(bears) * c.(bears)) (response n) == 1 # 3 /\
  over (fun c => Qabs c.(bears)) (response n) == power (5 # 3) (changes n).
Proof.
  assert (P : forall x m n, power x (m + n) == power x m * power x n)
    by (induction m as [|m IH]; intros n; cbn [Nat.add power]; [ring | rewrite IH; ring]).
  induction n as [|n (N & S & A)]; [repeat split; unfold response, first; destruct (step 0); vm_compute; reflexivity|].
  cbn [response changes]. split; [|split].
  - rewrite (over_spread _ _ _ _ _ (not_nothing_step _ _)), over_multiple, N. cbn [power]. rewrite P. ring.
  - rewrite (over_spread _ _ _ _ _ (squares_step _ _)). exact S.
  - rewrite (over_spread _ _ _ _ _ (absolute_step _ _)), over_multiple, A, P. reflexivity.
Qed.

(** The horizontal forces cancel: the sum of v d is 0. *)
Lemma no_side : forall n, over (load (dx (step n))) (response n) == 0 /\ over (load (dy (step n))) (response n) == 0.
Proof.
  induction n as [|n [X Y]]; [split; at_first|]. split; [next dx_step; exact X | next dy_step; exact Y].
Qed.

(** The response stays centred below the load: the sum of v r is 0. *)
Theorem response_is_centred : forall n, over (load at_x) (response n) == 0 /\ over (load at_y) (response n) == 0.
Proof.
  induction n as [|n [X Y]]; [split; at_first|]. destruct (no_side n) as [DX DY].
  split; [next x_step; rewrite X, DX | next y_step; rewrite Y, DY]; ring.
Qed.

Lemma along_is : forall n, over (load (along (step n))) (response n) == n_of (S n).
Proof.
  induction n as [|n IH]; [at_first|]. next along_step. rewrite IH, load_is_kept, (n_of_S (S n)). reflexivity.
Qed.

(** The sum of v r^2 is n^2 rho^2 at depth n, for every stacking. *)
Theorem second_moment_of_response : forall n, over (load square) (response n) == n_of (S n) * n_of (S n).
Proof.
  induction n as [|n IH]; [at_first|]. next square_step. rewrite IH, along_is, load_is_kept, (n_of_S (S n)). ring.
Qed.

(** ** The third moment: the orientation of a response *)

Lemma across_is : forall n,
  over (load (across (step n))) (response n) == total (S n) (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1)).
Proof.
  induction n as [|n IH]; [at_first|].
  next across_step. rewrite IH, along_is, load_is_kept.
  change (total (S (S n)) ?f) with (total (S n) f + f (S n)). cbv beta. rewrite (n_of_S n). ring.
Qed.

(** The sum of v r^3 cos 3phi at depth n+1 is the sum over the steps of sigma_s times [third_moment]. *)
Theorem third_moment_of_response : forall n,
  over (load third) (response n)
  == total (S n) (fun s => times (step s) 1 * third_moment (n_of (S n)) (n_of s + 1)).
Proof.
  induction n as [|n IH]; [at_first|].
  next third_step. rewrite IH, along_is, across_is, load_is_kept.
  change (total (S (S n)) (fun s => times (step s) 1 * third_moment (n_of (S (S n))) (n_of s + 1)))
    with (total (S n) (fun s => times (step s) 1 * third_moment (n_of (S (S n))) (n_of s + 1))
          + times (step (S n)) 1 * third_moment (n_of (S (S n))) (n_of (S n) + 1)).
  rewrite (total_of_same (S n) (fun s => times (step s) 1 * third_moment (n_of (S (S n))) (n_of s + 1))
    (fun s => times (step s) 1 * third_moment (n_of (S n)) (n_of s + 1)
              + 3 * (times (step s) 1 * (2 * (n_of s + 1) - 1)))).
  - rewrite total_of_sum, total_of_multiple. formulas. rewrite (n_of_S (S n)). ring.
  - intros s _. formulas. rewrite (n_of_S (S n)). ring.
Qed.

(** ** The fourth moment: the spread of a response *)

Definition fourth (c : contact) : Q := square c * square c.
Definition outward (sigma : sign) (c : contact) : Q := square c * along sigma c.

Ltac opened ::=
  unfold load, fourth, outward, third, across, along, square, cube_x, cube_y, dx, dy, spread, transferred, one_on;
  cbn [List.map over at_x at_y line bears]; numbers; formulas.

Lemma outward_step : forall from to c,
  over (load (outward to)) (spread from to c)
  == load (outward from) c + (times to 1 * load (across from) c + (2 * load square c + (3 * load (along from) c
     + load (fun _ => 1) c))).
Proof. by_signs. Qed.

Lemma fourth_step : forall from to c,
  over (load fourth) (spread from to c)
  == load fourth c + (load (fun _ => 1) c + (4 * load square c + (4 * load (outward from) c + (4 * load (along from) c
     + 2 * times to 1 * load (across from) c)))).
Proof. by_signs. Qed.

(** The contributions of pairs of signs to the outward moment and to the fourth moment. *)
Definition pairs_below (n : nat) (weight : Q -> Q -> Q) : Q :=
  total n (fun t => times (step t) 1 * total t (fun s => times (step s) 1 * weight (n_of s + 1) (n_of t + 1))).

Lemma outward_is : forall n,
  over (load (outward (step n))) (response n)
  == n_of (S n) * (n_of (S n) + 1) * (2 * n_of (S n) + 1) * (1 # 3) - n_of (S n) * (n_of (S n) + 1) * (1 # 2)
     + pairs_below (S n) (fun s _ => 2 * s - 1).
Proof.
  induction n as [|n IH]; [unfold pairs_below, outward; at_first|].
  next outward_step. rewrite IH, across_is, second_moment_of_response, along_is, load_is_kept.
  unfold pairs_below.
  change (total (S (S n)) (fun t => times (step t) 1 * total t (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1))))
    with (total (S n) (fun t => times (step t) 1 * total t (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1)))
          + times (step (S n)) 1 * total (S n) (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1))).
  rewrite (n_of_S (S n)). ring.
Qed.

Lemma pairs_of_sum : forall n F G H c,
  (forall s t, F s t == G s t + c * H s t) -> pairs_below n F == pairs_below n G + c * pairs_below n H.
Proof.
  intros n F G H c E. unfold pairs_below.
  rewrite <- total_of_multiple, <- total_of_sum. apply total_of_same. intros t _.
  rewrite (total_of_same t (fun s => times (step s) 1 * F (n_of s + 1) (n_of t + 1))
    (fun s => times (step s) 1 * G (n_of s + 1) (n_of t + 1) + c * (times (step s) 1 * H (n_of s + 1) (n_of t + 1)))).
  - rewrite total_of_sum, total_of_multiple. ring.
  - intros s _. rewrite E. ring.
Qed.

(** The sum of v r^4 at depth n+1 is [fourth_moment] plus [fourth_moment_of_pair] times the product of the signs of
    each two steps. *)
Theorem fourth_moment_of_response : forall n,
  over (load fourth) (response n)
  == fourth_moment (n_of (S n)) + pairs_below (S n) (fourth_moment_of_pair (n_of (S n))).
Proof.
  induction n as [|n IH]; [unfold pairs_below, fourth; at_first|].
  next fourth_step. rewrite IH, outward_is, across_is, second_moment_of_response, along_is, load_is_kept.
  assert (P : pairs_below (S (S n)) (fourth_moment_of_pair (n_of (S (S n))))
    == pairs_below (S n) (fourth_moment_of_pair (n_of (S n))) + 4 * pairs_below (S n) (fun s _ => 2 * s - 1)
       + times (step (S n)) 1 * (2 * total (S n) (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1)))).
  { transitivity (pairs_below (S n) (fourth_moment_of_pair (n_of (S (S n))))
      + times (step (S n)) 1 * total (S n) (fun s => times (step s) 1
          * fourth_moment_of_pair (n_of (S (S n))) (n_of s + 1) (n_of (S n) + 1))); [reflexivity|].
    rewrite (pairs_of_sum (S n) _ (fourth_moment_of_pair (n_of (S n))) (fun s _ => 2 * s - 1) 4).
    - rewrite (total_of_same (S n)
        (fun s => times (step s) 1 * fourth_moment_of_pair (n_of (S (S n))) (n_of s + 1) (n_of (S n) + 1))
        (fun s => 2 * (times (step s) 1 * (2 * (n_of s + 1) - 1)))).
      + rewrite total_of_multiple. ring.
      + intros s _. formulas. rewrite (n_of_S (S n)). ring.
    - intros s t. formulas. rewrite (n_of_S (S n)). ring. }
  rewrite P. formulas. rewrite (n_of_S (S n)). ring.
Qed.

End Stacking.
