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
    angle_of_a_slider:
        measuring("'measure': 'angle', 'of': 'slide'")
            .joint("{ 'name': 'slide', 'type': 'prismatic', 'between': ['ground.O', 'rod.A'] }") => [
            "at outputs[0].of (`theta`): the prismatic `slide` has no angle of its own",
            "name a joint that leaves it free, or a marker",
        ];
    travel_of_a_hinge:
        measuring("'measure': 'position', 'of': 'pin'") => [
            "at outputs[0].of (`theta`): the revolute `pin` has no position of its own",
        ];
    angle_about_x_in_the_plane:
        measuring("'measure': 'angle', 'of': 'pin', 'component': 'x'") => [
            "at outputs[0].component (`theta`): there is no component `x`",
            "choose one of z",
        ];
    angle_of_a_joint_against_a_marker:
        measuring("'measure': 'angle', 'of': 'pin', 'relative_to': 'rod'") => [
            "at outputs[0].relative_to (`theta`): a joint or force is measured between its own markers",
        ];
    torque_of_a_motor:
        measuring("'measure': 'torque', 'of': 'motor'").and_joint(DRIVE) => [
            "at outputs[0].of (`theta`): `motor` is a joint, no flexible beam",
            "\"measure\": \"reaction\" gives what a joint exerts",
        ];
    force_of_a_joint:
        measuring("'measure': 'force', 'of': 'pin'") => [
            "at outputs[0].of (`theta`): `pin` is a joint, not a force",
            "\"measure\": \"reaction\" gives what a joint exerts",
        ];
    power_of_a_hinge:
        measuring("'measure': 'power', 'of': 'pin'") => [
            "at outputs[0].of (`theta`): the revolute `pin` has no power",
            "name a driver or a force",
        ];
    second_side_of_a_lone_force:
        measuring("'measure': 'force', 'of': 'f', 'component': 'x', 'on': 'second'")
            .force("{ 'name': 'f', 'type': 'applied_force', 'at': 'rod', 'force': [1, 2] }") => [
            "at outputs[0].on (`theta`): `f` acts on one marker alone",
        ];
    length_of_a_single_marker:
        measuring("'measure': 'distance', 'of': 'f'")
            .force("{ 'name': 'f', 'type': 'applied_force', 'at': 'rod', 'force': [1, 2] }") => [
            "at outputs[0].of (`theta`): the applied_force `f` has no length of its own",
        ];
    law_with_stiffness:
        law("'stiffness': 10, 'law': '3*length'") => [
            "at forces[0].stiffness (`spring`): a spring with a `law` has no `stiffness`",
            "write it into the law, or remove the law",
        ];
    law_misspelled:
        law("'law': '3*lenght'") => [
            "at forces[0].law (`spring`): unknown name `lenght`",
            "did you mean `length`?",
        ];
    law_named_as_a_parameter:
        law("'law': '3*length'").with("'l': 1.0", "'l': 1.0, 'length': 2") => [
            "at forces[0].law (`spring`): `length` is a parameter, and a name of this expression's own",
            "rename the parameter",
        ];
    law_named_as_an_output:
        law("'law': '3*angle + length'").with("'theta'", "'length'") => [
            "at forces[0].law (`spring`): `length` is an output, and a name of this expression's own",
            "rename the output",
        ];
    law_of_an_acceleration:
        law("'law': '3*length + theta´´'") => [
            "at forces[0].law (`spring`): `theta''` is an acceleration, which cannot stand here",
        ];
    law_of_a_reaction:
        law("'law': '3*length + R'").with("'outputs': [", "'outputs': [ { 'name': 'R', 'measure': 'reaction', 'of': 'pin' }, ") => [
            "at forces[0].law (`spring`): the output `R` is no position, angle, distance or rate of these",
        ];
    law_of_its_own_output:
        law("'law': '3*reach'").with("'outputs': [", "'outputs': [ { 'name': 'reach', 'measure': 'distance', 'of': 'spring' }, ") => [
            "at forces[0].law (`spring`): the output `reach` measures `spring` itself",
            "measure its markers, by `between` or `relative_to`; laws of springs know their own `length`, `angle` and `rate`",
        ];
    equation_before_its_joint:
        measuring("'measure': 'angle', 'of': 'late'")
            .joint("{ 'name': 'early', 'type': 'equation', 'expression': 'theta - t' }, \
                    { 'name': 'late', 'type': 'revolute', 'between': ['ground.O', 'rod.A'] }") => [
            "at joints[0].expression (`early`): the output `theta` measures `late`, which comes after this",
            "put `late` before it in the scene",
        ];
    gravity_without_strength:
        pendulum().with("[0, -9.81]", "{ 'towards': 'ground.O' }") => ["at gravity: the key `mu` is missing"];
    gravity_towards_a_body:
        pendulum().with("[0, -9.81]", "{ 'towards': 'rod.A', 'mu': 1 }") => [
            "at gravity.towards: `rod.A` is on a body that moves",
            "name a marker of the ground",
        ];
    gravity_of_a_beam:
        pendulum()
            .with("[0, -9.81]", "{ 'towards': 'ground.O', 'mu': 1 }")
            .with("'A': ['-l/2', 0]", "'A': [0, 0]")
            .with("'type': 'rigid', 'mass': 'm', 'inertia': 'm*l^2/12'",
                "'type': 'flexible_beam', 'frame': 'floating', 'length': 1, 'elements': 2,
                 'stiffness': { 'EA': 1e5, 'EI': 10 }, 'inertia': { 'rhoA': 1 }") => [
            "at gravity: gravity towards a point acts on rigid bodies, but `rod` is none",
        ];
    free_to_turn_without_inertia:
        pendulum().with("'inertia': 'm*l^2/12'", "'free': ['x', 'angle']") => [
            "at bodies[0] (`rod`): the key `inertia` is missing",
        ];
    velocity_along_what_is_not_free:
        pendulum().with("'inertia': 'm*l^2/12'", "'free': ['x']").with("'angle': 0", "'velocity': [1, 2]") => [
            "at bodies[0].initial.velocity (`rod`): the body cannot move like that",
            "remove what is along other directions",
        ];
    negative_moment_about_the_free_axis:
        top().with("[1, 1, 0.5]", "[0, 0, -5], 'free': ['rz']") => [
            "at bodies[0].inertia (`top`): the moment about the axis of rotation is -4.95",
        ];
}
