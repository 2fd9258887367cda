//! Where a name is used, over all files of the project.

use diagnostics::Place;
use pddl::Role;
use project::Project;

use crate::Position;
use crate::entity::entity_at;

/// Whether declarations count as references.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Declarations {
    /// They do.
    Included,
    /// They do not.
    Excluded,
}

/// A name where it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reference {
    /// Where.
    pub place: Place,
    /// Whether it declares or uses.
    pub role: Role,
}

/// Every place of the project at which the name at a position stands; `None` if there is no name.
pub fn references(project: &Project, at: Position, declarations: Declarations) -> Option<Vec<Reference>> {
    let (entity, _) = entity_at(project, at)?;
    let all = entity.occurrences(project).into_iter();
    let wanted = all.filter(|(_, o)| declarations == Declarations::Included || o.role == Role::Use);
    Some(
        wanted.map(|(source, o)| Reference { place: Place { source, span: o.span }, role: o.role }).collect(),
    )
}
