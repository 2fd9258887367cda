//! Plans as files hold them: sequential, temporal, hierarchical.
//!
//! Problem: there are three formats, and a file does not name its own. Idea: a model for each, and an enum
//! of them; code that makes or takes one kind names that kind only. Invariant: names, arities and types fit
//! the domain and ids are in range. The validator decides whether the plan works, whether subtasks are those
//! of the method, and whether the decomposition is a tree: an invalid plan can be read.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, §5 (temporal plans); Höller et al., "Format of hierarchical
//! plans for IPC 2020". Deviation: times are exact decimals ([`Decimal`]).

use crate::model::{ActionId, DurativeActionId, Idx, IndexVec, MethodId, ObjectId, TaskId};
use crate::{Decimal, Span};

/// A plan of any kind.
#[derive(Clone, Debug)]
pub enum Plan {
    /// One action after the other.
    Sequential(SequentialPlan),
    /// Actions with times.
    Temporal(TemporalPlan),
    /// Actions, and the tasks that decompose into them.
    Hierarchical(HierarchicalPlan),
}

/// The kind of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PlanKind {
    /// [`Plan::Sequential`]
    Sequential,
    /// [`Plan::Temporal`]
    Temporal,
    /// [`Plan::Hierarchical`]
    Hierarchical,
}

impl std::fmt::Display for PlanKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Sequential => "sequential",
            Self::Temporal => "temporal",
            Self::Hierarchical => "hierarchical",
        })
    }
}

impl Default for Plan {
    /// The sequential plan without steps.
    fn default() -> Self {
        Self::Sequential(SequentialPlan::default())
    }
}

impl Plan {
    /// Its kind.
    pub fn kind(&self) -> PlanKind {
        match self {
            Self::Sequential(_) => PlanKind::Sequential,
            Self::Temporal(_) => PlanKind::Temporal,
            Self::Hierarchical(_) => PlanKind::Hierarchical,
        }
    }

    /// Where its first action stands; the beginning of the file if the plan is empty.
    pub fn first_span(&self) -> Span {
        let span = match self {
            Self::Sequential(plan) => plan.steps.first().map(|s| s.span),
            Self::Temporal(plan) => plan.steps.first().map(|s| s.span),
            Self::Hierarchical(plan) => plan.steps.iter().next().map(|s| s.step.span),
        };
        span.unwrap_or_default()
    }

    /// The plan, if it is sequential.
    pub fn into_sequential(self) -> Option<SequentialPlan> {
        match self {
            Self::Sequential(plan) => Some(plan),
            Self::Temporal(_) | Self::Hierarchical(_) => None,
        }
    }
}

/// A ground instantaneous action; name, arity and types fit the domain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanStep {
    /// Which action.
    pub action: ActionId,
    /// Its arguments.
    pub arguments: Vec<ObjectId>,
    /// Where it stands.
    pub span: Span,
}

/// `(a b) (c)`: one action after the other.
#[derive(Clone, Debug, Default)]
pub struct SequentialPlan {
    /// The steps in order.
    pub steps: Vec<PlanStep>,
    /// The cost that the file claims.
    pub cost: Option<ClaimedCost>,
}

impl SequentialPlan {
    /// A plan without a claimed cost.
    pub fn new(steps: Vec<PlanStep>) -> Self {
        Self { steps, cost: None }
    }
}

/// The cost in a comment `; cost = 5`, as claimed by the file and not checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClaimedCost {
    /// The cost.
    pub value: Decimal,
    /// The comment.
    pub span: Span,
}

/// The schema that a step of a temporal plan instantiates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StepHead {
    /// An instantaneous action.
    Action(ActionId),
    /// A durative action.
    DurativeAction(DurativeActionId),
}

/// `0.003: (a b) [4.000]`
#[derive(Clone, Debug)]
pub struct TemporalStep {
    /// When it starts; never negative.
    pub start: Decimal,
    /// Which action.
    pub head: StepHead,
    /// Its arguments.
    pub arguments: Vec<ObjectId>,
    /// How long it takes, if the file says so; never negative. Some planners write a duration behind
    /// instantaneous actions too, where it has no meaning.
    pub duration: Option<Decimal>,
    /// Where the action stands.
    pub span: Span,
    /// Where its start stands.
    pub start_span: Span,
    /// Where its duration stands, brackets included.
    pub duration_span: Option<Span>,
}

/// Actions with times.
#[derive(Clone, Debug, Default)]
pub struct TemporalPlan {
    /// The steps in the order of the file, which may differ from the order of their times.
    pub steps: Vec<TemporalStep>,
    /// The cost that the file claims.
    pub cost: Option<ClaimedCost>,
}

/// The number by which a hierarchical plan names one of its actions or tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PlanLabel(pub u64);

impl std::fmt::Display for PlanLabel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}

/// The position of an action in [`HierarchicalPlan::steps`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LabelledStepId(pub u32);

/// The position of a task in [`HierarchicalPlan::decompositions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DecompositionId(pub u32);

impl Idx for LabelledStepId {
    fn from_index(index: usize) -> Self {
        Self(u32::try_from(index).expect("a source of less than 4 GiB has less than 2^32 steps"))
    }
    fn index(self) -> usize {
        self.0 as usize
    }
}

impl Idx for DecompositionId {
    fn from_index(index: usize) -> Self {
        Self(u32::try_from(index).expect("a source of less than 4 GiB has less than 2^32 tasks"))
    }
    fn index(self) -> usize {
        self.0 as usize
    }
}

/// `0 action a b`
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LabelledStep {
    /// Its number.
    pub label: PlanLabel,
    /// Where the number stands.
    pub label_span: Span,
    /// The action.
    pub step: PlanStep,
}

/// A node of the decomposition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PlanNode {
    /// An action.
    Step(LabelledStepId),
    /// A task.
    Decomposition(DecompositionId),
}

/// A number that names a node, where it is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanReference {
    /// What it names.
    pub node: PlanNode,
    /// Where it stands.
    pub span: Span,
}

/// `5 task a b -> method 6 7`
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decomposition {
    /// Its number.
    pub label: PlanLabel,
    /// Where the number stands.
    pub label_span: Span,
    /// Which task.
    pub task: TaskId,
    /// The task's arguments.
    pub arguments: Vec<ObjectId>,
    /// The method that decomposes it. Whether the method belongs to that task is not checked here.
    pub method: MethodId,
    /// Where the method's name stands.
    pub method_span: Span,
    /// Its subtasks, in the order of the file.
    pub subtasks: Vec<PlanReference>,
    /// The task with its arguments.
    pub span: Span,
}

/// Actions, and how the problem's tasks decompose into them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HierarchicalPlan {
    /// The actions in the order of execution.
    pub steps: IndexVec<LabelledStepId, LabelledStep>,
    /// The tasks in the order of the file.
    pub decompositions: IndexVec<DecompositionId, Decomposition>,
    /// The nodes of the problem's initial task network.
    pub roots: Vec<PlanReference>,
    /// The word `root`.
    pub root_span: Span,
}
