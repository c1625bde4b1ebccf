//! Linear models of the shipped scenes against perturbed simulations, and wrong models that must be refused.

use holonom::linearize::{Chart, State};
use holonom::prepared::{Model, Overrides};
use holonom::system::{
    Dimensions, LeviCivita, MechanicalSystem, Need, OperatingPoint, OutputTangent, Scratch, Structure, SystemFacts,
    Tangent, Terms,
};
use holonom::validate::{Settings, Validation, validate};
use std::borrow::Cow;
use std::path::{Path, PathBuf};

fn scenes() -> Vec<PathBuf> {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut paths: Vec<_> = std::fs::read_dir(models).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "json") && !path.to_string_lossy().contains("schema"));
    paths.sort();
    paths
}

fn load(path: &Path) -> Model {
    let mut prepared = Model::load_with(path, &Default::default()).unwrap();
    if prepared.method.step.is_none() {
        prepared.method.rtol = prepared.method.rtol.min(1e-10);
        prepared.method.atol = prepared.method.atol.min(1e-10);
    }
    prepared
}

/// The start and two states of the run.
fn three(prepared: &Model) -> Vec<State> {
    let start = prepared.start_time();
    let (length, row) = prepared.span().map_or((0.0, 1.0), |span| (span.end - start, span.output_step));
    // At rows of output, which fixed steps meet.
    let times = [0.0, 0.17, 0.43].map(|part| start + (part * length / row).round() * row);
    prepared.states_at(if length > 0.0 { &times } else { &times[..1] }).unwrap()
}

fn check(prepared: &Model, state: &State) -> Validation {
    let found = validate(prepared.system(), state, &Settings::default()).unwrap();
    let name = format!("{} at {} s", prepared.name, state.t);
    let orders = found.sequences.iter().map(|sequence| &sequence.order_ltv);
    for decay in orders.chain(found.inputs.iter().map(|input| &input.order_ltv)) {
        // LociVariable directions of symmetry the error falls faster, and not at all where the equations are linear.
        // Errors of third order are rounding after two decades.
        let is_right = decay.order.is_some_and(|order| order > 1.9 && decay.decades * order > 5.7);
        assert!(decay.is_exact || is_right, "{name}: {decay:?} {:?}", found.sequences);
    }
    assert!(found.verdict.ltv && found.verdict.lti, "{name}: {:?} {:?}", found.verdict, found.frozen);
    found
}

/// Of the scenes that take less than a second.
#[test]
fn quick_scenes_follow_their_linear_models() {
    for name in [
        "bead_in_bowl",
        "bricard",
        "bushing_block",
        "double_pendulum",
        "four_bar_spring",
        "gear_pair",
        "half_car",
        "hydraulic_boom",
        "pendulum",
        "quarter_car",
        "robot_arm",
        "slider_crank_offset",
        "slider_crank_singular_2",
        "spinning_top",
        "two_mass",
        "universal_shaft",
        "flyball_governor",
    ] {
        let prepared = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json")));
        three(&prepared).iter().for_each(|state| _ = check(&prepared, state));
    }
}

/// The slider-crank folds first at 0.3917321 s, as its scene says; before, perturbed motions follow the model.
#[test]
fn a_singular_state_ends_the_comparison() {
    let prepared = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("models/slider_crank_singular_2.json"));
    let found = check(&prepared, &prepared.states_at(&[0.0]).unwrap()[0]);
    assert!((found.singular.unwrap() - 0.3917321).abs() < 1e-6, "{:?}", found.singular);
    assert_eq!(found.followed, 0.5 * found.singular.unwrap());
}

/// All, minutes: `cargo test --release --test linear validate -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn every_scene_follows_its_linear_model_at_three_states() {
    for path in scenes() {
        let prepared = load(&path);
        for state in three(&prepared) {
            let clock = std::time::Instant::now();
            let found = check(&prepared, &state);
            let order = |decay: &holonom::validate::Decay| match decay.order {
                Some(order) => format!("{order:.3} over {:.1}", decay.decades),
                None => format!("exact {}", decay.is_exact),
            };
            println!(
                "{} {:.4} s: order {} in eps, {} in h; inputs {:?}; horizons {:?}; {:.2} s of work",
                prepared.name,
                state.t,
                found.sequences.iter().map(|sequence| order(&sequence.order_ltv)).collect::<Vec<_>>().join(", "),
                order(&found.frozen.decay),
                found.inputs.iter().map(|input| order(&input.order_ltv)).collect::<Vec<_>>(),
                found.sequences.first().map(|sequence| sequence.horizons),
                clock.elapsed().as_secs_f64(),
            );
        }
    }
}

/// A system with a term of its derivatives left out.
struct Wrong<'a> {
    inner: &'a dyn MechanicalSystem,
    without_geometric: bool,
}

