//! Elements that cannot be meant as they stand.

use crate::errors::{pendulum, top};

cases! {
    unknown_marker:
        pendulum().with("'ground.O', 'rod.A'", "'ground.O', 'rod.AA'") => [
            "scene.json:13:66: at joints[0].between[1] (`pin`): there is no marker `rod.AA`",
            "did you mean `rod.A`?",
        ];
    unknown_marker_far:
        pendulum().with("'ground.O', 'rod.A'", "'ground.O', 'zzz'") => [
            "scene.json:13:66: at joints[0].between[1] (`pin`): there is no marker `zzz`",
            "choose one of ground.O, ground.P, rod.A, rod.B",
        ];
    unknown_body_type:
        pendulum().with("'rigid'", "'rigd'") => [
            "scene.json:8:30: at bodies[0].type (`rod`): there is no body of type `rigd`",
            "did you mean `rigid`?",
        ];
    unknown_joint_type:
        pendulum().with("'revolute'", "'revolut'") => [
            "scene.json:13:30: at joints[0].type (`pin`): there is no joint of type `revolut`",
            "did you mean `revolute`?",
        ];
    unknown_joint_type_far:
        pendulum().with("'revolute'", "'hinge'") => [
            "scene.json:13:30: at joints[0].type (`pin`): there is no joint of type `hinge`",
            "choose one of revolute, prismatic",
        ];
    unknown_force_type:
        pendulum().with("'spring_damper'", "'spring'") => [
            "scene.json:16:33: at forces[0].type (`spring`): there is no force of type `spring`",
            "did you mean `spring_damper`?",
        ];
    self_joint:
        pendulum().with("'ground.O', 'rod.A'", "'rod.B', 'rod.A'") => [
            "scene.json:13:53: at joints[0].between (`pin`): both markers, `rod.B` and `rod.A`, are on `rod`",
            "name markers of two different bodies",
        ];
    ground_joint:
        pendulum().with("'ground.O', 'rod.A'", "'ground.O', 'ground.P'") => [
            "scene.json:13:53: at joints[0].between (`pin`): both markers, `ground.O` and `ground.P`, are on `ground`",
            "name markers of two different bodies",
        ];
    negative_mass:
        pendulum().with("'mass': 'm'", "'mass': -1") => [
            "scene.json:8:47: at bodies[0].mass (`rod`): mass is -1, but cannot be negative",
            "give zero or more",
        ];
    negative_mass_expr:
        pendulum().with("'mass': 'm'", "'mass': '-m'") => [
            "scene.json:8:47: at bodies[0].mass (`rod`): mass is -2, but cannot be negative",
            "give zero or more",
        ];
    negative_stiffness:
        pendulum().with("'stiffness': 10", "'stiffness': -10") => [
            "scene.json:16:97: at forces[0].stiffness (`spring`): stiffness is -10, but cannot be negative",
            "give zero or more",
        ];
    mass_text:
        pendulum().with("'mass': 'm'", "'mass': 'heavy'") => [
            r#"scene.json:8:47: at bodies[0].mass (`rod`): unknown name `heavy` at character 1 in "heavy""#,
            "choose one of l, m, pi",
        ];
    mass_null:
        pendulum().with("'mass': 'm'", "'mass': null") => [
            "scene.json:8:47: at bodies[0].mass (`rod`): expected a number or an expression such as \"sqrt(2)*l\", \
             found null",
        ];
    mass_list:
        pendulum().with("'mass': 'm'", "'mass': [1]") => [
            "scene.json:8:47: at bodies[0].mass (`rod`): expected a number or an expression such as \"sqrt(2)*l\", \
             found a list",
        ];
    triangle:
        top().with("[1, 1, 0.5]", "[1, 1, 5]") => [
            "scene.json:7:61: at bodies[0].inertia (`top`): principal moments 1, 1, 5 violate the triangle inequality",
            "no body has one principal moment above the sum of the other two: check units and signs",
        ];
    neg_moment:
        top().with("[1, 1, 0.5]", "[1, 1, -5]") => [
            "scene.json:7:61: at bodies[0].inertia (`top`): a principal moment of inertia is -5, but cannot be \
             negative",
            "check the signs, and the order Ixx, Iyy, Izz, Ixy, Ixz, Iyz",
        ];
    inertia_count_2d:
        pendulum().with("'inertia': 'm*l^2/12'", "'inertia': [1,2,3]") => [
            "scene.json:8:63: at bodies[0].inertia (`rod`): expected one number, found 3",
            "a planar body has one moment of inertia, about its centre of mass",
        ];
    inertia_count_3d:
        top().with("[1, 1, 0.5]", "[1, 1]") => [
            "scene.json:7:61: at bodies[0].inertia (`top`): expected 3 or 6 numbers, found 2",
            "a spatial body has [Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz]",
        ];
    inertia_number_3d:
        top().with("[1, 1, 0.5]", "1") => [
            "scene.json:7:61: at bodies[0].inertia (`top`): expected 3 or 6 numbers, found 1",
            "a spatial body has [Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz]",
        ];
    inertia_bool:
        pendulum().with("'inertia': 'm*l^2/12'", "'inertia': true") => [
            "scene.json:8:63: at bodies[0].inertia (`rod`): expected a number, an expression such as \"m*l^2/12\", \
             or a list of these, found true",
        ];
    unknown_name:
        pendulum().with("'m*l^2/12'", "'m*ll^2/12'") => [
            r#"scene.json:8:63: at bodies[0].inertia (`rod`): unknown name `ll` at character 3 in "m*ll^2/12""#,
            "did you mean `l`?",
        ];
    unknown_name_far:
        pendulum().with("'m*l^2/12'", "'m*foo^2/12'") => [
            r#"scene.json:8:63: at bodies[0].inertia (`rod`): unknown name `foo` at character 3 in "m*foo^2/12""#,
            "choose one of l, m, pi",
        ];
    unknown_fn:
        pendulum().with("'m*l^2/12'", "'m*sqr(l)'") => [
            r#"scene.json:8:63: at bodies[0].inertia (`rod`): unknown function `sqr` at character 3 in "m*sqr(l)""#,
            "did you mean `sqrt`?",
        ];
    empty_expr:
        pendulum().with("'m*l^2/12'", "''") => [
            "scene.json:8:63: at bodies[0].inertia (`rod`): empty expression",
            "expected a number or a formula such as `2*l`",
        ];
    infinite:
        pendulum().with("'m*l^2/12'", "'m/0'") => [
            "scene.json:8:63: at bodies[0].inertia (`rod`): `m/0` is infinite",
            "expected a finite number",
        ];
    t_not_allowed:
        pendulum().with("'m*l^2/12'", "'m*t'") => [
            r#"scene.json:8:63: at bodies[0].inertia (`rod`): unknown name `t` at character 3 in "m*t""#,
            "what stands here must not depend on time",
        ];
    t_in_parameter:
        pendulum().with("'2*l'", "'2*t'") => [
            r#"scene.json:4:34: at parameters.m: unknown name `t` at character 3 in "2*t""#,
            "what stands here must not depend on time",
        ];
    circular:
        pendulum().with("'l': 1.0", "'l': 'm/2'") => [
            "scene.json:4:24: at parameters.l: parameters depend on each other in a circle: l -> m -> l",
            "give one of them as a number",
        ];
    reserved_param:
        pendulum().with("'l': 1.0", "'pi': 3, 'l': 1.0") => [
            "scene.json:4:25: at parameters.pi: `pi` cannot name a parameter: expressions use it themselves",
            "choose another name, such as `pi_1`",
        ];
    bad_param_name:
        pendulum().with("'l': 1.0", "'a b': 3, 'l': 1.0") => [
            "scene.json:4:26: at parameters.a b: `a b` cannot name a parameter",
            "expected a letter, then letters, digits and `_`",
        ];
    param_list:
        pendulum().with("'l': 1.0", "'l': [1]") => [
            "scene.json:4:24: at parameters.l: expected a number or an expression such as \"sqrt(2)*l\", found a list",
        ];
    three_numbers_in_the_plane:
        pendulum().with("[0, -9.81]", "[0, 0, -9.81]") => [
            "scene.json:5:14: at gravity: expected 2 numbers, found 3",
            r#"the scene has "dimension": 2"#,
        ];
    three_numbers_in_the_plane_marker:
        pendulum().with("'O': [0, 0]", "'O': [0, 0, 0]") => [
            "scene.json:6:33: at ground.markers.O: expected 2 numbers, found 3",
            r#"the scene has "dimension": 2"#,
        ];
    three_numbers_in_the_plane_position:
        pendulum().with("[0.5, 0]", "[0.5, 0, 0]") => [
            "scene.json:10:32: at bodies[0].initial.position (`rod`): expected 2 numbers, found 3",
            r#"the scene has "dimension": 2"#,
        ];
    two_numbers_in_space:
        top().with("[0, 0, -9.81]", "[0, -9.81]") => [
            "scene.json:4:14: at gravity: expected 3 numbers, found 2",
            r#"the scene has "dimension": 3"#,
        ];
    two_numbers_in_space_marker:
        top().with("'tip': [0, 0, -1]", "'tip': [0, -1]") => [
            "scene.json:8:27: at bodies[0].markers.tip (`top`): expected 3 numbers, found 2",
            r#"the scene has "dimension": 3"#,
        ];
    two_numbers_in_space_rot:
        top().with("'rotation': [0.1, 0, 0]", "'rotation': [0.1, 0]") => [
            "scene.json:9:55: at bodies[0].initial.rotation (`top`): expected 4 or 3 numbers, found 2",
            "give a quaternion [w, x, y, z] or a rotation vector [x, y, z] in radians",
        ];
    two_numbers_in_space_w:
        top().with("'angular_velocity': [0, 0, 5]", "'angular_velocity': [0, 5]") => [
            "scene.json:9:88: at bodies[0].initial.angular_velocity (`top`): expected 3 numbers, found 2",
            r#"the scene has "dimension": 3"#,
        ];
    w_number_in_space:
        top().with("'angular_velocity': [0, 0, 5]", "'angular_velocity': 5") => [
            "scene.json:9:88: at bodies[0].initial.angular_velocity (`top`): expected 3 numbers, found one",
            "give [wx, wy, wz] in the body's axes, rad/s",
        ];
    angle_in_space:
        top().with("'rotation': [0.1, 0, 0]", "'angle': 1") => [
            "scene.json:9:52: at bodies[0].initial.angle (`top`): a spatial body needs more than one angle",
            r#"give "rotation" as a quaternion [w, x, y, z] or a rotation vector"#,
        ];
    rotation_in_plane:
        pendulum().with("'angle': 0", "'rotation': [0,0,1]") => [
            "scene.json:10:54: at bodies[0].initial.rotation (`rod`): a planar body turns by an angle",
            r#"give "angle" in radians"#,
        ];
    set_neg:
        pendulum().args(&["--set", "l=-1"]) => [
            "scene.json:8:47: at bodies[0].mass (`rod`): mass is -2, but cannot be negative",
            "give zero or more",
        ];
    no_end:
        pendulum().with("'t_end': 0.1, ", "") => [
            "scene.json: the scene `pendulum` has no end time",
            r#"give --until T, or "t_end" in "simulation" of the scene"#,
        ];
    dup_joint:
        pendulum()
            .and_joint("{ 'name': 'pin', 'type': 'revolute', 'between': ['ground.O', 'rod.A'] }") => [
            "scene.json:13:88: at joints[1].name: the name `pin` is taken",
            "give each joint its own",
        ];
    dup_force:
        pendulum().with("'free_length': 2 }", "'free_length': 2 },  {'name':'spring'}") => [
            "scene.json:16:130: at forces[1].name: the name `spring` is taken",
            "give each force its own",
        ];
    dup_output:
        pendulum()
            .with("'of': 'rod' }", "'of': 'rod' }, { 'name': 'theta', 'measure': 'angle', 'of': 'rod' }") => [
            "scene.json:19:80: at outputs[1].name: the name `theta` is taken",
            "give each output its own",
        ];
    body_ground:
        pendulum().with("'name': 'rod'", "'name': 'ground'") => [
            "scene.json:8:15: at bodies[0].name: the name `ground` is taken",
            "give each body its own",
        ];
    bad_name:
        pendulum().with("'name': 'rod'", "'name': 'a b'") => [
            "scene.json:8:15: at bodies[0].name: `a b` cannot be a name",
            "use a letter, then letters, digits and underscores",
        ];
    bad_name_joint:
        pendulum().with("'name': 'pin'", "'name': '1pin'") => [
            "scene.json:13:15: at joints[0].name: `1pin` cannot be a name",
            "use a letter, then letters, digits and underscores",
        ];
    bad_name_marker:
        pendulum().with("'A': [", "'A B': [") => [
            "scene.json:9:18: at bodies[0].markers (`rod`): `A B` cannot be a name",
            "use a letter, then letters, digits and underscores",
        ];
    bad_name_output:
        pendulum().with("'theta'", "'the-ta'") => [
            "scene.json:19:26: at outputs[0].name: `the-ta` cannot be a name",
            "use a letter, then letters, digits and underscores",
        ];
    output_named_t:
        pendulum().with("'theta'", "'t'") => [
            "scene.json:19:26: at outputs[0].name: the name `t` is taken by time",
            "give each output its own",
        ];
    a_name_of_both_a_parameter_and_an_output_in_an_expression:
        pendulum()
            .with("'theta'", "'l'")
            .force("{ 'name': 'f', 'type': 'applied_torque', 'at': 'rod', 'torque': '2*l' }") => [
            "scene.json:16:69: at forces[0].torque (`f`): `l` is both a parameter and an output",
            "rename one of them",
        ];
    scene_name_slash:
        pendulum().with("'pendulum'", "'../pendulum'") => [
            "scene.json:2:11: at name: `../pendulum` cannot name a scene",
            "its results go to a folder of this name: use letters, digits, `_` and `-`",
        ];
    scene_name_empty:
        pendulum().with("'pendulum'", "''") => [
            "scene.json:2:11: at name: `` cannot name a scene",
            "its results go to a folder of this name: use letters, digits, `_` and `-`",
        ];
    gear_0:
        pendulum()
            .joint("{ 'name': 'g', 'type': 'gear', 'between': ['ground.O', 'rod.A'], 'teeth': [0, 10] }") => [
            "scene.json:13:80: at joints[0].teeth[0] (`g`): a wheel cannot have 0 teeth",
            "give a whole number, not zero; it is negative for an internal gear",
        ];
    gear_frac:
        pendulum()
            .joint("{ 'name': 'g', 'type': 'gear', 'between': ['ground.O', 'rod.A'], 'teeth': [1.5, 10] }") => [
            "scene.json:13:80: at joints[0].teeth[0] (`g`): a wheel cannot have 1.5 teeth",
        ];
    gear_huge:
        pendulum()
            .joint("{ 'name': 'g', 'type': 'gear', 'between': ['ground.O', 'rod.A'], 'teeth': [10, 99999999999] }") => [
            "scene.json:13:84: at joints[0].teeth[1] (`g`): a wheel cannot have 99999999999 teeth",
        ];
    distance_0:
        pendulum()
            .joint("{ 'name': 'd', 'type': 'distance', 'between': ['ground.O', 'rod.A'], 'length': 0 }") => [
            "scene.json:13:84: at joints[0].length (`d`): length is 0, but must be above zero",
            "give a number above zero",
        ];
    universal_plane:
        pendulum().with("'revolute'", "'universal'") => [
            r#"scene.json:13:30: at joints[0].type (`pin`): a universal joint needs "dimension": 3"#,
            r#"in this scene use "revolute""#,
        ];
    spherical_plane:
        pendulum().with("'revolute'", "'spherical'") => [
            r#"scene.json:13:30: at joints[0].type (`pin`): a spherical joint needs "dimension": 3"#,
            r#"in this scene use "revolute""#,
        ];
    axis_plane_zero:
        pendulum()
            .joint("{ 'name': 'p', 'type': 'prismatic', 'between': ['ground.O', 'rod.A'], 'axis': [0,0] }") => [
            "scene.json:13:83: at joints[0].axis (`p`): the axis has no direction",
            "give a vector that is not zero",
        ];
    axis_plane_3:
        pendulum()
            .joint("{ 'name': 'p', 'type': 'prismatic', 'between': ['ground.O', 'rod.A'], 'axis': [0,0,1] }") => [
            "scene.json:13:83: at joints[0].axis (`p`): expected 2 numbers, found 3",
            r#"the scene has "dimension": 2"#,
        ];
    driver_z:
        pendulum()
            .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'z', 'value': 't' }") => [
            "scene.json:13:86: at joints[0].coordinate (`p`): a planar scene has no z",
            "use x, y or angle",
        ];
    driver_bad_coord:
        pendulum()
            .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'angel', 'value': 't' }") => [
            "scene.json:13:86: at joints[0].coordinate (`p`): `angel` is none of the possible values",
            "did you mean `angle`?",
        ];
    driver_marker:
        pendulum()
            .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'x', 'value': 'rod.x' }") => [
            "scene.json:13:100: at joints[0].value (`p`): this may depend on t and parameters only, but uses a marker",
            "markers and outputs may stand in an `equation` joint, an applied force or torque, the law of a spring, a tyre's \
             road, and outputs",
        ];
    driver_unknown:
        pendulum()
            .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'x', 'value': 'tt' }") => [
            r#"scene.json:13:100: at joints[0].value (`p`): unknown name `tt` at character 1 in "tt""#,
            "did you mean `t`?",
        ];
    equation_no_coord:
        pendulum().joint("{ 'name': 'p', 'type': 'equation', 'expression': 't-1' }") => [
            "scene.json:13:54: at joints[0].expression (`p`): the expression names no coordinate of a body",
            "use marker coordinates such as `body.marker.x`",
        ];
    equation_rate:
        pendulum().joint("{ 'name': 'p', 'type': 'equation', 'expression': 'rod.x´ - 1' }") => [
            "scene.json:13:54: at joints[0].expression (`p`): unknown name `rod.x'` at character 1 in \"rod.x' - 1\"",
            "a rate of this order cannot stand here; `rod.x` can",
        ];
    equation_unknown:
        pendulum().joint("{ 'name': 'p', 'type': 'equation', 'expression': 'rodd.x - 1' }") => [
            "scene.json:13:54: at joints[0].expression (`p`): unknown name `rodd.x` at character 1 in \"rodd.x - 1\"",
            "did you mean `rod.x`?",
        ];
    output_joint_unknown:
        pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'reaction', 'of': 'pinn'") => [
            "scene.json:19:64: at outputs[0].of (`theta`): there is no joint `pinn`",
            "did you mean `pin`?",
        ];
    output_force_unknown:
        pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'force', 'of': 'sprin'") => [
            "scene.json:19:61: at outputs[0].of (`theta`): there is no force `sprin`",
            "did you mean `spring`?",
        ];
    output_marker_unknown:
        pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'angle', 'of': 'rd'") => [
            "scene.json:19:61: at outputs[0].of (`theta`): there is no marker, joint or force `rd`",
            "did you mean `rod`?",
        ];
    output_bad_measure:
        pendulum().with("'measure': 'angle'", "'measure': 'angel'") => [
            "scene.json:19:46: at outputs[0].measure (`theta`): `angel` is none of the possible values",
            "did you mean `angle`?",
        ];
    output_bad_component:
        pendulum()
            .with("'measure': 'angle', 'of': 'rod'", "'measure': 'position', 'of': 'rod', 'component': 'z'") => [
            "scene.json:19:84: at outputs[0].component (`theta`): there is no component `z`",
            "choose one of x, y",
        ];
    output_axial_without_a_length:
        pendulum()
            .with("'measure': 'angle', 'of': 'rod'", "'measure': 'reaction', 'of': 'pin', 'component': 'axial'") => [
            "scene.json:19:84: at outputs[0].component (`theta`): there is no component `axial`",
            "choose one of x, y, mz",
        ];
    output_size_in_axes:
        pendulum()
            .with("'measure': 'angle', 'of': 'rod'", "'measure': 'reaction', 'of': 'pin', 'relative_to': 'rod'") => [
            "scene.json:19:86: at outputs[0].relative_to (`theta`): this measure has no `relative_to`",
            "remove it; here \"measure\" goes with of, component",
        ];
    output_energy_component:
        pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'energy', 'component': 'kin'") => [
            "scene.json:19:69: at outputs[0].component (`theta`): there is no component `kin`",
            "choose one of kinetic, potential, total",
        ];
    output_useless_of:
        pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'energy', 'of':'rod'") => [
            "scene.json:19:61: at outputs[0].of (`theta`): this measure has no `of`",
            r#"remove it; here "measure" goes with component"#,
        ];
    outputs_circle:
        pendulum()
            .with("'measure': 'angle', 'of': 'rod' }", "'measure': 'expression', 'value':'b' }, {'name':'b','measure':'expression','value':'theta'}") => [
            "scene.json:19:68: at outputs[0].value (`theta`): outputs refer to each other in a circle, or grow \
             beyond all bounds",
            "write one of them in terms of markers alone",
        ];
    outputs_bomb:
        pendulum()
            .with("'measure': 'angle', 'of': 'rod' }", "'measure': 'expression', 'value':'2*theta' }") => [
            "scene.json:19:68: at outputs[0].value (`theta`): outputs refer to each other in a circle, or grow \
             beyond all bounds",
            "write one of them in terms of markers alone",
        ];
    outputs_unknown_name:
        pendulum()
            .with("'measure': 'angle', 'of': 'rod'", "'measure': 'expression', 'value':'rod.anle'") => [
            "scene.json:19:68: at outputs[0].value (`theta`): unknown name `rod.anle` at character 1 in \"rod.anle\"",
            "did you mean `rod.angle`?",
        ];
    input_spring:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'spring'}]") => [
            "scene.json:18:34: at inputs[0].force (`u`): `spring` is a spring_damper, which an input cannot drive",
            "name an applied_force or an applied_torque",
        ];
    input_unknown:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'sprng'}]") => [
            "scene.json:18:34: at inputs[0].force (`u`): there is no force `sprng`",
            "did you mean `spring`?",
        ];
    input_component_z:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'spring','component':'z'}]")
            .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0, 't'] }") => [
            "scene.json:18:55: at inputs[0].component (`u`): there is no component `z`",
            "choose one of x, y",
        ];
    input_two_targets:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'spring','driver':'O'}]") => [
            "scene.json:18:52: at inputs[0].driver (`u`): an input drives one element",
            "give one of `force`, an applied force or torque, `driver`, a joint, and `tyre`, a force",
        ];
    input_no_driver:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','driver':'pin'}]") => [
            "scene.json:18:35: at inputs[0].driver (`u`): `pin` is a revolute, which an input cannot drive",
            "name a joint of type driver",
        ];
    input_unknown_driver:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','driver':'P'}]") => [
            "scene.json:18:35: at inputs[0].driver (`u`): there is no driver `P`",
            "there is only `pin`",
        ];
    input_no_tyre:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','tyre':'spring'}]") => [
            "scene.json:18:33: at inputs[0].tyre (`u`): `spring` is a spring_damper, which an input cannot drive",
            "name a tyre, or an applied force or torque under `force`",
        ];
    input_tyre_as_force:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'w'}]")
            .force("{ 'name': 'w', 'type': 'tyre', 'at': 'rod.B', 'stiffness': 1, 'radius': 1 }") => [
            "scene.json:18:34: at inputs[0].force (`u`): `w` is a tyre: an input adds to its road",
            r#"write "tyre": "w""#,
        ];
    input_component_of_road:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','tyre':'w','component':'y'}]")
            .force("{ 'name': 'w', 'type': 'tyre', 'at': 'rod.B', 'stiffness': 1, 'radius': 1 }") => [
            "scene.json:18:49: at inputs[0].component (`u`): there is no component `y`: this input is a displacement",
            "remove it",
        ];
    input_value_of_marker:
        pendulum().with("'inputs': []", "'inputs': [{'name':'u','tyre':'w','value':'rod.x'}]")
            .force("{ 'name': 'w', 'type': 'tyre', 'at': 'rod.B', 'stiffness': 1, 'radius': 1 }") => [
            "scene.json:18:45: at inputs[0].value (`u`): this may depend on t and parameters only, but uses a marker",
            "markers and outputs may stand in an `equation` joint",
        ];
    input_dup:
        pendulum()
            .with("'inputs': []", "'inputs': [{'name':'u','force':'spring','component':'x'},{'name':'u','force':'spring','component':'y'}]")
            .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0, 't'] }") => [
            "scene.json:18:68: at inputs[1].name: the name `u` is taken",
            "give each input its own",
        ];
    force_3:
        pendulum()
            .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0,0,1] }") => [
            "scene.json:16:74: at forces[0].force (`spring`): expected 2 numbers, found 3",
            r#"the scene has "dimension": 2"#,
        ];
    torque_list:
        pendulum()
            .force("{ 'name': 'q', 'type': 'applied_torque', 'at': 'rod', 'torque': [1,2,3] }") => [
            "scene.json:16:69: at forces[0].torque (`q`): expected one number",
            r#"the scene has "dimension": 2"#,
        ];
    torque_bool:
        pendulum().force("{ 'name': 'q', 'type': 'applied_torque', 'at': 'rod', 'torque': true }") => [
            "scene.json:16:69: at forces[0].torque (`q`): expected a number, an expression such as \"k*t\", or a \
             list of these, found true",
        ];
    torque_bad:
        pendulum()
            .force("{ 'name': 'q', 'type': 'applied_torque', 'at': 'rod', 'torque': 'rod.w' }") => [
            r#"scene.json:16:69: at forces[0].torque (`q`): unknown name `rod.w` at character 1 in "rod.w""#,
            "did you mean `rod.x`?",
        ];
    bushing_2:
        pendulum()
            .force("{ 'name': 'q', 'type': 'bushing', 'between': ['ground.O','rod.A'], 'stiffness': [1,2] }") => [
            "scene.json:16:85: at forces[0].stiffness (`q`): expected 3 numbers, found 2",
            "along x and y and about z",
        ];
    force_on_ground:
        pendulum()
            .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'ground.P', 'force': [0, 't'] }") => [
            "scene.json:16:56: at forces[0].at (`spring`): `ground.P` is on the ground, which no force moves",
            "name a marker of a body",
        ];
    axes_bad:
        pendulum()
            .force("{ 'name': 'spring', 'type': 'applied_force', 'axes': 'markr', 'at': 'rod.B', 'force': [0, 't'] }") => [
            "scene.json:16:58: at forces[0].axes (`spring`): `markr` is none of the possible values",
            "did you mean `marker`?",
        ];
    tyre_radius:
        pendulum()
            .force("{ 'name': 'q', 'type': 'tyre', 'at': 'rod.B', 'stiffness': 5, 'radius': 0 }") => [
            "scene.json:16:77: at forces[0].radius (`q`): radius is 0, but must be above zero",
            "give a number above zero",
        ];
    t_end_null:
        pendulum().with("'t_end': 0.1", "'t_end': null") => [
            "scene.json: the scene `pendulum` has no end time",
            r#"give --until T, or "t_end" in "simulation" of the scene"#,
        ];
    free_bad:
        pendulum().with("'mass': 'm'", "'free': ['x','anlge'], 'mass': 'm'") => [
            "scene.json:8:52: at bodies[0].free[1] (`rod`): there is no coordinate `anlge`",
            "did you mean `angle`?",
        ];
    free_two_rot:
        top().with("'mass': 1,", "'mass': 1, 'free': ['rx','ry'],") => [
            "scene.json:7:58: at bodies[0].free (`top`): a body may turn about one axis or about all",
            r#"keep one of rx, ry, rz, or leave "free" out and use joints"#,
        ];
    free_empty:
        pendulum().with("'mass': 'm'", "'free': [], 'mass': 'm'") => [
            "scene.json:8:47: at bodies[0].free (`rod`): no coordinate is free",
            "name some of x, y, angle, or put the markers on the ground",
        ];
    quat_zero:
        top().with("'rotation': [0.1, 0, 0]", "'rotation': [0, 0, 0, 0]") => [
            "scene.json:9:55: at bodies[0].initial.rotation (`top`): the quaternion is zero",
            "[1, 0, 0, 0] is no rotation",
        ];
    rotation_and_axes:
        top()
            .with("'O': [0, 0, 0]", "'O': {'position':[0,0,0],'rotation':[0,0,1],'z_axis':[0,0,1]}") => [
            "scene.json:5:33: at ground.markers.O: both a rotation and axes are given",
            "keep one of them",
        ];
    z_axis_zero:
        top().with("'O': [0, 0, 0]", "'O': {'position':[0,0,0],'z_axis':[0,0,0]}") => [
            "scene.json:5:62: at ground.markers.O.z_axis: the axis has no direction of its own",
            "give vectors that are not zero and not parallel",
        ];
    parallel_axes:
        top()
            .with("'O': [0, 0, 0]", "'O': {'position':[0,0,0],'z_axis':[0,0,1],'x_axis':[0,0,2]}") => [
            "scene.json:5:79: at ground.markers.O.x_axis: the axis has no direction of its own",
            "give vectors that are not zero and not parallel",
        ];
    origin_3:
        pendulum().with("'mass': 'm'", "'mass':'m', 'origin': [0,0,0]") => [
            "scene.json:8:61: at bodies[0].origin (`rod`): expected 2 numbers, found 3",
            r#"the scene has "dimension": 2"#,
        ];
}

