//! The modules of a crate, read from its sources: which file defines a name, and which names a file mentions.
//!
//! Problem: `use crate::Edit` names the façade, but what a reader has to open is the file that defines `Edit`.
//! Idea: parse every file with `syn`, note per module what each name is (defined here, a child module, an import), and
//! follow imports and re-exports to the defining file. Private imports, paths in code and paths in the arguments of
//! macros count as mentions; a `pub use` is a door and counts only where its own file mentions the name.
//! Modules under `#[cfg(test)]` are left out. Cost: one parse of each file, about a second for the whole workspace.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Item, ItemMod, ItemUse, UseTree, Visibility};

use crate::failure::Failure;
use crate::sources;

/// A file of a crate, by number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct FileId(usize);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct ModuleId(usize);

/// What a name is in a module.
#[derive(Clone, Debug)]
enum Meaning {
    Defined,
    Child(ModuleId),
    Import(Vec<String>),
}

#[derive(Debug)]
struct Module {
    parent: Option<ModuleId>,
    file: FileId,
    names: BTreeMap<String, Meaning>,
    public: BTreeSet<String>,
    globs: Vec<(Vec<String>, bool)>,
    mentions: Vec<Vec<String>>,
}

/// The modules and files of one crate.
pub(crate) struct Crate {
    modules: Vec<Module>,
    files: Vec<PathBuf>,
    parsed: Vec<syn::File>,
}

/// Where a path leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Target {
    File(FileId),
    Module(ModuleId),
}

impl Crate {
    /// Reads the crate whose root is the file `root` (`lib.rs` or `main.rs`).
    pub(crate) fn read(root: &Path) -> Result<Self, Failure> {
        let mut read = Self { modules: Vec::new(), files: Vec::new(), parsed: Vec::new() };
        let folder = root.parent().unwrap_or(root).to_owned();
        read.file(root.to_owned(), &folder, None)?;
        Ok(read)
    }

    /// The path of a file.
    pub(crate) fn path(&self, file: FileId) -> &Path {
        &self.files[file.0]
    }

    /// All files, parsed.
    pub(crate) fn parsed(&self) -> &[syn::File] {
        &self.parsed
    }

    /// Which file mentions a name that which other file defines.
    pub(crate) fn arrows(&self) -> BTreeMap<(FileId, FileId), BTreeSet<String>> {
        let mut arrows: BTreeMap<_, BTreeSet<String>> = BTreeMap::new();
        for (index, module) in self.modules.iter().enumerate() {
            for mention in &module.mentions {
                if let Some(Target::File(to)) = self.resolve(ModuleId(index), mention, 0)
                    && to != module.file
                {
                    let name = mention.iter().rev().find(|s| s.starts_with(char::is_uppercase));
                    let name = name.or(mention.last()).cloned().unwrap_or_default();
                    arrows.entry((module.file, to)).or_default().insert(name);
                }
            }
        }
        arrows
    }

    /// The names that the crate's root offers to other crates.
    pub(crate) fn exported(&self) -> BTreeSet<String> {
        let mut names = BTreeSet::new();
        self.export(ModuleId(0), &mut names);
        names
    }

    fn export(&self, module: ModuleId, names: &mut BTreeSet<String>) {
        for name in &self.modules[module.0].public {
            match self.resolve(module, std::slice::from_ref(name), 0) {
                Some(Target::Module(child)) if child != module => self.export(child, names),
                _ => {
                    names.insert(name.clone());
                }
            }
        }
        for (path, public) in &self.modules[module.0].globs {
            if let (true, Some(Target::Module(from))) = (*public, self.resolve(module, path, 0)) {
                self.export(from, names);
            }
        }
    }

    fn resolve(&self, from: ModuleId, path: &[String], depth: usize) -> Option<Target> {
        // Imports that lead to each other in a circle do not compile; the bound guards against misreading one.
        if depth > 16 {
            return None;
        }
        let mut module = from;
        for (index, segment) in path.iter().enumerate() {
            let here = &self.modules[module.0];
            match segment.as_str() {
                "crate" => module = ModuleId(0),
                "self" => {}
                "super" => module = here.parent?,
                name => match here.names.get(name) {
                    Some(Meaning::Defined) => return Some(Target::File(here.file)),
                    Some(Meaning::Child(child)) => module = *child,
                    Some(Meaning::Import(target)) if index > 0 || *target != path => {
                        match self.resolve(module, target, depth + 1)? {
                            Target::Module(inner) => module = inner,
                            file => return Some(file),
                        }
                    }
                    _ => return self.through_globs(module, &path[index..], depth),
                },
            }
        }
        Some(Target::Module(module))
    }

    fn through_globs(&self, module: ModuleId, rest: &[String], depth: usize) -> Option<Target> {
        self.modules[module.0].globs.iter().find_map(|(path, _)| {
            match self.resolve(module, path, depth + 1)? {
                Target::Module(from) if from != module => self.resolve(from, rest, depth + 1),
                _ => None,
            }
        })
    }

    fn file(&mut self, path: PathBuf, folder: &Path, parent: Option<ModuleId>) -> Result<ModuleId, Failure> {
        let text = sources::read(&path)?;
        let parsed =
            syn::parse_file(&text).map_err(|error| Failure::Syntax(path.display().to_string(), error))?;
        let file = FileId(self.files.len());
        self.files.push(path);
        self.parsed.push(parsed.clone());
        let module = self.module(file, parent);
        self.items(module, &parsed.items, folder)?;
        Ok(module)
    }

