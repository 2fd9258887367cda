//! Hierarchical plans in the format of the IPC 2020.
//!
//! ```text
//! ==>
//! 0 action a b
//! root 5
//! 5 task a b -> method 0
//! <==
//! ```
//!
//! A line is a node; actions stand in the order of execution, the other lines in any order. The action or
//! task may have parentheses around it, the whole line too. Numbers are resolved once all lines are known,
//! so that the number of a wrong line is known too.

use rustc_hash::FxHashMap;

use super::Reader;
use crate::diagnostic::{DiagnosticKind, Label, SymbolKind};
use crate::model::{Idx as _, IndexVec, MethodId, ObjectId, SubtaskHead, TaskId};
use crate::occurrence::NameKind;
use crate::syntax::Node;
use crate::{
    Decomposition, DecompositionId, HierarchicalPlan, LabelledStep, LabelledStepId, PlanLabel, PlanNode,
    PlanReference, PlanStep, Span,
};

const LINE: &str = "`NUMBER action …`, `root NUMBER …` or `NUMBER task … -> method NUMBER …`";
const NUMBER: &str = "the number of an action or a task";

/// A task of the plan before its numbers are resolved.
struct Written<'t> {
    label: PlanLabel,
    label_span: Span,
    task: Option<(TaskId, Vec<ObjectId>)>,
    method: Option<(MethodId, Span)>,
    span: Span,
    subtasks: Vec<Node<'t>>,
}

/// Where a number is declared, and the node that it names unless its line is wrong.
type Labels = FxHashMap<PlanLabel, (Span, Option<PlanNode>)>;

#[derive(Default)]
struct Lines<'t> {
    steps: IndexVec<LabelledStepId, LabelledStep>,
    written: Vec<Written<'t>>,
    labels: Labels,
    root: Option<(Span, Vec<Node<'t>>)>,
}

impl<'a> Reader<'a> {
    pub(super) fn hierarchical(&mut self) -> HierarchicalPlan {
        let mut lines = Lines::default();
        for line in self.between_arrows() {
            self.line(&line, &mut lines);
        }
        let end = self.tree.roots().find(|n| n.is("<==")).or_else(|| self.tree.roots().last());
        let end = end.map_or_else(Span::default, Node::span);
        let mut decompositions = IndexVec::new();
        // Ids first: a task may come before its subtasks.
        let sound = |w: &Written<'_>| w.task.is_some() && w.method.is_some();
        for (index, written) in lines.written.iter().filter(|w| sound(w)).enumerate() {
            let node = PlanNode::Decomposition(DecompositionId::from_index(index));
            if let Some(entry) = lines.labels.get_mut(&written.label).filter(|e| e.0 == written.label_span) {
                entry.1 = Some(node);
            }
        }
        for written in lines.written {
            let subtasks = self.references(&written.subtasks, &lines.labels);
            if let (Some((task, arguments)), Some((method, method_span))) = (written.task, written.method) {
                let Written { label, label_span, span, .. } = written;
                decompositions.push(Decomposition {
                    label,
                    label_span,
                    task,
                    arguments,
                    method,
                    method_span,
                    subtasks,
                    span,
                });
            }
        }
        let (root_span, roots) = match lines.root {
            Some((span, numbers)) => (span, self.references(&numbers, &lines.labels)),
            None => {
                self.no_part(end, "`root` line");
                (end, Vec::new())
            }
        };
        HierarchicalPlan { steps: lines.steps, decompositions, roots, root_span }
    }

    fn no_part(&mut self, span: Span, what: &'static str) {
        self.body.sink.report(span, DiagnosticKind::Missing { owner: "the hierarchical plan".into(), what });
    }

