//! Search configurations by name.
//!
//! A test iterates over [`SearchConfiguration::ALL`] and compares answers and optimal costs, so a
//! new row is tested as soon as it is added.

use super::bfws::{BfwsSettings, Count, Width};
use super::eager::EagerSettings;
use super::engine::Engine;
use super::lazy::{Exploration, LazySettings, Pruning};
use super::order::Order;
use super::portfolio::Threads;
use crate::heuristics::{Costs, HeuristicKind};
use HeuristicKind::{Add, Blind, Ff, GoalCount, Landmarks, LmCut, Max};

/// A search configuration with its name and properties.
#[derive(Clone, Copy, Debug)]
pub struct SearchConfiguration {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it is good for, in one line.
    pub summary: &'static str,
    /// Whether its plans are optimal.
    pub optimal: bool,
    /// Whether the same call always gives the same answer.
    pub deterministic: bool,
    /// Whether it finds a plan if one exists, given enough time and memory.
    pub complete: bool,
    /// Searches that take turns, each with its weight.
    pub(crate) members: &'static [(Engine, u32)],
    pub(crate) threads: Threads,
}

const fn lazy(heuristics: &'static [HeuristicKind], preferred: &'static [HeuristicKind]) -> Engine {
    exploring(heuristics, preferred, &[])
}

const fn exploring(
    heuristics: &'static [HeuristicKind],
    preferred: &'static [HeuristicKind],
    explorations: &'static [Exploration],
) -> Engine {
    let (costs, order, pruning) = (Costs::Unit, Order::Greedy, Pruning::Spent);
    Engine::Lazy(LazySettings { heuristics, preferred, costs, order, explorations, pruning })
}

const fn eager(heuristic: HeuristicKind, costs: Costs, order: Order) -> Engine {
    Engine::Eager(EagerSettings { heuristic, costs, order })
}

const fn greedy(heuristic: HeuristicKind) -> Engine {
    eager(heuristic, Costs::Unit, Order::Greedy)
}

const fn astar(heuristic: HeuristicKind) -> Engine {
    eager(heuristic, Costs::Real, Order::Weighted(1))
}

const fn bfws(width: Width, count: Count) -> Engine {
    Engine::Bfws(BfwsSettings { width, count })
}

pub(super) const LAMA: Engine = lazy(&[Ff, Landmarks], &[Ff, Landmarks]);
const LAMA_NOVELTY: Engine = exploring(&[Ff, Landmarks], &[Ff, Landmarks], &[Exploration::Novelty]);
const LAMA_TYPES: Engine = exploring(&[Ff, Landmarks], &[Ff, Landmarks], &[Exploration::Types]);
const LANDMARKS: Engine = lazy(&[Landmarks], &[]);
const BFWS_LANDMARKS: Engine = bfws(Width::AnyOne, Count::Landmarks);
const BFWS: Engine = bfws(Width::AnyOne, Count::Goals);

