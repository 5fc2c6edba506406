//! Pictures of a body from a side.

use super::args::Side;
use soen::{
    lattice::Lattice,
    output::{self, BodyMesh, ClothMesh, View},
};
use std::f64::consts::PI;

/// Width and height of pictures [pixels].
const SIZE: [u32; 2] = [750, 1000];
/// The camera stands at this angle to the side of −y [rad]; figures turn before it.
const CAMERA: f64 = 0.52;

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
