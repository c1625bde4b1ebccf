//! A motion with small and finite perturbations, and its layout in one flat state vector.

use crate::linearize::{Changes, Matrix, State};
use crate::math::kkt::Pattern;
use crate::math::{Piece, Scalar, Taylor};
use crate::system::{Dimensions, MechanicalSystem, Need, Scratch, Structure, SwitchFacts, SystemFacts, Terms};
use std::borrow::Cow;

/// A motion, columns of its variational equations, and perturbed motions.
#[derive(Clone, Debug)]
pub struct Bundle {
    /// Start of the motion, on the constraints.
    pub start: State,
    /// Changes that the constraints allow, integrated by the variational equations.
    pub columns: Changes,
    /// Directions that the constraints allow, n_v rows, which move along: N' = -S G' N - P W N with S the least
    /// corrections in the mass metric and P the solution x of M x + G^T l = f, G x = 0. None: no column.
    pub basis: Matrix,
    /// True for parallel transport, with W the Levi-Civita connection; else W = 0.
    pub is_parallel: bool,
    /// Amplitude of the pulse applied to each column; none: no column has an input.
    pub driven: Vec<f64>,
    /// Perturbed starts, on the constraints, integrated by the full equations.
    pub members: Vec<State>,
    /// Amplitude of the pulse applied to each member; none: no member has an input.
    pub pushes: Vec<f64>,
    /// The input pulse of columns and members, if any.
    pub pulse: Option<Pulse>,
    /// Pieces of the switching functions on which the motion and its columns are evaluated; none: by their arguments.
    pub pieces: Vec<Piece>,
}

impl Bundle {
    /// The motion from a state, without perturbations.
    pub fn of(start: &State) -> Self {
        let columns = Changes::none(start.v.len());
        Bundle {
            start: start.clone(),
            basis: columns.q.clone(),
            is_parallel: true,
            columns,
            driven: Vec::new(),
            members: Vec::new(),
            pushes: Vec::new(),
            pulse: None,
            pieces: Vec::new(),
        }
    }
}

/// An input u(t) = amplitude (4 s (1 - s))^8 for s = (t - start)/width in [0, 1]: smooth to the seventh derivative,
/// largest value `amplitude`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Index of the input.
    pub input: usize,
    /// Start, s.
    pub start: f64,
    /// Width, s.
    pub width: f64,
}

impl Pulse {
    /// Returns the pulse of amplitude 1 at time t, with its first two derivatives.
    pub fn jet(&self, t: f64) -> [f64; 3] {
        let s = (Taylor::<f64>::time(t) - self.start) / self.width;
        if s.x <= 0.0 || s.x >= 1.0 {
            return [0.0; 3];
        }
        let Taylor { x, d, dd } = ((s - s.square()) * 4.0).square().square().square();
        [x, d, dd]
    }
}

/// The bundle at a time.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// The motion.
    pub motion: State,
    /// Its columns (dq, dv).
    pub columns: Changes,
    /// The transported directions.
    pub basis: Matrix,
    /// The perturbed motions.
    pub members: Vec<State>,
}

/// Sizes of the flat state y = (q_0, dq_1 .. dq_k, n_1 .. n_b, q_1 .. q_p; v_0, dv_1 .. dv_k, v_1 .. v_p; work).
#[derive(Clone, Copy, Debug)]
pub struct FlowSizes {
    pub q: usize,
    pub v: usize,
    pub columns: usize,
    pub basis: usize,
    pub members: usize,
}

/// A system of that size, as the integrator sees it, with the switches and time functions of the original.
pub struct Carrier<'a> {
    system: &'a dyn MechanicalSystem,
    dimensions: Dimensions,
}

impl FlowSizes {
    pub fn of(system: &dyn MechanicalSystem, bundle: &Bundle) -> Self {
        let Dimensions { q, v, .. } = system.dimensions();
        FlowSizes {
            q,
            v,
            columns: bundle.columns.q.ncols(),
            basis: bundle.basis.ncols(),
            members: bundle.members.len(),
        }
    }

