//! Files that are not text, not JSON, or say a thing twice.

use crate::errors::{PENDULUM, pendulum, scene};

cases! {
    trailing_comma:
        pendulum().with("'angle': 0 }", "'angle': 0, }") => [
            "scene.json:10:54: this is not JSON: a comma after the last entry",
            "remove the comma",
        ];
    trailing_comma_list:
        pendulum().with("'rod.A']", "'rod.A',]") => [
            "scene.json:13:74: this is not JSON: a comma after the last entry",
            "remove the comma",
        ];
    comment:
        pendulum().with("'dimension': 2,", "'dimension': 2, // plane") => [
            "scene.json:3:19: this is not JSON: a comment",
            r#"remove it; "about" has room for words"#,
        ];
    comment2:
        pendulum().with("'dimension': 2,", "/* plane */ 'dimension': 2,") => [
            "scene.json:3:3: this is not JSON: a comment",
            r#"remove it; "about" has room for words"#,
        ];
    comment3:
        pendulum().with("'dimension': 2,", "# plane  'dimension': 2,") => [
            "scene.json:3:3: this is not JSON: a comment",
            r#"remove it; "about" has room for words"#,
        ];
    nan:
        pendulum().with("'stiffness': 10", "'stiffness': NaN") => [
            "scene.json:16:97: this is not JSON: `NaN`",
            "every number of a scene must be finite; remove the key where the default is meant",
        ];
    n1e400:
        pendulum().with("'stiffness': 10", "'stiffness': 1e400") => [
            "scene.json:16:101: this is not JSON: a number beyond 1.8e308",
            "every number of a scene must be finite",
        ];
    infinity:
        pendulum().with("'stiffness': 10", "'stiffness': Infinity") => [
            "scene.json:16:97: this is not JSON: `Infinity`",
            "every number of a scene must be finite; remove the key where the default is meant",
        ];
    infinity_too:
        pendulum().with("'stiffness': 10", "'stiffness': -Infinity") => [
            "scene.json:16:98: this is not JSON: `Infinity`",
            "every number of a scene must be finite; remove the key where the default is meant",
        ];
    missing_comma:
        pendulum().with("'dimension': 2,", "'dimension': 2") => [
            "scene.json:4:3: this is not JSON: no comma between two entries",
            "put a comma after the entry before, or check its quotes and brackets",
        ];
    missing_colon:
        pendulum().with("'dimension': 2,", "'dimension' 2,") => [
            "scene.json:3:15: this is not JSON: no colon after a key",
            r#"write "key": value"#,
        ];
    unquoted_key:
        pendulum().with("'dimension': 2,", "dimension: 2,") => [
            "scene.json:3:3: this is not JSON: a key without quotes",
            r#"write {"name": ...}"#,
        ];
    true_true:
        pendulum().with("'dimension': 2,", "'dimension': True,") => [
            "scene.json:3:16: this is not JSON: `True`",
            "write true",
        ];
    leading_zero:
        pendulum().with("'stiffness': 10", "'stiffness': 010") => [
            "scene.json:16:98: this is not JSON: an incomplete number",
            "write 10 and not 010, 0.5 and not -.5",
        ];
    leading_point:
        pendulum().with("'stiffness': 10", "'stiffness': .5") => [
            "scene.json:16:97: this is not JSON: a number that begins with a point",
            "write 0.5 in place of .5",
        ];
    unquoted_expr:
        pendulum().with("'stiffness': 10", "'stiffness': l*2") => [
            "scene.json:16:97: this is not JSON: text without quotes",
            r#"an expression goes in double quotes, as in "2*l""#,
        ];
    dup_marker_key:
        pendulum().with("'B': ['l/2', 0]", "'A': ['l/2', 0]") => [
            "scene.json:9:40: the key `A` is given twice",
            "keep one of the two",
        ];
    dup_key:
        pendulum().with("'dimension': 2,", "'dimension': 2, 'dimension': 2,") => [
            "scene.json:3:29: the key `dimension` is given twice",
            "keep one of the two",
        ];
    bodies_not_list:
        pendulum().with("'bodies': [", "'bodies': {},  'joints': [] } [") => [
            "scene.json:7:33: this is not JSON: text after the end of the scene",
            "remove it, or check the brackets before",
        ];
    no_bodies:
        pendulum().with("'bodies': [", "'bodies': [], 'joints': [], 'forces': [], 'xodies': [") => [
            "scene.json:12:10: the key `joints` is given twice",
            "keep one of the two",
        ];
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
