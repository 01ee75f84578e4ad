(** * Quotients of polynomials, and certificates for their signs: a program, and its proof. *)
From Coquelicot Require Import Coquelicot.
From Coq Require Import Bool Arith ZArith String Reals Lra Lia List.
From LIBRARY Require Import A_Polynomials A_Powers.
Import ListNotations.
Open Scope R_scope.

(** ** Certificates *)
(** What is known of some polynomials. *)
Definition fact : Type := poly * kind.
Definition holds (env : list R) (a : fact) : Prop := of_kind (snd a) (value env (fst a)).
Definition get (facts : list fact) (i : nat) : fact := nth i facts (Const 0, Zero).

(** A variable, with what is known of it from the start, and what facts say of it. *)
Definition stronger (j k : kind) : kind :=
  match j with Unit => Unit | _ => if implies j k then j else k end.
Definition symbol (atoms : list kind) (facts : list fact) (n : nat) : fact :=
  (variable n,
   fold_right (fun a k => if poly_beq (fst a) (variable n) then stronger k (snd a) else k) (nth n atoms Any) facts).

(** Variables of value 0 first, units last. *)
Definition rank (k : kind) : nat := match k with Zero => 0 | Unit => 2 | _ => 1 end.
Definition arranged (all : list fact) : list nat :=
  flat_map (fun r => filter (fun n => Nat.eqb (rank (snd (get all n))) r) (seq 0 (length all))) (seq 0 3).
Fixpoint position (n : nat) (l : list nat) : nat :=
  match l with [] => O | m :: l => if Nat.eqb n m then O else S (position n l) end.

(** The sign of [f] by an identity l f = r. Its variables are the [atoms], and then facts. *)
Definition certified (atoms : list kind) (facts : list fact) (f : poly) (known : list nat) (a b : string) : kind :=
  let all := map (symbol atoms facts) (seq 0 (length atoms)) ++ map (get facts) known in
  let (l, r) := (polynomial a, polynomial b) in
  let order := arranged all in
  let places := map (fun n => variable (position n order)) (seq 0 (length all)) in
  let (values, kinds) := (map (fun n => fst (get all n)) order, map (fun n => snd (get all n)) order) in
  let (l, r) := (compose places l, compose places r) in
  if is_strict (of_form kinds l) && poly_beq (mul (compose values l) f) (compose values r)
  then product (of_form kinds l) (of_form kinds r) else Any.

(** ** Quotients *)
(** The denominator is a product of facts, which are not 0. *)
Record quotient := over { top : poly; bottom : list nat }.

(** ** Formulas *)
Inductive formula :=
  | Literal (z : Z) | Symbol (n : nat) | Sum (a b : formula) | Product (a b : formula)
  | Opposite (a : formula) | Inverse (a : formula) | Minimum (a b : formula) | Bracket (a : formula)
  | Exponential (a : formula) | Rounded (a : formula).

Section Meaning.
Variables (fl : R -> R) (env : list R).

Fixpoint meaning (f : formula) : R :=
  match f with
  | Literal z => IZR z | Symbol n => nth n env 0 | Sum a b => meaning a + meaning b
  | Product a b => meaning a * meaning b | Opposite a => - meaning a | Inverse a => / meaning a
  | Minimum a b => Rmin (meaning a) (meaning b) | Bracket a => Rmax (meaning a) 0
  | Exponential a => exp (meaning a) | Rounded a => fl (meaning a)
  end.

Scheme Equality for formula.

(** What is said: a sign; that a formula can be replaced; both if another formula has a sign; two things; a later sign. *)
Inductive saying :=
  | Is (a : formula * kind) | Replaced (f g : formula) | If (a : formula * kind) (s : saying)
  | Either (s t : saying) | Later (a : formula * kind).

Fixpoint is_true (s : saying) : Prop :=
  match s with
  | Is (f, k) => of_kind k (meaning f) | Replaced f g => meaning f = meaning g
  | If (f, k) s => of_kind k (meaning f) -> is_true s | Either s t => is_true s /\ is_true t
  | Later _ => True
  end.

Fixpoint all_true (l : list saying) : Prop :=
  match l with [] => True | s :: l => is_true s /\ all_true l end.
End Meaning.

