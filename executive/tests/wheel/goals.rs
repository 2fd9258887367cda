//! Goals with a life: wanted, displaced, held, dropped, given up, maintained.

use crate::bench::{Bench, domain, later};
use dsr::{Edit, Graph, Time};
use executive::{
    Arrivals, Effect, Ending, Event, GoalText, Importance, Model, Narration, Policy, Step, Wheel,
};
use high_to_low::Methods;
use low_to_high::{Fact, Perception};
use pddl::model::{Domain, Name};
use pddl::{Source, parse_problem};
use std::sync::Arc;
use std::time::Duration;
use vocabulary::Tokens;

const LAB: &str = "(define (domain lab)
  (:requirements :typing :vocabulary)
  (:types agent resource symbol - object place state - symbol)
  (:constants pelea mover - agent robot - symbol wanted reached closed low guest away paused - state)
  (:predicates (is ?p - place ?s - state) (sees ?p - place ?s - state))
  (:writes pelea (is _ wanted))
  (:writes mover place (is _ reached) (is _ wanted) (is _ closed) sees))";

const PLACES: &str = "(define (domain places)
  (:requirements :strips :typing :negative-preconditions)
  (:types place)
  (:predicates (at ?p - place) (seen ?p - place) (shut ?p - place))
  (:action go :parameters (?from ?to - place)
    :precondition (and (at ?from) (not (shut ?to)))
    :effect (and (not (at ?from)) (at ?to) (seen ?to))))";

const SEEN: &str = "(define (domain seen)
  (:requirements :typing :derived-predicates)
  (:import lab places)
  (:derived (at ?p - place) (is ?p reached))
  (:derived (shut ?p - place) (is ?p closed))
  (:derived (seen ?p - place) (sees ?p guest))
  (:derived (low) (sees dock low))
  (:derived (someone) (sees door guest))
  (:derived (nobody) (sees door away))
  (:derived (waits) (sees hall paused)))";

const METHODS: &str = "(define (domain places-methods)
  (:requirements :typing :durative-actions :hierarchy)
  (:import lab)
  (:durative-action walk
    :parameters (?p - place)
    :duration (<= ?duration 50)
    :effect (and (at start (is ?p wanted)) (at end (is ?p reached))))
  (:task go :parameters (?from ?to - place))
  (:method by-walking :parameters (?from ?to - place) :task (go ?from ?to) :ordered-subtasks (walk ?to))
  (:task give-up :parameters (?p - place))
  (:method by-doing-nothing :parameters (?p - place) :task (give-up ?p) :ordered-subtasks ()))";

const ROOMS: &str = "(define (problem rooms) (:domain lab) (:objects hall desk door dock - place)
  (:init (is hall reached)) (:goal (and)))";

fn fact(name: &str) -> Option<Fact> {
    Some(Fact { predicate: Name::new(name), arguments: Vec::new() })
}

/// The goal `name` with a condition over the places.
fn goal(places: &Domain, name: &str, condition: &str, priority: i64) -> GoalText {
    let text = format!(
        "(define (problem p) (:domain places) (:requirements :adl) (:objects hall desk door dock - place)
         (:init) (:goal {condition}))"
    );
    let problem = parse_problem(&Source::new("goal", text), places).model.unwrap();
    let importance = Importance::Hard(priority);
    GoalText { importance, ..GoalText::hard(Name::new(name), problem.goal.clone(), problem.goal_variables) }
}

