//! Names. PDDL is case-insensitive, so a name is stored in lower case and compares as bytes.
//!
//! A name of up to 23 bytes, which nearly all are, is stored inline. A comparison then follows no pointer,
//! and comparisons dominate the time to read a long problem.

use std::borrow::Borrow;
use std::fmt;

use smol_str::SmolStr;

/// A lower-case name, cheap to clone.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize)]
#[serde(transparent)]
pub struct Name(#[serde(serialize_with = "as_str")] SmolStr);

fn as_str<S: serde::Serializer>(name: &SmolStr, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(name)
}

impl Name {
    /// The name in lower case.
    pub fn new(text: &str) -> Self {
        if text.bytes().any(|b| b.is_ascii_uppercase()) {
            Self(SmolStr::from(text.to_ascii_lowercase()))
        } else {
            Self(SmolStr::new(text))
        }
    }

    /// As text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl Borrow<str> for Name {
    fn borrow(&self) -> &str {
        &self.0
    }
}

impl std::ops::Deref for Name {
    type Target = str;
    fn deref(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Debug for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
