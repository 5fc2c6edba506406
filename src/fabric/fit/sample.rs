//! Readings with the errors of a laboratory, the same ones each time.

/// Errors that look normal: sums of twelve even ones.
pub(super) struct Noise(u64);

impl Noise {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn even(&mut self) -> f64 {
        // Knuth's MMIX generator; its upper bits alone are good.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Of mean 0 and deviation 1.
    pub(super) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum::<f64>() - 6.0
    }

    /// The value with an error of that share of it.
    pub(super) fn about(&mut self, value: f64, share: f64) -> f64 {
        value * (1.0 + share * self.normal())
    }
}

/// A, B, bending, shear and weight of each direction of the paper's cloths (tables 1 and 2).
pub(super) const CLOTHS: [(&str, [f64; 5]); 10] = [
    ("a warp", [4.0e4, 1.7, 0.0060, 1.0, 0.0035]),
    ("a weft", [3.8e5, 2.3, 0.0060, 1.0, 0.0035]),
    ("b warp", [1.8e3, 1.5, 0.0057, 0.0, 0.0026]),
    ("b weft", [8.1e5, 2.5, 0.0025, 0.5, 0.0026]),
    ("c warp", [3.8e5, 1.8, 0.0089, 18.0, 0.014]),
    ("c weft", [3.1e4, 1.7, 0.0057, 6.0, 0.014]),
    ("d warp", [2.7e4, 1.4, 0.18, 84.0, 0.023]),
    ("d weft", [5.6e3, 1.2, 0.13, 64.0, 0.023]),
    ("washi long", [5.2e6, 1.9, 0.23, 4500.0, 0.005]),
    ("washi broad", [2.4e8, 2.3, 0.66, 11000.0, 0.005]),
];
