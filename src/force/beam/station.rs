//! Position and internal forces of a section between the ends of a beam element.

use super::half::Load;
use super::line::ElementLine;
use super::strain::Strains;
use super::{Beam, Moving, in_axes};
use crate::body::Frame;
use crate::math::array::{Each, from_fn};
use crate::math::screw::{Vector, cross3, dot3};
use crate::math::{Scalar, Taylor};

/// A section of a beam: its position and its internal forces.
///
/// Forces are in the order axial force, shear forces along y and z, torque, bending moments about y and z, in the
/// section's axes. They act on the section from the side of larger abscissae. The elastic ones times the compliances of
/// the section are its strains against the relaxed beam: extension, shear, twist, curvatures.
#[derive(Clone, Debug, PartialEq)]
pub struct Station<S, const D: usize> {
    /// Position in the world, m.
    pub r: [S; D],
    /// Internal forces without damping, N and N m.
    pub elastic: [S; 6],
    /// Internal forces with damping, N and N m.
    pub force: [S; 6],
}

/// Internal force, N, and moment, N m, of a section, in the axes of the element's first end.
#[derive(Clone, Copy, Debug)]
pub(super) struct SectionForces<S> {
    pub n: Vector<S>,
    pub m: Vector<S>,
}

impl Beam {
    /// The section at `x` from the first end, 0 <= x <= length, for the frames of its ends and no load on the
    /// element between them.
    pub fn station<S: Scalar, const D: usize>(&self, ends: [&Frame<Taylor<S>, D>; 2], x: f64) -> Station<S, D> {
        self.loaded_station(ends, &[Load::none(); 2], x)
    }

    /// The section at `x` where `loads` act on the halves of the element.
    ///
    /// The forces of the element on its ends are exact in equilibrium for any length of it; with the loads of its
    /// halves they are the internal forces of the end sections. Between these, force and moment follow from
    /// equilibrium, n' + f = 0 and m' + r' x n + l = 0: cubics with the right values and slopes at both ends, but for
    /// -(r - r_0) x n_0, which is as exact as the line. Straight elements under loads at their ends and uniform ones
    /// between are exact; others to the fourth power of the length.
    pub fn loaded_station<S: Scalar, const D: usize>(
        &self,
        ends: [&Frame<Taylor<S>, D>; 2],
        loads: &[Load<S>; 2],
        x: f64,
    ) -> Station<S, D> {
        let [a, b] = ends.each(|frame| frame.map(|x| Moving { re: x.x, eps: [x.d] }));
        let strains = Strains::between(&a, &b);
        let middle = self.strain::<_, D>(&strains);
        let loads = loads.each_ref().each(|load| load.map(|v| in_axes(&a, v)));
        let elastic: [S; 6] = from_fn(|i| (middle[i].re - self.rest[i]) * self.stiffness[i]);
        let viscous: [S; 6] = from_fn(|i| middle[i].eps[0] * (self.damping * self.stiffness[i]));
        let elastic = loaded(self.carried::<_, D>(&strains, &elastic), &loads);
        let viscous = self.carried::<_, D>(&strains, &viscous);
        let line = ElementLine::new(self, &strains, &elastic);
        let part = x / self.length;
        let (axes, place) = line.at(part);
        let in_section = |carried: SectionForces<S>| -> [S; 6] {
            from_fn(|i| dot3(&axes[i % 3], if i < 3 { &carried.n } else { &carried.m }))
        };
        let elastic = in_section(line.between(&elastic, &loads, part, &place));
        let viscous = in_section(line.between(&viscous, &[Load::none(); 2], part, &place));
        let first = ends[0];
        Station {
            r: from_fn(|i| (0..D).fold(first.r[i].x, |sum, j| sum + first.axes[j][i].x * place[j])),
            elastic,
            force: from_fn(|i| elastic[i] + viscous[i]),
        }
    }
}

/// Internal forces of the end sections with the loads of the halves added.
fn loaded<S: Scalar>(ends: [SectionForces<S>; 2], loads: &[Load<S>; 2]) -> [SectionForces<S>; 2] {
    let [a, b] = ends;
    let add = |v: &Vector<S>, w: &Vector<S>, sign: f64| from_fn(|i| v[i] + w[i] * sign);
    let with = |c: &SectionForces<S>, load: &Load<S>, sign| SectionForces {
        n: add(&c.n, &load.force, sign),
        m: add(&c.m, &load.torque, sign),
    };
    [with(&a, &loads[0], 1.0), with(&b, &loads[1], -1.0)]
}

/// Cubics over 0..1 by their value at 1 and their slopes at 0 and 1; zero at 0 (Hermite).
pub(super) fn cubic(part: f64) -> [f64; 3] {
    let rest = 1.0 - part;
    [part * part * (3.0 - 2.0 * part), part * rest * rest, -part * part * rest]
}

impl<S: Scalar> ElementLine<S> {
    /// Internal forces of the section at 0 <= `part` <= 1 of the element and at `place`, by equilibrium with the ends.
    fn between(
        &self,
        ends: &[SectionForces<S>; 2],
        loads: &[Load<S>; 2],
        part: f64,
        place: &Vector<S>,
    ) -> SectionForces<S> {
        let [a, b] = ends;
        let [value, first, last] = cubic(part);
        let first = first * self.length;
        let last = last * self.length;
        let growth: Vector<S> = from_fn(|i| b.n[i] - a.n[i]);
        let turned = cross3(&self.tangent, &growth);
        let arm = cross3(&self.gap, &a.n);
        let moved = cross3(place, &a.n);
        let [f, l] = [loads.each_ref().each(|x| x.force_per_length), loads.each_ref().each(|x| x.torque_per_length)];
        SectionForces {
            n: from_fn(|i| a.n[i] + growth[i] * value - f[0][i] * first - f[1][i] * last),
            m: from_fn(|i| {
                let rest = b.m[i] - a.m[i] + arm[i];
                a.m[i] - moved[i] + rest * value - l[0][i] * first - (turned[i] + l[1][i]) * last
            }),
        }
    }
}
