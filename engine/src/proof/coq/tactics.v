(** * Tactics of all proofs: how a goal is passed to the program.

    Quantities of hypotheses get names, and their definitions are substituted; a positive part is replaced
    by its value in each case; the program then decides equalities and signs. Slopes and limits have
    lemmas. *)
From Coq Require Export Reals Lra.
From Coquelicot Require Export Coquelicot.
From Coq Require Import List.
From LIBRARY Require A_Polynomials A_Quotients.
Import ListNotations.
Open Scope R_scope.

Create HintDb functions.

(** Every function of the functions by its formula. *)
Ltac functions := autounfold with functions in *; cbv beta in *.

Lemma positive_not_zero x : 0 < x -> x <> 0.
Proof. lra. Qed.

Lemma negative_not_zero x : 0 < - x -> x <> 0.
Proof. lra. Qed.

(** ** Goals for the program

    What is not computed by the program's steps is a variable for it. *)
Ltac names :=
  repeat
    (let named x := (let y := fresh in set (y := x) in *; clearbody y) in
     match goal with
     | |- context [exp ?a] => pose proof (exp_pos a); named (exp a)
     | |- context [Rmin ?a ?b] => named (Rmin a b)
     | |- context [Rmax ?a ?b] => named (Rmax a b)
     | |- context [?a ^ ?n] => is_var n; named (a ^ n)
     end).

(** The variables that there are, before [l]; and those of [l] that are in a formula. *)
Ltac known l :=
  match goal with
  | x : R |- _ =>
      let l := lazymatch l with context [x :: _] => fail | _ => constr:(x :: l) end in known l
  | _ => l
  end.
Ltac variables x l :=
  lazymatch l with
  | ?v :: ?l => let l := variables x l in lazymatch x with context [v] => constr:(v :: l) | _ => l end
  | _ => l
  end.

(** First those of which no more is known than a sign, with what is known of them. *)
Ltac in_order l units :=
  lazymatch l with
  | [] => constr:((@nil A_Polynomials.sign, units))
  | ?x :: ?l =>
      let put k :=
        (let r := in_order l units in
         lazymatch r with (?signs, ?env) => constr:((k :: signs, x :: env)) end) in
      match goal with
      | _ : -1 <= x <= 1 |- _ => in_order l (x :: units)
      | _ : 0 < x |- _ => put A_Polynomials.Positive
      | _ : 0 <= x |- _ => put A_Polynomials.NonNegative
      | _ => put A_Polynomials.Unknown
      end
  end.

(** A formula of [env], with each step by what the program calls it. *)
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
  lazymatch eval pattern R, Rplus, Rmult, Ropp, Rinv, IZR in f with
  | ?f _ _ _ _ _ _ =>
      let f := constr:(f A_Quotients.formula A_Quotients.Sum A_Quotients.Product A_Quotients.Opposite
                         A_Quotients.Inverse A_Quotients.Literal) in
      let f := at_symbols f O env in
      eval cbv beta in f
  end.

Ltac by_program rule x :=
  let l := known (@nil R) in
  let l := variables x l in
  let r := in_order l (@nil R) in
  lazymatch r with
  | (?signs, ?env) =>
      let f := formula x env in
      let fitting := fresh in
      assert (fitting : A_Polynomials.fits signs env);
      [ cbn [A_Polynomials.fits A_Polynomials.units A_Polynomials.of_sign hd tl];
        repeat (apply conj; [first [exact I | assumption] | ]); exact I
      | exact (rule signs env fitting f ltac:(vm_compute; reflexivity)) ]
  end.

Ltac by_sign :=
  names;
  lazymatch goal with
  | |- 0 < ?x => by_program A_Quotients.above x
  | |- 0 <= ?x => by_program A_Quotients.at_least x
  | |- ?x = 0 => by_program A_Quotients.zero x
  end.

(** The same, where something is known of a product of variables. *)
Ltac by_product E :=
  lazymatch goal with
  | |- 0 < ?x => field_simplify [E] x
  | |- 0 <= ?x => field_simplify [E] x
  | |- ?x = 0 => field_simplify [E] x
  end;
  [by_sign | repeat split; first [apply positive_not_zero; by_sign | apply negative_not_zero; by_sign] ..].

(** A sign, from [0 < v], [0 <= v] or [-1 <= v <= 1] for each of the variables; or a comparison; or that two
    values are equal for all values of the variables. *)
Ltac bounded :=
  lazymatch goal with
  | |- 0 < _ => idtac
  | |- 0 <= _ => idtac
  | |- _ = 0 => idtac
  | |- _ < _ => apply Rminus_gt_0_lt
  | |- _ <= _ => apply Rminus_le_0
  | |- _ = _ => apply Rminus_diag_uniq
  end;
  first [by_sign | match goal with E : _ * _ = _ |- _ => by_product E end | fail 1 "no sign"].

Ltac not_zero := first [apply positive_not_zero; bounded | apply negative_not_zero; bounded].

Ltac divisors := repeat split; not_zero.

(** Each minimum is one of two, whichever is seen to be less; each bracket is its argument or 0. *)
Ltac minima :=
  repeat match goal with
  | |- context [Rmin ?a ?b] =>
      first [rewrite (Rmin_left a b) by bounded | rewrite (Rmin_right a b) by bounded]
  | |- context [Rmax ?a 0] =>
      first [rewrite (Rmax_left a 0) by bounded | rewrite (Rmax_right a 0) by bounded]
  end.

(** An exponential with the exponent 0, or that of another, or its opposite, or the sum of two others, is
    written so. *)
Ltac exponential a :=
  match goal with
  | _ => replace (exp a) with 1 by (symmetry; replace a with 0 by bounded; apply exp_0)
  | |- context [exp ?b] =>
      tryif constr_eq a b then fail else
        first
          [ replace (exp a) with (exp b) by (f_equal; bounded)
          | replace (exp a) with (/ exp b) by (rewrite <- exp_Ropp; f_equal; bounded) ]
  | |- context [exp ?b] =>
      tryif constr_eq a b then fail else
        match goal with
        | |- context [exp ?d] =>
            tryif constr_eq a d then fail else
              replace (exp a) with (exp b * exp d) by (rewrite <- exp_plus; f_equal; bounded)
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

Lemma within x b : 0 <= b - x -> 0 <= b + x -> Rabs x <= b.
Proof. intros. apply Rabs_le. lra. Qed.

(** A sign by one that is supposed: by [m] times its quantity, and by the rest. *)
Lemma multiple h m v : 0 <= h -> 0 <= m -> 0 <= v - m * h -> 0 <= v.
Proof. intros H M. pose proof (Rmult_le_pos m h M H). lra. Qed.

Ltac by_multiple H m :=
  first [apply (multiple _ m _ H) | apply (multiple _ m _ (Rlt_le _ _ H))]; bounded.

(** A minimum or bracket of which nothing else says which of two it is. *)
Lemma minimum a b : 0 < b - a /\ Rmin a b = a \/ 0 <= - (b - a) /\ Rmin a b = b.
Proof.
  destruct (Rlt_le_dec a b) as [H | H]; [left | right]; (split; [lra | ]);
    [apply Rmin_left | apply Rmin_right]; lra.
Qed.

Lemma bracket a : 0 < a /\ Rmax a 0 = a \/ 0 <= - a /\ Rmax a 0 = 0.
Proof.
  destruct (Rlt_le_dec 0 a) as [H | H]; [left | right]; (split; [lra | ]);
    [apply Rmax_left | apply Rmax_right]; lra.
Qed.

(** The end of every proof. *)
Ltac decide_goal :=
  pivots;
  lazymatch goal with
  | |- is_derive _ _ _ => auto_derive; [divisors | decide_goal]
  | |- ex_derive _ _ => auto_derive; divisors
  | |- _ =>
      exponentials; minima;
      lazymatch goal with
      | |- Rabs _ <= _ => apply within; bounded
      | |- _ <> 0 => not_zero
      | |- _ => bounded
      end
  end.

(** ** Hypotheses

    A quantity of known sign gets a name of its own; or, if it is a symbol, the symbol has the sign. *)
Lemma named (P : R -> Prop) q : P q -> exists s, s = q /\ P s.
Proof. intro H. exists q. split; [reflexivity | exact H]. Qed.

Lemma same_sign (P : R -> Prop) q x : P q -> x = q -> P x.
Proof. intros H ->. exact H. Qed.

(** An equation, solved. *)
Lemma solved s q k x y : q = s -> x - y = k * (q - s) -> pivot x y.
Proof. intros -> E. apply Rminus_diag_uniq. rewrite E. ring. Qed.

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
  intro H. apply Rabs_le_between in H.
  destruct (between (a - m) (a + m) x) as (t & T & E); [nra | ].
  exists t. split; [exact T | lra].
Qed.

(** Two cases. *)
Lemma either d : {0 < d} + {0 <= - d}.
Proof. destruct (Rlt_le_dec 0 d) as [H | H]; [left | right]; lra. Qed.

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

(** The sign of [n], which is that at [x] = 0 and that of the slope in [x]. *)
Ltac rising x n :=
  let f := eval pattern x in n in
  lazymatch f with
  | ?f _ =>
      auto_derive_fun f;
      let D := fresh "D" in
      intro D;
      lazymatch type of D with
      | forall z, _ -> is_derive _ z (@?f' z) =>
          let z := fresh "z" in
          destruct (by_some_slope f f' x) as (z & ? & ->);
          [intros; apply D; divisors | bounded | cbv beta; clear D]
      end
  end;
  first
    [ apply Rplus_le_lt_0_compat; [decide_goal | apply Rmult_lt_0_compat; decide_goal]
    | apply Rplus_lt_le_0_compat; [decide_goal | apply Rmult_le_pos; decide_goal]
    | apply Rplus_le_le_0_compat; [decide_goal | apply Rmult_le_pos; decide_goal] ].

(** The goal is about [n] times [rest]. *)
Ltac slope x n rest :=
  pivots;
  lazymatch goal with
  | |- _ < ?v => replace v with (n * rest) by decide_goal; apply Rmult_lt_0_compat
  | |- _ <= ?v => replace v with (n * rest) by decide_goal; apply Rmult_le_pos
  end;
  [rising x n | decide_goal].

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

Ltac at_infinity g :=
  apply (limit_at_infinity _ g); cbv beta; [intros | | ]; decide_goal.
Ltac with_decay g b r :=
  apply (limit_with_decay _ g b r); cbv beta; [intros | | | ]; decide_goal.

(** A continuous function of a power that vanishes. *)
Lemma limit_of_powers (f : R -> R) (rho y : R) :
  0 < 1 - rho * rho -> ex_derive f 0 -> f 0 = y -> is_lim_seq (fun n => f (rho ^ n)) y.
Proof.
  intros P D <-.
  apply (is_lim_seq_continuous f (fun n => rho ^ n) 0).
  - apply continuity_pt_filterlim. apply (ex_derive_continuous f 0 D).
  - apply is_lim_seq_geom. rewrite <- Rabs_R1. apply Rsqr_lt_abs_0. unfold Rsqr. lra.
Qed.
