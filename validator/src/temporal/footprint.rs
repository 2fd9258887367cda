//! The reads and changes of a happening, and whether two simultaneous happenings interfere.
//!
//! Two happenings may be simultaneous only if their order does not matter. Neither may change an atom that the other
//! reads or changes to the opposite, or a fluent that the other reads. Both may change a fluent only by increasing
//! and decreasing it. A condition reads every atom and fluent in it, relevant to its truth or not, with quantifiers
//! expanded. A derived predicate reads every atom of the predicates that it depends on. Cost: the size of the
//! expanded conditions, so only happenings closer to another one than the separation have a footprint.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, Definition 12 (mutex actions, the rule of no moving targets). Deviation:
//! conditions of conditional effects, preferences, and bounds of durations count as read.

use crate::axiom::Strata;
use crate::effect::{Changes, Write};
use crate::reads::each_predicate;
use crate::scene::{Binding, Scene, each_instance};
use crate::state::State;
use crate::value::GroundAtom;
use crate::verdict::Shared;
use pddl::model::{
    Application, AssignedValue, Condition, ConditionKind, Domain, Effect, EffectKind, Expression,
    ExpressionKind, GroundApplication, PredicateId,
};
use rustc_hash::{FxHashMap, FxHashSet};

/// The reads and changes of a happening.
#[derive(Clone, Debug, Default)]
pub(super) struct Footprint {
    needed: FxHashSet<GroundAtom>,
    /// Predicates that a needed derived predicate depends on, each with that derived predicate.
    below: FxHashMap<PredicateId, PredicateId>,
    read: FxHashSet<GroundApplication>,
    added: FxHashSet<GroundAtom>,
    deleted: FxHashSet<GroundAtom>,
    written: FxHashMap<GroundApplication, Write>,
}

/// For each derived predicate, the predicates that it depends on.
#[derive(Clone, Debug)]
pub(super) struct Dependencies(FxHashMap<PredicateId, FxHashSet<PredicateId>>);

impl Dependencies {
    /// The derived predicates, each with the predicates that it depends on.
    pub(super) fn each(&self) -> impl Iterator<Item = (PredicateId, &FxHashSet<PredicateId>)> {
        self.0.iter().map(|(&derived, below)| (derived, below))
    }

    pub(super) fn new(domain: &Domain) -> Self {
        let mut below: FxHashMap<PredicateId, FxHashSet<PredicateId>> = FxHashMap::default();
        for axiom in &domain.axioms {
            let reads = below.entry(axiom.predicate).or_default();
            each_predicate(&axiom.body, true, &mut |predicate, _| {
                reads.insert(predicate);
            });
        }
        loop {
            let mut grown = false;
            for derived in below.keys().copied().collect::<Vec<_>>() {
                let further: Vec<PredicateId> =
                    below[&derived].iter().filter_map(|p| below.get(p)).flatten().copied().collect();
                if let Some(reads) = below.get_mut(&derived) {
                    for predicate in further {
                        grown |= reads.insert(predicate);
                    }
                }
            }
            if !grown {
                return Self(below);
            }
        }
    }
}

/// Collects a footprint.
pub(super) struct Reader<'a> {
    pub(super) scene: Scene<'a>,
    pub(super) strata: &'a Strata,
    pub(super) dependencies: &'a Dependencies,
}

impl Reader<'_> {
    pub(super) fn condition(&self, condition: &Condition, binding: &mut Binding, into: &mut Footprint) {
        match &condition.kind {
            ConditionKind::Exists(variables, body) | ConditionKind::Forall(variables, body) => {
                each_instance(self.scene, variables, binding, &mut |binding| {
                    self.condition(body, binding, into);
                });
            }
            ConditionKind::Atom(atom) if self.strata.derives(atom.predicate) => {
                if let Some(below) = self.dependencies.0.get(&atom.predicate) {
                    into.below.extend(below.iter().map(|&base| (base, atom.predicate)));
                }
            }
            ConditionKind::Atom(atom) => {
                let arguments = atom.arguments.iter().map(|&t| binding.object(t)).collect();
                into.needed.insert(GroundAtom { predicate: atom.predicate, arguments });
            }
            ConditionKind::Compare(_, left, right) => {
                self.expression(left, binding, into);
                self.expression(right, binding, into);
            }
            ConditionKind::FluentIs(application, _) => {
                into.read.insert(self.scene.ground(application, binding));
            }
            _ => condition.parts().for_each(|part| self.condition(part, binding, into)),
        }
    }

    pub(super) fn application(&self, application: &Application, binding: &Binding, into: &mut Footprint) {
        into.read.insert(self.scene.ground(application, binding));
    }

    pub(super) fn expression(&self, expression: &Expression, binding: &Binding, into: &mut Footprint) {
        expression.each(&mut |part| {
            if let ExpressionKind::Fluent(application) = &part.kind {
                into.read.insert(self.scene.ground(application, binding));
            }
        });
    }

    /// Collects the reads of an effect: its conditions, and the fluents in its values.
    pub(super) fn effect(&self, effect: &Effect, binding: &mut Binding, into: &mut Footprint) {
        match &effect.kind {
            EffectKind::And(parts) => parts.iter().for_each(|part| self.effect(part, binding, into)),
            EffectKind::Forall(variables, body) => {
                each_instance(self.scene, variables, binding, &mut |binding| {
                    self.effect(body, binding, into);
                });
            }
            EffectKind::When(guard, body) => {
                self.condition(guard, binding, into);
                self.effect(body, binding, into);
            }
            EffectKind::Assign(_, _, AssignedValue::Number(value)) => self.expression(value, binding, into),
            EffectKind::Assign(..) | EffectKind::Add(_) | EffectKind::Delete(_) => {}
        }
    }
}

