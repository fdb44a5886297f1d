(** Sums and products of floats with their rounding errors: exact, with the domain of each theorem. *)

From Coq Require Import ZArith Reals Lra Lia.
From Flocq Require Import Core Plus_error Sterbenz Pff2Flocq.
From CannonpileFloats Require Import Model.

Open Scope R_scope.

(** Rounding to nearest even is symmetric. *)
Lemma even_is_symmetric : forall x, negb (Z.even x) = negb (negb (Z.even (- (x + 1)))).
Proof.
  intros x. rewrite Z.even_opp, Z.even_add. simpl. destruct (Z.even x); reflexivity.
Qed.

Lemma rnd_opp : forall x, rnd (- x) = - rnd x.
Proof. intros. apply round_NE_opp. Qed.

Lemma format_rnd : forall x, format (rnd x).
Proof. intros. apply generic_format_round; typeclasses eauto. Qed.

Lemma rnd_format : forall x, format x -> rnd x = x.
Proof. intros. apply round_generic; [typeclasses eauto | assumption]. Qed.

Lemma rnd_0 : rnd 0 = 0.
Proof. apply round_0. typeclasses eauto. Qed.

(** A number below a power of two stays below it when it is rounded. *)
Lemma rnd_at_most : forall x e, (-1074 <= e)%Z -> Rabs x <= bpow e -> Rabs (rnd x) <= bpow e.
Proof.
  intros x e He H. apply abs_round_le_generic; try typeclasses eauto; trivial.
  apply generic_format_FLT_bpow; [typeclasses eauto | exact He].
Qed.

(** ** The sum of Knuth *)

(** For all floats the two results are floats, s is a + b rounded, and s + e = a + b. *)
Theorem two_sum_exact : forall a b, format a -> format b ->
  let (s, e) := two_sum (a, b) in s = rnd (a + b) /\ s + e = a + b /\ format s /\ format e.
Proof.
  intros a b Fa Fb. unfold two_sum, add, sub.
  split; [reflexivity | split; [| split; apply format_rnd]].
  apply (TwoSum_correct (-1074) 53 (fun x => negb (Z.even x))); trivial; try lia.
  exact even_is_symmetric.
Qed.

(** ** The sum of Dekker *)

(** The difference s - a decides: if it is a float, the second result is exact. *)
Lemma fast_two_sum_from_difference : forall a b, format a -> format b -> format (rnd (a + b) - a) ->
  let (s, e) := fast_two_sum (a, b) in s = rnd (a + b) /\ s + e = a + b /\ format s /\ format e.
Proof.
  intros a b Fa Fb H. unfold fast_two_sum, add, sub.
  split; [reflexivity | split; [| split; apply format_rnd]].
  rewrite (rnd_format _ H).
  replace (b - (rnd (a + b) - a)) with (- (rnd (a + b) - (a + b))) by ring.
  rewrite (rnd_format (- _)); [ring |].
  apply generic_format_opp, plus_error; trivial; typeclasses eauto.
Qed.

(** An integer of at most 53 bits times a power of two is a float. *)
Lemma format_multiple : forall n e, (-1074 <= e)%Z -> (Z.abs n <= 2 ^ 53)%Z -> format (IZR n * bpow e).
Proof.
  intros n e He Hn.
  destruct (Z.eq_dec (Z.abs n) (2 ^ 53)) as [E | E].
  - assert (G : format (bpow (53 + e))) by (apply generic_format_FLT_bpow; [typeclasses eauto | lia]).
    assert (P : IZR (2 ^ 53) * bpow e = bpow (53 + e)) by (rewrite bpow_plus; reflexivity).
    destruct (Z.abs_eq_or_opp n) as [A | A].
    + replace n with (2 ^ 53)%Z by lia. rewrite P. exact G.
    + replace n with (- 2 ^ 53)%Z by lia. rewrite opp_IZR, Ropp_mult_distr_l_reverse, P.
      apply generic_format_opp. exact G.
  - apply generic_format_FLT. exists (Float radix2 n e); [reflexivity | simpl; lia | exact He].
Qed.

(** A float of at least 2^(e+53) is a multiple of 2^(e+1). *)
Lemma large_is_multiple : forall x e, format x -> (-1074 <= e)%Z -> bpow (e + 53) <= Rabs x ->
  exists n, x = IZR n * bpow (e + 1).
