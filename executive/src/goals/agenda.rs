//! All goals of a mission over time.
//!
//! Problem: goals come, go, are held and come back while a plan for some of them is carried out, and every change must
//! have a reason that was seen. Idea: one table of lives. [`Agenda::observe`] moves them by what is perceived, and
//! [`Agenda::serve`] and [`Agenda::turn_to`] by what the plan does; both return what changed. What a plan was made for is
//! remembered, so that the wheel can ask whether it is still the plan to follow. Invariant: the same observations in the
//! same order give the same changes. Invariant: a goal passes to `achieved` only when its condition was seen to hold.

use super::choice::Stage;
use super::life::{GoalChange, Life, Reason};
use crate::goal::{GoalId, GoalText, Importance};
use crate::outcome::NoPlan;
use dsr::Time;
use pddl::model::Name;
use std::time::Duration;

/// What is perceived of one goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct View {
    /// Its condition.
    pub(crate) holds: bool,
    /// What makes it wanted; true for a goal that names nothing.
    pub(crate) when: bool,
    /// What holds it.
    pub(crate) hold: bool,
    /// What ends it.
    pub(crate) drop: bool,
}

/// The goals of a mission.
#[derive(Debug)]
pub(crate) struct Agenda {
    goals: Vec<Entry>,
    /// The goals for which the last decision was made.
    considered: Vec<GoalId>,
    /// The parts of the plan under way.
    stages: Vec<Stage>,
}

#[derive(Debug)]
struct Entry {
    text: GoalText,
    life: Life,
    /// Since when it is wanted.
    since: Time,
    /// Whether what makes it wanted held at the last look.
    triggered: bool,
}

/// Whether and when a plan should be made for other goals than those of the plan under way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Review {
    /// The plan serves what is wanted.
    No,
    /// When the step under way has ended.
    AfterStep,
    /// At once.
    Now,
}

impl Agenda {
    pub(crate) fn new(goals: &[GoalText]) -> Self {
        let entry = |text: &GoalText| Entry {
            text: text.clone(),
            life: Life::Dormant,
            since: Time(0),
            triggered: false,
        };
        Self { goals: goals.iter().map(entry).collect(), considered: Vec::new(), stages: Vec::new() }
    }

    /// The goals with their numbers.
    fn texts(&self) -> impl Iterator<Item = (GoalId, &GoalText)> {
        (0..).map(GoalId).zip(self.goals.iter().map(|entry| &entry.text))
    }

    fn name(&self, id: GoalId) -> &Name {
        &self.goals[id.index()].text.name
    }

    /// Takes in what is perceived now. `seen` gives the tokens behind a condition.
    pub(crate) fn observe(
        &mut self,
        views: &[View],
        now: Time,
        seen: &dyn Fn(GoalId, Life) -> Vec<String>,
    ) -> Vec<GoalChange> {
        let mut changes = Vec::new();
        for (at, view) in views.iter().enumerate() {
            let id = GoalId(u32::try_from(at).unwrap_or(u32::MAX));
            let entry = &mut self.goals[at];
            // A goal that became wanted may end in the same moment: two changes, each with its reason.
            while let Some((life, why)) = entry.next(*view, now, &|life| seen(id, life)) {
                if life == Life::Wanted && !entry.life.is_open() {
                    (entry.since, entry.triggered) = (now, view.when);
                }
                entry.life = life;
                changes.push(GoalChange { id, goal: entry.text.name.clone(), life, why });
            }
            entry.triggered = view.when;
        }
        changes
    }

    /// The goals that a plan should serve, the most important first, soft ones last.
    pub(crate) fn candidates(&self) -> Vec<GoalId> {
        let wants = |id: &GoalId| self.life(*id).is_wanted();
        let mut wanted: Vec<GoalId> = self.texts().map(|(id, _)| id).filter(wants).collect();
        wanted.sort_by_key(|&id| std::cmp::Reverse(self.goals[id.index()].text.priority()));
        wanted
    }

    fn life(&self, id: GoalId) -> Life {
        self.goals[id.index()].life
    }

    /// Those of them that have not been achieved.
    pub(crate) fn unachieved(&self) -> Vec<GoalId> {
        self.served().into_iter().filter(|&id| self.life(id) != Life::Achieved).collect()
    }

    /// The goals that the plan under way serves.
    pub(crate) fn served(&self) -> Vec<GoalId> {
        self.stages.iter().flat_map(|stage| stage.goals.iter().copied()).collect()
    }

