use super::{Edge, at, edges};
use crate::math::Vec3;

/// What winding faces alike came to.
pub(super) struct Shells {
    /// Pieces whose faces hang together by edges of two faces.
    pub(super) count: usize,
    /// Faces turned.
    pub(super) flipped: usize,
}

/// Turns faces so that neighbours are wound alike and closed shells outward.
///
/// 1. From the first face of a shell on, a neighbour that runs along the shared edge the same way
///    is wound against it.
/// 2. A closed shell is turned as a whole if its volume is negative then. An open one has no
///    outside: the winding of most of its faces stands.
///
/// A shell that has one side only, like Möbius's band, keeps a seam where windings differ.
pub(super) fn wind_alike(vertices: &[Vec3], triangles: &mut [[u32; 3]]) -> Shells {
    let edges = edges(triangles);
    let neighbours = neighbours(&edges, triangles.len());
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut shells = Shells {
        count: 0,
        flipped: 0,
    };
    for first in 0..triangles.len() {
        if turned.get(first) != Some(&None) {
            continue;
        }
        let shell = flood(first, &neighbours, &mut turned);
        shells.count += 1;
        turn(&mut turned, triangles, &shell);
        let now: Vec<[u32; 3]> = shell
            .iter()
            .filter_map(|&face| triangles.get(face).copied())
            .collect();
        let flips = shell
            .iter()
            .filter(|&&face| turned.get(face) == Some(&Some(true)))
            .count();
        let is_closed = self::edges(&now).iter().all(Edge::balanced);
        let inside_out = if is_closed {
            volume(vertices, &now) < 0.0
        } else {
            2 * flips > shell.len()
        };
        if inside_out {
            for &face in &shell {
                swap(triangles, face);
            }
        }
        shells.flipped += if inside_out {
            shell.len() - flips
        } else {
            flips
        };
    }
    shells
}

/// The faces beyond each face's edges, and whether they are wound against it.
fn neighbours(edges: &[Edge], count: usize) -> Vec<Vec<(usize, bool)>> {
    let mut neighbours = vec![Vec::with_capacity(3); count];
    for edge in edges {
        if let [one, other] = edge.sides.as_slice() {
            let against = one.forward == other.forward;
            for (from, to) in [(one.face, other.face), (other.face, one.face)] {
                if let Some(list) = neighbours.get_mut(from) {
                    list.push((to, against));
                }
            }
        }
    }
    neighbours
}

/// The faces that hang together with the first; each is marked with whether it must be turned.
fn flood(
    first: usize,
    neighbours: &[Vec<(usize, bool)>],
    turned: &mut [Option<bool>],
) -> Vec<usize> {
    let mut shell = Vec::new();
    let mut waiting = vec![(first, false)];
    while let Some((face, turn)) = waiting.pop() {
        match turned.get_mut(face) {
            Some(mark @ None) => *mark = Some(turn),
            _ => continue,
        }
        shell.push(face);
        for &(next, against) in neighbours.get(face).map(Vec::as_slice).unwrap_or_default() {
            waiting.push((next, turn != against));
        }
    }
    shell
}

fn turn(turned: &mut [Option<bool>], triangles: &mut [[u32; 3]], shell: &[usize]) {
    for &face in shell {
        if turned.get(face) == Some(&Some(true)) {
            swap(triangles, face);
        }
    }
}

fn swap(triangles: &mut [[u32; 3]], face: usize) {
    if let Some([_, b, c]) = triangles.get_mut(face) {
        std::mem::swap(b, c);
    }
}

/// Six times the volume that faces enclose [cm³], by the divergence theorem.
fn volume(vertices: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    // From a corner of its own, a small shell far off loses no digits.
    let origin = triangles
        .first()
        .map_or_else(Vec3::zeros, |&[a, ..]| at(vertices, a));
    let corner = |index| at(vertices, index) - origin;
    triangles
        .iter()
        .map(|&[a, b, c]| corner(a).dot(&corner(b).cross(&corner(c))))
        .sum()
}
