//! Where a journal goes: numbered segments, one after the other.

use std::fs::File;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Takes the bytes of a journal. Called by the journal's thread only.
pub trait Store: Send + 'static {
    /// Begins the segment of that number: what is appended from now on goes there. The one before was synced.
    fn begin(&mut self, number: u64) -> io::Result<()>;
    /// Appends to the segment.
    fn append(&mut self, bytes: &[u8]) -> io::Result<()>;
    /// Returns when everything that was appended would outlive a loss of power.
    fn sync(&mut self) -> io::Result<()>;
    /// Lets go of the segments with smaller numbers.
    fn forget(&mut self, before: u64) -> io::Result<()>;
}

/// The name of a segment in a folder.
const SUFFIX: &str = "dsr";

/// The segments in a folder, by number.
pub(super) fn segments(folder: &Path) -> io::Result<Vec<(u64, PathBuf)>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let stem = path.file_stem().and_then(|stem| stem.to_str());
        let number = stem.filter(|_| path.extension().is_some_and(|e| e == SUFFIX));
        if let Some(number) = number.and_then(|number| number.parse().ok()) {
            found.push((number, path));
        }
    }
    found.sort();
    Ok(found)
}

/// A folder with a file for each segment: `00000000.dsr` and so on.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Added to the numbers: a journal that goes on leaves the files of the one before alone.
    offset: u64,
    file: Option<File>,
}

impl Folder {
    /// A folder, made if it is not there. Files of an earlier journal in it stay; this one writes behind them.
    pub fn new(path: impl Into<PathBuf>) -> io::Result<Self> {
        let path = path.into();
        std::fs::create_dir_all(&path)?;
        let offset = segments(&path)?.last().map_or(0, |(number, _)| number.saturating_add(1));
        Ok(Self { path, offset, file: None })
    }

    /// Whether no journal was there before.
    pub fn is_fresh(&self) -> bool {
        self.offset == 0
    }

    fn current(&mut self) -> io::Result<&mut File> {
        self.file.as_mut().ok_or_else(|| io::ErrorKind::NotFound.into())
    }
}

impl Store for Folder {
    fn begin(&mut self, number: u64) -> io::Result<()> {
        let name = format!("{:08}.{SUFFIX}", self.offset + number);
        self.file = Some(File::create_new(self.path.join(name))?);
        // The name of the file must outlive a loss of power, too. Not every system can sync a folder.
        if let Ok(folder) = File::open(&self.path) {
            let _ = folder.sync_all();
        }
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.current()?.write_all(bytes)
    }

    fn sync(&mut self) -> io::Result<()> {
        self.current()?.sync_data()
    }

    fn forget(&mut self, before: u64) -> io::Result<()> {
        let before = self.offset + before;
        let mut old = segments(&self.path)?.into_iter().filter(|&(number, _)| number < before);
        old.try_for_each(|(_, path)| std::fs::remove_file(path))
    }
}

/// Segments in memory: for tests, and for whoever sends them elsewhere. Clones are the same store.
#[derive(Debug, Clone, Default)]
pub struct Memory {
    segments: Arc<Mutex<Vec<Vec<u8>>>>,
}

impl Memory {
    /// The segments so far; those that were let go of are empty.
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

    fn forget(&mut self, before: u64) -> io::Result<()> {
        let mut segments = self.segments.lock().unwrap_or_else(PoisonError::into_inner);
        segments.iter_mut().enumerate().filter(|(at, _)| (*at as u64) < before).for_each(|(_, s)| s.clear());
        Ok(())
    }
}
