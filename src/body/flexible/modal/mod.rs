//! Bodies in modal coordinates, from modes that another program has computed.

mod array;
mod inertia;
#[cfg(feature = "npz")]
mod npz;
mod spec;

pub use array::{Array, Table};
pub use spec::{Lumped, ModalBody, ModalData, Node, Nodes};

use super::eigen::entries;
use super::shape::{Elastic, MassIntegrals, Piece, PointShape};
use crate::body::{Build, parse};
use crate::error::{Error, Result, short};
use crate::math::array::from_fn;
use crate::math::memory::refuse_dense;
use faer::{Mat, Side};
use std::path::Path;

/// A body in modal coordinates with the nodes that its markers may name.
pub struct ModalShapes<const D: usize> {
    /// Mass, stiffness and damping in modal coordinates.
    pub elastic: Elastic<D>,
    /// Nodes by name, with the motion of each under the modes.
    pub nodes: Vec<(String, PointShape<D>)>,
}

impl ModalBody {
    /// # Errors
    /// Bad input: a file that cannot be read, missing keys, matrices of the wrong shape, not symmetric or not positive.
    pub fn shapes<const D: usize>(&self, build: &Build<D>) -> Result<ModalShapes<D>> {
        match (&self.file, &self.data) {
            (Some(_), Some(_)) => Err(Error::input("both `file` and `data` are given").hint("keep one of them")),
            (None, None) => {
                Err(Error::input("the key `file` is missing")
                    .hint("name a file with the modes, or give them as \"data\""))
            }
            (None, Some(data)) => {
                resolve(data, build).and_then(|data| shapes(&data)).map_err(|error| error.under("data"))
            }
            (Some(name), None) => read(&build.folder.join(name), build)
                .and_then(|data| shapes(&data))
                .map_err(|error| in_file(name, error)),
        }
    }
}

fn read<const D: usize>(path: &Path, build: &Build<D>) -> Result<ModalData<Array>> {
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("npz")) {
        return read_npz(path);
    }
    let text = crate::files::read_json(path).map_err(|problem| Error::input(problem.to_string()))?;
    let json: serde_json::Value =
        serde_json::from_str(&text).map_err(|problem| Error::input(format!("not JSON: {problem}")))?;
    resolve(&parse::<ModalData<Table>>(json)?, build)
}

#[cfg(feature = "npz")]
use npz::read as read_npz;

#[cfg(not(feature = "npz"))]
fn read_npz(_: &Path) -> Result<ModalData<Array>> {
    Err(Error::input("this program is built without NumPy's files").hint("give JSON, or build with the feature `npz`"))
}

/// Error at the scene's key `file`, with the key within that file in its message.
fn in_file(name: &str, error: Error) -> Error {
    let Error::Input(input) = error else { return error };
    let place = if input.path.is_empty() { String::new() } else { format!("at {}: ", input.path) };
    let outer = Error::input(format!("{name}: {place}{}", input.message)).under("file");
    match input.hint {
        Some(hint) => outer.hint(hint),
        None => outer,
    }
}

/// Evaluates the expressions of modal data.
fn resolve<const D: usize>(data: &ModalData<Table>, build: &Build<D>) -> Result<ModalData<Array>> {
    let maybe =
        |field: &str, table: &Option<Table>| table.as_ref().map(|table| table.resolve(field, build)).transpose();
    let lumped = |(i, lumped): (usize, &Lumped<Table>)| -> Result<Lumped<Array>> {
        let field = |name: &str| format!("lumped[{i}].{name}");
        Ok(Lumped {
            mass: lumped.mass.resolve(&field("mass"), build)?,
            position: lumped.position.resolve(&field("position"), build)?,
            translation: lumped.translation.resolve(&field("translation"), build)?,
        })
    };
    let node = |(name, node): &(String, Node<Table>)| -> Result<(String, Node<Array>)> {
        let field = |key: &str| format!("nodes.{name}.{key}");
        let position = node.position.resolve(&field("position"), build)?;
        let translation = node.translation.resolve(&field("translation"), build)?;
        Ok((name.clone(), Node { position, translation, rotation: maybe(&field("rotation"), &node.rotation)? }))
    };
    Ok(ModalData {
        mass: maybe("mass", &data.mass)?,
        center: maybe("center", &data.center)?,
        inertia: maybe("inertia", &data.inertia)?,
        modal_mass: maybe("modal_mass", &data.modal_mass)?,
        modal_stiffness: maybe("modal_stiffness", &data.modal_stiffness)?,
        modal_damping: maybe("modal_damping", &data.modal_damping)?,
        linear_coupling: maybe("linear_coupling", &data.linear_coupling)?,
        angular_coupling: maybe("angular_coupling", &data.angular_coupling)?,
        lumped: data.lumped.as_ref().map(|all| all.iter().enumerate().map(lumped).collect()).transpose()?,
        nodes: data.nodes.as_ref().map(|all| all.0.iter().map(node).collect::<Result<_>>().map(Nodes)).transpose()?,
    })
}

