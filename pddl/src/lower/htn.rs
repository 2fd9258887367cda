//! HDDL: `(:task …)`, `(:method …)` and the networks of methods and problems.
//!
//! `:subtasks` and `:tasks` are ordered by `:ordering` alone; `:ordered-subtasks` and `:ordered-tasks` are a
//! chain. A subtask is `(name term …)` or `(id (name term …))`. The two forms are distinct, since no
//! argument is a list.
//!
//! Source: Höller, Behnke, Bercher, Biundo, Fiorino, Pellier & Alford, "HDDL: an extension to PDDL
//! for expressing hierarchical planning problems", AAAI 2020.

use super::action::named;
use super::body::{Applied, Body};
use super::keys::Keys;
use super::sink::{Sink, first_word};
use super::world::{Signature, World, fold};
use crate::diagnostic::{DiagnosticKind, Label, SymbolKind};
use crate::model::{
    CompoundTask, Condition, Method, Name, Ordering, Subtask, SubtaskHead, TaskId, TaskNetwork, Term,
    Variables,
};
use crate::occurrence::NameKind;
use crate::syntax::Node;

const ORDERED: [&str; 2] = [":ordered-subtasks", ":ordered-tasks"];
const UNORDERED: [&str; 2] = [":subtasks", ":tasks"];

const METHOD_KEYS: &[&str] = &[
    ":parameters",
    ":task",
    ":precondition",
    ":subtasks",
    ":tasks",
    ":ordered-subtasks",
    ":ordered-tasks",
    ":ordering",
    ":order",
    ":constraints",
];

const NETWORK_KEYS: &[&str] = &[
    ":parameters",
    ":subtasks",
    ":tasks",
    ":ordered-subtasks",
    ":ordered-tasks",
    ":ordering",
    ":order",
    ":constraints",
];

