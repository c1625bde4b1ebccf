//! Keys that are misspelled or missing, and values of the wrong kind.

use crate::errors::{pendulum, top};

cases! {
    typo_top:
        pendulum().with("'gravity'", "'gravty'") => [
            "scene.json:5:13: at gravty: unknown key `gravty`",
            "did you mean `gravity`?",
        ];
    typo_ground:
        pendulum().with("'ground': { 'markers'", "'ground': { 'marker'") => [
            "scene.json:6:25: at ground.marker: unknown key `marker`",
            "did you mean `markers`?",
        ];
    typo_body:
        pendulum().with("'inertia'", "'inertai'") => [
            "scene.json:8:63: at bodies[0].inertai (`rod`): unknown key `inertai`",
            "did you mean `inertia`?",
        ];
    typo_body_shared:
        pendulum().with("'initial'", "'intial'") => [
            "scene.json:10:17: at bodies[0].intial (`rod`): unknown key `intial`",
            "did you mean `initial`?",
        ];
    typo_joint:
        pendulum().with("'between': ['ground.O'", "'betwen': ['ground.O'") => [
            "scene.json:13:52: at joints[0].betwen (`pin`): unknown key `betwen`",
            "did you mean `between`?",
        ];
    typo_force:
        pendulum().with("'stiffness'", "'stifness'") => [
            "scene.json:16:96: at forces[0].stifness (`spring`): unknown key `stifness`",
            "did you mean `stiffness`?",
        ];
    typo_initial:
        pendulum().with("'position'", "'positon'") => [
            "scene.json:10:31: at bodies[0].initial.positon (`rod`): unknown key `positon`",
            "did you mean `position`?",
        ];
    typo_output:
        pendulum().with("'of'", "'off'") => [
            "scene.json:19:62: at outputs[0].off (`theta`): unknown key `off`",
            "did you mean `of`?",
        ];
    typo_assembly:
        pendulum().with("'hold'", "'holds'") => [
            "scene.json:20:26: at assembly.holds: unknown key `holds`",
            "did you mean `hold`?",
        ];
    typo_marker:
        pendulum().with("[0, 0], 'P'", "{'positon':[0,0]}, 'P'") => [
            "scene.json:6:44: at ground.markers.O.positon: unknown key `positon`",
            "did you mean `position`?",
        ];
    missing_type:
        pendulum().with("'type': 'revolute', ", "") => [
            "scene.json:13:5: at joints[0] (`pin`): the key `type` is missing",
            "give the joint a type: revolute, prismatic",
        ];
    missing_name:
        pendulum().with("'name': 'pin', ", "") => [
            "scene.json:13:5: at joints[0]: the key `name` is missing",
            r#"give a "name""#,
        ];
    missing_mass:
        pendulum().with("'mass': 'm', ", "") => [
            "scene.json:8:5: at bodies[0] (`rod`): the key `mass` is missing",
            r#"add "mass": ...; `holonom schema` says what it means"#,
        ];
    missing_scene_name:
        pendulum().with("'name': 'pendulum',", "") => [
            "scene.json: the key `name` is missing",
            r#"add "name": ...; `holonom schema` says what it means"#,
        ];
    missing_dimension:
        pendulum().with("'dimension': 2,", "") => [
            "scene.json: the key `dimension` is missing",
            r#"add "dimension": ...; `holonom schema` says what it means"#,
        ];
    type_not_text:
        pendulum().with("'type': 'revolute'", "'type': 5") => [
            "scene.json:13:30: at joints[0].type (`pin`): expected text in quotes, found 5",
        ];
    syntax:
        pendulum().with("'m*l^2/12'", "'m*(l^2/12'") => [
            "scene.json:8:63: at bodies[0].inertia (`rod`): expected ')' at character 10, found the end in \
             \"m*(l^2/12\"",
        ];
    syntax2:
        pendulum().with("'m*l^2/12'", "'m*l**2/12'") => [
            r#"scene.json:8:63: at bodies[0].inertia (`rod`): unexpected `**` at character 4 in "m*l**2/12""#,
            "a power is written `^`",
        ];
    dimension_4:
        pendulum().with("'dimension': 2", "'dimension': 4") => [
            "scene.json:3:16: at dimension: expected 2 for a planar scene or 3 for a spatial one, found 4",
        ];
    dimension_2_5:
        pendulum().with("'dimension': 2", "'dimension': 2.5") => [
            "scene.json:3:16: at dimension: expected 2 for a planar scene or 3 for a spatial one, found 2.5",
        ];
    dimension_300:
        pendulum().with("'dimension': 2", "'dimension': 300") => [
            "scene.json:3:16: at dimension: expected 2 for a planar scene or 3 for a spatial one, found 300",
        ];
    dimension_1:
        pendulum().with("'dimension': 2", "'dimension': -1") => [
            "scene.json:3:16: at dimension: expected 2 for a planar scene or 3 for a spatial one, found -1",
        ];
    dimension_text:
        pendulum().with("'dimension': 2", "'dimension': '2'") => [
            r#"scene.json:3:16: at dimension: expected 2 for a planar scene or 3 for a spatial one, found "2""#,
        ];
    gear_one:
        pendulum()
            .joint("{ 'name': 'g', 'type': 'gear', 'between': ['ground.O', 'rod.A'], 'teeth': [10] }") => [
            "scene.json:13:79: at joints[0].teeth (`g`): expected a list of 2, found a list of 1",
        ];
    gear_3d:
        top()
            .with("'type': 'spherical', 'between': ['ground.O', 'top.tip']", "'type': 'gear', 'between': ['ground.O', 'top.tip'], 'teeth': [1,2]") => [
            "scene.json:11:15: at joints[0] (`tip`): the key `carrier` is missing",
            "in space name two markers whose z axes are the axes of the wheels",
        ];
    between_1:
        pendulum().with("['ground.O', 'rod.A']", "['ground.O']") => [
            "scene.json:13:53: at joints[0].between (`pin`): expected a list of 2, found a list of 1",
        ];
    between_3:
        pendulum().with("['ground.O', 'rod.A']", "['ground.O', 'rod.A', 'rod.B']") => [
            "scene.json:13:53: at joints[0].between (`pin`): expected a shorter list, found a list of 3",
        ];
    between_text:
        pendulum().with("['ground.O', 'rod.A']", "'rod.A'") => [
            r#"scene.json:13:53: at joints[0].between (`pin`): expected a list of 2, found "rod.A""#,
        ];
    between_number:
        pendulum().with("['ground.O', 'rod.A']", "['ground.O', 3]") => [
            "scene.json:13:66: at joints[0].between[1] (`pin`): expected text in quotes, found 3",
        ];
    output_no_of:
        pendulum().with(", 'of': 'rod'", "") => [
            "scene.json:19:16: at outputs[0] (`theta`): the key `of` is missing",
            "name what is measured: a body, marker, joint or force",
        ];
    output_no_measure:
        pendulum().with("'measure': 'angle', ", "") => [
            "scene.json:19:16: at outputs[0] (`theta`): the key `measure` is missing",
            r#"add "measure": ...; `holonom schema` says what it means"#,
        ];
    output_no_value:
        pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'expression'") => [
            "scene.json:19:16: at outputs[0] (`theta`): the key `value` is missing",
            "give an expression over t and marker quantities",
        ];
    output_no_between:
        pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'distance'") => [
            "scene.json:19:16: at outputs[0] (`theta`): the key `between` is missing",
            "name two markers",
        ];
    input_no_component:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'spring'}]")
            .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0, 't'] }") => [
            "scene.json:18:14: at inputs[0] (`u`): the key `component` is missing",
            "choose one of x, y",
        ];
    input_no_target:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u'}]") => [
            "scene.json:18:14: at inputs[0] (`u`): the key `force` is missing",
            "give one of `force`, an applied force or torque, `driver`, a joint, and `tyre`, a force",
        ];
    force_number:
        pendulum()
            .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': 5 }") => [
            "scene.json:16:74: at forces[0].force (`spring`): expected a list [...], found 5",
        ];
    body_not_object:
        pendulum().with("    { 'name': 'rod'", "    5, { 'name': 'rod'") => [
            "scene.json:8:5: at bodies[0]: expected an object {...}, found 5",
        ];
    markers_list:
        pendulum()
            .with("'ground': { 'markers': { 'O': [0, 0], 'P': [3, 0] } }", "'ground': { 'markers': [] }") => [
            "scene.json:6:26: at ground.markers: expected an object {...}, found an empty list",
        ];
    marker_number:
        pendulum().with("'O': [0, 0]", "'O': 5") => [
            "scene.json:6:33: at ground.markers.O: expected a position, found 5",
            r#"write [x, y], [x, y, z] or {"position": [...], ...}"#,
        ];
    body_markers_list:
        pendulum().with("'markers': { 'A': ['-l/2', 0], 'B': ['l/2', 0] }", "'markers': []") => [
            "scene.json:9:18: at bodies[0].markers (`rod`): expected an object {...}, found an empty list",
        ];
    initial_list:
        pendulum().with("'initial': { 'position': [0.5, 0], 'angle': 0 }", "'initial': []") => [
            "scene.json:10:18: at bodies[0].initial (`rod`): expected an object {...}, found an empty list",
        ];
    gravity_number:
        pendulum().with("[0, -9.81]", "-9.81") => [
            "scene.json:5:14: at gravity: expected a list [...], found -9.81",
        ];
    bad_option:
        pendulum().args(&["--untill", "3"]) => [
            "unexpected argument '--untill' found",
            "a similar argument exists: '--until'",
            "Usage: holonom simulate --until <T> <SCENE>",
        ];
}
