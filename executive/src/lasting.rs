//! What must outlive the process: answers, calls, deliveries.
//!
//! Problem: a robot that thanks for an answer and then loses power must not ask again. Idea: a version with such a token
//! is handed to the wheel when it is on disk. So the wheel counts nothing as achieved that could be lost, and stays a pure
//! function of what it is handed. Agents and reflexes wait for no disk.
//!
//! A disk that stalls must not stop the robot: after [`LONGEST`] the wheel goes on, and the journal reports that it lags.
//! While the shell waits, the paused clock of a simulation stands still, so a journal changes no run.

use crate::wheel::Event;
use dsr::{Change, Edit, HolderRef, LabelId, Version};
use std::pin::Pin;
use std::sync::Arc;
use std::time::Duration;
use tokio::task::spawn_blocking;
use tokio::time::timeout;

/// The longest wait for the disk.
const LONGEST: Duration = Duration::from_secs(1);

/// What must outlive the process.
#[derive(Clone, Default)]
pub struct Lasting {
    /// The labels of its tokens.
    pub labels: Vec<LabelId>,
    /// Waits until a version is on disk; called on a thread that may block. Without it nothing waits.
    pub disk: Option<Arc<dyn Fn(Version) + Send + Sync>>,
}

/// A wait for the disk.
pub(crate) type Hold = Pin<Box<dyn Future<Output = ()>>>;

impl Lasting {
    /// The version that must be on disk before this event is handed in.
    pub(crate) fn awaits(&self, event: &Event) -> Option<Version> {
        self.disk.as_ref()?;
        let Event::Changed { delta, .. } = event else { return None };
        let lasts = |change: &Change| matches!(change, Change::EdgeAdded { edge } if self.labels.contains(&edge.label));
        delta.changes.iter().any(lasts).then_some(delta.version)
    }

    /// Waits until the version is on disk.
    pub(crate) fn hold(&self, version: Version) -> Hold {
        let Some(disk) = self.disk.clone() else { return Box::pin(std::future::ready(())) };
        let waiting = spawn_blocking(move || disk(version));
        Box::pin(async move {
            if timeout(LONGEST, waiting).await.is_err() {
                tracing::warn!(
                    version = version.0,
                    "the disk is slow: the executive goes on before this is on it"
                );
            }
        })
    }

    /// Whether an edit is about a token that must last.
    pub(crate) fn is_about(&self, edit: &Edit) -> bool {
        match edit {
            Edit::AddEdge { label, .. }
            | Edit::RemoveEdge { label, .. }
            | Edit::SetAttribute { holder: HolderRef::Edge { label, .. }, .. }
            | Edit::ClearAttribute { holder: HolderRef::Edge { label, .. }, .. } => {
                self.labels.contains(label)
            }
            _ => false,
        }
    }
}

impl std::fmt::Debug for Lasting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Lasting").field("labels", &self.labels).finish_non_exhaustive()
    }
}
