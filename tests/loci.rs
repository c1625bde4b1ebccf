//! Eigenvalues followed along a motion and over a parameter, and frequency responses.

use holonom::linearize::{
    At, Branch, Complex, Kind, Linear, LinearModel, Loci, LociPoint, LociVariable, Matrix, Mode, State, Variants,
    at_rest, frequency_response, loci_along, loci_over, track,
};
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use holonom::sweep::{Family, Range};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

fn c(re: f64, im: f64) -> Complex<f64> {
    Complex::new(re, im)
}

fn mode(value: Complex<f64>, shape: &[f64]) -> Mode {
    let shape = shape.iter().map(|x| c(*x, 0.0)).collect();
    Mode {
        value,
        kind: Kind::Physical,
        shape,
        participation: Vec::new(),
        energy: Vec::new(),
        mass: 1.0,
        outputs: Vec::new(),
        rounding: 0.0,
        condition: 1.0,
        error: 0.0,
    }
}

/// Modes with their conjugates, in the order that a linear model has them.
fn sample(at: f64, upper: &[(Complex<f64>, [f64; 2])]) -> LociPoint {
    let both = |(value, shape): &(Complex<f64>, [f64; 2])| {
        let lower = (value.im != 0.0).then(|| mode(value.conj(), shape));
        lower.into_iter().chain([mode(*value, shape)]).collect::<Vec<Mode>>()
    };
    let mut modes: Vec<Vec<Mode>> = upper.iter().map(both).collect();
    modes.sort_by(|a, b| a[0].value.norm().total_cmp(&b[0].value.norm()));
    let mass = Matrix::from_diagonal(&nalgebra::DVector::from_vec(vec![1.0, 4.0]));
    LociPoint { at, modes: modes.concat(), mass, slopes: Vec::new() }
}

fn grid(n: usize) -> impl Iterator<Item = f64> {
    (0..=n).map(move |k| k as f64 / n as f64)
}

fn last(branch: &Branch) -> Complex<f64> {
    branch.points[branch.points.len() - 1].1
}

fn are_conjugate(a: &Branch, b: &Branch) -> bool {
    a.points.iter().zip(&b.points).all(|((_, a), (_, b))| a.im == 0.0 && b.im == 0.0 || *a == b.conj())
}

#[test]
fn modes_that_cross_keep_their_shapes() {
    // At one of the samples they are equal.
    let samples: Vec<LociPoint> =
        grid(10).map(|t| sample(t, &[(c(-0.1, 1.0 + t), [1.0, 0.1]), (c(-0.1, 2.0 - t), [-0.4, 1.0])])).collect();
    let branches = track(&samples);
    assert_eq!(branches.len(), 4);
    assert!(branches.iter().all(|branch| branch.points.len() == 11));
    assert_eq!([0, 1, 2, 3].map(|i| branches[i].points[0].1.im), [1.0, -1.0, 2.0, -2.0]);
    assert_eq!([0, 1, 2, 3].map(|i| last(&branches[i]).im), [2.0, -2.0, 1.0, -1.0]);
}

#[test]
fn modes_of_one_shape_that_cross_go_straight_on() {
    let shape = [1.0, 1.0];
    let samples: Vec<LociPoint> =
        grid(9).map(|t| sample(t, &[(c(0.0, 1.0 + t), shape), (c(0.0, 2.0 - t), shape)])).collect();
    assert_eq!([0, 2].map(|i| last(&track(&samples)[i]).im), [2.0, 1.0]);
}

#[test]
fn modes_that_veer_do_not_cross() {
    // Stiffness [[a, e], [e, b]] with a and b that cross, e = 0.05, unit masses.
    let veering = |t: f64| {
        let a = 1.0 + t;
        let b = 2.0 - t;
        let e = 0.05f64;
        let half = ((0.5 * (a - b)).powi(2) + e * e).sqrt();
        [-half, half].map(|half| {
            let square = 0.5 * (a + b) + half;
            (c(0.0, square.sqrt()), [e, square - a])
        })
    };
    let mut samples: Vec<LociPoint> = grid(100).map(|t| sample(t, &veering(t))).collect();
    samples.iter_mut().for_each(|sample| sample.mass = Matrix::identity(2, 2));
    let branches = track(&samples);
    assert!(branches[0].points.iter().zip(&branches[2].points).all(|(low, high)| low.1.im < high.1.im));
    // Three states in all say another thing: each shape is found again on the other side.
    let coarse: Vec<LociPoint> = samples.iter().step_by(50).cloned().collect();
    assert!(!coarse[0].leads_clearly_to(&coarse[1]) && samples[0].leads_clearly_to(&samples[1]));
}

