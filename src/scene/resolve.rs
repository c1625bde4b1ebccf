//! From the typed file to the checked model.

use super::absolute_beam::BeamLine;
use super::elements::{Elements, Kinds};
use super::format::{Dimension, SceneFile};
use super::kinematics::{self, Named};
use super::model::{Connection, Model, ModelForce, ModelInput, ModelJoint, ModelOutput, Part};
use super::names::check_scene_name;
use super::outputs;
use super::parts::SceneParts;
use super::place::Cut;
use super::{AnyModel, Scene, connections, gravity, inputs, markers, signals, start, states};
use crate::body::{Build, Switches, Turning};
use crate::error::Result;
use crate::math::array::Each;
use crate::math::expression::{Number, Parameters};
use std::path::Path;

/// Resolves all names and expressions of a scene and checks them.
pub fn build(file: SceneFile, elements: &Elements, overrides: &[(String, Number)], folder: &Path) -> Result<Scene> {
    check_scene_name(&file.name)?;
    let mut parameters = markers::resolve(&file.parameters, overrides)?;
    signals::add(&file, folder, &mut parameters)?;
    let (model, held, q, v) = match file.dimension {
        Dimension::Two => models(&file, &elements.planar, &parameters, folder, AnyModel::Planar)?,
        Dimension::Three => models(&file, &elements.spatial, &parameters, folder, AnyModel::Spatial)?,
    };
    Ok(Scene {
        name: file.name,
        about: file.about.unwrap_or_default(),
        references: file.references,
        parameters,
        model,
        held,
        q,
        v,
        hold: file.assembly.hold,
        simulation: file.simulation,
        methods: elements.methods.clone(),
        fingerprint: String::new(),
    })
}

/// The model, what [`Scene::held`] is, and the initial q and v.
type ResolvedModels = (AnyModel, [Option<Box<AnyModel>>; 2], Vec<f64>, Vec<f64>);

fn models<const D: usize>(
    file: &SceneFile,
    kinds: &Kinds<D>,
    parameters: &Parameters,
    folder: &Path,
    any: fn(Model<D>) -> AnyModel,
) -> Result<ResolvedModels> {
    let (own, q, v, rows) = model(file, kinds, parameters, folder)?;
    let with = |rows: Vec<_>| {
        let more = (!rows.is_empty()).then(|| model(file, kinds, parameters, folder));
        let add = |(mut model, ..): (Model<D>, _, _, _)| {
            model.joints.extend(rows);
            Box::new(any(model))
        };
        more.transpose().map(|more| more.map(add))
    };
    let [coordinates, rates] = rows;
    let held = [with(coordinates)?, with(rates)?];
    Ok((any(own), held, q, v))
}

/// Rows that hold the coordinates of joints, and rows that hold their rates.
type Held<const D: usize> = [Vec<ModelJoint<D>>; 2];

/// The model with its initial q and v, and the rows of `initial`. Bodies are read first, so that joints, forces and
/// outputs can name their markers.
fn model<const D: usize>(
    file: &SceneFile,
    kinds: &Kinds<D>,
    parameters: &Parameters,
    folder: &Path,
) -> Result<(Model<D>, Vec<f64>, Vec<f64>, Held<D>)> {
    let (markers, switches, turnings) = Default::default();
    let gravity = [0.0; D];
    let mut build = Build {
        parameters,
        markers: &markers,
        outputs: &(),
        gravity,
        folder,
        switches: &switches,
        turnings: &turnings,
    };
    build.gravity = gravity::uniform(&file.gravity, &build)?;
    let gravity = build.gravity;
    let mut parts = SceneParts::collect(file, &kinds.bodies, &build)?;
    outputs::check_names(&file.outputs)?;
    states::place(&file.states, &file.outputs, &mut parts, &build)?;
    let named = Named { file, elements: Default::default() };
    let build = Build { markers: &parts.table, outputs: &named, ..build };
    let links = Links::read(&named, kinds, &parts, &build)?;
    let held = start::rows(&file.initial, &links.joints, &build)?;
    let (model, q, v) = joined(parts, links, gravity, switches.into_inner(), turnings.into_inner());
    Ok((model, q, v, held))
}

/// Joints, forces, outputs and inputs: all that names markers.
struct Links<const D: usize> {
    joints: Vec<ModelJoint<D>>,
    forces: Vec<ModelForce<D>>,
    outputs: Vec<ModelOutput>,
    works: Vec<ModelOutput>,
    cuts: Vec<Cut<D>>,
    inputs: Vec<ModelInput>,
}

impl<const D: usize> Links<D> {
    fn read(named: &Named<D>, kinds: &Kinds<D>, parts: &SceneParts<D>, build: &Build<D>) -> Result<Self> {
        let file = named.file;
        let mut joints = connections::joints(named, &kinds.joints, build)?;
        let mut forces = connections::forces(named, &kinds.forces, build)?;
        forces.extend(parts.beams.iter().flat_map(|beam| line_elements(beam, &parts.bodies)));
        let inputs = inputs::inputs(&file.inputs, &mut joints, &mut forces, build)?;
        forces.extend(gravity::central(&file.gravity, parts, build)?);
        forces.extend(states::rates(&file.states, build)?);
        let SceneParts { bodies, beams, .. } = parts;
        let placed = &named.elements.borrow();
        let elements = kinematics::Elements { bodies, beams, joints: &joints, forces: &forces, placed };
        let (outputs, works, cuts) = outputs::outputs(&file.outputs, elements, build)?;
        Ok(Links { joints, forces, outputs, works, cuts, inputs })
    }
}

/// The elements of an absolute beam, between its nodes.
fn line_elements<const D: usize>(beam: &BeamLine, bodies: &[Part<D>]) -> impl Iterator<Item = ModelForce<D>> {
    beam.elements.iter().enumerate().map(|(i, element)| Connection {
        name: format!("{}.e{i}", beam.name),
        kind: "beam",
        element: Box::new(element.clone()) as _,
        markers: [0, 1].each(|k| bodies[beam.first_body + i + k].first_marker).to_vec(),
    })
}

/// The model, with the initial q and v.
fn joined<const D: usize>(
    parts: SceneParts<D>,
    links: Links<D>,
    gravity: [f64; D],
    switches: Switches,
    turnings: Vec<Turning>,
) -> (Model<D>, Vec<f64>, Vec<f64>) {
    let SceneParts { table: markers, ground, bodies, beams, mut q, v, .. } = parts;
    let Links { joints, forces, outputs, works, cuts, inputs } = links;
    let states = markers.states.len();
    let extent = extent(&bodies, &q);
    q.extend(turnings.iter().map(|turning| turning.start));
    let model = Model {
        gravity,
        markers,
        ground,
        bodies,
        joints,
        forces,
        beams,
        outputs,
        works,
        cuts,
        inputs,
        states,
        switches,
        turnings,
        extent,
    };
    (model, q, v)
}

/// The largest coordinate of position, m.
fn extent<const D: usize>(bodies: &[Part<D>], q: &[f64]) -> f64 {
    let positions = bodies.iter().flat_map(|part| {
        let names = part.facts.coordinate_names.iter().zip(&q[part.first_q..]);
        names.filter(|(name, _)| ["x", "y", "z"].contains(&name.as_str())).map(|(_, x)| x.abs()).collect::<Vec<_>>()
    });
    positions.fold(0.0, f64::max)
}
