//! Sequences in theorems.

use super::{Reader, Said, interned, value};
use spring_mass_contact::number::{Exact, Tree};

/// Recursion of a sequence of one or several numbers, with powers q of a ratio.
pub struct Recursion {
    pub ratio: Tree,
    pub start: Vec<Tree>,
    /// The next member, in terms of the names of the current one.
    pub step: Vec<Tree>,
    pub members: Vec<&'static str>,
    /// Quantities computed from a member, in terms of it and of earlier quantities.
    pub computed: Vec<(&'static str, Tree)>,
}

/// Number of members that are tried.
const MEMBERS: usize = 6;

impl Reader<'_> {
    /// Parses `let NAME := FORMULA in`.
    fn named(&mut self) -> (&'static str, Tree) {
        self.expect("let");
        let name = interned(self.take());
        self.expect(":=");
        let formula = self.formula();
        self.expect("in");
        (name, formula)
    }

    /// Parses all definitions that follow.
    fn all_named(&mut self) -> Vec<(&'static str, Tree)> {
        let mut all = Vec::new();
        while self.next() == "let" {
            all.push(self.named());
        }
        all
    }

    /// Consumes words up to and including `end`.
    fn until(&mut self, end: &str) -> Vec<String> {
        let words: Vec<_> = self.rest.iter().take_while(|word| *word != end).cloned().collect();
        self.rest = &self.rest[words.len()..];
        self.expect(end);
        words
    }

    /// Parses `many` formulas: several in brackets, separated by commas.
    fn tuple(&mut self, many: usize) -> Vec<Tree> {
        if many == 1 {
            return vec![self.formula()];
        }
        let open = ["("].into_iter().chain(std::iter::repeat(","));
        let all = open.take(many).map(|sign| {
            self.expect(sign);
            self.formula()
        });
        let all = all.collect();
        self.expect(")");
        all
    }

    /// Parses `forall n : nat, let q := ρ ^ n in` and either `let x := ITERATES n in` with any number of `let
    /// u := BY in` and propositions about them, or `ITERATES n = CLOSED`, with the recursion of ITERATES.
    pub(super) fn sequence(&mut self, recursion: &[String]) -> (Recursion, Vec<Said>) {
        let reader = Reader { rest: recursion, known: self.known, ratio: None };
        let (call, mut recursion) = reader.recursion();
        self.expect_all("forall n : nat ,");
        assert_eq!(self.named(), ("q", Tree::symbol("q")));
        let follows = if self.next() == "let" {
            self.expect_all(&format!("let {} := (", recursion.members.join(" , ")));
            assert_eq!(self.until(")"), call);
            self.expect("in");
            assert_eq!(self.all_named(), recursion.computed);
            self.all_said()
        } else {
            assert_eq!(self.until("="), call);
            let closed = self.tuple(recursion.members.len());
            let members = recursion.members.iter().map(|name| Tree::symbol(name));
            members.zip(closed).map(|(member, closed)| Said::Equal(member, closed)).collect()
        };
        recursion.ratio = self.ratio.take().expect("a power of a ratio");
        (recursion, follows)
    }

    /// Parses the definition of a recursion, without its ratio.
    fn recursion(mut self) -> (Vec<String>, Recursion) {
        self.expect("Fixpoint");
        let mut call = vec![self.take().to_string()];
        self.expect("(");
        if self.next() == "prec" {
            self.expect_all("prec : Z ) ( choice : Z -> bool ) (");
            call.extend(["prec", "choice"].map(String::from));
        }
        call.extend(self.until(":"));
        call.push("n".to_string());
        self.expect_all("R ) ( n : nat ) : R");
        let more = self.until(":=");
        assert!(more.chunks(2).all(|more| more == ["*", "R"]), "{more:?}");
        let many = 1 + more.len() / 2;
        self.expect_all("match n with | O =>");
        let start = self.tuple(many);
        self.expect_all("| S n => let");
        let members =
            self.until(":=").into_iter().filter(|word| !["'", "(", ",", ")"].contains(&word.as_str()));
        let members: Vec<_> = members.map(|name| interned(&name)).collect();
        assert_eq!(members.len(), many);
        assert_eq!(self.until("in"), call, "of the member before");
        let computed = self.all_named();
        let step = self.tuple(many);
        self.expect_all("end .");
        assert!(self.rest.is_empty(), "what is {:?}?", self.rest);
        (call, Recursion { ratio: Tree::from(1), start, step, members, computed })
    }
}

impl Recursion {
    /// Returns whether a property holds for all members that are tried; `None` if that is unknown.
    pub fn all(
        &self,
        at: &impl Fn(&'static str) -> Exact,
        holds: &impl Fn(&dyn Fn(&'static str) -> Exact) -> Option<bool>,
    ) -> Option<bool> {
        let ratio = value(&self.ratio, at)?;
        let values = |trees: &[Tree], at: &dyn Fn(&'static str) -> Exact| -> Option<Vec<Exact>> {
            trees.iter().map(|tree| value(tree, &at)).collect()
        };
        let (mut power, mut members) = (Exact::from(1), values(&self.start, at)?);
        for _ in 0..MEMBERS {
            let place = |name| self.members.iter().position(|own| *own == name);
            let with_members = |name| match place(name) {
                Some(i) => members[i].clone(),
                None if name == "q" => power.clone(),
                None => at(name),
            };
            let mut computed = Vec::new();
            let here = |name, computed: &[(&str, Exact)]| {
                let found = computed.iter().find(|(own, _)| *own == name);
                found.map_or_else(|| with_members(name), |(_, x)| x.clone())
            };
            for (name, by) in &self.computed {
                computed.push((*name, value(by, &|name| here(name, &computed))?));
            }
            let here = |name| here(name, &computed);
            if !holds(&here)? {
                return Some(false);
            }
            let next = values(&self.step, &here)?;
            (power, members) = (power * &ratio, next);
        }
        Some(true)
    }
}
