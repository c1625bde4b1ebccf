//! Advice over all scenes: `cargo bench --bench advice`, some 20 minutes on two cores; with names, these scenes alone.
//!
//! Each scene is measured as `holonom tradeoff --budget 20s` does it (with more time where no reference vouches for six
//! digits in that), with two methods more: the scene's own, and that of a scene without one; then `--method auto` as it
//! runs, changes of method and trials included, at rtol 1e-3 to 1e-12. From these runs come three tables:
//!
//! - Error over tolerance of each integrator at rtol 1e-3, 1e-6, 1e-9: of motions that do not amplify small changes, which a
//!   tolerance is promised for, and of the others. Of rk4 and heun, which have fixed steps and no tolerance, error over
//!   what a step of the sequence is meant for.
//! - By how much each motion amplifies, and the cost of the three at 3, 6, 9 digits over that of the best; a dash where no
//!   run came to the digits in the time.
//! - What is recommended, and how far the reference vouches.

use cpu_time::ThreadTime;
use holonom::analysis::Drift;
use holonom::clock::Stopwatch;
use holonom::error::Result;
use holonom::formulation::Statistics;
use holonom::linearize::amplified;
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::report::TextTable;
use holonom::simulate::{Leg, Method, Observation, Sink, Span, Stop, atol_of, simulate_automatic};
use holonom::study::work_precision::{Cell, Filter, Outcome, Runner, TradeoffPlan, Triple, WorkPrecision, grid};
use holonom::study::{Motion, Watched};
use holonom::system::{MechanicalSystem, Scratch};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

const BUDGET: Duration = Duration::from_secs(20);
/// Where no reference has six digits in that.
const LONG: Duration = Duration::from_secs(120);
const DIGITS: [u32; 3] = [3, 6, 9];
/// One run of auto may take so much CPU time.
const LONGEST: Duration = Duration::from_secs(10);
/// A motion that makes small changes larger by more than this amplifies errors.
const CALM: f64 = 10.0;
/// So long it may take to see by how much.
const PATIENCE: Duration = Duration::from_secs(5);
/// Scenes at a time: the search for a reference takes several threads of each.
const AT_ONCE: usize = 2;
/// Of each integrator, in the forms that are usual: formulation and projection.
const USUAL: [(&str, &str, &str); 11] = [
    ("radau_iia", "ggl", "none"),
    ("dop853", "index1", "manifold"),
    ("dopri5", "index1", "manifold"),
    ("adams", "index1", "manifold"),
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
    /// True if anything could be recommended within the budget, and if a reference vouched for six digits in that.
    is_advised: bool,
    is_quick: bool,
    /// The scene's own, and that without one.
    own: Triple,
    default: Triple,
    auto: Vec<Automatic>,
    /// None where it is not known: stiff motions, and those of many degrees of freedom.
    amplification: Option<f64>,
    wall: f64,
}

/// A run of auto.
struct Automatic {
    digits: u32,
    /// Of legs and trials; where work of a kind has no price, the CPU time.
    cost: f64,
}

fn triple(method: &Method) -> Triple {
    let Method { formulation, integrator, projection, .. } = method.clone();
    Triple { formulation, integrator, projection }
}

fn measure(path: &Path) -> Result<Measured> {
    let clock = Instant::now();
    let prepared = Model::load_with(path, &Overrides::default())?;
    let own = triple(&prepared.method);
    let default = triple(&Method::default());
    let mut triples = grid(&Filter::default())?;
    for asked in [&own, &default] {
        if !triples.contains(asked) {
            triples.push(asked.clone());
        }
    }
    let span = prepared.span()?;
    let rows = 200;
    let watched = Watched::new(prepared.system(), &[])?;
    let within = |budget: Duration| -> Result<WorkPrecision> {
        let motion = Motion::of(&prepared, span, watched.clone(), &|| false);
        let triples = triples.clone();
        let plan =
            TradeoffPlan { triples, budget, repeats: 3, rows, digits: DIGITS[1], is_exhaustive: false, given: None };
        let mut result = WorkPrecision::fresh(&prepared.name, span.start, span.end, rows);
        Runner::new(motion, &plan, |_, _| ()).run(&mut result)?;
        Ok(result)
    };
    let is_enough = |result: &WorkPrecision| {
        result.reference.as_ref().is_some_and(|reference| reference.digits() >= f64::from(DIGITS[1]))
    };
    let quick = within(BUDGET);
    let is_advised = quick.as_ref().is_ok_and(|result| !result.recommendations().is_empty());
    let (result, is_quick) = match quick {
        Ok(result) if is_enough(&result) => (result, true),
        _ => (within(LONG)?, false),
    };
    let span = Span { output_step: (span.end - span.start) / rows as f64, ..span };
    let mut auto = Vec::new();
    for decades in 3..=12 {
        auto.extend(automatic(&prepared, (&result, &watched), span, decades)?);
        if auto.last().is_some_and(|run| run.digits >= DIGITS[2]) {
            break;
        }
    }
    let name = prepared.name.clone();
    let began = Instant::now();
    let amplification = amplified(&prepared, span, |_| began.elapsed() < PATIENCE).ok();
    Ok(Measured {
        name,
        result,
        is_advised,
        is_quick,
        own,
        default,
        auto,
        amplification,
        wall: clock.elapsed().as_secs_f64(),
    })
}

