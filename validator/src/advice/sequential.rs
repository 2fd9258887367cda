//! Changes of a plan without times.
//!
//! A change after the failing step cannot help, and one before it helps only if it touches a want: it affects the
//! step that undid the want last, or adds one that achieves it. So the wants determine the candidates, those near the
//! failure first; [`Track`] says what a trial costs. There are several strategies (`WAYS`), each with its own share
//! of the budget and each offering its first change that works, so the reader can choose.

use super::bridge::{LONGEST, bridge};
use super::change::Repair;
use super::edit::Edit;
use super::instances::{Look, may_help, nearly, templates};
use super::sequential_case::{Case, takes};
use super::track::Track;
use super::trials::Trials;
use crate::plan::PlanRef;
use crate::verdict::Failure;
use pddl::model::{ActionId, ObjectId};
use pddl::{PlanStep, SequentialPlan};
use rustc_hash::FxHashMap;

/// How far from the failure changes are tried that are not known to affect it.
const NEAR: usize = 8;

/// The most candidates of one strategy.
const CANDIDATES: usize = 512;

/// A strategy that finds changes.
type Way = fn(&mut Track<'_, '_>, &Case) -> Vec<Edit>;

/// The strategies, the most likely to succeed first.
const WAYS: [Way; 8] =
    [other_argument, drops, inserts, moves, earlier_argument, far_moves, anything_near, bridge];

pub(super) fn repairs(trials: &mut Trials<'_, '_>, plan: &SequentialPlan, failure: &Failure) -> Vec<Repair> {
    let validator = trials.validator;
    let mut track = Track::new(&validator.prepared, &plan.steps, plan.steps.len());
    let case = Case::new(&mut track, failure);
    let mut found: Vec<Edit> = Vec::new();
    let share = trials.budget.steps / WAYS.len();
    let mut saved = 0;
    for way in WAYS {
        if found.len() >= trials.budget.offers {
            break;
        }
        track.left = share + saved;
        for edit in way(&mut track, &case) {
            if track.left == 0 || trials.is_spent() {
                break;
            }
            trials.budget.plans -= 1;
            if track.passes(&edit) && !is_known(&found, &edit, &plan.steps) {
                let changed = SequentialPlan::new(edit.applied(&plan.steps));
                track.left = track.left.saturating_sub(changed.steps.len());
                if validator.validate(PlanRef::from(&changed)).is_valid() {
                    found.push(edit);
                    break;
                }
            }
        }
        saved = track.left;
    }
    found.sort_by_key(Edit::size);
    found.into_iter().map(Edit::repair).collect()
}

/// Whether another change results in the same plan.
fn is_known(found: &[Edit], edit: &Edit, steps: &[PlanStep]) -> bool {
    let end = steps.len() + LONGEST + 1;
    found.iter().any(|other| {
        let from = other.first().min(edit.first());
        (from..end).all(|position| same(other.step(steps, position), edit.step(steps, position)))
    })
}

fn same(one: Option<&PlanStep>, other: Option<&PlanStep>) -> bool {
    match (one, other) {
        (Some(one), Some(other)) => one.action == other.action && one.arguments == other.arguments,
        (None, None) => true,
        _ => false,
    }
}

/// The failing step has a wrong argument.
fn other_argument(track: &mut Track<'_, '_>, case: &Case) -> Vec<Edit> {
    let index = case.fails;
    let Some(step) = track.steps.get(index) else { return Vec::new() };
    others(track, index, step)
}

fn others(track: &mut Track<'_, '_>, index: usize, step: &PlanStep) -> Vec<Edit> {
    track.go_to(index);
    let mut edits = Vec::new();
    let look = Look { prepared: track.prepared, state: track.state() };
    look.others(step, &mut |step| edits.push(Edit::Replace { index, step }));
    edits
}

