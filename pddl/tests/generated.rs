//! Tasks that use the whole language, made from its grammar: each is good, prints to itself, and is laid out the same
//! way twice.

mod support;

use pddl::Source;
use proptest::prelude::*;
use support::properties::{check_domain, check_drafts, check_problem, check_text};

/// The names that bodies may use: the declarations of [`domain`].
const TERMS: &[&str] = &["?x", "?y", "?z", "k", "m", "(o1 ?x)", "(o1 k)"];

/// The same without parameters of a schema.
const OBJECTS: &[&str] = &["k", "m", "i", "j"];

fn one_of(words: &'static [&'static str]) -> BoxedStrategy<String> {
    prop::sample::select(words).prop_map(str::to_owned).boxed()
}

fn number() -> BoxedStrategy<String> {
    one_of(&["0", "1", "2.5", "1e-3", ".5", "-3", "+4", "10"])
}

fn expression(terms: &'static [&'static str]) -> BoxedStrategy<String> {
    let leaf =
        prop_oneof![number(), Just("(n0)".to_owned()), one_of(terms).prop_map(|t| format!("(n1 {t})"))];
    leaf.prop_recursive(3, 12, 3, |inner| {
        let operator = one_of(&["+", "*", "-", "/"]);
        (operator, prop::collection::vec(inner, 2..4))
            .prop_map(|(o, parts)| format!("({o} {})", parts.join(" ")))
    })
    .boxed()
}

fn condition(terms: &'static [&'static str]) -> BoxedStrategy<String> {
    let comparison = (one_of(&["<", "<=", "=", ">=", ">"]), expression(terms), expression(terms));
    let leaf = prop_oneof![
        Just("(p0)".to_owned()),
        one_of(terms).prop_map(|t| format!("(p1 {t})")),
        one_of(terms).prop_map(|t| format!("(derived {t})")),
        (one_of(terms), one_of(terms)).prop_map(|(a, b)| format!("(p2 {a} {b})")),
        (one_of(terms), one_of(terms)).prop_map(|(a, b)| format!("(= {a} {b})")),
        one_of(terms).prop_map(|t| format!("(b {t})")),
        one_of(terms).prop_map(|t| format!("(= (o1 {t}) undefined)")),
        comparison.prop_map(|(how, a, b)| format!("({how} {a} {b})")),
        one_of(terms).prop_map(|t| format!("(forall (?q - (either a b) ?r) (imply (p2 ?q ?r) (p1 {t})))")),
        Just("()".to_owned()),
    ];
    leaf.prop_recursive(3, 16, 3, |inner| {
        let several = prop::collection::vec(inner.clone(), 0..3);
        prop_oneof![
            inner.clone().prop_map(|c| format!("(not {c})")),
            (one_of(&["and", "or"]), several).prop_map(|(o, parts)| format!("({o} {})", parts.join(" "))),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("(imply {a} {b})")),
            (one_of(&["exists", "forall"]), inner)
                .prop_map(|(q, c)| format!("({q} (?q - a) (or (p1 ?q) {c}))")),
        ]
    })
    .boxed()
}

fn effect() -> BoxedStrategy<String> {
    let assign = (one_of(&["assign", "increase", "decrease", "scale-up", "scale-down"]), expression(TERMS));
    let leaf = prop_oneof![
        Just("(p0)".to_owned()),
        one_of(TERMS).prop_map(|t| format!("(p1 {t})")),
        one_of(TERMS).prop_map(|t| format!("(not (p1 {t}))")),
        assign.prop_map(|(how, value)| format!("({how} (n1 ?x) {value})")),
        one_of(TERMS).prop_map(|t| format!("(assign (o1 ?x) {t})")),
        Just("(assign (o1 ?y) undefined)".to_owned()),
        Just("()".to_owned()),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..3).prop_map(|parts| format!("(and {})", parts.join(" "))),
            inner.clone().prop_map(|e| format!("(forall (?q - b) (and (p1 ?q) {e}))")),
            (condition(TERMS), inner).prop_map(|(c, e)| format!("(when {c} {e})")),
        ]
    })
    .boxed()
}

