//! Keeping one component's derived tuples up to date.
//!
//! From scratch: evaluate every rule once; then, while tuples are new, the instances of rules with a new tuple
//! (semi-naive evaluation).
//!
//! After a change (delete and rederive): delete the tuples that lost a proof, and the tuples proved with them;
//! restore those with another proof; then add new tuples semi-naively. To find what a lost tuple proved, the inputs
//! temporarily hold both their old and their new tuples. That deletes too many tuples, never too few, and the second
//! step restores the surplus. It works where only pivots read the changed inputs. If a negation, a universal
//! condition or a fluent reads the change, or if the change deletes half of all tuples, the component is derived from
//! scratch.
//!
//! Invariant: derived tuples keep their slots, and the log of a derived relation records changes in both directions,
//! so the components above can continue from there.
//!
//! Cost: the instances with a changed tuple, plus one proof per deleted tuple.
//!
//! Source: Gupta, Mumick & Subrahmanian, "Maintaining views incrementally", SIGMOD 1993, §7 (DRed).

use super::rule::{Heads, Rule, World};
use crate::relation::{Moment, Relation, Slot};
use crate::state::{Seen, State};
use pddl::model::{FunctionId, PredicateId};
use rustc_hash::FxHashSet;

/// Basic facts or derived facts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Fact,
    Derived,
}

#[derive(Clone, Copy, Debug)]
struct Input {
    kind: Kind,
    predicate: PredicateId,
    /// Whether a rule reads it in another way than as a pivot.
    hidden: bool,
}

impl Input {
    fn relation(self, state: &State) -> &Relation {
        relation(self.kind, self.predicate, state)
    }
}

fn relation(kind: Kind, predicate: PredicateId, state: &State) -> &Relation {
    match kind {
        Kind::Fact => &state.facts[predicate],
        Kind::Derived => &state.derived[predicate],
    }
}

/// Derived predicates that depend on one another.
#[derive(Clone, Debug)]
pub(super) struct Component {
    own: Vec<PredicateId>,
    rules: Vec<Rule>,
    inputs: Vec<Input>,
    functions: Vec<FunctionId>,
    /// Whether rules read the component only as pivots.
    plain: bool,
}

/// Tuples of one relation.
#[derive(Debug)]
struct Batch {
    kind: Kind,
    predicate: PredicateId,
    slots: Vec<Slot>,
}

impl Batch {
    fn relation<'s>(&self, state: &'s State) -> &'s Relation {
        relation(self.kind, self.predicate, state)
    }

    fn relation_mut<'s>(&self, state: &'s mut State) -> &'s mut Relation {
        match self.kind {
            Kind::Fact => &mut state.facts[self.predicate],
            Kind::Derived => &mut state.derived[self.predicate],
        }
    }
}

/// Added or deleted tuples, by relation.
#[derive(Debug, Default)]
struct Front(Vec<Batch>);

impl Front {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn extend(&mut self, kind: Kind, predicate: PredicateId, slots: Vec<Slot>) {
        if !slots.is_empty() {
            self.0.push(Batch { kind, predicate, slots });
        }
    }

    fn push(&mut self, predicate: PredicateId, slot: Slot) {
        match self.0.iter_mut().find(|b| b.predicate == predicate && b.kind == Kind::Derived) {
            Some(batch) => batch.slots.push(slot),
            None => self.extend(Kind::Derived, predicate, vec![slot]),
        }
    }
}

impl Component {
    pub(super) fn new(
        own: Vec<PredicateId>,
        rules: Vec<Rule>,
        derived: impl Fn(PredicateId) -> bool,
    ) -> Self {
        let mut inputs: Vec<Input> = Vec::new();
        let mut functions: Vec<FunctionId> = rules.iter().flat_map(|rule| rule.functions.clone()).collect();
        functions.sort_unstable();
        functions.dedup();
        let mut read: Vec<PredicateId> = rules.iter().flat_map(Rule::reads).collect();
        read.sort_unstable();
        read.dedup();
        for predicate in read {
            let hidden = rules.iter().any(|rule| rule.hidden.contains(&predicate));
            inputs.push(Input { kind: Kind::Fact, predicate, hidden });
            if derived(predicate) && !own.contains(&predicate) {
                inputs.push(Input { kind: Kind::Derived, predicate, hidden });
            }
        }
        let plain = !rules.iter().any(|rule| rule.hidden.iter().any(|hidden| own.contains(hidden)));
        Self { own, rules, inputs, functions, plain }
    }

    pub(super) fn own(&self) -> &[PredicateId] {
        &self.own
    }

    /// The derived predicates of other components that it reads.
    pub(super) fn below(&self) -> impl Iterator<Item = PredicateId> {
        self.inputs.iter().filter(|input| input.kind == Kind::Derived).map(|input| input.predicate)
    }

    pub(super) fn see(&self, state: &State) -> Seen {
        Seen {
            inputs: self.inputs.iter().map(|input| input.relation(state).mark()).collect(),
            functions: self.functions.iter().map(|&function| state.fluent_changes(function)).collect(),
        }
    }

    pub(super) fn is_current(&self, seen: &Seen, state: &State) -> bool {
        self.inputs.iter().zip(&seen.inputs).all(|(input, &mark)| input.relation(state).mark() == mark)
            && self.same_fluents(seen, state)
    }

    fn same_fluents(&self, seen: &Seen, state: &State) -> bool {
        let mut functions = self.functions.iter().zip(&seen.functions);
        functions.all(|(&function, &changes)| state.fluent_changes(function) == changes)
    }

