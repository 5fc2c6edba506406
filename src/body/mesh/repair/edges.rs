/// A face's side: which face, and whether it runs from the lower to the higher vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in super::super) struct Side {
    pub(in super::super) face: usize,
    pub(in super::super) forward: bool,
}

/// An edge and the faces at it.
#[derive(Clone, Debug)]
pub(in super::super) struct Edge {
    /// Its ends, the lower first.
    pub(in super::super) ends: [u32; 2],
    /// The faces at it, in order.
    pub(in super::super) sides: Vec<Side>,
}

impl Edge {
    /// Whether the faces at it run along it as often one way as the other, as in a closed shell.
    pub(in super::super) fn balanced(&self) -> bool {
        2 * self.sides.iter().filter(|side| side.forward).count() == self.sides.len()
    }
}

/// The edges of some faces, in order of their ends.
pub(in super::super) fn edges(triangles: &[[u32; 3]]) -> Vec<Edge> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (face, &[a, b, c]) in triangles.iter().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let ends = [from.min(to), from.max(to)];
            sides.push((
                ends,
                Side {
                    face,
                    forward: from < to,
                },
            ));
        }
    }
    sides.sort_unstable();
    sides
        .chunk_by(|(one, _), (other, _)| one == other)
        .filter_map(|group| {
            let (ends, _) = group.first()?;
            Some(Edge {
                ends: *ends,
                sides: group.iter().map(|(_, side)| *side).collect(),
            })
        })
        .collect()
}
