//! The case of a problem: the planner's answer compared with what is expected.
//!
//! Problem: a satisficing search proves a bound only if its plan happens to satisfy it. Idea: search quickly first; where
//! that plan exceeds a bound, search for the best one, by cost or by the number of steps (the same problem without its
//! metric). A case fails only on proof, or for lack of time. The validator, which shares no code with the planner, checks
//! every plan. Invariant: only deterministic searches are used.

use crate::expected::{Bounds, Solvable, Written};
use crate::suite::Suite;
use diagnostics::{Finding, Place, Sources};
use pddl::model::{Domain, Problem};
use pddl::{Source, Span, parse_plan};
use planner::{
    Budget, GroundError, GroundOptions, Limit, Origin, Outcome, Query, SearchConfiguration, ground, solve,
};
use project::Task;
use std::time::Duration;
use validator::{Number, Valid, Verdict, validate};

/// The planner's answer.
pub(crate) enum Answer {
    /// A valid plan, as text, and its figures.
    Plan(String, Box<Valid>),
    /// Proven to have no plan.
    Unsolvable,
    /// No answer, and why.
    Unknown(String),
    /// A feature that the planner does not support.
    Unsupported { what: String, origin: Origin, span: Span },
    /// A bug of ours.
    NotValid(String),
}

impl Suite {
    /// Runs the case of a problem.
    pub(crate) fn solvable(
        &self,
        task: &Task<'_>,
        expected: Written<Solvable>,
        timeout: Duration,
        means: &Means<'_>,
    ) -> Vec<Finding> {
        let end = (means.clock)().saturating_add(timeout);
        let over = || (means.clock)() >= end;
        let over: &(dyn Fn() -> bool + Sync) = if timeout.is_zero() { &|| true } else { &over };
        let asked = Question { task, means, over };
        let first = asked.answer(task.problem, SearchConfiguration::default());
        let finding = match (expected.value, first) {
            (Solvable::No, Answer::Unsolvable) => None,
            (Solvable::No, Answer::Plan(plan, valid)) => {
                let cost = valid.cost();
                let message = format!("expected no plan, found one that costs {cost}: {}", one_line(&plan));
                Some(self.failed(task, message, expected.span))
            }
            (Solvable::Yes(_), Answer::Unsolvable) => {
                let message = "expected a plan, found that there is none".to_owned();
                Some(self.failed(task, message, expected.span))
            }
            (Solvable::Yes(bounds), Answer::Plan(_, valid)) => {
                return self.bounds(&asked, &bounds, &valid);
            }
            (_, other) => Some(self.no_answer(task, other, expected.span, timeout)),
        };
        finding.into_iter().collect()
    }

    fn bounds(&self, asked: &Question<'_>, bounds: &Bounds, found: &Valid) -> Vec<Finding> {
        let task = asked.task;
        let mut failed = Vec::new();
        let too_dear = bounds.cost_at_most.filter(|most| found.cost() > most.value);
        if bounds.optimal_cost.is_some() || too_dear.is_some() {
            let best = asked.answer(task.problem, SearchConfiguration::best_optimal());
            for (bound, exact) in [(bounds.optimal_cost, true), (too_dear, false)] {
                let Some(Written { value, span }) = bound else { continue };
                match &best {
                    Answer::Plan(_, valid) if exact && valid.cost() == value => {}
                    Answer::Plan(_, valid) if !exact && valid.cost() <= value => {}
                    Answer::Plan(_, valid) => {
                        let most = if exact { "" } else { "at most " };
                        let message =
                            format!("expected a cheapest plan of cost {most}{value}, found {}", valid.cost());
                        failed.push(self.failed(task, message, span));
                    }
                    other => failed.push(self.unproven(task, other, "cost", found.cost(), span)),
                }
            }
        }
        if let Some(Written { value, span }) = bounds.steps_at_most
            && found.steps > value
        {
            let by_steps = Problem { metric: None, ..task.problem.clone() };
            match asked.answer(&by_steps, SearchConfiguration::best_optimal()) {
                Answer::Plan(_, valid) if valid.steps <= value => {}
                Answer::Plan(_, valid) => {
                    let message =
                        format!("expected a plan of at most {value} steps, found {} at least", valid.steps);
                    failed.push(self.failed(task, message, span));
                }
                other => {
                    let steps = Number::integer(i64::from(found.steps));
                    failed.push(self.unproven(task, &other, "number of steps", steps, span));
                }
            }
        }
        failed
    }

    fn failed(&self, task: &Task<'_>, message: String, at: Span) -> Finding {
        let place = Place { source: task.problem_file, span: task.problem.goal_span };
        Finding::error("T0303", place, message).related(self.written(at), "expected here")
    }

