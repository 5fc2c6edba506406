//! The sheets of two instrument sets: Kawabata's KES-F and CSIRO's FAST.
//!
//! FAST (A. De Boos and D. Tester, *SiroFAST*, CSIRO report WT92.02, 1994; its relations from
//! memory, each derived here): FAST-3 gives the extension at 5, 20 and 100 gf/cm, to which the power
//! law is fitted by least squares of ln T over ln S, and EB5, the extension on the bias at 5 gf/cm.
//! Threads that do not stretch let cloth pulled on the bias by T per width give way by shear alone,
//! by T/(4·G), so G = 125/EB5 gf/cm (FAST writes 123/EB5 N/m, which is the same to 0.4 %). FAST-2
//! gives the bending length c, and M = W·c³.

use super::{Doubt, Estimate, Unfit};
use crate::fabric::KesDirection;

/// Along one thread direction of a KES-F sheet. Either LT or WT must be given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KesReadings {
    /// LT, linearity [-].
    pub lt: Option<f64>,
    /// WT, work up to 500 gf/cm [gf·cm/cm²].
    pub wt: Option<f64>,
    /// EMT, strain at 500 gf/cm [%].
    pub emt: f64,
    /// G, shear stiffness [gf/(cm·degree)].
    pub g: f64,
    /// 2HG, shear hysteresis at 0.5° [gf/cm].
    pub hg: Option<f64>,
    /// 2HG5, shear hysteresis at 5° [gf/cm].
    pub hg5: Option<f64>,
    /// B, bending rigidity [gf·cm²/cm].
    pub b: f64,
    /// 2HB, bending hysteresis [gf·cm/cm].
    pub hb: Option<f64>,
    /// MIU, friction against steel [-].
    pub miu: Option<f64>,
}

impl KesReadings {
    /// What the power law, bending and shear are computed from.
    ///
    /// # Errors
    /// [`Unfit`] where LT and WT contradict each other by more than 10 %, or LT has no power law.
    pub fn direction(&self) -> Result<(KesDirection, Vec<Doubt>), Unfit> {
        let mut doubts = self.hysteresis();
        let of_work = self.wt.map(|wt| KesDirection::linearity(wt, self.emt));
        if let (Some(lt), Some(wt), Some(other)) = (self.lt, self.wt, of_work) {
            let apart = (other / lt - 1.0).abs();
            if apart > 0.1 {
                return Err(Unfit::LinearityAndWork {
                    lt,
                    wt,
                    emt: self.emt,
                    expected: wt * lt / other,
                });
            }
            // Sheets give both to two or three digits.
            if apart > 0.02 {
                doubts.push(Doubt::LinearityAndWork { apart });
            }
        }
        let lt = self.lt.or(of_work).unwrap_or(0.0);
        if !(0.17..=1.0).contains(&lt) {
            return Err(Unfit::Linearity { lt });
        }
        let read = KesDirection {
            emt: self.emt,
            lt,
            b: self.b,
            g: self.g,
        };
        Ok((read, doubts))
    }

    fn hysteresis(&self) -> Vec<Doubt> {
        let mut doubts = Vec::new();
        if let (Some(hg), Some(hg5)) = (self.hg, self.hg5) {
            doubts.extend((hg5 < hg).then_some(Doubt::HysteresisFalls));
        }
        // At 8° and 1 /cm the instrument turns back: half of a hysteresis beyond what the cloth
        // answers there means that it stays where it is put.
        let beyond = |what, hysteresis: Option<f64>, stiffness: f64, times: f64| {
            let doubt = Doubt::Hysteresis { what, times };
            hysteresis
                .filter(|width| *width > times * stiffness)
                .map(|_| doubt)
        };
        doubts.extend(beyond("2HG", self.hg, self.g, 16.0));
        doubts.extend(beyond("2HB", self.hb, self.b, 2.0));
        doubts.extend(self.miu.map(|miu| Doubt::Miu { miu }));
        doubts
    }
}

