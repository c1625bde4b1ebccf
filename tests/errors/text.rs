//! Files that are not text, not JSON, or say a thing twice.

use crate::errors::{PENDULUM, pendulum, scene};

cases! {
    trailing_comma: pendulum().with("'angle': 0 }", "'angle': 0, }");
    trailing_comma_list: pendulum().with("'rod.A']", "'rod.A',]");
    comment: pendulum().with("'dimension': 2,", "'dimension': 2, // plane");
    comment2: pendulum().with("'dimension': 2,", "/* plane */ 'dimension': 2,");
    comment3: pendulum().with("'dimension': 2,", "# plane  'dimension': 2,");
    nan: pendulum().with("'stiffness': 10", "'stiffness': NaN");
    n1e400: pendulum().with("'stiffness': 10", "'stiffness': 1e400");
    infinity: pendulum().with("'stiffness': 10", "'stiffness': Infinity");
    infinity_too: pendulum().with("'stiffness': 10", "'stiffness': -Infinity");
    missing_comma: pendulum().with("'dimension': 2,", "'dimension': 2");
    missing_colon: pendulum().with("'dimension': 2,", "'dimension' 2,");
    unquoted_key: pendulum().with("'dimension': 2,", "dimension: 2,");
    true_true: pendulum().with("'dimension': 2,", "'dimension': True,");
    leading_zero: pendulum().with("'stiffness': 10", "'stiffness': 010");
    leading_point: pendulum().with("'stiffness': 10", "'stiffness': .5");
    unquoted_expr: pendulum().with("'stiffness': 10", "'stiffness': l*2");
    dup_marker_key: pendulum().with("'B': ['l/2', 0]", "'A': ['l/2', 0]");
    dup_key: pendulum().with("'dimension': 2,", "'dimension': 2, 'dimension': 2,");
    bodies_not_list: pendulum().with("'bodies': [", "'bodies': {},  'joints': [] } [");
    no_bodies: pendulum().with("'bodies': [", "'bodies': [], 'joints': [], 'forces': [], 'xodies': [");
}

#[test]
fn scenes_without_anything() {
    for text in ["", " \n\t\n", "\u{feff}"] {
        scene(text).refused_with(&["error: scene.json: the file is empty\n", "a scene is a JSON object", "schema"]);
    }
}

#[test]
fn json_that_is_no_scene() {
    for (text, found) in [("[1]", "a list of 1"), ("3", "3"), ("null", "null"), ("\"scene\"", "\"scene\"")] {
        let message = format!("scene.json: a scene is a JSON object, found {found}\n");
        scene(text).refused_with(&[&message, "begin with {\"name\": ..., \"dimension\": 2, ...}"]);
    }
    let pieces = ["scene.json: the key `name` is missing", "help: add \"name\": ...", "holonom schema"];
    scene("{}").refused_with(&pieces);
}

#[test]
fn a_truncated_file_is_told_wherever_it_ends() {
    for length in [1, 2, 100, 400, PENDULUM.len() - 3] {
        let pieces = ["scene.json:", "this is not JSON: the file ends too early", "close the bracket or quotes"];
        scene(&PENDULUM[..length]).refused_with(&pieces);
    }
}

#[test]
fn single_quotes_and_deep_brackets() {
    let text = PENDULUM.replace('"', "'");
    scene(text).refused_with(&["scene.json:2:3: this is not JSON: a single quote", "double quotes"]);
    let deep = format!("{{ \"name\": {}", "[".repeat(100_000));
    scene(deep).refused_with(&["scene.json:1:", "brackets more than 100 deep"]);
}

#[test]
fn a_fault_beside_letters_of_several_bytes_has_its_column_in_characters() {
    let pieces = ["scene.json:1:24: this is not JSON: `NaN`", "must be finite"];
    scene("{ \"name\": \"äöü\", \"x\" : NaN }").refused_with(&pieces);
}
