//! Refinements over a small house: intentions that are written, seen, missed and broken off, and methods tried next.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use dsr::{AgentId, Edit, Graph, Time};
use expect_test::{Expect, expect};
use high_to_low::{Methods, Moment, Refinement, Status, Step};
use pddl::model::{Domain, Name};
use pddl::{Source, parse_domain, parse_problem};
use vocabulary::Tokens;

const WORDS: &str = "(define (domain house)
  (:requirements :typing :equality :fluents :vocabulary)
  (:types agent resource symbol - object robot part state utterance device - symbol)
  (:constants pelea speech panel - agent broken - state speaker screen - device)
  (:predicates (is ?d - device ?s - state) (is_in ?r - robot ?p - part)
    (said_in ?u - utterance ?p - part) (shown_in ?u - utterance ?p - part) (precedes ?u ?v - utterance))
  (:functions (label ?r - robot ?p - part) - utterance (view ?r - robot ?p - part) - utterance)
  (:writes pelea is_in label view (is _ broken)) (:writes speech label said_in) (:writes panel view shown_in))";

const WORLD: &str = "(define (problem world) (:domain house)
  (:objects r - robot hall kitchen - part one two three - utterance)
  (:init (is_in r hall) (precedes one two) (precedes two three)) (:goal (and)))";

const METHODS: &str = "(define (domain methods)
  (:requirements :typing :equality :negative-preconditions :existential-preconditions :fluents
     :durative-actions :hierarchy :agent-rules)
  (:import house)
  (:durative-action enter :parameters (?r - robot ?p - part) :duration (<= ?duration 5)
    :effect (and (at start (forall (?q - part) (when (is_in ?r ?q) (not (is_in ?r ?q))))) (at start (is_in ?r ?p))))
  (:durative-action say :parameters (?r - robot ?p - part ?u - utterance) :duration (<= ?duration 10)
    :condition (over all (not (is speaker broken)))
    :effect (and (at start (assign (label ?r ?p) ?u))
      (at end (said_in ?u ?p)) (at end (assign (label ?r ?p) undefined)) (at timeout (is speaker broken))))
  (:durative-action show :parameters (?r - robot ?p - part ?u - utterance) :duration (<= ?duration 4)
    :effect (and (at start (assign (view ?r ?p) ?u))
      (at end (shown_in ?u ?p)) (at end (assign (view ?r ?p) undefined))))
  (:task tell :parameters (?r - robot ?p - part ?u - utterance))
  (:method both :parameters (?r - robot ?p - part ?u - utterance) :task (tell ?r ?p ?u)
    :precondition (not (is speaker broken)) :subtasks (and (say ?r ?p ?u) (show ?r ?p ?u)))
  (:method screen :parameters (?r - robot ?p - part ?u - utterance) :task (tell ?r ?p ?u)
    :ordered-subtasks (show ?r ?p ?u))
  (:task tell-from :parameters (?r - robot ?p - part ?u - utterance))
  (:method and-on :parameters (?r - robot ?p - part ?u ?v - utterance) :task (tell-from ?r ?p ?u)
    :precondition (precedes ?u ?v) :ordered-subtasks (and (say ?r ?p ?u) (tell-from ?r ?p ?v)))
  (:method last :parameters (?r - robot ?p - part ?u - utterance) :task (tell-from ?r ?p ?u)
    :precondition (not (exists (?v - utterance) (precedes ?u ?v))) :ordered-subtasks (say ?r ?p ?u))
  (:task go :parameters (?r - robot ?p - part))
  (:method directly :parameters (?r - robot ?p - part) :task (go ?r ?p)
    :ordered-subtasks (and (enter ?r ?p) (say ?r ?p one)))
  (:task round :parameters (?r - robot))
  (:method for-ever :parameters (?r - robot) :task (round ?r) :ordered-subtasks (round ?r))
  (:method for-ever-too :parameters (?r - robot) :task (round ?r) :ordered-subtasks (round ?r))
  (:durative-action say-there :parameters (?r - robot ?p - part) :duration (<= ?duration 10)
    :condition (at start (is_in ?r ?p))
    :effect (and (at start (assign (label ?r ?p) one)) (at end (said_in one ?p)) (at timeout (is speaker broken))))
  (:task wait :parameters (?r - robot ?p - part))
  (:method by-waiting :parameters (?r - robot ?p - part) :task (wait ?r ?p) :ordered-subtasks (say-there ?r ?p)))";

struct House {
    graph: Graph,
    methods: Methods,
    refinement: Refinement,
    now: Time,
}

impl House {
    fn new(task: &str, arguments: &[&str]) -> Self {
        let words = domain(WORDS, &[]);
        let tokens = Tokens::new(&words).unwrap();
        let world = parse_problem(&Source::new("world", WORLD), &words).model.unwrap();
        let graph = tokens.populate(&[&world], Time(0)).unwrap();
        let methods = METHODS.replace("(:import house)", "(:import house) (:constants one - utterance)");
        let methods = Methods::new(&domain(&methods, &[&words]), &tokens).unwrap();
        let arguments: Vec<_> = arguments.iter().map(|a| Name::new(a)).collect();
        let refinement = Refinement::new(&methods, &graph.snapshot(), task, &arguments).unwrap();
        Self { graph, methods, refinement, now: Time(0) }
    }

