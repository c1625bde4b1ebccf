//! Outputs of a beam at a place on its line.

use super::absolute_beam::BeamLine;
use super::keys::{find, missing};
use super::kinematics::Elements;
use super::measures::{MeasureKind, OutputSpec};
use super::model::{Combination, Measure, ModelForce};
use super::place::{Cut, Place, Reading};
use crate::body::flexible::{Line, Stretch};
use crate::body::{Bent, Build, Marker, MarkerId};
use crate::error::{Error, Result, short};
use crate::force::{Beam, Half};
use crate::math::array::from_fn;

/// The quantity that an output reads of a beam: a body, or a massless beam among the forces.
pub fn measure<const D: usize>(
    spec: &OutputSpec,
    elements: Elements<D>,
    cuts: &mut Vec<Cut<D>>,
    build: &Build<D>,
) -> Result<Measure> {
    let of = spec.subject()?;
    let Elements { bodies, beams, forces, .. } = elements;
    if let Some(beam) = beams.iter().find(|beam| beam.name == of) {
        return Ok(Measure::Station(Box::new(on_absolute(spec, beam, elements, build)?)));
    }
    let floating = || bodies.iter().enumerate().filter_map(|(body, part)| Some((body, part, part.body.bent()?)));
    if let Some((body, part, bent)) = floating().find(|(_, part, _)| part.name == of) {
        return match wanted::<D>(spec, build)? {
            Wanted::Force(component) => {
                let at = place(spec, bent.line.length(), build)?;
                Ok(Measure::Section { cut: cut(body, at, bent.line, elements, cuts)?, component })
            }
            wanted => Ok(Measure::Elastic(combination(spec, wanted, bent, part.first_q + bent.first, build)?)),
        };
    }
    let count = beams.first().map_or(forces.len(), |beam| beam.first_force);
    let massless = || forces[..count].iter().filter_map(|force| Some((force, force.element.beam()?)));
    let names = floating().map(|(_, part, _)| part.name.as_str()).chain(beams.iter().map(|beam| beam.name.as_str()));
    let names: Vec<&str> = massless().map(|(force, _)| force.name.as_str()).chain(names).collect();
    let found = find("flexible beam", of, names.into_iter()).map_err(|error| {
        if elements.joints.iter().any(|joint| joint.name == of) { Error::input(format!("`{of}` is a joint, no flexible beam")).under("of").hint(
                "\"measure\": \"reaction\" gives what a joint exerts: without a component the torque of a driver of an angle",
            ) } else { error }
    })?;
    match massless().nth(found) {
        Some((force, beam)) => Ok(Measure::Station(Box::new(on_massless(spec, force, beam, build)?))),
        None => Err(Error::input(format!("`{of}` is no flexible beam")).under("of")),
    }
}

fn on_absolute<const D: usize>(
    spec: &OutputSpec,
    beam: &BeamLine,
    Elements { bodies, .. }: Elements<D>,
    build: &Build<D>,
) -> Result<Place> {
    let at = place(spec, beam.length(), build)?;
    let element = beam.element_at(at);
    let node = |node: usize| bodies[beam.first_body + node].first_marker;
    Ok(Place {
        element: beam.elements[element].clone(),
        ends: [node(element), node(element + 1)],
        halves: beam.halves[element],
        own: node(0),
        x: at - beam.abscissae[element],
        reading: reading(wanted::<D>(spec, build)?, beam.relaxed(at), &beam.section(at).compliance::<D>()),
    })
}

fn on_massless<const D: usize>(
    spec: &OutputSpec,
    force: &ModelForce<D>,
    beam: &Beam,
    build: &Build<D>,
) -> Result<Place> {
    let x = place(spec, beam.length, build)?;
    let ends: [MarkerId; 2] = [force.markers[0], force.markers[1]];
    let reading = reading(wanted::<D>(spec, build)?, beam.relaxed(x), &beam.compliance()[0]);
    Ok(Place { element: beam.clone(), ends, halves: [Half::default(); 2], own: ends[0], x, reading })
}

