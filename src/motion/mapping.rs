//! Which joint of a capture moves which bone.

/// The bones that a mapping may name.
pub const BONES: [&str; 21] = [
    "pelvis",
    "lumbar",
    "thorax",
    "neck",
    "head",
    "right_clavicle",
    "left_clavicle",
    "right_upper_arm",
    "left_upper_arm",
    "right_forearm",
    "left_forearm",
    "right_hand",
    "left_hand",
    "right_hip_bone",
    "left_hip_bone",
    "right_thigh",
    "left_thigh",
    "right_shank",
    "left_shank",
    "right_foot",
    "left_foot",
];

/// Name and file text of each mapping that ships: the names of the Carnegie Mellon captures, of
/// `MakeHuman`'s default skeleton and of its older one.
pub const MAPPINGS: [(&str, &str); 3] = [
    ("cmu", include_str!("../../bodies/motions/names/cmu.toml")),
    (
        "makehuman",
        include_str!("../../bodies/motions/names/makehuman.toml"),
    ),
    (
        "makehuman-old",
        include_str!("../../bodies/motions/names/makehuman-old.toml"),
    ),
];

/// The joints of a capture that move one bone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// The joint at the bone's start, which turns it.
    pub joint: String,
    /// The joint at its end; where absent, the one that starts the next bone, or the first one
    /// that hangs on `joint`.
    pub end: Option<String>,
    /// The joint that twists it, where that is not `joint`: a forearm is twisted at the wrist.
    pub twist: Option<String>,
}

/// The joints of one kind of capture, bone by bone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mapping {
    /// What it is called.
    pub name: String,
    /// Names of bones and what moves them; a bone that is absent goes with its parent.
    pub bones: Vec<(String, Source)>,
}

impl Mapping {
    /// What moves a bone.
    #[must_use]
    pub fn source(&self, bone: &str) -> Option<&Source> {
        let mut bones = self.bones.iter();
        bones
            .find(|(name, _)| name == bone)
            .map(|(_, source)| source)
    }

    /// Every joint that is named, with the bone that names it.
    pub fn joints(&self) -> impl Iterator<Item = (&str, &str)> {
        self.bones.iter().flat_map(|(bone, source)| {
            let others = source.end.iter().chain(&source.twist);
            let joints = core::iter::once(&source.joint).chain(others);
            joints.map(move |joint| (bone.as_str(), joint.as_str()))
        })
    }
}
