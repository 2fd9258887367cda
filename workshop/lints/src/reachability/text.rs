//! Chains of causes in words.

use std::fmt::Write as _;

use pddl::Source;
use pddl::model::{Domain, ExpressionKind, Idx, Problem, Term, TypeSet, Variables};

use crate::walk::Polarity;

use super::Reachability;
use super::rule::{Check, Origin, Part, Pattern, Schema};
use super::why::{Cause, Link, Named, Piece, variables};
use super::world::UNBOUND;

/// What words are taken from.
#[derive(Clone, Copy)]
pub(crate) struct Words<'a> {
    pub(crate) domain: &'a Domain,
    pub(crate) problem: Option<&'a Problem>,
    pub(crate) domain_source: &'a Source,
    pub(crate) problem_source: Option<&'a Source>,
}

impl Words<'_> {
    /// What to call an origin: ``action `go` ``.
    pub(crate) fn title(&self, origin: &Origin) -> String {
        let schema = self.schema(&origin.schema);
        let part = match &origin.part {
            Part::End => format!("the end of {schema}"),
            Part::Outcome(name) => format!("the outcome `{name}` of {schema}"),
            Part::Whole | Part::Start => schema,
        };
        if origin.when.is_some() { format!("a conditional effect of {part}") } else { part }
    }

    /// What to call a schema.
    pub(crate) fn schema(&self, schema: &Schema) -> String {
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
            _ => variables(self.domain, schema),
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
    pub(crate) fn types(&self, types: &TypeSet) -> String {
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

/// One line, not too long.
pub(crate) fn shortened(text: &str) -> String {
    const MOST: usize = 60;
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}

impl Reachability<'_> {
    fn pattern(
        &self,
        words: &Words<'_>,
        schema: &Schema,
        pattern: &Pattern,
        given: &[u32],
        typed: bool,
    ) -> String {
        let term = |&t: &Term| words.term(schema, t, given, typed);
        let mut arguments: Vec<String> = pattern.arguments.iter().map(term).collect();
        let (name, value) = match self.name(pattern.relation) {
            Some(Named::Predicate(p)) => (&words.domain.predicates[p].name, None),
            Some(Named::Task(t)) => (&words.domain.tasks[t].name, None),
            Some(Named::Function(f)) => (&words.domain.functions[f].name, arguments.pop()),
            None => return "?".to_owned(),
        };
        arguments.insert(0, name.to_string());
        let applied = format!("({})", arguments.join(" "));
        value.map_or(applied.clone(), |v| format!("(= {applied} {v})"))
    }

    /// A piece as PDDL.
    pub(crate) fn piece(&self, words: &Words<'_>, schema: &Schema, piece: &Piece, typed: bool) -> String {
        let term = |t: Term, given: &[u32]| words.term(schema, t, given, typed);
        match piece {
            Piece::Atom(pattern, given) => self.pattern(words, schema, pattern, given, typed),
            Piece::Check(check, given) => match check {
                Check::Same(a, b) => format!("(= {} {})", term(*a, given), term(*b, given)),
                Check::Different(a, b) => format!("(not (= {} {}))", term(*a, given), term(*b, given)),
                Check::Absent(p) => format!("(not {})", self.pattern(words, schema, p, given, typed)),
                Check::Compare(polarity, _, _, span) => match polarity {
                    Polarity::Positive => words.text(schema, *span),
                    Polarity::Negative => format!("(not {})", words.text(schema, *span)),
                },
                Check::Residual(polarity, condition) => match polarity {
                    Polarity::Positive => words.text(schema, condition.span),
                    Polarity::Negative => format!("(not {})", words.text(schema, condition.span)),
                },
            },
        }
    }

    /// Why, as the end of a sentence that has named the first link's origin.
    pub(crate) fn reason(&self, words: &Words<'_>, chain: &[Link]) -> String {
        let mut text = String::new();
        for (i, link) in chain.iter().enumerate() {
            let schema = &link.origin.schema;
            let needs =
                if i == 0 { "it needs".to_owned() } else { format!("; {} needs", words.title(&link.origin)) };
            text += &match &link.cause {
                Cause::NoObject(types) => {
                    let has = if i == 0 {
                        "there".to_owned()
                    } else {
                        format!("; for {} there", words.title(&link.origin))
                    };
                    format!("{has} is no object of type {}", words.types(types))
                }
                Cause::NothingMakes(piece @ Piece::Atom(pattern, _)) => {
                    let atom = self.piece(words, schema, piece, true);
                    match self.name(pattern.relation) {
                        Some(Named::Task(_)) => format!("{needs} `{atom}`, which no method can carry out"),
                        Some(Named::Predicate(p)) if words.domain.predicates[p].derived => {
                            format!("{needs} `{atom}`, which no axiom derives")
                        }
                        _ => format!("{needs} `{atom}`, which no initial fact and no effect makes true"),
                    }
                }
                Cause::NothingMakes(piece) => format!("{needs} `{}`", self.piece(words, schema, piece, true)),
                Cause::OnlyMadeBy(piece, by) => {
                    let atom = self.piece(words, schema, piece, true);
                    let verb = self.verb(piece);
                    match by.as_slice() {
                        [one] => format!("{needs} `{atom}`, which only {} {verb}", words.title(one)),
                        [first, rest @ ..] => {
                            let others = if rest.len() == 1 {
                                "one more".to_owned()
                            } else {
                                format!("{} more", rest.len())
                            };
                            let first = words.title(first);
                            format!(
                                "{needs} `{atom}`, which only {first} and {others} could {}",
                                self.infinitive(piece)
                            )
                        }
                        [] => format!("{needs} `{atom}`"),
                    }
                }
                Cause::Circle(piece, by) => {
                    let atom = self.piece(words, schema, piece, true);
                    let who: Vec<String> = by.iter().take(2).map(|o| words.title(o)).collect();
                    let (who, verb) = (who.join(" and "), self.infinitive(piece));
                    format!("{needs} `{atom}`, which only {who} could {verb}, and that needs it first")
                }
                Cause::NeverTogether(pieces) => {
                    let pieces: Vec<String> =
                        pieces.iter().map(|p| format!("`{}`", self.piece(words, schema, p, false))).collect();
                    match pieces.as_slice() {
                        [one] => {
                            format!("{needs} {one}, which can never hold{}", self.values(words, &link.cause))
                        }
                        _ => format!("{needs} {}, which never hold together", listed(&pieces)),
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
    fn values(&self, words: &Words<'_>, cause: &Cause) -> String {
        let Cause::NeverTogether(pieces) = cause else { return String::new() };
        let [Piece::Check(Check::Compare(_, _, sides, _), _)] = pieces.as_slice() else {
            return String::new();
        };
        let mut known: Vec<String> = Vec::new();
        for side in [&sides.0, &sides.1] {
            side.each(&mut |part| {
                if let ExpressionKind::Fluent(application) = &part.kind {
                    let name = &words.domain.functions[application.function].name;
                    let text = match self.numbers().of(application.function) {
                        Some(interval) => format!("`{name}` is {interval}"),
                        None => format!("`{name}` never has a value"),
                    };
                    if !known.contains(&text) {
                        known.push(text);
                    }
                }
            });
        }
        if known.is_empty() { String::new() } else { format!(": {}", listed(&known)) }
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

/// `a`, `a and b`, `a, b and c`.
pub(crate) fn listed(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}
