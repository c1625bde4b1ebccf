//! The equations of motion of flexible bodies in floating frames, against sums over the points that carry their mass.

use holonom::body::flexible::{Disc, Elastic, MassIntegrals, Piece, PointShape, Second, Stretch};
use holonom::body::floating::{Floating, frame_coordinates, frame_velocities};
use holonom::body::{Body, BodyOver, BodyState, Frame, Marker, Wrench, dot};
use holonom::math::Taylor;

/// Numbers between -1 and 1 without a pattern.
struct Stir(f64);

impl Stir {
    fn next(&mut self) -> f64 {
        self.0 += 1.0;
        (self.0 * 12.9898).sin() * (1.0 + (self.0 * 0.37).cos()) / 2.0
    }
    fn vector<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.next())
    }
    fn list(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.next()).collect()
    }
}

/// Point masses in pieces, each moved by the elastic coordinates of its piece.
struct Cloud<const D: usize> {
    body: Floating<D>,
    masses: Vec<f64>,
}

/// Elastic coordinates of each piece: they overlap as those of finite elements do.
const DOFS: [&[usize]; 3] = [&[0, 1, 2], &[2, 4, 3], &[5]];
const ELASTIC: usize = 6;

/// `is_curved`: with rotations, arms that turn with them, and displacements of second order.
fn cloud<const D: usize>(is_curved: bool) -> Cloud<D> {
    let mut stir = Stir(D as f64);
    let mut pieces = Vec::new();
    let mut masses = Vec::new();
    let mut shapes = vec![still()];
    for dofs in DOFS {
        let n = dofs.len() + 1;
        let mut piece = Piece {
            dofs: dofs.to_vec(),
            mass: 0.0,
            moments: vec![[0.0; D]; n],
            products: vec![[[0.0; D]; D]; n * n],
            second: if is_curved { second(dofs.len(), &mut stir) } else { vec![Vec::new(); dofs.len()] },
        };
        for _ in 0..4 {
            let mass = 1.5 + stir.next();
            let psi: Vec<[f64; D]> = (0..n).map(|_| stir.vector()).collect();
            piece.mass += mass;
            for a in 0..n {
                (0..D).for_each(|i| piece.moments[a][i] += mass * psi[a][i]);
                for b in 0..n {
                    let product = &mut piece.products[a * n + b];
                    (0..D).for_each(|i| (0..D).for_each(|j| product[i][j] += mass * psi[a][i] * psi[b][j]));
                }
            }
            let rotation = (1..n).map(|_| if is_curved { stir.vector() } else { [0.0; 3] }).collect();
            let arm = if is_curved { stir.vector() } else { [0.0; D] };
            shapes.push(PointShape {
                rest: psi[0],
                arm,
                dofs: dofs.to_vec(),
                translation: psi[1..].to_vec(),
                shortening: if is_curved { symmetric(dofs.len(), &mut stir) } else { vec![] },
                rotation,
            });
            masses.push(mass);
        }
        pieces.push(piece);
    }
    let matrix = |stir: &mut Stir| {
        let places = (0..ELASTIC).flat_map(|i| (0..=i).map(move |j| (i, j)));
        places.map(|(i, j)| (i, j, stir.next() + if i == j { 6.0 } else { 0.0 })).collect::<Vec<_>>()
    };
    let stretch = |stir: &mut Stir, dofs: &[usize]| Stretch {
        ends: [0.0, 1.0],
        dofs: dofs.to_vec(),
        quartic: 1.0,
        weight: 3.0,
        axial: stir.list(dofs.len()),
        slopes: symmetric(dofs.len(), stir),
    };
    let elastic = Elastic {
        names: (1..=ELASTIC).map(|i| format!("e{i}")).collect(),
        inertia: MassIntegrals { pieces, discs: if is_curved { discs(&mut stir) } else { vec![] } },
        stiffness: matrix(&mut stir),
        damping: matrix(&mut stir),
        stretches: vec![stretch(&mut stir, &[0, 3]), stretch(&mut stir, &[1, 2, 5])],
        line: None,
    };
    let markers = shapes.iter().map(|shape| Marker::point(shape.rest)).collect();
    Cloud { body: Floating::new(elastic, markers, shapes), masses }
}

