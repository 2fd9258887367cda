//! From a domain and a problem to a grounded task.
//!
//! Stages, each a module: object fluents to predicates (`values`), conditions to negation normal form
//! (`formula`, `schema`), the metric to operator costs (`cost`), relaxed reachability by ordered joins
//! (`rule`, `plan`, `join`), atoms that exclude each other (`exclusion`), instances with quantifiers
//! expanded and disjunctions split (`instantiate`, `raw`), constants and irrelevant atoms dropped
//! (`prune`), and the final task (`finish`). Invariant: every plan of the problem is a
//! sequence of the task's operators, and every plan of the task is a plan of the problem.
//!
//! Source: Helmert, "Concise finite-domain representations for PDDL planning tasks", AIJ 2009.

mod cost;
mod error;
mod exclusion;
mod finish;
mod fluents;
mod formula;
mod instantiate;
mod join;
mod measure;
mod memory;
mod numbers;
mod plan;
mod prune;
mod raw;
mod rule;
mod schema;
mod universe;
mod values;

pub use error::{Feature, GroundError, GroundOptions, Origin};

use crate::task::{AtomTable, Names, Task, ValuePredicates};
use budget::{Interrupted, Meter};
use cost::{CostModel, Measure, metric_span};
use exclusion::Exclusions;
use fluents::Fluents;
use formula::Formula;
use pddl::Diagnostic;
use pddl::model::Feature as Language;
use pddl::model::{Domain, EffectKind, Idx, PredicateId, Problem};
use raw::Failure;
use std::cmp::Reverse;
use universe::Universe;

/// Grounds `problem` of `domain`.
///
/// # Errors
/// A feature that the planner does not support, a limit of `options`, or its interruption.
pub fn ground(domain: &Domain, problem: &Problem, options: &GroundOptions<'_>) -> Result<Task, GroundError> {
    metered(domain, problem, options.exogenous, &Meter::new(memory::limited(options.budget)))
}

/// The same, with a meter that its caller can read.
fn metered(
    domain: &Domain,
    problem: &Problem,
    exogenous: &[PredicateId],
    meter: &Meter<'_>,
) -> Result<Task, GroundError> {
    refuse(domain, problem)?;
    let compiled = values::compile(domain, problem);
    let (domain, problem, values) = match &compiled {
        Some((domain, problem, values)) => (domain, problem, values.clone()),
        None => (domain, problem, ValuePredicates::none(domain)),
    };
    match build(domain, problem, values.clone(), (exogenous, meter), true) {
        Err(Failure::NegativeCost) => build(domain, problem, values, (exogenous, meter), false),
        result => result,
    }
    .map_err(|failure| match failure {
        Failure::Ground(error) => error,
        Failure::Interrupted => GroundError::Interrupted { schema: problem.name.clone() },
        // Costs that are evaluated along the plan are never negative ones.
        Failure::NegativeCost => GroundError::Unsupported {
            feature: Feature::OptimalMetric,
            origin: Origin::Problem,
            span: metric_span(problem),
        },
    })
}