#[test]
fn a_second_body_of_the_same_name() {
    let twin = "{ 'name': 'rod', 'type': 'point_mass', 'mass': 1 }, { 'name': 'rod', 'type': 'rigid'";
    let pieces = ["scene.json:8:67: at bodies[1].name: the name `rod` is taken", "give each body its own"];
    pendulum().with("{ 'name': 'rod', 'type': 'rigid'", twin).refused_with(&pieces);
}

#[test]
fn a_scene_without_bodies() {
    let text = r#"{ "name": "nothing", "dimension": 2, "bodies": [] }"#;
    let pieces = ["scene.json:1:48: at bodies: the scene has no body", "give at least one"];
    crate::errors::scene(text).refused_with(&pieces);
}

#[test]
fn outputs_that_grow_without_bound() {
    let output = |i: usize| format!("{{ 'name': 'o{i}', 'measure': 'expression', 'value': 'o{0}+o{0}' }}", i + 1);
    let outputs: Vec<String> = (0..60).map(output).collect();
    let last = "{ 'name': 'o60', 'measure': 'angle', 'of': 'rod' }, { 'name': 'theta'";
    let scene = pendulum().with("{ 'name': 'theta'", &format!("{}, {last}", outputs.join(", ")));
    scene.refused_with(&["at outputs[0].value (`o0`)", "in a circle, or grow beyond all bounds"]);
}

