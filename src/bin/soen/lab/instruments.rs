//! From the wishes of a command line to an instrument's reading.

use super::args::{Along, Specimen};
use soen::{
    fabric::Fabric,
    lab::{
        BiasBend, Buckling, Cantilever, Capstan, Drapemeter, HeartLoop, HungStrip, LabError, Pull,
        Reading, Resolution, ShearFrame, Slope, StickSlip, Watch,
    },
};

pub(super) type Found = Result<Reading, LabError>;

/// The cloth that is tried, how finely it is cut, and who watches.
pub(super) struct Trial<'a, 'w> {
    pub(super) fabric: &'a Fabric,
    pub(super) of: &'a Specimen,
    pub(super) watch: Watch<'w>,
}

impl Trial<'_, '_> {
    fn pitch(&self, usual: f64) -> f64 {
        self.of.pitch.unwrap_or(usual)
    }

    pub(super) fn hung_strip(self, along: &Along, length: f64) -> Found {
        let strip = HungStrip {
            yarn: along.direction.yarn(),
            length,
            pitch: self.pitch(length / 60.0),
        };
        Ok(strip.run(self.fabric, self.watch)?.reading())
    }

    pub(super) fn pulled_strip(self, along: &Along, length: f64, most: f64) -> Found {
        let usual = Pull::default();
        let pull = Pull {
            cut: along.direction.cut(),
            most,
            pitch: self.pitch(usual.pitch),
            size: [length, usual.size[1]],
            ..usual
        };
        Ok(pull.run(self.fabric, self.watch)?.reading())
    }

    pub(super) fn cantilever(self, along: &Along, overhang: f64) -> Found {
        let test = Cantilever {
            yarn: along.direction.yarn(),
            overhang,
            pitch: self.pitch(overhang / 40.0),
        };
        Ok(test.run(self.fabric, self.watch)?.reading(&test))
    }

    /// The overhang that meets the slope of 41.5°.
    pub(super) fn overhang(self, along: &Along) -> Found {
        /// Cells along the strip whose slope is looked for.
        const CELLS: u32 = 20;
        /// And at most.
        const MOST: f64 = 200.0;
        let yarn = along.direction.yarn();
        let mut found = Cantilever::overhang(self.fabric, yarn, CELLS, &mut *self.watch)?;
        if let Some(pitch) = self.of.pitch {
            let cells = cells_of(pitch, found.length, [2.0, MOST])?;
            found = Cantilever::overhang(self.fabric, yarn, cells, self.watch)?;
        }
        Ok(found.reading(self.fabric, yarn))
    }

    pub(super) fn shear(self, along: &Along, load: Option<f64>, angle: f64) -> Found {
        let frame = ShearFrame {
            along: along.direction.yarn(),
            most: angle,
            ..ShearFrame::default()
        };
        let mut frame = frame.taut(self.fabric);
        frame.load = load.unwrap_or(frame.load);
        frame.pitch = self.pitch(frame.pitch);
        Ok(frame.run(self.fabric, self.watch)?.reading())
    }

    pub(super) fn heart_loop(self, along: &Along, length: Option<f64>) -> Found {
        let yarn = along.direction.yarn();
        let length = length.unwrap_or(HeartLoop::of(self.fabric, yarn).length);
        let heart = HeartLoop {
            yarn,
            length,
            pitch: self.pitch(length / 80.0),
        };
        Ok(heart.run(self.fabric, self.watch)?.reading())
    }

    pub(super) fn drapemeter(self, seeds: u32) -> Found {
        let usual = Drapemeter::of(self.fabric);
        let meter = Drapemeter {
            seeds,
            pitch: self.pitch(usual.pitch),
            ..usual
        };
        Ok(meter.run(self.fabric, self.watch)?.reading())
    }

    pub(super) fn resolution(self, seeds: u32) -> Found {
        let resolution = Resolution {
            pitch: self.pitch(1.0),
            seeds,
        };
        Ok(resolution.run(self.fabric, self.watch)?.reading())
    }

    pub(super) fn slope(self, friction: Option<f64>) -> Found {
        let slope = Slope {
            friction: friction.unwrap_or(self.fabric.friction.body),
            size: 8.0,
            pitch: self.pitch(1.0),
        };
        Ok(slope.run(self.fabric, self.watch)?.reading(&slope))
    }

    pub(super) fn capstan(self, along: &Along, friction: Option<f64>) -> Found {
        let usual = Capstan::of(self.fabric, along.direction.yarn());
        let capstan = Capstan {
            friction: friction.unwrap_or(self.fabric.friction.body),
            pitch: self.pitch(usual.pitch),
            ..usual
        };
        Ok(capstan.run(self.fabric, self.watch)?.reading(&capstan))
    }

    pub(super) fn bias_bend(self, twist: Option<f64>) -> Found {
        let mut test = BiasBend::of(self.fabric);
        test.twist = twist.unwrap_or(test.twist);
        if let Some(pitch) = self.of.pitch {
            test.cells = cells_of(pitch, BiasBend::length(self.fabric), [4.0, 200.0])?;
        }
        Ok(test.run(self.fabric, self.watch)?.reading(&test))
    }

    pub(super) fn buckling(self, along: &Along, twist: Option<f64>, rigid: bool) -> Found {
        let yarn = along.direction.yarn();
        let cloth = Fabric {
            twist: twist.unwrap_or(self.fabric.twist),
            ..self.fabric.clone()
        };
        let mut test = Buckling {
            yarn,
            rigid,
            ..Buckling::default()
        };
        if let Some(pitch) = self.of.pitch {
            let height = test.slimness * Buckling::critical(&cloth, yarn)?;
            test.cells = cells_of(pitch, height, [1.0, 20.0])?;
        }
        Ok(test.run(&cloth, self.watch)?.reading())
    }

    pub(super) fn stick_slip(self, along: &Along, friction: Option<f64>) -> Found {
        let mut test = StickSlip {
            yarn: along.direction.yarn(),
            friction: friction.unwrap_or(self.fabric.friction.body),
            cells: 40,
        };
        if let Some(pitch) = self.of.pitch {
            test.cells = cells_of(pitch, StickSlip::LENGTH, StickSlip::CELLS)?;
        }
        Ok(test.run(self.fabric, self.watch)?.reading(&test))
    }
}

/// Cells of a wished pitch [cm] over a length [cm], where so few and so many are allowed.
fn cells_of(pitch: f64, length: f64, [few, many]: [f64; 2]) -> Result<u32, LabError> {
    let [least, most] = [length / many, length / few];
    if (least..=most).contains(&pitch) {
        Ok((length / pitch).round() as u32)
    } else {
        Err(LabError::NotAllowed {
            what: "pitch [cm]",
            value: pitch,
            allowed: format!("{least:.4} to {most:.4}"),
        })
    }
}
