//! Small suites in memory: what is expected of them, and what is said when it is not so.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use expect_test::{Expect, expect};
use pddl::Source;
use planner::Budget;
use std::time::Duration;
use suite::{CaseId, File, Folder, Suite, draft};

const DOMAIN: &str = "(define (domain tea)
  (:requirements :strips :typing :negative-preconditions)
  (:types cup)
  (:predicates (clean ?c - cup) (full ?c - cup) (hot))
  (:action boil :parameters () :precondition (not (hot)) :effect (hot))
  (:action pour
    :parameters (?c - cup)
    :precondition (and (hot) (clean ?c) (not (full ?c)))
    :effect (and (full ?c) (not (clean ?c)))))";
const PROBLEM: &str = "(define (problem two) (:domain tea) (:objects a b - cup)
  (:init (clean a) (clean b)) (:goal (and (full a) (full b))))";
const EMPTY: &str = "(define (problem none) (:domain tea) (:objects a - cup)
  (:init) (:goal (full a)))";

fn folder(expected: &str, more: &[(&str, &str)]) -> Folder {
    let files = [("domain.pddl", DOMAIN), ("two.pddl", PROBLEM)];
    let files = files.iter().chain(more).map(|(path, text)| File {
        path: (*path).to_owned(),
        source: Source::new(format!("tea/{path}"), *text),
    });
    Folder {
        path: "tea".to_owned(),
        expected: Source::new("tea/expected.toml", expected),
        files: files.collect(),
        elsewhere: Vec::new(),
    }
}

/// With a clock that stands still.
fn run(suite: &Suite, id: CaseId) -> Vec<diagnostics::Finding> {
    suite.run(id, &|| Duration::ZERO, &Budget::default())
}

/// A line per case, and whatever is to be said.
fn check(expected: &str, more: &[(&str, &str)], said: &Expect) {
    let suite = Suite::read(folder(expected, more));
    let mut text: String = suite.findings().iter().map(|f| suite.sources().describe(f)).collect();
    for (id, case) in suite.cases() {
        let findings = run(&suite, id);
        text += if findings.is_empty() { "pass " } else { "FAIL " };
        text += &case.name;
        text.push('\n');
        text.extend(findings.iter().map(|f| suite.sources().describe(f)));
    }
    said.assert_eq(&text);
}

