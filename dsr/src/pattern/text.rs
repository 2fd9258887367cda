//! Patterns as text: `(and (is_with ?who clarc) (not (is clarc speaking)) (> (score ?test) 3))`.
//!
//! A word with `?` is a variable; any other word names a node.
//!
//! - `(LABEL a b)` is an edge.
//! - `(TYPE a)` gives the type of a node. A variable without a type may be any node; of two types, the narrower one
//!   counts.
//! - `(ATTRIBUTE a)` and `(ATTRIBUTE a b)` say that an attribute of a node or an edge has a value.
//! - `(= (ATTRIBUTE a) VALUE)`, and `!=`, `<`, `<=`, `>`, `>=`, compare it with a number, `true`, `false`, a `"text"`,
//!   a node or another attribute.
//! - `(< (distance a b) 1.5)` compares metres, `(< (bearing a b) 0.3)` radians. A second number is the threshold to
//!   disappear (hysteresis).
//! - `(<= (distance a b) (ATTRIBUTE a))` says that `a` reaches `b`.
//! - `(distinct a b)` says that two nodes differ.
//!
//! `(and …)` and `(not …)` nest. A variable that occurs only inside a `not` is local to it.

use std::collections::BTreeMap;

use super::builder::PatternBuilder;
use super::check::PatternError;
use super::compiled::Pattern;
use super::slot::SLOTS;
use super::term::{Comparison, HolderTerm, Metric, Operand, Term, Threshold, Variable};
use crate::id::{AttributeId, TypeId};
use crate::value::{Kind, Value};
use crate::vocabulary::{HolderType, Vocabulary};

/// Why a text is not a pattern, with the byte of the fault.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum PatternTextError {
    /// Unbalanced parentheses or quotes, or text after the end.
    #[error("byte {at}: {wanted} is missing")]
    Missing { at: usize, wanted: &'static str },
    /// Parts that nest too deeply.
    #[error("byte {at}: nested too deeply")]
    TooDeep { at: usize },
    /// The first word of a part is neither a token of the vocabulary nor a word of the language.
    #[error(
        "byte {at}: `{word}` is no label, attribute or type, and not one of `and`, `not`, `distinct`, `=`, `<` …"
    )]
    Unknown { at: usize, word: String },
    /// A part with too many or too few words.
    #[error("byte {at}: `{word}` takes {wanted}")]
    Arity { at: usize, word: String, wanted: &'static str },
    /// Another kind of word is required there.
    #[error("byte {at}: {wanted} belongs here")]
    Expected { at: usize, wanted: &'static str },
    /// A node of two types, neither of which is a subtype of the other.
    #[error("byte {at}: `{word}` is a `{first}` and so never a `{second}`")]
    Disjoint { at: usize, word: String, first: String, second: String },
    /// The vocabulary never allows this part.
    #[error("byte {at}: {error}")]
    Wrong { at: usize, error: PatternError },
}

/// The deepest nesting of parts.
const DEEPEST: usize = 32;

#[derive(Debug)]
enum Form<'t> {
    Word(usize, &'t str),
    Text(usize, &'t str),
    List(usize, Vec<Form<'t>>),
}

impl Form<'_> {
    fn at(&self) -> usize {
        match self {
            Self::Word(at, _) | Self::Text(at, _) | Self::List(at, _) => *at,
        }
    }
}

impl Pattern {
    /// Parses a pattern in the language of `pelea dsr query` (`docs/dsr.md`). Its variables are those that occur
    /// outside of any `not`, in order of occurrence.
    pub fn parse(vocabulary: &Vocabulary, text: &str) -> Result<Self, PatternTextError> {
        let mut reader = Reader { text, at: 0 };
        let form = reader.form(0)?;
        reader.space();
        if reader.at < text.len() {
            return Err(PatternTextError::Missing { at: reader.at, wanted: "the end" });
        }
        let attempt = |limit| {
            let mut builder = PatternBuilder::new(vocabulary);
            let mut writer =
                Writer { vocabulary, known: BTreeMap::new(), limit, written: 0, last: form.at() };
            let written = writer.conjunction(&mut builder, std::slice::from_ref(&form));
            let wrong = |error| PatternTextError::Wrong { at: writer.last, error };
            (written.and_then(|()| builder.build().map_err(wrong)), writer.written)
        };
        let (done, written) = attempt(usize::MAX);
        if !matches!(done, Err(PatternTextError::Wrong { .. })) {
            return done;
        }
        // Report the first part that makes the pattern wrong. Adding parts never makes a wrong pattern right, so a
        // binary search finds it.
        let (mut least, mut most) = (0, written);
        while least < most {
            let middle = least.midpoint(most);
            if attempt(middle).0.is_err() { most = middle } else { least = middle + 1 }
        }
        attempt(least).0
    }
}

struct Reader<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Reader<'t> {
    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn space(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
    }

    fn form(&mut self, depth: usize) -> Result<Form<'t>, PatternTextError> {
        self.space();
        let (at, rest) = (self.at, self.rest());
        if depth > DEEPEST {
            return Err(PatternTextError::TooDeep { at });
        }
        if rest.starts_with('(') {
            self.at += 1;
            let mut forms = Vec::new();
            loop {
                self.space();
                match self.rest().chars().next() {
                    Some(')') => {
                        self.at += 1;
                        return Ok(Form::List(at, forms));
                    }
                    Some(_) => forms.push(self.form(depth + 1)?),
                    None => return Err(PatternTextError::Missing { at: self.at, wanted: "`)`" }),
                }
            }
        }
        if let Some(quoted) = rest.strip_prefix('"') {
            let end =
                quoted.find('"').ok_or(PatternTextError::Missing { at: self.text.len(), wanted: "`\"`" })?;
            self.at += end + 2;
            return Ok(Form::Text(at, &quoted[..end]));
        }
        let end = rest.find(|c: char| c.is_whitespace() || "()\"".contains(c)).unwrap_or(rest.len());
        if end == 0 {
            return Err(PatternTextError::Missing { at, wanted: "`(`" });
        }
        self.at += end;
        Ok(Form::Word(at, &rest[..end]))
    }
}

