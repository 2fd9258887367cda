//! Which running actions must be checked again after a change.
//!
//! Problem: evaluating the `over all` conditions of ten thousand actions at each of ten thousand happenings takes too
//! long. Idea: a condition keeps its truth while its atoms and fluents keep their values. So each action is listed
//! under everything that its conditions read ([`Key`]). A change makes the actions under it *due*, and only these are
//! evaluated.
//!
//! The object of a quantified variable is not known in advance. Such an atom is listed under one known argument, or
//! else under its predicate. A derived predicate stands for the predicates and functions below it. A condition that
//! reads the time is always due.
//!
//! Invariant: the conditions of an action that is not due still hold.
//!
//! Cost: of a change, one look-up (three with open variables) and the actions listed there; of an action, the size of
//! its conditions.

use super::footprint::Dependencies;
use crate::axiom::Strata;
use crate::effect::Changes;
use crate::reads::each_function;
use crate::scene::Binding;
use crate::value::GroundAtom;
use pddl::model::{
    Condition, ConditionKind, Domain, Expression, ExpressionKind, FunctionId, GroundApplication, ObjectId,
    PredicateId, Term,
};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;
use std::hash::Hash;

/// The number of a durative action that has started.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Ticket(pub(super) u32);

/// The key of something that a condition reads.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Key {
    Atom(GroundAtom),
    /// Any atom with this object at this position.
    AtomWith(PredicateId, usize, ObjectId),
    Predicate(PredicateId),
    Fluent(GroundApplication),
    /// Any fluent with this object at this position.
    FluentWith(FunctionId, usize, ObjectId),
    Function(FunctionId),
}

/// The reads of one action's conditions.
#[derive(Clone, Debug, Default)]
pub(super) struct Reads {
    keys: Vec<Key>,
    time: bool,
}

impl Reads {
    /// The fluents; `None` if some of them are unknown.
    pub(super) fn fluents(&self) -> Option<impl Iterator<Item = &GroundApplication>> {
        let open = |key: &Key| matches!(key, Key::FluentWith(..) | Key::Function(_));
        (!self.keys.iter().any(open)).then(|| {
            self.keys.iter().filter_map(|key| match key {
                Key::Fluent(fluent) => Some(fluent),
                _ => None,
            })
        })
    }

    /// Removes duplicates.
    pub(super) fn settle(&mut self) {
        if self.keys.len() > 1 {
            let keys: FxHashSet<Key> = self.keys.drain(..).collect();
            self.keys.extend(keys);
        }
    }
}

/// The basic predicates and functions below derived predicates.
#[derive(Debug)]
pub(super) struct Basis<'v> {
    strata: &'v Strata,
    predicates: FxHashMap<PredicateId, Vec<PredicateId>>,
    functions: FxHashMap<PredicateId, Vec<FunctionId>>,
}

impl<'v> Basis<'v> {
    pub(super) fn new(domain: &Domain, strata: &'v Strata, dependencies: &Dependencies) -> Self {
        let mut basis = Self { strata, predicates: FxHashMap::default(), functions: FxHashMap::default() };
        for (derived, below) in dependencies.each() {
            let mut below = below.clone();
            below.insert(derived);
            let mut functions = FxHashSet::default();
            for axiom in domain.axioms.iter().filter(|axiom| below.contains(&axiom.predicate)) {
                each_function(&axiom.body, &mut |function| {
                    functions.insert(function);
                });
            }
            basis.predicates.insert(derived, below.into_iter().collect());
            basis.functions.insert(derived, functions.into_iter().collect());
        }
        basis
    }

    /// Collects the reads of a condition; variables of quantifiers are unbound.
    pub(super) fn condition(&self, condition: &Condition, binding: &Binding, into: &mut Reads) {
        match &condition.kind {
            ConditionKind::Atom(atom) if self.strata.derives(atom.predicate) => {
                let predicates = self.predicates.get(&atom.predicate).into_iter().flatten();
                let functions = self.functions.get(&atom.predicate).into_iter().flatten();
                into.keys.extend(predicates.map(|&predicate| Key::Predicate(predicate)));
                into.keys.extend(functions.map(|&function| Key::Function(function)));
            }
            ConditionKind::Atom(atom) => {
                let predicate = atom.predicate;
                into.keys.push(match known(&atom.arguments, binding) {
                    Known::All(arguments) => Key::Atom(GroundAtom { predicate, arguments: arguments.into() }),
                    Known::One(place, object) => Key::AtomWith(predicate, place, object),
                    Known::None => Key::Predicate(predicate),
                });
            }
            ConditionKind::Compare(_, left, right) => {
                expression(left, binding, into);
                expression(right, binding, into);
            }
            ConditionKind::FluentIs(application, _) => {
                into.keys.push(fluent(application.function, &application.arguments, binding));
            }
            _ => condition.parts().for_each(|part| self.condition(part, binding, into)),
        }
    }
}

/// The arguments whose objects are known outside all quantifiers.
enum Known {
    All(Vec<ObjectId>),
    One(usize, ObjectId),
    None,
}

fn known(arguments: &[Term], binding: &Binding) -> Known {
    if let Some(objects) = arguments.iter().map(|&term| binding.term(term)).collect() {
        return Known::All(objects);
    }
    let mut places = arguments.iter().enumerate();
    match places.find_map(|(place, &term)| Some((place, binding.term(term)?))) {
        Some((place, object)) => Known::One(place, object),
        None => Known::None,
    }
}

