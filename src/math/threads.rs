//! Work divided over the threads of rayon's pool.
//!
//! How work is divided depends on the work alone, and what is divided shares no results: they are the same to the bit
//! for any number of threads.

use std::cell::Cell;

thread_local! {
    static IS_SPREAD: Cell<bool> = const { Cell::new(false) };
}

/// Calls `work`, in which evaluations of large systems take all threads of the pool of rayon that they run in, else of
/// the global one (`RAYON_NUM_THREADS`). Results do not depend on it.
///
/// For a run that has the machine to itself. Not for one of many that run at once, as each has a thread already and
/// would wait for parts of the others; nor where the CPU time of this thread is to be that of the run. Cheapest on a
/// thread of the pool, by `ThreadPool::install` or `ThreadPoolBuilder::use_current_thread`, since every division
/// from outside wakes one up.
pub fn spread<R>(work: impl FnOnce() -> R) -> R {
    let _before = Before(IS_SPREAD.replace(true));
    work()
}

/// Restores the state of the thread, after a panic, too.
struct Before(bool);

impl Drop for Before {
    fn drop(&mut self) {
        IS_SPREAD.set(self.0);
    }
}

/// Work that can be divided.
pub trait Divisible: Sized + Send {
    /// True if it is not to be divided any more.
    fn is_whole(&self) -> bool;

    /// Its two halves.
    fn divided(self) -> [Self; 2];
}

impl<T: Send> Divisible for &mut [T] {
    fn is_whole(&self) -> bool {
        self.len() < 2
    }

    fn divided(self) -> [Self; 2] {
        self.split_at_mut(self.len() / 2).into()
    }
}

/// Divides `all` as far as it can be, and calls `work` for each part: over all threads within [`spread`], else one
/// after the other.
#[inline]
pub fn each<P: Divisible>(all: P, work: &(impl Fn(P) + Sync)) {
    if all.is_whole() {
        work(all)
    } else if IS_SPREAD.get() {
        at_once(all, work)
    } else {
        in_turn(all, work)
    }
}

/// The same for each number of a list.
pub fn each_of<T: Send>(all: &mut [T], work: impl Fn(&mut T) + Sync) {
    each(all, &|some: &mut [T]| some.iter_mut().for_each(&work));
}

fn at_once<P: Divisible>(all: P, work: &(impl Fn(P) + Sync)) {
    if all.is_whole() {
        return work(all);
    }
    let [first, second] = all.divided();
    rayon::join(|| at_once(first, work), || at_once(second, work));
}

fn in_turn<P: Divisible>(all: P, work: &impl Fn(P)) {
    if all.is_whole() { work(all) } else { all.divided().into_iter().for_each(|half| in_turn(half, work)) }
}

#[cfg(test)]
mod tests {
    use super::{each, spread};
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::{Condvar, Mutex};
    use std::thread::{ThreadId, current};
    use std::time::Duration;

    /// The threads that work at ten places. Each waits at its first place until so many have come.
    fn threads(count: usize) -> Vec<Option<ThreadId>> {
        let mut all = [None; 10];
        let came = Mutex::new(Vec::new());
        let more = Condvar::new();
        each(&mut all[..], &|part: &mut [Option<ThreadId>]| {
            assert_eq!(part.len(), 1);
            part[0] = Some(current().id());
            let mut came = came.lock().unwrap();
            if !came.contains(&part[0]) {
                came.push(part[0]);
                more.notify_all();
            }
            // Those that never come are missed by the test.
            drop(more.wait_timeout_while(came, Duration::from_secs(60), |came| came.len() < count).unwrap());
        });
        all.to_vec()
    }

    #[test]
    fn work_is_divided_within_spread_alone() {
        let own = Some(current().id());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        assert_eq!(threads(1), [own; 10]);
        let [on_two, alone] = pool.install(|| [spread(|| threads(2)), threads(1)]);
        assert!(on_two.iter().all(Option::is_some) && on_two.iter().any(|thread| *thread != on_two[0]), "{on_two:?}");
        assert_eq!(alone, [alone[0]; 10]);
    }

    #[test]
    fn a_panic_ends_spread() {
        let panics = catch_unwind(AssertUnwindSafe(|| spread(|| panic!("on purpose"))));
        assert!(panics.is_err());
        assert_eq!(threads(1), [Some(current().id()); 10]);
    }
}
