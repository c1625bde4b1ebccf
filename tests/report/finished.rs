//! Runs that are read back.

use crate::scenes::parse;
use holonom::report::FinishedRun;
use std::fmt::Write;

/// 150,000 rows of two columns are more than are kept.
#[test]
fn long_tables_are_thinned_as_they_are_read() {
    let scene = parse(
        r#"{ "name": "mass", "dimension": 2, "bodies": [{ "name": "p", "type": "point_mass", "mass": 1 }],
            "outputs": [{ "name": "x", "measure": "position", "of": "p", "component": "x" }] }"#,
    );
    let mut text = "t,x\n".to_string();
    for row in 0..150_000 {
        let x = if row == 77_777 { 2.0 } else { (0.1 * f64::from(row)).sin() };
        writeln!(text, "{row},{x}").unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("trajectory.csv"), text).unwrap();
    let summary = r#"{ "parameters": {}, "failure": null, "files": ["trajectory.csv", "summary.json"],
        "drift": { "position": { "relative_max": 0 } }, "energy": null }"#;
    std::fs::write(folder.path().join("summary.json"), summary).unwrap();
    let rows = |is_thinned| {
        let run = FinishedRun::read(folder.path(), is_thinned).unwrap();
        run.trajectory(scene.system()).unwrap().rows
    };
    let all = rows(false);
    assert_eq!(all.len(), 150_000);
    let few = rows(true);
    assert!(few.len() < 120_000 && few.contains(&vec![77_777.0, 2.0]), "{}", few.len());
    assert_eq!([few.first(), few.last()], [all.first(), all.last()]);
}
