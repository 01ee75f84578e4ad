(** * Theorem 1.3.3, of the iterates themselves.

    The claims contain powers of the contraction factor, which numbers can check. Here they are combined with
    (1.16): [eq_1_16_closed_form_iterates] is the recursion of the chapter, from any initial multiplier, and
    everything below is about its iterates. *)

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

Lemma contraction_inside : 0 < c -> 0 < eps -> 0 < augmented_contraction c eps < 1.
Proof. intros C E. functions. split; [apply Rdiv_lt_0_compat; lra | apply Rlt_div_l; lra]. Qed.

Lemma size_contracts :
  0 < c -> 0 < eps -> forall k, Rabs (p (S k)) = augmented_contraction c eps * Rabs (p k).
Proof.
  intros C E k. pose proof (contraction_inside C E).
  rewrite iterates_contract, Rabs_mult, (Rabs_pos_eq (augmented_contraction c eps)); lra.
Qed.

(** ... and in size the penetration falls at every step, unless it is 0. *)
Theorem theorem_1_3_3_falls_in_size : 0 < c -> 0 < eps -> forall k, p k <> 0 -> Rabs (p (S k)) < Rabs (p k).
Proof.
  intros C E k P. rewrite size_contracts by assumption.
  pose proof (contraction_inside C E). pose proof (Rabs_pos_lt _ P). nra.
Qed.

(** (1.17) without powers: no iterate penetrates more than the harmonic bound says. *)
Theorem eq_1_17_harmonic :
  0 < c -> 0 < eps -> forall k, Rabs (p k) <= augmented_harmonic_bound c eps (INR k) * Rabs (p 0).
Proof.
  intros C E k. induction k as [ | k I].
  - cbn [INR]. rewrite (eq_1_17_harmonic_start c eps C). lra.
  - rewrite size_contracts, S_INR by assumption. pose proof (contraction_inside C E).
    pose proof (eq_1_17_harmonic_step c eps (INR k) C E (pos_INR k)). pose proof (Rabs_pos (p 0)). nra.
Qed.

(** Note 5: so it does for a penalty that is far enough below 0. *)
Theorem note_5_iterates_beyond_twice : 0 < c -> 0 < - eps - 2 * c -> is_lim_seq p 0.
Proof.
  intros C E. apply is_lim_seq_ext with (2 := note_5_beyond_twice c m g l h eps lambda C E).
  intro k. symmetry. apply iterates_penetrate. lra.
Qed.

(** (1.33): so many steps, and no fewer, bring the penetration below a tolerance. [up x] is the integer after
    x, the greatest that is not above x, plus 1. *)
Lemma iterates_in_size :
  0 < c -> 0 < eps -> forall k, Rabs (p k) * (1 + eps / c) ^ k = Rabs (p 0).
Proof.
  intros C E k. induction k as [ | k I]; [cbn [pow]; ring | ].
  rewrite <- I, size_contracts by assumption. cbn [pow]. functions. field. lra.
Qed.

Theorem eq_1_33_steps (tol : R) :
  0 < c -> 0 < eps -> 0 < tol -> tol <= Rabs (p 0) ->
  let n := Z.to_nat (up (ln (Rabs (p 0) / tol) / ln (1 + eps / c))) in
  Rabs (p n) < tol /\ forall k, (k < n)%nat -> tol <= Rabs (p k).
Proof.
  intros C E T P n.
  assert (0 < eps / c) by (apply Rdiv_lt_0_compat; lra).
  assert (G : 0 < ln (1 + eps / c)) by (rewrite <- ln_1; apply ln_increasing; lra).
  assert (D : 0 < Rabs (p 0) / tol) by (apply Rdiv_lt_0_compat; lra).
  set (x := ln (Rabs (p 0) / tol) / ln (1 + eps / c)) in n.
  assert (K : forall k, Rabs (p k) < tol <-> x < INR k).
  { intro k. assert (W : 0 < (1 + eps / c) ^ k) by (apply pow_lt; lra).
    assert (L : x < INR k <-> Rabs (p 0) / tol < (1 + eps / c) ^ k).
    { unfold x. rewrite Rlt_div_l by exact G. rewrite <- ln_pow by lra.
      split; [apply ln_lt_inv; assumption | apply ln_increasing, D]. }
    rewrite L, Rlt_div_l by exact T. rewrite <- (iterates_in_size C E k). split; nra. }
  assert (0 <= x) by (apply Rnot_lt_le; intro N; apply (K 0%nat) in N; lra).
  destruct (archimed x) as [A B].
  assert (N : INR n = IZR (up x)).
  { unfold n. rewrite INR_IZR_INZ, Z2Nat.id; [reflexivity | ]. apply le_IZR. lra. }
  split; [apply K; lra | ].
  intros k J. apply Rnot_lt_le. intro Q. apply K in Q. apply (le_INR (S k)) in J. rewrite S_INR in J. lra.
Qed.

End Iterates.

(** * Penalties that vary: beyond 2

    The augmentation with a penalty of its own at each step. *)
