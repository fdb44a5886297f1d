(** Products and quotients of double-doubles of ordinary size, as the crate computes them: the errors are at most 9 u^2 and
    25 u^2, so below 2^-100. *)

From Coq Require Import ZArith Reals Lra Lia.
From Flocq Require Import Core.
From CannonpileFloats Require Import Model ErrorFree DoubleDouble.

Open Scope R_scope.

(** A float times a small number: the magnitudes. *)
Lemma small_factor : forall a b c, Rabs b <= u * Rabs c -> Rabs (a * b) <= u * Rabs (a * c).
Proof.
  intros a b c H. rewrite !Rabs_mult. replace (u * (Rabs a * Rabs c)) with (Rabs a * (u * Rabs c)) by ring.
  apply Rmult_le_compat_l; [apply Rabs_pos | exact H].
Qed.

(** Errors by underflow are negligible beside numbers of at least 2^-850. *)
Lemma eta_is_small : forall p, bpow (-850) <= p -> eta <= u * u * u * p.
Proof.
  intros p H. apply Rle_trans with (u * u * u * bpow (-850)).
  - replace (u * u * u) with (bpow (-159)) by (unfold u; simpl; lra).
    unfold eta. rewrite <- bpow_plus. apply bpow_le. lia.
  - apply Rmult_le_compat_l; [unfold u; lra | exact H].
Qed.

(** The magnitude of a double-double is that of its high part. *)
Lemma value_near_high : forall d, normal d ->
  (1 - u) * Rabs (high d) <= Rabs (value d) /\ Rabs (value d) <= (1 + u) * Rabs (high d).
Proof.
  intros d N. generalize (low_is_small d N). unfold value, u. intros. split; split_Rabs; lra.
Qed.

(** DWTimesDW1, for factors with 2^-400 <= |high| < 2^400. *)
Theorem product_error : forall x y, normal x -> normal y -> ordinary (high x) -> ordinary (high y) ->
  normal (ordinary_product (x, y)) /\
  Rabs (value (ordinary_product (x, y)) - value x * value y) <= 9 * u * u * Rabs (value x * value y).
