//! Values of inputs in simulations: the same motion as with the sum in the element itself.

use super::{changed, shaken};
use crate::linearize::models::model;
use crate::scenes::{Ready, parse};
use holonom::linearize::{State, Variation};
use serde_json::json;

fn same(a: &Ready, b: &Ready, output: &str, end: f64) {
    let [a, b] = [a, b].map(|scene| scene.tight(1e-10, end, 0.05).column(output));
    let size = a.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let off = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 1e-8 * size && size > 0.0, "{output}: {off:e} of {size:e}");
}

#[test]
fn values_add_to_what_drivers_prescribe() {
    let both = shaken("0.2*sin(3*t)", r#", "value": "0.05*t^2 - 0.1*abs(t - 0.7)""#);
    let one = shaken("0.2*sin(3*t) + 0.05*t^2 - 0.1*abs(t - 0.7)", "");
    ["x", "force"].into_iter().for_each(|output| same(&both, &one, output, 1.0));
}

/// A drive in space goes through many turns: the angle prescribed is the sum, not each term within half a turn.
#[test]
fn a_value_may_turn_a_drive_around() {
    let scene = |value: &str, input: &str| {
        changed("double_cardan", |json| {
            json["joints"][4]["value"] = value.into();
            json["inputs"] = json!([{ "name": "turn", "driver": json["joints"][4]["name"], "value": input }]);
        })
    };
    let split = scene("4*t", "6*t");
    let whole = scene("10*t", "0");
    let end = |scene: &Ready| scene.tight(1e-9, 1.0, 1.0).outcome;
    let [a, b] = [end(&split), end(&whole)].map(|outcome| outcome.q);
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-7), "{a:?} {b:?}");
}

/// The wheel leaves the road, whose height is that of both.
#[test]
fn values_add_to_roads_where_the_wheel_lifts_off() {
    let scene = |road: &str, value: &str| {
        changed("quarter_car", |json| {
            json["forces"][1]["road"] = road.into();
            json["forces"][1]["lift_off"] = true.into();
            json["inputs"] = json!([{ "name": "road", "tyre": "tyre", "value": value }]);
        })
    };
    let bump = "0.12*exp(-((t - 0.3)/0.05)^2)";
    let split = scene("0", bump);
    let whole = scene(bump, "0");
    assert!(whole.tight(1e-10, 1.0, 0.01).column("tyre_load").contains(&0.0));
    ["body_height", "tyre_load", "energy"].into_iter().for_each(|output| same(&split, &whole, output, 1.0));
}

/// A law of control as the value of an input, read in the model's operating point.
#[test]
fn a_value_may_read_markers() {
    let scene = |force: &str, value: &str| {
        parse(&format!(
            r#"{{ "name": "held", "dimension": 2, "bodies": [ {{ "name": "m", "type": "point_mass", "mass": 2,
                "initial": {{ "position": [0.3, 0.1], "velocity": [0, 1] }} }} ],
            "forces": [ {{ "name": "f", "type": "applied_force", "at": "m", "force": ["{force}", "-3*m.y"] }} ],
            "inputs": [ {{ "name": "u", "force": "f", "component": "x"{value} }} ],
            "outputs": [ {{ "name": "x", "measure": "position", "of": "m", "component": "x" }} ] }}"#
        ))
    };
    let split = scene("-m.x", r#", "value": "t - 4*m.x - m.x'*ground.x""#);
    let whole = scene("-m.x + t - 4*m.x", "");
    same(&split, &whole, "x", 2.0);
    let State { t, q, v } = split.0.states_at(&[0.5]).unwrap().remove(0);
    let [split, whole] = [&split, &whole].map(|scene| {
        let mut variation = Variation::new(scene.system(), t, &q, &v).unwrap();
        model(&mut variation, "mcs", None)
    });
    assert!((split.point.u[0] - (t - 4.0 * q[0])).abs() < 1e-12 && whole.point.u == [0.0]);
    assert!((&split.a - &whole.a).amax() < 1e-12 && (&split.b - &whole.b).amax() < 1e-12);
}
