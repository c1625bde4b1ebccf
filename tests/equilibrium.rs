//! Static equilibrium: known ones, large deformations, redundant rows, and what has none.

use crate::scenes::{Ready, parse, shipped};
use holonom::error::Error;
use holonom::initial::{Equilibrium, Stability, Way, equilibrium};
use holonom::scene::generate;
use holonom::system::{MechanicalSystem, Need, OperatingPoint, Scratch, Terms};
use std::f64::consts::{FRAC_PI_2, PI};

/// The equilibrium at the start time from the start.
fn seek(scene: &Ready) -> Result<Equilibrium, Error> {
    equilibrium(scene.system(), scene.0.start_time(), scene.0.start())
}

/// Found, and f - G^T lambda = 0, phi = 0 by the equations themselves, forces over the largest of them.
fn found(scene: &Ready) -> Equilibrium {
    let found = seek(scene).unwrap_or_else(|error| panic!("{}: {error}", scene.0.name));
    let (force, phi) = left(scene.system(), &found);
    // Beams without load: EA/h of some 1e6 N/m times the rounding of coordinates of 100 m, against 1 N.
    assert!(force < 3e-8 && phi < 1e-9, "{}: {force:e} {phi:e}", scene.0.name);
    found
}

fn left(system: &dyn MechanicalSystem, at: &Equilibrium) -> (f64, f64) {
    let mut terms = Terms::new(system);
    let still = &at.v;
    system.evaluate(at.t, &at.q, still, Need::DYNAMICS, &mut terms, &mut Scratch::default());
    let mut reaction = vec![0.0; still.len()];
    system.structure().g.multiply_transposed(&terms.g, &at.lambda, &mut reaction);
    let largest = |x: &mut dyn Iterator<Item = f64>| x.fold(0.0f64, |largest, x| largest.max(x.abs()));
    let force = largest(&mut terms.f.iter().zip(&reaction).map(|(f, reaction)| f - reaction));
    (force / largest(&mut terms.f.iter().copied()).max(1.0), largest(&mut terms.phi.iter().copied()))
}

fn output(scene: &Ready, at: &Equilibrium, name: &str) -> f64 {
    let columns = scene.system().facts().outputs.clone();
    let mut out = vec![0.0; columns.len()];
    let still = vec![0.0; scene.system().dimensions().v];
    let at = OperatingPoint { t: at.t, q: &at.q, v: &still, vdot: &still, lambda: &at.lambda };
    scene.system().outputs(at, &mut out, &mut Scratch::default());
    out[columns.iter().position(|column| column.name == name).unwrap()]
}

/// From far the pendulum hangs, and its rod carries the weight; near upright it stands, and that this is unstable is told.
#[test]
fn a_pendulum_hangs() {
    for angle in [0.1, FRAC_PI_2, 2.0, 2.5] {
        let scene = shipped("pendulum", &[("angle0", angle)]);
        let hanging = found(&scene);
        assert_eq!(hanging.stability, Stability::Stable, "{angle}");
        assert!((hanging.q[1] + 1.0).abs() < 1e-12 && (hanging.lambda[0] - 9.81).abs() < 1e-10, "{angle}");
    }
    for angle in [3.0, PI] {
        let upright = found(&shipped("pendulum", &[("angle0", angle)]));
        assert_eq!((upright.stability, upright.way), (Stability::Unstable, Way::Newton));
        assert!((upright.lambda[0] + 9.81).abs() < 1e-10);
    }
}

