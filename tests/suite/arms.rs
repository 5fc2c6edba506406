//! No arm goes through the cloth that it walks in: a poncho is about both upper arms like a tent, and
//! a ray from inside it crosses the cloth an odd number of times, outward, forward and backward.

use crate::specimen::scene;
use soen::{
    lattice::Lattice,
    math::Vec3,
    play::{Actor, ENTRANCE, dress, next},
    scene::Scene,
};

const PONCHO: &str = "[cloth]
fabric = \"a\"
outline_cm = [[-40, -40], [40, -40], [40, 40], [-40, 40]]
holes_cm = [[[-7, -8], [7, -8], [7, 8], [-7, 8]]]
spacing_cm = 4
centre_cm = [0, 0, 133]
[[body]]
robot = { person = \"woman-158\", motion = \"walk\" }
[animation]
frames = 5
frames_per_s = 6
";

#[test]
fn arms_that_swing_stay_inside_the_poncho() {
    let Scene {
        problem,
        cast,
        settings,
        frames,
        ..
    } = scene(PONCHO);
    let frames = frames.unwrap();
    let actor = cast.actors().next().unwrap();
    let mut last = dress(&problem, &cast, &settings, &mut |_| true).unwrap();
    let mut before = -ENTRANCE;
    for frame in 0..frames.count {
        let time = frames.time(frame);
        let times = [before, time];
        last = next(&problem, &cast, times, last.state(), &settings, &mut |_| {
            true
        })
        .unwrap();
        before = time;
        let (lattice, at) = (&last.lattice, &last.positions);
        for side in ["right", "left"] {
            let inside = |from: Vec3| crossings(lattice, at, &from).map(|count| count % 2);
            let arm = along(actor, time, &format!("{side}_upper_arm"), 0.5);
            assert_eq!(
                inside(arm),
                [1, 1, 1],
                "{side}, {time} s, {:?}",
                last.certificate
            );
            let knee = along(actor, time, &format!("{side}_shank"), 0.0);
            assert_eq!(inside(knee), [0, 0, 0], "{side}, {time} s");
        }
    }
}

/// The place at a part of a bone [cm].
fn along(actor: &Actor, time: f64, bone: &str, part: f64) -> Vec3 {
    let skeleton = actor.robot().skeleton();
    let bone = skeleton.bone(bone).unwrap();
    let frame = actor.frames(time)[bone];
    frame.translation.vector + frame.rotation * (skeleton.bones()[bone].vector * part)
}

/// How often rays outward, forward and backward cross the cloth.
fn crossings(lattice: &Lattice, at: &[Vec3], from: &Vec3) -> [usize; 3] {
    // A little askew, so that none meets an edge of a cell.
    let ways = [
        Vec3::new(from.x.signum(), 0.0013, 0.0017),
        Vec3::new(0.0011, -1.0, 0.0013),
        Vec3::new(0.0011, 1.0, 0.0013),
    ];
    ways.map(|way| {
        let faces = lattice
            .faces()
            .map(|nodes| nodes.map(|k| at[k as usize] - from));
        faces.filter(|face| meets(face, &way)).count()
    })
}

/// Whether a ray from the origin goes through a triangle: it turns the same way about all three sides.
fn meets([a, b, c]: &[Vec3; 3], way: &Vec3) -> bool {
    let turns = [(a, b), (b, c), (c, a)].map(|(from, to)| way.dot(&from.cross(to)) > 0.0);
    let through = turns[0] == turns[1] && turns[1] == turns[2];
    let normal = (b - a).cross(&(c - a));
    through && normal.dot(a) * normal.dot(way) > 0.0
}
