//! Every change of one token of a PDDL text that leaves it readable.
//!
//! Idea: the operators work on the syntax tree, so they need no model and apply to every layer. Whether a mutant still
//! means something is the question that is put to `pelea check`.
//!
//! Source: Jia & Harman, "An analysis and survey of the development of mutation testing", IEEE TSE 2011.

use pddl::syntax::{self, Node};
use pddl::{Source, Span};
use std::collections::BTreeMap;

/// One change of one text.
#[derive(Clone, Debug)]
pub(crate) struct Mutant {
    /// The position of the text.
    pub(crate) file: usize,
    /// What is replaced.
    pub(crate) span: Span,
    /// By what.
    pub(crate) new: String,
    /// Which operator made it.
    pub(crate) operator: &'static str,
}

/// The constants and types that the texts declare.
#[derive(Debug, Default)]
pub(crate) struct Names {
    /// The names of the same type, by name.
    peers: BTreeMap<String, Vec<String>>,
    /// The supertype of each type.
    above: BTreeMap<String, String>,
}

impl Names {
    /// Reads the declarations of all texts.
    pub(crate) fn of(texts: &[Source]) -> Self {
        let mut by_type: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let mut above = BTreeMap::new();
        for text in texts {
            let (tree, _) = syntax::parse(text);
            for section in tree.roots().flat_map(Node::children).filter(|n| n.is_list()) {
                if section.is_headed(":objects") || section.is_headed(":constants") {
                    for (name, of) in typed(section) {
                        let names = by_type.entry(of).or_default();
                        if !names.contains(&name) {
                            names.push(name);
                        }
                    }
                } else if section.is_headed(":types") {
                    above.extend(typed(section));
                }
            }
        }
        let mut peers = BTreeMap::new();
        for names in by_type.into_values() {
            for name in &names {
                peers.insert(name.clone(), names.clone());
            }
        }
        Self { peers, above }
    }

    /// The next constant of the same type.
    fn next(&self, name: &str) -> Option<&str> {
        let peers = self.peers.get(name)?;
        let at = peers.iter().position(|p| p == name)?;
        Some(peers[(at + 1) % peers.len()].as_str()).filter(|next| *next != name)
    }
}

/// `a b - t` as pairs of a name and its type.
fn typed(list: Node<'_>) -> Vec<(String, String)> {
    let (mut names, mut pairs) = (Vec::new(), Vec::new());
    let mut children = list.children().skip(1);
    while let Some(child) = children.next() {
        if child.text() == "-" {
            let of = children.next().map_or("object", |n| n.text()).to_owned();
            pairs.extend(names.drain(..).map(|name| (name, of.clone())));
        } else {
            names.push(child.text().to_owned());
        }
    }
    pairs
}

/// Where in a definition a node stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Elsewhere,
    Declaration,
    Parameters,
    Condition,
    Effect,
    Order,
    Facts,
    Writes,
}

/// All mutants of one text.
pub(crate) fn mutants(file: usize, text: &Source, names: &Names) -> Vec<Mutant> {
    let (tree, _) = syntax::parse(text);
    let mut walk = Walk { file, names, found: Vec::new() };
    for root in tree.roots() {
        walk.list(root, Place::Elsewhere);
    }
    walk.found
}

struct Walk<'n> {
    file: usize,
    names: &'n Names,
    found: Vec<Mutant>,
}

