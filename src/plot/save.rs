//! Files that are either whole or not there.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use super::error::PlotError;

/// What a file name asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Svg,
    Png,
}

impl Format {
    /// By the extension, in any case of letters.
    pub fn of(path: &Path) -> Result<Self, PlotError> {
        let extension = path.extension().and_then(|text| text.to_str()).unwrap_or_default().to_ascii_lowercase();
        match extension.as_str() {
            _ if path.is_dir() => Err(PlotError::Directory { path: path.to_path_buf() }),
            "svg" => Ok(Self::Svg),
            "png" => Ok(Self::Png),
            _ => Err(PlotError::Extension { path: path.to_path_buf() }),
        }
    }
}

/// Writes a temporary file beside the path and renames it, so that nobody ever reads half a figure.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), PlotError> {
    let temporary = beside(path);
    let written = write_new(&temporary, bytes).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|source| {
        // Nothing more can be done if this fails too; the first error is the one to report.
        let _ = fs::remove_file(&temporary);
        PlotError::Write { path: path.to_path_buf(), source }
    })
}

fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = fs::File::create_new(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// A name in the same folder that no other figure of this or another process uses.
fn beside(path: &Path) -> PathBuf {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    path.with_file_name(format!(".holonom-{}-{count}.tmp", std::process::id()))
}
