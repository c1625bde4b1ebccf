//! What an evaluation, a solution and a run cost: `cargo bench --bench speed`. Single thread; the cases of a table take
//! turns, so that their ratios hold on a busy machine.

mod classic;
mod common;
#[path = "../tests/common/equations/mod.rs"]
mod equations;

use common::{Case, compare};
use equations::andrews::{Andrews, START};
use holonom::formulation::Dynamics;
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::scene::{Scene, generate};
use holonom::simulate::{Method, Outcome, Span, simulate};
use holonom::system::{MechanicalSystem, Need};
use std::cell::RefCell;
use std::path::Path;

fn shipped(name: &str, overrides: &Overrides) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(format!("{name}.json"));
    Model::load_with(&path, overrides).unwrap_or_else(|error| panic!("{error}"))
}

fn generated(scene: &serde_json::Value) -> Model {
    let prepared = Scene::parse(&scene.to_string(), &[]).and_then(|scene| Model::new(scene, &Default::default()));
    prepared.unwrap_or_else(|error| panic!("{error}"))
}

fn fixed(names: [&str; 3], step: f64) -> Method {
    let [formulation, integrator, projection] = names.map(MethodSpec::named);
    Method { formulation, integrator, projection, step: Some(step), ..Method::default() }
}

fn adaptive(names: [&str; 3], tolerance: f64) -> Method {
    Method { step: None, rtol: tolerance, atol: tolerance, ..fixed(names, 0.0) }
}

fn case<'a>(name: impl Into<String>, call: impl FnMut() + 'a) -> Case<'a> {
    (name.into(), Box::new(call))
}

fn run(prepared: &Model, method: &Method, end: f64) -> Outcome {
    motion(prepared.system(), prepared.start(), method, end)
}

fn motion(system: &dyn MechanicalSystem, start: (&[f64], &[f64]), method: &Method, end: f64) -> Outcome {
    let span = Span { start: 0.0, end, output_step: end };
    let outcome = simulate(system, method, span, start, &mut ());
    let outcome = outcome.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(outcome.failure, None, "a run that fails early costs little");
    outcome
}

/// M, f, phi, phi', gamma and G, and the saddle-point solution, at the start.
fn evaluation() {
    let [andrews, top] = ["andrews", "spinning_top"].map(|name| shipped(name, &Default::default()));
    evaluation_of("andrews", andrews.system(), andrews.start());
    evaluation_of("andrews as own equations", &Andrews, START.motion());
    evaluation_of("spinning_top", top.system(), top.start());
}

fn evaluation_of(name: &str, system: &dyn MechanicalSystem, (q, v): (&[f64], &[f64])) {
    let dynamics = RefCell::new(Dynamics::new(system));
    let evaluate = || dynamics.borrow_mut().evaluate(0.0, q, v, Need::DYNAMICS);
    let saddle_point = || {
        let dynamics = &mut *dynamics.borrow_mut();
        assert!(dynamics.factor().is_ok());
        dynamics.vdot.copy_from_slice(&dynamics.terms.f);
        dynamics.lambda.copy_from_slice(&dynamics.terms.gamma);
        assert!(dynamics.kkt.solve(&mut dynamics.vdot, &mut dynamics.lambda).is_ok());
    };
    let solve = || assert!(dynamics.borrow_mut().solve(0.0, q, v, |_, _| 0.0).is_ok());
    let cases = vec![case("v' and lambda", solve), case("terms", evaluate), case("saddle point", saddle_point)];
    compare(&format!("{name}, one evaluation"), cases);
}

/// Andrews' mechanism end to end against a plain classic code.
fn end_to_end() {
    let andrews = shipped("andrews", &Default::default());
    classic::table::compare((andrews.system(), andrews.start()), adaptive, motion);
}

/// Twenty steps on N four-bar linkages, explicit with projection and implicit: O(N).
fn growth() {
    let studies = [1, 10, 100, 1000].map(|n| (n, generated(&generate::n_four_bar(n))));
    let explicit = ["index1", "rk4", "manifold"];
    for names in [explicit, ["ggl", "generalized_alpha", "none"], ["index3", "generalized_alpha", "none"]] {
        let method = fixed(names, 1e-4);
        let steps = |prepared| drop(run(prepared, &method, 20e-4));
        let cases = studies.iter().map(|(n, prepared)| case(format!("N = {n}"), move || steps(prepared)));
        compare(&format!("n_four_bar, 20 steps of {}", method.triple()), cases.collect());
    }
}

/// Stiff by its dampers, or oscillating fast at rest: what implicit methods are for, against dop853 at one tolerance.
fn stiff() {
    let strut = Overrides { set: vec![("c_strut".to_string(), 2e5.into())], ..Overrides::default() };
    for (name, end, overrides) in [("flyball_governor", 1.0, Overrides::default()), ("quarter_car", 2.0, strut)] {
        let prepared = shipped(name, &overrides);
        let methods = [["index1", "dop853", "manifold"], ["ggl", "radau_iia", "none"], ["ggl", "bdf", "none"]];
        let cases = methods.map(|names| {
            let method = adaptive(names, 1e-6);
            let prepared = &prepared;
            let work = run(prepared, &method, end).statistics;
            let name = format!("{}, {} steps, {} evaluations", names[1], work.steps, work.rhs_evaluations);
            case(name, move || drop(run(prepared, &method, end)))
        });
        compare(&format!("{name}, {end} s"), cases.into());
    }
}

/// Five steps of implicit methods on chains: O(N).
fn implicit_growth() {
    let studies = [20, 200, 2000].map(|n| (n, generated(&generate::chain(n))));
    for integrator in ["radau_iia", "generalized_alpha"] {
        let method = fixed(["ggl", integrator, "none"], 1e-4);
        let cases = studies.iter().map(|(n, prepared)| case(format!("N = {n}"), || drop(run(prepared, &method, 5e-4))));
        compare(&format!("chain, five steps of {integrator}"), cases.collect());
    }
}

fn main() {
    evaluation();
    end_to_end();
    growth();
    stiff();
    implicit_growth();
}
