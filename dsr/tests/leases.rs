//! Leases that are waited for: every state that a few agents and resources can get into, and what must hold in each.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

use std::collections::{BTreeSet, VecDeque};

use dsr::{
    AgentId, Graph, LabelId, PatternBuilder, Preemption, Priority, ResourceId, Snapshot, Time, Transaction,
    TransactionError, Vocabulary, VocabularyBuilder,
};
use std::sync::Arc;

const AGENTS: [&str; 3] = ["low", "middle", "high"];
const RESOURCES: [&str; 3] = ["base", "camera", "speaker"];

fn vocabulary() -> Arc<Vocabulary> {
    let mut builder = VocabularyBuilder::new();
    AGENTS.iter().for_each(|name| _ = builder.agent(name).unwrap());
    RESOURCES.iter().for_each(|name| _ = builder.resource(name).unwrap());
    builder.build()
}

/// What an agent does. Its priority is its place in `AGENTS`; it yields what it claims at once and finishes what it
/// waited for.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Deed {
    Claim(AgentId, ResourceId),
    Await(AgentId, ResourceId),
    Release(AgentId, ResourceId),
    Expire(AgentId),
}

fn priority(agent: AgentId) -> Priority {
    Priority(i32::try_from(agent.index()).unwrap())
}

fn perform(graph: &Graph, deed: Deed) -> Result<dsr::Commit, TransactionError> {
    let (Deed::Claim(agent, _) | Deed::Await(agent, _) | Deed::Release(agent, _) | Deed::Expire(agent)) =
        deed;
    let mut tx = Transaction::new(agent);
    match deed {
        Deed::Claim(agent, resource) => tx.claim(resource, priority(agent), Preemption::Yields),
        Deed::Await(agent, resource) => tx.await_lease(resource, priority(agent), Preemption::Finishes),
        Deed::Release(_, resource) => tx.release(resource),
        Deed::Expire(agent) => tx.push(dsr::Edit::Expire { agent }),
    };
    graph.commit(&tx, Time(0))
}

/// Who holds what and who waits for it, in turn: all that decides what can happen next.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Seen(Vec<Column>);

/// Of one resource: who holds it and whether the lease yields; who waits, the next first.
type Column = (Option<(AgentId, bool)>, Vec<AgentId>);

fn see(now: &Snapshot) -> Seen {
    let of = |resource| {
        let lease = now.lease(resource).map(|l| (l.holder, l.preemption == Preemption::Yields));
        (lease, now.waiting(resource).into_iter().map(|w| w.agent).collect())
    };
    Seen(now.vocabulary().resources().map(of).collect())
}

impl Seen {
    /// Resources are alike: states that differ only by which is which are looked at once.
    fn whichever(&self) -> Self {
        let mut columns = self.0.clone();
        columns.sort();
        Self(columns)
    }

    fn awaited(&self, agent: AgentId) -> Vec<usize> {
        (0..self.0.len()).filter(|&at| self.0[at].1.contains(&agent)).collect()
    }

    /// Whether agents wait for each other in a circle, by following every wait from every agent.
    fn has_circle(&self, agents: &[AgentId]) -> bool {
        let waits_for = |agent: AgentId| -> Vec<AgentId> {
            self.awaited(agent).into_iter().filter_map(|at| Some(self.0[at].0?.0)).collect()
        };
        agents.iter().any(|&start| {
            let (mut open, mut met) = (waits_for(start), BTreeSet::new());
            while let Some(agent) = open.pop() {
                if agent == start {
                    return true;
                }
                if met.insert(agent) {
                    open.extend(waits_for(agent));
                }
            }
            false
        })
    }

    /// The most urgent of the agent itself and of all who wait for it, by following every wait.
    fn worth(&self, agent: AgentId) -> Priority {
        let blocked = self.0.iter().filter(|(lease, _)| lease.is_some_and(|(holder, _)| holder == agent));
        let waiting = blocked.flat_map(|(_, waiting)| waiting.iter().map(|&other| self.worth(other)));
        waiting.max().map_or(priority(agent), |urgent| urgent.max(priority(agent)))
    }
}

