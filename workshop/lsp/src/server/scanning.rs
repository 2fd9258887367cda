//! Reading the folders that the client has open.
//!
//! Problem: a domain that is not open still gives meaning to the names in an open problem, but a folder may
//! hold a hundred thousand files. Idea: a job walks breadth first, so that files near the top come first,
//! and stops at the limits of the options with a message. Invariant: each folder is entered once, since
//! links to folders are not followed.

use super::Server;
use crate::host::{Disk, Entry, ReadError};
use crate::job::{Purpose, Reporter, Running};
use crate::news::JobNews;
use crate::options::Options;
use budget::Cancellation;
use lsp_types::{DidChangeWatchedFilesParams, DidChangeWorkspaceFoldersParams, FileChangeType, FileEvent};
use project::FileKind;
use std::collections::VecDeque;
use std::sync::Arc;

/// Folders that hold no sources of the author.
const PASSED_OVER: [&str; 3] = ["node_modules", "target", "__pycache__"];
/// Most folders that are entered.
const FOLDERS: usize = 50_000;
/// Most bytes of text of closed files.
const BYTES: usize = 256 << 20;
/// Files in one batch: links between files are made once for each batch.
const BATCH: usize = 512;

impl Server {
    /// Starts to read folders.
    pub(crate) fn scan(&mut self, folders: Vec<String>) {
        let folders: Vec<String> = folders.into_iter().filter(|folder| crate::uri::is_file(folder)).collect();
        if folders.is_empty() {
            return;
        }
        let walk = Walk {
            disk: Arc::clone(&self.host.disk),
            left: self.options.max_files.saturating_sub(self.documents.len()),
            options: self.options.clone(),
            bytes: BYTES,
            batch: Vec::new(),
            too_large: 0,
        };
        let token = self.begin_progress("reading PDDL files", None);
        let running =
            Running { purpose: Purpose::Scan, cancel: Cancellation::default(), answers: None, token };
        self.jobs.start(running, move |reporter| walk.run(folders, reporter));
    }

    /// Handles a batch of files.
    pub(crate) fn found(&mut self, files: Vec<(String, String)>) {
        self.documents.found(files);
        self.changed();
    }

    /// Handles opened and closed folders.
    pub(crate) fn folders_changed(&mut self, params: &DidChangeWorkspaceFoldersParams) {
        for gone in &params.event.removed {
            let folder = crate::uri::path(gone.uri.as_ref());
            self.folders.retain(|other| *other != folder);
            self.lose_below(&folder);
        }
        let added: Vec<String> =
            params.event.added.iter().map(|folder| crate::uri::path(folder.uri.as_ref())).collect();
        self.folders.extend(added.iter().cloned());
        self.changed();
        self.scan(added);
    }

    /// Handles files that have changed on the disk.
    pub(crate) fn files_changed(&mut self, params: DidChangeWatchedFilesParams) {
        let mut found = Vec::new();
        for FileEvent { uri, kind } in params.changes {
            let path = crate::uri::path(uri.as_ref());
            if kind == FileChangeType::Deleted {
                self.documents.lost(&path);
                // The path may be that of a folder.
                self.lose_below(&path);
            } else if FileKind::is_source(&path) {
                match self.host.disk.read(&path, self.options.max_file_bytes) {
                    Ok(text) => found.push((path, text)),
                    Err(_) => self.documents.lost(&path),
                }
            }
        }
        self.found(found);
    }

    fn lose_below(&mut self, folder: &str) {
        for path in self.documents.closed_below(folder) {
            self.documents.lost(&path);
        }
    }
}

struct Walk {
    disk: Arc<dyn Disk>,
    options: Options,
    /// The number of files that may still be read.
    left: usize,
    /// The number of bytes that may still be read.
    bytes: usize,
    batch: Vec<(String, String)>,
    too_large: usize,
}

impl Walk {
    fn run(mut self, folders: Vec<String>, reporter: &Reporter) {
        let mut folders: VecDeque<String> = folders.into();
        let mut entered = 0;
        let mut files = 0;
        while let Some(folder) = folders.pop_front() {
            entered += 1;
            if reporter.is_cancelled() {
                return;
            }
            if entered > FOLDERS || self.left == 0 || self.bytes == 0 {
                let limits = format!(
                    "pelea reads at most {} files and {} MiB of them in the open folders; names in others are not known. \
                     The option `maxFiles` raises the first",
                    self.options.max_files,
                    BYTES >> 20
                );
                reporter.say(JobNews::Trouble(limits));
                break;
            }
            for entry in self.disk.list(&folder) {
                let name = match &entry {
                    Entry::File(name) | Entry::Folder(name) => name,
                };
                let path = format!("{}/{name}", folder.trim_end_matches('/'));
                match entry {
                    Entry::Folder(name) if !passed_over(&name) => folders.push_back(path),
                    Entry::File(_) if FileKind::is_source(&path) && self.left > 0 => {
                        files += usize::from(self.file(path));
                        if self.batch.len() >= BATCH {
                            reporter.say(JobNews::Found(std::mem::take(&mut self.batch)));
                            reporter.say(JobNews::Progress(format!("{files} files")));
                        }
                    }
                    Entry::Folder(_) | Entry::File(_) => {}
                }
            }
        }
        reporter.say(JobNews::Found(self.batch));
        if self.too_large > 0 {
            let large = format!(
                "pelea has not read {} files that are larger than {} bytes; the option `maxFileBytes` changes that",
                self.too_large, self.options.max_file_bytes
            );
            reporter.say(JobNews::Trouble(large));
        }
    }

    /// Whether it was read.
    fn file(&mut self, path: String) -> bool {
        let limit = self.options.max_file_bytes.min(self.bytes as u64);
        match self.disk.read(&path, limit) {
            Ok(text) => {
                self.left -= 1;
                self.bytes = self.bytes.saturating_sub(text.len());
                self.batch.push((path, text));
                true
            }
            Err(ReadError::TooLarge(_)) => {
                self.too_large += 1;
                false
            }
            Err(ReadError::Unreadable(_)) => false,
        }
    }
}

fn passed_over(folder: &str) -> bool {
    folder.starts_with('.') || PASSED_OVER.contains(&folder)
}
