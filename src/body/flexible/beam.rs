//! Builds the equations of motion of a beam in a floating frame from its keys in a scene.

use super::damping::{Basis, damping};
use super::integrals::{EntrySum, add_stiffness, stretch};
use super::line::Shapes;
use super::mesh::Mesh;
use super::profile::Profile;
use super::reduce;
use super::reference::{ReferenceLine, curvature};
use super::ritz::Functions;
use super::shape::{Elastic, Stretch};
use super::spec::{Axial, FlexibleBeam, FrameConditions, Ritz, Theory};
use crate::body::{Build, norm};
use crate::error::{Error, Result, short};
use std::f64::consts::PI;

/// Gauss points that integrate w'^2 exactly.
const STRETCH_POINTS: usize = 3;
/// Largest number of finite elements of a beam.
pub const MOST_ELEMENTS: u32 = 10_000;
/// Largest rotation of the line over an element of a curved beam, rad, whose axis is parallel to the chord.
const MOST_TURN: f64 = 0.5 * PI;

/// Inertia, stiffness, damping and displacement functions of a beam with markers at the abscissae `markers`, and its
/// length, m.
///
/// # Errors
/// Bad input, with the path from the body on.
pub fn elastic_beam<const D: usize>(
    beam: &FlexibleBeam,
    markers: &[f64],
    build: &Build<D>,
) -> Result<(Elastic<D>, f64)> {
    let length = build.positive("length", &beam.length)?;
    let profile = Profile::of(beam, length, build)?;
    check_markers(markers, length)?;
    let line = ReferenceLine { length, curvature: curvature(beam.curvature.as_ref(), build)? };
    if !line.is_straight() {
        check_curved(beam)?;
    }
    let (mut elastic, basis) = match &beam.ritz {
        Some(ritz) => (functions(beam, ritz, length, profile, build)?, Basis::Functions),
        None => elements(beam, line, markers, profile, build)?,
    };
    elastic.damping = damping(&beam.damping, &elastic, basis, build)?;
    Ok((elastic, length))
}

fn check_markers(markers: &[f64], length: f64) -> Result<()> {
    match markers.iter().find(|s| !(**s >= -1e-9 * length && **s <= (1.0 + 1e-9) * length)) {
        None => Ok(()),
        Some(s) => Err(Error::input(format!("a marker is at s = {}, beside the beam", short(*s)))
            .under("markers")
            .hint(format!("the beam is from s = 0 to {}", short(length)))),
    }
}

/// Refuses keys that only straight beams may have.
fn check_curved(beam: &FlexibleBeam) -> Result<()> {
    let refuse = |key: &str, what: &str, instead: &str| {
        let hint = format!("{instead}, or \"frame\": \"absolute\"");
        Err(Error::input(format!("of a curved beam {what}")).under(key).hint(hint))
    };
    if beam.ritz.is_some() {
        return refuse("ritz", "no displacement functions are known", "give \"elements\" instead");
    }
    if beam.frame_conditions == Some(FrameConditions::Chord) {
        let what = "the chord is not the x axis of the frame";
        return refuse("frame_conditions", what, "give \"tangent\" or \"mean\"");
    }
    if beam.modes.is_some() && beam.geometric_stiffening.quartic().is_some() {
        let what = "few modes cannot tell how axial force stiffens it";
        return refuse("geometric_stiffening", what, "leave `modes` out");
    }
    Ok(())
}

fn functions<const D: usize>(
    beam: &FlexibleBeam,
    ritz: &Ritz,
    length: f64,
    profile: Profile,
    build: &Build<D>,
) -> Result<Elastic<D>> {
    let others = [
        ("elements", beam.elements.is_some()),
        ("modes", beam.modes.is_some()),
        ("frame_conditions", beam.frame_conditions.is_some()),
        ("axial", beam.axial.is_some()),
    ];
    if let Some((key, _)) = others.iter().find(|(_, given)| *given) {
        return Err(Error::input(format!("`{key}` is for finite elements, whose place `ritz` takes"))
            .under(key)
            .hint(format!("remove `{key}`, or `ritz`")));
    }
    if beam.theory == Theory::Timoshenko {
        return Err(Error::input("displacement functions have no shear")
            .under("theory")
            .hint("leave `theory` out, or give \"elements\" instead of `ritz`"));
    }
    Functions::of(ritz, length, profile, build)?.elastic(beam.geometric_stiffening.quartic())
}