struct Writer<'d, 't> {
    vocabulary: &'d Vocabulary,
    /// The visible variables.
    known: BTreeMap<&'t str, (Variable, TypeId)>,
    /// The number of parts to write, and the number written.
    limit: usize,
    written: usize,
    /// The byte at which the last written part begins.
    last: usize,
}

/// The first word of a list, and the rest.
fn split<'f, 't>(form: &'f Form<'t>) -> Result<(usize, &'t str, &'f [Form<'t>]), PatternTextError> {
    let wanted = "a part such as `(LABEL a b)`";
    match form {
        Form::List(at, forms) => match forms.split_first() {
            Some((Form::Word(_, head), rest)) => Ok((*at, head, rest)),
            _ => Err(PatternTextError::Expected { at: *at, wanted }),
        },
        Form::Word(at, _) | Form::Text(at, _) => Err(PatternTextError::Expected { at: *at, wanted }),
    }
}

/// The type and the node of `(TYPE a)`. A word that names several things is a label first, then an attribute, then a
/// type.
fn typed<'f, 't>(forms: &'f [Form<'t>], vocabulary: &Vocabulary) -> Option<(TypeId, &'f Form<'t>)> {
    let [Form::Word(_, head), node] = forms else { return None };
    let is_other = vocabulary.label(head).is_some() || vocabulary.attribute(head).is_some();
    let node_type = vocabulary.node_type(head).filter(|_| !is_other)?;
    Some((node_type, node))
}

/// The variables that occur outside of any `not`, each with the narrowest type that it has there.
fn variables<'t>(forms: &[Form<'t>], vocabulary: &Vocabulary, found: &mut Vec<(&'t str, TypeId)>) {
    for form in forms {
        // The pattern has too many variables already; the rest do not matter.
        if found.len() > SLOTS {
            return;
        }
        match form {
            Form::Word(_, word) if word.starts_with('?') && !found.iter().any(|(known, _)| known == word) => {
                found.push((word, TypeId::OBJECT));
            }
            Form::List(_, forms) if !matches!(&forms[..], [Form::Word(_, "not"), ..]) => {
                variables(forms, vocabulary, found);
                if let Some((narrow, Form::Word(_, word))) = typed(forms, vocabulary)
                    && let Some((_, known)) = found.iter_mut().find(|(known, _)| known == word)
                    && vocabulary.is_a(narrow, *known)
                {
                    *known = narrow;
                }
            }
            _ => {}
        }
    }
}

