//! A film as one GLB: cloth and balls that move, metres, y up.

use super::{
    BodyMesh, ClothMesh,
    glb::cloth_attributes,
    gltf_file::{BODY, GltfFile, Mesh, WOVEN, y_up},
    shell::Shell,
};
use crate::{lattice::Lattice, math::Vec3, robot::Ball};
use serde_json::{Map, json};

/// Cloth and bodies, frame by frame.
#[derive(Clone, Copy, Debug)]
pub struct Film<'a> {
    /// What it is called.
    pub title: &'a str,
    /// Nodes, cells and cloth coordinates of the cloth.
    pub lattice: &'a Lattice,
    /// Positions of the cloth's nodes [cm], per frame; none for a film without cloth.
    pub frames: &'a [Vec<Vec3>],
    /// What does not move.
    pub bodies: &'a [BodyMesh],
    /// The robot's balls, per frame, each time in the same order; none for a film without a robot.
    pub balls: &'a [Vec<Ball>],
    /// Time of each frame [s], rising.
    pub seconds: &'a [f64],
}

/// The film as a GLB file that viewers play.
///
/// The cloth has the look of [`glb`](super::glb()). It is the first frame's mesh, with a morph
/// target (displacements and changes of normals) per further frame; an animation of the weights
/// shows each frame at its time, and straight ways between. Each ball is a node that moves and
/// grows; all share one ball of radius 1 m. The first frame is at 0 s.
///
/// A frame whose time is not after those before it is left out. What is not finite or missing in a
/// frame is shown as it was in the frame before.
///
/// The cloth takes 24 bytes per node and frame: 300 frames of 5000 nodes 36 MB.
pub fn animated_glb(film: &Film<'_>) -> Vec<u8> {
    let mut file = GltfFile::default();
    let shots = shots(film.seconds);
    let times = (shots.len() > 1).then(|| file.keys::<1>(shots.iter().map(|s| [s.at]), true));
    add_cloth(&mut file, film, &shots, times);
    for body in film.bodies {
        file.body(body);
    }
    add_balls(&mut file, film, &shots, times);
    file.finish_film(film.title)
}

/// A frame that is shown.
#[derive(Clone, Copy, Debug)]
struct Shot {
    frame: usize,
    /// After the first [s].
    at: f32,
}

/// Frames at strictly rising times, also once rounded as the file holds them.
fn shots(seconds: &[f64]) -> Vec<Shot> {
    let mut shots = vec![Shot { frame: 0, at: 0.0 }];
    let start = seconds.first().copied().unwrap_or(0.0);
    let mut last = 0.0;
    for (frame, second) in seconds.iter().enumerate().skip(1) {
        let at = (second - start) as f32;
        if at.is_finite() && at > last {
            last = at;
            shots.push(Shot { frame, at });
        }
    }
    shots
}

fn add_cloth(file: &mut GltfFile, film: &Film<'_>, shots: &[Shot], times: Option<usize>) {
    let Some(first) = film.frames.first() else {
        return;
    };
    let mut positions = first.clone();
    let shell = |positions: &[Vec3]| {
        Shell::of_cloth(&ClothMesh {
            lattice: film.lattice,
            positions,
        })
    };
    let base = shell(first);
    let cloth = ClothMesh {
        lattice: film.lattice,
        positions: first,
    };
    let attributes = cloth_attributes(file, &cloth, &[]);
    let mut targets = Vec::new();
    for shot in shots.iter().skip(1) {
        follow(&mut positions, film.frames.get(shot.frame));
        let now = shell(&positions);
        let moved = file.vectors(&differences(&now.vertices, &base.vertices), 0.01, true);
        let turned = file.vectors(&differences(&now.normals, &base.normals), 1.0, false);
        targets.push(json!({ "POSITION": moved, "NORMAL": turned }));
    }
    let node = file.placed_mesh(Mesh {
        name: "cloth",
        shell: &base,
        attributes,
        targets,
        material: WOVEN,
    });
    if let (Some(node), Some(times)) = (node, times) {
        let count = shots.len();
        let weights = (0..count).flat_map(|shot| {
            // The first shot is the mesh itself: no target has weight.
            (1..count).map(move |target| [if target == shot { 1.0 } else { 0.0 }])
        });
        let weights = file.keys::<1>(weights, false);
        file.animate(node, "weights", times, weights);
    }
}

