//! Runs on all cores.

use std::panic::resume_unwind;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

/// Makes runs on so many threads at once and returns their results in the order of the jobs. Each run has one thread, so
/// that its CPU time is its own: the threads of `rayon`'s pool take up other runs while they wait.
pub fn run_all<J: Send, R: Send>(
    threads: usize,
    jobs: impl Iterator<Item = J> + Send,
    run: impl Fn(J) -> R + Sync,
) -> Vec<R> {
    // Matrix operations on other threads would wait for the runs there.
    faer::set_global_parallelism(faer::Par::Seq);
    let waiting = Mutex::new(jobs.enumerate());
    let next = || locked(&waiting).next();
    let work = || {
        let mut done = Vec::new();
        while let Some((place, job)) = next() {
            done.push((place, run(job)));
        }
        done
    };
    let mut done: Vec<(usize, R)> = thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic))).collect()
    });
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Returns the number of cores that runs may use.
pub fn cores() -> usize {
    rayon::current_num_threads()
}

/// Returns the content of a mutex; a thread that panicked has not changed it.
pub fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns the content of a mutex that is no longer shared.
pub fn into_inner<T>(mutex: Mutex<T>) -> T {
    mutex.into_inner().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_jobs() {
        for threads in [1, 3] {
            let squares = run_all(threads, 0..100, |k: u32| k * k);
            assert!(squares.into_iter().eq((0..100).map(|k| k * k)));
        }
    }
}
