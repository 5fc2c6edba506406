//! The files as they are written: one type per table, units in the key names.
//!
//! These types say only what may be written. What it means, and which values are allowed, is in
//! `build`, `fabric` and `body`. Comments here are what an editor shows, by way of
//! [`schema`](super::schema).

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{
    Deserialize, Deserializer,
    de::{Error, MapAccess, SeqAccess, Visitor, value::MapAccessDeserializer},
};
use std::{borrow::Cow, fmt, marker::PhantomData, ops::Deref, path::PathBuf};

/// A list of exactly N numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbers<const N: usize>(pub(super) [f64; N]);

impl<'de, const N: usize> Deserialize<'de> for Numbers<N> {
    fn deserialize<D: Deserializer<'de>>(list: D) -> Result<Self, D::Error> {
        list.deserialize_seq(NumbersVisitor)
    }
}

// The count is checked within the visit, where toml still knows the place of the list.
struct NumbersVisitor<const N: usize>;

impl<'de, const N: usize> Visitor<'de> for NumbersVisitor<N> {
    type Value = Numbers<N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of {N} numbers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
        let mut list = Vec::new();
        while let Some(number) = items.next_element()? {
            list.push(number);
        }
        let count = list.len();
        let numbers = list.try_into();
        numbers
            .map(Numbers)
            .map_err(|_| A::Error::invalid_length(count, &self))
    }
}

impl<const N: usize> JsonSchema for Numbers<N> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Numbers{N}").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "array", "items": { "type": "number" }, "minItems": N, "maxItems": N
        })
    }
}

/// A table with keys. serde would also take a list of the values in their order, which no one who
/// reads the file can tell apart.
#[derive(Debug, Default)]
pub(super) struct Table<T>(T);

impl<T: JsonSchema> JsonSchema for Table<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

impl<T> Deref for Table<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Table<T> {
    fn deserialize<D: Deserializer<'de>>(table: D) -> Result<Self, D::Error> {
        table.deserialize_map(TableVisitor(PhantomData))
    }
}

struct TableVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for TableVisitor<T> {
    type Value = Table<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table")
    }

    fn visit_map<A: MapAccess<'de>>(self, keys: A) -> Result<Self::Value, A::Error> {
        T::deserialize(MapAccessDeserializer::new(keys)).map(Table)
    }
}

/// A cloth, what it hangs on, and how it starts.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneFile {
    /// What it shows; the file's name where absent.
    pub(super) title: Option<String>,
    /// Chooses the tiny perturbation from which folds begin; 0 where absent.
    #[serde(default)]
    pub(super) seed: u64,
    pub(super) cloth: Table<ClothTable>,
    /// What is held in space.
    #[serde(default)]
    pub(super) hold: Vec<Table<HoldTable>>,
    /// What the cloth may rest on.
    #[serde(default)]
    pub(super) body: Vec<Table<BodyTable>>,
    #[serde(default)]
    pub(super) contact: Table<ContactTable>,
    #[serde(default)]
    pub(super) solve: Table<SolveTable>,
    /// What `soen animate` makes of the motions of robots.
    pub(super) animation: Option<Table<AnimationTable>>,
}

/// The piece of cloth: exactly one of size_cm, disc_radius_cm, outline_cm.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ClothTable {
    /// A name in fabrics/, one of a, b, c, d, washi, or a path to a .toml.
    pub(super) fabric: String,
    /// A rectangle: warp × weft [cm].
    pub(super) size_cm: Option<Numbers<2>>,
    /// A disc [cm].
    pub(super) disc_radius_cm: Option<f64>,
    /// A polygon: its corners [cm].
    pub(super) outline_cm: Option<Vec<Numbers<2>>>,
    /// Holes of the polygon: the corners of each [cm].
    pub(super) holes_cm: Option<Vec<Vec<Numbers<2>>>>,
    /// Distance between nodes [cm].
    pub(super) spacing_cm: f64,
    /// Warp direction against the outline's x axis [degrees]; 45 is a bias cut.
    #[serde(default)]
    pub(super) grain_deg: f64,
    /// Where the centre of the flat cloth starts [cm]; the origin where absent.
    pub(super) centre_cm: Option<Numbers<3>>,
    /// The outline's x axis in space; x where absent.
    pub(super) x_axis: Option<Numbers<3>>,
    /// The outline's y axis in space, at a right angle to x_axis; y where absent.
    pub(super) y_axis: Option<Numbers<3>>,
}

