//! What is shown on the cloth in colours: a value per node, with its unit and its scale.

use super::{
    ClothMesh,
    colour::{Rgb, diverging, sequential},
};
use crate::{fabric::Yarn, lattice::Rod, math::Vec3};
use std::str::FromStr;

/// 1 gf/cm² in kPa.
const KPA: f64 = 0.098_066_5;

/// Which quantity a heat map shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Map {
    /// Strain of the warp: mean over the node's warp rods [%].
    StrainWarp,
    /// Strain of the weft: mean over the node's weft rods [%].
    StrainWeft,
    /// Shear: mean size over the node's corners [degrees].
    Shear,
    /// Normal force of the bodies over the node's area [kPa].
    ContactPressure,
    /// Distance to the nearest body [cm].
    Gap,
}

/// A word that names no map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown map {0:?}: one of strain-warp, strain-weft, shear, contact-pressure, gap")]
pub struct UnknownMap(pub String);

impl FromStr for Map {
    type Err = UnknownMap;

    fn from_str(word: &str) -> Result<Self, UnknownMap> {
        Self::ALL
            .into_iter()
            .find(|map| map.key() == word)
            .ok_or_else(|| UnknownMap(word.to_owned()))
    }
}

impl Map {
    /// All maps.
    pub const ALL: [Self; 5] = [
        Self::StrainWarp,
        Self::StrainWeft,
        Self::Shear,
        Self::ContactPressure,
        Self::Gap,
    ];

    /// Its word on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::StrainWarp => "strain-warp",
            Self::StrainWeft => "strain-weft",
            Self::Shear => "shear",
            Self::ContactPressure => "contact-pressure",
            Self::Gap => "gap",
        }
    }

    /// Its name as a column of a file, with the unit; strains are fractions there, as in the report.
    pub fn column(self) -> &'static str {
        match self {
            Self::StrainWarp => "strain_warp",
            Self::StrainWeft => "strain_weft",
            Self::Shear => "shear_deg",
            Self::ContactPressure => "contact_pressure_kpa",
            Self::Gap => "gap_cm",
        }
    }

    /// Its name for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::StrainWarp => "Warp strain",
            Self::StrainWeft => "Weft strain",
            Self::Shear => "Shear",
            Self::ContactPressure => "Contact pressure",
            Self::Gap => "Gap to body",
        }
    }

    /// Its unit for people.
    pub fn unit(self) -> &'static str {
        match self {
            Self::StrainWarp | Self::StrainWeft => "%",
            Self::Shear => "°",
            Self::ContactPressure => "kPa",
            Self::Gap => "cm",
        }
    }

    /// Whether values of both signs have a meaning.
    fn signed(self) -> bool {
        matches!(self, Self::StrainWarp | Self::StrainWeft)
    }
}

/// A value per node.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// What is shown.
    pub map: Map,
    /// Values in the map's unit, one per node; `NaN` where a node has none.
    pub values: Vec<f64>,
}

impl HeatMap {
    /// Takes the values from a shape.
    ///
    /// `contact` is the normal force of the bodies on each node [gf], `gap` each node's distance
    /// from the nearest body [cm]; `None` if the map needs one that is not given.
    pub fn of(
        map: Map,
        cloth: &ClothMesh<'_>,
        contact: Option<&[f64]>,
        gap: Option<&[f64]>,
    ) -> Option<Self> {
        let mut values = match map {
            Map::StrainWarp => strain(cloth, Yarn::Warp),
            Map::StrainWeft => strain(cloth, Yarn::Weft),
            Map::Shear => shear(cloth),
            Map::ContactPressure => {
                let pressure = |(force, area): (&f64, &f64)| KPA * force / area;
                contact?
                    .iter()
                    .zip(&cloth.lattice.area)
                    .map(pressure)
                    .collect()
            }
            Map::Gap => gap?.to_vec(),
        };
        values.resize(cloth.positions.len(), f64::NAN);
        Some(Self { map, values })
    }

