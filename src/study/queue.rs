//! Order and duration of runs while their cost is not known.

use std::collections::BTreeSet;
use std::time::Duration;

/// CPU time of the first attempt at a job; each later one has GROWTH times that of the one before, so that all attempts
/// before the last take a third of it. Less than the time to read a scene would save nothing.
const FIRST: Duration = Duration::from_millis(4);
const GROWTH: u32 = 4;

/// A simulation to run, before others if it is expected to be cheaper, or has a lower rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Job<What> {
    is_unknown: bool,
    /// Exponent of [`GROWTH`] in its share.
    level: u32,
    rank: usize,
    is_tried: bool,
    pub what: What,
}

impl<What> Job<What> {
    pub fn new(rank: usize, what: What) -> Self {
        Job { is_unknown: true, level: 0, rank, is_tried: false, what }
    }

    /// Returns its CPU time, up to the limit.
    pub fn share(&self, limit: Duration) -> Duration {
        share(self.level, limit)
    }

    /// Returns the next attempt, without those that would be too short even if the motion took [`GROWTH`] times less
    /// than the completed `part` of it suggests.
    pub fn again(self, part: f64, limit: Duration) -> Self {
        let part = if part > 1e-6 { part.min(1.0) } else { 1e-6 };
        let wanted = self.share(limit).div_f64(part).min(limit) / GROWTH;
        Job { is_unknown: false, level: level_for(wanted, limit).max(self.level + 1), is_tried: true, ..self }
    }
}

fn share(level: u32, limit: Duration) -> Duration {
    FIRST.saturating_mul(GROWTH.saturating_pow(level)).min(limit)
}

/// Returns the first level whose share is at least `wanted`.
fn level_for(wanted: Duration, limit: Duration) -> u32 {
    let mut level = 0;
    while share(level, limit) < wanted.min(limit) {
        level += 1;
    }
    level
}

/// Queues of jobs by name. The one that has used the least time is next, so that each has equal time.
pub struct Queues<What>(Vec<Queue<What>>);

struct Queue<What> {
    name: String,
    waiting: BTreeSet<Job<What>>,
    spent: Duration,
}

impl<What: Copy + Ord> Queue<What> {
    /// Sets the expected level of a job of unknown cost, or lowers that of one not tried yet.
    fn foresee(&mut self, what: What, level: u32) {
        let Some(job) = self.waiting.iter().find(|job| job.what == what).copied() else { return };
        if job.is_unknown || !job.is_tried && level < job.level {
            self.waiting.remove(&job);
            self.waiting.insert(Job { is_unknown: false, level, ..job });
        }
    }
}

impl<What: Copy + Ord> Queues<What> {
    pub fn new() -> Self {
        Queues(Vec::new())
    }

    pub fn add(&mut self, name: &str, job: Job<What>) {
        match self.0.iter_mut().find(|queue| queue.name == name) {
            Some(queue) => {
                queue.waiting.insert(job);
            }
            None => {
                self.0.push(Queue { name: name.to_string(), waiting: BTreeSet::from([job]), spent: Duration::ZERO })
            }
        }
    }

    /// Returns the next job, with its queue. Its share counts as used until it is given back.
    pub fn take(&mut self, limit: Duration) -> Option<(usize, Job<What>)> {
        let waiting = self.0.iter_mut().enumerate().filter(|(_, queue)| !queue.waiting.is_empty());
        let (index, queue) = waiting.min_by_key(|(_, queue)| queue.spent)?;
        let job = queue.waiting.pop_first()?;
        queue.spent += job.share(limit);
        Some((index, job))
    }

    /// Records the time `took` of a job of the queue `index`, and the part of its motion completed where it was `cut`;
    /// none where it needs no more attempts. Its neighbours are expected to cost up to twice as much.
    pub fn give_back(
        &mut self,
        index: usize,
        job: Job<What>,
        limit: Duration,
        took: Duration,
        cut: Option<f64>,
        neighbours: impl IntoIterator<Item = What>,
    ) {
        let queue = &mut self.0[index];
        queue.spent = (queue.spent + took).saturating_sub(job.share(limit));
        if let Some(part) = cut {
            queue.waiting.insert(job.again(part, limit));
        }
        let level = if cut.is_some() { job.level + 1 } else { level_for(2 * took, limit) };
        neighbours.into_iter().for_each(|what| queue.foresee(what, level));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: Duration = Duration::from_secs(1);

    #[test]
    fn methods_have_equal_times() {
        let mut queues = Queues::new();
        for rank in 0..100 {
            queues.add("dear", Job::new(rank, rank));
            queues.add("cheap", Job::new(rank, 100 + rank));
        }
        let mut begun = [0; 2];
        while begun[1] < 100 {
            let (queue, job) = queues.take(LIMIT).unwrap();
            begun[queue] += 1;
            queues.give_back(queue, job, LIMIT, Duration::from_millis([100, 10][queue]), None, []);
        }
        assert!((9..=11).contains(&begun[0]), "{begun:?}");
    }

    #[test]
    fn later_attempts_have_what_they_need() {
        let job = Job::new(0, 0);
        assert_eq!(job.share(LIMIT), FIRST);
        assert_eq!(job.again(0.5, LIMIT).share(LIMIT), 4 * FIRST);
        assert_eq!(job.again(0.01, LIMIT).share(LIMIT), 64 * FIRST);
        assert_eq!([0.0, f64::NAN].map(|part| job.again(part, LIMIT).share(LIMIT)), [64 * FIRST; 2]);
    }

    /// Jobs in a row whose cost increases to the right, while the queue starts in the middle: they run in the order of
    /// their costs, and little time is lost in attempts.
    #[test]
    fn cheap_jobs_come_first_and_neighbours_tell_what_is_cheap() {
        let needs = |k: usize| Duration::from_secs_f64(1e-3 * 2f64.powi(k as i32));
        let mut queues = Queues::new();
        (0..9).for_each(|k: usize| queues.add("", Job::new(k.abs_diff(4), k)));
        let mut spent = Duration::ZERO;
        let mut through = Vec::new();
        while let Some((queue, job)) = queues.take(LIMIT) {
            let k = job.what;
            let took = needs(k).min(job.share(LIMIT));
            let cut = (took < needs(k)).then(|| took.div_duration_f64(needs(k)));
            through.extend(cut.is_none().then_some(k));
            spent += took;
            let neighbours = [k.checked_sub(1), Some(k + 1)].into_iter().flatten();
            queues.give_back(queue, job, LIMIT, took, cut, neighbours);
        }
        assert!(through.windows(2).all(|pair| pair[0] < pair[1] + 3), "{through:?}");
        let least: Duration = (0..9).map(needs).sum();
        assert!(spent < least.mul_f64(1.3), "{spent:?} of {least:?}");
    }
}
