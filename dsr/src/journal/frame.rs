//! Frames: records with a length and two checksums, by which damage is found and distinguished from a crash.
//!
//! A header is 28 bytes: marker, kind, length and checksum of the payload, the number of bytes of the file that
//! were known to be synced when the frame was written, and a checksum of all these. Reading does not need the
//! number of synced bytes; it helps a person who looks at a damaged disk.
//!
//! Problem: the last append before a crash may be there in part, and that is no damage; a disk, or a program,
//! may change any byte, the length of a frame included, and what is behind it must not be taken for that last
//! append. Idea: a bad frame is damage unless the bytes from it to the end of the file are what an interrupted
//! append leaves, and only that: no intact header, and either the first bytes of a frame, which ends behind the
//! end of the file, or zeros at the end of the file: blocks that a loss of power left unwritten. Headers are
//! looked for at each byte, because the length of the bad frame may be what is damaged.
//!
//! Deviation: a loss of power may also lose a block and keep a later one, neither of which was synced. That is damage
//! here: what is intact behind it must not go without an error.
//!
//! Cost: one pass over the bytes, and from a bad frame on another one, which computes the checksums of headers only:
//! lengths that lie cost nothing.

/// The marker at the start of each header.
const MARKER: [u8; 4] = [0xd5, b'D', b'S', b'R'];
/// The length of a header in bytes.
pub(super) const HEADER: usize = 28;
/// The most bytes of a payload. None longer is written, so a header with a larger number is invalid.
pub(super) const LONGEST: u32 = 1 << 30;
/// The zeros at the end of a file from which on they are unwritten blocks. Deltas that end in as many are rare.
const UNWRITTEN: [u8; 16] = [0; 16];

/// The kind of a frame's content.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// The number of the format and the vocabulary. The first frame of a segment.
    Start,
    /// A part of the state with which the segment begins.
    State,
    /// A delta. Older journals have several in one frame, which follow each other.
    Deltas,
    /// What a commit does to the registered reflexes, then its delta, which is empty if it made no version.
    Guarded,
}

impl Kind {
    const ALL: [Self; 4] = [Self::Start, Self::State, Self::Deltas, Self::Guarded];

    fn number(self) -> u32 {
        match self {
            Self::Start => 0,
            Self::State => 1,
            Self::Deltas => 2,
            Self::Guarded => 3,
        }
    }
}

/// A good frame in the bytes of a segment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) kind: Kind,
    /// Where the header begins.
    pub(super) offset: usize,
    /// Bytes of the payload. There is a frame for each commit, so a smaller number counts.
    length: u32,
}

impl Frame {
    pub(super) fn payload<'b>(&self, bytes: &'b [u8]) -> &'b [u8] {
        bytes.get(self.content()).unwrap_or(&[])
    }

    /// Where the payload is.
    pub(super) fn content(&self) -> std::ops::Range<usize> {
        self.offset + HEADER..self.end()
    }

    pub(super) fn end(&self) -> usize {
        self.offset + HEADER + self.length as usize
    }
}

/// Why the bytes after the last good frame cannot be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flaw {
    /// What an append leaves that a crash has interrupted.
    Torn(usize),
    /// Bytes that were written and have changed.
    Corrupt(usize),
    /// No byte of the file is recognised.
    Foreign,
}

/// Begins a frame at the end of the bytes; returns where. The payload is to be written behind it.
pub(super) fn open(bytes: &mut Vec<u8>) -> usize {
    let start = bytes.len();
    bytes.resize(start + HEADER, 0);
    start
}

/// Ends the frame that begins at `start`, in a segment with `synced` bytes synced.
pub(super) fn close(bytes: &mut [u8], start: usize, kind: Kind, synced: u64) {
    let (header, payload) = bytes[start..].split_at_mut(HEADER);
    let length = u32::try_from(payload.len()).expect("the writer refuses what is longer than LONGEST");
    header[..4].copy_from_slice(&MARKER);
    header[4..8].copy_from_slice(&kind.number().to_le_bytes());
    header[8..12].copy_from_slice(&length.to_le_bytes());
    header[12..16].copy_from_slice(&crc32fast::hash(payload).to_le_bytes());
    header[16..24].copy_from_slice(&synced.to_le_bytes());
    let sum = crc32fast::hash(&header[..24]);
    header[24..].copy_from_slice(&sum.to_le_bytes());
}

struct Header {
    frame: Frame,
    sum: u32,
}

fn read_header(bytes: &[u8], offset: usize) -> Option<Header> {
    let header = bytes.get(offset..offset.checked_add(HEADER)?)?;
    let number = |at: usize| header.get(at..at + 4)?.try_into().ok().map(u32::from_le_bytes);
    if header[..4] != MARKER || crc32fast::hash(&header[..24]) != number(24)? || number(8)? > LONGEST {
        return None;
    }
    let kind = Kind::ALL.into_iter().find(|kind| Some(kind.number()) == number(4))?;
    Some(Header { frame: Frame { kind, offset, length: number(8)? }, sum: number(12)? })
}

/// The good frames from the beginning, and the flaw after them, if any.
pub(super) fn scan(bytes: &[u8]) -> (Vec<Frame>, Option<Flaw>) {
    let (mut frames, mut offset) = (Vec::new(), 0);
    while offset < bytes.len() {
        let good = read_header(bytes, offset).filter(|header| {
            header.frame.end() <= bytes.len() && crc32fast::hash(header.frame.payload(bytes)) == header.sum
        });
        let Some(header) = good else { return (frames, Some(flaw(bytes, offset))) };
        frames.push(header.frame);
        offset = header.frame.end();
    }
    (frames, None)
}

/// What is wrong with the frame at `offset`.
fn flaw(bytes: &[u8], offset: usize) -> Flaw {
    let header = read_header(bytes, offset);
    let later = (offset + 1..bytes.len()).filter(|&at| bytes[at] == MARKER[0]);
    if later.filter_map(|at| read_header(bytes, at)).next().is_some() {
        return Flaw::Corrupt(offset);
    }
    let rest = &bytes[offset..];
    let is_begun = match &header {
        Some(header) => header.frame.end() > bytes.len(),
        None => rest.len() < HEADER && rest.iter().zip(MARKER).all(|(&byte, marker)| byte == marker),
    };
    if is_begun || rest.ends_with(&UNWRITTEN) || rest.iter().all(|&byte| byte == 0) {
        Flaw::Torn(offset)
    } else if offset == 0 && header.is_none() {
        Flaw::Foreign
    } else {
        Flaw::Corrupt(offset)
    }
}
