//! `pelea.plan` and `pelea.validate`: the commands of the lenses over problems and plans.
//!
//! Both take the URI of a document, run as jobs that can be cancelled, and answer when the job ends. A plan
//! is written to `PROBLEM.plan` beside the problem by an edit that the client applies and can undo. The
//! remarks of planner and validator are shown as diagnostics until one of the texts that they are about
//! changes.
//!
//! The answer to `pelea.plan` is `{"outcome": "solved", "plan": URI, "text": "…", "steps": 3, "cost": "3"}`, or
//! `{"outcome": "unsolvable" | "limit" | "refused", "message": "…"}`; that to `pelea.validate`
//! `{"verdict": "valid", "steps": 3, "cost": "3"}` or `{"verdict": "not-valid" | "unreadable", "message": "…"}`.

use super::Server;
use super::board::Verdict;
use crate::answers::lenses::{PLAN, VALIDATE};
use crate::answers::{diagnostics, edits};
use crate::host::{Judged, PlanOptions, Planned, Remark, Task};
use crate::job::{About, Purpose, Running};
use crate::news::{JobId, JobNews};
use crate::outbox::Asked;
use ::diagnostics::SourceId;
use budget::Cancellation;
use lsp_server::{ErrorCode, RequestId};
use lsp_types::{
    ApplyWorkspaceEditParams, ApplyWorkspaceEditRequest, CodeLensRefreshRequest, ExecuteCommandParams,
    MessageType, ProgressToken, Uri,
};
use project::FileKind;
use serde_json::{Value, json};
use std::sync::Arc;

impl Server {
    pub(crate) fn command(&mut self, id: RequestId, params: Value) {
        let params: ExecuteCommandParams = match serde_json::from_value(params) {
            Ok(params) => params,
            Err(reason) => {
                let text = format!("the parameters cannot be read: {reason}");
                return self.refuse(id, ErrorCode::InvalidParams, text);
            }
        };
        let token = params.work_done_progress_params.work_done_token;
        let document = match self.argument(params.arguments.as_deref()) {
            Ok(document) => document,
            Err(text) => return self.refuse(id, ErrorCode::InvalidParams, text),
        };
        let started = match params.command.as_str() {
            PLAN => self.start_planning(id.clone(), document, token),
            VALIDATE => self.start_validating(id.clone(), document, token),
            other => Err(format!("there is no command `{other}`")),
        };
        if let Err(text) = started {
            self.refuse(id, ErrorCode::RequestFailed, text);
        }
    }

    /// The document in the arguments of a command: `["file:///…"]` or `[{"uri": "file:///…"}]`.
    fn argument(&self, arguments: Option<&[Value]>) -> Result<SourceId, String> {
        let first = arguments.and_then(<[Value]>::first);
        let uri = first.and_then(|value| value.as_str().or_else(|| value.get("uri")?.as_str()));
        let uri = uri.ok_or("the first argument is the URI of a document")?;
        self.documents.id(&Uri(uri.to_owned())).ok_or_else(|| format!("`{uri}` is not known"))
    }

    fn start_planning(
        &mut self,
        id: RequestId,
        problem: SourceId,
        token: Option<ProgressToken>,
    ) -> Result<(), String> {
        if self.documents.project().kind(problem) != FileKind::Problem {
            return Err("only a problem can have a plan".to_owned());
        }
        let (task, about) = self.task(problem, None)?;
        let cancel = Cancellation::default();
        let options = PlanOptions {
            timeout: self.options.plan_timeout,
            search: self.options.plan_search.clone(),
            cancellation: cancel.clone(),
        };
        let title = format!("planning for {}", task.project.path(task.problem));
        let token = self.begin_progress(&title, token);
        let running = Running { purpose: Purpose::Plan(about), cancel, answers: Some(id), token };
        let tools = Arc::clone(&self.host.tools);
        self.jobs.start(running, move |reporter| reporter.say(JobNews::Planned(tools.plan(&task, &options))));
        Ok(())
    }

    fn start_validating(
        &mut self,
        id: RequestId,
        plan: SourceId,
        token: Option<ProgressToken>,
    ) -> Result<(), String> {
        let project = self.documents.project();
        if project.kind(plan) != FileKind::Plan {
            return Err("only a plan can be validated".to_owned());
        }
        let problem = project.problem_of(plan).ok_or("no problem is known for this plan")?;
        let (task, about) = self.task(problem, Some(plan))?;
        let text = self.documents.project().sources().shared(plan);
        let title = format!("validating {}", text.name());
        let token = self.begin_progress(&title, token);
        let purpose = Purpose::Validate(about);
        let running = Running { purpose, cancel: Cancellation::default(), answers: Some(id), token };
        let tools = Arc::clone(&self.host.tools);
        self.jobs.start(running, move |reporter| reporter.say(JobNews::Judged(tools.validate(&task, &text))));
        Ok(())
    }

    /// A problem with all files that it needs, from the present texts.
    fn task(&self, problem: SourceId, plan: Option<SourceId>) -> Result<(Task, About), String> {
        let project = self.documents.project();
        let domain = project.domain_of(problem).ok_or("no file defines the problem's domain")?;
        let task = Task { project: project.clone(), problem };
        let all = project.with_imports(domain).into_iter().chain([problem]).chain(plan);
        let stamps = all.map(|id| (id, self.documents.stamp(id))).collect();
        Ok((task, About { domain, problem, plan, stamps }))
    }

