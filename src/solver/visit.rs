//! Visits to nodes side by side: the paper's solver, node by node to each node's own equilibrium by
//! the 3×3 system (8), for as many nodes of a colour as the processor takes at once.

use super::{
    level::Level,
    stream::{Aim, COLOURS, NONE, Stream},
    sweep::LONGEST_MOVE,
};
use crate::{
    fabric::Fabric,
    forces::{Blocks, StencilsFrom, pulls, work_of_rods},
    lanes::{Lanes, Points, Simd, WIDEST},
    math::{Mat3, Vec3},
    threads,
};

/// A move longer than this part of a pitch is checked against the force where it ends.
const CHECKED: f64 = 1e-4;
/// A move may end where it is pulled back by this part of the pull that began it.
const PULLED_BACK: f64 = 0.5;

impl Level<'_> {
    /// Visits every free node once, colour by colour. Returns the longest move [cm].
    pub(super) fn stream_sweep(&mut self) -> f64 {
        let mut stream = self.loaded();
        // Touches and vices ask where other nodes are meanwhile.
        let watched = !self.bodies.parts().is_empty() || self.vices.contains(&true);
        let begun = if watched { self.at.clone() } else { Vec::new() };
        for colour in 0..COLOURS {
            stream.ask(&Goals(self), colour..colour + 1);
            stream.go(colour);
            if watched {
                stream.each(colour, |node, there| self.at[node] = there);
            }
        }
        let last = core::mem::replace(&mut self.at, stream.positions());
        self.stream = Some(stream);
        let (from, at) = (if watched { &begun } else { &last }, &self.at);
        threads::most(at.len(), |node| (at[node] - from[node]).norm())
    }

    /// The cloth's and the weight's forces on every node at once [gf].
    fn stream_forces(&mut self) -> Vec<Vec3> {
        let mut stream = self.loaded();
        stream.ask(&Pulls(self.sheet.fabric()), 0..COLOURS);
        let forces = stream.answers();
        self.stream = Some(stream);
        forces
    }

    /// The stream, with the positions of now.
    fn loaded(&mut self) -> Box<Stream> {
        let stream = core::mem::take(&mut self.stream);
        let mut stream =
            stream.unwrap_or_else(|| Box::new(Stream::new(self.lattice, &self.sheet, &self.held)));
        stream.load(&self.at);
        stream
    }
}

/// Where nodes go when they are visited.
struct Goals<'a>(&'a Level<'a>);

impl Aim for Goals<'_> {
    #[inline(always)]
    fn still<S: Simd>(&self, here: Points<S>) -> Points<S> {
        here
    }

    #[inline(always)]
    fn of<S: Simd>(
        &self,
        simd: S,
        nodes: &[u32],
        stencils: StencilsFrom<'_>,
        points: &mut [Points<S>; 13],
    ) -> Points<S> {
        let visit = Visit {
            level: self.0,
            nodes,
            stencils,
        };
        visit.go(simd, points)
    }
}

/// What pulls on nodes.
struct Pulls<'a>(&'a Fabric);

impl Aim for Pulls<'_> {
    #[inline(always)]
    fn still<S: Simd>(&self, here: Points<S>) -> Points<S> {
        Points::zero(here.0[0].kind())
    }

    #[inline(always)]
    fn of<S: Simd>(
        &self,
        simd: S,
        _: &[u32],
        stencils: StencilsFrom<'_>,
        points: &mut [Points<S>; 13],
    ) -> Points<S> {
        pulls::<S, false>(simd, self.0, stencils, points).0
    }
}

/// Visits to nodes side by side.
struct Visit<'a> {
    level: &'a Level<'a>,
    nodes: &'a [u32],
    stencils: StencilsFrom<'a>,
}

