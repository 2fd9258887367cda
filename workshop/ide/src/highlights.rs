//! The occurrences of a name in its own file.

use diagnostics::Place;
use project::Project;

use crate::entity::{occurrence_at, occurrences};
use crate::{Position, Reference};

/// All occurrences in the file of the name at a position.
pub fn highlights(project: &Project, at: Position) -> Vec<Reference> {
    let Some(here) = occurrence_at(project, at) else { return Vec::new() };
    // In one file, names of one kind and scope denote one thing.
    let all = occurrences(project, at.source).iter().filter(|o| o.symbol == here.symbol);
    all.map(|o| Reference { place: Place { source: at.source, span: o.span }, role: o.role }).collect()
}
