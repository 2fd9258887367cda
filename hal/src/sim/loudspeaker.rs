//! Speech out: a sentence takes a time proportional to its words.

use std::time::Duration;

use tokio::time::Instant;

use super::behaviour::Behaviour;
use super::event::RoomEvent;
use super::room::SimRoom;
use super::state::{State, seconds};
use super::waiting::{Activity, Step};
use crate::{Device, DeviceError, Evidence, Operation, SpeechOut};

/// Two and a half words a second: slow, for old ears.
const SECONDS_PER_WORD: f64 = 0.4;

impl SpeechOut for SimRoom {
    fn say<'a>(&'a self, text: &'a str, _language: &'a str) -> Operation<'a, Evidence> {
        self.operate(Device::SpeechOut, Saying { text, since: None, aloud: false })
    }
}

struct Saying<'a> {
    text: &'a str,
    /// When it began; `None` while the robot says another sentence.
    since: Option<Instant>,
    /// Whether the person can hear it.
    aloud: bool,
}

impl Activity<Evidence> for Saying<'_> {
    fn step(&mut self, state: &mut State, now: Instant) -> Step<Result<Evidence, DeviceError>> {
        let since = match self.since {
            Some(since) => since,
            None if state.speaking => return Step::Idle,
            None => {
                state.speaking = true;
                self.since = Some(now);
                self.aloud = state.works(Device::SpeechOut);
                if self.aloud {
                    state.happens(now, RoomEvent::RobotSays { text: self.text.to_owned() });
                }
                now
            }
        };
        let over = since + duration(self.text);
        if now < over {
            return Step::Until(over);
        }
        state.speaking = false;
        state.changed = true;
        if self.aloud {
            state.perceive();
        }
        Step::Done(self.loopback(state))
    }

    fn stop(&mut self, state: &mut State, now: Instant) {
        let Some(since) = self.since.take() else { return };
        state.speaking = false;
        state.changed = true;
        if self.aloud {
            let words = (now - since).as_secs_f64() / SECONDS_PER_WORD;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "whole words were said"
            )]
            let said = self.text.split_whitespace().take(words as usize).collect::<Vec<_>>().join(" ");
            state.happens(now, RoomEvent::RobotStops { said });
        }
    }
}

impl Saying<'_> {
    /// What the microphone hears of the loudspeaker.
    fn loopback(&self, state: &State) -> Result<Evidence, DeviceError> {
        match state.behaviour(Device::SpeechIn) {
            Behaviour::Works | Behaviour::Slow if self.aloud => Ok(Evidence::Sensed),
            Behaviour::Works | Behaviour::Slow | Behaviour::Lies => {
                Err(DeviceError::NotSensed { device: Device::SpeechOut })
            }
            Behaviour::Fails | Behaviour::Stalls | Behaviour::Refuses | Behaviour::Panics => {
                Ok(Evidence::Claimed)
            }
        }
    }
}

fn duration(text: &str) -> Duration {
    #[expect(clippy::cast_precision_loss, reason = "no sentence has 2^52 words")]
    let words = text.split_whitespace().count() as f64;
    seconds(words * SECONDS_PER_WORD)
}