impl Footprint {
    pub(super) fn changes(&mut self, changes: &Changes) {
        changes.each_add(|atom| {
            self.added.insert(atom);
        });
        changes.each_delete(|atom| {
            self.deleted.insert(atom);
        });
        changes.each_write(|fluent, write| {
            self.written.insert(fluent.clone(), write);
        });
    }

    /// Visits everything that it accesses, possibly more than once.
    pub(super) fn each_touch(&self, visit: &mut dyn FnMut(Touch)) {
        self.needed.iter().for_each(|atom| visit(Touch::Needs(atom.clone())));
        self.added.iter().for_each(|atom| visit(Touch::Adds(atom.clone())));
        self.deleted.iter().for_each(|atom| visit(Touch::Deletes(atom.clone())));
        self.below.keys().for_each(|&predicate| visit(Touch::Below(predicate)));
        self.added.iter().chain(&self.deleted).for_each(|atom| visit(Touch::Changes(atom.predicate)));
        self.read.iter().for_each(|fluent| visit(Touch::Reads(fluent.clone())));
        for (fluent, write) in &self.written {
            visit(match write {
                Write::Additive => Touch::Shifts(fluent.clone()),
                Write::Other => Touch::Sets(fluent.clone()),
            });
        }
    }

    /// Drops changes that do not change the state.
    pub(super) fn only_changes_of(&mut self, state: &State) {
        self.added.retain(|atom| !state.holds(atom.predicate, &atom.arguments));
        self.deleted.retain(|atom| state.holds(atom.predicate, &atom.arguments));
    }

    /// What both happenings access so that they interfere.
    pub(super) fn interference(&self, other: &Self) -> Option<Shared> {
        self.disturbs(other).or_else(|| other.disturbs(self))
    }

    /// What this one changes and `other` accesses. Returns the least atom, so that the same plan
    /// gives the same message.
    fn disturbs(&self, other: &Self) -> Option<Shared> {
        let changed = || self.added.iter().chain(&self.deleted);
        let atom = changed()
            .filter(|&atom| other.needed.contains(atom))
            .chain(self.added.iter().filter(|&atom| other.deleted.contains(atom)))
            .min();
        if let Some(atom) = atom {
            return Some(Shared::Atom(atom.clone()));
        }
        let derived = changed().filter_map(|atom| Some((atom, *other.below.get(&atom.predicate)?))).min();
        if let Some((atom, predicate)) = derived {
            return Some(Shared::Derived { predicate, atom: atom.clone() });
        }
        let fluents = self.written.iter().filter(|&(fluent, &write)| {
            other.read.contains(fluent)
                || other.written.get(fluent).is_some_and(|&w| w == Write::Other || write == Write::Other)
        });
        let first = fluents.map(|(fluent, _)| fluent).min_by_key(|f| (f.function, &f.arguments));
        first.map(|fluent| Shared::Fluent(fluent.clone()))
    }
}

/// An access of one happening that may interfere with another.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Touch {
    /// It needs the atom.
    Needs(GroundAtom),
    /// It adds the atom.
    Adds(GroundAtom),
    /// It deletes the atom.
    Deletes(GroundAtom),
    /// It needs a derived predicate that depends on this one.
    Below(PredicateId),
    /// It adds or deletes an atom of the predicate.
    Changes(PredicateId),
    /// It reads the fluent.
    Reads(GroundApplication),
    /// It increases or decreases the fluent.
    Shifts(GroundApplication),
    /// It changes the fluent in another way.
    Sets(GroundApplication),
}

impl Touch {
    /// Visits the accesses that must not happen at the same time.
    pub(super) fn each_rival(&self, visit: &mut dyn FnMut(Self)) {
        match self {
            Self::Needs(atom) => {
                visit(Self::Adds(atom.clone()));
                visit(Self::Deletes(atom.clone()));
            }
            Self::Adds(atom) => {
                visit(Self::Needs(atom.clone()));
                visit(Self::Deletes(atom.clone()));
            }
            Self::Deletes(atom) => {
                visit(Self::Needs(atom.clone()));
                visit(Self::Adds(atom.clone()));
            }
            Self::Below(predicate) => visit(Self::Changes(*predicate)),
            Self::Changes(predicate) => visit(Self::Below(*predicate)),
            Self::Reads(fluent) => {
                visit(Self::Shifts(fluent.clone()));
                visit(Self::Sets(fluent.clone()));
            }
            Self::Shifts(fluent) => {
                visit(Self::Reads(fluent.clone()));
                visit(Self::Sets(fluent.clone()));
            }
            Self::Sets(fluent) => {
                visit(Self::Reads(fluent.clone()));
                visit(Self::Shifts(fluent.clone()));
                visit(Self::Sets(fluent.clone()));
            }
        }
    }
}
