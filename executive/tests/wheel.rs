//! The wheel turned by hand: the test plays graph, planner thread, clock and the lighter.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use dsr::{AgentId, Edit, Graph, Time, Transaction};
use executive::{
    Decision, Effect, Ending, Event, Fallback, Model, Narration, NoPlan, Policy, Request, Step, Unsolvable,
    Wheel, decide,
};
use high_to_low::Methods;
use low_to_high::Perception;
use pddl::model::{Domain, Name};
use pddl::{Source, parse_domain, parse_problem};
use std::collections::VecDeque;
use std::sync::Arc;
use vocabulary::Tokens;

/// A wheel over the lamps, with everything around it.
struct Bench {
    graph: Graph,
    subscription: dsr::Subscription,
    wheel: Wheel,
    now: Time,
    told: Vec<Narration>,
    ending: Option<Ending>,
    /// Plans asked for and not yet made.
    requests: VecDeque<Request>,
}

fn domain(name: &str, text: &str, imports: &[&Domain]) -> Domain {
    let source = Source::new(name, text);
    let parsed = parse_domain(&source, imports);
    parsed.model.unwrap_or_else(|| panic!("{}", parsed.diagnostics[0].describe(&source)))
}

impl Bench {
    fn new() -> Self {
        Self::with_fallback("give-up")
    }

    fn with_fallback(fallback: &str) -> Self {
        let lab = domain("vocabulary", include_str!("../test_data/lamps/vocabulary.pddl"), &[]);
        let lamps = domain("domain", include_str!("../test_data/lamps/domain.pddl"), &[]);
        let perception =
            domain("perception", include_str!("../test_data/lamps/perception.pddl"), &[&lab, &lamps]);
        let methods = domain("methods", include_str!("../test_data/lamps/methods.hddl"), &[&lab]);
        let world = Source::new("world", include_str!("../test_data/lamps/world.pddl"));
        let world = parse_problem(&world, &lab).model.unwrap();
        let problem = Source::new("problem", include_str!("../test_data/lamps/problem.pddl"));
        let problem = parse_problem(&problem, &lamps).model.unwrap();

        let tokens = Tokens::new(&lab).unwrap();
        let graph = tokens.populate(&[&world], Time(0)).unwrap();
        let perceived = [Name::new("bright"), Name::new("dead")];
        let model = Arc::new(Model::new(lamps, problem, &perceived).unwrap());
        let perception = Arc::new(Perception::new(&perception, &tokens).unwrap());
        let methods = Arc::new(Methods::new(&methods, &tokens).unwrap());
        let fallback = Step { action: Name::new(fallback), arguments: vec![Name::new("a")] };
        let wheel =
            Wheel::new(model, perception, methods, Policy { fallback, expansions: 1_000, attempts: 2 });
        let pelea = graph.vocabulary().agent("pelea").unwrap();
        let mut subscription = graph.subscribe_to(wheel.interest(pelea));
        let start = subscription.try_recv().unwrap().snapshot;
        let told = Vec::new();
        let mut bench =
            Self { graph, subscription, wheel, now: Time(0), told, ending: None, requests: VecDeque::new() };
        bench.turn(Event::Seen(start));
        bench
    }

    /// Hands an event in, carries out what is asked for, and everything that follows from that.
    fn turn(&mut self, event: Event) {
        let mut events = VecDeque::from([event]);
        while let Some(event) = events.pop_front() {
            for effect in self.wheel.step(event, self.now) {
                match effect {
                    Effect::Write(edits) => {
                        let answer = self.commit("pelea", edits);
                        events.extend(self.seen());
                        events.push_back(answer);
                    }
                    Effect::Plan(request) => self.requests.push_back(request),
                    Effect::WakeAt(_) => {}
                    Effect::Tell(narration) => self.told.push(narration),
                    Effect::End(ending) => self.ending = Some(ending),
                }
            }
            events.extend(self.seen());
        }
    }

    /// The commits that concern the wheel.
    fn seen(&mut self) -> Vec<Event> {
        let changed = |mut news: dsr::News| Event::Changed {
            delta: news.deltas.pop().expect("not so many that some are missed"),
            snapshot: news.snapshot,
        };
        std::iter::from_fn(|| self.subscription.try_recv()).map(changed).collect()
    }

    fn commit(&self, agent: &str, edits: Vec<Edit>) -> Event {
        let mut transaction = Transaction::new(self.agent(agent));
        transaction.extend(edits);
        match self.graph.commit(&transaction, self.now) {
            Ok(_) => Event::Written,
            Err(error) => Event::Refused(error),
        }
    }

    fn agent(&self, name: &str) -> AgentId {
        self.graph.vocabulary().agent(name).unwrap()
    }

    /// An agent makes a token true.
    fn write(&mut self, agent: &str, lamp: &str, state: &str) {
        let is = self.graph.vocabulary().label("is").unwrap();
        self.edit(agent, Edit::AddEdge { from: lamp.into(), label: is, to: state.into() });
    }