fn reading(wanted: Wanted, relaxed: [f64; 3], compliance: &[f64; 6]) -> Reading {
    match wanted {
        Wanted::Deflection(axis) => Reading::Deflection { axis, rest: relaxed[axis] },
        Wanted::Strain(factors) => Reading::Strain(from_fn(|i| factors[i] * compliance[i])),
        Wanted::Force(component) => Reading::Force(component),
    }
}

/// Index in `cuts` of the section of a floating beam at abscissa `at`, added if it is not there. A marker at the
/// section itself counts as beyond it, except at the left end.
fn cut<const D: usize>(
    body: usize,
    at: f64,
    line: &dyn Line<D>,
    Elements { bodies, joints, forces, .. }: Elements<D>,
    cuts: &mut Vec<Cut<D>>,
) -> Result<usize> {
    if let Some(known) = cuts.iter().position(|known| known.body == body && known.at == at) {
        return Ok(known);
    }
    let part = &bodies[body];
    let own = part.markers();
    let slack = 1e-9 * line.length();
    let is_beyond = |marker: MarkerId| {
        let s = part.body.markers()[marker - own.start].offset[0];
        s >= at - slack && s > slack
    };
    let origin = line.point([0.0; D]);
    let frame_is_a_section =
        origin.translation.iter().flatten().chain(origin.rotation.iter().flatten()).all(|x| *x == 0.0);
    let slots = |name: &str, markers: &[MarkerId]| -> Result<Vec<usize>> {
        if !frame_is_a_section && markers.contains(&own.start) {
            return Err(on_the_frame(&part.name, name));
        }
        let on_it = |slot: &usize| own.contains(&markers[*slot]) && is_beyond(markers[*slot]);
        Ok((0..markers.len()).filter(on_it).collect())
    };
    let mut all = Cut {
        body,
        at,
        section: line.point(from_fn(|k| if k == 0 { at } else { 0.0 })),
        axes: line.at_rest(at).carry(Marker::point([0.0; D])),
        beyond: line.beyond(at),
        joints: Vec::new(),
        forces: Vec::new(),
    };
    for (i, joint) in joints.iter().enumerate() {
        all.joints.extend(slots(&joint.name, &joint.markers)?.into_iter().map(|slot| (i, slot)));
    }
    for (i, force) in forces.iter().enumerate() {
        all.forces.extend(slots(&force.name, &force.markers)?.into_iter().map(|slot| (i, slot)));
    }
    cuts.push(all);
    Ok(cuts.len() - 1)
}

fn on_the_frame(beam: &str, element: &str) -> Error {
    Error::input(format!("`{element}` acts on the floating frame of `{beam}`, which is no section of it"))
        .under("of")
        .hint(format!("give `{beam}` a marker where `{element}` acts"))
}

/// Deflection or strain of a beam in a floating frame whose elastic coordinates are those of q from `first` on.
fn combination<const D: usize>(
    spec: &OutputSpec,
    wanted: Wanted,
    Bent { line, stretches, .. }: Bent<D>,
    first: usize,
    build: &Build<D>,
) -> Result<Combination> {
    let at = place(spec, line.length(), build)?;
    let mut sum = Sum { first, combination: Combination::default() };
    let mut weights = match wanted {
        Wanted::Deflection(axis) => {
            let point = line.point(from_fn(|k| if k == 0 { at } else { 0.0 }));
            sum.add(&point.dofs, point.translation.iter().map(|t| t[axis]));
            if axis == 0 {
                sum.add_squares(&point.dofs, &point.shortening, 0.5);
            }
            return Ok(sum.combination);
        }
        Wanted::Strain(weights) => weights,
        Wanted::Force(_) => [0.0; 6],
    };
    let section = line.section(at);
    if let Some(stretch) = stretches.iter().find(|stretch| at <= stretch.ends[1]).or(stretches.last()) {
        sum.add_extension(stretch, weights[0]);
        weights[0] = 0.0;
    }
    let factor = |strains: &[f64; 6]| -> f64 { strains.iter().zip(weights).map(|(strain, w)| strain * w).sum() };
    sum.add(&section.dofs, section.strains.iter().map(factor));
    Ok(sum.combination)
}

