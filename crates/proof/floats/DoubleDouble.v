(** The error bounds of double-double arithmetic. With u = 2^-53 the relative error is at most 6 u^2 for a sum, 9 u^2 for a
    product and 25 u^2 for a quotient. So each is below 2^-100 = 64 u^2, as the crate states. *)

From Coq Require Import ZArith Reals Lra Lia.
From Flocq Require Import Core Relative Plus_error Sterbenz.
From CannonpileFloats Require Import Model ErrorFree.

Open Scope R_scope.

Definition u : R := / 9007199254740992.

(** The largest error by underflow: half of the smallest float. *)
Definition eta : R := bpow (-1075).

Lemma u_is_half_ulp : / 2 * bpow (- 53 + 1) = u.
Proof. unfold u. simpl. lra. Qed.

Lemma eta_positive : 0 < eta.
Proof. apply bpow_gt_0. Qed.

(** Bounds an absolute value by the bounds of others. *)
Definition seen (P : Prop) : Prop := P.
Ltac bound := unfold u in *; apply Rabs_le;
  repeat match goal with
    H : Rabs ?x <= ?k |- _ => pose proof (Rabs_le_inv _ _ H); change (seen (Rabs x <= k)) in H
  end; unfold seen in *; lra.

Lemma part : forall a b, Rabs a <= Rabs (a + b) + Rabs b.
Proof. intros. split_Rabs; lra. Qed.

Lemma with_error : forall w z, Rabs w <= Rabs z + Rabs (w - z).
Proof. intros. split_Rabs; lra. Qed.

(** ** Errors of single operations *)

Lemma rnd_error : forall x, Rabs (rnd x - x) <= u * Rabs x + eta.
Proof.
  intros x. destruct (error_N_FLT radix2 (-1074) 53 ltac:(lia) (fun x => negb (Z.even x)) x) as [e [f [He [Hf [_ H]]]]].
  change (Rabs e <= / 2 * bpow (- 53 + 1)) in He. rewrite u_is_half_ulp in He. rewrite H. replace (x * (1 + e) + f - x) with (x * e + f) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat.
  - rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos | exact He].
  - apply Rle_trans with (1 := Hf). unfold eta. change (-1075)%Z with (-1 + -1074)%Z. rewrite bpow_plus.
    change (bpow (-1)) with (/ 2). apply Rle_refl.
Qed.

(** A sum loses nothing by underflow. *)
Lemma rnd_sum_error : forall x y, format x -> format y ->
  Rabs (rnd (x + y) - (x + y)) <= u * Rabs (x + y) /\ Rabs (rnd (x + y) - (x + y)) <= u * Rabs (rnd (x + y)).
Proof.
  intros x y Fx Fy. split.
  - destruct (FLT_plus_error_N_ex radix2 (-1074) 53 (fun x => negb (Z.even x)) x y Fx Fy) as [e [He H]].
    rewrite H. replace ((x + y) * (1 + e) - (x + y)) with (e * (x + y)) by ring. rewrite Rabs_mult.
    apply Rmult_le_compat_r; [apply Rabs_pos |]. apply Rle_trans with (1 := He).
    apply Rle_trans with (1 := u_rod1pu_ro_le_u_ro radix2 53). apply Req_le. exact u_is_half_ulp.
  - destruct (FLT_plus_error_N_round_ex radix2 (-1074) 53 (fun x => negb (Z.even x)) x y Fx Fy) as [e [He H]].
    rewrite H at 2. replace (rnd (x + y) - rnd (x + y) * (1 + e)) with (- (e * rnd (x + y))) by ring.
    rewrite Rabs_Ropp, Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos |].
    apply Rle_trans with (1 := He). apply Req_le. exact u_is_half_ulp.
Qed.

(** Two floats whose sum is no float do not cancel: Sterbenz. *)
Lemma no_cancellation : forall a b, format a -> format b -> ~ format (a + b) ->
  Rabs a <= 2 * Rabs (a + b) /\ Rabs b <= 2 * Rabs (a + b).
