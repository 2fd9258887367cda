//! The skills over the hardware abstraction, a file each.
//!
//! | skill | arguments | results | outcomes besides `end` |
//! |---|---|---|---|
//! | `say` | part, utterance | | claimed, unsensed, refused, failure |
//! | `show` | part, utterance | | claimed, unsensed, refused, failure |
//! | `listen` | part, question? | option | misheard, failure |
//! | `spot` | request, person? | | failure |
//! | `await-touch` | part, question? | option | failure |
//! | `await-request` | request, person? | | failure |
//! | `await-person`, `await-loss` | person? | pose; – | failure |
//! | `await-command` | command | | failure |
//! | `call-clinician` | need, urgency? | | failure |
//! | `deliver` | document | | failure |
//! | `await-fault`, `await-recovery`, `test-device` | device | | failure |
//! | `wait` | | | |
//!
//! The optional question distinguishes two askings of one part; the device gets its name only. An output ends with `end`
//! if a sensor noticed it, with `claimed` if no sensor can tell now, and with `unsensed` if a sensor noticed nothing.

mod await_command;
mod await_loss;
mod await_person;
mod await_request;
mod await_touch;
mod call_clinician;
mod deliver;
mod health;
mod listen;
mod question;
mod say;
mod show;
mod spot;
mod wait;

use crate::skill::Skills;

/// Every skill of this crate.
pub fn standard() -> Skills {
    let skills = Skills::default()
        .with(say::Say)
        .with(listen::Listen)
        .with(spot::Spot)
        .with(show::Show)
        .with(await_touch::AwaitTouch)
        .with(await_person::AwaitPerson)
        .with(await_loss::AwaitLoss)
        .with(await_command::AwaitCommand)
        .with(call_clinician::CallClinician)
        .with(deliver::Deliver)
        .with(await_request::AwaitRequest)
        .with(wait::Wait);
    health::ALL.into_iter().fold(skills, crate::skill::Skills::with)
}
