//! `soen schema`.

use crate::{
    failure::{DONE, Failure},
    say,
};
use std::process::ExitCode;

pub(crate) fn schema() -> Result<ExitCode, Failure> {
    say(&(soen::scene::schema() + "\n"))?;
    Ok(DONE)
}
