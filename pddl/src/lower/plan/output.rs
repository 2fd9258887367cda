//! Plans inside the output of a planner.
//!
//! Problem: people store what their planner prints, and not all planners write a file with the plan alone.
//! Idea: only if a text is not a plan itself, it is searched for the marks of known planners. The steps
//! after the last mark stay at their places, and the rest becomes blanks. Invariant: the text keeps its
//! length and every step its place, so diagnostics about a step point into the file. A text without a known
//! mark is an error: its steps are never guessed.
//!
//! Known marks: `step    0: A B C` (FF, Metric-FF); lines `0.003: (a b) [4.0]` behind `;;;; Solution Found`
//! (POPF), `; Plan found with metric 5` (OPTIC), `Plan computed:` (LPG), `Found Plan:` (ENHSP); lines `a b
//! (1)` behind `Solution found!` (Fast Downward); `==> … <==` (pandaPI).

use std::ops::Range;

/// Lines that come before a plan with times or numbers before its steps.
const MARKS: &[&str] = &[";;;; Solution Found", "; Plan found with metric", "Plan computed:", "Found Plan:"];

/// The result of searching a planner's output.
struct Mask<'s> {
    text: &'s str,
    out: Vec<u8>,
}

/// The text with everything but the plan blanked; `None` if it has no mark of a known planner.
pub(crate) fn within_output(text: &str) -> Option<String> {
    let mut lines: Vec<Range<usize>> = Vec::new();
    let mut from = 0;
    for line in text.split_inclusive('\n') {
        lines.push(from..from + line.trim_end().len());
        from += line.len();
    }
    let blank = text.bytes().map(|b| if b == b'\n' || b == b'\r' { b } else { b' ' }).collect();
    let mut mask = Mask { text, out: blank };
    let found = mask.arrows(&lines) || mask.marked(&lines) || mask.counted(&lines) || mask.costed(&lines);
    // Only whole characters and blanks are written.
    if found { String::from_utf8(mask.out).ok() } else { None }
}

impl Mask<'_> {
    fn line(&self, at: &Range<usize>) -> &str {
        self.text[at.clone()].trim()
    }

    fn keep(&mut self, at: Range<usize>) {
        self.out[at.clone()].copy_from_slice(&self.text.as_bytes()[at]);
    }

    /// `==>`, lines, `<==`, and other text before or behind them.
    fn arrows(&mut self, lines: &[Range<usize>]) -> bool {
        let only = |arrow: &str| {
            let mut found = lines.iter().enumerate().filter(|(_, l)| self.line(l) == arrow).map(|(i, _)| i);
            found.next().filter(|_| found.next().is_none())
        };
        let (Some(start), Some(end)) = (only("==>"), only("<==")) else { return false };
        if start >= end {
            return false;
        }
        self.keep(lines[start].start..lines[end].end);
        true
    }

    /// Steps with times behind a mark.
    fn marked(&mut self, lines: &[Range<usize>]) -> bool {
        let is_mark = |l: &Range<usize>| MARKS.iter().any(|mark| self.line(l).starts_with(mark));
        let Some(mark) = lines.iter().rposition(is_mark) else { return false };
        let steps: Vec<Range<usize>> =
            lines[mark + 1..].iter().filter(|l| is_timed(self.line(l))).cloned().collect();
        for step in &steps {
            self.keep(step.clone());
        }
        !steps.is_empty()
    }

    /// `step    0: A B` and the lines below it.
    fn counted(&mut self, lines: &[Range<usize>]) -> bool {
        let first = |l: &Range<usize>| {
            self.line(l)
                .strip_prefix("step")
                .is_some_and(|rest| rest.starts_with(' ') && words(rest).is_some())
        };
        let Some(first) = lines.iter().rposition(first) else { return false };
        let mut steps = Vec::new();
        for line in &lines[first..] {
            let text = self.line(line);
            let Some((number, action)) = words(text.strip_prefix("step").unwrap_or(text)) else { break };
            // Both are slices of the text.
            let place = |part: &str| part.as_ptr() as usize - self.text.as_ptr() as usize;
            steps.push((place(number)..place(number) + number.len() + 1, place(action)..line.end));
        }
        for (number, action) in steps {
            // The parentheses replace the blank before the action and the line end after it.
            if action.end >= self.out.len() {
                return false;
            }
            self.out[action.start - 1] = b'(';
            self.out[action.end] = b')';
            self.keep(number);
            self.keep(action);
        }
        true
    }

    /// `a b (1)` behind `Solution found!`.
    fn costed(&mut self, lines: &[Range<usize>]) -> bool {
        let is_mark = |l: &Range<usize>| self.line(l).ends_with("Solution found!");
        let Some(mark) = lines.iter().rposition(is_mark) else { return false };
        let mut any = false;
        for line in &lines[mark + 1..] {
            let text = &self.text[line.clone()];
            let Some((action, cost)) = text.strip_suffix(')').and_then(|t| t.rsplit_once(" (")) else {
                continue;
            };
            let is_plain = |word: &str| !word.is_empty() && !word.contains(['(', ')', '[', ':', ';']);
            if line.start == 0 || cost.parse::<u64>().is_err() || !is_plain(action) {
                continue;
            }
            let end = line.start + action.len();
            self.out[line.start - 1] = b'(';
            self.keep(line.start..end);
            self.out[end + 1] = b')';
            any = true;
        }
        any
    }
}

/// `0.003: (…`
fn is_timed(line: &str) -> bool {
    let Some((time, rest)) = line.split_once(':') else { return false };
    time.trim().parse::<crate::Decimal>().is_ok() && rest.trim_start().starts_with('(')
}

/// The number and the action of `0: A B`.
fn words(line: &str) -> Option<(&str, &str)> {
    let (number, action) = line.trim().split_once(": ")?;
    let action = action.trim();
    let is_plain = !action.is_empty() && !action.contains(['(', ')', ';', ':']);
    (is_plain && number.parse::<u64>().is_ok()).then_some((number, action))
}
