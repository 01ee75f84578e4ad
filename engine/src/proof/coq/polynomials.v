(** * Polynomials with whole coefficients, and their signs: a program, and its proof.

    What is said of computed values is a quotient of polynomials, too large for [positivity]. *)
From Coq Require Import List Bool ZArith Reals Lra Lia.
Import ListNotations.
Open Scope R_scope.

(** ** Polynomials

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

(** ** Signs of polynomials

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