    /// The values in the unit of [`Map::column`], as single floats; beyond their range, the end of it.
    pub(super) fn column(&self) -> impl Iterator<Item = f32> {
        let unit = if self.map.signed() { 0.01 } else { 1.0 };
        let limit = f64::from(f32::MAX);
        self.values
            .iter()
            .map(move |x| (unit * x).clamp(-limit, limit) as f32)
    }

    /// The ends of the colours: 0, or the same to both sides of 0, up to a round number that at
    /// most one node in two hundred exceeds, so that a few hot nodes do not dull all others.
    pub(super) fn scale(&self) -> Scale {
        let mut sizes: Vec<f64> = self
            .values
            .iter()
            .map(|x| x.abs())
            .filter(|x| x.is_finite())
            .collect();
        sizes.sort_by(f64::total_cmp);
        let most = sizes.get(sizes.len().saturating_sub(1 + sizes.len() / 200));
        let most = most.copied().filter(|&x| x > 1e-12).unwrap_or(1.0);
        let step = round_step(most / 6.0);
        Scale {
            signed: self.map.signed(),
            step,
            steps: libm::ceil(most / step - 1e-9) as u32,
        }
    }

    /// Least and greatest finite value.
    pub(super) fn extremes(&self) -> Option<(f64, f64)> {
        let finite = self.values.iter().copied().filter(|x| x.is_finite());
        finite
            .map(|x| (x, x))
            .reduce(|(a, b), (x, _)| (a.min(x), b.max(x)))
    }
}

/// How values become colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// Whether the scale reaches as far below 0.
    pub(super) signed: bool,
    /// Between ticks, in the map's unit.
    pub(super) step: f64,
    /// How many steps from 0 to the end.
    pub(super) steps: u32,
}

impl Scale {
    /// The colour of a value; beyond the end, that of the end.
    pub(super) fn colour(&self, value: f64) -> Rgb {
        let t = value / self.end();
        if self.signed {
            diverging(t)
        } else {
            sequential(t)
        }
    }

    /// The value at the end.
    pub(super) fn end(&self) -> f64 {
        self.step * f64::from(self.steps)
    }

    /// The value at the start.
    pub(super) fn start(&self) -> f64 {
        if self.signed { -self.end() } else { 0.0 }
    }
}

/// The least of 1, 2, 5 × 10ⁿ that is not below a size.
fn round_step(size: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(size)));
    let step = [1.0, 2.0, 5.0]
        .map(|k| k * power)
        .into_iter()
        .find(|step| *step >= size * 0.999_999);
    step.unwrap_or(10.0 * power)
}

/// Mean of (L − rest) / rest over each node's rods of a yarn [%]; 0 where it has none.
fn strain(cloth: &ClothMesh<'_>, yarn: Yarn) -> Vec<f64> {
    let strain = |rod: &Rod| {
        let [a, b] = rod.nodes.map(|node| cloth.positions.get(node as usize));
        Some(100.0 * ((b? - a?).norm() - rod.rest) / rod.rest)
    };
    let rods = cloth.lattice.rods.iter().filter(|rod| rod.yarn == yarn);
    let terms = rods.filter_map(|rod| Some((rod.nodes, strain(rod)?)));
    mean(
        cloth.positions.len(),
        terms.flat_map(|(nodes, x)| nodes.map(|node| (node, x))),
    )
}

/// Mean of |rest angle − angle| over each node's corners [degrees]; 0 where it has none.
fn shear(cloth: &ClothMesh<'_>) -> Vec<f64> {
    let terms = cloth.lattice.corners.iter().filter_map(|corner| {
        let [at, warp, weft] = corner.nodes.map(|node| cloth.positions.get(node as usize));
        let (warp, weft): (Vec3, Vec3) = (warp? - at?, weft? - at?);
        let angle = libm::atan2(warp.cross(&weft).norm(), warp.dot(&weft));
        Some((
            corner.nodes[0],
            (corner.rest_angle - angle).abs().to_degrees(),
        ))
    });
    mean(cloth.positions.len(), terms)
}

