//! The initial graph, from problems of the vocabulary's domain.
//!
//! Objects and constants become nodes, facts become edges, fluents become attributes, and the numbers `rt_x` … become
//! poses. An object that several problems declare is one node. Invariant: a problem with an error gives no graph; without
//! an error, the whole graph is one commit, version 1, by the graph itself.

use std::sync::Arc;

use dsr::{AgentId, Edit, Graph, HolderRef, NewValue, NodeRef, Time, Transaction, TransactionError, TypeId};
use indexmap::IndexMap;
use pddl::Span;
use pddl::model::{Fact, FluentFact, FluentValue, Name, ObjectId, Problem};

use crate::pose::PoseNumbers;
use crate::tokens::{Constant, FunctionToken, Sort, Tokens};

/// Why an initial state does not fit the graph.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum PopulateErrorKind {
    /// The problem belongs to a domain other than the vocabulary.
    #[error("vocabulary `{vocabulary}` does not declare this")]
    Foreign { vocabulary: Name },
    /// A node has one type.
    #[error("`{name}` has several types; a node has one")]
    SeveralTypes { name: Name },
    /// A value is not a node.
    #[error("`{name}` cannot be a value; only nodes can be objects")]
    ValueObject { name: Name },
    /// Agents and resources are constants of the vocabulary, which lists their permissions.
    #[error("`{name}` must be a constant of the vocabulary: agents and resources are declared there")]
    LateBuiltIn { name: Name },
    /// Two problems give the object different types.
    #[error("`{name}` was given another type before")]
    Disagreement { name: Name },
    /// The graph computes it.
    #[error("`{name}` has no initial value: the graph computes it")]
    Computed { name: Name },
    /// An initial pose is given by its numbers.
    #[error("an initial pose is given by `rt_x`, `rt_y`, `rt_z`, `rt_roll`, `rt_pitch`, `rt_yaw`")]
    Pose,
    /// The graph refuses it.
    #[error(transparent)]
    Refused(#[from] TransactionError),
}

/// A part of a problem that does not fit the graph.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{kind}")]
pub struct PopulateError {
    /// Which of the given problems, by position.
    pub problem: usize,
    /// The place in its source.
    pub span: Span,
    /// The error.
    pub kind: PopulateErrorKind,
}

/// An edit and where it comes from.
type Placed = (usize, Span, Edit);

impl Tokens {
    /// The graph of the problems' initial states, at version 1.
    pub fn populate(&self, problems: &[&Problem], time: Time) -> Result<Graph, Vec<PopulateError>> {
        let edits = self.initial(problems)?;
        let graph = Graph::new(Arc::clone(&self.vocabulary));
        let mut transaction = Transaction::new(AgentId::DSR);
        transaction.extend(edits.iter().map(|(_, _, edit)| edit.clone()));
        match graph.commit(&transaction, time) {
            Ok(_) => Ok(graph),
            Err(error) => Err(vec![self.culprit(&edits, error)]),
        }
    }

    /// The error at the first edit that makes the graph refuse.
    fn culprit(&self, edits: &[Placed], error: TransactionError) -> PopulateError {
        let refused = |count: usize| {
            let mut transaction = Transaction::new(AgentId::DSR);
            transaction.extend(edits[..count].iter().map(|(_, _, edit)| edit.clone()));
            Graph::new(Arc::clone(&self.vocabulary)).commit(&transaction, Time(0)).err()
        };
        // The graph may also refuse an unfinished tree of poses, so the longest accepted prefix counts.
        let accepted = (0..edits.len()).rev().find(|&count| refused(count).is_none()).unwrap_or(0);
        let (problem, span) = edits.get(accepted).map(|&(p, s, _)| (p, s)).unwrap_or_default();
        PopulateError { problem, span, kind: PopulateErrorKind::Refused(error) }
    }

    fn initial(&self, problems: &[&Problem]) -> Result<Vec<Placed>, Vec<PopulateError>> {
        let mut populating = Populating {
            tokens: self,
            problem: 0,
            nodes: IndexMap::new(),
            poses: IndexMap::new(),
            edits: Vec::new(),
            errors: Vec::new(),
        };
        for (name, constant) in &self.constants {
            if let Constant::Node(id) = constant {
                populating.add_node(name, *id, Span::default());
            }
        }
        for (at, problem) in problems.iter().enumerate() {
            populating.problem = at;
            populating.problem(problem);
        }
        let Populating { mut edits, errors, poses, .. } = populating;
        for ((parent, child), (problem, span, numbers)) in poses {
            let (parent, child) = (node(&parent), node(&child));
            let pose = numbers.isometry().into();
            edits.push((problem, span, Edit::SetTransform { parent, child, pose }));
        }
        if errors.is_empty() { Ok(edits) } else { Err(errors) }
    }
}

struct Populating<'v> {
    tokens: &'v Tokens,
    problem: usize,
    nodes: IndexMap<Name, TypeId>,
    /// By parent and child.
    poses: IndexMap<(Name, Name), (usize, Span, PoseNumbers)>,
    edits: Vec<Placed>,
    errors: Vec<PopulateError>,
}