impl MechanicalSystem for Wrong<'_> {
    fn dimensions(&self) -> Dimensions {
        self.inner.dimensions()
    }
    fn facts(&self) -> Cow<'_, SystemFacts> {
        let SystemFacts { names, inputs, excitations, .. } = self.inner.facts().into_owned();
        Cow::Owned(SystemFacts { names, inputs, excitations, ..SystemFacts::new(self.dimensions()) })
    }
    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch) {
        self.inner.evaluate(t, q, v, need, terms, scratch);
    }
    fn structure(&self) -> Structure {
        self.inner.structure()
    }
    /// K without d(G^T lambda)/dq: at lambda = 0.
    fn tangent(&self, at: OperatingPoint, tangent: &mut Tangent, scratch: &mut Scratch) -> bool {
        let none = vec![0.0; at.lambda.len()];
        let lambda = if self.without_geometric { &none } else { at.lambda };
        self.inner.tangent(OperatingPoint { lambda, ..at }, tangent, scratch)
    }
    fn acceleration_gradient(&self, at: OperatingPoint, values: &mut [f64], scratch: &mut Scratch) -> bool {
        self.inner.acceleration_gradient(at, values, scratch);
        if !self.without_geometric {
            values.fill(0.0);
        }
        true
    }
    fn bracket(&self, v: &[f64], x: &[f64], out: &mut [f64]) {
        self.inner.bracket(v, x, out);
    }
    fn levi_civita(&self, at: OperatingPoint, connection: &mut LeviCivita, scratch: &mut Scratch) -> bool {
        self.inner.levi_civita(at, connection, scratch)
    }
    fn rate(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        self.inner.rate(q, v, qdot);
    }
    fn normalize(&self, q: &mut [f64]) {
        self.inner.normalize(q);
    }
    fn input_forces(&self, t: f64, q: &[f64], v: &[f64], f: &mut nalgebra::DMatrix<f64>, scratch: &mut Scratch) {
        self.inner.input_forces(t, q, v, f, scratch);
    }
    fn output_tangent(&self, _: OperatingPoint, _: &mut OutputTangent, _: &mut Scratch) -> bool {
        true
    }
}

/// Without the geometric stiffness of lambda, or without the curvature Gdd, errors fall as eps only.
#[test]
fn wrong_derivatives_are_refused() {
    for name in ["four_bar_spring", "double_pendulum", "andrews"] {
        let prepared = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json")));
        let state = &three(&prepared)[1];
        for without_geometric in [true, false] {
            let wrong = Wrong { inner: prepared.system(), without_geometric };
            let constant = Settings { chart: Some(Chart::MassOrthogonal), inputs: false, ..Settings::default() };
            let found = validate(&wrong, state, &constant).unwrap();
            let order = found.sequences[0].order_ltv.order;
            assert!(!found.verdict.ltv, "{name} {without_geometric}: {:?}", found.verdict);
            // The error that is missing in K grows as eps, and rules at once.
            assert!(order.is_none_or(|order| order < 1.2), "{name} {without_geometric}: {order:?}");
        }
    }
}

/// The plain projection off equilibrium is refused although its K and C are right: with damping it is the model of no
/// chart.
#[test]
fn the_plain_projection_is_refused_off_equilibrium() {
    let set = Overrides { set: vec![("c1".to_string(), 5.0.into())], ..Overrides::default() };
    let prepared =
        Model::load_with(&Path::new(env!("CARGO_MANIFEST_DIR")).join("models/four_bar_spring.json"), &set).unwrap();
    let state = &three(&prepared)[1];
    let settings = Settings { chart: Some(Chart::Frozen), ..Settings::default() };
    let found = validate(prepared.system(), state, &settings).unwrap();
    assert!(found.verdict.ltv && !found.verdict.lti, "{:?} {:?}", found.verdict, found.frozen);
    let order = found.frozen.decay.order.unwrap();
    // The next power of h is seen at the longest steps.
    assert!((order - 1.0).abs() < 0.2, "{order}");
}

#[test]
fn independent_coordinates_and_named_directions() {
    let prepared = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("models/four_bar_spring.json"));
    let state = &three(&prepared)[1];
    let name = prepared.system().facts().names.q.clone().into_iter().find(|name| name.ends_with(".angle")).unwrap();
    let settings = Settings {
        chart: Some(Chart::Independent(vec![name.clone()])),
        directions: vec![holonom::validate::Direction::Named(name)],
        ..Settings::default()
    };
    let found = validate(prepared.system(), state, &settings).unwrap();
    assert!(found.verdict.ltv && found.verdict.lti, "{:?}", found.verdict);
    let unknown =
        Settings { directions: vec![holonom::validate::Direction::Named("u7".into())], ..Settings::default() };
    let error = validate(prepared.system(), state, &unknown).unwrap_err().to_string();
    assert!(error.contains("no state `u7`"), "{error}");
}

/// The intrinsic chart moves along with the motion: its frozen model is exact to h^2 in the basis carried with it, and
/// to h only in a basis that stays.
#[test]
fn the_intrinsic_chart_is_followed() {
    for name in ["four_bar_spring", "double_pendulum", "spatial_slider_crank", "spinning_top", "universal_shaft"] {
        let prepared = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json")));
        let state = &three(&prepared)[1];
        let settings = Settings { chart: Some(Chart::Intrinsic), inputs: false, ..Settings::default() };
        let found = validate(prepared.system(), state, &settings).unwrap();
        assert!(found.verdict.ltv && found.verdict.lti, "{name}: {:?} {:?}", found.verdict, found.frozen);
        let default = validate(prepared.system(), state, &Settings { inputs: false, ..Settings::default() }).unwrap();
        assert_eq!(default.chart, "intrinsic", "{name}");
    }
}
