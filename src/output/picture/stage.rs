//! What stands before the camera: cloth, bodies, floor.

use super::{
    Frame, Met, Sample,
    camera::Camera,
    lamp::Lamp,
    rows,
    trace::{Hit, Ray, Surface},
};
use crate::{
    math::{Vec2, Vec3},
    output::{
        BodyMesh, ClothMesh, HeatMap,
        colour::{Rgb, from_srgb},
        heat::Scale,
        shell::Shell,
        weave::{lines, weave},
    },
};

/// Cloth lies on a body closer than this [cm]. A body seen so little before the cloth is a body
/// seen through the straight sides of the cloth's cells, and rays of light start so far out.
const COVER: f64 = 0.15;

/// How far around the cloth bodies are framed, and the sky is searched for what hides it, in
/// diagonals of the cloth's box.
const AROUND: f64 = 1.0;

/// All that rays can meet.
pub(super) struct Stage<'a> {
    cloth: Surface,
    bodies: Surface,
    coordinates: &'a [Vec2],
    heat: Option<(&'a HeatMap, Scale)>,
    /// What the picture shows, where that was said.
    frame: Option<Frame>,
    /// Height of the floor [cm].
    floor: f64,
    /// Middle and radius of all that casts shadows [cm].
    centre: Vec3,
    radius: f64,
}

impl<'a> Stage<'a> {
    /// Sets cloth and bodies on a floor.
    pub(super) fn new(
        cloth: &ClothMesh<'a>,
        bodies: &[BodyMesh],
        heat: Option<&'a HeatMap>,
        frame: Option<Frame>,
    ) -> Self {
        let cloth_shell = Shell::of_cloth(cloth);
        let mut body_shell = Shell::default();
        for body in bodies {
            append(&mut body_shell, Shell::of_body(body));
        }
        let mut stage = Self {
            cloth: Surface::new(cloth_shell),
            bodies: Surface::new(body_shell),
            coordinates: &cloth.lattice.coordinates,
            heat: heat.map(|heat| (heat, heat.scale())),
            frame: frame.filter(Frame::can_be_seen),
            floor: 0.0,
            centre: Vec3::zeros(),
            radius: 1.0,
        };
        let subject = stage.subject();
        if let Some((low, high)) = bounds(subject.iter().copied()) {
            stage.centre = 0.5 * (low + high);
            stage.radius = 0.5 * (high - low).norm();
        }
        stage.floor = match &stage.frame {
            Some(frame) => frame.low.z.min(frame.high.z),
            None => stage.floor_below(),
        };
        stage
    }

    /// A body stands on the floor; a cloth that hangs lower than it hangs free.
    fn floor_below(&self) -> f64 {
        let lowest = |shell: &Shell| drawn(shell).map(|p| p.z).reduce(f64::min);
        let hang = lowest(self.cloth.shell()).map(|z| z - 0.06 * self.radius);
        let stand = lowest(self.bodies.shell());
        let lower = hang.into_iter().chain(stand).reduce(f64::min);
        lower.unwrap_or(0.0)
    }

    /// The points that the camera frames: what was asked for, or the cloth, and bodies as far as
    /// they are near it.
    pub(super) fn subject(&self) -> Vec<Vec3> {
        if let Some(frame) = &self.frame {
            return frame.corners().to_vec();
        }
        let mut points: Vec<Vec3> = drawn(self.cloth.shell()).collect();
        let Some((low, high)) = bounds(points.iter().copied()) else {
            return drawn(self.bodies.shell()).collect();
        };
        let around = Vec3::repeat(AROUND * (high - low).norm());
        let near = |p: Vec3| p.sup(&(low - around)).inf(&(high + around));
        points.extend(drawn(self.bodies.shell()).map(near));
        points
    }

    /// Casts the rays of a picture, four to a pixel; samples in rows of twice the width.
    pub(super) fn expose(&self, camera: &Camera) -> Vec<Sample> {
        let lamp = Lamp::beside(camera);
        let [width, height] = camera.size.map(|pixels| 2 * pixels as usize);
        rows(height, |y| {
            (0..width)
                .map(|x| self.sample(camera, &lamp, x, y))
                .collect()
        })
    }

