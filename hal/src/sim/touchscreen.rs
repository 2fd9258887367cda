//! The touchscreen: pages that stand long enough to be read, and touches.

use std::time::Duration;

use tokio::time::Instant;

use super::ear::chosen;
use super::event::RoomEvent;
use super::room::SimRoom;
use super::script::{By, Reply};
use super::state::State;
use super::waiting::{Activity, Step};
use crate::{Buttons, Device, DeviceError, Evidence, Operation, Page, Question, Screen};

/// How long the screen takes to show a page.
const TO_SHOW: Duration = Duration::from_millis(200);

impl Screen for SimRoom {
    fn show<'a>(&'a self, page: &'a Page) -> Operation<'a, Evidence> {
        self.operate(Device::Screen, Showing { page, since: None, up: false })
    }

    fn clear(&self) -> Operation<'_, ()> {
        let mut since = None;
        self.operate(Device::Screen, move |state: &mut State, now: Instant| {
            let ready = *since.get_or_insert(now) + TO_SHOW;
            if now < ready {
                return Step::Until(ready);
            }
            take_down(state, now);
            Step::Done(Ok(()))
        })
    }
}

fn take_down(state: &mut State, now: Instant) {
    if state.works(Device::Screen) && state.displayed.take().is_some() {
        state.happens(now, RoomEvent::ScreenClears);
    }
}

struct Showing<'a> {
    page: &'a Page,
    since: Option<Instant>,
    up: bool,
}

impl Activity<Evidence> for Showing<'_> {
    fn step(&mut self, state: &mut State, now: Instant) -> Step<Result<Evidence, DeviceError>> {
        let ready = *self.since.get_or_insert(now) + TO_SHOW;
        if now < ready {
            return Step::Until(ready);
        }
        if state.works(Device::Screen) && !self.up {
            self.up = true;
            state.displayed = Some(self.page.clone());
            state.happens(now, RoomEvent::ScreenShows { page: self.page.clone() });
        }
        let read = ready + self.page.dwell;
        if now < read {
            return Step::Until(read);
        }
        // The screen reports its page itself, whatever was sent to it.
        if !self.up || state.displayed.as_ref() != Some(self.page) {
            return Step::Done(Err(DeviceError::NotSensed { device: Device::Screen }));
        }
        state.perceive();
        Step::Done(Ok(Evidence::Sensed))
    }

    fn stop(&mut self, state: &mut State, now: Instant) {
        if self.up {
            take_down(state, now);
        }
    }
}

impl Buttons for SimRoom {
    fn next_touch<'a>(&'a self, question: &'a Question) -> Operation<'a, String> {
        self.operate(Device::Buttons, Touching { question, open: false })
    }

    fn next_request<'a>(&'a self, request: &'a str, person: &'a str) -> Operation<'a, ()> {
        self.operate(Device::Buttons, move |state: &mut State, now: Instant| {
            let reachable = state.works(Device::Buttons) && state.view_of(person).inside;
            match reachable.then(|| state.take_request(request, person, By::Touch)).flatten() {
                Some(asked) => {
                    state.happens(now, asked.event());
                    Step::Done(Ok(()))
                }
                None => Step::Idle,
            }
        })
    }
}

struct Touching<'a> {
    question: &'a Question,
    open: bool,
}

impl Activity<String> for Touching<'_> {
    fn step(&mut self, state: &mut State, now: Instant) -> Step<Result<String, DeviceError>> {
        if !std::mem::replace(&mut self.open, true) {
            state.open(self.question, By::Touch, now);
        }
        let Some((at, Reply::Answer { option, by, .. })) = state.reply(self.question, By::Touch) else {
            return Step::Idle;
        };
        let option = if by == By::Both { option + 1 } else { option };
        if by == By::Voice && state.is_listened_for(self.question) {
            return Step::Idle;
        }
        let Some(phrase) = chosen(&self.question.options, option) else { return Step::Idle };
        if !state.offers(&phrase.id) {
            return Step::Idle;
        }
        if now < at {
            return Step::Until(at);
        }
        let (option, words) = (phrase.id.clone(), phrase.words.clone());
        state.answered(By::Touch);
        state.happens(now, RoomEvent::PersonTouches { option: option.clone(), words });
        state.close(self.question, By::Touch);
        Step::Done(Ok(option))
    }

    fn stop(&mut self, state: &mut State, _: Instant) {
        state.close(self.question, By::Touch);
    }
}
