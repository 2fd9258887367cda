//! Graph, planner thread, clock and lighter, played by the test.

use budget::Cancellation;
use dsr::{AgentId, Edit, Graph, Time, Transaction};
use executive::{
    Decision, Effect, Ending, Event, Model, Narration, NoPlan, Policy, Request, Step, Unsolvable, Wheel,
    decide,
};
use high_to_low::Methods;
use low_to_high::Perception;
use pddl::model::{Domain, Name};
use pddl::{Source, parse_domain, parse_problem};
use std::collections::VecDeque;
use std::sync::Arc;
use vocabulary::Tokens;

/// A wheel over the lamps, with everything around it.
pub(crate) struct Bench {
    pub(crate) graph: Graph,
    pub(crate) subscription: dsr::Subscription,
    pub(crate) wheel: Wheel,
    pub(crate) now: Time,
    pub(crate) told: Vec<Narration>,
    pub(crate) ending: Option<Ending>,
    pub(crate) alarm: Option<Time>,
    /// Plans asked for and not yet made or cancelled.
    pub(crate) requests: VecDeque<Request>,
    /// Whether the graph refuses the next write.
    pub(crate) refuses: bool,
    /// Whether each plan is made at once.
    pub(crate) at_once: bool,
}

pub(crate) fn domain(name: &str, text: &str, imports: &[&Domain]) -> Domain {
    let source = Source::new(name, text);
    let parsed = parse_domain(&source, imports);
    parsed.model.unwrap_or_else(|| panic!("{}", parsed.diagnostics[0].describe(&source)))
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self::with_fallback("give-up")
    }

    pub(crate) fn with_fallback(fallback: &str) -> Self {
        Self::with_policy(Policy { attempts: 2, ..Policy::new(on_a(fallback)) })
    }

    pub(crate) fn with_policy(policy: Policy) -> Self {
        Self::of(policy, |wheel| wheel)
    }

    pub(crate) fn of(policy: Policy, prepare: impl FnOnce(Wheel) -> Wheel) -> Self {
        let (graph, wheel) = lamps(policy);
        Self::begin(graph, prepare(wheel), false)
    }

    /// With a planning domain, a goal and a perception of its own.
    pub(crate) fn planning(policy: Policy, texts: [&str; 3]) -> Self {
        let (graph, wheel) = planning(policy, texts);
        Self::begin(graph, wheel, false)
    }

    /// A wheel that looks at its graph for the first time.
    pub(crate) fn begin(graph: Graph, wheel: Wheel, at_once: bool) -> Self {
        let pelea = graph.vocabulary().agent("pelea").unwrap();
        let mut subscription = graph.subscribe_to(wheel.interest(pelea));
        let start = subscription.try_recv().unwrap().snapshot;
        let mut bench = Self {
            graph,
            subscription,
            wheel,
            now: Time(0),
            told: Vec::new(),
            ending: None,
            alarm: None,
            requests: VecDeque::new(),
            refuses: false,
            at_once,
        };
        bench.turn(Event::Seen(start));
        bench
    }

    /// Hands an event in, carries out what is asked for, and everything that follows from that.
    pub(crate) fn turn(&mut self, event: Event) {
        let mut events = VecDeque::from([event]);
        while let Some(event) = events.pop_front() {
            for effect in self.wheel.step(event, self.now) {
                match effect {
                    Effect::Write(_) if std::mem::take(&mut self.refuses) => {
                        events.push_back(Event::Refused(refusal()));
                    }
                    Effect::Write(edits) => {
                        let answer = self.commit("pelea", edits);
                        events.extend(self.seen());
                        events.push_back(answer);
                    }
                    Effect::Plan(request) if self.at_once => {
                        let decision = self.decide(&request);
                        events.push_back(Event::Decided(request.id, decision));
                    }
                    Effect::Plan(request) => self.requests.push_back(request),
                    Effect::Cancel(id) => self.requests.retain(|request| request.id != id),
                    Effect::WakeAt(time) => self.alarm = Some(time),
                    Effect::Tell(narration) => self.told.push(narration),
                    Effect::End(ending) => self.ending = Some(ending),
                }
            }
            events.extend(self.seen());
        }
    }

    /// The commits that concern the wheel.
    pub(crate) fn seen(&mut self) -> Vec<Event> {
        let changed = |mut news: dsr::News| Event::Changed {
            delta: news.deltas.pop().expect("not so many that some are missed"),
            snapshot: news.snapshot,
        };
        std::iter::from_fn(|| self.subscription.try_recv()).map(changed).collect()
    }

    pub(crate) fn commit(&self, agent: &str, edits: Vec<Edit>) -> Event {
        let mut transaction = Transaction::new(self.agent(agent));
        transaction.extend(edits);
        match self.graph.commit(&transaction, self.now) {
            Ok(_) => Event::Written,
            Err(error) => Event::Refused(error),
        }
    }

    pub(crate) fn agent(&self, name: &str) -> AgentId {
        self.graph.vocabulary().agent(name).unwrap()
    }

    /// An agent makes a token true.
    pub(crate) fn write(&mut self, agent: &str, lamp: &str, state: &str) {
        let is = self.graph.vocabulary().label("is").unwrap();
        self.edit(agent, Edit::AddEdge { from: lamp.into(), label: is, to: state.into() });
    }

    /// Or false.
    pub(crate) fn take(&mut self, agent: &str, lamp: &str, state: &str) {
        let is = self.graph.vocabulary().label("is").unwrap();
        self.edit(agent, Edit::RemoveEdge { from: lamp.into(), label: is, to: state.into() });
    }

    pub(crate) fn edit(&mut self, agent: &str, edit: Edit) {
        self.edits(agent, vec![edit]);
    }

    pub(crate) fn edits(&mut self, agent: &str, edits: Vec<Edit>) {
        self.commit(agent, edits);
        for event in self.seen() {
            self.turn(event);
        }
    }

    /// Decision Support finds no plan.
    pub(crate) fn nothing_helps(&self) -> Decision {
        let model = Arc::clone(self.wheel.model());
        Decision::NoPlan(NoPlan::Unsolvable(Unsolvable::new(
            model,
            planner::Explanation::default(),
            Vec::new(),
        )))
    }

    pub(crate) fn decide(&self, request: &Request) -> Decision {
        decide(self.wheel.model(), request, &Cancellation::default())
    }

    pub(crate) fn plan(&mut self) {
        let request = self.requests.pop_front().expect("a plan was asked for");
        let decision = self.decide(&request);
        self.turn(Event::Decided(request.id, decision));
    }

    /// Time passes, and every alarm rings when it should.
    pub(crate) fn pass(&mut self, seconds: f64) {
        let end = later(self.now, seconds);
        while self.ending.is_none()
            && let Some(alarm) = self.alarm.filter(|&alarm| alarm <= end)
        {
            // After a stop, an alarm may be overdue.
            (self.now, self.alarm) = (alarm.max(self.now), None);
            self.turn(Event::Woke);
            assert!(self.alarm.is_none_or(|next| next > self.now), "an alarm in the past");
        }
        self.now = end;
    }

    /// The process is stopped: time passes, and no alarm rings before it goes on.
    pub(crate) fn stand_still(&mut self, seconds: f64) {
        self.now = later(self.now, seconds);
    }

    /// The last decisions, a line each.
    pub(crate) fn story(&self) -> String {
        let lines = self.told.iter().rev().take(30).rev();
        lines.map(|n| serde_json::to_string(n).unwrap() + "\n").collect()
    }

    pub(crate) fn is(&self, lamp: &str, state: &str) -> bool {
        self.graph.snapshot().sentences().contains(&format!("{lamp} is {state}"))
    }

    pub(crate) fn wants(&self, lamp: &str) -> bool {
        self.is(lamp, "wanted")
    }

    pub(crate) fn count(&self, matches: impl Fn(&Narration) -> bool) -> usize {
        self.told.iter().filter(|n| matches(n)).count()
    }
}

