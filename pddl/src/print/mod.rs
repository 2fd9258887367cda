//! Model to PDDL text.
//!
//! Invariant: reading the output gives the same model, spans aside, as long as nothing in the model's source
//! was unsupported (the model does not hold such parts). Imported declarations are printed together with the
//! `:import`, which allows the repetition: so a printed file shows all declarations that it uses, and ids
//! stay the same.
//!
//! This is not the formatter: comments and layout are in [`crate::syntax`], not in a model.

mod body;
mod constraints;
mod declarations;
mod domain;
mod htn;
mod invariants;
mod plan;
mod problem;
mod schemas;

pub use plan::print_plan;

use crate::model::{Domain, FunctionTerm, IndexVec, Name, Object, ObjectId, Problem};

/// The text of a domain.
pub fn print_domain(domain: &Domain) -> String {
    let mut printer = Printer::new(domain, &domain.constants);
    printer.domain();
    printer.out
}

/// The text of a problem of `domain`.
pub fn print_problem(problem: &Problem, domain: &Domain) -> String {
    let mut printer = Printer::new(domain, &problem.objects);
    printer.problem(problem);
    printer.out
}

/// The state of printing one file.
struct Printer<'m> {
    out: String,
    domain: &'m Domain,
    objects: &'m IndexVec<ObjectId, Object>,
    /// The functions of slots that no quantifier binds.
    functions: &'m [FunctionTerm],
}

impl<'m> Printer<'m> {
    fn new(domain: &'m Domain, objects: &'m IndexVec<ObjectId, Object>) -> Self {
        Self { out: String::new(), domain, objects, functions: &[] }
    }

    fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    /// `open`, the parts each after a blank, `)`.
    fn list<T>(
        &mut self,
        open: &str,
        parts: impl IntoIterator<Item = T>,
        mut print: impl FnMut(&mut Self, T),
    ) {
        self.push(open);
        for part in parts {
            if !self.out.ends_with('(') {
                self.push(" ");
            }
            print(self, part);
        }
        self.push(")");
    }

    /// The same with each part on a line of its own.
    fn lines<T>(
        &mut self,
        open: &str,
        parts: impl IntoIterator<Item = T>,
        mut print: impl FnMut(&mut Self, T),
    ) {
        self.push(open);
        for part in parts {
            self.push("\n      ");
            print(self, part);
        }
        self.push(")");
    }

    fn names<'a>(&mut self, open: &str, names: impl IntoIterator<Item = &'a Name>) {
        self.list(open, names, |p, name| p.push(name));
    }
}
