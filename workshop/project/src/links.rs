//! Which file needs which.
//!
//! A problem needs the file that defines its domain, a domain those of its imports, a plan its problem. If
//! several files define a domain, the nearest one counts: one in the same folder before others, then one
//! with the same stem (`p01-domain.pddl` for `p01.pddl`), then the one whose folder shares the longest path,
//! then the first. For a problem, `pairs` decides first. If no domain near the problem has the required
//! name, the only domain beside it (or the one with its key) comes before a domain of that name far away. A
//! plan belongs to a problem of its folder, or of the parent folder if its own has none.
//!
//! Invariant: links have no cycle. In a cycle of imports the link that closes it is left out, and the reader
//! then reports an unknown domain.

use rustc_hash::FxHashMap;

use crate::pairs::{self, Candidate};
use crate::{FileKind, Header};
use diagnostics::SourceId;
use std::path::Path;

/// A file with its path and header.
pub(crate) type Entry<'a> = (SourceId, &'a str, &'a Header);

/// For each file the provider of each of its needs. A plan has one need, its problem; a problem has one, its
/// domain.
pub(crate) fn links(entries: &[Entry<'_>]) -> FxHashMap<SourceId, Vec<Option<SourceId>>> {
    let mut domains: FxHashMap<&str, Vec<usize>> = FxHashMap::default();
    let mut folders: FxHashMap<&str, Vec<usize>> = FxHashMap::default();
    for (i, (_, path, header)) in entries.iter().enumerate() {
        folders.entry(folder(path)).or_default().push(i);
        if header.kind == FileKind::Domain && !header.name.is_empty() {
            domains.entry(&header.name).or_default().push(i);
        }
    }
    let provider = |from: usize, name: &str| {
        let candidates = domains.get(name).map_or(&[][..], Vec::as_slice);
        candidates
            .iter()
            .copied()
            .filter(|&i| i != from)
            .min_by_key(|&i| distance(entries[from].1, entries[i].1, i))
    };
    let of_kind = |folder: &str, kind: FileKind| -> Vec<usize> {
        let all = folders.get(folder).map_or(&[][..], Vec::as_slice);
        all.iter().copied().filter(|&i| entries[i].2.kind == kind).collect()
    };
    let mut found: Vec<Vec<Option<usize>>> = Vec::with_capacity(entries.len());
    for (i, (_, path, header)) in entries.iter().enumerate() {
        found.push(match header.kind {
            FileKind::Domain => header.needs.iter().map(|need| provider(i, &need.name)).collect(),
            FileKind::Problem => {
                let wanted = header.needs.first().map(|need| need.name.as_str());
                let named = wanted.and_then(|name| domains.get(name)).map_or(&[][..], Vec::as_slice);
                let near = near_domain(path, wanted, named, entries);
                let beside = || {
                    let here = of_kind(folder(path), FileKind::Domain);
                    only(&here).or_else(|| {
                        let key = |i: &usize| pairs::key(place(entries[*i].1));
                        let own = pairs::key(place(path));
                        here.iter().copied().find(|i| !own.is_empty() && key(i) == own)
                    })
                };
                vec![near.or_else(beside).or_else(|| provider(i, wanted?))]
            }
            FileKind::Plan => {
                let here = of_kind(folder(path), FileKind::Problem);
                let above = if here.is_empty() { folder(folder(path)) } else { folder(path) };
                let problems = of_kind(above, FileKind::Problem);
                let paths: Vec<&Path> = problems.iter().map(|&i| place(entries[i].1)).collect();
                let asked = Path::new(above).join(file_name(path));
                vec![pairs::problem_for(&asked, &paths).map(|at| problems[at])]
            }
        });
    }
    cut_cycles(&mut found);
    let id = |link: Option<usize>| link.map(|i| entries[i].0);
    let ids = found.into_iter().map(|links| links.into_iter().map(id).collect());
    entries.iter().map(|entry| entry.0).zip(ids).collect()
}

fn only(candidates: &[usize]) -> Option<usize> {
    if let [one] = candidates { Some(*one) } else { None }
}

/// The domain near the problem that has the required name.
fn near_domain(path: &str, wanted: Option<&str>, named: &[usize], entries: &[Entry<'_>]) -> Option<usize> {
    let candidates: Vec<Candidate<'_>> =
        named.iter().map(|&i| Candidate { path: place(entries[i].1), name: &entries[i].2.name }).collect();
    pairs::domain_for(place(path), wanted, &candidates).map(|at| named[at])
}

/// Smaller is nearer.
fn distance(from: &str, to: &str, order: usize) -> (bool, bool, std::cmp::Reverse<usize>, usize) {
    let shared = folder(from).split('/').zip(folder(to).split('/')).take_while(|(a, b)| a == b).count();
    (folder(from) != folder(to), !stem(to).contains(stem(from)), std::cmp::Reverse(shared), order)
}

/// `./a` is `a`.
fn place(path: &str) -> &Path {
    Path::new(path.trim_start_matches("./"))
}

fn folder(path: &str) -> &str {
    path.trim_start_matches("./").rsplit_once('/').map_or("", |(folder, _)| folder)
}

fn file_name(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

fn stem(path: &str) -> &str {
    let name = file_name(path);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// Removes each link that leads back to a file on the current path. Iterative: chains of imports can be
/// long.
fn cut_cycles(links: &mut [Vec<Option<usize>>]) {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        OnWay,
        Done,
    }
    let mut states = vec![State::New; links.len()];
    for start in 0..links.len() {
        if states[start] != State::New {
            continue;
        }
        states[start] = State::OnWay;
        // Each file on the path with the position of its next link to follow.
        let mut way = vec![(start, 0)];
        while let Some((at, next)) = way.last_mut() {
            let (at, position) = (*at, *next);
            *next += 1;
            match links[at].get(position).copied() {
                None => {
                    states[at] = State::Done;
                    way.pop();
                }
                Some(Some(to)) if states[to] == State::OnWay => links[at][position] = None,
                Some(Some(to)) if states[to] == State::New => {
                    states[to] = State::OnWay;
                    way.push((to, 0));
                }
                Some(_) => {}
            }
        }
    }
}
