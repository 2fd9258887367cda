//! Turns the result of the search into a plan with its decomposition.

use super::grammar::{Grammar, Rule, RuleId, Slot, Symbol, SymbolId};
use super::outlook::Outlook;
use super::progress::Event;
use super::situation::NodeId;
use budget::{Interrupted, Meter};
use pddl::model::Idx;
use pddl::{
    Decomposition, DecompositionId, HierarchicalPlan, LabelledStep, LabelledStepId, PlanLabel, PlanNode,
    PlanReference, SequentialPlan, Span,
};
use rustc_hash::FxHashMap;
use std::collections::VecDeque;

/// The end from which the search read the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    Forward,
    Backward,
}

/// The result for a node.
#[derive(Clone, Copy)]
enum Became {
    Rule { rule: RuleId, first: u32 },
    Nothing { symbol: SymbolId, start: Slot },
    Step(u32),
}

struct Rebuild<'r> {
    grammar: &'r Grammar,
    outlook: &'r Outlook,
    nodes: FxHashMap<NodeId, Became>,
    plan: HierarchicalPlan,
    /// The tasks whose subtasks are still to be added; `None` is the root.
    waiting: VecDeque<(Option<DecompositionId>, RuleId, Vec<Became>)>,
}

pub(super) fn rebuild(
    plan: &SequentialPlan,
    grammar: &Grammar,
    outlook: &Outlook,
    direction: Direction,
    events: Vec<Event>,
    meter: &Meter<'_>,
) -> Result<HierarchicalPlan, Interrupted> {
    let last = grammar.end().saturating_sub(1);
    let became = |event| match event {
        Event::Applied { node, rule, first } => (node, Became::Rule { rule, first }),
        Event::Vanished { node, symbol, start } => (node, Became::Nothing { symbol, start }),
        Event::Taken { node, step } if direction == Direction::Forward => (node, Became::Step(step)),
        Event::Taken { node, step } => (node, Became::Step(last - step)),
    };
    let steps = (0..).zip(&plan.steps).map(|(label, step)| LabelledStep {
        label: PlanLabel(label),
        label_span: step.span,
        step: step.clone(),
    });
    let mut rebuild = Rebuild {
        grammar,
        outlook,
        nodes: events.into_iter().map(became).collect(),
        plan: HierarchicalPlan { steps: steps.collect(), ..HierarchicalPlan::default() },
        waiting: VecDeque::new(),
    };
    if let Some(root) = rebuild.nodes.get(&NodeId(0)).copied()
        && let Some((rule, parts)) = rebuild.parts(root)
    {
        rebuild.waiting.push_back((None, rule, parts));
    }
    while let Some((of, rule, parts)) = rebuild.waiting.pop_front() {
        meter.spend(1 + parts.len())?;
        rebuild.enter(of, &grammar.rules[rule], &parts);
    }
    Ok(rebuild.plan)
}

impl Rebuild<'_> {
    /// The rule that decomposes a node, with the results for the rule's nodes.
    fn parts(&self, became: Became) -> Option<(RuleId, Vec<Became>)> {
        match became {
            Became::Step(_) => None,
            Became::Rule { rule, first } => {
                let count = u32::try_from(self.grammar.rules[rule].nodes.len()).unwrap_or(u32::MAX);
                let nodes = (first..first + count).filter_map(|node| self.nodes.get(&NodeId(node)).copied());
                Some((rule, nodes.collect()))
            }
            Became::Nothing { symbol, start } => {
                let id = self.outlook.vanish(symbol, start)?.by?;
                let rule = &self.grammar.rules[id];
                let starts = self.outlook.starts(rule, start);
                let nodes = rule.nodes.iter().zip(starts);
                Some((id, nodes.map(|(&symbol, start)| Became::Nothing { symbol, start }).collect()))
            }
        }
    }

    fn enter(&mut self, of: Option<DecompositionId>, rule: &Rule, parts: &[Became]) {
        let mut places: Vec<(u32, usize)> =
            (0..).zip(&rule.subtask).filter_map(|(place, subtask)| Some(((*subtask)?, place))).collect();
        places.sort_unstable();
        let mut references = Vec::with_capacity(places.len());
        for (_, place) in places {
            let Some(&became) = parts.get(place) else { continue };
            let node = match self.parts(became) {
                None => match became {
                    Became::Step(step) => PlanNode::Step(LabelledStepId(step)),
                    Became::Rule { .. } | Became::Nothing { .. } => continue,
                },
                Some((way, below)) => {
                    let Symbol::Task { task, arguments } = &self.grammar.symbols[rule.nodes[place]] else {
                        continue;
                    };
                    let Some(method) = self.grammar.rules[way].method else { continue };
                    let id = DecompositionId::from_index(self.plan.decompositions.len());
                    let label = PlanLabel((self.plan.steps.len() + id.index()) as u64);
                    self.plan.decompositions.push(Decomposition {
                        label,
                        label_span: Span::default(),
                        task: *task,
                        arguments: arguments.to_vec(),
                        method,
                        method_span: Span::default(),
                        subtasks: Vec::new(),
                        span: Span::default(),
                    });
                    self.waiting.push_back((Some(id), way, below));
                    PlanNode::Decomposition(id)
                }
            };
            references.push(PlanReference { node, span: Span::default() });
        }
        match of {
            None => self.plan.roots = references,
            Some(task) => self.plan.decompositions[task].subtasks = references,
        }
    }
}
