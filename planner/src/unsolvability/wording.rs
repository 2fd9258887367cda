//! An explanation in words: a sentence, and a tree of reasons below it.
//!
//! Idea: the sentence names the parts of the goal that nothing can achieve. The tree below it shows each reason once,
//! indented under the literal that needs it, down to the literals without achievers. Invariant: the words claim nothing
//! that the explanation does not contain. Cost: the lines, and the names of a list, are bounded.

use super::{
    Achiever, Explanation, Extent, Literal, Need, Never, NeverCompares, Obstruction, ReasonId, Space, Why,
};
use crate::ids::FactId;
use crate::task::Task;
use analysis::text::listed;

/// The most lines of a tree.
const LINES: usize = 40;
/// The most names of a list.
const NAMES: usize = 12;

/// An explanation with the names of its task.
#[derive(Clone, Copy, Debug)]
pub struct Wording<'a> {
    task: &'a Task,
    explanation: &'a Explanation,
}

impl<'a> Wording<'a> {
    /// The wording of an explanation for this task.
    pub fn new(task: &'a Task, explanation: &'a Explanation) -> Self {
        Self { task, explanation }
    }

    /// The whole explanation in one sentence.
    pub fn sentence(&self) -> String {
        let Explanation { parts, exclusive, space, .. } = self.explanation;
        let mut sentences = Vec::new();
        let single = |never: &[Never]| matches!(never, [Never::Literal(_)]);
        let plain: Vec<String> =
            parts.iter().filter(|p| single(&p.never)).map(|p| self.never(&p.never[0])).collect();
        if !plain.is_empty() {
            sentences
                .push(format!("the goal needs {}, which nothing can bring about", listed(&plain, "and")));
        }
        for part in parts.iter().filter(|p| !single(&p.never)) {
            let all: Vec<String> = part.never.iter().map(|never| self.never(never)).collect();
            sentences.push(match part.never.as_slice() {
                [Never::Number(own)] => format!("the goal needs {}, but {}", own.comparison, bounded(own)),
                [Never::Condition(_)] => "a part of the goal is never true".to_owned(),
                _ => format!("the goal needs {}, and nothing can bring any of it about", listed(&all, "or")),
            });
        }
        for pair in exclusive {
            let [a, b] = &pair.pair;
            sentences.push(format!("the goal needs {a} and {b} together, which exclude each other"));
        }
        if sentences.is_empty() {
            sentences.push(match space {
                Some(_) => "no reachable state satisfies the goal".to_owned(),
                None => "nothing can bring the goal about".to_owned(),
            });
        }
        sentences.join("; ")
    }

    /// The lines below the sentence.
    pub fn lines(&self) -> Vec<String> {
        let mut tree =
            Tree { of: self, shown: vec![false; self.explanation.reasons.len()], lines: Vec::new() };
        for part in &self.explanation.parts {
            for never in &part.never {
                if let Never::Literal(id) = never {
                    tree.reason(*id, 1);
                }
            }
        }
        let mut lines = tree.lines;
        let more = lines.len().saturating_sub(LINES);
        lines.truncate(LINES);
        if more > 0 {
            lines.push(format!("  and {more} more"));
        }
        for pair in &self.explanation.exclusive {
            let [a, b] = &pair.pair;
            lines.push(format!("  {a} and {b}: both can't hold at once: group {}", first(&pair.group)));
        }
        if let Some(space) = &self.explanation.space {
            self.space(space, &mut lines);
        }
        lines
    }

