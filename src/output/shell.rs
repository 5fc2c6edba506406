//! Surfaces as triangles with a normal per vertex, as pictures and viewers need them.

use super::{BodyMesh, ClothMesh};
use crate::math::Vec3;

/// Triangles with a normal per vertex. Every index is in range and every number finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Shell {
    /// Points [cm].
    pub(super) vertices: Vec<Vec3>,
    /// Normals of length 1, one per vertex.
    pub(super) normals: Vec<Vec3>,
    /// Corners of each face.
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Shell {
    /// The cloth, one vertex per node. Cells are divided along their shorter diagonal; those with
    /// a node that is not finite are left out.
    pub(super) fn of_cloth(cloth: &ClothMesh<'_>) -> Self {
        let divide = |&[a, b, c, d]: &[u32; 4]| {
            let [p, q, r, s] = [a, b, c, d].map(|node| cloth.positions.get(node as usize));
            let (first, second) = ((r? - p?).norm_squared(), (s? - q?).norm_squared());
            if !(first + second).is_finite() {
                None
            } else if first <= second {
                Some([[a, b, c], [a, c, d]])
            } else {
                Some([[b, c, d], [b, d, a]])
            }
        };
        let triangles = cloth.lattice.cells.iter().filter_map(divide).flatten();
        let faces: Vec<Face> = triangles
            .filter_map(|corners| Face::new(cloth.positions, corners))
            .collect();
        let mut normals = vec![Vec3::zeros(); cloth.positions.len()];
        for face in &faces {
            for (corner, angle) in face.corners.iter().zip(face.angles) {
                if let Some(normal) = normals.get_mut(*corner as usize) {
                    *normal += angle * face.normal;
                }
            }
        }
        Self {
            vertices: cloth.positions.iter().map(finite_or_origin).collect(),
            normals: normals.into_iter().map(unit).collect(),
            triangles: faces.into_iter().map(|face| face.corners).collect(),
        }
    }

    /// A body, smooth but for creases: a vertex where faces meet sharply is doubled.
    pub(super) fn of_body(body: &BodyMesh) -> Self {
        let mut faces: Vec<Face> = body
            .triangles
            .iter()
            .filter_map(|&t| Face::new(&body.vertices, t))
            .collect();
        let mut shell = Self::default();
        for around in corners_of_vertices(body.vertices.len(), &faces) {
            shell.split_vertex(&body.vertices, &mut faces, &around);
        }
        shell.triangles = faces.into_iter().map(|face| face.split).collect();
        shell
    }

    /// Gives every corner around a vertex the normal of the faces that meet it smoothly; corners
    /// that meet the same faces share a vertex.
    fn split_vertex(&mut self, vertices: &[Vec3], faces: &mut [Face], around: &[(u32, usize)]) {
        let mut shared: Vec<(Vec<u32>, u32)> = Vec::new();
        for &(face, corner) in around {
            let Some(own) = faces.get(face as usize) else {
                continue;
            };
            let Some(vertex) = vertices.get(own.corners[corner] as usize) else {
                continue;
            };
            let mut smooth = Vec::new();
            let mut normal = Vec3::zeros();
            for &(other, at) in around {
                let Some(met) = faces.get(other as usize) else {
                    continue;
                };
                // A wheel of so many spokes is round, and pairing them all would be slow.
                if around.len() > 256 || met.normal.dot(&own.normal) > CREASE_COS {
                    smooth.push(other);
                    normal += met.angles[at] * met.normal;
                }
            }
            let known = shared
                .iter()
                .find(|(faces, _)| *faces == smooth)
                .map(|(_, index)| *index);
            let index = known.unwrap_or_else(|| {
                let index = self.vertices.len() as u32;
                self.vertices.push(*vertex);
                self.normals.push(unit(normal));
                shared.push((smooth, index));
                index
            });
            if let Some(own) = faces.get_mut(face as usize) {
                own.split[corner] = index;
            }
        }
    }
}

/// Cosine of the angle at which two faces make an edge: 40°. A ball of 12 meridians is still
/// smooth, a cube and an octagonal table leg are not.
const CREASE_COS: f64 = 0.766;

