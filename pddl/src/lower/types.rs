//! `(:types a b - c)` and the types of imported domains: one acyclic table.
//!
//! Ids: `object`, then the imported types, then the declared ones in the order of the source, then those
//! that appear only on the right of a hyphen (below `object`). A type declared with several parents, at once
//! or one after the other, has all of them. Types of the same name in two imports are one type, with the
//! parents of both.

use indexmap::IndexMap;
use rustc_hash::{FxBuildHasher, FxHashSet};

use super::header::Header;
use super::sink::Sink;
use super::typed_list::{type_names, typed_list};
use super::world::fold;
use crate::Span;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{Domain, Idx, Name, Type, TypeId, TypeTable};
use crate::occurrence::NameKind;

struct Entry {
    span: Span,
    parents: Vec<Name>,
    imported: Option<Name>,
}

type Table = IndexMap<Name, Entry, FxBuildHasher>;

pub(crate) fn types(sink: &mut Sink, header: &Header<'_>, imports: &[&Domain]) -> TypeTable {
    let mut table = Table::default();
    table.insert(Name::new("object"), Entry { span: Span::default(), parents: Vec::new(), imported: None });
    for domain in imports {
        import(&mut table, domain);
    }
    let mut declared = Vec::new();
    for section in header.all(":types") {
        declared.extend(typed_list(sink, section.children().skip(1)));
    }
    let mut redeclared: IndexMap<Name, (Span, Vec<Name>), FxBuildHasher> = IndexMap::default();
    for (item, _) in &declared {
        if !item.is_name() {
            sink.unexpected(*item, "the name of a type");
            continue;
        }
        sink.declare(NameKind::Type, *item, None);
        if table.get(&*fold(item.text())).is_some_and(|e| e.imported.is_some()) {
            redeclared.insert(Name::new(item.text()), (item.span(), Vec::new()));
        } else {
            let entry = || Entry { span: item.span(), parents: Vec::new(), imported: None };
            table.entry(Name::new(item.text())).or_insert_with(entry);
        }
    }
    for (item, types) in declared {
        let (true, Some(types)) = (item.is_name(), types) else { continue };
        for parent in type_names(sink, types) {
            let name = Name::new(parent.text());
            // A type that appears only as a parent is declared here.
            if table.contains_key(&name) {
                sink.mention(NameKind::Type, parent, None);
            } else {
                sink.declare(NameKind::Type, parent, None);
            }
            let entry = || Entry { span: parent.span(), parents: Vec::new(), imported: None };
            table.entry(name.clone()).or_insert_with(entry);
            if let Some((_, parents)) = redeclared.get_mut(&*fold(item.text())) {
                parents.push(name);
            } else if let Some(entry) = table.get_mut(&*fold(item.text())) {
                entry.parents.push(name);
            }
        }
    }
    for (name, (span, mut parents)) in redeclared {
        let entry = &table[&name];
        parents = simple(parents);
        let same = parents.len() == entry.parents.len() && parents.iter().all(|p| entry.parents.contains(p));
        if let (false, Some(import)) = (same, entry.imported.clone()) {
            sink.report(span, DiagnosticKind::ImportConflict { symbol: SymbolKind::Type, name, import });
        }
    }
    for (name, entry) in &mut table {
        if &**name == "object" {
            // `object - object` has no effect; any other parent of `object` would be a cycle.
            entry.parents.retain(|p| &**p != "object");
        } else {
            entry.parents = simple(std::mem::take(&mut entry.parents));
        }
    }
    report_cycles(sink, &table);
    close(&table)
}

/// Each parent once; `object` only if it is the sole parent.
fn simple(parents: Vec<Name>) -> Vec<Name> {
    let mut simple: Vec<Name> = Vec::with_capacity(parents.len());
    for parent in parents {
        if &*parent != "object" && !simple.contains(&parent) {
            simple.push(parent);
        }
    }
    if simple.is_empty() {
        simple.push(Name::new("object"));
    }
    simple
}

fn import(table: &mut Table, domain: &Domain) {
    for (id, t) in domain.types.enumerate() {
        if id == TypeTable::OBJECT {
            continue;
        }
        let entry = table.entry(t.name.clone()).or_insert_with(|| Entry {
            span: Span::default(),
            parents: Vec::new(),
            imported: Some(domain.name.clone()),
        });
        entry.parents.extend(t.parents.iter().map(|&p| domain.types[p].name.clone()));
        entry.parents = simple(std::mem::take(&mut entry.parents));
    }
}

/// Reports each cycle once, with its path. Iterative, since hierarchies can be deep.
fn report_cycles(sink: &mut Sink, table: &Table) {
    let mut done: FxHashSet<usize> = FxHashSet::default();
    for start in 0..table.len() {
        // The path from `start`: each type with the position of its next parent to visit.
        let mut way: Vec<(usize, usize)> = vec![(start, 0)];
        let mut on_way: FxHashSet<usize> = FxHashSet::from_iter([start]);
        while let Some((at, next)) = way.last_mut() {
            let (at, position) = (*at, *next);
            *next += 1;
            let parent = table[at].parents.get(position).and_then(|p| table.get_index_of(p));
            let Some(parent) = parent else {
                if position >= table[at].parents.len() {
                    way.pop();
                    on_way.remove(&at);
                    done.insert(at);
                }
                continue;
            };
            if on_way.contains(&parent) {
                let from = way.iter().position(|(t, _)| *t == parent).unwrap_or(0);
                let name = |i: usize| table.get_index(i).map(|(n, _)| n.clone());
                let cycle = way[from..].iter().map(|(t, _)| *t).chain([parent]).filter_map(name).collect();
                sink.report(table[parent].span, DiagnosticKind::CyclicTypes { cycle });
            } else if !done.contains(&parent) {
                way.push((parent, 0));
                on_way.insert(parent);
            }
        }
    }
}

fn close(table: &Table) -> TypeTable {
    let id = |name: &Name| table.get_index_of(name).map(TypeId::from_index);
    let types = table
        .iter()
        .map(|(name, entry)| Type {
            name: name.clone(),
            parents: entry.parents.iter().filter_map(id).collect(),
            span: entry.span,
        })
        .collect();
    TypeTable::new(types)
}
