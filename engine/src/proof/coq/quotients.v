(** * Quotients of polynomials, and certificates for their signs: a program, and its proof. *)
From Coq Require Import Bool Arith ZArith String Reals Lra List.
From LIBRARY Require Import A_Polynomials.
Import ListNotations.
Open Scope R_scope.

(** ** Certificates

    What is known of some polynomials. *)
Definition fact : Type := poly * kind.
Definition holds (env : list R) (a : fact) : Prop := of_kind (snd a) (value env (fst a)).
Definition get (facts : list fact) (i : nat) : fact := nth i facts (Const 0, Zero).

(** An identity l f = r for a polynomial f. Its variables are those of f, and then facts. *)
Inductive certificate := identity (facts : list nat) (left right : string).

(** A variable, with what is known of it from the start, and what facts say of it. *)
Definition stronger (j k : kind) : kind :=
  match j with
  | Unit => Unit
  | _ => if implies j k then j else k
  end.
Definition symbol (atoms : list kind) (facts : list fact) (n : nat) : fact :=
  (variable n,
   fold_right (fun a k => if poly_beq (fst a) (variable n) then stronger k (snd a) else k) (nth n atoms Any) facts).

(** The variables that occur: those of value 0 first, units last. *)
Fixpoint occurs (n : nat) (p : poly) : bool :=
  match n, p with
  | _, Const _ => false
  | O, Grow _ _ => true
  | S n, Grow p q => occurs n p || occurs (S n) q
  end.
Definition rank (k : kind) : nat :=
  match k with
  | Zero => 0
  | Unit => 2
  | _ => 1
  end.
Definition arranged (all : list fact) (p q : poly) : list nat :=
  let own r n := Nat.eqb (rank (snd (get all n))) r && (occurs n p || occurs n q) in
  flat_map (fun r => filter (own r) (seq 0 (length all))) (seq 0 3).
Fixpoint position (n : nat) (l : list nat) : nat :=
  match l with
  | [] => O
  | m :: l => if Nat.eqb n m then O else S (position n l)
  end.

(** The sign of [f], whose variables are [atoms]. *)
Definition certified (atoms : list kind) (facts : list fact) (f : poly) (c : certificate) : kind :=
  let 'identity known a b := c in
  let all := map (symbol atoms facts) (seq 0 (length atoms)) ++ map (get facts) known in
  let (l, r) := (polynomial a, polynomial b) in
  let order := arranged all l r in
  let places := map (fun n => variable (position n order)) (seq 0 (length all)) in
  let (values, kinds) := (map (fun n => fst (get all n)) order, map (fun n => snd (get all n)) order) in
  let (l, r) := (compose places l, compose places r) in
  if is_strict (of_form kinds l) && poly_beq (mul (compose values l) f) (compose values r)
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
  | Bracket (a : formula)
  | Exponential (a : formula)
  | Rounded (a : formula)
  | Polynomial (p : poly).

Section Meaning.
Variables (fl : R -> R) (env : list R).

Fixpoint meaning (f : formula) : R :=
  match f with
  | Literal z => IZR z
  | Symbol n => nth n env 0
  | Sum a b => meaning a + meaning b
  | Product a b => meaning a * meaning b
  | Opposite a => - meaning a
  | Inverse a => / meaning a
  | Minimum a b => Rmin (meaning a) (meaning b)
  | Bracket a => Rmax (meaning a) 0
  | Exponential a => exp (meaning a)
  | Rounded a => fl (meaning a)
  | Polynomial p => value env p
  end.

Scheme Equality for formula.

(** What is said: a sign, or that one formula can be replaced by another; if another has a sign. *)
Inductive saying :=
  | Is (a : formula * kind)
  | Replaced (f g : formula)
  | If (a : formula * kind) (s : saying).

Fixpoint is_true (s : saying) : Prop :=
  match s with
  | Is (f, k) => of_kind k (meaning f)
  | Replaced f g => meaning f = meaning g
  | If (f, k) s => of_kind k (meaning f) -> is_true s
  end.
