//! Routes: from the changes of a commit to the subscribers whose pattern they may concern.
//!
//! Problem: asking a thousand subscribers one by one costs more than the commit. Idea: each pattern is listed under
//! what its atoms need (`index`): the token, and the constant node at an end if there is one, or else the types of the
//! ends and a clue of what must hold beside the change. A pattern with a named node is listed under the node of that
//! name, and listed anew when a node of that name is added or removed.
//! Tokens are routes without a node; the commits and the reflexes of an agent have lists of their own. Cost: a few hash look-ups per change, whatever
//! the number of subscribers.

mod index;

use std::sync::{Arc, Weak};

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use self::index::{Gone, Index, Seat, Seats};
use crate::delta::{Change, Delta};
use crate::id::{AgentId, TypeId};
use crate::interest::Interest;
use crate::mentions::Mentions;
use crate::pattern::{Clue, Route};
use crate::state::State;
use crate::subscription::Queue;

struct Subscriber {
    queue: Weak<Queue>,
    /// `None` for a subscriber to every commit.
    interest: Option<Arc<Interest>>,
    routes: Vec<Route>,
}

#[derive(Default)]
pub(crate) struct Routes {
    subscribers: Vec<Option<Subscriber>>,
    free: Vec<Seat>,
    every: Vec<Seat>,
    index: Index,
    by_name: FxHashMap<Arc<str>, Seats>,
    /// Those that want every commit of an agent.
    by_writer: FxHashMap<AgentId, Seats>,
    /// Those that want every commit in which a reflex of an agent fires.
    by_owner: FxHashMap<AgentId, Seats>,
    /// At this number of subscribers, dropped ones are removed.
    sweep: usize,
}

impl Routes {
    pub(crate) fn is_empty(&self) -> bool {
        self.subscribers.len() == self.free.len()
    }

    pub(crate) fn add(&mut self, queue: &Arc<Queue>, interest: Option<Arc<Interest>>, state: &State) {
        if self.subscribers.len() - self.free.len() >= self.sweep {
            let gone = |entry: &Option<Subscriber>| {
                entry.as_ref().is_some_and(|entry| entry.queue.strong_count() == 0)
            };
            let seats: Vec<_> =
                (0..self.subscribers.len()).filter(|&at| gone(&self.subscribers[at])).collect();
            seats.into_iter().for_each(|seat| self.remove(seat));
            self.sweep = 16.max(2 * (self.subscribers.len() - self.free.len()));
        }
        let routes = interest.as_ref().map_or_else(Vec::new, |interest| routes(interest, state));
        let subscriber = Subscriber { queue: Arc::downgrade(queue), interest, routes };
        let seat = self.free.pop().unwrap_or_else(|| {
            self.subscribers.push(None);
            self.subscribers.len() - 1
        });
        self.enlist(seat, &subscriber);
        self.subscribers[seat] = Some(subscriber);
    }

    /// Calls `tell` for each subscriber that a delta may concern, once; the state is the one after it, and `owners`
    /// are the agents whose reflexes fired.
    pub(crate) fn concerned(
        &mut self,
        delta: &Delta,
        state: &State,
        owners: &[AgentId],
        mut tell: impl FnMut(Arc<Queue>),
    ) {
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
        seats.extend(self.by_writer.get(&delta.writer).into_iter().flatten().copied());
        seats.extend(owners.iter().filter_map(|owner| self.by_owner.get(owner)).flatten().copied());
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
        let Some(interest) = &subscriber.interest else {
            self.every.push(seat);
            return;
        };
        for route in &subscriber.routes {
            self.index.add(*route, seat);
        }
        for name in names(interest) {
            add(self.by_name.entry(name.clone()).or_default(), seat);
        }
        if let Some(writer) = interest.writer() {
            add(self.by_writer.entry(writer).or_default(), seat);
        }
        if let Some(owner) = interest.owner() {
            add(self.by_owner.entry(owner).or_default(), seat);
        }
    }

    fn strike(&mut self, seat: Seat, subscriber: &Subscriber) {
        self.every.retain(|other| *other != seat);
        for route in &subscriber.routes {
            self.index.remove(*route, seat);
        }
        let Some(interest) = &subscriber.interest else { return };
        for name in names(interest) {
            remove(&mut self.by_name, name, seat);
        }
        if let Some(writer) = interest.writer() {
            remove(&mut self.by_writer, &writer, seat);
        }
        if let Some(owner) = interest.owner() {
            remove(&mut self.by_owner, &owner, seat);
        }
    }

    fn list_anew(&mut self, seat: Seat, state: &State) {
        if let Some(mut subscriber) = self.subscribers[seat].take() {
            self.strike(seat, &subscriber);
            subscriber.routes = subscriber.interest.as_ref().map_or_else(Vec::new, |i| routes(i, state));
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

/// The routes by which changes reach a subscriber, with the constants of this state.
fn routes(interest: &Interest, state: &State) -> Vec<Route> {
    let of_patterns = interest.patterns().flat_map(|pattern| pattern.routes(state));
    of_patterns.chain(routes_of_tokens(interest.tokens())).collect()
}

fn routes_of_tokens(tokens: &Mentions) -> impl Iterator<Item = Route> + '_ {
    let any = |label| Route::Edge(label, TypeId::OBJECT, TypeId::OBJECT, Clue::Any);
    let edges = tokens.labels().map(any);
    edges
        .chain(tokens.attributes().map(Route::Attribute))
        .chain(tokens.types().map(Route::Type))
        .chain(tokens.transforms().then_some(Route::AnyTransform))
}

/// The names of nodes that the patterns of an interest speak of.
fn names(interest: &Interest) -> impl Iterator<Item = &Arc<str>> {
    interest.patterns().flat_map(|pattern| pattern.names())
}

fn add(seats: &mut Seats, seat: Seat) {
    if !seats.contains(&seat) {
        seats.push(seat);
    }
}

/// Strikes a seat from a list, and a list that is empty then.
fn remove<K: std::hash::Hash + Eq>(lists: &mut FxHashMap<K, Seats>, key: &K, seat: Seat) {
    if let Some(seats) = lists.get_mut(key) {
        seats.retain(|other| *other != seat);
        if seats.is_empty() {
            lists.remove(key);
        }
    }
}
