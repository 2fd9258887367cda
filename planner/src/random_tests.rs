//! Random small tasks, compared with an exhaustive search that shares no code with ours.
//!
//! A task has a few facts without arguments, two derived ones (one over the other's negation),
//! actions with negative, disjunctive and conditional parts and costs. A brute-force interpreter on
//! bit masks knows every answer.

use crate::heuristics::{Estimate, HeuristicKind};
use crate::search::{Limit, Outcome, Preference, Query, SearchConfiguration, repair, solve};
use crate::test_support::Grounded;
use budget::Budget;
use proptest::prelude::*;
use std::fmt::Write;

pub(crate) const FACTS: usize = 5;

/// A fact (derived ones follow the basic ones) and whether it must hold.
pub(crate) type Sign = (usize, bool);

#[derive(Clone, Debug)]
struct RandomAction {
    needs: Vec<Sign>,
    one_of: Vec<Sign>,
    effects: Vec<Sign>,
    when: Option<(Sign, Sign)>,
    cost: u32,
}

#[derive(Clone, Debug)]
pub(crate) struct RandomTask {
    axioms: [Vec<Vec<Sign>>; 2],
    actions: Vec<RandomAction>,
    initial: u32,
    pub(crate) goal: Vec<Sign>,
}

fn sign(facts: usize) -> impl Strategy<Value = Sign> {
    (0..facts, any::<bool>())
}

pub(crate) fn random_task() -> impl Strategy<Value = RandomTask> {
    let all = FACTS + 2;
    let action = (
        prop::collection::vec(sign(all), 0..3),
        prop::collection::vec(sign(all), 0..3),
        prop::collection::vec(sign(FACTS), 1..4),
        prop::option::of((sign(all), sign(FACTS))),
        0..4_u32,
    )
        .prop_map(|(needs, one_of, effects, when, cost)| RandomAction {
            needs,
            one_of,
            effects,
            when,
            cost,
        });
    let body = |facts| prop::collection::vec(prop::collection::vec(sign(facts), 1..3), 0..3);
    (
        body(FACTS),
        body(FACTS + 1),
        prop::collection::vec(action, 1..6),
        0..1_u32 << FACTS,
        prop::collection::vec(sign(all), 1..4),
    )
        .prop_map(|(a, b, actions, initial, goal)| RandomTask { axioms: [a, b], actions, initial, goal })
}

impl RandomTask {
    pub(crate) fn text(&self) -> (String, String) {
        let name = |f: usize| if f < FACTS { format!("(p{f})") } else { format!("(d{})", f - FACTS) };
        let literal = |&(f, holds): &Sign| if holds { name(f) } else { format!("(not {})", name(f)) };
        let list = |signs: &[Sign]| signs.iter().map(literal).collect::<Vec<_>>().join(" ");
        let mut domain = String::from(
            "(define (domain r) (:requirements :adl :derived-predicates :action-costs)\n(:predicates (d0) (d1)",
        );
        (0..FACTS).for_each(|f| write!(domain, " {}", name(f)).unwrap());
        domain.push_str(")\n(:functions (total-cost) - number)\n");
        for (i, bodies) in self.axioms.iter().enumerate() {
            let bodies: Vec<String> = bodies.iter().map(|b| format!("(and {})", list(b))).collect();
            writeln!(domain, "(:derived (d{i}) (or {}))", bodies.join(" ")).unwrap();
        }
        for (i, a) in self.actions.iter().enumerate() {
            let mut needs = list(&a.needs);
            if !a.one_of.is_empty() {
                write!(needs, " (or {})", list(&a.one_of)).unwrap();
            }
            let when = a.when.map(|(c, e)| format!("(when {} {})", literal(&c), literal(&e)));
            writeln!(
                domain,
                "(:action a{i} :parameters () :precondition (and {needs}) :effect (and {} {} \
                 (increase (total-cost) {})))",
                list(&a.effects),
                when.unwrap_or_default(),
                a.cost
            )
            .unwrap();
        }
        domain.push(')');
        let holds: Vec<String> = (0..FACTS).filter(|f| self.initial >> f & 1 == 1).map(name).collect();
        let problem = format!(
            "(define (problem q) (:domain r) (:init {} (= (total-cost) 0)) (:goal (and {})) \
             (:metric minimize (total-cost)))",
            holds.join(" "),
            list(&self.goal)
        );
        (domain, problem)
    }

    /// The state with its derived facts.
    fn close(&self, basic: u32) -> u32 {
        let mut state = basic & ((1 << FACTS) - 1);
        for (i, bodies) in self.axioms.iter().enumerate() {
            if bodies.iter().any(|b| all(b, state)) {
                state |= 1 << (FACTS + i);
            }
        }
        state
    }

    fn apply(&self, state: u32, action: &RandomAction) -> Option<u32> {
        let one = action.one_of.is_empty() || action.one_of.iter().any(|s| all(&[*s], state));
        if !(one && all(&action.needs, state)) {
            return None;
        }
        let mut effects = action.effects.clone();
        effects.extend(action.when.filter(|(c, _)| all(&[*c], state)).map(|(_, e)| e));
        let mut next = state;
        effects.iter().filter(|e| !e.1).for_each(|e| next &= !(1 << e.0));
        effects.iter().filter(|e| e.1).for_each(|e| next |= 1 << e.0);
        Some(self.close(next))
    }

