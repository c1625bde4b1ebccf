//! The stiff flyball governor as a spatial scene against a computation in its three minimal coordinates, valid while both
//! rods move alike.

mod common;
mod scenes;

use common::fixed;
use holonom::simulate::Span;
use scenes::{Run, shipped};

const OUTPUTS: [&str; 6] = ["psi", "beta", "s", "shaft_speed", "beta_rate", "s_rate"];

/// t and the outputs, to 20 digits.
const REFERENCE: [(usize, [f64; 6]); 3] = [
    (
        1,
        [
            5.586346965869005431513802675260,
            0.5218333016255462310467847271360,
            0.5014209223795676507471939992337,
            6.271125741876554796132386859236,
            0.1408855794795269187339548942598,
            -0.1221514928977289132280999431322,
        ],
    ),
    (
        5,
        [
            27.94253199104295745278884382257,
            0.4828745765869398146325226004223,
            0.5355631037216434844776250125623,
            6.022496499758459035515549463517,
            0.6139170473888895483279876380327,
            -0.5436826902778730637025715307059,
        ],
    ),
    (
        10,
        [
            55.93540990910237876847332432666,
            0.3900737018446450805439630473122,
            0.6196229170613656588228477796388,
            5.548203622654926582502920230127,
            0.8084670513455774002664151637331,
            -0.7476033541643324676853304524283,
        ],
    ),
];

/// Distance of the rows, s: close enough to count the turns of the shaft.
const ROW: f64 = 0.1;

/// Largest errors of psi, beta and s, and of their rates, at a time of the reference.
fn errors(run: &Run, (second, expected): &(usize, [f64; 6])) -> [f64; 2] {
    let row = 10 * second;
    assert_eq!(run.times()[row], *second as f64);
    let error = |i: usize| (run.column(OUTPUTS[i])[row] - expected[i]).abs();
    [0, 3].map(|first| (first..first + 3).map(error).fold(0.0, f64::max))
}

#[test]
fn agrees_with_the_minimal_coordinates() {
    let run = shipped("flyball_governor", &[]).tight(1e-8, 10.0, ROW);
    for state in &REFERENCE {
        let [values, rates] = errors(&run, state);
        // The slider's damper turns an error of 1e-12 m into a rate within 1e-3 s.
        assert!(values < 5e-12 && rates < 1e-8, "{} s: {values:e} {rates:e}", state.0);
    }
    let rods = run.column("beta").into_iter().zip(run.column("beta_left"));
    let apart = rods.map(|(right, left)| (right - left).abs()).fold(0.0, f64::max);
    // Rounding moves the rods apart; the motion does not amplify it.
    assert!(apart < 1e-13, "{apart:e}");
    // The work of the dampers is integrated along with the motion, with its local errors.
    assert!(run.record.energy.unwrap().relative_max_error < 1e-11, "{:?}", run.record.energy);
}

/// Second order at steps that resolve the turning of the shaft but not the springs, whose rate is 5000 1/s.
#[test]
fn implicit_steps_need_not_resolve_the_springs() {
    let ready = shipped("flyball_governor", &[]);
    let span = Span { start: 0.0, end: 1.0, output_step: ROW };
    let error =
        |step: f64| errors(&ready.run(&fixed("index3", "generalized_alpha", "none", step), span), &REFERENCE[0])[0];
    let found = [8e-3, 4e-3, 2e-3].map(error);
    // Halving the step leaves a quarter of the error, less what the largest step has beyond it.
    assert!(found[2] < 6e-5 && found.windows(2).all(|pair| pair[0] > 3.5 * pair[1]), "{found:?}");
}
