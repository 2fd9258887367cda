//! Numbers the facts that remain and assembles the task.

use super::cost::{CostModel, Measure, scale};
use super::error::{Feature, GroundError, Origin};
use super::exclusion::Exclusions;
use super::fluents::Fluents;
use super::formula::Formula;
use super::instantiate::Lit;
use super::measure::{Chosen, comparisons};
use super::numbers::Comparison;
use super::prune::{Pruned, prune};
use super::raw::{Failure, RawOperator, RawOperators, RawTask, marked};
use crate::ids::{FactId, id32};
use crate::task::AtomTable;
use crate::task::{
    AtomStatus, AxiomProgram, AxiomRule, Fact, Goal, GroundAtom, Impossible, Literals, Mutexes, Names,
    NewOperator, NoProgram, Numeric, ObjectValue, Operators, Packing, Relaxation, State, SuccessorTree, Task,
    undominated, variables,
};
use budget::{Interrupted, Meter};
use pddl::model::{Domain, IndexVec, ObjectId, PredicateId, Problem};
use rustc_hash::FxHashSet;

const NONE: u32 = u32::MAX;

/// Operators from which on a second thread is worth its start.
const PARALLEL: usize = 5_000;

/// Builds the task of what `raw` and the analysis leave.
#[expect(clippy::too_many_arguments, reason = "the last stage takes what all others made")]
pub(crate) fn finish(
    domain: &Domain,
    problem: &Problem,
    (costs, fluents): (&CostModel, &Fluents),
    table: AtomTable,
    mut raw: RawTask,
    exclusions: &Exclusions,
    statics: u32,
    initial: &[u32],
    names: Names,
    (exogenous, meter): (&[PredicateId], &Meter<'_>),
) -> Result<Task, Failure> {
    let known = id32(table.len());
    let value = |&fluent: &u32| fluents.initial(&raw.numbers.keys[fluent as usize]);
    let compared = marked(raw.atoms, raw.numbers.atoms.iter().map(|(atom, _)| *atom));
    let compare = |comparison: &Comparison<u32>| {
        comparison.expression.evaluate(&value).is_ok_and(|n| comparison.relation.holds(n.sign()))
    };
    let equal = raw.numbers.atoms.iter().filter(|(_, c)| compare(c)).map(|(atom, _)| *atom);
    let holds = marked(raw.atoms, (0..statics).chain(initial.iter().copied()).chain(equal));
    let is_derived = |a: u32| {
        if a < known { domain.predicates[table.predicate(a)].derived } else { !compared[a as usize] }
    };
    let derived = marked(raw.atoms, (statics..raw.atoms).filter(|&a| is_derived(a)));
    let is_exogenous = |a: u32| a < known && exogenous.contains(&table.predicate(a));
    let exogenous = marked(raw.atoms, (statics..raw.atoms).filter(|&a| is_exogenous(a)));
    let pruned = prune(&raw, &holds, &derived, &exogenous, meter)?;

    let mut facts: IndexVec<crate::ids::FactId, Fact> = IndexVec::new();
    let mut numbers = vec![NONE; raw.atoms as usize];
    let mut status = Vec::with_capacity(known as usize);
    for a in 0..raw.atoms {
        meter.spend(64)?;
        let i = a as usize;
        let kept = pruned.needed[i] && !pruned.always[i] && !pruned.never[i];
        if kept {
            let atom = (a < known)
                .then(|| GroundAtom { predicate: table.predicate(a), arguments: table.objects(a) });
            let value = atom.as_ref().and_then(|a| names.values().value(a.predicate, &a.arguments));
            let value = value.map(|(fluent, object)| ObjectValue { fluent, object });
            let atom = atom.filter(|_| value.is_none());
            numbers[i] =
                facts.push(Fact { atom, value, derived: derived[i] || compared[i], compares: compared[i] }).0;
        }
        if a < known {
            status.push(match kept {
                true => AtomStatus::Fact(FactId(numbers[i])),
                false if a < statics || pruned.always[i] => AtomStatus::AlwaysTrue,
                false if pruned.never[i] => AtomStatus::NeverTrue,
                false => AtomStatus::Irrelevant,
            });
        }
    }
    let goal = goal(&raw, &pruned, &numbers, &table, &names);
    let view = View { pruned: &pruned, numbers: &numbers };
    let mut rules: Vec<AxiomRule> = Vec::new();
    for (head, body) in raw.rules.iter().filter(|(h, _)| numbers[*h as usize] != NONE) {
        meter.spend(64 + 8 * body.len())?;
        if let Some(body) = view.literals(body) {
            rules.push(AxiomRule { head: FactId(numbers[*head as usize]), body });
        }
    }
    let chosen = Chosen::of(&raw, &pruned, fluents);
    let (mut operators, mut amounts, mut parts) = (Operators::default(), Vec::new(), Parts::default());
    let raw_operators = std::mem::take(&mut raw.operators);
    for (own, &improves) in raw_operators.iter().zip(&pruned.improves) {
        meter.spend(raw_operators.work(&own))?;
        if pruned.is_refuted(own.precondition) {
            continue;
        }
        let numeric = chosen.effects(&own, &view);
        let counts = improves || numeric.as_ref().is_some_and(|effects| !effects.updates.is_empty());
        if !view.operator(&raw_operators, &own, counts, &mut parts, &mut operators) {
            continue;
        }
        amounts.push(if chosen.metric.is_some() { chosen.guess(numeric.as_deref()) } else { own.cost });
        let (action, arguments) = (own.action, &parts.arguments[..]);
        operators.push(NewOperator { action, arguments, facts: parts.facts(), numeric });
    }
    drop(raw_operators);
    let cost_scale = set_costs(&mut operators, &amounts, costs, meter)?;
    let fact = |atom: u32| (numbers[atom as usize] != NONE).then(|| FactId(numbers[atom as usize]));
    let compared = comparisons(&raw, &chosen, fact);

    let axioms = AxiomProgram::new(&facts, rules, meter).map_err(|why| {
        let NoProgram::NotStratified(fact) = why else { return Failure::Interrupted };
        let predicate = facts[fact].atom.as_ref().map(|a| a.predicate);
        let axiom = domain.axioms.iter().find(|x| predicate.is_none_or(|p| p == x.predicate));
        Failure::Ground(GroundError::Unsupported {
            feature: Feature::UnstratifiedAxioms,
            origin: Origin::Domain,
            span: axiom.map_or(problem.goal_span, |x| x.span),
        })
    })?;
    let Chosen { fluents, stored, metric, .. } = chosen;
    let numeric = Numeric::new(facts.len().div_ceil(64), fluents, stored, compared, operators.numeric_mut());
    let mut state = State::empty(facts.len(), numeric.words());
    let fit = numeric.initialise(state.words_mut());
    state.note_fit(fit);
    for &a in initial {
        if numbers[a as usize] != NONE {
            state.insert(FactId(numbers[a as usize]));
        }
    }
    axioms.close(state.words_mut());
    let groups = groups(exclusions, &numbers, known, meter)?;
    let mutexes = Mutexes::new(facts.len(), &groups, &operators, &state, meter)?;
    let relaxation = || {
        let relaxation = Relaxation::new(&facts, &operators, &axioms, &numeric, &goal, meter)?;
        Ok::<_, Interrupted>((undominated(&relaxation, meter)?, relaxation))
    };
    let (successors, relaxation) = if operators.len() < PARALLEL {
        (SuccessorTree::new(facts.len(), &operators, meter), relaxation())
    } else {
        let tree = || SuccessorTree::new(facts.len(), &operators, &Meter::new(meter.budget()));
        std::thread::scope(|scope| {
            let tree = scope.spawn(tree);
            let relaxation = relaxation();
            (tree.join().expect("it panics nowhere"), relaxation)
        })
    };
    let (successors, (undominated, relaxation)) = (successors?, relaxation?);
    let is_derived: Vec<bool> = facts.iter().map(|f| f.derived).collect();
    let variables = variables(&mutexes, &is_derived);
    Ok(Task {
        packing: Packing::new(facts.len(), &variables),
        variables,
        mutexes,
        successors,
        undominated,
        relaxation,
        facts,
        operators,
        axioms,
        initial: state,
        goal,
        atoms: table,
        status,
        names,
        cost_scale,
        numeric,
        metric,
    })
}

/// The groups of which at least two atoms are facts.
fn groups(
    exclusions: &Exclusions,
    numbers: &[u32],
    known: u32,
    meter: &Meter<'_>,
) -> Result<Vec<Vec<u32>>, Interrupted> {
    let mut groups: Vec<Vec<u32>> = vec![Vec::new(); exclusions.len()];
    for atom in (0..known).filter(|&a| numbers[a as usize] != NONE) {
        meter.spend(8 + 16 * exclusions.of(atom).len())?;
        for &group in exclusions.of(atom) {
            groups[group as usize].push(numbers[atom as usize]);
        }
    }
    // Different groups of atoms may be the same group of facts. In order, by their first facts.
    let mut by_first: Vec<Vec<Vec<u32>>> = vec![Vec::new(); numbers.len()];
    for group in groups.into_iter().filter(|g| g.len() > 1) {
        meter.spend(32)?;
        by_first[group[0] as usize].push(group);
    }
    let mut sorted = Vec::new();
    for mut group in by_first {
        meter.spend(4 + 256 * group.len())?;
        group.sort_unstable();
        group.dedup();
        sorted.append(&mut group);
    }
    Ok(sorted)
}

/// Makes integers of the costs; gives the scale.
fn set_costs(
    operators: &mut Operators,
    amounts: &[f64],
    costs: &CostModel,
    meter: &Meter<'_>,
) -> Result<u32, Interrupted> {
    // Where nothing costs anything, fewer steps are better.
    if costs.is_unit() || (matches!(costs.measure, Measure::Value(_)) && amounts.iter().all(|&a| a == 0.0)) {
        return Ok(1);
    }
    let mut different = FxHashSet::default();
    for part in meter.chunks(amounts, 8) {
        different.extend(part?.iter().map(|amount| amount.to_bits()));
    }
    let scale = scale(&different.into_iter().map(f64::from_bits).collect::<Vec<_>>());
    for (operator, amount) in amounts.iter().enumerate() {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "not negative; saturates"
        )]
        let cost = (amount * f64::from(scale)).round() as u32;
        operators.set_cost(operator, cost);
        meter.spend(8)?;
    }
    Ok(scale)
}

