//! Translates a scenario, which names items and questions, into scripts of the simulated room.
//!
//! A seed other than 0 varies the delays of the simulated person's answers by up to half, so a
//! campaign covers other interleavings. The same seed gives the same delays.

use hal::sim::{By, ClinicianScript, PatientScript, Reply, ReplyRule};
use mission::{Mission, scenario};
use pddl::model::Name;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::time::Duration;

/// The person's script.
pub(super) fn patient(mission: &Mission, patient: &scenario::Patient, seed: u64) -> PatientScript {
    let mut jitter = Jitter::new(seed);
    let (layers, questions) = (&mission.layers, questions(mission));
    let mut replies = Vec::new();
    for item in layers.items() {
        let topic = layers.name(item);
        for question in &questions {
            let reply = jittered(patient.reply(topic, question), &mut jitter);
            replies.push(ReplyRule { topic: topic.to_owned(), question: Some(question.to_string()), reply });
        }
    }
    PatientScript {
        in_view: patient.in_view,
        replies,
        otherwise: jittered(&patient.default, &mut jitter),
        ..PatientScript::default()
    }
}

/// The clinician's script.
pub(super) fn clinician(clinician: &scenario::Clinician) -> ClinicianScript {
    ClinicianScript {
        comes: clinician.comes_after.is_some(),
        only_urgent: clinician.only_urgent,
        after: clinician.comes_after.unwrap_or_default().as_secs_f64(),
        stays: clinician.stays.as_secs_f64(),
        fetches: clinician.fetches,
    }
}

/// The questions that a person may be asked about an item, in their order: the nodes that may be
/// the subject of the token of an unanswered question.
pub(super) fn questions(mission: &Mission) -> Vec<Name> {
    let layers = &mission.layers;
    let asked = &layers.vocabulary.model.predicates[layers.tokens.unanswered].variables;
    let Some(asked) = asked.parameters().first() else { return Vec::new() };
    let objects = &layers.graph.model.objects;
    let askable = objects.iter().filter(|object| object.is_of(&asked.types, &layers.nodes.types));
    askable.map(|object| object.name.clone()).collect()
}

/// A reply as the simulated person gives it.
pub(super) fn reply(reply: &scenario::Reply) -> Reply {
    jittered(reply, &mut Jitter::new(0))
}

/// The manner of an answer or a request.
pub(super) fn manner(by: scenario::By) -> By {
    match by {
        scenario::By::Voice => By::Voice,
        scenario::By::Touch => By::Touch,
        scenario::By::Both => By::Both,
    }
}

fn jittered(reply: &scenario::Reply, jitter: &mut Jitter) -> Reply {
    let delay = jitter.vary(reply.delay).as_secs_f64();
    match &reply.answer {
        scenario::Answer::Option(number) => {
            let option = (*number as usize).saturating_sub(1);
            Reply::Answer { option, delay, by: manner(reply.by) }
        }
        scenario::Answer::Silent => Reply::Silent,
        scenario::Answer::Misheard(words) => Reply::Misheard { words: words.clone(), delay },
    }
}

/// Varies delays by a seed; seed 0 changes nothing.
struct Jitter(Option<Pcg64Mcg>);

impl Jitter {
    fn new(seed: u64) -> Self {
        Self((seed != 0).then(|| Pcg64Mcg::seed_from_u64(seed)))
    }

    /// `delay` times a factor in 0.5..1.5.
    fn vary(&mut self, delay: Duration) -> Duration {
        let Some(random) = &mut self.0 else { return delay };
        let percent = u32::try_from(random.next_u64() % 101).expect("below 101") + 50;
        delay * percent / 100
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seed_zero_changes_nothing_and_a_seed_repeats() {
        let delay = Duration::from_secs(2);
        assert_eq!(Jitter::new(0).vary(delay), delay);
        assert_eq!(Jitter::new(7).vary(delay), Jitter::new(7).vary(delay));
        let varied = Jitter::new(7).vary(delay);
        assert!(varied >= delay / 2 && varied <= delay * 3 / 2);
    }
}