pub(crate) fn task(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<CompoundTask> {
    let (name, _, rest) = named(sink, section, NameKind::Task, "the task")?;
    // HDDL's grammar allows a task conditions and effects; no planner reads them.
    let keys = Keys::read(sink, rest, "a task", &[":parameters", ":precondition", ":effect"]);
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    body.parameters(&keys);
    Some(CompoundTask { name, variables: body.schema.variables, span: section.span() })
}

/// `(:tasks (name ?x - t …) …)`: several tasks in one section.
pub(crate) fn tasks(world: &World, sink: &mut Sink, section: Node<'_>) -> Vec<CompoundTask> {
    let mut tasks = Vec::new();
    for node in section.children().skip(1) {
        let Some(name) = node.head().filter(|h| h.is_name()) else {
            sink.unexpected(node, "a task such as `(task ?x - type)`");
            continue;
        };
        sink.declare(NameKind::Task, name, None);
        let mut body = Body::new(world, sink);
        body.schema.scope = node.span();
        if node.children().nth(1).is_some_and(|second| second.is(":parameters")) {
            let keys = Keys::read(body.sink, node.children().skip(1), "a task", &[":parameters"]);
            body.parameters(&keys);
        } else {
            body.schema.parameters(world, body.sink, node.children().skip(1));
        }
        tasks.push(CompoundTask {
            name: Name::new(name.text()),
            variables: body.schema.variables,
            span: node.span(),
        });
    }
    tasks
}

pub(crate) fn method(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Method> {
    let (name, _, rest) = named(sink, section, NameKind::Method, "the method")?;
    let keys = Keys::read(sink, rest, "a method", METHOD_KEYS);
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    body.parameters(&keys);
    let task = match keys.get(":task") {
        Some(node) => body.decomposed(node),
        None => {
            body.sink.missing(section, format!("method `{name}`"), "`:task`");
            None
        }
    };
    let precondition = body.guard(&keys, ":precondition", section);
    let network = body.network(&keys);
    let (task, task_arguments) = task?;
    let (variables, span) = (body.schema.variables, section.span());
    Some(Method { name, variables, task, task_arguments, precondition, network, span })
}

/// A problem's initial network with its parameters.
pub(crate) fn initial_network(world: &World, sink: &mut Sink, section: Node<'_>) -> (Variables, TaskNetwork) {
    let keys = Keys::read(sink, section.children().skip(1), "a task network", NETWORK_KEYS);
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    body.parameters(&keys);
    let network = body.network(&keys);
    (body.schema.variables, network)
}

impl Body<'_> {
    fn decomposed(&mut self, node: Node<'_>) -> Option<(TaskId, Vec<Term>)> {
        let Some(head) = node.head().filter(|h| h.is_name()) else {
            self.sink.unexpected(node, "a task such as `(task ?x)`");
            return None;
        };
        let world = self.world;
        let signature = world.task_or_action(head.text());
        let Some((signature, SubtaskHead::Task(task))) = signature.map(|s| (s, s.head)) else {
            world.unknown(self.sink, head, SymbolKind::Task);
            self.stray_terms(node);
            return None;
        };
        self.sink.mention(NameKind::Task, head, None);
        let arguments = self.signature_arguments(node, SymbolKind::Task, signature)?;
        Some((task, arguments))
    }

    fn signature_arguments(
        &mut self,
        node: Node<'_>,
        symbol: SymbolKind,
        of: &Signature,
    ) -> Option<Vec<Term>> {
        let of = Applied { symbol, name: &of.name, parameters: &of.parameters };
        self.arguments(node, node.children().skip(1), &of)
    }

    /// `()`, a condition, or a conjunction of them.
    fn network_constraints(&mut self, node: Node<'_>, into: &mut Vec<Condition>) {
        if node.is_headed("and") {
            node.children().skip(1).for_each(|part| self.network_constraints(part, into));
        } else if !node.is_list() || node.head().is_some() {
            into.push(self.condition(node));
        }
    }

    fn network(&mut self, keys: &Keys<'_>) -> TaskNetwork {
        let mut network = TaskNetwork::default();
        if let Some(node) = keys.get(":constraints") {
            self.network_constraints(node, &mut network.constraints);
        }
        let mut given: Option<Node<'_>> = None;
        for key in ORDERED.iter().chain(&UNORDERED) {
            let Some(node) = keys.get(key) else { continue };
            if given.is_some()
                && let Some(key) = keys.key(key)
            {
                self.sink.report(key.span(), DiagnosticKind::Repeated { name: key.text().to_owned() });
                continue;
            }
            given = Some(node);
            let sound = self.subtasks(node, &mut network);
            if ORDERED.contains(key) && sound {
                let chain = (0u32..).zip(1u32..).take(network.subtasks.len().saturating_sub(1));
                network.orderings.extend(chain.map(|(before, after)| Ordering { before, after }));
            }
        }
        if let Some(node) = keys.get(":ordering").or_else(|| keys.get(":order")) {
            self.orderings(node, given, &mut network);
        }
        self.check_acyclic(&network, keys);
        network
    }

    /// Whether every subtask could be read.
    fn subtasks(&mut self, node: Node<'_>, network: &mut TaskNetwork) -> bool {
        if !node.is_list() {
            self.sink.unexpected(node, "`(and SUBTASK …)`");
            return false;
        }
        if node.children().next().is_none() {
            return true;
        }
        if !node.is_headed("and") {
            let subtask = self.subtask(node, network);
            let sound = subtask.is_some();
            network.subtasks.extend(subtask);
            return sound;
        }
        let mut sound = true;
        for part in node.children().skip(1) {
            let subtask = self.subtask(part, network);
            sound &= subtask.is_some();
            network.subtasks.extend(subtask);
        }
        sound
    }

    fn subtask(&mut self, node: Node<'_>, network: &TaskNetwork) -> Option<Subtask> {
        let mut parts = node.children();
        let (head, second) = (parts.next(), parts.next());
        let (id, call) = match (head, second) {
            (Some(id), Some(call)) if id.is_name() && call.is_list() && parts.next().is_none() => {
                (Some(id), call)
            }
            _ => (None, node),
        };
        if let Some(id) = id {
            self.sink.declare(NameKind::Subtask, id, Some(self.schema.scope));
        }
        if let Some(id) = id
            && let Some(first) = network.subtasks.iter().find(|s| s.id.as_deref() == Some(&*fold(id.text())))
        {
            let kind = DiagnosticKind::Duplicate { symbol: SymbolKind::Subtask, name: Name::new(id.text()) };
            self.sink.report_with(id.span(), kind, first.span, Label::First);
        }
        let Some(name) = call.head().filter(|h| h.is_name()) else {
            self.sink.unexpected(call, "a task or an action such as `(task ?x)`");
            return None;
        };
        let world = self.world;
        let Some(signature) = world.task_or_action(name.text()) else {
            world.unknown(self.sink, name, SymbolKind::TaskOrAction);
            self.stray_terms(call);
            return None;
        };
        let (symbol, kind) = match signature.head {
            SubtaskHead::Task(_) => (SymbolKind::Task, NameKind::Task),
            SubtaskHead::Action(_) | SubtaskHead::DurativeAction(_) => (SymbolKind::Action, NameKind::Action),
        };
        self.sink.mention(kind, name, None);
        let arguments = self.signature_arguments(call, symbol, signature)?;
        let id = id.map(|n| Name::new(n.text()));
        Some(Subtask { id, head: signature.head, arguments, span: node.span() })
    }

    fn orderings(&mut self, node: Node<'_>, subtasks: Option<Node<'_>>, network: &mut TaskNetwork) {
        // `((< a b) …)` has no `and` before its parts.
        let bare = node.head().is_some_and(Node::is_list);
        if !node.is_list() || !(bare || node.head().is_none() || node.is_headed("and") || node.is_headed("<"))
        {
            self.sink.unexpected(node, "`(and (< BEFORE AFTER) …)`");
            return;
        }
        if node.is_headed("<") {
            return self.ordering(node, subtasks, network);
        }
        for part in node.children().skip(usize::from(!bare)) {
            if part.is_headed("<") {
                self.ordering(part, subtasks, network);
            } else {
                self.sink.unexpected(part, "`(< BEFORE AFTER)`");
            }
        }
    }

    fn ordering(&mut self, node: Node<'_>, subtasks: Option<Node<'_>>, network: &mut TaskNetwork) {
        let Some([before, after]) = self.parts(node, "`(< BEFORE AFTER)`") else { return };
        let (b, a) = (self.subtask_id(before, subtasks, network), self.subtask_id(after, subtasks, network));
        if let (Some(before), Some(after)) = (b, a) {
            let ordering = Ordering { before, after };
            if !network.orderings.contains(&ordering) {
                network.orderings.push(ordering);
            }
        }
    }

    fn subtask_id(
        &mut self,
        node: Node<'_>,
        subtasks: Option<Node<'_>>,
        network: &TaskNetwork,
    ) -> Option<u32> {
        if !node.is_list() {
            self.sink.mention(NameKind::Subtask, node, Some(self.schema.scope));
        }
        let wanted = fold(node.text());
        let ids = || network.subtasks.iter().filter_map(|s| s.id.as_deref());
        let found = network.subtasks.iter().position(|s| s.id.as_deref() == Some(&*wanted));
        // A subtask with an error is not in the network, but its id is known.
        let written = || subtasks.is_some_and(|s| s.children().any(|n| n.is_headed(&wanted)));
        if found.is_none() && !written() {
            let suggestion = self.sink.suggest(node.text(), ids());
            let (symbol, name) = (SymbolKind::Subtask, node.text().to_owned());
            self.sink.report(node.span(), DiagnosticKind::Unknown { symbol, name, suggestion });
        }
        found.and_then(|i| u32::try_from(i).ok())
    }

    fn check_acyclic(&mut self, network: &TaskNetwork, keys: &Keys<'_>) {
        let Some(cycle) = cycle(network) else { return };
        let name = |&i: &usize| {
            let subtask = &network.subtasks[i];
            subtask.id.clone().unwrap_or_else(|| Name::new(&format!("{}", i + 1)))
        };
        let place = keys
            .get(":ordering")
            .or_else(|| keys.get(":order"))
            .map_or_else(|| network.subtasks[cycle[0]].span, first_word);
        let cycle = cycle.iter().map(name).collect();
        self.sink.report(place, DiagnosticKind::CyclicOrdering { cycle });
    }
}

/// Positions from a subtask back to itself, if the ordering has a cycle. Removes subtasks without
/// predecessors until none is left (Kahn 1962); each of the remaining ones has a predecessor among them.
fn cycle(network: &TaskNetwork) -> Option<Vec<usize>> {
    let count = network.subtasks.len();
    let mut waits = vec![0usize; count];
    let mut after: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut before: Vec<Vec<usize>> = vec![Vec::new(); count];
    for o in &network.orderings {
        waits[o.after as usize] += 1;
        after[o.before as usize].push(o.after as usize);
        before[o.after as usize].push(o.before as usize);
    }
    let mut free: Vec<usize> = (0..count).filter(|&i| waits[i] == 0).collect();
    while let Some(i) = free.pop() {
        for &j in &after[i] {
            waits[j] -= 1;
            if waits[j] == 0 {
                free.push(j);
            }
        }
    }
    let mut way = vec![(0..count).find(|&i| waits[i] > 0)?];
    loop {
        let last = *way.last()?;
        let next = before[last].iter().copied().find(|&j| waits[j] > 0)?;
        if let Some(start) = way.iter().position(|&i| i == next) {
            way.drain(..start);
            way.push(next);
            way.reverse();
            return Some(way);
        }
        way.push(next);
    }
}