/// Grounds a model without object fluents. `additive` says whether costs may be tried to be summed up.
fn build(
    domain: &Domain,
    problem: &Problem,
    values: ValuePredicates,
    (exogenous, meter): (&[PredicateId], &Meter<'_>),
    additive: bool,
) -> Result<Task, Failure> {
    let mut fluents = Fluents::new(domain, problem)?;
    let costs = CostModel::new(domain, problem, &fluents, additive);
    if let Measure::Value(metric) = &costs.measure {
        fluents.reads(&metric.expression, Origin::Problem)?;
    }
    let mut universe = Universe::new(domain, problem);
    let schemas = schema::schemas(domain, &mut universe, &costs, &fluents)?;
    let is_static = static_predicates(domain, exogenous);

    let mut table = AtomTable::new(domain.predicates.len(), problem.objects.len());
    let insert = |table: &mut AtomTable, fact: &pddl::model::Fact| {
        meter.spend(128).map(|()| table.insert(fact.predicate, fact.arguments.iter().map(|o| o.0)))
    };
    for fact in problem.init.iter().filter(|f| is_static[f.predicate.index()]) {
        insert(&mut table, fact)?;
    }
    let statics = ids_of(&table);
    let mut initial = Vec::new();
    for fact in problem.init.iter().filter(|f| !is_static[f.predicate.index()]) {
        initial.push(insert(&mut table, fact)?);
    }
    for &predicate in exogenous {
        add_all_instances(domain, predicate, &mut universe, &mut table, meter)?;
    }

    let rules = rule::rules(&schemas, &is_static, &fluents);
    let reached =
        join::reach(&schemas, &rules, table, statics, (&is_static, &fluents), problem.objects.len(), meter)?;
    let goal = Formula::of(&problem.goal, true, Origin::Problem, &mut universe)?;
    let slots = universe.slots(&problem.goal_variables);
    let exclusions =
        Exclusions::new(domain, problem, &values, exogenous, &reached, statics, &initial, meter)?;
    let most = (0..schemas.len()).max_by_key(|&i| (reached.bindings[i].rows, Reverse(i)));
    let most = most.map(|i| schemas[i].name.clone());
    let models = (&costs, &fluents);
    let raw = raw::instantiate(
        &schemas,
        &reached,
        &is_static,
        &exclusions,
        models,
        &values,
        (&goal, &slots),
        meter,
    )?;
    drop(reached.bindings);
    let names = Names::of(domain, problem, values);
    finish::finish(
        domain,
        problem,
        models,
        reached.table,
        raw,
        &exclusions,
        statics,
        &initial,
        names,
        (exogenous, meter),
    )
    .map_err(|failure| match (failure, most) {
        (Failure::Interrupted, Some(schema)) => GroundError::Interrupted { schema }.into(),
        (failure, _) => failure,
    })
}

fn ids_of(table: &AtomTable) -> u32 {
    crate::ids::id32(table.len())
}

/// Refuses what forward search cannot take, by name and place.
fn refuse(domain: &Domain, problem: &Problem) -> Result<(), GroundError> {
    let refuse = |feature, origin, span| Err(GroundError::Unsupported { feature, origin, span });
    let first = |list: &[Diagnostic]| list.first().map(|d| d.span);
    if let Some(span) = first(&domain.unsupported) {
        return refuse(Feature::OutsideTheModel, Origin::Domain, span);
    }
    if let Some(span) = first(&problem.unsupported) {
        return refuse(Feature::OutsideTheModel, Origin::Problem, span);
    }
    // Types in conditions are looked up while grounding; methods are not read.
    let is_read = |feature| !matches!(feature, Language::TypePredicates | Language::NetworkConstraints);
    if let Some((feature, span)) = domain.features().into_iter().find(|(f, _)| is_read(*f)) {
        return refuse(Feature::Language(feature), Origin::Domain, span);
    }
    if let Some((feature, span)) = problem.features().into_iter().find(|(f, _)| is_read(*f)) {
        return refuse(Feature::Language(feature), Origin::Problem, span);
    }
    if let Some(action) = domain.durative_actions.iter().next() {
        return refuse(Feature::DurativeActions, Origin::Domain, action.span);
    }
    if problem.htn.is_some() {
        return refuse(Feature::TaskNetwork, Origin::Problem, problem.goal_span);
    }
    Ok(())
}

/// By predicate: whether nothing changes it.
fn static_predicates(domain: &Domain, exogenous: &[PredicateId]) -> Vec<bool> {
    let mut is_static = vec![true; domain.predicates.len()];
    for action in &domain.actions {
        action.effect.each(&mut |part| {
            if let EffectKind::Add(atom) | EffectKind::Delete(atom) = &part.kind {
                is_static[atom.predicate.index()] = false;
            }
        });
    }
    domain.axioms.iter().for_each(|a| is_static[a.predicate.index()] = false);
    exogenous.iter().for_each(|p| is_static[p.index()] = false);
    is_static
}

fn add_all_instances(
    domain: &Domain,
    predicate: PredicateId,
    universe: &mut Universe<'_>,
    table: &mut AtomTable,
    meter: &Meter<'_>,
) -> Result<(), Failure> {
    let declared = &domain.predicates[predicate];
    let ranges = universe.slots(&declared.variables);
    let ranges: Vec<&[u32]> =
        ranges[..declared.variables.parameters].iter().map(|r| r.objects.as_slice()).collect();
    if ranges.iter().any(|r| r.is_empty()) {
        return Ok(());
    }
    let before = table.len();
    let mut odometer = vec![0_usize; ranges.len()];
    loop {
        meter.spend(128)?;
        table.insert(predicate, odometer.iter().zip(&ranges).map(|(&i, r)| r[i]));
        let instances = table.len() - before;
        if meter.hold(instances * memory::atom(ranges.len())) == Err(Interrupted::Memory) {
            return Err(GroundError::Limit { schema: declared.name.clone(), instances }.into());
        }
        let Some(digit) = (0..ranges.len()).rev().find(|&d| odometer[d] + 1 < ranges[d].len()) else {
            return Ok(());
        };
        odometer[digit] += 1;
        odometer[digit + 1..].fill(0);
    }
}

#[cfg(test)]
mod tests {
    use super::metered;
    use budget::{Budget, INTERVAL, Meter};
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

    #[test]
    fn no_stage_of_grounding_works_for_long_without_a_look() {
        let places: String = (0..70).map(|i| format!(" p{i}")).collect();
        let ways: String = (0..70).flat_map(|a| (0..70).map(move |b| format!("(way p{a} p{b})"))).collect();
        let domain = "(define (domain d) (:requirements :adl :derived-predicates)
           (:predicates (at ?v ?p) (van ?v) (way ?a ?b) (clean ?p) (calm) (busy ?p))
           (:derived (busy ?p) (exists (?v) (at ?v ?p)))
           (:derived (calm) (forall (?p) (imply (busy ?p) (clean ?p))))
           (:action go :parameters (?v ?a ?b) :precondition (and (van ?v) (at ?v ?a) (way ?a ?b))
            :effect (and (not (at ?v ?a)) (at ?v ?b) (when (clean ?b) (not (clean ?b)))))
           (:action wipe :parameters (?v ?a) :precondition (at ?v ?a) :effect (clean ?a)))";
        let problem = format!(
            "(define (problem p) (:domain d) (:objects v w{places})
             (:init (van v) (van w) (at v p0) (at w p1) {ways}) (:goal (and (at v p9) (calm))))"
        );
        let domain = pddl::parse_domain(&pddl::Source::new("d", domain), &[]).model.unwrap();
        let problem = pddl::parse_problem(&pddl::Source::new("p", problem), &domain).model.unwrap();
        let meter_cell = OnceLock::<&Meter<'_>>::new();
        let (looked, widest) = (AtomicU64::new(0), AtomicU64::new(0));
        let interrupted = || {
            let work = meter_cell.get().map_or(0, |meter| meter.work());
            widest.fetch_max(work - looked.swap(work, Relaxed), Relaxed);
            false
        };
        let meter = Meter::new(Budget { interrupted: &interrupted, ..Budget::default() });
        meter_cell.set(&meter).expect("it is empty");
        let task = metered(&domain, &problem, &[], &meter).unwrap();
        assert!(task.operators().len() > 9_000);
        interrupted();
        let widest = widest.load(Relaxed);
        assert!(widest < 2 * INTERVAL as u64, "{widest} units between two looks");
    }
}