fn check(before: &Seen, deed: Deed, now: &Snapshot, agents: &[AgentId]) {
    let seen = see(now);
    let context = || format!("{deed:?}: {before:?} → {seen:?}");
    assert!(!seen.has_circle(agents), "a deadlock: {}", context());
    for (at, (lease, waiting)) in seen.0.iter().enumerate() {
        assert!(lease.is_some() || waiting.is_empty(), "free, and waited for: {}", context());
        let resource = now.vocabulary().resources().nth(at).unwrap();
        for other in now.waiting(resource) {
            assert_eq!(other.inherited, seen.worth(other.agent), "{}", context());
        }
        // Fair: of two waits of the same worth, the one behind asked later.
        let turns: Vec<_> = now.waiting(resource).iter().map(|w| (-w.inherited.0, w.asked)).collect();
        assert!(turns.is_sorted(), "out of turn: {}", context());
        let Some((holder, yields)) = *lease else { continue };
        assert!(!waiting.contains(&holder), "waits for itself: {}", context());
        let lease = now.lease(resource).unwrap();
        assert_eq!(lease.inherited, seen.worth(holder).max(lease.priority), "{}", context());
        if let (Some((old, _)), Some(&first)) = (before.0[at].0, before.0[at].1.first())
            && old != holder
        {
            let claimed = deed == Deed::Claim(holder, resource) || deed == Deed::Await(holder, resource);
            // The order of those who wait may itself have changed by what the deed blocks or frees.
            let next = first == holder || before.0[at].1.contains(&holder);
            assert!(claimed || next, "passed over: {}", context());
        }
        if let Some((old, old_yields)) = before.0[at].0
            && old != holder
            && deed != Deed::Release(old, resource)
            && deed != Deed::Expire(old)
        {
            assert!(old_yields, "taken from one that finishes: {}", context());
        }
        // Stop now means now: no agent that is worth more than the holder's lease waits for it.
        if yields {
            let others = seen.0.iter().enumerate().filter(|(other, _)| *other != at);
            let blocked = others.filter(|(_, (lease, _))| lease.is_some_and(|(agent, _)| agent == holder));
            let pressure = blocked.flat_map(|(_, (_, waiting))| waiting.iter().map(|&w| seen.worth(w))).max();
            let worth = pressure.map_or(priority(holder), |p| p.max(priority(holder)));
            assert!(waiting.iter().all(|&w| seen.worth(w) <= worth), "too late: {}", context());
        }
    }
    for &agent in agents {
        assert!(seen.awaited(agent).len() <= 1, "waits twice: {}", context());
    }
    if let Deed::Expire(agent) = deed {
        let gone = seen.0.iter().all(|(lease, waiting)| {
            lease.is_none_or(|(holder, _)| holder != agent) && !waiting.contains(&agent)
        });
        assert!(gone, "a dead agent holds or waits: {}", context());
    }
}

/// Every agent that can continue does, and releases what it has: in the end no agent waits.
fn finish(graph: &Graph, agents: &[AgentId]) {
    for _ in 0..20 {
        let seen = see(&graph.snapshot());
        let Some(&going) = agents.iter().find(|&&agent| {
            let holds = seen.0.iter().any(|(lease, _)| lease.is_some_and(|(holder, _)| holder == agent));
            holds && seen.awaited(agent).is_empty()
        }) else {
            assert!(seen.0.iter().all(|(lease, waiting)| lease.is_none() && waiting.is_empty()), "{seen:?}");
            return;
        };
        for (at, resource) in graph.vocabulary().resources().enumerate() {
            if seen.0[at].0.is_some_and(|(holder, _)| holder == going) {
                perform(graph, Deed::Release(going, resource)).unwrap();
            }
        }
    }
    panic!("an agent waits for ever");
}

