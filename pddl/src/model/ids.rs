//! The ids of everything that a domain or problem declares, each a type of its own.

use super::index::Idx;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize)]
        pub struct $name(pub u32);

        impl Idx for $name {
            fn from_index(index: usize) -> Self {
                Self(u32::try_from(index).expect("a source of less than 4 GiB declares less than 2^32 names"))
            }
            fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! {
    /// A type; `TypeId(0)` is `object`.
    TypeId;
    /// A constant of the domain (these come first) or an object of the problem.
    ObjectId;
    /// A predicate, basic or derived.
    PredicateId;
    /// A numeric or object fluent.
    FunctionId;
    /// An instantaneous action.
    ActionId;
    /// A durative action: a temporal action, an agent's rule or an intention.
    DurativeActionId;
    /// A process of PDDL+.
    ProcessId;
    /// An event of PDDL+.
    EventId;
    /// A compound task of HDDL.
    TaskId;
    /// A method of HDDL.
    MethodId;
    /// A variable of one schema: its parameters first, then every quantified one.
    VariableId;
}
