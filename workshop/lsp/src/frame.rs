//! Frames: a header, an empty line, and a body of the length in the header.
//!
//! Problem: one broken header must not end an author's session, and neither must a header that claims a huge
//! length. `lsp_server` reads frames too, but returns an error at the first broken header, which ends its
//! reader, and allocates the claimed length at once. Idea: read line by line until one has a
//! `Content-Length`, whatever came before; a body grows as it arrives. Invariant: [`Frames::next`] returns
//! after finitely many bytes, holds at most [`MAX_BODY`] of them, and fails only if the input does. Cost: a
//! copy of each body. Source: Language Server Protocol 3.17, "Base Protocol". Deviation: a bare `\n` ends a
//! line too, and unknown headers are skipped.

use std::io::{self, BufRead, Read};

/// Longest body, in bytes; larger than any document that an editor opens.
pub(crate) const MAX_BODY: usize = 256 << 20;
/// Longest line of a header, in bytes.
const MAX_LINE: u64 = 4096;
const KEY: &[u8] = b"content-length:";

/// A frame of the input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Frame {
    /// The body of one message.
    Body(Vec<u8>),
    /// A broken frame; reading continues after it.
    Broken(Broken),
}

/// What is wrong with a frame.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum Broken {
    /// A line is neither a header nor empty.
    #[error("expected a header, found `{0}`")]
    NoHeader(String),
    /// A header ends without `Content-Length`.
    #[error("a header has no Content-Length")]
    NoLength,
    /// The length is not a number, or too large.
    #[error("`{0}` is not a valid length; at most {MAX_BODY} bytes are read")]
    Length(String),
    /// The input ended before the body did.
    #[error("a message of {expected} bytes ends after {got}")]
    Truncated {
        /// The length in the header.
        expected: usize,
        /// The number of bytes in the input.
        got: usize,
    },
}

/// The frames of an input.
pub(crate) struct Frames<R> {
    input: R,
    /// Whether the reader is inside a broken part; it is reported once.
    lost: bool,
}

impl<R: BufRead> Frames<R> {
    pub(crate) fn new(input: R) -> Self {
        Self { input, lost: false }
    }

    /// The next frame; `None` at the end of the input.
    ///
    /// # Errors
    /// Those of the input.
    pub(crate) fn next(&mut self) -> io::Result<Option<Frame>> {
        let mut length = None;
        let mut headers = false;
        loop {
            let mut line = Vec::new();
            (&mut self.input).take(MAX_LINE).read_until(b'\n', &mut line)?;
            if line.is_empty() {
                return Ok(None);
            }
            let line = line.trim_ascii();
            if line.is_empty() {
                match length {
                    Some(length) => return self.body(length).map(Some),
                    // Blank lines between messages are allowed.
                    None if !headers => {}
                    None => return Ok(Some(Frame::Broken(Broken::NoLength))),
                }
                headers = false;
            } else if let Some(at) = find(line, KEY) {
                let text = String::from_utf8_lossy(line[at + KEY.len()..].trim_ascii()).into_owned();
                match text.parse() {
                    Ok(bytes) if bytes <= MAX_BODY => (length, self.lost) = (Some(bytes), false),
                    _ => {
                        self.lost = true;
                        return Ok(Some(Frame::Broken(Broken::Length(text))));
                    }
                }
            } else if line.contains(&b':') && !line.contains(&b'{') {
                headers = !self.lost;
            } else if !std::mem::replace(&mut self.lost, true) {
                let shown = String::from_utf8_lossy(line).chars().take(80).collect();
                return Ok(Some(Frame::Broken(Broken::NoHeader(shown))));
            }
        }
    }

    fn body(&mut self, expected: usize) -> io::Result<Frame> {
        let mut body = Vec::new();
        (&mut self.input).take(expected as u64).read_to_end(&mut body)?;
        let got = body.len();
        Ok(if got < expected {
            Frame::Broken(Broken::Truncated { expected, got })
        } else {
            Frame::Body(body)
        })
    }
}

/// Where `key` (in lower case) stands in `line` (in any).
fn find(line: &[u8], key: &[u8]) -> Option<usize> {
    line.windows(key.len()).position(|part| part.eq_ignore_ascii_case(key))
}

/// A message with its header.
pub(crate) fn framed(body: &[u8]) -> Vec<u8> {
    let mut frame = format!("Content-Length: {}\r\n\r\n", body.len()).into_bytes();
    frame.extend_from_slice(body);
    frame
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]
    use super::*;
    use proptest::prelude::*;
    use std::io::BufReader;

    fn all(input: &[u8]) -> Vec<Frame> {
        let mut frames = Frames::new(BufReader::with_capacity(3, input));
        std::iter::from_fn(|| frames.next().unwrap()).collect()
    }

    fn body(text: &str) -> Frame {
        Frame::Body(text.as_bytes().to_vec())
    }

    #[test]
    fn headers_in_any_order_and_case() {
        let input = b"content-type: x; charset=utf-8\r\nCONTENT-LENGTH:2\r\n\r\nab\n\nContent-Length: 1\n\nc";
        assert_eq!(all(input), [body("ab"), body("c")]);
    }

    #[test]
    fn what_is_broken_is_said_once_and_passed_over() {
        let input = b"what is\r\nthis { \r\n}Content-Length: 2\r\n\r\nab";
        assert_eq!(all(input), [Frame::Broken(Broken::NoHeader("what is".into())), body("ab")]);
        let input = b"Content-Type: x\r\n\r\nContent-Length: 2\r\n\r\nab";
        assert_eq!(all(input), [Frame::Broken(Broken::NoLength), body("ab")]);
    }

    #[test]
    fn a_length_that_is_none_allocates_nothing() {
        for length in ["-1", "99999999999999999999999", "9999999999", "0x10", ""] {
            let input = format!("Content-Length: {length}\r\n\r\nContent-Length: 1\r\n\r\nc");
            assert_eq!(all(input.as_bytes()), [Frame::Broken(Broken::Length(length.into())), body("c")]);
        }
        let input = format!("Content-Length: {MAX_BODY}\r\n\r\nabc");
        let expected = Frame::Broken(Broken::Truncated { expected: MAX_BODY, got: 3 });
        assert_eq!(all(input.as_bytes()), [expected]);
    }

    proptest! {
        #[test]
        fn what_is_framed_is_read(bodies in proptest::collection::vec(".{0,40}", 0..5)) {
            let input: Vec<u8> = bodies.iter().flat_map(|b| framed(b.as_bytes())).collect();
            let expected: Vec<Frame> = bodies.iter().map(|b| body(b)).collect();
            prop_assert_eq!(all(&input), expected);
        }

        #[test]
        fn anything_ends(input in proptest::collection::vec(any::<u8>(), 0..300)) {
            all(&input);
        }

        #[test]
        fn a_message_after_garbage_is_read(garbage in "[^:{]{1,60}\n") {
            let mut input = garbage.into_bytes();
            input.extend(framed(b"ab"));
            let read = all(&input);
            prop_assert_eq!(read.last(), Some(&body("ab")));
        }
    }
}
