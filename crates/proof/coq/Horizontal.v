(** Horizontal contacts, at a = R: balance, virtual work, the elastic state of the straight pile, bounds and arches. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa.
From Cannonpile Require Import Directions Sums Formulas Balance Straight Floor Regions.

Open Scope Q_scope.

Definition one_on (d : direction) : three Q :=
  match d with Alpha => Three 1 0 0 | Beta => Three 0 1 0 | Gamma => Three 0 0 1 end.

Definition plus_three : three Q -> three Q -> three Q := by_line Qplus.
Definition minus_three : three Q -> three Q -> three Q := by_line Qminus.

(** A sign as a number. *)
Definition times (sigma : sign) (x : Q) : Q := match sigma with Plus => x | Minus => - x end.

(** ** Balance *)

(** Neighbours in a layer touch: their squared distance over 4R^2 is 1. *)
Theorem neighbours_touch : forall a b, a <> b ->
  squared_distance (minus_three (one_on a) (one_on b)) (1 # 2) (1 # 3) == 1.
Proof. intros [] [] H; try congruence; unfold minus_three; formulas; cbn; reflexivity. Qed.

(** The six neighbours: x for p + d_b - d_a, y for p - d_b + d_a, for the pairs (a, b) of the three axes. *)
Record pushes := { ab : Q; ag : Q; gb : Q }.

Definition pushed_by (x y : pushes) : three Q :=
  plus_three (plus_three (plus_three (pushed x.(ab) Alpha Beta true) (pushed y.(ab) Alpha Beta false))
                         (plus_three (pushed x.(ag) Alpha Gamma true) (pushed y.(ag) Alpha Gamma false)))
             (plus_three (pushed x.(gb) Gamma Beta true) (pushed y.(gb) Gamma Beta false)).

(** The force of all six neighbours on the sphere: x along e_b - e_a, y along the reverse. *)
Definition push (x y : pushes) : vector :=
  let along a b f := map (Qmult f) (minus_three (one_on b) (one_on a)) in
  combination (plus_three (plus_three (along Alpha Beta (x.(ab) - y.(ab))) (along Alpha Gamma (x.(ag) - y.(ag))))
                          (along Gamma Beta (x.(gb) - y.(gb)))) (directions (1 # 2)).

Definition plus_vector (v w : vector) : vector :=
  Vector (v.(along_x) + w.(along_x)) (v.(along_y) + w.(along_y)) (v.(along_z) + w.(along_z)).

(** A sphere of weight n mg that receives any g and transmits f = T g + n - sigma H is in balance with the horizontal
    forces. *)
Theorem horizontal_balance : forall from to g n x y,
  let turned := transferred from to g in
  let h := pushed_by x y in
  let f := Three (beside turned.(alpha) n h.(alpha) to) (beside turned.(beta) n h.(beta) to)
                 (beside turned.(gamma) n h.(gamma) to) in
  plus_vector
    (unbalanced f (directions_under (1 # 2) to) g (directions_under (1 # 2) from)
       (force n (weight (increments (1 # 2)))))
    (push x y) =v= nothing.
Proof.
  intros [] [] [] n [] []; unfold transferred, pushed_by, push, plus_three, minus_three, directions_under, combination,
    plus_vector, one_on; cbn [ab ag gb]; by_components.
Qed.

(** A direction paired with itself is not an axis. The formulas are defined there too, with this value, and no other
    proof depends on it. *)
Theorem no_axis : forall d away x phi there sigma,
  pushed x d d away =3= map (Qmult x) (one_on d) /\ compression phi there d d sigma == 0.
Proof. intros [] [] x [] [] []; (split; [unfold one_on; by_components | formulas; ring]). Qed.

(** ** Virtual work

    For any numbers phi: the balance of a sphere times phi, and the terms of a sloping and of a horizontal contact.
    With phi = 0 on the floor, the sum over all spheres is: sum of f D + sum of X c = sum of w phi. *)
Theorem work_of_a_sphere : forall from to phi g n h,
  let turned := transferred from to g in
  let f := Three (beside turned.(alpha) n h.(alpha) to) (beside turned.(beta) n h.(beta) to)
                 (beside turned.(gamma) n h.(gamma) to) in
  dot phi f + times to (dot phi h) == dot g (transferred from to phi) + n * sum phi.
Proof. intros [] [] [] [] n []; unfold transferred, dot, times; formulas; ring. Qed.

Theorem work_of_a_sloping_contact : forall f phi below, f * contact_drop phi below == f * phi - f * below.
Proof. intros. formulas. ring. Qed.

Theorem work_of_a_horizontal_contact : forall a b sigma phi there x, a <> b ->
  times sigma (dot phi (pushed x a b true) + dot there (pushed x a b false)) == compression phi there a b sigma * x.
Proof. intros [] [] [] [] [] x H; try congruence; unfold times, dot; formulas; ring. Qed.

(** ** The elastic state of the straight pile, d layers above the floor *)

Definition field (n : three Q) (d : Q) : three Q := map (fun n => elastic_field n d) n.

Theorem field_on_the_floor : forall n, elastic_field n 0 == 0.
Proof. intros. formulas. ring. Qed.

(** D of every sloping contact is its force. *)
Theorem field_lowers_by_the_force : forall i j k d l,
  let (di, dj) := descent Plus l in
  contact_drop (on l (field (above i j k) d)) (on l (field (above (i + q di) (j + q dj) (k + 1)) (d - 1)))
  == on l (closed_form (1 # 2) i j k).
Proof. intros i j k d []; cbn [descent]; unfold closed_form, brought, field; cbn [q]; formulas; ring. Qed.

(** c of every horizontal contact is -2d: these contacts open. *)
Theorem field_opens : forall i j k d a b, a <> b ->
  let (ai, aj) := descent Plus a in
  let (bi, bj) := descent Plus b in
  compression (field (above i j k) d) (field (above (i + q (bi - ai)) (j + q (bj - aj)) k) d) a b Plus == - 2 * d.
Proof.
  intros i j k d [] [] H; try congruence; cbn [descent Z.sub Z.add Z.opp Z.pos_sub]; unfold field; formulas;
    cbn [q]; ring.
Qed.

(** Energy: the sum of f^2 over all contacts, L = k+1. *)
Theorem elastic_energy : forall k,
  let L := n_of k + 1 in
  40 * total_over_pile k (fun i j m => let f := closed_form (1 # 2) i j m in dot f f)
  == L * (L - 1) * (L + 1) * (L + 2) * (2 * L + 1).
Proof.
  intros k. cbv zeta. unfold dot.
  assert (E : total_over_pile k (fun i j m => sum (by_line Qmult (closed_form (1 # 2) i j m) (closed_form (1 # 2) i j m)))
    == (2 * n_of k * n_of k * n_of k * n_of k * n_of k + 15 * n_of k * n_of k * n_of k * n_of k + 40 * n_of k *
      n_of k * n_of k + 45 * n_of k * n_of k + 18 * n_of k) * (1 # 40)).
  {
  over_pile
    (fun k j x : Q => (6 * j * j * x - 6 * j * k * x + 3 * j * x * x - 3 * j * x + 3 * k * k * x - 3 * k * x * x + 9 * k * x + 2
      * x * x * x - 3 * x * x + 10 * x) * (1 # 3))
    (fun k y : Q => (8 * k * k * k * y - 12 * k * k * y * y + 48 * k * k * y + 12 * k * y * y * y - 42 * k * y * y + 94 * k *
      y - 5 * y * y * y * y + 18 * y * y * y - 37 * y * y + 60 * y) * (1 # 12))
    (fun k : Q => (k * k * k * k + 8 * k * k * k + 23 * k * k + 28 * k + 12) * (1 # 4))
    (fun x : Q => (2 * x * x * x * x * x + 15 * x * x * x * x + 40 * x * x * x + 45 * x * x + 18 * x) * (1 # 40)).
  reflexivity. }
  rewrite E. ring.
Qed.

(** The sum of f^2 is also the work of the weights. *)
Theorem energy_is_work : forall k,
  total_over_pile k (fun i j m => let f := closed_form (1 # 2) i j m in dot f f)
  == total_over_pile k (fun i j m => sum (field (above i j m) (n_of k - m))).
Proof.
  intros k.
  assert (P : forall H L, total_over_pile L (fun i j m => sum (field (above i j m) (H - m))) == (10 * H * H * n_of L * n_of L * n_of L + 30 * H * H * n_of L * n_of L + 20 * H * H * n_of L - 10 * H *
      n_of L * n_of L * n_of L * n_of L - 10 * H * n_of L * n_of L * n_of L + 40 * H * n_of L * n_of L + 40 * H
      * n_of L + 2 * n_of L * n_of L * n_of L * n_of L * n_of L - 5 * n_of L * n_of L * n_of L * n_of L - 20 *
      n_of L * n_of L * n_of L + 5 * n_of L * n_of L + 18 * n_of L) * (1 # 40)).
  { intros H L. unfold field.
    over_pile
      (fun k j x : Q => (3 * H * H * x - 4 * H * k * x + 3 * H * x + k * k * x - 3 * k * x) * (1 # 2))
      (fun k y : Q => (6 * H * H * k * y - 3 * H * H * y * y + 9 * H * H * y - 8 * H * k * k * y + 4 * H * k * y * y - 6 * H *
        k * y - 3 * H * y * y + 9 * H * y + 2 * k * k * k * y - k * k * y * y - 3 * k * k * y + 3 * k * y * y -
        9 * k * y) * (1 # 4))
      (fun k : Q => (3 * H * H * k * k + 9 * H * H * k + 6 * H * H - 4 * H * k * k * k - 9 * H * k * k + H * k + 6 * H + k *
        k * k * k - 7 * k * k - 6 * k) * (1 # 4))
      (fun x : Q => (10 * H * H * x * x * x + 30 * H * H * x * x + 20 * H * H * x - 10 * H * x * x * x * x - 10 * H * x * x
        * x + 40 * H * x * x + 40 * H * x + 2 * x * x * x * x * x - 5 * x * x * x * x - 20 * x * x * x + 5 * x *
        x + 18 * x) * (1 # 40)).
    reflexivity. }
  rewrite P. clear P. assert (E := elastic_energy k). cbv zeta in E.
  match type of E with 40 * ?a == ?b => assert (A : a == (1 # 40) * b) by (rewrite <- E; ring); rewrite A end.
  ring.
Qed.

(** Settlement: 6w = d(3L-k), with w the mean of phi, so layers stay plane. 3(w - phi_l) = -d(3n_l - k), so they
    dilate. The apex sinks by w = L(L-1)/2. *)
Theorem settlement : forall L i j k,
  let d := L - 1 - k in
  let phi := field (above i j k) d in
  let w := sum phi * (1 # 3) in
  6 * w == d * (3 * L - k) /\
  map (fun phi => 3 * (w - phi)) phi =3= map (fun n => - d * (3 * n - k)) (above i j k) /\
  2 * elastic_field 0 (L - 1) == L * (L - 1).
Proof. intros. unfold w, phi, d, field. repeat split; formulas; ring. Qed.

(** The elastic state of discs has the same field. *)
Theorem field_of_discs : forall i k d,
  contact_drop (elastic_field (k - i) d) (elastic_field (k + 1 - i) (d - 1)) == k - i + 1 /\
  contact_drop (elastic_field i d) (elastic_field (i + 1) (d - 1)) == i + 1 /\
  compression (field (above i 0 k) d) (field (above (i + 1) 0 k) d) Alpha Beta Plus == - 2 * d.
Proof. intros. unfold field. repeat split; formulas; ring. Qed.

(** ** The corners *)

Definition drops (here below : three Q) : three Q := by_line contact_drop here below.

Definition other (edge l : direction) : Prop := edge <> l.

(** Lower bound: D = 0 along the edge, D = 1 at its end, c = -1 at the horizontal contacts of the edge, sum of
    phi = K. *)
Theorem corner_least : forall edge K,
  let phi := corner_field edge false in
  drops phi (map (Qmult (on edge phi)) (one_on edge)) =3= each 0 /\
  drops phi (each 0) =3= one_on edge /\
  (forall b, b <> edge -> compression phi (each 0) edge b Plus == - (1)) /\
  K * sum phi == least_on_corner K.
Proof.
  intros [] K; unfold drops, one_on; repeat split; intros; try (destruct b; try congruence); formulas; ring.
Qed.

(** Upper bound: D = 0 along the edge, 1 along the other lines and at its end, 0 there at the apex; c = 0; sum of
    phi = 3K-2. *)
Theorem corner_greatest : forall edge K,
  let apex := corner_field edge false in
  let phi := corner_field edge true in
  let below := map (Qmult (on edge phi)) (one_on edge) in
  drops phi below =3= minus_three (each 1) (one_on edge) /\
  drops apex below =3= each 0 /\
  drops phi (each 0) =3= each 1 /\
  (forall b, b <> edge -> compression phi (each 0) edge b Plus == 0) /\
  sum apex + (K - 1) * sum phi == greatest_on_corner K.
Proof.
  intros [] K; unfold drops, one_on, minus_three; repeat split; intros; try (destruct b; try congruence);
    formulas; ring.
Qed.

(** The upper bound is attained with X = 1 between the spheres of the edge and their neighbours: t spheres down the edge
    the force is 3t-2. *)
Fixpoint down_the_edge (t : nat) : Q :=
  match t with
  | O => 0
  | S O => beside 0 1 0 Plus
  | S n =>
    let h := plus_three (pushed 1 Alpha Beta true) (pushed 1 Alpha Gamma true) in
    beside (down_the_edge n) 1 h.(alpha) Plus
  end.

Theorem greatest_is_attained : forall t, down_the_edge (S t) == greatest_on_corner (n_of (S t)).
Proof.
  induction t as [|t IH]; [reflexivity|].
  change (down_the_edge (S (S t))) with
    (beside (down_the_edge (S t)) 1 (plus_three (pushed 1 Alpha Beta true) (pushed 1 Alpha Gamma true)).(alpha) Plus).
  revert IH. unfold plus_three. formulas. intros IH. rewrite IH, !n_of_S. ring.
Qed.

(** A neighbour adds 0 along the edge, 2 along the line that leads to it, and 1 along the third. *)
Theorem neighbour_of_the_edge : forall edge b g, b <> edge ->
  let h := pushed 1 edge b false in
  Three (beside g.(alpha) 1 h.(alpha) Plus) (beside g.(beta) 1 h.(beta) Plus) (beside g.(gamma) 1 h.(gamma) Plus)
  =3= plus_three g (plus_three (each 1) (minus_three (one_on b) (one_on edge))).
Proof. intros [] [] [] H; try congruence; unfold plus_three, minus_three, one_on; by_components. Qed.

(** ** The arch *)

(** Three spheres that would transmit nu to the sphere below them press on each other so that this sphere is
    unloaded. Each adds 1 + X along the lines of the others. [line] is the line of the sphere; a and b are the
    others. *)
Theorem arch_empties : forall line a b g nu, line <> a -> line <> b -> a <> b ->
  let x := arch nu in
  let h := plus_three (pushed (on b x) a line true) (pushed (on a x) b line true) in
  let received d := if match line, d with Alpha, Alpha | Beta, Beta | Gamma, Gamma => true | _, _ => false end
                    then on d nu - 1 else on d g in
  let f d := beside (received d) 1 (on d h) Plus in
  f line == 0 /\ f a == on a g + 1 + on b x /\ f b == on b g + 1 + on a x.
Proof.
  intros [] [] [] [] [] A B C; try congruence; unfold plus_three; repeat split; formulas; ring.
Qed.

(** A flank: a sphere that presses on a neighbour with force 1 adds nothing along one line and 2 along the other. *)
Theorem flank : forall a b g, a <> b ->
  let h := pushed 1 a b true in
  Three (beside g.(alpha) 1 h.(alpha) Plus) (beside g.(beta) 1 h.(beta) Plus) (beside g.(gamma) 1 h.(gamma) Plus)
  =3= plus_three g (plus_three (each 1) (minus_three (one_on a) (one_on b))).
Proof. intros [] [] [] H; try congruence; unfold plus_three, minus_three, one_on; by_components. Qed.

(** At r = n_B + n_C the horizontal forces are 0, n_C, n_B. *)
Theorem steep_arch : forall b c, arch (Three (b + c) b c) =3= Three 0 c b.
Proof. intros. by_components. Qed.

(** No horizontal force of an arch is negative. *)
Theorem arch_pushes : forall r b c, 0 <= c -> c <= b -> b <= r -> r <= b + c ->
  let x := arch (Three r b c) in 0 <= x.(alpha) /\ 0 <= x.(beta) /\ 0 <= x.(gamma).
Proof. intros. unfold x. formulas. repeat split; lra. Qed.

(** ** Bounds inside and on edges *)

(** The field that bounds the load on n is 1 on a pile of n_l layers for each line. *)
Theorem inner_greatest : forall a b c,
  let spheres n := total_over_pile n (fun _ _ _ => 1) in
  spheres a + spheres b + spheres c == greatest_inside (Three (n_of a) (n_of b) (n_of c)).
Proof. intros. unfold spheres. rewrite !spheres_of_a_pile. formulas. ring. Qed.

Theorem greatest_at_a_centre : forall k, 2 * greatest_inside (each k) == k * (k + 1) * (k + 2).
Proof. intros. formulas. ring. Qed.

(** On an edge, row by row: the field is 1 along alpha on S0, along beta on S1, and along gamma on the spheres of S0
    with n_a >= 1 and of S1 with n_b >= 1. A row of S0 above the first has c-y spheres, one of S1 has k+j-y-c. *)
Theorem edge_greatest : forall c j k : nat, (1 <= c)%nat ->
  let above_first less := total (c - 1) (fun y => n_of c - (n_of y + 1) - less) in
  let right n := total n (fun y => n_of k + n_of y - n_of c) in
  (n_of k + above_first 0 + right (S j)) + (n_of k - 1 + above_first 1 + right j - (n_of k - n_of c))
  == greatest_on_edge (n_of k) (n_of j) (n_of c).
Proof.
  intros c j k Hc. cbv zeta.
  assert (A : forall less, total (c - 1) (fun y => n_of c - (n_of y + 1) - less)
    == (n_of c - 1 - less) * (n_of c - 1) - (n_of c - 1) * (n_of c - 2) * (1 # 2)).
  { intros less. rewrite (total_is (fun y => n_of c - (y + 1) - less)
      (fun x => (n_of c - 1 - less) * x - x * (x - 1) * (1 # 2))); [|intros ? ? ?; congruent | ring | intros; ring].
    rewrite n_of_sub by assumption. change (n_of 1) with 1. ring. }
  assert (B : forall n, total n (fun y => n_of k + n_of y - n_of c) == (n_of k - n_of c) * n_of n + n_of n * (n_of n - 1) * (1 # 2)).
  { intros n. apply (total_is (fun y => n_of k + y - n_of c) (fun x => (n_of k - n_of c) * x + x * (x - 1) * (1 # 2)));
      [intros ? ? ?; congruent | ring | intros; ring]. }
  rewrite !A, !B. formulas. rewrite !n_of_S. ring.
Qed.

Theorem edge_greatest_is : forall k j,
  greatest_on_edge k j (j + 1) == 2 * (j + 1) * (k - 1) + 1 /\ greatest_on_edge k k k == 2 * k * k.
Proof. intros. split; formulas; ring. Qed.

(** ** Runs with horizontal contacts

    Two neighbours off the edge press a sphere of the edge along line l, the only line that continues there, with x
    and y. *)
Definition leads_away (sigma : sign) : bool := match sigma with Plus => true | Minus => false end.

Definition pressed (sigma : sign) (l a b : direction) (x y : Q) : Q :=
  on l (plus_three (pushed x l a (leads_away sigma)) (pushed y l b (leads_away sigma))).

Theorem run_with_pushes : forall sigma l a b g x y, l <> a -> l <> b -> a <> b ->
  let h := pressed sigma l a b x y in
  beside g 1 h sigma == g + 1 + x + y /\
  beside (on l (half_turn (map (Qmult g) (one_on l)))) 1 h (opposite sigma) == 1 - g * (1 # 3) - x - y.
Proof.
  intros [] [] [] [] g x y A B C; try congruence; cbv zeta; unfold pressed, plus_three, leads_away, opposite, one_on;
    split; formulas; ring.
Qed.

(** So the force is tensile if g >= 4, for all horizontal forces. *)
Theorem no_run_ends_with_pushes : forall sigma l a b g x y, l <> a -> l <> b -> a <> b ->
  0 <= x -> 0 <= y -> 4 <= g ->
  beside (on l (half_turn (map (Qmult g) (one_on l)))) 1 (pressed sigma l a b x y) (opposite sigma) < 0.
Proof.
  intros sigma l a b g x y A B C Hx Hy Hg.
  destruct (run_with_pushes sigma l a b g x y A B C) as [_ E]. rewrite E. lra.
Qed.