impl SearchConfiguration {
    /// Every configuration; the first is the default.
    pub const ALL: &'static [Self] = &[
        Self::row(
            "lama",
            "greedy search on relaxed plans and landmarks with preferred operators",
            &[(LAMA, 1)],
        ),
        Self {
            deterministic: false,
            threads: Threads::Two,
            ..Self::row(
                "dual",
                "lama-novelty, width searches and others in turns, on up to two threads",
                &[(LAMA_NOVELTY, 3), (BFWS_LANDMARKS, 3), (BFWS, 2), (LANDMARKS, 1), (Engine::BackEnd, 4)],
            )
        },
        Self::row("lama-novelty", "lama that also visits novel states", &[(LAMA_NOVELTY, 1)]),
        Self::row("lama-types", "lama that also visits random states of rare types", &[(LAMA_TYPES, 1)]),
        Self::row(
            "dual-bfws",
            "width search on novel states only, then a complete one on landmarks and relaxed plans",
            &[(Engine::DualBfws, 1)],
        ),
        Self::row("dual-bfws-back", "the second part of dual-bfws alone", &[(Engine::BackEnd, 1)]),
        Self::row(
            "lazy-ff",
            "greedy search on relaxed plans with preferred operators",
            &[(lazy(&[Ff], &[Ff]), 1)],
        ),
        Self::row("lazy-landmarks", "greedy search on landmarks", &[(LANDMARKS, 1)]),
        Self::row("bfws", "best-first width search on novelty and goal counts", &[(BFWS, 1)]),
        Self::row(
            "bfws-pairs",
            "the same with novelty of pairs of facts",
            &[(bfws(Width::AnyTwo, Count::Goals), 1)],
        ),
        Self::row(
            "bfws-landmarks",
            "bfws that counts unachieved landmarks instead of open goals",
            &[(BFWS_LANDMARKS, 1)],
        ),
        Self::row(
            "bfws-landmarks-pairs",
            "the same with novelty of pairs of facts",
            &[(bfws(Width::AnyTwo, Count::Landmarks), 1)],
        ),
        Self::incomplete(
            "bfws-1",
            "bfws that drops states without novelty: fast and incomplete",
            &[(bfws(Width::One, Count::Goals), 1)],
        ),
        Self::incomplete(
            "bfws-2",
            "bfws-pairs that drops states without novelty: incomplete",
            &[(bfws(Width::Two, Count::Goals), 1)],
        ),
        Self::incomplete(
            "hill",
            "enforced hill-climbing on relaxed plans: incomplete",
            &[(Engine::HillClimbing, 1)],
        ),
        Self::row("greedy-ff", "eager greedy search on relaxed plans", &[(greedy(Ff), 1)]),
        Self::row("greedy-add", "eager greedy search with hadd", &[(greedy(Add), 1)]),
        Self::row("greedy-max", "eager greedy search with hmax", &[(greedy(Max), 1)]),
        Self::row("greedy-goals", "eager greedy search on open goals", &[(greedy(GoalCount), 1)]),
        Self::row("greedy-landmarks", "eager greedy search on landmarks", &[(greedy(Landmarks), 1)]),
        Self::row("greedy-lmcut", "eager greedy search with landmark cuts", &[(greedy(LmCut), 1)]),
        Self::row("greedy-blind", "breadth-first search", &[(greedy(Blind), 1)]),
        Self::row(
            "wastar-ff",
            "weighted A* (3) on relaxed plans",
            &[(eager(Ff, Costs::Real, Order::Weighted(3)), 1)],
        ),
        Self::optimal("astar-lmcut", "A* with landmark cuts: optimal", &[(astar(LmCut), 1)]),
        Self::optimal("astar-max", "A* with hmax: optimal", &[(astar(Max), 1)]),
        Self::optimal("astar-blind", "uniform-cost search: optimal", &[(astar(Blind), 1)]),
    ];

    const fn row(name: &'static str, summary: &'static str, members: &'static [(Engine, u32)]) -> Self {
        Self {
            name,
            summary,
            optimal: false,
            deterministic: true,
            complete: true,
            members,
            threads: Threads::One,
        }
    }

    const fn incomplete(
        name: &'static str,
        summary: &'static str,
        members: &'static [(Engine, u32)],
    ) -> Self {
        Self { complete: false, ..Self::row(name, summary, members) }
    }

    const fn optimal(name: &'static str, summary: &'static str, members: &'static [(Engine, u32)]) -> Self {
        Self { optimal: true, ..Self::row(name, summary, members) }
    }

    /// Returns the configuration with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|c| c.name == name).copied()
    }

    /// The default of the command line. It uses two threads, so its answers may vary.
    pub fn portfolio() -> Self {
        Self::named("dual").expect("it is in the table above")
    }

    /// The configuration to use for an optimal plan.
    pub fn best_optimal() -> Self {
        Self::named("astar-lmcut").expect("it is in the table above")
    }
}

impl Default for SearchConfiguration {
    fn default() -> Self {
        Self::ALL[0]
    }
}
