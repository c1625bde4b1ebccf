//! From the typed file to the checked model.

use super::absolute_beam::{AbsoluteBeam, is_absolute_beam};
use super::elements::{Elements, Kinds};
use super::format::{Dimension, SceneFile};
use super::kinematics::Named;
use super::model::{BeamLine, Connection, Input, Model, Part, Watched};
use super::names::{check_name, check_scene_name};
use super::outputs;
use super::place::Cut;
use super::{AnyModel, Scene, connections, gravity, inputs, markers, signals, start, states};
use crate::body::{
    BodyKind, Build, Built, ElementKind, Initial, Marker, MarkerId, MarkerTable, Switches, Turning, parse, show,
};
use crate::error::{Error, Result, suggest};
use crate::force::Force;
use crate::joint::Joint;
use crate::math::array::Each;
use crate::math::expression::{Number, Parameters};
use serde_json::{Map, Value};
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
        fingerprint: String::new(),
    })
}

/// The model, what [`Scene::held`] is, and the initial q and v.
type Models = (AnyModel, [Option<Box<AnyModel>>; 2], Vec<f64>, Vec<f64>);

fn models<const D: usize>(
    file: &SceneFile,
    kinds: &Kinds<D>,
    parameters: &Parameters,
    folder: &Path,
    any: fn(Model<D>) -> AnyModel,
) -> Result<Models> {
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
type Held<const D: usize> = [Vec<Connection<Box<dyn Joint<D>>>>; 2];

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
    let mut parts = Parts::collect(file, &kinds.bodies, &build)?;
    outputs::check_names(&file.outputs)?;
    states::place(&file.states, &file.outputs, &mut parts, &build)?;
    let named = Named { file, elements: Default::default() };
    let build = Build { markers: &parts.table, outputs: &named, ..build };
    let links = Links::read(&named, kinds, &parts, &build)?;
    let held = start::rows(&file.initial, &links.joints, &build)?;
    let (model, q, v) = parts.joined(links, gravity, switches.into_inner(), turnings.into_inner());
    Ok((model, q, v, held))
}

/// Joints, forces, outputs and inputs: all that names markers.
struct Links<const D: usize> {
    joints: Vec<Connection<Box<dyn Joint<D>>>>,
    forces: Vec<Connection<Box<dyn Force<D>>>>,
    outputs: Vec<Watched>,
    works: Vec<Watched>,
    cuts: Vec<Cut<D>>,
    inputs: Vec<Input>,
}

impl<const D: usize> Links<D> {
    fn read(named: &Named<D>, kinds: &Kinds<D>, parts: &Parts<D>, build: &Build<D>) -> Result<Self> {
        let file = named.file;
        let mut joints = connections::joints(named, &kinds.joints, build)?;
        let mut forces = connections::forces(named, &kinds.forces, build)?;
        forces.extend(parts.beams.iter().flat_map(|beam| line_elements(beam, &parts.bodies)));
        let inputs = inputs::inputs(&file.inputs, (&mut joints, &mut forces), build)?;
        forces.extend(gravity::central(&file.gravity, parts, build)?);
        forces.extend(states::rates(&file.states, build)?);
        let Parts { bodies, beams, .. } = parts;
        let placed = &named.elements.borrow();
        let elements = outputs::Elements { bodies, beams, joints: &joints, forces: &forces, placed };
        let (outputs, works, cuts) = outputs::outputs(&file.outputs, elements, build)?;
        Ok(Links { joints, forces, outputs, works, cuts, inputs })
    }
}

/// The elements of an absolute beam, between its nodes.
fn line_elements<const D: usize>(
    beam: &BeamLine,
    bodies: &[Part<D>],
) -> impl Iterator<Item = Connection<Box<dyn Force<D>>>> {
    beam.elements.iter().enumerate().map(|(i, element)| Connection {
        name: format!("{}.e{i}", beam.name),
        kind: "beam",
        element: Box::new(element.clone()) as _,
        markers: [0, 1].each(|k| bodies[beam.first_body + i + k].first_marker).to_vec(),
    })
}

