(** The conditioning of the equilibrium f = S f + w, in which S transfers the forces below each sphere to the spheres
    below: S is an isometry from layer to layer, I - S is unipotent, and a chain e, S e, S^2 e, ... has known singular
    values. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa Bool List Sorted Ring Ring_theory.
From Cannonpile Require Import Directions Sums Formulas Balance Stackings Horizontal Virtual Pile.
From Cannonpile Require Spectrum.

Import ListNotations.

Set Default Proof Using "Type".

(** ** Chains

    On a chain of length m, I - S is the matrix C with 1 on the diagonal and -1 below it. These statements hold in any
    commutative ring. *)
Declare Scope number_scope.

Section Chain.
Variable F : Type.
Variables (zero one : F) (add mul sub : F -> F -> F) (opp : F -> F) (eq : F -> F -> Prop).
Hypothesis equivalence : Equivalence eq.
Hypothesis congruence : ring_eq_ext add mul opp eq.
Hypothesis laws : ring_theory zero one add mul sub opp eq.

Add Ring numbers_of_chains : laws (setoid equivalence congruence).
Existing Instance equivalence.
#[local] Instance add_proper : Proper (eq ==> eq ==> eq) add := Radd_ext congruence.
#[local] Instance mul_proper : Proper (eq ==> eq ==> eq) mul := Rmul_ext congruence.
#[local] Instance opp_proper : Proper (eq ==> eq) opp := Ropp_ext congruence.

Infix "==" := eq : number_scope.
Infix "+" := add : number_scope.
Infix "*" := mul : number_scope.
Infix "-" := sub : number_scope.
Notation "- x" := (opp x) : number_scope.
Notation "0" := zero : number_scope.
Notation "1" := one : number_scope.
Open Scope number_scope.

#[local] Instance sub_proper : Proper (eq ==> eq ==> eq) sub.
Proof using congruence equivalence laws.
  intros a b H c d K. rewrite (Rsub_def laws a c), (Rsub_def laws b d), H, K. reflexivity.
Qed.

Fixpoint sum_to (m : nat) (f : nat -> F) : F := match m with O => 0 | S n => sum_to n f + f n end.

Definition before (v : nat -> F) (i : nat) : F := match i with O => 0 | S h => v h end.

(** Component i of C v and of C^T u. *)
Definition applied (v : nat -> F) (i : nat) : F := v i - before v i.
Definition transposed (m : nat) (u : nat -> F) (i : nat) : F := if (S i <? m)%nat then u i - u (S i) else u i.

Theorem transposed_is : forall u v m,
  sum_to m (fun i => u i * applied v i) == sum_to m (fun i => transposed m u i * v i).
Proof using congruence equivalence laws.
  intros u v [|n]; [reflexivity|]. cbn [sum_to]. unfold transposed at 2. rewrite Nat.ltb_irrefl.
  assert (G : forall m, (m <= n)%nat -> sum_to m (fun i => transposed (S n) u i * v i)
    == sum_to m (fun i => u i * applied v i) + u m * applied v m - u m * v m).
  { unfold applied. induction m as [|m IH]; intros H; cbn [sum_to before]; [ring|].
    rewrite IH by lia. unfold transposed. rewrite (proj2 (Nat.ltb_lt (S m) (S n))) by lia. ring. }
  rewrite (G n) by lia. ring.
Qed.

(** C^T C. *)
Definition gram (m : nat) (v : nat -> F) : nat -> F := transposed m (applied v).

Variable lambda : F.

(** The Chebyshev recursion v_(n+1) = (2 - lambda) v_n - v_(n-1) from v_0 = 1 and v_(-1) = 0: v_n and v_(n-1). *)
Fixpoint chebyshev (n : nat) : F * F :=
  match n with O => (1, 0) | S n => let (a, b) := chebyshev n in ((1 + 1 - lambda) * a - b, a) end.
Definition chain_vector (n : nat) : F := fst (chebyshev n).
Definition chain_remainder (m : nat) : F := fst (chebyshev m) - snd (chebyshev m).
Notation v := chain_vector.
Notation p := chain_remainder.

Lemma previous : forall n, snd (chebyshev n) = before v n.
Proof.
  intros [|n]; [reflexivity|]. cbn [before]. unfold chain_vector. cbn [chebyshev]. destruct (chebyshev n). reflexivity.
Qed.

Lemma following : forall n, v (S n) = (1 + 1 - lambda) * v n - before v n.
Proof.
  intros n. rewrite <- previous. unfold chain_vector. cbn [chebyshev]. destruct (chebyshev n). reflexivity.
Qed.

(** (C^T C - lambda) v = p_m e_m: only the last row does not vanish. *)
Theorem chain_rows : forall m i, (i < m)%nat -> gram m v i - lambda * v i == if (S i =? m)%nat then p m else 0.
Proof using congruence equivalence laws.
  intros m i H. unfold gram, transposed, applied. destruct (Nat.eqb_spec (S i) m) as [E | E].
  - subst m. rewrite Nat.ltb_irrefl. unfold chain_remainder. rewrite previous. fold (v (S i)). cbn [before].
    rewrite following. ring.
  - rewrite (proj2 (Nat.ltb_lt (S i) m)) by lia. cbn [before]. rewrite following. ring.
Qed.

(** So v is an eigenvector of C^T C if p_m = 0. *)
Theorem chain_eigenvector : forall m i, p m == 0 -> (i < m)%nat -> gram m v i == lambda * v i.
Proof using congruence equivalence laws.
  intros m i P H. assert (R := chain_rows m i H). destruct (S i =? m)%nat; rewrite ?P in R;
    transitivity (gram m v i - lambda * v i + lambda * v i); [ring | rewrite R; ring | ring | rewrite R; ring].
Qed.

(** Each eigenvector is a multiple of v, and u_0 p_m = 0: in a field p_m = 0, unless the eigenvector vanishes. *)
Theorem chain_eigenvectors : forall m u, (0 < m)%nat -> (forall i, (i < m)%nat -> gram m u i == lambda * u i) ->
  (forall i, (i < m)%nat -> u i == u O * v i) /\ u O * p m == 0.
Proof using congruence equivalence laws.
  intros m u M H.
  assert (G : forall i, (i < m)%nat -> u i == u O * v i /\ before u i == u O * before v i).
  { induction i as [|i IH]; intros L; [unfold chain_vector; cbn [before chebyshev fst]; split; ring|].
    destruct (IH ltac:(lia)) as [A B]. split; [|exact A].
    assert (R := H i ltac:(lia)). unfold gram, transposed, applied in R.
    rewrite (proj2 (Nat.ltb_lt (S i) m)) in R by lia. cbn [before] in R. rewrite following.
    transitivity ((1 + 1) * u i - before u i - (u i - before u i - (u (S i) - u i))); [ring|].
    rewrite R, B, A. ring. }
  split; [intros i L; apply G; exact L|].
  destruct m as [|i]; [lia|]. destruct (G i ltac:(lia)) as [A B]. assert (R := H i ltac:(lia)).
  unfold gram, transposed, applied in R. rewrite Nat.ltb_irrefl, B, A in R. unfold chain_remainder.
  rewrite previous. fold (v (S i)). cbn [before]. rewrite following.
  transitivity (u O * v i - u O * before v i - lambda * (u O * v i)); [ring|]. rewrite R. ring.
Qed.

Fixpoint power_of (x : F) (n : nat) : F := match n with O => 1 | S n => power_of x n * x end.

(** With lambda = (1 + z)^2/z: (z - 1) z^m p_m = (-1)^m (z^(2m+1) - 1). *)
Theorem chain_polynomial : forall z, lambda * z == (1 + z) * (1 + z) -> forall m,
  (z - 1) * power_of z m * p m == power_of (- (1)) m * (power_of z m * power_of z m * z - 1).
Proof using congruence equivalence laws.
  intros z Z m.
  assert (G : (z - 1) * power_of z m * p m == power_of (- (1)) m * (power_of z m * power_of z m * z - 1) /\
    (z * z - 1) * power_of z m * v m == power_of (- (1)) m * (power_of z m * power_of z m * z * z - 1)).
  { induction m as [|n [P V]]; [unfold chain_remainder, chain_vector; cbn [chebyshev fst snd power_of]; split; ring|].
    assert (E : p (S n) == p n - lambda * v n).
    { unfold chain_remainder. rewrite !previous. fold (v (S n)) (v n). cbn [before]. rewrite following. ring. }
    assert (N : (z - 1) * power_of z (S n) * p (S n)
      == power_of (- (1)) (S n) * (power_of z (S n) * power_of z (S n) * z - 1)).
    { rewrite E. cbn [power_of].
      transitivity (z * ((z - 1) * power_of z n * p n) - (z - 1) * power_of z n * v n * (lambda * z)); [ring|].
      rewrite P, Z. transitivity (z * (power_of (- (1)) n * (power_of z n * power_of z n * z - 1))
        - (1 + z) * ((z * z - 1) * power_of z n * v n)); [ring|]. rewrite V. ring. }
    split; [exact N|]. assert (W : v (S n) == v n + p (S n)).
    { unfold chain_remainder. rewrite previous. fold (v (S n)). cbn [before]. ring. }
    rewrite W. transitivity ((z * z - 1) * power_of z n * v n * z + (z + 1) * ((z - 1) * power_of z (S n) * p (S n))).
    - cbn [power_of]. ring.
    - rewrite N, V. cbn [power_of]. ring. }
  apply G.
Qed.

(** A root of unity, z^(2m+1) = 1, gives the eigenvalue (1 + z)^2/z. Of complex numbers, z = exp(2 pi i j/(2m+1)) gives
    4 cos^2(j pi/(2m+1)), j = 1 ... m, which are m different numbers (in words). *)
Theorem chain_eigenvalue : forall z inverse m, lambda * z == (1 + z) * (1 + z) ->
  power_of z m * power_of z m * z == 1 -> (z - 1) * inverse == 1 ->
  forall i, (i < m)%nat -> gram m v i == lambda * v i.
Proof using congruence equivalence laws.
  intros z inverse m Z R I i H. apply chain_eigenvector; [|exact H].
  transitivity (inverse * (power_of z m * z) * ((z - 1) * power_of z m * p m)
    + (1 - (z - 1) * inverse * (power_of z m * power_of z m * z)) * p m); [ring|].
  rewrite chain_polynomial by exact Z. rewrite R, I. ring.
Qed.
End Chain.

Open Scope Q_scope.

(** Q is such a ring. *)
Theorem chain_of_rationals : forall lambda m i, (i < m)%nat ->
  let v := chain_vector Q 0 1 Qplus Qmult Qminus lambda in
  gram Q 0 Qminus m v i - lambda * v i
  == if (S i =? m)%nat then chain_remainder Q 0 1 Qplus Qmult Qminus lambda m else 0.
Proof.
  apply (chain_rows Q 0 1 Qplus Qmult Qminus Qopp Qeq Q_Setoid (mk_reqe Qplus_comp Qmult_comp Qopp_comp) Qsrt).
Qed.

(** ** The turn

    On an equilateral base, the half turn keeps the scalar product of the three forces. *)
Lemma turned_keeps : forall kind from to g h, dot (turned kind from to g) (turned kind from to h) == dot g h.
Proof. intros [] [] [] [] []; unfold turned, transferred, dot; formulas; ring. Qed.

Lemma turned_twice : forall kind from to g, turned kind from to (turned kind from to g) =3= g.
Proof. intros [] [] [] []; unfold turned, transferred; by_components. Qed.

(** Other bases: piles with sin phi other than 1/2 are straight, so T = 1 and S only shifts. A single sphere whose
    supports are turned would transmit this, and keep the sum of f^2/w, with the increments w = (1, 1, 2s). *)
Definition reflected (s : Q) (g : three Q) : three Q :=
  by_line (fun w x => 2 * sum g * w / weight (increments s) - x) (increments s) g.

Theorem turn_of_any_base : forall s from g, ~ 1 + s == 0 ->
  unbalanced (reflected s g) (directions_under s (opposite from)) g (directions_under s from) 0 =v= nothing.
Proof.
  intros s [] [] H; unfold reflected, directions_under, opposite; repeat split; formulas; field;
    intro E; apply H; lra.
Qed.

Theorem metric_of_any_base : forall s g h, ~ 1 + s == 0 ->
  let product g h := 2 * s * (g.(alpha) * h.(alpha) + g.(beta) * h.(beta)) + g.(gamma) * h.(gamma) in
  product (reflected s g) (reflected s h) == product g h.
Proof. intros s [] [] H. cbv zeta. unfold reflected. formulas. field. intro E. apply H. lra. Qed.

Theorem turn_of_equilateral_base : forall g, reflected (1 # 2) g =3= half_turn g.
Proof. intros []. unfold reflected. repeat split; formulas; field. Qed.

(** ** The pile *)

Lemma over_filter : forall A (b : A -> bool) l f, over (filter b l) f == over l (fun x => if b x then f x else 0).
Proof. intros A b l f. induction l as [|x l IH]; cbn; [reflexivity|]. destruct (b x); cbn; rewrite IH; ring. Qed.

Section Transfer.
Variable of_kind : kind.
Variable step : Z -> sign.
Variable spheres : list sphere.
Variable has : sphere -> bool.
Hypothesis has_iff : forall p, has p = true <-> In p spheres.
Hypothesis once : NoDup spheres.

Notation received := (arriving_at of_kind step has).
Notation turn p := (turned of_kind (step_over step p) (step_under step p)).

(** S f: what a sphere without a load transmits, if f are the forces below all spheres. *)
Definition transfer (f : sphere -> three Q) (p : sphere) : three Q :=
  turn p (received f p).

Lemma received_on : forall f p d, on d (received f p) =
  if has_line of_kind d && has (above_of (step_over step p) p d) then on d (f (above_of (step_over step p) p d)) else 0.
Proof. intros f p []; reflexivity. Qed.

(** Newton's law for all spheres is f = S f + w. *)
Theorem equilibrium_is : forall load f p, In p spheres -> fits of_kind (step_over step p) (step_under step p) (load p) ->
  (balanced of_kind step load has f (fun _ _ => 0) p
   <-> f p =3= plus_three (transfer f p) (own_increments of_kind (load p) (step_under step p))).
Proof.
  intros load f p H T. unfold balanced. rewrite law; [|exact T|apply arriving_on_lines|..].
  - assert (E : transmits of_kind (step_over step p) (step_under step p) (load p) (received f p)
        (six (push_next of_kind has (fun _ _ => 0) p)) (six (push_last of_kind has (fun _ _ => 0) p))
      =3= plus_three (transfer f p) (own_increments of_kind (load p) (step_under step p))).
    { unfold transmits, transfer. generalize (turn p (received f p)) as t.
      generalize (own_increments of_kind (load p) (step_under step p)) as w.
      assert (N : forall x, push_next of_kind has (fun _ _ => 0) p x = 0)
        by (intros x; unfold push_next; destruct (touching of_kind has x p); reflexivity).
      assert (L : forall x, push_last of_kind has (fun _ _ => 0) p x = 0)
        by (intros x; unfold push_last; destruct (has_axis of_kind x && has (last_of x p))%bool; reflexivity).
      intros [w1 w2 w3] [t1 t2 t3]. unfold pushed_by, six, plus_three. cbn [ab ag gb]. rewrite !N, !L.
      destruct (step_under step p); by_components. }
    rewrite E. reflexivity.
  - apply pushes_on_axes.
  - apply pushes_on_axes.
Qed.

(** The parts of the forces that act on spheres of the list. The others act on the floor. *)
Definition above_spheres (f : sphere -> three Q) (p : sphere) : three Q :=
  let part d := if has (support_of (step_under step p) p d) then on d (f p) else 0 in
  Three (part Alpha) (part Beta) (part Gamma).

(** A contact has one lower end, and a sphere receives at most one force on each line. So S keeps scalar products, except
    that the floor receives the rest. *)
Theorem transfer_keeps : forall f g,
  (forall p, In p spheres -> on_lines of_kind (f p)) ->
  over spheres (fun p => dot (transfer f p) (transfer g p)) == over spheres (fun p => dot (above_spheres f p) (g p)).
Proof using has_iff once.
  intros f g F. pose (phi := fun p => transfer g p).
  transitivity (over spheres (fun p => on Alpha (received f p) * on Alpha (turn p (phi p)))
    + over spheres (fun p => on Beta (received f p) * on Beta (turn p (phi p)))
    + over spheres (fun p => on Gamma (received f p) * on Gamma (turn p (phi p)))).
  - rewrite <- !over_of_sum. apply over_of_same. intros p _. unfold transfer at 1, phi.
    rewrite <- (turned_keeps of_kind (step_over step p) (step_under step p)).
    etransitivity; [apply dot_of_same; reflexivity|].
    assert (T := turned_twice of_kind (step_over step p) (step_under step p) (received f p)).
    unfold dot. destruct T as (a & b & c). formulas. formulas_in a. rewrite a, b, c. reflexivity.
  - rewrite !(received_along of_kind step spheres has has_iff once phi f) by exact F.
    rewrite <- !over_of_sum. apply over_of_same. intros r R.
    assert (D : forall d, on d (f r) * on d (felt_at of_kind step has phi (support_of (step_under step r) r d))
      == on d (above_spheres f r) * on d (g r)).
    { intros d.
      assert (A : on d (above_spheres f r) = if has (support_of (step_under step r) r d) then on d (f r) else 0)
        by (destruct d; reflexivity).
      rewrite A. unfold felt_at. destruct (has (support_of (step_under step r) r d)) eqn:S;
        [|destruct d; cbn [each on alpha beta gamma]; ring].
      set (q := support_of (step_under step r) r d) in *.
      assert (T := turned_twice of_kind (step_over step q) (step_under step q) (received g q)).
      assert (B : on d (turn q (phi q)) == on d (received g q))
        by (destruct T as (a & b & c); destruct d; assumption).
      rewrite B. assert (E : above_of (step_over step q) q d = r) by (symmetry; apply support_or_above; reflexivity).
      rewrite received_on, E, (proj2 (has_iff r) R). destruct (has_line of_kind d) eqn:L; cbn [andb]; [reflexivity|].
      rewrite (F r R d L). ring. }
    rewrite !D. reflexivity.
Qed.

(** The forces that arrive come from one layer. *)
Lemma transfer_of_same : forall f g p,
  (forall r, In r spheres -> fst r = (fst p - 1)%Z -> f r =3= g r) -> transfer f p =3= transfer g p.
Proof using has_iff.
  intros f g p H.
  assert (A : forall d, on d (received f p) == on d (received g p)).
  { intros d. rewrite !received_on.
    destruct (has_line of_kind d && has (above_of (step_over step p) p d)) eqn:B; [|reflexivity].
    apply andb_true_iff in B. destruct B as [_ B]. apply has_iff in B. destruct (H _ B eq_refl) as (a & b & c).
    destruct d; assumption. }
  assert (a := A Alpha). assert (b := A Beta). assert (c := A Gamma). unfold transfer.
  destruct (received f p) as [f1 f2 f3], (received g p) as [g1 g2 g3]. cbn [on alpha beta gamma] in a, b, c.
  unfold turned, transferred.
  destruct of_kind, (step_over step p), (step_under step p); repeat split; formulas; congruent.
Qed.

Theorem transfer_is_linear : forall c f g h p,
  (forall r, h r =3= plus_three (f r) (map (Qmult c) (g r))) ->
  transfer h p =3= plus_three (transfer f p) (map (Qmult c) (transfer g p)).
Proof.
  intros c f g h p H.
  assert (A : forall d, on d (received h p) == on d (received f p) + c * on d (received g p)).
  { intros d. rewrite !received_on. destruct (has_line of_kind d && has (above_of (step_over step p) p d)); [|ring].
    destruct (H (above_of (step_over step p) p d)) as (x & y & z). destruct d; assumption. }
  assert (x := A Alpha). assert (y := A Beta). assert (z := A Gamma). unfold transfer.
  destruct (received f p) as [f1 f2 f3], (received g p) as [g1 g2 g3], (received h p) as [h1 h2 h3].
  cbn [on alpha beta gamma] in x, y, z. unfold turned, transferred, plus_three.
  destruct of_kind, (step_over step p), (step_under step p); repeat split; formulas; rewrite ?x, ?y, ?z; ring.
Qed.

Lemma transfer_of_nothing : forall p, transfer (fun _ => each 0) p =3= each 0.
Proof.
  intros p. rewrite (transfer_is_linear (- (1)) (fun _ => each 0) (fun _ => each 0)) by (intros; by_components).
  destruct (transfer (fun _ => each 0) p) as [a b c]. unfold plus_three. by_components.
Qed.

(** *** Isometry *)

Definition in_layer (k : Z) : list sphere := filter (fun p => (fst p =? k)%Z) spheres.

(** S maps the forces below layer k isometrically to those below layer k+1: it keeps scalar products, for spheres and
    discs, in every stacking, below a layer of any shape whose supports are all in the list. *)
Theorem isometry : forall k f g,
  (forall p, In p spheres -> on_lines of_kind (f p)) ->
  (forall p d, In p spheres -> fst p = k -> has_line of_kind d = true -> In (support_of (step k) p d) spheres) ->
  over (in_layer (k + 1)) (fun p => dot (transfer f p) (transfer g p)) == over (in_layer k) (fun p => dot (f p) (g p)).
Proof using has_iff once.
  intros k f g F H. unfold in_layer. rewrite !over_filter.
  pose (f' := fun p : sphere => if (fst p =? k)%Z then f p else each 0).
  assert (F' : forall p, In p spheres -> on_lines of_kind (f' p)).
  { intros p P d L. unfold f'. destruct (fst p =? k)%Z; [exact (F p P d L) | destruct d; reflexivity]. }
  transitivity (over spheres (fun p => dot (transfer f' p) (transfer g p))).
  - apply over_of_same. intros p _. destruct (Z.eqb_spec (fst p) (k + 1)) as [E | E].
    + assert (S : transfer f' p =3= transfer f p).
      { apply transfer_of_same. intros r _ K. unfold f'.
        replace (fst r =? k)%Z with true by (symmetry; apply Z.eqb_eq; lia). reflexivity. }
      destruct S as (a & b & c). unfold dot. formulas. rewrite a, b, c. reflexivity.
    + assert (S : transfer f' p =3= each 0).
      { rewrite (transfer_of_same f' (fun _ => each 0)); [apply transfer_of_nothing|].
        intros r _ K. unfold f'. replace (fst r =? k)%Z with false by (symmetry; apply Z.eqb_neq; lia). reflexivity. }
      destruct S as (a & b & c). unfold dot. formulas. rewrite a, b, c. cbn [each alpha beta gamma]. ring.
  - rewrite (transfer_keeps f' g F'). apply over_of_same. intros p P.
    destruct (Z.eqb_spec (fst p) k) as [E | E].
    + assert (A : forall d, on d (above_spheres f' p) == on d (f p)).
      { intros d.
        assert (R : on d (above_spheres f' p) = if has (support_of (step_under step p) p d) then on d (f' p) else 0)
          by (destruct d; reflexivity).
        rewrite R. unfold f'. rewrite (proj2 (Z.eqb_eq _ _) E). destruct (has_line of_kind d) eqn:L.
        - unfold step_under. rewrite E, (proj2 (has_iff _) (H p d P E L)). reflexivity.
        - destruct (has _); [reflexivity | symmetry; exact (F p P d L)]. }
      assert (a := A Alpha). assert (b := A Beta). assert (c := A Gamma). unfold dot. cbn [on] in a, b, c. formulas.
      cbn [alpha beta gamma] in *. rewrite a, b, c. reflexivity.
    + assert (A : above_spheres f' p =3= each 0).
      { unfold above_spheres, f'. rewrite (proj2 (Z.eqb_neq _ _) E).
        repeat split; cbn [each on alpha beta gamma]; destruct (has _); reflexivity. }
      destruct A as (a & b & c). unfold dot. formulas. rewrite a, b, c. cbn [each alpha beta gamma]. ring.
Qed.

(** So layers without loads have the same sum of squares. *)
Theorem squares_without_loads : forall k load f,
  (forall p, In p spheres -> fits of_kind (step_over step p) (step_under step p) (load p)) ->
  (forall p, In p spheres -> fst p = (k + 1)%Z -> load p = nothing) ->
  (forall p d, In p spheres -> fst p = k -> has_line of_kind d = true -> In (support_of (step k) p d) spheres) ->
  equilibrium_of of_kind step spheres load has f (fun _ _ => 0) ->
  over (in_layer (k + 1)) (fun p => dot (f p) (f p)) == over (in_layer k) (fun p => dot (f p) (f p)).
Proof using has_iff once.
  intros k load f T N H B. rewrite <- (isometry k f f) by (try exact H; intros p P; apply (B p P)).
  apply over_of_same. intros p P. apply filter_In in P. destruct P as [P K]. apply Z.eqb_eq in K.
  assert (E := proj1 (equilibrium_is load f p P (T p P)) (B p P)). rewrite (N p P K) in E.
  assert (Z : own_increments of_kind nothing (step_under step p) =3= each 0)
    by (unfold own_increments; destruct of_kind, (step_under step p); by_components).
  destruct E as (a & b & c), Z as (x & y & z). unfold dot, sum, plus_three in *.
  cbn [by_line each alpha beta gamma] in *. rewrite a, b, c, x, y, z. ring.
Qed.

(** *** Chains of a pile *)

Fixpoint transfers (n : nat) (e : sphere -> three Q) : sphere -> three Q :=
  match n with O => e | S m => transfer (transfers m e) end.

(** The sum of a_j S^j e for j below m. *)
Fixpoint along_chain (a : nat -> Q) (m : nat) (e : sphere -> three Q) (p : sphere) : three Q :=
  match m with O => each 0 | S n => plus_three (along_chain a n e p) (map (Qmult (a n)) (transfers n e p)) end.

(** On a chain, I - S is the matrix C: a_j becomes a_j - a_(j-1), if S^m e = 0. *)
Theorem on_a_chain : forall a m e p,
  minus_three (along_chain a m e p) (transfer (along_chain a m e) p)
  =3= minus_three (along_chain (fun j => applied Q 0 Qminus a j) m e p) (map (Qmult (before Q 0 a m)) (transfers m e p)).
Proof.
  intros a m e p. induction m as [|m IH].
  - assert (N : transfer (along_chain a 0 e) p =3= each 0) by exact (transfer_of_nothing p).
    cbn [along_chain before transfers] in N |- *. destruct N as (x & y & z). unfold minus_three.
    cbn [by_line map each alpha beta gamma] in *. repeat split; cbn [by_line map each alpha beta gamma]; lra.
  - assert (L := transfer_is_linear (a m) (along_chain a m e) (transfers m e) (along_chain a (S m) e) p
      ltac:(intros; reflexivity)).
    cbn [along_chain before transfers]. unfold applied at 2. destruct L as (x & y & z), IH as (x' & y' & z').
    unfold minus_three, plus_three in *. cbn [by_line map alpha beta gamma] in *.
    repeat split; cbn [by_line map each alpha beta gamma]; [rewrite x | rewrite y | rewrite z]; lra.
Qed.

(** Vectors of layer k keep their scalar products while S carries them down. So (in words) orthonormal vectors of a layer
    stay orthonormal, and chains begin with those that complete them in the next layer. *)
Theorem chains_keep : forall k j e g,
  (forall p, In p spheres -> on_lines of_kind (e p)) ->
  (forall p d, In p spheres -> (k <= fst p < k + Z.of_nat j)%Z -> has_line of_kind d = true ->
    In (support_of (step_under step p) p d) spheres) ->
  over (in_layer (k + Z.of_nat j)) (fun p => dot (transfers j e p) (transfers j g p))
  == over (in_layer k) (fun p => dot (e p) (g p)).
Proof using has_iff once.
  intros k j e g E. induction j as [|j IH]; intros H; [cbn [transfers]; rewrite Z.add_0_r; reflexivity|].
  rewrite <- IH by (intros p d P K; apply H; [exact P | lia]).
  replace (k + Z.of_nat (S j))%Z with (k + Z.of_nat j + 1)%Z by lia. cbn [transfers]. apply isometry.
  - intros p P d L. destruct j as [|j]; [exact (E p P d L)|]. cbn [transfers]. unfold transfer.
    assert (A := arriving_on_lines of_kind step has (transfers j e) p d L).
    destruct of_kind, d; try discriminate L. exact A.
  - intros p d P K L. rewrite <- K. apply H; [exact P | lia | exact L].
Qed.

(** *** I - S is unipotent *)

Variable layers : nat.
Hypothesis of_layers : forall p, In p spheres -> (0 <= fst p < Z.of_nat layers)%Z.

Lemma nothing_arrives : forall n e p, In p spheres -> (fst p < Z.of_nat n)%Z -> transfers n e p =3= each 0.
Proof using has_iff of_layers.
  induction n as [|n IH]; intros e p P H; [specialize (of_layers p P); lia|]. cbn [transfers].
  rewrite (transfer_of_same (transfers n e) (fun _ => each 0)); [apply transfer_of_nothing|].
  intros r R K. apply IH; [exact R | lia].
Qed.

(** S^n = 0 for n layers with supports. *)
Theorem transfer_is_nilpotent : forall e p, In p spheres -> transfers layers e p =3= each 0.
Proof using has_iff of_layers. intros e p P. apply nothing_arrives; [exact P | apply of_layers; exact P]. Qed.

(** The inverse of I - S: the sum of S^j w, j = 0 ... n-1, solves f = S f + w, and no other forces do. *)
Theorem inverse : forall w p, In p spheres ->
  let f := along_chain (fun _ => 1) layers w in f p =3= plus_three (transfer f p) (w p).
Proof using has_iff of_layers.
  intros w p P. cbv zeta.
  assert (C := on_a_chain (fun _ => 1) layers w p). assert (N := transfer_is_nilpotent w p P).
  assert (D : along_chain (fun j => applied Q 0 Qminus (fun _ => 1) j) layers w p =3= w p).
  { specialize (of_layers p P). destruct layers as [|n]; [lia|]. clear. induction n as [|n IH].
    - unfold applied. cbn [along_chain before transfers]. unfold plus_three. by_components.
    - unfold applied in *. cbn [along_chain before] in *. destruct IH as (a & b & c).
      unfold plus_three in *. cbn [by_line map alpha beta gamma] in *.
      repeat split; cbn [by_line map each alpha beta gamma]; lra. }
  destruct C as (a & b & c), N as (x & y & z), D as (u & v & t).
  unfold minus_three, plus_three in *. cbn [by_line map each alpha beta gamma] in *.
  rewrite x, u in a. rewrite y, v in b. rewrite z, t in c. repeat split; cbn [by_line map each alpha beta gamma]; lra.
Qed.

Theorem inverse_is_unique : forall w f g,
  (forall p, In p spheres -> f p =3= plus_three (transfer f p) (w p)) ->
  (forall p, In p spheres -> g p =3= plus_three (transfer g p) (w p)) ->
  forall p, In p spheres -> f p =3= g p.
Proof using has_iff of_layers.
  intros w f g A B.
  assert (N : forall n p, In p spheres -> (fst p < Z.of_nat n)%Z -> f p =3= g p).
  { induction n as [|n IH]; intros p P H; [specialize (of_layers p P); lia|]. rewrite (A p P), (B p P).
    assert (T : transfer f p =3= transfer g p) by (apply transfer_of_same; intros r R K; apply IH; [exact R | lia]).
    destruct T as (a & b & c). unfold plus_three. repeat split; cbn [by_line alpha beta gamma]; congruent. }
  intros p P. apply (N layers p P). apply of_layers. exact P.
Qed.

(** *** The determinant *)

(** An unknown: a sphere and one of its lines. *)
Definition slot : Type := sphere * direction.

Definition same_slot : forall q r : slot, {q = r} + {q <> r}.
Proof. decide equality; [decide equality | apply same_sphere]. Defined.

Definition unit_force (r : slot) (p : sphere) : three Q := if same_sphere p (fst r) then one_on (snd r) else each 0.

(** The entry of I - S in row q and column r. *)
Definition entry (q r : slot) : Q :=
  (if same_slot q r then 1 else 0) - on (snd q) (transfer (unit_force r) (fst q)).

Definition matrix (slots : list slot) : list (list Q) := List.map (fun r => List.map (fun q => entry q r) slots) slots.

Lemma entry_above : forall q r, (fst (fst q) <= fst (fst r))%Z -> entry q r == if same_slot q r then 1 else 0.
Proof using has_iff.
  intros [q d] [r e] H. unfold entry. cbn [fst snd] in *.
  assert (T : transfer (unit_force (r, e)) q =3= each 0).
  { rewrite (transfer_of_same _ (fun _ => each 0)); [apply transfer_of_nothing|]. intros s _ K. unfold unit_force.
    cbn [fst snd]. destruct (same_sphere s r) as [E | E]; [subst s; lia | reflexivity]. }
  destruct T as (a & b & c). destruct d; cbn [on]; rewrite ?a, ?b, ?c; cbn [each alpha beta gamma]; ring.
Qed.

Definition expansion (minor : nat -> Q) : list Q -> nat -> Q :=
  fix expand (entries : list Q) (row : nat) : Q :=
    match entries with [] => 0 | entry :: rest => entry * minor row - expand rest (S row) end.

Lemma determinant_is : forall m first others, Spectrum.determinant (S m) (first :: others)
  = expansion (fun row => Spectrum.determinant m (List.map (Spectrum.without row) others)) first 0.
Proof. reflexivity. Qed.

Lemma expansion_of_nothing : forall minor entries row,
  (forall x, In x entries -> x == 0) -> expansion minor entries row == 0.
Proof.
  intros minor entries. induction entries as [|x rest IH]; intros row H; cbn [expansion]; [reflexivity|].
  rewrite IH by (intros; apply H; right; assumption). rewrite (H x) by (left; reflexivity). ring.
Qed.

(** det(I - S) = 1, with the unknowns in any order in which lower layers come first. *)
Theorem determinant_of_equilibrium : forall slots,
  StronglySorted (fun q r => (fst (fst r) <= fst (fst q))%Z /\ q <> r) slots ->
  Spectrum.determinant (length slots) (matrix slots) == 1.
Proof using has_iff.
  intros slots H. induction H as [|q rest H IH A]; [reflexivity|]. unfold matrix. cbn [length List.map].
  rewrite determinant_is. cbn [expansion].
  rewrite expansion_of_nothing.
  - rewrite entry_above by lia. destruct (same_slot q q) as [_ | E]; [|contradiction].
    rewrite map_map. cbn [Spectrum.without]. unfold matrix in IH. rewrite IH. ring.
  - intros x X. apply in_map_iff in X. destruct X as (r & E & R). subst x. rewrite Forall_forall in A.
    destruct (A r R) as [L N]. rewrite entry_above by exact L.
    destruct (same_slot r q) as [E | E]; [congruence | reflexivity].
Qed.
End Transfer.
