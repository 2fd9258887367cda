//! Stores: where a journal goes, as numbered segments.
//!
//! Invariant: in a [`Folder`], a file has the name of a segment only once a whole state is synced in it; until then its
//! name ends in `.part`. So a start that dies, or finds the disk full, never replaces segments that can be read.

use std::fs::File;
use std::io::{self, Write as _};
use std::num::NonZeroU64;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Takes the bytes of a journal. Called by the journal's thread only.
pub trait Store: Send + 'static {
    /// Begins the segment of that number, to which later appends go. The previous one is synced.
    fn begin(&mut self, number: u64) -> io::Result<()>;
    /// Appends to the segment.
    fn append(&mut self, bytes: &[u8]) -> io::Result<()>;
    /// Returns when everything that was appended would survive a loss of power. The first sync after `begin` comes when
    /// the state with which the segment begins is complete.
    fn sync(&mut self) -> io::Result<()>;
    /// Deletes the oldest segments, including those of earlier journals in the same place, until `count` are left.
    /// Called when the first state of the newest segment is synced. A segment without a whole state does not count and
    /// is always deleted.
    fn keep(&mut self, newest: NonZeroU64) -> io::Result<()>;
}

/// The name of a segment in a folder.
fn name(number: u64) -> String {
    format!("{number:08}.dsr")
}

/// The suffix of a segment's name until its state is synced.
const PART: &str = ".part";

/// The stage of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Stage {
    /// Its state may be torn, or is being written at this moment. Also that of bytes without such a name.
    Part,
    /// Its state is synced.
    Whole,
}

/// The segments in a folder, by number. Files with other names are not segments: `0.dsr` may be a user's copy.
fn staged(folder: &Path) -> io::Result<Vec<(u64, Stage, PathBuf)>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let Some(file) = path.file_name().and_then(|file| file.to_str()) else { continue };
        let (stem, stage) = file.strip_suffix(PART).map_or((file, Stage::Whole), |stem| (stem, Stage::Part));
        let number = stem.strip_suffix(".dsr").and_then(|number| number.parse().ok());
        if let Some(number) = number.filter(|&number| stem == name(number)) {
            found.push((number, stage, path));
        }
    }
    found.sort();
    Ok(found)
}

/// The segments in a folder, by number, including those that were only begun: after a crash, one may have a whole state
/// but not yet its final name.
pub(super) fn segments(folder: &Path) -> io::Result<Vec<(Stage, PathBuf)>> {
    Ok(staged(folder)?.into_iter().map(|(_, stage, path)| (stage, path)).collect())
}

/// Removes a file, if it still exists.
fn remove(path: &Path) -> io::Result<()> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Syncs the names in a folder, which must survive a loss of power, too. Not every system supports it.
fn sync_names(folder: &Path) {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    if let Ok(folder) = File::open(here) {
        let _ = folder.sync_all();
    }
}

/// A folder with a file for each segment: `00000000.dsr` and so on, `00000000.dsr.part` until its state is synced.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// An offset for the numbers, so that a new journal does not overwrite the files of an earlier one.
    offset: u64,
    file: Option<File>,
    /// The number of the segment that does not have its final name yet.
    part: Option<u64>,
}

impl Folder {
    /// Opens a folder, or creates it. The files of earlier journals in it stay, up to the limit of
    /// [`Settings::segments`](super::Settings::segments); the new journal continues their numbers.
    pub fn new(path: impl Into<PathBuf>) -> io::Result<Self> {
        let path = path.into();
        let made = path.ancestors().take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
        let made = made.map(Path::to_owned).collect::<Vec<_>>();
        std::fs::create_dir_all(&path)?;
        made.iter().filter_map(|folder| folder.parent()).for_each(sync_names);
        let offset = staged(&path)?.last().map_or(0, |(number, ..)| number.saturating_add(1));
        Ok(Self { path, offset, file: None, part: None })
    }

    /// Whether the folder had no journal before.
    pub fn is_fresh(&self) -> bool {
        self.offset == 0
    }

    fn part_of(&self, number: u64) -> PathBuf {
        self.path.join(name(number) + PART)
    }

    fn current(&mut self) -> io::Result<&mut File> {
        self.file.as_mut().ok_or_else(|| io::ErrorKind::NotFound.into())
    }
}

impl Store for Folder {
    fn begin(&mut self, number: u64) -> io::Result<()> {
        let number = self.offset.checked_add(number).ok_or(io::ErrorKind::FileTooLarge)?;
        let whole = self.path.join(name(number));
        let part = self.part_of(number);
        let file = File::create_new(&part)?;
        // Look for another journal in this folder after this one has taken its number, so that two cannot miss each
        // other.
        if whole.exists() {
            remove(&part)?;
            return Err(io::ErrorKind::AlreadyExists.into());
        }
        (self.file, self.part) = (Some(file), Some(number));
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.current()?.write_all(bytes)
    }

    fn sync(&mut self) -> io::Result<()> {
        self.current()?.sync_data()?;
        if let Some(number) = self.part {
            std::fs::rename(self.part_of(number), self.path.join(name(number)))?;
            self.part = None;
            sync_names(&self.path);
        }
        Ok(())
    }

    fn keep(&mut self, newest: NonZeroU64) -> io::Result<()> {
        let segments = staged(&self.path)?;
        let whole = segments.iter().filter(|(_, stage, _)| *stage == Stage::Whole).count();
        let mut surplus = surplus(whole, newest);
        for (_, stage, path) in &segments {
            match stage {
                Stage::Part => remove(path)?,
                Stage::Whole if surplus > 0 => {
                    remove(path)?;
                    surplus -= 1;
                }
                Stage::Whole => {}
            }
        }
        Ok(())
    }
}

/// The number of segments above the limit.
fn surplus(segments: usize, kept: NonZeroU64) -> usize {
    segments.saturating_sub(usize::try_from(kept.get()).unwrap_or(usize::MAX))
}

/// Segments in memory: for tests, and for programs that send them elsewhere. Clones are the same store.
#[derive(Debug, Clone, Default)]
pub struct Memory {
    segments: Arc<Mutex<Vec<Vec<u8>>>>,
}

impl Memory {
    /// The segments so far; deleted ones are empty.
    pub fn segments(&self) -> Vec<Vec<u8>> {
        self.segments.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Store for Memory {
    fn begin(&mut self, _number: u64) -> io::Result<()> {
        self.segments.lock().unwrap_or_else(PoisonError::into_inner).push(Vec::new());
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut segments = self.segments.lock().unwrap_or_else(PoisonError::into_inner);
        let last = segments.last_mut().ok_or(io::ErrorKind::NotFound)?;
        last.extend_from_slice(bytes);
        Ok(())
    }

    fn sync(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn keep(&mut self, newest: NonZeroU64) -> io::Result<()> {
        let mut segments = self.segments.lock().unwrap_or_else(PoisonError::into_inner);
        let surplus = surplus(segments.len(), newest);
        segments[..surplus].iter_mut().for_each(|segment| *segment = Vec::new());
        Ok(())
    }
}
