(** * Tactics of all proofs: how a goal is passed to the program.

    Numbers that are not computed by the four operations get names, and their equations are used for rewriting;
    certificates then show equalities and signs. Slopes and limits have lemmas. *)
From Coq Require Export Reals Lra List.
From Coquelicot Require Export Coquelicot.
From LIBRARY Require Import A_Polynomials.
From LIBRARY Require A_Quotients.
Export A_Quotients(Next, Shown, Divisor, Fact, Value, identity, solved, Solve, Divide, Known, By).
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
Ltac formula x env :=
  let x := eval cbv [Rminus Rdiv pow] in x in
  let f := abstracted x env in
  lazymatch eval pattern R, Rplus, Rmult, Ropp, Rinv, IZR, Rmin, Rmax in f with
  | ?f _ _ _ _ _ _ _ _ =>
      let f := constr:(f A_Quotients.formula A_Quotients.Sum A_Quotients.Product A_Quotients.Opposite
                         A_Quotients.Inverse A_Quotients.Literal A_Quotients.Minimum
                         (fun a _ => A_Quotients.Bracket a)) in
      let f := at_symbols f O env in
      eval cbv beta in f
  end.

(** What is said, as a number and a kind. *)
Ltac said T :=
  lazymatch T with
  | 0 < ?x => constr:((x, Positive))
  | 0 <= ?x => constr:((x, NonNegative))
  | ?x = 0 => constr:((x, Zero))
  | ?x <= 0 => constr:((x, NonPositive))
  | ?x < 0 => constr:((x, Negative))
  | -1 <= ?x <= 1 => constr:((x, Unit))
  end.
Ltac in_formulas env given :=
  lazymatch given with
  | tt => constr:(@nil (A_Quotients.formula * kind))
  | (?H, ?given) =>
      let T := type of H in
      lazymatch said T with
      | (?x, ?k) => let f := formula x env in let l := in_formulas env given in constr:((f, k) :: l)
      end
  end.
Ltac proofs given :=
  lazymatch given with
  | tt => constr:(I)
  | (?H, ?given) => let p := proofs given in constr:(conj H p)
  end.

(** By some steps from what is given, in numbers [env]. *)
Ltac shown env given steps r :=
  lazymatch goal with
  | |- ?x = ?y => lazymatch y with 0 => idtac | _ => apply Rminus_diag_uniq end
  | |- _ => idtac
  end;
  lazymatch goal with
  | |- ?T =>
      let l := in_formulas env given in
      let p := proofs given in
      lazymatch said T with
      | (?x, ?k) =>
          let f := formula x env in
          refine (A_Quotients.shows_right env l steps r f k p _); vm_cast_no_check (eq_refl true)
      end
  end.
Ltac not_zero env given steps :=
  repeat split;
  lazymatch goal with
  | |- True => exact I
  | |- ?x <> 0 =>
      let l := in_formulas env given in
      let p := proofs given in
      let f := formula x env in
      refine (A_Quotients.is_divisor_right env l steps f p _); vm_cast_no_check (eq_refl true)
  end.

Lemma within x b : 0 <= b - x -> 0 <= b + x -> Rabs x <= b.
Proof. intros. apply Rabs_le. lra. Qed.

Ltac bounded env given steps r s :=
  apply within; [shown env given steps r | shown env given steps s].

(** What remains of a derivative. *)
Ltac derived env given steps :=
  lazymatch goal with
  | |- _ = _ => shown env given steps (By (identity [] [[1%Z]] []))
  | |- _ => not_zero env given steps
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

Lemma same_size x y s r :
  Rmin (- x) x = - s -> Rmin (- y) y = - r -> x - y = 0 \/ x + y = 0 -> s = r.
Proof.
  intros S T E. enough (Rmin (- x) x = Rmin (- y) y) by lra. clear S T.
  destruct E; [replace y with x by lra | replace y with (- x) by lra; rewrite Ropp_involutive, Rmin_comm];
    reflexivity.
Qed.

Lemma exponential a : exists y, 0 < y /\ exp a = y.
Proof. exists (exp a). split; [apply exp_pos | reflexivity]. Qed.

