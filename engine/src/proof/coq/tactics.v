(** * What every proof here uses: a few lemmas and tactics, and nothing about contact.

    [lra] and [field] decide what they are made for, so proofs are led to goals of their kind:
    identities between quotients, and sums of products whose sign can be read off. *)
From Coq Require Export Reals Lra.
From Coquelicot Require Export Coquelicot.
Open Scope R_scope.

Create HintDb functions.

(** Every function of the functions by its formula. *)
Ltac functions := autounfold with functions in *; cbv beta in *.

(** ** Signs

    The sign of a sum, product, quotient or power whose parts have known signs. *)
Ltac positivity :=
  first
    [ assumption
    | lazymatch goal with
      | |- 0 < exp _ => apply exp_pos
      | |- 0 <= exp _ => left; apply exp_pos
      | |- 0 < _ + _ =>
          first
            [ apply Rplus_lt_le_0_compat; positivity
            | apply Rplus_le_lt_0_compat; positivity ]
      | |- 0 <= _ + _ => apply Rplus_le_le_0_compat; positivity
      | |- 0 < _ * _ => apply Rmult_lt_0_compat; positivity
      | |- 0 <= _ * _ => apply Rmult_le_pos; positivity
      | |- 0 < _ / _ => apply Rdiv_lt_0_compat; positivity
      | |- 0 <= _ / _ => apply Rdiv_le_0_compat; positivity
      | |- 0 < _ ^ _ => apply pow_lt; positivity
      | |- 0 <= _ ^ 2 => apply pow2_ge_0
      | |- 0 <= (_ ^ _) ^ 2 => apply pow2_ge_0
      | |- 0 <= _ ^ _ => apply pow_le; positivity
      end
    | match goal with |- 0 <= _ => left; assumption end
    | lra ].

(** ** Divisors

    [field] asks for its divisors not to be 0. They are among the hypotheses, or have a sign. *)
Lemma positive_not_zero x : 0 < x -> x <> 0.
Proof. intro H. apply Rgt_not_eq. exact H. Qed.

Lemma negative_not_zero x : 0 < - x -> x <> 0.
Proof. intro H. lra. Qed.

Ltac nonzero_one :=
  first
    [ assumption
    | match goal with
      | N : ?n <> 0 |- ?x <> 0 =>
          first
            [ replace x with n by ring; exact N
            | replace x with (- n) by ring; apply Ropp_neq_0_compat; exact N ]
      | P : 0 < ?p |- ?x <> 0 =>
          first
            [ replace x with p by ring; apply Rgt_not_eq; exact P
            | replace x with (- p) by ring; apply Rlt_not_eq, Ropp_lt_gt_0_contravar; exact P ]
      end
    | lra
    | apply positive_not_zero; solve [positivity]
    | apply Rmult_integral_contrapositive_currified; nonzero_one ].
Ltac nonzero := repeat split; nonzero_one.

(** ** Identities

    Equal as quotients of polynomials and exponentials, given what the hypotheses say of products of
    symbols. *)
Ltac quotients :=
  first
    [ solve [field; nonzero]
    | match goal with
      | E : _ * _ = _, F : _ * _ = _ |- _ => solve [field [E F]; nonzero]
      end
    | match goal with E : _ * _ = _ |- _ => solve [field [E]; nonzero] end ].

(** An exponential with the exponent 0, or that of another, or its opposite, or the sum of two others, is
    written so. *)
Ltac exponential a :=
  match goal with
  | _ => replace (exp a) with 1 by (symmetry; replace a with 0 by quotients; apply exp_0)
  | |- context [exp ?b] =>
      tryif constr_eq a b then fail else
        first
          [ replace (exp a) with (exp b) by (f_equal; quotients)
          | replace (exp a) with (/ exp b) by (rewrite <- exp_Ropp; f_equal; quotients) ]
  | |- context [exp ?b] =>
      tryif constr_eq a b then fail else
        match goal with
        | |- context [exp ?d] =>
            tryif constr_eq a d then fail else
              replace (exp a) with (exp b * exp d) by (rewrite <- exp_plus; f_equal; quotients)
        end
  end.
Ltac exponentials := repeat match goal with |- context [exp ?a] => exponential a end.

