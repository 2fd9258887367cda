//! Outlines, folds, selections, colours, lenses and layout.

mod support;

use expect_test::{Expect, expect};
use ide::{
    DocumentSymbol, SymbolShape, TokenRole, code_lenses, document_symbols, folding, format, format_range,
    selection, semantic_tokens, workspace_symbols,
};
use pddl::{Role, Span};
use support::{apply_to, fixture, one_line, project};

const HALL: &str = "//- domain.pddl
; A house
; at night.
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?l - lamp)
    (dark))
  (:functions (power ?l - lamp) - number)
  (:derived (dark) (forall (?l - lamp) (not (lit ?l))))
  (:action light
    :parameters (?l - lamp) ; which
    :effect (and (lit ?l) (increase (power ?l) 1.5)))
  (:task all :parameters ())
  (:method one :parameters (?l - lamp) :task (all)
    :subtasks (and (s1 (light ?l)) (s2 (all))) :ordering (< s1 s2)))
//- problem.pddl
(define (problem night) (:domain hall) (:objects a b - lamp) (:init) (:goal (lit a)))
//- problem.plan
(light a)
";

fn outline(symbols: &[DocumentSymbol], depth: usize, into: &mut String) {
    for s in symbols {
        let shape = match s.shape {
            SymbolShape::Section => "section".to_owned(),
            SymbolShape::Name(kind) => kind.to_string(),
        };
        let detail = s.detail.as_ref().map(|d| format!(" | {d}")).unwrap_or_default();
        *into += &format!("{}{shape} {}{detail}\n", "  ".repeat(depth), s.name);
        assert!(s.full.start <= s.name_span.start && s.name_span.end <= s.full.end);
        outline(&s.children, depth + 1, into);
    }
}

