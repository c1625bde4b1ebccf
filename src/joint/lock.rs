//! The kernel behind most joints: some relative translations and rotations of two frames are locked.

use super::{Axis, BuiltJoint, ClosedForm, JointKernel};
use crate::body::{Build, Frame, dot, in_space, sub, unit_axes};
use crate::error::{Error, Result};
use crate::math::array::{Each, from_fn};
use crate::math::expression::Number;
use crate::math::{Scalar, Time};
use std::f64::consts::TAU;

/// Locks some relative translations and rotations of marker B against marker A.
///
/// Translation rows: e_i . (r_B - r_A), along world axes when all are locked (then G is constant in r), else along the
/// axes of A. Rotation rows: in the plane turn_B - turn_A less full turns, as a ring of beams closes after one; in space e_i(A) . e_j(B) for pairs of different axes. The
/// pairs of a joint share one axis, so that no row of G vanishes at a quarter turn about the free axis, as with cyclic
/// pairs.
#[derive(Clone)]
pub struct Lock<const D: usize> {
    /// Axes of A along which B is locked.
    pub translation: &'static [usize],
    /// Pairs of axes (of A, of B) kept at right angles; in the plane any pair stands for the angle.
    pub rotation: &'static [(usize, usize)],
    /// The joint's axes in both markers, by rows.
    pub triad: Option<[[f64; D]; D]>,
}

/// Pairs that leave rotation about the third axis free.
pub const ALL_BUT_Z: &[(usize, usize)] = &[(2, 0), (2, 1)];
/// Pairs that leave no rotation free.
pub const ALL: &[(usize, usize)] = &[(2, 0), (2, 1), (0, 1)];
pub const NONE: &[(usize, usize)] = &[];

const TRANSLATIONS: [&str; 3] = ["x", "y", "z"];

impl<const D: usize> Lock<D> {
    /// Locks these translations and rotations, along the axes of the markers.
    pub fn new(translation: &'static [usize], rotation: &'static [(usize, usize)]) -> Self {
        Lock { translation, rotation, triad: None }
    }

    /// The joint with its axis number `principal` along `direction` in both markers instead of along the marker's own
    /// axis.
    pub fn along(mut self, principal: usize, direction: Option<[f64; D]>) -> Self {
        self.triad = direction.map(|direction| triad(principal, direction));
        self
    }

    /// The joint between two markers, which must be on different bodies and have an orientation if a rotation is
    /// locked.
    pub fn between(self, names: &[String; 2], build: &Build<D>) -> Result<BuiltJoint<D>> {
        let markers = build.between(names)?;
        if !self.rotation.is_empty() {
            build.oriented("between", &markers)?;
        }
        Ok(BuiltJoint { joint: Box::new(self), markers })
    }

    /// Axis `i` of the joint in the world, at the frame of one of its markers.
    #[inline]
    pub fn axis<S: Scalar>(&self, frame: &Frame<S, D>, i: usize) -> [S; D] {
        match &self.triad {
            None => frame.axes[i],
            Some(triad) => from_fn(|k| {
                let parts = frame.axes.iter().zip(triad[i]).map(|(axis, part)| axis[k] * part);
                parts.fold(S::zero(), |sum, part| sum + part)
            }),
        }
    }
}

impl<const D: usize> JointKernel<D> for Lock<D> {
    fn row_names(&self) -> Vec<&'static str> {
        let rotations = self.rotation.iter().map(|pair| match pair {
            _ if D == 2 => "angle",
            (2, 0) => "ry",
            (2, 1) => "rx",
            _ => "rz",
        });
        self.translation.iter().map(|&i| TRANSLATIONS[i]).chain(rotations).collect()
    }

    fn depends_on_time(&self) -> bool {
        false
    }

    fn joint_axis(&self, first: &Frame<f64, D>) -> Option<Axis> {
        match (D, self.translation.len()) {
            // A hinge in the plane has its axis normal to it; spherical and universal joints have none.
            (2, 2) => None,
            (3, 3) if self.rotation.len() < 2 => None,
            (2, _) => Some(Axis::Along(in_space(&self.axis(first, 0)))),
            _ => Some(Axis::Along(in_space(&self.axis(first, 2)))),
        }
    }

    fn closed_form(&self) -> Option<ClosedForm<D>> {
        Some(ClosedForm::Lock(self.clone()))
    }

    #[inline]
    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], _: Time<S>, out: &mut [S]) {
        let [a, b] = [&frames[0], &frames[1]];
        let gap = sub(&b.r, &a.r);
        let (translations, rotations) = out.split_at_mut(self.translation.len());
        if translations.len() == D {
            translations.copy_from_slice(&gap);
        } else {
            for (row, &i) in translations.iter_mut().zip(self.translation) {
                *row = dot(&self.axis(a, i), &gap);
            }
        }
        for (row, &(i, j)) in rotations.iter_mut().zip(self.rotation) {
            *row = if D == 2 { within_half_turn(b.turn - a.turn) } else { dot(&self.axis(a, i), &self.axis(b, j)) };
        }
    }
}

/// An angle less the nearest number of full turns.
pub fn within_half_turn<S: Scalar>(angle: S) -> S {
    angle - TAU * (angle.value() / TAU).round()
}

/// Right-handed orthonormal axes, by rows; number `principal` is along `direction`.
fn triad<const D: usize>(principal: usize, direction: [f64; D]) -> [[f64; D]; D] {
    let mut axes = unit_axes::<f64, D>();
    let length = dot(&direction, &direction).sqrt();
    let main = direction.each(|x| x / length);
    if D == 2 {
        (axes[0][0], axes[0][1]) = (main[0], main[1]);
        (axes[1][0], axes[1][1]) = (-main[1], main[0]);
        return axes;
    }
    let helper = (0..D).min_by(|&i, &j| main[i].abs().total_cmp(&main[j].abs())).unwrap_or(0);
    let mut second: [f64; D] = from_fn(|i| if i == helper { 1.0 } else { 0.0 });
    let along = dot(&second, &main);
    second = from_fn(|i| second[i] - along * main[i]);
    let norm = dot(&second, &second).sqrt();
    second = second.each(|x| x / norm);
    let third = crate::body::cross(&main, &second);
    axes[principal] = main;
    axes[(principal + 1) % D] = second;
    axes[(principal + 2) % D] = from_fn(|i| third[i]);
    axes
}

/// The direction of a joint axis in both markers.
pub fn direction<const D: usize>(build: &Build<D>, axis: &Option<Vec<Number>>) -> Result<Option<[f64; D]>> {
    let Some(numbers) = axis else { return Ok(None) };
    let direction = build.vector::<D>("axis", numbers)?;
    if direction.iter().all(|&x| x == 0.0) {
        Err(Error::input("the axis has no direction").under("axis").hint("give a vector that is not zero"))
    } else {
        Ok(Some(direction))
    }
}
