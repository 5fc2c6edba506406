//! Claims about whole bodies: three people, standing and bent.

#![allow(
    clippy::print_stdout,
    reason = "the figures are told to who asks with --nocapture"
)]

use super::{
    bones::Side,
    field::Field,
    levels::Levels,
    muscles::{Flesh, Group, Limb},
    sample::everyone,
    tape::Section,
    *,
};
use crate::{
    body::{Mesh, Nature, Part, Shape},
    math::{Pose, Rotation, Vec3},
    skeleton::{Posture, Skeleton},
};

/// Where bones are in a posture, turn by turn.
fn frames(skeleton: &Skeleton, posture: &Posture) -> Vec<Pose> {
    let mut frames: Vec<Pose> = Vec::new();
    for (bone, turn) in skeleton.bones().iter().zip(&posture.joints) {
        let Some(parent) = bone.parent else {
            frames.push(posture.root);
            continue;
        };
        let frame = frames[parent];
        let at = if bone.at_base {
            Vec3::zeros()
        } else {
            skeleton.bones()[parent].vector
        };
        let start = frame.translation.vector + frame.rotation * at;
        frames.push(Pose::from_parts(start.into(), frame.rotation * turn));
    }
    frames
}

/// One arm up, the other bent, one leg raised, the trunk turned.
fn dancing(skeleton: &Skeleton) -> Posture {
    let joints = [
        ("left_shoulder", [0.0, 70.0, 0.0]),
        ("left_elbow", [120.0, 0.0, 0.0]),
        ("right_clavicle", [0.0, 30.0, 0.0]),
        ("right_shoulder", [0.0, 130.0, 0.0]),
        ("left_hip", [80.0, 20.0, 0.0]),
        ("left_knee", [90.0, 0.0, 0.0]),
        ("chest", [10.0, 10.0, 20.0]),
    ];
    turned(skeleton, &joints)
}

/// Standing but for some joints, turned by angles [degrees] within their limits.
fn turned(skeleton: &Skeleton, joints: &[(&str, [f64; 3])]) -> Posture {
    let mut posture = Posture::standing(skeleton);
    for (joint, degrees) in joints {
        let bone = skeleton.joint(joint).unwrap();
        let angles = degrees.map(f64::to_radians);
        assert_eq!(skeleton.bones()[bone].joint.exceeded(angles).count(), 0);
        posture.joints[bone] = skeleton.bones()[bone].joint.rotation(angles);
    }
    posture
}

#[test]
fn the_tape_reads_what_was_asked() {
    for person in everyone() {
        let robot = Robot::new(&person).unwrap();
        println!("{}: {} balls", person.name, robot.muscles().len());
        for girth in Girth::ALL {
            let (asked, built) = (person.girths.of(girth), robot.girth(girth));
            println!("  {girth} {built:.2} cm, asked {asked} cm");
            assert!((built - asked).abs() < 1.0, "{girth}");
        }
    }
}

/// Thin and stout people: all girths and the hips' breadth times a factor.
#[test]
fn thin_and_stout_people_have_bodies_too() {
    for person in everyone() {
        for factor in [0.85, 1.15, 1.3, 1.5] {
            let mut other = person.clone();
            other.hip_width *= factor;
            let girths = &mut other.girths;
            for girth in [
                &mut girths.neck,
                &mut girths.bust,
                &mut girths.under_bust,
                &mut girths.waist,
                &mut girths.hip,
                &mut girths.thigh,
                &mut girths.knee,
                &mut girths.calf,
                &mut girths.ankle,
                &mut girths.upper_arm,
                &mut girths.elbow,
                &mut girths.wrist,
            ] {
                *girth *= factor;
            }
            let robot = Robot::new(&other);
            println!("{} × {factor}: {:?}", person.name, robot.as_ref().err());
            let robot = robot.unwrap();
            for girth in Girth::ALL {
                let (asked, built) = (other.girths.of(girth), robot.girth(girth));
                if (built - asked).abs() > 0.1 {
                    println!("  {girth} {built:.2} cm, not {asked:.2} cm");
                }
                assert!((built - asked).abs() < 1.0, "{girth}");
            }
        }
    }
}

