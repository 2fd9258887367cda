//! Random small task networks beside an enumerator that is written from the definition and knows no cleverness.
//!
//! A plan that was made by decomposing at random is valid with its decomposition, and without it. Any other sequence of
//! actions is valid exactly if the enumerator finds a decomposition: it takes whatever nothing is before, a task apart
//! by every method with all objects, and asks a method's precondition like an action that changes nothing.
//!
//! Source: Höller et al., "HDDL: an extension to PDDL for expressing hierarchical planning problems", AAAI 2020.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "support/hierarchy.rs"]
mod hierarchy;

use hierarchy::{Chance, Made, Task};
use pddl::{Source, parse_domain, parse_plan, parse_problem, print_plan};
use proptest::prelude::*;
use validator::{AdviceLimits, Failure, Repair, Validator, Verdict, validate};

/// How many tasks the enumerator takes apart before it gives up.
const APART: u32 = 7;

fn judged(task: &Task, plan: &str) -> Verdict {
    let (domain_text, problem_text) = task.texts();
    let domain = parse_domain(&Source::new("domain", domain_text.as_str()), &[]);
    let domain = domain.model.unwrap_or_else(|| panic!("{:?}\n{domain_text}", domain.diagnostics));
    let problem = parse_problem(&Source::new("problem", problem_text.as_str()), &domain);
    let problem = problem.model.unwrap_or_else(|| panic!("{:?}\n{problem_text}", problem.diagnostics));
    let parsed = parse_plan(&Source::new("plan", plan), &domain, &problem);
    let plan = parsed.model.unwrap_or_else(|| panic!("{:?}\n{plan}", parsed.diagnostics));
    validate(&domain, &problem, &plan)
}

fn shown(task: &Task, plan: &str) -> String {
    let (domain, problem) = task.texts();
    format!("{domain}\n===\n{problem}\n===\n{plan}")
}

/// How many sequences were valid, how many not for the task network's sake, and how many not for another.
#[derive(Debug, Default)]
struct Tally {
    made: u32,
    valid: u32,
    undecomposed: u32,
    invalid: u32,
}

impl Tally {
    fn compare(&mut self, task: &Task, steps: &[hierarchy::Step]) {
        let plan = task.sequence(steps);
        match judged(task, &plan) {
            Verdict::Valid(valid) => {
                self.valid += 1;
                let found = valid.decomposition.expect("a decomposition was found");
                let apart = u32::try_from(found.decompositions.len()).unwrap();
                if apart <= APART {
                    assert!(task.yields(steps, apart), "there is none:\n{}", shown(task, &plan));
                }
            }
            Verdict::Invalid(failure) => {
                match failure {
                    Failure::Network { .. } => self.undecomposed += 1,
                    _ => self.invalid += 1,
                }
                assert!(!task.yields(steps, APART), "there is one:\n{}", shown(task, &plan));
            }
            other => panic!("{other:?}\n{}", shown(task, &plan)),
        }
    }

    fn try_seed(&mut self, seed: u64) {
        let mut chance = Chance::new(seed);
        let task = Task::random(&mut chance);
        let mut steps = Vec::new();
        if let Some(Made { plan, steps: made }) = task.decompose(&mut chance) {
            let verdict = judged(&task, &plan);
            assert!(verdict.is_valid(), "{verdict:?}\n{}", shown(&task, &plan));
            let sequence = task.sequence(&made);
            let verdict = judged(&task, &sequence);
            assert!(verdict.is_valid(), "{verdict:?}\n{}", shown(&task, &sequence));
            self.made += 1;
            steps = made;
        }
        for _ in 0..4 {
            let mutated = task.mutated(&steps, &mut chance);
            self.compare(&task, &mutated);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 120, ..ProptestConfig::default() })]

    #[test]
    fn verdicts_are_those_of_the_definition(seed in any::<u64>()) {
        Tally::default().try_seed(seed);
    }
}

/// A plan whose steps are right and whose decomposition is not gets another one, with its numbers.
#[test]
fn another_decomposition_is_advised() {
    let domain = "(define (domain d) (:requirements :hierarchy :negative-preconditions) (:predicates (p))
        (:task t :parameters ())
        (:method early :parameters () :task (t) :precondition (p) :ordered-subtasks (and (a)))
        (:method late :parameters () :task (t) :precondition (not (p)) :ordered-subtasks (and (a)))
        (:action a :parameters () :precondition () :effect (p)))";
    let domain = parse_domain(&Source::new("d", domain), &[]).model.unwrap();
    let problem = "(define (problem q) (:domain d) (:htn :ordered-subtasks (and (t))) (:init))";
    let problem = parse_problem(&Source::new("q", problem), &domain).model.unwrap();
    let plan = parse_plan(&Source::new("plan", "==>\n7 a\nroot 3\n3 t -> early 7\n<==\n"), &domain, &problem);
    let plan = plan.model.unwrap();
    let validator = Validator::new(&domain, &problem).unwrap();
    let Verdict::Invalid(failure) = validator.validate(&plan) else { panic!("its method needs p") };
    let advice = validator.advise(&plan, &failure, AdviceLimits::default());
    let otherwise = advice.iter().find(|repair| matches!(repair, Repair::Decompose(_))).unwrap();
    let changed = otherwise.applied(&plan).unwrap();
    assert!(validator.validate(&changed).is_valid());
    assert_eq!(print_plan(&changed, &domain, &problem), "==>\n7 a\nroot 8\n8 t -> late 7\n<==\n");
}

#[test]
fn every_verdict_is_met() {
    let mut tally = Tally::default();
    (0..80).for_each(|seed| tally.try_seed(seed));
    let least = [tally.made, tally.valid, tally.undecomposed, tally.invalid].into_iter().min();
    assert!(least > Some(10), "{tally:?}");
}
