(** * Quotients of polynomials, and certificates for their signs: a program, and its proof. *)
From Coq Require Import List Bool Arith ZArith Reals Lra.
From LIBRARY Require Import A_Polynomials.
Import ListNotations.
Open Scope R_scope.

(** ** Certificates

    What is known of some polynomials. *)
Definition fact : Type := poly * kind.
Definition holds (env : list R) (a : fact) : Prop := of_kind (snd a) (value env (fst a)).
Definition get (facts : list fact) (i : nat) : fact := nth i facts (Const 0, Zero).

(** An identity l f = r. Its variables are facts, the units last, and polynomials of which nothing is known. *)
Inductive known := Fact (i : nat) | Value (f : terms).

(** How [f] is expressed by facts: the n-th number of [env] occurs in it up to the power [d], and is eliminated by
    the i-th fact, which becomes the k-th variable; or all is divided by the number. *)
Inductive solution := Solve (n i k d : nat) | Divide (n : nat).
Inductive certificate :=
  | identity (quantities : list known) (left right : terms)
  | solved (quantities : list known) (left : terms) (ways : list solution) (places : list nat).

Definition quantity (facts : list fact) (k : known) : fact :=
  match k with
  | Fact i => get facts i
  | Value f => (of_terms f, Any)
  end.

(** With a number for the n-th variable. *)
Fixpoint put (n : nat) (z : Z) (p : poly) : poly :=
  match n, p with
  | _, Const y => Const y
  | O, Grow p q => add (grow p (Const 0)) (scale z (put O z q))
  | S n, Grow p q => grow (put n z p) (put (S n) z q)
  end.

(** The n-th variable divided out. *)
Fixpoint divide (n : nat) (p : poly) : poly :=
  match n, p with
  | _, Const y => Const y
  | O, Grow _ q => q
  | S n, Grow p q => grow (divide n p) (divide (S n) q)
  end.

Definition power (p : poly) (d : nat) : poly := Nat.iter d (mul p) (Const 1).

(** A polynomial of degree [d] in the n-th variable, times [c]^[d], if [c] times the variable is [b]. *)
Fixpoint substitute (values : list poly) (n : nat) (c b : poly) (d : nat) (p : poly) : poly :=
  match n, p with
  | _, Const z => scale z (power c d)
  | O, Grow p q => add (mul (power c d) (compose (tl values) p)) (mul b (substitute values O c b (pred d) q))
  | S n, Grow p q =>
      add (substitute (tl values) n c b d p) (mul (hd (Const 0) values) (substitute values (S n) c b d q))
  end.

Definition step_of_solution (facts : list fact) (atoms : list poly) (s : solution) (f : poly) : poly :=
  match s with
  | Solve n i k d =>
      let p := fst (get facts i) in
      let b := put n 0 p in
      substitute atoms n (add (put n 1 p) (times (-1) b)) (add (variable k) (times (-1) b)) d f
  | Divide n => divide n f
  end.

(** The sides l and r of a certificate for [f]. *)
Definition sides (facts : list fact) (f : poly) (c : certificate) : list known * poly * poly :=
  match c with
  | identity l a b => (l, of_terms a, of_terms b)
  | solved l a ways places =>
      let atoms := map variable (seq 0 (length places)) in
      let r := fold_left (fun f s => step_of_solution facts atoms s f) ways f in
      (l, of_terms a, compose (map variable places) r)
  end.

Definition certified (facts : list fact) (f : poly) (c : certificate) : kind :=
  let '(quantities, l, r) := sides facts f c in
  let known := map (quantity facts) quantities in
  let (values, kinds) := (map fst known, map snd known) in
  if is_strict (of_form kinds l) && same (mul (compose values l) f) (compose values r)
  then product (of_form kinds l) (of_form kinds r) else Any.

(** ** Quotients

    The denominator is a product of facts, which are not 0. *)
Record quotient := over { top : poly; bottom : list nat }.

(** ** Formulas *)
Inductive formula :=
  | Literal (z : Z)
  | Symbol (n : nat)
  | Sum (a b : formula)
  | Product (a b : formula)
  | Opposite (a : formula)
  | Inverse (a : formula)
  | Minimum (a b : formula)
  | Bracket (a : formula).

