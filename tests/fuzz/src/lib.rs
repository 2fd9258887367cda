//! What the fuzz targets do with their bytes.
//!
//! The properties are those of the tests (`pddl/tests/support/properties.rs`); a target only chooses what
//! the bytes are read as. If a text needs others around it (a plan its problem), those are good cases of
//! `pddl/test_data/ok`, so that mutations go into one kind of text.

use std::sync::LazyLock;

use pddl::model::{Domain, Problem};
use pddl::{Source, parse_domain, parse_problem};
use support::properties::{check_domain, check_drafts, check_plan, check_problem, check_text};

#[path = "../../../pddl/tests/support/mod.rs"]
mod support;

/// A good domain and its problem, both in one text.
struct Task {
    domain: Domain,
    problem: Problem,
}

impl Task {
    fn read(text: &str) -> Self {
        let source = Source::new("task", text);
        let domain = parse_domain(&source, &[]).model.expect("a good case");
        let problem = parse_problem(&source, &domain).model.expect("a good case");
        Self { domain, problem }
    }
}

static VOCABULARY: LazyLock<Domain> = LazyLock::new(|| {
    let source = Source::new("vocabulary", include_str!("../../../pddl/test_data/ok/vocabulary.pddl"));
    parse_domain(&source, &[]).model.expect("a good case")
});

static LAMPS: LazyLock<Task> =
    LazyLock::new(|| Task::read(include_str!("../../../pddl/test_data/ok/strips-untyped.pddl")));

static NETWORK: LazyLock<Task> =
    LazyLock::new(|| Task::read(include_str!("../../../pddl/test_data/ok/htn.pddl")));

/// The problems for sequential, temporal and hierarchical plans.
static KINDS: LazyLock<Task> =
    LazyLock::new(|| Task::read(include_str!("../../../pddl/test_data/ok/plan-kinds.pddl")));

/// The bytes as a text; Latin-1 if they are not UTF-8.
fn text(bytes: &[u8]) -> Source {
    Source::from_bytes("text", bytes.to_vec())
}

/// A domain, which may import a vocabulary.
pub fn domain(bytes: &[u8]) {
    let source = text(bytes);
    check_text(&source);
    check_domain(&source, &[&*VOCABULARY]);
}

/// A domain and a problem in one text; the problem is read even if the domain is wrong.
pub fn problem(bytes: &[u8]) {
    task(bytes, &LAMPS.domain);
}

/// The same with tasks and methods.
pub fn hddl(bytes: &[u8]) {
    task(bytes, &NETWORK.domain);
}

fn task(bytes: &[u8], otherwise: &Domain) {
    let source = text(bytes);
    check_text(&source);
    check_drafts(&source);
    let domain = check_domain(&source, &[]);
    check_problem(&source, domain.as_ref().unwrap_or(otherwise));
}

/// A plan of any kind.
pub fn plan(bytes: &[u8]) {
    let source = text(bytes);
    check_text(&source);
    check_plan(&source, &KINDS.domain, &KINDS.problem);
}
