//! The poses of a moving frame in its parent: stamped samples of the last ten seconds.
//!
//! Problem: sensors are late. A caller asks where the camera was when a picture was taken, and the answer lies between
//! two poses. Idea: a list in order of time, in chunks behind `Arc`: a write copies one chunk while a snapshot holds
//! it, a look-up is two binary searches and an interpolation. Translations are interpolated linearly, rotations along
//! the shorter great circle (slerp). Invariant: no chunk is empty, times rise strictly, and a time outside the samples
//! has no pose. Samples older than [`HORIZON`] are invisible at once, and are freed a chunk at a time.
//!
//! Source: Foote, "tf: the transform library", TePRA 2013 (the buffer and its length); Shoemake, "Animating rotation
//! with quaternion curves", SIGGRAPH 1985 (slerp); Eberly, "A fast and accurate algorithm for computing slerp", Journal
//! of Graphics, GPU, and Game Tools 15, 2011 (the series).

use std::sync::Arc;

use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion};

use crate::id::Time;
use crate::pose::Pose;

/// How far the samples of a moving frame reach back from the newest one: ten seconds.
pub const HORIZON: Time = Time(10_000_000_000);

/// The most samples in a chunk.
const CHUNK: usize = 32;

#[derive(Debug, Clone)]
pub(crate) struct Sample {
    pub(crate) time: Time,
    pub(crate) pose: Pose,
}

/// Chunks with the time of their first sample, ascending; never empty.
#[derive(Debug, Clone)]
pub(crate) struct Track {
    chunks: Vec<(Time, Arc<Vec<Sample>>)>,
    newest: Time,
}

impl Track {
    pub(crate) fn new(time: Time, pose: Pose) -> Self {
        Self { chunks: vec![(time, Arc::new(vec![Sample { time, pose }]))], newest: time }
    }

    /// The time of the newest sample.
    pub(crate) fn newest(&self) -> Time {
        self.newest
    }

    /// Samples before this time are invisible.
    pub(crate) fn horizon(&self) -> Time {
        Time(self.newest.0.saturating_sub(HORIZON.0))
    }

    /// The visible samples, in order of time.
    pub(crate) fn samples(&self) -> impl Iterator<Item = &Sample> {
        let start = self.horizon();
        self.chunks.iter().flat_map(|(_, chunk)| chunk.iter()).filter(move |sample| sample.time >= start)
    }

    /// The sample of exactly this time.
    pub(crate) fn sample(&self, time: Time) -> Option<&Pose> {
        let chunk = &self.chunks[self.chunk_of(time)].1;
        chunk.binary_search_by_key(&time, |sample| sample.time).ok().map(|at| &chunk[at].pose)
    }

    fn chunk_of(&self, time: Time) -> usize {
        self.chunks.partition_point(|(first, _)| *first <= time).saturating_sub(1)
    }

    /// Inserts a sample. Returns the old one of the same time, if there was one.
    pub(crate) fn put(&mut self, time: Time, pose: Pose) -> Option<Pose> {
        let at = self.chunk_of(time);
        self.newest = self.newest.max(time);
        let is_last = at + 1 == self.chunks.len();
        let (first, chunk) = &mut self.chunks[at];
        let place = match chunk.binary_search_by_key(&time, |sample| sample.time) {
            Ok(place) => return Some(std::mem::replace(&mut Arc::make_mut(chunk)[place].pose, pose)),
            Err(place) => place,
        };
        if chunk.len() < CHUNK {
            Arc::make_mut(chunk).insert(place, Sample { time, pose });
            *first = (*first).min(time);
        } else if is_last && place == chunk.len() {
            let mut fresh = Vec::with_capacity(CHUNK);
            fresh.push(Sample { time, pose });
            self.chunks.push((time, Arc::new(fresh)));
        } else {
            let chunk = Arc::make_mut(chunk);
            chunk.insert(place, Sample { time, pose });
            *first = (*first).min(time);
            let half = chunk.split_off(CHUNK / 2);
            self.chunks.insert(at + 1, (half[0].time, Arc::new(half)));
        }
        None
    }

    /// Removes the sample of exactly this time. It must not be the only one.
    pub(crate) fn take(&mut self, time: Time) {
        let at = self.chunk_of(time);
        let (first, chunk) = &mut self.chunks[at];
        if let Ok(place) = chunk.binary_search_by_key(&time, |sample| sample.time) {
            Arc::make_mut(chunk).remove(place);
            match chunk.first() {
                Some(sample) => *first = sample.time,
                None => _ = self.chunks.remove(at),
            }
        }
        if let Some(last) = self.chunks.last().and_then(|(_, chunk)| chunk.last()) {
            self.newest = last.time;
        }
    }

    /// Frees the chunks whose samples are all invisible.
    pub(crate) fn evict(&mut self) {
        let start = self.horizon();
        let gone = self.chunks.partition_point(|(first, _)| *first <= start).saturating_sub(1);
        self.chunks.drain(..gone);
    }

