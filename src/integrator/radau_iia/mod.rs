//! Radau IIA collocation of orders 5, 9 and 13.

mod collocation;
mod convergence;
mod newton;
mod order;
mod stages;

use super::{Control, Entry, From, Integrator, Problem, Setup, Steps, Tolerance};
use crate::choice::OptionDoc;
use crate::error::{Error, Result};
use crate::formulation::{self, Halt, Rows};
use convergence::{Convergence, Verdict};
use newton::Newton;
use order::{Order, Seen, internal};
use stages::{Stages, Unknowns, combine};

pub const ENTRY: Entry = Entry {
    name: "radau_iia",
    about: "implicit collocation of variable order 5, 9, 13, L-stable: stiff motions, and high accuracy",
    order: 5,
    orders: &[("index3", [5, 3, 3])],
    steps: Steps::Either,
    accepts: &["ggl", "index3", "index2", "index1"],
    refuses: &[],
    options: &[OptionDoc { name: "order", about: "5, 9 or 13 (default: chosen as it goes; 5 with a fixed step)" }],
    make,
};

fn make(setup: &Setup) -> Result<Box<dyn Integrator>> {
    let n = setup.system.dimensions();
    let order = Order::new(setup.integrator, setup.is_fixed)?;
    let rows = formulation::rows(setup.formulation)
        .ok_or_else(|| Error::input(format!("radau_iia cannot integrate {}", setup.formulation.name)))?;
    let most = order.most_stages();
    Ok(Box::new(RadauIIA {
        newton: Newton::new(rows, most / 2, setup)?,
        stages: Stages::new(most, n),
        convergence: Convergence::new(),
        before: Unknowns::new(most, n),
        tried: None,
        accepted: None,
        lambda: vec![0.0; n.lambda],
        factored: None,
        error_x: vec![0.0; n.v],
        error_v: vec![0.0; n.v],
        error: vec![0.0; setup.len()],
        seen: Seen { error: 1.0, decay: 1.0, theta: 1.0, iterations: 0 },
        order,
    }))
}

struct RadauIIA {
    order: Order,
    newton: Newton,
    stages: Stages,
    convergence: Convergence,
    /// The last attempt.
    tried: Option<Step>,
    /// The last accepted step and its stages, whose polynomials predict those of the next.
    accepted: Option<Step>,
    before: Unknowns,
    /// lambda at the start of the step.
    lambda: Vec<f64>,
    /// Step and method that the matrices are factored for.
    factored: Option<(f64, usize)>,
    error_x: Vec<f64>,
    error_v: Vec<f64>,
    error: Vec<f64>,
    /// Of the last attempt.
    seen: Seen,
}

#[derive(Clone, Copy)]
struct Step {
    start: f64,
    h: f64,
    /// Index of its method.
    method: usize,
}

impl RadauIIA {
    /// A new start means that the last attempt was accepted: its stages predict the next, and M, G, K and C are renewed.
    fn begin(&mut self, problem: &mut Problem, tolerance: &Tolerance, from: From) -> Result<(), Halt> {
        if self.tried.is_some_and(|step| step.start == from.t) {
            return Ok(());
        }
        if let Some(step) = self.tried {
            std::mem::swap(&mut self.before, &mut self.stages.unknowns);
            self.accepted = Some(step);
            self.order.accepted(tolerance, &self.seen);
        }
        self.lambda.copy_from_slice(&problem.dynamics.lambda);
        self.factored = None;
        self.newton.linearize(problem, from, &self.lambda)
    }

    /// Solves the equations of all stages for a step `h`.
    fn solve(&mut self, problem: &mut Problem, tolerance: &Tolerance, from: From, h: f64) -> Result<(), Halt> {
        let method = self.order.method();
        let s = method.stages();
        let (_, vdot) = problem.split(from.slope);
        match self.accepted {
            Some(step) => {
                let old = self.order.get(step.method);
                self.stages.unknowns.extrapolate(&self.before, old, &method.nodes, h / step.h);
            }
            None => self.stages.unknowns.hold(vdot, &self.lambda),
        }
        self.stages.rest(from);
        self.stages.advance(problem, method, from, h);
        // Velocities that a position row determines are index-2 variables.
        let weight = if self.newton.rows == Rows::Position { 1.0 } else { 1.0 };
        self.convergence.begin(7 + 5 * (s - 3) / 2, tolerance.rtol);
        loop {
            for i in 0..s {
                let t = from.t + method.nodes[i] * h;
                self.stages.leave(i, t, self.newton.rows, &mut problem.dynamics)?;
            }
            self.newton.correct(method, h, &mut self.stages, &mut problem.dynamics)?;
            self.stages.advance(problem, method, from, h);
            let change = self.stages.change(tolerance, from, s, weight);
            if std::env::var("DBG2").is_ok() {
                let mx = |x: &Vec<Vec<f64>>| x.iter().take(s).flatten().fold(0.0f64, |a, b| a.max(b.abs()));
                let r = |f: &dyn Fn(&stages::Residual) -> Vec<f64>| {
                    self.stages
                        .residuals
                        .iter()
                        .take(s)
                        .flat_map(|x| f(x))
                        .fold(0.0f64, |a: f64, b: f64| a.max(b.abs()))
                };
                eprintln!(
                    "   change {change:.3e} dq {:.2e} dv {:.2e} U {:.2e} mu {:.2e} r {:.2e} {:.2e} {:.2e} {:.2e}",
                    self.stages.dbg(s).0,
                    self.stages.dbg(s).1,
                    mx(&self.stages.unknowns.shift),
                    mx(&self.stages.unknowns.mu),
                    r(&|x| x.motion.clone()),
                    r(&|x| x.rows.clone()),
                    r(&|x| x.shift.clone()),
                    r(&|x| x.position.clone())
                );
            }
            match self.convergence.judge(change) {
                Verdict::Converged => break,
                Verdict::GoOn => {}
                Verdict::Failed => return Err(Halt::Unsuitable("Newton's method does not converge")),
            }
        }
        self.stages.work(method, from, h);
        Ok(())
    }