    fn sample(&self, camera: &Camera, lamp: &Lamp, x: usize, y: usize) -> Sample {
        // A turned square of four, so that an edge along a row or a column is seen in four steps.
        let turn = |odd: bool| if odd { 0.125 } else { -0.125 };
        let across = 0.5 * (x as f64 + 0.5) + turn(y % 2 == 1);
        let along = 0.5 * (y as f64 + 0.5) - turn(x % 2 == 1);
        let ray = camera.ray(across, along);
        let Some(seen) = self.look(&ray, camera.pixel()) else {
            return Sample::default();
        };
        let start = ray.at(seen.distance) + seen.facing * COVER;
        Sample {
            on: seen.on,
            colour: seen.colour.map(|x| x as f32).into(),
            normal: seen.normal.map(|x| x as f32).into(),
            depth: seen.distance as f32,
            lamp: self.lamp_seen(start, lamp.point(x, y)),
            sky: self.sky_seen(start, lamp.sky(x, y, seen.normal)),
        }
    }

    /// What a ray meets first.
    fn look(&self, ray: &Ray, pixel: f64) -> Option<Seen> {
        let cloth = self.cloth.hit(ray, f64::MAX);
        let body = self
            .bodies
            .hit(ray, cloth.map_or(f64::MAX, |hit| hit.distance));
        match (cloth, body) {
            (Some(cloth), Some(body)) if !covers(&cloth, &body, ray) => Some(self.body(ray, &body)),
            (Some(cloth), _) => Some(self.cloth(ray, &cloth, pixel)),
            (None, Some(body)) => Some(self.body(ray, &body)),
            (None, None) => self.floor(ray),
        }
    }

    fn cloth(&self, ray: &Ray, hit: &Hit, pixel: f64) -> Seen {
        let at: Vec2 = hit
            .corners
            .iter()
            .zip(hit.weights)
            .filter_map(|(node, weight)| Some(self.coordinates.get(*node as usize)? * weight))
            .sum();
        // A pixel covers more cloth the flatter it is seen; beyond four times it would smear.
        let slant = hit.normal.dot(&ray.direction).abs().max(0.25);
        let across = pixel * hit.distance / slant;
        let colour = match self.heat {
            None => weave(at, across),
            Some((heat, scale)) => {
                let value = hit.corners.iter().zip(hit.weights).map(|(node, weight)| {
                    heat.values.get(*node as usize).copied().unwrap_or(f64::NAN) * weight
                });
                scale.colour(value.sum()) * (1.0 - 0.10 * lines(at, across))
            }
        };
        Seen::new(Met::Cloth, ray, hit, self.cloth.normal(hit), colour)
    }

    fn body(&self, ray: &Ray, hit: &Hit) -> Seen {
        let colour = from_srgb([201, 180, 160]);
        Seen::new(Met::Body, ray, hit, self.bodies.normal(hit), colour)
    }

    /// The floor, as far as shadows reach; beyond, it is backdrop.
    fn floor(&self, ray: &Ray) -> Option<Seen> {
        let distance = (self.floor - ray.origin.z) / ray.direction.z;
        let reach = (ray.at(distance) - self.centre).norm() / self.radius;
        let normal = Vec3::z();
        // The colour says how much of the shadow is left.
        let left = 1.0 - smooth_step(1.4, 3.2, reach);
        (ray.direction.z < 0.0 && left > 0.0).then(|| Seen {
            on: Met::Floor,
            distance,
            normal,
            facing: normal,
            colour: Rgb::repeat(left),
        })
    }

    fn lamp_seen(&self, start: Vec3, towards: Vec3) -> f32 {
        let ray = Ray::new(start, towards);
        let hidden = self.cloth.blocks(&ray, f64::MAX) || self.bodies.blocks(&ray, f64::MAX);
        if hidden { 0.0 } else { 1.0 }
    }

    /// What is far hides little: light comes around it.
    fn sky_seen(&self, start: Vec3, towards: Vec3) -> f32 {
        let ray = Ray::new(start, towards);
        let within = 0.7 * self.radius;
        let cloth = self
            .cloth
            .hit(&ray, within)
            .map_or(within, |hit| hit.distance);
        let nearest = self
            .bodies
            .hit(&ray, cloth)
            .map_or(cloth, |hit| hit.distance);
        let floor = (self.floor - start.z) / ray.direction.z.min(-1e-9);
        let below = if ray.direction.z < 0.0 {
            floor.clamp(0.0, within)
        } else {
            within
        };
        // The floor is bright itself, so it takes away less than half of what it hides.
        (nearest.min(within - 0.4 * (within - below)) / within) as f32
    }
}

/// A point that is seen.
struct Seen {
    on: Met,
    distance: f64,
    /// Normal for shading and of the face itself, both towards the camera.
    normal: Vec3,
    facing: Vec3,
    colour: Rgb,
}

