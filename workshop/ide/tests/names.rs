//! Definition, references, highlights and rename, over several files.

mod support;

use expect_test::{Expect, expect};
use ide::{Declarations, definition, highlights, prepare_rename, references, rename};
use support::{apply, fixture, show};

const HALL: &str = "//- hall/domain.pddl
(define (domain hall)
  (:requirements :strips :typing)
  (:types place - object lamp table - place)
  (:constants kitchen - place)
  (:predicates (lit ?l - lamp) (at ?l - lamp ?p - place))
  (:functions (total-cost))
  (:action light :parameters (?l - lamp ?p - place)
    :precondition (and (at ?l ?p) (not (lit ?l)) (exists (?l - table) (lit kitchen)))
    :effect (and (lit ?l) (increase (total-cost) 1))))
//- hall/p1.pddl
(define (problem p1) (:domain hall) (:objects a - lamp)
  (:init (at a kitchen)) (:goal (lit a)))
//- hall/p1.plan
(light a kitchen)
//- other/domain.pddl
(define (domain other) (:predicates (lit ?x)) (:action light :effect (and)))
";

fn at(cursor: &str) -> String {
    let clean = cursor.replace("$0", "");
    assert!(HALL.matches(&clean).count() == 1, "`{clean}` stands once in the fixture");
    HALL.replace(&clean, cursor)
}

fn check_definition(text: &str, expected: &Expect) {
    let (project, position) = fixture(text);
    let found = definition(&project, position);
    let lines = found.map_or_else(Vec::new, |found| {
        found
            .targets
            .iter()
            .map(|t| format!("{} | {}\n", show(&project, t.name), show(&project, t.full)))
            .collect()
    });
    expected.assert_eq(&lines.concat());
}

fn check_references(text: &str, expected: &Expect) {
    let (project, position) = fixture(text);
    let found = references(&project, position, Declarations::Included).unwrap_or_default();
    let line = |r: &ide::Reference| format!("{:?} {}\n", r.role, show(&project, r.place));
    expected.assert_eq(&found.iter().map(line).collect::<String>());
}

fn check_rename(text: &str, name: &str, expected: &Expect) {
    let (project, position) = fixture(text);
    expected.assert_eq(&match rename(&project, position, name) {
        Ok(edits) => apply(&project, &edits),
        Err(error) => error.to_string(),
    });
}

