//! The promise alone.

use holonom::analysis::Sizes;
use holonom::simplify::{Norm, Promise};
use holonom::system::Column;

#[test]
fn differences_are_relative_to_what_moves() {
    let columns = [Column { name: "x".to_string(), unit: "m".to_string() }];
    let rows: Vec<Vec<f64>> = [10.0, 12.0, 10.0, 12.0].map(|x| vec![x]).to_vec();
    let other: Vec<Vec<f64>> = [10.0, 12.0, 10.0, 12.4].map(|x| vec![x]).to_vec();
    let promise = |norm| Promise::new(0.1, norm, &columns, rows.clone(), &Sizes::default());
    let near = |x: Option<Vec<f64>>, y: f64| assert!((x.unwrap()[0] - y).abs() < 1e-12);
    near(promise(Norm::Range).errors(&other), 0.2);
    near(promise(Norm::Rms).errors(&other), 0.2);
    assert_eq!(promise(Norm::Range).errors(&other[1..]), None);
}
