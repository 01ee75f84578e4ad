(** * Rounding to nearest: multiplication by 1 + e/(n + 1), where n = 2^prec and e is from -1 to 1. *)
From Coq Require Import ZArith Lia.
From Flocq Require Import Core Relative.
From LIBRARY Require Import A_Tactics.
Open Scope R_scope.

(** ** Rounding *)
(** To [prec] bits; [choice] says what becomes of a number half-way between two. *)
Definition fl (prec : Z) (choice : Z -> bool) (x : R) : R :=
  round radix2 (FLX_exp prec) (Znearest choice) x.

(** The relative error, as a part of the greatest one. *)
Definition error (prec : Z) (choice : Z -> bool) (n x : R) : R := (fl prec choice x - x) / x * (n + 1).

Section Rounding.
Variables (prec : Z) (choice : Z -> bool) (n : R).
Variable two_bits : (2 <= prec)%Z.
Variable power : n = bpow radix2 prec.

#[local] Instance some_bits : Prec_gt_0 prec.
Proof. unfold Prec_gt_0. lia. Qed.

Lemma minimum_precision : 0 <= n - 4.
Proof. apply Rge_le, Rge_minus, Rle_ge. rewrite power. change 4 with (bpow radix2 2). apply bpow_le, two_bits. Qed.

Lemma model x : fl prec choice x = x * (n + 1 + clamp (error prec choice n x)) / (n + 1).
Proof.
  pose proof minimum_precision as N. unfold error.
  destruct (relative_error_N_FLX'_ex radix2 prec some_bits choice x) as (d & B & E). fold (fl prec choice x) in E.
  replace (u_ro radix2 prec / (1 + u_ro radix2 prec)) with (/ (n + 1)) in B.
  - apply Rabs_le_inv in B. assert (/ (n + 1) * (n + 1) = 1) by (field; lra). rewrite E.
    destruct (Req_dec x 0) as [-> | X]; [field; lra | ].
    replace ((x * (1 + d) - x) / x * (n + 1)) with (d * (n + 1)) by (field; exact X).
    rewrite (proj2 (clamped _)); [field; lra | nra].
  - unfold u_ro. rewrite bpow_plus, bpow_opp, <- power. change (bpow radix2 1) with 2. field. lra.
Qed.

(** The unit does not matter, if it is a power of 2. *)
Lemma fl_scale a x : fl prec choice (bpow radix2 a * x) = bpow radix2 a * fl prec choice x.
Proof.
  destruct (Req_dec x 0) as [-> | X].
  - unfold fl. rewrite Rmult_0_r, round_0 by typeclasses eauto. ring.
  - unfold fl, round, scaled_mantissa, F2R, cexp, FLX_exp; cbn [Fnum Fexp].
    rewrite (Rmult_comm _ x), mag_mult_bpow, Rmult_assoc, <- bpow_plus by exact X.
    replace (a + - _)%Z with (- (mag radix2 x - prec))%Z by lia.
    replace (mag radix2 x + a - prec)%Z with (a + (mag radix2 x - prec))%Z by lia. rewrite bpow_plus. ring.
Qed.
End Rounding.

(** Rounding keeps the order. *)
Lemma ordered prec choice (P : (2 <= prec)%Z) a b : 0 <= a - b -> 0 <= fl prec choice a - fl prec choice b.
Proof. intro L. pose proof (some_bits prec P). apply Rge_le, Rge_minus, Rle_ge, round_le; try typeclasses eauto. lra. Qed.

(** ** Units *)
Lemma bpow_power a : bpow radix2 a = powerRZ 2 a.
Proof. exact (bpow_powerRZ radix2 a). Qed.

Lemma power_of_product x y : is_power x -> is_power y -> is_power (x * y).
Proof. intros [a ->] [b ->]. exists (a + b)%Z. rewrite <- !bpow_power, bpow_plus. reflexivity. Qed.

Lemma power_of_quotient x y : is_power x -> is_power y -> is_power (x / y).
Proof. intros [a ->] [b ->]. exists (a - b)%Z. unfold Zminus. rewrite <- !bpow_power, bpow_plus, bpow_opp. reflexivity. Qed.

(** The error of one rounding is that of another, if the formulas differ by a power of two. *)
Lemma same_error prec choice n k l x y :
  (2 <= prec)%Z -> n = bpow radix2 prec -> is_power k -> is_power l ->
  k * x - l * y = 0 -> fl prec choice x = x * (n + 1 + clamp (error prec choice n y)) / (n + 1).
Proof.
  intros P N K L E. destruct (power_of_quotient l k L K) as [e Q].
  assert (k <> 0) as D by (apply Rgt_not_eq, power_positive, K).
  assert (x = l / k * y) as X by (apply (Rmult_eq_reg_l k); [field_simplify; lra | exact D]).
  rewrite X at 1. rewrite Q, <- bpow_power, fl_scale, bpow_power, <- Q, (model _ _ n P N), X. unfold Rdiv. ring.
Qed.

Ltac power_of_two :=
  first
    [ assumption
    | apply power_of_product; power_of_two | exists 0%Z; reflexivity ].

Ltac A_Tactics.rounding ::=
  lazymatch goal with
  | _ : (2 <= ?prec)%Z, choice : Z -> bool |- _ => constr:(fl prec choice)
  end.