fn fluent(function: FunctionId, arguments: &[Term], binding: &Binding) -> Key {
    match known(arguments, binding) {
        Known::All(arguments) => Key::Fluent(GroundApplication { function, arguments }),
        Known::One(place, object) => Key::FluentWith(function, place, object),
        Known::None => Key::Function(function),
    }
}

fn expression(expression: &Expression, binding: &Binding, into: &mut Reads) {
    expression.each(&mut |part| match &part.kind {
        ExpressionKind::Fluent(application) => {
            into.keys.push(fluent(application.function, &application.arguments, binding));
        }
        ExpressionKind::TotalTime | ExpressionKind::IsViolated(_) => into.time = true,
        ExpressionKind::Number(_) | ExpressionKind::Duration | ExpressionKind::Arithmetic(..) => {}
    });
}

/// The running actions, by their reads.
#[derive(Debug, Default)]
pub(super) struct Watch {
    by_key: FxHashMap<Key, BTreeSet<Ticket>>,
    /// Predicates and functions that have other keys than atoms and fluents.
    open_predicates: FxHashSet<PredicateId>,
    open_functions: FxHashSet<FunctionId>,
    running: BTreeSet<Ticket>,
    /// The actions that read the time.
    always: BTreeSet<Ticket>,
    due: BTreeSet<Ticket>,
}

impl Watch {
    /// Adds an action, which is due.
    pub(super) fn join(&mut self, ticket: Ticket, reads: &Reads) {
        for key in &reads.keys {
            match *key {
                Key::Atom(_) | Key::Fluent(_) => {}
                Key::AtomWith(predicate, ..) | Key::Predicate(predicate) => {
                    self.open_predicates.insert(predicate);
                }
                Key::FluentWith(function, ..) | Key::Function(function) => {
                    self.open_functions.insert(function);
                }
            }
            self.by_key.entry(key.clone()).or_default().insert(ticket);
        }
        if reads.time {
            self.always.insert(ticket);
        }
        self.running.insert(ticket);
        self.due.insert(ticket);
    }

    pub(super) fn leave(&mut self, ticket: Ticket, reads: &Reads) {
        for key in &reads.keys {
            if let Some(tickets) = self.by_key.get_mut(key) {
                tickets.remove(&ticket);
                if tickets.is_empty() {
                    self.by_key.remove(key);
                }
            }
        }
        self.always.remove(&ticket);
        self.running.remove(&ticket);
        self.due.remove(&ticket);
    }

    /// Makes the actions due that read a changed atom or fluent.
    pub(super) fn changed(&mut self, changes: &Changes) {
        if self.by_key.is_empty() {
            return;
        }
        changes.each_add(|atom| self.atom(atom));
        changes.each_delete(|atom| self.atom(atom));
        changes.each_write(|fluent, _| self.flowed(fluent));
    }

    fn atom(&mut self, atom: GroundAtom) {
        let predicate = atom.predicate;
        if self.open_predicates.contains(&predicate) {
            for (place, &object) in atom.arguments.iter().enumerate() {
                self.call(&Key::AtomWith(predicate, place, object));
            }
            self.call(&Key::Predicate(predicate));
        }
        self.call(&Key::Atom(atom));
    }

    /// Makes the actions due that read the fluent.
    pub(super) fn flowed(&mut self, fluent: &GroundApplication) {
        let Self { by_key, open_functions, due, .. } = self;
        each_reader(by_key, open_functions, fluent, &mut |tickets| due.extend(tickets));
    }

    fn call(&mut self, key: &Key) {
        if let Some(tickets) = self.by_key.get(key) {
            self.due.extend(tickets);
        }
    }

    /// Makes all running actions due.
    pub(super) fn all_changed(&mut self) {
        self.due.extend(&self.running);
    }

    /// Returns and clears the due actions, in the order of their starts.
    pub(super) fn due(&mut self) -> BTreeSet<Ticket> {
        let mut due = std::mem::take(&mut self.due);
        due.extend(&self.always);
        due
    }

    /// The actions that read the time.
    pub(super) fn always(&self) -> impl Iterator<Item = Ticket> {
        self.always.iter().copied()
    }

    /// The actions that read one of the fluents, or the time.
    pub(super) fn readers<'f>(
        &self,
        fluents: impl Iterator<Item = &'f GroundApplication>,
    ) -> BTreeSet<Ticket> {
        let mut readers = self.always.clone();
        if !self.by_key.is_empty() {
            for fluent in fluents {
                let mut add = |tickets: &BTreeSet<Ticket>| readers.extend(tickets);
                each_reader(&self.by_key, &self.open_functions, fluent, &mut add);
            }
        }
        readers
    }
}

fn each_reader(
    by_key: &FxHashMap<Key, BTreeSet<Ticket>>,
    open: &FxHashSet<FunctionId>,
    fluent: &GroundApplication,
    visit: &mut dyn FnMut(&BTreeSet<Ticket>),
) {
    let mut look_up = |key| by_key.get(&key).into_iter().for_each(&mut *visit);
    if open.contains(&fluent.function) {
        for (place, &object) in fluent.arguments.iter().enumerate() {
            look_up(Key::FluentWith(fluent.function, place, object));
        }
        look_up(Key::Function(fluent.function));
    }
    look_up(Key::Fluent(fluent.clone()));
}