/// Number of n x n matrices in memory: stiffness, damping, mass, eigenvalues, mode integrals and blocks of the
/// equations.
const COPIES: f64 = 40.0;

fn shapes<const D: usize>(data: &ModalData<Array>) -> Result<ModalShapes<D>> {
    let stiffness = stiffness(data)?;
    let n = stiffness.nrows();
    let damping = damping(data, n)?;
    let piece = piece(data, n)?;
    inertia::check(&piece)?;
    let elastic = Elastic {
        names: (1..=n).map(|i| format!("mode{i}")).collect(),
        inertia: MassIntegrals { pieces: vec![piece], discs: Vec::new() },
        stiffness: entries(stiffness.as_ref()),
        damping: entries(damping.as_ref()),
        stretches: Vec::new(),
        line: None,
    };
    Ok(ModalShapes { elastic, nodes: nodes(data, n)? })
}

/// The stiffness matrix, whose size is the number of modes.
fn stiffness(data: &ModalData<Array>) -> Result<Mat<f64>> {
    let Some(stiffness) = &data.modal_stiffness else {
        return Err(Error::input("the key `modal_stiffness` is missing").hint("give one number a mode, or a matrix"));
    };
    let n = stiffness.shape.first().copied().unwrap_or(1);
    if n == 0 {
        return Err(Error::input("there is no mode")
            .under("modal_stiffness")
            .hint("a body without any is of type \"rigid\""));
    }
    let too_many = |error: Error| error.under("modal_stiffness").hint("keep fewer modes, the lowest ones");
    refuse_dense("this body", n, n, COPIES).map_err(too_many)?;
    let stiffness = matrix("modal_stiffness", stiffness, n)?;
    let least = smallest("modal_stiffness", &stiffness)?;
    if least <= 0.0 {
        let text = format!("the stiffness matrix has the eigenvalue {}, but must be positive", short(least));
        return Err(Error::input(text)
            .under("modal_stiffness")
            .hint("leave out rigid-body modes: the body's frame has these motions already"));
    }
    Ok(stiffness)
}

/// The damping matrix of `n` modes.
fn damping(data: &ModalData<Array>, n: usize) -> Result<Mat<f64>> {
    let Some(damping) = &data.modal_damping else { return Ok(Mat::zeros(n, n)) };
    let damping = matrix("modal_damping", damping, n)?;
    let least = smallest("modal_damping", &damping)?;
    if least < 0.0 {
        return Err(Error::input(format!("the damping matrix has the negative eigenvalue {}", short(least)))
            .under("modal_damping")
            .hint("such damping would be a source of energy: check the signs"));
    }
    Ok(damping)
}

/// The inertia of `n` modes, by masses at points or by mass integrals.
fn piece<const D: usize>(data: &ModalData<Array>, n: usize) -> Result<Piece<D>> {
    if let Some(masses) = &data.lumped {
        refuse_inertia(data)?;
        return inertia::of_lumped::<D>(masses, n);
    }
    let identity = || Ok(Mat::identity(n, n));
    let mass = data.modal_mass.as_ref().map_or_else(identity, |mass| matrix("modal_mass", mass, n))?;
    inertia::of_couplings(data, &mass)
}

