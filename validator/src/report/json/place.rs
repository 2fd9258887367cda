//! Places as JSON. Lines and columns start at 1, columns count characters, ends are exclusive.

use crate::report::finding::Place;
use crate::report::subject::Subject;
use crate::verdict::File;
use pddl::Span;
use serde::Serialize;

/// A place in a file.
#[derive(Clone, Debug, Serialize)]
pub(super) struct PlaceRecord {
    file: String,
    line: u32,
    column: u32,
    end_line: u32,
    end_column: u32,
}

pub(super) fn place_record(subject: &Subject<'_>, place: Place) -> PlaceRecord {
    let source = subject.text(place.file);
    let (start, end) = (source.line_column(place.span.start), source.line_column(place.span.end));
    PlaceRecord {
        file: source.name().to_owned(),
        line: start.line,
        column: start.column,
        end_line: end.line,
        end_column: end.column,
    }
}

pub(super) fn at(subject: &Subject<'_>, file: File, span: Span) -> Option<PlaceRecord> {
    Some(place_record(subject, Place { file, span }))
}
