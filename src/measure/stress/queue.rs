//! In which order cells are run, and for how long, while nobody knows what they cost.

use std::collections::BTreeSet;
use std::time::Duration;

/// The first attempt at a job has so much, each later one so many times as much as the one before: what all attempts before
/// the last have taken is a third of it. Less than what a scene costs to read were no saving.
const FIRST: Duration = Duration::from_millis(4);
const GROWTH: u32 = 4;

/// A simulation to make, before others if it is of a lower level, or nearer to the middle of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Job {
    /// The attempts before it, or those that would come to nothing.
    level: u32,
    rank: usize,
    pub what: What,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum What {
    /// The reference of this motion.
    Motion(usize),
    Cell(usize),
}

impl Job {
    pub fn new(rank: usize, what: What) -> Self {
        Job { level: 0, rank, what }
    }

    /// The time it may take, up to the limit.
    pub fn share(&self, limit: Duration) -> Duration {
        FIRST.saturating_mul(GROWTH.saturating_pow(self.level)).min(limit)
    }

    /// The next attempt, without those that come to nothing even if the motion goes on [`GROWTH`] times as fast as the part
    /// did that came through.
    pub fn again(self, part: f64, limit: Duration) -> Self {
        let part = if part > 1e-6 { part.min(1.0) } else { 1e-6 };
        let wanted = self.share(limit).div_f64(part).min(limit) / GROWTH;
        let mut next = Job { level: self.level + 1, ..self };
        while next.share(limit) < wanted {
            next.level += 1;
        }
        next
    }
}

/// Jobs by method. Whichever has taken least has its turn, so that none takes the time of another.
#[derive(Default)]
pub(super) struct Queues {
    names: Vec<String>,
    queues: Vec<Queue>,
}

#[derive(Default)]
struct Queue {
    waiting: BTreeSet<Job>,
    spent: Duration,
}

impl Queues {
    pub fn add(&mut self, name: &str, job: Job) {
        let known = self.names.iter().position(|known| known == name);
        let queue = known.unwrap_or_else(|| {
            self.names.push(name.to_string());
            self.queues.push(Queue::default());
            self.queues.len() - 1
        });
        self.queues[queue].waiting.insert(job);
    }

    /// What comes next, with its queue. It counts with its share until it is back.
    pub fn take(&mut self, limit: Duration) -> Option<(usize, Job)> {
        let waiting = self.queues.iter_mut().enumerate().filter(|(_, queue)| !queue.waiting.is_empty());
        let (index, queue) = waiting.min_by_key(|(_, queue)| queue.spent)?;
        let job = queue.waiting.pop_first()?;
        queue.spent += job.share(limit);
        Some((index, job))
    }

    /// Notes what a job took, with its next attempt where it needs one.
    pub fn give_back(&mut self, (index, job): (usize, Job), limit: Duration, took: Duration, next: Option<Job>) {
        let queue = &mut self.queues[index];
        queue.spent = (queue.spent + took).saturating_sub(job.share(limit));
        queue.waiting.extend(next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: Duration = Duration::from_secs(1);

    #[test]
    fn methods_have_equal_times() {
        let mut queues = Queues::default();
        for rank in 0..100 {
            queues.add("dear", Job::new(rank, What::Cell(rank)));
            queues.add("cheap", Job::new(rank, What::Cell(100 + rank)));
        }
        let mut begun = [0; 2];
        while begun[1] < 100 {
            let (queue, job) = queues.take(LIMIT).unwrap();
            begun[queue] += 1;
            queues.give_back((queue, job), LIMIT, Duration::from_millis([100, 10][queue]), None);
        }
        assert!((9..=11).contains(&begun[0]), "{begun:?}");
    }

    #[test]
    fn later_attempts_have_what_they_need() {
        let job = Job::new(0, What::Cell(0));
        assert_eq!(job.share(LIMIT), FIRST);
        assert_eq!(job.again(0.5, LIMIT).share(LIMIT), 4 * FIRST);
        assert_eq!(job.again(0.01, LIMIT).share(LIMIT), 64 * FIRST);
        assert_eq!([0.0, f64::NAN].map(|part| job.again(part, LIMIT).share(LIMIT)), [64 * FIRST; 2]);
    }
}
