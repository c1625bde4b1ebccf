//! Models to write and draw.

use holonom::linearize::{Complex, Cost, Kind, LinearModel, LinearizationPoint, Matrix, Mode, Reduction};
use holonom::prepared::{Model, Overrides};
use holonom::system::{Need, OperatingPoint, Scratch, Tangent, Terms};
use nalgebra::{DMatrix, DVector};
use std::path::Path;

pub fn prepared(name: &str) -> Model {
    Model::load_with(&Path::new("models").join(format!("{name}.json")), &Overrides::default()).unwrap()
}

pub fn complex(re: f64, im: f64) -> Complex<f64> {
    Complex::new(re, im)
}

/// The start of a scene with M, K and C on the directions that the constraints allow, held as they are.
pub fn plain(prepared: &Model) -> LinearModel {
    let system = prepared.system();
    let n = prepared.system().dimensions();
    let structure = system.structure();
    let mut terms = Terms::new(system);
    let mut scratch = Scratch::default();
    let (q, v) = prepared.start();
    let vdot = &prepared.assembly.vdot;
    let lambda = &prepared.assembly.lambda;
    let t = prepared.start_time();
    system.evaluate(t, q, v, Need::DYNAMICS, &mut terms, &mut scratch);
    let mut tangent = Tangent::new(&structure.tangent);
    assert!(system.tangent(OperatingPoint { t, q, v, vdot, lambda }, &mut tangent, &mut scratch));
    let dense = |rows: usize, entries: &[(usize, usize)], values: &[f64]| {
        let mut matrix = Matrix::zeros(rows, n.v);
        entries.iter().zip(values).for_each(|((i, j), value)| matrix[(*i, *j)] += value);
        matrix
    };
    let lower = dense(n.v, &structure.mass.entries, &terms.mass);
    let mass = &lower + lower.transpose() - Matrix::from_diagonal(&lower.diagonal());
    let [k, c] = [&tangent.k, &tangent.c].map(|values| dense(n.v, &structure.tangent.entries, values));
    let g = dense(n.lambda, &structure.g.entries, &terms.g);
    let z = null_space(&g);
    let reduce = |matrix: &Matrix| z.transpose() * matrix * &z;
    let inverse = reduce(&mass).try_inverse().unwrap();
    let f = z.ncols();
    let mut a = Matrix::zeros(2 * f, 2 * f);
    a.view_mut((0, f), (f, f)).fill_with_identity();
    a.view_mut((f, 0), (f, f)).copy_from(&(-&inverse * reduce(&k)));
    a.view_mut((f, f), (f, f)).copy_from(&(-&inverse * reduce(&c)));
    let names: Vec<String> = (1..=f).map(|i| format!("z{i}")).collect();
    let states = names.iter().cloned().chain(names.iter().map(|name| format!("{name}'"))).collect();
    let mut values: Vec<Complex<f64>> = a.complex_eigenvalues().iter().copied().collect();
    values.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(b.im.total_cmp(&a.im)));
    let modes = values.iter().map(|value| mode(&a, &z, *value)).collect();
    LinearModel {
        method: "mcs".to_string(),
        chart: "frozen".to_string(),
        states,
        inputs: vec!["torque".to_string()],
        orders: vec![0],
        outputs: vec!["crank_angle".to_string(), "pin_A.x".to_string()],
        b: Matrix::from_element(2 * f, 1, 0.5),
        c: Matrix::from_element(2, 2 * f, -1.0),
        d: Matrix::from_element(2, 1, 0.0),
        a,
        e: None,
        modes,
        frame: None,
        state: Default::default(),
        point: LinearizationPoint {
            states: 0,
            t,
            q: q.to_vec(),
            v: v.to_vec(),
            vdot: vdot.clone(),
            lambda: lambda.clone(),
            u: vec![0.0],
            phi: 1.5e-16,
            phi_dot: 2e-15,
            is_equilibrium: false,
            axes: None,
            driven: None,
        },
        cost: Cost {
            assembly_seconds: 12.3e-6,
            eigen_seconds: 4.56e-6,
            conditioning: 3.2,
            size: 2 * f,
            off_constraints: None,
        },
        reduction: Reduction { condition: 2.0, error: 1e-15 },
    }
}

fn null_space(g: &Matrix) -> Matrix {
    let values = (g.transpose() * g).symmetric_eigen();
    let free = (0..g.ncols()).filter(|i| values.eigenvalues[*i].abs() < 1e-9 * values.eigenvalues.amax().max(1.0));
    Matrix::from_columns(&free.map(|i| values.eigenvectors.column(i).into_owned()).collect::<Vec<_>>())
}

fn mode(a: &Matrix, z: &Matrix, value: Complex<f64>) -> Mode {
    let n = a.nrows();
    let shift = value * complex(1.0 + 1e-9, 0.0) + complex(1e-12, 0.0);
    let shifted = a.map(|x| complex(x, 0.0)) - DMatrix::identity(n, n) * shift;
    let mut x = DVector::from_fn(n, |i, _| complex(1.0 + 0.1 * i as f64, 0.3));
    for _ in 0..3 {
        x = shifted.clone().lu().solve(&x).unwrap();
        x /= complex(x.norm(), 0.0);
    }
    let shape = z.map(|x| complex(x, 0.0)) * x.rows(0, n / 2);
    let largest = shape.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap();
    let weight: f64 = x.iter().map(|x| x.norm_sqr()).sum();
    let participation = x.iter().map(|x| x.norm_sqr() / weight).collect();
    Mode {
        value,
        kind: Kind::Physical,
        shape: shape.iter().map(|x| x / largest).collect(),
        participation,
        energy: Vec::new(),
        mass: 1.0,
        outputs: Vec::new(),
        rounding: 0.0,
        condition: 1.0,
        error: 0.0,
    }
}

/// A model of the four bar with an eigenvalue of each kind and E.
pub fn descriptor(prepared: &Model) -> LinearModel {
    let mut model = plain(prepared);
    let mode = |value, kind, participation: Vec<f64>| Mode {
        value,
        kind,
        shape: Vec::new(),
        participation,
        energy: Vec::new(),
        mass: 1.0,
        outputs: Vec::new(),
        rounding: 0.0,
        condition: 1.0,
        error: 0.0,
    };
    let spurious = [complex(-5.0, 1.0), complex(-5.0, -1.0), complex(-7.0, 0.0)];
    model.modes.extend(spurious.map(|value| mode(value, Kind::Spurious, vec![0.25, 0.75])));
    model.modes.extend((0..4).map(|_| mode(complex(f64::INFINITY, 0.0), Kind::Infinite, Vec::new())));
    model.modes[0].participation = vec![0.4, 0.5995];
    model.method = "rcs:form=index2".to_string();
    model.e = Some(Matrix::identity(2, 2));
    model.cost.conditioning = f64::INFINITY;
    model
}

/// Nothing moves.
pub fn empty(prepared: &Model) -> LinearModel {
    let mut model = plain(prepared);
    (model.states, model.modes) = (Vec::new(), Vec::new());
    (model.a, model.b) = (Matrix::zeros(0, 0), Matrix::zeros(0, 1));
    model.c = Matrix::zeros(2, 0);
    model
}
