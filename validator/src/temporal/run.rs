//! A plan with times during its execution.
//!
//! Invariant: `now` is the time of the last happening, and `state` is the state right after it.

use super::active::Actives;
use super::concurrent::Concurrent;
use super::footprint::{Dependencies, Footprint};
use super::linear_change::LinearChange;
use super::watch::{Basis, Watch};
use crate::cause::Cause;
use crate::demands::Demands;
use crate::number::Number;
use crate::prepared::Prepared;
use crate::relation::Moment;
use crate::state::State;
use crate::trajectory::Since;
use crate::verdict::{ChangeFault, Failure};
use pddl::TemporalPlan;
use pddl::model::Condition;

pub(super) type Checked<T = ()> = Result<T, Box<Failure>>;

pub(super) struct Run<'s, 'v, 'a> {
    pub(super) prepared: &'v Prepared<'a>,
    pub(super) plan: &'v TemporalPlan,
    pub(super) dependencies: Dependencies,
    pub(super) basis: Basis<'v>,
    pub(super) state: &'s mut State,
    pub(super) demands: Demands<'v>,
    pub(super) now: Number,
    pub(super) causes: Vec<Cause>,
    pub(super) active: Actives<'v>,
    /// Linear continuous change; `None` if some change is not linear.
    pub(super) linear: Option<LinearChange>,
    /// The actions that must be checked again.
    pub(super) watch: Watch,
    /// Recent happenings.
    pub(super) concurrent: Concurrent,
    /// The number of times that processes or events began or ended.
    pub(super) unrests: usize,
    /// Whether events changed a fluent since the last check.
    pub(super) wrote_fluents: bool,
    /// Whether the problem has a timed change at the next time.
    pub(super) timed_is_next: bool,
    /// The events that happened just before that timed change.
    pub(super) beside_timed: Vec<(Cause, Footprint)>,
}

impl Run<'_, '_, '_> {
    pub(super) fn moment(&self) -> Moment {
        Moment::try_from(self.causes.len()).unwrap_or(Moment::MAX)
    }

    pub(super) fn derive_for(&mut self, condition: &Condition) {
        let moment = self.moment();
        self.prepared.derive_for(condition, self.state, moment);
    }

    pub(super) fn observe(&mut self) {
        self.observe_at(Since::at(self.now));
    }

    pub(super) fn observe_at(&mut self, since: Since) {
        if self.demands.read_derived() {
            let moment = self.moment();
            self.prepared.derive(self.state, moment);
        }
        self.demands.observe(since, &self.prepared.universe, self.state);
    }

    pub(super) fn change(&self, fault: ChangeFault) -> Box<Failure> {
        Box::new(Failure::Change { time: self.now, fault })
    }
}
