(** The spectrum of the mean over random stackings, for forces that vary in space as plane waves. *)

From Coq Require Import ZArith QArith Qfield Lia Lqa List.
From Cannonpile Require Import Directions Formulas Balance Mean.
Import ListNotations.

Open Scope Q_scope.

(** ** The characteristic polynomial *)

(** A list without its i-th entry. *)
Fixpoint without {A} (i : nat) (all : list A) : list A :=
  match all, i with
  | [], _ => []
  | _ :: rest, O => rest
  | x :: rest, S j => x :: without j rest
  end.

(** The determinant of n columns, expanded along the first: entries times minors, with alternating signs. *)
Fixpoint determinant (n : nat) (columns : list (list Q)) : Q :=
  match n, columns with
  | S m, first :: others =>
      let minor row := determinant m (List.map (without row) others) in
      let fix expand (entries : list Q) (row : nat) : Q :=
        match entries with
        | [] => 0
        | entry :: rest => entry * minor row - expand rest (S row)
        end in
      expand first O
  | _, _ => 1
  end.

(** A step of the mean, which multiplies forces along l by D_l or by its inverse. For D_alpha D_beta D_gamma = 1 the
    inverse is the product of the other two. *)
Definition step_of_wave (q : Q) (d : three Q) (f h : three Q) : list Q :=
  let inverse := Three (d.(beta) * d.(gamma)) (d.(alpha) * d.(gamma)) (d.(alpha) * d.(beta)) in
  let (f, h) := stepped q (by_line Qmult d f) (by_line Qmult inverse h) in
  [f.(alpha); f.(beta); f.(gamma); h.(alpha); h.(beta); h.(gamma)].

(** lambda - M: six columns, the images of a unit force in each component. *)
Definition characteristic (q lambda : Q) (d : three Q) : list (list Q) :=
  let unit i := let at_ j := if Nat.eqb i j then 1 else 0 in
    [at_ 0%nat; at_ 1%nat; at_ 2%nat; at_ 3%nat; at_ 4%nat; at_ 5%nat] in
  let made i := let at_ j := if Nat.eqb i j then 1 else 0 in
    step_of_wave q d (Three (at_ 0%nat) (at_ 1%nat) (at_ 2%nat)) (Three (at_ 3%nat) (at_ 4%nat) (at_ 5%nat)) in
  List.map (fun i => List.map (fun xy => lambda * fst xy - snd xy) (combine (unit i) (made i))) (seq 0 6).