/// A pendulum whose state `i` is given by these keys.
fn with_state(keys: &str) -> super::Scene {
    pendulum().with("'inputs': []", &format!("'states': [{{ 'name': 'i', {keys} }}], 'inputs': []"))
}

cases! {
    state_without_rate:
        with_state("'initial': 1") => ["at states[0]", "the key `rate` is missing"];
    state_of_unknown:
        with_state("'rate': 'rod.angel'") => ["at states[0].rate (`i`)", "unknown name `rod.angel`", "did you mean `rod.angle`?"];
    state_with_the_name_of_an_output:
        with_state("'rate': 1").with("'theta'", "'i'") => ["at states[0].name", "`i` is that of an output", "a name of its own"];
    state_with_the_name_of_a_parameter:
        with_state("'rate': 1").with("'l': 1.0", "'l': 1.0, 'i': 2") => ["at states[0].name", "`i` is that of a parameter"];
    state_that_prescribes_a_motion:
        with_state("'rate': 1").with("'type': 'revolute'", "'type': 'driver', 'coordinate': 'angle', 'value': 'i'") => [
            "at joints[0].value (`pin`)", "unknown name `i`",
        ];
    state_as_a_marker:
        with_state("'rate': 1").with("'rod.B'", "'i'") => ["at forces[0].between[1] (`spring`)", "there is no marker `i`"];
    state_over_too_many_markers:
        with_state("'rate': 'ground.O.x + ground.P.x + rod.A.x + rod.B.x + rod.x + a0.x + a1.x + a2.x + a3.x'")
            .with("'bodies': [", &format!("'bodies': [{}", (0..4).map(|k| format!("{{ 'name': 'a{k}', 'type': 'point_mass', 'mass': 1 }}, ")).collect::<String>())) => [
            "at states[0] (`i`)", "uses 10 markers and states", "split it into several states",
        ];
}
