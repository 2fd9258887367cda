//! Chains of causes as text.

use std::fmt::Write as _;

use pddl::Source;
use pddl::model::{Domain, ExpressionKind, Idx, Problem, Term, TypeSet, Variables};

use crate::happening::{Phase, Schema};
use crate::text::{listed, shortened};
use crate::walk::Polarity;

use super::rule::{Check, Origin, Pattern};
use super::why::{Cause, Explainer, Link, Named, Piece};
use super::world::UNBOUND;

/// The models and texts that the wording quotes.
#[derive(Clone, Copy, Debug)]
pub struct Wording<'a> {
    /// The domain.
    pub domain: &'a Domain,
    /// The problem, if there is one.
    pub problem: Option<&'a Problem>,
    /// The domain's text.
    pub domain_source: &'a Source,
    /// The problem's text.
    pub problem_source: Option<&'a Source>,
}

impl Wording<'_> {
    /// What to call an origin: ``action `go` ``.
    pub fn title(&self, origin: &Origin) -> String {
        let schema = self.schema(&origin.schema);
        let part = match &origin.phase {
            Phase::End => format!("the end of {schema}"),
            Phase::Outcome(name) => format!("the outcome `{name}` of {schema}"),
            Phase::Whole | Phase::Start => schema,
        };
        if origin.when.is_some() { format!("a conditional effect of {part}") } else { part }
    }

    /// What to call a schema.
    pub fn schema(&self, schema: &Schema) -> String {
        match schema {
            Schema::Action(id) => format!("action `{}`", self.domain.actions[*id].name),
            Schema::Durative(id) => format!("action `{}`", self.domain.durative_actions[*id].name),
            Schema::Axiom(i) => {
                format!("the axiom of `{}`", self.domain.predicates[self.domain.axioms[*i].predicate].name)
            }
            Schema::Event(id) => format!("event `{}`", self.domain.events[*id].name),
            Schema::Method(id) => format!("method `{}`", self.domain.methods[*id].name),
            Schema::Goal(_) => "the goal".to_owned(),
            Schema::Initial(_) => "the initial task network".to_owned(),
        }
    }

    fn variables(&self, schema: &Schema) -> Option<&Variables> {
        match schema {
            Schema::Goal(_) => self.problem.map(|p| &p.goal_variables),
            Schema::Initial(_) => self.problem.and_then(|p| p.htn.as_ref()).map(|(v, _)| v),
            _ => schema.variables(self.domain),
        }
    }

    fn text(&self, schema: &Schema, span: pddl::Span) -> String {
        let source = match schema {
            Schema::Goal(_) | Schema::Initial(_) => self.problem_source.unwrap_or(self.domain_source),
            _ => self.domain_source,
        };
        shortened(source.slice(span))
    }

    /// `a` or `a or b`, by name.
    pub fn types(&self, types: &TypeSet) -> String {
        let names: Vec<_> = types.0.iter().map(|&t| format!("`{}`", self.domain.types[t].name)).collect();
        names.join(" or ")
    }

    fn term(&self, schema: &Schema, term: Term, given: &[u32], typed: bool) -> String {
        let object = match term {
            Term::Object(o) => o.0,
            Term::Variable(v) => given.get(v.index()).copied().unwrap_or(UNBOUND),
        };
        let objects = self.problem.map_or(&self.domain.constants, |p| &p.objects);
        if let Some(object) = objects.get(pddl::model::ObjectId(object)) {
            return object.name.to_string();
        }
        let Term::Variable(v) = term else { return "?".to_owned() };
        let Some(variable) = self.variables(schema).and_then(|vs| vs.slots.get(v)) else {
            return "?".to_owned();
        };
        let mut text = format!("?{}", variable.name);
        if typed && variable.types != TypeSet::any() {
            let names: Vec<&str> = variable.types.0.iter().map(|&t| &*self.domain.types[t].name).collect();
            let _ = match names.as_slice() {
                [one] => write!(text, " - {one}"),
                several => write!(text, " - (either {})", several.join(" ")),
            };
        }
        text
    }
}

