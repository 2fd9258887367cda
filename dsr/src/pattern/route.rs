//! The routes by which changes reach a pattern; `crate::routes` looks patterns up by them.

use super::clue::{Clue, Ordered, ValueKey};
use super::compiled::{Constant, Pattern};
use super::seed::{Seed, Seedling};
use crate::id::{AttributeId, LabelId, NodeId, TypeId};
use crate::state::State;

/// What a change must touch to concern a pattern: a key of the index in `crate::routes`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Route {
    /// An edge between nodes of these types, if the clue holds.
    Edge(LabelId, TypeId, TypeId, Clue),
    LabelFrom(LabelId, NodeId),
    LabelTo(LabelId, NodeId),
    Attribute(AttributeId),
    AttributeAt(AttributeId, NodeId),
    /// The attribute gets or loses this value.
    AttributeIs(AttributeId, ValueKey),
    /// The attribute crosses the number, upwards or downwards.
    Above(AttributeId, Ordered),
    Below(AttributeId, Ordered),
    Type(TypeId),
    /// The node is added or removed.
    Node(NodeId),
    /// A frame of exactly this type moves.
    MovedType(TypeId),
    Moved(NodeId),
    /// Where any frame is: listed for each pattern that measures, beside the frames that it measures.
    Transforms,
    /// Any change of a transform.
    AnyTransform,
}

impl Pattern {
    /// The routes of the pattern, with the constants resolved in this state.
    pub(crate) fn routes(&self, state: &State) -> Vec<Route> {
        let mut routes = Vec::new();
        let attribute_of = |attribute, clue| match clue {
            Clue::Is(key) => Route::AttributeIs(attribute, key),
            Clue::Above(number) => Route::Above(attribute, number),
            Clue::Below(number) => Route::Below(attribute, number),
            Clue::Any | Clue::With(..) | Clue::Beside(..) => Route::Attribute(attribute),
        };
        for &Seedling { seed, clue, .. } in &self.seeds {
            match seed {
                Seed::Edge { label, from, to } => {
                    let wanted = |slot| self.type_of(slot).unwrap_or(TypeId::OBJECT);
                    routes.push(match (self.constant(from, state), self.constant(to, state)) {
                        (Some(from), _) => Route::LabelFrom(label, from),
                        (None, Some(to)) => Route::LabelTo(label, to),
                        (None, None) => Route::Edge(label, wanted(from), wanted(to), clue),
                    });
                }
                Seed::NodeAttribute { attribute, node } => routes.push(match self.constant(node, state) {
                    Some(node) => Route::AttributeAt(attribute, node),
                    None => attribute_of(attribute, clue),
                }),
                Seed::EdgeAttribute { attribute, from, to, .. } => {
                    routes.push(match self.constant(from, state).or(self.constant(to, state)) {
                        Some(end) => Route::AttributeAt(attribute, end),
                        None => attribute_of(attribute, clue),
                    });
                }
                Seed::Loose(slot) => {
                    let wanted = self.type_of(slot);
                    let subtypes = state
                        .vocabulary
                        .types()
                        .filter(|&sub| wanted.is_some_and(|wanted| state.vocabulary.is_a(sub, wanted)));
                    routes.extend(subtypes.map(Route::Type));
                }
            }
        }
        for end in self.measured.iter().flatten() {
            match self.constant(end.slot, state) {
                Some(frame) => routes.push(Route::Moved(frame)),
                None => routes.extend(end.types.iter().map(|exact| Route::MovedType(*exact))),
            }
        }
        if !self.measured.is_empty() {
            routes.push(Route::Transforms);
        }
        routes.extend(self.constants.iter().filter_map(|constant| match constant {
            Constant::Node(id) => Some(Route::Node(*id)),
            Constant::Named(_) => None,
        }));
        routes
    }
}
