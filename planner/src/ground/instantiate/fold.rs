//! Conditions and effects under a binding.
//!
//! Idea: when reachability has numbered every reachable atom, a formula can be folded under a
//! binding. Static and unreachable atoms become constants, and quantifiers are expanded over their
//! objects. The remaining disjunctions become alternatives (a copy of the operator for each) if
//! there are few, and otherwise an auxiliary derived atom. Equal disjunctions share their atom.

use super::folded::{Comparison, Connective, Ground, fold_parts};
use super::numbers::Numbers;
use crate::ground::binding::{object, resolve};
use crate::ground::exclusion::{Exclusions, Marks};
use crate::ground::literal::{Lit, consistent};
use crate::ground::memory::Guard;
use crate::ground::normalise::{Fluents, Formula, Key, Literal};
use crate::ids::id32;
use crate::task::AtomTable;
use budget::Meter;
use pddl::model::{Extent, ObjectId, VariableId};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// Folds formulas and stores the auxiliary atoms that they need.
pub(crate) struct Instantiator<'a> {
    pub(crate) table: &'a AtomTable,
    pub(crate) is_static: &'a [bool],
    pub(crate) exclusions: &'a Exclusions,
    pub(crate) marks: Marks,
    pub(crate) guard: Guard<'a>,
    pub(crate) fluents: &'a Fluents,
    /// The fluents and comparisons found so far.
    pub(crate) numbers: Numbers,
    auxiliary: FxHashMap<Vec<Vec<Lit>>, u32>,
    /// The rules of the auxiliary atoms: head, body.
    pub(crate) rules: Vec<(u32, Vec<Lit>)>,
    next: u32,
}

impl<'a> Instantiator<'a> {
    pub(crate) fn new(
        table: &'a AtomTable,
        is_static: &'a [bool],
        exclusions: &'a Exclusions,
        fluents: &'a Fluents,
        meter: &'a Meter<'a>,
    ) -> Self {
        let (next, marks, numbers) = (id32(table.len()), Marks::new(exclusions), Numbers::default());
        let (auxiliary, rules, guard) = (FxHashMap::default(), Vec::new(), Guard::new(meter));
        Self { table, is_static, exclusions, marks, guard, fluents, numbers, auxiliary, rules, next }
    }

    /// The number of atoms: those of the table, then auxiliary ones.
    pub(crate) fn atoms(&self) -> u32 {
        self.next
    }

    pub(crate) fn fold(&self, formula: &Formula, slots: &[Arc<Extent>], binding: &mut [u32]) -> Ground {
        match formula {
            Formula::And(parts) if parts.iter().all(Formula::is_flat) => {
                let mut literals = Vec::with_capacity(parts.len());
                for part in parts {
                    match self.fold(part, slots, binding) {
                        Ground::Literal(l) => literals.push(l),
                        Ground::False => return Ground::False,
                        _ => {}
                    }
                }
                if literals.is_empty() { Ground::True } else { Ground::Conjunction(literals) }
            }
            Formula::And(parts) => {
                fold_parts(Connective::And, parts.iter(), |f, b| self.fold(f, slots, b), binding)
            }
            Formula::Or(parts) => {
                fold_parts(Connective::Or, parts.iter(), |f, b| self.fold(f, slots, b), binding)
            }
            Formula::Exists(vs, inner) => self.quantified(vs, inner, slots, binding, false),
            Formula::Forall(vs, inner) => self.quantified(vs, inner, slots, binding, true),
            Formula::Literal(literal) => self.literal(literal, binding),
            Formula::OneOf { positive, term, extent } => {
                if extent.contains(object(*term, binding)) == *positive {
                    Ground::True
                } else {
                    Ground::False
                }
            }
            Formula::Compare { relation, left, right } => {
                Comparison::fold(*relation, left, right, self.fluents, binding)
            }
            Formula::Same { positive, left, right } => {
                if (resolve(*left, binding) == resolve(*right, binding)) == *positive {
                    Ground::True
                } else {
                    Ground::False
                }
            }
        }
    }

    fn literal(&self, literal: &Literal, binding: &[u32]) -> Ground {
        let row = literal.arguments.iter().map(|&t| resolve(t, binding));
        let negated = u32::from(!literal.positive);
        match self.table.find(literal.predicate, row) {
            None if literal.positive => Ground::False,
            None => Ground::True,
            Some(_) if self.is_static[literal.predicate.0 as usize] => {
                if literal.positive {
                    Ground::True
                } else {
                    Ground::False
                }
            }
            Some(atom) => {
                self.guard.keep();
                Ground::Literal(atom << 1 | negated)
            }
        }
    }

