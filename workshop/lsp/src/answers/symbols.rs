//! `textDocument/documentSymbol` and `workspace/symbol`.

use super::{Question, Refusal};
use diagnostics::{Place, SourceId};
use ide::SymbolShape;
use lsp_types::{
    BaseSymbolInformation, DocumentSymbol, DocumentSymbolParams, DocumentSymbolResponse, SymbolInformation,
    SymbolKind, WorkspaceSymbol, WorkspaceSymbolLocation, WorkspaceSymbolParams, WorkspaceSymbolResponse,
};
use pddl::NameKind;

/// Most symbols of a workspace in one answer; a longer query finds others.
const MOST: usize = 1_000;

pub(crate) fn of_document(
    q: &Question<'_>,
    params: &DocumentSymbolParams,
) -> Result<Option<DocumentSymbolResponse>, Refusal> {
    let Some(source) = q.documents.id(&params.text_document.uri) else { return Ok(None) };
    let found = ide::document_symbols(q.project(), source);
    if q.client.symbol_trees {
        let tree = found.into_iter().map(|symbol| tree(q, source, symbol));
        return Ok(Some(DocumentSymbolResponse::DocumentSymbolList(tree.collect())));
    }
    let mut flat = Vec::new();
    let mut left: Vec<(ide::DocumentSymbol, Option<String>)> =
        found.into_iter().rev().map(|symbol| (symbol, None)).collect();
    while let Some((symbol, container_name)) = left.pop() {
        let inside = Some(symbol.name.clone());
        left.extend(symbol.children.into_iter().rev().map(|child| (child, inside.clone())));
        let location = q.documents.location(Place { source, span: symbol.full });
        let kind = shape(symbol.shape);
        let said = BaseSymbolInformation { name: symbol.name, kind, tags: None, container_name };
        flat.push(SymbolInformation::new(None, location, said));
    }
    Ok(Some(DocumentSymbolResponse::SymbolInformationList(flat)))
}

fn tree(q: &Question<'_>, source: SourceId, symbol: ide::DocumentSymbol) -> DocumentSymbol {
    let children: Vec<_> = symbol.children.into_iter().map(|child| tree(q, source, child)).collect();
    let (full, name) = (q.documents.range(source, symbol.full), q.documents.range(source, symbol.name_span));
    let children = (!children.is_empty()).then_some(children);
    DocumentSymbol::new(symbol.name, symbol.detail, shape(symbol.shape), None, None, full, name, children)
}

pub(crate) fn of_workspace(
    q: &Question<'_>,
    params: &WorkspaceSymbolParams,
) -> Result<Option<WorkspaceSymbolResponse>, Refusal> {
    let found = ide::workspace_symbols(q.project(), &params.query);
    let symbols = found.into_iter().take(MOST).map(|symbol| WorkspaceSymbol {
        location: WorkspaceSymbolLocation::Location(q.documents.location(symbol.place)),
        data: None,
        base_symbol_information: BaseSymbolInformation {
            name: symbol.name,
            kind: kind(symbol.kind),
            tags: None,
            container_name: Some(symbol.container),
        },
    });
    Ok(Some(WorkspaceSymbolResponse::WorkspaceSymbolList(symbols.collect())))
}

fn shape(shape: SymbolShape) -> SymbolKind {
    match shape {
        SymbolShape::Section => SymbolKind::Namespace,
        SymbolShape::Name(name) => kind(name),
    }
}

fn kind(kind: NameKind) -> SymbolKind {
    match kind {
        NameKind::Domain | NameKind::Problem => SymbolKind::Module,
        NameKind::Requirement => SymbolKind::Key,
        NameKind::Type => SymbolKind::Class,
        NameKind::Predicate => SymbolKind::Interface,
        NameKind::Function => SymbolKind::Function,
        NameKind::Object => SymbolKind::Constant,
        NameKind::Variable => SymbolKind::Variable,
        NameKind::Action | NameKind::Task | NameKind::Method => SymbolKind::Method,
        NameKind::Process | NameKind::Event => SymbolKind::Event,
        NameKind::Subtask
        | NameKind::Preference
        | NameKind::Invariant
        | NameKind::Skill
        | NameKind::Agent => SymbolKind::Field,
    }
}
