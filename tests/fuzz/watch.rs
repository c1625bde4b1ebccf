//! A watchdog: a scene that hangs is named.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// A scene that takes so long hangs. Reading, assembling and the first steps of one take a second.
pub const FOREVER: Duration = Duration::from_secs(120);

/// What each worker does, and since when.
type Slots = Arc<Mutex<Vec<Option<(u64, Instant)>>>>;

/// Runs `work` on all `numbers` by some threads, with the file that each of them may use.
/// Ends the process when one hangs: a thread that does cannot be stopped otherwise.
pub fn each<T: Send>(
    numbers: &[u64],
    folder: &Path,
    work: impl Fn(u64, &Path) -> Result<T, String> + Sync,
) -> Vec<(u64, Result<T, String>)> {
    let workers = std::thread::available_parallelism().map_or(2, usize::from);
    let slots: Slots = Arc::new(Mutex::new(vec![None; workers]));
    let next = AtomicU64::new(0);
    let is_over = Arc::new(AtomicBool::new(false));
    let found = Mutex::new(Vec::new());
    let dog = std::thread::spawn({
        let slots = slots.clone();
        let is_over = is_over.clone();
        let folder = folder.to_path_buf();
        move || watch(&slots, &is_over, &folder)
    });
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let slots = &slots;
            let next = &next;
            let found = &found;
            let work = &work;
            scope.spawn(move || {
                let file = file(folder, worker);
                while let Some(&number) = numbers.get(next.fetch_add(1, Ordering::Relaxed) as usize) {
                    slots.lock().unwrap()[worker] = Some((number, Instant::now()));
                    let result = work(number, &file);
                    slots.lock().unwrap()[worker] = None;
                    found.lock().unwrap().push((number, result));
                }
            });
        }
    });
    is_over.store(true, Ordering::Relaxed);
    dog.join().unwrap();
    let mut found = found.into_inner().unwrap();
    found.sort_by_key(|(number, _)| *number);
    found
}

fn file(folder: &Path, worker: usize) -> PathBuf {
    folder.join(format!("scene{worker}.json"))
}

fn watch(slots: &Slots, is_over: &AtomicBool, folder: &Path) {
    while !is_over.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_millis(50));
        for (worker, slot) in slots.lock().unwrap().iter().enumerate() {
            if let Some((number, since)) = slot
                && since.elapsed() > FOREVER
            {
                let kept = std::env::temp_dir().join(format!("holonom-hang-{number}.json"));
                let _ = std::fs::copy(file(folder, worker), &kept);
                eprintln!("scene {number} hangs: {}", kept.display());
                std::process::exit(101);
            }
        }
    }
}
