//! Says on standard error how far a run is: a line that renews itself on a terminal, otherwise one
//! line per level.

use indicatif::{ProgressBar, ProgressStyle};
use soen::solver::Progress;
use std::{
    io::{self, IsTerminal, Write},
    time::Duration,
};

/// Where progress is shown.
#[derive(Debug)]
pub(crate) struct Teller {
    bar: Option<ProgressBar>,
    level: Option<usize>,
    /// What is being made.
    name: String,
}

impl Teller {
    pub(crate) fn new() -> Self {
        Self::of("")
    }

    /// Of one of several runs, each with a name.
    pub(crate) fn of(name: &str) -> Self {
        let bar = io::stderr().is_terminal().then(|| {
            let style = ProgressStyle::with_template("{spinner} {elapsed} {msg}");
            let bar = ProgressBar::new_spinner();
            bar.enable_steady_tick(Duration::from_millis(200));
            match style {
                Ok(style) => bar.with_style(style),
                Err(_) => bar,
            }
        });
        let name = if name.is_empty() {
            String::new()
        } else {
            format!("{name}: ")
        };
        Self {
            bar,
            level: None,
            name,
        }
    }

    pub(crate) fn tell(&mut self, progress: &Progress) {
        let (level, levels) = progress.level;
        let is_new = self.level.replace(level) != Some(level);
        let text = || {
            format!(
                "{}level {} of {levels}, {} nodes, sweep {}, residual {:.1e}",
                self.name,
                level + 1,
                progress.nodes,
                progress.sweeps,
                progress.residual,
            )
        };
        match &self.bar {
            Some(bar) => bar.set_message(text()),
            None if is_new => {
                let line = format!(
                    "{}level {} of {levels}, {} nodes",
                    self.name,
                    level + 1,
                    progress.nodes
                );
                // Progress is a courtesy: a closed standard error does not stop the run.
                let _ = writeln!(io::stderr(), "{line}");
            }
            None => {}
        }
    }

    pub(crate) fn end(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
