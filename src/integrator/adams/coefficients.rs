//! Constants of a step among steps of other sizes.

use crate::math::array::from_fn;
/// The highest order of the prediction; the corrected solution has one more.
pub const MOST: usize = 12;

/// Room for the constants of one order more than the highest, and for one beyond that, which estimates its error.
pub const ROOM: usize = MOST + 2;

/// Constants of the steps of sizes h, h_1, h_2 ... before it, the last one first, by index i - 1 for i = 1, 2 ...
///
/// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, III.5; Shampine, Gordon, Computer
/// Solution of Ordinary Differential Equations, Freeman 1975, ch. 5.
#[derive(Clone)]
pub struct Coefficients {
    /// psi_i = h + h_1 + ... + h_{i-1}: time from the end of the step back to the i-th point before it, s.
    pub psi: [f64; ROOM],
    /// beta_i, by which the differences of the last step become those of steps in sequence with this one.
    pub beta: [f64; ROOM],
    /// g_i, weights of the differences in the prediction.
    pub g: [f64; ROOM],
    /// sigma_i = (i - 1)! h^(i-1) / (psi_1 ... psi_{i-1}): a difference times that is one of steps of equal size.
    pub sigma: [f64; ROOM + 1],
}

impl Coefficients {
    /// No step.
    pub const NONE: Self = Coefficients { psi: [0.0; ROOM], beta: [0.0; ROOM], g: [0.0; ROOM], sigma: [0.0; ROOM + 1] };

    /// The first `count` of them for a step of size `h`.
    pub fn new(h: f64, past: &[f64; ROOM], count: usize) -> Self {
        let mut all = Coefficients { beta: [1.0; ROOM], sigma: [1.0; ROOM + 1], ..Self::NONE };
        // Time from the start of the step back to the point, and g_i = c_i1 with c_1q = 1/q, c_2q = 1/(q (q + 1)),
        // c_iq = c_{i-1,q} - h/psi_{i-1} c_{i-1,q+1}.
        let mut back = 0.0;
        let mut part = 0.0;
        let mut c = SECOND;
        for (i, step) in past.iter().take(count).enumerate() {
            if i > 1 {
                let c = &mut c[..=count - i];
                (1..c.len()).for_each(|q| c[q - 1] -= part * c[q]);
            }
            all.g[i] = if i > 0 { c[0] } else { 1.0 };
            all.psi[i] = h + back;
            if i > 0 {
                all.beta[i] = all.beta[i - 1] * all.psi[i - 1] / back;
            }
            part = h / all.psi[i];
            all.sigma[i + 1] = (i + 1) as f64 * part * all.sigma[i];
            back += step;
        }
        all
    }

    /// Weights, by i - 1, of the first `count` differences at the end of the step in the integral of the polynomial
    /// through them from there over `ahead` seconds (below zero within the step), over `ahead`.
    pub fn interpolation(&self, ahead: f64, count: usize) -> [f64; ROOM] {
        let mut w: [f64; ROOM] = from_fn(|i| 1.0 / (i + 1) as f64);
        let mut g = [0.0; ROOM];
        let mut term = 0.0;
        g[0] = 1.0;
        for j in 1..count {
            let psi = self.psi[j - 1];
            let kept = (ahead + term) / psi;
            let next = ahead / psi;
            let w = &mut w[..=count - j];
            (1..w.len()).for_each(|i| w[i - 1] = kept * w[i - 1] - next * w[i]);
            g[j] = w[0];
            term = psi;
        }
        g
    }
}

/// c_2q = 1/(q (q + 1)) by q - 1.
const SECOND: [f64; ROOM] = {
    let mut c = [0.0; ROOM];
    let mut q = 0;
    while q < ROOM {
        c[q] = 1.0 / ((q + 1) * (q + 2)) as f64;
        q += 1;
    }
    c
};

/// |gamma*_j|, constants of the implicit formulas of equal steps: the error of order j is |gamma*_j| h nabla^j y'.
/// Source: Hairer, Norsett, Wanner I, III.1 (1.8): sum_{i=0..m} gamma*_i / (m + 1 - i) = 0 for m > 0, gamma*_0 = 1.
pub fn error_constants() -> [f64; ROOM] {
    let mut gamma = [0.0; ROOM];
    gamma[0] = 1.0;
    for m in 1..ROOM {
        gamma[m] = -(0..m).map(|i| gamma[i] / (m + 1 - i) as f64).sum::<f64>();
    }
    gamma.map(f64::abs)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hairer, Norsett, Wanner I, III.1, tables 1.1 and 1.2.
    #[test]
    fn equal_steps_have_the_constants_of_the_books() {
        let all = Coefficients::new(0.1, &[0.1; ROOM], 6);
        let explicit = [1.0, 1.0 / 2.0, 5.0 / 12.0, 3.0 / 8.0, 251.0 / 720.0, 95.0 / 288.0];
        let implicit = [1.0, 1.0 / 2.0, 1.0 / 12.0, 1.0 / 24.0, 19.0 / 720.0, 3.0 / 160.0, 863.0 / 60480.0];
        let off = |found: &[f64], expected: &[f64]| {
            found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        assert!(off(&all.g, &explicit) < 1e-15 && off(&error_constants(), &implicit) < 1e-15);
        assert!(off(&all.beta[..6], &[1.0; 6]) < 1e-15 && off(&all.sigma[..6], &[1.0; 6]) < 1e-15);
    }
}
