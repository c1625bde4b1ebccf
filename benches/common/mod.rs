//! CPU times of calls that take turns.

#![allow(dead_code, reason = "each benchmark uses its own part")]

use cpu_time::ThreadTime;

const ROUNDS: usize = 7;
/// A round repeats a short call for this long, so that the clock's own resolution does not count, s.
const ROUND: f64 = 0.02;

/// A name, and the call of which the time is measured.
pub type Case<'a> = (String, Box<dyn FnMut() + 'a>);

/// Least CPU times of one call of each, in s, on this thread. All take turns in each round, so that a change of the
/// machine's load meets all alike: ratios hold on a busy machine, too.
pub fn least_times(cases: &mut [Case]) -> Vec<f64> {
    let repeats: Vec<usize> = cases.iter_mut().map(|(_, call)| repeats(call)).collect();
    let mut least = vec![f64::INFINITY; cases.len()];
    for _ in 0..ROUNDS {
        for (((_, call), repeats), least) in cases.iter_mut().zip(&repeats).zip(&mut least) {
            *least = least.min(time(call, *repeats));
        }
    }
    least
}

/// Prints the times of [`least_times`] in us, with ratios to the first case.
pub fn compare(title: &str, mut cases: Vec<Case>) {
    println!("\n{title:<48} {:>12} {:>10}", "us", "ratio");
    let times = least_times(&mut cases);
    for ((name, _), time) in cases.iter().zip(&times) {
        println!("  {name:<46} {:>12.2} {:>10.3}", 1e6 * time, time / times[0]);
    }
}

fn repeats(call: &mut dyn FnMut()) -> usize {
    call();
    (ROUND / time(call, 1).max(1e-9)).ceil().clamp(1.0, 1e5) as usize
}

fn time(call: &mut dyn FnMut(), repeats: usize) -> f64 {
    let clock = ThreadTime::now();
    (0..repeats).for_each(|_| call());
    clock.elapsed().as_secs_f64() / repeats as f64
}
