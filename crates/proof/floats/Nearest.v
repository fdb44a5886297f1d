(** The functions of nearest.rs round correctly: to nearest, ties to even.

    A positive number is given as (m + epsilon) 2^exponent with an integer m and 0 <= epsilon < 1; [sticky] is true if
    epsilon > 0. The proof is for any precision and any least exponent, so for `f32` and for `f64`. *)

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

(** The number of bits of a positive integer. *)
Definition bits (m : Z) : Z := Zdigits radix2 m.

(* quote crates/surd/src/nearest.rs round: (bits(m) + exponent - i64::from(F::PRECISION)).max(F::MIN_EXPONENT) *)
Definition last_bit (m exponent : Z) : Z := Z.max (bits m + exponent - precision) min_exponent.

(* quote crates/surd/src/nearest.rs round: let dropped = last_bit - exponent; *)
Definition dropped (m exponent : Z) : Z := last_bit m exponent - exponent.

(* quote crates/surd/src/nearest.rs round: let kept = (m >> dropped).to_u64()?; *)
(* quote crates/surd/src/nearest.rs round: let half = m.bit(dropped - 1); *)
(* quote crates/surd/src/nearest.rs round: sticky || m.trailing_zeros().is_some_and(|zeros| zeros < dropped - 1) *)
(* quote crates/surd/src/nearest.rs round: let up = half && (below_half || kept % 2 == 1); *)
(* quote crates/surd/src/nearest.rs round: F::assemble(negative, kept + u64::from(up), last_bit) *)
(* quote crates/surd/src/nearest.rs round: let significand = (m << -dropped).to_u64()?; *)
(** m has a bit below position d - 1 if and only if m is no multiple of 2^(d-1). *)
Definition significand (m : Z) (sticky : bool) (exponent : Z) : Z :=
  let d := dropped m exponent in
  if (1 <=? d)%Z then
    let kept := Z.shiftr m d in
    let half := Z.testbit m (d - 1) in
    let below_half := sticky || negb (m mod 2 ^ (d - 1) =? 0)%Z in
    let up := half && (below_half || Z.odd kept) in
    kept + Z.b2z up
  else Z.shiftl m (- d).

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

(** ** The bits of the float *)

Definition hidden : Z := 2 ^ (precision - 1).

Lemma hidden_positive : (0 < hidden)%Z.
Proof. apply Z.pow_pos_nonneg; lia. Qed.

Lemma twice_hidden : (2 ^ precision = 2 * hidden)%Z.
Proof. unfold hidden. rewrite <- Z.pow_succ_r by lia. f_equal. lia. Qed.

(** The conditions of the documentation of [assemble]: the significand has at most one bit more than the format, and is
    below the hidden bit only among the subnormals. *)
Theorem significand_fits : forall m sticky exponent, (0 < m)%Z ->
  (0 <= significand m sticky exponent <= 2 * hidden)%Z /\
  (min_exponent <= last_bit m exponent)%Z /\
  ((significand m sticky exponent < hidden)%Z -> last_bit m exponent = min_exponent).
Proof.
  intros m sticky exponent Hm. destruct (bits_bounds m Hm) as [L U].
  assert (B : (0 < bits m)%Z) by (apply Zdigits_gt_0; lia).
  rewrite <- (IZR_Zpower radix2) in L, U by lia. apply le_IZR in L. apply lt_IZR in U. simpl radix_val in L, U.
  split; [| split; [apply Z.le_max_r |]].
  - unfold significand. set (d := dropped m exponent). assert (D : (bits m <= precision + d)%Z) by (unfold d, dropped, last_bit; lia).
    rewrite <- twice_hidden. destruct (Z.leb_spec 1 d).
    + assert (K : (0 <= Z.shiftr m d < 2 ^ precision)%Z).
      { rewrite Z.shiftr_div_pow2 by lia. assert (P : (0 < 2 ^ d)%Z) by (apply Z.pow_pos_nonneg; lia).
        split; [apply Z.div_pos; lia |]. apply Z.div_lt_upper_bound; [exact P |]. rewrite <- Z.pow_add_r by lia.
        apply Z.lt_le_trans with (1 := U). apply Z.pow_le_mono_r; lia. }
      destruct (_ && _); cbn [Z.b2z]; lia.
    + rewrite Z.shiftl_mul_pow2 by lia. assert (P : (0 < 2 ^ (- d))%Z) by (apply Z.pow_pos_nonneg; lia).
      split; [nia |]. apply Z.lt_le_incl.
      apply Z.lt_le_trans with (2 ^ bits m * 2 ^ (- d))%Z; [nia |]. rewrite <- Z.pow_add_r by lia.
      apply Z.pow_le_mono_r; lia.
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

