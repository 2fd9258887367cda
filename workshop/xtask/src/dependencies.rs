//! Finds unused dependencies: each one slows every build and adds a false arrow to the architecture.
//!
//! A dependency is used if its name is followed by `::`, or follows `use`, in the sources of the crate. Names in
//! comments count too, so the check finds forgotten dependencies but proves nothing. Dependencies of tests are not
//! checked, because tests share files across crates.

use crate::failure::Failure;
use crate::sources;
use cargo_metadata::{DependencyKind, MetadataCommand};
use std::path::Path;

/// Returns one sentence for each unused dependency.
pub(crate) fn check(root: &Path) -> Result<Vec<String>, Failure> {
    let metadata = MetadataCommand::new().manifest_path(root.join("Cargo.toml")).no_deps().exec()?;
    let mut findings = Vec::new();
    for package in &metadata.packages {
        let folder = package.manifest_path.parent().map_or(root, |p| p.as_std_path());
        let text = text_of(&folder.join("src"))?;
        for dependency in package.dependencies.iter().filter(|d| d.kind == DependencyKind::Normal) {
            let name = dependency.rename.as_ref().unwrap_or(&dependency.name).replace('-', "_");
            if !names(&text, &name) {
                findings.push(format!("{}: nothing uses the dependency {name}", package.name));
            }
        }
    }
    Ok(findings)
}

fn text_of(folder: &Path) -> Result<String, Failure> {
    sources::rust_files(folder)?.iter().map(|path| sources::read(path)).collect()
}

/// Whether the text contains `name::` or `use name`, as a whole word.
fn names(text: &str, name: &str) -> bool {
    text.match_indices(name).any(|(at, _)| {
        let (before, after) = (&text[..at], &text[at + name.len()..]);
        let word = |c: char| c.is_alphanumeric() || c == '_';
        !before.ends_with(word)
            && !after.starts_with(word)
            && (after.starts_with("::") || before.ends_with("use "))
    })
}

#[cfg(test)]
mod tests {
    use super::names;

    #[test]
    fn whole_names_count() {
        for text in ["use dsr::Graph;", "dsr::Graph::new()", "use dsr;", "pub use dsr as graph;"] {
            assert!(names(text, "dsr"), "{text}");
        }
        for text in ["", "use my_dsr::x;", "dsrs::x", "// the dsr"] {
            assert!(!names(text, "dsr"), "{text}");
        }
    }
}
