(** * Polynomials with whole coefficients, and their signs: a program, and its proof. *)
From Coq Require Import List Bool ZArith NArith Ascii String Reals Lra Lia.
Import ListNotations.
Open Scope list_scope.
Open Scope R_scope.

(** ** Polynomials *)
(** A number, or p + x q, where x is the first of the variables and does not occur in p. *)
Inductive poly :=
  | Const (z : Z) | Grow (p q : poly).

Fixpoint value (env : list R) (p : poly) : R :=
  match p with Const z => IZR z | Grow p q => value (tl env) p + hd 0 env * value env q end.

(** A number is always written as a number. *)
Definition grow (p q : poly) : poly :=
  match p, q with Const z, Const 0 => Const z | _, _ => Grow p q end.

Fixpoint variable (n : nat) : poly :=
  match n with O => Grow (Const 0) (Const 1) | S n => Grow (variable n) (Const 0) end.

Fixpoint add_number (z : Z) (p : poly) : poly :=
  match p with Const y => Const (z + y) | Grow p q => Grow (add_number z p) q end.

Fixpoint add (p q : poly) : poly :=
  match p, q with
  | Const z, _ => add_number z q | _, Const z => add_number z p
  | Grow a b, Grow c d => grow (add a c) (add b d)
  end.

Fixpoint times (z : Z) (p : poly) : poly :=
  match p with Const y => Const (z * y) | Grow p q => Grow (times z p) (times z q) end.

Definition scale (z : Z) (p : poly) : poly :=
  match z with 0%Z => Const 0 | _ => times z p end.

(** [f] at the coefficient of each power of the first variable. *)
Fixpoint each (f : poly -> poly) (q : poly) : poly :=
  match q with Const z => grow (f (Const z)) (Const 0) | Grow c d => grow (f c) (each f d) end.

Fixpoint mul (p q : poly) : poly :=
  match p, q with
  | Const z, _ => scale z q | _, Const z => scale z p
  | Grow a b, Grow c d => grow (mul a c) (add (each (mul a) d) (mul b q))
  end.

Scheme Equality for nat.
Scheme Equality for positive.
Scheme Equality for Z.
Scheme Equality for poly.

Lemma value_grow p q env : value env (grow p q) = value (tl env) p + hd 0 env * value env q.
Proof. destruct p, q as [[ | | ] | ]; simpl; ring. Qed.

Lemma value_variable n env : value env (variable n) = nth n env 0.
Proof. revert env; induction n as [ | n I]; intros [ | x env]; simpl; rewrite ?I; simpl; try ring. destruct n; ring. Qed.

Lemma value_add_number z p env : value env (add_number z p) = IZR z + value env p.
Proof.
  revert env; induction p as [y | p I q _]; intro env; simpl.
  - apply plus_IZR.
  - rewrite I. ring.
Qed.

Lemma value_add p q env : value env (add p q) = value env p + value env q.
Proof.
  revert q env; induction p as [z | a I b J]; intros [y | c d] env; cbn [add];
    rewrite ?value_grow, ?value_add_number, ?I, ?J; simpl; ring.
Qed.

Lemma value_times z p env : value env (times z p) = IZR z * value env p.
Proof.
  revert env; induction p as [y | p I q J]; intro env; simpl.
  - apply mult_IZR.
  - rewrite I, J. ring.
Qed.

Lemma value_scale z p env : value env (scale z p) = IZR z * value env p.
Proof. destruct z; cbn [scale]; rewrite ?value_times; simpl; ring. Qed.

Lemma value_each f y q env :
  (forall c, value (tl env) (f c) = y * value (tl env) c) -> value env (each f q) = y * value env q.
Proof. intro F. induction q as [z | c _ d I]; cbn [each]; rewrite value_grow, F, ?I; simpl; ring. Qed.