impl Walk<'_> {
    fn add(&mut self, node: Node<'_>, new: String, operator: &'static str) {
        self.found.push(Mutant { file: self.file, span: node.span(), new, operator });
    }

    /// The place of the `at`-th child of a list, after the child before it.
    fn place(list: Node<'_>, at: usize, before: Option<Node<'_>>, place: Place) -> Place {
        let head = list.head().map_or("", |h| h.text());
        let key = before.map_or("", |b| b.text());
        match (head, key) {
            (":objects" | ":constants" | ":types" | ":predicates" | ":functions" | ":requirements", _)
            | (":import", _) => Place::Declaration,
            (":derived", _) if at == 1 => Place::Declaration,
            (":derived" | ":goal", _) => Place::Condition,
            (":init", _) => Place::Facts,
            (":writes", _) => Place::Writes,
            (_, ":parameters" | ":results") => Place::Parameters,
            (_, ":precondition" | ":condition") => Place::Condition,
            (_, ":effect") => Place::Effect,
            (_, ":ordering") => Place::Order,
            (_, key) if key.starts_with(':') => Place::Elsewhere,
            _ => place,
        }
    }

    fn list(&mut self, list: Node<'_>, place: Place) {
        let mut before = None;
        let head = list.head();
        for (at, child) in list.children().enumerate() {
            let here = Self::place(list, at, before, place);
            let is_part = match here {
                Place::Condition | Place::Effect | Place::Order => {
                    head.is_some_and(|h| h.is("and") || h.is("or")) && at > 0
                }
                Place::Facts => list.is_headed(":init") && at > 0,
                Place::Writes => list.is_headed(":writes") && at > 1,
                _ => false,
            };
            if is_part {
                self.add(child, String::new(), drop_of(here));
            }
            if here == Place::Condition && is_literal(child) && !list.is_headed("not") {
                self.add(child, format!("(not {})", child.text()), "negate");
            }
            if child.is_list() {
                if here == Place::Condition
                    && child.is_headed("not")
                    && let Some(inner) = child.children().nth(1)
                {
                    self.add(child, inner.text().to_owned(), "negate");
                }
                self.list(child, here);
            } else {
                self.word(child, before, at, here);
            }
            before = Some(child);
        }
    }

    fn word(&mut self, word: Node<'_>, before: Option<Node<'_>>, at: usize, place: Place) {
        let text = word.text();
        if text == ":ordered-subtasks" {
            self.add(word, ":subtasks".to_owned(), "drop ordering");
        } else if place == Place::Parameters && before.is_some_and(|b| b.text() == "-") {
            if let Some(above) = self.names.above.get(text) {
                self.add(word, above.clone(), "widen type");
            }
        } else if at > 0 && !matches!(place, Place::Declaration | Place::Parameters) {
            // What follows a keyword such as `:skill` stands in a list.
            if let Some(next) = self.names.next(text) {
                self.add(word, next.to_owned(), "swap constant");
            }
        }
    }
}

fn drop_of(place: Place) -> &'static str {
    match place {
        Place::Condition => "drop condition",
        Place::Effect => "drop effect",
        Place::Order => "drop ordering",
        Place::Facts => "drop fact",
        _ => "drop permission",
    }
}

/// Whether a node is a literal without `not`: no connective, quantifier or time.
fn is_literal(node: Node<'_>) -> bool {
    const FORMS: [&str; 11] =
        ["and", "or", "not", "imply", "exists", "forall", "at", "over", "when", "all", "start"];
    node.is_list()
        && node.head().is_some_and(|head| !head.is_list() && !FORMS.iter().any(|form| head.is(form)))
        && node.head().is_some_and(Node::is_name)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "(define (domain d) (:types item - part) (:constants a b - item)
  (:durative-action say :parameters (?i - item)
    :condition (and (at start (not (p a))) (over all (q ?i)))
    :effect (and (at end (p b)) (at end (q ?i)))
    :skill (say a)))";

    #[test]
    fn every_operator_changes_one_token() {
        let text = Source::new("d", TEXT);
        let texts = [text.clone()];
        let found = mutants(0, &text, &Names::of(&texts));
        let lines: Vec<String> =
            found.iter().map(|m| format!("{}: {} -> {}", m.operator, text.slice(m.span), m.new)).collect();
        assert_eq!(
            lines,
            [
                "widen type: item -> part",
                "drop condition: (at start (not (p a))) -> ",
                "negate: (not (p a)) -> (p a)",
                "swap constant: a -> b",
                "drop condition: (over all (q ?i)) -> ",
                "negate: (q ?i) -> (not (q ?i))",
                "drop effect: (at end (p b)) -> ",
                "swap constant: b -> a",
                "drop effect: (at end (q ?i)) -> ",
                "swap constant: a -> b",
            ]
        );
    }
}