/// The failing step is superfluous, or a step that undid a want.
fn drops(track: &mut Track<'_, '_>, case: &Case) -> Vec<Edit> {
    track.go_to(case.fails);
    let mut places: Vec<usize> = (case.fails < track.steps.len()).then_some(case.fails).into_iter().collect();
    places.extend(case.culprits());
    // Earlier steps undid a want, too, and each change of a fluent matters.
    let earlier = (0..track.taken().len())
        .rev()
        .filter(|&k| case.wants.list.iter().any(|want| takes(&track.taken()[k], want)));
    for place in earlier.take(CANDIDATES) {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    places.into_iter().map(Edit::Drop).collect()
}

/// A step is missing. It is tried at the last position of each run of positions at which it is applicable.
fn inserts(track: &mut Track<'_, '_>, case: &Case) -> Vec<Edit> {
    let templates = templates(track.prepared, &case.wants);
    if templates.is_empty() {
        return Vec::new();
    }
    let mut edits = Vec::new();
    let mut seen: FxHashMap<_, usize> = FxHashMap::default();
    for before in (case.earliest()..=case.fails).rev() {
        // A look costs about as much as a step.
        let Some(left) = track.left.checked_sub(templates.len()) else { break };
        track.left = left;
        track.go_to(before);
        let look = Look { prepared: track.prepared, state: track.state() };
        for template in &templates {
            look.steps(template, &mut |step| {
                let key = (step.action, step.arguments.clone());
                if seen.insert(key, before) != Some(before + 1) {
                    edits.push(Edit::Insert { before, steps: vec![step] });
                }
            });
        }
        if edits.len() >= CANDIDATES {
            break;
        }
    }
    edits
}

/// Steps are in the wrong order.
fn moves(track: &mut Track<'_, '_>, case: &Case) -> Vec<Edit> {
    let (fails, count) = (case.fails, track.steps.len());
    let mut edits = Vec::new();
    let prepared = track.prepared;
    let helps = |k: &usize| may_help(prepared, &case.wants.list, &track.steps[*k]);
    // Steps that could help, but come too late.
    let late: Vec<usize> = (fails + 1..count).filter(helps).take(NEAR).collect();
    for &step in &late {
        edits.push(Edit::Move { step, before: fails });
        edits.push(Edit::Swap { first: fails, second: step });
        edits.push(Edit::Move { step: fails, before: step + 1 });
    }
    for culprit in case.culprits() {
        edits.push(Edit::Move { step: culprit, before: (fails + 1).min(count) });
        if fails < count {
            edits.push(Edit::Swap { first: culprit, second: fails });
            edits.push(Edit::Move { step: fails, before: culprit });
        }
    }
    let near = |from: usize, to: usize| (from..to).rev().take(CANDIDATES);
    for &second in &late {
        edits.extend(near(case.earliest(), fails).map(|first| Edit::Swap { first, second }));
    }
    if fails < count {
        edits.extend((fails + 1..count).take(CANDIDATES).map(|second| Edit::Swap { first: fails, second }));
        edits.extend(near(0, fails).map(|first| Edit::Swap { first, second: fails }));
        edits.extend((fails + 2..=count).take(CANDIDATES).map(|before| Edit::Move { step: fails, before }));
        edits.extend(near(0, fails).map(|before| Edit::Move { step: fails, before }));
        edits.extend((fails + 1..count).take(CANDIDATES).map(|step| Edit::Move { step, before: fails }));
    }
    for culprit in case.culprits() {
        edits.extend(
            (culprit + 2..=fails).take(CANDIDATES).map(|before| Edit::Move { step: culprit, before }),
        );
        edits.extend(near(0, culprit).map(|before| Edit::Move { step: culprit, before }));
        edits.extend((fails..count).take(CANDIDATES).map(|second| Edit::Swap { first: culprit, second }));
    }
    edits
}

/// Two steps are exchanged over a long distance. With the right step instead of the failing one (or before it), the
/// plan is applicable up to the present position of that step, so the next failure shows where to search.
fn far_moves(track: &mut Track<'_, '_>, case: &Case) -> Vec<Edit> {
    let (fails, steps) = (case.fails, track.steps);
    if fails >= steps.len() {
        return Vec::new();
    }
    let mut places: FxHashMap<(ActionId, &[ObjectId]), Vec<usize>> = FxHashMap::default();
    let mut order = Vec::new();
    for (position, step) in steps.iter().enumerate().skip(fails + 1) {
        let key = (step.action, step.arguments.as_slice());
        let known = places.entry(key).or_default();
        if known.is_empty() {
            order.push(key);
        }
        known.push(position);
    }
    let mut edits = Vec::new();
    let until = |places: &[usize], place: usize| {
        let near = places.partition_point(|&position| position <= place);
        places[near.saturating_sub(NEAR)..near].iter().rev().copied().collect::<Vec<_>>()
    };
    for key in order {
        track.go_to(fails);
        let places = &places[&key];
        let step = &steps[places[0]];
        if edits.len() >= CANDIDATES || !track.take(step) {
            continue;
        }
        if let Some(place) = track.fails(&Edit::Replace { index: fails, step: step.clone() }) {
            edits.extend(until(places, place).into_iter().map(|second| Edit::Swap { first: fails, second }));
        }
        if let Some(place) = track.fails(&Edit::Insert { before: fails, steps: vec![step.clone()] }) {
            edits.extend(until(places, place).into_iter().map(|step| Edit::Move { step, before: fails }));
        }
    }
    if let Some(place) = track.fails(&Edit::Drop(fails)) {
        let around = (place.saturating_sub(NEAR).max(fails + 2)..=(place + 1).min(steps.len())).rev();
        edits.extend(around.map(|before| Edit::Move { step: fails, before }));
    }
    edits
}

/// A step before the failure has a wrong argument: with another one it could achieve a want, or not undo it.
fn earlier_argument(track: &mut Track<'_, '_>, case: &Case) -> Vec<Edit> {
    let mut edits = Vec::new();
    let earliest = case.earliest();
    for index in (earliest.saturating_sub(1)..case.fails.min(track.steps.len())).rev() {
        for step in nearly(track.prepared, &case.wants.list, &track.steps[index]) {
            edits.push(Edit::Replace { index, step });
        }
        if edits.len() >= CANDIDATES {
            break;
        }
    }
    for culprit in case.culprits().into_iter().take(NEAR) {
        let step = &track.steps[culprit];
        edits.extend(others(track, culprit, step));
    }
    edits
}

/// Changes near the failure that are not known to affect it.
fn anything_near(track: &mut Track<'_, '_>, case: &Case) -> Vec<Edit> {
    let (fails, count) = (case.fails, track.steps.len());
    let mut edits = Vec::new();
    for index in (fails.saturating_sub(NEAR)..fails.min(count)).rev() {
        edits.push(Edit::Drop(index));
        let step = &track.steps[index];
        edits.extend(others(track, index, step));
    }
    for first in (fails.saturating_sub(NEAR)..fails.min(count)).rev() {
        edits.extend((first + 1..count.min(fails + NEAR)).map(|second| Edit::Swap { first, second }));
        edits.extend((first + 2..=count.min(fails + NEAR)).map(|before| Edit::Move { step: first, before }));
    }
    edits
}