Lemma value_mul p q env : value env (mul p q) = value env p * value env q.
Proof.
  revert q env; induction p as [z | a I b J]; intros [y | c d] env; cbn [mul]; rewrite ?value_scale; try (simpl; ring).
  rewrite value_grow, value_add, I, J, (value_each _ (value (tl env) a)) by (intro; apply I). simpl. ring.
Qed.

Lemma same_value p q env : poly_beq p q = true -> value env p = value env q.
Proof. intros ->%internal_poly_dec_bl. reflexivity. Qed.

Definition power (p : poly) (d : nat) : poly := Nat.iter d (mul p) (Const 1).

(** A polynomial as text: terms with signs, and variables, each a character, with powers. A 1 is left out. *)
Fixpoint tokens (text : string) (symbol number : N) : list (N * N) :=
  match text with
  | EmptyString => [(symbol, number)]
  | String a text =>
      let a := N_of_ascii a in
      if ((48 <=? a) && (a <=? 57))%N then tokens text symbol (10 * number + (a - 48))
      else (symbol, number) :: tokens text a 0
  end.

Definition of_token (t : N * N) (rest : poly * poly) : poly * poly :=
  let '(symbol, number) := t in
  let '(term, sum) := rest in
  let n := Z.of_N (N.max 1 number) in
  if (symbol =? 43)%N then (Const 1, add (times n term) sum)
  else if (symbol =? 45)%N then (Const 1, add (times (- n) term) sum)
  else if (symbol <? 63)%N then rest
  else (mul (power (variable (N.to_nat (symbol - 63))) (Z.to_nat n)) term, sum).

Definition polynomial (text : string) : poly := snd (fold_right of_token (Const 1, Const 0) (tokens text 0 0)).

(** A polynomial of polynomials. *)
Fixpoint compose (values : list poly) (p : poly) : poly :=
  match p with
  | Const z => Const z
  | Grow p q => add (compose (tl values) p) (mul (hd (Const 0) values) (compose values q))
  end.

Lemma value_compose env p :
  forall values, value env (compose values p) = value (map (value env) values) p.
Proof.
  induction p as [z | p I q J]; intros values; cbn [compose value]; [reflexivity | ].
  rewrite value_add, value_mul, I, J. destruct values as [ | v values]; simpl; ring.
Qed.

(** ** Signs of forms *)
(** What is known of a number: its sign, or that it lies between -1 and 1, or nothing. *)
Inductive kind := Positive | NonNegative | Zero | NonPositive | Negative | Unit | Any.

Definition of_kind (k : kind) (x : R) : Prop :=
  match k with
  | Positive => 0 < x | NonNegative => 0 <= x | Zero => x = 0 | NonPositive => x <= 0
  | Negative => x < 0 | Unit => -1 <= x <= 1 | Any => True
  end.

Definition plus (j k : kind) : kind :=
  match j, k with
  | Zero, k | k, Zero => match k with Unit => Any | k => k end
  | Positive, (Positive | NonNegative) | NonNegative, Positive => Positive
  | NonNegative, NonNegative => NonNegative
  | Negative, (Negative | NonPositive) | NonPositive, Negative => Negative
  | NonPositive, NonPositive => NonPositive | _, _ => Any
  end.

Definition product (j k : kind) : kind :=
  match j, k with
  | Zero, _ | _, Zero => Zero | (Unit | Any), _ | _, (Unit | Any) => Any
  | Positive, k | k, Positive => k | Negative, Negative => Positive
  | Negative, NonPositive | NonPositive, (Negative | NonPositive) | NonNegative, NonNegative => NonNegative
  | _, _ => NonPositive
  end.

Definition is_strict (k : kind) : bool :=
  match k with Positive | Negative => true | _ => false end.

(** Does the second follow from the first? *)
Definition implies (j k : kind) : bool :=
  match j, k with
  | Positive, (Positive | NonNegative) | NonNegative, NonNegative | Zero, (NonNegative | Zero | NonPositive)
  | Negative, (Negative | NonPositive) | NonPositive, NonPositive => true | _, _ => false
  end.

