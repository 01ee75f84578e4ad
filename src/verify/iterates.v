(** * Theorem 1.3.3, of the iterates themselves.

    The claims speak of the powers of the contraction factor, since numbers can check them there. Here they
    are joined with (1.16): [eq_1_16_closed_form_iterates] is the recursion as the chapter states it, from
    any first multiplier, and everything below speaks of what comes out of it. *)

Section Iterates.

Variables c m g l h eps lambda : R.

Let iterates := eq_1_16_closed_form_iterates c m g l h eps lambda.
Let multiplier k := fst (iterates k).
Let deflection k := snd (iterates k).
Let p k := contact_penetration l h (deflection k).

(** One step, wherever it is defined. *)
Lemma iterates_contract : c + eps <> 0 -> forall k, p (S k) = augmented_contraction c eps * p k.
Proof.
  intros N k. unfold p, deflection, iterates.
  destruct k; cbn [eq_1_16_closed_form_iterates snd];
    [ | destruct (eq_1_16_closed_form_iterates c m g l h eps lambda k); cbn [snd] ];
    functions; field; exact N.
Qed.

Lemma iterates_penetrate :
  c + eps <> 0 ->
  forall k, p k = augmented_penetration_after c m g l h eps lambda (augmented_contraction c eps ^ k).
Proof.
  intros N k. induction k as [ | k I].
  - unfold p, deflection, iterates. cbn. functions. field. exact N.
  - rewrite (iterates_contract N), I. cbn [pow]. functions. field. exact N.
Qed.

(** The theorem: the penetration of the iterates tends to 0, which is (1.17) ... *)
Theorem theorem_1_3_3 : 0 < c -> 0 < eps -> is_lim_seq p 0.
Proof.
  intros C E. apply is_lim_seq_ext with (2 := theorem_1_3_3_contracts c m g l h eps lambda C E).
  intro k. symmetry. apply iterates_penetrate. lra.
Qed.

(** ... so the deflection tends to the gap, and the multiplier to the reaction, *)
Theorem theorem_1_3_3_deflection : 0 < c -> 0 < eps -> is_lim_seq deflection (system_gap l h).
Proof.
  intros C E. apply is_lim_seq_ext with (fun k => p k + system_gap l h).
  { intro k. unfold p. functions. ring. }
  replace (Finite (system_gap l h)) with (Finite (0 + system_gap l h)) by (f_equal; ring).
  apply is_lim_seq_plus'; [apply theorem_1_3_3; assumption | apply is_lim_seq_const].
Qed.

Theorem theorem_1_3_3_multiplier :
  0 < c -> 0 < eps -> is_lim_seq multiplier (system_reaction c m g l h).
Proof.
  intros C E.
  apply is_lim_seq_ext with (fun k => system_reaction c m g l h + - (c + eps) * p k).
  { intro k. rewrite iterates_penetrate by lra. unfold multiplier, iterates.
    rewrite (eq_1_16_closed_form c m g l h eps lambda C E k). cbn [fst]. functions. field. lra. }
  replace (Finite (system_reaction c m g l h))
    with (Finite (system_reaction c m g l h + - (c + eps) * 0)) by (f_equal; ring).
  apply is_lim_seq_plus'; [apply is_lim_seq_const | ].
  apply (is_lim_seq_scal_l p (- (c + eps)) 0), theorem_1_3_3; assumption.
Qed.

(** ... and in size the penetration falls at every step, unless it is 0. *)
Theorem theorem_1_3_3_falls_in_size : 0 < c -> 0 < eps -> forall k, p k <> 0 -> Rabs (p (S k)) < Rabs (p k).
Proof.
  intros C E k P. rewrite iterates_contract, Rabs_mult by lra.
  assert (A : 0 < Rabs (p k)) by (apply Rabs_pos_lt, P).
  assert (F : augmented_contraction c eps = 1 - eps / (c + eps)) by (functions; field; lra).
  assert (0 < eps / (c + eps)) by (apply Rdiv_lt_0_compat; lra).
  assert (0 < augmented_contraction c eps) by (functions; apply Rdiv_lt_0_compat; lra).
  rewrite (Rabs_pos_eq (augmented_contraction c eps)) by lra.
  rewrite <- (Rmult_1_l (Rabs (p k))) at 2. apply Rmult_lt_compat_r; lra.
Qed.

(** (1.17) without powers: no iterate penetrates more than the harmonic bound says. *)
Theorem eq_1_17_harmonic :
  0 < c -> 0 < eps -> forall k, Rabs (p k) <= augmented_harmonic_bound c eps (INR k) * Rabs (p 0).
Proof.
  intros C E k. induction k as [ | k I].
  - cbn [INR]. rewrite (eq_1_17_harmonic_start c eps C). lra.
  - rewrite iterates_contract, Rabs_mult by lra.
    assert (0 < augmented_contraction c eps) by (functions; apply Rdiv_lt_0_compat; lra).
    rewrite (Rabs_pos_eq (augmented_contraction c eps)), S_INR by lra.
    apply Rle_trans with
      (augmented_contraction c eps * (augmented_harmonic_bound c eps (INR k) * Rabs (p 0))).
    + apply Rmult_le_compat_l; lra.
    + rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [apply Rabs_pos | ].
      pose proof (eq_1_17_harmonic_step c eps (INR k) C E (pos_INR k)). lra.
Qed.

(** Note 5: so it does for a penalty that is far enough below 0. *)
Theorem note_5_iterates_beyond_twice : 0 < c -> 0 < - eps - 2 * c -> is_lim_seq p 0.
Proof.
  intros C E. apply is_lim_seq_ext with (2 := note_5_beyond_twice c m g l h eps lambda C E).
  intro k. symmetry. apply iterates_penetrate. lra.
Qed.

End Iterates.
