//! Agents over the simulated room: the real shell, the simulated clock.
#![allow(clippy::unwrap_used, reason = "a test")]

mod common;

use std::sync::Arc;
use std::time::Duration;

use agents::{Environment, Equipment, Housing, Reporter, TokioClock, Words, run_all};
use common::{Lab, told};
use dsr::{Event, Snapshot};
use expect_test::expect;
use hal::Device;
use hal::sim::{ClinicianScript, PatientScript, RoomEvent, SimRoom};
use tokio::time::sleep;

struct LabWords;

impl Words for LabWords {
    fn language(&self) -> &str {
        "en"
    }

    fn sentence(&self, _: &str, utterance: &str) -> Option<String> {
        Some(format!("{utterance} and eight more words to be said"))
    }

    fn options(&self, _: &str) -> Vec<(String, String)> {
        ["hello", "goodbye"].map(|option| (option.to_owned(), format!("I say {option}"))).into()
    }

    fn request_words(&self, request: &str) -> Vec<String> {
        vec![request.to_owned()]
    }
}

impl Reporter for LabWords {
    fn report(&self, document: &str, _: &Snapshot) -> Option<serde_json::Value> {
        Some(document.into())
    }
}

/// Runs the agents for a simulated time while a director acts; the commits with their times, and the room.
async fn play<F: Future<Output = ()>>(
    names: &[&str],
    director: impl FnOnce(Arc<Lab>, SimRoom) -> F,
) -> (Vec<String>, SimRoom) {
    let lab = Arc::new(Lab::new());
    let room = SimRoom::new(PatientScript::default(), ClinicianScript::default());
    let deltas = lab.graph.subscribe_deltas();
    let words = Arc::new(LabWords);
    let equipment =
        Equipment { devices: room.devices(), words: words.clone(), reporter: words, run: "run".into() };
    let environment = Environment {
        graph: lab.graph.clone(),
        equipment,
        clock: Arc::new(TokioClock::start()),
        housing: Housing::default(),
        absence: None,
    };
    let agents: Vec<_> = names.iter().map(|name| lab.agent(name)).collect();
    let directed = async {
        director(Arc::clone(&lab), room.clone()).await;
        // Before the agents are dropped and expire.
        let mut lines = Vec::new();
        while let Some(event) = deltas.try_recv() {
            let Event::Committed(committed) = event else { panic!("lagged") };
            let seconds = Duration::from_nanos(committed.delta.time.0).as_secs_f64();
            lines.push(format!("{seconds:.1} {}", told(&committed.delta, &committed.snapshot)));
        }
        lines
    };
    let lines = tokio::select! {
        biased;
        never = run_all(agents, environment) => match never {},
        lines = directed => lines,
    };
    (lines, room)
}

async fn seconds(seconds: f64) {
    sleep(Duration::from_secs_f64(seconds)).await;
}

#[tokio::test(start_paused = true)]
async fn speech_stops_in_the_version_in_which_the_person_is_lost() {
    let (lines, room) = play(&["talker", "watcher"], |lab, room| async move {
        seconds(1.0).await;
        lab.direct(&["+robot shall_say hello"], 1);
        seconds(1.0).await;
        room.lose_person();
        seconds(1.0).await;
    })
    .await;
    // One commit takes the person and the speaking away.
    let lost: Vec<_> = lines.iter().filter(|line| line.contains("no longer: person is with robot")).collect();
    let [lost] = lost.as_slice() else { panic!("{lines:#?}") };
    assert!(
        lost.contains("no longer: robot is speaking") && lost.contains("robot is not speaking"),
        "{lost}"
    );
    // And the loudspeaker falls silent at that very time, 0.3 s after the person left.
    let stopped =
        room.moments().into_iter().find(|moment| matches!(moment.event, RoomEvent::RobotStops { .. }));
    assert_eq!(stopped.unwrap().at, Duration::from_millis(2300));
}

