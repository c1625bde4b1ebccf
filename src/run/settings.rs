//! What a run is made of, and what it is given before its first step.

use super::recording::Observers;
use super::{Checkpoint, Input, Model, Run, RunOrigin, Sink};
use crate::analysis::Recorder;
use crate::error::Error;
use crate::method_spec::OwnMethods;
use crate::run::inputs::Inputs;
use crate::simulate::{Choice, Method, Start};
use crate::system::MechanicalSystem;

impl Model {
    /// A run of this model from its start, by its method or, where that is automatic, by those that get farthest.
    pub fn run(&self) -> Run<'_> {
        let choice = self.choice(&self.method);
        let (q, v) = self.start();
        let span = self.span().ok();
        let mut run = Run::of(self.system(), choice, RunOrigin::State(q.to_vec(), v.to_vec()), self.start_time());
        let refused = self.check_rounding().err();
        run.own_methods = self.own_methods.clone();
        Run { end: span.map(|span| span.end), output_step: span.map(|span| span.output_step), refused, ..run }
    }
}

impl<'a> Run<'a> {
    /// A run of `system` by `method` from a consistent state at `t`, or on from where another was saved.
    ///
    /// ```
    /// use holonom::prelude::*;
    /// use holonom::run::Run;
    ///
    /// struct Cart;
    ///
    /// impl Equations for Cart {
    ///     fn size(&self) -> (usize, usize) {
    ///         (1, 0)
    ///     }
    ///     fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
    ///         mass[0] = S::constant(2.0);
    ///     }
    ///     fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
    ///         f[0] = S::zero();
    ///     }
    ///     fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
    ///     fn input_names(&self) -> Vec<String> {
    ///         vec!["motor".to_string()]
    ///     }
    ///     fn input_forces<S: Scalar>(&self, _t: S, _q: &[S], forces: &mut [S]) {
    ///         forces[0] = S::one();
    ///     }
    /// }
    ///
    /// let start = ([0.0], [0.0]);
    /// let mut run = Run::new(&Cart, "index1 + dop853", 0.0, &start).input("motor", every(0.01, |x| 4.0 - x.v[0]));
    /// run.to(10.0)?;
    /// assert!((run.state()?.v[0] - 4.0).abs() < 0.1);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn new<'s, M: TryInto<Method>>(
        system: &'a dyn MechanicalSystem,
        method: M,
        t: f64,
        start: impl Into<Start<'s>>,
    ) -> Self
    where
        Error: From<M::Error>,
    {
        let start = match start.into() {
            Start::State(q, v) => RunOrigin::State(q.to_vec(), v.to_vec()),
            Start::Saved(saved) => RunOrigin::Saved(Box::new(saved.clone())),
        };
        match method.try_into().map_err(Error::from) {
            Ok(method) => Run::of(system, Choice::One(Box::new(method)), start, t),
            Err(error) => Run { refused: Some(error), ..Run::of(system, Choice::One(Box::default()), start, t) },
        }
    }

    fn of(system: &'a dyn MechanicalSystem, choice: Choice, start: RunOrigin, began: f64) -> Self {
        Run {
            system,
            choice,
            own_methods: OwnMethods::default(),
            start,
            began,
            end: None,
            output_step: None,
            named: Vec::new(),
            inputs: Inputs::default(),
            engine: None,
            refused: None,
            observers: Observers::of(system),
        }
    }

    /// Drives an input of the system: by a closure `|t: f64, x: &Moment| ..`, or sampled by [`every`](super::every). It adds to what
    /// the scene gives the input. With automatic choice of methods, one is chosen at the start.
    ///
    /// The matrices of implicit methods do not contain the derivatives of a closure: with a stiff law explicit methods
    /// take fewer steps.
    pub fn input(mut self, name: &str, input: impl Into<Input<'a>>) -> Self {
        self.named.push((name.to_string(), input.into()));
        self.unless_begun("inputs are given")
    }

    /// Plans the end, s: what a run to shorter times decides by the whole of the motion is then the same. Without this
    /// it is that of the scene, or the time of the first call.
    pub fn planned_to(mut self, end: f64) -> Self {
        self.end = Some(end);
        self
    }

    /// Distance of the rows of the record, s. Default: that of the scene, or a 500th of the planned time.
    pub fn rows_every(mut self, output_step: f64) -> Self {
        self.output_step = Some(output_step);
        self
    }

    /// Begins where another run of the same system was saved.
    pub fn from_saved(mut self, saved: &Checkpoint) -> Self {
        self.start = RunOrigin::Saved(Box::new(saved.clone()));
        self.unless_begun("a start is given")
    }

    /// Records in another way, such as with [`Recorder::with_jumps`] or [`Recorder::with_progress`].
    pub fn recording(mut self, change: impl FnOnce(Recorder<'a>) -> Recorder<'a>) -> Self {
        self.observers.recorder = change(self.observers.recorder);
        self
    }

    /// Shows the motion to a sink, too. The run ends with [`End::Stopped`](super::End::Stopped) where the sink is [done](Sink::is_done).
    pub fn shown_to(mut self, sink: impl Sink + 'a) -> Self {
        self.observers.sink = Box::new(sink);
        self.unless_begun("a sink is given")
    }

    /// Refuses what comes too late.
    pub(super) fn unless_begun(mut self, change: &str) -> Self {
        if self.engine.is_some() {
            let late = Error::input(format!("{change} after the run has begun"));
            self.refused = Some(late.hint("give it before the first step"));
        }
        self
    }
}