Definition of_number (z : Z) : kind :=
  match z with Zpos _ => Positive | Z0 => Zero | Zneg _ => Negative end.

(** Of a polynomial in units: no value is greater in size. *)
Fixpoint size (p : poly) : Z :=
  match p with Const z => Z.abs z | Grow p q => size p + size q end.

(** No value is less, of the polynomial times a square of at most 1; and times the first unit and such a square. *)
Fixpoint least_of_even (p : poly) : Z :=
  match p with
  | Const z => Z.min 0 z
  | Grow p q =>
      least_of_even p +
      match q with Const z => - Z.abs z | Grow q r => least_of_even r - size q end
  end.
Definition least_of_odd (p : poly) : Z :=
  match p with Const z => - Z.abs z | Grow q r => least_of_even r - size q end.
Fixpoint least (p : poly) : Z :=
  match p with Const z => z | Grow p q => least p + least_of_odd q end.

Definition of_units (p : poly) : kind :=
  match of_number (least p), of_number (least (times (-1) p)) with
  | Positive, _ => Positive | _, Positive => Negative | Zero, Zero => Zero | Zero, _ => NonNegative
  | _, Zero => NonPositive | _, _ => Any
  end.

(** Units come last: for each product of the others stands a polynomial in units. *)
Fixpoint of_form (kinds : list kind) (p : poly) : kind :=
  match kinds, p with
  | _, Const z => of_number z | [], _ => Any
  | Unit :: others, _ => if forallb (fun k => match k with Unit => true | _ => false end) others then of_units p else Any
  | Zero :: others, Grow p _ => of_form others p | Any :: others, Grow p (Const 0) => of_form others p
  | Any :: others, Grow p (Grow (Const 0) q) =>
      plus (of_form others p) (product NonNegative (of_form kinds q))
  | Any :: _, Grow _ _ => Any
  | k :: others, Grow p q => plus (of_form others p) (product k (of_form kinds q))
  end.

Lemma of_plus j k x y : of_kind j x -> of_kind k y -> of_kind (plus j k) (x + y).
Proof. destruct j, k; simpl; try exact (fun _ _ => I); lra. Qed.

Lemma of_product j k x y : of_kind j x -> of_kind k y -> of_kind (product j k) (x * y).
Proof. destruct j, k; simpl; try exact (fun _ _ => I); nra. Qed.

Lemma of_implies j k x : implies j k = true -> of_kind j x -> of_kind k x.
Proof. destruct j, k; simpl; try discriminate; lra. Qed.

Lemma strict_not_zero k x : is_strict k = true -> of_kind k x -> x <> 0.
Proof. destruct k; simpl; try discriminate; lra. Qed.

Lemma sign_of_number z : of_kind (of_number z) (IZR z).
Proof. destruct z; simpl; [reflexivity | apply (IZR_lt 0) | apply (IZR_lt _ 0)]; reflexivity. Qed.

Definition all_units (env : list R) := Forall (of_kind Unit) env.

Lemma units_tl env : all_units env -> all_units (tl env) /\ -1 <= hd 0 env <= 1.
Proof. intros [ | e l E U]; simpl; [split; [constructor | lra] | split; assumption]. Qed.

Lemma value_size p env : all_units env -> - IZR (size p) <= value env p <= IZR (size p).
Proof.
  revert env; induction p as [z | p I q J]; intros env U; simpl.
  - rewrite abs_IZR. unfold Rabs. destruct (Rcase_abs (IZR z)); lra.
  - destruct (units_tl env U) as [T B]. rewrite plus_IZR. specialize (I _ T). specialize (J _ U). nra.
Qed.

Lemma value_least_of p :
  forall env m, all_units env -> 0 <= m <= 1 ->
  IZR (least_of_even p) <= m * value env p /\ IZR (least_of_odd p) <= m * hd 0 env * value env p.
