//! Jobs: slow work on threads of their own, each of which can be cancelled.
//!
//! Problem: planning, reading folders and slow lints take long, and an editor wants its answer now. Idea: a
//! job gets its data by value (a project is cheap to clone) and sends news; the loop alone decides what the
//! news change. Invariant: the last news of every job is [`JobNews::Ended`], whatever happened on its
//! thread; a job that panics reports the panic first.

use crate::event::Event;
use crate::host::File;
use crate::news::{JobId, JobNews};
use budget::Cancellation;
use diagnostics::SourceId;
use lsp_server::RequestId;
use lsp_types::ProgressToken;
use rustc_hash::FxHashMap;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::SyncSender;
use std::thread::spawn;

/// The purpose of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Reading folders.
    Scan,
    /// Checking documents, in that revision.
    Check(u64),
    /// Running the slow lints, in that revision.
    Lint(u64),
    /// Planning.
    Plan(About),
    /// Validating a plan.
    Validate(About),
}

/// The documents of a task, with the number of changes of each when the job started.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct About {
    pub(crate) domain: SourceId,
    pub(crate) problem: SourceId,
    pub(crate) plan: Option<SourceId>,
    /// The number of changes of each document of the task.
    pub(crate) stamps: Vec<(SourceId, u64)>,
}

impl About {
    /// The document for a file of the task.
    pub(crate) fn source(&self, file: File) -> SourceId {
        match file {
            File::Domain => self.domain,
            File::Problem => self.problem,
            File::Plan => self.plan.unwrap_or(self.problem),
        }
    }
}

/// A running job.
#[derive(Debug)]
pub(crate) struct Running {
    pub(crate) purpose: Purpose,
    pub(crate) cancel: Cancellation,
    /// The request that its result answers.
    pub(crate) answers: Option<RequestId>,
    /// The token under which its progress is shown.
    pub(crate) token: Option<ProgressToken>,
}

/// Sends a job's news.
pub(crate) struct Reporter {
    id: JobId,
    events: SyncSender<Event>,
    cancel: Cancellation,
}

impl Reporter {
    /// Sends news.
    pub(crate) fn say(&self, news: JobNews) {
        // If the loop has ended, the news is not needed.
        let _ = self.events.send(Event::Job(self.id, news));
    }

    /// Whether the job should stop.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }
}

/// The running jobs.
pub(crate) struct Jobs {
    events: SyncSender<Event>,
    next: u32,
    running: FxHashMap<JobId, Running>,
}

impl Jobs {
    pub(crate) fn new(events: SyncSender<Event>) -> Self {
        Self { events, next: 0, running: FxHashMap::default() }
    }

    /// Starts a job.
    pub(crate) fn start(&mut self, running: Running, work: impl FnOnce(&Reporter) + Send + 'static) -> JobId {
        let id = JobId(self.next);
        self.next = self.next.wrapping_add(1);
        let reporter = Reporter { id, events: self.events.clone(), cancel: running.cancel.clone() };
        self.running.insert(id, running);
        spawn(move || {
            // The closure owns its data, and a panic drops all of it, so no half-changed state is visible.
            if let Err(panic) = catch_unwind(AssertUnwindSafe(|| work(&reporter))) {
                reporter.say(JobNews::Panicked(words_of(&*panic)));
            }
            reporter.say(JobNews::Ended);
        });
        id
    }

    /// A running job.
    pub(crate) fn get(&mut self, id: JobId) -> Option<&mut Running> {
        self.running.get_mut(&id)
    }

    /// Removes a job that has ended.
    pub(crate) fn end(&mut self, id: JobId) -> Option<Running> {
        self.running.remove(&id)
    }

    /// All running jobs.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Running> {
        self.running.values()
    }

    /// Whether a job with such a purpose is running.
    pub(crate) fn any(&self, purpose: impl Fn(&Purpose) -> bool) -> bool {
        self.running.values().any(|job| purpose(&job.purpose))
    }

    /// Cancels all jobs.
    pub(crate) fn cancel_all(&self) {
        self.iter().for_each(|job| job.cancel.cancel());
    }
}

/// The message of a panic.
pub(crate) fn words_of(panic: &(dyn Any + Send)) -> String {
    let words = panic.downcast_ref::<&str>().map(|words| (*words).to_owned());
    words.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "a panic".to_owned())
}
