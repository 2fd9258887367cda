//! A plan, step by step.
//!
//! [`Validator`] prepares a task once (extents, strata, the initial state) and then judges any number of
//! plans. Cost of a plan: the initial state is copied once, then each step pays for its own conditions
//! and effects only.

use crate::axiom::{Strata, each_predicate};
use crate::effect::Changes;
use crate::number::Number;
use crate::scene::{Binding, Scene};
use crate::state::{State, Value};
use crate::trace::{Diff, Trace};
use crate::universe::Universe;
use crate::verdict::{
    Failure, Feature, IllFormed, MetricValue, StepFault, StepIndex, Unsupported, Valid, Verdict,
};
use crate::why::Why;
use pddl::model::Feature as LanguageFeature;
use pddl::model::{
    Action, ActionId, Condition, ConditionKind, Domain, Effect, EffectKind, FluentValue, GroundApplication,
    Idx, IndexVec, Problem, Variables,
};
use pddl::{PlanStep, SequentialPlan};

/// Judges one plan.
pub fn validate(domain: &Domain, problem: &Problem, plan: &SequentialPlan) -> Verdict {
    match Validator::new(domain, problem) {
        Ok(validator) => validator.validate(plan),
        Err(refusal) => *refusal,
    }
}

/// A task, ready to judge plans.
#[derive(Clone, Debug)]
pub struct Validator<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    universe: Universe,
    strata: Strata,
    initial: State,
    /// Per action, whether its conditions read derived predicates.
    reads_derived: IndexVec<ActionId, bool>,
}

impl<'a> Validator<'a> {
    /// Prepares a task.
    ///
    /// # Errors
    /// With [`Verdict::Unsupported`] or [`Verdict::IllFormed`] for a task under which no plan can be judged.
    pub fn new(domain: &'a Domain, problem: &'a Problem) -> Result<Self, Box<Verdict>> {
        if let Some(unsupported) = unsupported(domain, problem) {
            return Err(Box::new(Verdict::Unsupported(unsupported)));
        }
        let ill_formed = |fault| Box::new(Verdict::IllFormed(fault));
        let strata = Strata::new(domain).map_err(ill_formed)?;
        for action in &domain.actions {
            derived_in_effect(&action.effect, &strata).map_err(ill_formed)?;
        }
        let reads_derived = domain
            .actions
            .iter()
            .map(|action| {
                let mut reads = strata.reads_derived(&action.precondition);
                each_guard(&action.effect, &mut |guard, _| reads |= strata.reads_derived(guard));
                reads
            })
            .collect();
        let universe = Universe::new(domain, problem);
        let initial = initial_state(domain, problem);
        Ok(Self { domain, problem, universe, strata, initial, reads_derived })
    }

    /// Judges a plan.
    pub fn validate(&self, plan: &SequentialPlan) -> Verdict {
        self.run(plan, None)
    }

    /// Judges a plan, and answers what each step changed.
    pub fn trace(&self, plan: &SequentialPlan) -> (Verdict, Trace) {
        let mut trace = Trace::default();
        let verdict = self.run(plan, Some(&mut trace));
        (verdict, trace)
    }

    fn run(&self, plan: &SequentialPlan, mut trace: Option<&mut Trace>) -> Verdict {
        let mut state = self.initial.clone();
        let mut changes = Changes::default();
        let mut binding = Binding::default();
        let mut steps = 0;
        for step in &plan.steps {
            let mut diff = trace.is_some().then(Diff::default);
            let index = StepIndex(steps);
            if let Err(failure) =
                self.step(index, step, &mut state, &mut changes, &mut binding, diff.as_mut())
            {
                return Verdict::Invalid(*failure);
            }
            if let (Some(trace), Some(diff)) = (&mut trace, diff) {
                trace.steps.push(diff);
            }
            steps += 1;
        }
        self.finish(steps, &mut state)
    }

