//! The semantics of PDDL, read off its definition without a thought for speed.
//!
//! A state is a set of atoms and a map of fluents, copied at each step; quantifiers try every object; derived
//! predicates are derived anew for every state. It shares the model of `pddl` with the validator and nothing else.
//! A comparison with an undefined fluent is neither true nor false (Kleene's logic); only what is true holds.

use crate::fraction::Fraction;
use pddl::PlanStep;
use pddl::model::{
    Action, Application, ArithmeticOperator, AssignOperator, AssignedValue, Atom, Comparison, Condition,
    ConditionKind, Constraint, ConstraintKind, Domain, Effect, EffectKind, Expression, ExpressionKind,
    FluentValue, Idx, Name, Object, ObjectId, PredicateId, Problem, Term, TypeId, TypeSet, VariableId,
    Variables,
};
use std::collections::{BTreeMap, BTreeSet};

pub type Atomic = (PredicateId, Vec<ObjectId>);
pub type Fluent = (pddl::model::FunctionId, Vec<ObjectId>);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    Number(Fraction),
    Object(ObjectId),
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    pub atoms: BTreeSet<Atomic>,
    pub fluents: BTreeMap<Fluent, Value>,
}

/// The values of variables.
pub type Binding = Vec<Option<ObjectId>>;

/// What is wrong with a plan, and with which step, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    Precondition(usize),
    Effect(usize),
    Duration(usize),
    Invariant(usize),
    /// Two that happen at one time.
    Interference,
    /// Something runs that has no value.
    Change,
    Constraint,
    Goal,
}

/// What is to be said: the metric's value, or the step that fails.
pub type Judgement = Result<Option<Fraction>, Fault>;

pub struct World<'a> {
    pub domain: &'a Domain,
    pub problem: &'a Problem,
}

pub fn empty(variables: &Variables, arguments: &[ObjectId]) -> Binding {
    let mut binding: Binding = arguments.iter().copied().map(Some).collect();
    binding.resize(variables.slots.len(), None);
    binding
}

fn object(term: Term, binding: &Binding) -> ObjectId {
    match term {
        Term::Object(object) => object,
        Term::Variable(variable) => binding[variable.index()].unwrap(),
    }
}

pub fn ground(atom: &Atom, binding: &Binding) -> Atomic {
    (atom.predicate, atom.arguments.iter().map(|&t| object(t, binding)).collect())
}

pub fn fluent(application: &Application, binding: &Binding) -> Fluent {
    (application.function, application.arguments.iter().map(|&t| object(t, binding)).collect())
}

/// A change of a fluent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Update {
    Assign(Option<Value>),
    Add(Fraction),
    Multiply(Fraction),
}

/// What an action does in a state.
#[derive(Clone, Debug, Default)]
pub struct Changes {
    pub adds: BTreeSet<Atomic>,
    pub deletes: BTreeSet<Atomic>,
    pub updates: BTreeMap<Fluent, Update>,
}