End Meaning.

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

Section Translation.
Variables (facts : list fact) (products : list (list nat)) (values : list (formula * quotient)).

Definition expand (l : list nat) : poly := fold_right (fun i => mul (fst (get facts i))) (Const 1) l.
Definition kind_of (l : list nat) : kind := fold_right (fun i => product (snd (get facts i))) Positive l.

Definition sum (a b : quotient) : quotient :=
  let '(c, x, y) := shared (bottom a) (bottom b) in
  over (add (mul (top a) (expand y)) (mul (top b) (expand x))) (c ++ x ++ y).
Definition minus (a : quotient) : quotient := over (times (-1) (top a)) (bottom a).
Definition prod (a b : quotient) : quotient := over (mul (top a) (top b)) (bottom a ++ bottom b).

(** The factors of a divisor are a fact, or those of a known product. *)
Definition inverse (a : quotient) : option quotient :=
  option_map (over (expand (bottom a)))
    (find (fun l => is_strict (kind_of l) && poly_beq (expand l) (top a))
      (products ++ map (fun i => [i]) (seq 0 (length facts)))).

(** Does it have a sign? It does if its numerator is 0, or a fact. *)
Definition has_kind (a : quotient) (k : kind) : bool :=
  let d := kind_of (bottom a) in
  existsb (fun f => implies (product (snd f) d) k && poly_beq (fst f) (top a)) ((Const 0, Zero) :: facts).

(** One of two, by the sign of a third. *)
Definition choose (c a b : quotient) : option quotient :=
  if has_kind c NonNegative then Some a else if has_kind c NonPositive then Some b else None.

Fixpoint quotient_of (f : formula) : option quotient :=
  let two (f : quotient -> quotient -> option quotient) a b :=
    match quotient_of a, quotient_of b with Some a, Some b => f a b | _, _ => None end in
  match find (fun v => formula_beq (fst v) f) values with
  | Some (_, a) => Some a
  | None =>
  match f with
  | Literal z => Some (over (Const z) [])
  | Symbol n => Some (over (variable n) [])
  | Sum a b => two (fun a b => Some (sum a b)) a b
  | Product a b => two (fun a b => Some (prod a b)) a b
  | Opposite a => option_map minus (quotient_of a)
  | Inverse a => match quotient_of a with Some a => inverse a | None => None end
  | Minimum a b => two (fun a b => choose (sum b (minus a)) a b) a b
  | Bracket a =>
      match quotient_of a with Some a => choose a a (over (Const 0) []) | None => None end
  | Exponential _ | Rounded _ => None
  | Polynomial p => Some (over p [])
  end
  end.

Definition is_known (f : formula) (k : kind) : bool :=
  match quotient_of f with Some a => has_kind a k | None => false end.
End Translation.

(** ** Proofs

    A step adds something that is supposed, or a fact: a sign that a certificate shows, or a square; or it says that a
    product of facts will be a divisor. *)
Inductive step :=
  | Given (s : saying)
  | Shown (f : string) (c : certificate)
  | Squared (f : string)
  | Divisor (l : list nat).

Definition state : Type := list fact * list (list nat) * list (formula * quotient).

Fixpoint learn (s : saying) (now : state) : option state :=
  let '(facts, products, values) := now in
  match s with
  | Is (f, k) =>
      match quotient_of facts products values f with
      | Some (over p l) => Some (facts ++ [(p, match l with [] => k | _ => product k (kind_of facts l) end)], products, values)
      | None => None
      end
  | Replaced f g =>
      option_map (fun a => (facts, products, (f, a) :: values)) (quotient_of facts products values g)
  | If (f, k) s => if is_known facts products values f k then learn s now else None
  end.

