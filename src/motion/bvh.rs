//! BVH: a text of joints, their offsets and channels, then one line of numbers for each frame.
//!
//! M. Meredith and S. Maddock, *Motion Capture File Formats Explained*, Sheffield CS-01-11. Read in
//! one pass, without recursion: a file takes time and memory in proportion to its length.

mod error;
mod hierarchy;

pub use error::BvhError;

use error::number;
use hierarchy::Hierarchy;

/// What moves a joint in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// A place along an axis of the parent: 0, 1, 2 for x, y, z [the file's unit].
    Position(usize),
    /// A turn about an axis: 0, 1, 2 for x, y, z [degrees]; turns act in the order of channels.
    Rotation(usize),
}

/// A joint of the actor.
#[derive(Clone, Debug, PartialEq)]
pub struct BvhJoint {
    /// What it is called.
    pub name: String,
    /// The joint it hangs on, an earlier one of the list; none for the first.
    pub parent: Option<usize>,
    /// From the parent, unturned [the file's unit].
    pub offset: [f64; 3],
    /// What moves it, in the order of the values.
    pub channels: Vec<Channel>,
    /// Where it ends without a further joint: its End Sites, from the joint [the file's unit].
    pub ends: Vec<[f64; 3]>,
}

/// Motion capture as its file has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Bvh {
    /// The joints, parents before children.
    pub joints: Vec<BvhJoint>,
    /// From frame to frame [s].
    pub frame_time: f64,
    /// The channels of all joints, in their order: one list for each frame.
    pub frames: Vec<Vec<f64>>,
}

/// The most joints; a body with hands and face has some 160.
const MOST_JOINTS: usize = 10_000;
/// The most frames: a quarter of an hour at 120 a second.
const MOST_FRAMES: u64 = 100_000;
/// The longest time from frame to frame [s].
const LONGEST_STEP: f64 = 60.0;
const SHORTEST_STEP: f64 = 1e-4;

/// The lines that hold something, with their numbers from 1.
type Lines<'t> = Box<dyn Iterator<Item = (usize, &'t str)> + 't>;

impl Bvh {
    /// Reads a BVH text. At most 100 000 frames and 10 000 joints.
    ///
    /// # Errors
    /// [`BvhError`] names the line that shows that it is none.
    ///
    /// ```
    /// let text = "HIERARCHY\nROOT hips\n{\n OFFSET 0 0 0\n CHANNELS 1 Xrotation\n\
    ///     End Site\n {\n  OFFSET 0 10 0\n }\n}\nMOTION\nFrames: 2\nFrame Time: 0.04\n0\n90\n";
    /// let bvh = soen::motion::Bvh::parse(text)?;
    /// assert_eq!(bvh.joints[0].ends, [[0.0, 10.0, 0.0]]);
    /// assert_eq!(bvh.frames, [[0.0], [90.0]]);
    /// # Ok::<(), soen::motion::BvhError>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, BvhError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let numbered = text.lines().enumerate();
        let trimmed = numbered.map(|(index, line)| (index + 1, line.trim()));
        let mut lines: Lines<'_> = Box::new(trimmed.filter(|(_, line)| !line.is_empty()));
        match lines.next() {
            Some((_, "HIERARCHY")) => (),
            Some((line, found)) => return Err(BvhError::expected(line, "HIERARCHY", found)),
            None => return Err(BvhError::expected(1, "HIERARCHY", "nothing")),
        }
        let joints = Hierarchy::read(&mut lines)?;
        let announced = frame_count(&mut lines)?;
        let frame_time = frame_time(&mut lines)?;
        let frames = frames(&mut lines, &joints, announced)?;
        Ok(Self {
            joints,
            frame_time,
            frames,
        })
    }

    /// The joint of a name.
    #[must_use]
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }
}

fn frame_count(lines: &mut Lines<'_>) -> Result<usize, BvhError> {
    let (line, rest) = headed(lines, "Frames:")?;
    let wrong = |reason: &str| BvhError::Frames {
        line,
        found: rest.into(),
        allowed: format!("{reason}1 to {MOST_FRAMES}"),
    };
    let count: u64 = rest.parse().map_err(|_| wrong("a whole number, "))?;
    if (1..=MOST_FRAMES).contains(&count) {
        usize::try_from(count).map_err(|_| wrong(""))
    } else {
        Err(wrong(""))
    }
}

fn frame_time(lines: &mut Lines<'_>) -> Result<f64, BvhError> {
    let (line, rest) = headed(lines, "Frame Time:")?;
    match rest.parse() {
        Ok(time) if (SHORTEST_STEP..=LONGEST_STEP).contains(&time) => Ok(time),
        _ => Err(BvhError::FrameTime {
            line,
            found: rest.into(),
            shortest: SHORTEST_STEP,
            longest: LONGEST_STEP,
        }),
    }
}

/// What stands behind some words, whatever blanks are between them.
fn headed<'t>(lines: &mut Lines<'t>, head: &'static str) -> Result<(usize, &'t str), BvhError> {
    let Some((line, text)) = lines.next() else {
        return Err(BvhError::CutOff { missing: head });
    };
    let mut rest = text;
    for word in head.split(' ') {
        let Some(after) = rest.trim_start().strip_prefix(word) else {
            return Err(BvhError::expected(line, head, text));
        };
        rest = after;
    }
    Ok((line, rest.trim()))
}

fn frames(
    lines: &mut Lines<'_>,
    joints: &[BvhJoint],
    announced: usize,
) -> Result<Vec<Vec<f64>>, BvhError> {
    let channels = joints.iter().map(|joint| joint.channels.len()).sum();
    let mut frames = Vec::new();
    for (line, text) in lines {
        if frames.len() == announced {
            return Err(BvhError::TooManyFrames { line, announced });
        }
        let found = text.split_whitespace().count();
        if found != channels {
            return Err(BvhError::Values {
                line,
                frame: frames.len() + 1,
                found,
                channels,
            });
        }
        let values = text.split_whitespace().enumerate();
        let read =
            |(place, value)| number(value).ok_or_else(|| bad_value(joints, line, place, value));
        frames.push(values.map(read).collect::<Result<_, _>>()?);
    }
    if frames.len() < announced {
        return Err(BvhError::TooFewFrames {
            found: frames.len(),
            announced,
        });
    }
    Ok(frames)
}

/// The error of a value that is no number, with the joint and channel that it is for.
fn bad_value(joints: &[BvhJoint], line: usize, place: usize, value: &str) -> BvhError {
    let all = joints.iter().flat_map(|joint| {
        let channels = joint.channels.iter();
        channels.map(move |channel| (joint.name.clone(), channel.to_string()))
    });
    let (joint, channel) = all.clone().nth(place).unwrap_or_default();
    BvhError::Value {
        line,
        place: place + 1,
        joint,
        channel,
        value: error::short(value),
    }
}

#[cfg(test)]
mod tests;