/// A task of the lamps that is about lamp `a`.
pub(crate) fn on_a(task: &str) -> Step {
    Step { action: Name::new(task), arguments: vec![Name::new("a")] }
}

pub(crate) fn later(time: Time, seconds: f64) -> Time {
    Time(time.0 + u64::try_from(std::time::Duration::from_secs_f64(seconds).as_nanos()).unwrap())
}

/// The graph refuses a write.
pub(crate) fn refusal() -> dsr::TransactionError {
    dsr::TransactionError::UnknownAgent { id: AgentId::DSR }
}

/// The graph of the lamps, and a wheel at rest.
pub(crate) fn lamps(policy: Policy) -> (Graph, Wheel) {
    let texts = [
        include_str!("../../test_data/lamps/domain.pddl"),
        include_str!("../../test_data/lamps/problem.pddl"),
        include_str!("../../test_data/lamps/perception.pddl"),
    ];
    planning(policy, texts)
}

fn planning(policy: Policy, [lamps, problem, perception]: [&str; 3]) -> (Graph, Wheel) {
    let lab = domain("vocabulary", include_str!("../../test_data/lamps/vocabulary.pddl"), &[]);
    let lamps = domain("domain", lamps, &[]);
    let perception = domain("perception", perception, &[&lab, &lamps]);
    let methods = domain("methods", include_str!("../../test_data/lamps/methods.hddl"), &[&lab]);
    let world = Source::new("world", include_str!("../../test_data/lamps/world.pddl"));
    let world = parse_problem(&world, &lab).model.unwrap();
    let problem = Source::new("problem", problem);
    let problem = parse_problem(&problem, &lamps).model.unwrap();

    let tokens = Tokens::new(&lab).unwrap();
    let graph = tokens.populate(&[&world], Time(0)).unwrap();
    let perception = Arc::new(Perception::new(&perception, &tokens).unwrap());
    let perceived: Vec<Name> = perception.derived().map(|(name, _)| name.clone()).collect();
    let model = Arc::new(Model::new(lamps, problem, &perceived).unwrap());
    let methods = Arc::new(Methods::new(&methods, &tokens).unwrap());
    (graph, Wheel::new(model, perception, methods, policy))
}