Definition after (atoms : list kind) (s : step) (now : state) : option state :=
  let '(facts, products, values) := now in
  match s with
  | Given s => learn s now
  | Shown f c => let p := polynomial f in Some (facts ++ [(p, certified atoms facts p c)], products, values)
  | Squared f => let p := polynomial f in Some (facts ++ [(mul p p, NonNegative)], products, values)
  | Divisor l => Some (facts, l :: products, values)
  end.

Definition start : state := ([(Const 2, Positive)], [], []).
Definition run (atoms : list kind) (steps : list step) : option state :=
  fold_left (fun now s => match now with Some now => after atoms s now | None => None end) steps (Some start).

(** Do the steps show the signs of the goals? *)
Definition shows (atoms : list kind) (steps : list step) (goals : list (formula * kind)) : bool :=
  match run atoms steps with
  | Some (facts, products, values) => forallb (fun g => is_known facts products values (fst g) (snd g)) goals
  | None => false
  end.

Fixpoint all_hold fl (env : list R) (steps : list step) : Prop :=
  match steps with
  | [] => True
  | Given s :: steps => is_true fl env s /\ all_hold fl env steps
  | _ :: steps => all_hold fl env steps
  end.

Lemma of_nth atoms env n : Forall2 of_kind atoms env -> of_kind (nth n atoms Any) (nth n env 0).
Proof.
  intro A. revert n. induction A as [ | k x ks xs K _ I]; intros [ | n]; simpl;
    [exact Logic.I | exact Logic.I | exact K | apply I].
Qed.

Section Right.
Variables (fl : R -> R) (env : list R) (atoms : list kind).
Variable known_atoms : Forall2 of_kind atoms env.

Lemma of_factor j k l x : is_strict j = true -> of_kind j l -> of_kind k (l * x) -> of_kind (product j k) x.
Proof. destruct j, k; simpl; try discriminate; try exact (fun _ _ _ => I); nra. Qed.

Section Facts.
Variables (facts : list fact) (products : list (list nat)) (values : list (formula * quotient)).
Variable given : Forall (holds env) facts.

Lemma holds_get l i : Forall (holds env) l -> holds env (get l i).
Proof.
  intro L. unfold get. destruct (nth_in_or_default i l (Const 0, Zero)) as [I | ->]; [ | reflexivity].
  rewrite Forall_forall in L. exact (L _ I).
Qed.

Lemma of_stronger j k x : of_kind j x -> of_kind k x -> of_kind (stronger j k) x.
Proof. unfold stronger. destruct j, k; simpl; auto. Qed.

Lemma of_symbol n : holds env (symbol atoms facts n).
Proof.
  unfold symbol, holds. cbn [fst snd]. induction given as [ | a l A L I]; 
    [rewrite value_variable; apply of_nth, known_atoms | ].
  cbn [fold_right]. destruct (poly_beq (fst a) (variable n)) eqn:E; [ | exact (I L)].
  apply of_stronger; [exact (I L) | ]. rewrite <- (same_value _ _ env E). exact A.
Qed.

Lemma of_certificate f c : of_kind (certified atoms facts f c) (value env f).
Proof.
  unfold certified. destruct c as [known a b].
  set (all := map (symbol atoms facts) (seq 0 (length atoms)) ++ map (get facts) known). set (order := arranged all _ _).
  destruct (is_strict _ && poly_beq _ _) eqn:E; [ | exact I]. apply andb_prop in E as [S E].
  apply (same_value _ _ env) in E. rewrite value_mul, !(value_compose env _ (map _ order)) in E.
  assert (A : Forall (holds env) all).
  { apply Forall_app. split; apply Forall_forall; intros q [i [<- _]]%in_map_iff;
      [apply of_symbol | apply holds_get, given]. }
  assert (F : Forall2 of_kind (map (fun n => snd (get all n)) order) (map (value env) (map (fun n => fst (get all n)) order))).
  { clear - A. induction order as [ | i l L]; constructor; [apply holds_get, A | exact L]. }
  apply of_factor with (1 := S) (2 := sign_of_form _ _ _ F). rewrite E. apply sign_of_form, F.
