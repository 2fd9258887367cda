//! The names from domain and problem that a grounded task keeps.

use super::values::ValuePredicates;
use pddl::model::{Domain, FunctionId, GroundApplication, IndexVec, Name, ObjectId, PredicateId, Problem};
use std::fmt::Write;

/// The names from domain and problem that a grounded task needs.
#[derive(Clone, Debug)]
pub(crate) struct Names {
    pub(super) actions: Vec<Name>,
    pub(super) predicates: IndexVec<PredicateId, Name>,
    pub(super) functions: IndexVec<FunctionId, Name>,
    pub(super) objects: IndexVec<ObjectId, Name>,
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

    /// The predicates that stand for object fluents.
    pub(crate) fn values(&self) -> &ValuePredicates {
        &self.values
    }

    /// `(go ?from b)`.
    pub(super) fn open(&self, head: &Name, arguments: &[Result<ObjectId, Name>]) -> String {
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

    pub(super) fn list(&self, head: &Name, arguments: &[ObjectId]) -> String {
        let mut text = format!("({head}");
        for &o in arguments {
            write!(text, " {}", self.objects[o]).expect("writing to a string does not fail");
        }
        text.push(')');
        text
    }
}
