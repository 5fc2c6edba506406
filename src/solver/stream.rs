//! The nodes of a lattice in the order in which sweeps read them: so that nodes of one colour stand
//! side by side in memory, and so do their neighbours of each kind.
//!
//! A row of the grid is stored as five lists, by `i mod 5`. The nodes of one colour
//! `(i + 2j) mod 5` are one list of each row, and the neighbours in any one direction are a list
//! too, moved by at most one place. Rows and lists have margins, so no index needs a check; places
//! without a node have the stencil of one that is still.

use super::{level::Level, sweep::LONGEST_MOVE};
use crate::{
    forces::{Blocks, PLACES, Sheet, Stencil, Stencils, StencilsFrom, pulls},
    lanes::{Lanes, Points, Simd, WIDEST, WithSimd, widest},
    lattice::Lattice,
    math::{Mat3, Vec3},
    threads,
};
use std::collections::BTreeMap;

const COLOURS: usize = 5;
/// Rows without nodes on either side.
const MARGIN: usize = 2;
/// No node stands there.
const NONE: u32 = u32::MAX;
/// A move longer than this part of a pitch is checked against the force where it ends.
const CHECKED: f64 = 1e-4;
/// A move may end where it is pulled back by this part of the pull that began it.
const PULLED_BACK: f64 = 0.5;

/// Positions by colours, and what acts there.
#[derive(Debug)]
pub(super) struct Stream {
    /// Places in one list of a row, margins included.
    list: usize,
    /// Rows without the margins.
    rows: usize,
    /// Coordinates of all places [cm].
    axes: [Vec<f64>; 3],
    /// Place of each node.
    place: Vec<u32>,
    /// Node of each place.
    node: Vec<u32>,
    /// For every eight places of a list, which of the patterns acts there.
    pattern: Vec<u32>,
    patterns: Vec<Stencils>,
    /// Where the nodes of one colour go, row by row.
    next: Vec<f64>,
}

impl Stream {
    /// Of a lattice; held nodes stay.
    pub(super) fn new(lattice: &Lattice, sheet: &Sheet<'_>, held: &[bool]) -> Self {
        let least = |axis: usize| lattice.grid.iter().map(|at| at[axis]).min().unwrap_or(0);
        let most = |axis: usize| lattice.grid.iter().map(|at| at[axis]).max().unwrap_or(0);
        let first = [least(0), least(1)];
        let wide = (most(0) - first[0] + 1) as usize;
        let rows = (most(1) - first[1] + 1) as usize;
        let list = wide.div_ceil(COLOURS).next_multiple_of(WIDEST) + 2;
        let places = (rows + 2 * MARGIN) * COLOURS * list;
        let place_of = |at: &[i32; 2]| {
            let [i, j] = [(at[0] - first[0]) as usize, (at[1] - first[1]) as usize];
            (((j + MARGIN) * COLOURS + i % COLOURS) * list + i / COLOURS + 1) as u32
        };
        let place: Vec<u32> = lattice.grid.iter().map(place_of).collect();
        let mut node = vec![NONE; places];
        for (number, place) in (0..).zip(&place) {
            node[*place as usize] = number;
        }
        let mut stream = Self {
            list,
            rows,
            axes: [0; 3].map(|_| vec![0.0; places]),
            place,
            node,
            pattern: Vec::new(),
            patterns: vec![Stencils::alike(&Stencil::STILL)],
            next: vec![0.0; rows * 3 * (list - 2)],
        };
        stream.find_patterns(|node| (!held[node]).then(|| sheet.stencil(node, &lattice.grid)));
        stream
    }

    /// Sorts out which places have the same surroundings; `stencil_of` has none for a held node.
    fn find_patterns(&mut self, stencil_of: impl Fn(usize) -> Option<Stencil>) {
        let mut stencils = vec![Stencil::STILL];
        let mut kinds = BTreeMap::new();
        let mut known = BTreeMap::from([([0; WIDEST], 0)]);
        for row in 0..self.rows {
            for colour in 0..COLOURS {
                let first = self.first(row, colour);
                let nodes = &self.node[first..first + self.list - 2];
                for eight in nodes.chunks_exact(WIDEST) {
                    let mut pattern = [0; WIDEST];
                    for (kind, node) in pattern.iter_mut().zip(eight) {
                        if *node == NONE {
                            continue;
                        }
                        let Some(stencil) = stencil_of(*node as usize) else {
                            continue;
                        };
                        *kind = *kinds.entry(stencil.bits()).or_insert_with(|| {
                            stencils.push(stencil);
                            stencils.len() - 1
                        });
                    }
                    let number = *known.entry(pattern).or_insert_with(|| {
                        let own = pattern.iter().map(|kind| &stencils[*kind]);
                        self.patterns.push(Stencils::mixed(own));
                        self.patterns.len() as u32 - 1
                    });
                    self.pattern.push(number);
                }
            }
        }
    }

    /// Takes positions in [cm].
    fn load(&mut self, at: &[Vec3]) {
        for (place, at) in self.place.iter().zip(at) {
            for (axis, numbers) in self.axes.iter_mut().enumerate() {
                numbers[*place as usize] = at[axis];
            }
        }
    }

    /// The points at a place and after it.
    #[inline(always)]
    fn read<S: Simd>(&self, simd: S, place: usize) -> Points<S> {
        let [x, y, z] = &self.axes;
        Points([
            Lanes::read(simd, &x[place..]),
            Lanes::read(simd, &y[place..]),
            Lanes::read(simd, &z[place..]),
        ])
    }

