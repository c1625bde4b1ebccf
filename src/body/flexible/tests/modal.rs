//! Bodies in modal coordinates: a reduced beam written out and read back is the same body; errors of invalid data.

use super::npy::{bytes, npy};
use super::*;
use crate::body::flexible::modal::{Array, Lumped, ModalBody, ModalData, ModalShapes, Node, Nodes};
use crate::body::flexible::{PointShape, gauss_legendre, on_interval};
use crate::math::array::from_fn;
use std::io::Write;
use std::path::Path;

const ELEMENTS: u32 = 6;
const L: f64 = 1.5;

/// A reduced beam whose sections have inertia, so that masses on and off its line have exactly its inertia.
fn reduced<const D: usize>() -> Elastic<D> {
    let more = json!({
        "elements": ELEMENTS, "theory": "timoshenko", "modes": 3, "frame_conditions": "mean", "damping": { "modal": 0.01 },
    });
    match D {
        2 => {
            let mut scene = beam(more);
            scene["stiffness"]["GA"] = json!(500);
            build(&scene, &[0.0, L]).unwrap()
        }
        _ => build(&beam_in_space(more), &[0.0, L]).unwrap(),
    }
}

fn numbers(shape: &[usize], values: Vec<f64>) -> Array {
    assert_eq!(values.len(), shape.iter().product::<usize>());
    Array { shape: shape.to_vec(), values }
}

/// Mode shapes of a point as dimension x n.
fn translation<const D: usize>(point: &PointShape<D>) -> Array {
    let rows = (0..D).flat_map(|k| point.translation.iter().map(move |mode| mode[k]));
    numbers(&[D, point.dofs.len()], rows.collect())
}

fn rotation<const D: usize>(point: &PointShape<D>) -> Array {
    let parts = if D == 2 { 2..3 } else { 0..3 };
    let rows = parts.clone().flat_map(|k| point.rotation.iter().map(move |mode| mode[k]));
    numbers(&[parts.len(), point.dofs.len()], rows.collect())
}

fn at<const D: usize>(rod: &Elastic<D>, place: [f64; 3]) -> PointShape<D> {
    rod.line.as_ref().unwrap().point(from_fn(|k| place[k]))
}

/// The beam as another program would export it: masses at its points of integration and at arms beside them.
fn export<const D: usize>(rod: &Elastic<D>) -> ModalData<Array> {
    let rho_i = if D == 2 { [0.0, 1e-3] } else { [2e-3, 1e-3] };
    let arms = [
        ([0.0, 0.0], 0.8 - rho_i[0] - rho_i[1]),
        ([1.0, 0.0], rho_i[1] / 2.0),
        ([-1.0, 0.0], rho_i[1] / 2.0),
        ([0.0, 1.0], rho_i[0] / 2.0),
        ([0.0, -1.0], rho_i[0] / 2.0),
    ];
    let rule = gauss_legendre(4);
    let mut lumped = Vec::new();
    for element in 0..ELEMENTS {
        let ends = [element, element + 1].map(|k| f64::from(k) * L / f64::from(ELEMENTS));
        for (s, weight) in on_interval(&rule, ends) {
            for ([y, z], density) in arms.iter().filter(|arm| arm.1 > 0.0) {
                let point = at(rod, [s, *y, *z]);
                lumped.push(Lumped {
                    mass: Array::number(density * weight),
                    position: numbers(&[D], point.rest.to_vec()),
                    translation: translation(&point),
                });
            }
        }
    }
    let node = |name: &str, place: [f64; 3]| {
        let point = at(rod, place);
        let position = numbers(&[D], point.rest.to_vec());
        (name.to_string(), Node { position, translation: translation(&point), rotation: Some(rotation(&point)) })
    };
    let diagonal =
        |matrix: &[(usize, usize, f64)]| numbers(&[matrix.len()], matrix.iter().map(|entry| entry.2).collect());
    ModalData {
        modal_stiffness: Some(diagonal(&rod.stiffness)),
        modal_damping: Some(diagonal(&rod.damping)),
        lumped: Some(lumped),
        nodes: Some(Nodes(vec![node("left", [0.0; 3]), node("tip", [L, 0.1, 0.0])])),
        ..ModalData::default()
    }
}

fn read<const D: usize>(body: Value, folder: &Path) -> Result<ModalShapes<D>> {
    let body: ModalBody = crate::body::parse(body).unwrap();
    let parameters = Parameters::default();
    let table = MarkerTable::default();
    let switches = &Default::default();
    let turnings = &Default::default();
    body.shapes(&Build {
        parameters: &parameters,
        markers: &table,
        outputs: &(),
        gravity: [0.0; D],
        folder,
        switches,
        turnings,
    })
}

