//! What is compared.

use crate::cases::Case;
use crate::sheet::{Sheet, power};
use holonom::linearize::{Complex, Kind, LinearModel};
use std::time::Instant;

/// With their defaults.
const METHODS: [&str; 16] = [
    "mcs",
    "rcs:form=index3",
    "rcs:form=index2",
    "rcs:form=index1",
    "rcs:form=ggl",
    "rcs:solver=gsvd",
    "rcs:solver=qz",
    "baumgarte",
    "baumgarte:projected=yes",
    "force_projection",
    "force_projection:projected=yes",
    "penalty",
    "penalty:projected=yes",
    "penalty:kind=elastic",
    "augmented_lagrangian",
    "augmented_lagrangian:projected=yes",
];

/// Errors, counts, spurious values, and how well these can be told: |G phi| in the sense of the kinetic energy.
pub fn methods(case: &Case, sheet: &mut Sheet) {
    let mut variation = case.variation();
    let rows: Vec<Vec<String>> = METHODS
        .iter()
        .map(|method| match case.model(&mut variation, method) {
            Some(model) => row(case, method, &model),
            None => std::iter::once(method.to_string()).chain((0..7).map(|_| "-".to_string())).collect(),
        })
        .collect();
    let headings = [
        "method",
        "error",
        "physical",
        "spurious",
        "infinite",
        "spurious values, 1/s",
        "off: physical",
        "off: spurious",
    ];
    sheet.table(&format!("{}: {}", case.name, case.title), &headings, &rows);
}

fn row(case: &Case, method: &str, model: &LinearModel) -> Vec<String> {
    let of = |kind: Kind| model.modes.iter().filter(move |mode| mode.kind == kind);
    let spurious: Vec<Complex<f64>> = of(Kind::Spurious).map(|mode| mode.value).collect();
    let off = model.cost.off_constraints;
    vec![
        method.to_string(),
        power(case.error(model)),
        of(Kind::Physical).count().to_string(),
        spurious.len().to_string(),
        of(Kind::Infinite).count().to_string(),
        clusters(&spurious),
        power(off.map(|[physical, _]| physical)),
        off.map_or("-".to_string(), |[_, spurious]| format!("{spurious:.2}")),
    ]
}

/// Different values with how often they come, the slowest first; three at most, of each pair the upper one.
fn clusters(values: &[Complex<f64>]) -> String {
    let largest = values.iter().map(|value| value.norm()).fold(0.0, f64::max);
    // Members of a defective value lie the root of rounding apart, for large matrices somewhat more.
    let near = 1e-4 * largest.max(1.0);
    let mut sorted: Vec<Complex<f64>> = values.iter().map(|value| Complex::new(value.re, value.im.abs())).collect();
    sorted.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    let mut groups: Vec<(Complex<f64>, usize)> = Vec::new();
    for value in sorted {
        match groups.iter_mut().find(|(known, _)| (known - value).norm() < near) {
            Some((_, count)) => *count += 1,
            None => groups.push((value, 1)),
        }
    }
    let more = groups.len().saturating_sub(3);
    let shown: Vec<String> =
        groups.iter().take(3).map(|(value, count)| format!("{} ({count})", complex(*value, near))).collect();
    let tail = if more > 0 { format!(", {more} more") } else { String::new() };
    format!("{}{tail}", shown.join(", "))
}

/// Four digits; what is only rounding is left out.
fn complex(value: Complex<f64>, rounding: f64) -> String {
    let short = |x: f64| {
        let text = if x.abs() >= 1e5 { format!("{x:.3e}") } else { format!("{x:.4}") };
        if text.contains('e') { text } else { text.trim_end_matches('0').trim_end_matches('.').to_string() }
    };
    let [re, im] = [value.re, value.im].map(|x| if x.abs() < rounding { 0.0 } else { x });
    match (re, im) {
        (re, 0.0) => short(re),
        (0.0, im) => format!("+-{}i", short(im)),
        (re, im) => format!("{} +- {}i", short(re), short(im)),
    }
}

/// A curve for each case: (x, error), only where there is one.
pub struct Curves {
    pub title: String,
    pub lines: Vec<(String, Vec<(f64, f64)>)>,
}

fn curve(case: &Case, values: &[f64], method: impl Fn(f64) -> String) -> (Vec<Option<f64>>, Vec<(f64, f64)>) {
    let errors: Vec<Option<f64>> = values.iter().map(|value| case.error_of(&method(*value))).collect();
    let points = values.iter().zip(&errors).filter_map(|(value, error)| Some((*value, (*error)?))).collect();
    (errors, points)
}

