//! Explanations of small tasks, and of random tasks compared with all their states.

use super::{Achiever, Explanation, Extent, Literal, Need, Never, Obstruction, Why, Wording, explain};
use crate::ids::OperatorId;
use crate::lifted_tests::{OBJECTS, PREDICATES, atom_name, bit, lifted_task};
use crate::random_numbers;
use crate::random_tests::{self, FACTS, random_task};
use crate::search::{Outcome, Query, SearchConfiguration, UnsolvableReason, solve};
use crate::task::{Impossible, State, Task};
use crate::test_support::Grounded;
use budget::Budget;
use pddl::model::ObjectId;
use proptest::prelude::*;
use std::collections::{BTreeMap, HashSet};

/// Grounds a model without mistakes.
fn model(domain: &str, problem: &str) -> Grounded {
    Grounded::new((domain.to_owned(), problem.to_owned()))
}

impl Grounded {
    fn outcome(&self) -> Outcome {
        solve(&self.task, &Query::of(&self.task), &SearchConfiguration::default(), &Budget::default()).outcome
    }

    /// The explanation of the problem, solvable or not.
    fn explained(&self) -> Explanation {
        self.explained_from(self.task.initial_state(), &[])
    }

    /// The same from another state without some operators.
    fn explained_from(&self, state: &State, excluded: &[OperatorId]) -> Explanation {
        let query = Query { state, goal: self.task.goal(), excluded };
        let outcome = solve(&self.task, &query, &SearchConfiguration::default(), &Budget::default()).outcome;
        let reason = match outcome {
            Outcome::Unsolvable(reason) => reason,
            _ => UnsolvableReason::SpaceExhausted,
        };
        explain(&self.domain, &self.problem, &self.task, &query, &reason, &Budget::default())
    }

    fn name(&self, wanted: &Literal) -> String {
        let name = self.task.pattern_name(&wanted.pattern);
        if wanted.positive { name } else { format!("(not {name})") }
    }

    /// The explanation, a line for each goal and achiever.
    fn lines(&self) -> Vec<String> {
        let explanation = self.explained();
        let number = |n: &super::NeverCompares| format!("{}: {} {:?}", n.comparison, n.measured, n.extent);
        let mut lines = Vec::new();
        for part in &explanation.parts {
            let never = part.never.iter().map(|never| match never {
                Never::Literal(id) => self.name(&explanation.reason(*id).wanted),
                Never::Number(own) => number(own),
                Never::Condition(_) => "condition".to_owned(),
            });
            lines.push(format!("never {}", never.collect::<Vec<_>>().join(" or ")));
        }
        for reason in &explanation.reasons {
            let wanted = self.name(&reason.wanted);
            match &reason.why {
                Why::NothingAchieves => lines.push(format!("nothing gives {wanted}")),
                Why::Unexplored => lines.push(wanted),
                Why::Achievers { achievers, more } => {
                    for achiever in achievers {
                        let by = achiever.action.map_or_else(
                            || "axiom".to_owned(),
                            |action| self.task.schema_name(action, &achiever.arguments),
                        );
                        let why = match &achiever.obstruction {
                            Obstruction::Needs(needs) => needs
                                .iter()
                                .map(|need| match need {
                                    Need::Literal(id) => self.name(&explanation.reason(*id).wanted),
                                    Need::Number(own) => number(own),
                                })
                                .collect::<Vec<_>>()
                                .join(" "),
                            Obstruction::NeverTogether(all) => {
                                let all: Vec<_> = all.iter().map(|w| self.name(w)).collect();
                                format!("never together {}", all.join(" "))
                            }
                            Obstruction::NeverApplies => "never".to_owned(),
                            Obstruction::Excluded => "excluded".to_owned(),
                        };
                        lines.push(format!("{wanted} by {by}: {why}"));
                    }
                    if *more > 0 {
                        lines.push(format!("{wanted}: {more} more"));
                    }
                }
            }
        }
        for pair in &explanation.exclusive {
            lines.push(format!("{} exclude each other: {}", pair.pair.join(" "), pair.group.join(" ")));
        }
        lines
    }
}

const HOUSE: &str = "(define (domain house) (:requirements :adl :derived-predicates)
    (:types room) (:predicates (at ?r - room) (open ?a ?b - room) (key ?r - room) (lit) (calm) (dark))
    (:derived (calm) (and (lit) (at hall)))
    (:constants hall - room)
    (:action go :parameters (?a ?b - room) :precondition (and (at ?a) (open ?a ?b))
      :effect (and (at ?b) (not (at ?a))))
    (:action unlock :parameters (?a ?b - room) :precondition (and (at ?a) (key ?b)) :effect (open ?a ?b)))";