Proof.
  intros x e Fx He H. apply (ex_shift radix2 fexp); [exact Fx |].
  unfold cexp, FLT_exp.
  assert (e + 54 <= mag radix2 x)%Z; [| lia].
  apply mag_ge_bpow. replace (e + 54 - 1)%Z with (e + 53)%Z by ring. exact H.
Qed.

(** The sum of multiples of a power of two, rounded, is a multiple of it. *)
Lemma rounded_is_multiple : forall n e, exists m, rnd (IZR n * bpow e) = IZR m * bpow e.
Proof.
  intros n e. destruct (round_repr_same_exp radix2 fexp ZnearestE n e) as [m H].
  exists m. exact H.
Qed.

(** An integer is below a power of two if its multiple is. *)
Lemma multiple_below : forall n e k, (0 <= k)%Z -> Rabs (IZR n * bpow e) <= bpow (e + k) -> (Z.abs n <= 2 ^ k)%Z.
Proof.
  intros n e k Hk H. apply le_IZR. rewrite abs_IZR.
  rewrite Rabs_mult, (Rabs_pos_eq (bpow e)) in H by apply bpow_ge_0.
  rewrite bpow_plus, Rmult_comm in H. apply Rmult_le_reg_l in H; [| apply bpow_gt_0].
  replace (IZR (2 ^ k)) with (bpow k); [exact H |]. symmetry. apply (IZR_Zpower radix2). exact Hk.
Qed.

(** If a and b are multiples of a power of two 2^e, and b has at most 53 bits above it, s - a is a float. *)
Lemma difference_is_float : forall a b e i j, format a -> format b -> (-1074 <= e)%Z ->
  a = IZR i * bpow e -> b = IZR j * bpow e -> (Z.abs j < 2 ^ 53)%Z -> format (rnd (a + b) - a).