/// Along one thread direction of a FAST sheet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FastReadings {
    /// E5, E20, E100: extension at 5, 20 and 100 gf/cm [%].
    pub extensions: [f64; 3],
    /// EB5, extension on the bias at 5 gf/cm [%].
    pub bias: f64,
    /// Bending length c [mm].
    pub length: f64,
    /// Bending rigidity, where the sheet gives it [µN·m].
    pub rigidity: Option<f64>,
}

impl FastReadings {
    /// A [gf/cm] and B [-], and how far the law misses the three extensions' tensions [-].
    ///
    /// # Errors
    /// [`Unfit`] where extensions do not grow, or the curve flattens.
    pub fn power_law(&self) -> Result<([Estimate; 2], f64), Unfit> {
        let [e5, e20, e100] = self.extensions;
        if !(e5 >= 0.0 && e20 > 0.0 && e5 <= e20 && e20 < e100) {
            return Err(Unfit::Extensions { e5, e20, e100 });
        }
        // FAST reads to 0.1 %: a stiff cloth's E5 may be 0, and says nothing then.
        let points: Vec<[f64; 2]> = [(e5, 5.0_f64), (e20, 20.0), (e100, 100.0)]
            .into_iter()
            .filter(|(extension, _)| *extension > 0.0)
            .map(|(extension, load)| [libm::log(0.01 * extension), libm::log(load)])
            .collect();
        let count = points.len() as f64;
        let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
        let (x, y) = (mean(0), mean(1));
        let across: f64 = points.iter().map(|p| (p[0] - x) * (p[0] - x)).sum();
        let along: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
        let power = along / across;
        let missed = points.iter().map(|p| y + power * (p[0] - x) - p[1]);
        let residual = (missed.map(|error| error * error).sum::<f64>() / count).sqrt();
        if power < 1.0 {
            return Err(Unfit::Flattens { b: power - 1.0 });
        }
        let a = libm::exp(y - power * x);
        Ok(([Estimate::given(a), Estimate::given(power - 1.0)], residual))
    }

    /// M = W·c³ [gf·cm] of a cloth that weighs W [gf/cm²].
    ///
    /// # Errors
    /// [`Unfit`] where the sheet's own rigidity is more than 10 % off.
    pub fn bending(&self, weight: f64) -> Result<f64, Unfit> {
        // 1 gf·cm is 98.0665 µN·m.
        const MICRONEWTON_METRES: f64 = 98.0665;
        let length = 0.1 * self.length;
        let bending = weight * length * length * length;
        let expected = MICRONEWTON_METRES * bending;
        match self.rigidity {
            Some(rigidity) if (rigidity / expected - 1.0).abs() > 0.1 => {
                Err(Unfit::RigidityAndLength {
                    rigidity,
                    length: self.length,
                    expected,
                })
            }
            _ => Ok(bending),
        }
    }

