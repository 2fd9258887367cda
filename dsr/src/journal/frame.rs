//! Frames: groups of records with a length and two checksums, by which damage from a crash or a disk is found.
//!
//! A header is 28 bytes: marker, kind, length and checksum of the payload, the number of bytes of the file that were
//! known to be synced when the frame was written, and a checksum of all these. After a bad frame, the file is searched
//! for good headers. If one reports that the bad frame had been synced, the frame is corrupt; otherwise it is the torn
//! tail of a crash, even if the file system kept blocks after a lost one.
//!
//! Cost: one pass over the bytes.

/// The marker at the start of each header.
const MARKER: [u8; 4] = [0xd5, b'D', b'S', b'R'];
/// The length of a header in bytes.
pub(super) const HEADER: usize = 28;
/// The most bytes of a payload. None longer is written, so a header with a larger number is invalid.
pub(super) const LONGEST: u32 = 1 << 30;

/// The kind of a frame's content.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// The number of the format and the vocabulary. The first frame of a segment.
    Start,
    /// A part of the state with which the segment begins.
    State,
    /// Deltas that follow each other.
    Deltas,
}

impl Kind {
    const ALL: [Self; 3] = [Self::Start, Self::State, Self::Deltas];

    fn number(self) -> u32 {
        match self {
            Self::Start => 0,
            Self::State => 1,
            Self::Deltas => 2,
        }
    }
}

/// A good frame in the bytes of a segment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) kind: Kind,
    /// Where the header begins.
    pub(super) offset: usize,
    /// Bytes of the payload.
    pub(super) length: usize,
}

impl Frame {
    pub(super) fn payload<'b>(&self, bytes: &'b [u8]) -> &'b [u8] {
        let start = self.offset + HEADER;
        bytes.get(start..start + self.length).unwrap_or(&[])
    }

    /// Where the payload is.
    pub(super) fn content(&self) -> std::ops::Range<usize> {
        self.offset + HEADER..self.end()
    }

    pub(super) fn end(&self) -> usize {
        self.offset + HEADER + self.length
    }
}

/// Why the bytes after the last good frame cannot be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flaw {
    /// A frame that was being written when the process or the machine stopped.
    Torn(usize),
    /// A frame that had been synced and has changed.
    Corrupt(usize),
}

/// The header for a payload, in a segment with `synced` bytes synced.
pub(super) fn header(kind: Kind, payload: &[u8], synced: u64) -> [u8; HEADER] {
    let mut header = [0; HEADER];
    let length = u32::try_from(payload.len()).expect("the writer refuses what is longer than LONGEST");
    header[..4].copy_from_slice(&MARKER);
    header[4..8].copy_from_slice(&kind.number().to_le_bytes());
    header[8..12].copy_from_slice(&length.to_le_bytes());
    header[12..16].copy_from_slice(&crc32fast::hash(payload).to_le_bytes());
    header[16..24].copy_from_slice(&synced.to_le_bytes());
    let sum = crc32fast::hash(&header[..24]);
    header[24..].copy_from_slice(&sum.to_le_bytes());
    header
}

struct Header {
    frame: Frame,
    sum: u32,
    synced: u64,
}

fn read_header(bytes: &[u8], offset: usize) -> Option<Header> {
    let header = bytes.get(offset..offset.checked_add(HEADER)?)?;
    let number = |at: usize| header.get(at..at + 4)?.try_into().ok().map(u32::from_le_bytes);
    if header[..4] != MARKER || crc32fast::hash(&header[..24]) != number(24)? || number(8)? > LONGEST {
        return None;
    }
    let kind = Kind::ALL.into_iter().find(|kind| Some(kind.number()) == number(4))?;
    let frame = Frame { kind, offset, length: usize::try_from(number(8)?).ok()? };
    Some(Header { frame, sum: number(12)?, synced: u64::from_le_bytes(header[16..24].try_into().ok()?) })
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

/// Whether a later header reports that the bytes at `offset` had been synced.
fn flaw(bytes: &[u8], offset: usize) -> Flaw {
    let later = (offset + 1..bytes.len()).filter(|&at| bytes[at] == MARKER[0]);
    let known = later.filter_map(|at| read_header(bytes, at)).any(|header| {
        usize::try_from(header.synced).is_ok_and(|synced| synced > offset && synced <= header.frame.offset)
    });
    if known { Flaw::Corrupt(offset) } else { Flaw::Torn(offset) }
}
