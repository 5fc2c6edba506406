//! The shear tester (paper A-iii, figure 3; KES-F1-S): a sheet between two clamps that move along
//! each other, kept taut by a load.

use super::{
    LabError, Reading, Rest, Trace, Watch,
    reading::{figures, within},
    specimen::{hold, strip, tared},
};
use crate::{
    fabric::{Fabric, Yarn},
    lattice::Edge,
    math::{Vec2, Vec3},
    solver::{Grip, Hold},
};

/// The frame; its clamps lie along one yarn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearFrame {
    /// Yarn that runs along the clamps.
    pub along: Yarn,
    /// L, length of the clamps [cm].
    pub width: f64,
    /// A, distance between the clamps [cm].
    pub gap: f64,
    /// W, the load that keeps the cloth taut [gf]. Where it is 0, hinged rods lead the sheet's sides
    /// and keep the clamps at the yarns' length: a picture frame.
    pub load: f64,
    /// Greatest angle [°].
    pub most: f64,
    /// In how many equal steps.
    pub steps: u32,
    /// Pitch of the lattice [cm].
    pub pitch: f64,
}

impl Default for ShearFrame {
    /// KES: 20 × 5 cm, 200 gf, 8°.
    fn default() -> Self {
        Self {
            along: Yarn::Warp,
            width: 20.0,
            gap: 5.0,
            load: 200.0,
            most: 8.0,
            steps: 16,
            pitch: 1.0,
        }
    }
}

/// One position of the clamps.
#[derive(Clone, Debug)]
pub struct Sheared {
    /// θ, how steeply the cloth runs from clamp to clamp [rad].
    pub angle: f64,
    /// How much longer the yarns between the clamps are than at rest [-]: 1 is not at all.
    pub stretch: f64,
    /// F, force along the middle half of a clamp, per width [gf/cm].
    pub force: f64,
    /// The same along the whole clamp, free edges of the sheet included [gf/cm].
    pub whole_force: f64,
    /// F₀, what the load alone brings, W·tan θ, per width [gf/cm].
    pub of_load: f64,
    /// The sheet.
    pub rest: Rest,
}

/// All positions.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The load [gf].
    pub load: f64,
    /// From the least angle to the greatest.
    pub positions: Vec<Sheared>,
}

/// KES reads G between these angles [°].
const READ: [f64; 2] = [0.49, 2.51];
/// The load is met to within this part of it.
const LOAD_MET: f64 = 1e-5;
/// Or their distance is known to within this part.
const CLOSE: f64 = 1e-6;
/// Most tries to meet it.
const TRIES: usize = 60;

impl ShearFrame {
    /// The frame with a load that keeps a fabric taut: four times what shears it where it is read,
    /// 200 gf at least. Paper under 200 gf wrinkles, and reads a third less.
    #[must_use]
    pub fn taut(self, fabric: &Fabric) -> Self {
        let shear = 0.5 * (fabric.warp.shear + fabric.weft.shear);
        let load = 4.0 * shear * libm::tan(READ[1].to_radians()) * self.width;
        let load = load.max(Self::default().load);
        Self { load, ..self }
    }

    /// Shears the sheet; its weight is taken off. Forces are read on the middle half of the clamps:
    /// at the sheet's free sides no shear stress can be, which lowers the whole by some percent.
    ///
    /// # Errors
    /// [`LabError`] where the sheet cannot be cut, or does not take the load.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Frame, LabError> {
        within("angle [deg]", self.most, 0.1, 30.0)?;
        within("width [cm]", self.width, 0.1, 200.0)?;
        within("gap [cm]", self.gap, 0.1, 200.0)?;
        let least = self.gap.max(self.width) / 400.0;
        within("pitch [cm]", self.pitch, least, self.gap)?;
        within("load [gf]", self.load, 0.0, 1e5)?;
        let cloth = tared(fabric);
        let steps = self.steps.clamp(1, 100);
        let angle = |step: u32| (self.most * f64::from(step) / f64::from(steps)).to_radians();
        let positions = (1..=steps).map(|step| self.at(&cloth, angle(step), watch));
        Ok(Frame {
            load: self.load,
            positions: positions.collect::<Result<_, _>>()?,
        })
    }

    /// The sheet at one angle.
    fn at(&self, cloth: &Fabric, angle: f64, watch: Watch<'_>) -> Result<Sheared, LabError> {
        let (apart, rest) = if self.load > 0.0 {
            self.under_load(cloth, angle, watch)?
        } else {
            let apart = self.gap * libm::cos(angle);
            (apart, self.sheared(cloth, angle, apart, watch)?)
        };
        Ok(Sheared {
            angle,
            stretch: apart / (self.gap * libm::cos(angle)),
            force: self.middle(&rest).x,
            whole_force: rest.pull(Edge::YMax).x / self.width,
            of_load: self.load / self.width * libm::tan(angle),
            rest,
        })
    }

    /// The clamps where the load pulls them: by the secant, halving where that leaves the ends
    /// between which they are.
    fn under_load(
        &self,
        cloth: &Fabric,
        angle: f64,
        watch: Watch<'_>,
    ) -> Result<(f64, Rest), LabError> {
        let asked = self.load / self.width;
        let yarn = cloth.along(across(self.along)).tension.strain_at(asked);
        let length = self.gap * libm::cos(angle);
        let (mut near, mut far) = (length, 2.0 * length);
        let mut last = [length, -asked];
        let mut apart = length * (1.0 + yarn);
        for tried in 1..=TRIES {
            let rest = self.sheared(cloth, angle, apart, watch)?;
            let off = self.middle(&rest).y - asked;
            if off < 0.0 {
                near = apart;
            } else {
                far = apart;
            }
            if off.abs() < LOAD_MET * asked || far - near < CLOSE * self.gap {
                return Ok((apart, rest));
            }
            let next = apart - off * (apart - last[0]) / (off - last[1]);
            last = [apart, off];
            // Where the sheet buckles its pull jumps: every third try halves.
            let inside = near < next && next < far && tried % 3 != 0;
            apart = if inside { next } else { 0.5 * (near + far) };
        }
        let what = "the clamps' distance under the load [cm]";
        let (low, high) = (near, far);
        Err(LabError::NotFound { what, low, high })
    }

    /// The sheet with its clamps at a distance from each other [cm]. Without a load hinged rods lead
    /// its sides, so that it shears alike everywhere.
    fn sheared(
        &self,
        cloth: &Fabric,
        angle: f64,
        apart: f64,
        watch: Watch<'_>,
    ) -> Result<Rest, LabError> {
        let size = [self.width, self.gap];
        let mut problem = strip(cloth, self.along.into(), size, self.pitch)?;
        let way = |part: f64| {
            let slid = apart * libm::tan(angle);
            Vec3::new(slid, apart - self.gap, 0.0) * part
        };
        problem.holds = vec![
            hold(Edge::YMin, false, way(0.0)),
            hold(Edge::YMax, false, way(1.0)),
        ];
        if self.load == 0.0 {
            let cells = (self.gap / self.pitch).round().max(1.0);
            let heights = (1..cells as u32).map(|row| f64::from(row) / cells);
            let points = heights.flat_map(|part| {
                let y = (part - 0.5) * self.gap;
                [-0.5, 0.5].map(|side| Hold {
                    grip: Grip::Point(Vec2::new(side * self.width, y)),
                    clamp: false,
                    carry: way(part),
                })
            });
            problem.holds.extend(points);
        }
        Rest::of(problem, watch)
    }

    /// Force on the middle half of the moving clamp, per width [gf/cm].
    fn middle(&self, rest: &Rest) -> Vec3 {
        let settled = &rest.settled;
        let nodes = rest.edge(Edge::YMax).into_iter();
        let outline = |node: usize| {
            rest.problem
                .piece
                .to_outline(settled.lattice.coordinates[node])
        };
        let inner = nodes.filter(|node| outline(*node).x.abs() < 0.25 * self.width - 1e-6);
        let forces: Vec<Vec3> = inner.map(|node| settled.holding[node]).collect();
        let width = settled.lattice.pitch * forces.len().max(1) as f64;
        forces.into_iter().sum::<Vec3>() / width
    }
}