#[test]
fn outlines() {
    let (project, _) = project(HALL);
    let mut text = String::new();
    for id in project.ids() {
        outline(&document_symbols(&project, id), 0, &mut text);
    }
    expect![[r#"
        domain hall
          section :requirements
          section :types
            type lamp
          section :predicates
            predicate lit | (lit ?l - lamp)
            predicate dark | (dark)
          section :functions
            function power | (power ?l - lamp) - number
          section :derived | (dark)
          action light | (light ?l - lamp)
          task all | (all)
          method one | (one ?l - lamp)
        problem night
          section :domain
          section :objects
            object a | a - lamp
            object b | b - lamp
          section :init
          section :goal
        action (light a)
    "#]]
    .assert_eq(&text);
}

#[test]
fn symbols_of_all_files_are_found_by_their_letters() {
    let (project, _) = project(HALL);
    let found = |query: &str| -> String {
        let all = workspace_symbols(&project, query);
        all.iter().map(|s| format!("{} {} in {}\n", s.kind, s.name, s.container)).collect()
    };
    expect![[r#"
        predicate lit in hall
        action light in hall
    "#]]
    .assert_eq(&found("LT"));
    assert_eq!(found("").lines().count(), 11);
    assert_eq!(found("nosuch"), "");
}

#[test]
fn folds() {
    let (project, domain) = project(HALL);
    let folds = folding(&project, domain);
    let line = |f: &ide::Fold| {
        let at = |offset| project.source(domain).line_column(offset).line;
        format!("{:?} {}-{}\n", f.kind, at(f.span.start), at(f.span.end))
    };
    expect![[r#"
        Comment 1-2
        List 3-15
        List 6-7
        List 10-12
        List 14-15
    "#]]
    .assert_eq(&folds.iter().map(line).collect::<String>());
}

fn check_selection(text: &str, expected: &Expect) {
    let (project, position) = fixture(text);
    let all = selection(&project, position);
    let line = |s: &Span| format!("{}\n", one_line(project.source(position.source).slice(*s)));
    expected.assert_eq(&all.iter().map(line).collect::<String>());
}

#[test]
fn selections_grow() {
    check_selection(
        "(define (domain d) (:predicates (p ?$0x) (q)))",
        &expect![[r#"
        ?x
        p ?x
        (p ?x)
        :predicates (p ?x) (q)
        (:predicates (p ?x) (q))
        define (domain d) (:predicates (p ?x) (q))
        (define (domain d) (:predicates (p ?x) (q)))
    "#]],
    );
    check_selection(
        "(a (b$0 ; comment",
        &expect![[r#"
        b
        (b
        a (b
        (a (b
        (a (b ; comment
    "#]],
    );
    check_selection(
        "(a) $0 (b)",
        &expect![[r#"
        (a) (b)
    "#]],
    );
}

#[test]
fn every_word_has_a_colour() {
    let (project, domain) = project(HALL);
    let tokens = semantic_tokens(&project, domain, None);
    let text = project.source(domain);
    let line = |t: &ide::SemanticToken| {
        let role = match t.role {
            TokenRole::Name(kind, Role::Declaration) => format!("!{kind}"),
            TokenRole::Name(kind, Role::Use) => kind.to_string(),
            other => format!("{other:?}").to_lowercase(),
        };
        format!("{role} {}\n", text.slice(t.span))
    };
    let all: String = tokens.iter().map(line).collect();
    expect![[r#"
        comment ; A house
        comment ; at night.
        keyword define
        keyword domain
        !domain hall
        keyword :requirements
        requirement :typing
        keyword :types
        !type lamp
        keyword :predicates
        !predicate lit
        !variable ?l
        operator -
        type lamp
        !predicate dark
        keyword :functions
        !function power
        !variable ?l
        operator -
        type lamp
        operator -
        keyword number
        keyword :derived
        predicate dark
        keyword forall
        !variable ?l
        operator -
        type lamp
        keyword not
        predicate lit
        variable ?l
        keyword :action
        !action light
        keyword :parameters
        !variable ?l
        operator -
        type lamp
        comment ; which
        keyword :effect
        keyword and
        predicate lit
        variable ?l
        keyword increase
        function power
        variable ?l
        number 1.5
        keyword :task
        !task all
        keyword :parameters
        keyword :method
        !method one
        keyword :parameters
        !variable ?l
        operator -
        type lamp
        keyword :task
        task all
        keyword :subtasks
        keyword and
        !subtask s1
        action light
        variable ?l
        !subtask s2
        task all
        keyword :ordering
        operator <
        subtask s1
        subtask s2
    "#]]
    .assert_eq(&all);
    assert!(tokens.windows(2).all(|pair| pair[0].span.end <= pair[1].span.start));
    let some = semantic_tokens(&project, domain, Some(Span::new(30, 60)));
    assert!(some.len() > 2 && tokens.windows(some.len()).any(|w| w == some.as_slice()));
}

#[test]
fn lenses() {
    let (project, _) = project(HALL);
    let mut text = String::new();
    for id in project.ids() {
        for lens in code_lenses(&project, id) {
            text +=
                &format!("{} {} {:?}\n", project.path(id), project.source(id).slice(lens.span), lens.lens);
        }
    }
    expect![[r#"
        domain.pddl lit References { count: 3 }
        domain.pddl dark References { count: 1 }
        domain.pddl power References { count: 1 }
        domain.pddl light References { count: 2 }
        domain.pddl all References { count: 2 }
        problem.pddl night Plan { domain: SourceId(0) }
        problem.plan light Validate { domain: SourceId(0), problem: SourceId(1) }
    "#]]
    .assert_eq(&text);
}

#[test]
fn layout_changes_white_space_only_where_it_must() {
    let text = "(define (domain d)\n  (:predicates (p)   (q)) ; all  \n (:action a :effect (p) ))\n\n\n";
    let (project, domain) = project(text);
    let edits = format(&project, domain).expect("parentheses match");
    assert_eq!(Ok(apply_to(text, &edits)), pddl::format(project.source(domain)).map_err(drop));
    assert!(edits.iter().all(|e| e.span.end - e.span.start < 8), "{edits:?}");
    let at = |s: &str| u32::try_from(text.find(s).expect("it is there")).expect("short");
    let range = Span::new(at("(q)"), at("(q)"));
    let some = format_range(&project, domain, range).expect("parentheses match");
    expect![[r#"
        (define (domain d)
          (:predicates (p) (q)) ; all
          (:action a :effect (p) ))


    "#]]
    .assert_eq(&apply_to(text, &some));
    let (broken, domain) = support::project("(define (domain d)");
    assert_eq!(format(&broken, domain), None);
}

#[test]
fn broken_files_are_no_trouble() {
    let whole: String = HALL.lines().filter(|l| !l.starts_with("//-")).map(|l| format!("{l}\n")).collect();
    for end in (0..whole.len()).step_by(7) {
        let (mut project, _) = fixture("//- domain.pddl\n$0");
        let id = project.set("domain.pddl", &whole[..end]);
        document_symbols(&project, id);
        folding(&project, id);
        semantic_tokens(&project, id, None);
        code_lenses(&project, id);
        format(&project, id);
        for offset in [0, end / 2, end] {
            let position = ide::Position { source: id, offset: u32::try_from(offset).expect("short") };
            ide::hover(&project, position);
            ide::definition(&project, position);
            assert!(ide::rename(&project, position, "x").is_err() || end > 0);
            selection(&project, position);
            ide::completions(&project, position);
            ide::signature_help(&project, position);
        }
        ide::code_actions(&project, id, Span::new(0, u32::try_from(end).expect("short")));
    }
}
