(** * Quotients of polynomials, and their signs: a program, and its proof. *)
From Coq Require Import List Bool ZArith Reals Lra.
From LIBRARY Require Import A_Polynomials.
Import ListNotations.
Open Scope R_scope.

(** ** Quotients

    Products over products, none of whose divisors is 0. Products are lists of factors, so that two
    quotients are seen to have some in common: this keeps polynomials small. *)
Record quotient := over { top : list poly; bottom : list poly }.

Definition product (env : list R) (l : list poly) : R := fold_right (fun p x => value env p * x) 1 l.
Definition expand (l : list poly) : poly := fold_right mul (Const 1) l.

(** A list without one [p], if there is any. *)
Fixpoint without (p : poly) (l : list poly) : option (list poly) :=
  match l with
  | [] => None
  | q :: l => if same p q then Some l else option_map (cons q) (without p l)
  end.

(** What two lists have in common, and what else is in each. *)
Fixpoint shared (l m : list poly) : list poly * list poly * list poly :=
  match l with
  | [] => ([], [], m)
  | p :: l =>
      match without p m with
      | Some m => let '(c, l, m) := shared l m in (p :: c, l, m)
      | None => let '(c, l, m) := shared l m in (c, p :: l, m)
      end
  end.

Definition opposite (a : quotient) : quotient := over (Const (-1) :: top a) (bottom a).

Definition sum (a b : quotient) : quotient :=
  let '(c, l, m) := shared (top a) (top b) in
  let '(d, x, y) := shared (bottom a) (bottom b) in
  over (add (expand (y ++ l)) (expand (x ++ m)) :: c) (d ++ x ++ y).

Definition prod (a b : quotient) : quotient :=
  let '(_, l, x) := shared (top a) (bottom b) in
  let '(_, m, y) := shared (top b) (bottom a) in
  over (l ++ m) (y ++ x).

(** Is it positive, or is it negative? *)
Definition strict (signs : list sign) (p : poly) : option bool :=
  match sign_of signs p with
  | Positive => Some true
  | _ => match sign_of signs (times (-1) p) with Positive => Some false | _ => None end
  end.

Definition inverse (signs : list sign) (a : quotient) : option quotient :=
  if forallb (fun p => if strict signs p then true else false) (top a)
  then Some (over (bottom a) (top a)) else None.

(** A polynomial of the same sign as a product: factors of known sign are left out but for that sign. *)
Fixpoint signed (signs : list sign) (l : list poly) : poly :=
  match l with
  | [] => Const 1
  | p :: l =>
      match strict signs p with
      | Some true => signed signs l
      | Some false => times (-1) (signed signs l)
      | None => mul p (signed signs l)
      end
  end.

(** ** Formulas *)
Inductive formula :=
  | Literal (z : Z)
  | Symbol (n : nat)
  | Sum (a b : formula)
  | Product (a b : formula)
  | Opposite (a : formula)
  | Inverse (a : formula).

Fixpoint meaning (env : list R) (f : formula) : R :=
  match f with
  | Literal z => IZR z
  | Symbol n => nth n env 0
  | Sum a b => meaning env a + meaning env b
  | Product a b => meaning env a * meaning env b
  | Opposite a => - meaning env a
  | Inverse a => / meaning env a
  end.

Definition with_two (f : quotient -> quotient -> quotient) (a b : option quotient) : option quotient :=
  match a, b with
  | Some a, Some b => Some (f a b)
  | _, _ => None
  end.

(** A formula as a quotient, if all its divisors have signs. *)
Fixpoint quotient_of (signs : list sign) (f : formula) : option quotient :=
  match f with
  | Literal z => Some (over [Const z] [])
  | Symbol n => Some (over [variable n] [])
  | Sum a b => with_two sum (quotient_of signs a) (quotient_of signs b)
  | Product a b => with_two prod (quotient_of signs a) (quotient_of signs b)
  | Opposite a => option_map opposite (quotient_of signs a)
  | Inverse a => match quotient_of signs a with Some a => inverse signs a | None => None end
  end.

