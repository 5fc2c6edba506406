//! The bones of a woman of 158 cm, by hand from `anthropometry.md` (sections 1, 2, 4 and 5).

use soen::{
    math::{Rotation, Vec3},
    skeleton::{Bone, Joint, Posture, Skeleton},
};

/// A joint's angle names, axes in the standing frame, and limits [degrees].
struct Turns {
    names: [&'static str; 3],
    axes: [[f64; 3]; 3],
    limits: [[f64; 2]; 3],
}

const FIXED: [[f64; 2]; 3] = [[0.0; 2]; 3];
const SPINE: Turns = Turns {
    names: ["flexion", "side", "rotation"],
    axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    limits: [[-15.0, 45.0], [-20.0, 20.0], [-30.0, 30.0]],
};

/// From head to foot; lengths [cm].
pub(crate) fn woman() -> Skeleton {
    let mut bones = vec![
        bone("pelvis", None, [0.0, 0.0, 13.0], "root", &SPINE),
        bone("lumbar", Some(0), [0.0, 0.0, 14.0], "waist", &SPINE),
        bone("thorax", Some(1), [0.0, 0.0, 26.0], "chest", &SPINE),
        bone("neck", Some(2), [0.0, 0.0, 7.0], "neck", &SPINE),
        bone("head", Some(3), [0.0, 0.0, 16.8], "head", &SPINE),
    ];
    bones[0].joint.limits = FIXED;
    for (side, sign) in [("right", -1.0), ("left", 1.0)] {
        let limb = Limb { side, sign };
        limb.arm(&mut bones);
        limb.leg(&mut bones);
    }
    Skeleton::new(Vec3::new(0.0, 0.0, 81.2), bones).unwrap()
}

/// One side: `sign` is that of x.
struct Limb {
    side: &'static str,
    sign: f64,
}

impl Limb {
    /// Flexion lifts a hanging bone to the front, abduction away from the body; the third turns its
    /// front inwards.
    fn turns(&self, names: [&'static str; 3], limits: [[f64; 2]; 3]) -> Turns {
        let sign = self.sign;
        let axes = [[-1.0, 0.0, 0.0], [0.0, -sign, 0.0], [0.0, 0.0, -sign]];
        Turns {
            names,
            axes,
            limits,
        }
    }

    fn add(
        &self,
        bones: &mut Vec<Bone>,
        name: &str,
        parent: usize,
        vector: [f64; 3],
        joint: &str,
        turns: &Turns,
    ) -> usize {
        let name = format!("{}_{name}", self.side);
        let joint = format!("{}_{joint}", self.side);
        let vector = [vector[0] * self.sign, vector[1], vector[2]];
        bones.push(bone(&name, Some(parent), vector, &joint, turns));
        bones.len() - 1
    }

    fn arm(&self, bones: &mut Vec<Bone>) {
        let sign = self.sign;
        let girdle = Turns {
            names: ["protraction", "elevation", "rotation"],
            axes: [[0.0, 0.0, -sign], [0.0, -sign, 0.0], [sign, 0.0, 0.0]],
            limits: [[-15.0, 15.0], [-10.0, 40.0], [-30.0, 30.0]],
        };
        let shoulder = self.turns(
            ["flexion", "abduction", "rotation"],
            [[-60.0, 180.0], [-50.0, 180.0], [-90.0, 70.0]],
        );
        let elbow = self.turns(
            ["flexion", "carrying", "pronation"],
            [[0.0, 150.0], [-10.0, 15.0], [-80.0, 80.0]],
        );
        // The palm faces the thigh: the hand flexes towards the body, the thumb is ahead.
        let wrist = Turns {
            names: ["flexion", "deviation", "rotation"],
            axes: [[0.0, sign, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -sign]],
            limits: [[-70.0, 80.0], [-30.0, 20.0], [0.0, 0.0]],
        };
        let clavicle = self.add(
            bones,
            "clavicle",
            2,
            [16.5, 0.0, -10.0],
            "clavicle",
            &girdle,
        );
        let upper = self.add(
            bones,
            "upper_arm",
            clavicle,
            [0.0, 0.0, -28.1],
            "shoulder",
            &shoulder,
        );
        let fore = self.add(bones, "forearm", upper, [0.0, 0.0, -22.3], "elbow", &elbow);
        self.add(bones, "hand", fore, [0.0, 0.0, -16.7], "wrist", &wrist);
    }

    fn leg(&self, bones: &mut Vec<Bone>) {
        let fixed = self.turns(["flexion", "side", "rotation"], FIXED);
        let hip = self.turns(
            ["flexion", "abduction", "rotation"],
            [[-30.0, 120.0], [-30.0, 45.0], [-45.0, 45.0]],
        );
        let mut knee = self.turns(
            ["flexion", "side", "rotation"],
            [[0.0, 135.0], [-5.0, 5.0], [-10.0, 10.0]],
        );
        knee.axes[0][0] = 1.0;
        let ankle = self.turns(
            ["flexion", "eversion", "rotation"],
            [[-50.0, 20.0], [-35.0, 20.0], [-20.0, 20.0]],
        );
        let hip_bone = self.add(bones, "hip_bone", 0, [8.3, 0.0, 0.0], "hip_bone", &fixed);
        bones[hip_bone].at_base = true;
        let thigh = self.add(bones, "thigh", hip_bone, [0.0, 0.0, -37.5], "hip", &hip);
        let shank = self.add(bones, "shank", thigh, [0.0, 0.0, -37.5], "knee", &knee);
        self.add(bones, "foot", shank, [0.0, -17.5, -5.2], "ankle", &ankle);
    }
}

fn bone(name: &str, parent: Option<usize>, vector: [f64; 3], joint: &str, turns: &Turns) -> Bone {
    Bone {
        name: name.into(),
        parent,
        at_base: false,
        vector: vector.into(),
        joint: Joint {
            name: joint.into(),
            angles: turns.names,
            axes: turns.axes.map(Vec3::from),
            limits: turns.limits.map(|pair| pair.map(f64::to_radians)),
        },
    }
}

/// Where a bone starts and ends in a posture, turn after turn from the root on [cm].
pub(crate) fn reach(skeleton: &Skeleton, posture: &Posture, bone: &str) -> [Vec3; 2] {
    let mut index = skeleton.bone(bone).unwrap();
    let [mut start, mut end] = [Vec3::zeros(), skeleton.bones()[index].vector];
    loop {
        let bone = &skeleton.bones()[index];
        let turn = match bone.parent {
            Some(_) => posture.joints[index],
            None => Rotation::identity(),
        };
        [start, end] = [turn * start, turn * end];
        let Some(parent) = bone.parent else { break };
        if !bone.at_base {
            let way = skeleton.bones()[parent].vector;
            [start, end] = [start + way, end + way];
        }
        index = parent;
    }
    [start, end].map(|point| posture.root.rotation * point + posture.root.translation.vector)
}
