//! Cloth made by hand for the tests of this folder.

use super::{BodyMesh, ClothMesh};
use crate::{
    fabric::Yarn,
    lattice::{Corner, Lattice, Rod},
    math::{Vec2, Vec3},
};
use std::f64::consts::FRAC_PI_2;

/// A full rectangle of nodes at a pitch [cm], centred.
pub(super) fn rectangle(warp: u32, weft: u32, pitch: f64) -> Lattice {
    let mut lattice = Lattice {
        pitch,
        ..Lattice::default()
    };
    let node = |i: u32, j: u32| j * warp + i;
    let half = |k: u32, n: u32| if k == 0 || k + 1 == n { 0.5 } else { 1.0 };
    for j in 0..weft {
        for i in 0..warp {
            let x = pitch * (f64::from(i) - 0.5 * f64::from(warp - 1));
            let y = pitch * (f64::from(j) - 0.5 * f64::from(weft - 1));
            lattice.coordinates.push(Vec2::new(x, y));
            lattice.grid.push([i as i32, j as i32]);
            lattice
                .area
                .push(half(i, warp) * half(j, weft) * pitch * pitch);
            let mut rod = |to, yarn| {
                let nodes = [node(i, j), to];
                lattice.rods.push(Rod {
                    nodes,
                    yarn,
                    rest: pitch,
                    width: pitch,
                });
            };
            if i + 1 < warp {
                rod(node(i + 1, j), Yarn::Warp);
            }
            if j + 1 < weft {
                rod(node(i, j + 1), Yarn::Weft);
            }
            if i + 1 < warp && j + 1 < weft {
                let cell = [
                    node(i, j),
                    node(i + 1, j),
                    node(i + 1, j + 1),
                    node(i, j + 1),
                ];
                lattice.cells.push(cell);
                lattice
                    .corners
                    .extend([[0, 1, 3], [1, 0, 2], [2, 3, 1], [3, 2, 0]].map(
                        |corner: [usize; 3]| Corner {
                            nodes: corner.map(|k| cell[k]),
                            rest_angle: FRAC_PI_2,
                            area: 0.25 * pitch * pitch,
                        },
                    ));
            }
        }
    }
    lattice
}

/// A cloth and where it is.
pub(super) struct Placed {
    pub(super) lattice: Lattice,
    pub(super) positions: Vec<Vec3>,
}

impl Placed {
    /// A rectangle with each cloth coordinate at its place [cm].
    pub(super) fn new([warp, weft]: [u32; 2], pitch: f64, place: impl Fn(&Vec2) -> Vec3) -> Self {
        let lattice = rectangle(warp, weft, pitch);
        let positions = lattice.coordinates.iter().map(place).collect();
        Self { lattice, positions }
    }

    pub(super) fn cloth(&self) -> ClothMesh<'_> {
        ClothMesh {
            lattice: &self.lattice,
            positions: &self.positions,
        }
    }
}

/// A level square at a height [cm].
pub(super) fn flat(nodes: u32, pitch: f64, height: f64) -> Placed {
    Placed::new([nodes; 2], pitch, |c| Vec3::new(c.x, c.y, height))
}

/// A rectangle whose height waves along both yarns.
pub(super) fn wave(warp: u32, weft: u32, pitch: f64) -> Placed {
    let height = |c: &Vec2| 2.0 * libm::sin(0.3 * c.x) + libm::cos(0.4 * c.y);
    Placed::new([warp, weft], pitch, |c| Vec3::new(c.x, c.y, height(c)))
}

/// A square over a ball with its top at the origin: radial lines fall over it and fold beside it.
pub(super) fn draped(nodes: u32, pitch: f64, radius: f64) -> Placed {
    let place = |c: &Vec2| {
        let arc = c.norm();
        let azimuth = libm::atan2(c.y, c.x);
        let on = arc.min(1.3 * radius);
        let fall = (arc - on).max(0.0);
        let fold = fall / (fall + 8.0) * (1.0 + libm::sin(9.0 * azimuth));
        let tilt = on / radius;
        let out = radius * libm::sin(tilt) + fall * 0.25 + 1.6 * fold;
        let z = radius * (libm::cos(tilt) - 1.0) - 0.93 * fall;
        Vec3::new(out * libm::cos(azimuth), out * libm::sin(azimuth), z + 0.02)
    };
    Placed::new([nodes; 2], pitch, place)
}

/// A ball by meridians and parallels.
pub(super) fn ball(centre: Vec3, radius: f64, rings: u32) -> BodyMesh {
    let round = 2 * rings;
    let mut ball = BodyMesh {
        name: "ball".into(),
        ..BodyMesh::default()
    };
    for ring in 0..=rings {
        for step in 0..round {
            let polar = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
            let azimuth = std::f64::consts::TAU * f64::from(step) / f64::from(round);
            let (s, z) = (libm::sin(polar), libm::cos(polar));
            let out = Vec3::new(s * libm::cos(azimuth), s * libm::sin(azimuth), z);
            ball.vertices.push(centre + radius * out);
            if ring < rings {
                let on = |ring: u32, step: u32| match ring {
                    0 => 0,
                    ring if ring == rings => ring * round,
                    ring => ring * round + step % round,
                };
                let (a, b) = (on(ring, step), on(ring, step + 1));
                let (c, d) = (on(ring + 1, step), on(ring + 1, step + 1));
                ball.triangles.extend(
                    [[a, c, b], [b, c, d]]
                        .into_iter()
                        .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]),
                );
            }
        }
    }
    ball
}

/// A box with shared corners.
pub(super) fn cuboid(low: Vec3, high: Vec3) -> BodyMesh {
    let side = |bit: u32, k: usize| if bit == 1 { high[k] } else { low[k] };
    let corner = |i: u32| Vec3::new(side(i & 1, 0), side(i >> 1 & 1, 1), side(i >> 2 & 1, 2));
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    BodyMesh {
        name: "box".into(),
        vertices: (0..8).map(corner).collect(),
        triangles: quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
    }
}
