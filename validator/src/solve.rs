//! The bindings of quantified variables that satisfy a condition.
//!
//! Problem: trying every tuple of objects takes |objects|^n tests. Idea: a condition is a
//! conjunction of parts. Parts whose variables are all bound are tested at once. Atoms that must
//! hold bind variables from the atoms that do hold, those with the fewest candidates first.
//! Equalities bind directly. Only the remaining variables are tried object by object. Existential
//! quantifiers inside the conjunction are joined as well; their variables are not enumerated once
//! the requested variables are bound, because one witness is enough. Invariant: on return, every
//! variable that was open is unbound again.
//!
//! Cost: a nested-loop join with an index per argument position.

use crate::condition::Strictness;
use crate::scene::{Binding, Scene};
use crate::value::Value;
use pddl::model::{Atom, Condition, ConditionKind, Expression, ExpressionKind, ObjectId, Term, VariableId};
use std::ops::ControlFlow;

struct Part<'a> {
    condition: &'a Condition,
    wanted: bool,
    /// The open variables of the part.
    open: Vec<VariableId>,
}

/// A conjunction and the variables to bind.
pub(crate) struct Query<'a> {
    parts: Vec<Part<'a>>,
    open: Vec<VariableId>,
    strictness: Strictness,
}

type Visit<'v> = dyn FnMut(&mut Binding) -> ControlFlow<()> + 'v;

impl<'a> Query<'a> {
    /// The parts keep their order; a condition that is not a conjunction is one part.
    pub(crate) fn new(
        variables: &[VariableId],
        guards: &[(&'a Condition, bool)],
        strictness: Strictness,
    ) -> Self {
        let mut query = Self { parts: Vec::new(), open: variables.to_vec(), strictness };
        for &(condition, wanted) in guards {
            query.flatten(condition, wanted);
        }
        for part in &mut query.parts {
            each_variable(part.condition, &mut |variable| {
                if query.open.contains(&variable) && !part.open.contains(&variable) {
                    part.open.push(variable);
                }
            });
        }
        query
    }

    fn flatten(&mut self, condition: &'a Condition, wanted: bool) {
        match (&condition.kind, wanted) {
            (ConditionKind::And(parts), true) | (ConditionKind::Or(parts), false) => {
                for part in parts {
                    self.flatten(part, wanted);
                }
            }
            (ConditionKind::Not(part), _) => self.flatten(part, !wanted),
            (ConditionKind::Imply(if_, then), false) => {
                self.flatten(if_, true);
                self.flatten(then, false);
            }
            (ConditionKind::Exists(variables, body), true)
            | (ConditionKind::Forall(variables, body), false) => {
                self.open.extend(variables);
                self.flatten(body, wanted);
            }
            _ => self.parts.push(Part { condition, wanted, open: Vec::new() }),
        }
    }
}

fn each_term_variable(terms: &[Term], visit: &mut dyn FnMut(VariableId)) {
    for term in terms {
        if let Term::Variable(variable) = term {
            visit(*variable);
        }
    }
}

fn each_expression_variable(expression: &Expression, visit: &mut dyn FnMut(VariableId)) {
    expression.each(&mut |part| {
        if let ExpressionKind::Fluent(application) = &part.kind {
            each_term_variable(&application.arguments, visit);
        }
    });
}

fn each_variable(condition: &Condition, visit: &mut dyn FnMut(VariableId)) {
    condition.each(&mut |part| match &part.kind {
        ConditionKind::Atom(atom) => each_term_variable(&atom.arguments, visit),
        ConditionKind::HasType(term, _) => each_term_variable(&[*term], visit),
        ConditionKind::Same(left, right) => each_term_variable(&[*left, *right], visit),
        ConditionKind::Compare(_, left, right) => {
            each_expression_variable(left, visit);
            each_expression_variable(right, visit);
        }
        ConditionKind::FluentIs(application, value) => {
            each_term_variable(&application.arguments, visit);
            each_term_variable(&[*value], visit);
        }
        _ => {}
    });
}

/// How to continue when no part can be tested.
enum Choice<'a> {
    /// Bind from the atoms that hold.
    Join(usize, &'a Atom),
    /// The variable can only be this object (or none).
    Only(VariableId, Option<ObjectId>),
    /// Try the objects of its type.
    Try(VariableId),
}

impl Scene<'_> {
    /// Whether `body` is `wanted` for some binding of `variables`.
    pub(crate) fn some_binding(
        &self,
        variables: &[VariableId],
        body: &Condition,
        wanted: bool,
        strictness: Strictness,
        binding: &mut Binding,
    ) -> bool {
        let query = Query::new(variables, &[(body, wanted)], strictness);
        let mut done = vec![false; query.parts.len()];
        self.search(&query, &mut done, &[], binding, &mut |_| ControlFlow::Break(())).is_break()
    }

    /// Visits each binding of `variables` for which all `guards` have their wanted truth, until
    /// `visit` stops it.
    pub(crate) fn each_binding(
        &self,
        variables: &[VariableId],
        guards: &[(&Condition, bool)],
        strictness: Strictness,
        binding: &mut Binding,
        visit: &mut Visit<'_>,
    ) -> ControlFlow<()> {
        let query = Query::new(variables, guards, strictness);
        let mut done = vec![false; query.parts.len()];
        self.search(&query, &mut done, variables, binding, visit)
    }

    /// Visits each binding of `targets` that satisfies the query, until `visit` stops it.
    pub(crate) fn answer(
        &self,
        query: &Query<'_>,
        targets: &[VariableId],
        binding: &mut Binding,
        visit: &mut Visit<'_>,
    ) -> ControlFlow<()> {
        self.search(query, &mut vec![false; query.parts.len()], targets, binding, visit)
    }

    /// The same for answers in which one part, an atom that must hold, is one of `tuples`.
    pub(crate) fn answer_with<'t>(
        &self,
        query: &Query<'_>,
        targets: &[VariableId],
        (part, atom): (usize, &Atom),
        tuples: impl Iterator<Item = &'t [ObjectId]>,
        binding: &mut Binding,
        visit: &mut Visit<'_>,
    ) -> ControlFlow<()> {
        let mut done = vec![false; query.parts.len()];
        done[part] = true;
        self.match_each(atom, tuples, query, &mut done, targets, binding, visit)
    }