Fixpoint meaning (env : list R) (f : formula) : R :=
  match f with
  | Literal z => IZR z
  | Symbol n => nth n env 0
  | Sum a b => meaning env a + meaning env b
  | Product a b => meaning env a * meaning env b
  | Opposite a => - meaning env a
  | Inverse a => / meaning env a
  | Minimum a b => Rmin (meaning env a) (meaning env b)
  | Bracket a => Rmax (meaning env a) 0
  end.

(** A list without one [i], if there is any. *)
Fixpoint without (i : nat) (l : list nat) : option (list nat) :=
  match l with
  | [] => None
  | j :: l => if Nat.eqb i j then Some l else option_map (cons j) (without i l)
  end.

(** What two lists have in common, and what else is in each. *)
Fixpoint shared (l m : list nat) : list nat * list nat * list nat :=
  match l with
  | [] => ([], [], m)
  | i :: l =>
      match without i m with
      | Some m => let '(c, l, m) := shared l m in (i :: c, l, m)
      | None => let '(c, l, m) := shared l m in (c, i :: l, m)
      end
  end.

Fixpoint find (test : fact -> bool) (facts : list fact) : option nat :=
  match facts with
  | [] => None
  | a :: facts => if test a then Some O else option_map S (find test facts)
  end.

Section Translation.
Variables (facts : list fact) (products : list (list nat)).

Definition expand (l : list nat) : poly := fold_right (fun i => mul (fst (get facts i))) (Const 1) l.
Definition kind_of (l : list nat) : kind := fold_right (fun i => product (snd (get facts i))) Positive l.

Definition sum (a b : quotient) : quotient :=
  let '(c, x, y) := shared (bottom a) (bottom b) in
  over (add (mul (top a) (expand y)) (mul (top b) (expand x))) (c ++ x ++ y).
Definition minus (a : quotient) : quotient := over (times (-1) (top a)) (bottom a).
Definition prod (a b : quotient) : quotient := over (mul (top a) (top b)) (bottom a ++ bottom b).

(** The factors of a divisor: itself, or a known product. *)
Definition factors (p : poly) : option (list nat) :=
  match find (fun a => is_strict (snd a) && same (fst a) p) facts with
  | Some i => Some [i]
  | None => List.find (fun l => is_strict (kind_of l) && same (expand l) p) products
  end.

Definition inverse (a : quotient) : option quotient :=
  match factors (top a) with
  | Some l => if is_strict (kind_of l) && same (expand l) (top a) then Some (over (expand (bottom a)) l) else None
  | None => None
  end.

(** The sign, if that of the numerator is known. *)
Definition sign (a : quotient) : kind :=
  match find (fun f => same (fst f) (top a) && implies (snd f) (snd f)) facts with
  | Some i => if same (fst (get facts i)) (top a) then product (snd (get facts i)) (kind_of (bottom a)) else Any
  | None => Any
  end.

Definition choose (k : kind) (a b : quotient) : option quotient :=
  if implies k NonNegative then Some a else if implies k NonPositive then Some b else None.

Fixpoint quotient_of (f : formula) : option quotient :=
  let two (f : quotient -> quotient -> option quotient) a b :=
    match quotient_of a, quotient_of b with Some a, Some b => f a b | _, _ => None end in
  match f with
  | Literal z => Some (over (Const z) [])
  | Symbol n => Some (over (variable n) [])
  | Sum a b => two (fun a b => Some (sum a b)) a b
  | Product a b => two (fun a b => Some (prod a b)) a b
  | Opposite a => option_map minus (quotient_of a)
  | Inverse a => match quotient_of a with Some a => inverse a | None => None end
  | Minimum a b => two (fun a b => choose (sign (sum b (minus a))) a b) a b
  | Bracket a =>
      match quotient_of a with Some a => choose (sign a) a (over (Const 0) []) | None => None end
  end.
End Translation.

(** ** Proofs

    Each step adds a fact: the next of some suppositions, or what a certificate shows; or it says that a product
    of facts will be a divisor. *)
Inductive step := Next | Shown (f : terms) (c : certificate) | Divisor (l : list nat).