#[track_caller]
fn assert_same<const D: usize>(rod: &Elastic<D>, found: &ModalShapes<D>) {
    let a = whole(rod);
    let b = &found.elastic.inertia.pieces[0];
    assert_close(a.mass, b.mass, 1e-14);
    let flat = |x: &[[f64; D]]| x.concat();
    flat(&a.moments).iter().zip(flat(&b.moments)).for_each(|(a, b)| assert_close(*a, b, 1e-12));
    flat(&a.products.concat()).iter().zip(flat(&b.products.concat())).for_each(|(a, b)| assert_close(*a, b, 1e-11));
    assert_eq!((&rod.stiffness, &rod.damping), (&found.elastic.stiffness, &found.elastic.damping));
    assert_eq!(rod.names, found.elastic.names);
    // The data do not contain the rotation of sections.
    let node = |name: &str, place| (name.to_string(), PointShape { arm: [0.0; D], ..at(rod, place) });
    assert_eq!(found.nodes, [node("left", [0.0; 3]), node("tip", [L, 0.1, 0.0])]);
}

#[test]
fn a_beam_written_as_json_is_read_as_it_was() {
    fn check<const D: usize>() {
        let rod = reduced::<D>();
        let data = export(&rod);
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("rod.json"), serde_json::to_string(&data).unwrap()).unwrap();
        assert_same(&rod, &read(json!({ "file": "rod.json" }), folder.path()).unwrap());
        assert_same(&rod, &read(json!({ "data": data }), Path::new("")).unwrap());
    }
    check::<2>();
    check::<3>();
}

/// An archive as numpy.savez_compressed writes it; matrices with more than one row in Fortran's order.
fn write_npz(path: &Path, arrays: &[(&str, Array)], names: &[&str]) {
    let mut archive = zip::ZipWriter::new(std::fs::File::create(path).unwrap());
    let options = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated);
    let mut write = |name: &str, file: &[u8]| {
        archive.start_file(format!("{name}.npy"), options).unwrap();
        archive.write_all(file).unwrap();
    };
    for (name, Array { shape, values }) in arrays {
        let fortran = shape.len() == 2;
        let place = |i: usize| if fortran { i % shape[0] * shape[1] + i / shape[0] } else { i };
        let values: Vec<f64> = (0..values.len()).map(|i| values[place(i)]).collect();
        write(name, &npy(1, "<f8", fortran, shape, &bytes(&values, f64::to_le_bytes)));
    }
    if !names.is_empty() {
        let letters = names.iter().flat_map(|name| name.chars().chain(std::iter::repeat('\0')).take(8));
        let letters: Vec<u32> = letters.map(u32::from).collect();
        write("node_names", &npy(1, "<U8", false, &[names.len()], &bytes(&letters, u32::to_le_bytes)));
    }
    archive.finish().unwrap();
}

/// One array of what all have.
fn stacked<'a>(parts: impl Iterator<Item = &'a Array>) -> Array {
    let parts: Vec<&Array> = parts.collect();
    let shape = std::iter::once(parts.len()).chain(parts[0].shape.iter().copied()).collect();
    Array { shape, values: parts.iter().flat_map(|part| part.values.iter().copied()).collect() }
}

fn npz_arrays(data: ModalData<Array>) -> Vec<(&'static str, Array)> {
    let lumped = data.lumped.unwrap();
    let nodes = data.nodes.unwrap().0;
    vec![
        ("modal_stiffness", data.modal_stiffness.unwrap()),
        ("modal_damping", data.modal_damping.unwrap()),
        ("lumped_masses", stacked(lumped.iter().map(|one| &one.mass))),
        ("lumped_positions", stacked(lumped.iter().map(|one| &one.position))),
        ("lumped_translations", stacked(lumped.iter().map(|one| &one.translation))),
        ("node_positions", stacked(nodes.iter().map(|(_, node)| &node.position))),
        ("node_translations", stacked(nodes.iter().map(|(_, node)| &node.translation))),
        ("node_rotations", stacked(nodes.iter().filter_map(|(_, node)| node.rotation.as_ref()))),
    ]
}

#[test]
fn a_beam_written_as_npz_is_read_as_it_was() {
    fn check<const D: usize>() {
        let rod = reduced::<D>();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rod.npz");
        write_npz(&path, &npz_arrays(export(&rod)), &["left", "tip"]);
        assert_same(&rod, &read(json!({ "file": "rod.npz" }), folder.path()).unwrap());
        write_npz(&path, &npz_arrays(export(&rod)), &[]);
        let names: Vec<String> = read::<D>(json!({ "file": "rod.npz" }), folder.path())
            .unwrap()
            .nodes
            .into_iter()
            .map(|node| node.0)
            .collect();
        assert_eq!(names, ["node1", "node2"]);
    }
    check::<2>();
    check::<3>();
}

