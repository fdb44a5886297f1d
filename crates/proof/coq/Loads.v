(** Loads of any direction, and gravity that leans: balance, the tilts that a straight pile bears, and the total force
    and moment on its base. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool List.
From Cannonpile Require Import Directions Sums Formulas Balance Straight Floor Stackings.

Open Scope Q_scope.

(** ** One sphere

    A load is the vector (X, Y, w): w downwards in mg, X along x in mg tan theta, Y along y in 2 cos phi mg tan theta.
    In f0 and the basis of the directions this is W times the load, W = 2(1+s). *)

Definition under_load (weight : Q) (load : vector) (v : vector) : vector :=
  Vector (v.(along_x) + load.(along_x) * weight) (v.(along_y) + load.(along_y) * weight) v.(along_z).

(** The sum of all forces on a sphere with a load. *)
Definition left_over (s : Q) (load : vector) (up : three Q) (below : three vector) (g : three Q) (over : three vector)
  : vector :=
  let w := weight (increments s) in
  under_load w load (unbalanced up below g over (force load.(along_z) w)).

(** A sphere that receives g is in balance if and only if it transmits g plus its load increments: for every angle,
    under steps of either sign. *)
Theorem loaded_sphere : forall s sigma load g up, ~ 1 + s == 0 ->
  let e := directions_under s sigma in
  left_over s load up e g e =v= nothing <-> up =3= by_line transmitted g (load_increments load s sigma).
Proof.
  intros s sigma [X Y w] [a b c] [x y z] Hs. cbv zeta. unfold left_over, under_load, directions_under.
  split.
  - intros H. destruct sigma; formulas_in H; destruct H as (Hx & Hy & Hz); formulas.
    + assert (E : (1 + s) * (x - a + (y - b) - 2 * (w - X)) == 0) by lra.
      apply factor in E; [|assumption]. assert (F : s * (x - a + (y - b)) == s * (2 * (w - X))).
      { apply Qmult_comp; [reflexivity | lra]. }
      repeat split; lra.
    + assert (E : (1 + s) * (x - a + (y - b) - 2 * (w + X)) == 0) by lra.
      apply factor in E; [|assumption]. assert (F : s * (x - a + (y - b)) == s * (2 * (w + X))).
      { apply Qmult_comp; [reflexivity | lra]. }
      repeat split; lra.
  - intros (Hx & Hy & Hz). destruct sigma; formulas_in Hx; formulas_in Hy; formulas_in Hz; formulas;
      rewrite Hx, Hy, Hz; repeat split; ring.
Qed.

(** On an equilateral base, also between steps of two signs: the sign below the sphere is that of its increments. *)
Theorem loaded_sphere_in_any_stacking : forall from to load g up,
  left_over (1 # 2) load up (directions_under (1 # 2) to) g (directions_under (1 # 2) from) =v= nothing
  <-> up =3= by_line transmitted (transferred from to g) (load_increments load (1 # 2) to).
Proof.
  intros from to [X Y w] [a b c] [x y z]. unfold left_over, under_load, directions_under.
  destruct from, to; unfold transferred;
    (split; [intros H; formulas_in H; destruct H as (Hx & Hy & Hz); formulas; repeat split; lra
            | intros (Hx & Hy & Hz); formulas_in Hx; formulas_in Hy; formulas_in Hz;
              formulas; repeat split; lra]).
Qed.

Definition disc_directions_under (sigma : sign) : three vector :=
  match sigma with
  | Plus => disc_directions
  | Minus => map turned_about_z disc_directions
  end.

(** A disc has no third contact, and no load across its plane. *)
Theorem loaded_disc : forall sigma X w a b x y,
  let e := disc_directions_under sigma in
  left_over 0 (Vector X 0 w) (Three x y 0) e (Three a b 0) e =v= nothing
  <-> Three x y 0 =3= by_line transmitted (Three a b 0) (disc_load_increments (Vector X 0 w) sigma).
Proof.
  intros sigma X w a b x y. cbv zeta. unfold left_over, under_load, disc_directions_under.
  destruct sigma; cbv beta iota zeta delta [disc_directions];
    (split; [intros H; formulas_in H; destruct H as (Hx & Hy & Hz); formulas; repeat split; lra
            | intros (Hx & Hy & Hz); formulas_in Hx; formulas_in Hy; formulas_in Hz;
              formulas; repeat split; lra]).
Qed.

(** A vertical load n adds n increments, like a sphere of weight n mg. *)
Theorem vertical_load : forall s sigma n,
  load_increments (Vector 0 0 n) s sigma =3= own s n /\ disc_load_increments (Vector 0 0 n) sigma =3= own 0 n.
Proof. intros s [] n; unfold own; split; by_components. Qed.

(** The load (-X, -Y, w) above a step of the other sign adds the same. *)
Theorem mirrored_load : forall s sigma load,
  let mirrored := Vector (- load.(along_x)) (- load.(along_y)) load.(along_z) in
  load_increments mirrored s (opposite sigma) =3= load_increments load s sigma /\
  disc_load_increments mirrored (opposite sigma) =3= disc_load_increments load sigma.
Proof. intros s [] []; unfold opposite; split; by_components. Qed.

(** The increments of a sum of loads are the sums of their increments. *)
Theorem loads_add : forall s sigma v w,
  let both := Vector (v.(along_x) + w.(along_x)) (v.(along_y) + w.(along_y)) (v.(along_z) + w.(along_z)) in
  load_increments both s sigma =3= by_line Qplus (load_increments v s sigma) (load_increments w s sigma) /\
  disc_load_increments both sigma =3= by_line Qplus (disc_load_increments v sigma) (disc_load_increments w sigma).
Proof. intros s [] [] []; split; by_components. Qed.

(** ** Any stacking, any loads, on an equilateral base *)

Section Loaded.
Variable top : list (Z * Z).
Variable step : nat -> sign.
Variable load : nat -> Z -> Z -> vector.

Definition in_balance_under (f : nat -> Z -> Z -> three Q) (k : nat) (i j : Z) : Prop :=
  left_over (1 # 2) (load k i j) (f k i j) (directions_under (1 # 2) (step k)) (arriving top step f k i j)
    (directions_under (1 # 2) (step_above step k)) =v= nothing.

Theorem balance_under_loads : forall f k i j,
  in_balance_under f k i j
  <-> f k i j =3= by_line transmitted (transferred (step_above step k) (step k) (arriving top step f k i j))
                    (load_increments (load k i j) (1 # 2) (step k)).
Proof. intros. apply loaded_sphere_in_any_stacking. Qed.

(** The loads of all spheres determine all forces. *)
Theorem loads_determine_forces : forall f g L,
  (forall k i j, (k < L)%nat -> In (i, j) (layer top step k) -> in_balance_under f k i j /\ in_balance_under g k i j) ->
  forall k i j, (k < L)%nat -> In (i, j) (layer top step k) -> f k i j =3= g k i j.
Proof.
  intros f g L H k. induction k as [k IH] using lt_wf_ind. intros i j HL Hi.
  destruct (H k i j HL Hi) as [F G]. apply balance_under_loads in F. apply balance_under_loads in G.
  rewrite F, G. apply passed_of_same. apply transferred_of_same. apply arriving_of_same.
  intros m a b Hm Hin. apply IH; [assumption | lia | assumption].
Qed.
End Loaded.

(** ** Tilt: the straight pile under any top

    Under gravity that leans by (x, y), each sphere has the load (x, y, 1). *)

Definition leaning (x y : Q) : vector := Vector x y 1.

(** What each sphere adds to each line. *)
Definition tilted (s x y : Q) : three Q := load_increments (leaning x y) s Plus.

(** Each step has the sign +. *)
Definition straight : nat -> sign := fun _ => Plus.

Section Straight.
Variable top : list (Z * Z).

(** All spheres of L layers are in balance. *)
Definition balanced_under_tilt (s x y : Q) (f : nat -> Z -> Z -> three Q) (L : nat) : Prop :=
  forall k i j, (k < L)%nat -> In (i, j) (layer top straight k) ->
    left_over s (leaning x y) (f k i j) (directions s) (arriving top straight f k i j) (directions s) =v= nothing.

(** Each force is a positive multiple of the increment of its line. *)
Theorem forces_are_multiples : forall s x y f L, ~ 1 + s == 0 -> balanced_under_tilt s x y f L ->
  forall k i j, (k < L)%nat -> In (i, j) (layer top straight k) ->
  forall d, exists n, on d (f k i j) == n_of (S n) * on d (tilted s x y).
Proof.
  intros s x y f L Hs H k. induction k as [k IH] using lt_wf_ind. intros i j HL Hi d.
  assert (B := proj1 (loaded_sphere s Plus _ _ _ Hs) (H k i j HL Hi)).
  assert (A : exists n, on d (arriving top straight f k i j) == n_of n * on d (tilted s x y)).
  { destruct k as [|m].
    - exists 0%nat. rewrite n_of_0. destruct d; cbn [arriving each on alpha beta gamma]; ring.
    - assert (R : on d (arriving top straight f (S m) i j) =
        let (a, b) := above_in (straight m) d i j in if member (layer top straight m) a b then on d (f m a b) else 0)
        by (destruct d; reflexivity).
      rewrite R. clear R. destruct (above_in (straight m) d i j) as [a b].
      destruct (member (layer top straight m) a b) eqn:E.
      + apply member_iff in E. destruct (IH m (Nat.lt_succ_diag_r m) a b ltac:(lia) E d) as [n N].
        exists (S n). exact N.
      + exists 0%nat. rewrite n_of_0. ring. }
  destruct A as [n N]. exists n. rewrite n_of_S. destruct B as (X & Y & Z). fold (tilted s x y) in X, Y, Z.
  destruct d; cbn [on] in *; [rewrite X | rewrite Y | rewrite Z];
    unfold by_line, transmitted; cbn [alpha beta gamma]; rewrite N; ring.
Qed.

(** A straight pile of any height under any top bears exactly the tilts that its topmost spheres bear: all forces are
    compressive if and only if no increment is negative. *)
Theorem straight_pile_bears : forall s x y f L a b, ~ 1 + s == 0 -> balanced_under_tilt s x y f L ->
  (0 < L)%nat -> In (a, b) top ->
  ((forall k i j d, (k < L)%nat -> In (i, j) (layer top straight k) -> 0 <= on d (f k i j))
   <-> forall d, 0 <= on d (tilted s x y)).
Proof.
  intros s x y f L a b Hs H HL Ht. split.
  - intros F d. assert (B := proj1 (loaded_sphere s Plus _ _ _ Hs) (H 0%nat a b HL Ht)).
    specialize (F 0%nat a b d HL Ht). destruct B as (X & Y & Z). fold (tilted s x y) in X, Y, Z.
    destruct d; cbn [on] in *; [rewrite X in F | rewrite Y in F | rewrite Z in F];
      unfold by_line, transmitted in F; cbn [arriving each alpha beta gamma] in F; lra.
  - intros T k i j d Hk Hi. destruct (forces_are_multiples s x y f L Hs H k i j Hk Hi d) as [n N].
    rewrite N. apply Qmult_le_0_compat; [|apply T]. unfold n_of. change 0 with (q 0). rewrite <- Zle_Qle. lia.
Qed.
End Straight.

(** ** The least tilt that opens a contact

    The square of a tilt is from_axis_squared, x^2 + 4 (1 - s^2) y^2, in tan^2 theta. *)

(** The least tilt at which the increment of a line is zero. *)
Definition nearest (s : Q) (d : direction) : vector :=
  match d with
  | Alpha => leaning ((1 - s) * (1 # 2)) (1 # 4)
  | Beta => leaning ((1 - s) * (1 # 2)) (- (1 # 4))
  | Gamma => leaning (- s) 0
  end.

(** Its square. *)
Definition margin (s : Q) (d : direction) : Q := match d with Gamma => s * s | _ => (1 - s) * (1 # 2) end.

Theorem nearest_tilt : forall s d,
  on d (load_increments (nearest s d) s Plus) == 0 /\ from_axis_squared s (nearest s d) == margin s d.
Proof. intros s []; unfold nearest, leaning, margin, from_axis_squared; formulas; split; ring. Qed.

(** Twice the margin over the increment without a tilt. *)
Definition slope (s : Q) (d : direction) : Q := match d with Gamma => s | _ => 1 - s end.

Lemma distance_to_nearest : forall s d x y,
  from_axis_squared s (leaning x y) - margin s d + slope s d * on d (tilted s x y)
  == from_axis_squared s (leaning (x - (nearest s d).(along_x)) (y - (nearest s d).(along_y))).
Proof. intros s [] x y; unfold slope, margin, tilted, nearest, leaning, from_axis_squared; formulas; ring. Qed.

Lemma square_is_not_negative : forall s v, 0 < s < 1 -> 0 <= from_axis_squared s v.
Proof. intros s [x y z] [H0 H1]. unfold from_axis_squared. formulas. assert (0 < 1 - s * s) by nra. nra. Qed.

Lemma slope_is_positive : forall s d, 0 < s < 1 -> 0 < slope s d.
Proof. intros s [] [H0 H1]; unfold slope; lra. Qed.

(** A tilt up to the margin of a line leaves its increment nonnegative; a smaller tilt leaves it positive. *)
Theorem margin_is_borne : forall s d x y, 0 < s < 1 ->
  (from_axis_squared s (leaning x y) <= margin s d -> 0 <= on d (tilted s x y)) /\
  (from_axis_squared s (leaning x y) < margin s d -> 0 < on d (tilted s x y)).
Proof.
  intros s d x y Hs. assert (D := distance_to_nearest s d x y). assert (P := slope_is_positive s d Hs).
  assert (N := square_is_not_negative s (leaning (x - (nearest s d).(along_x)) (y - (nearest s d).(along_y))) Hs).
  rewrite <- D in N. clear D. set (t := from_axis_squared s (leaning x y)) in *. set (i := on d (tilted s x y)) in *.
  split; intros H; [apply Qnot_lt_le | apply Qnot_le_lt]; intro I.
  - assert (slope s d * i < 0) by nra. lra.
  - assert (slope s d * i <= 0) by nra. lra.
Qed.

(** A larger tilt in the direction of the nearest one makes it negative. *)
Theorem margin_is_sharp : forall s d c, 0 < s < 1 -> 1 < c ->
  on d (tilted s (c * (nearest s d).(along_x)) (c * (nearest s d).(along_y))) < 0.
Proof. intros s [] c [H0 H1] Hc; unfold tilted, nearest, leaning; formulas; nra. Qed.

(** On an equilateral base: a straight pile of any height under any top bears every tilt of length up to 1/2, so of a
    tangent up to (tan theta)/2, and no larger tilt against the direction of a support. *)
Theorem critical_tilt : forall top x y f L a b, (0 < L)%nat -> In (a, b) top ->
  balanced_under_tilt top (1 # 2) x y f L ->
  let stands := forall k i j d, (k < L)%nat -> In (i, j) (layer top straight k) -> 0 <= on d (f k i j) in
  (from_axis_squared (1 # 2) (leaning x y) <= (1 # 2) * (1 # 2) -> stands) /\
  forall d c, 1 < c -> x == c * (nearest (1 # 2) d).(along_x) -> y == c * (nearest (1 # 2) d).(along_y) -> ~ stands.
Proof.
  intros top x y f L a b HL Ht H. cbv zeta.
  assert (Hs : 0 < 1 # 2 < 1) by (split; reflexivity). assert (H1 : ~ 1 + (1 # 2) == 0) by discriminate.
  assert (B := straight_pile_bears top _ x y f L a b H1 H HL Ht). split.
  - intros T. apply B. intros d. apply (proj1 (margin_is_borne _ d x y Hs)).
    destruct d; exact T.
  - intros d c Hc X Y F. assert (G := proj1 B F d). assert (N := margin_is_sharp _ d c Hs Hc).
    unfold tilted, leaning, nearest in *. destruct d; formulas_in G; formulas_in N; formulas_in X; formulas_in Y; lra.
Qed.

(** Discs bear exactly the tilts up to tan theta. *)
Theorem critical_tilt_of_discs : forall x,
  (forall d, 0 <= on d (disc_load_increments (leaning x 0) Plus)) <-> - (1) <= x <= 1.
Proof.
  intros x. unfold leaning. split.
  - intros H. assert (A := H Alpha). assert (B := H Beta). formulas_in A. formulas_in B. lra.
  - intros H []; formulas; lra.
Qed.

(** ** The paper's pile under a tilt *)

(** The forces that a sphere receives and transmits: multiples of the increments. *)
Definition brought_under_tilt (s x y i j k : Q) : three Q := by_line force (above i j k) (tilted s x y).

Definition closed_form_under_tilt (s x y i j k : Q) : three Q :=
  by_line transmitted (brought_under_tilt s x y i j k) (tilted s x y).

(** All spheres of L layers are in balance if and only if all forces are those of the closed form. *)
Theorem closed_form_under_tilt_is_the_only_solution : forall s x y f L, ~ 1 + s == 0 ->
  ((forall k i j, (k < L)%nat -> occupied k i j = true ->
     left_over s (leaning x y) (f k i j) (directions s) (received f k i j) (directions s) =v= nothing)
   <->
   (forall k i j, (k < L)%nat -> occupied k i j = true ->
     f k i j =3= closed_form_under_tilt s x y (q i) (q j) (n_of k))).
Proof.
  intros s x y f L Hs. split.
  - intros H k. induction k as [k IH] using lt_wf_ind. intros i j HL Ho.
    rewrite (proj1 (loaded_sphere s Plus _ _ _ Hs) (H k i j HL Ho)). apply passed_of_same.
    apply received_of_counts; [assumption|]. intros. apply IH; [assumption | lia | assumption].
  - intros H k i j HL Ho. apply (loaded_sphere s Plus _ _ _ Hs).
    rewrite (H k i j HL Ho). apply passed_of_same. symmetry.
    apply received_of_counts; [assumption|]. intros. apply H; [lia | assumption].
Qed.

(** The force of bottom sphere (i, j) of L layers on the floor, in f0. *)
Definition on_floor_under_tilt (s x y L i j : Q) : vector :=
  let w := weight (increments s) in
  under_load w (leaning x y) (support_load (brought_under_tilt s x y i j (L - 1)) (directions s) w).

(** Any forces that balance all spheres have this force on the floor. *)
Theorem on_floor_under_tilt_is_what_arrives : forall s x y f L i j, ~ 1 + s == 0 ->
  (forall k a b, (k < L)%nat -> occupied k a b = true ->
    left_over s (leaning x y) (f k a b) (directions s) (received f k a b) (directions s) =v= nothing) ->
  occupied L i j = true ->
  let w := weight (increments s) in
  under_load w (leaning x y) (support_load (received f L i j) (directions s) w)
  =v= on_floor_under_tilt s x y (n_of (S L)) (q i) (q j).
Proof.
  intros s x y f L i j Hs H Ho. cbv zeta.
  assert (R : received f L i j =3= by_line force (above (q i) (q j) (n_of L)) (tilted s x y)).
  { apply received_of_counts; [assumption|].
    intros m a b Hm Hab. apply (closed_form_under_tilt_is_the_only_solution s x y f L Hs); assumption. }
  unfold on_floor_under_tilt, brought_under_tilt, under_load. destruct (received f L i j) as [a b c].
  destruct (tilted s x y) as [u v w]. destruct R as (A & B & C). formulas_in A. formulas_in B. formulas_in C.
  formulas. rewrite A, B, C, n_of_S. repeat split; ring.
Qed.

(** ** Sums of polynomials by their values

    A polynomial of degree 2 in i and j is determined by its values at (0, 0), (1, 0), (-1, 0), (0, 1), (0, -1) and
    (1, 1), and so is its sum over a layer. *)

Definition quadratic (p q r t u v i j : Q) : Q := p + q * i + r * j + t * i * i + u * i * j + v * j * j.

Ltac opened ::=
  unfold quadratic, on_floor_under_tilt, brought_under_tilt, under_load, tilted, leaning, from_axis_squared, place; formulas.

Lemma total_of_quadratic : forall p q r t u v k,
  total_over_layer k (quadratic p q r t u v)
  == (n_of k + 1) * (n_of k + 2) * (1 # 2)
     * (p + n_of k * (1 # 3) * (q + r) + n_of k * (n_of k + 1) * (1 # 6) * (t + v)
        + n_of k * (n_of k - 1) * (1 # 12) * u).
Proof.
  intros p q r t u v k.
  over_layer
    ((fun K j x : Q => p * x + r * j * x + v * j * j * x + (q + u * j) * x * (x - 1) * (1 # 2)
      + t * (x - 1) * x * (2 * x - 1) * (1 # 6)) (n_of k))
    ((fun K y : Q => p * (2 * K * y - y * y + 3 * y) * (1 # 2)
      + q * y * (3 * K * K - 3 * K * y + 6 * K + y * y - 3 * y + 2) * (1 # 6)
      + r * y * (y - 1) * (3 * K - 2 * y + 4) * (1 # 6)
      + t * y * (2 * K - y + 2) * (2 * K * K - 2 * K * y + 4 * K + y * y - 2 * y + 1) * (1 # 12)
      + u * y * (y - 1) * (6 * K * K - 8 * K * y + 10 * K + 3 * y * y - 7 * y + 2) * (1 # 24)
      + v * y * (y - 1) * (4 * K * y - 2 * K - 3 * y * y + 7 * y - 2) * (1 # 12)) (n_of k)).
  closed.
Qed.

Lemma total_over_layer_of_same : forall k f g, (forall i j, f i j == g i j) ->
  total_over_layer k f == total_over_layer k g.
Proof. intros k f g H. apply total_of_same. intros. apply total_of_same. intros. apply H. Qed.

Lemma total_by_values : forall (f : Q -> Q -> Q),
  let p := f 0 0 in
  let even a b := (a + b) * (1 # 2) - p in
  let odd a b := (a - b) * (1 # 2) in
  let q := odd (f 1 0) (f (- (1)) 0) in let t := even (f 1 0) (f (- (1)) 0) in
  let r := odd (f 0 1) (f 0 (- (1))) in let v := even (f 0 1) (f 0 (- (1))) in
  let u := f 1 1 - f 1 0 - f 0 1 + p in
  (forall i j, f i j == quadratic p q r t u v i j) ->
  forall k, total_over_layer k f
    == (n_of k + 1) * (n_of k + 2) * (1 # 2)
       * (p + n_of k * (1 # 3) * (q + r) + n_of k * (n_of k + 1) * (1 # 6) * (t + v)
          + n_of k * (n_of k - 1) * (1 # 12) * u).
Proof. intros f. cbv zeta. intros H k. rewrite <- total_of_quadratic. apply total_over_layer_of_same. exact H. Qed.

(** Likewise for a polynomial of degree 1 in i, j and k, over a pile. *)
Lemma total_over_pile_by_values : forall (f : Q -> Q -> Q -> Q),
  let p := f 0 0 0 in
  let q := f 1 0 0 - p in let r := f 0 1 0 - p in let t := f 0 0 1 - p in
  (forall i j k, f i j k == p + q * i + r * j + t * k) ->
  forall L, total_over_pile L f
    == n_of L * (n_of L + 1) * (n_of L + 2) * (1 # 6)
       * (p + (n_of L - 1) * (1 # 4) * (q + r) + (n_of L - 1) * (3 # 4) * t).
Proof.
  intros f. cbv zeta.
  generalize (f 0 0 0) as p, (f 1 0 0 - f 0 0 0) as q, (f 0 1 0 - f 0 0 0) as r, (f 0 0 1 - f 0 0 0) as t.
  intros p q r t H L.
  etransitivity;
    [apply (total_over_pile_is _
      (fun k => (k + 1) * (k + 2) * (1 # 2) * (p + t * k + k * (1 # 3) * (q + r)))
      (fun x => x * (x + 1) * (x + 2) * (1 # 6) * (p + (x - 1) * (1 # 4) * (q + r) + (x - 1) * (3 # 4) * t)))|].
  - intros k. transitivity (total_over_layer k (quadratic (p + t * n_of k) q r 0 0 0)).
    + apply total_over_layer_of_same. intros i j. rewrite H. unfold quadratic. ring.
    + rewrite total_of_quadratic. ring.
  - closed.
  - ring.
  - intros x. ring.
  - reflexivity.
Qed.

Ltac by_values := etransitivity; [apply total_by_values; intros; opened; ring|].
Ltac over_pile_by_values := etransitivity; [apply total_over_pile_by_values; intros; opened; ring|].

(** The forces on the floor sum to the loads of all spheres: their number times W (x, y, 1), for every s and every
    L = k+1. *)
Theorem total_under_tilt : forall s x y k,
  let load := spheres_3 (n_of (S k)) * weight (increments s) in
  let F i j := on_floor_under_tilt s x y (n_of k + 1) i j in
  total_over_layer k (fun i j => (F i j).(along_x)) == load * x /\
  total_over_layer k (fun i j => (F i j).(along_y)) == load * y /\
  total_over_layer k (fun i j => (F i j).(along_z)) == load.
Proof.
  intros s x y k. cbv zeta. repeat split; by_values; opened; rewrite n_of_S; ring.
Qed.

Definition cross (a b : vector) : vector :=
  Vector (a.(along_y) * b.(along_z) - a.(along_z) * b.(along_y))
    (a.(along_z) * b.(along_x) - a.(along_x) * b.(along_z))
    (a.(along_x) * b.(along_y) - a.(along_y) * b.(along_x)).

(** They have the moment of the loads of all spheres about each axis through the apex. *)
Theorem moment_under_tilt : forall s x y k,
  let w := weight (increments s) in
  let of_floor axis := total_over_layer k (fun i j =>
    axis (cross (on_floor_under_tilt s x y (n_of k + 1) i j) (place s i j (n_of k)))) in
  let of_loads axis := total_over_pile (S k) (fun i j m =>
    axis (cross (Vector (x * w) (y * w) w) (place s i j m))) in
  of_floor along_x == of_loads along_x /\ of_floor along_y == of_loads along_y /\ of_floor along_z == of_loads along_z.
Proof.
  intros s x y k. cbv zeta. unfold cross.
  repeat split; by_values; symmetry; over_pile_by_values; opened; rewrite n_of_S; ring.
Qed.
