//! Dae with multipliers as unknowns, stated once for all methods that solve them.

/// What a multiplier holds at zero: c_0 phi + c_1 phi' + c_2 phi''.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// 1/s^2 beside `acceleration`, 1/s beside `velocity`.
    pub position: f64,
    /// 1/s beside `acceleration`.
    pub velocity: f64,
    pub acceleration: f64,
}

impl Row {
    /// phi
    pub const POSITION: Row = Row { position: 1.0, velocity: 0.0, acceleration: 0.0 };
    /// phi' = G v + phi_t
    pub const VELOCITY: Row = Row { position: 0.0, velocity: 1.0, acceleration: 0.0 };
    /// phi'' = G v' - gamma
    pub const ACCELERATION: Row = Row { position: 0.0, velocity: 0.0, acceleration: 1.0 };

    /// How often phi is differentiated in the row: 0, 1 or 2.
    pub fn level(self) -> usize {
        match self {
            Row { acceleration, .. } if acceleration != 0.0 => 2,
            Row { velocity, .. } if velocity != 0.0 => 1,
            _ => 0,
        }
    }

    /// What stands for it where a constraint has no position, A v + a = 0.
    fn without_position(self) -> Row {
        if self.level() == 0 { Row::VELOCITY } else { Row { position: 0.0, ..self } }
    }

    /// Its value for one constraint.
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
/// A nonholonomic constraint, A v + a = 0, has no position: its phi' and phi'' stand in the rows of lambda and eta, and
/// nothing in that of mu. The exact motion has mu = eta = 0. What a method makes of them: a [`Residual`](super::Residual), an
/// [`Iteration`](super::Iteration) and [`velocity_index`](Self::velocity_index).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dae {
    pub lambda: Row,
    pub eta: Option<Row>,
    pub mu: Option<Row>,
}

impl Dae {
    /// One row a constraint.
    pub const fn with(lambda: Row) -> Self {
        Dae { lambda, eta: None, mu: None }
    }

    fn rows(&self) -> impl Iterator<Item = Row> {
        [Some(self.lambda), self.eta, self.mu].into_iter().flatten()
    }

    /// Whether the constraints of this level, 0 to 2, hold.
    pub fn holds(&self, level: usize) -> bool {
        self.rows().any(|row| row.level() == level)
    }

    /// The same for nonholonomic constraints.
    pub fn nonholonomic(&self) -> Dae {
        let eta = self.eta.filter(|row| row.level() > 0).map(Row::without_position);
        Dae { lambda: self.lambda.without_position(), eta, mu: None }
    }

    /// Index of v in the sense of the error of a step: 2 where phi = 0 alone determines its constrained part, by a
    /// division by h, else 1.
    pub fn velocity_index(&self) -> usize {
        if self.rows().all(|row| row.level() == 0) { 2 } else { 1 }
    }

    /// Whether q or v is moved by multipliers of its own.
    pub fn has_shifts(&self) -> bool {
        self.eta.is_some() || self.mu.is_some()
    }

    /// Whether the rows change with L = d(G v + phi_t)/dq, to first order.
    pub fn needs_l(&self) -> bool {
        self.rows().any(|row| row.level() > 0)
    }
}
