//! A flexible body in a floating frame, by its shape functions.
//!
//! A point of the body is at u = psi_0 + sum_i psi_i q_i + sum_ij psi_ij q_i q_j/2 in the floating frame: psi_0 its
//! position at rest, psi_i its displacement function of elastic coordinate i, psi_ij its second-order one of two of
//! them. All that the equations of motion need of the mass to second order in q is in
//!
//! ```text
//! m_a = int rho psi_a dV,   P_ab = int rho psi_a psi_b^T dV      (a, b = 0, 1, ...),
//! m_ij = int rho psi_ij dV,   P_0ij = int rho psi_0 psi_ij^T dV,
//! ```
//!
//! computed once (Shabana, Dynamics of Multibody Systems, chapter 5: the shape integrals; Wallrapp, Standardization of
//! Flexible Body Modeling in Multibody System Codes, Mechanics of Structures and Machines 22, 1994: their second
//! order).

use super::section::Section;
use crate::body::Frame;
use crate::math::Scalar;
pub use crate::modes::natural::Symmetric;

/// Mass integrals of a body or of a part of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MassIntegrals<const D: usize> {
    /// Integrals of the distributed mass, one piece for each finite element or one for all.
    pub pieces: Vec<Piece<D>>,
    /// Rotary inertia of the sections of a beam, whose mass is on its line.
    pub discs: Vec<Disc>,
}

/// The sections about a point of integration of a beam: a thin disc that is turned by the small rotation
/// a = sum_i r_i q_i, in space by Cayley's rotation of this vector.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// The elastic coordinates that turn it, each once.
    pub dofs: Vec<usize>,
    /// r_i, in the order of `dofs`.
    pub rotation: Vec<[f64; 3]>,
    /// Inertia tensor of the undeformed disc in the frame's axes, row by row, kg m^2; in the plane only zz is used.
    pub inertia: [[f64; 3]; 3],
}

/// A part of a body, a finite element or all of it, whose displacements depend on a few elastic coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Piece<const D: usize> {
    /// Its elastic coordinates among those of the body, n of them, each once.
    pub dofs: Vec<usize>,
    /// Mass, kg.
    pub mass: f64,
    /// m_a, 1 + n of them.
    pub moments: Vec<[f64; D]>,
    /// P_ab with `products[a * (1 + n) + b]`, (1 + n)^2 of them; P_ba = P_ab^T.
    pub products: Vec<[[f64; D]; D]>,
    /// m_ij and P_0ij for each i, n of them, with those j for which they are not zero.
    pub second: Vec<Vec<Second<D>>>,
}

impl<const D: usize> Piece<D> {
    /// A piece of these coordinates without mass.
    pub fn massless(dofs: Vec<usize>) -> Self {
        let n = 1 + dofs.len();
        let moments = vec![[0.0; D]; n];
        let products = vec![[[0.0; D]; D]; n * n];
        Piece { dofs, mass: 0.0, moments, products, second: vec![Vec::new(); n - 1] }
    }

    /// Adds a point mass with its displacement functions psi_a, 1 + n of them.
    pub fn add_point<const E: usize>(&mut self, psi: &[[f64; E]], mass: f64) {
        self.mass += mass;
        for (a, left) in psi.iter().enumerate() {
            (0..D).for_each(|k| self.moments[a][k] += mass * left[k]);
            for (b, right) in psi.iter().enumerate() {
                let product = &mut self.products[a * psi.len() + b];
                (0..D).for_each(|k| (0..D).for_each(|m| product[k][m] += mass * left[k] * right[m]));
            }
        }
    }
}

/// Integrals of psi_ij, equal to those of psi_ji.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Second<const D: usize> {
    /// Place of j among the piece's coordinates.
    pub other: usize,
    /// m_ij
    pub moment: [f64; D],
    /// P_0ij
    pub product: [[f64; D]; D],
}

impl<const D: usize> Second<D> {
    /// self += factor other
    pub fn add(&mut self, factor: f64, other: &Self) {
        let into = |sums: &mut [f64], values: &[f64]| sums.iter_mut().zip(values).for_each(|(s, x)| *s += factor * x);
        into(&mut self.moment, &other.moment);
        into(self.product.as_flattened_mut(), other.product.as_flattened());
    }

    /// True if any of the integrals is not zero.
    pub fn counts(&self) -> bool {
        self.moment.iter().chain(self.product.as_flattened()).any(|x| *x != 0.0)
    }
}

