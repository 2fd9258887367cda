//! Every interleaving of a few threads on `LeftRight` (`src/left_right.rs`): `cargo xtask loom`.
//!
//! The slot is modelled as a register that is read and exchanged in one step, which is what arc-swap promises; lock,
//! reference counts and threads are loom's. Two twins that are wrong on purpose show that the model would find it.
#![cfg(loom)]
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

#[path = "../src/left_right.rs"]
#[allow(dead_code, reason = "the cache is not modelled")]
mod left_right;

mod sync {
    pub(crate) use std::sync::PoisonError;

    pub(crate) use loom::sync::{Arc, Mutex, MutexGuard};

    pub(crate) struct Slot<T>(Mutex<Arc<T>>);

    impl<T> Slot<T> {
        pub(crate) fn new(value: Arc<T>) -> Self {
            Self(Mutex::new(value))
        }

        pub(crate) fn load(&self) -> Arc<T> {
            Arc::clone(&self.0.lock().unwrap())
        }

        pub(crate) fn swap(&self, value: Arc<T>) -> Arc<T> {
            std::mem::replace(&mut self.0.lock().unwrap(), value)
        }
    }
}

use left_right::{LeftRight, Twin};
use sync::Arc;

/// A number written twice: both or neither.
#[derive(Clone, Debug, PartialEq)]
struct Pair(u64, u64);

/// How the other twin is to follow an addition.
#[derive(Clone, Copy)]
enum Added {
    Told,
    /// Told so that it cannot follow, and finds out when half is done.
    Garbled,
}

impl Twin for Pair {
    type Change = Added;

    fn follow(&mut self, added: &Added) -> bool {
        self.0 += 1;
        match added {
            Added::Told => self.1 += 1,
            Added::Garbled => return false,
        }
        true
    }
}

fn add(pair: &LeftRight<Pair, u64>) -> u64 {
    add_with(pair, Some(Added::Told))
}

fn add_with(pair: &LeftRight<Pair, u64>, added: Option<Added>) -> u64 {
    let mut writing = pair.write();
    let pair = writing.next();
    pair.0 += 1;
    pair.1 += 1;
    let made = writing.publish(added).0.0;
    *writing.own() += 1;
    made
}

/// Explores with at most three preemptions: enough for every known kind of lost update, and done in seconds.
fn explore(run: impl Fn() + Send + Sync + 'static) {
    let mut builder = loom::model::Builder::new();
    builder.preemption_bound = Some(3);
    builder.check(run);
}

#[test]
fn no_update_is_lost_and_readers_see_whole_values_in_order() {
    explore(|| {
        let pair = Arc::new(LeftRight::new(Pair(0, 0), 0));
        let writers: Vec<_> = (0..2)
            .map(|_| {
                let pair = Arc::clone(&pair);
                loom::thread::spawn(move || {
                    let first = add(&pair);
                    assert!(add(&pair) > first, "a later update makes a later value");
                })
            })
            .collect();
        let first = pair.read();
        let then = (*first).clone();
        let second = pair.read();
        assert!(second.0 == second.1 && second.0 >= first.0, "whole, and not back in time");
        writers.into_iter().for_each(|writer| writer.join().unwrap());
        assert_eq!(*first, then, "what was read stays");
        assert_eq!((*pair.read()).clone(), Pair(4, 4));
        assert_eq!(*pair.write().own(), 4);
    });
}

#[test]
fn a_twin_that_cannot_follow_is_given_up() {
    explore(|| {
        let pair = Arc::new(LeftRight::new(Pair(0, 0), 0));
        let other = Arc::clone(&pair);
        let writer = loom::thread::spawn(move || {
            add_with(&other, None);
            add_with(&other, Some(Added::Garbled));
        });
        add(&pair);
        let seen = pair.read();
        add(&pair);
        assert!(seen.0 == seen.1 && (1..=3).contains(&seen.0), "whole");
        writer.join().unwrap();
        assert_eq!(*pair.read(), Pair(4, 4), "no update is lost");
    });
}

#[test]
fn what_is_given_up_or_taken_back_is_never_seen() {
    explore(|| {
        let pair = Arc::new(LeftRight::new(Pair(0, 0), 0));
        let other = Arc::clone(&pair);
        let writer = loom::thread::spawn(move || {
            // Begun and abandoned, as by a panic.
            other.write().next().0 += 7;
            // Begun and taken back.
            let mut writing = other.write();
            writing.next().0 += 7;
            writing.next().0 -= 7;
            writing.leave();
            drop(writing);
            add(&other);
        });
        add(&pair);
        let seen = pair.read();
        assert!(seen.0 == seen.1 && (1..=2).contains(&seen.0));
        writer.join().unwrap();
        assert_eq!(*pair.read(), Pair(2, 2));
    });
}

/// A twin that does not follow: the value goes back in time.
#[test]
#[should_panic(expected = "no update is lost")]
fn a_twin_that_does_not_follow_is_found() {
    #[derive(Clone)]
    struct Lazy(u64);

    impl Twin for Lazy {
        type Change = ();

        fn follow(&mut self, (): &()) -> bool {
            true
        }
    }

    explore(|| {
        let pair = Arc::new(LeftRight::new(Lazy(0), ()));
        for _ in 0..2 {
            let mut writing = pair.write();
            writing.next().0 += 1;
            writing.publish(Some(()));
        }
        assert_eq!(pair.read().0, 2, "no update is lost");
    });
}

/// Writers that forget the lock: lost updates, in some interleavings only.
#[test]
#[should_panic(expected = "no update is lost")]
fn writers_without_a_lock_are_found() {
    explore(|| {
        let slot = Arc::new(sync::Slot::new(Arc::new(0)));
        let writers: Vec<_> = (0..2)
            .map(|_| {
                let slot = Arc::clone(&slot);
                loom::thread::spawn(move || {
                    let next = *slot.load() + 1;
                    slot.swap(Arc::new(next));
                })
            })
            .collect();
        writers.into_iter().for_each(|writer| writer.join().unwrap());
        assert_eq!(*slot.load(), 2, "no update is lost");
    });
}