    /// The first place of a row's list of one colour.
    fn first(&self, row: usize, colour: usize) -> usize {
        let list = (colour + 3 * (row % COLOURS)) % COLOURS;
        ((row + MARGIN) * COLOURS + list) * self.list + 1
    }

    /// How far from a place of this list each of the thirteen points stands.
    fn ways(&self, row: usize, colour: usize) -> [isize; 13] {
        let own = ((colour + 3 * (row % COLOURS)) % COLOURS) as isize;
        let (list, colours) = (self.list as isize, COLOURS as isize);
        PLACES.map(|[along, across]| {
            let to = own + along as isize;
            let lists = across as isize * colours + to.rem_euclid(colours) - own;
            lists * list + to.div_euclid(colours)
        })
    }
}

impl Level<'_> {
    /// Visits every free node once, colour by colour. Returns the longest move [cm].
    pub(super) fn stream_sweep(&mut self) -> f64 {
        let mut stream = core::mem::take(&mut self.stream);
        let stream_ref = stream
            .get_or_insert_with(|| Box::new(Stream::new(self.lattice, &self.sheet, &self.held)));
        stream_ref.load(&self.at);
        let mut longest = 0.0;
        for colour in 0..COLOURS {
            longest = self.visit_colour(stream_ref, colour, longest);
        }
        self.stream = stream;
        self.updates += self.colours.iter().map(Vec::len).sum::<usize>() as u64;
        longest
    }

    fn visit_colour(&mut self, stream: &mut Stream, colour: usize, longest: f64) -> f64 {
        let width = stream.list - 2;
        let mut next = core::mem::take(&mut stream.next);
        {
            let (this, stream) = (&*self, &*stream);
            threads::for_each_row(&mut next, 3 * width, |row, to| {
                widest(Row {
                    level: this,
                    stream,
                    row,
                    colour,
                    to,
                });
            });
        }
        let mut longest = longest;
        for row in 0..stream.rows {
            let first = stream.first(row, colour);
            let to = &next[3 * width * row..3 * width * (row + 1)];
            for k in 0..width {
                let node = stream.node[first + k];
                if node == NONE {
                    continue;
                }
                let there = Vec3::new(to[k], to[width + k], to[2 * width + k]);
                let here = &mut self.at[node as usize];
                longest = f64::max(longest, (there - *here).norm());
                *here = there;
                for (axis, numbers) in stream.axes.iter_mut().enumerate() {
                    numbers[first + k] = there[axis];
                }
            }
        }
        stream.next = next;
        longest
    }
}

/// The visits to one list of a row.
struct Row<'a> {
    level: &'a Level<'a>,
    stream: &'a Stream,
    row: usize,
    colour: usize,
    /// Where the nodes go: all x, all y, all z [cm].
    to: &'a mut [f64],
}

impl WithSimd for Row<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            level,
            stream,
            row,
            colour,
            to,
        } = self;
        let first = stream.first(row, colour);
        let ways = stream.ways(row, colour);
        let width = stream.list - 2;
        let eights = width / WIDEST;
        let patterns = &stream.pattern[(row * COLOURS + colour) * eights..][..eights];
        for start in (0..width).step_by(Lanes::<S>::COUNT) {
            let pattern = patterns[start / WIDEST];
            let place = first + start;
            let mut points = [stream.read(simd, place); 13];
            let put = |to: &mut [f64], there: Points<S>| {
                for (axis, numbers) in there.0.into_iter().enumerate() {
                    numbers.write(&mut to[axis * width + start..]);
                }
            };
            if pattern == 0 {
                put(to, points[0]);
                continue;
            }
            for (point, way) in points.iter_mut().zip(&ways) {
                *point = stream.read(simd, (place as isize + way) as usize);
            }
            let visit = Visit {
                level,
                nodes: &stream.node[place..place + Lanes::<S>::COUNT],
                stencils: stream.patterns[pattern as usize].from(start % WIDEST),
            };
            put(to, visit.go(simd, &mut points));
        }
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
        let (mut force, mut blocks) =
            pulls::<S, true>(simd, level.sheet.fabric(), self.stencils, points);
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
            let (mut after, _) =
                pulls::<S, false>(simd, level.sheet.fabric(), self.stencils, points);
            if meets {
                self.add_forces_after(simd, &mut after, way);
            }
            // Only those, since which others stand beside them must not matter.
            let part = reached(force.dot(way), after.dot(way));
            way = way * checked.choose(part, Lanes::of(simd, 1.0));
        }
        let there = here + way;
        if level.bodies.parts().is_empty() {
            return there;
        }
        self.freely(simd, there)
    }

    /// Adds what is no matter of the grid: touches and vices.
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
    fn add_forces_after<S: Simd>(&self, simd: S, force: &mut Points<S>, way: Points<S>) {
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
        for (sum, numbers) in force.0.iter_mut().zip(&numbers) {
            *sum = *sum + Lanes::read(simd, numbers);
        }
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
        node != NONE && (self.touches.meets(node as usize) || self.vices[node as usize])
    }

    fn other_pull(&self, node: usize) -> (Vec3, Mat3) {
        let (mut force, mut block) = self.touches.pull(node, &self.at);
        if self.vices[node]
            && let Some(vice) = self.sheet.vice(node, &self.at)
        {
            force += vice.force;
            block += vice.stiffness;
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
        force
    }
}
