//! A method at falling tolerances against a reference, as lines of a table.

use crate::common::equations::State;
use crate::common::{Run, asked_for, method, run, until};
use holonom::simulate::Method;
use holonom::system::MechanicalSystem;
use rayon::prelude::*;

/// A mechanism with its start and the end of its reference.
pub struct Problem {
    pub name: &'static str,
    pub system: &'static dyn MechanicalSystem,
    pub start: State,
    pub end: State,
    /// atol/rtol: the size below which components need not be right.
    pub small: f64,
}

/// What runs are asked for.
pub enum Runs {
    /// With rtol of the steps, and atol by the problem.
    Tolerances(&'static [Asked]),
    /// With a fixed step, s.
    Steps(&'static [Asked]),
}

/// (tolerance or step, least digits of q, most evaluations)
pub type Asked = (f64, f64, u64);

/// Formulation, integrator and projection as on the command line, and the runs.
pub type Row = (&'static str, Runs);

/// Significant correct digits of the worst component, -log10 max |x - exact|/|exact|: `scd` of the IVP test set.
pub fn digits(found: &[f64], exact: &[f64]) -> f64 {
    mixed_digits(found, exact, 0.0)
}

/// The same with |exact| + `small` below: `mescd` of the test set.
pub fn mixed_digits(found: &[f64], exact: &[f64], small: f64) -> f64 {
    let errors = found.iter().zip(exact).map(|(found, exact)| (found - exact).abs() / (exact.abs() + small));
    -errors.fold(1e-17, f64::max).log10()
}

impl Problem {
    /// Prints the table (`cargo test --release --test references -- --nocapture`) and asserts every line.
    pub fn check(&self, rows: &[Row]) {
        let lines: Vec<Line> = rows.iter().flat_map(|(names, runs)| runs.lines(names, self.small)).collect();
        let found: Vec<Run> = lines.par_iter().map(|line| self.run(&line.method)).collect();
        let texts: Vec<String> = lines.iter().zip(&found).map(|(line, run)| self.text(line, run)).collect();
        println!("\n{} at {} s\n{HEADING}\n{}", self.name, self.end.t, texts.join("\n"));
        for ((Line { asked: (_, least, most), .. }, run), text) in lines.iter().zip(&found).zip(&texts) {
            assert!(digits(run.last().0, self.end.q) >= *least, "fewer than {least} digits:\n{HEADING}\n{text}");
            let work = run.outcome.statistics.rhs_evaluations;
            assert!(work <= *most, "more than {most} evaluations:\n{HEADING}\n{text}");
        }
    }

    pub fn run(&self, method: &Method) -> Run {
        run(self.system, method, until(self.end.t), self.start.motion()).completed()
    }

    fn text(&self, line: &Line, run: &Run) -> String {
        let (q, v, lambda) = run.last();
        let [q, v, lambda] = [(q, self.end.q), (v, self.end.v), (lambda, self.end.lambda)].map(|(x, y)| digits(x, y));
        let work = &run.outcome.statistics;
        let drift = run.drift().0;
        let [steps, rejected, evaluations] = [work.steps, work.rejected, work.rhs_evaluations];
        let names = line.names;
        let asked = line.asked.0;
        format!(
            "{names:40} {asked:7.0e} {q:5.1} {v:5.1} {lambda:5.1} {steps:7} {rejected:8} {evaluations:11} {drift:9.1e}"
        )
    }
}

/// One run of a row.
struct Line {
    names: &'static str,
    asked: Asked,
    method: Method,
}

impl Runs {
    fn lines(&self, names: &'static str, small: f64) -> Vec<Line> {
        let method = named(names);
        let line = |&asked: &Asked| {
            let method = match self {
                Runs::Tolerances(_) => {
                    let rtol = asked_for(&method, asked.0);
                    Method { rtol, atol: rtol * small, ..method.clone() }
                }
                Runs::Steps(_) => Method { step: Some(asked.0), ..method.clone() },
            };
            Line { names, asked, method }
        };
        let (Runs::Tolerances(runs) | Runs::Steps(runs)) = self;
        runs.iter().map(line).collect()
    }
}

/// `formulation integrator projection`
pub fn named(names: &str) -> Method {
    let [formulation, integrator, projection] = names.split(' ').collect::<Vec<_>>()[..] else { panic!("{names}") };
    method(formulation, integrator, projection)
}

const HEADING: &str =
    "method                                     asked digits: q, v, lambda steps rejected evaluations max |phi|";
