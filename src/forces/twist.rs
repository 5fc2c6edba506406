//! The twist of a cell, as an energy: `½·k·h²`, where h is the gap between its diagonals.
//!
//! A lattice of rods does not feel twist (w_xy bends none of them); this is the third component of
//! bending, beside those along warp and weft. The diagonals of a flat cell cross. Those of a twisted
//! one pass each other, and the shortest way between them stands on both: so a force k·h along
//! it, at its two ends, pulls them together, and each diagonal hands it on to its ends by the lever.

use crate::math::{Mat3, Vec3};

/// Energy and derivatives of the twist law with respect to the four nodes.
#[derive(Clone, Copy, Debug)]
pub struct Twisting {
    /// Energy [gf·cm].
    pub energy: f64,
    /// Derivatives by the nodes [gf].
    pub slopes: [Vec3; 4],
}

/// Diagonals that span less than this square of an area [cm⁴] have no normal: 10⁻⁹ cm².
pub(super) const LEAST_SPAN: f64 = 1e-18;

/// The diagonals of a cell, which pass each other.
struct Passing {
    /// Normal to both; of length 1 but where the cell is folded shut.
    normal: Vec3,
    /// How far the first passes above the second, along the normal [cm].
    gap: f64,
    /// How the gap changes as a node moves along the normal [-].
    levers: [f64; 4],
    /// How the normal leans as a node moves along it [1/cm].
    leans: [Vec3; 4],
}

impl Passing {
    fn new([a, b, c, d]: &[Vec3; 4]) -> Self {
        let (first, second, between) = (c - a, d - b, b - a);
        let normal = first.cross(&second);
        let over = 1.0 / normal.norm_squared().max(LEAST_SPAN);
        let along_first = between.cross(&second).dot(&normal) * over;
        let along_second = between.cross(&first).dot(&normal) * over;
        let (by_first, by_second) = (normal.cross(&second) * over, first.cross(&normal) * over);
        let normal = normal * over.sqrt();
        Self {
            normal,
            gap: -between.dot(&normal),
            levers: [
                1.0 - along_first,
                along_second - 1.0,
                along_first,
                -along_second,
            ],
            leans: [-by_first, -by_second, by_first, by_second],
        }
    }

    /// Blocks by the nodes: `of(row, column)`.
    fn blocks(of: impl Fn(usize, usize) -> Mat3) -> [[Mat3; 4]; 4] {
        core::array::from_fn(|row| core::array::from_fn(|column| of(row, column)))
    }
}

/// Energy and its derivatives; `stiffness` [gf/cm] is k of `½·k·h²`.
#[must_use]
pub fn twist(corners: &[Vec3; 4], stiffness: f64) -> Twisting {
    let passing = Passing::new(corners);
    let pull = stiffness * passing.gap;
    Twisting {
        energy: 0.5 * pull * passing.gap,
        slopes: passing.levers.map(|lever| passing.normal * (pull * lever)),
    }
}

/// The exact second derivatives [gf/cm]. They may have negative directions.
#[must_use]
pub fn twist_stiffness(corners: &[Vec3; 4], stiffness: f64) -> [[Mat3; 4]; 4] {
    let Passing {
        normal,
        gap,
        levers,
        leans,
    } = Passing::new(corners);
    let square = normal * normal.transpose();
    Passing::blocks(|row, column| {
        let leaning = normal * leans[row].transpose() * levers[column]
            + leans[column] * normal.transpose() * levers[row];
        let shorter = gap * gap * leans[row].dot(&leans[column]);
        (leaning * gap + square * (levers[row] * levers[column] - shorter)) * stiffness
    })
}

/// Second derivatives without their negative directions: the square of the gap's derivative, exact
/// for a flat cell, positive semi-definite for all.
#[must_use]
pub fn twist_stiffness_positive(corners: &[Vec3; 4], stiffness: f64) -> [[Mat3; 4]; 4] {
    let Passing { normal, levers, .. } = Passing::new(corners);
    let square = normal * normal.transpose() * stiffness;
    Passing::blocks(|row, column| square * (levers[row] * levers[column]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cell 2 cm × 1 cm whose diagonals pass each other at h [cm].
    fn twisted(gap: f64) -> [Vec3; 4] {
        let corner = |x, y, z| Vec3::new(x, y, z);
        [
            corner(0.0, 0.0, gap),
            corner(2.0, 0.0, 0.0),
            corner(2.0, 1.0, gap),
            corner(0.0, 1.0, 0.0),
        ]
    }

    #[test]
    fn the_energy_is_that_of_the_gap() {
        let twisted = twist(&twisted(0.3), 8.0);
        assert!((twisted.energy - 0.36).abs() < 1e-15);
        for (slope, up) in twisted.slopes.iter().zip([1.0, -1.0, 1.0, -1.0]) {
            assert!((slope - Vec3::z() * (1.2 * up)).norm() < 1e-15, "{slope}");
        }
    }

    #[test]
    fn a_flat_cell_has_nothing_to_answer_however_it_is_strained() {
        let corners = [[0.0, 0.0], [1.3, -0.2], [1.1, 0.8], [0.2, 1.4]];
        let twisted = twist(&corners.map(|[x, y]| Vec3::new(x, y, 5.0)), 8.0);
        assert_eq!(twisted.energy, 0.0);
        assert!(twisted.slopes.iter().all(|slope| slope.norm() == 0.0));
    }

    #[test]
    fn a_cell_folded_shut_is_no_number_out_of_range() {
        let [a, b, ..] = twisted(0.3);
        for corners in [
            [a; 4],
            [a, b, a, b],
            [a, b, b, a],
            [a, a, b, b],
            [a, b, a, a],
        ] {
            let twisted = twist(&corners, 8.0);
            assert_eq!(twisted.energy, 0.0);
            assert!(twisted.slopes.iter().all(|slope| slope.norm() == 0.0));
            for blocks in [
                twist_stiffness(&corners, 8.0),
                twist_stiffness_positive(&corners, 8.0),
            ] {
                let numbers = blocks.as_flattened().iter();
                assert!(numbers.flatten().all(|number| number.is_finite()));
            }
        }
    }
}