    /// Steps the refinement and writes its edits.
    fn step(&mut self) -> Step {
        let moment = Moment::at(self.now);
        let step = self.refinement.step(&self.methods, &self.graph.snapshot(), moment);
        self.write(&step.edits);
        step
    }

    fn write(&mut self, edits: &[Edit]) {
        self.graph
            .edit(AgentId::DSR, self.now, |tx| {
                tx.extend(edits.iter().cloned());
            })
            .unwrap();
    }

    /// The commit of an agent that has said or shown the wanted utterance.
    fn perform(&mut self, wanted: &str, done: &str, part: &str, utterance: &str) {
        let snapshot = self.graph.snapshot();
        let label = |name| snapshot.vocabulary().label(name).unwrap();
        let gone = Edit::RemoveEdge { from: "r".into(), label: label(wanted), to: part.into() };
        let told = Edit::AddEdge { from: utterance.into(), label: label(done), to: part.into() };
        self.write(&[gone, told]);
    }

    fn pass(&mut self, seconds: u64) {
        self.now = Time(self.now.0 + seconds * 1_000_000_000);
    }

    fn check(&self, expected: &Expect) {
        let sentences = self.graph.snapshot().sentences();
        let text: Vec<_> = sentences.into_iter().filter(|s| !s.contains("precedes")).collect();
        expected.assert_eq(&text.join("\n"));
    }
}

fn domain(text: &str, imports: &[&Domain]) -> Domain {
    let source = Source::new("test", text);
    let parsed = parse_domain(&source, imports);
    parsed.model.unwrap_or_else(|| panic!("{}", parsed.diagnostics[0].describe(&source)))
}

