//! The nodes of a lattice in the order in which sweeps read them: so that nodes of one colour stand
//! side by side in memory, and so do their neighbours of each kind.
//!
//! A row of the grid is stored as five lists, by `i mod 5`, of each coordinate. The nodes of one
//! colour `(i + 2j) mod 5` are one list of each row, and the neighbours in any one direction are a
//! list too, moved by at most one place. Rows and lists have margins, so no index needs a check;
//! places without a node have the stencil of one that is still.

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
    /// Coordinates of all places [cm]: of each row x, then y, then z.
    at: Vec<f64>,
    /// What was last asked for, in the same order, without the rows of the margins.
    answers: Vec<f64>,
    /// Place of each node: where its x stands.
    place: Vec<u32>,
    /// Node of each place of a row without the margins, row by row.
    node: Vec<u32>,
    /// For every eight places of a list, which of the patterns acts there.
    pattern: Vec<u32>,
    patterns: Vec<Stencils>,
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
        let all = rows * COLOURS * list;
        let wide = 3 * COLOURS * list;
        let spot_of = |at: &[i32; 2]| {
            let [i, j] = [(at[0] - first[0]) as usize, (at[1] - first[1]) as usize];
            [j, (i % COLOURS) * list + i / COLOURS + 1]
        };
        let mut place = Vec::with_capacity(lattice.grid.len());
        let mut node = vec![NONE; all];
        for (number, [row, spot]) in (0..).zip(lattice.grid.iter().map(spot_of)) {
            node[row * COLOURS * list + spot] = number;
            place.push(((row + MARGIN) * wide + spot) as u32);
        }
        let mut stream = Self {
            list,
            rows,
            at: vec![0.0; (rows + 2 * MARGIN) * wide],
            answers: vec![0.0; 3 * all],
            place,
            node,
            pattern: Vec::new(),
            patterns: vec![Stencils::alike(&Stencil::STILL)],
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
                let nodes = self.nodes(row, colour).to_vec();
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
        let (wide, row_of_nodes) = (self.wide(), COLOURS * self.list);
        let within = MARGIN * wide..(MARGIN + self.rows) * wide;
        let nodes = &self.node;
        threads::for_each_row(&mut self.at[within], wide, |row, to| {
            let nodes = &nodes[row * row_of_nodes..][..row_of_nodes];
            for (spot, node) in nodes.iter().enumerate() {
                if let Some(at) = at.get(*node as usize) {
                    for axis in 0..3 {
                        to[axis * row_of_nodes + spot] = at[axis];
                    }
                }
            }
        });
    }

    /// Where the nodes are [cm].
    pub(super) fn positions(&self) -> Vec<Vec3> {
        self.gather(&self.at, 0)
    }

    /// What was last asked for of each node.
    pub(super) fn answers(&self) -> Vec<Vec3> {
        self.gather(&self.answers, MARGIN * self.wide())
    }

    /// What stands at the nodes' places in a list that begins at one of them.
    fn gather(&self, numbers: &[f64], begins: usize) -> Vec<Vec3> {
        let coordinate = COLOURS * self.list;
        threads::map(self.place.len(), |node| {
            let place = self.place[node] as usize - begins;
            Vec3::from_fn(|axis, _| numbers[place + axis * coordinate])
        })
    }

    /// The points at a place and after it.
    #[inline(always)]
    fn read<S: Simd>(&self, simd: S, place: usize) -> Points<S> {
        let coordinate = COLOURS * self.list;
        Points([
            Lanes::read(simd, &self.at[place..]),
            Lanes::read(simd, &self.at[place + coordinate..]),
            Lanes::read(simd, &self.at[place + 2 * coordinate..]),
        ])
    }

    /// Finds the answers for all nodes of some colours.
    pub(super) fn ask<A: Aim>(&mut self, aim: &A, colours: core::ops::Range<usize>) {
        let mut answers = core::mem::take(&mut self.answers);
        let stream = &*self;
        threads::for_each_row(&mut answers, self.wide(), |row, to| {
            for colour in colours.clone() {
                widest(Row {
                    aim,
                    stream,
                    row,
                    colour,
                    to,
                });
            }
        });
        self.answers = answers;
    }

    /// Moves the nodes of a colour to what was last asked for.
    pub(super) fn go(&mut self, colour: usize) {
        let (wide, width) = (self.wide(), self.list - 2);
        let within = MARGIN * wide..(MARGIN + self.rows) * wide;
        let (list, answers) = (self.list, &self.answers);
        threads::for_each_row(&mut self.at[within], wide, |row, to| {
            for axis in 0..3 {
                let first = (axis * COLOURS + list_of(row, colour)) * list + 1;
                to[first..first + width].copy_from_slice(&answers[row * wide + first..][..width]);
            }
        });
    }

    /// Hands out where the nodes of a colour are [cm].
    pub(super) fn each(&self, colour: usize, mut take: impl FnMut(usize, Vec3)) {
        let coordinate = COLOURS * self.list;
        for row in 0..self.rows {
            let first = self.first(row, colour);
            for (k, node) in self.nodes(row, colour).iter().enumerate() {
                if *node != NONE {
                    let at = |axis, _| self.at[first + k + axis * coordinate];
                    take(*node as usize, Vec3::from_fn(at));
                }
            }
        }
    }

    /// Numbers in a row: three coordinates of all places.
    fn wide(&self) -> usize {
        3 * COLOURS * self.list
    }

    /// The nodes of a row's list of one colour.
    fn nodes(&self, row: usize, colour: usize) -> &[u32] {
        let first = (row * COLOURS + list_of(row, colour)) * self.list + 1;
        &self.node[first..first + self.list - 2]
    }

    /// The first place of a row's list of one colour.
    fn first(&self, row: usize, colour: usize) -> usize {
        (row + MARGIN) * self.wide() + list_of(row, colour) * self.list + 1
    }

    /// How far from a place of this list each of the thirteen points stands.
    fn ways(&self, row: usize, colour: usize) -> [isize; 13] {
        let own = list_of(row, colour) as isize;
        let (list, colours) = (self.list as isize, COLOURS as isize);
        PLACES.map(|[along, across]| {
            let to = own + along as isize;
            let lists = across as isize * 3 * colours + to.rem_euclid(colours) - own;
            lists * list + to.div_euclid(colours)
        })
    }
}

