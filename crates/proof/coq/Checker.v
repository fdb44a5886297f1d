(** A checker of certificates, and the proof that it accepts true statements only. It is extracted as a program. *)

From Coq Require Import ZArith QArith Qabs Qreduction Setoid Morphisms Lia Lqa Bool List SetoidList.
From Coq Require Import OrderedType OrderedTypeEx FMapAVL FMapFacts.
From Cannonpile Require Import Directions Sums Formulas Balance Stackings Regions Horizontal Loads Virtual Pile.

Import ListNotations.
Open Scope Q_scope.

Set Default Proof Using "Type".

(** ** Trees of spheres, from the top of the pile *)

Module Site := PairOrderedType Z_as_OT Z_as_OT.
Module Sphere := PairOrderedType Z_as_OT Site.
Module M := FMapAVL.Make Sphere.
Module Facts := FMapFacts.WFacts M.

Lemma same_key : forall p r : sphere, M.E.eq p r <-> p = r.
Proof.
  intros [k [i j]] [k' [i' j']]. split.
  - intros (K & I & J). cbn in *. congruence.
  - intros E. injection E; intros; subst. repeat split.
Qed.

Lemma key_dec : forall A (p r : sphere) (a b : A), (if M.E.eq_dec p r then a else b) = if same_sphere p r then a else b.
Proof.
  intros. destruct (M.E.eq_dec p r) as [E | E], (same_sphere p r) as [N | N]; auto.
  - destruct N. apply same_key. exact E.
  - destruct E. apply same_key. exact N.
Qed.

Definition set_of (l : list sphere) : M.t unit := fold_left (fun m p => M.add p tt m) l (M.empty unit).

Lemma set_of_iff : forall l p, M.mem p (set_of l) = true <-> In p l.
Proof.
  intros l p. unfold set_of.
  assert (G : forall m, M.mem p (fold_left (fun m p => M.add p tt m) l m) = true <-> In p l \/ M.mem p m = true).
  { induction l as [|r l IH]; intros m; cbn [fold_left]; [simpl; tauto|]. rewrite IH, Facts.add_b, orb_true_iff.
    unfold Facts.eqb. rewrite key_dec. destruct (same_sphere r p); simpl; intuition congruence. }
  rewrite G, Facts.empty_a. intuition discriminate.
Qed.

(** A list without repetitions, sorted. *)
Definition distinct (l : list sphere) : list sphere := List.map fst (M.elements (set_of l)).

Lemma distinct_iff : forall l p, In p (distinct l) <-> In p l.
Proof.
  intros l p. transitivity (M.In p (set_of l)); [|rewrite Facts.mem_in_iff; apply set_of_iff].
  unfold distinct. rewrite in_map_iff. split.
  - intros ([r []] & E & H). cbn in E. subst. exists tt. apply Facts.elements_mapsto_iff. apply InA_alt. exists (p, tt).
    split; [split; [apply same_key | ]; reflexivity | exact H].
  - intros [[] H]. apply Facts.elements_mapsto_iff in H. apply InA_alt in H. destruct H as ([r []] & [E _] & H).
    exists (r, tt). split; [symmetry; apply same_key; exact E | exact H].
Qed.

Lemma distinct_once : forall l, NoDup (distinct l).
Proof.
  intros l. unfold distinct. assert (N := M.elements_3w (set_of l)). induction N as [|[p []] r H N IH]; cbn; constructor.
  - rewrite in_map_iff. intros ([q []] & E & I). cbn in E. subst. apply H. apply InA_alt. exists (p, tt).
    split; [apply same_key; reflexivity | exact I].
  - exact IH.
Qed.

(** ** The spheres of a pile *)

Definition lines (kind : kind) : list direction := filter (has_line kind) [Alpha; Beta; Gamma].

Lemma lines_iff : forall kind d, In d (lines kind) <-> has_line kind d = true.
Proof. intros kind d. unfold lines. rewrite filter_In. destruct d; simpl; tauto. Qed.

Definition axes : list axis := [AB; AG; GB].

Lemma axes_all : forall x, In x axes.
Proof. intros []; simpl; tauto. Qed.

(** The supports of a layer. *)
Definition supports (kind : kind) (sigma : sign) (l : list sphere) : list sphere :=
  distinct (flat_map (fun p => List.map (support_of sigma p) (lines kind)) l).

Theorem supports_iff : forall kind sigma l p,
  In p (supports kind sigma l) <-> exists r d, In r l /\ has_line kind d = true /\ p = support_of sigma r d.
Proof.
  intros. unfold supports. rewrite distinct_iff, in_flat_map. split.
  - intros (r & H & E). apply in_map_iff in E. destruct E as (d & E & D). apply lines_iff in D. exists r, d. auto.
  - intros (r & d & H & D & E). exists r. split; [exact H|]. apply in_map_iff. exists d. split; [auto | apply lines_iff; exact D].
Qed.

(** The spheres that a layer supports. *)
Definition supported (kind : kind) (sigma : sign) (l : list sphere) : list sphere :=
  let m := set_of l in
  filter (fun p => forallb (fun d => M.mem (support_of sigma p d) m) (lines kind))
    (List.map (fun r => ((fst r - 1)%Z, snd r)) l).

Theorem supported_iff : forall kind sigma l p,
  In p (supported kind sigma l) <-> forall d, has_line kind d = true -> In (support_of sigma p d) l.
Proof.
  intros kind sigma l [k [i j]]. unfold supported. rewrite filter_In, forallb_forall. split.
  - intros [_ H] d D. apply set_of_iff. apply H. apply lines_iff. exact D.
  - intros H. split.
    + apply in_map_iff. exists (support_of sigma (k, (i, j)) Alpha). split.
      * unfold support_of, support. cbn [fst snd]. destruct sigma; cbn [descent fst snd]; repeat (apply (f_equal2 pair); [lia|]); lia.
      * apply H. destruct kind; reflexivity.
    + intros d D. apply set_of_iff. apply H. apply lines_iff. exact D.
Qed.

Fixpoint range (n : nat) (a : Z) : list Z :=
  match n with O => [] | S n => a :: range n (a + 1) end.

Lemma range_iff : forall n a x, In x (range n a) <-> (a <= x < a + Z.of_nat n)%Z.
Proof.
  induction n as [|n IH]; intros a x; cbn [range In].
  - lia.
  - rewrite IH. lia.
Qed.

Definition from_to (a b : Z) : list Z := range (Z.to_nat (b - a + 1)) a.

(** The sites of layer k in a region, which has bounds of i, j and i+j. *)
Definition in_region (lower upper : three Z) (k : Z) : list sphere :=
  filter (fun p => inside lower upper (fst (snd p)) (snd (snd p)))
    (flat_map (fun i => List.map (fun j => (k, (i, j))) (from_to lower.(beta) upper.(beta))) (from_to lower.(alpha) upper.(alpha))).

Theorem in_region_iff : forall lower upper k p,
  In p (in_region lower upper k) <-> fst p = k /\ inside lower upper (fst (snd p)) (snd (snd p)) = true.
Proof.
  intros lower upper k [m [i j]]. unfold in_region. rewrite filter_In, in_flat_map. cbn [fst snd]. split.
  - intros [(a & _ & H) I]. apply in_map_iff in H. destruct H as (b & E & _). injection E; intros; subst. auto.
  - intros [K I]. subst. split; [|exact I]. apply inside_iff in I. exists i. split.
    + unfold from_to. apply range_iff. lia.
    + apply in_map_iff. exists j. split; [reflexivity|]. unfold from_to. apply range_iff. lia.
Qed.

(** A pile is built downwards from a top, or upwards from a base: each layer follows from the one before. *)
Fixpoint grown (next : sign -> list sphere -> list sphere) (signs : list sign) (l : list sphere) : list (list sphere) :=
  l :: match signs with [] => [] | sigma :: signs => grown next signs (next sigma l) end.

Theorem grown_are : forall next signs l n, (n < length signs)%nat ->
  nth (S n) (grown next signs l) [] = next (nth n signs Plus) (nth n (grown next signs l) []).
Proof.
  intros next signs. induction signs as [|sigma signs IH]; intros l n H; cbn [length] in H; [lia|].
  destruct n as [|n].
  - cbn [grown nth]. destruct signs; reflexivity.
  - change (nth (S n) (grown next signs (next sigma l)) []
      = next (nth n signs Plus) (nth n (grown next signs (next sigma l)) [])).
    apply IH. lia.
Qed.

(** ** A pile as it is written in a certificate *)

Record pile := Pile {
  of_kind : kind;
  signs : list sign;
  is_under_top : bool;
  lower : three Z;
  upper : three Z;
  ordinary_weight : Q;
  tilt_x : Q;
  tilt_y : Q;
  weights : M.t Q;
  loads : M.t vector
}.

Definition layers (p : pile) : list (list sphere) :=
  if p.(is_under_top) then grown (supports p.(of_kind)) p.(signs) (in_region p.(lower) p.(upper) 0)
  else rev (grown (supported p.(of_kind)) (rev p.(signs)) (in_region p.(lower) p.(upper) (Z.of_nat (length p.(signs))))).

(** The spheres above the floor, and the bottom layer. *)
Definition above_floor (layers : list (list sphere)) : list sphere := distinct (concat (removelast layers)).
Definition free (p : pile) : list sphere := above_floor (layers p).
Definition bottom (p : pile) : list sphere := List.last (layers p) [].

(** The signs of the steps in a tree. *)
Fixpoint indexed (k : Z) (signs : list sign) : M.t sign :=
  match signs with [] => M.empty sign | sigma :: signs => M.add (k, (0, 0)%Z) sigma (indexed (k + 1) signs) end.

Definition step_in (m : M.t sign) (k : Z) : sign :=
  match M.find (Z.max k 0, (0, 0)%Z) m with Some sigma => sigma | None => Plus end.

Lemma find_added : forall A (m : M.t A) p r x,
  M.find r (M.add p x m) = if same_sphere p r then Some x else M.find r m.
Proof.
  intros. rewrite Facts.add_o. apply key_dec.
Qed.

Theorem step_is : forall signs k, step_in (indexed 0 signs) k = nth (Z.to_nat k) signs Plus.
Proof.
  intros signs k. unfold step_in.
  assert (G : forall l a n, (a <= n)%Z ->
    match M.find (n, (0, 0)%Z) (indexed a l) with Some s => s | None => Plus end = nth (Z.to_nat (n - a)) l Plus).
  { intros l. induction l as [|sigma l IH]; intros a n H; cbn [indexed].
    - rewrite Facts.empty_o. destruct (Z.to_nat (n - a)); reflexivity.
    - rewrite find_added. destruct (same_sphere (a, (0, 0)%Z) (n, (0, 0)%Z)) as [E | E].
      + injection E; intros; subst. rewrite Z.sub_diag. reflexivity.
      + assert (a <> n) by congruence. rewrite IH by lia.
        replace (Z.to_nat (n - a)) with (S (Z.to_nat (n - (a + 1)))) by lia. reflexivity. }
  rewrite G by lia. rewrite Z.sub_0_r. f_equal. lia.
Qed.

Definition load_in (p : pile) (r : sphere) : vector :=
  let w := match M.find r p.(weights) with Some w => w | None => p.(ordinary_weight) end in
  let l := match M.find r p.(loads) with Some l => l | None => nothing end in
  Vector (w * p.(tilt_x) + l.(along_x)) (w * p.(tilt_y) + l.(along_y)) (w + l.(along_z)).

Definition look (m : M.t (three Q)) (p : sphere) : three Q :=
  match M.find p m with Some t => t | None => each 0 end.

(** Horizontal forces: the axes are in the order of the components. *)
Definition along (m : M.t (three Q)) (x : axis) (p : sphere) : Q :=
  let t := look m p in match x with AB => t.(alpha) | AG => t.(beta) | GB => t.(gamma) end.

Definition count (kind : kind) : Q := match kind with Discs => 2 | _ => 3 end.

(** The force of the pile and of the load on a bottom sphere, which the floor balances: along x, along y, and the normal
    force, in mg tan theta, 2 cos phi mg tan theta and mg. *)
Definition floor_force (kind : kind) (step : Z -> sign) (has : sphere -> bool) (load : sphere -> vector)
  (f : sphere -> three Q) (b : sphere) : vector :=
  let r := resultant (arriving_at kind step has f b) (contact_directions kind (step (fst b - 1)%Z)) in
  let w := weight (increments (sine kind)) in
  let l := load b in
  Vector (r.(along_x) / w + l.(along_x)) (r.(along_y) / w + l.(along_y)) (r.(along_z) / w + l.(along_z)).

(** ** Statements *)

Inductive claim :=
  | Forces (given : M.t (three Q)) (on_floor : M.t vector) (within : Q) (is_compressive : bool)
  | Stands
  | CannotStand
  | Bound (sigma : sign) (at_sphere : sphere) (normal : Q) (is_attained : bool)
  | Elastic (ratio : Q).

Record certificate := Certificate {
  about : pile;
  says : claim;
  horizontal : list (axis * sphere);
  pushing : M.t (three Q);
  fields : M.t (three Q)
}.

Section Certificate.
Variable c : certificate.

Definition kind_of := c.(about).(of_kind).
Definition spheres_of := free c.(about).
Definition tree := set_of spheres_of.
Definition step_of := step_in (indexed 0 c.(about).(signs)).
Definition load_of := load_in c.(about).
Definition push_given := along c.(pushing).
Definition phi_given := look c.(fields).

Definition in_equilibrium := equilibrium_of kind_of step_of spheres_of load_of (fun p => M.mem p tree).
Definition is_compressed := compressive kind_of spheres_of (fun p => M.mem p tree).

Definition normal_force (f : sphere -> three Q) (b : sphere) : Q :=
  (load_of b).(along_z) + load_on_floor kind_of step_of (fun p => M.mem p tree) f b / count kind_of.

Definition force_on_floor := floor_force kind_of step_of (fun p => M.mem p tree) load_of.

Definition close (within x y : Q) : Prop := Qabs (x - y) <= within.

Definition statement : Prop :=
  match c.(says) with
  | Forces given on_floor within is_compressive =>
    exists f, in_equilibrium f push_given /\
      (forall g, in_equilibrium g push_given -> forall p, In p spheres_of -> g p =3= f p) /\
      (forall p, In p spheres_of -> exists t, M.find p given = Some t /\ forall d, close within (on d t) (on d (f p))) /\
      (forall b, In b (bottom c.(about)) -> exists v, M.find b on_floor = Some v /\
        close within v.(along_x) (force_on_floor f b).(along_x) /\ close within v.(along_y) (force_on_floor f b).(along_y) /\
        close within v.(along_z) (force_on_floor f b).(along_z)) /\
      (if is_compressive then is_compressed f push_given else ~ is_compressed f push_given)
  | Stands => exists f X, in_equilibrium f X /\ is_compressed f X
  | CannotStand => forall f X, in_equilibrium f X -> ~ is_compressed f X
  | Bound sigma b normal is_attained =>
    In b (bottom c.(about)) /\
    (forall f X, in_equilibrium f X -> is_compressed f X -> 0 <= times sigma (normal - normal_force f b)) /\
    (is_attained = true -> exists f X, in_equilibrium f X /\ is_compressed f X /\ normal_force f b == normal)
  | Elastic ratio => 0 < ratio /\
    exists f, in_equilibrium f push_given /\ is_compressed f push_given /\
      forall g Y, in_equilibrium g Y -> is_compressed g Y ->
        energy_of kind_of spheres_of (fun p => M.mem p tree) ratio f push_given
        <= energy_of kind_of spheres_of (fun p => M.mem p tree) ratio g Y
  end.
End Certificate.

(** ** The checker *)

Definition at_least_zero (x : Q) : bool := Qle_bool 0 x.
Definition equal_three (s t : three Q) : bool :=
  Qeq_bool s.(alpha) t.(alpha) && Qeq_bool s.(beta) t.(beta) && Qeq_bool s.(gamma) t.(gamma).

Lemma equal_three_iff : forall s t, equal_three s t = true <-> s =3= t.
Proof. intros. unfold equal_three, same. rewrite !andb_true_iff, !Qeq_bool_iff. tauto. Qed.

Definition total_of (l : list sphere) (f : sphere -> Q) : Q := fold_left (fun sum p => Qred (sum + f p)) l 0.

Lemma total_of_is : forall l f, total_of l f == over l f.
Proof.
  intros l f. unfold total_of.
  assert (G : forall a, fold_left (fun sum p => Qred (sum + f p)) l a == a + over l f).
  { induction l as [|p l IH]; intros a; cbn [fold_left over]; [ring|]. rewrite IH, Qred_correct. ring. }
  rewrite G. ring.
Qed.

Definition sign_eqb (s t : sign) : bool := match s, t with Plus, Plus | Minus, Minus => true | _, _ => false end.

Definition fits_b (kind : kind) (from to : sign) (load : vector) : bool :=
  match kind with
  | Equilateral => true
  | Isosceles s => negb (Qeq_bool (1 + s) 0) && sign_eqb from Plus && sign_eqb to Plus
  | Discs => sign_eqb from Plus && sign_eqb to Plus && Qeq_bool load.(along_y) 0
  end.

Lemma fits_b_is : forall kind from to load, fits_b kind from to load = true -> fits kind from to load.
Proof.
  intros [|s|] [] [] load; cbn [fits_b fits sign_eqb andb]; rewrite ?andb_false_r, ?andb_true_r; intros H; try discriminate H; auto.
  - split; [|auto]. intros E. apply Qeq_bool_iff in E. rewrite E in H. discriminate H.
  - apply Qeq_bool_iff in H. auto.
Qed.

Definition close_b (within x y : Q) : bool := Qle_bool (Qabs (x - y)) within.

Lemma close_b_iff : forall within x y, close_b within x y = true <-> close within x y.
Proof. intros. apply Qle_bool_iff. Qed.

Section Checker.
Variable kind : kind.
Variable step : Z -> sign.
Variable spheres : list sphere.
Variable load : sphere -> vector.
Variable has : sphere -> bool.
Variable X : axis -> sphere -> Q.
Variable phi : sphere -> three Q.

Definition all_fit_b : bool :=
  forallb (fun p => (0 <=? fst p)%Z && fits_b kind (step_over step p) (step_under step p) (load p)) spheres.

(** The forces, from the top down. Nothing is proved about this function: [solved] checks its result. *)
Definition solve : M.t (three Q) :=
  fold_left (fun f p => M.add p (map Qred (transmits_at kind step load has (look f) X p)) f) spheres (M.empty (three Q)).

Definition solved (f : M.t (three Q)) : bool :=
  forallb (fun p => equal_three (look f p) (transmits_at kind step load has (look f) X p)) spheres.

Definition all_push (f : M.t (three Q)) : bool :=
  forallb (fun p =>
    let t := look f p in
    at_least_zero t.(alpha) && at_least_zero t.(beta) && at_least_zero t.(gamma)
    && forallb (fun x => negb (touching kind has x p) || at_least_zero (X x p)) axes) spheres.

Definition one_sided (sigma : sign) (bears : sphere -> direction -> Q) : bool :=
  forallb (fun p =>
    forallb (fun d => at_least_zero (times sigma (drop_of kind step has phi p d - bears p d))) (lines kind)
    && forallb (fun x => negb (touching kind has x p) || at_least_zero (times sigma (squeeze_of step phi x p))) axes) spheres.

Definition work : Q := total_of spheres (fun p => dot (phi p) (own_increments kind (load p) (step_under step p))).

Definition optimal_at (wanted is : Q) : bool := Qle_bool wanted is && (Qeq_bool is 0 || Qeq_bool wanted is).

Definition optimal_b (ratio : Q) (f : M.t (three Q)) : bool :=
  forallb (fun p =>
    forallb (fun d => optimal_at (drop_of kind step has phi p d) (on d (look f p))) (lines kind)
    && forallb (fun x => negb (touching kind has x p) || optimal_at (ratio * squeeze_of step phi x p) (X x p)) axes) spheres.

Hypothesis has_iff : forall p, has p = true <-> In p spheres.
Hypothesis once : NoDup spheres.

Lemma all_fit_is : all_fit_b = true -> forall p, In p spheres -> (0 <= fst p)%Z /\ fits kind (step_over step p) (step_under step p) (load p).
Proof.
  unfold all_fit_b. rewrite forallb_forall. intros H p I. specialize (H p I). apply andb_true_iff in H.
  destruct H as [K F]. split; [apply Z.leb_le; exact K | apply fits_b_is; exact F].
Qed.

Lemma solved_is : all_fit_b = true -> forall f, solved f = true -> equilibrium_of kind step spheres load has (look f) X.
Proof using has_iff.
  intros A f S p I. apply (balance_is_transmission kind step spheres load has (fun p I => proj2 (all_fit_is A p I)) _ _ p I).
  unfold solved in S. rewrite forallb_forall in S. apply equal_three_iff. apply S. exact I.
Qed.

Lemma axes_b : forall p (good : axis -> bool) x,
  forallb (fun x => negb (touching kind has x p) || good x) axes = true -> touching kind has x p = true -> good x = true.
Proof.
  intros p good x H T. rewrite forallb_forall in H. specialize (H x (axes_all x)). rewrite T in H. exact H.
Qed.

Lemma all_push_iff : forall f, all_push f = true <-> compressive kind spheres has (look f) X.
Proof.
  intros f. unfold all_push, at_least_zero. rewrite forallb_forall. split.
  - intros H p I. specialize (H p I). cbv zeta in H. rewrite !andb_true_iff, !Qle_bool_iff in H. destruct H as [[[A B] C] D].
    split; [intros []; assumption|]. intros x T. apply Qle_bool_iff. exact (axes_b p (fun x => Qle_bool 0 (X x p)) x D T).
  - intros H p I. destruct (H p I) as [F G]. cbv zeta. rewrite !andb_true_iff, !Qle_bool_iff.
    repeat split; [apply (F Alpha) | apply (F Beta) | apply (F Gamma) |].
    apply forallb_forall. intros x _. destruct (touching kind has x p) eqn:T; [|reflexivity]. apply Qle_bool_iff. exact (G x T).
Qed.

Lemma one_sided_is : forall sigma bears, one_sided sigma bears = true ->
  (forall p d, In p spheres -> has_line kind d = true -> 0 <= times sigma (drop_of kind step has phi p d - bears p d)) /\
  (forall p x, In p spheres -> touching kind has x p = true -> 0 <= times sigma (squeeze_of step phi x p)).
Proof.
  intros sigma bears H. unfold one_sided in H. rewrite forallb_forall in H. split.
  - intros p d I D. specialize (H p I). apply andb_true_iff in H. destruct H as [H _]. rewrite forallb_forall in H.
    apply Qle_bool_iff. apply H. apply lines_iff. exact D.
  - intros p x I T. specialize (H p I). apply andb_true_iff in H. destruct H as [_ H].
    apply Qle_bool_iff. exact (axes_b p (fun x => at_least_zero (times sigma (squeeze_of step phi x p))) x H T).
Qed.

Lemma optimal_at_is : forall wanted is, optimal_at wanted is = true -> wanted <= is /\ (is == 0 \/ wanted == is).
Proof. intros wanted is. unfold optimal_at. rewrite andb_true_iff, orb_true_iff, Qle_bool_iff, !Qeq_bool_iff. tauto. Qed.

Lemma optimal_is : forall ratio f, optimal_b ratio f = true -> optimal kind step spheres has phi ratio (look f) X.
Proof.
  intros ratio f H. unfold optimal_b in H. rewrite forallb_forall in H. split.
  - intros p d I D. specialize (H p I). apply andb_true_iff in H. destruct H as [H _]. rewrite forallb_forall in H.
    apply optimal_at_is. apply H. apply lines_iff. exact D.
  - intros p x I T. specialize (H p I). apply andb_true_iff in H. destruct H as [_ H].
    apply optimal_at_is. exact (axes_b p (fun x => optimal_at (ratio * squeeze_of step phi x p) (X x p)) x H T).
Qed.

Lemma work_is : work == work_of_loads kind step spheres load phi.
Proof. apply total_of_is. Qed.
End Checker.

(** Claims about horizontal contacts need neighbours that touch. *)
Definition has_neighbours (kind : kind) (says : claim) : bool :=
  match kind, says with Isosceles _, Forces _ _ _ _ => true | Isosceles _, _ => false | _, _ => true end.

(** True only if the statement of the certificate is true. *)
Definition check (c : certificate) : bool :=
  let p := c.(about) in
  let kind := p.(of_kind) in
  let all := layers p in
  let floor := List.last all [] in
  let spheres := above_floor all in
  let tree := set_of spheres in
  let has r := M.mem r tree in
  let signs := indexed 0 p.(signs) in
  let step := step_in signs in
  let load := load_in p in
  let X := along c.(pushing) in
  let phi := look c.(fields) in
  let base := set_of floor in
  let f := solve kind step spheres load has X in
  let is_solved := solved kind step spheres load has X f in
  let pushing_all := all_push kind spheres has X f in
  all_fit_b kind step spheres load && has_neighbours kind c.(says)
  && forallb (fun e => has (snd e) && touching kind has (fst e) (snd e) && at_least_zero (X (fst e) (snd e))) c.(horizontal)
  && forallb (fun e => has (fst e)) (M.elements c.(fields))
  && match c.(says) with
     | Forces given on_floor within is_compressive =>
       is_solved && Bool.eqb pushing_all is_compressive
       && (length spheres =? M.cardinal given)%nat && (M.cardinal base =? M.cardinal on_floor)%nat
       && forallb (fun r => match M.find r given with
            | Some t => forallb (fun d => close_b within (on d t) (on d (look f r))) [Alpha; Beta; Gamma]
            | None => false end) spheres
       && forallb (fun b => match M.find b on_floor with
            | Some v => let e := floor_force kind step has load (look f) b in
              close_b within v.(along_x) e.(along_x) && close_b within v.(along_y) e.(along_y)
              && close_b within v.(along_z) e.(along_z)
            | None => false end) floor
     | Stands => is_solved && pushing_all
     | CannotStand => one_sided kind step spheres has phi Minus (fun _ _ => 0) && negb (Qle_bool (work kind step spheres load phi) 0)
     | Bound sigma b normal is_attained =>
       M.mem b base && one_sided kind step spheres has phi sigma (bears_on kind step b)
       && Qeq_bool normal ((load b).(along_z) + work kind step spheres load phi / count kind)
       && (negb is_attained || is_solved && pushing_all
           && Qeq_bool normal ((load b).(along_z) + load_on_floor kind step has (look f) b / count kind))
     | Elastic ratio =>
       negb (Qle_bool ratio 0) && is_solved && pushing_all && optimal_b kind step spheres has X phi ratio f
     end.

Lemma positive_b : forall x, negb (Qle_bool x 0) = true -> 0 < x.
Proof.
  intros x H. apply Qnot_le_lt. intros L. apply Qle_bool_iff in L. rewrite L in H. discriminate H.
Qed.

Lemma count_is_positive : forall kind, 0 < / count kind.
Proof. intros []; reflexivity. Qed.

Lemma bound_of_normal : forall sigma kind u l n w, 0 <= times sigma (u - l) -> n == w + u / count kind ->
  0 <= times sigma (n - (w + l / count kind)).
Proof.
  intros sigma kind u l n w V W. rewrite W. unfold Qdiv. assert (K := count_is_positive kind).
  assert (Z : 0 <= / count kind * times sigma (u - l)) by (apply Qmult_le_0_compat; [apply Qlt_le_weak; exact K | exact V]).
  destruct sigma; cbn [times] in *; lra.
Qed.

(** The checker is sound. *)
Theorem accepted_statements_are_true : forall c, check c = true -> statement c.
Proof.
  intros c. unfold check, statement, in_equilibrium, is_compressed, normal_force, force_on_floor, push_given. cbv zeta.
  fold (free (about c)) (bottom (about c)).
  fold (spheres_of c) (kind_of c) (step_of c) (load_of c) (phi_given c) (tree c).
  rewrite !andb_true_iff. intros [[[[A _] _] _] H].
  set (f := solve (kind_of c) (step_of c) (spheres_of c) (load_of c) (fun r => M.mem r (tree c)) (along (pushing c))) in *.
  assert (I : forall p, M.mem p (tree c) = true <-> In p (spheres_of c)) by (intros; apply set_of_iff).
  assert (N : NoDup (spheres_of c)) by apply distinct_once.
  assert (T := fun p i => proj1 (all_fit_is _ _ _ _ A p i)). assert (G := fun p i => proj2 (all_fit_is _ _ _ _ A p i)).
  destruct (says c) as [given on_floor within is_compressive | | | sigma b normal is_attained | ratio].
  - rewrite !andb_true_iff in H. destruct H as [[[[[S P] _] _] Q] R].
    assert (E := solved_is _ _ _ _ _ _ I A f S). exists (look f). split; [exact E|]. split; [|split; [|split]].
    + intros g Eg p i. exact (forces_are_unique _ _ _ _ _ I T G g (look f) _ Eg E p i).
    + intros p i. rewrite forallb_forall in Q. specialize (Q p i). destruct (M.find p given) as [t|]; [|discriminate Q].
      exists t. split; [reflexivity|]. intros d. rewrite forallb_forall in Q. apply close_b_iff. apply Q. destruct d; simpl; tauto.
    + intros b i. rewrite forallb_forall in R. specialize (R b i). destruct (M.find b on_floor) as [v|]; [|discriminate R].
      exists v. cbv zeta in R. rewrite !andb_true_iff, !close_b_iff in R. tauto.
    + apply eqb_prop in P. destruct is_compressive.
      * apply all_push_iff. exact P.
      * intros C. apply all_push_iff in C. assert (W := eq_trans (eq_sym C) P). discriminate W.
  - rewrite andb_true_iff in H. destruct H as [S P]. exists (look f), (along (pushing c)).
    split; [exact (solved_is _ _ _ _ _ _ I A f S) | apply all_push_iff; exact P].
  - rewrite andb_true_iff in H. destruct H as [O W]. apply positive_b in W. rewrite work_is in W.
    destruct (one_sided_is _ _ _ _ _ _ _ O) as [D C]. intros g Y.
    apply (never_stands _ _ _ _ _ I N G (phi_given c) W).
    + intros p d i L. specialize (D p d i L). cbn [times] in D. lra.
    + intros p x i X. specialize (C p x i X). cbn [times] in C. lra.
  - rewrite !andb_true_iff in H. destruct H as [[[B O] W] R]. apply Qeq_bool_iff in W. rewrite work_is in W.
    destruct (one_sided_is _ _ _ _ _ _ _ O) as [D C]. split; [apply set_of_iff; exact B|]. split.
    + intros g Y Eg P. assert (V := bound_on_floor _ _ _ _ _ I N G (phi_given c) sigma b g Y Eg P D C).
      exact (bound_of_normal sigma _ _ _ _ _ V W).
    + intros T'. subst. cbn [negb orb] in R. rewrite !andb_true_iff in R. destruct R as [[S P] Q].
      exists (look f), (along (pushing c)). split; [exact (solved_is _ _ _ _ _ _ I A f S)|].
      split; [apply all_push_iff; exact P|]. apply Qeq_bool_iff in Q. symmetry. exact Q.
  - rewrite !andb_true_iff in H. destruct H as [[[R S] P] O]. apply positive_b in R. split; [exact R|].
    assert (E := solved_is _ _ _ _ _ _ I A f S). apply all_push_iff in P. apply optimal_is in O.
    exists (look f). split; [exact E|]. split; [exact P|]. intros g Y Eg Pg.
    exact (least_energy _ _ _ _ _ I N G (phi_given c) ratio (look f) _ g Y R E P O Eg Pg).
Qed.