#[test]
fn height_and_breadth_are_what_was_asked() {
    for person in everyone() {
        let robot = Robot::new(&person).unwrap();
        let (balls, levels) = (robot.standing(), Levels::of(&person).unwrap());
        let of = |flesh: &[Flesh]| -> Vec<Ball> {
            robot
                .muscles
                .groups(flesh)
                .map(|muscle| balls[muscle])
                .collect()
        };
        let top = balls
            .iter()
            .map(|b| b.centre.z + b.radius)
            .fold(0.0, f64::max);
        let sole = balls
            .iter()
            .map(|b| b.centre.z - b.radius)
            .fold(9.0, f64::min);
        // Between the legs: where the trunk ends in the plane x = 0.
        let under = |ball: &Ball| {
            let square = ball.radius * ball.radius - ball.centre.x * ball.centre.x;
            (square > 0.0).then(|| ball.centre.z - square.sqrt())
        };
        let seat = of(&[Flesh::Trunk])
            .iter()
            .filter_map(under)
            .fold(999.0, f64::min);
        // How far to the side the trunk and the tops of the thighs reach at the hip's level.
        let level = levels.crotch + 0.11 * (levels.acromion - levels.crotch);
        let reach = |ball: &Ball| {
            let square = ball.radius * ball.radius - (ball.centre.z - level).powi(2);
            (square > 0.0).then(|| ball.centre.x + square.sqrt())
        };
        let hips = 2.0
            * of(&[Flesh::Trunk, Flesh::Thigh])
                .iter()
                .filter_map(reach)
                .fold(0.0, f64::max);
        println!(
            "{}: stature {:.2}, sitting height {:.2}, hips {hips:.2} cm",
            person.name,
            top - sole,
            top - seat
        );
        assert!((top - sole - person.stature).abs() < 0.5);
        assert!((top - seat - person.sitting_height).abs() < 0.5);
        assert!((hips - person.hip_width).abs() < 0.5);
        // The tip of the shoulder is on the surface.
        let tip = Vec3::new(0.5 * person.shoulder_width, 0.0, levels.acromion);
        let outside = balls.iter().map(|b| (tip - b.centre).norm() - b.radius);
        let outside = outside.fold(9.0, f64::min);
        println!("  tip of the shoulder {outside:.2} cm outside");
        assert!(outside.abs() < 0.5, "{outside}");
    }
}

#[test]
fn the_left_half_mirrors_the_right() {
    let robot = Robot::new(&everyone()[0]).unwrap();
    let balls = robot.standing();
    for ball in &balls {
        let mirrored = Vec3::new(-ball.centre.x, ball.centre.y, ball.centre.z);
        let twin = balls.iter().any(|other| {
            (other.centre - mirrored).norm() < 1e-9 && (other.radius - ball.radius).abs() < 1e-9
        });
        assert!(twin, "{ball:?}");
    }
}

/// How deep the balls are below the flesh that is smooth between them.
#[test]
fn dents_between_balls_are_shallow() {
    for person in everyone() {
        let robot = Robot::new(&person).unwrap();
        let balls = robot.standing();
        let field = Field::of(&robot.muscles, &balls);
        let skin = robot
            .skin(&Posture::standing(robot.skeleton()), &[])
            .unwrap();
        let mut deepest = std::collections::BTreeMap::new();
        for vertex in &skin.vertices {
            // Not where limbs blend.
            if field.bare(vertex).abs() > 1e-4 {
                continue;
            }
            let out = |ball: &Ball| (vertex - ball.centre).norm() - ball.radius;
            let (muscle, dent) = balls
                .iter()
                .map(out)
                .enumerate()
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .unwrap();
            let of = |group: &&Group| group.muscles.contains(&muscle);
            let flesh = robot.muscles.groups.iter().find(of).unwrap().flesh;
            let slot = deepest.entry(format!("{flesh:?}")).or_insert(0.0_f64);
            *slot = slot.max(dent);
        }
        println!("{}: {deepest:.2?} cm", person.name);
        for (flesh, dent) in deepest {
            let coarse = ["Head", "Hand", "Foot"].contains(&flesh.as_str());
            assert!(dent < if coarse { 1.0 } else { 0.5 }, "{flesh}: {dent}");
        }
    }
}

