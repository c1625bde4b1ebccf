//! Links without mass: M is singular, the saddle-point matrix is not. The same motion as on rods.

use crate::common::{fixed, stepwise, until};
use crate::scenes::{Ready, dop853, parse};
use holonom::simulate::Method;

const END: f64 = 1.0;

/// A pendulum of point masses, level at first, its frame turned about z.
struct Pendulum {
    dimension: usize,
    /// Length and mass of each link's end.
    links: &'static [(f64, f64)],
    turned: f64,
}

impl Pendulum {
    fn vector(&self, x: f64, y: f64) -> String {
        if self.dimension == 2 { format!("[{x:e}, {y:e}]") } else { format!("[{x:e}, {y:e}, 0]") }
    }

    /// LociVariable the pendulum from its hinge.
    fn along(&self, distance: f64) -> String {
        self.vector(distance * self.turned.cos(), distance * self.turned.sin())
    }

    /// On links without mass, each on a hinge and with a ball at its end, or on rods.
    fn scene(&self, has_links: bool) -> Ready {
        let mut bodies = Vec::new();
        let mut joints = Vec::new();
        let mut at = 0.0;
        let mut hinge = "ground.O".to_string();
        let mut support = "ground.O".to_string();
        let (inertia, rotation, ball) = match self.dimension {
            2 => ("0", format!("\"angle\": {:e}", self.turned), "revolute"),
            _ => ("[0, 0, 0]", format!("\"rotation\": [0, 0, {:e}]", self.turned), "spherical"),
        };
        for (k, (length, mass)) in self.links.iter().enumerate() {
            let start = self.along(at);
            let zero = self.vector(0.0, 0.0);
            let end = self.vector(*length, 0.0);
            at += length;
            bodies.push(format!(
                r#"{{"name": "bob{k}", "type": "point_mass", "mass": {mass:e}, "markers": {{"P": {zero}}},
                    "initial": {{"position": {}}}}}"#,
                self.along(at)
            ));
            if !has_links {
                joints.push(format!(
                    r#"{{"name": "rod{k}", "type": "distance", "between": ["{support}", "bob{k}.P"], "length": {length:e}}}"#
                ));
                support = format!("bob{k}.P");
                continue;
            }
            bodies.push(format!(
                r#"{{"name": "link{k}", "type": "rigid", "mass": 0, "inertia": {inertia},
                    "markers": {{"O": {zero}, "P": {end}}}, "initial": {{"position": {start}, {rotation}}}}}"#
            ));
            joints.push(format!(
                r#"{{"name": "hinge{k}", "type": "revolute", "between": ["{hinge}", "link{k}.O"]}},
                   {{"name": "ball{k}", "type": "{ball}", "between": ["link{k}.P", "bob{k}.P"]}}"#
            ));
            hinge = format!("link{k}.P");
        }
        let origin = self.vector(0.0, 0.0);
        let gravity = self.vector(9.81 * self.turned.sin(), -9.81 * self.turned.cos());
        parse(&format!(
            r#"{{"name": "pendulum", "about": "", "dimension": {}, "gravity": {gravity},
                "ground": {{"markers": {{"O": {origin}}}}}, "bodies": [{}], "joints": [{}],
                "simulation": {{"t_end": {END}}}}}"#,
            self.dimension,
            bodies.join(","),
            joints.join(",")
        ))
    }

    /// Largest error of the last mass over its distance from the hinge, and the steps tried.
    fn error(&self, exact: &[f64; 2], method: &Method) -> (f64, u64) {
        let run = self.scene(true).run(method, until(END));
        let size = self.links.iter().map(|(length, _)| length).sum::<f64>();
        let errors = self.ends().into_iter().zip(exact).map(|(name, exact)| {
            let found = *run.column(&name).last().unwrap();
            (found - exact).abs() / size
        });
        (errors.fold(0.0, f64::max), run.outcome.statistics.steps + run.outcome.statistics.rejected)
    }

    fn ends(&self) -> [String; 2] {
        ["x", "y"].map(|axis| format!("bob{}.{axis}", self.links.len() - 1))
    }
}

const PENDULUMS: [Pendulum; 7] = [
    Pendulum { dimension: 2, links: &[(1.0, 1.0)], turned: 0.0 },
    Pendulum { dimension: 3, links: &[(1.0, 1.0)], turned: 0.0 },
    Pendulum { dimension: 3, links: &[(1.0, 1.0)], turned: 1e-3 },
    Pendulum { dimension: 3, links: &[(0.3, 1e-3)], turned: 2.0 },
    Pendulum { dimension: 2, links: &[(40.0, 250.0)], turned: -0.7 },
    Pendulum { dimension: 2, links: &[(0.7, 1.0), (0.4, 0.3)], turned: 0.0 },
    Pendulum { dimension: 3, links: &[(0.7, 1.0), (0.4, 0.3)], turned: 0.5 },
];

const IMPLICIT: [(&str, &[&str]); 5] = [
    ("radau_iia", &["index1", "index2", "index3", "ggl"]),
    ("generalized_alpha", &["index3", "ggl"]),
    ("bdf", &["index1", "ggl"]),
    ("tr_bdf2", &["index1", "ggl"]),
    ("esdirk34", &["index1", "ggl"]),
];

/// Explicit methods, whose saddle-point matrix is regular, and implicit ones, whose matrix has h^2 K where there is no mass.
#[test]
fn links_without_mass_swing_as_rods_do() {
    let tolerance = 1e-6;
    for pendulum in &PENDULUMS {
        let rods = pendulum.scene(false).run(&dop853(1e-13), until(END));
        let exact = pendulum.ends().map(|name| *rods.column(&name).last().unwrap());
        let check = |method: &Method, most: f64, most_steps: u64| {
            let (error, steps) = pendulum.error(&exact, method);
            let dimension = pendulum.dimension;
            let links = pendulum.links;
            let triple = method.triple();
            println!("{dimension} {links:?} {triple} {:?}: {error:e} in {steps}", method.step);
            assert!(error < most && steps <= most_steps, "{dimension} {links:?} {triple}: {error:e} in {steps}");
        };
        check(&dop853(1e-10), 1e-9, 200);
        for (integrator, formulations) in IMPLICIT {
            // Errors gather over the steps, of which methods of order 2 take up to a thousand; generalized-alpha tests q only.
            let (most, steps) = match integrator {
                "radau_iia" => (30.0, 100),
                "generalized_alpha" => (3000.0, 2000),
                _ => (300.0, 2000),
            };
            for formulation in formulations {
                check(&stepwise(formulation, integrator, "none", tolerance), most * tolerance, steps);
            }
        }
        // Of order 5, of which phi of index1 and index2 drifts; of order 2, with (omega h)^2 of 1e-4 at most.
        for (integrator, most) in [("radau_iia", 1e-9), ("generalized_alpha", 1e-3)] {
            let (_, formulations) = IMPLICIT.iter().find(|(name, _)| *name == integrator).unwrap();
            formulations.iter().for_each(|f| check(&fixed(f, integrator, "none", 2e-3), most, 500));
        }
    }
}