/// A robot that goes from place to place.
fn rooms(goals: impl FnOnce(&Domain) -> Vec<GoalText>) -> (Graph, Wheel) {
    let lab = domain("vocabulary", LAB, &[]);
    let places = domain("domain", PLACES, &[]);
    // What goals wait for is a predicate of the planner to the perception, as if it were imported.
    let seen = SEEN.replace("(:derived (at", "(:predicates (low) (someone) (nobody) (waits)) (:derived (at");
    let mut seen = domain("perception", &seen, &[&with_nodes(&lab), &places]);
    for id in seen.predicates.ids().collect::<Vec<_>>() {
        seen.predicates[id].span = pddl::Span::default();
    }
    let methods = domain("methods", METHODS, &[&lab]);
    let world = parse_problem(&Source::new("world", ROOMS), &lab).model.unwrap();
    let problem = "(define (problem p) (:domain places) (:objects hall desk door dock - place)
                   (:init) (:goal (seen desk)))";
    let problem = parse_problem(&Source::new("problem", problem), &places).model.unwrap();

    let tokens = Tokens::new(&lab).unwrap();
    let graph = tokens.populate(&[&world], Time(0)).unwrap();
    let perceived = ["at", "seen", "shut"].map(Name::new);
    let goals = goals(&places);
    let model = Arc::new(Model::with_goals(places, problem, &perceived, goals).unwrap());
    let perception = Arc::new(Perception::new(&seen, &tokens).unwrap());
    let methods = Arc::new(Methods::new(&methods, &tokens).unwrap());
    let fallback = Step { action: Name::new("give-up"), arguments: vec![Name::new("hall")] };
    (graph, Wheel::new(model, perception, methods, Policy::new(fallback)))
}

/// The places as constants, for axioms that name them.
fn with_nodes(lab: &Domain) -> Domain {
    let world = parse_problem(&Source::new("world", ROOMS), lab).model.unwrap();
    Domain { constants: world.objects, ..lab.clone() }
}

struct Walk(Bench);

impl Walk {
    fn new(goals: impl FnOnce(&Domain) -> Vec<GoalText>) -> Self {
        let (graph, wheel) = rooms(goals);
        Self(Bench::begin(graph, wheel, true))
    }

    fn label(&self, name: &str) -> dsr::LabelId {
        self.0.graph.vocabulary().label(name).unwrap()
    }

    /// The robot arrives, and sees what is there.
    fn arrive(&mut self, from: &str, to: &str) {
        let (is, sees) = (self.label("is"), self.label("sees"));
        let edge = |label, from: &str, to: &str| (from.into(), label, to.into());
        let add = |(from, label, to)| Edit::AddEdge { from, label, to };
        let remove = |(from, label, to)| Edit::RemoveEdge { from, label, to };
        self.0.edits(
            "mover",
            vec![
                remove(edge(is, from, "reached")),
                add(edge(is, to, "reached")),
                add(edge(sees, to, "guest")),
            ],
        );
    }

    fn see(&mut self, place: &str, what: &str) {
        let sees = self.label("sees");
        self.0.edit("mover", Edit::AddEdge { from: place.into(), label: sees, to: what.into() });
    }

    fn no_longer(&mut self, place: &str, what: &str) {
        let sees = self.label("sees");
        self.0.edit("mover", Edit::RemoveEdge { from: place.into(), label: sees, to: what.into() });
    }

    fn saw(&self, place: &str) -> bool {
        let sentences = self.0.graph.snapshot().sentences();
        sentences.iter().any(|sentence| sentence.starts_with(place) && sentence.ends_with("sees guest"))
    }

    fn wants(&self, place: &str) -> bool {
        self.0.wants(place)
    }

    /// The changes of the goals, as `goal stage`.
    fn lives(&self) -> Vec<String> {
        let told = self.0.told.iter();
        told.filter_map(|n| match n {
            Narration::Goal(change) => Some(format!("{} {}", change.goal, change.life)),
            _ => None,
        })
        .collect()
    }

    /// Why a goal passed into its last stage.
    fn why(&self, goal: &str) -> String {
        let told = self.0.told.iter().rev();
        let change = told.filter_map(|n| match n {
            Narration::Goal(change) if &*change.goal == goal => Some(change.why.to_string()),
            _ => None,
        });
        change.into_iter().next().unwrap_or_default()
    }
}

fn errand_and_visit(places: &Domain, urgent: bool) -> Vec<GoalText> {
    let visit = goal(places, "visit", "(seen desk)", 5);
    vec![
        goal(places, "round", "(and (seen door) (seen dock))", 1),
        GoalText { when: fact("someone"), urgent, ..visit },
    ]
}

