//! Relaxed reachability as a semi-naive Datalog evaluation over ordered joins.
//!
//! Problem: the instances of a schema are a join of the atoms of its condition, and enumerating
//! bindings by type explodes. Idea: each rule (an action, a conditional effect, an axiom) gets one
//! join plan for each changing atom of its body. A newly reached atom triggers its plans. The other
//! atoms are looked up in hash indices on exactly the positions that are already bound, most
//! selective first; the selectivity of static atoms is measured. Invariant: when atom `n` triggers,
//! the indices contain the atoms up to `n`, and body positions before the trigger skip `n` itself,
//! so each instance is found exactly once. Cost: proportional to the number of partial joins.
//!
//! Source: Helmert, "Concise finite-domain representations", AIJ 2009, §6 (grounding as Datalog);
//! Ullman, "Principles of database and knowledge-base systems", 1989, ch. 3 (semi-naive evaluation).

use super::filter::Filter;
use super::indices::Indices;
use super::plan::{JoinPlan, Statistics, Step, plan};
use super::rule::{Rule, rules};
use crate::ground::binding::{object, resolve};
use crate::ground::error::{Failure, GroundError};
use crate::ground::memory;
use crate::ground::normalise::{Fluents, Normalised, Schema};
use crate::ids::id32;
use crate::task::AtomTable;
use budget::{Interrupted, Meter};
use pddl::model::{ObjectId, Term};

/// The bindings found for one schema: parameters, then hoisted variables, `width` a row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bindings {
    pub(crate) width: usize,
    pub(crate) rows: usize,
    pub(crate) values: Vec<u32>,
}

/// Runs all rules to a fixpoint. The first `statics` atoms of `table` never change.
pub(super) fn join(
    model: &Normalised<'_>,
    table: AtomTable,
    statics: u32,
    meter: &Meter<'_>,
) -> Result<(AtomTable, Vec<Bindings>), Failure> {
    let Normalised { schemas, is_static, fluents, .. } = model;
    let rules = &rules(schemas, is_static, fluents);
    let objects = model.problem.objects.len();
    let mut indices = Indices::new(is_static.len(), objects);
    let mut triggered: Vec<Vec<(usize, JoinPlan)>> = vec![Vec::new(); is_static.len()];
    let mut at_once = Vec::new();
    let mut statistics = Statistics::new(&table, statics, meter);
    for (r, rule) in rules.iter().enumerate() {
        let changing: Vec<usize> =
            (0..rule.body.len()).filter(|&i| !is_static[rule.body[i].predicate.0 as usize]).collect();
        if changing.is_empty() {
            at_once.push((r, plan(rule, None, is_static, &mut statistics, &mut indices)));
        }
        for i in changing {
            let p = rule.body[i].predicate.0 as usize;
            triggered[p].push((r, plan(rule, Some(i), is_static, &mut statistics, &mut indices)));
        }
    }
    let bindings = schemas
        .iter()
        .map(|s| Bindings { width: s.parameters + s.hoisted.len(), ..Bindings::default() })
        .collect();
    let bytes = (0..id32(table.len())).map(|a| memory::atom(table.row(a).len())).sum();
    let instance_bytes = schemas.iter().map(Schema::instance_bytes).collect();
    let mut out = Out { schemas, table, bindings, instance_bytes, bytes, meter, fluents };
    for atom in 0..statics {
        meter.spend(128)?;
        indices.insert(&out.table, atom);
    }
    let mut binding = Vec::new();
    for (r, plan) in &at_once {
        Join { rule: &rules[*r], plan, indices: &indices, current: statics, out: &mut out }
            .start(&mut binding)?;
    }
    let mut current = statics;
    while (current as usize) < out.table.len() {
        meter.spend(128)?;
        indices.insert(&out.table, current);
        let predicate = out.table.predicate(current).0 as usize;
        for (r, plan) in &triggered[predicate] {
            Join { rule: &rules[*r], plan, indices: &indices, current, out: &mut out }.start(&mut binding)?;
        }
        current += 1;
    }
    Ok((out.table, out.bindings))
}

struct Out<'a> {
    schemas: &'a [Schema],
    table: AtomTable,
    bindings: Vec<Bindings>,
    /// By schema: the bytes of one instance.
    instance_bytes: Vec<usize>,
    /// The bytes of all atoms and instances found so far.
    bytes: usize,
    meter: &'a Meter<'a>,
    fluents: &'a Fluents,
}

impl Out<'_> {
    fn interrupted(&self, own: usize) -> GroundError {
        GroundError::Interrupted { schema: self.schemas[own].name.clone() }
    }

    fn stopped(&self, why: Interrupted, own: usize) -> GroundError {
        if why == Interrupted::Memory { self.limit(own) } else { self.interrupted(own) }
    }

    /// The error for the schema with the most bytes, or for the current one.
    fn limit(&self, own: usize) -> GroundError {
        let bytes = |i: &usize| (self.bindings[*i].rows * self.instance_bytes[*i], *i == own);
        let largest = (0..self.schemas.len()).max_by_key(bytes).unwrap_or(own);
        let schema = self.schemas[largest].name.clone();
        GroundError::Limit { schema, instances: self.bindings[largest].rows }
    }
}