/// Momenta keep what they say: all but the symmetric parts of P_0i and the deviator of P_ij.
#[test]
fn couplings_keep_what_they_say() {
    let rod: Elastic<3> = build(&beam_in_space(json!({ "modes": 2, "rotary_inertia": true })), &[0.0, 0.6, L]).unwrap();
    let piece = &whole(&rod);
    let n = rod.names.len();
    let angular = |p: &[[f64; 3]; 3]| vec![p[1][2] - p[2][1], p[2][0] - p[0][2], p[0][1] - p[1][0]];
    // A uniform rod about its centre.
    let mass = 0.8 * L;
    let slender = 0.8 * L * L * L / 12.0;
    let body = json!({ "data": {
        "mass": mass, "center": [L / 2.0, 0, 0], "inertia": [3e-3 * L, slender + 2e-3 * L, slender + 1e-3 * L],
        "modal_stiffness": rod.stiffness.iter().map(|entry| entry.2).collect::<Vec<_>>(),
        "linear_coupling": piece.moments[1..].to_vec(),
        "angular_coupling": piece.products[1..=n].iter().map(angular).collect::<Vec<_>>(),
    } });
    let found = &read::<3>(body, Path::new("")).unwrap().elastic.inertia.pieces[0];
    for a in 0..=n {
        (0..3).for_each(|k| assert_close(found.moments[a][k], piece.moments[a][k], 1e-14));
        for b in 0..=n {
            let [p, exact] = [found, piece].map(|piece| &piece.products[a * (n + 1) + b]);
            if a == 0 || b == 0 {
                angular(p).iter().zip(angular(exact)).for_each(|(p, exact)| assert_close(*p, exact, 1e-13));
            } else {
                assert_close(p[0][0] + p[1][1] + p[2][2], exact[0][0] + exact[1][1] + exact[2][2], 1e-9);
            }
        }
    }
    (0..9).for_each(|i| assert_close(found.products[0][i / 3][i % 3], piece.products[0][i / 3][i % 3], 1e-13));
}

/// A planar body of two modes.
fn body(more: Value) -> Value {
    let mut data = json!({
        "mass": 2, "inertia": 0.1, "modal_stiffness": [100, 400],
        "nodes": { "tip": { "position": [1, 0], "translation": [[0, 0], [1, -1]] } },
    });
    for (key, value) in more.as_object().unwrap() {
        match value {
            Value::Null => data.as_object_mut().unwrap().remove(key),
            _ => data.as_object_mut().unwrap().insert(key.clone(), value.clone()),
        };
    }
    json!({ "data": data })
}

#[track_caller]
fn says(body: Value, expected: &str) {
    let error = read::<2>(body, Path::new("")).err().unwrap();
    assert_eq!(error.to_string(), expected);
}

#[test]
fn data_that_do_not_fit() {
    assert!(read::<2>(body(json!({})), Path::new("")).is_ok());
    let table = [
        (json!({ "mass": null }), "data: the key `mass` is missing\n  help: or give \"lumped\" masses"),
        (
            json!({ "modal_stiffness": null }),
            "data: the key `modal_stiffness` is missing\n  help: give one number a mode, or a matrix",
        ),
        (
            json!({ "modal_stiffness": [] }),
            "data.modal_stiffness: there is no mode\n  help: a body without any is of type \"rigid\"",
        ),
        (json!({ "mass": 0 }), "data.mass: mass is 0, but must be above zero"),
        (
            json!({ "modal_mass": [[1, 0, 0], [0, 1, 0]] }),
            "data.modal_mass: expected 2 x 2 numbers, found 2 x 3 numbers",
        ),
        (
            json!({ "modal_mass": [[1, 0], [0, 1, 0]] }),
            "data.modal_mass[1]: expected 2 numbers as before it, found 3 numbers",
        ),
        (
            json!({ "modal_stiffness": [[4, 1], [2, 3]] }),
            "data.modal_stiffness: the matrix is not symmetric: [0][1] is 1, [1][0] is 2",
        ),
        (
            json!({ "modal_stiffness": [100, 0] }),
            "data.modal_stiffness: the stiffness matrix has the eigenvalue 0, but must be positive\n  help: leave out \
             rigid-body modes: the body's frame has these motions already",
        ),
        (
            json!({ "modal_stiffness": [[1, 2], [2, 1]] }),
            "data.modal_stiffness: the stiffness matrix has the eigenvalue -1, but must be positive\n  help: leave out \
             rigid-body modes: the body's frame has these motions already",
        ),
        (
            json!({ "modal_damping": [1, -1] }),
            "data.modal_damping: the damping matrix has the negative eigenvalue -1\n  help: such damping would be a \
             source of energy: check the signs",
        ),
        (
            json!({ "linear_coupling": [[5, 0], [0, 0]] }),
            "data: mode 1 has no mass of its own beside the rigid motion and the modes before it\n  help: leave out \
             rigid-body modes and sums of others, and check units and signs of the couplings",
        ),
        (
            json!({ "inertia": -1 }),
            "data: the body has no moment of inertia, or a negative one, about some axis\n  help: check the signs; \
             masses on one line have none about it",
        ),
        (
            json!({ "nodes": { "tip": { "position": [1, 0], "translation": [[0, 0, 0], [1, -1, 0]] } } }),
            "data.nodes.tip.translation: expected 2 x 2 numbers, found 2 x 3 numbers",
        ),
        (json!({ "lumped": [] }), "data.mass: `mass` follows from `lumped`\n  help: keep one of them"),
        (
            json!({ "mass": null, "inertia": null, "lumped": [
                { "mass": -1, "position": [0, 0], "translation": [[0, 0], [0, 0]] } ] }),
            "data.lumped[0].mass: mass is -1, but cannot be negative",
        ),
        (json!({ "mass": "m" }), "data.mass: unknown name `m` at character 1 in \"m\"\n  help: there is only `pi`"),
    ];
    for (more, expected) in table {
        says(body(more), &format!("at {expected}"));
    }
    says(json!({}), "the key `file` is missing\n  help: name a file with the modes, or give them as \"data\"");
}

