//! Subscriptions: every subscriber gets what concerns it, and no writer waits for a subscriber.
//!
//! Idea: a commit only puts its delta, and a reference to the new state, into the queues whose pattern it may concern
//! (`routes`). The subscriber matches on its own thread and in its own time, from the changed edge outwards
//! (`tracker`). Invariant: the matches that a subscriber holds are those of matching its patterns from scratch.
//!
//! Overflow: a full queue is emptied, and from then on keeps only the newest state until its subscriber reads it. So a
//! pattern subscriber may miss intermediate matches but never holds a wrong set of them; and a subscriber that never
//! reads keeps old states only until its queue is full, so commits do not copy around them for ever.
//!
//! Waking: a blocked `recv` is woken by a condition variable, anything else (an async task) by a callback. Both happen
//! after the commit's lock and the queue's lock are released, so the woken thread finds neither taken. The content of
//! an emptied queue is freed then, too.

mod deltas;
mod matches;
mod news;
mod queue;
mod tracker;

pub use self::deltas::{Deltas, Event};
pub use self::matches::{MatchChange, Matches};
pub use self::news::{Changed, News, Subscription};
pub use self::queue::{Committed, Delivery, Mailbox};
pub(crate) use self::queue::{Queue, Wake};
