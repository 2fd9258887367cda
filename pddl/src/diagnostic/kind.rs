//! Every kind of diagnostic with its fields, its code, its sentence and its help.

use crate::model::Name;
use crate::occurrence::NameKind;

use diagnostics::Severity;

/// The kind of thing that a name was read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SymbolKind {
    /// A type.
    Type,
    /// A predicate.
    Predicate,
    /// A function.
    Function,
    /// A constant or an object.
    Object,
    /// A variable.
    Variable,
    /// An action, durative or not.
    Action,
    /// A compound task.
    Task,
    /// A compound task or an action.
    TaskOrAction,
    /// A method.
    Method,
    /// A subtask's id.
    Subtask,
    /// A predicate, function or type, as a token of the graph.
    Token,
    /// A domain to import.
    Domain,
    /// A requirement flag.
    Requirement,
    /// A preference.
    Preference,
    /// A process.
    Process,
    /// An event.
    Event,
    /// An invariant.
    Invariant,
    /// An action or a task of a hierarchical plan, by its number.
    PlanStep,
}

impl SymbolKind {
    /// The kind of name that this would be; `None` if the section determines it.
    pub(crate) fn name_kind(self) -> Option<NameKind> {
        Some(match self {
            Self::Predicate | Self::Token => NameKind::Predicate,
            Self::Function => NameKind::Function,
            Self::Object => NameKind::Object,
            Self::Action => NameKind::Action,
            Self::Task | Self::TaskOrAction => NameKind::Task,
            Self::Method => NameKind::Method,
            Self::Type
            | Self::Variable
            | Self::Subtask
            | Self::Domain
            | Self::Requirement
            | Self::Preference
            | Self::Process
            | Self::Event
            | Self::Invariant
            | Self::PlanStep => return None,
        })
    }
}

impl std::fmt::Display for SymbolKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Type => "type",
            Self::Predicate => "predicate",
            Self::Function => "function",
            Self::Object => "object",
            Self::Variable => "variable",
            Self::Action => "action",
            Self::Task => "task",
            Self::TaskOrAction => "task or action",
            Self::Method => "method",
            Self::Subtask => "subtask",
            Self::Token => "token",
            Self::Domain => "domain",
            Self::Requirement => "requirement",
            Self::PlanStep => "number",
            Self::Preference => "preference",
            Self::Process => "process",
            Self::Event => "event",
            Self::Invariant => "invariant",
        })
    }
}

/// The kind of definition that a source should hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FileKind {
    /// `(define (domain …) …)`
    Domain,
    /// `(define (problem …) …)`
    Problem,
}

impl FileKind {
    /// The kind of the definition's name.
    pub(crate) fn name_kind(self) -> NameKind {
        match self {
            Self::Domain => NameKind::Domain,
            Self::Problem => NameKind::Problem,
        }
    }
}

impl std::fmt::Display for FileKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Domain => "domain",
            Self::Problem => "problem",
        })
    }
}

/// A language feature that is read but not modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum UnsupportedFeature {
    /// `(probabilistic 0.5 …)`, `(oneof …)` as effects (PPDDL)
    UncertainEffects,
    /// `(oneof …)`, `(unknown …)`, `(or …)` in `:init`
    UncertainInitialStates,
    /// `:observe` of actions
    Observations,
    /// `:goal-reward`, `:goal-probability` (PPDDL)
    Rewards,
    /// `:safety` (PDDL 1.2)
    SafetyConditions,
    /// `:expansion`, `:only-in-expansions` of actions (PDDL 1.2)
    Expansions,
    /// `:situation` of problems (PDDL 1.2)
    Situations,
    /// `(^ 2 3)`, `(sin 1)`
    Operators,
}

