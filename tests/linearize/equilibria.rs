//! Every method at the equilibria of the references.

use crate::linearize::models::{at, counts, held_roots, model, values};
use crate::linearize::reference::{distance, spectrum};
use holonom::linearize::{Complex, Kind};

/// With the number of constraints.
const EQUILIBRIA: [(&str, usize); 3] = [("two_mass_eq", 1), ("four_bar_S1", 3), ("andrews_E1", 6)];

/// The solvers reach 1e-13 on these pencils; 1e-11 leaves two digits.
#[test]
fn descriptor_forms_have_the_physical_pair_and_their_infinite_values() {
    // Form, infinite values and zeros for each constraint.
    let forms = [("index3", 3, 0), ("index2", 2, 1), ("index1", 1, 2), ("ggl", 4, 0)];
    for (label, m) in EQUILIBRIA {
        at(label, |variation, reference| {
            let known = spectrum(&reference.0["covariant"]["eigenvalues"]);
            for (form, infinite, zeros) in forms {
                for solver in ["null_space", "gsvd", "qz"] {
                    let found = model(variation, &format!("rcs:form={form},solver={solver}"), None);
                    let off = distance(&values(&found, Kind::Physical), &known);
                    let spurious = values(&found, Kind::Spurious);
                    let largest = spurious.iter().map(|x| x.norm()).fold(0.0, f64::max) / known[0].norm();
                    println!("{label} {form} {solver}: physical {off:.1e}, zeros {largest:.1e}");
                    assert!(off < 1e-11, "{label} {form} {solver}: {off:e}");
                    assert_eq!(counts(&found), [2, zeros * m, infinite * m], "{label} {form} {solver}");
                    // Zeros of index 1 come in Jordan blocks of size 2: rounding moves them by its square root.
                    assert!(largest < 1e-5, "{label} {form} {solver}: {spurious:?}");
                }
            }
        });
    }
}

/// Gains whose two roots differ, and are not physical values: eigenvalues then are as good as their condition, 1e-12 here.
#[test]
fn held_constraints_add_the_roots_of_their_own_equation() {
    for (label, m) in EQUILIBRIA {
        at(label, |variation, reference| {
            let known = spectrum(&reference.0["covariant"]["eigenvalues"]);
            for (alpha, beta) in [(1.0, 3.0), (5.0, 50.0), (100.0, 1000.0)] {
                for name in ["baumgarte", "force_projection"] {
                    let found = model(variation, &format!("{name}:alpha={alpha},beta={beta}"), None);
                    assert_eq!(counts(&found), [2, 2 * m, 0], "{label} {name}");
                    let physical = distance(&values(&found, Kind::Physical), &known);
                    let roots = held_roots(2.0 * alpha, beta * beta, m);
                    let spurious = distance(&values(&found, Kind::Spurious), &roots);
                    println!("{label} {name} {alpha} {beta}: physical {physical:.1e} spurious {spurious:.1e}");
                    assert!(physical < 1e-9 && spurious < 1e-9, "{label} {name}: {physical:e} {spurious:e}");
                }
            }
        });
    }
}

/// Critical gains make 2 m equal roots in Jordan blocks of size 2, which rounding spreads by the root of 1e-16 times the
/// norm of the matrix; the physical pair stays exact. Without gains force projection has 2 m zeros.
#[test]
fn defaults_have_a_defective_root() {
    for (label, m) in EQUILIBRIA {
        at(label, |variation, reference| {
            let known = spectrum(&reference.0["covariant"]["eigenvalues"]);
            for (method, root) in [("baumgarte", -5.0), ("force_projection", 0.0)] {
                let found = model(variation, method, None);
                let physical = distance(&values(&found, Kind::Physical), &known);
                let spurious = values(&found, Kind::Spurious);
                let spread = spurious.iter().map(|x| (x - Complex::from(root)).norm()).fold(0.0, f64::max);
                println!("{label} {method}: physical {physical:.1e} spread {spread:.1e}");
                assert_eq!(spurious.len(), 2 * m, "{label} {method}");
                assert!(physical < 1e-9, "{label} {method}: {physical:e}");
                assert!(spread < 1e-6 * known[0].norm().max(5.0), "{label} {method}: {spread:e}");
            }
        });
    }
}

/// On the changes that the constraints allow nothing spurious is left, whatever the gains.
#[test]
fn projected_methods_have_the_physical_pair_only() {
    for (label, _) in EQUILIBRIA {
        at(label, |variation, reference| {
            let known = spectrum(&reference.0["covariant"]["eigenvalues"]);
            for method in [
                "mcs",
                "baumgarte:projected=yes",
                "baumgarte:alpha=1e4,projected=yes",
                "force_projection:projected=yes",
            ] {
                let found = model(variation, method, None);
                let off = distance(&values(&found, Kind::Physical), &known);
                println!("{label} {method}: {off:.1e}");
                assert_eq!(counts(&found), [2, 0, 0], "{label} {method}");
                assert!(off < 1e-11, "{label} {method}: {off:e}");
            }
        });
    }
}

/// What tells spurious modes: physical ones stay on the directions that the constraints allow, to rounding or to the
/// error of the penalty; spurious ones are far off them.
#[test]
fn spurious_modes_are_far_off_the_constraints() {
    let methods = [
        ("baumgarte:alpha=5,beta=50", 1e-9),
        ("force_projection:alpha=5,beta=50", 1e-9),
        ("penalty", 1e-3),
        ("augmented_lagrangian", 1e-6),
    ];
    for (label, _) in EQUILIBRIA {
        at(label, |variation, _| {
            for (method, most) in methods {
                let [physical, spurious] = model(variation, method, None).cost.off_constraints.unwrap();
                println!("{label} {method}: {physical:.1e} {spurious:.2}");
                assert!(physical < most && spurious > 0.2, "{label} {method}: {physical:e} {spurious}");
            }
        });
    }
}

/// A penalty that is too weak to hold anything leaves no gap between motions on and off the constraints.
#[test]
fn modes_without_a_gap_are_uncertain() {
    let mut doubtful = 0;
    for (label, _) in EQUILIBRIA {
        at(label, |variation, _| {
            for penalty in ["1e-3", "1e-2", "0.1", "1", "1e6"] {
                let found = model(variation, &format!("penalty:penalty={penalty}"), None);
                let [physical, spurious] = found.cost.off_constraints.unwrap();
                let uncertain = values(&found, Kind::Uncertain).len();
                println!("{label} {penalty}: {physical:.1e} {spurious:.2} {uncertain}");
                assert_eq!(uncertain > 0, spurious < 2.0 * physical, "{label} {penalty}: {physical} {spurious}");
                assert!(penalty != "1e6" || uncertain == 0, "{label}");
                doubtful += usize::from(uncertain > 0);
            }
        });
    }
    assert!(doubtful > 0);
}
