//! What the tests of scenes share: load, assemble, simulate.
#![allow(dead_code)]

pub mod differences;
pub mod examples;
pub mod random;

use holonom::analysis::{Record, Recorder};
use holonom::initial::Assembly;
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use holonom::simulate::{Method, Outcome, Span, simulate};
use holonom::system::MechanicalSystem;
use std::path::{Path, PathBuf};

/// Every shipped scene.
pub fn models() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let files = std::fs::read_dir(folder).expect("the folder models is there").map(|entry| entry.unwrap().path());
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|end| end == "json") && !is_schema(path);
    let mut scenes: Vec<_> = files.filter(is_scene).collect();
    scenes.sort();
    scenes
}

/// The JSON Schema lies beside the scenes.
fn is_schema(path: &Path) -> bool {
    path.file_stem().is_some_and(|stem| stem.to_string_lossy().contains("schema"))
}

/// The file of a shipped scene.
pub fn model(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(format!("{name}.json"))
}

/// A scene with its consistent start.
pub struct Ready(pub Model);

/// A run that came to its end.
pub struct Run {
    pub record: Record,
    pub outcome: Outcome,
}

/// A shipped scene by name.
pub fn shipped(name: &str, parameters: &[(&str, f64)]) -> Ready {
    load(&model(name), parameters)
}

pub fn load(path: &Path, parameters: &[(&str, f64)]) -> Ready {
    let set = parameters.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    let prepared = Model::load_with(path, &Overrides { set, ..Overrides::default() });
    Ready(prepared.unwrap_or_else(|error| panic!("{error}")))
}

pub fn parse(json: &str) -> Ready {
    let scene = Scene::parse(json, &[]).unwrap_or_else(|error| panic!("{error}\n{json}"));
    Ready(Model::new(scene, &Overrides::default()).unwrap_or_else(|error| panic!("{error}")))
}

/// dop853 on index 1 with manifold projection at one tolerance, relative and absolute.
pub fn dop853(tolerance: f64) -> Method {
    Method { integrator: MethodSpec::named("dop853"), rtol: tolerance, atol: tolerance, ..Method::default() }
}

impl Ready {
    pub fn system(&self) -> &dyn MechanicalSystem {
        self.0.system()
    }

    pub fn start(&self) -> &Assembly {
        &self.0.assembly
    }

    /// As the scene asks.
    pub fn span(&self) -> Span {
        self.0.span().unwrap_or_else(|error| panic!("{}: {error}", self.0.name))
    }

    pub fn run(&self, method: &Method, span: Span) -> Run {
        let mut recorder = Recorder::new(self.system());
        let outcome = simulate(self.system(), method, span, self.0.start(), &mut recorder)
            .unwrap_or_else(|error| panic!("{}: {error}", self.0.name));
        assert_eq!(outcome.failure, None, "{} did not come to its end", self.0.name);
        Run { record: recorder.finish(), outcome }
    }

    /// dop853 at `tolerance` from zero, with rows at the multiples of `output_step`.
    pub fn tight(&self, tolerance: f64, end: f64, output_step: f64) -> Run {
        self.run(&dop853(tolerance), Span { start: 0.0, end, output_step })
    }
}

impl Run {
    pub fn column(&self, heading: &str) -> Vec<f64> {
        let found = self.record.trajectory.column(heading);
        found.unwrap_or_else(|| panic!("no column {heading} among {:?}", self.record.trajectory.headings()))
    }

    pub fn times(&self) -> Vec<f64> {
        self.record.trajectory.times().collect()
    }

    /// Largest |column - expected(t)| over the rows.
    pub fn worst(&self, heading: &str, expected: impl Fn(f64) -> f64) -> f64 {
        let rows = self.times().into_iter().zip(self.column(heading));
        rows.map(|(t, value)| (value - expected(t)).abs()).fold(0.0, f64::max)
    }
}
