//! The chapter in Coq: the exported text, and, if Coq is installed, its acceptance.

use crate::coqc::{DEFINITIONS, accepts, code, compile, named, of_claims, scratch, words};
use crate::gallina::{
    Definition, Function, Functions, Read, Recursion, Said, TRIALS, Theorem, drawn, functions, stated, value,
};
use spring_mass_contact::claims::{self, registry};
use spring_mass_contact::formula::claim::{MEMBERS, PRECISION, SCALES};
use spring_mass_contact::formula::statement::{
    Computed, Goal, Proposition, Role, Sequence, Statement, minimum_precision,
};
use spring_mass_contact::formula::{Hypothesis, Relation};
use spring_mass_contact::number::tree::Op;
use spring_mass_contact::number::{Field, PositivePart, Tree};
use spring_mass_contact::proof::coq::{File, theorem_name};
use spring_mass_contact::verify::coq;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

#[test]
fn every_claim_is_a_theorem() {
    let files = coq().files();
    let theorems: Vec<_> = of_claims(&files).flat_map(|file| named(&file.text, "Theorem")).collect();
    assert!(coq().omitted().is_empty(), "{:?}", coq().omitted());
    let statements = claims::statements();
    for statement in &statements {
        let name = theorem_name(statement.equation(), statement.name());
        assert!(theorems.contains(&name.as_str()), "{name}");
    }
    assert_eq!(theorems.len(), statements.len());
    for name in
        ["eq_1_13_rate", "theorem_1_3_3_contracts", "note_5_twice", "remark_1_3_2_enough", "fig_1_2_force"]
    {
        assert!(theorems.contains(&name), "{name}");
    }
}

/// A theorem whose axioms are not printed could rest on anything.
#[test]
fn the_assumptions_of_all_theorems_are_printed() {
    let files = coq().files();
    let [.., of_iterates, last] = &files[..] else { panic!("{files:?}") };
    let by_hand = ["theorem_1_3_3", "eq_1_33_steps", "beyond_2_varying_converges", "contacts_contract"];
    let theorems = named(&of_iterates.text, "Theorem");
    assert!(by_hand.iter().all(|name| theorems.contains(name)), "{theorems:?}");
    let (_, asked) = last.text.split_once("Definition everything :=").unwrap();
    let (asked, print) = asked.split_once('.').unwrap();
    assert_eq!(print.trim(), "Print Assumptions everything.");
    let mut all = BTreeSet::new();
    for File { text, .. } in of_claims(&files).chain([of_iterates]) {
        let text = code(text);
        let (text, together) = text.rsplit_once("Definition ").unwrap();
        let mut together = words(together);
        assert!(all.insert(together.next().unwrap().to_string()));
        let proved: BTreeSet<_> =
            [named(text, "Theorem"), named(text, "Lemma")].concat().into_iter().collect();
        assert_eq!(together.collect::<BTreeSet<_>>(), proved);
    }
    assert_eq!(words(asked).map(String::from).collect::<BTreeSet<_>>(), all);
}

/// Coq defines division by 0, so a formula with a divisor needs more than its theorem.
#[test]
fn every_divisor_is_proved_to_be_nonzero() {
    let (_, functions) = printed();
    let theorems = theorems();
    for statement in claims::statements() {
        let mut divisors = Vec::new();
        for tree in statement.trees() {
            tree.visit(&mut |tree| {
                if let Op::Div(_, by) = tree.op()
                    && !by.symbols().is_empty()
                {
                    divisors.push(by.clone());
                }
            });
        }
        let name = format!("{}_defined", theorem_name(statement.equation(), statement.name()));
        let lemma = theorems.iter().find(|theorem| theorem.name == name);
        assert_eq!(lemma.is_some(), !divisors.is_empty(), "{name}");
        let Some(Read { mut given, follows, .. }) = lemma.map(|lemma| lemma.read(&functions)) else {
            continue;
        };
        given.retain(|said| !matches!(said, Said::PowerOfTwo(..)));
        // Members of rounded sequences need nothing.
        let invariants = statement.invariants().iter().filter(|_| !statement.contains_rounding());
        let own = statement.hypotheses().iter().chain(invariants);
        assert!(are_same_premises(own, &given), "{name} has other premises");
        for divisor in divisors {
            let is_of_it = |said: &Said| matches!(said, Said::Different(a, zero) if *zero == Tree::int(0) && printed_as(&divisor, a));
            assert!(follows.iter().any(is_of_it), "{name} says nothing of {divisor}");
        }
    }
}

