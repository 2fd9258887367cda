//! Everything that never happens, by root causes.
//!
//! Problem: one mistake silences everything behind it, and a report of each consequence hides the mistake. Idea: ask for
//! the reason of everything that never fires. Where a reason leads to something else that never fires, the first is a
//! consequence; it is listed with its root.

use std::rc::Rc;

use pddl::Span;
use pddl::model::{Condition, ObjectId, VariableId};
use rustc_hash::FxHashSet;

use super::fixpoint::Reachability;
use super::rule::Origin;
use super::why::{Cause, Explainer, Link, Piece, RootCause};
use super::wording::Wording;
use super::world::World;
use crate::happening::{Phase, Schema};
use crate::intervals::Hulls;

/// Conjuncts of a goal that are explained.
const GOALS: usize = 5;

/// Roots for want of facts; if there are more, the domain is a library, of which a problem needs a part.
const LIBRARY: usize = 8;

/// Something that never fires.
#[derive(Debug)]
pub struct Dead {
    /// Which rule.
    pub origin: Origin,
    /// Why, as the rest of a sentence.
    pub reason: String,
    /// What the reason comes from.
    pub root_cause: RootCause,
    /// The place of the condition that never holds.
    pub needed: Option<Span>,
    /// What does not fire either, because of this.
    pub consequences: Vec<Origin>,
}

/// A conjunct of the goal that can never hold.
#[derive(Debug)]
pub struct UnreachableGoal<'a> {
    /// The conjunct.
    pub condition: &'a Condition,
    /// The objects that a `forall` around it gives to its variables.
    pub values: Vec<(VariableId, ObjectId)>,
    /// Why, as the rest of a sentence.
    pub reason: String,
}

/// A subtask of the problem's network that cannot be carried out.
#[derive(Debug)]
pub struct Impossible {
    /// The position of the subtask in the network.
    pub subtask: usize,
    /// Why, as the rest of a sentence.
    pub reason: String,
}

/// Everything that never happens.
#[derive(Debug, Default)]
pub struct Summary<'a> {
    /// Root causes only.
    pub dead: Vec<Dead>,
    /// All origins that never fire.
    pub silent: FxHashSet<Origin>,
    /// Subtasks of the problem's network that cannot be carried out.
    pub impossible: Vec<Impossible>,
    /// Conjuncts of the problem's goal that can never hold.
    pub goals: Vec<UnreachableGoal<'a>>,
}

impl<'a> Summary<'a> {
    /// Of the models that are worded; `None` if the budget does not suffice.
    pub fn new(wording: &Wording<'a>, hulls: &Rc<Hulls>) -> Option<Self> {
        let reachability = Reachability::new(World::new(wording.domain, wording.problem), hulls)?;
        let silent: Vec<Origin> = reachability.silent().into_iter().cloned().collect();
        let mut explainer = Explainer::new(reachability);
        let mut summary = Self { silent: silent.iter().cloned().collect(), ..Self::default() };
        // A part of something that never fires as a whole needs no reason of its own.
        let own = |o: &&Origin| {
            let whole = Origin { when: None, ..(*o).clone() };
            let start = Origin { phase: Phase::Start, ..whole.clone() };
            let by_when = o.when.is_some() && summary.silent.contains(&whole);
            let by_start = o.phase != Phase::Start && summary.silent.contains(&start);
            !by_when && !by_start
        };
        let asked: Vec<&Origin> = silent.iter().filter(own).collect();
        let chains: Vec<Vec<Link>> = asked.iter().map(|origin| explainer.why(origin)).collect();
        let roots: Vec<usize> = (0..asked.len()).map(|i| root(i, &asked, &chains)).collect();
        for (origin, chain) in asked.iter().zip(&chains) {
            if let Schema::Initial(subtask) = origin.schema {
                summary.impossible.push(Impossible { subtask, reason: explainer.reason(wording, chain) });
            }
        }
        for (i, origin) in asked.iter().enumerate().filter(|(i, _)| roots[*i] == *i) {
            let consequences = (0..asked.len()).filter(|&j| roots[j] == i && j != i);
            summary.dead.push(Dead {
                origin: (*origin).clone(),
                reason: explainer.reason(wording, &chains[i]),
                root_cause: explainer.root_cause(&chains[i]),
                needed: needed(&chains[i]),
                consequences: consequences.map(|j| asked[j].clone()).collect(),
            });
        }
        let is_for_want_of_facts = |dead: &&mut Dead| dead.root_cause == RootCause::Facts;
        let is_library = summary.dead.iter_mut().filter(is_for_want_of_facts).count() > LIBRARY;
        for dead in summary.dead.iter_mut().filter(is_for_want_of_facts) {
            dead.root_cause = if is_library { RootCause::Data } else { RootCause::Domain };
        }
        for goal in explainer.dead_goals(GOALS) {
            let reason = explainer.reason(wording, &goal.chain);
            let (condition, values) = (goal.condition, goal.values);
            summary.goals.push(UnreachableGoal { condition, values, reason });
        }
        Some(summary)
    }
}

/// The silent origin that a chain ends in; `i` itself if the chain leads to no other.
fn root(i: usize, asked: &[&Origin], chains: &[Vec<Link>]) -> usize {
    let mut seen = vec![i];
    let mut at = i;
    loop {
        // The achievers of a circle are silent as well: the first of them stands for it.
        let circle = chains[at].last().and_then(|l| match &l.cause {
            Cause::Circle(_, by) => Some(by.iter()),
            _ => None,
        });
        let along = chains[at].iter().skip(1).map(|l| &l.origin).chain(circle.into_iter().flatten());
        let same = |o: &Origin, a: &Origin| o.schema == a.schema && o.when == a.when;
        let next = along.filter_map(|o| asked.iter().position(|a| same(o, a))).find(|&j| j != at);
        match next {
            None => return at,
            Some(j) if seen.contains(&j) => {
                let circle = seen.iter().skip_while(|&&k| k != j);
                return circle.copied().min().unwrap_or(j);
            }
            Some(j) => {
                seen.push(j);
                at = j;
            }
        }
    }
}

/// The place of the first atom that never holds, if it is in the schema that the chain starts with.
fn needed(chain: &[Link]) -> Option<Span> {
    match &chain.first()?.cause {
        Cause::NothingMakes(Piece::Atom(p, _))
        | Cause::OnlyMadeBy(Piece::Atom(p, _), _)
        | Cause::Circle(Piece::Atom(p, _), _) => Some(p.span),
        _ => None,
    }
}
