//! The touchscreen: pages, the screen's own reports of them, and touches.

use std::time::Duration;

use tokio::time::Instant;

use super::ear::chosen;
use super::event::RoomEvent;
use super::room::SimRoom;
use super::script::{By, Reply};
use super::state::State;
use super::waiting::{Activity, Step};
use crate::{Buttons, Device, DeviceError, Operation, Page, PageId, Question, Screen};

/// How long the screen takes to show a page.
const TO_SHOW: Duration = Duration::from_millis(200);

impl Screen for SimRoom {
    fn show<'a>(&'a self, page: &'a Page) -> Operation<'a, ()> {
        self.operate(put_up(Some(page)))
    }

    fn clear(&self) -> Operation<'_, ()> {
        self.operate(put_up(None))
    }

    fn next_shown(&self) -> Operation<'_, PageId> {
        self.operate(|state: &mut State, _: Instant| {
            if let Err(error) = state.check(Device::Screen) {
                return Step::Done(Err(error));
            }
            state.unreported.pop_front().map_or(Step::Idle, |page| Step::Done(Ok(page)))
        })
    }
}

fn put_up<'a>(
    page: Option<&'a Page>,
) -> impl FnMut(&mut State, Instant) -> Step<Result<(), DeviceError>> + Send + 'a {
    let mut since = None;
    move |state, now| {
        if let Err(error) = state.check(Device::Screen) {
            return Step::Done(Err(error));
        }
        let ready = *since.get_or_insert(now) + TO_SHOW;
        if now < ready {
            return Step::Until(ready);
        }
        if state.works(Device::Screen) {
            state.displayed = page.cloned();
            match page {
                Some(page) => {
                    state.unreported.push_back(page.id.clone());
                    state.perceive();
                    state.happens(now, RoomEvent::ScreenShows { page: page.clone() });
                }
                None => state.happens(now, RoomEvent::ScreenClears),
            }
        }
        Step::Done(Ok(()))
    }
}

impl Buttons for SimRoom {
    fn next_touch<'a>(&'a self, question: &'a Question) -> Operation<'a, String> {
        self.operate(Touching { question, open: false })
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
        if let Err(error) = state.check(Device::Buttons) {
            state.close(self.question, By::Touch);
            return Step::Done(Err(error));
        }
        let Some((at, Reply::Answer { option, by, .. })) = state.reply(self.question) else {
            return Step::Idle;
        };
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
        state.answered();
        state.happens(now, RoomEvent::PersonTouches { option: option.clone(), words });
        state.close(self.question, By::Touch);
        Step::Done(Ok(option))
    }

    fn stop(&mut self, state: &mut State, _: Instant) {
        state.close(self.question, By::Touch);
    }
}
