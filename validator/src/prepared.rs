//! A task that is prepared once for any number of plans: its extents, the strata of its axioms, its
//! initial state.

use crate::axiom::{Needs, Strata};
use crate::cause::Causes;
use crate::demands::Demands;
use crate::number::Number;
use crate::preference::judge;
use crate::prepare::{derived_in_effect, initial_state};
use crate::relation::Moment;
use crate::scene::{Binding, Clock, Scene};
use crate::state::State;
use crate::trajectory::Asked;
use crate::universe::Universe;
use crate::verdict::{Failure, Feature, MetricValue, StepFault, Unsatisfied, Unsupported, Valid, Verdict};
use crate::why::{DEPTH, Why};
use crate::work::Thoroughness;
use pddl::Span;
use pddl::model::{Condition, Domain, Given, ObjectId, Problem, TimeSpecifier, TimedEffect, Variables};

/// The precision with which a plan must keep times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Precision {
    /// The largest difference between a duration and its required value, in seconds: planners round
    /// their output.
    pub tolerance: Number,
    /// Happenings with a smaller distance, in seconds, count as simultaneous and must not
    /// interfere.
    pub separation: Number,
}

impl Default for Precision {
    /// A hundredth and a thousandth of a second, like VAL.
    fn default() -> Self {
        Self { tolerance: Number::thousandths(10), separation: Number::thousandths(1) }
    }
}

/// A task that is ready to judge plans.
#[derive(Clone, Debug)]
pub(crate) struct Prepared<'a> {
    pub(crate) domain: &'a Domain,
    pub(crate) problem: &'a Problem,
    pub(crate) precision: Precision,
    pub(crate) thoroughness: Thoroughness,
    pub(crate) universe: Universe,
    pub(crate) strata: Strata,
    pub(crate) initial: State,
}

impl<'a> Prepared<'a> {
    /// Prepares a task.
    ///
    /// # Errors
    /// Returns [`Verdict::Unsupported`] or [`Verdict::IllFormed`] for a task whose plans cannot be
    /// judged.
    pub(crate) fn new(domain: &'a Domain, problem: &'a Problem) -> Result<Self, Box<Verdict>> {
        if let Some(unsupported) = unsupported(domain, problem) {
            return Err(Box::new(Verdict::Unsupported(unsupported)));
        }
        let ill_formed = |fault| Box::new(Verdict::IllFormed(fault));
        let strata = Strata::new(domain).map_err(ill_formed)?;
        for action in &domain.actions {
            derived_in_effect(&action.effect, &strata).map_err(ill_formed)?;
        }
        for timed in domain.durative_actions.iter().flat_map(|action| &action.effects) {
            if let Some(span) = later_condition(timed) {
                let message = "a condition that is later than its effect is not supported".to_owned();
                let feature = Feature::InDomain(message);
                return Err(Box::new(Verdict::Unsupported(Unsupported { feature, span })));
            }
            derived_in_effect(&timed.effect, &strata).map_err(ill_formed)?;
        }
        for event in &domain.events {
            derived_in_effect(&event.effect, &strata).map_err(ill_formed)?;
        }
        let universe = Universe::new(domain, problem);
        let initial = initial_state(domain, problem);
        Ok(Self {
            domain,
            problem,
            precision: Precision::default(),
            thoroughness: Thoroughness::default(),
            universe,
            strata,
            initial,
        })
    }

