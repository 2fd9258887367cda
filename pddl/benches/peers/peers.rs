//! Reading speed beside the other crates that read PDDL, both sides in one run.
//!
//! Ours resolves names, arities and types; theirs give a syntax tree only. Files: a generated problem, and the
//! largest domains and problems below the folder that `PELEA_BENCH` names. A file that a peer cannot read is left out for
//! that peer, and a line says so.
#![allow(missing_docs, reason = "criterion's macros define public functions")]

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use ours::Source;
use pddl::Parser as _;

#[path = "../generated.rs"]
mod generated;

/// How many files of each kind.
const FILES: usize = 4;

/// What one file is, with what reading it needs.
enum Kind {
    Domain,
    ProblemOf(Box<ours::model::Domain>),
}

fn files(folder: &Path, into: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            files(&path, into);
        } else if path.extension().is_some_and(|e| e == "pddl") {
            into.push(path);
        }
    }
}

/// The largest files that we can read, each folder once.
fn largest() -> Vec<(String, String, Kind)> {
    let Some(folder) = std::env::var_os("PELEA_BENCH") else { return Vec::new() };
    let mut paths = Vec::new();
    files(Path::new(&folder), &mut paths);
    paths.sort_by_key(|p| std::cmp::Reverse(p.metadata().map_or(0, |m| m.len())));
    let (mut found, mut folders, mut counts) = (Vec::new(), Vec::new(), [0, 0]);
    for path in paths {
        let folder = path.parent().map(Path::to_owned);
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let is_problem = text.to_ascii_lowercase().contains("(problem");
        let count = &mut counts[usize::from(is_problem)];
        if *count >= FILES || folders.contains(&(folder.clone(), is_problem)) {
            continue;
        }
        let kind = if is_problem {
            let Ok(text) = std::fs::read_to_string(path.with_file_name("domain.pddl")) else { continue };
            let Some(domain) = ours::parse_domain(&Source::new("", text), &[]).model else { continue };
            Kind::ProblemOf(Box::new(domain))
        } else {
            Kind::Domain
        };
        let name = path.components().rev().take(2).map(|c| c.as_os_str().to_string_lossy().into_owned());
        let name: Vec<String> = name.collect();
        *count += 1;
        folders.push((folder, is_problem));
        found.push((format!("{} {}", name[1], name[0]), text, kind));
    }
    found
}

fn compare(c: &mut Criterion) {
    let domain =
        ours::parse_domain(&Source::new("", generated::DOMAIN), &[]).model.expect("the domain is good");
    let mut cases = vec![(
        "generated 1 MB problem".to_owned(),
        generated::problem(1_000_000),
        Kind::ProblemOf(Box::new(domain)),
    )];
    cases.extend(largest());
    for (name, text, kind) in &cases {
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Bytes(text.len() as u64));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1));
        let source = Source::new("", text.clone());
        let id = |who: &str| BenchmarkId::new(who, text.len());
        match kind {
            Kind::Domain => {
                group.bench_function(id("ours"), |b| b.iter(|| ours::parse_domain(black_box(&source), &[])));
                if pddl::Domain::from_str(text).is_ok() {
                    group.bench_function(id("pddl"), |b| b.iter(|| pddl::Domain::from_str(black_box(text))));
                } else {
                    eprintln!("{name}: pddl cannot read it");
                }
                if pddl_parser::domain::domain::Domain::parse(text.as_str().into()).is_ok() {
                    group.bench_function(id("pddl-parser"), |b| {
                        b.iter(|| {
                            pddl_parser::domain::domain::Domain::parse(black_box(text.as_str()).into())
                        });
                    });
                } else {
                    eprintln!("{name}: pddl-parser cannot read it");
                }
            }
            Kind::ProblemOf(domain) => {
                group.bench_function(id("ours"), |b| {
                    b.iter(|| ours::parse_problem(black_box(&source), domain));
                });
                if pddl::Problem::from_str(text).is_ok() {
                    group.bench_function(id("pddl"), |b| b.iter(|| pddl::Problem::from_str(black_box(text))));
                } else {
                    eprintln!("{name}: pddl cannot read it");
                }
                if pddl_parser::problem::Problem::parse(text.as_str().into()).is_ok() {
                    group.bench_function(id("pddl-parser"), |b| {
                        b.iter(|| pddl_parser::problem::Problem::parse(black_box(text.as_str()).into()));
                    });
                } else {
                    eprintln!("{name}: pddl-parser cannot read it");
                }
            }
        }
        group.finish();
    }
}

criterion_group!(benches, compare);
criterion_main!(benches);
