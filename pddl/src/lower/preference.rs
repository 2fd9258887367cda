//! `(preference name …)` in goals, preconditions, timed conditions and constraints.
//!
//! Preferences stand at the top, below `and` and `forall` only. The condition around them is read twice:
//! first without preferences, then each preference, with its own slots for the enclosing `forall`s. So a
//! condition that is printed before its preferences is read to the same slots. Cost: a walk down the
//! conjunctions, and another over their parts where there are preferences.

use super::body::Body;
use super::timed::{Timed, timed};
use crate::diagnostic::DiagnosticKind;
use crate::model::{Condition, ConditionKind, Name, Preference, TimeSpecifier};
use crate::occurrence::NameKind;
use crate::syntax::Node;

/// A preference with its context.
#[derive(Clone)]
pub(super) struct Found<'t> {
    pub(super) node: Node<'t>,
    foralls: Vec<Node<'t>>,
    /// The time, if it stands around the preference and not in it.
    pub(super) time: Option<TimeSpecifier>,
}

impl Body<'_> {
    /// A preference, unless a predicate has that name.
    pub(super) fn is_preference(&self, node: Node<'_>) -> bool {
        node.is_headed("preference") && self.world.predicate("preference").is_none()
    }

    /// Whether a part of a condition consists of preferences alone.
    pub(super) fn is_soft(&self, node: Node<'_>) -> bool {
        if node.is_headed("and") {
            let mut parts = node.children().skip(1).peekable();
            return parts.peek().is_some() && parts.all(|part| self.is_soft(part));
        }
        let body = node.children().nth(2);
        self.is_preference(node)
            || node.is_headed("forall") && body.is_some_and(|body| self.is_soft(body))
            || self.time_around(node).is_some_and(|(_, what)| self.is_soft(what))
    }

    /// The preferences at the top of `node`, in order.
    pub(super) fn preferences_in<'t>(&self, node: Node<'t>) -> Vec<Found<'t>> {
        let mut found = Vec::new();
        let mut around = Found { node, foralls: Vec::new(), time: None };
        self.find_preferences(node, &mut around, &mut found);
        found
    }

    fn find_preferences<'t>(&self, node: Node<'t>, around: &mut Found<'t>, into: &mut Vec<Found<'t>>) {
        if node.is_headed("and") {
            for part in node.children().skip(1) {
                self.find_preferences(part, around, into);
            }
        } else if node.is_headed("forall") {
            if let Some(body) = node.children().nth(2) {
                around.foralls.push(node);
                self.find_preferences(body, around, into);
                around.foralls.pop();
            }
        } else if self.is_preference(node) {
            into.push(Found { node, ..around.clone() });
        } else if around.time.is_none()
            && let Some((time, what)) = self.time_around(node)
        {
            around.time = Some(time);
            self.find_preferences(what, around, into);
            around.time = None;
        }
    }

    /// `(at start …)` and other times in durative actions.
    fn time_around<'t>(&self, node: Node<'t>) -> Option<(TimeSpecifier, Node<'t>)> {
        match timed(node, false) {
            Timed::At(time, what) if self.schema.is_durative() => Some((time, what)),
            _ => None,
        }
    }

    /// Reads a condition and the preferences at its top.
    pub(crate) fn soft_condition(&mut self, node: Node<'_>) -> (Condition, Vec<Preference<Condition>>) {
        let found = self.preferences_in(node);
        if found.is_empty() {
            return (self.condition(node), Vec::new());
        }
        let hard = self.hard_condition(node);
        let read = |body: &mut Self, node| Some(body.condition(node));
        let soft = found.into_iter().filter_map(|f| self.preference(&f, read)).collect();
        (hard, soft)
    }

    /// Reads a condition without the preferences at its top.
    pub(super) fn hard_condition(&mut self, node: Node<'_>) -> Condition {
        let span = node.span();
        if self.is_soft(node) {
            return Condition::always(span);
        }
        if self.preferences_in(node).is_empty() {
            return self.condition(node);
        }
        if node.is_headed("forall") {
            let Some((bound, inner)) = self.quantifier(node) else { return Condition::always(span) };
            let inner = self.hard_condition(inner);
            self.schema.unbind(bound.len());
            return Condition { kind: ConditionKind::Forall(bound, Box::new(inner)), span };
        }
        let mut parts = Vec::new();
        for part in node.children().skip(1) {
            if !self.is_soft(part) {
                parts.push(self.hard_condition(part));
            }
        }
        match parts.pop() {
            Some(only) if parts.is_empty() => only,
            last => {
                parts.extend(last);
                Condition { kind: ConditionKind::And(parts), span }
            }
        }
    }

    /// Reads one preference with its body.
    pub(super) fn preference<'t, T>(
        &mut self,
        found: &Found<'t>,
        read: impl FnOnce(&mut Self, Node<'t>) -> Option<T>,
    ) -> Option<Preference<T>> {
        let mut forall = Vec::new();
        for &around in &found.foralls {
            forall.extend(self.quantifier(around)?.0);
        }
        let parts: Vec<Node<'t>> = found.node.children().collect();
        let preference = match parts.as_slice() {
            [word, body] if body.is_list() => Some((*word, None, *body)),
            [_, name, body] if name.is_name() && body.is_list() => {
                self.sink.declare(NameKind::Preference, *name, None);
                Some((*name, Some(Name::new(name.text())), *body))
            }
            _ => {
                self.sink.unexpected(found.node, "`(preference NAME CONDITION)`");
                None
            }
        };
        let preference = preference.and_then(|(at, name, body)| {
            let body = read(self, body)?;
            Some(Preference {
                name,
                forall: forall.clone(),
                body,
                span: found.node.span(),
                name_span: at.span(),
            })
        });
        self.schema.unbind(forall.len());
        preference
    }

    /// Reports a preference in a place that does not allow one.
    pub(super) fn misplaced_preference(&mut self, node: Node<'_>) {
        self.sink.report(super::sink::first_word(node), DiagnosticKind::MisplacedPreference);
    }
}
