//! What the pictures show: the balls, and the bones as in figure 4 of the paper.

use super::{Stood, args::Side};
use soen::{
    lattice::Lattice,
    math::Vec3,
    output::{self, BodyMesh, ClothMesh, View},
};
use std::f64::consts::PI;

/// Width and height of pictures [pixels].
const SIZE: [u32; 2] = [750, 1000];
/// Meridians and parallels of a ball.
const ROUND: [u32; 2] = [32, 16];
/// Radii of bones and joints [cm].
const BONE: f64 = 0.9;
const JOINT: f64 = 1.8;
/// The camera stands at this angle to the side of −y [rad]; figures turn before it.
const CAMERA: f64 = 0.52;

/// Every muscle as a ball, named after its bone.
pub(super) fn balls(stood: &Stood<'_>) -> Vec<BodyMesh> {
    let robot = stood.robot;
    let (bones, muscles) = (robot.skeleton().bones(), robot.muscles());
    let mut counts = vec![0_usize; bones.len()];
    let placed = robot.balls(&stood.posture, &stood.frames);
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

/// Every bone as a rod, with a ball at either end.
pub(super) fn bones(stood: &Stood<'_>) -> Vec<BodyMesh> {
    let bones = stood.robot.skeleton().bones().iter().zip(&stood.frames);
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

/// A PNG file of bodies alone, seen from a side.
pub(super) fn picture(mut bodies: Vec<BodyMesh>, side: Side) -> Vec<u8> {
    let turned = match side {
        Side::Oblique => 0.0,
        Side::Front => CAMERA,
        Side::Left => CAMERA - 0.5 * PI,
        Side::Back => CAMERA + PI,
    };
    let (sine, cosine) = libm::sincos(turned);
    for vertex in bodies.iter_mut().flat_map(|body| &mut body.vertices) {
        let (x, y) = (vertex.x, vertex.y);
        (vertex.x, vertex.y) = (cosine * x - sine * y, sine * x + cosine * y);
    }
    let nothing = ClothMesh {
        lattice: &Lattice::default(),
        positions: &[],
    };
    let view = View {
        width: SIZE[0],
        height: SIZE[1],
        ..View::default()
    };
    output::picture(&nothing, &bodies, &view)
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
