//! Methods of linearization compared on three mechanisms: `cargo bench --bench linear_study`. Single thread.
//!
//! After Gonzalez, Masarati, Cuadrado, Naya, "Assessment of linearization approaches for multibody dynamics formulations",
//! J. Comput. Nonlinear Dyn. 12 (2017), with states of motion besides. Writes `plots/linear_study.md` and its figures;
//! times, which differ from run to run, are printed only.

mod cases;
mod figures;
mod sheet;
mod tables;

#[path = "../../tests/common/mod.rs"]
mod common;
#[path = "../../tests/linearize/systems.rs"]
#[allow(dead_code)]
mod systems;

use cases::cases;
use holonom::plot::Figure;
use sheet::Sheet;
use std::path::{Path, PathBuf};

const ABOUT: &str = "\
# Methods of linearization

Made by `cargo bench --bench linear_study`, which prints times as well. Errors near rounding differ a little between
machines.

Error: largest distance of the physical eigenvalues from the known ones, over the largest of these; `-` where a method
breaks down. At equilibria the known ones have 30 digits. At moving states they are those of the intrinsic frozen operator,
in whose chart methods with `projected=yes` and `mcs` are taken; a raw frozen spectrum there is not inaccurate but another
thing, and depends on the gains.

Off: which part of the worst physical and of the best spurious mode lies off the directions that the constraints allow, in
the metric of the kinetic energy, between 0 and 1. Spurious values: how often in brackets, of a pair both.

Penalties are over the mean of diag(G M^-1 G^T).
";

fn main() {
    let cases = cases();
    let mut sheet = Sheet::new(ABOUT);
    cases.iter().for_each(|case| tables::methods(case, &mut sheet));
    let gains = tables::gains(&cases, &mut sheet);
    let penalties = tables::penalties(&cases, &mut sheet);
    save(&figures::gains(&gains), "linear_study_baumgarte.png");
    save(&figures::penalties(&penalties), "linear_study_penalties.png");
    let path = place("linear_study.md");
    std::fs::write(&path, sheet.text()).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    tables::times(&cases);
}

fn place(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("plots").join(name)
}

fn save(figure: &Figure, name: &str) {
    let bytes = figure.to_png().unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(place(name), bytes).unwrap_or_else(|error| panic!("{error}"));
}