impl Visit<'_> {
    /// Where the nodes' own equilibria are, by (8), within the longest move and the free way.
    #[inline(always)]
    fn go<S: Simd>(&self, simd: S, points: &mut [Points<S>; 13]) -> Points<S> {
        let level = self.level;
        let here = points[0];
        let fabric = level.sheet.fabric();
        let (mut force, mut blocks, rods) = pulls::<S, true>(simd, fabric, self.stencils, points);
        let (own_force, own_blocks) = (force, blocks);
        let meets = self.nodes.iter().any(|node| level.meets_more(*node));
        if meets {
            self.add_others(simd, &mut force, &mut blocks);
        }
        let pitch = level.lattice.pitch;
        blocks.add_identity(self.stencils.weight(simd) * (1.0 / pitch));
        let mut way = blocks.solve(force);
        let longest = Lanes::of(simd, LONGEST_MOVE * pitch);
        way = way * longest.over(way.norm().max(longest));
        way = way * self.stencils.moves(simd);
        let checked = Lanes::of(simd, CHECKED * pitch).less_than(way.norm());
        if checked.anywhere() {
            points[0] = here + way;
            // Tension is what turns round within a move; all else is near enough by its stiffness.
            let mut after = own_force.dot(way) - own_blocks.square_of(way) - rods.along(way)
                + work_of_rods(simd, fabric, self.stencils, points, way);
            if meets {
                after = after + self.others_after(simd, way).dot(way);
            }
            // Only those, since which others stand beside them must not matter.
            let part = reached(force.dot(way), after);
            way = way * checked.choose(part, Lanes::of(simd, 1.0));
        }
        let there = here + way;
        if level.bodies.parts().is_empty() {
            return there;
        }
        self.freely(simd, there)
    }

    /// Adds what is no matter of the grid: touches, vices and momentum.
    #[inline(never)]
    fn add_others<S: Simd>(&self, simd: S, force: &mut Points<S>, blocks: &mut Blocks<S>) {
        let mut numbers = [[0.0; WIDEST]; 9];
        for (k, node) in self.nodes.iter().enumerate() {
            if !self.level.meets_more(*node) {
                continue;
            }
            let (push, block) = self.level.other_pull(*node as usize);
            let all = [
                push.x,
                push.y,
                push.z,
                block[(0, 0)],
                block[(1, 1)],
                block[(2, 2)],
                block[(0, 1)],
                block[(0, 2)],
                block[(1, 2)],
            ];
            for (numbers, number) in numbers.iter_mut().zip(all) {
                numbers[k] = number;
            }
        }
        for (sum, numbers) in force.0.iter_mut().chain(&mut blocks.0).zip(&numbers) {
            *sum = *sum + Lanes::read(simd, numbers);
        }
    }

    /// The same forces after a way [cm].
    #[inline(never)]
    fn others_after<S: Simd>(&self, simd: S, way: Points<S>) -> Points<S> {
        let ways = numbers_of(way);
        let mut numbers = [[0.0; WIDEST]; 3];
        for (k, node) in self.nodes.iter().enumerate() {
            if self.level.meets_more(*node) {
                let way = Vec3::from_fn(|axis, _| ways[axis][k]);
                let push = self.level.other_force_after(*node as usize, &way);
                for (numbers, number) in numbers.iter_mut().zip(push.iter()) {
                    numbers[k] = *number;
                }
            }
        }
        Points(numbers.map(|numbers| Lanes::read(simd, &numbers)))
    }

    /// As far as bodies leave free.
    #[inline(never)]
    fn freely<S: Simd>(&self, simd: S, there: Points<S>) -> Points<S> {
        let mut to = numbers_of(there);
        let mut stopped = false;
        for (k, node) in self.nodes.iter().enumerate() {
            if *node == NONE || self.level.held[*node as usize] {
                continue;
            }
            let wished = Vec3::from_fn(|axis, _| to[axis][k]);
            let free = self.level.free_way(*node as usize, wished);
            stopped |= free != wished;
            for (numbers, number) in to.iter_mut().zip(free.iter()) {
                numbers[k] = *number;
            }
        }
        if stopped {
            Points(to.map(|numbers| Lanes::read(simd, &numbers)))
        } else {
            there
        }
    }
}

#[inline(always)]
fn numbers_of<S: Simd>(points: Points<S>) -> [[f64; WIDEST]; 3] {
    points.0.map(|lanes| {
        let mut numbers = [0.0; WIDEST];
        lanes.write(&mut numbers);
        numbers
    })
}

/// The part of a way that ends about where the force along it does, by the secant, if it went
/// well beyond. `before` and `after` are the force's work along the way at its begin and end.
#[inline(always)]
fn reached<S: Simd>(before: Lanes<S>, after: Lanes<S>) -> Lanes<S> {
    let one = Lanes::of(before.kind(), 1.0);
    let beyond = after.less_than(before * -PULLED_BACK);
    beyond.choose(before.over(before - after), one)
}

impl Level<'_> {
    /// Whether something acts on a node that its stencil does not know.
    fn meets_more(&self, node: u32) -> bool {
        node != NONE
            && (self.touches.meets(node as usize)
                || self.vices[node as usize]
                || self.momentum.is_some())
    }

    /// [`forces`](Level::forces), near enough to travel by: to some 1e-9 of the laws' own size.
    pub(super) fn quick_forces(&mut self) -> Vec<Vec3> {
        let mut forces = self.stream_forces();
        self.touches.add_forces(&self.at, &mut forces);
        self.add_momentum(&self.at, &mut forces);
        for (node, force) in forces.iter_mut().enumerate() {
            if self.held[node] {
                *force = Vec3::zeros();
            } else if self.vices[node]
                && let Some(vice) = self.sheet.vice(node, &self.at)
            {
                *force += vice.force;
            }
        }
        forces
    }

    fn other_pull(&self, node: usize) -> (Vec3, Mat3) {
        let (mut force, mut block) = self.touches.pull(node, &self.at);
        if self.vices[node]
            && let Some(vice) = self.sheet.vice(node, &self.at)
        {
            force += vice.force;
            block += vice.stiffness;
        }
        if let Some(momentum) = &self.momentum {
            force += momentum.force(node, &self.at[node]);
            block += Mat3::identity() * momentum.stiffness(node);
        }
        (force, block)
    }

    fn other_force_after(&self, node: usize, way: &Vec3) -> Vec3 {
        let mut force = self.touches.force_after(node, way, &self.at);
        if self.vices[node]
            && let Some(vice) = self.sheet.vice(node, &self.at)
        {
            force += vice.force - vice.stiffness * way;
        }
        if let Some(momentum) = &self.momentum {
            force += momentum.force(node, &(self.at[node] + way));
        }
        force
    }
}
