//! Events of the simulated room, by its own record.
#![allow(clippy::unwrap_used, reason = "a test")]

use std::time::Duration;

use expect_test::{Expect, expect};
use hal::sim::{Behaviour, ClinicianScript, PatientScript, RoomEvent, SimRoom};
use hal::{Device, DeviceError, Evidence, Page, PageId, Phrase, Question, Urgency};
use tokio::time::{sleep, timeout};

fn room(patient: &str) -> SimRoom {
    SimRoom::new(toml::from_str::<PatientScript>(patient).unwrap(), ClinicianScript::default())
}

fn check(room: &SimRoom, expected: &Expect) {
    let mut lines = String::new();
    for moment in room.moments() {
        lines +=
            &format!("{:.1} {}\n", moment.at.as_secs_f64(), serde_json::to_value(&moment.event).unwrap());
    }
    expected.assert_eq(&lines);
}

fn question(name: &str) -> Question {
    let phrase = |id: &str| Phrase { id: id.into(), words: format!("option {id}") };
    Question {
        topic: "eating".into(),
        name: name.into(),
        language: "en".into(),
        options: vec![phrase("a"), phrase("b")],
    }
}

fn page() -> Page {
    Page {
        id: PageId { topic: "eating".into(), name: "q".into() },
        title: String::new(),
        text: "?".into(),
        options: question("").options,
        dwell: Duration::from_secs(2),
    }
}