fn elements<const D: usize>(
    beam: &FlexibleBeam,
    line: ReferenceLine,
    markers: &[f64],
    profile: Profile,
    build: &Build<D>,
) -> Result<(Elastic<D>, Basis)> {
    let count = match beam.elements.as_ref().map(|given| build.count("elements", given)).transpose()? {
        None => {
            return Err(Error::input("the key `elements` is missing").hint(
                "give the number of finite elements, such as \"elements\": 8, or displacement functions as \"ritz\"",
            ));
        }
        Some(0) => {
            return Err(Error::input("elements is 0, but must be above zero")
                .under("elements")
                .hint("4 to 16 are enough for most beams"));
        }
        Some(count) if count > MOST_ELEMENTS => {
            return Err(Error::input(format!("elements is {count}, but at most {MOST_ELEMENTS} are possible"))
                .under("elements")
                .hint("4 to 16 are enough for most beams"));
        }
        Some(count) => count as usize,
    };
    let conditions = beam.frame_conditions.unwrap_or_default();
    check_turn(&line, count)?;
    let mesh = Mesh::<D>::new(line, count, markers, profile, beam.axial.unwrap_or_default()).fix(conditions);
    let law = beam.geometric_stiffening.quartic();
    // Few modes cannot represent the axial strain of a bent line, so the line keeps its length instead.
    let shortens = beam.modes.is_some() && law == Some(1.0);
    let nodal = nodal(&mesh, law.filter(|_| !shortens));
    if beam.modes.is_none() && conditions != FrameConditions::Mean {
        return Ok((Elastic { line: Some(Box::new(mesh)), ..nodal }, Basis::Nodal));
    }
    let modes = beam.modes.as_ref().map(|modes| build.count("modes", modes)).transpose()?.map(|modes| modes as usize);
    if modes.is_some() && law.is_some() && !shortens {
        return Err(Error::input("few modes have no axial strain that the cubic law could count")
            .under("geometric_stiffening")
            .hint("give true, by which the line shortens as it bends, or leave `modes` out"));
    }
    let reduced = reduce::beam(mesh, nodal, conditions, markers, modes, shortens)?;
    Ok((reduced, Basis::Modal))
}

fn check_turn(line: &ReferenceLine, elements: usize) -> Result<()> {
    let turn = line.length * norm(&line.curvature);
    if turn <= MOST_TURN * elements as f64 * (1.0 + 1e-9) {
        Ok(())
    } else {
        Err(Error::input(format!("an element of this curved beam turns by {} rad", short(turn / elements as f64)))
            .under("elements")
            .hint(format!(
                "give {} or more, of which none turns by more than a quarter turn",
                (turn / MOST_TURN).ceil()
            )))
    }
}

/// The stretches of an element. Its u' cannot represent w'^2, so it would lock: both enter by their means over the
/// element, or at the two points at which a quadratic displacement has its best slopes.
fn stiffened<const D: usize>(mesh: &Mesh<D>, element: usize, quartic: f64) -> Vec<Stretch> {
    let start = mesh.start(element);
    match mesh.axial() {
        Axial::Linear => {
            let (dofs, samples) = mesh.samples(element, STRETCH_POINTS);
            vec![stretch(quartic, start, &dofs, &samples)]
        }
        Axial::Quadratic => {
            let (dofs, samples) = mesh.samples(element, 2);
            let middle = start + samples[0].weight;
            let halves = samples.chunks(1).zip([start, middle]);
            halves.map(|(point, start)| stretch(quartic, start, &dofs, point)).collect()
        }
    }
}

/// The beam in the coordinates of its nodes; without damping, and without the line, which is the mesh itself.
fn nodal<const D: usize>(mesh: &Mesh<D>, quartic: Option<f64>) -> Elastic<D> {
    let mut stiffness = EntrySum::default();
    let mut stretches = Vec::new();
    for element in 0..mesh.count() {
        let (dofs, samples) = mesh.samples(element, mesh.points());
        add_stiffness(&mut stiffness, &dofs, &samples);
        if let Some(quartic) = quartic {
            stretches.extend(stiffened(mesh, element, quartic));
        }
    }
    let inertia = mesh.inertia(0.0);
    let stiffness = stiffness.finish();
    Elastic { names: mesh.names(), inertia, stiffness, damping: Vec::new(), stretches, line: None }
}
