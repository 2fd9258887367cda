//! Plans with times.

use crate::laws::{judged, renamed, shuffled, verdict, with_strangers};
use crate::naive::{Fault, World};
use crate::sample::Sample;
use crate::sequential::{outline, task};
use pddl::{Plan, Source, parse_plan};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use validator::{Validator, validate};

/// Holds the validator's verdict against what the definition allows to say; answers the verdict.
fn compared(sample: &Sample, plan: &str) -> Result<Option<f64>, Fault> {
    let (domain, problem) = task(&sample.domain(), &sample.problem());
    let Plan::Temporal(plan) = parse_plan(&Source::new("plan", plan), &domain, &problem).model.unwrap()
    else {
        return judged(&Sample { plan: Vec::new(), ..sample.clone() });
    };
    let ours = outline(&validate(&domain, &problem, &plan));
    match (World { domain: &domain, problem: &problem }.judge_timed(&plan), ours) {
        (Ok(cost), ours) => {
            assert_eq!(ours, Ok(cost.map(crate::fraction::Fraction::to_f64)), "by the definition");
        }
        (Err(faults), Err(ours)) => assert!(faults.contains(&ours), "{ours:?}, by the definition {faults:?}"),
        (Err(faults), Ok(_)) => panic!("valid, by the definition {faults:?}"),
    }
    ours
}

proptest! {
    #![proptest_config(crate::cases(600))]

    #[test]
    fn random_plans_are_judged_as_defined(bytes in prop::collection::vec(any::<u8>(), 600)) {
        let sample = Sample::timed(&bytes);
        compared(&sample, &sample.plan.join("\n")).ok();
        // What the first steps do is seen even where a later one fails.
        for step in &sample.plan {
            compared(&sample, step).ok();
        }
    }

    #[test]
    fn names_do_not_matter(bytes in prop::collection::vec(any::<u8>(), 600)) {
        let sample = Sample::timed(&bytes);
        let other = verdict(&renamed(&sample.domain()), &renamed(&sample.problem()), &renamed(&sample.plan.join("\n")));
        prop_assert_eq!(judged(&sample), outline(&other));
    }

    #[test]
    fn order_and_what_nothing_speaks_of_do_not_matter(
        bytes in prop::collection::vec(any::<u8>(), 600),
        keys in prop::collection::vec(any::<u8>(), 17),
    ) {
        let sample = Sample::timed(&bytes);
        // Which of two steps of one time is named is a matter of their order: only whether the plan is valid is not.
        let kind = |sample: &Sample| judged(sample).map_err(|_| ());
        prop_assert_eq!(kind(&sample), kind(&shuffled(&sample, &keys)));
        prop_assert_eq!(judged(&sample), judged(&with_strangers(&sample)));
    }

    #[test]
    fn a_trace_changes_nothing(bytes in prop::collection::vec(any::<u8>(), 600)) {
        // A trace asks for every fluent at every happening; without one, and without constraints, few are looked at.
        let mut sample = Sample::timed(&bytes);
        sample.constraints.clear();
        let plan = sample.plan.join("\n");
        compared(&sample, &plan).ok();
        let (domain, problem) = task(&sample.domain(), &sample.problem());
        let plan = parse_plan(&Source::new("plan", &*plan), &domain, &problem).model.unwrap();
        let validator = Validator::new(&domain, &problem).unwrap();
        prop_assert_eq!(validator.validate(&plan), validator.trace(&plan).0);
    }

    #[test]
    fn later_is_the_same(bytes in prop::collection::vec(any::<u8>(), 600), by in 1_u32..40) {
        // Constraints count from the start of the plan, so there are none; durations are not times.
        let mut sample = Sample::timed(&bytes);
        sample.constraints.clear();
        let shift = |text: &str| format!("{:?}", text.parse::<f64>().unwrap() + f64::from(by) / 2.0);
        let mut later = sample.clone();
        for line in &mut later.plan {
            let (time, rest) = line.split_once(':').unwrap();
            *line = format!("{}:{rest}", shift(time));
        }
        for part in later.init.iter_mut().filter(|part| part.starts_with("(at ")) {
            let (time, rest) = part[4..].split_once(' ').unwrap();
            *part = format!("(at {} {rest}", shift(time));
        }
        prop_assert_eq!(judged(&sample), judged(&later));
    }

    #[test]
    fn slower_is_the_same(bytes in prop::collection::vec(any::<u8>(), 600)) {
        // All times, durations and rates, for conditions that do not speak of time.
        let mut sample = Sample::timed(&bytes);
        sample.constraints.clear();
        sample.actions.retain(|action| !action.contains("(= ?duration") && !action.contains(":duration (>= "));
        let known = |line: &String| sample.actions.iter().any(|action| action.contains(&line[line.find("(a").unwrap() + 1..][..2]));
        sample.plan = sample.plan.iter().filter(|line| known(line)).cloned().collect();
        let slow = |text: &str| format!("{:?}", text.parse::<f64>().unwrap() * 4.0);
        let mut slower = sample.clone();
        for line in &mut slower.plan {
            let (time, rest) = line.split_once(':').unwrap();
            let (step, duration) = rest.split_once('[').unwrap_or((rest, ""));
            let duration = duration.strip_suffix(']').map(|duration| format!("[{}]", slow(duration)));
            *line = format!("{}:{step}{}", slow(time), duration.unwrap_or_default());
        }
        for part in slower.init.iter_mut().filter(|part| part.starts_with("(at ")) {
            let (time, rest) = part[4..].split_once(' ').unwrap();
            *part = format!("(at {} {rest}", slow(time));
        }
        for action in &mut slower.actions {
            *action = action.replace("(<= ?duration 2)", "(<= ?duration 8)");
            if let Some(at) = action.find("(* #t ").map(|at| at + 6) {
                let end = at + action[at..].find(')').unwrap();
                let rate = action[at..end].parse::<f64>().unwrap() / 4.0;
                action.replace_range(at..end, &rate.to_string());
            }
        }
        // What was a little apart is more apart then: such plans are left out.
        prop_assume!(!sample.plan.iter().any(|line| line.contains("1.0005") || line.contains("0.999")));
        prop_assert_eq!(judged(&sample), judged(&slower));
    }
}

#[test]
fn random_tasks_are_of_all_kinds() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let bytes = prop::collection::vec(any::<u8>(), 600);
    let mut kinds = std::collections::BTreeMap::new();
    for _ in 0..800 {
        let sample = Sample::timed(&bytes.new_tree(&mut runner).unwrap().current());
        let kind = match compared(&sample, &sample.plan.join("\n")) {
            Ok(_) if sample.plan.len() > 1 => "valid, of several steps",
            Ok(_) => "valid",
            Err(Fault::Precondition(_)) => "precondition",
            Err(Fault::Effect(_)) => "effect",
            Err(Fault::Duration(_)) => "duration",
            Err(Fault::Invariant(_)) => "invariant",
            Err(Fault::Interference) => "interference",
            Err(Fault::Change) => "change",
            Err(Fault::Constraint) => "constraint",
            Err(Fault::Goal) => "goal",
        };
        *kinds.entry(kind).or_insert(0) += 1;
    }
    println!("{kinds:?}");
    assert!(kinds.len() == 10 && kinds.values().all(|&count| count >= 2), "{kinds:?}");
}
