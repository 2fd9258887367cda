//! The picture at the top of the README: a real run, drawn as a terminal.
//!
//! `cargo xtask record` runs the README's first command and writes what it printed to
//! `docs/figure-8.svg`: the head, the moment in which the person is lost and what follows, and the
//! report. Drawn from a run, it cannot show what the program does not do.

use crate::cargo;
use crate::failure::Failure;
use std::fmt::Write as _;
use std::process::Command;

const ARGUMENTS: [&str; 8] =
    ["run", "--release", "--", "run", "domains/barthel", "--scenario", "figure-8", "--speed=max"];
const LINE: usize = 19;
const MARGIN: usize = 18;

/// Runs the command and draws its output.
pub(crate) fn record() -> Result<(), Failure> {
    let shown = format!("cargo {}", ARGUMENTS.join(" "));
    let output = Command::new("cargo")
        .args(ARGUMENTS)
        .current_dir(cargo::root())
        .output()
        .map_err(|error| Failure::NotStarted(shown.clone(), error))?;
    if !output.status.success() {
        return Err(Failure::Command(shown));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let mut lines = vec![format!("$ pelea run domains/barthel --scenario figure-8 --speed max")];
    lines.extend(excerpt(&text.lines().map(str::to_owned).collect::<Vec<_>>()));
    let path = cargo::root().join("docs/figure-8.svg");
    std::fs::write(&path, draw(&lines)).map_err(|error| Failure::File(path.display().to_string(), error))
}

/// The beginning, what happens around the loss of the person, and the end.
fn excerpt(lines: &[String]) -> Vec<String> {
    let lost = lines.iter().position(|line| line.contains("leaves")).unwrap_or(0);
    let parts = [0..6, lost.saturating_sub(3)..lost + 16, lines.len().saturating_sub(17)..lines.len()];
    let mut shown: Vec<String> = Vec::new();
    let mut next = 0;
    for part in parts {
        let (from, to) = (part.start.max(next), part.end.min(lines.len()));
        if from > next {
            shown.push("   …".to_owned());
        }
        shown.extend(lines.get(from..to).unwrap_or_default().iter().cloned());
        next = to.max(next);
    }
    shown
}

fn draw(lines: &[String]) -> String {
    let height = lines.len() * LINE + 2 * MARGIN;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1080 {height}\" font-family=\"monospace\" \
         font-size=\"13.5\">\n<rect width=\"1080\" height=\"{height}\" rx=\"8\" fill=\"#10151c\"/>\n"
    );
    for (i, line) in lines.iter().enumerate() {
        let y = MARGIN + (i + 1) * LINE - 6;
        let text: String = line.chars().take(126).collect();
        writeln!(
            svg,
            "<text x=\"{MARGIN}\" y=\"{y}\" fill=\"{}\" xml:space=\"preserve\">{}</text>",
            colour(line),
            escape(&text)
        )
        .expect("writing to a string does not fail");
    }
    svg.push_str("</svg>\n");
    svg
}

fn colour(line: &str) -> &'static str {
    let has = |what: &str| line.contains(what);
    match () {
        () if line.starts_with('$') => "#ffffff",
        () if has("replan") || has("no longer holds") || has("leaves") || has("reflex") => "#ff9e64",
        () if has("robot:") || has("robot says") => "#7dcfff",
        () if has("person:") || has("person says") => "#9ece6a",
        () if has("plan") => "#e0af68",
        () => "#a9b1c9",
    }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::{draw, excerpt};

    #[test]
    fn an_excerpt_keeps_the_loss_and_the_end() {
        let lines: Vec<_> =
            (0..100).map(|i| if i == 50 { "the person leaves".to_owned() } else { i.to_string() }).collect();
        let shown = excerpt(&lines);
        assert!(shown.iter().any(|line| line.contains("leaves")));
        assert_eq!(shown.last().map(String::as_str), Some("99"));
        assert_eq!(shown.iter().filter(|line| line.contains('…')).count(), 2);
    }

    #[test]
    fn markup_is_escaped() {
        assert!(draw(&["a < b".to_owned()]).contains("a &lt; b"));
    }
}