fn extent<const D: usize>(bodies: &[Part<D>], q: &[f64]) -> f64 {
    let positions = bodies.iter().flat_map(|part| {
        let names = part.body.coordinate_names().into_iter().zip(&q[part.first_q..]);
        names.filter(|(name, _)| ["x", "y", "z"].contains(&name.as_str())).map(|(_, x)| x.abs()).collect::<Vec<_>>()
    });
    positions.fold(0.0, f64::max)
}

/// Bodies read so far, with their initial q and v.
pub(super) struct Parts<const D: usize> {
    table: MarkerTable,
    pub ground: Vec<Marker<D>>,
    pub bodies: Vec<Part<D>>,
    pub beams: Vec<BeamLine>,
    q: Vec<f64>,
    v: Vec<f64>,
    /// Index of the next absolute beam's first element among the forces.
    next_force: usize,
}

impl<const D: usize> Parts<D> {
    fn collect(file: &SceneFile, kinds: &[BodyKind<D>], build: &Build<D>) -> Result<Self> {
        if file.bodies.is_empty() {
            return Err(Error::input("the scene has no body")
                .under("bodies")
                .hint("give at least one: nothing else can move"));
        }
        let ground = markers::markers(&file.ground.markers, &[0.0; D], build).map_err(|error| error.under("ground"))?;
        build.switches.borrow_mut().own("the ground");
        let mut parts = Parts::new(ground, file.forces.len());
        // Copies, here and of joints and forces: a file freed piece by piece, among what stays, scatters the memory of
        // all that follows, which then takes twice as long in scenes of 10 000 loops.
        for (i, json) in file.bodies.iter().enumerate() {
            parts.add(json.clone(), kinds, build).map_err(|error| error.under(format!("bodies[{i}]")))?;
        }
        Ok(parts)
    }

    fn new(ground: Vec<(String, Marker<D>)>, next_force: usize) -> Self {
        let mut parts = Parts {
            table: MarkerTable::default(),
            ground: Vec::new(),
            bodies: Vec::new(),
            beams: Vec::new(),
            q: Vec::new(),
            v: Vec::new(),
            next_force,
        };
        parts.table.add("ground".to_string(), None, true);
        parts.ground.push(Marker::point([0.0; D]));
        for (name, marker) in ground {
            parts.table.add(format!("ground.{name}"), None, true);
            parts.ground.push(marker);
        }
        parts
    }

    fn add(&mut self, json: Value, kinds: &[BodyKind<D>], build: &Build<D>) -> Result<()> {
        let mut json = object(json)?;
        let name = take_name(&mut json)?;
        if self.table.has_body(&name) {
            return Err(Error::input(format!("the name `{name}` is taken"))
                .under("name")
                .hint("give each body its own"));
        }
        self.read(&name, json, kinds, build).map_err(|error| error.element(&name))?;
        build.own("body", &name);
        Ok(())
    }

    fn read(
        &mut self,
        name: &str,
        mut json: Map<String, Value>,
        kinds: &[BodyKind<D>],
        build: &Build<D>,
    ) -> Result<()> {
        let kind = take_kind(&mut json, "body", kinds)?;
        if is_absolute_beam(kind.name, &json) {
            let beam = AbsoluteBeam::read(name, json, build)?;
            let first_body = self.bodies.len();
            for (node, (markers, built)) in beam.nodes().into_iter().enumerate() {
                // The beam's own name is a marker at its left end.
                let own = (node == 0).then(|| name.to_string());
                let named = own.into_iter().chain(markers.into_iter().map(|marker| format!("{name}.{marker}")));
                self.place(format!("{name}.n{node}"), named, built);
            }
            let line = beam.line(first_body, self.next_force);
            self.next_force = line.forces().end;
            self.beams.push(line);
            return Ok(());
        }
        let origin = json.remove("origin").map(|origin| build.vector::<D>("origin", &parse::<Vec<Number>>(origin)?));
        let origin = origin.transpose()?;
        let (mut initial, given) = start_and_markers(&mut json)?;
        initial.origin = origin.map_or(Vec::new(), |origin| origin.to_vec());
        let origin = origin.unwrap_or([0.0; D]);
        let mut all = vec![Marker::point(origin)];
        let named = markers::markers(&given, &origin, build)?;
        all.extend(named.iter().map(|(_, marker)| *marker));
        let built = (kind.build)(Value::Object(json), all, &initial, build)?;
        self.place(name.to_string(), named.iter().map(|(marker, _)| format!("{name}.{marker}")), built);
        Ok(())
    }