fn house(init: &str, goal: &str) -> Vec<String> {
    let problem = format!(
        "(define (problem p) (:domain house) (:objects attic cellar - room) (:init (at hall) {init}) (:goal {goal}))"
    );
    model(HOUSE, &problem).lines()
}

#[test]
fn reasons_go_down_to_what_nothing_gives() {
    assert_eq!(
        house("", "(at attic)"),
        [
            "never (at attic)",
            "(at attic) by (go ?a attic): (open ?a attic)",
            "(open ?a attic) by (unlock ?a attic): (key attic)",
            "nothing gives (key attic)",
        ]
    );
    assert_eq!(house("", "(calm)"), ["never (calm)", "(calm) by axiom: (lit)", "nothing gives (lit)"]);
    assert_eq!(house("(key attic)", "(at attic)"), Vec::<String>::new());
}

#[test]
fn every_goal_is_told_and_shared_reasons_once() {
    assert_eq!(
        house("", "(and (at attic) (lit) (at hall) (open hall attic) (not (dark)))"),
        [
            "never (at attic)",
            "never (lit)",
            "never (open hall attic)",
            "(at attic) by (go ?a attic): (open ?a attic)",
            "nothing gives (lit)",
            "(open hall attic) by (unlock hall attic): (key attic)",
            "(open ?a attic) by (unlock ?a attic): (key attic)",
            "nothing gives (key attic)",
        ]
    );
    assert_eq!(
        house("", "(or (lit) (dark))"),
        ["never (lit) or (dark)", "nothing gives (lit)", "nothing gives (dark)"]
    );
    assert_eq!(house("(dark)", "(not (dark))"), ["never (not (dark))", "nothing gives (not (dark))"]);
    assert_eq!(
        house("", "(exists (?r - room) (key ?r))"),
        ["never (key ?r)", "nothing gives (key ?r)"],
        "variables stay open"
    );
}

#[test]
fn instances_that_static_conditions_leave_are_told_apart() {
    let domain = "(define (domain d) (:requirements :typing) (:types place)
        (:predicates (at ?p - place) (road ?a ?b - place))
        (:action go :parameters (?a ?b - place) :precondition (and (at ?a) (road ?a ?b))
          :effect (and (at ?b) (not (at ?a)))))";
    let problem = "(define (problem p) (:domain d) (:objects a b c - place)
        (:init (at a) (road b c) (road c b)) (:goal (at c)))";
    assert_eq!(
        model(domain, problem).lines(),
        ["never (at c)", "(at c) by (go b c): (at b)", "(at b) by (go c b): (at c)"]
    );
}

#[test]
fn a_ban_is_told_only_where_nothing_else_is_in_the_way() {
    let domain = "(define (domain lamps) (:requirements :adl) (:types lamp socket)
        (:predicates (on ?l - lamp) (charged ?s - socket) (broken ?s - socket) (mains))
        (:action cut :parameters () :effect (not (mains)))
        (:action charge :parameters (?s - socket) :precondition (mains) :effect (charged ?s))
        (:action drop :parameters (?s - socket) :precondition (mains) :effect (broken ?s))
        (:action light :parameters (?l - lamp ?s - socket)
          :precondition (and (charged ?s) (not (broken ?s))) :effect (on ?l)))";
    let problem = "(define (problem p) (:domain lamps) (:objects c - lamp s1 s2 - socket)
        (:init (mains)) (:goal (on c)))";
    let model = model(domain, problem);
    let task = &model.task;
    let barred = task.operators().ids().find(|&o| task.operator_name(o) == "(light c s2)").unwrap();
    let check = |seen: &[&str], expected: &[&str]| {
        let facts = task.facts().ids().filter(|&f| seen.contains(&task.fact_name(f).as_str()));
        let explanation = model.explained_from(&task.state(facts), &[barred]);
        assert_eq!(Wording::new(task, &explanation).chain(), expected);
    };
    check(
        &["(charged s1)", "(broken s1)"],
        &["(on c) by (light c s1) needs (not (broken s1))", "nothing takes (broken s1) away"],
    );
    check(
        &["(charged s1)", "(broken s1)", "(charged s2)"],
        &["(on c) by (light c s2), which may not be used"],
    );
}

#[test]
fn goals_of_one_group_exclude_each_other() {
    let lines = house("(open hall attic)", "(and (at attic) (at hall))");
    assert_eq!(lines, ["(at attic) (at hall) exclude each other: (at hall) (at attic)"]);
}

