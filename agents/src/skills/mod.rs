//! The skills over the hardware abstraction, a file each.
//!
//! | skill | arguments | results | outcomes besides `end` |
//! |---|---|---|---|
//! | `say` | part, utterance | | failure |
//! | `listen` | part, question? | option | misheard, failure |
//! | `spot` | request | | failure |
//! | `show` | part, utterance | | failure |
//! | `watch-page` | | utterance, part | failure |
//! | `await-touch` | part, question? | option | failure |
//! | `await-person`, `await-loss` | person? | pose; – | failure |
//! | `await-command` | command | | failure |
//! | `call-clinician` | need | | failure |
//! | `deliver` | document | | failure |
//!
//! The optional question distinguishes two askings of one part; the device gets its name only.

mod await_command;
mod await_loss;
mod await_person;
mod await_touch;
mod call_clinician;
mod deliver;
mod listen;
mod question;
mod say;
mod show;
mod spot;
mod watch_page;

use crate::skill::Skills;

/// Every skill of this crate.
pub fn standard() -> Skills {
    Skills::default()
        .with(say::Say)
        .with(listen::Listen)
        .with(spot::Spot)
        .with(show::Show)
        .with(watch_page::WatchPage)
        .with(await_touch::AwaitTouch)
        .with(await_person::AwaitPerson)
        .with(await_loss::AwaitLoss)
        .with(await_command::AwaitCommand)
        .with(call_clinician::CallClinician)
        .with(deliver::Deliver)
}
