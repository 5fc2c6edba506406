//! Divides a piece of cloth into a lattice.

use crate::{
    lattice::{
        Lattice, Outline, Piece, connected::drop_scraps, grid::Grid, seat::seat, weave::weave,
    },
    math::Vec2,
};

/// The most places that a grid may have; a lattice of as many nodes takes more than a gigabyte.
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
            let fitting = two_digits(outline.area() / outline.perimeter(), f64::floor);
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
    seat(&mut grid, outline);
    match drop_scraps(&mut grid) {
        Ok(()) => Ok(weave(&grid)),
        Err(pieces) => Err(CutError::Apart { pitch, pieces }),
    }
}

fn check_count(size: Vec2, pitch: f64) -> Result<(), CutError> {
    let nodes = (size.x / pitch + 3.0) * (size.y / pitch + 3.0);
    if nodes <= MOST_NODES {
        return Ok(());
    }
    // (x/p + 3)(y/p + 3) = most, solved for p, in units of the longer side lest squares overflow.
    let unit = size.max();
    let (product, sum) = (
        (size.x / unit) * (size.y / unit),
        size.x / unit + size.y / unit,
    );
    let root = (9.0 * sum * sum + 4.0 * product * (MOST_NODES - 9.0)).sqrt();
    let fitting = two_digits(unit * 2.0 * product / (root - 3.0 * sum), f64::ceil);
    Err(CutError::TooFine {
        pitch,
        nodes,
        fitting,
    })
}