#[test]
fn a_goal_of_higher_priority_goes_first_when_the_step_has_ended() {
    let mut walk = Walk::new(|places| {
        let visit = goal(places, "visit", "(seen desk)", 5);
        let round = goal(places, "round", "(and (seen dock) (seen door))", 1);
        vec![round, GoalText { when: fact("low"), ..visit }]
    });
    let first = if walk.wants("dock") { "dock" } else { "door" };
    walk.see("dock", "low");
    assert!(walk.wants(first) && !walk.wants("desk"), "the step under way goes on");
    walk.arrive("hall", first);
    assert!(walk.wants("desk"), "{:?}", walk.lives());
    assert_eq!(
        walk.lives(),
        ["round wanted", "round pursued", "visit wanted", "visit pursued", "round suspended"]
    );
    assert_eq!(walk.why("round"), "visit goes first");
    walk.arrive(first, "desk");
    let other = if first == "dock" { "door" } else { "dock" };
    assert!(walk.wants(other), "what was achieved stays achieved: {}", walk.0.story());
    walk.arrive("desk", other);
    assert_eq!(walk.0.ending, Some(Ending::Accomplished));
    assert_eq!(walk.lives()[5..], ["visit achieved", "round pursued", "round achieved"]);
}

#[test]
fn an_urgent_goal_interrupts_the_step() {
    let mut walk = Walk::new(|places| errand_and_visit(places, true));
    let first = if walk.wants("dock") { "dock" } else { "door" };
    assert!(walk.wants(first));
    walk.see("door", "guest");
    assert!(walk.wants("desk") && !walk.wants(first), "the intention is taken back: {:?}", walk.lives());
}

#[test]
fn a_goal_that_is_dropped_is_no_longer_pursued() {
    let mut walk = Walk::new(|places| {
        let round = goal(places, "round", "(seen dock)", 1);
        vec![GoalText { drop: fact("nobody"), ..round }]
    });
    assert!(walk.wants("dock"));
    walk.see("door", "away");
    assert!(!walk.wants("dock"), "what was intended is taken back");
    assert_eq!(walk.lives(), ["round wanted", "round pursued", "round dropped"]);
    assert_eq!(walk.why("round"), "door sees away");
    assert_eq!(walk.0.ending, Some(Ending::Accomplished));
}

#[test]
fn a_goal_that_is_held_waits_and_goes_on_from_what_is_sensed() {
    let mut walk = Walk::new(|places| {
        let round = goal(places, "round", "(and (seen dock) (seen door))", 1);
        vec![GoalText { hold: fact("waits"), ..round }]
    });
    walk.see("hall", "paused");
    assert!(!walk.wants("dock") && !walk.wants("door"));
    assert_eq!(walk.0.ending, None, "it is not over");
    walk.arrive("hall", "dock");
    walk.no_longer("hall", "paused");
    assert!(walk.wants("door") && !walk.wants("dock"), "{:?}", walk.lives());
    walk.arrive("dock", "door");
    assert_eq!(walk.0.ending, Some(Ending::Accomplished));
}

#[test]
fn goals_that_exclude_each_other_are_achieved_one_after_the_other() {
    let mut walk =
        Walk::new(|places| vec![goal(places, "low", "(at dock)", 1), goal(places, "high", "(at door)", 2)]);
    assert!(walk.wants("door") && !walk.wants("dock"));
    let postponed = walk.lives().iter().filter(|life| *life == "low wanted").count();
    assert_eq!(postponed, 2, "wanted by the mission, then without a plan: {:?}", walk.lives());
    walk.arrive("hall", "door");
    assert!(walk.wants("dock"), "{:?}", walk.lives());
    walk.arrive("door", "dock");
    assert_eq!(walk.0.ending, Some(Ending::Accomplished));
}

#[test]
fn a_goal_may_be_any_formula() {
    let mut walk = Walk::new(|places| {
        vec![
            goal(places, "one", "(or (seen dock) (seen door))", 2),
            goal(places, "all", "(forall (?p - place) (or (seen ?p) (shut ?p)))", 1),
        ]
    });
    let first = if walk.wants("dock") { "dock" } else { "door" };
    walk.arrive("hall", first);
    assert_eq!(walk.lives()[4..], ["one achieved", "all pursued"], "{:?}", walk.lives());
    let mut at = first;
    for _ in 0..3 {
        let next = ["hall", "desk", "door", "dock"].into_iter().find(|p| *p != at && walk.wants(p)).unwrap();
        walk.arrive(at, next);
        at = next;
    }
    assert_eq!(walk.0.ending, Some(Ending::Accomplished), "{}", walk.0.story());
}