    /// The shortest path from the goal down to an achiever that the query excludes or, without one, to a literal
    /// without achievers. Has a line for each literal on the path. Empty if no part of the goal is a literal.
    pub fn chain(&self) -> Vec<String> {
        let mut above: Vec<Option<(ReasonId, &Achiever)>> = vec![None; self.explanation.reasons.len()];
        let parts = self.explanation.parts.iter().flat_map(|part| &part.never);
        let mut order: Vec<ReasonId> = Vec::new();
        for never in parts {
            if let Never::Literal(id) = never
                && !order.contains(id)
            {
                order.push(*id);
            }
        }
        let mut next = 0;
        while let Some(&id) = order.get(next) {
            next += 1;
            let Why::Achievers { achievers, .. } = &self.explanation.reason(id).why else { continue };
            for achiever in achievers {
                for lacking in needed(achiever) {
                    if !order.contains(&lacking) {
                        order.push(lacking);
                        above[lacking.0 as usize] = Some((id, achiever));
                    }
                }
            }
        }
        let excluded = |id: &ReasonId| match &self.explanation.reason(*id).why {
            Why::Achievers { achievers, .. } => {
                achievers.iter().find(|achiever| achiever.obstruction == Obstruction::Excluded)
            }
            _ => None,
        };
        let is_not_given = |id: &&ReasonId| self.explanation.reason(**id).why == Why::NothingAchieves;
        let wanted = |id: ReasonId| &self.explanation.reason(id).wanted;
        let name = |id: ReasonId| self.wanted(wanted(id));
        let end = order.iter().find_map(|id| Some((*id, self.hindered(&name(*id), excluded(id)?, name))));
        let end = end.or_else(|| order.iter().find(is_not_given).map(|&id| (id, self.not_given(wanted(id)))));
        let Some((mut at, line)) = end else { return Vec::new() };
        let mut lines = vec![line];
        while let Some((id, achiever)) = above[at.0 as usize] {
            lines.push(self.hindered(&name(id), achiever, name));
            at = id;
        }
        lines.reverse();
        lines
    }

    /// Why an achiever is impossible, in one line.
    fn hindered(&self, wanted: &str, achiever: &Achiever, name: impl Fn(ReasonId) -> String) -> String {
        let by = self.achiever(achiever).unwrap_or_else(|| "its axiom".to_owned());
        let head = format!("{wanted} by {by}");
        match &achiever.obstruction {
            Obstruction::Needs(needs) => {
                let all = needs.iter().map(|need| match need {
                    Need::Literal(id) => name(*id),
                    Need::Number(own) => format!("{}, but {}", own.comparison, bounded(own)),
                });
                format!("{head} needs {}", listed(&all.collect::<Vec<_>>(), "and"))
            }
            Obstruction::NeverTogether(all) => {
                let all: Vec<String> = all.iter().map(|wanted| self.wanted(wanted)).collect();
                format!("{head} needs {}, never for the same objects", listed(&all, "and"))
            }
            Obstruction::NeverApplies => format!("{head}, but what it needs never holds together"),
            Obstruction::Excluded => format!("{head}, which may not be used"),
        }
    }

    fn not_given(&self, wanted: &Literal) -> String {
        let name = self.task.pattern_name(&wanted.pattern);
        if wanted.positive { format!("nothing gives {name}") } else { format!("nothing takes {name} away") }
    }

    fn space(&self, space: &Space, lines: &mut Vec<String>) {
        let names =
            |goals: &[(FactId, bool)]| first(&goals.iter().map(|&goal| self.goal(goal)).collect::<Vec<_>>());
        let states = counted(space.states as usize, "state", "states");
        let steps = match space.nearest.steps.len() {
            0 => "the one to begin with".to_owned(),
            n => format!("after {}", counted(n, "step", "steps")),
        };
        let missing = names(&space.nearest.missing);
        lines.push(if space.complete {
            format!("  exhausted: {states}; the nearest to the goal, {steps}, misses {missing}")
        } else {
            format!("  exhausted; of the first {states} the nearest to the goal, {steps}, misses {missing}")
        });
        if !space.never.is_empty() {
            lines.push(format!("  in no state: {}", names(&space.never)));
        }
        for &[a, b] in space.apart.iter().take(NAMES) {
            lines.push(format!("  never together: {} and {}", self.goal(a), self.goal(b)));
        }
        if space.apart.len() > NAMES {
            lines.push(format!("  and {} more pairs", space.apart.len() - NAMES));
        }
        for (fluent, low, high) in space.numbers.iter().take(NAMES) {
            lines.push(format!("  {} is between {low} and {high}", self.task.fluent_name(fluent)));
        }
    }

