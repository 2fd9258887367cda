//! What must hold for any plan: no panic, and verdicts that do not depend on names or order.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pddl::model::{ActionId, Domain, ObjectId, Problem};
use pddl::{PlanStep, SequentialPlan, Source, Span, parse_domain, parse_plan, parse_problem};
use proptest::prelude::*;
use validator::{Cause, Failure, Validator, Verdict, explain, validate};

const DOMAIN: &str = "(define (domain rounds) (:requirements :adl :typing :numeric-fluents)
  (:types room item)
  (:predicates (at ?r - room) (in ?i - item ?r - room) (has ?i - item) (free) (door ?a ?b - room))
  (:functions (steps) (trips ?r - room))
  (:action go :parameters (?from ?to - room)
    :precondition (and (at ?from) (or (door ?from ?to) (door ?to ?from)) (< (steps) 20))
    :effect (and (at ?to) (not (at ?from)) (increase (steps) 0.5) (increase (trips ?to) 1)))
  (:action take :parameters (?i - item ?r - room)
    :precondition (and (at ?r) (in ?i ?r) (forall (?j - item) (not (has ?j))))
    :effect (and (has ?i) (not (in ?i ?r))))
  (:action drop :parameters (?r - room)
    :precondition (and (at ?r) (exists (?i - item) (has ?i)))
    :effect (forall (?i - item) (when (has ?i) (and (in ?i ?r) (not (has ?i)))))))";

const PLAN: &str =
    "(go a b) (take i b) (go b c) (drop c) (go c b) (go b a) (take j a) (go a b) (go b c) (drop c)";

/// The problem with its objects, facts and names in any order and spelling.
fn problem_text(names: &[String; 5], order: &[usize; 7]) -> String {
    let [a, b, c, i, j] = names;
    let facts = [
        format!("(at {a})"),
        format!("(door {a} {b})"),
        format!("(door {b} {c})"),
        format!("(in {i} {b})"),
        format!("(in {j} {a})"),
        "(= (steps) 0)".to_owned(),
        format!("(= (trips {a}) 0) (= (trips {b}) 0) (= (trips {c}) 0)"),
    ];
    let init: Vec<&str> = order.iter().map(|&k| facts[k].as_str()).collect();
    format!(
        "(define (problem p) (:domain rounds) (:objects {a} {b} {c} - room {i} {j} - item)
           (:init {}) (:goal (forall (?i - item) (in ?i {c}))) (:metric minimize (steps)))",
        init.join(" ")
    )
}

fn plan_text(names: &[String; 5]) -> String {
    PLAN.split_inclusive([' ', ')'])
        .map(|word| {
            let name = word.trim_end_matches([' ', ')']);
            match ["a", "b", "c", "i", "j"].iter().position(|&n| n == name) {
                Some(k) => word.replace(name, &names[k]),
                None => word.to_owned(),
            }
        })
        .collect()
}

fn plain() -> [String; 5] {
    ["a", "b", "c", "i", "j"].map(str::to_owned)
}

fn task(problem: &str) -> (Domain, Problem) {
    let domain = parse_domain(&Source::new("domain", DOMAIN), &[]).model.unwrap();
    let problem = parse_problem(&Source::new("problem", problem), &domain).model.unwrap();
    (domain, problem)
}

fn read(text: &str, domain: &Domain, problem: &Problem) -> SequentialPlan {
    parse_plan(&Source::new("plan", text), domain, problem).model.unwrap().into_sequential().unwrap()
}

fn judged(problem: &str, plan: &str) -> Verdict {
    let (domain, problem) = task(problem);
    let plan = read(plan, &domain, &problem);
    validate(&domain, &problem, &plan)
}

const IN_ORDER: [usize; 7] = [0, 1, 2, 3, 4, 5, 6];

#[test]
fn the_plan_is_valid() {
    let verdict = judged(&problem_text(&plain(), &IN_ORDER), PLAN);
    let Verdict::Valid(valid) = verdict else { panic!("{verdict:?}") };
    assert_eq!(valid.cost().to_string(), "3");
}

