//! A measurement sheet as it is written: one type per table, units in the key names.

use crate::scene::format::{FrictionTable, Table};
use serde::Deserialize;
use std::path::PathBuf;

/// A cloth as a laboratory measured it: `[warp]` and `[weft]`, or `[kes]`, or `[fast]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SheetFile {
    pub(super) name: String,
    /// Who measured it, when, with what.
    pub(super) source: String,
    pub(super) weight_gf_per_cm2: Option<f64>,
    pub(super) weight_g_per_m2: Option<f64>,
    pub(super) weight_mg_per_cm2: Option<f64>,
    pub(super) thickness_cm: Option<f64>,
    pub(super) thickness_mm: Option<f64>,
    pub(super) friction: Option<Table<FrictionTable>>,
    pub(super) warp: Option<Table<StripTable>>,
    pub(super) weft: Option<Table<StripTable>>,
    pub(super) kes: Option<Table<KesTable>>,
    pub(super) fast: Option<Table<FastTable>>,
}

/// Along one thread direction, the paper's tests.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StripTable {
    pub(super) tension: Table<CurveTable>,
    pub(super) bending: Table<OverhangTable>,
    pub(super) shear: Table<RecordTable>,
}

/// An S–S curve.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CurveTable {
    pub(super) csv: PathBuf,
    /// Length between the jaws, for a column of elongations.
    pub(super) gauge_cm: Option<f64>,
    /// Width of the strip, for a column of forces.
    pub(super) width_cm: Option<f64>,
    pub(super) up_to_strain_percent: Option<f64>,
    #[serde(default)]
    pub(super) slack_percent: f64,
}

/// Overhangs of strips.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OverhangTable {
    #[serde(default)]
    pub(super) overhang_face_cm: Vec<f64>,
    #[serde(default)]
    pub(super) overhang_back_cm: Vec<f64>,
    /// 41.5 where absent.
    pub(super) angle_deg: Option<f64>,
    /// The paper's at 41.5 degrees, else the exact one, where absent.
    pub(super) relation: Option<RelationWord>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum RelationWord {
    Paper,
    Peirce,
    Exact,
}

/// A shear record: force against displacement or angle.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RecordTable {
    pub(super) csv: PathBuf,
    /// W of (4).
    pub(super) load_gf: f64,
    /// A of (3), between the clamps; for a column of displacements.
    pub(super) gap_cm: Option<f64>,
    /// L of (3), along the clamps.
    pub(super) width_cm: f64,
    /// 0.5 where absent.
    pub(super) from_deg: Option<f64>,
    /// 5 where absent.
    pub(super) to_deg: Option<f64>,
}

/// A KES-F sheet.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KesTable {
    pub(super) warp: Option<Table<KesDirectionTable>>,
    pub(super) weft: Option<Table<KesDirectionTable>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KesDirectionTable {
    pub(super) lt: Option<f64>,
    pub(super) wt_gf_cm_per_cm2: Option<f64>,
    pub(super) rt_percent: Option<f64>,
    pub(super) emt_percent: f64,
    pub(super) g_gf_per_cm_deg: f64,
    #[serde(rename = "2hg_gf_per_cm")]
    pub(super) hg_gf_per_cm: Option<f64>,
    #[serde(rename = "2hg5_gf_per_cm")]
    pub(super) hg5_gf_per_cm: Option<f64>,
    pub(super) b_gf_cm2_per_cm: f64,
    #[serde(rename = "2hb_gf_cm_per_cm")]
    pub(super) hb_gf_cm_per_cm: Option<f64>,
    pub(super) miu: Option<f64>,
}

/// A FAST sheet; its thickness T2 is the sheet's thickness.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FastTable {
    pub(super) eb5_percent: f64,
    pub(super) warp: Option<Table<FastDirectionTable>>,
    pub(super) weft: Option<Table<FastDirectionTable>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FastDirectionTable {
    pub(super) e5_percent: f64,
    pub(super) e20_percent: f64,
    pub(super) e100_percent: f64,
    pub(super) bending_length_mm: f64,
    pub(super) bending_rigidity_micronewton_m: Option<f64>,
}