/// Powers of ten, with half powers between for the figures.
fn powers(range: std::ops::RangeInclusive<i32>) -> Vec<f64> {
    range.map(|twice| if twice % 2 == 0 { 10f64.powi(twice / 2) } else { 10f64.powf(f64::from(twice) / 2.0) }).collect()
}

/// A line of the table from the whole powers.
fn line(name: String, errors: &[Option<f64>]) -> Vec<String> {
    std::iter::once(name).chain(errors.iter().step_by(2).map(|error| power(*error))).collect()
}

fn headings(first: &str, values: &[f64]) -> Vec<String> {
    std::iter::once(first.to_string()).chain(values.iter().step_by(2).map(|value| format!("{value:.0e}"))).collect()
}

/// Baumgarte with alpha = beta: raw at equilibria, projected everywhere.
pub fn gains(cases: &[Case], sheet: &mut Sheet) -> Vec<Curves> {
    let values = powers(0..=16);
    let headings = headings("alpha = beta, 1/s", &values);
    let mut found = Vec::new();
    let mut rows = Vec::new();
    for (title, projected) in
        [("at rest, in all coordinates", "no"), ("projected on the changes that the constraints allow", "yes")]
    {
        let mut lines = Vec::new();
        for case in cases.iter().filter(|case| case.is_equilibrium || projected == "yes") {
            let (errors, points) =
                curve(case, &values, |alpha| format!("baumgarte:alpha={alpha},projected={projected}"));
            let kind = if projected == "yes" { "projected" } else { "raw" };
            rows.push(line(format!("{}, {kind}", case.name), &errors));
            lines.push((case.name.to_string(), points));
        }
        found.push(Curves { title: title.to_string(), lines });
    }
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    sheet.table("Baumgarte's gains: error", &headings, &rows);
    found
}

/// Penalty methods: raw at equilibria, projected at moving states.
pub fn penalties(cases: &[Case], sheet: &mut Sheet) -> Vec<Curves> {
    let values = powers(4..=28);
    let headings = headings("penalty", &values);
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let (equilibria, moving): (Vec<&Case>, Vec<&Case>) = cases.iter().partition(|case| case.is_equilibrium);
    let mut found = Vec::new();
    for case in equilibria.into_iter().chain(moving) {
        let projected = if case.is_equilibrium { "no" } else { "yes" };
        let names = [
            ("inertial, N = 1", "penalty:"),
            ("N = 2", "augmented_lagrangian:iterations=2,"),
            ("N = 3", "augmented_lagrangian:iterations=3,"),
            ("N = 4", "augmented_lagrangian:iterations=4,"),
            ("elastic", "penalty:kind=elastic,"),
        ];
        let mut rows = Vec::new();
        let mut lines = Vec::new();
        for (name, method) in names {
            // Springs have no projected form. An empty line keeps one legend for all panels.
            if !case.is_equilibrium && name == "elastic" {
                lines.push((name.to_string(), Vec::new()));
                continue;
            }
            let (errors, points) =
                curve(case, &values, |penalty| format!("{method}penalty={penalty},projected={projected}"));
            rows.push(line(name.to_string(), &errors));
            lines.push((name.to_string(), points));
        }
        let kind = if case.is_equilibrium { "" } else { ", projected" };
        sheet.table(&format!("Penalties, {}{kind}: error", case.name), &headings, &rows);
        found.push(Curves { title: format!("{}{kind}", case.name), lines });
    }
    found
}

/// Of making matrices and eigenvalues, microseconds; the fastest of some runs.
pub fn times(cases: &[Case]) {
    const RUNS: usize = 20;
    println!("\nTime of a model with its eigenvalues, us (these vary)\n");
    println!("{:<36}{}", "", cases.iter().map(|case| format!("{:>15}", case.name)).collect::<String>());
    for method in METHODS {
        let time = |case: &Case| {
            let mut variation = case.variation();
            let run = |_| {
                let clock = Instant::now();
                let found = case.model(&mut variation, method);
                (found.is_some(), clock.elapsed().as_secs_f64())
            };
            let best = (0..RUNS).map(run).filter(|(is_found, _)| *is_found).map(|(_, time)| time);
            1e6 * best.fold(f64::INFINITY, f64::min)
        };
        println!("{method:<36}{}", cases.iter().map(|case| format!("{:>15.0}", time(case))).collect::<String>());
    }
}
