//! The touchscreen: the pages that it shows, its own reports of them, and touches.
//!
//! A page that was sent need not be on the screen. [`Screen::next_shown`] is the screen's own report, independent of the
//! result of [`Screen::show`].

use serde::{Deserialize, Serialize};

use crate::{Operation, Phrase, Question};

/// The identity of a page. The screen does not interpret it, and reports it back.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct PageId {
    /// Its topic.
    pub topic: String,
    /// Its name among the pages about the topic.
    pub name: String,
}

/// A page on the screen.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Page {
    /// Its identity.
    pub id: PageId,
    /// The heading; may be empty.
    pub title: String,
    /// The text.
    pub text: String,
    /// The options that the person can touch.
    pub options: Vec<Phrase>,
}

/// A screen.
pub trait Screen: Send + Sync {
    /// Replaces the page; done when the screen has accepted the new one.
    fn show<'a>(&'a self, page: &'a Page) -> Operation<'a, ()>;

    /// Clears the screen.
    fn clear(&self) -> Operation<'_, ()>;

    /// The next page that the screen reports to show. Reports are queued, so that none is lost between two calls. Only
    /// one caller may wait at a time.
    fn next_shown(&self) -> Operation<'_, PageId>;
}

/// The touch input of a screen.
pub trait Buttons: Send + Sync {
    /// Waits until the person touches one of the question's options. Returns its id.
    fn next_touch<'a>(&'a self, question: &'a Question) -> Operation<'a, String>;
}
