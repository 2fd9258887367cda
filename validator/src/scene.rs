//! The input of an evaluation: the variables of a schema with their values, and the state.
//!
//! A binding is an array with an entry for each variable of the schema, including quantified ones, so nothing is ever
//! substituted. A quantified variable is unbound outside of its quantifier.

use crate::number::Number;
use crate::state::State;
use crate::universe::Universe;
use crate::verdict::Violations;
use pddl::model::{Extent, Idx, ObjectId, Term, VariableId, Variables};

/// The values of a schema's variables.
#[derive(Clone, Debug, Default)]
pub(crate) struct Binding(Vec<Option<ObjectId>>);

impl Binding {
    /// Binds the parameters to `arguments`; all other variables are unbound.
    pub(crate) fn new(variables: &Variables, arguments: &[ObjectId]) -> Self {
        let mut binding = Self::default();
        binding.reset(variables, arguments);
        binding
    }

    pub(crate) fn reset(&mut self, variables: &Variables, arguments: &[ObjectId]) {
        self.0.clear();
        self.0.extend(arguments.iter().copied().map(Some));
        self.0.resize(variables.slots.len(), None);
    }

    pub(crate) fn get(&self, variable: VariableId) -> Option<ObjectId> {
        self.0[variable.index()]
    }

    pub(crate) fn set(&mut self, variable: VariableId, object: Option<ObjectId>) {
        self.0[variable.index()] = object;
    }

    /// The object of a term; `None` for an unbound variable.
    pub(crate) fn term(&self, term: Term) -> Option<ObjectId> {
        match term {
            Term::Object(object) => Some(object),
            Term::Variable(variable) => self.get(variable),
        }
    }

    /// The object of a term that is bound.
    pub(crate) fn object(&self, term: Term) -> ObjectId {
        self.term(term).expect("a condition is evaluated inside the quantifiers that bind its variables")
    }

    /// Calls `with` with the objects of `terms`, without allocating for ordinary arities.
    pub(crate) fn with_objects<R>(&self, terms: &[Term], with: impl FnOnce(&[ObjectId]) -> R) -> R {
        let mut few = [ObjectId(0); 8];
        if let Some(few) = few.get_mut(..terms.len()) {
            for (place, &term) in few.iter_mut().zip(terms) {
                *place = self.object(term);
            }
            with(few)
        } else {
            with(&terms.iter().map(|&t| self.object(t)).collect::<Vec<_>>())
        }
    }
}

/// A state seen through a schema's variables.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) universe: &'a Universe,
    pub(crate) state: &'a State,
    pub(crate) variables: &'a Variables,
    pub(crate) clock: Clock<'a>,
}

/// The values besides the state that an expression may read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock<'a> {
    /// `total-time`: seconds, or steps of a sequential plan.
    pub(crate) now: Number,
    /// `?duration`, inside a durative action.
    pub(crate) duration: Option<Number>,
    /// The violations that `is-violated` counts in a metric.
    pub(crate) violations: Option<&'a Violations>,
}

impl Clock<'_> {
    /// The clock after this many steps.
    pub(crate) fn steps(steps: u32) -> Self {
        Self::at(Number::integer(i64::from(steps)))
    }

    pub(crate) fn at(now: Number) -> Self {
        Self { now, duration: None, violations: None }
    }
}

impl<'a> Scene<'a> {
    pub(crate) fn extent(&self, variable: VariableId) -> &'a Extent {
        self.universe.extent(&self.variables[variable].types)
    }
}

/// The least work for an instance, besides a step of a search: it is recorded and kept.
const INSTANCE: usize = 10;

/// Visits each binding of `variables` until the budget is exhausted. The variables are unbound on
/// return.
pub(crate) fn each_instance(
    scene: Scene<'_>,
    variables: &[VariableId],
    binding: &mut Binding,
    visit: &mut dyn FnMut(&mut Binding),
) {
    let Some((&first, rest)) = variables.split_first() else { return visit(binding) };
    for &object in scene.extent(first).objects() {
        if !scene.state.work.spend(INSTANCE) {
            break;
        }
        binding.set(first, Some(object));
        each_instance(scene, rest, binding, visit);
    }
    binding.set(first, None);
}