#[test]
fn no_state_that_three_agents_and_three_resources_can_reach_is_wrong() {
    let vocabulary = vocabulary();
    let agents: Vec<_> = AGENTS.iter().map(|name| vocabulary.agent(name).unwrap()).collect();
    let mut deeds = Vec::new();
    for &agent in &agents {
        deeds.push(Deed::Expire(agent));
        for resource in vocabulary.resources() {
            deeds.extend([
                Deed::Claim(agent, resource),
                Deed::Await(agent, resource),
                Deed::Release(agent, resource),
            ]);
        }
    }
    let start = Graph::new(Arc::clone(&vocabulary));
    let mut known = BTreeSet::from([see(&start.snapshot()).whichever()]);
    let mut open = VecDeque::from([(see(&start.snapshot()), start.snapshot().export())]);
    let (mut circles, mut inherited) = (0, 0);
    while let Some((before, export)) = open.pop_front() {
        for &deed in &deeds {
            let graph = Graph::restore(Arc::clone(&vocabulary), &export).unwrap();
            match perform(&graph, deed) {
                Ok(commit) => {
                    check(&before, deed, &commit.snapshot, &agents);
                    let now = see(&commit.snapshot);
                    let more =
                        |at: ResourceId| commit.snapshot.lease(at).is_some_and(|l| l.inherited > l.priority);
                    inherited += u32::from(vocabulary.resources().any(more));
                    if known.insert(now.whichever()) {
                        open.push_back((now, commit.snapshot.export()));
                    }
                }
                Err(TransactionError::Deadlock { .. }) => {
                    // What was refused would have been one, and the test's own eyes see it.
                    circles += 1;
                    let mut would = before.clone();
                    match deed {
                        Deed::Await(agent, resource) => {
                            let at = vocabulary.resources().position(|r| r == resource).unwrap();
                            would.0[at].1.push(agent);
                        }
                        Deed::Claim(agent, resource) => {
                            let at = vocabulary.resources().position(|r| r == resource).unwrap();
                            would.0[at].0 = Some((agent, true));
                        }
                        other => panic!("{other:?} closes no circle"),
                    }
                    assert!(would.has_circle(&agents), "{deed:?}: {before:?}");
                }
                Err(TransactionError::ResourceHeld { .. } | TransactionError::WaitsAlready { .. }) => {}
                Err(other) => panic!("{deed:?}: {other}"),
            }
        }
        finish(&Graph::restore(Arc::clone(&vocabulary), &export).unwrap(), &agents);
    }
    assert!(known.len() > 300 && circles > 100 && inherited > 100, "{} {circles} {inherited}", known.len());
}

fn ids(vocabulary: &Vocabulary) -> ([AgentId; 3], [ResourceId; 3]) {
    (
        AGENTS.map(|name| vocabulary.agent(name).unwrap()),
        RESOURCES.map(|name| vocabulary.resource(name).unwrap()),
    )
}

fn holder(graph: &Graph, resource: ResourceId) -> Option<AgentId> {
    graph.snapshot().lease(resource).map(|lease| lease.holder)
}

#[test]
fn equals_come_in_the_order_in_which_they_asked() {
    let mut builder = VocabularyBuilder::new();
    let agents: Vec<_> = (0..6).map(|at| builder.agent(&format!("a{at}")).unwrap()).collect();
    let speaker = builder.resource("speaker").unwrap();
    let graph = Graph::new(builder.build());
    let order = [3, 1, 5, 0, 4, 2];
    for &at in &order {
        // The fifth is more urgent than all, and comes first among those who wait.
        let priority = Priority(i32::from(at == 4));
        graph
            .edit(agents[at], Time(0), |tx| _ = tx.await_lease(speaker, priority, Preemption::Finishes))
            .unwrap();
    }
    let mut served = Vec::new();
    while let Some(agent) = holder(&graph, speaker) {
        served.push(agents.iter().position(|a| *a == agent).unwrap());
        graph.edit(agent, Time(0), |tx| _ = tx.release(speaker)).unwrap();
    }
    assert_eq!(served, [3, 4, 1, 5, 0, 2]);
}

