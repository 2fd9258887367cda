//! Speech in: the person answers while they are in view and a device listens; a request is heard from anywhere.

use tokio::time::Instant;

use super::event::RoomEvent;
use super::room::SimRoom;
use super::script::{By, Reply};
use super::state::{Asked, State};
use super::waiting::{Activity, Step};
use crate::{Device, DeviceError, Heard, Operation, Phrase, Question, SpeechIn};

impl SpeechIn for SimRoom {
    fn listen<'a>(&'a self, question: &'a Question) -> Operation<'a, Heard> {
        self.operate(Device::SpeechIn, Listening { question, open: false })
    }

    fn spot<'a>(&'a self, request: &'a Question, person: &'a str) -> Operation<'a, ()> {
        self.operate(Device::SpeechIn, move |state: &mut State, now: Instant| {
            if !state.works(Device::SpeechIn) {
                return Step::Idle;
            }
            match state.take_request(&request.topic, person, By::Voice) {
                Some(asked) => {
                    state.happens(now, asked.event());
                    Step::Done(Ok(()))
                }
                None => Step::Idle,
            }
        })
    }
}

impl Asked {
    pub(super) fn event(self) -> RoomEvent {
        let person = Some(self.person).filter(|name| !name.is_empty());
        RoomEvent::PersonAsks { request: self.request, person }
    }
}

struct Listening<'a> {
    question: &'a Question,
    open: bool,
}

impl Activity<Heard> for Listening<'_> {
    fn step(&mut self, state: &mut State, now: Instant) -> Step<Result<Heard, DeviceError>> {
        if !std::mem::replace(&mut self.open, true) {
            state.open(self.question, By::Voice, now);
        }
        let Some((at, reply)) = state.reply(self.question, By::Voice) else { return Step::Idle };
        let Some((said, heard)) = spoken(state, &reply, &self.question.options) else { return Step::Idle };
        if now < at {
            return Step::Until(at);
        }
        state.answered(By::Voice);
        state.happens(now, RoomEvent::PersonSays { words: said });
        if !state.works(Device::SpeechIn) {
            return Step::Idle;
        }
        state.close(self.question, By::Voice);
        Step::Done(Ok(heard))
    }

    fn stop(&mut self, state: &mut State, _: Instant) {
        state.close(self.question, By::Voice);
    }
}

/// The words of a spoken reply, and what the recogniser reports; `None` for a reply that is not spoken.
fn spoken(state: &State, reply: &Reply, options: &[Phrase]) -> Option<(String, Heard)> {
    match reply {
        Reply::Silent => None,
        Reply::Misheard { words, .. } => Some((words.clone(), Heard::NotUnderstood(words.clone()))),
        Reply::Answer { option, by, .. } => {
            let phrase = chosen(options, *option)?;
            match by {
                By::Touch if state.offers(&phrase.id) => None,
                By::Touch | By::Voice | By::Both => {
                    Some((phrase.words.clone(), Heard::Phrase(phrase.id.clone())))
                }
            }
        }
    }
}

/// The option of that number, or the last.
pub(super) fn chosen(options: &[Phrase], option: usize) -> Option<&Phrase> {
    options.get(option).or(options.last())
}