Proof.
  intros x y Nx Ny Ox Oy.
  generalize (low_is_small x Nx) (low_is_small y Ny) (value_near_high x Nx) (value_near_high y Ny).
  destruct Nx as [Fxh [Fxl _]], Ny as [Fyh [Fyl _]].
  destruct x as [xh xl], y as [yh yl]. cbn [high low] in *. intros Lx Ly [Vx _] [Vy _].
  change (value (parts xh xl)) with (xh + xl) in *. change (value (parts yh yl)) with (yh + yl) in *.
  unfold ordinary_product. cbn [high low].
  generalize (two_product_of_ordinary xh yh Fxh Fyh Ox Oy) (two_product_exact xh yh Fxh Fyh).
  destruct (two_product (xh, yh)) as [c c1]. intros [Hc Ec] [_ [Fc [Fc1 _]]].
  unfold add, mul.
  set (P := Rabs (xh * yh)).
  assert (HP : bpow (-850) <= P).
  { apply Rle_trans with (bpow (-400 + -400)); [apply bpow_le; lia |].
    unfold P. rewrite bpow_plus, Rabs_mult. destruct Ox, Oy. apply Rmult_le_compat; trivial; apply bpow_ge_0. }
  assert (E := eta_is_small P HP). assert (E0 := eta_positive). assert (HP0 : 0 <= P) by apply Rabs_pos.
  assert (A1 : Rabs (xh * yl) <= u * P) by (apply small_factor; exact Ly).
  assert (A2 : Rabs (xl * yh) <= u * P).
  { unfold P. rewrite (Rmult_comm xl), (Rmult_comm xh). apply small_factor. exact Lx. }
  assert (A3 : Rabs (xl * yl) <= u * (u * P)).
  { apply Rle_trans with (u * Rabs (xl * yh)); [apply small_factor; exact Ly |].
    apply Rmult_le_compat_l; [unfold u; lra | exact A2]. }
  assert (R0 : Rabs c1 <= u * P + eta).
  { generalize (rnd_error (xh * yh)). rewrite <- Hc. fold P. replace (c - xh * yh) with (- c1) by lra.
    rewrite Rabs_Ropp. trivial. }
  assert (R1 := rnd_error (xh * yl)). assert (R2 := rnd_error (xl * yh)).
  set (m1 := rnd (xh * yl)) in *. set (m2 := rnd (xl * yh)) in *.
  assert (Fm1 : format m1) by apply format_rnd. assert (Fm2 : format m2) by apply format_rnd.
  destruct (rnd_sum_error m1 m2 Fm1 Fm2) as [R3 _]. set (c2 := rnd (m1 + m2)) in *.
  assert (Fc2 : format c2) by apply format_rnd.
  destruct (rnd_sum_error c1 c2 Fc1 Fc2) as [R4 _]. set (w := rnd (c1 + c2)) in *.
  assert (Fw : format w) by apply format_rnd.
  (* The magnitudes, in order. *)
  assert (M1 : Rabs (m1 - xh * yl) <= (u * u + u * u * u) * P) by (unfold u in *; lra).
  assert (M2 : Rabs (m2 - xl * yh) <= (u * u + u * u * u) * P) by (unfold u in *; lra).
  assert (M3 : Rabs (m1 + m2) <= (2 * u + 3 * u * u) * P) by bound.
  assert (M4 : Rabs (c2 - (m1 + m2)) <= (2 * u * u + 3 * u * u * u) * P) by (unfold u in *; lra).
  assert (M5 : Rabs (c1 + c2) <= (3 * u + 6 * u * u) * P) by bound.
  assert (M6 : Rabs (w - (c1 + c2)) <= (3 * u * u + 6 * u * u * u) * P) by (unfold u in *; lra).
  assert (M7 : (1 - 2 * u) * P <= Rabs c).
  { assert (P <= Rabs c + Rabs c1). { unfold P. rewrite <- Ec. apply Rabs_triang. } unfold u in *. lra. }
  assert (M8 : Rabs w <= 4 * u * P) by bound.
  unfold from_sum.
  assert (F : let (s, e) := fast_two_sum (c, w) in s = rnd (c + w) /\ s + e = c + w /\ format s /\ format e).
  { apply fast_two_sum_exact; trivial. left. unfold u in *. lra. }
  destruct (fast_two_sum (c, w)) as [s e]. destruct F as [Hs [Es [Fs Fe]]].
  cbv beta iota delta [value high low]. split; [apply (from_exact_sum c w); trivial |].
  replace (s + e - (xh + xl) * (yh + yl))
    with ((w - (c1 + c2)) + (c2 - (m1 + m2)) + (m1 - xh * yl) + (m2 - xl * yh) - xl * yl) by lra.
  assert (X : (1 - u) * (1 - u) * P <= Rabs ((xh + xl) * (yh + yl))).
  { unfold P. rewrite !Rabs_mult.
    replace ((1 - u) * (1 - u) * (Rabs xh * Rabs yh)) with (((1 - u) * Rabs xh) * ((1 - u) * Rabs yh)) by ring.
    apply Rmult_le_compat; trivial; apply Rmult_le_pos; try apply Rabs_pos; unfold u; lra. }
  apply Rle_trans with ((8 * u * u + 12 * u * u * u) * P); [| unfold u in *; lra].
  clear X. bound.
Qed.

(** The product with a float, DWTimesFP1: the result is not rounded to a double-double, its error is 3.1 u^2. *)
Lemma times_float_error : forall y t, normal y -> format t -> bpow (-850) <= Rabs (high y * t) ->
  let (r, r1) := times_float (y, t) in
  format r /\ format r1 /\ Rabs r1 <= u * Rabs r /\
  Rabs (r + r1 - value y * t) <= 31 / 10 * u * u * Rabs (high y * t).
