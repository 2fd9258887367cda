//! The workspace's packages as the checks need them.

use std::path::{Path, PathBuf};

use cargo_metadata::{DependencyKind, MetadataCommand};

use crate::failure::Failure;

/// A package of the workspace.
#[derive(Debug)]
pub(crate) struct Package {
    /// Its folder, relative to the workspace's root: `workshop/lints`.
    pub(crate) folder: String,
    /// The name of its library in code.
    pub(crate) library: Option<String>,
    /// Whether it is a program too.
    pub(crate) is_program: bool,
    /// The roots of its library and programs.
    pub(crate) roots: Vec<PathBuf>,
    /// The folders of the workspace that it depends on outside tests.
    pub(crate) dependencies: Vec<String>,
}

impl Package {
    /// Whether it is a library for other crates: not the program's own, nor the one that only its tests share.
    pub(crate) fn is_for_others(&self) -> bool {
        !self.is_program && self.folder != "tests"
    }
}

/// All packages of the workspace.
pub(crate) fn packages(root: &Path) -> Result<Vec<Package>, Failure> {
    let metadata = MetadataCommand::new().manifest_path(root.join("Cargo.toml")).no_deps().exec()?;
    let relative = |path: &Path| path.strip_prefix(root).unwrap_or(path).display().to_string();
    let packages = metadata.packages.iter().map(|package| {
        let of_kind = |library: bool| {
            package.targets.iter().filter(move |t| if library { t.is_lib() } else { t.is_bin() })
        };
        let folder = package.manifest_path.parent().map_or(String::new(), |p| relative(p.as_std_path()));
        let dependencies = package.dependencies.iter().filter(|d| d.kind != DependencyKind::Development);
        Package {
            folder,
            library: of_kind(true).next().map(|target| target.name.clone()),
            is_program: of_kind(false).next().is_some(),
            roots: of_kind(true).chain(of_kind(false)).map(|t| t.src_path.clone().into()).collect(),
            dependencies: dependencies
                .filter_map(|d| Some(relative(d.path.as_ref()?.as_std_path())))
                .collect(),
        }
    });
    Ok(packages.collect())
}
