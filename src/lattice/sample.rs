//! Pieces and outlines for tests.

use crate::{
    lattice::{Lattice, Outline, Piece},
    math::Vec2,
};

/// A piece with its warp at an angle against the outline's x axis [degrees], cut at its pitch [cm].
pub(crate) fn cut(outline: Outline, degrees: f64, pitch: f64) -> Lattice {
    piece(outline, degrees, pitch).cut(pitch).unwrap()
}

/// A piece with its warp at an angle against the outline's x axis [degrees].
pub(crate) fn piece(outline: Outline, degrees: f64, pitch: f64) -> Piece {
    Piece {
        outline,
        grain: degrees.to_radians(),
        pitch,
    }
}

/// A list of points [cm].
pub(crate) fn points(list: &[[f64; 2]]) -> Vec<Vec2> {
    list.iter().copied().map(Vec2::from).collect()
}

/// The square over an interval of both axes [cm].
pub(crate) fn square(low: f64, high: f64) -> Vec<Vec2> {
    points(&[[low, low], [high, low], [high, high], [low, high]])
}