    /// Or false.
    fn take(&mut self, agent: &str, lamp: &str, state: &str) {
        let is = self.graph.vocabulary().label("is").unwrap();
        self.edit(agent, Edit::RemoveEdge { from: lamp.into(), label: is, to: state.into() });
    }

    fn edit(&mut self, agent: &str, edit: Edit) {
        self.commit(agent, vec![edit]);
        for event in self.seen() {
            self.turn(event);
        }
    }

    /// Decision Support finds no plan.
    fn nothing_helps(&self) -> Decision {
        let model = Arc::clone(self.wheel.model());
        Decision::NoPlan(NoPlan::Unsolvable(Unsolvable::new(
            model,
            planner::Explanation::default(),
            Vec::new(),
        )))
    }

    fn plan(&mut self) {
        let request = self.requests.pop_front().expect("a plan was asked for");
        let decision = decide(self.wheel.model(), &request);
        self.turn(Event::Decided(request.id, decision));
    }

    fn pass(&mut self, seconds: u64) {
        self.now = Time(self.now.0 + seconds * 1_000_000_000);
        self.turn(Event::Woke);
    }

    fn wants(&self, lamp: &str) -> bool {
        self.graph.snapshot().sentences().contains(&format!("{lamp} is wanted"))
    }

    fn count(&self, matches: impl Fn(&Narration) -> bool) -> usize {
        self.told.iter().filter(|n| matches(n)).count()
    }
}

/// The graph refuses a write.
fn refusal() -> dsr::TransactionError {
    dsr::TransactionError::UnknownAgent { id: AgentId::DSR }
}

#[test]
fn a_plan_is_carried_out_step_by_step_as_it_is_sensed() {
    let mut bench = Bench::new();
    bench.plan();
    assert!(bench.wants("a") && !bench.wants("b"));
    bench.write("lighter", "a", "lit");
    assert!(bench.wants("b"));
    assert_eq!(bench.ending, None);
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
    assert!(bench.requests.is_empty());
}

#[test]
fn luck_skips_steps_and_takes_back_what_is_no_longer_wanted() {
    let mut bench = Bench::new();
    bench.plan();
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, None);
    bench.write("lighter", "a", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
    assert!(bench.requests.is_empty(), "no planner was needed");
    assert!(!bench.wants("b"), "the second step never started");
}

#[test]
fn a_deviation_names_the_fact_and_who_needed_it() {
    let mut bench = Bench::new();
    bench.plan();
    bench.write("lighter", "b", "broken");
    let Some(Narration::Deviated(deviation)) =
        bench.told.iter().find(|n| matches!(n, Narration::Deviated(_))).cloned()
    else {
        panic!("no deviation: {:?}", bench.told)
    };
    assert_eq!(deviation.broken.len(), 1);
    let literal = &deviation.broken[0];
    assert_eq!(literal.fact.as_ref().unwrap().to_string(), "(dead b)");
    assert!(!literal.expected);
    assert_eq!(literal.needed_by.as_ref().unwrap().to_string(), "(light a b)");
    assert_eq!(literal.given_by, None);

    bench.plan();
    assert!(
        matches!(bench.ending, Some(Ending::NotAccomplished { fallback: Fallback::Done, .. })),
        "{:?}",
        bench.ending
    );
    assert!(!bench.wants("a"), "what was intended is taken back");
}

#[test]
fn a_step_that_changes_nothing_is_tried_again_and_then_given_up() {
    let mut bench = Bench::new();
    bench.plan();
    bench.pass(6);
    assert_eq!(bench.count(|n| matches!(n, Narration::Failed { .. })), 1);
    assert!(!bench.wants("a"));
    // In the very state in which it failed it is not tried again: there is no plan.
    bench.plan();
    assert!(matches!(bench.ending, Some(Ending::NotAccomplished { .. })));
}

#[test]
fn a_decision_for_a_state_that_has_moved_on_is_held_against_the_present() {
    let mut bench = Bench::new();
    let request = bench.requests.pop_front().unwrap();
    let decision = decide(bench.wheel.model(), &request);
    assert!(matches!(decision, Decision::Plan { .. }));
    bench.write("lighter", "a", "lit");
    bench.turn(Event::Decided(request.id, decision));
    assert!(bench.wants("b") && !bench.wants("a"), "the first step is skipped");
    assert!(bench.requests.is_empty());
}

#[test]
fn that_there_was_no_plan_is_not_believed_of_a_state_that_has_moved_on() {
    let mut bench = Bench::new();
    bench.plan();
    bench.write("lighter", "b", "broken");
    let request = bench.requests.pop_front().unwrap();
    let decision = decide(bench.wheel.model(), &request);
    assert!(matches!(decision, Decision::NoPlan(_)));
    bench.take("lighter", "b", "broken");
    bench.turn(Event::Decided(request.id, decision));
    assert_eq!(bench.ending, None);
    bench.plan();
    bench.write("lighter", "a", "lit");
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
}