struct Join<'a, 'b> {
    rule: &'a Rule,
    plan: &'a JoinPlan,
    indices: &'a Indices,
    current: u32,
    out: &'a mut Out<'b>,
}

impl Join<'_, '_> {
    fn start(&mut self, binding: &mut Vec<u32>) -> Result<(), GroundError> {
        binding.clear();
        binding.resize(self.rule.slots.len(), u32::MAX);
        if let Some(trigger) = self.plan.trigger {
            for (position, &term) in self.rule.body[trigger].arguments.iter().enumerate() {
                let object = self.out.table.row(self.current)[position];
                match term {
                    Term::Object(o) if o.0 != object => return Ok(()),
                    Term::Object(_) => {}
                    Term::Variable(v) => {
                        let slot = &mut binding[v.0 as usize];
                        if *slot == u32::MAX {
                            *slot = object;
                            if !self.rule.slots[v.0 as usize].contains(ObjectId(object)) {
                                return Ok(());
                            }
                        } else if *slot != object {
                            return Ok(());
                        }
                    }
                }
            }
        }
        self.step(0, binding)
    }

    fn step(&mut self, at: usize, binding: &mut Vec<u32>) -> Result<(), GroundError> {
        if self.out.meter.spend(32).is_err() {
            return Err(self.out.interrupted(self.rule.schema));
        }
        let (rule, plan, indices) = (self.rule, self.plan, self.indices);
        let Some(step) = plan.steps.get(at) else {
            return self.emit(binding);
        };
        match step {
            Step::Check(filter) => {
                let holds = match filter {
                    Filter::Same { positive, left, right } => {
                        (resolve(*left, binding) == resolve(*right, binding)) == *positive
                    }
                    Filter::OneOf { positive, term, extent } => {
                        extent.contains(object(*term, binding)) == *positive
                    }
                    Filter::Absent { predicate, arguments } => self
                        .out
                        .table
                        .find(*predicate, arguments.iter().map(|&t| resolve(t, binding)))
                        .is_none(),
                    Filter::Compare { relation, left, right } => {
                        let difference = self.out.fluents.difference(left, right, binding);
                        let value = difference.ok().and_then(|difference| difference.as_constant());
                        value.is_some_and(|value| relation.holds(value.sign()))
                    }
                };
                if holds { self.step(at + 1, binding) } else { Ok(()) }
            }
            Step::Probe { atom } => {
                let pattern = &rule.body[*atom];
                let row = pattern.arguments.iter().map(|&t| resolve(t, binding));
                match self.out.table.find(pattern.predicate, row) {
                    Some(a) if a < self.current || (a == self.current && !self.skips(*atom)) => {
                        self.step(at + 1, binding)
                    }
                    _ => Ok(()),
                }
            }
            Step::Enumerate { slot } => {
                for object in rule.slots[*slot].objects() {
                    binding[*slot] = object.0;
                    self.step(at + 1, binding)?;
                }
                Ok(())
            }
            Step::Scan { atom, index, key, assign, repeat } => {
                let candidates = indices.bucket(*index, key, binding);
                'rows: for (i, &candidate) in candidates.iter().enumerate() {
                    if i.is_multiple_of(256) && self.out.meter.spend(1024).is_err() {
                        return Err(self.out.interrupted(self.rule.schema));
                    }
                    if candidate == self.current && self.skips(*atom) {
                        continue;
                    }
                    let row = self.out.table.row(candidate);
                    for &(position, slot) in assign {
                        if !rule.slots[slot].contains(ObjectId(row[position])) {
                            continue 'rows;
                        }
                        binding[slot] = row[position];
                    }
                    for &(position, slot) in repeat {
                        if binding[slot] != row[position] {
                            continue 'rows;
                        }
                    }
                    self.step(at + 1, binding)?;
                }
                Ok(())
            }
        }
    }

    /// Whether this body position must not match the trigger's own atom.
    fn skips(&self, atom: usize) -> bool {
        self.plan.trigger.is_some_and(|t| atom < t)
    }

    fn emit(&mut self, binding: &[u32]) -> Result<(), GroundError> {
        for (predicate, arguments) in &self.rule.heads {
            let before = self.out.table.len();
            self.out.table.insert(*predicate, arguments.iter().map(|&t| resolve(t, binding)));
            if self.out.table.len() > before {
                self.out.bytes += memory::atom(arguments.len());
            }
        }
        if self.rule.collected {
            let rows = &mut self.out.bindings[self.rule.schema];
            rows.values.extend(self.rule.variables.iter().map(|v| binding[v.0 as usize]));
            rows.rows += 1;
            self.out.bytes += self.out.instance_bytes[self.rule.schema];
        }
        self.out.meter.hold(self.out.bytes).map_err(|why| self.out.stopped(why, self.rule.schema))
    }
}
