//! The poses of an `RT` link: a single one, or a ring of stamped ones.
//!
//! Problem: `rt_head_index` points to the newest pose of a ring; with some versions of cortex that is the block which
//! was written last, with others the block which is written next. Idea: the stamps alone give the order; the head
//! matters only without stamps. A block with a stamp of zero was never written.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use dsr::{HORIZON, Time};

use super::file::Link;

/// The unit of a file's translations.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum CortexUnit {
    /// The unit of RoboComp.
    #[default]
    Millimetres,
    /// The unit of some files.
    Metres,
}

/// Numbers in a block.
const BLOCK: usize = 3;
/// Stamps of cortex are milliseconds.
const MILLISECOND: u64 = 1_000_000;

/// The attributes of a link that describe its pose.
pub(super) const NAMES: [&str; 6] = [
    "rt_translation",
    "rt_rotation_euler_xyz",
    "rt_timestamps",
    "rt_head_index",
    "translation",
    "rotation_euler_xyz",
];

/// The pose of a link's child.
pub(super) enum Placed {
    Still(Isometry3<f64>),
    /// At least two poses, in order of time.
    Moves(Vec<(Time, Isometry3<f64>)>),
}

/// The pose of a link; `None` if translation or rotation is not three numbers.
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
        // Of two poses in one millisecond, the later one counts.
        moves.pop_if(|(before, _)| before.0 == time);
        moves.push((Time(time), pose));
    }
    // A single pose is a mounting, which holds at all times.
    Some(if moves.len() > 1 { Placed::Moves(moves) } else { Placed::Still(last) })
}

fn isometry(translation: [f64; 3], [a, b, c]: [f64; 3], unit: CortexUnit) -> Isometry3<f64> {
    let scale = if unit == CortexUnit::Millimetres { 1e-3 } else { 1.0 };
    let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    let rotation = about(Vector3::x_axis(), a) * about(Vector3::y_axis(), b) * about(Vector3::z_axis(), c);
    Isometry3::from_parts(Translation3::from(translation.map(|number| number * scale)), rotation)
}

/// A non-negative number as an integer.
fn whole(number: f64) -> Option<u64> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative; saturates")]
    (number >= 0.0).then_some(number as u64)
}
