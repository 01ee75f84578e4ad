(** * Tactics of all proofs: how a goal is passed to the program. *)
(** Numbers that the four operations do not compute are variables there, with equations. *)
From Coq Require Export String Reals Lra List.
From Coquelicot Require Export Coquelicot.
From LIBRARY Require Import A_Polynomials.
From LIBRARY Require A_Powers A_Quotients.
Export A_Quotients(Given, Shown, Squared, Divisor, Steps, Cases).
Export ListNotations.
Open Scope R_scope.

Create HintDb functions.

(** Every function of the functions by its formula. *)
Ltac functions := autounfold with functions in *; cbv beta in *.

(** ** Goals for the program *)
(** A number between -1 and 1. *)
Definition clamp (x : R) : R := Rmax (-1) (Rmin 1 x).

(** The numbers, with their places; those that can contain others last. *)
Ltac numbered env n :=
  lazymatch env with
  | [] => constr:(@nil (R * nat))
  | ?v :: ?env =>
      let l := numbered env (S n) in
      lazymatch v with clamp _ => eval cbv [app] in (l ++ [(v, n)]) | _ => constr:((v, n) :: l) end
  end.

(** A formula of [env], with each step by what the program calls it. *)
Ltac abstracted x env :=
  lazymatch env with
  | [] => x
  | (?v, _) :: ?env => let f := abstracted x env in lazymatch eval pattern v in f with ?f _ => f end
  end.
Ltac at_symbols f env :=
  lazymatch env with
  | [] => f | (_, ?n) :: ?env => at_symbols constr:(f (A_Quotients.Symbol n)) env
  end.
(** A formula in [env], and the function that rounds in it, if any. *)
Ltac rounding := constr:(id).
Ltac formula x env :=
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
      let f := at_symbols f env in
      eval cbv beta in f
  end end.

(** What a claim about a limit supposes of large values, from which nothing follows about others. *)
Definition Later (P : Prop) := True.
Definition later P : Later P := I.

(** What is said of a formula: its sign; or more. *)
Ltac sign T env :=
  let of x k := (let f := formula x env in constr:((f, k))) in
  lazymatch T with
  | 0 < ?x => of x Positive | 0 <= ?x => of x NonNegative | ?x = 0 => of x Zero
  | ?x <= 0 => of x NonPositive | ?x < 0 => of x Negative | -1 <= ?x <= 1 => of x Unit
  end.
Ltac said T env :=
  match T with
  | Later ?T => let a := sign T env in constr:(A_Quotients.Later a)
  | ?S -> ?T => let a := sign S env in let s := said T env in constr:(A_Quotients.If a s)
  | _ => let a := sign T env in constr:(A_Quotients.Is a)
  | ?x = ?y => let f := formula x env in let g := formula y env in constr:(A_Quotients.Replaced f g)
  | ?S /\ ?T => let s := said S env in let t := said T env in constr:(A_Quotients.Either s t)
  end.

Lemma clamped x : -1 <= clamp x <= 1 /\ (-1 <= x <= 1 -> clamp x = x).
Proof. unfold clamp, Rmax, Rmin. destruct (Rle_dec 1 x), (Rle_dec (-1) _); lra. Qed.

(** A power of two. *)
Definition is_power (x : R) : Prop := exists n : Z, x = powerRZ 2 n.

Lemma power_positive x : is_power x -> 0 < x.
Proof. intros [n ->]. apply powerRZ_lt. lra. Qed.

(** What is known of numbers from the start, and what becomes of them. *)
Ltac kind v :=
  match v with
  | exp _ => Positive | Rabs _ => NonNegative | clamp _ => Unit
  | _ => match goal with P : is_power v |- _ => Positive end
  | _ => Any
  end.
Ltac way v x env :=
  match v with
  | x => constr:(A_Quotients.Plain A_Powers.Growing)
  | exp ?a => lazymatch a with context [x] => let f := formula a env in constr:(A_Quotients.Power f) end
  | context [x] => constr:(A_Quotients.Plain A_Powers.Other)
  | _ => constr:(A_Quotients.Plain A_Powers.Fixed)
  end.
