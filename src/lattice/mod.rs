//! The sheet as geometry (paper C-i, figure 6): nodes at a pitch, joined by rods along warp and
//! weft, cut on grain from an outline. No material and no positions in space are known here.
//!
//! *Cloth coordinates* are (warp, weft) [cm], on the flat cloth, from the outline's centre.
//! *Outline coordinates* are the (x, y) the outline was drawn in, from the same centre; the warp
//! direction stands at the grain angle to their x axis.

mod colours;
mod connected;
mod cut;
mod edge;
mod faces;
mod fault;
mod grain;
mod grid;
mod locate;
mod outline;
mod ring;
#[cfg(test)]
pub(crate) mod sample;
mod seat;
mod twist;
mod weave;

pub use cut::CutError;
pub use fault::OutlineError;
pub use locate::{Locator, Place};
pub use outline::{Edge, Outline};

use crate::{fabric::Yarn, math::Vec2};

/// A piece of cloth before it is divided into nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Where the cloth ends.
    pub outline: Outline,
    /// Angle of the warp against the outline's x axis [rad].
    pub grain: f64,
    /// Wished distance between nodes [cm].
    pub pitch: f64,
}

/// A rod between neighbouring nodes, along one yarn; it pulls by (5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rod {
    /// Its ends, in the direction of the yarn.
    pub nodes: [u32; 2],
    /// Its yarn.
    pub yarn: Yarn,
    /// Length at rest [cm].
    pub rest: f64,
    /// Width of cloth that it stands for [cm]: half a pitch at an edge.
    pub width: f64,
}

/// Two opposite rods of a node; they bend by (6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// Before, at and after the joint, in the direction of the yarn.
    pub nodes: [u32; 3],
    /// Their yarn.
    pub yarn: Yarn,
    /// Length of cloth whose curvature the joint stands for: the mean of both rods [cm].
    pub length: f64,
    /// Width of cloth that it stands for [cm].
    pub width: f64,
    /// Angle between the rods at rest [rad]: 0 but beside an outline that the grid does not follow.
    pub rest_angle: f64,
}

/// The angle between a warp and a weft rod of a node; it shears by (7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The node, its neighbour along the warp, its neighbour along the weft.
    pub nodes: [u32; 3],
    /// Angle between the rods at rest [rad].
    pub rest_angle: f64,
    /// Area of cloth that it stands for: a quarter of its cell, or all of a triangle [cm²].
    pub area: f64,
}

/// A cell of four nodes; it resists twist by how far its diagonals pass each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Its nodes, as in [`Cell`]: one diagonal joins the first and the third, the other the second
    /// and the fourth.
    pub nodes: [u32; 4],
    /// Twist of the cloth over the gap between the diagonals [1/cm²]: 2 over the area, of a
    /// rectangle.
    pub per_gap: f64,
    /// Area of cloth that it stands for: its own, and that of triangles beside it [cm²].
    pub area: f64,
}

/// A mesh of the lattice: four nodes counter-clockwise in cloth coordinates,
/// (0, 0), (1, 0), (1, 1), (0, 1) in steps of (warp, weft).
///
/// Where the outline cuts one of them off, a triangle is left: the missing node's place repeats the
/// node before it (the first one's, the last).
pub type Cell = [u32; 4];

/// A piece divided into nodes. Every list is in lattice order: rows along the weft, within a row
/// along the warp.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lattice {
    /// Greatest distance between neighbours in the grid [cm].
    pub pitch: f64,
    /// Cloth coordinates of each node (warp, weft) [cm].
    pub coordinates: Vec<Vec2>,
    /// Grid indices of each node (along the warp, along the weft).
    pub grid: Vec<[i32; 2]>,
    /// Area of cloth that each node carries [cm²].
    pub area: Vec<f64>,
    /// Rods.
    pub rods: Vec<Rod>,
    /// Pairs of opposite rods.
    pub bends: Vec<Bend>,
    /// Corners.
    pub corners: Vec<Corner>,
    /// Cells that resist twist: those of four nodes, but for few beside the outline.
    pub twists: Vec<Twist>,
    /// Cells.
    pub cells: Vec<Cell>,
}
