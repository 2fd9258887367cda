//! Turns each fact round at each step of a plan, and compares what Monitoring says with what the validator says of each
//! suffix from there. The validator shares no code with the planner.

use budget::Cancellation;
use executive::{Decision, GoalId, Model, Monitor, Request, RequestId, decide};
use pddl::model::{Domain, Name, Problem};
use pddl::{PlanStep, SequentialPlan, Source, Span, parse_domain, parse_problem};
use planner::{FactId, GroundOptions, OperatorId, State, ground};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

/// What one comparison covered.
#[derive(Debug, Default)]
pub(crate) struct Sweep {
    pub(crate) steps: usize,
    pub(crate) facts: usize,
    pub(crate) derived: usize,
    pub(crate) conditional: usize,
    pub(crate) numeric: usize,
    /// The first suffix that is not simulated.
    pub(crate) exact_from: usize,
    /// Facts turned round.
    pub(crate) flips: usize,
    /// Those after which another suffix than before is the furthest.
    pub(crate) matter: usize,
    /// Suffixes that the validator judged.
    pub(crate) judged: usize,
    /// Where the verdicts differ.
    pub(crate) wrong: Vec<String>,
}

/// The columns of a [`Sweep`] as text.
pub(crate) const COLUMNS: &str =
    "steps | facts | conditional | numeric | derived | exact from | flips | matter | judged | wrong";

impl std::fmt::Display for Sweep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { steps, facts, conditional, numeric, derived, exact_from, flips, matter, judged, wrong } =
            self;
        write!(f, "{steps} | {facts} | {conditional} | {numeric} | {derived} | {exact_from} | ")?;
        write!(f, "{flips} | {matter} | {judged} | {}", wrong.len())
    }
}

/// How much to do.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// States that the search may expand.
    pub(crate) expansions: u64,
    /// About how many suffixes the validator may judge; every nth flip is taken so as to keep to it.
    pub(crate) judged: usize,
}

/// Why a task was left out.
pub(crate) type Skipped = String;

pub(crate) fn sweep(domain: &Path, problem: &Path, limits: Limits) -> Result<Sweep, Skipped> {
    let (domain, problem) = read(domain, problem)?;
    let task = ground(&domain, &problem, &GroundOptions::default()).map_err(|e| e.to_string())?;
    let changing = changing(&domain, &task);
    drop(task);
    let model = Model::new(domain, problem, &changing).map_err(|e| e.to_string())?;
    let model = Arc::new(model);
    let plan = plan(&model, limits.expansions)?;
    Ok(compare(&model, &plan, limits.judged))
}

fn read(domain: &Path, problem: &Path) -> Result<(Domain, Problem), Skipped> {
    let text = |path: &Path| std::fs::read_to_string(path).map_err(|e| e.to_string());
    let domain = parse_domain(&Source::new("d", text(domain)?), &[]).model.ok_or("an invalid domain")?;
    let problem =
        parse_problem(&Source::new("p", text(problem)?), &domain).model.ok_or("an invalid problem")?;
    Ok((domain, problem))
}

/// The predicates that some operator changes.
fn changing(domain: &Domain, task: &planner::Task) -> Vec<Name> {
    let mut changed: BTreeSet<FactId> = BTreeSet::new();
    for operator in task.operators().iter() {
        changed.extend(operator.adds.iter().chain(operator.deletes));
        for effect in operator.conditional.iter() {
            changed.extend(effect.adds.iter().chain(effect.deletes));
        }
    }
    let atoms = changed.iter().filter_map(|&fact| task.facts()[fact].atom.as_ref());
    let predicates: BTreeSet<_> = atoms.map(|atom| atom.predicate).collect();
    predicates.into_iter().map(|p| domain.predicates[p].name.clone()).collect()
}

fn plan(model: &Arc<Model>, expansions: u64) -> Result<Vec<OperatorId>, Skipped> {
    let state = model.task().initial_state().clone();
    let (broken, barred) = (Vec::new(), Vec::new());
    let request = Request {
        id: RequestId(0),
        state,
        goals: vec![GoalId(0)],
        broken,
        served: vec![GoalId(0)],
        running: Vec::new(),
        barred,
        expansions,
        arrived: None,
    };
    match decide(model, &request, &Cancellation::default()) {
        Decision::Plan { operators, .. } => Ok(operators),
        other => Err(format!("no plan: {}", format!("{other:?}").chars().take(80).collect::<String>())),
    }
}

fn compare(model: &Arc<Model>, plan: &[OperatorId], most: usize) -> Sweep {
    let task = model.task();
    let facts: Vec<FactId> = task
        .facts()
        .ids()
        .filter(|&fact| !task.facts()[fact].derived && task.facts()[fact].atom.is_some())
        .collect();
    let operators = || plan.iter().map(|&step| task.operator(step));
    let start = task.initial_state();
    let mut monitor = Monitor::new(task, plan.to_vec(), task.goal().clone(), start);
    let mut sweep = Sweep {
        steps: plan.len(),
        facts: facts.len(),
        derived: task.axioms().iter().map(|rule| rule.head).collect::<BTreeSet<_>>().len(),
        conditional: operators().filter(|o| !o.conditional.is_empty()).count(),
        numeric: operators().filter(planner::Operator::changes_numbers).count(),
        exact_from: monitor.exact_from(),
        ..Sweep::default()
    };
    let steps = steps(model, plan);
    let all = (plan.len() + 1) * facts.len() * (plan.len() + 2) / 2;
    let every = all.div_ceil(most).max(1);
    let mut state = start.clone();
    let mut turn = 0;
    for done in 0..=plan.len() {
        monitor.observe(task, &state);
        let before = monitor.furthest(task);
        for &fact in &facts {
            turn += 1;
            if turn % every != 0 {
                continue;
            }
            let mut flipped = state.clone();
            task.change(&mut flipped, [(fact, !state.contains(fact))]);
            monitor.observe(task, &flipped);
            let furthest = monitor.furthest(task);
            let expected = judged(model, &steps, &flipped, &mut sweep.judged);
            sweep.flips += 1;
            sweep.matter += usize::from(furthest != before);
            if furthest != expected {
                let fact = task.fact_name(fact);
                sweep.wrong.push(format!("after {done} steps, {fact}: {furthest:?}, not {expected:?}"));
            }
        }
        if let Some(next) = plan.get(done).and_then(|&step| task.successor(&state, step)) {
            state = next;
        }
    }
    sweep
}

fn steps(model: &Model, plan: &[OperatorId]) -> Vec<PlanStep> {
    let operators = plan.iter().map(|&step| model.task().operator(step));
    operators
        .map(|o| PlanStep { action: o.action, arguments: o.arguments.to_vec(), span: Span::default() })
        .collect()
}

/// The last suffix that the validator accepts from this state.
fn judged(model: &Model, steps: &[PlanStep], state: &State, count: &mut usize) -> Option<usize> {
    let problem = model.problem_in(state, &[GoalId(0)]);
    (0..=steps.len()).rev().find(|&start| {
        *count += 1;
        let plan = SequentialPlan::new(steps[start..].to_vec());
        matches!(validator::validate(model.domain(), &problem, &plan), validator::Verdict::Valid(_))
    })
}
