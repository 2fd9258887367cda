//! Hovers over names, words of the language and mistakes.

mod support;

use expect_test::{Expect, expect};
use ide::hover;
use support::{fixture, show};

const HALL: &str = "//- domain.pddl
; A house at night.
(define (domain hall)
  (:requirements :strips :typing)
  (:types
    place - object ; somewhere
    lamp table - place)
  (:constants kitchen - place)
  (:predicates
    ; Whether it shines.
    ; Old ones flicker.
    (lit ?l - lamp)
    (at ?l - lamp ?p - place) ; where it stands
    (dark ?p - place))
  (:functions (power ?l - lamp) - number (next ?p - place) - place)
  (:derived (dark ?p - place) (forall (?l - lamp) (not (and (lit ?l) (at ?l ?p)))))
  ;; Needs somebody near.
  (:action light :parameters (?l - lamp ?p - place)
    :precondition (and (at ?l ?p) (not (lit ?l)))
    :effect (and (lit ?l) (when (lit ?l) (not (lit ?l))) (increase (power ?l) (power ?l))))
  (:task clean :parameters (?p - place))
  (:method sweep :parameters (?p - place) :task (clean ?p)
    :ordered-subtasks (and (s1 (clean ?p)) (s2 (clean kitchen)))))
//- problem.pddl
(define (problem night) (:domain hall) (:objects a - lamp hook - (either table lamp))
  (:init (at a kitchen)) (:goal (lit a)) (:metric minimize (power a)))
//- problem.plan
(light a kitchen)
";

fn check(cursor: &str, expected: &Expect) {
    let clean = cursor.replace("$0", "");
    assert!(HALL.matches(&clean).count() == 1, "`{clean}` stands once in the fixture");
    check_text(&HALL.replace(&clean, cursor), expected);
}

fn check_text(text: &str, expected: &Expect) {
    let (project, position) = fixture(text);
    project.lint_findings(position.source);
    let found = hover(&project, position);
    expected.assert_eq(
        &found.map_or_else(String::new, |h| format!("{}\n{}\n", show(&project, h.place), h.markdown)),
    );
}