    /// The difference to a formula of order s, damped along the stiff directions, over the tolerated errors.
    fn estimate(
        &mut self,
        problem: &Problem,
        tolerance: &Tolerance,
        from: From,
        h: f64,
        to: &[f64],
    ) -> Result<f64, Halt> {
        let method = self.order.method();
        let (x, v) = (&mut self.error_x, &mut self.error_v);
        let ((q0, v0), (_, vdot0)) = (problem.split(from.y), problem.split(from.slope));
        let (nq, gamma) = (q0.len(), method.real.value);
        for k in 0..v0.len() {
            let stages = self.stages.y.iter().zip(&method.error);
            x[k] = h * (gamma * v0[k] + stages.map(|(y, d)| d * y[nq + k]).sum::<f64>());
        }
        v.iter_mut().zip(vdot0).for_each(|(v, vdot)| *v = h * gamma * vdot);
        combine(v, h, &method.error, &self.stages.unknowns.vdot);
        self.newton.filter(h * gamma, x, v, &problem.dynamics)?;
        let weight = if self.newton.rows == Rows::Position { 1.0 } else { 1.0 };
        let (dq, dv) = self.error.split_at_mut(nq);
        problem.dynamics.system.rate(q0, x, dq);
        dv.iter_mut().zip(&*v).for_each(|(place, v)| *place = weight * v);
        Ok(tolerance.norm_between(from.y, to, &self.error))
    }
}

impl Integrator for RadauIIA {
    fn order(&self) -> usize {
        self.order.method().stages()
    }

    fn control(&mut self) -> &mut Control {
        &mut self.order.control
    }

    fn attempt(
        &mut self,
        problem: &mut Problem,
        tolerance: &Tolerance,
        from: From,
        h: f64,
        to: &mut [f64],
    ) -> Result<Option<f64>, Halt> {
        self.begin(problem, tolerance, from)?;
        let method = self.order.current();
        self.tried = Some(Step { start: from.t, h, method });
        let tolerance = internal(tolerance, self.order.method().stages());
        if self.factored != Some((h, method)) {
            self.newton.factor(self.order.method(), h, &mut problem.dynamics)?;
            self.factored = Some((h, method));
        }
        if let Err(halt) = self.solve(problem, &tolerance, from, h) {
            if std::env::var("DBG").is_ok() {
                eprintln!(
                    "t {:.9} h {h:.3e} s {} it {} theta {:.2e} FAILED",
                    from.t,
                    self.order.method().stages(),
                    self.convergence.iterations,
                    self.convergence.theta
                );
            }
            self.order.failed();
            return Err(halt);
        }
        self.order.control.safety = self.convergence.safety();
        to.copy_from_slice(&self.stages.y[self.order.method().stages() - 1]);
        let e = self.estimate(problem, &tolerance, from, h, to);
        if std::env::var("DBG").is_ok() {
            eprintln!(
                "t {:.9} h {h:.3e} s {} it {} theta {:.2e} err {e:?} decay {:.2e}",
                from.t,
                self.order.method().stages(),
                self.convergence.iterations,
                self.convergence.theta,
                self.seen.decay
            );
        }
        let e = e?;
        let weight = if self.newton.rows == Rows::Position { 1.0 } else { 1.0 };
        self.seen = Seen {
            error: e,
            decay: self.stages.decay(self.order.method(), &tolerance, from),
            theta: self.convergence.theta,
            iterations: self.convergence.iterations,
        };
        Ok(Some(e))
    }

    fn prepare(&mut self, _: &mut Problem, _: From, _: f64, to: &[f64], _: &[f64]) -> Result<(), Halt> {
        let s = self.order.method().stages();
        self.stages.y[s - 1].copy_from_slice(to);
        Ok(())
    }

    /// The collocation polynomial: error O(h^{s+1}).
    fn interpolate(&self, theta: f64, from: &[f64], out: &mut [f64]) {
        let method = self.order.method();
        out.fill(0.0);
        let points = std::iter::once(from).chain(self.stages.y.iter().map(Vec::as_slice));
        for (i, y) in points.enumerate().take(method.stages() + 1) {
            let weight = method.lagrange(i, theta);
            out.iter_mut().zip(y).for_each(|(out, y)| *out += weight * y);
        }
    }
}