fn still<const D: usize>() -> PointShape<D> {
    PointShape {
        rest: [0.0; D],
        arm: [0.0; D],
        dofs: vec![],
        translation: vec![],
        rotation: vec![],
        shortening: vec![],
    }
}

/// Sections that turn, and some that do not.
fn discs(stir: &mut Stir) -> Vec<Disc> {
    let mut disc = |dofs: &[usize]| {
        let [a, b, c]: [f64; 3] = stir.vector();
        let inertia = [[2.0, a / 3.0, b / 3.0], [a / 3.0, 2.5, c / 3.0], [b / 3.0, c / 3.0, 3.0]];
        Disc { dofs: dofs.to_vec(), rotation: dofs.iter().map(|_| stir.vector()).collect(), inertia }
    };
    [&[1, 0][..], &[2, 4, 3], &[]].map(&mut disc).to_vec()
}

/// The same for (i, j) and (j, i).
fn second<const D: usize>(n: usize, stir: &mut Stir) -> Vec<Vec<Second<D>>> {
    let mut rows = vec![Vec::new(); n];
    for (i, j) in (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))) {
        let moment = stir.vector();
        let product = std::array::from_fn(|_| stir.vector());
        rows[i].push(Second { other: j, moment, product });
        if i != j {
            rows[j].push(Second { other: i, moment, product });
        }
    }
    rows
}

/// A full symmetric matrix, row by row.
fn symmetric(n: usize, stir: &mut Stir) -> Vec<f64> {
    let half = stir.list(n * n);
    (0..n * n).map(|k| half[k] + half[k % n * n + k / n]).collect()
}

struct State<const D: usize> {
    q: Vec<f64>,
    v: Vec<f64>,
    vdot: Vec<f64>,
    gravity: [f64; D],
}

fn state<const D: usize>(body: &Floating<D>) -> State<D> {
    let mut stir = Stir(77.0);
    let nq = frame_coordinates(D) + ELASTIC;
    let nv = frame_velocities(D) + ELASTIC;
    let mut q = stir.list(nq);
    body.normalize(&mut q);
    State { q, v: stir.list(nv), vdot: stir.list(nv), gravity: stir.vector() }
}

/// M v' - f of the body.
fn residual<const D: usize>(body: &Floating<D>, q: &[f64], v: &[f64], vdot: &[f64], gravity: &[f64; D]) -> Vec<f64> {
    let pattern = body.facts().mass_pattern;
    let mut mass = vec![0.0; pattern.len()];
    body.mass(q, &mut mass);
    let mut f = vec![0.0; v.len()];
    body.own_forces(q, v, gravity, &mut f);
    let mut r: Vec<f64> = f.iter().map(|f| -f).collect();
    for (&(i, j), m) in pattern.iter().zip(&mass) {
        r[i] += m * vdot[j];
        if i != j {
            r[j] += m * vdot[i];
        }
    }
    r
}

fn motion<const D: usize>(
    body: &Floating<D>,
    q: &[f64],
    v: &[f64],
    vdot: Option<&[f64]>,
) -> Vec<Frame<Taylor<f64>, D>> {
    let mut frames = vec![Frame::world(); body.markers().len()];
    BodyOver::<f64, D>::motion(body, q, v, vdot, 0, &mut frames);
    frames
}

/// sum over the points of m dx/dv . (x'' - g), by their frames and the body's pull-back: none of the shape integrals.
fn by_points<const D: usize>(cloud: &Cloud<D>, state: &State<D>) -> Vec<f64> {
    let frames = motion(&cloud.body, &state.q, &state.v, Some(&state.vdot));
    let mut r = vec![0.0; state.v.len()];
    for (i, (frame, mass)) in frames[1..].iter().zip(&cloud.masses).enumerate() {
        let force = std::array::from_fn(|k| mass * (frame.r[k].dd - state.gravity[k]));
        let support = cloud.body.facts().support(i + 1);
        let mut f = vec![0.0; support.len()];
        let wrench = Wrench { force, ..Wrench::zero() };
        BodyOver::<f64, D>::pull_back(&cloud.body, i + 1, &state.q, &frame.map(|x| x.x), &wrench, &mut f);
        support.iter().zip(f).for_each(|(&velocity, f)| r[velocity] += f);
    }
    r
}