#[test]
fn predicates_and_functions() {
    check(
        "(:goal (l$0it a))",
        &expect![[r#"
        problem.pddl:2:34 lit
        ```pddl
        (lit ?l - lamp)
        ```
        predicate, declared in `domain.pddl`

        Whether it shines.
        Old ones flicker.

        *needed by* `dark`, `light`

        *added by* `light`

        *deleted by* `light`
    "#]],
    );
    check(
        "(at$0 a kitchen)",
        &expect![[r#"
        problem.pddl:2:11 at
        ```pddl
        (at ?l - lamp ?p - place)
        ```
        predicate, declared in `domain.pddl`

        where it stands

        *needed by* `dark`, `light`
    "#]],
    );
    check(
        "(dark$0 ?p - place) (forall",
        &expect![[r#"
        domain.pddl:15:14 dark
        ```pddl
        (dark ?p - place)
        ```
        predicate

        *derived* by an axiom
    "#]],
    );
    check(
        "(:metric minimize (po$0wer a))",
        &expect![[r#"
        problem.pddl:2:61 power
        ```pddl
        (power ?l - lamp) - number
        ```
        function, declared in `domain.pddl`

        *needed by* `light`

        *changed by* `light`
    "#]],
    );
    check(
        "(ne$0xt ?p - place)",
        &expect![[r#"
        domain.pddl:14:43 next
        ```pddl
        (next ?p - place) - place
        ```
        function

        ---

        **W0701** undeclared requirement: The file uses a part of the language that `:requirements` does not announce.

        ---

        **W0706** unused function: A function is declared, but no condition, effect or duration of the domain names it, and no metric of the problems that were looked at.
    "#]],
    );
}

#[test]
fn types_and_objects() {
    check(
        "(:objects a - la$0mp",
        &expect![[r#"
        problem.pddl:1:54 lamp
        ```pddl
        lamp - place
        ```
        type, declared in `domain.pddl`

        `lamp` → `place` → `object`
    "#]],
    );
    check(
        "    pla$0ce - object",
        &expect![[r#"
        domain.pddl:5:5 place
        ```pddl
        place - object
        ```
        type

        `place` → `object`

        *above* `lamp`, `table`
    "#]],
    );
    check(
        "- obje$0ct ;",
        &expect![[r#"
        domain.pddl:5:13 object
        `object`

        The type of everything.
    "#]],
    );
    check(
        "(light a kit$0chen)",
        &expect![[r#"
        problem.plan:1:10 kitchen
        ```pddl
        kitchen - place
        ```
        object, declared in `domain.pddl`

        `place` → `object`
    "#]],
    );
    check(
        "ho$0ok -",
        &expect![[r#"
        problem.pddl:1:59 hook
        ```pddl
        hook - (either table lamp)
        ```
        object

        `table` → `place` → `object`

        `lamp` → `place` → `object`
    "#]],
    );
}

#[test]
fn actions_tasks_and_variables() {
    check(
        "(li$0ght a kitchen)",
        &expect![[r#"
        problem.plan:1:2 light
        ```pddl
        (light ?l - lamp ?p - place)
        ```
        action, declared in `domain.pddl`

        Needs somebody near.
    "#]],
    );
    check(
        ":task (cle$0an ?p)",
        &expect![[r#"
            domain.pddl:21:50 clean
            ```pddl
            (clean ?p - place)
            ```
            task

            *carried out by* `sweep`

            *subtask of* `sweep`
        "#]],
    );
    check(
        "(:method sw$0eep",
        &expect![[r#"
            domain.pddl:21:12 sweep
            ```pddl
            (sweep ?p - place) for (clean ?p)
            ```
            method
        "#]],
    );
    check(
        "(s1$0 (clean ?p))",
        &expect![[r#"
            domain.pddl:22:29 s1
            ```pddl
            (s1 (clean ?p))
            ```
            subtask
        "#]],
    );
    check(
        "(not (and (lit ?$0l)",
        &expect![[r#"
        domain.pddl:15:66 ?l
        ```pddl
        ?l - lamp
        ```
        variable, bound by `forall`
    "#]],
    );
    check(
        "(increase (power ?l) (power $0?l))",
        &expect![[r#"
        domain.pddl:19:86 ?l
        ```pddl
        ?l - lamp
        ```
        variable, parameter of `light`
    "#]],
    );
    check(
        "(:domain ha$0ll)",
        &expect![[r#"
            problem.pddl:1:34 hall
            ```pddl
            (domain hall)
            ```
            domain, declared in `domain.pddl`

            A house at night.
        "#]],
    );
}

#[test]
fn words_of_the_language() {
    check(
        ":typ$0ing",
        &expect![[r#"
        domain.pddl:3:26 :typing
        `:typing`

        Types of parameters and objects: `(:types …)` and `?x - type`.
    "#]],
    );
    check(
        ":precon$0dition",
        &expect![[r#"
        domain.pddl:18:5 :precondition
        `:precondition`

        What must be true for it to be possible.
    "#]],
    );
    check(
        "(for$0all (?l - lamp) (not",
        &expect![[r#"
        domain.pddl:15:32 forall
        `forall`

        For every object of the type.

        ---

        **W0701** undeclared requirement: The file uses a part of the language that `:requirements` does not announce.
    "#]],
    );
    check(
        "(:metric mini$0mize",
        &expect![[r#"
        problem.pddl:2:51 minimize
        `minimize`

        The less the better.
    "#]],
    );
    check("; Old $0ones", &expect![[""]]);
}

#[test]
fn mistakes_are_explained() {
    check_text(
        "(define (domain d) (:action a :effect (li$0t)))",
        &expect![[r#"
        domain.pddl:1:40 lit
        **E0202** unknown predicate: A condition, an effect or a fact uses a predicate that `:predicates` does not declare.
    "#]],
    );
    check_text(
        "(define (domain d) (:predicates (p ?x - lam$0p))",
        &expect![[r#"
        domain.pddl:1:41 lamp
        **E0201** unknown type: A type is used that `:types` does not declare.
    "#]],
    );
}
