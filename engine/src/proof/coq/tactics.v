(** * Tactics of all proofs: how a goal is passed to the program.

    Numbers that are not computed by the four operations get names; the program replaces them by their equations,
    and certificates then show equalities and signs. Slopes and limits have lemmas. *)
From Coq Require Export String Reals Lra List.
From Coquelicot Require Export Coquelicot.
From LIBRARY Require Import A_Polynomials.
From LIBRARY Require A_Quotients.
Export A_Polynomials(value, polynomial).
Export A_Quotients(Shown, Squared, Divisor, identity).
Export ListNotations.
Open Scope R_scope.

Create HintDb functions.

(** Every function of the functions by its formula. *)
Ltac functions := autounfold with functions in *; cbv beta in *.

(** ** Goals for the program

    A formula of [env], with each step by what the program calls it. *)
Ltac abstracted x env :=
  lazymatch env with
  | [] => x
  | ?v :: ?env => let f := abstracted x env in lazymatch eval pattern v in f with ?f _ => f end
  end.
Ltac at_symbols f n env :=
  lazymatch env with
  | [] => f
  | _ :: ?env => at_symbols constr:(f (A_Quotients.Symbol n)) (S n) env
  end.
(** A formula in [env], and the function that rounds in it, if any. *)
Ltac rounding := constr:(id).
Ltac formula x env :=
  lazymatch x with
  | value env ?p => constr:(A_Quotients.Polynomial p)
  | _ =>
  let x := eval cbv [Rminus Rdiv pow] in x in
  let f := abstracted x env in
  let fl := rounding in
  lazymatch eval pattern fl in f with
  | ?f _ =>
  lazymatch eval pattern R, Rplus, Rmult, Ropp, Rinv, IZR, Rmin, Rmax, exp in f with
  | ?f _ _ _ _ _ _ _ _ _ =>
      let f := constr:(f A_Quotients.formula A_Quotients.Sum A_Quotients.Product A_Quotients.Opposite
                         A_Quotients.Inverse A_Quotients.Literal A_Quotients.Minimum
                         (fun a _ => A_Quotients.Bracket a) A_Quotients.Exponential A_Quotients.Rounded) in
      let f := at_symbols f O env in
      eval cbv beta in f
  end end end.

(** What is said of a formula: its sign; or more. *)
Ltac sign T env :=
  let of x k := (let f := formula x env in constr:((f, k))) in
  lazymatch T with
  | 0 < ?x => of x Positive
  | 0 <= ?x => of x NonNegative
  | ?x = 0 => of x Zero
  | ?x <= 0 => of x NonPositive
  | ?x < 0 => of x Negative
  | -1 <= ?x <= 1 => of x Unit
  end.
Ltac said T env :=
  match T with
  | ?S -> ?T => let a := sign S env in let s := said T env in constr:(A_Quotients.If a s)
  | _ => let a := sign T env in constr:(A_Quotients.Is a)
  | ?x = ?y => let f := formula x env in let g := formula y env in constr:(A_Quotients.Replaced f g)
  end.
Ltac goals T env :=
  lazymatch T with
  | True => constr:(@nil (A_Quotients.formula * kind))
  | ?S /\ ?T => let a := sign S env in let l := goals T env in constr:(a :: l)
  end.

(** Passes steps to a tactic, and proofs of those that are said. *)
Ltac steps given env all proof tac :=
  lazymatch given with
  | tt => tac all proof
  | (?given, ?H) =>
      lazymatch type of H with
      | A_Quotients.step => steps given env constr:(H :: all) proof tac
      | ?T => let s := said T env in steps given env constr:(A_Quotients.Given s :: all) constr:(conj H proof) tac
      end
  end.

Lemma within x b : 0 <= b - x /\ 0 <= b + x /\ True -> Rabs x <= b.
Proof. intros. apply Rabs_le. lra. Qed.

Lemma not_zero x : x * / x - 1 = 0 -> x <> 0.
Proof. intros E ->. lra. Qed.

(** What is known of numbers from the start. *)
Ltac known_from_start := repeat (apply Forall2_cons; [first [exact I | assumption] | ]); exact (Forall2_nil of_kind).

(** By some steps, in numbers [env] of kinds [atoms]. *)
Ltac shown env atoms given :=
  lazymatch goal with
  | |- Rabs _ <= _ => apply within
  | |- _ <> 0 => apply not_zero, (@proj1 _ True)
  | |- _ = 0 => apply (@proj1 _ True)
  | |- _ = _ => apply Rminus_diag_uniq, (@proj1 _ True)
  | |- _ => apply (@proj1 _ True)
  end;
  lazymatch goal with
  | |- ?T =>
      let g := goals T env in
      let fl := rounding in
      steps given env constr:(@nil A_Quotients.step) I
        ltac:(fun l p => refine (A_Quotients.shows_right fl env atoms _ l g p _));
      [known_from_start | vm_cast_no_check (eq_refl true)]
  end.

(** What remains of a derivative. *)
Ltac derived env atoms given :=
  lazymatch goal with
  | |- True => exact I
  | |- _ /\ _ => split; derived env atoms given
  | |- _ => shown env atoms given
  end.

(** ** Names

    What lies between two values, by something that lies between -1 and 1. *)
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

Lemma near a m x :
  Rabs (x - a) <= m -> exists t, -1 <= t <= 1 /\ x = (a - m + (a + m)) / 2 + (a + m - (a - m)) / 2 * t.
Proof. intro H. apply Rabs_le_between in H. apply between. nra. Qed.

