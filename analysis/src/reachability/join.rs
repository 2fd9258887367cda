//! The order in which a rule's atoms are joined, and the search along it.
//!
//! Idea: a greedy order, by the number of rows that each atom is expected to add. For static relations this number is
//! measured; for changing relations it is estimated from the ranges of the free slots. As soon as all slots of the
//! heads have values, *one* solution of the rest is enough, and the search skips it if the heads are known already.
//! Invariant: of the solutions that agree on the slots of the heads, a plan visits at least one.

use budget::{Interrupted, Meter};

use super::database::{Indices, RelationId, Rows};
use super::evaluate::Evaluator;
use super::relax::slots_of;
use super::rule::{Check, Rule};
use super::world::{UNBOUND, resolve, with_row};

/// One step of a plan.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// A side condition, by position.
    Check(usize),
    /// Looks up the candidates of an atom, and binds its slots that have no value yet.
    Scan { atom: usize, index: usize, binds: Box<[usize]> },
    /// Looks up an atom whose slots all have values.
    Probe(usize),
    /// Tries all objects of a slot.
    Enumerate(usize),
    /// From here on, one solution is enough.
    Decided,
}

/// Plans the join of a rule whose `bound` slots have values. The atom `trigger` is joined already.
pub(crate) fn plan(
    rule: &Rule,
    bound: &mut [bool],
    trigger: Option<usize>,
    changing: &[bool],
    rows: &Rows,
    indices: &mut Indices,
    visible: &dyn Fn(RelationId) -> u32,
) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut atoms: Vec<usize> = (0..rule.body.len()).filter(|&i| Some(i) != trigger).collect();
    let mut checks: Vec<usize> = (0..rule.checks.len()).collect();
    let in_atoms: Vec<usize> = rule.body.iter().flat_map(|p| slots_of(&p.arguments)).collect();
    let mut heads: Vec<usize> = rule.heads.iter().flat_map(|p| slots_of(&p.arguments)).collect();
    heads.sort_unstable();
    heads.dedup();
    let mut decided = false;
    loop {
        checks.retain(|&c| {
            let ready =
                !matches!(rule.checks[c], Check::Residual(..)) && rule.needs[c].iter().all(|&s| bound[s]);
            if ready {
                steps.push(Step::Check(c));
            }
            !ready
        });
        if !decided && heads.iter().all(|&s| bound[s] || !in_atoms.contains(&s)) {
            decided = true;
            for &slot in &heads {
                if !std::mem::replace(&mut bound[slot], true) {
                    steps.push(Step::Enumerate(slot));
                }
            }
            steps.push(Step::Decided);
            continue;
        }
        let mut best: Option<(f64, usize, usize)> = None;
        for (at, &atom) in atoms.iter().enumerate() {
            let pattern = &rule.body[atom];
            let has_value = |p: &usize| match pattern.arguments[*p] {
                pddl::model::Term::Variable(v) => bound[v.0 as usize],
                pddl::model::Term::Object(_) => true,
            };
            let positions: Vec<usize> = (0..pattern.arguments.len()).filter(has_value).collect();
            if positions.len() == pattern.arguments.len() {
                best = Some((0.0, at, usize::MAX));
                break;
            }
            let index = indices.on(rows, pattern.relation, &positions, visible(pattern.relation));
            let cost = if changing[pattern.relation.0 as usize] {
                let free = slots_of(&pattern.arguments).filter(|&s| !bound[s]);
                let each = free.map(|s| rule.slots[s].objects.len() as f64).product::<f64>();
                1.0 + each * 0.5
            } else {
                indices.fan_out(index, rows)
            };
            if best.is_none_or(|(b, ..)| cost < b) {
                best = Some((cost, at, index));
            }
        }
        if let Some((_, at, index)) = best {
            let atom = atoms.remove(at);
            if index == usize::MAX {
                steps.push(Step::Probe(atom));
                continue;
            }
            let mut binds: Vec<usize> = slots_of(&rule.body[atom].arguments).filter(|&s| !bound[s]).collect();
            binds.sort_unstable();
            binds.dedup();
            binds.iter().for_each(|&s| bound[s] = true);
            steps.push(Step::Scan { atom, index, binds: binds.into() });
            continue;
        }
        // All atoms are joined. Enumerate the slots that the checks need, one at a time.
        let next = checks.iter().flat_map(|&c| &rule.needs[c]).find(|&&s| !bound[s]).copied();
        if let Some(slot) = next {
            bound[slot] = true;
            steps.push(Step::Enumerate(slot));
            continue;
        }
        steps.extend(checks.drain(..).map(Step::Check));
        return steps;
    }
}