/// Held points: exactly one of point_cm, edge.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct HoldTable {
    /// The node nearest to this place on the flat outline, from its centre [cm].
    pub(super) point_cm: Option<Numbers<2>>,
    /// A whole edge of the outline.
    pub(super) edge: Option<EdgeWord>,
    /// Holds the slope too, as in a vice.
    #[serde(default)]
    pub(super) clamp: bool,
    /// Where it is carried before the rest is found [cm].
    pub(super) move_cm: Option<Numbers<3>>,
}

#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum EdgeWord {
    XMin,
    XMax,
    YMin,
    YMax,
}

/// A solid thing: exactly one of ball, capsule, cuboid, cylinder, cone, convex_hull, mesh, robot, file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyTable {
    /// What messages call it.
    pub(super) name: Option<String>,
    pub(super) ball: Option<Table<BallTable>>,
    pub(super) capsule: Option<Table<CapsuleTable>>,
    pub(super) cuboid: Option<Table<CuboidTable>>,
    pub(super) cylinder: Option<Table<RoundTable>>,
    pub(super) cone: Option<Table<RoundTable>>,
    pub(super) convex_hull: Option<Table<HullTable>>,
    pub(super) mesh: Option<Table<MeshTable>>,
    pub(super) robot: Option<Table<RobotTable>>,
    /// A body file, whose parts stand in this body's frame.
    pub(super) file: Option<PathBuf>,
    /// Where its own origin is [cm]; the origin where absent.
    pub(super) at_cm: Option<Numbers<3>>,
    /// Turns about x, then y, then z [degrees], before it is moved to at_cm.
    pub(super) rotate_deg: Option<Numbers<3>>,
}

/// A ball about the origin.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct BallTable {
    pub(super) radius_cm: f64,
}

/// All points within a radius of a segment along z, centred.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CapsuleTable {
    pub(super) radius_cm: f64,
    /// Length of the segment, caps not counted [cm].
    pub(super) length_cm: f64,
}

/// A box, centred.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CuboidTable {
    /// Edge lengths along x, y, z [cm].
    pub(super) size_cm: Numbers<3>,
}

/// A cylinder or a cone along z, centred; a cone's tip is up.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RoundTable {
    /// Radius, of a cone's foot [cm].
    pub(super) radius_cm: f64,
    pub(super) height_cm: f64,
}

/// The convex hull of points: exactly one of points_cm, file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct HullTable {
    pub(super) points_cm: Option<Vec<Numbers<3>>>,
    /// A mesh file whose corners are taken.
    pub(super) file: Option<PathBuf>,
    pub(super) unit: Option<UnitWord>,
    /// Length of the file's 1, in its unit; 1 where absent.
    pub(super) scale: Option<f64>,
    #[serde(default)]
    pub(super) up: UpWord,
}

/// A triangle mesh from a file: OBJ, STL, PLY, GLB or glTF.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshTable {
    pub(super) file: PathBuf,
    pub(super) unit: UnitWord,
    /// Length of the file's 1, in its unit; 1 where absent.
    pub(super) scale: Option<f64>,
    #[serde(default)]
    pub(super) up: UpWord,
}

