//! Why a command ended early, and its exit code.

use soen::{lab::LabError, output::WriteError, scene::SceneError};
use std::{fmt, process::ExitCode};

/// All of the certificate holds, or the command had none to give.
pub(crate) const DONE: ExitCode = ExitCode::SUCCESS;

/// The drape was stopped before it was certified; its files are written and marked.
pub(crate) fn uncertified() -> ExitCode {
    ExitCode::from(3)
}

/// A command that gave nothing.
#[derive(Debug)]
pub(crate) enum Failure {
    /// What was asked for cannot be done: exit code 2.
    Input(String),
    /// The system does not play its part: exit code 1.
    System(String),
}

impl Failure {
    pub(crate) fn code(&self) -> ExitCode {
        match self {
            Self::Input(_) => ExitCode::from(2),
            Self::System(_) => ExitCode::from(1),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Input(message) | Self::System(message)) = self;
        f.write_str(message)
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<LabError> for Failure {
    fn from(error: LabError) -> Self {
        match error {
            LabError::Stopped => Self::System(error.to_string()),
            _ => Self::Input(error.to_string()),
        }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        Self::System(error.to_string())
    }
}