#[test]
fn an_answer_to_an_older_request_is_thrown_away() {
    let mut bench = Bench::new();
    let request = bench.requests.pop_front().unwrap();
    let decision = decide(bench.wheel.model(), &request);
    bench.turn(Event::Decided(request.id, decision.clone()));
    let told = bench.told.len();
    bench.turn(Event::Decided(request.id, decision));
    assert_eq!(bench.told.len(), told);
}

#[test]
fn a_refused_write_is_a_failed_step() {
    let mut bench = Bench::new();
    bench.plan();
    bench.turn(Event::Refused(refusal()));
    assert_eq!(bench.count(|n| matches!(n, Narration::Refused { .. })), 1);
    assert_eq!(bench.count(|n| matches!(n, Narration::Failed { .. })), 1);
}

#[test]
fn a_goal_that_holds_before_there_is_a_plan_needs_none() {
    let mut bench = Bench::new();
    for lamp in ["a", "b"] {
        bench.write("lighter", lamp, "lit");
    }
    assert_eq!(bench.ending, Some(Ending::Accomplished));
    assert!(!bench.wants("a"));
}

#[test]
fn a_planner_that_stops_is_followed_by_the_fallback() {
    let mut bench = Bench::with_fallback("light-first");
    let request = bench.requests.pop_front().unwrap();
    bench.turn(Event::Decided(request.id, Decision::NoPlan(NoPlan::Stopped)));
    assert!(bench.wants("a"));
    bench.write("lighter", "a", "lit");
    assert!(matches!(bench.ending, Some(Ending::NotAccomplished { fallback: Fallback::Done, .. })));
}

#[test]
fn a_fallback_that_the_graph_refuses_once_is_not_given_up() {
    let mut bench = Bench::with_fallback("light-first");
    let request = bench.requests.pop_front().unwrap();
    bench.turn(Event::Decided(request.id, bench.nothing_helps()));
    bench.turn(Event::Refused(refusal()));
    assert_eq!(bench.ending, None);
    bench.write("lighter", "a", "lit");
    assert!(matches!(bench.ending, Some(Ending::NotAccomplished { fallback: Fallback::Done, .. })));
}

#[test]
fn a_fallback_that_is_refused_for_good_ends_at_its_deadline() {
    let mut bench = Bench::with_fallback("light-first");
    let request = bench.requests.pop_front().unwrap();
    bench.wheel.step(Event::Decided(request.id, bench.nothing_helps()), bench.now);
    bench.turn(Event::Refused(refusal()));
    assert_eq!(bench.ending, None);
    bench.pass(6);
    assert!(matches!(
        bench.ending,
        Some(Ending::NotAccomplished { fallback: Fallback::NotStarted(_) | Fallback::Failed(_), .. })
    ));
}

#[test]
fn a_deadline_that_passes_while_a_plan_is_made_stops_nothing() {
    let mut bench = Bench::new();
    bench.pass(60);
    bench.plan();
    assert!(bench.wants("a"), "{:?}", bench.told);
}

#[test]
fn missed_changes_are_made_up_for_by_one_look() {
    let mut bench = Bench::new();
    bench.plan();
    let is = bench.graph.vocabulary().label("is").unwrap();
    bench.commit("lighter", vec![Edit::AddEdge { from: "a".into(), label: is, to: "lit".into() }]);
    bench.seen();
    bench.turn(Event::Seen(bench.graph.snapshot()));
    assert!(bench.wants("b") && bench.requests.is_empty(), "{:?}", bench.told);
}

#[test]
fn commits_outside_the_interest_do_not_reach_the_wheel() {
    let mut bench = Bench::new();
    let vocabulary = bench.graph.vocabulary();
    let label = |name| vocabulary.label(name).unwrap();
    let (is, beside) = (label("is"), label("stands_beside"));
    bench.commit("lighter", vec![Edit::AddEdge { from: "a".into(), label: beside, to: "b".into() }]);
    assert!(bench.seen().is_empty());
    bench.commit("lighter", vec![Edit::AddEdge { from: "a".into(), label: is, to: "lit".into() }]);
    assert_eq!(bench.seen().len(), 1);
    // Its own commits do, whatever they change.
    bench.commit("pelea", vec![Edit::AddEdge { from: "b".into(), label: is, to: "wanted".into() }]);
    assert_eq!(bench.seen().len(), 1);
}

#[test]
fn the_same_events_give_the_same_story() {
    let run = || {
        let mut bench = Bench::new();
        bench.plan();
        bench.write("lighter", "a", "lit");
        bench.write("lighter", "b", "lit");
        serde_json::to_string(&bench.told).unwrap()
    };
    assert_eq!(run(), run());
}