#[test]
fn a_goal_without_a_plan_waits_until_the_world_is_another() {
    let mut walk = Walk::new(|places| {
        vec![goal(places, "high", "(seen desk)", 2), goal(places, "low", "(and (seen dock) (seen door))", 1)]
    });
    let is = walk.label("is");
    let shut = Edit::AddEdge { from: "desk".into(), label: is, to: "closed".into() };
    walk.0.edit("mover", shut);
    let first = if walk.wants("dock") { "dock" } else { "door" };
    assert!(walk.wants(first), "what can be done is done: {:?}", walk.lives());
    assert!(walk.why("high").contains("(seen desk)"), "{}", walk.why("high"));
    let open = Edit::RemoveEdge { from: "desk".into(), label: is, to: "closed".into() };
    walk.0.edit("mover", open);
    walk.arrive("hall", first);
    assert!(walk.wants("desk"), "{}", walk.0.story());
}

#[test]
fn a_goal_whose_time_is_over_is_given_up_and_the_ending_names_it() {
    let mut walk = Walk::new(|places| {
        let late = goal(places, "late", "(seen dock)", 2);
        let round = goal(places, "round", "(seen door)", 1);
        vec![GoalText { deadline: Some(Duration::from_secs(20)), ..late }, round]
    });
    assert!(walk.wants("dock"));
    walk.0.pass(21.0);
    assert!(walk.wants("door") && !walk.wants("dock"), "{}", walk.0.story());
    walk.arrive("hall", "door");
    assert_eq!(walk.0.ending, Some(Ending::GivenUp { goals: vec![Name::new("late")] }));
}

#[test]
fn a_maintained_goal_is_wanted_whenever_it_does_not_hold_and_ends_no_mission() {
    let mut walk = Walk::new(|places| {
        let home = goal(places, "home", "(at hall)", 1);
        vec![GoalText { maintained: true, ..home }]
    });
    assert_eq!(walk.lives(), Vec::<String>::new());
    walk.arrive("hall", "dock");
    assert!(walk.wants("hall"));
    walk.arrive("dock", "hall");
    walk.arrive("hall", "door");
    assert!(walk.wants("hall"));
    assert_eq!(walk.0.ending, None);
    let again = ["home wanted", "home pursued", "home achieved", "home wanted", "home pursued"];
    assert_eq!(walk.lives(), again);
}

#[test]
fn a_robot_that_only_waits_for_goals_has_done_all_of_them_at_the_horizon() {
    let (graph, wheel) = rooms(|places| {
        let visit = goal(places, "visit", "(seen desk)", 1);
        vec![GoalText { when: fact("low"), ..visit }]
    });
    let wheel = wheel.until(later(Time(0), 100.0));
    let mut walk = Walk(Bench::begin(graph, wheel, true));
    assert!(walk.0.alarm.is_some(), "it waits for the horizon");
    walk.see("dock", "low");
    walk.arrive("hall", "desk");
    walk.0.pass(101.0);
    assert_eq!(walk.0.ending, Some(Ending::Accomplished));
}

/// A round to the dock that must be, and a visit to the desk that may be.
fn round_and_visit(penalty: f64) -> Walk {
    Walk::new(|places| {
        let visit = goal(places, "visit", "(seen desk)", 0);
        let visit = GoalText { importance: Importance::Soft(penalty), ..visit };
        vec![goal(places, "round", "(and (at dock) (seen dock))", 1), visit]
    })
}

#[test]
fn a_soft_goal_that_is_worth_its_price_is_a_part_of_the_plan() {
    let mut walk = round_and_visit(1.5);
    assert!(walk.wants("desk"), "{:?}", walk.lives());
    walk.arrive("hall", "desk");
    assert!(walk.wants("dock"), "{:?}", walk.lives());
    walk.arrive("desk", "dock");
    assert_eq!(walk.0.ending, Some(Ending::Accomplished));
    assert_eq!(walk.lives()[4..], ["visit achieved", "round achieved"]);
}

#[test]
fn a_soft_goal_that_costs_more_than_it_is_worth_is_given_up() {
    let mut walk = round_and_visit(0.5);
    assert!(walk.wants("dock") && !walk.wants("desk"));
    assert_eq!(walk.why("visit"), "a plan without it is cheaper, by more than 0.5");
    walk.arrive("hall", "dock");
    assert_eq!(walk.0.ending, Some(Ending::Accomplished), "nobody fails for a soft goal");
}