/// Auto at rtol 10^-decades; none where it did not come to its end.
fn automatic(
    prepared: &Model,
    (result, watched): (&WorkPrecision, &Watched),
    span: Span,
    decades: u32,
) -> Result<Option<Automatic>> {
    let rtol = 0.1f64.powi(decades as i32);
    let tolerances = (rtol, atol_of(rtol, prepared.method.atol / prepared.method.rtol));
    let system = prepared.system();
    let rows = Vec::new();
    let drift = Drift::default();
    let scratch = Scratch::default();
    let mut seen =
        Seen { system, watched, scales: system.facts().scales.clone(), scratch, rows, drift, begun: ThreadTime::now() };
    let watch = Stopwatch::start();
    let run = simulate_automatic(system, tolerances, span, prepared.start(), &mut seen);
    let seconds = watch.cpu().as_secs_f64();
    let (outcome, legs, _) = run?;
    let told: Vec<String> =
        legs.iter().map(|leg| format!("{} from {:.2e} s", leg.method.integrator.name, leg.from)).collect();
    let told = format!("{}: auto at 1e-{decades}, {}", prepared.name, told.join(", "));
    let Some(reference) = result.reference.as_ref().filter(|_| outcome.failure.is_none()) else {
        println!("{told}: {}", outcome.failure.map_or(String::new(), |failure| failure.reason));
        return Ok(None);
    };
    let error = reference.values.error(&seen.rows[1..]).0 + reference.error;
    let error = error.max(seen.drift.position.relative_max);
    let cost = cost(result, &legs).unwrap_or(seconds);
    println!("{told}: error {error:.1e}, {cost:.2e} s by counts, {seconds:.2e} s");
    Ok(Some(Automatic { digits: (-error.log10()).floor().max(0.0) as u32, cost }))
}

/// By the prices of the work of each kind; where no explicit run came through, what dop853 did costs as much as the
/// same evaluations and factorizations of radau_iia.
fn cost(result: &WorkPrecision, legs: &[Leg]) -> Option<f64> {
    let mut priced = result.clone();
    let known = priced.cells.len();
    let is_known = |cell: &Cell| cell.is_explicit && cell.method.formulation.name == "index1" && cell.cost.is_some();
    let has_explicit = result.cells.iter().any(is_known);
    for Leg { method, statistics, trials, .. } in legs {
        let own = [(&method.integrator.name, statistics)];
        let tried = trials.iter().map(|trial| (&trial.integrator, &trial.statistics));
        for (integrator, work) in own.into_iter().chain(tried) {
            let is_implicit = ["radau_iia", "bdf"].contains(&integrator.as_str());
            let (formulation, integrator) = match is_implicit {
                true => ("ggl", integrator.as_str()),
                false if has_explicit => ("index1", "dop853"),
                false => ("ggl", "radau_iia"),
            };
            let is_explicit = !is_implicit && has_explicit;
            let formulation = MethodSpec::named(formulation);
            let integrator = MethodSpec::named(integrator);
            priced.cells.push(unpriced(Method { formulation, integrator, ..method.clone() }, is_explicit, *work));
        }
    }
    priced.price();
    let worked = priced.cells[known..].iter().filter(|cell| cell.statistics() != Some(Statistics::default()));
    worked.map(|cell| cell.cost).sum()
}

fn unpriced(method: Method, is_explicit: bool, statistics: Statistics) -> Cell {
    let worst = String::new();
    let drift = (&Drift::default()).into();
    let cpu_seconds = Vec::new();
    let outcome = Outcome::Completed { error: 1.0, worst, drift, cpu_seconds, statistics };
    Cell { method, decades: 0, is_explicit, cost: None, outcome }
}

/// What is compared of a run of auto.
struct Seen<'a> {
    system: &'a dyn MechanicalSystem,
    watched: &'a Watched,
    scales: Vec<f64>,
    scratch: Scratch,
    rows: Vec<Vec<f64>>,
    drift: Drift,
    begun: ThreadTime,
}

impl Sink for Seen<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.drift.add(state, &self.scales);
    }

    fn row(&mut self, state: &Observation) {
        self.rows.push(self.watched.read(self.system, (state.loaded(), state.works), &mut self.scratch));
    }

    fn stops(&self) -> Option<Stop> {
        (self.begun.elapsed() > LONGEST).then(|| Stop::deadline(LONGEST))
    }
}