impl std::fmt::Display for UnsupportedFeature {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::UncertainEffects => "probabilistic and non-deterministic effects",
            Self::UncertainInitialStates => "uncertain initial states",
            Self::Observations => "observations (`:observe`)",
            Self::Rewards => "rewards and probabilities of goals",
            Self::SafetyConditions => "safety conditions (`:safety`)",
            Self::Expansions => "expansions of actions",
            Self::Situations => "initial situations that stand elsewhere (`:situation`)",
            Self::Operators => "operators other than `+`, `-`, `*` and `/`",
        })
    }
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DiagnosticKind {
    /// A `(` without its `)`.
    #[error("this parenthesis is never closed")]
    UnclosedParenthesis,
    /// A `)` without its `(`.
    #[error("this parenthesis closes nothing")]
    UnmatchedParenthesis,
    /// Lists that are nested too deep.
    #[error("lists are nested more than {limit} deep")]
    NestingTooDeep {
        /// The greatest depth that is read.
        limit: usize,
    },
    /// No `(define (domain …))` in the file.
    #[error("this is not a {expected}")]
    NotADefinition {
        /// The kind of definition that was expected.
        expected: FileKind,
    },
    /// `domain x { … }`
    #[error("this is RDDL, another language, and not PDDL")]
    OtherLanguage,
    /// A plan file with text that is not a step.
    #[error("this is not a plan")]
    NotAPlan,
    /// Unexpected text.
    #[error("expected {expected}, found {found}")]
    Unexpected {
        /// The text, shortened.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
    /// A required part is missing.
    #[error("{owner} has no {what}")]
    Missing {
        /// The definition without it.
        owner: String,
        /// The missing part.
        what: &'static str,
    },
    /// `(:akshun …)`
    #[error("unknown section `{name}`")]
    UnknownSection {
        /// As written.
        name: String,
        /// A section with a similar spelling.
        suggestion: Option<String>,
    },
    /// `:prekondition`
    #[error("unknown key `{name}` in {owner}")]
    UnknownKey {
        /// As written.
        name: String,
        /// The kind of definition.
        owner: &'static str,
        /// A key with a similar spelling.
        suggestion: Option<String>,
    },
    /// A section or key that is repeated.
    #[error("`{name}` stands here a second time")]
    Repeated {
        /// The section or key.
        name: String,
    },
    /// Text behind the definition or the plan.
    #[error("this text follows the end and is not read")]
    TrailingText,
    /// A plan file without any text.
    #[error("this file is empty: it is read as the plan without steps")]
    EmptyPlan,

    /// `(:private (p ?x))`
    #[error("privacy is ignored: all agents know this, and the plan is made for all of them together")]
    PrivacyIgnored,

    /// An undeclared name.
    #[error("unknown {symbol} `{name}`")]
    Unknown {
        /// What it should be.
        symbol: SymbolKind,
        /// As written.
        name: String,
        /// A declared name that is spelled alike.
        suggestion: Option<String>,
    },
    /// A name declared twice.
    #[error("{symbol} `{name}` is declared twice")]
    Duplicate {
        /// What it is.
        symbol: SymbolKind,
        /// Which.
        name: Name,
    },
    /// The same declaration twice.
    #[error("{symbol} `{name}` is declared twice, in the same way")]
    Redundant {
        /// What it is.
        symbol: SymbolKind,
        /// Which.
        name: Name,
    },
    /// An object of several types, one after the other.
    #[error("object `{name}` is declared twice, with different types: it has both")]
    SeveralTypes {
        /// Which.
        name: Name,
    },
    /// A declaration that differs from an imported one.
    #[error("{symbol} `{name}` is declared differently in `{import}`")]
    ImportConflict {
        /// What it is.
        symbol: SymbolKind,
        /// Which.
        name: Name,
        /// The imported domain.
        import: Name,
    },
    /// The problem names another domain.
    #[error("this problem is for domain `{found}`, but it is read with domain `{expected}`")]
    OtherDomain {
        /// Named by the problem.
        found: Name,
        /// Given.
        expected: Name,
    },

    /// Too many or too few arguments.
    #[error("{symbol} `{name}` takes {expected} argument{}, {found} given", if *expected == 1 { "" } else { "s" })]
    WrongArity {
        /// What is applied.
        symbol: SymbolKind,
        /// Which.
        name: Name,
        /// How many it takes.
        expected: usize,
        /// How many stand here.
        found: usize,
        /// Its declaration.
        signature: String,
    },
    /// An argument of a wrong type.
    #[error(
        "argument {position} of `{name}` must be of type {expected}, but `{argument}` is of type {found}"
    )]
    WrongType {
        /// What is applied.
        name: Name,
        /// Which argument, from 1.
        position: usize,
        /// As written.
        argument: String,
        /// The declared type.
        expected: String,
        /// The argument's type.
        found: String,
    },
    /// A value of a wrong type for a fluent, or a comparison of what can never be equal.
    #[error(
        "`{left}` is of type {left_type} and `{right}` of type {right_type}: they have nothing in common"
    )]
    NothingInCommon {
        /// One side as written.
        left: String,
        /// Its type.
        left_type: String,
        /// The other side as written.
        right: String,
        /// Its type.
        right_type: String,
    },
    /// Types that are their own supertypes.
    #[error("cyclic types: {}", path(cycle))]
    CyclicTypes {
        /// From a type up to itself.
        cycle: Vec<Name>,
    },
    /// An object fluent where a number belongs, or the other way round.
    #[error("function `{name}` yields {found}, but {expected} is needed here")]
    WrongValue {
        /// Which function.
        name: Name,
        /// What it yields.
        found: &'static str,
        /// What is needed.
        expected: &'static str,
    },
    /// An effect on a derived predicate.
    #[error("`{name}` is derived by an axiom and cannot be an effect")]
    DerivedEffect {
        /// Which predicate.
        name: Name,
    },

    /// Subtasks that wait for each other.
    #[error("cyclic ordering: {}", path(cycle))]
    CyclicOrdering {
        /// From a subtask to itself.
        cycle: Vec<Name>,
    },

    /// `(at strat …)`
    #[error("`at {name}` is not a time: outcomes other than `start` and `end` need `:agent-rules`")]
    UnknownTime {
        /// What stands behind `at`.
        name: String,
    },
    /// `(at abort …)` in a condition.
    #[error("`at {name}` is an outcome: only effects have outcomes")]
    OutcomeInCondition {
        /// Which.
        name: String,
    },
    /// A key or section of ours without its requirement.
    #[error("`{name}` needs the requirement `{requirement}`")]
    NeedsRequirement {
        /// What needs it.
        name: String,
        /// Which.
        requirement: &'static str,
    },

    /// `-1: (a)`, `0: (a) [-1]`
    #[error("a {what} cannot be negative: {value}")]
    NegativeTime {
        /// Time or duration.
        what: &'static str,
        /// As written.
        value: crate::Decimal,
    },
    /// `2: (a)` and then `1: (b)`
    #[error("step {number} comes after step {before}: steps are executed in the order of the file")]
    StepOutOfOrder {
        /// The later one's number.
        number: crate::Decimal,
        /// The earlier one's.
        before: crate::Decimal,
    },
    /// A preference below `or`, `not`, `when` or another preference, or in a condition without preferences.
    #[error("a preference cannot stand here")]
    MisplacedPreference,
    /// `(always (p))` in a precondition.
    #[error("`{operator}` is about all states of a plan, and this is a condition on one")]
    MisplacedOperator {
        /// Which.
        operator: String,
    },
    /// `(:constraints (p))`
    #[error("this does not say in which states it must hold")]
    BareCondition,
    /// `(increase (f) (* #t #t))`
    #[error("this is not a rate times `#t`")]
    NotLinear,
    /// `(p (f a))` in an initial state, or as an argument of a task or a skill.
    #[error("`{name}` is a function, and only objects can be arguments here")]
    MisplacedFunction {
        /// Which function.
        name: Name,
    },
    /// `(is-violated p)` in a precondition.
    #[error("`{name}` has a meaning only in {place}")]
    OutOfPlace {
        /// What.
        name: String,
        /// Where it has one.
        place: &'static str,
    },

    /// A part of the language that no model holds.
    #[error("{feature} are read but not supported")]
    Unsupported {
        /// Which.
        feature: UnsupportedFeature,
    },
}

