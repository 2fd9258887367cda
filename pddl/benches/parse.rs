//! How fast text becomes a model: MB/s on a generated problem and on the largest case.
#![allow(missing_docs, reason = "criterion's macros define public functions")]

use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pddl::{Source, parse_domain, parse_problem, syntax};

#[path = "generated.rs"]
#[expect(unreachable_pub, reason = "public for the bench beside peers")]
mod generated;

fn long_problem(c: &mut Criterion) {
    let domain =
        parse_domain(&Source::new("domain.pddl", generated::DOMAIN), &[]).model.expect("the domain is good");
    let source = Source::new("problem.pddl", generated::problem(1_000_000));
    assert!(parse_problem(&source, &domain).model.is_some());
    let mut group = c.benchmark_group("generated 1 MB problem");
    group.throughput(Throughput::Bytes(source.text().len() as u64));
    group.bench_function("tree", |b| b.iter(|| syntax::parse(&source)));
    group.bench_function("model", |b| b.iter(|| parse_problem(&source, &domain)));
    group.finish();
}

fn largest_case(c: &mut Criterion) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("test_data/ok");
    let texts = std::fs::read_dir(folder).expect("the cases can be read").filter_map(|entry| {
        let path = entry.ok()?.path();
        let is_domain = path.extension()? == "pddl";
        let text = std::fs::read_to_string(path).ok()?;
        (is_domain && !text.contains("; with ")).then_some(text)
    });
    let source = Source::new("case.pddl", texts.max_by_key(String::len).expect("there are cases"));
    assert!(parse_domain(&source, &[]).model.is_some());
    let mut group = c.benchmark_group("largest case");
    group.throughput(Throughput::Bytes(source.text().len() as u64));
    group.bench_function("domain", |b| b.iter(|| parse_domain(&source, &[])));
    group.finish();
}

criterion_group!(benches, long_problem, largest_case);
criterion_main!(benches);
