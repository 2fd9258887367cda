//! `:requirements`.

use std::collections::BTreeSet;

macro_rules! requirements {
    ($($(#[$doc:meta])* $variant:ident = $text:literal,)*) => {
        /// A requirement flag.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Requirement { $($(#[$doc])* $variant,)* }

        impl Requirement {
            /// Every flag.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// As written, with the colon.
            pub const fn as_str(self) -> &'static str {
                match self { $(Self::$variant => $text,)* }
            }
        }
    };
}

requirements! {
    /// Basic STRIPS.
    Strips = ":strips",
    /// Types.
    Typing = ":typing",
    /// `not` in conditions.
    NegativePreconditions = ":negative-preconditions",
    /// `or`, `imply` in conditions.
    DisjunctivePreconditions = ":disjunctive-preconditions",
    /// `=` over terms.
    Equality = ":equality",
    /// `exists`.
    ExistentialPreconditions = ":existential-preconditions",
    /// `forall` in conditions.
    UniversalPreconditions = ":universal-preconditions",
    /// Both quantifiers.
    QuantifiedPreconditions = ":quantified-preconditions",
    /// `when`.
    ConditionalEffects = ":conditional-effects",
    /// Numeric and object fluents.
    Fluents = ":fluents",
    /// Numeric fluents.
    NumericFluents = ":numeric-fluents",
    /// Object fluents.
    ObjectFluents = ":object-fluents",
    /// All of ADL.
    Adl = ":adl",
    /// Durative actions.
    DurativeActions = ":durative-actions",
    /// Duration inequalities.
    DurationInequalities = ":duration-inequalities",
    /// Continuous effects.
    ContinuousEffects = ":continuous-effects",
    /// Derived predicates.
    DerivedPredicates = ":derived-predicates",
    /// Timed initial literals.
    TimedInitialLiterals = ":timed-initial-literals",
    /// Timed initial fluents.
    TimedInitialFluents = ":timed-initial-fluents",
    /// Preferences.
    Preferences = ":preferences",
    /// Trajectory constraints.
    Constraints = ":constraints",
    /// `total-cost` alone.
    ActionCosts = ":action-costs",
    /// Goal utilities.
    GoalUtilities = ":goal-utilities",
    /// PDDL+ processes and events.
    Time = ":time",
    /// HDDL tasks and methods.
    Hierarchy = ":hierarchy",
    /// HDDL method preconditions.
    MethodPreconditions = ":method-preconditions",
    /// MA-PDDL: several agents.
    MultiAgent = ":multi-agent",
    /// MA-PDDL: one file for all agents, which declares the private symbols of each.
    UnfactoredPrivacy = ":unfactored-privacy",
    /// MA-PDDL: a file for each agent, which declares its private symbols.
    FactoredPrivacy = ":factored-privacy",
    /// Pelea's own: durative actions are agents' rules, with skills, claims, priorities and outcomes.
    AgentRules = ":agent-rules",
    /// Pelea's own: `:writes` lists the tokens that each agent may write.
    Vocabulary = ":vocabulary",
    /// Pelea's own: `:invariant` says what every run must satisfy.
    Invariants = ":invariants",
}

impl Requirement {
    /// Flags of other tools that mean the same as known flags, or nothing.
    pub const SYNONYMS: &'static [(&'static str, Self)] = &[
        (":htn", Self::Hierarchy),
        (":hierachy", Self::Hierarchy),
        (":htn-method-prec", Self::MethodPreconditions),
        (":equality-preconditions", Self::Equality),
        (":domain-axioms", Self::DerivedPredicates),
        (":axioms", Self::DerivedPredicates),
        (":true-negation", Self::NegativePreconditions),
        (":expression-evaluation", Self::Fluents),
        (":processes", Self::Time),
        (":events", Self::Time),
        (":continous-effects", Self::ContinuousEffects),
        (":duration-inequality", Self::DurationInequalities),
    ];
}

/// A set of requirement flags, as written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Requirements(pub BTreeSet<Requirement>);

impl Requirements {
    /// Whether the flag is declared.
    pub fn contains(&self, requirement: Requirement) -> bool {
        self.0.contains(&requirement)
    }
}
