//! Resources that were taken for a rule which then does not start are given back, whatever the reason.
#![allow(clippy::unwrap_used, reason = "a test")]

mod common;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use agents::{Action, Runtime};
use common::{Bench, Lab, at};
use dsr::{AgentId, Graph, Isometry3, Preemption, Priority, Subscription, Time, TransactionError};

fn holder(graph: &Graph) -> Option<String> {
    let (snapshot, vocabulary) = (graph.snapshot(), graph.vocabulary());
    let lease = snapshot.lease(vocabulary.resource("mouth").unwrap())?;
    vocabulary.agent_name(lease.holder).map(ToString::to_string)
}

#[test]
fn a_start_refused_as_keep_broken_gives_back_what_was_taken() {
    let mut bench = Bench::new(&["talker", "pedant"]);
    bench.direct(1, &["+robot is quiet", "+robot shall_say hello"]);
    bench.log();
    bench.direct(2, &["+robot shall_shout fire"]);
    assert_eq!(holder(&bench.lab.graph).as_deref(), Some("talker"), "{}", bench.log());
    assert_eq!(bench.running.len(), 1);
    // And the rule starts when its condition over all would hold.
    bench.direct(10, &["-robot is quiet"]);
    assert_eq!(holder(&bench.lab.graph).as_deref(), Some("pedant"), "{}", bench.log());
}

/// One agent, driven step by step while others write between its decision and its commit.
struct Solo {
    lab: Lab,
    runtime: Runtime,
    subscription: Subscription,
}

impl Solo {
    fn new(name: &str) -> Self {
        let lab = Lab::new();
        let agent = lab.agent(name);
        let subscription = lab.graph.subscribe_to(agent.interest());
        Self { lab, runtime: Runtime::new(agent), subscription }
    }

    fn decide(&mut self, now: Time) -> Option<Action> {
        while let Some(news) = self.subscription.try_recv() {
            self.runtime.changed(&news);
        }
        self.runtime.next_action(&self.lab.graph.snapshot(), now)
    }

    /// The next decision is a commit; `meanwhile` happens before it reaches the graph.
    fn commit(&mut self, now: Time, meanwhile: impl FnOnce(&Lab)) -> Result<(), TransactionError> {
        let Some(Action::Commit(transaction)) = self.decide(now) else { panic!("no commit") };
        meanwhile(&self.lab);
        let result = self.lab.graph.commit(&transaction, now);
        self.runtime.committed(result.as_ref(), now);
        result.map(|_| ())
    }

    fn settle(&mut self, now: Time) {
        while let Some(action) = self.decide(now) {
            if let Action::Commit(transaction) = action {
                let result = self.lab.graph.commit(&transaction, now);
                self.runtime.committed(result.as_ref(), now);
            }
        }
    }

    /// Another agent holds the mouth at this priority.
    fn seize(&self, agent: &str, priority: i32) {
        let vocabulary = self.lab.graph.vocabulary();
        let mouth = vocabulary.resource("mouth").unwrap();
        let seized = self.lab.graph.edit(vocabulary.agent(agent).unwrap(), at(1), |tx| {
            tx.release(mouth).claim(mouth, Priority(priority), Preemption::Yields);
        });
        seized.unwrap();
    }
}

#[test]
fn a_start_refused_as_stale_starts_on_the_next_version_or_gives_back() {
    for withdrawn in [false, true] {
        let mut solo = Solo::new("shouter");
        solo.seize("talker", 50);
        solo.lab.direct(&["+robot shall_shout fire"], 1);
        solo.commit(at(1), |_| {}).unwrap();
        assert_eq!(holder(&solo.lab.graph).as_deref(), Some("shouter"));
        let edit = if withdrawn { "-robot shall_shout fire" } else { "+robot shall_say hello" };
        let refused = solo.commit(at(1), |lab| lab.direct(&[edit], 1));
        assert!(matches!(refused, Err(TransactionError::Stale { .. })), "{refused:?}");
        solo.settle(at(1));
        assert_eq!(holder(&solo.lab.graph).is_some(), !withdrawn);
        assert_eq!(solo.runtime.running(), usize::from(!withdrawn));
    }
}

#[test]
fn giving_back_is_tried_again_when_it_is_refused_as_stale() {
    let mut solo = Solo::new("shouter");
    solo.seize("talker", 50);
    solo.lab.direct(&["+robot shall_shout fire"], 1);
    solo.commit(at(1), |_| {}).unwrap();
    solo.lab.direct(&["-robot shall_shout fire"], 1);
    let refused = solo.commit(at(1), |lab| lab.direct(&["+robot shall_say hello"], 1));
    assert!(matches!(refused, Err(TransactionError::Stale { .. })), "{refused:?}");
    solo.settle(at(1));
    assert_eq!(holder(&solo.lab.graph), None);
}

#[test]
fn what_another_agent_has_taken_meanwhile_is_left_to_it() {
    let mut solo = Solo::new("shouter");
    solo.seize("talker", 50);
    solo.lab.direct(&["+robot shall_shout fire"], 1);
    solo.commit(at(1), |_| {}).unwrap();
    solo.lab.direct(&["-robot shall_shout fire"], 1);
    solo.seize_from_above("heckler");
    solo.settle(at(1));
    assert_eq!(holder(&solo.lab.graph).as_deref(), Some("heckler"));
}

impl Solo {
    fn seize_from_above(&self, agent: &str) {
        let vocabulary = self.lab.graph.vocabulary();
        let mouth = vocabulary.resource("mouth").unwrap();
        let claimed = self.lab.graph.edit(vocabulary.agent(agent).unwrap(), at(1), |tx| {
            tx.claim(mouth, Priority(100), Preemption::Yields);
        });
        claimed.unwrap();
    }
}

#[test]
fn a_rule_starts_when_the_lease_that_it_waits_for_becomes_worth_less() {
    let mut solo = Solo::new("shouter");
    solo.seize("talker", 80);
    solo.lab.direct(&["+robot shall_shout fire"], 1);
    solo.settle(at(1));
    assert_eq!(solo.runtime.running(), 0);
    // The holder stays the same; only the priority changes, in one commit.
    solo.seize("talker", 20);
    solo.settle(at(1));
    assert_eq!(solo.runtime.running(), 1);
}

#[test]
fn a_rule_with_a_distance_is_not_woken_by_moves_that_cross_no_threshold() {
    let lab = Lab::new();
    let mut subscription = lab.graph.subscribe_to(lab.agent("driver").interest());
    let place = |metres: f64| {
        let moved = lab.graph.edit(AgentId::DSR, at(1), |tx| {
            tx.set_transform("world", "robot", Isometry3::translation(0.0, 0.0, 0.0));
            tx.set_transform("world", "person", Isometry3::translation(metres, 0.0, 0.0));
        });
        moved.unwrap();
    };
    place(1.0);
    lab.direct(&["+robot shall_ask person"], 1);
    let news = Arc::new(AtomicUsize::new(0));
    let mut read = || {
        while subscription.try_recv().is_some() {
            news.fetch_add(1, Ordering::SeqCst);
        }
        news.swap(0, Ordering::SeqCst)
    };
    assert!(read() > 0);
    for step in 1..10 {
        place(1.0 + f64::from(step) / 100.0);
    }
    assert_eq!(read(), 0);
    place(3.0);
    assert_eq!(read(), 1);
}
