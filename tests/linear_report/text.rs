//! A linear model in a terminal.

use super::sample::{complex, descriptor, empty, plain, prepared};
use holonom::linearize::{Kind, LinearModel, Mode};
use holonom::report::linear::NamedModel;

fn text(model: &LinearModel) -> String {
    let prepared = prepared("four_bar_spring");
    let names = prepared.system().facts().names.clone();
    NamedModel { scene: &prepared.name, names: &names, model }.text()
}

fn mode(re: f64, im: f64, kind: Kind) -> Mode {
    Mode {
        value: complex(re, im),
        kind,
        shape: Vec::new(),
        participation: vec![0.5, 0.5],
        energy: vec![],
        mass: 1.0,
        outputs: vec![],
        rounding: 0.0,
        error: 0.0,
        condition: 1.0,
    }
}

#[test]
fn pairs_stand_on_one_line_and_infinite_ones_are_counted() {
    let mut model = descriptor(&prepared("four_bar_spring"));
    model.modes[0].value = complex(-0.25, 4.99375);
    model.modes[1].value = complex(-0.25, -4.99375);
    (0..2).for_each(|i| model.modes[i].energy = vec![1.0]);
    let text = text(&model);
    let lines: Vec<&str> = text.lines().collect();
    assert!(
        lines[0].starts_with("four_bar_spring at t = 0 s: linear model by rcs:form=index2, E x' = A x + B u, 2 states")
    );
    let row = |start: &str| lines.iter().find(|line| line.trim_start().starts_with(start)).unwrap().split_whitespace();
    assert_eq!(
        row("1 ").collect::<Vec<_>>(),
        ["1", "-0.25", "+-4.99375", "0.79578", "0.05", "physical", "crank", "100"]
    );
    assert_eq!(row("2 ").take(6).collect::<Vec<_>>(), ["2", "-5", "+-1", "0.81153", "0.9806", "spurious"]);
    assert_eq!(row("3 ").take(6).collect::<Vec<_>>(), ["3", "-7", "0", "1.1141", "1", "spurious"]);
    assert!(text.ends_with("  4 infinite: algebraic equations of the descriptor form\n"), "{text}");
    assert!(!text.contains("NaN") && !text.contains("inf "), "{text}");
}

#[test]
fn charts_are_explained_off_equilibrium() {
    let mut model = plain(&prepared("four_bar_spring"));
    let mut says = |chart: &str, is_equilibrium: bool, part: &str| {
        (model.chart, model.point.is_equilibrium) = (chart.to_string(), is_equilibrium);
        let text = text(&model);
        assert!(text.contains(part), "{text}");
    };
    says("intrinsic", false, "depend on no choice of coordinates");
    says("mass_orthogonal", false, "belong to this choice");
    says("frozen", false, "one answer among many");
    says("crank.angle", false, "chart crank.angle: perturbations counted in this independent coordinate;");
    says("a.x,b.y", false, "these independent coordinates");
    says("intrinsic", false, "not an equilibrium: |v| 1, |v'| ");
    says("intrinsic", true, "at an equilibrium all charts have the same eigenvalues");
    says("intrinsic", true, "an equilibrium: v = 0, v' = 0; |phi| 1.5e-16, |phi'| 2.0e-15");
}

#[test]
fn many_modes_are_cut_and_none_is_said() {
    let mut model = plain(&prepared("four_bar_spring"));
    model.modes = (0..50).map(|k| mode(-1.0 - f64::from(k), 0.0, Kind::Physical)).collect();
    model.modes.extend((0..15).map(|k| mode(-100.0 - f64::from(k), 0.0, Kind::Spurious)));
    let long = text(&model);
    assert!(
        long.lines().count() < 50 && long.contains("20 more physical") && long.contains("5 more spurious"),
        "{long}"
    );
    // Numbers count all modes.
    assert!(long.lines().any(|line| line.trim_start().starts_with("51 ") && line.contains("-100")), "{long}");
    let none = text(&empty(&prepared("four_bar_spring")));
    assert!(none.contains("0 states, 1 input, 2 outputs") && none.contains("no finite eigenvalues"), "{none}");
}

#[test]
fn bodies_move_with_all_their_directions() {
    let mut model = plain(&prepared("four_bar_spring"));
    model.modes[0].energy = vec![0.2, 0.3, 0.0, 0.24, 0.0, 0.0, 0.15, 0.0, 0.11];
    assert!(text(&model).contains("crank 50, rocker 26, coupler 24\n"), "{}", text(&model));
}
