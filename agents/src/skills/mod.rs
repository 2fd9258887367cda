//! The skills over the hardware abstraction, a file each; docs/rules.md has their table, which a test holds against
//! [`standard`].
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
