//! A node and all that acts on it, as numbers in a fixed order: so that nodes with the same
//! surroundings share one list, and nodes side by side read theirs by one index.
//!
//! A node's laws reach two steps along each yarn and one step diagonally:
//! ```text
//!             7
//!        10   3   9          0 the node; 1, 2 east (along the warp), west; 3, 4 north
//!     6   2   0   1   5      (along the weft), south; 5 to 8 two steps; 9 to 12 diagonal
//!        11   4   12
//!             8
//! ```

use crate::{
    fabric::Yarn,
    lanes::{Lanes, Simd, WIDEST},
};

/// Where the thirteen points are, in steps along (warp, weft).
pub(crate) const PLACES: [[i32; 2]; 13] = [
    [0, 0],
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
    [2, 0],
    [-2, 0],
    [0, 2],
    [0, -2],
    [1, 1],
    [-1, 1],
    [-1, -1],
    [1, -1],
];

/// Whether the node moves (1 or 0).
pub(super) const MOVES: usize = 0;
/// Its weight [gf].
pub(super) const WEIGHT: usize = 1;
/// Whether no bend has an angle at rest, and every corner a right one (1 or 0).
pub(super) const ON_GRAIN: usize = 2;
/// Four rods, to points 1 to 4: 1/rest length [1/cm], width [cm], greatest compression [gf/cm].
pub(super) const RODS: usize = 3;
/// Six bends: of the node along warp and weft, then about points 1 to 4: stiffness [gf·cm], angle
/// at rest [rad].
pub(super) const BENDS: usize = RODS + 12;
/// For each of the four quarters, NE, NW, SW, SE: the node's own corner, that of the neighbour along
/// the warp, that of the neighbour along the weft: stiffness [gf·cm], angle at rest [rad].
pub(super) const CORNERS: usize = BENDS + 12;
/// The twists of the cells in the four quarters: stiffness [gf/cm].
pub(super) const TWISTS: usize = CORNERS + 24;
/// How many numbers there are.
pub(super) const SIZE: usize = TWISTS + 4;

/// The numbers of one node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stencil(pub(super) [f64; SIZE]);

impl Stencil {
    /// Of a place without a node, or of one that is held: nothing acts, nothing moves.
    pub(crate) const STILL: Self = {
        let mut numbers = [0.0; SIZE];
        numbers[WEIGHT] = 1.0;
        numbers[ON_GRAIN] = 1.0;
        Self(numbers)
    };

    /// Of a node that only weight [gf] acts on.
    pub(super) fn of_weight(weight: f64) -> Self {
        let mut stencil = Self::STILL;
        stencil.0[MOVES] = 1.0;
        stencil.0[WEIGHT] = weight;
        stencil
    }

    /// Its numbers as bits, to find equal ones by.
    pub(crate) fn bits(&self) -> [u64; SIZE] {
        self.0.map(f64::to_bits)
    }

    fn twisting(&self) -> bool {
        self.0[TWISTS..].iter().any(|stiffness| *stiffness != 0.0)
    }

    /// Adds a rod towards a neighbour.
    pub(super) fn add_rod(&mut self, way: [i32; 2], rest: f64, width: f64, floor: f64) {
        let at = RODS + 3 * direction(way);
        self.0[at..at + 3].copy_from_slice(&[1.0 / rest, width, floor]);
    }

    /// Adds a bend: of the node itself, or about the neighbour `way` from it.
    pub(super) fn add_bend(&mut self, yarn: Yarn, way: [i32; 2], stiffness: f64, rest: f64) {
        let place = match way {
            [0, 0] => yarn as usize,
            _ => 2 + direction(way),
        };
        let at = BENDS + 2 * place;
        if rest != 0.0 {
            self.0[ON_GRAIN] = 0.0;
        }
        self.0[at..at + 2].copy_from_slice(&[stiffness, rest]);
    }

    /// Adds the twist of the cell whose far node is `way` from the node.
    pub(super) fn add_twist(&mut self, way: [i32; 2], stiffness: f64) {
        self.0[TWISTS + quarter(way)] = stiffness;
    }