Fixpoint varying_multiplier (c m g l h : R) (eps : nat -> R) (lambda : R) (k : nat) : R :=
  match k with
  | O => lambda
  | S k =>
      let before := varying_multiplier c m g l h eps lambda k in
      augmented_update l h (eps k) before (augmented_deflection c m g l h (eps k) before)
  end.

Section Varying.

Variables c m g l h lambda : R.
Variable eps : nat -> R.
Variable stiffness : 0 < c.
Variable penalties : forall k, 0 < eps k.

Let error k := varying_multiplier c m g l h eps lambda k - system_reaction c m g l h.
Fixpoint growth (k : nat) : R := match k with O => 1 | S k => growth k * (1 + eps k / c) end.
Fixpoint total (k : nat) : R := match k with O => 0 | S k => total k + eps k end.

Lemma ratio_positive k : 0 < eps k / c.
Proof. apply Rdiv_lt_0_compat; [apply penalties | exact stiffness]. Qed.

Lemma growth_positive k : 0 < growth k.
Proof.
  induction k as [ | k I]; cbn [growth]; [lra | ].
  pose proof (ratio_positive k). apply Rmult_lt_0_compat; lra.
Qed.

(** The product of the factors c / (c + eps). *)
Lemma error_after k : error k = error 0 / growth k.
Proof.
  induction k as [ | k I]; [cbn [growth]; field | ].
  pose proof (growth_positive k). pose proof (penalties k).
  transitivity (error k / (1 + eps k / c)).
  - unfold error. cbn [varying_multiplier]. functions. field. lra.
  - rewrite I. cbn [growth]. field. lra.
Qed.

Lemma growth_at_least k : 1 + total k / c <= growth k.
Proof.
  induction k as [ | k I]; cbn [growth total]; [right; field; lra | ].
  pose proof (ratio_positive k). pose proof (growth_positive k).
  assert (1 <= growth k).
  { clear - k penalties stiffness. induction k as [ | k J]; cbn [growth]; [lra | ].
    pose proof (ratio_positive k). nra. }
  replace (1 + (total k + eps k) / c) with (1 + total k / c + eps k / c) by (field; lra). nra.
Qed.

Lemma growth_at_most k : growth k <= exp (total k / c).
Proof.
  induction k as [ | k I]; cbn [growth total].
  - replace (0 / c) with 0 by (field; lra). rewrite exp_0. lra.
  - pose proof (ratio_positive k). pose proof (growth_positive k).
    replace ((total k + eps k) / c) with (total k / c + eps k / c) by (field; lra).
    rewrite exp_plus. apply Rmult_le_compat; [lra | lra | exact I | ].
    apply exp_ineq1_le.
Qed.

(** They lead to the reaction if their sum grows beyond all bounds, *)
Theorem beyond_2_varying_converges :
  is_lim_seq total p_infty ->
  is_lim_seq (varying_multiplier c m g l h eps lambda) (system_reaction c m g l h).
Proof.
  intro T.
  apply is_lim_seq_ext with (fun k => error 0 * / growth k + system_reaction c m g l h).
  { intro k. pose proof (error_after k) as A. unfold error in A at 1. unfold Rdiv in A. lra. }
  replace (Finite (system_reaction c m g l h))
    with (Finite (error 0 * 0 + system_reaction c m g l h)) by (f_equal; ring).
  apply is_lim_seq_plus'; [ | apply is_lim_seq_const].
  apply (is_lim_seq_scal_l _ _ 0), (is_lim_seq_inv _ p_infty); [ | discriminate].
  apply is_lim_seq_le_p_loc with (fun k => 1 + / c * total k).
  - exists O. intros k _. replace (/ c * total k) with (total k / c) by (field; lra). apply growth_at_least.
  - apply is_lim_seq_plus with 1 p_infty; [apply is_lim_seq_const | | reflexivity].
    replace p_infty with (Rbar_mult (/ c) p_infty); [apply is_lim_seq_scal_l, T | ].
    apply is_Rbar_mult_unique. apply is_Rbar_mult_sym, is_Rbar_mult_p_infty_pos.
    apply Rinv_0_lt_compat, stiffness.
Qed.

(** and only then, unless they start there. *)
Theorem beyond_2_varying_only_then :
  lambda <> system_reaction c m g l h ->
  is_lim_seq (varying_multiplier c m g l h eps lambda) (system_reaction c m g l h) ->
  is_lim_seq total p_infty.
