//! Finds the domain of a problem and the problem of a plan in a collection of files.
//!
//! Problem: collections have hundreds of domains of one name, so names alone decide little, and their
//! layouts differ: `domain.pddl` beside `p01.pddl`; `domains/domain-1.pddl` and `instances/instance-1.pddl`;
//! `p01-domain.pddl`, `domain_p01.pddl`; a folder above. Idea: consider only domains near the problem (in
//! its folder, in those above it that hold domains, in folders beside it). Of those, prefer the domain with
//! the name that the problem requires, then the one whose file name has the same *key*, then the one without
//! a key, then the nearest. The key is the rest of a file's name without words such as `domain` and
//! `problem`.

use std::path::Path;

/// Words of file names that do not distinguish one task from another.
const WORDS: &[&str] = &["domain", "problem", "instance", "pfile", "prob", "task", "plan", "inst", "p", "d"];

/// A candidate.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'a> {
    /// The file's path.
    pub path: &'a Path,
    /// The name in its `(define (domain …))`.
    pub name: &'a str,
}

/// The part of a file's name that distinguishes it in its folder: `p01-domain.pddl` and `instance-1.pddl`
/// both have the key `1`.
pub(crate) fn key(path: &Path) -> String {
    let stem = path.file_stem().map(|s| s.to_string_lossy().to_lowercase()).unwrap_or_default();
    let mut key = String::new();
    // Letters and digits apart: `p01` is `p` and `01`.
    let class = |c: char| (c.is_alphabetic(), c.is_ascii_digit());
    let chars: Vec<char> = stem.chars().collect();
    for part in chars.chunk_by(|&a, &b| class(a) == class(b)) {
        let part: String = part.iter().collect();
        if !part.starts_with(char::is_alphanumeric) || WORDS.contains(&part.as_str()) {
            continue;
        }
        let number = part.trim_start_matches('0');
        if !key.is_empty() {
            key.push(' ');
        }
        key.push_str(if number.is_empty() { "0" } else { number });
    }
    key
}

/// The index of the domain for the problem at `path`, which requires a domain named `wanted`.
pub fn domain_for(path: &Path, wanted: Option<&str>, domains: &[Candidate<'_>]) -> Option<usize> {
    let problem_key = key(path);
    let score = |candidate: &Candidate<'_>| {
        let distance = distance(path, candidate.path)?;
        let domain_key = key(candidate.path);
        let named = wanted == Some(candidate.name);
        Some((named, domain_key == problem_key, domain_key.is_empty(), std::cmp::Reverse(distance)))
    };
    let scored = domains.iter().enumerate().filter_map(|(index, domain)| Some((score(domain)?, index)));
    // The first of equally good ones.
    scored.max_by_key(|&(score, index)| (score, std::cmp::Reverse(index))).map(|(_, index)| index)
}

/// The index of the problem for the plan at `path`, among those in its folder: the one whose stem begins the
/// plan's name (`p01-better.plan` for `p01.pddl`), else the one with its key, else the only one.
pub fn problem_for(path: &Path, problems: &[&Path]) -> Option<usize> {
    let beside = || problems.iter().enumerate().filter(|(_, p)| p.parent() == path.parent());
    let name = path.file_name().map(|n| n.to_string_lossy()).unwrap_or_default();
    let stem = |p: &Path| p.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let starts = |&(_, p): &(usize, &&Path)| {
        let rest = name.strip_prefix(&*stem(p));
        rest.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
    };
    let longest = beside().filter(starts).max_by_key(|(_, p)| stem(p).len());
    let same = longest.or_else(|| beside().find(|(_, p)| key(p) == key(path)));
    let only = || {
        let mut here = beside();
        here.next().filter(|_| here.next().is_none())
    };
    same.or_else(only).map(|(index, _)| index)
}

/// The distance of a domain from a problem: steps up from the problem's folder and down again; `None`
/// outside of the folders above and their direct subfolders for domains.
fn distance(problem: &Path, domain: &Path) -> Option<usize> {
    let (from, to) = (problem.parent()?, domain.parent()?);
    let up = from.ancestors().position(|above| to.starts_with(above))?;
    let common = from.ancestors().nth(up)?;
    let down: Vec<_> = to.strip_prefix(common).ok()?.components().collect();
    let named = |folder: &std::path::Component<'_>| {
        folder.as_os_str().to_string_lossy().to_lowercase().contains("domain")
    };
    match down.as_slice() {
        [] if up <= 2 => Some(up),
        [one] if up <= 1 && named(one) => Some(up + 1),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{Candidate, domain_for, key, problem_for};
    use std::path::Path;

    fn check(problem: &str, wanted: &str, domains: &[(&str, &str)], expected: Option<&str>) {
        let candidates: Vec<Candidate<'_>> =
            domains.iter().map(|(path, name)| Candidate { path: Path::new(path), name }).collect();
        let found = domain_for(Path::new(problem), Some(wanted), &candidates);
        assert_eq!(found.map(|index| domains[index].0), expected, "{problem}");
    }

    #[test]
    fn keys_are_what_differs() {
        for (name, expected) in [
            ("domain.pddl", ""),
            ("p01.pddl", "1"),
            ("p01-domain.pddl", "1"),
            ("domain_p01.pddl", "1"),
            ("instance-10.pddl", "10"),
            ("pfile0.hddl", "0"),
            ("probBLOCKS-4-0.pddl", "probblocks 4 0"),
            ("rover-03.pddl", "rover 3"),
        ] {
            assert_eq!(key(Path::new(name)), expected, "{name}");
        }
    }

    #[test]
    fn a_domain_for_all_or_for_each() {
        let one = [("a/domain.pddl", "x"), ("b/domain.pddl", "x")];
        check("b/p01.pddl", "x", &one, Some("b/domain.pddl"));
        check("a/instances/p01.pddl", "x", &one, Some("a/domain.pddl"));
        check("c/p01.pddl", "x", &one, None);
        let each = [
            ("a/domain_p01.pddl", "x"),
            ("a/domain_p02.pddl", "x"),
            ("b/domains/domain-1.pddl", "x"),
            ("b/domains/domain-2.pddl", "x"),
        ];
        check("a/p02.pddl", "x", &each, Some("a/domain_p02.pddl"));
        check("b/instances/instance-2.pddl", "x", &each, Some("b/domains/domain-2.pddl"));
        check("b/instances/instance-2.pddl", "misspelt", &each, Some("b/domains/domain-2.pddl"));
        let names = [("a/domain.pddl", "x"), ("a/domain-strips.pddl", "y")];
        check("a/p01.pddl", "y", &names, Some("a/domain-strips.pddl"));
        check("a/p01.pddl", "z", &names, Some("a/domain.pddl"));
    }

    #[test]
    fn a_plan_is_for_its_key_or_the_only_problem() {
        let problems = [Path::new("a/p1.pddl"), Path::new("a/p2.pddl"), Path::new("b/problem.pddl")];
        assert_eq!(problem_for(Path::new("a/plan02.plan"), &problems), Some(1));
        assert_eq!(problem_for(Path::new("a/best.plan"), &problems), None);
        assert_eq!(problem_for(Path::new("b/best.plan"), &problems), Some(2));
        assert_eq!(problem_for(Path::new("c/best.plan"), &problems), None);
    }
}
