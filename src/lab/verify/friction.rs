//! Where friction gives way.

use super::{Allowed, Comparison, Named, name};
use crate::{
    fabric::Yarn,
    lab::{Capstan, LabError, Slope, Watch},
};

/// Friction coefficients that are tried [-].
const FRICTION: f64 = 0.3;

pub(super) fn compare(fabric: &Named, watch: Watch<'_>) -> Result<Vec<Comparison>, LabError> {
    let slope = Slope {
        friction: FRICTION,
        size: 8.0,
        pitch: 1.0,
    };
    let mut rows = vec![Comparison {
        test: name("slope", fabric, format!("µ {FRICTION}")),
        quantity: "sliding angle [deg]",
        figure: slope.run(&fabric.1, watch)?.angle,
        reference: libm::atan(FRICTION).to_degrees(),
        allowed: Allowed::Off(0.2),
        source: "tan θ = µ",
    }];
    // Paper does not lie on so small a cylinder.
    if fabric.1.warp.bending < 0.2 {
        let capstan = Capstan {
            friction: FRICTION,
            ..Capstan::of(&fabric.1, Yarn::Warp)
        };
        let held = capstan.run(&fabric.1, watch)?;
        rows.push(Comparison {
            test: name("capstan", fabric, format!("µ {FRICTION}")),
            quantity: "longest end [cm]",
            figure: held.long,
            reference: capstan.longest(held.short),
            allowed: Allowed::Percent(if fabric.1.warp.bending < 0.05 {
                1.0
            } else {
                2.0
            }),
            source: "heavy belt, Euler–Eytelwein",
        });
    }
    Ok(rows)
}
