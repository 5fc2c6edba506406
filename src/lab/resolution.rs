//! How fine a lattice must be: what the drapemeter shows at a pitch, at half and at a quarter of it.
//!
//! Errors that fall as the pitch to a power q have `2^q = (v₁ − v₂)/(v₂ − v₃)`, the limit
//! `v₃ + (v₃ − v₂)/(2^q − 1)` (Richardson), and stay within 1 % of it up to a pitch that follows.
//! A cloth that folds otherwise at another pitch shows no order; then none is given.

use super::{
    Drapemeter, Drapes, Figure, LabError, Reading, Trace, Watch, reading::figures, reading::within,
};
use crate::fabric::Fabric;

/// The drapemeter at three pitches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// The coarsest pitch [cm].
    pub pitch: f64,
    /// Layings at each.
    pub seeds: u32,
}

/// What three pitches showed of one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Order {
    /// At the pitch, at half, at a quarter of it.
    pub values: [f64; 3],
    /// The power of the pitch that errors fall with; absent where they do not.
    pub order: Option<f64>,
    /// Pitch up to which the value is within 1 % of its limit [cm].
    pub within_percent: Option<f64>,
}

/// A power below this is none.
const LEAST_ORDER: f64 = 0.25;

impl Order {
    /// From values at a pitch [cm], a half and a quarter of it.
    #[must_use]
    pub fn of(values: [f64; 3], pitch: f64) -> Self {
        let [coarse, middle, fine] = values;
        let falls = (coarse - middle) / (middle - fine);
        let order = libm::log2(falls);
        let order = (order.is_finite() && order >= LEAST_ORDER).then_some(order);
        let within_percent = order.map(|order| {
            let left = (fine - middle) / (libm::exp2(order) - 1.0);
            let part = 0.01 * (fine + left).abs() / left.abs();
            0.25 * pitch * libm::pow(part, 1.0 / order)
        });
        Self {
            values,
            order,
            within_percent,
        }
    }
}

/// All quantities.
#[derive(Clone, Debug)]
pub struct Resolved {
    /// Pitches [cm].
    pub pitches: [f64; 3],
    /// Drape coefficient [%].
    pub coefficient: Order,
    /// Mean height of the rim below the supporting disc [cm].
    pub hem: Order,
    /// Greatest strain [%].
    pub strain: Order,
    /// The layings at each pitch.
    pub drapes: Vec<Drapes>,
}

impl Resolution {
    /// Lays the cloth at each pitch.
    ///
    /// # Errors
    /// [`LabError`] where a pitch is out of range.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Resolved, LabError> {
        let pitch = within("pitch [cm]", self.pitch, 0.4, 3.0)?;
        let pitches = [pitch, 0.5 * pitch, 0.25 * pitch];
        let seeds = self.seeds;
        let mut drapes = Vec::new();
        for pitch in pitches {
            let meter = Drapemeter {
                pitch,
                seeds,
                ..Drapemeter::default()
            };
            drapes.push(meter.run(fabric, watch)?);
        }
        let order = |of: fn(&super::Laying) -> f64| {
            let means = [0, 1, 2].map(|k: usize| drapes[k].spread(of)[0]);
            Order::of(means, pitch)
        };
        Ok(Resolved {
            pitches,
            coefficient: order(|laying| laying.coefficient),
            hem: order(|laying| laying.hem),
            strain: order(super::Laying::greatest_strain),
            drapes,
        })
    }
}

/// Keys of a quantity: its values, its order, its pitch.
type Keys = [&'static str; 5];

const COEFFICIENT: Keys = [
    "drape_coefficient_percent_whole",
    "drape_coefficient_percent_half",
    "drape_coefficient_percent_quarter",
    "drape_coefficient_order",
    "drape_coefficient_within_1_percent_cm",
];
const HEM: Keys = [
    "hem_below_disc_cm_whole",
    "hem_below_disc_cm_half",
    "hem_below_disc_cm_quarter",
    "hem_order",
    "hem_within_1_percent_cm",
];
const STRAIN: Keys = [
    "greatest_strain_percent_whole",
    "greatest_strain_percent_half",
    "greatest_strain_percent_quarter",
    "greatest_strain_order",
    "greatest_strain_within_1_percent_cm",
];

impl Resolved {
    /// What the instrument shows; an order that was not seen is left out.
    #[must_use]
    pub fn reading(self) -> Reading {
        let mut all = figures([("pitch_cm", self.pitches[0])]);
        let quantities = [
            (COEFFICIENT, self.coefficient),
            (HEM, self.hem),
            (STRAIN, self.strain),
        ];
        for (keys, order) in quantities {
            let values = order.values.map(Some).into_iter();
            let values = values.chain([order.order, order.within_percent]);
            let found = keys.into_iter().zip(values);
            all.extend(found.filter_map(|(key, value)| value.map(|value| Figure { key, value })));
        }
        let line = |order: &Order| self.pitches.into_iter().zip(order.values);
        let points = |order: &Order| line(order).map(|(pitch, value)| [pitch, value]).collect();
        let layings = self.drapes.iter().flat_map(|drapes| &drapes.layings);
        let certified = layings
            .into_iter()
            .all(|laying| laying.rest.settled.converged);
        Reading {
            instrument: "resolution",
            histogram: Vec::new(),
            figures: all,
            trace: Some(Trace {
                x: "pitch [cm]",
                y: "drape coefficient [%]",
                lines: vec![("drape coefficient", points(&self.coefficient))],
            }),
            certified,
            rest: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_that_fall_with_the_square_have_order_2() {
        let value = |pitch: f64| 20.0 + 3.0 * pitch * pitch;
        let order = Order::of([value(1.0), value(0.5), value(0.25)], 1.0);
        assert!((order.order.unwrap() - 2.0).abs() < 1e-12);
        // 3·h² is a hundredth of 20 at h = √(0.2/3).
        assert!((order.within_percent.unwrap() - (0.2_f64 / 3.0).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn values_that_swing_or_stand_have_no_order() {
        for values in [[1.0, 2.0, 1.5], [1.0, 1.0, 1.0], [1.0, 2.0, 3.0]] {
            let order = Order::of(values, 1.0);
            assert_eq!((order.order, order.within_percent), (None, None));
        }
    }
}
