//! The nodes along one side of an outline.

use crate::{
    lattice::{Edge, Lattice, Piece},
    math::Vec2,
};

/// A node this close to a straight side lies on it [cm].
const ON_SIDE: f64 = 1e-6;
/// Where the outline is not a rectangle: how far from its extreme a node still counts, in pitches.
const NEAR_EXTREME: f64 = 0.26;

impl Piece {
    /// The nodes of a lattice of this piece that lie on a side of the outline's bounding box, in
    /// lattice order: within 1e-6 cm of it if the outline is a rectangle, else within 0.26 pitch;
    /// of an outline so pointed that none is, those nearest to it.
    #[must_use]
    pub fn edge_nodes(&self, lattice: &Lattice, edge: Edge) -> Vec<u32> {
        let straight = self.outline.rectangle_size().is_some();
        let reach = if straight {
            ON_SIDE
        } else {
            NEAR_EXTREME * lattice.pitch
        };
        let (low, high) = self.outline.bounds();
        let distance = |coordinate: &Vec2| {
            let at = self.to_outline(*coordinate);
            match edge {
                Edge::XMin => at.x - low.x,
                Edge::XMax => high.x - at.x,
                Edge::YMin => at.y - low.y,
                Edge::YMax => high.y - at.y,
            }
        };
        let distances: Vec<f64> = lattice.coordinates.iter().map(distance).collect();
        let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
        let reach = reach.max(nearest + ON_SIDE);
        let nodes = (0_u32..).zip(distances);
        nodes
            .filter(|(_, distance)| *distance <= reach)
            .map(|(node, _)| node)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::{
        Outline,
        sample::{piece, points},
    };

    const EDGES: [Edge; 4] = [Edge::XMin, Edge::XMax, Edge::YMin, Edge::YMax];

    fn counts(outline: Outline, degrees: f64, pitch: f64) -> [usize; 4] {
        let piece = piece(outline, degrees, pitch);
        let lattice = piece.cut(pitch).unwrap();
        EDGES.map(|edge| piece.edge_nodes(&lattice, edge).len())
    }

    #[test]
    fn a_rectangle_has_its_sides_nodes_whatever_the_quarter_turn() {
        let towel = || Outline::rectangle(6.0, 4.0).unwrap();
        for degrees in [0.0, 90.0, 180.0, 270.0] {
            assert_eq!(counts(towel(), degrees, 0.5), [9, 9, 13, 13]);
        }
    }

    #[test]
    fn a_side_on_the_bias_has_a_node_at_every_diagonal() {
        let diagonal = 0.5 * 2.0_f64.sqrt();
        let towel = Outline::rectangle(12.0 * diagonal, 8.0 * diagonal).unwrap();
        assert_eq!(counts(towel, 45.0, 0.5), [9, 9, 13, 13]);
    }

    /// A coarse lattice that ended short of a tip once let a cloth fall that was held there.
    #[test]
    fn a_pointed_outline_is_held_at_its_points_at_any_pitch() {
        let tips = [[4.7, 0.0], [0.0, 4.8], [-1.5, 0.0], [0.0, -5.9]];
        let kite = || Outline::polygon(points(&tips), Vec::new()).unwrap();
        for pitch in [0.1, 0.17, 0.34, 0.68, 1.36] {
            let counts = counts(kite(), 90.0, pitch);
            assert!(
                counts.iter().all(|count| (1..4).contains(count)),
                "{counts:?} at {pitch}"
            );
        }
    }

    #[test]
    fn a_disc_has_the_nodes_near_its_ends() {
        let [left, right, lower, upper] = counts(Outline::disc(15.0).unwrap(), 0.0, 0.5);
        assert_eq!((left, left, left), (right, lower, upper));
        assert!((3..=9).contains(&left), "{left}");
    }
}
