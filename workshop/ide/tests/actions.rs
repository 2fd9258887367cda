//! What can be done about mistakes.

mod support;

use expect_test::{Expect, expect};
use ide::code_actions;
use pddl::Span;
use support::{apply, fixture};

fn check(text: &str, expected: &Expect) {
    let (project, at) = fixture(text);
    // Lints run before an author asks.
    project.lint_findings(at.source);
    let actions = code_actions(&project, at.source, Span::new(at.offset, at.offset));
    let line = |a: &ide::CodeAction| {
        let mark = if a.preferred { "!" } else { "" };
        let code = a.fixes.map_or("", |(code, _)| code);
        format!("{mark}{code} {}\n{}", a.title, apply(&project, &a.edits))
    };
    expected.assert_eq(&actions.iter().map(line).collect::<String>());
}

#[test]
fn mistyped_names() {
    check(
        "(define (domain d) (:requirements :strips) (:predicates (lit)) (:action a :effect (li$0tt)))",
        &expect![[r#"
            !E0202 Change to `lit`
            //- domain.pddl
            (define (domain d) (:requirements :strips) (:predicates (lit)) (:action a :effect (lit)))
            E0202 Declare the predicate `(litt)`
            //- domain.pddl
            (define (domain d) (:requirements :strips) (:predicates (lit) (litt)) (:action a :effect (litt)))
        "#]],
    );
    check(
        "(define (domain d) (:requirements :strips) (:predicats$0 (lit)))",
        &expect![[r#"
        !E0107 Change to `:predicates`
        //- domain.pddl
        (define (domain d) (:requirements :strips) (:predicates (lit)))
    "#]],
    );
    check(
        "(define (domain d) (:action a :efect$0 ()))",
        &expect![[r#"
        !E0108 Change to `:effect`
        //- domain.pddl
        (define (domain d) (:action a :effect ()))
    "#]],
    );
    check(
        "//- p.pddl\n(define (problem p) (:domain hal$0) (:goal ()))\n//- d.pddl\n(define (domain hall))\n",
        &expect![[r#"
            !W0223 Change to `hall`
            //- p.pddl
            (define (problem p) (:domain hall) (:goal ()))
        "#]],
    );
}

#[test]
fn declarations_with_their_types() {
    check(
        "(define (domain d)
  (:types lamp place)
  (:constants kitchen - place)
  (:predicates
    (at ?l - lamp ?p - place) ; where it is
  )
  (:action a :parameters (?l - lamp)
    :effect (forall (?p - (either lamp place)) (bright$0 ?l ?p kitchen))))",
        &expect![[r#"
            !E0202 Declare the predicate `(bright ?l - lamp ?p - (either lamp place) ?x3 - place)`
            //- domain.pddl
            (define (domain d)
              (:types lamp place)
              (:constants kitchen - place)
              (:predicates
                (at ?l - lamp ?p - place) ; where it is
                (bright ?l - lamp ?p - (either lamp place) ?x3 - place)
              )
              (:action a :parameters (?l - lamp)
                :effect (forall (?p - (either lamp place)) (bright ?l ?p kitchen))))
        "#]],
    );
    check(
        "(define (domain d)\n  (:action a :parameters (?x) :effect (gone$0 ?x)))",
        &expect![[r#"
        !E0202 Declare the predicate `(gone ?x - object)`
        //- domain.pddl
        (define (domain d)
          (:predicates (gone ?x - object))
          (:action a :parameters (?x) :effect (gone ?x)))
    "#]],
    );
    check(
        "(define (domain d)\n  (:action a :effect (increase (total$0) 1)))",
        &expect![[r#"
        !E0203 Declare the function `(total) - number`
        //- domain.pddl
        (define (domain d)
          (:functions (total) - number)
          (:action a :effect (increase (total) 1)))
    "#]],
    );
    check(
        "(define (domain d) (:types lamp) (:predicates (p ?x - plaice$0)))",
        &expect![[r#"
            !E0201 Declare the type `plaice - object`
            //- domain.pddl
            (define (domain d) (:types lamp - object plaice - object) (:predicates (p ?x - plaice)))
        "#]],
    );
    check(
        "(define (domain d) (:types lamp) (:predicates (p ?x - lamp))
  (:action a :parameters () :effect (p ?z$0)))",
        &expect![[r#"
            !E0205 Add the parameter `?z - lamp`
            //- domain.pddl
            (define (domain d) (:types lamp) (:predicates (p ?x - lamp))
              (:action a :parameters (?z - lamp) :effect (p ?z)))
        "#]],
    );
    check(
        "//- d.pddl
(define (domain d) (:types lamp) (:predicates (p ?x - lamp)))
//- p.pddl
(define (problem q) (:domain d)
  (:objects
    a - lamp)
  (:init (p a) (p zebra$0) (unheard a)) (:goal (p a)))
",
        &expect![[r#"
            !E0204 Declare the object `zebra - lamp`
            //- p.pddl
            (define (problem q) (:domain d)
              (:objects
                a - lamp
                zebra - lamp)
              (:init (p a) (p zebra) (unheard a)) (:goal (p a)))
        "#]],
    );
    check(
        "//- d.pddl
(define (domain d) (:types lamp) (:predicates (p ?x - lamp)))
//- p.pddl
(define (problem q) (:domain d)
  (:objects a - lamp)
  (:init (unheard$0 a)) (:goal (p a)))
",
        &expect![[r#"
            !E0202 Declare the predicate `(unheard ?x1 - lamp)`
            //- d.pddl
            (define (domain d) (:types lamp) (:predicates (p ?x - lamp) (unheard ?x1 - lamp)))
        "#]],
    );
}

#[test]
fn requirements_are_added() {
    check(
        "(define (domain d)
  (:predicates (p))
  (:durative-action a :duration (= ?duration 1) :priority$0 3 :effect (at end (p))))",
        &expect![[r#"
            !E0503 Add the requirement `:agent-rules`
            //- domain.pddl
            (define (domain d)
              (:requirements :agent-rules)
              (:predicates (p))
              (:durative-action a :duration (= ?duration 1) :priority 3 :effect (at end (p))))
        "#]],
    );
    check(
        "(define (domain d) (:requirements :strips) (:predicates (p)) (:action a :precondition (n$0ot (p)) :effect (p)))",
        &expect![[r#"
            !W0701 declare `:negative-preconditions`
            //- domain.pddl
            (define (domain d) (:requirements :strips :negative-preconditions) (:predicates (p)) (:action a :precondition (not (p)) :effect (p)))
            W0701 Allow it here: `; allow(undeclared-requirement)`
            //- domain.pddl
            ; allow(undeclared-requirement)
            (define (domain d) (:requirements :strips) (:predicates (p)) (:action a :precondition (not (p)) :effect (p)))
        "#]],
    );
}

#[test]
fn what_has_no_type_does_not_get_one() {
    check(
        "//- d.pddl
(define (domain d) (:types lamp) (:predicates (p ?x - lamp)))
//- p.pddl
(define (problem q) (:domain d) (:objects a b) (:init (p zebra$0)) (:goal ()))
",
        &expect![[r#"
            !E0204 Declare the object `zebra - lamp`
            //- p.pddl
            (define (problem q) (:domain d) (:objects a b - object zebra - lamp) (:init (p zebra)) (:goal ()))
        "#]],
    );
}

#[test]
fn lints_that_have_not_run_are_not_waited_for() {
    let (project, at) = fixture("(define (domain d) (:predicates (p) (un$0used)) (:action a :effect (p)))");
    let actions = || code_actions(&project, at.source, Span::new(at.offset, at.offset)).len();
    assert_eq!((actions(), project.cached_lint_findings(at.source).len()), (0, 0));
    assert!(!project.lint_findings(at.source).is_empty());
    assert_eq!(project.cached_lint_findings(at.source).len(), project.lint_findings(at.source).len());
    assert!(actions() > 0);
}

#[test]
fn lints_are_mended() {
    check(
        "(define (domain d) (:requirements :strips) (:predicates (p ?x) (unus$0ed ?x))
  (:action a :parameters (?x) :precondition (p ?x) :effect (not (p ?x))))",
        &expect![[r#"
            !W0703 remove `unused`
            //- domain.pddl
            (define (domain d) (:requirements :strips) (:predicates (p ?x))
              (:action a :parameters (?x) :precondition (p ?x) :effect (not (p ?x))))
            W0703 Allow it here: `; allow(unused-predicate)`
            //- domain.pddl
            ; allow(unused-predicate)
            (define (domain d) (:requirements :strips) (:predicates (p ?x) (unused ?x))
              (:action a :parameters (?x) :precondition (p ?x) :effect (not (p ?x))))
        "#]],
    );
    check(
        "//- d.pddl
(define (domain d) (:requirements :typing) (:types t) (:predicates (p ?x - t))
  (:action a :parameters (?x - t ?un$0used - object) :precondition (p ?x) :effect (not (p ?x))))
//- p.pddl
(define (problem q) (:domain d) (:requirements :typing) (:objects o - t) (:init (p o)) (:goal (p o)))
//- p.plan
(a o o)
",
        &expect![[r#"
            W0709 Allow it here: `; allow(unused-parameter)`
            //- d.pddl
            (define (domain d) (:requirements :typing) (:types t) (:predicates (p ?x - t))
              ; allow(unused-parameter)
              (:action a :parameters (?x - t ?unused - object) :precondition (p ?x) :effect (not (p ?x))))
        "#]],
    );
    check(
        "(define (domain d) (:requirements :strips) (:predicates (p ?x))
  (:action a :parameters (?x ?un$0used) :precondition (p ?x) :effect (not (p ?x))))",
        &expect![[r#"
            !W0709 remove `?unused`
            //- domain.pddl
            (define (domain d) (:requirements :strips) (:predicates (p ?x))
              (:action a :parameters (?x) :precondition (p ?x) :effect (not (p ?x))))
            W0709 Allow it here: `; allow(unused-parameter)`
            //- domain.pddl
            (define (domain d) (:requirements :strips) (:predicates (p ?x))
              ; allow(unused-parameter)
              (:action a :parameters (?x ?unused) :precondition (p ?x) :effect (not (p ?x))))
        "#]],
    );
}

#[test]
fn nothing_to_do() {
    check("(define (domain d) (:requirements :strips) (:predicates (p))$0)", &expect![[""]]);
    check("$0", &expect![[""]]);
    check("(((($0", &expect![[""]]);
}