impl Explainer<'_> {
    fn pattern(
        &self,
        wording: &Wording<'_>,
        schema: &Schema,
        pattern: &Pattern,
        given: &[u32],
        typed: bool,
    ) -> String {
        let term = |&t: &Term| wording.term(schema, t, given, typed);
        let mut arguments: Vec<String> = pattern.arguments.iter().map(term).collect();
        let (name, value) = match self.name(pattern.relation) {
            Some(Named::Predicate(p)) => (&wording.domain.predicates[p].name, None),
            Some(Named::Task(t)) => (&wording.domain.tasks[t].name, None),
            Some(Named::Function(f)) => (&wording.domain.functions[f].name, arguments.pop()),
            None => return "?".to_owned(),
        };
        arguments.insert(0, name.to_string());
        let applied = format!("({})", arguments.join(" "));
        value.map_or(applied.clone(), |v| format!("(= {applied} {v})"))
    }

    /// A piece as PDDL.
    pub(super) fn piece(&self, wording: &Wording<'_>, schema: &Schema, piece: &Piece, typed: bool) -> String {
        let term = |t: Term, given: &[u32]| wording.term(schema, t, given, typed);
        match piece {
            Piece::Atom(pattern, given) => self.pattern(wording, schema, pattern, given, typed),
            Piece::Check(check, given) => match check {
                Check::Same(a, b) => format!("(= {} {})", term(*a, given), term(*b, given)),
                Check::Different(a, b) => format!("(not (= {} {}))", term(*a, given), term(*b, given)),
                Check::Absent(p) => format!("(not {})", self.pattern(wording, schema, p, given, typed)),
                Check::Compare(polarity, _, _, span) => match polarity {
                    Polarity::Positive => wording.text(schema, *span),
                    Polarity::Negative => format!("(not {})", wording.text(schema, *span)),
                },
                Check::Residual(polarity, condition) => match polarity {
                    Polarity::Positive => wording.text(schema, condition.span),
                    Polarity::Negative => format!("(not {})", wording.text(schema, condition.span)),
                },
            },
        }
    }

    /// Why, as the end of a sentence that has named the first link's origin.
    pub(super) fn reason(&self, wording: &Wording<'_>, chain: &[Link]) -> String {
        let mut text = String::new();
        for (i, link) in chain.iter().enumerate() {
            let schema = &link.origin.schema;
            let needs = if i == 0 {
                "it needs".to_owned()
            } else {
                format!("; {} needs", wording.title(&link.origin))
            };
            text += &match &link.cause {
                Cause::NoObject(types) => {
                    let has = if i == 0 {
                        "there".to_owned()
                    } else {
                        format!("; for {} there", wording.title(&link.origin))
                    };
                    format!("{has} is no object of type {}", wording.types(types))
                }
                Cause::NothingMakes(piece @ Piece::Atom(pattern, _)) => {
                    let atom = self.piece(wording, schema, piece, true);
                    match self.name(pattern.relation) {
                        Some(Named::Task(_)) => format!("{needs} `{atom}`, which no method can carry out"),
                        Some(Named::Predicate(p)) if wording.domain.predicates[p].derived => {
                            format!("{needs} `{atom}`, which no axiom derives")
                        }
                        _ => format!("{needs} `{atom}`, which no initial fact and no effect makes true"),
                    }
                }
                Cause::NothingMakes(piece) => {
                    format!("{needs} `{}`", self.piece(wording, schema, piece, true))
                }
                Cause::OnlyMadeBy(piece, by) => {
                    let atom = self.piece(wording, schema, piece, true);
                    let verb = self.verb(piece);
                    match by.as_slice() {
                        [one] => format!("{needs} `{atom}`, which only {} {verb}", wording.title(one)),
                        [first, rest @ ..] => {
                            let others = if rest.len() == 1 {
                                "one more".to_owned()
                            } else {
                                format!("{} more", rest.len())
                            };
                            let first = wording.title(first);
                            format!(
                                "{needs} `{atom}`, which only {first} and {others} could {}",
                                self.infinitive(piece)
                            )
                        }
                        [] => format!("{needs} `{atom}`"),
                    }
                }
                Cause::Circle(piece, by) => {
                    let atom = self.piece(wording, schema, piece, true);
                    let who: Vec<String> = by.iter().take(2).map(|o| wording.title(o)).collect();
                    let (who, verb) = (who.join(" and "), self.infinitive(piece));
                    format!("{needs} `{atom}`, which only {who} could {verb}, and that needs it first")
                }
                Cause::NeverTogether(pieces) => {
                    let pieces: Vec<String> = pieces
                        .iter()
                        .map(|p| format!("`{}`", self.piece(wording, schema, p, false)))
                        .collect();
                    match pieces.as_slice() {
                        [one] => {
                            format!(
                                "{needs} {one}, which can never hold{}",
                                self.values(wording, &link.cause)
                            )
                        }
                        _ => format!("{needs} {}, which never hold together", listed(&pieces, "and")),
                    }
                }
                Cause::False => format!("{needs} what is false in any case"),
                Cause::Unknown if i == 0 => "what it needs never holds at once".to_owned(),
                Cause::Unknown => String::new(),
            };
        }
        text
    }

    /// What the functions of a comparison may be.
    fn values(&self, wording: &Wording<'_>, cause: &Cause) -> String {
        let Cause::NeverTogether(pieces) = cause else { return String::new() };
        let [Piece::Check(Check::Compare(_, _, sides, _), _)] = pieces.as_slice() else {
            return String::new();
        };
        let mut known: Vec<String> = Vec::new();
        for side in [&sides.0, &sides.1] {
            side.each(&mut |part| {
                if let ExpressionKind::Fluent(application) = &part.kind {
                    let name = &wording.domain.functions[application.function].name;
                    let text = match self.hulls().of(application.function) {
                        Some(interval) => format!("`{name}` is {interval}"),
                        None => format!("`{name}` never has a value"),
                    };
                    if !known.contains(&text) {
                        known.push(text);
                    }
                }
            });
        }
        if known.is_empty() { String::new() } else { format!(": {}", listed(&known, "and")) }
    }

    fn verb(&self, piece: &Piece) -> &'static str {
        match piece {
            Piece::Atom(p, _) if matches!(self.name(p.relation), Some(Named::Task(_))) => "carries out",
            _ => "makes true",
        }
    }

    fn infinitive(&self, piece: &Piece) -> &'static str {
        match piece {
            Piece::Atom(p, _) if matches!(self.name(p.relation), Some(Named::Task(_))) => "carry out",
            _ => "make true",
        }
    }
}