Fixpoint run facts products (given : list (formula * kind)) (steps : list step) :=
  match steps, given with
  | [], _ => Some (facts, products)
  | Next :: steps, (f, k) :: given =>
      match quotient_of facts products f with
      | Some (over p []) => run (facts ++ [(p, k)]) products given steps
      | Some (over p l) => run (facts ++ [(p, product k (kind_of facts l))]) products given steps
      | None => None
      end
  | Next :: _, [] => None
  | Shown f c :: steps, _ =>
      match certified facts (of_terms f) c with
      | Any => None
      | k => run (facts ++ [(of_terms f, k)]) products given steps
      end
  | Divisor l :: steps, _ => run facts (l :: products) given steps
  end.

(** The sign of a goal: a fact, or what a certificate shows. *)
Inductive reason := Known | By (c : certificate).

Definition start : list fact := [(Const 2, Positive)].

Definition shows given steps (r : reason) (f : formula) (k : kind) : bool :=
  match run start [] given steps with
  | Some (facts, products) =>
      match quotient_of facts products f with
      | Some (over p l) =>
          match r with
          | Known => existsb (fun a => same (fst a) p && implies (product (snd a) (kind_of facts l)) k) facts
          | By c => implies (product (certified facts p c) (kind_of facts l)) k
          end
      | None => false
      end
  | None => false
  end.

Definition is_divisor given steps (f : formula) : bool :=
  match run start [] given steps with
  | Some (facts, products) => if quotient_of facts products (Inverse f) then true else false
  | None => false
  end.

Fixpoint all_hold (env : list R) (given : list (formula * kind)) : Prop :=
  match given with
  | [] => True
  | (f, k) :: given => of_kind k (meaning env f) /\ all_hold env given
  end.

Section Right.
Variable env : list R.

Lemma of_factor j k l x : is_strict j = true -> of_kind j l -> of_kind k (l * x) -> of_kind (product j k) x.
Proof. destruct j, k; simpl; try discriminate; try exact (fun _ _ _ => I); nra. Qed.

Variables (facts : list fact) (products : list (list nat)).
Variable given : Forall (holds env) facts.

Lemma holds_get i : holds env (get facts i).
Proof.
  unfold get. destruct (nth_in_or_default i facts (Const 0, Zero)) as [I | ->]; [ | reflexivity].
  rewrite Forall_forall in given. exact (given _ I).
Qed.

Lemma of_certificate f c : of_kind (certified facts f c) (value env f).
Proof.
  unfold certified. destruct (sides facts f c) as [[quantities l] r].
  set (known := map (quantity facts) quantities).
  destruct (is_strict _ && same _ _) eqn:E; [ | exact I]. apply andb_prop in E as [S E].
  apply (same_value _ _ env) in E. rewrite value_mul, !value_compose in E.
  assert (F : Forall2 of_kind (map snd known) (map (value env) (map fst known))).
  { unfold known. clear - given. induction quantities as [ | q l L]; simpl; constructor; [ | exact L].
    destruct q; [apply holds_get | exact I]. }
  apply of_factor with (1 := S) (2 := sign_of_form _ _ _ F). rewrite E. apply sign_of_form, F.
Qed.

Lemma sign_of_product l : of_kind (kind_of facts l) (value env (expand facts l)).
Proof. induction l as [ | i l I]; simpl; [lra | ]. rewrite value_mul. apply of_product; [apply holds_get | exact I]. Qed.

Lemma value_app l m : value env (expand facts (l ++ m)) = value env (expand facts l) * value env (expand facts m).
Proof. induction l as [ | i l I]; simpl; rewrite ?value_mul, ?I; ring. Qed.

Lemma value_without i l m :
  without i l = Some m -> value env (expand facts l) = value env (fst (get facts i)) * value env (expand facts m).
Proof.
  revert m; induction l as [ | j l I]; simpl; intro m; [discriminate | ].
  destruct (Nat.eqb_spec i j) as [-> | _]; rewrite value_mul.
  - intros [= <-]. reflexivity.
  - destruct (without i l) as [r | ]; simpl; [ | discriminate].
    intros [= <-]. simpl. rewrite value_mul, (I r eq_refl). ring.
Qed.

Lemma value_shared l m :
  let '(c, x, y) := shared l m in
  value env (expand facts l) = value env (expand facts c) * value env (expand facts x) /\
  value env (expand facts m) = value env (expand facts c) * value env (expand facts y).
