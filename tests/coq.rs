//! The chapter in Coq: what is written, and, where Coq is installed, that it accepts it.

#![cfg(feature = "mpfr")]

mod gallina;

use gallina::{
    Definition, Function, Functions, Said, TRIALS, Theorem, code, drawn, functions, stated, value,
};
use spring_mass_contact::claims::{registry, statements};
use spring_mass_contact::formula::Relation;
use spring_mass_contact::formula::statement::Says;
use spring_mass_contact::number::tree::Step;
use spring_mass_contact::number::{Field, Tree};
use spring_mass_contact::proof::coq::{File, theorem_name};
use spring_mass_contact::verify::coq;
use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::{fs, thread};

/// The axioms that Coq's real numbers rest on, and nothing else may.
const AXIOMS: [&str; 4] = [
    // Of a property of natural numbers that can be decided one by one, either all have it or one is found that
    // has it not: with it, Dedekind's cuts can be compared.
    "ClassicalDedekindReals.sig_forall_dec",
    // What is not impossible is so, or it is not: a cut is a set that may ask anything.
    "ClassicalDedekindReals.sig_not_dec",
    // Functions with the same values are the same: cuts are functions.
    "FunctionalExtensionality.functional_extensionality_dep",
    // Every statement holds or does not: Coquelicot's limits and derivatives are of classical analysis.
    "Classical_Prop.classic",
];

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// The names that a keyword introduces.
fn named<'t>(text: &'t str, keyword: &str) -> Vec<&'t str> {
    let all: Vec<_> = words(text).collect();
    all.windows(2).filter(|pair| pair[0] == keyword).map(|pair| pair[1]).collect()
}

fn of_claims(files: &[File]) -> impl Iterator<Item = &File> {
    files.iter().filter(|file| file.name.starts_with("C_"))
}

#[test]
fn every_claim_is_a_theorem() {
    let files = coq().files();
    let theorems: Vec<_> = of_claims(&files).flat_map(|file| named(&file.text, "Theorem")).collect();
    let left_out = coq().left_out();
    assert!(left_out.is_empty(), "{left_out:#?}");
    let statements = statements();
    for statement in &statements {
        let name = theorem_name(statement.equation, statement.name);
        assert!(theorems.contains(&name.as_str()), "{name}");
    }
    assert_eq!(theorems.len(), statements.len());
    for name in
        ["eq_1_13_rate", "theorem_1_3_3_contracts", "note_5_twice", "remark_1_3_2_enough", "fig_1_2_force"]
    {
        assert!(theorems.contains(&name), "{name}");
    }
}

/// Coq divides by 0 without complaint, so a formula with a divisor needs more than its theorem.
#[test]
fn every_claim_with_a_divisor_is_said_to_be_defined() {
    let files = coq().files();
    let lemmas: BTreeSet<_> = of_claims(&files).flat_map(|file| named(&file.text, "Lemma")).collect();
    for statement in statements() {
        let divides = |tree: &Tree| match tree.step() {
            Step::Div(_, by) => !by.symbols().is_empty(),
            _ => false,
        };
        let divides = statement.trees().any(|tree| tree.any(&divides));
        let name = format!("{}_defined", theorem_name(statement.equation, statement.name));
        assert_eq!(lemmas.contains(name.as_str()), divides, "{name}");
    }
}

#[test]
fn every_function_is_a_definition() {
    let files = coq().files();
    let definitions = named(&files[1].text, "Definition");
    assert_eq!(definitions.len(), registry().formulas().len());
    assert!(
        definitions.contains(&"penalty_deflection") && definitions.contains(&"lagrange_residual_constraint")
    );
    // A call is a call.
    assert!(files[1].text.contains("eps * system_reaction c m g l h / penalty_total_stiffness c eps."));
}

/// A definition that no theorem speaks of could be any other.
#[test]
fn every_definition_is_named_by_a_theorem() {
    let files = coq().files();
    let texts: Vec<_> = of_claims(&files).map(|file| code(&file.text)).collect();
    let known: BTreeSet<_> = texts.iter().flat_map(|text| stated(text)).flat_map(words).collect();
    let unnamed: Vec<_> =
        named(&files[1].text, "Definition").into_iter().filter(|name| !known.contains(name)).collect();
    assert!(unnamed.is_empty(), "{unnamed:#?}");
}

/// The functions as they are printed.
fn printed() -> (Vec<Definition>, Functions) {
    let definitions = Definition::all(&coq().files()[1].text);
    let functions = functions(&definitions);
    (definitions, functions)
}

/// One definition in place of another of the same name.
fn with(definitions: &[Definition], other: Definition) -> Vec<Definition> {
    let choose = |own: &Definition| if own.name == other.name { other.clone() } else { own.clone() };
    definitions.iter().map(choose).collect()
}

