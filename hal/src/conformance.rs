//! The suite that every back end must pass.
//!
//! A [`Rig`] is a back end together with a player of the person and the clinician. On real hardware the player is a test
//! bench or a patient engineer. Each [`Case`] is independent of the others and leaves the rig as it found it. The test of
//! a back end is a loop over [`CASES`], each on a fresh rig.
//!
//! ```
//! # async fn check() {
//! use hal::conformance::CASES;
//! use hal::sim::{ClinicianScript, PatientScript, SimRoom};
//! for case in CASES {
//!     let room = SimRoom::new(PatientScript::default(), ClinicianScript::default());
//!     case.run(&room).await.unwrap();
//! }
//! # }
//! ```

use std::future::Future;
use std::pin::Pin;
use std::time::Duration;

use crate::{Device, DeviceError, Devices, Heard, Operation, Page, PageId, Phrase, Question, Urgency};

/// A back end under test.
pub trait Rig: Send + Sync {
    /// Its devices.
    fn devices(&self) -> Devices;

    /// How long the suite waits for an operation that should end.
    fn patience(&self) -> Duration;

    /// Makes something happen around the robot.
    fn stimulate(&self, stimulus: Stimulus<'_>);
}

/// An event around the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the variants say it")]
pub enum Stimulus<'a> {
    PersonWillSay { topic: &'a str, option: usize },
    PersonWillMumble { topic: &'a str },
    PersonWillTouch { topic: &'a str, option: usize },
    PersonAsks(&'a str),
    PersonTouchesRequest(&'a str),
    PersonLeaves,
    PersonReturns,
    ClinicianCommands(&'a str),
    ClinicianComes,
    Unplug(Device),
    PlugIn(Device),
}

/// A mistake of a back end.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Violation {
    /// An operation did not end.
    #[error("{operation} did not end within {after:?}")]
    Stuck {
        /// Which.
        operation: &'static str,
        /// How long the suite waited.
        after: Duration,
    },
    /// An operation ended that should have waited.
    #[error("{operation} ended before its cause")]
    Hasty {
        /// Which.
        operation: &'static str,
    },
    /// A working device failed.
    #[error("{operation}: {error}")]
    Failed {
        /// Which.
        operation: &'static str,
        /// How.
        error: DeviceError,
    },
    /// An unplugged device claimed success.
    #[error("{operation} succeeded on an unplugged device")]
    NotFailed {
        /// Which.
        operation: &'static str,
    },
    /// The wrong result.
    #[error("{operation} gave {found}, expected {expected}")]
    Wrong {
        /// Which.
        operation: &'static str,
        /// The result.
        found: String,
        /// The expected result.
        expected: String,
    },
}

type Verdict<'a> = Pin<Box<dyn Future<Output = Result<(), Violation>> + Send + 'a>>;

/// One requirement on every back end.
#[derive(Clone, Copy)]
pub struct Case {
    /// Its name.
    pub name: &'static str,
    run: for<'a> fn(&'a dyn Rig) -> Verdict<'a>,
}

impl Case {
    /// Runs it. The person must be in view, and no operation may be under way.
    pub async fn run(&self, rig: &dyn Rig) -> Result<(), Violation> {
        (self.run)(rig).await
    }
}

macro_rules! cases {
    ($($name:ident)*) => {
        /// Every case.
        pub const CASES: &[Case] = &[$(Case { name: stringify!($name), run: |rig| Box::pin($name(rig)) }),*];
    };
}

cases! {
    a_sentence_ends
    a_dropped_sentence_makes_room_for_the_next
    a_page_stands_before_it_counts_as_shown
    a_spoken_answer_is_recognised
    an_unknown_answer_is_not_understood
    a_touch_is_reported
    a_request_is_spotted
    a_request_from_out_of_view_is_spotted
    a_request_is_touched
    a_person_in_view_is_seen
    a_loss_is_reported_after_it
    a_command_is_taken_once
    a_call_is_attended
    a_report_is_acknowledged
    an_unplugged_device_fails_and_recovers
    unplugging_fails_operations_under_way
    a_fault_is_noticed_and_a_recovery
    a_working_device_passes_its_test
}

async fn ends<T>(rig: &dyn Rig, operation: &'static str, work: Operation<'_, T>) -> Result<T, Violation> {
    match tokio::time::timeout(rig.patience(), work).await {
        Ok(result) => result.map_err(|error| Violation::Failed { operation, error }),
        Err(_) => Err(Violation::Stuck { operation, after: rig.patience() }),
    }
}

async fn fails<T>(rig: &dyn Rig, operation: &'static str, work: Operation<'_, T>) -> Result<(), Violation> {
    match ends(rig, operation, work).await {
        Err(Violation::Failed { .. }) => Ok(()),
        Err(other) => Err(other),
        Ok(_) => Err(Violation::NotFailed { operation }),
    }
}

/// Checks that the operation does not end within a tenth of the rig's patience.
async fn waits<T>(
    rig: &dyn Rig,
    operation: &'static str,
    work: &mut Operation<'_, T>,
) -> Result<(), Violation> {
    match tokio::time::timeout(rig.patience() / 10, work).await {
        Ok(_) => Err(Violation::Hasty { operation }),
        Err(_) => Ok(()),
    }
}

fn equal<T: PartialEq + std::fmt::Debug>(
    operation: &'static str,
    found: &T,
    expected: &T,
) -> Result<(), Violation> {
    if found == expected {
        return Ok(());
    }
    Err(Violation::Wrong { operation, found: format!("{found:?}"), expected: format!("{expected:?}") })
}

fn question() -> Question {
    let phrase = |id: &str, words: &str| Phrase { id: id.into(), words: words.into() };
    Question {
        topic: "fruit".into(),
        name: "first".into(),
        language: "en".into(),
        options: vec![phrase("a", "apples"), phrase("b", "bananas")],
    }
}

fn page() -> Page {
    Page {
        id: PageId { topic: "fruit".into(), name: "first".into() },
        title: "Fruit".into(),
        text: "Which do you like?".into(),
        options: question().options,
        dwell: Duration::from_millis(10),
    }
}

async fn a_sentence_ends(rig: &dyn Rig) -> Result<(), Violation> {
    ends(rig, "say", rig.devices().speech_out.say("Which do you like?", "en")).await.map(drop)
}

async fn a_dropped_sentence_makes_room_for_the_next(rig: &dyn Rig) -> Result<(), Violation> {
    let out = rig.devices().speech_out;
    let endless = "word ".repeat(100_000);
    let mut first = out.say(&endless, "en");
    waits(rig, "say", &mut first).await?;
    drop(first);
    ends(rig, "say after a dropped one", out.say("Stop.", "en")).await.map(drop)
}

async fn a_page_stands_before_it_counts_as_shown(rig: &dyn Rig) -> Result<(), Violation> {
    let screen = rig.devices().screen;
    let (short, long) = (page(), Page { dwell: rig.patience() / 4, ..page() });
    let mut show = screen.show(&long);
    waits(rig, "show of a page that takes long to read", &mut show).await?;
    ends(rig, "show", show).await?;
    ends(rig, "show", screen.show(&short)).await?;
    ends(rig, "clear", screen.clear()).await
}

async fn heard(rig: &dyn Rig) -> Result<Heard, Violation> {
    let devices = rig.devices();
    ends(rig, "say", devices.speech_out.say("Which do you like?", "en")).await?;
    ends(rig, "listen", devices.speech_in.listen(&question())).await
}

async fn a_spoken_answer_is_recognised(rig: &dyn Rig) -> Result<(), Violation> {
    rig.stimulate(Stimulus::PersonWillSay { topic: "fruit", option: 1 });
    equal("listen", &heard(rig).await?, &Heard::Phrase("b".into()))
}

async fn an_unknown_answer_is_not_understood(rig: &dyn Rig) -> Result<(), Violation> {
    rig.stimulate(Stimulus::PersonWillMumble { topic: "fruit" });
    match heard(rig).await? {
        Heard::NotUnderstood(_) => Ok(()),
        found @ Heard::Phrase(_) => equal("listen", &found, &Heard::NotUnderstood(String::new())),
    }
}

async fn a_touch_is_reported(rig: &dyn Rig) -> Result<(), Violation> {
    let devices = rig.devices();
    rig.stimulate(Stimulus::PersonWillTouch { topic: "fruit", option: 0 });
    ends(rig, "show", devices.screen.show(&page())).await?;
    let touched = ends(rig, "next_touch", devices.buttons.next_touch(&question())).await?;
    equal("next_touch", &touched, &"a".to_owned())
}

async fn a_request_is_spotted(rig: &dyn Rig) -> Result<(), Violation> {
    let ear = rig.devices().speech_in;
    let request = Question { topic: "help".into(), name: String::new(), ..question() };
    let mut spot = ear.spot(&request, "");
    waits(rig, "spot", &mut spot).await?;
    rig.stimulate(Stimulus::PersonAsks("help"));
    ends(rig, "spot", spot).await
}

async fn a_request_from_out_of_view_is_spotted(rig: &dyn Rig) -> Result<(), Violation> {
    let ear = rig.devices().speech_in;
    let request = Question { topic: "help".into(), name: String::new(), ..question() };
    rig.stimulate(Stimulus::PersonLeaves);
    rig.stimulate(Stimulus::PersonAsks("help"));
    ends(rig, "spot", ear.spot(&request, "")).await?;
    rig.stimulate(Stimulus::PersonReturns);
    Ok(())
}

async fn a_request_is_touched(rig: &dyn Rig) -> Result<(), Violation> {
    let buttons = rig.devices().buttons;
    let mut touch = buttons.next_request("help", "");
    waits(rig, "next_request", &mut touch).await?;
    rig.stimulate(Stimulus::PersonTouchesRequest("help"));
    ends(rig, "next_request", touch).await
}

async fn a_person_in_view_is_seen(rig: &dyn Rig) -> Result<(), Violation> {
    ends(rig, "await_person", rig.devices().skeleton.await_person("")).await.map(drop)
}

async fn a_loss_is_reported_after_it(rig: &dyn Rig) -> Result<(), Violation> {
    let skeleton = rig.devices().skeleton;
    let mut loss = skeleton.await_loss("");
    waits(rig, "await_loss", &mut loss).await?;
    rig.stimulate(Stimulus::PersonLeaves);
    ends(rig, "await_loss", loss).await?;
    let mut back = skeleton.await_person("");
    waits(rig, "await_person", &mut back).await?;
    rig.stimulate(Stimulus::PersonReturns);
    ends(rig, "await_person", back).await.map(drop)
}

async fn a_command_is_taken_once(rig: &dyn Rig) -> Result<(), Violation> {
    let clinic = rig.devices().clinic;
    rig.stimulate(Stimulus::ClinicianCommands("pause"));
    waits(rig, "next_command of another name", &mut clinic.next_command("resume")).await?;
    ends(rig, "next_command", clinic.next_command("pause")).await?;
    waits(rig, "next_command taken before", &mut clinic.next_command("pause")).await
}

async fn a_call_is_attended(rig: &dyn Rig) -> Result<(), Violation> {
    let clinic = rig.devices().clinic;
    rig.stimulate(Stimulus::ClinicianComes);
    ends(rig, "call", clinic.call("1", "company", Urgency::Normal)).await
}

async fn a_report_is_acknowledged(rig: &dyn Rig) -> Result<(), Violation> {
    let report = serde_json::json!({ "fruit": "bananas" });
    ends(rig, "deliver", rig.devices().clinic.deliver("1", &report)).await
}

async fn an_unplugged_device_fails_and_recovers(rig: &dyn Rig) -> Result<(), Violation> {
    let out = rig.devices().speech_out;
    rig.stimulate(Stimulus::Unplug(Device::SpeechOut));
    fails(rig, "say", out.say("This is not heard.", "en")).await?;
    rig.stimulate(Stimulus::PlugIn(Device::SpeechOut));
    ends(rig, "say", out.say("This is heard.", "en")).await.map(drop)
}

async fn unplugging_fails_operations_under_way(rig: &dyn Rig) -> Result<(), Violation> {
    let devices = rig.devices();
    let (asked, report) = (question(), serde_json::Value::Null);
    let endless = Page { dwell: rig.patience(), ..page() };
    // An operation of each device that would not end by itself.
    let mut operations: Vec<(Device, &'static str, Operation<'_, ()>)> = vec![
        (Device::SpeechIn, "spot", devices.speech_in.spot(&asked, "")),
        (Device::Screen, "show", drop_result(devices.screen.show(&endless))),
        (Device::Buttons, "next_touch", drop_result(devices.buttons.next_touch(&asked))),
        (Device::Skeleton, "await_loss", devices.skeleton.await_loss("")),
        (Device::Clinic, "next_command", devices.clinic.next_command("none")),
    ];
    for (device, operation, work) in &mut operations {
        waits(rig, operation, work).await?;
        rig.stimulate(Stimulus::Unplug(*device));
        match tokio::time::timeout(rig.patience(), work).await {
            Ok(Err(_)) => rig.stimulate(Stimulus::PlugIn(*device)),
            Ok(Ok(())) => return Err(Violation::NotFailed { operation }),
            Err(_) => return Err(Violation::Stuck { operation, after: rig.patience() }),
        }
    }
    ends(rig, "deliver", devices.clinic.deliver("1", &report)).await
}

async fn a_fault_is_noticed_and_a_recovery(rig: &dyn Rig) -> Result<(), Violation> {
    let health = rig.devices().health;
    for device in Device::ALL {
        let mut fault = health.await_fault(device);
        waits(rig, "await_fault", &mut fault).await?;
        rig.stimulate(Stimulus::Unplug(device));
        ends(rig, "await_fault", fault).await?;
        let mut recovery = health.await_recovery(device, Duration::from_secs(2));
        waits(rig, "await_recovery", &mut recovery).await?;
        rig.stimulate(Stimulus::PlugIn(device));
        ends(rig, "await_recovery", recovery).await?;
    }
    Ok(())
}

async fn a_working_device_passes_its_test(rig: &dyn Rig) -> Result<(), Violation> {
    let health = rig.devices().health;
    for device in [Device::SpeechOut, Device::SpeechIn, Device::Screen] {
        ends(rig, "test", health.test(device)).await?;
    }
    rig.stimulate(Stimulus::Unplug(Device::Screen));
    fails(rig, "test", health.test(Device::Screen)).await?;
    rig.stimulate(Stimulus::PlugIn(Device::Screen));
    ends(rig, "test", health.test(Device::Screen)).await
}

fn drop_result<'a, T: 'a>(work: Operation<'a, T>) -> Operation<'a, ()> {
    Box::pin(async move { work.await.map(drop) })
}
