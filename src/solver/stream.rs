//! The nodes of a lattice in the order in which sweeps read them: so that nodes of one colour stand
//! side by side in memory, and so do their neighbours of each kind.
//!
//! A row of the grid is stored as five lists, by `i mod 5`. The nodes of one colour
//! `(i + 2j) mod 5` are one list of each row, and the neighbours in any one direction are a list
//! too, moved by at most one place. Rows and lists have margins, so no index needs a check; places
//! without a node have the stencil of one that is still.

use crate::{
    forces::{PLACES, Sheet, Stencil, Stencils, StencilsFrom},
    lanes::{Lanes, Points, Simd, WIDEST, WithSimd, widest},
    lattice::Lattice,
    math::Vec3,
    threads,
};
use std::collections::BTreeMap;

pub(super) const COLOURS: usize = 5;
/// Rows without nodes on either side.
const MARGIN: usize = 2;
/// No node stands there.
pub(super) const NONE: u32 = u32::MAX;

/// Positions by colours, and what acts there.
#[derive(Debug)]
pub(super) struct Stream {
    /// Places in one list of a row, margins included.
    list: usize,
    /// Rows without the margins.
    rows: usize,
    /// Coordinates of all places [cm].
    pub(super) axes: [Vec<f64>; 3],
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
    pub(super) fn load(&mut self, at: &[Vec3]) {
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

    /// Finds the answers for all nodes of a colour.
    pub(super) fn ask<A: Aim>(&mut self, aim: &A, colour: usize) {
        let mut next = core::mem::take(&mut self.next);
        let stream = &*self;
        threads::for_each_row(&mut next, 3 * (stream.list - 2), |row, to| {
            widest(Row {
                aim,
                stream,
                row,
                colour,
                to,
            });
        });
        self.next = next;
    }

    /// Hands out what was last asked for, with each node's number and place.
    pub(super) fn each_answer(&self, colour: usize, mut take: impl FnMut(usize, usize, Vec3)) {
        let width = self.list - 2;
        for (row, to) in self.next.chunks_exact(3 * width).enumerate() {
            let first = self.first(row, colour);
            for k in 0..width {
                let node = self.node[first + k];
                if node != NONE {
                    let answer = Vec3::new(to[k], to[width + k], to[2 * width + k]);
                    take(node as usize, first + k, answer);
                }
            }
        }
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

/// What is asked about the nodes of a list.
pub(super) trait Aim: Sync {
    /// The answer where nothing moves.
    fn still<S: Simd>(&self, here: Points<S>) -> Points<S>;
    /// The answer for nodes side by side and the points about them.
    fn of<S: Simd>(
        &self,
        simd: S,
        nodes: &[u32],
        stencils: StencilsFrom<'_>,
        points: &mut [Points<S>; 13],
    ) -> Points<S>;
}

/// One list of a row, and room for the answers.
struct Row<'a, A> {
    aim: &'a A,
    stream: &'a Stream,
    row: usize,
    colour: usize,
    /// The answers: all x, all y, all z.
    to: &'a mut [f64],
}

impl<A: Aim> WithSimd for Row<'_, A> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            aim,
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
            let answer = if pattern == 0 {
                aim.still(points[0])
            } else {
                for (point, way) in points.iter_mut().zip(&ways) {
                    *point = stream.read(simd, (place as isize + way) as usize);
                }
                let nodes = &stream.node[place..place + Lanes::<S>::COUNT];
                let stencils = stream.patterns[pattern as usize].from(start % WIDEST);
                aim.of(simd, nodes, stencils, &mut points)
            };
            for (axis, numbers) in answer.0.into_iter().enumerate() {
                numbers.write(&mut to[axis * width + start..]);
            }
        }
    }
}
