//! The order of a join.
//!
//! Idea: greedily choose the atom with the fewest expected matches, given the bound variables. For
//! a static predicate that is the measured mean bucket size of the index; for a changing one it is
//! the product of the possible values of its free variables. Filters run as soon as their variables
//! are bound. An atom whose variables are all bound is a single look-up.

use super::filter::{Filter, is_bound};
use super::indices::Indices;
use super::rule::{BodyAtom, Rule};
use crate::task::AtomTable;
use budget::Meter;
use pddl::model::{PredicateId, Term};
use rustc_hash::{FxHashMap, FxHashSet};

/// One step of a join.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    Check(Filter),
    Probe {
        atom: usize,
    },
    Enumerate {
        slot: usize,
    },
    Scan {
        atom: usize,
        index: usize,
        key: Vec<Term>,
        assign: Vec<(usize, usize)>,
        repeat: Vec<(usize, usize)>,
    },
}

/// The steps of a join after its trigger.
#[derive(Clone, Debug)]
pub(crate) struct JoinPlan {
    pub(crate) trigger: Option<usize>,
    pub(crate) steps: Vec<Step>,
}

/// Sizes of static predicates.
pub(crate) struct Statistics<'a> {
    table: &'a AtomTable,
    meter: &'a Meter<'a>,
    of_predicate: FxHashMap<PredicateId, Vec<u32>>,
    distinct: FxHashMap<(PredicateId, Vec<usize>), usize>,
}

impl<'a> Statistics<'a> {
    pub(crate) fn new(table: &'a AtomTable, statics: u32, meter: &'a Meter<'a>) -> Self {
        let mut of_predicate: FxHashMap<PredicateId, Vec<u32>> = FxHashMap::default();
        for atom in 0..statics {
            of_predicate.entry(table.predicate(atom)).or_default().push(atom);
        }
        Self { table, meter, of_predicate, distinct: FxHashMap::default() }
    }

    fn count(&self, predicate: PredicateId) -> usize {
        self.of_predicate.get(&predicate).map_or(0, Vec::len)
    }

    fn distinct(&mut self, predicate: PredicateId, positions: &[usize]) -> usize {
        // If the meter refuses, the stage ends and the number is not used.
        let (table, meter, atoms) = (self.table, self.meter, self.of_predicate.get(&predicate));
        *self.distinct.entry((predicate, positions.to_vec())).or_insert_with(|| {
            let atoms = atoms.into_iter().flatten().take_while(|_| meter.spend(64).is_ok());
            let rows = atoms.map(|&a| table.row(a));
            rows.map(|r| positions.iter().map(|&p| r[p]).collect()).collect::<FxHashSet<Vec<u32>>>().len()
        })
    }
}

/// The number of values of each slot, as far as types and static atoms restrict them.
#[expect(clippy::cast_precision_loss, reason = "an estimate")]
fn widths(rule: &Rule, is_static: &[bool], statistics: &mut Statistics<'_>) -> Vec<f64> {
    let mut widths: Vec<f64> = rule.slots.iter().map(|r| r.objects().len() as f64).collect();
    for atom in rule.body.iter().filter(|a| is_static[a.predicate.0 as usize]) {
        for (position, term) in atom.arguments.iter().enumerate() {
            if let Term::Variable(v) = term {
                let distinct = statistics.distinct(atom.predicate, &[position]) as f64;
                widths[v.0 as usize] = widths[v.0 as usize].min(distinct);
            }
        }
    }
    widths
}

/// Orders the join of `rule` after `trigger`.
#[expect(clippy::cast_precision_loss, reason = "an estimate")]
pub(crate) fn plan(
    rule: &Rule,
    trigger: Option<usize>,
    is_static: &[bool],
    statistics: &mut Statistics<'_>,
    indices: &mut Indices,
) -> JoinPlan {
    let widths = widths(rule, is_static, statistics);
    let mut bound = vec![false; rule.slots.len()];
    let mut steps = Vec::new();
    let mut atoms: Vec<usize> = (0..rule.body.len()).filter(|&i| Some(i) != trigger).collect();
    let mut filters = rule.filters.clone();
    if let Some(t) = trigger {
        bind(&rule.body[t], &mut bound);
    }
    loop {
        let (ready, later) = filters.into_iter().partition(|f| f.is_bound(&bound));
        filters = later;
        steps.extend(Vec::into_iter(ready).map(Step::Check));
        atoms.retain(|&i| {
            let probe = rule.body[i].arguments.iter().all(|&t| is_bound(t, &bound));
            if probe {
                steps.push(Step::Probe { atom: i });
            }
            !probe
        });
        let mut best: Option<(f64, usize)> = None;
        for &i in &atoms {
            let atom = &rule.body[i];
            let positions = bound_positions(atom, &bound);
            let matches = if is_static[atom.predicate.0 as usize] {
                let buckets = statistics.distinct(atom.predicate, &positions).max(1);
                statistics.count(atom.predicate) as f64 / buckets as f64
            } else {
                let mut free: Vec<usize> =
                    atom.arguments.iter().filter_map(|&t| free_slot(t, &bound)).collect();
                free.sort_unstable();
                free.dedup();
                free.iter().map(|&s| widths[s]).product()
            };
            // Among equals, take the first.
            if best.is_none_or(|(m, _)| matches < m) {
                best = Some((matches, i));
            }
        }
        if let Some((_, i)) = best {
            let atom = &rule.body[i];
            let positions = bound_positions(atom, &bound);
            let key = positions.iter().map(|&p| atom.arguments[p]).collect();
            let (mut assign, mut repeat) = (Vec::new(), Vec::new());
            for (position, &term) in atom.arguments.iter().enumerate() {
                if let Some(slot) = free_slot(term, &bound) {
                    let list = if assign.iter().any(|&(_, s)| s == slot) { &mut repeat } else { &mut assign };
                    list.push((position, slot));
                }
            }
            let index = indices.on(atom.predicate, &positions);
            steps.push(Step::Scan { atom: i, index, key, assign, repeat });
            bind(atom, &mut bound);
            atoms.retain(|&a| a != i);
        } else if let Some(v) = rule.variables.iter().find(|v| !bound[v.0 as usize]) {
            bound[v.0 as usize] = true;
            steps.push(Step::Enumerate { slot: v.0 as usize });
        } else {
            return JoinPlan { trigger, steps };
        }
    }
}

fn bind(atom: &BodyAtom, bound: &mut [bool]) {
    for term in &atom.arguments {
        if let Term::Variable(v) = term {
            bound[v.0 as usize] = true;
        }
    }
}

fn bound_positions(atom: &BodyAtom, bound: &[bool]) -> Vec<usize> {
    (0..atom.arguments.len()).filter(|&p| is_bound(atom.arguments[p], bound)).collect()
}

fn free_slot(term: Term, bound: &[bool]) -> Option<usize> {
    match term {
        Term::Variable(v) if !bound[v.0 as usize] => Some(v.0 as usize),
        _ => None,
    }
}
