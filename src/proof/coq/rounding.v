(** * Rounding to nearest, and the signs of formulas in which each rounding has an unknown of its own.

    Without under- and overflow, to round to [prec] bits is to multiply by 1 + e/(n + 1), where n = 2^prec
    and e is some number from -1 to 1. What is said of computed values is then said of quotients of
    polynomials. They are too large for [positivity]: a program decides their signs, and is proved right. *)
From Coq Require Import List Bool ZArith Lia.
From Flocq Require Import Core Relative.
From Contact Require Import A_Tactics.
Import ListNotations.
Open Scope R_scope.

(** ** Rounding

    To [prec] bits; [choice] says what becomes of a number half-way between two. *)
Definition fl (prec : Z) (choice : Z -> bool) (x : R) : R :=
  round radix2 (FLX_exp prec) (Znearest choice) x.

Section Rounding.
Variables (prec : Z) (choice : Z -> bool) (n : R).
Variable two_bits : (2 <= prec)%Z.
Variable power : n = bpow radix2 prec.

#[local] Instance some_bits : Prec_gt_0 prec.
Proof. unfold Prec_gt_0. lia. Qed.

Lemma four_at_least : 4 <= n.
Proof. rewrite power. change 4 with (bpow radix2 2). apply bpow_le, two_bits. Qed.

