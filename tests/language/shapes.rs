//! Mass, centre and inertia from shapes, against textbook formulas, parts of a whole and the same body by hand.

use holonom::scene::{AnyModel, Model, Scene, json};
use serde_json::Value;
use std::array::from_fn;
use std::f64::consts::PI;

/// Mass, centre of mass from the origin, and Ixx, Iyy, Izz, Ixy, Ixz, Iyz (in the plane Izz).
struct Made {
    mass: f64,
    centre: Vec<f64>,
    inertia: Vec<f64>,
}

fn scene(dimension: usize, shapes: &Value) -> holonom::Result<Scene> {
    let body = json!({ "name": "b", "type": "rigid", "shapes": shapes });
    Scene::parse(&json!({ "name": "s", "dimension": dimension, "bodies": [body] }).to_string(), &[])
}

fn read<const D: usize>(model: &Model<D>) -> (Vec<f64>, Vec<f64>) {
    let body = &model.bodies[0].body;
    let mut values = vec![0.0; body.facts().mass_pattern.len()];
    body.mass(&[], &mut values);
    (values, body.markers()[0].offset.iter().map(|x| -x).collect())
}

fn made(dimension: usize, shapes: Value) -> Made {
    let (values, centre) = match scene(dimension, &shapes).unwrap().model {
        AnyModel::Planar(model) => read(&model),
        AnyModel::Spatial(model) => read(&model),
    };
    let mut inertia = values[dimension..].to_vec();
    inertia.resize(if dimension == 2 { 1 } else { 6 }, 0.0);
    Made { mass: values[0], centre, inertia }
}

#[track_caller]
fn agree(made: &Made, mass: f64, centre: &[f64], inertia: &[f64]) {
    let near = |found: &[f64], expected: &[f64]| {
        let largest = expected.iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
        found.len() == expected.len()
            && found.iter().zip(expected).all(|(x, y)| (x - y).abs() <= 1e-14 + 1e-13 * largest)
    };
    assert!((made.mass - mass).abs() <= 1e-13 * mass, "mass {} is not {mass}", made.mass);
    assert!(near(&made.centre, centre), "centre {:?} is not {centre:?}", made.centre);
    // M has no products where they are zero to the last digit.
    assert!(near(&made.inertia, inertia), "inertia {:?} is not {inertia:?}", made.inertia);
}

#[test]
fn every_shape_has_the_moments_of_its_textbook_formula() {
    let a = 0.3;
    let b = 0.5;
    let c = 0.7;
    let r = 0.2;
    let l = 1.1;
    let cylinder = |m: f64| [m * (3.0 * r * r + l * l) / 12.0, m * (3.0 * r * r + l * l) / 12.0, 0.5 * m * r * r];
    let tube = |m: f64| {
        let square = r * r + 0.01;
        [m * (3.0 * square + l * l) / 12.0, m * (3.0 * square + l * l) / 12.0, 0.5 * m * square]
    };
    let cuboid = |m: f64| [m * (b * b + c * c) / 12.0, m * (a * a + c * c) / 12.0, m * (a * a + b * b) / 12.0];
    let table: [(Value, f64, [f64; 3]); 8] = [
        (json!({ "box": [a, b, c] }), a * b * c, cuboid(1.0)),
        (json!({ "cylinder": { "radius": r, "length": l } }), PI * r * r * l, cylinder(1.0)),
        (json!({ "tube": { "outer": r, "inner": 0.1, "length": l } }), PI * (r * r - 0.01) * l, tube(1.0)),
        (json!({ "sphere": { "radius": r } }), 4.0 / 3.0 * PI * r.powi(3), [0.4 * r * r; 3]),
        (json!({ "rod": { "from": [0, 0, -0.55], "to": [0, 0, 0.55], "radius": r } }), PI * r * r * l, cylinder(1.0)),
        (json!({ "plate": [a, b], "thickness": c }), a * b * c, cuboid(1.0)),
        (json!({ "disc": { "radius": r }, "thickness": l }), PI * r * r * l, cylinder(1.0)),
        (
            json!({ "polygon": [[-0.15, -0.25], [0.15, -0.25], [0.15, 0.25], [-0.15, 0.25]], "thickness": c }),
            a * b * c,
            cuboid(1.0),
        ),
    ];
    for (mut shape, volume, moments) in table {
        shape["density"] = json!(2700);
        let mass = 2700.0 * volume;
        let [xx, yy, zz] = moments.map(|x| mass * x);
        agree(&made(3, json!([shape])), mass, &[0.0; 3], &[xx, yy, zz, 0.0, 0.0, 0.0]);
        // In the plane the same, but the rod along z, which is not in it.
        if shape.get("rod").is_none() {
            agree(&made(2, json!([shape])), mass, &[0.0; 2], &[zz]);
        }
    }
}