    /// All reachable states, with their derived facts.
    pub(crate) fn reachable(&self) -> std::collections::BTreeSet<u32> {
        let first = self.close(self.initial);
        let mut found = std::collections::BTreeSet::from([first]);
        let mut queue = vec![first];
        while let Some(state) = queue.pop() {
            for next in self.actions.iter().filter_map(|action| self.apply(state, action)) {
                if found.insert(next) {
                    queue.push(next);
                }
            }
        }
        found
    }

    /// The cheapest cost to the goal, by relaxation until nothing changes.
    fn optimum(&self) -> Option<u64> {
        let mut cost = vec![u64::MAX; 1 << (FACTS + 2)];
        cost[self.close(self.initial) as usize] = 0;
        loop {
            let before = cost.clone();
            for state in 0..1_u32 << (FACTS + 2) {
                for action in self.actions.iter().filter(|_| before[state as usize] < u64::MAX) {
                    if let Some(next) = self.apply(state, action) {
                        let through = before[state as usize] + u64::from(action.cost);
                        cost[next as usize] = cost[next as usize].min(through);
                    }
                }
            }
            if cost == before {
                break;
            }
        }
        (0..1_u32 << (FACTS + 2))
            .filter(|&s| all(&self.goal, s))
            .map(|s| cost[s as usize])
            .min()
            .filter(|&c| c < u64::MAX)
    }
}

pub(crate) fn all(signs: &[Sign], state: u32) -> bool {
    signs.iter().all(|&(f, holds)| (state >> f & 1 == 1) == holds)
}

proptest! {
    #[test]
    fn every_search_answers_as_brute_force_does(random in random_task()) {
        let grounded = Grounded::new(random.text());
        let task = &grounded.task;
        let optimum = random.optimum();
        for configuration in SearchConfiguration::ALL {
            let name = configuration.name;
            match solve(task, &Query::of(task), configuration, &Budget::default()).outcome {
                Outcome::Solved(plan) => {
                    let verdict = grounded.verdict(&plan.operators);
                    prop_assert!(verdict.is_valid(), "{name}: {verdict:?}");
                    let best = optimum.expect("brute force finds what the search finds");
                    prop_assert!(plan.cost >= best && (!configuration.optimal || plan.cost == best), "{name}");
                }
                Outcome::Unsolvable(_) => prop_assert_eq!(optimum, None, "{}", name),
                Outcome::LimitReached(Limit::Incomplete) if !configuration.complete => {}
                Outcome::Unsupported(feature) => prop_assert!(false, "{name}: {feature}"),
                Outcome::LimitReached(limit) => prop_assert!(false, "{name}: {limit:?}"),
            }
        }
    }

    #[test]
    fn estimates_keep_their_promises(random in random_task()) {
        let grounded = Grounded::new(random.text());
        prop_assume!(grounded.task.goal().impossible.is_none());
        let optimum = random.optimum();
        for &kind in HeuristicKind::ALL {
            let (estimate, _) = grounded.estimate(kind, grounded.task.initial_state());
            match optimum {
                Some(cost) => {
                    prop_assert!(estimate != Estimate::DEAD_END, "{kind:?} is not safe");
                    let below = u64::from(estimate.0) <= cost;
                    prop_assert!(below || !kind.properties().admissible, "{kind:?}: {estimate:?} of {cost}");
                }
                None => prop_assert!(kind.properties().safe),
            }
        }
    }

    #[test]
    fn repaired_plans_reach_the_goal(random in random_task(), surprises in prop::collection::vec(any::<prop::sample::Index>(), 0..4)) {
        let grounded = Grounded::new(random.text());
        let task = &grounded.task;
        let configuration = SearchConfiguration::default();
        let solved = |query: &Query<'_>| solve(task, query, &configuration, &Budget::default()).outcome;
        let Outcome::Solved(old) = solved(&Query::of(task)) else { return Ok(()) };
        // Other agents act, and the plan does not account for that.
        let (mut state, mut before) = (task.initial_state().clone(), Vec::new());
        for surprise in surprises {
            let applicable = task.applicable(&state);
            if !applicable.is_empty() {
                before.push(*surprise.get(&applicable));
                state = task.successor(&state, before[before.len() - 1]).unwrap();
            }
        }
        let query = Query { state: &state, ..Query::of(task) };
        for preference in [Preference::Fastest, Preference::Stability, Preference::Cost] {
            let repaired =
                repair(task, &query, &old.operators, &configuration, preference, &Budget::default());
            let both = [Some(&repaired.reused), repaired.fresh.as_ref()];
            let known: Vec<_> = both.into_iter().flatten().filter_map(|attempt| attempt.plan()).collect();
            match repaired.report().outcome {
                Outcome::Solved(plan) => {
                    let chosen = repaired.chosen().distance.unwrap();
                    for (known, distance) in &known {
                        let verdict = grounded.verdict(before.iter().chain(&known.operators));
                        prop_assert!(verdict.is_valid(), "{preference:?}: {verdict:?}");
                        let (kept, common) = (old.operators.len() - distance.removed, known.operators.len());
                        prop_assert_eq!(kept, common - distance.added);
                        prop_assert!(preference != Preference::Cost || known.cost >= plan.cost);
                        prop_assert!(preference != Preference::Stability || distance.steps() >= chosen.steps());
                    }
                    prop_assert!(known.iter().any(|(known, _)| **known == plan));
                }
                Outcome::Unsolvable(_) => prop_assert!(matches!(solved(&query), Outcome::Unsolvable(_))),
                other => prop_assert!(false, "{other:?}"),
            }
        }
    }
}
