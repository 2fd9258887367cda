//! The high-level model: the names of the planner's facts and operators.
//!
//! Problem: LowToHigh speaks of `(introduced feeding)`, the planner of fact 17. Idea: ground the domain
//! once, at the start, and keep the map. Predicates and numbers that perception derives are exogenous, so that
//! grounding keeps every value that they can take and no replan grounds again; all others are as in the
//! problem. Cost: one hash look-up per fact or number that changes, and a copy of the state's bits.

use crate::arrivals::Arrival;
use crate::compression::{CompressionError, Meanwhile, compress};
use crate::goal::{GoalId, GoalText, Goals};
use crate::timing::{Duration, Timing};
use indexmap::{IndexMap, IndexSet};
use low_to_high::{Change, Fact, Fluent};
use pddl::model::{
    Condition, Domain, FluentFact, FluentValue, GroundApplication, Name, Object, ObjectId, ObjectTypes,
    PredicateId, Problem,
};
use planner::{
    FactId, Goal, GroundAtom, GroundError, GroundOptions, Number, OperatorId, State, Task, ground,
};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// The grounded task with its names.
#[derive(Clone, Debug)]
pub struct Model {
    domain: Domain,
    problem: Problem,
    task: Task,
    predicates: FxHashMap<Name, PredicateId>,
    objects: FxHashMap<Name, ObjectId>,
    exogenous: IndexSet<PredicateId>,
    /// The sensed fluents on which plans depend, with their value while the graph says nothing of them.
    numbers: IndexMap<Fluent, (GroundApplication, Option<Number>)>,
    /// Facts of the initial state that are not perceived, sorted.
    given: Vec<FactId>,
    goals: Goals,
    timing: Timing,
    meanwhile: Vec<Meanwhile>,
    /// What it was made from, to be made again with other objects.
    base: Arc<Base>,
    /// The objects that the problem does not have.
    arrivals: Vec<Arrival>,
}

/// What a model is made from.
#[derive(Debug)]
struct Base {
    domain: Domain,
    problem: Problem,
    predicates: Vec<Name>,
    numbers: Vec<(Name, Option<f64>)>,
    goals: Vec<GoalText>,
}

/// What perception derives of the planner's domain.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sensed<'s> {
    /// The predicates.
    pub predicates: &'s [Name],
    /// The functions, with the value of a fluent of which the graph says nothing.
    pub numbers: &'s [(Name, Option<f64>)],
}

/// Predicates, and no numbers.
impl<'s, T: AsRef<[Name]>> From<&'s T> for Sensed<'s> {
    fn from(predicates: &'s T) -> Self {
        Self { predicates: predicates.as_ref(), numbers: &[] }
    }
}

/// How what is perceived changed a state.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// The facts on which plans depend that changed, with their new truth; without derived ones.
    pub facts: Vec<(FactId, bool)>,
    /// Whether a number on which plans depend changed.
    pub numbers: bool,
}

impl Changes {
    /// Whether the state is as it was.
    pub fn is_empty(&self) -> bool {
        self.facts.is_empty() && !self.numbers
    }
}

/// Why there is no model.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// The domain cannot be grounded.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// A durative action cannot be planned as one step.
    #[error(transparent)]
    Concurrency(#[from] CompressionError),
}

/// An operator by name: `introduce`, `[person, opening, feeding]`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, serde::Serialize)]
pub struct Step {
    /// The action.
    pub action: Name,
    /// Its arguments.
    pub arguments: Vec<Name>,
}

