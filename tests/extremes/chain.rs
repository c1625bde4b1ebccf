//! A chain of point masses, joined by rods or springs: as a scene, and as its own equations in 32 digits.

use crate::extremes::double_double::Double;
use crate::scenes::{Ready, parse};

/// What joins a mass to the one before, or to the ground at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Link {
    Rod,
    /// Stiffness, N/m; as long at rest as the link is at the start.
    Spring(f64),
}

/// Link i reaches from mass i - 1 to mass i.
#[derive(Clone, Debug)]
pub struct Chain {
    /// Coordinates of a mass, 2 or 3; gravity along the last but one of 3, the last of 2.
    pub dimension: usize,
    /// kg
    pub masses: Vec<f64>,
    pub links: Vec<Link>,
    /// Lengths of the links, m.
    pub length: f64,
    pub gravity: f64,
    /// Whether it starts in a line.
    pub is_straight: bool,
    /// Of the last mass across the chain at the start, m/s, which assembly makes consistent.
    pub speed: f64,
}

impl Chain {
    /// With links of 1 m that zigzag, at rest.
    pub fn new(dimension: usize, masses: &[f64], links: &[Link]) -> Self {
        let masses = masses.to_vec();
        let links = links.to_vec();
        Chain { dimension, masses, links, length: 1.0, gravity: 9.81, is_straight: false, speed: 0.0 }
    }

    /// Positions of the masses at the start: directions of links that are all unlike.
    fn positions(&self) -> Vec<Vec<f64>> {
        let mut at = vec![0.0; self.dimension];
        let place = |i: usize| {
            let zigzag = if self.is_straight { 0.0 } else { 0.2 * i as f64 - 1.9 * (i % 2) as f64 };
            let turn = if self.dimension == 3 && !self.is_straight { 0.7 * i as f64 } else { 0.0 };
            let angle: f64 = 1.2 + zigzag;
            let step = [angle.sin() * turn.cos(), -angle.cos(), angle.sin() * turn.sin()];
            at.iter_mut().zip(step).for_each(|(x, step)| *x += self.length * step);
            at.clone()
        };
        (0..self.masses.len()).map(place).collect()
    }

    pub fn scene(&self) -> Ready {
        let mut bodies = Vec::new();
        let mut joints = Vec::new();
        let mut forces = Vec::new();
        for (i, (mass, position)) in self.masses.iter().zip(self.positions()).enumerate() {
            let mut velocity = vec![0.0; self.dimension];
            velocity[0] = if i + 1 == self.masses.len() { self.speed } else { 0.0 };
            bodies.push(format!(
                r#"{{ "name": "m{i}", "type": "point_mass", "mass": {mass:e},
                      "initial": {{ "position": {position:?}, "velocity": {velocity:?} }} }}"#
            ));
            let before = if i == 0 { "ground.O".to_string() } else { format!("m{}", i - 1) };
            let between = format!(r#""between": ["{before}", "m{i}"]"#);
            let length = self.length;
            match self.links[i] {
                Link::Rod => joints
                    .push(format!(r#"{{ "name": "rod{i}", "type": "distance", {between}, "length": {length:e} }}"#)),
                Link::Spring(k) => forces.push(format!(
                    r#"{{ "name": "spring{i}", "type": "spring_damper", {between},
                          "stiffness": {k:e}, "damping": 0, "free_length": {length:e} }}"#
                )),
            }
        }
        let mut gravity = vec![0.0; self.dimension];
        gravity[1] = -self.gravity;
        parse(&format!(
            r#"{{ "name": "chain", "dimension": {}, "gravity": {gravity:?},
                 "ground": {{ "markers": {{ "O": {:?} }} }},
                 "bodies": [{}], "joints": [{}], "forces": [{}] }}"#,
            self.dimension,
            vec![0.0; self.dimension],
            bodies.join(", "),
            joints.join(", "),
            forces.join(", ")
        ))
    }
}