Lemma same_exponential a b y z : exp a = y -> exp b = z -> a - b = 0 -> exp a = z.
Proof. intros _ <- E. f_equal. lra. Qed.

Lemma no_exponent a y : exp a = y -> a = 0 -> exp a = 1.
Proof. intros _ ->. apply exp_0. Qed.

(** Two products of exponentials whose exponents have the same sum. *)
Definition total_exponent (l : list (R * R)) : R := fold_right (fun a x => fst a + x) 0 l.
Definition all (l : list (R * R)) : R := fold_right (fun a x => snd a * x) 1 l.
Definition are_exponentials (l : list (R * R)) : Prop := fold_right (fun a P => exp (fst a) = snd a /\ P) True l.

Lemma exp_total l : are_exponentials l -> exp (total_exponent l) = all l.
Proof.
  induction l as [ | a l I]; simpl; [intros _; apply exp_0 | ].
  intros [<- L]. rewrite exp_plus, (I L). reflexivity.
Qed.

Lemma same_exponents l m :
  are_exponentials l -> are_exponentials m -> total_exponent l - total_exponent m = 0 -> all l - all m = 0.
Proof. intros L M E. rewrite <- (exp_total l L), <- (exp_total m M). replace (total_exponent l) with (total_exponent m); lra. Qed.

Ltac in_exponentials l :=
  lazymatch l with
  | tt => constr:(@nil (R * R))
  | (?F, ?l) =>
      let l := in_exponentials l in
      lazymatch type of F with exp ?a = ?y => constr:((a, y) :: l) end
  end.
Ltac exponents Z left right :=
  let l := in_exponentials left in
  let m := in_exponentials right in
  let p := proofs left in
  let q := proofs right in
  pose proof (same_exponents l m p q) as Z;
  cbn [total_exponent all fold_right fst snd] in Z;
  lapply Z; [clear Z; intro Z | ].

(** Two cases. *)
Lemma either d : {0 < d} + {d <= 0}.
Proof. destruct (Rlt_le_dec 0 d); [left | right]; assumption. Qed.

(** ** Functions that rise

    From a start of one sign, with slopes of that sign. *)
Lemma by_some_slope (f f' : R -> R) (x : R) :
  (forall z, 0 <= z -> is_derive f z (f' z)) -> 0 <= x -> exists z, 0 < z /\ f x = f 0 + f' z * x.
Proof.
  intros D [X | <-]; [ | exists 1; split; [lra | ring]].
  destruct (MVT_cor2 f f' 0 x X) as (z & E & Z).
  { intros z [Z _]. apply is_derive_Reals, D, Z. }
  exists z. replace (x - 0) with x in E by ring. split; lra.
Qed.

Lemma rise (f f' : R -> R) (x : R) (i j k : kind) :
  implies k NonNegative = true -> (forall z, 0 <= z -> is_derive f z (f' z)) -> of_kind i (f 0) ->
  (forall z, 0 < z -> of_kind j (f' z)) -> of_kind k x -> of_kind (plus i (product j k)) (f x).
Proof.
  intros N D S P X. destruct (by_some_slope f f' x D) as (z & Z & ->).
  { exact (of_implies k NonNegative x N X). }
  apply of_plus, of_product; auto.
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
Lemma exp_vanishes (r : R) : r < 0 -> is_lim (fun x => exp (r * x)) p_infty 0.
Proof.
  intro P. apply is_lim_comp with m_infty.
  - apply is_lim_exp_m.
  - replace m_infty with (Rbar_mult r p_infty).
    + apply is_lim_scal_l, is_lim_id.
    + simpl. unfold Rbar_mult'. destruct (Rle_dec 0 r); [exfalso; lra | reflexivity].
  - exists 0. intros x _. discriminate.
Qed.

Lemma limit_with_decay (f g : R -> R) (b r y : R) :
  (forall x, 0 < x -> f x = g (/ x) + b * exp (r * x)) -> r < 0 -> ex_derive g 0 -> g 0 = y ->
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
