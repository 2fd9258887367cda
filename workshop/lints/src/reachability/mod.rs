//! What can ever become true and which actions can ever apply, if nothing were ever undone.
//!
//! Problem: an action that can never apply, a goal out of reach, an axiom that never fires are
//! mistakes that reading a domain does not show. Idea: drop the deletes, take every negated atom that
//! could be deleted and every number that could be changed far enough as true, and compute all
//! reachable atoms as a Datalog fixpoint, semi-naively: each new row is joined with those before it.
//! Invariant: what a real plan reaches is reached here, so that "unreachable" is a proof and
//! "reachable" none. Cost: bounded by a budget of join steps; past it there is no answer, and no
//! warning.
//!
//! Source: Hoffmann & Nebel, "The FF planning system", JAIR 2001 (delete relaxation); Helmert,
//! "Concise finite-domain representations", AIJ 2009, §6 (as Datalog); Ullman, "Principles of
//! database and knowledge-base systems", 1989, ch. 3 (semi-naive evaluation).

mod compile;
mod database;
mod evaluate;
mod join;
mod relax;
mod rule;
mod text;
mod why;
mod world;

use std::rc::Rc;

use rustc_hash::FxHashSet;

use crate::numbers::Numbers;

use compile::Compiled;
use database::{Indices, RelationId, Rows};
use join::{Exhausted, Join, Sink, Step};
use rule::Rule;
pub(crate) use rule::{Origin, Part, Schema};
pub(crate) use text::{Words, listed, shortened};
pub(crate) use why::{Cause, DeadGoal, Link, Nature, Piece};
pub(crate) use world::World;
use world::{UNBOUND, with_row};

/// Join steps before there is no answer: some 50 ms when optimised.
const STEPS: u64 = 4_000_000;
/// Join steps of all questions for reasons together.
const REASONS: u64 = 3_000_000;
/// What a new row costs, in steps: it goes into the relation and all its indices, each somewhere else in memory.
const ROW: u64 = 1;

/// The fixpoint.
pub(crate) struct Reachability<'a> {
    compiled: Compiled<'a>,
    indices: Indices,
    /// By rule.
    fired: Vec<bool>,
    left: u64,
    /// Steps that questions may still take.
    reasons: u64,
}

impl<'a> Reachability<'a> {
    /// Computes it; `None` if the budget does not suffice.
    pub(crate) fn new(world: &Rc<World<'a>>, numbers: &Rc<Numbers>) -> Option<Self> {
        let compiled = compile::compile(world, numbers);
        let mut all =
            Self { compiled, indices: Indices::default(), fired: Vec::new(), left: STEPS, reasons: REASONS };
        all.saturate(0).ok()?;
        let first = all.compiled.rules.len();
        all.compiled.hierarchy();
        all.saturate(first).ok()?;
        Some(all)
    }

    /// Possible values of fluents.
    pub(crate) fn numbers(&self) -> &Numbers {
        &self.compiled.evaluator.numbers
    }

    /// Everything that may fire and never does.
    pub(crate) fn silent(&self) -> Vec<&Origin> {
        let fired: FxHashSet<&Origin> = self
            .compiled
            .rules
            .iter()
            .zip(&self.fired)
            .filter(|(_, f)| **f)
            .map(|(r, _)| &r.origin)
            .collect();
        self.compiled.origins.iter().filter(|o| !fired.contains(o)).collect()
    }