/// The equations of a chain: with d_i = r_i - r_{i-1}, tensions T_i = lambda_i |d_i|,
///
/// ```text
/// m_i r_i'' = m_i g - lambda_i d_i + lambda_{i+1} d_{i+1},   d_i d_i'' + d_i'^2 = 0  or  lambda_i = k (1 - l/|d_i|)
/// ```
///
/// tridiagonal in lambda.
pub struct Exact<'c> {
    chain: &'c Chain,
    inverse: Vec<Double>,
    gap: Vec<Double>,
    rate: Vec<Double>,
    diagonal: Vec<Double>,
    upper: Vec<Double>,
    pub lambda: Vec<Double>,
}

impl<'c> Exact<'c> {
    pub fn new(chain: &'c Chain) -> Self {
        let n = chain.masses.len();
        let zeros = |n: usize| vec![Double::ZERO; n];
        let inverse = chain.masses.iter().map(|&m| Double::from(1.0) / m.into()).collect();
        let gap = zeros(n * chain.dimension);
        let rate = zeros(n * chain.dimension);
        Exact { chain, inverse, gap, rate, diagonal: zeros(n), upper: zeros(n), lambda: zeros(n) }
    }

    fn dot(&self, i: usize, j: usize) -> Double {
        let d = self.chain.dimension;
        (0..d).fold(Double::ZERO, |sum, k| sum + self.gap[i * d + k] * self.gap[j * d + k])
    }

    /// y' at y = (r, r').
    pub fn rate(&mut self, y: &[Double], out: &mut [Double]) {
        let d = self.chain.dimension;
        let n = self.chain.masses.len();
        let (r, v) = y.split_at(d * n);
        for i in 0..d * n {
            let before = |x: &[Double]| if i < d { Double::ZERO } else { x[i - d] };
            (self.gap[i], self.rate[i]) = (r[i] - before(r), v[i] - before(v));
        }
        self.solve();
        out[..d * n].copy_from_slice(v);
        for i in 0..n {
            for k in 0..d {
                let below = if i + 1 < n { self.lambda[i + 1] * self.gap[(i + 1) * d + k] } else { Double::ZERO };
                let force = below - self.lambda[i] * self.gap[i * d + k];
                let weight = if k == 1 { -self.chain.gravity } else { 0.0 };
                out[(n + i) * d + k] = force * self.inverse[i] + weight.into();
            }
        }
    }

    /// lambda, by elimination from the first link on.
    fn solve(&mut self) {
        let d = self.chain.dimension;
        let n = self.chain.masses.len();
        let mut lower = Double::ZERO;
        for i in 0..n {
            let square = self.dot(i, i);
            let above = if i > 0 { self.inverse[i - 1] } else { Double::ZERO };
            let (own, mut right) = match self.chain.links[i] {
                Link::Rod => {
                    let speed = (0..d).fold(Double::ZERO, |sum, k| sum + self.rate[i * d + k] * self.rate[i * d + k]);
                    // Gravity moves all masses alike, but not the ground.
                    let fall = if i == 0 { self.gap[1] * (-self.chain.gravity).into() } else { Double::ZERO };
                    self.upper[i] = if i + 1 < n { -(self.dot(i, i + 1) * self.inverse[i]) } else { Double::ZERO };
                    lower = if i > 0 { -(self.dot(i, i - 1) * above) } else { lower };
                    (square * (self.inverse[i] + above), speed + fall)
                }
                Link::Spring(k) => {
                    (self.upper[i], lower) = (Double::ZERO, Double::ZERO);
                    let length = Double::from(self.chain.length) / square.sqrt();
                    (1.0.into(), Double::from(k) * (Double::from(1.0) - length))
                }
            };
            self.diagonal[i] = own;
            if i > 0 {
                let factor = lower / self.diagonal[i - 1];
                self.diagonal[i] = own - factor * self.upper[i - 1];
                right = right - factor * self.lambda[i - 1];
            }
            self.lambda[i] = right;
        }
        for i in (0..n).rev() {
            let above = if i + 1 < n { self.upper[i] * self.lambda[i + 1] } else { Double::ZERO };
            self.lambda[i] = (self.lambda[i] - above) / self.diagonal[i];
        }
    }

