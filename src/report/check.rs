//! The report of `check`.

use super::TextTable;
use super::equilibrium::EquilibriumReport;
use super::hints::hints_text;
use super::table::{OutputValues, count, moves_text};
use crate::analysis::{Rank, Redundant};
use crate::error::{Failure, significant};
use crate::initial::Assembly;
use crate::math::kkt::has_least_norm;
use crate::math::largest;
use crate::prepared::{self, in_either};
use crate::scene::{BeamLine, Model, Part};
use crate::simplify::Hints;
use crate::simulate::{SpectralMode, refused};
use crate::system::{Group, OperatingPoint};
use crate::tolerances;
use serde::Serialize;

/// Size of a model, and its rank and conditioning at the start.
#[derive(Clone, Debug, Serialize)]
pub struct Check {
    scene: String,
    /// 2 in the plane, 3 in space.
    dimension: usize,
    coordinates: usize,
    /// n_v without the states.
    pub velocities: usize,
    pub constraints: usize,
    pub rank: usize,
    /// Rank of G at a nearby state: higher where the start is a singular state.
    rank_beside: usize,
    /// n_v less the rank and the states.
    pub degrees_of_freedom: usize,
    /// Dependent rows of G, with their joints.
    pub redundant: Vec<Redundant>,
    assembly: Assembly,
    start: AssembledStart,
    /// The reason why no simulation begins there.
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<Failure>,
    /// Condition number of the equilibrated saddle-point matrix without the redundant rows.
    condition: f64,
    /// Rank indicator of G: the smallest sine between one of its rows and those before it, in the metric of M^-1,
    /// without redundant rows; 1 is far from a singular state, 0 is one.
    distance_to_singularity: f64,
    /// Largest and smallest entry on the diagonal of M, kg or kg m^2.
    mass_range: [f64; 2],
    /// The fastest mode at the start, 1/s; none without degrees of freedom.
    fastest_mode: Option<SpectralMode>,
    /// Length that drift is relative to, m.
    length_scale: f64,
    bodies: Vec<Element>,
    joints: Vec<Element>,
    forces: Vec<Element>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    states: Vec<Element>,
    /// Quantities that the scene does not ask for and that are not computed.
    left_out: Vec<String>,
    /// What looks superfluous or missing, if it was looked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hints: Option<Hints>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equilibrium: Option<EquilibriumReport>,
}

/// Rates and outputs at the assembled start.
#[derive(Clone, Debug, Serialize)]
struct AssembledStart {
    /// max |v|, m/s and rad/s.
    velocity: f64,
    acceleration: f64,
    /// True if nothing moves or accelerates.
    is_equilibrium: bool,
    outputs: OutputValues,
}

#[derive(Clone, Debug, Serialize)]
struct Element {
    name: String,
    kind: String,
    /// Coordinates of a body, rows of a joint.
    detail: String,
}

impl Element {
    fn new(name: &str, kind: impl Into<String>, detail: impl Into<String>) -> Element {
        Element { name: name.to_string(), kind: kind.into(), detail: detail.into() }
    }
}

pub fn check(prepared: &prepared::Model) -> Check {
    in_either!(&prepared.mechanism, mechanism => inspect(prepared, mechanism.model()))
}

fn inspect<const D: usize>(prepared: &prepared::Model, model: &Model<D>) -> Check {
    let (system, Assembly { q, v, vdot, lambda, .. }) = (prepared.system(), &prepared.assembly);
    let found = Rank::at(system, OperatingPoint { t: prepared.start_time(), q, v, vdot, lambda });
    let n = system.dimensions();
    let names = system.facts().names.lambda.clone();
    let joint = |group: &Group| {
        let rows = names[group.rows.clone()].iter().filter_map(|name| name.rsplit('.').next());
        Element::new(&group.name, &group.kind, rows.collect::<Vec<_>>().join(" "))
    };
    Check {
        scene: prepared.name.clone(),
        dimension: D,
        coordinates: n.q,
        velocities: n.moving(),
        constraints: n.lambda,
        rank: found.rank,
        rank_beside: found.nearby,
        degrees_of_freedom: n.moving() - found.rank,
        redundant: found.redundant,
        assembly: prepared.assembly.clone(),
        start: AssembledStart::of(prepared),
        refused: prepared.span().ok().and_then(|span| refused(system, &prepared.method, span, prepared.start())),
        condition: found.condition,
        distance_to_singularity: found.distance_to_singularity,
        mass_range: found.mass_range,
        fastest_mode: found.fastest_mode,
        length_scale: system.facts().length,
        bodies: bodies(model),
        joints: system.facts().groups().iter().map(joint).collect(),
        forces: model
            .given_forces()
            .iter()
            .map(|force| Element::new(&force.name, force.kind.to_string(), ""))
            .collect(),
        states: model.markers.states.iter().map(|(name, _)| Element::new(name, "state", "")).collect(),
        left_out: left_out(model),
        hints: None,
        equilibrium: None,
    }
}

