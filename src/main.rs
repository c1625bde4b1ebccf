//! The command line of holonom.

use std::process::ExitCode;

fn main() -> ExitCode {
    holonom::cli::run(std::env::args_os())
}
