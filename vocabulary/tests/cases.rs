//! Case files: a vocabulary, problems of its initial graph, and rules that are tried on the graph.

#[path = "support/case_file.rs"]
mod case_file;

use std::fmt::Write as _;

use case_file::{diagnostics, place, sources};
use dsr::{AttributeId, Edit, HolderRef, LabelId, NewValue, NodeRef, Snapshot, Time};
use pddl::model::{Domain, Idx, Problem, VariableId, Variables};
use pddl::{Source, parse_domain, parse_problem};
use vocabulary::{Binding, Tokens, is_redundant};

#[test]
fn cases() {
    case_file::run("tests/cases", |text| case(text).unwrap_or_else(|errors| errors));
}

/// The result of a case; `Err` at the first step that fails.
fn case(text: &str) -> Result<String, String> {
    let sources = sources(text);
    let (_, source) = &sources[0];
    let words = parse_domain(source, &[]);
    let words = words.model.ok_or_else(|| diagnostics(source, &words.diagnostics))?;
    let tokens = Tokens::new(&words)
        .map_err(|errors| errors.iter().map(|error| place(source, error.span, error)).collect::<String>())?;

    let mut problems: Vec<(&Source, Problem)> = Vec::new();
    for (_, source) in sources.iter().filter(|(name, _)| name == "problem") {
        let parsed = parse_problem(source, &words);
        problems.push((source, parsed.model.ok_or_else(|| diagnostics(source, &parsed.diagnostics))?));
    }
    let given: Vec<&Problem> = problems.iter().map(|(_, problem)| problem).collect();
    let graph = tokens.populate(&given, Time(0)).map_err(|errors| {
        errors.iter().map(|error| place(problems[error.problem].0, error.span, error)).collect::<String>()
    })?;
    let snapshot = graph.snapshot();
    let mut out = String::new();
    for sentence in snapshot.sentences() {
        let _ = writeln!(out, "{sentence}");
    }
    for (_, source) in sources.iter().filter(|(name, _)| name == "rules") {
        let parsed = parse_domain(source, &[&words]);
        let rules = parsed.model.ok_or_else(|| diagnostics(source, &parsed.diagnostics))?;
        out.push_str(&tried(source, &tokens, &rules, &snapshot));
    }
    Ok(out)
}

/// Every action of `rules`: its bindings, the edits of each, and what of their result cannot be seen yet.
fn tried(source: &Source, tokens: &Tokens, rules: &Domain, snapshot: &Snapshot) -> String {
    let link = tokens.link(rules);
    let mut out = String::new();
    for action in &rules.actions {
        let _ = writeln!(out, "{}:", action.name);
        let condition = link.condition(&action.variables, [&action.precondition]);
        let effect = link.effect(&action.variables, [&action.effect]);
        let expectation = link.expectation(&action.variables, [&action.effect]);
        let errors = condition.as_ref().err().into_iter().chain(effect.as_ref().err());
        for error in errors.flatten() {
            let _ = write!(out, "  {}", place(source, error.span, error));
        }
        if let (Ok(_), Err(errors)) = (&effect, &expectation) {
            for error in errors {
                let _ = write!(out, "  to see: {}", place(source, error.span, error));
            }
        }
        let Ok(condition) = condition else { continue };
        let nothing = Binding::of(&action.variables);
        let bindings = condition.bindings(snapshot, &nothing);
        assert_eq!(condition.holds(snapshot, &nothing), !bindings.is_empty());
        match condition.why_not(snapshot, &nothing) {
            Some(unmet) => {
                let _ = write!(out, "  no: {}", place(source, unmet.span, &unmet));
            }
            None => assert!(!bindings.is_empty(), "explained what holds"),
        }
        for binding in &bindings {
            assert!(condition.holds(snapshot, binding));
            let _ = writeln!(out, "  {}", names(snapshot, &action.variables, binding));
            match effect.as_ref().map(|effect| effect.edits(snapshot, binding)) {
                Err(_) => {}
                Ok(Err(error)) => {
                    let _ = writeln!(out, "    cannot: {error}");
                }
                Ok(Ok(edits)) => {
                    for edit in &edits {
                        let already = if is_redundant(snapshot, edit) { " (already)" } else { "" };
                        if let Some(sentence) = written(snapshot, edit) {
                            let _ = writeln!(out, "    {sentence}{already}");
                        }
                    }
                }
            }
            if let Ok(expectation) = &expectation
                && let Some(unseen) = expectation.why_not(snapshot, binding)
            {
                let _ = writeln!(out, "    to be seen: {}", unseen.wanted);
            }
        }
    }
    out
}

fn names(snapshot: &Snapshot, variables: &Variables, binding: &Binding) -> String {
    let name = |id: VariableId| match binding.node(id) {
        Some(node) => format!("{}={}", variables[id].name, snapshot.name(node).unwrap_or("?")),
        None => format!("{}=_", variables[id].name),
    };
    (0..variables.parameters).map(|at| name(VariableId::from_index(at))).collect::<Vec<_>>().join(" ")
}

/// An edit as text; `None` for the edge that only carries an attribute.
fn written(snapshot: &Snapshot, edit: &Edit) -> Option<String> {
    let vocabulary = snapshot.vocabulary();
    let node = |node: &NodeRef| match node {
        NodeRef::Id(id) => snapshot.name(*id).unwrap_or("?").to_owned(),
        NodeRef::Name(name) => name.to_string(),
    };
    let label = |id: &LabelId| vocabulary.label_name(*id).map_or("?", |name| name).replace('_', " ");
    let carries =
        |id: &LabelId| vocabulary.label_name(*id).is_some_and(|name| vocabulary.attribute(name).is_some());
    let attribute = |holder: &HolderRef, id: AttributeId| {
        let name = vocabulary.attribute_name(id).map_or("?", |name| name);
        match holder {
            HolderRef::Node(on) => format!("{name} of {}", node(on)),
            HolderRef::Edge { from, to, .. } => format!("{name} of {} and {}", node(from), node(to)),
        }
    };
    Some(match edit {
        Edit::AddEdge { label: id, .. } if carries(id) => return None,
        Edit::RemoveEdge { from, label: id, to } if carries(id) => {
            format!("{} of {} and {} is not defined", label(id), node(from), node(to))
        }
        Edit::AddEdge { from, label: id, to } => format!("{} {} {}", node(from), label(id), node(to)),
        Edit::RemoveEdge { from, label: id, to } => format!("not: {} {} {}", node(from), label(id), node(to)),
        Edit::SetAttribute { holder, attribute: id, value } => {
            let value = match value {
                NewValue::Number(number) => number.to_string(),
                NewValue::Bool(truth) => truth.to_string(),
                NewValue::Node(target) => node(target),
                other => format!("{other:?}"),
            };
            format!("{} is {value}", attribute(holder, *id))
        }
        Edit::ClearAttribute { holder, attribute: id } => {
            format!("{} is not defined", attribute(holder, *id))
        }
        other => format!("{other:?}"),
    })
}
