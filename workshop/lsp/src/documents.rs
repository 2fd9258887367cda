//! The documents: the texts that the client has open, over the texts on the disk.
//!
//! Problem: an open document belongs to the client until it closes it, whatever the disk holds; a closed one
//! belongs to the disk; and both are in one project. Idea: a project of all texts, and beside it, by the
//! same ids, what only an editor's server needs: the starts of lines and the client's URI. Invariant: only
//! the client's notifications change the text of an open document. A document that is closed has the disk's
//! text again, or is removed. Cost of an edit: the document's length, and the project's bookkeeping.

use crate::position::{Encoding, LineIndex};
use crate::uri;
use diagnostics::{Place, SourceId};
use lsp_types::{Location, Position, Range, TextDocumentContentChangeEvent as Change, TextEdit, Uri};
use pddl::{Source, Span};
use project::Project;
use rustc_hash::FxHashMap;
use std::cell::OnceCell;

/// The client's view of an open document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Open {
    /// Its URI in the client's spelling.
    pub(crate) uri: String,
    pub(crate) version: i32,
}

#[derive(Debug, Default)]
struct Document {
    lines: OnceCell<LineIndex>,
    open: Option<Open>,
    /// The text on the disk, while the document is open.
    on_disk: Option<String>,
    /// The number of changes of the text.
    stamp: u64,
}

impl Document {
    /// Updates the index after a change of the text.
    fn renew(&mut self) {
        self.lines = OnceCell::new();
        self.stamp += 1;
    }
}

/// All documents.
#[derive(Debug, Default)]
pub(crate) struct Documents {
    project: Project,
    documents: FxHashMap<SourceId, Document>,
    pub(crate) encoding: Encoding,
}

/// A change of a piece of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Replaced {
    /// The replaced span.
    pub(crate) span: Span,
    /// The length of the new text, in bytes.
    pub(crate) length: u32,
}

impl Replaced {
    /// Moves a span along with the change; false if the change touches it.
    pub(crate) fn shift(&self, place: &mut Span) -> bool {
        if place.start >= self.span.end {
            let moved =
                |at: u32| (at - self.span.end).saturating_add(self.span.start).saturating_add(self.length);
            *place = Span::new(moved(place.start), moved(place.end.max(place.start)));
            return true;
        }
        place.end <= self.span.start
    }
}

/// The reason why a text was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum Refused {
    /// Spans are 32 bits wide.
    #[error("the text is larger than 4 GiB")]
    TooLarge,
    /// The client changes a document that is not open.
    #[error("the document is not open")]
    NotOpen,
}

impl Documents {
    /// The project of all texts.
    pub(crate) fn project(&self) -> &Project {
        &self.project
    }

    /// The number of documents, open and closed.
    pub(crate) fn len(&self) -> usize {
        self.documents.len()
    }

    /// The document with a URI of the client.
    pub(crate) fn id(&self, uri: &Uri) -> Option<SourceId> {
        self.project.id(&uri::path(uri.as_ref()))
    }

    /// The client's URI of a document.
    pub(crate) fn uri(&self, id: SourceId) -> Uri {
        match self.open(id) {
            Some(open) => Uri(open.uri.clone()),
            None => Uri(uri::uri_of(self.project.path(id))),
        }
    }

    /// The client's view of it, if it is open.
    pub(crate) fn open(&self, id: SourceId) -> Option<&Open> {
        self.documents.get(&id)?.open.as_ref()
    }

    /// The open documents, in the order of their ids.
    pub(crate) fn all_open(&self) -> Vec<SourceId> {
        let mut open: Vec<SourceId> =
            self.documents.iter().filter(|(_, d)| d.open.is_some()).map(|(id, _)| *id).collect();
        open.sort_unstable();
        open
    }

    /// Opens a document.
    ///
    /// # Errors
    /// If the text is too large.
    pub(crate) fn open_text(&mut self, uri: &str, version: i32, text: String) -> Result<SourceId, Refused> {
        let path = uri::path(uri);
        let before = self.project.id(&path).map(|id| self.project.source(id).text().to_owned());
        let id = self.put(&path, text)?;
        let document = self.documents.entry(id).or_default();
        if document.open.is_none() {
            document.on_disk = before;
        }
        document.open = Some(Open { uri: uri.to_owned(), version });
        Ok(id)
    }

