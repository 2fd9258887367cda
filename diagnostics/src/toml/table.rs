//! One table of a TOML file, read key by key.

use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue};

use super::reader::span;
use super::{Reader, Text};
use crate::{Finding, Span, did_you_mean};

/// An entry and whether it was requested.
struct Entry<'d> {
    key: &'d str,
    key_span: Span,
    value: &'d Spanned<DeValue<'d>>,
    read: bool,
}

/// A table with its dotted path, in the order of the file.
pub struct Table<'d> {
    path: String,
    /// Its place: its key, or its braces.
    pub span: Span,
    entries: Vec<Entry<'d>>,
    asked: Vec<String>,
}

impl<'d> Table<'d> {
    pub(crate) fn new(path: impl Into<String>, at: Span, table: &'d DeTable<'d>) -> Self {
        let mut entries: Vec<Entry<'d>> = table
            .iter()
            .map(|(key, value)| Entry { key: key.get_ref(), key_span: span(key.span()), value, read: false })
            .collect();
        entries.sort_by_key(|e| e.key_span);
        Self { path: path.into(), span: at, entries, asked: Vec::new() }
    }

    fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    fn take(&mut self, key: &str) -> Option<&'d Spanned<DeValue<'d>>> {
        self.asked.push(key.to_owned());
        let entry = self.entries.iter_mut().find(|e| e.key == key)?;
        entry.read = true;
        Some(entry.value)
    }

    /// The place of a key; the table's place if the key is missing.
    pub fn key_span(&self, key: &str) -> Span {
        self.entries.iter().find(|e| e.key == key).map_or(self.span, |e| e.key_span)
    }

    /// The keys that were not requested yet, with their places.
    pub fn rest(&self) -> Vec<(String, Span)> {
        self.entries.iter().filter(|e| !e.read).map(|e| (e.key.to_owned(), e.key_span)).collect()
    }

    /// Whether the key exists; does not count as a request.
    pub fn has(&self, key: &str) -> bool {
        self.entries.iter().any(|e| e.key == key)
    }

    /// Counts a key as requested, whatever its value is: what it means is not known after another mistake.
    pub fn ignore(&mut self, key: &str) {
        let _ = self.take(key);
    }

    /// A string.
    pub fn text(&mut self, reader: &mut Reader<'_>, key: &str) -> Option<Text> {
        let value = self.take(key)?;
        text_of(reader, value, &self.path_of(key))
    }

    /// A required string.
    pub fn required_text(&mut self, reader: &mut Reader<'_>, key: &str) -> Option<Text> {
        self.require(reader, key);
        self.text(reader, key)
    }

    /// Reports the key if it is missing.
    pub fn require(&self, reader: &mut Reader<'_>, key: &str) {
        if !self.has(key) {
            reader.error("E0704", self.span, format!("the key `{}` is missing", self.path_of(key)));
        }
    }

    /// A list of strings.
    pub fn texts(&mut self, reader: &mut Reader<'_>, key: &str) -> Option<Vec<Text>> {
        let value = self.take(key)?;
        let path = self.path_of(key);
        let Some(array) = value.get_ref().as_array() else {
            reader.wrong_kind(value, &path, "a list of strings");
            return None;
        };
        Some(array.iter().filter_map(|v| text_of(reader, v, &path)).collect())
    }

    /// A string, or a list of strings; empty if the key is missing.
    pub fn one_or_more(&mut self, reader: &mut Reader<'_>, key: &str) -> Vec<Text> {
        let is_text = |e: &Entry<'_>| e.key == key && e.value.get_ref().as_str().is_some();
        if self.entries.iter().any(is_text) {
            return self.text(reader, key).into_iter().collect();
        }
        self.texts(reader, key).unwrap_or_default()
    }

    /// A number, with its place.
    pub fn number(&mut self, reader: &mut Reader<'_>, key: &str) -> Option<(f64, Span)> {
        let value = self.take(key)?;
        let number = match value.get_ref() {
            DeValue::Integer(i) => i.as_str().parse::<f64>().ok(),
            DeValue::Float(f) => f.as_str().parse().ok(),
            _ => None,
        };
        let number = number.filter(|n| n.is_finite());
        if number.is_none() {
            reader.wrong_kind(value, &self.path_of(key), "a number");
        }
        Some((number?, span(value.span())))
    }

