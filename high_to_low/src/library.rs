//! `methods.hddl`, compiled against the vocabulary.
//!
//! Invariant: every index is in range and every condition is patterns of the graph. At run time the only unknown name can
//! be that of a node that has left the graph.

use dsr::{Mentions, NodeId, Snapshot};
use pddl::Span;
use pddl::model::{
    Comparison, Domain, DurationConstraint, DurativeAction, ExpressionKind, Idx, Name, SubtaskHead, TaskId,
    Term, TimeSpecifier, VariableId, Variables,
};
use vocabulary::{Binding, Condition, Effect, LinkError, Tokens};

/// The tasks, methods and intentions of a mission.
#[derive(Clone, Debug)]
pub struct Methods {
    pub(crate) tasks: Vec<Task>,
    pub(crate) methods: Vec<Method>,
    pub(crate) intentions: Vec<Intention>,
}

/// Why a methods file cannot be compiled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MethodsError {
    /// A condition or an effect cannot be compiled.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// A method uses an instantaneous action; only intentions can be executed.
    #[error(
        "`{name}` is an action; a method's primitives are durative actions, whose `at end` effects must be seen"
    )]
    InstantaneousAction {
        /// The action.
        name: Name,
        /// The subtask.
        span: Span,
    },
    /// A time specifier that an intention does not have.
    #[error("an intention has effects `at start`, `at end` and `at timeout`, not `at {name}`")]
    UnknownOutcome {
        /// The specifier.
        name: Name,
        /// The effect.
        span: Span,
    },
    /// A condition at the end would be a second expectation.
    #[error("an intention has no condition `at end`; its `at end` effects are what must be seen")]
    ConditionAtEnd {
        /// The condition.
        span: Span,
    },
    /// A duration that is not `(<= ?duration SECONDS)`.
    #[error("the deadline of an intention is `(<= ?duration SECONDS)` with a number of seconds")]
    Duration {
        /// The constraint.
        span: Span,
    },
    /// A task without a method.
    #[error("task `{name}` has no method")]
    NoMethod {
        /// The task.
        name: Name,
        /// Its definition.
        span: Span,
    },
}

impl MethodsError {
    /// The place in the methods file.
    pub fn span(&self) -> Span {
        match self {
            Self::Link(error) => error.span,
            Self::InstantaneousAction { span, .. }
            | Self::UnknownOutcome { span, .. }
            | Self::ConditionAtEnd { span }
            | Self::Duration { span }
            | Self::NoMethod { span, .. } => *span,
        }
    }
}

/// A compound task with the methods that decompose it, in the order of the file.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    pub(crate) name: Name,
    pub(crate) arity: usize,
    pub(crate) methods: Vec<usize>,
}

#[derive(Clone, Debug)]
pub(crate) struct Method {
    pub(crate) name: Name,
    pub(crate) variables: Variables,
    /// The task's arguments, in terms of the method's variables.
    pub(crate) head: Vec<Argument>,
    pub(crate) precondition: Condition,
    pub(crate) subtasks: Vec<Subtask>,
    /// For each subtask, the subtasks that must be done before it starts.
    pub(crate) before: Vec<Vec<usize>>,
}

#[derive(Clone, Debug)]
pub(crate) struct Subtask {
    pub(crate) head: Head,
    pub(crate) arguments: Vec<Argument>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Head {
    Task(usize),
    Intention(usize),
}

/// An argument: a variable of the method, or a node by name.
#[derive(Clone, Debug)]
pub(crate) enum Argument {
    Variable(VariableId),
    Node(Name),
}

/// A primitive: what PELEA writes, and what it then expects to see.
#[derive(Clone, Debug)]
pub(crate) struct Intention {
    pub(crate) name: Name,
    pub(crate) variables: Variables,
    /// Must hold before it is written; the intention waits for it.
    pub(crate) before: Condition,
    /// Must keep holding from then on.
    pub(crate) keep: Condition,
    /// The edits of the intention.
    pub(crate) writes: Effect,
    /// The expectation: what must be seen.
    pub(crate) expects: Condition,
    /// The edits for an expectation that is not seen before the deadline.
    pub(crate) on_timeout: Effect,
    /// In seconds; `None` waits without a limit.
    pub(crate) deadline: Option<f64>,
}

impl Argument {
    /// The node of the argument.
    pub(crate) fn node(&self, binding: &Binding, snapshot: &Snapshot) -> Option<NodeId> {
        match self {
            Self::Variable(variable) => binding.node(*variable),
            Self::Node(name) => snapshot.node(name),
        }
    }
}

impl Methods {
    /// Compiles a domain that imports the vocabulary.
    ///
    /// # Errors
    /// Every mistake, with its place.
    pub fn new(domain: &Domain, tokens: &Tokens) -> Result<Self, Vec<MethodsError>> {
        let mut compiler = Compiler { domain, tokens, errors: Vec::new() };
        let intentions = domain.durative_actions.iter().filter_map(|a| compiler.intention(a)).collect();
        let methods: Vec<_> = domain.methods.iter().filter_map(|m| compiler.method(m)).collect();
        let tasks = domain.tasks.enumerate().map(|(id, task)| compiler.task(id, task)).collect();
        if compiler.errors.is_empty() {
            Ok(Self { tasks, methods, intentions })
        } else {
            compiler.errors.sort_by_key(|error| error.span().start);
            Err(compiler.errors)
        }
    }

    /// The name of a task or an intention.
    pub(crate) fn name(&self, head: Head) -> &Name {
        match head {
            Head::Task(task) => &self.tasks[task].name,
            Head::Intention(intention) => &self.intentions[intention].name,
        }
    }

