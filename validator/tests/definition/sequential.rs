//! Plans without times.

use crate::naive::{Fault, Judgement, World};
use crate::sample::Sample;
use pddl::model::{Domain, Problem};
use pddl::{SequentialPlan, Source, parse_domain, parse_plan, parse_problem};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use validator::{Cause, Failure, Verdict, validate};

/// A domain and a problem, both without errors.
pub fn task(domain: &str, problem: &str) -> (Domain, Problem) {
    let parsed = parse_domain(&Source::new("domain", domain), &[]);
    let domain = parsed.model.unwrap_or_else(|| panic!("{domain}\n{:?}", parsed.diagnostics));
    let parsed = parse_problem(&Source::new("problem", problem), &domain);
    let problem = parsed.model.unwrap_or_else(|| panic!("{problem}\n{:?}", parsed.diagnostics));
    (domain, problem)
}

pub fn steps(text: &str, domain: &Domain, problem: &Problem) -> SequentialPlan {
    parse_plan(&Source::new("plan", text), domain, problem).model.unwrap().into_sequential().unwrap()
}

/// The validator's verdict in the words of the naive evaluator. A cost that is no metric's is no cost.
pub fn outline(verdict: &Verdict) -> Result<Option<f64>, Fault> {
    let index = |at: &Cause| at.step().unwrap().0 as usize;
    match verdict {
        Verdict::Valid(valid) => Ok(valid.metric.map(|metric| metric.value.to_f64())),
        Verdict::Invalid(failure) => Err(match failure {
            Failure::Precondition { at, .. } => Fault::Precondition(index(at)),
            Failure::Effect { at, .. } => Fault::Effect(index(at)),
            Failure::Duration { step, .. } => Fault::Duration(step.0 as usize),
            Failure::Invariant { step, .. } => Fault::Invariant(step.0 as usize),
            Failure::Interference { .. } => Fault::Interference,
            Failure::Constraint { .. } => Fault::Constraint,
            Failure::Goal { .. } => Fault::Goal,
            Failure::Change { .. } => Fault::Change,
            other => panic!("{other:?}"),
        }),
        other => panic!("{other:?}"),
    }
}

pub fn rounded(judgement: Judgement) -> Result<Option<f64>, Fault> {
    judgement.map(|cost| cost.map(crate::fraction::Fraction::to_f64))
}

/// Holds the two against each other; answers what they say.
pub fn compared(domain: &Domain, problem: &Problem, plan: &SequentialPlan) -> Result<Option<f64>, Fault> {
    let ours = outline(&validate(domain, problem, plan));
    let theirs = rounded(World { domain, problem }.judge(&plan.steps));
    assert_eq!(ours, theirs, "ours, and by the definition");
    ours
}

proptest! {
    #![proptest_config(crate::cases(800))]

    #[test]
    fn random_plans_are_judged_as_defined(bytes in prop::collection::vec(any::<u8>(), 600)) {
        let sample = Sample::sequential(&bytes);
        let (domain, problem) = task(&sample.domain(), &sample.problem());
        // As far as the plan goes, each beginning of it.
        for length in 0..=sample.plan.len() {
            let plan = steps(&sample.plan[..length].join("\n"), &domain, &problem);
            if matches!(compared(&domain, &problem, &plan), Err(Fault::Precondition(_) | Fault::Effect(_))) {
                break;
            }
        }
    }
}

#[test]
fn random_tasks_are_of_all_kinds() {
    // Each verdict has to come up among the random tasks, or the comparison says little.
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let bytes = prop::collection::vec(any::<u8>(), 600);
    let mut kinds = std::collections::BTreeMap::new();
    for _ in 0..800 {
        let sample = Sample::sequential(&bytes.new_tree(&mut runner).unwrap().current());
        let (domain, problem) = task(&sample.domain(), &sample.problem());
        let plan = steps(&sample.plan.join("\n"), &domain, &problem);
        let kind = match compared(&domain, &problem, &plan) {
            Ok(_) if plan.steps.len() > 1 => "valid, of several steps",
            Ok(_) => "valid",
            Err(Fault::Precondition(0)) => "first step",
            Err(Fault::Precondition(_)) => "later step",
            Err(Fault::Effect(_)) => "effect",
            Err(Fault::Constraint) => "constraint",
            Err(Fault::Goal) => "goal",
            Err(other) => panic!("{other:?} without times"),
        };
        *kinds.entry(kind).or_insert(0) += 1;
    }
    println!("{kinds:?}");
    assert!(kinds.len() == 7 && kinds.values().all(|&count| count >= 10), "{kinds:?}");
}
