//! The planner and the validator as tools of the language server.

use crate::clock::{Deadline, Seconds};
use crate::memory;
use crate::plan::{Unsolvable, limit_words, written};
use ::lsp::{File, Judged, PlanOptions, Planned, Remark, Task};
use pddl::{Severity, Source, Span, parse_plan};
use planner::{
    Budget, GroundError, GroundOptions, Origin, Outcome, Query, SearchConfiguration, ground, solve,
};
use validator::{Verdict, explain, validate};

/// The planner and the validator of this workspace.
pub(super) struct Tools;

impl ::lsp::Tools for Tools {
    fn plan(&self, task: &Task, settings: &PlanOptions) -> Planned {
        let Ok(project::Task { domain, problem, .. }) = task.project.task(task.problem) else {
            return Planned::Unreadable;
        };
        let configuration = match settings.search.as_deref().map(SearchConfiguration::named) {
            None => SearchConfiguration::portfolio(),
            Some(Some(configuration)) => configuration,
            Some(None) => return Planned::Limit("there is no search of the name in `planSearch`".to_owned()),
        };
        let deadline = Deadline::after(Some(Seconds::from(settings.timeout)));
        let interrupted = || deadline.is_over() || settings.cancellation.is_cancelled();
        let memory = memory::budget();
        let budget = Budget { memory_bytes: Some(memory), interrupted: &interrupted, ..Budget::default() };
        let options = GroundOptions { budget, ..GroundOptions::default() };
        let grounded = match ground(domain, problem, &options) {
            Ok(grounded) => grounded,
            Err(error) => return not_grounded(&error),
        };
        let budget = Budget { memory_bytes: Some(memory.saturating_sub(grounded.memory_bytes())), ..budget };
        let report = solve(&grounded, &Query::of(&grounded), &configuration, &budget);
        match report.outcome {
            Outcome::Solved(found) => {
                let (text, plan) = written(&grounded, &found);
                match validate(domain, problem, &plan) {
                    Verdict::Valid(valid) => Planned::Solved {
                        text: format!("{text}; cost = {}\n", valid.cost()),
                        steps: plan.steps.len(),
                        cost: valid.cost().to_string(),
                    },
                    verdict => {
                        let why = explain(domain, problem, &plan, &verdict);
                        let why = why.map(|finding| finding.sentence).unwrap_or_default();
                        Planned::Limit(format!("a bug in pelea: the planner's plan is not valid: {why}"))
                    }
                }
            }
            Outcome::Unsolvable(reason) => {
                let why = Unsolvable::of(domain, problem, &grounded, &reason, &budget);
                let mut sentence = format!("there is no plan: {}", why.words().sentence());
                why.words().lines().iter().for_each(|line| sentence += &format!("\n{line}"));
                Planned::Unsolvable(remark(Severity::Error, sentence, (File::Problem, problem.goal_span)))
            }
            Outcome::Unsupported(feature) => Planned::Limit(format!("{feature} are not supported")),
            Outcome::LimitReached(limit) => Planned::Limit(limit_words(limit).to_owned()),
        }
    }

    fn validate(&self, task: &Task, plan: &Source) -> Judged {
        let Ok(project::Task { domain, problem, .. }) = task.project.task(task.problem) else {
            return Judged::Unreadable;
        };
        let Some(plan) = parse_plan(plan, domain, problem).model else { return Judged::Unreadable };
        let verdict = validate(domain, problem, &plan);
        if let Verdict::Valid(valid) = &verdict {
            return Judged::Valid { steps: valid.steps as usize, cost: valid.cost().to_string() };
        }
        let severity =
            if matches!(verdict, Verdict::Unsupported(_)) { Severity::Unsupported } else { Severity::Error };
        let found = explain(domain, problem, &plan, &verdict);
        let remarks = found.map(|finding| Remark {
            severity,
            sentence: finding.sentence,
            place: place(finding.place),
            notes: finding.notes.into_iter().map(|(at, text)| (place(at), text)).collect(),
        });
        Judged::Not(remarks.into_iter().collect())
    }
}

fn not_grounded(error: &GroundError) -> Planned {
    match error {
        GroundError::Unsupported { origin, span, .. } => {
            let file = match origin {
                Origin::Domain => File::Domain,
                Origin::Problem => File::Problem,
            };
            Planned::Refused(vec![remark(Severity::Unsupported, error.to_string(), (file, *span))])
        }
        GroundError::Limit { .. } | GroundError::Interrupted { .. } => Planned::Limit(error.to_string()),
    }
}

fn remark(severity: Severity, sentence: String, place: (File, Span)) -> Remark {
    Remark { severity, sentence, place, notes: Vec::new() }
}

fn place(place: validator::Place) -> (File, Span) {
    let file = match place.file {
        validator::File::Domain => File::Domain,
        validator::File::Problem => File::Problem,
        validator::File::Plan => File::Plan,
    };
    (file, place.span)
}
