//! A task under way: the tree of tasks, methods and intentions, refined while the task is executed.
//!
//! Problem: whether a method works is known only when it is used. Idea: choose the first method, and the first binding of
//! its own variables, whose precondition holds now. Advance its subtasks as far as their order allows, several at a time.
//! When a subtask fails, withdraw its siblings and choose again, in the graph as it is then; a candidate that has failed
//! is not tried again. Invariant: the edits of a failed method are taken back in the step in which it fails. Cost: a step
//! is linear in the open part of the tree, which methods keep small.

use crate::event::RefinementEvent;
use crate::failure::{Failure, Reason, StartError};
use crate::ground::GroundTask;
use crate::intention::{Activity, Standing};
use crate::library::{Argument, Head, Method, Methods, Subtask};
use crate::turn::{Moment, Turn};
use dsr::{Edit, NodeId, Snapshot, Time};
use pddl::model::Name;
use vocabulary::Binding;

/// The deepest nesting of tasks. A test describes dozens of options by recursion, not hundreds.
const DEEPEST: usize = 128;

/// A task that is being executed.
#[derive(Clone, Debug)]
pub struct Refinement {
    root: Goal,
}

/// The result of a step.
#[derive(Clone, Debug)]
pub struct Step {
    /// The edits that PELEA must write now, in one transaction.
    pub edits: Vec<Edit>,
    /// The events of the step.
    pub events: Vec<RefinementEvent>,
    /// The state of the refinement.
    pub status: Status,
}

/// The state of a refinement.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// It waits for the graph, or for its next deadline.
    Running {
        /// When to step it even if nothing changes.
        wake_at: Option<Time>,
    },
    /// Every intention has been seen.
    Done,
    /// No method is left.
    Failed(Failure),
}

impl Refinement {
    /// A refinement of a task, whose arguments are nodes. It has no edits before its first step.
    ///
    /// # Errors
    /// No such task, the wrong number of arguments, or a node that is not in the graph.
    pub fn new(
        methods: &Methods,
        snapshot: &Snapshot,
        task: &str,
        arguments: &[Name],
    ) -> Result<Self, StartError> {
        let index = methods.find(task).ok_or_else(|| StartError::UnknownTask(Name::new(task)))?;
        let expected = methods.tasks[index].arity;
        if arguments.len() != expected {
            return Err(StartError::Arity { task: Name::new(task), expected, found: arguments.len() });
        }
        let nodes = arguments
            .iter()
            .map(|name| snapshot.node(name).ok_or_else(|| StartError::UnknownNode(name.clone())))
            .collect::<Result<_, _>>()?;
        Ok(Self { root: Goal::new(index, nodes) })
    }

    /// Advances every part that can advance. Call it when the graph has changed, and at `wake_at`, with a snapshot that
    /// contains the edits of earlier steps.
    pub fn step(&mut self, methods: &Methods, snapshot: &Snapshot, moment: Moment) -> Step {
        let (mut edits, mut events) = (Vec::new(), Vec::new());
        let mut turn = Turn { snapshot, moment, edits: &mut edits, events: &mut events, wake_at: None };
        let progress = self.root.step(methods, &mut turn, 0);
        let wake_at = turn.wake_at;
        let status = match progress {
            Progress::Running => Status::Running { wake_at },
            Progress::Done => Status::Done,
            Progress::Failed(failure) => Status::Failed(failure),
        };
        Step { edits, events, status }
    }

    /// The edits that take back what its running intentions have written, whatever the graph is by then: what is left
    /// to do if PELEA is gone.
    pub fn withdrawal(&self, methods: &Methods) -> Vec<Edit> {
        let mut edits = Vec::new();
        self.root.withdrawal(methods, &mut edits);
        edits
    }

    /// The edits of its intentions that were written and are not yet seen to have their effect.
    pub fn written(&self) -> impl Iterator<Item = &Edit> {
        let mut edits = Vec::new();
        self.root.written(&mut edits);
        edits.into_iter()
    }

    /// Cancels the refinement. Returns the edits that take back what its running intentions have written.
    pub fn cancel(&mut self, snapshot: &Snapshot) -> Vec<Edit> {
        let mut edits = Vec::new();
        self.root.withdraw(snapshot, &mut edits);
        edits
    }
}

