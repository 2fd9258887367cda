//! Agreement with the reference verdicts of `$PELEA_BENCH/triples`, where that folder is at hand, and how much of the
//! language these triples use: `AGREEMENT.md` has the table.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use expect_test::expect_file;
use pddl::model::{Condition, ConditionKind, Domain, Effect, EffectKind, Problem};
use pddl::{Plan, Source, parse_domain, parse_plan, parse_problem};
use std::collections::BTreeMap;
use std::fmt::Write;
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

/// Our word on a triple, and which parts of the language it uses.
fn word(folder: &Path, plan: &str) -> (String, Vec<&'static str>) {
    let unread = |what: &str, diagnostics| (format!("unreadable {what}: {diagnostics:?}"), Vec::new());
    let source = read(&folder.join("domain.pddl"));
    let parsed = parse_domain(&source, &[]);
    let Some(domain) = parsed.model else { return unread("domain", parsed.diagnostics) };
    let source = read(&folder.join("problem.pddl"));
    let parsed = parse_problem(&source, &domain);
    let Some(problem) = parsed.model else { return unread("problem", parsed.diagnostics) };
    let source = read(&folder.join(plan));
    let parsed = parse_plan(&source, &domain, &problem);
    let Some(plan) = parsed.model else { return unread("plan", parsed.diagnostics) };
    let verdict = validate(&domain, &problem, &plan);
    let word = match &verdict {
        Verdict::Valid(_) => "valid".to_owned(),
        Verdict::Invalid(_) => format!("invalid: {:?}", explain(&domain, &problem, &plan, &verdict)),
        Verdict::Unsupported(_) | Verdict::IllFormed(_) => format!("refused: {verdict:?}"),
    };
    (word, parts(&domain, &problem, &plan))
}

/// What is in use, not what is required.
fn parts(domain: &Domain, problem: &Problem, plan: &Plan) -> Vec<&'static str> {
    let conditions = Conditions::of(domain, problem);
    let effects = effects(domain);
    let untyped = domain.types.len() == 1;
    let assigns = effects.iter().any(|e| matches!(e.kind, EffectKind::Assign(..)));
    let parts = [
        ("all", true),
        ("plans without times", matches!(plan, Plan::Sequential(_))),
        ("plans with times", matches!(plan, Plan::Temporal(_))),
        ("no types", untyped),
        ("types", !untyped),
        ("constants of the domain", !domain.constants.is_empty()),
        ("equality of objects", conditions.has(|c| matches!(c.kind, ConditionKind::Same(..)))),
        ("negation in conditions", conditions.has(|c| matches!(c.kind, ConditionKind::Not(_)))),
        (
            "disjunction, implication",
            conditions.has(|c| matches!(c.kind, ConditionKind::Or(_) | ConditionKind::Imply(..))),
        ),
        (
            "quantifiers in conditions",
            conditions.has(|c| matches!(c.kind, ConditionKind::Exists(..) | ConditionKind::Forall(..))),
        ),
        ("conditional effects", effects.iter().any(|e| matches!(e.kind, EffectKind::When(..)))),
        ("universal effects", effects.iter().any(|e| matches!(e.kind, EffectKind::Forall(..)))),
        ("derived predicates", !domain.axioms.is_empty()),
        ("comparisons of numbers", conditions.has(|c| matches!(c.kind, ConditionKind::Compare(..)))),
        ("numbers changed by actions", assigns),
        ("actions that take time", !domain.durative_actions.is_empty()),
        ("timed literals", !problem.timed.is_empty()),
        ("processes and events", !domain.processes.is_empty() || !domain.events.is_empty()),
        ("constraints", !domain.constraints.is_empty() || !problem.constraints.is_empty()),
        ("preferences", !problem.preferences.is_empty()),
        ("a metric", problem.metric.is_some()),
    ];
    parts.into_iter().filter(|(_, used)| *used).map(|(name, _)| name).collect()
}

/// The conditions of a task.
struct Conditions<'a>(Vec<&'a Condition>);

impl<'a> Conditions<'a> {
    fn of(domain: &'a Domain, problem: &'a Problem) -> Self {
        let mut all = vec![&problem.goal];
        all.extend(domain.actions.iter().map(|action| &action.precondition));
        all.extend(domain.axioms.iter().map(|axiom| &axiom.body));
        all.extend(domain.durative_actions.iter().flat_map(|a| &a.conditions).map(|timed| &timed.condition));
        Self(all)
    }

    fn has(&self, wanted: impl Fn(&Condition) -> bool) -> bool {
        self.0.iter().any(|condition| {
            let mut has = false;
            condition.each(&mut |part| has |= wanted(part));
            has
        })
    }
}

/// Every effect of an action, those inside of others too.
fn effects(domain: &Domain) -> Vec<&Effect> {
    let mut all = Vec::new();
    domain.actions.iter().for_each(|action| action.effect.each(&mut |part| all.push(part)));
    all
}

#[test]
fn agrees_with_the_reference_verdicts() {
    let triples = bench().join("triples");
    let Ok(table) = std::fs::read_to_string(triples.join("verdicts.tsv")) else {
        println!("skipped: no {}", triples.display());
        return;
    };
    let mut differing = Vec::new();
    // Per part of the language: how many plans there are, and on how many both say the same.
    let mut counts: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    let mut order = Vec::new();
    for line in table.lines().filter(|l| !l.starts_with('#') && !l.trim().is_empty()) {
        let columns: Vec<_> = line.split('\t').collect();
        let [folder, plan, reference] = columns[..] else { panic!("not a row: {line}") };
        let (ours, parts) = word(&triples.join(folder), plan);
        for part in parts {
            let (all, same) = counts.entry(part).or_insert_with(|| {
                order.push(part);
                (0, 0)
            });
            *all += 1;
            *same += usize::from(ours == reference);
        }
        if ours != reference {
            differing.push(format!("{folder}/{plan}: {ours}, reference {reference}"));
        }
    }
    assert!(differing.is_empty(), "{}", differing.join("\n"));
    let mut page = "# Agreement with VAL on the reference plans\n\nWritten by the test `bench` (`UPDATE_EXPECT=1` writes it anew) \
                    from plans that public planners\nfound for tasks of competitions. A plan counts for each part of the \
                    language that its task uses.\n\n| part of the language | plans | same verdict |\n|---|---|---|\n"
        .to_owned();
    order.sort_by_key(|part| std::cmp::Reverse(counts[part]));
    for part in order {
        let (all, same) = counts[part];
        writeln!(page, "| {part} | {all} | {same} |").unwrap();
    }
    expect_file!["../AGREEMENT.md"].assert_eq(&page);
}
