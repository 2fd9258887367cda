//! Random small lifted tasks: compares grounding with an enumeration of all states.
//!
//! Actions have two parameters, which may be the same object, and add and delete atoms of four
//! predicates over three objects. An interpreter on bit masks that shares no code with grounding
//! visits every reachable state. The grounded task must reach the same states (so nothing was
//! pruned wrongly), and each state must satisfy every mutex group.

use crate::test_support::Grounded;
use crate::{AtomStatus, FactId, Task};
use pddl::model::ObjectId;
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::fmt::Write;

pub(crate) const OBJECTS: usize = 3;
/// Name and arity.
pub(crate) const PREDICATES: [(&str, usize); 4] = [("on", 2), ("free", 1), ("held", 1), ("idle", 0)];

/// A predicate over parameters 0 and 1, and whether it must hold or is made true.
type Literal = (usize, [usize; 2], bool);

#[derive(Clone, Debug)]
struct LiftedAction {
    needs: Vec<Literal>,
    differ: bool,
    effects: Vec<Literal>,
    /// A condition and an effect of it.
    when: Option<(Literal, Literal)>,
    /// Whether its first effect holds for all objects in place of the first parameter.
    for_all: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct LiftedTask {
    actions: Vec<LiftedAction>,
    initial: u32,
    pub(crate) goal: Vec<(u32, bool)>,
}

fn literal() -> impl Strategy<Value = Literal> {
    (0..PREDICATES.len(), [0..2_usize, 0..2], prop::bool::weighted(0.7))
}

pub(crate) fn lifted_task() -> impl Strategy<Value = LiftedTask> {
    let action = (
        prop::collection::vec(literal(), 1..4),
        any::<bool>(),
        prop::collection::vec(literal(), 0..3),
        0..8_usize,
        prop::option::weighted(0.2, (literal(), literal())),
        prop::bool::weighted(0.1),
    )
        .prop_map(|(needs, differ, mut effects, moved, when, for_all)| {
            // Most actions delete some of their preconditions, as real ones do.
            let taken = needs.iter().enumerate().filter(|(i, n)| n.2 && moved >> i & 1 == 1);
            let taken: Vec<Literal> = taken.map(|(_, &(p, a, _))| (p, a, false)).collect();
            effects.extend(taken);
            LiftedAction { needs, differ, effects, when, for_all }
        });
    let atoms = 1_u32 << atoms();
    (
        prop::collection::vec(action, 1..5),
        0..atoms,
        0..atoms,
        prop::collection::vec((0..u32::try_from(self::atoms()).unwrap(), any::<bool>()), 1..4),
    )
        .prop_map(|(actions, a, b, goal)| LiftedTask { actions, initial: a & b, goal })
}

/// The number of atoms.
fn atoms() -> usize {
    PREDICATES.iter().map(|(_, arity)| OBJECTS.pow(u32::try_from(*arity).unwrap())).sum()
}

pub(crate) fn bit(predicate: usize, arguments: &[usize]) -> u32 {
    let before: usize =
        PREDICATES[..predicate].iter().map(|(_, a)| OBJECTS.pow(u32::try_from(*a).unwrap())).sum();
    1 << (before + arguments[..PREDICATES[predicate].1].iter().fold(0, |n, &o| n * OBJECTS + o))
}

pub(crate) fn atom_name(bit: u32) -> String {
    let mut rest = bit as usize;
    for (name, arity) in PREDICATES {
        let own = OBJECTS.pow(u32::try_from(arity).unwrap());
        if rest < own {
            return match arity {
                0 => format!("({name})"),
                1 => format!("({name} o{rest})"),
                _ => format!("({name} o{} o{})", rest / OBJECTS, rest % OBJECTS),
            };
        }
        rest -= own;
    }
    unreachable!("no such atom")
}

impl LiftedTask {
    pub(crate) fn text(&self) -> (String, String) {
        let atom = |&(p, a, holds): &Literal, first: &str| {
            let names = [first, "?y"];
            let arguments = a[..PREDICATES[p].1].iter().fold(String::new(), |s, &i| s + " " + names[i]);
            let atom = format!("({}{arguments})", PREDICATES[p].0);
            if holds { atom } else { format!("(not {atom})") }
        };
        let mut domain = String::from("(define (domain r) (:requirements :adl) (:predicates");
        for (name, arity) in PREDICATES {
            write!(domain, " ({name}{})", &" ?a ?b"[..arity * 3]).unwrap();
        }
        domain.push_str(")\n");
        for (i, a) in self.actions.iter().enumerate() {
            let needs: String = a.needs.iter().map(|l| atom(l, "?x")).collect();
            let differ = if a.differ { "(not (= ?x ?y))" } else { "" };
            let effects = a.effects.iter().enumerate().map(|(i, l)| match a.for_all && i == 0 {
                true => format!("(forall (?z) {})", atom(l, "?z")),
                false => atom(l, "?x"),
            });
            let effects: String = effects.collect();
            let when = a.when.as_ref().map(|(c, e)| format!("(when {} {})", atom(c, "?x"), atom(e, "?x")));
            let when = when.unwrap_or_default();
            writeln!(
                domain,
                "(:action a{i} :parameters (?x ?y) :precondition (and {needs}{differ}) :effect (and {effects}{when}))"
            )
            .unwrap();
        }
        domain.push(')');
        let all = 0..u32::try_from(atoms()).unwrap();
        let initial: String = all.filter(|b| self.initial >> b & 1 == 1).map(atom_name).collect();
        let goal = self.goal.iter().map(|&(b, holds)| match holds {
            true => atom_name(b),
            false => format!("(not {})", atom_name(b)),
        });
        let goal: String = goal.collect();
        let problem = format!(
            "(define (problem q) (:domain r) (:objects o0 o1 o2) (:init {initial}) (:goal (and {goal})))"
        );
        (domain, problem)
    }