/// A compound task.
#[derive(Clone, Debug)]
struct Goal {
    task: usize,
    arguments: Vec<NodeId>,
    /// The methods that were tried, with their bindings.
    tried: Vec<(usize, Vec<Option<NodeId>>)>,
    failed: Vec<(Name, Reason)>,
    expansion: Option<Expansion>,
}

/// A chosen method with its subtasks.
#[derive(Clone, Debug)]
struct Expansion {
    method: usize,
    binding: Binding,
    children: Vec<Child>,
}

#[derive(Clone, Debug)]
enum Child {
    /// A subtask before it is not done.
    NotYet,
    Task(Box<Goal>),
    Intention(Activity),
    Done,
}

enum Progress {
    Running,
    Done,
    Failed(Failure),
}

impl Goal {
    fn new(task: usize, arguments: Vec<NodeId>) -> Self {
        Self { task, arguments, tried: Vec::new(), failed: Vec::new(), expansion: None }
    }

    fn step(&mut self, methods: &Methods, turn: &mut Turn<'_>, depth: usize) -> Progress {
        loop {
            if self.expansion.is_none() {
                if depth > DEEPEST {
                    return Progress::Failed(self.failure(methods, turn, Some(&Reason::TooDeep)));
                }
                let Some(expansion) = self.choose(methods, turn) else {
                    return Progress::Failed(self.failure(methods, turn, None));
                };
                self.expansion = Some(expansion);
            }
            let expansion = self.expansion.as_mut().expect("one was just chosen");
            let reason = match expansion.step(methods, turn, depth) {
                Ok(true) => return Progress::Done,
                Ok(false) => return Progress::Running,
                Err(reason) => reason,
            };
            expansion.withdraw(turn.snapshot, turn.edits);
            let method = &methods.methods[expansion.method].name;
            let task = self.ground(methods, turn.snapshot);
            turn.events.push(RefinementEvent::MethodFailed { task, method: method.clone() });
            let fatal = reason.is_fatal();
            self.failed.push((method.clone(), reason));
            self.expansion = None;
            if fatal {
                return Progress::Failed(self.failure(methods, turn, None));
            }
            if !turn.edits.is_empty() {
                // The failed method has edits (a doubt, a withdrawal): choose the next method in a graph that contains
                // them.
                return Progress::Running;
            }
        }
    }

    fn ground(&self, methods: &Methods, snapshot: &Snapshot) -> GroundTask {
        ground(methods, Head::Task(self.task), &self.arguments, snapshot)
    }

    /// The first method and binding that apply now and have not been tried.
    fn choose(&mut self, methods: &Methods, turn: &mut Turn<'_>) -> Option<Expansion> {
        for &index in &methods.tasks[self.task].methods {
            let method = &methods.methods[index];
            let Some(binding) = self.unify(method, turn.snapshot) else { continue };
            for binding in method.precondition.bindings(turn.snapshot, &binding) {
                let key = (index, binding.nodes().to_vec());
                if self.tried.contains(&key) {
                    continue;
                }
                self.tried.push(key);
                let task = self.ground(methods, turn.snapshot);
                turn.events.push(RefinementEvent::MethodChosen { task, method: method.name.clone() });
                let children = vec![Child::NotYet; method.subtasks.len()];
                return Some(Expansion { method: index, binding, children });
            }
        }
        None
    }

    /// Binds the method's variables to the task's arguments.
    fn unify(&self, method: &Method, snapshot: &Snapshot) -> Option<Binding> {
        let mut binding = Binding::of(&method.variables);
        for (argument, &node) in method.head.iter().zip(&self.arguments) {
            match argument.node(&binding, snapshot) {
                Some(bound) if bound == node => {}
                Some(_) => return None,
                None => match argument {
                    Argument::Variable(variable) => {
                        binding.bind(*variable, node);
                    }
                    Argument::Node(_) => return None,
                },
            }
        }
        Some(binding)
    }

