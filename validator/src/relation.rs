//! The tuples of one predicate: the time of their last change, and look-up by pattern.
//!
//! A map from argument tuples to records that only grows: a deleted atom keeps its record, and with it the step that
//! deleted it. The position of a tuple in that map, its [`Slot`], never changes. Predicates that quantifiers, axioms
//! or universal effects look up by pattern are *indexed*: by a list of the slots that hold, one more list per object
//! and argument position, and a log of changed slots, from which axioms learn what to derive again.
//!
//! Invariant: the lists contain exactly the slots that hold, in an order that depends only on the changes made. So a
//! plan that visits a hundred thousand tuples once each does not scan those that it left.
//!
//! Cost: one hash of the arguments per look-up or change; with an index, a change costs two more per argument.

use indexmap::IndexMap;
use pddl::model::ObjectId;
use rustc_hash::{FxBuildHasher, FxHashMap};

/// A moment of the plan: 0 before the first step, `n` after step `n`.
pub(crate) type Moment = u32;

/// A tuple's place in its relation.
pub(crate) type Slot = u32;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Record {
    pub(crate) holds: bool,
    /// The moment of its last change.
    pub(crate) since: Moment,
    /// The moment when it was last added, necessary or not: an add wins over a delete of the same
    /// moment.
    added: Moment,
}

/// A position in the log, up to which a reader has read it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Mark {
    epoch: u32,
    read: usize,
}

#[derive(Clone, Debug)]
struct Index {
    live: Vec<Slot>,
    positions: Vec<FxHashMap<ObjectId, Vec<Slot>>>,
    /// For each slot that holds: its position in `live`, then in the list of each of its arguments.
    places: Vec<u32>,
    /// Slots that were added or deleted.
    log: Vec<Slot>,
    /// The number of times that the log was truncated.
    epoch: u32,
}

fn small(length: usize) -> u32 {
    u32::try_from(length).expect("fewer than 2^32 atoms fit into memory")
}

impl Index {
    fn stride(&self) -> usize {
        self.positions.len() + 1
    }

    fn list(&mut self, slot: Slot, arguments: &[ObjectId]) {
        let base = slot as usize * self.stride();
        if self.places.len() < base + self.stride() {
            self.places.resize(base + self.stride(), 0);
        }
        self.places[base] = small(self.live.len());
        self.live.push(slot);
        for (position, (lists, &object)) in self.positions.iter_mut().zip(arguments).enumerate() {
            let slots = lists.entry(object).or_default();
            self.places[base + 1 + position] = small(slots.len());
            slots.push(slot);
        }
    }

    fn unlist(&mut self, slot: Slot, arguments: &[ObjectId]) {
        let stride = self.stride();
        let base = slot as usize * stride;
        let place = self.places[base] as usize;
        self.live.swap_remove(place);
        if let Some(&moved) = self.live.get(place) {
            self.places[moved as usize * stride] = small(place);
        }
        for (position, (lists, object)) in self.positions.iter_mut().zip(arguments).enumerate() {
            let place = self.places[base + 1 + position] as usize;
            let Some(slots) = lists.get_mut(object) else { continue };
            slots.swap_remove(place);
            if let Some(&moved) = slots.get(place) {
                self.places[moved as usize * stride + 1 + position] = small(place);
            }
        }
    }

    fn note(&mut self, slot: Slot, tuples: usize) {
        // A reader of a log that is longer than the relation had better read the relation.
        if self.log.len() > 8 * tuples + 1024 {
            self.log.clear();
            self.epoch += 1;
        }
        self.log.push(slot);
    }
}

/// The extension of one predicate.
#[derive(Clone, Debug, Default)]
pub(crate) struct Relation {
    records: IndexMap<Box<[ObjectId]>, Record, FxBuildHasher>,
    index: Option<Index>,
}

impl Relation {
    pub(crate) fn plain() -> Self {
        Self::default()
    }

    pub(crate) fn indexed(arity: usize) -> Self {
        let index = Index {
            live: Vec::new(),
            positions: vec![FxHashMap::default(); arity],
            places: Vec::new(),
            log: Vec::new(),
            epoch: 0,
        };
        Self { records: IndexMap::default(), index: Some(index) }
    }

    pub(crate) fn record(&self, arguments: &[ObjectId]) -> Option<Record> {
        self.records.get(arguments).copied()
    }

    pub(crate) fn holds(&self, arguments: &[ObjectId]) -> bool {
        self.records.get(arguments).is_some_and(|r| r.holds)
    }

    /// Adds a tuple. Returns whether it is new.
    pub(crate) fn add(&mut self, arguments: &[ObjectId], now: Moment) -> bool {
        self.add_slot(arguments, now).is_some()
    }

