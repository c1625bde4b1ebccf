//! The folder that results go to.

use crate::error::{Error, Result};
use crate::files;
use std::path::{Path, PathBuf};

/// Writes a file whole, or says why it cannot be.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<()> {
    if path.is_dir() {
        return Err(Error::file(path, "cannot write: this is a directory"));
    }
    files::write_whole(path, contents).map_err(|error| Error::file(path, format!("cannot write: {}", reason(&error))))
}

fn reason(error: &std::io::Error) -> String {
    use std::io::ErrorKind::*;
    match error.kind() {
        PermissionDenied => "no permission; choose another place with -o".to_string(),
        NotFound => "the folder that it would be in does not exist; choose another place with -o".to_string(),
        NotADirectory => "a part of this path is a file; choose another place with -o".to_string(),
        AlreadyExists => "it is a file; choose another place with -o".to_string(),
        ReadOnlyFilesystem => "the disk is read-only; choose another place with -o".to_string(),
        StorageFull => "the disk is full".to_string(),
        _ => error.to_string(),
    }
}

/// A folder that results go to.
pub struct Folder {
    path: PathBuf,
    written: Vec<PathBuf>,
}

impl Folder {
    /// Makes the folder and tries that it can be written to, before anything is computed.
    pub fn create(path: &Path) -> Result<Folder> {
        std::fs::create_dir_all(path)
            .map_err(|error| Error::file(path, format!("cannot make this folder: {}", reason(&error))))?;
        let probe = path.join(format!(".probe.{}", std::process::id()));
        std::fs::File::create(&probe)
            .and_then(|_| std::fs::remove_file(&probe))
            .map_err(|error| Error::file(path, format!("cannot write here: {}", reason(&error))))?;
        Ok(Folder { path: path.to_path_buf(), written: Vec::new() })
    }

    /// The path of a file that is about to be written here.
    pub fn file(&mut self, name: &str) -> PathBuf {
        let path = self.path.join(name);
        self.written.push(path.clone());
        path
    }

    pub fn write(&mut self, name: &str, contents: &[u8]) -> Result<()> {
        write_whole(&self.file(name), contents)
    }

    /// Writes a value as indented JSON.
    pub fn write_json(&mut self, name: &str, value: &impl serde::Serialize) -> Result<()> {
        let text = serde_json::to_string_pretty(value).map_err(|error| Error::file(self.path.join(name), error))?;
        self.write(name, format!("{text}\n").as_bytes())
    }

    /// The paths of all files that were written.
    pub fn paths(&self) -> Vec<String> {
        self.written.iter().map(|path| path.display().to_string()).collect()
    }

    /// What was written, for a person.
    pub fn listing(&self) -> String {
        let names: Vec<String> =
            self.written.iter().filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned())).collect();
        format!("{}: {}", self.path.display(), names.join(", "))
    }
}
