//! Did you mean: the known name nearest to a mistyped one.
//!
//! Source: Damerau, "A technique for computer detection and correction of spelling errors", CACM 1964.

/// The known name nearest to a mistyped one, as advice; `None` if none is near.
pub fn did_you_mean<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    known
        .into_iter()
        .map(|name| (edit_distance(wrong, name), name))
        .filter(|&(distance, name)| distance <= 1 + name.chars().count() / 4)
        .min()
        .map(|(_, name)| format!("did you mean `{name}`?"))
}

/// How many letters to insert, delete, replace or swap with a neighbour; O(|a||b|) time, O(|b|) space.
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let replaced = above[j] + usize::from(a[i] != b[j]);
            let mut least = replaced.min(above[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                let swapped: usize = before[j - 1];
                least = least.min(swapped + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::{did_you_mean, edit_distance};

    #[test]
    fn near_names_are_found() {
        assert_eq!(edit_distance("aks", "ask"), 1);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(did_you_mean("aks", ["ask", "axe"]), Some("did you mean `ask`?".to_owned()));
        assert_eq!(did_you_mean("kitchen", ["lift", "ramp"]), None);
    }
}
