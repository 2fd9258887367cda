//! Names and words of the expected kind.

use pddl::model::{Domain, Requirement, TypeSet, Variables};
use pddl::{NameKind, Role, Span};
use project::{FileKind, Project};

use super::expected::{Expected, Form};
use super::item::{Completion, CompletionKind};
use super::snippets::{self, Snippet};
use crate::Position;
use crate::applied::{applied, domain, type_text, yields};
use crate::context::{After, Context, DOMAIN_SECTIONS, PROBLEM_SECTIONS};
use crate::entity::occurrences;
use crate::words::meaning;

/// Ranks: the nearest first.
const VARIABLE: u32 = 0;
const OBJECT: u32 = 10;
const NAME: u32 = 20;
const WORD: u32 = 30;

pub(super) struct Candidates<'a> {
    pub(super) project: &'a Project,
    pub(super) at: Position,
    pub(super) context: &'a Context<'a>,
    pub(super) all: Vec<Completion>,
}

impl<'a> Candidates<'a> {
    pub(super) fn collect(&mut self, expected: Expected) {
        match expected {
            Expected::Definition { parenthesis } => {
                self.snippets(snippets::DEFINITIONS, if parenthesis { "(" } else { "" }, NAME);
            }
            Expected::Section { parenthesis } => self.sections(parenthesis),
            Expected::Requirement => self.requirements(),
            Expected::Domain => self.domains(),
            Expected::Type => self.types(),
            Expected::Key => self.keys(),
            Expected::Form { form, parenthesis } => self.form(form, if parenthesis { "(" } else { "" }),
            Expected::Argument => self.arguments(),
            Expected::Side => self.side(),
            Expected::Time => ["start", "end", "all"].into_iter().for_each(|word| self.word(word)),
            Expected::Objective => ["minimize", "maximize"].into_iter().for_each(|word| self.word(word)),
            Expected::SubtaskId => self.subtasks(),
        }
    }

    fn push(
        &mut self,
        kind: CompletionKind,
        label: &str,
        detail: Option<String>,
        rank: u32,
    ) -> &mut Completion {
        self.all.push(Completion {
            label: label.to_owned(),
            kind,
            detail,
            documentation: None,
            span: self.context.word,
            text: label.to_owned(),
            snippet: None,
            rank,
        });
        self.all.last_mut().expect("it was just put there")
    }

    fn word(&mut self, word: &str) {
        let documentation = meaning(word).map(str::to_owned);
        self.push(CompletionKind::Keyword, word, None, WORD).documentation = documentation;
    }

    /// Snippets, completed by a closing parenthesis, and by `before`: an opening one, if the text has none
    /// yet.
    fn snippets(&mut self, snippets: &[Snippet], before: &str, rank: u32) {
        let after = self.context.after();
        for (label, body) in snippets {
            let documentation = meaning(label).map(str::to_owned);
            let completion = self.push(CompletionKind::Snippet, label, None, rank);
            completion.documentation = documentation;
            completion.text = format!("{before}{label}");
            let body = match after {
                After::Closed if before.is_empty() => body.strip_suffix(')').unwrap_or(body),
                _ => body,
            };
            if after != After::Arguments || !before.is_empty() {
                completion.snippet = Some(format!("{before}{body}"));
            }
        }
    }

    /// Keys and types: snippets without parentheses.
    fn pieces(&mut self, snippets: &[Snippet], rank: u32) {
        for (label, body) in snippets {
            let documentation = meaning(label).map(str::to_owned);
            let completion = self.push(CompletionKind::Snippet, label, None, rank);
            completion.documentation = documentation;
            completion.snippet = Some((*body).to_owned());
        }
    }

