//! The poses of an `RT` link: one, or a ring of them with their times.
//!
//! Problem: where a ring keeps its newest pose is told by `rt_head_index`, but with some versions of cortex that is the
//! block which was written last, with others the one which is written next. Idea: the stamps tell it by themselves; the
//! head counts only where there are none. A stamp of zero is a block that was never written.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use dsr::{HORIZON, Time};

use super::file::Link;

/// The unit of the file's translations.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum CortexUnit {
    /// RoboComp's own.
    #[default]
    Millimetres,
    /// Some files'.
    Metres,
}

/// Numbers in a block.
const BLOCK: usize = 3;
/// Their stamps are milliseconds.
const MILLISECOND: u64 = 1_000_000;

/// The attributes of a link that say so.
pub(super) const NAMES: [&str; 6] = [
    "rt_translation",
    "rt_rotation_euler_xyz",
    "rt_timestamps",
    "rt_head_index",
    "translation",
    "rotation_euler_xyz",
];

/// Where a link says that its child is.
pub(super) enum Placed {
    Still(Isometry3<f64>),
    /// At these times, at least two, in their order.
    Moves(Vec<(Time, Isometry3<f64>)>),
}

/// What a link says; `None` if it has no three numbers each.
pub(super) fn placed(link: &Link, unit: CortexUnit) -> Option<Placed> {
    let numbers = |name: &str| link.attribute.get(name)?.value.numbers();
    // Older files have names without `rt_`.
    let either = |name: &str| numbers(name).or_else(|| numbers(name.strip_prefix("rt_")?));
    let (translation, rotation) = (either("rt_translation")?, either("rt_rotation_euler_xyz")?);
    let pose = |block: usize| {
        let at = block.checked_mul(BLOCK)?;
        let three = |list: &[f64]| -> Option<[f64; BLOCK]> { list.get(at..)?.get(..BLOCK)?.try_into().ok() };
        Some(isometry(three(&translation)?, three(&rotation)?, unit))
    };
    let head = link.attribute.get("rt_head_index").and_then(|head| whole(head.value.number()?));
    let head = head.map(|index| usize::try_from(index).unwrap_or(usize::MAX) / BLOCK);

    let stamps = numbers("rt_timestamps").unwrap_or_default();
    let stamped = stamps.iter().enumerate().filter_map(|(block, stamp)| {
        let time = whole(*stamp).filter(|stamp| *stamp > 0)?.checked_mul(MILLISECOND)?;
        Some((time, Some(block) == head, block, pose(block)?))
    });
    let mut stamped: Vec<_> = stamped.collect();
    stamped.sort_by_key(|&(time, is_head, block, _)| (time, is_head, block));
    let Some(&(newest, .., last)) = stamped.last() else {
        return pose(head.unwrap_or(0)).map(Placed::Still);
    };
    let mut moves: Vec<(Time, Isometry3<f64>)> = Vec::new();
    for (time, .., pose) in stamped {
        if time < newest.saturating_sub(HORIZON.0) {
            continue;
        }
        // Of two of one millisecond the later counts.
        moves.pop_if(|(before, _)| before.0 == time);
        moves.push((Time(time), pose));
    }
    // What was written once is a mounting, which holds at any time.
    Some(if moves.len() > 1 { Placed::Moves(moves) } else { Placed::Still(last) })
}

fn isometry(translation: [f64; 3], [a, b, c]: [f64; 3], unit: CortexUnit) -> Isometry3<f64> {
    let scale = if unit == CortexUnit::Millimetres { 1e-3 } else { 1.0 };
    let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    let rotation = about(Vector3::x_axis(), a) * about(Vector3::y_axis(), b) * about(Vector3::z_axis(), c);
    Isometry3::from_parts(Translation3::from(translation.map(|number| number * scale)), rotation)
}

/// A number that counts.
fn whole(number: f64) -> Option<u64> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative; saturates")]
    (number >= 0.0).then_some(number as u64)
}
