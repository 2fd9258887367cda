//! A public item has a user outside its crate.
//!
//! An item that a library exports is used if a source of another crate that names the library names the item too, or
//! if it stands in the public signature of an item that is used: a reader of the documentation needs it. Names are
//! compared as words, so a name that two crates share hides an unused one; the check finds what is forgotten, it
//! proves nothing. `surface.exceptions`, beside this crate's `Cargo.toml`, lists what stays for a caller that is
//! planned or that is no library: `library::Name  the reason`. An exception that is no longer needed is a finding.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use syn::visit::{self, Visit};
use syn::{ImplItem, Item, Visibility};

use crate::failure::Failure;
use crate::modules::{Crate, is_test};
use crate::packages::Package;
use crate::sources;

const EXCEPTIONS: &str = "workshop/xtask/surface.exceptions";

/// What no other crate uses, and exceptions without need, a sentence each.
pub(crate) fn check(root: &Path, packages: &[Package]) -> Result<Vec<String>, Failure> {
    let texts = packages
        .iter()
        .map(|package| words(&root.join(&package.folder).join("src")))
        .collect::<Result<Vec<_>, Failure>>()?;
    let mut unused = BTreeSet::new();
    for (index, package) in packages.iter().enumerate() {
        let Some(library) = package.library.as_ref().filter(|_| package.is_for_others()) else { continue };
        let krate = Crate::read(&package.roots[0])?;
        let others = texts.iter().enumerate().filter(|(other, _)| *other != index);
        let named: BTreeSet<&str> = others
            .flat_map(|(_, files)| files)
            .filter(|words| words.contains(library))
            .flat_map(|words| words.iter().map(String::as_str))
            .collect();
        let names = unused_names(&krate, &|name| named.contains(name));
        unused.extend(names.into_iter().map(|name| format!("{library}::{name}")));
    }
    Ok(findings(&unused, &exceptions(root)?))
}

fn findings(unused: &BTreeSet<String>, exceptions: &BTreeMap<String, String>) -> Vec<String> {
    let unused_ones = unused.iter().filter(|name| !exceptions.contains_key(*name));
    let needless = exceptions.keys().filter(|name| !unused.contains(*name));
    let without_reason = exceptions.iter().filter(|(_, reason)| reason.is_empty());
    unused_ones
        .map(|name| {
            format!("{name} is public and no other crate's src names it: make it private, or delete it")
        })
        .chain(needless.map(|name| format!("{EXCEPTIONS} lists {name}, which is used or gone")))
        .chain(without_reason.map(|(name, _)| format!("{EXCEPTIONS} gives no reason for {name}")))
        .collect()
}

fn exceptions(root: &Path) -> Result<BTreeMap<String, String>, Failure> {
    let text = sources::read(&root.join(EXCEPTIONS))?;
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let split = |line: &str| {
        let (name, reason) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        (name.to_owned(), reason.trim().to_owned())
    };
    Ok(lines.map(split).collect())
}

/// The words of each file of a folder.
fn words(folder: &Path) -> Result<Vec<BTreeSet<String>>, Failure> {
    let word = |c: char| !(c.is_alphanumeric() || c == '_');
    let files = sources::rust_files(folder)?;
    files.iter().map(|path| Ok(sources::read(path)?.split(word).map(str::to_owned).collect())).collect()
}

/// The names that the crate exports, that are not `named`, and that stand in no signature of a used item.
fn unused_names(krate: &Crate, named: &dyn Fn(&str) -> bool) -> BTreeSet<String> {
    let mut signatures = Signatures::default();
    for file in krate.parsed() {
        signatures.items(&file.items);
    }
    let exported = krate.exported();
    let mut used: BTreeSet<String> = exported.iter().filter(|name| named(name)).cloned().collect();
    let mut open: Vec<String> = used.iter().cloned().collect();
    while let Some(name) = open.pop() {
        for word in signatures.0.get(&name).into_iter().flatten() {
            if used.insert(word.clone()) {
                open.push(word.clone());
            }
        }
    }
    exported.difference(&used).cloned().collect()
}

