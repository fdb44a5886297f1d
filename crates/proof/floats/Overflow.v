(** Overflow in the sum of Knuth. If the result does not overflow and b is not the largest float, no intermediate result
    overflows. If b is the largest float, one can. *)

From Coq Require Import ZArith Reals Lra Lia.
From Flocq Require Import Core BinarySingleNaN.
From CannonpileFloats Require Import Model ErrorFree.

Open Scope R_scope.

(** ** Bounds of the intermediate results *)

(** The largest float. *)
Definition greatest : R := bpow 1024 - bpow 971.

Lemma powers : bpow 971 = 2 * bpow 970 /\ bpow 972 = 4 * bpow 970 /\ bpow 1023 = 9007199254740992 * bpow 970 /\
  bpow 1024 = 18014398509481984 * bpow 970 /\ 0 < bpow 970.
Proof.
  change 971%Z with (1 + 970)%Z. change 972%Z with (2 + 970)%Z. change 1023%Z with (53 + 970)%Z. change 1024%Z with (54 + 970)%Z.
  rewrite !bpow_plus. change (bpow 1) with 2. change (bpow 2) with 4. change (bpow 53) with 9007199254740992.
  change (bpow 54) with 18014398509481984. repeat split. apply bpow_gt_0.
Qed.

Lemma format_greatest : format greatest.
Proof.
  replace greatest with (IZR (2 ^ 53 - 1) * bpow 971); [apply format_multiple; lia |].
  destruct powers as [P1 [_ [_ [P4 _]]]]. unfold greatest. rewrite P4, P1. simpl (IZR _). lra.
Qed.

Lemma rnd_at_most_greatest : forall x, Rabs x <= greatest -> Rabs (rnd x) <= greatest.
Proof. intros x H. apply abs_round_le_generic; try typeclasses eauto; [exact format_greatest | exact H]. Qed.

(** The rounding error of a result that does not overflow. *)
Lemma error_below_greatest : forall x, Rabs (rnd x) <= greatest -> Rabs (rnd x - x) <= bpow 970.
Proof.
  intros x H. apply Rle_trans with (1 := error_le_half_ulp_round radix2 fexp (fun x => negb (Z.even x)) x).
  destruct powers as [P1 [_ [P3 [P4 P5]]]].
  assert (G : bpow 1023 <= greatest < bpow 1024) by (unfold greatest; lra).
  assert (U : ulp radix2 fexp greatest = bpow 971).
  { rewrite ulp_neq_0 by (apply Rgt_not_eq; generalize (bpow_gt_0 radix2 1023); lra).
    rewrite (cexp_fexp_pos radix2 fexp greatest 1024); [reflexivity | exact G]. }
  assert (L : ulp radix2 fexp (rnd x) <= ulp radix2 fexp greatest).
  { apply ulp_le; try typeclasses eauto. rewrite (Rabs_pos_eq greatest); [exact H |]. generalize (bpow_gt_0 radix2 1023). lra. }
  lra.
Qed.

Theorem two_sum_does_not_overflow : forall a b, format a -> format b ->
  Rabs a <= greatest -> Rabs b <= greatest - bpow 971 -> Rabs (rnd (a + b)) <= greatest ->
  let s := rnd (a + b) in
  let from_b := rnd (s - a) in
  let from_a := rnd (s - from_b) in
  Rabs from_b <= greatest /\ Rabs from_a <= greatest /\ Rabs (rnd (a - from_a)) <= greatest /\
  Rabs (rnd (b - from_b)) <= greatest /\ Rabs (rnd (rnd (a - from_a) + rnd (b - from_b))) <= greatest.
