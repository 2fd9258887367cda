//! Did you mean: the known name nearest to an unknown one.
//!
//! Distance: insertions, deletions, substitutions and swaps of neighbours, case ignored. A candidate
//! counts if at most a third of the longer name differs. The first of equally near ones wins, so the
//! answer depends on the order of declaration only.
//!
//! Source: Damerau, "A technique for computer detection and correction of spelling errors", CACM 1964.

/// The nearest of `candidates`, if one is near enough.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let name: Vec<char> = name.to_lowercase().chars().collect();
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let other: Vec<char> = candidate.to_lowercase().chars().collect();
        let allowed = (name.len().max(other.len()) / 3).max(1);
        let bound = best.map_or(allowed, |(d, _)| allowed.min(d.saturating_sub(1)));
        if name.len().abs_diff(other.len()) > bound {
            continue;
        }
        let d = distance(&name, &other);
        if d <= bound && best.is_none_or(|(b, _)| d < b) && d < name.len().max(other.len()) {
            best = Some((d, candidate));
        }
    }
    best.map(|(_, c)| c.to_owned())
}

fn distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for (i, &x) in a.iter().enumerate() {
        let mut row = Vec::with_capacity(b.len() + 1);
        row.push(i + 1);
        for (j, &y) in b.iter().enumerate() {
            let mut d = (last[j + 1] + 1).min(row[j] + 1).min(last[j] + usize::from(x != y));
            if i > 0 && j > 0 && x == b[j - 1] && a[i - 1] == y {
                d = d.min(before[j - 1] + 1);
            }
            row.push(d);
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn the_nearest_name_wins_and_far_ones_are_silent() {
        assert_eq!(nearest("looking-ta", ["speaking", "looking-at"]), Some("looking-at".into()));
        assert_eq!(nearest("at", ["in", "on"]), None);
        assert_eq!(nearest("truk", ["trunk", "truck"]), Some("trunk".into()));
        assert_eq!(nearest("", ["a"]), None);
    }
}