impl Measured {
    fn of<'m>(&'m self, triple: &Triple) -> impl Iterator<Item = &'m Cell> {
        let method = triple.at(1.0, 1.0, None);
        self.result.cells.iter().filter(move |cell| cell.is_of(&method))
    }

    /// The cost of the method's cheapest run with the digits, over that of the best.
    fn behind(&self, triple: &Triple, digits: u32) -> Option<f64> {
        let best = self.result.recommend(digits)?.best;
        let good = self.of(triple).filter(|cell| cell.digits() >= Some(f64::from(digits)));
        let cost = good.filter_map(|cell| cell.cost).reduce(f64::min)?;
        Some(cost / self.result.cells[best].cost?)
    }

    /// The same of auto.
    fn auto_behind(&self, digits: u32) -> Option<f64> {
        let best = self.result.recommend(digits)?.best;
        let good = self.auto.iter().filter(|run| run.digits >= digits);
        Some(good.map(|run| run.cost).reduce(f64::min)? / self.result.cells[best].cost?)
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
    let count = |is: &dyn Fn(&Measured) -> bool| all.iter().filter(|scene| is(scene)).count();
    let advised = count(&|scene| scene.is_advised);
    let quick = count(&|scene| scene.is_quick);
    println!(
        "{advised} of {} scenes have a recommendation within {} s, {quick} a reference of {} digits",
        scenes.len(),
        BUDGET.as_secs(),
        DIGITS[1]
    );
}

fn errors(all: &[Measured]) -> TextTable {
    let headings =
        ["method", "rtol", "scenes", "median", "90 %", "largest", "amplifying", "median", "failed", "left out"];
    let mut table = TextTable::new(&headings).words(1);
    for (integrator, formulation, projection) in USUAL {
        for digits in DIGITS {
            let is_meant = |cell: &&Cell| {
                let Method { formulation: f, integrator: i, projection: p, .. } = &cell.method;
                (i.name.as_str(), f.name.as_str(), p.name.as_str()) == (integrator, formulation, projection)
                    && cell.decades == digits
            };
            // A reference that is worse than the tolerance tells nothing of the error.
            let judges = |scene: &Measured| {
                scene.result.reference.as_ref().is_some_and(|reference| reference.digits() >= f64::from(digits))
            };
            let cell =
                |scene: &'_ Measured| scene.result.cells.iter().find(is_meant).filter(|_| judges(scene)).cloned();
            let cells: Vec<(bool, Cell)> =
                all.iter().filter_map(|scene| Some((scene.is_calm(), cell(scene)?))).collect();
            let worst =
                all.iter().filter(|scene| scene.is_calm()).filter_map(|scene| Some((cell(scene)?.error()?, scene)));
            let worst = worst.max_by(|a, b| a.0.total_cmp(&b.0)).map_or("", |(_, scene)| &scene.name);
            let ratios = |is_calm: bool| {
                let over = cells.iter().filter(|(calm, _)| *calm == is_calm).filter_map(|(_, cell)| cell.error());
                let mut ratios: Vec<f64> = over.map(|error| error * 10f64.powi(digits as i32)).collect();
                ratios.sort_by(f64::total_cmp);
                ratios
            };
            let calm = ratios(true);
            let others = ratios(false);
            let failed = cells.iter().filter(|(_, cell)| matches!(cell.outcome, Outcome::Failed { .. })).count();
            table.row(vec![
                format!("{formulation} + {integrator} + {projection}"),
                format!("1e-{digits}"),
                calm.len().to_string(),
                quantile(&calm, 0.5),
                quantile(&calm, 0.9),
                format!("{} {worst}", quantile(&calm, 1.0)),
                others.len().to_string(),
                quantile(&others, 0.5),
                failed.to_string(),
                (cells.len() - calm.len() - others.len() - failed).to_string(),
            ]);
        }
    }
    table
}

fn costs(all: &[Measured]) -> TextTable {
    let headings = ["scene", "wall", "amplifies", "reference", "own", "none", "auto", "failed runs", "for 6 digits"];
    let mut table = TextTable::new(&headings).words(1);
    for scene in all {
        let number = |ratio: Option<f64>| ratio.map_or("-".to_string(), |ratio| format!("{ratio:.2}"));
        let three = |of: &dyn Fn(u32) -> Option<f64>| DIGITS.map(|digits| number(of(digits))).join(" ");
        let best = scene.result.recommend(6).map(|advice| scene.result.cells[advice.best].method.triple());
        table.row(vec![
            scene.name.clone(),
            format!("{:.1} s", scene.wall),
            scene.amplification.map_or("-".to_string(), |factor| format!("{factor:.1e}")),
            scene.result.reference.as_ref().map_or("-".to_string(), |reference| format!("{:.0e}", reference.error)),
            three(&|digits| scene.behind(&scene.own, digits)),
            three(&|digits| scene.behind(&scene.default, digits)),
            three(&|digits| scene.auto_behind(digits)),
            scene.failed().to_string(),
            best.unwrap_or_else(|| "-".to_string()),
        ]);
    }
    table
}
