//! Where a name stands in its own file.

use diagnostics::Place;
use project::Project;

use crate::entity::{occurrence_at, occurrences};
use crate::{Position, Reference};

/// Every place of the file at which the name at a position stands.
pub fn highlights(project: &Project, at: Position) -> Vec<Reference> {
    let Some(here) = occurrence_at(project, at) else { return Vec::new() };
    // In one file a name of one kind (and scope) is one thing.
    let all = occurrences(project, at.source).iter().filter(|o| o.symbol == here.symbol);
    all.map(|o| Reference { place: Place { source: at.source, span: o.span }, role: o.role }).collect()
}