impl Populating<'_> {
    fn error(&mut self, span: Span, kind: PopulateErrorKind) {
        self.errors.push(PopulateError { problem: self.problem, span, kind });
    }

    fn foreign(&mut self, span: Span) {
        let vocabulary = self.tokens.name.clone();
        self.error(span, PopulateErrorKind::Foreign { vocabulary });
    }

    fn push(&mut self, span: Span, edit: Edit) {
        self.edits.push((self.problem, span, edit));
    }

    fn add_node(&mut self, name: &Name, id: TypeId, span: Span) {
        self.nodes.insert(name.clone(), id);
        self.push(span, Edit::AddNode { name: Arc::from(name.as_str()), node_type: id });
    }

    fn problem(&mut self, problem: &Problem) {
        for (id, object) in problem.objects.enumerate() {
            let is_constant = self.tokens.domain.constants.get(id).is_some();
            let name = object.name.clone();
            // A constant's place is in the vocabulary's text, also if the problem gave it one more type.
            let span = if is_constant { Span::default() } else { object.span };
            let &[of] = object.types.declared() else {
                self.error(span, PopulateErrorKind::SeveralTypes { name });
                continue;
            };
            if is_constant {
                continue;
            }
            let domain = &self.tokens.domain;
            let found = domain.types.enumerate().find(|(id, _)| *id == of);
            let sort = found.and_then(|(_, declared)| self.tokens.sort(&declared.name));
            match (sort, self.nodes.get(&name)) {
                (None, _) => self.foreign(span),
                (Some(Sort::Value(_)), _) => self.error(span, PopulateErrorKind::ValueObject { name }),
                (Some(Sort::Node(TypeId::AGENT | TypeId::RESOURCE)), _) => {
                    self.error(span, PopulateErrorKind::LateBuiltIn { name });
                }
                (Some(Sort::Node(id)), Some(&before)) if id != before => {
                    self.error(span, PopulateErrorKind::Disagreement { name });
                }
                (Some(Sort::Node(_)), Some(_)) => {}
                (Some(Sort::Node(id)), None) => self.add_node(&name, id, span),
            }
        }
        problem.init.iter().for_each(|fact| self.fact(problem, fact));
        problem.fluents.iter().for_each(|fluent| self.fluent(problem, fluent));
    }

    fn fact(&mut self, problem: &Problem, fact: &Fact) {
        let name = self.tokens.domain.predicates.get(fact.predicate).map(|predicate| &predicate.name);
        let label = name.and_then(|name| self.tokens.label(name));
        let arguments = self.names(problem, &fact.arguments);
        let (Some(label), [from, to]) = (label, arguments.as_slice()) else {
            return self.foreign(fact.span);
        };
        self.push(fact.span, Edit::AddEdge { from: node(from), label, to: node(to) });
    }

    fn fluent(&mut self, problem: &Problem, fluent: &FluentFact) {
        let span = fluent.span;
        let Some(function) = self.tokens.domain.functions.get(fluent.application.function) else {
            return self.foreign(span);
        };
        let name = function.name.clone();
        let arguments = self.names(problem, &fluent.application.arguments);
        let (holder, attribute) = match (self.tokens.function(&name), arguments.as_slice()) {
            (Some(FunctionToken::Node { attribute }), [of]) => (HolderRef::Node(node(of)), attribute),
            (Some(FunctionToken::Edge { label, attribute }), [from, to]) => {
                self.push(span, Edit::AddEdge { from: node(from), label, to: node(to) });
                (HolderRef::Edge { from: node(from), label, to: node(to) }, attribute)
            }
            (Some(FunctionToken::Pose(component)), [parent, child]) => {
                if let FluentValue::Number(number) = fluent.value {
                    let key = (parent.clone(), child.clone());
                    let new = (self.problem, span, PoseNumbers::default());
                    self.poses.entry(key).or_insert(new).2.set(component, number);
                }
                return;
            }
            (Some(FunctionToken::Distance), _) => {
                return self.error(span, PopulateErrorKind::Computed { name });
            }
            (Some(FunctionToken::Transform), _) => return self.error(span, PopulateErrorKind::Pose),
            _ => return self.foreign(span),
        };
        let value = match fluent.value {
            FluentValue::Number(number) => NewValue::Number(number),
            FluentValue::Object(id) => match self.names(problem, &[id]).as_slice() {
                [object] => match self.tokens.value(object) {
                    Some(value) => value.clone().into(),
                    None => NewValue::Node(node(object)),
                },
                _ => return self.foreign(span),
            },
        };
        self.push(span, Edit::SetAttribute { holder, attribute, value });
    }

    /// The names of objects of the problem; fewer if one is foreign.
    fn names(&self, problem: &Problem, ids: &[ObjectId]) -> Vec<Name> {
        ids.iter().filter_map(|&id| problem.objects.get(id)).map(|object| object.name.clone()).collect()
    }
}

fn node(name: &Name) -> NodeRef {
    NodeRef::Name(Arc::from(name.as_str()))
}
