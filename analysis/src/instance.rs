//! A domain with a problem, and the numbers in one of its states.

use pddl::model::{
    Domain, FluentValue, FunctionId, GroundApplication, Idx, IndexVec, ObjectId, Problem, TypeSet,
};
use rustc_hash::FxHashMap;

use crate::number::Number;

/// A domain with a problem.
#[derive(Clone, Copy, Debug)]
pub struct Instance<'a> {
    /// The domain.
    pub domain: &'a Domain,
    /// The problem.
    pub problem: &'a Problem,
}

impl Instance<'_> {
    /// Whether an object is of one of the types.
    pub fn is_of(&self, object: ObjectId, types: &TypeSet) -> bool {
        self.problem.objects[object].is_of(types, &self.domain.types)
    }
}

/// The values of one function.
#[derive(Clone, Debug, Default)]
struct Listed {
    values: FxHashMap<Box<[ObjectId]>, Number>,
    /// Whether a value is missing because an exact number cannot hold it.
    is_incomplete: bool,
}

/// The values of all numeric fluents in one state. A fluent that is not listed has no value.
#[derive(Clone, Debug)]
pub struct Values(IndexVec<FunctionId, Listed>);

impl Values {
    /// The values in the problem's initial state.
    pub fn initial(domain: &Domain, problem: &Problem) -> Self {
        let mut values = Self(domain.functions.iter().map(|_| Listed::default()).collect());
        for fact in &problem.fluents {
            let FluentValue::Number(value) = fact.value else { continue };
            match Number::from_f64(value) {
                Some(value) => values.set(&fact.application, Some(value)),
                None => values.0[fact.application.function].is_incomplete = true,
            }
        }
        values
    }

    /// Sets a fluent's value; `None` if it has no value.
    pub fn set(&mut self, fluent: &GroundApplication, value: Option<Number>) {
        let own = &mut self.0[fluent.function].values;
        match value {
            Some(value) => own.insert(fluent.arguments.as_slice().into(), value),
            None => own.remove(fluent.arguments.as_slice()),
        };
    }

    /// Marks every function as one of which values are missing.
    pub fn mark_incomplete(&mut self) {
        (0..self.0.len()).for_each(|f| self.0[FunctionId::from_index(f)].is_incomplete = true);
    }

    /// The value of a fluent.
    pub fn get(&self, function: FunctionId, arguments: &[ObjectId]) -> Option<Number> {
        self.0[function].values.get(arguments).copied()
    }

    /// The values of a function, with their arguments, in no particular order.
    pub fn of(&self, function: FunctionId) -> impl Iterator<Item = (&[ObjectId], Number)> {
        self.0[function].values.iter().map(|(arguments, &value)| (&**arguments, value))
    }

    /// Whether every value of the function is listed.
    pub fn is_complete(&self, function: FunctionId) -> bool {
        !self.0[function].is_incomplete
    }
}