    /// Adds a tuple. Returns its slot if it is new.
    pub(crate) fn add_slot(&mut self, arguments: &[ObjectId], now: Moment) -> Option<Slot> {
        let slot = if let Some((slot, _, record)) = self.records.get_full_mut(arguments) {
            record.added = now;
            if record.holds {
                return None;
            }
            record.holds = true;
            record.since = now;
            slot
        } else {
            let record = Record { holds: true, since: now, added: now };
            self.records.insert_full(arguments.into(), record).0
        };
        let slot = small(slot);
        if let Some(index) = &mut self.index {
            index.list(slot, arguments);
            index.note(slot, self.records.len());
        }
        Some(slot)
    }

    /// Deletes a tuple, unless it was added at the same moment. Returns whether it held.
    pub(crate) fn delete(&mut self, arguments: &[ObjectId], now: Moment) -> bool {
        match self.records.get_full_mut(arguments) {
            Some((slot, _, record)) if record.holds && record.added != now => {
                self.drop_slot(small(slot), now);
                true
            }
            _ => false,
        }
    }

    /// Deletes a tuple that holds.
    pub(crate) fn drop_slot(&mut self, slot: Slot, now: Moment) {
        let Some((arguments, record)) = self.records.get_index_mut(slot as usize) else { return };
        record.holds = false;
        record.since = now;
        if let Some(index) = &mut self.index {
            index.unlist(slot, arguments);
            index.note(slot, self.records.len());
        }
    }

    /// Makes a tuple hold again.
    pub(crate) fn restore(&mut self, slot: Slot, now: Moment) {
        let Some((arguments, record)) = self.records.get_index_mut(slot as usize) else { return };
        record.holds = true;
        record.since = now;
        record.added = now;
        if let Some(index) = &mut self.index {
            index.list(slot, arguments);
            index.note(slot, self.records.len());
        }
    }

    /// The tuple at a slot.
    pub(crate) fn tuple(&self, slot: Slot) -> &[ObjectId] {
        self.records.get_index(slot as usize).map_or(&[], |(arguments, _)| arguments)
    }

    /// The slot of a tuple, if it holds.
    pub(crate) fn slot(&self, arguments: &[ObjectId]) -> Option<Slot> {
        self.records.get_full(arguments).and_then(|(slot, _, record)| record.holds.then_some(small(slot)))
    }

    /// Whether the tuple at a slot holds.
    pub(crate) fn slot_holds(&self, slot: Slot) -> bool {
        self.records.get_index(slot as usize).is_some_and(|(_, record)| record.holds)
    }

    /// All slots.
    pub(crate) fn slots(&self) -> impl Iterator<Item = Slot> + use<> {
        0..small(self.records.len())
    }

    /// The slots that hold, if the relation is indexed.
    pub(crate) fn live(&self) -> &[Slot] {
        self.index.as_ref().map_or(&[], |index| &index.live)
    }

    /// The number of tuples that hold, if the relation is indexed.
    pub(crate) fn len(&self) -> usize {
        self.live().len()
    }

    /// The tuples that hold, in order of first appearance.
    pub(crate) fn holding(&self) -> impl Iterator<Item = &[ObjectId]> {
        self.records.iter().filter(|(_, record)| record.holds).map(|(arguments, _)| &**arguments)
    }

    /// The end of the log.
    pub(crate) fn mark(&self) -> Mark {
        self.index
            .as_ref()
            .map_or(Mark { epoch: 0, read: 0 }, |index| Mark { epoch: index.epoch, read: index.log.len() })
    }

