//! Where friction gives way: on an incline, and around a cylinder (capstan).
//!
//! A cloth that slides is one that no number of rounds certifies, and that has gone more than a
//! centimetre when it is stopped.

use crate::specimen::hang;
use core::f64::consts::PI;
use soen::{math::Vec3, solver::Settled};
use std::io::{Write, stderr};

/// `tan θ < µ` sticks (f_incline_and_edge).
#[test]
fn an_incline_holds_below_the_angle_of_friction_and_not_above() {
    for friction in [0.1_f64, 0.3, 0.5] {
        let limit = friction.atan().to_degrees();
        let (rest, moved) = on_incline(friction, limit - 0.2);
        assert!(rest.converged, "µ {friction}: {:?}", rest.certificate);
        assert!(moved < 0.01, "µ {friction}: {moved} cm");
        let (rest, moved) = on_incline(friction, limit + 0.2);
        assert!(!rest.converged, "µ {friction}: {:?}", rest.certificate);
        assert!(moved > 1.0, "µ {friction}: {moved} cm");
    }
}

/// A cloth laid on a slope, and how far its middle has gone along it [cm].
fn on_incline(friction: f64, degrees: f64) -> (Settled, f64) {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let start = Vec3::new(sine, 0.0, cosine) * 5.03;
    let [x, _, z]: [f64; 3] = start.into();
    let rest = hang(
        &format!(
            "[cloth]\nfabric = \"c\"\nsize_cm = [8, 8]\nspacing_cm = 1\n\
             x_axis = [{cosine}, 0, {}]\ncentre_cm = [{x}, 0, {z}]\n\
             [[body]]\ncuboid = {{ size_cm = [60, 60, 10] }}\nrotate_deg = [0, {degrees}, 0]\n\
             [contact]\nfriction = {friction}\n",
            -sine
        ),
        60,
    );
    let middle = rest.lattice.grid.iter().position(|grid| grid == &[4, 4]);
    let way = rest.positions[middle.unwrap()] - start;
    let moved = way.dot(&Vec3::new(cosine, 0.0, -sine));
    (rest, moved)
}

/// Radius of the belt's middle on the cylinder [cm].
const RADIUS: f64 = 5.0;
const THICKNESS: f64 = 0.01;

/// A strip over a cylinder, its ends hanging beyond the side points.
#[derive(Debug)]
struct Belt {
    fabric: &'static str,
    friction: f64,
    /// Shorter end [cm].
    short: f64,
    pitch: f64,
}

/// A belt that has been laid over.
struct Laid {
    rest: Settled,
    /// Longer end over the longest that friction can hold against the shorter, as it lies.
    load: f64,
    /// How far it has gone [cm].
    slipped: f64,
}

impl Belt {
    /// `L1·e^{µπ} + R·2µ/(1 + µ²)·(e^{µπ} + 1)`: its own weight on the cylinder counts too
    /// (d_capstan).
    fn longest(&self, short: f64) -> f64 {
        let friction = self.friction;
        let grip = (friction * PI).exp();
        short * grip + RADIUS * 2.0 * friction / (1.0 + friction * friction) * (grip + 1.0)
    }

    /// Lays the flat strip on top, its longer end a part of the longest.
    fn lay(&self, part: f64) -> Laid {
        let (long, pitch) = (part * self.longest(self.short), self.pitch);
        let length = self.short + PI * RADIUS + long;
        let shift = 0.5 * (long - self.short);
        let rest = hang(
            &format!(
                "[cloth]\nfabric = {:?}\nsize_cm = [{length}, {pitch}]\nspacing_cm = {pitch}\n\
                 centre_cm = [{shift}, 0, {}]\n[[body]]\nrotate_deg = [90, 0, 0]\n\
                 cylinder = {{ radius_cm = {}, height_cm = 20 }}\n\
                 [contact]\nfriction = {}\nthickness_cm = {THICKNESS}\n",
                self.fabric,
                RADIUS + 0.2,
                RADIUS - 0.5 * THICKNESS,
                self.friction
            ),
            800,
        );
        let at = &rest.positions;
        let top = (0..at.len()).max_by(|a, b| at[*a].z.total_cmp(&at[*b].z));
        let top = top.unwrap();
        let slipped = at[top].x - (rest.lattice.coordinates[top].x + shift);
        let load = (long + slipped) / self.longest(self.short - slipped);
        Laid {
            rest,
            load,
            slipped,
        }
    }
}

/// Belts are laid ever lighter until one lies still. What its landing moved counts: it is judged by
/// how it lies.
#[test]
fn a_belt_holds_up_to_the_capstans_limit_and_no_farther() {
    let belts = [
        (belt("a", 0.1, 10.0, 0.5), 0.01),
        (belt("a", 0.1, 5.0, 0.5), 0.01),
        (belt("a", 0.3, 10.0, 0.25), 0.01),
        (belt("c", 0.1, 10.0, 0.5), 0.01),
        (belt("c", 0.3, 10.0, 0.5), 0.01),
        (belt("d", 0.1, 10.0, 0.5), 0.02),
        (belt("d", 0.3, 10.0, 0.5), 0.02),
    ];
    for (belt, margin) in belts {
        let beyond = belt.lay(1.0 + margin);
        assert!(!beyond.rest.converged, "{belt:?}: {}", beyond.load);
        assert!(beyond.slipped > 1.0, "{belt:?}: {} cm", beyond.slipped);
        let lighter = (1..8).map(|step| belt.lay(1.0 - 0.0025 * f64::from(step)));
        let lies = lighter.into_iter().find(|laid| laid.rest.converged);
        let load = lies.unwrap().load;
        writeln!(stderr(), "{belt:?}: holds {load:.4} of the limit").unwrap();
        assert!((load - 1.0).abs() <= margin, "{belt:?}: {load}");
    }
}

fn belt(fabric: &'static str, friction: f64, short: f64, pitch: f64) -> Belt {
    Belt {
        fabric,
        friction,
        short,
        pitch,
    }
}