Proof.
  revert m; induction l as [ | i l I]; intro m; simpl; [lra | ].
  destruct (without i m) as [r | ] eqn:W.
  - specialize (I r). destruct (shared l r) as [[c x] y]. simpl.
    rewrite (value_without i m r W), !value_mul. destruct I as [-> ->]. split; ring.
  - specialize (I m). destruct (shared l m) as [[c x] y]. simpl. rewrite !value_mul.
    destruct I as [-> ->]. split; ring.
Qed.

Definition means (a : quotient) (x : R) : Prop :=
  value env (expand facts (bottom a)) <> 0 /\ value env (top a) = x * value env (expand facts (bottom a)).

Lemma means_poly p : means (over p []) (value env p).
Proof. split; simpl; lra. Qed.

Lemma means_sum a b x y : means a x -> means b y -> means (sum facts a b) (x + y).
Proof.
  unfold means, sum. intros [A X] [B Y]. pose proof (value_shared (bottom a) (bottom b)) as D.
  destruct (shared (bottom a) (bottom b)) as [[c l] m]. simpl. destruct D as [D E].
  rewrite value_add, !value_mul, !value_app, X, Y. rewrite D, E in *.
  split; [ | ring]. intro N.
  destruct (Rmult_integral _ _ N) as [C | C]; [apply A; rewrite C; ring | ].
  destruct (Rmult_integral _ _ C) as [L | L]; [apply A | apply B]; rewrite L; ring.
Qed.

Lemma means_minus a x : means a x -> means (minus a) (- x).
Proof. unfold means. intros [A X]. simpl. rewrite value_times, X. split; [exact A | ring]. Qed.

Lemma means_prod a b x y : means a x -> means b y -> means (prod a b) (x * y).
Proof.
  unfold means. intros [A X] [B Y]. simpl. rewrite value_mul, value_app, X, Y.
  split; [apply Rmult_integral_contrapositive_currified; assumption | ring].
Qed.

Lemma means_inverse a b x : inverse facts products a = Some b -> means a x -> x <> 0 /\ means b (/ x).
Proof.
  unfold inverse, means. destruct (factors _ _ _) as [l | ]; [ | discriminate].
  destruct (_ && _) eqn:E; [ | discriminate]. apply andb_prop in E as [S E].
  apply (same_value _ _ env) in E. pose proof (strict_not_zero _ _ S (sign_of_product l)) as N.
  intros [= <-] [A X]. simpl. rewrite E in *. rewrite X in *.
  assert (x <> 0) as Z by (intros ->; apply N; ring). repeat split; [exact Z | exact N | field; exact Z].
Qed.

Lemma sign_of_quotient a j x :
  of_kind j (value env (top a)) -> means a x -> of_kind (product j (kind_of facts (bottom a))) x.
Proof.
  intros J [N X]. pose proof (sign_of_product (bottom a)) as D. rewrite X in J. revert J D N.
  generalize (value env (expand facts (bottom a))). intro d.
  destruct j, (kind_of facts (bottom a)); simpl; try exact (fun _ _ _ => I); intros; nra.
Qed.

Lemma means_sign a x : means a x -> of_kind (sign facts a) x.
Proof.
  intro A. unfold sign. destruct (find _ _) as [i | ]; [ | exact I].
  destruct (same _ _) eqn:E; [ | exact I]. apply sign_of_quotient; [ | exact A].
  rewrite <- (same_value _ _ env E). apply holds_get.
Qed.

Lemma means_choice k a b c x y :
  choose k a b = Some c -> means a x -> means b y -> implies k NonNegative = true /\ means c x \/ implies k NonPositive = true /\ means c y.
Proof.
  unfold choose. destruct (implies k NonNegative); [intros [= <-]; auto | ].
  destruct (implies k NonPositive); [intros [= <-]; auto | discriminate].
Qed.

