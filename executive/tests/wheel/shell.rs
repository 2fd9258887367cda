//! The shell on a clock that the test moves: nobody sleeps.

use crate::bench::{lamps, on_a};
use dsr::{Edit, Graph, Time, Transaction};
use executive::{Ending, Narration, Policy, Shell};
use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Notify;
use tokio::time::{Instant, advance};

/// The lighter, and what PELEA reports.
#[derive(Clone)]
struct Room {
    graph: Graph,
    epoch: Instant,
    told: Rc<RefCell<Vec<Narration>>>,
}

impl Room {
    /// Lets PELEA turn, and time pass, until it wants the lamp.
    async fn until_wanted(&self, lamp: &str) {
        let (news, deltas) = (Arc::new(Notify::new()), self.graph.subscribe_deltas());
        let wake = news.clone();
        deltas.on_wake(move || wake.notify_one());
        while !self.graph.snapshot().sentences().contains(&format!("{lamp} is wanted")) {
            news.notified().await;
        }
    }

    fn light(&self, lamp: &str) {
        let vocabulary = self.graph.vocabulary();
        let is = vocabulary.label("is").unwrap();
        let mut transaction = Transaction::new(vocabulary.agent("lighter").unwrap());
        transaction.push(Edit::AddEdge { from: lamp.into(), label: is, to: "lit".into() });
        let now = Time(u64::try_from(self.epoch.elapsed().as_nanos()).unwrap());
        self.graph.commit(&transaction, now).unwrap();
    }

    fn count(&self, matches: impl Fn(&Narration) -> bool) -> usize {
        self.told.borrow().iter().filter(|n| matches(n)).count()
    }
}

/// Runs PELEA beside what happens in the room.
fn run<F: Future<Output = ()>>(latency: Duration, happens: impl FnOnce(Room) -> F) -> (Ending, Room) {
    run_on(latency, None, happens)
}

/// The same with a disk on which it must be that a lamp is lit.
fn run_on<F: Future<Output = ()>>(
    latency: Duration,
    disk: Option<Arc<dyn Fn(dsr::Version) + Send + Sync>>,
    happens: impl FnOnce(Room) -> F,
) -> (Ending, Room) {
    let runtime =
        tokio::runtime::Builder::new_current_thread().enable_time().start_paused(true).build().unwrap();
    runtime.block_on(async {
        let (graph, wheel) = lamps(Policy::new(on_a("call")));
        let room = Room { graph: graph.clone(), epoch: Instant::now(), told: Rc::default() };
        let (writer, epoch) = (graph.vocabulary().agent("pelea").unwrap(), room.epoch);
        let told = room.told.clone();
        let lit = graph.vocabulary().label("is").unwrap();
        let tell = move |_: Time, narration: Narration| told.borrow_mut().push(narration);
        let shell = Shell {
            graph,
            writer,
            epoch,
            tell,
            latency: move |_| latency,
            record: |_: &executive::Turn<'_>| {},
            gives_way: false,
            lasting: executive::Lasting { labels: disk.iter().map(|_| lit).collect(), disk },
        };
        let wheel = wheel.with_pulse(Duration::from_secs(1));
        let (ending, ()) = tokio::join!(shell.run(wheel), happens(room.clone()));
        (ending, room)
    })
}

#[test]
fn breakage_8_a_clock_that_jumps_by_nine_seconds_condemns_no_lamp() {
    let (ending, room) = run(Duration::ZERO, |room| async move {
        room.until_wanted("a").await;
        // The process is stopped for longer than the five seconds that a lamp has.
        advance(Duration::from_secs(9)).await;
        tokio::task::yield_now().await;
        room.light("a");
        room.until_wanted("b").await;
        room.light("b");
    });
    assert_eq!(ending, Ending::Accomplished);
    assert_eq!(room.count(|n| matches!(n, Narration::Failed { .. })), 0, "{:?}", room.told);
    assert_eq!(room.count(|n| matches!(n, Narration::StoodStill { .. })), 1);
}

#[test]
fn breakage_16_a_decision_takes_its_time_on_the_simulated_clock() {
    let (ending, room) = run(Duration::from_secs(12), |room| async move {
        room.until_wanted("a").await;
        assert_eq!(room.epoch.elapsed(), Duration::from_secs(12));
        room.light("a");
        room.until_wanted("b").await;
        room.light("b");
    });
    assert_eq!(ending, Ending::Accomplished);
    // Longer than the ten seconds after which the fallback starts.
    assert_eq!(room.count(|n| matches!(n, Narration::FellBack { .. })), 1);
    assert_eq!(room.count(|n| matches!(n, Narration::Displaced { .. })), 1);
}

#[test]
fn what_must_last_is_on_disk_before_it_is_achieved() {
    let (write, written) = std::sync::mpsc::channel();
    let written = std::sync::Mutex::new(written);
    let (reach, reached) = tokio::sync::mpsc::unbounded_channel();
    let disk = move |version| {
        let _ = reach.send(version);
        let _ = written.lock().unwrap().recv();
    };
    let (ending, room) = run_on(Duration::ZERO, Some(Arc::new(disk)), |room| async move {
        let mut reached = reached;
        room.until_wanted("a").await;
        // Its own write has that label, too.
        reached.recv().await.unwrap();
        write.send(()).unwrap();
        room.light("a");
        let version = reached.recv().await.unwrap();
        assert_eq!(version, room.graph.snapshot().version());
        for _ in 0..10 {
            tokio::task::yield_now().await;
        }
        assert_eq!(room.count(|n| matches!(n, Narration::Achieved { .. })), 0, "{:?}", room.told);
        drop(write);
        room.until_wanted("b").await;
        assert_eq!(room.count(|n| matches!(n, Narration::Achieved { .. })), 1, "{:?}", room.told);
        room.light("b");
    });
    assert_eq!(ending, Ending::Accomplished);
    assert_eq!(room.count(|n| matches!(n, Narration::StoodStill { .. })), 0);
}

#[test]
fn what_the_executive_intends_goes_with_it() {
    let (ending, room) = run(Duration::ZERO, |room| async move {
        room.until_wanted("a").await;
        let pelea = room.graph.vocabulary().agent("pelea").unwrap();
        let gone = room.graph.expire(pelea, room.graph.snapshot().time()).unwrap();
        assert!(
            !gone.snapshot.sentences().contains(&"a is wanted".to_owned()),
            "{:?}",
            gone.snapshot.sentences()
        );
        // It is still there and goes on, although nothing guards what it writes next.
        room.light("a");
        room.until_wanted("b").await;
        room.light("b");
    });
    assert_eq!(ending, Ending::Accomplished);
    assert!(room.count(|n| matches!(n, Narration::Achieved { .. })) >= 1);
}
