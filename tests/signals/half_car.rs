//! The shipped car over its measured road, against the same car in coordinates of its own: place and angle of the body and
//! the lengths of the struts, by RK4, with a spline from a dense system of second derivatives.

use crate::scenes::{dop853, model, shipped};
use nalgebra::{DMatrix, DVector, SMatrix, SVector, Vector2};

type State = SVector<f64, 5>;

/// A not-a-knot spline by its second derivatives.
struct Spline {
    x: Vec<f64>,
    y: Vec<f64>,
    bends: DVector<f64>,
}

impl Spline {
    fn read() -> Self {
        let text = std::fs::read_to_string(model("half_car").with_file_name("data/rough_road.csv")).unwrap();
        let rows = text.lines().skip(1).map(|line| line.split_once(',').unwrap());
        let (x, y): (Vec<f64>, Vec<f64>) =
            rows.map(|(s, z)| (s.parse::<f64>().unwrap(), z.parse::<f64>().unwrap())).unzip();
        let n = x.len();
        let mut a = DMatrix::zeros(n, n);
        let mut b = DVector::zeros(n);
        for i in 1..n - 1 {
            let h = x[i] - x[i - 1];
            let k = x[i + 1] - x[i];
            (a[(i, i - 1)], a[(i, i)], a[(i, i + 1)]) = (h / 6.0, (h + k) / 3.0, k / 6.0);
            b[i] = (y[i + 1] - y[i]) / k - (y[i] - y[i - 1]) / h;
        }
        // The third derivative is the same on both sides; the points of this road are equally apart.
        for (row, i) in [(0, 1), (n - 1, n - 2)] {
            (a[(row, i - 1)], a[(row, i)], a[(row, i + 1)]) = (1.0, -2.0, 1.0);
        }
        let bends = a.lu().solve(&b).unwrap();
        Spline { x, y, bends }
    }

    /// Height and slope.
    fn at(&self, x: f64) -> [f64; 2] {
        let i = self.x.iter().rposition(|knot| *knot <= x).unwrap().min(self.x.len() - 2);
        let h = self.x[i + 1] - self.x[i];
        let u = (self.x[i + 1] - x) / h;
        let w = (x - self.x[i]) / h;
        let p = self.bends[i];
        let q = self.bends[i + 1];
        let y = u * self.y[i] + w * self.y[i + 1] + ((u.powi(3) - u) * p + (w.powi(3) - w) * q) * h * h / 6.0;
        let slope = (self.y[i + 1] - self.y[i]) / h + ((1.0 - 3.0 * u * u) * p + (3.0 * w * w - 1.0) * q) * h / 6.0;
        [y, slope]
    }
}

/// q'' of (x, y, angle, front strut, rear strut).
fn acceleration(road: &Spline, q: &State, v: &State) -> State {
    let g = 9.81;
    let body = 640.0;
    let inertia = 1100.0;
    let wheel = 42.0;
    let front = 1.2;
    let rear = 1.5;
    let (sine, cosine) = q[2].sin_cos();
    let turned = |x: f64, y: f64| Vector2::new(cosine * x - sine * y, sine * x + cosine * y);
    let mut mass = SMatrix::<f64, 5, 5>::from_diagonal(&State::new(body, body, inertia, 0.0, 0.0));
    let mut force = State::new(0.0, -body * g, 0.0, 0.0, 0.0);
    for (k, arm, other) in [(3, front, rear), (4, -rear, front)] {
        let load = body * g * other / (front + rear);
        let mut jacobian = SMatrix::<f64, 2, 5>::zeros();
        jacobian.fixed_columns_mut::<2>(0).fill_with_identity();
        jacobian.set_column(2, &turned(q[k], arm));
        jacobian.set_column(k, &turned(0.0, -1.0));
        // The part of the wheel's acceleration that is quadratic in the rates.
        let bias = turned(-arm, q[k]) * v[2] * v[2] + turned(1.0, 0.0) * (2.0 * v[2] * v[k]);
        let place = Vector2::new(q[0], q[1]) + turned(arm, -q[k]);
        let speed = jacobian * v;
        let [height, slope] = road.at(place.x);
        let radius = 0.3 + (load + wheel * g) / 190_000.0;
        let push = 190_000.0 * (radius - place.y + height) + 120.0 * (slope * speed.x - speed.y);
        mass += jacobian.transpose() * jacobian * wheel;
        force += jacobian.transpose() * (Vector2::new(0.0, push - wheel * g) - bias * wheel);
        force[k] -= 21_000.0 * (q[k] - 0.35) + 1500.0 * v[k] - load;
    }
    mass.lu().solve(&force).unwrap()
}

#[test]
fn the_car_moves_as_in_coordinates_of_its_own() {
    let road = Spline::read();
    let h = 1e-4;
    let each = 1000;
    let mut q = State::new(0.0, 0.65, 0.0, 0.35, 0.35);
    let mut v = State::new(15.0, 0.0, 0.0, 0.0, 0.0);
    let run = shipped("half_car", &[]).tight(1e-10, 3.0, h * f64::from(each));
    let columns = ["body.x", "body.y", "body.angle"].map(|name| run.column(name));
    let mut most = 0.0f64;
    for ((x, y), angle) in columns[0].iter().zip(&columns[1]).zip(&columns[2]).skip(1) {
        for _ in 0..each {
            let v1 = v;
            let a1 = acceleration(&road, &q, &v);
            let v2 = v + a1 * (h / 2.0);
            let a2 = acceleration(&road, &(q + v1 * (h / 2.0)), &(v + a1 * (h / 2.0)));
            let v3 = v + a2 * (h / 2.0);
            let a3 = acceleration(&road, &(q + v2 * (h / 2.0)), &(v + a2 * (h / 2.0)));
            let v4 = v + a3 * h;
            let a4 = acceleration(&road, &(q + v3 * h), &(v + a3 * h));
            q += (v1 + v2 * 2.0 + v3 * 2.0 + v4) * (h / 6.0);
            v += (a1 + a2 * 2.0 + a3 * 2.0 + a4) * (h / 6.0);
        }
        [x, y, angle].iter().zip(&q).for_each(|(found, own)| most = most.max((*found - own).abs()));
    }
    // RK4 across the points of the spline leaves some 1e-10; the body moves by centimetres.
    assert!(most < 1e-8, "{most:e}");
    let moved = columns[1].iter().fold(0.0f64, |moved, y| moved.max((y - 0.65).abs()));
    assert!(moved > 5e-3, "{moved}");
    let energy = run.record.energy.unwrap();
    assert!(energy.max_error < 1e-5, "{energy:?}");
}

/// The wheels meet points of the road in turn: a step that begins a little before one ends on it. Beyond it the error was
/// 90 tolerances, unseen by the estimate, since all stages of weight lay behind the point.
#[test]
fn steps_end_at_points_that_are_near() {
    let scene = shipped("half_car", &[]);
    let [rows, exact] = [1e-9, 1e-13].map(|rtol| scene.run(&dop853(rtol), scene.span()));
    let [rows, exact] = [rows, exact].map(|run| run.column("rear_wheel.y'"));
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0f64, |largest, x| largest.max(x.abs()));
    let size = largest(&mut exact.iter().copied());
    let error = largest(&mut rows.iter().zip(&exact).map(|(row, exact)| row - exact)) / size;
    assert!(error < 1e-8, "{error:e}");
}