/// Builds a [`Combination`] of the coordinates of q from `first` on.
struct Sum {
    first: usize,
    combination: Combination,
}

impl Sum {
    fn add(&mut self, dofs: &[usize], factors: impl Iterator<Item = f64>) {
        let terms = dofs.iter().zip(factors).filter(|(_, factor)| *factor != 0.0);
        self.combination.linear.extend(terms.map(|(dof, factor)| (self.first + dof, factor)));
    }

    /// Adds `factor` (a.q + q.S q/2), the extension with geometric stiffening.
    fn add_extension(&mut self, stretch: &Stretch, factor: f64) {
        self.add(&stretch.dofs, stretch.axial.iter().map(|a| factor * a));
        self.add_squares(&stretch.dofs, &stretch.slopes, 0.5 * factor);
    }

    /// Adds `factor` q.A q, with A by rows; an empty A is zero.
    fn add_squares(&mut self, dofs: &[usize], matrix: &[f64], factor: f64) {
        let places: Vec<usize> = dofs.iter().map(|dof| self.first + dof).collect();
        let pairs = places.iter().flat_map(|&i| places.iter().map(move |&j| [i, j]));
        let terms = pairs.zip(matrix.iter().map(|x| factor * x)).filter(|(_, factor)| *factor != 0.0);
        self.combination.squares.extend(terms);
    }
}

/// Abscissa of the output, m from the left end.
fn place<const D: usize>(spec: &OutputSpec, length: f64, build: &Build<D>) -> Result<f64> {
    let at = spec.at.as_ref().ok_or_else(|| missing("at", "say where on the beam: m from its left end"))?;
    let at = build.number("at", at)?;
    if (0.0..=length * (1.0 + 1e-12)).contains(&at) {
        Ok(at.min(length))
    } else {
        Err(Error::input(format!("{} m is off the beam", short(at)))
            .under("at")
            .hint(format!("the beam reaches from 0 to {} m", short(length))))
    }
}

/// Quantity of a section that an output asks for.
enum Wanted {
    /// Deflection along this axis.
    Deflection(usize),
    /// Sum of the strains, in the order of [`Station`](crate::force::Station), times these.
    Strain([f64; 6]),
    /// Component of force or moment in the same order.
    Force(usize),
}

fn wanted<const D: usize>(spec: &OutputSpec, build: &Build<D>) -> Result<Wanted> {
    Ok(match spec.measure {
        MeasureKind::Deflection => Wanted::Deflection(spec.component_of("y", &["x", "y", "z"][..D])?),
        MeasureKind::Strain => {
            let mut y = 0.0;
            let mut z = 0.0;
            match (&spec.offset, D) {
                (None, _) => {}
                (Some(offset), 2) => [y] = build.vector::<1>("offset", offset)?,
                (Some(offset), _) => [y, z] = build.vector::<2>("offset", offset)?,
            }
            Wanted::Strain([1.0, 0.0, 0.0, 0.0, z, -y])
        }
        MeasureKind::AxialForce => Wanted::Force(0),
        MeasureKind::ShearForce => Wanted::Force(1 + spec.component_of("y", &["y", "z"][..D - 1])?),
        MeasureKind::Torque if D == 2 => {
            return Err(Error::input("a planar beam carries no torque")
                .under("measure")
                .hint("watch its bending_moment"));
        }
        MeasureKind::Torque => Wanted::Force(3),
        _ => {
            let known: &[&str] = if D == 2 { &["z"] } else { &["y", "z"] };
            Wanted::Force(if known[spec.component_of("z", known)?] == "y" { 4 } else { 5 })
        }
    })
}