Proof.
  induction p as [z | p I q J]; intros env m U M; destruct (units_tl env U) as [T B].
  - cbn [least_of_even least_of_odd value]. rewrite opp_IZR, abs_IZR. split.
    + destruct (Z.min_spec 0 z) as [[L ->] | [L ->]]; [apply IZR_lt in L | apply IZR_le in L]; nra.
    + assert (-1 <= m * hd 0 env <= 1) by nra. unfold Rabs. destruct (Rcase_abs (IZR z)); nra.
  - change (least_of_even (Grow p q)) with (least_of_even p + least_of_odd q)%Z.
    cbn [least_of_odd value]. rewrite plus_IZR, minus_IZR.
    destruct (I (tl env) m T M) as [P _], (J env m U M) as [_ Q]. split; [lra | ].
    assert (0 <= hd 0 env * hd 0 env <= 1) as S by nra.
    assert (0 <= m * (hd 0 env * hd 0 env) <= 1) as N by (generalize dependent (hd 0 env * hd 0 env); intros; nra).
    destruct (J env (m * (hd 0 env * hd 0 env)) U N) as [Q' _]. assert (- IZR (size p) <= m * hd 0 env * value (tl env) p).
    { pose proof (value_size p (tl env) T). assert (-1 <= m * hd 0 env <= 1) by nra. nra. }
    lra.
Qed.

Lemma value_least p : forall env, all_units env -> IZR (least p) <= value env p.
Proof.
  induction p as [z | p I q _]; intros env U; cbn [least value]; [lra | ].
  rewrite plus_IZR. destruct (units_tl env U) as [T _]. pose proof (I _ T).
  destruct (value_least_of q env 1 U) as [_ Q]; lra.
Qed.

Lemma sign_of_units p env : all_units env -> of_kind (of_units p) (value env p).
Proof.
  intro U. pose proof (value_least p env U) as L. pose proof (value_least (times (-1) p) env U) as M.
  rewrite value_times in M. unfold of_units.
  pose proof (sign_of_number (least p)). pose proof (sign_of_number (least (times (-1) p))).
  destruct (of_number (least p)), (of_number (least (times (-1) p))); simpl in *; try exact I; lra.
Qed.

Lemma sign_of_form kinds : forall p env, Forall2 of_kind kinds env -> of_kind (of_form kinds p) (value env p).
Proof.
  induction kinds as [ | k kinds I].
  { intros [z | p q] env _; [apply sign_of_number | exact Logic.I]. }
  intros p env F. inversion F as [ | k' x l env' K T]; subst k' l env.
  enough (of_kind (of_form (k :: kinds) p) (value (x :: env') p) /\
    match p with Grow _ q => of_kind (of_form (k :: kinds) q) (value (x :: env') q) | _ => True end) by tauto.
  induction p as [z | p _ q [Q R]]; [split; [destruct k; apply sign_of_number | exact Logic.I] | ].
  split; [ | exact Q]. pose proof (I p env' T) as P.
  destruct k; cbn [of_form value hd tl]; try (apply of_plus, of_product; assumption).
  - simpl in K. rewrite K, Rmult_0_l, Rplus_0_r. exact P.
  - destruct (forallb _ kinds) eqn:E; [ | exact Logic.I].
    apply (sign_of_units (Grow p q) (x :: env')). constructor; [exact K | ]. clear - T E.
    induction T as [ | k y ks ys Y T I]; constructor; simpl in E;
      destruct k; try discriminate; [exact Y | apply I, E].
  - destruct q as [[ | | ] | [[ | | ] | ] r]; try exact Logic.I.
    + simpl. rewrite Rmult_0_r, Rplus_0_r. exact P.
    + cbn [value hd tl]. replace (value env' p + _) with (value env' p + x * x * value (x :: env') r) by ring.
      apply of_plus; [exact P | ]. apply of_product; [apply Rle_0_sqr | exact R].
Qed.
