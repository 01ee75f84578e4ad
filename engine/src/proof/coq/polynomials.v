(** * Polynomials with whole coefficients, and their signs: a program, and its proof.

    Whatever claims say of signs and equalities is decided by it; see [A_Tactics]. *)
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
Inductive sign := Positive | NonNegative | Unknown.

Definition of_sign (s : sign) (x : R) : Prop :=
  match s with
  | Positive => 0 < x
  | NonNegative => 0 <= x
  | Unknown => True
  end.

Fixpoint units (env : list R) : Prop :=
  match env with
  | [] => True
  | e :: env => -1 <= e <= 1 /\ units env
  end.

Fixpoint fits (signs : list sign) (env : list R) : Prop :=
  match signs with
  | [] => units env
  | k :: signs => of_sign k (hd 0 env) /\ fits signs (tl env)
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
    the ends of e, and e^2 lies between 0 and 1. If there is no higher power, Bernstein's form is tried as
    well. No more than [n] units are tried. *)
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
          let z := (Z.min (least n (add p q)) (least n (add p (times (-1) q))) + Z.min 0 (least n r))%Z in
          match r with
          | Grow _ (Grow _ _) | Grow _ (Const (Zpos _ | Zneg _)) => z
          | Const _ | Grow _ (Const 0) =>
              let r := match r with Grow r _ => r | r => r end in
              let ends := Z.min (least n (add (add p r) q)) (least n (add (add p r) (times (-1) q))) in
              if (0 <? z)%Z then z else Z.max z (Z.min ends (least n (add p (times (-1) r))))
          end
      end
  end.

Definition sign_of_number (z : Z) : sign :=
  match z with
  | Zpos _ => Positive
  | Z0 => NonNegative
  | Zneg _ => Unknown
  end.

(** Of a sum, and of a product with what is not negative. *)
Definition both (s t : sign) : sign :=
  match s, t with
  | Unknown, _ | _, Unknown => Unknown
  | NonNegative, NonNegative => NonNegative
  | _, _ => Positive
  end.

Definition weak (s : sign) : sign :=
  match s with
  | Positive => NonNegative
  | _ => s
  end.

Fixpoint sign_of_terms (signs : list sign) (p : poly) : sign :=
  match signs, p with
  | _, Const z => sign_of_number z
  | [], _ => sign_of_number (least 24 p)
  | Positive :: others, Grow p q => both (sign_of_terms others p) (sign_of_terms signs q)
  | NonNegative :: others, Grow p q => both (sign_of_terms others p) (weak (sign_of_terms signs q))
  | Unknown :: others, Grow p (Const 0) => sign_of_terms others p
  | Unknown :: others, Grow p (Grow (Const 0) q) =>
      both (sign_of_terms others p) (weak (sign_of_terms signs q))
  | Unknown :: _, Grow _ _ => Unknown
  end.

(** With a number for the n-th variable. *)
Fixpoint put (n : nat) (z : Z) (p : poly) : poly :=
  match n, p with
  | _, Const y => Const y
  | O, Grow p q => add (grow p (Const 0)) (scale z (put O z q))
  | S n, Grow p q => grow (put n z p) (put (S n) z q)
  end.

(** If twice a polynomial is p + x (q + x r), and 4 r p - q^2 is at least 0, then so is it if r > 0: for 4 r
    times that is (2 r x + q)^2 more than this. If r = 0, then q = 0, and the sign is that of p. *)
Definition sign_of_square (signs : list sign) (a : poly) (n : nat) : sign :=
  let x := variable n in
  let p := times 2 (put n 0 a) in
  let q := add (put n 1 a) (times (-1) (put n (-1) a)) in
  let r := add (add (put n 1 a) (put n (-1) a)) (times (-1) p) in
  if same (times 2 a) (add p (mul x (add q (mul x r)))) then
    match sign_of_terms signs r, sign_of_terms signs p with
    | Unknown, _ | NonNegative, Unknown => Unknown
    | _, _ => sign_of_terms signs (add (times 4 (mul r p)) (times (-1) (mul q q)))
    end
  else Unknown.

Fixpoint sign_of_squares (signs : list sign) (a : poly) (n : nat) : sign :=
  match n with
  | O => Unknown
  | S n =>
      match sign_of_square signs a n with
      | Unknown => sign_of_squares signs a n
      | s => s
      end
  end.

(** By its terms, or else as a square in one of the variables, of the units in one of the first twelve. *)
Definition sign_of (signs : list sign) (p : poly) : sign :=
  match sign_of_terms signs p with
  | Unknown => sign_of_squares signs p (12 + length signs)
  | s => s
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

