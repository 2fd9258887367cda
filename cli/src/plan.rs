//! `pelea plan DOMAIN PROBLEM`: a plan on standard output or in a file, statistics on standard error.
//!
//! The validator checks every plan before it is written. An invalid plan is a bug of ours: it is not
//! written, and the exit code is 70. As JSON the result is
//!
//! ```json
//! {"kind": "plan", "outcome": "solved", "steps": ["(go a b)"], "cost": 1, "cost_kind": "unit_cost",
//!  "search": "dual", "message": null,
//!  "statistics": {"read_ms": 1.2, "ground_ms": 0.4, "search_ms": 0.3, "facts": 3, "operators": 4,
//!                 "expanded": 2, "evaluated": 2, "generated": 4}}
//! ```
//!
//! With `--anytime` there is `optimal`, whether no plan is better, and a record for each plan before; with
//! `--repair` there is `repair`, both plans with their figures.
//!
//! `outcome` is `solved`, `unsolvable` (with the reason in `message` and, as data, in `unsolvable`), `limit` (with which) or
//! `unsupported`; `statistics` is null where grounding did not end.

mod anytime;
mod repair;
mod unsolvable;

pub(crate) use unsolvable::Unsolvable;

use crate::clock::{Deadline, Seconds, Stopwatch};
use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use crate::memory;
use crate::render::{self, show};
use crate::task::TaskFiles;
use crate::validate;
use clap::Args;
use diagnostics::{Finding, Place};
use pddl::model::Problem;
use pddl::{PlanStep, Severity, Source, Span};
use planner::{
    Budget, GroundError, GroundOptions, Limit, Origin, Outcome, Quality, Query, Report, SearchConfiguration,
    Task, ground, solve,
};
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;
use validator::{Number, Valid, Verdict, explain};

/// What to plan.
#[derive(Debug, Args)]
#[command(after_help = format!("Searches:{}\n\nWithout --search and --optimal: {}.",
    searches(), SearchConfiguration::portfolio().name))]
pub(crate) struct Arguments {
    /// The domain file.
    domain: PathBuf,
    /// The problem file.
    problem: PathBuf,
    /// Write the plan into this file, once it is complete.
    #[arg(short, long, value_name = "PLAN")]
    output: Option<PathBuf>,
    /// Give up after so many seconds.
    #[arg(long, value_name = "S")]
    timeout: Option<Seconds>,
    /// Use at most so many mebibytes for the task and the states [default: what the machine allows, 4096 at most].
    #[arg(long, value_name = "MIB")]
    memory: Option<usize>,
    /// The search to use.
    #[arg(long, value_name = "NAME", value_parser = search)]
    search: Option<SearchConfiguration>,
    /// Find a plan of least cost.
    #[arg(long, conflicts_with = "search")]
    optimal: bool,
    /// Go on to better plans until the timeout, or until there is none; each is written as PLAN.1, PLAN.2 …
    #[arg(long)]
    anytime: bool,
    /// Repair this plan: what can be reused of it is set beside a new plan.
    #[arg(long, value_name = "OLD_PLAN", conflicts_with = "anytime")]
    repair: Option<PathBuf>,
    /// Which of the two plans is taken [default: stability].
    #[arg(long, value_enum, requires = "repair")]
    prefer: Option<repair::Prefer>,
}

fn search(name: &str) -> Result<SearchConfiguration, String> {
    SearchConfiguration::named(name)
        .ok_or_else(|| format!("there is no such search; there are{}", searches()))
}

