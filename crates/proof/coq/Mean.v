(** The mean over random stackings: each sign differs from the previous one with probability q. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa List.
From Cannonpile Require Import Directions Sums Formulas Balance Horizontal Response.

Import ListNotations.

Open Scope Q_scope.

(** ** Modes *)

(** The parts f and h of the mean before a + and a - step, after one step, for forces that are constant in space. *)
Definition stepped (q : Q) (f h : three Q) : three Q * three Q :=
  let mixed same other := by_line Qplus (map (Qmult (1 - q)) same) (map (Qmult q) (half_turn other)) in
  (mixed f h, mixed h f).

(** (M - 1)(M - mu) = 0, mu = 1-2q: three numbers are conserved, three decay. *)
Theorem modes_of_the_mean : forall q f h,
  let mu := 1 - 2 * q in
  let once := stepped q f h in
  let twice := stepped q (fst once) (snd once) in
  by_line Qminus (by_line Qplus (fst twice) (map (Qmult mu) f)) (map (Qmult (1 + mu)) (fst once)) =3= each 0 /\
  by_line Qminus (by_line Qplus (snd twice) (map (Qmult mu) h)) (map (Qmult (1 + mu)) (snd once)) =3= each 0.
Proof. intros q [] []. cbv zeta. unfold stepped. cbn [fst snd]. split; by_components. Qed.

(** A field that alternates from site to site along alpha and beta, (1, -1, 0) and its negative, changes its sign in
    every step and never decays. *)
Theorem staggered_mode : forall q x,
  let psi := Three x (- x) 0 in
  let moved := Three (- x) x 0 in
  let after := stepped q moved (map Qopp moved) in
  fst after =3= map Qopp psi /\ snd after =3= psi.
Proof. intros q x. cbv zeta. unfold stepped. cbn [fst snd]. split; by_components. Qed.

(** ** Registries *)

(** Fractions of the stackings in registries 0, 1, 2 after a + step, p, and after a - step, m, and their change in
    one more step: + leads from r to r+1, - to r-1. *)
Record shares := Shares { p0 : Q; p1 : Q; p2 : Q; m0 : Q; m1 : Q; m2 : Q }.

Definition further (q : Q) (s : shares) : shares :=
  let mix same other := (1 - q) * same + q * other in
  Shares (mix s.(p2) s.(m2)) (mix s.(p0) s.(m0)) (mix s.(p1) s.(m1))
         (mix s.(m1) s.(p1)) (mix s.(m2) s.(p2)) (mix s.(m0) s.(p0)).

(** The excess of each registry over one third. *)
Definition excesses (s : shares) : three Q :=
  let all := s.(p0) + s.(p1) + s.(p2) + s.(m0) + s.(m1) + s.(m2) in
  Three (s.(p0) + s.(m0) - all * (1 # 3)) (s.(p1) + s.(m1) - all * (1 # 3)) (s.(p2) + s.(m2) - all * (1 # 3)).

Ltac by_shares := cbv zeta; intros; unfold further, excesses, by_line; cbn [p0 p1 p2 m0 m1 m2]; repeat split; formulas; ring.

(** The recursion of the library, from any fractions. *)
Theorem registry : forall q s,
  let once := further q s in
  by_line (fun x y => registry_excess x y q) (excesses s) (excesses once) =3= excesses (further q once).
Proof. intros q []. by_shares. Qed.

(** The recursion also holds two steps below a single layer of registry 0, if the fractions of the first signs are u and
    v. *)
Theorem registry_at_the_top : forall q u v,
  let first := Shares 0 u 0 0 0 v in
  by_line (fun x y => registry_excess x y q) (excesses (Shares (u + v) 0 0 0 0 0)) (excesses first)
  =3= excesses (further q first).
Proof. by_shares. Qed.

(** ** Random signs

    The mean of a quantity that depends on the next n signs: each differs from the previous one with probability q. *)
Fixpoint mean (q : Q) (n : nat) (before : sign) (F : list sign -> Q) : Q :=
  match n with
  | O => F []
  | S m => (1 - q) * mean q m before (fun s => F (before :: s))
           + q * mean q m (opposite before) (fun s => F (opposite before :: s))
  end.

Lemma mean_of_same : forall q n b F G, (forall s, F s == G s) -> mean q n b F == mean q n b G.
Proof.
  intros q. induction n as [|n IH]; intros b F G H; cbn [mean]; [apply H|].
  rewrite (IH b (fun s => F (b :: s)) (fun s => G (b :: s))) by (intros; apply H).
  rewrite (IH (opposite b) (fun s => F (opposite b :: s)) (fun s => G (opposite b :: s))) by (intros; apply H). reflexivity.
Qed.

Lemma mean_of_number : forall q n b x, mean q n b (fun _ => x) == x.
Proof. intros q. induction n as [|n IH]; intros b x; cbn [mean]; [reflexivity|]. rewrite !IH. ring. Qed.

Lemma mean_of_sum : forall q n b F G, mean q n b (fun s => F s + G s) == mean q n b F + mean q n b G.
Proof.
  intros q. induction n as [|n IH]; intros b F G; cbn [mean]; [reflexivity|]. rewrite !IH. ring.
Qed.

Lemma mean_of_multiple : forall q n b x F, mean q n b (fun s => x * F s) == x * mean q n b F.
Proof. intros q. induction n as [|n IH]; intros b x F; cbn [mean]; [reflexivity|]. rewrite !IH. ring. Qed.

Lemma mean_of_total : forall q n b m F,
  mean q n b (fun s => total m (fun k => F k s)) == total m (fun k => mean q n b (F k)).
Proof.
  intros q n b m F. induction m as [|m IH]; cbn [total]; [apply mean_of_number|].
  rewrite mean_of_sum, IH. reflexivity.
Qed.

(** The signs of a stacking that begins with [first] and continues with a list; and one of them as a number. *)
Definition signs (first : sign) (s : list sign) (k : nat) : sign := nth k (first :: s) first.
Definition sigma (first : sign) (s : list sign) (k : nat) : Q := times (signs first s k) 1.

Lemma sigma_of_next : forall b c s k, (k <= length s)%nat -> sigma b (c :: s) (S k) = sigma c s k.
Proof.
  intros b c s k H. unfold sigma, signs. change (nth (S k) (b :: c :: s) b) with (nth k (c :: s) b).
  rewrite (nth_indep (c :: s) b c) by (cbn [length]; lia). reflexivity.
Qed.

(** The mean depends on lists of n signs only. *)
Lemma mean_of_same_length : forall q n b F G,
  (forall s, length s = n -> F s == G s) -> mean q n b F == mean q n b G.
Proof.
  intros q. induction n as [|n IH]; intros b F G H; cbn [mean]; [apply H; reflexivity|].
  rewrite (IH b (fun s => F (b :: s)) (fun s => G (b :: s))) by (intros; apply H; cbn [length]; lia).
  rewrite (IH (opposite b) (fun s => F (opposite b :: s)) (fun s => G (opposite b :: s)))
    by (intros; apply H; cbn [length]; lia).
  reflexivity.
Qed.

(** The mean of sigma_(k+1) is mu^k times the first sign. *)
Theorem mean_of_sign : forall q n b k, (k <= n)%nat ->
  mean q n b (fun s => sigma b s k) == times b 1 * power (1 - 2 * q) k.
Proof.
  intros q n b k. revert n b. induction k as [|k IH]; intros n b H.
  - unfold sigma, signs. cbn [nth power]. rewrite mean_of_number. ring.
  - destruct n as [|n]; [lia|]. cbn [mean].
    rewrite (mean_of_same_length q n b _ (fun s => sigma b s k)) by (intros; rewrite sigma_of_next by lia; reflexivity).
    rewrite (mean_of_same_length q n (opposite b) _ (fun s => sigma (opposite b) s k))
      by (intros; rewrite sigma_of_next by lia; reflexivity).
    rewrite !IH by lia. cbn [power]. destruct b; unfold times; cbn [opposite]; ring.
Qed.

(** The mean of the product of two signs is mu^(t-s). *)
Theorem mean_of_two_signs : forall q n b j k, (j <= k)%nat -> (k <= n)%nat ->
  mean q n b (fun s => sigma b s k * sigma b s j) == power (1 - 2 * q) (k - j).
Proof.
  intros q n b j. revert n b. induction j as [|j IH]; intros n b k Hj Hk.
  - rewrite (mean_of_same q n b _ (fun s => times b 1 * sigma b s k))
      by (intros; unfold sigma, signs; cbn [nth]; ring).
    rewrite mean_of_multiple, mean_of_sign by exact Hk. rewrite Nat.sub_0_r. destruct b; unfold times; ring.
  - destruct n as [|n]; [lia|]. destruct k as [|k]; [lia|]. cbn [mean].
    rewrite (mean_of_same_length q n b _ (fun s => sigma b s k * sigma b s j))
      by (intros; rewrite !sigma_of_next by lia; reflexivity).
    rewrite (mean_of_same_length q n (opposite b) _ (fun s => sigma (opposite b) s k * sigma (opposite b) s j))
      by (intros; rewrite !sigma_of_next by lia; reflexivity).
    rewrite !IH by lia. cbn [Nat.sub]. ring.
Qed.

(** ** Moments *)

(** The third moment for the mean signs, times (1-mu)^3. *)
Theorem mean_of_third_moment : forall mu n,
  (1 - mu) * (1 - mu) * (1 - mu) * total n (fun s => power mu s * third_moment (n_of n) (n_of s + 1))
  == mean_third_moment (n_of n) mu (power mu n).
Proof.
  intros mu n.
  (* The sums of mu^s and of s mu^s. *)
  assert (A : forall n, (1 - mu) * total n (fun s => power mu s) == 1 - power mu n).
  { induction n0 as [|m IH]; simpl; [ring|]. rewrite Qmult_plus_distr_r, IH. ring. }
  assert (B : forall n, (1 - mu) * (1 - mu) * total n (fun s => power mu s * n_of s)
    == mu - n_of n * power mu n + (n_of n - 1) * power mu n * mu).
  { induction n0 as [|m IH]; simpl; [rewrite n_of_0; ring|]. rewrite Qmult_plus_distr_r, IH, n_of_S. ring. }
  assert (C : forall n, (1 - mu) * (1 - mu) * (1 - mu) * total n (fun s => power mu s * (n_of s * n_of s))
    == mu * (1 + mu) - power mu n * (n_of n * n_of n - (2 * n_of n * n_of n - 2 * n_of n - 1) * mu
       + (n_of n - 1) * (n_of n - 1) * mu * mu)).
  { induction n0 as [|m IH]; simpl; [rewrite n_of_0; ring|]. rewrite Qmult_plus_distr_r, IH, n_of_S. ring. }
  set (x := n_of n).
  rewrite (total_of_same _ _ (fun s => (3 * x - 2) * power mu s
    + ((6 * x - 6) * (power mu s * n_of s) + - (6) * (power mu s * (n_of s * n_of s))))).
  - rewrite !total_of_sum, !total_of_multiple.
    specialize (A n). specialize (B n). specialize (C n). fold x in A, B, C.
    set (a := total n (fun s => power mu s)) in *.
    set (b := total n (fun s => power mu s * n_of s)) in *.
    set (c := total n (fun s => power mu s * (n_of s * n_of s))) in *.
    transitivity ((3 * x - 2) * (1 - mu) * (1 - mu) * ((1 - mu) * a)
      + (6 * x - 6) * (1 - mu) * ((1 - mu) * (1 - mu) * b) - 6 * ((1 - mu) * (1 - mu) * (1 - mu) * c)); [ring|].
    rewrite A, B, C. formulas. ring.
  - intros s _. formulas. ring.
Qed.

(** The contribution of pairs of mean signs to the fourth moment, times (1-mu)^4. *)
Theorem mean_of_fourth_moment : forall mu n,
  (1 - mu) * (1 - mu) * (1 - mu) * (1 - mu)
    * total n (fun t => total t (fun s => power mu (t - s) * fourth_moment_of_pair (n_of n) (n_of s + 1) (n_of t + 1)))
  == mean_fourth_moment_of_pairs (n_of n) mu (power mu n).
Proof.
  intros mu n.
  assert (A : forall n, (1 - mu) * total n (fun s => power mu s) == 1 - power mu n).
  { induction n0 as [|m IH]; simpl; [ring|]. rewrite Qmult_plus_distr_r, IH. ring. }
  assert (B : forall n, (1 - mu) * (1 - mu) * total n (fun s => power mu s * n_of s)
    == mu - n_of n * power mu n + (n_of n - 1) * power mu n * mu).
  { induction n0 as [|m IH]; simpl; [rewrite n_of_0; ring|]. rewrite Qmult_plus_distr_r, IH, n_of_S. ring. }
  (* The sum of mu^(t-s) (2s-1) over the steps before t. *)
  assert (D : forall t, (1 - mu) * (1 - mu) * total t (fun s => power mu (t - s) * (2 * (n_of s + 1) - 1))
    == 2 * mu * (1 - mu) * n_of t - mu * (1 + mu) * (1 - power mu t)).
  { induction t as [|t IH]; [simpl; rewrite n_of_0; ring|].
    change (total (S t) ?f) with (total t f + f t). cbv beta. replace (S t - t)%nat with 1%nat by lia.
    rewrite (total_of_same t _ (fun s => mu * (power mu (t - s) * (2 * (n_of s + 1) - 1)))).
    - rewrite total_of_multiple.
      transitivity (mu * ((1 - mu) * (1 - mu) * total t (fun s => power mu (t - s) * (2 * (n_of s + 1) - 1)))
        + (1 - mu) * (1 - mu) * mu * (2 * n_of t + 1)); [simpl; ring|].
      rewrite IH, n_of_S. simpl. ring.
    - intros s Hs. replace (S t - s)%nat with (S (t - s)) by lia. simpl. ring. }
  assert (S1 : forall n, total n (fun t => n_of t) == n_of n * (n_of n - 1) * (1 # 2)).
  { induction n0 as [|m IH]; [simpl; rewrite n_of_0; ring|]. change (total (S m) ?f) with (total m f + f m).
    cbv beta. rewrite IH, n_of_S. ring. }
  assert (S2 : forall n, total n (fun t => n_of t * n_of t) == n_of n * (n_of n - 1) * (2 * n_of n - 1) * (1 # 6)).
  { induction n0 as [|m IH]; [simpl; rewrite n_of_0; ring|]. change (total (S m) ?f) with (total m f + f m).
    cbv beta. rewrite IH, n_of_S. ring. }
  assert (S0 : forall n, total n (fun _ => 1) == n_of n).
  { induction n0 as [|m IH]; [reflexivity|]. change (total (S m) ?f) with (total m f + f m).
    cbv beta. rewrite IH, n_of_S. ring. }
  set (x := n_of n).
  transitivity ((1 - mu) * (1 - mu) * total n (fun t => (1 - mu) * (1 - mu)
    * total t (fun s => power mu (t - s) * fourth_moment_of_pair x (n_of s + 1) (n_of t + 1)))).
  { rewrite total_of_multiple. ring. }
  rewrite (total_of_same n _ (fun t =>
    - (mu * (1 + mu) * (4 * x - 2)) * 1 + ((4 * mu * (1 - mu) * (2 * x - 1) + 4 * mu * (1 + mu)) * n_of t
    + (- (8 * mu * (1 - mu)) * (n_of t * n_of t)
    + (mu * (1 + mu) * (4 * x - 2) * power mu t + - (4 * mu * (1 + mu)) * (power mu t * n_of t)))))).
  - rewrite !total_of_sum, !total_of_multiple, S0, S1, S2.
    specialize (A n). specialize (B n). fold x in A, B |- *.
    set (a := total n (fun s => power mu s)) in *.
    set (b := total n (fun s => power mu s * n_of s)) in *.
    transitivity ((1 - mu) * (1 - mu) * (- (mu * (1 + mu) * (4 * x - 2)) * x
        + (4 * mu * (1 - mu) * (2 * x - 1) + 4 * mu * (1 + mu)) * (x * (x - 1) * (1 # 2))
        - 8 * mu * (1 - mu) * (x * (x - 1) * (2 * x - 1) * (1 # 6)))
      + mu * (1 + mu) * (4 * x - 2) * (1 - mu) * ((1 - mu) * a)
      - 4 * mu * (1 + mu) * ((1 - mu) * (1 - mu) * b)); [ring|].
    rewrite A, B. formulas. ring.
  - intros t _. rewrite (total_of_same t _ (fun s => (4 * x - 4 * n_of t - 2) * (power mu (t - s) * (2 * (n_of s + 1) - 1)))).
    + rewrite total_of_multiple.
      transitivity ((4 * x - 4 * n_of t - 2)
        * ((1 - mu) * (1 - mu) * total t (fun s => power mu (t - s) * (2 * (n_of s + 1) - 1)))); [ring|].
      rewrite D. ring.
    + intros s _. formulas. ring.
Qed.

(** The mean third moment of the response at depth n+1, the sum of v r^3 cos 3phi, over random stackings that begin
    with + and change their sign with probability q > 0. *)
Theorem third_moment_of_random_stackings : forall q n, ~ q == 0 ->
  let mu := 1 - 2 * q in
  let N := n_of (S n) in
  let X := power mu (S n) in
  mean q n Plus (fun s => over (load third) (response (signs Plus s) n))
  == 3 * (1 + mu) * N * (1 + X) / ((1 - mu) * (1 - mu))
     - 2 * (mu * mu + 4 * mu + 1) * (1 - X) / ((1 - mu) * (1 - mu) * (1 - mu)).
Proof.
  intros q n Hq mu N X. assert (U : ~ 1 - mu == 0) by (unfold mu; intro; apply Hq; lra).
  assert (M : mean q n Plus (fun s => over (load third) (response (signs Plus s) n))
    == total (S n) (fun k => power mu k * third_moment N (n_of k + 1))).
  { rewrite (mean_of_same _ _ _ _ _ (fun s => third_moment_of_response (signs Plus s) n)).
    rewrite (mean_of_total q n Plus (S n) (fun k s => times (signs Plus s k) 1 * third_moment (n_of (S n)) (n_of k + 1))).
    apply total_of_same. intros k Hk.
    rewrite (mean_of_same _ _ _ _ (fun s => third_moment (n_of (S n)) (n_of k + 1) * sigma Plus s k))
      by (intros; unfold sigma; ring).
    rewrite mean_of_multiple, mean_of_sign by lia. unfold times. fold mu. fold N. ring. }
  rewrite M. assert (T := mean_of_third_moment mu (S n)). fold N in T. fold X in T.
  set (t := total _ _) in *. clearbody t X N. clear M.
  transitivity ((1 - mu) * (1 - mu) * (1 - mu) * t / ((1 - mu) * (1 - mu) * (1 - mu))); [field; exact U|].
  rewrite T. formulas. field. exact U.
Qed.

(** The mean fourth moment, for stackings that begin with either sign. *)
Theorem fourth_moment_of_random_stackings : forall q n b, ~ q == 0 ->
  let mu := 1 - 2 * q in
  let N := n_of (S n) in
  let X := power mu (S n) in
  mean q n b (fun s => over (load fourth) (response (signs b s) n))
  == N * (2 * N * N * N + 2 * N * N - 2 * N + 1) / 3 + 4 * mu * N * N * N / (3 * (1 - mu))
     - 4 * mu * N * N / ((1 - mu) * (1 - mu))
     + 2 * mu * (mu * mu + 4 * mu + 7) * N / (3 * (1 - mu) * (1 - mu) * (1 - mu))
     - 2 * mu * (1 + mu) * (1 + mu) * (1 - X) / ((1 - mu) * (1 - mu) * (1 - mu) * (1 - mu)).
Proof.
  intros q n b Hq mu N X. assert (U : ~ 1 - mu == 0) by (unfold mu; intro; apply Hq; lra).
  assert (M : mean q n b (fun s => over (load fourth) (response (signs b s) n))
    == fourth_moment N
       + total (S n) (fun t => total t (fun k => power mu (t - k) * fourth_moment_of_pair N (n_of k + 1) (n_of t + 1)))).
  { rewrite (mean_of_same _ _ _ _ _ (fun s => fourth_moment_of_response (signs b s) n)).
    rewrite mean_of_sum, mean_of_number. apply Qplus_comp; [reflexivity|]. unfold pairs_below.
    rewrite (mean_of_total q n b (S n) (fun t s => times (signs b s t) 1 * total t (fun k => times (signs b s k) 1
      * fourth_moment_of_pair (n_of (S n)) (n_of k + 1) (n_of t + 1)))).
    apply total_of_same. intros t Ht.
    rewrite (mean_of_same _ _ _ _ (fun s => total t (fun k =>
        fourth_moment_of_pair (n_of (S n)) (n_of k + 1) (n_of t + 1) * (sigma b s t * sigma b s k))))
      by (intros; rewrite <- total_of_multiple; apply total_of_same; intros; unfold sigma; ring).
    rewrite (mean_of_total q n b t (fun k s =>
      fourth_moment_of_pair (n_of (S n)) (n_of k + 1) (n_of t + 1) * (sigma b s t * sigma b s k))).
    apply total_of_same. intros k Hk. rewrite mean_of_multiple, mean_of_two_signs by lia. fold mu. fold N. ring. }
  rewrite M. assert (T := mean_of_fourth_moment mu (S n)). fold N in T. fold X in T.
  set (t := total _ _) in *. clearbody t X N. clear M.
  transitivity (fourth_moment N + (1 - mu) * (1 - mu) * (1 - mu) * (1 - mu) * t
    / ((1 - mu) * (1 - mu) * (1 - mu) * (1 - mu))); [field; exact U|].
  rewrite T. formulas. field. exact U.
Qed.

(** ** Waves

    The damping and the dispersion of the waves of the mean, as in the library, times q and q^2. At q = 1, HCP, the
    damping is zero. [Spectrum.v] relates them to the spectrum. *)
Theorem damping_and_dispersion : forall q,
  16 * fst (wave q) == 1 - q /\ 768 * snd (wave q) == 13 * q * q - 42 * q + 21.
Proof. intros q. unfold wave. cbn [fst snd]. split; ring. Qed.
