//! A failing run, as small as it still fails: a scenario file for `pelea run`.
//!
//! Idea: the scenario is a table; drop a part of it, play again, and keep what still fails in the same way. Parts are
//! disruptions, replies, delays and whole tables. Source: Zeller & Hildebrandt, "Simplifying and isolating
//! failure-inducing input", TSE 2002, with single parts only: a scenario has few.

use toml::{Table, Value};

/// The smallest table that `fails` and that comes from this one by dropping parts; at most so many are tried.
pub(super) fn minimise(scenario: Table, tries: usize, mut fails: impl FnMut(&Table) -> bool) -> Table {
    let mut smallest = scenario;
    let mut left = tries;
    'again: loop {
        for smaller in smaller(&smallest) {
            if left == 0 {
                break 'again;
            }
            left -= 1;
            if fails(&smaller) {
                smallest = smaller;
                continue 'again;
            }
        }
        break;
    }
    smallest
}

/// The tables with one part less, larger parts first.
fn smaller(table: &Table) -> Vec<Table> {
    let mut found = Vec::new();
    for key in ["patient", "clinician"] {
        if table.contains_key(key) {
            let mut without = table.clone();
            without.remove(key);
            found.push(without);
        }
    }
    for (key, inner) in [("disruption", None), ("patient", Some("reply"))] {
        let list = table.get(key).and_then(|value| match inner {
            None => value.as_array(),
            Some(inner) => value.get(inner)?.as_array(),
        });
        for at in 0..list.map_or(0, Vec::len) {
            let mut without = table.clone();
            let value = without.get_mut(key).expect("it was there");
            let list = match inner {
                None => value.as_array_mut(),
                Some(inner) => value.get_mut(inner).and_then(Value::as_array_mut),
            };
            list.expect("it was a list").remove(at);
            found.push(without);
        }
    }
    let disruptions = table.get("disruption").and_then(Value::as_array).map_or(0, Vec::len);
    for at in 0..disruptions {
        for key in ["after", "for"] {
            let mut without = table.clone();
            let disruption = without.get_mut("disruption").and_then(|list| list.get_mut(at));
            if disruption.and_then(Value::as_table_mut).and_then(|table| table.remove(key)).is_some() {
                found.push(without);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::minimise;
    use toml::Table;

    #[test]
    fn what_does_not_matter_is_dropped() {
        let text = "title = \"x\"\n[clinician]\ncomes-after = 1\n[patient]\nin-view = true\n\
                    [[patient.reply]]\nitem = \"a\"\n\
                    [[disruption]]\nversion = 3\ndo = \"pause\"\n\
                    [[disruption]]\nversion = 4\nafter = 2\ndo = \"fail\"\n";
        let table: Table = text.parse().expect("it is TOML");
        let fails = |table: &Table| table.to_string().contains("fail");
        let smallest = minimise(table, 100, fails);
        assert_eq!(smallest.to_string(), "title = \"x\"\n\n[[disruption]]\ndo = \"fail\"\nversion = 4\n");
    }
}
