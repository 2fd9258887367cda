//! No files of a crate import each other in a circle: such files can only be read, tested and moved together.
//!
//! Strongly connected components over the arrows between files ([`Crate::arrows`]). There is no list of exceptions.

use std::path::Path;

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;

use crate::failure::Failure;
use crate::modules::{Crate, FileId};
use crate::packages::Package;

/// Each circle, a sentence with a line for each tie.
pub(crate) fn check(root: &Path, packages: &[Package]) -> Result<Vec<String>, Failure> {
    let mut findings = Vec::new();
    for package in packages {
        for target in &package.roots {
            findings.extend(circles(root, &Crate::read(target)?));
        }
    }
    Ok(findings)
}

fn circles(root: &Path, krate: &Crate) -> Vec<String> {
    let arrows = krate.arrows();
    let graph = DiGraphMap::<FileId, ()>::from_edges(arrows.keys().copied());
    let components = tarjan_scc(&graph).into_iter().filter(|component| component.len() > 1);
    let name = |file: FileId| {
        let path = krate.path(file);
        path.strip_prefix(root).unwrap_or(path).display().to_string()
    };
    let circle = |component: Vec<FileId>| {
        let within =
            arrows.iter().filter(|((from, to), _)| component.contains(from) && component.contains(to));
        let ties: String = within
            .map(|((from, to), names)| {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                format!("\n  {} uses {} of {}", name(*from), names.join(", "), name(*to))
            })
            .collect();
        format!("{} files import each other in a circle:{ties}", component.len())
    };
    components.map(circle).collect()
}

#[cfg(test)]
mod tests {
    use super::circles;
    use crate::modules::Crate;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        circles(folder.path(), &Crate::read(&folder.path().join("lib.rs")).unwrap())
    }

    #[test]
    fn two_files_that_import_each_other_are_found() {
        let found = found(&[
            ("lib.rs", "mod a; mod b; pub use a::A; pub use b::B;"),
            ("a.rs", "use crate::B; pub struct A(B);"),
            ("b.rs", "pub struct B; pub fn f() { let _ = vec![crate::A::new(B)]; }"),
        ]);
        assert_eq!(
            found,
            ["2 files import each other in a circle:\n  a.rs uses B of b.rs\n  b.rs uses A of a.rs"]
        );
    }

    #[test]
    fn facades_and_tests_make_no_circle() {
        let found = found(&[
            ("lib.rs", "mod a; mod b; pub use a::A; pub use b::B; pub struct Root;"),
            (
                "a.rs",
                "use crate::Root; pub struct A(Root); #[cfg(test)] mod tests { use crate::B; fn t() { B; } }",
            ),
            ("b.rs", "use super::a; pub struct B(a::A);"),
        ]);
        assert_eq!(found, [""; 0]);
    }
}
