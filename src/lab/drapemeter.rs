//! The drapemeter (Cusick 1965; ISO 9073-9): a disc of cloth on a smaller disc, its rim hanging.
//! The drape coefficient is the part of the overhanging ring's area that its shadow covers.
//!
//! One cloth drapes in many ways: the number of folds varies from one laying to the next, and the
//! coefficient with it. A laboratory reports the mean of several; so does this, over seeds.

use super::{
    Folds, LabError, Reading, Rest, Shadow, Trace, Watch,
    reading::{figures, within},
    specimen::{TOUCHING, cloth},
};
use crate::{
    body::{Bodies, Part, Shape},
    fabric::{Fabric, Yarn},
    lattice::Outline,
    math::{Pose, Vec3},
    solver::Problem,
    threads,
};
use std::{f64::consts::PI, sync::Mutex};

/// A crest that stands out by less of the ring's width is no fold.
const LEAST_FOLD: f64 = 0.05;
/// Cloth with a bending length above this part of the ring's width hangs in few, wide folds.
const FEW_FOLDS: f64 = 0.25;
/// Height of the supporting disc [cm].
const SUPPORT: f64 = 1.0;

/// A disc of cloth, and the disc that it rests on by contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drapemeter {
    /// Radius of the specimen [cm].
    pub radius: f64,
    /// Radius of the supporting disc [cm].
    pub support: f64,
    /// Pitch of the lattice [cm].
    pub pitch: f64,
    /// How often it is laid anew: seeds 1, 2, …
    pub seeds: u32,
}

impl Default for Drapemeter {
    /// Cusick's: 30 cm on 18 cm, ten times.
    fn default() -> Self {
        Self {
            radius: 15.0,
            support: 9.0,
            pitch: 0.5,
            seeds: 10,
        }
    }
}

/// One laying.
#[derive(Clone, Debug)]
pub struct Laying {
    /// The drape coefficient [%].
    pub coefficient: f64,
    /// Its folds.
    pub folds: Folds,
    /// Mean height of the rim below the supporting disc's top [cm].
    pub hem: f64,
    /// The shadow.
    pub shadow: Shadow,
    /// The cloth.
    pub rest: Rest,
}

/// All layings.
#[derive(Clone, Debug)]
pub struct Drapes {
    /// One after the other.
    pub layings: Vec<Laying>,
}

impl Drapemeter {
    /// Cusick's, at a pitch that a fabric's bends need: half its lesser bending length, but 0.25 to
    /// 0.5 cm, and to 0.4 cm of a cloth that bends over so much of the hanging ring that each of its
    /// few folds counts.
    #[must_use]
    pub fn of(fabric: &Fabric) -> Self {
        let [warp, weft] = [Yarn::Warp, Yarn::Weft].map(|yarn| fabric.bending_length(yarn));
        let (length, usual) = (warp.min(weft), Self::default());
        let few_folds = length > FEW_FOLDS * (usual.radius - usual.support);
        let coarsest = if few_folds { 0.4 } else { 0.5 };
        Self {
            pitch: (0.5 * length).clamp(0.25, coarsest),
            ..usual
        }
    }