    /// Updates the derived tuples. `seen` has the inputs of the last update.
    pub(super) fn update(&self, seen: Option<&Seen>, world: World<'_>, state: &mut State, now: Moment) {
        let done = seen
            .and_then(|seen| self.changes(seen, state))
            .is_some_and(|changes| self.follow(&changes, world, state, now));
        if !done {
            self.anew(world, state, now);
        }
    }

    /// The changed slots of the inputs; `None` if the change requires a derivation from scratch.
    fn changes(&self, seen: &Seen, state: &State) -> Option<Vec<(Input, Vec<Slot>)>> {
        if !self.plain || !self.same_fluents(seen, state) {
            return None;
        }
        let mut changes = Vec::new();
        for (&input, &mark) in self.inputs.iter().zip(&seen.inputs) {
            let relation = input.relation(state);
            if relation.mark() == mark {
                continue;
            }
            let slots = relation.toggled(mark)?;
            if slots.is_empty() {
                continue;
            }
            if input.hidden || slots.len() > relation.len() / 2 + 8 {
                return None;
            }
            changes.push((input, slots));
        }
        Some(changes)
    }

    /// Updates incrementally. Returns `false` and changes nothing if that is not worthwhile.
    fn follow(
        &self,
        changes: &[(Input, Vec<Slot>)],
        world: World<'_>,
        state: &mut State,
        now: Moment,
    ) -> bool {
        let (mut lost, mut gained) = (Front::default(), Front::default());
        for (input, slots) in changes {
            let (holding, gone) = slots.iter().partition(|&&slot| input.relation(state).slot_holds(slot));
            gained.extend(input.kind, input.predicate, holding);
            lost.extend(input.kind, input.predicate, gone);
        }
        if !lost.is_empty() {
            lost.0.iter().for_each(|batch| batch.relation_mut(state).revive(&batch.slots));
            let doomed = self.doomed(&lost, world, state);
            lost.0.iter().for_each(|batch| batch.relation_mut(state).bury(&batch.slots));
            let Some(doomed) = doomed else { return false };
            for &(predicate, slot) in &doomed {
                state.derived[predicate].drop_slot(slot, now);
            }
            for (predicate, slot) in doomed {
                let head = state.derived[predicate].tuple(slot);
                if self.rules.iter().any(|rule| rule.head == predicate && rule.proves(world, state, head)) {
                    state.derived[predicate].restore(slot, now);
                    gained.push(predicate, slot);
                }
            }
        }
        self.grow(gained, world, state, now);
        true
    }

    /// The derived tuples with a proof that uses a lost tuple, in the order of discovery; `None` if
    /// there are too many.
    fn doomed(&self, lost: &Front, world: World<'_>, state: &State) -> Option<Vec<(PredicateId, Slot)>> {
        let most = 16 + self.own.iter().map(|&own| state.derived[own].len()).sum::<usize>() / 2;
        let (mut doomed, mut known) = (Vec::new(), FxHashSet::default());
        let mut front = self.led_to(lost, world, state, &mut known, &mut doomed);
        while !front.is_empty() {
            if doomed.len() > most {
                return None;
            }
            front = self.led_to(&front, world, state, &mut known, &mut doomed);
        }
        Some(doomed)
    }

    /// One step of [`Component::doomed`].
    fn led_to(
        &self,
        lost: &Front,
        world: World<'_>,
        state: &State,
        known: &mut FxHashSet<(PredicateId, Slot)>,
        doomed: &mut Vec<(PredicateId, Slot)>,
    ) -> Front {
        let mut next = Front::default();
        for rule in &self.rules {
            for heads in instances(rule, lost, world, state) {
                for slot in heads.each().filter_map(|head| state.derived[rule.head].slot(head)) {
                    if known.insert((rule.head, slot)) {
                        doomed.push((rule.head, slot));
                        next.push(rule.head, slot);
                    }
                }
            }
        }
        next
    }

    /// Adds the tuples that follow from new tuples.
    fn grow(&self, mut new: Front, world: World<'_>, state: &mut State, now: Moment) {
        while !new.is_empty() {
            let mut next = Front::default();
            for rule in &self.rules {
                let seen_otherwise = new.0.iter().any(|batch| rule.hidden.contains(&batch.predicate));
                let found = if seen_otherwise {
                    vec![rule.heads(world, state, None)]
                } else {
                    instances(rule, &new, world, state)
                };
                found.iter().for_each(|heads| add(rule, heads, state, now, &mut next));
            }
            new = next;
        }
    }

    fn anew(&self, world: World<'_>, state: &mut State, now: Moment) {
        for &own in &self.own {
            let relation = &mut state.derived[own];
            for slot in relation.live().to_vec() {
                relation.drop_slot(slot, now);
            }
        }
        let mut new = Front::default();
        for rule in &self.rules {
            let heads = rule.heads(world, state, None);
            add(rule, &heads, state, now, &mut new);
        }
        self.grow(new, world, state, now);
    }
}

/// The heads of a rule's instances with a tuple of the front.
fn instances(rule: &Rule, front: &Front, world: World<'_>, state: &State) -> Vec<Heads> {
    let mut found = Vec::new();
    for batch in &front.0 {
        for &(part, _) in rule.pivots.iter().filter(|&&(_, predicate)| predicate == batch.predicate) {
            let relation = batch.relation(state);
            let mut tuples = batch.slots.iter().map(|&slot| relation.tuple(slot));
            found.push(rule.heads(world, state, Some((part, &mut tuples))));
        }
    }
    found
}

fn add(rule: &Rule, heads: &Heads, state: &mut State, now: Moment, new: &mut Front) {
    for head in heads.each() {
        if let Some(slot) = state.derived[rule.head].add_slot(head, now) {
            new.push(rule.head, slot);
        }
    }
}