/// The case that gave the rule its name: the low one has what the high one needs, and the middle one keeps it from
/// going on.
#[test]
fn a_middling_claim_does_not_take_from_a_low_one_what_a_high_one_waits_for() {
    let vocabulary = vocabulary();
    let ([low, middle, high], [base, camera, _]) = ids(&vocabulary);
    let graph = Graph::new(vocabulary);
    perform(&graph, Deed::Claim(low, camera)).unwrap();
    perform(&graph, Deed::Await(low, base)).unwrap();
    let taken = perform(&graph, Deed::Claim(middle, camera)).unwrap();
    assert_eq!(taken.snapshot.lease(camera).unwrap().holder, middle, "no agent waits for the low one");
    perform(&graph, Deed::Release(middle, camera)).unwrap();

    perform(&graph, Deed::Claim(low, camera)).unwrap();
    perform(&graph, Deed::Await(high, base)).unwrap();
    let refused = perform(&graph, Deed::Claim(middle, camera)).unwrap_err();
    assert!(matches!(refused, TransactionError::ResourceHeld { .. }), "{refused}");
    let lease = graph.snapshot().lease(camera).unwrap();
    assert_eq!((lease.holder, lease.priority, lease.inherited), (low, priority(low), priority(high)));

    // When the high one gives up, the middle one that waits now need wait no longer.
    perform(&graph, Deed::Await(middle, camera)).unwrap();
    assert_eq!(holder(&graph, camera), Some(low));
    perform(&graph, Deed::Release(high, base)).unwrap();
    assert_eq!(holder(&graph, camera), Some(middle));
}

#[test]
fn a_circle_is_refused_with_all_who_are_in_it() {
    let vocabulary = vocabulary();
    let ([low, middle, high], [base, camera, speaker]) = ids(&vocabulary);
    let graph = Graph::new(vocabulary);
    for (agent, resource) in [(low, base), (middle, camera), (high, speaker)] {
        perform(&graph, Deed::Await(agent, resource)).unwrap();
    }
    perform(&graph, Deed::Await(low, camera)).unwrap();
    perform(&graph, Deed::Await(middle, speaker)).unwrap();
    let refused = perform(&graph, Deed::Await(high, base)).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "'high' would wait for itself: 'base' is held by 'low', who waits: 'camera' is held by 'middle', who waits: \
         'speaker' is held by 'high'"
    );
    assert_eq!(graph.snapshot().awaited(high), None);
}

/// A pattern sees who waits; the lease of an agent whose thread panics goes to them in one commit.
#[test]
fn the_lease_of_a_dead_agent_goes_to_who_waits() {
    let vocabulary = vocabulary();
    let ([low, _, high], [.., speaker]) = ids(&vocabulary);
    let graph = Graph::new(Arc::clone(&vocabulary));
    let mut pattern = PatternBuilder::new(&vocabulary);
    let who = pattern.variable("who", dsr::TypeId::AGENT);
    pattern.edge(who, LabelId::AWAITS, "speaker");
    let mut queue = graph.subscribe(pattern.build().unwrap());

    let attended = graph.clone();
    let agent = std::thread::spawn(move || {
        let life = attended.attend(high);
        perform(&attended, Deed::Await(life.agent(), speaker)).unwrap();
        perform(&attended, Deed::Await(low, speaker)).unwrap();
        std::panic::resume_unwind(Box::new("an agent's mistake"));
    });
    assert!(agent.join().is_err());
    assert_eq!(holder(&graph, speaker), Some(low));
    let waited = queue.try_recv().unwrap();
    assert_eq!(waited.snapshot.sentences(), ["low awaits speaker", "high holds speaker"]);
    let served = queue.try_recv().unwrap();
    assert_eq!(served.snapshot.sentences(), ["low holds speaker"]);
    assert_eq!(served.version.0, waited.version.0 + 1);
}