impl World<'_> {
    pub fn initial(&self) -> State {
        let mut state = State::default();
        for fact in &self.problem.init {
            state.atoms.insert((fact.predicate, fact.arguments.clone()));
        }
        for fact in &self.problem.fluents {
            let value = match fact.value {
                FluentValue::Number(number) => Value::Number(Fraction::of(number)),
                FluentValue::Object(object) => Value::Object(object),
            };
            state.fluents.insert((fact.application.function, fact.application.arguments.clone()), value);
        }
        state
    }

    /// Whether the type is one of those, or a parent of it is.
    fn is_below(&self, of: TypeId, types: &TypeSet) -> bool {
        let parents = &self.domain.types[of].parents;
        types.0.contains(&of) || parents.iter().any(|&parent| self.is_below(parent, types))
    }

    /// The objects of which one type is below one of those.
    pub fn objects(&self, types: &TypeSet) -> Vec<ObjectId> {
        let is_of = |object: &Object| object.types.declared().iter().any(|&of| self.is_below(of, types));
        let all = self.problem.objects.enumerate();
        all.filter(|(_, object)| is_of(object)).map(|(id, _)| id).collect()
    }

    /// Every way to give the variables values.
    pub fn bindings(&self, over: &[VariableId], variables: &Variables, binding: &Binding) -> Vec<Binding> {
        let mut all = vec![binding.clone()];
        for &variable in over {
            let values = self.objects(&variables[variable].types);
            let with = |binding: &Binding, value| {
                let mut binding = binding.clone();
                binding[variable.index()] = Some(value);
                binding
            };
            all = all.iter().flat_map(|b| values.iter().map(|&v| with(b, v)).collect::<Vec<_>>()).collect();
        }
        all
    }

    /// The state with what follows from it.
    pub fn closed(&self, state: &State) -> State {
        let mut state = state.clone();
        // The sample's derived predicates are in order of their strata.
        let derived: BTreeSet<PredicateId> = self.domain.axioms.iter().map(|axiom| axiom.predicate).collect();
        for predicate in derived {
            loop {
                let before = state.atoms.len();
                for axiom in self.domain.axioms.iter().filter(|axiom| axiom.predicate == predicate) {
                    let parameters: Vec<VariableId> = axiom.variables.parameter_ids().collect();
                    for binding in self.bindings(&parameters, &axiom.variables, &empty(&axiom.variables, &[]))
                    {
                        if self.holds(&axiom.body, &axiom.variables, &binding, &state) {
                            let arguments = parameters.iter().map(|p| binding[p.index()].unwrap()).collect();
                            state.atoms.insert((predicate, arguments));
                        }
                    }
                }
                if state.atoms.len() == before {
                    break;
                }
            }
        }
        state
    }

    pub fn number(&self, expression: &Expression, binding: &Binding, state: &State) -> Option<Fraction> {
        match &expression.kind {
            ExpressionKind::Number(value) => Some(Fraction::of(*value)),
            ExpressionKind::Fluent(application) => match state.fluents.get(&fluent(application, binding))? {
                Value::Number(number) => Some(*number),
                Value::Object(_) => None,
            },
            ExpressionKind::Arithmetic(operator, operands) => {
                let values: Option<Vec<Fraction>> =
                    operands.iter().map(|o| self.number(o, binding, state)).collect();
                let values = values?;
                let (&first, rest) = values.split_first()?;
                if rest.is_empty() && *operator == ArithmeticOperator::Subtract {
                    return Some(first.negated());
                }
                rest.iter().try_fold(first, |sum, &value| match operator {
                    ArithmeticOperator::Add => Some(sum.plus(value)),
                    ArithmeticOperator::Subtract => Some(sum.minus(value)),
                    ArithmeticOperator::Multiply => Some(sum.times(value)),
                    ArithmeticOperator::Divide => Some(sum.times(value.inverse()?)),
                })
            }
            ExpressionKind::Duration | ExpressionKind::TotalTime | ExpressionKind::IsViolated(_) => None,
        }
    }

    pub fn truth(
        &self,
        condition: &Condition,
        variables: &Variables,
        binding: &Binding,
        state: &State,
    ) -> Option<bool> {
        let of = |part: &Condition| self.truth(part, variables, binding, state);
        let all = |truths: &[Option<bool>]| {
            if truths.contains(&Some(false)) {
                Some(false)
            } else {
                (!truths.contains(&None)).then_some(true)
            }
        };
        let any = |truths: &[Option<bool>]| {
            let turned: Vec<_> = truths.iter().map(|t| t.map(|t| !t)).collect();
            all(&turned).map(|t| !t)
        };
        match &condition.kind {
            ConditionKind::And(parts) => all(&parts.iter().map(of).collect::<Vec<_>>()),
            ConditionKind::Or(parts) => any(&parts.iter().map(of).collect::<Vec<_>>()),
            ConditionKind::Not(part) => of(part).map(|truth| !truth),
            ConditionKind::Imply(if_, then) => any(&[of(if_).map(|truth| !truth), of(then)]),
            ConditionKind::Exists(over, body) | ConditionKind::Forall(over, body) => {
                let bindings = self.bindings(over, variables, binding);
                let truths: Vec<_> = bindings.iter().map(|b| self.truth(body, variables, b, state)).collect();
                if matches!(condition.kind, ConditionKind::Exists(..)) { any(&truths) } else { all(&truths) }
            }
            ConditionKind::Atom(atom) => Some(state.atoms.contains(&ground(atom, binding))),
            ConditionKind::HasType(term, types) => {
                Some(self.objects(types).contains(&object(*term, binding)))
            }
            ConditionKind::Same(a, b) => Some(object(*a, binding) == object(*b, binding)),
            ConditionKind::Compare(comparison, a, b) => {
                let (a, b) = (self.number(a, binding, state)?, self.number(b, binding, state)?);
                Some(match comparison {
                    Comparison::Less => a < b,
                    Comparison::LessEqual => a <= b,
                    Comparison::Equal => a == b,
                    Comparison::GreaterEqual => a >= b,
                    Comparison::Greater => a > b,
                })
            }
            ConditionKind::FluentIs(application, term) => {
                let value = state.fluents.get(&fluent(application, binding)).copied();
                Some(value == Some(Value::Object(object(*term, binding))))
            }
        }
    }

    pub fn holds(
        &self,
        condition: &Condition,
        variables: &Variables,
        binding: &Binding,
        state: &State,
    ) -> bool {
        self.truth(condition, variables, binding, state) == Some(true)
    }

    /// What an effect does; nothing where it contradicts itself or reads what has no value.
    pub fn collect(
        &self,
        effect: &Effect,
        variables: &Variables,
        binding: &Binding,
        state: &State,
        into: &mut Changes,
    ) -> Option<()> {
        match &effect.kind {
            EffectKind::And(parts) => {
                parts.iter().try_for_each(|part| self.collect(part, variables, binding, state, into))?;
            }
            EffectKind::Add(atom) => into.adds.extend([ground(atom, binding)]),
            EffectKind::Delete(atom) => into.deletes.extend([ground(atom, binding)]),
            EffectKind::Forall(over, body) => {
                for binding in self.bindings(over, variables, binding) {
                    self.collect(body, variables, &binding, state, into)?;
                }
            }
            EffectKind::When(guard, body) => {
                if self.holds(guard, variables, binding, state) {
                    self.collect(body, variables, binding, state, into)?;
                }
            }
            EffectKind::Assign(operator, application, value) => {
                let update = match (operator, value) {
                    (_, AssignedValue::Undefined) => Update::Assign(None),
                    (_, AssignedValue::Object(term)) => {
                        Update::Assign(Some(Value::Object(object(*term, binding))))
                    }
                    (operator, AssignedValue::Number(expression)) => {
                        let number = self.number(expression, binding, state)?;
                        match operator {
                            AssignOperator::Assign => Update::Assign(Some(Value::Number(number))),
                            AssignOperator::Increase => Update::Add(number),
                            AssignOperator::Decrease => Update::Add(number.negated()),
                            AssignOperator::ScaleUp => Update::Multiply(number),
                            AssignOperator::ScaleDown => Update::Multiply(number.inverse()?),
                        }
                    }
                };
                let target = fluent(application, binding);
                let both = match (into.updates.get(&target), update) {
                    (None, update) => update,
                    (Some(Update::Add(a)), Update::Add(b)) => Update::Add(a.plus(b)),
                    (Some(Update::Multiply(a)), Update::Multiply(b)) => Update::Multiply(a.times(b)),
                    (Some(Update::Assign(a)), Update::Assign(b)) if *a == b => update,
                    _ => return None,
                };
                into.updates.insert(target, both);
            }
        }
        Some(())
    }

    pub fn apply(&self, changes: &Changes, state: &mut State) -> Option<()> {
        let mut fluents = state.fluents.clone();
        for (target, &update) in &changes.updates {
            let value = match (update, state.fluents.get(target)) {
                (Update::Assign(value), _) => value,
                (Update::Add(by), Some(Value::Number(number))) => Some(Value::Number(number.plus(by))),
                (Update::Multiply(by), Some(Value::Number(number))) => Some(Value::Number(number.times(by))),
                _ => return None,
            };
            match value {
                Some(value) => fluents.insert(target.clone(), value),
                None => fluents.remove(target),
            };
        }
        state.fluents = fluents;
        state.atoms.retain(|atom| !changes.deletes.contains(atom));
        state.atoms.extend(changes.adds.iter().cloned());
        Some(())
    }

    /// Every instance of an action: its parameters stand for any object of their types.
    pub fn instances(&self) -> Vec<PlanStep> {
        let mut all = Vec::new();
        for (id, action) in self.domain.actions.enumerate() {
            let parameters: Vec<VariableId> = action.variables.parameter_ids().collect();
            for binding in self.bindings(&parameters, &action.variables, &empty(&action.variables, &[])) {
                let arguments = parameters.iter().map(|p| binding[p.index()].unwrap()).collect();
                all.push(PlanStep { action: id, arguments, span: pddl::Span::default() });
            }
        }
        all
    }

    /// The state after a step; `None` if it cannot be taken.
    pub fn successor(&self, state: &State, step: &PlanStep) -> Option<State> {
        let action = &self.domain.actions[step.action];
        let (seen, binding) = (self.closed(state), empty(&action.variables, &step.arguments));
        let (mut changes, mut after) = (Changes::default(), state.clone());
        if !self.holds(&action.precondition, &action.variables, &binding, &seen) {
            return None;
        }
        self.collect(&action.effect, &action.variables, &binding, &seen, &mut changes)?;
        self.apply(&changes, &mut after)?;
        Some(after)
    }

    /// A plan without times.
    pub fn judge(&self, steps: &[PlanStep]) -> Judgement {
        let mut state = self.initial();
        let mut trajectory = vec![(Fraction::ZERO, self.closed(&state))];
        let mut violated = Vec::new();
        for (index, step) in steps.iter().enumerate() {
            let action: &Action = &self.domain.actions[step.action];
            let seen = &trajectory.last().unwrap().1;
            let binding = empty(&action.variables, &step.arguments);
            if !self.holds(&action.precondition, &action.variables, &binding, seen) {
                return Err(Fault::Precondition(index));
            }
            for preference in &action.preferences {
                for binding in self.bindings(&preference.forall, &action.variables, &binding) {
                    if !self.holds(&preference.body, &action.variables, &binding, seen) {
                        violated.extend(preference.name.clone());
                    }
                }
            }
            let mut changes = Changes::default();
            self.collect(&action.effect, &action.variables, &binding, seen, &mut changes)
                .and_then(|()| self.apply(&changes, &mut state))
                .ok_or(Fault::Effect(index))?;
            trajectory.push((Fraction::whole(index + 1), self.closed(&state)));
        }
        self.finish(&trajectory, violated)
    }

    /// What is asked of the whole trajectory and of its end.
    pub fn finish(&self, trajectory: &[(Fraction, State)], mut violated: Vec<Name>) -> Judgement {
        for constraints in [&self.domain.constraints, &self.problem.constraints] {
            let variables = &constraints.variables;
            let start = empty(variables, &[]);
            if constraints.hard.iter().any(|hard| !self.satisfied(hard, variables, &start, trajectory)) {
                return Err(Fault::Constraint);
            }
            for preference in &constraints.preferences {
                for binding in self.bindings(&preference.forall, variables, &start) {
                    if !self.satisfied(&preference.body, variables, &binding, trajectory) {
                        violated.extend(preference.name.clone());
                    }
                }
            }
        }
        let (variables, last) = (&self.problem.goal_variables, &trajectory.last().unwrap().1);
        let start = empty(variables, &[]);
        if !self.holds(&self.problem.goal, variables, &start, last) {
            return Err(Fault::Goal);
        }
        for preference in &self.problem.preferences {
            for binding in self.bindings(&preference.forall, variables, &start) {
                if !self.holds(&preference.body, variables, &binding, last) {
                    violated.extend(preference.name.clone());
                }
            }
        }
        Ok(self.problem.metric.as_ref().and_then(|metric| self.metric(&metric.expression, last, &violated)))
    }

    /// The sample's metrics are sums of products.
    fn metric(&self, expression: &Expression, last: &State, violated: &[Name]) -> Option<Fraction> {
        match &expression.kind {
            ExpressionKind::IsViolated(name) => {
                Some(Fraction::whole(violated.iter().filter(|v| *v == name).count()))
            }
            ExpressionKind::Arithmetic(ArithmeticOperator::Add, parts) => parts
                .iter()
                .try_fold(Fraction::ZERO, |sum, part| Some(sum.plus(self.metric(part, last, violated)?))),
            ExpressionKind::Arithmetic(ArithmeticOperator::Multiply, parts) => {
                parts.iter().try_fold(Fraction::whole(1), |product, part| {
                    Some(product.times(self.metric(part, last, violated)?))
                })
            }
            _ => self.number(expression, &Vec::new(), last),
        }
    }

    /// Whether a trajectory satisfies a constraint that is not nested: the definitions of PDDL 3, one for one.
    fn satisfied(
        &self,
        constraint: &Constraint,
        variables: &Variables,
        binding: &Binding,
        trajectory: &[(Fraction, State)],
    ) -> bool {
        let truth = |part: &Constraint| -> Vec<bool> {
            let ConstraintKind::Holds(condition) = &part.kind else {
                panic!("samples do not nest constraints")
            };
            trajectory.iter().map(|(_, state)| self.holds(condition, variables, binding, state)).collect()
        };
        let time = |i: usize| trajectory[i].0;
        let moment = |decimal: &pddl::Decimal| Fraction::of(decimal.to_f64());
        let last = trajectory.len() - 1;
        match &constraint.kind {
            ConstraintKind::And(parts) => {
                parts.iter().all(|part| self.satisfied(part, variables, binding, trajectory))
            }
            ConstraintKind::AtEnd(a) => truth(a)[last],
            ConstraintKind::Always(a) => truth(a).into_iter().all(|t| t),
            ConstraintKind::Sometime(a) => truth(a).into_iter().any(|t| t),
            ConstraintKind::Within(limit, a) => {
                let a = truth(a);
                (0..=last).any(|i| a[i] && time(i) <= moment(limit))
            }
            ConstraintKind::AtMostOnce(a) => {
                let a = truth(a);
                // If it holds in a state then it holds up to some state, and never after that.
                (0..=last).all(|i| {
                    !a[i] || (i..=last).any(|j| (i..=j).all(|k| a[k]) && (j + 1..=last).all(|k| !a[k]))
                })
            }
            ConstraintKind::SometimeAfter(a, b) => {
                let (a, b) = (truth(a), truth(b));
                (0..=last).all(|i| !a[i] || (i..=last).any(|j| b[j]))
            }
            ConstraintKind::SometimeBefore(a, b) => {
                let (a, b) = (truth(a), truth(b));
                (0..=last).all(|i| !a[i] || (0..i).any(|j| b[j]))
            }
            ConstraintKind::AlwaysWithin(limit, a, b) => {
                let (a, b) = (truth(a), truth(b));
                (0..=last)
                    .all(|i| !a[i] || (i..=last).any(|j| b[j] && time(j).minus(time(i)) <= moment(limit)))
            }
            ConstraintKind::HoldDuring(from, until, a) => {
                // Every state that lasts into the window must have it; the last one lasts for ever.
                let (a, from, until) = (truth(a), moment(from), moment(until));
                (0..=last).all(|i| a[i] || time(i) >= until || i < last && time(i + 1) <= from)
            }
            ConstraintKind::HoldAfter(from, a) => {
                let (a, from) = (truth(a), moment(from));
                (0..=last).all(|i| a[i] || i < last && time(i + 1) <= from)
            }
            _ => panic!("samples have no other constraints"),
        }
    }
}
