//! Plan files: the kind of a file, and what all kinds have in common.
//!
//! A file with `==>`, `<==` or a line that starts with `root` is hierarchical. Otherwise it is temporal if a
//! step has a duration, a time that is not a whole number, or a durative action. All other files are
//! sequential: whole numbers before all steps (`0: (a)`, `1: (b)`) count them. In a domain with time they
//! are times.
//!
//! A text that is not a plan itself may be a planner's output that contains one (`output`).
//!
//! A text without any step is an error and never read as the empty plan. An empty file is the empty plan,
//! with a warning.

mod hierarchical;
mod output;
mod steps;

use super::body::Body;
use super::sink::{Lowered, Sink, found_text};
use super::world::World;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{Domain, Name, ObjectId, Problem, Term, Variable};
use crate::syntax::{self, Node, TokenKind, Tree};
use crate::{ClaimedCost, Diagnostic, Plan, SequentialPlan, Source, Span};

const STEP: &str = "a step such as `(action object)`";

/// Reads a plan, or the plan in a planner's output. Each attempt has a new sink from `sink`.
pub(crate) fn plan(
    sink: impl Fn(Vec<Diagnostic>) -> Sink,
    source: &Source,
    domain: &Domain,
    problem: &Problem,
) -> Lowered<Plan> {
    let read = |source: &Source| {
        let (tree, diagnostics) = syntax::parse(source);
        whole(sink(diagnostics), source, &tree, domain, problem)
    };
    let lowered = read(source);
    if lowered.sound {
        return lowered;
    }
    match output::within_output(source.text()) {
        Some(text) => read(&Source::new(source.name(), text)),
        None => lowered,
    }
}

fn whole(sink: Sink, source: &Source, tree: &Tree<'_>, domain: &Domain, problem: &Problem) -> Lowered<Plan> {
    // A constant has the types that the problem gives it as well.
    let world = World::with_objects(domain, &problem.objects);
    let knows_time = !domain.durative_actions.is_empty()
        || !problem.timed.is_empty()
        || !domain.processes.is_empty()
        || !domain.events.is_empty();
    let mut sink = sink;
    let plan = Reader { source, tree, domain, knows_time, body: Body::new(&world, &mut sink) }.plan();
    let finished = sink.finish();
    Lowered::new(plan, finished)
}

/// One plan file that is being read.
struct Reader<'a> {
    source: &'a Source,
    tree: &'a Tree<'a>,
    domain: &'a Domain,
    /// Whether whole numbers before steps are times.
    knows_time: bool,
    body: Body<'a>,
}

impl<'a> Reader<'a> {
    fn plan(&mut self) -> Option<Plan> {
        if self.is_hierarchical() {
            return Some(Plan::Hierarchical(self.hierarchical()));
        }
        let Some(first) = self.tree.roots().next() else {
            if self.body.sink.count() == 0 {
                self.body.sink.report(Span::default(), DiagnosticKind::EmptyPlan);
            }
            return Some(Plan::Sequential(SequentialPlan {
                cost: self.claimed_cost(),
                ..Default::default()
            }));
        };
        let definition = self.tree.roots().find(|n| n.is_headed("define") || n.is_headed("defdomain"));
        if definition.is_some() || !self.tree.roots().any(Node::is_list) {
            let span = super::sink::first_word(definition.unwrap_or(first));
            self.body.sink.report(span, DiagnosticKind::NotAPlan);
            return None;
        }
        Some(self.steps())
    }

    fn is_hierarchical(&self) -> bool {
        let mut before = None;
        self.tree.roots().any(|node| {
            let first = before.is_none_or(|b| self.line_ends_between(b, node.span()));
            before = Some(node.span());
            node.is("==>") || node.is("<==") || (first && (node.is("root") || node.is_headed("root")))
        })
    }

    fn line_ends_between(&self, before: Span, after: Span) -> bool {
        self.source.slice(Span::new(before.end, after.start)).contains(['\n', '\r'])
    }

    /// Reports that the text at `span` is not `expected`.
    fn unexpected(&mut self, span: Span, expected: &'static str) {
        let found = found_text(self.source.slice(span));
        self.body.sink.report(span, DiagnosticKind::Unexpected { found, expected });
    }

    /// The arguments of a ground call, with number and types checked; `None` if any is wrong.
    fn arguments<'t>(
        &mut self,
        whole: Span,
        nodes: impl Iterator<Item = Node<'t>>,
        (symbol, name, parameters): (SymbolKind, &Name, &[Variable]),
    ) -> Option<Vec<ObjectId>> {
        let mut arguments = Vec::with_capacity(parameters.len());
        let (mut sound, mut count) = (true, 0);
        for node in nodes {
            let object = if node.is_name() {
                self.body.object(node)
            } else {
                self.body.sink.unexpected(node, "an object");
                None
            };
            sound &= object.is_some();
            if let (Some(object), Some(parameter)) = (object, parameters.get(count)) {
                let term = Term::Object(object);
                sound &= self.body.argument_fits(node, term, name, count, &parameter.types);
            }
            arguments.extend(object);
            count += 1;
        }
        let expected = parameters.len();
        if count != expected {
            let signature = self.body.world.signature(name, parameters);
            let name = name.clone();
            let kind = DiagnosticKind::WrongArity { symbol, name, expected, found: count, signature };
            self.body.sink.report(whole, kind);
        }
        (sound && count == expected).then_some(arguments)
    }

    /// The last comment of the form `; cost = 5`, as planners write it.
    fn claimed_cost(&self) -> Option<ClaimedCost> {
        let comments = self.tree.tokens().filter(|(kind, _)| *kind == TokenKind::Comment);
        let claims = comments.filter_map(|(_, span)| {
            let text = self.source.slice(span).trim_start_matches(';').trim_start();
            let word = text.get(..4).filter(|w| w.eq_ignore_ascii_case("cost"))?;
            let value = text[word.len()..].trim_start().strip_prefix('=')?.split_whitespace().next()?;
            Some(ClaimedCost { value: value.parse().ok()?, span })
        });
        claims.last()
    }
}