    /// The lines between `==>` and `<==`; other lines are reported.
    fn between_arrows(&mut self) -> Vec<Vec<Node<'a>>> {
        let roots: Vec<Node<'a>> = self.tree.roots().collect();
        let over = |part: &[Node<'a>]| match part {
            [] => None,
            [first, .., last] => Some(first.span().to(last.span())),
            [one] => Some(one.span()),
        };
        let start = roots.iter().position(|n| n.is("==>"));
        let end = roots.iter().position(|n| n.is("<==")).filter(|&e| start.is_none_or(|s| s < e));
        if start.is_none() {
            let first = roots.first().map_or_else(Span::default, |n| n.span());
            self.no_part(first, "`==>` before it");
        }
        if let Some(before) = start.and_then(|s| over(&roots[..s])) {
            self.unexpected(before, "`==>`");
        }
        if end.is_none() {
            let last = roots.last().map_or_else(Span::default, |n| n.span());
            self.no_part(last, "`<==` behind it");
        }
        if let Some(behind) = end.and_then(|e| over(&roots[e + 1..])) {
            self.body.sink.report(behind, DiagnosticKind::TrailingText);
        }
        let inner = &roots[start.map_or(0, |s| s + 1)..end.unwrap_or(roots.len())];
        let lines = inner.chunk_by(|a, b| !self.line_ends_between(a.span(), b.span()));
        lines.map(<[Node<'a>]>::to_vec).collect()
    }

    fn line(&mut self, line: &[Node<'a>], lines: &mut Lines<'a>) {
        let inside: Vec<Node<'a>>;
        let line = match line {
            [whole] if whole.is_list() => {
                inside = whole.children().collect();
                &inside
            }
            _ => line,
        };
        let [first, rest @ ..] = line else { return };
        if first.is("root") {
            if lines.root.is_some() {
                let name = first.text().to_owned();
                return self.body.sink.report(first.span(), DiagnosticKind::Repeated { name });
            }
            lines.root = Some((first.span(), rest.to_vec()));
            return;
        }
        let whole = line.last().map_or(first.span(), |last| first.span().to(last.span()));
        let Some(label) = label(*first) else { return self.unexpected(whole, LINE) };
        let scope = self.whole_file();
        self.body.sink.declare(NameKind::Subtask, *first, scope);
        let known = match lines.labels.get(&label) {
            Some(&(before, _)) => {
                let kind = DiagnosticKind::Duplicate {
                    symbol: SymbolKind::PlanStep,
                    name: crate::model::Name::new(first.text()),
                };
                self.body.sink.report_with(first.span(), kind, before, Label::First);
                true
            }
            None => {
                lines.labels.insert(label, (first.span(), None));
                false
            }
        };
        match rest.windows(2).position(is_arrow) {
            Some(arrow) => {
                let written = self.task_line(label, *first, &rest[..arrow], &rest[arrow + 2..]);
                lines.written.extend(written);
            }
            None => {
                let Some(step) = self.action_line(whole, rest) else { return };
                let id = lines.steps.push(LabelledStep { label, label_span: first.span(), step });
                if let Some(entry) = lines.labels.get_mut(&label).filter(|_| !known) {
                    entry.1 = Some(PlanNode::Step(id));
                }
            }
        }
    }

    fn action_line(&mut self, whole: Span, words: &[Node<'a>]) -> Option<PlanStep> {
        let (head, arguments, span) = self.ground_call(whole, words)?;
        self.body.sink.mention(NameKind::Action, head, None);
        let world = self.body.world;
        let action = match world.task_or_action(head.text()).map(|s| s.head) {
            Some(SubtaskHead::Action(action)) => action,
            Some(SubtaskHead::DurativeAction(_)) => {
                self.body.sink.unexpected(head, "an action that takes no time");
                return None;
            }
            Some(SubtaskHead::Task(_)) | None => {
                world.unknown(self.body.sink, head, SymbolKind::Action);
                return None;
            }
        };
        let schema = &self.domain.actions[action];
        let of = (SymbolKind::Action, &schema.name, schema.variables.parameters());
        let arguments = self.arguments(span, arguments.into_iter(), of)?;
        Some(PlanStep { action, arguments, span })
    }

    fn task_line(
        &mut self,
        label: PlanLabel,
        number: Node<'a>,
        call: &[Node<'a>],
        behind: &[Node<'a>],
    ) -> Option<Written<'a>> {
        let (head, arguments, span) = self.ground_call(number.span(), call)?;
        self.body.sink.mention(NameKind::Task, head, None);
        let world = self.body.world;
        let task = match world.task_or_action(head.text()).map(|s| s.head) {
            Some(SubtaskHead::Task(task)) => {
                let schema = &self.domain.tasks[task];
                let of = (SymbolKind::Task, &schema.name, schema.variables.parameters());
                self.arguments(span, arguments.into_iter(), of).map(|arguments| (task, arguments))
            }
            _ => {
                world.unknown(self.body.sink, head, SymbolKind::Task);
                None
            }
        };
        let (method, subtasks) = match behind {
            [method, subtasks @ ..] if method.is_name() => (self.method(*method), subtasks),
            [other, subtasks @ ..] => {
                self.body.sink.unexpected(*other, "the name of a method");
                (None, subtasks)
            }
            [] => {
                let owner = format!("the decomposition of `{}`", head.text());
                self.body.sink.report(span, DiagnosticKind::Missing { owner, what: "method" });
                (None, behind)
            }
        };
        let subtasks = subtasks.to_vec();
        Some(Written { label, label_span: number.span(), task, method, span, subtasks })
    }

    fn method(&mut self, node: Node<'_>) -> Option<(MethodId, Span)> {
        self.body.sink.mention(NameKind::Method, node, None);
        let methods = &self.domain.methods;
        let found = methods.enumerate().find(|(_, m)| node.is(&m.name)).map(|(id, _)| (id, node.span()));
        if found.is_none() {
            let suggestion = self.body.sink.suggest(node.text(), methods.iter().map(|m| m.name.as_str()));
            let (symbol, name) = (SymbolKind::Method, node.text().to_owned());
            self.body.sink.report(node.span(), DiagnosticKind::Unknown { symbol, name, suggestion });
        }
        found
    }

    /// `action a b` or `(action a b)`: its head, arguments and place.
    fn ground_call(&mut self, whole: Span, words: &[Node<'a>]) -> Option<(Node<'a>, Vec<Node<'a>>, Span)> {
        let (parts, span): (Vec<Node<'a>>, Span) = match words {
            [] => {
                self.unexpected(whole, LINE);
                return None;
            }
            [call] if call.is_list() => (call.children().collect(), call.span()),
            [first, .., last] => (words.to_vec(), first.span().to(last.span())),
            [one] => (vec![*one], one.span()),
        };
        match parts.split_first() {
            Some((head, arguments)) if head.is_name() => Some((*head, arguments.to_vec(), span)),
            _ => {
                self.unexpected(span, "an action or a task, such as `action object`");
                None
            }
        }
    }

    /// The scope of the plan's numbers.
    fn whole_file(&self) -> Option<Span> {
        let end = u32::try_from(self.source.text().len()).expect("a source is shorter than 4 GiB");
        Some(Span::new(0, end))
    }

    fn references(&mut self, numbers: &[Node<'_>], labels: &Labels) -> Vec<PlanReference> {
        let mut references = Vec::with_capacity(numbers.len());
        for number in numbers {
            let (span, scope) = (number.span(), self.whole_file());
            self.body.sink.mention(NameKind::Subtask, *number, scope);
            match label(*number).map(|l| labels.get(&l)) {
                Some(Some((_, node))) => references.extend(node.map(|node| PlanReference { node, span })),
                Some(None) => {
                    let (symbol, name) = (SymbolKind::PlanStep, number.text().to_owned());
                    let kind = DiagnosticKind::Unknown { symbol, name, suggestion: None };
                    self.body.sink.report(span, kind);
                }
                None => self.body.sink.unexpected(*number, NUMBER),
            }
        }
        references
    }
}

fn label(node: Node<'_>) -> Option<PlanLabel> {
    let text = node.text();
    let digits = !node.is_list() && text.bytes().all(|b| b.is_ascii_digit());
    digits.then(|| text.parse().ok().map(PlanLabel)).flatten()
}

/// `->` arrives as two words, since no name starts with a hyphen.
fn is_arrow(words: &[Node<'_>]) -> bool {
    matches!(words, [a, b] if a.is("-") && b.is(">") && a.span().end == b.span().start)
}