pub(super) struct View<'a> {
    pruned: &'a Pruned,
    numbers: &'a [u32],
}

impl View<'_> {
    /// The facts of a conjunction; `None` if it never holds.
    pub(super) fn literals(&self, literals: &[Lit]) -> Option<Literals> {
        let (mut positive, mut negative) = (0, 0);
        for &l in literals {
            match self.pruned.constant(l) {
                Some(true) => {}
                Some(false) => return None,
                None if l & 1 == 0 => positive += 1,
                None => negative += 1,
            }
        }
        // Literals are sorted, and facts are numbered in the order of their atoms.
        let facts = |negated: u32, count: usize| {
            let mut facts = Vec::with_capacity(count);
            let open = literals.iter().filter(|&&l| l & 1 == negated && self.pruned.constant(l).is_none());
            facts.extend(open.map(|&l| FactId(self.numbers[(l >> 1) as usize])));
            debug_assert!(facts.is_sorted());
            facts.into_boxed_slice()
        };
        Some(Literals { positive: facts(0, positive), negative: facts(1, negative) })
    }

    /// The facts among atoms that are sorted, instead of what was in `facts`.
    fn facts(&self, atoms: &[u32], facts: &mut Vec<FactId>) {
        facts.clear();
        facts.extend(atoms.iter().map(|&a| self.numbers[a as usize]).filter(|&n| n != NONE).map(FactId));
        debug_assert!(facts.is_sorted());
    }

    /// The facts of a conjunction; `false` if it never holds.
    fn condition(&self, literals: &[Lit], positive: &mut Vec<FactId>, negative: &mut Vec<FactId>) -> bool {
        positive.clear();
        negative.clear();
        for &l in literals {
            match self.pruned.constant(l) {
                Some(true) => {}
                Some(false) => return false,
                None => {
                    let fact = FactId(self.numbers[(l >> 1) as usize]);
                    (if l & 1 == 0 { &mut *positive } else { &mut *negative }).push(fact);
                }
            }
        }
        true
    }

    /// Fills in the operator's parts, unless it changes no fact that is needed and its effects on numbers
    /// do not count. Its conditional effects are added to `operators`. Answers
    /// whether it is of use.
    fn operator(
        &self,
        all: &RawOperators,
        raw: &RawOperator<'_>,
        counts: bool,
        parts: &mut Parts,
        operators: &mut Operators,
    ) -> bool {
        // What a useless operator reads was not kept.
        let Parts { arguments, positive, negative, adds, deletes, conditional } = parts;
        self.facts(raw.adds, adds);
        self.facts(raw.deletes, deletes);
        let mut effects = 0;
        for (condition, adds, deletes) in all.conditional(raw) {
            let [p, n, a, d] = conditional;
            self.facts(adds, a);
            self.facts(deletes, d);
            if (!a.is_empty() || !d.is_empty()) && self.condition(condition, p, n) {
                operators.push_conditional([p, n, a, d]);
                effects += 1;
            }
        }
        if adds.is_empty() && deletes.is_empty() && effects == 0 && !counts {
            return false;
        }
        self.condition(raw.precondition, positive, negative);
        arguments.clear();
        arguments.extend(raw.arguments.iter().map(|&o| ObjectId(o)));
        true
    }
}