fn path(names: &[Name]) -> String {
    let parts: Vec<String> = names.iter().map(|n| format!("`{n}`")).collect();
    parts.join(" → ")
}

impl DiagnosticKind {
    /// Stable code.
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnclosedParenthesis => "E0101",
            Self::UnmatchedParenthesis => "E0102",
            Self::NestingTooDeep { .. } => "E0103",
            Self::NotADefinition { .. } | Self::OtherLanguage | Self::NotAPlan => "E0104",
            Self::Unexpected { .. } => "E0105",
            Self::Missing { .. } => "E0106",
            Self::UnknownSection { .. } => "E0107",
            Self::UnknownKey { .. } => "E0108",
            Self::Repeated { .. } => "E0109",
            Self::TrailingText => "W0110",
            Self::EmptyPlan => "W0111",
            Self::PrivacyIgnored => "W0112",
            Self::Unknown { symbol, .. } => match symbol {
                SymbolKind::Type => "E0201",
                SymbolKind::Predicate => "E0202",
                SymbolKind::Function => "E0203",
                SymbolKind::Object => "E0204",
                SymbolKind::Variable => "E0205",
                SymbolKind::Action => "E0206",
                SymbolKind::Task => "E0207",
                SymbolKind::TaskOrAction => "E0208",
                SymbolKind::Method => "E0209",
                SymbolKind::Subtask => "E0210",
                SymbolKind::Token => "E0211",
                SymbolKind::Domain => "E0212",
                SymbolKind::Requirement => "W0213",
                SymbolKind::PlanStep => "E0214",
                SymbolKind::Preference => "W0215",
                // Nothing names them, so none is unknown.
                SymbolKind::Process | SymbolKind::Event | SymbolKind::Invariant => "E0206",
            },
            Self::Duplicate { .. } => "E0220",
            Self::ImportConflict { .. } => "E0221",
            Self::Redundant { .. } => "W0222",
            Self::OtherDomain { .. } => "W0223",
            Self::SeveralTypes { .. } => "W0224",
            Self::WrongArity { .. } => "E0301",
            Self::WrongType { .. } => "E0302",
            Self::NothingInCommon { .. } => "E0303",
            Self::CyclicTypes { .. } => "E0304",
            Self::WrongValue { .. } => "E0305",
            Self::DerivedEffect { .. } => "E0306",
            Self::MisplacedFunction { .. } => "E0307",
            Self::CyclicOrdering { .. } => "E0401",
            Self::UnknownTime { .. } => "E0501",
            Self::OutcomeInCondition { .. } => "E0502",
            Self::NeedsRequirement { .. } => "E0503",
            Self::NegativeTime { .. } => "E0504",
            Self::StepOutOfOrder { .. } => "E0505",
            Self::MisplacedPreference => "E0506",
            Self::MisplacedOperator { .. } => "E0507",
            Self::BareCondition => "E0508",
            Self::OutOfPlace { .. } => "E0509",
            Self::NotLinear => "E0510",
            Self::Unsupported { .. } => "U0601",
        }
    }

    /// How bad it is: the code's first letter.
    pub fn severity(&self) -> Severity {
        match self.code().as_bytes()[0] {
            b'W' => Severity::Warning,
            b'U' => Severity::Unsupported,
            _ => Severity::Error,
        }
    }

    /// What would be right.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Unknown { suggestion: Some(name), .. }
            | Self::UnknownSection { suggestion: Some(name), .. }
            | Self::UnknownKey { suggestion: Some(name), .. } => Some(format!("did you mean `{name}`?")),
            Self::NotAPlan => Some("a plan is a list of steps such as `(action object)`".into()),
            Self::NotADefinition { expected } => {
                Some(format!("a file of this kind is `(define ({expected} NAME) …)`"))
            }
            Self::Unknown { symbol: SymbolKind::Variable, .. } => {
                Some("declare it in `:parameters`, or bind it with `forall` or `exists`".into())
            }
            Self::WrongArity { signature, .. } => Some(format!("declared as `{signature}`")),
            Self::MisplacedPreference => {
                Some("preferences stand at the top, below `and` and `forall` only".into())
            }
            Self::MisplacedOperator { .. } => Some("put it into `(:constraints …)`".into()),
            Self::BareCondition => {
                Some("write `(always …)`, `(sometime …)` or `(at end …)` around it".into())
            }
            Self::UnknownTime { .. } => {
                Some("write `(at start …)`, `(over all …)` or `(at end …)` around it".into())
            }
            Self::NeedsRequirement { requirement, .. } => {
                Some(format!("add `{requirement}` to `(:requirements …)`"))
            }
            _ => None,
        }
    }
}
