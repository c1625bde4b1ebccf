//! What a step costs with flexible beams of more and more elements: `cargo bench --bench flexible`. Single thread.
//!
//! A cantilever of N elements of 0.1 m each, in both kinds of frames, in the plane and in space: a step of `rk4` on
//! index1 and one of `generalized_alpha` on ggl, in microseconds for each element, with the memory that the run holds at
//! most for each. Both columns are level where cost is linear; a matrix of global size would show as growth with N.

use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use holonom::simulate::{Method, Span, simulate};
use serde_json::json;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::Instant;

/// Keeps the most bytes that were held at once.
struct Peak;

static HELD: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

// The trait demands it; every call goes on to the system's allocator.
unsafe impl GlobalAlloc for Peak {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let held = HELD.fetch_add(layout.size(), Relaxed) + layout.size();
        MOST.fetch_max(held, Relaxed);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Peak = Peak;

/// A beam that is clamped at one end and falls at the other.
fn cantilever(dimension: usize, frame: &str, elements: usize) -> Model {
    let zeros = vec![json!(0); dimension];
    let at = |s: String| [vec![json!(s)], zeros[1..].to_vec()].concat();
    let (stiffness, inertia, gravity) = match dimension {
        2 => (json!({ "EA": 1e6, "GA": 4e5, "EI": 1e3 }), json!({ "rhoA": 1, "rhoI": 1e-2 }), json!([0, -9.81])),
        _ => (
            json!({ "EA": 1e6, "GA": 4e5, "EI": 1e3, "GJ": 8e2 }),
            json!({ "rhoA": 1, "rhoI": 1e-2 }),
            json!([0, -9.81, 0]),
        ),
    };
    let scene = json!({
        "name": "cantilever", "dimension": dimension, "gravity": gravity,
        "ground": { "markers": { "wall": zeros } },
        "bodies": [{ "name": "beam", "type": "flexible_beam", "frame": frame, "length": format!("0.1*{elements}"),
            "elements": elements, "theory": "timoshenko", "stiffness": stiffness, "inertia": inertia,
            "markers": { "root": zeros, "tip": at(format!("0.1*{elements}")) } }],
        "joints": [{ "name": "wall", "type": "weld", "between": ["ground.wall", "beam.root"] }],
    });
    let prepared = Scene::parse(&scene.to_string(), &[]).and_then(|scene| Model::new(scene, &Overrides::default()));
    prepared.unwrap_or_else(|error| panic!("{error}"))
}

/// Seconds of a step, from the difference of a long and a short run, and the most bytes held.
fn cost(prepared: &Model, method: &Method, step: f64, steps: usize) -> (f64, usize) {
    let run = |steps: usize| {
        let span = Span { start: 0.0, end: step * steps as f64, output_step: step * steps as f64 };
        let begin = Instant::now();
        let outcome = simulate(prepared.system(), method, span, prepared.start(), &mut ());
        let failure = outcome.unwrap_or_else(|error| panic!("{error}")).failure;
        assert!(failure.is_none(), "{failure:?}");
        begin.elapsed().as_secs_f64()
    };
    MOST.store(HELD.load(Relaxed), Relaxed);
    let short = run(1);
    let long = (0..3).map(|_| run(1 + steps)).fold(f64::INFINITY, f64::min);
    ((long - short).max(0.0) / steps as f64, MOST.load(Relaxed))
}

fn method(formulation: &str, integrator: &str, step: f64) -> Method {
    let spec = |name: &str| MethodSpec::parse(name).unwrap_or_else(|error| panic!("{error}"));
    let formulation = spec(formulation);
    let integrator = spec(integrator);
    Method { formulation, integrator, projection: spec("none"), step: Some(step), ..Method::default() }
}

fn main() {
    // What libraries keep for good is taken by the first run.
    cost(&cantilever(2, "floating", 10), &method("ggl", "generalized_alpha", 1e-3), 1e-3, 1);
    let kept = HELD.load(Relaxed);
    println!("{:<22} {:>7} {:>22} {:>34}", "", "", "rk4 on index1", "generalized_alpha on ggl");
    println!("{:<22} {:>7} {:>11} {:>10} {:>14} {:>10} {:>12}", "", "N", "us/step", "us/N", "us/step", "us/N", "kB/N");
    for (dimension, frame) in [(2, "floating"), (2, "absolute"), (3, "floating"), (3, "absolute")] {
        for elements in [10, 100, 1000, 10_000] {
            let prepared = cantilever(dimension, frame, elements);
            let steps = (20_000 / elements).clamp(3, 200);
            let (explicit, _) = cost(&prepared, &method("index1", "rk4", 1e-6), 1e-6, steps);
            let (implicit, bytes) = cost(&prepared, &method("ggl", "generalized_alpha", 1e-3), 1e-3, steps.min(50));
            let per = |seconds: f64| 1e6 * seconds / elements as f64;
            println!(
                "{:<22} {elements:>7} {:>11.1} {:>10.2} {:>14.1} {:>10.2} {:>12.2}",
                format!("{frame}, {dimension} dimensions"),
                1e6 * explicit,
                per(explicit),
                1e6 * implicit,
                per(implicit),
                (bytes.saturating_sub(kept)) as f64 / 1e3 / elements as f64
            );
        }
    }
}
