//! A beam in modal coordinates, written out as another program would do it.

use holonom::body::flexible::modal::{Array, Lumped, ModalData, Node, Nodes};
use holonom::body::flexible::{Elastic, FlexibleBeam, PointShape, elastic_beam, gauss_legendre, on_interval};
use holonom::body::{Build, MarkerTable};
use holonom::math::expression::Parameters;
use serde_json::Value;
use std::path::Path;

/// A reduced beam whose markers are at its ends.
pub struct Beam<const D: usize> {
    elastic: Elastic<D>,
    length: f64,
    elements: usize,
    rho_a: f64,
    /// About y and z; in the plane about z.
    rho_i: [f64; 2],
}

impl<const D: usize> Beam<D> {
    /// From what a scene says of it, whose numbers are no expressions.
    pub fn new(body: &Value) -> Self {
        let mut beam = body.clone();
        for shared in ["name", "type", "markers", "initial"] {
            beam.as_object_mut().unwrap().remove(shared);
        }
        let number = |value: &Value| value.as_f64().unwrap_or(0.0);
        let length = number(&beam["length"]);
        let inertia = &beam["inertia"];
        let rho_i = match D {
            2 => [0.0, number(&inertia["rhoI"])],
            _ => [number(&inertia["rhoI"][0]), number(&inertia["rhoI"][1])],
        };
        let rho_a = number(&inertia["rhoA"]);
        let elements = number(&beam["elements"]) as usize;
        let parameters = Parameters::default();
        let markers = MarkerTable::default();
        let folder = Path::new("");
        let build = Build {
            parameters: &parameters,
            markers: &markers,
            outputs: &(),
            gravity: [0.0; D],
            folder,
            switches: &Default::default(),
            turnings: &Default::default(),
        };
        let spec: FlexibleBeam = serde_json::from_value(beam).unwrap();
        let (elastic, _) = elastic_beam(&spec, &[0.0, length], &build).unwrap();
        Beam { elastic, length, elements, rho_a, rho_i }
    }

    /// Some of its modes, with masses at the points of integration and at arms of 1 m beside them: all of its inertia.
    pub fn export(&self, modes: &[usize]) -> ModalData<Array> {
        let [about_y, about_z] = self.rho_i;
        let arms = [
            ([0.0, 0.0], self.rho_a - about_y - about_z),
            ([1.0, 0.0], about_z / 2.0),
            ([-1.0, 0.0], about_z / 2.0),
            ([0.0, 1.0], about_y / 2.0),
            ([0.0, -1.0], about_y / 2.0),
        ];
        let mut lumped = Vec::new();
        for element in 0..self.elements {
            let ends = [element, element + 1].map(|k| k as f64 * self.length / self.elements as f64);
            for (s, weight) in on_interval(&gauss_legendre(4), ends) {
                for ([y, z], density) in arms.iter().filter(|arm| arm.1 > 0.0) {
                    let Node { position, translation, .. } = self.node([s, *y, *z], modes);
                    lumped.push(Lumped { mass: Array::number(density * weight), position, translation });
                }
            }
        }
        let diagonal = |matrix: &[(usize, usize, f64)]| {
            assert!(matrix.iter().all(|(i, j, _)| i == j));
            let of = |mode: &usize| matrix.iter().find(|entry| entry.0 == *mode).map_or(0.0, |entry| entry.2);
            array(&[modes.len()], modes.iter().map(of).collect())
        };
        let node = |name: &str, s: f64| (name.to_string(), self.node([s, 0.0, 0.0], modes));
        ModalData {
            modal_stiffness: Some(diagonal(&self.elastic.stiffness)),
            modal_damping: Some(diagonal(&self.elastic.damping))
                .filter(|damping| damping.values.iter().any(|d| *d > 0.0)),
            lumped: Some(lumped),
            nodes: Some(Nodes(vec![node("left", 0.0), node("tip", self.length)])),
            ..ModalData::default()
        }
    }

    pub fn modes(&self) -> usize {
        self.elastic.names.len()
    }

    fn node(&self, place: [f64; 3], modes: &[usize]) -> Node<Array> {
        let line = self.elastic.line.as_ref().unwrap();
        let PointShape { rest, translation, rotation, .. } = line.point(std::array::from_fn(|k| place[k]));
        let moved = (0..D).flat_map(|k| modes.iter().map(move |&mode| (k, mode))).map(|(k, mode)| translation[mode][k]);
        let turns = if D == 2 { 2..3 } else { 0..3 };
        let shape = if D == 2 { vec![modes.len()] } else { vec![3, modes.len()] };
        let turned = turns.flat_map(|k| modes.iter().map(move |&mode| (k, mode))).map(|(k, mode)| rotation[mode][k]);
        Node {
            position: array(&[D], rest.to_vec()),
            translation: array(&[D, modes.len()], moved.collect()),
            rotation: Some(array(&shape, turned.collect())),
        }
    }
}

fn array(shape: &[usize], values: Vec<f64>) -> Array {
    Array { shape: shape.to_vec(), values }
}
