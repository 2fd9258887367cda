//! Whatever is advised makes the plan valid: the change is made, the files are written, read again, and judged.
//!
//! The plans are those of this crate's suites and of `domains/`, with a step less, two steps in each other's place,
//! another argument, another time.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pddl::model::{Domain, Idx, ObjectId, Problem};
use pddl::{
    Decimal, Plan, Source, parse_domain, parse_plan, parse_problem, print_domain, print_plan, print_problem,
};
use proptest::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use validator::{AdviceLimits, Validator, Verdict, show_repair};

/// A plan of a suite with its task, and whether it is valid.
struct Case {
    name: String,
    domain: Domain,
    problem: Problem,
    plan: Plan,
    is_valid: bool,
}

static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = [root.join("test_data"), root.join("../domains")];
    let mut cases = Vec::new();
    for folder in folders.iter().flat_map(|folder| entries(folder)) {
        read(&folder, &mut cases);
    }
    cases
});

fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    entries
}

fn source(path: &Path) -> Source {
    Source::new(path.display().to_string(), fs::read_to_string(path).unwrap())
}

/// Every plan of a folder under the problem whose name it begins with, or the only one.
fn read(folder: &Path, cases: &mut Vec<Case>) {
    let domain = folder.join("domain.pddl");
    if !domain.exists() {
        return;
    }
    let Some(domain) = parse_domain(&source(&domain), &[]).model else { return };
    let plans: Vec<PathBuf> =
        ["valid", "invalid"].iter().flat_map(|kind| entries(&folder.join("plans").join(kind))).collect();
    let is_problem =
        |path: &PathBuf| path.extension().is_some_and(|e| e == "pddl") && !path.ends_with("domain.pddl");
    let problems: Vec<PathBuf> = entries(folder).into_iter().filter(is_problem).collect();
    let stem = |path: &Path| path.file_stem().unwrap().to_string_lossy().into_owned();
    for path in &problems {
        let Some(problem) = parse_problem(&source(path), &domain).model else { continue };
        let is_its = |plan: &&PathBuf| problems.len() == 1 || stem(plan).starts_with(&stem(path));
        for path in plans.iter().filter(is_its) {
            let Some(plan) = parse_plan(&source(path), &domain, &problem).model else { continue };
            let Ok(validator) = Validator::new(&domain, &problem) else { continue };
            let is_valid = match validator.validate(&plan) {
                Verdict::Valid(_) => true,
                Verdict::Invalid(_) => false,
                Verdict::Unsupported(_) | Verdict::IllFormed(_) => continue,
            };
            let name = path.display().to_string();
            cases.push(Case { name, domain: domain.clone(), problem: problem.clone(), plan, is_valid });
        }
    }
}

/// Makes each change that is advised, writes the files, reads them and judges; answers how many there were.
fn check(case: &Case, plan: &Plan) -> usize {
    let (domain, problem) = (&case.domain, &case.problem);
    let validator = Validator::new(domain, problem).unwrap();
    let Verdict::Invalid(failure) = validator.validate(plan) else { return 0 };
    let budget = AdviceLimits { plans: 200, steps: 5_000, ..AdviceLimits::default() };
    let repairs = validator.advise(plan, &failure, budget);
    for repair in &repairs {
        let (mut domain, mut problem, mut plan) = (domain.clone(), problem.clone(), plan.clone());
        let said = show_repair(&domain, &problem, &plan, repair);
        repair.apply(&mut domain, &mut problem, &mut plan);
        let text = print_plan(&plan, &domain, &problem);
        let domain = Source::new("domain", print_domain(&domain));
        let problem = Source::new("problem", print_problem(&problem, &case.domain));
        let domain = parse_domain(&domain, &[]).model.unwrap();
        let problem = parse_problem(&problem, &domain).model.unwrap();
        let plan = parse_plan(&Source::new("plan", text.clone()), &domain, &problem).model.unwrap();
        let verdict = Validator::new(&domain, &problem).unwrap().validate(&plan);
        assert!(verdict.is_valid(), "{}: {said}: {verdict:?}\n{text}", case.name);
    }
    repairs.len()
}

#[test]
fn advice_for_the_invalid_plans_of_the_suites_holds() {
    let invalid: Vec<&Case> = CASES.iter().filter(|case| !case.is_valid).collect();
    assert!(invalid.len() > 100, "{}", invalid.len());
    let advised = invalid.iter().filter(|case| check(case, &case.plan) > 0).count();
    assert!(advised * 2 > invalid.len(), "{advised} of {}", invalid.len());
}

/// One way to spoil a plan.
fn spoil(case: &Case, kind: usize, one: usize, other: usize, thousandths: i64) -> Option<Plan> {
    let object = ObjectId::from_index(other % case.problem.objects.len().max(1));
    let change = |arguments: &mut Vec<ObjectId>| {
        let place = other.checked_rem(arguments.len())?;
        arguments[place] = object;
        Some(())
    };
    match &case.plan {
        Plan::Sequential(plan) => {
            let mut plan = plan.clone();
            let one = one.checked_rem(plan.steps.len())?;
            let other = other % plan.steps.len();
            match kind {
                0 => drop(plan.steps.remove(one)),
                1 => plan.steps.swap(one, other),
                2 => plan.steps.insert(other, plan.steps[one].clone()),
                _ => change(&mut plan.steps[one].arguments)?,
            }
            Some(Plan::Sequential(plan))
        }
        Plan::Temporal(plan) => {
            let mut plan = plan.clone();
            let one = one.checked_rem(plan.steps.len())?;
            let later = |time: Decimal| {
                let sum = (time.to_f64() * 1000.0).round() / 1000.0 + thousandths as f64 / 1000.0;
                format!("{:.3}", sum.max(0.0)).parse::<Decimal>().ok()
            };
            match kind {
                0 => drop(plan.steps.remove(one)),
                1 => plan.steps[one].start = later(plan.steps[one].start)?,
                2 => plan.steps[one].duration = Some(later(plan.steps[one].duration?)?),
                _ => change(&mut plan.steps[one].arguments)?,
            }
            Some(Plan::Temporal(plan))
        }
        Plan::Hierarchical(_) => None,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn advice_for_spoiled_plans_holds(
        which in any::<prop::sample::Index>(),
        kind in 0_usize..4,
        one in 0_usize..1000,
        other in 0_usize..1000,
        thousandths in -3000_i64..3000,
    ) {
        let valid: Vec<&Case> = CASES.iter().filter(|case| case.is_valid).collect();
        let case = which.get(&valid);
        if let Some(plan) = spoil(case, kind, one, other, thousandths) {
            check(case, &plan);
        }
    }
}