    /// The tokens that refining reads: those of all conditions and expectations, and those of all effects, which are
    /// compared with the graph before they are written or taken back.
    pub fn mentions(&self) -> Mentions {
        let mut mentions = Mentions::default();
        self.methods.iter().for_each(|method| mentions.extend(method.precondition.mentions()));
        for Intention { before, keep, expects, writes, on_timeout, .. } in &self.intentions {
            [before, keep, expects].into_iter().for_each(|condition| mentions.extend(condition.mentions()));
            [writes, on_timeout].into_iter().for_each(|effect| mentions.extend(&effect.mentions()));
        }
        mentions
    }

    pub(crate) fn find(&self, task: &str) -> Option<usize> {
        self.tasks.iter().position(|t| &*t.name == task)
    }
}

struct Compiler<'a> {
    domain: &'a Domain,
    tokens: &'a Tokens,
    errors: Vec<MethodsError>,
}

impl Compiler<'_> {
    fn task(&mut self, id: TaskId, task: &pddl::model::CompoundTask) -> Task {
        let methods: Vec<_> =
            self.domain.methods.iter().enumerate().filter(|(_, m)| m.task == id).map(|(i, _)| i).collect();
        if methods.is_empty() {
            self.errors.push(MethodsError::NoMethod { name: task.name.clone(), span: task.span });
        }
        Task { name: task.name.clone(), arity: task.variables.parameters, methods }
    }

    fn method(&mut self, method: &pddl::model::Method) -> Option<Method> {
        let link = self.tokens.link(self.domain);
        let precondition = self.keep(link.condition(
            &method.variables,
            std::iter::once(&method.precondition).chain(&method.network.constraints),
        ));
        let mut subtasks = Vec::new();
        for subtask in &method.network.subtasks {
            let head = match subtask.head {
                SubtaskHead::Task(id) => Head::Task(id.index()),
                SubtaskHead::DurativeAction(id) => Head::Intention(id.index()),
                SubtaskHead::Action(id) => {
                    let name = self.domain.actions[id].name.clone();
                    self.errors.push(MethodsError::InstantaneousAction { name, span: subtask.span });
                    continue;
                }
            };
            subtasks.push(Subtask { head, arguments: self.arguments(&subtask.arguments) });
        }
        let mut before = vec![Vec::new(); method.network.subtasks.len()];
        for ordering in &method.network.orderings {
            before[ordering.after as usize].push(ordering.before as usize);
        }
        Some(Method {
            name: method.name.clone(),
            variables: method.variables.clone(),
            head: self.arguments(&method.task_arguments),
            precondition: precondition?,
            subtasks,
            before,
        })
    }

    fn intention(&mut self, action: &DurativeAction) -> Option<Intention> {
        let link = self.tokens.link(self.domain);
        let variables = &action.variables;
        for timed in &action.conditions {
            if !matches!(timed.when, TimeSpecifier::Start | TimeSpecifier::OverAll) {
                self.errors.push(MethodsError::ConditionAtEnd { span: timed.condition.span });
            }
        }
        let timeout = TimeSpecifier::Outcome(Name::new("timeout"));
        for timed in &action.effects {
            if let TimeSpecifier::Outcome(name) = &timed.when
                && timed.when != timeout
            {
                let (name, span) = (name.clone(), timed.when_span);
                self.errors.push(MethodsError::UnknownOutcome { name, span });
            }
        }
        let conditions = |when: TimeSpecifier| {
            action.conditions.iter().filter(move |c| c.when == when).map(|c| &c.condition)
        };
        let effects =
            |when: TimeSpecifier| action.effects.iter().filter(move |e| e.when == when).map(|e| &e.effect);
        let before = self.keep(link.condition(variables, conditions(TimeSpecifier::Start)));
        let keep = self.keep(link.condition(variables, conditions(TimeSpecifier::OverAll)));
        let writes = self.keep(link.effect(variables, effects(TimeSpecifier::Start)));
        let expects = self.keep(link.expectation(variables, effects(TimeSpecifier::End)));
        let on_timeout = self.keep(link.effect(variables, effects(timeout)));
        let deadline = self.deadline(&action.duration);
        Some(Intention {
            name: action.name.clone(),
            variables: variables.clone(),
            before: before?,
            keep: keep?,
            writes: writes?,
            expects: expects?,
            on_timeout: on_timeout?,
            deadline,
        })
    }

    fn deadline(&mut self, constraints: &[DurationConstraint]) -> Option<f64> {
        let mut deadline: Option<f64> = None;
        for constraint in constraints {
            match (constraint.comparison, &constraint.bound.kind) {
                (Comparison::LessEqual | Comparison::Less, ExpressionKind::Number(seconds))
                    if *seconds >= 0.0 =>
                {
                    deadline = Some(deadline.map_or(*seconds, |d| d.min(*seconds)));
                }
                _ => self.errors.push(MethodsError::Duration { span: constraint.span }),
            }
        }
        deadline
    }

    fn arguments(&self, terms: &[Term]) -> Vec<Argument> {
        terms
            .iter()
            .map(|term| match term {
                Term::Variable(variable) => Argument::Variable(*variable),
                Term::Object(object) => Argument::Node(self.domain.constants[*object].name.clone()),
            })
            .collect()
    }

    fn keep<T>(&mut self, result: Result<T, Vec<LinkError>>) -> Option<T> {
        match result {
            Ok(compiled) => Some(compiled),
            Err(errors) => {
                self.errors.extend(errors.into_iter().map(MethodsError::Link));
                None
            }
        }
    }
}