fn inertia_is_that_of_the_points<const D: usize>() {
    let cloud = cloud::<D>(false);
    let state = state(&cloud.body);
    // The elastic forces are what is left at rest without gravity.
    let still = vec![0.0; state.v.len()];
    let mut elastic = residual(&cloud.body, &state.q, &still, &still, &[0.0; D]);
    let damping = |v: &[f64]| -> Vec<f64> {
        let at = vec![0.0; state.q.len()];
        let mut at_rest = at.clone();
        if D == 3 {
            at_rest[3] = 1.0;
        }
        let mut only = still.clone();
        only[frame_velocities(D)..].copy_from_slice(&v[frame_velocities(D)..]);
        // With no turning, u' has no inertia force: what is left is D q'.
        residual(&cloud.body, &at_rest, &only, &still, &[0.0; D])
    };
    elastic.iter_mut().zip(damping(&state.v)).for_each(|(e, d)| *e += d);
    let by_shapes = residual(&cloud.body, &state.q, &state.v, &state.vdot, &state.gravity);
    let by_points = by_points(&cloud, &state);
    for ((shapes, points), elastic) in by_shapes.iter().zip(&by_points).zip(&elastic) {
        assert!((shapes - elastic - points).abs() < 1e-12 * 100.0, "{shapes} - {elastic} is not {points}");
    }
    // Kinetic energy.
    let frames = motion(&cloud.body, &state.q, &state.v, None);
    let points: f64 = frames[1..]
        .iter()
        .zip(&cloud.masses)
        .map(|(frame, m)| 0.5 * m * dot(&frame.velocity(), &frame.velocity()))
        .sum();
    let weight: f64 =
        frames[1..].iter().zip(&cloud.masses).map(|(frame, m)| -m * dot(&frame.r.map(|x| x.x), &state.gravity)).sum();
    let energy = cloud.body.energy(&state.q, &state.v, &state.gravity);
    let unloaded = cloud.body.energy(&state.q, &state.v, &[0.0; D]);
    assert!((energy.kinetic - points).abs() < 1e-12 * points, "{} is not {points}", energy.kinetic);
    assert!((energy.potential - unloaded.potential - weight).abs() < 1e-12 * (1.0 + weight.abs()));
}

#[test]
fn inertia_in_the_plane_is_that_of_the_points() {
    inertia_is_that_of_the_points::<2>();
}

#[test]
fn inertia_in_space_is_that_of_the_points() {
    inertia_is_that_of_the_points::<3>();
}

/// v.(M v' - f) is the rate of the energy and what damping takes, with all terms of second order: central differences with
/// h = 1e-5 of energies near 100 are right to about 1e-9.
fn forces_do_the_work_of_the_energy<const D: usize>() {
    let body = cloud::<D>(true).body;
    let State { q, v, vdot, gravity } = state(&body);
    let mut rate = vec![0.0; q.len()];
    BodyOver::<f64, D>::rate(&body, &q, &v, &mut rate);
    let energy = |h: f64| {
        let at = |x: &[f64], rate: &[f64]| x.iter().zip(rate).map(|(x, rate)| x + h * rate).collect::<Vec<_>>();
        let energy = body.energy(&at(&q, &rate), &at(&v, &vdot), &gravity);
        energy.kinetic + energy.potential
    };
    let h = 1e-5;
    let change = (energy(h) - energy(-h)) / (2.0 * h) + body.dissipation(&v);
    let power = dot_all(&v, &residual(&body, &q, &v, &vdot, &gravity));
    assert!((power - change).abs() < 1e-8 * 100.0, "{power} is not {change}");
}

