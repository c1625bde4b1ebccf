//! Outputs of joints and forces, laws of springs, gravity and bodies that are not free.

use super::*;

const DRIVE: &str =
    "{ 'name': 'motor', 'type': 'driver', 'between': ['ground.O', 'rod.A'], 'coordinate': 'angle', 'value': 't' }";

/// Another output in the place of the angle.
fn measuring(output: &str) -> Scene {
    pendulum().with("'measure': 'angle', 'of': 'rod'", output)
}

/// A law in the place of the spring's numbers.
fn law(keys: &str) -> Scene {
    pendulum().with("'stiffness': 10, 'free_length': 2", keys)
}

cases! {
    angle_of_a_slider: measuring("'measure': 'angle', 'of': 'slide'")
        .joint("{ 'name': 'slide', 'type': 'prismatic', 'between': ['ground.O', 'rod.A'] }");
    travel_of_a_hinge: measuring("'measure': 'position', 'of': 'pin'");
    angle_about_x_in_the_plane: measuring("'measure': 'angle', 'of': 'pin', 'component': 'x'");
    angle_of_a_joint_against_a_marker: measuring("'measure': 'angle', 'of': 'pin', 'relative_to': 'rod'");
    torque_of_a_motor: measuring("'measure': 'torque', 'of': 'motor'").and_joint(DRIVE);
    force_of_a_joint: measuring("'measure': 'force', 'of': 'pin'");
    power_of_a_hinge: measuring("'measure': 'power', 'of': 'pin'");
    second_side_of_a_lone_force: measuring("'measure': 'force', 'of': 'f', 'component': 'x', 'on': 'second'")
        .force("{ 'name': 'f', 'type': 'applied_force', 'at': 'rod', 'force': [1, 2] }");
    length_of_a_single_marker: measuring("'measure': 'distance', 'of': 'f'")
        .force("{ 'name': 'f', 'type': 'applied_force', 'at': 'rod', 'force': [1, 2] }");
    law_with_stiffness: law("'stiffness': 10, 'law': '3*length'");
    law_misspelled: law("'law': '3*lenght'");
    law_named_as_a_parameter: law("'law': '3*length'").with("'l': 1.0", "'l': 1.0, 'length': 2");
    law_named_as_an_output: law("'law': '3*angle + length'").with("'theta'", "'length'");
    law_of_an_acceleration: law("'law': '3*length + theta´´'");
    law_of_a_reaction: law("'law': '3*length + R'").with("'outputs': [", "'outputs': [ { 'name': 'R', 'measure': 'reaction', 'of': 'pin' }, ");
    law_of_its_own_output: law("'law': '3*reach'").with("'outputs': [", "'outputs': [ { 'name': 'reach', 'measure': 'distance', 'of': 'spring' }, ");
    equation_before_its_joint: measuring("'measure': 'angle', 'of': 'late'")
        .joint("{ 'name': 'early', 'type': 'equation', 'expression': 'theta - t' }, \
                    { 'name': 'late', 'type': 'revolute', 'between': ['ground.O', 'rod.A'] }");
    gravity_without_strength: pendulum().with("[0, -9.81]", "{ 'towards': 'ground.O' }");
    gravity_towards_a_body: pendulum().with("[0, -9.81]", "{ 'towards': 'rod.A', 'mu': 1 }");
    gravity_of_a_beam: pendulum().with("[0, -9.81]", "{ 'towards': 'ground.O', 'mu': 1 }")
        .with("'A': ['-l/2', 0]", "'A': [0, 0]").with("'type': 'rigid', 'mass': 'm', 'inertia': 'm*l^2/12'",
                "'type': 'flexible_beam', 'frame': 'floating', 'length': 1, 'elements': 2,
                 'stiffness': { 'EA': 1e5, 'EI': 10 }, 'inertia': { 'rhoA': 1 }");
    free_to_turn_without_inertia: pendulum().with("'inertia': 'm*l^2/12'", "'free': ['x', 'angle']");
    velocity_along_what_is_not_free: pendulum().with("'inertia': 'm*l^2/12'", "'free': ['x']").with("'angle': 0", "'velocity': [1, 2]");
    negative_moment_about_the_free_axis: top().with("[1, 1, 0.5]", "[0, 0, -5], 'free': ['rz']");
}
