//! Errors, dependent rows by name, condition numbers.

use super::samples::{Random, Sample};
use crate::math::kkt::{Pattern, SaddlePoint, Singular, dependent_rows};

#[test]
fn an_undetermined_motion_is_an_error_that_names_the_coordinate() {
    let mut random = Random(9);
    for bodies in [5, 200] {
        let mut sample = Sample::chain(bodies, &mut random);
        sample.mass = Pattern::diagonal(3 * bodies + 1);
        sample.mass_values.push(0.0);
        sample.g.cols += 1;
        let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
        let expected = Err(Singular::Undetermined { coordinate: 3 * bodies });
        assert_eq!(solver.factor(&sample.mass_values, &sample.g_values), expected);
        assert_eq!(
            solver.solve(&mut vec![0.0; 3 * bodies + 1], &mut vec![0.0; 2 * bodies]),
            Err(Singular::NotFactored)
        );
        sample.mass_values[3 * bodies] = 1.0;
        assert_eq!(solver.factor(&sample.mass_values, &sample.g_values), Ok(()));
    }
}

#[test]
fn what_is_not_finite_is_an_error() {
    let mut random = Random(10);
    for sample in [Sample::mechanism(&mut random), Sample::net(18, &mut random)] {
        let (n, m) = sample.sizes();
        let mut solver = SaddlePoint::new(&sample.mass, &sample.g);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for k in [0, 7, sample.g_values.len() - 1] {
                let mut values = sample.g_values.clone();
                values[k] = bad;
                assert_eq!(solver.factor(&sample.mass_values, &values), Err(Singular::NotFinite));
            }
            let mut values = sample.mass_values.clone();
            values[n / 2] = bad;
            assert_eq!(solver.factor(&values, &sample.g_values), Err(Singular::NotFinite));
        }
        solver.factor(&sample.mass_values, &sample.g_values).unwrap();
        let mut top = vec![1.0; n];
        top[3] = f64::NAN;
        assert_eq!(solver.solve(&mut top, &mut vec![0.0; m]), Err(Singular::NotFinite));
        assert_eq!(solver.solve(&mut [0.0], &mut []), Err(Singular::Shape));
        assert_eq!(solver.factor(&[1.0], &[]), Err(Singular::Shape));
    }
}

#[test]
fn dependent_rows_are_named_with_what_they_depend_on() {
    let mut random = Random(18);
    let mut sample = Sample::mechanism(&mut random);
    sample.append(&[(3, 1e6)]);
    sample.append(&[(0, 2.0), (7, -1.0)]);
    sample.append(&[]);
    sample.append(&[(20, 1.0), (8, 1e6)]);
    let found = dependent_rows(&sample.g, &sample.g_values, 1e-10);
    assert_eq!(found.rank, 20);
    assert_eq!(found.rows.iter().map(|r| r.row).collect::<Vec<_>>(), [20, 21, 22, 23]);
    let expected = [vec![(3, 1e6)], vec![(0, 2.0), (7, -1.0)], vec![], vec![(3, 1e6), (8, 1e6)]];
    for (row, expected) in found.rows.iter().zip(expected) {
        assert_eq!(row.combination.len(), expected.len(), "{row:?}");
        for (got, want) in row.combination.iter().zip(expected) {
            assert!(got.0 == want.0 && (got.1 / want.1 - 1.0).abs() < 1e-9, "{row:?}");
        }
    }
}

#[test]
fn condition_numbers() {
    let mut random = Random(19);
    let sample = Sample::chain(110, &mut random);
    let small = Sample::chain(5, &mut random);
    let of = |s: &Sample| SaddlePoint::new(&s.mass, &s.g).condition_number(&s.mass_values, &s.g_values);
    assert!(of(&small) > 1.0 && of(&small) < 1e4);
    let mut scaled = small.clone();
    scaled.g_values.iter_mut().for_each(|v| *v *= 1e6);
    assert!((of(&scaled) / of(&small) - 1.0).abs() < 0.1);
    scaled.append(&[(0, 1.0)]);
    assert_eq!(of(&scaled), f64::INFINITY);
    // Both sides of the switch to iterations, on nearly the same system.
    let longer = Sample::chain(130, &mut Random(19));
    let ratio = of(&longer) / of(&sample);
    assert!(ratio > 0.2 && ratio < 20.0, "{ratio}");
}

#[test]
fn empty_and_misshapen_systems() {
    let mut solver = SaddlePoint::new(&Pattern::default(), &Pattern::default());
    assert_eq!(solver.factor(&[], &[]).and_then(|()| solver.solve(&mut [], &mut [])), Ok(()));
    // Constraints without coordinates, coordinates without mass, no constraints.
    let mut solver = SaddlePoint::new(&Pattern::default(), &Pattern { rows: 2, cols: 0, entries: vec![] });
    let mut bottom = [1.0, 1.0];
    assert_eq!(solver.factor(&[], &[]).and_then(|()| solver.solve(&mut [], &mut bottom)), Ok(()));
    assert!(solver.rank() == 0 && bottom == [0.0, 0.0] && solver.inconsistency() > 1.4);
    let free = Pattern { rows: 0, cols: 2, entries: vec![] };
    let mut solver = SaddlePoint::new(&Pattern::diagonal(2), &free);
    assert_eq!(solver.factor(&[1.0, 0.0], &[]), Err(Singular::Undetermined { coordinate: 1 }));
    assert_eq!(solver.factor(&[1.0, 2.0], &[]), Ok(()));
    // Rows of zeros.
    let mut solver = SaddlePoint::new(&Pattern::diagonal(2), &Pattern::dense(2, 2));
    assert_eq!(solver.factor(&[1.0, 2.0], &[0.0, 0.0, 0.0, 1.0]), Ok(()));
    let mut top = [3.0, 4.0];
    let mut bottom = [0.0, 0.0];
    assert_eq!(solver.solve(&mut top, &mut bottom), Ok(()));
    assert!(solver.rank() == 1 && top == [3.0, 0.0] && bottom == [0.0, 4.0]);
    // M and G of different widths, and an entry outside.
    let outside = Pattern { rows: 1, cols: 2, entries: vec![(0, 2)] };
    for g in [Pattern::dense(1, 3), outside] {
        assert_eq!(SaddlePoint::new(&Pattern::diagonal(2), &g).factor(&[1.0; 2], &[1.0; 3]), Err(Singular::Shape));
    }
}
