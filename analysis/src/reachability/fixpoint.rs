//! Computes the fixpoint: applies rules until nothing new follows.
//!
//! Idea: semi-naive evaluation. Each new row triggers the rules that have an atom of its relation,
//! and is joined with the earlier rows. If a binding fails only because of a residual check, it is
//! tried again when there are more rows. Cost: one unit of work for each step of a join.

use std::rc::Rc;

use budget::{Interrupted, Meter};
use rustc_hash::FxHashSet;

use super::compile::{self, Compiled};
use super::database::{Indices, RelationId, Rows};
use super::join::{self, Join, Sink, Step};
use super::rule::{Check, Origin, Rule};
use super::world::{UNBOUND, World, with_row};
use crate::intervals::Hulls;

/// The most join steps of the analysis: about 50 ms in release mode.
const STEPS: u64 = 4_000_000;
/// The cost of a new row in steps: it is added to the relation and all its indices, which are in
/// different places in memory.
const ROW: usize = 1;

/// The fixpoint.
pub(super) struct Reachability<'a> {
    pub(super) compiled: Compiled<'a>,
    pub(super) indices: Indices,
    /// By rule: whether it has fired.
    fired: Vec<bool>,
}

impl<'a> Reachability<'a> {
    /// Computes the fixpoint; `None` if the budget does not suffice.
    pub(super) fn new(world: World<'a>, hulls: &Rc<Hulls>) -> Option<Self> {
        let compiled = compile::compile(&Rc::new(world), hulls);
        let mut all = Self { compiled, indices: Indices::default(), fired: Vec::new() };
        let meter = Meter::of_work(STEPS);
        all.saturate(0, &meter).ok()?;
        let first = all.compiled.rules.len();
        all.compiled.hierarchy();
        all.saturate(first, &meter).ok()?;
        Some(all)
    }

    /// The values that numeric fluents can take.
    pub(super) fn hulls(&self) -> &Hulls {
        &self.compiled.evaluator.hulls
    }

    /// The origins of all rules that never fire.
    pub(super) fn silent(&self) -> Vec<&Origin> {
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

    /// Applies the rules from `first` on until nothing new follows. Earlier rules must be complete.
    fn saturate(&mut self, first: usize, meter: &Meter<'_>) -> Result<(), Interrupted> {
        let Self { compiled: Compiled { evaluator, rows, rules, .. }, indices, fired } = self;
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
            Join { rule, steps, rows, indices, evaluator, meter, sink }.run(0, false, &mut binding)?;
        }
        let mut next = 0;
        let mut binding = Vec::new();
        loop {
            while let Some(&(relation, row)) = queue.get(next) {
                next += 1;
                meter.spend(ROW)?;
                indices.publish(rows, relation, row);
                published[relation.0 as usize] = row + 1;
                for trigger in &mut triggers[relation.0 as usize] {
                    let rule = &rules[trigger.rule];
                    meter.spend(1)?;
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
                    Join { rule, steps, rows, indices, evaluator, meter, sink }.run(
                        0,
                        false,
                        &mut binding,
                    )?;
                }
            }
            // A residual check that failed may succeed now that there are more rows.
            let mut moved = false;
            let waiting: Vec<_> = pending.drain().collect();
            for (r, binding) in waiting {
                let rule = &rules[r];
                let mut values = binding.to_vec();
                let mut holds = true;
                for check in rule.checks.iter().filter(|c| matches!(c, Check::Residual(..))) {
                    holds = holds && evaluator.check(rows, check, &rule.slots, &mut values, meter)?;
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

/// An atom of a rule that a new row may match, and the join plan from there, created when first
/// needed.
struct Trigger {
    rule: usize,
    atom: usize,
    steps: Option<Rc<[Step]>>,
}

/// Adds the heads of a rule to the database.
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
