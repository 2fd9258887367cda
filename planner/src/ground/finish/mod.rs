//! Numbers the remaining facts and assembles the task.
//!
//! In: the model, its atoms, exclusions and instances, and the results of pruning. Out: the
//! [`Task`].

mod costs;
mod goal;
mod groups;
mod numeric;
mod view;

use super::error::{Failure, Feature, GroundError, Origin};
use super::exclusion::Exclusions;
use super::instantiate::RawTask;
use super::normalise::Normalised;
use super::prune::Pruned;
use super::relax::Reached;
use crate::ids::{FactId, id32};
use crate::task::{
    AtomStatus, AxiomProgram, AxiomRule, Fact, GroundAtom, Mutexes, Names, NewOperator, NoProgram, Numeric,
    ObjectValue, Operators, Packing, Relaxation, State, SuccessorTree, Task, undominated, variables,
};
use budget::{Interrupted, Meter};
use costs::set_costs;
use goal::goal;
use groups::groups;
use numeric::{Chosen, comparisons};
use pddl::model::IndexVec;
use view::{NONE, Parts, View};

/// From this many operators on, a second thread is worth its start.
const PARALLEL: usize = 5_000;

/// Builds the task from `raw` and the results of pruning.
pub(crate) fn finish(
    model: &Normalised<'_>,
    Reached { table, statics, initial, .. }: Reached,
    exclusions: &Exclusions,
    mut raw: RawTask,
    pruned: &Pruned,
    meter: &Meter<'_>,
) -> Result<Task, Failure> {
    let Normalised { domain, problem, costs, fluents, .. } = model;
    let names = Names::of(domain, problem, model.values.clone());
    let known = id32(table.len());
    let mut facts: IndexVec<FactId, Fact> = IndexVec::new();
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
            numbers[i] = facts
                .push(Fact {
                    atom,
                    value,
                    derived: pruned.derived[i] || pruned.compared[i],
                    compares: pruned.compared[i],
                })
                .0;
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
    let view = View { pruned, numbers: &numbers };
    let goal = goal(&raw, &view, &table, &names);
    let mut rules: Vec<AxiomRule> = Vec::new();
    for (head, body) in raw.rules.iter().filter(|(h, _)| numbers[*h as usize] != NONE) {
        meter.spend(64 + 8 * body.len())?;
        if let Some(body) = view.literals(body) {
            rules.push(AxiomRule { head: FactId(numbers[*head as usize]), body });
        }
    }
    let chosen = Chosen::of(&raw, pruned, fluents);
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
    for &a in &initial {
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
        ways: std::sync::OnceLock::new(),
    })
}