Proof.
  intros a b Fa Fb Ha Hb Hs s from_b from_a.
  destruct powers as [P1 [P2 [P3 [P4 P5]]]].
  assert (E1 := error_below_greatest (a + b) Hs). fold s in E1.
  assert (B1 : Rabs (s - a) <= greatest).
  { replace (s - a) with (b + (s - (a + b))) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (H1 : Rabs from_b <= greatest) by (apply rnd_at_most_greatest; exact B1).
  assert (E2 := error_below_greatest (s - a) H1). fold from_b in E2.
  assert (B2 : Rabs (s - from_b) <= greatest).
  { replace (s - from_b) with (a + - (from_b - (s - a))) by ring.
    destruct (Rle_or_lt (Rabs b) (Rabs a)) as [L | L].
    - assert (D : from_b = s - a) by (apply rnd_format; apply difference_is_float_if_less; trivial).
      rewrite D. replace (a + - (s - a - (s - a))) with a by ring. exact Ha.
    - apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  assert (H2 : Rabs from_a <= greatest) by (apply rnd_at_most_greatest; exact B2).
  assert (E3 := error_below_greatest (s - from_b) H2). fold from_a in E3.
  assert (B3 : Rabs (a - from_a) <= bpow 971).
  { replace (a - from_a) with ((from_b - (s - a)) + - (from_a - (s - from_b))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  assert (B4 : Rabs (b - from_b) <= bpow 971).
  { replace (b - from_b) with (- (s - (a + b)) + - (from_b - (s - a))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_Ropp. lra. }
  assert (H3 : Rabs (rnd (a - from_a)) <= bpow 971) by (apply rnd_at_most; [lia | exact B3]).
  assert (H4 : Rabs (rnd (b - from_b)) <= bpow 971) by (apply rnd_at_most; [lia | exact B4]).
  assert (H5 : Rabs (rnd (rnd (a - from_a) + rnd (b - from_b))) <= bpow 972).
  { apply rnd_at_most; [lia |]. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (G : bpow 972 <= greatest /\ bpow 971 <= greatest) by (unfold greatest; lra).
  repeat split; trivial; lra.
Qed.

(** ** IEEE 754 binary64, with infinities and not-a-number *)

Notation binary64 := (binary_float 53 1024).

#[export] Instance bits_below_exponent : Prec_lt_emax 53 1024 := eq_refl.

Definition add (x y : binary64) : binary64 := Bplus mode_NE x y.
Definition sub (x y : binary64) : binary64 := Bminus mode_NE x y.

Declare Scope binary64_scope.
Delimit Scope binary64_scope with B.
Arguments add x%B y%B.
Arguments sub x%B y%B.
Infix "+" := add : binary64_scope.
Infix "-" := sub : binary64_scope.
Local Open Scope binary64_scope.

(* begin crates/surd/src/error_free.rs two_sum *)
Definition two_sum '((a, b) : prod binary64 binary64) : prod binary64 binary64 :=
  let s := a + b in
  let from_b := s - a in
  let from_a := s - from_b in
  (s, (a - from_a) + (b - from_b)).
(* end *)

Local Close Scope binary64_scope.

(** An operation whose rounded result is a float returns it. *)
Lemma add_is_rounded : forall x y : binary64, is_finite x = true -> is_finite y = true ->
  Rabs (rnd (B2R x + B2R y)) <= greatest -> B2R (add x y) = rnd (B2R x + B2R y) /\ is_finite (add x y) = true.
Proof.
  intros x y Fx Fy H. generalize (Bplus_correct 53 1024 _ _ mode_NE x y Fx Fy).
  rewrite Rlt_bool_true; [intros [E [F _]]; split; [exact E | exact F] |].
  apply Rle_lt_trans with (1 := H). unfold greatest. generalize (bpow_gt_0 radix2 971). lra.
Qed.

Lemma sub_is_rounded : forall x y : binary64, is_finite x = true -> is_finite y = true ->
  Rabs (rnd (B2R x - B2R y)) <= greatest -> B2R (sub x y) = rnd (B2R x - B2R y) /\ is_finite (sub x y) = true.
Proof.
  intros x y Fx Fy H. generalize (Bminus_correct 53 1024 _ _ mode_NE x y Fx Fy).
  rewrite Rlt_bool_true; [intros [E [F _]]; split; [exact E | exact F] |].
  apply Rle_lt_trans with (1 := H). unfold greatest. generalize (bpow_gt_0 radix2 971). lra.
Qed.

(** The sum of Knuth on binary64: exact, if the sum does not overflow and b is not the largest float. *)
Theorem two_sum_of_binary64_is_exact : forall a b : binary64, is_finite a = true -> is_finite b = true ->
  Rabs (B2R b) <= greatest - bpow 971 -> Rabs (rnd (B2R a + B2R b)) <= greatest ->
  let (s, e) := two_sum (a, b) in
  is_finite s = true /\ is_finite e = true /\ B2R s + B2R e = B2R a + B2R b.
Proof.
  intros a b Fa Fb Hb Hs. unfold two_sum.
  assert (Ga : format (B2R a)) by exact (generic_format_B2R 53 1024 a).
  assert (Gb : format (B2R b)) by exact (generic_format_B2R 53 1024 b).
  assert (Ha : Rabs (B2R a) <= greatest) by exact (abs_B2R_le_emax_minus_prec 53 1024 _ a).
  destruct (two_sum_does_not_overflow _ _ Ga Gb Ha Hb Hs) as [H1 [H2 [H3 [H4 H5]]]].
  generalize (two_sum_exact _ _ Ga Gb). unfold Model.two_sum, Model.add, Model.sub. intros [_ [X _]].
  destruct (add_is_rounded a b Fa Fb Hs) as [Es Fs]. set (s := add a b) in *. rewrite <- Es in *.
  destruct (sub_is_rounded s a Fs Fa H1) as [E1 F1]. set (from_b := sub s a) in *. rewrite <- E1 in *.
  destruct (sub_is_rounded s from_b Fs F1 H2) as [E2 F2]. set (from_a := sub s from_b) in *. rewrite <- E2 in *.
  destruct (sub_is_rounded a from_a Fa F2 H3) as [E3 F3]. set (da := sub a from_a) in *. rewrite <- E3 in *.
  destruct (sub_is_rounded b from_b Fb F1 H4) as [E4 F4]. set (db := sub b from_b) in *. rewrite <- E4 in *.
  destruct (add_is_rounded da db F3 F4 H5) as [E5 F5].
  split; [exact Fs | split; [exact F5 |]]. rewrite E5. exact X.
Qed.

(** -1.5 2^971, and the largest float. *)
Definition small : binary64 := @B754_finite 53 1024 true 6755399441055744 919 eq_refl.
Definition largest : binary64 := @B754_finite 53 1024 false 9007199254740991 971 eq_refl.

(** If b is the largest float, the sum can be a float and its rounding error not-a-number. *)
Theorem two_sum_of_largest_fails :
  is_finite (fst (two_sum (small, largest))) = true /\ is_nan (snd (two_sum (small, largest))) = true.
Proof. vm_compute. split; reflexivity. Qed.
