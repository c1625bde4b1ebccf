//! What a step of a large system costs on some threads: `cargo bench --bench threads`. Wall-clock times, as the work is
//! that of several threads: least ones of many rounds, in which all take turns.

use holonom::method_spec::MethodSpec;
use holonom::prepared::Model;
use holonom::scene::{Scene, generate};
use holonom::simulate::{Method, Span, simulate, spread};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::time::Instant;

const ROUNDS: usize = 20;
const STEP: f64 = 1e-3;
/// Steps of a short and of a long run: the difference is free of what a run costs by itself.
const STEPS: [usize; 2] = [2, 12];

fn pool(threads: usize) -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(threads).build().unwrap_or_else(|error| panic!("{error}"))
}

/// Seconds of a run of some steps.
fn seconds(prepared: &Model, method: &Method, steps: usize) -> f64 {
    let end = steps as f64 * STEP;
    let clock = Instant::now();
    let span = Span { start: 0.0, end, output_step: end };
    let outcome = simulate(prepared.system(), method, span, prepared.start(), &mut ());
    assert_eq!(outcome.map(|outcome| outcome.failure).ok(), Some(None), "a run that fails early costs little");
    clock.elapsed().as_secs_f64()
}

fn compare(name: &str, prepared: &Model, names: [&str; 3]) {
    let [formulation, integrator, projection] = names.map(MethodSpec::named);
    let method = Method { formulation, integrator, projection, step: Some(STEP), ..Method::default() };
    let pools = [1, 2, 4].map(pool);
    let mut least = [[f64::INFINITY; 2]; 3];
    for _ in 0..ROUNDS {
        for (pool, least) in pools.iter().zip(&mut least) {
            for (steps, least) in STEPS.into_iter().zip(least) {
                *least = least.min(pool.install(|| spread(|| seconds(prepared, &method, steps))));
            }
        }
    }
    let steps = least.map(|[short, long]| 1e3 * (long - short) / (STEPS[1] - STEPS[0]) as f64);
    let [one, two, four] = steps;
    println!("  {name:<44} {one:>9.3} {two:>9.3} {four:>9.3} {:>8.2} {:>8.2}", one / two, one / four);
}

fn main() {
    println!("{:<46} {:>9} {:>9} {:>9} {:>8} {:>8}", "ms a step", "1 thread", "2", "4", "1 / 2", "1 / 4");
    let sizes = std::env::args().skip(1).filter_map(|size| size.parse().ok());
    let sizes: Vec<usize> = sizes.collect();
    for n in if sizes.is_empty() { vec![1000, 2000, 3000, 10_000] } else { sizes } {
        let scene = Scene::parse(&generate::n_four_bar(n).to_string(), &[]);
        let prepared = scene.and_then(|scene| Model::new(scene, &Default::default()));
        let prepared = prepared.unwrap_or_else(|error| panic!("{error}"));
        for names in [["index1", "rk4", "manifold"], ["ggl", "generalized_alpha", "none"]] {
            compare(&format!("n_four_bar, N = {n}, {}", names[1]), &prepared, names);
        }
    }
}