#[test]
fn every_function_is_a_definition() {
    let text = definitions_text();
    let definitions = named(&text, "Definition");
    assert_eq!(definitions.len(), registry().formulas().len());
    assert!(
        definitions.contains(&"penalty_deflection") && definitions.contains(&"lagrange_residual_constraint")
    );
    // A call is a call.
    assert!(text.contains("eps * system_reaction c m g l h / penalty_total_stiffness c eps."));
}

/// A definition without a theorem could be any other.
#[test]
fn every_definition_occurs_in_a_theorem() {
    let files = coq().files();
    let texts: Vec<_> = of_claims(&files).map(|file| code(&file.text)).collect();
    let known: BTreeSet<_> = texts.iter().flat_map(|text| stated(text)).flat_map(words).collect();
    let mut unnamed = printed().0;
    unnamed.retain(|definition| !known.contains(definition.name.as_str()));
    assert!(unnamed.is_empty(), "{unnamed:#?}");
}

fn definitions_text() -> String {
    coq().files().into_iter().find(|file| file.name == DEFINITIONS).unwrap().text
}

/// Returns the printed functions.
fn printed() -> (Vec<Definition>, Functions) {
    let definitions = Definition::all(&definitions_text());
    let functions = functions(&definitions);
    (definitions, functions)
}

/// Returns the definitions with one replaced.
fn with(definitions: &[Definition], other: Definition) -> Vec<Definition> {
    let choose = |own: &Definition| if own.name == other.name { other.clone() } else { own.clone() };
    definitions.iter().map(choose).collect()
}

/// Returns a formula with Coq's letters.
fn in_letters(tree: &Tree) -> Tree {
    const LETTERS: [(&str, &str); 13] = [
        ("H", "h"),
        ("ε", "eps"),
        ("ε₄", "eps4"),
        ("λ", "lambda"),
        ("α", "alpha"),
        ("tol", "tol_"),
        ("δu", "du"),
        ("x₁", "x1"),
        ("x₂", "x2"),
        ("2ᵖ", "two_p"),
        ("2ᵃ", "two_a"),
        ("2ᵇ", "two_b"),
        ("2ᶠ", "two_f"),
    ];
    tree.rewrite(&|tree| match tree.op() {
        Op::Symbol(name) => LETTERS.iter().find(|(own, _)| own == name).map(|(_, new)| Tree::symbol(new)),
        _ => None,
    })
}

/// Returns `true` if two formulas agree in their operations, or, since derivatives are printed without zeros
/// and ones, in their values.
fn same(a: &Tree, b: &Tree) -> bool {
    let values = |tree| (0..TRIALS).map(|i| value(tree, &|name| drawn(name, i))).collect::<Vec<_>>();
    let agree = |a: Vec<_>, b| a == b && a.iter().any(Option::is_some);
    a == b || agree(values(a), values(b))
}

/// An independent reader parses the printed text.
#[test]
fn every_definition_equals_its_function() {
    let (_, functions) = printed();
    for formula in registry().formulas() {
        let name = formula.name().replace("::", "_").replace('.', "_");
        let Function { arguments, value: printed } = &functions[&name];
        let symbols = formula.tree.symbols();
        let own = ["c", "m", "g", "l", "H"].into_iter().chain(formula.arguments.iter().copied());
        let own: Vec<_> = own.filter(|name| symbols.contains(name)).collect();
        assert_eq!(own.len(), arguments.len(), "{name}");
        let place = |name| own.iter().position(|known| *known == name);
        let renamed = formula.tree.rewrite(&|tree| match tree.op() {
            Op::Symbol(name) => place(*name).map(|place| Tree::symbol(arguments[place])),
            _ => None,
        });
        assert!(same(&renamed, printed), "{name}");
    }
}

/// Returns `true` if a formula equals a printed one.
fn printed_as(own: &Tree, printed: &Tree) -> bool {
    same(&in_letters(own), printed)
}

fn sign_printed_as(relation: Relation, own: &Tree, printed: &Said) -> bool {
    match (relation, printed) {
        (Relation::Positive, Said::Less(zero, a)) => *zero == Tree::int(0) && printed_as(own, a),
        (Relation::NonNegative, Said::AtMost(zero, a)) => *zero == Tree::int(0) && printed_as(own, a),
        (Relation::Zero, Said::Equal(a, zero)) => *zero == Tree::int(0) && printed_as(own, a),
        _ => false,
    }
}