#[test]
fn a_plan_goes_without_a_soft_goal_that_is_out_of_reach_and_says_why() {
    let mut walk = Walk::new(|places| {
        let visit = goal(places, "visit", "(and (at desk) (at door))", 0);
        let visit = GoalText { importance: Importance::Soft(100.0), ..visit };
        vec![goal(places, "round", "(seen dock)", 1), visit]
    });
    assert!(walk.wants("dock"));
    assert!(walk.lives().contains(&"visit given_up".to_owned()), "{:?}", walk.lives());
    assert!(!walk.why("visit").is_empty());
    walk.arrive("hall", "dock");
    assert_eq!(walk.0.ending, Some(Ending::Accomplished));
    assert_eq!(walk.0.count(|n| matches!(n, Narration::FellBack { .. })), 0);
}

#[test]
fn a_soft_goal_that_a_plan_serves_and_that_fails_calls_nobody() {
    let mut walk = round_and_visit(1.5);
    let is = walk.label("is");
    walk.0.edit("mover", Edit::AddEdge { from: "desk".into(), label: is, to: "closed".into() });
    assert!(walk.wants("dock") && !walk.wants("desk"), "{:?}", walk.lives());
    assert!(walk.lives().contains(&"visit given_up".to_owned()), "{:?}", walk.lives());
    walk.arrive("hall", "dock");
    assert_eq!(walk.0.ending, Some(Ending::Accomplished));
    assert_eq!(walk.0.count(|n| matches!(n, Narration::FellBack { .. })), 0);
}

#[test]
fn an_object_that_appears_belongs_to_the_goal_and_one_that_goes_does_not() {
    let (graph, wheel) =
        rooms(|places| vec![goal(places, "all", "(forall (?p - place) (or (seen ?p) (shut ?p)))", 1)]);
    let arrivals = Arrivals::new(wheel.model().domain(), &graph.snapshot());
    let mut walk = Walk(Bench::begin(graph, wheel.with_arrivals(Arc::new(arrivals)), true));
    let place = walk.0.graph.vocabulary().node_type("place").unwrap();
    let wanted = |walk: &Walk, but: &str| {
        let places = ["hall", "desk", "door", "dock", "chair"];
        places.into_iter().find(|place| *place != but && walk.wants(place) && !walk.saw(place))
    };
    let mut at = "hall";
    for step in 0..4 {
        let next = wanted(&walk, at).unwrap_or_else(|| panic!("{step}: {}", walk.0.story()));
        match step {
            0 => walk.0.edit("mover", Edit::AddNode { name: "chair".into(), node_type: place }),
            1 => walk.0.edit("mover", Edit::AddNode { name: "stool".into(), node_type: place }),
            2 => walk.0.edit("mover", Edit::RemoveNode { node: "stool".into() }),
            _ => {}
        }
        assert!(walk.wants(next), "the step under way goes on: {}", walk.0.story());
        walk.arrive(at, next);
        at = next;
    }
    assert_eq!(walk.0.ending, None, "the chair has not been seen");
    let next = wanted(&walk, at).unwrap_or_else(|| panic!("{}", walk.0.story()));
    walk.arrive(at, next);
    assert!(walk.saw("chair"), "{}", walk.0.story());
    assert_eq!(walk.0.ending, Some(Ending::Accomplished), "{}", walk.0.story());
    let objects = walk.0.count(|n| matches!(n, Narration::Objects { .. }));
    assert_eq!(objects, 3);
}

#[test]
fn the_fallback_is_displaced_by_a_goal_that_has_a_plan() {
    let mut walk = Walk::new(|places| {
        let visit = goal(places, "visit", "(seen desk)", 1);
        vec![goal(places, "never", "(and (at dock) (at door))", 5), GoalText { when: fact("low"), ..visit }]
    });
    assert_eq!(walk.0.count(|n| matches!(n, Narration::FellBack { .. })), 1);
    assert!(matches!(walk.0.ending, Some(Ending::WithHuman { .. })), "{:?}", walk.0.story());
    let effects = walk.0.wheel.step(Event::Woke, Time(1));
    assert!(!effects.iter().any(|effect| matches!(effect, Effect::Plan(_))));
}
