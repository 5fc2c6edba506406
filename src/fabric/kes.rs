//! From a KES-F sheet (Kawabata's evaluation system) and from the paper's own tests to the numbers
//! of a [`Fabric`].
//!
//! The KES tensile test pulls to F_m = 500 gf/cm. Its sheet gives the strain EMT there [%], the
//! work WT = ∫F dS [gf·cm/cm²] and the linearity LT = WT/(F_m·EMT/200). With T = A·S^(B+1) the work
//! up to S_m = EMT/100 is F_m·S_m/(B+2), so LT = 2/(B+2):
//!
//! B = 2/LT − 2,  A = F_m/S_m^(B+1).

use crate::fabric::{Direction, Fabric, Friction, InvalidFabric, Tension};
use std::f64::consts::PI;

/// Force at which EMT, LT and WT are read [gf/cm].
const F_M: f64 = 500.0;

/// One direction of a KES-F sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KesDirection {
    /// EMT, strain at 500 gf/cm [%].
    pub emt: f64,
    /// LT, linearity [-]: 1 for a straight curve, less for one that starts soft.
    pub lt: f64,
    /// B, bending rigidity per width [gf·cm²/cm].
    pub b: f64,
    /// G, shear stiffness [gf/(cm·degree)].
    pub g: f64,
}

/// A KES-F sheet, as far as a drape needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KesSheet {
    /// W, weight per area [mg/cm²].
    pub w: f64,
    /// T, thickness [mm].
    pub t: f64,
    /// Along the warp.
    pub warp: KesDirection,
    /// Along the weft.
    pub weft: KesDirection,
}

impl KesDirection {
    /// LT [-] from WT [gf·cm/cm²] and EMT [%], for sheets that give no LT.
    pub fn linearity(wt: f64, emt: f64) -> f64 {
        wt / (F_M * emt / 200.0)
    }

    /// The same in the paper's units: the power law through the measured end and work; B as it is,
    /// since gf·cm²/cm is gf·cm; G per radian.
    pub fn direction(&self) -> Direction {
        let b = 2.0 / self.lt - 2.0;
        let a = F_M / libm::pow(self.emt / 100.0, b + 1.0);
        Direction {
            tension: Tension::Power { a, b },
            bending: self.b,
            shear: self.g * 180.0 / PI,
        }
    }
}

impl KesSheet {
    /// The sheet as a fabric. Friction is given apart: MIU of KES is against steel.
    ///
    /// # Errors
    /// [`InvalidFabric`] where a converted value is outside its range, as B is for LT above 1.
    pub fn fabric(
        &self,
        name: &str,
        source: &str,
        friction: Friction,
    ) -> Result<Fabric, InvalidFabric> {
        Fabric {
            name: name.into(),
            source: source.into(),
            weight: self.w / 1000.0,
            thickness: self.t / 10.0,
            friction,
            // KES-F has no test of twist.
            twist: 0.0,
            warp: self.warp.direction(),
            weft: self.weft.direction(),
        }
        .checked()
    }
}

/// Bending moment per width and curvature by (2) [gf·cm]: M_BN = W·(L/2)³, from the overhang L [cm]
/// at which a strip of weight W [gf/cm²] bends down to a slope of 41.5°.
pub fn bending_from_overhang(weight: f64, length: f64) -> f64 {
    let half = 0.5 * length;
    weight * half * half * half
}

/// The shear test of figure 3: two clamps, side by side, that move along each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearTest {
    /// F, force along the clamps [gf].
    pub force: f64,
    /// W, weight that keeps the cloth taut [gf].
    pub load: f64,
    /// A, distance between the clamps [cm].
    pub gap: f64,
    /// L, length of the clamps [cm].
    pub width: f64,
    /// D, how far they moved along each other [cm].
    pub displacement: f64,
}

/// Shear force per width and radian by (3) and (4) [gf/cm]: M_SH = (F − F₀)·A/(L·D), where
/// F₀ = W·tan θ is the load's own part and tan θ = D/A.
pub fn shear_from_frame(test: &ShearTest) -> f64 {
    let slope = test.displacement / test.gap;
    (test.force - test.load * slope) / (test.width * slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A worsted suiting.
    const WARP: KesDirection = KesDirection {
        emt: 5.0,
        lt: 0.62,
        b: 0.11,
        g: 0.7,
    };

    #[test]
    fn the_power_law_meets_the_sheet_at_500_gf_per_cm() {
        let tension = WARP.direction().tension;
        assert!((tension.tension(0.05, 0.0) - 500.0).abs() < 1e-9);
        let work = tension.energy(0.05, 0.0);
        assert!((KesDirection::linearity(work, 5.0) - 0.62).abs() < 1e-12);
    }

    #[test]
    fn a_linearity_of_one_is_the_linear_law() {
        let tension = KesDirection { lt: 1.0, ..WARP }.direction().tension;
        assert!((tension.tension(0.01, 0.0) - 100.0).abs() < 1e-9);
    }

    #[test]
    fn shear_is_counted_per_radian() {
        assert!((WARP.direction().shear - 40.107).abs() < 1e-3);
    }

    #[test]
    fn weight_and_thickness_change_unit() {
        let sheet = KesSheet {
            w: 21.0,
            t: 0.62,
            warp: WARP,
            weft: WARP,
        };
        let friction = Friction {
            body: 0.35,
            cloth: 0.4,
        };
        let fabric = sheet.fabric("suiting", "test", friction).unwrap();
        assert!((fabric.weight - 0.021).abs() < 1e-15);
        assert!((fabric.thickness - 0.062).abs() < 1e-15);
        assert_eq!(fabric.warp.bending, 0.11);
        let convex = KesSheet {
            weft: KesDirection { lt: 1.3, ..WARP },
            ..sheet
        };
        let refused = convex.fabric("", "", friction).unwrap_err();
        assert!(refused.to_string().starts_with("weft tension exponent B"));
    }

    #[test]
    fn cloth_a_bends_over_at_2_39_cm() {
        // 2·(0.006/0.0035)^(1/3), table 1.
        assert!((bending_from_overhang(0.0035, 2.393_635) - 0.006).abs() < 1e-7);
    }

    #[test]
    fn the_load_takes_its_own_part_of_the_shear_force() {
        // KES: clamps 20 cm long, 5 cm apart; M_SH 18 gf/cm at a slope of 0.1 under 200 gf.
        let test = ShearTest {
            force: 18.0 * 20.0 * 0.1 + 200.0 * 0.1,
            load: 200.0,
            gap: 5.0,
            width: 20.0,
            displacement: 0.5,
        };
        assert!((shear_from_frame(&test) - 18.0).abs() < 1e-12);
    }
}
