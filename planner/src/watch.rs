//! Looking now and then whether the caller wants an end.
//!
//! Problem: grounding a million operators takes a second, and whoever cancels wants an answer within
//! milliseconds, whatever stage is at work. Idea: every loop [spends](Spend::try_spend) units of work, about a
//! nanosecond each, and each time an interval is used up the caller's closure is asked; an error then
//! runs up through the stages with `?`. Invariant: once it was told so, a watch answers nothing else, so
//! that a helper may stop early and leave it to its caller to notice. Searches have a meter instead,
//! which threads share and which limits turns.

use std::cell::Cell;

/// Units of work between two questions to the caller: well under a millisecond.
pub(crate) const INTERVAL: usize = 1 << 16;
/// Items of a plain loop between two calls.
pub(crate) const CHUNK: usize = 1 << 12;

/// The caller wants an end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Interrupted;

/// Whom work is told to.
pub(crate) trait Spend {
    /// Adds work; an error ends it.
    fn try_spend(&self, units: usize) -> Result<(), Interrupted>;

    /// A slice in parts between which the caller is asked, an item counting so many units.
    fn parts<'s, T>(
        &'s self,
        items: &'s [T],
        units: usize,
    ) -> impl Iterator<Item = Result<&'s [T], Interrupted>> + 's {
        items.chunks(CHUNK).map(move |part| self.try_spend(part.len() * units).map(|()| part))
    }
}

/// One thread's watch.
pub(crate) struct Watch<'a> {
    interrupted: &'a (dyn Fn() -> bool + Sync),
    since: Cell<usize>,
    over: Cell<bool>,
    /// The most units between two questions.
    widest: Cell<usize>,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(interrupted: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { interrupted, since: Cell::new(0), over: Cell::new(false), widest: Cell::new(0) }
    }

    /// What another thread asks by.
    pub(crate) fn closure(&self) -> &'a (dyn Fn() -> bool + Sync) {
        self.interrupted
    }

    #[cold]
    fn ask(&self, since: usize) -> Result<(), Interrupted> {
        self.widest.set(self.widest.get().max(since));
        self.since.set(0);
        if !self.over.get() {
            self.over.set((self.interrupted)());
        }
        if self.over.get() { Err(Interrupted) } else { Ok(()) }
    }

    /// The most units that lay between two questions so far.
    #[cfg(test)]
    pub(crate) fn widest(&self) -> usize {
        self.widest.get().max(self.since.get())
    }
}

impl Spend for Watch<'_> {
    /// Asks the caller where an interval is used up.
    fn try_spend(&self, units: usize) -> Result<(), Interrupted> {
        let since = self.since.get() + units;
        if since < INTERVAL && !self.over.get() {
            self.since.set(since);
            return Ok(());
        }
        self.ask(since)
    }
}

/// Sorts in order of small keys, stably, in one pass of counting.
pub(crate) fn sort_by_count(
    items: &[u32],
    keys: usize,
    watch: &impl Spend,
    key: impl Fn(u32) -> usize,
) -> Result<Vec<u32>, Interrupted> {
    let mut at = vec![0_usize; keys + 1];
    for part in watch.parts(items, 4) {
        part?.iter().for_each(|&i| at[key(i) + 1] += 1);
    }
    for k in 0..keys {
        at[k + 1] += at[k];
    }
    watch.try_spend(keys)?;
    let mut sorted = vec![0; items.len()];
    for part in watch.parts(items, 8) {
        for &i in part? {
            let place = &mut at[key(i)];
            sorted[*place] = i;
            *place += 1;
        }
    }
    Ok(sorted)
}

#[cfg(test)]
mod tests {
    use super::{INTERVAL, Interrupted, Spend, Watch, sort_by_count};
    use crate::ground::{GroundOptions, watched};

    #[test]
    fn whoever_is_told_once_stays_told() {
        let watch = Watch::new(&|| true);
        assert_eq!(watch.try_spend(INTERVAL - 1), Ok(()));
        assert_eq!(watch.try_spend(1), Err(Interrupted));
        assert_eq!(watch.try_spend(0), Err(Interrupted));
    }

    #[test]
    fn sorting_by_count_is_stable() {
        let items: Vec<u32> = (0..20_000).rev().collect();
        let sorted = sort_by_count(&items, 7, &Watch::new(&|| false), |i| i as usize % 7).unwrap();
        assert!(sorted.windows(2).all(|w| (w[0] % 7, u32::MAX - w[0]) < (w[1] % 7, u32::MAX - w[1])));
    }

    #[test]
    fn no_stage_of_grounding_works_for_long_without_a_look() {
        let places: String = (0..70).map(|i| format!(" p{i}")).collect();
        let ways: String = (0..70).flat_map(|a| (0..70).map(move |b| format!("(way p{a} p{b})"))).collect();
        let domain = "(define (domain d) (:requirements :adl :derived-predicates)
           (:predicates (at ?v ?p) (van ?v) (way ?a ?b) (clean ?p) (calm) (busy ?p))
           (:derived (busy ?p) (exists (?v) (at ?v ?p)))
           (:derived (calm) (forall (?p) (imply (busy ?p) (clean ?p))))
           (:action go :parameters (?v ?a ?b) :precondition (and (van ?v) (at ?v ?a) (way ?a ?b))
            :effect (and (not (at ?v ?a)) (at ?v ?b) (when (clean ?b) (not (clean ?b)))))
           (:action wipe :parameters (?v ?a) :precondition (at ?v ?a) :effect (clean ?a)))";
        let problem = format!(
            "(define (problem p) (:domain d) (:objects v w{places})
             (:init (van v) (van w) (at v p0) (at w p1) {ways}) (:goal (and (at v p9) (calm))))"
        );
        let domain = pddl::parse_domain(&pddl::Source::new("d", domain), &[]).model.unwrap();
        let problem = pddl::parse_problem(&pddl::Source::new("p", problem), &domain).model.unwrap();
        let watch = Watch::new(&|| false);
        let task = watched(&domain, &problem, &GroundOptions::default(), &watch).unwrap();
        assert!(task.operators().len() > 9_000);
        assert!(watch.widest() < 2 * INTERVAL, "{} units between two looks", watch.widest());
    }
}
