//! All uses of a name, over all files of the project.

use diagnostics::Place;
use pddl::Role;
use project::Project;

use crate::Position;
use crate::entity::entity_at;

/// Whether declarations count as references.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Declarations {
    /// Yes.
    Included,
    /// No.
    Excluded,
}

/// A reference to a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reference {
    /// Its place.
    pub place: Place,
    /// Whether it is a declaration or a use.
    pub role: Role,
}

/// All references to the name at a position; `None` if no name stands there.
pub fn references(project: &Project, at: Position, declarations: Declarations) -> Option<Vec<Reference>> {
    let (entity, _) = entity_at(project, at)?;
    let all = entity.occurrences(project).into_iter();
    let wanted = all.filter(|(_, o)| declarations == Declarations::Included || o.role == Role::Use);
    Some(
        wanted.map(|(source, o)| Reference { place: Place { source, span: o.span }, role: o.role }).collect(),
    )
}