    /// Whether another plan should be made, when these goals are wanted.
    pub(crate) fn review(&self, candidates: &[GoalId]) -> Review {
        let served = self.served();
        let open = |id: &&GoalId| self.life(**id) != Life::Achieved;
        let left: Vec<_> = served.iter().filter(open).collect();
        if left.iter().any(|id| !candidates.contains(id)) || (left.is_empty() && !candidates.is_empty()) {
            return Review::Now;
        }
        let fresh: Vec<_> = candidates.iter().filter(|id| !self.considered.contains(id)).collect();
        let pursued = left.first().and_then(|id| self.goals[id.index()].text.priority());
        let interrupts = |id: &&&GoalId| {
            let text = &self.goals[id.index()].text;
            text.urgent && text.priority() > pursued
        };
        match () {
            () if fresh.iter().any(|id| interrupts(&id)) => Review::Now,
            () if !fresh.is_empty() => Review::AfterStep,
            () => Review::No,
        }
    }

    /// A decision was made for these goals.
    pub(crate) fn considered(&mut self, goals: Vec<GoalId>) {
        self.considered = goals;
    }

    /// The goals that wait may have a plan by now.
    pub(crate) fn doubt(&mut self) {
        let served = self.served();
        self.considered.retain(|goal| served.contains(goal));
    }

    /// The goals for which the last decision was made.
    pub(crate) fn last_considered(&self) -> &[GoalId] {
        &self.considered
    }

    /// There is no plan under way.
    pub(crate) fn serve_none(&mut self) {
        self.stages.clear();
    }

    /// A plan is under way, in these stages.
    pub(crate) fn serve(&mut self, stages: Vec<Stage>, postponed: &[(GoalId, NoPlan)]) -> Vec<GoalChange> {
        self.stages = stages;
        let mut changes = Vec::new();
        self.postpone(postponed, &mut changes);
        changes.extend(self.turn_to(0));
        changes
    }

    /// The plan under way goes on, and these goals wait.
    pub(crate) fn confirm(&mut self, postponed: &[(GoalId, NoPlan)], forgone: &[GoalId]) -> Vec<GoalChange> {
        let mut changes = self.forgo(forgone);
        self.postpone(postponed, &mut changes);
        changes
    }

    /// These soft goals are not worth their price.
    pub(crate) fn forgo(&mut self, goals: &[GoalId]) -> Vec<GoalChange> {
        let mut changes = Vec::new();
        for &id in goals {
            if let Importance::Soft(penalty) = self.goals[id.index()].text.importance {
                self.pass(id, Life::GivenUp, Reason::Penalty(penalty), &mut changes);
            }
        }
        changes
    }

    /// Whether all of these goals are wanted or have been achieved.
    pub(crate) fn still_want(&self, goals: &[GoalId]) -> bool {
        let wants = |&id: &GoalId| self.life(id).is_wanted() || self.life(id) == Life::Achieved;
        goals.iter().all(wants) && goals.iter().any(|&id| self.life(id).is_wanted())
    }

    fn postpone(&mut self, postponed: &[(GoalId, NoPlan)], changes: &mut Vec<GoalChange>) {
        for (id, why) in postponed {
            let why = Reason::NoPlan(Box::new(why.clone()));
            let life = match (self.life(*id), self.goals[id.index()].text.importance) {
                (_, Importance::Soft(_)) => Life::GivenUp,
                (Life::Pursued | Life::Suspended, _) => Life::Suspended,
                _ => Life::Wanted,
            };
            self.pass(*id, life, why, changes);
        }
    }

    /// The plan under way is at this step.
    pub(crate) fn turn_to(&mut self, step: usize) -> Vec<GoalChange> {
        let mut changes = Vec::new();
        let Some(now) = self.stages.iter().position(|stage| step < stage.end) else { return changes };
        for (at, stage) in self.stages.clone().into_iter().enumerate().skip(now) {
            let first = self.stages[now].goals.first().map(|&id| self.name(id).clone());
            for id in stage.goals {
                match (self.life(id), &first) {
                    (Life::Wanted | Life::Selected | Life::Suspended, _) if at == now => {
                        self.pass(id, Life::Pursued, Reason::Turn, &mut changes);
                    }
                    (Life::Pursued, Some(first)) if at > now => {
                        self.pass(id, Life::Suspended, Reason::After(first.clone()), &mut changes);
                    }
                    (Life::Wanted, Some(first)) if at > now => {
                        self.pass(id, Life::Selected, Reason::After(first.clone()), &mut changes);
                    }
                    _ => {}
                }
            }
        }
        changes
    }

