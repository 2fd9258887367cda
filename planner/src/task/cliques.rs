//! Cliques of moves: sets of propositions where one step leads from any of them to all others.
//!
//! Problem: a satellite that can turn between any two of 300 directions has 90,000 nodes. Every
//! estimate would visit them all, although all directions cost the same once the first is reached.
//! Idea: a *move* is a node with a single precondition. If the moves from two propositions have the
//! same cost and the same set of targets (the propositions included), the two belong to one clique.
//! An exploration in order of cost needs the moves of only the first proposition of a clique; those
//! of the others cannot offer anything better. Invariant: skipping them changes neither costs nor
//! supporters. Cost: linear in the moves.
//!
//! Source: ours.

use super::relaxation::Relaxation;
use crate::ids::id32;
use budget::{Interrupted, Meter};
use rustc_hash::FxHashMap;

/// A proposition without a clique.
pub(crate) const ALONE: u32 = u32::MAX;

/// Returns the clique of each proposition (or [`ALONE`]), and the number of cliques.
pub(super) fn cliques(graph: &Relaxation, meter: &Meter<'_>) -> Result<(Vec<u32>, usize), Interrupted> {
    let mut of = vec![ALONE; graph.propositions()];
    if !graph.ways.is_empty() {
        // The cost of a comparison depends on repetitions, so there are no cliques.
        return Ok((of, 0));
    }
    let mut known: FxHashMap<((bool, u32), Vec<u32>), u32> = FxHashMap::default();
    let mut first: Vec<u32> = Vec::new();
    for p in 0..id32(graph.propositions()) {
        let (_, moves) = graph.waiting_and_moves(p);
        meter.spend(8 + 64 * moves.len())?;
        let Some(price) = moves.first().map(|&n| graph.price(n)) else { continue };
        if moves.iter().any(|&n| graph.price(n) != price) {
            continue;
        }
        let effects = moves.iter().flat_map(|&n| graph.effects.row(n).iter().copied());
        let mut set: Vec<u32> = effects.chain([p]).collect();
        set.sort_unstable();
        set.dedup();
        let clique = *known.entry((price, set)).or_insert_with(|| {
            first.push(p);
            id32(first.len() - 1)
        });
        of[p as usize] = clique;
    }
    // A clique has at least two members.
    let mut members = vec![0_u32; first.len()];
    of.iter().filter(|&&c| c != ALONE).for_each(|&c| members[c as usize] += 1);
    for clique in &mut of {
        if *clique != ALONE && members[*clique as usize] == 1 {
            *clique = ALONE;
        }
    }
    Ok((of, first.len()))
}

#[cfg(test)]
mod tests {
    use crate::heuristics::{Combine, Costs, Counting, Explorer};
    use crate::ids::id32;
    use crate::search::{Bound, Job, Query, SearchMeter, Shared};
    use crate::test_support::Grounded;
    use budget::Budget;
    use proptest::prelude::*;
    use std::fmt::Write;

    const PLACES: usize = 5;

    /// A truck between places that are all connected, except for the closed ways; some ways are
    /// more expensive.
    fn task(closed: &[(usize, usize)], dear: &[(usize, usize)], cargo: usize) -> Grounded {
        let mut domain = String::from(
            "(define (domain d) (:requirements :strips :action-costs)\n(:functions (total-cost) - number)\n\
             (:predicates (full) (done)",
        );
        (0..PLACES).for_each(|i| write!(domain, " (at{i})").unwrap());
        domain.push_str(")\n");
        for (i, j) in (0..PLACES).flat_map(|i| (0..PLACES).map(move |j| (i, j))) {
            if i != j && !closed.contains(&(i, j)) {
                let cost = if dear.contains(&(i, j)) { 3 } else { 1 };
                writeln!(
                    domain,
                    "(:action go{i}{j} :parameters () :precondition (at{i}) \
                     :effect (and (not (at{i})) (at{j}) (increase (total-cost) {cost})))"
                )
                .unwrap();
            }
        }
        write!(
            domain,
            "(:action load :parameters () :precondition (at{cargo}) :effect (full))\n\
             (:action unload :parameters () :precondition (and (full) (at0)) :effect (done)))"
        )
        .unwrap();
        let problem = "(define (problem p) (:domain d) (:init (at0) (= (total-cost) 0)) \
                       (:goal (and (done) (at1))) (:metric minimize (total-cost)))";
        Grounded::new((domain, problem.to_owned()))
    }

    fn costs(grounded: &Grounded, costs: Costs, combine: Combine) -> [Vec<u32>; 2] {
        let task = &grounded.task;
        let query = Query::of(task);
        let (barred, meter) = (query.barred(task), SearchMeter::new(Budget::default()));
        let (bound, shared) = (Bound::none(), Shared::default());
        let (state, goal) = (query.state, query.goal);
        let job = Job { task, state, goal, barred: &barred, meter: &meter, bound: &bound, shared: &shared };
        [&task.relaxation, &task.undominated].map(|graph| {
            let mut explorer = Explorer::on(graph, &job, Vec::new(), costs, combine, Counting::Once);
            explorer.explore(query.state.words());
            (0..id32(graph.propositions())).map(|p| explorer.cost(p)).collect()
        })
    }

    #[test]
    fn places_that_all_lead_to_each_other_are_one_clique() {
        let grounded = task(&[], &[], 2);
        let graph = &grounded.task.undominated;
        let (_, moves) = graph.waiting_and_moves(0);
        assert!(moves.len() >= PLACES - 1);
        let mut cliques: Vec<u32> = graph.clique.iter().copied().filter(|&c| c != super::ALONE).collect();
        assert!(cliques.len() >= PLACES - 1, "where cargo is loaded more can be done");
        cliques.dedup();
        assert_eq!(cliques.len(), 1);
    }

    proptest! {
        #[test]
        fn cliques_change_no_cost(
            closed in prop::collection::vec((0..PLACES, 0..PLACES), 0..4),
            dear in prop::collection::vec((0..PLACES, 0..PLACES), 0..4),
            cargo in 1..PLACES,
        ) {
            let grounded = task(&closed, &dear, cargo);
            prop_assume!(grounded.task.goal().impossible.is_none());
            for combine in [Combine::Sum, Combine::Max] {
                for counted in [Costs::Unit, Costs::PlusOne, Costs::Real] {
                    let [whole, reduced] = costs(&grounded, counted, combine);
                    prop_assert_eq!(whole, reduced);
                }
            }
        }
    }
}
