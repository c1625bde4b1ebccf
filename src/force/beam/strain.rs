//! Strains of a beam element, and the stresses that belong to them.

use super::Moving;
use crate::body::flexible::{ReferenceLine, Section};
use crate::body::{Frame, dot, sub};
use crate::math::Scalar;
use crate::math::array::{Each, from_fn};
use crate::math::screw::{Vector, planar_shift, rotation_vector, shift};

/// A beam element: relaxed, its second frame lies `length` along the x axis of the first, bent by a curvature.
///
/// Strains and stresses are in the order extension, shear along y and z, twist, curvature about y and z.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// Length of the relaxed element, m.
    pub length: f64,
    /// EA, GA along y and z, GJ, EI about y and z; N and N m^2. GA includes the residual bending flexibility, since a
    /// helix cannot bend by a shear force.
    pub(super) stiffness: [f64; 6],
    /// Strains of the relaxed element.
    pub(super) rest: [f64; 6],
    /// Fraction of the shear strain, along y and z, that represents bending.
    pub(super) bent: [f64; 2],
    /// One over EA, GA along y and z, GJ, EI about y and z of the sections at the ends; zero for what the beam does not
    /// do.
    pub(super) compliance: [[f64; 6]; 2],
    /// Stress is stiffness times (strain + damping times its rate), s.
    pub(super) damping: f64,
}

/// Relative motion of the end frames: the logarithm of the screw from one to the other, and their gap, in the first's
/// axes.
pub(super) struct Strains<S> {
    pub gap: Vector<Moving<S>>,
    pub turn: Vector<Moving<S>>,
    pub shift: Vector<Moving<S>>,
}

impl<S: Scalar> Strains<S> {
    #[inline]
    pub fn between<const D: usize>(a: &Frame<Moving<S>, D>, b: &Frame<Moving<S>, D>) -> Self {
        let zero = Moving::fixed(S::zero());
        let way = sub(&b.r, &a.r);
        let gap = from_fn(|i| if i < D { dot(&a.axes[i], &way) } else { zero });
        if D == 2 {
            // The angle in the plane is counted through full turns.
            let angle = b.turn - a.turn;
            let [x, y] = planar_shift(angle, [gap[0], gap[1]]);
            return Strains { gap, turn: [zero, zero, angle], shift: [x, y, zero] };
        }
        let turn = rotation_vector(&from_fn(|i| from_fn(|j| dot(&a.axes[i], &b.axes[j]))));
        Strains { gap, turn, shift: shift(&turn, &gap) }
    }
}

/// The numbers of the strains that are not zero in the plane, or in space.
pub(super) fn components<const D: usize>() -> &'static [usize] {
    if D == 2 { &[0, 1, 5] } else { &[0, 1, 2, 3, 4, 5] }
}

impl Beam {
    /// An element of a beam with this section; in the plane only axial force, shear along y and bending about z act.
    ///
    /// The shear force of an element changes the bending moment along it, which a helix cannot show. MacNeal's residual
    /// bending flexibility puts that into the shear: 1/GA* = 1/GA + L^2/(12 EI) (Comput. Structures 8 (1978) 175-183).
    /// The statics of a straight element are then exact, with sections that shear or do not (GA infinite).
    ///
    /// `curvature` is that of the relaxed element, 1/m: twist, about y and about z; `damping` is in s.
    pub fn new<const D: usize>(section: &Section, length: f64, curvature: [f64; 3], damping: f64) -> Self {
        let [about_y, about_z] = section.ei;
        let bending = [about_z, about_y].each(|ei| length * length / (12.0 * ei));
        let [along_y, along_z]: [f64; 2] = from_fn(|i| 1.0 / (1.0 / section.ga[i] + bending[i]));
        let [twist, about] = match D {
            2 => [0.0, 0.0],
            _ => [section.gj, about_y],
        };
        let stiffness = [section.ea, along_y, if D == 2 { 0.0 } else { along_z }, twist, about, about_z];
        let rest = [1.0, 0.0, 0.0, curvature[0], curvature[1], curvature[2]];
        let bent = [along_y * bending[0], along_z * bending[1]];
        Beam { length, stiffness, rest, bent, compliance: [section.compliance::<D>(); 2], damping }
    }