Qed.

Lemma sign_of_product l : of_kind (kind_of facts l) (value env (expand facts l)).
Proof. induction l as [ | i l I]; simpl; [lra | ]. rewrite value_mul. apply of_product; [apply holds_get, given | exact I]. Qed.

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
  unfold inverse, means. destruct (find _ _) as [l | ] eqn:E; [ | discriminate].
  apply find_some in E as [_ [S E]%andb_prop].
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

Lemma means_kind a k x : has_kind facts a k = true -> means a x -> of_kind k x.
Proof.
  intros E A. apply existsb_exists in E as (f & F & [K E]%andb_prop).
  apply of_implies with (1 := K), sign_of_quotient; [ | exact A]. rewrite <- (same_value _ _ env E).
  destruct F as [<- | F]; [reflexivity | ]. rewrite Forall_forall in given. exact (given _ F).
Qed.

Lemma means_choice c a b d z :
  choose facts c a b = Some d -> means c z -> 0 <= z /\ d = a \/ z <= 0 /\ d = b.
Proof.
  unfold choose. intros E C. destruct (has_kind facts c NonNegative) eqn:K; [left | right].
  - injection E as <-. split; [exact (means_kind _ _ _ K C) | reflexivity].
  - destruct (has_kind facts c NonPositive) eqn:L; [ | discriminate].
    injection E as <-. split; [exact (means_kind _ _ _ L C) | reflexivity].
Qed.

Variable known : Forall (fun v => means (snd v) (meaning fl env (fst v))) values.

Lemma means_formula f : forall a, quotient_of facts products values f = Some a -> means a (meaning fl env f).
Proof.
  induction f as [z | n | f I g J | f I g J | f I | f I | f I g J | f I | f I | f I | p]; cbn [quotient_of]; intros a E;
    (destruct (find _ values) as [[h b] | ] eqn:D;
      [injection E as ->; apply find_some in D as [D V];
       rewrite Forall_forall in known; rewrite <- (internal_formula_dec_bl _ _ V); exact (known _ D) | clear D]);
    try (destruct (quotient_of facts products values f) as [b | ]; simpl in E; [specialize (I b eq_refl) | discriminate]);
    try (destruct (quotient_of facts products values g) as [c | ]; simpl in E; [specialize (J c eq_refl) | discriminate]);
    cbn [meaning].
  - injection E as <-. apply (means_poly (Const z)).
  - injection E as <-. rewrite <- value_variable. apply means_poly.
  - injection E as <-. apply means_sum; assumption.
  - injection E as <-. apply means_prod; assumption.
  - injection E as <-. apply means_minus; assumption.
  - apply (means_inverse b); assumption.
  - destruct (means_choice _ _ _ _ _ E (means_sum _ _ _ _ J (means_minus _ _ I))) as [[S ->] | [S ->]].
    + rewrite Rmin_left by lra. exact I.
    + rewrite Rmin_right by lra. exact J.
  - destruct (means_choice _ _ _ _ _ E I) as [[S ->] | [S ->]].
    + rewrite Rmax_left by lra. exact I.
    + rewrite Rmax_right by lra. apply (means_poly (Const 0)).
  - discriminate.
  - discriminate.
  - injection E as <-. apply means_poly.
Qed.

Lemma means_known f k : is_known facts products values f k = true -> of_kind k (meaning fl env f).
Proof.
  unfold is_known. destruct (quotient_of facts products values f) as [a | ] eqn:Q; [ | discriminate].
  intro K. exact (means_kind _ _ _ K (means_formula f a Q)).
Qed.
End Facts.

Definition is_right (now : state) : Prop :=
  let '(facts, products, values) := now in
  Forall (holds env) facts /\ Forall (fun v => means facts (snd v) (meaning fl env (fst v))) values.

