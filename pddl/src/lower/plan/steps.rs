//! Sequential and temporal plans: `(action object …)`, `3: (…)`, `0.003: (…) [4.000]`.
//!
//! The tree has the actions as lists. The text around them comes in words that ignore `:` and brackets
//! (`0.003:`, `[`, `4.0]`), so those are cut into pieces first. An unexpected piece is reported once a line,
//! and reading continues at the next time or list.

use super::{Reader, STEP};
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{ActionId, Name, ObjectId, SubtaskHead, Variable};
use crate::occurrence::NameKind;
use crate::syntax::Node;
use crate::{
    Decimal, NotADecimal, Plan, PlanStep, SequentialPlan, Span, StepHead, TemporalPlan, TemporalStep,
};

const TIME: &str = "a time such as `0.003`";
const DURATION: &str = "a duration such as `[4.000]`";

#[derive(Clone, Copy)]
enum Piece<'t> {
    List(Node<'t>),
    Word,
    Colon,
    Open,
    Close,
}

/// A number with its place; `None` if an error was reported there.
type Figure = (Option<Decimal>, Span);

/// A step before its names are looked up.
struct Written<'t> {
    node: Node<'t>,
    time: Option<Figure>,
    duration: Option<Figure>,
}

impl<'a> Reader<'a> {
    pub(super) fn steps(&mut self) -> Plan {
        let written = self.written();
        let cost = self.claimed_cost();
        if self.is_temporal(&written) {
            let steps = written.iter().filter_map(|step| self.temporal_step(step)).collect();
            return Plan::Temporal(TemporalPlan { steps, cost });
        }
        self.check_numbers(&written);
        let steps = written.iter().filter_map(|step| self.sequential_step(step.node)).collect();
        Plan::Sequential(SequentialPlan { steps, cost })
    }

    /// The text outside of lists, cut at colons and brackets. A sign stays with its number.
    fn pieces(&self) -> Vec<(Piece<'a>, Span)> {
        let mut pieces: Vec<(Piece<'a>, Span)> = Vec::new();
        for root in self.tree.roots() {
            if root.is_list() {
                pieces.push((Piece::List(root), root.span()));
                continue;
            }
            let mut from = root.span().start;
            for part in root.text().split_inclusive([':', '[', ']']) {
                let word = part.trim_end_matches([':', '[', ']']);
                let length = |text: &str| u32::try_from(text.len()).expect("a part of a source");
                let (behind_word, end) = (from + length(word), from + length(part));
                if !word.is_empty() {
                    match pieces.last_mut() {
                        Some((Piece::Word, last)) if last.end == from && self.source.slice(*last) == "-" => {
                            last.end = behind_word;
                        }
                        _ => pieces.push((Piece::Word, Span::new(from, behind_word))),
                    }
                }
                let mark = match &part[word.len()..] {
                    ":" => Some(Piece::Colon),
                    "[" => Some(Piece::Open),
                    "]" => Some(Piece::Close),
                    _ => None,
                };
                pieces.extend(mark.map(|mark| (mark, Span::new(behind_word, end))));
                from = end;
            }
        }
        pieces
    }

    /// `[TIME :] (ACTION …) [ [DURATION] ]`, any number of times.
    fn written(&mut self) -> Vec<Written<'a>> {
        let pieces = self.pieces();
        let mut written = Vec::new();
        let mut next = 0;
        while next < pieces.len() {
            let mut time = None;
            if starts_time(&pieces, next) {
                let span = pieces[next].1;
                time = Some(self.figure(span, TIME));
                next += 2;
                if !matches!(pieces.get(next), Some((Piece::List(_), _))) {
                    let owner = format!("the time `{}`", self.source.slice(span));
                    self.body.sink.report(span, DiagnosticKind::Missing { owner, what: "step behind it" });
                    continue;
                }
            }
            let Some((Piece::List(node), _)) = pieces.get(next) else {
                next = self.skip_line(&pieces, next, STEP);
                continue;
            };
            next += 1;
            let mut duration = None;
            if let Some((Piece::Open, open)) = pieces.get(next) {
                match pieces.get(next + 1..next + 3) {
                    Some([(Piece::Word, span), (Piece::Close, close)]) => {
                        let (value, _) = self.figure(*span, DURATION);
                        duration = Some((value, open.to(*close)));
                        next += 3;
                    }
                    // LPG's `[D:1.00; C:0.10]`: `;` starts a comment, which includes the bracket.
                    Some([(Piece::Word, letter), (Piece::Colon, _)])
                        if self.source.slice(*letter).eq_ignore_ascii_case("D")
                            && matches!(pieces.get(next + 3), Some((Piece::Word, _))) =>
                    {
                        let span = pieces[next + 3].1;
                        let (value, _) = self.figure(span, DURATION);
                        duration = Some((value, open.to(span)));
                        next += 4;
                        next += usize::from(matches!(pieces.get(next), Some((Piece::Close, _))));
                    }
                    _ => {
                        duration = Some((None, *open));
                        next = self.skip_line(&pieces, next, DURATION);
                    }
                }
            }
            written.push(Written { node: *node, time, duration });
        }
        written
    }