    /// M_SH = 125/EB5 [gf/cm].
    pub fn shear(&self) -> f64 {
        125.0 / self.bias
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric::Tension;

    /// A worsted suiting as KES-F writes it.
    const KES: KesReadings = KesReadings {
        lt: Some(0.62),
        wt: Some(7.75),
        emt: 5.0,
        g: 0.7,
        hg: Some(0.9),
        hg5: Some(1.8),
        b: 0.11,
        hb: Some(0.05),
        miu: None,
    };

    /// The same suiting as FAST writes it, 210 g/m².
    const FAST: FastReadings = FastReadings {
        extensions: [0.4, 1.0, 3.0],
        bias: 4.0,
        length: 18.0,
        rigidity: None,
    };

    #[test]
    fn work_alone_gives_the_linearity() {
        let alone = KesReadings { lt: None, ..KES };
        let (read, doubts) = alone.direction().unwrap();
        assert!((read.lt - 0.62).abs() < 1e-12 && doubts.is_empty());
        // By hand: B = 2/0.62 − 2 = 1.2258, A = 500/0.05^2.2258 = 393,400.
        let Tension::Power { a, b } = read.direction().tension else {
            panic!("{read:?}");
        };
        assert!(
            (b - 1.225_806).abs() < 1e-6 && (a / 393_395.0 - 1.0).abs() < 1e-3,
            "{a} {b}"
        );
    }

    #[test]
    fn linearity_and_work_must_agree() {
        let slightly = KesReadings {
            wt: Some(8.0),
            ..KES
        };
        let (_, doubts) = slightly.direction().unwrap();
        assert!(doubts[0].to_string().contains("3.2 % apart"), "{doubts:?}");
        let wrong = KesReadings {
            wt: Some(14.0),
            ..KES
        };
        let refused = wrong.direction().unwrap_err().to_string();
        assert!(refused.contains("= 7.750 gf·cm/cm²"), "{refused}");
        let flat = KesReadings {
            lt: Some(1.1),
            wt: None,
            ..KES
        };
        assert!(
            flat.direction()
                .unwrap_err()
                .to_string()
                .contains("allowed: 0.17 to 1")
        );
    }

    #[test]
    fn great_and_falling_hysteresis_is_doubted() {
        let odd = KesReadings {
            hg: Some(12.0),
            hg5: Some(1.0),
            miu: Some(0.18),
            ..KES
        };
        let said: Vec<String> = odd
            .direction()
            .unwrap()
            .1
            .iter()
            .map(Doubt::to_string)
            .collect();
        for part in [
            "2HG5 is below 2HG",
            "2HG is greater than 16 times",
            "against steel",
        ] {
            assert!(said.iter().any(|doubt| doubt.contains(part)), "{said:?}");
        }
    }

    #[test]
    fn fast_gives_bending_and_shear_as_its_manual() {
        // 9.81e-6·210·18³ = 12.01 µN·m; 123/4 = 30.75 N/m.
        let bending = FAST.bending(0.021).unwrap();
        assert!((98.0665 * bending / 12.014 - 1.0).abs() < 1e-3);
        assert!((0.980_665 * FAST.shear() / 30.75 - 1.0).abs() < 4e-3);
        let contradicted = FastReadings {
            rigidity: Some(20.0),
            ..FAST
        };
        assert!(contradicted.bending(0.021).is_err());
        let agreeing = FastReadings {
            rigidity: Some(12.0),
            ..FAST
        };
        assert!(agreeing.bending(0.021).is_ok());
    }

    #[test]
    fn fast_extensions_of_a_power_law_give_it_back() {
        // T = 2e4·S^2 at 5, 20, 100 gf/cm.
        let extensions = [5.0_f64, 20.0, 100.0].map(|load| 100.0 * (load / 2e4).sqrt());
        let ([a, b], residual) = FastReadings { extensions, ..FAST }.power_law().unwrap();
        assert!((a.value / 2e4 - 1.0).abs() < 1e-9 && (b.value - 1.0).abs() < 1e-9);
        assert!(residual < 1e-9);
        let ([_, _], residual) = FAST.power_law().unwrap();
        assert!(residual < 0.05, "{residual}");
    }

    #[test]
    fn fast_extensions_must_grow() {
        for extensions in [
            [0.4, 0.3, 3.0],
            [0.4, 1.0, 1.0],
            [0.0, 0.0, 1.0],
            [f64::NAN, 1.0, 2.0],
        ] {
            let sheet = FastReadings { extensions, ..FAST };
            assert!(matches!(sheet.power_law(), Err(Unfit::Extensions { .. })));
        }
        let stiff = FastReadings {
            extensions: [0.0, 0.2, 0.6],
            ..FAST
        };
        assert!(stiff.power_law().is_ok());
        let flat = FastReadings {
            extensions: [0.1, 1.0, 8.0],
            ..FAST
        };
        assert!(matches!(flat.power_law(), Err(Unfit::Flattens { .. })));
    }
}
