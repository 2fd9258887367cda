//! The ids of a grounded task; each kind is its own type.

use pddl::model::Idx;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize)]
        pub struct $name(pub u32);

        impl Idx for $name {
            fn from_index(index: usize) -> Self {
                Self(id32(index))
            }
            fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! {
    /// A ground atom that changes: a bit of a state.
    FactId;
    /// A ground operator.
    OperatorId;
    /// A numeric fluent that changes.
    FluentId;
}

/// A state of a search; the search's registry stores its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StateId(pub(crate) u32);

/// A position as a 32-bit id. Limits on facts, operators and states keep every count far below
/// 2^32.
pub(crate) fn id32(index: usize) -> u32 {
    u32::try_from(index).expect("limits keep every count below 2^32")
}
