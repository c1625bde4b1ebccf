//! Events: the equations change their form at given times, or where a switching function of the state passes a
//! threshold.
//!
//! Within a step every function is fixed on one piece, so that the integrated equations are smooth. A passage at a
//! given time is known before: a step ends there. One of the state is found on the dense output of a step that passed
//! it; the step is taken again so that it ends there, and the next one starts on the other piece.

mod argument;
mod range;
mod timetable;
mod watch;

pub use timetable::Timetable;

use crate::math::expression::Switch;
use crate::math::signal::Signal;
use crate::math::{Piece, Rate, Regime, Thresholds};
use crate::system::{MechanicalSystem, OperatingPoint, Scratch};
use crate::tolerances;
use argument::Argument;
use range::OpenInterval;

/// An argument is at a threshold within this. Unit: `[1]` of its change over the step.
const AT_THRESHOLD: f64 = 1e-10;

/// A step up to so long ends on the next point of a cubic signal. Unit: `[intervals]`. Why: of steps of dop853 over
/// coarse data half were refused; with 3, radau_iia would take a step an interval of fine data. Test:
/// `steps_end_at_points_of_a_coarse_spline`.
const NEAR_POINTS: f64 = 1.5;

/// The place of a threshold in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passage {
    /// At the start: the piece is not valid from there on.
    AtStart(usize),
    /// At this fraction of the step.
    Within(f64),
    /// At the start, where the function of the sink is zero.
    OfRoot,
}

/// A function that reached a threshold and changed its piece.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    pub number: usize,
    /// The piece before.
    from: Piece,
    /// Rate at which the argument left that piece.
    pub rate: f64,
}

/// The switching functions of a run.
pub struct Events<'a> {
    system: &'a dyn MechanicalSystem,
    switches: &'a [Switch],
    /// Numbers of the switching functions that depend on the state.
    of_state: Vec<usize>,
    /// Those of signals with points that are no thresholds.
    signals: Vec<(usize, &'a Signal)>,
    pub timetable: Timetable<'a>,
    /// The pieces on which all functions are fixed.
    pub pieces: Vec<Piece>,
    scratch: Scratch,
    /// Arguments at both ends of a step, and within it.
    start: Vec<Rate>,
    end: Vec<Rate>,
    within: Vec<Rate>,
    /// Numbers of the functions that are at a threshold at the end of the step.
    at: Vec<usize>,
    /// The functions that come near a threshold in the step, by the fraction of the step up to there.
    near: Vec<(f64, usize)>,
    /// Number of changes of each function at the start of the step.
    pub turned: Vec<u8>,
    /// Shorter times count as zero, s.
    shortest: f64,
}

