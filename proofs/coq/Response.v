(** The response to a unit load, in any stacking: what is kept, and its moments. *)

From Coq Require Import ZArith QArith Qfield Setoid Morphisms Lia Lqa List.
From Cannonpile Require Import Directions Sums Formulas Balance Horizontal.

Import ListNotations.
Open Scope Q_scope.

(** ** Of one sphere *)

(** Three numbers that do without the signs: of g under - steps Gg has the same resultant along the directions of +. *)
Theorem resultant_form : forall g,
  resultant g (directions_under (1 # 2) Minus) =v= resultant (half_turn g) (directions_under (1 # 2) Plus).
Proof. intros []. unfold directions_under. by_components. Qed.

(** Sums and squares: f = T g + n has the sum of g and 3n more, and the squares of g and 2n times its sum and 3n^2 more. *)
Theorem sums_and_squares : forall from to g n,
  let f := by_line passed_on (transferred from to g) (each n) in
  sum f == sum g + 3 * n /\ dot f f == dot g g + 2 * n * sum g + 3 * n * n /\
  force n (weight (increments (1 # 2))) == 3 * n.
Proof. intros [] [] [] n; unfold transferred, dot; repeat split; formulas; ring. Qed.

(** HCP is a wave: what three spheres pass on to the one between them is 2/3 of their loads less what one two layers above
    has passed on. *)
Theorem wave_of_hcp : forall g h k,
  (half_turn g).(alpha) + (half_turn h).(beta) + (half_turn k).(gamma)
  == (2 # 3) * (sum g + sum h + sum k) - (g.(alpha) + h.(beta) + k.(gamma)).
Proof. intros [] [] []. formulas. ring. Qed.

(** Few faults: a change of sign turns 3v along a line into -v along it and 2v along the others. *)
Theorem fault : forall l v,
  let t := map (Qmult 3) (half_turn (map (Qmult v) (one_on l))) in
  t =3= map (fun one => (2 - 3 * one) * v) (one_on l) /\ sum t == 3 * v /\ dot t t == 9 * v * v.
Proof. intros [] v; unfold one_on, dot; repeat split; formulas; ring. Qed.

(** ** Places

    A contact leads down by the position of one sphere on its line; places are (x, y), in units of which r^2 = x^2 + 3y^2. *)
Definition down_by (sigma : sign) (d : direction) : vector := position (one_on d) (directions_under (1 # 2) sigma).

(** One fault, m steps above and n below: six loads 2/9 and three -1/9, at these distances. *)
Theorem one_fault : forall a b m n,
  let x := m * (down_by Plus a).(along_x) + n * (down_by Minus b).(along_x) in
  let y := m * (down_by Plus a).(along_y) + n * (down_by Minus b).(along_y) in
  let v := on b (half_turn (map (Qmult (1 # 3)) (one_on a))) in
  (a = b -> v == - (1 # 9) /\ x * x + 3 * y * y == (m - n) * (m - n)) /\
  (a <> b -> v == (2 # 9) /\ x * x + 3 * y * y == m * m + m * n + n * n).
Proof.
  intros [] [] m n; cbv zeta; unfold down_by, directions_under, one_on; split; intros H; try congruence;
    split; formulas; ring.
Qed.

(** A contact of the response: the place of its lower sphere, its line, and what it bears of the load. *)
Record contact := Contact { at_x : Q; at_y : Q; line : direction; bears : Q }.

(** What one contact makes of those below its sphere: T, spread over three. *)
Definition spread (from to : sign) (c : contact) : list contact :=
  let f := transferred from to (map (Qmult c.(bears)) (one_on c.(line))) in
  List.map (fun d => Contact (c.(at_x) + (down_by to d).(along_x)) (c.(at_y) + (down_by to d).(along_y)) d (on d f))
    [Alpha; Beta; Gamma].

(** The load stands on three contacts, a third each. *)
Definition first (sigma : sign) : list contact :=
  List.map (fun d => Contact (down_by sigma d).(along_x) (down_by sigma d).(along_y) d
      (on d (increments (1 # 2)) / weight (increments (1 # 2))))
    [Alpha; Beta; Gamma].

Section Stacking.
Variable step : nat -> sign.

(** The contacts n+1 steps below the load. Where several arrive on one line of one sphere, they are counted apart:
    transfers are linear, and so are all sums below. *)
Fixpoint response (n : nat) : list contact :=
  match n with
  | O => first (step 0)
  | S m => flat_map (spread (step m) (step (S m))) (response m)
  end.

Fixpoint over (F : contact -> Q) (l : list contact) : Q :=
  match l with
  | [] => 0
  | c :: l => F c + over F l
  end.

Lemma over_app : forall F l m, over F (l ++ m) == over F l + over F m.
Proof. intros F l m. induction l as [|c l IH]; simpl; [ring|]. rewrite IH. ring. Qed.

Lemma over_spread : forall F G from to l,
  (forall c, over F (spread from to c) == G c) -> over F (flat_map (spread from to) l) == over G l.
Proof.
  intros F G from to l H. induction l as [|c l IH]; simpl; [reflexivity|].
  change (over F (spread from to c ++ flat_map (spread from to) l) == G c + over G l).
  rewrite over_app, H, IH. reflexivity.
Qed.

Lemma over_sum : forall F G l, over (fun c => F c + G c) l == over F l + over G l.
Proof. intros F G l. induction l as [|c l IH]; simpl; [ring|]. rewrite IH. ring. Qed.

Lemma over_multiple : forall x F l, over (fun c => x * F c) l == x * over F l.
Proof. intros x F l. induction l as [|c l IH]; simpl; [ring|]. rewrite IH. ring. Qed.

(** The step of a contact of the layer under the sign sigma. *)
Definition dx (sigma : sign) (c : contact) : Q := (down_by sigma c.(line)).(along_x).
Definition dy (sigma : sign) (c : contact) : Q := (down_by sigma c.(line)).(along_y).

(** Products of places in the complex plane, x + iy sqrt(3): the real part of z times the conjugate of d, and r^2. *)
Definition along (sigma : sign) (c : contact) : Q := c.(at_x) * dx sigma c + 3 * c.(at_y) * dy sigma c.
Definition square (c : contact) : Q := c.(at_x) * c.(at_x) + 3 * c.(at_y) * c.(at_y).

(** The real part of z^3 E', with E the cube of the step along alpha under +, E' its conjugate, so that it is r^3 cos 3phi; and
    that of z'^2 d' E. *)
Definition cube_x (x y : Q) : Q := x * x * x - 9 * x * y * y.
Definition cube_y (x y : Q) : Q := 3 * x * x * y - 3 * y * y * y.
Definition e_x : Q := cube_x (down_by Plus Alpha).(along_x) (down_by Plus Alpha).(along_y).
Definition e_y : Q := cube_y (down_by Plus Alpha).(along_x) (down_by Plus Alpha).(along_y).

Definition third (c : contact) : Q :=
  cube_x c.(at_x) c.(at_y) * e_x + 3 * cube_y c.(at_x) c.(at_y) * e_y.

Definition across (sigma : sign) (c : contact) : Q :=
  let u := c.(at_x) * c.(at_x) - 3 * c.(at_y) * c.(at_y) in
  let v := 2 * c.(at_x) * c.(at_y) in
  (u * dx sigma c - 3 * v * dy sigma c) * e_x + 3 * (u * dy sigma c + v * dx sigma c) * e_y.

Definition load (F : contact -> Q) (c : contact) : Q := c.(bears) * F c.

(** What is made of numbers is a number: steps, and E. *)
Ltac numbers :=
  repeat match goal with
         | |- context [along_x (down_by ?s ?d)] =>
           let v := eval vm_compute in (along_x (down_by s d)) in change (along_x (down_by s d)) with v
         | |- context [along_y (down_by ?s ?d)] =>
           let v := eval vm_compute in (along_y (down_by s d)) in change (along_y (down_by s d)) with v
         | |- context [e_x] => let v := eval vm_compute in e_x in change e_x with v
         | |- context [e_y] => let v := eval vm_compute in e_y in change e_y with v
         end.

Ltac opened :=
  unfold load, third, across, along, square, cube_x, cube_y, dx, dy, spread, transferred, one_on;
  cbn [List.map over at_x at_y line bears]; numbers; formulas.

Ltac by_signs := intros [] [] [x y [] v]; unfold times; opened; ring.

(** What one contact's sphere passes on, of each moment: whatever the two signs are. *)
Lemma load_step : forall from to c, over (load (fun _ => 1)) (spread from to c) == load (fun _ => 1) c.
Proof. by_signs. Qed.

Lemma dx_step : forall from to c, over (load (dx to)) (spread from to c) == load (dx from) c.
Proof. by_signs. Qed.

Lemma dy_step : forall from to c, over (load (dy to)) (spread from to c) == load (dy from) c.
Proof. by_signs. Qed.

Lemma x_step : forall from to c,
  over (load at_x) (spread from to c) == load at_x c + load (dx from) c.
Proof. by_signs. Qed.

Lemma y_step : forall from to c,
  over (load at_y) (spread from to c) == load at_y c + load (dy from) c.
Proof. by_signs. Qed.

Lemma along_step : forall from to c,
  over (load (along to)) (spread from to c) == load (along from) c + load (fun _ => 1) c.
Proof. by_signs. Qed.

Lemma square_step : forall from to c,
  over (load square) (spread from to c) == load square c + (2 * load (along from) c + load (fun _ => 1) c).
Proof. by_signs. Qed.

Lemma across_step : forall from to c,
  over (load (across to)) (spread from to c)
  == load (across from) c + times to 1 * (2 * load (along from) c + load (fun _ => 1) c).
Proof. by_signs. Qed.

Lemma third_step : forall from to c,
  over (load third) (spread from to c)
  == load third c + (3 * load (across from) c + times to 1 * (3 * load (along from) c + load (fun _ => 1) c)).
Proof. by_signs. Qed.

(** ** A load at depth n+1, in any stacking *)

Ltac at_first :=
  cbn [total]; unfold response, first, times, dx, dy, along, across; destruct (step 0); vm_compute; reflexivity.

Ltac next lemma := cbn [response]; rewrite (over_spread _ _ _ _ _ (lemma _ _));
  rewrite ?over_sum, ?over_multiple, ?over_sum, ?over_multiple.

(** The load is kept: sum of v = 1. *)
Theorem load_is_kept : forall n, over (load (fun _ => 1)) (response n) == 1.
Proof.
  induction n as [|n IH]; [at_first|]. next load_step. exact IH.
Qed.

(** No horizontal force: sum of v d = 0. *)
Lemma no_side : forall n, over (load (dx (step n))) (response n) == 0 /\ over (load (dy (step n))) (response n) == 0.
Proof.
  induction n as [|n [X Y]]; [split; at_first|]. split; [next dx_step; exact X | next dy_step; exact Y].
Qed.

(** It stays below the load: sum of v r = 0. *)
Theorem response_is_centred : forall n, over (load at_x) (response n) == 0 /\ over (load at_y) (response n) == 0.
Proof.
  induction n as [|n [X Y]]; [split; at_first|]. destruct (no_side n) as [DX DY].
  split; [next x_step; rewrite X, DX | next y_step; rewrite Y, DY]; ring.
Qed.

Lemma along_is : forall n, over (load (along (step n))) (response n) == n_of (S n).
Proof.
  induction n as [|n IH]; [at_first|]. next along_step. rewrite IH, load_is_kept, (n_of_S (S n)). reflexivity.
Qed.

(** Sum of v r^2 = n^2 rho^2 at depth n, whatever the stacking. *)
Theorem second_moment_of_response : forall n, over (load square) (response n) == n_of (S n) * n_of (S n).
Proof.
  induction n as [|n IH]; [at_first|]. next square_step. rewrite IH, along_is, load_is_kept, (n_of_S (S n)). ring.
Qed.

(** ** The third moment: which way a response points *)

Lemma across_is : forall n,
  over (load (across (step n))) (response n) == total (S n) (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1)).
Proof.
  induction n as [|n IH]; [at_first|].
  next across_step. rewrite IH, along_is, load_is_kept.
  change (total (S (S n)) ?f) with (total (S n) f + f (S n)). cbv beta. rewrite (n_of_S n). ring.
Qed.

(** The sum of v r^3 cos 3phi at depth n+1 is the sum over the steps of sigma_s times [third_moment]. *)
Theorem third_moment_of_response : forall n,
  over (load third) (response n)
  == total (S n) (fun s => times (step s) 1 * third_moment (n_of (S n)) (n_of s + 1)).
Proof.
  induction n as [|n IH]; [at_first|].
  next third_step. rewrite IH, along_is, across_is, load_is_kept.
  change (total (S (S n)) (fun s => times (step s) 1 * third_moment (n_of (S (S n))) (n_of s + 1)))
    with (total (S n) (fun s => times (step s) 1 * third_moment (n_of (S (S n))) (n_of s + 1))
          + times (step (S n)) 1 * third_moment (n_of (S (S n))) (n_of (S n) + 1)).
  rewrite (total_of_same (S n) (fun s => times (step s) 1 * third_moment (n_of (S (S n))) (n_of s + 1))
    (fun s => times (step s) 1 * third_moment (n_of (S n)) (n_of s + 1)
              + 3 * (times (step s) 1 * (2 * (n_of s + 1) - 1)))).
  - rewrite total_of_sum, total_of_multiple. formulas. rewrite (n_of_S (S n)). ring.
  - intros s _. formulas. rewrite (n_of_S (S n)). ring.
Qed.

(** ** The fourth moment: how a response spreads *)

Definition fourth (c : contact) : Q := square c * square c.
Definition outward (sigma : sign) (c : contact) : Q := square c * along sigma c.

Ltac opened ::=
  unfold load, fourth, outward, third, across, along, square, cube_x, cube_y, dx, dy, spread, transferred, one_on;
  cbn [List.map over at_x at_y line bears]; numbers; formulas.

Lemma outward_step : forall from to c,
  over (load (outward to)) (spread from to c)
  == load (outward from) c + (times to 1 * load (across from) c + (2 * load square c + (3 * load (along from) c
     + load (fun _ => 1) c))).
Proof. by_signs. Qed.

Lemma fourth_step : forall from to c,
  over (load fourth) (spread from to c)
  == load fourth c + (load (fun _ => 1) c + (4 * load square c + (4 * load (outward from) c + (4 * load (along from) c
     + 2 * times to 1 * load (across from) c)))).
Proof. by_signs. Qed.

(** What pairs of signs make of the outward moment, and of the fourth. *)
Definition pairs_below (n : nat) (weight : Q -> Q -> Q) : Q :=
  total n (fun t => times (step t) 1 * total t (fun s => times (step s) 1 * weight (n_of s + 1) (n_of t + 1))).

Lemma outward_is : forall n,
  over (load (outward (step n))) (response n)
  == n_of (S n) * (n_of (S n) + 1) * (2 * n_of (S n) + 1) * (1 # 3) - n_of (S n) * (n_of (S n) + 1) * (1 # 2)
     + pairs_below (S n) (fun s _ => 2 * s - 1).
Proof.
  induction n as [|n IH]; [unfold pairs_below, outward; at_first|].
  next outward_step. rewrite IH, across_is, second_moment_of_response, along_is, load_is_kept.
  unfold pairs_below.
  change (total (S (S n)) (fun t => times (step t) 1 * total t (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1))))
    with (total (S n) (fun t => times (step t) 1 * total t (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1)))
          + times (step (S n)) 1 * total (S n) (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1))).
  rewrite (n_of_S (S n)). ring.
Qed.

Lemma pairs_of_sum : forall n F G H c,
  (forall s t, F s t == G s t + c * H s t) -> pairs_below n F == pairs_below n G + c * pairs_below n H.
Proof.
  intros n F G H c E. unfold pairs_below.
  rewrite <- total_of_multiple, <- total_of_sum. apply total_of_same. intros t _.
  rewrite (total_of_same t (fun s => times (step s) 1 * F (n_of s + 1) (n_of t + 1))
    (fun s => times (step s) 1 * G (n_of s + 1) (n_of t + 1) + c * (times (step s) 1 * H (n_of s + 1) (n_of t + 1)))).
  - rewrite total_of_sum, total_of_multiple. ring.
  - intros s _. rewrite E. ring.
Qed.

(** The sum of v r^4 at depth n+1 is [fourth_moment], and [fourth_moment_of_pair] times the signs of each two steps. *)
Theorem fourth_moment_of_response : forall n,
  over (load fourth) (response n)
  == fourth_moment (n_of (S n)) + pairs_below (S n) (fourth_moment_of_pair (n_of (S n))).
Proof.
  induction n as [|n IH]; [unfold pairs_below, fourth; at_first|].
  next fourth_step. rewrite IH, outward_is, across_is, second_moment_of_response, along_is, load_is_kept.
  assert (P : pairs_below (S (S n)) (fourth_moment_of_pair (n_of (S (S n))))
    == pairs_below (S n) (fourth_moment_of_pair (n_of (S n))) + 4 * pairs_below (S n) (fun s _ => 2 * s - 1)
       + times (step (S n)) 1 * (2 * total (S n) (fun s => times (step s) 1 * (2 * (n_of s + 1) - 1)))).
  { transitivity (pairs_below (S n) (fourth_moment_of_pair (n_of (S (S n))))
      + times (step (S n)) 1 * total (S n) (fun s => times (step s) 1
          * fourth_moment_of_pair (n_of (S (S n))) (n_of s + 1) (n_of (S n) + 1))); [reflexivity|].
    rewrite (pairs_of_sum (S n) _ (fourth_moment_of_pair (n_of (S n))) (fun s _ => 2 * s - 1) 4).
    - rewrite (total_of_same (S n)
        (fun s => times (step s) 1 * fourth_moment_of_pair (n_of (S (S n))) (n_of s + 1) (n_of (S n) + 1))
        (fun s => 2 * (times (step s) 1 * (2 * (n_of s + 1) - 1)))).
      + rewrite total_of_multiple. ring.
      + intros s _. formulas. rewrite (n_of_S (S n)). ring.
    - intros s t. formulas. rewrite (n_of_S (S n)). ring. }
  rewrite P. formulas. rewrite (n_of_S (S n)). ring.
Qed.

End Stacking.
