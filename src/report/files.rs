//! The folder of the results.

use super::origin::{Sealed, Settings};
use crate::error::{Error, Result};
use crate::files::{self, Staging};
use serde::Serialize;
use std::io;
use std::path::{Path, PathBuf};

/// Writes a whole file, or returns the reason why that fails.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<()> {
    files::write_whole(path, contents).map_err(|error| failed(path, "cannot write", &error))
}

/// Returns bad input where the path is wrong; a failure where the disk is full or the like.
fn failed(path: &Path, what: &str, error: &io::Error) -> Error {
    use io::ErrorKind::*;
    let problem = format!("{what}: {}", reason(error));
    let is_misplaced = matches!(
        error.kind(),
        PermissionDenied
            | NotFound
            | NotADirectory
            | IsADirectory
            | AlreadyExists
            | ReadOnlyFilesystem
            | InvalidFilename
            | InvalidInput
    );
    if is_misplaced { Error::file(path, problem) } else { Error::unwritten(path, problem) }
}

fn reason(error: &io::Error) -> String {
    use io::ErrorKind::*;
    let elsewhere = "choose another place with -o";
    match error.kind() {
        PermissionDenied => format!("no permission; {elsewhere}"),
        NotFound => format!("the folder that it would be in does not exist; {elsewhere}"),
        NotADirectory => format!("a part of this path is a file; {elsewhere}"),
        IsADirectory => format!("this is a directory; {elsewhere}"),
        AlreadyExists => format!("it is a file; {elsewhere}"),
        ReadOnlyFilesystem => format!("the disk is read-only; {elsewhere}"),
        StorageFull | QuotaExceeded => format!("the disk is full; make room, or {elsewhere}"),
        FileTooLarge => format!("files must not become so large here; raise the limit, or {elsewhere}"),
        _ => error.to_string(),
    }
}

/// A folder of the results of one command, which appear all together: [`finish`](Self::finish) moves them into place.
/// Without it none appears, and earlier results stay complete until then. [`Staging`] describes how.
pub struct Folder {
    path: PathBuf,
    written: Vec<String>,
    /// Number of the files that belong to a result.
    sealed: usize,
    notes: Vec<String>,
    obsolete: Vec<String>,
    staging: Option<Staging>,
}

impl Folder {
    /// Makes the folder and tests that it can be written to, before anything is computed.
    pub fn create(path: &Path) -> Result<Folder> {
        std::fs::create_dir_all(path).map_err(|error| failed(path, "cannot make this folder", &error))?;
        Staging::create(path).map_err(|error| failed(path, "cannot write here", &error))?;
        let path = path.to_path_buf();
        Ok(Folder { path, written: Vec::new(), sealed: 0, notes: Vec::new(), obsolete: Vec::new(), staging: None })
    }

    /// Returns the path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a file that appears after [`finish`](Self::finish). The presence of the last one shows that all are
    /// complete.
    pub fn write(&mut self, name: &str, contents: &[u8]) -> Result<()> {
        let unwritten = |error: io::Error| failed(&self.path.join(name), "nothing was written", &error);
        let staging = match &mut self.staging {
            Some(staging) => staging,
            none => none.insert(Staging::create(&self.path).map_err(unwritten)?),
        };
        staging.write(name, contents).map_err(unwritten)?;
        if !self.written.iter().any(|known| known == name) {
            self.written.push(name.to_string());
        }
        Ok(())
    }

    /// Writes a result as indented JSON, with the names of the files that were written since the last one and belong
    /// to it. Those that an earlier result of this name has beyond them go.
    pub fn seal<T: Serialize>(&mut self, name: &str, result: T) -> Result<Sealed<T>> {
        let own = self.written[self.sealed..].iter().cloned();
        let sealed = Sealed { result, files: own.chain([name.to_string()]).collect() };
        let text = serde_json::to_string_pretty(&sealed).map_err(|error| Error::file(self.path.join(name), error))?;
        let text = format!("{text}\n").into_bytes();
        self.write(name, &text)?;
        self.sealed = self.written.len();
        if let Some((earlier, new)) = Settings::read(&self.path.join(name)).zip(Settings::parse(&text)) {
            self.notes.extend(earlier.replaced_by(&new));
            self.obsolete.extend(earlier.files);
        }
        Ok(sealed)
    }

    /// Moves all files into place.
    ///
    /// # Errors
    /// A file cannot be moved. Then the last file is missing, which shows that the results are incomplete.
    pub fn finish(self) -> Result<Written> {
        let Folder { path, written, staging, notes, mut obsolete, .. } = self;
        obsolete.retain(|name| !written.contains(name) && is_plain(name) && path.join(name).is_file());
        staging
            .map_or(Ok(()), |staging| staging.publish(&obsolete))
            .map_err(|(name, error)| failed(&path.join(name), "not all results are in place", &error))?;
        Ok(Written { folder: path, names: written, notes, removed: obsolete })
    }
}

/// True for the name of a file without a path.
fn is_plain(name: &str) -> bool {
    Path::new(name).file_name().is_some_and(|plain| plain == name)
}

/// The files in place.
pub struct Written {
    folder: PathBuf,
    names: Vec<String>,
    notes: Vec<String>,
    removed: Vec<String>,
}

impl Written {
    /// Returns their paths.
    pub fn paths(&self) -> Vec<String> {
        self.names.iter().map(|name| self.folder.join(name).display().to_string()).collect()
    }

    /// Returns what became of earlier results that were not the same; none where there were none.
    pub fn note(&self) -> Option<String> {
        let (folder, removed) = (self.folder.display(), self.removed.join(", "));
        let gone = if removed.is_empty() { String::new() } else { format!("removed {removed} of an earlier run") };
        match (self.notes.first(), removed.is_empty()) {
            (None, true) => None,
            (None, false) => Some(format!("note: in {folder}: {gone}")),
            (Some(first), _) => {
                let more =
                    if self.notes.len() > 1 { format!(" and {} more", self.notes.len() - 1) } else { String::new() };
                let gone = if gone.is_empty() { gone } else { format!("; {gone}") };
                Some(format!("note: replaced in {folder} {first}{more}{gone}; -o DIR keeps both"))
            }
        }
    }

    /// Returns the folder with the names of the files.
    pub fn listing(&self) -> String {
        format!("{}: {}", self.folder.display(), self.names.join(", "))
    }
}