Lemma means_formula f : forall a, quotient_of facts products f = Some a -> means a (meaning env f).
Proof.
  induction f as [z | n | f I g J | f I g J | f I | f I | f I g J | f I]; simpl; intros a E;
    try (destruct (quotient_of facts products f) as [b | ]; simpl in E; [specialize (I b eq_refl) | discriminate]);
    try (destruct (quotient_of facts products g) as [c | ]; simpl in E; [specialize (J c eq_refl) | discriminate]).
  - injection E as <-. apply (means_poly (Const z)).
  - injection E as <-. rewrite <- value_variable. apply means_poly.
  - injection E as <-. apply means_sum; assumption.
  - injection E as <-. apply means_prod; assumption.
  - injection E as <-. apply means_minus; assumption.
  - apply (means_inverse b); assumption.
  - pose proof (means_sign _ _ (means_sum _ _ _ _ J (means_minus _ _ I))) as S.
    destruct (means_choice _ _ _ _ _ _ E I J) as [[K C] | [K C]]; apply of_implies with (1 := K) in S; simpl in S.
    + rewrite Rmin_left by lra. exact C.
    + rewrite Rmin_right by lra. exact C.
  - pose proof (means_sign _ _ I) as S.
    destruct (means_choice _ _ _ _ _ _ E I (means_poly (Const 0))) as [[K C] | [K C]];
      apply of_implies with (1 := K) in S; simpl in S.
    + rewrite Rmax_left by lra. exact C.
    + rewrite Rmax_right by lra. exact C.
Qed.
End Right.

Lemma run_holds env steps : forall facts products given facts' products',
  Forall (holds env) facts -> all_hold env given ->
  run facts products given steps = Some (facts', products') -> Forall (holds env) facts'.
Proof.
  induction steps as [ | s steps I]; intros facts products given facts' products' F G; cbn [run].
  { intros [= <- _]. exact F. }
  assert (A : forall p k, of_kind k (value env p) -> Forall (holds env) (facts ++ [(p, k)])).
  { intros. apply Forall_app. split; [exact F | repeat constructor; assumption]. }
  destruct s as [ | f c | l].
  - destruct given as [ | [f k] given]; [discriminate | ]. destruct G as [K G].
    destruct (quotient_of facts products f) as [[p l] | ] eqn:Q; [ | discriminate].
    pose proof (means_formula env facts products F f _ Q) as [N M]. simpl in N, M.
    assert (P : of_kind (product k (kind_of facts l)) (value env p)).
    { rewrite M. apply of_product; [exact K | apply sign_of_product, F]. }
    destruct l; apply I; try exact G; apply A; [ | exact P]. rewrite M, Rmult_1_r. exact K.
  - pose proof (of_certificate env facts F (of_terms f) c) as C.
    destruct (certified facts (of_terms f) c); try discriminate; apply I; auto.
  - apply I; assumption.
Qed.

Lemma start_holds env : Forall (holds env) start.
Proof. repeat constructor. unfold holds. simpl. lra. Qed.

Lemma shows_right env given steps r f k :
  all_hold env given -> shows given steps r f k = true -> of_kind k (meaning env f).
Proof.
  intro G. unfold shows. destruct (run start [] given steps) as [[facts products] | ] eqn:R; [ | discriminate].
  apply run_holds with (env := env) in R; [ | apply start_holds | exact G].
  destruct (quotient_of facts products f) as [[p l] | ] eqn:Q; [ | discriminate].
  apply means_formula with (1 := R) in Q.
  assert (S : forall j, implies (product j (kind_of facts l)) k = true -> of_kind j (value env p) ->
    of_kind k (meaning env f)).
  { intros j E J. apply of_implies with (1 := E). exact (sign_of_quotient env facts R (over p l) j _ J Q). }
  destruct r as [ | c]; [ | intro E; exact (S _ E (of_certificate env facts R p c))].
  intro E. apply existsb_exists in E as (a & A & [E K]%andb_prop). apply (S _ K).
  rewrite <- (same_value _ _ env E). rewrite Forall_forall in R. exact (R a A).
Qed.

Lemma is_divisor_right env given steps f : all_hold env given -> is_divisor given steps f = true -> meaning env f <> 0.
Proof.
  intro G. unfold is_divisor.
  destruct (run start [] given steps) as [[facts products] | ] eqn:R; [ | discriminate].
  apply run_holds with (env := env) in R; [ | apply start_holds | exact G]. simpl.
  destruct (quotient_of facts products f) as [a | ] eqn:Q; [ | discriminate].
  apply means_formula with (1 := R) in Q.
  destruct (inverse facts products a) eqn:E; [ | discriminate].
  intros _. apply (means_inverse env facts products R _ _ _ E Q).
Qed.