#[test]
fn an_empty_file_expects_what_the_folders_say() {
    check(
        "",
        &[
            ("plans/valid/two.plan", "(boil) (pour a) (pour b)"),
            ("plans/valid/forgot.plan", "(boil)\n(pour a)"),
            ("plans/invalid/cold.plan", "(pour a)"),
            ("plans/invalid/right.plan", "(boil) (pour b) (pour a)"),
            ("plans/invalid/odd.plan", "(boil)\n(brew a)"),
            ("plans/somewhere.plan", "(boil)"),
        ],
        &expect![[r#"
            tea/plans/somewhere.plan:1:1: warning[T0201]: nothing is expected of this plan
              help: move it to `plans/valid` or `plans/invalid`
            pass tea/domain.pddl::check
            pass tea/two.pddl::check
            pass tea/plans/invalid/cold.plan::invalid
            FAIL tea/plans/invalid/odd.plan::invalid
            tea/plans/invalid/odd.plan:2:2: error[T0302]: expected invalid, found a text that is no plan (E0206 at line 2)
              tea/plans/invalid/odd.plan:2:2: unknown action `brew`
              help: if a plan that cannot be read is meant, write `why = "unknown-action"`
            FAIL tea/plans/invalid/right.plan::invalid
            tea/plans/invalid/right.plan:1:1: error[T0302]: expected invalid, found valid (cost 3)
            FAIL tea/plans/valid/forgot.plan::valid
            tea/two.pddl:2:31: error[T0302]: expected valid, found invalid (goal, missing (full b))
              tea/two.pddl:2:31: the goal does not hold after the last of 2 steps
              tea/two.pddl:2:52: (full b) does not hold; it never did
            pass tea/plans/valid/two.plan::valid
        "#]],
    );
}

#[test]
fn each_reason_is_held_against_what_is_so() {
    check(
        r#"
        [plan]
        right = { why = "precondition", step = 3, missing = ["(not (full a))", "( CLEAN a )"] }
        kind = { why = "goal" }
        step = { step = 2 }
        lacks = { missing = "(hot)" }
        goal = { why = "goal", missing = "(full b)" }
        text = { why = "unknown-action", line = 2 }
        code = { why = "E0204" }
        line = { why = "arity", line = 1 }
        cheap = { cost = 2 }
        told = { says = ["cannot be taken", "step 2 (pour a) deleted it"] }
        untold = { says = "it never did" }
        "#,
        &[
            ("invalid/right.plan", "(boil)\n(pour a)\n(pour a)"),
            ("invalid/kind.plan", "(boil)\n(pour a)\n(pour a)"),
            ("invalid/step.plan", "(boil)\n(pour a)\n(pour a)"),
            ("invalid/lacks.plan", "(boil)\n(pour a)\n(pour a)"),
            ("invalid/goal.plan", "(boil)\n(pour a)"),
            ("invalid/text.plan", "(boil)\n(brew a)"),
            ("invalid/code.plan", "(pour z)"),
            ("invalid/line.plan", "(boil)\n(pour)"),
            ("invalid/told.plan", "(boil)\n(pour a)\n(pour a)"),
            ("invalid/untold.plan", "(boil)\n(pour a)\n(pour a)"),
            ("valid/cheap.plan", "(boil)\n(pour a)\n(pour b)"),
        ],
        &expect![[r#"
            pass tea/domain.pddl::check
            pass tea/two.pddl::check
            pass tea/invalid/code.plan::invalid
            pass tea/invalid/goal.plan::invalid
            FAIL tea/invalid/kind.plan::invalid
            tea/invalid/kind.plan:3:1: error[T0302]: expected invalid (goal), found invalid (precondition, step 3, missing (clean a), missing (not (full a)))
              tea/invalid/kind.plan:3:1: step 3 (pour a) cannot be taken: its precondition does not hold
              tea/domain.pddl:8:30: (clean a) does not hold; step 2 (pour a) deleted it
              tea/invalid/kind.plan:2:1: this deletes (clean a)
              tea/domain.pddl:8:46: (full a) should not hold; step 2 (pour a) added it
              tea/invalid/kind.plan:2:1: this adds (full a)
              tea/expected.toml:4:24: expected here
            FAIL tea/invalid/lacks.plan::invalid
            tea/invalid/lacks.plan:3:1: error[T0302]: expected invalid (missing (hot)), found invalid (precondition, step 3, missing (clean a), missing (not (full a)))
              tea/invalid/lacks.plan:3:1: step 3 (pour a) cannot be taken: its precondition does not hold
              tea/domain.pddl:8:30: (clean a) does not hold; step 2 (pour a) deleted it
              tea/invalid/lacks.plan:2:1: this deletes (clean a)
              tea/domain.pddl:8:46: (full a) should not hold; step 2 (pour a) added it
              tea/invalid/lacks.plan:2:1: this adds (full a)
              tea/expected.toml:6:29: expected here
            FAIL tea/invalid/line.plan::invalid
            tea/invalid/line.plan:2:1: error[T0302]: expected invalid (arity, line 1), found a text that is no plan (E0301 at line 2)
              tea/invalid/line.plan:2:1: action `pour` takes 1 argument, 0 given
              tea/expected.toml:10:40: expected here
            pass tea/invalid/right.plan::invalid
            FAIL tea/invalid/step.plan::invalid
            tea/invalid/step.plan:3:1: error[T0302]: expected invalid (step 2), found invalid (precondition, step 3, missing (clean a), missing (not (full a)))
              tea/invalid/step.plan:3:1: step 3 (pour a) cannot be taken: its precondition does not hold
              tea/domain.pddl:8:30: (clean a) does not hold; step 2 (pour a) deleted it
              tea/invalid/step.plan:2:1: this deletes (clean a)
              tea/domain.pddl:8:46: (full a) should not hold; step 2 (pour a) added it
              tea/invalid/step.plan:2:1: this adds (full a)
              tea/expected.toml:5:25: expected here
            pass tea/invalid/text.plan::invalid
            pass tea/invalid/told.plan::invalid
            FAIL tea/invalid/untold.plan::invalid
            tea/invalid/untold.plan:3:1: error[T0302]: expected invalid (saying `it never did`), found invalid (precondition, step 3, missing (clean a), missing (not (full a)))
              tea/invalid/untold.plan:3:1: step 3 (pour a) cannot be taken: its precondition does not hold
              tea/domain.pddl:8:30: (clean a) does not hold; step 2 (pour a) deleted it
              tea/invalid/untold.plan:2:1: this deletes (clean a)
              tea/domain.pddl:8:46: (full a) should not hold; step 2 (pour a) added it
              tea/invalid/untold.plan:2:1: this adds (full a)
              tea/expected.toml:13:27: expected here
            FAIL tea/valid/cheap.plan::valid
            tea/valid/cheap.plan:1:1: error[T0302]: expected valid (cost 2), found valid (cost 3)
              tea/expected.toml:11:26: expected here
        "#]],
    );
}

#[test]
fn the_planner_is_asked() {
    let more = [("none.pddl", EMPTY)];
    check(
        "problem.two.optimal-cost = 3\nproblem.none.solvable = false",
        &more,
        &expect![[r#"
        pass tea/domain.pddl::check
        pass tea/none.pddl::check
        pass tea/two.pddl::check
        pass tea/none.pddl::unsolvable
        pass tea/two.pddl::solvable
    "#]],
    );
    check(
        "problem.two.solvable = false\nproblem.none.solvable = true",
        &more,
        &expect![[r#"
        pass tea/domain.pddl::check
        pass tea/none.pddl::check
        pass tea/two.pddl::check
        FAIL tea/none.pddl::solvable
        tea/none.pddl:2:11: error[T0303]: expected a plan, found that there is none
          tea/expected.toml:2:14: expected here
        FAIL tea/two.pddl::unsolvable
        tea/two.pddl:2:31: error[T0303]: expected no plan, found one that costs 3: (boil) (pour a) (pour b)
          tea/expected.toml:1:13: expected here
    "#]],
    );
    check(
        "[problem.two]\noptimal-cost = 4\ncost-at-most = 2.5\nsteps-at-most = 2",
        &[],
        &expect![[r#"
        pass tea/domain.pddl::check
        pass tea/two.pddl::check
        FAIL tea/two.pddl::solvable
        tea/two.pddl:2:31: error[T0303]: expected a cheapest plan of cost 4, found 3
          tea/expected.toml:2:16: expected here
        tea/two.pddl:2:31: error[T0303]: expected a cheapest plan of cost at most 2.5, found 3
          tea/expected.toml:3:16: expected here
        tea/two.pddl:2:31: error[T0303]: expected a plan of at most 2 steps, found 3 at least
          tea/expected.toml:4:17: expected here
    "#]],
    );
    check(
        "[problem.two]\nsolvable = true\ntimeout = 0",
        &[],
        &expect![[r#"
            pass tea/domain.pddl::check
            pass tea/two.pddl::check
            FAIL tea/two.pddl::solvable
            tea/two.pddl:2:31: error[T0304]: no answer: grounding was interrupted in `two`
              tea/expected.toml:2:1: expected here
              help: `timeout` allows for 0 s
        "#]],
    );
}

#[test]
fn diagnostics_are_these_and_no_others() {
    let more = [(
        "bad.pddl",
        "(define (problem bad) (:domain tea) (:objects a - cup)\n(:init (claen a) (full z))\n(:goal (fulll a)))",
    )];
    check(
        "",
        &more,
        &expect![[r#"
        pass tea/domain.pddl::check
        FAIL tea/bad.pddl::check
        tea/bad.pddl:2:9: error[E0202]: unknown predicate `claen`
          help: did you mean `clean`?
        tea/bad.pddl:2:24: error[E0204]: unknown object `z`
        tea/bad.pddl:3:9: error[E0202]: unknown predicate `fulll`
          help: did you mean `full`?
        pass tea/two.pddl::check
    "#]],
    );
    check(
        "[diagnostics]\nbad = ['E0202 at 2', 'E0204', 'E0202 at 3']",
        &more,
        &expect![[r#"
        pass tea/domain.pddl::check
        pass tea/bad.pddl::diagnostics
        pass tea/two.pddl::check
    "#]],
    );
    check(
        "[diagnostics]\nbad = ['E0202 at 3', 'E0202 at 4', 'E0301']",
        &more,
        &expect![[r#"
        pass tea/domain.pddl::check
        FAIL tea/bad.pddl::diagnostics
        tea/expected.toml:2:22: error[T0301]: E0202 is expected at line 4 of tea/bad.pddl, and is not there
          tea/bad.pddl:2:9: E0202 is here
        tea/expected.toml:2:36: error[T0301]: E0301 is expected of tea/bad.pddl, and is not there
        tea/bad.pddl:2:9: error[E0202]: unknown predicate `claen`
          tea/expected.toml:2:1: this does not expect it
          help: did you mean `clean`?
        tea/bad.pddl:2:24: error[E0204]: unknown object `z`
          tea/expected.toml:2:1: this does not expect it
        pass tea/two.pddl::check
    "#]],
    );
}

#[test]
fn warnings_may_be_denied() {
    let more = [(
        "w.pddl",
        "(define (problem w) (:domain tea) (:objects a - cup) (:init (clean a)) (:goal (clean a))) more",
    )];
    check(
        "",
        &more,
        &expect![[r#"
        pass tea/domain.pddl::check
        pass tea/two.pddl::check
        pass tea/w.pddl::check
    "#]],
    );
    check(
        "warnings = 'deny'",
        &more,
        &expect![[r#"
            pass tea/domain.pddl::check
            pass tea/two.pddl::check
            FAIL tea/w.pddl::check
            tea/w.pddl:1:91: warning[W0110]: this text follows the end and is not read
        "#]],
    );
}

#[test]
fn every_mistake_in_the_file_is_said_at_its_place() {
    check(
        r#"
        warnings = "dney"
        timeout = -1
        tiemout = 3
        [problem.tow]
        solvable = true
        [problem.two]
        solvable = false
        optimal-cost = 3
        [plan.late]
        why = "precondtion"
        [plan."valid/late"]
        step = 1
        [plan.fine]
        cost = "four"
        [diagnostics]
        domain = ["E02 at x"]
        "two.pddl" = "E0202"
        "#,
        &[("valid/late.plan", ""), ("invalid/late.plan", ""), ("fine.plan", "")],
        &expect![[r#"
            tea/expected.toml:2:20: error[T0104]: `dney` is not a word for warnings
              help: did you mean `deny`?
            tea/expected.toml:3:19: error[E0705]: `timeout` should be a number of seconds, not negative
            tea/expected.toml:4:9: error[E0702]: unknown key `tiemout`
              help: did you mean `timeout`?
            tea/expected.toml:5:18: error[T0101]: there is no problem `tow` in this suite
              help: did you mean `two`?
            tea/expected.toml:9:24: error[T0103]: a problem that has no plan has no cheapest or shortest one
            tea/expected.toml:10:15: error[T0102]: `late` may be `invalid/late.plan` or `valid/late.plan`
            tea/expected.toml:11:15: error[T0104]: `precondtion` is not a fault of a plan
              help: did you mean `precondition`?
            tea/expected.toml:13:16: error[T0103]: a plan that is valid has no `step`
            tea/expected.toml:14:15: error[T0103]: this entry does not say whether the plan is valid
              help: write `verdict = "valid"`
            tea/expected.toml:15:16: error[E0703]: `plan.fine.cost` is a string, and should be a number
            tea/expected.toml:17:19: error[T0104]: `E02 at x` is no diagnostic
              help: write `E0202 at 12`, a code and a line, or the code alone
            tea/expected.toml:18:22: error[E0703]: `diagnostics.two.pddl` is a string, and should be a list of strings
        "#]],
    );
    check(
        "[plan",
        &[],
        &expect![[r#"
        tea/expected.toml:1:6: error[E0701]: this is not TOML: unclosed table, expected `]`
    "#]],
    );
    check(
        "[problem.two]\n[plan.x]\nproblem = 'two'",
        &[("x.plan", "")],
        &expect![[r#"
        tea/expected.toml:1:10: error[T0103]: this entry expects nothing
          help: write `solvable = true`, or a bound on the plan's cost
        tea/expected.toml:2:7: error[T0103]: this entry does not say whether the plan is valid
          help: write `verdict = "valid"`
    "#]],
    );
}

#[test]
fn a_plan_belongs_to_a_problem() {
    let more = [
        ("none.pddl", EMPTY),
        ("valid/a.plan", "(boil)(pour a)(pour b)"),
        ("valid/two-b.plan", "(boil)(pour a)(pour b)"),
    ];
    check(
        "",
        &more,
        &expect![[r#"
        tea/valid/a.plan:1:1: error[T0106]: no problem of this suite has a name with which this plan's name begins
          help: name it like its problem, or write `[plan.a] problem = "…"`
    "#]],
    );
    check(
        "plan.a.problem = 'two'",
        &more,
        &expect![[r#"
        pass tea/domain.pddl::check
        pass tea/none.pddl::check
        pass tea/two.pddl::check
        pass tea/valid/a.plan::valid
        pass tea/valid/two-b.plan::valid
    "#]],
    );
}

#[test]
fn a_suite_passes_with_its_draft() {
    let more = [
        ("none.pddl", EMPTY),
        ("plans/valid/two.plan", "(boil) (pour a) (pour b)"),
        ("plans/invalid/two-cold.plan", "(pour a)"),
        ("plans/invalid/two-odd.plan", "(boil)\n(brew a)"),
        ("plans/two-loose.plan", "(boil)"),
        ("plans/unknown.plan", "(boil)"),
    ];
    let text = draft(
        folder("not = 'looked at'", &more),
        Duration::from_secs(1),
        &|| Duration::ZERO,
        &Budget::default(),
    );
    expect![[r##"
        # What is expected of this folder: docs/testing.md.

        [diagnostics]
        none = ["W0855 at 2"]

        [problem.none]
        solvable = false

        [problem.two]
        optimal-cost = 3

        [plan.two-cold]
        why = "precondition"
        step = 1
        missing = "(hot)"

        [plan.two-odd]
        why = "unknown-action"
        line = 2

        [plan.two-loose]
        verdict = "invalid"
        why = "goal"
        missing = ["(full a)", "(full b)"]

        # plans/unknown.plan: which problem is it for? [plan.unknown] problem = "…"

        [plan."plans/valid/two"]
        cost = 3
    "##]]
    .assert_eq(&text);
    let suite = Suite::read(folder(&text, &more[..5]));
    assert!(suite.findings().is_empty(), "{:?}", suite.findings());
    for (id, case) in suite.cases() {
        assert!(run(&suite, id).is_empty(), "{}", case.name);
    }
}

#[test]
fn a_folder_without_a_domain_is_no_suite() {
    let folder = Folder {
        path: String::new(),
        expected: Source::new("expected.toml", ""),
        files: Vec::new(),
        elsewhere: Vec::new(),
    };
    let suite = Suite::read(folder);
    assert!(suite.has_errors());
    assert_eq!(suite.cases().count(), 0);
}