#[test]
fn a_pair_becomes_two_real_ones_and_a_pair_again() {
    // s^2 + 2 s + k with k from 2 to 1/4 and back, beside another mode.
    let samples: Vec<LociPoint> = grid(40)
        .map(|t| {
            let k = 0.25 + 1.75 * (1.0 - 2.0 * t).powi(2);
            let other = (c(-0.1, 1.5), [-0.4, 1.0]);
            if k > 1.0 {
                sample(t, &[(c(-1.0, (k - 1.0).sqrt()), [1.0, 0.1]), other])
            } else {
                let root = (1.0 - k).sqrt();
                sample(t, &[(c(-1.0 + root, 0.0), [1.0, 0.1]), (c(-1.0 - root, 0.0), [1.0, 0.1]), other])
            }
        })
        .collect();
    let branches = track(&samples);
    assert_eq!(branches.len(), 4);
    assert!(branches.iter().all(|branch| branch.points.len() == 41));
    let middle: Vec<Complex<f64>> = branches.iter().map(|branch| branch.points[20].1).collect();
    assert!((middle[0].re + 1.0 - 0.75f64.sqrt()).abs() < 1e-12 && middle[0].im == 0.0, "{middle:?}");
    assert!((middle[1].re + 1.0 + 0.75f64.sqrt()).abs() < 1e-12 && middle[1].im == 0.0, "{middle:?}");
    assert_eq!((middle[2], middle[3]), (c(-0.1, 1.5), c(-0.1, -1.5)));
    assert!(are_conjugate(&branches[0], &branches[1]) && are_conjugate(&branches[2], &branches[3]));
    assert_eq!((last(&branches[0]), last(&branches[1])), (c(-1.0, 1.0), c(-1.0, -1.0)));
}

#[test]
fn one_pair_becomes_real_while_another_is_born() {
    let [a, b] = [[1.0, 0.0], [0.0, 1.0]];
    let before = sample(0.0, &[(c(-1.0, 0.1), a), (c(-5.1, 0.0), b), (c(-4.9, 0.0), b)]);
    let after = sample(1.0, &[(c(-1.1, 0.0), a), (c(-0.9, 0.0), a), (c(-5.0, 0.1), b)]);
    let ends: Vec<Complex<f64>> = track(&[before, after]).iter().map(last).collect();
    assert_eq!(ends, [c(-0.9, 0.0), c(-1.1, 0.0), c(-5.0, 0.1), c(-5.0, -0.1)]);
}

#[test]
fn branches_start_end_and_go_on_behind_gaps() {
    let [a, b] = [[1.0, 0.0], [0.0, 1.0]];
    let one = |t: f64| sample(t, &[(c(0.0, 1.0), a)]);
    let two = |t: f64| sample(t, &[(c(0.0, 1.0), a), (c(0.0, 0.9), b)]);
    let mut samples = vec![one(0.0), two(1.0), LociPoint::gap(2.0), two(3.0), one(4.0)];
    samples[3].modes[0].kind = Kind::Spurious;
    samples[3].modes[1].kind = Kind::Spurious;
    let branches = track(&samples);
    let counts: Vec<(Kind, f64, usize)> =
        branches.iter().map(|branch| (branch.kind, branch.points[0].0, branch.points.len())).collect();
    let physical = |start, count| (Kind::Physical, start, count);
    let spurious = (Kind::Spurious, 3.0, 1);
    assert_eq!(counts, [physical(0.0, 5), physical(0.0, 5), physical(1.0, 2), physical(1.0, 2), spurious, spurious]);
    assert!(branches[0].points[2].1.re.is_nan() && branches[0].points[3].1 == c(0.0, 1.0));
    assert!(track(&[]).is_empty() && track(&[LociPoint::gap(0.0)]).is_empty());
}

