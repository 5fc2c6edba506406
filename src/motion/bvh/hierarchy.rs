//! The first half of a BVH: joints within joints, kept as a list with a stack of open braces.

use super::{
    BvhError, BvhJoint, Channel, Lines, MOST_JOINTS,
    error::{number, short},
};
use std::collections::BTreeSet;

/// Joints as far as they are read, and the braces that are open.
#[derive(Default)]
pub(super) struct Hierarchy<'t> {
    joints: Vec<BvhJoint>,
    names: BTreeSet<&'t str>,
    open: Vec<Open>,
    /// What the next brace opens.
    awaits: Option<Braces>,
    line: usize,
}

/// An open brace.
struct Open {
    of: Braces,
    line: usize,
}

#[derive(Clone, Copy)]
enum Braces {
    Joint(usize),
    End(usize),
}

impl<'t> Hierarchy<'t> {
    /// The joints up to the line MOTION.
    pub(super) fn read(lines: &mut Lines<'t>) -> Result<Vec<BvhJoint>, BvhError> {
        let mut hierarchy = Self::default();
        for (line, text) in lines {
            hierarchy.line = line;
            if text == "MOTION" {
                return hierarchy.finish();
            }
            // A brace may share its line with what it belongs to.
            for part in text.split_inclusive(['{', '}']) {
                let words = part.trim_end_matches(['{', '}']).trim();
                if !words.is_empty() {
                    hierarchy.statement(words)?;
                }
                if part.ends_with('{') {
                    hierarchy.opens()?;
                } else if part.ends_with('}') {
                    hierarchy.closes()?;
                }
            }
        }
        hierarchy.check_closed()?;
        Err(BvhError::CutOff { missing: "MOTION" })
    }

    fn finish(self) -> Result<Vec<BvhJoint>, BvhError> {
        self.check_closed()?;
        if self.joints.is_empty() {
            return Err(self.roots(0));
        }
        Ok(self.joints)
    }

    fn check_closed(&self) -> Result<(), BvhError> {
        let open = self.open.last();
        match open
            .map(|open| (open.of, open.line))
            .or(self.awaits.map(|of| (of, self.line)))
        {
            None => Ok(()),
            Some((of, opened)) => Err(BvhError::Unclosed {
                line: self.line,
                joint: self.name(of),
                opened,
            }),
        }
    }

    fn opens(&mut self) -> Result<(), BvhError> {
        let line = self.line;
        let of = self.awaits.take().ok_or_else(|| {
            BvhError::expected(line, "a brace after ROOT, JOINT or End Site alone", "{")
        })?;
        self.open.push(Open { of, line });
        Ok(())
    }

    fn closes(&mut self) -> Result<(), BvhError> {
        let none = BvhError::expected(self.line, "a brace that closes an open one", "}");
        if self.awaits.is_some() {
            return Err(none);
        }
        self.open.pop().map(drop).ok_or(none)
    }

    fn statement(&mut self, words: &'t str) -> Result<(), BvhError> {
        let (head, rest) = words
            .split_once(|c: char| c.is_whitespace())
            .map_or((words, ""), |(head, rest)| (head, rest.trim()));
        if self.awaits.is_some() {
            return Err(BvhError::expected(self.line, "{", words));
        }
        let within = self.open.last().map(|open| open.of);
        match (head, within) {
            ("ROOT", None) if self.joints.is_empty() => self.joint(rest, None),
            ("ROOT", None) => Err(self.roots(2)),
            ("JOINT", None) if self.joints.is_empty() => Err(self.roots(0)),
            ("JOINT", Some(Braces::Joint(parent))) => self.joint(rest, Some(parent)),
            ("End", Some(Braces::Joint(joint))) => {
                self.awaits = Some(Braces::End(joint));
                Ok(())
            }
            ("OFFSET", Some(of)) => self.offset(rest, of),
            ("CHANNELS", Some(Braces::Joint(joint))) => self.channels(rest, joint),
            (_, None) => Err(BvhError::expected(self.line, "ROOT or MOTION", words)),
            (_, Some(Braces::End(_))) => Err(BvhError::expected(self.line, "OFFSET or }", words)),
            (_, Some(Braces::Joint(_))) => Err(BvhError::expected(
                self.line,
                "OFFSET, CHANNELS, JOINT, End Site or }",
                words,
            )),
        }
    }

