//! A measuring tape, level around a mesh.

use soen::{body::Mesh, math::Vec3};

/// The girth at a height [cm]: the convex hull of the section, since a tape spans hollows.
pub(crate) fn girth(mesh: &Mesh, height: f64) -> f64 {
    let tape = hull(section(mesh, height));
    let next = tape.iter().cycle().skip(1);
    tape.iter()
        .zip(next)
        .map(|(p, q)| libm::hypot(q[0] - p[0], q[1] - p[1]))
        .sum()
}

/// Where edges pass through a height.
pub(crate) fn section(mesh: &Mesh, height: f64) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|corner| mesh.vertices[corner as usize]);
        for (p, q) in [(a, b), (b, c), (c, a)] {
            if (p.z < height) != (q.z < height) {
                let at: Vec3 = p + (q - p) * ((height - p.z) / (q.z - p.z));
                points.push([at.x, at.y]);
            }
        }
    }
    points
}

/// Corners of the convex hull, counter-clockwise (A. Andrew, 1979).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    points.dedup();
    let mut hull = half_hull(points.iter());
    hull.pop();
    let mut upper = half_hull(points.iter().rev());
    upper.pop();
    hull.append(&mut upper);
    hull
}

fn half_hull<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> Vec<[f64; 2]> {
    let mut half: Vec<[f64; 2]> = Vec::new();
    for &p in points {
        while let [.., a, b] = half[..]
            && (b[0] - a[0]) * (p[1] - a[1]) <= (b[1] - a[1]) * (p[0] - a[0])
        {
            half.pop();
        }
        half.push(p);
    }
    half
}
