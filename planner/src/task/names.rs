//! Names of a task's parts, for plans and reports.

use super::{GroundAtom, ObjectValue, Operator, Task};
use crate::ground::ValuePredicates;
use crate::ids::{FactId, OperatorId};
use crate::unsolvability::Pattern;
use pddl::model::{
    ActionId, Domain, FunctionId, GroundApplication, IndexVec, Name, ObjectId, PredicateId, Problem,
};
use std::fmt::Write;

/// The names that a grounded task needs of its domain and problem.
#[derive(Clone, Debug)]
pub(crate) struct Names {
    actions: Vec<Name>,
    predicates: IndexVec<PredicateId, Name>,
    functions: IndexVec<FunctionId, Name>,
    objects: IndexVec<ObjectId, Name>,
    values: ValuePredicates,
}

impl Names {
    pub(crate) fn of(domain: &Domain, problem: &Problem, values: ValuePredicates) -> Self {
        Self {
            actions: domain.actions.iter().map(|a| a.name.clone()).collect(),
            predicates: domain.predicates.iter().map(|p| p.name.clone()).collect(),
            functions: domain.functions.iter().map(|f| f.name.clone()).collect(),
            objects: problem.objects.iter().map(|o| o.name.clone()).collect(),
            values,
        }
    }

    /// Which predicates stand for object fluents.
    pub(crate) fn values(&self) -> &ValuePredicates {
        &self.values
    }

    pub(crate) fn pattern(&self, pattern: &Pattern) -> String {
        self.open(&self.predicates[pattern.predicate], &pattern.arguments)
    }

    /// `(go ?from b)`.
    fn open(&self, head: &Name, arguments: &[Result<ObjectId, Name>]) -> String {
        let mut text = format!("({head}");
        for argument in arguments {
            match argument {
                Ok(object) => write!(text, " {}", self.objects[*object]),
                Err(variable) => write!(text, " ?{}", variable.as_str().trim_start_matches('?')),
            }
            .expect("writing to a string does not fail");
        }
        text.push(')');
        text
    }

    /// `(f a b)`.
    pub(crate) fn fluent(&self, fluent: &GroundApplication) -> String {
        self.list(&self.functions[fluent.function], &fluent.arguments)
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
        let Operator { action, arguments, .. } = self.operator(operator);
        self.names.list(&self.names.actions[action.0 as usize], arguments)
    }

    /// A fluent as PDDL writes it, `(fuel a)`.
    pub fn fluent_name(&self, fluent: &GroundApplication) -> String {
        self.names.fluent(fluent)
    }

    /// A pattern as PDDL writes it, `(road ?from b)`.
    pub fn pattern_name(&self, pattern: &Pattern) -> String {
        self.names.pattern(pattern)
    }

    /// An action with open arguments, `(go ?from b)`.
    pub fn schema_name(&self, action: ActionId, arguments: &[Result<ObjectId, Name>]) -> String {
        self.names.open(&self.names.actions[action.0 as usize], arguments)
    }

    /// A ground atom as PDDL writes it.
    pub fn atom_name(&self, atom: &GroundAtom) -> String {
        self.names.list(&self.names.predicates[atom.predicate], &atom.arguments)
    }

    /// A fact as PDDL writes it; facts that grounding made up are `(auxiliary-N)`.
    pub fn fact_name(&self, fact: FactId) -> String {
        match (&self.facts[fact].atom, &self.facts[fact].value) {
            (Some(atom), _) => self.atom_name(atom),
            (None, Some(ObjectValue { fluent, object })) => {
                format!("(= {} {})", self.names.fluent(fluent), self.names.objects[*object])
            }
            (None, None) if self.facts[fact].compares => {
                let own = self.numeric.comparisons.iter().find(|c| c.fact == fact);
                own.map_or_else(String::new, |c| self.comparison_name(c.relation, &c.expression))
            }
            (None, None) => format!("(auxiliary-{})", fact.0),
        }
    }
}