/// Largest number of coordinate names shown.
const SHOWN_NAMES: usize = 14;

/// Returns the bodies of the scene; the nodes of a flexible beam are listed as one body.
fn bodies<const D: usize>(model: &Model<D>) -> Vec<Element> {
    let item = |(i, part): (usize, &Part<D>)| match model.beams.iter().find(|beam| beam.bodies().contains(&i)) {
        None => Some(body_item(part)),
        Some(beam) => (beam.first_body == i).then(|| beam_item(beam, part)),
    };
    model.given_bodies().iter().enumerate().filter_map(item).collect()
}

fn beam_item<const D: usize>(beam: &BeamLine, node: &Part<D>) -> Element {
    let elements = beam.elements.len();
    let nodes = beam.abscissae.len();
    let detail = format!("{elements} elements, {nodes} nodes of {}", node.facts.coordinate_names.join(" "));
    Element::new(&beam.name, "flexible beam, absolute", detail)
}

fn body_item<const D: usize>(part: &Part<D>) -> Element {
    let kind = match (part.nq, part.nv) {
        (7, 6) => "rigid, quaternion",
        _ if part.facts.elastic_count > 0 => "flexible, floating frame",
        _ if part.facts.oriented => "rigid",
        _ => "point mass",
    };
    let names = &part.facts.coordinate_names;
    let detail = match names.as_slice() {
        [first @ .., last] if names.len() > SHOWN_NAMES => {
            let left_out = first.len() - (SHOWN_NAMES - 2);
            format!("{} ... ({left_out} more) {last}", first[..SHOWN_NAMES - 2].join(" "))
        }
        all => all.join(" "),
    };
    Element::new(&part.name, kind, detail)
}

fn left_out<const D: usize>(model: &Model<D>) -> Vec<String> {
    let central = model.given_forces().iter().filter(|force| force.kind == "gravity").count();
    let gravity = model.gravity.iter().all(|&g| g == 0.0) && central == 0;
    let quaternions = model.given_bodies().iter().all(|part| part.nq == part.nv);
    let driven = model.joints.iter().all(|joint| !joint.element.depends_on_time());
    let is_rigid = model.beams.is_empty() && model.bodies.iter().all(|part| part.facts.elastic_count == 0);
    [
        (gravity, "gravity: none is given"),
        (D == 2, "the third dimension: no z, no quaternion"),
        (D == 3 && quaternions, "quaternions: no body turns freely"),
        (model.joints.is_empty(), "constraints: there is no joint"),
        (driven && !model.joints.is_empty(), "moving constraints: no joint depends on t"),
        (model.given_forces().len() == central, "forces: none is given"),
        (is_rigid, "flexibility: every body is rigid"),
        (true, "contact and friction: the scene has none"),
    ]
    .into_iter()
    .filter(|(absent, _)| *absent)
    .map(|(_, text)| text.to_string())
    .collect()
}