Proof.
  intros a b e i j Fa Fb He Ha Hb Hj.
  assert (Hsum : a + b = IZR (i + j) * bpow e) by (rewrite plus_IZR, Ha, Hb; ring).
  assert (Pe : 0 < bpow e) by apply bpow_gt_0.
  assert (Ab : Rabs b <= (2 ^ 53 - 1) * bpow e).
  { rewrite Hb, Rabs_mult, <- abs_IZR, (Rabs_pos_eq (bpow e)) by lra.
    apply Rmult_le_compat_r; [lra |]. replace (2 ^ 53 - 1) with (IZR (2 ^ 53 - 1)) by (simpl; lra).
    apply IZR_le. lia. }
  destruct (Z_le_gt_dec (Z.abs (i + j)) (2 ^ 53)) as [Small | Large].
  { (* The sum is a float. *)
    rewrite (rnd_format (a + b)); [replace (a + b - a) with b by ring; exact Fb |].
    rewrite Hsum. apply format_multiple; trivial. }
  destruct (Z_lt_le_dec (Z.abs i) (2 ^ 53)) as [Short | Long].
  - (* The rounding error is at most 2^e. *)
    destruct (rounded_is_multiple (i + j) e) as [m Hm].
    assert (E : rnd (a + b) - a = IZR (m - i) * bpow e) by (rewrite Hsum, Hm, Ha, minus_IZR; ring).
    rewrite E. apply format_multiple; trivial.
    apply (multiple_below _ e 53); [lia |]. rewrite <- E.
    assert (N : Rabs (rnd (a + b) - (a + b)) <= bpow e).
    { apply Rle_trans with (1 := error_le_half_ulp radix2 fexp (fun x => negb (Z.even x)) (a + b)).
      rewrite ulp_neq_0.
      - replace (bpow e) with (/ 2 * bpow (e + 1)) by (rewrite bpow_plus; change (bpow 1) with 2; field).
        apply Rmult_le_compat_l; [lra |]. apply bpow_le.
        replace (e + 1)%Z with (fexp (e + 54)) by (unfold FLT_exp; lia).
        apply cexp_le_bpow; [typeclasses eauto | | ].
        + rewrite Hsum. apply Rmult_integral_contrapositive. split; [apply IZR_neq; lia | lra].
        + rewrite Hsum, Rabs_mult, <- abs_IZR, (Rabs_pos_eq (bpow e)), (Z.add_comm e 54), bpow_plus by lra.
          apply Rmult_lt_compat_r; [exact Pe |]. apply (IZR_lt _ (2 ^ 54)). lia.
      - rewrite Hsum. apply Rmult_integral_contrapositive. split; [apply IZR_neq; lia | lra]. }
    replace (rnd (a + b) - a) with (b + (rnd (a + b) - (a + b))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite bpow_plus. simpl (bpow 53). lra.
  - (* Both are multiples of 2^(e+1). *)
    assert (La : bpow (e + 53) <= Rabs a).
    { rewrite Ha, Rabs_mult, <- abs_IZR, (Rabs_pos_eq (bpow e)), (Z.add_comm e 53), bpow_plus by lra.
      apply Rmult_le_compat_r; [lra |]. apply (IZR_le (2 ^ 53)). exact Long. }
    assert (Ls : bpow (e + 53) <= Rabs (rnd (a + b))).
    { apply abs_round_ge_generic; try typeclasses eauto.
      { apply generic_format_FLT_bpow; [typeclasses eauto | lia]. }
      { rewrite Hsum, Rabs_mult, <- abs_IZR, (Rabs_pos_eq (bpow e)), (Z.add_comm e 53), bpow_plus by lra.
        apply Rmult_le_compat_r; [lra |]. apply (IZR_le (2 ^ 53)). lia. } }
    destruct (large_is_multiple a e Fa He La) as [i' Ha'].
    destruct (large_is_multiple _ e (format_rnd (a + b)) He Ls) as [m Hm].
    assert (E : rnd (a + b) - a = IZR (m - i') * bpow (e + 1)) by (rewrite Hm, Ha' at 1; rewrite minus_IZR; ring).
    rewrite E. apply format_multiple; [lia |].
    apply (multiple_below _ (e + 1) 53); [lia |]. rewrite <- E.
    assert (N : Rabs (rnd (a + b) - (a + b)) <= Rabs b) by (apply plus_error_le_r; trivial; typeclasses eauto).
    replace (rnd (a + b) - a) with (b + (rnd (a + b) - (a + b))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite bpow_plus, (bpow_plus radix2 e 1). simpl (bpow 53). simpl (bpow 1). lra.
Qed.

(** A float is a multiple of its last bit 2^(cexp b), and has at most 53 bits. *)
Lemma last_bit : forall b, format b ->
  (-1074 <= cexp radix2 fexp b)%Z /\ exists j, b = IZR j * bpow (cexp radix2 fexp b) /\ (Z.abs j < 2 ^ 53)%Z.
Proof.
  intros b Fb. split; [apply Z.le_max_r |].
  destruct (ex_shift radix2 fexp b (cexp radix2 fexp b) Fb (Z.le_refl _)) as [j Hj].
  exists j. split; [exact Hj |].
  assert (H : Rabs b < bpow (53 + cexp radix2 fexp b)) by (apply abs_lt_bpow_prec; intros e; apply Z.le_max_l).
  rewrite Hj in H at 1. rewrite Rabs_mult, (Rabs_pos_eq (bpow _)), bpow_plus in H by apply bpow_ge_0.
  apply Rmult_lt_reg_r in H; [| apply bpow_gt_0].
  apply lt_IZR. rewrite abs_IZR. exact H.
Qed.

(** If |b| <= |a|, then a is a multiple of the last bit of b. *)
Lemma difference_is_float_if_less : forall a b, format a -> format b -> Rabs b <= Rabs a -> format (rnd (a + b) - a).
Proof.
  intros a b Fa Fb H.
  destruct (Req_dec b 0) as [-> | Hb].
  { rewrite Rplus_0_r, (rnd_format a Fa). replace (a - a) with 0 by ring. apply generic_format_0. }
  destruct (last_bit b Fb) as [He [j [Hj Jj]]].
  assert (Hc : (cexp radix2 fexp b <= cexp radix2 fexp a)%Z).
  { unfold cexp, FLT_exp. assert (mag radix2 b <= mag radix2 a)%Z by (apply mag_le_abs; trivial). lia. }
  destruct (ex_shift radix2 fexp a _ Fa Hc) as [i Hi].
  exact (difference_is_float a b _ i j Fa Fb He Hi Hj Jj).
Qed.

(** The condition of the documentation: |a| >= |b| or a = 0. *)
Theorem fast_two_sum_exact : forall a b, format a -> format b -> Rabs b <= Rabs a \/ a = 0 ->
  let (s, e) := fast_two_sum (a, b) in s = rnd (a + b) /\ s + e = a + b /\ format s /\ format e.
Proof.
  intros a b Fa Fb H. apply fast_two_sum_from_difference; trivial.
  destruct H as [H | ->].
  - apply difference_is_float_if_less; trivial.
  - rewrite Rplus_0_l, (rnd_format b Fb), Rminus_0_r. exact Fb.
Qed.

(** A weaker condition suffices: a is a multiple of 2^e, and b is one with at most 53 bits. The sum of double-doubles
    needs this, because there 0 < |a| < |b| occurs. *)
Theorem fast_two_sum_exact_multiple : forall a b e i j, format a -> format b -> (-1074 <= e)%Z ->
  a = IZR i * bpow e -> b = IZR j * bpow e -> (Z.abs j < 2 ^ 53)%Z ->
  let (s, r) := fast_two_sum (a, b) in s = rnd (a + b) /\ s + r = a + b /\ format s /\ format r.
Proof.
  intros. apply fast_two_sum_from_difference; trivial. eapply difference_is_float; eassumption.
Qed.

(** ** The product of Dekker *)

(** The splitting of the source is that of Veltkamp in Flocq. *)
Lemma split_is_veltkamp : forall a,
  let c := rnd (a * (bpow 27 + 1)) in
  let h := rnd (rnd (a - c) + c) in split a = (h, rnd (a - h)).
Proof.
  intros a c h. unfold split, sub, mul.
  replace (134217729 * a) with (a * (bpow 27 + 1)) by (change (bpow 27) with 134217728; ring).
  fold c. replace (c - a) with (- (a - c)) by ring. rewrite rnd_opp.
  replace (c - - rnd (a - c)) with (rnd (a - c) + c) by ring. reflexivity.
Qed.

(** The two halves of a float sum to it. *)
Theorem split_exact : forall a, format a -> let (high, rest) := split a in a = high + rest.
Proof.
  intros a Fa. rewrite split_is_veltkamp.
  destruct (fun H => Veltkamp_tail radix2 (-1074) 53 (fun x => negb (Z.even x)) 27 H ltac:(lia) ltac:(lia) ltac:(lia) a Fa)
    as [E _]; [lia |]. exact E.
Qed.

(** The product and its rounding error, if the product is zero or at least 2^-969. Below, the error is no float in
    general; the second result is then wrong by at most 7/2 of the smallest float. *)
Theorem two_product_exact : forall a b, format a -> format b ->
  let (p, e) := two_product (a, b) in
  p = rnd (a * b) /\ format p /\ format e /\
  (a * b = 0 \/ bpow (-969) <= Rabs (a * b) -> p + e = a * b) /\
  Rabs (a * b - (p + e)) <= 7 / 2 * bpow (-1074).
Proof.
  intros a b Fa Fb. unfold two_product. rewrite !split_is_veltkamp. unfold add, sub, mul.
  split; [reflexivity | split; [apply format_rnd | split; [apply format_rnd |]]].
  destruct (Dekker radix2 (-1074) 53 (fun x => negb (Z.even x))) with (x := a) (y := b) as [D E]; trivial; try lia.
  { left. reflexivity. }
  rewrite (Rplus_comm (- rnd (a * b))) in D, E.
  split; [intros H; symmetry; exact (D H) | exact E].
Qed.

(** Factors as [is_ordinary] admits them: 2^-400 <= |a| < 2^400. *)
Definition ordinary (a : R) : Prop := bpow (-400) <= Rabs a < bpow 400.

Theorem two_product_of_ordinary : forall a b, format a -> format b -> ordinary a -> ordinary b ->
  let (p, e) := two_product (a, b) in p = rnd (a * b) /\ p + e = a * b.
Proof.
  intros a b Fa Fb [La _] [Lb _]. generalize (two_product_exact a b Fa Fb).
  destruct (two_product (a, b)) as [p e]. intros [P [_ [_ [E _]]]]. split; [exact P |]. apply E. right.
  apply Rle_trans with (bpow (-400 + -400)); [apply bpow_le; lia |].
  rewrite bpow_plus, Rabs_mult. apply Rmult_le_compat; trivial; apply bpow_ge_0.
Qed.