fn path(scene: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{scene}.json"))
}

fn prepared(scene: &str, set: &[(&str, f64)]) -> Model {
    let set = set.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    Model::load_with(&path(scene), &Overrides { set, ..Overrides::default() }).unwrap()
}

fn request(method: &str) -> Linear {
    Linear { method: MethodSpec::parse(method).unwrap(), chart: None }
}

fn model(prepared: &Model, state: &State, method: &str) -> LinearModel {
    state.variation(prepared).unwrap().linearize(&request(method)).unwrap()
}

fn over(scene: &str, range: &str, at: At) -> Loci {
    let overrides = Overrides::default();
    let family = Family::load_with(&path(scene), &overrides).unwrap();
    let range: Range = range.parse().unwrap();
    loci_over(&Variants { family: &family, overrides: &overrides, range: &range }, at, &request("mcs"), || ()).unwrap()
}

#[test]
fn two_masses_swing_at_five_radians_a_second() {
    let loci = loci_along(&prepared("two_mass", &[]), &request("mcs"), &[0.0, 0.3, 1.0], || ());
    assert_eq!((loci.along, loci.places.len(), loci.gaps.len(), loci.branches.len()), (LociVariable::Time, 3, 0, 2));
    let off = loci.branches[0].points.iter().map(|(_, value)| (value - c(0.0, 5.0)).norm());
    assert!(off.fold(0.0, f64::max) < 1e-12);
}

#[test]
fn frequency_over_the_stiffness_of_a_spring() {
    for at in [At::Start, At::Time(0.2), At::Equilibrium] {
        let loci = over("two_mass", "k1=10..1000:12:log", at);
        assert_eq!((loci.reached.len(), loci.branches.len()), (12, 2));
        assert!(loci.reached.iter().all(|state| state.equilibrium == (at == At::Equilibrium)));
        for (k1, value) in &loci.branches[0].points {
            assert!((value - c(0.0, (k1 / 4.0).sqrt())).norm() < 1e-10 * value.norm(), "{at:?} {k1}: {value}");
        }
    }
}

#[test]
fn values_without_a_scene_are_gaps() {
    let loci = over("two_mass", "m1=-2..2:5", At::Start);
    let gaps: Vec<f64> = loci.gaps.iter().map(|gap| gap.at).collect();
    assert!(gaps.contains(&-2.0) && gaps.contains(&-1.0) && !gaps.contains(&1.0), "{gaps:?}");
    assert_eq!(loci.reached.len() + gaps.len(), 5);
}

#[test]
fn coarse_states_do_not_exchange_the_modes_of_a_double_pendulum() {
    let prepared = prepared("double_pendulum", &[]);
    let times: Vec<f64> = (0..=60).map(|k| f64::from(k) / 6.0).collect();
    let loci = loci_along(&prepared, &request("mcs"), &times, || ());
    let fastest = |branch: &Branch| branch.points.iter().map(|(_, value)| value.norm() / TAU).fold(0.0, f64::max);
    let slow = fastest(&loci.branches[0]);
    let fast = fastest(&loci.branches[2]);
    assert!(slow < 0.5 && fast > 1.3, "{slow} {fast}");
    assert!(loci.branches.iter().all(|branch| branch.points.len() == 61));
}

/// Frequencies from 1 mHz to 1 kHz.
fn frequencies() -> Vec<f64> {
    (0..=120).map(|k| 10f64.powf(-3.0 + 0.05 * f64::from(k))).collect()
}

