//! The chapter in Coq: the exported text, and, if Coq is installed, its acceptance.

use crate::coqc::{DEFINITIONS, accepts, code, compile, named, of_claims, scratch, words};
use spring_mass_contact::claims::{self, registry};
use spring_mass_contact::formula::Relation;
use spring_mass_contact::formula::statement::{Proposition, minimum_precision};
use spring_mass_contact::number::Tree;
use spring_mass_contact::number::tree::Op;
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
    let files = coq().files();
    for statement in claims::statements() {
        let mut divisors: Vec<&Tree> = Vec::new();
        for tree in statement.trees() {
            tree.visit(&mut |tree| {
                if let Op::Div(_, by) = tree.op()
                    && !by.symbols().is_empty()
                    && !divisors.contains(&by)
                {
                    divisors.push(by);
                }
            });
        }
        let name = format!("{}_defined", theorem_name(statement.equation(), statement.name()));
        let lemma = said(&files, "Lemma", &name);
        assert_eq!(lemma.is_some(), !divisors.is_empty(), "{name}");
        assert!(lemma.is_none_or(|said| said.matches("<> 0").count() == divisors.len()), "{name}");
    }
}

/// Returns what a theorem or lemma says: the text from its name to its proof, in one line.
fn said(files: &[File], keyword: &str, name: &str) -> Option<String> {
    let start = format!("\n{keyword} {name}");
    let mut after = of_claims(files).flat_map(|file| file.text.split(&start).skip(1));
    let (said, _) = after.find(|rest| rest.starts_with([' ', '\n']))?.split_once("\nProof.")?;
    Some(said.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// The premises of each theorem about single propositions are the hypotheses of its claim, and its conclusion has the
/// relation of the claim.
#[test]
fn every_theorem_states_its_claim() {
    let (files, mut count) = (coq().files(), 0);
    for statement in claims::statements() {
        let name = theorem_name(statement.equation(), statement.name());
        let said = said(&files, "Theorem", &name).unwrap_or_else(|| panic!("{name} is not stated"));
        let [goal] = statement.goals() else { continue };
        count += 1;
        let rounding = statement.contains_rounding();
        let premises = statement.hypotheses().iter().filter(|h| !rounding || **h != minimum_precision());
        assert_eq!(said.matches("(H").count(), premises.count(), "{name}");
        let conclusion = said.rsplit(" : ").next().unwrap();
        let relation = match goal.proposition {
            Proposition::Equal(..) => " = ",
            Proposition::Sign(Relation::Positive, _) => "0 < ",
            Proposition::Sign(Relation::NonNegative, _) => "0 <= ",
            Proposition::Sign(Relation::Zero, _) => " = 0",
            Proposition::Within(..) => "Rabs ",
            Proposition::Derivative(..) => "is_derive ",
            Proposition::Limit(..) => "is_lim ",
        };
        assert!(conclusion.contains(relation), "{name}: {conclusion}");
    }
    assert!(count > 150, "{count} theorems");
}

#[test]
fn lemmas_of_a_part_with_several_goals_have_numbers() {
    let files = coq().files();
    for name in ["eq_1_13_limit_rate", "eq_1_16_closed_form_step_1", "eq_1_16_closed_form_step_2"] {
        assert!(said(&files, "Lemma", name).is_some(), "{name}");
    }
}

#[test]
fn the_variable_of_a_limit_is_bound_there_only() {
    let files = coq().files();
    let said = of_claims(&files).flat_map(|file| file.text.split("\nProof."));
    let limits: Vec<_> = said.filter_map(|text| text.rsplit_once("is_lim (fun ")).collect();
    for (before, limit) in &limits {
        let start = before.rfind("\nLemma ").max(before.rfind("\nTheorem ")).unwrap();
        let variable = words(limit).next().unwrap();
        assert!(words(&before[start..]).all(|word| word != variable), "{}{variable}", &before[start..]);
    }
    assert!(limits.len() > 10, "{} limits", limits.len());
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

fn definitions_text() -> String {
    coq().files().into_iter().find(|file| file.name == DEFINITIONS).unwrap().text
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