    /// (r, r') at `end` from (q, v), and the forces of the rods.
    pub fn run(&mut self, (q, v): (&[f64], &[f64]), end: f64) -> (Vec<f64>, Vec<f64>) {
        let mut y: Vec<Double> = q.iter().chain(v).map(|&x| x.into()).collect();
        let mut method = Extrapolation::new(y.len());
        let mut t = 0.0;
        let mut h = 1e-3 * end;
        while t < end {
            let step = if t + h >= end { end - t } else { h };
            let error = method.attempt(&y, step.into(), self) / TOLERANCE;
            if error <= 1.0 {
                t = if t + h >= end { end } else { t + step };
                y.copy_from_slice(&method.table[ROWS - 1]);
            }
            h = step * (0.8 * error.max(1e-30).powf(-1.0 / (2 * ROWS - 1) as f64)).clamp(0.1, 3.0);
        }
        let mut rate = vec![Double::ZERO; y.len()];
        self.rate(&y, &mut rate);
        let rods = (0..self.lambda.len()).filter(|&i| self.chain.links[i] == Link::Rod);
        let forces = rods.map(|i| (self.lambda[i] * self.dot(i, i).sqrt()).value()).collect();
        (y.iter().map(|x| x.value()).collect(), forces)
    }
}

/// Gragg's midpoint rule with 2, 4 ... 2 `ROWS` steps, extrapolated to order 2 `ROWS`. Source: Hairer, Norsett, Wanner,
/// Solving Ordinary Differential Equations I, II.9.
struct Extrapolation {
    table: Vec<Vec<Double>>,
    slope: Vec<Double>,
    start: Vec<Double>,
    before: Vec<Double>,
    now: Vec<Double>,
}

const ROWS: usize = 9;
/// Local error of the reference, m and m/s in units of the largest.
const TOLERANCE: f64 = 1e-24;

impl Extrapolation {
    fn new(len: usize) -> Self {
        let zeros = || vec![Double::ZERO; len];
        let table = (0..ROWS).map(|_| zeros()).collect();
        Extrapolation { table, slope: zeros(), start: zeros(), before: zeros(), now: zeros() }
    }

    /// Leaves the state after a step in the last row of the table, and returns its error.
    fn attempt(&mut self, y: &[Double], h: Double, equations: &mut Exact) -> f64 {
        equations.rate(y, &mut self.start);
        for row in 0..ROWS {
            let count = 2 * (row + 1);
            let h = h / (count as f64).into();
            self.before.copy_from_slice(y);
            (0..y.len()).for_each(|i| self.now[i] = y[i] + h * self.start[i]);
            for _ in 1..count {
                equations.rate(&self.now, &mut self.slope);
                (0..y.len()).for_each(|i| self.before[i] += h * 2.0.into() * self.slope[i]);
                std::mem::swap(&mut self.before, &mut self.now);
            }
            self.extrapolate(row);
        }
        let [before, last] = [ROWS - 2, ROWS - 1].map(|row| &self.table[row]);
        let size = last.iter().fold(1.0, |size: f64, x| size.max(x.value().abs()));
        let change = before.iter().zip(last).map(|(x, y)| (*y - *x).value().abs());
        // Written so that a NaN is an error.
        change.fold(0.0, |most, change| if change <= most { most } else { change }) / size
    }

    /// Row k of the table becomes T_{row,k}, the first of which is the midpoint rule's end.
    fn extrapolate(&mut self, row: usize) {
        for i in 0..self.now.len() {
            let mut value = self.now[i];
            for k in 0..row {
                let ratio = ((row + 1) * (row + 1)) as f64;
                let finer = Double::from(ratio) / (((row - k) * (row - k)) as f64).into();
                let coarser = std::mem::replace(&mut self.table[k][i], value);
                value += (value - coarser) / (finer - 1.0.into());
            }
            self.table[row][i] = value;
        }
    }
}
