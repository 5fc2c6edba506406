//! Where an actor's joints are: BVH's own chain, in our frame and the file's unit.

use super::{Bvh, Channel, Mapping, RetargetError};
use crate::math::{Rotation, Vec3, turn};

/// An actor whose axes are found: z up, x to the left, facing −y when unturned.
pub(super) struct Actor<'b> {
    source: &'b Bvh,
    /// The file's axes in our frame.
    axes: [Vec3; 3],
    offsets: Vec<Vec3>,
    /// Whether a joint's positions stand in place of its offset.
    instead: Vec<bool>,
}

/// Where every joint is and how it is turned.
pub(super) struct Stance {
    pub(super) places: Vec<Vec3>,
    pub(super) turns: Vec<Rotation>,
}

impl<'b> Actor<'b> {
    /// Finds the axes: up from the ankles to the hips and the chest, left from the right hip and
    /// shoulder to the left ones, when the actor is unturned.
    pub(super) fn find(source: &'b Bvh, mapping: &Mapping) -> Result<Self, RetargetError> {
        let mut actor = Self {
            source,
            axes: [Vec3::x(), Vec3::y(), Vec3::z()],
            offsets: source
                .joints
                .iter()
                .map(|joint| joint.offset.into())
                .collect(),
            instead: positions_instead(source),
        };
        let rest = actor.unturned();
        let place = |bone: &str| {
            let joint = source.joint(&mapping.source(bone)?.joint)?;
            rest.places.get(joint).copied()
        };
        let needed = |bone: &'static str| place(bone).ok_or(RetargetError::NotMapped { bone });
        let [right, left] = [needed("right_thigh")?, needed("left_thigh")?];
        let knees = needed("right_shank")? + needed("left_shank")?;
        let chest = place("thorax").unwrap_or_else(|| (right + left) / 2.0);
        let up = (right + left + chest * 2.0 - knees * 2.0).normalize();
        let up = axis_nearest(&up, 0.0).ok_or(RetargetError::NoUp)?;
        let across = |right: Vec3, left: Vec3| {
            let level = left - right;
            (level - up * up.dot(&level)).normalize()
        };
        let shoulders = place("right_upper_arm").zip(place("left_upper_arm"));
        let shoulders = shoulders.map_or(Vec3::zeros(), |(right, left)| across(right, left));
        let to_left = (across(right, left) + shoulders).normalize();
        if !to_left.iter().all(|part| part.is_finite()) {
            return Err(RetargetError::NoLeft);
        }
        // An actor is built facing along an axis: shoulders that are a degree off say nothing.
        let to_left = axis_nearest(&to_left, 0.94).unwrap_or(to_left);
        let ahead = to_left.cross(&up);
        actor.axes = [0, 1, 2].map(|axis| Vec3::new(to_left[axis], -ahead[axis], up[axis]));
        actor.offsets = actor
            .offsets
            .iter()
            .map(|offset| actor.ours(offset))
            .collect();
        Ok(actor)
    }

    /// How many frames there are.
    pub(super) fn count(&self) -> usize {
        self.source.frames.len()
    }

    /// Frames to go through.
    pub(super) fn frames(&self) -> impl Iterator<Item = Stance> {
        self.source.frames.iter().map(|frame| self.at(frame))
    }

    /// As the file's offsets build it, every turn and position 0.
    pub(super) fn unturned(&self) -> Stance {
        self.at(&[])
    }

    /// From the joint to its first End Site, unturned.
    pub(super) fn end_site(&self, joint: usize) -> Option<Vec3> {
        let end = self.source.joints.get(joint)?.ends.first()?;
        Some(self.ours(&Vec3::from(*end)))
    }

    fn at(&self, frame: &[f64]) -> Stance {
        let count = self.source.joints.len();
        let mut stance = Stance {
            places: Vec::with_capacity(count),
            turns: Vec::with_capacity(count),
        };
        let mut values = frame.iter();
        let chain = self
            .source
            .joints
            .iter()
            .zip(&self.offsets)
            .zip(&self.instead);
        for ((joint, offset), instead) in chain {
            let (mut moved, mut turned) = (Vec3::zeros(), Rotation::identity());
            for channel in &joint.channels {
                let value = values.next().copied();
                match *channel {
                    Channel::Position(axis) => moved += self.axis(axis) * value.unwrap_or(0.0),
                    Channel::Rotation(axis) => {
                        let angle = value.unwrap_or(0.0).to_radians();
                        turned *= turn(&(self.axis(axis) * angle));
                    }
                }
            }
            if !instead || frame.is_empty() {
                moved += offset;
            }
            let parent = joint.parent;
            let of_parent = |list: &[Vec3]| parent.and_then(|parent| list.get(parent)).copied();
            let place = of_parent(&stance.places).unwrap_or_default();
            let frame = parent.and_then(|parent| stance.turns.get(parent)).copied();
            let frame = frame.unwrap_or_default();
            stance.places.push(place + frame * moved);
            stance.turns.push(frame * turned);
        }
        stance
    }

    fn axis(&self, axis: usize) -> Vec3 {
        self.axes.get(axis).copied().unwrap_or_default()
    }

    fn ours(&self, vector: &Vec3) -> Vec3 {
        let [x, y, z] = self.axes;
        x * vector.x + y * vector.y + z * vector.z
    }
}

/// Whether each joint's positions are written in place of its offset or beside it: programs differ.
/// In place of it where they are nearer to the offset than to 0 in the first frame.
fn positions_instead(source: &Bvh) -> Vec<bool> {
    let mut values = source.frames.first().into_iter().flatten();
    let nearer = source.joints.iter().map(|joint| {
        let mut place = None;
        for channel in &joint.channels {
            let value = values.next().copied().unwrap_or(0.0);
            if let Channel::Position(axis) = *channel {
                place.get_or_insert(Vec3::zeros())[axis] = value;
            }
        }
        let offset = Vec3::from(joint.offset);
        place.is_some_and(|place| (place - offset).norm() < place.norm())
    });
    nearer.collect()
}

/// The axis, or its opposite, that is nearest to a direction, where the cosine is above a least.
fn axis_nearest(direction: &Vec3, least: f64) -> Option<Vec3> {
    let longest = direction.iamax();
    let part = direction[longest];
    (part.abs() > least).then(|| {
        let mut axis = Vec3::zeros();
        axis[longest] = part.signum();
        axis
    })
}