/// A formula in the letters that Coq takes.
fn in_letters(tree: &Tree) -> Tree {
    const LETTERS: [(&str, &str); 6] =
        [("H", "h"), ("ε", "eps"), ("ε₄", "eps4"), ("λ", "lambda"), ("α", "alpha"), ("δu", "du")];
    tree.rewrite(&|tree| match tree.step() {
        Step::Symbol(name) => LETTERS.iter().find(|(own, _)| own == name).map(|(_, new)| Tree::symbol(new)),
        _ => None,
    })
}

/// Are they the same, step by step, or, since what differentiation leaves is printed without its zeros and ones, in
/// their values?
fn same(a: &Tree, b: &Tree) -> bool {
    let values = |tree| (0..TRIALS).map(|i| value(tree, &|name| drawn(name, i))).collect::<Vec<_>>();
    let agree = |a: Vec<_>, b| a == b && a.iter().any(Option::is_some);
    a == b || agree(values(a), values(b))
}

/// What is printed is read here by another hand.
#[test]
fn every_definition_computes_what_its_function_does() {
    let (_, functions) = printed();
    for formula in registry().formulas() {
        let name = formula.name().replace("::", "_").replace('.', "_");
        let Function { arguments, value: printed } = &functions[&name];
        let symbols = formula.tree.symbols();
        let own = ["c", "m", "g", "l", "H"].into_iter().chain(formula.arguments.iter().copied());
        let own: Vec<_> = own.filter(|name| symbols.contains(name)).collect();
        assert_eq!(own.len(), arguments.len(), "{name}");
        let place = |name| own.iter().position(|known| *known == name);
        let renamed = formula.tree.rewrite(&|tree| match tree.step() {
            Step::Symbol(name) => place(*name).map(|place| Tree::symbol(arguments[place])),
            _ => None,
        });
        assert!(same(&renamed, printed), "{name}");
    }
}

/// A theorem that says less than its claim would be as easily proved.
#[test]
fn every_theorem_says_what_its_claim_does() {
    let (_, functions) = printed();
    let files = coq().files();
    let theorems: Vec<_> = of_claims(&files).flat_map(|file| Theorem::all(&file.text)).collect();
    let same = |own: &Tree, printed: &Tree| same(&in_letters(own), printed);
    let signed = |relation: Relation, own: &Tree, printed: &Said| match (relation, printed) {
        (Relation::Positive, Said::Less(zero, a)) => *zero == Tree::int(0) && same(own, a),
        (Relation::NonNegative, Said::AtMost(zero, a)) => *zero == Tree::int(0) && same(own, a),
        (Relation::Zero, Said::Equal(a, zero)) => *zero == Tree::int(0) && same(own, a),
        _ => false,
    };
    for statement in statements() {
        let name = theorem_name(statement.equation, statement.name);
        let theorem = theorems.iter().find(|theorem| theorem.name == name).unwrap();
        let read = theorem.read(&functions);
        // These are about more than the numbers of one case.
        assert_eq!(read.is_none(), ["limit", "induction", "vanishing"].contains(&statement.kind), "{name}");
        let Some((given, follows)) = read else { continue };
        assert_eq!(given.len(), statement.hypotheses.len(), "{name}");
        for (own, printed) in statement.hypotheses.iter().zip(&given) {
            assert!(signed(own.relation, &own.value, printed), "{name}: {}", own.value);
        }
        let says_so = match (&statement.goals[0].says, &follows) {
            (Says::Equal(a, b), Said::Equal(left, right)) => same(a, left) && same(b, right),
            (Says::Sign(relation, a), said) => signed(*relation, a, said),
            (Says::Derivative(of, by, is), Said::Derivative(a, x, b)) => {
                in_letters(&Tree::symbol(by)) == Tree::symbol(x) && same(of, a) && same(is, b)
            }
            _ => false,
        };
        assert!(says_so, "{name}");
    }
}