#[test]
fn definitions() {
    check_definition(
        &at("(light $0a kitchen)"),
        &expect![[r#"
        hall/p1.pddl:1:47 a | hall/p1.pddl:1:47 a
    "#]],
    );
    check_definition(
        &at("(light$0 a kitchen)"),
        &expect![[r#"
        hall/domain.pddl:7:12 light | hall/domain.pddl:7:3 (:action light :parameters (?l - lamp ?p - place) :precondition (and (at ?l ?p) (not (lit ?l)) (exists (?l - table) (lit kitchen))) :effect (and (lit ?l) (increase (total-cost) 1)))
    "#]],
    );
    check_definition(
        &at("(at a kit$0chen)"),
        &expect![[r#"
        hall/domain.pddl:4:15 kitchen | hall/domain.pddl:4:15 kitchen
    "#]],
    );
    check_definition(
        &at("(:domain ha$0ll)"),
        &expect![[r#"
            hall/domain.pddl:1:17 hall | hall/domain.pddl:1:1 (define (domain hall) (:requirements :strips :typing) (:types place - object lamp table - place) (:constants kitchen - place) (:predicates (lit ?l - lamp) (at ?l - lamp ?p - place)) (:functions (total-cost)) (:action light :parameters (?l - lamp ?p - place) :precondition (and (at ?l ?p) (not (lit ?l)) (exists (?l - table) (lit kitchen))) :effect (and (lit ?l) (increase (total-cost) 1))))
        "#]],
    );
    check_definition(
        &at("(:objects a - lam$0p)"),
        &expect![[r#"
        hall/domain.pddl:3:26 lamp | hall/domain.pddl:3:26 lamp
    "#]],
    );
    check_definition(
        &at("(exists (?l - table) (lit ki$0tchen))"),
        &expect![[r#"
        hall/domain.pddl:4:15 kitchen | hall/domain.pddl:4:15 kitchen
    "#]],
    );
}

#[test]
fn the_innermost_binding_counts() {
    check_references(
        "(define (domain d) (:predicates (p ?x))
  (:action a :parameters (?x ?y) :precondition (exists (?x) (p $0?x)) :effect (p ?x))
  (:action b :parameters (?x) :effect (p ?x)))",
        &expect![[r#"
            Declaration domain.pddl:2:57 ?x
            Use domain.pddl:2:64 ?x
        "#]],
    );
    check_references(
        "(define (domain d) (:predicates (p ?x))
  (:action a :parameters (?x$0 ?y) :precondition (exists (?x) (p ?x)) :effect (p ?x))
  (:action b :parameters (?x) :effect (p ?x)))",
        &expect![[r#"
            Declaration domain.pddl:2:27 ?x
            Use domain.pddl:2:80 ?x
        "#]],
    );
}

#[test]
fn references_over_files() {
    check_references(
        &at("(lit$0 ?l - lamp)"),
        &expect![[r#"
        Declaration hall/domain.pddl:5:17 lit
        Use hall/domain.pddl:8:41 lit
        Use hall/domain.pddl:8:72 lit
        Use hall/domain.pddl:9:19 lit
        Use hall/p1.pddl:2:34 lit
    "#]],
    );
    check_references(
        &at("(:action light$0 :parameters"),
        &expect![[r#"
        Declaration hall/domain.pddl:7:12 light
        Use hall/p1.plan:1:2 light
    "#]],
    );
}

#[test]
fn imports_are_joined() {
    let text = "//- a.pddl
(define (domain a) (:predicates (p$0 ?x) (only-a)))
//- b.pddl
(define (domain b) (:predicates (p ?x)))
//- c.pddl
(define (domain c) (:import a b) (:action go :parameters (?x) :effect (p ?x)))
//- far.pddl
(define (domain far) (:predicates (p ?x)))
";
    check_references(
        text,
        &expect![[r#"
        Declaration a.pddl:1:34 p
        Declaration b.pddl:1:34 p
        Use c.pddl:1:72 p
    "#]],
    );
    check_rename(
        text,
        "q",
        &expect![[r#"
        //- a.pddl
        (define (domain a) (:predicates (q ?x) (only-a)))
        //- b.pddl
        (define (domain b) (:predicates (q ?x)))
        //- c.pddl
        (define (domain c) (:import a b) (:action go :parameters (?x) :effect (q ?x)))
    "#]],
    );
    check_rename(text, "only-a", &expect!["the predicate `only-a` exists already"]);
}

#[test]
fn highlights_stay_in_the_file() {
    let (project, position) = fixture(&at("(lit$0 ?l - lamp)"));
    let found: String =
        highlights(&project, position).iter().map(|r| show(&project, r.place) + "\n").collect();
    expect![[r#"
        hall/domain.pddl:5:17 lit
        hall/domain.pddl:8:41 lit
        hall/domain.pddl:8:72 lit
        hall/domain.pddl:9:19 lit
    "#]]
    .assert_eq(&found);
}

#[test]
fn renames_reach_every_file() {
    check_rename(
        &at("(lit$0 ?l - lamp)"),
        "shining",
        &expect![[r#"
        //- hall/domain.pddl
        (define (domain hall)
          (:requirements :strips :typing)
          (:types place - object lamp table - place)
          (:constants kitchen - place)
          (:predicates (shining ?l - lamp) (at ?l - lamp ?p - place))
          (:functions (total-cost))
          (:action light :parameters (?l - lamp ?p - place)
            :precondition (and (at ?l ?p) (not (shining ?l)) (exists (?l - table) (shining kitchen)))
            :effect (and (shining ?l) (increase (total-cost) 1))))
        //- hall/p1.pddl
        (define (problem p1) (:domain hall) (:objects a - lamp)
          (:init (at a kitchen)) (:goal (shining a)))
    "#]],
    );
    check_rename(
        &at("(light a kit$0chen)"),
        "hall",
        &expect![[r#"
        //- hall/domain.pddl
        (define (domain hall)
          (:requirements :strips :typing)
          (:types place - object lamp table - place)
          (:constants hall - place)
          (:predicates (lit ?l - lamp) (at ?l - lamp ?p - place))
          (:functions (total-cost))
          (:action light :parameters (?l - lamp ?p - place)
            :precondition (and (at ?l ?p) (not (lit ?l)) (exists (?l - table) (lit hall)))
            :effect (and (lit ?l) (increase (total-cost) 1))))
        //- hall/p1.pddl
        (define (problem p1) (:domain hall) (:objects a - lamp)
          (:init (at a hall)) (:goal (lit a)))
        //- hall/p1.plan
        (light a hall)
    "#]],
    );
    check_rename(
        &at("(:domain ha$0ll)"),
        "house",
        &expect![[r#"
        //- hall/domain.pddl
        (define (domain house)
          (:requirements :strips :typing)
          (:types place - object lamp table - place)
          (:constants kitchen - place)
          (:predicates (lit ?l - lamp) (at ?l - lamp ?p - place))
          (:functions (total-cost))
          (:action light :parameters (?l - lamp ?p - place)
            :precondition (and (at ?l ?p) (not (lit ?l)) (exists (?l - table) (lit kitchen)))
            :effect (and (lit ?l) (increase (total-cost) 1))))
        //- hall/p1.pddl
        (define (problem p1) (:domain house) (:objects a - lamp)
          (:init (at a kitchen)) (:goal (lit a)))
    "#]],
    );
}

#[test]
fn a_variable_is_renamed_in_its_scope() {
    let text = "(define (domain d) (:predicates (p ?x ?y))
  (:action a :parameters ($0?x ?y) :precondition (forall (?z) (p ?z ?X)) :effect (p ?x ?y)))";
    check_rename(
        text,
        "?who",
        &expect![[r#"
        //- domain.pddl
        (define (domain d) (:predicates (p ?x ?y))
          (:action a :parameters (?who ?y) :precondition (forall (?z) (p ?z ?who)) :effect (p ?who ?y)))
    "#]],
    );
    check_rename(
        text,
        "who",
        &expect![[r#"
        //- domain.pddl
        (define (domain d) (:predicates (p ?x ?y))
          (:action a :parameters (?who ?y) :precondition (forall (?z) (p ?z ?who)) :effect (p ?who ?y)))
    "#]],
    );
    check_rename(text, "y", &expect!["the variable `y` exists already"]);
    check_rename(text, "z", &expect!["the variable `z` exists already"]);
}

#[test]
fn renames_that_are_refused() {
    let lit = at("(lit$0 ?l - lamp)");
    for (text, name, expected) in [
        (lit.as_str(), "at", expect!["the predicate `at` exists already"]),
        (&lit, "lamp", expect!["the type `lamp` exists already"]),
        (&lit, "", expect!["`` is not a name"]),
        (&lit, "two words", expect!["`two words` is not a name"]),
        (&lit, "?x", expect!["`?x` is not a name"]),
        (&lit, "(x", expect!["`(x` is not a name"]),
        (&lit, "3", expect!["`3` is not a name"]),
        (&lit, "and", expect!["`and` is a word of the language"]),
        (&at("(light a$0 kitchen)"), "kitchen", expect!["the object `kitchen` exists already"]),
        (&at(":strips$0"), "x", expect!["the requirement `:strips` is not the project's to rename"]),
        (&at("- obj$0ect"), "x", expect!["the type `object` is not the project's to rename"]),
        ("(define (domain d)$0)", "x", expect!["there is no name here"]),
        (
            "(define (domain d) (:predicates ($0p)) (:action a :effect (p))",
            "q",
            expect!["a file in which it stands is broken: its parentheses do not match"],
        ),
    ] {
        check_rename(text, name, &expected);
    }
    let (project, position) = fixture(&at("(light $0a kitchen)"));
    assert_eq!(prepare_rename(&project, position).map(|r| r.name), Ok("a".to_owned()));
}