(** An absolute value, and a factor. *)
Lemma absolute x : exists s t, 0 <= s /\ -1 <= t <= 1 /\ Rmin (- x) x = - s /\ x - s * t = 0.
Proof.
  destruct (Rle_dec 0 x); [exists x, 1 | exists (- x), (-1)]; repeat split; try lra;
    [rewrite Rmin_left | rewrite Rmin_right]; lra.
Qed.

Lemma own_size x s : Rmin (- x) x = - s -> 0 <= x -> s - x = 0.
Proof. intros S P. rewrite Rmin_left in S; lra. Qed.

Lemma negated_size x s : Rmin (- x) x = - s -> x <= 0 -> s + x = 0.
Proof. intros S P. rewrite Rmin_right in S; lra. Qed.

Lemma exponential a : exists y, 0 < y /\ exp a = y.
Proof. exists (exp a). split; [apply exp_pos | reflexivity]. Qed.

Lemma same_exponential a b z : exp b = z -> a - b = 0 -> exp a = z.
Proof. intros <- E. f_equal. lra. Qed.

(** Two products of exponentials whose exponents have the same sum. *)
Lemma both a b y z : exp a = y -> exp b = z -> exp (a + b) = y * z.
Proof. intros <- <-. apply exp_plus. Qed.

Lemma same_exponents a b y z : exp a = y -> exp b = z -> a - b = 0 -> y - z = 0.
Proof. intros <- <- E. replace b with a by lra. ring. Qed.

(** Two cases. *)
Lemma either d : {0 < d} + {d <= 0}.
Proof. destruct (Rlt_le_dec 0 d); [left | right]; assumption. Qed.

(** The exponential function lies above its tangent at 0, and below a fraction with a pole at 2. *)
Lemma above_tangent a y : exp a = y -> 0 <= y - (1 + a).
Proof. intros <-. destruct (Req_dec a 0) as [-> | N]; [rewrite exp_0 | pose proof (exp_ineq1 a N)]; lra. Qed.

Lemma above_tangent_right a y : exp a = y -> 0 < a -> 0 < y - (1 + a).
Proof. intros <- A. assert (a <> 0) as N by lra. pose proof (exp_ineq1 a N). lra. Qed.

Lemma above_tangent_left a y : exp a = y -> a < 0 -> 0 < y - (1 + a).
Proof. intros <- A. assert (a <> 0) as N by lra. pose proof (exp_ineq1 a N). lra. Qed.

Lemma below_pole a y : exp a = y -> 0 < a -> 0 < 2 + a - (2 - a) * y.
Proof.
  intros <- A. destruct (MVT_cor2 (fun x => 2 + x - (2 - x) * exp x) (fun x => 1 - (1 - x) * exp x) 0 a A) as (z & E & Z).
  { intros z _. apply is_derive_Reals. auto_derive; [exact I | ring]. }
  rewrite exp_0 in E. assert (0 < 1 - (1 - z) * exp z); [ | nra].
  assert (- z <> 0) as N by lra. pose proof (exp_ineq1 (- z) N) as T. pose proof (exp_pos z) as P.
  rewrite exp_Ropp in T. apply (Rmult_lt_compat_r (exp z) _ _ P) in T. rewrite Rinv_l in T; lra.
Qed.

Lemma below_pole_or_at_0 a y : exp a = y -> 0 <= a -> 0 <= 2 + a - (2 - a) * y.
Proof.
  intros E [A | <-]; [left; exact (below_pole a y E A) | ]. rewrite exp_0 in E. lra.
Qed.

(** ** Limits

    What becomes of a function for great [x], beyond some [m], is what becomes of it for small [1/x]. *)
Lemma limit_at_infinity (m : R) (f g : R -> R) (y : R) :
  (forall x, m < x -> f x = g (/ x)) -> ex_derive g 0 -> g 0 = y -> is_lim f p_infty y.
Proof.
  intros E D <-.
  apply is_lim_ext_loc with (fun x => g (/ x)).
  { exists m. intros x X. symmetry. apply E, X. }
  apply is_lim_comp with 0.
  - apply is_lim_continuity, continuity_pt_filterlim, (ex_derive_continuous g 0 D).
  - replace (Finite 0) with (Rbar_inv p_infty) by reflexivity.
    apply is_lim_inv; [apply is_lim_id | discriminate].
  - exists 0. intros x X E0. injection E0 as E1. apply (Rinv_neq_0_compat x); lra.
Qed.

(** An exponential with a negative rate vanishes. *)
Lemma exp_vanishes (r : R) : r < 0 -> is_lim (fun x => exp (r * x)) p_infty 0.
Proof.
  intro P. apply is_lim_comp with m_infty.
  - apply is_lim_exp_m.
  - replace m_infty with (Rbar_mult r p_infty).
    + apply is_lim_scal_l, is_lim_id.
    + simpl. unfold Rbar_mult'. destruct (Rle_dec 0 r); [exfalso; lra | reflexivity].
  - exists 0. intros x _. discriminate.
Qed.

Lemma limit_with_decay (m : R) (f g : R -> R) (b r y : R) :
  (forall x, m < x -> f x = g (/ x) + b * exp (r * x)) -> r < 0 -> ex_derive g 0 -> g 0 = y ->
  is_lim f p_infty y.
Proof.
  intros E P D Y.
  apply is_lim_ext_loc with (fun x => g (/ x) + b * exp (r * x)).
  { exists m. intros x X. symmetry. apply E, X. }
  replace (Finite y) with (Finite (y + b * 0)) by (f_equal; ring).
  apply is_lim_plus'.
  - apply (limit_at_infinity m _ g); auto.
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