fn mean(nodes: usize, terms: impl Iterator<Item = (u32, f64)>) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); nodes];
    for (node, value) in terms {
        if let Some((sum, count)) = sums.get_mut(node as usize) {
            *sum += value;
            *count += 1.0;
        }
    }
    sums.into_iter()
        .map(|(sum, count)| sum / f64::max(count, 1.0))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample;

    fn map(map: Map, turn: impl Fn(f64, f64) -> Vec3) -> Vec<f64> {
        let placed = sample::Placed::new([6, 5], 0.5, |c| turn(c.x, c.y));
        let cloth = placed.cloth();
        HeatMap::of(map, &cloth, None, None).unwrap().values
    }

    #[track_caller]
    fn check(values: &[f64], expected: f64) {
        assert_eq!(values.len(), 30);
        assert!(
            values.iter().all(|x| (x - expected).abs() < 1e-9),
            "{values:?}, not {expected}"
        );
    }

    #[test]
    fn a_stretched_cloth_shows_its_strain() {
        let stretched = |x: f64, y: f64| Vec3::new(0.0, 1.02 * x, 0.97 * y);
        check(&map(Map::StrainWarp, stretched), 2.0);
        check(&map(Map::StrainWeft, stretched), -3.0);
        check(&map(Map::Shear, stretched), 0.0);
    }

    #[test]
    fn a_picture_frame_shows_its_angle() {
        let (sin, cos) = (0.5, libm::sqrt(0.75));
        let sheared = |x: f64, y: f64| Vec3::new(x + sin * y, cos * y, 0.0);
        check(&map(Map::Shear, sheared), 30.0);
        check(&map(Map::StrainWeft, sheared), 0.0);
    }

    #[test]
    fn a_cloth_that_lies_flat_presses_with_its_weight() {
        let placed = sample::wave(6, 5, 0.5);
        let cloth = placed.cloth();
        let force: Vec<f64> = placed
            .lattice
            .area
            .iter()
            .map(|area| 0.014 * area)
            .collect();
        let heat = HeatMap::of(Map::ContactPressure, &cloth, Some(&force), None).unwrap();
        // 0.014 gf/cm² = 0.14 kg/m² × 9.80665 m/s².
        check(&heat.values, 0.14 * 9.806_65 / 1000.0);
        assert_eq!(HeatMap::of(Map::ContactPressure, &cloth, None, None), None);
        let gap = HeatMap::of(Map::Gap, &cloth, None, Some(&[1.0, 2.0]))
            .unwrap()
            .values;
        assert_eq!((gap.len(), gap[1]), (30, 2.0));
        assert!(gap[2].is_nan());
    }

    #[test]
    fn words_name_maps() {
        for map in Map::ALL {
            assert_eq!(map.key().parse(), Ok(map));
        }
        let error = "strain".parse::<Map>().unwrap_err().to_string();
        assert!(error.contains("\"strain\"") && Map::ALL.iter().all(|m| error.contains(m.key())));
    }

    #[test]
    fn scales_end_at_round_numbers() {
        let scale = |map, values: &[f64]| {
            HeatMap {
                map,
                values: values.to_vec(),
            }
            .scale()
        };
        let check = |scale: Scale, start: f64, end: f64, step: f64| {
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
            assert!(close(scale.start(), start), "{scale:?}");
            assert!(
                close(scale.end(), end) && close(scale.step, step),
                "{scale:?}"
            );
        };
        check(
            scale(Map::Gap, &[0.0, 7.1, f64::INFINITY, f64::NAN]),
            0.0,
            8.0,
            2.0,
        );
        check(scale(Map::StrainWarp, &[-0.031, 0.02]), -0.04, 0.04, 0.01);
        check(scale(Map::Shear, &[20.0]), 0.0, 20.0, 5.0);
        check(scale(Map::Shear, &[]), 0.0, 1.0, 0.2);
        let mut many = vec![1.0; 1000];
        many[7] = 500.0;
        check(scale(Map::ContactPressure, &many), 0.0, 1.0, 0.2);
    }
}