(** Bernstein's form of degree two. *)
Lemma least_of_square (e p q r : R) (x y z : Z) :
  -1 <= e <= 1 -> IZR x <= p + r + q -> IZR y <= p + r + -1 * q -> IZR z <= p + -1 * r ->
  IZR (Z.min (Z.min x y) z) <= p + e * (q + e * r).
Proof.
  intros B X Y L. set (m := Z.min (Z.min x y) z).
  assert (IZR m <= p + r + q) by (apply Rle_trans with (2 := X), IZR_le; unfold m; lia).
  assert (IZR m <= p + r + -1 * q) by (apply Rle_trans with (2 := Y), IZR_le; unfold m; lia).
  assert (IZR m <= p + -1 * r) by (apply Rle_trans with (2 := L), IZR_le; unfold m; lia).
  assert (0 <= (1 + e) * (1 + e)) by apply Rle_0_sqr.
  assert (0 <= (1 - e) * (1 - e)) by apply Rle_0_sqr.
  assert (0 <= (1 + e) * (1 - e)) by nra.
  nra.
Qed.

Lemma value_least n p env : units env -> IZR (least n p) <= value env p.
Proof.
  revert p env; induction n as [ | n I]; intros p env U; pose proof (value_least_by_size p env U) as S;
    cbn [least]; [exact S | destruct (0 <? least_by_size p)%Z; [exact S | clear S]].
  destruct p as [z | p [z | q r]]; [apply Rle_refl | |]; pose proof (units_tl env U) as [T B].
  - apply (value_least_from _ p (Const z) env U), I, T.
  - cbv zeta. set (z := (Z.min (least n (add p q)) _ + _)%Z).
    assert (A : IZR z <= value env (Grow p (Grow q r))).
    { apply least_at_ends; [exact B | | | apply I, U].
      + rewrite <- value_add. apply I, T.
      + rewrite <- value_times, <- value_add. apply I, T. }
    assert (forall r', value env r = value (tl env) r' ->
      IZR (Z.min (Z.min (least n (add (add p r') q)) (least n (add (add p r') (times (-1) q))))
        (least n (add p (times (-1) r')))) <= value env (Grow p (Grow q r))) as C.
    { intros r' E. cbn [value]. rewrite E. apply least_of_square; [exact B | | |];
        rewrite <- ?value_times, <- ?value_add; apply I, T. }
    destruct r as [y | r [[ | y | y] | ? ?]]; try exact A;
      (destruct (0 <? z)%Z; [exact A | ]); unfold Z.max; destruct (z ?= _)%Z; try exact A; apply C;
      cbn [value]; ring.
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

Lemma complete_square s (p q r x : R) :
  0 < r \/ 0 = r /\ 0 <= p -> of_sign s (4 * (r * p) + -1 * (q * q)) -> of_sign s (p + x * (q + x * r)).
Proof.
  intros [R | [<- P]] D.
  - replace (p + _) with (/ (4 * r) * (4 * (r * p) + -1 * (q * q) + Rsqr (2 * r * x + q)))
      by (unfold Rsqr; field; lra).
    apply of_positive; [ | apply Rinv_0_lt_compat; lra].
    pose proof (Rle_0_sqr (2 * r * x + q)). destruct s; simpl in *; lra.
  - pose proof (Rle_0_sqr q) as Q. unfold Rsqr in Q. destruct s; simpl in *; try exact I; [lra | ].
    replace q with 0 by (symmetry; apply Rsqr_0_uniq; unfold Rsqr; lra). lra.
Qed.

Lemma of_terms signs p env : fits signs env -> of_sign (sign_of_terms signs p) (value env p).
Proof.
  revert signs p env; fix right 2; intros signs [z | p q] env F.
  - destruct signs as [ | [ | | ] others]; apply of_number, Rle_refl.
  - destruct signs as [ | k others]; [apply of_number, (value_least 24 (Grow p q)), F | ].
    pose proof F as [K T]. pose proof (right others p _ T) as P.
    pose proof (right (k :: others) q _ F) as Q.
    destruct k; cbn [sign_of_terms value].
    + apply of_both, of_positive; assumption.
    + apply of_both, of_weak; assumption.
    + destruct q as [[ | | ] | [[ | | ] | ] q]; try exact I.
      * simpl. rewrite Rmult_0_r, Rplus_0_r. exact P.
      * apply of_both; [exact P | ]. cbn [value].
        replace (_ * _) with (hd 0 env * hd 0 env * value env q) by ring.
        apply of_weak; [apply (right (Unknown :: others)), F | apply Rle_0_sqr].
Qed.

Lemma of_poly signs p env : fits signs env -> of_sign (sign_of signs p) (value env p).
Proof.
  intro F. unfold sign_of. pose proof (of_terms signs p env F) as T.
  destruct (sign_of_terms signs p); [exact T | exact T | clear T].
  induction (12 + length signs)%nat as [ | n I]; [exact Logic.I | ]. cbn [sign_of_squares].
  enough (of_sign (sign_of_square signs p n) (value env p))
    by (destruct (sign_of_square signs p n); assumption).
  unfold sign_of_square. destruct (same _ _) eqn:E; [ | exact Logic.I].
  apply (same_value _ _ env) in E. rewrite value_times, value_add, value_mul, value_add, value_mul in E.
  set (a := times 2 _) in *. set (q := add _ (times _ (put _ _ _))) in *. set (r := add (add _ _) _) in *.
  pose proof (of_terms signs a env F) as A. pose proof (of_terms signs r env F) as R.
  pose proof (of_terms signs (add (times 4 (mul r a)) (times (-1) (mul q q))) env F) as D.
  rewrite value_add, !value_times, !value_mul in D.
  replace (value env p) with (/ 2 * (2 * value env p)) by field. rewrite E.
  apply of_positive; [ | lra].
  destruct (sign_of_terms signs r), (sign_of_terms signs a); try exact Logic.I;
    (apply complete_square; [ | exact D]); simpl in *; lra.
Qed.
