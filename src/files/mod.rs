//! Reading and writing of files, each whole or not at all; formats of Python and MATLAB, and of pictures.

mod array;
#[cfg(feature = "figures")]
pub(crate) mod gif;
pub mod mat;
pub mod npy;
#[cfg(feature = "npz")]
pub mod npz;
#[cfg(feature = "figures")]
pub(crate) mod png;
mod read;
mod staging;

pub use array::Array;
pub use read::{open, read, read_json, read_limited, read_text, refuse_large, refuse_many_values, with_given};
pub use staging::{Staging, abandon};

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::Path;

/// Writes one file atomically: it is renamed to its place when it is complete. A device, such as
/// a terminal, is written to.
pub fn write_whole(path: &Path, contents: &[u8]) -> io::Result<()> {
    if path.exists() && !path.is_file() && !path.is_dir() {
        return OpenOptions::new().write(true).open(path)?.write_all(contents);
    }
    if path.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = path.file_name().and_then(|name| name.to_str()).ok_or(io::ErrorKind::InvalidFilename)?;
    let mut staging = Staging::create(folder)?;
    staging.write(name, contents)?;
    staging.publish(&[]).map_err(|(_, error)| error)
}