/// By the name of an item, the names in what is public of it.
#[derive(Default)]
struct Signatures(BTreeMap<String, BTreeSet<String>>);

impl Signatures {
    fn items(&mut self, items: &[Item]) {
        for item in items.iter().filter(|item| !is_test(item)) {
            match item {
                Item::Fn(item) => self.add(&item.sig.ident, |names| names.visit_signature(&item.sig)),
                Item::Const(item) => self.add(&item.ident, |names| names.visit_type(&item.ty)),
                Item::Static(item) => self.add(&item.ident, |names| names.visit_type(&item.ty)),
                Item::Type(item) => self.add(&item.ident, |names| names.visit_item_type(item)),
                Item::Trait(item) => self.add(&item.ident, |names| names.visit_item_trait(item)),
                Item::Enum(item) => self.add(&item.ident, |names| names.visit_item_enum(item)),
                Item::Struct(item) => self.add(&item.ident, |names| {
                    let public = item.fields.iter().filter(|f| matches!(f.vis, Visibility::Public(_)));
                    public.for_each(|field| names.visit_type(&field.ty));
                    names.visit_generics(&item.generics);
                }),
                Item::Impl(item) => self.methods(item),
                Item::Mod(item) => {
                    if let Some((_, items)) = &item.content {
                        self.items(items);
                    }
                }
                _ => {}
            }
        }
    }

    fn methods(&mut self, item: &syn::ItemImpl) {
        let syn::Type::Path(of) = &*item.self_ty else { return };
        let Some(name) = of.path.segments.last().map(|segment| segment.ident.clone()) else { return };
        self.add(&name, |names| {
            for part in &item.items {
                match part {
                    ImplItem::Fn(f) if item.trait_.is_some() || matches!(f.vis, Visibility::Public(_)) => {
                        names.visit_signature(&f.sig);
                    }
                    ImplItem::Type(t) => names.visit_type(&t.ty),
                    _ => {}
                }
            }
        });
    }

    fn add(&mut self, name: &syn::Ident, visit: impl FnOnce(&mut Names)) {
        let mut names = Names(std::mem::take(self.0.entry(name.to_string()).or_default()));
        visit(&mut names);
        self.0.insert(name.to_string(), names.0);
    }
}

/// Every segment of every path.
struct Names(BTreeSet<String>);

impl<'ast> Visit<'ast> for Names {
    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.0.extend(path.segments.iter().map(|segment| segment.ident.to_string()));
        visit::visit_path(self, path);
    }

    fn visit_block(&mut self, _: &'ast syn::Block) {}

    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_item_that_no_other_crate_names_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let text = "mod inner { pub struct Used { pub part: Part } pub struct Part; pub struct Idle(Hidden);
            pub struct Hidden; impl Used { pub fn go(&self) -> Result<(), Error> { Ok(()) } } pub enum Error {} }
            pub use inner::{Error, Hidden, Idle, Part, Used};";
        std::fs::write(folder.path().join("lib.rs"), text).unwrap();
        let krate = Crate::read(&folder.path().join("lib.rs")).unwrap();
        let unused = unused_names(&krate, &|name| name == "Used");
        assert_eq!(unused, BTreeSet::from(["Hidden".to_owned(), "Idle".to_owned()]));
    }

    #[test]
    fn exceptions_must_be_needed_and_have_a_reason() {
        let unused = BTreeSet::from(["a::B".to_owned(), "a::C".to_owned()]);
        let exceptions = [("a::B", "planned"), ("a::D", "planned"), ("a::C", "")];
        let exceptions = exceptions.map(|(name, reason)| (name.to_owned(), reason.to_owned())).into();
        assert_eq!(findings(&unused, &exceptions).len(), 2);
        assert_eq!(findings(&unused, &BTreeMap::new()).len(), 2);
    }
}
