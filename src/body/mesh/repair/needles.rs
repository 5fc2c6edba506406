use super::{at, edges};
use crate::math::Vec3;

/// How often divided faces are looked at again. A face divided along a needle is rarely one
/// itself; a row of them ends one by one.
const ROUNDS: usize = 8;

/// Leaves out faces without area; the others, and how many there were.
///
/// A face with a corner named twice leaves no gap. One whose three corners lie on a line would:
/// the face beyond its longest side is divided at the corner between them, which closes it. Where
/// there is no one such face, it is left out only.
pub(super) fn without_needles(
    vertices: &[Vec3],
    triangles: Vec<[u32; 3]>,
    tolerance: f64,
) -> (Vec<[u32; 3]>, usize) {
    let count = triangles.len();
    let mut faces: Vec<[u32; 3]> = triangles
        .into_iter()
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .collect();
    let mut dropped = count - faces.len();
    for _ in 0..ROUNDS {
        let before = faces.len();
        let divided = divide_beyond_needles(vertices, &mut faces, tolerance);
        dropped += divided;
        debug_assert_eq!(faces.len(), before, "a needle goes and a face is made two");
        if divided == 0 {
            break;
        }
    }
    let before = faces.len();
    faces.retain(|&face| needle(vertices, face, tolerance).is_none());
    dropped += before - faces.len();
    (faces, dropped)
}

/// A face without area.
struct Needle {
    /// Its longest side, the lower vertex first.
    longest: [u32; 2],
    /// The corner between.
    middle: u32,
}

fn needle(vertices: &[Vec3], face: [u32; 3], tolerance: f64) -> Option<Needle> {
    let [a, b, c] = face;
    let length = |p, q| (at(vertices, q) - at(vertices, p)).norm();
    let sides = [
        (length(a, b), a, b, c),
        (length(b, c), b, c, a),
        (length(c, a), c, a, b),
    ];
    let (longest, p, q, middle) = sides
        .into_iter()
        .max_by(|(one, ..), (other, ..)| one.total_cmp(other))?;
    let along = at(vertices, q) - at(vertices, p);
    let twice_area = along
        .cross(&(at(vertices, middle) - at(vertices, p)))
        .norm();
    let flat = twice_area <= tolerance * longest;
    flat.then_some(Needle {
        longest: [p.min(q), p.max(q)],
        middle,
    })
}

/// Replaces each needle and the face beyond it by that face's two parts; how many there were.
fn divide_beyond_needles(vertices: &[Vec3], faces: &mut [[u32; 3]], tolerance: f64) -> usize {
    let needles: Vec<Option<Needle>> = faces
        .iter()
        .map(|&face| needle(vertices, face, tolerance))
        .collect();
    if needles.iter().all(Option::is_none) {
        return 0;
    }
    let edges = edges(faces);
    let mut touched = vec![false; faces.len()];
    let mut divided = 0;
    for (thin, needle) in needles.iter().enumerate() {
        let Some(needle) = needle else { continue };
        let edge = edges.binary_search_by(|edge| edge.ends.cmp(&needle.longest));
        let Some(edge) = edge.ok().and_then(|found| edges.get(found)) else {
            continue;
        };
        let [one, other] = edge.sides.as_slice() else {
            continue;
        };
        let beyond = if one.face == thin {
            other.face
        } else {
            one.face
        };
        let is_free = |face: usize| touched.get(face) == Some(&false);
        let is_wide = needles.get(beyond).is_some_and(Option::is_none);
        if !(is_wide && is_free(beyond) && is_free(thin)) {
            continue;
        }
        let whole = faces.get(beyond).copied().unwrap_or_default();
        for (face, part) in [thin, beyond].into_iter().zip(parts(whole, needle)) {
            if let (Some(face), Some(mark)) = (faces.get_mut(face), touched.get_mut(face)) {
                (*face, *mark) = (part, true);
            }
        }
        divided += 1;
    }
    divided
}

/// A face divided at a point of one of its sides.
fn parts(face: [u32; 3], needle: &Needle) -> [[u32; 3]; 2] {
    let [low, high] = needle.longest;
    let ends = |corner| corner == low || corner == high;
    // Turned until the side that is divided runs from the first corner to the second.
    let [p, q, tip] = match face {
        [a, b, c] if !ends(a) => [b, c, a],
        [a, b, c] if !ends(b) => [c, a, b],
        _ => face,
    };
    [[p, needle.middle, tip], [needle.middle, q, tip]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square, its lower edge divided at vertex 4 on one side of a needle only.
    #[test]
    fn a_needle_goes_and_leaves_no_gap() {
        let vertices = [[0., 0.], [2., 0.], [2., 2.], [0., 2.], [1., 0.], [1., -1.]]
            .map(|[x, y]| Vec3::new(x, y, 0.0));
        let faces = vec![[0, 1, 2], [0, 2, 3], [0, 4, 1], [0, 5, 4], [4, 5, 1]];
        let (mended, dropped) = without_needles(&vertices, faces, 1e-7);
        assert_eq!(dropped, 1);
        assert_eq!(mended.len(), 5);
        let rim = edges(&mended)
            .iter()
            .filter(|edge| edge.sides.len() == 1)
            .count();
        assert_eq!(rim, 5, "0 5 1 2 3");
        assert!(
            edges(&mended)
                .iter()
                .all(|edge| edge.sides.len() == 1 || edge.balanced())
        );
    }

    #[test]
    fn a_face_with_a_corner_twice_goes() {
        let vertices = [Vec3::zeros(), Vec3::x(), Vec3::y()];
        let (rest, dropped) = without_needles(&vertices, vec![[0, 1, 2], [0, 1, 1]], 1e-7);
        assert_eq!((rest, dropped), (vec![[0, 1, 2]], 1));
    }
}