/// Displacement and rotation functions of a point of the body.
#[derive(Clone, Debug, PartialEq)]
pub struct PointShape<const D: usize> {
    /// Position at rest, from the floating frame's origin and in its axes, m.
    pub rest: [f64; D],
    /// Vector from the line of a beam to the point at rest, in the same axes, m; it rotates with the section.
    pub arm: [f64; D],
    /// The elastic coordinates that move it.
    pub dofs: Vec<usize>,
    /// Displacement per unit of each coordinate, to first order.
    pub translation: Vec<[f64; D]>,
    /// Small rotation per unit of each coordinate; in the plane only the third component is used.
    pub rotation: Vec<[f64; 3]>,
    /// Matrix S of the displacement q.S q/2 along x by which the line shortens as it bends, row by row; else empty.
    pub shortening: Vec<f64>,
}

impl<const D: usize> PointShape<D> {
    /// Displacement of the point, without the second-order rotation of its arm.
    #[inline]
    pub fn displacement<S: Scalar>(&self, coordinate: impl Fn(usize) -> S) -> [S; D] {
        let mut u = [S::zero(); D];
        for (&dof, translation) in self.dofs.iter().zip(&self.translation) {
            let q = coordinate(dof);
            u.iter_mut().zip(translation).filter(|(_, t)| **t != 0.0).for_each(|(u, &t)| *u += q * t);
        }
        for i in 0..self.shortening_rows() {
            u[0] += coordinate(self.dofs[i]) * self.shortening_of(i, &coordinate) * 0.5;
        }
        u
    }

    /// d(u_x)/dq_i of the shortening: sum_j S_ij q_j.
    #[inline]
    pub fn shortening_of<S: Scalar>(&self, i: usize, coordinate: impl Fn(usize) -> S) -> S {
        let row = self.shortening[i * self.dofs.len()..].iter().zip(&self.dofs);
        row.fold(S::zero(), |sum, (&s, &dof)| sum + coordinate(dof) * s)
    }

    fn shortening_rows(&self) -> usize {
        if self.shortening.is_empty() { 0 } else { self.dofs.len() }
    }
}

/// Strain functions of a section: extension, shear along y and z, twist, curvature about y and z.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionShape {
    /// Indices of the elastic coordinates that deform the section.
    pub dofs: Vec<usize>,
    /// Strains per unit of each coordinate.
    pub strains: Vec<[f64; 6]>,
}

/// A part of a beam whose axial force stiffens its bending (von Karman): with the mean extension a.q of the line and
/// its mean squared slope q.S q, its energy is weight ((a.q)^2 + a.q q.S q + quartic (q.S q)^2/4)/2, of which (a.q)^2
/// is in the stiffness.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// Abscissae of its ends, m.
    pub ends: [f64; 2],
    /// Indices of the elastic coordinates that stretch this part.
    pub dofs: Vec<usize>,
    /// EA times the length of the part, N m.
    pub weight: f64,
    /// 1: the energy is weight (a.q + q.S q/2)^2/2; 0: without the last term.
    pub quartic: f64,
    /// a: mean of u' per unit of each coordinate.
    pub axial: Vec<f64>,
    /// S: mean of w_y' w_y' + w_z' w_z' for each pair of coordinates, row by row.
    pub slopes: Vec<f64>,
}

/// The line of a beam with its displacement functions.
pub trait Line<const D: usize>: Send + Sync {
    /// Length of the undeformed line, m.
    fn length(&self) -> f64;
    /// Frame of the undeformed section at `s`, in the floating frame.
    fn at_rest(&self, s: f64) -> Frame<f64, D>;
    /// Displacement functions of the point `place` = [s, y(, z)], 0 <= s <= length, which rotates with its section.
    fn point(&self, place: [f64; D]) -> PointShape<D>;
    /// Strains of the section at `s` per unit of each elastic coordinate.
    fn section(&self, s: f64) -> SectionShape;
    /// Stiffness and mass of the section at `s`.
    fn material(&self, s: f64) -> Section;
    /// Mass integrals from `s` to the right end.
    fn beyond(&self, s: f64) -> MassIntegrals<D>;
}

/// Inertia, stiffness and damping of a flexible body in a floating frame.
pub struct Elastic<const D: usize> {
    /// Names of the elastic coordinates, such as `n3_y` or `mode2`.
    pub names: Vec<String>,
    /// Distributed mass with its displacement functions.
    pub inertia: MassIntegrals<D>,
    /// Stiffness matrix K of the elastic coordinates.
    pub stiffness: Symmetric,
    /// Damping matrix of the elastic coordinates.
    pub damping: Symmetric,
    /// Parts of a beam with geometric stiffening; empty without it.
    pub stretches: Vec<Stretch>,
    /// The line, if the body is a beam.
    pub line: Option<Box<dyn Line<D>>>,
}
