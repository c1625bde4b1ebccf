//! The stiff flyball governor as a spatial scene against a computation in its three minimal coordinates, valid while
//! both rods move alike.

use crate::common::{adaptive, fixed};
use crate::scenes::{Run, shipped};
use holonom::simulate::Span;

const OUTPUTS: [&str; 6] = ["psi", "beta", "s", "shaft_speed", "beta_rate", "s_rate"];

/// t and the outputs.
const REFERENCE: [(usize, [f64; 6]); 3] = [
    (
        1,
        [
            5.586346965869005,
            0.5218333016255462,
            0.5014209223795677,
            6.2711257418765545,
            0.14088557947952693,
            -0.12215149289772892,
        ],
    ),
    (
        5,
        [
            27.94253199104296,
            0.48287457658693983,
            0.5355631037216435,
            6.022496499758459,
            0.6139170473888895,
            -0.5436826902778731,
        ],
    ),
    (
        10,
        [
            55.935409909102376,
            0.39007370184464507,
            0.6196229170613656,
            5.548203622654927,
            0.8084670513455774,
            -0.7476033541643324,
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
    assert!(run.record.energy.unwrap().relative_max_error.unwrap() < 1e-11, "{:?}", run.record.energy);
}

/// The springs are so stiff that errors of 1e-6 m/s show in their force: as shipped it is known all the same.
#[test]
fn the_spring_force_is_as_good_as_the_motion() {
    let ready = shipped("flyball_governor", &[]);
    let span = Span { start: 0.0, end: 1.0, output_step: 0.01 };
    let force = |run: Run| run.column("spring_force");
    let own = force(ready.run(&ready.0.method, span));
    let exact = force(ready.run(&adaptive("index1", "dop853", "manifold", 1e-11), span));
    let error = own.iter().zip(&exact).map(|(own, exact)| (own - exact).abs()).fold(0.0, f64::max);
    let largest = exact.iter().fold(0.0, |largest: f64, force| largest.max(force.abs()));
    assert!(error < 1e-5 * largest, "{error:e} of {largest}");
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

/// Collocation steps over the dampers, whose rate is 8000 1/s, at any accuracy: dop853 takes 10,400 steps to 5 s. The turn of
/// the shaft amplifies local errors about 100 times: at 1e-4 the last digit of the tolerance moves the error from 5e-3 to 1.2e-2.
#[test]
fn collocation_reaches_the_reference_in_a_tenth_of_the_steps() {
    let ready = shipped("flyball_governor", &[]);
    let span = Span { start: 0.0, end: 5.0, output_step: ROW };
    for (tolerance, most) in [(1e-4, 2e-2), (1e-7, 2e-5), (1e-10, 2e-8)] {
        let run = ready.run(&adaptive("ggl", "radau_iia", "none", tolerance), span);
        let [values, rates] = errors(&run, &REFERENCE[1]);
        println!("{tolerance:e}: {values:e} {rates:e} {:?}", run.outcome.statistics);
        assert!(values < most && run.outcome.statistics.steps < 1042, "{tolerance:e}: {values:e}");
    }
}
