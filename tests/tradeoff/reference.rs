//! What accuracy is measured against.

use super::{ROWS, filter, fresh, measured, motion, plan, span, watching};
use crate::common::unconstrained::Exponential;
use crate::scenes::shipped;
use holonom::analysis::Sizes;
use holonom::study::work_precision::{GivenValues, Runner, TradeoffPlan};
use holonom::study::{ErrorMetric, Motion, SecondOpinion, Watched};
use holonom::system::Column;

fn column(name: &str, unit: &str) -> Column {
    Column { name: name.to_string(), unit: unit.to_string() }
}

#[test]
fn differences_are_relative_to_the_largest_value() {
    let columns = [column("x", "m"), column("zero", "m"), column("angle", "rad")];
    let own = ErrorMetric::new(&columns, vec![vec![2.0, 0.0, 0.1], vec![-4.0, 0.0, 3.0]], &Sizes::default());
    let rows = vec![vec![2.0, 0.0, 0.1], vec![-4.1, 0.0, 3.0]];
    let (error, worst) = own.error(&rows);
    assert!((error - 0.1 / 4.0).abs() < 1e-15 && worst == "x", "{error} {worst}");
    // What is zero throughout is compared at a thousandth of its kind, so that round-off of it is no error.
    assert!((own.errors(&[vec![2.0, 4e-9, 0.1], vec![-4.0, 0.0, 3.0]])[1] - 1e-6).abs() < 1e-12);
    assert_eq!(own.error(&rows[..1]).0, f64::INFINITY);
    assert!(own.error(&[vec![f64::NAN, 0.0, 0.0], vec![0.0, 0.0, 0.0]]).0.is_nan());
    let (max, rms) = own.spread("x", &[2.0, -3.0]).unwrap();
    assert!((max - 0.25).abs() < 1e-15 && (rms - 0.25 / 2f64.sqrt()).abs() < 1e-15);
}

/// q = exp(sin t), of equations that give no K and C: the second method is then another explicit one.
#[test]
fn equations_of_ones_own_have_a_reference_too() {
    let start = Exponential::exact(0.0);
    let (q, v) = start.split_at(1);
    let motion = Motion {
        system: &Exponential,
        start: (q, v),
        span: span((0.0, 4.0), ROWS),
        watched: Watched::new(&Exponential, &[]).unwrap(),
        ratio: 1.0,
        counts_start: false,
        is_stopped: &|| false,
    };
    let result = measured(motion, &plan(&filter(&["index1"], &["dop853"], &["none"]), 30_000), &[]);
    let reference = result.reference.unwrap();
    assert!(reference.is_independent && reference.error < 1e-10, "{} {:e}", reference.checked_by, reference.error);
    for (row, k) in reference.values.rows.iter().zip(1..) {
        assert!((row[0] - Exponential::exact(4.0 * f64::from(k) / ROWS as f64)[0]).abs() < 1e-11);
    }
}

/// A table with the end only: its values are the reference, and our own run tells how good they are.
#[test]
fn a_table_of_values_is_compared_with() {
    let scene = shipped("two_mass", &[]);
    let motion = motion(&scene, 5.0);
    let exact = 0.1 * 25f64.cos();
    let table = |x1: f64| GivenValues::parse("table", &format!("t, x1, other\n0, 0.1, 0\n5, {x1:.17}, 1\n")).unwrap();
    let measure = |given: GivenValues| {
        let rows = given.parts(0.0, 5.0, ROWS).unwrap();
        assert_eq!(rows, 1);
        let plan =
            TradeoffPlan { given: Some(given), rows, ..plan(&filter(&["index1"], &["dop853"], &["manifold"]), 20_000) };
        let mut result = fresh(&motion);
        result.rows = rows;
        Runner::new(watching(motion.clone(), &["x1"]), &plan, |_, _| ()).run(&mut result).unwrap();
        result
    };
    let good = measure(table(exact));
    let reference = good.reference.as_ref().unwrap();
    assert!(reference.from == "table" && reference.error < 1e-11, "{reference:?}");
    assert!(good.recommend(8).is_some());
    // A wrong table is found out, and vouches for nothing.
    let wrong = measure(table(1.001 * exact));
    assert!((wrong.reference.as_ref().unwrap().error - 1e-3 / 1.001).abs() < 1e-9);
    assert!(wrong.recommend(3).is_none());
}

#[test]
fn tables_that_are_none_are_refused() {
    let problem = |text: &str| GivenValues::parse("table", text).unwrap_err().to_string();
    assert!(problem("x1\n3\n").contains("no column `t`"));
    assert!(problem("t,x1\n0,one\n").contains("`one`, which is no number"));
    assert!(problem("t,x1\n0,nan\n").contains("no number"));
    assert!(problem("t,x1\n0,1,2\n").contains("no table"));
    let early = GivenValues::parse("table", "t,x1\n0,1\n1,2\n").unwrap();
    assert!(early.parts(0.0, 5.0, ROWS).unwrap_err().to_string().contains("no values at the end"));
    assert_eq!(early.names().collect::<Vec<_>>(), ["x1"]);
    let fine = GivenValues::parse("table", "t,x1\n0,1\n0.25,1\n0.5,1\n0.75,1\n1,2\n").unwrap();
    assert_eq!([1, 2, 3, 4, 9].map(|most| fine.parts(0.0, 1.0, most).unwrap()), [1, 2, 2, 4, 4]);
}

#[test]
fn a_run_that_differs_confirms_nothing() {
    let opinion = |difference| {
        let method = "ggl + bdf".to_string();
        SecondOpinion { method, difference: Some(difference), about: "x".to_string() }.to_string()
    };
    assert!(opinion(1e-6).starts_with("confirmed by diffsol"));
    assert!(opinion(2.0).starts_with("not confirmed by diffsol"));
}
