//! What there is to say about a plan, as data.

use crate::cause::Cause;
use crate::expression::NumericFault;
use crate::htn::NetworkFault;
use crate::number::Number;
use crate::preference::Violations;
use crate::state::GroundAtom;
use crate::trajectory::Breach;
use crate::words::File;
use pddl::model::{
    Comparison, EventId, GroundApplication, Name, ObjectId, Objective, PredicateId, VariableId,
};
use pddl::{HierarchicalPlan, Span};

/// A step's position in the plan, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StepIndex(pub u32);

impl StepIndex {
    /// As people count: from 1.
    pub fn number(self) -> u64 {
        u64::from(self.0) + 1
    }
}

/// The outcome of validating a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every step can be taken and the goal holds in the end.
    Valid(Valid),
    /// It is not a plan for the problem.
    Invalid(Failure),
    /// The task uses a feature whose meaning this crate does not know. Nothing was checked.
    Unsupported(Unsupported),
    /// The task has no meaning. Nothing was checked.
    IllFormed(IllFormed),
}

impl Verdict {
    /// Whether the plan is valid.
    pub fn is_valid(&self) -> bool {
        matches!(self, Self::Valid(_))
    }
}

/// A valid plan's figures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Valid {
    /// Its length.
    pub steps: u32,
    /// When its last step ends, in seconds; `None` for a plan without times.
    pub makespan: Option<Number>,
    /// The metric, if the problem has one with a value in the last state.
    pub metric: Option<MetricValue>,
    /// The preferences that it does not satisfy.
    pub violations: Violations,
    /// How the steps come out of the problem's task network, if the plan did not say so and it was found.
    pub decomposition: Option<Box<HierarchicalPlan>>,
}

impl Valid {
    /// What the plan costs: the metric where there is one, otherwise how long it takes, or its length.
    pub fn cost(&self) -> Number {
        let length = self.makespan.unwrap_or(Number::integer(i64::from(self.steps)));
        self.metric.map_or(length, |metric| metric.value)
    }
}

/// What the problem's metric comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MetricValue {
    /// Which way it should go.
    pub objective: Objective,
    /// Its value.
    pub value: Number,
}

/// Why a plan is not valid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// A step is not an instance of an action. (A plan that was read from text has none.)
    Step {
        /// Which one.
        step: StepIndex,
        /// What is wrong with it.
        fault: StepFault,
    },
    /// A step cannot be taken, started or ended.
    Precondition {
        /// Which one, and which end of it.
        at: Cause,
        /// What its condition lacks; spans are of the domain.
        parts: Vec<Unsatisfied>,
    },
    /// A step takes too long or too short.
    Duration {
        /// Which one.
        step: StepIndex,
        /// How long it takes, in seconds.
        actual: Number,
        /// How it must compare …
        comparison: Comparison,
        /// … with what.
        bound: Operand,
        /// Where that is asked for, in the domain.
        span: Span,
    },
    /// What must hold all the time that a step takes does not.
    Invariant {
        /// Which step.
        step: StepIndex,
        /// A time at which it does not hold, in seconds.
        time: Number,
        /// What it lacks; spans are of the domain.
        parts: Vec<Unsatisfied>,
    },
    /// Two things happen at once, and what they do or need depends on their order.
    Interference {
        /// One.
        first: Cause,
        /// The other.
        second: Cause,
        /// What they disagree about.
        over: Shared,
    },
    /// Something that can happen has no result.
    Effect {
        /// What.
        at: Cause,
        /// Why; spans are of the domain.
        fault: EffectFault,
    },
    /// Fluents that change continuously have no values.
    Change {
        /// From when on, in seconds.
        time: Number,
        /// Why; spans are of the domain.
        fault: ChangeFault,
    },
    /// Events cause each other without end, at one time.
    EndlessEvents {
        /// When, in seconds.
        time: Number,
        /// One of them.
        event: EventId,
    },
    /// The states that the plan goes through break a constraint.
    Constraint {
        /// Whether the domain or the problem has it.
        file: File,
        /// The constraint, without `and` and `forall` around it.
        span: Span,
        /// How it is broken.
        breach: Breach,
        /// When, in seconds or steps; `None` if it is nowhere satisfied.
        time: Option<Number>,
        /// The values of the variables around it.
        binding: Vec<(Name, ObjectId)>,
        /// How many times there are at which it is broken, as far as single states are at fault.
        states: usize,
        /// The first of them, in seconds or steps.
        times: Vec<Number>,
        /// What the state that is named, or the last one where something never came, lacks; empty where no single
        /// condition says it.
        parts: Vec<Unsatisfied>,
    },
    /// The plan does not come out of the problem's task network.
    Network {
        /// Why.
        fault: NetworkFault,
    },
    /// The goal does not hold in the end.
    Goal {
        /// What it lacks; spans are of the problem.
        parts: Vec<Unsatisfied>,
    },
}

