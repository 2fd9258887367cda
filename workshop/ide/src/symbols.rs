//! The outline of a file, and a search over the declarations of a project.

use diagnostics::{Place, SourceId};
use pddl::syntax::{self, Node, Tree};
use pddl::{NameKind, Occurrence, Role, Source, Span};
use project::Project;

use crate::describe::{flat, section_signature, signature, typed};
use crate::entity::{is_local, occurrences};

/// The kind of an outline's entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolShape {
    /// A section of several declarations, such as `:predicates`.
    Section,
    /// A declaration.
    Name(NameKind),
}

/// An entry of a file's outline.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DocumentSymbol {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub shape: SymbolShape,
    /// Signature or type.
    pub detail: Option<String>,
    /// The whole declaration.
    pub full: Span,
    /// The name inside the declaration.
    pub name_span: Span,
    /// The nested entries.
    pub children: Vec<DocumentSymbol>,
}

/// A declaration somewhere in the project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorkspaceSymbol {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: NameKind,
    /// The domain or problem that declares it.
    pub container: String,
    /// The place of the name in its declaration.
    pub place: Place,
}

/// The outline of a file.
pub fn document_symbols(project: &Project, source: SourceId) -> Vec<DocumentSymbol> {
    let (tree, _) = syntax::parse(project.source(source));
    let outline = Outline { text: project.source(source), tree: &tree, names: occurrences(project, source) };
    tree.roots().filter(|n| n.is_list()).filter_map(|root| outline.root(root)).collect()
}

struct Outline<'t> {
    text: &'t Source,
    tree: &'t Tree<'t>,
    names: &'t [Occurrence],
}

impl<'t> Outline<'t> {
    /// A `(define …)` with its sections, or a step of a plan.
    fn root(&self, root: Node<'t>) -> Option<DocumentSymbol> {
        let Some(title) = root.children().nth(1).filter(|_| root.is_headed("define")) else {
            let step = self.within(root).iter().find(|o| o.symbol.kind == NameKind::Action)?;
            let mut symbol = self.name(step, root.span(), None);
            symbol.name = flat(root);
            return Some(symbol);
        };
        let declaration = self.within(title).iter().find(|o| o.role == Role::Declaration);
        let mut symbol = match declaration {
            Some(name) => self.name(name, root.span(), None),
            None => section_symbol(title.head().unwrap_or(title), root.span()),
        };
        symbol.children = root.children().skip(2).filter_map(|section| self.section(section)).collect();
        Some(symbol)
    }

    fn section(&self, section: Node<'t>) -> Option<DocumentSymbol> {
        let keyword = section.head()?;
        let named = [":action", ":durative-action", ":task", ":method", ":process", ":event", ":invariant"];
        let declared = self.within(section).iter();
        let mut declared = declared.filter(|o| o.role == Role::Declaration && !is_local(o.symbol.kind));
        if named.iter().any(|k| keyword.is(k)) {
            return Some(match declared.next() {
                Some(name) => self.name(name, section.span(), Some(section_signature(section))),
                None => section_symbol(keyword, section.span()),
            });
        }
        let mut symbol = section_symbol(keyword, section.span());
        if keyword.is(":derived") {
            symbol.detail = section.children().nth(1).map(flat);
            return Some(symbol);
        }
        // Types of all words are looked up in one pass, since objects are many.
        let items = typed(section.children().skip(1));
        let mut items = items.into_iter().peekable();
        for name in declared {
            while items.next_if(|(item, _)| item.span().end < name.span.end).is_some() {}
            let item = items.peek().filter(|(item, _)| item.span().start <= name.span.start);
            let (full, detail) = match item {
                Some((item, types)) if !item.is_list() => {
                    (name.span, types.map(|types| format!("{} - {}", item.text(), flat(types))))
                }
                Some((item, _)) => (item.span(), signature(self.tree, name.span, name.symbol.kind)),
                None => (name.span, None),
            };
            symbol.children.push(self.name(name, full, detail));
        }
        Some(symbol)
    }

    fn name(&self, name: &Occurrence, full: Span, detail: Option<String>) -> DocumentSymbol {
        DocumentSymbol {
            name: self.text.slice(name.span).to_owned(),
            shape: SymbolShape::Name(name.symbol.kind),
            detail,
            full,
            name_span: name.span,
            children: Vec::new(),
        }
    }

    /// The occurrences inside a node.
    fn within(&self, node: Node<'_>) -> &'t [Occurrence] {
        let first = self.names.partition_point(|o| o.span.start < node.span().start);
        let end = self.names.partition_point(|o| o.span.start < node.span().end);
        &self.names[first..end.max(first)]
    }
}

fn section_symbol(keyword: Node<'_>, full: Span) -> DocumentSymbol {
    DocumentSymbol {
        name: keyword.text().to_owned(),
        shape: SymbolShape::Section,
        detail: None,
        full,
        name_span: keyword.span(),
        children: Vec::new(),
    }
}

/// Declarations whose names contain the letters of `query` in order, in any case; all declarations for an
/// empty query.
pub fn workspace_symbols(project: &Project, query: &str) -> Vec<WorkspaceSymbol> {
    let mut found = Vec::new();
    for source in project.ids() {
        let container = project.header(source).map_or(String::new(), |header| header.name.clone());
        for o in occurrences(project, source) {
            if o.role == Role::Declaration && !is_local(o.symbol.kind) && holds(&o.symbol.name, query) {
                found.push(WorkspaceSymbol {
                    name: project.source(source).slice(o.span).to_owned(),
                    kind: o.symbol.kind,
                    container: container.clone(),
                    place: Place { source, span: o.span },
                });
            }
        }
    }
    found
}

/// Whether `name` contains the letters of `query` in this order.
fn holds(name: &str, query: &str) -> bool {
    let mut letters = name.chars().flat_map(char::to_lowercase);
    query.chars().flat_map(char::to_lowercase).all(|wanted| letters.any(|c| c == wanted))
}
