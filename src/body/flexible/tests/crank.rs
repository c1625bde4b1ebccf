//! The connecting rod of the IVP test set's problem `crank`, whose source states its matrices.

use super::*;
use crate::body::flexible::Piece;

/// The number that the test set takes for pi.
const PI: f64 = 31415927e-7;

#[test]
fn the_rod_of_the_ivp_test_set() {
    let [l, b, rho, e]: [f64; 4] = [0.3, 0.008, 7870.0, 0.2e12];
    let rod: Elastic<2> = build(
        &json!({
            "frame": "floating", "length": l,
            "material": { "E": e, "rho": rho }, "section": { "rectangle": { "height": b, "width": b } },
            "ritz": {
                "bending": ["sin(3.1415927*x/0.3)", "sin(n*3.1415927*x/0.3)"],
                "axial": ["4*(x/0.3)*(1-x/0.3)", "(x/0.3)*(2*x/0.3-1)"],
                "axial_mass_factor": 15,
            },
        }),
        &[0.0, 0.3],
    )
    .unwrap();
    assert_eq!(rod.names, ["bend1", "bend2", "stretch1", "stretch2"]);
    let fm = rho * b * b * l;
    let fk = e * b * b / l;
    let fb = b * b * l;

    let (mass, stiffness) = matrices(&rod, |_| true);
    let mq = [[0.5, 0., 0., 0.], [0., 0.5, 0., 0.], [0., 0., 8., 1.], [0., 0., 1., 2.]];
    let pi4 = PI.powi(4) * (b / l).powi(2);
    let kq = [
        [pi4 / 24.0, 0., 0., 0.],
        [0., 2.0 / 3.0 * pi4, 0., 0.],
        [0., 0., 16.0 / 3.0, -8.0 / 3.0],
        [0., 0., -8.0 / 3.0, 7.0 / 3.0],
    ];
    for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
        assert_close(mass[(i, j)], fm * mq[i][j], 1e-7 * fm);
        assert_close(stiffness[(i, j)], fk * kq[i][j], 1e-7 * stiffness[(j, j)]);
    }

    let piece: Piece<2> = whole(&rod);
    let cross = |a: usize, b: usize| piece.products[5 * a + b][0][1] - piece.products[5 * a + b][1][0];
    let bq =
        [(0, 2, -16.0 / PI.powi(3)), (0, 3, 8.0 / PI.powi(3) - 1.0 / PI), (1, 3, 0.5 / PI), (0, 1, 0.0), (2, 3, 0.0)];
    for (i, j, value) in bq {
        assert_close(cross(1 + i, 1 + j), rho * fb * value, 1e-7 * rho * fb);
        assert_close(cross(1 + j, 1 + i), -rho * fb * value, 1e-7 * rho * fb);
    }
    let c1 = [0.0, 0.0, 2.0 / 3.0, 1.0 / 6.0];
    let c2 = [2.0 / PI, 0.0, 0.0, 0.0];
    let c12 = [0.0, 0.0, 1.0 / 3.0, 1.0 / 6.0];
    let c21 = [1.0 / PI, -0.5 / PI, 0.0, 0.0];
    for i in 0..4 {
        assert_close(piece.moments[1 + i][0], rho * fb * c1[i], 1e-7 * rho * fb);
        assert_close(piece.moments[1 + i][1], rho * fb * c2[i], 1e-7 * rho * fb);
        let with_place = piece.products[1 + i];
        assert_close(with_place[0][0] + with_place[1][1], rho * fb * l * c12[i], 1e-7 * rho * fb * l);
        assert_close(cross(0, 1 + i), rho * fb * l * c21[i], 1e-7 * rho * fb * l);
    }
    // J2 about the left end.
    assert_close(piece.products[0][0][0] + piece.products[0][1][1], 0.0045339259, 5e-11);
    assert_close(piece.mass, 0.151104, 1e-12);

    let found = frequencies(&rod, |_| true);
    for (found, stated) in found.iter().zip([1277.0, 5107.0, 6841.0, 24613.0]) {
        assert_close(*found, stated, 0.5);
    }
}
