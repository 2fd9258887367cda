//! An agent: its rules, and the part of the graph that they read.
//!
//! Problem: an agent that looks at every commit pays for what never concerns it: a thousand people who walk past. Idea:
//! the patterns of its rules are its interest. The graph wakes the agent only for commits that may change a match, and
//! reports which matches appeared and disappeared.
//!
//! What an agent reads beside the conditions of its rules: who holds the resources that they claim, whether one of its
//! own reflexes fired, and, for a rule whose own beginning may break its condition over all, every token of that rule
//! (`Rule::unsure`).

use std::fmt;
use std::sync::Arc;

use dsr::{
    AgentId, AttributeId, Comparison, HolderTerm, Interest, LabelId, Pattern, PatternBuilder, PatternId,
    Priority, ResourceId, TypeId, Vocabulary,
};
use pddl::model::Name;

use super::rule::Rule;

/// The position of a rule in its agent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct RuleId(usize);

/// Why a pattern is in the interest of an agent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Concern {
    /// It is an alternative of the condition before this rule.
    Start {
        /// The rule.
        rule: RuleId,
        /// The position of the alternative.
        alternative: usize,
    },
    /// It is the lease of this resource, or one that a rule with its priority may take.
    Lease(ResourceId),
}

/// An agent: a writer of the graph with its rules.
pub struct Agent {
    /// Its name, as in the vocabulary.
    pub name: Name,
    /// Its identity as a writer.
    pub id: AgentId,
    /// Its rules, in the order of the file.
    rules: Vec<Rule>,
    interest: Interest,
    /// By pattern of the interest.
    concerns: Vec<Concern>,
}

impl Agent {
    pub(super) fn new(name: Name, id: AgentId, rules: Vec<Rule>, vocabulary: &Vocabulary) -> Self {
        let (mut interest, mut concerns) = (Interest::default(), Vec::new());
        interest.follow_reflexes(id);
        let mut claims = Vec::new();
        for (at, rule) in rules.iter().enumerate() {
            for (alternative, pattern) in rule.triggers().enumerate() {
                interest.add(Arc::clone(pattern));
                concerns.push(Concern::Start { rule: RuleId(at), alternative });
            }
            interest.add_tokens(rule.unsure());
            claims.extend(rule.claims.iter().map(|&resource| (resource, None)));
            claims.extend(rule.claims.iter().map(|&resource| (resource, Some(rule.priority))));
        }
        claims.sort_unstable();
        claims.dedup();
        for (resource, below) in claims {
            if let Some(pattern) = lease(resource, below, vocabulary) {
                interest.add(pattern);
                concerns.push(Concern::Lease(resource));
            }
        }
        Self { name, id, rules, interest, concerns }
    }

    /// The part of the graph that its rules read: what to subscribe to.
    pub fn interest(&self) -> Interest {
        self.interest.clone()
    }

    /// Why a pattern is in the interest.
    pub(crate) fn concern(&self, pattern: PatternId) -> Concern {
        self.concerns[pattern.index()]
    }

    /// The rules' names, in the order of the file.
    pub fn rule_names(&self) -> impl Iterator<Item = &Name> {
        self.rules.iter().map(|rule| &rule.name)
    }

    /// All rules' ids, in the order of the file.
    pub(crate) fn rule_ids(&self) -> impl Iterator<Item = RuleId> + use<> {
        (0..self.rules.len()).map(RuleId)
    }

    pub(crate) fn rule(&self, id: RuleId) -> &Rule {
        &self.rules[id.0]
    }

    pub(crate) fn enumerate(&self) -> impl Iterator<Item = (RuleId, &Rule)> {
        self.rules.iter().enumerate().map(|(index, rule)| (RuleId(index), rule))
    }
}

/// The pattern "an agent holds the resource"; or "… below this priority, and yields it", which the same lease may
/// become while its holder stays.
fn lease(resource: ResourceId, below: Option<Priority>, vocabulary: &Vocabulary) -> Option<Pattern> {
    let node = vocabulary.resource_node(resource)?;
    let mut pattern = PatternBuilder::new(vocabulary);
    let holder = pattern.variable("holder", TypeId::AGENT);
    pattern.edge(holder, LabelId::HOLDS, node);
    if let Some(priority) = below {
        let lease = HolderTerm::edge(holder, LabelId::HOLDS, node);
        pattern.guard(lease.clone(), AttributeId::PRIORITY, Comparison::Less, f64::from(priority.0));
        pattern.guard(lease, AttributeId::YIELDS, Comparison::Equal, true);
    }
    Some(pattern.build().expect("agents may hold resources in every vocabulary"))
}

impl fmt::Debug for Agent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Agent")
            .field("name", &self.name)
            .field("id", &self.id)
            .field("rules", &self.rules)
            .finish_non_exhaustive()
    }
}