    #[cfg(test)]
    pub(crate) fn chunks(&self) -> usize {
        self.chunks.len()
    }

    /// Whether a chunk can be freed.
    pub(crate) fn has_invisible(&self) -> bool {
        self.chunks.get(1).is_some_and(|(first, _)| *first <= self.horizon())
    }

    /// The position in a chunk of the first sample after a time. Sensors are regular, so the search begins where the
    /// sample would be if they were evenly spaced.
    fn after(&self, index: usize, time: Time) -> usize {
        let (first, chunk) = &self.chunks[index];
        let end = self.chunks.get(index + 1).map_or(self.newest.0.saturating_add(1), |(next, _)| next.0);
        let (span, into) = (end.saturating_sub(first.0).max(1), time.0.saturating_sub(first.0));
        let guess = usize::try_from(into.saturating_mul(chunk.len() as u64) / span).unwrap_or(0);
        let after = |at: usize| chunk.get(at).is_none_or(|sample| sample.time > time);
        for at in [guess + 1, guess] {
            if at <= chunk.len() && after(at) && (at == 0 || !after(at - 1)) {
                return at;
            }
        }
        chunk.partition_point(|sample| sample.time <= time)
    }

    /// The pose at a time, or the first and the last time for which there is one.
    pub(crate) fn at(&self, time: Time) -> Result<Isometry3<f64>, (Time, Time)> {
        Ok(match self.around(time)? {
            Around::Exactly(pose) => pose.transform,
            Around::Between(a, b, part) => between(&a.transform, &b.transform, part),
        })
    }

    /// Like [`Track::at`], with the covariance: between two samples, the mean of theirs, weighted by time.
    pub(crate) fn pose_at(&self, time: Time) -> Result<Pose, (Time, Time)> {
        Ok(match self.around(time)? {
            Around::Exactly(pose) => pose.clone(),
            Around::Between(a, b, part) => {
                let transform = between(&a.transform, &b.transform, part);
                let known = a.covariance.as_ref().zip(b.covariance.as_ref());
                Pose { transform, covariance: known.and_then(|(a, b)| a.towards(b, part)).map(Arc::new) }
            }
        })
    }

    fn around(&self, time: Time) -> Result<Around<'_>, (Time, Time)> {
        let outside = || (self.samples().next().map_or(self.newest, |first| first.time), self.newest);
        if time > self.newest || time < self.horizon() {
            return Err(outside());
        }
        let index = self.chunk_of(time);
        let chunk = &self.chunks[index].1;
        let after = self.after(index, time);
        let Some(before) = after.checked_sub(1).map(|at| &chunk[at]) else { return Err(outside()) };
        if before.time == time {
            return Ok(Around::Exactly(&before.pose));
        }
        let next = chunk.get(after).or_else(|| self.chunks.get(index + 1)?.1.first());
        match next {
            // If the earlier sample is beyond the horizon, the time between the two counts as beyond it too.
            Some(next) if before.time >= self.horizon() => {
                #[expect(clippy::cast_precision_loss, reason = "two samples lie at most ten seconds apart")]
                let part = (time.0 - before.time.0) as f64 / (next.time.0 - before.time.0) as f64;
                Ok(Around::Between(&before.pose, &next.pose, part))
            }
            _ => Err(outside()),
        }
    }
}

/// The samples around a time.
enum Around<'t> {
    Exactly(&'t Pose),
    /// The two samples, and the fraction of the way from the first to the second.
    Between(&'t Pose, &'t Pose, f64),
}

/// The pose at the fraction `part` of the way from `a` to `b`.
pub(crate) fn between(a: &Isometry3<f64>, b: &Isometry3<f64>, part: f64) -> Isometry3<f64> {
    let translation = a.translation.vector.lerp(&b.translation.vector, part);
    Isometry3::from_parts(Translation3::from(translation), slerp(&a.rotation, &b.rotation, part))
}

/// Interpolates along the shorter great circle. The weights are `sin(tθ)/sin θ`. For the small angles between
/// successive poses they are a short product series in `1 - cos θ`, without a root, a division or a call of the
/// mathematical library; its factors are independent, so the processor computes them in parallel.
fn slerp(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>, part: f64) -> UnitQuaternion<f64> {
    let dot = a.coords.dot(&b.coords);
    let (dot, sign) = if dot < 0.0 { (-dot, -1.0) } else { (dot, 1.0) };
    let (first, second) = if dot > SMALL {
        (weight(1.0 - part, 1.0 - dot), weight(part, 1.0 - dot))
    } else {
        let theta = dot.min(1.0).acos();
        let whole = theta.sin();
        (((1.0 - part) * theta).sin() / whole, (part * theta).sin() / whole)
    };
    let coords = a.coords * first + b.coords * (second * sign);
    Unit::new_unchecked(Quaternion::from(coords))
}

