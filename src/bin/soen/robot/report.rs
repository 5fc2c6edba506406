//! What is found on a body, as JSON (`soen-robot/1`).

use super::{Stood, args::RobotWish, cannot};
use crate::failure::Failure;
use serde::Serialize;
use soen::{math::Rotation, robot::Girth, skeleton::Bone};

#[derive(Serialize)]
pub(super) struct Report {
    format: &'static str,
    pub(super) person: String,
    pub(super) source: String,
    pub(super) pose: String,
    pub(super) measurements: Vec<Measured>,
    pub(super) girths: Vec<Measured>,
    pub(super) balls: usize,
    pub(super) deepest_trunk_dent_cm: f64,
    pub(super) joints: Vec<Joint>,
    /// Angles that anatomy does not allow.
    pub(super) beyond_limits: Vec<String>,
    pub(super) reaches: Vec<Reach>,
}

#[derive(Serialize)]
pub(super) struct Measured {
    pub(super) name: &'static str,
    pub(super) asked_cm: f64,
    pub(super) built_cm: f64,
}

#[derive(Serialize)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) angles: Vec<Angle>,
}

#[derive(Serialize)]
pub(super) struct Angle {
    pub(super) name: &'static str,
    pub(super) angle_deg: f64,
    pub(super) least_deg: f64,
    pub(super) greatest_deg: f64,
}

#[derive(Serialize)]
pub(super) struct Reach {
    pub(super) bone: String,
    pub(super) to_cm: [f64; 3],
    pub(super) miss_cm: f64,
    pub(super) reached: bool,
}

impl Report {
    pub(super) fn new(stood: &Stood<'_>, wish: &RobotWish) -> Result<Self, Failure> {
        let robot = stood.robot;
        let person = robot.measurements();
        let girth = |girth: Girth| Measured {
            name: girth.name(),
            asked_cm: person.girths.of(girth),
            built_cm: robot.girth(girth),
        };
        let reached = stood.reached.iter().map(|came| Reach {
            bone: came.bone.clone(),
            to_cm: came.to.into(),
            miss_cm: came.miss,
            reached: came.there,
        });
        let beyond = robot.skeleton().exceeded(&stood.posture);
        Ok(Self {
            format: "soen-robot/1",
            person: person.name.clone(),
            source: person.source.clone(),
            pose: wish.pose.display().to_string(),
            measurements: measurements(stood),
            girths: Girth::ALL.map(girth).into(),
            balls: robot.muscles().len(),
            deepest_trunk_dent_cm: robot.trunk_dent().map_err(cannot)?,
            joints: joints(stood),
            beyond_limits: beyond.iter().map(ToString::to_string).collect(),
            reaches: reached.collect(),
        })
    }

    pub(super) fn json(&self) -> String {
        // Structs of text and numbers cannot fail to become JSON.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

/// Stature and sitting height only of a body with a head.
fn measurements(stood: &Stood<'_>) -> Vec<Measured> {
    let (robot, person) = (stood.robot, stood.robot.measurements());
    let heights = [
        ("stature", person.stature, robot.stature()),
        (
            "sitting_height",
            person.sitting_height,
            robot.sitting_height(),
        ),
    ];
    let breadths = [
        (
            "shoulder_width",
            person.shoulder_width,
            robot.shoulder_width(),
        ),
        ("hip_width", person.hip_width, robot.hip_width()),
    ];
    let heights = heights.into_iter().filter(|_| person.head);
    let measured = heights
        .chain(breadths)
        .map(|(name, asked_cm, built_cm)| Measured {
            name,
            asked_cm,
            built_cm,
        });
    measured.collect()
}

/// The joints that turn, each with the angles that may change.
fn joints(stood: &Stood<'_>) -> Vec<Joint> {
    let bones = stood.robot.skeleton().bones().iter();
    let turned = bones.zip(&stood.posture.joints).skip(1);
    let turned = turned.filter(|(bone, _)| bone.joint.turns());
    let joint = |(bone, turn): (&Bone, &Rotation)| {
        let joint = &bone.joint;
        let angles = joint
            .angles
            .into_iter()
            .zip(joint.angles(turn))
            .zip(joint.limits);
        let angle = |((name, angle), [low, high]): ((_, f64), [f64; 2])| Angle {
            name,
            angle_deg: tidy(angle),
            least_deg: tidy(low),
            greatest_deg: tidy(high),
        };
        let may_change = |angle: &Angle| angle.least_deg < angle.greatest_deg;
        Joint {
            name: joint.name.clone(),
            angles: angles.map(angle).filter(may_change).collect(),
        }
    };
    turned.map(joint).collect()
}

/// Degrees without what the way through radians has left, and no negative zero.
fn tidy(angle: f64) -> f64 {
    (angle.to_degrees() * 1e6).round() / 1e6 + 0.0
}
