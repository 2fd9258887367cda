//! Files that belong together, and what changes when one of them does.

use diagnostics::SourceId;
use expect_test::{Expect, expect};
use pddl::{NameKind, Role};
use project::{FileKind, Project, Reading};

const HALL: &str = "(define (domain hall) (:requirements :typing :negative-preconditions) (:types lamp) (:predicates (lit ?l - lamp))
  (:action light :parameters (?l - lamp) :precondition (not (lit ?l)) :effect (lit ?l)))";
const DARK: &str = "(define (problem dark) (:domain hall) (:objects l - lamp) (:init) (:goal (lit l)))";

fn project(files: &[(&str, &str)]) -> Project {
    let mut project = Project::new();
    for (path, text) in files {
        project.set(path, *text);
    }
    project
}

fn id(project: &Project, path: &str) -> SourceId {
    project.id(path).unwrap_or_else(|| panic!("{path} is in the project"))
}

/// `file → what it needs`.
fn check_links(files: &[(&str, &str)], expected: &Expect) {
    let project = project(files);
    let line = |id: SourceId| {
        let needs = project.needs(id).iter().map(|need| need.map_or("?", |need| project.path(need)));
        format!("{} → {}\n", project.path(id), needs.collect::<Vec<_>>().join(" "))
    };
    expected.assert_eq(&project.ids().map(line).collect::<String>());
}

fn said(project: &Project, path: &str) -> String {
    project.findings(id(project, path)).iter().map(|f| project.sources().describe(f)).collect()
}

#[test]
fn a_plan_is_known_by_its_name() {
    for plan in ["a.plan", "A.SOLN", "x/plan", "sas_plan", "x/sas_plan.12"] {
        assert!(FileKind::is_plan(plan) && FileKind::is_source(plan), "{plan}");
        assert!(!FileKind::is_definition(plan), "{plan}");
    }
    for other in ["plan.pddl", "plan.hddl", "a.txt", "plans", "my_plan", "plan/x"] {
        assert!(!FileKind::is_plan(other), "{other}");
    }
    assert!(FileKind::is_source("a.PDDL") && FileKind::is_source("b.hddl") && !FileKind::is_source("pddl"));
}

