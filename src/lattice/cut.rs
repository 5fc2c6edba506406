//! Divides a piece of cloth into a lattice.

use crate::{
    lattice::{
        Lattice, Outline, Piece, connected::scraps_dropped, grid::Grid, seat::seated, weave::weave,
    },
    math::Vec2,
};

/// The most places that a grid may have; a lattice of as many nodes takes some 3 GB.
const MOST_NODES: f64 = 4e6;
/// The fewest nodes that make a cloth.
const FEWEST_NODES: usize = 4;

/// A piece that cannot be cut at a pitch.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CutError {
    /// The pitch is no length.
    #[error("spacing is {pitch} cm, expected a finite number above 0")]
    Pitch {
        /// The pitch [cm].
        pitch: f64,
    },
    /// The grain is no angle.
    #[error("grain is {grain} rad, expected a finite number")]
    Grain {
        /// The grain [rad].
        grain: f64,
    },
    /// More nodes than fit in memory.
    #[error(
        "a spacing of {pitch} cm asks for some {nodes:.0} nodes, at most 4000000 are allowed: \
         {fitting} cm or more would fit"
    )]
    TooFine {
        /// The pitch [cm].
        pitch: f64,
        /// How many nodes it asks for, about.
        nodes: f64,
        /// A pitch that is coarse enough [cm].
        fitting: f64,
    },
    /// Fewer nodes than make a cloth.
    #[error(
        "a spacing of {pitch} cm leaves {nodes} nodes, at least 4 are needed: \
         {fitting} cm or less would do"
    )]
    TooCoarse {
        /// The pitch [cm].
        pitch: f64,
        /// How many nodes it leaves.
        nodes: usize,
        /// A pitch that is fine enough for most outlines [cm].
        fitting: f64,
    },
    /// Somewhere the cloth is narrower than a cell.
    #[error(
        "the cloth falls apart into {pieces} pieces at a spacing of {pitch} cm: \
         choose a smaller one, or widen the outline where it is narrow"
    )]
    Apart {
        /// The pitch [cm].
        pitch: f64,
        /// Into how many.
        pieces: usize,
    },
}

impl Piece {
    /// Divides the piece at a pitch [cm], which need not be the piece's own: coarser and finer
    /// lattices of one piece share its cloth coordinates.
    ///
    /// A rectangle on grain is divided evenly into `round(size / pitch)` cells each way, at least 1,
    /// so its pitch may differ a little from the one asked for. Any other outline takes a grid at
    /// the pitch with a node at its centre, and the nodes next to the outline are seated on it.
    ///
    /// # Errors
    /// [`CutError`] where the pitch is not above 0, gives too few or too many nodes, or where
    /// the outline is so narrow for it that the cloth falls apart.
    pub fn cut(&self, pitch: f64) -> Result<Lattice, CutError> {
        if !(pitch.is_finite() && pitch > 0.0) {
            return Err(CutError::Pitch { pitch });
        }
        let grain = self.grain;
        if !grain.is_finite() {
            return Err(CutError::Grain { grain });
        }
        let outline = self.outline.mapped(|point| self.to_cloth(point));
        let lattice = match outline.rectangle_size() {
            Some(size) => weave(&evenly_divided(size, pitch)?),
            None => cut_along(&outline, pitch)?,
        };
        let nodes = lattice.coordinates.len();
        if nodes < FEWEST_NODES {
            let fitting = rounded_down(outline.area() / outline.perimeter());
            return Err(CutError::TooCoarse {
                pitch,
                nodes,
                fitting,
            });
        }
        Ok(lattice)
    }
}

fn evenly_divided(size: Vec2, pitch: f64) -> Result<Grid, CutError> {
    check_count(size, pitch)?;
    let cells = (size / pitch).map(|count| count.round().max(1.0));
    let counts = [cells.x as usize + 1, cells.y as usize + 1];
    Ok(Grid::regular(counts, size.component_div(&cells)))
}

fn cut_along(outline: &Outline, pitch: f64) -> Result<Lattice, CutError> {
    let (low, high) = outline.bounds();
    let reach = low.abs().sup(&high.abs());
    check_count(2.0 * reach, pitch)?;
    // One place more than the outline can reach, so that it passes between inside and outside.
    let counts = [reach.x, reach.y].map(|reach| 2 * ((reach / pitch) as usize + 1) + 1);
    let mut grid = Grid::regular(counts, Vec2::repeat(pitch));
    seated(&mut grid, outline);
    match scraps_dropped(&mut grid) {
        Ok(()) => Ok(weave(&grid)),
        Err(pieces) => Err(CutError::Apart { pitch, pieces }),
    }
}

fn check_count(size: Vec2, pitch: f64) -> Result<(), CutError> {
    let nodes = (size.x / pitch + 3.0) * (size.y / pitch + 3.0);
    if nodes <= MOST_NODES {
        return Ok(());
    }
    // (x/p + 3)(y/p + 3) = most, solved for 1/p.
    let (product, sum) = (size.x * size.y, size.x + size.y);
    let root = (9.0 * sum * sum + 4.0 * product * (MOST_NODES - 9.0)).sqrt();
    let fitting = rounded_up(2.0 * product / (root - 3.0 * sum));
    Err(CutError::TooFine {
        pitch,
        nodes,
        fitting,
    })
}

/// The next number with two digits, for a message.
fn rounded_up(value: f64) -> f64 {
    let unit = libm::exp10(libm::log10(value).floor() - 1.0);
    (value / unit).ceil() * unit
}

