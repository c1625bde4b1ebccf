//! The beam on a hub that is spun up, Kane, Ryan and Banerjee's example.

use crate::flexible::beams::largest;
use crate::scenes::{Ready, Run, model, parse, shipped};
use holonom::simulate::Span;

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
    let force = RHO_A * W * W * L * L / 2.0;
    let found = late_mean(&run, "stretch");
    let pull = late_mean(&run, "root_force");
    let swing = late_rms(&run, "lag");
    println!(
        "swing {swing:.2e} m; lag {lag:.4} m at {t} s; stretch {found:.6e} of {stretch:.6e}; force {pull:.4} of {force:.4}"
    );
    assert!((lag - 0.575).abs() < 1e-3 && (t - 6.75).abs() < 0.11, "{lag} {t}");
    // A swing of a at the tip shortens the line by int w'^2/2 = 0.5 to 0.58 a^2/L, as its shape is a straight line or the
    // first mode: 7e-4 of the stretch.
    assert!(((found + 0.54 * swing * swing / L) / stretch - 1.0).abs() < 1e-4, "{found:e}");
    // It swings by the energy that is left, and radial speeds are small: 1e-4 was measured.
    assert!((pull / force - 1.0).abs() < 3e-4, "{pull}");
}

/// What a column does over 17 <= t <= 20, against zero.
fn late_rms(run: &Run, column: &str) -> f64 {
    let rows = run.times().into_iter().zip(run.column(column)).filter(|(t, _)| *t >= 17.0);
    let squares: Vec<f64> = rows.map(|(_, x)| x * x).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn without_stiffening() -> String {
    text().replace("\"geometric_stiffening\": true", "\"geometric_stiffening\": false")
}

/// The lag is 0.99 m instead of 0.57 m at 6.75 s, and grows without end once the spin passes 3.8 rad/s at 8.5 s.
#[test]
fn without_stiffening_it_runs_away() {
    let plain = parse(&without_stiffening());
    let run = plain.run(&plain.0.method, Span { start: 0.0, end: 12.0, output_step: 0.05 });
    let lag = |t: f64| -run.column("lag")[(t / 0.05).round() as usize];
    let found = [6.75, 9.0, 12.0].map(lag);
    println!("without stiffening: {found:.3?}");
    assert!((found[0] - 0.987).abs() < 1e-2, "{found:?}");
    assert!(found[1] > 5.0 && found[2] > 1e4, "{found:?}");
}

/// Without stiffening, bending is unstable above the first frequency at rest, 1.8751^2 sqrt(EI/rhoA)/L^2 = 3.80 rad/s:
/// at 3.9 rad/s it grows by exp(0.9 t), at 3.7 rad/s it swings slowly. With stiffening it does neither.
#[test]
fn the_first_frequency_bounds_the_spin_without_stiffening() {
    // Bent as under a force at the tip, 0.01 m there, which is the first mode to 3 %.
    let bend = |node: u32| {
        let x = f64::from(node) / 8.0;
        format!("\"n{node}_y\": {}, \"n{node}_r\": {}", 0.005 * x * x * (3.0 - x), 0.0005 * x * (6.0 - 3.0 * x))
    };
    let bent = (1..=8).map(bend).collect::<Vec<_>>().join(", ");
    let at_speed = |text: &str, w: f64| {
        let (head, tail) = text.split_once("\"value\": ").unwrap();
        let (_, tail) = tail.split_once('}').unwrap();
        // Damping ends the ringing of the stretch, which comes at once.
        let damping = "\"damping\": { \"rayleigh\": { \"stiffness\": 1e-4 } }";
        let start = format!("{damping}, \"initial\": {{ \"angular_velocity\": {w}, \"elastic\": {{ {bent} }} }},");
        let head = head.replace("\"frame_conditions\"", &format!("{start} \"frame_conditions\""));
        let beam = parse(&format!("{head}\"value\": \"{w}*t\" }}{tail}"));
        let run = beam.run(&beam.0.method, Span { start: 0.0, end: 5.0, output_step: 0.1 });
        run.column("lag")
    };
    let plain = [3.7, 3.9].map(|w| at_speed(&without_stiffening(), w));
    let [slow, stiffened] = [&plain[0], &at_speed(&text(), 3.9)].map(|lag| largest(lag.iter().copied()));
    let growth = (plain[1][50] / plain[1][40]).ln();
    let first = 1.875104f64.powi(2) * (1.4e4 / RHO_A).sqrt() / (L * L);
    let expected = (3.9 * 3.9 - first * first).sqrt();
    println!("largest lag at 3.7 rad/s {slow:.2e}, stiffened {stiffened:.2e}; growth {growth:.4} of {expected:.4}");
    assert!(slow < 0.012 && stiffened < 0.012, "{slow} {stiffened}");
    // What decays alike is 3e-3 of it by then.
    assert!((growth / expected - 1.0).abs() < 1e-2, "{growth} {expected}");
}

/// The same data in absolute coordinates.
#[test]
fn the_absolute_beam_lags_alike() {
    let absolute = text()
        .replace("\"frame\": \"floating\"", "\"frame\": \"absolute\"")
        .replace("\"frame_conditions\": \"tangent\", \"geometric_stiffening\": true,", "");
    let floating = beam();
    let absolute = parse(&absolute);
    let runs = [&floating, &absolute].map(|beam| beam.run(&beam.0.method, whole()));
    let [a, b] = [0, 1].map(|i: usize| runs[i].column("lag"));
    let gap = largest(a.iter().zip(&b).map(|(a, b)| a - b));
    // Of its masses half an element is at h/6 from the tip, the others at their nodes: what pulls the elements from the
    // hub on is rhoA w^2 (h L/2 - h^2/12 + the sum of i h^2 outwards).
    let h = L / 8.0;
    let pulls: Vec<f64> = (1..=8)
        .map(|element| {
            let nodes = (element..8).map(|i| f64::from(i) * h * h).sum::<f64>();
            RHO_A * W * W * (0.5 * h * L - h * h / 12.0 + nodes)
        })
        .collect();
    let stretch = pulls.iter().sum::<f64>() * h / EA;
    let found = [late_mean(&runs[1], "stretch"), late_mean(&runs[1], "root_force")];
    println!("absolute lags {:?}, apart by {gap:.2e} m; {found:?} of {stretch:.5e}", largest_lag(&runs[1]));
    // Lumped masses: 2.7e-3 of the lag.
    assert!(gap < 2e-3, "{gap}");
    assert!((found[0] / stretch - 1.0).abs() < 1e-3, "{found:?} {stretch:e}");
    // That of the hub, lumped or not, and 1e-4 for the stretch and the swing.
    assert!((found[1] / (RHO_A * W * W * L * L / 2.0) - 1.0).abs() < 2e-4, "{found:?}");
}
