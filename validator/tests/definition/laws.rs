//! What must not matter: names, order, and what nothing speaks of.

use crate::naive::Fault;
use crate::sample::Sample;
use crate::sequential::{outline, task};
use pddl::{Source, parse_plan};
use proptest::prelude::*;
use validator::{Verdict, validate};

/// The verdict on a sample's plan, as far as no place is named in it.
pub fn judged(sample: &Sample) -> Result<Option<f64>, Fault> {
    outline(&verdict(&sample.domain(), &sample.problem(), &sample.plan.join("\n")))
}

pub fn verdict(domain: &str, problem: &str, plan: &str) -> Verdict {
    let (domain, problem) = task(domain, problem);
    let parsed = parse_plan(&Source::new("plan", plan), &domain, &problem);
    let plan = parsed.model.unwrap_or_else(|| panic!("{plan}\n{:?}", parsed.diagnostics));
    validate(&domain, &problem, &plan)
}

/// The text with other names for everything that a sample names: objects, variables, predicates, actions and types.
pub fn renamed(text: &str) -> String {
    let mut result = String::new();
    let mut word = String::new();
    for letter in text.chars().chain([' ']) {
        if letter.is_ascii_alphanumeric() || "?-_.#".contains(letter) {
            word.push(letter);
            continue;
        }
        let (mark, name) = word.strip_prefix('?').map_or(("", word.as_str()), |name| ("?", name));
        let known = name.strip_prefix(['o', 'v', 'p', 'd', 'a', 't', 'f', 'w']);
        if known.is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())) {
            // In another order than before, and of another length.
            let (kind, number): (&str, usize) = (&name[..1], name[1..].parse().unwrap());
            result += &format!("{mark}n{}-{kind}{}", 90 - number, "x".repeat(number % 3));
        } else {
            result += &word;
        }
        word.clear();
        result.push(letter);
    }
    result.pop();
    result
}

/// The sample with its parts in an order that `keys` says.
pub fn shuffled(sample: &Sample, keys: &[u8]) -> Sample {
    fn by<T: Clone>(items: &[T], keys: &[u8]) -> Vec<T> {
        let key =
            |i: usize| keys[i % keys.len()].wrapping_mul(u8::try_from(i % 256).unwrap().wrapping_add(1));
        let mut keyed: Vec<(u8, &T)> = items.iter().enumerate().map(|(i, item)| (key(i), item)).collect();
        keyed.sort_by_key(|(key, _)| *key);
        keyed.into_iter().map(|(_, item)| item.clone()).collect()
    }
    Sample {
        derived: by(&sample.derived, keys),
        actions: by(&sample.actions, keys),
        objects: by(&sample.objects, keys),
        init: by(&sample.init, keys),
        goal: by(&sample.goal, keys),
        constraints: by(&sample.constraints, keys),
        ..sample.clone()
    }
}

/// The sample with objects of a new type, facts about them, and an action that no plan takes.
pub fn with_strangers(sample: &Sample) -> Sample {
    let mut sample = sample.clone();
    sample.strangers = true;
    sample.objects.extend([("s0".to_owned(), "t2"), ("s1".to_owned(), "t2")]);
    sample.init.extend(["(p9 s0 o0)".to_owned(), "(p9 s1 o0)".to_owned(), "(= (f9 s1) 4)".to_owned()]);
    let action =
        "(:action idle :parameters (?x - t2 ?y - t0) :precondition (p9 ?x ?y) :effect (not (p9 ?x ?y)))";
    sample.actions.insert(0, action.to_owned());
    sample
}

proptest! {
    #![proptest_config(crate::cases(300))]

    #[test]
    fn names_do_not_matter(bytes in prop::collection::vec(any::<u8>(), 600)) {
        let sample = Sample::sequential(&bytes);
        let other = verdict(&renamed(&sample.domain()), &renamed(&sample.problem()), &renamed(&sample.plan.join("\n")));
        prop_assert_eq!(judged(&sample), outline(&other));
    }

    #[test]
    fn order_does_not_matter(bytes in prop::collection::vec(any::<u8>(), 600), keys in prop::collection::vec(any::<u8>(), 17)) {
        let sample = Sample::sequential(&bytes);
        prop_assert_eq!(judged(&sample), judged(&shuffled(&sample, &keys)));
    }

    #[test]
    fn what_nothing_speaks_of_does_not_matter(bytes in prop::collection::vec(any::<u8>(), 600)) {
        let sample = Sample::sequential(&bytes);
        prop_assert_eq!(judged(&sample), judged(&with_strangers(&sample)));
    }

    #[test]
    fn a_file_with_the_parts_of_another_says_the_same(bytes in prop::collection::vec(any::<u8>(), 600)) {
        let sample = Sample::sequential(&bytes);
        // Constraints may stand in the domain, and what no problem changes may come from a domain that is imported.
        let whole = sample.domain();
        let split = whole.replacen("(:types", "(:import base) (:types", 1).replacen("(f1 ?x - t0) ", "", 1);
        let base = "(define (domain base) (:types t0 - object) (:functions (f1 ?x - t0) - number))";
        let base = pddl::parse_domain(&Source::new("base", base), &[]).model.unwrap();
        let parsed = pddl::parse_domain(&Source::new("split", split.as_str()), &[&base]);
        let domain = parsed.model.unwrap_or_else(|| panic!("{split}\n{:?}", parsed.diagnostics));
        let problem = pddl::parse_problem(&Source::new("problem", sample.problem()), &domain).model.unwrap();
        let plan = parse_plan(&Source::new("plan", sample.plan.join("\n")), &domain, &problem).model.unwrap();
        prop_assert_eq!(judged(&sample), outline(&validate(&domain, &problem, &plan)));
    }
}