#[test]
fn two_masses_answer_as_the_formula_says() {
    let prepared = prepared("two_mass", &[("c1", 2.0)]);
    let state = at_rest(&prepared, &State::start(&prepared)).unwrap().state;
    for method in ["mcs", "rcs", "rcs:form=index2", "rcs:form=index1", "rcs:form=ggl", "baumgarte"] {
        let found = frequency_response(&model(&prepared, &state, method), &frequencies());
        for (f, response) in frequencies().iter().zip(found) {
            let s = c(0.0, TAU * f);
            let known = (s * s * 4.0 + s * 2.0 + 100.0).inv();
            // Of push to x1, x2, and to the force in the link, which accelerates the first mass.
            let response = response.unwrap();
            let off = [response[(0, 0)], response[(1, 0)]].map(|x| (x - known).norm() / known.norm());
            // Where phi is held by its derivatives only, slow answers lose digits as 1/s^2.
            let limit = if ["mcs", "rcs", "rcs:form=ggl"].contains(&method) { 1e-12 } else { 1e-9 };
            assert!(off[0] < limit && off[1] < limit, "{method} at {f} Hz: {off:?}");
        }
    }
}

#[test]
fn descriptor_and_minimal_models_answer_alike() {
    for (scene, inputs) in [("four_bar_spring", 1), ("quarter_car", 1), ("andrews", 1)] {
        let prepared = prepared(scene, &[]);
        let state = at_rest(&prepared, &State::start(&prepared)).unwrap().state;
        let [minimal, descriptor] =
            ["mcs", "rcs"].map(|method| frequency_response(&model(&prepared, &state, method), &frequencies()));
        let largest = minimal.iter().flatten().map(|response| response.camax()).fold(0.0, f64::max);
        for (a, b) in minimal.iter().zip(&descriptor) {
            let a = a.as_ref().unwrap();
            let b = b.as_ref().unwrap();
            assert_eq!(a.ncols(), inputs);
            let off = (a - b).camax();
            assert!(off < 1e-9 * a.camax().max(1e-6 * largest), "{scene}: {off} of {}", a.camax());
        }
    }
}

/// At the hanging pendulum neither energy nor the size of the reaction changes with the torque, to first order.
#[test]
fn what_cancels_to_round_off_does_not_respond() {
    let text = r#"{ "name": "pendulum", "dimension": 2, "gravity": [0, -9.81], "ground": { "markers": { "O": [0, 0] } },
        "bodies": [{ "name": "rod", "type": "rigid", "mass": 1, "inertia": "1/12", "markers": { "A": ["-1/2", 0] },
            "initial": { "position": [0.3, -0.4], "angle": -0.9 } }],
        "joints": [{ "name": "h", "type": "revolute", "between": ["ground.O", "rod.A"] }],
        "forces": [{ "name": "m", "type": "applied_torque", "at": "rod.A", "torque": 0 }],
        "inputs": [{ "name": "m", "force": "m" }],
        "outputs": [
            { "name": "angle", "measure": "angle", "of": "rod" }, { "name": "energy", "measure": "energy" },
            { "name": "pin", "measure": "reaction", "of": "h" }] }"#;
    let prepared = Model::new(Scene::parse(text, &[]).unwrap(), &Overrides::default()).unwrap();
    let state = at_rest(&prepared, &State::start(&prepared)).unwrap().state;
    for method in ["mcs", "rcs", "rcs:form=index2", "baumgarte"] {
        for response in frequency_response(&model(&prepared, &state, method), &frequencies()) {
            let [angle, energy, pin] = [0, 1, 2].map(|i| response.as_ref().unwrap()[(i, 0)]);
            assert!(angle.norm() > 0.0 && (energy, pin) == (c(0.0, 0.0), c(0.0, 0.0)), "{method}: {energy} {pin}");
        }
    }
}

#[test]
fn a_response_at_a_pole_is_none() {
    let prepared = prepared("two_mass", &[]);
    let state = at_rest(&prepared, &State::start(&prepared)).unwrap().state;
    let mut model = model(&prepared, &state, "mcs");
    model.a = Matrix::from_row_slice(2, 2, &[0.0, 1.0, -1.0, 0.0]);
    let found = frequency_response(&model, &[0.0, 1.0 / TAU, 1.0]);
    assert!(found[0].is_some() && found[2].is_some());
    // Rounding of 2 pi f may miss the pole by a hair; then the response is large.
    assert!(found[1].as_ref().is_none_or(|response| response.camax() > 1e10));
}