/// What two simultaneous happenings disagree about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shared {
    /// An atom that one changes and the other needs or changes the other way.
    Atom(GroundAtom),
    /// A fluent that one changes and the other reads or changes.
    Fluent(GroundApplication),
    /// A derived predicate that one needs and that depends on what the other changes.
    Derived {
        /// What is needed.
        predicate: PredicateId,
        /// What is changed.
        atom: GroundAtom,
    },
}

/// Why continuous change has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ChangeFault {
    /// A value cannot be computed.
    Numeric(NumericFault),
    /// A rate depends on itself: the change is no polynomial of time.
    NotPolynomial {
        /// The fluent.
        fluent: GroundApplication,
        /// Its rate.
        span: Span,
    },
    /// Processes begin and end without end, at one time.
    Unsteady,
    /// Something is divided by what changes: the result is no polynomial of time.
    NotPolynomialExpression {
        /// The division.
        span: Span,
    },
}

/// Why a step is not an instance of an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepFault {
    /// There is no such action.
    UnknownAction,
    /// The number of arguments is wrong.
    Arity {
        /// Parameters of the action.
        expected: usize,
        /// Arguments of the step.
        found: usize,
    },
    /// A durative action has no duration.
    NoDuration,
    /// An argument is not of its parameter's type.
    Type {
        /// The parameter.
        parameter: VariableId,
        /// The argument.
        object: ObjectId,
    },
}

/// Why effects have no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EffectFault {
    /// Two effects give a fluent different values.
    Conflict {
        /// The fluent.
        fluent: GroundApplication,
        /// One effect.
        first: Span,
        /// The other.
        second: Span,
    },
    /// A value cannot be computed.
    Numeric(NumericFault),
}

/// One smallest unsatisfied part of a condition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unsatisfied {
    /// An atom should hold.
    Missing {
        /// Which one.
        atom: GroundAtom,
        /// What deleted it last; `None` if it never held.
        deleted_by: Option<Cause>,
        /// Whether an axiom would have to derive it.
        derived: bool,
        /// What the axiom lacks that is nearest to deriving it; spans are of the domain.
        because: Vec<Unsatisfied>,
        /// Where it is asked for.
        span: Span,
    },
    /// An atom should not hold.
    Present {
        /// Which one.
        atom: GroundAtom,
        /// What added it last; `None` if it held from the beginning, or follows by an axiom.
        added_by: Option<Cause>,
        /// Whether an axiom derives it.
        derived: bool,
        /// What would have to be otherwise for it not to follow; spans are of the domain.
        because: Vec<Unsatisfied>,
        /// Where it is forbidden.
        span: Span,
    },
    /// An object should be of a type, or should not.
    Type {
        /// The object.
        object: ObjectId,
        /// The type, or several of which one is enough.
        types: pddl::model::TypeSet,
        /// Whether it should be.
        wanted: bool,
        /// Where that is asked for.
        span: Span,
    },
    /// Two objects should be the same.
    Different {
        /// One.
        left: ObjectId,
        /// The other.
        right: ObjectId,
        /// Where that is asked for.
        span: Span,
    },
    /// Two objects should be different.
    Same {
        /// The object that both are.
        object: ObjectId,
        /// Where that is forbidden.
        span: Span,
    },
    /// A comparison fails, or cannot be made.
    Comparison {
        /// The comparison.
        comparison: Comparison,
        /// Whether it should be true.
        wanted: bool,
        /// Its left side.
        left: Operand,
        /// Its right side.
        right: Operand,
        /// Where it stands.
        span: Span,
    },
    /// An object fluent has the wrong value.
    Fluent {
        /// Which one.
        fluent: GroundApplication,
        /// The object that it should be, or should not be.
        value: ObjectId,
        /// Whether it should.
        wanted: bool,
        /// What it is; `None` is undefined.
        actual: Option<ObjectId>,
        /// Where it stands.
        span: Span,
    },
    /// None of several alternatives holds.
    Alternatives {
        /// What each lacks. No alternative at all is `(or)`.
        branches: Vec<Vec<Unsatisfied>>,
        /// The disjunction.
        span: Span,
    },
    /// Something should be so for all objects, and is not for these.
    Counterexample {
        /// The quantified variables' values.
        binding: Vec<(Name, ObjectId)>,
        /// What is wrong with them.
        parts: Vec<Unsatisfied>,
        /// The quantifier.
        span: Span,
    },
    /// Something should be so for some objects, and is for none.
    NoWitness {
        /// The objects that lack least, as far as a bounded search shows; `None` if there are no objects.
        closest: Option<Near>,
        /// The quantifier.
        span: Span,
    },
}

