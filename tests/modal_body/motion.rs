//! The motion of a beam and of its modes.

use crate::modal_body::{modal, swing, write};
use crate::scenes::{Run, load};
use serde_json::Value;
use std::path::Path;

fn run(folder: &Path, scene: &Value) -> Run {
    write(folder, scene);
    let ready = load(&folder.join("scene.json"), &[]);
    ready.run(&ready.0.method, ready.span())
}

fn moves_as_its_beam<const D: usize>(file: &str) {
    let folder = tempfile::tempdir().unwrap();
    let scene = swing::<D>();
    let exact = run(folder.path(), &scene).record.trajectory;
    let found = run(folder.path(), &modal::<D>(&scene, folder.path(), file)).record.trajectory;
    assert_eq!(found.headings(), exact.headings());
    assert_eq!(found.rows.len(), 51);
    for heading in exact.headings() {
        let [found, exact] = [&found, &exact].map(|trajectory| trajectory.column(heading).unwrap());
        let size = exact.iter().fold(1.0f64, |size, x| size.max(x.abs()));
        let off = found.iter().zip(&exact).fold(0.0f64, |off, (a, b)| off.max((a - b).abs()));
        // The same equations up to round-off, so that also the steps are the same, but for sections that turn: the inertia of
        // 1e-10 that twist needs in space leaves 1e-8 of the rate of a mode that twists.
        assert!(off < 2e-8 * size, "{heading}: {off:e} of {size}");
    }
    // It is no rigid rod.
    let names = &exact.names.q;
    let bent = |name: &&String| name.contains("mode") && exact.column(name).unwrap().iter().any(|q| q.abs() > 1e-3);
    assert!(names.iter().any(|name| bent(&name)), "{names:?}");
}

#[test]
fn in_the_plane() {
    moves_as_its_beam::<2>("rod.json");
    moves_as_its_beam::<2>("rod.npz");
}

#[test]
fn in_space() {
    moves_as_its_beam::<3>("rod.json");
    moves_as_its_beam::<3>("rod.npz");
}
