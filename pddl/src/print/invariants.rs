//! Invariants.

use super::Printer;
use crate::model::{Invariant, Word};

impl Printer<'_> {
    pub(super) fn invariant(&mut self, invariant: &Invariant) {
        let v = &invariant.variables;
        self.push("\n  (:invariant ");
        self.push(&invariant.name);
        self.push("\n    :parameters ");
        self.bound(v, v.parameter_ids());
        if !invariant.says.is_empty() {
            self.list("\n    :says (", &invariant.says, |p, word| match word {
                Word::Text(text) => p.push(text),
                Word::Variable(variable) => {
                    p.push("?");
                    p.push(&v[*variable].name);
                }
            });
        }
        self.push("\n    :constraint ");
        self.constraint(v, &invariant.constraint);
        self.push(")");
    }
}