/// Every shipped scene has one, but for none of them by chance: all are checked by their equations.
#[test]
fn shipped_scenes_come_to_rest() {
    for path in crate::scenes::models() {
        let scene = crate::scenes::load(&path, &[]);
        if scene.0.name == "flying_spaghetti" {
            let error = seek(&scene).unwrap_err().to_string();
            assert!(error.contains("nothing holds `beam.n0.x`"), "{error}");
            continue;
        }
        if scene.0.name == "whitworth" {
            let error = seek(&scene).unwrap_err().to_string();
            assert!(error.contains("the rate of the state `forward`"), "{error}");
            continue;
        }
        let found = found(&scene);
        let expected = match scene.0.name.as_str() {
            // Nothing holds the spin of the top, the governor's turn about its shaft, nor the car along a level road.
            "spinning_top" | "flyball_governor" | "half_car" => Stability::Neutral,
            // Wheels and bodies in space that turn freely.
            "bevel_differential" | "planetary_gear" | "tumbling_station" => Stability::Neutral,
            // Unstable where they are set up, or their expected equilibria are not known in closed form.
            "fekete" | "landing_gear" | "rope_slider" | "tower_crane" => continue,
            // These start upright, on a dead point, or where the singular state is passed only upwards.
            "n_four_bar" | "spatial_slider_crank" | "slider_crank_singular_2" => continue,
            // The path of growing loads ends with the upper link upright or hanging; round-off decides.
            "robot_arm" => continue,
            // The oil that is shut in may leak until the boom rests anywhere.
            "hydraulic_boom" => Stability::Unknown,
            _ => Stability::Stable,
        };
        assert_eq!(found.stability, expected, "{}: {found:?}", scene.0.name);
    }
}

/// E1 of the reference linear models: the squeezer under its drive, computed with 30 digits.
#[test]
fn the_squeezer_rests_where_the_reference_says() {
    let scene = shipped("andrews", &[]);
    let found = found(&scene);
    let names = scene.system().facts().names.q.clone();
    let angle = |name: &str| found.q[names.iter().position(|q| q == name).unwrap()];
    let beta = angle("K1.angle");
    assert!((beta - 3.284_208_655_963_953).abs() < 1e-10, "{beta}");
}

#[test]
fn suspensions_start_at_rest() {
    for name in ["five_link_suspension", "five_link_suspension_rods", "full_axle", "quarter_car"] {
        let scene = shipped(name, &[]);
        let found = found(&scene);
        assert_eq!((found.way, found.stability), (Way::Newton, Stability::Stable), "{name}");
        let moved = found.q.iter().zip(&scene.start().q).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(moved < 1e-6, "{name}: {moved:e}");
    }
    let scene = shipped("five_link_suspension", &[]);
    let at = found(&scene);
    for (rod, force) in [-860.2, -3177.2, -197.0, 2553.5, 2034.8].into_iter().enumerate() {
        let there = output(&scene, &at, &format!("rod{}_force", rod + 1));
        assert!((there - force).abs() < 0.06, "{rod}: {there}");
    }
}

/// Softer springs: the car sinks by the load over the stiffness.
#[test]
fn a_softer_tyre_sinks() {
    let scene = shipped("quarter_car", &[]);
    let text = std::fs::read_to_string(crate::scenes::model("quarter_car"))
        .unwrap()
        .replace("(m_body + m_wheel)*g/k_tyre", "0");
    let sunk = found(&parse(&text));
    let by = found(&scene).q[0] - sunk.q[0];
    assert!((by - 438.0 * 9.81 / 2e5).abs() < 1e-12, "{by}");
}

/// The middle link carries a third of the load; redundant multipliers are those of least norm.
#[test]
fn redundant_rows_are_no_obstacle() {
    let scene = shipped("parallelogram_redundant", &[]);
    let at = found(&scene);
    assert_eq!(at.stability, Stability::Stable);
    let names = scene.system().facts().names.lambda.clone();
    let vertical: Vec<f64> =
        names.iter().zip(&at.lambda).filter(|(name, _)| name.ends_with(".y")).map(|(_, force)| force.abs()).collect();
    assert!(vertical.iter().all(|force| *force < 15.0), "{vertical:?}");
    assert_eq!(found(&shipped("bricard", &[])).stability, Stability::Stable);
}

/// A chain released level hangs straight down, whatever its length.
#[test]
fn long_chains_hang() {
    for n in [20, 200, 2000] {
        let scene = parse(&generate::chain(n).to_string());
        let at = found(&scene);
        let end = output(&scene, &at, "end_y");
        assert!((end + 1.0).abs() < 1e-9 && at.steps < 50, "{n}: {end} after {} steps", at.steps);
        assert_eq!(at.stability, if n == 20 { Stability::Stable } else { Stability::Unknown });
    }
}

