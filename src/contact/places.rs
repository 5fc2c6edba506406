//! The places in a cell where a body's edges and tips meet it between its samples, remembered from
//! look to look so that what rests on them stays there.

use super::{
    Touches,
    deepest::{Sample, deepest_place, nearest_of},
};
use crate::body::Near;

/// Places of features that a cell remembers at most.
pub(super) const PLACES: usize = 6;
/// A place nearer than this to a remembered one [cm], and in parts of the cell's side, is the same.
const SAME_PLACE: f64 = 0.0125;
const SAME_PART: f64 = 0.05;
/// A remembered place this far from all surfaces [cm], beyond its reach, is forgotten.
const FORGOTTEN: f64 = 0.05;

/// Places in a cell, each from 0 to 1 along both sides.
pub(super) type Places = [Option<[f64; 2]>; PLACES];

impl Touches {
    /// The places of a cell's features: those known before that are still near one, and the
    /// deepest now. A cell that rests on several keeps them all, else it would rock between them; of
    /// too many, the one farthest out gives way.
    pub(super) fn remember(
        &self,
        cell: usize,
        nears: &impl Fn([f64; 2], f64) -> Vec<Near>,
        wide: f64,
        samples: &[Sample],
    ) -> Places {
        let far = self.surface.sample_reach() + FORGOTTEN;
        let near = |place: &[f64; 2]| !nears(*place, far).is_empty();
        let mut places = self.places[cell].map(|place| place.filter(near));
        if let Some(place) = deepest_place(nears, wide, samples) {
            let same = |known: &[f64; 2]| {
                let apart = (known[0] - place[0]).abs().max((known[1] - place[1]).abs());
                apart < SAME_PART.min(SAME_PLACE / self.pitch)
            };
            if !places.iter().flatten().any(same) {
                let free = places.iter().position(Option::is_none);
                places[free.unwrap_or_else(|| farthest(&places, nears, wide))] = Some(place);
            }
        }
        places
    }
}

/// Which of a cell's places is farthest out of all surfaces.
fn farthest(places: &Places, nears: &impl Fn([f64; 2], f64) -> Vec<Near>, reach: f64) -> usize {
    let distance = |place: &Option<[f64; 2]>| {
        place.map_or(reach, |place| nearest_of(&nears(place, reach), reach))
    };
    let distances = places.each_ref().map(distance);
    (1..PLACES).fold(0, |best, k| {
        if distances[k] > distances[best] {
            k
        } else {
            best
        }
    })
}
