//! Accepted states, as the sink sees them.

use super::rows::observation;
use super::{Observation, Run, Sink};

impl Run<'_> {
    /// Updates the reference values of the rank at an accepted state, and shows the state with the size of its step.
    pub fn observe(&mut self, size: Option<f64>, sink: &mut dyn Sink) {
        let deficient = self.problem.dynamics.is_rank_deficient;
        self.problem.dynamics.statistics.rank_deficient += u64::from(deficient);
        let dynamics = &self.problem.dynamics;
        // Without a new factorization, as in `penalty`, the rank indicator belongs to another state.
        let is_factored = dynamics.statistics.factorizations > self.factored;
        self.factored = dynamics.statistics.factorizations;
        let own = || (is_factored && dynamics.kkt.is_factored()).then(|| dynamics.kkt.rank_indicator());
        let rank_indicator = dynamics.rank_indicator.or_else(own);
        if let Some(rank_indicator) = rank_indicator {
            self.approach.add(self.t, rank_indicator);
        }
        let dense = dynamics.dense_reference.max(dynamics.dense_indicator);
        self.refer_to(dense);
        self.show(rank_indicator, size, sink);
    }

    /// Sets the reference values of the rank indicators, that of a dense solver to `dense`.
    pub fn refer_to(&mut self, dense: f64) {
        let Run { problem, rows, approach, .. } = self;
        [problem, &mut rows.problem].into_iter().for_each(|p| p.dynamics.refer_to(approach.largest, dense));
    }

    pub fn show(&mut self, rank_indicator: Option<f64>, size: Option<f64>, sink: &mut dyn Sink) {
        if !sink.watches() {
            return;
        }
        let tolerated = self.fixed.is_none().then(|| self.tolerated_energy());
        let effort = Some(self.effort());
        let state = observation(self.t, &self.y, &self.problem, rank_indicator, &mut self.phi_ddot);
        let apart = size.map(|size| size * self.integrator.control().spacing);
        sink.accepted(&Observation { tolerated, apart, effort, ..state });
    }
}