impl Seen {
    fn new(on: Met, ray: &Ray, hit: &Hit, normal: Vec3, colour: Rgb) -> Self {
        let side = if hit.normal.dot(&ray.direction) > 0.0 {
            -1.0
        } else {
            1.0
        };
        Self {
            on,
            distance: hit.distance,
            normal: normal * side,
            facing: hit.normal * side,
            colour,
        }
    }
}

/// Whether a body met just before the cloth is only seen through it.
fn covers(cloth: &Hit, body: &Hit, ray: &Ray) -> bool {
    let between = cloth.distance - body.distance;
    // At the rim of a body that is seen flat, the way is long and the cloth may be another fold.
    between < 8.0 * COVER && between * body.normal.dot(&ray.direction).abs() < COVER
}

fn append(all: &mut Shell, more: Shell) {
    let first = all.vertices.len() as u32;
    all.vertices.extend(more.vertices);
    all.normals.extend(more.normals);
    all.triangles.extend(
        more.triangles
            .iter()
            .map(|corners| corners.map(|k| first + k)),
    );
}

/// The corners of all triangles.
fn drawn(shell: &Shell) -> impl Iterator<Item = Vec3> + '_ {
    shell
        .triangles
        .as_flattened()
        .iter()
        .filter_map(|&k| shell.vertices.get(k as usize).copied())
}

fn bounds(points: impl Iterator<Item = Vec3>) -> Option<(Vec3, Vec3)> {
    points
        .map(|p| (p, p))
        .reduce(|(low, high), (p, _)| (low.inf(&p), high.sup(&p)))
}

/// 0 before the start, 1 after the end, smooth between.
fn smooth_step(start: f64, end: f64, x: f64) -> f64 {
    let t = ((x - start) / (end - start)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample;

    fn seen_from_above(cloth_at: f64) -> Option<Met> {
        let cloth = sample::flat(5, 1.0, cloth_at);
        let table = sample::cuboid(Vec3::new(-9.0, -9.0, -5.0), Vec3::new(9.0, 9.0, 0.0));
        let stage = Stage::new(&cloth.cloth(), &[table], None, None);
        let slanted = Vec3::new(0.3, 0.2, -1.0).normalize();
        stage
            .look(&Ray::new(slanted * -40.0, slanted), 1e-3)
            .map(|seen| seen.on)
    }

    #[test]
    fn a_cloth_that_lies_on_a_body_hides_it() {
        assert_eq!(seen_from_above(0.02), Some(Met::Cloth));
        assert_eq!(seen_from_above(-0.05), Some(Met::Cloth));
        assert_eq!(seen_from_above(-0.5), Some(Met::Body));
    }

    #[test]
    fn a_body_stands_on_the_floor_and_a_cloth_hangs_above_it() {
        let cloth = sample::flat(5, 1.0, 3.0);
        let table = sample::cuboid(Vec3::new(-1.0, -1.0, -5.0), Vec3::new(1.0, 1.0, 0.0));
        assert_eq!(Stage::new(&cloth.cloth(), &[table], None, None).floor, -5.0);
        let alone = Stage::new(&cloth.cloth(), &[], None, None).floor;
        assert!((2.5..3.0).contains(&alone), "{alone}");
    }

    #[test]
    fn a_table_keeps_the_lamp_from_what_is_under_it() {
        let table = sample::cuboid(Vec3::new(-9.0, -9.0, 5.0), Vec3::new(9.0, 9.0, 6.0));
        let cloth = sample::flat(3, 1.0, 0.0);
        let stage = Stage::new(&cloth.cloth(), &[table], None, None);
        let at = |z| Vec3::new(0.0, 0.0, z);
        assert_eq!(
            [
                stage.lamp_seen(at(1.0), Vec3::z()),
                stage.lamp_seen(at(7.0), Vec3::z())
            ],
            [0.0, 1.0]
        );
        assert!(
            stage.sky_seen(at(4.5), Vec3::z()) < 0.3 && stage.sky_seen(at(7.0), Vec3::z()) == 1.0
        );
    }

    #[test]
    fn the_camera_looks_at_the_near_part_of_a_large_body() {
        let cloth = sample::flat(3, 1.0, 0.0);
        let hall = sample::cuboid(Vec3::repeat(-1000.0), Vec3::new(1000.0, 1000.0, -0.1));
        let subject = Stage::new(&cloth.cloth(), &[hall], None, None).subject();
        assert!(subject.iter().all(|p| p.amax() < 5.0), "{subject:?}");
    }
}
