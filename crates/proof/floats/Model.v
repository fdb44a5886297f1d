(** The arithmetic of `f64`, as real numbers that are rounded, and the functions of `exact-surd` on it.

    Every definition between the marks `begin` and `end` has the tokens of the Rust function that is named there.
    `crates/proof/check` compares them. In these definitions + - * / are rounded operations, as in Rust. *)

From Coq Require Import ZArith Reals Lra Lia.
From Flocq Require Import Core.

Open Scope R_scope.

(** The numbers of binary64 without a largest exponent: 53 bits, and multiples of 2^-1074. *)
Notation fexp := (FLT_exp (-1074) 53).
Notation format := (generic_format radix2 fexp).
Notation bpow e := (bpow radix2 e).

#[export] Instance bits_are_positive : Prec_gt_0 53 := eq_refl.

(** Rounding to nearest, ties to even. *)
Notation rnd := (round radix2 fexp ZnearestE).

(** A rounded result does not overflow if it is below 2^1024. Then the operation of IEEE 754 returns it. *)
Definition finite_result (x : R) : Prop := Rabs x < bpow 1024.

Definition add (x y : R) : R := rnd (x + y).
Definition sub (x y : R) : R := rnd (x - y).
Definition mul (x y : R) : R := rnd (x * y).
Definition div (x y : R) : R := rnd (x / y).
Definition square_root (x : R) : R := rnd (sqrt x).

Declare Scope float_scope.
Delimit Scope float_scope with F.
Arguments add x%F y%F.
Arguments sub x%F y%F.
Arguments mul x%F y%F.
Arguments div x%F y%F.
Infix "+" := add : float_scope.
Infix "-" := sub : float_scope.
Infix "*" := mul : float_scope.
Infix "/" := div : float_scope.

(** ** error_free.rs *)

Local Open Scope float_scope.

(* begin crates/surd/src/error_free.rs two_sum *)
Definition two_sum '((a, b) : prod R R) : prod R R :=
  let s := a + b in
  let from_b := s - a in
  let from_a := s - from_b in
  (s, (a - from_a) + (b - from_b)).
(* end *)

(* begin crates/surd/src/error_free.rs fast_two_sum *)
Definition fast_two_sum '((a, b) : prod R R) : prod R R :=
  let s := a + b in
  (s, b - (s - a)).
(* end *)

(* begin crates/surd/src/error_free.rs split *)
Definition split '(a : R) : prod R R :=
  let c := 134217729 * a in
  let high := c - (c - a) in
  (high, a - high).
(* end *)

(* begin crates/surd/src/error_free.rs two_product *)
Definition two_product '((a, b) : prod R R) : prod R R :=
  let p := a * b in
  let '((a1, a2), (b1, b2)) := (split(a), split(b)) in
  (p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2).
(* end *)

(** ** double_double.rs

    [finite] replaces parts that are not finite. In the domain of the theorems all parts are finite. *)

Record DoubleDouble := parts { high : R; low : R }.

Definition finite '((p, float) : prod (prod R R) R) : DoubleDouble := let (h, l) := p in parts h l.

(* begin crates/surd/src/double_double.rs from_sum *)
Definition from_sum '((greater, lesser) : prod R R) : DoubleDouble :=
  let '(high, low) := fast_two_sum(greater, lesser) in
  parts high low.
(* end *)

(* begin crates/surd/src/double_double.rs add *)
Definition sum '((self, rhs) : prod DoubleDouble DoubleDouble) : DoubleDouble :=
  let '(s, s1) := two_sum(self.(high), rhs.(high)) in
  let '(t, t1) := two_sum(self.(low), rhs.(low)) in
  let '(v, v1) := fast_two_sum(s, s1 + t) in
  finite(fast_two_sum(v, t1 + v1), self.(high) + rhs.(high)).
(* end *)

(* begin crates/surd/src/double_double.rs ordinary_product *)
Definition ordinary_product '((self, rhs) : prod DoubleDouble DoubleDouble) : DoubleDouble :=
  let '(c, c1) := two_product(self.(high), rhs.(high)) in
  let c2 := self.(high) * rhs.(low) + self.(low) * rhs.(high) in
  from_sum(c, c1 + c2).
(* end *)

(* begin crates/surd/src/double_double.rs times_float *)
Definition times_float '((self, y) : prod DoubleDouble R) : prod R R :=
  let '(c, c1) := two_product(self.(high), y) in
  let c2 := self.(low) * y in
  let '(t, t1) := fast_two_sum(c, c2) in
  fast_two_sum(t, t1 + c1).
(* end *)

(* begin crates/surd/src/double_double.rs ordinary_quotient *)
Definition ordinary_quotient '((self, divisor) : prod DoubleDouble DoubleDouble) : DoubleDouble :=
  let t := self.(high) / divisor.(high) in
  let '(r, r1) := times_float(divisor, t) in
  let rest := (self.(high) - r) + (self.(low) - r1) in
  from_sum(t, rest / divisor.(high)).
(* end *)
