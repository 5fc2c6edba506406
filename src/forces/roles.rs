//! Which elements act on a node, found once.

use super::elements::{SheetAngle, SheetClamp, SheetRod, SheetTwist};

/// Where a node appears in an element, and as which of its nodes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Role {
    Rod(u32, u8),
    Angle(u32, u8),
    Twist(u32, u8),
    Clamp(u32),
}

/// The roles of every node.
#[derive(Clone, Debug)]
pub(super) struct Roles {
    roles: Vec<Role>,
    first: Vec<u32>,
}

impl Roles {
    /// Of so many nodes in all elements: each node's roles keep the elements' order, vices last.
    pub(super) fn new(
        nodes: usize,
        rods: &[SheetRod],
        angles: &[SheetAngle],
        twists: &[SheetTwist],
        clamps: &[SheetClamp],
    ) -> Self {
        let mut named: Vec<(u32, Role)> = Vec::new();
        for (index, rod) in (0..).zip(rods) {
            named.extend(
                (0..)
                    .zip(rod.nodes)
                    .map(|(end, node)| (node, Role::Rod(index, end))),
            );
        }
        for (index, angle) in (0..).zip(angles) {
            let places = (0..).zip(angle.nodes);
            named.extend(places.map(|(place, node)| (node, Role::Angle(index, place))));
        }
        for (index, twist) in (0..).zip(twists) {
            let places = (0..).zip(twist.nodes);
            named.extend(places.map(|(place, node)| (node, Role::Twist(index, place))));
        }
        let clamps = (0..).zip(clamps);
        named.extend(clamps.map(|(index, clamp)| (clamp.nodes[1], Role::Clamp(index))));
        named.sort_by_key(|(node, _)| *node);
        let mut first = vec![0_u32; nodes + 1];
        for (node, _) in &named {
            first[*node as usize + 1] += 1;
        }
        for node in 0..nodes {
            first[node + 1] += first[node];
        }
        Self {
            roles: named.into_iter().map(|(_, role)| role).collect(),
            first,
        }
    }

    /// Those of a node.
    pub(super) fn of(&self, node: usize) -> &[Role] {
        &self.roles[self.first[node] as usize..self.first[node + 1] as usize]
    }
}