    fn domain(&self) -> Option<&'a Domain> {
        domain(self.project, self.at.source)
    }

    fn sections(&mut self, parenthesis: bool) {
        let sections = match self.project.kind(self.at.source) {
            FileKind::Problem => PROBLEM_SECTIONS,
            FileKind::Domain | FileKind::Plan => DOMAIN_SECTIONS,
        };
        let snippets: Vec<Snippet> =
            snippets::SECTIONS.iter().copied().filter(|(label, _)| sections.contains(label)).collect();
        self.snippets(&snippets, if parenthesis { "(" } else { "" }, NAME);
    }

    fn requirements(&mut self) {
        let there = self.context.inner().map_or(&[][..], |list| &list.items);
        for requirement in Requirement::ALL {
            if there.iter().all(|item| !item.is(requirement.as_str())) {
                self.word(requirement.as_str());
            }
        }
    }

    fn domains(&mut self) {
        let (project, own) = (self.project, self.at.source);
        for id in project.ids().filter(|&id| id != own) {
            if let Some(header) = project.header(id)
                && header.kind == FileKind::Domain
                && !header.name.is_empty()
            {
                let detail = project.path(id).to_owned();
                self.push(CompletionKind::Name(NameKind::Domain), &header.name, Some(detail), NAME);
            }
        }
    }

    fn types(&mut self) {
        let Some(domain) = self.domain() else { return self.word("object") };
        for (_, t) in domain.types.enumerate() {
            let parents: Vec<&str> = t.parents.iter().map(|&p| domain.types[p].name.as_str()).collect();
            let detail = (!parents.is_empty()).then(|| format!("- {}", parents.join(" ")));
            self.push(CompletionKind::Name(NameKind::Type), &t.name, detail, NAME);
        }
        let in_functions = self.context.section().is_some_and(|s| s.is_headed(":functions"));
        if in_functions && self.context.open.len() == 2 {
            self.word("number");
        }
        if !self.context.inner().is_some_and(|list| list.is_headed("either")) {
            let either = ("either", "(either $0)");
            self.pieces(&[either], WORD);
        }
    }

    fn keys(&mut self) {
        let Some(section) = self.context.section() else { return };
        let wanted = snippets::keys_of(section.head());
        let missing = |label: &str| section.items.iter().all(|item| !item.is(label));
        let keys: Vec<Snippet> = snippets::KEYS
            .iter()
            .copied()
            .filter(|(label, _)| wanted.contains(label) && missing(label))
            .collect();
        self.pieces(&keys, NAME);
    }

    fn form(&mut self, form: Form, before: &str) {
        let words = match form {
            Form::Condition => snippets::CONDITIONS,
            Form::TimedCondition => snippets::TIMED_CONDITIONS,
            Form::Constraint => snippets::CONSTRAINTS,
            Form::Effect => snippets::EFFECTS,
            Form::TimedEffect => snippets::TIMED_EFFECTS,
            Form::Number => snippets::NUMBERS,
            Form::Fact => snippets::FACTS,
            Form::Duration => snippets::DURATIONS,
            Form::Step if self.context.open.len() > 1 => snippets::SUBTASKS,
            Form::Step | Form::Task | Form::DerivedHead => &[],
        };
        self.snippets(words, before, WORD);
        let Some(domain) = self.domain() else { return };
        match form {
            Form::Condition | Form::Effect | Form::Fact | Form::DerivedHead => {
                for p in &domain.predicates {
                    if form != Form::Effect || !p.derived {
                        self.applied(domain, NameKind::Predicate, &p.name, &p.variables, before);
                    }
                }
            }
            Form::Number => {
                for f in &domain.functions {
                    if yields(domain, &f.name).is_none() {
                        self.applied(domain, NameKind::Function, &f.name, &f.variables, before);
                    }
                }
            }
            Form::Step | Form::Task => self.steps(domain, form, before),
            Form::TimedCondition | Form::TimedEffect | Form::Constraint | Form::Duration => {}
        }
        if form == Form::Number && before == "(" && self.in_duration() {
            self.word("?duration");
        }
    }

    fn in_duration(&self) -> bool {
        self.context.section().is_some_and(|s| s.is_headed(":durative-action"))
    }

    fn steps(&mut self, domain: &Domain, form: Form, before: &str) {
        if form == Form::Step {
            for a in &domain.actions {
                self.applied(domain, NameKind::Action, &a.name, &a.variables, before);
            }
            for a in &domain.durative_actions {
                self.applied(domain, NameKind::Action, &a.name, &a.variables, before);
            }
        }
        if self.context.open.len() > 1 {
            for t in &domain.tasks {
                self.applied(domain, NameKind::Task, &t.name, &t.variables, before);
            }
        }
    }

    /// A symbol with placeholders for its arguments.
    fn applied(&mut self, domain: &Domain, kind: NameKind, name: &str, variables: &Variables, before: &str) {
        let parameters = variables.parameters();
        let shown: Vec<String> = parameters
            .iter()
            .map(|p| format!(" ?{} - {}", p.name, type_text(&domain.types, &p.types.0)))
            .collect();
        let detail = format!("({name}{})", shown.concat());
        let places: Vec<String> =
            (1..).zip(parameters).map(|(i, p)| format!(" ${{{i}:?{}}}", p.name)).collect();
        let rest = if before.is_empty() { self.context.after() } else { After::Open };
        let close = if rest == After::Open { ")" } else { "" };
        let completion = self.push(CompletionKind::Name(kind), name, Some(detail), NAME);
        completion.text = format!("{before}{name}{}", if before.is_empty() { "" } else { close });
        if !places.is_empty() && rest != After::Arguments {
            completion.snippet = Some(format!("{before}{name}{}{close}", places.concat()));
        }
    }

    fn arguments(&mut self) {
        let Some(list) = self.context.inner() else { return };
        let wanted = match applied(self.project, self.at.source, self.context) {
            Some(found) => match found.parameters.get(list.items.len() - 1) {
                Some((_, types)) => (*types).clone(),
                None => return,
            },
            None => TypeSet::any(),
        };
        self.terms(&wanted);
    }

    fn side(&mut self) {
        let Some(domain) = self.domain() else { return };
        // Next to an object fluent or a variable only terms of its type fit; here all are offered.
        self.terms(&TypeSet::any());
        for f in &domain.functions {
            self.applied(domain, NameKind::Function, &f.name, &f.variables, "(");
        }
    }

    /// Visible variables and objects that can be of these types.
    fn terms(&mut self, wanted: &TypeSet) {
        let Some(domain) = self.domain() else { return };
        for (name, types) in self.context.variables() {
            let ids = types.iter().map(|t| domain.types.find(&t.to_ascii_lowercase()));
            // An undeclared type matches any.
            let own = TypeSet(ids.collect::<Option<_>>().unwrap_or_default());
            if domain.types.overlap(&own, wanted) {
                let exact = own.is_unknown() || domain.types.is_subset(&own, wanted);
                let rank = VARIABLE + u32::from(!exact);
                let detail = format!("- {}", types.join(" "));
                self.push(CompletionKind::Name(NameKind::Variable), &name, Some(detail), rank);
            }
        }
        let problem =
            self.project.problem_of(self.at.source).and_then(|problem| self.project.problem(problem));
        let objects = problem.map_or(&domain.constants, |problem| &problem.objects);
        for object in objects {
            if object.is_of(wanted, &domain.types) {
                let detail = format!("- {}", type_text(&domain.types, object.types.declared()));
                self.push(CompletionKind::Name(NameKind::Object), &object.name, Some(detail), OBJECT);
            }
        }
    }

    fn subtasks(&mut self) {
        let Some(section) = self.context.section() else { return };
        // Ids of this section: declared inside it, in its scope.
        let here = |scope: Option<Span>| scope.is_some_and(|scope| scope.start == section.start);
        let mut names: Vec<String> = occurrences(self.project, self.at.source)
            .iter()
            .filter(|o| {
                o.symbol.kind == NameKind::Subtask && o.role == Role::Declaration && here(o.symbol.scope)
            })
            .map(|o| o.symbol.name.to_string())
            .collect();
        names.dedup();
        for name in names {
            self.push(CompletionKind::Name(NameKind::Subtask), &name, None, NAME);
        }
    }
}
