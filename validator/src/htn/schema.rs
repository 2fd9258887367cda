//! The network of a method or of the problem, in the form that subtasks are matched against.

use crate::scene::Binding;
use crate::universe::Universe;
use pddl::model::{
    Condition, ConditionKind, Method, ObjectId, SubtaskHead, TaskNetwork, Term, VariableId, Variables,
};
use rustc_hash::FxHashMap;

/// A network under variables; the initial one decomposes no task and has no precondition.
#[derive(Debug)]
pub(super) struct Schema<'a> {
    pub(super) variables: &'a Variables,
    pub(super) task_arguments: &'a [Term],
    pub(super) network: &'a TaskNetwork,
    /// The parameters that the task's arguments and the subtasks determine.
    pub(super) determined: Vec<VariableId>,
    /// The constraints, with an existential quantifier over each parameter that no task determines.
    pub(super) constraints: Condition,
    /// The constraints and the precondition, if the method has one.
    pub(super) precondition: Option<Condition>,
    /// For each subtask: those that come directly before it.
    pub(super) before: Vec<Vec<u32>>,
    /// For each subtask: those that come directly after it.
    pub(super) after: Vec<Vec<u32>>,
    /// The subtasks in an order that respects `before`.
    pub(super) order: Vec<u32>,
    /// For each subtask: the last earlier one in the text that is interchangeable with it.
    pub(super) twin: Vec<Option<u32>>,
}

impl<'a> Schema<'a> {
    pub(super) fn of_method(method: &'a Method) -> Self {
        let precondition = (!method.precondition.is_always()).then_some(&method.precondition);
        Self::new(&method.variables, &method.task_arguments, &method.network, precondition)
    }

    pub(super) fn of_problem(variables: &'a Variables, network: &'a TaskNetwork) -> Self {
        Self::new(variables, &[], network, None)
    }

    fn new(
        variables: &'a Variables,
        task_arguments: &'a [Term],
        network: &'a TaskNetwork,
        precondition: Option<&Condition>,
    ) -> Self {
        let mut determined = vec![false; variables.parameters];
        let terms = network.subtasks.iter().flat_map(|subtask| &subtask.arguments);
        for term in task_arguments.iter().chain(terms) {
            if let Term::Variable(VariableId(variable)) = *term
                && let Some(place) = determined.get_mut(variable as usize)
            {
                *place = true;
            }
        }
        let (determined, free): (Vec<VariableId>, Vec<VariableId>) =
            variables.parameter_ids().partition(|variable| determined[variable.0 as usize]);
        let span = network.constraints.first().or(precondition).map_or_else(Default::default, |c| c.span);
        let some = |mut parts: Vec<Condition>| {
            let body = match parts.len() {
                1 => parts.remove(0),
                _ => Condition { kind: ConditionKind::And(parts), span },
            };
            if free.is_empty() {
                body
            } else {
                Condition { kind: ConditionKind::Exists(free.clone(), Box::new(body)), span }
            }
        };
        let constraints = some(network.constraints.clone());
        let precondition = precondition
            .map(|condition| some(network.constraints.iter().chain([condition]).cloned().collect()));
        let count = network.subtasks.len();
        let (mut before, mut after) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        for ordering in &network.orderings {
            before[ordering.after as usize].push(ordering.before);
            after[ordering.before as usize].push(ordering.after);
        }
        before.iter_mut().chain(&mut after).for_each(|neighbours| neighbours.sort_unstable());
        let order = linearisation(&before, &after);
        let mut twin = vec![None; count];
        let mut seen = FxHashMap::default();
        for (place, subtask) in (0u32..).zip(&network.subtasks) {
            let index = place as usize;
            let key = (subtask.head, &subtask.arguments, &before[index], &after[index]);
            twin[index] = seen.insert(key, place);
        }
        Self {
            variables,
            task_arguments,
            network,
            determined,
            constraints,
            precondition,
            before,
            after,
            order,
            twin,
        }
    }

    /// A durative subtask, if there is one: plans without times have no such steps.
    pub(super) fn durative(&self) -> Option<pddl::Span> {
        let durative = |head| matches!(head, SubtaskHead::DurativeAction(_));
        self.network.subtasks.iter().find(|subtask| durative(subtask.head)).map(|subtask| subtask.span)
    }
}

/// Topological order (Kahn 1962). The parser's networks have no cycles; a subtask on a cycle would
/// be left out.
fn linearisation(before: &[Vec<u32>], after: &[Vec<u32>]) -> Vec<u32> {
    let mut waits: Vec<usize> = before.iter().map(Vec::len).collect();
    let mut order: Vec<u32> = (0u32..).zip(&waits).filter(|(_, n)| **n == 0).map(|(i, _)| i).collect();
    let mut next = 0;
    while let Some(&subtask) = order.get(next) {
        next += 1;
        for &later in &after[subtask as usize] {
            waits[later as usize] -= 1;
            if waits[later as usize] == 0 {
                order.push(later);
            }
        }
    }
    order
}

/// Binds the terms to the objects, if the variables have that value or their type allows it.
/// Records the bound variables.
///
/// # Errors
/// Returns the first position that does not fit. Variables that were bound before stay bound and
/// are recorded.
pub(super) fn unify(
    universe: &Universe,
    variables: &Variables,
    terms: &[Term],
    objects: &[ObjectId],
    binding: &mut Binding,
    bound: &mut Vec<VariableId>,
) -> Result<(), usize> {
    if terms.len() != objects.len() {
        return Err(terms.len().min(objects.len()));
    }
    for (position, (&term, &object)) in terms.iter().zip(objects).enumerate() {
        match (binding.term(term), term) {
            (Some(known), _) if known == object => {}
            (None, Term::Variable(variable)) if universe.is_of(object, &variables[variable].types) => {
                binding.set(variable, Some(object));
                bound.push(variable);
            }
            _ => return Err(position),
        }
    }
    Ok(())
}