fn said_as(own: &Proposition, printed: &Said) -> bool {
    match (own, printed) {
        (Proposition::Equal(a, b), Said::Equal(left, right)) => printed_as(a, left) && printed_as(b, right),
        (Proposition::Sign(relation, a), said) => sign_printed_as(*relation, a, said),
        (Proposition::Within(a, bound), Said::AtMost(size, b)) => {
            printed_as(&a.abs(), size) && printed_as(bound, b)
        }
        (Proposition::Derivative(of, by, is), Said::Derivative(a, x, b))
        | (Proposition::Limit(of, by, is), Said::Limit(a, x, b)) => {
            in_letters(&Tree::symbol(by)) == Tree::symbol(x) && printed_as(of, a) && printed_as(is, b)
        }
        _ => false,
    }
}

/// Returns the powers of two in a theorem with the names of their exponents, the precision first.
fn powers_of_two(statement: &Statement) -> Vec<(&'static str, &'static str)> {
    const NAMES: [(&str, &str, &str); 4] = [
        (PRECISION, "two_p", "prec"),
        (SCALES[0], "two_a", "power_a"),
        (SCALES[1], "two_b", "power_b"),
        (SCALES[2], "two_f", "power_f"),
    ];
    let spoken_of: BTreeSet<_> = statement.trees().flat_map(Tree::symbols).collect();
    let own =
        NAMES.into_iter().filter(|(name, ..)| statement.contains_rounding() && spoken_of.contains(name));
    own.map(|(_, power, of)| (power, of)).collect()
}

/// Returns `true` if the premises of a part of the claim are those of the claim in the same order, preceded by
/// those on powers of two if it contains roundings.
fn has_same_premises(statement: &Statement, part: &Proposition, given: &[Said]) -> bool {
    let powers = powers_of_two(statement);
    let (first, rest) = given.split_at(powers.len().min(given.len()));
    let is_power =
        |(own, said): (&(&str, &str), &Said)| matches!(said, Said::PowerOfTwo(x, of) if (*x, *of) == *own);
    // A limit has no premises on its variable.
    let grows = |name: &str| matches!(part, Proposition::Limit(_, by, _) if *by == name);
    let own = statement.hypotheses().iter().filter(|own| !own.value.symbols().into_iter().any(grows));
    first.len() == powers.len() && powers.iter().zip(first).all(is_power) && are_same_premises(own, rest)
}

/// The minimum precision is a premise on the exponent.
fn are_same_premises<'a>(own: impl Iterator<Item = &'a Hypothesis>, printed: &[Said]) -> bool {
    let own: Vec<_> = own.filter(|own| **own != minimum_precision()).collect();
    own.len() == printed.len()
        && own.iter().zip(printed).all(|(own, said)| sign_printed_as(own.relation, &own.value, said))
}