#[tokio::test(start_paused = true)]
async fn a_sentence_goes_from_intention_to_said() {
    let (lines, room) = play(&["talker", "watcher"], |lab, _| async move {
        lab.direct(&["+robot shall_say hello"], 0);
        seconds(10.0).await;
    })
    .await;
    expect![[r#"
        0.0 v2 director: robot shall say hello
        0.0 v3 talker: no longer: robot is not speaking, robot is speaking, robot says hello
        3.2 v4 talker: no longer: robot is speaking, no longer: robot shall say hello, no longer: robot says hello, robot said hello
    "#]].assert_eq(&(lines.join("\n") + "\n"));
    assert_eq!(room.moments().len(), 1);
}

#[tokio::test(start_paused = true)]
async fn a_device_that_fails_gives_the_outcome_failure_and_is_tried_again_after_a_rest() {
    let (lines, room) = play(&["talker"], |lab, room| async move {
        room.fail(Device::SpeechOut);
        lab.direct(&["+robot shall_say hello"], 0);
        seconds(2.5).await;
        room.recover(Device::SpeechOut);
        seconds(5.5).await;
    })
    .await;
    let starts = lines
        .iter()
        .filter(|line| line.contains("robot says hello") && !line.contains("no longer: robot says"));
    let starts: Vec<_> = starts.map(|line| &line[..3]).collect();
    assert_eq!(starts, ["0.0", "1.0", "3.0"], "{lines:#?}");
    assert!(lines.last().unwrap().contains("robot said hello"));
    assert!(room.moments().iter().any(|moment| matches!(moment.event, RoomEvent::RobotSays { .. })));
}

#[tokio::test(start_paused = true)]
async fn the_person_answers_what_they_were_asked() {
    let (lines, _) = play(&["talker", "watcher"], |lab, _| async move {
        lab.direct(&["+robot shall_say hello"], 0);
        seconds(5.0).await;
        lab.direct(&["+robot shall_ask person"], 5);
        seconds(5.0).await;
    })
    .await;
    assert!(lines.last().unwrap().contains("robot heard hello"), "{lines:#?}");
}

#[tokio::test(start_paused = true)]
async fn the_same_scenario_gives_the_same_commits_and_the_same_room() {
    async fn scenario() -> (Vec<String>, String) {
        let (lines, room) = play(&["talker", "shouter", "watcher"], |lab, room| async move {
            lab.direct(&["+robot shall_say hello", "+robot shall_say goodbye", "+robot shall_ask person"], 0);
            seconds(1.5).await;
            lab.direct(&["+robot shall_shout fire"], 1);
            seconds(1.5).await;
            room.lose_person();
            seconds(4.0).await;
            room.return_person();
            seconds(30.0).await;
        })
        .await;
        (lines, format!("{:?}", room.moments()))
    }
    let first = scenario().await;
    assert!(first.0.len() > 10);
    for _ in 0..5 {
        assert_eq!(scenario().await, first);
    }
}

#[tokio::test(start_paused = true)]
async fn dropping_the_shell_stops_every_device() {
    let (_, room) = play(&["talker"], |lab, _| async move {
        lab.direct(&["+robot shall_say hello"], 0);
        seconds(1.0).await;
    })
    .await;
    let stopped = room.moments().last().cloned().unwrap();
    assert!(matches!(stopped.event, RoomEvent::RobotStops { .. }), "{stopped:?}");
}

/// Breakage: 2.9 million lines in simulated zero time, and 50,000 commits a second in real time.
#[tokio::test(start_paused = true)]
async fn a_sentence_is_said_although_another_rule_preempts_whoever_speaks() {
    let (lines, _) = play(&["talker", "heckler"], |lab, _| async move {
        lab.direct(&["+robot shall_say hello"], 0);
        seconds(20.0).await;
    })
    .await;
    assert!(lines.len() < 20, "{lines:#?}");
    assert!(lines.last().unwrap().contains("robot said hello"), "{lines:#?}");
}

/// On a real clock each beginning has another time.
#[tokio::test]
async fn a_rule_that_preempts_what_triggers_it_rests_on_a_real_clock() {
    let (lines, _) = play(&["talker", "heckler"], |lab, _| async move {
        lab.direct(&["+robot shall_say hello"], 0);
        // Each turn of the others comes after all that the agents can do at once.
        for _ in 0..100 {
            tokio::task::yield_now().await;
        }
    })
    .await;
    assert!(lines.len() < 20, "{} commits", lines.len());
}
