//! A sequence of what is rounded, as a theorem speaks of it.

use super::{Reader, interned, value};
use spring_mass_contact::number::{Exact, Tree};

/// The members x of a sequence, beside the powers q of a ratio, and a quantity u that is computed from a member.
pub struct Drift {
    pub ratio: Tree,
    pub start: Tree,
    /// By x and u.
    pub step: Tree,
    pub q: &'static str,
    pub x: &'static str,
    pub u: &'static str,
    /// How u is computed, by x.
    pub by: Tree,
}

/// So many members are tried.
const MEMBERS: usize = 6;

impl Reader<'_> {
    /// `let NAME :=`
    fn named(&mut self) -> &'static str {
        self.expect("let");
        let name = interned(self.take());
        self.expect(":=");
        name
    }

    /// Words up to one that is not among them.
    fn until(&mut self, end: &str) -> Vec<String> {
        let words: Vec<_> = self.rest.iter().take_while(|word| *word != end).cloned().collect();
        self.rest = &self.rest[words.len()..];
        words
    }

    /// `forall n : nat, let q := ρ ^ n in let x := ITERATES n in let u := BY in`, with the recursion that ITERATES is.
    pub(super) fn drift(&mut self, recursion: &[String]) -> Drift {
        self.expect_all("forall n : nat ,");
        let q = self.named();
        self.expect("(");
        let ratio = self.formula();
        self.expect_all("^ n ) in");
        let x = self.named();
        self.expect("(");
        let call = self.until(")");
        self.expect_all(") in");
        let u = self.named();
        let by = self.formula();
        self.expect("in");
        let (start, step) = Reader { rest: recursion, known: self.known }.recursion(&call, (x, u, &by));
        Drift { ratio, start, step, q, x, u, by }
    }

    /// The definition of what is called in this way.
    fn recursion(mut self, call: &[String], (x, u, by): (&'static str, &'static str, &Tree)) -> (Tree, Tree) {
        self.expect("Fixpoint");
        let mut own = vec![self.take().to_string()];
        self.expect_all("( prec : Z ) ( choice : Z -> bool ) (");
        own.extend(["prec", "choice"].map(String::from));
        own.extend(self.until(":"));
        self.expect_all(": R ) ( n : nat ) : R := match n with | O =>");
        own.push("n".to_string());
        assert_eq!(own, call, "called as it is defined");
        let start = self.formula();
        self.expect_all("| S n =>");
        assert_eq!(self.named(), x);
        assert_eq!(self.until("in"), call, "of the member before");
        self.expect("in");
        assert_eq!((self.named(), &self.formula()), (u, by));
        self.expect("in");
        let step = self.formula();
        self.expect_all("end .");
        assert!(self.rest.is_empty(), "what is {:?}?", self.rest);
        (start, step)
    }
}

impl Drift {
    /// Does this hold of all members that are tried? None where something is not known.
    pub fn all(
        &self,
        at: &impl Fn(&'static str) -> Exact,
        holds: &impl Fn(&dyn Fn(&'static str) -> Exact) -> Option<bool>,
    ) -> Option<bool> {
        let ratio = value(&self.ratio, at)?;
        let (mut power, mut member) = (Exact::from(1), value(&self.start, at)?);
        for _ in 0..MEMBERS {
            let with_member = |name| if name == self.x { member.clone() } else { at(name) };
            let computed = value(&self.by, &with_member)?;
            let here = |name: &'static str| match name {
                _ if name == self.q => power.clone(),
                _ if name == self.u => computed.clone(),
                _ => with_member(name),
            };
            if !holds(&here)? {
                return Some(false);
            }
            let next = value(&self.step, &here)?;
            (power, member) = (power * &ratio, next);
        }
        Some(true)
    }
}