Lemma model x : exists e, -1 <= e <= 1 /\ fl prec choice x = x * (n + 1 + e) / (n + 1).
Proof.
  pose proof four_at_least as N.
  destruct (relative_error_N_FLX'_ex radix2 prec some_bits choice x) as (d & B & E).
  replace (u_ro radix2 prec / (1 + u_ro radix2 prec)) with (/ (n + 1)) in B.
  - apply Rabs_le_inv in B. exists (d * (n + 1)). split.
    + assert (/ (n + 1) * (n + 1) = 1) by (field; lra). nra.
    + unfold fl. rewrite E. field. lra.
  - unfold u_ro. rewrite bpow_plus, bpow_opp, <- power. change (bpow radix2 1) with 2. field. lra.
Qed.

Lemma fl_le x y : x <= y -> fl prec choice x <= fl prec choice y.
Proof. apply round_le; typeclasses eauto. Qed.

(** What is rounded stays as it is. *)
Lemma fl_fl x : fl prec choice (fl prec choice x) = fl prec choice x.
Proof. apply round_generic; [typeclasses eauto | ]. apply generic_format_round; typeclasses eauto. Qed.

(** The unit does not matter, if it is a power of 2. *)
Lemma fl_scale a x : fl prec choice (bpow radix2 a * x) = bpow radix2 a * fl prec choice x.
Proof.
  destruct (Req_dec x 0) as [-> | X].
  - unfold fl. rewrite Rmult_0_r, round_0 by typeclasses eauto. ring.
  - unfold fl, round, scaled_mantissa, F2R, cexp, FLX_exp; cbn [Fnum Fexp].
    rewrite (Rmult_comm _ x), mag_mult_bpow, Rmult_assoc, <- bpow_plus by exact X.
    replace (a + - _)%Z with (- (mag radix2 x - prec))%Z by lia.
    replace (mag radix2 x + a - prec)%Z with (a + (mag radix2 x - prec))%Z by lia.
    rewrite bpow_plus. ring.
Qed.
End Rounding.

(** With what [model] says of each rounding, the last of them first. *)
Ltac rounded E :=
  repeat match goal with
  | F : fl _ _ ?x = ?x * _ / _ |- _ => rewrite F in *; clear F
  end;
  clear E.

(** The same without a word on any of them, the first of them first. *)
Ltac roundings :=
  repeat match goal with
  | P : (2 <= ?prec)%Z, E : ?n = bpow radix2 ?prec |- _ =>
      let e := fresh "e" in
      let F := fresh in
      let by_model choice x :=
        (lazymatch x with context [fl _ _ _] => fail | _ => idtac end;
         destruct (model prec choice n P E x) as (e & ? & F); rewrite F in *; clear F) in
      match goal with
      | |- context [fl prec ?choice ?x] => by_model choice x
      | _ : context [fl prec ?choice ?x] |- _ => by_model choice x
      end
  end;
  repeat match goal with E : _ = bpow radix2 _ |- _ => clear E end.

(** ** Sizes *)
Lemma within x b : 0 <= b - x -> 0 <= b + x -> Rabs x <= b.
Proof. intros. apply Rabs_le. lra. Qed.

(** What lies between two values, by something that lies between -1 and 1. *)
Lemma between a b x :
  0 <= (b - x) * (x - a) -> exists t, -1 <= t <= 1 /\ x = (a + b) / 2 + (b - a) / 2 * t.
Proof.
  intro H. destruct (Req_dec a b) as [<- | D].
  - exists 0. split; [lra | nra].
  - exists ((2 * x - a - b) / (b - a)). split; [ | field; lra].
    enough (0 <= 1 - (2 * x - a - b) / (b - a) * ((2 * x - a - b) / (b - a))) by nra.
    replace (1 - _) with (4 * ((b - x) * (x - a)) / ((b - a) * (b - a))) by (field; lra).
    apply Rdiv_le_0_compat; [lra | ]. apply Rsqr_pos_lt. lra.
Qed.

Lemma near a m x : Rabs (x - a) <= m -> exists t, -1 <= t <= 1 /\ x = a + m * t.
Proof.
  intro H. apply Rabs_le_inv in H.
  destruct (between (a - m) (a + m) x) as (t & T & E); [nra | ].
  exists t. split; [exact T | lra].
Qed.

(** ** Signs: the program

    What follows is a program and its proof; what is used of it are the tactics at the end of this file. *)
Module Signs.

(** *** Polynomials

    A number, or p + x q, where x is the first of the variables and does not occur in p. *)
Inductive poly :=
  | Const (z : Z)
  | Grow (p q : poly).

Fixpoint value (env : list R) (p : poly) : R :=
  match p with
  | Const z => IZR z
  | Grow p q => value (tl env) p + hd 0 env * value env q
  end.

(** A number is always written as a number. *)
Definition grow (p q : poly) : poly :=
  match p, q with
  | Const z, Const 0 => Const z
  | _, _ => Grow p q
  end.

Fixpoint variable (n : nat) : poly :=
  match n with
  | O => Grow (Const 0) (Const 1)
  | S n => Grow (variable n) (Const 0)
  end.

Fixpoint add_number (z : Z) (p : poly) : poly :=
  match p with
  | Const y => Const (z + y)
  | Grow p q => Grow (add_number z p) q
  end.

Fixpoint add (p q : poly) : poly :=
  match p, q with
  | Const z, _ => add_number z q
  | _, Const z => add_number z p
  | Grow a b, Grow c d => grow (add a c) (add b d)
  end.

Fixpoint times (z : Z) (p : poly) : poly :=
  match p with
  | Const y => Const (z * y)
  | Grow p q => Grow (times z p) (times z q)
  end.

Definition scale (z : Z) (p : poly) : poly :=
  match z with
  | 0%Z => Const 0
  | _ => times z p
  end.

(** [f] at the coefficient of each power of the first variable. *)
Fixpoint each (f : poly -> poly) (q : poly) : poly :=
  match q with
  | Const z => grow (f (Const z)) (Const 0)
  | Grow c d => grow (f c) (each f d)
  end.

Fixpoint mul (p q : poly) : poly :=
  match p, q with
  | Const z, _ => scale z q
  | _, Const z => scale z p
  | Grow a b, Grow c d => grow (mul a c) (add (each (mul a) d) (mul b q))
  end.

Fixpoint same (p q : poly) : bool :=
  match p, q with
  | Const y, Const z => Z.eqb y z
  | Grow a b, Grow c d => same a c && same b d
  | _, _ => false
  end.

Lemma value_grow p q env : value env (grow p q) = value (tl env) p + hd 0 env * value env q.
Proof. destruct p, q as [[ | | ] | ]; simpl; ring. Qed.

Lemma value_variable n env : value env (variable n) = nth n env 0.
Proof.
  revert env; induction n as [ | n I]; intros [ | x env]; simpl; rewrite ?I; simpl; try ring.
  destruct n; ring.
Qed.

Lemma value_add_number z p env : value env (add_number z p) = IZR z + value env p.
Proof.
  revert env; induction p as [y | p I q _]; intro env; simpl.
  - apply plus_IZR.
  - rewrite I. ring.
Qed.

Lemma value_add p q env : value env (add p q) = value env p + value env q.
Proof.
  revert q env; induction p as [z | a I b J]; intros [y | c d] env; cbn [add];
    rewrite ?value_grow, ?value_add_number, ?I, ?J; simpl; ring.
Qed.

Lemma value_times z p env : value env (times z p) = IZR z * value env p.
Proof.
  revert env; induction p as [y | p I q J]; intro env; simpl.
  - apply mult_IZR.
  - rewrite I, J. ring.
Qed.

Lemma value_scale z p env : value env (scale z p) = IZR z * value env p.
Proof. destruct z; cbn [scale]; rewrite ?value_times; simpl; ring. Qed.

Lemma value_each f y q env :
  (forall c, value (tl env) (f c) = y * value (tl env) c) -> value env (each f q) = y * value env q.
Proof.
  intro F. induction q as [z | c _ d I]; cbn [each]; rewrite value_grow, F, ?I; simpl; ring.
Qed.

Lemma value_mul p q env : value env (mul p q) = value env p * value env q.
Proof.
  revert q env; induction p as [z | a I b J]; intros [y | c d] env; cbn [mul]; rewrite ?value_scale;
    [simpl; ring | simpl; ring | simpl; ring | ].
  rewrite value_grow, value_add, I, J, (value_each _ (value (tl env) a)) by (intro; apply I).
  simpl. ring.
Qed.

Lemma same_value p q env : same p q = true -> value env p = value env q.
Proof.
  revert q env; induction p as [y | a I b J]; intros [z | c d] env; simpl; try discriminate.
  - intros ->%Z.eqb_eq. reflexivity.
  - intros [A B]%andb_prop. rewrite (I c), (J d); auto.
Qed.

(** *** Signs of polynomials

    The variables come in two parts: first those of known sign, or of which nothing is known; then the
    units, which lie between -1 and 1. For each monomial in the first ones stands a polynomial in the
    units. If all of these are at least 0, and their monomials are, the whole is. *)
Inductive kind := Positive | NonNegative | Free.
Inductive sign := Above | AtLeast | Unknown.

Definition of_kind (k : kind) (x : R) : Prop :=
  match k with
  | Positive => 0 < x
  | NonNegative => 0 <= x
  | Free => True
  end.

Definition of_sign (s : sign) (x : R) : Prop :=
  match s with
  | Above => 0 < x
  | AtLeast => 0 <= x
  | Unknown => True
  end.

Fixpoint units (env : list R) : Prop :=
  match env with
  | [] => True
  | e :: env => -1 <= e <= 1 /\ units env
  end.

Fixpoint fits (kinds : list kind) (env : list R) : Prop :=
  match kinds with
  | [] => units env
  | k :: kinds => of_kind k (hd 0 env) /\ fits kinds (tl env)
  end.

(** Of a polynomial in units: no value is greater in size. *)
Fixpoint size (p : poly) : Z :=
  match p with
  | Const z => Z.abs z
  | Grow p q => size p + size q
  end.

(** No value is less. *)
Fixpoint least_by_size (p : poly) : Z :=
  match p with
  | Const z => z
  | Grow p q => least_by_size p - size q
  end.

(** The same, sharper where it must be. In p + e (q + e r), what is of degree one in e is least at one of
    the ends of e, and e^2 lies between 0 and 1. No more than [n] units are tried. *)
Fixpoint least (n : nat) (p : poly) : Z :=
  let z := least_by_size p in
  match n with
  | O => z
  | S n =>
      if (0 <? z)%Z then z else
      match p with
      | Const z => z
      | Grow p (Const z) => least n p - Z.abs z
      | Grow p (Grow q r) =>
          Z.min (least n (add p q)) (least n (add p (times (-1) q))) + Z.min 0 (least n r)
      end
  end.

Definition sign_of_number (z : Z) : sign :=
  match z with
  | Zpos _ => Above
  | Z0 => AtLeast
  | Zneg _ => Unknown
  end.

(** Of a sum, and of a product with what is not negative. *)
Definition both (s t : sign) : sign :=
  match s, t with
  | Unknown, _ | _, Unknown => Unknown
  | AtLeast, AtLeast => AtLeast
  | _, _ => Above
  end.

Definition weak (s : sign) : sign :=
  match s with
  | Above => AtLeast
  | _ => s
  end.

Fixpoint sign_of (kinds : list kind) (p : poly) : sign :=
  match kinds, p with
  | _, Const z => sign_of_number z
  | [], _ => sign_of_number (least 24 p)
  | Positive :: others, Grow p q => both (sign_of others p) (sign_of kinds q)
  | NonNegative :: others, Grow p q => both (sign_of others p) (weak (sign_of kinds q))
  | Free :: others, Grow p (Const 0) => sign_of others p
  | Free :: others, Grow p (Grow (Const 0) q) => both (sign_of others p) (weak (sign_of kinds q))
  | Free :: _, Grow _ _ => Unknown
  end.

Lemma units_tl env : units env -> units (tl env) /\ -1 <= hd 0 env <= 1.
Proof. destruct env as [ | e env]; simpl; [lra | tauto]. Qed.

Lemma value_size p env : units env -> - IZR (size p) <= value env p <= IZR (size p).
Proof.
  revert env; induction p as [z | p I q J]; intros env U; simpl.
  - rewrite abs_IZR. unfold Rabs. destruct (Rcase_abs (IZR z)); lra.
  - destruct (units_tl env U) as [T B]. rewrite plus_IZR.
    specialize (I _ T). specialize (J _ U). nra.
Qed.

Lemma value_least_from z p q env :
  units env -> IZR z <= value (tl env) p -> IZR (z - size q) <= value env (Grow p q).
Proof.
  intros U L. destruct (units_tl env U) as [_ B]. pose proof (value_size q env U).
  rewrite minus_IZR. cbn [value]. nra.
Qed.

Lemma value_least_by_size p env : units env -> IZR (least_by_size p) <= value env p.
Proof.
  revert env; induction p as [z | p I q _]; intros env U; [apply Rle_refl | ].
  apply value_least_from, I, units_tl; exact U.
Qed.

(** What is of degree two or less. *)
Lemma least_at_ends (e p q r : R) (x y z : Z) :
  -1 <= e <= 1 -> IZR x <= p + q -> IZR y <= p + -1 * q -> IZR z <= r ->
  IZR (Z.min x y + Z.min 0 z) <= p + e * (q + e * r).
Proof.
  intros B X Y L. rewrite plus_IZR.
  assert (IZR (Z.min x y) <= p + e * q).
  { destruct (Z.min_spec x y) as [[M ->] | [M ->]]; [apply IZR_lt in M | apply IZR_le in M]; nra. }
  assert (IZR (Z.min 0 z) <= e * e * r).
  { assert (0 <= e * e <= 1) by nra.
    destruct (Z.min_spec 0 z) as [[M ->] | [M ->]]; [apply IZR_lt in M | apply IZR_le in M]; nra. }
  lra.
Qed.

Lemma value_least n p env : units env -> IZR (least n p) <= value env p.
Proof.
  revert p env; induction n as [ | n I]; intros p env U; pose proof (value_least_by_size p env U) as S;
    cbn [least]; [exact S | destruct (0 <? least_by_size p)%Z; [exact S | clear S]].
  destruct p as [z | p [z | q r]]; [apply Rle_refl | |]; pose proof (units_tl env U) as [T B].
  - apply (value_least_from _ p (Const z) env U), I, T.
  - apply least_at_ends; [exact B | | | apply I, U].
    + rewrite <- value_add. apply I, T.
    + rewrite <- value_times, <- value_add. apply I, T.
Qed.

Lemma of_number z x : IZR z <= x -> of_sign (sign_of_number z) x.
Proof.
  destruct z as [ | z | z]; simpl; intro L; [exact L | | exact I].
  apply Rlt_le_trans with (2 := L). apply (IZR_lt 0). reflexivity.
Qed.

Lemma of_both s t x y : of_sign s x -> of_sign t y -> of_sign (both s t) (x + y).
Proof. destruct s, t; simpl; lra. Qed.

Lemma of_weak s x y : of_sign s x -> 0 <= y -> of_sign (weak s) (y * x).
Proof. destruct s; simpl; intros; try exact I; apply Rmult_le_pos; lra. Qed.

Lemma of_positive s x y : of_sign s x -> 0 < y -> of_sign s (y * x).
Proof. destruct s; simpl; intros; try exact I; [apply Rmult_lt_0_compat | apply Rmult_le_pos]; lra. Qed.

Lemma of_poly kinds p env : fits kinds env -> of_sign (sign_of kinds p) (value env p).
Proof.
  revert kinds p env; fix right 2; intros kinds [z | p q] env F.
  - destruct kinds as [ | [ | | ] others]; apply of_number, Rle_refl.
  - destruct kinds as [ | k others]; [apply of_number, (value_least 24 (Grow p q)), F | ].
    pose proof F as [K T]. pose proof (right others p _ T) as P.
    pose proof (right (k :: others) q _ F) as Q.
    destruct k; cbn [sign_of value].
    + apply of_both, of_positive; assumption.
    + apply of_both, of_weak; assumption.
    + destruct q as [[ | | ] | [[ | | ] | ] q]; try exact I.
      * simpl. rewrite Rmult_0_r, Rplus_0_r. exact P.
      * apply of_both; [exact P | ]. cbn [value].
        replace (_ * _) with (hd 0 env * hd 0 env * value env q) by ring.
        apply of_weak; [apply (right (Free :: others)), F | apply Rle_0_sqr].
Qed.

(** *** Quotients

    Products over products, none of whose divisors is 0. Products are lists of factors, so that two
    quotients are seen to have some in common: this keeps polynomials small. *)
Record quotient := over { top : list poly; bottom : list poly }.

Definition product (env : list R) (l : list poly) : R := fold_right (fun p x => value env p * x) 1 l.
Definition expand (l : list poly) : poly := fold_right mul (Const 1) l.

(** A list without one [p], if there is any. *)
Fixpoint without (p : poly) (l : list poly) : option (list poly) :=
  match l with
  | [] => None
  | q :: l => if same p q then Some l else option_map (cons q) (without p l)
  end.

(** What two lists have in common, and what else is in each. *)
Fixpoint shared (l m : list poly) : list poly * list poly * list poly :=
  match l with
  | [] => ([], [], m)
  | p :: l =>
      match without p m with
      | Some m => let '(c, l, m) := shared l m in (p :: c, l, m)
      | None => let '(c, l, m) := shared l m in (c, p :: l, m)
      end
  end.

Definition opposite (a : quotient) : quotient := over (Const (-1) :: top a) (bottom a).

Definition sum (a b : quotient) : quotient :=
  let '(c, l, m) := shared (top a) (top b) in
  let '(d, x, y) := shared (bottom a) (bottom b) in
  over (add (expand (y ++ l)) (expand (x ++ m)) :: c) (d ++ x ++ y).

Definition prod (a b : quotient) : quotient :=
  let '(_, l, x) := shared (top a) (bottom b) in
  let '(_, m, y) := shared (top b) (bottom a) in
  over (l ++ m) (y ++ x).

Fixpoint power (a : quotient) (n : nat) : quotient :=
  match n with
  | O => over [] []
  | S n => prod a (power a n)
  end.

(** Is it positive, or is it negative? *)
Definition strict (kinds : list kind) (p : poly) : option bool :=
  match sign_of kinds p with
  | Above => Some true
  | _ => match sign_of kinds (times (-1) p) with Above => Some false | _ => None end
  end.

Definition inverse (kinds : list kind) (a : quotient) : option quotient :=
  if forallb (fun p => if strict kinds p then true else false) (top a)
  then Some (over (bottom a) (top a)) else None.

(** A polynomial of the same sign as a product: factors of known sign are left out but for that sign. *)
Fixpoint signed (kinds : list kind) (l : list poly) : poly :=
  match l with
  | [] => Const 1
  | p :: l =>
      match strict kinds p with
      | Some true => signed kinds l
      | Some false => times (-1) (signed kinds l)
      | None => mul p (signed kinds l)
      end
  end.

(** *** Formulas *)
Inductive formula :=
  | Literal (z : Z)
  | Symbol (n : nat)
  | Sum (a b : formula)
  | Product (a b : formula)
  | Opposite (a : formula)
  | Inverse (a : formula)
  | Power (a : formula) (n : nat).

Fixpoint meaning (env : list R) (f : formula) : R :=
  match f with
  | Literal z => IZR z
  | Symbol n => nth n env 0
  | Sum a b => meaning env a + meaning env b
  | Product a b => meaning env a * meaning env b
  | Opposite a => - meaning env a
  | Inverse a => / meaning env a
  | Power a n => meaning env a ^ n
  end.

Definition with_two (f : quotient -> quotient -> quotient) (a b : option quotient) : option quotient :=
  match a, b with
  | Some a, Some b => Some (f a b)
  | _, _ => None
  end.

(** A formula as a quotient, if all its divisors have signs. *)
Fixpoint quotient_of (kinds : list kind) (f : formula) : option quotient :=
  match f with
  | Literal z => Some (over [Const z] [])
  | Symbol n => Some (over [variable n] [])
  | Sum a b => with_two sum (quotient_of kinds a) (quotient_of kinds b)
  | Product a b => with_two prod (quotient_of kinds a) (quotient_of kinds b)
  | Opposite a => option_map opposite (quotient_of kinds a)
  | Inverse a => match quotient_of kinds a with Some a => inverse kinds a | None => None end
  | Power a n => option_map (fun a => power a n) (quotient_of kinds a)
  end.

Definition sign_of_formula (kinds : list kind) (f : formula) : sign :=
  match quotient_of kinds f with
  | Some a => sign_of kinds (signed kinds (bottom a ++ top a))
  | None => Unknown
  end.

Lemma product_app env l m : product env (l ++ m) = product env l * product env m.
Proof. induction l as [ | p l I]; simpl; rewrite ?I; ring. Qed.

Lemma value_expand env l : value env (expand l) = product env l.
Proof. induction l as [ | p l I]; simpl; rewrite ?value_mul, ?I; reflexivity. Qed.

Lemma product_without env p l m : without p l = Some m -> product env l = value env p * product env m.
Proof.
  revert m; induction l as [ | q l I]; simpl; intro m; [discriminate | ].
  destruct (same p q) eqn:S.
  - intros [= <-]. rewrite (same_value _ _ env S). reflexivity.
  - destruct (without p l) as [r | ]; simpl; [ | discriminate].
    intros [= <-]. simpl. rewrite (I r eq_refl). ring.
Qed.

Lemma product_shared env l m :
  let '(c, x, y) := shared l m in
  product env l = product env c * product env x /\ product env m = product env c * product env y.
Proof.
  revert m; induction l as [ | p l I]; intro m; simpl; [lra | ].
  destruct (without p m) as [r | ] eqn:W.
  - specialize (I r). destruct (shared l r) as [[c x] y]. simpl.
    rewrite (product_without env p m r W). destruct I as [-> ->]. split; ring.
  - specialize (I m). destruct (shared l m) as [[c x] y]. simpl. destruct I as [-> ->]. split; ring.
Qed.

Section Right.
Variables (kinds : list kind) (env : list R).
Variable fitting : fits kinds env.

Definition means (a : quotient) (x : R) : Prop :=
  product env (bottom a) <> 0 /\ product env (top a) / product env (bottom a) = x.

Ltac not_zero_by A B :=
  let E := fresh in
  intro E; first [apply A; rewrite E; ring | apply B; rewrite E; ring].

Lemma means_one p : means (over [p] []) (value env p).
Proof. split; simpl; [lra | field]. Qed.

Lemma means_opposite a x : means a x -> means (opposite a) (- x).
Proof. unfold means. intros [A <-]. simpl. split; [exact A | field; exact A]. Qed.

Lemma means_sum a b x y : means a x -> means b y -> means (sum a b) (x + y).
Proof.
  unfold means, sum. intros [A <-] [B <-].
  pose proof (product_shared env (top a) (top b)) as T.
  pose proof (product_shared env (bottom a) (bottom b)) as D.
  destruct (shared (top a) (top b)) as [[c l] m], (shared (bottom a) (bottom b)) as [[d p] q]. simpl.
  rewrite value_add, !value_expand, !product_app.
  destruct T as [-> ->], D as [D E]. rewrite D in *. rewrite E in *.
  split; [repeat apply Rmult_integral_contrapositive_currified | field; repeat split]; not_zero_by A B.
Qed.

Lemma means_prod a b x y : means a x -> means b y -> means (prod a b) (x * y).
Proof.
  unfold means, prod. intros [A <-] [B <-].
  pose proof (product_shared env (top a) (bottom b)) as T.
  pose proof (product_shared env (top b) (bottom a)) as D.
  destruct (shared (top a) (bottom b)) as [[c l] p], (shared (top b) (bottom a)) as [[d m] q]. simpl.
  rewrite !product_app. destruct T as [-> T], D as [-> D]. rewrite T, D in *.
  split; [apply Rmult_integral_contrapositive_currified | field; repeat split]; not_zero_by A B.
Qed.

Lemma means_power a x n : means a x -> means (power a n) (x ^ n).
Proof.
  intro A. induction n as [ | n I]; simpl; [split; simpl; [lra | field] | ].
  apply means_prod; assumption.
Qed.

Lemma of_strict p b : strict kinds p = Some b -> 0 < (if b then value env p else - value env p).
Proof.
  unfold strict. intro S. pose proof (of_poly kinds p env fitting) as P.
  pose proof (of_poly kinds (times (-1) p) env fitting) as Q. rewrite value_times in Q.
  destruct (sign_of kinds p), (sign_of kinds (times (-1) p)); inversion S; simpl in *; lra.
Qed.

Lemma means_inverse a b x : inverse kinds a = Some b -> means a x -> means b (/ x).
Proof.
  unfold inverse, means. destruct (forallb _ (top a)) eqn:N; [ | discriminate].
  assert (product env (top a) <> 0).
  { induction (top a) as [ | p l I]; simpl; [lra | ].
    apply andb_prop in N as [P N]. destruct (strict kinds p) as [b' | ] eqn:S; [ | discriminate].
    apply Rmult_integral_contrapositive_currified; [ | exact (I N)].
    pose proof (of_strict p b' S). destruct b'; lra. }
  intros [= <-] [A <-]. simpl. split; [assumption | field; auto].
Qed.

Lemma means_formula f a : quotient_of kinds f = Some a -> means a (meaning env f).
Proof.
  revert a; induction f as [z | n | f I g J | f I g J | f I | f I | f I n]; simpl; intros a E;
    try (destruct (quotient_of kinds f) as [b | ]; simpl in E; [specialize (I b eq_refl) | discriminate]);
    try (destruct (quotient_of kinds g) as [c | ]; simpl in E; [specialize (J c eq_refl) | discriminate]);
    try (injection E as <-).
  - apply (means_one (Const z)).
  - rewrite <- value_variable. apply means_one.
  - apply means_sum; assumption.
  - apply means_prod; assumption.
  - apply means_opposite; assumption.
  - apply (means_inverse b); assumption.
  - apply means_power; assumption.
Qed.

Lemma product_signed l : exists k, 0 < k /\ product env l = k * value env (signed kinds l).
Proof.
  induction l as [ | p l (k & K & I)]; cbn [product fold_right signed]; [exists 1; simpl; lra | ].
  change (fold_right _ 1 l) with (product env l). rewrite I.
  destruct (strict kinds p) as [b | ] eqn:S; [pose proof (of_strict p b S); destruct b | ].
  - exists (value env p * k). split; [apply Rmult_lt_0_compat; assumption | ring].
  - exists (- value env p * k). rewrite value_times. split; [apply Rmult_lt_0_compat; assumption | ring].
  - exists k. rewrite value_mul. split; [exact K | ring].
Qed.

Lemma of_formula f : of_sign (sign_of_formula kinds f) (meaning env f).
Proof.
  unfold sign_of_formula. destruct (quotient_of kinds f) as [a | ] eqn:Q; [ | exact I].
  destruct (means_formula f a Q) as [B <-].
  destruct (product_signed (bottom a ++ top a)) as (k & K & P). rewrite product_app in P.
  set (s := value env _) in P. set (b := product env (bottom a)) in *.
  replace (product env (top a) / b) with (k / (b * b) * s).
  - apply of_positive; [apply of_poly, fitting | ].
    apply Rdiv_lt_0_compat; [exact K | apply Rsqr_pos_lt, B].
  - transitivity (k * s / (b * b)); [field; exact B | ]. rewrite <- P. field. exact B.
Qed.

Lemma above f : sign_of_formula kinds f = Above -> 0 < meaning env f.
Proof. intro S. pose proof (of_formula f) as P. rewrite S in P. exact P. Qed.

Lemma at_least f : weak (sign_of_formula kinds f) = AtLeast -> 0 <= meaning env f.
Proof.
  intro S. pose proof (of_formula f) as P.
  destruct (sign_of_formula kinds f); simpl in *; [lra | exact P | discriminate].
Qed.
End Right.
End Signs.

(** ** Signs: the tactics

    The variables of a formula, before those in [l]: whatever is not computed from others. *)
Ltac variables x l :=
  let two a b := (let l := variables a l in variables b l) in
  let one x := lazymatch l with context [x :: _] => l | _ => constr:(x :: l) end in
  lazymatch x with
  | ?a + ?b => two a b
  | ?a - ?b => two a b
  | ?a * ?b => two a b
  | ?a / ?b => two a b
  | - ?a => variables a l
  | / ?a => variables a l
  | ?a ^ ?n => let known := isnatcst n in lazymatch known with true => variables a l | _ => one x end
  | IZR ?z => let known := isZcst z in lazymatch known with true => l | _ => one x end
  | _ => one x
  end.

(** First those of which no more is known than a sign, with what is known of them. *)
Ltac in_order l units :=
  lazymatch l with
  | [] => constr:((@nil Signs.kind, units))
  | ?x :: ?l =>
      let put k :=
        (let r := in_order l units in
         lazymatch r with (?kinds, ?env) => constr:((k :: kinds, x :: env)) end) in
      match goal with
      | _ : -1 <= x <= 1 |- _ => in_order l (x :: units)
      | _ : 0 < x |- _ => put Signs.Positive
      | _ : 0 <= x |- _ => put Signs.NonNegative
      | _ => put Signs.Free
      end
  end.

Ltac place x l :=
  lazymatch l with
  | x :: _ => constr:(O)
  | _ :: ?l => let n := place x l in constr:(S n)
  end.

(** A formula as the program reads it. *)
Ltac formula x l :=
  let two f a b := (let a := formula a l in let b := formula b l in constr:(f a b)) in
  let one f a := (let a := formula a l in constr:(f a)) in
  lazymatch l with
  | context [x :: _] => let n := place x l in constr:(Signs.Symbol n)
  | _ =>
      lazymatch x with
      | ?a + ?b => two Signs.Sum a b
      | ?a - ?b => formula (a + - b) l
      | ?a * ?b => two Signs.Product a b
      | ?a / ?b => formula (a * / b) l
      | - ?a => one Signs.Opposite a
      | / ?a => one Signs.Inverse a
      | ?a ^ ?n => let a := formula a l in constr:(Signs.Power a n)
      | IZR ?z => constr:(Signs.Literal z)
      end
  end.

Ltac by_program rule x :=
  let l := variables x (@nil R) in
  let r := in_order l (@nil R) in
  lazymatch r with
  | (?kinds, ?env) =>
      let f := formula x env in
      let fitting := fresh in
      assert (fitting : Signs.fits kinds env);
      [ cbn [Signs.fits Signs.units Signs.of_kind hd tl];
        repeat (apply conj; [first [exact I | assumption] | ]); exact I
      | exact (rule kinds env fitting f ltac:(vm_compute; reflexivity)) ]
  end.

(** A sign, from [0 < v], [0 <= v] or [-1 <= v <= 1] for each of the variables; or a comparison. *)
Ltac bounded :=
  lazymatch goal with
  | |- 0 < ?x => first [by_program Signs.above x | fail 1 "no sign"]
  | |- 0 <= ?x => first [by_program Signs.at_least x | fail 1 "no sign"]
  | |- _ < _ => apply Rminus_gt_0_lt; bounded
  | |- _ <= _ => apply Rminus_le_0; bounded
  end.

(** What has the same value for all values of the variables. *)
Ltac equal := apply Rle_antisym; bounded.

(** Each minimum is one of two, whichever is seen to be less. *)
Ltac minima :=
  repeat match goal with
  | |- context [Rmin ?a ?b] =>
      first [rewrite (Rmin_left a b) by bounded | rewrite (Rmin_right a b) by bounded]
  end.

(** ** Order

    Rounding keeps it, and so does each step; what is left is to compare what is no longer alike, and that
    a factor or divisor in common is not negative. *)
Lemma difference a b : a <= b -> 0 <= b - a.
Proof. lra. Qed.

Lemma quotient_le a b d : 0 < d -> a <= b -> a / d <= b / d.
Proof. intros. apply Rmult_le_compat_r; [ | assumption]. apply Rlt_le, Rinv_0_lt_compat. assumption. Qed.

Ltac step_in_order :=
  lazymatch goal with
  | |- ?a <= ?a => apply Rle_refl
  | |- fl _ _ _ <= fl _ _ _ => apply fl_le; [assumption | step_in_order]
  | |- ?a + _ <= ?a + _ => apply Rplus_le_compat_l; step_in_order
  | |- _ + ?a <= _ + ?a => apply Rplus_le_compat_r; step_in_order
  | |- _ + _ <= _ + _ => apply Rplus_le_compat; step_in_order
  | |- _ - _ <= _ - _ => apply Rplus_le_compat; [ | apply Ropp_le_contravar]; step_in_order
  | |- - _ <= - _ => apply Ropp_le_contravar; step_in_order
  | |- ?a * _ <= ?a * _ => apply Rmult_le_compat_l; [ | step_in_order]
  | |- _ * ?a <= _ * ?a => apply Rmult_le_compat_r; [ | step_in_order]
  | |- _ / ?a <= _ / ?a => apply quotient_le; [ | step_in_order]
  | |- _ => idtac
  end.

(** What remains: that a common factor is not negative, and what is no longer alike. *)
Lemma not_less a b : 0 <= b -> a <= a + b.
Proof. lra. Qed.

Lemma fl_not_negative prec choice x : (2 <= prec)%Z -> 0 <= x -> 0 <= fl prec choice x.
Proof.
  intros P X. pose proof (four_at_least prec _ P eq_refl) as N.
  destruct (model prec choice _ P eq_refl x) as (e & B & ->).
  apply Rdiv_le_0_compat; [apply Rmult_le_pos | ]; lra.
Qed.

Lemma fl_positive prec choice x : (2 <= prec)%Z -> 0 < x -> 0 < fl prec choice x.
Proof.
  intros P X. pose proof (four_at_least prec _ P eq_refl) as N.
  destruct (model prec choice _ P eq_refl x) as (e & B & ->).
  apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat | ]; lra.
Qed.

Ltac not_negative :=
  lazymatch goal with
  | |- ?a <= ?a + _ => apply not_less; not_negative
  | |- 0 <= fl _ _ _ => first [assumption | apply fl_not_negative; [assumption | not_negative]]
  | |- 0 < fl _ _ _ => apply fl_positive; [assumption | not_negative]
  | |- 0 <= _ * _ => apply Rmult_le_pos; not_negative
  | |- _ => first [positivity | lra]
  end.
Ltac by_order := apply difference; step_in_order; not_negative.

(** ** Units

    That of one rounding follows from those inside it. *)
Lemma fl_power prec choice k x :
  (exists a, k = bpow radix2 a) -> fl prec choice (k * x) = k * fl prec choice x.
Proof. intros [a ->]. apply fl_scale. Qed.

Lemma power_of_product x y :
  (exists a, x = bpow radix2 a) -> (exists a, y = bpow radix2 a) -> exists a, x * y = bpow radix2 a.
Proof. intros [a ->] [b ->]. exists (a + b)%Z. rewrite bpow_plus. reflexivity. Qed.

Lemma power_of_quotient x y :
  (exists a, x = bpow radix2 a) -> (exists a, y = bpow radix2 a) -> exists a, x / y = bpow radix2 a.
Proof.
  intros [a ->] [b ->]. exists (a - b)%Z. unfold Zminus. rewrite bpow_plus, bpow_opp. reflexivity.
Qed.

Lemma power_not_zero k : (exists a, k = bpow radix2 a) -> k <> 0.
Proof. intros [a ->]. apply Rgt_not_eq, bpow_gt_0. Qed.

(** Nothing but 0 is rounded to 0. *)
Lemma fl_not_zero prec choice x : (2 <= prec)%Z -> x <> 0 -> fl prec choice x <> 0.
Proof.
  intros P X. pose proof (four_at_least prec _ P eq_refl) as N.
  destruct (model prec choice _ P eq_refl x) as (e & B & ->).
  apply Rmult_integral_contrapositive_currified; [ | apply Rinv_neq_0_compat; lra].
  apply Rmult_integral_contrapositive_currified; [exact X | lra].
Qed.

Ltac power :=
  first
    [ eexists; eassumption
    | apply power_of_product; power
    | apply power_of_quotient; power
    | exists 0%Z; reflexivity ].
Ltac in_units k :=
  rewrite <- (fl_power _ _ k) by power;
  f_equal;
  repeat match goal with U : fl _ _ _ = _ * fl _ _ _ |- _ => rewrite U; clear U end;
  field; repeat split;
  first [apply power_not_zero; power | apply fl_not_zero; [assumption | lra]].
Ltac by_units :=
  match goal with U : ?x = _ |- ?x = _ => rewrite U; ring end.