    fn step(
        &self,
        index: StepIndex,
        step: &PlanStep,
        state: &mut State,
        changes: &mut Changes,
        binding: &mut Binding,
        diff: Option<&mut Diff>,
    ) -> Result<(), Box<Failure>> {
        let action = self.action(step).map_err(|fault| Box::new(Failure::Step { step: index, fault }))?;
        if self.reads_derived[step.action] {
            self.strata.derive(self.domain, &self.universe, state, index.0);
        }
        binding.reset(&action.variables, &step.arguments);
        let scene = self.scene(state, &action.variables, index.0);
        if !scene.holds(&action.precondition, binding) {
            let why = Why { scene, strata: &self.strata };
            let parts = why.unsatisfied(&action.precondition, true, binding);
            return Err(Box::new(Failure::Precondition { step: index, parts }));
        }
        changes.clear();
        changes
            .collect(scene, &action.effect, binding)
            .and_then(|()| changes.apply(state, index.0 + 1, diff))
            .map_err(|fault| Box::new(Failure::Effect { step: index, fault }))
    }

    /// The step's action, if the step is an instance of it.
    fn action(&self, step: &PlanStep) -> Result<&'a Action, StepFault> {
        let action = self.domain.actions.get(step.action).ok_or(StepFault::UnknownAction)?;
        let (expected, found) = (action.variables.parameters, step.arguments.len());
        if expected != found {
            return Err(StepFault::Arity { expected, found });
        }
        for (parameter, &object) in action.variables.parameter_ids().zip(&step.arguments) {
            if !self.universe.extent(&action.variables[parameter].types).contains(object) {
                return Err(StepFault::Type { parameter, object });
            }
        }
        Ok(action)
    }

    fn finish(&self, steps: u32, state: &mut State) -> Verdict {
        let variables = &self.problem.goal_variables;
        if self.strata.reads_derived(&self.problem.goal) {
            self.strata.derive(self.domain, &self.universe, state, steps);
        }
        let scene = self.scene(state, variables, steps);
        let mut binding = Binding::new(variables, &[]);
        if !scene.holds(&self.problem.goal, &mut binding) {
            let why = Why { scene, strata: &self.strata };
            let parts = why.unsatisfied(&self.problem.goal, true, &mut Binding::new(variables, &[]));
            return Verdict::Invalid(Failure::Goal { parts });
        }
        let metric = self.problem.metric.as_ref().and_then(|metric| {
            let value = scene.number(&metric.expression, &binding).ok()?;
            Some(MetricValue { objective: metric.objective, value })
        });
        Verdict::Valid(Valid { steps, metric })
    }

    fn scene<'s>(&'s self, state: &'s State, variables: &'s Variables, elapsed: u32) -> Scene<'s> {
        Scene { universe: &self.universe, state, variables, elapsed }
    }
}

fn unsupported(domain: &Domain, problem: &Problem) -> Option<Unsupported> {
    if let Some(diagnostic) = domain.unsupported.first() {
        let feature = Feature::InDomain(diagnostic.message());
        return Some(Unsupported { feature, span: diagnostic.span });
    }
    if let Some(diagnostic) = problem.unsupported.first() {
        let feature = Feature::InProblem(diagnostic.message());
        return Some(Unsupported { feature, span: diagnostic.span });
    }
    if let Some((feature, span)) = domain.features().into_iter().find(|(f, _)| !is_known(*f)) {
        return Some(Unsupported { feature: Feature::LanguageOfDomain(feature), span });
    }
    if let Some((feature, span)) = problem.features().into_iter().find(|(f, _)| !is_known(*f)) {
        return Some(Unsupported { feature: Feature::LanguageOfProblem(feature), span });
    }
    problem.htn.as_ref().map(|(_, network)| {
        let span = network.subtasks.first().map_or(problem.goal_span, |subtask| subtask.span);
        Unsupported { feature: Feature::TaskNetwork, span }
    })
}