    /// Adds a body; `markers` are the full names of its markers after its own frame.
    fn place(&mut self, name: String, markers: impl Iterator<Item = String>, built: Built<D>) {
        let index = self.bodies.len();
        let first_marker = self.table.names.len();
        let oriented = built.body.oriented();
        let all = [name.clone()].into_iter().chain(markers);
        all.for_each(|marker| self.table.add(marker, Some(index), oriented));
        self.table.body_names.push(name.clone());
        self.add_part(name, first_marker, built);
    }

    /// Adds a state: a body whose marker no reference can name.
    pub(super) fn place_state(&mut self, name: &str, built: Built<D>) {
        let first_marker = self.table.names.len();
        self.table.add_state(name.to_string(), self.bodies.len());
        self.add_part(name.to_string(), first_marker, built);
    }

    fn add_part(&mut self, name: String, first_marker: MarkerId, built: Built<D>) {
        let first_q = self.q.len();
        let first_v = self.v.len();
        let nq = built.q.len();
        let nv = built.v.len();
        self.bodies.push(Part { name, first_marker, first_q, first_v, nq, nv, body: built.body });
        self.q.extend(built.q);
        self.v.extend(built.v);
    }

    /// The model, with the initial q and v.
    fn joined(
        self,
        links: Links<D>,
        gravity: [f64; D],
        switches: Switches,
        turnings: Vec<Turning>,
    ) -> (Model<D>, Vec<f64>, Vec<f64>) {
        let Parts { table: markers, ground, bodies, beams, mut q, v, .. } = self;
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
}

/// Removes `initial` and `markers`, which all bodies share, and parses them.
pub(super) fn start_and_markers(json: &mut Map<String, Value>) -> Result<(Initial, Map<String, Value>)> {
    let initial = json
        .remove("initial")
        .map_or_else(|| Ok(Initial::default()), |initial| parse(initial).map_err(|error| error.under("initial")))?;
    let markers = json
        .remove("markers")
        .map_or_else(|| Ok(Map::new()), |given| object(given).map_err(|error| error.under("markers")))?;
    Ok((initial, markers))
}

pub(super) fn object(json: Value) -> Result<Map<String, Value>> {
    match json {
        Value::Object(map) => Ok(map),
        other => Err(Error::input(format!("expected an object {{...}}, found {}", show(&other)))),
    }
}

fn take_text(json: &mut Map<String, Value>, key: &str) -> Result<String> {
    match json.remove(key) {
        Some(Value::String(text)) => Ok(text),
        Some(other) => Err(Error::input(format!("expected text in quotes, found {}", show(&other))).under(key)),
        None => Err(Error::input(format!("the key `{key}` is missing")).hint(format!("give a \"{key}\""))),
    }
}

/// Removes `type` and finds the kind of that name.
pub(super) fn take_kind<'k, Make>(
    json: &mut Map<String, Value>,
    what: &str,
    known: &'k [ElementKind<Make>],
) -> Result<&'k ElementKind<Make>> {
    let names = || known.iter().map(|kind| kind.name);
    if !json.contains_key("type") {
        return Err(Error::input("the key `type` is missing")
            .hint(format!("give the {what} a type: {}", names().collect::<Vec<_>>().join(", "))));
    }
    let name = take_text(json, "type")?;
    known.iter().find(|kind| kind.name == name).ok_or_else(|| {
        Error::input(format!("there is no {what} of type `{name}`")).under("type").hint(suggest(&name, names()))
    })
}

pub(super) fn take_name(json: &mut Map<String, Value>) -> Result<String> {
    let name = take_text(json, "name")?;
    check_name(&name).map_err(|error| error.under("name"))?;
    Ok(name)
}
