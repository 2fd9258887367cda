//! The results for editors: drafts of files with errors, and the places of names.

use expect_test::{Expect, expect};
use pddl::{
    Analysis, Names, Occurrence, Role, Source, analyze_domain, analyze_plan, analyze_problem, parse_domain,
    parse_problem,
};

/// Each name with its kind: `!` marks a declaration; a scope is shown by the first word of its list.
fn names(source: &Source, occurrences: &[Occurrence]) -> String {
    let line = |o: &Occurrence| {
        let mark = if o.role == Role::Declaration { "!" } else { "" };
        let scope = o.symbol.scope.map_or_else(String::new, |scope| {
            let at = source.line_column(scope.start);
            format!(" in {}:{}", at.line, at.column)
        });
        let at = source.line_column(o.span.start);
        format!("{}:{} {mark}{} {}{scope}\n", at.line, at.column, o.symbol.kind, source.slice(o.span))
    };
    occurrences.iter().map(line).collect()
}

fn said<M>(source: &Source, analysis: &Analysis<M>) -> String {
    let lines = analysis.diagnostics.iter().map(|d| {
        let at = source.line_column(d.span.start);
        format!("{}:{} {} {}\n", at.line, at.column, d.code(), d.message())
    });
    lines.collect()
}

fn check_domain(text: &str, expected_names: &Expect, expected_said: &Expect) {
    let source = Source::new("d.pddl", text);
    let analysis = analyze_domain(&source, &[], Names::Kept);
    expected_names.assert_eq(&names(&source, &analysis.occurrences));
    expected_said.assert_eq(&said(&source, &analysis));
}

