//! Publishes a set of result files together.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::TempDir;

/// Prefix of the names of hidden folders; random letters follow.
const PREFIX: &str = ".holonom-";
/// File in a hidden folder, locked as long as the process that writes there is alive.
const LOCK: &str = ".lock";
/// Folder in a hidden folder, with the results of before while new ones are published.
const OLD: &str = ".old";

/// The hidden folders of this process. Files are renamed while it is locked.
static HIDDEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn hidden() -> MutexGuard<'static, Vec<PathBuf>> {
    HIDDEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Waits for results that are being published, and removes the others, for a process that ends at once. Nothing is
/// published after that.
pub fn abandon() {
    let folders = hidden();
    for folder in folders.iter() {
        // The next process that writes there removes what is left.
        let _ = std::fs::remove_dir_all(folder);
    }
    std::mem::forget(folders);
}

/// Results that become visible only when all of them are complete.
///
/// They are written to a hidden folder in the one where they will be, and [`publish`](Self::publish) renames them one
/// after another. If the process ends before that, by a full disk or a formula, earlier results stay unchanged. A signal
/// that ends the process waits for the renames: see [`abandon`]. Where a rename fails, those before it are undone. Only
/// where the process is killed during them, some microseconds for each file, can a part of the files be missing. The last
/// file vouches for the others: its old version goes first, and its new one comes last.
///
/// Hidden folders of processes that were killed are removed by the next one that writes to the same place. The lock in
/// them shows whether their process lives.
pub struct Staging {
    target: PathBuf,
    names: Vec<String>,
    // Before the folder: an open file could not be removed everywhere.
    _lock: Option<File>,
    hidden: TempDir,
}

impl Staging {
    /// Makes a hidden folder in `target`, which must exist.
    pub fn create(target: &Path) -> io::Result<Staging> {
        remove_abandoned(target);
        loop {
            let hidden = tempfile::Builder::new().prefix(PREFIX).tempdir_in(target)?;
            if let Some(lock) = lock(hidden.path())? {
                self::hidden().push(hidden.path().to_path_buf());
                return Ok(Staging { target: target.to_path_buf(), names: Vec::new(), _lock: lock, hidden });
            }
        }
    }

    /// The folder in which the files will be.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Names of the files, in the order in which they were first written.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Writes a file that will be called `name`.
    ///
    /// # Errors
    /// Errors of the file system: a full disk, no permission, a folder of this name.
    pub fn write(&mut self, name: &str, contents: &[u8]) -> io::Result<()> {
        let mut file = self.open(name)?;
        file.write_all(contents)?;
        file.sync_all()
    }

    /// Makes a file that will be called `name`, to be written and synchronized before [`publish`](Self::publish).
    pub fn open(&mut self, name: &str) -> io::Result<File> {
        if self.target.join(name).is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        let file = File::create(self.path(name))?;
        if !self.names.iter().any(|known| known == name) {
            self.names.push(name.to_string());
        }
        Ok(file)
    }

    /// Path at which the file that will be called `name` is written.
    pub fn path(&self, name: &str) -> PathBuf {
        self.hidden.path().join(name)
    }

    /// Renames the files to their places, in the order in which they were first written, and removes the `obsolete`. If
    /// that fails, all files are as before.
    ///
    /// # Errors
    /// Errors of the file system, with the name of the file.
    pub fn publish(self, obsolete: &[String]) -> Result<(), (String, io::Error)> {
        let _renaming = hidden();
        let mut moves = Moves::default();
        let done = self.rename_all(obsolete, &mut moves);
        if done.is_err() {
            moves.undo();
        }
        done
    }

    fn rename_all(&self, obsolete: &[String], moves: &mut Moves) -> Result<(), (String, io::Error)> {
        let old = self.hidden.path().join(OLD);
        std::fs::create_dir(&old).map_err(|error| (OLD.to_string(), error))?;
        // The file that vouches for the others goes first.
        for name in self.names.iter().rev().chain(obsolete) {
            moves.set_aside(&self.target.join(name), old.join(name)).map_err(|error| (name.clone(), error))?;
        }
        for name in &self.names {
            moves.rename(self.path(name), self.target.join(name)).map_err(|error| (name.clone(), error))?;
        }
        Ok(())
    }
}

/// Renamed files, from where and to where.
#[derive(Default)]
struct Moves(Vec<(PathBuf, PathBuf)>);

impl Moves {
    fn rename(&mut self, from: PathBuf, to: PathBuf) -> io::Result<()> {
        std::fs::rename(&from, &to)?;
        self.0.push((from, to));
        Ok(())
    }

