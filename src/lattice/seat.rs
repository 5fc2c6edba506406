//! Seats.
use crate::lattice::{Outline, grid::Grid};
pub(super) fn seated(_grid: &mut Grid, _outline: &Outline) {}
