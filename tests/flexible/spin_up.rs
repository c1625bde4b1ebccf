//! The beam on a hub that is spun up, Kane, Ryan and Banerjee's example.

use crate::scenes::{Ready, Run, model, parse, shipped};
use holonom::measure::Recorder;
use holonom::simulate::{Span, simulate};

const RHO_A: f64 = 1.2;
const EA: f64 = 2.8e7;
const L: f64 = 10.0;
const W: f64 = 6.0;

fn beam() -> Ready {
    shipped("spin_up_beam", &[])
}

fn text() -> String {
    std::fs::read_to_string(model("spin_up_beam")).unwrap()
}

fn whole() -> Span {
    Span { start: 0.0, end: 20.0, output_step: 0.05 }
}

/// Mean of a column over 17 <= t <= 20, in which the beam swings about three times.
fn late_mean(run: &Run, column: &str) -> f64 {
    let late: Vec<f64> =
        run.times().into_iter().zip(run.column(column)).filter(|(t, _)| *t >= 17.0).map(|(_, x)| x).collect();
    late.iter().sum::<f64>() / late.len() as f64
}

/// Where the lag is largest: t and the lag.
fn largest_lag(run: &Run) -> (f64, f64) {
    let rows = run.times().into_iter().zip(run.column("lag"));
    rows.fold((0.0, 0.0), |most, (t, lag)| if -lag > most.1 { (t, -lag) } else { most })
}

#[test]
fn the_beam_lags_comes_back_and_is_stretched() {
    let beam = beam();
    let run = beam.run(&beam.0.method, whole());
    let (t, lag) = largest_lag(&run);
    // u = sin(k s)/(k cos(k L)) - s with k^2 = rhoA w^2/EA: the first term, rhoA w^2 L^3/(3 EA), lacks 6e-5 of it.
    let k = (RHO_A * W * W / EA).sqrt();
    let stretch = (k * L).tan() / k - L;
    assert!((stretch / (RHO_A * W * W * L.powi(3) / (3.0 * EA)) - 1.0).abs() < 1e-4);
    // Linear displacements have the mean of the force over the first element, of length L/8: less by rhoA w^2 h^2/6.
    let force = RHO_A * W * W * (L * L / 2.0 - (L / 8.0).powi(2) / 6.0);
    let (found, pull) = (late_mean(&run, "stretch"), late_mean(&run, "root_force"));
    println!("lag {lag:.4} m at {t} s; stretch {found:.6e} of {stretch:.6e}; force {pull:.4} of {force:.4}");
    assert!((lag - 0.575).abs() < 1e-3 && (t - 6.75).abs() < 0.11, "{lag} {t}");
    assert!((found / stretch - 1.0).abs() < 1e-3, "{found:e}");
    assert!((pull / force - 1.0).abs() < 1e-3, "{pull}");
}

/// Bending that the centrifugal force does not stiffen is unstable above sqrt(EI/rhoA) (1.8751/L)^2 rad/s of spin: 3.8.
#[test]
fn without_stiffening_it_runs_away() {
    let plain = parse(&text().replace("\"geometric_stiffening\": true", "\"geometric_stiffening\": false"));
    let mut recorder = Recorder::new(plain.system());
    let span = Span { start: 0.0, end: 14.0, output_step: 0.05 };
    let outcome = simulate(plain.system(), &plain.0.method, span, plain.0.start(), &mut recorder).unwrap();
    let run = Run { record: recorder.finish(), outcome };
    let lag = run.column("lag");
    let last = *lag.last().unwrap();
    println!("lag at {} s: {last:.3}; {:?}; largest {:?}", run.outcome.t, run.outcome.failure, largest_lag(&run));
    for t in [5.0, 6.75, 8.0, 9.0, 10.0, 11.0, 12.0] {
        println!("{t} {:?}", lag.get((t / 0.05) as usize));
    }
}

/// The same data in absolute coordinates.
#[test]
fn the_absolute_beam_lags_alike() {
    let absolute = text()
        .replace("\"frame\": \"floating\"", "\"frame\": \"absolute\"")
        .replace("\"frame_conditions\": \"tangent\", \"geometric_stiffening\": true,", "");
    let (floating, absolute) = (beam(), parse(&absolute));
    let runs = [&floating, &absolute].map(|beam| beam.run(&beam.0.method, whole()));
    let [a, b] = [0, 1].map(|i: usize| runs[i].column("lag"));
    let gap = a.iter().zip(&b).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
    println!("absolute lags {:?}, apart by {gap:.2e} m", largest_lag(&runs[1]));
    println!("stretch {:e} force {}", late_mean(&runs[1], "stretch"), late_mean(&runs[1], "root_force"));
    assert!(gap < 0.02, "{gap}");
}
