//! The bodies of a scene, read one after the other.

use super::absolute_beam::{AbsoluteBeam, BeamLine, is_absolute_beam};
use super::format::SceneFile;
use super::keys::{object, start_and_markers, take_kind, take_name, taken};
use super::markers;
use super::model::Part;
use crate::body::{BodyFacts, BodyKind, Build, BuiltBody, Marker, MarkerId, MarkerTable, parse, solids};
use crate::error::{Error, Result};
use crate::math::expression::Number;
use serde_json::{Map, Value};

/// Bodies read so far, with their initial q and v.
pub struct SceneParts<const D: usize> {
    pub table: MarkerTable,
    pub ground: Vec<Marker<D>>,
    pub bodies: Vec<Part<D>>,
    pub beams: Vec<BeamLine>,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    /// Index of the next absolute beam's first element among the forces.
    next_force: usize,
}

impl<const D: usize> SceneParts<D> {
    pub fn collect(file: &SceneFile, kinds: &[BodyKind<D>], build: &Build<D>) -> Result<Self> {
        if file.bodies.is_empty() {
            return Err(Error::input("the scene has no body")
                .under("bodies")
                .hint("give at least one: nothing else can move"));
        }
        let ground = markers::markers(&file.ground.markers, &[0.0; D], build).map_err(|error| error.under("ground"))?;
        build.switches.borrow_mut().own("the ground");
        let mut parts = SceneParts::new(ground, file.forces.len());
        // Copies, here and of joints and forces: a file freed piece by piece, among what stays, scatters the memory of
        // all that follows, which then takes twice as long in scenes of 10 000 loops.
        for (i, json) in file.bodies.iter().enumerate() {
            parts.add(json.clone(), kinds, build).map_err(|error| error.under(format!("bodies[{i}]")))?;
        }
        Ok(parts)
    }

    fn new(ground: Vec<(String, Marker<D>)>, next_force: usize) -> Self {
        let mut parts = SceneParts {
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
            return Err(taken(&name, "body"));
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
        // Other kinds of bodies may have a key of this name, too.
        let shapes = json.get("shapes").filter(|_| kind.name == "rigid").cloned();
        let built = (kind.build)(Value::Object(json), all, &initial, build)?;
        self.place(name.to_string(), named.iter().map(|(marker, _)| format!("{name}.{marker}")), built);
        if let Some(part) = self.bodies.last_mut() {
            part.solids = solids(shapes.as_ref(), build)?;
        }
        Ok(())
    }

    /// Adds a body; `markers` are the full names of its markers after its own frame.
    fn place(&mut self, name: String, markers: impl Iterator<Item = String>, built: BuiltBody<D>) {
        let index = self.bodies.len();
        let first_marker = self.table.names.len();
        let facts = built.body.facts();
        let all = [name.clone()].into_iter().chain(markers);
        all.for_each(|marker| self.table.add(marker, Some(index), facts.oriented));
        self.table.body_names.push(name.clone());
        self.add_part(name, first_marker, facts, built);
    }

    /// Adds a state: a body whose marker no reference can name.
    pub fn place_state(&mut self, name: &str, built: BuiltBody<D>) {
        let first_marker = self.table.names.len();
        self.table.add_state(name.to_string(), self.bodies.len());
        self.add_part(name.to_string(), first_marker, built.body.facts(), built);
    }

    fn add_part(&mut self, name: String, first_marker: MarkerId, facts: BodyFacts, built: BuiltBody<D>) {
        let first_q = self.q.len();
        let first_v = self.v.len();
        let nq = built.q.len();
        let nv = built.v.len();
        let facts = Box::new(facts);
        let solids = Vec::new();
        self.bodies.push(Part { name, first_marker, first_q, first_v, nq, nv, facts, solids, body: built.body });
        self.q.extend(built.q);
        self.v.extend(built.v);
    }
}