impl<'a> Events<'a> {
    pub fn new(system: &'a dyn MechanicalSystem, start: f64, end: f64) -> Self {
        let switches = system.switches().all;
        let functions = system.switches().time_functions;
        let zeros = || vec![Rate::fixed(0.0); switches.len()];
        let is_of_state = |switch: &Switch| switch.of_time.is_none() && switch.thresholds != Thresholds::Held;
        let of_state: Vec<usize> = (0..switches.len()).filter(|&number| is_of_state(&switches[number])).collect();
        let signal = |(number, switch): (usize, &'a Switch)| Some((number, switch.signal.as_deref()?));
        let signals = switches.iter().enumerate().filter_map(signal).filter(|(_, signal)| signal.is_watched());
        Events {
            system,
            switches,
            signals: signals.collect(),
            of_state,
            timetable: Timetable::new(switches, functions, start, end),
            pieces: vec![0; switches.len()],
            scratch: Scratch::default(),
            start: zeros(),
            end: zeros(),
            within: zeros(),
            at: Vec::new(),
            near: Vec::new(),
            turned: vec![0; switches.len()],
            shortest: tolerances::ROUND_OFF_OF_FACTORS * (end - start),
        }
    }

    /// Values of the inputs from now on.
    pub fn set_inputs(&mut self, u: &[f64]) {
        self.scratch.inputs = u.to_vec();
    }

    /// True if any function changes its form at thresholds.
    pub fn has_thresholds(&self) -> bool {
        self.switches.iter().any(|switch| switch.thresholds != Thresholds::Held)
    }

    /// True if any function of the state changes its form.
    pub fn watches_state(&self) -> bool {
        !self.of_state.is_empty()
    }

    /// The step from `t`, at most `h`, that resolves the functions of time up to `stop` and the signals of the state.
    pub fn resolved(&mut self, t: f64, h: f64, stop: f64) -> f64 {
        let Events { timetable, switches, pieces, start, signals, .. } = self;
        let resolved = timetable.resolved(t, h, stop, pieces);
        let of_state = signals.iter().filter(|(number, _)| switches[*number].of_time.is_none());
        of_state.fold(resolved, |h, &(number, signal)| {
            timetable.watch.resolved_along(t, h, signal, pieces[number], start[number])
        })
    }

    /// The step from `t`, shorter than `h`, that ends at the next point of a cubic signal, where `h` is not much longer
    /// than the distance of two points.
    pub fn ends_at_point(&self, t: f64, h: f64) -> Option<f64> {
        let regime = Regime::held(&self.pieces);
        let step = |&(number, signal): &(usize, &Signal)| {
            let of_time = self.switches[number].of_time.as_ref();
            let x = of_time.map_or(self.start[number], |argument| argument.at(Rate::seeded(t, 0), regime));
            let rate = x.eps[0];
            let (point, width) = signal.point_ahead(x.re, rate > 0.0, tolerances::UNSEEN)?;
            let step = (point - x.re) / rate;
            (h * rate.abs() < NEAR_POINTS * width && 0.0 < step && step < h).then_some(step)
        };
        self.signals.iter().filter_map(step).reduce(f64::min)
    }

    /// A signal that has no value on its piece, with its number.
    pub fn undefined(&self) -> Option<(usize, &'a Signal)> {
        let signal = |(number, switch): (usize, &'a Switch)| Some((number, switch.signal.as_deref()?));
        let mut signals = self.switches.iter().enumerate().filter_map(signal);
        signals.find(|&(number, signal)| signal.is_undefined_on(self.pieces[number]))
    }

    /// True if the last step ended at a threshold.
    pub fn is_at_threshold(&self) -> bool {
        !self.at.is_empty()
    }

    /// Sets every function to the piece of its argument, at the start of a run.
    pub fn begin(&mut self, at: OperatingPoint) {
        self.timetable.place(at.t, &mut self.pieces);
        // An argument may depend on other pieces.
        // Switching functions whose arguments switch, level by level.
        for _ in 0..10 {
            let before = self.pieces.clone();
            self.start_at(at);
            for &number in &self.of_state {
                let piece = self.switches[number].thresholds.piece(self.start[number].re);
                self.pieces[number] = piece.unwrap_or(0);
            }
            if self.pieces == before {
                return;
            }
        }
    }

    /// Reads the arguments at the state at which the next step starts.
    pub fn start_at(&mut self, at: OperatingPoint) {
        read(self.system, &mut self.scratch, &self.pieces, at, &mut self.start);
    }

    /// Continues from the end of the last step.
    pub fn go_on(&mut self) {
        self.turned.fill(0);
        std::mem::swap(&mut self.start, &mut self.end);
    }

    /// The first passage of a threshold in a step of size `h` to the state `end`; `between` calls its argument with the
    /// state at a fraction of the step.
    pub fn passage<E>(
        &mut self,
        h: f64,
        end: OperatingPoint,
        mut between: impl FnMut(f64, &mut dyn FnMut(OperatingPoint)) -> Result<(), E>,
    ) -> Result<Option<Passage>, E> {
        let Events { system, switches, of_state, pieces, scratch, start, within, at, near, turned, shortest, .. } =
            self;
        read(*system, scratch, pieces, end, &mut self.end);
        at.clear();
        near.clear();
        // A function that is fixed on a threshold is within round-off of it.
        for &number in of_state.iter().filter(|&&number| turned[number] < 2) {
            let a = start[number];
            let b = self.end[number];
            let Some(range) = OpenInterval::of(pieces[number], &switches[number].thresholds) else {
                if a.re != b.re {
                    return Ok(Some(Passage::AtStart(number)));
                }
                continue;
            };
            let swing = (b.re - a.re).abs().max(h * b.eps[0].abs()).max(h * a.eps[0].abs());
            // A threshold that is reached within the shortest time counts as reached.
            let is_at = |x: Rate, part: f64| {
                let soon = shortest.max(4.0 * f64::EPSILON * end.t.abs()) * x.eps[0].abs();
                range.beyond(x.re).abs() <= soon.max(part * swing) && range.outward(x) > 0.0
            };
            match () {
                _ if is_at(a, tolerances::ROUND_OFF_OF_SOLUTIONS)
                    || range.beyond(a.re) > 0.0 && range.outward(a) > 0.0 =>
                {
                    return Ok(Some(Passage::AtStart(number)));
                }
                _ if is_at(b, AT_THRESHOLD) => at.push(number),
                _ => near.extend(Argument { range, a, b, h }.near_from().map(|theta| (theta, number))),
            }
        }
        // Those that come near later than the first passage found are left to the step that ends there.
        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut first = 1.0;
        for &(from, number) in near.iter() {
            if from >= first {
                break;
            }
            let Some(range) = OpenInterval::of(pieces[number], &switches[number].thresholds) else { continue };
            let argument = Argument { range, a: start[number], b: self.end[number], h };
            let mut beyond = |theta: f64| {
                between(theta, &mut |state| read(*system, scratch, pieces, state, within))?;
                Ok(range.beyond(within[number].re))
            };
            let passage = argument.first_passage(first, &mut beyond)?;
            if passage < tolerances::ROUND_OFF_OF_SOLUTIONS {
                return Ok(Some(Passage::AtStart(number)));
            }
            first = passage.min(first);
        }
        Ok((first < 1.0).then_some(Passage::Within(first)))
    }

    /// Moves the functions that are at a threshold, or the one that is at the start of a refused step, to their next
    /// pieces.
    pub fn turn(&mut self, at_start: Option<usize>) -> Vec<Turn> {
        let numbers = at_start.map_or_else(|| std::mem::take(&mut self.at), |number| vec![number]);
        match at_start {
            Some(number) => self.turned[number] += 1,
            None => self.turned.fill(0),
        }
        numbers.into_iter().map(|number| self.turn_function(number, at_start.is_some())).collect()
    }

    /// Moves a function that is at a threshold at the start or the end of the step to its next piece.
    fn turn_function(&mut self, number: usize, is_at_start: bool) -> Turn {
        let from = self.pieces[number];
        let thresholds = &self.switches[number].thresholds;
        let x = if is_at_start { self.start[number] } else { self.end[number] };
        let (to, rate) = match OpenInterval::of(from, thresholds) {
            Some(range) if range.nearest(x.re) == range.low => (from.saturating_sub(2), range.outward(x)),
            Some(range) => (from + 2, range.outward(x)),
            // From a threshold to the side on which the step found it.
            None if self.end[number].re < x.re => (from - 1, 0.0),
            None => (from + 1, 0.0),
        };
        self.pieces[number] = to;
        Turn { number, from, rate }
    }

    /// True if a function has changed its piece more than once at the start of this step; resets its counter.
    pub fn is_undecided(&mut self, number: usize) -> bool {
        let is_undecided = self.turned[number] > 1;
        if is_undecided {
            self.turned[number] = 0;
        }
        is_undecided
    }

    /// A function whose argument the new piece drives back over the threshold to which the old piece drove it.
    pub fn driven_back(&self, turns: &[Turn]) -> Option<Turn> {
        let is_driven_back = |turn: &&Turn| {
            let x = self.start[turn.number];
            let sign = if self.pieces[turn.number] > turn.from { -1.0 } else { 1.0 };
            let was_driven_out = turn.rate > 0.0 || turn.from % 2 == 1;
            was_driven_out && sign * x.eps[0] > AT_THRESHOLD * turn.rate
        };
        turns.iter().find(is_driven_back).copied()
    }

    /// Moves a function that was on a threshold to the other side than [`turn`](Self::turn) did; false if it was not on
    /// a threshold.
    pub fn try_other_side(&mut self, turn: Turn) -> bool {
        let is_from_threshold = turn.from % 2 == 1;
        if is_from_threshold {
            self.pieces[turn.number] = 2 * turn.from - self.pieces[turn.number];
        }
        is_from_threshold
    }

    /// " `NAME`" of the signal in an element whose piece is another than `before`; nothing without one.
    pub fn changed_signal(&self, before: &[Piece], owner: &str) -> String {
        let changed = (0..before.len()).filter(|&i| before[i] != self.pieces[i] && self.owner(i) == owner);
        let mut signals = changed.filter_map(|i| self.switches[i].signal.as_ref());
        signals.next().map_or(String::new(), |signal| format!(" `{}`", signal.name()))
    }

    /// Name of the element of a switching function.
    pub fn owner(&self, number: usize) -> &str {
        self.system.switches().owner(number)
    }
}

/// Writes the arguments of all switching functions at a state.
fn read(system: &dyn MechanicalSystem, scratch: &mut Scratch, pieces: &[Piece], at: OperatingPoint, out: &mut [Rate]) {
    scratch.pieces.clear();
    scratch.pieces.extend_from_slice(pieces);
    system.switching(at, out, scratch);
}