    fn joint(&mut self, name: &'t str, parent: Option<usize>) -> Result<(), BvhError> {
        let line = self.line;
        if name.is_empty() {
            return Err(BvhError::expected(line, "a name after ROOT or JOINT", ""));
        }
        if self.joints.len() == MOST_JOINTS {
            let most = MOST_JOINTS;
            return Err(BvhError::TooManyJoints { line, most });
        }
        if !self.names.insert(name) {
            let name = short(name);
            return Err(BvhError::Twice { line, name });
        }
        self.awaits = Some(Braces::Joint(self.joints.len()));
        self.joints.push(BvhJoint {
            name: name.to_owned(),
            parent,
            offset: [0.0; 3],
            channels: Vec::new(),
            ends: Vec::new(),
        });
        Ok(())
    }

    fn offset(&mut self, rest: &str, of: Braces) -> Result<(), BvhError> {
        let numbers: Option<Vec<f64>> = rest.split_whitespace().map(number).collect();
        let offset = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
        let Some(offset) = offset else {
            return Err(BvhError::Offset {
                line: self.line,
                joint: self.name(of),
                found: short(rest),
            });
        };
        match of {
            Braces::Joint(joint) => self.change(joint, |joint| joint.offset = offset),
            Braces::End(joint) => self.change(joint, |joint| joint.ends.push(offset)),
        }
        Ok(())
    }

    fn channels(&mut self, rest: &str, joint: usize) -> Result<(), BvhError> {
        let mut words = rest.split_whitespace();
        let announced = words.next().unwrap_or("");
        let found = words.clone().count();
        if announced.parse() != Ok(found) {
            return Err(BvhError::ChannelCount {
                line: self.line,
                joint: self.name(Braces::Joint(joint)),
                announced: short(announced),
                found,
            });
        }
        let mut channels: Vec<Channel> = Vec::new();
        for word in words {
            let known = channel(word).filter(|channel| !channels.contains(channel));
            let Some(channel) = known else {
                return Err(BvhError::Channel {
                    line: self.line,
                    joint: self.name(Braces::Joint(joint)),
                    channel: short(word),
                });
            };
            channels.push(channel);
        }
        self.change(joint, |joint| joint.channels = channels);
        Ok(())
    }

    fn change(&mut self, joint: usize, change: impl FnOnce(&mut BvhJoint)) {
        if let Some(joint) = self.joints.get_mut(joint) {
            change(joint);
        }
    }

    fn name(&self, of: Braces) -> String {
        let (Braces::Joint(joint) | Braces::End(joint)) = of;
        let joint = self.joints.get(joint);
        let name = joint.map_or(String::new(), |joint| short(&joint.name));
        match of {
            Braces::Joint(_) => name,
            Braces::End(_) => format!("End Site of {name}"),
        }
    }

    fn roots(&self, found: usize) -> BvhError {
        let line = self.line;
        BvhError::Roots { line, found }
    }
}

fn channel(word: &str) -> Option<Channel> {
    let known = |(index, axis): (usize, &str)| {
        let rest = word
            .strip_prefix(axis)
            .or(word.strip_prefix(&axis.to_lowercase()))?;
        match rest.to_ascii_lowercase().as_str() {
            "position" => Some(Channel::Position(index)),
            "rotation" => Some(Channel::Rotation(index)),
            _ => None,
        }
    };
    ["X", "Y", "Z"].into_iter().enumerate().find_map(known)
}
