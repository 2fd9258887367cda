//! Work that must not keep the loop waiting: each on a thread of its own, with a switch to stop it.
//!
//! Problem: planning, reading folders and slow lints take as long as they take, and an editor wants its answer
//! now. Idea: a job gets what it needs by value (a project is cheap to clone) and sends news; the loop alone decides
//! what they change. Invariant: the last news of every job is [`JobNews::Ended`], whatever happened on its
//! thread; a job that panics says so first.

use crate::event::Event;
use crate::host::{Cancel, File};
use crate::news::{JobId, JobNews};
use diagnostics::SourceId;
use lsp_server::RequestId;
use lsp_types::ProgressToken;
use rustc_hash::FxHashMap;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::SyncSender;
use std::thread::spawn;

/// What a job is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Reading folders.
    Scan,
    /// Finding what is wrong with documents, as they were in that revision.
    Check(u64),
    /// Warning of modelling mistakes, likewise.
    Lint(u64),
    /// A plan.
    Plan(About),
    /// A verdict on a plan.
    Validate(About),
}

/// The texts that a task was made of, and how often each had changed by then.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct About {
    pub(crate) domain: SourceId,
    pub(crate) problem: SourceId,
    pub(crate) plan: Option<SourceId>,
    /// Of all documents that took part.
    pub(crate) stamps: Vec<(SourceId, u64)>,
}

impl About {
    /// The document that planner or validator means.
    pub(crate) fn source(&self, file: File) -> SourceId {
        match file {
            File::Domain => self.domain,
            File::Problem => self.problem,
            File::Plan => self.plan.unwrap_or(self.problem),
        }
    }
}

/// A job that has not ended.
#[derive(Debug)]
pub(crate) struct Running {
    pub(crate) purpose: Purpose,
    pub(crate) cancel: Cancel,
    /// The request that its result answers.
    pub(crate) answers: Option<RequestId>,
    /// Where its progress is shown.
    pub(crate) token: Option<ProgressToken>,
}

/// Sends a job's news.
pub(crate) struct Reporter {
    id: JobId,
    events: SyncSender<Event>,
    cancel: Cancel,
}

impl Reporter {
    /// Says something.
    pub(crate) fn say(&self, news: JobNews) {
        // If the loop has ended, nobody needs to know.
        let _ = self.events.send(Event::Job(self.id, news));
    }

    /// Whether to stop.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }
}

/// The jobs that have not ended.
pub(crate) struct Jobs {
    events: SyncSender<Event>,
    next: u32,
    running: FxHashMap<JobId, Running>,
}

impl Jobs {
    pub(crate) fn new(events: SyncSender<Event>) -> Self {
        Self { events, next: 0, running: FxHashMap::default() }
    }

    /// Starts one.
    pub(crate) fn start(&mut self, running: Running, work: impl FnOnce(&Reporter) + Send + 'static) -> JobId {
        let id = JobId(self.next);
        self.next = self.next.wrapping_add(1);
        let reporter = Reporter { id, events: self.events.clone(), cancel: running.cancel.clone() };
        self.running.insert(id, running);
        spawn(move || {
            // What the work holds is dropped with it, and nobody else sees it half done.
            if let Err(panic) = catch_unwind(AssertUnwindSafe(|| work(&reporter))) {
                reporter.say(JobNews::Panicked(words_of(&*panic)));
            }
            reporter.say(JobNews::Ended);
        });
        id
    }

    /// A job that has not ended.
    pub(crate) fn get(&mut self, id: JobId) -> Option<&mut Running> {
        self.running.get_mut(&id)
    }

    /// Takes a job out that has ended.
    pub(crate) fn end(&mut self, id: JobId) -> Option<Running> {
        self.running.remove(&id)
    }

    /// Those that have not ended.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Running> {
        self.running.values()
    }

    /// Whether one with such a purpose runs.
    pub(crate) fn any(&self, purpose: impl Fn(&Purpose) -> bool) -> bool {
        self.running.values().any(|job| purpose(&job.purpose))
    }

    /// Stops all.
    pub(crate) fn cancel_all(&self) {
        self.iter().for_each(|job| job.cancel.cancel());
    }
}

/// What a panic says.
pub(crate) fn words_of(panic: &(dyn Any + Send)) -> String {
    let words = panic.downcast_ref::<&str>().map(|words| (*words).to_owned());
    words.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "a panic".to_owned())
}
