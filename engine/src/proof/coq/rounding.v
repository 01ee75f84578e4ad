(** * Rounding to nearest, and the signs of formulas in which each rounding has an unknown of its own.

    Without under- and overflow, to round to [prec] bits is to multiply by 1 + e/(n + 1), where n = 2^prec
    and e is some number from -1 to 1. What is said of computed values is then said of quotients of
    polynomials, whose signs a program decides. *)
From Coq Require Import ZArith Lia.
From Flocq Require Import Core Relative.
From LIBRARY Require Import A_Tactics.
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

(** ** Signs of what is rounded: those that it had *)
Lemma fl_by_factor prec choice x : (2 <= prec)%Z -> exists k, 0 < k /\ fl prec choice x = x * k.
Proof.
  intro P. pose proof (four_at_least prec _ P eq_refl) as N.
  destruct (model prec choice _ P eq_refl x) as (e & B & ->).
  exists ((bpow radix2 prec + 1 + e) / (bpow radix2 prec + 1)).
  split; [apply Rdiv_lt_0_compat; lra | field; lra].
Qed.

Lemma fl_not_zero prec choice x : (2 <= prec)%Z -> x <> 0 -> fl prec choice x <> 0.
Proof.
  intros P X. destruct (fl_by_factor prec choice x P) as (k & K & ->).
  apply Rmult_integral_contrapositive_currified; lra.
Qed.

(** ** Order

    Rounding keeps it, and so does each step; what is left is to compare what is no longer alike, and that
    a factor or divisor in common is not negative. *)
Lemma difference a b : a <= b -> 0 <= b - a.
Proof. lra. Qed.

Lemma quotient_le a b d : 0 < d -> a <= b -> a / d <= b / d.
Proof. intros. apply Rmult_le_compat_r; [ | assumption]. apply Rlt_le, Rinv_0_lt_compat. assumption. Qed.

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

Ltac power_of_two :=
  first
    [ eexists; eassumption
    | apply power_of_product; power_of_two
    | apply power_of_quotient; power_of_two
    | exists 0%Z; reflexivity ].
Ltac in_units k :=
  rewrite <- (fl_power _ _ k) by power_of_two;
  f_equal;
  repeat match goal with U : fl _ _ _ = _ * fl _ _ _ |- _ => rewrite U; clear U end;
  field; repeat split;
  first [apply power_not_zero; power_of_two | lra | apply fl_not_zero; [assumption | not_zero] | not_zero].
Ltac by_units :=
  match goal with U : ?x = _ |- ?x = _ => rewrite U; ring end.
