//! The ranges outside of which a value is a slip of the pen, not a cloth.

use crate::fabric::{Direction, Fabric, Tension, Yarn};
use std::{fmt, ops::RangeInclusive};

/// A number of a fabric that has a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Weight per area.
    Weight,
    /// Thickness.
    Thickness,
    /// Friction coefficient against a body.
    BodyFriction,
    /// Friction coefficient against cloth.
    ClothFriction,
    /// Twisting moment per width and twist.
    Twist,
    /// Factor A of the power law (1).
    PowerFactor(Yarn),
    /// Exponent B of the power law (1).
    PowerExponent(Yarn),
    /// Linear tension modulus.
    LinearModulus(Yarn),
    /// Bending moment per width and curvature.
    Bending(Yarn),
    /// Shear force per width and radian.
    Shear(Yarn),
}

/// A value outside its range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{quantity} is {value}; allowed: {}", quantity.allowed())]
pub struct InvalidFabric {
    /// Which value.
    pub quantity: Quantity,
    /// What it is.
    pub value: f64,
}

impl Quantity {
    /// Least and greatest value, ends included.
    ///
    /// Wide around what is woven: gauze weighs 0.002, felt 0.2 gf/cm²; shear 0 was measured
    /// (cloth B, warp).
    pub fn range(self) -> RangeInclusive<f64> {
        match self {
            Self::Weight => 1e-5..=1.0,
            Self::Thickness => 1e-4..=2.0,
            Self::BodyFriction | Self::ClothFriction => 0.0..=5.0,
            Self::PowerFactor(_) => 1e-3..=1e12,
            Self::PowerExponent(_) => 0.0..=10.0,
            Self::LinearModulus(_) => 1e-3..=1e9,
            Self::Bending(_) | Self::Twist => 0.0..=1e4,
            Self::Shear(_) => 0.0..=1e6,
        }
    }

    /// Its unit; empty where it has none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Weight => "gf/cm²",
            Self::Thickness => "cm",
            Self::PowerFactor(_) | Self::LinearModulus(_) | Self::Shear(_) => "gf/cm",
            Self::Bending(_) | Self::Twist => "gf·cm",
            Self::BodyFriction | Self::ClothFriction | Self::PowerExponent(_) => "",
        }
    }

    /// Its range in words, such as `0.0001 to 2 cm`.
    pub fn allowed(self) -> String {
        let (range, unit) = (self.range(), self.unit());
        let space = if unit.is_empty() { "" } else { " " };
        format!("{} to {}{space}{unit}", range.start(), range.end())
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Weight => f.write_str("weight"),
            Self::Thickness => f.write_str("thickness"),
            Self::BodyFriction => f.write_str("friction against a body"),
            Self::ClothFriction => f.write_str("friction against cloth"),
            Self::Twist => f.write_str("twist"),
            Self::PowerFactor(yarn) => write!(f, "{yarn} tension factor A"),
            Self::PowerExponent(yarn) => write!(f, "{yarn} tension exponent B"),
            Self::LinearModulus(yarn) => write!(f, "{yarn} tension modulus"),
            Self::Bending(yarn) => write!(f, "{yarn} bending"),
            Self::Shear(yarn) => write!(f, "{yarn} shear"),
        }
    }
}

impl Fabric {
    /// The fabric itself, when each value is inside its [range](Quantity::range).
    ///
    /// # Errors
    /// [`InvalidFabric`] names the first value that is not, NaN and infinities among them.
    pub fn checked(self) -> Result<Self, InvalidFabric> {
        let of_cloth = [
            (Quantity::Weight, self.weight),
            (Quantity::Thickness, self.thickness),
            (Quantity::BodyFriction, self.friction.body),
            (Quantity::ClothFriction, self.friction.cloth),
            (Quantity::Twist, self.twist),
        ];
        let along = |yarn, direction| quantities_along(yarn, direction);
        let values = of_cloth
            .into_iter()
            .chain(along(Yarn::Warp, &self.warp))
            .chain(along(Yarn::Weft, &self.weft));
        for (quantity, value) in values {
            if !quantity.range().contains(&value) {
                return Err(InvalidFabric { quantity, value });
            }
        }
        Ok(self)
    }
}

/// The values of one direction; those of a measured curve were checked when it was made.
fn quantities_along(yarn: Yarn, direction: &Direction) -> Vec<(Quantity, f64)> {
    let mut values = match direction.tension {
        Tension::Power { a, b } => vec![
            (Quantity::PowerFactor(yarn), a),
            (Quantity::PowerExponent(yarn), b),
        ],
        Tension::Linear { modulus } => vec![(Quantity::LinearModulus(yarn), modulus)],
        Tension::Points(_) => Vec::new(),
    };
    values.push((Quantity::Bending(yarn), direction.bending));
    values.push((Quantity::Shear(yarn), direction.shear));
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric::Friction;

    /// Cloth B of tables 1 and 2, whose warp shear was measured as 0.
    fn cloth_b() -> Fabric {
        let along = |a, b, bending, shear| Direction {
            tension: Tension::Power { a, b },
            bending,
            shear,
        };
        Fabric {
            name: "B".into(),
            source: "tables 1 and 2".into(),
            weight: 0.0026,
            thickness: 0.02,
            friction: Friction {
                body: 0.35,
                cloth: 0.4,
            },
            twist: 0.0,
            warp: along(1.8e3, 1.5, 0.0057, 0.0),
            weft: along(8.1e5, 2.5, 0.0025, 0.5),
        }
    }

    #[test]
    fn a_shear_of_zero_is_a_measured_value() {
        assert_eq!(cloth_b().checked(), Ok(cloth_b()));
    }

    #[test]
    fn the_message_names_quantity_value_and_range() {
        let mut fabric = cloth_b();
        fabric.weft.bending = -0.1;
        assert_eq!(
            fabric.checked().unwrap_err().to_string(),
            "weft bending is -0.1; allowed: 0 to 10000 gf·cm"
        );
    }

    #[test]
    fn every_value_is_checked_against_nan_and_infinity() {
        let spoil: [fn(&mut Fabric, f64); 11] = [
            |f, v| f.weight = v,
            |f, v| f.thickness = v,
            |f, v| f.friction.body = v,
            |f, v| f.friction.cloth = v,
            |f, v| f.twist = v,
            |f, v| f.warp.tension = Tension::Power { a: v, b: 1.0 },
            |f, v| f.warp.tension = Tension::Power { a: 1.0, b: v },
            |f, v| f.weft.tension = Tension::Linear { modulus: v },
            |f, v| f.warp.bending = v,
            |f, v| f.weft.shear = v,
            |f, v| f.warp.shear = v,
        ];
        for (which, spoil) in spoil.into_iter().enumerate() {
            for value in [f64::NAN, f64::INFINITY, -1.0] {
                let mut fabric = cloth_b();
                spoil(&mut fabric, value);
                assert!(fabric.checked().is_err(), "value {which} let {value} pass");
            }
        }
    }
}