Proof.
  intros y t Ny Ft HP. generalize (low_is_small y Ny). destruct Ny as [Fyh [Fyl _]].
  destruct y as [yh yl]. cbn [high low] in *. intros Ly.
  change (value (parts yh yl)) with (yh + yl).
  unfold times_float. cbn [high low].
  generalize (two_product_exact yh t Fyh Ft). destruct (two_product (yh, t)) as [c c1].
  intros [Hc [Fc [Fc1 [Ec _]]]].
  assert (Ec' : c + c1 = yh * t).
  { apply Ec. right. apply Rle_trans with (2 := HP). apply bpow_le. lia. }
  unfold add, mul. set (P := Rabs (yh * t)) in *.
  assert (E := eta_is_small P HP). assert (E0 := eta_positive). assert (HP0 : 0 <= P) by apply Rabs_pos.
  assert (A1 : Rabs (yl * t) <= u * P).
  { unfold P. rewrite (Rmult_comm yl), (Rmult_comm yh). apply small_factor. exact Ly. }
  assert (R0 : Rabs c1 <= u * P + eta).
  { generalize (rnd_error (yh * t)). rewrite <- Hc. fold P. replace (c - yh * t) with (- c1) by lra.
    rewrite Rabs_Ropp. trivial. }
  assert (R1 := rnd_error (yl * t)). set (c2 := rnd (yl * t)) in *. assert (Fc2 : format c2) by apply format_rnd.
  assert (M1 : Rabs (c2 - yl * t) <= (u * u + u * u * u) * P) by (unfold u in *; lra).
  assert (M2 : Rabs c2 <= 2 * u * P) by bound.
  assert (M3 : (1 - 2 * u) * P <= Rabs c).
  { assert (P <= Rabs c + Rabs c1). { unfold P. rewrite <- Ec'. apply Rabs_triang. } unfold u in *. lra. }
  assert (M3' : Rabs c <= (1 + 2 * u) * P).
  { replace c with (yh * t - c1) by lra. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. fold P.
    unfold u in *. lra. }
  assert (F : let (s, e) := fast_two_sum (c, c2) in s = rnd (c + c2) /\ s + e = c + c2 /\ format s /\ format e).
  { apply fast_two_sum_exact; trivial. left. unfold u in *. lra. }
  destruct (rnd_sum_error c c2 Fc Fc2) as [R2 _].
  destruct (fast_two_sum (c, c2)) as [s s1]. destruct F as [Hs [Es [Fs Fs1]]].
  rewrite <- Hs in R2. replace (s - (c + c2)) with (- s1) in R2 by lra. rewrite Rabs_Ropp in R2.
  assert (M4 : Rabs (c + c2) <= (1 + 5 * u) * P) by (apply Rle_trans with (1 := Rabs_triang _ _); unfold u in *; lra).
  assert (M5 : Rabs s1 <= (u + 5 * u * u) * P) by (unfold u in *; lra).
  assert (M6 : (1 - 6 * u) * P <= Rabs s).
  { generalize (part c c2) (Rabs_triang s s1). rewrite Es. unfold u in *. lra. }
  destruct (rnd_sum_error s1 c1 Fs1 Fc1) as [R3 _]. set (w := rnd (s1 + c1)) in *.
  assert (Fw : format w) by apply format_rnd.
  assert (M7 : Rabs (s1 + c1) <= (2 * u + 7 * u * u) * P).
  { apply Rle_trans with (1 := Rabs_triang _ _). unfold u in *. lra. }
  assert (M8 : Rabs (w - (s1 + c1)) <= (2 * u * u + 7 * u * u * u) * P) by (unfold u in *; lra).
  assert (G : let (r, r1) := fast_two_sum (s, w) in r = rnd (s + w) /\ r + r1 = s + w /\ format r /\ format r1).
  { apply fast_two_sum_exact; trivial. left. generalize (with_error w (s1 + c1)). unfold u in *. lra. }
  destruct (rnd_sum_error s w Fs Fw) as [_ R4].
  destruct (fast_two_sum (s, w)) as [r r1]. destruct G as [Hr [Er [Fr Fr1]]].
  rewrite <- Hr in R4. replace (r - (s + w)) with (- r1) in R4 by lra. rewrite Rabs_Ropp in R4.
  split; [exact Fr | split; [exact Fr1 | split; [exact R4 |]]].
  replace (r + r1 - (yh + yl) * t) with ((w - (s1 + c1)) + (c2 - yl * t)) by lra.
  apply Rle_trans with (1 := Rabs_triang _ _). unfold u in *. lra.
Qed.

(** DWDivDW2, for operands with 2^-400 <= |high| < 2^400. *)
Theorem quotient_error : forall x y, normal x -> normal y -> ordinary (high x) -> ordinary (high y) ->
  normal (ordinary_quotient (x, y)) /\
  Rabs (value (ordinary_quotient (x, y)) - value x / value y) <= 25 * u * u * Rabs (value x / value y).
Proof.
  intros x y Nx Ny Ox Oy.
  generalize (low_is_small x Nx) (low_is_small y Ny) (value_near_high x Nx) (value_near_high y Ny).
  assert (Oy' := Oy). assert (Ny' := Ny).
  destruct Nx as [Fxh [Fxl _]], Ny as [Fyh [Fyl _]].
  destruct x as [xh xl], y as [yh yl]. cbn [high low] in *.
  change (value (parts xh xl)) with (xh + xl) in *. change (value (parts yh yl)) with (yh + yl) in *.
  unfold ordinary_quotient. cbn [high low]. set (t := div xh yh). assert (Ft : format t) by apply format_rnd.
  set (H := Rabs (xh)) in *. set (Y := Rabs (yh)) in *. intros Lx Ly [Vx _] [Vy Vy'].
  assert (H0 : bpow (-400) <= H) by apply Ox.
  assert (Y0 : bpow (-400) <= Y < bpow 400) by exact Oy.
  assert (YP : 0 < Y) by (apply Rlt_le_trans with (2 := proj1 Y0); apply bpow_gt_0).
  assert (HP : 0 < H) by (apply Rlt_le_trans with (2 := H0); apply bpow_gt_0).
  assert (Yn : yh <> 0) by (intros Q; unfold Y in YP; rewrite Q, Rabs_R0 in YP; lra).
  assert (E0 := eta_positive).
  assert (EY : eta * Y <= u * u * u * H).
  { apply Rle_trans with (bpow (-1075) * bpow 400).
    - unfold eta. apply Rmult_le_compat_l; [apply bpow_ge_0 | lra].
    - apply Rle_trans with (u * u * u * bpow (-400)).
      + replace (u * u * u) with (bpow (-159)) by (unfold u; simpl; lra). rewrite <- !bpow_plus. apply bpow_le. lia.
      + apply Rmult_le_compat_l; [unfold u; lra | exact H0]. }
  (* The first quotient: |yh * t - xh| is at most u H and the underflow. *)
  assert (T : Rabs (yh * t - xh) <= u * H + u * u * u * H).
  { generalize (rnd_error (xh / yh)). change (rnd (xh / yh)) with t. intros R.
    replace (yh * t - xh) with (yh * (t - xh / yh)) by (field; exact Yn).
    rewrite Rabs_mult. fold Y. apply Rle_trans with (Y * (u * Rabs (xh / yh) + eta)).
    - apply Rmult_le_compat_l; lra.
    - unfold Rdiv. rewrite Rabs_mult, Rabs_inv. fold H Y.
      replace (Y * (u * (H * / Y) + eta)) with (u * H + eta * Y) by (field; lra). lra. }
  assert (P1 : Rabs (yh * t) <= (1 + 2 * u) * H /\ (1 - 2 * u) * H <= Rabs (yh * t)).
  { generalize (with_error (yh * t) (xh)) (with_error (xh) (yh * t)).
    rewrite (Rabs_minus_sym (xh)). fold H. unfold u in *. lra. }
  assert (P0 : bpow (-850) <= Rabs (yh * t)).
  { apply Rle_trans with (2 := proj2 P1). apply Rle_trans with (/ 2 * bpow (-400)); [| unfold u; lra].
    replace (/ 2 * bpow (-400)) with (bpow (-1 + -400)) by (rewrite bpow_plus; reflexivity). apply bpow_le. lia. }
  generalize (times_float_error (parts yh yl) t Ny' Ft P0). destruct (times_float (parts yh yl, t)) as [r r1].
  change (value (parts yh yl)) with (yh + yl). cbn [high]. intros [Fr [Fr1 [Rr1 Er]]].
  unfold from_sum, add, sub, div. fold t.
  assert (Yl : Rabs (yl * t) <= 2 * u * H).
  { apply Rle_trans with (u * Rabs (yh * t)).
    - rewrite (Rmult_comm yl), (Rmult_comm yh). apply small_factor. exact Ly.
    - unfold u in *. lra. }
  set (e1 := r + r1 - (yh + yl) * t) in *.
  assert (E1 : Rabs e1 <= (31 / 10 * u * u + 7 * u * u * u) * H) by (unfold u in *; lra).
  assert (Rr : Rabs (r + r1 - xh) <= (3 * u + 4 * u * u) * H).
  { replace (r + r1 - xh) with (e1 + (yh * t - xh) + yl * t) by (unfold e1; ring).
    bound. }
  assert (Ra : Rabs r <= (1 + 5 * u) * H) by (generalize (with_error r xh); fold H; assert (Rabs (r - xh) <= Rabs (r + r1 - xh) + Rabs r1) by
    (replace (r - xh) with (r + r1 - xh + - r1) by ring; rewrite <- (Rabs_Ropp r1); apply Rabs_triang);
    assert (0 <= Rabs r) by apply Rabs_pos; unfold u in *; lra).
  assert (Rb : Rabs r1 <= (u + 5 * u * u) * H) by (unfold u in *; lra).
  assert (D1 : Rabs (xh - r) <= (4 * u + 10 * u * u) * H) by bound.
  assert (D2 : Rabs (xl - r1) <= (2 * u + 5 * u * u) * H).
  { apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. unfold u in *. lra. }
  assert (FN : forall a, format a -> format (- a)) by (intros; apply generic_format_opp; assumption).
  destruct (rnd_sum_error xh (- r) Fxh (FN _ Fr)) as [Q1 _]. fold (xh - r) in Q1.
  destruct (rnd_sum_error xl (- r1) Fxl (FN _ Fr1)) as [Q2 _]. fold (xl - r1) in Q2.
  set (p := rnd (xh - r)) in *. set (d := rnd (xl - r1)) in *.
  assert (Fp : format p) by apply format_rnd. assert (Fd : format d) by apply format_rnd.
  destruct (rnd_sum_error p d Fp Fd) as [Q3 _]. set (rest := rnd (p + d)) in *.
  assert (B1 : Rabs (p - (xh - r)) <= (4 * u * u + 10 * u * u * u) * H) by (unfold u in *; lra).
  assert (B2 : Rabs (d - (xl - r1)) <= (2 * u * u + 5 * u * u * u) * H) by (unfold u in *; lra).
  assert (B3 : Rabs (p + d) <= (5 * u + 20 * u * u) * H).
  { replace (p + d) with ((p - (xh - r)) + (d - (xl - r1)) + (xl - (r + r1 - xh))) by ring.
    bound. }
  assert (B4 : Rabs (rest - (p + d)) <= (5 * u * u + 20 * u * u * u) * H) by (unfold u in *; lra).
  assert (B5 : Rabs rest <= (5 * u + 30 * u * u) * H) by bound.
  set (q := rnd (rest / yh)). assert (Fq : format q) by apply format_rnd.
  assert (B6 : Rabs (q * yh - rest) <= (5 * u * u + 40 * u * u * u) * H).
  { generalize (rnd_error (rest / yh)). fold q. intros R.
    replace (q * yh - rest) with (yh * (q - rest / yh)) by (field; exact Yn).
    rewrite Rabs_mult. fold Y. apply Rle_trans with (Y * (u * Rabs (rest / yh) + eta)).
    - apply Rmult_le_compat_l; lra.
    - unfold Rdiv. rewrite Rabs_mult, Rabs_inv. fold Y.
      replace (Y * (u * (Rabs rest * / Y) + eta)) with (u * Rabs rest + eta * Y) by (field; lra).
      unfold u in *. lra. }
  assert (B7 : Rabs (q * yh) <= (5 * u + 50 * u * u) * H) by bound.
  assert (B8 : Rabs (q * yl) <= u * Rabs (q * yh)) by (apply small_factor; exact Ly).
  (* |q| <= |t|, from |q yh| <= |t yh|. *)
  assert (L : Rabs q <= Rabs t).
  { apply Rmult_le_reg_r with Y; [exact YP |]. unfold Y. rewrite <- !Rabs_mult, (Rmult_comm t).
    unfold u in *. lra. }
  assert (F : let (s, e) := fast_two_sum (t, q) in s = rnd (t + q) /\ s + e = t + q /\ format s /\ format e).
  { apply fast_two_sum_exact; trivial. left. exact L. }
  destruct (fast_two_sum (t, q)) as [s e]. destruct F as [Hs [Es [Fs Fe]]].
  cbv beta iota delta [value high low]. split; [apply (from_exact_sum t q); trivial |].
  set (vx := xh + xl) in *. set (vy := yh + yl) in *.
  assert (VY : 0 < Rabs vy).
  { apply Rlt_le_trans with ((1 - u) * Y); [| exact Vy]. apply Rmult_lt_0_compat; [unfold u; lra | exact YP]. }
  assert (Vn : vy <> 0) by (intros Z; rewrite Z, Rabs_R0 in VY; lra).
  rewrite Es.
  replace (t + q - vx / vy) with (((t + q) * vy - vx) * / vy) by (field; exact Vn).
  unfold Rdiv. rewrite !Rabs_mult. rewrite <- Rmult_assoc.
  apply Rmult_le_compat_r; [apply Rabs_pos |].
  replace ((t + q) * vy - vx)
    with ((q * yh - rest) + q * yl + (rest - (p + d)) + (p - (xh - r)) + (d - (xl - r1)) - e1)
    by (unfold e1, vx, vy; ring).
  apply Rle_trans with ((243 / 10 * u * u) * H); [| unfold u in *; lra].
  clear Vx. bound.
Qed.

(** The bound that the crate states for each operation: 2^-100. *)
Corollary product_error_as_stated : forall x y, normal x -> normal y -> ordinary (high x) -> ordinary (high y) ->
  Rabs (value (ordinary_product (x, y)) - value x * value y) <= bpow (-100) * Rabs (value x * value y).
Proof.
  intros x y Nx Ny Ox Oy. apply Rle_trans with (1 := proj2 (product_error x y Nx Ny Ox Oy)).
  apply Rmult_le_compat_r; [apply Rabs_pos |]. unfold u. simpl. lra.
Qed.

Corollary quotient_error_as_stated : forall x y, normal x -> normal y -> ordinary (high x) -> ordinary (high y) ->
  Rabs (value (ordinary_quotient (x, y)) - value x / value y) <= bpow (-100) * Rabs (value x / value y).
Proof.
  intros x y Nx Ny Ox Oy. apply Rle_trans with (1 := proj2 (quotient_error x y Nx Ny Ox Oy)).
  apply Rmult_le_compat_r; [apply Rabs_pos |]. unfold u. simpl. lra.
Qed.
