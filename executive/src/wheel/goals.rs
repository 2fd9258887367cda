//! The mission's goals in a turn: what is perceived of them, and when another plan is due for them.
//!
//! A goal that is new waits for the end of the step under way, unless it is urgent; a goal that ended or is held is no
//! longer pursued at once. The question to Decision Support is the same as after a deviation. While it is open the plan
//! rests between two steps; if the decision takes longer than the mission allows, the plan under way goes on.

use super::course::Course;
use super::errand::Purpose;
use super::event::Effect;
use super::sight::Sight;
use super::state::{Hand, Wheel};
use crate::Model;
use crate::goal::{GoalId, GoalText};
use crate::goals::{GoalChange, Life, Review, Stage, View};
use crate::narration::Narration;
use crate::outcome::NoPlan;
use low_to_high::Fact;
use pddl::model::Name;
use planner::{OperatorId, State};

/// The most tokens that one reason names.
const TOKENS: usize = 4;

impl Wheel {
    /// Takes in what is perceived of the goals.
    pub(super) fn follow_goals(&mut self, effects: &mut Vec<Effect>) {
        let Some(sight) = &self.sight else { return };
        let task = self.model.task();
        let outgrown = self.is_outgrown();
        let view = |(text, aim): (&GoalText, &planner::Goal)| View {
            // Of an object that the model lacks, it does not know what "all of them" means.
            holds: task.satisfies(&sight.state, aim) && !(outgrown && text.is_quantified()),
            when: text.when.as_ref().is_none_or(|fact| sight.perceives(fact)),
            hold: text.hold.as_ref().is_some_and(|fact| sight.perceives(fact)),
            drop: text.drop.as_ref().is_some_and(|fact| sight.perceives(fact)),
        };
        let (texts, aims) = (self.model.goals(), &self.aims);
        let views: Vec<View> = texts.iter().zip(aims).map(view).collect();
        let seen = |id: GoalId, life: Life| {
            let text = &texts[id.index()];
            let achieved: Vec<Fact>;
            let facts = match life {
                Life::Wanted => text.when.as_slice(),
                Life::Held => text.hold.as_slice(),
                Life::Dropped => text.drop.as_slice(),
                _ => {
                    let literals = &aims[id.index()].literals;
                    achieved = literals.positive.iter().filter_map(|&f| self.model.name(f)).collect();
                    &achieved
                }
            };
            let mut tokens: Vec<String> = facts.iter().flat_map(|fact| sight.tokens_of(fact)).collect();
            tokens.truncate(TOKENS);
            tokens
        };
        let changes = self.agenda.observe(&views, self.moment.now, &seen);
        self.tell_goals(changes, effects);
    }

    /// The goals whose condition holds now.
    pub(super) fn holding_goals(&self) -> Vec<GoalId> {
        let Some(sight) = &self.sight else { return Vec::new() };
        let holds = |(_, aim): &(GoalId, &planner::Goal)| self.model.task().satisfies(&sight.state, aim);
        (0..).map(GoalId).zip(&self.aims).filter(holds).map(|(id, _)| id).collect()
    }

    pub(super) fn tell_goals(&self, changes: Vec<GoalChange>, effects: &mut Vec<Effect>) {
        if self.model.names_goals() {
            effects.extend(changes.into_iter().map(|change| Effect::Tell(Narration::Goal(change))));
        }
    }

    /// Whether another plan is due for the goals before the plan under way starts its next step.
    pub(super) fn is_review_due(&self, course: &Course) -> bool {
        let due = match course.is_under_way() {
            true => Review::Now,
            false => Review::AfterStep,
        };
        self.agenda.review(&self.agenda.candidates()) >= due
            || (self.has_new_objects() && !course.is_under_way())
    }

    /// No goal is wanted now: what is carried out ends, except a call.
    pub(super) fn idle(&mut self, effects: &mut Vec<Effect>) {
        self.moot(effects);
        self.agenda.serve_none();
        match self.take_hand() {
            Hand::Errand(errand) if matches!(errand.purpose, Purpose::Trouble(_)) && !errand.done => {
                self.carry(errand, effects);
            }
            other => {
                self.hand = other;
                self.stop(effects);
            }
        }
    }

    /// A task outside any plan, or a rest, was chosen for other goals: they may have a plan.
    pub(super) fn reconsider(&mut self) {
        if self.agenda.candidates() == self.agenda.last_considered() && !self.has_new_objects() {
            return;
        }
        match &mut self.hand {
            Hand::Errand(errand) => errand.reconsider(),
            Hand::Rest(_) => self.hand = Hand::Empty,
            Hand::Empty | Hand::Plan(_) => {}
        }
    }

    /// The plan under way is also the best one for the goals that are wanted now.
    pub(super) fn is_confirmed(&self, operators: &[OperatorId], stages: &[Stage]) -> bool {
        let Hand::Plan(course) = &self.hand else { return false };
        let served = stages.iter().flat_map(|stage| &stage.goals);
        course.left() == operators && served.eq(self.agenda.served().iter())
    }

    /// The goals of a plan, in the order in which it serves them; none if the mission does not name them.
    pub(super) fn names_of(&self, stages: &[Stage]) -> Vec<Vec<Name>> {
        let name = |id: &GoalId| self.model.goals()[id.index()].name.clone();
        let named = stages.iter().filter(|_| self.model.names_goals());
        named.map(|stage| stage.goals.iter().map(name).collect()).collect()
    }

    /// No goal has a plan.
    pub(super) fn postpone_all(&mut self, why: &NoPlan, effects: &mut Vec<Effect>) {
        let hard = |id: &GoalId| self.model.goals()[id.index()].priority().is_some();
        let wanted = self.agenda.candidates().into_iter().filter(hard);
        let postponed: Vec<_> = wanted.map(|id| (id, why.clone())).collect();
        let changes = self.agenda.serve(Vec::new(), &postponed);
        self.tell_goals(changes, effects);
    }
}

/// Whether the world is another than these steps should have made it, while goals wait that had no plan: they may have one
/// now.
pub(super) fn is_surprised(
    expected: &mut Option<State>,
    model: &Model,
    sight: &Sight,
    steps: &[OperatorId],
) -> bool {
    let Some(before) = expected.take() else { return false };
    *expected = Some(sight.state.clone());
    model.task().after(&before, steps).as_ref() != expected.as_ref()
}
