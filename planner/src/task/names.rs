//! Names of a task's parts, for plans and reports.

use super::{GroundAtom, Operator, Task};
use crate::ids::{FactId, OperatorId};
use pddl::model::{Domain, IndexVec, Name, ObjectId, PredicateId, Problem};
use std::fmt::Write;

/// The names that a grounded task needs of its domain and problem.
#[derive(Clone, Debug)]
pub(crate) struct Names {
    actions: Vec<Name>,
    predicates: IndexVec<PredicateId, Name>,
    objects: IndexVec<ObjectId, Name>,
}

impl Names {
    pub(crate) fn of(domain: &Domain, problem: &Problem) -> Self {
        Self {
            actions: domain.actions.iter().map(|a| a.name.clone()).collect(),
            predicates: domain.predicates.iter().map(|p| p.name.clone()).collect(),
            objects: problem.objects.iter().map(|o| o.name.clone()).collect(),
        }
    }

    fn list(&self, head: &Name, arguments: &[ObjectId]) -> String {
        let mut text = format!("({head}");
        for &o in arguments {
            write!(text, " {}", self.objects[o]).expect("writing to a string does not fail");
        }
        text.push(')');
        text
    }
}

impl Task {
    /// The operator as a line of a plan file, `(move a b)`.
    pub fn operator_name(&self, operator: OperatorId) -> String {
        let Operator { action, arguments, .. } = &self.operators[operator];
        self.names.list(&self.names.actions[action.0 as usize], arguments)
    }

    /// A ground atom as PDDL writes it.
    pub fn atom_name(&self, atom: &GroundAtom) -> String {
        self.names.list(&self.names.predicates[atom.predicate], &atom.arguments)
    }

    /// A fact as PDDL writes it; facts that grounding made up are `(auxiliary-N)`.
    pub fn fact_name(&self, fact: FactId) -> String {
        match &self.facts[fact].atom {
            Some(atom) => self.atom_name(atom),
            None => format!("(auxiliary-{})", fact.0),
        }
    }
}
