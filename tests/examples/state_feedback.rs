//! A controller of one's own: a linear model of a crane, feedback from it, and the run under it.

use holonom::linear::Matrix;
use holonom::prelude::*;

/// u = -K x with the least integral of x^T Q x + u^2/1e6, by the Riccati equation P' = A^T P + P A - P B B^T P/r + Q.
fn lqr(a: &Matrix, b: &Matrix) -> Matrix {
    let price = 1e-6;
    let mut weights = Matrix::zeros(4, 4);
    // Position, sway and speed.
    [1.0, 100.0, 1.0].into_iter().enumerate().for_each(|(i, weight)| weights[(i, i)] = weight);
    let mut p = Matrix::zeros(4, 4);
    let gain = |p: &Matrix| b.transpose() * p / price;
    for _ in 0..40_000 {
        let rate = a.transpose() * &p + &p * a - &p * b * gain(&p) + &weights;
        p += rate * 5e-4;
    }
    gain(&p)
}

fn main() -> holonom::Result<()> {
    let crane = Model::load("tests/examples/crane.json")?.set("load", 120.0)?;
    let model = crane.linearize_at(0.8, &Linear::in_coordinates(["trolley.x", "rope.angle"]))?;
    let k = lqr(&model.a, &model.b);
    let reference = model.state.clone();
    let mut run = crane.run().input("drive", every(0.01, move |x| -(&k * x.minus(&reference))[0]));
    run.to(10.0)?;
    println!("{:.3e}", run.record().output("trolley_x")?.last());

    // The value is that of the two equations of motion in x and the angle, integrated by rk4 outside of this crate.
    assert!((run.record().output("trolley_x")?.last() - 1.85358e-3).abs() < 1e-6);
    // Without feedback the gust has driven the trolley off.
    let mut free = crane.run();
    free.to(10.0)?;
    assert!(free.record().output("trolley_x")?.last().abs() > 1.0);
    Ok(())
}

#[test]
fn a_crane_comes_back_after_a_gust() -> holonom::Result<()> {
    main()
}
