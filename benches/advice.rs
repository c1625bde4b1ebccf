//! Advice over all scenes: `cargo bench --bench advice`, some 20 minutes on two cores; with names, these scenes alone.
//!
//! Each scene is measured as `holonom tradeoff --budget 20s` does it, with three methods more: the scene's own, that of a
//! scene without one, and that of `--method auto` at 3, 6 and 9 digits. From these runs come three tables:
//!
//! - Error over tolerance of each integrator at rtol 1e-3, 1e-6, 1e-9: of motions that do not amplify small changes, which a
//!   tolerance is promised for, and of the others.
//! - By how much each motion amplifies, and the cost of the three at 3, 6, 9 digits over that of the best; a dash where no run came to the digits in the time.
//! - What is recommended, and how far the reference vouches.

use holonom::error::Result;
use holonom::linearize::amplified;
use holonom::measure::work_precision::{
    Cell, Filter, Motion, Outcome, Plan, Runner, Triple, Watched, WorkPrecision, grid,
};
use holonom::report::Table;
use holonom::scene::Automatic;
use holonom::simulate::Method;
use holonom::study::{Overrides, Study};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

const BUDGET: Duration = Duration::from_secs(20);
const DIGITS: [u32; 3] = [3, 6, 9];
/// A motion that makes small changes larger by more than this amplifies errors.
const CALM: f64 = 10.0;
/// So long it may take to see by how much.
const PATIENCE: Duration = Duration::from_secs(5);
/// Scenes at a time: the search for a reference takes several threads of each.
const AT_ONCE: usize = 2;
/// Of each integrator, in the forms that are usual: formulation and projection.
const USUAL: [(&str, &str, &str); 10] = [
    ("radau_iia", "ggl", "none"),
    ("dop853", "index1", "manifold"),
    ("dopri5", "index1", "manifold"),
    ("phem56", "index2", "manifold"),
    ("tr_bdf2", "index1", "none"),
    ("esdirk34", "index1", "none"),
    ("bdf", "index1", "none"),
    ("generalized_alpha", "index3", "none"),
    ("rk4", "index1", "manifold"),
    ("heun", "index1", "manifold"),
];

/// A scene with all that was measured of it.
struct Measured {
    name: String,
    result: WorkPrecision,
    /// The scene's own, without one, auto for each number of digits.
    own: Triple,
    default: Triple,
    auto: Vec<Triple>,
    /// None where it is not known: stiff motions, and those of many degrees of freedom.
    amplification: Option<f64>,
    wall: f64,
}

fn triple(method: &Method) -> Triple {
    let Method { formulation, integrator, projection, .. } = method.clone();
    Triple { formulation, integrator, projection }
}

fn measure(path: &Path) -> Result<Measured> {
    let clock = Instant::now();
    let study = Study::load(path, &Overrides::default())?;
    let auto = |digits: &u32| {
        let rtol = 0.1f64.powi(*digits as i32);
        let overrides = Overrides { method: Some(Automatic::Auto), rtol: Some(rtol), ..Overrides::default() };
        Study::load(path, &overrides).map(|study| triple(&study.method))
    };
    let auto: Vec<Triple> = DIGITS.iter().map(auto).collect::<Result<_>>()?;
    let (own, default) = (triple(&study.method), triple(&Method::default()));
    let mut triples = grid(&Filter::default())?;
    for asked in [&own, &default].into_iter().chain(&auto) {
        if !triples.contains(asked) {
            triples.push(asked.clone());
        }
    }
    let (span, rows) = (study.span()?, 200);
    let plan = Plan { triples, budget: BUDGET, repeats: 3, rows, digits: 6, is_exhaustive: false, given: None };
    let ratio = study.method.atol / study.method.rtol;
    let between = (span.start, span.end);
    let motion = Motion { system: study.system(), start: study.start(), between, ratio, is_stopped: &|| false };
    let mut result = WorkPrecision::fresh(&study.name, between, rows);
    Runner::new(motion, &plan, Watched::new(study.system(), &[])?, |_, _| ()).run(&mut result)?;
    let (name, began) = (study.name.clone(), Instant::now());
    let amplification = amplified(&study, span, |_| began.elapsed() < PATIENCE);
    Ok(Measured { name, result, own, default, auto, amplification, wall: clock.elapsed().as_secs_f64() })
}

impl Measured {
    fn of<'m>(&'m self, triple: &Triple) -> impl Iterator<Item = &'m Cell> {
        let method = triple.at((1.0, 1.0), None);
        self.result.cells.iter().filter(move |cell| cell.is_of(&method))
    }

    /// The cost of the method's cheapest run with the digits, over that of the best.
    fn behind(&self, triple: &Triple, digits: u32) -> Option<f64> {
        let best = self.result.recommend(digits)?.best;
        let good = self.of(triple).filter(|cell| cell.digits() >= Some(f64::from(digits)));
        let cost = good.filter_map(|cell| cell.cost).reduce(f64::min)?;
        Some(cost / self.result.cells[best].cost?)
    }

    fn is_calm(&self) -> bool {
        self.amplification.is_some_and(|factor| factor <= CALM)
    }

    fn failed(&self) -> usize {
        self.result.cells.iter().filter(|cell| matches!(cell.outcome, Outcome::Failed { .. })).count()
    }
}