impl<'d, 't> Writer<'d, 't> {
    fn conjunction(
        &mut self,
        builder: &mut PatternBuilder<'d>,
        forms: &[Form<'t>],
    ) -> Result<(), PatternTextError> {
        let mut here = Vec::new();
        variables(forms, self.vocabulary, &mut here);
        here.retain(|(word, _)| !self.known.contains_key(word));
        let count = self.known.len() + here.len();
        if count > SLOTS {
            let error = PatternError::TooLarge { count };
            return Err(PatternTextError::Wrong { at: self.last, error });
        }
        for (word, node_type) in &here {
            let name = word.strip_prefix('?').unwrap_or(word);
            let variable = builder.variable(name, *node_type);
            self.known.insert(word, (variable, *node_type));
        }
        forms.iter().try_for_each(|form| self.part(builder, form))?;
        for (word, _) in here {
            self.known.remove(word);
        }
        Ok(())
    }

    fn part(&mut self, builder: &mut PatternBuilder<'d>, form: &Form<'t>) -> Result<(), PatternTextError> {
        let (at, head, rest) = split(form)?;
        let arity = |wanted| PatternTextError::Arity { at, word: head.to_owned(), wanted };
        match (head, rest) {
            ("and", parts) => return parts.iter().try_for_each(|part| self.part(builder, part)),
            ("not", [part]) => {
                return builder.without(|builder| self.conjunction(builder, std::slice::from_ref(part)));
            }
            ("not", _) => return Err(arity("one part")),
            _ => {}
        }
        if self.written == self.limit {
            return Ok(());
        }
        (self.written, self.last) = (self.written + 1, at);
        match (head, rest) {
            ("distinct", [a, b]) => {
                let (a, b) = (self.term(a)?, self.term(b)?);
                builder.distinct(a, b);
                return Ok(());
            }
            ("distinct", _) => return Err(arity("two nodes")),
            _ => {}
        }
        if let Some(comparison) = comparison(head) {
            return match rest {
                [left, right] => match metric(left)? {
                    Some(measured) => self.metric(builder, comparison, &measured, (right, right)),
                    None => self.comparison(builder, comparison, left, right),
                },
                [left, come, go] => match metric(left)? {
                    Some(measured) => self.metric(builder, comparison, &measured, (come, go)),
                    None => Err(arity("two sides")),
                },
                _ => Err(arity("two sides")),
            };
        }
        if let (Some(label), [from, to]) = (self.vocabulary.label(head), rest) {
            let (from, to) = (self.term(from)?, self.term(to)?);
            builder.edge(from, label, to);
            return Ok(());
        }
        if self.vocabulary.attribute(head).is_some() {
            let (holder, attribute) = self.attribute(form)?;
            builder.present(holder, attribute);
            return Ok(());
        }
        match (self.vocabulary.label(head), self.vocabulary.node_type(head), rest) {
            (Some(_), _, _) => Err(arity("two nodes")),
            (None, Some(node_type), [node]) => self.is_a(builder, node, node_type),
            (None, Some(_), _) => Err(arity("one node")),
            _ => Err(PatternTextError::Unknown { at, word: head.to_owned() }),
        }
    }

    fn is_a(
        &self,
        builder: &mut PatternBuilder<'d>,
        node: &Form<'t>,
        node_type: TypeId,
    ) -> Result<(), PatternTextError> {
        let term = self.term(node)?;
        if let Form::Word(at, word) = node
            && let Some((_, known)) = self.known.get(word)
            && !self.vocabulary.overlap(*known, node_type)
        {
            let name = |id| self.vocabulary.type_name(id).map_or_else(String::new, ToString::to_string);
            let (word, first, second) = ((*word).to_owned(), name(*known), name(node_type));
            return Err(PatternTextError::Disjoint { at: *at, word, first, second });
        }
        builder.is_a(term, node_type);
        Ok(())
    }

    fn comparison(
        &self,
        builder: &mut PatternBuilder<'d>,
        comparison: Comparison,
        left: &Form<'t>,
        right: &Form<'t>,
    ) -> Result<(), PatternTextError> {
        let (holder, attribute) = self.attribute(left)?;
        let operand = self.operand(right, self.vocabulary.kind(attribute))?;
        builder.guard(holder, attribute, comparison, operand);
        Ok(())
    }

    /// A metric compared with a threshold, with two thresholds (hysteresis: the one to appear, the one to disappear),
    /// or, for a distance, with the reach of the first node.
    fn metric(
        &self,
        builder: &mut PatternBuilder<'d>,
        comparison: Comparison,
        Measured { metric, from, to }: &Measured<'_, 't>,
        (come, go): (&Form<'t>, &Form<'t>),
    ) -> Result<(), PatternTextError> {
        let (a, b) = (self.term(from)?, self.term(to)?);
        if let Form::List(at, _) = come {
            if !std::ptr::eq(come, go) {
                return Err(PatternTextError::Expected { at: *at, wanted: "a number" });
            }
            let (holder, reach) = self.attribute(come)?;
            let wanted = "`<=` and an attribute of the first node";
            let fits = (*metric, comparison) == (Metric::Distance, Comparison::LessOrEqual)
                && holder == HolderTerm::Node(a.clone());
            if !fits {
                return Err(PatternTextError::Expected { at: *at, wanted });
            }
            builder.reachable(a, b, reach);
            return Ok(());
        }
        let number = |form: &Form<'t>| {
            let number = if let Form::Word(_, word) = form { word.parse().ok() } else { None };
            let wanted =
                if *metric == Metric::Distance { "a number of metres" } else { "a number of radians" };
            number
                .filter(|number: &f64| number.is_finite())
                .ok_or(PatternTextError::Expected { at: form.at(), wanted })
        };
        let threshold = Threshold { appears: number(come)?, disappears: number(go)? };
        builder.metric(*metric, a, b, comparison, threshold);
        Ok(())
    }