/// A line per search.
fn searches() -> String {
    let mut text = String::new();
    for known in SearchConfiguration::ALL {
        write!(text, "\n  {:12} {}", known.name, known.summary).expect("a string takes all");
    }
    text
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let deadline = Deadline::after(arguments.timeout);
    let interrupted = move || deadline.is_over();
    let configuration = match arguments.search {
        Some(configuration) => configuration,
        None if arguments.optimal => SearchConfiguration::best_optimal(),
        None => SearchConfiguration::portfolio(),
    };
    let mut answer = Answer::of(configuration.name);

    let watch = Stopwatch::start();
    let files = match TaskFiles::read(&arguments.domain, &[], &arguments.problem, console) {
        Ok(files) => files,
        Err(exit) => return exit,
    };
    let old = arguments.repair.as_ref().map(|path| repair::OldPlan::read(path, &files, console)).transpose();
    let old = match old {
        Ok(old) => old,
        Err(exit) => return exit,
    };
    let read_ms = watch.milliseconds();

    let watch = Stopwatch::start();
    let memory = arguments.memory.map_or_else(memory::budget, |mebibytes| mebibytes.saturating_mul(1 << 20));
    let budget = Budget { memory_bytes: Some(memory), interrupted: &interrupted, ..Budget::default() };
    let options = GroundOptions { budget, ..GroundOptions::default() };
    let task = match ground(&files.domain, &files.problem, &options) {
        Ok(task) => task,
        Err(error) => return not_grounded(&error, &files, &mut answer, console),
    };
    let ground_ms = watch.milliseconds();

    let watch = Stopwatch::start();
    let budget = Budget { memory_bytes: Some(memory.saturating_sub(task.memory_bytes())), ..budget };
    let output = arguments.output.as_deref();
    let report = if let Some(old) = &old {
        let prefer = arguments.prefer.unwrap_or_default();
        match repair::run((&files, &task), old, prefer, &configuration, &budget, console) {
            Ok((record, report)) => {
                answer.repair = Some(record);
                report
            }
            Err(exit) => return exit,
        }
    } else if arguments.anytime {
        match anytime::run(&files, &task, &configuration, &budget, output, console) {
            Ok(improved) => {
                answer.optimal = Some(improved.quality == Quality::Optimal);
                improved.report
            }
            Err(exit) => return exit,
        }
    } else {
        solve(&task, &Query::of(&task), &configuration, &budget)
    };
    let statistics = StatisticsRecord::of(&task, &report, [read_ms, ground_ms, watch.milliseconds()]);
    console.note(&statistics.line(configuration.name));
    answer.statistics = Some(statistics);

    match &report.outcome {
        Outcome::Solved(plan) => solved(arguments, &files, &task, plan, &mut answer, console),
        Outcome::Unsolvable(reason) => {
            let why = Unsolvable::of(&files.domain, &files.problem, &task, reason, &budget);
            let sentence = why.words().sentence();
            let place = Place { source: files.problem_file, span: files.problem.goal_span };
            show(&files.sources, &Finding::answer(place, format!("there is no plan: {sentence}")), console);
            why.words().lines().iter().for_each(|line| console.note(line));
            answer.unsolvable = Some(why.record(&files));
            answer.end("unsolvable", &sentence);
            console.record(&answer);
            Exit::No
        }
        Outcome::Unsupported(feature) => {
            let text = format!("this search does not support {feature}");
            let span = files.problem.metric.as_ref().map_or(files.problem.goal_span, |m| m.expression.span);
            unsupported(Place { source: files.problem_file, span }, text, &files, &mut answer, console)
        }
        Outcome::LimitReached(limit) => no_answer(limit_words(*limit), &mut answer, console),
    }
}

/// Which limit it was.
pub(crate) fn limit_words(limit: Limit) -> &'static str {
    match limit {
        Limit::Interrupted => "the time is over",
        Limit::Expansions => "as many states were expanded as allowed",
        Limit::Memory => "the memory is used up",
        Limit::Incomplete => "this search is incomplete and gave up; another one may find a plan",
    }
}

fn no_answer(limit: &str, answer: &mut Answer, console: &mut Console<'_>) -> Exit {
    answer.end("limit", limit);
    console.record(answer);
    console.note(&format!("no plan found: {limit}"));
    Exit::Limit
}

fn not_grounded(
    error: &GroundError,
    files: &TaskFiles,
    answer: &mut Answer,
    console: &mut Console<'_>,
) -> Exit {
    match error {
        GroundError::Unsupported { origin, span, .. } => {
            let source = match origin {
                Origin::Domain => files.domain_file,
                Origin::Problem => files.problem_file,
            };
            unsupported(Place { source, span: *span }, error.to_string(), files, answer, console)
        }
        GroundError::Limit { .. } | GroundError::Interrupted { .. } => {
            no_answer(&error.to_string(), answer, console)
        }
    }
}

fn unsupported(
    place: Place,
    text: String,
    files: &TaskFiles,
    answer: &mut Answer,
    console: &mut Console<'_>,
) -> Exit {
    answer.end("unsupported", &text);
    let severity = Severity::Unsupported;
    show(&files.sources, &Finding { severity, ..Finding::answer(place, text) }, console);
    console.record(answer);
    Exit::Unsupported
}

fn solved(
    arguments: &Arguments,
    files: &TaskFiles,
    task: &Task,
    found: &planner::Plan,
    answer: &mut Answer,
    console: &mut Console<'_>,
) -> Exit {
    let (mut text, plan) = written(task, found);
    answer.steps = text.lines().map(str::to_owned).collect();
    let verdict = validator::validate(&files.domain, &files.problem, &plan);
    let Verdict::Valid(valid) = verdict else {
        return bug(&verdict, &plan, &text, files, console);
    };
    let kind = CostKind::of(&files.problem);
    writeln!(text, "; cost = {} ({})", valid.cost(), kind.text()).expect("a string takes all");
    match &arguments.output {
        Some(path) => {
            if let Err(error) = files::write(path, &text) {
                render::error(error.to_string(), console);
                return Exit::Unwritable;
            }
            console.note(&format!(
                "{} steps, cost {}, written to {}",
                valid.steps,
                valid.cost(),
                path.display()
            ));
        }
        None => console.result(text.trim_end()),
    }
    if let Some(optimal) = answer.optimal {
        console.note(if optimal { "no plan is better" } else { "there may be better plans" });
    }
    answer.solved(&valid, kind, console);
    Exit::Yes
}

