//! Names of types, labels and resources for errors; the number where the vocabulary does not know the id.

use std::sync::Arc;

use crate::id::{LabelId, ResourceId, TypeId};
use crate::state::State;

pub(super) fn type_name(state: &State, id: TypeId) -> Arc<str> {
    state.vocabulary.type_name(id).cloned().unwrap_or_else(|| id.to_string().into())
}

pub(super) fn label_name(state: &State, id: LabelId) -> Arc<str> {
    state.vocabulary.label_name(id).cloned().unwrap_or_else(|| id.to_string().into())
}

pub(super) fn resource_name(state: &State, id: ResourceId) -> Arc<str> {
    state.vocabulary.resource_name(id).cloned().unwrap_or_else(|| id.to_string().into())
}