/// A beam on a hinge, released level, swings down however stiff it is, and its weight stretches it there by g/(2 EA).
#[test]
fn stiff_beams_hang() {
    for (dimension, elements, ei) in
        [2, 3].into_iter().flat_map(|d| [(d, 2, 1e4), (d, 8, 1e2), (d, 8, 1e6), (d, 32, 1e4)])
    {
        let (zero, end, gravity) = match dimension {
            2 => ("[0, 0]", "[1, 0]", "[0, -9.81]"),
            _ => ("[0, 0, 0]", "[1, 0, 0]", "[0, -9.81, 0]"),
        };
        let beam = parse(&format!(
            r#"{{ "name": "hinged", "dimension": {dimension}, "gravity": {gravity},
            "ground": {{ "markers": {{ "wall": {zero} }} }},
            "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1,
                "elements": {elements}, "stiffness": {{ "EA": "1e3*{ei}", "EI": {ei}{} }},
                "inertia": {{ "rhoA": 1, "rhoI": 1e-4 }}, "markers": {{ "root": {zero}, "tip": {end} }} }} ],
            "joints": [ {{ "name": "hinge", "type": "revolute", "between": ["ground.wall", "rod.root"] }} ],
            "outputs": [ {{ "name": "y", "measure": "position", "of": "rod.tip", "component": "y" }} ] }}"#,
            if dimension == 2 { String::new() } else { format!(r#", "GJ": {ei}"#) }
        ));
        let hanging = seek(&beam).unwrap_or_else(|error| panic!("{dimension} {elements} {ei:e}: {error}"));
        let y = output(&beam, &hanging, "y");
        let exact = -1.0 - 9.81 / (2e3 * ei);
        println!("{dimension} {elements} {ei:e}: {y} {exact}, {:?} in {} steps", hanging.stability, hanging.steps);
        assert!((y - exact).abs() < 1e-9, "{dimension} {elements} {ei:e}: {y} {exact}");
        assert_eq!(hanging.stability, Stability::Stable, "{dimension} {elements} {ei:e}");
    }
}

/// A cantilever of rigid links on torsion springs, bent by a force across its end.
fn cantilever(n: usize, load: f64) -> String {
    let length = 1.0 / n as f64;
    let mut bodies = Vec::new();
    let mut joints = Vec::new();
    let mut forces = Vec::new();
    for i in 0..n {
        let before = if i == 0 { "ground.O".to_string() } else { format!("link{}.B", i - 1) };
        let x = (i as f64 + 0.5) * length;
        bodies.push(format!(
            r#"{{ "name": "link{i}", "type": "rigid", "mass": 0.01, "inertia": 1e-6,
                "markers": {{ "A": [{}, 0], "B": [{}, 0] }}, "initial": {{ "position": [{x}, 0] }} }}"#,
            -0.5 * length,
            0.5 * length
        ));
        joints.push(format!(r#"{{ "name": "J{i}", "type": "revolute", "between": ["{before}", "link{i}.A"] }}"#));
        // The first spring stands at the clamp and has half a link to bend.
        let stiffness = if i == 0 { 2.0 } else { 1.0 } * n as f64;
        forces.push(format!(
            r#"{{ "name": "S{i}", "type": "torsion_spring", "between": ["{before}", "link{i}.A"], "stiffness": {stiffness} }}"#
        ));
    }
    forces.push(format!(
        r#"{{ "name": "load", "type": "applied_force", "at": "link{}.B", "force": [0, {load}] }}"#,
        n - 1
    ));
    format!(
        r#"{{ "name": "cantilever", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [{}], "joints": [{}], "forces": [{}],
            "outputs": [ {{ "name": "x", "measure": "position", "of": "link{m}.B", "component": "x" }},
                         {{ "name": "y", "measure": "position", "of": "link{m}.B", "component": "y" }} ] }}"#,
        bodies.join(","),
        joints.join(","),
        forces.join(","),
        m = n - 1
    )
}

/// The elastica at P L^2 / (E I) = 10 (K. Mattiasson, Int. J. Numer. Methods Eng. 17 (1981) 145-153, table I): the tip
/// goes 0.55500 L back and 0.81061 L across; and at a load that bends it at once into a hook.
#[test]
fn a_cantilever_bends_as_far_as_it_is_long() {
    for n in [20, 80] {
        let scene = parse(&cantilever(n, 10.0));
        let at = found(&scene);
        let off = (output(&scene, &at, "x") - 0.445).hypot(output(&scene, &at, "y") - 0.81061);
        assert!(off < 5.0 / (n * n) as f64 + 2e-5, "{n}: {off:e}");
        assert_eq!(at.stability, Stability::Stable);
    }
    let scene = parse(&cantilever(50, 1000.0));
    let at = found(&scene);
    assert!(output(&scene, &at, "y") > 0.9 && at.stability == Stability::Stable, "{at:?}");
}

