//! The case of a plan: the verdict compared with what is expected.

use crate::Fault;
use crate::expected::{Verdict as Wanted, Why};
use crate::found::{Found, place};
use crate::suite::{PlanCase, Suite};
use diagnostics::{Finding, SourceId};
use pddl::Span;
use project::Task;

impl Suite {
    /// Runs the case of a plan.
    pub(crate) fn plan(&self, task: &Task<'_>, file: SourceId, case: &PlanCase) -> Vec<Finding> {
        let found = self.found(task, file);
        let Some(at) = self.difference(file, case, &found) else { return Vec::new() };
        let expected = describe_wanted(case);
        let message = format!("expected {expected}, found {}", found.describe());
        let mut finding = match &found {
            Found::Valid { .. } => Finding::error("T0302", place(file, Span::default()), message),
            Found::Invalid { says, .. } | Found::Unreadable { says, .. } | Found::Unsupported { says } => {
                let mut finding = Finding::error("T0302", says.place, message);
                finding.related.push((says.place, says.sentence.clone()));
                finding.related.extend(says.notes.iter().cloned());
                finding
            }
        };
        if let Some(at) = at {
            finding.related.push((self.written(at), "expected here".to_owned()));
        }
        if let (Found::Unreadable { errors, .. }, Wanted::Invalid, None) =
            (&found, case.verdict, &case.details.why)
            && let Some((code, _)) = errors.first()
        {
            let word = Fault::of_code(code).map_or(*code, Fault::word);
            finding.help = Some(format!("if a plan that cannot be read is meant, write `why = \"{word}\"`"));
        }
        vec![finding]
    }

    /// Where what was found is not what was expected: `Some`, with the place in `expected.toml` if there is one.
    fn difference(&self, file: SourceId, case: &PlanCase, found: &Found) -> Option<Option<Span>> {
        let details = &case.details;
        if let Found::Invalid { says, .. } | Found::Unreadable { says, .. } = found
            && case.verdict == Wanted::Invalid
            && let Some(unsaid) = details.says.iter().find(|wanted| !says.says(&wanted.value))
        {
            return Some(Some(unsaid.span));
        }
        match (case.verdict, found) {
            (Wanted::Valid, Found::Valid { cost }) => {
                let wrong = details.cost.filter(|wanted| wanted.value != *cost)?;
                Some(Some(wrong.span))
            }
            (Wanted::Unsupported, Found::Unsupported { .. }) => None,
            (Wanted::Invalid, Found::Invalid { fault, step, missing, says }) => {
                if let Some(why) = details.why.as_ref().filter(|w| w.value != Why::Fault(*fault)) {
                    return Some(Some(why.span));
                }
                if let Some(wrong) = details.step.filter(|wanted| Some(u64::from(wanted.value)) != *step) {
                    return Some(Some(wrong.span));
                }
                let line = (says.place.source == file)
                    .then(|| self.source(file).line_column(says.place.span.start).line);
                if let Some(wrong) = details.line.filter(|wanted| Some(wanted.value) != line) {
                    return Some(Some(wrong.span));
                }
                details.missing.iter().find(|wanted| !missing.contains(&wanted.value)).map(|w| Some(w.span))
            }
            (Wanted::Invalid, Found::Unreadable { errors, .. }) => {
                let Some(why) = &details.why else { return Some(case.entry) };
                let fits = |code: &str| match &why.value {
                    Why::Code(wanted) => wanted == code,
                    Why::Fault(wanted) => Fault::of_code(code) == Some(*wanted),
                };
                if !errors.iter().all(|(code, _)| fits(code)) {
                    return Some(Some(why.span));
                }
                if let Some(wrong) =
                    details.line.filter(|wanted| errors.iter().all(|(_, line)| *line != wanted.value))
                {
                    return Some(Some(wrong.span));
                }
                let none = details.step.map(|s| s.span).or(details.missing.first().map(|m| m.span));
                none.map(Some)
            }
            _ => Some(case.entry),
        }
    }
}

fn describe_wanted(case: &PlanCase) -> String {
    let details = &case.details;
    let mut more = Vec::new();
    more.extend(details.cost.map(|cost| format!("cost {}", cost.value)));
    more.extend(details.why.as_ref().map(|why| match &why.value {
        Why::Fault(fault) => fault.to_string(),
        Why::Code(code) => code.clone(),
    }));
    more.extend(details.step.map(|step| format!("step {}", step.value)));
    more.extend(details.line.map(|line| format!("line {}", line.value)));
    more.extend(details.missing.iter().map(|literal| format!("missing {}", literal.value)));
    more.extend(details.says.iter().map(|text| format!("saying `{}`", text.value)));
    with_details(case.verdict.word(), &more)
}

impl Found {
    /// `invalid (precondition, step 2, missing (free))`
    pub(crate) fn describe(&self) -> String {
        match self {
            Self::Valid { cost } => with_details("valid", &[format!("cost {cost}")]),
            Self::Invalid { fault, step, missing, .. } => {
                let mut more = vec![fault.to_string()];
                more.extend(step.map(|step| format!("step {step}")));
                more.extend(missing.iter().map(|literal| format!("missing {literal}")));
                with_details("invalid", &more)
            }
            Self::Unreadable { errors, .. } => {
                let errors: Vec<_> =
                    errors.iter().map(|(code, line)| format!("{code} at line {line}")).collect();
                with_details("a text that is no plan", &errors)
            }
            Self::Unsupported { .. } => "unsupported".to_owned(),
        }
    }
}

fn with_details(word: &str, details: &[String]) -> String {
    if details.is_empty() { word.to_owned() } else { format!("{word} ({})", details.join(", ")) }
}
