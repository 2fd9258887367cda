//! The number of findings of each lint in the competitions' domains: a change that makes a lint report more, or less, in
//! domains that were made with care shows here, and its author has to review it.
//!
//! `PELEA_BENCH` names the folder; the default is `../shared/bench` beside the workspace. Where it is absent the test
//! prints that and passes. `PELEA_LINT=NAME cargo test -p pelea-lints --test corpus -- --nocapture` shows the findings of
//! a lint. `UPDATE_EXPECT=1` writes the counts anew.

mod support;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use diagnostics::SourceId;
use lints::{File, Level, Linted, Linter};
use pddl::{Source, parse_domain, parse_problem};
use support::describe;

const DOMAIN: SourceId = SourceId(0);
const PROBLEM: SourceId = SourceId(1);

/// The parts of the corpus that are for readers of domains.
const FOLDERS: [&str; 3] = ["classical", "variants", "htn"];

fn corpus() -> PathBuf {
    let default = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/bench");
    std::env::var_os("PELEA_BENCH").map_or(default, PathBuf::from)
}

fn source(path: &Path) -> Source {
    Source::from_bytes(path.display().to_string(), std::fs::read(path).expect("the corpus can be read"))
}

/// All PDDL and HDDL files below a folder.
fn files(folder: &Path, found: &mut BTreeSet<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("the corpus can be read") {
        let path = entry.expect("the corpus can be read").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "pddl" || e == "hddl") {
            found.insert(path);
        }
    }
}

/// The domain of a problem: beside it, named like it, or in the folder above.
fn domain_of(problem: &Path) -> Option<PathBuf> {
    let name = problem.file_name()?.to_str()?;
    let stem = problem.file_stem()?.to_str()?;
    let folder = problem.parent()?;
    let mut near = vec![
        format!("{stem}-domain.pddl"),
        name.replace("problem", "domain"),
        format!("domain_{name}"),
        format!("domain-{name}"),
        "domain.pddl".to_owned(),
        "domain.hddl".to_owned(),
    ];
    near.retain(|n| n != name);
    let beside = near.iter().map(|n| folder.join(n)).find(|path| path.is_file());
    beside.or_else(|| Some(folder.parent()?.join("domain.hddl")).filter(|path| path.is_file()))
}

#[derive(Default)]
struct Count {
    domains: BTreeSet<PathBuf>,
    findings: usize,
}

#[test]
fn what_is_said_of_the_competitions_is_as_reviewed() {
    let folder = corpus();
    if !folder.is_dir() {
        println!("skipped: no corpus in {}", folder.display());
        return;
    }
    let mut paths = BTreeSet::new();
    FOLDERS.iter().for_each(|part| files(&folder.join(part), &mut paths));
    let mut families: BTreeMap<PathBuf, Vec<PathBuf>> = BTreeMap::new();
    for path in paths {
        if let Some(domain) = domain_of(&path)
            && domain != path
            && source(&path).text().to_ascii_lowercase().contains("(problem")
        {
            families.entry(domain).or_default().push(path);
        }
    }
    let shown = std::env::var("PELEA_LINT").unwrap_or_default();
    let mut counts: BTreeMap<&str, Count> = BTreeMap::new();
    let mut read = 0;
    for (domain_path, problems) in &families {
        let domain_source = source(domain_path);
        let Some(domain) = parse_domain(&domain_source, &[]).model else { continue };
        let mut linter =
            Linter::new(File { id: DOMAIN, source: &domain_source, model: &domain }, Level::Pedantic);
        let mut count = |f: &Linted, problem: &Source| {
            let count = counts.entry(f.lint).or_default();
            count.domains.insert(domain_path.clone());
            count.findings += 1;
            if shown == f.lint {
                let source = |id| if id == DOMAIN { &domain_source } else { problem };
                println!("{}", describe(f, &source));
            }
        };
        for path in problems {
            let source = source(path);
            let Some(problem) = parse_problem(&source, &domain).model else { continue };
            read += 1;
            for finding in linter.problem(File { id: PROBLEM, source: &source, model: &problem }) {
                assert_eq!(finding.finding.place.source, PROBLEM);
                count(&finding, &source);
            }
        }
        for finding in linter.finish() {
            assert_eq!(finding.finding.place.source, DOMAIN);
            count(&finding, &domain_source);
        }
    }
    let mut table = format!("{} domains, {read} problems\n", families.len());
    for lint in lints::all() {
        let none = Count::default();
        let Count { domains, findings } = counts.get(lint.name).unwrap_or(&none);
        let _ = writeln!(
            table,
            "{} {:<32} {:<8} {findings:>5} in {:>3} families",
            lint.code(),
            lint.name,
            if lint.level == Level::Default { "" } else { "pedantic" },
            domains.len(),
        );
    }
    expect_test::expect_file!["corpus.expected"].assert_eq(&table);
}
