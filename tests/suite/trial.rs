//! Runs the program in a folder of its own.

use std::{
    fs,
    io::{BufRead, BufReader, Read},
    path::Path,
    process::{Command, Output, Stdio},
};
use tempfile::TempDir;

/// A cloth held at two corners above a ball: nothing is wrong with it.
pub(crate) const SCENE: &str = r#"title = "trial"
seed = 1
[cloth]
fabric = "c"
size_cm = [20.0, 20.0]
spacing_cm = 2.0
grain_deg = 0.0
centre_cm = [0.0, 0.0, 25.0]
x_axis = [1.0, 0.0, 0.0]
y_axis = [0.0, 1.0, 0.0]
[[hold]]
point_cm = [-10.0, 10.0]
[[body]]
ball = { radius_cm = 10.0 }
at_cm = [0.0, 0.0, 5.0]
[contact]
friction = 0.3
thickness_cm = 0.05
[solve]
tolerance = 1e-3
max_seconds = 60.0
"#;

/// A folder with files in it, among them what an earlier run left in `out`.
pub(crate) struct Trial {
    folder: TempDir,
}

/// What a run printed, and its exit code.
pub(crate) struct Said {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Trial {
    pub(crate) fn new() -> Self {
        let trial = Self {
            folder: tempfile::tempdir().unwrap(),
        };
        trial.put("out/drape.obj", b"kept");
        trial.put("out/mine.txt", b"kept");
        trial
    }

    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }

    pub(crate) fn put(&self, name: &str, bytes: &[u8]) {
        let path = self.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }

    pub(crate) fn run(&self, arguments: &[&str]) -> Said {
        let output: Output = Command::new(env!("CARGO_BIN_EXE_soen"))
            .args(arguments)
            .current_dir(self.path())
            .output()
            .unwrap();
        let said = Said {
            code: output.status.code().unwrap_or(-1),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        };
        assert!(!said.err.contains("panicked"), "{}", said.err);
        said
    }

    /// Starts a run, presses Ctrl-C as soon as its first line of progress says that it listens, and
    /// waits for its end.
    #[cfg(unix)]
    pub(crate) fn interrupt(&self, arguments: &[&str]) -> Said {
        let mut run = Command::new(env!("CARGO_BIN_EXE_soen"))
            .args(arguments)
            .current_dir(self.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut said = BufReader::new(run.stderr.take().unwrap());
        let mut err = String::new();
        said.read_line(&mut err).unwrap();
        let kill = Command::new("kill")
            .args(["-INT", &run.id().to_string()])
            .status();
        assert!(kill.unwrap().success());
        said.read_to_string(&mut err).unwrap();
        let output = run.wait_with_output().unwrap();
        Said {
            code: output.status.code().unwrap_or(-1),
            out: String::from_utf8(output.stdout).unwrap(),
            err,
        }
    }

    /// Whether what stood in `out` still stands there.
    pub(crate) fn kept(&self) -> bool {
        let is_kept = |name: &str| fs::read(self.path().join(name)).unwrap() == b"kept";
        is_kept("out/drape.obj") && is_kept("out/mine.txt")
    }
}
