//! Ctrl-C and its like.

use super::terminal::tell;
use crate::report::Folder;
use crate::simulate::Stop;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether somebody asks, so that a command ends by itself.
static IS_HEARD: AtomicBool = AtomicBool::new(false);
static IS_ASKED_FOR: AtomicBool = AtomicBool::new(false);

/// Of the failure of a run.
pub const REASON: &str = "interrupted";

/// What shells give a process that Ctrl-C ended.
const ENDED: i32 = 130;

/// From now on Ctrl-C, and what ends processes in an orderly way, asks a command to end by itself if it can, and the
/// second time ends it at once.
pub fn listen() {
    // Without a handler the process just ends.
    let _ = handle(|| {
        let is_heard = IS_HEARD.load(Ordering::Relaxed);
        let is_second = IS_ASKED_FOR.swap(true, Ordering::Relaxed);
        let ends = is_second || !is_heard;
        tell(if ends { "interrupted" } else { "interrupted: the results so far are written; again to end at once" });
        if ends {
            std::process::exit(ENDED);
        }
    });
}

/// Calls `then` at each signal. INT and TERM are heard even where the starter of the process has them ignored, as the
/// background of a script has INT: who sends one means it. HUP is not, since that is what nohup is for.
#[cfg(unix)]
fn handle(then: impl Fn() + Send + 'static) -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let mut signals = signal_hook::iterator::Signals::new([SIGINT, SIGTERM])?;
    if is_ignored(SIGHUP) == Some(false) {
        signals.add_signal(SIGHUP)?;
    }
    std::thread::Builder::new().spawn(move || signals.forever().for_each(|_| then()))?;
    Ok(())
}

/// Whether the process was started with a signal ignored, where the system tells.
#[cfg(unix)]
fn is_ignored(signal: i32) -> Option<bool> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
    Some(u64::from_str_radix(mask.trim(), 16).ok()? & 1 << (signal - 1) != 0)
}

#[cfg(not(unix))]
fn handle(then: impl Fn() + Send + 'static) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(then)
}

/// Why a run should end, whose results go to `folder`: for [`Recorder::with_stop`](crate::analysis::Recorder::with_stop).
/// A command that asks also writes what it has.
pub fn stop(folder: &Folder) -> Option<Stop> {
    is_asked().then(|| Stop {
        reason: REASON.to_string(),
        hint: format!("what was computed until then is in {}", folder.path().display()),
    })
}

/// Whether the command should end, which then also writes what it has.
pub fn is_asked() -> bool {
    IS_HEARD.store(true, Ordering::Relaxed);
    IS_ASKED_FOR.load(Ordering::Relaxed)
}