Ltac atoms l x env :=
  lazymatch l with
  | [] => constr:(@nil (kind * A_Quotients.way))
  | ?v :: ?l => let k := kind v in let w := way v x env in let r := atoms l x env in constr:((k, w) :: r)
  end.
Ltac known_from_start :=
  repeat (apply Forall2_cons;
    [first [exact I | exact (proj1 (clamped _)) | exact (exp_pos _) | exact (Rabs_pos _) | apply power_positive; assumption] | ]);
  exact (Forall2_nil of_kind).

(** Passes what is said, and its proof, to a tactic. *)
Ltac given T p env all proof tac :=
  lazymatch T with
  | prod ?T ?S => let s := said S env in given T constr:(fst p) env constr:(s :: all) constr:(conj (snd p) proof) tac
  | _ => tac all proof
  end.

Lemma within x b : 0 <= b - x /\ 0 <= b + x -> Rabs x <= b.
Proof. intros. apply Rabs_le. lra. Qed.

Lemma not_zero x : x * / x - 1 = 0 -> x <> 0.
Proof. intros E ->. lra. Qed.

(** By a proof, in numbers [env], from what is given; both may depend on the variable of a limit. *)
Ltac shown env all proof :=
  lazymatch goal with
  | |- Rabs _ <= _ => apply within
  | |- _ <> 0 => apply not_zero | |- _ = 0 => idtac | |- _ = _ => apply Rminus_diag_uniq | |- _ => idtac
  end;
  let G := fresh in let x := fresh in
  pose proof (fun x : R => (eq_refl (env x), all x)) as G;
  autounfold with functions in G; cbv [Rminus Rdiv pow fold_right] in G;
  pose proof 0 as x;
  let T := type of (G x) in
  lazymatch T with
  | prod (?e = _) ?T =>
      let fl := rounding in let l := numbered e O in let a := atoms e x l in let k := eval cbv [map fst] in (map fst a) in
      let w := eval cbv [map snd] in (map snd a) in
      lazymatch eval pattern x in e with
      | ?env _ =>
          given T constr:(snd (G x)) l constr:(@nil A_Quotients.saying) I ltac:(fun s p =>
            lazymatch eval pattern x in p with
            | ?p _ =>
                lazymatch goal with
                | |- is_lim ?F p_infty (Finite ?Y) =>
                    let F := eval cbv beta in (F x) in let f := formula F l in let y := formula Y l in
                    refine (A_Quotients.all_right fl env k w s _ p _ (A_Quotients.Tends f y) proof _ Y (fun _ => eq_refl))
                | |- ?T =>
                    let g := said T l in
                    refine (match A_Quotients.said_right fl env k w s _ p _ proof g _ with ex_intro _ t => t end)
                end
            end)
      end
  end;
  [intro; known_from_start | repeat (split; [intro; reflexivity || exact I | ]); exact I | vm_cast_no_check (eq_refl true)].

(** What remains of a derivative. *)
Ltac derived env all proof := repeat apply conj; try exact I; shown env all proof.

(** ** Laws *)
(** What lies between two values, by something that lies between -1 and 1. *)
Definition parameter (a b x : R) : R := (2 * x - a - b) / (b - a).

Lemma between a b x :
  0 <= (b - x) * (x - a) -> x = (a + b) / 2 + (b - a) / 2 * clamp (parameter a b x).
Proof.
  intro H. unfold parameter. destruct (Req_dec a b) as [<- | D]; [nra | ]. rewrite (proj2 (clamped _)); [field; lra | ].
  enough (0 <= 1 - (2 * x - a - b) / (b - a) * ((2 * x - a - b) / (b - a))) by nra.
  replace (1 - _) with (4 * ((b - x) * (x - a)) / ((b - a) * (b - a))) by (field; lra).
  apply Rdiv_le_0_compat; [lra | ]. apply Rsqr_pos_lt. lra.
Qed.

Lemma near a m x :
  Rabs (x - a) <= m ->
  x = (a - m + (a + m)) / 2 + (a + m - (a - m)) / 2 * clamp (parameter (a - m) (a + m) x).
Proof. intro H. apply Rabs_le_between in H. apply between. nra. Qed.

(** An absolute value, and its factor. *)
Lemma absolute x : Rmin (- x) x = - Rabs x.
Proof. unfold Rmin, Rabs. destruct (Rle_dec (- x) x), (Rcase_abs x); lra. Qed.

