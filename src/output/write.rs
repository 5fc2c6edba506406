//! Files are replaced whole or not at all.

use std::{
    ffi::OsString,
    fs::{self, File},
    io::{self, Write},
    path::{Path, PathBuf},
};

/// A file that could not be written; what stood at its place before still stands.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct WriteError {
    /// Where the file should have stood.
    pub path: PathBuf,
    /// What the system said.
    pub source: io::Error,
}

/// Writes a file, and the folders above it where they are absent.
///
/// The bytes go to a sibling first, which takes the file's name only when all of them are stored.
///
/// # Errors
/// [`WriteError`] where a folder or the sibling cannot be made or filled, or cannot take the name.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let failed = |source| WriteError {
        path: path.to_owned(),
        source,
    };
    let sibling = sibling(path).ok_or_else(|| failed(io::ErrorKind::InvalidFilename.into()))?;
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(failed)?;
    }
    fill(&sibling, bytes)
        .and_then(|()| fs::rename(&sibling, path))
        .map_err(|source| {
            // The sibling may not exist; the first fault is the one worth telling.
            let _ = fs::remove_file(&sibling);
            failed(source)
        })
}

/// A hidden name beside the file, of this process alone; `None` for a path that ends in no name.
fn sibling(path: &Path) -> Option<PathBuf> {
    let mut name = OsString::from(".");
    name.push(path.file_name()?);
    name.push(format!(".{}.part", std::process::id()));
    Some(path.with_file_name(name))
}

fn fill(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_nothing_else_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/drape.obj");
        write(&path, b"first").unwrap();
        write(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }

    #[test]
    fn a_failure_leaves_what_stood() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::create_dir(&path).unwrap();
        fs::write(path.join("kept"), b"kept").unwrap();
        let error = write(&path, b"new").unwrap_err();
        assert!(error.to_string().contains("taken"), "{error}");
        assert_eq!(fs::read(path.join("kept")).unwrap(), b"kept");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_cannot_stand_below_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, b"kept").unwrap();
        assert!(write(&file.join("drape.obj"), b"new").is_err());
        assert!(write(Path::new("/"), b"new").is_err());
        assert_eq!(fs::read(&file).unwrap(), b"kept");
    }
}
