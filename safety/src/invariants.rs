//! The invariants of a robot and its mission, compiled.

use crate::compile::{Conditions, compile};
use crate::error::Error;
use crate::formula::{Condition, Formula};
use pddl::model::{Domain, Name};
use vocabulary::Tokens;

/// Compiled invariants. They hold no state: one set serves any number of runs.
#[derive(Debug, Clone, Default)]
pub struct Invariants {
    pub(crate) conditions: Vec<Condition>,
    pub(crate) formulas: Vec<Formula>,
}

impl Invariants {
    /// Compiles the invariants of some domains that import the vocabulary.
    ///
    /// # Errors
    /// Everything that cannot be monitored, with the position of its domain.
    pub fn new<'d>(
        domains: impl IntoIterator<Item = &'d Domain>,
        tokens: &Tokens,
    ) -> Result<Self, Vec<(usize, Error)>> {
        let mut conditions = Conditions::default();
        let (mut formulas, mut errors) = (Vec::new(), Vec::new());
        for (at, domain) in domains.into_iter().enumerate() {
            for invariant in &domain.invariants {
                match compile(domain, invariant, tokens, &mut conditions) {
                    Ok(found) => formulas.extend(found),
                    Err(found) => errors.extend(found.into_iter().map(|error| (at, error))),
                }
            }
        }
        if errors.is_empty() { Ok(Self { conditions: conditions.all, formulas }) } else { Err(errors) }
    }

    /// Their names, in the order of the texts.
    pub fn names(&self) -> Vec<&Name> {
        let mut names: Vec<&Name> = self.formulas.iter().map(|formula| &formula.name).collect();
        names.dedup();
        names
    }
}