(** Q(y) times lambda^3, with T_1, T_2 and S the sums of cosines and y = x/lambda. *)
Definition cubic (q t1 t2 s x lambda : Q) : Q :=
  x * x * x - 2 * (1 - q) * t1 * (x * x) * lambda
  + ((8 # 3) * (q * q) + 2 * ((1 - q) * (1 - q)) * t1 + (2 # 9) * (3 - q) * (3 - 5 * q) * s) * x * (lambda * lambda)
  - (2 * ((1 - q) * (1 - q) * (1 - q)) + (16 # 9) * (q * q) * (1 - q) * t1
     + (2 # 9) * (1 - q) * (q * q - 18 * q + 9) * t2) * (lambda * lambda * lambda).

(** Six eigenvalues in three pairs lambda, mu/lambda, mu = 1-2q: lambda + mu/lambda is a root of Q. *)
Theorem spectrum_of_the_mean : forall q lambda a b c,
  a * b * c == 1 ->
  let t1 := (a + b + c + (b * c + a * c + a * b)) * (1 # 2) in
  let t2 := (a * a + b * b + c * c + (b * c * (b * c) + a * c * (a * c) + a * b * (a * b))) * (1 # 2) in
  let s := (a * (a * c) + a * (a * b) + b * (b * c) + b * (a * b) + c * (b * c) + c * (a * c)) * (1 # 2) in
  determinant 6 (characteristic q lambda (Three a b c))
  == cubic q t1 t2 s (lambda * lambda + (1 - 2 * q)) lambda.
Proof.
  intros q lambda a b c unit. cbv zeta.
  unfold characteristic, step_of_wave, stepped, by_line, cubic. cbn. formulas. cbn.
  ring [unit].
Qed.

(** ** Long waves *)

(** Polynomials in t by their coefficients below t^6: truncated series. The coefficients are rationals, or
    polynomials in q, so that they can be computed. *)
Section Series.
Context {A : Type} (of_Q : Q -> A) (add mul : A -> A -> A).

Definition coefficient (p : list A) (n : nat) : A := nth n p (of_Q 0).
Definition series_of (f : nat -> A) : list A := List.map f (seq 0 6).
Definition constant (x : A) : list A := series_of (fun n => match n with O => x | _ => of_Q 0 end).
Definition plus (p r : list A) : list A := series_of (fun n => add (coefficient p n) (coefficient r n)).
Definition times (p r : list A) : list A :=
  series_of (fun n => fold_right (fun i => add (mul (coefficient p i) (coefficient r (n - i)))) (of_Q 0) (seq 0 (S n))).
Definition scaled (x : A) (p : list A) : list A := series_of (fun n => mul x (coefficient p n)).
Definition multiple (x : Q) : list A -> list A := scaled (of_Q x).

(** 1 + x (1 + x/2 (1 + x/3 (...))): the exponential of a series x without constant term. *)
Definition exponential (x : list A) : list A :=
  fold_right (fun n rest => plus (constant (of_Q 1)) (multiple (1 # Pos.of_succ_nat n) (times x rest)))
    (constant (of_Q 1)) (seq 0 6).

(** The sum of the cosines of x cos(phi), x cos(phi + 2pi/3) and x cos(phi - 2pi/3): 3 - 3x^2/4 + 3x^4/64, below x^6, for
    every phi. *)
Definition cosines (square : list A) : list A :=
  plus (constant (of_Q 3)) (plus (multiple (- (3 # 4)) square) (multiple (3 # 64) (times square square))).

(** Q(lambda + mu/lambda) for lambda = e^x. The argument kappa cos(phi) of the cosine in T_1 becomes twice kappa in
    T_2, and sqrt(3) times kappa in S. *)
Definition cubic_of_wave (q : A) (square x : list A) : list A :=
  let t1 := cosines square in
  let t2 := cosines (multiple 4 square) in
  let s := cosines (multiple 3 square) in
  let linear a b := add (of_Q a) (mul (of_Q b) q) in
  let stay := linear 1 (- (1)) in
  let y := plus (exponential x) (scaled (linear 1 (- (2))) (exponential (multiple (- (1)) x))) in
  let of_y := plus (constant (mul (of_Q (8 # 3)) (mul q q)))
    (plus (scaled (mul (of_Q 2) (mul stay stay)) t1)
          (scaled (mul (of_Q (2 # 9)) (mul (linear 3 (- (1))) (linear 3 (- (5))))) s)) in
  let rest := plus (constant (mul (of_Q 2) (mul stay (mul stay stay))))
    (plus (scaled (mul (of_Q (16 # 9)) (mul (mul q q) stay)) t1)
          (scaled (mul (of_Q (2 # 9)) (mul stay (add (mul q q) (linear 9 (- (18)))))) t2)) in
  plus (times y (times y y))
    (plus (scaled (mul (of_Q (- (2))) stay) (times t1 (times y y))) (plus (times of_y y) (multiple (- (1)) rest))).
End Series.

(** Polynomials in q. *)
Fixpoint value (p : list Q) (q : Q) : Q := match p with [] => 0 | c :: rest => c + q * value rest q end.
Definition polynomial_of (x : Q) : list Q := [x].
Fixpoint added (p r : list Q) : list Q :=
  match p, r with
  | [], _ => r
  | _, [] => p
  | x :: p, y :: r => Qred (x + y) :: added p r
  end.
Fixpoint multiplied (p r : list Q) : list Q :=
  match p with
  | [] => []
  | x :: p => added (List.map (fun y => Qred (x * y)) r) (0 :: multiplied p r)
  end.

Lemma value_of_sum : forall q p r, value (added p r) q == value p q + value r q.
Proof. intros q. induction p as [|x p IH]; intros [|y r]; cbn [value added List.map]; rewrite ?IH, ?Qred_correct; ring. Qed.

Lemma value_of_multiple : forall q x r, value (List.map (fun y => Qred (x * y)) r) q == x * value r q.
Proof. intros q x. induction r as [|y r IH]; cbn [value added List.map]; rewrite ?IH, ?Qred_correct; ring. Qed.

Lemma value_of_product : forall q p r, value (multiplied p r) q == value p q * value r q.
Proof.
  intros q. induction p as [|x p IH]; intros r; cbn [value multiplied]; [ring|].
  rewrite value_of_sum, value_of_multiple. cbn [value]. rewrite IH. ring.
Qed.

(** Series whose coefficients are values of polynomials at q. All operations preserve this property. *)
Section Values.
Variable q : Q.

Definition is_value (p : list Q) (x : Q) : Prop := value p q == x.
Definition are_values (s : list (list Q)) (p : list Q) : Prop :=
  forall n, is_value (coefficient polynomial_of s n) (coefficient (fun x => x) p n).

Lemma number_is_value : forall x, is_value (polynomial_of x) x.
Proof. intros x. unfold is_value, polynomial_of. cbn [value]. ring. Qed.

Lemma sum_is_value : forall p r x y, is_value p x -> is_value r y -> is_value (added p r) (x + y).
Proof. unfold is_value. intros p r x y <- <-. apply value_of_sum. Qed.

Lemma product_is_value : forall p r x y, is_value p x -> is_value r y -> is_value (multiplied p r) (x * y).
Proof. unfold is_value. intros p r x y <- <-. apply value_of_product. Qed.

Lemma series_are_values : forall f g, (forall n, is_value (f n) (g n)) -> are_values (series_of f) (series_of g).
Proof.
  intros f g H [|[|[|[|[|[|n]]]]]]; try apply H; unfold coefficient, series_of; cbn;
    destruct n; apply number_is_value.
Qed.

Ltac values := repeat first
  [ assumption | apply number_is_value | apply sum_is_value | apply product_is_value | apply series_are_values; intros
  | match goal with H : are_values _ _ |- is_value (coefficient _ _ _) _ => apply H end ].

Lemma constant_is_value : forall p x, is_value p x -> are_values (constant polynomial_of p) (constant (fun x => x) x).
Proof. intros p x H. apply series_are_values. intros [|n]; values. Qed.

Lemma plus_is_value : forall p r x y, are_values p x -> are_values r y ->
  are_values (plus polynomial_of added p r) (plus (fun x => x) Qplus x y).
Proof. intros. unfold plus. values. Qed.

Lemma scaled_is_value : forall c z p x, is_value c z -> are_values p x ->
  are_values (scaled polynomial_of multiplied c p) (scaled (fun x => x) Qmult z x).
Proof. intros. unfold scaled. values. Qed.

Lemma times_is_value : forall p r x y, are_values p x -> are_values r y ->
  are_values (times polynomial_of added multiplied p r) (times (fun x => x) Qplus Qmult x y).
Proof.
  intros p r x y Hp Hr. apply series_are_values. intros n. induction (seq 0 (S n)) as [|i rest IH]; cbn [fold_right]; values.
Qed.

(** Proves that the operations on series preserve this property. *)
Ltac series := lazymatch goal with
  | |- are_values (plus _ _ _ _) _ => apply plus_is_value; series
  | |- are_values (times _ _ _ _ _) _ => apply times_is_value; series
  | |- are_values (constant _ _) _ => apply constant_is_value; series
  | |- are_values (scaled _ _ _ _) _ => apply scaled_is_value; series
  | |- is_value (added _ _) _ => apply sum_is_value; series
  | |- is_value (multiplied _ _) _ => apply product_is_value; series
  | |- is_value (polynomial_of _) _ => apply number_is_value
  | |- _ => try assumption
  end.

Lemma exponential_is_value : forall p x, are_values p x ->
  are_values (exponential polynomial_of added multiplied p) (exponential (fun x => x) Qplus Qmult x).
Proof.
  intros p x H. unfold exponential, multiple. induction (seq 0 6) as [|n rest IH]; cbn [fold_right]; series.
Qed.

Lemma cubic_is_value : forall p x r y, are_values p x -> are_values r y ->
  are_values (cubic_of_wave polynomial_of added multiplied [0; 1] p r) (cubic_of_wave (fun x => x) Qplus Qmult q x y).
Proof.
  assert (symbol : is_value [0; 1] q) by (unfold is_value; cbn [value]; ring).
  intros. unfold cubic_of_wave, cosines, multiple. cbv zeta.
  series; apply exponential_is_value; series.
Qed.
End Values.

Definition nothing_below (n : nat) (p : list Q) : Prop :=
  forall m, (m < n)%nat -> coefficient (fun x => x) p m == 0.

(** An identity of polynomials in q holds for every q. *)
Lemma nothing_is_left : forall q n p r x y,
  are_values q p x -> are_values q r y ->
  forallb (fun m => forallb (fun c => Qeq_bool c 0) (coefficient polynomial_of
    (cubic_of_wave polynomial_of added multiplied [0; 1] p r) m)) (seq 0 n) = true ->
  nothing_below n (cubic_of_wave (fun x => x) Qplus Qmult q x y).
Proof.
  intros q n p r x y Hp Hr computed m Hm.
  pose proof (cubic_is_value q p x r y Hp Hr m) as is. unfold is_value in is. rewrite <- is. clear is.
  rewrite forallb_forall in computed. specialize (computed m).
  rewrite in_seq in computed. specialize (computed ltac:(lia)).
  induction (coefficient polynomial_of _ m) as [|c rest IH]; cbn [value]; [reflexivity|].
  cbn [forallb] in computed. apply andb_prop in computed as [first others].
  apply Qeq_bool_eq in first. rewrite first, (IH others). ring.
Qed.

(** With i kappa = sqrt(2) q t, so kappa^2 = -2 q^2 t^2, and the exponent i kappa/sqrt(2) (1 + b kappa^2) - a
    kappa^2, where qa and q^2 b are those of [wave]: Q vanishes below kappa^6. The speed is rho/sqrt(2), for every q. *)
Theorem waves_run : forall q,
  let (damping, dispersion) := wave q in
  nothing_below 6 (cubic_of_wave (fun x => x) Qplus Qmult q
    [0; 0; - (2) * (q * q)] [0; q; 2 * q * damping; - (2) * q * dispersion]).
Proof.
  intros q. cbv beta iota zeta delta [wave].
  apply (nothing_is_left q 6 [[]; []; [0; 0; - (2)]]
    [[]; [0; 1]; [0; 1 # 8; - (1 # 8)]; [0; - (42 # 768); 84 # 768; - (26 # 768)]]).
  - intros [|[|[|[]]]]; unfold is_value; cbn [value nth coefficient polynomial_of]; ring.
  - intros [|[|[|[|[]]]]]; unfold is_value; cbn [value nth coefficient polynomial_of]; ring.
  - vm_compute. reflexivity.
Qed.

(** With kappa^2 = 8qt: the component across the wave decays with exp(-2a kappa^2), and Q vanishes below kappa^6. *)
Theorem waves_across_decay : forall q,
  let (damping, _) := wave q in
  nothing_below 3 (cubic_of_wave (fun x => x) Qplus Qmult q [0; 8 * q] [0; - (16) * damping]).
Proof.
  intros q. cbv beta iota zeta delta [wave].
  apply (nothing_is_left q 3 [[]; [0; 8]] [[]; [- (1); 1]]).
  - intros [|[|[]]]; unfold is_value; cbn [value nth coefficient polynomial_of]; ring.
  - intros [|[|[]]]; unfold is_value; cbn [value nth coefficient polynomial_of]; ring.
  - vm_compute. reflexivity.
Qed.
