//! A rod pulls its ends together by (5): energy `w·b·∫T dS`.

use crate::{
    fabric::Tension,
    math::{Mat3, Vec3},
};

/// A rod's law: its rest length, its width of cloth and its yarn's tension.
#[derive(Clone, Copy, Debug)]
pub struct RodLaw<'a> {
    /// Tension per width against strain.
    pub tension: &'a Tension,
    /// Length at rest b [cm].
    pub rest: f64,
    /// Width of cloth w that it stands for [cm].
    pub width: f64,
    /// Greatest compression per width [gf/cm]: the Euler load π²·M_BN/b².
    pub floor: f64,
}

impl RodLaw<'_> {
    /// Strain S = (L − b)/b of a rod along `along` [-].
    #[must_use]
    pub fn strain(&self, along: &Vec3) -> f64 {
        (along.norm() - self.rest) / self.rest
    }

    /// Energy [gf·cm].
    #[must_use]
    pub fn energy(&self, along: &Vec3) -> f64 {
        self.width * self.rest * self.tension.energy(self.strain(along), self.floor)
    }

    /// The force on the first end, towards the second [gf].
    #[must_use]
    pub fn pull(&self, along: &Vec3) -> Vec3 {
        let length = along.norm().max(1e-12);
        along * (self.width * self.tension.tension(self.strain(along), self.floor) / length)
    }

    /// Second derivative of the energy by `along` [gf/cm]; with `positive`, the sideways push of a
    /// compressed rod counts as a resistance: what buckles then moves as far as it would stretch.
    #[must_use]
    pub fn stiffness(&self, along: &Vec3, positive: bool) -> Mat3 {
        let length = along.norm().max(1e-12);
        let unit = along / length;
        let strain = self.strain(along);
        let answer = self.tension.answer(strain, self.floor);
        let stretch = self.width * answer.tangent / self.rest;
        let sideways = self.width * answer.tension / length;
        let sideways = if positive { sideways.abs() } else { sideways };
        Mat3::identity() * sideways + unit * unit.transpose() * (stretch - sideways)
    }
}