(** The value where each variable is 1. *)
Fixpoint weight (p : poly) : Z :=
  match p with Const z => z | Grow p q => weight p + weight q end.

(** A list without one [i], if there is any. *)
Fixpoint without (i : nat) (l : list nat) : option (list nat) :=
  match l with [] => None | j :: l => if Nat.eqb i j then Some l else option_map (cons j) (without i l) end.

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

Definition bind {A B} (o : option A) (f : A -> option B) : option B :=
  match o with Some a => f a | None => None end.

Section Translation.
Variables (facts : list fact) (products : list (list nat)) (values : list (formula * quotient)).

Definition factors (l : list nat) : list poly := map (fun i => fst (get facts i)) l.
Definition expand (l : list nat) : poly := fold_right (fun i => mul (fst (get facts i))) (Const 1) l.
Definition kind_of (l : list nat) : kind := fold_right (fun i => product (snd (get facts i))) Positive l.

Definition sum (a b : quotient) : quotient :=
  let '(c, x, y) := shared (bottom a) (bottom b) in
  over (add (mul (top a) (expand y)) (mul (top b) (expand x))) (c ++ x ++ y).
Definition minus (a : quotient) : quotient := over (times (-1) (top a)) (bottom a).
Definition prod (a b : quotient) : quotient := over (mul (top a) (top b)) (bottom a ++ bottom b).

(** The factors of a divisor are those of a known product, or a fact, or twice these. *)
Definition inverse (a : quotient) : option quotient :=
  let all := products ++ map (fun i => [i]) (seq 0 (length facts)) in
  let w := weight (top a) in
  option_map (over (expand (bottom a)))
    (find (fun l => Z.eqb (fold_right Z.mul 1%Z (map weight (factors l))) w && is_strict (kind_of l) && poly_beq (expand l) (top a))
      (all ++ map (fun l => l ++ l) all)).

(** Does it have a sign? It does if its numerator is 0, or a fact. *)
Definition has_kind (a : quotient) (k : kind) : bool :=
  let d := kind_of (bottom a) in
  existsb (fun f => implies (product (snd f) d) k && poly_beq (fst f) (top a)) ((Const 0, Zero) :: facts).

(** One of two, by the sign of a third. *)
Definition choose (c a b : quotient) : option quotient :=
  if has_kind c NonNegative then Some a else if has_kind c NonPositive then Some b else None.

Fixpoint quotient_of (f : formula) : option quotient :=
  let two f a b := bind (quotient_of a) (fun a => bind (quotient_of b) (f a)) in
  match find (fun v => formula_beq (fst v) f) values with
  | Some (_, a) => Some a
  | None =>
  match f with
  | Literal z => Some (over (Const z) []) | Symbol n => Some (over (variable n) [])
  | Sum a b => two (fun a b => Some (sum a b)) a b
  | Product a b => two (fun a b => Some (prod a b)) a b
  | Opposite a => option_map minus (quotient_of a) | Inverse a => bind (quotient_of a) inverse
  | Minimum a b => two (fun a b => choose (sum b (minus a)) a b) a b
  | Bracket a => bind (quotient_of a) (fun a => choose a a (over (Const 0) []))
  | Exponential _ | Rounded _ => None
  end
  end.

Definition is_known (f : formula) (k : kind) : bool :=
  match quotient_of f with Some a => has_kind a k | None => false end.
End Translation.

(** ** Limits *)
(** What becomes of a variable; of an exponential, its exponent decides. *)
Inductive way := Plain (c : course) | Power (f : formula).
Definition plain (w : way) : course := match w with Plain c => c | Power _ => Other end.

Section Growth.
Variables (courses : list course) (facts : list fact).

Definition leading (p : poly) : option poly := limit courses O (degree courses p) p.
Definition degrees (l : list poly) : nat := fold_right (fun p => Nat.add (degree courses p)) O l.
Definition strict (p : poly) : option nat :=
  find (fun i => is_strict (snd (get facts i)) && poly_beq (fst (get facts i)) p) (seq 0 (length facts)).

(** The leading coefficients as facts. *)
Fixpoint all_leading (l : list poly) : option (list nat) :=
  match l with [] => Some [] | p :: l => bind (bind (leading p) strict) (fun i => option_map (cons i) (all_leading l)) end.