/// Returns `true` if the statement is about the same sequence.
fn is_the_same_sequence(
    own: &Sequence,
    computed: &[Computed],
    printed: &Recursion,
    follows: &[Said],
) -> bool {
    let all_printed_as = |own: &[Tree], printed: &[Tree]| {
        own.len() == printed.len() && own.iter().zip(printed).all(|(own, printed)| printed_as(own, printed))
    };
    let members: Vec<_> = MEMBERS[..own.member.len()].iter().map(|name| Tree::symbol(name)).collect();
    let is_closed = |(member, closed): (&Tree, &Tree)| Proposition::Equal(member.clone(), closed.clone());
    let is_near = |(of, bound): &(Tree, Tree)| Proposition::Within(of.clone(), bound.clone());
    let says: Vec<_> = match &own.within[..] {
        [] => members.iter().zip(&own.member).map(is_closed).collect(),
        within => within.iter().map(is_near).collect(),
    };
    let is_computed = |(own, (name, by)): (&Computed, &(&'static str, Tree))| {
        printed_as(&Tree::symbol(own.symbol), &Tree::symbol(name)) && printed_as(&own.formula, by)
    };
    let names: Vec<_> = printed.members.iter().map(|name| Tree::symbol(name)).collect();
    computed.len() == printed.computed.len()
        && computed.iter().zip(&printed.computed).all(is_computed)
        && all_printed_as(&members, &names)
        && printed_as(&own.ratio, &printed.ratio)
        && all_printed_as(&own.start, &printed.start)
        && all_printed_as(&own.step, &printed.step)
        && all_said_as(&says, follows)
}

fn all_said_as(own: &[Proposition], said: &[Said]) -> bool {
    own.len() == said.len() && own.iter().zip(said).all(|(own, said)| said_as(own, said))
}

/// Returns `true` if the conclusion is that of the claim, with computed quantities where they are computed.
fn has_same_conclusion(statement: &Statement, Read { follows, of, .. }: &Read) -> bool {
    let computed = statement.computed();
    match (statement.conclusion(), of, &follows[..]) {
        (Some(own), Some(printed), _) => is_the_same_sequence(own, computed, printed, follows),
        (Some(own), None, [Said::LimitOfPowers(ratio, of, to)]) => {
            let own = [&own.ratio, &own.member[0], own.limit.as_ref().unwrap()];
            own.into_iter().zip([ratio, of, to]).all(|(own, printed)| printed_as(own, printed))
        }
        (None, None, _) => {
            let by = |tree: &Tree| {
                let put = |tree: Tree, own: &Computed| tree.substitute(&[(own.symbol, own.formula.clone())]);
                computed.iter().rev().fold(tree.clone(), put)
            };
            let own = statement.goals().iter().find(|goal| goal.role == Role::Claim).unwrap();
            let own = match &own.proposition {
                Proposition::Within(of, bound) => Proposition::Within(by(of), by(bound)),
                other => other.clone(),
            };
            all_said_as(&[own], follows)
        }
        _ => false,
    }
}

fn theorems() -> Vec<Theorem> {
    of_claims(&coq().files()).flat_map(|file| Theorem::all(&file.text)).collect()
}

/// A theorem weaker than its claim would be as easy to prove.
#[test]
fn every_theorem_states_its_claim() {
    let (_, functions) = printed();
    let theorems = theorems();
    for statement in claims::statements() {
        let name = theorem_name(statement.equation(), statement.name());
        let theorem = theorems.iter().find(|theorem| theorem.name == name).unwrap();
        assert_eq!(theorem.rounds(), statement.contains_rounding(), "{name}");
        let read = theorem.read(&functions);
        let first = &statement.goals()[0].proposition;
        assert!(has_same_premises(&statement, first, &read.given), "{name} has other premises");
        assert!(has_same_conclusion(&statement, &read), "{name} says something else");
        // Lemmas state the rates of limits.
        for Goal { part, proposition, .. } in
            statement.goals().iter().skip(1).filter(|_| statement.kind() == "limit")
        {
            let name = format!("{name}_{}", part.replace(' ', "_"));
            let lemma = theorems.iter().find(|lemma| lemma.name == name).expect(&name);
            let Read { given, follows, .. } = lemma.read(&functions);
            assert!(has_same_premises(&statement, proposition, &given), "{name} has other premises");
            assert!(all_said_as(std::slice::from_ref(proposition), &follows), "{name} says something else");
        }
    }
}

#[test]
fn no_theorem_is_false() {
    let (_, functions) = printed();
    let wrong: Vec<_> = theorems()
        .into_iter()
        .filter(|theorem| theorem.is_false_somewhere(&functions))
        .map(|theorem| theorem.name)
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// fl is the rounding to nearest of Flocq in all files.
#[test]
fn rounding_is_that_of_flocq() {
    let files = coq().files();
    let text = code(&files.iter().find(|file| file.name == "B_Rounding.v").unwrap().text);
    let (_, definition) = text.split_once("Definition fl ").unwrap();
    let definition: Vec<_> = definition.split(".\n").next().unwrap().split_whitespace().collect();
    let expected =
        "(prec : Z) (choice : Z -> bool) (x : R) : R := round radix2 (FLX_exp prec) (Znearest choice) x";
    assert_eq!(definition.join(" "), expected);
    // No file redefines the names that are parsed here.
    for File { name, text } in &files {
        for keyword in ["Notation", "Infix", "Coercion"] {
            assert!(words(&code(text)).all(|word| word != keyword), "{name}: {keyword}");
        }
    }
}

/// A theorem with inconsistent premises could state anything.
#[test]
fn the_hypotheses_of_every_law_hold_in_some_trials() {
    let (_, functions) = printed();
    let laws: BTreeSet<_> = claims::statements()
        .iter()
        .filter(|statement| statement.contains_rounding())
        .map(|statement| theorem_name(statement.equation(), statement.name()))
        .collect();
    let theorems = theorems();
    let printed: Vec<_> = theorems.iter().filter(|theorem| laws.contains(&theorem.name)).collect();
    assert!(!laws.is_empty() && printed.len() == laws.len());
    for theorem in printed {
        let read = theorem.read(&functions);
        assert!(read.trials().count() > 5, "{}", theorem.name);
    }
}

/// If a theorem has the same call on both sides, the definition could be any. An inequality may detect only a
/// smaller value.
#[test]
fn every_changed_definition_makes_a_theorem_false() {
    let (definitions, _) = printed();
    let theorems = theorems();
    for definition in &definitions {
        let noticed = ["+", "-"].iter().any(|sign| {
            let mut other = definition.clone();
            other.body.extend([sign.to_string(), "1".to_string()]);
            let functions = functions(&with(&definitions, other));
            let mut about_it = theorems.iter().filter(|theorem| theorem.names(&definition.name));
            about_it.any(|theorem| theorem.is_false_somewhere(&functions))
        });
        assert!(noticed, "{} could be one more or less", definition.name);
    }
}

#[test]
fn no_name_is_used_twice() {
    let files = coq().files();
    let mut known = BTreeSet::new();
    for file in &files {
        let text = code(&file.text);
        for keyword in ["Theorem", "Lemma", "Definition", "Fixpoint", "Ltac"] {
            for name in named(&text, keyword) {
                assert!(known.insert(name.to_string()), "{name}");
            }
        }
    }
    assert!(files.is_sorted_by(|a, b| a.name < b.name));
}

#[test]
fn no_file_assumes_axioms_or_unproved_facts() {
    for file in coq().files() {
        let text = code(&file.text);
        let mut open = 0;
        for word in words(&text) {
            match word {
                "Section" | "Module" => open += 1,
                "End" => open -= 1,
                "Variable" | "Variables" | "Let" => {
                    assert!(open > 0, "{}: {word} outside a section", file.name)
                }
                "Admitted" | "admit" | "Axiom" | "Axioms" | "Parameter" | "Parameters" | "Conjecture"
                | "Abort" | "Hypothesis" | "Hypotheses" | "Context" | "Unset" | "give_up"
                | "bypass_check" | "Declare" => {
                    panic!("{}: {word}", file.name)
                }
                _ => {}
            }
        }
        assert_eq!(open, 0, "{}: a section is left open", file.name);
        assert!(text.is_ascii(), "{}", file.name);
    }
}

#[test]
#[ignore = "requires Coq"]
fn coq_accepts_everything() {
    accepts("everything", "Contact", coq());
}

/// Compiles the files that those of claims require, and returns their directory.
fn compiled_program(name: &str) -> PathBuf {
    let directory = scratch(name);
    for file in coq().files().iter().filter(|file| file.name.starts_with(['A', 'B'])) {
        compile_text(&directory, file).unwrap_or_else(|error| panic!("{error}"));
    }
    directory
}

fn compile_text(directory: &Path, File { name, text }: &File) -> Result<String, String> {
    fs::write(directory.join(name), text).unwrap();
    compile(directory, "Contact", name)
}

/// A theorem is rejected, not an unreadable definition: the file of the definitions compiles.
#[test]
#[ignore = "requires Coq"]
fn coq_rejects_theorems_about_a_definition_with_a_changed_sign() {
    let (directory, files) = (compiled_program("signs"), coq().files());
    let compile = |file: &File| compile_text(&directory, file);
    for [definition, changed] in
        [["\n  m * g - c * (h - l).", "\n  m * g + c * (h - l)."], ["\n  c + eps.", "\n  c - eps."]]
    {
        let text = definitions_text();
        assert_eq!(text.matches(definition).count(), 1, "{definition}");
        let text = text.replace(definition, changed);
        let accepted = compile(&File { name: DEFINITIONS.into(), text });
        assert!(accepted.is_ok(), "{accepted:?}");
        let theorems = of_claims(&files).filter(|file| !file.name.contains("rounding"));
        let rejected = theorems.map(compile).find_map(Result::err).expect(changed);
        let unread = ["Syntax error", "Cannot find", "not found in the current environment"];
        assert!(unread.iter().all(|unread| !rejected.contains(unread)), "{rejected}");
    }
}

/// A certificate is an identity, so no coefficient of it can be another.
#[test]
#[ignore = "requires Coq"]
fn coq_rejects_certificates_with_a_changed_coefficient() {
    const RIGHT: &str = "\"+\" \"+";
    let (directory, files) = (compiled_program("certificates"), coq().files());
    let file = of_claims(&files).find(|file| file.text.matches(RIGHT).count() > 2).unwrap();
    assert_eq!(compile_text(&directory, file), Ok(String::new()));
    for (place, _) in file.text.match_indices(RIGHT).take(3) {
        let (before, after) = file.text.split_at(place + RIGHT.len());
        let end = after.find(|c: char| !c.is_ascii_digit()).unwrap();
        // A coefficient that is left out is 1.
        let changed = after[..end].parse::<i64>().unwrap_or(1) + 1;
        let text = format!("{before}{changed}{}", &after[end..]);
        let rejected = compile_text(&directory, &File { name: file.name.clone(), text }).unwrap_err();
        assert!(rejected.contains("\"true = true\""), "{rejected}");
    }
}
