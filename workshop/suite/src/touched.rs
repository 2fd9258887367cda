//! Which suites a change affects.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The paths of a suite, as a watcher reports them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Extent {
    /// The suite's folder.
    pub folder: PathBuf,
    /// Files from other folders that it was read with.
    pub elsewhere: BTreeSet<PathBuf>,
}

/// The positions of the suites that a change of those paths affects: a change of a file below a suite's folder that the
/// suite could read, or of a file that it took from elsewhere. A change below a nested suite affects that one alone.
pub fn touched(suites: &[Extent], changed: &[PathBuf]) -> Vec<usize> {
    let nearest = |path: &Path| {
        let above = suites.iter().filter(|suite| path.starts_with(&suite.folder));
        above.map(|suite| suite.folder.components().count()).max()
    };
    let concerns = |suite: &Extent, path: &PathBuf| {
        let below = path.starts_with(&suite.folder)
            && nearest(path) == Some(suite.folder.components().count())
            && (could_be_read(path) || *path == suite.folder);
        below || suite.elsewhere.contains(path)
    };
    let indices = suites.iter().enumerate();
    indices
        .filter(|(_, suite)| changed.iter().any(|path| concerns(suite, path)))
        .map(|(index, _)| index)
        .collect()
}

/// Whether a suite reads files like that: `expected.toml`, domains, problems and plans.
fn could_be_read(path: &Path) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
    name == "expected.toml" || project::FileKind::is_source(&name)
}

#[cfg(test)]
mod tests {
    use super::{Extent, touched};
    use std::path::PathBuf;

    fn check(changed: &str, expected: &[usize]) {
        let suite = |folder: &str, elsewhere: &[&str]| Extent {
            folder: folder.into(),
            elsewhere: elsewhere.iter().map(PathBuf::from).collect(),
        };
        let suites = [
            suite("/d/tea", &["/robots/r/vocabulary.pddl"]),
            suite("/d/tea/further", &["/d/tea/domain.pddl"]),
            suite("/d/coffee", &[]),
        ];
        assert_eq!(touched(&suites, &[changed.into()]), expected, "{changed}");
    }

    #[test]
    fn a_change_affects_the_nearest_suite_and_each_that_took_the_file() {
        check("/d/coffee/plans/valid/a.plan", &[2]);
        check("/d/coffee/expected.toml", &[2]);
        check("/d/tea/further/p.pddl", &[1]);
        check("/d/tea/domain.pddl", &[0, 1]);
        check("/robots/r/vocabulary.pddl", &[0]);
    }

    #[test]
    fn a_file_that_no_suite_reads_affects_no_suite() {
        check("/d/coffee/.p.pddl.swp", &[]);
        check("/d/coffee/README.md", &[]);
        check("/d/coffee2/p.pddl", &[]);
        check("/robots/r/world.pddl", &[]);
    }
}