#[test]
fn the_nearest_domain_is_the_one() {
    let domain = "(define (domain d))";
    let problem = "(define (problem p) (:domain D))";
    check_links(
        &[
            ("x/domain.pddl", domain),
            ("a/other.pddl", domain),
            ("a/b/p1-domain.pddl", domain),
            ("a/b/p2-domain.pddl", domain),
            ("a/b/p2.pddl", problem),
            ("a/b/p3.pddl", problem),
            ("a/c/p.pddl", problem),
            ("./top.pddl", problem),
            ("far/p.pddl", "(define (problem p) (:domain nowhere))"),
            ("x/p.pddl", "(define (problem p))"),
        ],
        &expect![[r#"
            x/domain.pddl → 
            a/other.pddl → 
            a/b/p1-domain.pddl → 
            a/b/p2-domain.pddl → 
            a/b/p2.pddl → a/b/p2-domain.pddl
            a/b/p3.pddl → a/b/p1-domain.pddl
            a/c/p.pddl → a/other.pddl
            ./top.pddl → x/domain.pddl
            far/p.pddl → ?
            x/p.pddl → x/domain.pddl
        "#]],
    );
}

#[test]
fn a_plan_belongs_to_the_problem_of_its_stem_or_to_the_only_one() {
    let problem = "(define (problem p) (:domain D))";
    check_links(
        &[
            ("a/p1.pddl", problem),
            ("a/p10.pddl", problem),
            ("a/p1.plan", ""),
            ("a/p10-optimal.soln", ""),
            ("a/p10.pddl.plan", ""),
            ("a/p100.plan", ""),
            ("a/sas_plan", ""),
            ("b/only.hddl", problem),
            ("b/plan", ""),
            ("b/plans/first.plan", ""),
        ],
        &expect![[r#"
            a/p1.pddl → ?
            a/p10.pddl → ?
            a/p1.plan → a/p1.pddl
            a/p10-optimal.soln → a/p10.pddl
            a/p10.pddl.plan → a/p10.pddl
            a/p100.plan → ?
            a/sas_plan → ?
            b/only.hddl → ?
            b/plan → b/only.hddl
            b/plans/first.plan → b/only.hddl
        "#]],
    );
}

#[test]
fn imports_that_go_round_are_cut() {
    let a = "(define (domain a) (:import b))";
    let b = "(define (domain b) (:import c))";
    let c = "(define (domain c) (:import a c))";
    check_links(
        &[("a.pddl", a), ("b.pddl", b), ("c.pddl", c)],
        &expect![[r#"
        a.pddl → b.pddl
        b.pddl → c.pddl
        c.pddl → ? ?
    "#]],
    );
    let project = project(&[("a.pddl", a), ("b.pddl", b), ("c.pddl", c)]);
    expect![[r#"
        c.pddl:1:29: error[E0212]: unknown domain `a`
        c.pddl:1:31: error[E0212]: unknown domain `c`
    "#]]
    .assert_eq(&said(&project, "c.pddl"));
}

#[test]
fn a_long_chain_of_imports_is_no_deep_recursion() {
    let mut project = Project::new();
    let chain = (0..20_000).map(|i| {
        let text = format!("(define (domain d{i}) (:import d{}))", i + 1);
        pddl::Source::new(format!("d{i}.pddl"), text)
    });
    project.set_all(chain);
    assert!(project.findings(id(&project, "d0.pddl")).is_empty());
}

#[test]
fn errors_of_a_domain_and_its_problem_are_seen_at_once() {
    let project = project(&[
        ("d.pddl", &HALL.replace("(not (lit ?l))", "(dark ?l)")),
        ("p.pddl", &DARK.replace("(lit l)", "(and (lit l) (lit m))")),
    ]);
    expect![[r#"
        d.pddl:2:57: error[E0202]: unknown predicate `dark`
        p.pddl:1:92: error[E0204]: unknown object `m`
    "#]]
    .assert_eq(&(said(&project, "d.pddl") + &said(&project, "p.pddl")));
}

#[test]
fn a_problem_without_a_domain_says_only_that() {
    let project = project(&[("p.pddl", DARK), ("d.pddl", "(define (domain halls))")]);
    expect![[r#"
        p.pddl:1:33: error[E0212]: no file defines the domain `hall`
          help: did you mean `halls`?
    "#]]
    .assert_eq(&said(&project, "p.pddl"));
}

#[test]
fn a_change_is_seen_by_what_depends_on_it_and_by_nothing_else() {
    let mut project = project(&[
        ("base.pddl", "(define (domain base) (:types lamp))"),
        ("d.pddl", &HALL.replace("(:types lamp)", "(:import base)")),
        ("p.pddl", DARK),
        ("p.plan", "(light l)"),
        ("x/q.pddl", "(define (problem q) (:domain other))"),
    ]);
    let [d, p, plan, q] = ["d.pddl", "p.pddl", "p.plan", "x/q.pddl"].map(|path| id(&project, path));
    let address = |project: &Project, id| project.reading(id).map(std::ptr::from_ref::<Reading>);
    for file in [d, p, plan] {
        assert!(project.findings(file).is_empty(), "{:?}", project.findings(file));
    }
    let snapshot = project.clone();
    let before = [d, p, plan, q].map(|file| address(&project, file));

    project.set("p.pddl", DARK.replace("lit l", "lit lamp"));
    assert_eq!(project.language_findings(p).len(), 1);
    assert_eq!(address(&project, d), before[0]);
    assert_ne!(address(&project, plan), before[2]);
    assert_eq!(address(&project, q), before[3]);

    project.set("base.pddl", "(define (domain base) (:types lump))");
    assert!(!project.language_findings(d).is_empty());
    assert_eq!(address(&project, q), before[3]);
    assert!(snapshot.findings(p).is_empty(), "a clone stays as it was");

    project.set("base.pddl", "(define (domain base) (:types lamp))");
    project.set("p.pddl", DARK);
    assert!(project.findings(plan).is_empty());
    project.remove("p.pddl");
    assert!(project.id("p.pddl").is_none() && !project.contains(p));
    assert_eq!(project.needs(plan), [None]);
    assert_eq!(project.set("p.pddl", DARK), p, "a path keeps its id");
    assert_eq!(project.needs(plan), [Some(p)]);
}

#[test]
fn every_way_to_the_same_files_says_the_same() {
    let texts = [
        ("d.pddl", HALL),
        ("d.pddl", "(define (domain hall)"),
        ("p.pddl", DARK),
        ("p.pddl", "(define (problem dark) (:domain hell))"),
        ("p.plan", "(light l)"),
        ("e.pddl", "(define (domain hell))"),
    ];
    // Every order of three changes, then the same last state set up at once.
    for a in texts {
        for b in texts {
            for c in texts {
                let mut grown = Project::new();
                for (path, text) in [a, b, c] {
                    grown.set(path, text);
                    grown.ids().for_each(|id| drop(grown.findings(id)));
                }
                grown.remove(b.0);
                let fresh = project(
                    &grown.ids().map(|id| (grown.path(id), grown.source(id).text())).collect::<Vec<_>>(),
                );
                for id in grown.ids() {
                    let path = grown.path(id);
                    assert_eq!(said(&grown, path), said(&fresh, path), "{a:?} {b:?} {c:?}");
                }
            }
        }
    }
}

#[test]
fn lints_of_a_domain_look_at_its_problems() {
    let mut project = project(&[("d.pddl", HALL), ("p.pddl", DARK)]);
    let d = id(&project, "d.pddl");
    let unused = HALL.replace("(?l - lamp) :pre", "(?l ?m - lamp) :pre");
    project.set("d.pddl", unused);
    assert!(project.lint_findings(d).iter().any(|l| l.finding.message.contains("`?m`")));
    assert!(project.language_findings(d).is_empty());
    project.set("d.pddl", "(define (domain hall)");
    assert!(project.lint_findings(d).is_empty());
}

#[test]
fn names_are_kept_unless_they_are_not_wanted() {
    let files = [("d.pddl", HALL), ("p.pddl", DARK), ("p.plan", "(light l)")];
    let project = project(&files);
    let plan = project.reading(id(&project, "p.plan")).expect("the plan is read");
    let kinds: Vec<_> = plan.occurrences().iter().map(|o| (o.symbol.kind, o.role)).collect();
    assert_eq!(kinds, [(NameKind::Action, Role::Use), (NameKind::Object, Role::Use)]);
    let mut project = Project::without_names();
    let [d, p, plan] = files.map(|(path, text)| project.set(path, text));
    for id in [d, p, plan] {
        assert!(project.reading(id).is_some_and(|r| r.is_sound() && r.occurrences().is_empty()));
    }
}

#[test]
fn a_domain_of_another_name_beside_a_problem_is_meant_before_one_far_away() {
    let other = HALL.replace("domain hall", "domain room");
    let far = "(define (domain hall) (:predicates (far)))";
    let project = project(&[("b/p.pddl", DARK), ("b/d.pddl", &other), ("a/d.pddl", far)]);
    expect![[r#"
        b/p.pddl:1:33: warning[W0223]: this problem is for domain `hall`, but it is read with domain `room`
    "#]]
    .assert_eq(&said(&project, "b/p.pddl"));
}