/// The consumer of solutions.
pub(crate) trait Sink {
    /// Whether a solution with these values of the heads' slots is wanted.
    fn wanted(&mut self, rows: &Rows, binding: &[u32]) -> bool;
    /// Receives a solution.
    fn found(&mut self, rows: &mut Rows, binding: &[u32]);
    /// Receives a binding for which only a residual check has failed so far.
    fn open(&mut self, binding: &[u32]);
}

/// One evaluation of a rule.
pub(crate) struct Join<'a, S> {
    pub(crate) rule: &'a Rule,
    pub(crate) steps: &'a [Step],
    pub(crate) rows: &'a mut Rows,
    pub(crate) indices: &'a Indices,
    pub(crate) evaluator: &'a Evaluator<'a>,
    /// Counts steps.
    pub(crate) meter: &'a Meter<'a>,
    pub(crate) sink: &'a mut S,
}

impl<S: Sink> Join<'_, S> {
    /// Follows the plan from a step. Returns whether it found a solution.
    pub(crate) fn run(
        &mut self,
        at: usize,
        decided: bool,
        binding: &mut Vec<u32>,
    ) -> Result<bool, Interrupted> {
        let steps = self.steps;
        let Some(step) = steps.get(at) else { return Ok(true) };
        self.meter.spend(1)?;
        match step {
            Step::Decided => {
                if !self.sink.wanted(self.rows, binding) {
                    return Ok(false);
                }
                let holds = self.run(at + 1, true, binding)?;
                if holds {
                    self.sink.found(self.rows, binding);
                }
                Ok(holds)
            }
            Step::Check(check) => {
                let check = &self.rule.checks[*check];
                if self.evaluator.check(self.rows, check, &self.rule.slots, binding, self.meter)? {
                    return self.run(at + 1, decided, binding);
                }
                if matches!(check, Check::Residual(..)) {
                    self.sink.open(binding);
                }
                Ok(false)
            }
            Step::Probe(atom) => {
                let pattern = &self.rule.body[*atom];
                let known = |row: &[u32]| self.rows.find(pattern.relation, row).is_some();
                if with_row(&pattern.arguments, binding, known) {
                    self.run(at + 1, decided, binding)
                } else {
                    Ok(false)
                }
            }
            Step::Enumerate(slot) => {
                let range = std::rc::Rc::clone(&self.rule.slots[*slot]);
                let mut any = false;
                for &object in &range.objects {
                    binding[*slot] = object;
                    any |= self.run(at + 1, decided, binding)?;
                    if any && decided {
                        break;
                    }
                }
                // The caller reads the solution from the binding.
                if !(any && decided) {
                    binding[*slot] = UNBOUND;
                }
                Ok(any)
            }
            Step::Scan { atom, index, binds } => {
                let pattern = &self.rule.body[*atom];
                let value = |p: usize| resolve(pattern.arguments[p], binding);
                let candidates = self.indices.bucket(*index, &value);
                let mut any = false;
                for candidate in candidates {
                    self.meter.spend(1)?;
                    binds.iter().for_each(|&s| binding[s] = UNBOUND);
                    let row = self.rows.row(pattern.relation, candidate);
                    if unify(self.rule, &pattern.arguments, row, binding) {
                        any |= self.run(at + 1, decided, binding)?;
                        if any && decided {
                            return Ok(true);
                        }
                    }
                }
                binds.iter().for_each(|&s| binding[s] = UNBOUND);
                Ok(any)
            }
        }
    }
}

/// Matches terms with a row and binds the slots without a value. Fails if an object is not in the range of its slot.
pub(crate) fn unify(rule: &Rule, terms: &[pddl::model::Term], row: &[u32], binding: &mut [u32]) -> bool {
    terms.iter().zip(row).all(|(&term, &object)| match term {
        pddl::model::Term::Object(o) => o.0 == object,
        pddl::model::Term::Variable(v) => {
            let slot = &mut binding[v.0 as usize];
            if *slot == UNBOUND {
                *slot = object;
                rule.slots[v.0 as usize].contains(object)
            } else {
                *slot == object
            }
        }
    })
}
