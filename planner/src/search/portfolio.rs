//! A portfolio of searches that take turns on one thread or two.
//!
//! Problem: no search is best everywhere, a restart loses the work done, and a small task must not
//! pay for a thread. Idea: searches pause and resume. The search with the least work for its weight
//! goes next, for a turn that grows with the work it has done. A second thread joins if the task is
//! large or the answer takes longer than some milliseconds; both threads take searches from the
//! same pool. Searches for hard tasks join late, so they do not delay easy answers. A search that
//! gives up leaves, and when memory runs out the largest one leaves. Invariant: with one thread the
//! order of turns depends on counted work alone, so the same call gives the same answer.
//!
//! Source: turns after Luby, Sinclair & Zuckerman, "Optimal speedup of Las Vegas algorithms", 1993;
//! portfolios: Helmert, Röger & Karpas, "Fast Downward Stone Soup", 2011.

use super::engine::Engine;
use super::{Barred, Bound, Job, Limit, Outcome, Plan, Query, Report, SearchMeter, Searcher};
use super::{Shared, Statistics, Turn};
use crate::query::UNLIMITED;
use crate::task::Task;
use budget::Budget;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The work of the first turn of a search.
const FIRST_TURN: u64 = 1 << 20;
/// The work before a second thread joins.
const ALONE: u64 = 1 << 21;
/// A relaxation with this many nodes lets the second thread join at once.
const LARGE: usize = 20_000;

/// How many threads a portfolio uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Threads {
    /// Only the caller's thread: the same call gives the same answer.
    One,
    /// A second thread joins if it pays off; which search answers first depends on the machine.
    Two,
}

/// What happens to the plans that are found.
pub(crate) enum Sink<'s> {
    /// The first plan is the answer.
    First,
    /// Each plan that is cheaper than all before is passed on, and the searches continue below its
    /// cost.
    Better(&'s mut (dyn FnMut(&Plan) + Send)),
    /// Each plan is passed on, and the searches continue until each is exhausted; the outcome is
    /// then a limit.
    Every(&'s mut (dyn FnMut(&Plan) + Send)),
}

/// A search with its weight.
struct Member<'a> {
    engine: Engine,
    weight: u64,
    meter: &'a SearchMeter<'a>,
    /// The pace of the others when this one joined, so that it does not catch up on the work that
    /// it missed.
    head_start: u64,
    /// Created when its first turn comes.
    searcher: Option<Box<dyn Searcher + Send + 'a>>,
    expanded: u64,
}

impl Member<'_> {
    /// The work divided by the weight, plus the head start.
    fn pace(&self) -> u64 {
        self.head_start + self.meter.work() / self.weight
    }
}

struct Pool<'a, 's> {
    idle: Vec<Member<'a>>,
    expanded: u64,
    statistics: Statistics,
    answer: Option<Outcome>,
    /// The limit that the last search to leave has reported.
    limit: Limit,
    sink: Sink<'s>,
}

struct Portfolio<'a, 's> {
    task: &'a Task,
    query: Query<'a>,
    barred: &'a Barred,
    bound: &'a Bound,
    shared: &'a Shared,
    budget: Budget<'a>,
    meters: &'a [SearchMeter<'a>],
    over: &'a AtomicBool,
    pool: Mutex<Pool<'a, 's>>,
}

/// Runs the searches until one of them answers.
pub(crate) fn run(
    task: &Task,
    query: &Query<'_>,
    members: &[(Engine, u32)],
    threads: Threads,
    bound: &Bound,
    budget: &Budget<'_>,
    sink: Sink<'_>,
) -> Report {
    let barred = query.barred(task);
    let (over, shared) = (AtomicBool::new(false), Shared::default());
    let interrupted = || over.load(Relaxed) || (budget.interrupted)();
    let inner = Budget { interrupted: &interrupted, ..*budget };
    let meters: Vec<SearchMeter<'_>> = members.iter().map(|_| SearchMeter::new(inner)).collect();
    let idle = members.iter().zip(&meters).map(|(&(engine, weight), meter)| Member {
        engine,
        weight: u64::from(weight.max(1)),
        meter,
        head_start: 0,
        searcher: None,
        expanded: 0,
    });
    let portfolio = Portfolio {
        task,
        query: *query,
        barred: &barred,
        bound,
        shared: &shared,
        budget: inner,
        meters: &meters,
        over: &over,
        pool: Mutex::new(Pool {
            idle: idle.collect(),
            expanded: 0,
            statistics: Statistics::default(),
            answer: None,
            limit: Limit::Incomplete,
            sink,
        }),
    };
    if threads == Threads::Two && members.len() > 1 {
        if task.relaxation.nodes() < LARGE {
            portfolio.work(ALONE);
        }
        std::thread::scope(|scope| {
            let other = scope.spawn(|| portfolio.work(u64::MAX));
            portfolio.work(u64::MAX);
            if let Err(panic) = other.join() {
                std::panic::resume_unwind(panic);
            }
        });
    } else {
        portfolio.work(u64::MAX);
    }
    let pool = portfolio.pool.into_inner().unwrap_or_else(PoisonError::into_inner);
    let statistics = pool.idle.iter().filter_map(|m| m.searcher.as_ref());
    let statistics = statistics.fold(pool.statistics, |sum, s| sum + s.statistics());
    Report { outcome: pool.answer.unwrap_or(Outcome::LimitReached(pool.limit)), statistics }
}