/// A condition with preferences beside it.
fn soft(hard: BoxedStrategy<String>, wish: BoxedStrategy<String>) -> BoxedStrategy<String> {
    let preference = prop_oneof![
        wish.clone().prop_map(|c| format!("(preference {c})")),
        (one_of(&["w1", "w2"]), wish.clone()).prop_map(|(name, c)| format!("(preference {name} {c})")),
        wish.prop_map(|c| format!("(forall (?q - a) (preference w3 (and {c})))")),
    ];
    (hard, prop::collection::vec(preference, 0..3))
        .prop_map(|(hard, soft)| format!("(and {hard} {})", soft.join(" ")))
        .boxed()
}

fn constraint(terms: &'static [&'static str]) -> BoxedStrategy<String> {
    let one = (one_of(&["always", "sometime", "at-most-once", "at end"]), condition(terms));
    let two = (one_of(&["sometime-after", "sometime-before"]), condition(terms), condition(terms));
    let leaf = prop_oneof![
        one.prop_map(|(o, c)| format!("({o} {c})")),
        two.prop_map(|(o, a, b)| format!("({o} {a} {b})")),
        condition(terms).prop_map(|c| format!("(within 5 {c})")),
        (condition(terms), condition(terms)).prop_map(|(a, b)| format!("(always-within 2.5 {a} {b})")),
        condition(terms).prop_map(|c| format!("(hold-during 1 2 {c})")),
        condition(terms).prop_map(|c| format!("(hold-after 3 {c})")),
    ];
    leaf.prop_recursive(2, 6, 2, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 1..3).prop_map(|parts| format!("(and {})", parts.join(" "))),
            inner.clone().prop_map(|c| format!("(forall (?q - a) {c})")),
            inner.prop_map(|c| format!("(always {c})")),
        ]
    })
    .boxed()
}

fn durative() -> BoxedStrategy<String> {
    let when = || one_of(&["at start", "over all", "at end"]);
    let conditions = prop::collection::vec((when(), condition(TERMS)), 0..3)
        .prop_map(|parts| parts.iter().map(|(when, c)| format!(" ({when} {c})")).collect::<String>());
    let effects = prop::collection::vec((one_of(&["at start", "at end"]), effect()), 0..3)
        .prop_map(|parts| parts.iter().map(|(when, e)| format!(" ({when} {e})")).collect::<String>());
    let duration = prop_oneof![
        expression(TERMS).prop_map(|e| format!("(= ?duration {e})")),
        (expression(TERMS), expression(TERMS))
            .prop_map(|(a, b)| format!("(and (at start (>= ?duration {a})) (at end (<= ?duration {b})))")),
        Just("()".to_owned()),
    ];
    let across = (condition(TERMS), condition(TERMS), effect()).prop_map(|(a, b, e)| {
        format!("(forall (?s - a) (when (and (at start {a}) (at end {b})) (at end {e})))")
    });
    let more = prop_oneof![
        expression(TERMS).prop_map(|e| format!("(increase (n1 ?y) (* #t {e}))")),
        Just("(forall (?s - b) (decrease (n1 ?s) #t))".to_owned()),
        across,
        Just(String::new()),
    ];
    (duration, conditions, condition(TERMS), effects, more)
        .prop_map(|(duration, conditions, wish, effects, more)| {
            format!(
                "(:durative-action work :parameters (?x - a ?y - b ?z - (either a b)) :duration {duration}
                  :condition (and{conditions} (preference w4 (over all {wish}))) :effect (and{effects} {more}))"
            )
        })
        .boxed()
}

fn network() -> BoxedStrategy<String> {
    prop_oneof![
        Just(":ordered-subtasks (and (act ?x ?y ?z) (todo ?x))".to_owned()),
        Just(
            ":subtasks (and (one (act ?x ?y ?z)) (two (todo k)) (three (act k m k)))".to_owned()
                + " :ordering (and (< one two) (< one three))"
        ),
        Just(":ordered-subtasks ()".to_owned()),
        Just(":tasks (todo ?y)".to_owned()),
    ]
    .boxed()
}