(** The biased exponent of the largest floats: 2046 for `f64`. *)
Variable largest : Z.

(* quote crates/surd/src/nearest.rs assemble: let hidden = 1_u64 << (PRECISION - 1); *)
(* quote crates/surd/src/nearest.rs assemble: if significand == 2 * hidden { (hidden, exponent.saturating_add(1)) } *)
(* quote crates/surd/src/nearest.rs assemble: if significand < hidden { 0 } *)
(* quote crates/surd/src/nearest.rs assemble: .saturating_sub(MIN_EXPONENT).saturating_add(1) *)
(* quote crates/surd/src/nearest.rs assemble: if biased > largest { return None; } *)
(* quote crates/surd/src/nearest.rs assemble: << (PRECISION - 1); *)
(* quote crates/surd/src/nearest.rs assemble: significand (hidden - 1) *)
(** The bits without the sign. The two fields do not overlap, so that their sum is the bitwise or. *)
Definition assemble (given exponent_of_given : Z) : option Z :=
  let (significand, exponent) :=
    if (given =? 2 * hidden)%Z then (hidden, exponent_of_given + 1)%Z else (given, exponent_of_given) in
  let biased := if (significand <? hidden)%Z then 0%Z else (exponent - min_exponent + 1)%Z in
  if (largest <? biased)%Z then None else Some (biased * 2 ^ (precision - 1) + significand mod hidden)%Z.

(** The value of the bits, by IEEE 754. *)
Definition value_of_bits (b : Z) : R :=
  let biased := (b / hidden)%Z in
  let fraction := (b mod hidden)%Z in
  if (biased =? 0)%Z then IZR fraction * bpow min_exponent
  else IZR (hidden + fraction) * bpow (biased - 1 + min_exponent).

(** The bits are those of the given number. There are none exactly if the number is 2^(largest + ...) or more, which is
    2^1024 for `f64`. *)
Theorem assembled : forall given exponent, (0 <= given <= 2 * hidden)%Z -> (min_exponent <= exponent)%Z ->
  ((given < hidden)%Z -> exponent = min_exponent) -> (0 < largest)%Z ->
  match assemble given exponent with
  | Some b => value_of_bits b = IZR given * bpow exponent /\ (b / hidden <= largest)%Z
  | None => bpow (precision + largest - 1 + min_exponent) <= IZR given * bpow exponent
  end.
Proof.
  intros given exponent Hg He Hs Hl. assert (Hh := hidden_positive). unfold assemble. fold hidden.
  assert (PH : IZR hidden = bpow (precision - 1)) by (apply (IZR_Zpower radix2); lia).
  assert (Main : forall s e, (0 <= s < 2 * hidden)%Z -> (min_exponent <= e)%Z -> ((s < hidden)%Z -> e = min_exponent) ->
    match (if (largest <? (if (s <? hidden)%Z then 0 else e - min_exponent + 1))%Z then None
           else Some ((if (s <? hidden)%Z then 0 else e - min_exponent + 1) * hidden + s mod hidden)%Z) with
    | Some b => value_of_bits b = IZR s * bpow e /\ (b / hidden <= largest)%Z
    | None => bpow (precision + largest - 1 + min_exponent) <= IZR s * bpow e
    end).
  { intros s e Hr Hm Hsub.
    assert (V : forall k, ((k * hidden + s mod hidden) / hidden = k /\ (k * hidden + s mod hidden) mod hidden = s mod hidden)%Z).
    { intros k. assert (M := Z.mod_pos_bound s hidden Hh). split.
      - rewrite Z.div_add_l, Z.div_small by lia. lia.
      - rewrite Z.add_comm, Z.mod_add, Z.mod_small by lia. reflexivity. }
    destruct (Z.ltb_spec s hidden) as [S | S].
    - destruct (Z.ltb_spec largest 0); [lia |]. destruct (V 0%Z) as [V1 V2]. unfold value_of_bits. rewrite V1, V2.
      rewrite Z.mod_small by lia. rewrite (Hsub S). split; [reflexivity | lia].
    - set (k := (e - min_exponent + 1)%Z). destruct (Z.ltb_spec largest k) as [O | O].
      + apply Rle_trans with (bpow (precision - 1) * bpow e).
        * rewrite <- bpow_plus. apply bpow_le. unfold k in O. lia.
        * rewrite <- PH. apply Rmult_le_compat_r; [apply bpow_ge_0 | apply IZR_le; exact S].
      + destruct (V k) as [V1 V2]. unfold value_of_bits. rewrite V1, V2.
        destruct (Z.eqb_spec k 0); [unfold k in *; lia |]. split; [| exact O].
        assert (M : (s mod hidden = s - hidden)%Z) by (symmetry; apply Z.mod_unique with 1%Z; lia).
        rewrite M. f_equal; [f_equal; ring | f_equal; unfold k; ring]. }
  destruct (Z.eqb_spec given (2 * hidden)) as [T | T].
  - specialize (Main hidden (exponent + 1)%Z ltac:(lia) ltac:(lia) ltac:(lia)).
    replace (IZR given * bpow exponent) with (IZR hidden * bpow (exponent + 1)); [exact Main |].
    rewrite T, mult_IZR, bpow_plus. change (bpow 1) with 2. ring.
  - apply Main; lia.
