//! Large systems on any number of threads: the same to the bit.

use holonom::analysis::Recorder;
use holonom::method_spec::MethodSpec;
use holonom::prepared::Model;
use holonom::scene::{Scene, generate};
use holonom::simulate::{Method, Outcome, Span, simulate, spread};
use rayon::ThreadPoolBuilder;
use serde_json::{Value, json};

fn prepared(scene: &Value) -> Model {
    let scene = Scene::parse(&scene.to_string(), &[]);
    scene.and_then(|scene| Model::new(scene, &Default::default())).unwrap()
}

/// The end of two steps, and all numbers of the rows, bit by bit.
fn run(prepared: &Model, names: [&str; 3], step: f64) -> (Outcome, Vec<u64>) {
    let [formulation, integrator, projection] = names.map(MethodSpec::named);
    let method = Method { formulation, integrator, projection, step: Some(step), ..Method::default() };
    let span = Span { start: 0.0, end: 2.0 * step, output_step: step };
    let mut recorder = Recorder::new(prepared.system());
    let outcome = simulate(prepared.system(), &method, span, prepared.start(), &mut recorder).unwrap();
    assert_eq!(outcome.failure, None);
    let rows = recorder.finish().trajectory.rows;
    assert_eq!(rows.len(), 3);
    (outcome, rows.iter().flatten().map(|x| x.to_bits()).collect())
}

/// Runs alone and on one to four threads, with explicit and implicit steps.
fn is_same_on_all_threads(scene: &Value, step: f64) {
    let prepared = prepared(scene);
    for names in [["index1", "rk4", "manifold"], ["ggl", "generalized_alpha", "none"]] {
        let alone = run(&prepared, names, step);
        for threads in 1..=4 {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let found = pool.install(|| spread(|| run(&prepared, names, step)));
            assert!(found == alone, "{names:?} on {threads} threads");
        }
    }
}

#[test]
fn four_bar_linkages_are_the_same_on_all_threads() {
    // Four parts, and some thousand bodies and joints.
    is_same_on_all_threads(&generate::n_four_bar(3500), 1e-4);
}

#[test]
fn redundant_rows_are_the_same_on_all_threads() {
    let mut scene = generate::n_four_bar(2000);
    for joint in ["A300", "C1200", "B1900"] {
        let joints = scene["joints"].as_array_mut().unwrap();
        let mut again = joints.iter().find(|known| known["name"] == joint).unwrap().clone();
        again["name"] = json!(format!("{joint}_again"));
        joints.push(again);
    }
    is_same_on_all_threads(&scene, 1e-4);
}

#[test]
fn a_flexible_chain_is_the_same_on_all_threads() {
    // Waves cross an element in some 10 ns.
    is_same_on_all_threads(&generate::flexible_chain(1300), 1e-9);
}