    pub fn carrier<'a>(&self, system: &'a dyn MechanicalSystem) -> Carrier<'a> {
        let dimensions = Dimensions { q: self.coordinates(), v: self.velocities(), lambda: 0, ..Dimensions::default() };
        Carrier { system, dimensions }
    }

    fn coordinates(&self) -> usize {
        self.q * (1 + self.members) + self.v * (self.columns + self.basis)
    }

    fn velocities(&self) -> usize {
        self.v * (1 + self.members + self.columns)
    }

    /// Splits a flat q into that of the motion, the columns', the basis and the members'.
    pub fn parts<'y>(&self, q: &'y [f64]) -> [&'y [f64]; 4] {
        let (motion, rest) = q.split_at(self.q);
        let (columns, rest) = rest.split_at(self.v * self.columns);
        let (basis, members) = rest.split_at(self.v * self.basis);
        [motion, columns, basis, members]
    }

    /// Splits a flat v in the same way; the basis has no part in it.
    pub fn rates<'y>(&self, v: &'y [f64]) -> [&'y [f64]; 3] {
        let (motion, rest) = v.split_at(self.v);
        let (columns, members) = rest.split_at(self.v * self.columns);
        [motion, columns, members]
    }

    pub fn pack(&self, bundle: &Bundle) -> Vec<f64> {
        let mut y = vec![0.0; self.coordinates() + self.velocities() + 1];
        let motion = bundle.start.clone();
        let columns = bundle.columns.clone();
        let basis = bundle.basis.clone();
        self.repack(&Snapshot { motion, columns, basis, members: bundle.members.clone() }, &mut y);
        y
    }

    pub fn repack(&self, snapshot: &Snapshot, y: &mut [f64]) {
        let Snapshot { motion, columns, basis, members } = snapshot;
        let tangent = columns.q.iter().chain(basis.iter());
        let q = motion.q.iter().chain(tangent).chain(members.iter().flat_map(|member| &member.q));
        let v = motion.v.iter().chain(columns.v.iter()).chain(members.iter().flat_map(|member| &member.v));
        y.iter_mut().zip(q.chain(v)).for_each(|(y, x)| *y = *x);
    }

    pub fn unpack(&self, t: f64, y: &[f64]) -> Snapshot {
        let (q, rest) = y.split_at(self.coordinates());
        let [q, dq, basis, qs] = self.parts(q);
        let [v, dv, vs] = self.rates(&rest[..self.velocities()]);
        let basis = Matrix::from_column_slice(self.v, self.basis, basis);
        let columns = Changes {
            q: Matrix::from_column_slice(self.v, self.columns, dq),
            v: Matrix::from_column_slice(self.v, self.columns, dv),
        };
        let member = |i: usize| State {
            t,
            q: qs[i * self.q..(i + 1) * self.q].to_vec(),
            v: vs[i * self.v..(i + 1) * self.v].to_vec(),
        };
        let members = (0..self.members).map(member).collect();
        Snapshot { motion: State { t, q: q.to_vec(), v: v.to_vec() }, columns, basis, members }
    }
}

impl MechanicalSystem for Carrier<'_> {
    fn dimensions(&self) -> Dimensions {
        self.dimensions
    }

    fn facts(&self) -> Cow<'_, SystemFacts> {
        Cow::Owned(SystemFacts { length: self.system.facts().length, ..SystemFacts::new(self.dimensions) })
    }

    fn switches(&self) -> SwitchFacts<'_> {
        SwitchFacts { owners: &[], ..self.system.switches() }
    }

    fn evaluate(&self, _: f64, _: &[f64], _: &[f64], _: Need, _: &mut Terms, _: &mut Scratch) {}

    fn structure(&self) -> Structure {
        let n = self.dimensions.v;
        let empty = |rows| Pattern { rows, cols: n, entries: Vec::new() };
        Structure::new(empty(n), empty(0), empty(n))
    }
}