#[test]
fn files_that_cannot_be_used() {
    let folder = tempfile::tempdir().unwrap();
    let message = |name: &str| read::<2>(json!({ "file": name }), folder.path()).err().unwrap().to_string();
    assert!(message("none.json").starts_with("at file: none.json: No such file"), "{}", message("none.json"));
    assert!(message("none.npz").starts_with("at file: none.npz: No such file"));
    std::fs::write(folder.path().join("a.json"), "{ \"mass\": 1, \"modal_stifness\": [1] }").unwrap();
    assert_eq!(
        message("a.json"),
        "at file: a.json: at modal_stifness: unknown key `modal_stifness`\n  help: did you mean `modal_stiffness`?"
    );
    std::fs::write(folder.path().join("b.json"), "{ \"mass\": 1, ").unwrap();
    assert!(message("b.json").starts_with("at file: b.json: not JSON: EOF"), "{}", message("b.json"));
    std::fs::write(folder.path().join("c.npz"), "no archive").unwrap();
    assert!(message("c.npz").contains("help: write it by numpy.savez"), "{}", message("c.npz"));

    let path = folder.path().join("d.npz");
    write_npz(&path, &[("modal_stifness", Array::number(1.0))], &[]);
    assert_eq!(
        message("d.npz"),
        "at file: d.npz: unknown key `modal_stifness`\n  help: did you mean `modal_stiffness`?"
    );
    write_npz(&path, &[("modal_stiffness", numbers(&[2], vec![1.0, f64::NAN]))], &[]);
    assert_eq!(message("d.npz"), "at file: d.npz: at modal_stiffness: holds NaN\n  help: all numbers must be finite");
    let mut arrays = npz_arrays(export(&reduced::<2>()));
    arrays.retain(|(name, _)| *name != "node_translations");
    write_npz(&path, &arrays, &[]);
    assert_eq!(message("d.npz"), "at file: d.npz: the key `node_translations` is missing");
}

/// tests/data/numpy.npz, written by NumPy itself; what is in it is in tests/data/README.md.
#[test]
fn a_file_of_numpy() {
    let node = |x: i32| json!({ "position": [x, 0], "translation": [[0, x], [1, -1]], "rotation": [0.5, x] });
    let data = json!({
        "mass": 2, "center": [0.5, 0], "inertia": 0.25, "modal_stiffness": [[100, 1], [1, 400]], "modal_damping": [1, 0],
        "angular_coupling": [0.125, -0.25], "nodes": { "left": node(0), "Räder": node(1), "tip": node(2) },
    });
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let found = read::<2>(json!({ "file": "numpy.npz" }), &folder).unwrap();
    let expected = read::<2>(json!({ "data": data }), Path::new("")).unwrap();
    assert_eq!(found.elastic.inertia, expected.elastic.inertia);
    assert_eq!(found.elastic.stiffness, expected.elastic.stiffness);
    assert_eq!(found.elastic.damping, expected.elastic.damping);
    assert_eq!(found.nodes, expected.nodes);
}