/// The parts of the operator at hand.
#[derive(Default)]
struct Parts {
    arguments: Vec<ObjectId>,
    positive: Vec<FactId>,
    negative: Vec<FactId>,
    adds: Vec<FactId>,
    deletes: Vec<FactId>,
    conditional: [Vec<FactId>; 4],
}

impl Parts {
    fn facts(&self) -> [&[FactId]; 4] {
        [&self.positive, &self.negative, &self.adds, &self.deletes]
    }
}

fn goal(raw: &RawTask, pruned: &Pruned, numbers: &[u32], table: &AtomTable, names: &Names) -> Goal {
    let mut atoms = Vec::new();
    let mut negated = Vec::new();
    let mut formula = false;
    let is_value = |atom: &GroundAtom| names.values().function(atom.predicate).is_some();
    let mut blame = |atom: Option<GroundAtom>, positive: bool| match atom.filter(|a| !is_value(a)) {
        Some(atom) if positive => atoms.push(atom),
        Some(atom) => negated.push(atom),
        None => formula = true,
    };
    for conjunct in &raw.refuted {
        match conjunct {
            Formula::Literal(l) => {
                let objects = l.arguments.iter().map(|t| match t {
                    pddl::model::Term::Object(o) => Some(*o),
                    pddl::model::Term::Variable(_) => None,
                });
                let atom = objects.collect::<Option<_>>();
                blame(atom.map(|arguments| GroundAtom { predicate: l.predicate, arguments }), l.positive);
            }
            _ => blame(None, true),
        }
    }
    for &l in raw.goal.iter().filter(|&&l| pruned.constant(l) == Some(false)) {
        let a = l >> 1;
        let atom = ((a as usize) < table.len())
            .then(|| GroundAtom { predicate: table.predicate(a), arguments: table.objects(a) });
        blame(atom, l & 1 == 0);
    }
    let exclusive = raw.exclusive.map(|(a, b)| [a, b].map(|a| (table.predicate(a), table.objects(a))));
    let impossible = if let Some(pair) = exclusive {
        let named = pair.map(|(predicate, arguments)| GroundAtom { predicate, arguments });
        match named.iter().any(is_value) {
            true => Some(Impossible::Formula),
            false => Some(Impossible::Exclusive(named.into())),
        }
    } else if !atoms.is_empty() {
        Some(Impossible::Atoms(atoms))
    } else if !negated.is_empty() {
        Some(Impossible::NegatedAtoms(negated))
    } else {
        formula.then_some(Impossible::Formula)
    };
    let literals = View { pruned, numbers }.literals(&raw.goal).unwrap_or_default();
    Goal { literals, impossible }
}