/// The nodes by name, with their motion under `n` modes.
fn nodes<const D: usize>(data: &ModalData<Array>, n: usize) -> Result<Vec<(String, PointShape<D>)>> {
    let nodes = data.nodes.as_ref().map_or(&[][..], |nodes| &nodes.0);
    if let Some(i) = (0..nodes.len()).find(|&i| nodes[..i].iter().any(|(name, _)| *name == nodes[i].0)) {
        return Err(Error::input(format!("two nodes are named `{}`", nodes[i].0)).under("nodes"));
    }
    let point = |(name, node): &(String, Node<Array>)| {
        let point = point::<D>(node, n).map_err(|error| error.under(format!("nodes.{name}")))?;
        Ok((name.clone(), point))
    };
    nodes.iter().map(point).collect()
}

/// Refuses inertia keys together with lumped masses, from which they follow.
fn refuse_inertia(data: &ModalData<Array>) -> Result<()> {
    let given = [
        ("mass", &data.mass),
        ("center", &data.center),
        ("inertia", &data.inertia),
        ("modal_mass", &data.modal_mass),
        ("linear_coupling", &data.linear_coupling),
        ("angular_coupling", &data.angular_coupling),
    ];
    match given.iter().find(|(_, array)| array.is_some()) {
        None => Ok(()),
        Some((key, _)) => {
            Err(Error::input(format!("`{key}` follows from `lumped`")).under(key).hint("keep one of them"))
        }
    }
}

/// n x n numbers, or n on the diagonal.
fn matrix(field: &str, array: &Array, n: usize) -> Result<Mat<f64>> {
    if array.shape.len() < 2 {
        let diagonal = array.fit(field, &[n])?;
        return Ok(Mat::from_fn(n, n, |i, j| if i == j { diagonal[i] } else { 0.0 }));
    }
    let values = array.fit(field, &[n, n])?;
    let largest = crate::math::largest(values);
    for (i, j) in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
        let [lower, upper] = [values[i * n + j], values[j * n + i]];
        // Files have few digits, so symmetry is checked to 1e-6.
        if (lower - upper).abs() > 1e-6 * largest {
            return Err(Error::input(format!(
                "the matrix is not symmetric: [{j}][{i}] is {}, [{i}][{j}] is {}",
                short(upper),
                short(lower)
            ))
            .under(field));
        }
    }
    Ok(Mat::from_fn(n, n, |i, j| (values[i * n + j] + values[j * n + i]) / 2.0))
}

/// The smallest eigenvalue; zero if it is within round-off of the largest.
fn smallest(field: &str, matrix: &Mat<f64>) -> Result<f64> {
    let failed = |_| Error::input("the eigenvalues cannot be computed").under(field);
    let eigenvalues = matrix.self_adjoint_eigenvalues(Side::Lower).map_err(failed)?;
    let smallest = eigenvalues.iter().copied().fold(f64::INFINITY, f64::min);
    Ok(if smallest.abs() <= 1e-14 * crate::math::largest(&eigenvalues) { 0.0 } else { smallest })
}

fn point<const D: usize>(node: &Node<Array>, n: usize) -> Result<PointShape<D>> {
    let position = node.position.fit("position", &[D])?;
    let translation = node.translation.fit("translation", &[D, n])?;
    let rotation = match &node.rotation {
        None => vec![[0.0; 3]; n],
        Some(rotation) if D == 2 => rotation.fit("rotation", &[n])?.iter().map(|turn| [0.0, 0.0, *turn]).collect(),
        Some(rotation) => {
            let rotation = rotation.fit("rotation", &[3, n])?;
            (0..n).map(|mode| from_fn(|k| rotation[k * n + mode])).collect()
        }
    };
    Ok(PointShape {
        rest: from_fn(|k| position[k]),
        arm: [0.0; D],
        shortening: Vec::new(),
        dofs: (0..n).collect(),
        translation: (0..n).map(|mode| from_fn(|k| translation[k * n + mode])).collect(),
        rotation,
    })
}
