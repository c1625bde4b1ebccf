//! Scenes that are well formed but have no consistent start.

use crate::errors::pendulum;

cases! {
    unreachable:
        pendulum()
            .and_joint("{'name':'far','type':'distance','between':['ground.P','rod.B'],'length':0.5}") => [
            "scene.json:12:13: at joints (`far`): the joints cannot all be closed: `far` is out of reach, by 1.5 m",
            "check lengths and markers of these joints, and whether one asks for what another forbids; or start \
             nearer",
        ];
    held_and_driven:
        pendulum()
            .and_joint("{'name':'d','type':'driver','between':['ground.O','rod.A'],'coordinate':'angle','value':'3*t'}").with("'hold': []", "'hold': ['rod.angle']") => [
            "scene.json:20:25: at assembly.hold: the held rates contradict the joints; rates that remain (m/s, \
             rad/s): `d` 0.75",
            "what is held keeps its initial velocity: mend that, or hold fewer coordinates",
        ];
    held_and_closed:
        pendulum().with("'hold': []", "'hold': ['rod']").with("[0.5, 0]", "[0.7, 0]") => [
            "scene.json:20:25: at assembly.hold: `rod.x` is held, but the joints close only where it moves by -0.2 \
             (m, rad)",
            "begin where the joints are closed, or hold fewer coordinates",
        ];
    vel_along_rod:
        pendulum().with("'angle': 0", "'angle': 0, 'velocity': [1, 0]") => [
            "scene.json:7:13: at bodies: the joints allow none of the initial velocities, such as `rod.x'` = 1",
            r#"mend "velocity" and "angular_velocity" in "initial", or leave them out"#,
        ];
    hold_unknown:
        pendulum().with("'hold': []", "'hold': ['rod.angel']") => [
            "scene.json:20:26: at assembly.hold[0]: there is no coordinate `rod.angel`",
            "did you mean `rod.angle`?",
        ];
    hold_unknown_far:
        pendulum().with("'hold': []", "'hold': ['crank.q']") => [
            "scene.json:20:26: at assembly.hold[0]: there is no coordinate `crank.q`",
            "choose one of rod.x, rod.y, rod.angle, rod",
        ];
    massless_free:
        pendulum().with("'mass': 'm'", "'mass': 0").with("'m*l^2/12'", "0").joint("") => [
            "scene.json:7:13: at bodies: at the start, the motion is not determined: `rod.x` has neither mass nor \
             constraint in a direction",
            "give the body mass and inertia, or hold it by joints",
        ];
    massless_pinned:
        pendulum().with("'mass': 'm'", "'mass': 0").with("'m*l^2/12'", "0") => [
            "scene.json:7:13: at bodies: at the start, the motion is not determined: `rod.angle` has neither mass \
             nor constraint in a direction",
            "give the body mass and inertia, or hold it by joints",
        ];
    driver_nan_at_start:
        pendulum()
            .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'x', 'value': 'sqrt(t-1)' }") => [
            "scene.json:12:13: at joints: at the start, joint `p` or its rate is infinite or not a number",
            "begin where its expressions are defined and smooth (no division by zero, `floor` and `mod` up to 2^29), and no distance is zero",
        ];
    driver_infinite_rate:
        pendulum()
            .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'x', 'value': 'sqrt(t)' }") => [
            "scene.json:12:13: at joints: at the start, joint `p` or its rate is infinite or not a number",
            "begin where its expressions are defined and smooth (no division by zero, `floor` and `mod` up to 2^29), and no distance is zero",
        ];
    huge_mass:
        pendulum().with("'mass': 'm'", "'mass': 1e308").with("'m*l^2/12'", "1e308") => [
            "scene.json:15:13: at forces: at the start, the force on `rod.y` is infinite or not a number",
            "look for roots and quotients in expressions, for `floor` and `mod` beyond 2^29, and for springs of length zero",
        ];
    tiny_mass:
        pendulum().with("'mass': 'm'", "'mass': 1e-320").with("'m*l^2/12'", "1e-320") => [
            "scene.json:7:13: at bodies: at the start, the motion is no longer finite",
            "masses, inertias or forces are too large or too small to compute with",
        ];
    nan_force_at_start:
        pendulum()
            .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0, 'sqrt(t-1)'] }") => [
            "scene.json:15:13: at forces (`spring`): at the start, the force on `rod.y` is infinite or not a number",
            "look for roots and quotients in expressions, for `floor` and `mod` beyond 2^29, and for springs of length zero",
        ];
}

const ROD: &str = "{ 'name': 'N', 'type': 'distance', 'between': ['ground.P', 'rod.B'], 'length': L }";
const DRIVE: &str =
    "{ 'name': 'N', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'angle', 'value': 'L' }";

fn pair(element: &str, [a, b]: [&str; 2]) -> crate::errors::Scene {
    let joint = |name: &str, value: &str| element.replace('N', name).replace('L', value);
    pendulum().and_joint(&joint("first", a)).and_joint(&joint("second", b))
}

#[test]
fn two_rods_of_different_lengths() {
    let pieces = [
        "at joints (`second`): the joints cannot all be closed: `second` is out of reach, by 0.5 m",
        "help: check lengths and markers",
    ];
    pair(ROD, ["2", "2.5"]).refused_with(&pieces);
}

#[test]
fn two_drivers_that_contradict() {
    let rates = ["at joints: the joints ask for different velocities", "0.5", "0.5", "check drivers"];
    pair(DRIVE, ["t", "2*t"]).refused_with(&rates);
    let positions = [
        "at joints (`first`): the joints cannot all be closed: the driver `first` asks for 0 rad",
        "and the joints reach 1 rad",
    ];
    pair(DRIVE, ["t", "1 + t"]).refused_with(&positions);
}

#[test]
fn a_four_bar_with_too_short_links() {
    let link = |name: &str, x: f64| {
        format!(
            "{{ 'name': '{name}', 'type': 'rigid', 'mass': 1, 'inertia': 0.01, \
             'markers': {{ 'A': [-0.2, 0], 'B': [0.2, 0] }}, 'initial': {{ 'position': [{x}, 0.2] }} }}"
        )
    };
    let pin =
        |name: &str, a: &str, b: &str| format!("{{ 'name': '{name}', 'type': 'revolute', 'between': ['{a}', '{b}'] }}");
    let bodies = [link("crank", 0.2), link("coupler", 0.6), link("rocker", 1.0)].join(", ");
    let joints = [
        pin("A", "ground.A", "crank.A"),
        pin("B", "crank.B", "coupler.A"),
        pin("C", "coupler.B", "rocker.A"),
        pin("D", "rocker.B", "ground.D"),
    ];
    let text = format!(
        "{{ 'name': 'four_bar', 'dimension': 2, 'ground': {{ 'markers': {{ 'A': [0, 0], 'D': [2, 0] }} }}, \
         'bodies': [{bodies}],\n'joints': [{}] }}",
        joints.join(", ")
    );
    // Three links of 0.4 over a ground of 2.
    let pieces = ["at joints (`D`): the joints cannot all be closed: `D` is out of reach, by 0.8 m", "help: check"];
    crate::errors::scene(crate::errors::json(&text)).refused_with(&pieces);
}