    fn module(&mut self, file: FileId, parent: Option<ModuleId>) -> ModuleId {
        let (names, public, globs, mentions) = Default::default();
        self.modules.push(Module { parent, file, names, public, globs, mentions });
        ModuleId(self.modules.len() - 1)
    }

    fn items(&mut self, id: ModuleId, items: &[Item], folder: &Path) -> Result<(), Failure> {
        for item in items.iter().filter(|item| !is_test(item)) {
            if let Item::Mod(item) = item {
                let child = self.child(id, item, folder)?;
                let name = item.ident.to_string();
                if matches!(item.vis, Visibility::Public(_)) {
                    self.modules[id.0].public.insert(name.clone());
                }
                self.modules[id.0].names.insert(name, Meaning::Child(child));
                continue;
            }
            let module = &mut self.modules[id.0];
            if let Some((name, visibility)) = defined(item) {
                if matches!(visibility, Visibility::Public(_)) {
                    module.public.insert(name.clone());
                }
                module.names.insert(name, Meaning::Defined);
            }
            Mentions(module).visit_item(item);
        }
        Ok(())
    }

    fn child(&mut self, parent: ModuleId, item: &ItemMod, folder: &Path) -> Result<ModuleId, Failure> {
        let name = item.ident.to_string();
        let inner = folder.join(&name);
        if let Some((_, items)) = &item.content {
            let child = self.module(self.modules[parent.0].file, Some(parent));
            self.items(child, items, &inner)?;
            return Ok(child);
        }
        let flat = folder.join(format!("{name}.rs"));
        let path = if flat.exists() { flat } else { inner.join("mod.rs") };
        self.file(path, &inner, Some(parent))
    }
}

/// Whether an item is only built for tests.
pub(crate) fn is_test(item: &Item) -> bool {
    let attributes = match item {
        Item::Mod(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        _ => return false,
    };
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute.parse_args::<syn::Path>().is_ok_and(|path| path.is_ident("test"))
    })
}

fn defined(item: &Item) -> Option<(String, &Visibility)> {
    let (ident, visibility) = match item {
        Item::Const(item) => (&item.ident, &item.vis),
        Item::Enum(item) => (&item.ident, &item.vis),
        Item::Fn(item) => (&item.sig.ident, &item.vis),
        Item::Static(item) => (&item.ident, &item.vis),
        Item::Struct(item) => (&item.ident, &item.vis),
        Item::Trait(item) => (&item.ident, &item.vis),
        Item::Type(item) => (&item.ident, &item.vis),
        Item::Union(item) => (&item.ident, &item.vis),
        _ => return None,
    };
    Some((ident.to_string(), visibility))
}

/// Collects what a module imports and mentions.
struct Mentions<'a>(&'a mut Module);

impl Mentions<'_> {
    fn import(&mut self, tree: &UseTree, before: &[String], visibility: &Visibility) {
        let mut path = before.to_vec();
        match tree {
            UseTree::Path(tree) => {
                path.push(tree.ident.to_string());
                self.import(&tree.tree, &path, visibility);
            }
            UseTree::Group(tree) => tree.items.iter().for_each(|tree| self.import(tree, before, visibility)),
            UseTree::Glob(_) => {
                self.0.globs.push((path, matches!(visibility, Visibility::Public(_))));
            }
            UseTree::Name(tree) => {
                let name = tree.ident.to_string();
                if name == "self" {
                    let name = path.last().cloned().unwrap_or_default();
                    self.bind(name, path, visibility);
                } else {
                    path.push(name.clone());
                    self.bind(name, path, visibility);
                }
            }
            UseTree::Rename(tree) => {
                path.push(tree.ident.to_string());
                self.bind(tree.rename.to_string(), path, visibility);
            }
        }
    }

    fn bind(&mut self, name: String, path: Vec<String>, visibility: &Visibility) {
        match visibility {
            Visibility::Inherited => self.0.mentions.push(path.clone()),
            Visibility::Public(_) => {
                self.0.public.insert(name.clone());
            }
            Visibility::Restricted(_) => {}
        }
        self.0.names.entry(name).or_insert(Meaning::Import(path));
    }

    fn tokens(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut colons = 0;
        for token in tokens {
            match token {
                TokenTree::Ident(ident) => {
                    if colons != 2 {
                        self.mention(std::mem::take(&mut path));
                    }
                    path.push(ident.to_string());
                    colons = 0;
                }
                TokenTree::Punct(punct) if punct.as_char() == ':' => colons += 1,
                other => {
                    self.mention(std::mem::take(&mut path));
                    colons = 0;
                    if let TokenTree::Group(group) = other {
                        self.tokens(group.stream());
                    }
                }
            }
        }
        self.mention(path);
    }

    fn mention(&mut self, path: Vec<String>) {
        if !path.is_empty() {
            self.0.mentions.push(path);
        }
    }
}

impl<'ast> Visit<'ast> for Mentions<'_> {
    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        self.import(&item.tree, &[], &item.vis);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.mention(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, item: &'ast syn::Macro) {
        self.tokens(item.tokens.clone());
    }

    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
}
