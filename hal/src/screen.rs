//! The touchscreen: what it shows, what it reports to be showing, what is touched.
//!
//! That a page was sent is not that it stands on the screen: [`Screen::next_shown`] is the screen's own
//! report, independent of what [`Screen::show`] claims.

use serde::{Deserialize, Serialize};

use crate::{Operation, Phrase, Question};

/// Identifies a page. Means nothing to the screen, which reports it back.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct PageId {
    /// What it is about.
    pub topic: String,
    /// Which of the pages about it.
    pub name: String,
}

/// What a screen shows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Page {
    /// Its identity.
    pub id: PageId,
    /// The heading; may be empty.
    pub title: String,
    /// The text.
    pub text: String,
    /// What may be touched.
    pub options: Vec<Phrase>,
}

/// A screen.
pub trait Screen: Send + Sync {
    /// Replaces what is shown; done when the screen has taken it.
    fn show<'a>(&'a self, page: &'a Page) -> Operation<'a, ()>;

    /// Shows nothing.
    fn clear(&self) -> Operation<'_, ()>;

    /// The next page that the screen reports as standing there. Reports wait for their reader, so that none
    /// is lost between two calls; one reader at a time.
    fn next_shown(&self) -> Operation<'_, PageId>;
}

/// What is touched.
pub trait Buttons: Send + Sync {
    /// Waits until one of the question's options is touched; its id.
    fn next_touch<'a>(&'a self, question: &'a Question) -> Operation<'a, String>;
}
