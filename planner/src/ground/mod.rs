//! Grounding: from a domain and a problem to a grounded task.
//!
//! Grounding has five stages. Each stage is a module with its own input and output types:
//!
//! | stage | in | out |
//! |---|---|---|
//! | `normalise` | domain, problem | `Normalised`: schemas in negation normal form, costs, what is static |
//! | `relax` | `Normalised` | `Reached`: the atoms and bindings that ordered joins reach |
//! | `instantiate` | `Normalised`, `Reached`, `Exclusions` | `RawTask`: operators and rules over atoms |
//! | `prune` | `RawTask` | `Pruned`: what is constant, what is irrelevant |
//! | `finish` | all of these | [`Task`] |
//!
//! Between the second and the third stage, `exclusion` finds the atoms that exclude each other. All
//! stages use `error`, `memory` (bytes), `binding` and `literal`.
//!
//! Invariant: every plan of the problem is a sequence of the task's operators, and every plan of
//! the task is a plan of the problem.
//!
//! Source: Helmert, "Concise finite-domain representations for PDDL planning tasks", AIJ 2009.

mod binding;
mod error;
mod exclusion;
mod finish;
mod instantiate;
mod literal;
mod memory;
mod normalise;
mod prune;
mod relax;
mod support;

pub use error::{Feature, GroundError, GroundOptions, Origin};

use crate::task::{Task, ValuePredicates};
use budget::Meter;
use error::Failure;
use exclusion::Exclusions;
use normalise::{Normalised, Outside, metric_span, normalise};
use pddl::model::{Domain, Problem};
use std::cmp::Reverse;

/// Grounds `problem` of `domain`.
///
/// # Errors
/// An unsupported feature, an exceeded limit of `options`, or an interruption.
pub fn ground(domain: &Domain, problem: &Problem, options: &GroundOptions<'_>) -> Result<Task, GroundError> {
    let outside =
        Outside { predicates: options.exogenous, functions: options.exogenous_functions, kept: options.kept };
    metered(domain, problem, outside, &Meter::new(memory::limited(options.budget)))
}

/// The same, with a meter that the caller can read.
fn metered(
    domain: &Domain,
    problem: &Problem,
    outside: Outside<'_>,
    meter: &Meter<'_>,
) -> Result<Task, GroundError> {
    support::refuse(domain, problem)?;
    let compiled = normalise::compile(domain, problem);
    let (domain, problem, values) = match &compiled {
        Some((domain, problem, values)) => (domain, problem, values.clone()),
        None => (domain, problem, ValuePredicates::none(domain)),
    };
    let through = |additive| {
        let model = normalise(domain, problem, outside, values.clone(), additive)?;
        stages(&model, meter)
    };
    match through(true) {
        Err(Failure::NegativeCost) => through(false),
        result => result,
    }
    .map_err(|failure| match failure {
        Failure::Ground(error) => error,
        Failure::Interrupted => GroundError::Interrupted { schema: problem.name.clone() },
        // Unreachable: without additive costs, no operator has a negative cost.
        Failure::NegativeCost => GroundError::Unsupported {
            feature: Feature::OptimalMetric,
            origin: Origin::Problem,
            span: metric_span(problem),
        },
    })
}

/// Runs the stages after the first.
fn stages(model: &Normalised<'_>, meter: &Meter<'_>) -> Result<Task, Failure> {
    let mut reached = relax::relax(model, meter)?;
    let exclusions = Exclusions::new(model, &reached, meter)?;
    let raw = instantiate::instantiate(model, &reached, &exclusions, meter)?;
    let largest = (0..model.schemas.len()).max_by_key(|&i| (reached.bindings[i].rows, Reverse(i)));
    // The instances contain their objects, so the bindings are no longer needed.
    reached.bindings = Vec::new();
    let named = |failure| match (failure, largest) {
        (Failure::Interrupted, Some(schema)) => {
            GroundError::Interrupted { schema: model.schemas[schema].name.clone() }.into()
        }
        (failure, _) => failure,
    };
    let pruned = prune::prune(model, &reached, &raw, meter).map_err(|why| named(why.into()))?;
    finish::finish(model, reached, &exclusions, raw, &pruned, meter).map_err(named)
}

#[cfg(test)]
mod tests {
    use super::{Outside, metered};
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
        let task = metered(&domain, &problem, Outside::default(), &meter).unwrap();
        assert!(task.operators().len() > 9_000);
        interrupted();
        let widest = widest.load(Relaxed);
        assert!(widest < 2 * INTERVAL as u64, "{widest} units between two looks");
    }
}
