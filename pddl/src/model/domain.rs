//! Domains.
//!
//! Beyond PDDL, a domain may `(:import a b)`: it then declares the types, constants, predicates and
//! functions of the named domains too (ids are this domain's own; names link them). A vocabulary
//! (requirement `:vocabulary`) lists the tokens that each agent may write: `(:writes speech (is ?r speaking)
//! (finish ?r speaking) said)`.

use super::{
    Action, ActionId, CompoundTask, Condition, Constraints, DurativeAction, DurativeActionId, Event, EventId,
    Expression, FunctionId, IndexVec, Invariant, Method, MethodId, Name, Object, ObjectId, PredicateId,
    Process, ProcessId, Requirements, TaskId, TypeId, TypeSet, TypeTable, VariableId, Variables,
};
use crate::Span;

/// A predicate.
#[derive(Clone, Debug)]
pub struct Predicate {
    /// Its name.
    pub name: Name,
    /// Its typed parameters.
    pub variables: Variables,
    /// Whether an axiom derives it.
    pub derived: bool,
    /// Where it was declared.
    pub span: Span,
}

/// The kind of value of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FunctionValue {
    /// A number.
    Number,
    /// An object.
    Object(TypeSet),
}

/// A function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its name.
    pub name: Name,
    /// Its typed parameters.
    pub variables: Variables,
    /// The kind of its value.
    pub value: FunctionValue,
    /// Where it was declared.
    pub span: Span,
}

/// `(:derived (p ?x) body)`. The head's arguments are the parameters, in order.
#[derive(Clone, Debug)]
pub struct Axiom {
    /// The derived predicate.
    pub predicate: PredicateId,
    /// Parameters and quantified variables.
    pub variables: Variables,
    /// The condition under which it holds.
    pub body: Condition,
    /// The whole definition.
    pub span: Span,
}

/// `(:derived (f ?x) value)`: a numeric fluent that is computed from the state.
#[derive(Clone, Debug)]
pub struct DerivedFunction {
    /// The function; its arguments are the parameters, in order.
    pub function: FunctionId,
    /// Parameters and bound variables.
    pub variables: Variables,
    /// Its value.
    pub value: DerivedValue,
    /// The whole definition.
    pub span: Span,
}

/// The value of a derived function.
#[derive(Clone, Debug)]
pub enum DerivedValue {
    /// A numeric expression.
    Expression(Expression),
    /// `(count (?y - t) condition)`: how many bindings of these slots satisfy the condition.
    Count(Vec<VariableId>, Condition),
}

/// The symbol of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TokenSymbol {
    /// An edge label.
    Predicate(PredicateId),
    /// An attribute.
    Function(FunctionId),
    /// The nodes of a type.
    Type(TypeId),
}

/// Tokens of one symbol; `None` stands for any argument.
#[derive(Clone, Debug)]
pub struct TokenPattern {
    /// Which symbol.
    pub symbol: TokenSymbol,
    /// Fixed arguments; empty means any.
    pub arguments: Vec<Option<ObjectId>>,
    /// Where it stands.
    pub span: Span,
}

/// The tokens that an agent may write.
#[derive(Clone, Debug)]
pub struct Permission {
    /// The agent's name.
    pub agent: Name,
    /// The tokens.
    pub tokens: Vec<TokenPattern>,
    /// The whole section.
    pub span: Span,
}

/// A domain.
#[derive(Clone, Debug)]
pub struct Domain {
    /// Its name.
    pub name: Name,
    /// Its flags.
    pub requirements: Requirements,
    /// Names of imported domains.
    pub imports: Vec<Name>,
    /// Its types.
    pub types: TypeTable,
    /// Its constants.
    pub constants: IndexVec<ObjectId, Object>,
    /// Its predicates.
    pub predicates: IndexVec<PredicateId, Predicate>,
    /// Its functions.
    pub functions: IndexVec<FunctionId, Function>,
    /// Its instantaneous actions.
    pub actions: IndexVec<ActionId, Action>,
    /// Its durative actions, rules and intentions.
    pub durative_actions: IndexVec<DurativeActionId, DurativeAction>,
    /// Its processes.
    pub processes: IndexVec<ProcessId, Process>,
    /// Its events.
    pub events: IndexVec<EventId, Event>,
    /// Its axioms.
    pub axioms: Vec<Axiom>,
    /// Its numeric fluents that are computed from the state.
    pub derived_functions: Vec<DerivedFunction>,
    /// Its constraints on every plan.
    pub constraints: Constraints,
    /// What every run must satisfy, whatever is planned (requirement `:invariants`).
    pub invariants: Vec<Invariant>,
    /// Its compound tasks.
    pub tasks: IndexVec<TaskId, CompoundTask>,
    /// Its methods.
    pub methods: IndexVec<MethodId, Method>,
    /// The tokens that each agent may write.
    pub permissions: Vec<Permission>,
    /// Facts that hold in the initial state of every problem (`:timeless` of PDDL 1.2).
    pub timeless: Vec<super::Fact>,
    /// Language features that are read but not modelled, with their places; a command that needs the whole
    /// meaning names them and refuses.
    pub unsupported: Vec<crate::Diagnostic>,
}

impl Domain {
    /// The predicate of that name.
    pub fn predicate(&self, name: &str) -> Option<PredicateId> {
        self.predicates.enumerate().find(|(_, p)| &*p.name == name).map(|(id, _)| id)
    }

    /// The function of that name.
    pub fn function(&self, name: &str) -> Option<FunctionId> {
        self.functions.enumerate().find(|(_, f)| &*f.name == name).map(|(id, _)| id)
    }

    /// The constant of that name.
    pub fn constant(&self, name: &str) -> Option<ObjectId> {
        self.constants.enumerate().find(|(_, o)| &*o.name == name).map(|(id, _)| id)
    }

    /// The action of that name.
    pub fn action(&self, name: &str) -> Option<ActionId> {
        self.actions.enumerate().find(|(_, a)| &*a.name == name).map(|(id, _)| id)
    }

    /// The durative action of that name.
    pub fn durative_action(&self, name: &str) -> Option<DurativeActionId> {
        self.durative_actions.enumerate().find(|(_, a)| &*a.name == name).map(|(id, _)| id)
    }

    /// The compound task of that name.
    pub fn task(&self, name: &str) -> Option<TaskId> {
        self.tasks.enumerate().find(|(_, t)| &*t.name == name).map(|(id, _)| id)
    }
}