#[test]
fn every_step_is_needed() {
    let (domain, problem) = task(&problem_text(&plain(), &IN_ORDER));
    let plan = read(PLAN, &domain, &problem);
    let validator = Validator::new(&domain, &problem).unwrap();
    for dropped in 0..plan.steps.len() {
        let mut shorter = plan.clone();
        shorter.steps.remove(dropped);
        let verdict = validator.validate(&shorter);
        // Carrying both at once is forbidden, every other step is a link of the chain.
        match verdict {
            Verdict::Invalid(Failure::Precondition { at: Cause::Step(step), .. }) => {
                assert!(step.0 as usize >= dropped);
            }
            Verdict::Invalid(Failure::Goal { .. }) => {}
            other => panic!("without step {dropped}: {other:?}"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_steps_get_a_verdict(
        steps in prop::collection::vec((0_u32..5, prop::collection::vec(0_u32..7, 0..4)), 0..30),
    ) {
        let (domain, problem) = task(&problem_text(&plain(), &IN_ORDER));
        let steps = steps.into_iter().map(|(action, arguments)| PlanStep {
            action: ActionId(action),
            arguments: arguments.into_iter().map(ObjectId).collect(),
            span: Span::default(),
        });
        let plan = SequentialPlan::new(steps.collect());
        let verdict = validate(&domain, &problem, &plan);
        prop_assert_eq!(verdict.is_valid(), explain(&domain, &problem, &plan, &verdict).is_none());
    }

    #[test]
    fn dropped_doubled_and_moved_steps_get_a_verdict(
        edits in prop::collection::vec((0_usize..3, any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..8),
    ) {
        let (domain, problem) = task(&problem_text(&plain(), &IN_ORDER));
        let mut plan = read(PLAN, &domain, &problem);
        for (kind, one, other) in edits {
            if plan.steps.is_empty() {
                break;
            }
            let (one, other) = (one.index(plan.steps.len()), other.index(plan.steps.len()));
            match kind {
                0 => {
                    plan.steps.remove(one);
                }
                1 => {
                    let step = plan.steps[one].clone();
                    plan.steps.insert(other, step);
                }
                _ => plan.steps.swap(one, other),
            }
        }
        let validator = Validator::new(&domain, &problem).unwrap();
        let (verdict, trace) = validator.trace(&plan);
        prop_assert_eq!(&verdict, &validator.validate(&plan));
        prop_assert!(trace.happenings.len() <= plan.steps.len());
        prop_assert_eq!(verdict.is_valid(), explain(&domain, &problem, &plan, &verdict).is_none());
    }

    #[test]
    fn names_and_order_do_not_matter(
        order in Just(IN_ORDER).prop_shuffle(),
        names in prop::collection::btree_set("[a-h][a-z0-9-]{3,8}", 5),
    ) {
        let names: [String; 5] = names.into_iter().collect::<Vec<_>>().try_into().unwrap();
        let verdict = judged(&problem_text(&names, &order), &plan_text(&names));
        prop_assert_eq!(verdict, judged(&problem_text(&plain(), &IN_ORDER), PLAN));
    }
}

/// Plans with times.
mod temporal {
    use super::*;
    use pddl::{Decimal, Plan};
    use validator::{Number, Precision};

    const DOMAIN: &str = "(define (domain kitchen)
  (:requirements :typing :durative-actions :numeric-fluents :negative-preconditions :timed-initial-literals
    :duration-inequalities :continuous-effects :conditional-effects :preferences :constraints)
  (:types pot plate) (:predicates (hot ?p - pot) (clean ?p - pot) (free ?s - plate) (odd)) (:functions (gas) (heat ?p - pot))
  (:durative-action cook :parameters (?p - pot ?s - plate) :duration (and (>= ?duration 1) (<= ?duration 4))
    :condition (and (at start (clean ?p)) (at start (free ?s)) (over all (>= (gas) 0)) (preference calm (over all (not (odd)))))
    :effect (and (at start (not (free ?s))) (at end (free ?s)) (at end (hot ?p)) (at start (not (clean ?p)))
      (decrease (gas) (* #t 1)) (increase (heat ?p) (* #t 2)) (when (at start (odd)) (at end (not (odd))))))
  (:action wash :parameters (?p - pot) :precondition (not (clean ?p)) :effect (and (clean ?p) (not (hot ?p)))))";

    const PLAN: [&str; 5] =
        ["0: (cook a s) [2]", "1: (cook b t) [2]", "2.5: (wash a)", "3.5: (cook a t) [1]", "6: (wash b)"];

    fn problem_text(names: [&str; 4], order: &[usize; 6], extra: &str) -> String {
        let [a, b, s, t] = names;
        let facts = [
            format!("(clean {a})"),
            format!("(clean {b})"),
            format!("(free {s}) (free {t})"),
            "(= (gas) 7)".to_owned(),
            format!("(= (heat {a}) 0) (= (heat {b}) 0)"),
            "(at 3.2 (odd))".to_owned(),
        ];
        let init: Vec<&str> = order.iter().map(|&k| facts[k].as_str()).collect();
        format!(
            "(define (problem p) (:domain kitchen) (:objects {a} {b} - pot {s} {t} - plate {extra})
               (:init {}) (:goal (and (hot {a}) (clean {b})))
               (:constraints (and (always-within 6 (hot {b}) (clean {b})) (forall (?p - pot) (at-most-once (hot ?p)))))
               (:metric minimize (+ (heat {a}) (is-violated calm))))",
            init.join(" ")
        )
    }

    fn judged(problem: &str, plan: &str) -> Verdict {
        let domain = parse_domain(&Source::new("domain", DOMAIN), &[]).model.unwrap();
        let problem = parse_problem(&Source::new("problem", problem), &domain).model.unwrap();
        let plan = parse_plan(&Source::new("plan", plan), &domain, &problem).model.unwrap();
        validate(&domain, &problem, &plan)
    }

    const PLAIN: [&str; 4] = ["a", "b", "s", "t"];

    #[test]
    fn the_constraint_is_broken_and_else_it_is_valid() {
        let verdict = judged(&problem_text(PLAIN, &[0, 1, 2, 3, 4, 5], ""), &PLAN.join("\n"));
        assert!(matches!(verdict, Verdict::Invalid(Failure::Constraint { .. })), "{verdict:?}");
        let shorter = [PLAN[0], PLAN[1], PLAN[4]].join("\n");
        let Verdict::Valid(valid) = judged(&problem_text(PLAIN, &[0, 1, 2, 3, 4, 5], ""), &shorter) else {
            panic!("valid without the second cooking");
        };
        assert_eq!(valid.cost().to_string(), "4");
    }

    /// The verdict without places, which names and order move.
    fn outline(verdict: &Verdict) -> String {
        match verdict {
            Verdict::Valid(valid) => format!("valid {} {:?}", valid.cost(), valid.makespan),
            Verdict::Invalid(failure) => format!("{:?}", std::mem::discriminant(failure)),
            other => format!("{other:?}"),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn names_order_and_what_is_irrelevant_do_not_matter(
            order in Just([0, 1, 2, 3, 4, 5]).prop_shuffle(),
            lines in Just(PLAN).prop_shuffle(),
            dropped in 0_usize..6,
        ) {
            let kept: Vec<&str> = PLAN.iter().enumerate().filter(|&(i, _)| i != dropped).map(|(_, &l)| l).collect();
            let plain = judged(&problem_text(PLAIN, &[0, 1, 2, 3, 4, 5], ""), &kept.join("\n"));
            let moved: Vec<&str> = lines.iter().copied().filter(|line| kept.contains(line)).collect();
            let extra = "unused - plate spare - plate";
            let other = judged(&problem_text(PLAIN, &order, extra), &moved.join("\n"));
            prop_assert_eq!(outline(&plain), outline(&other));
            let renamed = moved.join("\n").replace(" a ", " first ").replace(" a)", " first)").replace(" t)", " tray)");
            let other = judged(&problem_text(["first", "b", "s", "tray"], &order, ""), &renamed);
            prop_assert_eq!(outline(&plain), outline(&other));
        }

        #[test]
        fn any_times_get_a_verdict(
            steps in prop::collection::vec((0_usize..5, 0_u32..9000, 0_u32..5000), 0..8),
            separation in 0_i64..2,
        ) {
            let domain = parse_domain(&Source::new("domain", DOMAIN), &[]).model.unwrap();
            let problem = problem_text(PLAIN, &[0, 1, 2, 3, 4, 5], "");
            let problem = parse_problem(&Source::new("problem", problem), &domain).model.unwrap();
            let plan = parse_plan(&Source::new("plan", PLAN.join("\n")), &domain, &problem).model.unwrap();
            let Plan::Temporal(mut plan) = plan else { panic!("it has times") };
            let decimal = |thousandths: u32| -> Decimal { format!("{thousandths}e-3").parse().unwrap() };
            let all = std::mem::take(&mut plan.steps);
            for (which, start, duration) in steps {
                let mut step = all[which].clone();
                step.start = decimal(start);
                step.duration = step.duration.map(|_| decimal(duration));
                plan.steps.push(step);
            }
            let precision = Precision { separation: Number::integer(separation), ..Precision::default() };
            let validator = Validator::new(&domain, &problem).unwrap().with_precision(precision);
            let (verdict, trace) = validator.trace(&plan);
            prop_assert_eq!(&verdict, &validator.validate(&plan));
            prop_assert!(trace.happenings.is_sorted_by_key(|happening| happening.time));
            let plan = Plan::Temporal(plan);
            prop_assert_eq!(verdict.is_valid(), explain(&domain, &problem, &plan, &verdict).is_none());
        }
    }
}