Definition sign_of_formula (signs : list sign) (f : formula) : sign :=
  match quotient_of signs f with
  | Some a => sign_of signs (signed signs (bottom a ++ top a))
  | None => Unknown
  end.

(** Is it 0? *)
Definition is_zero (signs : list sign) (f : formula) : bool :=
  match quotient_of signs f with
  | Some a => same (signed signs (top a)) (Const 0)
  | None => false
  end.

Lemma product_app env l m : product env (l ++ m) = product env l * product env m.
Proof. induction l as [ | p l I]; simpl; rewrite ?I; ring. Qed.

Lemma value_expand env l : value env (expand l) = product env l.
Proof. induction l as [ | p l I]; simpl; rewrite ?value_mul, ?I; reflexivity. Qed.

Lemma product_without env p l m : without p l = Some m -> product env l = value env p * product env m.
Proof.
  revert m; induction l as [ | q l I]; simpl; intro m; [discriminate | ].
  destruct (same p q) eqn:S.
  - intros [= <-]. rewrite (same_value _ _ env S). reflexivity.
  - destruct (without p l) as [r | ]; simpl; [ | discriminate].
    intros [= <-]. simpl. rewrite (I r eq_refl). ring.
Qed.

Lemma product_shared env l m :
  let '(c, x, y) := shared l m in
  product env l = product env c * product env x /\ product env m = product env c * product env y.
Proof.
  revert m; induction l as [ | p l I]; intro m; simpl; [lra | ].
  destruct (without p m) as [r | ] eqn:W.
  - specialize (I r). destruct (shared l r) as [[c x] y]. simpl.
    rewrite (product_without env p m r W). destruct I as [-> ->]. split; ring.
  - specialize (I m). destruct (shared l m) as [[c x] y]. simpl. destruct I as [-> ->]. split; ring.
Qed.

Section Right.
Variables (signs : list sign) (env : list R).
Variable fitting : fits signs env.

Definition means (a : quotient) (x : R) : Prop :=
  product env (bottom a) <> 0 /\ product env (top a) / product env (bottom a) = x.

Ltac not_zero_by A B :=
  let E := fresh in
  intro E; first [apply A; rewrite E; ring | apply B; rewrite E; ring].

Lemma means_one p : means (over [p] []) (value env p).
Proof. split; simpl; [lra | field]. Qed.

Lemma means_opposite a x : means a x -> means (opposite a) (- x).
Proof. unfold means. intros [A <-]. simpl. split; [exact A | field; exact A]. Qed.

Lemma means_sum a b x y : means a x -> means b y -> means (sum a b) (x + y).
Proof.
  unfold means, sum. intros [A <-] [B <-].
  pose proof (product_shared env (top a) (top b)) as T.
  pose proof (product_shared env (bottom a) (bottom b)) as D.
  destruct (shared (top a) (top b)) as [[c l] m], (shared (bottom a) (bottom b)) as [[d p] q]. simpl.
  rewrite value_add, !value_expand, !product_app.
  destruct T as [-> ->], D as [D E]. rewrite D in *. rewrite E in *.
  split; [repeat apply Rmult_integral_contrapositive_currified | field; repeat split]; not_zero_by A B.
Qed.

Lemma means_prod a b x y : means a x -> means b y -> means (prod a b) (x * y).
Proof.
  unfold means, prod. intros [A <-] [B <-].
  pose proof (product_shared env (top a) (bottom b)) as T.
  pose proof (product_shared env (top b) (bottom a)) as D.
  destruct (shared (top a) (bottom b)) as [[c l] p], (shared (top b) (bottom a)) as [[d m] q]. simpl.
  rewrite !product_app. destruct T as [-> T], D as [-> D]. rewrite T, D in *.
  split; [apply Rmult_integral_contrapositive_currified | field; repeat split]; not_zero_by A B.
Qed.