Definition factor (x : R) : R := x / Rabs x.

Lemma own_factor x : x - Rabs x * clamp (factor x) = 0.
Proof.
  unfold factor. destruct (Req_dec x 0) as [-> | N]; [rewrite Rabs_R0; ring | ].
  pose proof (Rabs_no_R0 x N) as A. rewrite (proj2 (clamped _)); [field; exact A | ].
  apply Rabs_le_between. unfold Rdiv. rewrite Rabs_mult, Rabs_inv, Rabs_Rabsolu. right. field. exact A.
Qed.

Lemma own_size x : (0 <= x -> Rabs x - x = 0) /\ (x <= 0 -> Rabs x + x = 0).
Proof. split; intro; [rewrite Rabs_pos_eq | rewrite Rabs_left1]; lra. Qed.

(** Two products of exponentials whose exponents have the same sum. *)
Lemma same_exponents l m :
  fold_right Rplus 0 l - fold_right Rplus 0 m = 0 ->
  fold_right (fun a p => exp a * p) 1 l - fold_right (fun a p => exp a * p) 1 m = 0.
Proof.
  assert (S : forall w, fold_right (fun a p => exp a * p) 1 w = exp (fold_right Rplus 0 w)).
  { induction w as [ | a w I]; simpl; [symmetry; apply exp_0 | rewrite I, exp_plus; reflexivity]. }
  rewrite !S. intro E. replace (fold_right Rplus 0 m) with (fold_right Rplus 0 l) by lra. ring.
Qed.

(** The exponential function lies above its tangent at 0, and below a fraction with a pole at 2. *)
Lemma above_tangent a :
  (0 < a -> 0 < exp a - (1 + a)) /\ (a < 0 -> 0 < exp a - (1 + a)) /\ 0 <= exp a - (1 + a).
Proof.
  assert (N : a <> 0 -> 0 < exp a - (1 + a)) by (intro N; pose proof (exp_ineq1 a N); lra).
  repeat split; [intro; apply N; lra | intro; apply N; lra | ].
  destruct (Req_dec a 0) as [-> | D]; [rewrite exp_0; lra | left; exact (N D)].
Qed.

Lemma below_pole a :
  (0 < a -> 0 < 2 + a - (2 - a) * exp a) /\ (0 <= a -> 0 <= 2 + a - (2 - a) * exp a).
Proof.
  assert (S : 0 < a -> 0 < 2 + a - (2 - a) * exp a).
  { intro A. destruct (MVT_cor2 (fun x => 2 + x - (2 - x) * exp x) (fun x => 1 - (1 - x) * exp x) 0 a A) as (z & E & Z).
    { intros z _. apply is_derive_Reals. auto_derive; [exact I | ring]. }
    rewrite exp_0 in E. assert (0 < 1 - (1 - z) * exp z); [ | nra].
    assert (- z <> 0) as N by lra. pose proof (exp_ineq1 (- z) N) as T. pose proof (exp_pos z) as P.
    rewrite exp_Ropp in T. apply (Rmult_lt_compat_r (exp z) _ _ P) in T. rewrite Rinv_l in T; lra. }
  split; [exact S | ]. intros [A | <-]; [left; exact (S A) | rewrite exp_0; lra].
Qed.

(** A continuous function of a power that vanishes. *)
Lemma limit_of_powers (f : R -> R) (rho y : R) :
  0 < 1 - rho * rho -> ex_derive f 0 -> f 0 = y -> is_lim_seq (fun n => f (rho ^ n)) y.
Proof.
  intros P D <-. apply (is_lim_seq_continuous f (fun n => rho ^ n) 0).
  - apply continuity_pt_filterlim. apply (ex_derive_continuous f 0 D).
  - apply is_lim_seq_geom. rewrite <- Rabs_R1. apply Rsqr_lt_abs_0. unfold Rsqr. lra.
Qed.

(** ** Induction *)
(** A conjunction, or an equation of pairs, component by component; each by a lemma. *)
Ltac components := repeat first [apply conj | apply (f_equal2 pair)].
Ltac by_lemma p := first [exact p | symmetry; exact p].