#[test]
fn a_triangle_and_a_slender_rod_in_the_plane() {
    let b = 0.6;
    let h = 0.9;
    let m = 2.0;
    // Both ways round: Izz = m (b^2 + h^2)/18 for a right angle.
    for corners in [json!([[1, 1], [1.6, 1], [1, 1.9]]), json!([[1, 1], [1, 1.9], [1.6, 1]])] {
        let triangle = made(2, json!([{ "polygon": corners, "mass": m }]));
        agree(&triangle, m, &[1.0 + b / 3.0, 1.0 + h / 3.0], &[m * (b * b + h * h) / 18.0]);
    }
    let rod = made(2, json!([{ "rod": { "from": [0, 0], "to": [0.3, 0.4] }, "mass": m, "at": [1, 0] }]));
    agree(&rod, m, &[1.15, 0.2], &[m * 0.25 / 12.0]);
}

/// The products: of two points of mass m at p, and of a rod along an oblique direction.
#[test]
fn turned_shapes_have_products_of_inertia() {
    let m = 1.5;
    let l = 1.2;
    let turned =
        json!([{ "cylinder": { "radius": 0.1, "length": l }, "mass": m, "at": [1, 2, 3], "z_axis": [1, 2, 2] }]);
    let u = [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    let along = 0.5 * m * 0.01;
    let across = m * (0.03 + l * l) / 12.0;
    // J = across 1 + (along - across) u u^T
    let entry = |i: usize, j: usize| if i == j { across } else { 0.0 } + (along - across) * u[i] * u[j];
    let tensor = [entry(0, 0), entry(1, 1), entry(2, 2), entry(1, 0), entry(2, 0), entry(2, 1)];
    agree(&made(3, turned), m, &[1.0, 2.0, 3.0], &tensor);
    let rod = json!([{ "rod": { "from": [0.8, 1.6, 2.6], "to": [1.2, 2.4, 3.4], "radius": 0.1 }, "mass": m }]);
    agree(&made(3, rod), m, &[1.0, 2.0, 3.0], &tensor);
}

#[test]
fn parts_make_the_whole() {
    let turn = json!([0.3, -0.4, 0.5]);
    let whole = made(3, json!([{ "box": [2, 1, 0.5], "density": 10, "rotation": turn }]));
    // Halves lie at +-0.5 along the turned x axis.
    let axis: [f64; 3] = {
        let halves = Scene::parse(
            r#"{ "name": "s", "dimension": 3, "bodies": [{ "name": "b", "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
                 "markers": { "p": { "position": [0, 0, 0], "rotation": [0.3, -0.4, 0.5] } } }] }"#,
            &[],
        );
        let AnyModel::Spatial(model) = halves.unwrap().model else { unreachable!() };
        model.bodies[0].body.markers()[1].axes[0]
    };
    let half = |sign: f64| {
        let at: [f64; 3] = from_fn(|i| sign * 0.5 * axis[i]);
        json!({ "box": [1, 1, 0.5], "density": 10, "rotation": turn, "at": at })
    };
    agree(&made(3, json!([half(1.0), half(-1.0)])), whole.mass, &[0.0; 3], &whole.inertia);
    let tube = made(3, json!([{ "tube": { "outer": 2, "inner": 1, "length": 3 }, "density": 5 }]));
    let drilled = json!([
        { "cylinder": { "radius": 2, "length": 3 }, "density": 5 },
        { "cylinder": { "radius": 1, "length": 3 }, "density": 5, "hole": true },
    ]);
    agree(&made(3, drilled), tube.mass, &[0.0; 3], &tube.inertia);
    let angle =
        json!([{ "polygon": [[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [0, 2]], "thickness": 0.1, "density": 5 }]);
    let two = json!([
        { "plate": [3, 1], "thickness": 0.1, "density": 5, "at": [1.5, 0.5] },
        { "plate": [1, 1], "thickness": 0.1, "density": 5, "at": [0.5, 1.5] },
    ]);
    let angle = made(2, angle);
    let two = made(2, two);
    agree(&angle, two.mass, &two.centre, &two.inertia);
}

