//! Scenes that are well formed but have no consistent start.

use crate::errors::pendulum;

cases! {
    unreachable: pendulum().and_joint("{'name':'far','type':'distance','between':['ground.P','rod.B'],'length':0.5}");
    held_and_driven: pendulum()
        .and_joint("{'name':'d','type':'driver','between':['ground.O','rod.A'],'coordinate':'angle','value':'3*t'}").with("'hold': []", "'hold': ['rod.angle']");
    held_and_closed: pendulum().with("'hold': []", "'hold': ['rod']").with("[0.5, 0]", "[0.7, 0]");
    vel_along_rod: pendulum().with("'angle': 0", "'angle': 0, 'velocity': [1, 0]");
    hold_unknown: pendulum().with("'hold': []", "'hold': ['rod.angel']");
    hold_unknown_far: pendulum().with("'hold': []", "'hold': ['crank.q']");
    massless_free: pendulum().with("'mass': 'm'", "'mass': 0").with("'m*l^2/12'", "0").joint("");
    massless_pinned: pendulum().with("'mass': 'm'", "'mass': 0").with("'m*l^2/12'", "0");
    driver_nan_at_start: pendulum()
        .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'x', 'value': 'sqrt(t-1)' }");
    driver_infinite_rate: pendulum()
        .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'x', 'value': 'sqrt(t)' }");
    huge_mass: pendulum().with("'mass': 'm'", "'mass': 1e308").with("'m*l^2/12'", "1e308");
    tiny_mass: pendulum().with("'mass': 'm'", "'mass': 1e-320").with("'m*l^2/12'", "1e-320");
    nan_force_at_start: pendulum()
        .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0, 'sqrt(t-1)'] }");
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