/// A person as bones and balls, who may move.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RobotTable {
    /// A name in bodies/, one of woman-158, man-170, child-120, or a path to a .toml.
    pub(super) person: String,
    /// How they stand when the cloth is laid on: a name in bodies/poses/ or a path to a .toml;
    /// upright with the arms down where absent.
    pub(super) pose: Option<String>,
    /// What they do then: a name in bodies/motions/, one of walk, run, jump, or a path to a .toml or
    /// a .bvh.
    pub(super) motion: Option<String>,
}

/// The moments of a motion that are wanted.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct AnimationTable {
    /// How many.
    pub(super) frames: u32,
    /// How many in a second; 24 where absent.
    pub(super) frames_per_s: Option<f64>,
    /// Whether the cloth has inertia; where absent it has none, and is at rest in every frame.
    #[serde(default)]
    pub(super) dynamics: bool,
    /// Steps of time from a frame to the next, with dynamics; 8 where absent.
    pub(super) steps_per_frame: Option<u32>,
    /// Rate at which motion through still air dies down, with dynamics; that of air on this cloth
    /// at 1 m/s where absent.
    pub(super) damping_per_s: Option<f64>,
}

/// The file's unit of length.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum UnitWord {
    M,
    Cm,
    Mm,
    In,
}

/// The file's axis that points up; "y" turns (x, y, z) into (x, −z, y) first.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum UpWord {
    Y,
    #[default]
    Z,
}

/// How cloth and bodies touch; the fabric's values where absent.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ContactTable {
    /// Coulomb friction against the bodies.
    pub(super) friction: Option<f64>,
    pub(super) thickness_cm: Option<f64>,
}

/// When to stop, and what acts.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SolveTable {
    /// Residual at which a node counts as at rest; 1e-3 where absent.
    pub(super) tolerance: Option<f64>,
    /// 600 where absent.
    pub(super) max_seconds: Option<f64>,
    #[serde(default)]
    pub(super) forces: ForcesWord,
    /// Laws that act beside weight; all three where absent. Twist goes with bending.
    pub(super) laws: Option<Vec<LawWord>>,
}

/// "lattice": minus the gradient of the whole energy; "paper": figures 7–9 to the letter.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum ForcesWord {
    #[default]
    Lattice,
    Paper,
}

#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(super) enum LawWord {
    Tension,
    Bending,
    Shear,
}

/// A body file: parts in one frame.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyFile {
    /// What it is.
    #[serde(default, rename = "name")]
    pub(super) _name: Option<String>,
    /// Where its sizes are from.
    #[serde(default, rename = "source")]
    pub(super) _source: Option<String>,
    pub(super) part: Vec<Table<BodyTable>>,
}

/// A measured cloth.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FabricFile {
    pub(super) name: String,
    /// Who measured it, and where that is written.
    pub(super) source: String,
    pub(super) weight_gf_per_cm2: f64,
    pub(super) thickness_cm: f64,
    pub(super) friction: Table<FrictionTable>,
    /// Twisting moment per width and twist [gf·cm]; 0 where absent, which is the paper's model.
    pub(super) twist_gf_cm: Option<f64>,
    pub(super) warp: Table<DirectionTable>,
    pub(super) weft: Table<DirectionTable>,
}

/// Friction coefficients, used where a scene gives none.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FrictionTable {
    pub(super) body: f64,
    pub(super) cloth: f64,
}

/// What was measured along one thread direction.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct DirectionTable {
    pub(super) tension: Table<TensionTable>,
    /// Bending moment per width and curvature [gf·cm].
    pub(super) bending_gf_cm: f64,
    /// Shear force per width and radian [gf/cm].
    pub(super) shear_gf_per_cm: f64,
}

/// Tension per width: a_gf_per_cm and b, or linear_gf_per_cm, or points.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TensionTable {
    /// A of M_T = A·S^B.
    pub(super) a_gf_per_cm: Option<f64>,
    /// B of M_T = A·S^B.
    pub(super) b: Option<f64>,
    pub(super) linear_gf_per_cm: Option<f64>,
    /// Measured points: strain and gf/cm.
    pub(super) points: Option<Vec<Numbers<2>>>,
}
