//! The results as JUnit XML, for continuous integration: a suite per disruption, a case per instant and seed.

use super::instants::Instant;
use super::library::Disturbance;
use super::record::Run;
use std::fmt::Write as _;

/// The document.
pub(super) fn write(mission: &str, library: &[Disturbance], instants: &[Instant], runs: &[Run]) -> String {
    let failures = runs.iter().filter(|run| !run.is_good()).count();
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let name = escaped(mission);
    let _ = writeln!(xml, "<testsuites name=\"{name}\" tests=\"{}\" failures=\"{failures}\">", runs.len());
    for disturbance in library {
        let own: Vec<&Run> = runs.iter().filter(|run| run.key.disruption == disturbance.name).collect();
        if own.is_empty() {
            continue;
        }
        let failures = own.iter().filter(|run| !run.is_good()).count();
        let name = escaped(&disturbance.name);
        let _ =
            writeln!(xml, "  <testsuite name=\"{name}\" tests=\"{}\" failures=\"{failures}\">", own.len());
        own.into_iter().for_each(|run| case(run, &instants[run.key.instant], &name, &mut xml));
        xml.push_str("  </testsuite>\n");
    }
    xml.push_str("</testsuites>\n");
    xml
}

fn case(run: &Run, instant: &Instant, suite: &str, xml: &mut String) {
    let name = format!("{instant}, seed {}", run.key.seed);
    let _ = write!(xml, "    <testcase classname=\"{suite}\" name=\"{name}\" time=\"{:.1}\"", run.seconds);
    if run.is_good() {
        xml.push_str("/>\n");
        return;
    }
    let mut why: Vec<String> = run.broken.iter().map(|broken| broken.text.clone()).collect();
    if !run.outcome.is_accounted_for() {
        why.insert(0, format!("the run ended: {}", run.outcome.name()));
    }
    let message = escaped(&why.join("; "));
    let _ = writeln!(xml, ">\n      <failure message=\"{message}\"/>\n    </testcase>");
}

/// Text between quotes in XML, without the characters that XML cannot have.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' => escaped.push_str("&#10;"),
            c if c.is_control() => {}
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn quotes_and_controls_are_escaped() {
        assert_eq!(escaped("a<\"b\"> & \u{1}c\n"), "a&lt;&quot;b&quot;&gt; &amp; c&#10;");
    }
}