Proof.
  intros D V.
  assert (E : error 0 <> 0) by (unfold error; cbn [varying_multiplier]; lra).
  assert (G : is_lim_seq (fun k => / growth k) 0).
  { apply is_lim_seq_ext with
      (fun k => / error 0 * (varying_multiplier c m g l h eps lambda k + - system_reaction c m g l h)).
    - intro k. pose proof (error_after k) as A. unfold error in A at 1. pose proof (growth_positive k).
      replace (varying_multiplier c m g l h eps lambda k + - system_reaction c m g l h)
        with (error 0 / growth k) by lra.
      field. lra.
    - replace (Finite 0) with
        (Finite (/ error 0 * (system_reaction c m g l h + - system_reaction c m g l h))) by (f_equal; ring).
      apply (is_lim_seq_scal_l _ _ (system_reaction c m g l h + - system_reaction c m g l h)).
      apply is_lim_seq_plus'; [exact V | apply is_lim_seq_const]. }
  (* Where 1/growth < exp (- M / c), the sum is greater than M. *)
  intros P [M B]. cbn [eventually filtermap] in *.
  assert (0 < exp (- (M / c))) by apply exp_pos.
  destruct (G (fun x => x < exp (- (M / c)))) as [n N].
  { exists (mkposreal _ H). intros y Y. cbn in Y. unfold ball in Y. cbn in Y.
    unfold AbsRing_ball, abs, minus, plus, opp in Y. cbn in Y. apply Rabs_def2 in Y. lra. }
  exists n. intros k K. apply B. specialize (N k K). cbn in N.
  pose proof (growth_positive k) as W. pose proof (growth_at_most k) as U.
  assert (I : exp (- (total k / c)) <= / growth k).
  { rewrite exp_Ropp. apply Rinv_le_contravar; assumption. }
  assert (L : exp (- (total k / c)) < exp (- (M / c))) by lra.
  apply exp_lt_inv in L. assert (M / c < total k / c) by lra.
  apply (Rmult_lt_reg_r (/ c)); [apply Rinv_0_lt_compat, stiffness | exact H0].
Qed.

End Varying.

(** * Many contacts

    With the compliance S of a structure at its contacts, p - p* = - S (lambda' - lambda* ), one augmentation
    with brackets brings the multipliers nearer to the solution, whatever opens and closes. Vectors have the
    components 0 to n. *)
Section Contacts.

Variable n : nat.

Definition dot (x y : nat -> R) : R := sum_f_R0 (fun i => x i * y i) n.

Lemma dot_of_difference a (x y : nat -> R) :
  dot (fun i => a * x i - y i) (fun i => a * x i - y i) = a * a * dot x x - 2 * a * dot x y + dot y y.
Proof. unfold dot. induction n as [ | k I]; cbn [sum_f_R0]; [ring | rewrite I; ring]. Qed.

Lemma dot_sum (x y z : nat -> R) a : dot x (fun i => y i + a * z i) = dot x y + a * dot x z.
Proof. unfold dot. induction n as [ | k I]; cbn [sum_f_R0]; [ring | rewrite I; ring]. Qed.

Lemma square_not_negative (x : nat -> R) : 0 <= dot x x.
Proof. apply cond_pos_sum. intro i. apply Rle_0_sqr. Qed.

(** Brackets bring two numbers no further apart. *)
Lemma brackets a b : (Rmax a 0 - Rmax b 0) * (Rmax a 0 - Rmax b 0) <= (Rmax a 0 - Rmax b 0) * (a - b).
Proof. unfold Rmax. destruct (Rle_dec a 0), (Rle_dec b 0); nra. Qed.

Theorem contacts_contract
  (compliance : (nat -> R) -> nat -> R) (s eps : R) (lambda next best p q : nat -> R) :
  0 <= s -> 0 <= eps ->
  (forall x, s * dot x x <= dot x (compliance x)) ->
  (forall i, (i <= n)%nat -> next i = Rmax (lambda i + eps * p i) 0) ->
  (forall i, (i <= n)%nat -> best i = Rmax (best i + eps * q i) 0) ->
  (forall i, (i <= n)%nat -> p i - q i = - compliance (fun j => next j - best j) i) ->
  (1 + eps * s) ^ 2 * dot (fun i => next i - best i) (fun i => next i - best i) <=
    dot (fun i => lambda i - best i) (fun i => lambda i - best i).
Proof.
  intros S E A N B P.
  set (after := fun i => next i - best i). set (before := fun i => lambda i - best i).
  assert (F : dot after after <= dot after (fun i => before i + - eps * compliance after i)).
  { apply sum_Rle. intros i I. pose proof (brackets (lambda i + eps * p i) (best i + eps * q i)) as M.
    rewrite <- (N i I), <- (B i I) in M. fold (after i) in M.
    replace (before i + - eps * compliance after i) with (lambda i + eps * p i - (best i + eps * q i)).
    - exact M.
    - unfold before, after. replace (p i) with (q i + - compliance (fun j => next j - best j) i)
        by (specialize (P i I); lra). ring. }
  rewrite dot_sum in F. specialize (A after).
  pose proof (square_not_negative (fun i => (1 + eps * s) * after i - before i)) as Q.
  rewrite dot_of_difference in Q.
  assert (K : (1 + eps * s) * dot after after <= dot after before) by nra.
  assert (0 <= 1 + eps * s) by nra.
  assert ((1 + eps * s) * ((1 + eps * s) * dot after after) <= (1 + eps * s) * dot after before)
    by (apply Rmult_le_compat_l; assumption).
  nra.
Qed.

End Contacts.
