//! The forces of inputs against what the forces of a scene do when a constant is added to the component that is driven.

use crate::outputs_tangent::measures::{mechanism, random};
use holonom::system::{MechanicalSystem, Need, OperatingPoint, Scratch, Terms};
use nalgebra::DMatrix;

/// A scene whose force `force` has `extra` added to component `component`, which input `u` drives.
struct Case {
    dimension: usize,
    is_torque: bool,
    axes: &'static str,
    reacts: bool,
    component: usize,
    /// Whether a body is a beam with elastic coordinates.
    is_flexible: bool,
}

impl Case {
    fn json(&self, extra: f64) -> String {
        let Case { dimension, axes, component, .. } = *self;
        let own = ["1.5 - a.x'", "t*b.y", "0.7"];
        let count = if self.is_torque { 2 * dimension - 3 } else { dimension };
        let driven = if count == 1 { 0 } else { component };
        let term = |i: usize| format!(r#""{} + {}""#, own[i], if i == driven { extra } else { 0.0 });
        let terms = (0..count).map(term).collect::<Vec<_>>().join(", ");
        let value = match (self.is_torque, count) {
            (true, 1) => format!(r#""torque": {terms}"#),
            (true, _) => format!(r#""torque": [{terms}]"#),
            _ => format!(r#""force": [{terms}]"#),
        };
        let kind = if self.is_torque { "applied_torque" } else { "applied_force" };
        let reaction = if self.reacts { r#", "reaction_on": "a.p""# } else { "" };
        let axis = ["x", "y", "z"][component];
        let named = if count == 1 { String::new() } else { format!(r#", "component": "{axis}""#) };
        format!(
            r#"{{ "name": "inputs", "dimension": {dimension}, "bodies": [ {}, {} ],
            "forces": [
                {{ "name": "other", "type": "applied_force", "at": "a.p", "force": [{}] }},
                {{ "name": "force", "type": "{kind}", "at": "b.p", {value}, "axes": "{axes}"{reaction} }} ],
            "inputs": [ {{ "name": "first", "force": "other", "component": "x" }},
                {{ "name": "u", "force": "force"{named} }} ],
            "outputs": [ {{ "name": "size", "measure": "force", "of": "force" }},
                {{ "name": "other", "measure": "force", "of": "other" }} ] }}"#,
            self.body("a", false),
            self.body("b", self.is_flexible),
            ["1"; 3][..dimension].join(", ")
        )
    }

    fn body(&self, name: &str, is_flexible: bool) -> String {
        let (inertia, section, marker) = match self.dimension {
            2 => ("0.4", r#""EA": 40, "EI": 3"#, r#""position": [0.3, -0.2], "angle": 0.4"#),
            _ => (
                "[0.4, 0.5, 0.6]",
                r#""EA": 40, "EI": 3, "GJ": 1"#,
                r#""position": [0.3, -0.2, 0.5], "rotation": [0.3, 0.9, -0.4]"#,
            ),
        };
        let tip = if self.dimension == 2 { r#"[2, 0]"# } else { r#"[2, 0, 0]"# };
        if is_flexible {
            format!(
                r#"{{ "name": "{name}", "type": "flexible_beam", "frame": "floating", "length": 2, "elements": 2,
                "stiffness": {{ {section} }}, "inertia": {{ "rhoA": 1, "rhoI": 0.1 }}, "markers": {{ "p": {tip} }} }}"#
            )
        } else {
            format!(
                r#"{{ "name": "{name}", "type": "rigid", "mass": 1, "inertia": {inertia}, "markers": {{ "p": {{ {marker} }} }} }}"#
            )
        }
    }

    fn name(&self) -> String {
        let Case { dimension, is_torque, axes, reacts, component, is_flexible } = self;
        format!(
            "{dimension} dimensions, torque {is_torque}, {axes}, reaction {reacts}, {component}, beam {is_flexible}"
        )
    }
}

fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for dimension in [2, 3] {
        for is_torque in [false, true] {
            for axes in ["world", "marker"] {
                for (reacts, is_flexible) in [(false, false), (true, false), (true, true)] {
                    let components = if dimension == 2 && is_torque { 2..3 } else { 0..dimension };
                    let case = |component| Case { dimension, is_torque, axes, reacts, component, is_flexible };
                    all.extend(components.map(case));
                }
            }
        }
    }
    all
}

const T: f64 = 0.3;

fn state(system: &dyn MechanicalSystem) -> (Vec<f64>, Vec<f64>) {
    let n = system.dimensions();
    let mut random = random(5);
    let mut q: Vec<f64> = (0..n.q).map(|_| random()).collect();
    system.normalize(&mut q);
    (q, (0..n.v).map(|_| random()).collect())
}

/// f and the outputs.
fn forces(system: &dyn MechanicalSystem) -> (Vec<f64>, Vec<f64>) {
    let (q, v) = state(system);
    let mut terms = Terms::new(system);
    let mut scratch = Scratch::default();
    let mut y = vec![0.0; 2];
    system.evaluate(T, &q, &v, Need::FORCE, &mut terms, &mut scratch);
    let at = OperatingPoint { t: T, q: &q, v: &v, vdot: &v, lambda: &[] };
    system.outputs(at, &mut y, &mut scratch);
    (terms.f, y)
}

/// f is linear in the input, so that differences are exact but for round-off; sizes are not, and theirs are of order four.
#[test]
fn inputs_add_to_components() {
    for case in cases() {
        let mechanism = mechanism(&case.json(0.0));
        let system = mechanism.system();
        let unit = if case.is_torque { "N m" } else { "N" };
        let inputs = system.facts().inputs.clone();
        assert_eq!(inputs.iter().map(|input| input.name.as_str()).collect::<Vec<_>>(), ["first", "u"]);
        assert_eq!(inputs[1].unit, unit);
        let (q, v) = state(system);
        let mut found = DMatrix::from_element(v.len(), 2, 7.0);
        system.input_forces(T, &q, &v, &mut found, &mut Scratch::default());
        let at = OperatingPoint { t: T, q: &q, v: &v, vdot: &v, lambda: &[] };
        let direct = crate::outputs_tangent::compare::tangent(system, at).u;
        let slopes = crate::outputs_tangent::compare::slope(|s| {
            let moved = crate::outputs_tangent::measures::mechanism(&case.json(s));
            let (f, y) = forces(moved.system());
            [f, y].concat()
        });
        let exact: Vec<f64> = found.column(1).iter().chain(direct.column(1).iter()).copied().collect();
        assert_eq!(slopes.len(), exact.len());
        for (i, (exact, difference)) in exact.iter().zip(&slopes).enumerate() {
            assert!((exact - difference).abs() < 1e-10, "{} {i}: {exact} against {difference}", case.name());
        }
        // A force that another input drives knows nothing of this one.
        assert_eq!((direct[(0, 0)], direct[(1, 1)]), (0.0, 0.0));
        assert!((direct[(1, 0)] - (1.0 / case.dimension as f64).sqrt()).abs() < 1e-15);
    }
}

/// Two inputs may drive one force, and one component.
#[test]
fn inputs_of_one_force() {
    let mechanism = mechanism(
        r#"{ "name": "two", "dimension": 2, "bodies": [ { "name": "d", "type": "point_mass", "mass": 1 } ],
        "forces": [ { "name": "push", "type": "applied_force", "at": "d", "force": [3, 4] } ],
        "inputs": [ { "name": "x", "force": "push", "component": "x" }, { "name": "y", "force": "push", "component": "y" },
            { "name": "also_y", "force": "push", "component": "y" } ],
        "outputs": [ { "name": "size", "measure": "force", "of": "push" } ] }"#,
    );
    let system = mechanism.system();
    let mut found = DMatrix::zeros(2, 3);
    system.input_forces(0.0, &[0.5, 0.6], &[0.0; 2], &mut found, &mut Scratch::default());
    assert_eq!(found, DMatrix::from_row_slice(2, 3, &[1.0, 0.0, 0.0, 0.0, 1.0, 1.0]));
    let at = OperatingPoint { t: 0.0, q: &[0.5, 0.6], v: &[0.0; 2], vdot: &[0.0; 2], lambda: &[] };
    let direct = crate::outputs_tangent::compare::tangent(system, at).u;
    [0.6, 0.8, 0.8].iter().zip(direct.iter()).for_each(|(expected, found)| assert!((expected - found).abs() < 1e-15));
}

/// The forces of a road's height and of its rate, and what outputs see of them.
#[test]
fn roads_add_with_their_rates() {
    let wheel = |road: String| {
        crate::outputs_tangent::measures::mechanism(&format!(
            r#"{{ "name": "wheel", "dimension": 2,
            "bodies": [ {{ "name": "d", "type": "point_mass", "mass": 1 }}, {{ "name": "e", "type": "point_mass", "mass": 1 }} ],
            "forces": [ {{ "name": "tyre", "type": "tyre", "at": "e", "stiffness": 700, "damping": 30, "radius": 0.3, "road": "{road}" }} ],
            "inputs": [ {{ "name": "road", "tyre": "tyre" }} ],
            "outputs": [ {{ "name": "load", "measure": "force", "of": "tyre" }}, {{ "name": "energy", "measure": "energy" }} ] }}"#
        ))
    };
    let mechanism = wheel("0.1*t".to_string());
    let system = mechanism.system();
    let (q, v) = state(system);
    let at = OperatingPoint { t: T, q: &q, v: &v, vdot: &v, lambda: &[] };
    let direct = crate::outputs_tangent::compare::tangent(system, at);
    let mut found = [0; 2].map(|_| DMatrix::zeros(v.len(), 1));
    system.input_forces(T, &q, &v, &mut found[0], &mut Scratch::default());
    system.input_rate_forces(T, &q, &v, &mut found[1], &mut Scratch::default());
    for (exact, outputs, term) in [(&found[0], &direct.u, "1"), (&found[1], &direct.udot, "(t - 0.3)")] {
        let slopes = crate::outputs_tangent::compare::slope(|s| {
            let moved = wheel(format!("0.1*t + ({s})*{term}"));
            let (f, y) = forces(moved.system());
            [f, y].concat()
        });
        for (exact, difference) in exact.iter().chain(outputs.iter()).zip(&slopes) {
            assert!((exact - difference).abs() < 1e-7, "{exact} against {difference}");
        }
    }
}
