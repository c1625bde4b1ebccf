//! Springs that pass through length zero, where their force turns by a jump.

use crate::common::adaptive;
use crate::scenes::{Run, parse};
use holonom::simulate::{Method, Span};

/// y from -y0 at rest: towards the anchor, about an equilibrium at -l, then beyond it about l, and back; k/m = w^2.
fn exact(t: f64, y0: f64, l: f64, w: f64) -> f64 {
    // To the anchor: y = -l - (y0 - l) cos(w t), which is zero at cos(w t) = -l/(y0 - l).
    let quarter = (-l / (y0 - l)).acos() / w;
    let speed = (y0 - l) * w * (w * quarter).sin();
    // Beyond it: y = l - l cos(w s) + speed/w sin(w s), which is zero again at tan(w s/2) = -speed/(l w).
    let half = 2.0 * (std::f64::consts::PI - (speed / (l * w)).atan()) / w;
    let mut rest = t;
    if rest <= quarter {
        return -l - (y0 - l) * (w * rest).cos();
    }
    rest -= quarter;
    let mut sign = 1.0;
    while rest > half {
        rest -= half;
        sign = -sign;
    }
    sign * (l - l * (w * rest).cos() + speed / w * (w * rest).sin())
}

/// A mass with these free coordinates and a spring of free length 0.2 m to the origin, along a line at an angle.
fn sprung(free: &str, guide: &str, [x, y]: [f64; 2]) -> String {
    format!(
        r#"{{ "name": "sprung", "dimension": 2, "ground": {{ "markers": {{ "O": {{ "position": [0, 0], "angle": {angle} }} }} }},
        "bodies": [{{ "name": "m", "type": "rigid", "mass": 1, "inertia": 1, {free} "markers": {{ "C": [0, 0] }},
                     "initial": {{ "position": [{x}, {y}] }} }}],
        "joints": [{guide}],
        "forces": [{{ "name": "s", "type": "spring_damper", "between": ["ground.O", "m.C"], "stiffness": 40,
                     "free_length": 0.2 }}],
        "outputs": [{{ "name": "x", "measure": "expression", "value": "m.C.x" }},
                    {{ "name": "y", "measure": "expression", "value": "m.C.y" }}] }}"#,
        angle = y.atan2(x)
    )
}

fn off(run: &Run, [x, y]: [f64; 2]) -> f64 {
    let size = x.hypot(y);
    let along = |t: f64| -exact(t, size, 0.2, 40f64.sqrt()) / size;
    run.worst("x", |t| along(t) * x).max(run.worst("y", |t| along(t) * y))
}

#[test]
fn a_spring_passes_its_anchor() {
    let guide = r#"{ "name": "rail", "type": "point_on_line", "between": ["ground.O", "m.C"] },
                   { "name": "d", "type": "driver", "between": ["ground.O", "m.C"], "coordinate": "angle", "value": 0 }"#;
    let scenes = [
        (sprung(r#""free": ["y"],"#, "", [0.0, -0.5]), [0.0, -0.5]),
        (sprung("", "", [0.3, -0.4]), [0.3, -0.4]),
        (sprung("", guide, [0.4, 0.3]), [0.4, 0.3]),
    ];
    let span = Span { start: 0.0, end: 3.0, output_step: 0.1 };
    for (json, start) in &scenes {
        let ready = parse(json);
        for (formulation, integrator) in [("index1", "dop853"), ("index1", "dopri5"), ("index1", "adams")] {
            for tolerance in [1e-6, 1e-9] {
                let run = ready.run(&adaptive(formulation, integrator, "manifold", tolerance), span);
                let error = off(&run, *start) / tolerance;
                println!("{start:?} {integrator} {tolerance:e}: {error:.2} tolerances, {:?}", run.outcome.statistics);
                assert!(error < 20.0, "{start:?} {integrator} {tolerance:e}: {error} tolerances");
            }
        }
    }
    let ready = parse(&scenes[0].0);
    for (formulation, integrator) in [("ggl", "radau_iia"), ("ggl", "bdf"), ("index2", "phem56"), ("index1", "tsit45")]
    {
        let error = off(&ready.run(&adaptive(formulation, integrator, "none", 1e-6), span), scenes[0].1) / 1e-6;
        assert!(error < 20.0, "{integrator}: {error} tolerances");
    }
    let fixed = Method { step: Some(1e-3), ..adaptive("index1", "rk4", "manifold", 1e-6) };
    // Of order 4: 2e-10.
    let error = off(&ready.run(&fixed, span), scenes[0].1);
    assert!(error < 1e-8, "{error:e}");
}

/// Springs that turn, and one that is pushed past its anchor at a distance, have no event: no steps are refused for them.
#[test]
fn a_spring_that_turns_passes_no_anchor() {
    let json =
        sprung("", "", [0.0, -0.5]).replace(r#""position": [0, -0.5]"#, r#""position": [0, -0.5], "velocity": [3, 0]"#);
    let span = Span { start: 0.0, end: 10.0, output_step: 1.0 };
    let run = parse(&json).run(&adaptive("index1", "dop853", "manifold", 1e-8), span);
    let finer = parse(&json).run(&adaptive("index1", "dop853", "manifold", 1e-12), span);
    let apart = run.worst("x", |t| finer.column("x")[t.round() as usize]);
    assert!(apart < 1e-6, "{apart:e}");
}