    /// All reachable states.
    pub(crate) fn reachable(&self) -> BTreeSet<u32> {
        let mut found = BTreeSet::from([self.initial]);
        let mut queue = vec![self.initial];
        while let Some(state) = queue.pop() {
            for action in &self.actions {
                for binding in (0..OBJECTS * OBJECTS).map(|i| [i / OBJECTS, i % OBJECTS]) {
                    if let Some(next) = action.apply(state, binding)
                        && found.insert(next)
                    {
                        queue.push(next);
                    }
                }
            }
        }
        found
    }
}

impl LiftedAction {
    fn apply(&self, state: u32, [x, y]: [usize; 2]) -> Option<u32> {
        let atom = |&(p, a, _): &Literal, x: usize| bit(p, &a.map(|i| [x, y][i]));
        let holds = |l: &Literal| (state & atom(l, x) != 0) == l.2;
        if (self.differ && x == y) || !self.needs.iter().all(holds) {
            return None;
        }
        let (mut adds, mut deletes) = (0, 0);
        let mut change = |l: &Literal, x: usize| *(if l.2 { &mut adds } else { &mut deletes }) |= atom(l, x);
        for (i, effect) in self.effects.iter().enumerate() {
            match self.for_all && i == 0 {
                true => (0..OBJECTS).for_each(|z| change(effect, z)),
                false => change(effect, x),
            }
        }
        if let Some((_, effect)) = self.when.as_ref().filter(|(c, _)| holds(c)) {
            change(effect, x);
        }
        Some(state & !deletes | adds)
    }
}

/// The fact of each bit, if it is one.
fn facts(task: &Task, domain: &pddl::model::Domain) -> Vec<Option<FactId>> {
    let mut found = Vec::new();
    for (name, arity) in PREDICATES {
        let predicate = domain.predicate(&pddl::model::Name::new(name)).unwrap();
        for i in 0..u32::try_from(OBJECTS.pow(u32::try_from(arity).unwrap())).unwrap() {
            let arguments = [ObjectId(i / 3), ObjectId(i % 3)];
            found.push(match task.status(predicate, &arguments[2 - arity..]) {
                AtomStatus::Fact(fact) => Some(fact),
                _ => None,
            });
        }
    }
    found
}

proptest! {
    #[test]
    fn reachable_states_keep_all_groups_and_none_is_lost(lifted in lifted_task()) {
        let Grounded { task, domain, .. } = Grounded::new(lifted.text());
        let facts = facts(&task, &domain);
        let known = |state: &u32| {
            let held = facts.iter().enumerate().filter(|(b, _)| state >> b & 1 == 1);
            task.state(held.filter_map(|(_, f)| *f))
        };
        let expected: BTreeSet<Vec<FactId>> = lifted.reachable().iter().map(|s| known(s).facts()).collect();
        let mut found = BTreeSet::from([task.initial_state().facts()]);
        let mut queue = vec![task.initial_state().clone()];
        while let Some(state) = queue.pop() {
            prop_assert!(task.mutexes().hold_in(&state), "{:?} in {:?}", task.mutexes(), state.facts());
            for variable in task.variables() {
                let held = variable.facts.iter().filter(|&&f| state.contains(f)).count();
                prop_assert!(held == 1 || (held == 0 && !variable.complete), "{variable:?}");
            }
            for operator in task.applicable(&state) {
                let next = task.successor(&state, operator).unwrap();
                if found.insert(next.facts()) {
                    queue.push(next);
                }
            }
        }
        prop_assert_eq!(found, expected);
        let mut values: Vec<FactId> = task.variables().iter().flat_map(|v| v.facts.iter().copied()).collect();
        values.sort_unstable();
        prop_assert_eq!(values, task.facts().ids().collect::<Vec<_>>());
    }
}