/// Moves all that is finite to where it is now.
fn follow(positions: &mut [Vec3], now: Option<&Vec<Vec3>>) {
    for (old, new) in positions.iter_mut().zip(now.into_iter().flatten()) {
        if new.iter().all(|x| x.is_finite()) {
            *old = *new;
        }
    }
}

fn differences(now: &[Vec3], base: &[Vec3]) -> Vec<Vec3> {
    now.iter().zip(base).map(|(now, base)| now - base).collect()
}

fn add_balls(file: &mut GltfFile, film: &Film<'_>, shots: &[Shot], times: Option<usize>) {
    let count = film.balls.first().map_or(0, Vec::len);
    let ways: Vec<Vec<Ball>> = (0..count)
        .map(|ball| way(film.balls, shots, ball))
        .collect();
    if ways.iter().all(Vec::is_empty) {
        return;
    }
    let Some(mesh) = file.mesh(Mesh {
        name: "ball",
        shell: &unit_ball(),
        attributes: Map::new(),
        targets: Vec::new(),
        material: BODY,
    }) else {
        return;
    };
    for (number, way) in (1..).zip(&ways) {
        let Some(first) = way.first() else {
            continue;
        };
        let node = file.node(json!({
            "name": format!("ball {number}"), "mesh": mesh,
            "translation": place(first), "scale": size(first),
        }));
        let Some(times) = times else { continue };
        if way.iter().any(|ball| ball.centre != first.centre) {
            let places = file.keys::<3>(way.iter().map(place), false);
            file.animate(node, "translation", times, places);
        }
        if way.iter().any(|ball| ball.radius != first.radius) {
            let sizes = file.keys::<3>(way.iter().map(size), false);
            file.animate(node, "scale", times, sizes);
        }
    }
}

/// Where a ball is in each shot; empty for one that is never to be seen.
fn way(balls: &[Vec<Ball>], shots: &[Shot], ball: usize) -> Vec<Ball> {
    let finite =
        |ball: &&Ball| ball.radius.is_finite() && ball.centre.iter().all(|x| x.is_finite());
    let seen = |shot: &Shot| balls.get(shot.frame)?.get(ball).filter(finite);
    let Some(mut last) = shots.iter().find_map(seen) else {
        return Vec::new();
    };
    let steps = shots.iter().map(|shot| {
        last = seen(shot).unwrap_or(last);
        *last
    });
    steps.collect()
}

/// A ball's middle [m], y up.
fn place(ball: &Ball) -> [f32; 3] {
    y_up(&ball.centre, 0.01)
}

/// A ball's radius [m], three times.
fn size(ball: &Ball) -> [f32; 3] {
    [(0.01 * ball.radius) as f32; 3]
}

/// A ball of radius 1 m by meridians and parallels.
fn unit_ball() -> Shell {
    const PARALLELS: u32 = 12;
    const MERIDIANS: u32 = 24;
    let mut ball = Shell::default();
    for ring in 0..=PARALLELS {
        let polar = std::f64::consts::PI * f64::from(ring) / f64::from(PARALLELS);
        let (out, up) = libm::sincos(polar);
        for step in 0..MERIDIANS {
            let azimuth = std::f64::consts::TAU * f64::from(step) / f64::from(MERIDIANS);
            let (left, right) = libm::sincos(azimuth);
            let normal = Vec3::new(out * right, out * left, up);
            ball.vertices.push(100.0 * normal);
            ball.normals.push(normal);
            let next = (step + 1) % MERIDIANS;
            let above = |step| (ring.max(1) - 1) * MERIDIANS + step;
            let below = |step| ring * MERIDIANS + step;
            if ring > 1 {
                ball.triangles.push([above(step), below(step), above(next)]);
            }
            if ring > 0 && ring < PARALLELS {
                ball.triangles.push([above(next), below(step), below(next)]);
            }
        }
    }
    ball
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shared_ball_is_round_closed_and_faces_outward() {
        let ball = unit_ball();
        // Euler: a closed surface of genus 0 with V points has 2V − 4 triangles; each pole is
        // there once per meridian.
        let points = ball.vertices.len() - 2 * 23;
        assert_eq!(ball.triangles.len(), 2 * points - 4);
        for corners in &ball.triangles {
            let [a, b, c] = corners.map(|k| ball.vertices[k as usize]);
            assert!(
                (b - a).cross(&(c - a)).dot(&(a + b + c)) > 0.0,
                "{corners:?}"
            );
        }
        assert!(
            ball.vertices
                .iter()
                .all(|p| (p.norm() - 100.0).abs() < 1e-9)
        );
    }
}
