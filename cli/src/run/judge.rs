//! Compares the scenario's expectations with the run.
//!
//! Replans and repeated questions are counted in the story; everything else is read from the final graph.

use super::content::Content;
use super::script::questions;
use super::story::{Alarm, Commit, Entry, What};
use crate::scenario::Staged;
use dsr::Snapshot;
use executive::{Ending, Narration};
use mission::Mission;
use mission::scenario::{Outcome, Replan, Violation};
use pddl::Span;
use pddl::model::{Condition, ConditionKind, Domain, Name};
use planner::Way;
use safety::Broken;
use serde::Serialize;
use std::collections::BTreeSet;

/// Collects the figures that the expectations refer to.
pub(super) struct Record<'a> {
    mission: &'a Mission,
    /// The label of the edge from an item's answer to the item.
    answer: Name,
    questions: Vec<Name>,
    answered: BTreeSet<String>,
    asked_again: Vec<Name>,
    replans: Vec<Replan>,
    plans: u32,
    repairs: Repairs,
    broken: Vec<Breakage>,
    /// The goals that have been wanted, and the stages in which their lives are.
    goals: Vec<(Name, String)>,
}

/// A broken invariant, in the summary.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Breakage {
    pub(crate) time: f64,
    pub(crate) version: u64,
    #[serde(flatten)]
    pub(crate) what: Broken,
}

/// The replacements of broken plans.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(super) struct Repairs {
    /// How often the remaining plan was reused.
    pub(super) reuse: u32,
    /// How often a plan from scratch was closer to the old one, or the only plan.
    pub(super) scratch: u32,
    /// The total number of removed steps.
    removed: usize,
    /// The total number of new steps.
    added: usize,
    /// The total number of steps that moved in the order.
    moved: usize,
}

impl<'a> Record<'a> {
    pub(super) fn new(mission: &'a Mission) -> Self {
        Self {
            mission,
            answer: mission.manifest.report.answer.name.clone(),
            questions: questions(mission),
            answered: BTreeSet::new(),
            asked_again: Vec::new(),
            replans: Vec::new(),
            plans: 0,
            repairs: Repairs::default(),
            broken: Vec::new(),
            goals: Vec::new(),
        }
    }

    /// The number of replans.
    pub(super) fn replans(&self) -> u32 {
        self.plans.saturating_sub(1)
    }

    /// The replacements of broken plans.
    pub(super) fn repairs(&self) -> Repairs {
        self.repairs
    }

    /// Items that were asked again after they had been answered.
    pub(super) fn asked_again(&self) -> &[Name] {
        &self.asked_again
    }

    /// The invariants that were broken.
    pub(super) fn broken(&self) -> &[Breakage] {
        &self.broken
    }

    /// The goals that have been wanted, and the stages in which their lives are.
    pub(super) fn goals(&self) -> &[(Name, String)] {
        &self.goals
    }

    /// Records an entry.
    pub(super) fn note(&mut self, entry: &Entry) {
        match &entry.what {
            What::Pelea(Narration::Deviated(deviation)) => {
                let facts = deviation.broken.iter().filter_map(|literal| literal.fact.as_ref());
                let mut names = BTreeSet::new();
                for fact in facts {
                    mentioned(&self.mission.layers.perception.model, &fact.predicate, &mut names);
                }
                self.replans.push(Replan { names: names.into_iter().collect() });
            }
            What::Pelea(Narration::Planned { repair, .. }) => {
                self.plans += 1;
                if let Some((by, figures)) = repair.and_then(|r| Some((r.by, r.chosen()?))) {
                    match by {
                        Way::Reuse => self.repairs.reuse += 1,
                        Way::Scratch => self.repairs.scratch += 1,
                    }
                    self.repairs.removed += figures.removed;
                    self.repairs.added += figures.added;
                    self.repairs.moved += figures.moved;
                }
            }
            What::Pelea(Narration::Goal(change)) => {
                let life = change.life.name().to_owned();
                match self.goals.iter_mut().find(|(goal, _)| *goal == change.goal) {
                    Some((_, known)) => *known = life,
                    None => self.goals.push((change.goal.clone(), life)),
                }
            }
            What::Graph(commit) => self.note_commit(commit),
            What::Safety(Alarm::Broken(what)) => {
                let (time, version, what) = (entry.time, entry.version, what.clone());
                self.broken.push(Breakage { time, version, what });
            }
            _ => {}
        }
    }

    fn note_commit(&mut self, commit: &Commit) {
        for (from, label, to) in &commit.edges {
            if **label == *self.answer {
                self.answered.insert(to.clone());
            } else if self.questions.iter().any(|q| **q == **from) && self.answered.contains(to) {
                self.asked_again.push(Name::new(to));
            }
        }
    }

    /// The expectations of the scenario that were not met.
    pub(super) fn judge(
        &self,
        staged: &Staged,
        ending: &Ending,
        content: &Content,
        snapshot: &Snapshot,
        begun: &BTreeSet<usize>,
    ) -> Vec<Violation> {
        let report = content.report(snapshot);
        let disruptions = staged.scenario.disruptions.iter().enumerate();
        let idle = disruptions.filter(|(number, of)| !of.optional && !begun.contains(number));
        let idle: Vec<Span> = idle.map(|(_, disruption)| disruption.span).collect();
        let outcome = Outcome {
            accomplished: *ending == Ending::Accomplished,
            ending: ending.name(),
            report: &report,
            replans: &self.replans,
            asked_again: &self.asked_again,
            goals: &self.goals,
            idle: &idle,
        };
        staged.scenario.expect.judge(&outcome, |condition| staged.holds(condition, snapshot))
    }
}

/// The predicate and everything that its axioms mention, through derived ones down to tokens.
fn mentioned(perception: &Domain, predicate: &Name, names: &mut BTreeSet<Name>) {
    if !names.insert(predicate.clone()) {
        return;
    }
    let id = perception.predicate(predicate);
    for axiom in perception.axioms.iter().filter(|axiom| Some(axiom.predicate) == id) {
        let mut atoms = Vec::new();
        collect(&axiom.body, &mut atoms);
        for atom in atoms {
            mentioned(perception, &perception.predicates[atom].name, names);
        }
    }
}

fn collect(condition: &Condition, atoms: &mut Vec<pddl::model::PredicateId>) {
    condition.each(&mut |part| {
        if let ConditionKind::Atom(atom) = &part.kind {
            atoms.push(atom.predicate);
        }
    });
}