const TANK: &str = "(define (domain tank) (:requirements :typing :numeric-fluents)
    (:types car) (:predicates (there ?c - car))
    (:functions (fuel ?c - car) (capacity ?c - car) (load) (way))
    (:action fill :parameters (?c - car) :precondition (< (fuel ?c) (capacity ?c)) :effect (increase (fuel ?c) 1))
    (:action pack :parameters () :precondition (<= (+ (load) 2) 7) :effect (increase (load) 2))
    (:action walk :parameters () :effect (increase (way) 1))
    (:action drive :parameters (?c - car) :precondition (>= (fuel ?c) 10)
      :effect (and (there ?c) (decrease (fuel ?c) 10))))";

fn tank(goal: &str) -> Vec<String> {
    let problem = format!(
        "(define (problem p) (:domain tank) (:objects a b - car)
        (:init (= (fuel a) 0) (= (capacity a) 7) (= (fuel b) 0) (= (capacity b) 12) (= (load) 0) (= (way) 0))
        (:goal {goal}))"
    );
    model(TANK, &problem).lines()
}

#[test]
fn numbers_have_bounds() {
    let fuel = |car: &str| format!("(>= (fuel {car}) 10): (fuel {car}) {:?}", Extent::Below(8.into_number()));
    assert_eq!(
        tank("(and (there a) (there b))"),
        ["never (there a)".to_owned(), format!("(there a) by (drive a): {}", fuel("a"))]
    );
    assert_eq!(tank("(>= (fuel a) 10)"), [format!("never {}", fuel("a"))]);
    let load = format!("never (> (load) 7): (load) {:?}", Extent::AtMost(7.into_number()));
    assert_eq!(tank("(> (load) 7)"), [load]);
    let way = format!("never (< (way) 0): (way) {:?}", Extent::AtLeast(0.into_number()));
    assert_eq!(tank("(< (way) 0)"), [way]);
}

trait IntoNumber {
    fn into_number(self) -> crate::Number;
}

impl IntoNumber for i64 {
    fn into_number(self) -> crate::Number {
        crate::Number::integer(self)
    }
}

#[test]
fn an_exhausted_space_tells_how_near_it_came() {
    let domain = "(define (domain d) (:predicates (a) (b) (c))
        (:action left :parameters () :precondition (c) :effect (and (a) (not (c))))
        (:action right :parameters () :precondition (c) :effect (and (b) (not (c)))))";
    let model = model(domain, "(define (problem p) (:domain d) (:init (c)) (:goal (and (a) (b))))");
    let explanation = model.explained();
    if let Some(space) = &explanation.space {
        assert!(space.complete);
        assert_eq!((space.states, space.nearest.steps.len(), space.nearest.missing.len()), (3, 1, 1));
        assert_eq!(space.apart.len(), 1);
    } else {
        assert!(!explanation.exclusive.is_empty(), "a group says it before the search does");
    }
}

/// All bindings of a list of patterns' variables over the objects.
fn bindings(all: &[Literal]) -> Vec<BTreeMap<String, u32>> {
    let mut found = vec![BTreeMap::new()];
    for name in all.iter().flat_map(|w| &w.pattern.arguments).filter_map(|a| a.as_ref().err()) {
        if found[0].contains_key(name.as_str()) {
            continue;
        }
        let more = |binding: &BTreeMap<String, u32>| {
            let with = |o| {
                let mut binding = binding.clone();
                binding.insert(name.as_str().to_owned(), o);
                binding
            };
            (0..u32::try_from(OBJECTS).unwrap()).map(with).collect::<Vec<_>>()
        };
        found = found.iter().flat_map(more).collect();
    }
    found
}

/// All states that are reachable without some operators.
fn reachable_without(task: &Task, first: &State, excluded: &[OperatorId]) -> Vec<State> {
    let mut known = HashSet::from([first.clone()]);
    let mut states = vec![first.clone()];
    let mut next = 0;
    while let Some(here) = states.get(next).cloned() {
        let allowed = task.applicable(&here).into_iter().filter(|o| !excluded.contains(o));
        let after = allowed.filter_map(|operator| task.successor(&here, operator));
        states.extend(after.filter(|after| known.insert(after.clone())));
        next += 1;
    }
    states
}

