//! A person as meshes: the muscles as balls (figure 5 of the paper), and the bones alone (figure 4).

use super::BodyMesh;
use crate::{
    math::{Pose, Vec3},
    robot::Robot,
    skeleton::Posture,
};
use core::f64::consts::PI;

/// Meridians and parallels of a ball: a body has some 400.
const ROUND: [u32; 2] = [32, 16];
/// Radii of bones and joints [cm].
const BONE: f64 = 0.9;
const JOINT: f64 = 1.8;

/// Every muscle as a ball, named after its bone, when the joints are turned as in `posture` and the
/// bones are at `frames`.
#[must_use]
pub fn muscle_meshes(robot: &Robot, posture: &Posture, frames: &[Pose]) -> Vec<BodyMesh> {
    let (bones, muscles) = (robot.skeleton().bones(), robot.muscles());
    let mut counts = vec![0_usize; bones.len()];
    let placed = robot.balls(posture, frames);
    let named = placed.iter().zip(muscles).map(|(placed, muscle)| {
        let count = counts.get_mut(muscle.bone).map_or(0, |count| {
            *count += 1;
            *count
        });
        let bone = bones.get(muscle.bone).map_or("", |bone| &bone.name);
        ball(format!("{bone}_{count}"), &placed.centre, placed.radius)
    });
    named.collect()
}

/// Every bone as a rod, with a ball at either end, when the bones are at `frames`.
#[must_use]
pub fn bone_meshes(robot: &Robot, frames: &[Pose]) -> Vec<BodyMesh> {
    let bones = robot.skeleton().bones().iter().zip(frames);
    let drawn = bones.flat_map(|(bone, frame)| {
        let ends = [frame.translation.vector, bone.end(frame)];
        let name = |part: &str| format!("{}_{part}", bone.name);
        [
            rod(name("rod"), &ends),
            ball(name("joint"), &ends[0], JOINT),
            ball(name("end"), &ends[1], JOINT),
        ]
    });
    drawn.collect()
}

/// A ball by meridians and parallels, closed, its poles along z.
fn ball(name: String, centre: &Vec3, radius: f64) -> BodyMesh {
    let [round, rings] = ROUND;
    let mut vertices = vec![centre + Vec3::z() * radius];
    for ring in 1..rings {
        let (out, up) = libm::sincos(PI * f64::from(ring) / f64::from(rings));
        for step in 0..round {
            let (sine, cosine) = libm::sincos(2.0 * PI * f64::from(step) / f64::from(round));
            vertices.push(centre + Vec3::new(out * cosine, out * sine, up) * radius);
        }
    }
    vertices.push(centre - Vec3::z() * radius);
    let last = 1 + round * (rings - 1);
    let at = |ring: u32, step: u32| 1 + (ring - 1) * round + step % round;
    let mut triangles = Vec::new();
    for step in 0..round {
        triangles.push([0, at(1, step), at(1, step + 1)]);
        for ring in 1..rings - 1 {
            let (a, b) = (at(ring, step), at(ring, step + 1));
            let (c, d) = (at(ring + 1, step), at(ring + 1, step + 1));
            triangles.extend([[a, c, b], [b, c, d]]);
        }
        triangles.push([last, at(rings - 1, step + 1), at(rings - 1, step)]);
    }
    BodyMesh {
        name,
        vertices,
        triangles,
    }
}

/// A cylinder between two points, open where balls close it.
fn rod(name: String, [start, end]: &[Vec3; 2]) -> BodyMesh {
    let along = (end - start).try_normalize(1e-9).unwrap_or_else(Vec3::z);
    let least = if along.x.abs() < 0.7 {
        Vec3::x()
    } else {
        Vec3::y()
    };
    let one = along.cross(&least).normalize();
    let other = along.cross(&one);
    let round = ROUND[0];
    let mut rod = BodyMesh {
        name,
        ..BodyMesh::default()
    };
    for step in 0..round {
        let (sine, cosine) = libm::sincos(2.0 * PI * f64::from(step) / f64::from(round));
        let out = (one * cosine + other * sine) * BONE;
        rod.vertices.extend([start + out, end + out]);
        let (a, b) = (2 * step, 2 * ((step + 1) % round));
        rod.triangles.extend([[a, b, a + 1], [b, b + 1, a + 1]]);
    }
    rod
}
