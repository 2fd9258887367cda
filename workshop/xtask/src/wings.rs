//! The robot never depends on the workshop: only `workshop/` itself, the program and the tests across crates may.

use crate::packages::Package;

const WORKSHOP: &str = "workshop/";

/// Each dependency of the robot on the workshop, a sentence.
pub(crate) fn check(packages: &[Package]) -> Vec<String> {
    let may = |folder: &str| folder.starts_with(WORKSHOP) || folder == "cli" || folder == "tests";
    let robot = packages.iter().filter(|package| !may(&package.folder));
    robot
        .flat_map(|package| {
            let wrong = package.dependencies.iter().filter(|to| to.starts_with(WORKSHOP));
            wrong.map(|to| {
                format!("{} depends on {to}: the robot never depends on the workshop", package.folder)
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{Package, check};

    fn package(folder: &str, to: &str) -> Package {
        let dependencies = vec![to.to_owned()];
        Package { folder: folder.into(), library: None, is_program: false, roots: Vec::new(), dependencies }
    }

    #[test]
    fn only_the_workshop_the_program_and_the_tests_may() {
        assert_eq!(
            check(&[package("mission", "workshop/project")]),
            ["mission depends on workshop/project: the robot never depends on the workshop"]
        );
        for folder in ["workshop/ide", "cli", "tests"] {
            assert!(check(&[package(folder, "workshop/project")]).is_empty());
        }
        assert!(check(&[package("mission", "diagnostics")]).is_empty());
    }
}
