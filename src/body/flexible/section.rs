//! Stiffness and inertia of a beam's section.

use super::spec::Theory;
use crate::math::array::{Each, from_fn};
use std::f64::consts::PI;

/// Stiffness and inertia of a section with principal axes y and z; in the plane those about z and along y are used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Axial stiffness EA, N.
    pub ea: f64,
    /// Shear stiffness GA along y and z with the shear factor, N; infinite if sections stay normal to the line.
    pub ga: [f64; 2],
    /// Torsional stiffness GJ, N m^2; zero in the plane.
    pub gj: f64,
    /// Bending stiffness EI about y and about z, N m^2.
    pub ei: [f64; 2],
    /// Mass per length, kg/m.
    pub rho_a: f64,
    /// Moments of inertia per length about y and about z, kg m.
    pub rho_i: [f64; 2],
}

impl Section {
    /// The section of these numbers: EA, GA along y and z, GJ, EI about y and z, rho A, rho I about y and z.
    pub(super) fn of(numbers: [f64; 9]) -> Self {
        let [ea, gy, gz, gj, ey, ez, rho_a, iy, iz] = numbers;
        Section { ea, ga: [gy, gz], gj, ei: [ey, ez], rho_a, rho_i: [iy, iz] }
    }

    /// Its numbers in the same order.
    pub(super) fn numbers(&self) -> [f64; 9] {
        let Section { ea, ga, gj, ei, rho_a, rho_i } = *self;
        [ea, ga[0], ga[1], gj, ei[0], ei[1], rho_a, rho_i[0], rho_i[1]]
    }

    /// Stiffness for extension, shear along y and z, twist and bending about y and z; zero for shear that is excluded.
    pub fn stiffness(&self) -> [f64; 6] {
        let numbers = self.numbers();
        from_fn(|i| if numbers[i].is_finite() { numbers[i] } else { 0.0 })
    }

    /// Compliance in the same order; zero for shear that is excluded and for components that a planar beam does not
    /// have.
    pub fn compliance<const D: usize>(&self) -> [f64; 6] {
        let numbers = self.numbers();
        let acts = |i: usize| D == 3 || matches!(i, 0 | 1 | 5);
        from_fn(|i| if acts(i) { 1.0 / numbers[i] } else { 0.0 })
    }

    pub(super) fn of_theory(self, theory: Theory) -> Section {
        match theory {
            Theory::EulerBernoulli => Section { ga: [f64::INFINITY; 2], ..self },
            Theory::Timoshenko => self,
        }
    }
}

/// Material: E and G, Pa, and density, kg/m^3.
#[derive(Clone, Copy, Debug)]
pub(super) struct Matter {
    pub e: f64,
    pub g: f64,
    pub rho: f64,
}

impl Matter {
    pub fn fill(&self, shape: &SectionOutline, dimension: usize) -> Section {
        let Matter { e, g, rho } = *self;
        Section {
            ea: e * shape.area,
            ga: [g * shape.area * shape.shear; 2],
            gj: if dimension == 3 { g * shape.torsion } else { 0.0 },
            ei: shape.second.each(|i| e * i),
            rho_a: rho * shape.area,
            rho_i: shape.second.each(|i| rho * i),
        }
    }
}

/// Geometry of a section.
pub(super) struct SectionOutline {
    area: f64,
    /// Second moments of area about y and z, m^4.
    second: [f64; 2],
    torsion: f64,
    /// Shear factor.
    shear: f64,
}

impl SectionOutline {
    /// A rectangle of height `h` along y and width `b` along z, m.
    pub fn rectangle(h: f64, b: f64) -> Self {
        let second = [h * b.powi(3) / 12.0, b * h.powi(3) / 12.0];
        SectionOutline { area: h * b, second, torsion: torsion_of_rectangle(h, b), shear: 5.0 / 6.0 }
    }

    /// A tube, or a full circle if the inner radius is zero.
    pub fn circle(outer: f64, inner: f64) -> Self {
        let second = PI / 4.0 * (outer.powi(4) - inner.powi(4));
        let area = PI * (outer.powi(2) - inner.powi(2));
        // Cowper's factor for nu = 0 (J. Appl. Mech. 33 (1966) 335-340): 6/7 for a full circle, 1/2 for a thin tube.
        let ratio = (inner / outer).powi(2);
        let shear = 6.0 * (1.0 + ratio).powi(2) / (7.0 * (1.0 + ratio).powi(2) + 20.0 * ratio);
        SectionOutline { area, second: [second; 2], torsion: 2.0 * second, shear }
    }
}

/// Saint-Venant's torsion constant of a rectangle: a b^3 (1/3 - 64/pi^5 (b/a) sum_odd tanh(n pi a/(2b))/n^5), a >= b
/// (Timoshenko and Goodier, Theory of Elasticity, section 109).
fn torsion_of_rectangle(h: f64, b: f64) -> f64 {
    let long = h.max(b);
    let short = h.min(b);
    let term = |n: f64| (n * PI * long / (2.0 * short)).tanh() / n.powi(5);
    let sum: f64 = (0..200).map(|k| term(f64::from(2 * k + 1))).sum();
    long * short.powi(3) * (1.0 / 3.0 - 64.0 / PI.powi(5) * (short / long) * sum)
}
