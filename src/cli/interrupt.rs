//! Interruption by Ctrl-C and similar signals.

use super::terminal::tell;
#[cfg(feature = "python")]
use crate::abandoned;
use crate::error::INTERRUPTED;
use crate::files::abandon;
use crate::report::Folder;
use crate::simulate::Stop;
#[cfg(unix)]
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// IS_HEARD: a command polls for interruption. IS_ASKED_FOR: a signal has arrived.
static IS_HEARD: AtomicBool = AtomicBool::new(false);
static IS_ASKED_FOR: AtomicBool = AtomicBool::new(false);

/// Exit code of shells for a process ended by Ctrl-C.
const ENDED: i32 = 130;

/// Installs the signal handlers: the first signal asks the command to end by itself if it polls, the second ends it at
/// once.
pub fn listen() {
    // Without a handler the process just ends.
    let _ = handle(|| {
        let is_heard = IS_HEARD.load(Ordering::Relaxed);
        let is_second = IS_ASKED_FOR.swap(true, Ordering::Relaxed);
        let ends = is_second || !is_heard;
        tell(if ends { "interrupted" } else { "interrupted: the results so far are written; again to end at once" });
        if ends {
            abandon();
            std::process::exit(ENDED);
        }
    });
}

/// Calls `then` at each signal. INT and TERM are handled even if the parent process has them ignored, as the background
/// of a script has INT: who sends one means it. HUP is not, since that is the purpose of nohup.
#[cfg(unix)]
fn handle(then: impl Fn() + Send + 'static) -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    let mut signals = signal_hook::iterator::Signals::new([SIGINT, SIGTERM])?;
    if is_ignored(SIGHUP) == Some(false) {
        signals.add_signal(SIGHUP)?;
    }
    // A file above the limit of the shell is an error of its write, with a message, and not the end of the process.
    signal_hook::flag::register(SIGXFSZ, Arc::default())?;
    std::thread::Builder::new().spawn(move || signals.forever().for_each(|_| then()))?;
    Ok(())
}

/// Returns true if the process was started with a signal ignored; none where the system does not tell.
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

/// Returns a reason to end a run whose results go to `folder`, for
/// [`Recorder::with_stop`](crate::analysis::Recorder::with_stop). A command that polls also writes its results so far.
pub fn stop(folder: &Folder) -> Option<Stop> {
    is_asked().then(|| Stop {
        reason: INTERRUPTED.to_string(),
        hint: format!("what was computed until then is in {}", folder.path().display()),
    })
}

/// Asks the running commands to end, on behalf of a program that called them: by themselves if they poll, else, or if
/// they were asked before, at their next evaluation of the equations.
#[cfg(feature = "python")]
pub fn ask() {
    let is_heard = IS_HEARD.load(Ordering::Relaxed);
    if IS_ASKED_FOR.swap(true, Ordering::Relaxed) || !is_heard {
        abandoned::abandon(true);
    }
}

/// Lets the next command run to its end.
#[cfg(feature = "python")]
pub fn forget() {
    IS_HEARD.store(false, Ordering::Relaxed);
    IS_ASKED_FOR.store(false, Ordering::Relaxed);
    abandoned::abandon(false);
}

/// True if the command should end, after writing its results so far.
pub fn is_asked() -> bool {
    IS_HEARD.store(true, Ordering::Relaxed);
    IS_ASKED_FOR.load(Ordering::Relaxed)
}