    fn operand(&self, form: &Form<'t>, kind: Option<Kind>) -> Result<Operand, PatternTextError> {
        Ok(match form {
            Form::List(..) => {
                let (holder, attribute) = self.attribute(form)?;
                Operand::Attribute(holder, attribute)
            }
            Form::Text(_, text) => Operand::Value(Value::text(*text)),
            Form::Word(at, word) => match kind {
                Some(Kind::Number) => {
                    let number = word.parse().ok().filter(|number: &f64| number.is_finite());
                    number.ok_or(PatternTextError::Expected { at: *at, wanted: "a number" })?.into()
                }
                Some(Kind::Bool) => match *word {
                    "true" => true.into(),
                    "false" => false.into(),
                    _ => return Err(PatternTextError::Expected { at: *at, wanted: "`true` or `false`" }),
                },
                Some(Kind::Text) if word.starts_with('?') => {
                    return Err(PatternTextError::Expected { at: *at, wanted: "a text" });
                }
                Some(Kind::Text) => Operand::Value(Value::text(*word)),
                _ => Operand::Term(self.term(form)?),
            },
        })
    }

    /// `(ATTRIBUTE a)` or `(ATTRIBUTE a b)`.
    fn attribute(&self, form: &Form<'t>) -> Result<(HolderTerm, AttributeId), PatternTextError> {
        let (at, head, rest) = split(form)?;
        let unknown = || PatternTextError::Unknown { at, word: head.to_owned() };
        let attribute = self.vocabulary.attribute(head).ok_or_else(unknown)?;
        let arity = |wanted| PatternTextError::Arity { at, word: head.to_owned(), wanted };
        match (self.vocabulary.holder(attribute).ok_or_else(unknown)?, rest) {
            (HolderType::Node(_), [node]) => Ok((HolderTerm::Node(self.term(node)?), attribute)),
            (HolderType::Edge { label, .. }, [from, to]) => {
                let (from, to) = (self.term(from)?, self.term(to)?);
                Ok((HolderTerm::Edge { from, label, to }, attribute))
            }
            (HolderType::Node(_), _) => Err(arity("one node")),
            (HolderType::Edge { .. }, _) => Err(arity("the two nodes of an edge")),
        }
    }

    fn term(&self, form: &Form<'t>) -> Result<Term, PatternTextError> {
        match form {
            Form::Word(at, word) if word.starts_with('?') => self
                .known
                .get(word)
                .map(|(variable, _)| Term::Variable(*variable))
                .ok_or(PatternTextError::Expected { at: *at, wanted: "a variable that is declared" }),
            Form::Word(_, word) | Form::Text(_, word) => Ok(Term::from(*word)),
            Form::List(at, _) => Err(PatternTextError::Expected { at: *at, wanted: "a node or a variable" }),
        }
    }
}

/// A metric and the forms between which it is measured.
struct Measured<'f, 't> {
    metric: Metric,
    from: &'f Form<'t>,
    to: &'f Form<'t>,
}

/// `(distance a b)` or `(bearing a b)`, if it is one of them.
fn metric<'f, 't>(form: &'f Form<'t>) -> Result<Option<Measured<'f, 't>>, PatternTextError> {
    let (at, head, rest) = split(form)?;
    let metric = match head {
        "distance" => Metric::Distance,
        "bearing" => Metric::Bearing,
        _ => return Ok(None),
    };
    let [from, to] = rest else {
        return Err(PatternTextError::Arity { at, word: head.to_owned(), wanted: "two nodes" });
    };
    Ok(Some(Measured { metric, from, to }))
}

fn comparison(word: &str) -> Option<Comparison> {
    Some(match word {
        "=" => Comparison::Equal,
        "!=" => Comparison::NotEqual,
        "<" => Comparison::Less,
        "<=" => Comparison::LessOrEqual,
        ">" => Comparison::Greater,
        ">=" => Comparison::GreaterOrEqual,
        _ => return None,
    })
}
