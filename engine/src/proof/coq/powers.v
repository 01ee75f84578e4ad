(** * How polynomials grow: their leading coefficients, as one variable tends to infinity. *)
From Coq Require Import ZArith Reals Lra List.
From Coquelicot Require Import Coquelicot.
From LIBRARY Require Import A_Polynomials.
Import ListNotations.
Open Scope R_scope.

(** What becomes of a variable; one that vanishes does so against any power. *)
Inductive course := Fixed | Growing | Vanishing | Other.

Definition runs (c : course) (v : R -> R) : Prop :=
  match c with
  | Fixed => forall x, v x = v 0 | Growing => forall x, v x = x
  | Vanishing => forall k, is_lim (fun x => x ^ k * v x) p_infty 0
  | Other => True
  end.

Fixpoint all_run (courses : list course) (env : R -> list R) : Prop :=
  match courses with
  | [] => True
  | c :: courses => runs c (fun x => hd 0 (env x)) /\ all_run courses (fun x => tl (env x))
  end.

Fixpoint degree (courses : list course) (p : poly) : nat :=
  match p with
  | Const _ | Grow _ (Const 0) => match p with Const _ => O | Grow p _ => degree (tl courses) p end
  | Grow p q =>
      Nat.max (degree (tl courses) p)
        (match hd Other courses with Growing => S (degree courses q) | _ => degree courses q end)
  end.

(** The limit of a polynomial times a power of the variable that grows, or over one. *)
Fixpoint limit (courses : list course) (e d : nat) (p : poly) : option poly :=
  match p with
  | Const 0 => Some p
  | Const z => match e with O => Some (Const (match d with O => z | _ => 0 end)) | _ => None end
  | Grow p q =>
      let rest :=
        match hd Other courses, d with
        | Fixed, _ => option_map (grow (Const 0)) (limit courses e d q)
        | Growing, O => limit courses (S e) O q | Growing, S d => limit courses e d q
        | Vanishing, _ => option_map (fun _ => Const 0) (limit courses O (degree courses q) q)
        | Other, _ => match q with Const 0 => Some q | _ => None end
        end in
      match limit (tl courses) e d p, rest with Some a, Some b => Some (add (grow a (Const 0)) b) | _, _ => None end
  end.

Lemma limit_of_inverse : is_lim Rinv p_infty 0.
Proof. replace (Finite 0) with (Rbar_inv p_infty) by reflexivity. apply is_lim_inv; [apply is_lim_id | discriminate]. Qed.

Lemma limit_of_product f g (a b : R) :
  is_lim f p_infty a -> is_lim g p_infty b -> is_lim (fun x => f x * g x) p_infty (a * b).
Proof. intros F G. exact (is_lim_mult f g p_infty a b F G I). Qed.

Lemma limit_of_inverse_power d : is_lim (fun x => / x ^ d) p_infty (Finite (match d with O => 1 | _ => 0 end)).
Proof.
  induction d as [ | d I].
  - apply is_lim_ext with (fun _ => 1); [intro; simpl; field | apply is_lim_const].
  - apply is_lim_ext with (fun x => / x * / x ^ d); [intro; simpl; symmetry; apply Rinv_mult | ].
    pose proof (limit_of_product _ _ _ _ limit_of_inverse I) as L. rewrite Rmult_0_l in L. exact L.
Qed.

Lemma limit_right courses e d p l env :
  all_run courses env -> limit courses e d p = Some l ->
  (forall x, value (env x) l = value (env 0) l) /\
  is_lim (fun x => x ^ e * value (env x) p / x ^ d) p_infty (value (env 0) l).