    /// Reports the text from `next` up to a list, a time or the end of the line, and skips it.
    fn skip_line(&mut self, pieces: &[(Piece<'_>, Span)], next: usize, expected: &'static str) -> usize {
        let mut span = pieces[next].1;
        let mut end = next + 1;
        while let Some((piece, at)) = pieces.get(end)
            && !matches!(piece, Piece::List(_))
            && !starts_time(pieces, end)
            && !self.line_ends_between(span, *at)
        {
            span = span.to(*at);
            end += 1;
        }
        self.unexpected(span, expected);
        end
    }

    /// A number that is not negative.
    fn figure(&mut self, span: Span, expected: &'static str) -> Figure {
        let text = self.source.slice(span);
        let value = match text.parse::<Decimal>() {
            Ok(value) if value.is_negative() => {
                let what = if expected == TIME { "time" } else { "duration" };
                self.body.sink.report(span, DiagnosticKind::NegativeTime { what, value });
                None
            }
            Ok(value) => Some(value),
            Err(NotADecimal::Malformed) => {
                self.unexpected(span, expected);
                None
            }
            Err(NotADecimal::TooLong) => {
                self.unexpected(span, "a number of fewer digits");
                None
            }
        };
        (value, span)
    }

    fn is_temporal(&self, written: &[Written<'_>]) -> bool {
        let fractional = |&(_, span): &Figure| {
            let text = self.source.slice(span);
            text.contains(['.', 'e', 'E'])
        };
        let durative = |step: &Written<'_>| {
            let head = step.node.head().and_then(|h| self.body.world.task_or_action(h.text()));
            matches!(head.map(|s| s.head), Some(SubtaskHead::DurativeAction(_)))
        };
        let any = |step: &Written<'_>| {
            step.duration.is_some() || step.time.as_ref().is_some_and(fractional) || durative(step)
        };
        written.iter().any(any)
            || (self.knows_time && !written.is_empty() && written.iter().all(|s| s.time.is_some()))
    }

    /// Steps are executed in the order of the file; reports numbers in another order.
    fn check_numbers(&mut self, written: &[Written<'_>]) {
        let mut before: Option<Decimal> = None;
        for step in written {
            let Some((Some(number), span)) = step.time else { continue };
            match before {
                Some(before) if number < before => {
                    let kind = DiagnosticKind::StepOutOfOrder { number, before };
                    self.body.sink.report(span, kind);
                }
                _ => before = Some(number),
            }
        }
    }

    fn sequential_step(&mut self, node: Node<'_>) -> Option<PlanStep> {
        match self.head(node)? {
            StepHead::Action(action) => self.instantaneous(node, action),
            // A durative action makes the plan temporal, so a sequential plan never has one.
            StepHead::DurativeAction(_) => None,
        }
    }

    /// A step of an instantaneous action.
    fn instantaneous(&mut self, node: Node<'_>, action: ActionId) -> Option<PlanStep> {
        let schema = &self.domain.actions[action];
        let arguments = self.call(node, &schema.name, schema.variables.parameters())?;
        Some(PlanStep { action, arguments, span: node.span() })
    }

    fn temporal_step(&mut self, step: &Written<'_>) -> Option<TemporalStep> {
        let node = step.node;
        if step.time.is_none() {
            self.body.sink.missing(node, "the step", "time such as `0.003:` before it");
        }
        let head = self.head(node)?;
        let arguments = match head {
            StepHead::Action(id) => {
                let schema = &self.domain.actions[id];
                self.call(node, &schema.name, schema.variables.parameters())
            }
            StepHead::DurativeAction(id) => {
                let schema = &self.domain.durative_actions[id];
                self.call(node, &schema.name, schema.variables.parameters())
            }
        }?;
        let (start, start_span) = step.time?;
        Some(TemporalStep {
            start: start?,
            head,
            arguments,
            duration: match step.duration {
                Some((value, _)) => Some(value?),
                None => None,
            },
            span: node.span(),
            start_span,
            duration_span: step.duration.map(|(_, span)| span),
        })
    }

    /// The schema that a list instantiates.
    fn head(&mut self, node: Node<'_>) -> Option<StepHead> {
        let Some(head) = node.head().filter(|h| h.is_name()) else {
            self.body.sink.unexpected(node, STEP);
            return None;
        };
        self.body.sink.mention(NameKind::Action, head, None);
        let world = self.body.world;
        match world.task_or_action(head.text()).map(|s| s.head) {
            Some(SubtaskHead::Action(id)) => Some(StepHead::Action(id)),
            Some(SubtaskHead::DurativeAction(id)) => Some(StepHead::DurativeAction(id)),
            Some(SubtaskHead::Task(_)) | None => {
                world.unknown(self.body.sink, head, SymbolKind::Action);
                None
            }
        }
    }

    fn call(&mut self, node: Node<'_>, name: &Name, parameters: &[Variable]) -> Option<Vec<ObjectId>> {
        self.arguments(node.span(), node.children().skip(1), (SymbolKind::Action, name, parameters))
    }
}

fn starts_time(pieces: &[(Piece<'_>, Span)], at: usize) -> bool {
    matches!(pieces.get(at..at + 2), Some([(Piece::Word, _), (Piece::Colon, _)]))
}
