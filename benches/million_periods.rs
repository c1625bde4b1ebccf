//! A pendulum over a million periods, against its closed form: `cargo bench --bench million_periods`. Writes
//! `plots/million_periods.md` and its figure; all methods at once. Ten minutes on two cores. Numbers as they come, and times,
//! go to standard error.

#[path = "../tests/long_runs/pendulum.rs"]
mod pendulum;

use holonom::method_spec::MethodSpec;
use holonom::plot::{AxisSpec, Figure, Panel, Series, Style};
use holonom::simulate::Method;
use pendulum::{Mark, period, run};
use rayon::prelude::*;
use std::fmt::Write;
use std::path::{Path, PathBuf};

const PERIODS: [f64; 7] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

const ABOUT: &str = "\
# A pendulum over a million periods

Made by `cargo bench --bench million_periods`. A point of 1 kg on a rod of 1 m, amplitude 1 rad, against its period in
closed form, 2 pi sqrt(l/g) / agm(1, cos(1/2)) = 2.139 s. Phase: how far ahead, in periods. Energy: error over what swings,
g l (1 - cos 1) = 4.51 J; for `rattle` the largest so far, which is bounded, else the error at that time. `radau_iia`, at a
millisecond a period, goes to 100,000. Last digits differ between machines.
";

struct Line {
    name: &'static str,
    method: Method,
    /// How many of `PERIODS` it runs to.
    count: usize,
}

fn lines() -> Vec<Line> {
    let line = |name, [formulation, integrator, projection]: [&str; 3], tolerance: f64, step: Option<f64>| {
        let [formulation, integrator, projection] = [formulation, integrator, projection].map(MethodSpec::named);
        let count = PERIODS.len() - usize::from(integrator.name == "radau_iia");
        let method = Method { formulation, integrator, projection, rtol: tolerance, atol: tolerance, step };
        Line { name, method, count }
    };
    vec![
        line("radau_iia, ggl, 1e-10", ["ggl", "radau_iia", "none"], 1e-10, None),
        line("dop853, manifold, 1e-13", ["index1", "dop853", "manifold"], 1e-13, None),
        line("dop853, manifold, 1e-10", ["index1", "dop853", "manifold"], 1e-10, None),
        line("rattle, 50 steps a period", ["index3", "rattle", "none"], 1.0, Some(period() / 50.0)),
    ]
}

fn energy(line: &Line, mark: &Mark) -> f64 {
    if line.method.step.is_some() { mark.largest } else { mark.energy }
}

fn table(title: &str, all: &[(Line, Vec<Mark>)], value: impl Fn(&Line, &Mark) -> f64) -> String {
    let mut text = format!("\n## {title}\n\n| periods |");
    all.iter().for_each(|(line, _)| text += &format!(" {} |", line.name));
    text += &format!("\n|---|{}\n", "---|".repeat(all.len()));
    for (i, periods) in PERIODS.iter().enumerate() {
        let cell = |(line, marks): &(Line, Vec<Mark>)| match marks.get(i) {
            Some(mark) => format!(" {:.2e} |", value(line, mark)),
            None => " |".to_string(),
        };
        let cells = all.iter().map(cell);
        text += &format!("| {periods:.0} |{}\n", cells.collect::<String>());
    }
    text
}

fn work(all: &[(Line, Vec<Mark>)]) -> String {
    let heading = "| method | steps a period | phi, m | phi', m/s |";
    let mut text = format!("\n## Work, and largest drift\n\n{heading}\n|---|---|---|---|\n");
    for (line, mark) in all.iter().filter_map(|(line, marks)| Some((line, marks.last()?))) {
        let Mark { periods, steps, seconds, drift: [position, velocity], .. } = mark;
        eprintln!("{}: {:.0} microseconds a period", line.name, 1e6 * seconds / periods);
        let steps = *steps as f64 / periods;
        // Writing to a string does not fail.
        let _ = writeln!(text, "| {} | {steps:.1} | {position:.0e} | {velocity:.0e} |", line.name);
    }
    text
}

fn panel(title: &str, y: &str, all: &[(Line, Vec<Mark>)], value: impl Fn(&Line, &Mark) -> f64) -> Panel {
    let panel = Panel::new(AxisSpec::from("periods").log(), AxisSpec::from(y).log()).title(title);
    all.iter().fold(panel, |panel, (line, marks)| {
        let points = marks.iter().map(|mark| (mark.periods, value(line, mark).abs())).collect();
        panel.series(Series::line(line.name, points).style(Style::LineDots))
    })
}

fn place(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("plots").join(name)
}

fn main() {
    let measure = |line: Line| {
        let told = |mark: &Mark| eprintln!("{}: {mark:?}", line.name);
        let marks =
            run(&line.method, &PERIODS[..line.count], told).unwrap_or_else(|error| panic!("{}: {error}", line.name));
        (line, marks)
    };
    let lines = lines();
    let threads =
        rayon::ThreadPoolBuilder::new().num_threads(lines.len()).build().unwrap_or_else(|error| panic!("{error}"));
    let all: Vec<(Line, Vec<Mark>)> = threads.install(|| lines.into_par_iter().with_max_len(1).map(measure).collect());
    let phase = table("Phase error, periods", &all, |_, mark| mark.phase);
    let text = format!("{ABOUT}{phase}{}{}", table("Energy error, relative", &all, energy), work(&all));
    println!("{text}");
    std::fs::write(place("million_periods.md"), text).unwrap_or_else(|error| panic!("{error}"));
    let figure = Figure { columns: 2, width: 1000.0, ..Figure::new().title("A pendulum over a million periods") };
    let figure = figure.panel(panel("phase", "error (periods)", &all, |_, mark| mark.phase));
    let figure = figure.panel(panel("energy", "relative error", &all, energy));
    let bytes = figure.to_png().unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(place("million_periods.png"), bytes).unwrap_or_else(|error| panic!("{error}"));
}