fn events(step: &Step) -> String {
    step.events.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

#[test]
fn unordered_subtasks_run_at_the_same_time_and_both_must_be_seen() {
    let mut house = House::new("tell", &["r", "hall", "one"]);
    let step = house.step();
    expect![[r#"
        (tell r hall one) by both
        intends (say r hall one)
        intends (show r hall one)"#]]
    .assert_eq(&events(&step));
    house.check(&expect![[r#"
        r is in hall
        r label hall
        r view hall"#]]);
    house.perform("view", "shown_in", "hall", "one");
    assert!(matches!(house.step().status, Status::Running { .. }));
    house.perform("label", "said_in", "hall", "one");
    assert_eq!(house.step().status, Status::Done);
}

#[test]
fn an_intention_that_only_writes_is_done_when_it_stands_in_the_graph() {
    let mut house = House::new("go", &["r", "kitchen"]);
    house.step();
    house.check(&expect!["r is in kitchen"]);
    expect![[r#"
        sees (enter r kitchen)
        intends (say r kitchen one)"#]]
    .assert_eq(&events(&house.step()));
}

#[test]
fn a_token_that_holds_already_is_not_written_again() {
    let mut house = House::new("go", &["r", "hall"]);
    let step = house.step();
    assert_eq!(step.edits.len(), 2, "the label and its value: {:?}", step.edits);
}

#[test]
fn a_missed_deadline_doubts_the_device_before_the_next_method_is_chosen() {
    let mut house = House::new("tell", &["r", "hall", "one"]);
    house.step();
    house.perform("view", "shown_in", "hall", "one");
    house.step();
    house.pass(11);
    expect![[r#"
        (say r hall one) failed: 10 s after (say r hall one), not: one said in hall
        both does not work for (tell r hall one)"#]]
    .assert_eq(&events(&house.step()));
    house.check(&expect![[r#"
        speaker is broken
        r is in hall
        one shown in hall"#]]);
    expect![[r#"
        (tell r hall one) by screen
        intends (show r hall one)"#]]
    .assert_eq(&events(&house.step()));
}

/// A process that was stopped: it is late now, and has read its queue up to the deadline only.
#[test]
fn breakage_8_a_deadline_waits_for_the_graph_of_its_own_time() {
    let mut house = House::new("tell", &["r", "hall", "one"]);
    house.step();
    house.pass(14);
    let at = |seconds: u64| Time(seconds * 1_000_000_000);
    for seen in [3, 4] {
        let moment = Moment { seen: at(seen), now: house.now };
        let step = house.refinement.step(&house.methods, &house.graph.snapshot(), moment);
        assert!(matches!(step.status, Status::Running { .. }), "{}", events(&step));
    }
    house.perform("view", "shown_in", "hall", "one");
    house.perform("label", "said_in", "hall", "one");
    assert_eq!(house.step().status, Status::Done);
}

#[test]
fn a_broken_over_all_condition_stops_an_intention_at_once() {
    let mut house = House::new("tell", &["r", "hall", "one"]);
    house.step();
    let is = house.graph.vocabulary().label("is").unwrap();
    house.write(&[Edit::AddEdge { from: "speaker".into(), label: is, to: "broken".into() }]);
    expect![[r#"
        (say r hall one) failed: (say r hall one) was broken off, speaker is broken
        both does not work for (tell r hall one)"#]]
    .assert_eq(&events(&house.step()));
    // The view of the failed method was withdrawn, so the other method's is an intention of its own.
    expect![[r#"
        (tell r hall one) by screen
        intends (show r hall one)"#]]
    .assert_eq(&events(&house.step()));
}

#[test]
fn an_intention_that_waits_for_its_precondition_doubts_no_device() {
    let mut house = House::new("wait", &["r", "kitchen"]);
    house.step();
    house.pass(11);
    let step = house.step();
    assert!(step.edits.is_empty(), "{:?}", step.edits);
    let Status::Failed(failure) = step.status else { panic!("it went on") };
    expect!["no method works for (wait r kitchen): by-waiting: (say-there r kitchen) could not start, r is not in kitchen"]
        .assert_eq(&failure.to_string());
}

#[test]
fn recursion_goes_through_a_list() {
    let mut house = House::new("tell-from", &["r", "hall", "one"]);
    for utterance in ["one", "two", "three"] {
        assert!(matches!(house.step().status, Status::Running { .. }));
        house.perform("label", "said_in", "hall", utterance);
    }
    assert_eq!(house.step().status, Status::Done);
}

#[test]
fn a_recursion_without_an_end_is_an_error() {
    let mut house = House::new("round", &["r"]);
    let Status::Failed(failure) = house.step().status else { panic!("it went on") };
    assert!(failure.to_string().contains("too deep"));
}

#[test]
fn cancelling_takes_back_tokens_that_are_unchanged() {
    let mut house = House::new("tell", &["r", "hall", "one"]);
    house.step();
    let edits = house.refinement.cancel(&house.graph.snapshot());
    house.write(&edits);
    house.check(&expect!["r is in hall"]);
}

#[test]
fn cancelling_leaves_tokens_that_were_overwritten_since() {
    let mut house = House::new("tell", &["r", "hall", "one"]);
    house.step();
    let mut other = Refinement::new(
        &house.methods,
        &house.graph.snapshot(),
        "tell-from",
        &["r", "hall", "two"].map(Name::new),
    )
    .unwrap();
    let step = other.step(&house.methods, &house.graph.snapshot(), Moment::at(Time(0)));
    house.write(&step.edits);
    let edits = house.refinement.cancel(&house.graph.snapshot());
    house.write(&edits);
    house.check(&expect![[r#"
        r is in hall
        r label hall"#]]);
}

#[test]
fn a_refinement_that_cannot_start_reports_why() {
    let house = House::new("round", &["r"]);
    let start = |task: &str, arguments: &[&str]| {
        let arguments: Vec<_> = arguments.iter().map(|a| Name::new(a)).collect();
        Refinement::new(&house.methods, &house.graph.snapshot(), task, &arguments).unwrap_err().to_string()
    };
    expect!["there is no task `dance`"].assert_eq(&start("dance", &[]));
    expect!["task `round` takes 1 argument, not 0"].assert_eq(&start("round", &[]));
    expect!["there is no node `q` in the graph"].assert_eq(&start("round", &["q"]));
}

#[test]
fn mistakes_in_a_methods_file_are_reported_with_their_places() {
    let words = domain(WORDS, &[]);
    let tokens = Tokens::new(&words).unwrap();
    let text = "(define (domain m) (:requirements :typing :durative-actions :hierarchy :agent-rules)
  (:import house)
  (:predicates (nearby ?r - robot))
  (:action jump :parameters () :effect (and))
  (:durative-action a :parameters (?r - robot) :duration (>= ?duration 3)
     :condition (at end (is speaker broken)) :effect (and (at start (nearby ?r)) (at failure (is speaker broken))))
  (:task t :parameters ())
  (:method m :parameters () :task (t) :ordered-subtasks (jump))
  (:task u :parameters ()))";
    let source = Source::new("m", text);
    let errors = Methods::new(&domain(text, &[&words]), &tokens).unwrap_err();
    let lines: Vec<_> = errors
        .iter()
        .map(|e| {
            let at = source.line_column(e.span().start);
            format!("{}:{}: {e}", at.line, at.column)
        })
        .collect();
    expect![[r#"
        5:58: the deadline of an intention is `(<= ?duration SECONDS)` with a number of seconds
        6:25: an intention has no condition `at end`; its `at end` effects are what must be seen
        6:69: `nearby` is not a token of vocabulary `house`
        6:86: an intention has effects `at start`, `at end` and `at timeout`, not `at failure`
        8:57: `jump` is an action; a method's primitives are durative actions, whose `at end` effects must be seen
        9:3: task `u` has no method"#]]
    .assert_eq(&lines.join("\n"));
}
