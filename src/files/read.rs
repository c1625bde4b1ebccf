//! Reads whole files up to a limit of size.

use crate::math::memory::size;
use std::cell::RefCell;
use std::fs::{File, metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Largest size of a file, bytes.
const MOST: u64 = 256_000_000;
/// Largest number of values of a JSON document. serde_json keeps a value in 72 bytes, however short its text is.
const VALUES: usize = 6_000_000;

thread_local! {
    static GIVEN: RefCell<Vec<(PathBuf, String)>> = const { RefCell::new(Vec::new()) };
}

/// Reads these texts in the place of files of their paths, in this thread during `work`: of scenes that are no files.
pub fn with_given<R>(given: Vec<(PathBuf, String)>, work: impl FnOnce() -> R) -> R {
    GIVEN.set(given);
    let result = work();
    GIVEN.take();
    result
}

/// The contents of a regular file of up to 256 MB. Pipes and devices are refused: they need have no end.
///
/// # Errors
/// Errors of the file system, files that are too large, pipes and devices.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let given = GIVEN.with_borrow(|given| given.iter().find(|(known, _)| known == path).map(|(_, text)| text.clone()));
    if let Some(text) = given {
        return Ok(text.into_bytes());
    }
    read_limited(open(path)?)
}

/// A regular file, of any size.
///
/// # Errors
/// Errors of the file system, pipes and devices.
pub fn open(path: &Path) -> io::Result<File> {
    // Checked before opening, which waits for a writer at the other end of a pipe.
    let found = metadata(path)?;
    if found.is_file() {
        File::open(path)
    } else if found.is_dir() {
        Err(io::ErrorKind::IsADirectory.into())
    } else {
        Err(io::Error::other("this is a pipe or a device; name a regular file"))
    }
}

/// Refuses a file that would be too large as a whole.
///
/// # Errors
/// Errors of the file system, and more than 256 MB.
pub fn refuse_large(file: &File) -> io::Result<()> {
    if file.metadata()?.len() > MOST { Err(too_large()) } else { Ok(()) }
}

fn too_large() -> io::Error {
    io::Error::other(format!("this is larger than the {} that are read", size(MOST as f64)))
}

/// The text of a regular file, as [`read`].
///
/// # Errors
/// As [`read`], and text that is not UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    String::from_utf8(read(path)?).map_err(|_| io::Error::other("this is not text in UTF-8"))
}

/// The text of a JSON document, as [`read_text`].
///
/// # Errors
/// As [`read_text`] and [`refuse_many_values`].
pub fn read_json(path: &Path) -> io::Result<String> {
    let text = read_text(path)?;
    refuse_many_values(&text)?;
    Ok(text)
}

/// Refuses a JSON document before it takes more than some 500 MB. Commas inside of texts count as well.
///
/// # Errors
/// More than six million values.
pub fn refuse_many_values(json: &str) -> io::Result<()> {
    let separators = json.bytes().filter(|byte| matches!(byte, b',' | b'[' | b'{')).count();
    if separators <= VALUES {
        return Ok(());
    }
    Err(io::Error::other(format!("this has more than the {} million values that are read", VALUES / 1_000_000)))
}

/// Everything from a source of unknown size: a file that grows, or one that is compressed.
///
/// # Errors
/// Errors of the source, and more than 256 MB.
pub fn read_limited(source: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(MOST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST { Err(too_large()) } else { Ok(bytes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_end_is_refused() {
        assert_eq!(read_limited(&b"ab"[..]).unwrap(), b"ab");
        let error = read_limited(io::repeat(0)).unwrap_err().to_string();
        assert_eq!(error, "this is larger than the 256 MB that are read");
    }

    #[test]
    fn documents_of_too_many_values_are_refused() {
        assert!(refuse_many_values(r#"{"a": [0, 1]}"#).is_ok());
        let error = refuse_many_values(&"[".repeat(VALUES + 1)).unwrap_err().to_string();
        assert_eq!(error, "this has more than the 6 million values that are read");
    }

    #[test]
    #[cfg(unix)]
    fn devices_are_refused() {
        let error = read(Path::new("/dev/zero")).unwrap_err().to_string();
        assert_eq!(error, "this is a pipe or a device; name a regular file");
    }
}
