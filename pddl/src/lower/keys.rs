//! `:key value` pairs of actions, tasks, methods and networks.

use super::sink::Sink;
use crate::diagnostic::DiagnosticKind;
use crate::syntax::{Node, NodeKind};
use diagnostics::nearest;

/// The pairs of one definition.
pub(crate) struct Keys<'t> {
    pairs: Vec<(Node<'t>, Option<Node<'t>>)>,
}

impl<'t> Keys<'t> {
    /// Reads pairs; a node that is not a key, or not one in `known`, is reported and left out. A key may
    /// lack its value (`:precondition` before the next key), as in some competition files.
    pub(crate) fn read(
        sink: &mut Sink,
        nodes: impl Iterator<Item = Node<'t>>,
        owner: &'static str,
        known: &'static [&'static str],
    ) -> Self {
        let mut pairs: Vec<(Node<'t>, Option<Node<'t>>)> = Vec::new();
        let mut nodes = nodes.peekable();
        while let Some(key) = nodes.next() {
            if key.kind() != NodeKind::Keyword {
                sink.unexpected(key, "a key such as `:parameters`");
                continue;
            }
            let value = nodes.next_if(|n| n.kind() != NodeKind::Keyword);
            if !known.iter().any(|k| key.is(k)) {
                let suggestion = nearest(key.text(), known.iter().copied());
                let name = key.text().to_owned();
                sink.report(key.span(), DiagnosticKind::UnknownKey { name, owner, suggestion });
            } else if pairs.iter().any(|(k, _)| k.is(key.text())) {
                sink.report(key.span(), DiagnosticKind::Repeated { name: key.text().to_owned() });
            } else {
                pairs.push((key, value));
            }
        }
        Self { pairs }
    }

    /// The key's own node.
    pub(crate) fn key(&self, name: &str) -> Option<Node<'t>> {
        self.pairs.iter().find(|(k, _)| k.is(name)).map(|(k, _)| *k)
    }

    /// The value of a key.
    pub(crate) fn get(&self, name: &str) -> Option<Node<'t>> {
        self.pairs.iter().find(|(k, _)| k.is(name)).and_then(|(_, v)| *v)
    }
}