    /// The demands on a plan before its first step.
    pub(crate) fn demands(&self, state: &State) -> Demands<'a> {
        Demands::new(self.domain, self.problem, &self.universe, &self.strata, state)
    }

    pub(crate) fn scene<'s>(
        &'s self,
        state: &'s State,
        variables: &'s Variables,
        clock: Clock<'s>,
    ) -> Scene<'s> {
        Scene { universe: &self.universe, state, variables, clock }
    }

    /// Brings the derived part of a state up to date if the condition reads it.
    pub(crate) fn derive_for(&self, condition: &Condition, state: &mut State, now: Moment) {
        if !self.domain.axioms.is_empty() {
            self.derive_needed(&self.strata.needs([condition]), state, now);
        }
    }

    pub(crate) fn derive(&self, state: &mut State, now: Moment) {
        self.strata.derive(self.domain, &self.universe, state, now);
    }

    pub(crate) fn derive_needed(&self, needs: &Needs, state: &mut State, now: Moment) {
        self.strata.derive_needed(needs, self.domain, &self.universe, state, now);
    }

    /// Explains the unsatisfied conditions of a scene.
    pub(crate) fn why<'s>(&'s self, scene: Scene<'s>, causes: Causes<'s>) -> Why<'s> {
        Why { domain: self.domain, scene, strata: &self.strata, causes, depth: DEPTH }
    }

    /// The unsatisfied parts of a condition.
    pub(crate) fn lacks(
        &self,
        scene: Scene<'_>,
        causes: Causes<'_>,
        condition: &Condition,
        binding: &mut Binding,
    ) -> Vec<Unsatisfied> {
        self.why(scene, causes).unsatisfied(condition, true, binding)
    }

    /// Whether a step's arguments fit its schema.
    pub(crate) fn fits(&self, variables: &Variables, arguments: &[ObjectId]) -> Result<(), StepFault> {
        let (expected, found) = (variables.parameters, arguments.len());
        if expected != found {
            return Err(StepFault::Arity { expected, found });
        }
        for (parameter, &object) in variables.parameter_ids().zip(arguments) {
            if !self.universe.extent(&variables[parameter].types).contains(object) {
                return Err(StepFault::Type { parameter, object });
            }
        }
        Ok(())
    }

    /// The unsatisfied parts of a constraint's condition in a state.
    pub(crate) fn lacks_of_constraint(
        &self,
        state: &mut State,
        (causes, now): (Causes<'_>, Number),
        demands: &Demands<'_>,
        asked: Asked,
    ) -> Vec<Unsatisfied> {
        let (condition, variables, binding) = demands.asked(asked);
        let moment = Moment::try_from(causes.len(Moment::MAX)).unwrap_or(Moment::MAX);
        self.derive_for(condition, state, moment);
        let scene = self.scene(state, variables, Clock::at(now));
        self.why(scene, causes).unsatisfied(condition, asked.wanted, &mut binding.clone())
    }

    /// Judges the last state: goal, preferences, metric. The constraints were judged before.
    pub(crate) fn finish(&self, end: End<'_>, mut demands: Demands<'_>) -> Result<Valid, Box<Failure>> {
        let End { state, causes, total_time, makespan, steps } = end;
        let now = Moment::try_from(causes.len(steps)).unwrap_or(Moment::MAX);
        self.derive_for(&self.problem.goal, state, now);
        for preference in &self.problem.preferences {
            self.derive_for(&preference.body, state, now);
        }
        let variables = &self.problem.goal_variables;
        let scene = self.scene(state, variables, Clock::at(total_time));
        let mut binding = Binding::new(variables, &[]);
        if !scene.holds(&self.problem.goal, &mut binding) {
            let mut binding = Binding::new(variables, &[]);
            let parts = self.lacks(scene, causes, &self.problem.goal, &mut binding);
            return Err(Box::new(Failure::Goal { parts }));
        }
        demands.count_soft();
        let mut violations = demands.violations;
        for preference in &self.problem.preferences {
            judge(&mut violations, scene, preference, &mut binding, |body, binding| {
                scene.holds(body, binding)
            });
        }
        let clock = Clock { violations: Some(&violations), ..Clock::at(total_time) };
        let scene = self.scene(state, variables, clock);
        let metric = self.problem.metric.as_ref().and_then(|metric| {
            let value = scene.number(&metric.expression, &binding).ok()?;
            Some(MetricValue { objective: metric.objective, value })
        });
        Ok(Valid { steps, makespan, metric, violations, decomposition: None })
    }
}

/// The end of a plan that was executed.
pub(crate) struct End<'s> {
    pub(crate) state: &'s mut State,
    pub(crate) causes: Causes<'s>,
    pub(crate) total_time: Number,
    pub(crate) makespan: Option<Number>,
    pub(crate) steps: u32,
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
    None
}

/// The place of a condition that refers to a later time than its effect.
fn later_condition(effect: &TimedEffect) -> Option<Span> {
    let given = effect.given.iter().flat_map(|given| match given {
        Given::When(conditions) => conditions.as_slice(),
        Given::Forall(_) => &[],
    });
    let mut given = given.filter(|_| effect.when != TimeSpecifier::End);
    given.find(|condition| condition.when != effect.when).map(|condition| condition.condition.span)
}