    fn never(&self, never: &Never) -> String {
        match never {
            Never::Literal(id) => self.wanted(&self.explanation.reason(*id).wanted),
            Never::Number(own) => own.comparison.clone(),
            Never::Condition(_) => "a condition that is never true".to_owned(),
        }
    }

    /// A literal in PDDL.
    pub fn wanted(&self, wanted: &Literal) -> String {
        let name = self.task.pattern_name(&wanted.pattern);
        if wanted.positive { name } else { format!("(not {name})") }
    }

    /// A goal of the task in PDDL.
    pub fn goal(&self, (fact, positive): (FactId, bool)) -> String {
        let known = &self.task.facts()[fact];
        let name = if known.atom.is_none() && known.value.is_none() && !known.compares {
            "(or …)".to_owned()
        } else {
            self.task.fact_name(fact)
        };
        if positive { name } else { format!("(not {name})") }
    }

    /// The action with its arguments as far as they are bound; `None` for an axiom.
    pub fn achiever(&self, achiever: &Achiever) -> Option<String> {
        achiever.action.map(|action| self.task.schema_name(action, &achiever.arguments))
    }
}

/// The tree of reasons as lines, each reason once.
struct Tree<'a> {
    of: &'a Wording<'a>,
    shown: Vec<bool>,
    lines: Vec<String>,
}

impl Tree<'_> {
    fn reason(&mut self, id: ReasonId, depth: usize) {
        if std::mem::replace(&mut self.shown[id.0 as usize], true) {
            return;
        }
        let of = self.of;
        let reason = of.explanation.reason(id);
        let (indent, wanted) = ("  ".repeat(depth), of.wanted(&reason.wanted));
        match &reason.why {
            Why::NothingAchieves => self.lines.push(format!("{indent}{}", of.not_given(&reason.wanted))),
            Why::Unexplored => self.lines.push(format!("{indent}{wanted} is never true")),
            Why::Achievers { achievers, more } => {
                for achiever in achievers {
                    self.achiever(&wanted, achiever, depth);
                }
                if *more > 0 {
                    self.lines.push(format!("{indent}{wanted}: and {more} more ways, all barred"));
                }
            }
        }
    }

    fn achiever(&mut self, wanted: &str, achiever: &Achiever, depth: usize) {
        let of = self.of;
        let name = |id: ReasonId| {
            let name = of.wanted(&of.explanation.reason(id).wanted);
            if self.shown[id.0 as usize] { format!("{name} (see above)") } else { name }
        };
        let line = of.hindered(wanted, achiever, name);
        self.lines.push(format!("{}{line}", "  ".repeat(depth)));
        for id in needed(achiever) {
            self.reason(id, depth + 1);
        }
    }
}

/// The literals that an achiever lacks.
fn needed(achiever: &Achiever) -> impl Iterator<Item = ReasonId> {
    let needs = match &achiever.obstruction {
        Obstruction::Needs(needs) => needs.as_slice(),
        _ => &[],
    };
    needs.iter().filter_map(|need| match need {
        Need::Literal(id) => Some(*id),
        Need::Number(_) => None,
    })
}

/// `(fuel a) never gets above 7`.
fn bounded(never: &NeverCompares) -> String {
    let measured = &never.measured;
    match never.extent {
        Extent::Undefined => format!("{measured} never has a value"),
        Extent::AtMost(bound) => format!("{measured} never gets above {bound}"),
        Extent::Below(bound) => format!("{measured} stays below {bound}"),
        Extent::AtLeast(bound) => format!("{measured} never gets below {bound}"),
        Extent::Above(bound) => format!("{measured} stays above {bound}"),
    }
}

/// The first [`NAMES`] of a list, and the number of the others.
fn first(all: &[String]) -> String {
    let shown = all.iter().take(NAMES).cloned().collect::<Vec<_>>().join(", ");
    if all.len() > NAMES { format!("{shown} and {} more", all.len() - NAMES) } else { shown }
}

/// `1 state`, `2 states`.
fn counted(count: usize, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}
