//! Completions and signatures.

mod support;

use expect_test::{Expect, expect};
use ide::{CompletionKind, completions, signature_help};
use support::fixture;

const HALL: &str = "//- domain.pddl
(define (domain hall)
  (:requirements :typing)
  (:types place lamp table - object desk - table)
  (:constants kitchen - place)
  (:predicates (lit ?l - lamp) (at ?l - lamp ?p - place) (on ?l - lamp ?t - table) (dark))
  (:functions (power ?l - lamp) - number (where ?l - lamp) - place)
  (:derived (dark) (forall (?l - lamp) (not (lit ?l))))
  ; Makes light.
  (:action light :parameters (?l - lamp ?p - place ?x)
    :precondition (and (at ?l ?p) CONDITION)
    :effect (and (lit ?l) EFFECT))
  (:durative-action wait :parameters (?l - lamp) :duration (= ?duration DURATION)
    :condition (and (at start (lit ?l)) TIMED) :effect (and (at end (not (lit ?l)))))
  (:task clean :parameters (?t - table))
  (:method all :parameters (?d - desk ?l - lamp) :task (clean ?d) :subtasks (and (first (clean ?d)) (second (clean ?d)) SUBTASK)
    :ordering (and ORDERING))
  SECTION)
//- problem.pddl
(define (problem night) (:domain DOMAIN) (:objects a - lamp d - desk e - OTHER)
  (:init (at a kitchen) INIT) (:goal (and GOAL)) (:metric METRIC (power a)))
//- problem.plan
(light a kitchen d)
PLAN
";

/// The fixture with a text in place of a word; the words that are not used are left out.
fn with(word: &str, text: &str) -> String {
    let words = [
        "CONDITION",
        "EFFECT",
        "DURATION",
        "TIMED",
        "SUBTASK",
        "ORDERING",
        "SECTION",
        "DOMAIN",
        "OTHER",
        "INIT",
        "GOAL",
        "METRIC",
        "PLAN",
    ];
    words.iter().fold(HALL.to_owned(), |all, w| {
        all.replace(
            w,
            match *w {
                w if w == word => text,
                "DOMAIN" => "hall",
                "OTHER" => "object",
                "DURATION" => "1",
                "METRIC" => "minimize",
                _ => "",
            },
        )
    })
}

/// Labels by kind; what is put in where it differs from the label.
fn shown(text: &str) -> String {
    let (project, position) = fixture(text);
    let mut lines: Vec<String> = Vec::new();
    let mut last = String::new();
    for c in completions(&project, position) {
        let kind = match c.kind {
            CompletionKind::Keyword => "word".to_owned(),
            CompletionKind::Snippet => "snippet".to_owned(),
            CompletionKind::Name(kind) => kind.to_string(),
        };
        assert!(c.span.start <= position.offset && position.offset <= c.span.end);
        if kind != last {
            lines.push(format!("{kind}:"));
            last = kind;
        }
        let line = lines.last_mut().expect("there is one");
        *line += &format!(" {}", c.label);
    }
    lines.into_iter().map(|line| line + "\n").collect()
}

fn check(word: &str, text: &str, expected: &Expect) {
    expected.assert_eq(&shown(&with(word, text)));
}