Proof.
  assert (S : forall a b, format a -> format b -> 0 < b -> - 2 * b <= a <= - b / 2 -> format (a + b)).
  { intros a b Fa Fb Hb H. replace (a + b) with (- (- a - b)) by ring. apply generic_format_opp.
    apply sterbenz; try typeclasses eauto; trivial; [apply generic_format_opp; exact Fa | lra]. }
  assert (T : forall a b, format a -> format b -> ~ format (a + b) -> Rabs b <= 2 * Rabs (a + b)).
  { intros a b Fa Fb H. destruct (Rle_or_lt (Rabs b) (2 * Rabs (a + b))) as [L | L]; [exact L |].
    exfalso. apply H. destruct (Rtotal_order b 0) as [N | [Z | P]].
    - replace (a + b) with (- (- a + - b)) by ring. apply generic_format_opp.
      apply S; try apply generic_format_opp; trivial; [lra |]. clear - L N. split_Rabs; lra.
    - rewrite Z, Rplus_0_r. exact Fa.
    - apply S; trivial. clear - L P. split_Rabs; lra. }
  intros a b Fa Fb H. split; [| apply T; trivial].
  rewrite (Rplus_comm a b). apply T; trivial. rewrite Rplus_comm. exact H.
Qed.

Lemma no_cancellation_of_both : forall a b, format a -> format b -> ~ format (a + b) ->
  Rabs a + Rabs b <= 3 * Rabs (a + b).
Proof.
  intros a b Fa Fb H. destruct (no_cancellation a b Fa Fb H) as [P Q]. clear - P Q. split_Rabs; lra.
Qed.

(** ** Double-doubles *)

(** The invariant of the type: the high part is the number rounded. *)
Definition normal (d : DoubleDouble) : Prop := format (high d) /\ format (low d) /\ rnd (high d + low d) = high d.
Definition value (d : DoubleDouble) : R := high d + low d.

Lemma low_is_small : forall d, normal d -> Rabs (low d) <= u * Rabs (high d).
Proof.
  intros d [Fh [Fl H]]. destruct (rnd_sum_error _ _ Fh Fl) as [_ E]. rewrite H in E.
  replace (high d - (high d + low d)) with (- low d) in E by ring. rewrite Rabs_Ropp in E. exact E.
Qed.

(** A sum of Dekker is normal. *)
Lemma from_exact_sum : forall a b s e, s = rnd (a + b) -> s + e = a + b -> format s -> format e -> normal (parts s e).
Proof.
  intros a b s e Hs He Fs Fe. split; [exact Fs | split; [exact Fe |]]. simpl. rewrite He. symmetry. exact Hs.
Qed.

(** The order of the high parts, and then of the low parts, is that of the values. *)
(* quote crates/surd/src/double_double.rs partial_cmp: let high = self.high.partial_cmp(&other.high)?; *)
(* quote crates/surd/src/double_double.rs partial_cmp: Some(high.then(self.low.partial_cmp(&other.low)?)) *)
Definition compare (x y : DoubleDouble) : comparison :=
  match Rcompare (high x) (high y) with
  | Eq => Rcompare (low x) (low y)
  | order => order
  end.

Theorem compare_is_exact : forall x y, normal x -> normal y -> compare x y = Rcompare (value x) (value y).
Proof.
  intros x y [_ [_ Hx]] [_ [_ Hy]]. unfold compare, value.
  assert (M : forall a b, rnd a < rnd b -> a < b).
  { intros a b H. apply Rnot_le_lt. intros L. apply Rlt_not_le with (1 := H). apply round_le; trivial; typeclasses eauto. }
  destruct (Rtotal_order (high x) (high y)) as [H | [H | H]].
  - rewrite Rcompare_Lt by exact H. symmetry. apply Rcompare_Lt. apply M. rewrite Hx, Hy. exact H.
  - rewrite Rcompare_Eq by exact H. rewrite H. symmetry. apply Rcompare_plus_l.
  - rewrite Rcompare_Gt by exact H. symmetry. apply Rcompare_Gt. apply M. rewrite Hx, Hy. exact H.
Qed.

(** ** Sum *)

(** A float that is not larger in magnitude has a last bit that is not larger. *)
Lemma last_bit_monotone : forall a b, b <> 0 -> Rabs b <= Rabs a -> (cexp radix2 fexp b <= cexp radix2 fexp a)%Z.
Proof.
  intros a b Hb H. unfold cexp, FLT_exp. assert (mag radix2 b <= mag radix2 a)%Z by (apply mag_le_abs; trivial). lia.
Qed.

(** AccurateDWPlusDW, if no operation overflows. *)
Theorem sum_error : forall x y, normal x -> normal y ->
  normal (sum (x, y)) /\
  Rabs (value (sum (x, y)) - (value x + value y)) <= 6 * u * u * Rabs (value x + value y).