(** The sign of a quotient in the end. *)
Definition sign_later (a : quotient) : kind :=
  match all_leading (top a :: factors facts (bottom a)) with Some l => kind_of facts l | None => Any end.
End Growth.

(** ** Proofs *)
(** A step uses what is given, or adds a fact, shown by a certificate, or a square; or it names a later divisor. *)
Inductive step :=
  | Given (i : nat) | Shown (f : string) (known : list nat) (left right : string) | Squared (f : string)
  | Divisor (l : list nat).

Inductive proof :=
  | Steps (l : list step) | Cases (f : string) (positive not_positive : proof).

(** What is to be proved: something that is said, or the limit of a formula. *)
Inductive goal :=
  | Said (s : saying) | Tends (f y : formula).

Definition state : Type := list fact * list (list nat) * list (formula * quotient).

Fixpoint learn (s : saying) (now : state) : option state :=
  let '(facts, products, values) := now in
  match s with
  | Is (f, k) =>
      option_map (fun a => (facts ++ [(top a, match bottom a with [] => k | l => product k (kind_of facts l) end)], products, values))
        (quotient_of facts products values f)
  | Replaced f g =>
      let kept := match f with
        | Symbol _ => filter (fun v => match fst v with Symbol _ => true | _ => false end) values
        | _ => values end in
      option_map (fun a => (facts, products, kept ++ [(f, a)])) (quotient_of facts products values g)
  | If (f, k) s => if is_known facts products values f k then learn s now else None
  | Either s t => match learn s now with Some now => Some now | None => learn t now end
  | Later _ => None
  end.

(** Is it the value of a formula other than a symbol, which is not known yet? *)
Fixpoint is_open (values : list (formula * quotient)) (s : saying) : bool :=
  match s with
  | Replaced (Symbol _) _ => false
  | Replaced f _ => negb (existsb (fun v => formula_beq (fst v) f) values)
  | If _ s => is_open values s | _ => false
  end.

(** Is it known? *)
Fixpoint follows (s : saying) (now : state) : bool :=
  match s with
  | Is (f, k) => let '(facts, products, values) := now in is_known facts products values f k
  | Either s t => follows s now && follows t now | _ => false
  end.

Section Run.
Variables (kinds : list kind) (ways : list way) (given : list saying).

Definition with_values (now : state) : state :=
  fold_left (fun now s => if is_open (snd now) s then match learn s now with Some now => now | None => now end else now)
    given now.

Definition with_fact (p : poly) (k : kind) (now : state) : state :=
  let '(facts, products, values) := now in (facts ++ [(p, k)], products, values).

Definition after (s : step) (now : state) : option state :=
  let '(facts, products, values) := now in
  match s with
  | Given i =>
      let now := with_values now in
      match nth i given (Later (Literal 0, Any)) with
      | Later (f, k) =>
          let '(facts, products, values) := now in
          bind (quotient_of facts products values f)
            (fun a => if implies (sign_later (map plain ways) facts a) k then learn (Is (f, k)) now else None)
      | s => learn s now
      end
  | Shown f known a b => let p := polynomial f in Some (with_fact p (certified kinds facts p known a b) now)
  | Squared f => let p := polynomial f in Some (with_fact (mul p p) NonNegative now)
  | Divisor l => Some (facts, products ++ [l], values)
  end.

Definition start : state := ([(Const 2, Positive)], [], []).
Definition run (steps : list step) (now : state) : option state :=
  fold_left (fun now s => bind now (after s)) steps (Some now).

(** An exponential vanishes if the exponent has a negative leading coefficient. *)
Definition course_of (now : state) (w : way) : course :=
  match w with
  | Plain c => c
  | Power f =>
      let '(facts, products, values) := now in
      let courses := map plain ways in
      match quotient_of facts products values f with
      | Some a =>
          if Nat.ltb (degrees courses (factors facts (bottom a))) (degree courses (top a)) &&
            implies (sign_later courses facts a) Negative
          then Vanishing else Other
      | None => Other
      end
  end.