    /// Applies the client's changes to a document, one after the other. Returns what each one replaced, in
    /// the same order.
    ///
    /// # Errors
    /// If the document is not open, or grows too large; it is then unchanged.
    pub(crate) fn change(
        &mut self,
        uri: &str,
        version: i32,
        changes: Vec<Change>,
    ) -> Result<(SourceId, Vec<Replaced>), Refused> {
        let path = uri::path(uri);
        let id = self.project.id(&path).filter(|&id| self.open(id).is_some()).ok_or(Refused::NotOpen)?;
        let mut text = self.project.source(id).text().to_owned();
        let mut lines = self.lines(id).clone();
        // Lines up to this one are still valid in `lines`: clients mostly send changes from the end to the
        // front.
        let mut known = u32::MAX;
        let mut replaced = Vec::with_capacity(changes.len());
        let length = |text: &str| u32::try_from(text.len()).unwrap_or(u32::MAX);
        for change in changes {
            match change {
                Change::TextDocumentContentChangeWholeDocument(whole) => {
                    let span = Span::new(0, length(&text));
                    replaced.push(Replaced { span, length: length(&whole.text) });
                    (text, known) = (whole.text, 0);
                }
                Change::TextDocumentContentChangePartial(part) => {
                    if part.range.start.max(part.range.end).line >= known {
                        lines = LineIndex::new(&text);
                    }
                    let span = lines.span(&text, part.range, self.encoding);
                    // The line of the offset, since the client's line may lie behind the end.
                    known = lines.line_of(span.start);
                    replaced.push(Replaced { span, length: length(&part.text) });
                    text.replace_range(span.range(), &part.text);
                }
            }
        }
        self.put(&path, text)?;
        if let Some(Document { open: Some(open), .. }) = self.documents.get_mut(&id) {
            open.version = version;
        }
        Ok((id, replaced))
    }

    /// Closes a document: it has the disk's text again. `None` if it was not open.
    pub(crate) fn close(&mut self, uri: &str) -> Option<SourceId> {
        let path = uri::path(uri);
        let id = self.project.id(&path)?;
        let document = self.documents.get_mut(&id)?;
        document.open.take()?;
        match document.on_disk.take() {
            Some(text) => self.put(&path, text).ok(),
            None => {
                self.documents.remove(&id);
                self.project.remove(&path)
            }
        }
    }

    /// Sets texts that are on the disk.
    pub(crate) fn found(&mut self, files: Vec<(String, String)>) {
        let mut closed = Vec::with_capacity(files.len());
        for (path, text) in files {
            if text.len() > Source::MAX_BYTES {
                continue;
            }
            match self.project.id(&path).and_then(|id| self.documents.get_mut(&id)) {
                Some(document) if document.open.is_some() => document.on_disk = Some(text),
                _ => closed.push((path, text)),
            }
        }
        closed.retain(|(path, text)| {
            self.project.id(path).is_none_or(|id| self.project.source(id).text() != text)
        });
        let changed = closed.into_iter().map(|(path, text)| Source::new(path, text));
        for id in self.project.set_all(changed) {
            self.documents.entry(id).or_default().renew();
        }
    }

    /// Removes a file that is gone from the disk.
    pub(crate) fn lost(&mut self, path: &str) {
        let Some(id) = self.project.id(path) else { return };
        match self.documents.get_mut(&id) {
            Some(document) if document.open.is_some() => document.on_disk = None,
            _ => {
                self.documents.remove(&id);
                self.project.remove(path);
            }
        }
    }

    /// Closed documents below a folder that is closed or removed.
    pub(crate) fn closed_below(&self, folder: &str) -> Vec<String> {
        let prefix = format!("{}/", folder.trim_end_matches('/'));
        let below = |id: &SourceId| self.open(*id).is_none() && self.project.path(*id).starts_with(&prefix);
        self.project.ids().filter(below).map(|id| self.project.path(id).to_owned()).collect()
    }

    fn put(&mut self, path: &str, text: String) -> Result<SourceId, Refused> {
        if text.len() > Source::MAX_BYTES {
            return Err(Refused::TooLarge);
        }
        let id = self.project.set(path, text);
        self.documents.entry(id).or_default().renew();
        Ok(id)
    }

    /// The revision of a document's text.
    pub(crate) fn stamp(&self, id: SourceId) -> u64 {
        self.documents.get(&id).map_or(0, |document| document.stamp)
    }

    fn lines(&self, id: SourceId) -> &LineIndex {
        static NONE: LineIndex = LineIndex::EMPTY;
        let text = self.text(id);
        self.documents.get(&id).map_or(&NONE, |document| document.lines.get_or_init(|| LineIndex::new(text)))
    }

    /// The text of a document.
    pub(crate) fn text(&self, id: SourceId) -> &str {
        self.project.source(id).text()
    }

    /// Converts the client's position to an offset.
    pub(crate) fn offset(&self, id: SourceId, position: Position) -> u32 {
        self.lines(id).offset(self.text(id), position, self.encoding)
    }

