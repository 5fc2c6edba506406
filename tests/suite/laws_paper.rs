//! `forces = "paper"`: figures 7–9 to the letter, from the closed form of each law.

use crate::specimen::{crumpled, fabric, linear, shapes, towel};
use proptest::prelude::*;
use soen::{
    fabric::Fabric,
    forces::{Laws, RodLaw, Sheet, paper_forces, turn, turn_stiffness},
    lattice::Lattice,
    math::{Mat3, Vec3},
};

proptest! {
    #![proptest_config(shapes(24))]

    #[test]
    fn a_node_feels_its_own_4_tensions_2_bends_and_4_shears(
        at in crumpled(&towel(4.0, 4.0, 1.0), 0.2),
    ) {
        let lattice = towel(4.0, 4.0, 1.0);
        for cloth in [fabric("c"), linear(&fabric("d"))] {
            let sheet = Sheet::new(&lattice, &cloth, Laws::default(), &[]);
            for node in 0..at.len() {
                let own = Own { lattice: &lattice, cloth: &cloth, node: node as u32 };
                let (force, stiffness) = own.force_and_stiffness(&at);
                let pull = paper_forces(&sheet, node, &at);
                let (size, error) = (force.norm(), (pull.force - force).norm());
                prop_assert!(error <= 1e-11 * (1.0 + size), "node {node}: {error} of {size}");
                // (8)'s derivative is numerical.
                let (size, error) = (stiffness.amax(), (pull.stiffness - stiffness).amax());
                prop_assert!(error <= 1e-5 * (1.0 + size), "node {node}: {error} of {size}");
            }
        }
    }
}

#[test]
fn an_inner_node_has_4_rods_2_bends_and_4_corners() {
    let lattice = towel(4.0, 4.0, 1.0);
    let middle = 12;
    assert_eq!(lattice.grid[middle as usize], [2, 2]);
    let rods = lattice
        .rods
        .iter()
        .filter(|rod| rod.nodes.contains(&middle));
    let bends = lattice.bends.iter().filter(|bend| bend.nodes[1] == middle);
    let corners = lattice
        .corners
        .iter()
        .filter(|corner| corner.nodes[0] == middle);
    assert_eq!((rods.count(), bends.count(), corners.count()), (4, 2, 4));
}

/// What figures 7–9 draw around one node.
struct Own<'a> {
    lattice: &'a Lattice,
    cloth: &'a Fabric,
    node: u32,
}

impl Own<'_> {
    fn force_and_stiffness(&self, at: &[Vec3]) -> (Vec3, Mat3) {
        let weight = self.lattice.area[self.node as usize] * self.cloth.weight;
        let mut sum = (Vec3::new(0.0, 0.0, -weight), Mat3::zeros());
        self.add_tensions(at, &mut sum);
        self.add_bends(at, &mut sum);
        self.add_shears(at, &mut sum);
        sum
    }

    /// (5), towards each neighbour.
    fn add_tensions(&self, at: &[Vec3], sum: &mut (Vec3, Mat3)) {
        for rod in self
            .lattice
            .rods
            .iter()
            .filter(|rod| rod.nodes.contains(&self.node))
        {
            let other = rod.nodes[usize::from(rod.nodes[0] == self.node)];
            let along = at[other as usize] - at[self.node as usize];
            let direction = self.cloth.along(rod.yarn);
            let pi = core::f64::consts::PI;
            let law = RodLaw {
                tension: &direction.tension,
                rest: rod.rest,
                width: rod.width,
                floor: pi * pi * direction.bending / (rod.rest * rod.rest),
            };
            sum.0 += law.pull(&along);
            sum.1 += law.stiffness(&along, false);
        }
    }

    /// (6): moving the node moves u = b − a along and v = c − b against.
    fn add_bends(&self, at: &[Vec3], sum: &mut (Vec3, Mat3)) {
        for bend in self
            .lattice
            .bends
            .iter()
            .filter(|bend| bend.nodes[1] == self.node)
        {
            let [a, b, c] = bend.nodes.map(|node| at[node as usize]);
            let stiffness = self.cloth.along(bend.yarn).bending * bend.width / bend.length;
            let (u, v, rest) = (b - a, c - b, bend.rest_angle);
            let law = turn(&u, &v, stiffness, rest);
            sum.0 += law.by_v - law.by_u;
            let blocks = turn_stiffness(&u, &v, stiffness, rest);
            sum.1 += blocks.uu + blocks.vv - blocks.uv - blocks.uv.transpose();
        }
    }

    /// (7): moving the node moves both rods against.
    fn add_shears(&self, at: &[Vec3], sum: &mut (Vec3, Mat3)) {
        let shear = 0.5 * (self.cloth.warp.shear + self.cloth.weft.shear);
        for corner in self
            .lattice
            .corners
            .iter()
            .filter(|corner| corner.nodes[0] == self.node)
        {
            let [node, a, b] = corner.nodes.map(|node| at[node as usize]);
            let (u, v, rest) = (a - node, b - node, corner.rest_angle);
            let law = turn(&u, &v, shear * corner.area, rest);
            sum.0 += law.by_u + law.by_v;
            let blocks = turn_stiffness(&u, &v, shear * corner.area, rest);
            sum.1 += blocks.uu + blocks.vv + blocks.uv + blocks.uv.transpose();
        }
    }
}