Definition is_shown (g : goal) (now : state) : bool :=
  let now := with_values now in
  let '(facts, products, values) := now in
  match g with
  | Said s => follows s now
  | Tends f y =>
      let courses := map plain ways in
      match quotient_of facts products values f, quotient_of facts products values y with
      | Some a, Some b =>
          let l := factors facts (bottom a) in
          match limit (map (course_of now) ways) O (degrees courses l) (top a), all_leading courses facts l with
          | Some c, Some known => has_kind facts (sum facts (over c known) (minus b)) Zero
          | _, _ => false
          end
      | _, _ => false
      end
  end.

(** Does a proof show the goal? *)
Fixpoint shows (g : goal) (p : proof) (now : state) : bool :=
  match p with
  | Steps l => match run l now with Some now => is_shown g now | None => false end
  | Cases f a b =>
      let p := polynomial f in
      match limit (map plain ways) O O p with Some q => poly_beq p q | None => false end &&
      shows g a (with_fact p Positive now) && shows g b (with_fact p NonPositive now)
  end.
End Run.

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

Lemma of_certificate f known a b : of_kind (certified atoms facts f known a b) (value env f).
Proof.
  unfold certified.
  set (all := map (symbol atoms facts) (seq 0 (length atoms)) ++ map (get facts) known). set (order := arranged all).
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
  revert m; induction l as [ | i l I]; intro m; simpl; [lra | ]. destruct (without i m) as [r | ] eqn:W.
  - specialize (I r). destruct (shared l r) as [[c x] y]. simpl.
    rewrite (value_without i m r W), !value_mul. destruct I as [-> ->]. split; ring.
  - specialize (I m). destruct (shared l m) as [[c x] y]. simpl. rewrite !value_mul. destruct I as [-> ->]. split; ring.
Qed.

Definition means (a : quotient) (x : R) : Prop :=
  value env (expand facts (bottom a)) <> 0 /\ value env (top a) = x * value env (expand facts (bottom a)).

Lemma means_poly p : means (over p []) (value env p).
Proof. split; simpl; lra. Qed.

