//! Three people to test on: the girths of `bodies/*.toml`.

use super::{Girths, Lengths, Measurements};

pub(crate) fn woman() -> Measurements {
    Measurements {
        name: "Woman, JIS 9AR".into(),
        source: "JIS L 4005, AIST".into(),
        stature: 158.0,
        sitting_height: 85.8,
        shoulder_width: 36.0,
        hip_width: 32.0,
        lengths: Lengths::default(),
        girths: Girths {
            neck: 32.0,
            bust: 83.0,
            under_bust: 72.0,
            waist: 64.0,
            hip: 91.0,
            thigh: 53.0,
            knee: 34.0,
            calf: 34.0,
            ankle: 20.5,
            upper_arm: 26.0,
            elbow: 23.0,
            wrist: 15.5,
        },
        head: true,
    }
}

pub(crate) fn man() -> Measurements {
    Measurements {
        name: "Man, JIS 92A5".into(),
        source: "JIS L 4004, AIST".into(),
        stature: 170.0,
        sitting_height: 91.7,
        shoulder_width: 39.8,
        hip_width: 32.5,
        lengths: Lengths::default(),
        girths: Girths {
            neck: 37.0,
            bust: 92.0,
            under_bust: 87.0,
            waist: 80.0,
            hip: 93.0,
            thigh: 53.0,
            knee: 36.0,
            calf: 36.0,
            ankle: 22.0,
            upper_arm: 28.0,
            elbow: 25.0,
            wrist: 16.5,
        },
        head: true,
    }
}

pub(crate) fn child() -> Measurements {
    Measurements {
        name: "Child of six or seven, JIS 120".into(),
        source: "JIS L 4002, school health survey".into(),
        stature: 120.0,
        sitting_height: 66.5,
        shoulder_width: 26.5,
        hip_width: 21.0,
        lengths: Lengths::default(),
        girths: Girths {
            neck: 26.0,
            bust: 60.0,
            under_bust: 57.5,
            waist: 53.0,
            hip: 63.0,
            thigh: 36.0,
            knee: 26.0,
            calf: 25.0,
            ankle: 17.0,
            upper_arm: 18.5,
            elbow: 17.5,
            wrist: 12.5,
        },
        head: true,
    }
}

pub(crate) fn everyone() -> [Measurements; 3] {
    [woman(), man(), child()]
}
