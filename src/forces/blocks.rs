//! The 3×3 system (8) of nodes side by side.

use crate::lanes::{Lanes, Points, Simd};

/// Symmetric blocks side by side: xx, yy, zz, xy, xz, yz.
#[derive(Clone, Copy)]
pub(crate) struct Blocks<S: Simd>(pub(crate) [Lanes<S>; 6]);

impl<S: Simd> Blocks<S> {
    /// All zero.
    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        Self([Lanes::of(simd, 0.0); 6])
    }

    /// Adds a multiple of the identity.
    #[inline(always)]
    pub(crate) fn add_identity(&mut self, factor: Lanes<S>) {
        for entry in &mut self.0[..3] {
            *entry = *entry + factor;
        }
    }

    /// Adds a multiple of the square `v·vᵀ`.
    #[inline(always)]
    pub(super) fn add_square(&mut self, v: Points<S>, factor: Lanes<S>) {
        let [x, y, z] = v.0;
        let (fx, fy, fz) = (x * factor, y * factor, z * factor);
        let square = [x * fx, y * fy, z * fz, x * fy, x * fz, y * fz];
        for (entry, term) in self.0.iter_mut().zip(square) {
            *entry = *entry + term;
        }
    }

    /// `v·A·v`.
    #[inline(always)]
    pub(crate) fn square_of(&self, v: Points<S>) -> Lanes<S> {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        let [x, y, z] = v.0;
        x * (xx * x + (xy * y + xz * z) * 2.0) + y * (yy * y + yz * z * 2.0) + zz * (z * z)
    }

    /// The points that these blocks, positive definite, take to `force`: by Cramer's rule.
    #[inline(always)]
    pub(crate) fn solve(&self, force: Points<S>) -> Points<S> {
        let [a, b, c, d, e, f] = self.0;
        let (xx, yy, zz) = (b * c - f * f, a * c - e * e, a * b - d * d);
        let (xy, xz, yz) = (e * f - d * c, d * f - e * b, d * e - a * f);
        let over = Lanes::of(a.kind(), 1.0).over(a * xx + d * xy + e * xz);
        let [x, y, z] = force.0;
        Points([
            (xx * x + xy * y + xz * z) * over,
            (xy * x + yy * y + yz * z) * over,
            (xz * x + yz * y + zz * z) * over,
        ])
    }
}
