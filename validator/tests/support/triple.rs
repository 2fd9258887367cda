//! A domain, a problem and a plan in one text, as fuzzing has them, and what must hold for any of them.

use pddl::{Source, parse_domain, parse_plan, parse_problem};
use validator::{Number, Precision, Validator, explain};

/// The line between the domain, the problem and the plan.
const BETWEEN: &str = "\n===\n";

/// Judges the plan: no panic, an explanation exactly of what is not valid, and the same verdict with a trace.
pub fn check(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let mut parts = text.splitn(3, BETWEEN);
    let mut source = |name| Source::new(name, parts.next().unwrap_or(""));
    let (domain, problem, plan) = (source("domain"), source("problem"), source("plan"));
    let Some(domain) = parse_domain(&domain, &[]).model else { return };
    let Some(problem) = parse_problem(&problem, &domain).model else { return };
    let Some(plan) = parse_plan(&plan, &domain, &problem).model else { return };
    let Ok(validator) = Validator::new(&domain, &problem) else { return };
    let (verdict, trace) = validator.trace(&plan);
    assert_eq!(verdict, validator.validate(&plan), "a trace changes nothing");
    assert_eq!(verdict.is_valid(), explain(&domain, &problem, &plan, &verdict).is_none());
    assert!(trace.happenings.is_sorted_by_key(|happening| happening.time));
    let precision = Precision { tolerance: Number::ZERO, separation: Number::ZERO };
    let strict = validator.with_precision(precision).validate(&plan);
    assert_eq!(strict.is_valid(), explain(&domain, &problem, &plan, &strict).is_none());
}