Proof.
  revert courses e d l env. induction p as [z | p I q J]; intros courses e d l env E.
  { assert (Z : is_lim (fun x => x ^ e * 0 / x ^ d) p_infty 0).
    { apply is_lim_ext with (fun _ => 0); [intro; unfold Rdiv; ring | apply is_lim_const]. }
    destruct (Z.eq_dec z 0) as [-> | N]; [intros [= <-]; exact (conj (fun _ => eq_refl) Z) | ].
    pose proof (limit_of_product _ _ _ _ (is_lim_const (IZR z) p_infty) (limit_of_inverse_power d)) as L.
    destruct z, e; try contradiction; try discriminate; intros [= <-]; (split; [reflexivity | ]);
      (destruct d; [rewrite Rmult_1_r in L | rewrite Rmult_0_r in L];
        (apply is_lim_ext with (2 := L); intro; simpl; unfold Rdiv; ring)). }
  cbn [limit]. assert (T : all_run (tl courses) (fun x => tl (env x)) /\ runs (hd Other courses) (fun x => hd 0 (env x)))
    by (destruct courses; [split; exact Logic.I | split; apply E]).
  destruct T as [T R], (limit (tl courses) e d p) as [a | ] eqn:A; [ | discriminate].
  destruct (match hd Other courses with Fixed => _ | _ => _ end) as [b | ] eqn:B; [intros [= <-] | discriminate].
  destruct (I _ _ _ _ _ T A) as [C L]. enough ((forall x, value (env x) b = value (env 0) b) /\
    is_lim (fun x => x ^ e * (hd 0 (env x) * value (env x) q) / x ^ d) p_infty (value (env 0) b)) as [D M].
  { split; [intro x | ]; rewrite !value_add, !value_grow; simpl; [rewrite C, D; ring | ]. rewrite Rmult_0_r, Rplus_0_r.
    apply is_lim_ext with (2 := is_lim_plus' _ _ _ _ _ L M). intro x. simpl. unfold Rdiv. ring. }
  destruct (hd Other courses); [ | destruct d as [ | d] | | ].
  - destruct (limit courses e d q) as [c | ] eqn:Q; [cbn [option_map] in B | discriminate].
    destruct (J _ _ _ _ _ E Q) as [D M]. replace b with (grow (Const 0) c) by congruence.
    split; [intro x | ]; rewrite !value_grow; simpl; [rewrite D, (R x); ring | rewrite Rplus_0_l].
    apply is_lim_ext with (2 := limit_of_product _ _ _ _ (is_lim_const (hd 0 (env 0)) _) M).
    intro x. rewrite (R x). unfold Rdiv. ring.
  - destruct (J _ _ _ _ _ E B) as [D M]. split; [exact D | ].
    apply is_lim_ext with (2 := M). intro x. rewrite (R x). simpl. unfold Rdiv. ring.
  - destruct (J _ _ _ _ _ E B) as [D M]. split; [exact D | ].
    apply is_lim_ext_loc with (2 := M). exists 0. intros x X. rewrite (R x). simpl. field.
    split; [apply pow_nonzero | ]; lra.
  - destruct (limit courses _ _ q) as [c | ] eqn:C'; [injection B as <- | discriminate]. split; [reflexivity | ].
    pose proof (limit_of_product _ _ _ _ (limit_of_product _ _ _ _ (R (e + degree courses q)%nat)
      (proj2 (J _ _ _ _ _ E C'))) (limit_of_inverse_power d)) as M.
    rewrite !Rmult_0_l in M. apply is_lim_ext_loc with (2 := M). exists 0. intros x X. rewrite pow_add. simpl. field.
    split; apply pow_nonzero; lra.
  - destruct q as [[ | | ] | ]; [injection B as <- | discriminate..]. split; [reflexivity | ].
    apply is_lim_ext with (fun _ => 0); [intro; simpl; unfold Rdiv; ring | apply is_lim_const].
Qed.

(** The sign of what has a limit over a power is in the end that of the limit. *)
Lemma sign_of_limit f d (l : R) k :
  is_strict k = true -> of_kind k l -> is_lim (fun x => f x / x ^ d) p_infty l -> Rbar_locally' p_infty (fun x => of_kind k (f x)).
Proof.
  intros S K L. assert (N : Rbar_locally' p_infty (fun x => of_kind k (f x / x ^ d))).
  { destruct k; try discriminate; [apply (L (fun y => 0 < y)), (open_gt 0) | apply (L (fun y => y < 0)), (open_lt 0)]; exact K. }
  destruct N as [M N]. exists (Rmax 0 M). intros x [X Y]%Rmax_Rlt. specialize (N x Y).
  assert (P : 0 < x ^ d) by (apply pow_lt, X). replace (f x) with (x ^ d * (f x / x ^ d)) by (field; lra).
  destruct k; try discriminate; simpl in *; nra.
Qed.

(** An exponential vanishes against any power, if its exponent falls like a power. *)
Lemma exponential_vanishes f d (l : R) :
  is_lim (fun x => f x / x ^ S d) p_infty l -> l < 0 -> runs Vanishing (fun x => exp (f x)).
Proof.
  intros L N k. assert (M : forall r, r < 0 -> is_lim (fun x => r * x) p_infty m_infty).
  { clear. intros r N. replace m_infty with (Rbar_mult r p_infty); [apply is_lim_scal_l, is_lim_id | ].
    simpl. unfold Rbar_mult'. destruct (Rle_dec 0 r); [exfalso; lra | reflexivity]. }
  assert (V : forall k r, r < 0 -> is_lim (fun x => x ^ k * exp (r * x)) p_infty 0).
  { clear - M. induction k as [ | k I]; intros r N.
    - apply is_lim_ext with (fun x => exp (r * x)); [intro; simpl; ring | ].
      apply is_lim_comp with m_infty; [apply is_lim_exp_m | apply M, N | exists 0; discriminate].
    - apply is_lim_ext with (fun x => / (r / 2) * ((r / 2 * x) * exp (r / 2 * x)) * (x ^ k * exp (r / 2 * x))).
      { intro x. replace (r * x) with (r / 2 * x + r / 2 * x) by lra. rewrite exp_plus. simpl. field. lra. }
      assert (H : is_lim (fun x => (r / 2 * x) * exp (r / 2 * x)) p_infty 0).
      { apply (is_lim_comp (fun y => y * exp y) _ p_infty 0 m_infty);
          [apply is_lim_mul_exp_m | apply M; lra | exists 0; discriminate]. }
      pose proof (limit_of_product _ _ _ _ (limit_of_product _ _ _ _ (is_lim_const (/ (r / 2)) _) H) (I (r / 2) ltac:(lra))) as P.
      rewrite !Rmult_0_r in P. exact P. }
  apply is_lim_le_le_loc with (fun _ => 0) (fun x => x ^ k * exp (l / 2 * x)); [ | apply is_lim_const | apply V; lra].
  destruct (L (fun y => y < l / 2)) as [m B]; [apply (open_lt (l / 2)); lra | ].
  exists (Rmax 1 m). intros x [X Y]%Rmax_Rlt. specialize (B x Y).
  assert (P : 1 <= x ^ d) by (apply pow_R1_Rle; lra). assert (Q : 0 < x ^ k) by (apply pow_lt; lra).
  assert (F : f x <= l / 2 * x).
  { replace (f x) with (f x / x ^ S d * (x * x ^ d)) by (simpl; field; split; try apply pow_nonzero; lra).
    assert (x <= x * x ^ d) by nra. nra. }
  pose proof (exp_pos (f x)). split; [nra | ]. apply Rmult_le_compat_l; [lra | ].
  destruct F as [F | ->]; [left; apply exp_increasing, F | right; reflexivity].
Qed.
