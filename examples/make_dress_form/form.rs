//! The dress form as a solid: how deep a point is below its surface.

use soen::math::Vec3;

/// A level of the trunk: a rounded section that reaches this far from the plumb line.
struct Level {
    height: f64,
    side: f64,
    front: f64,
    back: f64,
    /// Which of the girths widens it.
    scaled_by: Option<usize>,
}

const fn level(height: f64, side: f64, front: f64, back: f64, scaled_by: Option<usize>) -> Level {
    Level {
        height,
        side,
        front,
        back,
        scaled_by,
    }
}

/// Depth over breadth is 0.70 at the hip, 0.75 at the waist, 0.75 at the bust with the mounds.
/// Levels between girths are shaped by eye.
const LEVELS: [Level; 10] = [
    level(68.0, 16.0, 10.0, 11.4, Some(0)),
    level(78.2, 16.8, 10.6, 12.9, Some(0)),
    level(88.5, 14.2, 10.2, 10.6, None),
    level(98.0, 11.6, 8.6, 8.8, Some(1)),
    level(106.0, 12.6, 8.9, 9.3, None),
    level(113.8, 14.0, 8.8, 10.0, Some(2)),
    level(120.0, 14.5, 7.8, 10.2, None),
    level(126.0, 15.2, 5.8, 8.8, None),
    level(130.0, 16.0, 3.8, 6.8, None),
    level(136.0, 16.0, 2.8, 5.4, None),
];

/// Sections are a little squarer than ellipses, whose exponent is 2.
const SQUARENESS: f64 = 2.25;

/// Lowest and highest points [cm].
const FOOT: f64 = 70.0;
const TOP: f64 = 140.0;

/// The solid; each girth has a factor for the sections at its level: hip, waist, bust, neck.
pub(crate) struct Form {
    pub(crate) scales: [f64; 4],
}

impl Default for Form {
    fn default() -> Self {
        Self { scales: [1.0; 4] }
    }
}

impl Form {
    /// How far a point is outside the surface, near it [cm]; negative inside.
    pub(crate) fn depth(&self, p: Vec3) -> f64 {
        // Left and right are alike, so that all is said of the left.
        let p = Vec3::new(p.x.abs(), p.y, p.z);
        let under_shoulder_line = both(self.trunk(p), shoulder_line(p), 6.0);
        let with_stump = either(under_shoulder_line, stump(p), 2.0);
        let with_bust = either(with_stump, self.mound(p), 4.5);
        let with_neck = either(with_bust, self.neck(p), 4.0);
        both(both(with_neck, FOOT - p.z, 6.0), p.z - TOP, 6.5)
    }

    fn trunk(&self, p: Vec3) -> f64 {
        let at = |reach: fn(&Level) -> f64| {
            let scaled = |level: &Level| {
                let scale = level.scaled_by.map_or(1.0, |girth| self.scales[girth]);
                (level.height, scale * reach(level))
            };
            smooth(&LEVELS.each_ref().map(scaled), p.z)
        };
        let depth = if p.y < 0.0 {
            at(|l| l.front)
        } else {
            at(|l| l.back)
        };
        section(p.x, p.y, at(|l| l.side), depth)
    }

    /// The bust points are 17 cm apart. A mound falls off slowly upward and to the middle, where a
    /// dress form bridges the hollow.
    fn mound(&self, p: Vec3) -> f64 {
        let scale = self.scales[2];
        let p = Vec3::new(p.x / scale, p.y / scale, p.z);
        let from_middle = p - Vec3::new(7.4, -5.2, 112.6);
        let across = if from_middle.x < 0.0 { 8.0 } else { 5.8 };
        let up = if from_middle.z > 0.0 { 10.0 } else { 6.6 };
        scale * egg(from_middle, Vec3::new(across, 5.8, up))
    }

    /// A round column that leans forward.
    fn neck(&self, p: Vec3) -> f64 {
        let middle = 1.8 - 0.24 * (p.z - 130.0);
        let radius = 5.0 * self.scales[3];
        (libm::hypot(p.x, p.y - middle) - radius).max(120.0 - p.z)
    }
}

/// Shoulders fall by 22 degrees from the neck, rounded over the spine.
fn shoulder_line(p: Vec3) -> f64 {
    let line = 135.9 - 0.42 * libm::hypot(p.x, 3.0);
    (p.z - line) * 0.92
}

/// Where the arm is cut off: the armhole is an upright oval plate.
fn stump(p: Vec3) -> f64 {
    let arm = egg(p - Vec3::new(12.0, 1.3, 122.2), Vec3::new(7.8, 5.7, 6.9));
    both(arm, p.x - 17.6, 2.5)
}

/// Near distance from a rounded section about the origin.
fn section(x: f64, y: f64, side: f64, depth: f64) -> f64 {
    let share = |length: f64, reach: f64| libm::pow((length / reach).abs(), SQUARENESS);
    let out = libm::pow(share(x, side) + share(y, depth), 1.0 / SQUARENESS);
    // Along the ray from the plumb line; on it, the way is the shorter reach.
    if out < 1e-6 {
        -side.min(depth)
    } else {
        libm::hypot(x, y) * (1.0 - 1.0 / out)
    }
}

/// Near distance from an ellipsoid about the origin (I. Quilez's first-order bound).
fn egg(p: Vec3, reach: Vec3) -> f64 {
    let share = p.component_div(&reach);
    let slope = share.component_div(&reach).norm().max(1e-9);
    share.norm() * (share.norm() - 1.0) / slope
}

/// Inside one or the other, the groove between filled over a width of some `round` cm.
fn either(one: f64, other: f64, round: f64) -> f64 {
    let near = (round - (one - other).abs()).max(0.0) / round;
    one.min(other) - near * near * near * round / 6.0
}

/// Inside one and the other, the ridge between rounded over a width of some `round` cm.
fn both(one: f64, other: f64, round: f64) -> f64 {
    -either(-one, -other, round)
}

/// A curve through points without waves between them: cubic, its slopes limited after Fritsch
/// and Carlson (1980); beyond the ends it stays level.
fn smooth<const N: usize>(points: &[(f64, f64); N], at: f64) -> f64 {
    let step = |i: usize| {
        let ((x0, y0), (x1, y1)) = (*points.get(i)?, *points.get(i + 1)?);
        Some((y1 - y0) / (x1 - x0))
    };
    let slope = |i: usize| match (i.checked_sub(1).and_then(step), step(i)) {
        // The harmonic mean keeps within three times the flatter step.
        (Some(before), Some(after)) if before * after > 0.0 => {
            2.0 * before * after / (before + after)
        }
        _ => 0.0,
    };
    let i = points.partition_point(|(x, _)| *x <= at).clamp(1, N - 1) - 1;
    let ((x0, y0), (x1, y1)) = (points[i], points[i + 1]);
    let width = x1 - x0;
    let t = ((at - x0) / width).clamp(0.0, 1.0);
    let (rest, t2) = (1.0 - t, t * t);
    y0 * rest * rest * (1.0 + 2.0 * t)
        + y1 * t2 * (3.0 - 2.0 * t)
        + width * t * rest * (rest * slope(i) - t * slope(i + 1))
}
