//! `(:durative-action …)`: temporal actions, agents' rules, intentions.
//!
//! The keys `:skill`, `:results`, `:claims`, `:priority` make it a rule; they need `:agent-rules`. Results
//! are read right after the parameters, wherever they stand, because effects may name them.

use super::action::{agent, named};
use super::body::Body;
use super::keys::Keys;
use super::schema::Owner;
use super::sink::Sink;
use super::world::World;
use crate::diagnostic::DiagnosticKind;
use crate::model::{
    Comparison, DurationConstraint, DurativeAction, Name, Requirement, Rule, SkillCall, Term, TimeSpecifier,
    VariableId,
};
use crate::occurrence::NameKind;
use crate::syntax::Node;

const RULE_KEYS: [&str; 4] = [":skill", ":results", ":claims", ":priority"];

const KEYS: &[&str] =
    &[":parameters", ":duration", ":condition", ":effect", ":skill", ":results", ":claims", ":priority"];

pub(crate) fn durative_action(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<DurativeAction> {
    let (name, name_span, rest) = named(sink, section, NameKind::Action, "the durative action")?;
    let (agent, rest) = agent(rest);
    let keys = Keys::read(sink, rest.into_iter(), "a durative action", KEYS);
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    body.parameters_behind(&agent, &keys);
    body.schema.owner = Owner::Durative;
    let results = body.results(&keys);
    let mut duration = Vec::new();
    if let Some(node) = keys.get(":duration") {
        body.duration(node, &TimeSpecifier::Start, &mut duration);
    }
    let (mut conditions, mut preferences) = (Vec::new(), Vec::new());
    if let Some(node) = keys.get(":condition") {
        body.timed_conditions(node, None, &mut conditions);
        preferences = body.timed_preferences(node);
    }
    let (mut effects, mut continuous) = (Vec::new(), Vec::new());
    if let Some(node) = keys.get(":effect") {
        body.timed_effects(node, None, &mut effects);
        body.effects_across_times(node, &mut effects);
        continuous = body.continuous_effects(node);
    }
    let rule = body.rule(&keys, results);
    let (variables, span) = (body.schema.variables, section.span());
    Some(DurativeAction {
        name,
        variables,
        duration,
        conditions,
        preferences,
        effects,
        continuous,
        rule,
        span,
        name_span,
    })
}

impl Body<'_> {
    fn results(&mut self, keys: &Keys<'_>) -> Vec<VariableId> {
        match keys.get(":results") {
            Some(node) if node.is_list() => self.schema.bind(self.world, self.sink, node.children()),
            Some(node) => {
                self.sink.unexpected(node, "a list of variables such as `(?x - type)`");
                Vec::new()
            }
            None => Vec::new(),
        }
    }

    fn duration(&mut self, node: Node<'_>, when: &TimeSpecifier, into: &mut Vec<DurationConstraint>) {
        const EXPECTED: &str = "`(= ?duration NUMBER)`, or `<=` or `>=`";
        let Some(head) = node.head() else {
            if !node.is_list() {
                self.sink.unexpected(node, EXPECTED);
            }
            return;
        };
        let comparison = match () {
            () if head.is("and") => {
                for part in node.children().skip(1) {
                    self.duration(part, when, into);
                }
                return;
            }
            () if head.is("at") => {
                let Some([time, what]) = self.parts(node, "`(at start CONSTRAINT)`") else { return };
                match () {
                    () if time.is("start") => self.duration(what, &TimeSpecifier::Start, into),
                    () if time.is("end") => self.duration(what, &TimeSpecifier::End, into),
                    () => self.sink.unexpected(time, "`start` or `end`"),
                }
                return;
            }
            () if head.is("=") => Comparison::Equal,
            () if head.is("<=") => Comparison::LessEqual,
            () if head.is(">=") => Comparison::GreaterEqual,
            () => return self.sink.unexpected(node, EXPECTED),
        };
        let Some([mut left, mut right]) = self.parts(node, EXPECTED) else { return };
        let mut comparison = comparison;
        if right.is("?duration") && !left.is("?duration") {
            (left, right) = (right, left);
            comparison = match comparison {
                Comparison::LessEqual => Comparison::GreaterEqual,
                Comparison::GreaterEqual => Comparison::LessEqual,
                other => other,
            };
        }
        if !left.is("?duration") {
            self.sink.unexpected(left, "`?duration`");
        }
        let (bound, functions) = self.binding(|body| body.expression(right));
        if let Some(bound) = bound {
            let when = when.clone();
            into.push(DurationConstraint { when, comparison, bound, functions, span: node.span() });
        }
    }

    /// The rule's own part, if a key makes the action a rule.
    fn rule(&mut self, keys: &Keys<'_>, results: Vec<VariableId>) -> Option<Rule> {
        let present: Vec<Node<'_>> = RULE_KEYS.iter().filter_map(|k| keys.key(k)).collect();
        if present.is_empty() {
            return None;
        }
        if !self.world.has(Requirement::AgentRules) {
            for key in &present {
                let kind = DiagnosticKind::NeedsRequirement {
                    name: key.text().to_owned(),
                    requirement: Requirement::AgentRules.as_str(),
                };
                self.sink.report(key.span(), kind);
            }
        }
        let skill = keys.get(":skill").and_then(|node| self.skill(node));
        let claims = keys.get(":claims").map(|node| self.claims(node)).unwrap_or_default();
        let priority = keys.get(":priority").map_or(0, |node| self.priority(node));
        Some(Rule { skill, results, claims, priority })
    }

    fn skill(&mut self, node: Node<'_>) -> Option<SkillCall> {
        let Some(name) = node.head().filter(|h| h.is_name()) else {
            self.sink.unexpected(node, "a skill and what it is given, such as `(say ?text)`");
            return None;
        };
        self.sink.mention(NameKind::Skill, name, None);
        let arguments = self.terms(node.children().skip(1));
        Some(SkillCall { name: Name::new(name.text()), arguments, span: node.span() })
    }

    fn claims(&mut self, node: Node<'_>) -> Vec<Term> {
        if !node.is_list() {
            self.sink.unexpected(node, "a list of resources such as `(speaker)`");
        }
        self.terms(node.children())
    }

    fn terms<'t>(&mut self, nodes: impl Iterator<Item = Node<'t>>) -> Vec<Term> {
        let mut terms = Vec::new();
        for node in nodes {
            terms.extend(self.term(node));
        }
        terms
    }

    fn priority(&mut self, node: Node<'_>) -> i32 {
        let number = if node.is_list() { None } else { node.text().parse().ok() };
        number.unwrap_or_else(|| {
            self.sink.unexpected(node, "a whole number");
            0
        })
    }
}
