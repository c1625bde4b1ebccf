//! Tables and arrays.

use holonom::files::Array;
use holonom::report::{cell, trajectory_arrays};
use holonom::system::{Column, Names};
use holonom::trajectory::Trajectory;

#[test]
fn numbers_are_short_and_come_back() {
    let texts = [0.0, 1.0, 0.5, -20.0, 1e-3, 1e6, 1.5e-7, 0.1 + 0.2].map(cell);
    assert_eq!(texts, ["0", "1", "0.5", "-20", "0.001", "1000000", "1.5e-7", "0.30000000000000004"]);
    assert_eq!([f64::NAN, f64::INFINITY].map(cell), ["", ""]);
    for value in [f64::MAX, f64::MIN_POSITIVE, 5e-324, 1e16, -1e-5, 1e22, 0.1f64.next_up()] {
        assert_eq!(cell(value).parse(), Ok(value));
    }
}

#[test]
fn arrays_are_those_of_the_table() {
    let names = Names { q: vec!["x".into()], v: vec!["x'".into()], lambda: Vec::new() };
    let outputs = vec![Column { name: "φ".into(), unit: "rad".into() }];
    let rows = vec![vec![0.0, 1.0, 2.0, f64::INFINITY], vec![0.5, 0.1, -1e-9, 3.0]];
    let [columns, rows] = trajectory_arrays(&Trajectory { names, outputs, rows }, None).try_into().unwrap();
    assert_eq!(columns, ("columns", Array::Texts(["t", "x", "x'", "φ"].map(String::from).to_vec())));
    let ("rows", Array::Real { shape, values }) = rows else { panic!("{rows:?}") };
    assert_eq!((shape, &values[..3], &values[4..]), (vec![2, 4], &[0.0, 1.0, 2.0][..], &[0.5, 0.1, -1e-9, 3.0][..]));
    assert!(values[3].is_nan());
}