#[tokio::test(start_paused = true)]
async fn a_dropped_sentence_stops_within_it() {
    let room = room("");
    let out = room.devices().speech_out;
    let _ = timeout(Duration::from_secs(1), out.say("one two three four five", "en")).await;
    check(
        &room,
        &expect![[r#"
          0.0 {"event":"robot_says","text":"one two three four five"}
          1.0 {"event":"robot_stops","said":"one two"}
    "#]],
    );
}

#[tokio::test(start_paused = true)]
async fn silence_is_for_one_question_and_not_for_its_repetition_after_an_interruption() {
    let room = room(
        "replies = [
        { topic = 'eating', question = 'first', reply = 'silent' },
        { topic = 'eating', question = 'second', reply = { answer = { option = 1, delay = 3.0 } } },
    ]",
    );
    let devices = room.devices();
    devices.speech_out.say("Well?", "en").await.unwrap();
    for _ in 0..2 {
        assert!(
            timeout(Duration::from_secs(10), devices.speech_in.listen(&question("first"))).await.is_err()
        );
    }
    assert!(
        timeout(Duration::from_secs(10), devices.speech_in.listen(&question("second"))).await.is_err(),
        "not asked yet"
    );
    devices.speech_out.say("Again?", "en").await.unwrap();
    devices.speech_in.listen(&question("second")).await.unwrap();
    check(
        &room,
        &expect![[r#"
        0.0 {"event":"robot_says","text":"Well?"}
        30.4 {"event":"robot_says","text":"Again?"}
        33.8 {"event":"person_says","words":"option b"}
    "#]],
    );
}

#[tokio::test(start_paused = true)]
async fn a_touch_needs_the_option_on_the_screen() {
    let touch = "replies = [
        { topic = 'eating', question = 'first', reply = { answer = { option = 0, by = 'touch' } } },
        { topic = 'eating', reply = { answer = { option = 1, by = 'touch' } } },
    ]";
    let room = room(touch);
    let devices = room.devices();
    devices.speech_out.say("Well?", "en").await.unwrap();
    devices.speech_in.listen(&question("first")).await.unwrap();
    devices.screen.show(&page()).await.unwrap();
    let second = question("second");
    let (touch, heard) = (devices.buttons.next_touch(&second), devices.speech_in.listen(&second));
    tokio::select! { biased; touched = touch => assert_eq!(touched.unwrap(), "b"), _ = heard => panic!("spoken") }
    check(
        &room,
        &expect![[r#"
            0.0 {"event":"robot_says","text":"Well?"}
            2.4 {"event":"person_says","words":"option a"}
            2.6 {"event":"screen_shows","page":{"id":{"name":"q","topic":"eating"},"options":[{"id":"a","words":"option a"},{"id":"b","words":"option b"}],"text":"?","title":""}}
            6.6 {"event":"person_touches","option":"b","words":"option b"}
        "#]],
    );
}

#[tokio::test(start_paused = true)]
async fn a_person_out_of_view_does_not_answer() {
    let room = room("");
    let devices = room.devices();
    devices.speech_out.say("Well?", "en").await.unwrap();
    let asked = question("first");
    let listen = devices.speech_in.listen(&asked);
    let director = async {
        room.lose_person();
        sleep(Duration::from_secs(8)).await;
        room.return_person();
        std::future::pending::<()>().await;
    };
    tokio::select! { biased; () = director => {}, heard = listen => drop(heard.unwrap()) }
    check(
        &room,
        &expect![[r#"
        0.0 {"event":"robot_says","text":"Well?"}
        0.4 {"event":"person_leaves"}
        8.4 {"event":"person_returns"}
        10.4 {"event":"person_says","words":"option a"}
    "#]],
    );
}

#[tokio::test(start_paused = true)]
async fn a_lying_loudspeaker_takes_its_time_and_is_not_heard() {
    let room = room("");
    let devices = room.devices();
    room.lie(Device::SpeechOut);
    let not_sensed = DeviceError::NotSensed { device: Device::SpeechOut };
    assert_eq!(devices.speech_out.say("Can you hear me?", "en").await, Err(not_sensed));
    assert!(timeout(Duration::from_secs(60), devices.speech_in.listen(&question("first"))).await.is_err());
    room.recover(Device::SpeechOut);
    devices.speech_out.say("And now?", "en").await.unwrap();
    check(
        &room,
        &expect![[r#"
        0.0 {"device":"speech_out","event":"device_lies"}
        61.6 {"device":"speech_out","event":"device_recovers"}
        61.6 {"event":"robot_says","text":"And now?"}
    "#]],
    );
}

#[tokio::test(start_paused = true)]
async fn without_a_microphone_the_loudspeaker_is_believed_and_not_sensed() {
    let room = room("");
    let out = room.devices().speech_out;
    assert_eq!(out.say("Hello", "en").await, Ok(Evidence::Sensed));
    room.fail(Device::SpeechIn);
    assert_eq!(out.say("Hello", "en").await, Ok(Evidence::Claimed));
    room.lie(Device::SpeechIn);
    assert_eq!(out.say("Hello", "en").await, Err(DeviceError::NotSensed { device: Device::SpeechOut }));
}

#[tokio::test(start_paused = true)]
async fn a_lying_screen_is_not_sensed() {
    let room = room("");
    let screen = room.devices().screen;
    room.lie(Device::Screen);
    assert_eq!(screen.show(&page()).await, Err(DeviceError::NotSensed { device: Device::Screen }));
}

#[tokio::test(start_paused = true)]
async fn a_page_that_is_taken_away_before_it_could_be_read_is_gone() {
    let room = room("");
    let screen = room.devices().screen;
    assert!(timeout(Duration::from_secs(1), screen.show(&page())).await.is_err());
    let events: Vec<_> = room.moments().into_iter().map(|moment| moment.event).collect();
    assert_eq!(events.last(), Some(&RoomEvent::ScreenClears));
}

#[tokio::test(start_paused = true)]
async fn a_stalled_device_answers_nothing_until_it_recovers_and_a_slow_one_is_late() {
    let room = room("");
    let devices = room.devices();
    room.behave(Device::SpeechOut, Behaviour::Stalls);
    let mut say = devices.speech_out.say("Hello", "en");
    assert!(timeout(Duration::from_secs(60), &mut say).await.is_err());
    devices.health.await_fault(Device::SpeechOut).await.unwrap();
    room.behave(Device::SpeechOut, Behaviour::Slow);
    let before = tokio::time::Instant::now();
    say.await.unwrap();
    assert_eq!(before.elapsed(), Duration::from_millis(3400));
}

#[tokio::test(start_paused = true)]
async fn a_visitor_is_not_the_patient() {
    let room = room("");
    let devices = room.devices();
    let mut visitor = devices.skeleton.await_person("visitor");
    assert!(timeout(Duration::from_secs(10), &mut visitor).await.is_err());
    room.visitor_comes("visitor");
    visitor.await.unwrap();
    let help = Question { topic: "help".into(), ..question("") };
    room.ask_by("help", "visitor", None);
    let patient = devices.speech_in.spot(&help, "person");
    assert!(timeout(Duration::from_secs(10), patient).await.is_err());
    devices.speech_in.spot(&help, "visitor").await.unwrap();
}

#[tokio::test(start_paused = true)]
async fn the_clinician_fetches_the_person() {
    let room = room("in_view = false");
    let observed = std::sync::Arc::new(std::sync::Mutex::new(0));
    let count = observed.clone();
    room.observe(move |_| *count.lock().unwrap() += 1);
    room.devices().clinic.call("1", "absence", Urgency::Normal).await.unwrap();
    assert!(room.person_in_view());
    assert_eq!(*observed.lock().unwrap(), room.moments().len());
    check(
        &room,
        &expect![[r#"
            0.0 {"event":"clinician_called","id":"1","need":"absence"}
            20.0 {"event":"clinician_arrives","need":"absence"}
            20.0 {"event":"person_returns"}
            25.0 {"event":"clinician_goes","need":"absence"}
        "#]],
    );
}