/// The number with two digits before, for a message.
fn rounded_down(value: f64) -> f64 {
    let unit = libm::exp10(libm::log10(value).floor() - 1.0);
    (value / unit).floor() * unit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric::Yarn;
    use std::f64::consts::FRAC_PI_2;

    fn cut(outline: Outline, degrees: f64, pitch: f64) -> Lattice {
        let grain = degrees.to_radians();
        Piece {
            outline,
            grain,
            pitch,
        }
        .cut(pitch)
        .unwrap()
    }

    fn rectangle(width: f64, height: f64) -> Outline {
        Outline::rectangle(width, height).unwrap()
    }

    /// Every law has the whole area handed out; returns it.
    #[track_caller]
    fn area_of_every_law(lattice: &Lattice) -> f64 {
        let area: f64 = lattice.area.iter().sum();
        let corners = lattice
            .corners
            .iter()
            .map(|corner| corner.area)
            .sum::<f64>();
        assert!((corners / area - 1.0).abs() < 1e-12);
        for yarn in [Yarn::Warp, Yarn::Weft] {
            let rods = lattice.rods.iter().filter(|rod| rod.yarn == yarn);
            let rods: f64 = rods.map(|rod| rod.rest * rod.width).sum();
            assert!((rods / area - 1.0).abs() < 1e-12);
        }
        area
    }

    #[test]
    fn a_rectangle_is_divided_evenly() {
        // 100 cm in 32 steps: no binary fraction, yet every length is the same number.
        let lattice = cut(rectangle(100.0, 100.0), 0.0, 100.0 / 32.0);
        let pitch = 100.0 / 32.0;
        assert_eq!(lattice.coordinates.len(), 33 * 33);
        assert_eq!(lattice.cells.len(), 32 * 32);
        assert_eq!(lattice.corners.len(), 4 * 32 * 32);
        assert_eq!(lattice.rods.len(), 2 * 33 * 32);
        assert_eq!(lattice.bends.len(), 2 * 33 * 31);
        assert!(lattice.rods.iter().all(|rod| rod.rest == pitch));
        assert!(
            lattice
                .bends
                .iter()
                .all(|bend| bend.length == pitch && bend.rest_angle == 0.0)
        );
        assert!(
            lattice
                .corners
                .iter()
                .all(|corner| corner.rest_angle == FRAC_PI_2)
        );
        assert!((area_of_every_law(&lattice) - 1e4).abs() < 1e-8);
    }

    #[test]
    fn edges_stand_for_half_a_pitch_and_a_bend_along_an_edge_too() {
        let lattice = cut(rectangle(6.0, 4.0), 0.0, 1.0);
        let on_edge = |node: u32| lattice.coordinates[node as usize].y.abs() == 2.0;
        for rod in lattice.rods.iter().filter(|rod| rod.yarn == Yarn::Warp) {
            assert_eq!(rod.width, if on_edge(rod.nodes[0]) { 0.5 } else { 1.0 });
        }
        for bend in lattice.bends.iter().filter(|bend| bend.yarn == Yarn::Warp) {
            assert_eq!(bend.width, if on_edge(bend.nodes[0]) { 0.5 } else { 1.0 });
        }
        assert_eq!(
            (lattice.area[0], lattice.area[1], lattice.area[8]),
            (0.25, 0.5, 1.0)
        );
    }

    #[test]
    fn nodes_run_along_the_warp_within_rows_along_the_weft() {
        let lattice = cut(rectangle(3.0, 2.0), 0.0, 1.0);
        assert_eq!(lattice.coordinates[0], Vec2::new(-1.5, -1.0));
        assert_eq!(lattice.coordinates[1], Vec2::new(-0.5, -1.0));
        assert_eq!(lattice.grid[4], [0, 1]);
        assert_eq!(lattice.cells[0], [0, 1, 5, 4]);
        assert_eq!(lattice.corners[2].nodes, [5, 4, 1]);
    }

    #[test]
    fn a_quarter_turn_of_the_grain_exchanges_the_sides() {
        let turned = cut(rectangle(3.0, 2.0), 90.0, 0.25);
        assert_eq!(turned, cut(rectangle(2.0, 3.0), 0.0, 0.25));
        assert_eq!(turned, cut(rectangle(3.0, 2.0), 270.0, 0.25));
    }

    #[test]
    fn a_pitch_longer_than_the_cloth_leaves_one_cell() {
        let lattice = cut(rectangle(3.0, 2.0), 0.0, 50.0);
        assert_eq!((lattice.cells.len(), lattice.pitch), (1, 3.0));
    }

    #[test]
    fn a_pitch_that_fits_is_named() {
        let refusal = |outline: Outline, pitch: f64| {
            let piece = Piece {
                outline,
                grain: 0.3,
                pitch,
            };
            piece.cut(pitch).unwrap_err()
        };
        let towel = rectangle(50.0, 70.0);
        let CutError::TooFine { fitting, .. } = refusal(towel.clone(), 1e-4) else {
            panic!("a spacing of a micrometre is too fine");
        };
        let reach = Piece {
            outline: towel,
            grain: 0.3,
            pitch: 1.0,
        };
        let (_, high) = reach.outline.mapped(|point| reach.to_cloth(point)).bounds();
        assert!(check_count(2.0 * high, fitting).is_ok());
        assert!(check_count(2.0 * high, 0.9 * fitting).is_err());
        for pitch in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let text = refusal(rectangle(1.0, 1.0), pitch).to_string();
            assert_eq!(
                text,
                format!("spacing is {pitch} cm, expected a finite number above 0")
            );
        }
    }
}
