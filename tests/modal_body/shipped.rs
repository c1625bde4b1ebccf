//! The shipped scene's data are the export of the beam that it names.

use crate::modal_body::export::Beam;
use crate::scenes::{model, shipped};
use holonom::body::flexible::modal::{Array, ModalData};
use holonom::simulate::Method;
use serde_json::{Value, json};

/// Steel, 0.8 m long, 30 mm wide and 4 mm high.
fn strip() -> Value {
    let length = 0.8;
    let width = 0.03;
    let height = 0.004;
    let e = 2.1e11;
    let rho = 7850.0;
    let area: f64 = width * height;
    json!({
        "frame": "floating", "length": length, "elements": 4, "frame_conditions": "mean", "modes": 1,
        "stiffness": { "EA": e * area, "EI": e * area * height * height / 12.0 }, "inertia": { "rhoA": rho * area },
    })
}

/// Free bending in one, two and three waves; the mode left out stretches the strip.
fn exported() -> ModalData<Array> {
    let beam = Beam::<2>::new(&strip());
    let all: Vec<usize> = (0..beam.modes()).collect();
    let full = beam.export(&all);
    let slides = |mode: usize| full.nodes.as_ref().unwrap().0[1].1.translation.values[mode].abs() > 1e-6;
    let bending: Vec<usize> = all.into_iter().filter(|&mode| !slides(mode)).collect();
    beam.export(&bending)
}

#[test]
fn the_link_is_the_strip() {
    let scene: Value = serde_json::from_str(&std::fs::read_to_string(model("modal_link")).unwrap()).unwrap();
    let mut exact = Vec::new();
    flatten(&serde_json::to_value(exported()).unwrap(), &mut exact);
    let mut found = Vec::new();
    flatten(&scene["bodies"][0]["data"], &mut found);
    assert_eq!(found.len(), exact.len());
    for ((place, found), (known, exact)) in found.iter().zip(&exact) {
        assert_eq!(place, known);
        // Ten digits are written.
        assert!((found - exact).abs() <= 1e-9 * exact.abs() + 1e-12, "{place}: {found} instead of {exact}");
    }
}

/// The force of the hinge is that of bends of a millimetre: tolerances of one per cent of `rtol` for a metre give it as exactly as
/// the motion, within ten tolerances.
#[test]
fn the_hinge_force_is_as_good_as_the_motion() {
    let ready = shipped("modal_link", &[]);
    let own = &ready.0.method;
    let force = |method: &Method| ready.run(method, ready.span()).column("hinge_force");
    let exact = force(&Method { rtol: 1e-12, atol: 1e-14, ..own.clone() });
    let largest = exact.iter().fold(0.0, |largest: f64, force| largest.max(force.abs()));
    for rtol in [1e-3, 1e-6, own.rtol] {
        let found = force(&Method { rtol, atol: own.atol * rtol / own.rtol, ..own.clone() });
        let off = found.iter().zip(&exact).fold(0.0, |off: f64, (a, b)| off.max((a - b).abs()));
        assert!(off < 10.0 * rtol * largest, "rtol {rtol}: {off:e} of {largest}");
    }
}

/// All numbers with their places.
fn flatten(json: &Value, out: &mut Vec<(String, f64)>) {
    fn go(place: String, json: &Value, out: &mut Vec<(String, f64)>) {
        match json {
            Value::Array(list) => list.iter().enumerate().for_each(|(i, part)| go(format!("{place}[{i}]"), part, out)),
            Value::Object(keys) => keys.iter().for_each(|(key, part)| go(format!("{place}.{key}"), part, out)),
            number => out.push((place, number.as_f64().unwrap())),
        }
    }
    go(String::new(), json, out);
}