/// Stops the other thread if this one panics.
pub(crate) struct Alarm<'a>(pub(crate) &'a AtomicBool);

impl Drop for Alarm<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.store(true, Relaxed);
        }
    }
}

impl<'a, 's> Portfolio<'a, 's> {
    /// Gives turns until there is an answer, no search is left, or the members have done this much
    /// work in all.
    fn work(&self, most: u64) {
        let _alarm = Alarm(self.over);
        while self.meters.iter().map(SearchMeter::work).sum::<u64>() < most {
            let Some((mut member, turn)) = self.take() else { return };
            let meter = member.meter;
            let searcher = member.searcher.get_or_insert_with(|| {
                let (state, goal) = (self.query.state, self.query.goal);
                let Self { task, barred, bound, shared, .. } = *self;
                let job = Job { task, state, goal, barred, meter, bound, shared };
                member.engine.start(job)
            });
            let outcome = searcher.advance(&turn);
            let expanded = searcher.statistics().expanded;
            self.give_back(member, expanded, outcome);
        }
    }

    /// Takes the member whose turn is next out of the pool.
    fn take(&self) -> Option<(Member<'a>, Turn)> {
        let mut pool = self.lock();
        if self.over.load(Relaxed) {
            return None;
        }
        let done: u64 = self.meters.iter().map(SearchMeter::work).sum();
        // If only late members are idle, they join at once.
        let waits = |member: &Member<'_>| done < member.engine.joins_after();
        let slowest = pool.idle.iter().filter(|m| m.searcher.is_some()).map(Member::pace).min();
        for member in pool.idle.iter_mut().filter(|m| m.searcher.is_none() && m.engine.joins_after() > 0) {
            member.head_start = slowest.unwrap_or(0);
        }
        let next = (0..pool.idle.len()).min_by_key(|&i| (waits(&pool.idle[i]), pool.idle[i].pace()))?;
        let member = pool.idle.remove(next);
        let work = member.meter.work();
        let others: usize = self.meters.iter().map(SearchMeter::held).sum::<usize>() - member.meter.held();
        let turn = Turn {
            until: work + FIRST_TURN.max(work / 4),
            bytes: self.budget.memory_bytes.map_or(UNLIMITED, |most| most.saturating_sub(others)),
            expansions: match self.budget.work {
                Some(most) => member.expanded + most.saturating_sub(pool.expanded),
                None => u64::MAX,
            },
        };
        Some((member, turn))
    }

    fn give_back(&self, mut member: Member<'a>, expanded: u64, outcome: Option<Outcome>) {
        let mut pool = self.lock();
        pool.expanded += expanded - member.expanded;
        member.expanded = expanded;
        match outcome {
            None => pool.keep(member),
            Some(Outcome::Solved(plan)) => {
                let Pool { sink, .. } = &mut *pool;
                match sink {
                    Sink::First => {
                        pool.answer.get_or_insert(Outcome::Solved(plan));
                        pool.keep(member);
                        self.over.store(true, Relaxed);
                    }
                    Sink::Every(report) => {
                        report(&plan);
                        pool.keep(member);
                    }
                    Sink::Better(report) => {
                        if plan.cost < self.bound.get() {
                            self.bound.lower(plan.cost);
                            report(&plan);
                        }
                        pool.keep(member);
                    }
                }
            }
            // It has visited all states, but not all paths to them.
            Some(Outcome::Unsolvable(_)) if matches!(pool.sink, Sink::Every(_)) => pool.leave(member),
            Some(answer @ (Outcome::Unsolvable(_) | Outcome::Unsupported(_))) => {
                pool.answer.get_or_insert(answer);
                pool.keep(member);
                self.over.store(true, Relaxed);
            }
            Some(Outcome::LimitReached(Limit::Memory)) if !pool.idle.is_empty() => {
                // The largest search leaves, and the others get its memory.
                pool.keep(member);
                let largest = (0..pool.idle.len()).max_by_key(|&i| pool.idle[i].meter.held());
                let leaving = pool.idle.remove(largest.expect("one was just added"));
                pool.leave(leaving);
            }
            Some(Outcome::LimitReached(limit)) => {
                pool.limit = if limit == Limit::Incomplete { pool.limit } else { limit };
                pool.leave(member);
                if !matches!(limit, Limit::Incomplete | Limit::Memory) {
                    self.over.store(true, Relaxed);
                }
            }
        }
    }

    /// A panic of the other thread is raised again on join, so the poisoned lock can be ignored.
    fn lock(&self) -> MutexGuard<'_, Pool<'a, 's>> {
        self.pool.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<'a> Pool<'a, '_> {
    fn keep(&mut self, member: Member<'a>) {
        self.idle.push(member);
    }

    fn leave(&mut self, member: Member<'a>) {
        if let Some(searcher) = member.searcher {
            self.statistics += searcher.statistics();
        }
        member.meter.release();
    }
}
