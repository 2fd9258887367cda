//! Did you mean: the known name nearest to an unknown one.
//!
//! Distance: the number of insertions, deletions, substitutions and swaps of neighbours; case is ignored. A
//! candidate counts if at most a third of the longer name differs. The first of equally near candidates
//! wins, so the result depends on the order of declaration only.
//!
//! Source: Damerau, "A technique for computer detection and correction of spelling errors", CACM 1964.

use strsim::osa_distance;

/// The candidate nearest to `name`, if one is near enough.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let name = name.to_lowercase();
    let length = name.chars().count();
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let other = candidate.to_lowercase();
        let other_length = other.chars().count();
        let longer = length.max(other_length);
        let allowed = (longer / 3).max(1);
        let bound = best.map_or(allowed, |(d, _)| allowed.min(d.saturating_sub(1)));
        if length.abs_diff(other_length) > bound {
            continue;
        }
        let distance = osa_distance(&name, &other);
        if distance <= bound && best.is_none_or(|(least, _)| distance < least) && distance < longer {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate.to_owned())
}

/// The same as advice: "did you mean `NAME`?"
pub fn did_you_mean<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(wrong, known).map(|name| format!("did you mean `{name}`?"))
}

#[cfg(test)]
mod tests {
    use super::{did_you_mean, nearest};

    #[test]
    fn the_nearest_name_wins_and_far_ones_are_silent() {
        assert_eq!(nearest("looking-ta", ["speaking", "looking-at"]), Some("looking-at".into()));
        assert_eq!(nearest("at", ["in", "on"]), None);
        assert_eq!(nearest("truk", ["trunk", "truck"]), Some("trunk".into()));
        assert_eq!(nearest("", ["a"]), None);
        assert_eq!(did_you_mean("aks", ["ask", "axe"]), Some("did you mean `ask`?".to_owned()));
        assert_eq!(did_you_mean("kitchen", ["lift", "ramp"]), None);
    }
}