    /// A boolean.
    pub fn boolean(&mut self, reader: &mut Reader<'_>, key: &str) -> Option<bool> {
        let value = self.take(key)?;
        let boolean = value.get_ref().as_bool();
        if boolean.is_none() {
            reader.wrong_kind(value, &self.path_of(key), "true or false");
        }
        boolean
    }

    /// A whole number from `least` to `u32::MAX`, with its place.
    pub fn count(&mut self, reader: &mut Reader<'_>, key: &str, least: u32) -> Option<(u32, Span)> {
        let value = self.take(key)?;
        let at = span(value.span());
        let Some(integer) = value.get_ref().as_integer() else {
            reader.wrong_kind(value, &self.path_of(key), "a whole number");
            return None;
        };
        let number = u32::from_str_radix(integer.as_str(), integer.radix()).ok().filter(|&n| n >= least);
        if number.is_none() {
            let path = self.path_of(key);
            reader.error("E0705", at, format!("`{path}` should be a whole number of at least {least}"));
        }
        number.map(|n| (n, at))
    }

    /// A number of seconds, not negative.
    pub fn seconds(&mut self, reader: &mut Reader<'_>, key: &str) -> Option<std::time::Duration> {
        let value = self.take(key)?;
        let path = self.path_of(key);
        let number: Option<f64> = match value.get_ref() {
            DeValue::Integer(i) => i.as_str().parse().ok(),
            DeValue::Float(f) => f.as_str().parse().ok(),
            _ => {
                reader.wrong_kind(value, &path, "a number of seconds");
                return None;
            }
        };
        let duration = number.and_then(|s| std::time::Duration::try_from_secs_f64(s).ok());
        if duration.is_none() {
            reader.error(
                "E0705",
                span(value.span()),
                format!("`{path}` should be a number of seconds, not negative"),
            );
        }
        duration
    }

    /// A table.
    pub fn table(&mut self, reader: &mut Reader<'_>, key: &str) -> Option<Table<'d>> {
        let at = self.key_span(key);
        let value = self.take(key)?;
        let path = self.path_of(key);
        match value.get_ref().as_table() {
            Some(table) => Some(Table::new(path, at, table)),
            None => {
                reader.wrong_kind(value, &path, "a table");
                None
            }
        }
    }

    /// A list of tables, `[[key]]` or inline; empty if the key is missing.
    pub fn tables(&mut self, reader: &mut Reader<'_>, key: &str) -> Vec<Table<'d>> {
        let Some(value) = self.take(key) else { return Vec::new() };
        let path = self.path_of(key);
        let Some(array) = value.get_ref().as_array() else {
            reader.wrong_kind(value, &path, "a list of tables");
            return Vec::new();
        };
        let mut tables = Vec::new();
        for element in array.iter() {
            match element.get_ref().as_table() {
                Some(table) => tables.push(Table::new(path.clone(), span(element.span()), table)),
                None => reader.wrong_kind(element, &path, "a table"),
            }
        }
        tables
    }

    /// Reports every key that was not requested.
    pub fn finish(self, reader: &mut Reader<'_>) {
        for entry in self.entries.iter().filter(|e| !e.read) {
            let path = self.path_of(entry.key);
            let help = did_you_mean(entry.key, self.asked.iter().map(String::as_str));
            let place = reader.place(entry.key_span);
            let finding = Finding::error("E0702", place, format!("unknown key `{path}`")).help_if(help);
            reader.findings.push(finding);
        }
    }
}

fn text_of(reader: &mut Reader<'_>, value: &Spanned<DeValue<'_>>, path: &str) -> Option<Text> {
    let at = span(value.span());
    match value.get_ref().as_str() {
        Some(text) => Some(Text::new(text, at, reader.text)),
        None => {
            reader.wrong_kind(value, path, "a string");
            None
        }
    }
}
