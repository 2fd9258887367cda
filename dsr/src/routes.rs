//! Routes: from the changes of a commit to the subscribers whose pattern they may concern.
//!
//! Problem: asking a thousand subscribers one by one costs more than the commit. Idea: each pattern is listed under
//! what its atoms need (`index`): the token, and the constant node at an end if there is one, or else the types of the
//! ends and a clue of what must hold beside the change. A pattern with a named node is listed under the node of that
//! name, and listed anew when a node of that name is added or removed. Cost: a few hash look-ups per change, whatever
//! the number of subscribers.

mod index;

use std::sync::{Arc, Weak};

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use self::index::{Gone, Index};
use crate::delta::{Change, Delta};
use crate::pattern::{Pattern, Route};
use crate::state::State;
use crate::subscription::Queue;

/// A position in the list of subscribers.
type Seat = usize;

struct Subscriber {
    queue: Weak<Queue>,
    /// `None` for a subscriber to every commit.
    pattern: Option<Arc<Pattern>>,
    routes: Vec<Route>,
}

#[derive(Default)]
pub(crate) struct Routes {
    subscribers: Vec<Option<Subscriber>>,
    free: Vec<Seat>,
    every: Vec<Seat>,
    index: Index,
    by_name: FxHashMap<Arc<str>, SmallVec<[Seat; 2]>>,
    /// At this number of subscribers, dropped ones are removed.
    sweep: usize,
}

impl Routes {
    pub(crate) fn is_empty(&self) -> bool {
        self.subscribers.len() == self.free.len()
    }

    pub(crate) fn add(&mut self, queue: &Arc<Queue>, pattern: Option<Arc<Pattern>>, state: &State) {
        if self.subscribers.len() - self.free.len() >= self.sweep {
            let gone = |entry: &Option<Subscriber>| {
                entry.as_ref().is_some_and(|entry| entry.queue.strong_count() == 0)
            };
            let seats: Vec<_> =
                (0..self.subscribers.len()).filter(|&at| gone(&self.subscribers[at])).collect();
            seats.into_iter().for_each(|seat| self.remove(seat));
            self.sweep = 16.max(2 * (self.subscribers.len() - self.free.len()));
        }
        let routes = pattern.as_ref().map_or_else(Vec::new, |pattern| pattern.routes(state));
        let subscriber = Subscriber { queue: Arc::downgrade(queue), pattern, routes };
        let seat = self.free.pop().unwrap_or_else(|| {
            self.subscribers.push(None);
            self.subscribers.len() - 1
        });
        self.enlist(seat, &subscriber);
        self.subscribers[seat] = Some(subscriber);
    }

    /// Calls `tell` once for each subscriber that a delta may concern. `state` is the state after the delta.
    pub(crate) fn concerned(&mut self, delta: &Delta, state: &State, mut tell: impl FnMut(Arc<Queue>)) {
        let mut seats: SmallVec<[Seat; 16]> = self.every.iter().copied().collect();
        let mut anew: SmallVec<[Seat; 2]> = SmallVec::new();
        let gone = Gone::of(delta);
        for change in &delta.changes {
            self.index.find(change, &gone, state, |found| seats.extend_from_slice(found));
            if let Change::NodeAdded { name, .. } | Change::NodeRemoved { name, .. } = change {
                anew.extend(self.by_name.get(name).into_iter().flatten().copied());
            }
        }
        self.index.find_moved(delta, state, |found| seats.extend_from_slice(found));
        anew.sort_unstable();
        anew.dedup();
        seats.extend(anew.iter().copied());
        seats.sort_unstable();
        seats.dedup();
        for seat in anew {
            self.list_anew(seat, state);
        }
        for seat in seats {
            let queue = self.subscribers[seat].as_ref().map(|subscriber| subscriber.queue.upgrade());
            match queue {
                Some(Some(queue)) => tell(queue),
                Some(None) => self.remove(seat),
                None => {}
            }
        }
    }

    /// The queues of all subscribers.
    pub(crate) fn queues(&self) -> impl Iterator<Item = Arc<Queue>> {
        self.subscribers.iter().flatten().filter_map(|subscriber| subscriber.queue.upgrade())
    }

    fn enlist(&mut self, seat: Seat, subscriber: &Subscriber) {
        let Some(pattern) = &subscriber.pattern else {
            self.every.push(seat);
            return;
        };
        for route in &subscriber.routes {
            self.index.add(*route, seat);
        }
        for name in pattern.names() {
            self.by_name.entry(name.clone()).or_default().push(seat);
        }
    }

    fn strike(&mut self, seat: Seat, subscriber: &Subscriber) {
        self.every.retain(|other| *other != seat);
        for route in &subscriber.routes {
            self.index.remove(*route, seat);
        }
        for name in subscriber.pattern.iter().flat_map(|pattern| pattern.names()) {
            if let Some(seats) = self.by_name.get_mut(name) {
                seats.retain(|other| *other != seat);
                if seats.is_empty() {
                    self.by_name.remove(name);
                }
            }
        }
    }

    fn list_anew(&mut self, seat: Seat, state: &State) {
        if let Some(mut subscriber) = self.subscribers[seat].take() {
            self.strike(seat, &subscriber);
            subscriber.routes = subscriber.pattern.as_ref().map_or_else(Vec::new, |p| p.routes(state));
            self.enlist(seat, &subscriber);
            self.subscribers[seat] = Some(subscriber);
        }
    }

    fn remove(&mut self, seat: Seat) {
        if let Some(subscriber) = self.subscribers[seat].take() {
            self.strike(seat, &subscriber);
            self.free.push(seat);
        }
    }
}