    /// Converts the client's range to a span.
    pub(crate) fn span(&self, id: SourceId, range: Range) -> Span {
        self.lines(id).span(self.text(id), range, self.encoding)
    }

    /// Converts a span to the client's range.
    pub(crate) fn range(&self, id: SourceId, span: Span) -> Range {
        self.lines(id).range(self.text(id), span, self.encoding)
    }

    /// The range of a whole document.
    pub(crate) fn whole(&self, id: SourceId) -> Range {
        let end = u32::try_from(self.text(id).len()).unwrap_or(u32::MAX);
        self.range(id, Span::new(0, end))
    }

    /// A place in any document.
    pub(crate) fn location(&self, place: Place) -> Location {
        Location { uri: self.uri(place.source), range: self.range(place.source, place.span) }
    }

    /// A change of a document.
    pub(crate) fn edit(&self, id: SourceId, edit: &ide::TextEdit) -> TextEdit {
        TextEdit { range: self.range(id, edit.span), new_text: edit.text.clone() }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]
    use super::*;
    use lsp_types::TextDocumentContentChangePartial;
    use proptest::prelude::*;

    const URI: &str = "file:///a/p.pddl";

    fn part(range: Range, text: &str) -> Change {
        let text = text.to_owned();
        Change::TextDocumentContentChangePartial(TextDocumentContentChangePartial {
            range,
            text,
            ..TextDocumentContentChangePartial::default()
        })
    }

    fn range(start: (u32, u32), end: (u32, u32)) -> Range {
        let position = |(line, character)| Position { line, character };
        Range { start: position(start), end: position(end) }
    }

    #[test]
    fn an_open_document_is_the_clients() {
        let mut documents = Documents::default();
        documents.found(vec![("/a/p.pddl".into(), "disk".into())]);
        let id = documents.open_text(URI, 1, "one".into()).unwrap();
        documents.found(vec![("/a/p.pddl".into(), "disk again".into())]);
        assert_eq!(documents.text(id), "one");
        documents.change(URI, 2, vec![part(range((0, 0), (0, 1)), "O")]).unwrap();
        assert_eq!((documents.text(id), documents.open(id).unwrap().version), ("One", 2));
        assert_eq!(documents.close(URI), Some(id));
        assert_eq!(documents.text(id), "disk again");
        assert_eq!(documents.change(URI, 3, vec![]), Err(Refused::NotOpen));
        documents.lost("/a/p.pddl");
        assert_eq!(documents.id(&Uri(URI.into())), None);
    }

    #[test]
    fn a_document_that_is_no_file_is_gone_when_closed() {
        let mut documents = Documents::default();
        let id = documents.open_text("untitled:1", 1, "one".into()).unwrap();
        assert_eq!(documents.uri(id), Uri("untitled:1".into()));
        assert!(documents.close("untitled:1").is_some());
        assert_eq!((documents.close("untitled:1"), documents.len()), (None, 0));
    }

    #[test]
    fn places_move_with_the_text() {
        let change = Replaced { span: Span::new(4, 6), length: 5 };
        for (before, after) in
            [((0, 4), Some((0, 4))), ((6, 8), Some((9, 11))), ((3, 5), None), ((5, 9), None)]
        {
            let mut span = Span::new(before.0, before.1);
            let kept = change.shift(&mut span);
            assert_eq!(kept.then_some((span.start, span.end)), after);
        }
    }

    /// Applying changes in any order equals applying them one after the other to the plain text.
    fn check(text: &str, changes: &[(Range, String)]) {
        for encoding in [Encoding::Utf8, Encoding::Utf16, Encoding::Utf32] {
            let mut documents = Documents { encoding, ..Documents::default() };
            let id = documents.open_text(URI, 1, text.to_owned()).unwrap();
            let all = changes.iter().map(|(range, text)| part(*range, text)).collect();
            documents.change(URI, 2, all).unwrap();
            let mut plain = text.to_owned();
            for (range, with) in changes {
                let span = LineIndex::new(&plain).span(&plain, *range, encoding);
                plain.replace_range(span.range(), with);
            }
            assert_eq!(documents.text(id), plain);
        }
    }

    proptest! {
        #[test]
        fn changes_are_made_one_after_the_other(
            text in "[a😀é\r\n]{0,20}",
            changes in proptest::collection::vec(
                (((0u32..6, 0u32..8), (0u32..6, 0u32..8)), "[b😀\r\n]{0,3}"), 0..6),
        ) {
            let changes: Vec<_> =
                changes.into_iter().map(|((start, end), text)| (range(start, end), text)).collect();
            check(&text, &changes);
        }
    }
}