/// A load that ramps with time is held at the time that is asked for.
#[test]
fn time_is_held() {
    let text = std::fs::read_to_string(crate::scenes::model("bushing_block")).unwrap();
    let ramp = r#""forces": [ { "name": "ramp", "type": "applied_force", "at": "block", "force": [0, 0, "-10*t"] }, "#;
    let scene = parse(&text.replacen(r#""forces": ["#, ramp, 1));
    let height = |t: f64| equilibrium(scene.system(), t, scene.0.start()).unwrap().q[2];
    assert!((height(0.0) - height(2.0) - 20.0 / 2000.0).abs() < 1e-12, "{} {}", height(0.0), height(2.0));
}

#[test]
fn what_nothing_holds_is_named() {
    let falling = r#"{ "name": "falling", "dimension": 3, "gravity": [0, 0, -9.81],
        "bodies": [ { "name": "stone", "type": "rigid", "mass": 1, "inertia": [1, 1, 1], "initial": { "position": [0, 0, 5] } } ] }"#;
    let error = seek(&parse(falling)).unwrap_err();
    assert_eq!(error.exit_code(), 1);
    let message = error.to_string();
    assert!(message.contains("nothing holds `stone.z`") && message.contains("help: hold it"), "{message}");
    let floating = seek(&parse(&falling.replace("-9.81", "0"))).unwrap();
    assert_eq!((floating.stability, floating.free.len()), (Stability::Neutral, 6), "{floating:?}");
    let top = seek(&shipped("spinning_top", &[])).unwrap();
    assert_eq!((top.stability, top.free.as_slice()), (Stability::Neutral, &["top.wz".to_string()][..]));
}

/// A force that nothing holds anywhere.
#[test]
fn a_force_without_a_rest_is_no_equilibrium() {
    let scene = r#"{ "name": "runaway", "dimension": 2, "ground": { "markers": { "O": [0, 0] } },
        "bodies": [ { "name": "cart", "type": "point_mass", "mass": 1, "initial": { "position": [1, 0] } } ],
        "joints": [ { "name": "rail", "type": "equation", "expression": "cart.y" } ],
        "forces": [ { "name": "push", "type": "applied_force", "at": "cart", "force": [3, 0] } ] }"#;
    let message = seek(&parse(scene)).unwrap_err().to_string();
    assert!(message.contains("nothing holds `cart.x`"), "{message}");
    // A wavy slope that falls everywhere: K is not zero, and there is no rest.
    let slope = scene
        .replace(r#""ground""#, r#""gravity": [0, -9.81], "ground""#)
        .replace("cart.y", "cart.y + 0.5*cart.x + 0.3*sin(cart.x) - 0.5 - 0.3*sin(1)")
        .replace("[3, 0]", "[0, 0]");
    let message = seek(&parse(&slope)).unwrap_err().to_string();
    assert!(message.contains("the forces move `cart.") && message.contains("on and on"), "{message}");
}

/// A cantilever of an absolute beam, clamped at its left end.
fn clamped(dimension: usize, beam: &str, rest: &str) -> Ready {
    let (zero, end) = if dimension == 2 { ("[0, 0]", "[1, 0]") } else { ("[0, 0, 0]", "[1, 0, 0]") };
    parse(&format!(
        r#"{{ "name": "clamped", "dimension": {dimension}, "ground": {{ "markers": {{ "wall": {zero} }} }},
        "bodies": [ {{ "name": "beam", "type": "flexible_beam", "frame": "absolute", "length": 1, {beam},
            "markers": {{ "root": {zero}, "tip": {end} }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "beam.root"] }} ], {rest} }}"#
    ))
}