    /// Adds a corner in the quarter towards `way`: the node's own (place 0), or that of the
    /// neighbour along warp (1) or weft (2).
    pub(super) fn add_corner(&mut self, way: [i32; 2], place: usize, stiffness: f64, rest: f64) {
        let at = CORNERS + 6 * quarter(way) + 2 * place;
        if rest != core::f64::consts::FRAC_PI_2 {
            self.0[ON_GRAIN] = 0.0;
        }
        self.0[at..at + 2].copy_from_slice(&[stiffness, rest]);
    }
}

/// The stencils of eight nodes side by side.
#[derive(Clone, Debug)]
pub(crate) struct Stencils {
    numbers: [[f64; WIDEST]; SIZE],
    /// Whether no bend has an angle at rest, and every corner a right one.
    on_grain: bool,
    /// Whether a cell resists twist.
    twisting: bool,
}

impl Stencils {
    /// The same stencil for all.
    pub(crate) fn alike(stencil: &Stencil) -> Self {
        Self {
            numbers: stencil.0.map(|number| [number; WIDEST]),
            on_grain: stencil.0[ON_GRAIN] == 1.0,
            twisting: stencil.twisting(),
        }
    }

    /// One of its own for each.
    pub(crate) fn mixed<'a>(stencils: impl Iterator<Item = &'a Stencil>) -> Self {
        let mut all = Self::alike(&Stencil::STILL);
        for (k, stencil) in stencils.take(WIDEST).enumerate() {
            all.on_grain &= stencil.0[ON_GRAIN] == 1.0;
            all.twisting |= stencil.twisting();
            for (numbers, number) in all.numbers.iter_mut().zip(stencil.0) {
                numbers[k] = number;
            }
        }
        all
    }

    /// Those from one of the eight on.
    #[inline(always)]
    pub(crate) fn from(&self, first: usize) -> StencilsFrom<'_> {
        StencilsFrom {
            stencils: self,
            first,
        }
    }
}

/// Some of eight stencils.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StencilsFrom<'a> {
    stencils: &'a Stencils,
    first: usize,
}

impl StencilsFrom<'_> {
    #[inline(always)]
    pub(super) fn get<S: Simd>(&self, simd: S, index: usize) -> Lanes<S> {
        Lanes::read(simd, &self.stencils.numbers[index][self.first..])
    }

    /// Whether no bend has an angle at rest, and every corner a right one.
    #[inline(always)]
    pub(super) fn on_grain(&self) -> bool {
        self.stencils.on_grain
    }

    /// Whether a cell resists twist.
    #[inline(always)]
    pub(super) fn twisting(&self) -> bool {
        self.stencils.twisting
    }

    /// 1 where a node moves, 0 where it does not.
    #[inline(always)]
    pub(crate) fn moves<S: Simd>(&self, simd: S) -> Lanes<S> {
        self.get(simd, MOVES)
    }

    /// Weight of the nodes [gf].
    #[inline(always)]
    pub(crate) fn weight<S: Simd>(&self, simd: S) -> Lanes<S> {
        self.get(simd, WEIGHT)
    }
}

/// NE, NW, SW, SE.
fn quarter([along, across]: [i32; 2]) -> usize {
    match (along > 0, across > 0) {
        (true, true) => 0,
        (false, true) => 1,
        (false, false) => 2,
        (true, false) => 3,
    }
}

/// East, west, north, south.
fn direction([along, across]: [i32; 2]) -> usize {
    match (along.signum(), across.signum()) {
        (1, _) => 0,
        (-1, _) => 1,
        (_, 1) => 2,
        _ => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_place_takes_no_one_off_the_grain_and_an_angle_at_rest_does() {
        let on = Stencil::of_weight(0.1);
        assert!(Stencils::mixed([on, Stencil::STILL].iter()).on_grain);
        let mut bent = on;
        bent.add_bend(Yarn::Warp, [1, 0], 1.0, 0.3);
        assert!(!Stencils::mixed([on, bent].iter()).on_grain);
    }
}