/// A triangle that has a direction.
#[derive(Clone, Copy, Debug)]
struct Face {
    corners: [u32; 3],
    /// Corners after vertices on creases are doubled.
    split: [u32; 3],
    normal: Vec3,
    /// At each corner [rad]: the weight that makes a normal independent of how faces are divided.
    angles: [f64; 3],
}

impl Face {
    /// `None` for corners out of range or not finite, and for a face without area.
    fn new(vertices: &[Vec3], corners: [u32; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|corner| vertices.get(corner as usize));
        let points = [*a?, *b?, *c?];
        let normal = (points[1] - points[0]).cross(&(points[2] - points[0]));
        let normal = normal
            .try_normalize(1e-12)
            .filter(|n| n.iter().all(|x| x.is_finite()))?;
        let angle = |k: usize| {
            let (ahead, back) = (
                points[(k + 1) % 3] - points[k],
                points[(k + 2) % 3] - points[k],
            );
            libm::atan2(ahead.cross(&back).norm(), ahead.dot(&back))
        };
        Some(Self {
            corners,
            split: [0; 3],
            normal,
            angles: [angle(0), angle(1), angle(2)],
        })
    }
}

/// For each vertex the faces around it, and which of their corners it is.
fn corners_of_vertices(vertices: usize, faces: &[Face]) -> Vec<Vec<(u32, usize)>> {
    let mut around = vec![Vec::new(); vertices];
    for (index, face) in faces.iter().enumerate() {
        for (corner, vertex) in face.corners.iter().enumerate() {
            if let Some(list) = around.get_mut(*vertex as usize) {
                list.push((index as u32, corner));
            }
        }
    }
    around
}

fn finite_or_origin(p: &Vec3) -> Vec3 {
    if p.iter().all(|x| x.is_finite()) {
        *p
    } else {
        Vec3::zeros()
    }
}

/// The direction, up where there is none.
fn unit(normal: Vec3) -> Vec3 {
    normal.try_normalize(1e-12).unwrap_or_else(Vec3::z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample;

    #[test]
    fn a_ball_stays_smooth_and_its_normals_point_out() {
        let centre = Vec3::new(1.0, 2.0, 3.0);
        let shell = Shell::of_body(&sample::ball(centre, 5.0, 16));
        for (p, n) in shell.vertices.iter().zip(&shell.normals) {
            assert!(((p - centre) / 5.0 - n).norm() < 0.02, "{p:?} {n:?}");
        }
    }

    #[test]
    fn a_box_has_three_normals_at_a_corner() {
        let shell = Shell::of_body(&sample::cuboid(Vec3::zeros(), Vec3::new(3.0, 2.0, 1.0)));
        assert_eq!((shell.vertices.len(), shell.triangles.len()), (24, 12));
        assert!(shell.normals.iter().all(|n| (n.amax() - 1.0).abs() < 1e-12));
    }

    #[test]
    fn a_flat_cloth_looks_up_and_broken_nodes_leave_holes() {
        let lattice = sample::rectangle(4, 4, 1.0);
        let flat: Vec<Vec3> = lattice
            .coordinates
            .iter()
            .map(|c| Vec3::new(c.x, c.y, 0.0))
            .collect();
        let shell = Shell::of_cloth(&ClothMesh {
            lattice: &lattice,
            positions: &flat,
        });
        assert_eq!(shell.triangles.len(), 18);
        assert!(shell.normals.iter().all(|n| (n - Vec3::z()).norm() < 1e-12));
        let mut broken = flat;
        broken[0].x = f64::NAN;
        let shell = Shell::of_cloth(&ClothMesh {
            lattice: &lattice,
            positions: &broken,
        });
        assert_eq!(shell.triangles.len(), 16);
        assert!(shell.vertices.iter().flatten().all(|x| x.is_finite()));
        let few = Shell::of_cloth(&ClothMesh {
            lattice: &lattice,
            positions: &broken[..5],
        });
        assert!(few.triangles.is_empty());
    }

    #[test]
    fn faces_that_cannot_be_drawn_are_left_out() {
        let body = BodyMesh {
            name: String::new(),
            vertices: vec![Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::repeat(f64::NAN)],
            triangles: vec![[0, 1, 2], [0, 1, 3], [0, 1, 9], [0, 1, 1]],
        };
        let shell = Shell::of_body(&body);
        assert_eq!((shell.vertices.len(), shell.triangles.len()), (3, 1));
    }
}