    /// Handles the planner's answer.
    pub(crate) fn planned(&mut self, id: JobId, planned: Planned) {
        let Some(Running { purpose: Purpose::Plan(about), answers, cancel, .. }) = self.jobs.get(id) else {
            return;
        };
        if cancel.is_cancelled() && !matches!(planned, Planned::Solved { .. }) {
            return;
        }
        let (about, request) = (about.clone(), answers.take());
        let result = match planned {
            Planned::Solved { text, steps, cost } => self.solved(&about, &text, steps, &cost),
            Planned::Unsolvable(remark) => self.unsolved("unsolvable", &about, &[remark]),
            Planned::Refused(remarks) => self.unsolved("refused", &about, &remarks),
            Planned::Unreadable => {
                let message = "the domain or the problem has errors";
                self.show(MessageType::Warning, &format!("no plan: {message}"));
                json!({"outcome": "refused", "message": message})
            }
            Planned::Limit(which) => {
                self.show(MessageType::Warning, &format!("no plan found: {which}"));
                json!({"outcome": "limit", "message": which})
            }
        };
        if let Some(request) = request {
            self.respond(request, result);
        }
    }

    fn solved(&mut self, about: &About, text: &str, steps: usize, cost: &str) -> Value {
        self.judge(about.problem, about, &[]);
        let path = plan_path(self.documents.project().path(about.problem));
        let words = format!("a plan of {}, cost {cost}", counted(steps));
        let uri = edits::uri_of_path(&self.documents, &path);
        if self.client.applies_edits {
            let edit = edits::replacing(&self.documents, &self.client, &path, text);
            let what = format!("{words}, into {path}");
            let label = Some(words.clone());
            let params = ApplyWorkspaceEditParams { label, edit, metadata: None };
            self.outbox
                .ask::<ApplyWorkspaceEditRequest>(params, Asked::ApplyEdit { what, show: uri.clone() });
        }
        self.show(MessageType::Info, &words);
        json!({"outcome": "solved", "plan": uri, "text": text, "steps": steps, "cost": cost})
    }

    fn unsolved(&mut self, outcome: &str, about: &About, remarks: &[Remark]) -> Value {
        self.judge(about.problem, about, remarks);
        let message = first(remarks);
        self.show(MessageType::Warning, &format!("no plan: {message}"));
        json!({"outcome": outcome, "message": message})
    }

    /// Handles the validator's answer.
    pub(crate) fn judged(&mut self, id: JobId, judged: Judged) {
        let Some(Running { purpose: Purpose::Validate(about), answers, .. }) = self.jobs.get(id) else {
            return;
        };
        let (about, request) = (about.clone(), answers.take());
        let plan = about.plan.unwrap_or(about.problem);
        let result = match judged {
            Judged::Valid { steps, cost } => {
                self.judge(plan, &about, &[]);
                self.show(MessageType::Info, &format!("the plan is valid: {}, cost {cost}", counted(steps)));
                json!({"verdict": "valid", "steps": steps, "cost": cost})
            }
            Judged::Not(remarks) => {
                self.judge(plan, &about, &remarks);
                let message = first(&remarks);
                self.show(MessageType::Warning, &format!("the plan is not valid: {message}"));
                json!({"verdict": "not-valid", "message": message})
            }
            Judged::Unreadable => {
                let message = "the domain, the problem or the plan has errors";
                self.show(MessageType::Warning, &format!("the plan cannot be validated: {message}"));
                json!({"verdict": "unreadable", "message": message})
            }
        };
        if let Some(request) = request {
            self.respond(request, result);
        }
    }

    /// Stores remarks about a document and the texts that it needs, and publishes them.
    fn judge(&mut self, source: SourceId, about: &About, remarks: &[Remark]) {
        let mut concerned: Vec<SourceId> = vec![source];
        let before = self.board.verdicts.get(&source).into_iter().flat_map(|verdict| &verdict.diagnostics);
        concerned.extend(before.map(|(at, _)| *at));
        let said = remarks.iter().map(|remark| {
            let at = about.source(remark.place.0);
            (at, diagnostics::of_remark(&self.documents, &self.client, about, remark))
        });
        let verdict = Verdict { diagnostics: said.collect(), about: about.clone() };
        concerned.extend(verdict.diagnostics.iter().map(|(at, _)| *at));
        self.board.verdicts.insert(source, verdict);
        concerned.sort_unstable();
        concerned.dedup();
        for source in concerned {
            self.publish(source);
        }
        if self.client.refreshes.lenses {
            self.outbox.ask::<CodeLensRefreshRequest>((), Asked::Courtesy);
        }
    }
}

/// `a/p01.plan` for `a/p01.pddl`.
fn plan_path(problem: &str) -> String {
    let (folder, name) = problem.rsplit_once('/').map_or(("", problem), |(folder, name)| (folder, name));
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let slash = if problem.contains('/') { "/" } else { "" };
    format!("{folder}{slash}{stem}.plan")
}

fn first(remarks: &[Remark]) -> String {
    remarks.first().map(|remark| remark.sentence.clone()).unwrap_or_default()
}

fn counted(steps: usize) -> String {
    if steps == 1 { "1 step".to_owned() } else { format!("{steps} steps") }
}

#[cfg(test)]
mod tests {
    use super::plan_path;

    #[test]
    fn a_plan_stands_beside_its_problem() {
        assert_eq!(plan_path("/a.b/p01.pddl"), "/a.b/p01.plan");
        assert_eq!(plan_path("/a.b/p01"), "/a.b/p01.plan");
        assert_eq!(plan_path("untitled:1"), "untitled:1.plan");
    }
}
