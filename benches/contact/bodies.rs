//! The bodies that the cloth is laid against.

use soen::{
    body::{Bodies, Mesh, Part, Shape},
    math::{Pose, Vec3},
};

/// Radius of a single ball [cm].
pub(crate) const RADIUS: f64 = 25.0;

/// So many balls, a square number, in rows under the cloth, their tops at one height.
pub(crate) fn balls_abreast(count: u32) -> Bodies {
    let rows = count.isqrt();
    let pitch = 100.0 / f64::from(rows);
    let radius = RADIUS / f64::from(rows);
    let place = |k: u32| (f64::from(k) + 0.5) * pitch - 50.0;
    let centre = |k: u32| Vec3::new(place(k % rows), place(k / rows), RADIUS - radius);
    let ball = |k| part(&Shape::Ball { radius }, centre(k));
    Bodies::new((0..rows * rows).map(ball).collect())
}

/// A ball of so many triangles; its corners are on the ball, its poles on the y axis.
pub(crate) fn meshed_ball(faces: u32) -> Bodies {
    let (around, down) = divisions(faces);
    let ring = |level: u32| (0..around).map(move |step| corner(level, step, around, down));
    let mut corners = vec![corner(0, 0, around, down), corner(down, 0, around, down)];
    corners.extend((1..down).flat_map(ring));
    let at = |level: u32, step: u32| match level {
        0 => 0,
        level if level == down => 1,
        level => 2 + (level - 1) * around + step % around,
    };
    let cell = |(level, step)| {
        let [a, b] = [at(level, step), at(level + 1, step)];
        let [c, d] = [at(level + 1, step + 1), at(level, step + 1)];
        [[a, b, c], [a, c, d]]
    };
    let cells = (0..down).flat_map(|level| (0..around).map(move |step| (level, step)));
    let is_face = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    let triangles: Vec<[u32; 3]> = cells.flat_map(cell).filter(is_face).collect();
    assert_eq!(triangles.len(), faces as usize);
    let mesh = Mesh::new(corners, triangles).unwrap();
    assert!(mesh.inspection().closed);
    Bodies::new(vec![part(&Shape::Mesh(mesh), Vec3::zeros())])
}

/// No face lies deeper inside the ball than this [cm].
pub(crate) fn sag(faces: u32) -> f64 {
    let (around, down) = divisions(faces);
    let along = core::f64::consts::PI / f64::from(down);
    let across = core::f64::consts::TAU / f64::from(around);
    RADIUS * (1.0 - libm::cos(0.5 * along) * libm::cos(0.5 * across))
}

/// Divisions around and from pole to pole.
fn divisions(faces: u32) -> (u32, u32) {
    let around = match faces {
        500 => 25,
        5_000 => 100,
        _ => 250,
    };
    (around, faces / (2 * around) + 1)
}

fn corner(level: u32, step: u32, around: u32, down: u32) -> Vec3 {
    let tilt = core::f64::consts::PI * f64::from(level) / f64::from(down);
    let turn = core::f64::consts::TAU * f64::from(step) / f64::from(around);
    let out = libm::sin(tilt);
    Vec3::new(
        out * libm::sin(turn),
        libm::cos(tilt),
        out * libm::cos(turn),
    ) * RADIUS
}

fn part(shape: &Shape, centre: Vec3) -> Part {
    let pose = Pose::translation(centre.x, centre.y, centre.z);
    Part::new("ball".into(), shape, pose).unwrap()
}
