//! Signals whose data or name cannot be used.

use crate::errors::{PENDULUM, json, pendulum, refused};
use std::fs;

/// The pendulum with a signal, and an expression that may use it.
fn with_signal(signal: &str, stiffness: &str) -> crate::errors::Scene {
    pendulum()
        .with("'gravity'", &format!("'signals': [{signal}],\n  'gravity'"))
        .with("'stiffness': 10", &format!("'stiffness': '{stiffness}'"))
}

const GAS: &str = "{ 'name': 'gas', 'points': [[0, 'l'], [1, '2*l'], ['3*l', 5]], 'beyond': 'error' }";

cases! {
    unknown_signal: with_signal(GAS, "gass(1)");
    signal_without_argument: with_signal(GAS, "2*gas");
    signal_of_two: with_signal(GAS, "gas(1, 2)");
    constant_beyond: with_signal(GAS, "gas(4)");
    name_of_a_function: with_signal(&GAS.replace("gas", "sin"), "1");
    name_of_a_parameter: with_signal(&GAS.replace("gas", "m"), "1");
    name_of_an_output: with_signal(&GAS.replace("gas", "theta"), "1");
    name_taken: with_signal(&format!("{GAS}, {GAS}"), "1");
    no_data: with_signal("{ 'name': 'gas' }", "1");
    one_point: with_signal("{ 'name': 'gas', 'points': [[0, 1]] }", "1");
    points_out_of_order: with_signal("{ 'name': 'gas', 'points': [[0, 1], ['l', 1], [1, 2]] }", "1");
    bad_point: with_signal("{ 'name': 'gas', 'points': [[0, 1], ['k', 1]] }", "1");
    open_period: with_signal("{ 'name': 'gas', 'points': [[0, 1], [1, 2]], 'beyond': 'repeat' }", "1");
    unknown_interpolation: with_signal("{ 'name': 'gas', 'points': [[0, 1], [1, 2]], 'interpolation': 'cubc' }", "1");
    a_start_beyond: pendulum().with("'gravity'", &format!("'signals': [{GAS}],\n  'gravity'")).force(
        "{ 'name': 'push', 'type': 'applied_torque', 'at': 'rod', 'torque': 'gas(rod.angle - 1)' }");
}

/// One message a file: (its text, the columns, pieces).
#[test]
fn files_that_are_no_signal() {
    let cases: [(&str, &str, &[&str]); 11] = [
        (
            "s,z\n0,1\n1,2\n1,3\n",
            "",
            &["at signals[0].file (`road`): road.csv, line 4: x must increase, found 1 after 1"],
        ),
        ("s;z\n0;1\n\n1;2,5\n", "", &["road.csv, line 4: expected a number in the column `z`, found `2,5`", "point"]),
        ("s\tz\n0\t1\n1\n", "", &["road.csv, line 3: expected a number in the column `z`, found nothing"]),
        ("s,z\n0,1\n", "", &["a signal takes at least 2 points, found 1"]),
        (
            "s,z\n0,1,\n1,5,2,5\n",
            "",
            &["road.csv, line 3: 4 values under 2 names", "decimals are written with a point"],
        ),
        ("0,1\n1,2\n2,3\n", "", &["road.csv: the first line has numbers in the place of names"]),
        ("s\n1\n2\n", "", &["road.csv: expected two columns or more, found 1", "commas, semicolons, tabs or blanks"]),
        ("s,height\n0,1\n1,2\n", "'s', 'heigth'", &["road.csv: there is no column `heigth`", "did you mean `height`?"]),
        ("", "", &["road.csv: expected two columns or more"]),
        (
            "s,z\n0,1\n1,NaN\n",
            "",
            &["road.csv, line 3: expected a number in the column `z`, found `NaN`", "fill the gap"],
        ),
        ("s,z\nm,mm\n0,1\n1,2\n", "", &["road.csv, line 2: the column `z` is in mm", "units of the SI"]),
    ];
    for (table, columns, pieces) in cases {
        let columns = if columns.is_empty() { String::new() } else { format!(", 'columns': [{columns}]") };
        refused_with_table("road.csv", table, &columns, pieces);
    }
    refused_with_table("rod.csv", "s,z\n0,1\n1,2\n", "", &["road.csv: there is no such file; did you mean `rod.csv`?"]);
}

fn refused_with_table(file: &str, table: &str, columns: &str, pieces: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(file), table).unwrap();
    let signal = json(&format!("'signals': [{{ 'name': 'road', 'file': 'road.csv'{columns} }}],\n  'gravity'"));
    let text = PENDULUM.replacen("\"gravity\"", &signal, 1);
    fs::write(folder.path().join("scene.json"), text).unwrap();
    refused(folder.path(), &["check", "scene.json"], pieces);
}
