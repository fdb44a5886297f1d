(** Layers with six sides: the number of spheres above a sphere on its lines, and the force along a line in a run of
    steps. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool.
From Cannonpile Require Import Directions Sums Formulas Balance.

Open Scope Z_scope.

(** Bounds of i, j and i+j, inclusive. *)
Definition inside (lower upper : three Z) (i j : Z) : bool :=
  (lower.(alpha) <=? i) && (i <=? upper.(alpha)) && (lower.(beta) <=? j) && (j <=? upper.(beta))
  && (lower.(gamma) <=? i + j) && (i + j <=? upper.(gamma)).

Lemma inside_iff : forall lower upper i j, inside lower upper i j = true <->
  (lower.(alpha) <= i <= upper.(alpha) /\ lower.(beta) <= j <= upper.(beta) /\ lower.(gamma) <= i + j <= upper.(gamma)).
Proof. intros. unfold inside. rewrite !andb_true_iff, !Z.leb_le. tauto. Qed.

(** The layer above a step: its bounds are tighter by one on the side to which the step leads. *)
Definition lower_above (sigma : sign) (lower : three Z) : three Z :=
  match sigma with Plus => lower | Minus => map (fun x => x + 1) lower end.
Definition upper_above (sigma : sign) (upper : three Z) : three Z :=
  match sigma with Plus => map (fun x => x - 1) upper | Minus => upper end.

(** The spheres above (i, j) on its line within m steps of one sign, one by one. *)
Fixpoint on_line (d : direction) (sigma : sign) (m : nat) (lower upper : three Z) (i j : Z) : Z :=
  match m with
  | O => 0
  | S n =>
    let (di, dj) := descent sigma d in
    let lower := lower_above sigma lower in
    let upper := upper_above sigma upper in
    if inside lower upper (i - di) (j - dj) then 1 + on_line d sigma n lower upper (i - di) (j - dj) else 0
  end.

Definition least (t : Z * Z * Z * Z) : Z :=
  let '(a, b, c, d) := t in Z.min (Z.min a b) (Z.min c d).

(** Their number is the minimum of four bounds: a line ends at the boundary of the region or at the start of the run. *)
Theorem region_counts : forall d sigma m lower upper i j,
  inside lower upper i j = true ->
  on_line d sigma m lower upper i j = least (on d (Integers.bounds_above i j lower upper (Z.of_nat m) sigma)).
Proof.
  intros d sigma m. induction m as [|n IH]; intros [x0 y0 s0] [x1 y1 s1] i j H;
    apply inside_iff in H; cbn [alpha beta gamma] in H.
  - destruct d, sigma; cbn; lia.
  - rewrite Nat2Z.inj_succ.
    destruct d, sigma; cbn [on_line descent lower_above upper_above];
      (match goal with |- context [inside ?a ?b ?c ?d] => destruct (inside a b c d) eqn:E end;
       [rewrite IH by exact E | rewrite <- not_true_iff_false in E]);
      rewrite inside_iff in E; cbn [map alpha beta gamma] in E;
      cbn [on Integers.bounds_above least map alpha beta gamma]; lia.
Qed.

(** For the paper's pile the counts are those of (9) of the paper. *)
Theorem region_of_the_paper : forall d i j k, 0 <= i -> 0 <= j -> i + j <= k ->
  least (on d (Integers.bounds_above i j (each 0) (each k) k Plus)) = on d (Integers.above i j k).
Proof. intros [] i j k Hi Hj Hk; cbn; lia. Qed.

(** On the edge where one line continues, the other two have no spheres above. *)
Theorem edges : forall i j lower upper m,
  let under sigma d := least (on d (Integers.bounds_above i j lower upper m sigma)) in
  inside lower upper i j = true -> 0 <= m ->
  (i + j = lower.(gamma) -> under Plus Beta = 0 /\ under Plus Gamma = 0) /\
  (i = upper.(alpha) -> under Plus Gamma = 0 /\ under Plus Alpha = 0) /\
  (j = upper.(beta) -> under Plus Alpha = 0 /\ under Plus Beta = 0) /\
  (i + j = upper.(gamma) -> under Minus Beta = 0 /\ under Minus Gamma = 0) /\
  (i = lower.(alpha) -> under Minus Gamma = 0 /\ under Minus Alpha = 0) /\
  (j = lower.(beta) -> under Minus Alpha = 0 /\ under Minus Beta = 0).
Proof.
  intros i j [x0 y0 s0] [x1 y1 s1] m. cbv zeta. intros H Hm.
  apply inside_iff in H; cbn [alpha beta gamma] in H. cbn. repeat split; intros; subst; lia.
Qed.

(** Bounds over rationals equal those over integers. *)
Theorem bounds_of_integers : forall i j lower upper m sigma d,
  let '(a, b, c, e) := on d (Integers.bounds_above i j lower upper m sigma) in
  let '(a', b', c', e') := on d (bounds_above (q i) (q j) (map q lower) (map q upper) (q m) sigma) in
  (q a == a' /\ q b == b' /\ q c == c' /\ q e == e')%Q.
Proof.
  intros i j [] [] m [] []; cbn -[inject_Z Qminus Qplus]; unfold Z.sub;
    repeat (rewrite inject_Z_plus || rewrite inject_Z_opp); repeat split; ring.
Qed.

(** ** No dip, and monotonicity

    The bounds of a count are linear in the position, so their minimum is concave. Under a straight pile of equal
    weights the pressure has a plateau or a hump, never a dip. *)
Theorem no_dip : forall d sigma m lower upper i j u v,
  let count i j := least (on d (Integers.bounds_above i j lower upper m sigma)) in
  count (i + u) (j + v) + count (i - u) (j - v) <= 2 * count i j.
Proof.
  intros [] [] m [x0 y0 s0] [x1 y1 s1] i j u v; cbv zeta; cbn [on Integers.bounds_above least alpha beta gamma]; lia.
Qed.

Lemma least_grows : forall a b c d a' b' c' d',
  a <= a' <= a + 1 -> b <= b' <= b + 1 -> c <= c' <= c + 1 -> d <= d' <= d + 1 ->
  least (a, b, c, d) <= least (a', b', c', d') <= least (a, b, c, d) + 1.
Proof. intros. unfold least. split; lia. Qed.

Lemma least_falls : forall a b c d a' b' c' d',
  a - 1 <= a' <= a -> b - 1 <= b' <= b -> c - 1 <= c' <= c -> d - 1 <= d' <= d ->
  least (a, b, c, d) - 1 <= least (a', b', c', d') <= least (a, b, c, d).
Proof. intros. unfold least. split; lia. Qed.

(** From a sphere to its neighbour p + d_b - d_a the count along b does not decrease and that along a does not
    increase under +; the reverse holds under -. *)
Theorem monotone : forall a b sigma m lower upper i j,
  let count d i j := least (on d (Integers.bounds_above i j lower upper m sigma)) in
  let (ai, aj) := descent Plus a in
  let (bi, bj) := descent Plus b in
  let i' := i + bi - ai in
  let j' := j + bj - aj in
  match sigma with
  | Plus => count b i j <= count b i' j' <= count b i j + 1 /\ count a i j - 1 <= count a i' j' <= count a i j
  | Minus => count b i j - 1 <= count b i' j' <= count b i j /\ count a i j <= count a i' j' <= count a i j + 1
  end \/ a = b.
Proof.
  intros a b [] m [x0 y0 s0] [x1 y1 s1] i j; destruct a, b; auto; left; cbv zeta;
    cbn [descent on Integers.bounds_above alpha beta gamma]; split;
    first [apply least_grows; lia | apply least_falls; lia].
Qed.

(** ** Runs *)

Open Scope Q_scope.

(** The force along a line, m spheres below a contact with force f, step by step. *)
Fixpoint after (f w : Q) (m : nat) : Q :=
  match m with O => f | S n => transmitted (after f w n) w end.

(** A closed form equals m steps. *)
Theorem run : forall f w m, after f w m == transmitted f (force (n_of m) w).
Proof.
  intros f w m. induction m as [|n IH]; cbn [after].
  - formulas. rewrite n_of_0. ring.
  - revert IH. formulas. intros IH. rewrite IH, n_of_S. ring.
Qed.

(** Additional contributions of spheres can be added before or after. *)
Theorem run_in_any_order : forall f w e m, after (transmitted f e) w m == transmitted (after f w m) e.
Proof. intros. rewrite !run. formulas. ring. Qed.