/// From the bust down, where the arms have left the trunk.
#[test]
fn arms_hang_beside_the_trunk() {
    for person in everyone() {
        let robot = Robot::new(&person).unwrap();
        let (balls, levels) = (robot.standing(), Levels::of(&person).unwrap());
        let bust = levels.crotch + 0.76 * (levels.acromion - levels.crotch);
        let arms = [Flesh::UpperArm, Flesh::Forearm, Flesh::Hand];
        let rest = [Flesh::Trunk, Flesh::Thigh];
        let mut deepest = f64::MIN;
        for arm in robot.muscles.groups(&arms).map(|muscle| balls[muscle]) {
            for other in robot.muscles.groups(&rest).map(|muscle| balls[muscle]) {
                let apart = (arm.centre - other.centre).norm();
                if arm.centre.z < bust {
                    deepest = deepest.max(arm.radius + other.radius - apart);
                }
            }
        }
        println!("{}: arms {deepest:.2} cm deep in the trunk", person.name);
        assert!(deepest < 1.5, "{deepest}");
    }
}

/// The tape around a skin, of which the vertices of some limbs count.
fn tape(skin: &Mesh, field: &Field, limbs: &[Limb], height: f64) -> f64 {
    let counts = |vertex: &u32| {
        let limb = field.limb(&skin.vertices[*vertex as usize]);
        limb.is_some_and(|limb| limbs.contains(&limb))
    };
    let mut crossed = Vec::new();
    for triangle in &skin.triangles {
        let [a, b, c] = triangle.map(|corner| skin.vertices[corner as usize]);
        let above = [a, b, c].map(|p| p.z >= height);
        if above == [true; 3] || above == [false; 3] || !triangle.iter().all(counts) {
            continue;
        }
        for (p, q) in [(a, b), (b, c), (c, a)] {
            if (p.z < height) != (q.z < height) {
                // A point is a ball of next to nothing.
                let centre = p + (q - p) * ((height - p.z) / (q.z - p.z));
                let radius = 1e-6;
                crossed.push(Ball { centre, radius });
            }
        }
    }
    Section::of(&crossed, &Vec3::new(0.0, 0.0, height), &Vec3::z()).girth()
}

#[test]
fn the_skin_has_the_girths_of_the_balls() {
    for person in everyone() {
        let robot = Robot::new(&person).unwrap();
        let levels = Levels::of(&person).unwrap();
        // Arms out, or they would hide the chest's sides.
        let out = [0.0, 60.0, 0.0];
        let joints = [("left_shoulder", out), ("right_shoulder", out)];
        let posture = turned(robot.skeleton(), &joints);
        let placed = frames(robot.skeleton(), &posture);
        let skin = robot.skin(&posture, &placed).unwrap();
        let field = Field::of(&robot.muscles, &robot.balls(&posture, &placed));
        let level = |share: f64| levels.crotch + share * (levels.acromion - levels.crotch);
        let trunk = [Limb::Trunk, Limb::RightBreast, Limb::LeftBreast];
        let hips = [Limb::Trunk, Limb::RightLeg, Limb::LeftLeg];
        let knee = levels.ankle + levels.shank;
        for (girth, limbs, height) in [
            (Girth::Bust, &trunk[..], level(0.76)),
            (Girth::UnderBust, &trunk, level(0.65)),
            (Girth::Waist, &trunk, level(0.47)),
            (Girth::Hip, &hips, level(0.11)),
            (Girth::Knee, &[Limb::LeftLeg], knee),
            (Girth::Calf, &[Limb::LeftLeg], knee - 0.28 * levels.shank),
            (
                Girth::Ankle,
                &[Limb::LeftLeg],
                levels.ankle + 0.03 * levels.stature,
            ),
        ] {
            let (ours, balls) = (tape(&skin, &field, limbs, height), robot.girth(girth));
            println!(
                "{} {girth}: skin {ours:.2} cm, balls {balls:.2} cm",
                person.name
            );
            assert!((ours - balls).abs() < 1.0, "{girth}: {ours} for {balls}");
        }
    }
}