Proof.
  intros x y Nx Ny.
  generalize (low_is_small x Nx) (low_is_small y Ny).
  destruct Nx as [Fxh [Fxl _]], Ny as [Fyh [Fyl _]].
  destruct x as [xh xl], y as [yh yl]. cbn [high low] in *. intros Lx Ly.
  change (value (parts xh xl)) with (xh + xl). change (value (parts yh yl)) with (yh + yl).
  unfold sum. cbn [high low].
  generalize (two_sum_exact xh yh Fxh Fyh). destruct (two_sum (xh, yh)) as [s s1]. intros [Hs [Es [Fs Fs1]]].
  generalize (two_sum_exact xl yl Fxl Fyl). destruct (two_sum (xl, yl)) as [t t1]. intros [Ht [Et [Ft Ft1]]].
  destruct (rnd_sum_error xh yh Fxh Fyh) as [Rs Rs']. destruct (rnd_sum_error xl yl Fxl Fyl) as [Rt Rt'].
  rewrite <- Hs in Rs, Rs'. rewrite <- Ht in Rt, Rt'.
  replace (s - (xh + yh)) with (- s1) in Rs, Rs' by lra. replace (t - (xl + yl)) with (- t1) in Rt, Rt' by lra.
  rewrite Rabs_Ropp in Rs, Rs', Rt, Rt'.
  assert (Tl : Rabs (xl + yl) <= u * Rabs xh + u * Rabs yh) by (apply Rle_trans with (1 := Rabs_triang _ _); lra).
  assert (Tt : Rabs t <= (1 + u) * (u * Rabs xh + u * Rabs yh)).
  { generalize (with_error t (xl + yl)). replace (t - (xl + yl)) with (- t1) by lra. rewrite Rabs_Ropp. unfold u in *. lra. }
  change (add s1 t) with (rnd (s1 + t)). set (c := rnd (s1 + t)).
  destruct (Req_dec s1 0) as [Z | NZ].
  - (* The sum of the high parts is exact. *)
    assert (Hc : c = t) by (unfold c; rewrite Z, Rplus_0_l; apply rnd_format; exact Ft). rewrite Hc. clear c Hc.
    (* s is a multiple of the last bit of t. *)
    assert (M : s = 0 \/ t = 0 \/ exists i, s = IZR i * bpow (cexp radix2 fexp t)).
    { destruct (Req_dec s 0) as [S0 | S0]; [left; exact S0 | right].
      destruct (Req_dec t 0) as [T0 | T0]; [left; exact T0 | right].
      destruct (Rle_or_lt (Rabs t) (Rabs s)) as [L | L].
      - apply (ex_shift radix2 fexp s _ Fs). apply last_bit_monotone; trivial.
      - assert (B : Rabs t <= Rabs xh /\ Rabs t <= Rabs yh).
        { assert (Hss : s = xh + yh) by lra. rewrite Hss in L.
          generalize (part xh yh) (part yh xh) (Rabs_pos xh) (Rabs_pos yh). rewrite (Rplus_comm yh xh). unfold u in *. lra. }
        destruct (ex_shift radix2 fexp xh _ Fxh (last_bit_monotone xh t T0 (proj1 B))) as [i Hi].
        destruct (ex_shift radix2 fexp yh _ Fyh (last_bit_monotone yh t T0 (proj2 B))) as [j Hj].
        exists (i + j)%Z. rewrite plus_IZR, Rmult_plus_distr_r, <- Hi, <- Hj. lra. }
    assert (F : let (v, v1) := fast_two_sum (s, t) in v = rnd (s + t) /\ v + v1 = s + t /\ format v /\ format v1).
    { destruct M as [M | [M | [i Hi]]].
      - apply fast_two_sum_exact; trivial. right. exact M.
      - apply fast_two_sum_exact; trivial. left. rewrite M, Rabs_R0. apply Rabs_pos.
      - destruct (last_bit t Ft) as [He [j [Hj Jj]]].
        exact (fast_two_sum_exact_multiple s t _ i j Fs Ft He Hi Hj Jj). }
    destruct (fast_two_sum (s, t)) as [v v1]. destruct F as [Hv [Ev [Fv Fv1]]].
    change (add t1 v1) with (rnd (t1 + v1)). set (w := rnd (t1 + v1)). assert (Fw : format w) by apply format_rnd.
    destruct (rnd_sum_error t1 v1 Ft1 Fv1) as [Rw _]. fold w in Rw.
    destruct (rnd_sum_error s t Fs Ft) as [Rv _]. rewrite <- Hv in Rv. replace (v - (s + t)) with (- v1) in Rv by lra.
    rewrite Rabs_Ropp in Rv.
    assert (G : (let (p, q) := fast_two_sum (v, w) in p = rnd (v + w) /\ p + q = v + w /\ format p /\ format q) /\
                Rabs (w - (t1 + v1)) <= 6 * u * u * Rabs (xh + xl + (yh + yl))).
    { assert (X : xh + xl + (yh + yl) = s + t + t1) by lra. rewrite X.
      destruct (Req_dec v1 0) as [V0 | V0].
      - (* The sum v is exact, so that w = t1. *)
        assert (Hw : w = t1) by (unfold w; rewrite V0, Rplus_0_r; apply rnd_format; exact Ft1).
        split.
        + apply fast_two_sum_exact; trivial. rewrite Hw.
          destruct (Req_dec v 0) as [Vz | Vz]; [right; exact Vz | left].
          destruct M as [M | [M | [i Hi]]].
          * replace v with t by lra. generalize (Rabs_pos t). unfold u in *. lra.
          * rewrite M in Rt'. rewrite Rabs_R0, Rmult_0_r in Rt'. apply Rle_trans with (1 := Rt'). apply Rabs_pos.
          * destruct (last_bit t Ft) as [He [j [Hj Jj]]].
            assert (Hvm : v = IZR (i + j) * bpow (cexp radix2 fexp t)).
            { rewrite plus_IZR, Rmult_plus_distr_r, <- Hi, <- Hj. lra. }
            assert (Kv : bpow (cexp radix2 fexp t) <= Rabs v).
            { rewrite Hvm, Rabs_mult, (Rabs_pos_eq (bpow _)), <- abs_IZR by apply bpow_ge_0.
              rewrite <- (Rmult_1_l (bpow _)) at 1. apply Rmult_le_compat_r; [apply bpow_ge_0 |].
              apply (IZR_le 1). assert (i + j <> 0)%Z; [| lia]. intros Q. apply Vz. rewrite Hvm, Q. ring. }
            apply Rle_trans with (2 := Kv).
            destruct (Req_dec t 0) as [T0 | T0].
            { rewrite T0 in Rt'. rewrite Rabs_R0, Rmult_0_r in Rt'. apply Rle_trans with (1 := Rt'). apply bpow_ge_0. }
            rewrite <- ulp_neq_0 by exact T0.
            replace t1 with (- (t - (xl + yl))) by lra. rewrite Rabs_Ropp, Ht.
            apply Rle_trans with (1 := error_le_half_ulp_round radix2 fexp (fun x => negb (Z.even x)) (xl + yl)).
            generalize (ulp_ge_0 radix2 fexp (rnd (xl + yl))). lra.
        + rewrite Hw, V0, Rplus_0_r, Rminus_diag_eq, Rabs_R0 by reflexivity.
          apply Rmult_le_pos; [unfold u; lra | apply Rabs_pos].
      - assert (NF : ~ format (s + t)).
        { intros Q. apply V0. rewrite (rnd_format _ Q) in Hv. lra. }
        destruct (no_cancellation s t Fs Ft NF) as [_ C].
        generalize (Rabs_triang t1 v1) (with_error w (t1 + v1)) (part (s + t) t1) (Rabs_pos (s + t)) (with_error v (s + t)).
        assert (Pv : Rabs (s + t) <= Rabs v + Rabs v1) by (rewrite <- Ev; apply Rabs_triang).
        intros. split.
        + apply fast_two_sum_exact; trivial. left. unfold u in *. lra.
        + unfold u in *. lra. }
    destruct G as [G Ge]. destruct (fast_two_sum (v, w)) as [p q]. destruct G as [Hp [Ep [Fp Fq]]].
    cbv beta iota delta [finite value high low]. split; [apply (from_exact_sum v w); trivial |].
    replace (p + q - (xh + xl + (yh + yl))) with (w - (t1 + v1)) by lra. exact Ge.
  - (* The high parts do not cancel. *)
    assert (NF : ~ format (xh + yh)).
    { intros Q. apply NZ. rewrite (rnd_format _ Q) in Hs. lra. }
    destruct (no_cancellation xh yh Fxh Fyh NF) as [C1 C2].
    assert (C := no_cancellation_of_both xh yh Fxh Fyh NF).
    set (A := Rabs (xh + yh)) in *. assert (HA : 0 <= A) by apply Rabs_pos.
    assert (Tt' : Rabs t <= (1 + u) * (3 * u) * A) by (unfold u in *; lra).
    assert (Tt1 : Rabs t1 <= 4 * u * u * A) by (unfold u in *; lra).
    destruct (rnd_sum_error s1 t Fs1 Ft) as [Rc _]. fold c in Rc. assert (Fc : format c) by apply format_rnd.
    assert (B1 : Rabs (s1 + t) <= (4 * u + 3 * u * u) * A).
    { apply Rle_trans with (1 := Rabs_triang _ _). unfold u in *. lra. }
    assert (Rc' : Rabs (c - (s1 + t)) <= (4 * u + 3 * u * u) * u * A) by (unfold u in *; lra).
    assert (Sa : Rabs s <= (1 + u) * A /\ (1 - u) * A <= Rabs s).
    { generalize (with_error s (xh + yh)) (Rabs_triang s s1). rewrite Es. replace (s - (xh + yh)) with (- s1) by lra.
      rewrite Rabs_Ropp. fold A. unfold u in *. lra. }
    assert (Bc : Rabs c <= 5 * u * A) by (generalize (with_error c (s1 + t)); unfold u in *; lra).
    assert (F : let (v, v1) := fast_two_sum (s, c) in v = rnd (s + c) /\ v + v1 = s + c /\ format v /\ format v1).
    { apply fast_two_sum_exact; trivial. left. unfold u in *. lra. }
    destruct (fast_two_sum (s, c)) as [v v1]. destruct F as [Hv [Ev [Fv Fv1]]].
    change (add t1 v1) with (rnd (t1 + v1)). set (w := rnd (t1 + v1)). assert (Fw : format w) by apply format_rnd.
    destruct (rnd_sum_error t1 v1 Ft1 Fv1) as [Rw _]. fold w in Rw.
    destruct (rnd_sum_error s c Fs Fc) as [Rv _]. rewrite <- Hv in Rv. replace (v - (s + c)) with (- v1) in Rv by lra.
    rewrite Rabs_Ropp in Rv.
    assert (B2 : Rabs (s + c) <= (1 + 6 * u) * A) by (apply Rle_trans with (1 := Rabs_triang _ _); unfold u in *; lra).
    assert (B3 : Rabs v1 <= (1 + 6 * u) * u * A) by (unfold u in *; lra).
    assert (B4 : Rabs (t1 + v1) <= (u + 11 * u * u) * A).
    { apply Rle_trans with (1 := Rabs_triang _ _). unfold u in *. lra. }
    assert (B5 : Rabs (w - (t1 + v1)) <= (u + 11 * u * u) * u * A) by (unfold u in *; lra).
    assert (G : let (p, q) := fast_two_sum (v, w) in p = rnd (v + w) /\ p + q = v + w /\ format p /\ format q).
    { apply fast_two_sum_exact; trivial. left. generalize (with_error w (t1 + v1)) (part s c) (Rabs_triang v v1).
      rewrite Ev. unfold u in *. lra. }
    destruct (fast_two_sum (v, w)) as [p q]. destruct G as [Hp [Ep [Fp Fq]]].
    cbv beta iota delta [finite value high low]. split; [apply (from_exact_sum v w); trivial |].
    replace (p + q - (xh + xl + (yh + yl))) with ((w - (t1 + v1)) + (c - (s1 + t))) by lra.
    apply Rle_trans with (1 := Rabs_triang _ _).
    assert (X : (1 - 4 * u) * A <= Rabs (xh + xl + (yh + yl))).
    { replace (xh + xl + (yh + yl)) with ((xh + yh) + (xl + yl)) by ring.
      apply Rle_trans with (A - Rabs (xl + yl)); [unfold u in *; lra |].
      unfold A. generalize (Rabs_triang_inv (xh + yh) (- (xl + yl))). rewrite Rabs_Ropp.
      replace (xh + yh - - (xl + yl)) with (xh + yh + (xl + yl)) by ring. trivial. }
    unfold u in *. lra.
Qed.

(** The bound that the crate states: 2^-100. *)
Corollary sum_error_as_stated : forall x y, normal x -> normal y ->
  Rabs (value (sum (x, y)) - (value x + value y)) <= bpow (-100) * Rabs (value x + value y).
Proof.
  intros x y Nx Ny. apply Rle_trans with (1 := proj2 (sum_error x y Nx Ny)).
  apply Rmult_le_compat_r; [apply Rabs_pos |]. unfold u. simpl. lra.
Qed.
