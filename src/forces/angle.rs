//! The angle between two rods, as an energy: `½·k·(θ − θ₀)²`, for bends (6) and corners (7) alike.
//!
//! Everything is written in `c = cos θ`, whose derivatives are polynomials of the unit vectors:
//! no derivative has a singularity at θ = 0 where a flat cloth spends its time.

use crate::math::{Mat3, Vec3};

/// Energy and derivatives of an angle law with respect to its two rods `u` and `v`.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Energy [gf·cm].
    pub energy: f64,
    /// Derivative by u [gf].
    pub by_u: Vec3,
    /// Derivative by v [gf].
    pub by_v: Vec3,
}

/// Second derivatives by the two rods [gf/cm].
#[derive(Clone, Copy, Debug)]
pub struct TurnStiffness {
    /// By u twice.
    pub uu: Mat3,
    /// By u, then v.
    pub uv: Mat3,
    /// By v twice.
    pub vv: Mat3,
}

/// A sine below this is taken as this: rods folded right onto each other have no direction to open.
const LEAST_SINE: f64 = 1e-9;
/// Below this angle [rad] series replace the quotients; their error is below 1e-13 here.
const SERIES_BELOW: f64 = 0.01;

/// The pair of rods that an angle stands between, taken apart once.
struct Pair {
    unit_u: Vec3,
    unit_v: Vec3,
    length_u: f64,
    length_v: f64,
    cosine: f64,
    sine: f64,
    angle: f64,
}

impl Pair {
    fn new(u: &Vec3, v: &Vec3) -> Self {
        let (length_u, length_v) = (u.norm().max(1e-12), v.norm().max(1e-12));
        let (unit_u, unit_v) = (u / length_u, v / length_v);
        let cosine = unit_u.dot(&unit_v);
        let sine = unit_u.cross(&unit_v).norm();
        let angle = libm::atan2(sine, cosine);
        Self {
            unit_u,
            unit_v,
            length_u,
            length_v,
            cosine,
            sine,
            angle,
        }
    }

    /// Derivatives of the cosine by u and v.
    fn cosine_slopes(&self) -> (Vec3, Vec3) {
        let by_u = (self.unit_v - self.unit_u * self.cosine) / self.length_u;
        let by_v = (self.unit_u - self.unit_v * self.cosine) / self.length_v;
        (by_u, by_v)
    }

    /// First and second derivative of `½(θ − θ₀)²` by the cosine.
    fn law_slopes(&self, rest: f64) -> (f64, f64) {
        if rest == 0.0 && self.angle < SERIES_BELOW {
            let square = self.angle * self.angle;
            let first = -(1.0 + square * (1.0 / 6.0 + square * 7.0 / 360.0));
            return (first, 1.0 / 3.0 + square * (2.0 / 15.0 + square * 0.031746));
        }
        let sine = self.sine.max(LEAST_SINE);
        let excess = self.angle - rest;
        (
            -excess / sine,
            (1.0 - excess * self.cosine / sine) / (sine * sine),
        )
    }
}

/// The angle between two rods [rad].
#[must_use]
pub fn angle_between(u: &Vec3, v: &Vec3) -> f64 {
    Pair::new(u, v).angle
}

/// Energy and its derivatives; `stiffness` [gf·cm] is k of `½·k·(θ − θ₀)²`.
#[must_use]
pub fn turn(u: &Vec3, v: &Vec3, stiffness: f64, rest: f64) -> Turn {
    let pair = Pair::new(u, v);
    let excess = pair.angle - rest;
    let (first, _) = pair.law_slopes(rest);
    let (by_u, by_v) = pair.cosine_slopes();
    let pull = stiffness * first;
    Turn {
        energy: 0.5 * stiffness * excess * excess,
        by_u: by_u * pull,
        by_v: by_v * pull,
    }
}

/// The exact second derivatives. They may have negative directions.
#[must_use]
pub fn turn_stiffness(u: &Vec3, v: &Vec3, stiffness: f64, rest: f64) -> TurnStiffness {
    let pair = Pair::new(u, v);
    let (first, second) = pair.law_slopes(rest);
    let (by_u, by_v) = pair.cosine_slopes();
    let (across_u, across_v) = (across(&pair.unit_u), across(&pair.unit_v));
    let bent = |unit: &Vec3, slope: &Vec3, across: &Mat3, length: f64| {
        let mixed = unit * slope.transpose() * length;
        -(mixed + mixed.transpose() + across * pair.cosine) / (length * length)
    };
    let cosine_uu = bent(&pair.unit_u, &by_u, &across_u, pair.length_u);
    let cosine_vv = bent(&pair.unit_v, &by_v, &across_v, pair.length_v);
    let cosine_uv = across_u * across_v / (pair.length_u * pair.length_v);
    let (first, second) = (stiffness * first, stiffness * second);
    TurnStiffness {
        uu: by_u * by_u.transpose() * second + cosine_uu * first,
        uv: by_u * by_v.transpose() * second + cosine_uv * first,
        vv: by_v * by_v.transpose() * second + cosine_vv * first,
    }
}

/// Second derivatives without their negative directions: exact for small angles from rest, and
/// positive semi-definite for all.
#[must_use]
pub fn turn_stiffness_positive(u: &Vec3, v: &Vec3, stiffness: f64, rest: f64) -> TurnStiffness {
    if rest != 0.0 {
        return turn_square(u, v, stiffness);
    }
    let pair = Pair::new(u, v);
    let (by_u, by_v) = pair.cosine_slopes();
    let (first, second) = pair.law_slopes(rest);
    // 1 − cos θ = ½|û − v̂|², and what is kept is the square of the derivative of û − v̂.
    let (across_u, across_v) = (across(&pair.unit_u), across(&pair.unit_v));
    let (spread_u, spread_v) = (1.0 / pair.length_u, 1.0 / pair.length_v);
    let spread = -first * stiffness;
    let (kept_u, kept_v) = (by_u * (stiffness * second), by_v * (stiffness * second));
    TurnStiffness {
        uu: across_u * (spread * spread_u * spread_u) + by_u * kept_u.transpose(),
        uv: across_u * across_v * (-spread * spread_u * spread_v) + by_u * kept_v.transpose(),
        vv: across_v * (spread * spread_v * spread_v) + by_v * kept_v.transpose(),
    }
}

/// The stiffness times the square of the angle's derivative.
fn turn_square(u: &Vec3, v: &Vec3, stiffness: f64) -> TurnStiffness {
    let (over_u, over_v) = (1.0 / u.norm().max(1e-12), 1.0 / v.norm().max(1e-12));
    let (unit_u, unit_v) = (u * over_u, v * over_v);
    let cosine = unit_u.dot(&unit_v);
    let square = unit_u.cross(&unit_v).norm_squared();
    let kept = stiffness / square.max(LEAST_SINE * LEAST_SINE);
    let by_u = (unit_v - unit_u * cosine) * over_u;
    let by_v = (unit_u - unit_v * cosine) * over_v;
    let (kept_u, kept_v) = (by_u * kept, by_v * kept);
    TurnStiffness {
        uu: by_u * kept_u.transpose(),
        uv: by_u * kept_v.transpose(),
        vv: by_v * kept_v.transpose(),
    }
}

/// The projection across a unit vector.
fn across(unit: &Vec3) -> Mat3 {
    Mat3::identity() - unit * unit.transpose()
}
