//! Keys that are misspelled or missing, and values of the wrong kind.

use crate::errors::{pendulum, top};

cases! {
    typo_top: pendulum().with("'gravity'", "'gravty'");
    typo_ground: pendulum().with("'ground': { 'markers'", "'ground': { 'marker'");
    typo_body: pendulum().with("'inertia'", "'inertai'");
    typo_body_shared: pendulum().with("'initial'", "'intial'");
    typo_joint: pendulum().with("'between': ['ground.O'", "'betwen': ['ground.O'");
    typo_force: pendulum().with("'stiffness'", "'stifness'");
    typo_initial: pendulum().with("'position'", "'positon'");
    typo_output: pendulum().with("'of'", "'off'");
    typo_assembly: pendulum().with("'hold'", "'holds'");
    typo_marker: pendulum().with("[0, 0], 'P'", "{'positon':[0,0]}, 'P'");
    missing_type: pendulum().with("'type': 'revolute', ", "");
    missing_name: pendulum().with("'name': 'pin', ", "");
    missing_mass: pendulum().with("'mass': 'm', ", "");
    missing_scene_name: pendulum().with("'name': 'pendulum',", "");
    missing_dimension: pendulum().with("'dimension': 2,", "");
    type_not_text: pendulum().with("'type': 'revolute'", "'type': 5");
    syntax: pendulum().with("'m*l^2/12'", "'m*(l^2/12'");
    syntax2: pendulum().with("'m*l^2/12'", "'m*l**2/12'");
    dimension_4: pendulum().with("'dimension': 2", "'dimension': 4");
    dimension_2_5: pendulum().with("'dimension': 2", "'dimension': 2.5");
    dimension_300: pendulum().with("'dimension': 2", "'dimension': 300");
    dimension_1: pendulum().with("'dimension': 2", "'dimension': -1");
    dimension_text: pendulum().with("'dimension': 2", "'dimension': '2'");
    gear_one: pendulum().joint("{ 'name': 'g', 'type': 'gear', 'between': ['ground.O', 'rod.A'], 'teeth': [10] }");
    gear_3d: top()
        .with("'type': 'spherical', 'between': ['ground.O', 'top.tip']", "'type': 'gear', 'between': ['ground.O', 'top.tip'], 'teeth': [1,2]");
    between_1: pendulum().with("['ground.O', 'rod.A']", "['ground.O']");
    between_3: pendulum().with("['ground.O', 'rod.A']", "['ground.O', 'rod.A', 'rod.B']");
    between_text: pendulum().with("['ground.O', 'rod.A']", "'rod.A'");
    between_number: pendulum().with("['ground.O', 'rod.A']", "['ground.O', 3]");
    output_no_of: pendulum().with(", 'of': 'rod'", "");
    output_no_measure: pendulum().with("'measure': 'angle', ", "");
    output_no_value: pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'expression'");
    output_no_between: pendulum().with("'measure': 'angle', 'of': 'rod'", "'measure': 'distance'");
    input_no_component: pendulum().with("'inputs': []", "'inputs': [{'name':'u','force':'spring'}]")
        .force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': [0, 't'] }");
    input_no_target: pendulum().with("'inputs': []", "'inputs': [{'name':'u'}]");
    force_number: pendulum().force("{ 'name': 'spring', 'type': 'applied_force', 'at': 'rod.B', 'force': 5 }");
    body_not_object: pendulum().with("    { 'name': 'rod'", "    5, { 'name': 'rod'");
    markers_list: pendulum()
        .with("'ground': { 'markers': { 'O': [0, 0], 'P': [3, 0] } }", "'ground': { 'markers': [] }");
    marker_number: pendulum().with("'O': [0, 0]", "'O': 5");
    body_markers_list: pendulum().with("'markers': { 'A': ['-l/2', 0], 'B': ['l/2', 0] }", "'markers': []");
    initial_list: pendulum().with("'initial': { 'position': [0.5, 0], 'angle': 0 }", "'initial': []");
    gravity_number: pendulum().with("[0, -9.81]", "-9.81");
    bad_option: pendulum().args(&["--untill", "3"]);
}
