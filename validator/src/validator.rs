//! The entry point: one task, any number of plans of any kind.
//!
//! [`Validator`] prepares a task once and then judges plans. Cost of a plan: one copy of the
//! initial state, then the conditions and effects of each step.

use crate::plan::PlanRef;
use crate::prepared::{Precision, Prepared};
use crate::state::State;
use crate::trace::Trace;
use crate::verdict::{Feature, Stop, Unsupported, Valid, Verdict};
use crate::work::{Thoroughness, Work};
use crate::{htn, sequential, temporal};
use pddl::TemporalPlan;
use pddl::model::{Domain, Problem};

/// Judges one plan.
pub fn validate<'p>(domain: &Domain, problem: &Problem, plan: impl Into<PlanRef<'p>>) -> Verdict {
    match Validator::new(domain, problem) {
        Ok(validator) => validator.validate(plan),
        Err(refusal) => *refusal,
    }
}

/// A task that is ready to judge plans.
#[derive(Clone, Debug)]
pub struct Validator<'a> {
    pub(crate) prepared: Prepared<'a>,
}

impl<'a> Validator<'a> {
    /// Prepares a task.
    ///
    /// # Errors
    /// Returns [`Verdict::Unsupported`] or [`Verdict::IllFormed`] for a task whose plans cannot be
    /// judged.
    pub fn new(domain: &'a Domain, problem: &'a Problem) -> Result<Self, Box<Verdict>> {
        Prepared::new(domain, problem).map(|prepared| Self { prepared })
    }

    /// The same with another precision.
    #[must_use]
    pub fn with_precision(mut self, precision: Precision) -> Self {
        self.prepared.precision = precision;
        self
    }

    /// The same with another thoroughness.
    #[must_use]
    pub(crate) fn with_thoroughness(mut self, thoroughness: Thoroughness) -> Self {
        self.prepared.thoroughness = thoroughness;
        self
    }

    /// Judges a plan.
    pub fn validate<'p>(&self, plan: impl Into<PlanRef<'p>>) -> Verdict {
        self.run(plan.into(), None)
    }

    /// Judges a plan and returns the changes of each step.
    pub fn trace<'p>(&self, plan: impl Into<PlanRef<'p>>) -> (Verdict, Trace) {
        let mut trace = Trace::default();
        let verdict = self.run(plan.into(), Some(&mut trace));
        (verdict, trace)
    }

    fn run(&self, plan: PlanRef<'_>, trace: Option<&mut Trace>) -> Verdict {
        let mut state = self.prepared.initial.clone();
        state.work = Work::for_steps(plan.steps());
        let result = self.carry_out(plan, &mut state, trace);
        let unsupported =
            |feature| Verdict::Unsupported(Unsupported { feature, span: self.prepared.problem.goal_span });
        match result {
            Err(Stop::Unsupported(unsupported)) => Verdict::Unsupported(unsupported),
            // Results that were found after the budget was exhausted are never part of a verdict.
            _ if state.work.is_exhausted() => unsupported(Feature::TooMuch),
            _ if state.work.is_undecided() => unsupported(Feature::Undecided),
            Ok(valid) => Verdict::Valid(valid),
            Err(Stop::Failure(failure)) => Verdict::Invalid(*failure),
        }
    }

    /// Selects the judgement: with times if the plan has them, by the task network if the problem
    /// has one.
    fn carry_out(
        &self,
        plan: PlanRef<'_>,
        state: &mut State,
        trace: Option<&mut Trace>,
    ) -> Result<Valid, Stop> {
        let prepared = &self.prepared;
        let has_network = prepared.problem.htn.is_some();
        match (plan, self.needs_times()) {
            (PlanRef::Temporal(_), _) if has_network => {
                let span = prepared.problem.goal_span;
                Err(Stop::Unsupported(Unsupported { feature: Feature::TimedTaskNetwork, span }))
            }
            (PlanRef::Temporal(plan), _) => Ok(temporal::run(prepared, plan, state, trace)?),
            // A plan without steps may be of any kind.
            (PlanRef::Sequential(plan), Some(_)) if plan.steps.is_empty() && !has_network => {
                Ok(temporal::run(prepared, &TemporalPlan::default(), state, trace)?)
            }
            (_, Some(unsupported)) => Err(Stop::Unsupported(unsupported)),
            (PlanRef::Sequential(plan), None) if has_network => {
                htn::run_undecomposed(prepared, plan, state, trace)
            }
            (PlanRef::Sequential(plan), None) => {
                Ok(sequential::run(prepared, plan.steps.iter(), state, trace, &mut |_, _| ())?)
            }
            (PlanRef::Hierarchical(plan), None) => htn::run(prepared, plan, state, trace),
        }
    }

    /// A feature of the task that requires a plan with times.
    fn needs_times(&self) -> Option<Unsupported> {
        let features = [
            (self.prepared.problem.timed.first().map(|timed| timed.span), Feature::TimesMissingForProblem),
            (
                self.prepared.domain.processes.iter().next().map(|process| process.span),
                Feature::TimesMissingForDomain,
            ),
            (
                self.prepared.domain.events.iter().next().map(|event| event.span),
                Feature::TimesMissingForDomain,
            ),
        ];
        features.into_iter().find_map(|(span, feature)| Some(Unsupported { feature, span: span? }))
    }
}