    fn search(
        &self,
        query: &Query<'_>,
        done: &mut [bool],
        targets: &[VariableId],
        binding: &mut Binding,
        visit: &mut Visit<'_>,
    ) -> ControlFlow<()> {
        if !self.state.work.spend(1) {
            return ControlFlow::Continue(());
        }
        if !targets.is_empty() && targets.iter().all(|&v| binding.get(v).is_some()) {
            let witness = self.search(query, done, &[], binding, &mut |_| ControlFlow::Break(()));
            return if witness.is_break() { visit(binding) } else { ControlFlow::Continue(()) };
        }
        let mut tested = Vec::new();
        let mut possible = true;
        for (index, part) in query.parts.iter().enumerate() {
            if !done[index] && part.open.iter().all(|&v| binding.get(v).is_some()) {
                if !self.satisfied(part.condition, part.wanted, query.strictness, binding) {
                    possible = false;
                    break;
                }
                done[index] = true;
                tested.push(index);
            }
        }
        let flow = if possible {
            match self.choose(query, done, binding) {
                None => visit(binding),
                Some(choice) => self.follow(&choice, query, done, targets, binding, visit),
            }
        } else {
            ControlFlow::Continue(())
        };
        for index in tested {
            done[index] = false;
        }
        flow
    }

    fn choose<'q>(&self, query: &Query<'q>, done: &[bool], binding: &Binding) -> Option<Choice<'q>> {
        let mut best: Option<(usize, Choice<'q>)> = None;
        for (index, part) in query.parts.iter().enumerate().filter(|&(i, p)| p.wanted && !done[i]) {
            let (size, choice) = match &part.condition.kind {
                ConditionKind::Atom(atom) => {
                    let fixed = || atom.arguments.iter().map(|&t| binding.term(t));
                    let size = self.state.facts[atom.predicate].estimate(fixed())
                        + self.state.derived[atom.predicate].estimate(fixed());
                    (size, Choice::Join(index, atom))
                }
                ConditionKind::Same(left, right) => match (*left, *right) {
                    (Term::Variable(v), other)
                        if binding.get(v).is_none() && binding.term(other).is_some() =>
                    {
                        (1, Choice::Only(v, binding.term(other)))
                    }
                    (other, Term::Variable(v))
                        if binding.get(v).is_none() && binding.term(other).is_some() =>
                    {
                        (1, Choice::Only(v, binding.term(other)))
                    }
                    _ => continue,
                },
                ConditionKind::FluentIs(application, Term::Variable(v))
                    if binding.get(*v).is_none()
                        && application.arguments.iter().all(|&t| binding.term(t).is_some()) =>
                {
                    let value = match self.fluent(application, binding) {
                        Some(Value::Object(object)) => Some(object),
                        _ => None,
                    };
                    (1, Choice::Only(*v, value))
                }
                _ => continue,
            };
            if best.as_ref().is_none_or(|(least, _)| size < *least) {
                best = Some((size, choice));
            }
        }
        let free = query
            .open
            .iter()
            .copied()
            .filter(|&v| binding.get(v).is_none())
            .min_by_key(|&v| self.extent(v).objects().len())?;
        let tries = self.extent(free).objects().len();
        match best {
            Some((size, choice)) if size <= tries.max(1) || matches!(choice, Choice::Join(..)) => {
                Some(choice)
            }
            _ => Some(Choice::Try(free)),
        }
    }

    fn follow(
        &self,
        choice: &Choice<'_>,
        query: &Query<'_>,
        done: &mut [bool],
        targets: &[VariableId],
        binding: &mut Binding,
        visit: &mut Visit<'_>,
    ) -> ControlFlow<()> {
        match *choice {
            Choice::Join(index, atom) => {
                done[index] = true;
                let flow = self.join(atom, query, done, targets, binding, visit);
                done[index] = false;
                flow
            }
            Choice::Only(variable, object) => match object {
                Some(object) if self.extent(variable).contains(object) => {
                    binding.set(variable, Some(object));
                    let flow = self.search(query, done, targets, binding, visit);
                    binding.set(variable, None);
                    flow
                }
                _ => ControlFlow::Continue(()),
            },
            Choice::Try(variable) => {
                let mut flow = ControlFlow::Continue(());
                for &object in self.extent(variable).objects() {
                    binding.set(variable, Some(object));
                    flow = self.search(query, done, targets, binding, visit);
                    if flow.is_break() {
                        break;
                    }
                }
                binding.set(variable, None);
                flow
            }
        }
    }

    fn join(
        &self,
        atom: &Atom,
        query: &Query<'_>,
        done: &mut [bool],
        targets: &[VariableId],
        binding: &mut Binding,
        visit: &mut Visit<'_>,
    ) -> ControlFlow<()> {
        let fixed: Vec<_> = atom.arguments.iter().map(|&t| binding.term(t)).collect();
        let facts = self.state.facts[atom.predicate].candidates(&fixed);
        let derived = self.state.derived[atom.predicate].candidates(&fixed);
        self.match_each(atom, facts.chain(derived), query, done, targets, binding, visit)
    }

    #[expect(clippy::too_many_arguments, reason = "the state of one search, on the stack")]
    fn match_each<'t>(
        &self,
        atom: &Atom,
        tuples: impl Iterator<Item = &'t [ObjectId]>,
        query: &Query<'_>,
        done: &mut [bool],
        targets: &[VariableId],
        binding: &mut Binding,
        visit: &mut Visit<'_>,
    ) -> ControlFlow<()> {
        let mut bound = Vec::with_capacity(atom.arguments.len());
        for tuple in tuples {
            let agrees = atom.arguments.iter().zip(tuple).all(|(&term, &object)| match binding.term(term) {
                Some(already) => already == object,
                None => match term {
                    Term::Variable(variable) if self.extent(variable).contains(object) => {
                        binding.set(variable, Some(object));
                        bound.push(variable);
                        true
                    }
                    _ => false,
                },
            });
            let flow = if agrees {
                self.search(query, done, targets, binding, visit)
            } else {
                ControlFlow::Continue(())
            };
            for variable in bound.drain(..) {
                binding.set(variable, None);
            }
            flow?;
        }
        ControlFlow::Continue(())
    }
}
