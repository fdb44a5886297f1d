(** The functions of nearest.rs round correctly: to nearest, ties to even.

    A number without its sign is given as (m + epsilon) 2^exponent with an integer m and 0 <= epsilon < 1; [sticky] is true
    if epsilon > 0. The proofs are for any precision and any range of exponents, so for `f16`, `bf16`, `f32` and `f64`. Those
    about [round] are also for formats of one's own. *)

From Coq Require Import ZArith Reals Lra Lia Bool.
From Flocq Require Import Core.

Open Scope R_scope.

Section Nearest.

Variables precision min_exponent : Z.
Hypothesis precision_positive : (1 < precision)%Z.

#[local] Instance bits_are_positive : Prec_gt_0 precision.
Proof. unfold Prec_gt_0. lia. Qed.

Notation bpow e := (bpow radix2 e).
Notation fexp := (FLT_exp min_exponent precision).
Notation nearest := (round radix2 fexp ZnearestE).

(* quote crates/surd/src/nearest.rs bits: n.bits() as i64 *)
(** The number of bits of an integer that is not negative. *)
Definition bits (m : Z) : Z := Zdigits radix2 m.

(** The whole function. [F::from_parts] makes the float of its parts, the significand and the exponent. *)
(* quote crates/surd/src/nearest.rs round:
    const { assert!(F::PRECISION >= 2 && F::PRECISION <= 63) };
    if m.is_zero() && !sticky {
        return F::from_parts(false, 0, F::MIN_EXPONENT);
    }
    let last_bit = (bits(m) + exponent - i64::from(F::PRECISION)).max(F::MIN_EXPONENT);
    let dropped = last_bit - exponent;
    let Ok(dropped @ 1..) = u64::try_from(dropped) else {
        let significand = (m << -dropped).to_u64()?;
        return F::from_parts(negative, significand, last_bit);
    };
    let kept = (m >> dropped).to_u64()?;
    let half = m.bit(dropped - 1);
    let below_half = sticky || m.trailing_zeros().is_some_and(|zeros| zeros < dropped - 1);
    let up = half && (below_half || kept % 2 == 1);
    let (significand, carried) = (kept + u64::from(up), 1 << F::PRECISION);
    if significand == carried {
        return F::from_parts(negative, carried / 2, last_bit + 1);
    }
    F::from_parts(negative, significand, last_bit) *)
Definition last_bit (m exponent : Z) : Z := Z.max (bits m + exponent - precision) min_exponent.

Definition dropped (m exponent : Z) : Z := last_bit m exponent - exponent.

(** The significand before a carry. m has a bit below position d - 1 if and only if m is no multiple of 2^(d-1). *)
Definition significand (m : Z) (sticky : bool) (exponent : Z) : Z :=
  let d := dropped m exponent in
  if (1 <=? d)%Z then
    let kept := Z.shiftr m d in
    let half := Z.testbit m (d - 1) in
    let below_half := sticky || negb (m mod 2 ^ (d - 1) =? 0)%Z in
    let up := half && (below_half || Z.odd kept) in
    kept + Z.b2z up
  else Z.shiftl m (- d).

(** The parts of the float. *)
Definition parts (m : Z) (sticky : bool) (exponent : Z) : Z * Z :=
  if (m =? 0)%Z && negb sticky then (0, min_exponent)%Z else
  let carried := Z.shiftl 1 precision in
  if (1 <=? dropped m exponent)%Z && (significand m sticky exponent =? carried)%Z
  then (carried / 2, last_bit m exponent + 1)%Z
  else (significand m sticky exponent, last_bit m exponent).

(** The rounding of a positive number: significand times a power of two. If [sticky] is true, m has at least two bits more
    than the significand. *)
Theorem significand_is_nearest : forall m sticky exponent epsilon,
  (0 < m)%Z -> 0 <= epsilon < 1 -> (sticky = true <-> 0 < epsilon) ->
  (sticky = true -> (precision + 2 <= bits m)%Z) ->
  nearest ((IZR m + epsilon) * bpow exponent) = IZR (significand m sticky exponent) * bpow (last_bit m exponent).
Proof.
  intros m sticky exponent epsilon Hm He Hs Hb.
  set (x := (IZR m + epsilon) * bpow exponent). set (l := last_bit m exponent).
  assert (Pe : 0 < bpow exponent) by apply bpow_gt_0.
  assert (Hm1 : 1 <= IZR m) by (apply IZR_le; lia).
  (* The exponent of the last bit. *)
  assert (Hd : bpow (bits m - 1) <= IZR m /\ IZR m + 1 <= bpow (bits m)).
  { destruct (Zdigits_correct radix2 m) as [D1 D2]. rewrite Z.abs_eq in D1, D2 by lia. fold (bits m) in D1, D2.
    assert (B : (0 < bits m)%Z) by (apply Zdigits_gt_0; lia).
    rewrite <- !IZR_Zpower by lia. rewrite <- plus_IZR. split; apply IZR_le; simpl radix_val in *; lia. }
  assert (Hx : cexp radix2 fexp x = l).
  { unfold l, last_bit. rewrite (cexp_fexp_pos radix2 fexp x (bits m + exponent)).
    - unfold FLT_exp. reflexivity.
    - replace (bits m + exponent - 1)%Z with ((bits m - 1) + exponent)%Z by ring. rewrite !bpow_plus. unfold x. split.
      + apply Rmult_le_compat_r; lra.
      + apply Rmult_lt_compat_r; lra. }
  unfold round, F2R, scaled_mantissa. rewrite Hx. cbn [Fnum Fexp]. apply Rmult_eq_compat_r. apply f_equal.
  unfold significand, dropped. fold l. set (d := (l - exponent)%Z).
  replace (x * bpow (- l)) with ((IZR m + epsilon) * bpow (- d)).
  2: { unfold x, d. rewrite Rmult_assoc, <- bpow_plus. f_equal. f_equal. ring. }
  destruct (Z.leb_spec 1 d) as [D | D].
  - (* Bits are dropped. *)
    set (kept := Z.shiftr m d). set (rest := (m mod 2 ^ d)%Z).
    assert (Pd : (0 < 2 ^ d)%Z) by (apply Z.pow_pos_nonneg; lia).
    assert (Hk : m = (2 ^ d * kept + rest)%Z).
    { unfold kept, rest. rewrite Z.shiftr_div_pow2 by lia. apply Z.div_mod. lia. }
    assert (Hr : (0 <= rest < 2 ^ d)%Z) by (apply Z.mod_pos_bound; exact Pd).
    assert (Hp : (2 ^ d = 2 * 2 ^ (d - 1))%Z) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
    set (h := (2 ^ (d - 1))%Z) in *. assert (Ph : (0 < h)%Z) by lia.
    assert (Hk2 : m = (2 * (h * kept) + rest)%Z) by (rewrite Hk at 1; rewrite Hp; ring).
    (* The bit below the kept ones, and the bits below it. *)
    assert (Hhalf : Z.testbit m (d - 1) = (h <=? rest)%Z).
    { generalize (Z.testbit_spec' m (d - 1) ltac:(lia)). fold h. intros T.
      destruct (Z.leb_spec h rest) as [G | G].
      - assert (Q : (m / h = 2 * kept + 1)%Z).
        { symmetry. apply Z.div_unique with (rest - h)%Z; [lia |]. rewrite Hk2 at 1. ring. }
        rewrite Q, Z.add_comm, Z.mul_comm, Z.mod_add in T by lia. destruct (Z.testbit m (d - 1)); [reflexivity | discriminate].
      - assert (Q : (m / h = 2 * kept)%Z).
        { symmetry. apply Z.div_unique with rest; [lia |]. rewrite Hk2 at 1. ring. }
        rewrite Q, Z.mul_comm, Z.mod_mul in T by lia. destruct (Z.testbit m (d - 1)); [discriminate | reflexivity]. }
    (* The exact quotient. *)
    assert (P2 : bpow d = IZR (2 * h)).
    { rewrite <- Hp. symmetry. apply (IZR_Zpower radix2). lia. }
    assert (Hh : 1 <= IZR h) by (apply IZR_le; lia).
    assert (Hy : (IZR m + epsilon) * bpow (- d) = IZR kept + (IZR rest + epsilon) / (2 * IZR h)).
    { rewrite bpow_opp, P2. rewrite Hk at 1. rewrite Hp, plus_IZR, !mult_IZR. field. lra. }
    rewrite Hy. set (f := (IZR rest + epsilon) / (2 * IZR h)).
    assert (R0 : 0 <= IZR rest) by (apply IZR_le; lia).
    assert (R1 : IZR rest + 1 <= 2 * IZR h).
    { rewrite <- (mult_IZR 2), <- plus_IZR. apply IZR_le. lia. }
    assert (Hf : 0 <= f < 1).
    { unfold f. split; [apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra] |].
      apply Rmult_lt_reg_r with (2 * IZR h); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
    assert (Hfloor : Zfloor (IZR kept + f) = kept).
    { apply Zfloor_imp. rewrite plus_IZR. lra. }
    assert (Hceil : 0 < f -> Zceil (IZR kept + f) = (kept + 1)%Z).
    { intros P. rewrite Zceil_floor_neq; rewrite Hfloor; [reflexivity | lra]. }
    unfold Znearest. rewrite Hfloor. replace (IZR kept + f - IZR kept) with f by ring.
    assert (Hc : Rcompare f (/ 2) = Rcompare (IZR rest + epsilon) (IZR h)).
    { rewrite <- (Rcompare_mult_r (2 * IZR h) f) by lra. f_equal; unfold f; field; lra. }
    rewrite Hc, Hhalf.
    destruct (Z.leb_spec h rest) as [G | G]; cbn [andb].
    + assert (Hmod : (m mod h = rest - h)%Z).
      { symmetry. apply Z.mod_unique with (2 * kept + 1)%Z; [lia |]. rewrite Hk2 at 1. ring. }
      rewrite Hmod.
      assert (G' : IZR h <= IZR rest) by (apply IZR_le; exact G).
      assert (F0 : 0 < f).
      { unfold f. apply Rmult_lt_0_compat; [lra | apply Rinv_0_lt_compat; lra]. }
      destruct (Z.eqb_spec (rest - h) 0) as [T | T].
      * assert (T' : IZR rest = IZR h) by (f_equal; lia). rewrite T'.
        destruct sticky; cbn [orb negb].
        -- assert (E0 : 0 < epsilon) by (apply Hs; reflexivity).
           rewrite Rcompare_Gt by lra. rewrite Hceil by exact F0. reflexivity.
        -- assert (E0 : epsilon = 0).
           { destruct (Req_dec epsilon 0) as [E | E]; [exact E |].
             assert (0 < epsilon) as Q by lra. apply Hs in Q. discriminate. }
           rewrite Rcompare_Eq by lra. rewrite Hceil by exact F0. rewrite <- Z.negb_even.
           destruct (Z.even kept); cbn [negb Z.b2z]; lia.
      * assert (L : IZR h + 1 <= IZR rest) by (rewrite <- plus_IZR; apply IZR_le; lia).
        rewrite Rcompare_Gt by lra. rewrite Hceil by exact F0. cbn [negb]. rewrite orb_true_r. reflexivity.
    + assert (L : IZR rest + 1 <= IZR h) by (rewrite <- plus_IZR; apply IZR_le; lia).
      rewrite Rcompare_Lt by lra. cbn [Z.b2z]. lia.
  - (* All bits are kept. *)
    assert (E0 : epsilon = 0).
    { destruct (Req_dec epsilon 0) as [E | E]; [exact E |].
      assert (Q : 0 < epsilon) by lra. apply Hs in Q. specialize (Hb Q).
      exfalso. unfold d, l, last_bit in D. lia. }
    rewrite E0, Rplus_0_r, Z.shiftl_mul_pow2 by lia.
    rewrite <- (IZR_Zpower radix2) by lia. rewrite <- mult_IZR. apply (Zrnd_IZR ZnearestE).
Qed.

Lemma bits_bounds : forall n, (0 < n)%Z -> bpow (bits n - 1) <= IZR n < bpow (bits n).
Proof.
  intros n Hn. destruct (Zdigits_correct radix2 n) as [D1 D2]. rewrite Z.abs_eq in D1, D2 by lia. fold (bits n) in D1, D2.
  assert (B : (0 < bits n)%Z) by (apply Zdigits_gt_0; lia).
  rewrite <- !IZR_Zpower by lia. split; [apply IZR_le | apply IZR_lt]; assumption.
Qed.

(** ** The parts of the float *)

Definition hidden : Z := 2 ^ (precision - 1).

Lemma hidden_positive : (0 < hidden)%Z.
Proof. apply Z.pow_pos_nonneg; lia. Qed.

Lemma twice_hidden : (2 ^ precision = 2 * hidden)%Z.
Proof. unfold hidden. rewrite <- Z.pow_succ_r by lia. f_equal. lia. Qed.

(** Before a carry, the significand has at most one bit more than the format, and is below the hidden bit only among the
    subnormals. *)
Lemma significand_fits : forall m sticky exponent, (0 < m)%Z ->
  (0 <= significand m sticky exponent <= 2 * hidden)%Z /\
  (min_exponent <= last_bit m exponent)%Z /\
  ((significand m sticky exponent < hidden)%Z -> last_bit m exponent = min_exponent) /\
  ((dropped m exponent < 1)%Z -> (significand m sticky exponent < 2 * hidden)%Z).
Proof.
  intros m sticky exponent Hm. destruct (bits_bounds m Hm) as [L U].
  assert (B : (0 < bits m)%Z) by (apply Zdigits_gt_0; lia).
  rewrite <- (IZR_Zpower radix2) in L, U by lia. apply le_IZR in L. apply lt_IZR in U. simpl radix_val in L, U.
  assert (Kept : (dropped m exponent < 1)%Z -> (0 <= significand m sticky exponent < 2 * hidden)%Z).
  { unfold significand. set (d := dropped m exponent). intros K. rewrite <- twice_hidden.
    assert (D : (bits m <= precision + d)%Z) by (unfold d, dropped, last_bit; lia). destruct (Z.leb_spec 1 d); [lia |].
    rewrite Z.shiftl_mul_pow2 by lia. assert (P : (0 < 2 ^ (- d))%Z) by (apply Z.pow_pos_nonneg; lia).
    split; [nia |]. apply Z.lt_le_trans with (2 ^ bits m * 2 ^ (- d))%Z; [nia |]. rewrite <- Z.pow_add_r by lia.
    apply Z.pow_le_mono_r; lia. }
  split; [| split; [apply Z.le_max_r | split; [| intros K; apply Kept; exact K]]].
  - destruct (Z.lt_ge_cases (dropped m exponent) 1) as [K | K]; [generalize (Kept K); lia |].
    unfold significand. set (d := dropped m exponent). assert (D : (bits m <= precision + d)%Z) by (unfold d, dropped, last_bit; lia).
    rewrite <- twice_hidden. destruct (Z.leb_spec 1 d); [| unfold d in *; lia].
    assert (K' : (0 <= Z.shiftr m d < 2 ^ precision)%Z).
    { rewrite Z.shiftr_div_pow2 by lia. assert (P : (0 < 2 ^ d)%Z) by (apply Z.pow_pos_nonneg; lia).
      split; [apply Z.div_pos; lia |]. apply Z.div_lt_upper_bound; [exact P |]. rewrite <- Z.pow_add_r by lia.
      apply Z.lt_le_trans with (1 := U). apply Z.pow_le_mono_r; lia. }
    destruct (_ && _); cbn [Z.b2z]; lia.
  - intros H. destruct (Z.le_gt_cases (bits m + exponent - precision) min_exponent) as [G | G]; [unfold last_bit; lia |].
    exfalso. revert H. apply Zle_not_lt. unfold significand.
    assert (D : dropped m exponent = (bits m - precision)%Z) by (unfold dropped, last_bit; lia). rewrite D. clear D.
    set (d := (bits m - precision)%Z). destruct (Z.leb_spec 1 d).
    + apply Z.le_trans with (Z.shiftr m d); [| destruct (_ && _); cbn [Z.b2z]; lia].
      rewrite Z.shiftr_div_pow2 by lia. assert (P : (0 < 2 ^ d)%Z) by (apply Z.pow_pos_nonneg; lia).
      apply Z.div_le_lower_bound; [exact P |]. unfold hidden. rewrite <- Z.pow_add_r by lia.
      replace (d + (precision - 1))%Z with (bits m - 1)%Z by (unfold d; ring). exact L.
    + rewrite Z.shiftl_mul_pow2 by lia. assert (P : (0 < 2 ^ (- d))%Z) by (apply Z.pow_pos_nonneg; lia).
      apply Z.le_trans with (2 ^ (bits m - 1) * 2 ^ (- d))%Z; [| nia]. rewrite <- Z.pow_add_r by lia.
      apply Z.eq_le_incl. unfold hidden. f_equal. unfold d. ring.
Qed.

(** The conditions of the documentation of [from_parts]. *)
Definition fits (significand exponent : Z) : Prop :=
  (0 <= significand < 2 ^ precision)%Z /\ (min_exponent <= exponent)%Z /\
  ((significand < 2 ^ (precision - 1))%Z -> exponent = min_exponent).

(** [round] in any format: its parts meet these conditions, and their value is the nearest one. *)
Theorem parts_are_nearest : forall m sticky exponent epsilon,
  (0 <= m)%Z -> 0 <= epsilon < 1 -> (sticky = true <-> 0 < epsilon) ->
  (sticky = true -> (precision + 2 <= bits m)%Z) ->
  let (s, e) := parts m sticky exponent in
  nearest ((IZR m + epsilon) * bpow exponent) = IZR s * bpow e /\ fits s e.
Proof.
  intros m sticky exponent epsilon Hm He Hs Hb. assert (Hh := hidden_positive). unfold parts, fits.
  rewrite twice_hidden. fold hidden. rewrite Z.shiftl_1_l, twice_hidden.
  destruct (Z.eqb_spec m 0) as [M | M]; [destruct sticky |]; cbn [negb andb].
  - exfalso. specialize (Hb eq_refl). rewrite M in Hb. cbn in Hb. lia.
  - assert (E : epsilon = 0).
    { destruct (Req_dec epsilon 0) as [E | E]; [exact E |]. assert (Q : 0 < epsilon) by lra. apply Hs in Q. discriminate. }
    rewrite M, E, Rplus_0_r, !Rmult_0_l. split; [apply round_0; typeclasses eauto | lia].
  - destruct (significand_fits m sticky exponent ltac:(lia)) as [S [L [Sub K]]].
    rewrite (significand_is_nearest m sticky exponent epsilon) by (trivial; lia).
    destruct (Z.leb_spec 1 (dropped m exponent)); cbn [andb].
    + destruct (Z.eqb_spec (significand m sticky exponent) (2 * hidden)) as [T | T]; [| split; [reflexivity | lia]].
      rewrite T, (Z.mul_comm 2), Z.div_mul by lia. split; [| lia].
      rewrite mult_IZR, bpow_plus. change (bpow 1) with 2. ring.
    + specialize (K ltac:(lia)). split; [reflexivity | lia].
Qed.

(** Up to a precision of 63, all integers of [round] are below 2^64: no bit is lost, and [to_u64] does not return [None]. *)
Theorem integers_are_short : forall m sticky exponent, (precision <= 63)%Z -> (0 < m)%Z ->
  (0 <= significand m sticky exponent < 2 ^ 64)%Z /\ (Z.shiftl 1 precision < 2 ^ 64)%Z.
Proof.
  intros m sticky exponent Hp Hm. destruct (significand_fits m sticky exponent Hm) as [S _].
  assert (2 ^ precision <= 2 ^ 63)%Z by (apply Z.pow_le_mono_r; lia). rewrite <- twice_hidden in S.
  rewrite Z.shiftl_1_l. change (2 ^ 64)%Z with (2 * 2 ^ 63)%Z. lia.
Qed.

(** ** The bits of the float *)

(** The floats are below 2^max_exponent: [MAX_EXP] of Rust is 16 for `f16`, 128 for `bf16` and `f32`, and 1024 for `f64`. *)
Variable max_exponent : Z.
Hypothesis exponents_in_order : (min_exponent + precision <= max_exponent)%Z.

(** The biased exponent of the largest floats. [MIN_EXP] of Rust is min_exponent + precision. *)
Definition largest : Z := max_exponent - (min_exponent + precision) + 1.

(** The whole function. The macro gives it for `f32`, `f64`, `f16` and `bf16`. *)
(* quote crates/surd/src/nearest.rs from_parts:
    let hidden = 1_u64 << (Self::PRECISION - 1);
    let above_least = exponent.checked_sub(Self::MIN_EXPONENT)?;
    if significand >= 2 * hidden || above_least < 0 || (significand < hidden && above_least > 0) {
        return None;
    }
    let biased = if significand < hidden { 0 } else { above_least.checked_add(1)? };
    let largest = i64::from(<$float>::MAX_EXP) - i64::from(<$float>::MIN_EXP) + 1;
    if biased > largest {
        return None;
    }
    let field = <$bits>::try_from(biased).ok()? << (Self::PRECISION - 1);
    let magnitude = field | <$bits>::try_from(significand & (hidden - 1)).ok()?;
    let float = <$float>::from_bits(magnitude);
    Some(if negative { -float } else { float }) *)
(** The bits without the sign. *)
Definition from_parts (significand exponent : Z) : option Z :=
  let above_least := (exponent - min_exponent)%Z in
  if ((2 * hidden <=? significand) || (above_least <? 0) || (significand <? hidden) && (0 <? above_least))%Z then None else
  let biased := if (significand <? hidden)%Z then 0%Z else (above_least + 1)%Z in
  if (largest <? biased)%Z then None else
  let field := Z.shiftl biased (precision - 1) in
  Some (Z.lor field (Z.land significand (hidden - 1))).

(** The value of the bits, by IEEE 754. *)
Definition value_of_bits (b : Z) : R :=
  let biased := (b / hidden)%Z in
  let fraction := (b mod hidden)%Z in
  if (biased =? 0)%Z then IZR fraction * bpow min_exponent
  else IZR (hidden + fraction) * bpow (biased - 1 + min_exponent).

Lemma fields_do_not_overlap : forall k s, (0 <= s)%Z ->
  Z.lor (Z.shiftl k (precision - 1)) (Z.land s (hidden - 1)) = (k * hidden + s mod hidden)%Z.
Proof.
  intros k s Hs. assert (E : (hidden - 1 = Z.ones (precision - 1))%Z) by (rewrite Z.ones_equiv; unfold hidden; lia).
  rewrite E, <- Z.lxor_lor, <- Z.add_nocarry_lxor.
  - rewrite Z.shiftl_mul_pow2, Z.land_ones by lia. reflexivity.
  - rewrite (Z.land_comm s), Z.land_assoc, Z.land_ones, Z.shiftl_mul_pow2, Z.mod_mul by (try apply Z.pow_nonzero; lia).
    apply Z.land_0_l.
  - rewrite (Z.land_comm s), Z.land_assoc, Z.land_ones, Z.shiftl_mul_pow2, Z.mod_mul by (try apply Z.pow_nonzero; lia).
    apply Z.land_0_l.
Qed.

(** The bits are those of the given number, whatever the parts. The parts of a float have none exactly if the number is
    2^max_exponent or more. *)
Theorem from_parts_is_exact : forall s e, (0 <= s)%Z ->
  match from_parts s e with
  | Some b => value_of_bits b = IZR s * bpow e /\ IZR s * bpow e < bpow max_exponent /\ (0 <= b < (largest + 1) * hidden)%Z
  | None => fits s e -> bpow max_exponent <= IZR s * bpow e
  end.
Proof.
  intros s e Hs. assert (Hh := hidden_positive). unfold from_parts, fits. rewrite twice_hidden. fold hidden.
  assert (PH : IZR hidden = bpow (precision - 1)) by (apply (IZR_Zpower radix2); lia).
  assert (P2 : IZR (2 * hidden) = bpow precision) by (rewrite <- twice_hidden; apply (IZR_Zpower radix2); lia).
  assert (M := Z.mod_pos_bound s hidden Hh).
  assert (V : forall k, ((k * hidden + s mod hidden) / hidden = k /\ (k * hidden + s mod hidden) mod hidden = s mod hidden)%Z).
  { intros k. split.
    - rewrite Z.div_add_l, Z.div_small by lia. lia.
    - rewrite Z.add_comm, Z.mod_add, Z.mod_small by lia. reflexivity. }
  assert (Less : forall k, (e + precision <= k)%Z -> (s < 2 * hidden)%Z -> IZR s * bpow e < bpow k).
  { intros k Hk S. apply Rlt_le_trans with (bpow (e + precision)); [| apply bpow_le; exact Hk].
    rewrite (Z.add_comm e), bpow_plus, <- P2. apply Rmult_lt_compat_r; [apply bpow_gt_0 | apply IZR_lt; exact S]. }
  destruct (Z.leb_spec (2 * hidden) s); cbn [orb]; [lia |].
  destruct (Z.ltb_spec (e - min_exponent) 0); cbn [orb]; [lia |].
  destruct (Z.ltb_spec s hidden) as [S | S]; cbn [andb].
  - destruct (Z.ltb_spec 0 (e - min_exponent)); [lia |]. assert (E : e = min_exponent) by lia.
    destruct (Z.ltb_spec largest 0); [unfold largest in *; lia |]. rewrite fields_do_not_overlap by exact Hs.
    destruct (V 0%Z) as [V1 V2]. unfold value_of_bits. rewrite V1, V2, Z.mod_small by lia. rewrite E at 1.
    split; [reflexivity | split; [apply Less; lia | nia]].
  - set (k := (e - min_exponent + 1)%Z). destruct (Z.ltb_spec largest k) as [O | O].
    + intros _. apply Rle_trans with (bpow (precision - 1) * bpow e).
      * rewrite <- bpow_plus. apply bpow_le. unfold k, largest in O. lia.
      * rewrite <- PH. apply Rmult_le_compat_r; [apply bpow_ge_0 | apply IZR_le; exact S].
    + rewrite fields_do_not_overlap by exact Hs. destruct (V k) as [V1 V2]. unfold value_of_bits. rewrite V1, V2.
      destruct (Z.eqb_spec k 0); [unfold k in *; lia |].
      split; [| split; [apply Less; [unfold k, largest in *; lia | assumption] | unfold k in *; nia]].
      assert (D : (s mod hidden = s - hidden)%Z) by (symmetry; apply Z.mod_unique with 1%Z; lia).
      rewrite D. f_equal; [f_equal; ring | f_equal; unfold k; ring].
Qed.

(** The bits are those of the float nearest to x. There are none exactly if this float would be 2^max_exponent or more. *)
Definition correct (x : R) (result : option Z) : Prop :=
  match result with
  | Some b => value_of_bits b = nearest x /\ nearest x < bpow max_exponent /\ (0 <= b < (largest + 1) * hidden)%Z
  | None => bpow max_exponent <= nearest x
  end.

Lemma parts_are_correct : forall x s e, nearest x = IZR s * bpow e /\ fits s e -> correct x (from_parts s e).
Proof.
  intros x s e [N F]. unfold correct. rewrite N. generalize (from_parts_is_exact s e ltac:(unfold fits in F; lia)).
  destruct (from_parts s e); [trivial | intros H; exact (H F)].
Qed.

(** The sign is put on the float last. *)
Lemma nearest_of_the_negative : forall x, nearest (- x) = - nearest x.
Proof. intros x. apply round_NE_opp. Qed.

(** ** Rationals *)

(* quote crates/surd/src/nearest.rs guard_bits: i64::from(F::PRECISION) + 3 *)
Definition guard_bits : Z := precision + 3.

(* quote crates/surd/src/nearest.rs shifted_quotient: if shift >= 0 { (n << shift).div_rem(d) } else { n.div_rem(&(d << -shift)) } *)
Definition shifted (n d shift : Z) : Z * Z :=
  if (0 <=? shift)%Z then (Z.shiftl n shift, d) else (n, Z.shiftl d (- shift)).

(* quote crates/surd/src/nearest.rs nearest_ratio:
    let scale = guard_bits::<F>() - (bits(n) - bits(d));
    let (quotient, remainder) = shifted_quotient(n, d, scale);
    round(negative, &quotient, !remainder.is_zero(), -scale) *)
Definition ratio_scale (n d : Z) : Z := guard_bits - (bits n - bits d).

(** A number of at least 2^k has more than k bits. *)
Lemma many_bits : forall m k, (0 <= k)%Z -> bpow k <= IZR m -> (0 < m)%Z /\ (k + 1 <= bits m)%Z.
Proof.
  intros m k Hk H. assert (Hm : (0 < m)%Z) by (apply lt_IZR; apply Rlt_le_trans with (2 := H); apply bpow_gt_0).
  split; [exact Hm |]. destruct (bits_bounds m Hm) as [_ L].
  assert (k < bits m)%Z; [| lia]. apply (lt_bpow radix2). lra.
Qed.

(** The division of n 2^shift by d is a division of the two shifted integers. *)
Lemma shifted_is_scaled : forall n d shift, (0 < n)%Z -> (0 < d)%Z ->
  let (a, b) := shifted n d shift in (0 < a)%Z /\ (0 < b)%Z /\ IZR a / IZR b = IZR n / IZR d * bpow shift.
Proof.
  intros n d shift Hn Hd. unfold shifted.
  assert (Rd : IZR d <> 0) by (apply IZR_neq; lia).
  destruct (Z.leb_spec 0 shift) as [S | S]; rewrite Z.shiftl_mul_pow2 by lia.
  - assert (P : (0 < 2 ^ shift)%Z) by (apply Z.pow_pos_nonneg; lia).
    split; [nia | split; [exact Hd |]]. rewrite mult_IZR, (IZR_Zpower radix2) by lia. field. exact Rd.
  - assert (P : (0 < 2 ^ (- shift))%Z) by (apply Z.pow_pos_nonneg; lia).
    split; [exact Hn | split; [nia |]]. rewrite mult_IZR, (IZR_Zpower radix2), bpow_opp by lia. field.
    split; [exact Rd | apply Rgt_not_eq, bpow_gt_0].
Qed.

(** [nearest_ratio]: the quotient of two integers that are not negative, correctly rounded. *)
Theorem ratio_is_nearest : forall n d, (0 <= n)%Z -> (0 < d)%Z ->
  let scale := ratio_scale n d in
  let (a, b) := shifted n d scale in
  let quotient := (a / b)%Z in
  let remainder := (a mod b)%Z in
  let (s, e) := parts quotient (negb (remainder =? 0)%Z) (- scale) in
  nearest (IZR n / IZR d) = IZR s * bpow e /\ fits s e.
Proof.
  intros n d Hn0 Hd scale. destruct (Z.eq_dec n 0) as [N | Hn'].
  { assert (A : let (a, b) := shifted n d scale in a = 0%Z /\ b <> 0%Z).
    { rewrite N. unfold shifted. destruct (Z.leb_spec 0 scale); [rewrite Z.shiftl_0_l; lia |].
      rewrite Z.shiftl_mul_pow2 by lia. assert (P : (0 < 2 ^ (- scale))%Z) by (apply Z.pow_pos_nonneg; lia). nia. }
    destruct (shifted n d scale) as [a b]. destruct A as [-> B]. cbv zeta. rewrite Z.div_0_l, Z.mod_0_l by exact B.
    cbn [Z.eqb negb]. replace (IZR n / IZR d) with ((IZR 0 + 0) * bpow (- scale)) by (rewrite N; unfold Rdiv; ring).
    apply parts_are_nearest; [lia | lra | split; [discriminate | lra] | discriminate]. }
  assert (Hn : (0 < n)%Z) by lia. clear Hn0 Hn'. generalize (shifted_is_scaled n d scale Hn Hd).
  destruct (shifted n d scale) as [a b]. intros [Ha [Hb Hq]]. cbv zeta.
  assert (Rb : 0 < IZR b) by (apply IZR_lt; exact Hb).
  assert (Hdiv := Z.div_mod a b ltac:(lia)). assert (Hmod := Z.mod_pos_bound a b Hb).
  set (q := (a / b)%Z) in *. set (r := (a mod b)%Z) in *.
  assert (E : IZR a / IZR b = IZR q + IZR r / IZR b).
  { rewrite Hdiv, plus_IZR, mult_IZR. field. lra. }
  assert (R0 : 0 <= IZR r) by (apply IZR_le; lia). assert (R1 : IZR r < IZR b) by (apply IZR_lt; lia).
  assert (F : 0 <= IZR r / IZR b < 1).
  { split; [apply Rmult_le_pos; [exact R0 | apply Rlt_le, Rinv_0_lt_compat; exact Rb] |].
    apply Rmult_lt_reg_r with (IZR b); [exact Rb |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  (* The quotient has enough bits. *)
  destruct (bits_bounds n Hn) as [Ln _]. destruct (bits_bounds d Hd) as [_ Ud].
  assert (Rd : 0 < IZR d) by (apply IZR_lt; exact Hd).
  assert (L : bpow (precision + 2) <= IZR a / IZR b).
  { rewrite Hq. replace (precision + 2)%Z with ((bits n - 1) + (- bits d) + scale)%Z by (unfold scale, ratio_scale, guard_bits; ring).
    rewrite !bpow_plus, (bpow_opp radix2 (bits d)). apply Rmult_le_compat_r; [apply bpow_ge_0 |].
    unfold Rdiv. apply Rmult_le_compat; trivial; [apply bpow_ge_0 | apply Rlt_le, Rinv_0_lt_compat, bpow_gt_0 |].
    apply Rinv_le; lra. }
  assert (Lq : bpow (precision + 2) <= IZR q).
  { rewrite <- (IZR_Zpower radix2) in * by lia. apply IZR_le.
    assert (IZR (radix2 ^ (precision + 2)) < IZR (q + 1)) by (rewrite plus_IZR; lra). apply lt_IZR in H. lia. }
  destruct (many_bits q (precision + 2) ltac:(lia) Lq) as [Q0 Qb].
  replace (IZR n / IZR d) with ((IZR q + IZR r / IZR b) * bpow (- scale)).
  2: { rewrite <- E, Hq, Rmult_assoc, <- bpow_plus. replace (scale + - scale)%Z with 0%Z by ring. simpl. ring. }
  apply parts_are_nearest; [lia | exact F | |].
  - destruct (Z.eqb_spec r 0) as [Z | Z]; cbn [negb]; split; intros H; try discriminate; try reflexivity.
    + exfalso. rewrite Z in H. unfold Rdiv in H. lra.
    + apply Rmult_lt_0_compat; [apply IZR_lt; lia | apply Rinv_0_lt_compat; exact Rb].
  - intros _. lia.
Qed.

(** The bits that [nearest_ratio] gives are correct. *)
Corollary ratio_is_correct : forall n d, (0 <= n)%Z -> (0 < d)%Z ->
  let scale := ratio_scale n d in
  let (a, b) := shifted n d scale in
  let (s, e) := parts (a / b) (negb (a mod b =? 0)%Z) (- scale) in
  correct (IZR n / IZR d) (from_parts s e).
Proof.
  intros n d Hn Hd scale. generalize (ratio_is_nearest n d Hn Hd). cbv zeta. fold scale.
  destruct (shifted n d scale). destruct (parts _ _ _). apply parts_are_correct.
Qed.

(** ** Square roots *)

(* quote crates/surd/src/nearest.rs nearest_root:
    let scale = guard_bits::<F>() - (bits(n) - bits(d)).div_euclid(2);
    let (quotient, _) = shifted_quotient(n, d, 2 * scale);
    let sticky = true;
    round(negative, &quotient.sqrt(), sticky, -scale) *)
Definition root_scale (n d : Z) : Z := guard_bits - (bits n - bits d) / 2.

(** [nearest_root]: the square root of a quotient of two positive integers, correctly rounded, if no square of a fraction with
    a power of two as denominator equals the quotient. This holds for every irrational root. *)
Theorem root_is_nearest : forall n d, (0 < n)%Z -> (0 < d)%Z ->
  let scale := root_scale n d in
  let (a, b) := shifted n d (2 * scale) in
  let root := Z.sqrt (a / b) in
  IZR root * bpow (- scale) <> sqrt (IZR n / IZR d) ->
  let (s, e) := parts root true (- scale) in
  nearest (sqrt (IZR n / IZR d)) = IZR s * bpow e /\ fits s e.
Proof.
  intros n d Hn Hd scale. generalize (shifted_is_scaled n d (2 * scale) Hn Hd).
  destruct (shifted n d (2 * scale)) as [a b]. intros [Ha [Hb Hq]]. cbv zeta. intros Hirr.
  assert (Rb : 0 < IZR b) by (apply IZR_lt; exact Hb).
  assert (Rn : 0 < IZR n) by (apply IZR_lt; exact Hn). assert (Rd : 0 < IZR d) by (apply IZR_lt; exact Hd).
  assert (Hdiv := Z.div_mod a b ltac:(lia)). assert (Hmod := Z.mod_pos_bound a b Hb).
  set (q := (a / b)%Z) in *. set (r := (a mod b)%Z) in *.
  assert (Q0 : (0 <= q)%Z) by (apply Z.div_pos; lia).
  destruct (Z.sqrt_spec q Q0) as [S1 S2]. set (s := Z.sqrt q) in *. assert (S0 : (0 <= s)%Z) by apply Z.sqrt_nonneg.
  set (y := sqrt (IZR n / IZR d) * bpow scale).
  assert (X0 : 0 < IZR n / IZR d) by (apply Rmult_lt_0_compat; [exact Rn | apply Rinv_0_lt_compat; exact Rd]).
  assert (Y0 : 0 <= y) by (apply Rmult_le_pos; [apply sqrt_pos | apply bpow_ge_0]).
  assert (Y2 : y * y = IZR a / IZR b).
  { rewrite Hq. replace (2 * scale)%Z with (scale + scale)%Z by ring. rewrite bpow_plus. unfold y.
    rewrite <- (sqrt_sqrt (IZR n / IZR d)) at 3 by lra. ring. }
  assert (E : IZR a / IZR b * IZR b = IZR a) by (field; lra).
  assert (A : IZR q * IZR b <= IZR a < (IZR q + 1) * IZR b).
  { rewrite <- (plus_IZR q 1), <- !mult_IZR. split; [apply IZR_le | apply IZR_lt]; lia. }
  assert (Lq : IZR q <= y * y).
  { rewrite Y2. apply Rmult_le_reg_r with (IZR b); lra. }
  assert (Uq : y * y < IZR q + 1).
  { rewrite Y2. apply Rmult_lt_reg_r with (IZR b); lra. }
  assert (RS : 0 <= IZR s) by (apply IZR_le; exact S0).
  assert (Ls : IZR s <= y).
  { apply Rsqr_incr_0_var; [| exact Y0]. unfold Rsqr. apply Rle_trans with (2 := Lq). rewrite <- mult_IZR. apply IZR_le. lia. }
  assert (Us : y < IZR s + 1).
  { apply Rsqr_incrst_0; [| exact Y0 | lra]. unfold Rsqr. apply Rlt_le_trans with (1 := Uq).
    rewrite <- (plus_IZR s 1), <- (plus_IZR q 1), <- mult_IZR. apply IZR_le. lia. }
  assert (Back : forall z, z * bpow scale = y -> z = sqrt (IZR n / IZR d)).
  { intros z Hz. apply Rmult_eq_reg_r with (bpow scale); [exact Hz | apply Rgt_not_eq, bpow_gt_0]. }
  assert (Ne : IZR s <> y).
  { intros Q. apply Hirr. apply Back. rewrite Rmult_assoc, <- bpow_plus. replace (- scale + scale)%Z with 0%Z by ring.
    simpl. lra. }
  (* The root has enough bits. *)
  destruct (bits_bounds n Hn) as [Ln _]. destruct (bits_bounds d Hd) as [_ Ud].
  assert (L : bpow (2 * (precision + 2)) <= y * y).
  { rewrite Y2, Hq. apply Rle_trans with (bpow (bits n - 1) * / bpow (bits d) * bpow (2 * scale)).
    - rewrite <- bpow_opp, <- !bpow_plus. apply bpow_le. unfold scale, root_scale, guard_bits.
      generalize (Z.mul_div_le (bits n - bits d) 2 ltac:(lia)). lia.
    - apply Rmult_le_compat_r; [apply bpow_ge_0 |].
      unfold Rdiv. apply Rmult_le_compat; trivial; [apply bpow_ge_0 | apply Rlt_le, Rinv_0_lt_compat, bpow_gt_0 |].
      apply Rinv_le; lra. }
  assert (Ly : bpow (precision + 2) <= y).
  { apply Rsqr_incr_0_var; [| exact Y0]. unfold Rsqr. rewrite <- bpow_plus.
    replace (precision + 2 + (precision + 2))%Z with (2 * (precision + 2))%Z by ring. exact L. }
  assert (Lsb : bpow (precision + 2) <= IZR s).
  { rewrite <- (IZR_Zpower radix2) in * by lia. apply IZR_le.
    assert (H : IZR (radix2 ^ (precision + 2)) < IZR (s + 1)) by (rewrite plus_IZR; lra). apply lt_IZR in H. lia. }
  destruct (many_bits s (precision + 2) ltac:(lia) Lsb) as [P0 Pb].
  replace (sqrt (IZR n / IZR d)) with ((IZR s + (y - IZR s)) * bpow (- scale)).
  2: { apply Back. rewrite Rmult_assoc, <- bpow_plus. replace (- scale + scale)%Z with 0%Z by ring. simpl. lra. }
  apply parts_are_nearest; [lia | lra | |].
  - split; [intros _; lra | reflexivity].
  - intros _. lia.
Qed.

(** The bits that [nearest_root] gives are correct. *)
Corollary root_is_correct : forall n d, (0 < n)%Z -> (0 < d)%Z ->
  let scale := root_scale n d in
  let (a, b) := shifted n d (2 * scale) in
  let root := Z.sqrt (a / b) in
  IZR root * bpow (- scale) <> sqrt (IZR n / IZR d) ->
  let (s, e) := parts root true (- scale) in
  correct (sqrt (IZR n / IZR d)) (from_parts s e).
Proof.
  intros n d Hn Hd scale. generalize (root_is_nearest n d Hn Hd). cbv zeta. fold scale.
  destruct (shifted n d (2 * scale)) as [a b]. destruct (parts _ _ _). intros H I. exact (parts_are_correct _ _ _ (H I)).
Qed.

End Nearest.