    /// The slots that hold either now or at `since`, but not both, in order; `None` if the log was
    /// truncated since.
    pub(crate) fn toggled(&self, since: Mark) -> Option<Vec<Slot>> {
        let index = self.index.as_ref()?;
        let entries = index.log.get(since.read..).filter(|_| index.epoch == since.epoch)?;
        let mut entries = entries.to_vec();
        entries.sort_unstable();
        // A slot that was changed twice has its old value.
        let odd = entries.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1).map(|same| same[0]);
        Some(odd.collect())
    }

    /// Temporarily makes deleted tuples hold again, without an entry in the log.
    pub(crate) fn revive(&mut self, slots: &[Slot]) {
        for &slot in slots {
            let Some((arguments, record)) = self.records.get_index_mut(slot as usize) else { continue };
            record.holds = true;
            if let Some(index) = &mut self.index {
                index.list(slot, arguments);
            }
        }
    }

    /// Undoes [`Relation::revive`].
    pub(crate) fn bury(&mut self, slots: &[Slot]) {
        for &slot in slots {
            let Some((arguments, record)) = self.records.get_index_mut(slot as usize) else { continue };
            record.holds = false;
            if let Some(index) = &mut self.index {
                index.unlist(slot, arguments);
            }
        }
    }

    /// An upper bound on the number of tuples that agree with `fixed` (`None` is free).
    pub(crate) fn estimate(&self, fixed: impl Iterator<Item = Option<ObjectId>>) -> usize {
        match &self.index {
            Some(index) => index.narrowest(fixed).len(),
            None => self.records.len(),
        }
    }

    /// The tuples that hold among those that may agree with `fixed`.
    pub(crate) fn candidates(&self, fixed: &[Option<ObjectId>]) -> impl Iterator<Item = &[ObjectId]> {
        let (slots, all) = match &self.index {
            Some(index) => (index.narrowest(fixed.iter().copied()), 0),
            None => (&[] as &[Slot], self.records.len()),
        };
        let slots = slots.iter().map(|&slot| slot as usize);
        slots.chain(0..all).filter_map(|slot| {
            let (arguments, record) = self.records.get_index(slot)?;
            record.holds.then_some(&**arguments)
        })
    }
}

impl Index {
    /// The shortest list in which all that agree with `fixed` are.
    fn narrowest(&self, fixed: impl Iterator<Item = Option<ObjectId>>) -> &[Slot] {
        self.positions
            .iter()
            .zip(fixed)
            .filter_map(|(position, object)| {
                object.map(|o| position.get(&o).map_or(&[] as &[Slot], Vec::as_slice))
            })
            .min_by_key(|slots| slots.len())
            .unwrap_or(&self.live)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    type Pair = [ObjectId; 2];

    fn found(relation: &Relation, fixed: [Option<ObjectId>; 2]) -> BTreeSet<Pair> {
        let agrees = |tuple: &Pair| fixed.iter().zip(tuple).all(|(fixed, o)| fixed.is_none_or(|f| f == *o));
        let pair = |tuple: &[ObjectId]| [tuple[0], tuple[1]];
        let all: Vec<Pair> = relation.candidates(&fixed).map(pair).filter(agrees).collect();
        let set: BTreeSet<Pair> = all.iter().copied().collect();
        assert_eq!(all.len(), set.len(), "each once");
        set
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn patterns_and_the_log_tell_what_holds(
            changes in prop::collection::vec((any::<bool>(), 0_u32..4, 0_u32..4), 0..60),
            marked in 0_usize..60,
            pattern in [prop::option::of(0_u32..4), prop::option::of(0_u32..4)],
        ) {
            let (mut indexed, mut plain) = (Relation::indexed(2), Relation::plain());
            let mut model = BTreeSet::<Pair>::new();
            let (mut mark, mut before) = (indexed.mark(), model.clone());
            for (now, (number, (add, a, b))) in (1..).zip(changes.into_iter().enumerate()) {
                if number == marked {
                    (mark, before) = (indexed.mark(), model.clone());
                }
                let tuple = [ObjectId(a), ObjectId(b)];
                for relation in [&mut indexed, &mut plain] {
                    let changed = if add { relation.add(&tuple, now) } else { relation.delete(&tuple, now) };
                    prop_assert_eq!(changed, model.contains(&tuple) != add);
                }
                let _changed = if add { model.insert(tuple) } else { model.remove(&tuple) };
            }
            let fixed = pattern.map(|object| object.map(ObjectId));
            let agrees = |tuple: &&Pair| fixed.iter().zip(*tuple).all(|(f, o)| f.is_none_or(|f| f == *o));
            let expected: BTreeSet<Pair> = model.iter().filter(agrees).copied().collect();
            prop_assert_eq!(&found(&indexed, fixed), &expected);
            prop_assert_eq!(&found(&plain, fixed), &expected);
            let toggled = indexed.toggled(mark).expect("the log is short");
            let told: BTreeSet<Pair> = toggled.iter().map(|&s| [indexed.tuple(s)[0], indexed.tuple(s)[1]]).collect();
            prop_assert_eq!(told, model.symmetric_difference(&before).copied().collect::<BTreeSet<_>>());
            // For a while what was taken back holds too.
            let gone: Vec<Slot> = toggled.into_iter().filter(|&slot| !indexed.slot_holds(slot)).collect();
            indexed.revive(&gone);
            prop_assert_eq!(found(&indexed, [None, None]), model.union(&before).copied().collect::<BTreeSet<_>>());
            indexed.bury(&gone);
            prop_assert_eq!(found(&indexed, [None, None]), model);
        }
    }
}