/// The achievers that are reported as excluded although they are not, or although they would apply
/// in no state.
fn not_barred(
    explanation: &Explanation,
    task: &Task,
    excluded: &[OperatorId],
    states: &[State],
) -> Vec<String> {
    if states.len() > super::bans::STATES as usize {
        return Vec::new();
    }
    let achievers = explanation.reasons.iter().filter_map(|reason| match &reason.why {
        Why::Achievers { achievers, .. } => Some(achievers),
        _ => None,
    });
    let bars = |achiever: &Achiever, o: OperatorId| {
        let arguments: Result<Vec<ObjectId>, _> = achiever.arguments.iter().cloned().collect();
        let operator = task.operator(o);
        achiever.action == Some(operator.action)
            && arguments.is_ok_and(|arguments| arguments == operator.arguments)
            && states.iter().any(|state| task.applicable(state).contains(&o))
    };
    achievers
        .flatten()
        .filter(|achiever| {
            achiever.obstruction == Obstruction::Excluded && !excluded.iter().any(|&o| bars(achiever, o))
        })
        .map(|achiever| format!("{achiever:?}"))
        .collect()
}

proptest! {
    #[test]
    fn what_is_said_of_lifted_tasks_is_so(lifted in lifted_task()) {
        let (domain, problem) = lifted.text();
        let model = model(&domain, &problem);
        let explanation = model.explained();
        let states = lifted.reachable();
        let holds = |state: u32, wanted: &Literal, binding: &BTreeMap<String, u32>| {
            let arguments = wanted.pattern.arguments.iter().map(|a| match a {
                Ok(object) => object.0 as usize,
                Err(name) => binding[name.as_str()] as usize,
            });
            let name = model.domain.predicates[wanted.pattern.predicate].name.as_str();
            let predicate = PREDICATES.iter().position(|(own, _)| *own == name).unwrap();
            let arguments: Vec<usize> = arguments.collect();
            (state & bit(predicate, &arguments) != 0) == wanted.positive
        };
        let ever = |wanted: &Literal, binding: &BTreeMap<String, u32>| states.iter().any(|&s| holds(s, wanted, binding));
        for reason in &explanation.reasons {
            for binding in bindings(std::slice::from_ref(&reason.wanted)) {
                prop_assert!(!ever(&reason.wanted, &binding), "{} {:?}", model.name(&reason.wanted), binding);
            }
            let Why::Achievers { achievers, .. } = &reason.why else { continue };
            for achiever in achievers {
                if let Obstruction::NeverTogether(all) = &achiever.obstruction {
                    for binding in bindings(all) {
                        prop_assert!(!all.iter().all(|wanted| ever(wanted, &binding)), "{reason:?}");
                    }
                }
            }
        }
        let goal = |state: u32| lifted.goal.iter().filter(|&&(b, holds)| (state >> b & 1 == 1) != holds).count();
        let nearest = states.iter().map(|&s| goal(s)).min().unwrap();
        if nearest == 0 {
            prop_assert!(explanation.parts.is_empty() && explanation.exclusive.is_empty());
        }
        let fact_bit = |fact: crate::FactId| {
            let name = model.task.fact_name(fact);
            (0..32).find(|&b| b < 16 && atom_name(b) == name).unwrap()
        };
        for pair in &explanation.exclusive {
            let number = |name: &String| (0..16_u32).find(|&b| atom_name(b) == *name).unwrap();
            let group: Vec<u32> = pair.group.iter().map(number).collect();
            prop_assert!(pair.pair.iter().all(|name| pair.group.contains(name)));
            prop_assert!(states.iter().all(|s| group.iter().filter(|&&b| s >> b & 1 == 1).count() <= 1));
        }
        if let Some(space) = &explanation.space {
            prop_assert!(space.complete);
            let held = |s: u32, (f, wanted): (crate::FactId, bool)| (s >> fact_bit(f) & 1 == 1) == wanted;
            for &literal in &space.never {
                prop_assert!(!states.iter().any(|&s| held(s, literal)));
            }
            for &[a, b] in &space.apart {
                prop_assert!(!states.iter().any(|&s| held(s, a) && held(s, b)));
            }
            let missing = |s: u32| {
                let goals = &model.task.goal().literals;
                let positive = goals.positive.iter().filter(|&&f| !held(s, (f, true))).count();
                positive + goals.negative.iter().filter(|&&f| !held(s, (f, false))).count()
            };
            if model.task.goal().impossible.is_none() {
                prop_assert_eq!(space.nearest.missing.len(), states.iter().map(|&s| missing(s)).min().unwrap());
            }
        }
        // Two atoms that grounding reports as exclusive share a group.
        if let Outcome::Unsolvable(UnsolvableReason::Impossible(Impossible::Exclusive(_))) = model.outcome() {
            prop_assert!(!explanation.exclusive.is_empty());
            prop_assert!(nearest > 0);
        }
        // An atom that grounding reports as unreachable is among the parts.
        if let Outcome::Unsolvable(UnsolvableReason::Impossible(Impossible::Atoms(_) | Impossible::NegatedAtoms(_))) = model.outcome() {
            prop_assert!(!explanation.parts.is_empty());
        }
    }

    #[test]
    fn what_is_said_with_axioms_and_disjunctions_is_so(random in random_task()) {
        let model = Grounded::new(random.text());
        let explanation = model.explained();
        let states = random.reachable();
        if states.iter().any(|&s| random_tests::all(&random.goal, s)) {
            prop_assert!(explanation.parts.is_empty() && explanation.exclusive.is_empty());
        }
        for reason in &explanation.reasons {
            let name = model.domain.predicates[reason.wanted.pattern.predicate].name.as_str().to_owned();
            let number: usize = name[1..].parse().unwrap();
            let fact = if name.starts_with('p') { number } else { FACTS + number };
            prop_assert!(!states.iter().any(|s| (s >> fact & 1 == 1) == reason.wanted.positive), "{reason:?}");
        }
    }

    #[test]
    fn what_is_said_of_another_start_without_some_operators_is_so(
        random in random_task(), steps in prop::collection::vec(0..100_usize, 0..4),
        excluded in prop::collection::vec(any::<prop::sample::Index>(), 0..4),
    ) {
        let model = Grounded::new(random.text());
        let task = &model.task;
        let mut state = task.initial_state().clone();
        for step in steps {
            let applicable = task.applicable(&state);
            let Some(&operator) = applicable.get(step % applicable.len().max(1)) else { break };
            state = task.successor(&state, operator).unwrap();
        }
        let all: Vec<OperatorId> = task.operators().ids().collect();
        let excluded: Vec<OperatorId> =
            if all.is_empty() { Vec::new() } else { excluded.iter().map(|index| *index.get(&all)).collect() };
        let query = Query { state: &state, goal: task.goal(), excluded: &excluded };
        let reason = UnsolvableReason::SpaceExhausted;
        let explanation = explain(&model.domain, &model.problem, task, &query, &reason, &Budget::default());
        let states = reachable_without(task, &state, &excluded);
        if states.iter().any(|s| task.satisfies(s, task.goal())) {
            prop_assert!(explanation.parts.is_empty() && explanation.exclusive.is_empty());
        }
        let space = explanation.space.as_ref().unwrap();
        prop_assert_eq!(space.states as usize, states.len());
        let is_so = |wanted: &Literal, state: &State| {
            let arguments: Vec<_> = wanted.pattern.arguments.iter().map(|a| a.clone().unwrap()).collect();
            task.fact(wanted.pattern.predicate, &arguments).is_some_and(|f| state.contains(f) == wanted.positive)
        };
        for reason in &explanation.reasons {
            prop_assert!(!states.iter().any(|state| is_so(&reason.wanted, state)), "{reason:?}");
        }
        prop_assert_eq!(not_barred(&explanation, task, &excluded, &states), Vec::<String>::new());
    }

    #[test]
    fn numbers_that_are_said_not_to_be_reached_are_not(random in random_numbers::random_task()) {
        let model = Grounded::new(random.text());
        let reason = UnsolvableReason::Impossible(Impossible::Formula);
        let query = Query::of(&model.task);
        let explanation =
            explain(&model.domain, &model.problem, &model.task, &query, &reason, &Budget::default());
        let (shortest, _) = random.shortest();
        prop_assert!(shortest.is_none() || explanation.parts.is_empty(), "{:?}", explanation.parts);
    }
}

proptest! {
    // In few random tasks, a ban is the only obstacle.
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn only_what_would_apply_is_said_to_be_excluded(
        lifted in lifted_task(), barred in prop::collection::vec(prop::bool::weighted(0.2), 1..16),
    ) {
        let model = Grounded::new(lifted.text());
        let task = &model.task;
        // Excludes the operators that give a part of the goal, and some others.
        let goal = &task.goal().literals;
        let gives = |o: OperatorId| {
            let operator = task.operator(o);
            goal.positive.iter().any(|f| operator.adds.contains(f))
                || goal.negative.iter().any(|f| operator.deletes.contains(f))
        };
        let ids = task.operators().ids().zip(barred.iter().cycle());
        let excluded: Vec<OperatorId> = ids.filter(|&(o, barred)| *barred || gives(o)).map(|(o, _)| o).collect();
        let query = Query { excluded: &excluded, ..Query::of(task) };
        let reason = UnsolvableReason::Impossible(Impossible::Formula);
        let explanation = explain(&model.domain, &model.problem, task, &query, &reason, &Budget::default());
        let states = reachable_without(task, task.initial_state(), &excluded);
        prop_assert_eq!(not_barred(&explanation, task, &excluded, &states), Vec::<String>::new());
    }
}