fn across(yarn: Yarn) -> Yarn {
    match yarn {
        Yarn::Warp => Yarn::Weft,
        Yarn::Weft => Yarn::Warp,
    }
}

impl Frame {
    /// M_SH by (3) and (4) from what is read between 0.5° and 2.5°, as KES reads G; from the first
    /// position where none is there [gf/cm]. Widths and areas count as without load: the clamps'
    /// distance under it is more by the yarns' stretch.
    #[must_use]
    pub fn shear(&self) -> f64 {
        self.slope(|at| at.force)
    }

    /// How far the sheet stands out of its plane where it is read [cm]: one that wrinkles shows less
    /// than its modulus.
    #[must_use]
    pub fn out_of_plane(&self) -> f64 {
        let heights = self
            .read()
            .into_iter()
            .flat_map(|at| &at.rest.settled.positions);
        heights.map(|at| at.z.abs()).fold(0.0, f64::max)
    }

    /// The positions that M_SH is read from.
    fn read(&self) -> Vec<&Sheared> {
        let within = |at: &&Sheared| (READ[0]..READ[1]).contains(&at.angle.to_degrees());
        let read: Vec<&Sheared> = self.positions.iter().filter(within).collect();
        if read.is_empty() {
            self.positions.iter().take(1).collect()
        } else {
            read
        }
    }

    fn slope(&self, of: impl Fn(&Sheared) -> f64) -> f64 {
        let sums = self
            .read()
            .into_iter()
            .fold([0.0, 0.0], |[sum, squares], at| {
                let slope = libm::tan(at.angle);
                [
                    sum + slope * at.stretch * (of(at) - at.of_load),
                    squares + slope * slope,
                ]
            });
        sums[0] / sums[1]
    }

    /// What the instrument shows.
    #[must_use]
    pub fn reading(mut self) -> Reading {
        let points = |of: &dyn Fn(&Sheared) -> f64| {
            let points = self
                .positions
                .iter()
                .map(|at| [at.angle.to_degrees(), of(at)]);
            core::iter::once([0.0, 0.0]).chain(points).collect()
        };
        let lines = vec![
            ("force along the clamps", points(&|at| at.force)),
            (
                "without the load's part",
                points(&|at| at.force - at.of_load),
            ),
        ];
        let (shear, whole) = (self.shear(), self.slope(|at| at.whole_force));
        let certified = self.positions.iter().all(|at| at.rest.settled.converged);
        let last = self.positions.pop();
        Reading {
            instrument: "shear",
            histogram: Vec::new(),
            figures: figures([
                ("shear_gf_per_cm", shear),
                ("load_gf", self.load),
                ("out_of_plane_cm", self.out_of_plane()),
                ("whole_clamp_shear_gf_per_cm", whole),
                (
                    "angle_deg",
                    last.as_ref().map_or(0.0, |at| at.angle.to_degrees()),
                ),
                ("force_gf_per_cm", last.as_ref().map_or(0.0, |at| at.force)),
                (
                    "force_of_load_gf_per_cm",
                    last.as_ref().map_or(0.0, |at| at.of_load),
                ),
            ]),
            trace: Some(Trace {
                x: "angle [deg]",
                y: "force [gf/cm]",
                lines,
            }),
            certified,
            rest: last.map(|at| at.rest),
        }
    }
}