Qed.

(** ** Rationals *)

(* quote crates/surd/src/nearest.rs guard_bits: i64::from(F::PRECISION) + 3 *)
Definition guard_bits : Z := precision + 3.

(* quote crates/surd/src/nearest.rs shifted_quotient: if shift >= 0 { (n << shift).div_rem(d) } else { n.div_rem(&(d << -shift)) } *)
Definition shifted (n d shift : Z) : Z * Z :=
  if (0 <=? shift)%Z then (Z.shiftl n shift, d) else (n, Z.shiftl d (- shift)).

(* quote crates/surd/src/nearest.rs nearest_ratio: let scale = guard_bits::<F>() - (bits(n) - bits(d)); *)
(* quote crates/surd/src/nearest.rs nearest_ratio: round(negative, &quotient, !remainder.is_zero(), -scale) *)
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

(** [nearest_ratio]: the quotient of two positive integers, correctly rounded. *)
Theorem ratio_is_nearest : forall n d, (0 < n)%Z -> (0 < d)%Z ->
  let scale := ratio_scale n d in
  let (a, b) := shifted n d scale in
  let quotient := (a / b)%Z in
  let remainder := (a mod b)%Z in
  nearest (IZR n / IZR d) =
    IZR (significand quotient (negb (remainder =? 0)%Z) (- scale)) * bpow (last_bit quotient (- scale)).
Proof.
  intros n d Hn Hd scale. generalize (shifted_is_scaled n d scale Hn Hd).
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
  rewrite <- (significand_is_nearest q _ (- scale) (IZR r / IZR b) Q0 F).
  - f_equal. rewrite <- E, Hq, Rmult_assoc, <- bpow_plus. replace (scale + - scale)%Z with 0%Z by ring. simpl. ring.
  - destruct (Z.eqb_spec r 0) as [Z | Z]; cbn [negb]; split; intros H; try discriminate; try reflexivity.
    + exfalso. rewrite Z in H. unfold Rdiv in H. lra.
    + apply Rmult_lt_0_compat; [apply IZR_lt; lia | apply Rinv_0_lt_compat; exact Rb].
  - intros _. lia.
Qed.

(** ** Square roots *)

(* quote crates/surd/src/nearest.rs nearest_root: let scale = guard_bits::<F>() - (bits(n) - bits(d)).div_euclid(2); *)
(* quote crates/surd/src/nearest.rs nearest_root: let (quotient, _) = shifted_quotient(n, d, 2 * scale); let sticky = true; *)
(* quote crates/surd/src/nearest.rs nearest_root: round(negative, &quotient.sqrt(), sticky, -scale) *)
Definition root_scale (n d : Z) : Z := guard_bits - (bits n - bits d) / 2.

(** [nearest_root]: the square root of a quotient of two positive integers, correctly rounded, if no square of a fraction with
    a power of two as denominator equals the quotient. This holds for every irrational root. *)
Theorem root_is_nearest : forall n d, (0 < n)%Z -> (0 < d)%Z ->
  let scale := root_scale n d in
  let (a, b) := shifted n d (2 * scale) in
  let root := Z.sqrt (a / b) in
  IZR root * bpow (- scale) <> sqrt (IZR n / IZR d) ->
  nearest (sqrt (IZR n / IZR d)) = IZR (significand root true (- scale)) * bpow (last_bit root (- scale)).
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
  rewrite <- (significand_is_nearest s true (- scale) (y - IZR s) P0).
  - f_equal. symmetry. apply Back. rewrite Rmult_assoc, <- bpow_plus. replace (- scale + scale)%Z with 0%Z by ring. simpl. lra.
  - lra.
  - split; [intros _; lra | reflexivity].
  - intros _. lia.
Qed.

End Nearest.