fn quantile(sorted: &[f64], part: f64) -> String {
    let place = (part * (sorted.len().max(1) - 1) as f64).round() as usize;
    sorted.get(place).map_or("-".to_string(), |value| format!("{value:.2e}"))
}

fn main() {
    let names: Vec<String> = std::env::args().skip(1).filter(|name| !name.starts_with('-')).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let files = std::fs::read_dir(folder).expect("the scenes").filter_map(|file| Some(file.ok()?.path()));
    let stem = |path: &Path| path.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    let is_scene =
        |path: &PathBuf| path.extension().is_some_and(|kind| kind == "json") && !stem(path).ends_with(".schema");
    let is_asked = |path: &PathBuf| names.is_empty() || names.contains(&stem(path));
    let mut scenes: Vec<PathBuf> = files.filter(is_scene).filter(is_asked).collect();
    scenes.sort();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut own = Vec::new();
        while let Some(path) = scenes.get(next.fetch_add(1, Ordering::Relaxed)) {
            let measured = measure(path);
            eprintln!("{:>3} of {}: {}", next.load(Ordering::Relaxed).min(scenes.len()), scenes.len(), stem(path));
            match measured {
                Ok(measured) => own.push(measured),
                Err(error) => println!("{}: {error}", stem(path)),
            }
        }
        own
    };
    let mut all: Vec<Measured> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..AT_ONCE).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap_or_default()).collect()
    });
    all.sort_by(|a, b| a.name.cmp(&b.name));
    println!("error over tolerance: scenes that amplify by at most {CALM}, and the others\n\n{}", errors(&all));
    println!("cost over that of the best at {DIGITS:?} digits\n\n{}", costs(&all));
    let recommended = all.iter().filter(|scene| !scene.result.recommendations().is_empty()).count();
    println!("{recommended} of {} scenes have a recommendation within {} s", scenes.len(), BUDGET.as_secs());
}

fn errors(all: &[Measured]) -> Table {
    let headings =
        ["method", "rtol", "scenes", "median", "90 %", "largest", "amplifying", "median", "failed", "left out"];
    let mut table = Table::new(&headings).words(1);
    for (integrator, formulation, projection) in USUAL {
        for digits in DIGITS {
            let is_meant = |cell: &&Cell| {
                let Method { formulation: f, integrator: i, projection: p, .. } = &cell.method;
                (i.name.as_str(), f.name.as_str(), p.name.as_str()) == (integrator, formulation, projection)
                    && cell.decades == digits
            };
            let cell = |scene: &'_ Measured| scene.result.cells.iter().find(is_meant).cloned();
            let cells: Vec<(bool, Cell)> =
                all.iter().filter_map(|scene| Some((scene.is_calm(), cell(scene)?))).collect();
            let ratios = |is_calm: bool| {
                let over = cells.iter().filter(|(calm, _)| *calm == is_calm).filter_map(|(_, cell)| cell.error());
                let mut ratios: Vec<f64> = over.map(|error| error * 10f64.powi(digits as i32)).collect();
                ratios.sort_by(f64::total_cmp);
                ratios
            };
            let (calm, others) = (ratios(true), ratios(false));
            let failed = cells.iter().filter(|(_, cell)| matches!(cell.outcome, Outcome::Failed { .. })).count();
            table.row(vec![
                format!("{formulation} + {integrator} + {projection}"),
                format!("1e-{digits}"),
                calm.len().to_string(),
                quantile(&calm, 0.5),
                quantile(&calm, 0.9),
                quantile(&calm, 1.0),
                others.len().to_string(),
                quantile(&others, 0.5),
                failed.to_string(),
                (cells.len() - calm.len() - others.len() - failed).to_string(),
            ]);
        }
    }
    table
}

fn costs(all: &[Measured]) -> Table {
    let headings = ["scene", "wall", "amplifies", "reference", "own", "none", "auto", "failed runs", "for 6 digits"];
    let mut table = Table::new(&headings).words(1);
    for scene in all {
        let number = |ratio: Option<f64>| ratio.map_or("-".to_string(), |ratio| format!("{ratio:.2}"));
        let three = |of: &dyn Fn(usize) -> Triple| {
            let ratios = DIGITS.iter().enumerate().map(|(place, digits)| number(scene.behind(&of(place), *digits)));
            ratios.collect::<Vec<_>>().join(" ")
        };
        let best = scene.result.recommend(6).map(|advice| scene.result.cells[advice.best].method.triple());
        table.row(vec![
            scene.name.clone(),
            format!("{:.1} s", scene.wall),
            scene.amplification.map_or("-".to_string(), |factor| format!("{factor:.1e}")),
            scene.result.reference.as_ref().map_or("-".to_string(), |reference| format!("{:.0e}", reference.error)),
            three(&|_| scene.own.clone()),
            three(&|_| scene.default.clone()),
            three(&|place| scene.auto[place].clone()),
            scene.failed().to_string(),
            best.unwrap_or_else(|| "-".to_string()),
        ]);
    }
    table
}