Lemma more_facts facts products values p k :
  is_right (facts, products, values) -> of_kind k (value env p) -> is_right (facts ++ [(p, k)], products, values).
Proof.
  intros [F V] P. split; [apply Forall_app; auto | ].
  assert (E : forall l, value env (expand facts l) <> 0 -> expand (facts ++ [(p, k)]) l = expand facts l).
  { induction l as [ | i l I]; simpl; [reflexivity | ]. rewrite value_mul. intro N. unfold get in *.
    destruct (Nat.lt_ge_cases i (length facts)) as [L | L].
    - rewrite app_nth1, I by (try exact L; intro Z; apply N; rewrite Z; ring). reflexivity.
    - destruct N. rewrite (nth_overflow _ _ L). simpl. ring. }
  refine (Forall_impl _ _ V). intros v [N M]. unfold means. rewrite E by exact N. split; assumption.
Qed.

Lemma learn_right s : forall now now', is_right now -> is_true fl env s -> learn s now = Some now' -> is_right now'.
Proof.
  induction s as [[f k] | f g | [f k] s I]; intros [[facts products] values] now' N S; simpl in S |- *.
  - destruct (quotient_of _ _ _ f) as [[p l] | ] eqn:Q; [intros [= <-] | discriminate]. apply more_facts; [exact N | ].
    destruct N as [F V]. destruct (means_formula facts products values F V f _ Q) as [N M]. simpl in N, M.
    destruct l; rewrite M; [simpl; rewrite Rmult_1_r; exact S | apply of_product; [exact S | apply sign_of_product, F]].
  - destruct N as [F V]. destruct (quotient_of _ _ _ g) as [a | ] eqn:Q; [intros [= <-] | discriminate].
    split; [exact F | ]. constructor; [ | exact V]. simpl. rewrite S.
    apply (means_formula facts products values F V g a Q).
  - destruct (is_known _ _ _ f k) eqn:K; [ | discriminate].
    apply I; [exact N | ]. destruct N as [F V]. exact (S (means_known _ _ _ F V f k K)).
Qed.

Lemma run_right steps : forall now now', is_right now -> all_hold fl env steps ->
  fold_left (fun now s => match now with Some now => after atoms s now | None => None end) steps (Some now) = Some now' -> is_right now'.
Proof.
  induction steps as [ | s steps I]; intros now now' N G; cbn [fold_left]; [intros [= <-]; exact N | ].
  destruct (after atoms s now) as [next | ] eqn:A.
  - apply I; [ | destruct s; [apply G | exact G | exact G | exact G]].
    destruct now as [[facts products] values], s as [s | f c | f | l]; cbn [after] in A.
    + apply (learn_right s (facts, products, values)); [exact N | apply G | exact A].
    + injection A as <-. apply more_facts; [exact N | apply of_certificate, N].
    + injection A as <-. apply more_facts; [exact N | rewrite value_mul; apply Rle_0_sqr].
    + injection A as <-. exact N.
  - clear. induction steps as [ | s steps I]; [discriminate | exact I].
Qed.

Lemma start_right : is_right start.
Proof. split; repeat constructor. unfold holds. simpl. lra. Qed.

Fixpoint all_are (goals : list (formula * kind)) : Prop :=
  match goals with
  | [] => True
  | (f, k) :: goals => of_kind k (meaning fl env f) /\ all_are goals
  end.

Lemma shows_right steps goals :
  all_hold fl env steps -> shows atoms steps goals = true -> all_are goals.
Proof.
  intro G. unfold shows, run. destruct (fold_left _ steps _) as [now | ] eqn:R; [ | discriminate].
  apply run_right in R; [ | exact start_right | exact G]. destruct now as [[facts products] values], R as [F V].
  induction goals as [ | [f k] goals I]; [intros; exact Logic.I | ].
  intros [E L]%andb_prop. split; [exact (means_known _ _ _ F V f k E) | exact (I L)].
Qed.

End Right.
