//! Case files: a vocabulary, a planner's domain, problems and perception, and the facts perceived, with reasons.

#[path = "../../vocabulary/tests/support/case_file.rs"]
mod case_file;

use std::fmt::Write as _;
use std::sync::Arc;

use case_file::{diagnostics, place, sources};
use dsr::Time;
use low_to_high::{Explanation, Fact, LowToHigh, Perception, Role};
use pddl::model::{Domain, Name};
use pddl::{Source, parse_domain, parse_problem};
use vocabulary::Tokens;

#[test]
fn cases() {
    case_file::run("tests/cases", |text| case(text).unwrap_or_else(|errors| errors));
}

fn domain(source: &Source, imports: &[&Domain]) -> Result<Domain, String> {
    let parsed = parse_domain(source, imports);
    parsed.model.ok_or_else(|| diagnostics(source, &parsed.diagnostics))
}

/// The result of a case; `Err` at the first step that fails. A line `;;; ask (fact)` asks why.
fn case(text: &str) -> Result<String, String> {
    let sources = sources(text);
    let find = |wanted: &'static str| {
        sources.iter().filter(move |(name, _)| name == wanted).map(|(_, source)| source)
    };
    let first = |wanted: &'static str| find(wanted).next().expect("every case has one");
    let words = domain(first("vocabulary"), &[])?;
    let planning = domain(first("planning"), &[])?;
    let source = first("perception");
    let perception = domain(source, &[&words, &planning])?;
    let mut problems = Vec::new();
    for source in find("problem") {
        let parsed = parse_problem(source, &words);
        problems.push(parsed.model.ok_or_else(|| diagnostics(source, &parsed.diagnostics))?);
    }
    let tokens = Tokens::new(&words).expect("tested in its own crate");
    let graph = tokens.populate(&problems.iter().collect::<Vec<_>>(), Time(0)).expect("tested there");
    let perception = Perception::new(&perception, &tokens)
        .map_err(|errors| errors.iter().map(|error| place(source, error.span, error)).collect::<String>())?;

    let mut out = String::new();
    let perception = Arc::new(perception);
    let snapshot = graph.snapshot();
    let seen = LowToHigh::new(Arc::clone(&perception), &snapshot);
    let auxiliary = |fact: &Fact| {
        perception.derived().any(|(name, role)| *name == fact.predicate && role == Role::Auxiliary)
    };
    for fact in seen.derived() {
        let _ = writeln!(out, "{fact}{}", if auxiliary(&fact) { " (auxiliary)" } else { "" });
        assert_eq!(seen.facts().any(|known| *known == fact), !auxiliary(&fact));
        assert!(matches!(seen.why(&snapshot, &fact), Explanation::Holds(_)), "{fact} is derived");
    }
    for (fluent, value) in seen.numbers() {
        let _ = writeln!(out, "{fluent} = {value}");
    }
    for question in sources.iter().filter_map(|(name, _)| name.strip_prefix("ask ")) {
        let mut words = question.trim_matches(['(', ')']).split_whitespace().map(Name::new);
        let predicate = words.next().expect("a question names a predicate");
        let fact = Fact { predicate, arguments: words.collect() };
        let _ = writeln!(
            out,
            "why {fact}? {}",
            serde_json::to_string(&seen.why(&snapshot, &fact)).expect("plain data")
        );
    }
    Ok(out)
}
