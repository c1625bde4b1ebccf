//! Weight and inertia forces of a part of the body, for internal forces at a section.

use super::point::turn;
use crate::body::flexible::{Disc, Piece};
use crate::body::{Frame, Wrench, cross};
use crate::math::array::{Each, from_fn};
use crate::math::{Scalar, Taylor};

/// Weight less inertia of a piece, about the origin of the floating frame; `coordinate` gives an elastic coordinate
/// with its velocity and acceleration. With the axes e_k of the frame and u_k along them, as functions of time,
///
/// ```text
/// force  = m (g - r'') - sum_k (e_k s_k)''                                       s_k = int rho u_k
/// torque = sum_k e_k x (s_k (g - r'') - sum_l int rho u_k (e_l u_l)'')
/// ```
pub fn load<S: Scalar, const D: usize>(
    piece: &Piece<D>,
    own: &Frame<Taylor<S>, D>,
    coordinate: impl Fn(usize) -> Taylor<S> + Copy,
    gravity: &[f64; D],
) -> Wrench<S, D> {
    let Sums { s, products } = Sums::of(piece, coordinate);
    let lift: [S; D] = from_fn(|i| -own.r[i].dd + gravity[i]);
    let turned = |components: &[Taylor<S>; D]| -> [S; D] {
        from_fn(|i| (0..D).fold(S::zero(), |sum, l| sum + (own.axes[l][i] * components[l]).dd))
    };
    let moving = turned(&s);
    let mut torque = [S::zero(); 3];
    for (axis, (s, product)) in own.axes.iter().zip(s.iter().zip(&products)) {
        let inertia = turned(product);
        let pull: [S; D] = from_fn(|i| s.x * lift[i] - inertia[i]);
        let moment = cross(&axis.each(|e| e.x), &pull);
        (0..3).for_each(|i| torque[i] += moment[i]);
    }
    Wrench { force: from_fn(|i| lift[i] * piece.mass - moving[i]), torque }
}

/// Inertia torque of a disc: with its axes e_k, those of the frame rotated with the section, and
/// P = tr(J)/2 - J, the integral of the products of two coordinates,
///
/// ```text
/// torque = -sum_kl P_kl e_k x e_l''
/// ```
pub fn resistance<S: Scalar, const D: usize>(
    disc: &Disc,
    own: &Frame<Taylor<S>, D>,
    coordinate: impl Fn(usize) -> Taylor<S>,
) -> Wrench<S, D> {
    let mut a = [Taylor::fixed(S::zero()); 3];
    for (&dof, turn) in disc.dofs.iter().zip(&disc.rotation) {
        let q = coordinate(dof);
        (0..3).for_each(|k| a[k] += q * turn[k]);
    }
    let turned = turn(*own, &a);
    let half: f64 = (0..3).map(|k| disc.inertia[k][k]).sum::<f64>() / 2.0;
    let mut wrench = Wrench::zero();
    for (k, l) in (0..D).flat_map(|k| (0..D).map(move |l| (k, l))) {
        let product = if k == l { half - disc.inertia[k][k] } else { -disc.inertia[k][l] };
        let moment = cross(&turned.axes[k].each(|e| e.x), &turned.axes[l].each(|e| e.dd));
        (0..3).for_each(|i| wrench.torque[i] -= moment[i] * product);
    }
    wrench
}

/// Integrals of u over a piece.
struct Sums<S, const D: usize> {
    /// int rho u_k
    s: [Taylor<S>; D],
    /// int rho u_k u_l with the rates of u_l alone, row by row.
    products: [[Taylor<S>; D]; D],
}

impl<S: Scalar, const D: usize> Sums<S, D> {
    fn of(piece: &Piece<D>, coordinate: impl Fn(usize) -> Taylor<S> + Copy) -> Self {
        let zero = Taylor::fixed(S::zero());
        let width = piece.dofs.len() + 1;
        let p = |a: usize| if a == 0 { Taylor::fixed(S::one()) } else { coordinate(piece.dofs[a - 1]) };
        let mut sums = Sums { s: [zero; D], products: [[zero; D]; D] };
        for a in 0..width {
            let p_a = p(a);
            (0..D).for_each(|k| sums.s[k] += p_a * piece.moments[a][k]);
            let mut row = [[zero; D]; D];
            for (b, product) in piece.products[a * width..(a + 1) * width].iter().enumerate() {
                let p_b = p(b);
                let all = row.iter_mut().flatten().zip(product.iter().flatten());
                all.filter(|(_, product)| **product != 0.0).for_each(|(sum, &product)| *sum += p_b * product);
            }
            for (sum, x) in sums.products.iter_mut().flatten().zip(row.iter().flatten()) {
                *sum += Taylor::new(p_a.x * x.x, p_a.x * x.d, p_a.x * x.dd);
            }
        }
        sums.add_second(piece, coordinate);
        sums
    }

    /// Adds the integrals of psi_ij q_i q_j/2, with psi_0 as the other factor.
    fn add_second(&mut self, piece: &Piece<D>, coordinate: impl Fn(usize) -> Taylor<S>) {
        for (i, second) in
            piece.second.iter().enumerate().flat_map(|(i, row)| row.iter().map(move |second| (i, second)))
        {
            let half = coordinate(piece.dofs[i]) * coordinate(piece.dofs[second.other]) * 0.5;
            (0..D).for_each(|k| self.s[k] += half * second.moment[k]);
            for (k, l) in (0..D).flat_map(|k| (0..D).map(move |l| (k, l))) {
                self.products[k][l] += half * second.product[k][l] + Taylor::fixed(half.x * second.product[l][k]);
            }
        }
    }
}
