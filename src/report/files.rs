//! The folder of the results.

use super::origin::{Origin, ResultSettings, Sealed};
use crate::error::{Error, Result};
use crate::files::{self, Staging};
use crate::plot::Figure;
use serde::Serialize;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writes a whole file, or returns the reason why that fails.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<()> {
    files::write_whole(path, contents).map_err(|error| failed(path, "cannot write", &error))
}

/// Returns bad input where the path is wrong; a failure where the disk is full or the like.
fn failed(path: &Path, what: &str, error: &io::Error) -> Error {
    use io::ErrorKind::*;
    let elsewhere = "choose another place with -o";
    let (reason, is_misplaced) = match error.kind() {
        PermissionDenied => (format!("no permission; {elsewhere}"), true),
        NotFound => (format!("the folder that it would be in does not exist; {elsewhere}"), true),
        NotADirectory => (format!("a part of this path is a file; {elsewhere}"), true),
        IsADirectory => (format!("this is a directory; {elsewhere}"), true),
        AlreadyExists => (format!("it is a file; {elsewhere}"), true),
        ReadOnlyFilesystem => (format!("the disk is read-only; {elsewhere}"), true),
        InvalidFilename | InvalidInput => (error.to_string(), true),
        StorageFull | QuotaExceeded => (format!("the disk is full; make room, or {elsewhere}"), false),
        FileTooLarge => (format!("files must not become so large here; raise the limit, or {elsewhere}"), false),
        _ => (error.to_string(), false),
    };
    let problem = format!("{what}: {reason}");
    if is_misplaced { Error::file(path, problem) } else { Error::unwritten(path, problem) }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Format {
    Svg,
    Png,
    None,
}

/// A folder of the results of one command, which appear all together: [`finish`](Self::finish) moves them into place.
/// Without it none appears, and earlier results stay complete until then. [`Staging`] describes how.
pub struct Folder {
    figures: Format,
    staging: Staging,
    /// Number of the files that belong to a result.
    sealed: usize,
    notes: Vec<String>,
    obsolete: Vec<String>,
}

impl Folder {
    /// Makes the folder, and one to write to, before anything is computed.
    pub fn create(path: &Path) -> Result<Folder> {
        std::fs::create_dir_all(path).map_err(|error| failed(path, "cannot make this folder", &error))?;
        let staging = Staging::create(path).map_err(|error| failed(path, "cannot write here", &error))?;
        Ok(Folder { figures: Format::Svg, staging, sealed: 0, notes: Vec::new(), obsolete: Vec::new() })
    }

    pub fn drawing(self, figures: Format) -> Folder {
        Folder { figures, ..self }
    }

    pub fn path(&self) -> &Path {
        self.staging.target()
    }

    pub fn paths(&self) -> Vec<String> {
        self.staging.names().iter().map(|name| self.path().join(name).display().to_string()).collect()
    }

    /// Writes a file that appears after [`finish`](Self::finish). The presence of the last one shows that all are
    /// complete.
    pub fn write(&mut self, name: &str, contents: &[u8]) -> Result<()> {
        let mut file = self.stream(name)?;
        file.append(contents);
        file.finish()
    }

    pub fn table(&mut self, stem: &str, contents: &[u8]) -> Result<()> {
        self.write(&format!("{stem}.csv"), contents)
    }

    /// Writes a figure in the chosen format, if there is one and any is chosen.
    pub fn figure(&mut self, name: &str, figure: Option<Figure>) -> Result<()> {
        let refused = |reason| Error::input(format!("cannot draw {name}.png: {reason}")).hint("choose --figures svg");
        match (figure, self.drawn(name)) {
            (Some(figure), Some(file)) if self.figures == Format::Svg => self.write(&file, figure.to_svg().as_bytes()),
            (Some(figure), Some(file)) => self.write(&file, &figure.to_png().map_err(refused)?),
            _ => Ok(()),
        }
    }

    /// Returns the file of a figure; none where no format is chosen.
    pub(super) fn drawn(&self, name: &str) -> Option<String> {
        match self.figures {
            Format::Svg => Some(format!("{name}.svg")),
            Format::Png => Some(format!("{name}.png")),
            Format::None => None,
        }
    }

    /// Makes a file that is written while it is computed, and appears after [`finish`](Self::finish).
    pub fn stream(&mut self, name: &str) -> Result<Stream> {
        let path = self.path().join(name);
        let file = self.staging.open(name).map_err(|error| failed(&path, UNWRITTEN, &error))?;
        Ok(Stream { path, file: BufWriter::new(file), error: None })
    }

    /// Writes a result as indented JSON, with the names of the files that were written since the last one and belong
    /// to it. Those that an earlier result of this name has beyond them go.
    pub fn seal<T: Serialize>(
        &mut self,
        name: &str,
        origin: impl Into<Option<Origin>>,
        result: T,
    ) -> Result<Sealed<T>> {
        let own = self.staging.names()[self.sealed..].iter().cloned();
        let sealed = Sealed { origin: origin.into(), result, files: own.chain([name.to_string()]).collect() };
        let mut file = self.stream(name)?;
        serde_json::to_writer_pretty(&mut file, &sealed).map_err(|error| Error::file(self.path().join(name), error))?;
        file.append(b"\n");
        file.finish()?;
        self.sealed = self.staging.names().len();
        let written = ResultSettings::read(&self.staging.path(name));
        // Of other results nobody knows by which command they came.
        let earlier = ResultSettings::read(&self.path().join(name)).filter(|earlier| !earlier.command.is_empty());
        if let Some((earlier, new)) = earlier.zip(written) {
            self.notes.extend(earlier.replaced_by(&new));
            self.obsolete.extend(earlier.files.into_iter().filter(|file| belongs(name, file)));
        }
        Ok(sealed)
    }

    /// Moves all files into place.
    ///
    /// # Errors
    /// A file cannot be moved. Then the last file is missing, which shows that the results are incomplete.
    pub fn finish(self) -> Result<Written> {
        let Folder { staging, notes, mut obsolete, .. } = self;
        let folder = staging.target().to_path_buf();
        let names = staging.names().to_vec();
        obsolete.retain(|name| !names.contains(name) && folder.join(name).is_file());
        staging
            .publish(&obsolete)
            .map_err(|(name, error)| failed(&folder.join(name), "not all results are in place", &error))?;
        Ok(Written { folder, names, notes, removed: obsolete })
    }
}

const UNWRITTEN: &str = "nothing was written";

/// A file of a [`Folder`] that is written as its contents come. The first error is kept until the end.
pub struct Stream {
    path: PathBuf,
    file: BufWriter<File>,
    error: Option<io::Error>,
}

impl Stream {
    /// Appends to the file, unless an error came before.
    pub fn append(&mut self, contents: &[u8]) {
        if self.error.is_none() {
            self.error = self.file.write_all(contents).err();
        }
    }

    pub fn has_failed(&self) -> bool {
        self.error.is_some()
    }

    pub fn finish(mut self) -> Result<()> {
        let written = match self.error.take() {
            Some(error) => Err(error),
            None => self.file.flush().and_then(|()| self.file.get_ref().sync_all()),
        };
        written.map_err(|error| failed(&self.path, UNWRITTEN, &error))
    }
}

/// Errors are kept for [`Stream::finish`].
impl Write for Stream {
    fn write(&mut self, contents: &[u8]) -> io::Result<usize> {
        self.append(contents);
        Ok(contents.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Endings of the files of results.
const ENDINGS: [&str; 10] = ["csv", "json", "svg", "png", "gif", "npz", "mat", "md", "html", "glb"];
/// Results whose files have other names than theirs.
const FAMILIES: [(&str, &[&str]); 2] =
    [("summary", &["trajectory", "drift", "energy", "outputs", "view"]), ("simplify", &["simplified"])];

/// True if a command that writes the result `seal` may write `name`: a result that somebody else has written, or
/// changed, must not make it remove other files.
fn belongs(seal: &str, name: &str) -> bool {
    let Some((stem, ending)) = name.rsplit_once('.') else { return false };
    let whole = seal.trim_end_matches(".json");
    let family = FAMILIES.iter().find(|(seal, _)| *seal == whole).map_or(&[][..], |(_, names)| names);
    let continues = |rest: &str| rest.is_empty() || rest.starts_with(['-', '_']);
    let is_own = stem.strip_prefix(whole).is_some_and(continues) || family.contains(&stem);
    is_own && ENDINGS.contains(&ending) && !name.contains(['/', '\\'])
}

pub struct Written {
    folder: PathBuf,
    names: Vec<String>,
    notes: Vec<String>,
    removed: Vec<String>,
}

impl Written {
    /// Returns what became of earlier results that were not the same; none where there were none.
    pub fn note(&self) -> Option<String> {
        let folder = self.folder.display();
        let removed = self.removed.join(", ");
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

    pub fn listing(&self) -> String {
        format!("{}: {}", self.folder.display(), self.names.join(", "))
    }
}