impl Check {
    pub fn text(&self) -> String {
        let mut text = format!(
            "{}: {}, {}, {} of rank {}, {} of freedom\n\n",
            self.scene,
            count(self.coordinates, "coordinate"),
            count(self.velocities, "velocity"),
            count(self.constraints, "constraint"),
            self.rank,
            count(self.degrees_of_freedom, "degree")
        );
        let elements = [
            ("body", "coordinates", &self.bodies),
            ("joint", "rows", &self.joints),
            ("force", "", &self.forces),
            ("state", "", &self.states),
        ];
        for (heading, detail, items) in elements {
            if !items.is_empty() {
                let mut table = TextTable::left(&[heading, "type", detail]);
                items.iter().for_each(|item| table.row([item.name.clone(), item.kind.clone(), item.detail.clone()]));
                text += &format!("{table}\n");
            }
        }
        let rest = self.equilibrium.as_ref().map_or(String::new(), EquilibriumReport::text);
        let hints = self.hints.as_ref().map_or(String::new(), hints_text);
        text + &self.redundancy_text() + &self.start_text() + &self.scales_text() + &hints + &rest
    }

    fn redundancy_text(&self) -> String {
        if self.redundant.is_empty() {
            return String::new();
        }
        let mut text = if self.rank_beside > self.rank {
            format!(
                "the start is a singular state: rank {} here, {} beside it; the branch of the motion is that of its velocity\n\
                 constraints that depend on others here:\n",
                self.rank, self.rank_beside
            )
        } else if has_least_norm(self.redundant.len(), self.rank + self.redundant.len()) {
            String::from("redundant constraints (consistent; multipliers of least norm are computed):\n")
        } else {
            String::from(
                "redundant constraints (consistent; so many that the ones left out get multipliers of zero):\n",
            )
        };
        for row in &self.redundant {
            let cause = match row.follows_from.as_slice() {
                [] => "holds what cannot move: its bodies are on the ground or not `free` there".to_string(),
                rows => format!("follows from {}", rows.join(", ")),
            };
            text += &format!("  joint `{}`, row {}: {cause}\n", row.joint, row.row);
        }
        text + "\n"
    }

    fn start_text(&self) -> String {
        let assembly = &self.assembly;
        let mut text = format!(
            "start: |phi| {:.1e} -> {:.1e}, |phi'| {:.1e} -> {:.1e} (given -> assembled, relative to the scale)\n",
            assembly.before.phi, assembly.after.phi, assembly.before.phi_dot, assembly.after.phi_dot
        );
        text += &moves_text(&assembly.moves);
        let refused = self
            .refused
            .as_ref()
            .map(|Failure { reason, hint, .. }| format!("no simulation begins there: {reason}\n  help: {hint}\n"));
        text + &refused.unwrap_or_default() + &self.start.text()
    }

    fn scales_text(&self) -> String {
        let mode = self.fastest_mode.map_or(String::new(), |mode| format!("the fastest mode {mode}\n"));
        mode + &format!(
            "condition of the saddle-point matrix {}, distance to a singular state {:.1e} (1 is far)\n\
             masses and inertias {:.3e} .. {:.3e}, length scale {} m\nleft out: {}\n",
            if self.condition.is_finite() { format!("{:.1e}", self.condition) } else { "infinite".to_string() },
            self.distance_to_singularity,
            self.mass_range[0],
            self.mass_range[1],
            significant(self.length_scale, 4),
            self.left_out.join("; ")
        )
    }
}

impl AssembledStart {
    fn of(prepared: &prepared::Model) -> AssembledStart {
        let Assembly { q, v, vdot, lambda, .. } = &prepared.assembly;
        let at = OperatingPoint { t: prepared.start_time(), q, v, vdot, lambda };
        let moving = ..prepared.system().dimensions().moving();
        let velocity = largest(&v[moving]);
        let acceleration = largest(&vdot[moving]);
        AssembledStart {
            velocity,
            acceleration,
            is_equilibrium: velocity == 0.0 && largest(vdot) < tolerances::SIX_DIGITS,
            outputs: OutputValues::at(prepared.system(), at),
        }
    }

    fn text(&self) -> String {
        let rest = match (self.is_equilibrium, self.velocity) {
            (true, _) => format!("static equilibrium: at rest, accelerations below {:.1e}\n", self.acceleration),
            (false, 0.0) => {
                format!("at rest, accelerations up to {} m/s^2 or rad/s^2\n", significant(self.acceleration, 4))
            }
            _ => String::new(),
        };
        let outputs = self.outputs.text("output at the start", 8, usize::MAX);
        rest + &outputs + if outputs.is_empty() { "" } else { "\n" }
    }
}