#[test]
fn the_skin_is_closed_and_solid_in_any_posture() {
    for person in everyone() {
        let robot = Robot::new(&person).unwrap();
        let skeleton = robot.skeleton();
        for posture in [Posture::standing(skeleton), dancing(skeleton)] {
            let placed = frames(skeleton, &posture);
            let skin = robot.skin(&posture, &placed).unwrap();
            let found = skin.inspection();
            println!("{}: {found}", person.name);
            assert!(found.closed && found.holes == 0 && found.components == 1);
            let amiss = [
                found.flipped,
                found.degenerate,
                found.duplicate,
                found.non_manifold_edges,
            ];
            assert_eq!(amiss, [0; 4]);
            let part = Part::new("skin".into(), &Shape::Mesh(skin), Pose::identity()).unwrap();
            assert_eq!(part.nature(), Nature::Solid);
        }
    }
}

#[test]
fn the_same_posture_has_the_same_skin() {
    let robot = Robot::new(&everyone()[2]).unwrap();
    let posture = dancing(robot.skeleton());
    let placed = frames(robot.skeleton(), &posture);
    let skin = || robot.skin(&posture, &placed).unwrap();
    assert_eq!(skin(), skin());
}

#[test]
fn parts_are_the_balls_in_place() {
    let robot = Robot::new(&everyone()[1]).unwrap();
    let posture = dancing(robot.skeleton());
    let placed = frames(robot.skeleton(), &posture);
    let (balls, parts) = (
        robot.balls(&posture, &placed),
        robot.parts(&posture, &placed).unwrap(),
    );
    assert_eq!(
        (balls.len(), parts.len()),
        (robot.muscles().len(), robot.muscles().len())
    );
    assert!(parts.iter().any(|part| part.name() == "left_thigh 3"));
    let bodies = crate::body::Bodies::new(parts);
    for ball in &balls {
        assert!(bodies.depth(&ball.centre) > 0.99 * ball.radius);
    }
}

#[test]
fn a_turn_of_the_whole_moves_every_ball_alike() {
    let robot = Robot::new(&everyone()[2]).unwrap();
    let mut posture = dancing(robot.skeleton());
    let before = robot.balls(&posture, &frames(robot.skeleton(), &posture));
    let moved = Pose::from_parts(
        Vec3::new(3.0, -4.0, 5.0).into(),
        Rotation::new(Vec3::new(0.3, 1.2, -0.4)),
    );
    posture.root = moved * posture.root;
    let after = robot.balls(&posture, &frames(robot.skeleton(), &posture));
    for (before, after) in before.iter().zip(&after) {
        let expected = moved.translation.vector + moved.rotation * before.centre;
        assert!((after.centre - expected).norm() < 1e-9);
        assert_eq!(before.radius, after.radius);
    }
}

#[test]
fn no_posture_makes_a_panic() {
    let robot = Robot::new(&everyone()[0]).unwrap();
    let mut posture = Posture::standing(robot.skeleton());
    posture.joints.truncate(3);
    assert_eq!(robot.balls(&posture, &[]), robot.standing());
    let nowhere = Pose::from_parts(Vec3::repeat(f64::NAN).into(), Rotation::identity());
    let broken = vec![nowhere; robot.skeleton().bones().len()];
    assert_eq!(robot.balls(&posture, &broken).len(), robot.muscles().len());
    assert!(robot.skin(&posture, &broken).is_err());
    let far = Pose::from_parts(Vec3::repeat(1e6).into(), Rotation::identity());
    let mut torn = robot.standing_frames();
    torn[7] = far;
    assert!(robot.skin(&posture, &torn).is_err());
}

#[test]
fn the_sides_have_groups_of_their_own() {
    let robot = Robot::new(&everyone()[0]).unwrap();
    for side in [Side::Left, Side::Right] {
        assert!(robot.muscles.group(Flesh::Thigh, Some(side)).len() > 5);
    }
    assert!(robot.muscles.group(Flesh::Thigh, None).is_empty());
}
