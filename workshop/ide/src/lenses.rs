//! Code lenses: commands over a declaration, and the number of its uses.

use diagnostics::SourceId;
use pddl::{NameKind, Role, Span, Symbol};
use project::{FileKind, Project};
use rustc_hash::FxHashMap;

use crate::entity::{occurrences, visible_from};

/// The content of a lens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lens {
    /// Plan for the problem in this file, with that domain file.
    Plan {
        /// The domain's file.
        domain: SourceId,
    },
    /// Validate the plan in this file for that problem.
    Validate {
        /// The domain's file.
        domain: SourceId,
        /// The problem's file.
        problem: SourceId,
    },
    /// The number of uses of the name below, over the project.
    References {
        /// Uses, without declarations.
        count: usize,
    },
}

/// A lens over a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CodeLens {
    /// The name below the line.
    pub span: Span,
    /// Its content.
    pub lens: Lens,
}

/// The lenses of a file, in order of place.
pub fn code_lenses(project: &Project, source: SourceId) -> Vec<CodeLens> {
    let domain = project.domain_of(source);
    match (project.kind(source), domain, project.problem_of(source)) {
        (FileKind::Domain, ..) => references(project, source),
        (FileKind::Problem, Some(domain), _) => {
            let names = occurrences(project, source).iter();
            let name = names.filter(|o| o.symbol.kind == NameKind::Problem).map(|o| o.span).next();
            vec![CodeLens { span: name.unwrap_or_default(), lens: Lens::Plan { domain } }]
        }
        (FileKind::Plan, Some(domain), Some(problem)) => {
            let first = occurrences(project, source).first().map(|o| o.span);
            vec![CodeLens { span: first.unwrap_or_default(), lens: Lens::Validate { domain, problem } }]
        }
        (FileKind::Problem | FileKind::Plan, ..) => Vec::new(),
    }
}

/// The number of uses of each declaration. Visits every occurrence of the files that may use one once,
/// whatever the number of declarations.
fn references(project: &Project, source: SourceId) -> Vec<CodeLens> {
    const COUNTED: [NameKind; 6] = [
        NameKind::Action,
        NameKind::Task,
        NameKind::Predicate,
        NameKind::Function,
        NameKind::Process,
        NameKind::Event,
    ];
    let mut counts: FxHashMap<&Symbol, usize> = FxHashMap::default();
    let declared = || {
        let all = occurrences(project, source).iter();
        all.filter(|o| o.role == Role::Declaration && COUNTED.contains(&o.symbol.kind))
    };
    for o in declared() {
        counts.insert(&o.symbol, 0);
    }
    for file in project.ids() {
        let sees = COUNTED.map(|kind| visible_from(project, file, kind).contains(&source));
        if !sees.contains(&true) {
            continue;
        }
        for o in occurrences(project, file).iter().filter(|o| o.role == Role::Use) {
            let seen = COUNTED.iter().position(|&k| k == o.symbol.kind).is_some_and(|i| sees[i]);
            if let (true, Some(count)) = (seen, counts.get_mut(&o.symbol)) {
                *count += 1;
            }
        }
    }
    declared()
        .map(|o| CodeLens { span: o.span, lens: Lens::References { count: counts[&o.symbol] } })
        .collect()
}