    fn unproven(&self, task: &Task<'_>, answer: &Answer, what: &str, found: Number, at: Span) -> Finding {
        let why = match answer {
            Answer::Unknown(why) | Answer::NotValid(why) | Answer::Unsupported { what: why, .. } => why,
            Answer::Plan(..) | Answer::Unsolvable => "the searches do not agree",
        };
        let message =
            format!("the {what} of the plan that was found is {found}, and no better one is known: {why}");
        self.failed(task, message, at)
    }

    fn no_answer(&self, task: &Task<'_>, answer: Answer, at: Span, timeout: Duration) -> Finding {
        match answer {
            Answer::Unsupported { what, origin, span } => {
                let source = match origin {
                    Origin::Domain => task.domain_file,
                    Origin::Problem => task.problem_file,
                };
                Finding::error("T0305", Place { source, span }, what)
                    .related(self.written(at), "this needs the planner")
            }
            Answer::NotValid(plan) => {
                let place = Sources::start_of(task.problem_file);
                let message = format!("a bug in pelea: the planner's plan is not valid: {}", one_line(&plan));
                Finding::error("T0306", place, message)
            }
            Answer::Unknown(why) => {
                let message = format!("no answer: {why}");
                let mut finding = self.failed(task, message, at);
                finding.code = Some("T0304");
                finding.help(format!("`timeout` allows for {} s", timeout.as_secs_f64()))
            }
            Answer::Plan(..) | Answer::Unsolvable => self.failed(task, "no answer".to_owned(), at),
        }
    }
}

/// The time since some moment; timeouts are measured with it.
pub type Clock<'a> = dyn Fn() -> Duration + Sync + 'a;

/// What a question to the planner may use.
pub(crate) struct Means<'a> {
    pub(crate) clock: &'a Clock<'a>,
    pub(crate) budget: &'a Budget<'a>,
}

/// A task to ask the planner about.
pub(crate) struct Question<'a> {
    pub(crate) task: &'a Task<'a>,
    pub(crate) means: &'a Means<'a>,
    pub(crate) over: &'a (dyn Fn() -> bool + Sync),
}

impl Question<'_> {
    pub(crate) fn answer(&self, problem: &Problem, search: SearchConfiguration) -> Answer {
        let domain: &Domain = self.task.domain;
        let given = self.means.budget;
        let interrupted = || (self.over)() || (given.interrupted)();
        let budget = Budget { interrupted: &interrupted, ..*given };
        let options = GroundOptions { budget, ..GroundOptions::default() };
        let grounded = match ground(domain, problem, &options) {
            Ok(grounded) => grounded,
            Err(error) => {
                let what = error.to_string();
                return match error {
                    GroundError::Unsupported { origin, span, .. } => {
                        Answer::Unsupported { what, origin, span }
                    }
                    GroundError::Limit { .. } | GroundError::Interrupted { .. } => Answer::Unknown(what),
                };
            }
        };
        let memory_bytes = given.memory_bytes.map(|most| most.saturating_sub(grounded.memory_bytes()));
        let budget = Budget { memory_bytes, ..budget };
        let plan = match solve(&grounded, &Query::of(&grounded), &search, &budget).outcome {
            Outcome::Solved(plan) => plan,
            Outcome::Unsolvable(_) => return Answer::Unsolvable,
            Outcome::Unsupported(feature) => return Answer::Unknown(format!("{feature} are not supported")),
            Outcome::LimitReached(limit) => {
                let why = match limit {
                    Limit::Interrupted => "the time is over",
                    Limit::Memory => "the memory is used up",
                    Limit::Expansions | Limit::Incomplete => "the search gave up",
                };
                return Answer::Unknown(why.to_owned());
            }
        };
        let text: String =
            plan.operators.iter().map(|&operator| grounded.operator_name(operator) + "\n").collect();
        let source = Source::new("<plan>", text);
        let read = parse_plan(&source, domain, problem).model.and_then(pddl::Plan::into_sequential);
        let verdict = read.map(|plan| validate(domain, problem, &plan));
        match verdict {
            Some(Verdict::Valid(valid)) => Answer::Plan(source.text().to_owned(), Box::new(valid)),
            _ => Answer::NotValid(source.text().to_owned()),
        }
    }
}

/// A plan in a sentence: its first steps.
fn one_line(plan: &str) -> String {
    const SHOWN: usize = 8;
    let steps: Vec<&str> = plan.lines().collect();
    let mut line = steps.iter().take(SHOWN).copied().collect::<Vec<_>>().join(" ");
    if steps.len() > SHOWN {
        line.push_str(&format!(" … ({} steps)", steps.len()));
    } else if steps.is_empty() {
        line.push_str("the empty plan");
    }
    line
}
