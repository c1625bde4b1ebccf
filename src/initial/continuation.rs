//! Continuation in one parameter.

/// Moves a parameter from `at` to `target` in steps, the first of the size `first`. `reach` continues the solution to a
/// value, and returns the factor of the next step; where it does not come there, the step is halved. Ends where a step
/// falls below `least`; returns the value reached, and that step.
pub fn continuation(
    mut at: f64,
    target: f64,
    first: f64,
    least: f64,
    mut reach: impl FnMut(f64) -> Option<f64>,
) -> (f64, f64) {
    let mut step = first;
    // Halving to the resolution of a sweep takes 27, to that of a travel 40.
    for _ in 0..1000 {
        if at == target {
            break;
        }
        let next = if step.abs() < (target - at).abs() { at + step } else { target };
        step = next - at;
        match reach(next) {
            Some(factor) => {
                at = next;
                step *= factor;
            }
            None => step *= 0.5,
        }
        if step.abs() < least {
            break;
        }
    }
    (at, step)
}
