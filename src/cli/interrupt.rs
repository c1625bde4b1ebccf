//! Ctrl-C and its like.

use crate::report::Folder;
use crate::simulate::Stop;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether somebody asks, so that a command ends by itself.
static IS_HEARD: AtomicBool = AtomicBool::new(false);
static IS_ASKED_FOR: AtomicBool = AtomicBool::new(false);

/// Of the failure of a run.
pub const REASON: &str = "interrupted";

/// What shells give a process that Ctrl-C ended.
const ENDED: i32 = 130;

/// From now on Ctrl-C, and what ends processes in an orderly way, asks a command to end by itself if it can, and the
/// second time ends it at once. Where the starter of the process has these signals ignored, as nohup does, they stay so.
pub fn listen() {
    // Without a handler the process just ends.
    let _ = ctrlc::try_set_handler(|| {
        let is_heard = IS_HEARD.load(Ordering::Relaxed);
        let is_second = IS_ASKED_FOR.swap(true, Ordering::Relaxed);
        let ends = is_second || !is_heard;
        let then =
            if ends { "interrupted" } else { "interrupted: the results so far are written; again to end at once" };
        // Nobody may be there to read it.
        let _ = writeln!(std::io::stderr(), "{then}");
        if ends {
            std::process::exit(ENDED);
        }
    });
}

/// Why a run should end, whose results go to `folder`: for [`Recorder::with_stop`](crate::measure::Recorder::with_stop).
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