Lemma of_strict p b : strict signs p = Some b -> 0 < (if b then value env p else - value env p).
Proof.
  unfold strict. intro S. pose proof (of_poly signs p env fitting) as P.
  pose proof (of_poly signs (times (-1) p) env fitting) as Q. rewrite value_times in Q.
  destruct (sign_of signs p), (sign_of signs (times (-1) p)); inversion S; simpl in *; lra.
Qed.

Lemma means_inverse a b x : inverse signs a = Some b -> means a x -> means b (/ x).
Proof.
  unfold inverse, means. destruct (forallb _ (top a)) eqn:N; [ | discriminate].
  assert (product env (top a) <> 0).
  { induction (top a) as [ | p l I]; simpl; [lra | ].
    apply andb_prop in N as [P N]. destruct (strict signs p) as [b' | ] eqn:S; [ | discriminate].
    apply Rmult_integral_contrapositive_currified; [ | exact (I N)].
    pose proof (of_strict p b' S). destruct b'; lra. }
  intros [= <-] [A <-]. simpl. split; [assumption | field; auto].
Qed.

Lemma means_formula f a : quotient_of signs f = Some a -> means a (meaning env f).
Proof.
  revert a; induction f as [z | n | f I g J | f I g J | f I | f I]; simpl; intros a E;
    try (destruct (quotient_of signs f) as [b | ]; simpl in E; [specialize (I b eq_refl) | discriminate]);
    try (destruct (quotient_of signs g) as [c | ]; simpl in E; [specialize (J c eq_refl) | discriminate]);
    try (injection E as <-).
  - apply (means_one (Const z)).
  - rewrite <- value_variable. apply means_one.
  - apply means_sum; assumption.
  - apply means_prod; assumption.
  - apply means_opposite; assumption.
  - apply (means_inverse b); assumption.
Qed.

Lemma product_signed l : exists k, 0 < k /\ product env l = k * value env (signed signs l).
Proof.
  induction l as [ | p l (k & K & I)]; cbn [product fold_right signed]; [exists 1; simpl; lra | ].
  change (fold_right _ 1 l) with (product env l). rewrite I.
  destruct (strict signs p) as [b | ] eqn:S; [pose proof (of_strict p b S); destruct b | ].
  - exists (value env p * k). split; [apply Rmult_lt_0_compat; assumption | ring].
  - exists (- value env p * k). rewrite value_times. split; [apply Rmult_lt_0_compat; assumption | ring].
  - exists k. rewrite value_mul. split; [exact K | ring].
Qed.

Lemma of_formula f : of_sign (sign_of_formula signs f) (meaning env f).
Proof.
  unfold sign_of_formula. destruct (quotient_of signs f) as [a | ] eqn:Q; [ | exact I].
  destruct (means_formula f a Q) as [B <-].
  destruct (product_signed (bottom a ++ top a)) as (k & K & P). rewrite product_app in P.
  set (s := value env _) in P. set (b := product env (bottom a)) in *.
  replace (product env (top a) / b) with (k / (b * b) * s).
  - apply of_positive; [apply of_poly, fitting | ].
    apply Rdiv_lt_0_compat; [exact K | apply Rsqr_pos_lt, B].
  - transitivity (k * s / (b * b)); [field; exact B | ]. rewrite <- P. field. exact B.
Qed.

Lemma zero f : is_zero signs f = true -> meaning env f = 0.
Proof.
  unfold is_zero. destruct (quotient_of signs f) as [a | ] eqn:Q; [ | discriminate].
  intro Z. apply (same_value _ _ env) in Z. destruct (means_formula f a Q) as [B <-].
  destruct (product_signed (top a)) as (k & _ & ->). rewrite Z. simpl. field. exact B.
Qed.

Lemma above f : sign_of_formula signs f = Positive -> 0 < meaning env f.
Proof. intro S. pose proof (of_formula f) as P. rewrite S in P. exact P. Qed.

Lemma at_least f : weak (sign_of_formula signs f) = NonNegative -> 0 <= meaning env f.
Proof.
  intro S. pose proof (of_formula f) as P.
  destruct (sign_of_formula signs f); simpl in *; [lra | exact P | discriminate].
Qed.
End Right.
