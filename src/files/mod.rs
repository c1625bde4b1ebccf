//! Files appear whole or not at all; the formats of Python and MATLAB.

mod array;
pub mod mat;
pub mod npy;
pub mod npz;

pub use array::Array;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// Writes a new file beside the target and renames it, so that nobody ever reads half a result, and an interrupted run
/// leaves none.
pub fn write_whole(path: &Path, contents: &[u8]) -> io::Result<()> {
    let beside = beside(path);
    write_new(&beside, contents).and_then(|()| std::fs::rename(&beside, path)).inspect_err(|_| {
        // The first error is the one to report, also if this fails too.
        let _ = std::fs::remove_file(&beside);
    })
}

fn write_new(path: &Path, contents: &[u8]) -> io::Result<()> {
    let mut file = std::fs::File::create_new(path)?;
    file.write_all(contents)?;
    file.sync_all()
}

/// A name in the same folder that no other file of this or another process uses.
fn beside(path: &Path) -> PathBuf {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    path.with_file_name(format!(".holonom-{}-{count}.tmp", std::process::id()))
}
