//! The place in a cell that is nearest to a body, or deepest in it: where an edge or a tip of the
//! body meets the cloth between its samples.

use super::sites::corner_of;
use crate::body::Near;

/// Normals that lean apart by more than this cosine (30°) show that a feature is between them.
const ONE_FACE: f64 = 0.866;
/// The search ends with steps of this part of a cell's side.
const LAST_STEP: f64 = 1.0 / 128.0;
/// A place is left for one that is nearer by more than this [cm].
const WORTH_MOVING: f64 = 1e-4;
/// Most places tried.
const MOST_TRIED: usize = 120;

/// Between samples, features of a body are looked for this far from the cloth, in pitches.
pub(crate) const FEATURE_REACH: f64 = 0.3;

/// A place in a cell and the surfaces near it.
pub(crate) type Sample = ([f64; 2], Vec<Near>);

/// Where in a cell the nearest surface is, if it is within `reach` [cm] and the cell is near more
/// than one face of it. `nears` gives the surfaces within a reach of a place.
pub(crate) fn deepest_place(
    nears: &impl Fn([f64; 2], f64) -> Vec<Near>,
    reach: f64,
    samples: &[Sample],
) -> Option<[f64; 2]> {
    let (start, nearest) = nearest_sample(samples)?;
    let mut all = samples.iter().flat_map(|(_, nears)| nears);
    if all.all(|near| near.normal.dot(&nearest.normal) >= ONE_FACE) {
        return None;
    }
    let mut look = |place| nearest_of(&nears(place, reach), reach);
    let (distance, place) = descend(&mut look, (nearest.distance, start));
    (distance < reach).then_some(place)
}

/// How near the nearest of surfaces is [cm]; `reach` where there is none.
pub(super) fn nearest_of(nears: &[Near], reach: f64) -> f64 {
    nears.iter().map(|near| near.distance).fold(reach, f64::min)
}

/// The sample that is nearest to a surface, and that surface.
fn nearest_sample(samples: &[Sample]) -> Option<([f64; 2], Near)> {
    let all = samples
        .iter()
        .flat_map(|(place, nears)| nears.iter().map(|near| (*place, *near)));
    all.min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance))
}

/// Surfaces around the nearest places of the four quarters of a cell, within `reach` [cm]: all that
/// a search for them comes by, since a tip pushes along any normal between those of its faces.
pub(crate) fn faces_around(
    nears: &impl Fn([f64; 2], f64) -> Vec<Near>,
    reach: f64,
    samples: &[Sample],
) -> Vec<Near> {
    let mut found = Vec::new();
    for corner in 0..4 {
        let samples = samples
            .iter()
            .filter(|(place, _)| corner_of(*place) == corner);
        let samples: Vec<Sample> = samples.cloned().collect();
        if let Some((start, nearest)) = nearest_sample(&samples) {
            let mut look = |place| {
                let nears = nears(place, reach);
                let nearest = nearest_of(&nears, reach);
                found.extend(nears);
                nearest
            };
            descend(&mut look, (nearest.distance, start));
        }
    }
    found
}

/// A compass search for the place nearest to a surface: at steps that halve, to the best of six
/// neighbours, for cloth that is creased along a cell's diagonal has the nearest place on it. Returns
/// its distance [cm] as well.
fn descend(distance: &mut impl FnMut([f64; 2]) -> f64, start: (f64, [f64; 2])) -> (f64, [f64; 2]) {
    let mut best = start;
    let mut step = 0.125;
    let mut tried = 0;
    while step >= LAST_STEP && tried < MOST_TRIED {
        let next = neighbours(best.1, step)
            .map(|place| (distance(place), place))
            .into_iter()
            .min_by(|a, b| a.0.total_cmp(&b.0));
        tried += 6;
        match next {
            Some(next) if next.0 < best.0 - WORTH_MOVING => best = next,
            _ => step *= 0.5,
        }
    }
    best
}

fn neighbours([u, v]: [f64; 2], step: f64) -> [[f64; 2]; 6] {
    let inside = |x: f64| x.clamp(0.0, 1.0);
    [
        [inside(u - step), v],
        [inside(u + step), v],
        [u, inside(v - step)],
        [u, inside(v + step)],
        [inside(u - step), inside(v - step)],
        [inside(u + step), inside(v + step)],
    ]
}