    fn pass(&mut self, id: GoalId, life: Life, why: Reason, changes: &mut Vec<GoalChange>) {
        let entry = &mut self.goals[id.index()];
        let told = std::mem::replace(&mut entry.life, life) != life || matches!(why, Reason::NoPlan(_));
        if told {
            changes.push(GoalChange { id, goal: entry.text.name.clone(), life, why });
        }
    }

    /// When the next deadline passes.
    pub(crate) fn next_deadline(&self) -> Option<Time> {
        let open = self.goals.iter().filter(|entry| entry.life.is_open());
        open.filter_map(Entry::due).min()
    }

    /// Whether nothing is left to do: every goal that is wanted from the start has ended, and no other one is open.
    pub(crate) fn is_over(&self) -> bool {
        let begun = |entry: &Entry| entry.text.recurs() || entry.life != Life::Dormant;
        // A soft goal that a plan serves is worth the rest of the plan.
        let served = |id: &GoalId| self.life(*id).is_wanted();
        self.has_lasting()
            && self.is_idle()
            && self.goals.iter().all(begun)
            && !self.served().iter().any(served)
    }

    /// Whether a goal is wanted from the start, once: when all of those have ended, the mission is over.
    pub(crate) fn has_lasting(&self) -> bool {
        self.goals.iter().any(|entry| !entry.text.recurs() && entry.text.priority().is_some())
    }

    /// No plan serves what is wanted, and a human has come.
    pub(crate) fn give_up_all(&mut self, why: &NoPlan) -> Vec<GoalChange> {
        let mut changes = Vec::new();
        for id in self.candidates() {
            self.pass(id, Life::GivenUp, Reason::NoPlan(Box::new(why.clone())), &mut changes);
        }
        changes
    }

    /// These goals were achieved in the end, and do not hold any more.
    pub(crate) fn reopen(&mut self, lost: &[GoalId], now: Time) -> Vec<GoalChange> {
        let mut changes = Vec::new();
        for &id in lost {
            if self.life(id) == Life::Achieved {
                self.goals[id.index()].since = now;
                self.pass(id, Life::Wanted, Reason::Lost, &mut changes);
            }
        }
        changes
    }

    /// Whether no goal is open that must be achieved.
    pub(crate) fn is_idle(&self) -> bool {
        !self.goals.iter().any(|entry| entry.life.is_open() && entry.text.priority().is_some())
    }

    /// The goals that had to be achieved and were given up.
    pub(crate) fn failed(&self) -> Vec<Name> {
        let failed = |entry: &&Entry| entry.life == Life::GivenUp && entry.text.priority().is_some();
        self.goals.iter().filter(failed).map(|entry| entry.text.name.clone()).collect()
    }
}

impl Entry {
    fn due(&self) -> Option<Time> {
        let nanos = u64::try_from(self.text.deadline?.as_nanos()).unwrap_or(u64::MAX);
        Some(Time(self.since.0.saturating_add(nanos)))
    }

    /// The stage that follows from what is perceived, if it is another.
    fn next(&self, view: View, now: Time, seen: &dyn Fn(Life) -> Vec<String>) -> Option<(Life, Reason)> {
        let wanted = |why| Some((Life::Wanted, why));
        let trigger = || match self.text.when {
            Some(_) => Reason::Seen(seen(Life::Wanted)),
            None if self.life == Life::Dormant => Reason::Mission,
            None => Reason::Lost,
        };
        match self.life {
            Life::Dormant if self.text.maintained && view.holds => None,
            Life::Dormant if view.when && !view.drop => wanted(trigger()),
            Life::Dormant => None,
            Life::Achieved if self.text.maintained => {
                (!view.holds && view.when && !view.drop).then(|| (Life::Wanted, trigger()))
            }
            Life::Achieved | Life::Dropped | Life::GivenUp => {
                let again = self.text.when.is_some() && view.when && !self.triggered && !view.drop;
                again.then(|| (Life::Wanted, trigger()))
            }
            _ if view.holds => Some((Life::Achieved, Reason::Seen(seen(Life::Achieved)))),
            _ if view.drop => Some((Life::Dropped, Reason::Seen(seen(Life::Dropped)))),
            _ if self.due().is_some_and(|due| now >= due) => {
                let late = self.text.deadline.unwrap_or(Duration::ZERO).as_secs_f64();
                Some((Life::GivenUp, Reason::Late(late)))
            }
            Life::Held if view.hold => None,
            Life::Held => wanted(Reason::Released),
            _ if view.hold => Some((Life::Held, Reason::Seen(seen(Life::Held)))),
            _ => None,
        }
    }
}
