//! What may be wrong with a BVH text.

use super::Channel;
use std::fmt;

/// A text that is no BVH. Lines, frames and values are counted from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BvhError {
    /// Another word than the one that must stand there.
    #[error("line {line}: found {found:?}; allowed: {allowed}")]
    Expected {
        /// The line.
        line: usize,
        /// What must stand there.
        allowed: &'static str,
        /// What stands there.
        found: String,
    },
    /// The text ends early.
    #[error("the file ends before {missing:?}: it may be cut off")]
    CutOff {
        /// What should have come.
        missing: &'static str,
    },
    /// A hierarchy without a root, or with two.
    #[error("line {line}: the hierarchy has {found} roots; allowed: 1")]
    Roots {
        /// Where that is known.
        line: usize,
        /// How many were found.
        found: usize,
    },
    /// A joint's brace that is not closed.
    #[error("line {line}: the brace of {joint:?}, opened in line {opened}, is not closed")]
    Unclosed {
        /// Where that is known.
        line: usize,
        /// The joint.
        joint: String,
        /// The line of its brace.
        opened: usize,
    },
    /// A joint of a name that there was.
    #[error("line {line}: joint {name:?} is there twice")]
    Twice {
        /// The line.
        line: usize,
        /// The name.
        name: String,
    },
    /// More joints than are read.
    #[error("line {line}: more than {most} joints")]
    TooManyJoints {
        /// The line.
        line: usize,
        /// How many are read.
        most: usize,
    },
    /// A word that is no channel.
    #[error(
        "line {line}: unknown channel {channel:?} of joint {joint:?}; allowed: Xposition, \
         Yposition, Zposition, Xrotation, Yrotation, Zrotation, each once"
    )]
    Channel {
        /// The line.
        line: usize,
        /// The joint.
        joint: String,
        /// The word.
        channel: String,
    },
    /// Another number of channels than is announced.
    #[error("line {line}: {announced} channels announced for joint {joint:?}, {found} found")]
    ChannelCount {
        /// The line.
        line: usize,
        /// The joint.
        joint: String,
        /// As written.
        announced: String,
        /// How many names follow.
        found: usize,
    },
    /// An offset that is not three numbers.
    #[error("line {line}: offset of {joint:?} is {found:?}; allowed: 3 numbers")]
    Offset {
        /// The line.
        line: usize,
        /// The joint.
        joint: String,
        /// As written.
        found: String,
    },
    /// A number of frames that is not allowed.
    #[error("line {line}: {found} frames; allowed: {allowed}")]
    Frames {
        /// The line.
        line: usize,
        /// As written.
        found: String,
        /// What may stand there.
        allowed: String,
    },
    /// A time from frame to frame that is not allowed.
    #[error("line {line}: frame time is {found:?}; allowed: {shortest} to {longest} s")]
    FrameTime {
        /// The line.
        line: usize,
        /// As written.
        found: String,
        /// The shortest that is allowed [s].
        shortest: f64,
        /// The longest that is allowed [s].
        longest: f64,
    },
    /// A frame with another number of values than there are channels.
    #[error("line {line}: frame {frame} has {found} values; allowed: {channels}, one each channel")]
    Values {
        /// The line.
        line: usize,
        /// The frame.
        frame: usize,
        /// Its values.
        found: usize,
        /// The channels.
        channels: usize,
    },
    /// A value that is not a finite number.
    #[error(
        "line {line}, value {place}: {channel} of joint {joint:?} is {value:?}; \
         allowed: a finite number"
    )]
    Value {
        /// The line.
        line: usize,
        /// Which value of the line.
        place: usize,
        /// The joint that it is for.
        joint: String,
        /// The channel that it is for.
        channel: String,
        /// As written.
        value: String,
    },
    /// Fewer frames than are announced.
    #[error("{announced} frames announced, {found} found: the file may be cut off")]
    TooFewFrames {
        /// How many there are.
        found: usize,
        /// How many there should be.
        announced: usize,
    },
    /// A line after the last frame.
    #[error("line {line}: more than the {announced} frames announced")]
    TooManyFrames {
        /// The first line too many.
        line: usize,
        /// How many there should be.
        announced: usize,
    },
}

impl BvhError {
    pub(super) fn expected(line: usize, allowed: &'static str, found: &str) -> Self {
        let found = short(found);
        Self::Expected {
            line,
            allowed,
            found,
        }
    }

    /// The line that it shows, where it shows one.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        match self {
            Self::CutOff { .. } | Self::TooFewFrames { .. } => None,
            Self::Expected { line, .. }
            | Self::Roots { line, .. }
            | Self::Unclosed { line, .. }
            | Self::Twice { line, .. }
            | Self::TooManyJoints { line, .. }
            | Self::Channel { line, .. }
            | Self::ChannelCount { line, .. }
            | Self::Offset { line, .. }
            | Self::Frames { line, .. }
            | Self::FrameTime { line, .. }
            | Self::Values { line, .. }
            | Self::Value { line, .. }
            | Self::TooManyFrames { line, .. } => Some(*line),
        }
    }
}

impl fmt::Display for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (axis, kind) = match self {
            Self::Position(axis) => (axis, "position"),
            Self::Rotation(axis) => (axis, "rotation"),
        };
        let axis = ["X", "Y", "Z"].get(*axis).unwrap_or(&"?");
        write!(f, "{axis}{kind}")
    }
}

/// A finite number.
pub(super) fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|value: &f64| value.is_finite())
}

/// A word of the file, not too long for a message.
pub(super) fn short(word: &str) -> String {
    const LONGEST: usize = 40;
    if word.chars().count() <= LONGEST {
        word.to_owned()
    } else {
        word.chars().take(LONGEST).chain(['…']).collect()
    }
}
