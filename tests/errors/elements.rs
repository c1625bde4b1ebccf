//! Elements that cannot be meant as they stand.

use crate::errors::{pendulum, top};

cases! {
    unknown_marker: pendulum().with("'ground.O', 'rod.A'", "'ground.O', 'rod.AA'");
    unknown_marker_far: pendulum().with("'ground.O', 'rod.A'", "'ground.O', 'zzz'");
    unknown_body_type: pendulum().with("'rigid'", "'rigd'");
    unknown_joint_type: pendulum().with("'revolute'", "'revolut'");
    unknown_joint_type_far: pendulum().with("'revolute'", "'hinge'");
    unknown_force_type: pendulum().with("'spring_damper'", "'spring'");
    self_joint: pendulum().with("'ground.O', 'rod.A'", "'rod.B', 'rod.A'");
    ground_joint: pendulum().with("'ground.O', 'rod.A'", "'ground.O', 'ground.P'");
    negative_mass: pendulum().with("'mass': 'm'", "'mass': -1");
    negative_mass_expr: pendulum().with("'mass': 'm'", "'mass': '-m'");
    negative_stiffness: pendulum().with("'stiffness': 10", "'stiffness': -10");
    mass_text: pendulum().with("'mass': 'm'", "'mass': 'heavy'");
    mass_null: pendulum().with("'mass': 'm'", "'mass': null");
    mass_list: pendulum().with("'mass': 'm'", "'mass': [1]");
    triangle: top().with("[1, 1, 0.5]", "[1, 1, 5]");
    neg_moment: top().with("[1, 1, 0.5]", "[1, 1, -5]");
    inertia_count_2d: pendulum().with("'inertia': 'm*l^2/12'", "'inertia': [1,2,3]");
    inertia_count_3d: top().with("[1, 1, 0.5]", "[1, 1]");
    inertia_number_3d: top().with("[1, 1, 0.5]", "1");
    inertia_bool: pendulum().with("'inertia': 'm*l^2/12'", "'inertia': true");
    unknown_name: pendulum().with("'m*l^2/12'", "'m*ll^2/12'");
    unknown_name_far: pendulum().with("'m*l^2/12'", "'m*foo^2/12'");
    unknown_fn: pendulum().with("'m*l^2/12'", "'m*sqr(l)'");
    empty_expr: pendulum().with("'m*l^2/12'", "''");
    infinite: pendulum().with("'m*l^2/12'", "'m/0'");
    t_not_allowed: pendulum().with("'m*l^2/12'", "'m*t'");
    t_in_parameter: pendulum().with("'2*l'", "'2*t'");
    circular: pendulum().with("'l': 1.0", "'l': 'm/2'");
    reserved_param: pendulum().with("'l': 1.0", "'pi': 3, 'l': 1.0");
    bad_param_name: pendulum().with("'l': 1.0", "'a b': 3, 'l': 1.0");
    param_list: pendulum().with("'l': 1.0", "'l': [1]");
    three_numbers_in_the_plane: pendulum().with("[0, -9.81]", "[0, 0, -9.81]");
    three_numbers_in_the_plane_marker: pendulum().with("'O': [0, 0]", "'O': [0, 0, 0]");
    three_numbers_in_the_plane_position: pendulum().with("[0.5, 0]", "[0.5, 0, 0]");
    two_numbers_in_space: top().with("[0, 0, -9.81]", "[0, -9.81]");
    two_numbers_in_space_marker: top().with("'tip': [0, 0, -1]", "'tip': [0, -1]");
    two_numbers_in_space_rot: top().with("'rotation': [0.1, 0, 0]", "'rotation': [0.1, 0]");
    two_numbers_in_space_w: top().with("'angular_velocity': [0, 0, 5]", "'angular_velocity': [0, 5]");
    w_number_in_space: top().with("'angular_velocity': [0, 0, 5]", "'angular_velocity': 5");
    angle_in_space: top().with("'rotation': [0.1, 0, 0]", "'angle': 1");
    rotation_in_plane: pendulum().with("'angle': 0", "'rotation': [0,0,1]");
    set_neg: pendulum().args(&["--set", "l=-1"]);
    no_end: pendulum().with("'t_end': 0.1, ", "");
    dup_joint: pendulum().and_joint("{ 'name': 'pin', 'type': 'revolute', 'between': ['ground.O', 'rod.A'] }");
    dup_force: pendulum().with("'free_length': 2 }", "'free_length': 2 },  {'name':'spring'}");
    dup_output: pendulum().with("'of': 'rod' }", "'of': 'rod' }, { 'name': 'theta', 'measure': 'angle', 'of': 'rod' }");
    body_ground: pendulum().with("'name': 'rod'", "'name': 'ground'");
    bad_name: pendulum().with("'name': 'rod'", "'name': 'a b'");
    bad_name_joint: pendulum().with("'name': 'pin'", "'name': '1pin'");
    bad_name_marker: pendulum().with("'A': [", "'A B': [");
    bad_name_output: pendulum().with("'theta'", "'the-ta'");
    output_named_t: pendulum().with("'theta'", "'t'");
    a_name_of_both_a_parameter_and_an_output_in_an_expression: pendulum().with("'theta'", "'l'")
        .force("{ 'name': 'f', 'type': 'applied_torque', 'at': 'rod', 'torque': '2*l' }");
    scene_name_slash: pendulum().with("'pendulum'", "'../pendulum'");
    scene_name_empty: pendulum().with("'pendulum'", "''");
    gear_0: pendulum().joint("{ 'name': 'g', 'type': 'gear', 'between': ['ground.O', 'rod.A'], 'teeth': [0, 10] }");
    gear_frac: pendulum()
        .joint("{ 'name': 'g', 'type': 'gear', 'between': ['ground.O', 'rod.A'], 'teeth': [1.5, 10] }");
    gear_huge: pendulum()
        .joint("{ 'name': 'g', 'type': 'gear', 'between': ['ground.O', 'rod.A'], 'teeth': [10, 99999999999] }");
    distance_0: pendulum().joint("{ 'name': 'd', 'type': 'distance', 'between': ['ground.O', 'rod.A'], 'length': 0 }");
    universal_plane: pendulum().with("'revolute'", "'universal'");
    spherical_plane: pendulum().with("'revolute'", "'spherical'");
    axis_plane_zero: pendulum()
        .joint("{ 'name': 'p', 'type': 'prismatic', 'between': ['ground.O', 'rod.A'], 'axis': [0,0] }");
    axis_plane_3: pendulum()
        .joint("{ 'name': 'p', 'type': 'prismatic', 'between': ['ground.O', 'rod.A'], 'axis': [0,0,1] }");
    driver_z: pendulum()
        .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'z', 'value': 't' }");
    driver_bad_coord: pendulum()
        .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'angel', 'value': 't' }");
    driver_marker: pendulum()
        .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'x', 'value': 'rod.x' }");
    driver_unknown: pendulum()
        .joint("{ 'name': 'p', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'x', 'value': 'tt' }");
    equation_no_coord: pendulum().joint("{ 'name': 'p', 'type': 'equation', 'expression': 't-1' }");
    equation_rate: pendulum().joint("{ 'name': 'p', 'type': 'equation', 'expression': 'rod.x´ - 1' }");
    equation_unknown: pendulum().joint("{ 'name': 'p', 'type': 'equation', 'expression': 'rodd.x - 1' }");
    output_joint_unknown: pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'reaction', 'of': 'pinn'");
    output_force_unknown: pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'force', 'of': 'sprin'");
    output_marker_unknown: pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'angle', 'of': 'rd'");
    output_bad_measure: pendulum().with("'measure': 'angle'", "'measure': 'angel'");
    output_bad_component: pendulum()
        .with("'measure': 'angle', 'of': 'rod'", "'measure': 'position', 'of': 'rod', 'component': 'z'");
    output_axial_without_a_length: pendulum()
        .with("'measure': 'angle', 'of': 'rod'", "'measure': 'reaction', 'of': 'pin', 'component': 'axial'");
    output_size_in_axes: pendulum()
        .with("'measure': 'angle', 'of': 'rod'", "'measure': 'reaction', 'of': 'pin', 'relative_to': 'rod'");
    output_energy_component: pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'energy', 'component': 'kin'");
    output_useless_of: pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'energy', 'of':'rod'");
    outputs_circle: pendulum()
        .with("'measure': 'angle', 'of': 'rod' }", "'measure': 'expression', 'value':'b' }, {'name':'b','measure':'expression','value':'theta'}");
    outputs_bomb: pendulum().with("'measure': 'angle', 'of': 'rod' }", "'measure': 'expression', 'value':'2*theta' }");
    outputs_unknown_name: pendulum()
        .with("'measure': 'angle', 'of': 'rod'", "'measure': 'expression', 'value':'rod.anle'");
    input_spring: pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'spring'}]");
    input_unknown: pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'sprng'}]");
    input_component_z: pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'spring','component':'z'}]")
        .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0, 't'] }");
    input_two_targets: pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'spring','driver':'O'}]");
    input_no_driver: pendulum().with("'inputs': []", "'inputs': [{'name':'u','driver':'pin'}]");
    input_unknown_driver: pendulum().with("'inputs': []", "'inputs': [{'name':'u','driver':'P'}]");
    input_no_tyre: pendulum().with("'inputs': []", "'inputs': [{'name':'u','tyre':'spring'}]");
    input_tyre_as_force: pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'w'}]")
        .force("{ 'name': 'w', 'type': 'tyre', 'at': 'rod.B', 'stiffness': 1, 'radius': 1 }");
    input_component_of_road: pendulum().with("'inputs': []", "'inputs': [{'name':'u','tyre':'w','component':'y'}]")
        .force("{ 'name': 'w', 'type': 'tyre', 'at': 'rod.B', 'stiffness': 1, 'radius': 1 }");
    input_value_of_marker: pendulum().with("'inputs': []", "'inputs': [{'name':'u','tyre':'w','value':'rod.x'}]")
        .force("{ 'name': 'w', 'type': 'tyre', 'at': 'rod.B', 'stiffness': 1, 'radius': 1 }");
    input_dup: pendulum()
        .with("'inputs': []", "'inputs': [{'name':'u','force':'spring','component':'x'},{'name':'u','force':'spring','component':'y'}]")
        .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0, 't'] }");
    force_3: pendulum().force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0,0,1] }");
    torque_list: pendulum().force("{ 'name': 'q', 'type': 'applied_torque', 'at': 'rod', 'torque': [1,2,3] }");
    torque_bool: pendulum().force("{ 'name': 'q', 'type': 'applied_torque', 'at': 'rod', 'torque': true }");
    torque_bad: pendulum().force("{ 'name': 'q', 'type': 'applied_torque', 'at': 'rod', 'torque': 'rod.w' }");
    bushing_2: pendulum()
        .force("{ 'name': 'q', 'type': 'bushing', 'between': ['ground.O','rod.A'], 'stiffness': [1,2] }");
    force_on_ground: pendulum()
        .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'ground.P', 'force': [0, 't'] }");
    axes_bad: pendulum()
        .force("{ 'name': 'spring', 'type': 'applied_force', 'axes': 'markr', 'at': 'rod.B', 'force': [0, 't'] }");
    tyre_radius: pendulum().force("{ 'name': 'q', 'type': 'tyre', 'at': 'rod.B', 'stiffness': 5, 'radius': 0 }");
    t_end_null: pendulum().with("'t_end': 0.1", "'t_end': null");
    free_bad: pendulum().with("'mass': 'm'", "'free': ['x','anlge'], 'mass': 'm'");
    free_two_rot: top().with("'mass': 1,", "'mass': 1, 'free': ['rx','ry'],");
    free_empty: pendulum().with("'mass': 'm'", "'free': [], 'mass': 'm'");
    quat_zero: top().with("'rotation': [0.1, 0, 0]", "'rotation': [0, 0, 0, 0]");
    rotation_and_axes: top().with("'O': [0, 0, 0]", "'O': {'position':[0,0,0],'rotation':[0,0,1],'z_axis':[0,0,1]}");
    z_axis_zero: top().with("'O': [0, 0, 0]", "'O': {'position':[0,0,0],'z_axis':[0,0,0]}");
    parallel_axes: top().with("'O': [0, 0, 0]", "'O': {'position':[0,0,0],'z_axis':[0,0,1],'x_axis':[0,0,2]}");
    origin_3: pendulum().with("'mass': 'm'", "'mass':'m', 'origin': [0,0,0]");
    state_without_rate: with_state("'initial': 1");
    state_of_unknown: with_state("'rate': 'rod.angel'");
    state_with_the_name_of_an_output: with_state("'rate': 1").with("'theta'", "'i'");
    state_with_the_name_of_a_parameter: with_state("'rate': 1").with("'l': 1.0", "'l': 1.0, 'i': 2");
    state_that_prescribes_a_motion: with_state("'rate': 1").with("'type': 'revolute'", "'type': 'driver', 'coordinate': 'angle', 'value': 'i'");
    state_as_a_marker: with_state("'rate': 1").with("'rod.B'", "'i'");
    state_over_too_many_markers: with_state("'rate': 'ground.O.x + ground.P.x + rod.A.x + rod.B.x + rod.x + a0.x + a1.x + a2.x + a3.x'")
        .with("'bodies': [", &format!("'bodies': [{}", (0..4).map(|k| format!("{{ 'name': 'a{k}', 'type': 'point_mass', 'mass': 1 }}, ")).collect::<String>()));
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
