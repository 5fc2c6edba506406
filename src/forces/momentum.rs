//! Inertia and still air over a step of time, as a law with an energy: so that a moving cloth's next
//! place is an equilibrium like any other, `½k·|x − t|²` more for each node.
//!
//! Backward Euler: with mass m [gf·s²/cm], a step h [s] and a damping c [1/s], a node that went from
//! x₀ with velocity v resists by `m·((x − x₀)/h − v)/h + c·m·(x − x₀)/h`. So `k = (1 + c·h)·m/h²`
//! [gf/cm], and `t = x₀ + h·v/(1 + c·h)`.

use crate::{math::Vec3, threads};

/// Standard gravity [cm/s²] (3rd CGPM, 1901): what weighs 1 gf has a mass of 1/980.665 gf·s²/cm.
pub const GRAVITY: f64 = 980.665;

/// What draws each node to where it would go by itself.
#[derive(Clone, Debug)]
pub struct Momentum {
    stiffness: Vec<f64>,
    targets: Vec<Vec3>,
}

impl Momentum {
    /// Of nodes with weights [gf] that went from places [cm] with velocities [cm/s], over a step [s]
    /// in air that damps by a rate [1/s].
    #[must_use]
    pub fn new(
        weights: &[f64],
        (from, velocities): (&[Vec3], &[Vec3]),
        step: f64,
        damping: f64,
    ) -> Self {
        let slowed = 1.0 + damping * step;
        let per_weight = slowed / (GRAVITY * step * step);
        let ways = from.iter().zip(velocities);
        Self {
            stiffness: weights.iter().map(|weight| weight * per_weight).collect(),
            targets: ways
                .map(|(from, velocity)| from + velocity * (step / slowed))
                .collect(),
        }
    }

    /// Where a node goes if nothing else acts on it [cm].
    #[must_use]
    pub fn target(&self, node: usize) -> Vec3 {
        self.targets[node]
    }

    /// Stiffness against moving a node in any direction [gf/cm].
    #[must_use]
    pub fn stiffness(&self, node: usize) -> f64 {
        self.stiffness[node]
    }

    /// Force on a node at `here` [gf].
    #[must_use]
    pub fn force(&self, node: usize, here: &Vec3) -> Vec3 {
        (self.targets[node] - here) * self.stiffness[node]
    }

    /// Energy of all nodes [gf·cm].
    #[must_use]
    pub fn energy(&self, at: &[Vec3]) -> f64 {
        threads::sum(at.len(), |node| {
            0.5 * self.stiffness[node] * (at[node] - self.targets[node]).norm_squared()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector(size: f64) -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-size..size).prop_map(Vec3::from)
    }

    proptest! {
        /// Newton's second law by difference quotients, and air that resists the mean velocity.
        #[test]
        fn a_node_resists_by_mass_times_acceleration_and_by_the_air(
            from in vector(10.0), velocity in vector(200.0), to in vector(10.0),
            step in 1e-3..0.1f64, damping in 0.0..20.0f64,
        ) {
            let law = Momentum::new(&[2.0], (&[from], &[velocity]), step, damping);
            let mass = 2.0 / 980.665;
            let now = (to - from) / step;
            let resists = (now - velocity) * (mass / step) + now * (mass * damping);
            let error = (law.force(0, &to) + resists).norm();
            prop_assert!(error <= 1e-12 * (1.0 + resists.norm() + law.stiffness(0) * 20.0));
            // The force is the slope of the energy, which is square: central differences are exact.
            for axis in 0..3 {
                let mut ahead = to;
                ahead[axis] += 0.5;
                let mut behind = to;
                behind[axis] -= 0.5;
                let slope = law.energy(&[ahead]) - law.energy(&[behind]);
                prop_assert!((slope + law.force(0, &to)[axis]).abs() <= 1e-9 * law.energy(&[to]).max(1.0));
            }
        }
    }
}