fn domain() -> impl Strategy<Value = String> {
    let action = (soft(condition(TERMS), condition(TERMS)), effect()).prop_map(|(c, e)| {
        format!("(:action act :parameters (?x - a ?y - b ?z - (either a b)) :precondition {c} :effect {e})")
    });
    let happening =
        (condition(TERMS), effect(), condition(TERMS), expression(TERMS)).prop_map(|(c, e, d, rate)| {
            format!(
                "(:event bang :parameters (?x - a ?y - b ?z - a) :precondition {c} :effect {e})
             (:process burn :parameters (?x - a ?y - b ?z - a) :precondition {d}
               :effect (and (decrease (n1 ?x) (* {rate} #t)) (increase (n0) #t)))"
            )
        });
    let axiom = condition(TERMS).prop_map(|c| {
        format!("(:derived (derived ?x - a) (exists (?y - b ?z - (either a b)) (and {c} (not (p0)))))")
    });
    let method = (condition(TERMS), network()).prop_map(|(c, n)| {
        format!(
            "(:task todo :parameters (?t - a))
             (:method how :parameters (?x - a ?y - b ?z - (either a b)) :task (todo ?x) :precondition {c} {n}
               :constraints (and (not (= ?x ?y)) (sortof ?z - b)))"
        )
    });
    (action, happening, axiom, method, durative(), constraint(&["k", "m", "(o1 k)"])).prop_map(
        |(action, happening, axiom, method, durative, constraint)| {
            format!(
                "(define (domain everything)
                   (:types b - a a - object c)
                   (:constants k - a m - b)
                   (:predicates (p0) (p1 ?x - a) (p2 ?x ?y - a) (derived ?x - a))
                   (:functions (n0) (n1 ?x - a) - number (o1 ?x - a) - a)
                   {action} {durative} {happening} {axiom} {method} (:constraints {constraint}))"
            )
        },
    )
}

fn problem() -> impl Strategy<Value = String> {
    let wishes = constraint(OBJECTS).prop_map(|c| format!("(forall (?q - a) (preference w5 {c}))"));
    (soft(condition(OBJECTS), condition(OBJECTS)), constraint(OBJECTS), wishes, expression(OBJECTS)).prop_map(
        |(goal, constraint, wishes, metric)| {
            format!(
                "(define (problem all) (:domain everything) (:objects i - a j - b)
                   (:htn :parameters (?v - a) :ordered-subtasks (and (todo ?v) (act k m k)) :constraints (not (= ?v k)))
                   (:init (p0) (p2 i j) (= (n0) 1.5) (= (n1 i) .5) (= (o1 i) j)
                     (at 5 (p1 i)) (at 6.25 (not (p1 i))) (at 7 (= (n0) 3)))
                   (:goal {goal})
                   (:constraints (and {constraint} {wishes}))
                   (:metric minimize (+ (is-violated w5) (total-time) {metric})))"
            )
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn every_task_of_the_grammar_is_read_and_prints_to_itself(domain in domain(), problem in problem()) {
        let source = Source::new("domain.pddl", domain);
        check_text(&source);
        check_drafts(&source);
        let said = pddl::parse_domain(&source, &[]).diagnostics;
        let Some(domain) = check_domain(&source, &[]) else {
            return Err(TestCaseError::fail(format!("{}\n{}", said[0].describe(&source), source.text())));
        };
        prop_assert!(domain.unsupported.is_empty(), "{said:?}");
        let source = Source::new("problem.pddl", problem);
        check_text(&source);
        let said = pddl::parse_problem(&source, &domain).diagnostics;
        let Some(problem) = check_problem(&source, &domain) else {
            return Err(TestCaseError::fail(format!("{}\n{}", said[0].describe(&source), source.text())));
        };
        prop_assert!(problem.unsupported.is_empty(), "{said:?}");
    }
}
