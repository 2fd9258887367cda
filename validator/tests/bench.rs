//! Agreement with the reference verdicts of `$PELEA_BENCH/triples`, where that folder is at hand.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pddl::{Source, parse_domain, parse_plan, parse_problem};
use std::path::{Path, PathBuf};
use validator::{Verdict, explain, validate};

fn bench() -> PathBuf {
    std::env::var_os("PELEA_BENCH")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/bench"), PathBuf::from)
}

fn read(path: &Path) -> Source {
    let bytes = std::fs::read(path).unwrap();
    Source::new(path.to_string_lossy(), String::from_utf8_lossy(&bytes))
}

fn word(folder: &Path, plan: &str) -> String {
    let source = read(&folder.join("domain.pddl"));
    let parsed = parse_domain(&source, &[]);
    let Some(domain) = parsed.model else { return format!("unreadable domain: {:?}", parsed.diagnostics) };
    let source = read(&folder.join("problem.pddl"));
    let parsed = parse_problem(&source, &domain);
    let Some(problem) = parsed.model else { return format!("unreadable problem: {:?}", parsed.diagnostics) };
    let source = read(&folder.join(plan));
    let parsed = parse_plan(&source, &domain, &problem);
    let Some(plan) = parsed.model else { return format!("unreadable plan: {:?}", parsed.diagnostics) };
    let kind = plan.kind();
    let Some(plan) = plan.into_sequential() else { return format!("refused: a {kind} plan") };
    let verdict = validate(&domain, &problem, &plan);
    match &verdict {
        Verdict::Valid(_) => "valid".to_owned(),
        Verdict::Invalid(_) => format!("invalid: {:?}", explain(&domain, &problem, &plan, &verdict)),
        Verdict::Unsupported(_) | Verdict::IllFormed(_) => format!("refused: {verdict:?}"),
    }
}

#[test]
fn agrees_with_the_reference_verdicts() {
    let triples = bench().join("triples");
    let Ok(table) = std::fs::read_to_string(triples.join("verdicts.tsv")) else {
        println!("skipped: no {}", triples.display());
        return;
    };
    let (mut all, mut differing) = (0, Vec::new());
    for line in table.lines().filter(|l| !l.starts_with('#') && !l.trim().is_empty()) {
        let columns: Vec<_> = line.split('\t').collect();
        let [folder, plan, reference] = columns[..] else { panic!("not a row: {line}") };
        let ours = word(&triples.join(folder), plan);
        all += 1;
        if ours != reference {
            differing.push(format!("{folder}/{plan}: {ours}, reference {reference}"));
        }
    }
    println!("{} of {all} verdicts agree", all - differing.len());
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}
