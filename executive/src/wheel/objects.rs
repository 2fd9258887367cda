//! Objects that appear and go: when the model is made anew, and what of the wheel is carried over to it.
//!
//! The facts and operators of another model have other numbers, so whatever the wheel remembers by number is renamed.
//! A bar of a step in a state ends: the world is another.

use super::course::Course;
use super::event::Effect;
use super::state::{Hand, Wheel};
use crate::Model;
use crate::arrivals::Arrival;
use crate::decision_support::Arrived;
use crate::goal::GoalId;
use crate::narration::Narration;
use dsr::{Change, Delta};
use pddl::model::Name;
use std::sync::Arc;

impl Wheel {
    /// Looks for objects, if a commit may have changed them.
    pub(super) fn follow_objects(&mut self, delta: Option<&Delta>, effects: &mut Vec<Effect>) {
        let (Some(arrivals), Some(sight)) = (&self.arrivals, &self.sight) else { return };
        let is_node =
            |change: &Change| matches!(change, Change::NodeAdded { .. } | Change::NodeRemoved { .. });
        if delta.is_some_and(|delta| !delta.changes.iter().any(is_node)) {
            return;
        }
        let now = arrivals.in_graph(&sight.snapshot);
        let before = std::mem::replace(&mut self.arrived, now);
        let missing = |of: &[Arrival], among: &[Arrival]| -> Vec<Name> {
            of.iter().filter(|object| !among.contains(object)).map(|object| object.name.clone()).collect()
        };
        let (come, gone) = (missing(&self.arrived, &before), missing(&before, &self.arrived));
        if !come.is_empty() || !gone.is_empty() {
            effects.push(Effect::Tell(Narration::Objects { come, gone }));
        }
    }

    /// Whether there are other objects than those of the model.
    pub(super) fn is_outgrown(&self) -> bool {
        self.arrived != self.model.arrivals()
    }

    /// Whether there are other objects than those for which the last decision was made.
    pub(super) fn has_new_objects(&self) -> bool {
        self.arrived != self.considered_objects
    }

    /// What Decision Support needs to make the model anew; `None` if it fits.
    pub(super) fn arrived(&self) -> Option<Arrived> {
        let sight = self.sight.as_ref().filter(|_| self.is_outgrown())?;
        let (facts, numbers) = sight.perceived();
        Some(Arrived { objects: self.arrived.clone(), facts, numbers })
    }

    /// Goes over to a model with other objects.
    pub(super) fn switch(&mut self, model: Arc<Model>, effects: &mut Vec<Effect>) {
        let old = std::mem::replace(&mut self.model, model);
        let Some(sight) = &mut self.sight else { return };
        sight.restate(&self.model);
        let goals = (0..).map(GoalId).zip(self.model.goals());
        self.aims = goals.map(|(id, _)| self.model.goal(&[id])).collect();
        self.patience.rename(&old, &self.model);
        self.expected = None;
        match std::mem::replace(&mut self.hand, Hand::Empty) {
            Hand::Plan(course) => {
                let goal = self.model.goal(&self.agenda.unachieved());
                let operators = self.model.counterparts(&old, &course.left());
                if operators.first().is_some_and(Option::is_some) {
                    let mut kept = 0..;
                    let places: Vec<_> = operators.iter().map(|own| own.and_then(|_| kept.next())).collect();
                    let plan = operators.into_iter().flatten().collect();
                    let other = Course::new(&self.model, plan, goal, &sight.state);
                    let other = other.carrying(course, &places, &sight.snapshot, effects);
                    self.hand = Hand::Plan(other);
                } else {
                    let mut course = course;
                    course.withdraw(&sight.snapshot, effects);
                }
            }
            Hand::Errand(mut errand) => {
                errand.reconsider();
                self.hand = Hand::Errand(errand);
            }
            Hand::Rest(_) | Hand::Empty => {}
        }
        // The facts of the old model mean nothing here.
        self.under_way.clear();
        self.note_starts();
    }
}
