//! The mass integrals of one piece at a state.
//!
//! With phi_i = du/dq_i = psi_i + sum_j psi_ij q_j, to second order in q:
//!
//! ```text
//! s    = int rho u         = m_0 + sum_i q_i m_i + sum_ij q_i q_j m_ij/2
//! mu_i = int rho phi_i     = m_i + sum_j q_j m_ij
//! W_i  = int rho u phi_i^T = P_0i + sum_j q_j (P_ji + P_0ij)
//! P    = int rho u u^T     = P_00 + sum_i q_i (P_0i + P_i0) + sum_ij q_i q_j (P_ij + (P_0ij + P_0ij^T)/2)
//! ```

use super::algebra::*;
use crate::body::flexible::Piece;
use crate::math::Scalar;
use crate::math::array::{Each, from_fn};

/// One piece at a state.
pub(super) struct MovingPiece<'a, S, const D: usize> {
    pub piece: &'a Piece<D>,
    /// All elastic coordinates and velocities of the body.
    pub q: &'a [S],
    pub v: &'a [S],
    pub curves: &'a Curves<D>,
}

/// Second-order integrals of a piece, in the form in which they are used.
pub(super) struct Curves<const D: usize> {
    /// P_ji + P_0ij at `[j * n + i]`; empty if all P_0ij are zero.
    bent: Vec<Tensor<f64, D>>,
    /// True if there are m_ij; `swerves`: if ax(sum_ij q_i' q_j' P_0ij) is not zero.
    drifts: bool,
    swerves: bool,
}

impl<const D: usize> Curves<D> {
    pub fn of(piece: &Piece<D>) -> Self {
        let n = piece.dofs.len();
        let all = || piece.second.iter().flatten();
        let mut bent = Vec::new();
        if all().next().is_some() {
            bent.extend(
                (0..n)
                    .flat_map(|j| (0..n).map(move |i| (j, i)))
                    .map(|(j, i)| piece.products[(j + 1) * (n + 1) + i + 1]),
            );
            for (i, second) in piece.second.iter().enumerate().flat_map(|(i, row)| row.iter().map(move |x| (i, x))) {
                add_matrix(&mut bent[second.other * n + i], 1.0, &second.product);
            }
        }
        let drifts = all().any(|second| second.moment != [0.0; D]);
        Curves { bent, drifts, swerves: drifts || all().any(|second| axial(&second.product) != [0.0; 3]) }
    }
}

impl<S: Scalar, const D: usize> MovingPiece<'_, S, D> {
    /// First moment s.
    pub fn s(&self) -> [S; D] {
        let mut s = self.piece.moments[0].map(S::constant);
        for (i, &dof) in self.piece.dofs.iter().enumerate() {
            let x = self.q[dof];
            add_scaled(&mut s, x, &self.piece.moments[i + 1]);
            if self.curves.drifts {
                add_scaled(&mut s, x * 0.5, &self.drift(self.q, i));
            }
        }
        s
    }

    /// Derivative mu_i of s by q_i.
    #[inline]
    pub fn mu(&self, i: usize) -> [S; D] {
        let mut mu = if self.curves.drifts { self.drift(self.q, i) } else { [S::zero(); D] };
        add_scaled(&mut mu, S::one(), &self.piece.moments[i + 1]);
        mu
    }

    /// sum_i x_i mu_i; s' if x are the velocities.
    pub fn momentum(&self, x: &[S]) -> [S; D] {
        let mut sum = [S::zero(); D];
        for (i, &dof) in self.piece.dofs.iter().enumerate() {
            add_scaled(&mut sum, x[dof], &self.mu(i));
        }
        sum
    }

    /// Integral W_i of rho u phi_i^T.
    #[inline]
    pub fn w(&self, i: usize) -> Tensor<S, D> {
        let n = self.piece.dofs.len();
        if self.curves.bent.is_empty() {
            return self.against(i + 1);
        }
        let mut sum = self.piece.products[i + 1].each(|row| row.map(S::constant));
        for (j, &dof) in self.piece.dofs.iter().enumerate() {
            add_matrix(&mut sum, self.q[dof], &self.curves.bent[j * n + i]);
        }
        sum
    }

    /// sum_i x_i W_i; int rho u u'^T if x are the velocities.
    pub fn flow(&self, x: &[S]) -> Tensor<S, D> {
        let mut sum = [[S::zero(); D]; D];
        for (i, &dof) in self.piece.dofs.iter().enumerate() {
            if x[dof] != S::zero() {
                add_matrix(&mut sum, x[dof], &self.w(i));
            }
        }
        sum
    }

    /// sum_j x_j P_ji; int rho u' psi_i^T if x are the velocities.
    #[inline]
    pub fn rated(&self, x: &[S], i: usize) -> Tensor<S, D> {
        self.sum_of_products(x, i + 1)
    }

    /// P, the symmetric part of P_00 + sum_j q_j P_j0 + sum_i q_i W_i.
    pub fn p(&self) -> Tensor<S, D> {
        let mut sum = self.flow(self.q);
        add_matrix(&mut sum, S::one(), &self.against(0));
        symmetric(&sum)
    }

    /// sum_j x_j m_ij
    #[inline]
    pub fn drift(&self, x: &[S], i: usize) -> [S; D] {
        let mut sum = [S::zero(); D];
        for second in &self.piece.second[i] {
            add_scaled(&mut sum, x[self.piece.dofs[second.other]], &second.moment);
        }
        sum
    }

    /// sum_j x_j P_0ij
    #[inline]
    pub fn curved(&self, x: &[S], i: usize) -> Tensor<S, D> {
        let mut sum = [[S::zero(); D]; D];
        for second in &self.piece.second[i] {
            add_matrix(&mut sum, x[self.piece.dofs[second.other]], &second.product);
        }
        sum
    }

    /// sum_ij x_i x_j m_ij and ax(sum_ij x_i x_j P_0ij).
    pub fn swerve(&self, x: &[S]) -> ([S; D], [S; 3]) {
        let mut drift = [S::zero(); D];
        let mut curved = [[S::zero(); D]; D];
        if !self.curves.swerves {
            return (drift, [S::zero(); 3]);
        }
        for (i, &dof) in self.piece.dofs.iter().enumerate() {
            add_scaled(&mut drift, x[dof], &self.drift(x, i));
            add_matrix(&mut curved, x[dof], &self.curved(x, i));
        }
        (drift, axial(&curved))
    }

    /// int rho u psi_b^T to first order in q, b = 0 for psi_0 and 1 + i for psi_i.
    #[inline]
    pub fn against(&self, b: usize) -> Tensor<S, D> {
        let mut sum = self.sum_of_products(self.q, b);
        add_matrix(&mut sum, S::one(), &self.piece.products[b]);
        sum
    }

    /// sum_j x_j P_jb
    #[inline]
    fn sum_of_products(&self, x: &[S], b: usize) -> Tensor<S, D> {
        let width = self.piece.dofs.len() + 1;
        let mut sum = [[S::zero(); D]; D];
        for (j, &dof) in self.piece.dofs.iter().enumerate() {
            add_matrix(&mut sum, x[dof], &self.piece.products[(j + 1) * width + b]);
        }
        sum
    }
}

/// (m + m^T)/2
#[inline]
pub(super) fn symmetric<S: Scalar, const D: usize>(m: &Tensor<S, D>) -> Tensor<S, D> {
    from_fn(|i| from_fn(|j| (m[i][j] + m[j][i]) * 0.5))
}
