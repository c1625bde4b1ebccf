//! An example for every kind of joint and force between two bodies.
#![allow(dead_code)]

/// A kind of joint: its keys and its rows in the plane and in space; `None` where it makes no sense. `A` and `B` stand
/// for the names of two bodies.
pub struct Joint {
    pub kind: &'static str,
    pub planar: Option<(&'static str, usize)>,
    pub spatial: Option<(&'static str, usize)>,
}

pub const BETWEEN: &str = r#""between": ["A.p", "B.p"]"#;
const SPATIAL_AXIS: &str = r#""between": ["A.p", "B.p"], "axis": [0.2, -0.5, 0.7]"#;
const PLANAR_AXIS: &str = r#""between": ["A.p", "B.p"], "axis": [0.6, -0.5]"#;

pub const JOINTS: &[Joint] = &[
    Joint { kind: "revolute", planar: Some((BETWEEN, 2)), spatial: Some((BETWEEN, 5)) },
    Joint { kind: "revolute", planar: Some((BETWEEN, 2)), spatial: Some((SPATIAL_AXIS, 5)) },
    Joint { kind: "prismatic", planar: Some((BETWEEN, 2)), spatial: Some((BETWEEN, 5)) },
    Joint { kind: "prismatic", planar: Some((PLANAR_AXIS, 2)), spatial: Some((SPATIAL_AXIS, 5)) },
    Joint { kind: "cylindrical", planar: None, spatial: Some((BETWEEN, 4)) },
    Joint { kind: "cylindrical", planar: None, spatial: Some((SPATIAL_AXIS, 4)) },
    Joint { kind: "universal", planar: None, spatial: Some((BETWEEN, 4)) },
    Joint { kind: "spherical", planar: None, spatial: Some((BETWEEN, 3)) },
    Joint { kind: "planar", planar: None, spatial: Some((SPATIAL_AXIS, 3)) },
    Joint { kind: "weld", planar: Some((BETWEEN, 3)), spatial: Some((BETWEEN, 6)) },
    Joint {
        kind: "distance",
        planar: Some((r#""between": ["A.p", "B.p"], "length": 0.7"#, 1)),
        spatial: Some((r#""between": ["A.p", "B.p"], "length": 0.7"#, 1)),
    },
    Joint { kind: "point_on_line", planar: Some((BETWEEN, 1)), spatial: Some((BETWEEN, 2)) },
    Joint { kind: "point_on_line", planar: Some((PLANAR_AXIS, 1)), spatial: Some((SPATIAL_AXIS, 2)) },
    Joint {
        kind: "gear",
        planar: Some((r#""between": ["A.p", "B.p"], "teeth": ["10 + 7", 40], "offset": 0.3"#, 1)),
        spatial: Some((r#""between": ["A.p", "B.p"], "teeth": [17, 40], "carrier": ["B.r", "A.r"]"#, 1)),
    },
    Joint {
        kind: "driver",
        planar: Some((r#""between": ["A.p", "B.p"], "coordinate": "angle", "value": "sin(2*t) + t^2""#, 1)),
        spatial: Some((r#""between": ["A.p", "B.p"], "coordinate": "angle", "value": "sin(2*t) + t^2""#, 1)),
    },
    Joint {
        kind: "driver",
        planar: Some((r#""between": ["A.p", "B.p"], "coordinate": "x", "value": "exp(-t)""#, 1)),
        spatial: Some((r#""between": ["A.p", "B.p"], "coordinate": "z", "value": "exp(-t)""#, 1)),
    },
    Joint {
        kind: "driver",
        planar: Some((r#""between": ["A.p", "B.p"], "coordinate": "distance", "value": "1 + cos(t)""#, 1)),
        spatial: Some((r#""between": ["A.p", "B.p"], "coordinate": "distance", "value": "1 + cos(t)""#, 1)),
    },
    Joint {
        kind: "equation",
        planar: Some((r#""expression": "B.p.x*sin(B.angle) + A.r.y^2 - t^2*B.r.x""#, 1)),
        spatial: Some((r#""expression": "B.p.x*sin(B.r.z) + A.r.y^2 - t^2*B.r.x""#, 1)),
    },
];

/// What may be said of a force beside its power.
#[derive(Clone, Copy, PartialEq)]
pub enum Nature {
    /// Its wrench is minus the gradient of its potential; between the two bodies.
    Conservative,
    /// The same, but from the ground.
    Supported,
    /// It takes energy and never gives any; between the two bodies.
    Damper,
    /// Anything between the two bodies.
    Internal,
    Other,
}

/// A kind of force with its keys in the plane and in space.
pub struct Force {
    pub kind: &'static str,
    pub nature: Nature,
    pub planar: &'static str,
    pub spatial: &'static str,
}

pub const FORCES: &[Force] = &[
    Force {
        kind: "spring_damper",
        nature: Nature::Conservative,
        planar: r#""between": ["A.p", "B.p"], "stiffness": 30, "free_length": 0.4, "preload": 3"#,
        spatial: r#""between": ["A.p", "B.p"], "stiffness": 30, "free_length": 0.4, "preload": 3"#,
    },
    Force {
        kind: "spring_damper",
        nature: Nature::Conservative,
        planar: r#""between": ["A.p", "B.p"], "stiffness": 30"#,
        spatial: r#""between": ["A.p", "B.p"], "stiffness": 30"#,
    },
    Force {
        kind: "spring_damper",
        nature: Nature::Damper,
        planar: r#""between": ["A.p", "B.p"], "stiffness": 30, "damping": 5"#,
        spatial: r#""between": ["A.p", "B.p"], "stiffness": 30, "damping": 5"#,
    },
    Force {
        kind: "spring_damper",
        nature: Nature::Internal,
        planar: r#""between": ["A.p", "B.p"], "law": "30*(length - 0.4)^3 + 2*rate*A.r.y + sin(t)""#,
        spatial: r#""between": ["A.p", "B.p"], "law": "30*(length - 0.4)^3 + 2*rate*A.r.y + sin(t)""#,
    },
    Force {
        kind: "torsion_spring",
        nature: Nature::Internal,
        planar: r#""between": ["A.p", "B.p"], "law": "8*(angle - 0.3)^3 + 2*rate*A.r.y""#,
        spatial: r#""between": ["A.p", "B.p"], "law": "8*(angle - 0.3)^3 + 2*rate*A.r.y""#,
    },
    Force {
        kind: "torsion_spring",
        nature: Nature::Conservative,
        planar: r#""between": ["A.p", "B.p"], "stiffness": 8, "free_angle": 0.3"#,
        spatial: r#""between": ["A.p", "B.p"], "stiffness": 8, "free_angle": 0.3"#,
    },
    Force {
        kind: "torsion_spring",
        nature: Nature::Damper,
        planar: r#""between": ["A.p", "B.p"], "stiffness": 8, "damping": 2"#,
        spatial: r#""between": ["A.p", "B.p"], "stiffness": 8, "damping": 2"#,
    },
    Force {
        kind: "bushing",
        nature: Nature::Conservative,
        planar: r#""between": ["A.p", "B.p"], "stiffness": [20, 30, 4]"#,
        spatial: r#""between": ["A.p", "B.p"], "stiffness": [20, 30, 25, 4, 3, 5]"#,
    },
    Force {
        kind: "bushing",
        nature: Nature::Damper,
        planar: r#""between": ["A.p", "B.p"], "stiffness": [20, 30, 4], "damping": [1, 2, 3]"#,
        spatial: r#""between": ["A.p", "B.p"], "stiffness": [9, 7, 8, 4, 3, 5], "damping": [1, 2, 3, 4, 5, 6]"#,
    },
    Force {
        kind: "beam",
        nature: Nature::Conservative,
        planar: r#""between": ["A.p", "B.p"], "length": 1.2, "stiffness": { "EA": 30, "EI": 4 }, "curvature": 0.3"#,
        spatial: r#""between": ["A.p", "B.p"], "length": 1.2, "stiffness": { "EA": 30, "EI": [4, 5], "GJ": 3, "GA": 9 },
            "theory": "timoshenko", "curvature": [0.2, 0.3, -0.1]"#,
    },
    Force {
        kind: "beam",
        nature: Nature::Damper,
        planar: r#""between": ["A.p", "B.p"], "length": 1.2, "stiffness": { "EA": 30, "EI": 4 },
            "damping": { "stiffness": 0.1 }"#,
        spatial: r#""between": ["A.p", "B.p"], "length": 1.2, "stiffness": { "EA": 30, "EI": 4, "GJ": 3 },
            "damping": { "stiffness": 0.1 }"#,
    },
    Force {
        kind: "applied_force",
        nature: Nature::Other,
        planar: r#""at": "B.p", "force": ["sin(3*t)", "-2*B.p.x' + A.r.y"]"#,
        spatial: r#""at": "B.p", "force": ["sin(3*t)", "-2*B.p.x' + A.r.y", "B.wx"]"#,
    },
    Force {
        kind: "applied_force",
        nature: Nature::Internal,
        planar: r#""at": "B.p", "force": [1, "t*A.r.x"], "axes": "marker", "reaction_on": "A.p""#,
        spatial: r#""at": "B.p", "force": [1, "t*A.r.x", 2], "axes": "marker", "reaction_on": "A.p""#,
    },
    Force {
        kind: "applied_torque",
        nature: Nature::Internal,
        planar: r#""at": "B.p", "torque": "3 - B.angle'", "reaction_on": "A.p""#,
        spatial: r#""at": "B.p", "torque": [1, "t", "B.p.x"], "axes": "marker", "reaction_on": "A.p""#,
    },
    Force {
        kind: "tyre",
        nature: Nature::Supported,
        planar: r#""at": "B.p", "stiffness": 40, "radius": 0.3"#,
        spatial: r#""at": "B.p", "stiffness": 40, "radius": 0.3"#,
    },
    Force {
        kind: "tyre",
        nature: Nature::Other,
        planar: r#""at": "B.p", "stiffness": 4, "damping": 90, "radius": 0.3, "road": "t", "lift_off": true"#,
        spatial: r#""at": "B.p", "stiffness": 4, "damping": 90, "radius": 0.3, "road": "t", "lift_off": true"#,
    },
    Force {
        kind: "tyre",
        nature: Nature::Other,
        planar: r#""at": "B.p", "stiffness": 40, "damping": 3, "radius": 0.3, "road": "sin(t)""#,
        spatial: r#""at": "B.p", "stiffness": 40, "damping": 3, "radius": 0.3, "road": "sin(t)""#,
    },
];
