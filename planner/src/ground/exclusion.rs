//! Mutual exclusion of reachable atoms.
//!
//! Problem: relaxed reachability lets a robot be in two rooms, so it finds instances that are never
//! applicable. Idea: the domain's invariants, counted in the initial state, give groups of atoms of
//! which at most one ever holds. A conjunction with two atoms of a group is impossible; if one of
//! them holds, the others do not. Some invariants hold only if certain parameters of an action are
//! different; such an invariant is used if no reached instance has these parameters equal.
//! Invariant: an invariant over an exogenous predicate gives no group, so operators alone keep
//! every group. Cost: one hash look-up for each atom of each invariant, bounded; then a few array
//! reads for each literal.
//!
//! Source: Helmert, "Concise finite-domain representations for PDDL planning tasks", AIJ 2009, §5.

use super::binding::resolve;
use super::literal::Lit;
use super::normalise::Normalised;
use super::relax::{Bindings, Reached};
use crate::ids::id32;
use crate::task::{AtomTable, RowKeys, Rows, ValuePredicates};
use analysis::happening::Happening;
use analysis::invariants::{Invariant, Member, Proviso, conditional_invariants};
use budget::{Interrupted, Meter};
use pddl::model::{Domain, PredicateId, Term};
use rustc_hash::{FxHashMap, FxHashSet};

/// The most entries in all groups; further invariants are dropped.
const ENTRIES: usize = 20_000_000;

/// Groups of atoms of which at most one holds.
#[derive(Default)]
pub(crate) struct Exclusions {
    /// By atom: its groups.
    groups: Rows,
    count: usize,
}

impl Exclusions {
    /// The exclusions among the reached atoms.
    pub(crate) fn new(
        model: &Normalised<'_>,
        Reached { table, statics, initial, bindings }: &Reached,
        meter: &Meter<'_>,
    ) -> Result<Self, Interrupted> {
        let Normalised { domain, problem, exogenous, values, .. } = model;
        // Invariants assume that an object has one type.
        if problem.objects.iter().any(|o| o.types.are_several()) {
            return Ok(Self::default());
        }
        let happenings: Vec<Happening<'_>> =
            domain.actions.enumerate().map(|(id, action)| Happening::of_action(id, action)).collect();
        let candidates =
            conditional_invariants(domain, &happenings, &mut |work| meter.spend(64 * work).is_ok());
        meter.spend(0)?;
        let mut known: FxHashMap<Proviso, bool> = FxHashMap::default();
        let mut found = Vec::new();
        for (invariant, provisos) in candidates {
            let mut kept = true;
            for proviso in provisos {
                kept = match known.get(&proviso) {
                    Some(&known) => known,
                    None => {
                        let keeps = keeps(&proviso, domain, bindings, meter)?;
                        known.insert(proviso, keeps);
                        keeps
                    }
                };
                if !kept {
                    break;
                }
            }
            if kept {
                found.push(invariant);
            }
        }
        found.extend(of_values(domain, values));
        found.retain(|i| i.members.iter().all(|m| !exogenous.contains(&m.predicate)));
        if found.is_empty() {
            return Ok(Self::default());
        }
        let atoms = id32(table.len());
        let mut by_predicate: Vec<Vec<u32>> = vec![Vec::new(); domain.predicates.len()];
        for atom in *statics..atoms {
            meter.spend(8)?;
            by_predicate[table.predicate(atom).0 as usize].push(atom);
        }
        let holds: FxHashSet<u32> = initial.iter().copied().collect();
        let mut groups = Rows::default();
        let mut known: FxHashSet<Vec<u32>> = FxHashSet::default();
        for invariant in &found {
            for group in instances(invariant, table, &by_predicate, &holds, problem.objects.len(), meter)? {
                meter.spend(64 + 8 * group.len())?;
                if groups.items() + group.len() > ENTRIES || known.contains(&group) {
                    continue;
                }
                groups.push(group.iter().copied());
                known.insert(group);
            }
        }
        Ok(Self { groups: groups.transposed(atoms as usize, meter)?, count: groups.len() })
    }

    /// The groups of an atom.
    pub(crate) fn of(&self, atom: u32) -> &[u32] {
        if (atom as usize) < self.groups.len() { self.groups.row(atom) } else { &[] }
    }