/// An element of a plane beam can be bent to any angle but a full turn, at which its chord vanishes, one in space to any
/// below half a turn: the matrix has no bounds there, and rest anywhere looks like rounding.
#[test]
fn a_beam_whose_elements_would_turn_too_far_is_refused() {
    let bent = |dimension: usize, elements: usize, turns: f64| {
        let torque = format!("{}*pi", turns * 200.0);
        let torque = if dimension == 2 { torque } else { format!(r#"0, 0, "{torque}""#) };
        let torque = if dimension == 2 { format!(r#""{torque}""#) } else { format!("[{torque}]") };
        let gj = if dimension == 2 { "" } else { r#", "GJ": 100"# };
        let beam = format!(
            r#""elements": {elements}, "stiffness": {{ "EA": 1e4, "EI": 100{gj} }},
            "inertia": {{ "rhoA": 1, "rhoI": 1e-4 }}"#
        );
        let load = format!(
            r#""forces": [ {{ "name": "load", "type": "applied_torque", "at": "beam.tip", "torque": {torque} }} ],
            "outputs": [ {{ "name": "chord", "measure": "distance", "between": ["ground.wall", "beam.tip"] }} ]"#
        );
        clamped(dimension, &beam, &load)
    };
    for (dimension, elements, turns) in [(2, 3, 1.0), (2, 2, 1.0), (2, 8, 2.0), (3, 4, 1.0), (3, 3, 1.0), (3, 1, 0.45)]
    {
        let roll = bent(dimension, elements, turns);
        // Elements bent by a moment alone are arcs of the circle: the chord is exact but for rounding, EA/h of 8e4 N/m.
        let chord = (PI * turns).sin().abs() / (PI * turns);
        let off = output(&roll, &found(&roll), "chord") - chord;
        assert!(off.abs() < 1e-9, "{dimension} {elements} {turns}: {off:e}");
    }
    for (dimension, elements, turns, needed) in
        [(2, 1, 1.0, 4), (2, 2, 2.0, 8), (3, 1, 1.0, 4), (3, 2, 1.0, 4), (3, 6, 3.0, 12)]
    {
        let message = seek(&bent(dimension, elements, turns)).unwrap_err().to_string();
        let words = format!("give it {needed} elements or more");
        assert!(
            message.contains("of the beam `beam`") && message.contains(&words),
            "{dimension} {elements}: {message}"
        );
    }
}

/// Steel, 1 m x 20 mm x 20 mm under its own weight: rest is judged by the rounding of what is so stiff.
#[test]
fn ordinary_beams_have_their_equilibria_and_linear_models() {
    use holonom::linearize::{State, at_rest};
    let sag = 7800.0 * 4e-4 * 9.81 / (8.0 * 2.1e11 * 0.02f64.powi(4) / 12.0);
    for (dimension, gravity) in [(2, "[0, -9.81]"), (3, "[0, -9.81, 0]")] {
        for elements in [8, 16, 32] {
            let beam = format!(
                r#""elements": {elements}, "material": {{ "E": 2.1e11, "nu": 0.3, "rho": 7800 }},
                "section": {{ "rectangle": {{ "width": 0.02, "height": 0.02 }} }}"#
            );
            let more = format!(
                r#""gravity": {gravity},
                "outputs": [ {{ "name": "y", "measure": "position", "of": "beam.tip", "component": "y" }} ]"#
            );
            let steel = clamped(dimension, &beam, &more);
            let rest = at_rest(&steel.0, &State::start(&steel.0)).unwrap();
            assert!(rest.variation().unwrap().point.is_equilibrium);
            let tip = output(&steel, &found(&steel), "y");
            // The weight of an element at its nodes: nothing is lost at the end but half an element's own bending.
            assert!(
                (tip.abs() / sag - 1.0).abs() < 1.0 / (elements * elements) as f64,
                "{dimension} {elements}: {tip}"
            );
        }
    }
}

#[test]
fn an_integrator_that_nothing_stops_has_no_rest() {
    let error = seek(&parse(
        r#"{ "name": "runaway", "dimension": 2,
            "bodies": [{ "name": "m", "type": "point_mass", "mass": 1, "initial": { "position": [1, 0] } }],
            "ground": { "markers": { "O": [0, 0] } }, "states": [{ "name": "i", "rate": "1 + 0*m.x" }],
            "forces": [{ "name": "s", "type": "spring_damper", "between": ["ground.O", "m"], "stiffness": 10, "free_length": 1 }] }"#,
    ));
    let text = error.unwrap_err().to_string();
    assert!(text.contains("the rate of the state `i` does not come to zero"), "{text}");
}
