//! What a subscriber asks for: its part of the graph.
//!
//! Idea: patterns for what is looked at as a whole, tokens for what is read one by one, and agents for what they commit
//! and for their reflexes. One subscription has one queue for all of it, so what it reports is in the order of versions.

use std::sync::Arc;

use crate::delta::Delta;
use crate::id::AgentId;
use crate::mentions::Mentions;
use crate::pattern::Pattern;

/// A pattern of an [`Interest`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PatternId(usize);

impl PatternId {
    pub(crate) fn at(index: usize) -> Self {
        Self(index)
    }

    /// Its position, in the order in which the patterns were added.
    pub fn index(self) -> usize {
        self.0
    }
}

/// What a subscriber asks for. A commit that concerns none of it neither wakes the subscriber nor waits in its queue.
#[derive(Debug, Clone, Default)]
pub struct Interest {
    patterns: Vec<Arc<Pattern>>,
    tokens: Mentions,
    writer: Option<AgentId>,
    owner: Option<AgentId>,
}

impl Interest {
    /// Adds a pattern: the subscription reports which of its matches appear and disappear.
    pub fn add(&mut self, pattern: impl Into<Arc<Pattern>>) -> PatternId {
        self.patterns.push(pattern.into());
        PatternId(self.patterns.len() - 1)
    }

    /// Adds tokens: the subscription reports every commit that touches one of them.
    pub fn add_tokens(&mut self, tokens: &Mentions) {
        self.tokens.extend(tokens);
    }

    /// The subscription reports every commit of this agent.
    pub fn follow_commits(&mut self, writer: AgentId) {
        self.writer = Some(writer);
    }

    /// The subscription reports every commit in which a reflex of this agent fires.
    pub fn follow_reflexes(&mut self, owner: AgentId) {
        self.owner = Some(owner);
    }

    /// The patterns, in the order of their ids.
    pub(crate) fn patterns(&self) -> impl Iterator<Item = &Arc<Pattern>> {
        self.patterns.iter()
    }

    pub(crate) fn tokens(&self) -> &Mentions {
        &self.tokens
    }

    pub(crate) fn writer(&self) -> Option<AgentId> {
        self.writer
    }

    pub(crate) fn owner(&self) -> Option<AgentId> {
        self.owner
    }

    /// Whether a commit is to be reported whatever matches it changes. A reflex that fired may be another agent's.
    pub(crate) fn concerns(&self, delta: &Delta) -> bool {
        self.writer == Some(delta.writer)
            || (self.owner.is_some() && !delta.reflexes.is_empty())
            || (!self.tokens.is_empty() && self.tokens.intersects(&Mentions::of(delta)))
    }
}

impl<P: Into<Arc<Pattern>>> From<P> for Interest {
    fn from(pattern: P) -> Self {
        let mut interest = Self::default();
        interest.add(pattern);
        interest
    }
}
