//! Writer of binary glTF 2.0 files: nodes, their motion, and the meshes that they show.
//!
//! Reference: Khronos Group, glTF 2.0 Specification, sections 3.6 (buffers), 3.11 (animations) and 4 (GLB).

use super::primitives::{ALL, Placement, Primitive};
use crate::body::cross;
use crate::math::array::from_fn;
use serde_json::{Value, json};

/// Colours of bodies, then that of all else, as linear RGB.
const COLORS: [[f64; 3]; 7] = [
    [0.0, 0.168, 0.445],
    [0.665, 0.112, 0.0],
    [0.0, 0.342, 0.171],
    [0.791, 0.347, 0.0],
    [0.604, 0.191, 0.386],
    [0.093, 0.456, 0.815],
    [0.147, 0.181, 0.231],
];
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;

/// A file in the making. Node 0 holds all others.
pub struct Glb {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    nodes: Vec<Value>,
    children: Vec<Vec<usize>>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
    /// Accessor of the times.
    times: usize,
    /// Poses of the nodes that move, for positions in the world of the mechanism.
    motions: Vec<Vec<Placement>>,
}

/// Returns a vector turned by a quaternion [x, y, z, w]: v + 2 u x (u x v + w v).
pub fn turned(quaternion: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let [x, y, z, w] = quaternion;
    let u = [x, y, z];
    let inner = cross(&u, &v);
    let twice = cross(&u, &from_fn(|i| inner[i] + w * v[i]));
    from_fn(|i| v[i] + 2.0 * twice[i])
}