    fn failure(&mut self, methods: &Methods, turn: &Turn<'_>, reason: Option<&Reason>) -> Failure {
        let task = self.ground(methods, turn.snapshot);
        let mut reasons = std::mem::take(&mut self.failed);
        for &index in &methods.tasks[self.task].methods {
            let method = &methods.methods[index];
            if self.tried.iter().any(|(tried, _)| *tried == index) {
                continue;
            }
            let why = match (reason, self.unify(method, turn.snapshot)) {
                (Some(reason), _) => reason.clone(),
                (None, None) => Reason::OtherArguments,
                (None, Some(binding)) => method
                    .precondition
                    .why_not(turn.snapshot, &binding)
                    .map_or(Reason::NotTried, Reason::NotApplicable),
            };
            reasons.push((method.name.clone(), why));
        }
        Failure::NoMethodLeft { task, methods: reasons }
    }

    fn withdraw(&mut self, snapshot: &Snapshot, edits: &mut Vec<Edit>) {
        if let Some(expansion) = &mut self.expansion {
            expansion.withdraw(snapshot, edits);
        }
    }

    fn withdrawal(&self, methods: &Methods, edits: &mut Vec<Edit>) {
        for child in self.expansion.iter().flat_map(|expansion| &expansion.children) {
            match child {
                Child::Task(goal) => goal.withdrawal(methods, edits),
                Child::Intention(activity) => activity.withdrawal(methods, edits),
                Child::NotYet | Child::Done => {}
            }
        }
    }
}

impl Goal {
    fn written<'g>(&'g self, edits: &mut Vec<&'g Edit>) {
        for child in self.expansion.iter().flat_map(|expansion| &expansion.children) {
            match child {
                Child::Task(goal) => goal.written(edits),
                Child::Intention(activity) => edits.extend(activity.written()),
                Child::NotYet | Child::Done => {}
            }
        }
    }
}

impl Expansion {
    /// Whether all subtasks are done, or why the method fails.
    fn step(&mut self, methods: &Methods, turn: &mut Turn<'_>, depth: usize) -> Result<bool, Reason> {
        let method = &methods.methods[self.method];
        loop {
            let mut advanced = false;
            for i in 0..self.children.len() {
                if matches!(self.children[i], Child::NotYet)
                    && method.before[i].iter().all(|&b| matches!(self.children[b], Child::Done))
                {
                    self.children[i] = self.start(methods, &method.subtasks[i], turn)?;
                }
                let done = match &mut self.children[i] {
                    Child::NotYet | Child::Done => false,
                    Child::Task(goal) => match goal.step(methods, turn, depth + 1) {
                        Progress::Running => false,
                        Progress::Done => true,
                        Progress::Failed(failure) => return Err(Reason::Subtask(Box::new(failure))),
                    },
                    Child::Intention(activity) => match activity.step(methods, turn) {
                        Standing::Running => false,
                        Standing::Seen => true,
                        Standing::Failed(reason) => {
                            self.children[i] = Child::Done;
                            return Err(reason);
                        }
                    },
                };
                if done {
                    self.children[i] = Child::Done;
                    advanced = true;
                }
            }
            // Another subtask can start only if one has become done.
            if !advanced {
                return Ok(self.children.iter().all(|child| matches!(child, Child::Done)));
            }
        }
    }

    fn start(&self, methods: &Methods, subtask: &Subtask, turn: &Turn<'_>) -> Result<Child, Reason> {
        let nodes = subtask.arguments.iter().map(|a| a.node(&self.binding, turn.snapshot));
        let Some(nodes) = nodes.collect::<Option<Vec<_>>>() else {
            return Err(Reason::NoArgument { subtask: methods.name(subtask.head).clone() });
        };
        Ok(match subtask.head {
            Head::Task(task) => Child::Task(Box::new(Goal::new(task, nodes))),
            Head::Intention(intention) => {
                let ground = ground(methods, subtask.head, &nodes, turn.snapshot);
                Child::Intention(Activity::new(methods, intention, &nodes, ground, turn.moment.now))
            }
        })
    }

    fn withdraw(&mut self, snapshot: &Snapshot, edits: &mut Vec<Edit>) {
        for child in &mut self.children {
            match child {
                Child::Task(goal) => goal.withdraw(snapshot, edits),
                Child::Intention(activity) => activity.withdraw(snapshot, edits),
                Child::NotYet | Child::Done => {}
            }
        }
    }
}

fn ground(methods: &Methods, head: Head, arguments: &[NodeId], snapshot: &Snapshot) -> GroundTask {
    let arguments = arguments.iter().map(|&node| Name::new(snapshot.name(node).unwrap_or("?"))).collect();
    GroundTask { name: methods.name(head).clone(), arguments }
}