    fn quantified(
        &self,
        variables: &[VariableId],
        inner: &Formula,
        slots: &[Arc<Extent>],
        binding: &mut [u32],
        universal: bool,
    ) -> Ground {
        let Some((first, rest)) = variables.split_first() else {
            return self.fold(inner, slots, binding);
        };
        let slot = first.0 as usize;
        let objects = || slots[slot].objects().iter().take_while(|_| self.guard.look());
        let each = |object: &ObjectId, b: &mut [u32]| {
            b[slot] = object.0;
            self.quantified(rest, inner, slots, b, universal)
        };
        if universal {
            fold_parts(Connective::And, objects(), each, binding)
        } else {
            fold_parts(Connective::Or, objects(), each, binding)
        }
    }

    /// At most `limit` conjunctions whose disjunction is the formula; larger disjunctions become
    /// auxiliary atoms. The list is empty if the formula cannot hold.
    pub(crate) fn alternatives(&mut self, ground: Ground, limit: usize) -> Vec<Vec<Lit>> {
        let parts = match ground {
            Ground::True => return vec![Vec::new()],
            Ground::False => return Vec::new(),
            Ground::Conjunction(literals) => return self.possible(literals).into_iter().collect(),
            Ground::And(parts) => parts,
            other => vec![other],
        };
        let mut rows: Vec<Vec<Lit>> = vec![Vec::new()];
        for part in parts {
            match part {
                Ground::Or(options) if options.len() * rows.len() <= limit => {
                    let options: Vec<Vec<Lit>> =
                        options.into_iter().filter_map(|o| self.conjunction(o)).collect();
                    rows = rows
                        .iter()
                        .flat_map(|row| options.iter().map(|o| row.iter().chain(o).copied().collect()))
                        .collect();
                }
                other => match self.conjunction(other) {
                    None => return Vec::new(),
                    Some(more) => rows.iter_mut().for_each(|row| row.extend(&more)),
                },
            }
        }
        rows.into_iter().filter_map(|row| self.possible(row)).collect()
    }

    /// Literals equivalent to the formula; `None` if they contradict each other.
    pub(crate) fn conjunction(&mut self, ground: Ground) -> Option<Vec<Lit>> {
        let mut literals = Vec::new();
        self.collect(ground, &mut literals).then_some(())?;
        self.possible(literals)
    }

    /// The sorted conjunction; `None` if two literals contradict or exclude each other.
    fn possible(&mut self, literals: Vec<Lit>) -> Option<Vec<Lit>> {
        consistent(literals).filter(|l| self.marks.take(self.exclusions, l))
    }

    /// Removes negative literals that the positive ones imply.
    pub(crate) fn without_implied(&mut self, literals: &mut Vec<Lit>) {
        self.marks.take(self.exclusions, literals);
        literals.retain(|&l| l & 1 == 0 || !self.marks.exclude(self.exclusions, l >> 1));
    }

    /// Adds to the precondition that no conjunction in `never` holds; `None` if that is impossible.
    pub(crate) fn without(&mut self, precondition: Vec<Lit>, never: &[Vec<Lit>]) -> Option<Vec<Lit>> {
        let mut all = precondition;
        for conjunction in never {
            if conjunction.iter().any(|l| all.contains(&(l ^ 1))) {
                continue;
            }
            let mut options: Vec<Ground> =
                conjunction.iter().filter(|l| !all.contains(l)).map(|l| Ground::Literal(l ^ 1)).collect();
            let one = if options.len() == 1 { options.remove(0) } else { Ground::Or(options) };
            all.extend(self.conjunction(one)?);
        }
        self.possible(all)
    }

    fn collect(&mut self, ground: Ground, out: &mut Vec<Lit>) -> bool {
        match ground {
            Ground::True => true,
            Ground::False => false,
            Ground::Literal(l) => {
                out.push(l);
                true
            }
            Ground::Conjunction(literals) => {
                out.extend(literals);
                true
            }
            Ground::Compare(comparison) => {
                out.push(self.comparison(&comparison) << 1);
                true
            }
            Ground::And(parts) => parts.into_iter().all(|p| self.collect(p, out)),
            Ground::Or(options) => {
                let mut rows: Vec<Vec<Lit>> =
                    options.into_iter().filter_map(|o| self.conjunction(o)).collect();
                rows.sort_unstable();
                rows.dedup();
                if rows.is_empty() {
                    return false;
                }
                out.push(self.auxiliary(rows) << 1);
                true
            }
        }
    }

    /// The atom that represents a comparison.
    pub(crate) fn comparison(&mut self, comparison: &Comparison<Key>) -> u32 {
        let known = self.numbers.comparison(comparison, self.next);
        self.next = self.next.max(known + 1);
        known
    }

    fn auxiliary(&mut self, rows: Vec<Vec<Lit>>) -> u32 {
        if let Some(&atom) = self.auxiliary.get(&rows) {
            return atom;
        }
        let atom = self.next;
        self.next += 1;
        self.rules.extend(rows.iter().map(|row| (atom, row.clone())));
        self.auxiliary.insert(rows, atom);
        atom
    }
}
