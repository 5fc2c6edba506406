//! What a sheet is made of, by the numbers of its nodes: rods, angles between rods, twists, vices.

use super::{Clamp, Stencil, angle::TurnStiffness};
use crate::{
    fabric::{Fabric, Yarn},
    lattice::{Bend, Corner, Rod, Twist},
    math::{Mat3, Vec3},
};

/// A rod by the numbers of its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct SheetRod {
    pub(super) nodes: [u32; 2],
    pub(super) yarn: Yarn,
    pub(super) rest: f64,
    pub(super) width: f64,
    pub(super) floor: f64,
}

/// An angle between the rods `from → to` of two pairs of nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct SheetAngle {
    pub(super) nodes: [u32; 3],
    pub(super) stiffness: f64,
    pub(super) rest: f64,
    /// A bend has its node in the middle of the path; a corner has it first.
    pub(super) bend: bool,
}

/// A cell that resists twist, with its stiffness against a gap between its diagonals [gf/cm].
#[derive(Clone, Copy, Debug)]
pub(super) struct SheetTwist {
    pub(super) nodes: [u32; 4],
    pub(super) stiffness: f64,
}

/// A clamp joint with its stiffness [gf·cm].
#[derive(Clone, Copy, Debug)]
pub(super) struct SheetClamp {
    pub(super) nodes: [u32; 2],
    pub(super) slope: Vec3,
    pub(super) stiffness: f64,
}

impl SheetRod {
    pub(super) fn new(rod: &Rod, fabric: &Fabric) -> Self {
        Self {
            nodes: rod.nodes,
            yarn: rod.yarn,
            rest: rod.rest,
            width: rod.width,
            floor: euler_load(fabric.along(rod.yarn).bending, rod.rest),
        }
    }

    pub(super) fn along(&self, at: &[Vec3]) -> Vec3 {
        self.along_by(&|node| at[node as usize])
    }

    pub(super) fn along_by(&self, get: &impl Fn(u32) -> Vec3) -> Vec3 {
        get(self.nodes[1]) - get(self.nodes[0])
    }
}

impl SheetAngle {
    pub(super) fn of_bend(bend: &Bend, fabric: &Fabric) -> Self {
        Self {
            nodes: bend.nodes,
            stiffness: fabric.along(bend.yarn).bending * bend.width / bend.length,
            rest: bend.rest_angle,
            bend: true,
        }
    }

    pub(super) fn of_corner(corner: &Corner, fabric: &Fabric) -> Self {
        let shear = 0.5 * (fabric.warp.shear + fabric.weft.shear);
        Self {
            nodes: corner.nodes,
            stiffness: shear * corner.area,
            rest: corner.rest_angle,
            bend: false,
        }
    }

    /// The two rods: before and after a bend's node; from a corner's node.
    pub(super) fn rods(&self, at: &[Vec3]) -> (Vec3, Vec3) {
        self.rods_by(&|node| at[node as usize])
    }

    pub(super) fn rods_by(&self, get: &impl Fn(u32) -> Vec3) -> (Vec3, Vec3) {
        let [a, b, c] = self.nodes.map(get);
        if self.bend {
            (b - a, c - b)
        } else {
            (b - a, c - a)
        }
    }

    /// How u and v change with each of the three nodes.
    pub(super) fn signs(&self) -> [(f64, f64); 3] {
        if self.bend {
            [(-1.0, 0.0), (1.0, -1.0), (0.0, 1.0)]
        } else {
            [(-1.0, -1.0), (1.0, 0.0), (0.0, 1.0)]
        }
    }

    pub(super) fn spread(&self, by_u: &Vec3, by_v: &Vec3) -> [Vec3; 3] {
        self.signs().map(|(u, v)| by_u * u + by_v * v)
    }

    /// Hands the blocks between its nodes to `add(row, column, block)`, each pair once.
    pub(super) fn spread_stiffness(
        &self,
        by_rods: &TurnStiffness,
        add: &mut dyn FnMut(u32, u32, &Mat3),
    ) {
        let TurnStiffness { uu, uv, vv } = by_rods;
        let [a, b, c] = self.nodes;
        if self.bend {
            // u = b − a, v = c − b.
            let first = uv - uu;
            let last = uv - vv;
            add(a, a, uu);
            add(a, b, &first);
            add(a, c, &-uv);
            add(b, b, &-(first + last.transpose()));
            add(b, c, &last);
        } else {
            // u = b − a, v = c − a.
            let first = -(uu + uv.transpose());
            let last = -(uv + vv);
            add(a, a, &-(first + last));
            add(a, b, &first);
            add(a, c, &last);
            add(b, b, uu);
            add(b, c, uv);
        }
        add(c, c, vv);
    }

    /// Adds the angle to a node's stencil; `ways` lead from the node to the angle's nodes.
    pub(super) fn add_to(&self, stencil: &mut Stencil, ways: [[i32; 2]; 3]) {
        let [first, middle, last] = ways;
        if self.bend {
            let yarn = if first[1] == last[1] {
                Yarn::Warp
            } else {
                Yarn::Weft
            };
            stencil.add_bend(yarn, middle, self.stiffness, self.rest);
            return;
        }
        // The corner's node, its neighbours along warp and weft: which of them is the node?
        let sum = |a: [i32; 2], b: [i32; 2]| [a[0] + b[0], a[1] + b[1]];
        let (quarter, place) = if first == [0, 0] {
            (sum(middle, last), 0)
        } else if middle == [0, 0] {
            (last, 1)
        } else {
            (middle, 2)
        };
        stencil.add_corner(quarter, place, self.stiffness, self.rest);
    }

    /// Which of its nodes the angle belongs to.
    pub(super) fn own_place(&self) -> u8 {
        u8::from(self.bend)
    }
}

impl SheetTwist {
    pub(super) fn new(twist: &Twist, fabric: &Fabric) -> Self {
        Self {
            nodes: twist.nodes,
            stiffness: fabric.twist * twist.area * twist.per_gap * twist.per_gap,
        }
    }

    pub(super) fn corners(&self, at: &[Vec3]) -> [Vec3; 4] {
        self.nodes.map(|node| at[node as usize])
    }
}

impl SheetClamp {
    pub(super) fn new(clamp: &Clamp, fabric: &Fabric) -> Self {
        Self {
            nodes: clamp.nodes,
            slope: clamp.slope,
            stiffness: 2.0 * fabric.along(clamp.yarn).bending * clamp.width / clamp.length,
        }
    }

    pub(super) fn along(&self, at: &[Vec3]) -> Vec3 {
        at[self.nodes[1] as usize] - at[self.nodes[0] as usize]
    }
}

/// The compression per width at which a rod of this length buckles, π²·M_BN/b² [gf/cm].
fn euler_load(bending: f64, length: f64) -> f64 {
    core::f64::consts::PI * core::f64::consts::PI * bending / (length * length)
}