    /// Moves a file away, if it is there. A folder is not ours.
    fn set_aside(&mut self, path: &Path, to: PathBuf) -> io::Result<()> {
        if path.is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        match self.rename(path.to_path_buf(), to) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    fn undo(self) {
        for (from, to) in self.0.into_iter().rev() {
            // The error that is told is the one that led here.
            let _ = std::fs::rename(to, from);
        }
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        let mut folders = hidden();
        // While it is locked: a process that ends between the two would leave the folder.
        let _ = std::fs::remove_dir_all(self.hidden.path());
        folders.retain(|folder| folder != self.hidden.path());
    }
}

/// The lock of a new folder, `Some(None)` if the file system has no locks; `None` if another process took the folder
/// for an abandoned one before it was locked.
fn lock(hidden: &Path) -> io::Result<Option<Option<File>>> {
    let lock = match File::create_new(hidden.join(LOCK)) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        created => created?,
    };
    Ok(match lock.try_lock() {
        Ok(()) => hidden.join(LOCK).exists().then_some(Some(lock)),
        Err(std::fs::TryLockError::WouldBlock) => None,
        Err(std::fs::TryLockError::Error(_)) => Some(None),
    })
}

/// Removes hidden folders of killed processes. Failure to remove them is ignored.
fn remove_abandoned(target: &Path) {
    let Ok(entries) = std::fs::read_dir(target) else { return };
    let hidden = entries.flatten().filter(|entry| entry.file_name().to_string_lossy().starts_with(PREFIX));
    for folder in hidden.map(|entry| entry.path()) {
        // A folder is abandoned if its lock can be taken; one without a lock is just being made.
        if let Ok(lock) = File::open(folder.join(LOCK))
            && lock.try_lock().is_ok()
        {
            let _ = std::fs::remove_dir_all(&folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder with `a` and `b` of before.
    fn place() -> TempDir {
        let place = tempfile::tempdir().unwrap();
        ["a", "b"].iter().for_each(|name| std::fs::write(place.path().join(name), "old").unwrap());
        place
    }

    fn contents(place: &Path) -> Vec<(String, String)> {
        let entries = std::fs::read_dir(place).unwrap().map(|entry| entry.unwrap().path());
        let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
        let mut found: Vec<_> =
            entries.map(|path| (name(&path), std::fs::read_to_string(path).unwrap_or_default())).collect();
        found.sort();
        found
    }

    fn pairs<const N: usize>(expected: [(&str, &str); N]) -> Vec<(String, String)> {
        expected.map(|(name, text)| (name.to_string(), text.to_string())).to_vec()
    }

    #[test]
    fn all_appear_at_the_end() {
        let place = place();
        let mut staging = Staging::create(place.path()).unwrap();
        ["a", "b", "a"].iter().for_each(|name| staging.write(name, b"new").unwrap());
        assert_eq!(contents(place.path())[1..], pairs([("a", "old"), ("b", "old")]));
        std::fs::write(place.path().join("c"), "old").unwrap();
        staging.publish(&["c".to_string()]).unwrap();
        assert_eq!(contents(place.path()), pairs([("a", "new"), ("b", "new")]));
    }

    #[test]
    fn what_is_not_published_leaves_nothing() {
        let place = place();
        Staging::create(place.path()).unwrap().write("a", b"new").unwrap();
        assert_eq!(contents(place.path()), pairs([("a", "old"), ("b", "old")]));
    }

    #[test]
    fn only_what_is_abandoned_is_removed() {
        let place = place();
        let abandoned = place.path().join(".holonom-1-0");
        std::fs::create_dir(&abandoned).unwrap();
        [LOCK, "a"].iter().for_each(|name| std::fs::write(abandoned.join(name), "").unwrap());
        let mut living = Staging::create(place.path()).unwrap();
        assert!(!abandoned.exists());
        living.write("a", b"living").unwrap();
        drop(Staging::create(place.path()).unwrap());
        living.publish(&[]).unwrap();
        assert_eq!(contents(place.path()), pairs([("a", "living"), ("b", "old")]));
    }

    /// Whichever rename fails, old results stay whole.
    #[test]
    fn results_are_old_where_a_rename_fails() {
        for missing in ["a", "b", "c"] {
            let place = place();
            std::fs::write(place.path().join("d"), "old").unwrap();
            let mut staging = Staging::create(place.path()).unwrap();
            ["a", "b", "c"].iter().for_each(|name| staging.write(name, b"new").unwrap());
            std::fs::remove_file(staging.hidden.path().join(missing)).unwrap();
            assert_eq!(staging.publish(&["d".to_string()]).unwrap_err().0, missing);
            assert_eq!(contents(place.path()), pairs([("a", "old"), ("b", "old"), ("d", "old")]), "{missing}");
        }
    }

    #[test]
    fn a_folder_of_the_name_of_a_file_stays() {
        for name in ["a", "b"] {
            let place = place();
            let mut staging = Staging::create(place.path()).unwrap();
            ["a", "b"].iter().for_each(|name| staging.write(name, b"new").unwrap());
            std::fs::remove_file(place.path().join(name)).unwrap();
            std::fs::create_dir_all(place.path().join(name).join("mine")).unwrap();
            assert_eq!(staging.publish(&[]).unwrap_err().0, name);
            assert!(place.path().join(name).join("mine").exists());
        }
    }
}