/// Which list of a row has the nodes of a colour.
fn list_of(row: usize, colour: usize) -> usize {
    (colour + 3 * (row % COLOURS)) % COLOURS
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
    /// The row's answers.
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
        let first_answer = list_of(row, colour) * stream.list + 1;
        let ways = stream.ways(row, colour);
        let nodes = stream.nodes(row, colour);
        let width = nodes.len();
        let eights = width / WIDEST;
        let patterns = &stream.pattern[(row * COLOURS + colour) * eights..][..eights];
        for start in (0..width).step_by(Lanes::<S>::COUNT) {
            let pattern = patterns[start / WIDEST];
            let place = first + start;
            let answer = if pattern == 0 {
                aim.still(stream.read(simd, place))
            } else {
                let at = |k: usize| stream.read(simd, (place as isize + ways[k]) as usize);
                let mut points = [
                    at(0),
                    at(1),
                    at(2),
                    at(3),
                    at(4),
                    at(5),
                    at(6),
                    at(7),
                    at(8),
                    at(9),
                    at(10),
                    at(11),
                    at(12),
                ];
                let nodes = &nodes[start..start + Lanes::<S>::COUNT];
                let stencils = stream.patterns[pattern as usize].from(start % WIDEST);
                aim.of(simd, nodes, stencils, &mut points)
            };
            for (axis, numbers) in answer.0.into_iter().enumerate() {
                let coordinate = axis * COLOURS * stream.list;
                numbers.write(&mut to[first_answer + start + coordinate..]);
            }
        }
    }
}
