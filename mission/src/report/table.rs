//! The report as a table of text, in its own language.

use std::fmt;

use super::{ItemReport, Report, Status};

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let labels = &self.labels;
        let answer = |item: &ItemReport| match item.status {
            Status::Answered => item.answer.clone().unwrap_or_default(),
            Status::Unanswered => format!("— {}", labels.unanswered),
            Status::NotPerceived => format!("— {}", labels.not_perceived),
            Status::Interrupted => format!("— {}", labels.interrupted),
            Status::NotReached => format!("— {}", labels.not_reached),
        };
        let points = |item: &ItemReport| match item.score {
            Some(score) => format!("{score}/{}", item.maximum),
            None => format!("–/{}", item.maximum),
        };
        let mut rows = vec![[labels.item.clone(), labels.score.clone(), labels.answer.clone()]];
        rows.extend(self.items.iter().map(|i| [i.name.clone(), points(i), answer(i)]));
        let total = format!("{}/{}", self.total, self.maximum);
        rows.push([labels.total.clone(), total, String::new()]);

        let width = |column: usize| rows.iter().map(|r| r[column].chars().count()).max().unwrap_or(0);
        let (name, score) = (width(0), width(1));
        let rule = "─".repeat(name + 2 + score + 2 + width(2));
        writeln!(f, "{}", labels.heading)?;
        for (i, row) in rows.iter().enumerate() {
            if i == 1 || i + 1 == rows.len() {
                writeln!(f, "{rule}")?;
            }
            let line = format!("{:<name$}  {:>score$}  {}", row[0], row[1], row[2]);
            writeln!(f, "{}", line.trim_end())?;
        }
        writeln!(f, "{}", if self.complete { &labels.complete } else { &labels.incomplete })
    }
}
