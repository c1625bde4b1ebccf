//! Outputs of a beam at a place on its line.

use super::format::{MeasureKind, OutputSpec};
use super::model::{BeamLine, Combination, Measure, Reading};
use super::outputs::{Elements, find, missing, wrong_component};
use crate::body::flexible::Stretch;
use crate::body::{Bent, Build};
use crate::error::{Error, Result, short};

/// What is read of the beam `of`.
pub fn measure<const D: usize>(
    spec: &OutputSpec,
    of: &str,
    Elements { bodies, beams, .. }: Elements<D>,
    build: &Build<D>,
) -> Result<Measure> {
    if let Some(beam) = beams.iter().position(|beam| beam.name == of) {
        let at = place(spec, beams[beam].length(), build)?;
        return Ok(Measure::Station { beam, at, reading: reading(spec, &beams[beam], at, build)? });
    }
    let floating = || bodies.iter().filter_map(|part| Some((part, part.body.bent()?)));
    let names = floating().map(|(part, _)| part.name.as_str()).chain(beams.iter().map(|beam| beam.name.as_str()));
    let index = find("flexible beam", of, names.collect::<Vec<_>>().into_iter())?;
    match floating().nth(index) {
        Some((part, bent)) => Ok(Measure::Elastic(combination(spec, bent, part.first_q + bent.first, build)?)),
        None => Err(Error::input(format!("`{of}` is no flexible beam")).under("of")),
    }
}

/// Of an absolute beam.
fn reading<const D: usize>(spec: &OutputSpec, beam: &BeamLine, at: f64, build: &Build<D>) -> Result<Reading> {
    if spec.measure == MeasureKind::Deflection {
        let axis = component(spec, "y", &["x", "y", "z"][..D])?;
        return Ok(Reading::Deflection { axis, rest: beam.relaxed(at)[axis] });
    }
    let factors = weights::<D>(spec, &[1.0; 6], build)?;
    Ok(match (spec.measure, factors.iter().position(|factor| *factor != 0.0)) {
        (MeasureKind::Strain, _) | (_, None) => Reading::Strain(factors),
        (_, Some(component)) => Reading::Force(component),
    })
}

/// Of a beam in a floating frame whose elastic coordinates are those from `first` on.
fn combination<const D: usize>(
    spec: &OutputSpec,
    Bent { line, stretches, .. }: Bent<D>,
    first: usize,
    build: &Build<D>,
) -> Result<Combination> {
    let at = place(spec, line.length(), build)?;
    let mut sum = Sum { first, combination: Combination::default() };
    if spec.measure == MeasureKind::Deflection {
        let axis = component(spec, "y", &["x", "y", "z"][..D])?;
        let mut rest = [0.0; D];
        rest[0] = at;
        let point = line.point(rest);
        sum.add(&point.dofs, point.translation.iter().map(|t| t[axis]));
        return Ok(sum.combination);
    }
    let section = line.section(at);
    let mut weights = weights::<D>(spec, &section.stiffness, build)?;
    if let Some(stretch) = stretches.iter().find(|stretch| at <= stretch.ends[1]).or(stretches.last()) {
        sum.add_extension(stretch, weights[0]);
        weights[0] = 0.0;
    }
    let factor = |strains: &[f64; 6]| -> f64 { strains.iter().zip(weights).map(|(strain, w)| strain * w).sum() };
    sum.add(&section.dofs, section.strains.iter().map(factor));
    Ok(sum.combination)
}

/// A combination of the coordinates from `first` on.
struct Sum {
    first: usize,
    combination: Combination,
}

impl Sum {
    fn add(&mut self, dofs: &[usize], factors: impl Iterator<Item = f64>) {
        let terms = dofs.iter().zip(factors).filter(|(_, factor)| *factor != 0.0);
        self.combination.linear.extend(terms.map(|(dof, factor)| (self.first + dof, factor)));
    }

    /// The extension where it stiffens: a.q + q.S q/2.
    fn add_extension(&mut self, stretch: &Stretch, factor: f64) {
        self.add(&stretch.dofs, stretch.axial.iter().map(|a| factor * a));
        let places: Vec<usize> = stretch.dofs.iter().map(|dof| self.first + dof).collect();
        let pairs = places.iter().flat_map(|&i| places.iter().map(move |&j| [i, j]));
        let terms = pairs.zip(stretch.slopes.iter().map(|s| 0.5 * factor * s)).filter(|(_, factor)| *factor != 0.0);
        self.combination.squares.extend(terms);
    }
}

/// Where on the beam, m from its left end.
fn place<const D: usize>(spec: &OutputSpec, length: f64, build: &Build<D>) -> Result<f64> {
    let at = spec.at.as_ref().ok_or_else(|| missing("at", "say where on the beam: m from its left end"))?;
    let at = build.number("at", at)?;
    match (0.0..=length * (1.0 + 1e-12)).contains(&at) {
        true => Ok(at.min(length)),
        false => Err(Error::input(format!("{} m is off the beam", short(at)))
            .under("at")
            .hint(format!("the beam reaches from 0 to {} m", short(length)))),
    }
}

fn component(spec: &OutputSpec, default: &str, known: &[&str]) -> Result<usize> {
    let name = spec.component.as_deref().unwrap_or(default);
    known.iter().position(|known| *known == name).ok_or_else(|| wrong_component(name, known))
}

/// Factors of the strains: extension, shear along y and z, twist, curvature about y and z.
fn weights<const D: usize>(spec: &OutputSpec, stiffness: &[f64; 6], build: &Build<D>) -> Result<[f64; 6]> {
    let only = |i: usize| std::array::from_fn(|k| if k == i { stiffness[i] } else { 0.0 });
    match spec.measure {
        MeasureKind::Strain => {
            let (mut y, mut z) = (0.0, 0.0);
            match (&spec.offset, D) {
                (None, _) => {}
                (Some(offset), 2) => [y] = build.vector::<1>("offset", offset)?,
                (Some(offset), _) => [y, z] = build.vector::<2>("offset", offset)?,
            }
            Ok([1.0, 0.0, 0.0, 0.0, z, -y])
        }
        MeasureKind::AxialForce => Ok(only(0)),
        MeasureKind::ShearForce => {
            let axis = component(spec, "y", &["y", "z"][..D - 1])?;
            if stiffness[1 + axis] == 0.0 {
                return Err(Error::input("an Euler-Bernoulli beam in a floating frame has no shear force of its own")
                    .under("measure")
                    .hint("use \"theory\": \"timoshenko\", or watch the reaction of a joint"));
            }
            Ok(only(1 + axis))
        }
        MeasureKind::Torque if D == 2 => {
            Err(Error::input("a planar beam carries no torque").under("measure").hint("watch its bending_moment"))
        }
        MeasureKind::Torque => Ok(only(3)),
        _ => {
            let known: &[&str] = if D == 2 { &["z"] } else { &["y", "z"] };
            let axis = component(spec, "z", known)?;
            Ok(only(if known[axis] == "y" { 4 } else { 5 }))
        }
    }
}