#[test]
fn every_name_of_a_domain_is_found() {
    check_domain(
        "(define (domain d)
(:requirements :typing)
(:types a - b c - (either a object))
(:constants k - c)
(:predicates (p ?x - a ?y - c) (r ?x - a))
(:functions (f ?x - a) - b)
(:derived (r ?x) (exists (?x - c) (= (f k) ?x)))
(:action go :parameters (?x - a)
 :precondition (forall (?x - a) (p ?x k))
 :effect (and (p ?x k) (assign (f ?x) k)))
(:task t :parameters (?x - a))
(:method m :parameters (?x - a) :task (t ?x)
 :subtasks (and (s1 (go ?x)) (s2 (t ?x))) :ordering (< s1 s2)))",
        &expect![[r#"
            1:17 !domain d
            2:16 requirement :typing
            3:9 !type a
            3:13 !type b
            3:15 !type c
            3:27 type a
            3:29 type object
            4:13 !object k
            4:17 type c
            5:15 !predicate p
            5:17 !variable ?x in 5:14
            5:22 type a
            5:24 !variable ?y in 5:14
            5:29 type c
            5:33 !predicate r
            5:35 !variable ?x in 5:32
            5:40 type a
            6:14 !function f
            6:16 !variable ?x in 6:13
            6:21 type a
            6:26 type b
            7:12 predicate r
            7:14 !variable ?x in 7:1
            7:27 !variable ?x in 7:18
            7:32 type c
            7:39 function f
            7:41 object k
            7:44 variable ?x in 7:18
            8:10 !action go
            8:26 !variable ?x in 8:1
            8:31 type a
            9:25 !variable ?x in 9:16
            9:30 type a
            9:34 predicate p
            9:36 variable ?x in 9:16
            9:39 object k
            10:16 predicate p
            10:18 variable ?x in 8:1
            10:21 object k
            10:33 function f
            10:35 variable ?x in 8:1
            10:39 object k
            11:8 !task t
            11:23 !variable ?x in 11:1
            11:28 type a
            12:10 !method m
            12:25 !variable ?x in 12:1
            12:30 type a
            12:40 task t
            12:42 variable ?x in 12:1
            13:18 !subtask s1 in 12:1
            13:22 action go
            13:25 variable ?x in 12:1
            13:31 !subtask s2 in 12:1
            13:35 task t
            13:37 variable ?x in 12:1
            13:56 subtask s1 in 12:1
            13:59 subtask s2 in 12:1
        "#]],
        &expect![""],
    );
}

#[test]
fn rules_and_permissions() {
    check_domain(
        "(define (domain d)
(:requirements :agent-rules :vocabulary)
(:types robot)
(:constants r - robot)
(:predicates (busy ?r - robot))
(:writes speech (busy r) robot)
(:durative-action say :parameters (?r - robot) :results (?o - robot) :claims (r)
 :skill (talk ?r) :duration (= ?duration 1)
 :condition (forall (?x - robot) (and (at start (busy ?x)) (over all (busy ?x))))
 :effect (at end (busy ?o))))",
        &expect![[r#"
            1:17 !domain d
            2:16 requirement :agent-rules
            2:29 requirement :vocabulary
            3:9 !type robot
            4:13 !object r
            4:17 type robot
            5:15 !predicate busy
            5:20 !variable ?r in 5:14
            5:25 type robot
            6:10 agent speech
            6:18 predicate busy
            6:23 object r
            6:26 type robot
            7:19 !action say
            7:36 !variable ?r in 7:1
            7:41 type robot
            7:58 !variable ?o in 7:1
            7:63 type robot
            7:79 object r
            8:10 skill talk
            8:15 variable ?r in 7:1
            9:22 !variable ?x in 9:13
            9:27 type robot
            9:50 predicate busy
            9:55 variable ?x in 9:13
            9:71 predicate busy
            9:76 variable ?x in 9:13
            10:19 predicate busy
            10:24 variable ?o in 7:1
        "#]],
        &expect![[""]],
    );
}

#[test]
fn what_is_unknown_is_said_once_and_still_a_name() {
    check_domain(
        "(define (domain d) (:types t)
(:constants k - nosuch)
(:predicates (p ?x - t) (q ?x - typo))
(:action go :parameters (?x - typo) :precondition (and (p ?x) (p k) (nop ?y)) :effect (q ?x)))",
        &expect![[r#"
            1:17 !domain d
            1:28 !type t
            2:13 !object k
            2:17 type nosuch
            3:15 !predicate p
            3:17 !variable ?x in 3:14
            3:22 type t
            3:26 !predicate q
            3:28 !variable ?x in 3:25
            3:33 type typo
            4:10 !action go
            4:26 !variable ?x in 4:1
            4:31 type typo
            4:57 predicate p
            4:59 variable ?x in 4:1
            4:64 predicate p
            4:66 object k
            4:70 predicate nop
            4:74 variable ?y
            4:88 predicate q
            4:90 variable ?x in 4:1
        "#]],
        &expect![[r#"
            2:17 E0201 unknown type `nosuch`
            3:33 E0201 unknown type `typo`
            4:31 E0201 unknown type `typo`
            4:70 E0202 unknown predicate `nop`
            4:74 E0205 unknown variable `?y`
        "#]],
    );
}

#[test]
fn a_problem_is_read_with_the_draft_of_its_domain() {
    let domain = Source::new(
        "d.pddl",
        "(define (domain d) (:types t) (:predicates (p ?x - t) (q ?x - typo))
        (:action go :parameters (?x - t) :precondition (nosuch ?x) :effect (p ?x)))",
    );
    let domain = analyze_domain(&domain, &[], Names::Kept);
    assert!(!domain.sound);
    let source = Source::new(
        "p.pddl",
        "(define (problem x) (:domain d) (:objects a - t) (:init (q a) (p b)) (:goal (p a)))",
    );
    let problem = analyze_problem(&source, &domain.draft, Names::Kept);
    expect!["1:66 E0204 unknown object `b`\n"].assert_eq(&said(&source, &problem));
    assert_eq!((problem.draft.init.len(), problem.sound), (1, false));
    let source = Source::new("x.plan", "(go a) (go b)\n(come a)");
    let plan = analyze_plan(&source, &domain.draft, &problem.draft, Names::Kept);
    let sequential = plan.draft.clone().into_sequential().expect("no times");
    assert_eq!(sequential.steps.len(), 1);
    expect![[r#"
        1:2 action go
        1:5 object a
        1:9 action go
        1:12 object b
        2:2 action come
    "#]]
    .assert_eq(&names(&source, &plan.occurrences));
}

#[test]
fn any_text_has_a_draft() {
    for text in ["", "(", ")", "(define", "(define (domain", "(define (problem p) (:init (p", "hello ; world"]
    {
        let source = Source::new("x.pddl", text);
        let domain = analyze_domain(&source, &[], Names::Kept);
        let problem = analyze_problem(&source, &domain.draft, Names::Kept);
        analyze_plan(&source, &domain.draft, &problem.draft, Names::Kept);
        assert!(!domain.sound && !problem.sound);
        assert!(parse_domain(&source, &[]).model.is_none());
        assert!(parse_problem(&source, &domain.draft).model.is_none());
    }
}