/// Whether the feature is evaluated here, or only in methods, which a sequence of actions does not use.
fn is_known(feature: LanguageFeature) -> bool {
    matches!(feature, LanguageFeature::TypePredicates | LanguageFeature::NetworkConstraints)
}

fn initial_state(domain: &Domain, problem: &Problem) -> State {
    let mut state = State::empty(domain, &joined(domain, problem));
    for fact in &problem.init {
        state.facts[fact.predicate].add(&fact.arguments, 0);
    }
    // Action costs are counted from 0 even where `:init` forgets to say so.
    if let Some(function) = domain.function("total-cost")
        && domain.functions[function].variables.parameters == 0
    {
        let total_cost = GroundApplication { function, arguments: Vec::new() };
        state.set_fluent(total_cost, Some(Value::Number(Number::ZERO)));
    }
    for fact in &problem.fluents {
        let value = match fact.value {
            FluentValue::Number(number) => Number::from_f64(number).map(Value::Number),
            FluentValue::Object(object) => Some(Value::Object(object)),
        };
        state.set_fluent(fact.application.clone(), value);
    }
    state
}

/// Which predicates are looked up by pattern: those inside quantifiers, axioms and universal effects.
fn joined(domain: &Domain, problem: &Problem) -> Vec<bool> {
    let mut joined = vec![false; domain.predicates.len()];
    let mut mark = |condition: &Condition| {
        each_predicate(condition, true, &mut |predicate, _| joined[predicate.index()] = true);
    };
    for action in &domain.actions {
        each_quantified(&action.precondition, &mut mark);
        each_guard(&action.effect, &mut |guard, universal| {
            if universal {
                mark(guard);
            } else {
                each_quantified(guard, &mut mark);
            }
        });
    }
    for axiom in &domain.axioms {
        mark(&axiom.body);
    }
    each_quantified(&problem.goal, &mut mark);
    joined
}

/// The outermost quantified conditions.
fn each_quantified(condition: &Condition, visit: &mut dyn FnMut(&Condition)) {
    match &condition.kind {
        ConditionKind::And(parts) | ConditionKind::Or(parts) => {
            for part in parts {
                each_quantified(part, visit);
            }
        }
        ConditionKind::Not(part) => each_quantified(part, visit),
        ConditionKind::Imply(if_, then) => {
            each_quantified(if_, visit);
            each_quantified(then, visit);
        }
        ConditionKind::Exists(_, body) | ConditionKind::Forall(_, body) => visit(body),
        ConditionKind::Atom(_)
        | ConditionKind::HasType(..)
        | ConditionKind::Same(..)
        | ConditionKind::Compare(..)
        | ConditionKind::FluentIs(..) => {}
    }
}

/// The conditions of conditional effects, and whether a universal effect is around them.
fn each_guard(effect: &Effect, visit: &mut dyn FnMut(&Condition, bool)) {
    fn walk(effect: &Effect, universal: bool, visit: &mut dyn FnMut(&Condition, bool)) {
        match &effect.kind {
            EffectKind::And(parts) => {
                for part in parts {
                    walk(part, universal, visit);
                }
            }
            EffectKind::Forall(_, body) => walk(body, true, visit),
            EffectKind::When(guard, body) => {
                visit(guard, universal);
                walk(body, universal, visit);
            }
            EffectKind::Add(_) | EffectKind::Delete(_) | EffectKind::Assign(..) => {}
        }
    }
    walk(effect, false, visit);
}

fn derived_in_effect(effect: &Effect, strata: &Strata) -> Result<(), IllFormed> {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().try_for_each(|part| derived_in_effect(part, strata)),
        EffectKind::Forall(_, body) | EffectKind::When(_, body) => derived_in_effect(body, strata),
        EffectKind::Add(atom) | EffectKind::Delete(atom) if strata.derives(atom.predicate) => {
            Err(IllFormed::DerivedInEffect { predicate: atom.predicate, span: atom.span })
        }
        EffectKind::Add(_) | EffectKind::Delete(_) | EffectKind::Assign(..) => Ok(()),
    }
}