/// A plan as a file has it, a step a line, and as reading that file would give it.
pub(crate) fn written(task: &Task, found: &planner::Plan) -> (String, pddl::SequentialPlan) {
    let mut text = String::new();
    let mut plan = pddl::SequentialPlan::default();
    for &id in &found.operators {
        let line = task.operator_name(id);
        let start = u32::try_from(text.len()).unwrap_or(u32::MAX);
        let end = u32::try_from(text.len() + line.len()).unwrap_or(u32::MAX);
        let operator = task.operator(id);
        plan.steps.push(PlanStep {
            action: operator.action,
            arguments: operator.arguments.to_vec(),
            span: Span::new(start, end),
        });
        text.push_str(&line);
        text.push('\n');
    }
    (text, plan)
}

/// Reports a plan of the planner that is invalid. The whole plan is shown, since a bug report needs it.
fn bug(
    verdict: &Verdict,
    plan: &pddl::SequentialPlan,
    text: &str,
    files: &TaskFiles,
    console: &mut Console<'_>,
) -> Exit {
    let mut sources = files.sources.clone();
    let file = sources.push(Source::new("<plan>", text));
    if let Some(finding) = explain(&files.domain, &files.problem, plan, verdict) {
        show(&sources, &validate::answer(&finding, verdict, files, file), console);
    }
    let text = "a bug in pelea: the planner's plan is not valid, so it was not written; please report it";
    render::error(text, console);
    Exit::Bug
}

/// What a plan's cost counts.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum CostKind {
    /// Steps.
    UnitCost,
    /// The problem's metric.
    GeneralCost,
}

impl CostKind {
    fn of(problem: &Problem) -> Self {
        if problem.metric.is_some() { Self::GeneralCost } else { Self::UnitCost }
    }

    /// As plan files have it.
    const fn text(self) -> &'static str {
        match self {
            Self::UnitCost => "unit cost",
            Self::GeneralCost => "general cost",
        }
    }
}

#[derive(Serialize)]
struct Answer {
    kind: &'static str,
    outcome: &'static str,
    steps: Vec<String>,
    cost: Option<Number>,
    cost_kind: Option<CostKind>,
    search: &'static str,
    /// Whether no plan is better; where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    optimal: Option<bool>,
    /// How the old plan was repaired; where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    repair: Option<repair::RepairRecord>,
    /// The reasons for an unsolvable problem.
    #[serde(skip_serializing_if = "Option::is_none")]
    unsolvable: Option<unsolvable::UnsolvableRecord>,
    message: Option<String>,
    statistics: Option<StatisticsRecord>,
}

impl Answer {
    fn of(search: &'static str) -> Self {
        Self {
            kind: "plan",
            outcome: "limit",
            steps: Vec::new(),
            cost: None,
            cost_kind: None,
            search,
            optimal: None,
            repair: None,
            unsolvable: None,
            message: None,
            statistics: None,
        }
    }

    fn end(&mut self, outcome: &'static str, message: &str) {
        self.outcome = outcome;
        self.message = Some(message.to_owned());
    }

    fn solved(&mut self, valid: &Valid, kind: CostKind, console: &mut Console<'_>) {
        let cost: Number = valid.cost();
        self.outcome = "solved";
        self.cost = Some(cost);
        self.cost_kind = Some(kind);
        console.record(self);
    }
}

#[derive(Serialize)]
struct StatisticsRecord {
    read_ms: f64,
    ground_ms: f64,
    search_ms: f64,
    facts: usize,
    operators: usize,
    expanded: u64,
    evaluated: u64,
    generated: u64,
}

impl StatisticsRecord {
    fn of(task: &Task, report: &Report, [read_ms, ground_ms, search_ms]: [f64; 3]) -> Self {
        Self {
            read_ms,
            ground_ms,
            search_ms,
            facts: task.facts().len(),
            operators: task.operators().len(),
            expanded: report.statistics.expanded,
            evaluated: report.statistics.evaluated,
            generated: report.statistics.generated,
        }
    }

    fn line(&self, search: &str) -> String {
        format!(
            "read {} ms, ground {} ms ({} facts, {} operators), {search} {} ms ({} expanded, {} evaluated)",
            self.read_ms,
            self.ground_ms,
            self.facts,
            self.operators,
            self.search_ms,
            self.expanded,
            self.evaluated
        )
    }
}
