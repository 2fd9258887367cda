//! The search for a decomposition of the task network into the steps of a plan.
//!
//! The caller has checked that the steps are applicable. [`ground`] writes down the [`grammar`] of this plan: which
//! tasks decompose into what, restricted to the plan's steps. [`outlook`] bounds what each task can and must yield.
//! [`progress`] searches for a decomposition, in turns from the first step forward and from the last step back,
//! because a problem that is hard from one end may be easy from the other. [`rebuild`] turns the result into a plan,
//! and the caller checks it like any given decomposition.
//!
//! Invariant: [`Outcome::None`] means that the search was exhaustive. Limits are counted, not timed, and a limit is
//! no answer.

mod grammar;
mod ground;
mod outlook;
mod progress;
mod rebuild;
mod situation;

use crate::plan::StepIndex;
use crate::prepared::Prepared;
use crate::verdict::Shortfall;
use crate::work::Thoroughness;
use budget::{Interrupted, Meter};
use grammar::{Grammar, Symbol, SymbolId};
use ground::{Ground, ground};
use outlook::Outlook;
use pddl::{HierarchicalPlan, SequentialPlan};
use progress::{Ahead, Answer, Search};
use rebuild::{Direction, rebuild};

/// The budget of grounding.
const GROUND: u64 = 6_000_000;
/// The budget of rebuilding a decomposition: one with few steps may have many tasks.
const REBUILD: u64 = 300_000;
/// The budget of each round of the search, from each end.
const ROUNDS: [u64; 3] = [60_000, 600_000, 6_000_000];

/// The result of a search for a decomposition.
pub(super) enum Outcome {
    /// One decomposition.
    Found(HierarchicalPlan),
    /// No decomposition exists.
    None(Shortfall),
    /// The budget is exhausted.
    Limit,
}

pub(super) fn search(prepared: &Prepared<'_>, plan: &SequentialPlan) -> Outcome {
    decide(prepared, plan).unwrap_or(Outcome::Limit)
}

fn decide(prepared: &Prepared<'_>, plan: &SequentialPlan) -> Result<Outcome, Interrupted> {
    let thoroughness = prepared.thoroughness;
    let meter = Meter::of_work(thoroughness.of(GROUND));
    let grammar = match ground(prepared, plan, &meter)? {
        Ground::Grammar(grammar) => grammar,
        Ground::Impossible(spans) => return Ok(Outcome::None(Shortfall::Subtasks(spans))),
    };
    let outlook = Outlook::new(&grammar, &meter)?;
    let reversed = grammar.reversed();
    let reversed_outlook = Outlook::new(&reversed, &meter)?;
    let sides =
        [(Direction::Forward, &grammar, &outlook), (Direction::Backward, &reversed, &reversed_outlook)];
    for round in ROUNDS {
        for (direction, grammar, outlook) in sides {
            let meter = Meter::of_work(thoroughness.of(round));
            let mut search = Search::new(grammar, outlook, Ahead::Far, &Meter::of_work(GROUND))?;
            match search.run(&meter) {
                Answer::Found(events) => {
                    let found = rebuild(plan, grammar, outlook, direction, events, &Meter::of_work(REBUILD))?;
                    return Ok(Outcome::Found(found));
                }
                Answer::None => {
                    // The caller ignores the reason if this is one trial of many.
                    let why = match thoroughness {
                        Thoroughness::Full => shortfall(sides[0].1, sides[0].2),
                        Thoroughness::Brief => Shortfall::Explained(0),
                    };
                    return Ok(Outcome::None(why));
                }
                Answer::Limit => {}
            }
        }
    }
    Ok(Outcome::Limit)
}

/// The most helpful reason why a plan has no decomposition.
fn shortfall(grammar: &Grammar, outlook: &Outlook) -> Shortfall {
    let alien = |step: &SymbolId| match grammar.symbols[*step] {
        Symbol::Action(action) => !outlook.may.has(grammar.root, action),
        Symbol::Root | Symbol::Task { .. } | Symbol::Guard(_) => false,
    };
    let alien = grammar.steps.iter().position(alien).filter(|_| outlook.least[grammar.root] < u32::MAX);
    if let Some(step) = alien.and_then(|step| u32::try_from(step).ok()) {
        return Shortfall::Step(StepIndex(step));
    }
    let search = Search::new(grammar, outlook, Ahead::Near, &Meter::of_work(GROUND));
    let explained = search.map(|mut search| {
        // Whatever the result is, the search explained this many steps.
        let _ = search.run(&Meter::of_work(ROUNDS[0]));
        search.explained
    });
    Shortfall::Explained(explained.unwrap_or(0))
}
