//! Collects the plans to judge, each with its task.
//!
//! The arguments are either a domain, a problem and plans, or folders that contain all three. A
//! folder among plans stands for every plan file in it and below. In folders of tasks, files belong
//! together by the rules of the crate `project`: a problem belongs to the nearest file that defines
//! its domain, and a plan to the problem beside it whose name is a prefix of its own, or to the
//! only problem.
//!
//! Invariant: every argument that leads to no plan is a [`Fault`]; none is ignored silently.

use crate::files::{self, FileError};
use crate::nearby::MANIFEST;
use diagnostics::SourceId;
use pddl::Source;
use project::{FileKind, Project};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Plans of one task.
#[derive(Debug)]
pub(super) struct Group {
    pub(super) domain: PathBuf,
    /// Files among those given that the domain needs.
    pub(super) imports: Vec<PathBuf>,
    pub(super) problem: PathBuf,
    pub(super) plans: Vec<PathBuf>,
}

/// An argument or file that cannot be judged.
#[derive(Debug, Error)]
pub(super) enum Fault {
    /// A folder among plans, or of tasks.
    #[error("there is no plan in `{}`", .0.display())]
    NoPlans(PathBuf),
    /// A plan in a folder of tasks.
    #[error("no problem belongs to the plan `{}`: none beside it, or several", .0.display())]
    NoProblem(PathBuf),
    /// A plan in a folder of tasks.
    #[error("no domain belongs to the problem `{}` of the plan `{}`", .problem.display(), .plan.display())]
    NoDomain { problem: PathBuf, plan: PathBuf },
    /// A file beside folders.
    #[error("`{}` is no folder: give a domain, a problem and plans, or folders that hold all of them", .0.display())]
    NoFolder(PathBuf),
    /// A folder of tasks that is a mission.
    #[error(
        "`{}` is a mission: `pelea test` judges its plans and plays its scenarios, `pelea check` checks its files",
        .0.display()
    )]
    Mission(PathBuf),
    /// Too few arguments.
    #[error("no plan is given: give a domain, a problem and plans, or folders that hold all of them")]
    Nothing,
    /// `-` twice.
    #[error("standard input can be read only once")]
    StandardInputAgain,
    #[error(transparent)]
    File(#[from] FileError),
}

impl Fault {
    /// The plan that this fault keeps from being judged.
    pub(super) fn plan(&self) -> Option<&Path> {
        match self {
            Self::NoProblem(plan) | Self::NoDomain { plan, .. } => Some(plan),
            _ => None,
        }
    }
}

/// The groups to judge, and the faults found on the way.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    pub(super) groups: Vec<Group>,
    pub(super) faults: Vec<Fault>,
}

pub(super) fn gather(paths: &[PathBuf]) -> Gathered {
    let mut gathered = Gathered::default();
    if paths.iter().filter(|path| *path == Path::new("-")).count() > 1 {
        gathered.faults.push(Fault::StandardInputAgain);
        return gathered;
    }
    match paths {
        [first, ..] if first.is_dir() => gathered.tasks(paths),
        [domain, problem, plans @ ..] if !plans.is_empty() => {
            let plans = gathered.plans(plans);
            gathered.groups.push(Group {
                domain: domain.clone(),
                imports: Vec::new(),
                problem: problem.clone(),
                plans,
            });
        }
        _ => gathered.faults.push(Fault::Nothing),
    }
    gathered
}

impl Gathered {
    /// The plan files of the arguments, with folders expanded.
    fn plans(&mut self, given: &[PathBuf]) -> Vec<PathBuf> {
        let mut plans = Vec::new();
        for path in given {
            if !path.is_dir() {
                plans.push(path.clone());
                continue;
            }
            let before = plans.len();
            below(path, &mut |file| {
                if FileKind::is_plan(&file.to_string_lossy()) {
                    plans.push(file);
                }
            });
            if plans.len() == before {
                self.faults.push(Fault::NoPlans(path.clone()));
            }
        }
        plans
    }

    /// Folders that contain domains, problems and plans.
    fn tasks(&mut self, folders: &[PathBuf]) {
        let mut paths = BTreeSet::new();
        for folder in folders {
            if !folder.is_dir() {
                self.faults.push(Fault::NoFolder(folder.clone()));
                continue;
            }
            if folder.join(MANIFEST).is_file() {
                self.faults.push(Fault::Mission(folder.clone()));
                continue;
            }
            let mut plans = 0;
            below(folder, &mut |file| {
                let name = file.to_string_lossy().into_owned();
                if FileKind::is_source(&name) {
                    plans += usize::from(FileKind::is_plan(&name));
                    paths.insert(file);
                }
            });
            if plans == 0 {
                self.faults.push(Fault::NoPlans(folder.clone()));
            }
        }
        let mut sources = Vec::new();
        for path in paths {
            let name = path.display().to_string();
            if FileKind::is_plan(&name) {
                // The plan is read when it is judged.
                sources.push(Source::new(name, ""));
            } else {
                match files::read(&path) {
                    Ok(source) => sources.push(source),
                    Err(error) => self.faults.push(error.into()),
                }
            }
        }
        let mut project = Project::without_names();
        let ids = project.set_all(sources);
        let path = |id: SourceId| PathBuf::from(project.path(id));
        let mut positions: BTreeMap<(SourceId, SourceId), usize> = BTreeMap::new();
        for plan in ids.into_iter().filter(|&id| project.kind(id) == FileKind::Plan) {
            let Some(problem) = project.problem_of(plan) else {
                self.faults.push(Fault::NoProblem(path(plan)));
                continue;
            };
            let Some(domain) = project.domain_of(problem) else {
                self.faults.push(Fault::NoDomain { problem: path(problem), plan: path(plan) });
                continue;
            };
            let position = *positions.entry((domain, problem)).or_insert_with(|| {
                let mut imports: Vec<PathBuf> = project.with_imports(domain).into_iter().map(path).collect();
                imports.pop();
                let (domain, problem) = (path(domain), path(problem));
                let group = Group { domain, imports, problem, plans: Vec::new() };
                self.groups.push(group);
                self.groups.len() - 1
            });
            self.groups[position].plans.push(path(plan));
        }
    }
}

/// All files in a folder and below it, in order. Skips hidden folders and links to folders.
fn below(folder: &Path, visit: &mut dyn FnMut(PathBuf)) {
    for path in crate::nearby::entries(folder) {
        if path.is_file() {
            visit(path);
        } else if path.is_dir() && !path.is_symlink() {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if !name.starts_with('.') {
                below(&path, visit);
            }
        }
    }
}
