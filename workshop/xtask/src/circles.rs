//! No files of a crate import each other in a circle: such files can only be read, tested and moved together.
//!
//! Strongly connected components over the arrows between files ([`Crate::arrows`]). `circles.baseline`, beside this
//! crate's `Cargo.toml`, lists the files whose circles are still to be opened; it may only shrink.

use std::collections::BTreeSet;
use std::path::Path;

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;

use crate::failure::Failure;
use crate::modules::{Crate, FileId};
use crate::packages::Package;
use crate::sources;

const BASELINE: &str = "workshop/xtask/circles.baseline";

/// Each circle that the baseline does not list, and each file of the baseline that is in no circle, a sentence each.
pub(crate) fn check(root: &Path, packages: &[Package]) -> Result<Vec<String>, Failure> {
    let mut found = Vec::new();
    for package in packages {
        for target in &package.roots {
            found.extend(circles(root, &Crate::read(target)?));
        }
    }
    let baseline = sources::read(&root.join(BASELINE))?;
    Ok(findings(&found, &baseline.lines().map(str::to_owned).collect()))
}

fn findings(found: &[Circle], baseline: &BTreeSet<String>) -> Vec<String> {
    let is_new = |circle: &&Circle| !circle.files.is_subset(baseline);
    let in_circles: BTreeSet<&String> = found.iter().flat_map(|circle| &circle.files).collect();
    let opened = baseline.iter().filter(|file| !in_circles.contains(file));
    let new = found.iter().filter(is_new).map(|circle| {
        let ties: String = circle.ties.iter().map(|tie| format!("\n  {tie}")).collect();
        format!("{} files import each other in a circle:{ties}", circle.files.len())
    });
    new.chain(opened.map(|file| format!("{BASELINE} lists {file}, which is in no circle: remove the line")))
        .collect()
}

/// Files that import each other, and the names that tie them.
struct Circle {
    files: BTreeSet<String>,
    ties: Vec<String>,
}

fn circles(root: &Path, krate: &Crate) -> Vec<Circle> {
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
        let ties = within.map(|((from, to), names)| {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            format!("{} uses {} of {}", name(*from), names.join(", "), name(*to))
        });
        Circle { ties: ties.collect(), files: component.iter().map(|&file| name(file)).collect() }
    };
    components.map(circle).collect()
}

#[cfg(test)]
mod tests {
    use super::{circles, findings};
    use crate::modules::Crate;
    use std::collections::BTreeSet;

    fn found(files: &[(&str, &str)], baseline: &[&str]) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        let found = circles(folder.path(), &Crate::read(&folder.path().join("lib.rs")).unwrap());
        findings(&found, &baseline.iter().map(|&line| line.to_owned()).collect::<BTreeSet<_>>())
    }

    const CIRCLE: [(&str, &str); 3] = [
        ("lib.rs", "mod a; mod b; pub use a::A; pub use b::B;"),
        ("a.rs", "use crate::B; pub struct A(B);"),
        ("b.rs", "pub struct B; pub fn f() { let _ = vec![crate::A::new(B)]; }"),
    ];

    #[test]
    fn two_files_that_import_each_other_are_found() {
        assert_eq!(
            found(&CIRCLE, &[]),
            ["2 files import each other in a circle:\n  a.rs uses B of b.rs\n  b.rs uses A of a.rs"]
        );
    }

    #[test]
    fn the_baseline_may_only_shrink() {
        assert!(found(&CIRCLE, &["a.rs", "b.rs"]).is_empty());
        assert_eq!(found(&CIRCLE, &["a.rs"]).len(), 1);
        assert_eq!(
            found(&CIRCLE, &["a.rs", "b.rs", "c.rs"]),
            ["workshop/xtask/circles.baseline lists c.rs, which is in no circle: remove the line"]
        );
    }

    #[test]
    fn facades_and_tests_make_no_circle() {
        let files = [
            ("lib.rs", "mod a; mod b; pub use a::A; pub use b::B; pub struct Root;"),
            (
                "a.rs",
                "use crate::Root; pub struct A(Root); #[cfg(test)] mod tests { use crate::B; fn t() { B; } }",
            ),
            ("b.rs", "use super::a; pub struct B(a::A);"),
        ];
        assert!(found(&files, &[]).is_empty());
    }
}