impl Unsatisfied {
    /// Where it stands.
    pub fn span(&self) -> Span {
        match self {
            Self::Missing { span, .. }
            | Self::Present { span, .. }
            | Self::Different { span, .. }
            | Self::Type { span, .. }
            | Self::Same { span, .. }
            | Self::Comparison { span, .. }
            | Self::Fluent { span, .. }
            | Self::Alternatives { span, .. }
            | Self::Counterexample { span, .. }
            | Self::NoWitness { span, .. } => *span,
        }
    }
}

/// Objects that almost satisfy a condition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Near {
    /// The quantified variables' values.
    pub binding: Vec<(Name, ObjectId)>,
    /// What they lack.
    pub parts: Vec<Unsatisfied>,
}

/// A side of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operand {
    /// Its value, or why it has none.
    pub value: Result<Number, NumericFault>,
    /// The fluents in it with their values.
    pub fluents: Vec<(GroundApplication, Option<Number>)>,
    /// Where it stands.
    pub span: Span,
}

/// A feature whose meaning is not known here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unsupported {
    /// Which one.
    pub feature: Feature,
    /// Where it is used.
    pub span: Span,
}

/// Features that are not supported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Something that the domain's model does not hold, in the parser's words.
    InDomain(String),
    /// Something that the problem's model does not hold, in the parser's words.
    InProblem(String),
    /// A part of the language that the domain uses.
    LanguageOfDomain(pddl::model::Feature),
    /// A part of the language that the problem uses.
    LanguageOfProblem(pddl::model::Feature),
    /// A plan with times for a task network.
    TimedTaskNetwork,
    /// An action that takes time among the subtasks of the problem.
    DurativeSubtaskOfProblem,
    /// An action that takes time among the subtasks of a method.
    DurativeSubtaskOfDomain,
    /// Which subtask is which takes too long to find out.
    MatchLimit,
    /// Whether the steps come out of the task network takes too long to find out.
    DecompositionLimit,
    /// A plan without times, where the problem has timed changes.
    TimesMissingForProblem,
    /// A plan without times, where the domain has processes or events.
    TimesMissingForDomain,
    /// Quantifiers and constraints for more objects than can be tried.
    TooMuch,
    /// Continuous change whose instants are too near to each other to tell their order, or no roots of polynomials.
    Undecided,
}

/// Why a task has no meaning although each of its parts has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum IllFormed {
    /// A derived predicate depends on its own negation.
    Unstratified {
        /// The predicate.
        predicate: PredicateId,
        /// An axiom on the circle.
        span: Span,
    },
    /// An action adds or deletes what axioms derive.
    DerivedInEffect {
        /// The predicate.
        predicate: PredicateId,
        /// The effect.
        span: Span,
    },
}