(** A monomial and what it equals, so that the quantity of a hypothesis has a name of its own. *)
Definition pivot (x y : R) := x = y.

(** With the quantities of hypotheses by their names. *)
Ltac pivots :=
  repeat match goal with
    | E : pivot (?x * ?y) ?z |- _ =>
        let F := fresh in
        unfold pivot in E; assert (F : y * x = z) by lra; rewrite ?E, ?F;
      repeat match goal with P : pivot _ _ |- _ => progress (rewrite ?E, ?F in P) end;
      clear F
    end;
  repeat match goal with
    | E : pivot ?x _ |- _ => is_var x; unfold pivot in E; subst x
    end;
  unfold pivot in *.

(** By what the hypotheses' names stand for, or by the names. *)
Ltac identity :=
  first
    [ solve [subst; quotients]
    | solve [pivots; quotients]
    | match goal with
      | |- context [exp _] =>
          first
            [ solve [subst; exponentials; first [reflexivity | quotients]]
            | solve [pivots; exponentials; first [reflexivity | quotients]] ]
      end ].

(** The goal is about a quantity that equals [e], whose sign can be read off. *)
Ltac sign_by e :=
  match goal with
  | |- 0 < ?x => replace x with e by identity
  | |- 0 <= ?x => replace x with e by identity
  end;
  positivity.

(** ** Hypotheses

    A quantity of known sign gets a name of its own; or, if it is a symbol, the symbol has the sign. *)
Lemma named_positive q : 0 < q -> exists s, s = q /\ 0 < s.
Proof. intro H. exists q. split; [reflexivity | exact H]. Qed.

Lemma named_nonnegative q : 0 <= q -> exists s, s = q /\ 0 <= s.
Proof. intro H. exists q. split; [reflexivity | exact H]. Qed.

Lemma same_positive q x : 0 < q -> x = q -> 0 < x.
Proof. intros H ->. exact H. Qed.

Lemma same_nonnegative q x : 0 <= q -> x = q -> 0 <= x.
Proof. intros H ->. exact H. Qed.

(** An equation, solved. *)
Lemma solved q k x y : q = 0 -> x - y = k * q -> x = y.
Proof. intros -> E. rewrite Rmult_0_r in E. apply Rminus_diag_uniq. exact E. Qed.

Lemma solved_for s q k x y : s = q -> x - y = k * (q - s) -> pivot x y.
Proof. intros E. apply solved. rewrite E. ring. Qed.

(** Two cases. *)
Lemma either d : {0 < d} + {0 <= - d}.
Proof. destruct (Rlt_le_dec 0 d) as [H | H]; [left | right]; lra. Qed.

(** ** Brackets

    Which of its values a bracket has follows from a sign: that of its argument, or of the difference of its
    two arguments, which is [e] or its opposite. *)
Ltac bracket_open e :=
  match goal with
  | |- context [Rmax ?a 0] =>
      rewrite (Rmax_left a 0) by (replace a with e by identity; positivity)
  end.
Ltac bracket_shut e :=
  match goal with
  | |- context [Rmax ?a 0] =>
      rewrite (Rmax_right a 0)
        by (apply Ropp_le_cancel; rewrite Ropp_0; replace (- a) with e by identity; positivity)
  end.
Ltac minimum_first e :=
  match goal with
  | |- context [Rmin ?a ?b] =>
      rewrite (Rmin_left a b) by (apply Rminus_le_0; replace (b - a) with e by identity; positivity)
  end.
Ltac minimum_second e :=
  match goal with
  | |- context [Rmin ?a ?b] =>
      rewrite (Rmin_right a b) by (apply Rminus_le_0; replace (a - b) with e by identity; positivity)
  end.

(** ** Derivatives *)
Ltac derivative := auto_derive; [nonzero | identity].

(** ** Functions that rise

    A function with a derivative of one sign, from a start of that sign. *)
Lemma by_some_slope (f f' : R -> R) (x : R) :
  0 < x -> (forall z, 0 <= z -> is_derive f z (f' z)) ->
  exists z, 0 < z /\ f x = f 0 + f' z * x.
Proof.
  intros X D.
  destruct (MVT_cor2 f f' 0 x X) as (z & E & Z).
  { intros z [Z _]. apply is_derive_Reals, D, Z. }
  exists z. replace (x - 0) with x in E by ring. split; lra.
Qed.

Lemma rises (f f' : R -> R) (x : R) :
  0 <= x -> 0 <= f 0 ->
  (forall z, 0 <= z -> is_derive f z (f' z)) -> (forall z, 0 < z -> 0 <= f' z) ->
  0 <= f x.
Proof.
  intros [X | <-] F D P; [ | exact F].
  destruct (by_some_slope f f' x X D) as (z & Z & ->). specialize (P z Z). positivity.
Qed.

Lemma rises_strictly (f f' : R -> R) (x : R) :
  0 < x -> 0 <= f 0 ->
  (forall z, 0 <= z -> is_derive f z (f' z)) -> (forall z, 0 < z -> 0 < f' z) ->
  0 < f x.
Proof.
  intros X F D P.
  destruct (by_some_slope f f' x X D) as (z & Z & ->). specialize (P z Z). positivity.
Qed.

Lemma rises_from_positive (f f' : R -> R) (x : R) :
  0 <= x -> 0 < f 0 ->
  (forall z, 0 <= z -> is_derive f z (f' z)) -> (forall z, 0 < z -> 0 <= f' z) ->
  0 < f x.
Proof.
  intros [X | <-] F D P; [ | exact F].
  destruct (by_some_slope f f' x X D) as (z & Z & ->). specialize (P z Z). positivity.
Qed.

(** ** Limits

    What becomes of a function for great [x] is what becomes of it for small [1/x]. *)
Lemma limit_at_infinity (f g : R -> R) (y : R) :
  (forall x, 0 < x -> f x = g (/ x)) -> ex_derive g 0 -> g 0 = y -> is_lim f p_infty y.
Proof.
  intros E D <-.
  apply is_lim_ext_loc with (fun x => g (/ x)).
  { exists 0. intros x X. symmetry. apply E, X. }
  apply is_lim_comp with 0.
  - apply is_lim_continuity, continuity_pt_filterlim, (ex_derive_continuous g 0 D).
  - replace (Finite 0) with (Rbar_inv p_infty) by reflexivity.
    apply is_lim_inv; [apply is_lim_id | discriminate].
  - exists 0. intros x X E0. injection E0 as E1. apply (Rinv_neq_0_compat x); lra.
Qed.

(** An exponential with a negative rate vanishes. *)
Lemma exp_vanishes (r : R) : 0 < - r -> is_lim (fun x => exp (r * x)) p_infty 0.
Proof.
  intro P. apply is_lim_comp with m_infty.
  - apply is_lim_exp_m.
  - replace m_infty with (Rbar_mult r p_infty).
    + apply is_lim_scal_l, is_lim_id.
    + simpl. unfold Rbar_mult'. destruct (Rle_dec 0 r); [exfalso; lra | reflexivity].
  - exists 0. intros x _. discriminate.
Qed.

Lemma limit_with_decay (f g : R -> R) (b r y : R) :
  (forall x, 0 < x -> f x = g (/ x) + b * exp (r * x)) -> 0 < - r -> ex_derive g 0 -> g 0 = y ->
  is_lim f p_infty y.
Proof.
  intros E P D Y.
  apply is_lim_ext_loc with (fun x => g (/ x) + b * exp (r * x)).
  { exists 0. intros x X. symmetry. apply E, X. }
  replace (Finite y) with (Finite (y + b * 0)) by (f_equal; ring).
  apply is_lim_plus'.
  - apply (limit_at_infinity _ g); auto.
  - apply (is_lim_scal_l (fun x => exp (r * x)) b p_infty 0), exp_vanishes, P.
Qed.

(** A continuous function of a power that vanishes. *)
Lemma limit_of_powers (f : R -> R) (rho y : R) :
  0 < 1 - rho * rho -> ex_derive f 0 -> f 0 = y -> is_lim_seq (fun n => f (rho ^ n)) y.
Proof.
  intros P D <-.
  apply (is_lim_seq_continuous f (fun n => rho ^ n) 0).
  - apply continuity_pt_filterlim. apply (ex_derive_continuous f 0 D).
  - apply is_lim_seq_geom. rewrite <- Rabs_R1. apply Rsqr_lt_abs_0. unfold Rsqr. lra.
Qed.