/// Markers and `initial` refer to the origin that the shapes are given from.
#[test]
fn a_pendulum_of_shapes_moves_as_by_hand() {
    let scene = |body: &str| {
        let text = format!(
            r#"{{ "name": "s", "dimension": 3, "gravity": [0, 0, -9.81],
                "ground": {{ "markers": {{ "O": {{ "position": [1, 0, 0], "z_axis": [0, 1, 0] }} }} }},
                "bodies": [{{ "name": "b", "type": "rigid", {body},
                    "initial": {{ "position": [1, 0, 0], "angular_velocity": [0, 2, 0] }} }}],
                "joints": [{{ "name": "O", "type": "revolute", "between": ["ground.O", "b.A"] }}],
                "outputs": [{{ "name": "x", "measure": "position", "of": "b.B", "component": "x" }}] }}"#
        );
        *crate::scenes::parse(&text).tight(1e-11, 1.3, 1.3).column("x").last().unwrap()
    };
    let markers = r#""markers": { "A": { "position": [0, 0, 0], "z_axis": [0, 1, 0] }, "B": [2, 0, 0] }"#;
    let shapes = scene(&format!(
        r#"{markers}, "shapes": [{{ "rod": {{ "from": [0, 0, 0], "to": [2, 0, 0] }}, "mass": 3 }},
            {{ "sphere": {{ "radius": 0.3 }}, "mass": 2, "at": [2, 0, 0] }}]"#
    ));
    // Centre at (3 + 4)/5; about it the rod and the sphere.
    let ball = 0.4 * 2.0 * 0.09;
    let across = 3.0 * (4.0 / 12.0 + 0.16) + ball + 2.0 * 0.36;
    let hand =
        scene(&format!(r#"{markers}, "origin": [-1.4, 0, 0], "mass": 5, "inertia": [{ball}, {across}, {across}]"#));
    assert!((shapes - hand).abs() < 1e-10 && (shapes - 3.0).abs() > 0.1, "{shapes} {hand}");
}

#[test]
fn impossible_shapes_are_refused() {
    let table = [
        (json!([]), "at bodies[0].shapes (`b`): the list of shapes is empty"),
        (json!([{ "box": [1, 1, 1] }]), "at bodies[0].shapes[0] (`b`): a shape has either a density or a mass"),
        (json!([{ "box": [1, 1, 1], "density": -1 }]), "at bodies[0].shapes[0].density (`b`): density is -1"),
        (json!([{ "box": [1, -1, 1], "mass": 1 }]), "at bodies[0].shapes[0].box[1] (`b`): "),
        (json!([{ "box": [1, 1], "mass": 1 }]), "at bodies[0].shapes[0].box (`b`): expected 3 edges, found 2"),
        (json!([{ "plate": [1, 1], "density": 1 }]), "density (`b`): the shape has a density, but no volume"),
        (json!([{ "sphere": { "radius": 1 }, "thickness": 1, "mass": 1 }]), "a sphere has no thickness"),
        (json!([{ "sphere": { "radius": 1 }, "box": [1, 1, 1], "mass": 1 }]), "found box and sphere"),
        (json!([{ "mass": 1 }]), "expected one kind of shape, found none"),
        (json!([{ "tube": { "outer": 1, "inner": 2, "length": 1 }, "mass": 1 }]), "the inner radius 2 is not below"),
        (json!([{ "rod": { "from": [0, 0, 1], "to": [0, 0, 1] }, "mass": 1 }]), "the rod has no length"),
        (json!([{ "polygon": [[0, 0], [1, 1], [1, 0], [0, 1]], "mass": 1 }]), "or crosses itself"),
        (json!([{ "polygon": [[0, 0], [1, 1]], "mass": 1 }]), "the polygon encloses no area"),
        (json!([{ "sphere": { "radius": 1 }, "mass": 1, "angle": 1 }]), "a spatial shape needs more than one angle"),
        (json!([{ "sphere": { "radius": 1 }, "mass": 1, "hole": true }]), "the shapes have a mass of -1 kg together"),
        (
            json!([{ "sphere": { "radius": 1 }, "mass": 2 }, { "sphere": { "radius": 1 }, "mass": 1, "at": [9, 0, 0], "hole": true }]),
            "at bodies[0].shapes (`b`): a principal moment of inertia is",
        ),
    ];
    for (shapes, expected) in table {
        let message = scene(3, &shapes).map(|_| ()).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
    for key in [r#""mass": 1"#, r#""inertia": [1, 1, 1]"#, r#""origin": [0, 0, 0]"#] {
        let body = format!(
            r#"{{ "name": "b", "type": "rigid", {key}, "shapes": [{{ "sphere": {{ "radius": 1 }}, "mass": 1 }}] }}"#
        );
        let text = format!(r#"{{ "name": "s", "dimension": 3, "bodies": [{body}] }}"#);
        let message = Scene::parse(&text, &[]).map(|_| ()).unwrap_err().to_string();
        assert!(message.contains("is given, and `shapes` from which it follows"), "{message}");
    }
}
