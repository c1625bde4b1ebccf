//! The differential-algebraic equations with multipliers as unknowns, stated once for all methods that solve them.

/// The constraint that a multiplier enforces: 0 = c_0 phi + c_1 phi' + c_2 phi''.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DaeRow {
    /// c_0: 1/s^2 if `acceleration` is nonzero, else 1/s if `velocity` is.
    pub position: f64,
    /// c_1: 1/s if `acceleration` is nonzero.
    pub velocity: f64,
    /// c_2, dimensionless.
    pub acceleration: f64,
}

impl DaeRow {
    /// phi
    pub const POSITION: DaeRow = DaeRow { position: 1.0, velocity: 0.0, acceleration: 0.0 };
    /// phi' = G v + phi_t
    pub const VELOCITY: DaeRow = DaeRow { position: 0.0, velocity: 1.0, acceleration: 0.0 };
    /// phi'' = G v' - gamma
    pub const ACCELERATION: DaeRow = DaeRow { position: 0.0, velocity: 0.0, acceleration: 1.0 };

    /// Highest derivative of phi in the row: 0, 1 or 2.
    pub fn level(self) -> usize {
        match self {
            DaeRow { acceleration, .. } if acceleration != 0.0 => 2,
            DaeRow { velocity, .. } if velocity != 0.0 => 1,
            _ => 0,
        }
    }

    /// The row for a constraint without a position, A v + a = 0.
    fn without_position(self) -> DaeRow {
        if self.level() == 0 { DaeRow::VELOCITY } else { DaeRow { position: 0.0, ..self } }
    }

    /// Value of the row for one constraint.
    pub fn value(self, phi: f64, phi_dot: f64, phi_ddot: f64) -> f64 {
        self.position * phi + self.velocity * phi_dot + self.acceleration * phi_ddot
    }
}

/// ```text
/// q' = N (v + u),   M u + G^T mu = 0        u = 0 where there is no mu
/// v' = a + w,       M w + G^T eta = 0       w = 0 where there is no eta
/// M a + G^T lambda = f
/// 0 = the rows of lambda, eta and mu, with phi'' = G a - gamma
/// ```
///
/// A nonholonomic constraint, A v + a = 0, has no position: phi' and phi'' take the rows of lambda and eta, and mu has
/// none. The exact motion has mu = eta = 0. Methods use the equations by a [`Residual`](super::Residual), an
/// [`Iteration`](super::Iteration) and the [`velocity_index`](Self::velocity_index).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dae {
    /// DaeRow that lambda enforces.
    pub lambda: DaeRow,
    /// DaeRow that eta enforces by the velocity shift w; usually phi'.
    pub eta: Option<DaeRow>,
    /// DaeRow that mu enforces by the position shift u; usually phi.
    pub mu: Option<DaeRow>,
}

impl Dae {
    /// Equations without shifts: lambda enforces `lambda`.
    pub const fn with(lambda: DaeRow) -> Self {
        Dae { lambda, eta: None, mu: None }
    }

    fn rows(&self) -> impl Iterator<Item = DaeRow> {
        [Some(self.lambda), self.eta, self.mu].into_iter().flatten()
    }

    /// True if some row enforces the constraints at this level, 0 to 2.
    pub fn holds(&self, level: usize) -> bool {
        self.rows().any(|row| row.level() == level)
    }

    /// The rows of the nonholonomic constraints.
    pub fn nonholonomic(&self) -> Dae {
        let eta = self.eta.filter(|row| row.level() > 0).map(DaeRow::without_position);
        Dae { lambda: self.lambda.without_position(), eta, mu: None }
    }

    /// Index of v in the sense of the error of a step: 2 where phi = 0 alone determines its constrained part, by a
    /// division by h, else 1.
    pub fn velocity_index(&self) -> usize {
        if self.rows().all(|row| row.level() == 0) { 2 } else { 1 }
    }

    /// Rate by which phi returns to zero, 1/s; `None` where no row contains phi together with its second derivative.
    pub fn gain(&self) -> Option<f64> {
        let DaeRow { position, acceleration, .. } = self.lambda;
        (position > 0.0 && acceleration > 0.0).then(|| (position / acceleration).sqrt())
    }

    /// Time over which the rounding of q becomes one of v in a step of size `h`, s: `h` where phi = 0 alone determines
    /// v, 1/gain where phi returns to zero, and `h` where it does so within the step. `None` where v does not follow
    /// from phi.
    pub fn rounding_time(&self, h: f64) -> Option<f64> {
        if self.velocity_index() == 2 { Some(h) } else { self.gain().map(|gain| h.max(1.0 / gain)) }
    }

    /// True if q or v is shifted by multipliers of its own, mu or eta.
    pub fn has_shifts(&self) -> bool {
        self.eta.is_some() || self.mu.is_some()
    }

    /// True if the derivatives of the rows with respect to q contain L = d(G v + phi_t)/dq.
    pub fn needs_l(&self) -> bool {
        self.rows().any(|row| row.level() > 0)
    }
}