impl Glb {
    /// A file with a root that is turned so that the mechanism stands upright, and the times of all motions, s.
    pub fn new(name: &str, upright: [f64; 4], times: impl Iterator<Item = f64>) -> Self {
        let root = vec![json!({ "name": name, "rotation": upright })];
        let mut glb = Glb {
            bytes: Vec::new(),
            views: Vec::new(),
            accessors: Vec::new(),
            nodes: root,
            children: vec![Vec::new()],
            samplers: Vec::new(),
            channels: Vec::new(),
            times: 0,
            motions: vec![Vec::new()],
        };
        let times: Vec<f32> = times.map(|t| t as f32).collect();
        glb.times = glb.floats(&times, 1);
        for mesh in ALL {
            let (corners, triangles) = mesh.mesh();
            glb.floats(corners.as_flattened(), 3);
            glb.indices(&triangles);
        }
        glb
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend(bytes);
        // All start at multiples of four.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    /// Adds an accessor of vectors of `size` numbers, with their bounds.
    fn floats(&mut self, numbers: &[f32], size: usize) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let bound = |pick: fn(f32, f32) -> f32, from: f32| -> Vec<f32> {
            (0..size).map(|i| numbers.iter().skip(i).step_by(size).copied().fold(from, pick)).collect()
        };
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][size - 1];
        self.accessors.push(json!({
            "bufferView": view, "componentType": FLOAT, "count": numbers.len() / size, "type": kind,
            "min": bound(f32::min, f32::INFINITY), "max": bound(f32::max, f32::NEG_INFINITY),
        }));
        self.accessors.len() - 1
    }

    fn indices(&mut self, corners: &[u16]) {
        let bytes: Vec<u8> = corners.iter().flat_map(|corner| corner.to_le_bytes()).collect();
        let view = self.view(&bytes);
        self.accessors.push(json!({
            "bufferView": view, "componentType": UNSIGNED_SHORT, "count": corners.len(), "type": "SCALAR",
        }));
    }

    fn add_node(
        &mut self,
        parent: usize,
        name: &str,
        at: Placement,
        mesh: Option<(Primitive, Option<usize>)>,
    ) -> usize {
        let (translation, rotation, scale) = at;
        let mut node = json!({ "name": name, "translation": translation, "rotation": rotation, "scale": scale });
        if let Some((primitive, color)) = mesh {
            let color = color.map_or(COLORS.len() - 1, |color| color % (COLORS.len() - 1));
            node["mesh"] = json!(primitive as usize * COLORS.len() + color);
        }
        self.nodes.push(node);
        self.children.push(Vec::new());
        self.motions.push(Vec::new());
        let number = self.nodes.len() - 1;
        self.children[parent].push(number);
        number
    }

    /// Adds a node at the root.
    pub fn node(&mut self, name: &str, at: Placement, mesh: Option<(Primitive, Option<usize>)>) -> usize {
        self.add_node(0, name, at, mesh)
    }

    /// Adds a node with a mesh that is fixed to another one; the colour is that of a body, or of none.
    pub fn fixed_node(&mut self, parent: usize, name: &str, at: Placement, mesh: (Primitive, Option<usize>)) {
        self.add_node(parent, name, at, Some(mesh));
    }

    /// Adds a node that moves.
    pub fn moving_node(
        &mut self,
        name: &str,
        motion: impl IntoIterator<Item = Placement>,
        mesh: Option<(Primitive, Option<usize>)>,
    ) -> usize {
        let mut motion: Vec<Placement> = motion.into_iter().collect();
        // q and -q are one rotation, but not on the way between two rows.
        for k in 1..motion.len() {
            let before = motion[k - 1].1;
            let rotation = &mut motion[k].1;
            if before.iter().zip(&*rotation).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
                *rotation = rotation.map(|x| -x);
            }
        }
        let node = self.node(name, motion[0], mesh);
        self.channel(node, "translation", 3, motion.iter().flat_map(|at| at.0));
        self.channel(node, "rotation", 4, motion.iter().flat_map(|at| at.1));
        if motion.iter().any(|at| at.2 != motion[0].2) {
            self.channel(node, "scale", 3, motion.iter().flat_map(|at| at.2));
        }
        self.motions[node] = motion;
        node
    }

    fn channel(&mut self, node: usize, path: &str, size: usize, values: impl Iterator<Item = f64>) {
        let values: Vec<f32> = values.map(|value| value as f32).collect();
        let output = self.floats(&values, size);
        self.channels.push(json!({ "sampler": self.samplers.len(), "target": { "node": node, "path": path } }));
        self.samplers.push(json!({ "input": self.times, "output": output, "interpolation": "LINEAR" }));
    }

    /// Returns the position of a point of a node at time number `k`.
    pub fn position(&self, node: usize, k: usize, at: [f32; 3]) -> [f64; 3] {
        let at = at.map(f64::from);
        let Some((r, rotation, _)) = self.motions[node].get(k) else { return at };
        let way = turned(*rotation, at);
        from_fn(|i| r[i] + way[i])
    }

    /// Returns the bytes of the file.
    pub fn finish(mut self) -> Vec<u8> {
        for (node, children) in self.nodes.iter_mut().zip(&self.children).filter(|(_, children)| !children.is_empty()) {
            node["children"] = json!(children);
        }
        let material = |color: &[f64; 3]| {
            let [r, g, b] = color;
            json!({ "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.6 } })
        };
        let mesh = |k: usize| {
            let corners = 1 + 2 * (k / COLORS.len());
            let primitive =
                json!({ "attributes": { "POSITION": corners }, "indices": corners + 1, "material": k % COLORS.len() });
            json!({ "primitives": [primitive] })
        };
        let meshes: Vec<Value> = (0..ALL.len() * COLORS.len()).map(mesh).collect();
        let mut document = json!({
            "asset": { "version": "2.0", "generator": concat!("holonom ", env!("CARGO_PKG_VERSION")) },
            "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": self.nodes, "meshes": meshes,
            "materials": COLORS.iter().map(material).collect::<Vec<_>>(),
            "accessors": self.accessors, "bufferViews": self.views, "buffers": [{ "byteLength": self.bytes.len() }],
        });
        if !self.channels.is_empty() {
            document["animations"] =
                json!([{ "name": "motion", "channels": self.channels, "samplers": self.samplers }]);
        }
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + text.len() + 8 + self.bytes.len();
        let mut file = Vec::with_capacity(length);
        let word = |value: usize| (value as u32).to_le_bytes();
        file.extend(b"glTF");
        file.extend([word(2), word(length), word(text.len())].concat());
        file.extend(b"JSON");
        file.extend(text);
        file.extend(word(self.bytes.len()));
        file.extend(b"BIN\0");
        file.extend(self.bytes);
        file
    }
}