impl Model {
    /// Grounds `problem`.
    ///
    /// # Errors
    /// If the planner cannot ground the domain.
    pub fn new<'s>(
        domain: Domain,
        problem: Problem,
        sensed: impl Into<Sensed<'s>>,
    ) -> Result<Self, ModelError> {
        Self::with_goals(domain, problem, sensed, Vec::new())
    }

    /// The same for several goals; without any, the goal is the problem's own.
    ///
    /// # Errors
    /// If the planner cannot ground the domain.
    pub fn with_goals<'s>(
        domain: Domain,
        problem: Problem,
        sensed: impl Into<Sensed<'s>>,
        goals: Vec<GoalText>,
    ) -> Result<Self, ModelError> {
        let sensed = sensed.into();
        let (predicates, numbers) = (sensed.predicates.to_vec(), sensed.numbers.to_vec());
        Self::of(Arc::new(Base { domain, problem, predicates, numbers, goals }), Vec::new())
    }

    /// The same model with other objects that the problem does not have.
    ///
    /// # Errors
    /// If the planner cannot ground the domain.
    pub(crate) fn with_arrivals(&self, arrivals: &[Arrival]) -> Result<Self, ModelError> {
        Self::of(Arc::clone(&self.base), arrivals.to_vec())
    }

    fn of(base: Arc<Base>, arrivals: Vec<Arrival>) -> Result<Self, ModelError> {
        let (timed, mut problem) = (&base.domain, base.problem.clone());
        for Arrival { name, of } in &arrivals {
            if let Some(of) = timed.types.find(of) {
                let (name, types) = (name.clone(), ObjectTypes::one(of));
                problem.objects.push(Object { name, types, span: problem.goal_span });
            }
        }
        let sensed = Sensed { predicates: &base.predicates, numbers: &base.numbers };
        let goals = base.goals.clone();
        let compressed = compress(timed, &problem)?;
        let mut domain = compressed.domain.clone();
        let mut exogenous: IndexSet<_> =
            sensed.predicates.iter().filter_map(|name| domain.predicate(name)).collect();
        // Whether an action is under way is the executive's to know.
        exogenous.extend(compressed.steps.iter().map(|steps| steps.under_way));
        let volatile: Vec<_> = exogenous.iter().copied().collect();
        let functions: Vec<_> = sensed.numbers.iter().filter_map(|(name, _)| domain.function(name)).collect();
        let (goals, kept) = Goals::new(goals, &mut domain, &mut problem, &volatile);
        let options = GroundOptions {
            exogenous: &volatile,
            exogenous_functions: &functions,
            kept: &kept,
            ..GroundOptions::default()
        };
        let task = ground(&domain, &problem, &options)?;
        let predicates = domain.predicates.enumerate().map(|(id, p)| (p.name.clone(), id)).collect();
        let objects = problem.objects.enumerate().map(|(id, o)| (o.name.clone(), id)).collect();
        let given = task
            .initial_state()
            .facts()
            .into_iter()
            .filter(|&fact| {
                let atom = task.facts()[fact].atom.as_ref();
                atom.is_none_or(|atom| !exogenous.contains(&atom.predicate))
            })
            .collect();
        let numbers = task.numbers(task.initial_state()).filter_map(|(application, _)| {
            let name = &domain.functions[application.function].name;
            let (function, default) = sensed.numbers.iter().find(|(other, _)| other == name)?;
            let objects = application.arguments.iter().map(|&o| problem.objects[o].name.clone());
            let fluent = Fluent { function: function.clone(), arguments: objects.collect() };
            Some((fluent, (application.clone(), default.and_then(Number::from_f64))))
        });
        let numbers = numbers.collect();
        let timing = Timing::new(timed, &compressed, &task);
        let meanwhile = compressed.meanwhile;
        Ok(Self {
            domain,
            problem,
            task,
            predicates,
            objects,
            exogenous,
            numbers,
            given,
            goals,
            timing,
            meanwhile,
            base,
            arrivals,
        })
    }

    /// The objects that the problem does not have.
    pub fn arrivals(&self) -> &[Arrival] {
        &self.arrivals
    }

    /// These operators of another model; those of an object that is gone are left out.
    pub(crate) fn counterparts(&self, other: &Self, operators: &[OperatorId]) -> Vec<Option<OperatorId>> {
        let steps: Vec<Step> = operators.iter().map(|&operator| other.step(operator)).collect();
        let own = self.operators(&steps).into_iter().zip(operators);
        own.map(|(own, &operator)| match other.timing.is_rest(&other.task, operator) {
            true => self.timing.rest(&self.task, own?),
            false => own,
        })
        .collect()
    }

    /// The operators of these names; those of an object that is gone are left out. Of a durative action, the whole.
    pub(crate) fn operators(&self, steps: &[Step]) -> Vec<Option<OperatorId>> {
        let mut known: FxHashMap<Step, OperatorId> = FxHashMap::default();
        let is_whole = |operator: &OperatorId| !self.timing.is_rest(&self.task, *operator);
        for operator in self.task.operators().ids().filter(is_whole) {
            known.entry(self.step(operator)).or_insert(operator);
        }
        steps.iter().map(|step| known.get(step).copied()).collect()
    }

    /// The grounded task.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// What is known of durative actions.
    pub(crate) fn timing(&self) -> &Timing {
        &self.timing
    }

    /// The facts that the actions are under way of which these operators are the rest.
    pub(crate) fn under_way(&self, operators: &[OperatorId]) -> Vec<FactId> {
        let rests = operators.iter().filter(|&&operator| self.timing.is_rest(&self.task, operator));
        rests.filter_map(|&operator| self.timing.under_way(&self.task, operator)).collect()
    }

    /// Actions that could use what another one gives only while it runs: no plan does.
    pub fn meanwhile(&self) -> &[Meanwhile] {
        &self.meanwhile
    }

    /// For each step of a plan, the earlier steps that must be done before it starts.
    pub fn order(&self, plan: &[OperatorId]) -> Vec<Vec<usize>> {
        self.timing.order(&self.domain, &self.task, plan)
    }

    /// How long a step takes from a state; `None` for an action without a duration.
    pub fn duration(&self, step: OperatorId, state: &State) -> Option<Duration> {
        self.timing.duration(&self.problem, &self.task, step, state)
    }

    /// The domain as it is planned: each durative action as instantaneous ones.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// The problem as it was given.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The goals, by their numbers.
    pub fn goals(&self) -> &[GoalText] {
        self.goals.texts()
    }

    /// Whether the mission names its goals; otherwise the problem's own is the only one.
    pub fn names_goals(&self) -> bool {
        self.goals.are_named()
    }

    /// The hard ones among these goals, in levels of the same priority, the highest first.
    pub(crate) fn levels(&self, goals: &[GoalId]) -> Vec<Vec<GoalId>> {
        self.goals.levels(goals)
    }

    /// A soft goal as conditions, with its penalty; `None` for a hard one.
    pub(crate) fn soft(&self, goal: GoalId) -> Option<(Vec<Condition>, f64)> {
        self.goals.soft(goal)
    }

    /// All of these goals as one goal of the planner.
    pub fn goal(&self, goals: &[GoalId]) -> Goal {
        self.goals.together(&self.task, goals)
    }

    /// The problem with these goals as its goal.
    pub(crate) fn problem_for(&self, goals: &[GoalId]) -> Problem {
        self.goals.problem(&self.problem, goals)
    }

    /// The planner's number of a perceived fact; `None` if no plan depends on it.
    pub fn fact(&self, fact: &Fact) -> Option<FactId> {
        let predicate = *self.predicates.get(&fact.predicate)?;
        let arguments: Option<Vec<_>> = fact.arguments.iter().map(|a| self.objects.get(a).copied()).collect();
        self.task.fact(predicate, &arguments?)
    }

    /// The state in which exactly these of the perceivable facts hold, and nothing is known of the sensed numbers.
    pub fn state<'f>(&self, perceived: impl IntoIterator<Item = &'f Fact>) -> State {
        let seen = perceived.into_iter().filter_map(|fact| self.fact(fact));
        let state = self.task.state(self.given.iter().copied().chain(seen));
        if self.numbers.is_empty() {
            return state;
        }
        self.task.with_numbers(&state, self.numbers.values().map(|(fluent, default)| (fluent, *default)))
    }

    /// The state with these sensed numbers; others stay as they are.
    pub fn with_numbers<'f>(
        &self,
        state: State,
        numbers: impl IntoIterator<Item = (&'f Fluent, Option<f64>)>,
    ) -> State {
        let known = numbers.into_iter().filter_map(|(fluent, value)| {
            let (application, _) = self.numbers.get(fluent)?;
            Some((application, value.and_then(Number::from_f64)))
        });
        let known: Vec<_> = known.collect();
        if known.is_empty() { state } else { self.task.with_numbers(&state, known) }
    }

    /// Turns the state of what was perceived before `change` into that of what is perceived now.
    pub fn update(&self, state: &mut State, change: &Change) -> Changes {
        let known = |fact: &Fact| self.fact(fact).filter(|fact| self.given.binary_search(fact).is_err());
        let gone = change.disappeared.iter().filter_map(|fact| Some((known(fact)?, false)));
        let come = change.appeared.iter().filter_map(|fact| Some((known(fact)?, true)));
        let facts: Vec<_> = gone.chain(come).collect();
        self.task.change(state, facts.iter().copied());
        let numbers = change.numbers.iter().any(|(fluent, _)| self.numbers.contains_key(fluent));
        if numbers {
            let values = change.numbers.iter().map(|(fluent, value)| (fluent, *value));
            *state = self.with_numbers(state.clone(), values);
        }
        Changes { facts, numbers }
    }

    /// The name of a planner's fact; `None` for an auxiliary fact of grounding.
    pub fn name(&self, fact: FactId) -> Option<Fact> {
        self.task.facts()[fact].atom.as_ref().map(|atom| self.atom(atom))
    }

    /// A comparison of numbers as PDDL writes it; `None` for a fact that is none.
    pub fn comparison(&self, fact: FactId) -> Option<String> {
        self.task.facts()[fact].compares.then(|| self.task.fact_name(fact))
    }

    /// The name of a ground atom.
    pub fn atom(&self, atom: &GroundAtom) -> Fact {
        Fact {
            predicate: self.domain.predicates[atom.predicate].name.clone(),
            arguments: atom.arguments.iter().map(|&o| self.problem.objects[o].name.clone()).collect(),
        }
    }

    /// The name of an operator.
    pub fn step(&self, operator: OperatorId) -> Step {
        let operator = self.task.operator(operator);
        Step {
            action: self.domain.actions[operator.action].name.clone(),
            arguments: operator.arguments.iter().map(|&o| self.problem.objects[o].name.clone()).collect(),
        }
    }

    /// The problem as it stands in `state`, with these goals, for a validator that shares nothing with the planner.
    pub fn problem_in(&self, state: &State, goals: &[GoalId]) -> Problem {
        let mut problem = self.problem_for(goals);
        problem.init.retain(|fact| !self.exogenous.contains(&fact.predicate));
        let known: Vec<_> = problem.init.iter().map(|f| (f.predicate, f.arguments.clone())).collect();
        let mut add = |predicate: PredicateId, arguments: &[ObjectId]| {
            if !known.iter().any(|(p, a)| *p == predicate && a == arguments) {
                problem.init.push(pddl::model::Fact {
                    predicate,
                    arguments: arguments.to_vec(),
                    span: self.problem.goal_span,
                });
            }
        };
        let numbers: Vec<_> = self.task.numbers(state).collect();
        let objects: Vec<_> = self.task.object_values(state).collect();
        let is_changed = |application: &GroundApplication| {
            numbers.iter().any(|(other, _)| *other == application)
                || objects.iter().any(|value| value.fluent == *application)
                || self.task.is_object_fluent(application)
        };
        problem.fluents.retain(|fluent| !is_changed(&fluent.application));
        let numbers = numbers.into_iter().filter_map(|(application, value)| {
            Some((application.clone(), FluentValue::Number(value?.to_f64())))
        });
        let objects = objects.into_iter().map(|v| (v.fluent.clone(), FluentValue::Object(v.object)));
        problem.fluents.extend(numbers.chain(objects).map(|(application, value)| FluentFact {
            application,
            value,
            span: self.problem.goal_span,
        }));
        for fact in state.facts() {
            if let Some(atom) = &self.task.facts()[fact].atom
                && !self.domain.predicates[atom.predicate].derived
            {
                add(atom.predicate, &atom.arguments);
            }
        }
        problem
    }
}