    /// Lays the cloth once for each seed.
    ///
    /// # Errors
    /// [`LabError`] where the specimen cannot be cut or does not reach beyond its support.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Drapes, LabError> {
        let watch = Mutex::new(watch);
        let layings = threads::map_long(self.seeds.max(1) as usize, |place| {
            self.lay(fabric, place as u64 + 1, &mut |progress| {
                watch.lock().is_ok_and(|mut watch| watch(progress))
            })
        });
        Ok(Drapes {
            layings: layings.into_iter().collect::<Result<_, _>>()?,
        })
    }

    /// Lays the cloth once.
    ///
    /// # Errors
    /// [`LabError`], as [`run`](Self::run).
    pub fn lay(&self, fabric: &Fabric, seed: u64, watch: Watch<'_>) -> Result<Laying, LabError> {
        let rest = Rest::within(self.problem(fabric, seed)?, TOUCHING, watch)?;
        let shadow = Shadow::of(&rest.settled.lattice, &rest.settled.positions);
        let disc = PI * self.support * self.support;
        let whole = PI * self.radius * self.radius;
        Ok(Laying {
            coefficient: 100.0 * (shadow.area() - disc) / (whole - disc),
            folds: shadow.folds(LEAST_FOLD * (self.radius - self.support)),
            hem: self.hem(&rest),
            shadow,
            rest,
        })
    }

    fn problem(&self, fabric: &Fabric, seed: u64) -> Result<Problem, LabError> {
        let radius = within("radius [cm]", self.radius, 1.0, 100.0)?;
        let support = within("support [cm]", self.support, 0.1, 0.95 * radius)?;
        let pitch = within("pitch [cm]", self.pitch, radius / 200.0, 0.5 * radius)?;
        let disc = Shape::Cylinder {
            radius: support,
            height: SUPPORT,
        };
        let down = Pose::translation(0.0, 0.0, -0.5 * SUPPORT);
        Ok(Problem {
            bodies: Bodies::new(vec![Part::new("disc".into(), &disc, down)?]),
            seed,
            ..cloth(fabric, Outline::disc(radius)?, pitch, Vec3::z())
        })
    }

    /// Mean height of the outermost nodes below the support [cm].
    fn hem(&self, rest: &Rest) -> f64 {
        let settled = &rest.settled;
        let nodes = settled.lattice.coordinates.iter().zip(&settled.positions);
        let rim = nodes.filter(|(cloth, _)| cloth.norm() > self.radius - 1e-6);
        let (count, sum) = rim.fold((0, 0.0), |(count, sum), (_, at)| (count + 1, sum - at.z));
        sum / f64::from(count.max(1))
    }
}

impl Laying {
    /// The greatest strain along either yarn [%].
    #[must_use]
    pub fn greatest_strain(&self) -> f64 {
        let shape = &self.rest.settled.shape;
        100.0 * shape.strain_warp_max.max(shape.strain_weft_max)
    }
}

impl Drapes {
    /// Mean and standard deviation of a number over the layings.
    #[must_use]
    pub fn spread(&self, of: impl Fn(&Laying) -> f64) -> [f64; 2] {
        let count = self.layings.len().max(1) as f64;
        let mean = self.layings.iter().map(&of).sum::<f64>() / count;
        let squares = self
            .layings
            .iter()
            .map(|laying| (of(laying) - mean).powi(2));
        let others = (count - 1.0).max(1.0);
        [mean, (squares.sum::<f64>() / others).sqrt()]
    }

    /// How many layings have how many folds: (folds, layings), fewest folds first.
    #[must_use]
    pub fn histogram(&self) -> Vec<[usize; 2]> {
        let mut counts: Vec<usize> = self
            .layings
            .iter()
            .map(|laying| laying.folds.count)
            .collect();
        counts.sort_unstable();
        let runs = counts.chunk_by(|a, b| a == b);
        runs.map(|run| [run[0], run.len()]).collect()
    }

    /// What the instrument shows; the picture is of the first laying.
    #[must_use]
    pub fn reading(self) -> Reading {
        let [coefficient, coefficient_spread] = self.spread(|laying| laying.coefficient);
        let [folds, folds_spread] = self.spread(|laying| laying.folds.count as f64);
        let [depth, _] = self.spread(|laying| laying.folds.depth);
        let [hem, _] = self.spread(|laying| laying.hem);
        let [strain, _] = self.spread(Laying::greatest_strain);
        let degrees = |(k, radius): (usize, &f64)| [k as f64 * 0.1, *radius];
        let outline = |laying: &Laying| {
            let radii = laying.shadow.radii.iter().enumerate().step_by(10);
            ("rim", radii.map(degrees).collect())
        };
        Reading {
            instrument: "drapemeter",
            histogram: self.histogram(),
            figures: figures([
                ("drape_coefficient_percent", coefficient),
                ("drape_coefficient_spread_percent", coefficient_spread),
                ("folds", folds),
                ("folds_spread", folds_spread),
                ("fold_depth_cm", depth),
                ("hem_below_disc_cm", hem),
                ("greatest_strain_percent", strain),
                ("layings", self.layings.len() as f64),
            ]),
            trace: Some(Trace {
                x: "direction [deg]",
                y: "reach [cm]",
                lines: self.layings.iter().map(outline).collect(),
            }),
            certified: self
                .layings
                .iter()
                .all(|laying| laying.rest.settled.converged),
            rest: self.layings.into_iter().next().map(|laying| laying.rest),
        }
    }
}