    /// The number of groups.
    pub(crate) fn len(&self) -> usize {
        self.count
    }
}

/// Whether no reached instance has all these terms equal.
fn keeps(
    proviso: &Proviso,
    domain: &Domain,
    bindings: &[Bindings],
    meter: &Meter<'_>,
) -> Result<bool, Interrupted> {
    // The first schemas are the actions, in their order.
    let Some(action) = domain.actions.iter().nth(proviso.happening) else { return Ok(false) };
    let own = &bindings[proviso.happening];
    let parameters = action.variables.parameters;
    // The row does not contain quantified variables.
    let is_bound = |t: &Term| !matches!(t, Term::Variable(v) if v.0 as usize >= parameters);
    if !proviso.equal.iter().all(|(a, b)| is_bound(a) && is_bound(b)) {
        return Ok(false);
    }
    for row in 0..own.rows {
        meter.spend(16)?;
        let row = &own.values[row * own.width..][..own.width];
        if proviso.equal.iter().all(|&(a, b)| resolve(a, row) == resolve(b, row)) {
            return Ok(false);
        }
    }
    Ok(true)
}

/// An object fluent has one value; the compilation guarantees it.
fn of_values(domain: &Domain, values: &ValuePredicates) -> Vec<Invariant> {
    let is_value = |&p: &PredicateId| values.function(p).is_some();
    let one = |predicate: PredicateId| {
        let value = domain.predicates[predicate].variables.parameters.saturating_sub(1);
        Invariant {
            members: vec![Member { predicate, parameters: (0..value).collect(), counted: Some(value) }],
        }
    };
    domain.predicates.ids().filter(is_value).map(one).collect()
}

/// The groups of an invariant of which at most one atom holds initially and at least two are reached.
fn instances(
    invariant: &Invariant,
    table: &AtomTable,
    by_predicate: &[Vec<u32>],
    holds: &FxHashSet<u32>,
    objects: usize,
    meter: &Meter<'_>,
) -> Result<Vec<Vec<u32>>, Interrupted> {
    let mut packing = RowKeys::new(objects);
    let mut numbers: FxHashMap<u64, usize> = FxHashMap::default();
    let mut found: Vec<(u32, Vec<u32>)> = Vec::new();
    for member in &invariant.members {
        for &atom in &by_predicate[member.predicate.0 as usize] {
            meter.spend(64)?;
            let row = table.row(atom);
            let key = packing.key(member.parameters.iter().map(|&p| row[p]));
            let next = found.len();
            let number = *numbers.entry(key).or_insert(next);
            if number == next {
                found.push((0, Vec::new()));
            }
            let (held, group) = &mut found[number];
            *held += u32::from(holds.contains(&atom));
            group.push(atom);
        }
    }
    let exclusive = found.into_iter().filter(|(held, group)| *held <= 1 && group.len() > 1);
    Ok(exclusive.map(|(_, group)| group).collect())
}

/// The groups with an atom in the current conjunction.
#[derive(Default)]
pub(crate) struct Marks {
    generation: u32,
    of: Vec<u32>,
}

impl Marks {
    pub(crate) fn new(exclusions: &Exclusions) -> Self {
        Self { generation: 0, of: vec![0; exclusions.len()] }
    }

    /// Marks the groups of the positive literals; `false` if two are of one group.
    pub(crate) fn take(&mut self, exclusions: &Exclusions, literals: &[Lit]) -> bool {
        self.generation += 1;
        self.add(exclusions, literals)
    }

    /// Marks further literals; `false` if two are of one group.
    fn add(&mut self, exclusions: &Exclusions, literals: &[Lit]) -> bool {
        let mut possible = true;
        for &l in literals.iter().filter(|&&l| l & 1 == 0) {
            for &group in exclusions.of(l >> 1) {
                possible &=
                    std::mem::replace(&mut self.of[group as usize], self.generation) != self.generation;
            }
        }
        possible
    }

    /// Whether a marked literal excludes this unmarked atom.
    pub(crate) fn exclude(&self, exclusions: &Exclusions, atom: u32) -> bool {
        exclusions.of(atom).iter().any(|&g| self.of[g as usize] == self.generation)
    }
}
