//! Search configurations by name.
//!
//! A test walks [`SearchConfiguration::ALL`] and compares answers and optimal costs, so a new row is
//! tested the day it is added.

use super::bfws::Width;
use crate::heuristics::{Costs, HeuristicKind};

/// A search algorithm with its parameters.
#[derive(Clone, Copy, Debug)]
pub enum Engine {
    /// Greedy best-first with deferred evaluation and preferred operators.
    Lazy {
        /// One pair of open lists each.
        heuristics: &'static [HeuristicKind],
        /// What they count.
        costs: Costs,
    },
    /// A*, optimal with an admissible heuristic.
    AStar(HeuristicKind),
    /// Best-first width search.
    Bfws(Width),
    /// One after the other, each with its most expansions.
    Sequence(&'static [(Engine, Option<u64>)]),
    /// All at once, a thread each.
    Parallel(&'static [Engine]),
}

/// A named configuration.
#[derive(Clone, Copy, Debug)]
pub struct SearchConfiguration {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it is good for, one line.
    pub summary: &'static str,
    /// Whether its plans are optimal.
    pub optimal: bool,
    /// Whether the same call always gives the same answer.
    pub deterministic: bool,
    pub(crate) engine: Engine,
}

const LAZY_FF: Engine = Engine::Lazy { heuristics: &[HeuristicKind::Ff], costs: Costs::Unit };
const LAMA: Engine =
    Engine::Lazy { heuristics: &[HeuristicKind::Ff, HeuristicKind::Landmarks], costs: Costs::Unit };
const BFWS: Engine = Engine::Bfws(Width::Any);

impl SearchConfiguration {
    /// Every configuration; the first is the default.
    pub const ALL: &'static [Self] = &[
        Self::row("lama", "greedy search on relaxed plans and landmarks with preferred operators", LAMA),
        Self::row("lazy-ff", "greedy search on relaxed plans with preferred operators", LAZY_FF),
        Self::row("bfws", "best-first width search on novelty and goal counts", BFWS),
        Self::row(
            "bfws-1",
            "the same, dropping what is not novel: fast and incomplete",
            Engine::Bfws(Width::One),
        ),
        Self {
            deterministic: false,
            ..Self::row("dual", "lama and bfws at once", Engine::Parallel(&[LAMA, BFWS]))
        },
        Self::optimal("astar-lmcut", "A* with landmark cuts: optimal", HeuristicKind::LmCut),
        Self::optimal("astar-max", "A* with hmax: optimal", HeuristicKind::Max),
        Self::optimal("astar-blind", "uniform-cost search: optimal", HeuristicKind::Blind),
    ];

    const fn row(name: &'static str, summary: &'static str, engine: Engine) -> Self {
        Self { name, summary, optimal: false, deterministic: true, engine }
    }

    const fn optimal(name: &'static str, summary: &'static str, heuristic: HeuristicKind) -> Self {
        Self { name, summary, optimal: true, deterministic: true, engine: Engine::AStar(heuristic) }
    }

    /// The configuration of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|c| c.name == name).copied()
    }

    /// The one for the command line: uses two threads, so its answers may vary.
    pub fn portfolio() -> Self {
        Self::named("dual").expect("it is in the table above")
    }

    /// The one to use when an optimal plan is asked for.
    pub fn best_optimal() -> Self {
        Self::named("astar-lmcut").expect("it is in the table above")
    }
}

impl Default for SearchConfiguration {
    fn default() -> Self {
        Self::ALL[0]
    }
}