    /// Runs the rules from `first` on to their fixpoint; what others derive is complete by then.
    fn saturate(&mut self, first: usize) -> Result<(), Exhausted> {
        let Self { compiled: Compiled { evaluator, rows, rules, .. }, indices, fired, left, .. } = self;
        fired.resize(rules.len(), false);
        let mut changing = vec![false; rows.relations()];
        for head in rules[first..].iter().flat_map(|r| &r.heads) {
            changing[head.relation.0 as usize] = true;
        }
        let mut triggers: Vec<Vec<Trigger>> = (0..rows.relations()).map(|_| Vec::new()).collect();
        let mut at_once = Vec::new();
        for (r, rule) in rules.iter().enumerate().skip(first) {
            if rule.slots[..rule.parameters].iter().any(|s| s.objects.is_empty()) {
                continue;
            }
            let before = at_once.len();
            at_once.push(r);
            for (atom, pattern) in rule.body.iter().enumerate() {
                if changing[pattern.relation.0 as usize] {
                    triggers[pattern.relation.0 as usize].push(Trigger { rule: r, atom, steps: None });
                    at_once.truncate(before);
                }
            }
        }
        let mut queue: Vec<(RelationId, u32)> = Vec::new();
        for relation in (0..rows.relations()).filter(|&r| changing[r]) {
            let relation = RelationId(u32::try_from(relation).expect("relations are few"));
            queue.extend((0..rows.count(relation)).map(|row| (relation, row)));
        }
        let mut pending: FxHashSet<(usize, Box<[u32]>)> = FxHashSet::default();
        let mut published = vec![0; rows.relations()];
        for r in at_once {
            let visible = |relation: RelationId| visible(rows, &changing, &published, relation);
            let rule = &rules[r];
            let steps = join::plan(
                rule,
                &mut vec![false; rule.slots.len()],
                None,
                &changing,
                rows,
                indices,
                &visible,
            );
            let mut sink =
                Derive { number: r, rule, fired: &mut fired[r], queue: &mut queue, pending: &mut pending };
            let mut binding = vec![UNBOUND; rule.slots.len()];
            let (steps, sink) = (&steps[..], &mut sink);
            Join { rule, steps, rows, indices, evaluator, left, sink }.run(0, false, &mut binding)?;
        }
        let mut next = 0;
        let mut binding = Vec::new();
        loop {
            while let Some(&(relation, row)) = queue.get(next) {
                next += 1;
                *left = left.checked_sub(ROW).ok_or(Exhausted)?;
                indices.publish(rows, relation, row);
                published[relation.0 as usize] = row + 1;
                for trigger in &mut triggers[relation.0 as usize] {
                    let rule = &rules[trigger.rule];
                    *left = left.checked_sub(1).ok_or(Exhausted)?;
                    binding.clear();
                    binding.resize(rule.slots.len(), UNBOUND);
                    if !join::unify(
                        rule,
                        &rule.body[trigger.atom].arguments,
                        rows.row(relation, row),
                        &mut binding,
                    ) {
                        continue;
                    }
                    let steps = trigger.steps.get_or_insert_with(|| {
                        let visible = |relation: RelationId| visible(rows, &changing, &published, relation);
                        let mut bound: Vec<bool> = binding.iter().map(|&b| b != UNBOUND).collect();
                        join::plan(rule, &mut bound, Some(trigger.atom), &changing, rows, indices, &visible)
                            .into()
                    });
                    let steps = Rc::clone(steps);
                    let (number, fired) = (trigger.rule, &mut fired[trigger.rule]);
                    let mut sink = Derive { number, rule, fired, queue: &mut queue, pending: &mut pending };
                    let (steps, sink) = (&steps[..], &mut sink);
                    Join { rule, steps, rows, indices, evaluator, left, sink }.run(0, false, &mut binding)?;
                }
            }
            // What waited for a residual check may hold now that there is more.
            let mut moved = false;
            let waiting: Vec<_> = pending.drain().collect();
            for (r, binding) in waiting {
                let rule = &rules[r];
                let mut values = binding.to_vec();
                let mut holds = true;
                for check in rule.checks.iter().filter(|c| matches!(c, rule::Check::Residual(..))) {
                    holds = holds && evaluator.check(rows, check, &rule.slots, &mut values, left)?;
                }
                if holds {
                    moved = true;
                    let (queue, pending) = (&mut queue, &mut pending);
                    Derive { number: r, rule, fired: &mut fired[r], queue, pending }.found(rows, &binding);
                } else {
                    pending.insert((r, binding));
                }
            }
            if !moved && next == queue.len() {
                return Ok(());
            }
        }
    }
}

fn visible(rows: &Rows, changing: &[bool], published: &[u32], relation: RelationId) -> u32 {
    if changing[relation.0 as usize] { published[relation.0 as usize] } else { rows.count(relation) }
}

/// An atom of a rule that a new row may match, and the plan from there, made when first needed.
struct Trigger {
    rule: usize,
    atom: usize,
    steps: Option<Rc<[Step]>>,
}

/// Puts what follows into the database.
struct Derive<'a> {
    number: usize,
    rule: &'a Rule,
    fired: &'a mut bool,
    queue: &'a mut Vec<(RelationId, u32)>,
    pending: &'a mut FxHashSet<(usize, Box<[u32]>)>,
}

impl Sink for Derive<'_> {
    fn wanted(&mut self, rows: &Rows, binding: &[u32]) -> bool {
        !*self.fired
            || self
                .rule
                .heads
                .iter()
                .any(|h| with_row(&h.arguments, binding, |row| rows.find(h.relation, row).is_none()))
    }

    fn found(&mut self, rows: &mut Rows, binding: &[u32]) {
        *self.fired = true;
        for head in &self.rule.heads {
            if let Some(row) = with_row(&head.arguments, binding, |row| rows.insert(head.relation, row)) {
                self.queue.push((head.relation, row));
            }
        }
    }

    fn open(&mut self, binding: &[u32]) {
        self.pending.insert((self.number, binding.into()));
    }
}