fn dot_all(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn forces_in_the_plane_do_the_work_of_the_energy() {
    forces_do_the_work_of_the_energy::<2>();
}

#[test]
fn forces_in_space_do_the_work_of_the_energy() {
    forces_do_the_work_of_the_energy::<3>();
}

/// Central differences with h = 1e-6 of numbers near 100 are right to about 1e-8.
fn tangent_is_the_slope<const D: usize>() {
    let body = cloud::<D>(true).body;
    let State { q, v, vdot, gravity } = state(&body);
    let pattern = body.facts().tangent_pattern;
    let mut k = vec![0.0; pattern.len()];
    let mut c = vec![0.0; pattern.len()];
    body.tangent(BodyState { q: &q, v: &v, vdot: &vdot, gravity: &gravity }, &mut k, &mut c);
    let n = v.len();
    let dense = |values: &[f64]| {
        let mut matrix = vec![0.0; n * n];
        pattern.iter().zip(values).for_each(|(&(i, j), value)| matrix[i * n + j] += value);
        matrix
    };
    let k = dense(&k);
    let c = dense(&c);
    let h = 1e-6;
    for j in 0..n {
        let unit: Vec<f64> = (0..n).map(|i| if i == j { 1.0 } else { 0.0 }).collect();
        let mut rate = vec![0.0; q.len()];
        BodyOver::<f64, D>::rate(&body, &q, &unit, &mut rate);
        let moved = |s: f64| q.iter().zip(&rate).map(|(q, r)| q + s * r).collect::<Vec<_>>();
        let faster = |s: f64| v.iter().zip(&unit).map(|(v, u)| v + s * u).collect::<Vec<_>>();
        let r = |q: &[f64], v: &[f64]| residual(&body, q, v, &vdot, &gravity);
        let slopes = [(&k, r(&moved(h), &v), r(&moved(-h), &v)), (&c, r(&q, &faster(h)), r(&q, &faster(-h)))];
        for (exact, ahead, behind) in slopes {
            for i in 0..n {
                let difference = (ahead[i] - behind[i]) / (2.0 * h);
                let exact = exact[i * n + j];
                assert!((exact - difference).abs() < 2e-7, "row {i}, column {j}: {exact} is not {difference}");
            }
        }
    }
}

#[test]
fn k_and_c_in_the_plane_are_slopes() {
    tangent_is_the_slope::<2>();
}

#[test]
fn k_and_c_in_space_are_slopes() {
    tangent_is_the_slope::<3>();
}

/// The power of a wrench at a point is that of its generalized forces: pull-back and motion agree, rotations included.
fn pull_back_keeps_power<const D: usize>() {
    let body = cloud::<D>(true).body;
    let State { q, v, .. } = state(&body);
    let frames = motion(&body, &q, &v, None);
    let mut stir = Stir(5.0);
    for (i, frame) in frames.iter().enumerate() {
        let torque: [f64; 3] = stir.vector();
        let wrench = Wrench { force: stir.vector(), torque: if D == 2 { [0.0, 0.0, torque[2]] } else { torque } };
        let support = body.facts().support(i);
        let mut f = vec![0.0; support.len()];
        BodyOver::<f64, D>::pull_back(&body, i, &q, &frame.map(|x| x.x), &wrench, &mut f);
        let generalized: f64 = support.iter().zip(&f).map(|(&velocity, f)| v[velocity] * f).sum();
        let spin = frame.angular_velocity();
        let turning: f64 = spin.iter().zip(wrench.torque).map(|(w, m)| w * m).sum();
        let power = dot(&frame.velocity(), &wrench.force) + turning;
        assert!((generalized - power).abs() < 1e-12 * 20.0, "marker {i}: {generalized} is not {power}");
    }
}

#[test]
fn pull_back_in_the_plane_keeps_power() {
    pull_back_keeps_power::<2>();
}

#[test]
fn pull_back_in_space_keeps_power() {
    pull_back_keeps_power::<3>();
}
