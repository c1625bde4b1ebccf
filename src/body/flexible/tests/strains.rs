//! Strains of sections: none for rigid motions, constant ones reproduced.

use super::*;
use crate::body::flexible::line::{Cross, Shapes};
use crate::body::flexible::mesh::Mesh;
use crate::body::flexible::{Axial, Profile, ReferenceLine, Section};
use faer::linalg::solvers::Solve;

const SECTION: Section =
    Section { ea: 2e4, ga: [900.0, 700.0], gj: 2.0, ei: [5.0, 3.0], rho_a: 0.8, rho_i: [2e-3, 1e-3] };

/// The section at `s` for displacements of all nodes.
fn at<const D: usize>(mesh: &Mesh<D>, s: f64, q: &[f64]) -> Cross {
    let station = mesh.at(s);
    let mut sum = Cross::default();
    station.dofs.iter().zip(&station.shapes).for_each(|(&dof, shape)| sum.add(q[dof], shape));
    sum
}

/// Free meshes with and without shear and middle nodes.
fn meshes<const D: usize>() -> Vec<Mesh<D>> {
    let slender = Section { ga: [f64::INFINITY; 2], ..SECTION };
    [(SECTION, Axial::Linear), (SECTION, Axial::Quadratic), (slender, Axial::Linear), (slender, Axial::Quadratic)]
        .map(|(section, axial)| {
            Mesh::new(ReferenceLine::straight(1.5), 5, &[0.4], Profile::uniform(section, false), axial)
        })
        .into()
}

/// The same on an arc, or in space on a helix.
fn curved<const D: usize>() -> Vec<Mesh<D>> {
    let curvature = if D == 2 { [0.0, 0.0, 1.3] } else { [0.5, -0.7, 1.1] };
    let line = ReferenceLine { length: 1.5, curvature };
    [Axial::Linear, Axial::Quadratic]
        .map(|axial| Mesh::new(line, 5, &[0.4], Profile::uniform(SECTION, false), axial))
        .into()
}

/// The line moves as it stands, off the chords, too.
#[test]
fn rigid_motions_carry_the_line() {
    fn check<const D: usize>() {
        for (mesh, part) in
            curved::<D>().iter().flat_map(|mesh| (D..mesh.rigid_motions().len()).map(move |k| (mesh, k)))
        {
            let motion = &mesh.rigid_motions()[part];
            let axis = if D == 2 { 2 } else { part - D };
            let turn: [f64; 3] = from_fn(|k| if k == axis { 1.0 } else { 0.0 });
            let place = |s: f64| mesh.reference().at(s).1;
            let moved = |s: f64| at(mesh, s, motion).displacement;
            for s in [0.1, 0.4, 0.77, 1.5] {
                let expected = cross(&turn, &from_fn(|k| place(s)[k] - place(0.0)[k]));
                (0..3).for_each(|k| assert_close(moved(s)[k] - moved(0.0)[k], expected[k], 1e-14));
                (0..3).for_each(|k| assert_close(at(mesh, s, motion).rotation[k], turn[k], 1e-14));
            }
        }
    }
    check::<2>();
    check::<3>();
}

#[test]
fn rigid_motions_do_not_strain() {
    fn check<const D: usize>() {
        for mesh in meshes::<D>().into_iter().chain(curved()) {
            for motion in mesh.rigid_motions() {
                for s in [0.0, 0.1, 0.4, 0.77, 1.5] {
                    at(&mesh, s, &motion).strain.iter().for_each(|strain| assert_close(*strain, 0.0, 1e-12));
                }
            }
        }
    }
    check::<2>();
    check::<3>();
}

/// Nodes on a line that is stretched, sheared, twisted and bent by constant strains.
fn patch(mesh: &Mesh<3>, strain: [f64; 6]) -> Vec<f64> {
    let [eps, gy, gz, twist, ky, kz] = strain;
    let nodal = |s: f64| [eps * s, gy * s + kz * s * s / 2.0, gz * s - ky * s * s / 2.0, twist * s, ky * s, kz * s];
    let middle = |name: &str| name.starts_with('m');
    let mut q = Vec::new();
    for (i, name) in mesh.names().iter().enumerate() {
        let node: usize = name[1..].split('_').next().unwrap().parse().unwrap();
        if middle(name) {
            q.push(eps * (mesh.nodes[node] + mesh.nodes[node - 1]) / 2.0);
        } else {
            let first = mesh.names().iter().position(|other| other.starts_with(&format!("n{node}_"))).unwrap();
            q.push(nodal(mesh.nodes[node])[i - first]);
        }
    }
    q
}

