//! There and back: a curve with 1 % noise becomes A and B, and a strip of them is pulled.

use super::{Allowed, Comparison, Named, name};
use crate::{
    fabric::{
        Fabric, Tension, Yarn,
        fit::{Range, power_law},
    },
    lab::{LabError, Pull, Watch},
};

/// Readings of the curve, and the force at its end [gf/cm], as of the KES tester.
const READINGS: u32 = 150;
const END: f64 = 500.0;

pub(super) fn compare(fabric: &Named, watch: Watch<'_>) -> Result<Vec<Comparison>, LabError> {
    let mut rows = Vec::new();
    for yarn in [Yarn::Warp, Yarn::Weft] {
        if let Tension::Power { a, b } = fabric.1.along(yarn).tension {
            rows.extend(there_and_back(fabric, yarn, [a, b], watch)?);
        }
    }
    Ok(rows)
}

fn there_and_back(
    fabric: &Named,
    yarn: Yarn,
    [a, b]: [f64; 2],
    watch: Watch<'_>,
) -> Result<Vec<Comparison>, LabError> {
    let law = &fabric.1.along(yarn).tension;
    let most = law.strain_at(END);
    let mut noise = Noise(1);
    let points: Vec<[f64; 2]> = (1..=READINGS)
        .map(|k| most * f64::from(k) / f64::from(READINGS))
        .map(|strain| {
            [
                strain,
                law.tension(strain, 0.0) * (1.0 + 0.01 * noise.next()),
            ]
        })
        .collect();
    let Ok(fit) = power_law(&points, &Range::default()) else {
        return Ok(Vec::new());
    };
    let tension = Tension::Power {
        a: fit.a.value,
        b: fit.b.value,
    };
    let mut found = fabric.1.clone();
    match yarn {
        Yarn::Warp => found.warp.tension = tension,
        Yarn::Weft => found.weft.tension = tension,
    }
    let [pulled, measured] = pull(&found, yarn, most, law, watch)?;
    let row = |quantity, figure, reference, allowed, source| Comparison {
        test: name("S–S curve with 1 % noise", fabric, yarn),
        quantity,
        figure,
        reference,
        allowed,
        source,
    };
    let own = "the fabric's own, table 2";
    Ok(vec![
        row("A [gf/cm]", fit.a.value, a, Allowed::Percent(2.0), own),
        row("B [-]", fit.b.value, b, Allowed::Off(0.02), own),
        row(
            "a strip of A, B at half the strain [gf/cm]",
            pulled,
            measured,
            Allowed::Percent(2.0),
            "the measured curve",
        ),
    ])
}

/// Tension of the simulated strip, and of the law it was measured by, at half the strain [gf/cm].
fn pull(
    found: &Fabric,
    yarn: Yarn,
    most: f64,
    law: &Tension,
    watch: Watch<'_>,
) -> Result<[f64; 2], LabError> {
    let half = 0.5 * most;
    let pull = Pull {
        cut: yarn.into(),
        most: half,
        steps: 1,
        ..Pull::default()
    };
    let curve = pull.run(found, watch)?.curve;
    let pulled = curve.last().map_or(0.0, |[_, tension]| *tension);
    Ok([pulled, law.tension(half, 0.0)])
}

/// Numbers with mean 0 and variance 1, the same each time: twelve of Marsaglia's xorshift, summed.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        let mut sum = -6.0;
        for _ in 0..12 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            sum += (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        }
        sum
    }
}