    /// An element of a tapered beam, given the sections at its ends; its own section must have the mean compliance.
    #[must_use]
    pub fn tapered<const D: usize>(self, ends: [Section; 2]) -> Self {
        Beam { compliance: ends.each(|section| section.compliance::<D>()), ..self }
    }

    /// One over EA, GA along y and z, GJ, EI about y and z of the sections at the ends; zero for what the beam does not
    /// do.
    pub fn compliance(&self) -> &[[f64; 6]; 2] {
        &self.compliance
    }

    /// Twist and curvature about y and z of the relaxed beam, 1/m.
    pub fn curvature(&self) -> [f64; 3] {
        [self.rest[3], self.rest[4], self.rest[5]]
    }

    /// Point of the relaxed beam at `x` from its first end, in the axes there, m.
    pub fn relaxed(&self, x: f64) -> [f64; 3] {
        ReferenceLine { length: self.length, curvature: self.curvature() }.at(x).1
    }

    /// Ratio of the length of the bent line to that of the relaxed one, from the logarithm's shift per length. A line
    /// inclined by phi(x) is longer than its chord by the mean of phi^2/2, which for the cubic of a shear force is 0.6
    /// of its squared mean; a shear g of the sections adds phi g. Under the root this holds for small shear, and for
    /// any shear the line is at least as long as its chord: without that, tension above 12 EI/L^2 would rotate the
    /// sections away from it.
    fn stretch<S: Scalar, const D: usize>(&self, shift: Vector<S>) -> S {
        let [x, y, z] = shift;
        let [long_y, long_z] = self.lengthening();
        let square = x * x + y * y * long_y;
        let square = if D == 2 { square } else { square + z * z * long_z };
        // Ends that coincide have no direction.
        if square.value() > 0.0 { square.sqrt() } else { x }
    }

    fn lengthening(&self) -> [f64; 2] {
        self.bent.each(|bent| 2.0 * bent * (1.0 - 0.4 * bent))
    }

    /// The strains at the middle of the element, that of extension counted from zero length. A curvature that grows
    /// along the element by k' L from end to end lets the logarithm of the motion differ from the strain in the middle
    /// by L^2 [strain, strain']/12 (Magnus): in the shift this is the shear g of [`Beam::new`], with k' L^2/12 = g x
    /// e_x; in the turn it is taken off here.
    #[inline]
    pub(super) fn strain<S: Scalar, const D: usize>(&self, strains: &Strains<S>) -> [Moving<S>; 6] {
        let per_length = 1.0 / self.length;
        if D == 2 {
            let ([x, y, zero], k) = (strains.shift, strains.turn[2] * per_length);
            let x = x * per_length;
            let y = y * per_length;
            return [self.stretch::<_, D>([x, y, zero]), y, zero, zero, zero, k];
        }
        let [x, y, z] = strains.shift.each(|u| u * per_length);
        let k = strains.turn.each(|a| a * per_length);
        let gy = y * self.bent[0];
        let gz = z * self.bent[1];
        [self.stretch::<_, D>([x, y, z]), y, z, k[0] + gy * k[1] + gz * k[2], k[1] - gy * k[0], k[2] - gz * k[0]]
    }

    /// Force and moment conjugate to the logarithm of the motion, as the stresses are to [`strain`](Beam::strain): its
    /// transposed derivative times the stresses.
    #[inline]
    pub(super) fn conjugate<S: Scalar, const D: usize>(&self, strains: &Strains<S>, stress: &[S; 6]) -> [Vector<S>; 2] {
        let per_length = 1.0 / self.length;
        let [x, y, z] = strains.shift.each(|u| u.re * per_length);
        let [long_y, long_z] = self.lengthening();
        let [n, qy, qz, torque, my, mz] = *stress;
        let long = self.stretch::<_, D>([x, y, z]);
        let tension = if long.value() > 0.0 { n / long } else { n };
        if D == 2 {
            return [[x * tension, qy + y * tension * long_y, qz], [torque, my, mz]];
        }
        let k = strains.turn.each(|a| a.re * per_length);
        let gy = y * self.bent[0];
        let gz = z * self.bent[1];
        let force = [
            x * tension,
            qy + y * tension * long_y + (k[1] * torque - k[0] * my) * self.bent[0],
            qz + z * tension * long_z + (k[2] * torque - k[0] * mz) * self.bent[1],
        ];
        [force, [torque - gy * my - gz * mz, my + gy * torque, mz + gz * torque]]
    }
}