#[test]
fn constant_strains_are_reproduced() {
    for mesh in meshes::<3>() {
        let strains = [[0.1, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.2, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.3, 0.4]];
        for strain in strains {
            let q = patch(&mesh, strain);
            for s in [0.01, 0.4, 0.77, 1.5] {
                let found = at(&mesh, s, &q).strain;
                (0..6).for_each(|k| assert_close(found[k], strain[k], 1e-12));
            }
        }
    }
}

/// Shear F/GA, curvature F (L - s)/EI, deflection F L^3/(3 EI) + F L/GA.
#[test]
fn a_force_at_the_tip_bends_and_shears_exactly() {
    let scene = beam_in_space(json!({ "theory": "timoshenko", "elements": 3 }));
    let rod: Elastic<3> = build(&scene, &[0.4]).unwrap();
    let n = rod.names.len();
    let force = 2.0;
    let line = rod.line.unwrap();
    for (tip, [shear, curvature, sign], [ga, ei]) in [("_y", [1, 5, 1], [900.0, 3.0]), ("_z", [2, 4, -1], [700.0, 5.0])]
    {
        let last = (0..n).rev().find(|&i| rod.names[i].ends_with(tip)).unwrap();
        let load = Mat::from_fn(n, 1, |i, _| if i == last { force } else { 0.0 });
        let q = dense(n, &rod.stiffness).partial_piv_lu().solve(&load);
        assert_close(q[(last, 0)], force * (1.5_f64.powi(3) / (3.0 * ei) + 1.5 / ga), 1e-12);
        for s in [0.0, 0.2, 0.4, 1.1, 1.5] {
            let section = line.section(s);
            let strain = |k: i32| -> f64 {
                section.dofs.iter().zip(&section.strains).map(|(&i, strain)| strain[k as usize] * q[(i, 0)]).sum()
            };
            assert_close(strain(shear), force / ga, 1e-11);
            assert_close(strain(curvature), f64::from(sign) * force * (1.5 - s) / ei, 1e-11);
        }
    }
}

#[test]
fn a_fibre_strains_as_the_signs_say() {
    let scene = beam_in_space(json!({ "theory": "timoshenko", "axial": "quadratic" }));
    let rod: Elastic<3> = build(&scene, &[]).unwrap();
    let line = rod.line.unwrap();
    let s = 0.7;
    let h = 1e-5;
    for (y, z) in [(0.0, 0.0), (0.2, 0.0), (0.0, 0.3), (0.2, -0.1)] {
        let [left, right] = [s - h, s + h].map(|s| line.point([s, y, z]));
        let section = line.section(s);
        assert_eq!(section.dofs, left.dofs);
        for i in 0..section.dofs.len() {
            let [eps, .., ky, kz] = section.strains[i];
            let stretched = (right.translation[i][0] - left.translation[i][0]) / (2.0 * h);
            assert_close(stretched, eps - y * kz + z * ky, 1e-7);
        }
    }
}

/// Modes show the same displacements and strains through their line as their nodes do.
#[test]
fn modes_have_a_line() {
    let scene = beam_in_space(json!({ "modes": 4, "elements": 6 }));
    let rod: Elastic<3> = build(&scene, &[0.9]).unwrap();
    let n = rod.names.len();
    let line = rod.line.unwrap();
    assert_eq!(line.point([0.9, 0.1, 0.0]).translation.len(), n);
    // K = int strain^T C strain; without shear.
    let stiffness = Section { ga: [f64::INFINITY; 2], ..SECTION }.stiffness();
    let rule = crate::body::flexible::gauss_legendre(6);
    let mut energy = vec![0.0; n];
    for panel in 0..60 {
        let ends = [f64::from(panel) * 0.025, f64::from(panel + 1) * 0.025];
        for (s, weight) in crate::body::flexible::on_interval(&rule, ends) {
            let section = line.section(s);
            for (i, strain) in section.strains.iter().enumerate() {
                energy[i] += (0..6).map(|k| weight * stiffness[k] * strain[k] * strain[k]).sum::<f64>();
            }
        }
    }
    for (i, j, stiffness) in rod.stiffness {
        assert_eq!(i, j);
        assert_close(energy[i] / stiffness, 1.0, 1e-10);
    }
}
