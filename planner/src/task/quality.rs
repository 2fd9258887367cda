//! The quality of plans if the metric is not a sum of operator costs.

use super::grounded::Task;
use super::metric::Tally;
use super::numeric::{NumericEffects, Update, changed};
use super::state::State;
use crate::ids::{FluentId, OperatorId};
use crate::number::Number;
use pddl::model::{Idx, Objective};

impl Task {
    /// Whether a plan's quality is the sum of its operators' costs (the length, without costs), so
    /// that optimal searches can prove optimality.
    pub fn has_additive_costs(&self) -> bool {
        self.metric.is_none()
    }

    /// The metric's value after a plan from `state`, if it is not a sum of operator costs. Smaller
    /// is better: a metric to maximise has the opposite sign. `None` without such a metric, or if
    /// its value is undefined. Fluents that only the metric reads start at their initial values.
    pub fn quality(&self, state: &State, plan: &[OperatorId]) -> Option<Number> {
        self.metric.as_ref()?;
        let mut tally = self.tally();
        let mut here = state.clone();
        for &operator in plan {
            let next = self.successor(&here, operator)?;
            self.count(&here, operator, &mut tally);
            here = next;
        }
        self.measure(&here, &tally)
    }

    /// The fluents that only the metric reads, before the first step.
    pub(crate) fn tally(&self) -> Tally {
        self.numeric.fluents[self.numeric.stored..].iter().map(|f| f.initial).collect()
    }

    /// Applies a step from `state` to the tally.
    pub(crate) fn count(&self, state: &State, operator: OperatorId, tally: &mut Tally) {
        if let Some(effects) = self.operator(operator).numeric {
            self.add_up(effects, state, tally);
        }
        if let Some(steps) = self.metric.as_ref().and_then(|m| m.steps) {
            let count = &mut tally[steps.index() - self.numeric.stored];
            *count = count.and_then(|n| n.plus(Number::ONE));
        }
    }

    /// The metric's value in `state`, with the sign of [`Task::quality`].
    pub(crate) fn measure(&self, state: &State, tally: &Tally) -> Option<Number> {
        let metric = self.metric.as_ref()?;
        let value = metric.expression.evaluate(&|f| self.number(state, tally, *f)).ok()?;
        if metric.objective == Objective::Minimize { Some(value) } else { value.negated() }
    }

    fn number(&self, state: &State, unseen: &[Option<Number>], fluent: FluentId) -> Option<Number> {
        match fluent.index().checked_sub(self.numeric.stored) {
            None => self.numeric.value(state.words(), fluent),
            Some(i) => unseen[i],
        }
    }

    fn add_up(&self, effects: &NumericEffects, state: &State, unseen: &mut [Option<Number>]) {
        let applies = |update: &&Update| update.condition.hold_in(state.words());
        let value = |update: &Update, unseen: &[Option<Number>]| {
            update.value.as_ref().and_then(|v| v.evaluate(&|f| self.number(state, unseen, *f)).ok())
        };
        // All fluents are read before any is written.
        let values: Vec<(&Update, Option<Number>)> =
            effects.metric.iter().filter(applies).map(|u| (u, value(u, unseen))).collect();
        for (update, value) in values {
            let place = &mut unseen[update.fluent.index() - self.numeric.stored];
            *place = changed(update.change, *place, value);
        }
    }
}