/// A positive length rounded to two digits, for a message.
fn two_digits(length: f64, round: fn(f64) -> f64) -> f64 {
    let scale = libm::exp10(1.0 - libm::log10(length).floor());
    if scale.is_normal() {
        round(length * scale) / scale
    } else {
        length
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        fabric::Yarn,
        lattice::sample::{cut, piece},
    };
    use std::f64::consts::FRAC_PI_2;

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
        let twists = lattice.twists.iter().map(|twist| twist.area).sum::<f64>();
        assert!((twists / area - 1.0).abs() < 1e-12, "{twists} of {area}");
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

    fn polygon(points: &[[f64; 2]], holes: &[&[[f64; 2]]], turn: impl Fn(Vec2) -> Vec2) -> Outline {
        let ring =
            |points: &[[f64; 2]]| points.iter().map(|p| turn(Vec2::new(p[0], p[1]))).collect();
        Outline::polygon(ring(points), holes.iter().map(|hole| ring(hole)).collect()).unwrap()
    }

    /// An L with a slanted hole, every edge off the grid.
    fn l_shape(turn: impl Fn(Vec2) -> Vec2) -> Outline {
        let outer = [
            [0.0, 0.0],
            [20.0, 0.0],
            [20.0, 9.7],
            [9.3, 9.7],
            [9.3, 21.0],
            [0.0, 21.0],
        ];
        let hole = [[2.0, 2.0], [5.0, 2.2], [4.8, 6.0], [2.0, 5.0]];
        polygon(&outer, &[&hole], turn)
    }

    /// Ends of the sides that only one mesh has.
    fn boundary(lattice: &Lattice) -> Vec<usize> {
        let mut sides = std::collections::BTreeMap::new();
        for cell in &lattice.cells {
            for k in 0..4 {
                let (a, b) = (cell[k], cell[(k + 1) % 4]);
                if a != b {
                    *sides.entry([a.min(b), a.max(b)]).or_insert(0) += 1;
                }
            }
        }
        let single = sides.into_iter().filter(|(_, count)| *count == 1);
        single
            .flat_map(|(side, _)| side.map(|node| node as usize))
            .collect()
    }

    /// The area is the outline's to within a part of it, the edge is on the outline, and no mesh is
    /// degenerate.
    #[track_caller]
    fn check(outline: &Outline, degrees: f64, pitch: f64, part: f64) {
        let piece = piece(outline.clone(), degrees, pitch);
        let lattice = piece.cut(pitch).unwrap();
        let area = area_of_every_law(&lattice) / piece.outline.area();
        assert!((area - 1.0).abs() < part, "{area}");
        let on_edge = boundary(&lattice);
        assert!(!on_edge.is_empty());
        for node in on_edge {
            let at = piece.to_outline(lattice.coordinates[node]);
            assert!((piece.outline.nearest(at) - at).norm() < 1e-9);
        }
        for rod in &lattice.rods {
            assert!((0.3..2.0).contains(&(rod.rest / pitch)) && rod.width > 0.0);
        }
        for corner in &lattice.corners {
            let angle = corner.rest_angle.to_degrees();
            assert!((20.0..170.0).contains(&angle), "{angle}");
        }
    }

    #[test]
    fn a_disc_is_round_to_a_thousandth_and_its_edge_is_seated() {
        check(&Outline::disc(15.0).unwrap(), 0.0, 0.5, 1e-3);
        check(&Outline::disc(3.0).unwrap(), 0.0, 0.5, 1e-2);
    }

    #[test]
    fn straight_edges_are_kept_at_any_grain() {
        for degrees in [5.0, 10.0, 20.0, 30.0, 44.0, 45.0, 80.0] {
            check(&rectangle(30.0, 10.0), degrees, 0.5, 1e-9);
        }
    }

    #[test]
    fn corners_and_holes_are_kept_at_any_grain() {
        for degrees in [0.0, 15.0, 30.0, 45.0, 77.0] {
            check(&l_shape(|point| point), degrees, 0.5, 1e-3);
        }
    }

    /// Coordinates and areas in an order of their own.
    fn sorted(lattice: &Lattice, turn: impl Fn(Vec2) -> Vec2) -> Vec<[f64; 3]> {
        let nodes = lattice.coordinates.iter().zip(&lattice.area);
        let mut sorted: Vec<[f64; 3]> = nodes
            .map(|(at, area)| [turn(*at).x, turn(*at).y, *area].map(|v| (v * 1e9).round()))
            .collect();
        sorted.sort_by(|a, b| a.partial_cmp(b).unwrap());
        sorted
    }

    #[test]
    fn a_disc_has_all_the_symmetries_of_the_grid() {
        let disc = cut(Outline::disc(7.3).unwrap(), 0.0, 0.5);
        let plain = sorted(&disc, |p| p);
        assert_eq!(plain, sorted(&disc, |p| Vec2::new(p.y, p.x)));
        assert_eq!(plain, sorted(&disc, |p| Vec2::new(0.0 - p.x, p.y)));
        assert_eq!(disc.coordinates[disc.coordinates.len() / 2], Vec2::zeros());
    }

    #[test]
    fn exchanging_warp_and_weft_mirrors_the_lattice() {
        let mirror = |p: Vec2| Vec2::new(p.y, p.x);
        let (plain, other) = (
            cut(l_shape(|p| p), 0.0, 0.7),
            cut(l_shape(mirror), 0.0, 0.7),
        );
        assert_eq!(sorted(&plain, mirror), sorted(&other, |p| p));
        let lengths = |lattice: &Lattice, yarn: Yarn| {
            let rods = lattice.rods.iter().filter(|rod| rod.yarn == yarn);
            let mut rods: Vec<_> = rods.map(|rod| (rod.rest * 1e9).round() as i64).collect();
            rods.sort_unstable();
            rods
        };
        assert_eq!(lengths(&plain, Yarn::Warp), lengths(&other, Yarn::Weft));
    }

    #[test]
    fn a_bias_edge_has_no_rods_along_it() {
        let piece = piece(rectangle(30.0, 10.0), 45.0, 0.5);
        let lattice = piece.cut(0.5).unwrap();
        let lower = piece.edge_nodes(&lattice, crate::lattice::Edge::YMin);
        assert!(lower.len() > 40);
        let along = lattice
            .rods
            .iter()
            .filter(|rod| rod.nodes.iter().all(|n| lower.contains(n)));
        assert_eq!(along.count(), 0);
    }

    #[test]
    fn an_outline_too_narrow_or_too_small_is_refused() {
        let refusal = |outline, pitch| piece(outline, 0.0, pitch).cut(pitch).unwrap_err();
        let dumbbell = [
            [0.0, 0.0],
            [10.0, 0.0],
            [10.0, 4.8],
            [20.0, 4.8],
            [20.0, 0.0],
            [30.0, 0.0],
            [30.0, 10.0],
            [20.0, 10.0],
            [20.0, 5.1],
            [10.0, 5.1],
            [10.0, 10.0],
            [0.0, 10.0],
        ];
        let apart = refusal(polygon(&dumbbell, &[], |p| p), 1.0);
        assert_eq!(
            apart,
            CutError::Apart {
                pitch: 1.0,
                pieces: 2
            }
        );
        let small = Outline::disc(0.4).unwrap();
        let CutError::TooCoarse {
            nodes: 0, fitting, ..
        } = refusal(small.clone(), 1.0)
        else {
            panic!("a disc narrower than the spacing has no nodes");
        };
        assert!(cut(small, 0.0, fitting).coordinates.len() >= 4);
    }

    #[test]
    fn a_pitch_that_fits_is_named() {
        let refusal = |outline, pitch| piece(outline, 17.0, pitch).cut(pitch).unwrap_err();
        let towel = rectangle(50.0, 70.0);
        let CutError::TooFine { fitting, .. } = refusal(towel.clone(), 1e-4) else {
            panic!("a spacing of a micrometre is too fine");
        };
        let reach = piece(towel, 17.0, 1.0);
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