#[test]
fn no_theorem_is_false() {
    let (_, functions) = printed();
    let files = coq().files();
    let theorems = of_claims(&files).flat_map(|file| Theorem::all(&file.text));
    let wrong: Vec<_> = theorems
        .filter(|theorem| theorem.is_false_somewhere(&functions))
        .map(|theorem| theorem.name)
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// To be named is not enough: if a theorem has the same call on both sides, anything could be defined. An inequality
/// may notice only one that is less.
#[test]
fn no_definition_could_be_another() {
    let (definitions, _) = printed();
    let files = coq().files();
    let theorems: Vec<_> = of_claims(&files).flat_map(|file| Theorem::all(&file.text)).collect();
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

/// What Coq is to refuse has to be wrong, and has to be something that it can read.
#[test]
fn every_flip_changes_one_sign_and_makes_a_theorem_false() {
    let (definitions, _) = printed();
    let sign = |token: &&String| ["+", "-"].contains(&token.as_str());
    let signs: usize = definitions.iter().map(|definition| definition.body.iter().filter(sign).count()).sum();
    let flips = coq().flips();
    let different: BTreeSet<_> = flips.iter().map(|flip| &flip.definition).collect();
    assert_eq!((flips.len(), different.len()), (signs, signs), "one for every sign");
    for flip in &flips {
        let own = definitions.iter().find(|definition| definition.name == flip.function).unwrap();
        let flipped = Definition::of(&flip.definition);
        // But for brackets one sign is another, or a leading one is lost.
        let bare = |definition: &Definition| {
            let kept = definition.body.iter().filter(|token| !["(", ")"].contains(&token.as_str()));
            kept.cloned().collect::<Vec<_>>()
        };
        let (before, after) = (bare(own), bare(&flipped));
        let at = before.iter().zip(&after).position(|(a, b)| a != b).expect("nothing has changed");
        let lost = before.len().checked_sub(after.len()).expect("a flip adds nothing");
        match (lost, before[at].as_str(), after[at].as_str()) {
            (0, "+", "-") | (0, "-", "+") | (1, "-", _) => {}
            _ => panic!("{}", flip.definition),
        }
        assert_eq!(before[at + 1..], after[at + 1 - lost..], "{}", flip.definition);

        let changed = functions(&with(&definitions, flipped));
        let wrong = Theorem::all(&flip.file.text).iter().any(|theorem| theorem.is_false_somewhere(&changed));
        assert!(wrong, "no theorem is false of {}", flip.definition);
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
fn nothing_is_taken_for_granted() {
    for file in coq().files() {
        let text = code(&file.text);
        let mut open = 0;
        for word in words(&text) {
            match word {
                "Section" => open += 1,
                "End" => open -= 1,
                "Variable" | "Variables" | "Let" => {
                    assert!(open > 0, "{}: {word} outside a section", file.name)
                }
                "Admitted" | "admit" | "Axiom" | "Axioms" | "Parameter" | "Parameters" | "Conjecture"
                | "Abort" | "Hypothesis" | "Hypotheses" | "Context" | "Unset" | "give_up"
                | "bypass_check" => {
                    panic!("{}: {word}", file.name)
                }
                _ => {}
            }
        }
        assert_eq!(open, 0, "{}: a section is left open", file.name);
        assert!(text.is_ascii(), "{}", file.name);
    }
}

/// A directory for one test.
fn scratch(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("coq-{name}"));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// Past the test harness, which keeps what a passing test prints to itself.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// The version of the Coq that is installed, if one is.
fn version() -> Option<String> {
    let output = Command::new("coqc").arg("--version").output().ok();
    let found = output.filter(|output| output.status.success());
    if found.is_none() {
        say("skipped: coqc is not installed (./setup --provers installs it), so Coq checks nothing here");
    }
    found.map(|output| String::from_utf8_lossy(&output.stdout).into_owned())
}

/// What Coq says of a file: its output, or its error.
fn compile(directory: &Path, file: &str) -> Result<String, String> {
    // Coquelicot warns of a coercion of its own.
    let output =
        Command::new("coqc").args(["-w", "none", "-R", ".", "Contact", file]).current_dir(directory).output();
    let output = output.unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    if output.status.success() { Ok(text(output.stdout)) } else { Err(text(output.stderr)) }
}

/// Does all jobs, two at a time, in their order.
fn two_at_a_time<J: Sync, R: Send>(jobs: &[J], work: impl Fn(&J) -> R + Sync) -> Vec<R> {
    let (next, done) = (Mutex::new(0..jobs.len()), Mutex::new(Vec::new()));
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let Some(i) = next.lock().unwrap().next() else { break };
                    let result = work(&jobs[i]);
                    done.lock().unwrap().push((i, result));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap();
    done.sort_by_key(|(i, _)| *i);
    done.into_iter().map(|(_, result)| result).collect()
}

/// The names of axioms in what `Print Assumptions` prints.
fn axioms(printed: &str) -> BTreeSet<&str> {
    let (_, list) = printed.split_once("Axioms:").unwrap_or_default();
    let names = list.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_alphabetic()));
    names.filter_map(|line| line.split_whitespace().next()).collect()
}

/// What this Coq has accepted it need not be asked again: the texts that were.
#[test]
fn coq_accepts_everything() {
    let Some(version) = version() else { return };
    let texts = coq().files().iter().fold(version, |all, file| all + &file.name + "\n" + &file.text);
    let accepted = Path::new(env!("CARGO_TARGET_TMPDIR")).join("coq-accepted.txt");
    if fs::read_to_string(&accepted).is_ok_and(|before| before == texts) {
        say("not a word has changed since Coq accepted it");
        return;
    }
    let directory = scratch("everything");
    coq().write(&directory).unwrap();
    let mut files: Vec<_> = coq().files();
    let mut printed = String::new();
    let mut done: BTreeSet<String> = BTreeSet::new();
    while !files.is_empty() {
        // A file needs what its first command imports.
        let ready = |file: &File| {
            let head = code(&file.text);
            let imports = head.split_once("From Contact Require Import").map_or("", |(_, rest)| rest);
            words(imports.split_once(".\n").map_or("", |(names, _)| names)).all(|name| done.contains(name))
        };
        let (mut now, later): (Vec<_>, Vec<_>) = files.into_iter().partition(ready);
        // The longest first, so that none is left over at the end.
        now.sort_by_key(|file| std::cmp::Reverse(file.text.len()));
        assert!(!now.is_empty(), "{:?} import each other", later.iter().map(|f| &f.name).collect::<Vec<_>>());
        let results = two_at_a_time(&now, |file| compile(&directory, &file.name));
        for (file, result) in now.iter().zip(results) {
            printed += &result.unwrap_or_else(|error| panic!("{error}"));
            done.insert(file.name.trim_end_matches(".v").to_string());
        }
        files = later;
    }
    let axioms = axioms(&printed);
    assert!(!axioms.is_empty(), "Coq did not print what everything rests on");
    let unknown: Vec<_> = axioms.iter().filter(|axiom| !AXIOMS.contains(axiom)).collect();
    assert!(unknown.is_empty(), "new axioms: {unknown:?}");
    fs::write(accepted, texts).unwrap();
}

#[test]
fn axioms_are_read() {
    let printed = "Axioms:\nA.one : forall P : Prop,\n  P\nB.two\n  : nat\n";
    assert_eq!(axioms(printed).into_iter().collect::<Vec<_>>(), ["A.one", "B.two"]);
    assert!(axioms("Closed under the global context\n").is_empty());
}

/// The theorem or lemma that a line of a file belongs to.
fn theorem_at(text: &str, line: usize) -> Option<&str> {
    let lines: Vec<_> = text.lines().take(line).collect();
    let begins = |line: &&&str| ["Theorem ", "Lemma "].iter().any(|keyword| line.starts_with(keyword));
    lines.iter().rev().find(begins).and_then(|line| words(line).nth(1))
}

/// The first theorem that Coq refuses, in a directory where the tactics are compiled; none if it accepts all.
///
/// It has to be a theorem that is refused, not a definition that Coq cannot read, nor a name that the file lacks.
fn refused(directory: &Path, File { name, text }: &File) -> Option<String> {
    fs::write(directory.join(name), text).unwrap();
    let error = compile(directory, name).err()?;
    let line = error.split_once(", line ").and_then(|(_, rest)| rest.split(',').next()?.parse().ok());
    let theorem = line.and_then(|line| theorem_at(text, line));
    let unread = ["Syntax error", "not found in the current environment"];
    match theorem {
        Some(theorem) if unread.iter().all(|unread| !error.contains(unread)) => Some(theorem.to_string()),
        _ => panic!("{name}: no theorem is refused, and yet it is not accepted: {error}"),
    }
}

/// One changed sign in one definition, whichever, and some theorem about it is no longer proved.
#[test]
#[ignore = "asks Coq once for every sign of the chapter, which takes a minute or two; .ci/run does"]
fn coq_refuses_a_changed_sign() {
    if version().is_none() {
        return;
    }
    let directory = scratch("signs");
    let tactics = coq().files().swap_remove(0);
    fs::write(directory.join(&tactics.name), &tactics.text).unwrap();
    compile(&directory, &tactics.name).unwrap_or_else(|error| panic!("{error}"));
    let flips = coq().flips();
    let refused = two_at_a_time(&flips, |flip| refused(&directory, &flip.file));
    let unnoticed: Vec<_> =
        flips.iter().zip(&refused).filter(|(_, by)| by.is_none()).map(|(flip, _)| &flip.definition).collect();
    assert!(unnoticed.is_empty(), "{unnoticed:#?}");
}

#[test]
fn a_refusal_is_that_of_a_theorem() {
    let text =
        "Definition f := 1.\n\nLemma one : f = 1.\nProof.\n  reflexivity.\nQed.\nTheorem two_a : f = 2.\n";
    let found = [1, 2, 3, 6, 7].map(|line| theorem_at(text, line));
    assert_eq!(found, [None, None, Some("one"), Some("one"), Some("two_a")]);
}
