//! Scenarios from seeds: a patient, a clinician, one to four disruptions.

use crate::dice::Dice;
use std::fmt::Write as _;

const ITEMS: [(&str, u64); 10] = [
    ("feeding", 3),
    ("bathing", 2),
    ("grooming", 2),
    ("dressing", 3),
    ("bowels", 3),
    ("bladder", 3),
    ("toilet-use", 3),
    ("transfers", 4),
    ("mobility", 4),
    ("stairs", 3),
];

const CONDITIONS: [&str; 14] = [
    "(is robot speaking)",
    "(and (is robot speaking) (is_in barthel ITEM))",
    "(and (finish robot speaking) (is_in barthel ITEM))",
    "(is robot showing)",
    "(waiting person answer)",
    "(and (waiting person answer) (is_in barthel ITEM))",
    "(got person answer)",
    "(can person answer)",
    "(not (is_with person robot))",
    "(exists (?o - option) (was_chosen_in ?o ITEM))",
    "(is barthel paused)",
    "(asks person help)",
    "(exists (?n - need) (is_called_for clinician ?n))",
    "(is_due_to report clinician)",
];

const STEPS: [&str; 12] = [
    "(greet person)",
    "(explain person opening feeding)",
    "(describe person ITEM)",
    "(ask person ITEM)",
    "(ask-again person ITEM)",
    "(pass-over person ITEM)",
    "(thank person stairs closing)",
    "(report person)",
    "(call-back person)",
    "(get-help person)",
    "(call-clinician person)",
    "(await-resumption person)",
];

const ACTS: [&str; 8] = ["lose-person", "return-person", "ask", "pause", "resume", "fail", "lie", "recover"];

const DEVICES: [&str; 3] = ["speaker", "screen", "microphone"];

/// A scenario, and what of it the invariants depend on.
pub(crate) struct MadeUp {
    pub(crate) text: String,
    /// No device fails or lies.
    pub(crate) sound: bool,
    /// The person answers each question, understandably and in time.
    pub(crate) willing: bool,
    /// The clinician comes when called.
    pub(crate) comes: bool,
}

/// The scenario of a seed.
pub(crate) fn make_up(seed: u64) -> MadeUp {
    let mut dice = Dice::new(seed);
    let dice = &mut dice;
    let mut made_up = MadeUp {
        text: format!("title = \"made up from seed {seed}\"\n"),
        sound: true,
        willing: true,
        comes: true,
    };
    patient(dice, &mut made_up);
    made_up.comes = dice.chance(75);
    if made_up.comes {
        let (after, stays) = (dice.seconds(60), dice.seconds(20));
        let fetches = dice.chance(70);
        write!(made_up.text, "\n[clinician]\ncomes-after = {after}\nstays = {stays}\nfetches = {fetches}\n")
            .unwrap();
    }
    let twins = dice.chance(20).then(|| trigger(dice));
    for _ in 0..=dice.roll(4) {
        let trigger = match &twins {
            Some(trigger) if dice.chance(70) => trigger.clone(),
            _ => trigger(dice),
        };
        disruption(dice, &trigger, &mut made_up);
    }
    made_up
}

fn patient(dice: &mut Dice, made_up: &mut MadeUp) {
    let in_view = !dice.chance(7);
    let by = if dice.chance(30) { "touch" } else { "voice" };
    let delay = dice.seconds(10);
    write!(
        made_up.text,
        "\n[patient]\nin-view = {in_view}\ndefault = {{ option = 1, delay = {delay}, by = \"{by}\" }}\n"
    )
    .unwrap();
    for (item, options) in ITEMS {
        if !dice.chance(25) {
            continue;
        }
        let question = match dice.roll(3) {
            0 => "question = \"first-question\"\n",
            1 => "question = \"second-question\"\n",
            _ => "",
        };
        let delay = dice.seconds(20);
        let reply = match dice.roll(6) {
            0 => "silent = true".to_owned(),
            1 => format!("misheard = \"the blue one\"\ndelay = {delay}"),
            n => {
                let by = if n == 2 { "touch" } else { "voice" };
                format!("option = {}\ndelay = {delay}\nby = \"{by}\"", 1 + dice.roll(options))
            }
        };
        made_up.willing &= reply.starts_with("option") && delay.parse::<f64>().unwrap() < 10.0;
        write!(made_up.text, "\n[[patient.reply]]\nitem = \"{item}\"\n{question}{reply}\n").unwrap();
    }
}

fn trigger(dice: &mut Dice) -> String {
    let item = dice.pick(&ITEMS).0;
    match dice.roll(3) {
        0 => format!("at = {}", dice.seconds(400)),
        1 => {
            let condition = dice.pick(&CONDITIONS).replace("ITEM", item);
            format!("when = \"{condition}\"\noccurrence = {}\nafter = {}", 1 + dice.roll(3), after(dice))
        }
        _ => {
            let step = dice.pick(&STEPS).replace("ITEM", item);
            format!("step = \"{step}\"\nafter = {}", after(dice))
        }
    }
}

fn after(dice: &mut Dice) -> String {
    if dice.chance(40) { "0".to_owned() } else { dice.seconds(20) }
}

fn disruption(dice: &mut Dice, trigger: &str, made_up: &mut MadeUp) {
    // An abort ends what could still be found: it is rarer.
    let act = if dice.chance(5) { &"abort" } else { dice.pick(&ACTS) };
    write!(made_up.text, "\n[[disruption]]\n{trigger}\noptional = true\ndo = \"{act}\"\n").unwrap();
    match *act {
        "ask" => made_up.text.push_str("request = \"help\"\n"),
        "fail" | "lie" | "recover" => {
            writeln!(made_up.text, "device = \"{}\"", dice.pick(&DEVICES)).unwrap();
            made_up.sound &= *act == "recover";
        }
        _ => {}
    }
    // What was taken is often given back, sooner or later.
    let undone = match *act {
        "lose-person" => Some("return-person"),
        "pause" => Some("resume"),
        _ => None,
    };
    if let Some(undone) = undone.filter(|_| dice.chance(70)) {
        let when = if *act == "pause" { "(is barthel paused)" } else { "(not (is_with person robot))" };
        let after = dice.seconds(90);
        write!(
            made_up.text,
            "\n[[disruption]]\nwhen = \"{when}\"\noptional = true\nafter = {after}\ndo = \"{undone}\"\n"
        )
        .unwrap();
    }
}