Lemma means_sum a b x y : means a x -> means b y -> means (sum facts a b) (x + y).
Proof.
  unfold means, sum. intros [A X] [B Y]. pose proof (value_shared (bottom a) (bottom b)) as D.
  destruct (shared (bottom a) (bottom b)) as [[c l] m]. simpl. destruct D as [D E].
  rewrite value_add, !value_mul, !value_app, X, Y. rewrite D, E in *. split; [ | ring]. intro N.
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
  apply find_some in E as [_ [[_ S]%andb_prop E]%andb_prop].
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
  induction f as [z | n | f I g J | f I g J | f I | f I | f I g J | f I | f I | f I]; cbn [quotient_of]; intros a E;
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
  induction s as [[f k] | f g | [f k] s I | s I s' J | a]; intros [[facts products] values] now' N S; simpl in S |- *.
  - destruct (quotient_of _ _ _ f) as [[p l] | ] eqn:Q; [intros [= <-] | discriminate]. apply more_facts; [exact N | ].
    destruct N as [F V]. destruct (means_formula facts products values F V f _ Q) as [N M]. simpl in N, M.
    destruct l as [ | n l]; rewrite M; [simpl; rewrite Rmult_1_r; exact S | ].
    exact (of_product _ _ _ _ S (sign_of_product facts F (n :: l))).
  - destruct N as [F V]. destruct (quotient_of _ _ _ g) as [a | ] eqn:Q; [intros [= <-] | discriminate].
    split; [exact F | ]. apply Forall_app. split.
    + destruct f; try exact V. apply incl_Forall with (2 := V), incl_filter.
    + constructor; [ | constructor]. simpl. rewrite S. apply (means_formula facts products values F V g a Q).
  - destruct (is_known _ _ _ f k) eqn:K; [ | discriminate].
    apply I; [exact N | ]. destruct N as [F V]. exact (S (means_known _ _ _ F V f k K)).
  - destruct (learn s _) as [next | ] eqn:L; [intros [= <-]; exact (I _ _ N (proj1 S) L) | exact (J _ _ N (proj2 S))].
  - discriminate.
Qed.

Lemma with_values_right given now : all_true fl env given -> is_right now -> is_right (with_values given now).
Proof.
  unfold with_values. revert now. induction given as [ | s given I]; intros now G N; [exact N | ].
  apply I; [apply G | ]. destruct (is_open _ s); [ | exact N]. destruct (learn s now) eqn:L; [ | exact N].
  exact (learn_right s _ _ N (proj1 G) L).
Qed.

Lemma start_right : is_right start.
Proof. split; repeat constructor. unfold holds. simpl. lra. Qed.

Lemma follows_right now s : is_right now -> follows s now = true -> is_true fl env s.
Proof.
  destruct now as [[facts products] values]. intros [F V].
  induction s as [[f k] | | | s I s' J | ]; simpl; try discriminate; [exact (means_known _ _ _ F V f k) | ].
  intros [A B]%andb_prop. exact (conj (I A) (J B)).
Qed.

End Right.

(** ** Numbers that may depend on one that tends to infinity *)
Section Later.
Variables (fl : R -> R) (env : R -> list R) (kinds : list kind) (ways : list way) (given : list saying).
Variable known_kinds : forall x, Forall2 of_kind kinds (env x).
Variable is_given : forall x, all_true fl (env x) given.

Fixpoint all_go (ways : list way) (v : R -> list R) : Prop :=
  match ways with
  | [] => True
  | w :: ways =>
      match w with
      | Plain c => runs c (fun x => hd 0 (v x))
      | Power f => forall x, hd 0 (v x) = exp (meaning fl (env x) f)
      end /\ all_go ways (fun x => tl (v x))
  end.
Variable known_ways : all_go ways env.

Let courses := map plain ways.
Definition finally := Rbar_locally' p_infty.
#[local] Instance later_filter : ProperFilter finally := Rbar_locally'_filter p_infty.
Definition right_later (now : state) := finally (fun x => is_right fl (env x) now).

Lemma plain_run : all_run courses env.
Proof.
  unfold courses. revert known_ways. generalize env at 1 2 as v.
  induction ways as [ | w l I]; intros v G; [exact Logic.I | ].
  split; [ | apply I, G]. destruct w; [apply G | exact Logic.I].
Qed.

Section Facts.
Variable facts : list fact.
Variable given_facts : finally (fun x => Forall (holds (env x)) facts).

Lemma all_leading_right l known :
  all_leading courses facts l = Some known ->
  is_lim (fun x => value (env x) (fold_right mul (Const 1) l) / x ^ degrees courses l) p_infty
    (value (env 0) (expand facts known)) /\
  is_strict (kind_of facts known) = true /\
  forall x, value (env x) (expand facts known) = value (env 0) (expand facts known).
Proof.
  revert known. induction l as [ | p l I]; cbn [all_leading]; intro known.
  { intros [= <-]. repeat split. apply is_lim_ext with (fun _ => 1); [intro; simpl; field | apply is_lim_const]. }
  destruct (leading courses p) as [c | ] eqn:L; [cbn [bind] | discriminate].
  destruct (strict facts c) as [i | ] eqn:S; [cbn [bind] | discriminate].
  destruct (all_leading courses facts l) as [js | ]; [intros [= <-] | discriminate].
  apply find_some in S as [_ [S E]%andb_prop]. destruct (I js eq_refl) as (A & B & C), (limit_right _ _ _ _ _ _ plain_run L) as [D M].
  pose proof (fun e => same_value _ _ e E) as V. change (expand facts (i :: js)) with (mul (fst (get facts i)) (expand facts js)).
  split; [ | split].
  - rewrite value_mul, V. apply is_lim_ext_loc with (2 := limit_of_product _ _ _ _ M A). exists 0. intros x X.
    change (degrees courses (p :: l)) with (degree courses p + degrees courses l)%nat.
    cbn [fold_right]. rewrite value_mul, pow_add. field. split; apply pow_nonzero; lra.
  - simpl. revert S B. destruct (snd (get facts i)), (kind_of facts js); simpl; congruence.
  - intro x. rewrite !value_mul, !V, C, D. reflexivity.
Qed.

Lemma all_leading_sign l known :
  all_leading courses facts l = Some known -> of_kind (kind_of facts known) (value (env 0) (expand facts known)).
Proof.
  intros (_ & _ & C)%all_leading_right. destruct (filter_ex _ given_facts) as [x F]. rewrite <- (C x).
  apply sign_of_product, F.
Qed.

(** A quotient over a power, and its sign in the end. *)
Variables (a : quotient) (f : R -> R).
Variable meaning_of_a : finally (fun x => means (env x) facts a (f x)).
Let d := degrees courses (factors facts (bottom a)).

Lemma limit_of_quotient all e c known :
  all_run all env -> limit all O e (top a) = Some c -> all_leading courses facts (factors facts (bottom a)) = Some known ->
  is_lim (fun x => f x * x ^ d / x ^ e) p_infty (value (env 0) c / value (env 0) (expand facts known)).
Proof.
  intros G T L. pose proof (all_leading_sign _ _ L) as K. apply all_leading_right in L as (L & S & _).
  destruct (limit_right _ _ _ _ _ _ G T) as [_ M].
  assert (Z : Finite (value (env 0) (expand facts known)) <> 0) by (intros [= Z]; exact (strict_not_zero _ _ S K Z)).
  apply is_lim_ext_loc with (2 := limit_of_product _ _ _ _ M (is_lim_inv _ _ _ L Z)).
  refine (filter_imp _ _ _ (filter_and _ _ meaning_of_a (ex_intro _ 0 (fun x X => X) : finally (fun x => 0 < x)))).
  intros x [[B A] X]. replace (value (env x) (fold_right _ _ _)) with (value (env x) (expand facts (bottom a)))
    by (clear; induction (bottom a) as [ | i l I]; [ | simpl; rewrite !value_mul, I]; reflexivity).
  rewrite A. fold d. field. repeat split; try apply pow_nonzero; try lra; exact B.
Qed.

Lemma sign_later_right k :
  implies (sign_later courses facts a) k = true ->
  exists l : R, is_lim (fun x => f x * x ^ d / x ^ degree courses (top a)) p_infty l /\ of_kind k l /\
    finally (fun x => of_kind k (f x)).
Proof.
  unfold sign_later. destruct (all_leading _ _ _) as [known | ] eqn:L; [intro W | discriminate].
  pose proof (all_leading_sign _ _ L) as K. destruct (all_leading_right _ _ L) as (_ & S & _). cbn [all_leading] in L.
  destruct (leading _ _) as [c | ] eqn:T; [cbn [bind] in L | discriminate].
  destruct (strict facts c) as [i | ] eqn:E; [cbn [bind] in L | discriminate].
  destruct (all_leading _ _ (factors facts _)) as [js | ] eqn:B; [injection L as <- | discriminate].
  apply find_some in E as [_ [_ E]%andb_prop]. pose proof (limit_of_quotient _ _ _ _ plain_run T B) as M.
  pose proof (strict_not_zero _ _ (proj1 (proj2 (all_leading_right _ _ B))) (all_leading_sign _ _ B)) as N.
  change (expand facts (i :: js)) with (mul (fst (get facts i)) (expand facts js)) in K.
  rewrite value_mul, (same_value _ _ _ E) in K.
  assert (Q : of_kind (kind_of facts (i :: js)) (value (env 0) c / value (env 0) (expand facts js))).
  { assert (0 < / value (env 0) (expand facts js) * / value (env 0) (expand facts js)) by (apply Rsqr_pos_lt, Rinv_neq_0_compat, N).
    replace (value (env 0) c / _) with (value (env 0) c * value (env 0) (expand facts js)
      * (/ value (env 0) (expand facts js) * / value (env 0) (expand facts js))) by (field; exact N).
    destruct (kind_of facts (i :: js)); try discriminate; simpl in *; nra. }
  exists (value (env 0) c / value (env 0) (expand facts js)). split; [exact M | split; [exact (of_implies _ _ _ W Q) | ]].
  destruct (sign_of_limit _ _ _ _ S Q M) as [m Y]. exists (Rmax 0 m). intros x [X Z]%Rmax_Rlt.
  specialize (Y x Z). apply of_implies with (1 := W). pose proof (pow_lt x d X).
  destruct (kind_of facts (i :: js)); try discriminate; simpl in *; nra.
Qed.
End Facts.

Lemma right_formula facts products values f a :
  right_later (facts, products, values) -> quotient_of facts products values f = Some a ->
  finally (fun x => Forall (holds (env x)) facts) /\ finally (fun x => means (env x) facts a (meaning fl (env x) f)).
Proof.
  intros N Q. split; refine (filter_imp _ _ _ N); intros x [F V];
    [exact F | exact (means_formula fl (env x) facts products values F V f a Q)].
Qed.

Lemma courses_run now v l : right_later now -> all_go l v -> all_run (map (course_of ways now) l) v.
Proof.
  intro N. revert v. induction l as [ | w l I]; intros v G; [exact Logic.I | ].
  split; [ | apply I, G]. destruct G as [G _], w as [c | f]; [exact G | ].
  unfold course_of. destruct now as [[facts products] values].
  destruct (quotient_of facts products values f) as [a | ] eqn:Q; [ | exact Logic.I].
  destruct (right_formula _ _ _ _ _ N Q) as [F M].
  destruct (_ && _) eqn:E; [ | exact Logic.I]. apply andb_prop in E as [D%Nat.ltb_lt W].
  destruct (sign_later_right facts F a _ M _ W) as (r & L & K & _). fold courses in D.
  intro k. apply is_lim_ext with (fun x => x ^ k * exp (meaning fl (env x) f)); [intro x; rewrite G; reflexivity | ].
  apply (exponential_vanishes _ (degree courses (top a) - degrees courses (factors facts (bottom a)) - 1) r); [ | exact K].
  apply is_lim_ext_loc with (2 := L). exists 0. intros x X. replace (degree courses (top a)) with
    (S (degree courses (top a) - degrees courses (factors facts (bottom a)) - 1) + degrees courses (factors facts (bottom a)))%nat
    at 1 by lia.
  rewrite pow_add. field. split; apply pow_nonzero; lra.
Qed.

Lemma with_values_later now : right_later now -> right_later (with_values given now).
Proof. apply (filter_imp (F := finally)). intros x N. exact (with_values_right fl (env x) given now (is_given x) N). Qed.

Lemma all_true_nth e s i : all_true fl e given -> is_true fl e s -> is_true fl e (nth i given s).
Proof.
  clear is_given. intros G S. revert i G. induction given as [ | t l I]; intros [ | i] G; try exact S; [apply G | apply I, G].
Qed.

Lemma learn_later s now now' :
  right_later now -> finally (fun x => is_true fl (env x) s) -> learn s now = Some now' -> right_later now'.
Proof.
  intros N S L. refine (filter_imp _ _ _ (filter_and _ _ N S)). intros x [M T]. exact (learn_right fl (env x) s _ _ M T L).
Qed.

Lemma with_fact_right p k now :
  right_later now -> finally (fun x => of_kind k (value (env x) p)) -> right_later (with_fact p k now).
Proof.
  intros N K. refine (filter_imp _ _ _ (filter_and _ _ N K)). intros x [M L]. destruct now as [[facts products] values].
  exact (more_facts fl (env x) _ _ _ p k M L).
Qed.

Lemma after_right s now now' : right_later now -> after kinds ways given s now = Some now' -> right_later now'.
Proof.
  intros N. destruct now as [[facts products] values] eqn:O, s as [i | f r a b | f | l]; cbn [after].
  - apply with_values_later in N. revert N. generalize (with_values given (facts, products, values)). intros next N.
    pose proof (fun x => all_true_nth (env x) (Later (Literal 0, Any)) i (is_given x) Logic.I) as T.
    destruct (nth i given _) as [ | | | | [f k]]; try (apply learn_later; [exact N | apply filter_forall, T]).
    destruct next as [[fs ps] vs], (quotient_of fs ps vs f) as [a | ] eqn:Q; [cbn [bind] | discriminate].
    destruct (implies _ _) eqn:K; [ | discriminate]. apply learn_later; [exact N | ].
    destruct (right_formula _ _ _ _ _ N Q) as [F M], (sign_later_right fs F a _ M _ K) as (_ & _ & _ & L). exact L.
  - intros [= <-]. apply (with_fact_right _ _ _ N), (filter_imp (F := finally) _ _ (fun x M => of_certificate (env x) kinds (known_kinds x) facts (proj1 M) _ r a b) N).
  - intros [= <-]. apply (with_fact_right _ _ _ N), (filter_forall (F := finally)).
    intro x. rewrite value_mul. apply Rle_0_sqr.
  - intros [= <-]. exact N.
Qed.

Lemma run_right steps now now' : right_later now -> run kinds ways given steps now = Some now' -> right_later now'.
Proof.
  unfold run. revert now. induction steps as [ | s steps I]; intros now N; cbn [fold_left]; [intros [= <-]; exact N | ].
  cbn [bind]. destruct (after kinds ways given s now) as [next | ] eqn:A; [exact (I next (after_right s _ _ N A)) | ].
  clear. induction steps as [ | s steps I]; [discriminate | exact I].
Qed.

Definition holds_later (g : goal) : Prop :=
  match g with
  | Said s => finally (fun x => is_true fl (env x) s)
  | Tends f y => forall z, (forall x, meaning fl (env x) y = z) -> is_lim (fun x => meaning fl (env x) f) p_infty z
  end.

Lemma is_shown_right g now : right_later now -> is_shown ways given g now = true -> holds_later g.
Proof.
  intro N. apply with_values_later in N. unfold is_shown. revert N.
  generalize (with_values given now). clear now. intros now N. pose proof (courses_run now _ _ N known_ways) as G.
  destruct now as [[facts products] values], g as [s | f y].
  { intro E. refine (filter_imp _ _ _ N). intros x M. exact (follows_right fl (env x) _ s M E). }
  destruct (quotient_of facts products values f) as [a | ] eqn:F, (quotient_of facts products values y) as [b | ] eqn:Y;
    try discriminate.
  destruct (limit _ _ _ _) as [c | ] eqn:T; [ | discriminate].
  destruct (all_leading _ _ _) as [known | ] eqn:L; [ | discriminate].
  intros Z z E. destruct (right_formula _ _ _ _ _ N F) as [H M], (right_formula _ _ _ _ _ N Y) as [_ B].
  pose proof (limit_of_quotient facts H a _ M _ _ _ _ G T L) as Q. pose proof (all_leading_sign facts H _ _ L) as K.
  destruct (all_leading_right facts _ _ L) as (_ & S & C), (limit_right _ _ _ _ _ _ G T) as [D _].
  assert (z = value (env 0) c / value (env 0) (expand facts known)) as ->.
  { destruct (filter_ex _ (filter_and _ _ H B)) as [x [P X]].
    assert (V : means (env x) facts (over c known) (value (env 0) c / value (env 0) (expand facts known))).
    { pose proof (strict_not_zero _ _ S K). split; simpl; rewrite (C x); [ | rewrite (D x); field]; assumption. }
    pose proof (means_kind _ _ P _ _ _ Z (means_sum _ _ _ _ _ _ V (means_minus _ _ _ _ X))) as W.
    simpl in W. rewrite (E x) in W. lra. }
  apply is_lim_ext_loc with (2 := Q). exists 0. intros x X. fold courses. field. apply pow_nonzero. lra.
Qed.

Lemma shows_right g p : forall now, right_later now -> shows kinds ways given g p now = true -> holds_later g.
Proof.
  induction p as [l | f a I b J]; intros now N; cbn [shows].
  { destruct (run _ _ _ l now) as [next | ] eqn:R; [exact (is_shown_right g next (run_right _ _ _ N R)) | discriminate]. }
  intros [[E A]%andb_prop B]%andb_prop. destruct (limit _ _ _ _) as [q | ] eqn:L; [ | discriminate].
  assert (C : forall x, value (env x) (polynomial f) = value (env 0) (polynomial f)).
  { intro x. rewrite (same_value _ _ (env x) E), (same_value _ _ (env 0) E). apply (limit_right _ _ _ _ _ _ plain_run L). }
  destruct (Rlt_le_dec 0 (value (env 0) (polynomial f))) as [P | P]; [apply I with (2 := A) | apply J with (2 := B)];
    (apply with_fact_right; [exact N | apply filter_forall; intro x; rewrite C; exact P]).
Qed.

Lemma all_right g p : shows kinds ways given g p start = true -> holds_later g.
Proof. apply shows_right. apply (filter_forall (F := finally)). intro x. apply start_right. Qed.

Lemma said_right p s : shows kinds ways given (Said s) p start = true -> exists x, is_true fl (env x) s.
Proof. intro S. apply all_right, (filter_ex (F := finally)) in S. exact S. Qed.
End Later.
