//! The touchscreen: the pages that it shows, and touches.
//!
//! A page that was sent need not be on the screen, and a page that stood for a moment was not read. [`Screen::show`] is
//! done when the screen itself reports that the page has stood for as long as it takes to read.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::{Evidence, Operation, Phrase, Question};

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
    /// How long it must stand before it counts as shown.
    #[serde(skip)]
    pub dwell: Duration,
}

/// The shortest time for which a page must stand.
const SHORTEST: Duration = Duration::from_secs(2);
/// The longest: what takes longer to read is more than one page.
const LONGEST: Duration = Duration::from_secs(20);
/// Reading time of one character: about 160 words a minute, slow, for old eyes.
const PER_CHARACTER: Duration = Duration::from_millis(60);

impl Page {
    /// How long a text must stand to be read once.
    pub fn reading_time(text: &str) -> Duration {
        let characters = u32::try_from(text.chars().count()).unwrap_or(u32::MAX);
        PER_CHARACTER.saturating_mul(characters).clamp(SHORTEST, LONGEST)
    }
}

/// A screen.
pub trait Screen: Send + Sync {
    /// Puts up the page; done when it has stood for its dwell time. It then stays. Dropping the operation before that
    /// takes the page down.
    ///
    /// A screen that reports its page gives [`Evidence::Sensed`], or [`DeviceError::NotSensed`](crate::DeviceError) if
    /// it shows something else.
    fn show<'a>(&'a self, page: &'a Page) -> Operation<'a, Evidence>;

    /// Clears the screen.
    fn clear(&self) -> Operation<'_, ()>;
}

/// The touch input of a screen.
pub trait Buttons: Send + Sync {
    /// Waits until the person touches one of the question's options. Returns its id.
    fn next_touch<'a>(&'a self, question: &'a Question) -> Operation<'a, String>;

    /// Waits until this person, or one whom the device cannot tell from them, touches the button of a request, which is
    /// on every page.
    fn next_request<'a>(&'a self, request: &'a str, person: &'a str) -> Operation<'a, ()>;
}
