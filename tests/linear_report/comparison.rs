//! `--method all`.

use super::sample::{complex, descriptor, plain, prepared};
use holonom::linearize::compare;
use holonom::report::linear::comparison_text;

#[test]
fn methods_are_compared_with_a_reference() {
    let prepared = prepared("four_bar_spring");
    let mut one = plain(&prepared);
    let mut two = descriptor(&prepared);
    for model in [&mut one, &mut two] {
        model.modes[0].value = complex(0.0, 4.0);
        model.modes[1].value = complex(0.0, -4.0);
    }
    one.modes[1].value = complex(0.0, -4.004);
    let rows = compare([&one, &two], &[complex(0.0, -4.0), complex(0.0, 4.0)]);
    assert!((rows[0].error.unwrap() - 1e-3).abs() < 1e-12);
    assert_eq!(rows[1].error, Some(0.0));
    assert_eq!((rows[1].physical, rows[1].spurious, rows[1].infinite, rows[1].conditioning), (2, 3, 4, None));
    let text = comparison_text(&rows, true);
    let line: Vec<&str> = text.lines().nth(1).unwrap().split_whitespace().collect();
    assert_eq!(line, ["mcs", "frozen", "1.0e-3", "2", "0", "0", "-", "3.2", "2", "12.3", "4.56"]);
    assert!(!text.contains("inf ") && !text.contains("NaN"));
}

#[test]
fn another_number_of_eigenvalues_has_no_error() {
    let prepared = prepared("four_bar_spring");
    let model = plain(&prepared);
    assert_eq!(compare([&model], &[])[0].error, None);
    assert_eq!(compare([&model], &[complex(0.0, 1.0)])[0].error, None);
}

#[test]
fn zeros_are_measured_against_the_largest() {
    let prepared = prepared("four_bar_spring");
    let mut model = plain(&prepared);
    model.modes[0].value = complex(1e-8, 0.0);
    model.modes[1].value = complex(-100.0, 0.0);
    let error = compare([&model], &[complex(0.0, 0.0), complex(-100.0, 0.0)])[0].error.unwrap();
    assert!((error - 1e-10).abs() < 1e-16, "{error}");
}
