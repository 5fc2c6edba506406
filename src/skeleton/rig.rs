//! Where every bone is: rapier's multibody carries the turn of one to all beyond it.

use super::{Bone, Exceeded, Posture, Skeleton};
use crate::math::{Pose, Rotation, Vec3, turned};
use rapier3d::{
    dynamics::{
        MultibodyJointHandle, MultibodyJointSet, RigidBodyBuilder, RigidBodyHandle, RigidBodySet,
        SphericalJointBuilder,
    },
    math::{Jacobian, Pose as RapierPose, Rotation as RapierRotation, Vector},
};

impl Skeleton {
    /// Where every bone is in a posture: its origin is its joint [cm], its turn is against the
    /// standing posture. In the order of the bones.
    ///
    /// A joint that the posture leaves out is not turned; what it lists beyond the last bone is
    /// not used. Limits are not looked at: [`exceeded`](Self::exceeded) does.
    #[must_use]
    pub fn stand(&self, posture: &Posture) -> Vec<Pose> {
        let mut rig = Rig::new(self);
        rig.pose(posture);
        (0..self.bones().len())
            .map(|bone| rig.place(bone))
            .collect()
    }

    /// Every angle of a posture that anatomy does not allow.
    #[must_use]
    pub fn exceeded(&self, posture: &Posture) -> Vec<Exceeded> {
        let bones = self.bones().iter().zip(&posture.joints).skip(1);
        bones
            .flat_map(|(bone, turn)| bone.joint.exceeded(bone.joint.angles(turn)))
            .collect()
    }

    /// Height of the lowest joint or end of a bone [cm]: standing, that of the soles.
    #[must_use]
    pub fn lowest(&self, posture: &Posture) -> f64 {
        let poses = self.stand(posture);
        let ends = self.bones().iter().zip(&poses);
        ends.flat_map(|(bone, pose)| [pose.translation.z, bone.end(pose).z])
            .fold(f64::INFINITY, f64::min)
    }

    /// The posture moved up or down to the ground: its lowest joint or end comes to where the
    /// lowest one is when the person stands.
    #[must_use]
    pub fn grounded(&self, posture: &Posture) -> Posture {
        let mut grounded = posture.clone();
        let rise = self.lowest(&Posture::standing(self)) - self.lowest(posture);
        grounded.root.translation.z += rise;
        grounded
    }
}

impl Bone {
    /// Where its end is, when its origin and turn are a pose [cm].
    #[must_use]
    pub fn end(&self, pose: &Pose) -> Vec3 {
        pose.translation.vector + pose.rotation * self.vector
    }
}

/// A multibody with a link for each bone, in their order, and a spherical joint for each but the
/// first. It has no masses and takes no steps: rapier only carries turns along it.
pub(super) struct Rig {
    bodies: RigidBodySet,
    joints: MultibodyJointSet,
    links: Vec<RigidBodyHandle>,
    /// Any of its joints: by it rapier finds the whole; none where there is but one bone.
    joint: Option<MultibodyJointHandle>,
}

impl Rig {
    /// The bones as they stand.
    pub(super) fn new(skeleton: &Skeleton) -> Self {
        let mut rig = Self {
            bodies: RigidBodySet::new(),
            joints: MultibodyJointSet::new(),
            links: Vec::new(),
            joint: None,
        };
        for bone in skeleton.bones() {
            rig.add(bone, skeleton.bones());
        }
        rig
    }

    fn add(&mut self, bone: &Bone, bones: &[Bone]) {
        // A root that physics would move is given six coordinates; a kinematic one has none.
        let body = match bone.parent {
            None => RigidBodyBuilder::kinematic_position_based(),
            Some(_) => RigidBodyBuilder::dynamic(),
        };
        let link = self.bodies.insert(body.can_sleep(false));
        self.links.push(link);
        let Some(parent) = bone.parent else { return };
        let (Some(&holder), Some(holding)) = (self.links.get(parent), bones.get(parent)) else {
            return;
        };
        let anchor = if bone.at_base {
            Vector::ZERO
        } else {
            holding.vector.into()
        };
        let joint = SphericalJointBuilder::new().local_anchor1(anchor);
        self.joint = self.joints.insert_kinematic(holder, link, joint, false);
    }

    /// Turns every joint as a posture says; one that it leaves out is not turned.
    pub(super) fn pose(&mut self, posture: &Posture) {
        let root = self.links.first();
        if let Some(root) = root.and_then(|root| self.bodies.get_mut(*root)) {
            root.set_position(in_rapier(&posture.root), false);
        }
        let Some((multibody, _)) = self.joint.and_then(|joint| self.joints.get_mut(joint)) else {
            return;
        };
        // Rapier's coordinates can be added to, not set: it is told the way from the present turn.
        let mut way = vec![0.0; multibody.ndofs()];
        for (index, link) in multibody.links().enumerate().skip(1) {
            let joint = posture.joints.get(index);
            let present = from_rapier(&link.joint().joint_rot());
            let turn = turned(&(joint.unwrap_or(&Rotation::identity()) * present.inverse()));
            let slots = way.iter_mut().skip(link.assembly_id());
            slots.zip(&turn).for_each(|(slot, part)| *slot = *part);
        }
        multibody.apply_displacements(&way);
        multibody.forward_kinematics(&self.bodies, true);
    }

    /// Where a bone is.
    pub(super) fn place(&self, bone: usize) -> Pose {
        let multibody = self.joint.and_then(|joint| self.joints.get(joint));
        let link = multibody.and_then(|(multibody, _)| multibody.link(bone));
        let place = match link {
            Some(link) => Some(*link.local_to_world()),
            None => {
                let body = self.links.get(bone).and_then(|link| self.bodies.get(*link));
                body.map(|body| *body.position())
            }
        };
        place.map_or(Pose::identity(), |place| {
            let origin: Vec3 = place.translation.into();
            Pose::from_parts(origin.into(), from_rapier(&place.rotation))
        })
    }

    /// How a bone's origin moves [cm/rad], rows 0 to 2, and how the bone turns, rows 3 to 5, when
    /// joints turn about the axes of their parents.
    pub(super) fn jacobian(&self, bone: usize) -> Option<&Jacobian<f64>> {
        let (multibody, _) = self.joints.get(self.joint?)?;
        multibody.link(bone)?;
        Some(multibody.body_jacobian(bone))
    }

    /// The first of the three columns of it that belong to the joint at a bone's start.
    pub(super) fn column(&self, bone: usize) -> Option<usize> {
        let (multibody, _) = self.joints.get(self.joint?)?;
        Some(multibody.link(bone)?.assembly_id())
    }
}

fn in_rapier(pose: &Pose) -> RapierPose {
    let turn = pose.rotation.coords;
    RapierPose {
        translation: pose.translation.vector.into(),
        rotation: RapierRotation::from_xyzw(turn.x, turn.y, turn.z, turn.w),
    }
}

/// Of length 1 to the last bit or two, whatever rapier's products have lost.
fn from_rapier(turn: &RapierRotation) -> Rotation {
    Rotation::new_normalize(nalgebra::Quaternion::new(turn.w, turn.x, turn.y, turn.z))
}