#[test]
fn definitions_and_sections() {
    expect![[r#"
        snippet: domain problem
    "#]]
    .assert_eq(&shown("$0"));
    expect![[r#"
        snippet: domain problem
    "#]]
    .assert_eq(&shown("//- hall.pddl\n(de$0"));
    check(
        "SECTION",
        "(:$0",
        &expect![[r#"
            snippet: :action :constants :constraints :derived :durative-action :event :functions :import :invariant :method :predicates :process :requirements :task :types :writes
        "#]],
    );
    check(
        "SECTION",
        "$0",
        &expect![[r#"
            snippet: :action :constants :constraints :derived :durative-action :event :functions :import :invariant :method :predicates :process :requirements :task :types :writes
        "#]],
    );
    check(
        "SECTION",
        "(:action go $0",
        &expect![[r#"
        snippet: :effect :parameters :precondition
    "#]],
    );
    check(
        "SECTION",
        "(:action go :parameters () :eff$0)",
        &expect![[r#"
        snippet: :effect :precondition
    "#]],
    );
    check(
        "SECTION",
        "(:requirements :ty$0)",
        &expect![[r#"
            word: :action-costs :adl :agent-rules :conditional-effects :constraints :continuous-effects :derived-predicates :disjunctive-preconditions :duration-inequalities :durative-actions :equality :existential-preconditions :factored-privacy :fluents :goal-utilities :hierarchy :invariants :method-preconditions :multi-agent :negative-preconditions :numeric-fluents :object-fluents :preferences :quantified-preconditions :strips :time :timed-initial-fluents :timed-initial-literals :typing :unfactored-privacy :universal-preconditions :vocabulary
        "#]],
    );
    check(
        "METRIC",
        "m$0",
        &expect![[r#"
        word: maximize minimize
    "#]],
    );
    check(
        "DOMAIN",
        "h$0",
        &expect![[r#"
        domain: hall
    "#]],
    );
}

#[test]
fn types() {
    check(
        "OTHER",
        "$0",
        &expect![[r#"
        type: desk lamp object place table
        snippet: either
    "#]],
    );
    check(
        "SECTION",
        "(:action go :parameters (?x - $0",
        &expect![[r#"
        type: desk lamp object place table
        snippet: either
    "#]],
    );
    check(
        "SECTION",
        "(:action go :parameters (?x - (either $0",
        &expect![[r#"
        type: desk lamp object place table
    "#]],
    );
    check("SECTION", "(:action go :parameters (?x $0", &expect![[""]]);
    check(
        "SECTION",
        "(:functions (f ?x - $0",
        &expect![[r#"
        type: desk lamp object place table
        snippet: either
    "#]],
    );
    check(
        "SECTION",
        "(:functions (f ?x) - $0",
        &expect![[r#"
        type: desk lamp object place table
        snippet: either
        word: number
    "#]],
    );
    check(
        "CONDITION",
        "(forall (?y - $0",
        &expect![[r#"
        type: desk lamp object place table
        snippet: either
    "#]],
    );
}

#[test]
fn conditions() {
    check(
        "CONDITION",
        "($0",
        &expect![[r#"
        predicate: at dark lit on
        snippet: < <= = > >= and exists forall imply not or preference
    "#]],
    );
    check(
        "CONDITION",
        "(not (l$0))",
        &expect![[r#"
        predicate: at dark lit on
        snippet: < <= = > >= and exists forall imply not or preference
    "#]],
    );
    check(
        "CONDITION",
        "$0",
        &expect![[r#"
        predicate: at dark lit on
        snippet: < <= = > >= and exists forall imply not or preference
    "#]],
    );
    check(
        "CONDITION",
        "(> (power ?l) ($0",
        &expect![[r#"
            function: power
            snippet: * + - /
        "#]],
    );
    check(
        "TIMED",
        "($0",
        &expect![[r#"
        snippet: and at end at start forall over all preference
    "#]],
    );
    check(
        "TIMED",
        "(at $0",
        &expect![[r#"
        word: all end start
    "#]],
    );
    check(
        "TIMED",
        "(at end ($0",
        &expect![[r#"
        predicate: at dark lit on
        snippet: < <= = > >= and exists forall imply not or preference
    "#]],
    );
    check(
        "GOAL",
        "(on $0",
        &expect![[r#"
        object: a
    "#]],
    );
}

#[test]
fn arguments_fit_their_types() {
    check(
        "CONDITION",
        "(at $0",
        &expect![[r#"
        variable: ?l ?x
    "#]],
    );
    check(
        "CONDITION",
        "(at ?l $0",
        &expect![[r#"
        variable: ?p ?x
        object: kitchen
    "#]],
    );
    check("CONDITION", "(at ?l ?p $0", &expect![[""]]);
    check(
        "CONDITION",
        "(exists (?t - desk) (on ?l $0",
        &expect![[r#"
        variable: ?t ?x
    "#]],
    );
    check(
        "CONDITION",
        "(= $0",
        &expect![[r#"
        variable: ?l ?p ?x
        object: kitchen
        function: power where
    "#]],
    );
    check(
        "INIT",
        "(on a $0)",
        &expect![[r#"
        object: d
    "#]],
    );
    check(
        "INIT",
        "($0)",
        &expect![[r#"
        predicate: at dark lit on
        snippet: = at
    "#]],
    );
    check(
        "INIT",
        "(= ($0",
        &expect![[r#"
            function: power
            snippet: * + - /
        "#]],
    );
}

#[test]
fn effects() {
    check(
        "EFFECT",
        "($0",
        &expect![[r#"
        predicate: at lit on
        snippet: and assign decrease forall increase not scale-down scale-up when
    "#]],
    );
    check(
        "EFFECT",
        "(increase ($0",
        &expect![[r#"
            function: power
            snippet: * + - /
        "#]],
    );
    check(
        "EFFECT",
        "(when ($0",
        &expect![[r#"
        predicate: at dark lit on
        snippet: < <= = > >= and exists forall imply not or preference
    "#]],
    );
}

#[test]
fn plans_and_networks() {
    check(
        "PLAN",
        "($0",
        &expect![[r#"
        action: light wait
    "#]],
    );
    check(
        "PLAN",
        "(light $0",
        &expect![[r#"
        object: a
    "#]],
    );
    check(
        "PLAN",
        "(light a $0",
        &expect![[r#"
        object: kitchen
    "#]],
    );
    check(
        "SUBTASK",
        "($0",
        &expect![[r#"
        task: clean
        action: light wait
        snippet: and
    "#]],
    );
    check(
        "SUBTASK",
        "(third (clean $0",
        &expect![[r#"
        variable: ?d
    "#]],
    );
    check(
        "ORDERING",
        "(< $0",
        &expect![[r#"
        subtask: first second
    "#]],
    );
}

#[test]
fn nothing_where_only_the_author_knows() {
    for (word, text) in [
        ("SECTION", "(:action $0"),
        ("SECTION", "(:predicates (p $0"),
        ("SECTION", "(:types $0"),
        ("CONDITION", "; in a comment $0\n"),
        ("CONDITION", "(forall ($0"),
    ] {
        assert_eq!(shown(&with(word, text)), "", "{text}");
    }
}

/// What is put in for a label, as a snippet if it is one.
fn check_inserted(word: &str, text: &str, label: &str, expected: &Expect) {
    let (project, position) = fixture(&with(word, text));
    let all = completions(&project, position);
    let found = all.iter().find(|c| c.label == label).expect("it is offered");
    let old = project.source(position.source).slice(found.span);
    expected.assert_eq(&format!("{old} → {}", found.snippet.as_ref().unwrap_or(&found.text)));
}

#[test]
fn what_is_put_in() {
    check_inserted("CONDITION", "(a$0", "at", &expect!["a → at ${1:?l} ${2:?p}"]);
    check_inserted("CONDITION", "(a$0\n", "at", &expect!["a → at ${1:?l} ${2:?p})"]);
    check_inserted("CONDITION", "(a$0)", "at", &expect!["a → at ${1:?l} ${2:?p}"]);
    check_inserted("CONDITION", "(a$0 ?l)", "at", &expect!["a → at"]);
    check_inserted("CONDITION", "$0", "at", &expect![" → (at ${1:?l} ${2:?p})"]);
    check_inserted("CONDITION", "$0", "dark", &expect![" → (dark)"]);
    check_inserted("CONDITION", "(an$0\n", "and", &expect!["an → and $0)"]);
    check_inserted("CONDITION", "(an$0)", "and", &expect!["an → and $0"]);
    check_inserted("CONDITION", "(an$0 (dark))", "and", &expect!["an → and"]);
    check_inserted(
        "SECTION",
        "(:act$0)",
        ":action",
        &expect![[r#"
        :act → :action ${1:name}
          :parameters (${2:?x - object})
          :precondition (and $3)
          :effect (and $0)"#]],
    );
    check_inserted(
        "SECTION",
        ":act$0\n",
        ":action",
        &expect![[r#"
        :act → (:action ${1:name}
          :parameters (${2:?x - object})
          :precondition (and $3)
          :effect (and $0))"#]],
    );
    check_inserted("SECTION", "(:action go :eff$0)", ":effect", &expect![":eff → :effect (and $0)"]);
    check_inserted("OTHER", "$0", "either", &expect![" → (either $0)"]);
}

fn check_signature(word: &str, text: &str, expected: &Expect) {
    let (project, position) = fixture(&with(word, text));
    let help = signature_help(&project, position);
    expected.assert_eq(&help.map_or_else(String::new, |help| {
        let active = help.active.map(|i| help.label[help.parameters[i].clone()].to_owned());
        format!("{} | {active:?} | {:?}", help.label, help.documentation)
    }));
}

#[test]
fn signatures() {
    check_signature(
        "CONDITION",
        "(at $0",
        &expect![[r#"(at ?l - lamp ?p - place) | Some("?l - lamp") | None"#]],
    );
    check_signature(
        "CONDITION",
        "(at ?l ?$0)",
        &expect![[r#"(at ?l - lamp ?p - place) | Some("?p - place") | None"#]],
    );
    check_signature("CONDITION", "(at ?l ?p $0)", &expect!["(at ?l - lamp ?p - place) | None | None"]);
    check_signature("CONDITION", "(a$0", &expect![[""]]);
    check_signature(
        "EFFECT",
        "(increase (power $0",
        &expect![[r#"(power ?l - lamp) | Some("?l - lamp") | None"#]],
    );
    check_signature(
        "PLAN",
        "(light a $0",
        &expect![[r#"(light ?l - lamp ?p - place ?x - object) | Some("?p - place") | Some("Makes light.")"#]],
    );
    check_signature(
        "SUBTASK",
        "(third (clean $0",
        &expect![[r#"(clean ?t - table) | Some("?t - table") | None"#]],
    );
    check_signature("SECTION", "(:predicates (at $0", &expect![[""]]);
}