/// The cosine above which six factors are exact to the last bit.
const SMALL: f64 = 0.99;

/// `sin(tθ)/sin θ` of `1 - cos θ`: `t·(1 + b₁·(1 + b₂·(1 + …)))` with `bᵢ = (i²- t²)/(i·(2i + 1))·(1 - cos θ)`.
fn weight(t: f64, less: f64) -> f64 {
    const SQUARES: [f64; 6] = [1.0, 4.0, 9.0, 16.0, 25.0, 36.0];
    const OVER: [f64; 6] = [1.0 / 3.0, 1.0 / 10.0, 1.0 / 21.0, 1.0 / 36.0, 1.0 / 55.0, 1.0 / 78.0];
    let t2 = t * t;
    let factor = |at: usize| (SQUARES[at] - t2) * OVER[at] * less;
    t * (0..6).rev().fold(1.0, |sum, at| 1.0 + factor(at) * sum)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use nalgebra::Vector3;
    use proptest::prelude::*;

    use super::*;

    fn pose(at: u64) -> Pose {
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let at = at as f64;
        Isometry3::new(Vector3::new(at, 0.0, -at), Vector3::new(0.0, at / 7.0, 0.3)).into()
    }

    proptest! {
        /// A track is a sorted map of the samples put and not taken.
        #[test]
        fn a_track_is_a_map(first in 0_u64..2000, edits in prop::collection::vec((0_u64..2000, any::<bool>()), 0..400)) {
            let mut track = Track::new(Time(first), pose(first));
            let mut model = BTreeMap::from([(first, pose(first))]);
            let held = track.clone();
            for (time, put) in edits {
                if put {
                    let old = track.put(Time(time), pose(time + 1));
                    prop_assert_eq!(old, model.insert(time, pose(time + 1)));
                } else if model.len() > 1 {
                    track.take(Time(time));
                    model.remove(&time);
                }
                track.evict();
                let seen: Vec<_> = track.samples().map(|s| (s.time.0, s.pose.clone())).collect();
                prop_assert_eq!(&seen, &model.iter().map(|(t, p)| (*t, p.clone())).collect::<Vec<_>>());
                let (start, end) = (*model.keys().next().unwrap(), *model.keys().last().unwrap());
                prop_assert_eq!(track.newest(), Time(end));
                for asked in [time, start, end, (start + end) / 2] {
                    let before = model.range(..=asked).next_back();
                    let after = model.range(asked..).next();
                    match (before, after) {
                        (Some((t0, a)), Some((t1, b))) => {
                            let found = track.at(Time(asked)).unwrap();
                            #[expect(clippy::cast_precision_loss, reason = "small")]
                            let part = if t0 == t1 { 0.0 } else { (asked - t0) as f64 / (t1 - t0) as f64 };
                            let wanted = a.transform.lerp_slerp(&b.transform, part);
                            prop_assert!((found.translation.vector - wanted.translation.vector).norm() < 1e-9);
                            prop_assert!(found.rotation.angle_to(&wanted.rotation) < 1e-7);
                            prop_assert!((found.rotation.norm() - 1.0).abs() < 1e-12);
                        }
                        _ => prop_assert_eq!(track.at(Time(asked)), Err((Time(start), Time(end)))),
                    }
                }
            }
            prop_assert_eq!(held.samples().count(), 1, "a copy never changes");
        }

        /// The series agrees with the functions, also at the cosine where one replaces the other.
        #[test]
        fn slerp_is_exact(angle in prop_oneof![0.0_f64..3.1, 0.0_f64..0.3], part in 0.0_f64..1.0) {
            let axis = Vector3::y_axis();
            let (a, b) = (UnitQuaternion::identity(), UnitQuaternion::from_axis_angle(&axis, angle));
            let wanted = UnitQuaternion::from_axis_angle(&axis, angle * part);
            prop_assert!((slerp(&a, &b, part).coords - wanted.coords).norm() < 1e-14);
            let other = Unit::new_unchecked(-b.into_inner());
            prop_assert!((slerp(&a, &other, part).coords - wanted.coords).norm() < 1e-14);
        }
    }

    #[test]
    fn samples_older_than_the_horizon_are_gone() {
        let mut track = Track::new(Time(0), pose(0));
        for at in 1..=2_000 {
            track.put(Time(at * 10_000_000), pose(at));
            track.evict();
        }
        assert_eq!(track.samples().count(), 1_001);
        assert!(track.chunks.len() <= 1_001 / CHUNK + 2, "chunks are freed");
        assert_eq!(track.at(Time(9_999_999_999)), Err((Time(10_000_000_000), Time(20_000_000_000))));
        assert_eq!(track.at(Time(10_000_000_000)), Ok(pose(1_000).transform));
    }
}
