//! The mass of an absolute beam, lumped at its nodes.
//!
//! Half an element adds to its node the consistent loads of its mass with Hermite's cubics: N_1 = 1 - 3 x^2 + 2 x^3
//! and, times the length h of the element, N_2 = x - 2 x^2 + x^3, x being the part of h from the node. Mass and centre
//! of mass of the element are then exact, whatever its taper; of a uniform one it is half the mass, put h/6 from the
//! node.

use crate::body::flexible::{Profile, Section, gauss_legendre, on_interval};
use crate::force::Half;
use crate::math::array::from_fn;

/// Gauss points on an element.
const POINTS: usize = 6;

/// Mass of half an element, lumped at its node.
#[derive(Clone, Copy, Debug)]
struct Lump {
    /// Mass, kg.
    mass: f64,
    /// Mass times its distance from the node along the beam, kg m.
    moment: f64,
    /// Rotary inertia of the sections about y and z, kg m^2.
    rotary: [f64; 2],
    /// Length of the element, m.
    length: f64,
    /// Section at the node.
    section: Section,
}

impl Lump {
    /// The half of the element between the abscissae `ends` at its first or second node.
    fn of(profile: &Profile, ends: [f64; 2], second: bool) -> Self {
        let length = ends[1] - ends[0];
        let (node, sign) = if second { (ends[1], -1.0) } else { (ends[0], 1.0) };
        let section = profile.within(ends, node);
        let mut lump = Lump { mass: 0.0, moment: 0.0, rotary: [0.0; 2], length, section };
        for (x, weight) in on_interval(&gauss_legendre(POINTS), [0.0, 1.0]) {
            let here = profile.at(node + sign * x * length);
            let share = weight * length * (1.0 - x * x * (3.0 - 2.0 * x));
            lump.mass += here.rho_a * share;
            lump.moment += here.rho_a * weight * sign * length * length * x * (1.0 - x) * (1.0 - x);
            (0..2).for_each(|i| lump.rotary[i] += here.rho_i[i] * share);
        }
        lump
    }
}

/// A node with the halves of the elements before and after it; one of them at an end.
pub struct NodeMass {
    before: Option<Lump>,
    after: Option<Lump>,
}

impl NodeMass {
    /// The mass of node `node` of a beam with nodes at the `abscissae`.
    pub fn of(profile: &Profile, abscissae: &[f64], node: usize) -> Self {
        let lump = |first: usize, second| {
            let ends = [*abscissae.get(first)?, *abscissae.get(first + 1)?];
            Some(Lump::of(profile, ends, second))
        };
        NodeMass { before: node.checked_sub(1).and_then(|first| lump(first, true)), after: lump(node, false) }
    }

    fn sum(&self, of: impl Fn(&Lump) -> f64) -> f64 {
        self.before.iter().chain(&self.after).map(of).sum()
    }

    /// Mass of the node, kg.
    pub fn mass(&self) -> f64 {
        self.sum(|lump| lump.mass)
    }

    /// Distance of the node's centre of mass from the node along the beam, m; positive towards the right end.
    pub fn shift(&self) -> f64 {
        self.sum(|lump| lump.moment) / self.mass()
    }

    /// Moments of inertia about y and z, kg m^2.
    pub fn about(&self) -> [f64; 2] {
        from_fn(|i| match self.sum(|lump| lump.rotary[i]) {
            inertia if inertia > 0.0 => inertia,
            // Rotary inertia, for M must have an inverse. It lowers the square of a frequency by 1e-4 (k h)^2, with the
            // wave number k and the length h, and lumping lowers it by (k h)^4/720. The first part is the smaller one
            // unless both are below 1e-5. The nodes' own rotation is forty times as fast as the shortest wave.
            _ => 1e-4 * self.mass() * self.longest().powi(2),
        })
    }

    fn longest(&self) -> f64 {
        self.before.iter().chain(&self.after).map(|lump| lump.length).fold(0.0, f64::max)
    }

    /// The half of the element after (or before) the node.
    pub fn half(&self, after: bool) -> Half {
        let Some(lump) = (if after { self.after } else { self.before }) else { return Half::default() };
        let share = lump.mass / self.mass();
        let about = self.about();
        let small = |i: usize| lump.rotary[i] == 0.0;
        let moment = |i: usize| if small(i) { share * about[i] } else { lump.rotary[i] };
        let per_length = |i: usize| if small(i) { 2.0 / lump.length * moment(i) } else { lump.section.rho_i[i] };
        Half {
            mass: lump.mass,
            arm: lump.moment / lump.mass,
            shifted: lump.mass * self.shift().powi(2),
            moments: [moment(1), moment(0)],
            mass_per_length: lump.section.rho_a,
            moments_per_length: [per_length(1), per_length(0)],
        }
    }
}
